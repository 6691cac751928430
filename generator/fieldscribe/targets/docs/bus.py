"""The bus section: functions, exceptions, serial settings, timing, gaps and commands."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from fieldscribe.families import family
from fieldscribe.model import Bus, Code, Device, Role
from fieldscribe.targets.docs.cells import by_rows, cell, code, link, paragraph, source_cell, target
from fieldscribe.wording import address_text, title_text
from fieldscribe.wording.exact import hex_text


@dataclass(frozen=True, slots=True)
class BusView:
    """The bus section of the page."""

    note: str
    facts: str
    sections: tuple[tuple[str, str], ...]
    """Headings with their tables."""


def bus_view(device: Device) -> BusView:
    """Return the bus section of a device."""
    bus, own_family, part = device.bus, family(device.family), part_of(device)
    asks = next((section for section in own_family.codes if section.section == "functions"), None)
    answered = asks is not None and asks.belongs_to is not None
    serial = [
        (code(setting), cell(number), cell(meaning))
        for setting, codes in bus.serial.items()
        for number, meaning in codes.items()
    ]
    responses = _linked_codes(bus.codes("responses"), "Tasks")
    sections = (
        ("" if asks is None else f"{asks.kind.capitalize()}s", _answered(bus) if answered else _functions(bus, part)),
        ("Responses", responses),
        ("Error values" if responses else "Exceptions", _linked_codes(bus.exceptions, "Tasks")),
        ("Messages", _messages(device)),
        ("Telegrams", _telegrams(device)),
        ("Serial settings", by_rows(("Setting", "Code", "Meaning"), serial)),
        ("Timing", by_rows(("Time", "Value"), [(code(key), cell(value)) for key, value in bus.timing.items()])),
        ("Commands", _commands(device)),
    )
    return BusView(
        paragraph(title_text(bus.note)) if bus.note else "",
        by_rows(("Fact", "Value"), [(cell(label), cell(text)) for label, text in part.facts(bus)]),
        tuple((heading, table) for heading, table in sections if table),
    )


def part_of(device: Device) -> OfFamily:
    """Return what the family of a device knows about its bus."""
    return OfFamily(family(device.family).part("bus_facts"))


class OfFamily:
    """What the part `bus_facts` of a family defines of these functions, and defaults for the others."""

    def __init__(self, part: object) -> None:
        for name in ("facts", "goes_to_all", "numbers"):
            if hasattr(part, name):
                setattr(self, name, getattr(part, name))

    def facts(self, bus: Bus) -> Iterator[tuple[str, str]]:
        """Yield label and text of each fact about the line."""
        yield "Unit numbers", "{}..{}".format(*bus.units)

    def goes_to_all(self, function: Code) -> bool:
        """Return True if a function may be broadcast where the description does not say so."""
        del function
        return False

    def numbers(self, space: str, address: int) -> Mapping[str, int]:
        """Return the numbers that people use for an address in this family, by numbering."""
        del space, address
        return {}


def _answered(bus: Bus) -> str:
    rows = [(*_code(function), _numbers(function.answers), _numbers(function.refusals)) for function in bus.functions]
    return by_rows(("Code", "Name", "Title", "Response", "Response when refused"), rows)


def _linked_codes(codes: tuple[Code, ...], head: str) -> str:
    return by_rows(("Code", "Name", "Title", head), [(*_code(listed), _numbers(listed.answers)) for listed in codes])


def _numbers(numbers: tuple[int, ...]) -> str:
    return ", ".join(map(str, numbers))


def _messages(device: Device) -> str:
    """The table of messages, with a column for each byte."""
    rows = [
        (
            target("message", message.name),
            cell(title_text(message.title)),
            cell(message.direction),
            link("message", message.answers) if message.answers else "",
            hex_text(message.identifier, 3) + (" + unit" if message.adds_unit else ""),
            *(_role(role) for role in message.roles),
            source_cell(message.source, len(device.documents) > 1),
        )
        for message in device.messages
    ]
    bytes_heads = (f"Byte {place}" for place in range(len(device.messages[0].roles) if device.messages else 0))
    return by_rows(
        ("Name", "Title", "Direction", "Answers", f"{device.family.upper()} id", *bytes_heads, "Source"), rows
    )


def _role(role: Role) -> str:
    part = "high" if role.number == 8 else "low"
    if role.kind in ("address", "raw"):
        return f"{role.kind} {part}"
    if role.kind == "word":
        return f"word {role.number // 2 + 1} {'low' if role.number & 1 else 'high'}"
    if role.kind == "xor":
        places = [str(place) for place in range(role.number.bit_length()) if role.number >> place & 1]
        return f"XOR of bytes {', '.join(places)}"
    return hex_text(role.number, 2) if role.kind == "constant" else role.kind


def _telegrams(device: Device) -> str:
    rows = [
        (
            target("telegram", telegram.name),
            cell(title_text(telegram.title)),
            cell(telegram.direction),
            str(telegram.words),
            link("message", telegram.message) if telegram.message else "",
            source_cell(telegram.source, len(device.documents) > 1),
        )
        for telegram in device.telegrams
    ]
    return by_rows(("Name", "Title", "Direction", "Words", "Message", "Source"), rows)


def _functions(bus: Bus, part: OfFamily) -> str:
    """The table of functions; it has a column about broadcast only if the device has a broadcast unit."""
    heads: tuple[str, ...] = ("Code", "Name", "Title", "Most items in one request")
    rows = [(*_code(function), "" if function.most is None else str(function.most)) for function in bus.functions]
    if bus.broadcast is None:
        return by_rows(heads, rows)
    taken = [
        part.goes_to_all(function) if function.broadcast is None else function.broadcast for function in bus.functions
    ]
    answers = ["yes" if yes else "no" for yes in taken]
    return by_rows((*heads, "Broadcast"), [(*row, answer) for row, answer in zip(rows, answers, strict=True)])


def _code(listed: Code) -> tuple[str, str, str]:
    return f"{hex_text(listed.number, 2)} ({listed.number})", code(listed.name), cell(title_text(listed.title))


def _commands(device: Device) -> str:
    rows = [
        (
            target("command", command.name),
            cell(title_text(command.title)),
            cell(command.space),
            address_text(command.address),
            hex_text(command.function, 2),
            "any" if command.value is None else str(command.value),
            "" if command.wears is None else f"{command.wears} writes",
            cell(command.busy or ""),
            cell(title_text(command.note)) if command.note else "",
            source_cell(command.source, len(device.documents) > 1),
        )
        for command in device.commands
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
