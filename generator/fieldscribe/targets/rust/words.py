"""The views of enums, of words of flags, and of the structs of raw numbers that points need."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.targets.rust.documentation import sentence, wrapped
from fieldscribe.targets.rust.layout import Item, arm, binding, called, calls, comparison, fields_of, signature
from fieldscribe.targets.rust.literals import integer, mask, type_name, value_name, variant_name
from fieldscribe.targets.rust.views import ArgumentsView, EntryView, EnumView, FlagsView, FlagView
from fieldscribe.text import rust_string

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Device, Entry, Enum, Flag
    from fieldscribe.targets.rust.subjects import CrateScope

_LONG = 90

UNKNOWN = ("Unknown", "Other", "Unnamed", "Number")
"""Names for the variant of unnamed numbers: the first of these that is no entry is used."""


def enum_views(device: Device, scope: CrateScope) -> Iterator[EnumView]:
    """The enums that generated points use, in the device's order."""
    for enum in device.enums:
        if enum.name in scope.enums:
            yield _enum(enum, scope.enums[enum.name])


def is_long(enum: EnumView) -> bool:
    """Whether a function with an arm for each name would be too long for clippy."""
    return (
        max(sum(len(entry.named) for entry in enum.entries), sum(len(entry.numbered) for entry in enum.entries)) > _LONG
    )


_OF_TRAITS = frozenset(
    {
        "clone",
        "cmp",
        "default",
        "deref",
        "drop",
        "eq",
        "fmt",
        "from",
        "hash",
        "index",
        "into",
        "ne",
        "neg",
        "next",
        "not",
    }
)
"""Methods of traits, with which a flag's function could be confused."""


def getter_name(flag: str) -> str:
    """The function that gets a flag; renamed if it would look like a conversion or a method of a trait."""
    convertible = flag.startswith(("from_", "as_", "into_", "to_"))
    return f"get_{flag}" if convertible or flag in _OF_TRAITS else value_name(flag)


def constant_name(flag: Flag) -> str:
    """The constant of a flag's mask; its name says so if the flag is false while the bit is set."""
    return flag.name.upper() + ("" if flag.active or flag.width > 1 else "_ACTIVE_LOW")


def flags_views(scope: CrateScope) -> Iterator[FlagsView]:
    """The words with named bits."""
    for subject in scope.subjects:
        if subject.form == "flags":
            point, bits = subject.point, f"u{subject.point.info.bits}"
            flags = tuple(_flag(flag, point.info.bits) for flag in point.flags)
            low = sum(1 << flag.low for flag in point.flags if flag.width == 1 and not flag.active)
            yield FlagsView(
                doc=sentence(point.item),
                name=subject.name,
                raw=subject.raw,
                bits=bits,
                false=mask(low, bits) if low else "0",
                flags=flags,
                shown=(
                    *binding(4, Item("const NAME", "&'static str"), rust_string(subject.name)),
                    *_table(point.flags, flags),
                ),
            )


def _table(flags: tuple[Flag, ...], views: tuple[FlagView, ...]) -> tuple[str, ...]:
    """The constant that says how flags are shown, with the names of their numbers."""
    item = Item("const FLAGS", "&'static [runtime::Flag]")
    names, shown = list[str](), list[tuple[str, tuple[str, ...]]]()
    for place, (flag, view) in enumerate(zip(flags, views, strict=True)):
        if view.values:
            names += _names(f"NAMES_{place}", flag)
            shown.append(("runtime::Flag::named", (view.name, view.mask, f"NAMES_{place}")))
        else:
            made = "new" if view.active or not view.single else "active_low"
            shown.append((f"runtime::Flag::{made}", (view.name, view.mask)))
    if not names:
        return calls(4, item, shown)
    return f"{item} = {{", *(f"    {line}" for line in (*names, *called(8, shown))), "};"


def _names(constant: str, flag: Flag) -> tuple[str, ...]:
    """The constant of the numbers of a flag that have names."""
    rows: list[tuple[str, tuple[str, ...]]] = [("", (integer(one.raw), rust_string(one.name))) for one in flag.values]
    return calls(8, Item(f"const {constant}", "runtime::Names"), rows)


def arguments_views(scope: CrateScope) -> Iterator[ArgumentsView]:
    """The structs of raw numbers that points need."""
    for subject in scope.subjects:
        if not subject.arguments:
            continue
        item = subject.point.item
        parted = bool(subject.factors) and subject.factors != subject.arguments
        part = subject.factors_name if parted else ""
        if parted:
            doc = f"Raw numbers that the scale of `{item}` needs."
            yield ArgumentsView(doc, part, _fields(subject.factors, scope), "", ())
        literal = fields_of(8, "Self", tuple(map(value_name, subject.factors))) if parted else ()
        doc = f"Raw numbers that `{item}` needs."
        yield ArgumentsView(doc, subject.name, _fields(subject.arguments, scope), part, literal)


def _fields(names: tuple[str, ...], scope: CrateScope) -> tuple[tuple[tuple[str, ...], str, str], ...]:
    return tuple((tuple(wrapped(_source(name, scope))), value_name(name), scope.raw_types[name]) for name in names)


def _source(name: str, scope: CrateScope) -> str:
    """The points whose raw number an argument is: several if variants of the device differ."""
    types = [subject.name for subject in scope.subjects if name in (subject.point.item, subject.point.name)]
    links = " or ".join(f"[`{type_}`](crate::points::{type_})" for type_ in types)
    return f"The raw number of {links or f'`{name}`'}."


def _enum(enum: Enum, raw: str) -> EnumView:
    name = type_name(enum.name)
    entries = tuple(_entry(entry, name) for entry in enum.entries)
    taken = {entry.name for entry in entries}
    unknown = next(candidate for candidate in UNKNOWN if candidate not in taken)
    return EnumView(sentence(enum.name), name, raw, entries, unknown)


def _entry(entry: Entry, enum: str) -> EntryView:
    name, literal = variant_name(entry.name), integer(entry.raw)
    named = arm(12, f"Self::{name}", f"Some({rust_string(entry.name)})")
    return EntryView(sentence(entry.name), name, literal, named, arm(12, f"{enum}::{name}", literal))


def _flag(flag: Flag, width: int) -> FlagView:
    raw, ones = f"u{width}", (1 << flag.width) - 1
    bits = mask(ones << flag.low, raw)
    single = flag.width == 1
    constant = constant_name(flag)
    full = ones << flag.low == (1 << width) - 1
    masked = "self.0" if full else f"self.0 & Self::{constant}"
    number = masked if flag.low == 0 else f"({masked}) >> {flag.low}"
    placed = "number" if flag.low == 0 else f"(number << {flag.low})"
    parameter = "state: bool" if single else f"number: {raw}"
    states = (f"self.0 & !Self::{constant}", f"self.0 | Self::{constant}")
    return FlagView(
        name=rust_string(flag.name),
        doc=sentence(flag.name),
        meaning=("" if flag.active else "True while the bit is 0.") if single else "A number.",
        active=bool(flag.active),
        constant=constant,
        constant_lines=binding(4, Item(f"pub const {constant}", raw), bits),
        getter=getter_name(flag.name),
        setter=signature(4, f"pub const fn with_{flag.name}", ("self", parameter), "Self"),
        mask=bits,
        single=single,
        read=comparison(8, masked, "!= 0" if flag.active else "== 0") if single else (number,),
        full=full,
        placed=placed,
        when_true=states[flag.active],
        when_false=states[1 - flag.active],
        values=tuple(
            (
                sentence(value.name),
                binding(4, Item(f"pub const {flag.name.upper()}_{value.name.upper()}", raw), integer(value.raw)),
            )
            for value in (() if single else flag.values)
        ),
    )
