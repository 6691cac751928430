"""Turns a typed value into a raw number, and a raw number into the frames that write it."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from fieldscribe import wording
from fieldscribe.arithmetic import codec
from fieldscribe.arithmetic.codec import Settings
from fieldscribe.conversation.meanings import Meanings, raw_form
from fieldscribe.conversation.refusals import amount_with_unit
from fieldscribe.conversation.selection import absence
from fieldscribe.conversation.typed_values import encode_typed, read_value
from fieldscribe.families import family
from fieldscribe.families.frame_results import BuiltFrames, Options
from fieldscribe.model import Device, Point
from fieldscribe.text import line
from fieldscribe.user_errors import RefusedError, UnclearError
from fieldscribe.wording import label


@dataclass(frozen=True, slots=True)
class Encoded:
    """A raw number to write, its meaning, and notes on how the value was rounded."""

    point: str
    code: str | None
    raw: int
    pattern: int
    text: str
    notes: tuple[str, ...]
    words: int = 1

    def as_data(self) -> dict[str, object]:
        """Return the same for JSON."""
        return {
            "point": self.point,
            "code": self.code,
            "raw": self.raw if self.words <= 4 else None,
            "hex": f"{self.pattern:0{4 * self.words if self.words > 4 else 1}X}",
            "text": self.text,
            "notes": list(self.notes),
        }


def encode_point(device: Device, point: Point, value: str, settings: Settings, *, as_raw: bool = False) -> Encoded:
    """Return the raw number of a typed value, or of a typed raw number. Raises RefusedError, UnclearError."""
    if missing := absence(device, point):
        raise RefusedError("absent", f"{label(point)}: {missing}")
    if not point.generated:
        reason = point.reason or "the manual leaves it open"
        raise RefusedError("not_generated", line(f"{label(point)} cannot be encoded: {reason}"))
    typed = read_value(point, value, as_raw=as_raw)
    raw = encode_typed(device, point, typed, settings)
    notes = () if typed.value is None else tuple(_rounding_notes(point, typed.value, raw, settings))
    text = line(f"{label(point)} = {Meanings(device, point).text(raw, settings)}: {raw_form(point)(raw)}")
    width = 16 * point.words if point.text is not None else point.width
    return Encoded(point.item, point.code, raw, raw & ((1 << width) - 1), text, notes, point.words)


def frames_for(device: Device, point: Point, raw: int, settings: Settings, options: Options) -> BuiltFrames:
    """Return the frames that write a raw number, after those that select the point.

    Raises RefusedError, UnclearError.
    """
    require_writable(point)
    build = family_part(device, "frame_builder").frames_for
    before = [
        frame
        for name, held in point.selects
        for other in device.points
        if other.name == name
        for frame in build(device, other, held, settings, options).frames
    ]
    frames: BuiltFrames = build(device, point, raw, settings, options)
    if point.write_with:
        frames = replace(
            frames, notes=(*frames.notes, f"the device wants it in one request with {', '.join(point.write_with)}")
        )
    return replace(frames, frames=(*before, *frames.frames)) if before else frames


def family_part(device: Device, name: str) -> Any:
    """Return a part of the device's family, such as `frame_builder`. Raises UnclearError if it has none."""
    part = family(device.family).part(name)
    if part is None:
        message = f"frames of the family {device.family} are not known here"
        raise UnclearError(message, "ask for raw numbers, without frames")
    return part


def require_writable(point: Point) -> None:
    """Raise RefusedError for a point that is only read."""
    if not point.writable:
        raise RefusedError("read_only", f"{label(point)} is {wording.access_text(point.access)}")


def _rounding_notes(point: Point, value: Fraction, raw: int, settings: Settings) -> Iterator[str]:
    """Return notes on the rounding of a value that the point cannot hold exactly."""
    if point.info.floating:
        return
    rounded = codec.decode(point, raw, settings)
    if rounded != value:
        texts = amount_with_unit(point, value), amount_with_unit(point, rounded)
        yield f"{texts[0]} is between two raw numbers; rounded to {texts[1]}"
    coarse = next((step for start, step in reversed(point.steps) if raw >= start), 1)
    if raw % coarse:
        kept = raw - raw % coarse
        special = point.special(kept)
        back = special.name if special else amount_with_unit(point, codec.decode(point, kept, settings))
        yield f"here the device keeps only raw numbers divisible by {coarse}; expect {back} back"
