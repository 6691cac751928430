"""The input and output of frame commands: options, decoded frames, and the frames that write a point."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields
from types import MappingProxyType
from typing import Any, NamedTuple, Protocol

from fieldscribe.diagnostics import RefusedError
from fieldscribe.model import Bus, Point
from fieldscribe.wording import label
from fieldscribe.wording.numbers import units_text


@dataclass(frozen=True, slots=True)
class Options:
    """The options for frames, None if not given; `of_family` has those of single families, by name."""

    framing: str | None = None
    unit: int | None = None
    request: str | None = None
    index: int | None = None
    of_family: Mapping[str, Any] = field(default_factory=lambda: MappingProxyType({}))


@dataclass(frozen=True, slots=True)
class Bits:
    """The meaning of some bits of a word: `raw` is their number; `true` says whether the name of a single bit applies.

    `name` is None for a set bit that the manual does not name. `text` is the meaning of the number.
    `row` is the label and the text of these bits in a table.
    """

    high: int
    low: int
    name: str | None
    raw: int
    true: bool | None
    text: str
    row: tuple[str, str]

    def as_data(self) -> dict[str, object]:
        """Return the same for JSON."""
        meaning = {"name": self.name, "raw": self.raw, "true": self.true, "text": self.text}
        return {"bits": [self.high, self.low], **meaning}


def bits_label(high: int, low: int) -> str:
    """Return the label of a row about bits: `Bit 3`, `Bits 7..6`."""
    return f"Bit {low}" if high == low else f"Bits {high}..{low}"


class BitTexts(Protocol):
    """Explains the bits of a word."""

    def bits(self, raw: int) -> list[Bits]:
        """Return each flag, and each set bit that the manual does not name."""

    def lines(self, raw: int, row: Callable[[str, str], str]) -> list[str]:
        """Return the same as texts of one or more rows; `row` makes one of a label and a text."""

    def sentence(self, raw: int) -> str:
        """Return the same in one sentence."""

    def true(self, raw: int) -> str:
        """Return only the flags that apply."""


@dataclass
class Item:
    """The content of a frame at one address: a point with its value, a part of a point, a command, or nothing known.

    `summary` is a printable line with everything but the flags of a word, which `bit_texts` explains. `missing` names
    the points whose raw numbers are needed to compute the value. `findings` say what the device refuses, or that the
    address is in a gap; `summary` repeats them. `meaning` is the value with its unit, or a name. `doubts`, on request,
    say that the number lies outside its range, and which other readings are within it. `carries` is a statement about a
    point whose whole number is not in the frame. `subject` is the subject of an item that is not a point.
    """

    space: str
    address: int
    count: int
    statement: str
    point: str | None = None
    code: str | None = None
    raw: int | None = None
    value: str | None = None
    missing: tuple[str, ...] = ()
    findings: tuple[str, ...] = ()
    bit_texts: BitTexts | None = None
    meaning: str = ""
    doubts: tuple[str, ...] = ()
    carries: str = ""
    subject: str = ""
    rests_on: tuple[str, ...] = ()
    """The points whose numbers, from this frame or others, change what it says, or which it tells others."""

    def but(self, **changes: Any) -> Item:
        """Return the same, except for these facts."""
        facts = {fact.name: getattr(self, fact.name) for fact in fields(Item) if fact.name != "statement"}
        return Item(**{"statement": self.summary, **facts, **changes})

    @property
    def summary(self) -> str:
        """The statement; some items make it only when somebody asks."""
        return self.statement

    @property
    def about(self) -> str:
        """The point, or the other subject."""
        return self.point or self.subject

    @property
    def text(self) -> str:
        """The summary with the flags."""
        if self.bit_texts is None or self.raw is None:
            return self.summary
        return f"{self.summary}; {self.bit_texts.sentence(self.raw)}"

    @property
    def flags(self) -> list[Bits]:
        """The flags of the word, one by one."""
        return [] if self.bit_texts is None or self.raw is None else self.bit_texts.bits(self.raw)

    def as_data(self) -> dict[str, object]:
        """Return the same for JSON."""
        plain = ("space", "address", "count", "point", "code", "raw", "value")
        return {
            **{key: getattr(self, key) for key in plain},
            "flags": [bits.as_data() for bits in self.flags],
            "missing": list(self.missing),
            "findings": list(self.findings),
            "text": self.text,
            **({"doubts": list(self.doubts)} if self.doubts else {}),
        }


class Captured(Protocol):
    """A frame as it was captured from a bus where that is more than bytes."""

    @property
    def data(self) -> bytes:
        """The bytes that it carries."""

    @property
    def text(self) -> str:
        """The frame in the notation of its users."""

    @property
    def details(self) -> Mapping[str, object]:
        """When and where it was captured, for JSON."""


class FrameResult(NamedTuple):
    """One frame in words.

    `kind`: request, reply, request_or_reply, exception, cyclic, broadcast, other (not of this device), unreadable.
    `faults` say what is damaged in the frame; `findings` say where an undamaged frame contradicts the manual; `notes`
    are other remarks. `details` are further facts of the family for JSON. `refusal` says how the device refuses a
    request, in one line. A family leaves out the last two: the items of its contents, and `frame`, what was decoded.
    """

    framing: str
    kind: str
    unit: int | None
    function: int | None
    summary: str
    checks: str = ""
    faults: tuple[str, ...] = ()
    findings: tuple[str, ...] = ()
    exception: int | None = None
    details: Mapping[str, object] = MappingProxyType({})
    refusal: str = ""
    notes: tuple[str, ...] = ()
    items: tuple[Item, ...] = ()
    frame: bytes | Captured = b""

    def as_data(self) -> dict[str, object]:
        """Return the same for JSON."""
        return {
            "bytes": (self.frame if isinstance(self.frame, bytes) else self.frame.data).hex(" ").upper(),
            "framing": self.framing,
            "kind": self.kind,
            "unit": self.unit,
            "function": self.function,
            "exception": self.exception,
            **self.details,
            **({} if isinstance(self.frame, bytes) else self.frame.details),
            "summary": self.summary,
            "items": [item.as_data() for item in self.items],
            "checks": self.checks,
            "faults": list(self.faults),
            "findings": list(self.findings),
            "notes": list(self.notes),
        }

    @property
    def wrong(self) -> bool:
        """True if the frame has a fault or a finding."""
        return bool(self.faults or self.findings or any(item.findings for item in self.items))


@dataclass(frozen=True, slots=True)
class BuiltFrames:
    """The frames that write a point, in the notation of their users, and remarks about them."""

    frames: tuple[str, ...]
    notes: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class WriteMethod:
    """How a point is written: in words (`how`), and as example frames.

    `example` returns the frames for a raw number, or an empty text if none can be built. `joint` is the text between
    the words and the example.
    """

    how: str
    example: Callable[[int], str] | None = None
    joint: str = "; "


_WHY = {
    "bad_framing": "the device does not speak this framing",
    "bad_unit": "the device cannot have this unit number",
    "bad_function": "the device allows no function that writes it",
    "bad_count": "it has more words than the device takes in one request",
    "bad_address": "it lies beyond the last address",
    "bad_link": "the device knows no such link",
    "bad_task": "over this link there is no task that writes it",
    "bad_parameter": "its number cannot be sent",
    "bad_index": "its index cannot be sent",
    "bad_value": "its value does not fit into the parameter part of this link",
    "no_message": "the manual gives no message that writes it",
}


def refused(bus: Bus, point: Point, status: str, hint: str = "") -> RefusedError:
    """Return the error for a point that no frame can write, with the reason."""
    hint = hint or (units_text(bus) if status == "bad_unit" else "")
    return RefusedError(status, f"{label(point)}: {_WHY.get(status, status)}", hint)
