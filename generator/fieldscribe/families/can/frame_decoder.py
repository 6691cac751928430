"""Decodes CAN frames: cyclic telegrams, requests, and answers to the last request of each unit."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from fieldscribe.families.can import frames, signals
from fieldscribe.families.can.frames import (
    LENGTH,
    CanFrame,
    Head,
    ParameterWord,
    Receiver,
    carried,
    carries,
    differences,
    places,
    sums,
    unit_of,
)
from fieldscribe.families.can.notation import Pasted, read_frames, read_identifier
from fieldscribe.families.decoded_frame import MOST_STATES, DecodedFrame, OpenRequests, Piece, Word
from fieldscribe.families.frame_results import FrameResult, Options
from fieldscribe.model import Bus, Device, Message, Telegram
from fieldscribe.text import line
from fieldscribe.wording import address_text
from fieldscribe.wording.exact import hex_text
from fieldscribe.wording.frames import check_text, hex_words, strange_unit

_DAMAGED = "its words are not read, for the frame is damaged"
_MOST_HEADS = 1024
"""The most heads of frames whose message is remembered."""
_KINDS = {"request": "request", "response": "reply"}


@dataclass(slots=True)
class _Known:
    """A head, the result of frames with it, and the last of these if it depends on nothing but itself."""

    head: Head
    result: FrameResult
    last: DecodedFrame | None = None


class CanFrameDecoder:
    """Decodes the frames of one device; keeps the words of telegrams that span several frames.

    Most frames of telegrams come again as they were, so the last one of each head is kept.
    """

    def __init__(self, device: Device, can_id: str | None = None) -> None:
        self._device = device
        self._identifier = None if can_id is None else read_identifier(can_id)
        self._receiver = lru_cache(MOST_STATES)(
            lambda message, unit: Receiver(self._telegrams[message], self._messages[message], unit)
        )
        self._firsts = sorted({place for message in device.messages for place in places(message, "constant")[:1]})
        self._words = {message.name: message.words for message in device.messages}
        self._signalled: dict[tuple[int, ...], DecodedFrame] = {}
        """The last frame by its identifier and the places of its signals."""
        self._crossed = {
            message.name: _crossed(device, telegram, max(1, message.words))
            for telegram in device.telegrams
            for message in device.messages
            if telegram.message == message.name
        }
        """By message, the multiplexers with a part of a number whose other part comes with another one."""
        self._telling: dict[tuple[int, bytes], tuple[int, ...]] = {}
        self._heads: dict[tuple[int, bytes, bytes], _Known | None] = {}
        self._telegrams = {telegram.message: telegram for telegram in reversed(device.telegrams)}
        self._messages = {message.name: message for message in device.messages}
        self._carrying = [message for message in device.messages if message.fields]
        asks = [message for message in device.messages if message.direction == "request" and carries(message, "raw")]
        writing = {message.name for message in asks}
        self._writing = writing | {message.name for message in device.messages if message.answers in writing}
        """The requests that carry a value, and the answers to them."""

    def frames(self, texts: Sequence[str]) -> list[Pasted]:
        """Return the frames in pasted texts. Raises UnclearError."""
        return read_frames(texts, self._identifier)

    def decode(self, frame: Pasted, requests: OpenRequests, *, expecting: bool = False) -> DecodedFrame:
        """Decode one frame; any bytes are safe."""
        del expecting  # the messages themselves say which frame answers which
        for message in () if frame.remote else self._carrying:
            if frames.is_of(message, self._device.bus.units, frame.frame):
                return self._signals(message, frame)
        known = None if frame.remote else self._known(frame.frame)
        if known is None:
            return self._unknown(frame)
        if known.last is not None and known.last.result.data == frame.frame.data:
            return known.last
        result = known.result._replace(data=frame.frame.data)
        telegram = self._telegrams.get(known.head.message.name)
        if telegram is None:
            return self._parameter(known.head, result, frame, requests)
        return self._cyclic(known, result, frame, telegram)

    def _known(self, frame: CanFrame) -> _Known | None:
        """Return the message of a frame, and the result of its head; None if no message fits.

        Both depend only on the bytes that carry no words, so they are remembered for frames that differ in words alone.
        """
        data = frame.data
        if len(data) != LENGTH:
            return None  # as `recognise` does
        beginning = frame.id, bytes([data[place] for place in self._firsts])
        if beginning not in self._telling:
            self._telling[beginning] = self._telling_places(frame)
            _forget_many(self._telling)
        key = *beginning, bytes([data[place] for place in self._telling[beginning]])
        if key not in self._heads:
            head = self.recognise(frame)
            self._heads[key] = None if head is None else _Known(head, self._result(head, frame))
            _forget_many(self._heads)
        return self._heads[key]

    def _telling_places(self, frame: CanFrame) -> tuple[int, ...]:
        """Return the places of the bytes that identify the message of a frame, or that a checksum covers."""
        messages = [message for message, _ in _senders(self._device, frame) if message.roles and _fits(message, frame)]
        if any(carries(message, "xor") for message in messages):
            return tuple(range(LENGTH))
        return tuple(
            place for place in range(LENGTH) if any(message.roles[place].kind != "word" for message in messages)
        )

    def recognise(self, frame: CanFrame) -> Head | None:
        """Return the frame as the message with the fewest flaws; None if no message fits."""
        if len(frame.data) != LENGTH:
            return None
        senders = [sender for sender in _senders(self._device, frame) if sender[0].roles]
        heads = [self._head(message, frame) for message, _ in senders if _fits(message, frame)]
        return min(heads, key=lambda head: head.flaws, default=None)

    def _head(self, message: Message, frame: CanFrame) -> Head:
        (low, high), unit = self._device.bus.units, unit_of(message, frame)
        foreign = unit is not None and message.direction != "request" and not low <= unit <= high
        address = carried(message, frame, "address") if carries(message, "address") else None
        slot, (here, right) = carried(message, frame, "multiplexer"), sums(message, frame.data)
        return Head(message, unit, slot, address, differences(message, unit or 0, frame), here != right, foreign)

    def _result(self, head: Head, frame: CanFrame) -> FrameResult:
        """Return the result of the head of a frame, for any words in it."""
        message = head.message
        telegram = self._telegrams.get(message.name)
        about = {"parameter": head.address} if telegram is None else {"multiplexer": head.slot}
        text = _message_text(head, frame.id, telegram)
        details = {"can_id": frame.id, "message": message.name, **about}
        return FrameResult(
            frame.data,
            "can",
            "cyclic" if telegram is not None else _KINDS.get(message.direction, "cyclic"),
            head.unit,
            None,
            text,
            checks=check_text(*sums(message, frame.data)) if carries(message, "xor") else "",
            faults=tuple(_faults(head, self._device.bus)),
            details=details,
        )

    def _cyclic(self, known: _Known, result: FrameResult, pasted: Pasted, telegram: Telegram) -> DecodedFrame:
        head, message = known.head, known.head.message
        if head.slot * self._words[message.name] >= (telegram.words if self._words[message.name] else 0):
            last = -(-telegram.words // max(1, message.words)) - 1
            return DecodedFrame(result._replace(findings=(f"the manual knows multiplexers 0 to {last} only",)))
        if head.differences or head.wrong_sum:
            return DecodedFrame(result._replace(notes=(_DAMAGED,)))
        receiver = self._receiver(message.name, head.unit or 0)
        piece = Piece(telegram, receiver.positions[head.slot], receiver.keep(head.slot, pasted.frame), receiver)
        if head.slot in self._crossed[message.name]:
            return DecodedFrame(result, (piece,), head.unit)
        known.last = DecodedFrame(result, (piece,), head.unit, memo=[])
        return known.last

    def _signals(self, message: Message, pasted: Pasted) -> DecodedFrame:
        """Return the result for the signals of a message."""
        frame, telegram = pasted.frame, self._telegrams[message.name]
        unit = frame.id - message.identifier if message.adds_unit else None
        words = signals.words_of(message, frame.data)
        name = f"CAN {hex_text(frame.id, 3)}{'' if unit is None else f', unit {unit}'}, {message.name}"
        kind = _KINDS.get(message.direction, "cyclic")
        details = {"can_id": frame.id, "message": message.name}
        text = line(f"{name}: {message.title['en']}")
        result = FrameResult(frame.data, "can", kind, unit, None, text, details=details)
        pieces = Gathered(words)
        parts = [part for part, when in signals.parts(message) if signals.comes(message, when, words)]
        key = frame.id, *(part.start for part in parts)
        last = self._signalled.get(key)
        if last is not None and last.result.data == frame.data:
            return last
        contents = tuple(Piece(telegram, part, words[part.start : part.stop], pieces) for part in parts)
        _forget_many(self._signalled)
        decoded = self._signalled[key] = DecodedFrame(result, contents, unit, memo=[])
        return decoded

    def _parameter(self, head: Head, result: FrameResult, pasted: Pasted, requests: OpenRequests) -> DecodedFrame:
        frame = pasted.frame
        if head.address is None:
            return DecodedFrame(result, unit=head.unit)
        message, sound = head.message, not head.flaws
        raw = carried(message, frame, "raw") if carries(message, "raw") else None
        about = ParameterWord(head.address, raw)
        is_request, writes = message.direction == "request", message.name in self._writing
        # an answer reports what the device holds, so it is not checked against limits
        learned = raw is not None and sound and not is_request
        word = Word(head.address, raw, in_request=writes and is_request, learned=learned, stale=writes and sound)
        if is_request:
            strange = "" if head.unit is None else strange_unit(self._device.bus, head.unit)
            result = result._replace(findings=(strange,) if strange else ())
            return DecodedFrame(result, (word,), head.unit, message.name, request=about)
        exchange = message.answers or ""
        open_request: ParameterWord | None = requests.request(head.unit, exchange)
        findings = () if open_request is None else tuple(_answer_findings(open_request, about))
        answers = open_request is not None and open_request.address == about.address
        result = result._replace(findings=findings) if findings else result
        return DecodedFrame(result, (word,), head.unit, exchange, answers=answers)

    def _unknown(self, pasted: Pasted) -> DecodedFrame:
        """Return the result of a frame that is not a message of the device, or is incomplete."""
        frame = pasted.frame
        text = f"CAN {hex_text(frame.id, 3)}"
        details = {"can_id": frame.id}
        result = FrameResult(frame.data, "can", "other", None, None, text, details=details)
        senders = list(_senders(self._device, frame))
        if senders:
            fault = _unknown_kind(pasted, [message for message, _ in senders])
            text, unit = f"{text}: not readable", senders[0][1]
            result = result._replace(kind="unreadable", unit=unit, summary=text, faults=(fault,))
        else:
            notes = (_foreign_note(self._device),)
            result = result._replace(summary=f"{text}: not of this device", notes=notes)
        return DecodedFrame(result)


@dataclass(frozen=True, slots=True)
class Gathered:
    """The words of all signals of a frame."""

    carried: tuple[int, ...]
    per_frame: int = 0

    def words(self, positions: Sequence[int]) -> tuple[str, tuple[int, ...]]:
        """Return ("ok", the words at these positions)."""
        return "ok", tuple(self.carried[position] for position in positions)


def _crossed(device: Device, telegram: Telegram, words: int) -> set[int]:
    """Return the multiplexers with a part of a point whose other part comes with another one."""
    points = (point for point in device.points if point.telegram == telegram.name)
    slots = ({address // words for address in point.addresses} for point in points)
    return {slot for here in slots if len(here) > 1 for slot in here}


def _forget_many(kept: dict[Any, Any]) -> None:
    if len(kept) > _MOST_HEADS:
        kept.clear()


def decoder_of(device: Device, options: Options) -> CanFrameDecoder:
    """Return the decoder for the frames of the device."""
    return CanFrameDecoder(device, options.own.get("can_id"))


def _senders(device: Device, frame: CanFrame) -> Iterator[tuple[Message, int | None]]:
    """Yield the messages with the identifier of the frame, and the unit from the identifier or the bytes."""
    low, high = device.bus.units
    for message in device.messages:
        first, last = (low, high) if message.adds_unit else (0, 0)
        if first <= frame.id - message.identifier <= last:
            yield message, unit_of(message, frame)


def _fits(message: Message, frame: CanFrame) -> bool:
    """Return True if the first constant byte is that of the message: otherwise it is another message."""
    first = next(iter(places(message, "constant")), None)
    return first is None or frame.data[first] == message.roles[first].number


def _message_text(head: Head, identifier: int, telegram: Telegram | None) -> str:
    """Return a frame in one line: `CAN 321h, unit 1, visualisation: multiplexer 0, words 0 to 2 (nr 1 to 3)`."""
    message = head.message
    unit = "" if head.unit is None else f", unit {head.unit}"
    name = f"CAN {hex_text(identifier, 3)}{unit}, {message.name}"
    if head.address is not None:
        return f"{name}: parameter {address_text(head.address)}"
    if telegram is None:
        return line(f"{name}: {message.title['en']}")
    first = head.slot * message.words
    where = f"multiplexer {head.slot}, " if carries(message, "multiplexer") else ""
    return f"{name}: {where}words {first} to {first + message.words - 1} of {telegram.name}"


def _foreign_note(device: Device) -> str:
    """Return the identifiers of the messages: `33Fh read_request, write_request; 320h to 33Eh visualisation, ...`."""
    low, high = device.bus.units
    names: dict[str, list[str]] = {}
    for message in device.messages:
        where = hex_text(message.identifier, 3)
        if message.adds_unit:
            where = f"{hex_text(message.identifier + low, 3)} to {hex_text(message.identifier + high, 3)}"
        names.setdefault(where, []).append(message.name)
    known = "; ".join(f"{where} {', '.join(here)}" for where, here in names.items())
    return f"no message of {device.id} has this identifier: {known}"


def _faults(head: Head, bus: Bus) -> Iterator[str]:
    """Yield what is wrong with a frame read as this message."""
    if head.foreign:
        yield strange_unit(bus, head.unit or 0)
    for byte in head.differences:
        here, due = hex_text(byte.here, 2), hex_text(byte.due, 2)
        yield f"byte {byte.place} is {here}, in this message it is {due}"
    if head.wrong_sum:
        yield "the checksum is wrong"


def _answer_findings(request: ParameterWord, answer: ParameterWord) -> Iterator[str]:
    """Yield how an answer contradicts the request before it."""
    if request.address != answer.address:
        yield f"the request before asked for parameter {request.address}, this answers {answer.address}"
    elif request.raw is not None and request.raw != answer.raw:
        was, came = (hex_words((word or 0,)) for word in (request.raw, answer.raw))
        yield f"it does not repeat what was written: {was} was, {came} came back"


def _unknown_kind(pasted: Pasted, messages: Sequence[Message]) -> str:
    """Return why none of the messages with its identifier fits a frame."""
    frame = pasted.frame
    if pasted.remote:
        return "a remote request carries no data, and the manual has none"
    due = dict.fromkeys(str(message.length) for message in messages)
    if str(len(frame.data)) not in due:
        return f"every message has {' or '.join(due)} bytes, here are {len(frame.data)}"
    known = [(at, message) for message in messages for at in places(message, "constant")[:1]]
    place = known[0][0] if known else 0
    names = ", ".join(f"{hex_text(message.roles[at].number, 2)} {message.name}" for at, message in known)
    return f"byte {place} is {hex_text(frame.data[place], 2)}; on this identifier it is {names}"
