"""Decodes Modbus frames: requests, replies, echoes and exceptions; the request before a reply tells what it means."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from fieldscribe.families.answers import Heard, Item
from fieldscribe.families.modbus.functions import PROTOCOL_MOST, READ_BITS, READS, SINGLE, SPACES
from fieldscribe.families.modbus.recognition import Wrapped, recognise
from fieldscribe.families.modbus.remarks import (
    exception_text,
    framing_finding,
    function_text,
    manual_notes,
    request_findings,
    request_notes,
    span_said,
)
from fieldscribe.families.modbus.replies import Reply, parse_reply
from fieldscribe.families.modbus.requests import Request, parse_request
from fieldscribe.families.spoken import Span, Spoken
from fieldscribe.hexadecimal import rejoined, typed_bytes
from fieldscribe.wording.buses import counted, no_answer_text, spaced, words_text

if TYPE_CHECKING:
    from collections.abc import Sequence

    from fieldscribe.asked import Options
    from fieldscribe.families.directory import Directory
    from fieldscribe.families.spoken import Course
    from fieldscribe.model import Device

_UNASKED = "which addresses these are, only the request says: give it before this frame, or with --request"
_SPACE_OF = {
    function: name
    for name, space in SPACES.items()
    for function in (space.read, space.write_one, space.write_many)
    if function is not None
}


class ModbusSpeech:
    """Decodes the frames of one device."""

    def __init__(self, device: Device, framing: str | None = None) -> None:
        self._device = device
        self._framing = framing

    def frames(self, texts: Sequence[str]) -> list[bytes]:
        """The frames that people pasted. Raises UnclearError."""
        return [typed_bytes(text, "frame", "05 06 10 28 01 F4 0C 91") for text in rejoined(texts, 2)]

    def hear(self, frame: bytes, course: Course, directory: Directory, *, expecting: bool = False) -> Spoken:
        """What a frame is; any bytes are safe."""
        wrapped = recognise(frame, self._device.bus.framings, self._framing)
        asked: Request | None = None if expecting else course.asked()
        readable = wrapped.mended is not None and wrapped.pdu
        fixed = course.fixed and asked is not None
        spoken = self._read(wrapped, asked, directory, fixed=fixed) if readable else _unreadable(wrapped, "")
        heard = spoken.heard
        faults = (*((wrapped.fault,) if wrapped.fault else ()), *heard.faults)
        if expecting and spoken.asks is None:
            said = parse_request(wrapped.framing, wrapped.mended) if wrapped.mended else wrapped.fault
            heard = replace(heard, kind="unreadable")
            faults = (*faults, f"it is no request: {said}")
        foreign = framing_finding(self._device, wrapped.framing)
        findings = (*heard.findings, foreign) if foreign else heard.findings
        notes = (*heard.notes, *manual_notes(self._device, frame))
        heard = replace(heard, faults=faults, findings=findings, notes=notes)
        return replace(spoken, heard=heard, binds=spoken.asks is not None)

    def _read(self, wrapped: Wrapped, asked: Request | None, directory: Directory, *, fixed: bool) -> Spoken:
        data = wrapped.mended or b""
        reply = parse_reply(wrapped.framing, asked, data) if asked else Reply("")
        if wrapped.pdu[0] & 0x80:
            return self._exception(wrapped, asked, reply.status)
        if asked and reply.status == "ok":
            return _reply(wrapped, asked, reply)
        parsed = parse_request(wrapped.framing, data)
        if isinstance(parsed, Request) and not fixed:
            return self._request(wrapped, parsed, directory)
        return _unmatched_reply(wrapped, parsed, asked, reply.status)

    def _request(self, wrapped: Wrapped, request: Request, directory: Directory) -> Spoken:
        silent = request.unit == self._device.bus.broadcast
        echo = request.function in SINGLE and not silent
        span = _span(request)
        said = f"{'request, or the reply that repeats it' if echo else 'request'}, {span_said(request)}"
        heard = _heard(wrapped, "request_or_reply" if echo else "request", said)
        findings = tuple(request_findings(self._device, request))
        notes = tuple(request_notes(self._device, directory, request, span))
        heard = replace(heard, findings=findings, notes=notes)
        return Spoken(heard, _carried(request, span), asks=request, silent=silent)

    def _exception(self, wrapped: Wrapped, asked: Request | None, status: str) -> Spoken:
        if len(wrapped.pdu) != 2:
            return _unreadable(wrapped, f"an exception has 2 bytes from the function on, here are {len(wrapped.pdu)}")
        code = wrapped.pdu[1]
        said = f"exception {exception_text(self._device, code)}"
        heard = replace(_heard(wrapped, "exception", said), exception=code)
        if asked is None:
            return Spoken(replace(heard, notes=("which request it refuses is not in the frame",)))
        if status != "exception":
            return Spoken(replace(heard, faults=(no_answer_text(status, "request before"),)))
        heard = replace(heard, summary=f"{heard.summary}; refused was {span_said(asked)}")
        return Spoken(heard, _carried(asked, _span(asked)), answers=True)


def speech_of(device: Device, options: Options) -> ModbusSpeech:
    """The decoder for the frames of the device."""
    return ModbusSpeech(device, options.framing)


def _reply(wrapped: Wrapped, asked: Request, reply: Reply) -> Spoken:
    reads = asked.function in READS
    span = replace(_span(asked), words=reply.values if reads else asked.values, learned=True)
    done = "" if reads else ", the device has taken the request"
    return Spoken(_heard(wrapped, "reply", f"reply{done}, {span_said(asked)}"), _carried(asked, span), answers=True)


def _unmatched_reply(wrapped: Wrapped, parsed: Request | str, asked: Request | None, status: str) -> Spoken:
    """The result for a reply that does not fit the open request: what it carries, as far as that is known."""
    pdu = wrapped.pdu
    function = pdu[0]
    faults = (no_answer_text(status),) if asked else ()
    if function in READS and len(pdu) >= 2 and pdu[1] == len(pdu) - 2:
        same = asked is not None and asked.function == function
        return _unmatched_read(wrapped, asked if same else None, faults)
    if isinstance(parsed, Request):
        request = parsed
    elif function in (0x0F, 0x10) and len(pdu) == 5:
        request = Request(0, function, int.from_bytes(pdu[1:3], "big"), int.from_bytes(pdu[3:5], "big"))
    else:
        return _unreadable(wrapped, _why_unreadable(pdu, parsed))
    carried = _carried(request, _span(request)) if 0 < request.count <= PROTOCOL_MOST[function] else ()
    heard = _heard(wrapped, "reply", f"reply, the device has taken the request, {span_said(request)}")
    return Spoken(replace(heard, faults=faults), carried)


def _unmatched_read(wrapped: Wrapped, asked: Request | None, faults: tuple[str, ...]) -> Spoken:
    values, data = _data_of(wrapped.pdu), wrapped.pdu[2:]
    if asked is None:
        said = f"reply with {counted(len(data), 'byte')} of data: {spaced(data)}"
        return Spoken(replace(_heard(wrapped, "reply", said), faults=faults, notes=(_UNASKED,)))
    due = (asked.count + 7) // 8 if asked.function in READ_BITS else 2 * asked.count
    if len(data) != due:
        faults = (f"it brings {len(data)} bytes, the request asks for {due} ({asked.count} items)",)
    came = replace(asked, count=min(asked.count, len(values)))
    heard = replace(_heard(wrapped, "reply", f"reply, {span_said(came)}"), faults=faults)
    return Spoken(heard, (replace(_span(came), words=values[: came.count]),), answers=True)


def _span(request: Request) -> Span:
    """The addresses of a request, with the values that it writes."""
    count = min(request.count, 0x10000 - request.address)
    written = request.function not in READS
    return Span(_SPACE_OF.get(request.function, ""), request.address, count, request.values or None, written)


def _carried(request: Request, span: Span) -> tuple[Span | Item, ...]:
    if request.function == 0x08:
        text = f"test data {words_text(span.words or ())}; the device sends it back unchanged"
        return (Item("", request.address, 1, text),)
    return (span,)


def _heard(wrapped: Wrapped, kind: str, said: str) -> Heard:
    pdu = wrapped.pdu
    function = pdu[0] & 0x7F if kind == "exception" else pdu[0] if pdu else None
    unit = "no unit" if wrapped.unit is None else f"unit {wrapped.unit}"
    named = "" if function is None else f", {function_text(function)}"
    summary = f"{wrapped.framing.upper()}, {unit}{named}: {said}"
    return Heard(wrapped.data, wrapped.framing, kind, wrapped.unit, function, summary, checks=wrapped.checks)


def _unreadable(wrapped: Wrapped, why: str) -> Spoken:
    return Spoken(replace(_heard(wrapped, "unreadable", "not readable"), faults=(why,) if why else ()))


def _why_unreadable(pdu: bytes, problem: str) -> str:
    """Why a PDU is no request, and if it is a read, why it is no reply either."""
    if pdu[0] not in READS or len(pdu) < 2:
        return problem
    return f"as a request: {problem}; as a reply: it says that {pdu[1]} bytes of data follow, here are {len(pdu) - 2}"


def _data_of(pdu: bytes) -> tuple[int, ...]:
    """The bits or words of a read reply, without knowing how many were asked for."""
    data = pdu[2:]
    if pdu[0] in READ_BITS:
        return tuple(data[at >> 3] >> (at & 7) & 1 for at in range(8 * len(data)))
    return tuple(int.from_bytes(data[at : at + 2], "big") for at in range(0, len(data) - 1, 2))
