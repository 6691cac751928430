"""The bus section: functions, exceptions, serial settings, timing, gaps and commands."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.exact import hex_text
from fieldscribe.targets.docs.cells import Table, by_rows, cell, code, paragraph, source_text, target
from fieldscribe.wording import address_text, title_text

if TYPE_CHECKING:
    from fieldscribe.model import Bus, Code, Device


@dataclass(frozen=True, slots=True)
class BusView:
    """What the page says of the line."""

    note: str
    facts: Table | None
    functions: Table | None
    exceptions: Table | None
    serial: Table | None
    timing: Table | None
    commands: Table | None


def bus_view(device: Device) -> BusView:
    """The bus section of a device."""
    bus = device.bus
    serial = [
        (code(setting), cell(number), cell(meaning))
        for setting, codes in bus.serial.items()
        for number, meaning in codes.items()
    ]
    return BusView(
        note=paragraph(title_text(bus.note)) if bus.note else "",
        facts=by_rows(("Fact", "Value"), _facts(bus)),
        functions=_codes(bus.functions, "Most items in one request"),
        exceptions=_codes(bus.exceptions, ""),
        serial=by_rows(("Setting", "Code", "Meaning"), serial),
        timing=by_rows(("Time", "Value"), [(code(key), cell(value)) for key, value in bus.timing.items()]),
        commands=_commands(device),
    )


def _facts(bus: Bus) -> list[tuple[str, str]]:
    rows = [
        ("Framing", cell(", ".join(bus.framings))),
        ("Unit numbers", f"{bus.units[0]}..{bus.units[1]}"),
        ("Broadcast", "none" if bus.broadcast is None else f"unit {bus.broadcast}, writes only, not answered"),
    ]
    if bus.pad_coil_bytes:
        rows.append(("Data bytes when coils are written", cell(f"padded to an {bus.pad_coil_bytes} number")))
    for space, gaps in bus.gaps.items():
        spans = ", ".join(f"{address_text(low)} to {address_text(high)}" for low, high in gaps)
        rows.append((cell(f"No request may cross ({space})"), spans))
    return rows


def _codes(codes: tuple[Code, ...], limit: str) -> Table | None:
    rows = [
        (
            f"{hex_text(one.number, 2)} ({one.number})",
            code(one.name),
            cell(title_text(one.title)),
            "" if one.most is None else str(one.most),
        )
        for one in codes
    ]
    return by_rows(("Code", "Name", "Title", limit), rows)


def _commands(device: Device) -> Table | None:
    rows = [
        (
            target("command", one.name),
            cell(title_text(one.title)),
            cell(one.space),
            address_text(one.address),
            hex_text(one.function, 2),
            "any" if one.value is None else str(one.value),
            "" if one.wears is None else f"{one.wears} writes",
            cell(one.busy or ""),
            cell(title_text(one.note)) if one.note else "",
            cell(source_text(one.source, len(device.documents) > 1)),
        )
        for one in device.commands
    ]
    heads = (
        "Name",
        "Title",
        "Space",
        "Wire address",
        "Function",
        "Value",
        "Memory stands",
        "Busy while",
        "Note",
        "Source",
    )
    return by_rows(heads, rows)
