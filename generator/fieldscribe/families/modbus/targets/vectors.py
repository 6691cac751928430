"""Vectors of Modbus frames: requests to build, replies good and bad, the manual's own examples, and batched reads."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from fieldscribe.families.modbus import FRAMINGS, FUNCTIONS, Profile, profile_of
from fieldscribe.families.modbus.exchange import Reply, Request, build, parse_reply, parse_request
from fieldscribe.families.modbus.frames import Flaw, crc16, frame
from fieldscribe.targets.vectors.family_vectors import NO_BROADCAST, add_codes, add_limits, writing_addresses

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from fieldscribe.model import Bus, Device, Point
    from fieldscribe.targets.vectors.family_vectors import Script
    from fieldscribe.targets.vectors.lines import Lines

KINDS = {
    "build": "status:word bytes:bytes?",
    "reply": "bytes:bytes? status:word values_out:ints? exception:int?",
    "printed_build": "frame:note status:word bytes:bytes?",
    "printed_reply": "frame:note bytes:bytes? status:word values_out:ints? exception:int?",
    "block": "group:word space:word function:int address:int count:int",
}
"""The kinds of vectors for frames and batched reads."""

_READS = (0x01, 0x02, 0x03, 0x04)
_TRANSACTION = 0x1234
_ADDRESS = 0x0102
_LAST = 0xFFFF
"""The last address of every space."""


_SPACES = {"coil": 0x01, "discrete": 0x02, "holding": 0x03, "input": 0x04}


class ModbusWire:
    """Exchanges over one framing."""

    def __init__(self, device: Device, framing: str) -> None:
        bus = device.bus
        self.profile, self.bus = profile_of(bus), bus
        low, _ = self.profile.units
        self.unit = low if low != self.profile.broadcast else low + 1
        self.framing = framing
        self._first: dict[tuple[int, tuple[int, ...]], tuple[bytes, bytes] | None] = {}

    def opens(self, lines: Lines) -> None:
        """The unit and the framing."""
        lines.set("unit", self.unit, self.framing)

    def reads(self, point: Point, words: tuple[int, ...]) -> Script | None:
        """One request for all words, which must be consecutive."""
        return self.script(_SPACES[point.terms.space], point.place.addresses, words)

    def writes(self, point: Point, words: tuple[int, ...], *, keep: bool) -> Script | None:
        """One request for all words, with the function for this count."""
        space = point.terms.space
        if keep or space not in ("coil", "holding"):
            return None
        single, several = (0x05, 0x0F) if space == "coil" else (0x06, 0x10)
        function = single if len(words) == 1 and single in self.profile.most else several
        return self.script(function, writing_addresses(point), words)

    def script(self, function: int, addresses: tuple[int, ...], words: tuple[int, ...]) -> Script | None:
        """One request for consecutive addresses and its answer; None where the device does not allow it."""
        first, last = min(addresses), max(addresses)
        if last - first + 1 != len(words) or last > _LAST:
            return None
        asked = function, words
        if asked not in self._first:
            self._first[asked] = self._exchange(*asked)
        exchange = self._first[asked]
        if exchange is None:
            return None
        sent, received = exchange
        request = self._moved(sent, first)
        if function in _READS:
            return [(request, received)]
        return [(request, request if received == sent else self._moved(received, first))]

    def _exchange(self, function: int, words: tuple[int, ...]) -> tuple[bytes, bytes] | None:
        """The request for the words from address 0 on, and its answer; None where the device does not allow it."""
        values = () if function in _READS else words
        request = Request(self.unit, function, 0, len(words), values, self._transaction())
        status, sent = build(self.profile, self.framing, request)
        return (sent, _frame(self.framing, request, answer_with(request, words))) if status == "ok" else None

    def _moved(self, data: bytes, address: int) -> bytes:
        """The same frame for another address, which stands behind the function."""
        if self.framing == "tcp":
            return data[:8] + address.to_bytes(2, "big") + data[10:]
        body = data[:2] + address.to_bytes(2, "big") + data[4:-2]
        return body + crc16(body).to_bytes(2, "little")

    def _transaction(self) -> int:
        """The transaction number of the next request; every device object counts from 1."""
        return 1 if self.framing == "tcp" else 0

    def spoils(self, point: Point, script: Script, *, writes: bool) -> Iterator[tuple[str, Script]]:
        """The exchange with a refusal, a wrong checksum or protocol, another unit, and another function."""
        del point, writes
        [(sent, good)] = script
        request = parse_request(self.framing, sent)
        if isinstance(request, Flaw):
            return
        code = next((code.number for code in self.bus.exceptions), 2)
        pdus = (bytes((request.function | 0x80, code)), bytes((request.function ^ 1,)) + good_answer(request)[1:])
        bad = [_frame(self.framing, request, pdu) for pdu in pdus]
        bad += [good[:-1], good + b"\x00", bytes((good[0] ^ 1,)) + good[1:], good[:-1] + bytes((good[-1] ^ 1,))]
        for answer in dict.fromkeys(bad):
            reply = parse_reply(self.framing, request, answer)
            if reply.status != "ok":
                yield reply.status, [(sent, answer)]


def wires(device: Device) -> list[ModbusWire]:
    """One for each framing of the device, in the order of the description."""
    return [ModbusWire(device, framing) for framing in _framings(device.bus) or ("rtu",)]


def answer_with(request: Request, words: tuple[int, ...]) -> bytes:
    """The PDU of the answer from a device that holds these words, or accepts them."""
    head = bytes((request.function,))
    if request.function in (0x01, 0x02):
        data = sum(bit << place for place, bit in enumerate(words)).to_bytes((len(words) + 7) // 8, "little")
    elif request.function in (0x03, 0x04):
        data = b"".join(word.to_bytes(2, "big") for word in words)
    else:
        return good_answer(request)
    return head + bytes((len(data),)) + data


def frames(lines: Lines, device: Device) -> None:
    """All vectors for Modbus frames."""
    add_codes(lines, "code", "exception", device.bus.exceptions)
    commands(lines, device)
    builds(lines, device.bus)
    replies(lines, device.bus)
    printed(lines, device)
    blocks(lines, device)


def commands(lines: Lines, device: Device) -> None:
    """Each command sent and answered, by itself and with a refusal."""
    for wire in wires(device):
        wire.opens(lines)
        for command in device.commands:
            value = 1 if command.value is None else command.value
            script = wire.script(command.function, (command.address,), (value,))
            if script is not None:
                lines.add("command", command.name, value, script, "ok")


def builds(lines: Lines, bus: Bus) -> None:
    """Requests of every function with extreme counts, addresses and values, and one for each reason to refuse."""
    profile = profile_of(bus)
    for framing in _framings(bus):
        for request in dict.fromkeys(_requests(profile, framing)):
            status, data = build(profile, framing, request)
            _ask(lines, framing, request)
            lines.add("build", status, data)
    for framing in FRAMINGS:
        if framing not in profile.framings:
            request = next(_requests(profile, framing))
            _ask(lines, framing, request)
            lines.add("build", *build(profile, framing, request))


def _framings(bus: Bus) -> tuple[str, ...]:
    return tuple(framing for framing in bus.framings if framing in FRAMINGS)


def _ask(lines: Lines, framing: str, request: Request) -> None:
    """The request for the next vectors: a read has a count, a write has values."""
    head = framing, request.unit, request.transaction, request.function, request.address
    lines.set("request", *head, request.count, () if request.function in _READS else request.values)


def _requests(profile: Profile, framing: str) -> Iterator[Request]:
    transaction = _TRANSACTION if framing == "tcp" else 0
    low, high = profile.units
    good = low if low != profile.broadcast else low + 1
    for function in FUNCTIONS:
        first = _request(good, function, 1, transaction)
        if function not in profile.most:
            yield first
            continue
        yield first
        for unit in dict.fromkeys((low, high, low - 1, high + 1, profile.broadcast)):
            if unit is not None and 0 <= unit <= 255:
                yield _request(unit, function, 1, transaction)
        most = profile.most[function]
        for count in dict.fromkeys((0, 1, 2, 8, 9, 16, 17, most - 1, most, most + 1)):
            if 0 <= count <= most + 1 and (count != 1 or function in _READS):
                yield _request(good, function, count, transaction)
        for address, count in ((0, 1), (0xFFFF, 1), (0xFFFF, 2), (0x10000 - most, most), (0x10001 - most, most)):
            if 0 <= address <= 0xFFFF:
                yield replace(_request(good, function, count, transaction), address=address)
        for value in _single_values(function):
            yield replace(_request(good, function, 1, transaction), values=(value,))
    yield Request(good, 0x2B, 0, 1, (0,), transaction)


def _single_values(function: int) -> tuple[int, ...]:
    if function in (0x05, 0x0F):
        return (0, 1, 2)
    return (0, 1, 0x8000, 0xFFFF) if function in (0x06, 0x08, 0x10) else ()


def _request(unit: int, function: int, count: int, transaction: int) -> Request:
    """A request with recognisable address and values; the sub-function of 08h is 0."""
    address = 0 if function == 0x08 else _ADDRESS
    if function in _READS:
        return Request(unit, function, address, count, (), transaction)
    if function in (0x05, 0x0F):
        values = tuple(1 if place % 3 == 0 else 0 for place in range(count))
    else:
        values = tuple(0xA55A + place & 0xFFFF for place in range(count))
    return Request(unit, function, address, count, values, transaction)


def replies(lines: Lines, bus: Bus) -> None:
    """Answers to one request of each function: good, refused, and malformed."""
    profile = profile_of(bus)
    low, _ = profile.units
    unit = low if low != profile.broadcast else low + 1
    for framing in _framings(bus):
        transaction = _TRANSACTION if framing == "tcp" else 0
        functions = [function for function in FUNCTIONS if function in profile.most]
        for function in functions:
            most = profile.most[function]
            for count in dict.fromkeys((1, min(11, most), most)):
                request = _request(unit, function, count, transaction)
                _reply(lines, framing, request, _frame(framing, request, good_answer(request)))
            request = _request(unit, function, min(3, most), transaction)
            frames = [_frame(framing, request, pdu) for pdu in _bad_answers(request, bus)]
            frames += _bad_frames(framing, request)
            if function == functions[0]:
                frames += _single_bit_errors(_frame(framing, request, good_answer(request)))
            for data in dict.fromkeys(frames):
                _reply(lines, framing, request, data)


def _frame(framing: str, request: Request, pdu: bytes) -> bytes:
    return frame(framing, request.unit, request.transaction, pdu)


def good_answer(request: Request) -> bytes:
    """The PDU that a device answers, with recognisable contents."""
    head = bytes((request.function,))
    if request.function in (0x01, 0x02):
        size = (request.count + 7) // 8
        return head + bytes((size,)) + bytes(0x35 + 0x5B * place & 0xFF for place in range(size))
    if request.function in (0x03, 0x04):
        data = b"".join((0x8001 + 0x1203 * place & 0xFFFF).to_bytes(2, "big") for place in range(request.count))
        return head + bytes((len(data),)) + data
    number = (
        request.count
        if request.function in (0x0F, 0x10)
        else request.values[0] * (0xFF00 if request.function == 5 else 1)
    )
    return head + request.address.to_bytes(2, "big") + number.to_bytes(2, "big")


def _bad_answers(request: Request, bus: Bus) -> Iterator[bytes]:
    """PDUs that are no good answer though the frame is intact: exceptions, other functions, lengths or echoes."""
    good = good_answer(request)
    refused = request.function | 0x80
    for code in dict.fromkeys((*(code.number for code in bus.exceptions), 0, 2, 255)):
        yield bytes((refused, code))
    yield bytes((refused, 1, 0))
    yield from (bytes((refused ^ 1, 1)), bytes((request.function ^ 1,)) + good[1:], b"\x2b" + good[1:])
    yield from (good + b"\x00", good[:-1], good[:2])
    if request.function in _READS:
        yield bytes((request.function, good[1] + 1)) + good[2:] + b"\x00"
        yield bytes((request.function, good[1] - 1)) + good[2:-1]
        yield from (
            bytes((request.function, good[1] + 1)) + good[2:],
            bytes((request.function, 0)),
            bytes((request.function, 255)) + good[2:],
        )
    else:
        for place in range(1, 5):
            yield good[:place] + bytes((good[place] ^ 1,)) + good[place + 1 :]
    if request.function == 0x05:
        yield good[:3] + b"\x00\x01"


def _bad_frames(framing: str, request: Request) -> Iterator[bytes]:
    """Frames that are cut, too long, or of another unit, checksum, protocol or transaction."""
    pdu = good_answer(request)
    good = _frame(framing, request, pdu)
    yield from (good[:length] for length in range(len(good)))
    yield from (good + b"\x00", good + good[-2:])
    yield frame(framing, request.unit ^ 3, request.transaction, pdu)
    yield frame(framing, request.unit ^ 3, request.transaction, bytes((request.function | 0x80, 1)))
    if framing == "tcp":
        yield from (frame("tcp", request.unit, request.transaction ^ flip, pdu) for flip in (0x0001, 0x0100))
        for place in range(2, 6):
            yield good[:place] + bytes((good[place] ^ 1,)) + good[place + 1 :]
        yield frame("rtu", request.unit, 0, pdu)
    else:
        yield good[:-2] + good[:-3:-1]
        crc = crc16(good[:-2]) ^ 0xFFFF
        yield good[:-2] + crc.to_bytes(2, "little")


def _single_bit_errors(data: bytes) -> Iterator[bytes]:
    for place in range(8 * len(data)):
        yield data[: place >> 3] + bytes((data[place >> 3] ^ 1 << (place & 7),)) + data[(place >> 3) + 1 :]


def _reply(lines: Lines, framing: str, request: Request, data: bytes) -> None:
    _ask(lines, framing, request)
    lines.add("reply", data, *_answer(parse_reply(framing, request, data)))


def _answer(reply: Reply) -> tuple[object, ...]:
    return reply.status, reply.values, reply.exception if reply.status == "exception" else None


def printed(lines: Lines, device: Device) -> None:
    """The manual's frames: requests are built as they should read, replies are parsed, and misprints are refused."""
    profile = profile_of(device.bus)
    requests: dict[str, Request] = {}
    for example in device.frames:
        if example.direction == "request":
            request = parse_request(example.framing, example.corrected)
            if isinstance(request, Flaw):
                continue
            requests[example.name] = request
            status, data = build(profile, example.framing, request)
            _ask(lines, example.framing, request)
            lines.add("printed_build", example.name, status, data)
            echoes = request.function in (0x05, 0x06, 0x08)
            answers: Iterable[bytes] = (example.printed,) if echoes and not example.valid else ()
        else:
            asked = requests.get(example.answers or "")
            if asked is None:
                continue
            request, answers = asked, dict.fromkeys((example.printed, example.corrected))
        for data in answers:
            reply = parse_reply(example.framing, request, data)
            _ask(lines, example.framing, request)
            lines.add("printed_reply", example.name, data, *_answer(reply))


def blocks(lines: Lines, device: Device) -> None:
    """The vectors of batched reads, group by group; a block is known by its place, not by how many come before."""
    for group, blocks_of_group in device.blocks.items():
        for block in blocks_of_group:
            lines.add("block", group, block.space, block.function, block.address, block.count)


def limits(lines: Lines, bus: Bus) -> None:
    """The limits of the functions and of the protocol."""
    profile = profile_of(bus)
    known = [code.number for code in bus.functions if code.number in profile.most]
    for index, number in enumerate(known):
        lines.add("function", index, number, profile.most[number], int(number in profile.broadcasts))
    add_limits(lines, functions=len(known), broadcast=NO_BROADCAST if bus.broadcast is None else bus.broadcast)
    add_limits(lines, no_broadcast=NO_BROADCAST, rtu_bytes=_RTU_BYTES, tcp_bytes=_TCP_BYTES)


_RTU_BYTES, _TCP_BYTES = 256, 260
"""The longest frames that the protocol allows."""
