"""The end of a CAN bus where devices are: sends telegrams by itself, answers requests, takes messages. No I/O.

A frame is its identifier in four bytes, the highest bit set for an extended one, and its data.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from fieldscribe.arithmetic.words import joined
from fieldscribe.families.can import frames, identifier_bits, signals
from fieldscribe.families.can.frames import CanFrame, carriers, identifier, parse, request_and_answer
from fieldscribe.model import Message, Telegram
from fieldscribe.simulation.device import Refusal, SimulatedDevice
from fieldscribe.simulation.line import Answer, Core

LINES = {"can": ("can",)}
REFUSALS, LARGEST_CODE = (), 0
_EXTENDED = 1 << 31
_STANDARD_BITS = 11
_USUAL_PAUSE = 0.1
"""The seconds between two frames of a telegram, where the description does not say."""
_PARAMETERS = ("parameter", 0)


class CanCore(Core):
    """Devices on a bus. What they refuse they do not answer."""

    def __init__(self, devices: Sequence[SimulatedDevice], framing: str = "can") -> None:
        self.devices, self.framing = devices, framing
        self._units = [_Unit(device) for device in devices]

    def cut(self, data: bytes, *, quiet: bool) -> tuple[list[bytes], int]:
        """Return the data as one frame: a bus has whole ones."""
        del quiet
        return [data], len(data)

    def answer(self, request: bytes) -> Answer | None:
        """Return what a frame leads to; None if it is for no device of this bus."""
        number = int.from_bytes(request[:4], "big")
        frame, extended = CanFrame(number & ~_EXTENDED, request[4:]), bool(number & _EXTENDED)
        answers = [answer for unit in self._units if (answer := unit.answer(frame, extended=extended))]
        return next((answer for answer in answers if answer.data), answers[0] if answers else None)

    def spoiled(self, answer: bytes, what: str) -> bytes:
        """Return an answer that is wrong in one way; the sums of its bytes are right, unless they are meant."""
        if len(answer) < 5 or what == "exception":
            return answer
        if what == "unit":
            return answer[:3] + bytes((answer[3] ^ 1,)) + answer[4:]
        place = 4 if what == "function" else len(answer) - 1
        return answer[:place] + bytes((answer[place] ^ 0x55,)) + answer[place + 1 :]

    def due(self, now: float) -> tuple[list[bytes], float | None]:
        """Return the frames that the devices send by themselves by now, and when the next one goes."""
        senders = [sender for unit in self._units for sender in unit.senders]
        data = [frame for sender in senders if sender.next <= now for frame in sender.frames(now)]
        return data, min((sender.next for sender in senders), default=None)


core_of = CanCore


class _Sender:
    """A message that a device sends by itself: one frame after the other, for all parts of its telegram."""

    def __init__(self, unit: _Unit, message: Message, telegram: Telegram, pause: float) -> None:
        self._unit, self._message, self._area = unit, message, (telegram.name, 0)
        self.every = message.every / 1000 if message.every else pause
        self.next = 0.0
        choices = dict.fromkeys(when for _, when in signals.parts(message))
        self._choices = [when for when in choices if not any({*when} < {*other} for other in choices)] or [()]
        self._count = len(self._choices) if message.fields else frames.frame_count(telegram, message)
        self._slot = 0

    def frames(self, now: float) -> Iterator[bytes]:
        """Yield the next frame; those that were missed meanwhile are left out."""
        device = self._unit.device
        device.advance()
        words = device.memory.areas.get(self._area, {})
        data = self._signals(words) if self._message.fields else self._words(words)
        self._slot = (self._slot + 1) % self._count
        self.next = max(self.next + self.every, now + self.every / 2)
        yield self._unit.framed(self._message, data)

    def _words(self, words: Mapping[int, int]) -> bytes:
        first = self._slot * self._message.words
        numbers = {"unit": self._unit.device.unit, "multiplexer": self._slot}
        return frames.filled(self._message, numbers, {at - first: words[at] for at in words})

    def _signals(self, words: Mapping[int, int]) -> bytes:
        """Return the bytes of the fields that come together, with the numbers that select them."""
        chosen = {place: raws[0] for place, raws in self._choices[self._slot]}
        fields = self._message.fields
        held = [words.get(at, 0) for at in range(max((field.word + field.words for field in fields), default=0))]
        for place, raw in chosen.items():
            for at in range(fields[place].words):
                held[fields[place].word + at] = raw >> 16 * (fields[place].words - 1 - at) & 0xFFFF
        raws = {
            number: joined(held[field.word : field.word + field.words])
            for number, field in enumerate(fields)
            if signals.comes(self._message, field.when, held)
        }
        return signals.data_of(self._message, raws)


class _Unit:
    """One device, with its messages."""

    def __init__(self, device: SimulatedDevice) -> None:
        self.device = device
        model = device.device
        pause = model.bus.line_numbers.get("timing_pause_between_messages_ms", 0) / 1000 or _USUAL_PAUSE
        carried = {telegram.name: telegram for telegram in model.telegrams}
        by_telegram = carriers(model)
        self.senders = [
            _Sender(self, message, carried[name], pause)
            for name, message in by_telegram.items()
            if carried[name].direction == "cyclic" and message.direction == "cyclic"
        ]
        self._taken = [(name, message) for name, message in by_telegram.items() if message.direction == "request"]
        self._pairs = [request_and_answer(model.messages, writes=writes) for writes in (False, True)]

    def framed(self, message: Message, data: bytes) -> bytes:
        """Return a frame of the device."""
        bits = message.bits or identifier_bits(self.device.device.bus)
        number = identifier(message, self.device.unit) | (_EXTENDED if bits > _STANDARD_BITS else 0)
        return number.to_bytes(4, "big") + data

    def answer(self, frame: CanFrame, *, extended: bool) -> Answer | None:
        """Return what a frame leads to; None if it is no request to this device."""
        for writes, (request, answer) in enumerate(self._pairs):
            if request is None or extended != self._is_extended(request):
                continue
            parsed = parse(request, self.device.unit, frame)
            if parsed.status == "wrong_check":
                self.device.complain("checksum", f"a {request.name} has a wrong checksum", request.source)
                return Answer(self.device, b"", refused="wrong checksum")
            if parsed.status == "ok":
                return self._parameter(parsed.address, parsed.raw if writes else None, answer)
        for name, message in self._taken:
            fits = frame.id == identifier(message, self.device.unit) and len(frame.data) == message.length
            if fits and extended == self._is_extended(message):
                return self._received(name, message, frame)
        return None

    def _is_extended(self, message: Message) -> bool:
        return (message.bits or identifier_bits(self.device.device.bus)) > _STANDARD_BITS

    def _parameter(self, address: int, raw: int | None, answer: Message | None) -> Answer:
        """Read a word of a parameter, or write it: then the answer has what the device holds after that."""
        try:
            if raw is not None:
                self._write(address, raw)
                word = self.device.memory.areas[_PARAMETERS][address]
            else:
                (word,) = self.device.read(_PARAMETERS, (address,))
        except Refusal as refusal:
            return self._refused(refusal)
        if answer is None:
            return Answer(self.device, b"")
        data = frames.filled(answer, {"unit": self.device.unit, "address": address, "raw": word})
        return Answer(self.device, self.framed(answer, data))

    def _write(self, address: int, raw: int) -> None:
        """Write one word; the other words of its point stay as they are. Raises Refusal."""
        points = self.device.layout.writers.get(_PARAMETERS, {}).get(address, ())
        held = self.device.memory.areas.get(_PARAMETERS, {})
        cells = {at: held[at] for point in points for at in point.addresses} | {address: raw}
        self.device.write(_PARAMETERS, cells)

    def _received(self, name: str, message: Message, frame: CanFrame) -> Answer:
        """Take the signals, or the words, of a message."""
        if message.fields:
            words = dict(enumerate(signals.words_of(message, frame.data)))
            here = [field for field in message.fields if signals.comes(message, field.when, [*words.values()])]
            words = {at: words[at] for field in here for at in range(field.word, field.word + field.words)}
        else:
            words = frames.telegram_words(message, frame)
        refused = ""
        writers = self.device.layout.writers.get((name, 0), {})
        for point in {point.name: point for at in words for point in writers.get(at, ())}.values():
            try:
                self.device.write((name, 0), {at: words[at] for at in point.addresses if at in words})
            except Refusal as refusal:
                refused = self._refused(refusal).refused
        return Answer(self.device, b"", refused=refused)

    def _refused(self, refusal: Refusal) -> Answer:
        self.device.complain_of(refusal)
        return Answer(self.device, b"", refused=refusal.why)
