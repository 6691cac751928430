"""Vectors of CAN frames: messages built and read, and telegrams that come in frame by frame."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.families.can import identifier_bits, of_bus
from fieldscribe.families.can.frames import CanFrame, build, checksum, identifier, parse
from fieldscribe.families.can.receiver import Receiver
from fieldscribe.targets.vectors.family_vectors import add_codes, add_limits
from fieldscribe.targets.vectors.numbers import as_raw

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Bus, Device, Message, Point, Telegram
    from fieldscribe.targets.vectors.family_vectors import Script
    from fieldscribe.targets.vectors.lines import Lines

KINDS = {
    "can_build": "unit:int address:int raw:int status:word id:int? bytes:bytes?",
    "can_parse": "unit:int id:int bytes:bytes? status:word address:int? raw:int?",
    "can_taken": "frames:frames taken:ints",
    "can_bus": "only:rust identifier_bits:int bitrate:int?",
    "can_carrier": "only:rust carrier:word",
    "can_telegram": "frames:frames? taken:ints? status:word raw:int?",
    "can_text": "only:c frames:frames? taken:ints? status:word words:ints?",
}
"""The kinds of vectors for frames of a maker's own protocol."""

_NUMBERS = ((0, 0), (1, 1), (0x0102, 0xFEDC), (0xFFFF, 0xFFFF), (500, 1234), (0x00FF, 0xFF00), (0x8000, 0x8000))


class CanWire:
    """Exchanges of parameters, word by word; a frame is its identifier in four bytes and its data."""

    def __init__(self, device: Device) -> None:
        self.units = device.bus.units
        self.unit = device.bus.units[0]
        self.asks = {writes: _request_and_answer(device, writes=writes) for writes in (False, True)}

    def opens(self, lines: Lines) -> None:
        """The unit."""
        lines.set("unit", self.unit)

    def reads(self, point: Point, words: tuple[int, ...]) -> Script | None:
        """A request and an answer for each word."""
        return self._script(point.space, point.addresses, words, writes=False)

    def writes(self, point: Point, words: tuple[int, ...], *, keep: bool) -> Script | None:
        """A request and an answer for each word."""
        return None if keep else self._script(point.space, point.addresses, words, writes=True)

    def _script(self, space: str, addresses: tuple[int, ...], words: tuple[int, ...], *, writes: bool) -> Script | None:
        request, answer = self.asks[writes]
        if space != "parameter" or request is None or answer is None:
            return None
        pairs = zip(sorted(addresses), words, strict=True)
        return [
            (self._sent(request, address, word if writes else 0), self._sent(answer, address, word))
            for address, word in pairs
        ]

    def _sent(self, message: Message, address: int, raw: int) -> bytes:
        return whole_frame(build(message, self.units, self.unit, address, raw)[1])

    def spoils(self, point: Point, script: Script, *, writes: bool) -> Iterator[tuple[str, Script]]:
        """The exchange without its answer; for a write also with another number in the answer."""
        answer = self.asks[writes][1]
        [(sent, good)] = script
        yield "timeout", [(sent, b"")]
        yield "timeout", [(sent, good[:3] + bytes((good[3] ^ 1,)) + good[4:])]
        if answer is not None and writes and any(role.kind == "raw" for role in answer.roles):
            word = parse(answer, self.unit, CanFrame(int.from_bytes(good[:4], "big"), good[4:])).raw
            yield "echo_mismatch", [(sent, self._sent(answer, point.addresses[0], word ^ 0x0100))]


def wires(device: Device) -> list[CanWire]:
    """The one way in which parameters travel."""
    return [CanWire(device)]


def whole_frame(frame: CanFrame) -> bytes:
    """A frame in bytes."""
    return frame.id.to_bytes(4, "big") + frame.data


def _request_and_answer(device: Device, *, writes: bool) -> tuple[Message | None, Message | None]:
    """The message that reads or writes a parameter, and its answer."""
    for request in device.messages:
        kinds = {role.kind for role in request.roles}
        if request.direction == "request" and "address" in kinds and ("raw" in kinds) == writes:
            return request, next((message for message in device.messages if message.answers == request.name), None)
    return None, None


def frames(lines: Lines, device: Device) -> None:
    """All vectors for the frames of a device with messages of its own."""
    for message in device.messages:
        if not any(role.kind == "word" for role in message.roles):
            _builds(lines, device.bus.units, message)
            _parses(lines, device.bus.units, message)
    lines.add("can_bus", identifier_bits(device.bus), of_bus(device.bus).bitrate)
    add_codes(lines, "constant", "exception", device.bus.exceptions)
    for group in device.groups:
        members = (point for point in device.points if point.generated and point.readable and point.group == group.name)
        addresses = [address for point in members if point.space == "parameter" for address in point.addresses]
        if addresses and _request_and_answer(device, writes=False)[0] is not None:
            lines.add("group", group.name, list(dict.fromkeys(addresses)))
    for telegram in device.telegrams:
        _telegram(lines, device, telegram)
    lines.gather()


def _builds(lines: Lines, units: tuple[int, int], message: Message) -> None:
    low, high = units
    tried = [(low, *pair) for pair in _NUMBERS] + [(unit, 0x0102, 0xFEDC) for unit in (high, low - 1, high + 1)]
    tried += [(low, 0x10000, 0), (low, 0, 0x10000), (high + 1, 0x10000, 0x10000)]
    for unit, address, raw in dict.fromkeys(tried):
        if unit >= 0:
            status, frame = build(message, units, unit, address, raw)
            lines.set("message", message.name)
            lines.add("can_build", unit, address, raw, status, *((frame.id, frame.data) if status == "ok" else ()))


def _parses(lines: Lines, units: tuple[int, int], message: Message) -> None:
    low, high = units
    for unit in dict.fromkeys((low, high)):
        for address, raw in _NUMBERS if unit == low else _NUMBERS[2:3]:
            _, good = build(message, units, unit, address, raw)
            _parsed(lines, message, unit, good)
    _, good = build(message, units, low, 0x0102, 0xFEDC)
    for frame in _spoiled(good):
        _parsed(lines, message, low, frame)
    _parsed(lines, message, high, good)


def _spoiled(good: CanFrame) -> Iterator[CanFrame]:
    """Frames with another identifier, of every length, and with every single bit flipped."""
    for number in (good.id ^ 1, good.id + 1, 0, 0x7FF):
        yield CanFrame(number, good.data)
    for length in range(len(good.data)):
        yield CanFrame(good.id, good.data[:length])
    for bit in range(8 * len(good.data)):
        data = bytearray(good.data)
        data[bit >> 3] ^= 1 << (bit & 7)
        yield CanFrame(good.id, bytes(data))


def _parsed(lines: Lines, message: Message, unit: int, frame: CanFrame) -> None:
    parsed = parse(message, unit, frame)
    lines.set("message", message.name)
    read = (parsed.address, parsed.raw) if parsed.status == "ok" else ()
    lines.add("can_parse", unit, frame.id, frame.data, parsed.status, *read)


def _telegram(lines: Lines, device: Device, telegram: Telegram) -> None:
    message = next((message for message in device.messages if message.name == telegram.message), None)
    if message is None:
        return
    unit = device.bus.units[0]
    for point in device.points:
        if point.telegram == telegram.name and point.generated:
            (_received_point if point.form != "text" else _received_text)(lines, telegram, message, point, unit)
    if message.words:
        lines.add("size", "frames", telegram.name, -(-telegram.words // message.words))
        for sender in dict.fromkeys(device.bus.units):
            _damaged_frames(lines, telegram, message, sender)


def _damaged_frames(lines: Lines, telegram: Telegram, message: Message, unit: int) -> None:
    """Good frames, and for each byte that holds no word a frame in which this byte is wrong."""
    data = bytearray({"constant": role.number, "unit": unit & 0xFF}.get(role.kind, 0) for role in message.roles)
    for place, role in enumerate(message.roles):
        if role.kind == "word":
            data[place] = 0x35 + 0x11 * place & 0xFF
    for place, role in enumerate(message.roles):
        if role.kind == "xor":
            data[place] = checksum(data, role.number)
    good = CanFrame(identifier(message, unit), bytes(data))
    frames = [good, CanFrame(good.id ^ 1, good.data), CanFrame(good.id, good.data[:-1])]
    for place, role in enumerate(message.roles):
        if role.kind != "word":
            frames.append(CanFrame(good.id, bytes((*data[:place], data[place] ^ 0x80, *data[place + 1 :]))))
    receiver = Receiver(telegram, message, unit)
    lines.set("telegram", telegram.name, unit)
    lines.add("can_carrier", message.name)
    lines.add(
        "can_taken", [(frame.id, frame.data) for frame in frames], [int(receiver.take(frame)) for frame in frames]
    )


def _received_point(lines: Lines, telegram: Telegram, message: Message, point: Point, unit: int) -> None:
    """One point of a telegram, missing and complete; if it spans two frames, also torn, in every possible order."""
    slots = [position // message.words for position in point.addresses]
    ask = _Asking(lines, telegram, message, point, unit)
    first = ask.frame(slots[0], 0x1234)
    ask.answer([])
    ask.answer([first])
    ask.answer([first, ask.frame(slots[0], 0xFEDC)])
    other = (slots[0] + 1) % (-(-telegram.words // message.words))
    ask.answer([ask.frame(other, 0x0F0F), CanFrame(first.id ^ 1, first.data), CanFrame(first.id, first.data[:7])])
    ask.answer([CanFrame(first.id, bytes((first.data[0] ^ 1,)) + first.data[1:]), ask.frame(0xFF, 0x1111)])
    if slots[0] == slots[-1]:
        return
    high, low = slots[0], slots[-1]
    h1, h2, l1, l2 = (high, 0x0001), (high, 0x0002), (low, 0xFFFF), (low, 0x0000)
    h0 = (high, -0x1111 * (point.addresses[0] % message.words) & 0xFFFF)  # high word 0, as before any frame
    for order in (
        (h1, l1), (l1, h1), (h1, l1, h1), (h1, l1, h2), (h1, l2, h2, l2), (h1, l1, h1, l1), (h1, l1, h1, l2),
        (h1, l1, h2, l2, h2), (h1, h1, l1), (h1, l1, l2, h1), (l1, h1, h1), (h1, h1, l1, h1), (h2, l1, h1, l1, h1, l2),
        (l1, h1, l2, h1, l1), (h1, l1, h1, h1), (l1, h0), (h0, l1),
    ):  # fmt: skip
        ask.answer([ask.frame(*position) for position in order])


def _received_text(lines: Lines, telegram: Telegram, message: Message, point: Point, unit: int) -> None:
    """A text of a telegram: before any frame, before the last one, and complete."""
    ask = _Asking(lines, telegram, message, point, unit)
    slots = dict.fromkeys(position // message.words for position in point.addresses)
    frames = [ask.frame(slot, 0x2143 + slot) for slot in slots]
    for count in dict.fromkeys((0, len(frames) - 1, len(frames))):
        receiver = Receiver(telegram, message, unit)
        taken = [int(receiver.take(frame)) for frame in frames[:count]]
        pieces = [receiver.words((position,)) for position in point.addresses]
        status = next((status for status, _ in pieces if status != "ok"), "ok")
        words = [word for _, words in pieces for word in words] if status == "ok" else None
        lines.set("point", point.item)
        lines.set("telegram", telegram.name, unit)
        lines.add("can_text", [(frame.id, frame.data) for frame in frames[:count]], taken, status, words)


class _Asking:
    """Frames for one point, and what the point is after them."""

    def __init__(self, lines: Lines, telegram: Telegram, message: Message, point: Point, unit: int) -> None:
        self.lines, self.telegram, self.message, self.point, self.unit = lines, telegram, message, point, unit

    def frame(self, slot: int, pattern: int) -> CanFrame:
        """A frame of a slot; each word is the pattern, changed by its place so that no two words are equal."""
        data = bytearray()
        for role in self.message.roles:
            word = (pattern + 0x1111 * (role.number >> 1)) & 0xFFFF
            parts = {"constant": role.number, "unit": self.unit >> role.number & 0xFF, "multiplexer": slot}
            data.append(parts.get(role.kind, word & 0xFF if role.number & 1 else word >> 8))
        for place, role in enumerate(self.message.roles):
            if role.kind == "xor":
                data[place] = checksum(data, role.number)
        return CanFrame(identifier(self.message, self.unit), bytes(data))

    def answer(self, frames: list[CanFrame]) -> None:
        """One vector: what the point is when these frames came."""
        receiver = Receiver(self.telegram, self.message, self.unit)
        taken = [int(receiver.take(frame)) for frame in frames]
        status, words = receiver.words(self.point.addresses)
        pattern = 0
        for word in words:
            pattern = pattern << 16 | word
        if self.point.bits is not None:
            pattern >>= self.point.bits[1]
        self.lines.set("point", self.point.item)
        self.lines.set("telegram", self.telegram.name, self.unit)
        shown = [(frame.id, frame.data) for frame in frames]
        self.lines.add(
            "can_telegram", shown, taken, status, *((as_raw(self.point.shape, pattern),) if status == "ok" else ())
        )


def limits(lines: Lines, bus: Bus) -> None:
    """How long identifiers are, and how fast the bus is."""
    add_limits(lines, identifier_bits=identifier_bits(bus))
    bitrate = of_bus(bus).bitrate
    if bitrate is not None:
        lines.add("size", "bitrate", None, bitrate)
