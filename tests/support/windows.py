"""Registers of the kitchen sink whose meaning a page and an index select, and what clients do with them in order."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from support.blocks import Registers, served
from support.modbus_server import server

PAGE, INDEX, WINDOW = 0x7500, 0x7501, 0x7510
HELD = [
    *("ok 20", "ok 102", "ok 1", "ok 20", "ok", "ok 1", "ok 45", "ok", "ok 45", "out_of_range", "ok 45"),
    *("exception", "ok 45"),
]
"""What programs print: reads in counts, writes, one of a number beyond the range, and a read of what is not there."""
VALUES = [
    *("ok 2", "ok 102", "ok inputs", "ok 2", "ok", "ok on", "ok 4.5", "ok", "ok 4.5", "out_of_range", "ok 4.5"),
    *("exception", "ok 4.5"),
]
"""The same in values."""
SENT = [
    *((PAGE, 1), (INDEX, 11)),
    *((INDEX, 12), (WINDOW, 45)),
    (PAGE, 2),
    *((PAGE, 1), (INDEX, 12)),
    *((PAGE, 0), (PAGE, 1), (INDEX, 12)),
    *((PAGE, 1), (INDEX, 12)),
]
"""What they write meanwhile: whatever does not stand by what was selected last, and again after a failure."""

_INPUT = [(PAGE, 1), (INDEX, 11)]
RESTARTS = [
    (2, [], [(PAGE, 1), *_INPUT]),
    (3, [], [*_INPUT, *_INPUT]),
    (3, [4.5], [*_INPUT, *_INPUT, (WINDOW, 45)]),
]
"""The request at which the device restarts, what is written to the second input's delay (else read), what is sent."""


def registers() -> dict[tuple[int, int], list[int]]:
    """Return what is behind the window by page and index, which counts on the page of the inputs alone."""
    return {(1, 9 + index): [10 * index, 0, 100 + index] for index in (1, 2, 3)} | {(2, 0): [1, 0, 0]}


class Windowed(Registers):
    """Registers of which those of the window are others for each page and index; `sent` has what was written."""

    def __init__(self) -> None:
        super().__init__({PAGE: 0, INDEX: 0})
        self.behind = registers()
        self.sent: list[tuple[int, int]] = []
        self.is_dead = False
        self.restarts_at = 0
        """Before the answer to that request from now on it restarts, and loses what was selected; 0 for never."""

    def _answer(self, pdu: bytes) -> bytes:
        if self.is_dead:
            raise TimeoutError
        if self.restarts_at:
            self.restarts_at -= 1
            if not self.restarts_at:
                self.held.update({PAGE: 0, INDEX: 0})
                raise TimeoutError
        address, value = int.from_bytes(pdu[1:3], "big"), int.from_bytes(pdu[3:5], "big")
        page = self.held[PAGE]
        words = self.behind.get((page, self.held[INDEX] if page == 1 else 0), [])
        self.held.update(enumerate(words, WINDOW))
        if pdu[0] == 6:
            self.sent.append((address, value))
            if address == WINDOW:
                words[0] = value
        return super()._answer(pdu)


@contextmanager
def over_tcp() -> Iterator[tuple[int, list[tuple[int, int]]]]:
    """Yield the port of such registers, and what was written."""
    line = Windowed()
    line.framing = "tcp"
    with served(line) as port:
        yield port, line.sent


@contextmanager
def by_pymodbus() -> Iterator[tuple[int, list[tuple[int, int]]]]:
    """Yield the port of a server of pymodbus with such registers, and what was written."""
    behind, sent = registers(), list[tuple[int, int]]()

    async def follow(_function: int, start: int, address: int, *rest: Any) -> None:
        _count, held, new = rest
        page, index = held[PAGE - start], held[INDEX - start]
        words = behind.get((page, index if page == 1 else 0), [0, 0, 0])
        if new is not None:
            sent.append((address, int(new[0])))
            if address == WINDOW:
                words[0] = int(new[0])
        held[WINDOW - start : WINDOW - start + 3] = words

    with server(word=0, addresses=0x7600, action=follow) as port:
        yield port, sent
