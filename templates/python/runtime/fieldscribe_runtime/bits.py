# SPDX-License-Identifier: 0BSD
"""Bits of one request and the points in them: coils and discrete inputs, the first one lowest in its byte."""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING

from .fast import itself
from .layouts import Layout, Piece
from .points import Decoding

if TYPE_CHECKING:
    from collections.abc import Iterable

    from .layouts import Fields


class _Packed:
    """Packs bits into bytes as replies carry them."""

    def __init__(self, count: int) -> None:
        self._places = range(count)
        self.size = (count + 7) // 8

    def unpack(self, data: bytes, /) -> tuple[int, ...]:
        """Return the bits; raises struct.error for more or fewer bytes."""
        number = int.from_bytes(memoryview(data), "little")
        if len(data) != self.size:
            raise struct.error
        return tuple([number >> at & 1 for at in self._places])

    def pack(self, /, *bits: int) -> bytes:
        """Return the bytes."""
        return sum([bit << at for at, bit in enumerate(bits)]).to_bytes(self.size, "little")


class BitLayout(Layout):
    """A `Layout` for the bits of a planned read: `words` are their addresses."""

    _full = 1

    def _cut(self, around: tuple[int, int]) -> tuple[Fields, tuple[Piece, ...]]:
        del around
        pieces = []
        for point in self.points:
            decoder = point.sure_decoder if isinstance(point, Decoding) else itself
            pieces.append(Piece(point, point.facts.at.address - self.words[0], decoder, int, True))
        return _Packed(len(self.words)), tuple(pieces)

    def _packed(self, words: Iterable[int]) -> bytes:
        return self._struct.pack(*words)
