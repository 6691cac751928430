"""The exported model: one JSON object per device that tools outside rely on (`schema.json` beside this describes it).

It changes only with its `format` number. JSON numbers are integers; every other exact number is text.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fieldscribe.export.points import export_point, source_of
from fieldscribe.export.rules import ExportError
from fieldscribe.families import families, family

if TYPE_CHECKING:
    from collections.abc import Mapping

    from fieldscribe.export.rules import PointsByName
    from fieldscribe.model import Bus, Code, Command, Device, Document, Erratum, Frame, Message, Point, Telegram

FORMAT = 3
"""The number of this contract."""


def export_model(device: Device) -> dict[str, object]:
    """The device as plain dictionaries, lists, texts and integers, ready for `json.dumps`. Raises ExportError."""
    by_name: PointsByName = {name: point for point in device.points for name in (point.item, point.name)}
    directions = {telegram.name: telegram.direction for telegram in device.telegrams}
    return {
        "format": FORMAT,
        "device": device.id,
        "version": device.version,
        "family": device.family,
        "documents": [_document(one) for one in device.documents],
        "variants": {axis: list(values) for axis, values in device.variants.items()},
        "limits": _limits(device),
        "points": [_point(device, point, by_name, directions) for point in device.points],
        "commands": [_command(one) for one in device.commands],
        "messages": [_message(one) for one in device.messages],
        "telegrams": [_telegram(one) for one in device.telegrams],
        "frames": [_frame(one) for one in device.frames],
        "codes": _codes(device.bus),
        "errata": [_erratum(one) for one in device.errata],
    }


def export_form(form: str, device: Device, unit: int | None) -> bytes:
    """The device in a form that only some families have. Raises ExportError."""
    own = family(device.family)
    if form not in own.exports:
        takers = " and ".join(one.name for one in families() if form in one.exports)
        raise ExportError(f"a {form.upper()} is for {takers} devices, {device.id} is a {device.family} device")
    made: bytes = own.part("export").export(form, device, unit)
    return made


def _point(device: Device, point: Point, by_name: PointsByName, directions: Mapping[str, str]) -> dict[str, object]:
    direction = None if point.telegram is None else directions.get(point.telegram)
    own: Any = family(device.family).part("export")
    places = own.places(device.bus, point) if hasattr(own, "places") else None
    return export_point(point, by_name, direction, places)


def _document(document: Document) -> dict[str, object]:
    return {
        "id": document.id,
        "title": document.title,
        "language": document.language,
        "file": document.file,
        "sha256": document.sha256,
    }


def _limits(device: Device) -> dict[str, object]:
    """What the frames need to know, in the order of the contract; what a family does not have stands for nothing."""
    bus = device.bus
    found: dict[str, object] = {
        "framings": list(bus.framings),
        "units": list(bus.units),
        "broadcast": bus.broadcast,
        "most": {str(one.number): one.most for one in bus.functions if one.most is not None},
        "gaps": {space: [list(gap) for gap in gaps] for space, gaps in bus.gaps.items()},
        "timing": dict(bus.timing),
    }
    for one in sorted(families(), key=lambda one: one.name == device.family):
        part: Any = one.part("export")
        if part is not None:
            found |= part.limits(bus if one.name == device.family else None)
    schema = json.loads(Path(__file__).with_name("schema.json").read_text("utf-8"))
    order = schema["$defs"]["limits"]["required"]
    return {key: found.pop(key) for key in order} | found


def _command(command: Command) -> dict[str, object]:
    return {
        "name": command.name,
        "title": dict(command.title),
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
        "can_id": message.identifier,
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


def _frame(frame: Frame) -> dict[str, object]:
    return {
        "name": frame.name,
        "bytes": frame.printed.hex(" ").upper(),
        "direction": frame.direction,
        "meaning": dict(frame.meaning),
        "valid": frame.valid,
    }


def _codes(bus: Bus) -> dict[str, object]:
    return {
        "exceptions": {str(one.number): _code(one) for one in bus.exceptions},
        "functions": {str(one.number): _code(one) for one in bus.functions},
        "responses": {str(one.number): _code(one) for one in bus.codes("responses")},
        "serial": {setting: dict(codes) for setting, codes in bus.serial.items()},
    }


def _code(code: Code) -> dict[str, object]:
    return {
        "name": code.name,
        "title": dict(code.title),
        "answers": list(code.answers),
        "refusals": list(code.refusals),
    }


def _erratum(erratum: Erratum) -> dict[str, object]:
    return {
        "id": erratum.id,
        "point": erratum.points[0] if len(erratum.points) == 1 else list(erratum.points) or None,
        "where": erratum.where,
        "source": source_of(erratum.source),
        "printed": erratum.printed,
        "taken": erratum.taken,
        "reason": erratum.why,
        "certainty": erratum.certainty,
    }
