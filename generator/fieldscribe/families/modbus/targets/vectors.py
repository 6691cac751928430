"""Vectors of Modbus frames: requests to build, good and bad replies, the manual's own examples, and batched reads."""

import itertools
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace

from fieldscribe.families.modbus import FRAMINGS, FUNCTIONS, READS, SPACES, Profile, profile_of
from fieldscribe.families.modbus.exchange import Request, build, parse_reply, parse_request
from fieldscribe.families.modbus.frames import Flaw, crc16, data_size, frame, pack_bits
from fieldscribe.families.modbus.targets.base_vectors import KINDS as BASE_KINDS
from fieldscribe.families.modbus.targets.base_vectors import BaseVectors
from fieldscribe.model import Bus, Device, Point, SteppedCommand, Word
from fieldscribe.targets.vectors.exchanges import Script, codes, single_bit_errors, with_flipped
from fieldscribe.targets.vectors.lines import NO_BROADCAST, Lines

KINDS = {
    "build": "status:word bytes:bytes?",
    "reply": "bytes:bytes? status:word values_out:ints? exception:int?",
    "printed_build": "frame:note status:word bytes:bytes?",
    "printed_reply": "frame:note bytes:bytes? status:word values_out:ints? exception:int?",
    "step": "command:word index:int with:pairs? read:int? write:int? address:int held:ints words:ints within:int? "
    "conditional:int base:word?",
    "block": "group:word space:word function:int address:int count:int",
    **BASE_KINDS,
}
"""The kinds of vectors for frames, batched reads and bases."""

_TRANSACTION = 0x1234
_ADDRESS = 0x0102
_FIRST_BLOCK, _LAST = 40002, 0xFFFF
_MOST_BYTES = {"rtu_bytes": 256, "tcp_bytes": 260}
"""The longest frames that the protocol allows."""


class ModbusWire:
    """Exchanges over one framing."""

    def __init__(self, device: Device, framing: str) -> None:
        self.profile, self.bus, self.framing = profile_of(device.bus), device.bus, framing
        self.unit = _good_unit(self.profile)
        self.starts = starts_of(device)
        self._at_zero: dict[tuple[int, tuple[int, ...]], tuple[bytes, bytes] | None] = {}

    def opens(self, lines: Lines) -> None:
        """Set the unit, the framing and the bases."""
        lines.set("unit", self.unit, self.framing)
        if self.starts:
            lines.set("bases", self.starts, {name: _LAST - start for name, start in self.starts.items()})

    def reads(self, point: Point, words: tuple[int, ...]) -> Script | None:
        """Return one request for all words, which must be consecutive."""
        return self.script(SPACES[point.space].read, self._on_wire(point, point.addresses), words)

    def _on_wire(self, point: Point, addresses: tuple[int, ...]) -> tuple[int, ...]:
        """Return addresses on the wire."""
        start = self.starts.get(point.base or "", 0)
        return tuple([start + address for address in addresses]) if start else addresses

    def writes(self, point: Point, words: tuple[int, ...], *, keep: bool) -> Script | None:
        """Return one request for all words, with the function for this count."""
        function = None if keep else self.profile.write_function(point.space, len(words))
        return None if function is None else self.script(function, self._on_wire(point, point.written.addresses), words)

    def script(self, function: int, addresses: tuple[int, ...], words: tuple[int, ...]) -> Script | None:
        """Return one request for consecutive addresses and its reply; None if the device does not allow it.

        Frames are built once for address 0 and then moved, because many points have the same words.
        """
        first, last = min(addresses), max(addresses)
        if last - first + 1 != len(words) or last > 0xFFFF:
            return None
        if (function, words) not in self._at_zero:
            self._at_zero[function, words] = self._exchange(function, words)
        exchange = self._at_zero[function, words]
        if exchange is None:
            return None
        sent, received = exchange
        return [(self._moved(sent, first), received if function in READS else self._moved(received, first))]

    def _exchange(self, function: int, words: tuple[int, ...]) -> tuple[bytes, bytes] | None:
        values = () if function in READS else words
        transaction = 1 if self.framing == "tcp" else 0  # of each step: runners exchange it for the device's own
        request = Request(self.unit, function, 0, len(words), values, transaction)
        status, sent = build(self.profile, self.framing, request)
        return (sent, _reply_frame(self.framing, request, words)) if status == "ok" else None

    def _moved(self, data: bytes, address: int) -> bytes:
        """Return the same frame for another address, which stands after the function."""
        if self.framing == "tcp":
            return data[:8] + address.to_bytes(2, "big") + data[10:]
        body = data[:2] + address.to_bytes(2, "big") + data[4:-2]
        return body + crc16(body).to_bytes(2, "little")

    def bad_answers(self, point: Point, script: Script, *, writes: bool) -> Iterator[tuple[str, Script]]:
        """Yield the exchange with a refusal, a wrong checksum or protocol, another unit, and another function."""
        del point, writes
        [(sent, good)] = script
        request = parse_request(self.framing, sent)
        if isinstance(request, Flaw):
            return
        code = next((code.number for code in self.bus.exceptions), 2)
        pdus = (bytes((request.function | 0x80, code)), with_flipped(_reply_pdu(request), 0))
        bad = [_frame(self.framing, request, pdu) for pdu in pdus]
        bad += [good[:-1], good + b"\x00", with_flipped(good, 0), with_flipped(good, len(good) - 1)]
        for answer in dict.fromkeys(bad):
            reply = parse_reply(self.framing, request, answer)
            if reply.status != "ok":
                yield reply.status, [(sent, answer)]


def starts_of(device: Device) -> dict[str, int]:
    """Return an address for each base: that of the greatest given numbers; blocks are well separated."""
    greatest = {each.name: each.high for each in device.given}
    return {
        base.name: _FIRST_BLOCK + 1000 * number if base.block is not None else base.at(greatest)
        for number, base in enumerate(device.bases)
    }


def wires(device: Device) -> list[ModbusWire]:
    """Return one for each framing of the device, in the order of the description."""
    return [ModbusWire(device, framing) for framing in device.bus.framings or ("rtu",)]


def _good_unit(profile: Profile) -> int:
    low, _ = profile.units
    return low if low != profile.broadcast else low + 1


def _frame(framing: str, request: Request, pdu: bytes) -> bytes:
    return frame(framing, request.unit, request.transaction, pdu)


def _reply_frame(framing: str, request: Request, words: tuple[int, ...]) -> bytes:
    """Return the reply of a device that holds these words, or accepts them."""
    if request.function not in READS:
        return _frame(framing, request, _reply_pdu(request))
    bits = request.function in (0x01, 0x02)
    data = pack_bits(words, even=False) if bits else b"".join(word.to_bytes(2, "big") for word in words)
    return _frame(framing, request, bytes((request.function, len(data))) + data)


def _reply_pdu(request: Request) -> bytes:
    """Return the PDU of a good reply, with recognisable contents."""
    head = bytes((request.function,))
    if request.function in READS:
        size = data_size(request.function, request.count)
        if request.function in (0x01, 0x02):
            data = bytes(0x35 + 0x5B * place & 0xFF for place in range(size))
        else:
            data = b"".join((0x8001 + 0x1203 * place & 0xFFFF).to_bytes(2, "big") for place in range(request.count))
        return head + bytes((size,)) + data
    number = request.count if request.function in (0x0F, 0x10) else request.values[0]
    number *= 0xFF00 if request.function == 0x05 else 1
    return head + request.address.to_bytes(2, "big") + number.to_bytes(2, "big")


def frames(lines: Lines, device: Device) -> None:
    """Add all vectors of Modbus frames."""
    codes(lines, "code", "exception", device.bus.exceptions)
    for wire in wires(device):
        wire.opens(lines)
        for command in device.commands:
            value = 1 if command.value is None else command.value
            script = wire.script(command.function, (command.address,), (value,))
            if script is not None:
                lines.add("command", command.name, value, script, "ok")
    usual = wires(device)[0]
    usual.opens(lines)
    BaseVectors(lines, device, usual.profile, usual.framing, usual.unit).add()
    _builds(lines, device.bus)
    _replies(lines, device.bus)
    _printed(lines, device)
    for stepped in device.stepped_commands:
        _steps(lines, stepped)
    for group, blocks in device.blocks.items():
        for block in blocks:
            lines.add("block", group, block.space, block.function, block.address, block.count)


def _steps(lines: Lines, command: SteppedCommand) -> None:
    """Add the words of each step for the ends of the arguments, over what the device held."""
    ends = {end: {name: both[end] for name, both in command.arguments.items()} for end in (0, 1)}
    for index, step in enumerate(command.steps):
        for given, filled in itertools.product((ends[0], ends[1]) if command.arguments else ({},), (0x0000, 0xA5C3)):
            words = tuple(_word(word, given, f"{filled:016b}") for word in step.words)
            facts = step.read, step.write, step.address, (filled,) * len(words), words, step.within
            lines.add("step", command.name, index, given or None, *facts, int(step.when is not None), step.base)


def _word(word: Word, given: Mapping[str, int], held: str) -> int:
    """Return a word for these arguments over what the device held, bit by bit."""
    number = f"{(word.constant + word.factor * given.get(word.argument or '', 0)) % 0x10000:016b}"
    bits = zip(number, f"{word.mask:016b}", held, strict=True)
    return int("".join([new if mask == "1" else old for new, mask, old in bits]), 2)


def _builds(lines: Lines, bus: Bus) -> None:
    """Add requests of every function with extreme counts, addresses and values, and one for each reason to refuse."""
    profile = profile_of(bus)
    tried = [(framing, request) for framing in bus.framings for request in dict.fromkeys(_requests(profile, framing))]
    foreign = [framing for framing in FRAMINGS if framing not in profile.framings]
    tried += [(framing, next(_requests(profile, framing))) for framing in foreign]
    for framing, request in tried:
        _set_request(lines, framing, request)
        lines.add("build", *build(profile, framing, request))


def _set_request(lines: Lines, framing: str, request: Request) -> None:
    """Set the request of the next vectors: a read has a count, a write has values."""
    head = framing, request.unit, request.transaction, request.function, request.address
    lines.set("request", *head, request.count, () if request.function in READS else request.values)


def _requests(profile: Profile, framing: str) -> Iterator[Request]:
    transaction, good = _TRANSACTION if framing == "tcp" else 0, _good_unit(profile)
    low, high = profile.units
    for function in FUNCTIONS:
        first = _request(good, function, 1, transaction)
        yield first
        if function not in profile.most:
            continue
        for unit in dict.fromkeys((low, high, low - 1, high + 1, profile.broadcast)):
            if unit is not None and 0 <= unit <= 255:
                yield replace(first, unit=unit)
        most = profile.most[function]
        for count in dict.fromkeys((0, 1, 2, 8, 9, 16, 17, most - 1, most, most + 1)):
            if 0 <= count <= most + 1 and (count != 1 or function in READS):
                yield _request(good, function, count, transaction)
        for address, count in ((0, 1), (0xFFFF, 1), (0xFFFF, 2), (0x10000 - most, most), (0x10001 - most, most)):
            if 0 <= address <= 0xFFFF:
                yield replace(_request(good, function, count, transaction), address=address)
        values = {0x05: (0, 1, 2), 0x0F: (0, 1, 2)}.get(function, (0, 1, 0x8000, 0xFFFF))
        for value in values if function not in READS else ():
            yield replace(first, values=(value,))
    yield Request(good, 0x2B, 0, 1, (0,), transaction)


def _request(unit: int, function: int, count: int, transaction: int) -> Request:
    """Return a request with recognisable address and values; the sub-function of 08h is 0."""
    address = 0 if function == 0x08 else _ADDRESS
    if function in READS:
        return Request(unit, function, address, count, (), transaction)
    if function in (0x05, 0x0F):
        values = tuple(1 if place % 3 == 0 else 0 for place in range(count))
    else:
        values = tuple(0xA55A + place & 0xFFFF for place in range(count))
    return Request(unit, function, address, count, values, transaction)


def _replies(lines: Lines, bus: Bus) -> None:
    """Add replies to one request of each function: good, refused, and malformed."""
    profile = profile_of(bus)
    unit = _good_unit(profile)
    functions = [function for function in FUNCTIONS if function in profile.most]
    for framing in bus.framings:
        transaction = _TRANSACTION if framing == "tcp" else 0
        for function in functions:
            most = profile.most[function]
            for count in dict.fromkeys((1, min(11, most), most)):
                request = _request(unit, function, count, transaction)
                _reply(lines, framing, request, _frame(framing, request, _reply_pdu(request)))
            request = _request(unit, function, min(3, most), transaction)
            frames = [_frame(framing, request, pdu) for pdu in _bad_pdus(request, bus)]
            frames += _bad_frames(framing, request)
            if function == functions[0]:
                frames += single_bit_errors(_frame(framing, request, _reply_pdu(request)))
            for data in dict.fromkeys(frames):
                _reply(lines, framing, request, data)


def _reply(lines: Lines, framing: str, request: Request, data: bytes, printed: str | None = None) -> None:
    """Add the result of reading bytes as the reply to a request; `printed` names the manual's example."""
    reply = parse_reply(framing, request, data)
    _set_request(lines, framing, request)
    exception = reply.exception if reply.status == "exception" else None
    kind, name = ("reply", ()) if printed is None else ("printed_reply", (printed,))
    lines.add(kind, *name, data, reply.status, reply.values, exception)


def _bad_pdus(request: Request, bus: Bus) -> Iterator[bytes]:
    """Yield PDUs that are not a good reply in an intact frame: exceptions, other functions, lengths or echoes."""
    good = _reply_pdu(request)
    refused = request.function | 0x80
    for code in dict.fromkeys((*(code.number for code in bus.exceptions), 0, 2, 255)):
        yield bytes((refused, code))
    yield bytes((refused, 1, 0))
    yield from (bytes((refused ^ 1, 1)), with_flipped(good, 0), b"\x2b" + good[1:])
    yield from (good + b"\x00", good[:-1], good[:2])
    if request.function in READS:
        function, size, data = good[:1], good[1], good[2:]
        yield from (function + bytes((size + 1,)) + data + b"\x00", function + bytes((size - 1,)) + data[:-1])
        yield from (function + bytes((size + 1,)) + data, function + b"\x00", function + b"\xff" + data)
    else:
        yield from (with_flipped(good, place) for place in range(1, 5))
    if request.function == 0x05:
        yield good[:3] + b"\x00\x01"


def _bad_frames(framing: str, request: Request) -> Iterator[bytes]:
    """Yield frames that are cut, too long, or of another unit, checksum, protocol or transaction."""
    pdu = _reply_pdu(request)
    good = _frame(framing, request, pdu)
    yield from (good[:length] for length in range(len(good)))
    yield from (good + b"\x00", good + good[-2:])
    yield frame(framing, request.unit ^ 3, request.transaction, pdu)
    yield frame(framing, request.unit ^ 3, request.transaction, bytes((request.function | 0x80, 1)))
    if framing == "tcp":
        yield from (frame("tcp", request.unit, request.transaction ^ flip, pdu) for flip in (0x0001, 0x0100))
        yield from (with_flipped(good, place) for place in range(2, 6))
        yield frame("rtu", request.unit, 0, pdu)
    else:
        yield good[:-2] + good[:-3:-1]
        yield good[:-2] + (crc16(good[:-2]) ^ 0xFFFF).to_bytes(2, "little")


def _printed(lines: Lines, device: Device) -> None:
    """Add the manual's frames: requests are built as they should read, replies are parsed, misprints are refused."""
    profile = profile_of(device.bus)
    requests: dict[str, Request] = {}
    for example in device.frames:
        answers: Iterable[bytes] = dict.fromkeys((example.printed, example.corrected))
        request = requests.get(example.answers or "")
        if example.direction == "request":
            parsed = parse_request(example.framing, example.corrected)
            request = None if isinstance(parsed, Flaw) else parsed
            if request is not None:
                requests[example.name] = request
                _set_request(lines, example.framing, request)
                lines.add("printed_build", example.name, *build(profile, example.framing, request))
                echoes = request.function in (0x05, 0x06, 0x08)
                answers = (example.printed,) if echoes and not example.valid else ()
        if request is not None:
            for data in answers:
                _reply(lines, example.framing, request, data, example.name)


def limits(lines: Lines, bus: Bus) -> None:
    """Add the limits of the functions and of the protocol."""
    profile = profile_of(bus)
    known = [code.number for code in bus.functions if code.number in profile.most]
    for index, number in enumerate(known):
        lines.add("function", index, number, profile.most[number], int(number in profile.broadcasts))
    lines.add_limits(functions=len(known), broadcast=NO_BROADCAST if bus.broadcast is None else bus.broadcast)
    lines.add_limits(no_broadcast=NO_BROADCAST, **_MOST_BYTES)
