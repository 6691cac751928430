"""Explains what is not a point: commands, errata, frames, and addresses that the manual closes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe import wording
from fieldscribe.conversation.exchanges import find_exchanges
from fieldscribe.conversation.explanation import Explanation
from fieldscribe.conversation.units import find_units
from fieldscribe.pasted_numbers import number_of
from fieldscribe.text import line
from fieldscribe.wording.exact import hex_text

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Command, Device, Erratum, Source

Answer = tuple[list[str], Explanation]
"""How the question was understood, and the answer."""


def explain_others(device: Device, what: str) -> list[Answer]:
    """Every meaning of a name or a wire address that is not a point."""
    prefix, colon, rest = what.strip().partition(":")
    if colon and prefix.strip().lower() == "unit":
        return [([reading], _clean(heading, rows)) for reading, heading, rows in find_units(device, rest.strip())]
    return list(_others(device, what.strip()))


def _others(device: Device, what: str) -> Iterator[Answer]:
    prefix, colon, rest = what.partition(":")
    forced = prefix.strip().lower() if colon else ""
    asked = rest.strip() if colon else what
    number = number_of(asked) if forced in ("", "wire") else None
    for command in device.commands:
        if forced in ("", "name") and asked.lower() == command.name:
            yield [f"command {command.name}"], _command(command)
        elif number is not None and number == command.address:
            yield [f"wire address {wording.address_text(number)}, {command.space}"], _command(command)
    for erratum in device.errata:
        if forced in ("", "name") and asked.lower() == erratum.id:
            yield [f"erratum {erratum.id}"], _erratum(erratum)
    for reading, heading, rows in find_exchanges(device, what):
        yield [reading], _clean(heading, rows)
    for space, gaps in device.bus.gaps.items():
        for low, high in gaps:
            if number is not None and low <= number <= high:
                yield [f"wire address {wording.address_text(number)}, {space}"], _gap(space, low, high)


def _clean(heading: str, rows: list[tuple[str, str]]) -> Explanation:
    return Explanation(line(heading), tuple((label, line(text)) for label, text in rows if text))


def _command(command: Command) -> Explanation:
    value = "any value" if command.value is None else f"{command.value} ({hex_text(command.value)})"
    where = f"{command.space} {wording.address_text(command.address)}"
    return _clean(
        f"command {command.name}: {wording.title_text(command.title)}",
        [
            ("Write", f"{value} to {where}, function {hex_text(command.function, 2)}"),
            ("Memory", f"stands {command.wears} writes" if command.wears else ""),
            ("Busy", f"while {command.busy} is set" if command.busy else ""),
            ("Note", wording.title_text(command.note) if command.note else ""),
            ("Source", _source(command.source)),
        ],
    )


def _erratum(erratum: Erratum) -> Explanation:
    return _clean(
        f"erratum {erratum.id} ({erratum.certainty})",
        [
            ("About", ", ".join(erratum.points) or str(erratum.where)),
            ("Printed", erratum.printed),
            ("Taken", erratum.taken),
            ("Why", erratum.why),
            ("Source", _source(erratum.source)),
        ],
    )


def _gap(space: str, low: int, high: int) -> Explanation:
    where = f"{wording.address_text(low)} to {wording.address_text(high)}"
    return _clean(
        f"{space} {where}: closed",
        [("Meaning", "the manual gives these addresses no meaning; no request may reach across them")],
    )


def _source(source: Source) -> str:
    parts = [source.document, source.section or "", f"page {source.page}" if source.page else ""]
    parts.append("" if source.line is None else f"line {source.line} of its text")
    return ", ".join(part for part in parts if part)
