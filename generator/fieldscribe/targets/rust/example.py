"""The first page of a crate: what a client does with points that this device has, as code that compiles."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.targets.rust.layout import filled
from fieldscribe.targets.rust.literals import float_literal, value_name

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from fieldscribe.model import Device
    from fieldscribe.targets.rust.families import OfFamily
    from fieldscribe.targets.rust.layout import Lines
    from fieldscribe.targets.rust.subjects import CratePoint, CrateScope

_VALUED = ("scaled", "ruled")
_ALWAYS = ("points as p", "Client", "ClientError", "Transport", "PROFILE")


@dataclass(frozen=True, slots=True)
class Snippet:
    """Lines of an example, and the items of the crate that they name beside those that every example names."""

    lines: Lines = ()
    names: frozenset[str] = frozenset()

    def __add__(self, other: Snippet) -> Snippet:
        return Snippet(self.lines + other.lines, self.names | other.names)


def example_of(device: Device, scope: CrateScope) -> Snippet:
    """What a function that talks to the device does; nothing if no point is read by itself alone."""
    asked = _asked(scope)
    read = _first(one for one in _plain(asked) if one.form == "scaled") or _first(_plain(asked))
    if read is None:
        return Snippet()
    first = Snippet((f"let value = client.read::<p::{read.name}>()?;", 'println!("it is {value:?}");'))
    return first + _writes(asked) + _special(asked) + _blocks(device, asked) + _command(device)


def first_program(device: Device, scope: CrateScope, family: OfFamily, link: str) -> Lines:
    """A whole program over a transport of the runtime; nothing if there is none, or no point read by itself alone."""
    asked = _asked(scope)
    only_read = (subject for subject in _plain(asked) if subject.form == "scaled" and not subject.point.writable)
    read = _first(only_read) or _first(_plain(asked))
    line = family.line(device)
    if read is None or not line:
        return ()
    names = ("points as p", f"runtime::transports::{family.line_names}", "Client", *family.names, "PROFILE")
    written = _first(subject for subject in asked if not subject.arguments and _takes_a_value(subject))
    return (
        *filled(f"use {device.id}::{{", ", ", names, "};"),
        "",
        "fn main() -> Result<(), Box<dyn std::error::Error>> {",
        f"    let line = {line};",
        f"    let mut client = Client::new(line, &PROFILE, {link});",
        f'    println!("{{:?}}", client.read::<p::{read.name}>()?);',
        *((f"    client.write::<p::{written.name}>({_inside(written)})?;",) if written else ()),
        "    Ok(())",
        "}",
    )


def example_uses(device: str, snippet: Snippet, names: Sequence[str]) -> Lines:
    """What the example imports: what each does, the family's `names`, and what its lines name."""
    named = sorted((*_ALWAYS, *names, *snippet.names), key=lambda name: (name[0].isupper(), name))
    return filled(f"use {device}::{{", ", ", named, "};")


def _asked(scope: CrateScope) -> list[CratePoint]:
    """Points outside of telegrams, the lowest address first, so that a new point rarely takes an example over."""
    return sorted((one for one in scope.subjects if one.point.telegram is None), key=lambda one: one.point.rank)


def _writes(asked: list[CratePoint]) -> Snippet:
    """A point that needs no other, and one that does."""
    snippet = Snippet()
    plain = _first(one for one in asked if not one.arguments and _takes_a_value(one))
    if plain is not None:
        snippet += Snippet((f"client.write::<p::{plain.name}>({_inside(plain)})?;",))
    needy = _first(one for one in asked if one.arguments and _takes_a_value(one) and one.point.readable)
    if needy is not None:
        fields = ", ".join(f"{value_name(name)}: 1" for name in needy.arguments)
        lines = (
            "// What the scale and the limits need: raw numbers of other points, as `read_raw` gives them.",
            f"let with = with::{needy.name} {{ {fields} }};",
            f"client.write_with::<p::{needy.name}>(1.0, with)?;",
        )
        snippet += Snippet(lines, frozenset(("with",)))
    return snippet


def _plain(asked: Iterable[CratePoint]) -> Iterator[CratePoint]:
    """Points that are read by themselves alone."""
    return (one for one in asked if one.point.readable and not one.factors and not one.point.specials)


def _takes_a_value(one: CratePoint) -> bool:
    point = one.point
    encodes = point.writable and point.encodes_values and not point.bits and not point.specials
    return encodes and one.form in _VALUED


def _inside(subject: CratePoint) -> str:
    """A modest value that the point takes, a tenth of the way up: people run first programs on real machines."""
    low, high = subject.point.outer
    rule = subject.shape.rule
    if rule is None:
        return "1.0"
    least = max(low, 0) if high > 0 else low
    value = (least + (high - least) // 10 - rule.offset) / rule.ratio
    whole = low <= round(value) * rule.ratio + rule.offset <= high
    return float_literal(float(round(value) if whole else value))


def _special(asked: list[CratePoint]) -> Snippet:
    """A point whose reading may be a special code."""
    coded = _first(one for one in asked if one.point.specials and one.point.readable and not one.factors)
    if coded is None:
        return Snippet()
    lines = (
        f"match client.read::<p::{coded.name}>()? {{",
        '    Reading::Value(value) => println!("it is {value:?}"),',
        '    Reading::Special(code) => println!("no quantity: {code}"),',
        "}",
    )
    return Snippet(lines, frozenset(("Reading",)))


def _blocks(device: Device, asked: list[CratePoint]) -> Snippet:
    """The reads of a group, and a point that they bring."""
    for one in asked:
        for group, blocks in device.blocks.items():
            if one.point.readable and not one.factors and any(one.point.name in block.points for block in blocks):
                lines = (
                    f"for block in blocks::{group.upper()} {{",
                    "    let reply = client.read_block(block)?;",
                    f"    if block.brings::<p::{one.name}>() {{",
                    f'        println!("it is {{:?}}", reply.value::<p::{one.name}>()?);',
                    "    }",
                    "}",
                )
                return Snippet(lines, frozenset(("blocks",)))
    return Snippet()


def _command(device: Device) -> Snippet:
    """The first command of the device."""
    lines = tuple(f"client.command(&commands::{command.name.upper()})?;" for command in device.commands[:1])
    return Snippet(lines, frozenset(("commands",) if lines else ()))


def _first(found: Iterable[CratePoint]) -> CratePoint | None:
    return next(iter(found), None)
