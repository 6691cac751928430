"""What the modules of this target often need of a point, worked out once."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.lowered import lower
from fieldscribe.names import pascal
from fieldscribe.records import dataclass
from fieldscribe.targets.rust.literals import raw_type, type_name

if TYPE_CHECKING:
    from collections.abc import Mapping

    from fieldscribe.lowered import Lowered
    from fieldscribe.model import Device, Enum, Linear, Message, Point, Telegram


@dataclass(frozen=True, slots=True)
class CratePoint:
    """A generated point: its form, identifiers and needs; `rule` is its scale if that depends on no other point."""

    point: Point
    form: str
    raw: str
    name: str
    arguments: tuple[str, ...]
    factors: tuple[str, ...]
    limits: tuple[str, ...]
    rule: Linear | None
    enum: Enum | None
    carried: str
    """The raw type of its enum, which is wider than its own if points of several types share the enum."""

    @property
    def closed(self) -> bool:
        """Whether only the enum's own numbers may be written."""
        return self.enum is not None and self.enum.closed

    @property
    def with_type(self) -> str:
        """The struct of all raw numbers that writing needs."""
        return f"with::{self.name}" if self.arguments else "()"

    @property
    def factors_name(self) -> str:
        """The name of the scale's struct if it differs from that for writing, else empty."""
        return f"{pascal(self.point.item)}Factors"

    @property
    def factors_struct(self) -> str:
        """The name of the struct of all raw numbers that the scale needs."""
        return self.name if self.factors == self.arguments else self.factors_name

    @property
    def factors_type(self) -> str:
        """The type of the struct of all raw numbers that the scale needs."""
        return f"with::{self.factors_struct}" if self.factors else "()"


@dataclass(frozen=True, slots=True)
class CrateScope:
    """What the points of a device share: the lowered model, raw types, the raw types of enums by name, functions.

    The telegrams are by name, with the messages that carry them. The errata are
    those that change a fact.
    """

    lowered: Lowered
    raw_types: Mapping[str, str]
    enums: Mapping[str, str]
    functions: frozenset[int]
    subjects: tuple[CratePoint, ...]
    family: str
    telegrams: Mapping[str, tuple[Telegram, Message | None]]
    errata: frozenset[str]


def scope_of(device: Device) -> CrateScope:
    """The scope of a device, with its generated points."""
    lowered = lower(device)
    enums: dict[str, str] = {}
    for point in device.points:
        enum = _enum(point)
        if point.generated and enum is not None:
            raw = "u16" if point.form == "digits" else raw_type(point)
            known = enums.setdefault(enum.name, raw)
            if known != raw:
                enums[enum.name] = "i128" if "u64" in (known, raw) else "i64"
    messages = {message.name: message for message in device.messages}
    return CrateScope(
        lowered,
        {name: raw_type(point) for name, point in lowered.points.items()},
        enums,
        frozenset(code.number for code in device.bus.functions),
        tuple(_subject(point, enums) for point in device.points if point.generated),
        device.family,
        {telegram.name: (telegram, messages.get(telegram.message or "")) for telegram in device.telegrams},
        frozenset(erratum.id for erratum in device.errata if erratum.facts),
    )


def _subject(point: Point, enums: Mapping[str, str]) -> CratePoint:
    enum, raw = _enum(point), raw_type(point)
    return CratePoint(
        point,
        point.form,
        raw,
        type_name(point.item),
        point.arguments,
        point.scale_arguments,
        point.limit_arguments,
        point.fixed_scale,
        enum,
        carried=enums[enum.name] if enum is not None else raw,
    )


def _enum(point: Point) -> Enum | None:
    """The enum of a point's values, or of its digits."""
    if point.digits is not None and point.form == "digits":
        return point.digits.enum
    return point.enum if point.form == "enum" else None
