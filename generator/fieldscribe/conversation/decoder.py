"""Decodes frames in order: each with the state of the frames before it, and with warnings."""

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import lru_cache
from typing import Any

from fieldscribe.arithmetic.codec import Settings
from fieldscribe.conversation.address_items import element_items, span_items, word_items
from fieldscribe.conversation.decode_state import DecodeState, Directory, FoundBlocks
from fieldscribe.conversation.encoding import family_part
from fieldscribe.conversation.point_items import PointFormatter
from fieldscribe.conversation.telegram_items import mask_items, piece_items, process_items
from fieldscribe.families import decoded_frame
from fieldscribe.families.frame_results import FrameResult, Item, Options
from fieldscribe.model import Device
from fieldscribe.text import line
from fieldscribe.wording import label
from fieldscribe.wording.numbers import hex_text, misprint_text

_ITEMS: Mapping[type, Callable[[DecodeState, Any], Iterable[Item]]] = {
    decoded_frame.AddressSpan: span_items,
    decoded_frame.Element: element_items,
    decoded_frame.Word: word_items,
    decoded_frame.ProcessData: process_items,
    decoded_frame.Masks: mask_items,
    decoded_frame.Piece: piece_items,
    Item: lambda _state, item: (item,),
}
"""The function that builds items for each kind of content of a frame."""

_LOGGED = re.compile(
    r".{0,200}?\bunit \d+(?:"
    r" (?:->|<-) (?:(?P<id>[0-9A-F]{1,8})[:h] )?\[?(?P<data>[0-9A-F]{2}(?:,? [0-9A-F]{2})*)\]?"
    r"(?: \(.*\)| after [0-9.]+ ms)?"
    r"|: (?:not sent: )?[a-z_]+: .*)"
)


def decode(device: Device, settings: Settings, texts: Sequence[str], options: Options) -> list[FrameResult]:
    """Return the meaning of pasted frames, in order; any bytes are safe. Raises UnclearError for other texts."""
    decoder = StreamDecoder(device, settings, frame_decoder(device, options))
    return [*decoder.requests(options), *decoder.pasted(texts)]


def frame_decoder(device: Device, options: Options) -> decoded_frame.FrameDecoder:
    """Return the family's decoder for frames of the device. Raises UnclearError."""
    decoder: decoded_frame.FrameDecoder = family_part(device, "frame_decoder").decoder_of(device, options)
    return decoder


class StreamDecoder:
    """Decodes the frames of one line in their order."""

    def __init__(
        self,
        device: Device,
        settings: Settings,
        frame_decoder: decoded_frame.FrameDecoder,
        *,
        doubting: bool = False,
    ) -> None:
        """With `doubting`, items say if their number is out of range, and which other readings are in range."""
        given, directory = dict(settings), Directory(device)
        formatters: dict[Any, PointFormatter] = {}
        self._frame_decoder, self._device = frame_decoder, device
        self._framings: Sequence[str] = device.bus.framings
        """The framings of the manual; none once a note has named them."""
        misprinted = (frame for frame in reversed(device.frames) if not frame.valid and frame.family_facts is None)
        self._misprints = {frame.printed: frame for frame in misprinted}
        self._open_requests = decoded_frame.OpenRequests()

        @lru_cache(decoded_frame.MOST_STATES)
        def state_of_unit(_unit: int | None) -> DecodeState:
            blocks = None if device.found is None else FoundBlocks(device, device.found)
            return DecodeState(device, directory, formatters, given, dict(given), doubting, blocks=blocks)

        self._state_of_unit = state_of_unit

    def requests(self, options: Options) -> list[FrameResult]:
        """Decode the request that the following frames answer, if the options give one. Raises UnclearError."""
        if options.request is None:
            return []
        return [self._pasted(frame, expecting=True) for frame in self._frame_decoder.frames([options.request])]

    def pasted(self, texts: Sequence[str]) -> list[FrameResult]:
        """Decode the frames in the texts. Raises UnclearError for a text that is not a frame."""
        frames = [frame for text in texts if (frame := logged_frame(text) if "unit " in text else text) is not None]
        return [self._pasted(frame) for frame in self._frame_decoder.frames(frames)] if frames else []

    def _pasted(self, frame: Any, *, expecting: bool = False) -> FrameResult:
        """Decode the next frame; where a text says more than bytes, the result has that."""
        result = self.decode(frame, expecting=expecting)
        return result if result.frame is frame or isinstance(frame, bytes) else result._replace(frame=frame)

    def decode(
        self, frame: Any, *, expecting: bool = False, requests: decoded_frame.OpenRequests | None = None
    ) -> FrameResult:
        """Decode the next frame; any bytes are safe. `expecting`: the following frames answer it.

        `requests` are the open requests that it may answer, if the frames of several lines are mixed. The result may be
        one that an equal frame had.
        """
        requests = requests or self._open_requests
        decoded = self._frame_decoder.decode(frame, requests, expecting=expecting)
        state = self._state_of_unit(decoded.unit if self._device.found is None else decoded.result.unit)
        requests.follow(decoded, expecting=expecting)
        completes = state.changed and state.incomplete
        memo = None if completes or isinstance(frame, decoded_frame.CutFrame) else decoded.memo
        version = state.version
        if memo and memo[0] is state:
            kept: FrameResult = memo[2]
            if memo[1] != version and state.keeps(kept.items, memo[1]):
                memo[1] = version
            if memo[1] == version:
                return kept
        for content in decoded.contents if state.blocks else ():
            if isinstance(content, decoded_frame.AddressSpan) and content.learned and not content.written:
                state.locate(content, self._device)
        items = tuple([item for content in decoded.contents for item in _ITEMS[type(content)](state, content)])
        framings = self._framings
        data = frame if isinstance(frame, bytes) else frame.data
        notes = decoded.result.notes
        if framings or decoded.request or self._misprints or data is frame:
            notes += tuple(self._warnings(decoded, data, state.directory))
        result = decoded.result._replace(notes=notes, items=items, frame=frame)
        if memo is not None and framings is self._framings:
            memo[:] = state, version, result
        return result

    def _warnings(self, decoded: decoded_frame.DecodedFrame, data: bytes, directory: Directory) -> Iterator[str]:
        """Yield what may be a mistake in a frame: its framing, an address from 1, a misprint of the manual."""
        framing = decoded.result.framing
        if self._framings and framing not in self._framings:  # once is enough: a gateway changes all frames
            known = " and ".join(self._framings)
            yield f"the manual knows only {known.upper()} frames; {framing.upper()} takes a gateway"
            self._framings = ()
        for content in decoded.contents if decoded.request else ():
            if isinstance(content, decoded_frame.AddressSpan):
                yield from _off_by_one(directory, content)
        misprint = self._misprints.get(data)
        if misprint is not None:
            yield misprint_text(misprint)
        if isinstance(data, decoded_frame.CutFrame):
            yield data.note


def logged_frame(text: str) -> str | None:
    """Return the frame in a line that our packages log; None for a failure; any other text unchanged."""
    match = _LOGGED.fullmatch(text.strip())
    if match is None:
        return text
    return match["id"] + "#" + re.sub(", *| ", "", match["data"]) if match["id"] else match["data"]


def _off_by_one(directory: Directory, span: decoded_frame.AddressSpan) -> Iterator[str]:
    """Return a note if a point starts one below the address and none at it: probably a Modicon number (from 1)."""
    if span.address == 0 or directory.starting_at(span.space, span.address):
        return
    for point, place in directory.starting_at(span.space, span.address - 1):
        if len(place.addresses) > span.count:
            continue
        keys = [key for key, number in place.references.items() if number == span.address]
        named = f"{span.address} is its {line(keys[0]).capitalize()} number; " if keys else ""
        below = hex_text(span.address - 1)
        yield (
            f"no point starts at {hex_text(span.address)}, but one less, {below}, is {label(point)}: {named}on "
            "the wire addresses count from 0, so this frame may be one too high"
        )
