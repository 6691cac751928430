"""USS telegrams in words: requests, the answers to them, broadcasts, or the words of one part alone."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from fieldscribe.arithmetic.words import raw_of
from fieldscribe.conversation.answers import Heard, Item
from fieldscribe.conversation.items import Base, Directory, named_item, value_item, without_variants
from fieldscribe.conversation.remarks import words_text
from fieldscribe.conversation.selection import absence
from fieldscribe.families.uss.conversation import remarks
from fieldscribe.families.uss.conversation.recognition import (
    RESPONSE_WIDTHS,
    TASK_WIDTHS,
    Part,
    Wrapped,
    part_of,
    recognise,
    split,
)
from fieldscribe.families.uss.facts import of_bus
from fieldscribe.families.uss.telegrams import Link, Request, parse, telegram

if TYPE_CHECKING:
    from collections.abc import Sequence
    from fractions import Fraction

    from fieldscribe.arithmetic.codec import Settings
    from fieldscribe.model import Device, Point

_ANSWERS = ("ok", "refused", "no_rights", "no_answer")
_REFUSED, _NO_RIGHTS = 7, 8
_SIZE = 6
"""The response with the number of elements."""
_MASKS = 4
_UNASKED = "read as a request, for none was heard before it; --direction response reads it as an answer"


@dataclass(slots=True)
class _Unit:
    """What was heard of one unit: numbers that rules take, and the open request."""

    settings: dict[str, int | Fraction] = field(default_factory=dict)
    asked: Request | None = None
    known: bool = False
    """Whether a request was heard, so that the course of the dialogue is known."""


@dataclass(frozen=True, slots=True)
class _Brought:
    """A parameter part, the points that it is about, and the value of `width` words that it brings, if any."""

    part: Part
    points: list[Point]
    width: int
    value: int | None
    request: bool


class UssListener:
    """Hears one telegram after the other."""

    def __init__(self, device: Device, settings: Settings, link: Link, framing: str = "uss") -> None:
        self._device = device
        self._given = settings
        self._link = link if framing == "uss" else replace(link, pzd=0)
        self._framing = framing
        self._directory = Directory(device)
        self._units: dict[int | None, _Unit] = {}

    def hear(self, data: bytes, direction: str | None = None, *, keep: bool = False) -> Heard:
        """What the next telegram says; any bytes are safe. `keep`: one request stays open, which all others answer."""
        wrapped = recognise(data, self._framing)
        head = "USS" if wrapped.unit is None else f"USS, unit {wrapped.unit}"
        base = Heard(data, self._framing, "unreadable", wrapped.unit, None, head, (), wrapped.checks, wrapped.faults)
        if wrapped.words is None:
            return replace(base, summary=f"{head}: not readable")
        if self._framing == "uss" and wrapped.data[0] != 0x02 and len(wrapped.faults) > 1:
            note = "the words of the parameter part alone are read with --framing pkw, process data with --framing pzd"
            return replace(base, summary=f"{head}: not readable", unit=None, notes=(note,))
        if self._framing == "broadcast" or (self._framing == "uss" and wrapped.unit == self._device.bus.broadcast):
            return self._broadcast(base, wrapped.words)
        if self._framing == "pzd":
            return self._process_data(base, wrapped.words, direction)
        return self._telegram(base, wrapped, wrapped.words, direction, keep=keep)

    def _telegram(
        self, base: Heard, wrapped: Wrapped, words: tuple[int, ...], direction: str | None, *, keep: bool
    ) -> Heard:
        unit = self._units.setdefault(wrapped.unit, _Unit())
        status = ""
        if unit.asked is not None and direction != "request":
            mended = telegram(unit.asked.unit, words)
            status = parse(self._device.bus, self._link, unit.asked, mended).status
        if direction == "response" or (direction is None and status in _ANSWERS):
            return self._reply(base, unit, words, status, keep=keep)
        heard = self._request(base, unit, words)
        unsure = direction is None and not unit.known and self._could_answer(words)
        unit.known = True
        return replace(heard, notes=(*heard.notes, _UNASKED)) if unsure else heard

    def _could_answer(self, words: tuple[int, ...]) -> bool:
        """Whether words that were read as a request, none being open, bring what only an answer or a change brings."""
        part = part_of(split(words, self._link, request=True)[0])
        return part is not None and any(part.values) and part.code != 0

    def _request(self, base: Heard, unit: _Unit, words: tuple[int, ...]) -> Heard:
        part_words, rest, fault = split(words, self._link, request=True)
        faults = (*base.faults, *((fault,) if fault else ()))
        base = replace(base, kind="request", faults=faults)
        part = part_of(part_words)
        items = self._pzd(unit, rest, "request")
        address = 0 if base.unit is None else base.unit
        if part is None:
            alone = self._link.pkw == 0
            unit.asked = Request(address, 0, words=rest)
            said = f"{base.summary}: {'request, process data' if alone else 'not readable'}"
            return replace(base, kind="request" if alone else "unreadable", items=items, summary=said)
        width = TASK_WIDTHS.get(part.code, 0)
        value = part.value(width, self._link) if width else None
        unit.asked = Request(address, part.code, part.parameter, part.index, width, value or 0, rest)
        points = self._directory.at("parameter", part.parameter, part.index)
        task = remarks.code_text(self._device.bus.functions, part.code, "task")
        about = "" if part.code == 0 else f", {remarks.parameter_text(part, points)}"
        base = replace(base, function=part.code, summary=f"{base.summary}: request, {task}{about}")
        findings = tuple(remarks.request_findings(self._device, part, base.unit))
        notes = tuple(remarks.request_notes(part, self._link))
        details: dict[str, object] = {"task": part.code}
        if part.code:
            details |= {"parameter": part.parameter, "index": part.index}
            items = (*self._values(unit, _Brought(part, points, width, value, request=True)), *items)
        return replace(base, items=items, findings=findings, notes=notes, details=details)

    def _reply(self, base: Heard, unit: _Unit, words: tuple[int, ...], status: str, *, keep: bool) -> Heard:
        part_words, rest, fault = split(words, self._link, request=False)
        asked = unit.asked
        if not keep and status != "no_answer":
            unit.asked = None
        faults = list(base.faults)
        if keep and asked is None:
            status = "wrong_unit"  # the request was one to another unit
        if fault:
            faults.append(fault)
        elif status and status not in _ANSWERS:
            faults.append(f"it does not answer the request: {remarks.REPLY_FAULTS.get(status, status)}")
        part = part_of(part_words)
        base = replace(base, kind="reply", faults=tuple(faults))
        if part is None:
            items = self._pzd(unit, rest, "response")
            return replace(base, summary=f"{base.summary}: reply, process data", items=items)
        points = self._directory.at("parameter", part.parameter, part.index)
        named = remarks.code_text(self._device.bus.codes("responses"), part.code, "response")
        about = "" if part.code == 0 else f", {remarks.parameter_text(part, points)}"
        base = replace(base, summary=f"{base.summary}: reply, {named}{about}")
        details: dict[str, object] = {"response": part.code}
        if part.code:
            details |= {"parameter": part.parameter, "index": part.index}
        base = replace(base, details=details)
        if part.code in (_REFUSED, _NO_RIGHTS):
            base = self._refusal(base, part, points, None if asked is None else asked.task)
        elif part.code:
            width = RESPONSE_WIDTHS.get(part.code, 0)
            value = part.value(width, self._link) if width else None
            base = replace(base, items=self._values(unit, _Brought(part, points, width, value, request=False)))
        return replace(base, items=(*base.items, *self._pzd(unit, rest, "response")))

    def _refusal(self, base: Heard, part: Part, points: list[Point], task: int | None) -> Heard:
        """An answer that the device cannot or may not do what was asked."""
        items = tuple(named_item(point, ("parameter", part.parameter, point.words)) for point in points)
        base = replace(base, kind="exception", items=items)
        if part.code == _NO_RIGHTS or not part.values:
            return base
        error = part.values[0]
        base = replace(base, exception=error, summary=f"{base.summary}: {remarks.error_text(self._device, error)}")
        findings = tuple(remarks.error_findings(self._device, part, task))
        return replace(base, findings=findings, notes=tuple(remarks.error_notes(part, self._link)))

    def _values(self, unit: _Unit, brought: _Brought) -> tuple[Item, ...]:
        """What a parameter part says of its parameter."""
        part, points = brought.part, brought.points
        base = ("parameter", part.parameter, max(1, brought.width))
        words = words_text(part.values)
        if not points:
            carried = f" (carries {words})" if brought.width or not brought.request else ""
            return (Item(*base, f"{remarks.parameter_text(part, points)}: no point is described here{carried}"),)
        if not brought.request and RESPONSE_WIDTHS.get(part.code, 0) == 0:
            return tuple(named_item(point, base, f"carries {words}") for point in points)
        if part.code == _SIZE and not brought.request:
            return tuple(named_item(point, base, f"{brought.value} elements") for point in points)
        shown = without_variants(points, limits=brought.request)
        return tuple(self._value(unit, brought, point, base) for point in shown)

    def _value(self, unit: _Unit, brought: _Brought, point: Point, base: Base) -> Item:
        """What a parameter part says of one point."""
        if brought.value is None:
            return named_item(point, base, odd=absence(self._device, point) if brought.request else "")
        words = words_text(brought.part.values)
        if not point.generated:
            return named_item(point, base, f"carries {words}; {point.reason or 'its meaning is open'}")
        if brought.width != point.words:
            odd = remarks.width_finding(point, brought.width, request=brought.request)
            return replace(named_item(point, base, f"carries {words}; {odd}"), findings=(odd,))
        raw = raw_of(point, _as_words(brought.value, brought.width))
        if not brought.request:
            unit.settings.update(self._directory.settings([(point, raw)]))
        settings = {**unit.settings, **self._given}
        return value_item(self._device, point, base, (raw, settings), written=brought.request)

    def _pzd(self, unit: _Unit, words: Sequence[int], direction: str) -> tuple[Item, ...]:
        """What words of process data say, in that direction."""
        names = [one.name for one in self._device.telegrams if one.direction == direction]
        items = []
        for place, word in enumerate(words):
            points = [point for name in names for point in self._directory.at(name, place)]
            base = (names[0] if names else "telegram", place, 1)
            whole = [point for point in points if point.addresses[0] == place and place + point.words <= len(words)]
            for point in whole:
                raw = raw_of(point, words[place : place + point.words])
                if point.generated or point.scale is not None:
                    settings = {**unit.settings, **self._given}
                    item = value_item(self._device, point, base, (raw, settings), written=direction == "request")
                    # a word of zeros is what a master sends that has nothing to say
                    items.append(item if raw else replace(item, findings=()))
                else:
                    said = f"carries {word:04X}h; {point.reason or 'its meaning is open'}"
                    items.append(named_item(point, base, said))
            if not points:
                items.append(Item(*base, f"word {place + 1} of process data = {word:04X}h: no point is described here"))
        return tuple(items)

    def _process_data(self, base: Heard, words: tuple[int, ...], direction: str | None) -> Heard:
        unit = self._units.setdefault(None, _Unit())
        kind = {"response": "reply"}.get(direction or "", "request")
        low, high = of_bus(self._device.bus).pzd
        faults = base.faults
        if not low <= len(words) <= high:
            faults = (*faults, f"there are {low} to {high} words of process data, here are {len(words)}")
        notes = () if direction else ("read as words from the master; --direction response reads those of the device",)
        items = self._pzd(unit, words, direction or "request")
        return replace(base, kind=kind, summary=f"USS: {kind}, process data", items=items, faults=faults, notes=notes)

    def _broadcast(self, base: Heard, words: tuple[int, ...]) -> Heard:
        """Four words of masks, then process data; nobody answers."""
        base = replace(base, kind="broadcast", unit=base.unit, summary=f"{base.summary}: broadcast, no unit answers")
        if len(words) < _MASKS:
            fault = f"a broadcast starts with {_MASKS} words of masks, here are {len(words)}"
            return replace(base, faults=(*base.faults, fault))
        names = [one.name for one in self._device.telegrams if one.direction == "request"]
        counted = [place for place in range(1, 16) if words[0] >> place & 1]
        which = " and ".join(
            [", ".join(map(str, counted[:-1])), str(counted[-1])] if counted[1:] else map(str, counted)
        )
        said = f"words {which} of process data count" if counted else "no word of process data counts"
        items = [Item("mask", 0, 1, f"mask {words[0]:04X}h: {said}")]
        items.append(self._mask(names, 0, 1, words[1:2]))
        items.append(self._mask(names, 3, 2, words[2:4]))
        unit = self._units.setdefault(None, _Unit())
        return replace(base, items=(*items, *self._pzd(unit, words[_MASKS:], "request")))

    def _mask(self, names: list[str], place: int, at: int, words: tuple[int, ...]) -> Item:
        """Which bits of a control word count."""
        point = next((one for name in names for one in self._directory.at(name, place)), None)
        about = point.code or point.name if point is not None else f"word {place + 1}"
        masks = words_text(words)
        if not any(words):
            return Item("mask", at, len(words), f"mask {masks}: no bit of {about} counts")
        if words[0] == 0xFFFF and len(set(words)) == 1:
            return Item("mask", at, len(words), f"mask {masks}: every bit of {about} counts")
        flags = point.flags if point is not None and len(words) == 1 else ()
        named = [flag.name for flag in flags if words[0] >> flag.low & 1]
        said = f" ({', '.join(named)})" if named else ""
        return Item("mask", at, len(words), f"mask {masks}: only these bits of {about} count{said}")


def _as_words(value: int, width: int) -> tuple[int, ...]:
    return (value >> 16, value & 0xFFFF) if width == 2 else (value,)
