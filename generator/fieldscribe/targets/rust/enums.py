"""Enums, and words of flags."""

from collections.abc import Iterable, Iterator
from typing import Any

from fieldscribe.arithmetic.words import mask_of
from fieldscribe.model import Device, Entry, Flag
from fieldscribe.resources import Render
from fieldscribe.targets.rust.layout import Item, binding, called, calls, comparison, sentence, signature
from fieldscribe.targets.rust.literals import integer, mask, type_name, value_name, variant_name
from fieldscribe.targets.rust.scope import CratePoint, CrateScope
from fieldscribe.text import rust_string

View = dict[str, Any]
"""The context of an entry or a flag, by the names in the template."""

UNKNOWN = ("Unknown", "Other", "Unnamed", "Number")
"""Names for the variant of unnamed numbers: the first that is not an entry is used."""


def enum_texts(device: Device, scope: CrateScope, render: Render) -> Iterator[str]:
    """Yield the enums that generated points use, in the device's order."""
    for enum in device.enums:
        raw = scope.enums.get(enum.name)
        if raw is not None:
            name, entries = type_name(enum.name), tuple(map(_entry, enum.entries))
            variants = {entry["name"] for entry in entries}
            unknown = next(candidate for candidate in UNKNOWN if candidate not in variants)
            view = {"doc": sentence(enum.name), "name": name, "raw": raw, "entries": entries, "unknown": unknown}
            yield render("rust/enum.rs.j2", view) + old_names_text(name, enum.was, render)


def old_names_text(name: str, old_names: Iterable[str], render: Render) -> str:
    """Return the types that keep old names of a type; `was` are these in the description."""
    texts = []
    for old in old_names:
        lines = binding(0, Item(f"pub type {type_name(old)}"), name)
        texts.append(render("rust/old_name.rs.j2", {"name": name, "lines": lines}))
    return "".join(texts)


_OF_TRAITS = frozenset(
    {"clone", "cmp", "default", "deref", "drop", "eq", "fmt", "from", "hash", "index", "into", "ne", "neg"}
    | {"next", "not"}
)
"""Methods of traits with which the function of a flag could be confused."""


def getter_name(flag: str) -> str:
    """Return the function that gets a flag; renamed if it would look like a conversion or a method of a trait."""
    convertible = flag.startswith(("from_", "as_", "into_", "to_"))
    return f"get_{flag}" if convertible or flag in _OF_TRAITS else value_name(flag)


def constant_name(flag: Flag) -> str:
    """Return the constant of a flag's mask; its name says if the flag is false while the bit is set."""
    return flag.name.upper() + ("" if flag.active or flag.width > 1 else "_ACTIVE_LOW")


def word_texts(scope: CrateScope, render: Render) -> Iterator[str]:
    """Yield the words with named bits."""
    for subject in scope.subjects:
        if subject.point.form == "flags":
            text = render("rust/word.rs.j2", _word(subject))
            yield text + old_names_text(subject.name, subject.point.old_items, render)


def _word(subject: CratePoint) -> dict[str, object]:
    """Return a word of flags for its template; the bits are held in the unsigned type of the raw number's width.

    `all_false` is the word in which no flag is true, `printed` the lines that print the word.
    """
    all_flags, width = subject.point.flags, subject.point.info.bits
    bits, flags = f"u{width}", tuple(_flag(flag, width) for flag in all_flags)
    low = sum(1 << flag.low for flag in all_flags if flag.width == 1 and not flag.active)
    return {
        "doc": sentence(subject.item),
        "name": subject.name,
        "raw": subject.raw,
        "bits": bits,
        "all_false": mask(low, bits) if low else "0",
        "flags": flags,
        "printed": (*binding(4, Item("const NAME", "&'static str"), f'"{subject.name}"'), *_table(all_flags, flags)),
    }


def _table(flags: tuple[Flag, ...], views: tuple[View, ...]) -> tuple[str, ...]:
    """Return the constant that says how flags are printed, with the names of their numbers."""
    item = Item("const FLAGS", "&'static [runtime::Flag]")
    names, printed = list[str](), list[tuple[str, tuple[str, ...]]]()
    for place, (flag, view) in enumerate(zip(flags, views, strict=True)):
        named = (f"NAMES_{place}",) if view["numbers"] else ()
        if named:
            names += _names(named[0], flag)
        made = "named" if named else "active_low" if view["inverted"] else "new"
        printed.append((f"runtime::Flag::{made}", (view["name"], view["mask"], *named)))
    if not names:
        return calls(4, item, printed)
    return f"{item} = {{", *(f"    {line}" for line in (*names, *called(8, printed))), "};"


def _names(constant: str, flag: Flag) -> tuple[str, ...]:
    """Return the constant of the numbers of a flag that have names."""
    rows: list[tuple[str, tuple[str, ...]]] = [("", (integer(one.raw), rust_string(one.name))) for one in flag.values]
    return calls(8, Item(f"const {constant}", "runtime::Names"), rows)


def _entry(entry: Entry) -> View:
    """Return a variant of an enum with its number and its name in the description."""
    name, literal, text = variant_name(entry.name), integer(entry.raw), rust_string(entry.name)
    return {"doc": sentence(entry.name), "name": name, "literal": literal, "text": text}


def _flag(flag: Flag, width: int) -> View:
    """Return a flag: the constant of its mask, its getter and setter, its named `numbers` (doc, constant).

    `single` is True for one bit, `inverted` if this bit is 0 while the flag is true. `meaning` is its meaning, if the
    name alone does not say it.
    """
    raw, single, constant = f"u{width}", flag.width == 1, constant_name(flag)
    bits = mask_of(flag.width, flag.low)
    masked = "self.0" if bits == mask_of(width) else f"self.0 & Self::{constant}"
    numbers = []
    for value in () if single else flag.values:
        item = Item(f"pub const {flag.name.upper()}_{value.name.upper()}", raw)
        numbers.append((sentence(value.name), binding(4, item, integer(value.raw))))
    return {
        "name": rust_string(flag.name),
        "doc": sentence(flag.name),
        "meaning": ("" if flag.active else "True while the bit is 0.") if single else "A number.",
        "single": single,
        "inverted": single and not flag.active,
        "mask": mask(bits, raw),
        "constant": binding(4, Item(f"pub const {constant}", raw), mask(bits, raw)),
        "getter": getter_name(flag.name),
        "read": _read(flag, masked),
        "setter": signature(
            4, f"pub const fn with_{flag.name}", ("self", "state: bool" if single else f"number: {raw}"), "Self"
        ),
        "changed": _changed(flag, constant, whole=bits == mask_of(width)),
        "numbers": tuple(numbers),
    }


def _read(flag: Flag, masked: str) -> tuple[str, ...]:
    """Return the lines that get a flag from the masked word."""
    if flag.width == 1:
        return comparison(8, masked, "!= 0" if flag.active else "== 0")
    return (masked if flag.low == 0 else f"({masked}) >> {flag.low}",)


def _changed(flag: Flag, constant: str, *, whole: bool) -> tuple[str, ...]:
    """Return the lines that give the word with another `state` or `number` of a flag; `whole`: it has all bits."""
    if flag.width == 1:
        states = (f"Self(self.0 & !Self::{constant})", f"Self(self.0 | Self::{constant})")
        return "if state {", f"    {states[flag.active]}", "} else {", f"    {states[1 - flag.active]}", "}"
    if whole:
        return ("Self(number)",)
    placed = "number" if flag.low == 0 else f"(number << {flag.low})"
    return f"let mask = Self::{constant};", f"Self((self.0 & !mask) | ({placed} & mask))"
