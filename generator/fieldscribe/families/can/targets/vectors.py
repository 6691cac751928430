"""Vectors of CAN frames: messages built and read, and telegrams that come in frame by frame."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Literal

from fieldscribe.families.can import identifier_bits, of_bus
from fieldscribe.families.can.frames import (
    CanFrame,
    Receiver,
    build,
    carriers,
    carries,
    checksum,
    frame_count,
    identifier,
    parse,
    places,
    request_and_answer,
)
from fieldscribe.model import Bus, Device, Message, Point, Telegram
from fieldscribe.targets.vectors.exchanges import Script, Wire, single_bit_errors, with_flipped, words_in_bytes
from fieldscribe.targets.vectors.lines import Lines
from fieldscribe.targets.vectors.numbers import bytes_exchanged
from fieldscribe.targets.vectors.oracle import as_raw

KINDS = {
    "can_build": "status:word id:int? bytes:bytes? frame:note?",
    "can_reply": "id:int bytes:bytes? status:word address:int? raw:int? frame:note?",
    "can_taken": "frames:frames taken:ints",
    "can_bus": "only:rust identifier_bits:int bitrate:int?",
    "can_carrier": "only:rust carrier:word",
    "can_telegram": "frames:frames? taken:ints? status:word raw:int?",
    "can_signal": "id:int bytes:bytes? status:word raw:int? packed:bytes?",
    "can_text": "only:c frames:frames? taken:ints? status:word words:ints?",
}
"""The kinds of vectors for frames of a maker's own protocol."""

_PATTERN = 0x9A6C_5D33_E18F_2B47
"""Bits around the signal under test."""
_NUMBERS = ((0, 0), (1, 1), (0x0102, 0xFEDC), (0xFFFF, 0xFFFF), (500, 1234), (0x00FF, 0xFF00), (0x8000, 0x8000))


Request = tuple[str, int, int, int]
"""The name of a message, its unit, its address and its raw number."""


class CanWire(Wire):
    """Exchanges of parameters, word by word; a frame is its identifier in four bytes and its data."""

    PREFIX = "can_"

    def __init__(self, lines: Lines, device: Device) -> None:
        super().__init__(lines, device, device.bus.units[0])
        self.by_name = {message.name: message for message in device.messages}
        self.messages = {writes: request_and_answer(device.messages, writes=writes) for writes in (False, True)}

    def reads(self, point: Point, words: tuple[int, ...]) -> Script | None:
        """Return a request and an answer for each word."""
        return self._script(point, words, writes=False)

    def writes(self, point: Point, words: tuple[int, ...], *, keep: bool) -> Script | None:
        """Return a request and an answer for each word."""
        return None if keep else self._script(point, words, writes=True)

    def _script(self, point: Point, words: tuple[int, ...], *, writes: bool) -> Script | None:
        request, answer = self.messages[writes]
        if point.space != "parameter" or request is None or answer is None:
            return None
        return [
            (self._bytes(request, address, word if writes else 0), self._bytes(answer, address, word))
            for address, word in zip(sorted(point.addresses), words, strict=True)
        ]

    def _bytes(self, message: Message, address: int, raw: int) -> bytes:
        _, frame = build(message, self.bus.units, self.unit, address, raw)
        return frame.id.to_bytes(4, "big") + frame.data

    def bad_answers(self, point: Point, script: Script, *, writes: bool) -> Iterator[tuple[str, Script]]:
        """Yield the exchange without its answer, with that of another place, and with another number in the echo."""
        _, answer = self.messages[writes]
        [(sent, good)] = script
        yield "timeout", [(sent, b"")]
        yield "timeout", [(sent, with_flipped(good, 3))]
        if answer is None or not carries(answer, "raw"):
            return
        word = parse(answer, self.unit, CanFrame(int.from_bytes(good[:4], "big"), good[4:])).raw
        if carries(answer, "address"):
            yield "timeout", [(sent, self._bytes(answer, point.addresses[0] ^ 1, word))]
        if writes:
            yield "echo_mismatch", [(sent, self._bytes(answer, point.addresses[0], word ^ 0x0100))]

    def set_request(self, request: Request) -> None:
        """Set the message of the next vectors, and what it carries."""
        self.lines.set("message", *request)

    def build(self, request: Request) -> tuple[object, ...]:
        """Return the status of a message, its identifier and its data."""
        name, *numbers = request
        status, frame = build(self.by_name[name], self.bus.units, *numbers)
        return status, *((frame.id, frame.data) if status == "ok" else (None, None))

    def parse(self, request: Request, answer: CanFrame) -> tuple[object, ...]:
        """Return a frame, its status as the message, its address and its raw number."""
        name, unit, *_ = request
        parsed = parse(self.by_name[name], unit, answer)
        carried = (parsed.address, parsed.raw) if parsed.status == "ok" else (None, None)
        return answer.id, answer.data, parsed.status, *carried

    def add_message(self, message: Message) -> None:
        """Add messages to build, good frames, and frames with another identifier, of every length, with a wrong bit."""
        low, high = self.bus.units
        tried = [(low, *pair) for pair in _NUMBERS] + [(unit, 0x0102, 0xFEDC) for unit in (high, low - 1, high + 1)]
        tried += [(low, 0x10000, 0), (low, 0, 0x10000), (high + 1, 0x10000, 0x10000)]
        self.add_builds((message.name, *numbers) for numbers in tried if numbers[0] >= 0)
        goods = [build(message, self.bus.units, low, *numbers)[1] for numbers in _NUMBERS]
        good = goods[2]
        frames = [*goods, *(CanFrame(number, good.data) for number in (good.id ^ 1, good.id + 1, 0, 0x7FF))]
        frames += [CanFrame(good.id, good.data[:length]) for length in range(len(good.data))]
        frames += [CanFrame(good.id, data) for data in single_bit_errors(good.data)]
        self.add_replies((message.name, low, 0, 0), frames)
        self.add_replies((message.name, high, 0, 0), (build(message, self.bus.units, high, *_NUMBERS[2])[1], good))


def wires(lines: Lines, device: Device) -> list[CanWire]:
    """Return the one way in which parameters travel."""
    return [CanWire(lines, device)]


def frames(lines: Lines, device: Device) -> None:
    """Add all vectors of the frames of a device with messages of its own."""
    wire = CanWire(lines, device)
    for message in device.messages:
        if message.roles and not carries(message, "word"):
            wire.add_message(message)
    lines.add("can_bus", identifier_bits(device.bus), of_bus(device.bus).bitrate)
    wire.add_codes("constant", "exception", device.bus.exceptions)
    for message in (message for message in device.messages if message.fields):
        _signals(lines, device, message)
        lines.add("size", "words", message.name, sum(field.words for field in message.fields))
        if message.every is not None:
            lines.add("size", "every", message.name, message.every)
    reads, _ = wire.messages[False]
    for group in device.groups:
        members = (point for point in device.points if point.generated and point.readable and point.group == group.name)
        addresses = [address for point in members if point.space == "parameter" for address in point.addresses]
        if addresses and reads is not None:
            lines.add("group", group.name, list(dict.fromkeys(addresses)))
    carrying = carriers(device)
    for telegram in device.telegrams:
        if telegram.name in carrying and carrying[telegram.name].roles:
            _telegram(lines, device, telegram, carrying[telegram.name])


def _telegram(lines: Lines, device: Device, telegram: Telegram, message: Message) -> None:
    for point in device.points:
        if point.telegram == telegram.name and point.generated:
            received = _Received(lines, telegram, message, point, device.bus.units[0])
            received.text() if point.form == "text" else received.number()
    if message.words:
        lines.add("size", "frames", telegram.name, frame_count(telegram, message))
        for sender in dict.fromkeys(device.bus.units):
            _damaged_frames(lines, telegram, message, sender)


def _damaged_frames(lines: Lines, telegram: Telegram, message: Message, unit: int) -> None:
    """Add good frames, and for each byte that holds no word a frame in which this byte is wrong."""
    data = []
    for place, role in enumerate(message.roles):
        known = {"constant": role.number, "unit": unit & 0xFF, "word": 0x35 + 0x11 * place & 0xFF}
        data.append(known.get(role.kind, 0))
    good = CanFrame(identifier(message, unit), _summed(message, data))
    frames = [good, CanFrame(good.id ^ 1, good.data), CanFrame(good.id, good.data[:-1])]
    for place, role in enumerate(message.roles):
        if role.kind != "word":
            frames.append(CanFrame(good.id, with_flipped(good.data, place, 0x80)))
    receiver = Receiver(telegram, message, unit)
    lines.set("telegram", telegram.name, unit)
    lines.add("can_carrier", message.name)
    lines.add("can_taken", _pairs(frames), [int(receiver.take(frame)) for frame in frames])


def _summed(message: Message, data: Sequence[int]) -> bytes:
    """Return the data with its checksums."""
    result = bytearray(data)
    for place in places(message, "xor"):
        result[place] = checksum(result, message.roles[place].number)
    return bytes(result)


def _pairs(frames: Sequence[CanFrame]) -> list[tuple[int, bytes]]:
    return [(frame.id, frame.data) for frame in frames]


class _Received:
    """Frames for one point of a telegram, and the value of the point after them."""

    def __init__(self, lines: Lines, telegram: Telegram, message: Message, point: Point, unit: int) -> None:
        self.lines, self.telegram, self.message, self.point, self.unit = lines, telegram, message, point, unit

    def _frame(self, slot: int, pattern: int) -> CanFrame:
        """Return a frame of a slot; each word is the pattern, changed by its place so that no two words are equal."""
        data = []
        for role in self.message.roles:
            word = (pattern + 0x1111 * (role.number >> 1)) & 0xFFFF
            parts = {"constant": role.number, "unit": self.unit >> role.number & 0xFF, "multiplexer": slot}
            data.append(parts.get(role.kind, word & 0xFF if role.number & 1 else word >> 8))
        return CanFrame(identifier(self.message, self.unit), _summed(self.message, data))

    def number(self) -> None:
        """Add the point missing and complete; if it spans two frames, also torn, in every possible order."""
        per_frame = self.message.words
        slots = [position // per_frame for position in self.point.addresses]
        high, low = slots[0], slots[-1]
        first = self._frame(high, 0x1234)
        self._answer([])
        self._answer([first])
        self._answer([first, self._frame(high, 0xFEDC)])
        other = self._frame((high + 1) % frame_count(self.telegram, self.message), 0x0F0F)
        self._answer([other, CanFrame(first.id ^ 1, first.data), CanFrame(first.id, first.data[:7])])
        self._answer([CanFrame(first.id, with_flipped(first.data, 0)), self._frame(0xFF, 0x1111)])
        if high == low:
            return
        h1, h2, l1, l2 = (high, 0x0001), (high, 0x0002), (low, 0xFFFF), (low, 0x0000)
        h0 = (high, -0x1111 * (self.point.addresses[0] % per_frame) & 0xFFFF)  # high word 0, as before any frame
        for order in (
            (h1, l1), (l1, h1), (h1, l1, h1), (h1, l1, h2), (h1, l2, h2, l2), (h1, l1, h1, l1), (h1, l1, h1, l2),
            (h1, l1, h2, l2, h2), (h1, h1, l1), (h1, l1, l2, h1), (l1, h1, h1), (h1, h1, l1, h1),
            (h2, l1, h1, l1, h1, l2), (l1, h1, l2, h1, l1), (h1, l1, h1, h1), (l1, h0), (h0, l1),
        ):  # fmt: skip
            self._answer([self._frame(*position) for position in order])

    def text(self) -> None:
        """Add a text before any frame, before the last one, and complete."""
        slots = dict.fromkeys(position // self.message.words for position in self.point.addresses)
        frames = [self._frame(slot, 0x2143 + slot) for slot in slots]
        for count in dict.fromkeys((0, len(frames) - 1, len(frames))):
            self._answer(frames[:count])

    def _answer(self, frames: list[CanFrame]) -> None:
        """Add one vector: the value of the point after these frames. Each word of a text may be from another frame."""
        receiver = Receiver(self.telegram, self.message, self.unit)
        taken = [int(receiver.take(frame)) for frame in frames]
        addresses, is_text = self.point.addresses, self.point.form == "text"
        parts = [receiver.words(part) for part in ([(at,) for at in addresses] if is_text else [addresses])]
        status = next((status for status, _ in parts if status != "ok"), "ok")
        words = [word for _, words in parts for word in words]
        moved = (bytes_exchanged(self.point.shape, word) for word in words)
        pattern = int.from_bytes(words_in_bytes([*moved]), "big")
        number = as_raw(self.point.shape, pattern >> (self.point.bits[1] if self.point.bits else 0))
        self.lines.set("point", self.point.item)
        self.lines.set("telegram", self.telegram.name, self.unit)
        answer = None if status != "ok" else words if is_text else number
        self.lines.add("can_text" if is_text else "can_telegram", _pairs(frames), taken, status, answer)


def _signals(lines: Lines, device: Device, message: Message) -> None:
    """Add frames of a message: the value of each signal in them, and the bytes of the signal with its selectors."""
    low, high = device.bus.units
    places = {field.word: place for place, field in enumerate(message.fields)}
    for point in device.points:
        if point.telegram != message.name or not point.generated:
            continue
        number = places[point.addresses[0]]
        when = message.fields[number].when
        known = {place: raws[-1] for place, raws in when}
        ends = dict.fromkeys((0, 1, (1 << point.width) - 1, 1 << (point.width - 1), _PATTERN % (1 << point.width)))
        tried = [(low, _filled(message, {**known, number: raw}, fill)) for raw in ends for fill in (0, _PATTERN)]
        tried += [(low, _filled(message, {**known, place: raws[-1] ^ 1}, _PATTERN)) for place, raws in when]
        good = tried[0][1]
        tried += [(high, good), (low, good[:-1]), (low, good + b"\0")]
        lines.set("point", point.item)
        for unit, data in tried:
            lines.set("telegram", message.name, unit)
            _signal(lines, message, (number, point), CanFrame(identifier(message, unit), data))
        lines.add("can_signal", identifier(message, low) ^ 1, good, "wrong_id")


def _signal(lines: Lines, message: Message, signal: tuple[int, Point], frame: CanFrame) -> None:
    """Add the value of a signal in a frame."""
    number, point = signal
    when = message.fields[number].when
    if len(frame.data) != message.length:
        lines.add("can_signal", frame.id, frame.data, "wrong_length")
    elif not all(_taken(message, place, frame.data) in raws for place, raws in when):
        lines.add("can_signal", frame.id, frame.data, "missing")
    else:
        raw = _taken(message, number, frame.data)
        packed = _filled(message, {**{place: raws[-1] for place, raws in when}, number: raw}, 0)
        lines.add("can_signal", frame.id, frame.data, "ok", as_raw(point.shape, raw), packed)


def _taken(message: Message, number: int, data: bytes) -> int:
    """Return the raw number of a field without its sign, by writing out the bits of a message."""
    field, size = message.fields[number], 8 * message.length
    if field.low_first:
        written = f"{int.from_bytes(data, 'little'):0{size}b}"
        return int(written[size - field.start - field.width : size - field.start], 2)
    first = 8 * (field.start // 8) + 7 - field.start % 8
    return int(f"{int.from_bytes(data, 'big'):0{size}b}"[first : first + field.width], 2)


def _filled(message: Message, raws: Mapping[int, int], fill: int) -> bytes:
    """Return the bytes of a message with these raw numbers, over the bits of `fill`."""
    data = (fill & (1 << 8 * message.length) - 1).to_bytes(message.length, "big")
    for number, raw in raws.items():
        field, size = message.fields[number], 8 * message.length
        order: Literal["little", "big"] = "little" if field.low_first else "big"
        high = field.start + field.width if field.low_first else size - 8 * (field.start // 8) - 7 + field.start % 8
        written = f"{int.from_bytes(data, order):0{size}b}"
        written = written[: size - high] + f"{raw:0{field.width}b}" + written[size - high + field.width :]
        data = int(written, 2).to_bytes(message.length, order)
    return data


def limits(lines: Lines, bus: Bus) -> None:
    """Add the length of identifiers, and the bit rate."""
    lines.add_limits(identifier_bits=identifier_bits(bus))
    bitrate = of_bus(bus).bitrate
    if bitrate is not None:
        lines.add("size", "bitrate", None, bitrate)
