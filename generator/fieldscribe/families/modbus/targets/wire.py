"""The Modbus frames that vectors have: exchanges of points, requests to build, good and bad replies."""

from collections.abc import Iterator
from dataclasses import replace

from fieldscribe.families.modbus import BIT_LISTS, FUNCTIONS, READS, SPACES, profile_of
from fieldscribe.families.modbus.frames import (
    Flaw,
    Request,
    build,
    crc16,
    data_size,
    frame,
    pack_bits,
    parse_reply,
    parse_request,
)
from fieldscribe.model import Bus, Device, Frame, Point
from fieldscribe.targets.vectors.exchanges import (
    Example,
    Script,
    Wire,
    of_other_lengths,
    single_bit_errors,
    with_flipped,
    words_in_bytes,
)
from fieldscribe.targets.vectors.lines import Lines

_TRANSACTION = 0x1234
_ADDRESS = 0x0102
_FIRST_BLOCK, _LAST = 40002, 0xFFFF


class ModbusWire(Wire):
    """Exchanges and frames of a device over one framing."""

    def __init__(self, lines: Lines, device: Device, framing: str) -> None:
        self.profile, self.framing = profile_of(device.bus), framing
        low, _ = self.profile.units
        super().__init__(lines, device, low if low != self.profile.broadcast else low + 1)
        self.transaction = 1 if framing == "tcp" else 0  # of each step: runners exchange it for the device's own
        self.starts = starts_of(device)
        self._at_zero: dict[tuple[int, tuple[int, ...]], tuple[bytes, bytes] | None] = {}

    def opens(self) -> None:
        """Set the unit, the framing and the bases."""
        self.lines.set("unit", self.unit, self.framing)
        if self.starts:
            self.lines.set("bases", self.starts, {name: _LAST - start for name, start in self.starts.items()})

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
        request = Request(self.unit, function, 0, len(words), values, self.transaction)
        status, sent = self.build(request)
        return (sent, self.frame(request, _good_pdu(request, words))) if status == "ok" else None

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
        pdus = (bytes((request.function | 0x80, code)), with_flipped(_good_pdu(request), 0))
        bad = [self.frame(request, pdu) for pdu in pdus]
        bad += [good[:-1], good + b"\x00", with_flipped(good, 0), with_flipped(good, len(good) - 1)]
        for answer in dict.fromkeys(bad):
            reply = parse_reply(self.framing, request, answer)
            if reply.status != "ok":
                yield reply.status, [(sent, answer)]

    def frame(self, request: Request, pdu: bytes, *, unit_bits: int = 0) -> bytes:
        """Return the frame of an answer to a request; `unit_bits` make it that of another unit."""
        return frame(self.framing, request.unit ^ unit_bits, request.transaction, pdu)

    def set_request(self, request: Request) -> None:
        """Set the request of the next vectors: a read has a count, a write has values."""
        head = self.framing, request.unit, request.transaction, request.function, request.address
        self.lines.set("request", *head, request.count, () if request.function in READS else request.values)

    def build(self, request: Request) -> tuple[str, bytes]:
        """Return the status of a request and its bytes."""
        return build(self.profile, self.framing, request)

    def parse(self, request: Request, answer: bytes) -> tuple[object, ...]:
        """Return a reply, its status, its values, and the code of an exception."""
        reply = parse_reply(self.framing, request, answer)
        return answer, reply.status, reply.values, reply.exception if reply.status == "exception" else None

    def request(self, function: int, count: int) -> Request:
        """Return a request with recognisable address and values; the sub-function of 08h is 0."""
        transaction, address = _TRANSACTION * self.transaction, 0 if function == 0x08 else _ADDRESS
        values = tuple(0xA55A + place & 0xFFFF for place in range(count))
        if function in (0x05, 0x0F):
            values = tuple(1 if place % 3 == 0 else 0 for place in range(count))
        return Request(self.unit, function, address, count, () if function in READS else values, transaction)

    def requests(self) -> Iterator[Request]:
        """Yield requests of every function with extreme units, counts, addresses and values, good and bad ones."""
        low, high = self.profile.units
        for function in FUNCTIONS:
            first, most = self.request(function, 1), self.profile.most.get(function)
            yield first
            if most is None:
                continue
            for unit in (low, high, low - 1, high + 1, self.profile.broadcast):
                if unit is not None and 0 <= unit <= 255:
                    yield replace(first, unit=unit)
            counts = (0, 1, 2, 8, 9, 16, 17, most - 1, most, most + 1)
            yield from (self.request(function, count) for count in counts if 0 <= count <= most + 1)
            for address, count in ((0, 1), (0xFFFF, 1), (0xFFFF, 2), (0x10000 - most, most), (0x10001 - most, most)):
                if address <= 0xFFFF:
                    yield replace(self.request(function, count), address=address)
            values = () if function in READS else (0, 1, 2) if function in (0x05, 0x0F) else (0, 1, 0x8000, 0xFFFF)
            yield from (replace(first, values=(value,)) for value in values)
        yield Request(self.unit, 0x2B, 0, 1, (0,), self.request(1, 1).transaction)

    def add_all_replies(self) -> None:
        """Add replies to one request of each function: good, refused, and malformed."""
        functions = [function for function in FUNCTIONS if function in self.profile.most]
        for function in functions:
            most = self.profile.most[function]
            for count in dict.fromkeys((1, min(11, most), most)):
                request = self.request(function, count)
                self.add_replies(request, (self.frame(request, _good_pdu(request)),))
            request = self.request(function, min(3, most))
            pdus = [self.frame(request, pdu) for pdu in _bad_pdus(request, self.bus)]
            errors = single_bit_errors(self.frame(request, _good_pdu(request))) if function == functions[0] else ()
            self.add_replies(request, (*pdus, *self._bad_frames(request), *errors))

    def example(self, frame: Frame, answered: Example | None) -> Example | None:
        """Return the request that a printed frame is or answers, and the answers that it is."""
        wire, answers = ModbusWire(self.lines, self.device, frame.framing), (frame.printed, frame.corrected)
        if frame.direction != "request":
            return None if answered is None else (wire, answered[1], answers)
        request = parse_request(frame.framing, frame.corrected)
        if isinstance(request, Flaw):
            return None
        echoes = request.function in (0x05, 0x06, 0x08) and not frame.valid
        return wire, request, answers[:1] if echoes else ()

    def _bad_frames(self, request: Request) -> Iterator[bytes]:
        """Yield frames that are cut, too long, or of another unit, checksum, protocol or transaction."""
        pdu = _good_pdu(request)
        good = self.frame(request, pdu)
        yield from of_other_lengths(good)
        yield self.frame(request, pdu, unit_bits=3)
        yield self.frame(request, bytes((request.function | 0x80, 1)), unit_bits=3)
        if self.framing == "tcp":
            yield from (with_flipped(good, place) for place in range(6))
            yield frame("rtu", request.unit, 0, pdu)
        else:
            yield good[:-2] + good[:-3:-1]
            yield good[:-2] + (crc16(good[:-2]) ^ 0xFFFF).to_bytes(2, "little")


def starts_of(device: Device) -> dict[str, int]:
    """Return an address for each base: that of the greatest given numbers; blocks are well separated."""
    greatest = {each.name: each.high for each in device.given}
    return {
        base.name: _FIRST_BLOCK + 1000 * number if base.block is not None else base.at(greatest)
        for number, base in enumerate(device.bases)
    }


def _good_pdu(request: Request, words: tuple[int, ...] | None = None) -> bytes:
    """Return the PDU of a good reply, with the words that a device holds; with recognisable ones if they are None."""
    function, count = request.function, request.count
    if function in READS and function in BIT_LISTS:
        places = range(data_size(function, count))
        data = bytes(0x35 + 0x5B * place & 0xFF for place in places) if words is None else pack_bits(words, even=False)
    elif function in READS:
        data = words_in_bytes(words or [0x8001 + 0x1203 * place & 0xFFFF for place in range(count)])
    else:
        number = count if function in (0x0F, 0x10) else request.values[0] * (0xFF00 if function == 0x05 else 1)
        return bytes((function,)) + words_in_bytes((request.address, number))
    return bytes((function, len(data))) + data


def _bad_pdus(request: Request, bus: Bus) -> Iterator[bytes]:
    """Yield PDUs that are not a good reply in an intact frame: exceptions, other functions, lengths or echoes."""
    good, refused = _good_pdu(request), request.function | 0x80
    yield from (bytes((refused, code)) for code in (*(code.number for code in bus.exceptions), 0, 2, 255))
    yield from (
        bytes((refused, 1, 0)),
        bytes((refused ^ 1, 1)),
        b"\x2b" + good[1:],
        good + b"\x00",
        good[:-1],
        good[:2],
    )
    yield from (with_flipped(good, place) for place in range(1 if request.function in READS else len(good)))
    if request.function in READS:
        size, data = good[1], good[2:]
        other = ((size + 1, data + b"\x00"), (size - 1, data[:-1]), (size + 1, data), (0, b""), (255, data))
        yield from (bytes((request.function, length)) + rest for length, rest in other)
    if request.function == 0x05:
        yield good[:3] + b"\x00\x01"
