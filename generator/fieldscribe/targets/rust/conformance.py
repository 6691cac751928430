"""The view of the conformance program: for each kind of vector, what runs it for each point."""

from __future__ import annotations

from collections.abc import Iterator

from fieldscribe.model import Device, Point
from fieldscribe.targets.rust.literals import raw_type, type_name, value_name
from fieldscribe.targets.rust.points import Scope, scope_of
from fieldscribe.text import rust_string

_PLAIN = ("integer", "enum", "flags", "bit")


Table = tuple[str, str, tuple[str, ...]]
"""The function that a table becomes, the runner's function behind it, and its rows."""


def conformance_tables(device: Device) -> tuple[Table, ...]:
    """The tables by kind; rows are tokens that the runner's macro reads."""
    scope = scope_of(device)
    points = [point for point in device.points if point.generated]
    plain = [point for point in points if not _mixed(point, scope)]
    mixed = [point for point in points if _mixed(point, scope)]
    alone = [(point, f"{rust_string(point.item)} {type_name(point.item)} (alone)") for point in points]
    return (
        ("decode", "decode", tuple(_rows(points, ("scaled", "float"), read=True))),
        ("encode", "encode", tuple(_rows(points, ("scaled", "float"), read=False))),
        ("decode_count", "decode_count", tuple(_rows(points, ("scaled",), read=True))),
        ("decode_plain", "decode_plain", tuple(_rows(plain, _PLAIN, read=True))),
        ("decode_mixed", "decode_count", tuple(_rows(mixed, _PLAIN, read=True))),
        ("encode_count", "encode_count", tuple(_rows(points, ("scaled",), read=False))),
        ("encode_plain", "encode_plain", tuple(_rows(plain, _PLAIN, read=False))),
        ("encode_mixed", "encode_count", tuple(_rows(mixed, _PLAIN, read=False))),
        ("check", "check", tuple(_rows(points, (*_PLAIN, "scaled"), read=False))),
        ("name", "name", tuple(_names(points, scope))),
        ("special", "special", tuple(_specials(points))),
        ("flag", "flag", tuple(_flags(points))),
        ("bits", "bits", tuple(row for point, row in alone if point.bits)),
        ("words", "words", tuple(row for point, row in alone if point.words > 1)),
        ("address", "address", tuple(row for _, row in alone)),
    )


def _rows(points: list[Point], forms: tuple[str, ...], *, read: bool) -> Iterator[str]:
    for point in points:
        if point.form in forms and (point.readable if read else point.writable):
            name = type_name(point.item)
            names = point.scale_arguments if read else point.arguments
            struct = f"{name}Factors" if read and point.scale_arguments != point.arguments else name
            fields = " ".join(f"{value_name(one)} {rust_string(one)}" for one in names)
            yield f"{rust_string(point.item)} {name} ({f'{struct}: {fields}' if names else ''})"


def _mixed(point: Point, scope: Scope) -> bool:
    """Whether points of several raw types share the point's enum."""
    return point.form == "enum" and point.enum is not None and scope.enums[point.enum.name] != raw_type(point)


def _names(points: list[Point], scope: Scope) -> Iterator[str]:
    for point in points:
        if point.enum is not None and point.form == "enum":
            yield f"{rust_string(point.item)} {type_name(point.enum.name)} (enum {scope.enums[point.enum.name]})"


def _specials(points: list[Point]) -> Iterator[str]:
    for point in points:
        for one in point.specials:
            kind = "one" if one.low == one.high else "several"
            yield f"{rust_string(f'{point.item} {one.name}')} {type_name(point.item)} ({kind} {one.name.upper()})"


def _flags(points: list[Point]) -> Iterator[str]:
    for point in points:
        if point.form != "flags":
            continue
        for flag in point.flags:
            # The getter is the one that the view of the word names.
            convert = flag.name.startswith(("from_", "as_", "into_", "to_"))
            getter = value_name(f"get_{flag.name}" if convert else flag.name)
            how = ("on" if flag.active else "off") if flag.width == 1 else "bits"
            name = rust_string(f"{point.item} {flag.name}")
            yield f"{name} {type_name(point.item)} ({how} {raw_type(point)} {getter} with_{flag.name})"
