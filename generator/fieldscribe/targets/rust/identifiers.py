"""All identifiers of a generated crate by namespace, so that a check can find two things with one name."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.names import RUST_CONSTANTS, upper
from fieldscribe.targets.identifiers import Identifier, Owner
from fieldscribe.targets.rust.families import in_rust
from fieldscribe.targets.rust.literals import type_name, variant_name
from fieldscribe.targets.rust.subjects import Subject, scope_of
from fieldscribe.targets.rust.words import constant_name, getter_name

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Device


def identifiers(device: Device) -> Iterator[Identifier]:
    """Every identifier that the description decides; equal ones in one namespace clash."""
    scope = scope_of(device)
    for subject in scope.subjects:
        yield from _of_point(subject)
    for point in device.points:
        if point.raw_only:
            yield Identifier("Rust, points::documented", upper(point.item), Owner("point", point.item))
    for enum in device.enums:
        if enum.name in scope.enums:
            owner = Owner("enum", enum.name)
            yield Identifier("Rust, enums", type_name(enum.name), owner)
            for entry in enum.entries:
                part = Owner("enum", enum.name, f"entry {entry.name}")
                yield Identifier(f"Rust, enums::{enum.name}", variant_name(entry.name), part)
    for command in device.commands:
        yield Identifier("Rust, commands", command.name.upper(), Owner("command", command.name))
    for group in device.blocks:
        yield Identifier("Rust, blocks", group.upper(), Owner("group", group))
    for code in device.bus.exceptions:
        yield Identifier("Rust, exceptions", code.name.upper(), Owner("code", code.name))
    yield from in_rust(device.family).identifiers(device)


def _of_point(subject: Subject) -> Iterator[Identifier]:
    point, owner = subject.point, Owner("point", subject.point.item)
    own = f"Rust, points::{point.item}"
    yield Identifier("Rust, points", subject.name, owner)
    for old in point.was if point.variant is None else ():
        yield Identifier("Rust, points", type_name(old), owner._replace(part=f"old name {old}"))
    for name in RUST_CONSTANTS.intersection((*point.references, *(special.name for special in point.specials))):
        yield Identifier(own, name.upper(), Owner("target", f"the constant `{name.upper()}` of every point"))
    for key in point.references:
        yield Identifier(own, key.upper(), owner._replace(part=f"numbering {key}"))
    holder = f"Rust, special::{point.shared_codes}" if point.shared_codes else own
    codes = Owner("target", f"the special codes of {point.shared_codes}") if point.shared_codes else owner
    for special in point.specials:
        for end in ("",) if special.low == special.high else ("", "_LAST"):
            yield Identifier(holder, special.name.upper() + end, codes._replace(part=f"code {special.name}"))
    if subject.arguments:
        yield Identifier("Rust, with", subject.name, owner)
    if subject.factors and subject.factors != subject.arguments:
        yield Identifier("Rust, with", subject.factors_name, owner._replace(part="scale"))
    if point.flags:
        yield from _of_flags(subject)


def _of_flags(subject: Subject) -> Iterator[Identifier]:
    owner, space = Owner("point", subject.point.item), f"Rust, flags::{subject.point.item}"
    yield Identifier(space, "ALL_FALSE", Owner("target", "the constant `ALL_FALSE` of every word of flags"))
    for flag in subject.point.flags:
        named = owner._replace(part=f"flag {flag.name}")
        for name in (constant_name(flag), getter_name(flag.name), f"with_{flag.name}"):
            yield Identifier(space, name, named)
        for value in flag.values if flag.width > 1 else ():
            constant = f"{flag.name}_{value.name}".upper()
            yield Identifier(space, constant, named._replace(part=f"flag {flag.name}: {value.name}"))
