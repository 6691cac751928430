"""Raw numbers to values and counts and back, and whether they may be written."""

from __future__ import annotations

import math
from collections.abc import Mapping
from datetime import datetime
from typing import Any

from support.vector_file import Vector

from conformance.package import Check, Package, pattern, raws_of

_MICROSECOND = 1e-6
_MOST_SECONDS = 200e9
"""Seconds of more than six thousand years."""


def decode(package: Package, vector: Vector) -> bool:
    """A raw number to a value."""
    point = package.point(vector)
    status, value = package.outcome(point.decode, vector["raw"], raws_of(vector))
    if isinstance(value, datetime):
        seconds = (value - _form(point).epoch).total_seconds()
        return bool(vector["status"] == "ok" and abs(seconds - vector["value"]) < _MICROSECOND)
    if status == "malformed":  # Python knows no later year
        return isinstance(_form(point), package.runtime.Time) and abs(vector["value"]) > _MOST_SECONDS
    if status == "special":
        return bool(vector["status"] == status and str(value) == vector["special"] and value.raw == vector["raw"])
    return status == vector["status"] and (status != "ok" or pattern(value) == pattern(vector["value"]))


def encode(package: Package, vector: Vector) -> bool:
    """A value to a raw number."""
    status, raw = package.outcome(package.point(vector).encode, vector["value"], raws_of(vector))
    return status == vector["status"] and (status != "ok" or raw == vector["raw"])


def decode_count(package: Package, vector: Vector) -> bool:
    """A raw number to a count."""
    point, raw, raws = package.point(vector), vector["raw"], raws_of(vector)
    status, count = package.outcome(point.decode_count, raw, raws)
    if status == "special":
        named = count.special == vector["special"] == str(point.decode(raw, raws))
        return bool(vector["status"] == status and named)
    return bool(status == vector["status"] and (status != "ok" or count == vector["count"]))


def encode_count(package: Package, vector: Vector) -> bool:
    """A count to a raw number."""
    point, count, raws = package.point(vector), vector["count"], raws_of(vector)
    status, raw = package.outcome(point.encode_count, count, raws)
    return status == vector["status"] and (status != "ok" or raw == vector["raw"])


def check(package: Package, vector: Vector) -> bool:
    """Whether a raw number may be written."""
    status, _ = package.outcome(package.point(vector).check, vector["raw"], raws_of(vector))
    return bool(status == vector["status"])


def told(package: Package, vector: Vector) -> bool:
    """What people see of a raw number, and of its value as far as that is one of the point."""
    point, raw, raws = package.point(vector), vector["raw"], raws_of(vector)
    expected = vector["text"] if vector["status"] == "ok" else f"raw {raw}"
    if point.told(raw, raws) != expected:
        return False
    if vector["status"] != "ok" or not isinstance(point, package.runtime.points.Decoding):
        return True
    status, text = package.outcome(point.text, point.decode(raw, raws), raws)
    return bool(text == expected if status == "ok" else _is_only_decoded(package, point, raw))


def _is_only_decoded(package: Package, point: Any, raw: int) -> bool:
    """Whether a value is one that no point takes: of more than 53 bits, or no finite number."""
    if isinstance(getattr(point._form, "form", point._form), package.runtime.Floating):
        return not math.isfinite(point.decode(raw))
    return not getattr(point._form, "encodes", True)


def _form(point: Any) -> Any:
    """What a point means apart from special codes."""
    return point._form.form if point.special else point._form


def epoch(package: Package, vector: Vector) -> bool:
    """The date of a time, as seconds after 1970-01-01."""
    return bool(_form(package.point(vector)).epoch.timestamp() == vector["seconds"])


CHECKS: Mapping[str, Check] = {
    "decode": decode,
    "encode": encode,
    "encode_refused": encode,
    "decode_count": decode_count,
    "encode_count": encode_count,
    "check": check,
    "told": told,
    "epoch": epoch,
}
"""The checks of this theme by the kind of vector."""
