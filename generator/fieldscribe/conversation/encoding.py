"""Turns a typed value into a raw number. Raises RefusedError, UnclearError."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe import wording
from fieldscribe.conversation.meanings import meaning_of, raw_text
from fieldscribe.conversation.selection import absence
from fieldscribe.conversation.typed_values import encode_typed, read_value
from fieldscribe.conversation.writing import rounding_remarks
from fieldscribe.text import line
from fieldscribe.user_errors import RefusedError
from fieldscribe.wording import label

if TYPE_CHECKING:
    from fieldscribe.arithmetic.codec import Settings
    from fieldscribe.model import Device, Point


@dataclass(frozen=True, slots=True)
class Encoded:
    """A raw number to write, what it means, and remarks on how the value was changed."""

    point: str
    code: str | None
    raw: int
    pattern: int
    text: str
    notes: tuple[str, ...]
    words: int = 1

    def as_data(self) -> dict[str, object]:
        """The same for JSON."""
        return {
            "point": self.point,
            "code": self.code,
            "raw": self.raw if self.words <= 4 else None,
            "hex": f"{self.pattern:0{4 * self.words if self.words > 4 else 1}X}",
            "text": self.text,
            "notes": list(self.notes),
        }


def encode_point(device: Device, point: Point, value: str, settings: Settings, *, as_raw: bool = False) -> Encoded:
    """The raw number of a typed value, or a typed raw number itself if it may be written."""
    _refuse_unwritable(device, point)
    typed = read_value(point, value, as_raw=as_raw)
    raw = encode_typed(device, point, typed, settings)
    notes = () if typed.value is None else tuple(rounding_remarks(point, typed.value, raw, settings))
    meaning = meaning_of(device, point, raw, settings)
    text = line(f"{label(point)} = {meaning.text}: {raw_text(point, raw)}")
    width = 16 * point.words if point.text is not None else point.width
    return Encoded(point.item, point.code, raw, raw & ((1 << width) - 1), text, notes, point.words)


def _refuse_unwritable(device: Device, point: Point) -> None:
    if missing := absence(device, point):
        raise RefusedError("absent", f"{label(point)}: {missing}")
    if not point.generated:
        reason = point.reason or "the manual leaves it open"
        raise RefusedError("not_generated", line(f"{label(point)} cannot be written: {reason}"))
    if not point.writable:
        raise RefusedError("read_only", f"{label(point)} is {wording.access_text(point.access)}")
