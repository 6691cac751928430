"""The bus section: functions, exceptions, serial settings, timing, gaps and commands."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.families.modbus import BROADCAST
from fieldscribe.targets.docs.cells import Table, by_rows, cell, code, paragraph, source_text, target
from fieldscribe.wording import address_text, title_text
from fieldscribe.wording.exact import hex_text

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
        functions=_functions(bus),
        exceptions=by_rows(("Code", "Name", "Title"), [_code(one) for one in bus.exceptions]),
        serial=by_rows(("Setting", "Code", "Meaning"), serial),
        timing=by_rows(("Time", "Value"), [(code(key), cell(value)) for key, value in bus.timing.items()]),
        commands=_commands(device),
    )


def _facts(bus: Bus) -> list[tuple[str, str]]:
    rows = [
        ("Framing", cell(", ".join(bus.framings))),
        ("Unit numbers", f"{bus.units[0]}..{bus.units[1]}"),
        ("Broadcast", "none" if bus.broadcast is None else f"unit {bus.broadcast}, not answered"),
    ]
    if bus.pad_coil_bytes:
        rows.append(("Data bytes when coils are written", cell(f"padded to an {bus.pad_coil_bytes} number")))
    for space, gaps in bus.gaps.items():
        spans = ", ".join(f"{address_text(low)} to {address_text(high)}" for low, high in gaps)
        rows.append((cell(f"No request may cross ({space})"), spans))
    return rows


def _functions(bus: Bus) -> Table | None:
    """The functions, with the column about broadcast only where there is a unit for it."""
    heads: tuple[str, ...] = ("Code", "Name", "Title", "Most items in one request")
    rows = [(*_code(one), "" if one.most is None else str(one.most)) for one in bus.functions]
    if bus.broadcast is None:
        return by_rows(heads, rows)
    taken = [one.number in BROADCAST if one.broadcast is None else one.broadcast for one in bus.functions]
    answers = ["yes" if yes else "no" for yes in taken]
    return by_rows((*heads, "Broadcast"), [(*row, answer) for row, answer in zip(rows, answers, strict=True)])


def _code(one: Code) -> tuple[str, str, str]:
    return f"{hex_text(one.number, 2)} ({one.number})", code(one.name), cell(title_text(one.title))


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
