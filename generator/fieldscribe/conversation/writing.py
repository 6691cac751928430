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


def range_remark(device: Device, point: Point, raw: int, settings: Settings) -> str:
    """Why the device refuses a raw number that a frame writes; empty if it accepts it."""
    if not point.writable:
        return f"it is {wording.access_text(point.access)}"
    try:
        codec.check(point, raw, settings)
    except CodecError as error:
        if error.status == "missing":
            return ""
        return refusal(device, point, _value(point, raw, settings), raw, (error, settings)).why
    return ""


def unchecked_remark(device: Device, point: Point, raw: int, settings: Settings) -> str:
    """The remark that a written number was not checked, for its limits depend on unknown points; else empty."""
    if not point.writable:
        return ""
    try:
        codec.check(point, raw, settings)
    except CodecError as error:
        if error.status == "missing":
            switches = " ".join(f"--with {name}=VALUE" for name in error.missing)
            return f"not held against its limits, which depend on {names_text(device, error.missing)}: give {switches}"
    return ""


def _value(point: Point, raw: int, settings: Settings) -> Fraction | None:
    try:
        return codec.decode(point, raw, settings) if point.form in ("scaled", "integer", "float") else None
    except CodecError:
        return None
