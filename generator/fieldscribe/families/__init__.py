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


FAMILIES: Mapping[str, Family] = {
    "modbus": Family({"coil": "bit", "discrete": "bit", "holding": "word", "input": "word"}, 0xFFFF),
}
