"""Decodes frames one after the other: each is read with what the frames before it have told."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from fieldscribe.conversation.decode_state import DecodeState
from fieldscribe.conversation.frame_warnings import FrameWarnings
from fieldscribe.conversation.parameters import element_items, word_items
from fieldscribe.conversation.point_formatter import PointTextCache
from fieldscribe.conversation.requests import part_of
from fieldscribe.conversation.spans import span_items
from fieldscribe.conversation.telegrams import mask_items, piece_items, process_items
from fieldscribe.families.decoded_frame import (
    CutFrame,
    Element,
    Masks,
    OpenRequests,
    Piece,
    ProcessData,
    RecentlyUsed,
    Span,
    Word,
)
from fieldscribe.families.directory import Directory
from fieldscribe.families.frame_results import Item

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence

    from fieldscribe.arithmetic.codec import Settings
    from fieldscribe.families.decoded_frame import FrameDecoder
    from fieldscribe.families.frame_results import FrameResult
    from fieldscribe.model import Device
    from fieldscribe.user_errors import Options

_SAYS: Mapping[type, Callable[[DecodeState, Any], Iterable[Item]]] = {
    Span: span_items,
    Element: element_items,
    Word: word_items,
    ProcessData: process_items,
    Masks: mask_items,
    Piece: piece_items,
    Item: lambda _hearing, item: (item,),
}
"""What a frame carries, and what puts it into items."""


def decode(device: Device, settings: Settings, texts: Sequence[str], options: Options) -> list[FrameResult]:
    """The meaning of pasted frames, in order; any bytes are safe. Raises UnclearError for text that is no frame."""
    listening = Listener(device, settings, decoder_of(device, options))
    return [*listening.requests(options), *listening.pasted(texts)]


def decoder_of(device: Device, options: Options) -> FrameDecoder:
    """The decoder for frames of the device. Raises UnclearError."""
    decoder: FrameDecoder = part_of(device, "frame_decoder").decoder_of(device, options)
    return decoder


class Listener:
    """Decodes one frame after the other."""

    def __init__(self, device: Device, settings: Settings, decoder: FrameDecoder) -> None:
        self._device = device
        self._given = dict(settings)
        self._decoder = decoder
        self._directory = Directory(device)
        self._oddities = FrameWarnings(device, self._directory)
        self._told = PointTextCache(device, self._directory)
        self._open_requests = OpenRequests()
        self._parties: RecentlyUsed[int | None, DecodeState] = RecentlyUsed()

    def _unheard(self) -> DecodeState:
        return DecodeState(self._device, self._directory, self._told, self._given, dict(self._given))

    def requests(self, options: Options) -> list[FrameResult]:
        """The requests that the following frames answer, as the options give them. Raises UnclearError."""
        return [] if options.request is None else self._each([options.request], expecting=True)

    def pasted(self, texts: Sequence[str]) -> list[FrameResult]:
        """The meaning of the frames in the texts. Raises UnclearError for a text that is no frame."""
        return self._each(texts, expecting=False)

    def _each(self, texts: Sequence[str], *, expecting: bool) -> list[FrameResult]:
        return [self.hear(frame, expecting=expecting) for frame in self._decoder.frames(texts)]

    def hear(self, frame: Any, *, expecting: bool = False) -> FrameResult:
        """The meaning of the next frame; any bytes are safe."""
        decoded = self._decoder.decode(frame, self._open_requests, self._directory, expecting=expecting)
        hearing = self._parties.of(decoded.unit, self._unheard)
        items = tuple([item for content in decoded.contents for item in _SAYS[type(content)](hearing, content)])
        self._open_requests.follow(decoded, expecting=expecting)
        notes = self._oddities.notes(decoded)
        if isinstance(frame, CutFrame):
            notes = (*notes, frame.note)
        return decoded.with_items(items, self._oddities.findings(decoded), notes)

    def expect_reply_to(self, frame: Any) -> FrameResult:
        """Treat a frame as the request that the following frames answer."""
        return self.hear(frame, expecting=True)
