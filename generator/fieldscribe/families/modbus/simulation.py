"""The end of a Modbus line where devices answer: cuts bytes into requests, carries them out, builds replies. No I/O."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from fieldscribe.families.modbus import FUNCTIONS, READS, SPACES, Profile, profile_of
from fieldscribe.families.modbus.frames import (
    LEAST,
    Flaw,
    Request,
    Unwrapped,
    crc16,
    frame,
    pack_bits,
    request_in,
    request_length,
)
from fieldscribe.model import Bus, Source
from fieldscribe.simulation.device import OF_VALUES, Refusal, SimulatedDevice, by_unit
from fieldscribe.simulation.line import Answer, Core, cut_sound

LINES = {"tcp": ("any", "tcp", "rtu"), "serial": ("rtu",)}
_LONGEST = 256
"""Bytes of the longest RTU frame."""
_DIRECT = 255
"""The unit of a device that is addressed by its IP alone."""
_GATEWAY_SILENT = 11
_CODES: Mapping[str, tuple[int, tuple[str, ...]]] = {
    "function": (1, ("function",)),
    "address": (2, ("address",)),
    "format": (3, ("format", "data_value")),
    "value": (3, ("range", "value", "refused")),
    "state": (4, ("not_available", "refused", "read_only", "failure")),
}
"""The exception of the protocol for each reason, and the words that name it in a description, the best one first."""
_REASONS = {
    **dict.fromkeys(("function", "address", "format"), ""),
    **dict.fromkeys(("absent", "part", "write_only"), "address"),
    **dict.fromkeys(("read_only", "condition", "together"), "state"),
}
"""The reason for each kind of refusal; all others are about the value."""
REFUSALS, LARGEST_CODE = (*_REASONS, *OF_VALUES), 0xFF


def core_of(devices: Sequence[SimulatedDevice], framing: str = "tcp") -> ModbusCore:
    """Return the end of a line with these devices; with the framing `any`, the first request of a client decides."""
    return _UnsettledCore(devices) if framing == "any" else ModbusCore(devices, framing)


class _Unit:
    """What the core knows of one device before any request comes."""

    def __init__(self, device: SimulatedDevice) -> None:
        bus = device.device.bus
        self.device = device
        self.profile: Profile = profile_of(bus)
        self.gaps = bus.gaps
        self.codes = {reason: _code(bus, reason) for reason in _CODES}
        self.delay_point = _delay_point(device)
        self.delay = min((n for key, n in bus.line_numbers.items() if key.endswith("response_delay_ms_min")), default=0)
        self.silent = bus.line_numbers.get("timing_silent_characters_tenths", 35) / 10

    def delay_now(self) -> float:
        """Return the seconds until the device answers."""
        point = self.delay_point
        return (self.delay if point is None else self.device.memory.raw(point)) / 1000

    def source(self, refusal: Refusal, function: int) -> Source:
        """Return where the manual has the rule that a refused request broke: of the point, else of the function."""
        if refusal.point is not None:
            return refusal.point.source
        document = next((each.id for each in self.device.device.documents), "")
        lines = (code.line for code in self.device.device.bus.functions if code.number == function)
        return Source(document, None, None, next(lines, None))


class ModbusCore(Core):
    """Devices on a line; `character` is the seconds that one takes, 0 where that is unknown."""

    def __init__(self, devices: Sequence[SimulatedDevice], framing: str) -> None:
        self.devices = devices
        self.framing = framing
        self.character = 0.0
        self._units = {unit: _Unit(device) for unit, device in by_unit(devices).items()}
        self._free = 0.0

    def cut(self, data: bytes, *, quiet: bool) -> tuple[list[bytes], int]:
        """Cut by the framing."""
        return (_cut_tcp if self.framing == "tcp" else _cut_rtu)(data, quiet=quiet)

    def answer(self, request: bytes) -> Answer | None:
        """Return what a request leads to; None if it is for no unit of this line."""
        head, pdu = (request[:7], request[7:]) if self.framing == "tcp" else (request[:1], request[1:-2])
        number = head[-1]
        unit = self._units.get(number)
        if unit is None:
            return self._without_unit(number, head, pdu)
        if unit.device.clock.now() < self._free:
            unit.device.complain("turnaround", f"a request came within {unit.silent:g} characters of an answer")
        refused = ""
        try:
            reply = self._reply(unit, pdu, number)
        except Refusal as refusal:
            code = unit.device.refusals.get(
                refusal.kind, unit.codes[_REASONS.get(refusal.kind, "value") or refusal.kind]
            )
            reply = bytes((pdu[0] & 0x7F | 0x80, code))
            refused = refusal.why
            unit.device.complain(refusal.kind.replace("_", " "), refusal.why, unit.source(refusal, pdu[0]))
            if not code and len(pdu) >= 5 and pdu[0] in FUNCTIONS:  # the device says nothing of it
                reply = pdu[:5]
        answer = Answer(unit.device, self._framed(head, reply), unit.delay_now(), refused)
        if self.character:
            self._free = unit.device.clock.now() + answer.delay + (len(answer.data) + unit.silent) * self.character
        return answer

    def spoiled(self, answer: bytes, what: str) -> bytes:
        """Return an answer that is wrong in one way; the checksum of TCP is the number of the transaction."""
        if what == "check":
            place = 1 if self.framing == "tcp" else len(answer) - 1
            return answer[:place] + bytes((answer[place] ^ 0x55,)) + answer[place + 1 :]
        head, pdu = (answer[:7], answer[7:]) if self.framing == "tcp" else (answer[:1], answer[1:-2])
        if what == "unit":
            head = head[:-1] + bytes((head[-1] % 247 + 1,))
        elif what == "function":
            pdu = bytes((pdu[0] ^ 0x40,)) + pdu[1:]
        elif what == "exception":
            pdu = bytes((pdu[0] | 0x80, 4))
        return self._framed(head, pdu)

    def _framed(self, head: bytes, pdu: bytes) -> bytes:
        return frame(self.framing, head[-1], int.from_bytes(head[:2], "big") if len(head) > 1 else 0, pdu)

    def _without_unit(self, number: int, head: bytes, pdu: bytes) -> Answer | None:
        """Answer for a unit that no device here has: a broadcast, the direct unit of TCP, or nobody."""
        hearing = [unit for unit in self._units.values() if unit.profile.broadcast == number]
        for unit in hearing:
            try:
                if pdu[0] not in unit.profile.broadcasts:
                    raise Refusal("function", f"function {pdu[0]:02X}h is not for all units at once")
                self._reply(unit, pdu, number)
            except Refusal as refusal:
                unit.device.complain("broadcast", refusal.why, unit.source(refusal, pdu[0]))
        if hearing:
            return Answer(hearing[0].device, b"")
        if self.framing != "tcp":
            return None
        if number == _DIRECT and len(self._units) == 1:
            (only,) = self._units
            answer = self.answer(head[:-1] + bytes((only,)) + pdu)
            return answer and Answer(answer.device, self._framed(head, answer.data[7:]), answer.delay, answer.refused)
        reply = bytes((pdu[0] & 0x7F | 0x80, _GATEWAY_SILENT))
        return Answer(None, self._framed(head, reply), 0.0, f"no device has the unit {number}")

    def _reply(self, unit: _Unit, pdu: bytes, number: int) -> bytes:
        """Return the PDU of the reply to a request. Raises Refusal."""
        function = pdu[0]
        most = unit.profile.most.get(function)
        if most is None:
            raise Refusal("function", f"the device does not have function {function:02X}h")
        request = request_in(Unwrapped("tcp", bytes(6) + bytes((number,)) + pdu, pdu))
        if isinstance(request, Flaw):
            raise Refusal("format", f"function {function:02X}h: {request.status.replace('_', ' ')}")
        if request.count > most:
            raise Refusal("format", f"function {function:02X}h takes {most} items at most, not {request.count}")
        if function == 0x08:
            if request.address:
                raise Refusal("format", f"sub-function {request.address} of the test is none")
            return pdu
        space, last = FUNCTIONS[function].space, request.address + request.count - 1
        for low, high in unit.gaps.get(space, ()):
            if low <= last and request.address <= high:
                raise Refusal(
                    "address", f"{space} {request.address} to {last} crosses the gap {low:04X}h to {high:04X}h"
                )
        if function in READS:
            return _read(unit.device, request, space)
        area, addresses = (space, 0), range(request.address, last + 1)
        unit.device.write(area, dict(zip(addresses, request.values, strict=True)))
        return pdu[:5]


class _UnsettledCore(ModbusCore):
    """Devices behind a port that takes both framings: waits for the first whole request of a client."""

    def __init__(self, devices: Sequence[SimulatedDevice]) -> None:
        super().__init__(devices, "tcp")
        self._rtu, self._tcp = ModbusCore(devices, "rtu"), ModbusCore(devices, "tcp")

    def settled(self, data: bytes) -> Core:
        """Return the core of the framing that a request in the data has; a checksum is the surer sign."""
        if self._rtu.cut(data, quiet=False)[0]:
            return self._rtu
        return self._tcp if self._tcp.cut(data, quiet=False)[0] else self


def _read(device: SimulatedDevice, request: Request, space: str) -> bytes:
    values = device.read((space, 0), range(request.address, request.address + request.count))
    if SPACES[space].read in (0x01, 0x02):
        data = pack_bits(tuple(values), even=False)
    else:
        data = b"".join([value.to_bytes(2, "big") for value in values])
    return bytes((request.function, len(data))) + data


def _code(bus: Bus, reason: str) -> int:
    """Return the number of the exception that the device has for a reason, else that of the protocol."""
    number, words = _CODES[reason]
    for word in words:
        for exception in bus.exceptions:
            if word in exception.name:
                return exception.number
    known = {exception.number for exception in bus.exceptions}
    return number if number in known or not known else min(known & {2, 3, 4} or {number})


def _delay_point(device: SimulatedDevice) -> str | None:
    """Return the point that holds the milliseconds until an answer; None without one."""
    wanted = device.device.bus.timing.get("response_delay_point")
    return next((p.name for p in device.layout.points.values() if wanted and wanted in (p.name, p.code)), None)


def _cut_tcp(data: bytes, *, quiet: bool) -> tuple[list[bytes], int]:
    """Cut by the length in the header; what cannot begin a frame is skipped."""
    found, at = [], 0
    while len(data) - at >= 8:
        size = 6 + (data[at + 4] << 8 | data[at + 5])
        if data[at + 2] or data[at + 3] or not 8 <= size <= _LONGEST + 4:
            at += 1
        elif at + size > len(data):
            break
        else:
            found.append(bytes(data[at : at + size]))
            at += size
    return found, len(data) if quiet else at


def _cut_rtu(data: bytes, *, quiet: bool) -> tuple[list[bytes], int]:
    """Cut by the length that the function gives, and the checksum; one of an unknown function ends with the data."""
    found, end = cut_sound(data, _sound_size, LEAST["rtu"], _LONGEST)
    rest = data[end:]
    if LEAST["rtu"] <= len(rest) <= _LONGEST and not request_length(rest[1:]) and _is_right(rest):
        return [*found, bytes(rest)], len(data)
    return found, len(data) if quiet else max(end, len(data) - _LONGEST)


def _sound_size(data: bytes) -> int:
    """Return the size of the request that the data begin with; 0 if its function, length or checksum says none."""
    length = request_length(data[1:])
    return length + 3 if 0 < length <= len(data) - 3 and _is_right(data[: length + 3]) else 0


def _is_right(data: bytes) -> bool:
    return crc16(data[:-2]) == data[-2] | data[-1] << 8
