"""The views of enums, of words whose bits have names, and of what a point needs from others."""

from __future__ import annotations

from collections.abc import Iterator

from fieldscribe.model import Device, Enum, Flag, Point
from fieldscribe.targets.rust.documentation import sentence
from fieldscribe.targets.rust.literals import integer, mask, raw_type, type_name, value_name
from fieldscribe.targets.rust.points import Scope
from fieldscribe.targets.rust.views import ArgumentsView, EntryView, EnumView, FlagsView, FlagView
from fieldscribe.text import rust_string

_STRUCT_WIDTH = 18
"""rustfmt puts the fields of a struct literal on lines of their own if they take more columns."""


def enum_views(device: Device, scope: Scope) -> Iterator[EnumView]:
    """The enums that generated points use, in the device's order."""
    for enum in device.enums:
        if enum.name in scope.enums:
            yield _enum(enum, scope.enums[enum.name])


def flags_views(device: Device) -> Iterator[FlagsView]:
    """The words with named bits."""
    for point in device.points:
        if point.generated and point.form == "flags":
            bits = raw_type(point).replace("i", "u")
            flags = tuple(_flag(flag, bits) for flag in point.flags)
            yield FlagsView(sentence(point.title), type_name(point.item), point.item, raw_type(point), bits, flags)


def arguments_views(device: Device, scope: Scope) -> Iterator[ArgumentsView]:
    """The structs of raw numbers that points need."""
    for point in device.points:
        if not point.generated or not point.arguments:
            continue
        name = type_name(point.item)
        parted = bool(point.scale_arguments) and point.scale_arguments != point.arguments
        part = f"{name}Factors" if parted else ""
        if parted:
            doc = f"Raw numbers that the scale of `{point.item}` needs."
            yield ArgumentsView(doc, part, _fields(point.scale_arguments, scope), "", ())
        doc = f"Raw numbers that `{point.item}` needs."
        literal = _struct_literal(point.scale_arguments) if parted else ()
        yield ArgumentsView(doc, name, _fields(point.arguments, scope), part, literal)


def _fields(names: tuple[str, ...], scope: Scope) -> tuple[tuple[str, str, str], ...]:
    return tuple((f"The raw number of `{name}`.", value_name(name), raw_type(scope.points[name])) for name in names)


def _struct_literal(names: tuple[str, ...]) -> tuple[str, ...]:
    """The lines between the braces; a single one if rustfmt would keep it on the line of the braces."""
    fields = [f"{value_name(name)}: self.{value_name(name)}" for name in names]
    return (", ".join(fields),) if len(", ".join(fields)) <= _STRUCT_WIDTH else (*(f"{one}," for one in fields), "")


def _enum(enum: Enum, raw: str) -> EnumView:
    entries = tuple(
        EntryView(sentence(entry.title), type_name(entry.name), integer(entry.raw), rust_string(entry.name))
        for entry in enum.entries
    )
    taken = {entry.name for entry in entries}
    unknown = next(name for name in ("Unknown", "Other", "Unnamed", "Number") if name not in taken)
    return EnumView(sentence(enum.title), type_name(enum.name), raw, entries, unknown)


def _flag(flag: Flag, raw: str) -> FlagView:
    ones = (1 << flag.width) - 1
    bits = mask(ones << flag.low, raw)
    constant = flag.name.upper()
    # clippy wants what is named `from_…` or `as_…` to convert, which a flag does not.
    getter = f"get_{flag.name}" if flag.name.startswith(("from_", "as_", "into_", "to_")) else flag.name
    single = flag.width == 1
    full = ones << flag.low == (1 << int(raw[1:])) - 1
    masked = "self.0" if full else f"self.0 & Self::{constant}"
    number = masked if flag.low == 0 else f"({masked}) >> {flag.low}"
    placed = "number" if flag.low == 0 else f"(number << {flag.low})"
    return FlagView(
        doc=sentence(flag.title),
        label=flag.name,
        constant=constant,
        getter=value_name(getter),
        setter=f"with_{flag.name}",
        mask=bits,
        single=single,
        read=f"{masked} {'!=' if flag.active else '=='} 0" if single else number,
        full=full,
        placed=placed,
        active=bool(flag.active),
        values=tuple((sentence(one.title), f"{constant}_{one.name.upper()}", integer(one.raw)) for one in flag.values),
    )
