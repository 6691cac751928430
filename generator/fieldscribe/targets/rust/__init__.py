"""The Rust target: a `no_std` crate per device, one for its vectors, their identifiers, and a small runtime crate."""

from collections.abc import Iterable, Iterator

from fieldscribe.model import Device, Enum, Special
from fieldscribe.resources import Render, runtime_files
from fieldscribe.targets.identifiers import Names, Owner
from fieldscribe.targets.rust.enums import UNKNOWN, constant_name, getter_name
from fieldscribe.targets.rust.literals import RESERVED, type_name, variant_name
from fieldscribe.targets.rust.scope import CratePoint, in_rust, scope_of
from fieldscribe.text import upper

_SOURCES = ("points", "enums", "flags", "with")

CONSTANTS = frozenset(
    {"name", "code", "space", "address", "base", "words", "width", "unit", "raw_min", "raw_max", "shift", "mask"}
    | {"decimals", "display_decimals", "read_function", "write_function", "write_address", "access", "group", "info"}
    | {"telegram", "index", "addresses", "numbers", "fixed_bits", "fixed_mask", "is_grouped", "codes", "floating"}
    | {"low_byte_first", "coded", "is_closed", "is_contiguous", "is_wide", "raw_reach", "scale", "facts", "epoch"}
    | {"selects", "span", "written_with"}
)
"""Associated constants of the point traits, which a constant of the description could hide; a test compares them."""

_CRATES = frozenset({"alloc", "core", "proc_macro", "std", "test"})

FAMILY_PART = "targets.rust"
WEIGHT = 0.6


def outputs(device: Device, render: Render, *, tests: bool = True) -> Iterable[tuple[str, str]]:
    """Yield the files of the crate and of the one that tests it: path below the output folder, and text."""
    from fieldscribe.targets.rust.device import device_context, texts_of

    scope = scope_of(device)
    context = device_context(device, scope, render)
    folder = f"rust/{device.id}"
    yield f"{folder}/Cargo.toml", render("rust/Cargo.toml.j2", context)
    yield f"{folder}/README.md", render("rust/README.md.j2", context)
    yield f"{folder}/src/lib.rs", render(f"rust/{device.family}.rs.j2", context)
    for name in (*_SOURCES, *(("special",) if context["codes"] else ())):
        texts = texts_of(name, device, scope, render)
        yield f"{folder}/src/{name}.rs", render(f"rust/{name}.rs.j2", {**context, **texts})
    if tests:
        from fieldscribe.targets.rust.conformance import arms, conformance_tables

        tables = conformance_tables(scope, device)
        suite = {**context, "tables": tables, "arms": dict(arms(tables))}
        yield f"{folder}/conformance/Cargo.toml", render("rust/conformance.toml.j2", context)
        yield f"{folder}/conformance/tests/conformance.rs", render(f"rust/{device.family}_conformance.rs.j2", suite)


def runtime(device: Device, *, tests: bool = True) -> Iterator[tuple[str, str]]:
    """Yield the source files of the crates that they need: path below the output folder, and below the templates."""
    del device
    for crate in ("fieldscribe_runtime", *(("fieldscribe_conformance",) if tests else ())):
        for name in runtime_files(f"rust/runtime/{crate}"):
            yield f"rust/{crate}/{name}", f"rust/runtime/{crate}/{name}"


def device_name_taken(name: str) -> str:
    """Return why no crate may have that name; empty if it may."""
    if name in RESERVED:
        return "is a word that Rust reserves, so that no program could name its crate"
    return "is a crate of Rust's own, which the generated crate would hide" if name in _CRATES else ""


def identifiers(device: Device) -> Iterator[Names]:
    """Yield every identifier that depends on the description, by namespace."""
    scope = scope_of(device)
    for subject in scope.subjects:
        yield from _of_point(subject)
    for enum in device.enums:
        if enum.name in scope.enums:
            yield from _of_enum(enum)
    for module, kind, names in (
        ("points::documented", "point", [point.item for point in device.points if point.raw_only]),
        ("commands", "command", [command.name for command in device.commands]),
        ("bases", "base", _bases(device)),
        ("stepped_commands", "command", [command.name for command in device.stepped_commands]),
        ("blocks", "group", [*device.blocks]),
        ("exceptions", "exception", [code.name for code in device.bus.exceptions]),
    ):
        yield from (Names(f"Rust, module `{module}`", Owner(kind, name), (upper(name),)) for name in names)
    yield from in_rust(device.family).identifiers(device)


def _bases(device: Device) -> list[str]:
    """Return the names of all constants for bases and found blocks."""
    found = [] if device.found is None else [f"{device.found.name}{tail}" for tail in ("", "_marker", "_places")]
    return found + [
        f"{base.name}{tail}" for base in device.bases for tail in (("", "_given") if base.block is None else ("",))
    ]


def _of_enum(enum: Enum) -> Iterator[Names]:
    owner, space = Owner("enum", enum.name), f"Rust, the enum `{enum.name}`"
    yield Names("Rust, module `enums`", owner, tuple(map(type_name, (enum.name, *enum.was))))
    for entry in enum.entries:
        yield Names(space, Owner("entry", entry.name, owner), (variant_name(entry.name),))
    if {variant_name(entry.name) for entry in enum.entries}.issuperset(UNKNOWN):
        yield Names(space, Owner("target", "a number without a name"), UNKNOWN[:1])


def _of_point(subject: CratePoint) -> Iterator[Names]:
    point, owner = subject.point, Owner("point", subject.item)
    yield Names("Rust, module `points`", owner, (subject.name,))
    for old, item in zip(point.was, point.old_items, strict=True):
        old_name = Owner("old name", old, owner)
        yield Names("Rust, module `points`", old_name, (type_name(item),))
        if point.arguments:
            yield Names("Rust, module `with`", old_name, (type_name(item),))
        if subject.factors_name:
            yield Names("Rust, module `with`", old_name, (type_name(f"{item}_factors"),))
    if point.references or point.specials:
        yield from _constants(subject, owner)
    if point.arguments:
        yield Names("Rust, module `with`", owner, (subject.name,))
    if subject.factors_name:
        yield Names("Rust, module `with`", Owner("struct", subject.factors_name, owner), (subject.factors_name,))
    if point.flags:
        yield from _of_flags(subject, owner)


def _constants(subject: CratePoint, owner: Owner) -> Iterator[Names]:
    """Yield the constants that the description names for a point, and those of every point that they could hide."""
    point, namespace = subject.point, f"Rust, the point `{subject.item}`"
    for name in (*point.references, *(special.name for special in point.specials)):
        if name in CONSTANTS:
            yield Names(namespace, Owner("target", f"the constant `{upper(name)}` of every point"), (upper(name),))
    if CONSTANTS.isdisjoint(point.references):
        yield Names(namespace, owner, [*map(upper, point.references)])
    else:
        for key in point.references:
            yield Names(namespace, Owner("numbering", key, owner), (upper(key),))
    if point.shared_codes:
        yield from _shared_codes(subject)
        return
    for special in point.specials:
        yield Names(namespace, Owner("code", special.name, owner), _code_names(special))


def _shared_codes(subject: CratePoint) -> Iterator[Names]:
    """Yield the type of special codes that many points share, with its constants and its table."""
    name = subject.point.shared_codes
    owner, space = Owner("special codes", name), f"Rust, the special codes `{name}`"
    yield Names("Rust, module `special`", owner, (type_name(name),))
    yield Names(space, Owner("target", "the table `CODES` of all special codes"), ("CODES",))
    for special in subject.point.specials:
        yield Names(space, Owner("code", special.name, owner), _code_names(special))


def _code_names(special: Special) -> tuple[str, ...]:
    name = upper(special.name)
    return (name,) if special.low == special.high else (name, f"{name}_LAST")


def _of_flags(subject: CratePoint, owner: Owner) -> Iterator[Names]:
    space = f"Rust, the flags of `{subject.item}`"
    yield Names(space, Owner("target", "the constant `ALL_FALSE` of every word of flags"), ("ALL_FALSE",))
    for flag in subject.point.flags:
        named = Owner("flag", flag.name, owner)
        yield Names(space, named, (constant_name(flag), getter_name(flag.name), f"with_{flag.name}"))
        for value in flag.values if flag.width > 1 else ():
            yield Names(space, Owner("value", value.name, named), (f"{flag.name}_{value.name}".upper(),))
