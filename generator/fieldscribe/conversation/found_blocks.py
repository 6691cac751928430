"""Finds blocks in the frames of one unit, as its master finds them: the marker, then the head of each block in turn."""

from __future__ import annotations

from collections.abc import Sequence

from fieldscribe.model import Device, Found


class FoundBlocks:
    """What the replies of a unit have shown of a chain of blocks; `starts` and `lasts` have the bases known by it."""

    def __init__(self, device: Device, found: Found) -> None:
        self._found = found
        self._bases = [base for base in device.bases if base.block is not None]
        self._first: int | None = None
        self._heads: dict[int, int] = {}
        self._counts: dict[tuple[str, str], int] = {}
        self.starts: dict[str, int] = {}
        self.lasts: dict[str, int] = {}

    def take(self, space: str, address: int, words: Sequence[int]) -> bool:
        """Take words that the device reported; return True if they move a base."""
        if space != self._found.space:
            return False
        seen = dict(enumerate(words, address))
        marker, before = self._found.words, dict(self.starts)
        for place in self._found.places:
            if self._first is None and all(seen.get(place + at) == word for at, word in enumerate(marker)):
                self._first = place + len(marker)
        blocks = self._blocks(seen)
        for base in self._bases:
            if base.block not in blocks:
                continue
            start, last = blocks[base.block]
            for name, at, _ in base.counts:
                if start + at in seen:
                    self._counts[base.name, name] = seen[start + at]
            numbers = [self._counts.get((base.name, name)) for name, _, _ in base.counts]
            known = [number for number in numbers if number is not None]
            if len(known) == len(numbers):
                counted = zip(known, base.counts, strict=True)
                self.starts[base.name] = start + base.offset + sum(number * each[2] for number, each in counted)
                self.lasts[base.name] = last
        return self.starts != before

    def _blocks(self, seen: dict[int, int]) -> dict[int, tuple[int, int]]:
        """Return the first and the last address of each block whose head is known, by its id; of two, the first."""
        blocks: dict[int, tuple[int, int]] = {}
        at = self._first
        while at is not None:
            self._heads.update({head: seen[head] for head in (at, at + 1) if head in seen})
            block, length = self._heads.get(at), self._heads.get(at + 1)
            if block is None or length is None or block == self._found.end:
                break
            blocks.setdefault(block, (at, at + 1 + length))
            at += 2 + length
        return blocks
