"""What many points share: everything about their raw numbers, but not their names and addresses."""

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
    """What the raw numbers of points are: their type, their meaning, and whether they can be read and written.

    `width` is how many bits the raw number has: all of the type, or those of a group of bits in a word. `scale` is None
    where the raw number is the value. `decimals` k fixes the unit of the integer path, 10^-k units; it is None if the
    counts do not fit 64 bits, and then the point has no integer path. `encodes_values` is False if raw numbers or the
    products of the scale exceed 53 bits: then values are only decoded. `most_raw` is the greatest raw number that a
    run-time scale can compute with, if the type holds larger ones: those are an overflow. `specials` are no quantities;
    `specials_of` names the type, group or format that those come from which the point shares with others.
    `display` is the number of decimals that people see, None if nothing says it; no computation depends on it.

    Equal shapes are one object, so that the facts derived below are worked out once.
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
    display: int | None = None

    def __hash__(self) -> int:
        """A hash of the facts that usually differ, because titles have no hash; equality compares all."""
        enum = () if self.enum is None else (self.enum.name, self.enum.closed)
        names = tuple([flag.name for flag in self.flags]), tuple([special.name for special in self.specials])
        return hash((self.type, self.width, self.access, self.scale, self.decimals, enum, names, self.fixed))

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
        """The least and greatest number of the wire type; for a bit group that is more than its own bits hold."""
        bits, signed = self.info.bits, self.info.signed
        return (-(1 << (bits - 1)) if signed else 0, (1 << (bits - signed)) - 1)

    @cached_property
    def readable(self) -> bool:
        """Whether the point can be read."""
        return "r" in self.access

    @cached_property
    def writable(self) -> bool:
        """Whether the point can be written."""
        return "w" in self.access

    @cached_property
    def shared_codes(self) -> str:
        """The name of the codes that many points share, if they are all that this point has; else empty."""
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
        """The rule of a scale that depends on no other point; else None."""
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
