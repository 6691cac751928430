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
from fieldscribe.families.answers import Item
from fieldscribe.families.directory import Directory
from fieldscribe.families.spoken import Course, Cut, Element, Masks, Piece, ProcessData, Recent, Span, Word

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence

    from fieldscribe.arithmetic.codec import Settings
    from fieldscribe.asked import Options
    from fieldscribe.families.answers import Heard
    from fieldscribe.families.spoken import Speech
    from fieldscribe.model import Device

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


def decode(device: Device, settings: Settings, texts: Sequence[str], options: Options) -> list[Heard]:
    """The meaning of pasted frames, in order; any bytes are safe. Raises UnclearError for text that is no frame."""
    listening = Listener(device, settings, speech_of(device, options))
    return [*listening.requests(options), *listening.pasted(texts)]


def speech_of(device: Device, options: Options) -> Speech:
    """The decoder for frames of the device. Raises UnclearError."""
    speech: Speech = part_of(device, "speech").speech_of(device, options)
    return speech


class Listener:
    """Decodes one frame after the other."""

    def __init__(self, device: Device, settings: Settings, speech: Speech) -> None:
        self._device = device
        self._given = dict(settings)
        self._speech = speech
        self._directory = Directory(device)
        self._oddities = FrameWarnings(device, self._directory)
        self._told = PointTextCache(device, self._directory)
        self._course = Course()
        self._parties: Recent[int | None, DecodeState] = Recent()

    def _unheard(self) -> DecodeState:
        return DecodeState(self._device, self._directory, self._told, self._given, dict(self._given))

    def requests(self, options: Options) -> list[Heard]:
        """The requests that the following frames answer, as the options give them. Raises UnclearError."""
        return [] if options.request is None else self._each([options.request], expecting=True)

    def pasted(self, texts: Sequence[str]) -> list[Heard]:
        """The meaning of the frames in the texts. Raises UnclearError for a text that is no frame."""
        return self._each(texts, expecting=False)

    def _each(self, texts: Sequence[str], *, expecting: bool) -> list[Heard]:
        return [self.hear(frame, expecting=expecting) for frame in self._speech.frames(texts)]

    def hear(self, frame: Any, *, expecting: bool = False) -> Heard:
        """The meaning of the next frame; any bytes are safe."""
        spoken = self._speech.hear(frame, self._course, self._directory, expecting=expecting)
        hearing = self._parties.of(spoken.party, self._unheard)
        items = tuple([item for carried in spoken.carried for item in _SAYS[type(carried)](hearing, carried)])
        self._course.follow(spoken, expecting=expecting)
        notes = self._oddities.notes(spoken)
        if isinstance(frame, Cut):
            notes = (*notes, frame.said)
        return spoken.saying(items, self._oddities.findings(spoken), notes)

    def expect_reply_to(self, frame: Any) -> Heard:
        """Treat a frame as the request that the following frames answer."""
        return self.hear(frame, expecting=True)
