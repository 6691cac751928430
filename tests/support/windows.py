"""The registers of the kitchen sink whose meaning a page and an index select."""

from __future__ import annotations

from support.blocks import Registers

PAGE, INDEX, WINDOW = 0x7500, 0x7501, 0x7510


class Windowed(Registers):
    """Registers of which those of the window are others for each page and index; `sent` has what was written."""

    def __init__(self) -> None:
        super().__init__({PAGE: 0, INDEX: 0})
        self.behind = {(1, 9 + index): [10 * index, 0, 100 + index] for index in (1, 2, 3)} | {(2, 0): [1, 0, 0]}
        self.sent: list[tuple[int, int]] = []
        self.is_dead = False

    def _answer(self, pdu: bytes) -> bytes:
        if self.is_dead:
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
