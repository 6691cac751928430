"""A decoded frame in the form that all families share: what it is, what it carries, and which request it answers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Generic, Protocol, TypeVar

from fieldscribe.families.answers import Heard, Item
from fieldscribe.records import dataclass, field

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from fieldscribe.families.answers import Captured
    from fieldscribe.families.directory import Directory
    from fieldscribe.model import Telegram


@dataclass(frozen=True, slots=True)
class Span:
    """Consecutive addresses of a space with their words or bits; `words` is None where the frame only names them."""

    space: str
    address: int
    count: int
    words: tuple[int, ...] | None = None
    written: bool = False
    learned: bool = False
    """Whether the device itself reported the values, so that later frames may rely on them."""


@dataclass(frozen=True, slots=True)
class Element:
    """One element of a parameter with its value; `value` is None where the frame only names the element.

    `width` is how many words the value should have. `counts`: the value is the number of elements.
    """

    parameter: int
    index: int
    width: int = 0
    value: int | None = None
    words: tuple[int, ...] = ()
    asked: bool = False
    refused: bool = False
    counts: bool = False


@dataclass(frozen=True, slots=True)
class Word:
    """One word of a parameter; `raw` is None where the frame only names it.

    `learned`: the device itself reported it. `stale`: values that the device derives from the parameter are outdated.
    """

    address: int
    raw: int | None
    asked: bool = False
    learned: bool = False
    stale: bool = False


@dataclass(frozen=True, slots=True)
class ProcessData:
    """The process data of one direction, from the first word on."""

    direction: str
    words: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Masks:
    """The masks of a broadcast: which words of process data are valid, and which bits of the control words."""

    words: tuple[int, ...]


class Pieces(Protocol):
    """The words received so far of a telegram that comes in several frames."""

    @property
    def per_frame(self) -> int:
        """How many words one frame carries."""

    def words(self, positions: Sequence[int]) -> tuple[str, tuple[int, ...]]:
        """("ok", words); another status and no words while they are not known."""


@dataclass(frozen=True, slots=True)
class Piece:
    """Some words of a telegram that comes in several frames: their positions, and those received so far."""

    telegram: Telegram
    positions: range
    words: tuple[int, ...]
    pieces: Pieces


Carried = Span | Element | Word | ProcessData | Masks | Piece | Item


@dataclass(frozen=True, slots=True)
class Framed:
    """What a frame has for itself: its bytes, what its checksum says, and how it was captured."""

    data: bytes
    checks: str = ""
    captured: Captured | None = None


@dataclass(frozen=True, slots=True)
class Spoken:
    """One decoded frame, before its contents are matched with points.

    `heard` may be what its head says, which many frames have alike: what is `own` to this one is apart then.
    `party` is the unit that takes part, `exchange` tells exchanges apart that are open at the same time. `asks` is the
    request, if the frame is one. `silent`: nobody answers it. `answers`: it closes the open request. `binds`: as an
    expected request it stays open for all frames that follow.
    """

    heard: Heard
    carried: tuple[Carried, ...] = ()
    party: int | None = None
    exchange: str = ""
    asks: Any = None
    silent: bool = False
    answers: bool = False
    binds: bool = False
    own: Framed | None = None

    def saying(self, items: tuple[Item, ...], findings: tuple[str, ...], notes: tuple[str, ...]) -> Heard:
        """The frame with what it says about points, and with more findings and notes."""
        head = self.heard
        own = self.own or Framed(head.data, head.checks, head.captured)
        return Heard(
            own.data, head.framing, head.kind, head.unit, head.function, head.summary, items, own.checks, head.faults,
            head.findings + findings, head.notes + notes, head.exception, head.details, own.captured,
        )  # fmt: skip


@dataclass(slots=True)
class Course:
    """Which requests are open, and which units have been addressed."""

    fixed: bool = False
    _open: dict[tuple[int | None, str], Any] = field(default_factory=dict)
    _met: set[int | None] = field(default_factory=set)

    def asked(self, party: int | None = None, exchange: str = "") -> Any:
        """The open request; None without one."""
        return self._open.get((party, exchange))

    def met(self, party: int | None) -> bool:
        """Whether this unit has been sent a request."""
        return party in self._met

    def follow(self, spoken: Spoken, *, expecting: bool) -> None:
        """Update the open requests after a frame; `expecting`: the person says that the next frames answer it."""
        key = spoken.party, spoken.exchange
        if spoken.asks is not None:
            self._met.add(spoken.party)
        if spoken.asks is not None and (expecting or not spoken.silent):
            self._open[key] = spoken.asks
        elif spoken.silent or (spoken.answers and not self.fixed):
            self._open.pop(key, None)
        if expecting:
            self.fixed = spoken.binds


class Cut(bytes):
    """A frame out of bytes that hold several; `said` tells which one it is."""

    said = ""


def cut_apart(data: bytes, sound: Callable[[bytes], int], least: int) -> list[bytes]:
    """The frames in bytes that hold several; the bytes as they are if they hold one, or none.

    `sound` gives the size of the sound frame that bytes begin with, 0 where there is none. What is left behind sound
    frames is a frame, too, if it has at least `least` bytes.
    """
    pieces: list[bytes] = []
    rest = data
    while rest and (size := sound(rest)):
        pieces, rest = [*pieces, rest[:size]], rest[size:]
    pieces += [rest] if rest else []
    if len(pieces) < 2 or 0 < len(rest) < least:
        return [data]
    begin, result = 1, []
    for number, piece in enumerate(pieces, 1):
        frame = Cut(piece)
        frame.said = f"these bytes hold {len(pieces)} frames; this is number {number}, from byte {begin} on"
        result.append(frame)
        begin += len(piece)
    return [*result]


Key = TypeVar("Key")
Kept = TypeVar("Kept")
_MOST_KEPT = 256


class Recent(Generic[Key, Kept]):
    """What is kept of each party, as long as it is one of the last to be heard: a stream may last for days."""

    def __init__(self) -> None:
        self._kept: dict[Key, Kept] = {}
        self._last: Key | None = None

    def of(self, key: Key, make: Callable[[], Kept]) -> Kept:
        """What is kept under this key, made if nothing is."""
        if key == self._last and self._kept:
            return self._kept[key]
        kept = self._kept[key] = self._kept.pop(key) if key in self._kept else make()
        self._last = key
        if len(self._kept) > _MOST_KEPT:
            del self._kept[next(iter(self._kept))]
        return kept


class Remembered(dict[Key, Kept]):
    """What was worked out under a key; all of it is forgotten when it becomes too much: a stream may last for days."""

    def __init__(self, most: int, make: Callable[[Key], Kept]) -> None:
        super().__init__()
        self._most, self._make = most, make

    def __missing__(self, key: Key) -> Kept:
        kept = self._make(key)
        if len(self) >= self._most:
            self.clear()
        self[key] = kept
        return kept


class Speech(Protocol):
    """Decodes the frames of a family; `speech_of(device, options)` of its part `speech` makes one."""

    def frames(self, texts: Sequence[str]) -> Sequence[Any]:
        """The frames that people pasted. Raises UnclearError."""

    def hear(self, frame: Any, course: Course, directory: Directory, *, expecting: bool = False) -> Spoken:
        """What a frame is; any bytes are safe."""
