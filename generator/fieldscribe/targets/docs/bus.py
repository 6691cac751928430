"""The bus section: functions, exceptions, serial settings, timing, gaps and commands."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import Any

from fieldscribe.families import family
from fieldscribe.model import Bus, Code, Command, Device, Message, SteppedCommand, Telegram
from fieldscribe.targets.docs.cells import (
    LINE_BREAK,
    Columns,
    by_rows,
    cell,
    code,
    link,
    paragraph,
    source_cell,
    table,
    target,
)
from fieldscribe.wording import address_text, title_text
from fieldscribe.wording.exact import hex_text
from fieldscribe.wording.steps import run_text, steps_texts


@dataclass(frozen=True, slots=True)
class BusView:
    """The bus section of the page."""

    note: str
    facts: str
    sections: tuple[tuple[str, str], ...]
    """Headings with their tables."""


def bus_view(device: Device) -> BusView:
    """Return the bus section of a device."""
    bus, own_family = device.bus, family(device.family)
    facts_of = getattr(_bus_facts(device), "facts", lambda bus: [("Unit numbers", "{}..{}".format(*bus.units))])
    asks = next((section for section in own_family.codes if section.section == "functions"), None)
    answered = asks is not None and asks.belongs_to is not None
    serial = [
        (code(setting), cell(number), cell(meaning))
        for setting, codes in bus.serial.items()
        for number, meaning in codes.items()
    ]
    responses = _linked_codes(bus.codes("responses"), "Tasks")
    sections = (
        ("" if asks is None else f"{asks.kind.capitalize()}s", _answered(bus) if answered else _functions(device)),
        ("Responses", responses),
        ("Error values" if responses else "Exceptions", _linked_codes(bus.exceptions, "Tasks")),
        ("Messages", _messages(device)),
        ("Telegrams", _telegrams(device)),
        ("Serial settings", by_rows(("Setting", "Code", "Meaning"), serial)),
        ("Timing", by_rows(("Time", "Value"), [(code(key), cell(value)) for key, value in bus.timing.items()])),
        ("Commands", _commands(device)),
        ("Commands with steps", _stepped(device)),
    )
    return BusView(
        paragraph(title_text(bus.note)) if bus.note else "",
        by_rows(("Fact", "Value"), [(cell(label), cell(text)) for label, text in facts_of(bus)]),
        tuple((heading, table) for heading, table in sections if table),
    )


def _bus_facts(device: Device) -> Any:
    return family(device.family).part("bus_facts")


_CODE: Columns[Code] = {
    "Code": lambda listed: f"{hex_text(listed.number, 2)} ({listed.number})",
    "Name": lambda listed: code(listed.name),
    "Title": lambda listed: cell(title_text(listed.title)),
}


def _answered(bus: Bus) -> str:
    answers: Columns[Code] = {
        "Response": lambda function: _numbers(function.answers),
        "Response when refused": lambda function: _numbers(function.refusals),
    }
    return table(bus.functions, {**_CODE, **answers})


def _linked_codes(codes: tuple[Code, ...], head: str) -> str:
    return table(codes, {**_CODE, head: lambda listed: _numbers(listed.answers)})


def _numbers(numbers: tuple[int, ...]) -> str:
    return ", ".join(map(str, numbers))


def _messages(device: Device) -> str:
    """The table of messages, with a column for each byte."""
    count = max((len(message.roles) for message in device.messages), default=0)
    columns: Columns[Message] = {
        "Name": lambda message: target("message", message.name),
        "Title": lambda message: cell(title_text(message.title)),
        "Direction": lambda message: cell(message.direction),
        "Answers": lambda message: link("message", message.answers) if message.answers else "",
        f"{device.family.upper()} id": _identifier,
        "Bytes": lambda message: "" if message.roles else str(message.length),
        "Every": lambda message: "" if message.every is None else f"{message.every} ms",
        **{f"Byte {place}": partial(_role, place) for place in range(count)},
        "Source": lambda message: source_cell(message.source, len(device.documents) > 1),
    }
    return table(device.messages, columns)


def _identifier(message: Message) -> str:
    bits = "" if message.bits is None else f", {message.bits} bits"
    return hex_text(message.identifier, 3) + (" + unit" if message.adds_unit else "") + bits


def _role(place: int, message: Message) -> str:
    """What a byte of a message holds; nothing if it has signals."""
    if not message.roles:
        return ""
    role = message.roles[place]
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
    columns: Columns[Telegram] = {
        "Name": lambda telegram: target("telegram", telegram.name),
        "Title": lambda telegram: cell(title_text(telegram.title)),
        "Direction": lambda telegram: cell(telegram.direction),
        "Words": lambda telegram: str(telegram.words),
        "Message": lambda telegram: link("message", telegram.message) if telegram.message else "",
        "Source": lambda telegram: source_cell(telegram.source, len(device.documents) > 1),
    }
    carried = {message.name for message in device.messages if not message.roles}
    return table([telegram for telegram in device.telegrams if telegram.message not in carried], columns)


def _functions(device: Device) -> str:
    """The table of functions; it has a column about broadcast only if the device has a broadcast unit."""
    goes_to_all = getattr(_bus_facts(device), "goes_to_all", lambda _: False)

    def broadcast(function: Code) -> str:
        allowed = goes_to_all(function) if function.broadcast is None else function.broadcast
        return "" if device.bus.broadcast is None else "yes" if allowed else "no"

    most: Columns[Code] = {
        "Most items in one request": lambda function: "" if function.most is None else str(function.most)
    }
    return table(device.bus.functions, {**_CODE, **most, "Broadcast": broadcast})


def _commands(device: Device) -> str:
    columns: Columns[Command] = {
        "Name": lambda command: target("command", command.name),
        "Title": lambda command: cell(title_text(command.title)),
        "Space": lambda command: cell(command.space),
        "Wire address": lambda command: address_text(command.address),
        "Function": lambda command: hex_text(command.function, 2),
        "Value": lambda command: "any" if command.value is None else str(command.value),
        "Memory stands": lambda command: "" if command.wears is None else f"{command.wears} writes",
        "Busy while": lambda command: cell(command.busy or ""),
        "Note": lambda command: cell(title_text(command.note)) if command.note else "",
        "Source": lambda command: source_cell(command.source, len(device.documents) > 1),
    }
    return table(device.commands, columns)


def _stepped(device: Device) -> str:
    points = {point.name: point for point in device.points}
    columns: Columns[SteppedCommand] = {
        "Name": lambda command: target("command", command.name),
        "Title": lambda command: cell(title_text(command.title)),
        "Given": lambda command: cell(run_text(command)),
        "Steps": lambda command: LINE_BREAK.join(
            cell(f"{number}. {text}") for number, text in enumerate(steps_texts(command, points), 1)
        ),
        "Note": lambda command: cell(title_text(command.note)) if command.note else "",
        "Source": lambda command: source_cell(command.source, len(device.documents) > 1),
    }
    return table(device.stepped_commands, columns)
