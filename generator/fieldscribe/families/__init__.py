"""Bus families: the addressing and framing rules that many devices share. A family is one folder here and one line below."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Family:
    """What the stages before the targets need: what one address of a space holds, and the highest address."""

    spaces: Mapping[str, str]
    last_address: int


FAMILIES: Mapping[str, Family] = {
    "modbus": Family({"coil": "bit", "discrete": "bit", "holding": "word", "input": "word"}, 0xFFFF),
}
