"""A decoded frame in the form that all families share: its kind, its contents, and the request that it answers.

A family's `frame_decoder` turns bytes into a `DecodedFrame`; `conversation` matches its contents with the points of the
device and makes a `FrameResult` of it.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple, Protocol

from fieldscribe.families.frame_results import FrameResult, Item
from fieldscribe.model import Telegram

MOST_STATES = 256
"""The most units, or telegrams of units, whose state a decoder keeps: those used last. A stream may last for days."""


@dataclass(frozen=True, slots=True)
class AddressSpan:
    """Consecutive addresses of a space with their words or bits; `words` is None if the frame only names them."""

    space: str
    address: int
    count: int
    words: tuple[int, ...] | None = None
    written: bool = False
    learned: bool = False
    """True if the device itself reported the values, so that later frames may rely on them."""


@dataclass(frozen=True, slots=True)
class Element:
    """One element of a parameter; `value` is None if the frame only names the element.

    `width` is the number of words that the value should have. `counts`: the value is the number of elements.
    """

    parameter: int
    index: int
    width: int = 0
    value: int | None = None
    words: tuple[int, ...] = ()
    in_request: bool = False
    refused: bool = False
    counts: bool = False


@dataclass(frozen=True, slots=True)
class Word:
    """One word of a parameter; `raw` is None if the frame only names it.

    `learned`: the device itself reported it. `stale`: known values that depend on the parameter are outdated.
    """

    address: int
    raw: int | None
    in_request: bool = False
    learned: bool = False
    stale: bool = False


@dataclass(frozen=True, slots=True)
class ProcessData:
    """The process data of one direction, from the first word on."""

    direction: str
    words: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Masks:
    """The masks of a broadcast: which words of process data and which bits of the control words count."""

    words: tuple[int, ...]


class Pieces(Protocol):
    """The words received so far of a telegram that comes in several frames."""

    @property
    def per_frame(self) -> int:
        """The number of words that one frame carries."""

    def words(self, positions: Sequence[int]) -> tuple[str, tuple[int, ...]]:
        """Return ("ok", words); another status and no words while they are not known."""


@dataclass(frozen=True, slots=True, eq=False)
class Layout:
    """Which words of a telegram a frame has. `pieces` is None if each frame has all words of its points."""

    telegram: Telegram
    positions: range
    pieces: Pieces | None = None


class Piece(NamedTuple):
    """The words of one frame of a telegram; frames with the same words share a layout."""

    layout: Layout
    words: tuple[int, ...]


Content = AddressSpan | Element | Word | ProcessData | Masks | Piece | Item


class DecodedFrame(NamedTuple):
    """One decoded frame, before its contents are matched with points.

    `unit` is the unit that sends or receives it; `exchange` distinguishes exchanges that are open at the same time.
    `request` is the family's own form of a request, if the frame is one. `unanswered`: nobody answers this request.
    `answers`: the frame closes the open request. `stays_open`: given as the expected request, it stays open for all
    frames that follow. `memo` is for what the conversation makes of it; only decoders that return the same object for
    the same frame give one.
    """

    result: FrameResult
    contents: tuple[Content, ...] = ()
    unit: int | None = None
    exchange: str = ""
    request: Any = None
    unanswered: bool = False
    answers: bool = False
    stays_open: bool = False
    memo: list[Any] | None = None


@dataclass(slots=True)
class OpenRequests:
    """The open requests, and the units that have been sent one. `fixed`: the user gave the request for all frames."""

    fixed: bool = False
    _open: dict[tuple[int | None, str], Any] = field(default_factory=dict)
    _addressed: set[int | None] = field(default_factory=set)

    def request(self, unit: int | None = None, exchange: str = "") -> Any:
        """Return the open request; None if there is none."""
        return self._open.get((unit, exchange))

    def clear(self) -> None:
        """Forget the requests, and who has been sent one."""
        self._open.clear()
        self._addressed.clear()

    def addressed(self, unit: int | None) -> bool:
        """Return True if this unit has been sent a request."""
        return unit in self._addressed

    def follow(self, decoded: DecodedFrame, *, expecting: bool) -> None:
        """Update the open requests after a frame; with `expecting`, the user says that the next frames answer it."""
        if decoded.request is None and not (decoded.unanswered or decoded.answers or expecting):
            return
        key = decoded.unit, decoded.exchange
        if decoded.request is not None:
            self._addressed.add(decoded.unit)
        if decoded.request is not None and (expecting or not decoded.unanswered):
            self._open[key] = decoded.request
        elif decoded.unanswered or (decoded.answers and not self.fixed):
            self._open.pop(key, None)
        if expecting:
            self.fixed = decoded.stays_open


class CutFrame(bytes):
    """A frame that was cut out of bytes with several frames; `note` gives its number and place."""

    note = ""


def split_frames(data: bytes, sound_size: Callable[[bytes], int], least: int) -> list[bytes]:
    """Cut bytes into the frames that they hold; return them whole if they hold one frame, or none.

    `sound_size` returns the size of the sound frame at the beginning of its argument, 0 if there is none. What remains
    after sound frames counts as a frame if it has at least `least` bytes.
    """
    pieces: list[bytes] = []
    rest = data
    while rest and (size := sound_size(rest)):
        pieces, rest = [*pieces, rest[:size]], rest[size:]
    pieces += [rest] if rest else []
    if len(pieces) < 2 or 0 < len(rest) < least:
        return [data]
    begin, result = 1, []
    for number, piece in enumerate(pieces, 1):
        frame = CutFrame(piece)
        frame.note = f"these bytes hold {len(pieces)} frames; this is number {number}, from byte {begin} on"
        result.append(frame)
        begin += len(piece)
    return [*result]


class FrameDecoder(Protocol):
    """Decodes the frames of a family; `decoder_of(device, options)` of its part `frame_decoder` makes one.

    It may return the same object, with a `memo`, for the same bytes after the same request, if nothing else counts.
    """

    def frames(self, texts: Sequence[str]) -> Sequence[Any]:
        """Return the frames in pasted texts. Raises UnclearError."""

    def decode(self, frame: Any, requests: OpenRequests, *, expecting: bool = False) -> DecodedFrame:
        """Decode one frame; any bytes are safe. With `expecting`, the user says that the frame is a request."""
