"""Decodes Modbus frames: requests, replies, echoes and exceptions. The request before a reply says what it holds."""

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache

from fieldscribe.families.decoded_frame import AddressSpan, DecodedFrame, OpenRequests, split_frames
from fieldscribe.families.frame_results import FrameResult, Item, Options
from fieldscribe.families.modbus import FRAMINGS, FUNCTIONS, READS, SINGLE, framings_of, remarks
from fieldscribe.families.modbus.frames import (
    LEAST,
    Flaw,
    Reply,
    Request,
    Unwrapped,
    confirmed_write,
    data_size,
    reply_in,
    reply_length,
    request_in,
    request_length,
    unwrap,
    values_in,
    without_crc,
)
from fieldscribe.model import Device
from fieldscribe.pasted_numbers import rejoined, typed_bytes
from fieldscribe.text import counted
from fieldscribe.wording.numbers import hex_words, no_answer_text, spaced

_MOST_FRAMES = 1024
"""The number of decoded frames that are kept."""


class ModbusFrameDecoder:
    """Decodes the frames of one device; without `framing` each frame is tried as RTU and as TCP.

    A bus repeats itself, so the last results are kept.
    """

    def __init__(self, device: Device, framing: str | None = None) -> None:
        self._device = device
        self._framing = framing
        self._decoded = lru_cache(_MOST_FRAMES)(lambda *frame: self._decode(*frame)._replace(memo=[]))

    def frames(self, texts: Sequence[str]) -> list[bytes]:
        """Return the frames in pasted texts. Raises UnclearError."""
        pasted = (typed_bytes(text, "frame", "05 06 10 28 01 F4 0C 91") for text in rejoined(texts, 2))
        return [frame for data in pasted for frame in frames_in(data, self._framing)]

    def decode(self, frame: bytes, requests: OpenRequests, *, expecting: bool = False) -> DecodedFrame:
        """Decode one frame; any bytes are safe."""
        request: Request | None = None if expecting else requests.request()
        return self._decoded(frame, request, requests.fixed and request is not None, expecting)

    def _decode(self, frame: bytes, request: Request | None, fixed: bool, expecting: bool) -> DecodedFrame:
        unwrapped = recognise(frame, framings_of(self._device.bus), self._framing)
        sound = unwrapped if unwrapped.flaw is None else replace(unwrapped, flaw=None)
        decoded = self._read(sound, request, fixed=fixed)
        result, faults = decoded.result, remarks.frame_faults(unwrapped)
        if not (faults or expecting):
            return decoded
        faults = (*faults, *result.faults)
        if expecting and isinstance(problem := request_in(unwrapped), Flaw):
            result = result._replace(kind="unreadable")
            faults = (*faults, f"it is no request: {remarks.flaw_text(problem)}")
        return decoded._replace(result=result._replace(checks=remarks.frame_checks(unwrapped), faults=faults))

    def _read(self, unwrapped: Unwrapped, request: Request | None, *, fixed: bool) -> DecodedFrame:
        pdu = unwrapped.pdu
        if not pdu:
            return DecodedFrame(_result(unwrapped, "unreadable", "not readable"))
        reply = reply_in(request, unwrapped) if request else Reply("")
        if pdu[0] & 0x80:
            return self._exception(unwrapped, request, reply.status)
        if request and reply.status == "ok":
            words = reply.values if request.function in READS else request.values
            contents = _contents(request, _span(request, words, learned=True))
            return _reply(unwrapped, request, contents, (), answers=True)
        parsed = request_in(unwrapped)
        if isinstance(parsed, Flaw) or fixed:
            return _unmatched_reply(unwrapped, parsed, request, reply.status)
        return self._request(unwrapped, parsed)

    def _request(self, unwrapped: Unwrapped, request: Request) -> DecodedFrame:
        broadcast = request.unit == self._device.bus.broadcast
        echo = request.function in SINGLE and not broadcast
        kind, text = ("request_or_reply", "request, or the reply that repeats it") if echo else ("request", "request")
        findings = tuple(remarks.request_findings(self._device, request))
        notes = (remarks.BROADCAST_NOTE,) if broadcast and not findings else ()
        text = f"{text}, {remarks.span_of_request(request)}"
        result = _result(unwrapped, kind, text, findings=findings, notes=notes)
        contents = _contents(request, _span(request))
        return DecodedFrame(result, contents, request=request, unanswered=broadcast, stays_open=True)

    def _exception(self, unwrapped: Unwrapped, request: Request | None, status: str) -> DecodedFrame:
        if len(unwrapped.pdu) != 2:
            return _unreadable(unwrapped, Flaw("long_exception", len(unwrapped.pdu), 2))
        code = unwrapped.pdu[1]
        text = f"exception {remarks.exception_text(self._device, code)}"
        result = _result(unwrapped, "exception", text)._replace(exception=code, refusal=text)
        if request is None:
            return DecodedFrame(result._replace(notes=(remarks.UNKNOWN_REQUEST,)))
        if status != "exception":
            return DecodedFrame(result._replace(faults=(no_answer_text(status, "request before"),)))
        result = result._replace(summary=f"{result.summary}; refused was {remarks.span_of_request(request)}")
        return DecodedFrame(result, _contents(request, _span(request)), answers=True)


def decoder_of(device: Device, options: Options) -> ModbusFrameDecoder:
    """Return the decoder for the frames of the device."""
    return ModbusFrameDecoder(device, options.framing)


def recognise(data: bytes, framings: tuple[str, ...], forced: str | None = None) -> Unwrapped:
    """Unwrap bytes: in the forced framing, else in the one whose checksum or header fits, else in the device's."""
    tried = (unwrap(framing, data) for framing in ((forced,) if forced else FRAMINGS))
    sound = next((unwrapped for unwrapped in tried if unwrapped.flaw is None), None)
    unwrapped = sound or unwrap(forced or (framings or FRAMINGS)[0], data)
    flaw = unwrapped.flaw
    if flaw is None or flaw.swapped or unwrapped.framing == "tcp" or _is_whole(unwrapped.pdu):
        return unwrapped
    return without_crc(data) if _is_whole(data[1:]) else unwrapped


def frames_in(data: bytes, forced: str | None = None) -> list[bytes]:
    """Return the frames in pasted bytes: several if whole frames follow each other, by length and checksum."""
    framings = (forced,) if forced else FRAMINGS
    if any(unwrap(framing, data).flaw is None for framing in framings):
        return [data]
    cut = split_frames(data, _sound_rtu, LEAST["rtu"]) if "rtu" in framings else [data]
    if len(cut) == 1 and "tcp" in framings:
        cut = split_frames(data, _sound_tcp, LEAST["tcp"])
        cut = cut if all(unwrap("tcp", frame).flaw is None for frame in cut) else [data]
    return cut


def _sound_rtu(data: bytes) -> int:
    """Return the size of the RTU frame that the bytes begin with; 0 if no checksum is right."""
    pdu = data[1:]
    sizes = {request_length(pdu), reply_length(pdu)} if pdu else set()
    whole = (size + 3 for size in sorted(sizes) if 0 < size <= len(data) - 3)
    return next((size for size in whole if unwrap("rtu", data[:size]).flaw is None), 0)


def _sound_tcp(data: bytes) -> int:
    """Return the size of the TCP frame that the bytes begin with, from its header; 0 if that is impossible."""
    size = 6 + int.from_bytes(data[4:6], "big")
    return size if unwrap("tcp", data[:size]).flaw is None else 0


def _is_whole(pdu: bytes) -> bool:
    """Return True if a PDU has the length that its function gives, as a request or as a reply."""
    return bool(pdu) and len(pdu) in (request_length(pdu), reply_length(pdu))


def _unmatched_reply(
    unwrapped: Unwrapped, parsed: Request | Flaw, request: Request | None, status: str
) -> DecodedFrame:
    """Return a reply that does not fit the open request, with the part of its contents that is certain."""
    pdu = unwrapped.pdu
    faults = (no_answer_text(status),) if request else ()
    if pdu[0] in READS and len(pdu) == reply_length(pdu):
        same = request is not None and request.function == pdu[0]
        return _unmatched_read(unwrapped, request if same else None, faults)
    confirmed = (confirmed_write(pdu) or parsed) if isinstance(parsed, Flaw) else parsed
    if isinstance(confirmed, Flaw):
        return _unreadable(unwrapped, confirmed)
    possible = 0 < confirmed.count <= FUNCTIONS[confirmed.function].most
    return _reply(unwrapped, confirmed, _contents(confirmed, _span(confirmed)) if possible else (), faults)


def _unmatched_read(unwrapped: Unwrapped, request: Request | None, faults: tuple[str, ...]) -> DecodedFrame:
    data = unwrapped.pdu[2:]
    if request is None:
        text = f"reply with {counted(len(data), 'byte')} of data: {spaced(data)}"
        return DecodedFrame(_result(unwrapped, "reply", text)._replace(faults=faults, notes=(remarks.NO_REQUEST,)))
    values, due = values_in(request.function, data), data_size(request.function, request.count)
    if len(data) != due:
        due_text = f"the request asks for {due} ({counted(request.count, 'item')})"
        faults = (f"it brings {counted(len(data), 'byte')}, {due_text}",)
    came = replace(request, count=min(request.count, len(values)))
    return _reply(unwrapped, came, (_span(came, values[: came.count]),), faults, answers=True)


def _reply(
    unwrapped: Unwrapped,
    request: Request,
    contents: tuple[AddressSpan | Item, ...],
    faults: tuple[str, ...],
    *,
    answers: bool = False,
) -> DecodedFrame:
    framing, unit = unwrapped.framing, unwrapped.unit
    text, checks = remarks.reply_text(framing, unit, request), remarks.frame_checks(unwrapped)
    result = FrameResult(framing, "reply", unit, request.function, text, checks, faults)
    return DecodedFrame(result, contents, answers=answers)


def _span(request: Request, words: tuple[int, ...] | None = None, *, learned: bool = False) -> AddressSpan:
    """Return the addresses of a request, with the values that it writes or that its reply carries."""
    count = min(request.count, 0x10000 - request.address)
    written, words = request.function not in READS, request.values or None if words is None else words
    return AddressSpan(FUNCTIONS[request.function].space, request.address, count, words, written, learned)


def _contents(request: Request, span: AddressSpan) -> tuple[AddressSpan | Item, ...]:
    if request.function == 0x08:
        text = f"test data {hex_words(span.words or ())}; the device sends it back unchanged"
        return (Item("", request.address, 1, text, subject="test data"),)
    return (span,)


def _result(
    unwrapped: Unwrapped, kind: str, text: str, *, findings: tuple[str, ...] = (), notes: tuple[str, ...] = ()
) -> FrameResult:
    function = unwrapped.pdu[0] if unwrapped.pdu else None
    function = function & 0x7F if function is not None and kind == "exception" else function
    summary = remarks.summary(unwrapped.framing, unwrapped.unit, function, text)
    framing, unit, checks = unwrapped.framing, unwrapped.unit, remarks.frame_checks(unwrapped)
    return FrameResult(framing, kind, unit, function, summary, checks, (), findings, notes=notes)


def _unreadable(unwrapped: Unwrapped, flaw: Flaw) -> DecodedFrame:
    faults = (remarks.unreadable_text(unwrapped.pdu, flaw),)
    return DecodedFrame(_result(unwrapped, "unreadable", "not readable")._replace(faults=faults))
