"""Decodes CAN frames: cyclic telegrams, requests, and answers to the last request of each unit."""

from collections.abc import Callable, Collection, Hashable, Iterator, Sequence
from functools import lru_cache
from operator import itemgetter
from typing import NamedTuple, TypeVar

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
from fieldscribe.families.can.notation import read_frames, read_identifier
from fieldscribe.families.decoded_frame import MOST_STATES, DecodedFrame, Layout, OpenRequests, Piece, Word
from fieldscribe.families.frame_results import FrameResult, Options
from fieldscribe.model import Bus, Device, Message, Telegram
from fieldscribe.text import line
from fieldscribe.wording import address_text
from fieldscribe.wording.numbers import check_text, hex_text, hex_words, strange_unit

_DAMAGED = "its words are not read, for the frame is damaged"
_MOST_HEADS = 1024
"""The most heads of frames whose message is remembered."""
T = TypeVar("T")
_KINDS = {"request": "request", "response": "reply"}


class _Known(NamedTuple):
    """A head, the result of frames with it, and all that is said of them if their words are not read."""

    head: Head
    result: FrameResult
    unread: DecodedFrame | None


class CanFrameDecoder:
    """Decodes the frames of one device; keeps the words of telegrams that span several frames.

    Most frames of telegrams come again as they were, so the last one of each head is kept.
    """

    def __init__(self, device: Device, can_id: str | None = None) -> None:
        self._device = device
        self._identifier = None if can_id is None else read_identifier(can_id)
        self._received = lru_cache(MOST_STATES)(self._receive)
        self._first = _getter({place for message in device.messages for place in places(message, "constant")[:1]})
        self._telling: dict[Hashable, Callable[[bytes], Hashable]] = {}
        self._heads: dict[Hashable, _Known | None] = {}
        self._last: dict[Hashable, tuple[Hashable, DecodedFrame]] = {}
        """The last frame of each layout, with the words of other frames on which it depends."""
        self._telegrams = {telegram.message: telegram for telegram in reversed(device.telegrams)}
        self._messages = {message.name: message for message in device.messages}
        self._signalled = {
            message.name: [(Layout(self._telegrams[message.name], part), when) for part, when in signals.parts(message)]
            for message in device.messages
            if message.fields
        }
        """The layouts of the signals of a message that come together, and their selection."""
        asks = [message for message in device.messages if message.direction == "request" and carries(message, "raw")]
        writing = {message.name for message in asks}
        self._writing = writing | {message.name for message in device.messages if message.answers in writing}
        """The requests that carry a value, and the answers to them."""

    def frames(self, texts: Sequence[str]) -> list[CanFrame]:
        """Return the frames in pasted texts. Raises UnclearError."""
        return read_frames(texts, self._identifier)

    def decode(self, frame: CanFrame, requests: OpenRequests, *, expecting: bool = False) -> DecodedFrame:
        """Decode one frame; any bytes are safe."""
        del expecting  # the messages themselves say which frame answers which
        for name in () if frame.remote else self._signalled:
            if frames.is_of(self._messages[name], self._device.bus.units, frame):
                return self._signals(self._messages[name], frame)
        known = None if frame.remote or len(frame.data) != LENGTH else self._known(frame)
        if known is None:
            return self._unknown(frame)
        head, result, unread = known
        if unread is not None:
            return unread
        if head.message.name in self._telegrams:
            return self._cyclic(head, result, frame)
        return self._parameter(head, result, frame, requests)

    def _known(self, frame: CanFrame) -> _Known | None:
        """Return the message of a frame, and the result of its head; None if no message fits.

        Both depend only on the bytes that carry no words, so they are remembered for frames that differ in words alone.
        """
        beginning = frame.id, self._first(frame.data)
        telling = self._telling.get(beginning)
        if telling is None:
            telling = _keep(self._telling, beginning, _getter(self._telling_places(frame)))
        key = beginning, telling(frame.data)
        if key in self._heads:
            return self._heads[key]
        head = self.recognise(frame)
        result = None if head is None else self._result(head, frame)
        known = _Known(head, result, self._unread(head, result)) if head and result else None
        return _keep(self._heads, key, known)

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
            "can",
            "cyclic" if telegram is not None else _KINDS.get(message.direction, "cyclic"),
            head.unit,
            None,
            text,
            checks=check_text(*sums(message, frame.data)) if carries(message, "xor") else "",
            faults=tuple(_faults(head, self._device.bus)),
            details=details,
        )

    def _unread(self, head: Head, result: FrameResult) -> DecodedFrame | None:
        """Return a frame of a telegram that has no words, or is damaged; None for others."""
        telegram, words = self._telegrams.get(head.message.name), head.message.words
        if telegram is None:
            return None
        if head.slot * words >= (telegram.words if words else 0):
            last = -(-telegram.words // max(1, words)) - 1
            return DecodedFrame(result._replace(findings=(f"the manual knows multiplexers 0 to {last} only",)))
        damaged = head.differences or head.wrong_sum
        return DecodedFrame(result._replace(notes=(_DAMAGED,))) if damaged else None

    def _cyclic(self, head: Head, result: FrameResult, frame: CanFrame) -> DecodedFrame:
        receiver, layouts, crossed = self._received(head.message.name, head.unit or 0)
        layout = layouts[head.slot]
        kept, numbers = self._last.get(layout), crossed.get(head.slot)
        if kept and not numbers and kept[0] == frame.data:
            return kept[1]
        piece = Piece(layout, receiver.keep(head.slot, frame))
        key = (frame.data, *map(receiver.words, numbers)) if numbers else frame.data
        if kept and kept[0] == key:
            return kept[1]
        return _keep(self._last, layout, (key, DecodedFrame(result, (piece,), head.unit, memo=[])))[1]

    def _receive(self, name: str, unit: int) -> tuple[Receiver, list[Layout], dict[int, list[tuple[int, ...]]]]:
        """Return the receiver of a message of a unit, and the layout of the frames with each multiplexer.

        The last are the places of numbers whose parts come with several multiplexers, whole and each, by multiplexer.
        """
        telegram, points = self._telegrams[name], self._device.points
        receiver = Receiver(telegram, self._messages[name], unit)
        layouts = [Layout(telegram, positions, receiver) for positions in receiver.positions]
        crossed: dict[int, list[tuple[int, ...]]] = {}
        for addresses in [point.addresses for point in points if point.telegram == telegram.name]:
            slots = {address // receiver.per_frame for address in addresses}
            for slot in slots if len(slots) > 1 else ():
                crossed.setdefault(slot, []).extend((addresses, *((address,) for address in addresses)))
        return receiver, layouts, crossed

    def _signals(self, message: Message, frame: CanFrame) -> DecodedFrame:
        """Return the result for the signals of a message."""
        words = signals.words_of(message, frame.data)
        layouts = [layout for layout, when in self._signalled[message.name] if signals.comes(message, when, words)]
        key = frame.id, *layouts
        kept = self._last.get(key)
        if kept and kept[0] == frame.data:
            return kept[1]
        unit = frame.id - message.identifier if message.adds_unit else None
        name = f"CAN {hex_text(frame.id, 3)}{'' if unit is None else f', unit {unit}'}, {message.name}"
        details = {"can_id": frame.id, "message": message.name}
        text = line(f"{name}: {message.title['en']}")
        result = FrameResult("can", _KINDS.get(message.direction, "cyclic"), unit, None, text, details=details)
        pieces = tuple(Piece(layout, words[layout.positions.start : layout.positions.stop]) for layout in layouts)
        return _keep(self._last, key, (frame.data, DecodedFrame(result, pieces, unit, memo=[])))[1]

    def _parameter(self, head: Head, result: FrameResult, frame: CanFrame, requests: OpenRequests) -> DecodedFrame:
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

    def _unknown(self, frame: CanFrame) -> DecodedFrame:
        """Return the result of a frame that is not a message of the device, or is incomplete."""
        text = f"CAN {hex_text(frame.id, 3)}"
        details = {"can_id": frame.id}
        result = FrameResult("can", "other", None, None, text, details=details)
        senders = list(_senders(self._device, frame))
        if senders:
            fault = _unknown_kind(frame, [message for message, _ in senders])
            text, unit = f"{text}: not readable", senders[0][1]
            result = result._replace(kind="unreadable", unit=unit, summary=text, faults=(fault,))
        else:
            notes = (_foreign_note(self._device),)
            result = result._replace(summary=f"{text}: not of this device", notes=notes)
        return DecodedFrame(result)


def _getter(places: Collection[int]) -> Callable[[bytes], Hashable]:
    """Return the function that gives the bytes at these places, or without places something that data have alike."""
    return itemgetter(*places) if places else len


def _keep(kept: dict[Hashable, T], key: Hashable, value: T) -> T:
    """Keep a value, and return it; if there are too many, the others are forgotten."""
    if len(kept) >= _MOST_HEADS:
        kept.clear()
    kept[key] = value
    return value


def decoder_of(device: Device, options: Options) -> CanFrameDecoder:
    """Return the decoder for the frames of the device."""
    return CanFrameDecoder(device, options.of_family.get("can_id"))


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


def _unknown_kind(frame: CanFrame, messages: Sequence[Message]) -> str:
    """Return why none of the messages with its identifier fits a frame."""
    if frame.remote:
        return "a remote request carries no data, and the manual has none"
    due = dict.fromkeys(str(message.length) for message in messages)
    if str(len(frame.data)) not in due:
        return f"every message has {' or '.join(due)} bytes, here are {len(frame.data)}"
    known = [(at, message) for message in messages for at in places(message, "constant")[:1]]
    place = known[0][0] if known else 0
    names = ", ".join(f"{hex_text(message.roles[at].number, 2)} {message.name}" for at, message in known)
    return f"byte {place} is {hex_text(frame.data[place], 2)}; on this identifier it is {names}"
