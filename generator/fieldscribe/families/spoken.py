"""A frame taken apart, as each family offers it: what it is, what it carries, and how it follows those before it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Protocol

from fieldscribe.families.answers import Item

if TYPE_CHECKING:
    from collections.abc import Sequence

    from fieldscribe.families.answers import Heard
    from fieldscribe.families.directory import Directory
    from fieldscribe.model import Place, Telegram


@dataclass(frozen=True, slots=True)
class Span:
    """Consecutive addresses of a space, and the words or bits for them; None where they are only named."""

    space: str
    address: int
    count: int
    words: tuple[int, ...] | None = None
    written: bool = False
    learned: bool = False
    """Whether the device said so, so that it holds for frames to come."""


@dataclass(frozen=True, slots=True)
class Element:
    """One element of a parameter, with the words of its value; `value` is None where it is only named.

    `width` is how many words the value should have; `counts`: the value is the number of elements.
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
    """One word of a parameter, `raw` None where it is only named.

    `learned`: the device said so; `stale`: what it works out of the parameter must be read again.
    """

    address: int
    raw: int | None
    asked: bool = False
    learned: bool = False
    stale: bool = False


@dataclass(frozen=True, slots=True)
class ProcessData:
    """The words of the telegram of one direction, from its first."""

    direction: str
    words: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Masks:
    """Which words of process data count, and which bits of its first and of its fourth word."""

    words: tuple[int, ...]


class Pieces(Protocol):
    """The words of a telegram as they came, frame by frame."""

    @property
    def per_frame(self) -> int:
        """How many words one frame brings."""

    def words(self, positions: Sequence[int]) -> tuple[str, tuple[int, ...]]:
        """(ok, words), or why these are not known."""


@dataclass(frozen=True, slots=True)
class Piece:
    """Some words of a telegram that comes in several frames."""

    telegram: Telegram
    positions: range
    pieces: Pieces


Carried = Span | Element | Word | ProcessData | Masks | Piece | Item


@dataclass(frozen=True, slots=True)
class Spoken:
    """One frame, without what it says of points: that follows from what it carries.

    `party` is whose dialogue it is, `exchange` which of several that are open at once. `asks` is the request that it
    is, `silent` that nobody answers it, `answers` that it ends the open one; `binds` that the request which it is
    stays open for all frames to come.
    """

    heard: Heard
    carried: tuple[Carried, ...] = ()
    party: int | None = None
    exchange: str = ""
    asks: Any = None
    silent: bool = False
    answers: bool = False
    binds: bool = False


@dataclass(slots=True)
class Course:
    """Which requests are open, and with whom anything was spoken."""

    fixed: bool = False
    _open: dict[tuple[int | None, str], Any] = field(default_factory=dict)
    _met: set[int | None] = field(default_factory=set)

    def asked(self, party: int | None = None, exchange: str = "") -> Any:
        """The open request; None where there is none."""
        return self._open.get((party, exchange))

    def met(self, party: int | None) -> bool:
        """Whether a request to or from it was heard."""
        return party in self._met

    def follow(self, spoken: Spoken, *, expecting: bool) -> None:
        """What is open after a frame; `expecting`: the person says that the frames to come answer it."""
        key = spoken.party, spoken.exchange
        if spoken.asks is not None:
            self._met.add(spoken.party)
        if spoken.asks is not None and (expecting or not spoken.silent):
            self._open[key] = spoken.asks
        elif spoken.silent or (spoken.answers and not self.fixed):
            self._open.pop(key, None)
        if expecting:
            self.fixed = spoken.binds


class Speech(Protocol):
    """How a family takes frames apart; its part `speech` offers `speech_of(device, options)` that makes one."""

    def frames(self, texts: Sequence[str]) -> Sequence[Any]:
        """The frames that people pasted. Raises UnclearError."""

    def space_of(self, place: Place) -> str:
        """The space in which a place is reached."""

    def hear(self, frame: Any, course: Course, directory: Directory, *, expecting: bool = False) -> Spoken:
        """What a frame is; any bytes are safe."""
