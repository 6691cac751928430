"""The view of a whole device: points, enums, words of flags, and the description of the crate."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from collections.abc import Set as AbstractSet

from fieldscribe import wording
from fieldscribe.model import Device, Point, Version
from fieldscribe.resources import Render
from fieldscribe.targets.identifiers import head_lines
from fieldscribe.targets.rust.enums import enum_texts, word_texts
from fieldscribe.targets.rust.layout import Item, Lines, binding, filled, left_out, wrapped
from fieldscribe.targets.rust.literals import float_literal, integer
from fieldscribe.targets.rust.point_facts import shared_codes
from fieldscribe.targets.rust.point_macros import point_texts
from fieldscribe.targets.rust.scope import CratePoint, CrateScope, RustFamily, Snippet, in_rust, space
from fieldscribe.targets.rust.value_forms import argument_structs
from fieldscribe.text import markdown, rust_code, rust_string, toml_string, upper


def head(device: Device, comment: str) -> str:
    """Return the head of a generated file; `comment` begins its comments."""
    return "\n".join(f"{comment} {line}" for line in head_lines(device, "rust"))


def _raw_only(point: Point) -> tuple[str, Lines]:
    """Return a point that is reached raw only: its item, and the lines of its constant."""
    index = "None" if point.index is None else f"Some({point.index})"
    where = f"{space(point.space)}, 0x{point.address or 0:04X}, {point.words}, {index}"
    item = Item(f"pub const {upper(point.item)}", "runtime::Documented")
    return point.item, binding(4, item, f"runtime::Documented::new({where})")


def _identifications(device: Device, scope: CrateScope) -> Iterator[str]:
    """Yield the rows of what identifies the device and its variants."""
    names = {subject.point.name: subject.name for subject in scope.subjects}
    for identification in device.identifications:
        variant = identification.variant
        axis = "" if variant is None else f" of {rust_string(variant.axis)} {rust_string(variant.value)}"
        held = [
            *(f"Raw {integer(raw)}" for raw in identification.raws),
            *(f"Text {rust_string(text)}" for text in identification.texts),
        ]
        yield from (f"{names[identification.point]}{axis} holds {each};" for each in held)


def texts_of(source: str, device: Device, scope: CrateScope, render: Render) -> dict[str, object]:
    """Return the context of a single source: texts of points, enums or words of flags, made as it is written."""
    if source == "points":
        points, names_runtime = point_texts(scope, render)
        return {"points": points, "uses_runtime": names_runtime}
    if source == "enums":
        return {"enums": "".join(enum_texts(device, scope, render))}
    return {"words": "".join(word_texts(scope, render))} if source == "flags" else {}


def device_context(device: Device, scope: CrateScope, render: Render) -> dict[str, object]:
    """Return the context of the templates for the crate's sources."""
    words = [subject for subject in scope.subjects if subject.point.form == "flags"]
    first_word = min(words, key=lambda subject: subject.point.rank).name if words else ""
    structs = tuple(argument_structs(scope, render))
    version = Version.of(device.version)
    read = {str(struct["name"]) for struct in structs if struct["read"]}
    of_family, example = in_rust(device.family), example_of(device, scope, read)
    telegram, received = of_family.telegram(scope)
    family_context = of_family.context(device)
    return {
        "head": head(device, "//"),
        "table": tuple(subject.name for subject in scope.subjects),
        "identifications": tuple(_identifications(device, scope)),
        "left_out": left_out(device, scope.lowered),
        "doubts": [tuple(wrapped(text)) for text in wording.open_texts(device.doubts, rust_code)],
        "raw_only": tuple(map(_raw_only, (point for point in device.points if point.raw_only))),
        "codes": tuple(shared_codes(scope)),
        "first_word": first_word,
        "structs": structs,
        "client_parameter": "{0}: super::{2}".format(*of_family.client_parameter) if of_family.client_parameter else "",
        "example": example.lines,
        "telegram": telegram,
        "received": received.lines,
        "example_uses": example_uses(device.id, example + received, of_family.names),
        "example_unit": device.bus.units[0],
        "uses_enums": any(enum.name in scope.enums for enum in device.enums),
        "uses_flags": bool(first_word),
        "uses_with": bool(structs),
        "device_type": scope.device_type,
        "clients": tuple(_clients(device, of_family.client_parameter, scope.device_type)),
        "title": rust_code(f"{device.vendor} {device.model}"),
        "id": device.id,
        "id_literal": rust_string(device.id),
        "version": rust_string(device.version),
        "version_parts": [(name, upper(name), integer(number)) for name, number in version._asdict().items()],
        "version_number": integer(version.number),
        "digest_literal": rust_string(device.digest),
        "package_head": head(device, "#"),
        "head_lines": head(device, "").replace("\n ", "\n")[1:],
        "version_toml": toml_string(device.version),
        "description_toml": toml_string(f"{device.vendor} {device.model}: points, exact conversions and frames"),
        "title_markdown": markdown(f"{device.vendor} {device.model}"),
        "transports": of_family.transports,
        "first_program": first_program(device, scope, of_family, str(family_context["example_link"])),
        "family": device.family,
        **family_context,
    }


_CLIENTS = (
    ("Client", "that blocks"),
    ("AsyncClient", "that does not block"),
    ("LocalClient", "of one thread, which does not block"),
)


def _clients(device: Device, parameter: tuple[str, str, str] | None, of_type: str) -> Iterator[tuple[str, Lines]]:
    """Yield the comment and the lines of each type of client of the device."""
    name, default, _ = parameter or ("", "", "")
    declared, given = (f"T, {name} = {default}", f"T, {name}") if parameter else ("T", "T")
    for name, kind in _CLIENTS:
        remembers = f", runtime::{device.family}::Remembers" if device.selecting else ""
        client = f"runtime::{device.family}::{name}<{given}, {of_type}{remembers}>"
        yield f"A device behind a transport {kind}.", binding(0, Item(f"pub type {name}<{declared}>"), client)


_ALWAYS = ("points as p", "Client", "ClientError", "Transport")


def example_of(device: Device, scope: CrateScope, read: AbstractSet[str]) -> Snippet:
    """Return the body of a function that talks to the device; empty if no point is read without others.

    `read` are the structs of raw numbers that clients read.
    """
    candidates = _candidates(scope)
    plain = _first(candidates, _is_quantity) or _first(candidates, _is_plain)
    if plain is None:
        return Snippet()
    first = Snippet((f"let value = client.read::<p::{plain.name}>()?;", 'println!("it is {value:?}");'))
    return first + _writes(candidates, read) + _special(candidates) + _blocks(device, candidates) + _command(device)


def first_program(device: Device, scope: CrateScope, family: RustFamily, link: str) -> Lines:
    """Return a whole program over a transport of the runtime; empty without a transport or a point to read."""
    candidates = _candidates(scope)
    only_read = (subject for subject in candidates if _is_quantity(subject) and not subject.point.writable)
    read = next(only_read, None) or _first(candidates, _is_plain)
    line = family.line(device)
    if read is None or not line:
        return ()
    names = ("points as p", f"runtime::transports::{family.line_names}", "Client", *family.names)
    written = _first(candidates, _is_set)
    return (
        *filled(f"use {device.id}::{{", ", ", names, "};"),
        "",
        "fn main() -> Result<(), Box<dyn std::error::Error>> {",
        f"    let line = {line};",
        f"    let mut client = Client::new(line, {link});",
        f'    println!("{{:?}}", client.read::<p::{read.name}>()?);',
        *((f"    {_write(written)}",) if written else ()),
        "    Ok(())",
        "}",
    )


def example_uses(device: str, snippet: Snippet, names: Sequence[str]) -> Lines:
    """Return the imports of an example: those of every example, the family's `names`, and those of its lines."""
    named = sorted((*_ALWAYS, *names, *snippet.names), key=lambda name: (name[0].isupper(), name))
    return filled(f"use {device}::{{", ", ", named, "};")


def _candidates(scope: CrateScope) -> list[CratePoint]:
    """Return the points outside of telegrams by address, so that a new point rarely changes the example."""
    outside = (subject for subject in scope.subjects if subject.point.telegram is None)
    return sorted(outside, key=lambda subject: subject.point.rank)


def _first(candidates: Iterable[CratePoint], test: Callable[[CratePoint], bool]) -> CratePoint | None:
    return next(filter(test, candidates), None)


def _is_read(subject: CratePoint) -> bool:
    return subject.point.readable and not subject.point.scale_arguments


def _is_plain(subject: CratePoint) -> bool:
    return _is_read(subject) and not subject.point.specials


def _is_quantity(subject: CratePoint) -> bool:
    return subject.point.form == "scaled" and _is_plain(subject)


def _is_set(subject: CratePoint) -> bool:
    return _takes_a_value(subject) and not subject.point.arguments


def _takes_a_value(subject: CratePoint) -> bool:
    point = subject.point
    encodes = point.writable and point.encodes_values and not point.bits and not point.specials
    return encodes and point.form == "scaled"


def _writes(candidates: list[CratePoint], read: AbstractSet[str]) -> Snippet:
    """Return the lines that write a point that needs no other, and one that does."""
    plain, takers = _first(candidates, _is_set), filter(_takes_a_value, candidates)
    needy = next((subject for subject in takers if subject.point.readable and subject.name in read), None)
    lines = () if plain is None else (_write(plain),)
    if needy is None:
        return Snippet(lines)
    with_others = (
        "// What the scale and the limits need: raw numbers of other points.",
        f"let with = with::{needy.name}::read(client)?;",
        f"client.write_with::<p::{needy.name}>(1.0, with)?;",
    )
    return Snippet(lines + with_others, frozenset(("with",)))


def _write(subject: CratePoint) -> str:
    return f"client.write::<p::{subject.name}>({_inside(subject)})?;"


def _inside(subject: CratePoint) -> str:
    """Return a modest value for the point, a tenth of the way up: people run first programs on real machines."""
    low, high = subject.point.outer
    rule = subject.point.fixed_scale
    if rule is None:
        return "1.0"
    least = max(low, 0) if high > 0 else low
    value = (least + (high - least) // 10 - rule.offset) / rule.ratio
    whole = low <= round(value) * rule.ratio + rule.offset <= high
    return float_literal(float(round(value) if whole else value))


def _special(candidates: list[CratePoint]) -> Snippet:
    """Return the lines that read a point that may hold a special code."""
    coded = next((subject for subject in filter(_is_read, candidates) if subject.point.specials), None)
    if coded is None:
        return Snippet()
    lines = (
        f"match client.read::<p::{coded.name}>()? {{",
        '    Reading::Value(value) => println!("it is {value:?}"),',
        '    Reading::Special(code) => println!("no quantity: {code}"),',
        "}",
    )
    return Snippet(lines, frozenset(("Reading",)))


def _blocks(device: Device, candidates: list[CratePoint]) -> Snippet:
    """Return the lines that read a group, and print a point of it."""
    brought = (
        (subject, group)
        for subject in filter(_is_read, candidates)
        for group, blocks in device.blocks.items()
        if any(subject.point.name in block.points for block in blocks)
    )
    subject, group = next(brought, (None, ""))
    if subject is None:
        return Snippet()
    lines = (
        f"for block in blocks::{group.upper()} {{",
        "    let reply = client.read_block(block)?;",
        f"    if block.brings::<p::{subject.name}>() {{",
        f'        println!("it is {{:?}}", reply.value::<p::{subject.name}>()?);',
        "    }",
        "}",
    )
    return Snippet(lines, frozenset(("blocks",)))


def _command(device: Device) -> Snippet:
    """Return the line that sends the first command of the device."""
    lines = tuple(f"client.command(&commands::{command.name.upper()})?;" for command in device.commands[:1])
    return Snippet(lines, frozenset(("commands",) if lines else ()))
