"""What a description says, in the schema of the second readings (`readings/README.md`).

A fact that says nothing (no unit, no scale, all numbers that the type can hold) is left out, here and in the readings.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from fieldscribe.model import (
        Bound,
        Code,
        Command,
        Device,
        Entry,
        Enum,
        Factor,
        Flag,
        Frame,
        Linear,
        Message,
        Point,
        Special,
        Telegram,
    )

Facts = dict[str, Any]
Row = dict[str, Any]
"""A line of a reading: its kind, what tells it from the others of its kind, the line of the manual, the facts."""

LONG = 12
"""Enums with more entries than this are lists of their own, which points name."""
NOTHING: tuple[object, ...] = (None, "", (), [], {}, False)


def described(device: Device) -> Iterator[Row]:
    """Every row that the reading of this device must have."""
    codes = _codes(device)
    for point in device.points:
        yield _row("point", point.source.line, place_of(point), _of_point(point, codes))
    for enum in {one.name: one for one in map(_enum_of, device.points) if one and len(one.entries) > LONG}.values():
        yield _row("list", None, {"name": enum.name}, {"entries": _entries(enum.entries)})
    for of in ("functions", "exceptions", "responses"):
        for code in getattr(device.bus, of):
            yield _row("code", None, {"of": of, "number": code.number}, _of_code(code))
    for frame in device.frames:
        bytes_of = {"bytes": frame.printed.hex(" "), "direction": frame.direction}
        yield _row("frame", frame.source.line, bytes_of, _of_frame(frame))
    for command in device.commands:
        yield _row("command", command.source.line, {"name": command.name}, _of_command(command))
    for message in device.messages:
        yield _row("message", message.source.line, {"name": message.name}, _of_message(message))
    for telegram in device.telegrams:
        yield _row("telegram", telegram.source.line, {"name": telegram.name}, _of_telegram(telegram))
    for what, value in _of_bus(device).items():
        yield _row("bus", None, {"what": what}, {"value": value})


def notes(device: Device) -> Mapping[str, str]:
    """What is said in words, by where: the bus, a group, a point."""
    named = {one.name: one.note.get("en", "") for some in (device.groups, device.points) for one in some}
    return {"bus": device.bus.note.get("en", ""), **named}


def place_of(point: Point) -> Row:
    """What tells a point from the others: where it is; what has no address is told apart by its name."""
    bits = None if point.bits is None else span(*point.bits)
    return {
        "space": point.space,
        "telegram": point.telegram,
        "address": point.address if point.address is not None else point.item,
        "index": point.index,
        "bits": bits,
        "variant": point.variant,
    }


def span(high: int, low: int) -> str:
    """Bits as `7..4`, or as `3` when it is one."""
    return str(low) if high == low else f"{high}..{low}"


def _row(kind: str, line: int | None, key: Row, facts: Facts) -> Row:
    there = {name: value for name, value in facts.items() if not _is_nothing(value)}
    return {"kind": kind, "line": line, **key, "facts": there}


def _is_nothing(value: object) -> bool:
    return any(value is one or (value == one and type(value) is type(one)) for one in NOTHING)


def _codes(device: Device) -> dict[str, str]:
    """What the manual calls each point."""
    return {one.name: one.code or one.name for one in device.points}


# Points


def _of_point(point: Point, codes: Mapping[str, str]) -> Facts:
    return {
        "code": point.code,
        "name": point.name,
        "title": point.title.get("de"),
        "type": point.type if point.untyped is None else point.untyped,
        "words": list(point.addresses),
        "places": [[one.purpose, list(one.addresses), one.function] for one in point.places[1:]],
        "function": point.places[0].function if point.places else None,
        "access": point.access,
        "unit": point.unit.symbol,
        "scale": _scale(point, codes),
        "range": _ranges(point, codes),
        "default": None if point.default is None else str(point.default),
        "steps": [list(one) for one in point.steps],
        **_names(point),
        "characters": point.text.characters if point.text else None,
        **_around(point),
    }


def _names(point: Point) -> Facts:
    enum = _enum_of(point)
    return {
        "enum": enum and (enum.name if len(enum.entries) > LONG else _entries(enum.entries)),
        "open": enum is not None and not enum.closed,
        "digits": point.digits.count if point.digits else None,
        "flags": {span(one.low + one.width - 1, one.low): _flag(one) for one in point.flags},
        "special": {span(one.high, one.low): _special(one) for one in point.specials},
        "fixed": _fixed(point),
    }


def _around(point: Point) -> Facts:
    """What is said about a point besides its raw number."""
    return {
        "references": dict(point.references),
        "record": point.record,
        "set": point.set,
        "changes": point.changes,
        "changes_with": list(point.changes_with),
        "keeps": point.keeps,
        "conditions": list(point.conditions),
        "when": None if point.when is None else str(point.when),
        "since": [one for one in (point.since, point.until) if one is not None],
        "reserved": point.reserved,
        "documented_only": not point.generated,
    }


def _enum_of(point: Point) -> Enum | None:
    return point.digits.enum if point.digits else point.enum


def _entries(entries: Iterable[Entry]) -> Facts:
    return {str(one.raw): [*_names_of(one), *([one.quantity] if one.quantity else [])] for one in entries}


def _names_of(one: Entry | Flag | Special) -> list[str | None]:
    return [one.name, one.title.get("de")]


def _flag(flag: Flag) -> list[Any]:
    return [*_names_of(flag), _entries(flag.values) or flag.active, *([] if flag.active else ["active at 0"])]


def _special(special: Special) -> list[Any]:
    told = {"no value": special.no_value, "writable": special.writable}
    return [*_names_of(special), *(word for word, holds in told.items() if holds)]


def _fixed(point: Point) -> Facts:
    if point.fixed is None:
        return {}
    there = [bit for bit in range(point.fixed.mask.bit_length()) if point.fixed.mask >> bit & 1]
    return {str(bit): point.fixed.bits >> bit & 1 for bit in there}


def _scale(point: Point, codes: Mapping[str, str]) -> object:
    """The rule; where another point chooses between rules, each by `code = raw number`."""
    cases = {_when(one.point, one.raw, codes): _rule(one.rule, codes) for one in point.scale or ()}
    return cases.get("") if list(cases) == [""] else cases


def _when(point: str | None, raw: int | None, codes: Mapping[str, str]) -> str:
    return "" if point is None else f"{codes[point]} = {raw}"


def _rule(rule: Linear, codes: Mapping[str, str]) -> list[Any]:
    factors = [_factor(one, codes) for one in rule.factors]
    return [str(rule.ratio.numerator), str(rule.ratio.denominator), str(rule.offset), factors]


def _factor(factor: Factor, codes: Mapping[str, str]) -> list[Any]:
    """[whose number, what is taken of it, the power that it has]."""
    linear = "raw" if (factor.slope, factor.intercept) == (1, 0) else f"raw * {factor.slope} + {factor.intercept}"
    return [codes[factor.point], f"10 ** {linear}" if factor.ten_to else linear, factor.power]


def _ranges(point: Point, codes: Mapping[str, str]) -> list[Any]:
    if point.allowed.units:
        return [[str(low), str(high)] for low, high in point.allowed.units]
    found: list[list[Any]] = []
    for one in point.allowed.intervals:
        pair = [_bound(one.low, codes), _bound(one.high, codes)]
        if found and isinstance(pair[0], int) and found[-1][1] == pair[0] - 1:
            found[-1][1] = pair[1]
        else:
            found.append(pair)
    return [] if found == _quantities(point) or point.info.floating else found


def _quantities(point: Point) -> list[list[int]]:
    """All raw numbers that the type can hold, but the special codes."""
    low, found = point.least, list[list[int]]()
    for one in sorted(point.specials, key=lambda special: special.low):
        found.append([low, one.low - 1])
        low = one.high + 1
    return [pair for pair in (*found, [low, point.greatest]) if pair[0] <= pair[1]]


def _bound(bound: Bound, codes: Mapping[str, str]) -> object:
    """A raw number, or the raw numbers that make it, as `10 * A004`."""
    if isinstance(bound, int):
        return bound
    terms = [] if bound.rule.ratio == 1 else [str(bound.rule.ratio)]
    terms += [str(codes[one.point]) if one.power == 1 else f"1 / {codes[one.point]}" for one in bound.rule.factors]
    return " * ".join(terms) + (f" + {bound.rule.offset}" if bound.rule.offset else "")


# What is no point


def _of_code(code: Code) -> Facts:
    return {
        "name": code.name,
        "title": code.title.get("de"),
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
        "pkw": frame.pkw,
        "can_id": frame.can_id,
    }


def _of_command(command: Command) -> Facts:
    return {
        "title": command.title.get("de"),
        "space": command.space,
        "address": command.address,
        "function": command.function,
        "value": "any" if command.value is None else command.value,
        "wears": command.wears,
        "busy": command.busy,
    }


def _of_message(message: Message) -> Facts:
    return {
        "title": message.title.get("de"),
        "direction": message.direction,
        "answers": message.answers,
        "can_id": message.can_id,
        "adds_unit": message.adds_unit,
        "bytes": [f"{one.kind} {one.number}" for one in message.roles],
    }


def _of_telegram(telegram: Telegram) -> Facts:
    return {
        "title": telegram.title.get("de"),
        "direction": telegram.direction,
        "words": telegram.words,
        "message": telegram.message,
    }


def _of_bus(device: Device) -> Facts:
    bus = device.bus
    found = {
        "framings": list(bus.framings),
        "units": list(bus.units),
        "broadcast": bus.broadcast,
        "gaps": {space: [list(one) for one in gaps] for space, gaps in bus.gaps.items()},
        "pad_coil_bytes": bus.pad_coil_bytes,
        "pkw": list(bus.pkw),
        "pzd": list(bus.pzd) if any(bus.pzd) else [],
        "pzd_of": dict(bus.variant_pzd),
        "bitrate": bus.bitrate,
        "identifier_bits": bus.identifier_bits,
        **{f"timing {name}": text for name, text in bus.timing.items()},
        **{f"serial {name}": dict(choices) for name, choices in bus.serial.items()},
        **{f"variants {axis}": list(values) for axis, values in device.variants.items()},
    }
    return {what: value for what, value in found.items() if not _is_nothing(value)}
