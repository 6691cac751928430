"""An exchange (a request with its answer) in words and for JSON; and what all exchanges of a capture amount to.

Who polls what, how often and how fast it is answered, which errors there are, and what is against the manual. Tables
have limits, so that hostile captures do not fill the memory; what no longer fits is counted together.
"""

from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from functools import cached_property

from fieldscribe.families.frame_results import FrameResult, Item
from fieldscribe.listening.chunks import Cut
from fieldscribe.model import Device
from fieldscribe.text import counted
from fieldscribe.wording.frames import spaced

_MOST_BYTES = 16
"""How many bytes of what is no frame are printed."""


@dataclass
class Exchange:
    """A request with its answer, one of them alone, or a frame that nobody answers.

    `place` is who asks, where that is known; `action` what is done, in a word; `took` is in seconds. A frame for a unit
    without a description has no device.
    """

    time: float | None
    place: str
    unit: int | None
    device: Device | None
    action: str
    request: FrameResult | None
    reply: FrameResult | None
    cuts: tuple[Cut, ...]
    faults: tuple[str, ...] = ()
    took: float | None = None

    @property
    def main(self) -> FrameResult | None:
        """The frame that says most."""
        return self.request if self.reply is None or (self.request and not self.reply.items) else self.reply

    @property
    def items(self) -> Sequence[Item]:
        """What was read or written."""
        return self.main.items if self.main else ()

    @property
    def remark(self) -> str:
        """What is said of frames without items; the bytes of those that are foreign, or none."""
        return self.main.summary if self.main else spaced(self.cuts[0].data[:_MOST_BYTES])

    @cached_property
    def findings(self) -> dict[str, str]:
        """What is against the manual and which numbers are outside their range, by point; and what was refused."""
        found: dict[str, str] = {}
        for result in (self.request, self.reply):
            if result is not None:
                found.update(dict.fromkeys(result.findings, ""))
                for item in result.items:
                    if item.findings or item.doubts:
                        found[item.about] = ", ".join((*item.findings, *item.doubts))
        if self.reply is not None and self.reply.refusal:
            found[self.reply.refusal] = ""
        return found

    @property
    def frames(self) -> Iterator[tuple[str, FrameResult | None]]:
        """The frames in the notation of their users, each with what it is."""
        results = [result for result in (self.request, self.reply) if result is not None]
        for place, cut in enumerate(self.cuts):
            result = results[place] if place < len(results) else None
            captured = None if result is None else result.captured
            yield spaced(cut.data) if captured is None else captured.text, result

    def as_data(self) -> dict[str, object]:
        """Return the same for JSON."""
        plain = ("point", "code", "raw", "value")
        items = [{**{key: getattr(item, key) for key in plain}, "text": item_text(item)} for item in self.items]
        return {
            "time": self.time,
            "who": self.place or None,
            "unit": self.unit,
            "device": None if self.device is None else self.device.id,
            "action": self.action,
            "items": items,
            "took": self.took,
            "exception": None if self.reply is None else self.reply.exception,
            "faults": list(self.faults),
            "findings": [finding_text(*finding) for finding in self.findings.items()],
        }


def item_text(item: Item) -> str:
    """Return a point with its value, short: `output_frequency = 5 Hz`."""
    if item.bit_texts is not None and item.raw is not None:
        return f"{item.point} = {item.bit_texts.true(item.raw)}"
    if item.point is None:
        return item.summary
    if item.carries:
        return f"{item.point}: {item.carries}"
    return f"{item.point} = {item.meaning}" if item.meaning or item.raw is not None else item.point


def finding_text(key: str, text: str) -> str:
    """Return a finding with what it is about."""
    return f"{key}: {text}" if text else key


def seconds(time: float) -> str:
    """Return a time as people read it: `4.2 ms`, `1.25 s`."""
    return f"{1000 * time:.1f} ms" if time < 1 else f"{time:.2f} s"


_MOST_ROWS = 2000
_MOST_NAMES = 4
OTHERS = "others"
_REST = ("", None, "")
"""What counts together once a table is full."""


@dataclass(slots=True)
class Poll:
    """One thing that is asked again and again, or sent cyclically: how often, and in seconds when and how slowly."""

    who: str = ""
    unit: int | None = None
    device: str = ""
    action: str = ""
    what: str = OTHERS
    count: int = 0
    answered: int = 0
    first: float | None = None
    last: float | None = None
    took: float = 0.0
    timed: int = 0
    slowest: float = 0.0

    @property
    def every(self) -> float | None:
        """The seconds from one to the next, on average."""
        if self.first is None or self.last is None or self.count < 2:
            return None
        return round((self.last - self.first) / (self.count - 1), 6)

    def add(self, exchange: Exchange) -> None:
        """Count an exchange."""
        self.count += 1
        self.first = exchange.time if self.first is None else self.first
        self.last = exchange.time
        self.answered += exchange.reply is not None and not exchange.faults
        if exchange.took is not None:
            self.took = round(self.took + exchange.took, 6)
            self.timed += 1
            self.slowest = max(self.slowest, exchange.took)

    def row(self) -> list[str]:
        """Return the cells of a table."""
        often = "" if self.every is None else f"every {seconds(self.every)}"
        unit = "" if self.unit is None else f"unit {self.unit}"
        answers = f"in {seconds(self.took / self.timed)}, at most {seconds(self.slowest)}" if self.slowest else ""
        lost = (
            f"{self.count - self.answered} without a good answer" if self.slowest and self.answered < self.count else ""
        )
        last = ", ".join(filter(None, (answers, lost)))
        return [f"{self.count} x", often, self.who, unit, self.action, self.what, last]


class Statistics:
    """What a whole capture amounts to."""

    def __init__(self) -> None:
        self.exchanges = 0
        self._polls: dict[tuple[str, int | None, str], Poll] = {}
        self._errors: dict[tuple[str, str], tuple[int, str]] = {}
        self._findings: dict[tuple[str, str], tuple[int, str]] = {}

    @property
    def wrong(self) -> bool:
        """True if there are errors, or something is against the manual."""
        return bool(self._errors or self._findings)

    def add(self, exchange: Exchange) -> None:
        """Count an exchange."""
        self.exchanges += 1
        unit = "" if exchange.unit is None else f"unit {exchange.unit}: "
        for fault in exchange.faults:
            _count(self._errors, (unit, fault), fault)
        for key, text in exchange.findings.items():
            _count(self._findings, (unit, key), finding_text(key, text))
        asked = exchange.request or (None if exchange.faults else exchange.reply)
        if asked is not None and exchange.device is not None:
            place: tuple[str, int | None, str] = exchange.place, exchange.unit, asked.summary
            if place not in self._polls:
                full = len(self._polls) >= _MOST_ROWS
                place = _REST if full else place
                new = Poll(exchange.place, exchange.unit, exchange.device.id, exchange.action, _what(exchange))
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
            rows = [poll.row() for poll in self._sorted_polls()]
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
    """Return the names of what is asked for; addresses where there is no name."""
    named = [*dict.fromkeys(item.about for item in exchange.items)]
    more = len(named) - _MOST_NAMES
    return ", ".join(named[:_MOST_NAMES]) + (f" and {more} more" if more > 0 else "") or exchange.remark


def _count(table: dict[tuple[str, str], tuple[int, str]], key: tuple[str, str], text: str) -> None:
    """Count something in a table, which keeps the text of the first of its kind."""
    if key not in table and len(table) >= _MOST_ROWS:
        key, text = ("", OTHERS), OTHERS
    count, first = table.get(key, (0, f"{key[0]}{text}"))
    table[key] = count + 1, first


def _sorted(table: dict[tuple[str, str], tuple[int, str]]) -> list[tuple[int, str]]:
    return sorted(table.values(), key=lambda row: -row[0])
