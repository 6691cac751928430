"""The exported model: one JSON object per device for other tools; `schema.json` beside this file describes it.

Its shape changes only with its `format` number. JSON numbers are integers; every other exact number is text.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING

from fieldscribe.export.points import export_point, source_of
from fieldscribe.export.rules import ExportError
from fieldscribe.families import families, family

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from fieldscribe.export.rules import PointsByName
    from fieldscribe.model import Bus, Code, Command, Device, Document, Erratum, Frame, Group, Message, Point, Telegram

    Tasks = Callable[[Bus, Point], Sequence[tuple[str, int]]]
    """The purposes and functions that a family has for a point."""

FORMAT = 5
"""The version of the exported shape."""


def export_model(device: Device) -> dict[str, object]:
    """The device as plain dictionaries, lists, texts and integers, ready for `json.dumps`."""
    by_name: PointsByName = {name: point for point in device.points for name in (point.item, point.name)}
    directions = {telegram.name: telegram.direction for telegram in device.telegrams}
    tasks = getattr(family(device.family).part("bus_facts"), "tasks", None)
    return {
        "format": FORMAT,
        "device": device.id,
        "version": device.version,
        "family": device.family,
        "vendor": device.vendor,
        "model": device.model,
        "title": dict(device.title),
        "note": dict(device.note),
        "documents": [_document(document) for document in device.documents],
        "variants": {axis: list(values) for axis, values in device.variants.items()},
        "limits": _limits(device),
        "groups": [_group(group) for group in device.groups],
        "points": [_point(device, point, by_name, directions, tasks) for point in device.points],
        "commands": [_command(command) for command in device.commands],
        "messages": [_message(message) for message in device.messages],
        "telegrams": [_telegram(telegram) for telegram in device.telegrams],
        "frames": [_frame(frame, device.family) for frame in device.frames],
        "codes": _codes(device.bus),
        "errata": [_erratum(erratum) for erratum in device.errata],
    }


def export_form(form: str, device: Device, unit: int | None) -> bytes:
    """The device in a form that only some families have. Raises ExportError."""
    own_family = family(device.family)
    if form not in own_family.exports:
        takers = " and ".join(family.name for family in families() if form in family.exports)
        raise ExportError(f"a {form.upper()} is for {takers} devices, {device.id} is a {device.family} device")
    exported: bytes = own_family.part("bus_facts").export(form, device, unit)
    return exported


def _point(
    device: Device, point: Point, by_name: PointsByName, directions: Mapping[str, str], tasks: Tasks | None
) -> dict[str, object]:
    direction = None if point.telegram is None else directions.get(point.telegram)
    return export_point(point, by_name, direction, tasks(device.bus, point) if tasks else ())


def _document(document: Document) -> dict[str, object]:
    return {
        "id": document.id,
        "title": document.title,
        "language": document.language,
        "file": document.file,
        "sha256": document.sha256,
    }


def _limits(device: Device) -> dict[str, object]:
    """What the frames need to know, in the order of the schema; keys of other families stand there empty."""
    bus = device.bus
    limits: dict[str, object] = {
        "framings": list(bus.framings),
        "units": list(bus.units),
        "broadcast": bus.broadcast,
        "most": {str(function.number): function.most for function in bus.functions if function.most is not None},
        "gaps": {space: [list(gap) for gap in gaps] for space, gaps in bus.gaps.items()},
        "timing": dict(bus.timing),
        "note": dict(bus.note),
    }
    limits |= _own_facts("limits", device.family, bus)
    schema = json.loads(Path(__file__).with_name("schema.json").read_text("utf-8"))
    order = schema["$defs"]["limits"]["required"]
    return {key: limits.pop(key) for key in order} | limits


def _own_facts(kind: str, own_family: str, thing: object) -> dict[str, object]:
    """What families alone know of a thing; keys of other families stand there empty."""
    facts: dict[str, object] = {}
    for each_family in sorted(families(), key=lambda each_family: each_family.name == own_family):
        facts_of = getattr(each_family.part("bus_facts"), kind, None)
        if facts_of is not None:
            facts |= facts_of(thing if each_family.name == own_family else None)
    return facts


def _group(group: Group) -> dict[str, object]:
    return {
        "name": group.name,
        "title": dict(group.title),
        "note": dict(group.note),
        "source": source_of(group.source),
    }


def _command(command: Command) -> dict[str, object]:
    return {
        "name": command.name,
        "title": dict(command.title),
        "note": dict(command.note),
        "space": command.space,
        "address": command.address,
        "function": command.function,
        "value": command.value,
        "wears": command.wears,
        "busy": command.busy,
        "source": source_of(command.source),
    }


def _message(message: Message) -> dict[str, object]:
    return {
        "name": message.name,
        "title": dict(message.title),
        "direction": message.direction,
        "answers": message.answers,
        "identifier": message.identifier,
        "adds_unit": message.adds_unit,
        "layout": [{"holds": role.kind, "number": role.number} for role in message.roles],
        "source": source_of(message.source),
    }


def _telegram(telegram: Telegram) -> dict[str, object]:
    return {
        "name": telegram.name,
        "title": dict(telegram.title),
        "direction": telegram.direction,
        "words": telegram.words,
        "message": telegram.message,
        "source": source_of(telegram.source),
    }


def _frame(frame: Frame, own_family: str) -> dict[str, object]:
    return {
        "name": frame.name,
        "framing": frame.framing,
        "title": dict(frame.title),
        "bytes": frame.printed.hex(" ").upper(),
        "corrected": frame.corrected.hex(" ").upper(),
        "direction": frame.direction,
        "answers": frame.answers,
        "meaning": dict(frame.meaning),
        "valid": frame.valid,
        **dict(sorted(_own_facts("frame", own_family, frame).items())),
        "source": source_of(frame.source),
        "errata": list(frame.errata),
    }


def _codes(bus: Bus) -> dict[str, object]:
    return {
        "exceptions": {str(exception.number): _code(exception) for exception in bus.exceptions},
        "functions": {str(function.number): _code(function) for function in bus.functions},
        "responses": {str(response.number): _code(response) for response in bus.codes("responses")},
        "serial": {setting: dict(codes) for setting, codes in bus.serial.items()},
    }


def _code(code: Code) -> dict[str, object]:
    return {
        "name": code.name,
        "title": dict(code.title),
        "broadcast": code.broadcast,
        "answers": list(code.answers),
        "refusals": list(code.refusals),
    }


def _erratum(erratum: Erratum) -> dict[str, object]:
    return {
        "id": erratum.id,
        "point": erratum.points[0] if len(erratum.points) == 1 else list(erratum.points) or None,
        "where": str(erratum.where),
        "source": source_of(erratum.source),
        "printed": erratum.printed,
        "taken": erratum.taken,
        "reason": erratum.why,
        "certainty": erratum.certainty,
    }
