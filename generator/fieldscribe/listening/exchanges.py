"""An exchange (a request with its answer) as text and JSON, and the summary of all exchanges of a capture.

Who polls what, how often and how fast it is answered, the errors, and violations of the manual. Tables have limits, so
that hostile captures do not fill the memory; further rows are counted together.
"""

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from typing import Any, NamedTuple

from fieldscribe.diagnostics import visible
from fieldscribe.families.frame_results import FrameResult, Item
from fieldscribe.listening.chunks import Cut
from fieldscribe.model import Device
from fieldscribe.text import counted
from fieldscribe.wording.numbers import spaced

_MOST_BYTES = 16
"""The most bytes of noise that are printed."""


class Content:
    """The content of a request and its answer, or of one of them; equal exchanges share it.

    `action` is what is done, in a word. A frame for a unit without a description has no device. `findings` are
    violations of the manual and numbers out of range, by point; and refusals.
    """

    __slots__ = ("_text", "action", "device", "findings", "items", "reply", "request", "summary", "unit")

    def __init__(
        self,
        unit: int | None = None,
        device: Device | None = None,
        action: str = "",
        request: FrameResult | None = None,
        reply: FrameResult | None = None,
    ) -> None:
        self.unit, self.device, self.action, self.request, self.reply = unit, device, action, request, reply
        main = request if reply is None or (request and not reply.items) else reply
        self.items: Sequence[Item] = main.items if main else ()
        self.summary = main.summary if main else ""
        """The text for frames without items."""
        self.findings: dict[str, str] = {}
        for result in (request, reply):
            if result is not None:
                self.findings.update(dict.fromkeys(result.findings, ""))
                for item in result.items:
                    if item.findings or item.doubts:
                        self.findings[item.about] = ", ".join((*item.findings, *item.doubts))
        if reply is not None and reply.refusal:
            self.findings[reply.refusal] = ""
        self._text = ""

    @property
    def text(self) -> str:
        """The unit, the action, and what was read or written, in words; escaped for a terminal."""
        if not self._text:
            unit = "" if self.unit is None else f"unit {self.unit}"
            items = ", ".join(map(item_text, self.items)) or self.summary
            self._text = visible("  ".join(filter(None, (unit, self.action, items))))
        return self._text


class Exchange(NamedTuple):
    """A request with its answer, one of them alone, or a frame that nobody answers, and its content.

    `place` is the sender of the request, if known; `took` is in seconds.
    """

    time: float | None
    place: str
    content: Content
    cuts: tuple[Cut, ...]
    faults: tuple[str, ...] = ()
    took: float | None = None

    @property
    def text(self) -> str:
        """The unit, the action, and what was read or written, in words; the bytes of foreign frames and noise."""
        text = self.content.text
        return text if self.content.action else "  ".join(filter(None, (text, spaced(self.cuts[0].data[:_MOST_BYTES]))))

    @property
    def frames(self) -> Iterator[tuple[str, FrameResult | None]]:
        """The frames in their usual notation, each with its kind."""
        results = [result for result in (self.content.request, self.content.reply) if result is not None]
        for place, cut in enumerate(self.cuts):
            text = spaced(cut.data) if isinstance(cut.frame, bytes) else cut.frame.text
            yield text, results[place] if place < len(results) else None

    def as_data(self) -> dict[str, object]:
        """Return the same for JSON."""
        content, plain = self.content, ("point", "code", "raw", "value")
        items = [{**{key: getattr(item, key) for key in plain}, "text": item_text(item)} for item in content.items]
        return {
            "time": self.time,
            "who": self.place or None,
            "unit": content.unit,
            "device": None if content.device is None else content.device.id,
            "action": content.action,
            "items": items,
            "took": self.took,
            "exception": None if content.reply is None else content.reply.exception,
            "faults": list(self.faults),
            "findings": [finding_text(*finding) for finding in content.findings.items()],
        }


def item_text(item: Item) -> str:
    """Return a point with its value, short: `output_frequency = 5 Hz`."""
    if item.meaning:
        return f"{item.point} = {item.meaning}"
    if item.bit_texts is not None and item.raw is not None:
        return f"{item.point} = {item.bit_texts.true(item.raw)}"
    if item.point is None:
        return item.summary
    if item.carries:
        return f"{item.point}: {item.carries}"
    return item.point if item.raw is None else f"{item.point} = "


def finding_text(key: str, text: str) -> str:
    """Return a finding with its subject."""
    return f"{key}: {text}" if text else key


def seconds(time: float) -> str:
    """Return a time with its unit: `4.2 ms`, `1.25 s`."""
    return f"{1000 * time:.1f} ms" if time < 1 else f"{time:.2f} s"


_MOST_ROWS = 2000
_MOST_NAMES = 4
OTHERS = "others"
_REST = ("", None, "")
"""The row for everything else once a table is full."""
_Counts = dict[tuple[str, str], list[Any]]
"""The number and the text of each kind of item, by its unit and subject."""


@dataclass(slots=True)
class Poll:
    """A request that is repeated, or a cyclic message: its number, and times in seconds; `request` is its summary."""

    who: str = ""
    unit: int | None = None
    device: str = ""
    action: str = ""
    what: str = OTHERS
    request: str = ""
    count: int = 0
    answered: int = 0
    first: float | None = None
    last: float | None = None
    took: float = 0.0
    timed: int = 0
    slowest: float = 0.0

    @property
    def every(self) -> float | None:
        """The average seconds from one to the next."""
        if self.first is None or self.last is None or self.count < 2:
            return None
        return round((self.last - self.first) / (self.count - 1), 6)

    def add(self, exchange: Exchange) -> None:
        """Count an exchange."""
        self.count += 1
        self.first = exchange.time if self.first is None else self.first
        self.last = exchange.time
        self.answered += exchange.content.reply is not None and not exchange.faults
        if exchange.took is not None:
            self.took = round(self.took + exchange.took, 6)
            self.timed += 1
            self.slowest = max(self.slowest, exchange.took)

    @property
    def subject(self) -> tuple[object, ...]:
        """What its row names."""
        return self.who, self.unit, self.action, self.what

    def row(self, *, in_full: bool) -> list[str]:
        """Return the cells of a table; `in_full` those of a row that others resemble."""
        often = "" if self.every is None else f"every {seconds(self.every)}"
        unit = "" if self.unit is None else f"unit {self.unit}"
        answers = f"in {seconds(self.took / self.timed)}, at most {seconds(self.slowest)}" if self.slowest else ""
        lost = (
            f"{self.count - self.answered} without a good answer" if self.slowest and self.answered < self.count else ""
        )
        last = ", ".join(filter(None, (answers, lost)))
        what = f"{self.what} ({self.request})" if in_full else self.what
        return [f"{self.count} x", often, self.who, unit, self.action, what, last]


class Statistics:
    """The summary of a capture."""

    def __init__(self) -> None:
        self.exchanges = 0
        self._polls: dict[tuple[str, int | None, str], Poll] = {}
        self._errors: _Counts = {}
        self._findings: _Counts = {}

    @property
    def wrong(self) -> bool:
        """True if there are errors or violations of the manual."""
        return bool(self._errors or self._findings)

    def add(self, exchange: Exchange) -> None:
        """Count an exchange."""
        self.exchanges += 1
        content = exchange.content
        if exchange.faults or content.findings:
            unit = "" if content.unit is None else f"unit {content.unit}: "
            for fault in exchange.faults:
                _count(self._errors, (unit, fault))
            for key, text in content.findings.items():
                _count(self._findings, (unit, key), text)
        polled = content.request or (None if exchange.faults else content.reply)
        if polled is not None and content.device is not None:
            place: tuple[str, int | None, str] = exchange.place, content.unit, polled.summary
            if place not in self._polls:
                full = len(self._polls) >= _MOST_ROWS
                place = _REST if full else place
                who, what = (exchange.place, content.unit, content.device.id), _what(exchange)
                new = Poll(*who, content.action, what, polled.summary)
                self._polls.setdefault(place, Poll() if full else new)
            self._polls[place].add(exchange)

    def as_data(self) -> dict[str, object]:
        """Return the same for JSON."""
        return {
            "exchanges": self.exchanges,
            "polls": [{**asdict(poll), "every": poll.every} for poll in self._sorted_polls()],
            "errors": [{"count": count, "text": text} for count, text in _sorted(self._errors)],
            "findings": [{"count": count, "text": text} for count, text in _sorted(self._findings)],
        }

    def lines(self) -> Iterator[str]:
        """Return the same as lines of text."""
        yield counted(self.exchanges, "exchange")
        if self._polls:
            yield from ("", "who asks for what, how often, and how fast it is answered:")
            subjects = Counter(poll.subject for poll in self._polls.values())
            rows = [poll.row(in_full=subjects[poll.subject] > 1) for poll in self._sorted_polls()]
            widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
            for row in rows:
                cells = [f"{cell:<{width}}" for cell, width in zip(row, widths, strict=True) if width]
                yield f"  {'  '.join(cells)}".rstrip()
        for title, table in (
            ("errors:", self._errors),
            ("refused, or against the manual (the first of each):", self._findings),
        ):
            if table:
                yield from ("", title)
                yield from (f"  {f'{count} x':>9}  {text}" for count, text in _sorted(table))

    def _sorted_polls(self) -> list[Poll]:
        return sorted(self._polls.values(), key=lambda poll: -poll.count)


def _what(exchange: Exchange) -> str:
    """Return the names of what is requested; addresses for what has no name."""
    named = [*dict.fromkeys(item.about for item in exchange.content.items)]
    more = len(named) - _MOST_NAMES
    return ", ".join(named[:_MOST_NAMES]) + (f" and {more} more" if more > 0 else "") or exchange.content.summary


def _count(table: _Counts, key: tuple[str, str], text: str = "") -> None:
    """Count an item in a table, which keeps the text of the first one of its kind."""
    if key not in table:
        key, text = (key, text) if len(table) < _MOST_ROWS else (("", OTHERS), "")
        table.setdefault(key, [0, f"{key[0]}{finding_text(key[1], text)}"])
    table[key][0] += 1


def _sorted(table: _Counts) -> list[list[Any]]:
    return sorted(table.values(), key=lambda row: -row[0])
