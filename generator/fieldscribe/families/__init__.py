"""Bus families: addressing and framing rules that many devices share. A family is a folder here and a line below."""

from __future__ import annotations

from dataclasses import dataclass
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
    single: frozenset[str] = frozenset()
    """The spaces whose words travel one by one, so that no number may take two."""

    def widest(self, space: str) -> int:
        """The most bits of a number in the space."""
        return 16 if space in self.single else 64


FAMILIES: Mapping[str, Family] = {
    "modbus": Family({"coil": "bit", "discrete": "bit", "holding": "word", "input": "word"}, 0xFFFF),
    "can": Family({"parameter": "word", "telegram": "word"}, 0xFFFF, single=frozenset({"parameter"})),
    "uss": Family({"parameter": "word", "telegram": "word"}, 31999, frozenset({"parameter"})),
}
