"""The rule that many points share: what their raw numbers are, whatever each is called and wherever it lies."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from fieldscribe.model.numbers import TYPES, TypeInfo

if TYPE_CHECKING:
    from fieldscribe.model.numbers import Digits, Enum, Fixed, Flag, Special, Text
    from fieldscribe.model.rules import Linear, ScaleCase


@dataclass(frozen=True)
class Shape:
    """What the raw numbers of points are: their type, what they mean, and who may write them.

    `width` is how many bits the raw number has: all of the type, or those of a group of bits in a word. `scale` is None
    where the raw number is the value. `decimals` k fixes the unit of the integer path, 10^-k units; it is None where no
    64-bit integer holds the counts, and there are none then. `encodes_values` is False where raw numbers, or what a
    scale multiplies them to, exceed 53 bits: values are decoded only. `most_raw` is how large a raw number may be for a
    scale that other points decide, where the type goes beyond: larger ones overflow. `specials` are never computed
    with; `specials_of` names what gives those that are not the point's own to many points (a type, a group, a format).

    Resolving keeps one shape of each kind; what follows from it is worked out once and kept with it.
    """

    type: str
    width: int
    access: str
    scale: tuple[ScaleCase, ...] | None
    decimals: int | None
    enum: Enum | None
    flags: tuple[Flag, ...]
    specials: tuple[Special, ...]
    specials_of: str = ""
    text: Text | None = None
    digits: Digits | None = None
    fixed: Fixed | None = None
    encodes_values: bool = True
    most_raw: int | None = None

    def __hash__(self) -> int:
        """Titles have no hash: what usually tells two shapes apart has to do, and equality looks at the rest."""
        named = () if self.enum is None else (self.enum.name, self.enum.closed)
        return hash((self.type, self.width, self.access, self.scale, self.decimals, named, len(self.flags), self.fixed))

    @cached_property
    def info(self) -> TypeInfo:
        """What the wire type is."""
        return TYPES[self.type]

    @cached_property
    def words(self) -> int:
        """How many 16-bit words (or single bits) a point takes; a bit group lies in one word."""
        return max(1, self.info.bits // 16) if self.text is None else self.text.characters // 2

    @cached_property
    def least(self) -> int:
        """The smallest raw number that the bits can hold."""
        return -(1 << (self.width - 1)) if self.info.signed else 0

    @cached_property
    def greatest(self) -> int:
        """The largest raw number that the bits can hold."""
        return (1 << (self.width - self.info.signed)) - 1

    @cached_property
    def held(self) -> tuple[int, int]:
        """What the wire type holds at least and at most: of a bit group more than its own bits do."""
        bits, signed = self.info.bits, self.info.signed
        return (-(1 << (bits - 1)) if signed else 0, (1 << (bits - signed)) - 1)

    @cached_property
    def readable(self) -> bool:
        """Whether the device answers with the point."""
        return "r" in self.access

    @cached_property
    def writable(self) -> bool:
        """Whether the device takes the point."""
        return "w" in self.access

    @cached_property
    def shared_codes(self) -> str:
        """What gives all special codes to many points; empty where some are the point's own."""
        return "" if any(code.own for code in self.specials) else self.specials_of

    @cached_property
    def form(self) -> str:
        """What a user sees: `float` (a pattern) `text digits enum flags bit scaled integer` (raw is the value)."""
        forms = (
            (self.info.floating, "float"),
            (self.text is not None, "text"),
            (self.digits is not None, "digits"),
            (self.enum is not None, "enum"),
            (bool(self.flags), "flags"),
            (self.type == "bit", "bit"),
            (self.scale is not None, "scaled"),
        )
        return next((form for holds, form in forms if holds), "integer")

    @cached_property
    def fixed_scale(self) -> Linear | None:
        """The rule of a scale that no other point has a part in."""
        return self.scale[0].rule if self.scale is not None and not self.scale_arguments else None

    @cached_property
    def scale_arguments(self) -> tuple[str, ...]:
        """The points that the scale needs at run time."""
        names: dict[str, None] = {}
        for case in self.scale or ():
            if case.point is not None:
                names[case.point] = None
            names.update(dict.fromkeys(factor.point for factor in case.rule.factors))
        return tuple(names)
