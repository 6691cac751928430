"""Modbus frames in words: requests, replies, echoes and exceptions, each reply read by the request before it."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from fieldscribe.conversation.answers import Heard, Item
from fieldscribe.families.modbus.conversation.address_book import AddressBook, Area
from fieldscribe.families.modbus.conversation.recognition import Wrapped, recognise
from fieldscribe.families.modbus.conversation.remarks import (
    REPLY_FAULTS,
    area_of,
    area_text,
    exception_text,
    framing_finding,
    function_text,
    manual_notes,
    request_findings,
    request_notes,
)
from fieldscribe.families.modbus.functions import PROTOCOL_MOST, READ_BITS, READS, SINGLE
from fieldscribe.families.modbus.replies import Reply, parse_reply
from fieldscribe.families.modbus.requests import Request, parse_request

if TYPE_CHECKING:
    from fractions import Fraction

    from fieldscribe.arithmetic.codec import Settings
    from fieldscribe.model import Device

_UNASKED = "which addresses these are, only the request says: give it before this frame, or with --request"


class ModbusListener:
    """Hears one frame after the other; remembers the open request, and what replies said of points."""

    def __init__(self, device: Device, settings: Settings, framing: str | None = None) -> None:
        self._device = device
        self._given = settings
        self._heard: dict[str, int | Fraction] = {}
        self._framing = framing
        self._book = AddressBook(device)
        self._open: Request | None = None
        self._expected: Request | None = None

    def hear(self, data: bytes) -> Heard:
        """What the next frame says; any bytes are safe."""
        wrapped = recognise(data, self._device.bus.framings, self._framing)
        found = self._read(wrapped) if wrapped.mended and wrapped.pdu else _unreadable(wrapped, "")
        faults = ([wrapped.fault] if wrapped.fault else []) + list(found.faults)
        foreign = framing_finding(self._device, wrapped.framing)
        findings = (*found.findings, foreign) if foreign else found.findings
        notes = (*found.notes, *manual_notes(self._device, data))
        return replace(found, faults=tuple(faults), findings=findings, notes=notes)

    def expect_reply_to(self, data: bytes) -> Heard:
        """Take a frame as the request that the following frames answer."""
        self._open = self._expected = None
        wrapped = recognise(data, self._device.bus.framings, self._framing)
        request = parse_request(wrapped.framing, wrapped.mended) if wrapped.mended else wrapped.fault
        found = self.hear(data)
        if isinstance(request, str):
            return replace(found, kind="unreadable", faults=(*found.faults, f"it is no request: {request}"))
        self._open = self._expected = request
        return found

    def _read(self, wrapped: Wrapped) -> Heard:
        data, request = wrapped.mended or b"", self._open
        if wrapped.pdu[0] & 0x80:
            return self._exception(wrapped)
        reply = parse_reply(wrapped.framing, request, data) if request else Reply("")
        if request and reply.status == "ok":
            return self._reply(wrapped, request, reply)
        parsed = parse_request(wrapped.framing, data)
        if isinstance(parsed, Request) and not self._expected:
            return self._request(wrapped, parsed)
        return self._stray(wrapped, parsed, reply.status)

    def _request(self, wrapped: Wrapped, request: Request) -> Heard:
        self._open = None if request.unit == self._device.bus.broadcast else request
        echo = request.function in SINGLE and self._open is not None
        area = area_of(request)
        said = f"{'request, or the reply that repeats it' if echo else 'request'}, {area_text(area)}"
        notes = tuple(request_notes(self._device, self._book, request))
        found = _heard(wrapped, "request_or_reply" if echo else "request", said)
        findings = tuple(request_findings(self._device, request))
        return replace(found, items=self._items(area), findings=findings, notes=notes)

    def _reply(self, wrapped: Wrapped, request: Request, reply: Reply) -> Heard:
        area = area_of(request)
        if request.function in READS:
            area = replace(area, values=reply.values)
        items = self._items(area)
        self._heard.update(self._book.raws(area))
        self._open = self._expected
        done = "" if request.function in READS else ", the device has taken the request"
        return replace(_heard(wrapped, "reply", f"reply{done}, {area_text(area)}"), items=items)

    def _exception(self, wrapped: Wrapped) -> Heard:
        pdu, request = wrapped.pdu, self._open
        if len(pdu) != 2:
            return _unreadable(wrapped, f"an exception has 2 bytes from the function on, here are {len(pdu)}")
        said = f"exception {exception_text(self._device, pdu[1])}"
        if request is None:
            found = _heard(wrapped, "exception", said)
            return replace(found, exception=pdu[1], notes=("which request it refuses is not in the frame",))
        status = parse_reply(wrapped.framing, request, wrapped.mended or b"").status
        if status != "exception":
            fault = f"it does not answer the request before: {REPLY_FAULTS.get(status, status)}"
            return replace(_heard(wrapped, "exception", said), exception=pdu[1], faults=(fault,))
        self._open = self._expected
        area = area_of(request)
        found = _heard(wrapped, "exception", f"{said}; refused was {area_text(area)}")
        return replace(found, exception=pdu[1], items=self._items(area))

    def _stray(self, wrapped: Wrapped, parsed: Request | str, status: str) -> Heard:
        """A reply that fits no request, or not quite: what it brings, as far as that can be said."""
        pdu, request = wrapped.pdu, self._open
        function = pdu[0]
        faults = (f"it does not answer the request: {REPLY_FAULTS.get(status, status)}",) if request else ()
        if function in READS and len(pdu) >= 2 and pdu[1] == len(pdu) - 2:
            same = request is not None and request.function == function
            return self._stray_read(wrapped, request if same else None, faults)
        if isinstance(parsed, Request):
            area = area_of(parsed)
        elif function in (0x0F, 0x10) and len(pdu) == 5:
            area = Area(function, int.from_bytes(pdu[1:3], "big"), int.from_bytes(pdu[3:5], "big"))
        else:
            return _unreadable(wrapped, _neither(pdu, parsed))
        items = self._items(area) if 0 < area.count <= PROTOCOL_MOST[function] else ()
        found = _heard(wrapped, "reply", f"reply, the device has taken the request, {area_text(area)}")
        return replace(found, items=items, faults=faults)

    def _stray_read(self, wrapped: Wrapped, request: Request | None, faults: tuple[str, ...]) -> Heard:
        values, data = _data_of(wrapped.pdu), wrapped.pdu[2:]
        if request is None:
            size = f"{len(data)} byte{'' if len(data) == 1 else 's'}"
            said = f"reply with {size} of data: {data.hex(' ').upper()}"
            return replace(_heard(wrapped, "reply", said), faults=faults, notes=(_UNASKED,))
        count = min(request.count, len(values))
        area = Area(request.function, request.address, count, values[:count])
        if len(data) != _asked(request):
            faults = (f"it brings {len(data)} bytes, the request asks for {_asked(request)} ({request.count} items)",)
        self._open = self._expected
        return replace(_heard(wrapped, "reply", f"reply, {area_text(area)}"), items=self._items(area), faults=faults)

    def _items(self, area: Area) -> tuple[Item, ...]:
        """What an area says; factors are what was given, else points in the same frame, else what was heard before."""
        if area.function == 0x08:
            data = " ".join(f"{value:04X}h" for value in area.values or ())
            return (Item("", area.address, 1, f"test data {data}; the device sends it back unchanged"),)
        area = replace(area, count=min(area.count, 0x10000 - area.address))
        settings = {**self._heard, **self._book.raws(area), **self._given}
        return self._book.items(area, settings)


def _heard(wrapped: Wrapped, kind: str, said: str) -> Heard:
    pdu = wrapped.pdu
    function = pdu[0] & 0x7F if kind == "exception" else pdu[0] if pdu else None
    unit = "no unit" if wrapped.unit is None else f"unit {wrapped.unit}"
    named = "" if function is None else f", {function_text(function)}"
    summary = f"{wrapped.framing.upper()}, {unit}{named}: {said}"
    return Heard(wrapped.data, wrapped.framing, kind, wrapped.unit, function, summary, checks=wrapped.checks)


def _unreadable(wrapped: Wrapped, why: str) -> Heard:
    return replace(_heard(wrapped, "unreadable", "not readable"), faults=(why,) if why else ())


def _neither(pdu: bytes, problem: str) -> str:
    """Why a PDU is no request, and why a read is no reply either."""
    if pdu[0] not in READS or len(pdu) < 2:
        return problem
    return f"as a request: {problem}; as a reply: it says that {pdu[1]} bytes of data follow, here are {len(pdu) - 2}"


def _data_of(pdu: bytes) -> tuple[int, ...]:
    """The bits or words of a read reply, without knowing how many were asked for."""
    data = pdu[2:]
    if pdu[0] in READ_BITS:
        return tuple(data[at >> 3] >> (at & 7) & 1 for at in range(8 * len(data)))
    return tuple(int.from_bytes(data[at : at + 2], "big") for at in range(0, len(data) - 1, 2))


def _asked(request: Request) -> int:
    return (request.count + 7) // 8 if request.function in READ_BITS else 2 * request.count
