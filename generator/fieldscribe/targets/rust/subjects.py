"""The generated points of a device as the modules of this target need them; facts of a shape are computed once."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import NamedTuple

from fieldscribe.lowered import Lowered, lower
from fieldscribe.model import Device, Enum, Message, Point, Telegram
from fieldscribe.targets.rust.literals import device_type, raw_type, type_name


class CratePoint(NamedTuple):
    """A generated point: its name in the description and in Rust, and the type of its raw number.

    `carried` is the raw type of its enum: wider than its own if points of several types share the enum. `key` is its
    template key.
    """

    point: Point
    item: str
    name: str
    raw: str
    carried: str
    key: int

    def renamed(self, item: str, name: str) -> CratePoint:
        """Return the point with placeholders for its names; one with a computed scale keeps them, for its structs."""
        return self if self.point.scale_arguments else self._replace(item=item, name=name)

    @property
    def enum(self) -> Enum | None:
        """The enum of its values, or of its digits."""
        return self.point.named_numbers

    @property
    def factors_name(self) -> str:
        """The name of the scale's struct if it differs from that for writing, else empty."""
        needs = self.point.scale_arguments
        return f"{self.name.rstrip('_')}Factors" if needs and needs != self.point.arguments else ""

    @property
    def factors_struct(self) -> str:
        """The name of the struct of all raw numbers that the scale needs."""
        return self.factors_name or self.name

    @property
    def factors_type(self) -> str:
        """The type of the struct of all raw numbers that the scale needs."""
        return f"with::{self.factors_struct}" if self.point.scale_arguments else "()"


class CrateScope(NamedTuple):
    """The state that the points of a device share: the lowered model, the raw types of enums by name, functions.

    `device_type` is the type of the device. The telegrams are by name, with the messages that carry them.
    """

    lowered: Lowered
    enums: Mapping[str, str]
    functions: frozenset[int]
    subjects: tuple[CratePoint, ...]
    family: str
    device_type: str
    telegrams: Mapping[str, tuple[Telegram, Message | None]]


def scope_of(device: Device) -> CrateScope:
    """Return the scope of a device, with its generated points."""
    generated = [point for point in device.points if point.generated]
    enums = _enum_types(generated)
    messages = {message.name: message for message in device.messages}
    lowered = lower(device)
    keys = lowered.template_keys
    subjects = [
        CratePoint(point, item := point.item, type_name(item), *_types_of(point, enums), keys[id(point)])
        for point in generated
    ]
    return CrateScope(
        lowered,
        enums,
        frozenset(code.number for code in device.bus.functions),
        tuple(subjects),
        device.family,
        device_type(device.id),
        {telegram.name: (telegram, messages.get(telegram.message or "")) for telegram in device.telegrams},
    )


def _enum_types(points: Iterable[Point]) -> dict[str, str]:
    """Return the raw type of each enum: that of its points, or one that holds the numbers of all."""
    enums: dict[str, str] = {}
    for point in points:
        enum, raw = point.named_numbers, raw_type(point.shape)
        if enum is not None:
            known = enums.setdefault(enum.name, raw)
            if known != raw:
                enums[enum.name] = "i128" if "u64" in (known, raw) else "i64"
    return enums


def _types_of(point: Point, enums: Mapping[str, str]) -> tuple[str, str]:
    """Return the type of raw numbers, and that of the enum of the values."""
    enum, raw = point.named_numbers, raw_type(point.shape)
    return raw, raw if enum is None else enums[enum.name]
