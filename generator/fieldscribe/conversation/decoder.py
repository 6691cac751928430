"""Decodes frames one after the other: each with what the frames before it have brought."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import lru_cache
from typing import Any

from fieldscribe.arithmetic.codec import Settings
from fieldscribe.conversation.address_items import element_items, span_items, word_items
from fieldscribe.conversation.decode_state import DecodeState, PointTextCache
from fieldscribe.conversation.encoding import family_part
from fieldscribe.conversation.frame_warnings import FrameWarnings
from fieldscribe.conversation.telegram_items import mask_items, piece_items, process_items
from fieldscribe.families.decoded_frame import (
    MOST_STATES,
    CutFrame,
    Element,
    FrameDecoder,
    Masks,
    OpenRequests,
    Piece,
    ProcessData,
    Span,
    Word,
)
from fieldscribe.families.directory import Directory
from fieldscribe.families.frame_results import FrameResult, Item, Options
from fieldscribe.model import Device

_ITEMS: Mapping[type, Callable[[DecodeState, Any], Iterable[Item]]] = {
    Span: span_items,
    Element: element_items,
    Word: word_items,
    ProcessData: process_items,
    Masks: mask_items,
    Piece: piece_items,
    Item: lambda _state, item: (item,),
}
"""Each kind of content of a frame, and the function that makes items of it."""


def decode(device: Device, settings: Settings, texts: Sequence[str], options: Options) -> list[FrameResult]:
    """Return the meaning of pasted frames, in order; any bytes are safe. Raises UnclearError for other texts."""
    decoder = StreamDecoder(device, settings, frame_decoder(device, options))
    return [*decoder.requests(options), *decoder.pasted(texts)]


def frame_decoder(device: Device, options: Options) -> FrameDecoder:
    """Return the family's decoder for frames of the device. Raises UnclearError."""
    decoder: FrameDecoder = family_part(device, "frame_decoder").decoder_of(device, options)
    return decoder


class StreamDecoder:
    """Decodes the frames of one line in their order."""

    def __init__(self, device: Device, settings: Settings, frame_decoder: FrameDecoder) -> None:
        given, directory = dict(settings), Directory(device)
        texts = PointTextCache(device, directory)
        self._frame_decoder = frame_decoder
        self._warnings = FrameWarnings(device, directory)
        self._open_requests = OpenRequests()
        self._state_of_unit = lru_cache(MOST_STATES)(
            lambda _unit: DecodeState(device, directory, texts, given, dict(given))
        )

    def requests(self, options: Options) -> list[FrameResult]:
        """Decode the request that the following frames answer, if the options give one. Raises UnclearError."""
        if options.request is None:
            return []
        return [self.decode(frame, expecting=True) for frame in self._frame_decoder.frames([options.request])]

    def pasted(self, texts: Sequence[str]) -> list[FrameResult]:
        """Decode the frames in the texts. Raises UnclearError for a text that is no frame."""
        return [self.decode(frame) for frame in self._frame_decoder.frames(texts)]

    def decode(self, frame: Any, *, expecting: bool = False) -> FrameResult:
        """Decode the next frame; any bytes are safe. `expecting`: the following frames answer it."""
        decoded = self._frame_decoder.decode(frame, self._open_requests, expecting=expecting)
        state = self._state_of_unit(decoded.unit)
        items = tuple([item for content in decoded.contents for item in _ITEMS[type(content)](state, content)])
        self._open_requests.follow(decoded, expecting=expecting)
        notes = self._warnings.notes(decoded)
        if isinstance(frame, CutFrame):
            notes = (*notes, frame.note)
        return decoded.with_items(items, self._warnings.findings(decoded), notes)
