"""The other end of a serial line, without hardware."""

from __future__ import annotations

import os
import threading
import tty
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterator


@contextmanager
def pty_end(answer: Any) -> Iterator[str]:
    """The port of a line whose other end answers each request by a function; None is silence."""
    near, far = os.openpty()
    for end in (near, far):
        tty.setraw(end)

    def serve() -> None:
        while True:
            try:
                request = os.read(near, 256)
            except OSError:
                return
            with suppress(OSError):  # the test has closed the line
                for reply in answer(request):
                    os.write(near, reply)

    thread = threading.Thread(target=serve, daemon=True)
    thread.start()
    try:
        yield os.ttyname(far)
    finally:
        os.close(far)
        os.close(near)
