"""Decodes USS telegrams: requests, responses, broadcasts, or only the words of one part."""

from collections.abc import Sequence
from dataclasses import replace

from fieldscribe.families.decoded_frame import DecodedFrame, Element, Masks, OpenRequests, ProcessData
from fieldscribe.families.frame_results import FrameResult, Options
from fieldscribe.families.uss import of_bus, remarks, telegrams
from fieldscribe.families.uss.telegrams import Request, Unwrapped, answer_in, bare_words, frames_in, request_in, unwrap
from fieldscribe.model import Device
from fieldscribe.pasted_numbers import rejoined, typed_bytes
from fieldscribe.wording.numbers import element_text, no_answer_text

_ANSWERS = ("ok", "refused", "no_rights", "no_answer")


class UssFrameDecoder:
    """Decodes the telegrams of one device, with the settings of its link."""

    def __init__(
        self, device: Device, link: telegrams.Link, framing: str = "uss", direction: str | None = None
    ) -> None:
        self._device = device
        self._link = link if framing == "uss" else replace(link, pzd=0)
        self._framing = framing
        self._direction = direction
        self._elements = {(point.address, point.index) for point in device.points if point.index is not None}

    def frames(self, texts: Sequence[str]) -> list[bytes]:
        """Return the telegrams in pasted texts. Raises UnclearError."""
        example = "02 0E 01 143A 0000 0000 0000 0000 0000 23"
        pasted = [typed_bytes(text, "telegram", example) for text in rejoined(texts, 2, 4)]
        return [frame for data in pasted for frame in frames_in(data)] if self._framing == "uss" else pasted

    def decode(self, frame: bytes, requests: OpenRequests, *, expecting: bool = False) -> DecodedFrame:
        """Decode one telegram; any bytes are safe."""
        unwrapped = unwrap(frame) if self._framing == "uss" else bare_words(frame)
        direction = "request" if expecting else self._direction or ("response" if requests.fixed else None)
        decoded = self._read(unwrapped, requests, direction)
        return decoded._replace(stays_open=True) if expecting else decoded

    def _read(self, unwrapped: Unwrapped, requests: OpenRequests, direction: str | None) -> DecodedFrame:
        unit, words, framing = unwrapped.unit, unwrapped.words, self._framing
        head = "USS" if unit is None else f"USS, unit {unit}"
        checks, faults = remarks.checks_text(unwrapped), tuple(remarks.flaw_texts(unwrapped))
        base = FrameResult(framing, "unreadable", unit, None, head, checks=checks, faults=faults)
        if words is None:
            return DecodedFrame(base._replace(summary=f"{head}: not readable"))
        if "wrong_start" in unwrapped.flaws and len(faults) > 1:
            return DecodedFrame(base._replace(summary=f"{head}: not readable", unit=None, notes=(remarks.PARTS,)))
        if framing == "broadcast" or (framing == "uss" and unit == self._device.bus.broadcast):
            return _broadcast(base, words)
        if framing == "pzd":
            return self._process_data(base, words, direction)
        return self._telegram(base, words, requests, direction)

    def _telegram(
        self, base: FrameResult, words: tuple[int, ...], requests: OpenRequests, direction: str | None
    ) -> DecodedFrame:
        open_request: Request | None = requests.request(base.unit)
        status = ""
        if open_request is not None and direction != "request":
            status = answer_in(self._device.bus, self._link, open_request, words).status
        if direction == "response" or (direction is None and status in _ANSWERS):
            # the user fixed a request, but this unit has none open: that request went to another unit
            status = "wrong_unit" if requests.fixed and open_request is None else status
            return self._response(base, words, open_request, status)
        decoded = self._request(base, words)
        if direction is None and not requests.addressed(base.unit) and self._could_answer(words):
            return decoded._replace(result=decoded.result._replace(notes=(*decoded.result.notes, remarks.NO_REQUEST)))
        return decoded

    def _could_answer(self, words: tuple[int, ...]) -> bool:
        """Return True if these words carry values when read as a request: they could be a response instead."""
        part = telegrams.part_of(telegrams.split(words, self._link, request=True).part)
        return part is not None and any(part.values) and part.code != 0

    def _request(self, base: FrameResult, words: tuple[int, ...]) -> DecodedFrame:
        divided = telegrams.split(words, self._link, request=True)
        if not divided.fits:
            base = base._replace(faults=(*base.faults, remarks.misfit_text(len(words), self._link, request=True)))
        part, data = telegrams.part_of(divided.part), ProcessData("request", divided.words)
        unit = base.unit or 0
        if part is None:
            kind, text = ("request", "request, process data") if self._link.pkw == 0 else ("unreadable", "not readable")
            result = base._replace(kind=kind, summary=f"{base.summary}: {text}")
            return DecodedFrame(result, (data,), base.unit, request=Request(unit, 0, words=divided.words))
        request = request_in(unit, part, self._link, divided.words)
        value = part.value(request.width, self._link)
        element = Element(part.parameter, part.index, request.width, value, part.values, in_request=True)
        task = remarks.code_text(self._device.bus.functions, part.code, "task")
        text, details = self._element_and_details(part, "task")
        result = base._replace(
            kind="request",
            function=part.code,
            summary=f"{base.summary}: request, {task}{text}",
            details=details,
            findings=tuple(remarks.request_findings(self._device, part, base.unit)),
            notes=tuple(remarks.request_notes(part, self._link)),
        )
        return DecodedFrame(result, (element, data) if part.code else (data,), base.unit, request=request)

    def _response(
        self, base: FrameResult, words: tuple[int, ...], open_request: Request | None, status: str
    ) -> DecodedFrame:
        divided = telegrams.split(words, self._link, request=False)
        if not divided.fits:
            base = base._replace(faults=(*base.faults, remarks.misfit_text(len(words), self._link, request=False)))
        elif status and status not in _ANSWERS:
            base = base._replace(faults=(*base.faults, no_answer_text(status)))
        part, data = telegrams.part_of(divided.part), ProcessData("response", divided.words)
        answers = status != "no_answer"
        if part is None:
            result = base._replace(kind="reply", summary=f"{base.summary}: reply, process data")
            return DecodedFrame(result, (data,), base.unit, answers=answers)
        response = remarks.code_text(self._device.bus.codes("responses"), part.code, "response")
        text, details = self._element_and_details(part, "response")
        result = base._replace(kind="reply", summary=f"{base.summary}: reply, {response}{text}", details=details)
        if part.code in (telegrams.REFUSED, telegrams.NO_RIGHTS):
            result = self._refusal(result._replace(refusal=f"{response}{text}"), part, open_request)
        width = telegrams.RESPONSE_WIDTHS.get(part.code, 0)
        element = Element(
            part.parameter,
            part.index,
            width,
            part.value(width, self._link),
            part.values,
            refused=part.code in (telegrams.REFUSED, telegrams.NO_RIGHTS),
            counts=part.code == telegrams.SIZE,
        )
        return DecodedFrame(result, (element, data) if part.code else (data,), base.unit, answers=answers)

    def _element_and_details(self, part: telegrams.Part, key: str) -> tuple[str, dict[str, object]]:
        """Return the element of a parameter part in words, and the part as details for JSON."""
        if not part.code:
            return "", {key: part.code}
        alone = (part.parameter, part.index) not in self._elements
        details: dict[str, object] = {key: part.code, "parameter": part.parameter, "index": part.index}
        return f", {element_text(part.parameter, part.index, alone=alone)}", details

    def _refusal(self, base: FrameResult, part: telegrams.Part, open_request: Request | None) -> FrameResult:
        """Return the result of a response that refuses the request, with the way it refuses."""
        if part.code == telegrams.NO_RIGHTS or not part.values:
            return base._replace(kind="exception")
        error, task = part.values[0], None if open_request is None else open_request.task
        why = remarks.titled_code(self._device.bus.exceptions, error, "error")
        return base._replace(
            kind="exception",
            exception=error,
            summary=f"{base.summary}: {why}",
            refusal=f"{base.refusal}: {why}",
            findings=tuple(remarks.error_findings(self._device, error, task)),
            notes=tuple(remarks.error_notes(part, self._link)),
        )

    def _process_data(self, base: FrameResult, words: tuple[int, ...], direction: str | None) -> DecodedFrame:
        kind = "reply" if direction == "response" else "request"
        low, high = of_bus(self._device.bus).pzd
        faults = base.faults
        if not low <= len(words) <= high:
            faults = (*faults, f"there are {low} to {high} words of process data, here are {len(words)}")
        notes = () if direction else (remarks.FROM_MASTER,)
        result = base._replace(kind=kind, summary=f"USS: {kind}, process data", faults=faults, notes=notes)
        return DecodedFrame(result, (ProcessData(direction or "request", words),))


def decoder_of(device: Device, options: Options) -> UssFrameDecoder:
    """Return the decoder for the telegrams of the device. Raises UnclearError."""
    return UssFrameDecoder(
        device, telegrams.link_of(device, options), options.framing or "uss", options.of_family.get("direction")
    )


def _broadcast(base: FrameResult, words: tuple[int, ...]) -> DecodedFrame:
    """Return the result of a broadcast: four words of masks, then process data."""
    result = base._replace(kind="broadcast", summary=f"{base.summary}: broadcast, no unit answers")
    if len(words) < telegrams.MASKS:
        fault = f"a broadcast starts with {telegrams.MASKS} words of masks, here are {len(words)}"
        return DecodedFrame(result._replace(faults=(*result.faults, fault)))
    return DecodedFrame(result, (Masks(words[: telegrams.MASKS]), ProcessData("request", words[telegrams.MASKS :])))
