"""The other end of a serial line, without hardware."""

from __future__ import annotations

import os
import threading
import tty
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import Any


@contextmanager
def pty_end(answer: Any) -> Iterator[str]:
    """The port of a line whose other end answers each request by a function; None is silence."""
    near, far = os.openpty()
    for end in (near, far):
        tty.setraw(end)
    stop = threading.Event()

    def serve() -> None:
        with suppress(OSError):  # the other end is closed
            while request := os.read(near, 256):
                for reply in answer(request):
                    if stop.is_set():
                        return
                    os.write(near, reply)

    thread = threading.Thread(target=serve, daemon=True)
    thread.start()
    try:
        yield os.ttyname(far)
    finally:
        stop.set()
        os.close(far)
        thread.join(10)  # before its end is closed: the number may be another file's then
        os.close(near)
