"""Decodes USS telegrams: requests, answers, broadcasts, or only the words of one part."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from fieldscribe.families.decoded_frame import BoundedMemo, DecodedFrame, Element, FrameDecoder, Masks, ProcessData
from fieldscribe.families.frame_results import FrameResult
from fieldscribe.families.uss import of_bus, remarks
from fieldscribe.families.uss.parts import (
    MASKS,
    NO_RIGHTS,
    REFUSED,
    RESPONSE_WIDTHS,
    SIZE,
    Link,
    Part,
    link_of,
    part_of,
    split,
)
from fieldscribe.families.uss.parts import asked as said_of
from fieldscribe.families.uss.telegrams import Request, Unwrapped, answer_in, bare_words, frames_in, request_in, unwrap
from fieldscribe.pasted_numbers import rejoined, typed_bytes
from fieldscribe.wording.buses import element_text, no_answer_text

if TYPE_CHECKING:
    from collections.abc import Sequence

    from fieldscribe.families.decoded_frame import Content, OpenRequests
    from fieldscribe.families.directory import Directory
    from fieldscribe.model import Device
    from fieldscribe.user_errors import Options

_CODES = 16
"""How many tasks there may be, and responses: they have four bits."""
_ANSWERS = ("ok", "refused", "no_rights", "no_answer")


class UssFrameDecoder(FrameDecoder):
    """Decodes the telegrams of one device, with the settings of its link."""

    def __init__(self, device: Device, link: Link, framing: str = "uss", direction: str | None = None) -> None:
        self._device = device
        self._link = link if framing == "uss" else replace(link, pzd=0)
        self._framing = framing
        self._direction = direction
        tasks, responses = device.bus.functions, device.bus.codes("responses")
        self._tasks: BoundedMemo[int, str] = BoundedMemo(_CODES, lambda code: remarks.code_text(tasks, code, "task"))
        self._responses: BoundedMemo[int, str] = BoundedMemo(
            _CODES, lambda code: remarks.code_text(responses, code, "response")
        )

    def frames(self, texts: Sequence[str]) -> list[bytes]:
        """The telegrams that people pasted. Raises UnclearError."""
        example = "02 0E 01 143A 0000 0000 0000 0000 0000 23"
        pasted = [typed_bytes(text, "telegram", example) for text in rejoined(texts, 2, 4)]
        return [frame for data in pasted for frame in frames_in(data)] if self._framing == "uss" else pasted

    def decode(
        self, frame: bytes, requests: OpenRequests, directory: Directory, *, expecting: bool = False
    ) -> DecodedFrame:
        """What a telegram is; any bytes are safe."""
        unwrapped = unwrap(frame) if self._framing == "uss" else bare_words(frame)
        decoded = self._read(unwrapped, requests, directory, expecting=expecting)
        return replace(decoded, stays_open=True) if expecting else decoded

    def _read(
        self, unwrapped: Unwrapped, requests: OpenRequests, directory: Directory, *, expecting: bool
    ) -> DecodedFrame:
        unit, words, framing = unwrapped.unit, unwrapped.words, self._framing
        head = "USS" if unit is None else f"USS, unit {unit}"
        checks, faults = remarks.checks_text(unwrapped), tuple(remarks.flaw_texts(unwrapped))
        base = FrameResult(unwrapped.data, framing, "unreadable", unit, None, head, checks=checks, faults=faults)
        direction = "request" if expecting else self._direction or ("response" if requests.fixed else None)
        if words is None:
            return DecodedFrame(replace(base, summary=f"{head}: not readable"))
        if "wrong_start" in unwrapped.flaws and len(faults) > 1:
            return DecodedFrame(replace(base, summary=f"{head}: not readable", unit=None, notes=(remarks.PARTS,)))
        if framing == "broadcast" or (framing == "uss" and unit == self._device.bus.broadcast):
            return _broadcast(base, words)
        if framing == "pzd":
            return self._process_data(base, words, direction)
        return self._telegram(base, words, requests, directory, direction)

    def _telegram(
        self,
        base: FrameResult,
        words: tuple[int, ...],
        requests: OpenRequests,
        directory: Directory,
        direction: str | None,
    ) -> DecodedFrame:
        asked: Request | None = requests.request(base.unit)
        status = ""
        if asked is not None and direction != "request":
            status = answer_in(self._device.bus, self._link, asked, words).status
        if direction == "response" or (direction is None and status in _ANSWERS):
            # the person fixed a request, but this unit has none open: that request went to another unit
            return self._reply(
                base, words, asked, "wrong_unit" if requests.fixed and asked is None else status, directory
            )
        decoded = self._request(base, words, directory)
        if direction is None and not requests.addressed(base.unit) and self._could_answer(words):
            return replace(decoded, result=replace(decoded.result, notes=(*decoded.result.notes, remarks.UNASKED)))
        return decoded

    def _could_answer(self, words: tuple[int, ...]) -> bool:
        """Whether these words, read as a request, carry values, so that they could be an answer instead."""
        part = part_of(split(words, self._link, request=True).part)
        return part is not None and any(part.values) and part.code != 0

    def _request(self, base: FrameResult, words: tuple[int, ...], directory: Directory) -> DecodedFrame:
        divided = split(words, self._link, request=True)
        misfit = () if divided.fits else (remarks.misfit_text(len(words), self._link, request=True),)
        faults = (*base.faults, *misfit)
        part, data = part_of(divided.part), ProcessData("request", divided.words)
        unit = 0 if base.unit is None else base.unit
        if part is None:
            alone = self._link.pkw == 0
            said = f"{base.summary}: {'request, process data' if alone else 'not readable'}"
            heard = replace(base, kind="request" if alone else "unreadable", summary=said, faults=faults)
            return DecodedFrame(heard, (data,), base.unit, request=Request(unit, 0, words=divided.words))
        asks = request_in(unit, part, self._link, divided.words)
        value = part.value(asks.width, self._link)
        element = Element(part.parameter, part.index, asks.width, value, part.values, in_request=True)
        said, details = _about(part, "task", directory)
        heard = replace(
            base,
            kind="request",
            function=part.code,
            summary=f"{base.summary}: request, {self._tasks[part.code]}{said}",
            faults=faults,
            details=details,
            findings=tuple(remarks.request_findings(self._device, part, base.unit)),
            notes=tuple(remarks.request_notes(part, self._link)),
        )
        return DecodedFrame(heard, (element, data) if part.code else (data,), base.unit, request=asks)

    def _reply(
        self, base: FrameResult, words: tuple[int, ...], asked: Request | None, status: str, directory: Directory
    ) -> DecodedFrame:
        divided = split(words, self._link, request=False)
        fault = "" if not status or status in _ANSWERS else no_answer_text(status)
        fault = fault if divided.fits else remarks.misfit_text(len(words), self._link, request=False)
        faults = (*base.faults, fault) if fault else base.faults
        part = part_of(divided.part)
        carried: tuple[Content, ...] = (ProcessData("response", divided.words),)
        if part is None:
            heard = replace(base, kind="reply", summary=f"{base.summary}: reply, process data", faults=faults)
        else:
            said, details = _about(part, "response", directory)
            summary = f"{base.summary}: reply, {self._responses[part.code]}{said}"
            heard = replace(base, kind="reply", summary=summary, faults=faults, details=details)
            if part.code in (REFUSED, NO_RIGHTS):
                heard = self._refusal(heard, part, None if asked is None else asked.task)
            carried = (self._element(part), *carried) if part.code else carried
        return DecodedFrame(heard, carried, base.unit, answers=status != "no_answer")

    def _element(self, part: Part) -> Element:
        """The element in an answer, with its value."""
        width = RESPONSE_WIDTHS.get(part.code, 0)
        value = part.value(width, self._link)
        refused, counts = part.code in (REFUSED, NO_RIGHTS), part.code == SIZE
        return Element(part.parameter, part.index, width, value, part.values, refused=refused, counts=counts)

    def _refusal(self, base: FrameResult, part: Part, task: int | None) -> FrameResult:
        """The result for an answer that refuses the request."""
        base = replace(base, kind="exception")
        if part.code == NO_RIGHTS or not part.values:
            return base
        error = part.values[0]
        return replace(
            base,
            exception=error,
            summary=f"{base.summary}: {remarks.titled_code(self._device.bus.exceptions, error, 'error')}",
            findings=tuple(remarks.error_findings(self._device, part, task)),
            notes=tuple(remarks.error_notes(part, self._link)),
        )

    def _process_data(self, base: FrameResult, words: tuple[int, ...], direction: str | None) -> DecodedFrame:
        kind = "reply" if direction == "response" else "request"
        low, high = of_bus(self._device.bus).pzd
        faults = base.faults
        if not low <= len(words) <= high:
            faults = (*faults, f"there are {low} to {high} words of process data, here are {len(words)}")
        notes = () if direction else (remarks.FROM_MASTER,)
        heard = replace(base, kind=kind, summary=f"USS: {kind}, process data", faults=faults, notes=notes)
        return DecodedFrame(heard, (ProcessData(direction or "request", words),))


def decoder_of(device: Device, options: Options) -> UssFrameDecoder:
    """The decoder for the telegrams of the device. Raises UnclearError."""
    return UssFrameDecoder(device, link_of(device, options), options.framing or "uss", said_of(options).direction)


def _about(part: Part, key: str, directory: Directory) -> tuple[str, dict[str, object]]:
    """The element of a parameter part in words, and what the part says as details."""
    if not part.code:
        return "", {key: part.code}
    points = directory.at("parameter", part.parameter, part.index)
    alone = all(point.index is None for point in points)
    details: dict[str, object] = {key: part.code, "parameter": part.parameter, "index": part.index}
    return f", {element_text(part.parameter, part.index, alone=alone)}", details


def _broadcast(base: FrameResult, words: tuple[int, ...]) -> DecodedFrame:
    """The result for a broadcast: four words of masks, then process data."""
    heard = replace(base, kind="broadcast", summary=f"{base.summary}: broadcast, no unit answers")
    if len(words) < MASKS:
        fault = f"a broadcast starts with {MASKS} words of masks, here are {len(words)}"
        return DecodedFrame(replace(heard, faults=(*heard.faults, fault)))
    return DecodedFrame(heard, (Masks(words[:MASKS]), ProcessData("request", words[MASKS:])))
