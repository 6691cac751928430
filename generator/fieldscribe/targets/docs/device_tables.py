"""The tables of a device other than those of points, for a page in any form: Markdown or HTML.

The bus section has functions, exceptions, messages, telegrams, serial settings, timing and commands.
"""

from collections.abc import Mapping
from functools import partial
from typing import Any, NamedTuple

from fieldscribe import wording
from fieldscribe.families import family
from fieldscribe.grouping import grouped
from fieldscribe.model import (
    Base,
    Bus,
    Code,
    Command,
    Device,
    Document,
    Erratum,
    Found,
    Frame,
    Identification,
    Message,
    Named,
    Point,
    Role,
    SteppedCommand,
    Telegram,
)
from fieldscribe.targets.docs.cells import Columns, DocsScope, Form, place_text
from fieldscribe.targets.docs.tables import items_of
from fieldscribe.text import counted
from fieldscribe.wording import address_text, title_text
from fieldscribe.wording.numbers import hex_text, spaced
from fieldscribe.wording.rules import run_text, steps_texts


def facts(device: Device, form: Form) -> str:
    """Return the table of the facts of the whole device."""
    generated = sum(point.generated for point in device.points)
    rows = [
        ("Device", form.code(device.id)),
        ("Version of the description", form.cell(device.version)),
        ("Family", form.cell(device.family)),
        ("Points", f"{len(device.points)}, {generated} of them generated"),
        ("Errata of the manual", str(len(device.errata))),
    ]
    rows += [
        (form.cell(f"Variants by {axis}"), form.cell(", ".join(values))) for axis, values in device.variants.items()
    ]
    return form.by_rows(("Fact", "Value"), rows)


def documents(device: Device, form: Form) -> str:
    """Return the table of the manuals."""
    columns: Columns[Document] = {
        "Document": lambda document: form.code(document.id),
        "Title": lambda document: form.cell(document.title),
        "Language": lambda document: form.cell(document.language),
        "File": lambda document: form.cell(document.file or ""),
        "SHA-256": lambda document: form.code(document.sha256) if document.sha256 else "",
    }
    return form.table(device.documents, columns)


def identifications(scope: DocsScope, form: Form) -> str:
    """Return the table of what identifies the device and its variants."""
    columns: Columns[Identification] = {
        "Of": lambda identification: form.cell(str(identification.variant or "the device")),
        "Point": lambda identification: form.narrow_link("point", identification.point),
        "Holds": lambda identification: form.lines(
            *(_meaning_of(scope.by_name[identification.point], raw, form) for raw in identification.raws),
            *map(form.code, identification.texts),
        ),
    }
    return form.table(scope.device.identifications, columns, always=columns)


def bases(device: Device, form: Form) -> str:
    """Return the table of the bases of addresses, with the numbers that a client is given."""
    given = {each.name: each for each in device.given}
    columns: Columns[Base] = {
        "Base": lambda base: form.cell(wording.base_text(base)),
        "Given": lambda base: form.lines(
            *(
                form.cell(f"{name}: {given[name].low}..{given[name].high}, {wording.title_text(given[name].title)}")
                for name, _ in base.terms
            )
        ),
        "Groups": lambda base: ", ".join(
            form.link("group", name)
            for name in dict.fromkeys(point.group for point in device.points if point.base == base.name)
        ),
    }
    return form.table(device.bases, columns, always=("Base", "Groups"))


def found(chain: Found | None, form: Form) -> str:
    """Return how to find the blocks; empty if there are none to find."""
    if chain is None:
        return ""
    places = ", ".join(map(wording.address_text, chain.places))
    return form.cell(
        f"{wording.title_text(chain.title)}: read {counted(len(chain.words), 'word')} of the space {chain.space} at "
        f"{places}, until the text there is {chain.marker}. Behind it stands the first block. A block starts with its "
        f"id and its length, the number of words behind these two; then comes the next block. The id "
        f"{hex_text(chain.end)} ends the chain. Addresses in a block count from its id."
    )


def frames(scope: DocsScope, form: Form) -> str:
    """Return the table of the frames that the manual prints."""
    columns: Columns[Frame] = {
        "Frame": lambda frame: form.lines(form.target("frame", frame.name), form.cell(wording.title_text(frame.title))),
        "Kind": lambda frame: form.lines(
            form.cell(f"{frame.framing} {frame.direction}"),
            f"answers {form.link('frame', frame.answers)}" if frame.answers else "",
        ),
        "Bytes": lambda frame: form.lines(
            form.code(spaced(frame.printed)), "" if frame.valid else f"correct: {form.code(spaced(frame.corrected))}"
        ),
        "Meaning": lambda frame: form.lines(
            *(_meaning(name, raw, scope.by_name, form) for name, raw in frame.meaning.items())
        ),
        "Errata": lambda frame: form.lines(*(form.link("erratum", erratum) for erratum in frame.errata)),
        "Source": lambda frame: form.source(frame.source, scope.several),
    }
    return form.table(scope.device.frames, columns, always=columns)


def _meaning(name: str, raw: int, by_name: Mapping[str, Point], form: Form) -> str:
    return f"{form.code(name)} = {_meaning_of(by_name.get(name), raw, form)}"


def _meaning_of(point: Point | None, raw: int, form: Form) -> str:
    meaning = wording.meaning_text(point, raw) if point else ""
    return f"{raw} ({form.cell(meaning)})" if meaning else str(raw)


def errata(device: Device, form: Form) -> str:
    """Return the table of the errata."""
    items = items_of(device)
    columns: Columns[Erratum] = {
        "Erratum, about": lambda erratum: form.lines(
            form.narrow_target("erratum", erratum.id),
            *(form.narrow_link("point", item) for name in erratum.points for item in items.get(name, ())),
            _where(erratum, form),
        ),
        "Printed": lambda erratum: form.cell(erratum.printed),
        "Taken": lambda erratum: form.cell(erratum.taken),
        "Why": lambda erratum: form.cell(erratum.why),
        "Certainty": lambda erratum: form.cell(_certainty(erratum)),
        "Source": lambda erratum: form.source(erratum.source, len(device.documents) > 1),
    }
    return form.table(device.errata, columns, always=columns)


def _certainty(erratum: Erratum) -> str:
    doubts = ", ".join(text for _, text in erratum.leaves_open)
    return f"{erratum.certainty}: the manual leaves open {doubts}" if doubts else erratum.certainty


def _where(erratum: Erratum, form: Form) -> str:
    """Return the subject of an erratum without points: a frame, a function, or a place in words."""
    match erratum.where:
        case Named("frame", str() as name):
            return f"frame {form.link('frame', name)}"
        case Named("function", int() as number):
            return f"function {hex_text(number, 2)}"
    return form.cell(str(erratum.where))


def missing(device: Device, form: Form) -> str:
    """Return the table of points that are only documented."""
    columns: Columns[Point] = {
        "Code": lambda point: form.cell(point.code or ""),
        "Name": lambda point: form.lines(form.link("point", point.item), form.cell(wording.title_text(point.title))),
        "Wire address": lambda point: place_text(point, form),
        "Why": lambda point: form.cell(point.reason or "no reason given"),
        "Errata": lambda point: ", ".join(form.link("erratum", erratum) for erratum in point.errata),
    }
    return form.table([point for point in device.points if not point.generated], columns)


def codes(device: Device, form: Form) -> str:
    """Return the table of special codes that points share, by the type, group or format that declares them."""
    sharing = grouped((point.specials_of, point) for point in device.points if point.shape.specials_of)
    rows = []
    for name, points in sharing.items():
        sharers = f"{form.target('codes', name)}: {counted(len(points), 'point')} of type {points[0].shape.wire_type}"
        for special in points[0].specials:
            if special.shared:
                numbers = wording.special_numbers(special, points[0].width)
                title, remarks = wording.title_text(special.title), wording.special_remarks(special)
                rows.append((sharers, numbers, form.code(special.name), form.cell(title), form.cell(remarks)))
                sharers = ""
    return form.by_rows(("Codes of", "Raw", "Name", "Title", "Remarks"), rows)


# The bus section.


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
    heading = "" if asks is None else f"{asks.kind.capitalize()}s"
    responses = _linked_codes(bus.codes("responses"), form)
    times = [(form.code(key), form.cell(value)) for key, value in bus.timing.items()]
    sections = (
        (heading, _answered(bus, form) if answered else _functions(device, form)),
        ("Responses", responses),
        ("Error values" if responses else "Exceptions", _linked_codes(bus.exceptions, form)),
        ("Messages", _messages(device, form)),
        ("Telegrams", _telegrams(device, form)),
        ("Serial settings", form.by_rows(("Setting", "Code", "Meaning"), serial)),
        ("Timing", form.by_rows(("Time", "Value"), times)),
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


def _linked_codes(codes: tuple[Code, ...], form: Form) -> str:
    return form.table(codes, {**_code_columns(form), "Tasks": lambda listed: _numbers(listed.answers)})


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
        "Source": lambda message: form.source(message.source, len(device.documents) > 1),
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
        "Source": lambda telegram: form.source(telegram.source, len(device.documents) > 1),
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
        "Source": lambda command: form.source(command.source, len(device.documents) > 1),
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
        "Source": lambda command: form.source(command.source, len(device.documents) > 1),
    }
    return form.table(device.stepped_commands, columns)
