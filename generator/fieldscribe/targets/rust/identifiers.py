"""All identifiers of a generated crate by namespace, so that a check can find two things with one name."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.targets.rust.families import family_identifiers
from fieldscribe.targets.rust.literals import type_name
from fieldscribe.targets.rust.subjects import Subject, scope_of
from fieldscribe.targets.rust.words import constant_name, getter_name

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Device

Identifier = tuple[str, str, str]
"""Namespace, identifier, and what in the description it stands for."""


def identifiers(device: Device) -> Iterator[Identifier]:
    """Every identifier that the description decides; equal ones in one namespace clash."""
    scope = scope_of(device)
    for subject in scope.subjects:
        yield from _of_point(subject)
    for enum in device.enums:
        if enum.name in scope.enums:
            yield "enums", type_name(enum.name), f"enum {enum.name}"
            for entry in enum.entries:
                yield f"enums::{enum.name}", type_name(entry.name), f"entry {entry.name} of enum {enum.name}"
    for command in device.commands:
        yield "commands", command.name.upper(), f"command {command.name}"
    for group in device.blocks:
        yield "blocks", group.upper(), f"group {group}"
    for code in device.bus.exceptions:
        yield "exceptions", code.name.upper(), f"exception {code.name}"
    yield from family_identifiers(device)


def _of_point(subject: Subject) -> Iterator[Identifier]:
    item, own = subject.point.item, f"point {subject.point.name}"
    yield "points", subject.name, own
    for old in subject.point.was:
        yield "points", type_name(old), f"former name {old} of {own}"
    for key in subject.point.references:
        yield f"points::{item}", key.upper(), f"numbering {key} of {own}"
    holder = f"special::{subject.point.shared_codes}" if subject.point.shared_codes else f"points::{item}"
    for special in subject.point.specials:
        ends = ("",) if special.low == special.high else ("", "_LAST")
        for end in ends:
            yield holder, special.name.upper() + end, f"special {special.name} of {holder}"
    if subject.arguments:
        yield "with", subject.name, own
    if subject.factors and subject.factors != subject.arguments:
        yield "with", f"{subject.name}Factors", f"the scale of {own}"
    if subject.point.flags:
        yield f"flags::{item}", "ALL_FALSE", f"nothing true in {own}"
    for flag in subject.point.flags:
        named = f"flag {flag.name} of {own}"
        yield f"flags::{item}", constant_name(flag), named
        yield f"flags::{item}", getter_name(flag.name), named
        yield f"flags::{item}", f"with_{flag.name}", named
        for value in flag.values if flag.width > 1 else ():
            yield f"flags::{item}", f"{flag.name}_{value.name}".upper(), f"{value.name} of {named}"
