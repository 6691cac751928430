"""The bus section: functions, exceptions, serial settings, timing, gaps and commands."""

from functools import partial
from typing import Any, NamedTuple

from fieldscribe.families import family
from fieldscribe.model import Bus, Code, Command, Device, Message, Role, SteppedCommand, Telegram
from fieldscribe.targets.docs.cells import Columns, Form
from fieldscribe.wording import address_text, title_text
from fieldscribe.wording.exact import hex_text
from fieldscribe.wording.rules import run_text, steps_texts


class BusView(NamedTuple):
    """The bus section of the page."""

    note: str
    facts: str
    sections: tuple[tuple[str, str], ...]
    """Headings with their tables."""


def bus_view(device: Device, form: Form) -> BusView:
    """Return the bus section of a device."""
    bus, own_family = device.bus, family(device.family)
    facts_of = getattr(_bus_facts(device), "facts", lambda bus: [("Unit numbers", "{}..{}".format(*bus.units))])
    asks = next((section for section in own_family.codes if section.section == "functions"), None)
    answered = asks is not None and asks.belongs_to is not None
    serial = [
        (form.code(setting), form.cell(number), form.cell(meaning))
        for setting, codes in bus.serial.items()
        for number, meaning in codes.items()
    ]
    responses = _linked_codes(bus.codes("responses"), "Tasks", form)
    sections = (
        (
            "" if asks is None else f"{asks.kind.capitalize()}s",
            _answered(bus, form) if answered else _functions(device, form),
        ),
        ("Responses", responses),
        ("Error values" if responses else "Exceptions", _linked_codes(bus.exceptions, "Tasks", form)),
        ("Messages", _messages(device, form)),
        ("Telegrams", _telegrams(device, form)),
        ("Serial settings", form.by_rows(("Setting", "Code", "Meaning"), serial)),
        (
            "Timing",
            form.by_rows(("Time", "Value"), [(form.code(key), form.cell(value)) for key, value in bus.timing.items()]),
        ),
        ("Commands", _commands(device, form)),
        ("Commands with steps", _stepped(device, form)),
    )
    return BusView(
        form.paragraph(title_text(bus.note)) if bus.note else "",
        form.by_rows(("Fact", "Value"), [(form.cell(label), form.cell(text)) for label, text in facts_of(bus)]),
        tuple((heading, table) for heading, table in sections if table),
    )


def _bus_facts(device: Device) -> Any:
    return family(device.family).part("bus_facts")


def _code_columns(form: Form) -> Columns[Code]:
    return {
        "Code": lambda listed: f"{hex_text(listed.number, 2)} ({listed.number})",
        "Name": lambda listed: form.code(listed.name),
        "Title": lambda listed: form.cell(title_text(listed.title)),
    }


def _answered(bus: Bus, form: Form) -> str:
    answers: Columns[Code] = {
        "Response": lambda function: _numbers(function.answers),
        "Response when refused": lambda function: _numbers(function.refusals),
    }
    return form.table(bus.functions, {**_code_columns(form), **answers})


def _linked_codes(codes: tuple[Code, ...], head: str, form: Form) -> str:
    return form.table(codes, {**_code_columns(form), head: lambda listed: _numbers(listed.answers)})


def _numbers(numbers: tuple[int, ...]) -> str:
    return ", ".join(map(str, numbers))


def _messages(device: Device, form: Form) -> str:
    """Return the table of messages, with a column for each byte."""
    count = max((len(message.roles) for message in device.messages), default=0)
    columns: Columns[Message] = {
        "Name": lambda message: form.target("message", message.name),
        "Title": lambda message: form.cell(title_text(message.title)),
        "Direction": lambda message: form.cell(message.direction),
        "Answers": lambda message: form.link("message", message.answers) if message.answers else "",
        f"{device.family.upper()} id": identifier_text,
        "Bytes": lambda message: "" if message.roles else str(message.length),
        "Every": lambda message: "" if message.every is None else f"{message.every} ms",
        **{f"Byte {place}": partial(_role, place) for place in range(count)},
        "Source": lambda message: form.source_cell(message.source, len(device.documents) > 1),
    }
    return form.table(device.messages, columns)


def identifier_text(message: Message) -> str:
    """Return the identifier of a message, with its bits."""
    bits = "" if message.bits is None else f", {message.bits} bits"
    return hex_text(message.identifier, 3) + (" + unit" if message.adds_unit else "") + bits


def _role(place: int, message: Message) -> str:
    """Return what a byte of a message holds; empty if the message has signals."""
    return role_text(message.roles[place]) if message.roles else ""


def role_text(role: Role) -> str:
    """Return what a byte with that role holds."""
    part = "high" if role.number == 8 else "low"
    if role.kind in ("address", "raw"):
        return f"{role.kind} {part}"
    if role.kind == "word":
        return f"word {role.number // 2 + 1} {'low' if role.number & 1 else 'high'}"
    if role.kind == "xor":
        places = [str(place) for place in range(role.number.bit_length()) if role.number >> place & 1]
        return f"XOR of bytes {', '.join(places)}"
    return hex_text(role.number, 2) if role.kind == "constant" else role.kind


def _telegrams(device: Device, form: Form) -> str:
    columns: Columns[Telegram] = {
        "Name": lambda telegram: form.target("telegram", telegram.name),
        "Title": lambda telegram: form.cell(title_text(telegram.title)),
        "Direction": lambda telegram: form.cell(telegram.direction),
        "Words": lambda telegram: str(telegram.words),
        "Message": lambda telegram: form.link("message", telegram.message) if telegram.message else "",
        "Source": lambda telegram: form.source_cell(telegram.source, len(device.documents) > 1),
    }
    carried = {message.name for message in device.messages if not message.roles}
    return form.table([telegram for telegram in device.telegrams if telegram.message not in carried], columns)


def _functions(device: Device, form: Form) -> str:
    """Return the table of functions, with a column about broadcast only if the device has a broadcast unit."""
    goes_to_all = getattr(_bus_facts(device), "goes_to_all", lambda _: False)

    def broadcast(function: Code) -> str:
        allowed = goes_to_all(function) if function.broadcast is None else function.broadcast
        return "" if device.bus.broadcast is None else "yes" if allowed else "no"

    most: Columns[Code] = {
        "Most items in one request": lambda function: "" if function.most is None else str(function.most)
    }
    return form.table(device.bus.functions, {**_code_columns(form), **most, "Broadcast": broadcast})


def _commands(device: Device, form: Form) -> str:
    columns: Columns[Command] = {
        "Name": lambda command: form.target("command", command.name),
        "Title": lambda command: form.cell(title_text(command.title)),
        "Space": lambda command: form.cell(command.space),
        "Wire address": lambda command: address_text(command.address),
        "Function": lambda command: hex_text(command.function, 2),
        "Value": lambda command: "any" if command.value is None else str(command.value),
        "Memory rated for": lambda command: "" if command.wears is None else f"{command.wears} writes",
        "Busy while": lambda command: form.cell(command.busy or ""),
        "Note": lambda command: form.cell(title_text(command.note)) if command.note else "",
        "Source": lambda command: form.source_cell(command.source, len(device.documents) > 1),
    }
    return form.table(device.commands, columns)


def _stepped(device: Device, form: Form) -> str:
    points = {point.name: point for point in device.points}
    columns: Columns[SteppedCommand] = {
        "Name": lambda command: form.target("command", command.name),
        "Title": lambda command: form.cell(title_text(command.title)),
        "Given": lambda command: form.cell(run_text(command)),
        "Steps": lambda command: form.line_break.join(
            form.cell(f"{number}. {text}") for number, text in enumerate(steps_texts(command, points), 1)
        ),
        "Note": lambda command: form.cell(title_text(command.note)) if command.note else "",
        "Source": lambda command: form.source_cell(command.source, len(device.documents) > 1),
    }
    return form.table(device.stepped_commands, columns)
