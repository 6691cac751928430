"""The generated points of a device as the modules of this target need them; facts of a shape are worked out once."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from fieldscribe.lowered import lower
from fieldscribe.targets.rust.literals import raw_type, type_name

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from fieldscribe.lowered import Lowered
    from fieldscribe.model import Device, Enum, Linear, Message, Point, Shape, Telegram


@dataclass(frozen=True, slots=True, eq=False)
class CrateShape:
    """What Rust knows of all points of a shape; `rule` is their scale if that depends on no other point.

    `enum` is that of their values or digits.
    """

    form: str
    raw: str
    factors: tuple[str, ...]
    rule: Linear | None
    enum: Enum | None
    carried: str
    """The raw type of its enum, which is wider than its own if points of several types share the enum."""

    @property
    def closed(self) -> bool:
        """True if only the enum's own numbers may be written."""
        return self.enum is not None and self.enum.closed


class CratePoint(NamedTuple):
    """A generated point: its name in the description and in Rust, and what Rust knows of its shape.

    `arguments` are the points whose raw numbers writing needs, `key` is its template key.
    """

    point: Point
    item: str
    name: str
    shape: CrateShape
    arguments: tuple[str, ...]
    key: int

    def renamed(self, item: str, name: str) -> CratePoint:
        """Return the point with placeholders for its names; one with a computed scale keeps them, for its structs."""
        return self if self.factors else self._replace(item=item, name=name)

    @property
    def form(self) -> str:
        """What a user sees, as the model says."""
        return self.shape.form

    @property
    def raw(self) -> str:
        """The type of its raw number."""
        return self.shape.raw

    @property
    def factors(self) -> tuple[str, ...]:
        """The points whose raw numbers the scale needs."""
        return self.shape.factors

    @property
    def with_type(self) -> str:
        """The struct of all raw numbers that writing needs."""
        return f"with::{self.name}" if self.arguments else "()"

    @property
    def factors_name(self) -> str:
        """The name of the scale's struct if it differs from that for writing, else empty."""
        return f"{self.name.rstrip('_')}Factors"

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
    """What the points of a device share: the lowered model, the raw types of enums by name, functions.

    The telegrams are by name, with the messages that carry them. The errata are
    those that change a fact.
    """

    lowered: Lowered
    enums: Mapping[str, str]
    functions: frozenset[int]
    subjects: tuple[CratePoint, ...]
    family: str
    telegrams: Mapping[str, tuple[Telegram, Message | None]]
    errata: frozenset[str]


def scope_of(device: Device) -> CrateScope:
    """Return the scope of a device, with its generated points."""
    generated = [point for point in device.points if point.generated]
    shapes = {id(point.shape): point.shape for point in generated}
    enums = _enum_types(shapes.values())
    messages = {message.name: message for message in device.messages}
    lowered, crate_shapes = lower(device), {key: _shape(shape, enums) for key, shape in shapes.items()}
    return CrateScope(
        lowered,
        enums,
        frozenset(code.number for code in device.bus.functions),
        tuple(_subjects(generated, crate_shapes, lowered.template_keys)),
        device.family,
        {telegram.name: (telegram, messages.get(telegram.message or "")) for telegram in device.telegrams},
        frozenset(erratum.id for erratum in device.errata if erratum.facts),
    )


def _subjects(
    points: Iterable[Point], shapes: Mapping[int, CrateShape], keys: Mapping[int, int]
) -> Iterator[CratePoint]:
    for point in points:
        shape, item = shapes[id(point.shape)], point.item
        arguments = point.arguments if shape.factors or point.allowed.arguments else ()
        yield CratePoint(point, item, type_name(item), shape, arguments, keys[id(point)])


def _enum_types(shapes: Iterable[Shape]) -> dict[str, str]:
    """Return the raw type that each enum carries: that of its points, or one that holds the numbers of all."""
    enums: dict[str, str] = {}
    for shape in shapes:
        enum = _enum(shape)
        if enum is not None:
            raw = "u16" if shape.form == "digits" else raw_type(shape)
            known = enums.setdefault(enum.name, raw)
            if known != raw:
                enums[enum.name] = "i128" if "u64" in (known, raw) else "i64"
    return enums


def _shape(shape: Shape, enums: Mapping[str, str]) -> CrateShape:
    enum, raw = _enum(shape), raw_type(shape)
    carried = raw if enum is None else enums[enum.name]
    return CrateShape(shape.form, raw, shape.scale_arguments, shape.fixed_scale, enum, carried)


def _enum(shape: Shape) -> Enum | None:
    """Return the enum of the values of points, or of their digits."""
    if shape.digits is not None and shape.form == "digits":
        return shape.digits.enum
    return shape.enum if shape.form == "enum" else None
