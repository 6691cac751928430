"""Remarks on raw numbers that are written: how they were rounded, and what of them is refused or not checked."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe import wording
from fieldscribe.arithmetic import codec
from fieldscribe.arithmetic.codec import CodecError, Settings
from fieldscribe.conversation.refusals import amount_with_unit, names_text, refusal

if TYPE_CHECKING:
    from collections.abc import Iterator
    from fractions import Fraction

    from fieldscribe.model import Device, Point


def rounding_remarks(point: Point, asked: Fraction, raw: int, settings: Settings) -> Iterator[str]:
    """Remarks on how a value was rounded that the point cannot hold exactly."""
    if point.info.floating:
        return
    got = codec.decode(point, raw, settings)
    if got != asked:
        yield f"{amount_with_unit(point, asked)} is between two raw numbers; rounded to {amount_with_unit(point, got)}"
    coarse = next((step for start, step in reversed(point.steps) if raw >= start), 1)
    if raw % coarse:
        kept = point.special(raw - raw % coarse)
        back = (
            kept.name
            if kept is not None
            else amount_with_unit(point, codec.decode(point, raw - raw % coarse, settings))
        )
        yield f"here the device keeps only raw numbers divisible by {coarse}; expect {back} back"


def written_remarks(device: Device, point: Point, raw: int, settings: Settings) -> tuple[str, str]:
    """Why the device refuses a raw number that a frame writes, and why it was not checked; empty where it is not so."""
    if not point.writable:
        return f"it is {wording.access_text(point.access)}", ""
    try:
        codec.check(point, raw, settings)
    except CodecError as error:
        if error.status != "missing":
            return refusal(device, point, _value(point, raw, settings), raw, (error, settings)).why, ""
        switches = " ".join(f"--with {name}=VALUE" for name in error.missing)
        names = names_text(device, error.missing)
        return "", f"not held against its limits, which depend on {names}: give {switches}"
    return "", ""


def _value(point: Point, raw: int, settings: Settings) -> Fraction | None:
    try:
        return codec.decode(point, raw, settings) if point.form in ("scaled", "integer", "float") else None
    except CodecError:
        return None
