"""CAN frames in words: cyclic telegrams, requests and answers, each unit with what was heard of it before."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from fieldscribe.arithmetic.words import raw_of
from fieldscribe.conversation.answers import Heard, Item
from fieldscribe.conversation.items import Directory, named_item, value_item, value_said, without_variants
from fieldscribe.conversation.remarks import strange_unit, words_text
from fieldscribe.conversation.selection import absence
from fieldscribe.families.can.conversation.recognition import Recognised, recognise, senders
from fieldscribe.families.can.conversation.remarks import (
    fixed_finding,
    identifiers_text,
    message_text,
    unknown_kind,
    waiting_text,
)
from fieldscribe.families.can.frames import LENGTH
from fieldscribe.families.can.receiver import Receiver
from fieldscribe.wording import address_text
from fieldscribe.wording.exact import hex_text

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from fractions import Fraction

    from fieldscribe.arithmetic.codec import Settings
    from fieldscribe.families.can.conversation.notation import Pasted
    from fieldscribe.model import Device, Message, Point, Telegram


@dataclass(slots=True)
class _Unit:
    """What was heard of one unit: numbers that rules take, words of parameters, telegrams, and what is still asked."""

    settings: dict[str, int | Fraction] = field(default_factory=dict)
    words: dict[int, int] = field(default_factory=dict)
    receivers: dict[str, Receiver] = field(default_factory=dict)
    waiting: dict[str, tuple[Point, int]] = field(default_factory=dict)
    """Points of telegrams whose meaning needs others, by item, with their raw numbers."""
    asked: dict[str, Recognised] = field(default_factory=dict)
    """The last request of each message that was not answered yet."""


class CanListener:
    """Hears one frame after the other."""

    def __init__(self, device: Device, settings: Settings) -> None:
        self._device = device
        self._given = settings
        self._directory = Directory(device)
        self._units: dict[int, _Unit] = {}
        self._words = {(one.telegram, one.name): one.addresses[0] for one in device.points if one.addresses}

    def hear(self, pasted: Pasted) -> Heard:
        """What the next frame says; any bytes are safe."""
        found = None if pasted.remote else recognise(self._device, pasted.frame)
        heard = self._unknown(pasted) if found is None else self._message(pasted, found)
        stamp = {"time": pasted.stamp.strip("()") or None, "interface": pasted.bus or None}
        return replace(heard, shown=pasted.shown, details={"can_id": pasted.frame.id, **heard.details, **stamp})

    def _message(self, pasted: Pasted, found: Recognised) -> Heard:
        telegram = next((one for one in self._device.telegrams if one.message == found.message.name), None)
        unit = self._units.setdefault(-1 if found.unit is None else found.unit, _Unit())
        said = message_text(self._device, found)
        base = Heard(pasted.frame.data, "can", "", found.unit, None, said, checks=found.checks, faults=found.faults)
        details: dict[str, object] = {"message": found.message.name}
        if telegram is not None:
            heard = self._cyclic(base, found, unit, telegram)
            details["multiplexer"] = found.slot
        else:
            heard = self._parameter(base, found, unit)
            details["parameter"] = found.address
        return replace(heard, details=details)

    def _cyclic(self, base: Heard, found: Recognised, unit: _Unit, telegram: Telegram) -> Heard:
        per_frame = found.message.words
        first = found.slot * per_frame
        if first >= telegram.words or per_frame == 0:
            last = -(-telegram.words // max(1, per_frame)) - 1
            finding = f"the manual knows multiplexers 0 to {last} only"
            return replace(base, kind="cyclic", findings=(finding,))
        receiver = unit.receivers.setdefault(telegram.name, Receiver(telegram, found.message, found.unit or 0))
        if not receiver.take(found.frame):
            return replace(base, kind="cyclic", notes=("its words are not read, for the frame is damaged",))
        positions = range(first, min(first + per_frame, telegram.words))
        points = {point.item: point for at in positions for point in self._directory.at(telegram.name, at)}
        whole: list[tuple[Point, int]] = []
        for point in points.values():
            status, words = receiver.words(point.addresses)
            if status == "ok":
                whole.append((point, raw_of(point, words)))
        self._learn(unit, whole)
        raws = {point.item: raw for point, raw in whole}
        settings = {**unit.settings, **self._given}
        items = []
        for at in positions:
            here = [point for point in points.values() if at == min(set(point.addresses) & set(positions))]
            items += [self._word(receiver, telegram, point, raws.get(point.item), settings) for point in here]
            if not self._directory.at(telegram.name, at):
                words = receiver.words((at,))[1]
                items.append(Item(telegram.name, at, 1, f"word {at}: no point is described here ({words_text(words)})"))
        items += self._resolved(unit, telegram, settings, points)
        for point, raw in whole:
            if any(item.point == point.item and item.missing for item in items):
                unit.waiting[point.item] = (point, raw)
        return replace(base, kind="cyclic", items=tuple(items))

    def _word(self, receiver: Receiver, telegram: Telegram, point: Point, raw: int | None, settings: Settings) -> Item:
        """A point of the telegram, or as much of it as the frames so far tell."""
        base = (telegram.name, min(point.addresses), len(point.addresses))
        if raw is None:
            return named_item(point, base, self._partly(receiver, point, settings))
        item = value_item(self._device, point, base, (raw, settings))
        if not item.missing:
            return item
        places = [self._words[telegram.name, name] for name in item.missing if (telegram.name, name) in self._words]
        slots = sorted({place // receiver.per_frame for place in places})
        comes = f"; it comes with multiplexer {' and '.join(map(str, slots))}" if slots else ""
        return replace(item, text=item.text + comes)

    def _partly(self, receiver: Receiver, point: Point, settings: Settings) -> str:
        """What is known of a number whose words are in two frames and do not surely belong together."""
        parts = [receiver.words((at,)) for at in point.addresses]
        if any(status != "ok" for status, _ in parts):
            return waiting_text(point, [words for _, words in parts], receiver.per_frame)
        raw = raw_of(point, [words[0] for _, words in parts])
        would = value_said(self._device, point, (raw, settings))
        high = point.addresses[0] // receiver.per_frame
        return (
            f"its words are in two frames and may be torn; {would} if the high word stayed as it is: "
            f"the next frame with multiplexer {high} tells"
        )

    def _resolved(self, unit: _Unit, telegram: Telegram, settings: Settings, now: dict[str, Point]) -> Iterator[Item]:
        """Points of frames before that this frame gave their missing factors."""
        for name, (point, raw) in list(unit.waiting.items()):
            base = (telegram.name, min(point.addresses), len(point.addresses))
            item = value_item(self._device, point, base, (raw, settings))
            if name in now or item.missing:
                continue
            del unit.waiting[name]
            yield replace(item, text=f"from a frame before: {item.text}")

    def _parameter(self, base: Heard, found: Recognised, unit: _Unit) -> Heard:
        address, raw, message = found.address, found.raw, found.message
        if address is None:
            return replace(base, kind=_kind(message))
        writes = self._writes(message)
        known = raw is not None and not found.faults
        if known and raw is not None and message.direction != "request":
            unit.words[address] = raw
        if writes and not found.faults:
            self._forget(unit, address)
        points = self._directory.at("parameter", address)
        if known and message.direction != "request":
            self._learn(unit, list(self._whole(unit, points)))
        asks = writes and message.direction == "request"  # an answer tells what the device took: any number may come
        shown = without_variants(points, limits=asks)
        items = [self._value(unit, point, address, raw, written=asks) for point in shown]
        if not points:
            brings = "" if raw is None else f" ({words_text((raw,))})"
            items = [Item("parameter", address, 1, f"{address_text(address)}: no point is described here{brings}")]
        findings = self._course(unit, found)
        return replace(base, kind=_kind(message), items=tuple(items), findings=tuple(findings))

    def _value(self, unit: _Unit, point: Point, address: int, raw: int | None, *, written: bool) -> Item:
        base = ("parameter", address, 1)
        settings = {**unit.settings, **self._given}
        if raw is None:
            return named_item(point, base, odd=absence(self._device, point))
        if len(point.addresses) == 1:
            item = value_item(self._device, point, base, (raw_of(point, (raw,)), settings), written=written)
            odd = fixed_finding(point, raw) if written else ""
            return replace(item, text=f"{item.text}; {odd}", findings=(*item.findings, odd)) if odd else item
        words = {**unit.words, address: raw}
        place = point.addresses.index(address) + 1
        part = f"word {place} of {len(point.addresses)} = {words_text((raw,))}"
        if not all(at in words for at in point.addresses):
            left = sum(at not in words for at in point.addresses)
            return named_item(point, base, f"{part}; {left} more words to come")
        item = value_item(self._device, point, base, (raw_of(point, [words[at] for at in point.addresses]), settings))
        return replace(item, text=f"{item.text}; here {part}")

    def _whole(self, unit: _Unit, points: Sequence[Point]) -> Iterator[tuple[Point, int]]:
        for point in points:
            if all(at in unit.words for at in point.addresses):
                yield point, raw_of(point, [unit.words[at] for at in point.addresses])

    def _learn(self, unit: _Unit, found: Sequence[tuple[Point, int]]) -> None:
        unit.settings.update(self._directory.settings(found))

    def _forget(self, unit: _Unit, address: int) -> None:
        """What the device works out of a parameter must be read again once that was written."""
        written = {point.name for point in self._directory.at("parameter", address)}
        for point in self._device.points:
            if written & set(point.changes_with):
                unit.settings.pop(point.name, None)
                for at in point.addresses:
                    unit.words.pop(at, None)

    def _writes(self, message: Message) -> bool:
        """Whether a message is a request that carries a value, or the answer to one."""
        asked = next((one for one in self._device.messages if one.name == message.answers), message)
        return asked.direction == "request" and any(role.kind == "raw" for role in asked.roles)

    def _course(self, unit: _Unit, found: Recognised) -> Iterator[str]:
        """What is wrong about how a frame follows from those before it."""
        message = found.message
        if message.direction == "request":
            unit.asked[message.name] = found
            if found.unit is not None and (strange := strange_unit(self._device.bus, found.unit)):
                yield strange
            return
        asked = unit.asked.get(message.answers or "")
        if asked is None:
            return
        if asked.address != found.address:
            yield f"the request before asked for parameter {asked.address}, this answers {found.address}"
            return
        del unit.asked[message.answers or ""]
        if asked.raw is not None and asked.raw != found.raw:
            was, came = (words_text((word or 0,)) for word in (asked.raw, found.raw))
            yield f"it does not repeat what was written: {was} was, {came} came back"

    def _unknown(self, pasted: Pasted) -> Heard:
        """A frame that is no message of the device, or not a whole one."""
        frame = pasted.frame
        base = Heard(frame.data, "can", "other", None, None, f"CAN {hex_text(frame.id, 3)}")
        here = list(senders(self._device, frame))
        if not here:
            note = f"no message of {self._device.id} has this identifier: {identifiers_text(self._device)}"
            return replace(base, summary=f"{base.summary}: not of this device", notes=(note,))
        unit = here[0][1]
        base = replace(base, kind="unreadable", unit=unit, summary=f"{base.summary}: not readable")
        if pasted.remote:
            fault = "a remote request carries no data, and the manual knows none"
        elif len(frame.data) != LENGTH:
            fault = f"every message has {LENGTH} bytes, here are {len(frame.data)}"
        else:
            fault = unknown_kind(frame, [message for message, _ in here])
        return replace(base, faults=(fault,))


def _kind(message: Message) -> str:
    return {"request": "request", "response": "reply"}.get(message.direction, "cyclic")
