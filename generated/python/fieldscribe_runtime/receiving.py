# SPDX-License-Identifier: 0BSD
"""A whole reply, from bytes as they come."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable


def whole(read: Callable[[int], bytes], size_of: Callable[[bytes], int | None]) -> bytes:
    """Return the whole reply. `read` returns up to so many bytes, none after its timeout; `size_of` gives the length.

    Raises TimeoutError when nothing more comes.
    """
    received = b""
    while (size := size_of(received)) is None or len(received) < size:
        more = read(1 if size is None else size - len(received))
        if not more:
            raise TimeoutError(f"{len(received)} bytes came and no more")
        received += more
    return received
