"""Decodes Modbus frames: requests, replies, echoes and exceptions; the request before a reply tells what it means."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from fieldscribe.families.decoded_frame import BoundedMemo, DecodedFrame, FrameBytes, Span, cut_apart
from fieldscribe.families.frame_results import FrameResult, Item
from fieldscribe.families.modbus import FRAMINGS, PROTOCOL_MOST, READS, SINGLE, SPACE_OF, framings_of, remarks
from fieldscribe.families.modbus.exchange import Reply, Request, done_in, reply_in, request_in
from fieldscribe.families.modbus.frames import (
    LEAST,
    Flaw,
    Unwrapped,
    data_size,
    reply_length,
    request_length,
    unwrap,
    values_in,
    without_crc,
)
from fieldscribe.pasted_numbers import rejoined, typed_bytes
from fieldscribe.wording.buses import no_answer_text, words_text

if TYPE_CHECKING:
    from collections.abc import Sequence

    from fieldscribe.families.decoded_frame import OpenRequests
    from fieldscribe.families.directory import Directory
    from fieldscribe.model import Device
    from fieldscribe.user_errors import Options


_MOST = 8192
"""How many heads of requests and replies are remembered."""


class ModbusFrameDecoder:
    """Decodes the frames of one device."""

    def __init__(self, device: Device, framing: str | None = None) -> None:
        self._device = device
        self._framing = framing
        self._heads: BoundedMemo[tuple[str, str, int, int, int, int], FrameResult] = BoundedMemo(_MOST, self._said)

    def frames(self, texts: Sequence[str]) -> list[bytes]:
        """The frames that people pasted. Raises UnclearError."""
        pasted = (typed_bytes(text, "frame", "05 06 10 28 01 F4 0C 91") for text in rejoined(texts, 2))
        return [frame for data in pasted for frame in frames_in(data, self._framing)]

    def decode(
        self, frame: bytes, requests: OpenRequests, directory: Directory, *, expecting: bool = False
    ) -> DecodedFrame:
        """What a frame is; any bytes are safe."""
        del directory  # a request tells all that a reply needs
        unwrapped = recognise(frame, framings_of(self._device.bus), self._framing)
        asked: Request | None = None if expecting else requests.request()
        sound = unwrapped if unwrapped.flaw is None else replace(unwrapped, flaw=None)
        decoded = self._read(sound, asked, fixed=requests.fixed and asked is not None)
        heard = decoded.result
        faults = (*remarks.frame_faults(unwrapped), *heard.faults)
        if expecting and isinstance(problem := request_in(unwrapped), Flaw):
            heard = replace(heard, kind="unreadable")
            faults = (*faults, f"it is no request: {remarks.flaw_text(problem)}")
        checks = remarks.frame_checks(unwrapped)
        heard = replace(heard, faults=faults) if faults else heard
        return replace(
            decoded, result=heard, frame=FrameBytes(unwrapped.data, checks), stays_open=decoded.request is not None
        )

    def _read(self, unwrapped: Unwrapped, asked: Request | None, *, fixed: bool) -> DecodedFrame:
        pdu = unwrapped.pdu
        if not pdu:
            return _unreadable(unwrapped, None)
        reply = reply_in(asked, unwrapped) if asked else Reply("")
        if pdu[0] & 0x80:
            return self._exception(unwrapped, asked, reply.status)
        if asked and reply.status == "ok":
            return self._reply(unwrapped, asked, reply)
        parsed = request_in(unwrapped)
        if isinstance(parsed, Request) and not fixed:
            return self._request(unwrapped, parsed)
        return _unmatched_reply(unwrapped, parsed, asked, reply.status)

    def _request(self, unwrapped: Unwrapped, request: Request) -> DecodedFrame:
        heard = self._heads["request", unwrapped.framing, *_head(request)]
        silent = request.unit == self._device.bus.broadcast
        return DecodedFrame(heard, _carried(request, _span(request)), request=request, unanswered=silent)

    def _reply(self, unwrapped: Unwrapped, asked: Request, reply: Reply) -> DecodedFrame:
        heard = self._heads["reply", unwrapped.framing, *_head(asked)]
        words = reply.values if asked.function in READS else asked.values
        return DecodedFrame(heard, _carried(asked, _span(asked, words, learned=True)), answers=True)

    def _said(self, key: tuple[str, str, int, int, int, int]) -> FrameResult:
        """What a request says, or the reply to it, whatever it carries."""
        kind, framing, unit, function, address, count = key
        request = Request(unit, function, address, count)
        if kind == "reply":
            return _headed(framing, kind, request.unit, request.function, remarks.reply_said(request))
        silent = request.unit == self._device.bus.broadcast
        echo = request.function in SINGLE and not silent
        said = f"{'request, or the reply that repeats it' if echo else 'request'}, {remarks.span_said(request)}"
        kind = "request_or_reply" if echo else "request"
        findings = tuple(remarks.request_findings(self._device, request))
        heard = _headed(framing, kind, request.unit, request.function, said)
        return replace(heard, findings=findings, notes=(remarks.SILENT,) if silent and not findings else ())

    def _exception(self, unwrapped: Unwrapped, asked: Request | None, status: str) -> DecodedFrame:
        if len(unwrapped.pdu) != 2:
            return _unreadable(unwrapped, Flaw("long_exception", len(unwrapped.pdu), 2))
        code = unwrapped.pdu[1]
        said = f"exception {remarks.exception_text(self._device, code)}"
        heard = replace(_heard(unwrapped, "exception", said), exception=code)
        if asked is None:
            return DecodedFrame(replace(heard, notes=(remarks.UNKNOWN_REQUEST,)))
        if status != "exception":
            return DecodedFrame(replace(heard, faults=(no_answer_text(status, "request before"),)))
        heard = replace(heard, summary=f"{heard.summary}; refused was {remarks.span_said(asked)}")
        return DecodedFrame(heard, _carried(asked, _span(asked)), answers=True)


def decoder_of(device: Device, options: Options) -> ModbusFrameDecoder:
    """The decoder for the frames of the device."""
    return ModbusFrameDecoder(device, options.framing)


def _head(request: Request) -> tuple[int, int, int, int]:
    """What a request is about, without what it carries."""
    return request.unit, request.function, request.address, request.count


def _unmatched_reply(unwrapped: Unwrapped, parsed: Request | Flaw, asked: Request | None, status: str) -> DecodedFrame:
    """The result for a reply that does not fit the open request: what it carries, as far as that is known."""
    pdu = unwrapped.pdu
    faults = (no_answer_text(status),) if asked else ()
    if pdu[0] in READS and len(pdu) == reply_length(pdu):
        same = asked is not None and asked.function == pdu[0]
        return _unmatched_read(unwrapped, asked if same else None, faults)
    request = (done_in(pdu) or parsed) if isinstance(parsed, Flaw) else parsed
    if isinstance(request, Flaw):
        return _unreadable(unwrapped, request)
    carried = _carried(request, _span(request)) if 0 < request.count <= PROTOCOL_MOST[request.function] else ()
    return DecodedFrame(replace(_heard(unwrapped, "reply", remarks.reply_said(request)), faults=faults), carried)


def _unmatched_read(unwrapped: Unwrapped, asked: Request | None, faults: tuple[str, ...]) -> DecodedFrame:
    data = unwrapped.pdu[2:]
    if asked is None:
        heard = _heard(unwrapped, "reply", remarks.data_said(data))
        return DecodedFrame(replace(heard, faults=faults, notes=(remarks.UNASKED,)))
    values, due = values_in(asked.function, data), data_size(asked.function, asked.count)
    if len(data) != due:
        faults = (remarks.data_fault(asked, len(data), due),)
    came = replace(asked, count=min(asked.count, len(values)))
    heard = replace(_heard(unwrapped, "reply", remarks.reply_said(came)), faults=faults)
    return DecodedFrame(heard, (_span(came, values[: came.count]),), answers=True)


def _span(request: Request, words: tuple[int, ...] | None = None, *, learned: bool = False) -> Span:
    """The addresses of a request, with the values that it writes, or that its reply brings."""
    count = min(request.count, 0x10000 - request.address)
    written, words = request.function not in READS, request.values or None if words is None else words
    return Span(SPACE_OF.get(request.function, ""), request.address, count, words, written, learned)


def _carried(request: Request, span: Span) -> tuple[Span | Item, ...]:
    if request.function == 0x08:
        said = f"test data {words_text(span.words or ())}; the device sends it back unchanged"
        return (Item("", request.address, 1, said),)
    return (span,)


def _heard(unwrapped: Unwrapped, kind: str, said: str) -> FrameResult:
    function = unwrapped.pdu[0] if unwrapped.pdu else None
    function = function & 0x7F if function is not None and kind == "exception" else function
    return _headed(unwrapped.framing, kind, unwrapped.unit, function, said)


def _headed(framing: str, kind: str, unit: int | None, function: int | None, said: str) -> FrameResult:
    return FrameResult(b"", framing, kind, unit, function, remarks.summary(framing, unit, function, said))


def _unreadable(unwrapped: Unwrapped, flaw: Flaw | None) -> DecodedFrame:
    faults = () if flaw is None else (remarks.unreadable_text(unwrapped.pdu, flaw),)
    return DecodedFrame(replace(_heard(unwrapped, "unreadable", "not readable"), faults=faults))


def recognise(data: bytes, framings: tuple[str, ...], forced: str | None = None) -> Unwrapped:
    """The bytes in the forced framing; else in the one that checksum or header fit, else in that of the device."""
    usual = forced or (framings or FRAMINGS)[0]
    tried = (unwrap(framing, data) for framing in ((forced,) if forced else FRAMINGS))
    sound = next((unwrapped for unwrapped in tried if unwrapped.flaw is None), None)
    unwrapped = sound or unwrap(usual, data)
    flaw = unwrapped.flaw
    if flaw is None or flaw.swapped or unwrapped.framing == "tcp" or _is_whole(unwrapped.pdu):
        return unwrapped
    return without_crc(data) if _is_whole(data[1:]) else unwrapped


def frames_in(data: bytes, forced: str | None = None) -> list[bytes]:
    """The frames in pasted bytes: several if these are whole frames behind each other, by length and checksum."""
    framings = (forced,) if forced else FRAMINGS
    if any(unwrap(framing, data).flaw is None for framing in framings):
        return [data]
    cut = cut_apart(data, _sound_rtu, LEAST["rtu"]) if "rtu" in framings else [data]
    if len(cut) == 1 and "tcp" in framings:
        cut = cut_apart(data, _sound_tcp, LEAST["tcp"])
        cut = cut if all(unwrap("tcp", frame).flaw is None for frame in cut) else [data]
    return cut


def _sound_rtu(data: bytes) -> int:
    """The size of the RTU frame that the bytes begin with; 0 where the checksum of none is right."""
    pdu = data[1:]
    sizes = {request_length(pdu), reply_length(pdu)} if pdu else set()
    whole = (size + 3 for size in sorted(sizes) if 0 < size <= len(data) - 3)
    return next((size for size in whole if unwrap("rtu", data[:size]).flaw is None), 0)


def _sound_tcp(data: bytes) -> int:
    """The size of the TCP frame that the bytes begin with, as its header says; 0 where that cannot be."""
    size = 6 + int.from_bytes(data[4:6], "big")
    return size if unwrap("tcp", data[:size]).flaw is None else 0


def _is_whole(pdu: bytes) -> bool:
    """Whether a PDU is as long as its function says, as a request or as a reply."""
    return bool(pdu) and len(pdu) in (request_length(pdu), reply_length(pdu))
