"""What a description says, in the schema of the second readings (`readings/README.md`).

A fact that says nothing (no unit, no scale, all numbers that the type can hold) is left out, here and in the readings.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from fieldscribe.families import can, modbus, uss
from fieldscribe.model import Code, Command, Device, Frame, Message, Telegram

from support.second_reading_points import LONG, Facts, entries_of, of_point, place_of

Row = dict[str, Any]
"""A line of a reading: its kind, what tells it from the others of its kind, the line of the manual, the facts."""

NOTHING: tuple[object, ...] = (None, "", (), [], {}, False)


def described(device: Device) -> Iterator[Row]:
    """Every row that the reading of this device must have."""
    codes = {one.name: one.code or one.name for one in device.points}
    language = device.documents[0].language
    for point in device.points:
        yield _row("point", point.source.line, place_of(point), of_point(point, codes, language))
    for enum in {
        one.name: one for point in device.points if (one := point.named_numbers) and len(one.entries) > LONG
    }.values():
        yield _row("list", None, {"name": enum.name}, {"entries": entries_of(enum.entries, language)})
    for of in ("functions", "exceptions", "responses"):
        for code in device.bus.codes(of):
            yield _row("code", None, {"of": of, "number": code.number}, _of_code(code, language))
    for frame in device.frames:
        bytes_of = {"bytes": frame.printed.hex(" "), "direction": frame.direction}
        yield _row("frame", frame.source.line, bytes_of, _of_frame(frame))
    for command in device.commands:
        yield _row("command", command.source.line, {"name": command.name}, _of_command(command, language))
    for message in device.messages:
        yield _row("message", message.source.line, {"name": message.name}, _of_message(message, language))
    for telegram in device.telegrams:
        yield _row("telegram", telegram.source.line, {"name": telegram.name}, _of_telegram(telegram, language))
    for what, value in _of_bus(device).items():
        yield _row("bus", None, {"what": what}, {"value": value})


def notes(device: Device) -> Mapping[str, str]:
    """What is said in words, by where: the bus, a group, a point."""
    groups = {group.name: group.note.get("en", "") for group in device.groups}
    points = {point.name: f"{point.note.get('en', '')} {point.takes_effect or ''}" for point in device.points}
    return {"bus": device.bus.note.get("en", ""), **groups, **points}


def _row(kind: str, line: int | None, key: Row, facts: Facts) -> Row:
    there = {name: value for name, value in facts.items() if not _is_nothing(value)}
    return {"kind": kind, "line": line, **key, "facts": there}


def _is_nothing(value: object) -> bool:
    return any(value is one or (value == one and type(value) is type(one)) for one in NOTHING)


# What is no point


def _of_code(code: Code, language: str) -> Facts:
    return {
        "name": code.name,
        "title": code.title.get(language),
        "most": code.most,
        "unicast_only": code.broadcast is False,
        "answers": list(code.answers),
        "refusals": list(code.refusals),
    }


def _of_frame(frame: Frame) -> Facts:
    return {
        "name": frame.name,
        "framing": frame.framing,
        "answers": frame.answers,
        "corrected": "" if frame.valid else frame.corrected.hex(" "),
        "meaning": dict(frame.meaning),
        "pkw": uss.of_frame(frame).pkw,
        "can_id": can.identifier_of(frame),
    }


def _of_command(command: Command, language: str) -> Facts:
    return {
        "title": command.title.get(language),
        "space": command.space,
        "address": command.address,
        "function": command.function,
        "value": "any" if command.value is None else command.value,
        "wears": command.wears,
        "busy": command.busy,
    }


def _of_message(message: Message, language: str) -> Facts:
    return {
        "title": message.title.get(language),
        "direction": message.direction,
        "answers": message.answers,
        "can_id": message.identifier,
        "adds_unit": message.adds_unit,
        "bytes": [f"{one.kind} {one.number}" for one in message.roles],
    }


def _of_telegram(telegram: Telegram, language: str) -> Facts:
    return {
        "title": telegram.title.get(language),
        "direction": telegram.direction,
        "words": telegram.words,
        "message": telegram.message,
    }


def _of_bus(device: Device) -> Facts:
    bus, telegrams, frames = device.bus, uss.of_bus(device.bus), can.of_bus(device.bus)
    found = {
        "framings": list(bus.framings),
        "units": list(bus.units),
        "broadcast": bus.broadcast,
        "gaps": {space: [list(one) for one in gaps] for space, gaps in bus.gaps.items()},
        "pad_coil_bytes": modbus.of_bus(bus).pad_coil_bytes,
        "pkw": list(telegrams.pkw),
        "pzd": list(telegrams.pzd) if any(telegrams.pzd) else [],
        "pzd_of": {str(variant): most for variant, most in telegrams.variant_pzd},
        "bitrate": telegrams.bitrate or frames.bitrate,
        "identifier_bits": frames.identifier_bits,
        **{f"timing {name}": text for name, text in bus.timing.items()},
        **{f"serial {name}": dict(choices) for name, choices in bus.serial.items()},
        **{f"variants {axis}": list(values) for axis, values in device.variants.items()},
    }
    return {what: value for what, value in found.items() if not _is_nothing(value)}
