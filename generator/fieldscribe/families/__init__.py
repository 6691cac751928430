"""Bus families: addressing and framing rules that many devices share. A family is a folder here and a line below."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping


@dataclass(frozen=True, slots=True)
class Family:
    """What the stages before the targets need: what one address of a space holds, and the highest address."""

    spaces: Mapping[str, str]
    last_address: int
    indexed: frozenset[str] = frozenset()
    """The spaces where an address has an index beside it."""
    words: Mapping[str, int] = field(default_factory=dict)
    """The spaces whose numbers travel one by one, with the most words of one."""

    def widest(self, space: str) -> int:
        """The most bits of a number in the space."""
        return 16 * self.words.get(space, 4)


FAMILIES: Mapping[str, Family] = {
    "modbus": Family({"coil": "bit", "discrete": "bit", "holding": "word", "input": "word"}, 0xFFFF),
    "can": Family({"parameter": "word", "telegram": "word"}, 0xFFFF, words={"parameter": 1}),
    "uss": Family({"parameter": "word", "telegram": "word"}, 31999, frozenset({"parameter"}), {"parameter": 2}),
}
