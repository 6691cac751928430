"""Imported models decode as SunSpec says: a reader of its own takes random registers apart, from the model alone."""

from __future__ import annotations

import json
import os
import random
import re
import struct
from collections import Counter
from collections.abc import Iterator
from fractions import Fraction
from ipaddress import IPv6Address
from math import isfinite
from pathlib import Path
from typing import Any, NamedTuple

import pytest
from fieldscribe.arithmetic.codec import CodecError, decode, setting_of
from fieldscribe.arithmetic.texts import text_of
from fieldscribe.arithmetic.words import raw_of
from fieldscribe.cli import main
from fieldscribe.diagnostics import Report
from fieldscribe.model import Point
from fieldscribe.pipeline import load_device
from support.quick import full_but

MODELS = sorted(Path(os.environ.get("FIELDSCRIBE_SUNSPEC", Path(__file__).parent / "sunspec")).glob("model_*.json"))
REPEATS = 3
COUNTS = {"NPt": 4}
"""How many elements are compared, and what counting points are said to hold."""
_FORMATS = {"int": "hiq", "uint": "HIQ", "acc": "HIQ", "enum": "HIQ", "bitfield": "HIQ", "float": " fd"}
_NAMED = {"sunssf": "h", "count": "H"}
_BYTES = ("ipaddr", "ipv6addr")


class Field(NamedTuple):
    """A point of the model at one place; `element` has the number of its group among those that repeat."""

    path: str
    name: str
    element: tuple[int, ...]
    at: int
    facts: dict[str, Any]
    factors: dict[str, int]


def fields(
    group: dict[str, Any], at: int, path: str, element: tuple[int, ...], factors: dict[str, int]
) -> Iterator[Field]:
    """Yield the points of a group from a place on."""
    factors, offset = dict(factors), at
    for point in group.get("points", []):
        factors[point["name"]] = offset
        offset += point["size"]
    for point in group.get("points", []):
        yield Field(f"{path}.{point['name']}", point["name"], element, factors[point["name"]], point, factors)
    for inner in group.get("groups", []):
        count = inner.get("count", 1)
        for number in range(1, (COUNTS.get(count) or (count if isinstance(count, int) else 0) or REPEATS) + 1):
            which = element if count == 1 else (*element, number)
            yield from fields(inner, offset, f"{path}.{inner['name']}", which, factors)
            offset += words_of(inner)


def words_of(group: dict[str, Any]) -> int:
    """Return how many words an element of a group has; inner groups have all elements that are compared."""
    words: int = sum(point["size"] for point in group.get("points", []))
    for inner in group.get("groups", []):
        words += words_of(inner) * COUNTS.get(inner.get("count"), inner.get("count", 1))
    return words


def not_there(letters: str, bits: int) -> int:
    """Return the number that stands for no value."""
    if letters == "acc":
        return 0
    return -1 << (bits - 1) if letters in ("int", "sunssf") else (1 << bits) - 1


def expected(field: Field, words: list[int]) -> Any:
    """Return what a point holds: a value, a text, or None where the device does not have it."""
    kind, bits = field.facts["type"], 16 * field.facts["size"]
    data = struct.pack(f">{field.facts['size']}H", *words[field.at : field.at + field.facts["size"]])
    if kind == "string":
        return data.partition(b"\0")[0].decode("latin-1").rstrip(" ")
    if kind == "eui48":
        return ":".join(f"{byte:02X}" for byte in data[2:])
    if kind in _BYTES:
        return ".".join(map(str, data)) if kind == "ipaddr" else str(IPv6Address(data))
    letters = kind.rstrip("0123456789")
    code = _NAMED.get(kind) or _FORMATS[letters][{16: 0, 32: 1, 64: 2}[bits]]
    raw = struct.unpack(f">{code}", data)[0]
    if letters == "float":
        return Fraction(raw) if isfinite(raw) else None
    if raw == not_there(letters, bits):
        return None
    factor = field.facts.get("sf", 0)
    exponent = (
        struct.unpack(">h", struct.pack(">H", words[field.factors[factor]]))[0] if factor in field.factors else factor
    )
    return raw * Fraction(10) ** exponent


class Description:
    """The description of an imported model: its points by code and numbers, and their places in the model."""

    def __init__(self, path: Path, out: Path, *options: str) -> None:
        assert main(["import", "sunspec", str(path), *options, "--out", str(out)]) == 0
        device = load_device(out, Report())
        assert device is not None
        self._points = {point.name: point for point in device.points if point.untyped is None}
        self._bases = {base.name: base for base in device.bases}
        self._by_code: dict[tuple[str | None, tuple[int, ...]], Point] = {}
        for point in self._points.values():
            numbers = *map(int, re.findall(r"\.(\d+)", point.code or "")), *filter(None, (point.set, point.index))
            self._by_code[re.sub(r"\.\d+", "", point.code or ""), numbers] = point

    def point(self, code: str, element: tuple[int, ...]) -> Point | None:
        """Return the point of an element."""
        return self._by_code.get((code, element))

    def place(self, point: Point) -> tuple[int, ...]:
        """Return the addresses of a point in the model, for what the counting points hold."""
        base = self._bases[point.base or ""]
        words = base.offset + sum(factor * COUNTS["NPt"] for _, _, factor in base.counts)
        return tuple(words + address for address in point.place.addresses)

    def value(self, point: Point, words: list[int]) -> Any:
        """Return what a point holds."""
        raw = self._raw(point, words)
        if point.text is not None:
            return text_of(point.text, raw)
        others = {name: self._points[name] for name in point.scale_arguments}
        settings = {name: setting_of(other, self._raw(other, words)) for name, other in others.items()}
        try:
            return decode(point, raw, settings)
        except CodecError as error:
            assert error.status in ("special", "not_a_number"), error
            return None

    def _raw(self, point: Point, words: list[int]) -> int:
        return raw_of(point, [words[address] for address in self.place(point)])


@pytest.mark.parametrize("options", [["--count=NPt=4", f"--most={REPEATS}"], ["--most=4"]], ids=["count", "read"])
@pytest.mark.parametrize("path", full_but(MODELS[-1:], MODELS), ids=lambda path: path.stem)
def test_an_imported_model_decodes_as_the_model_says(path: Path, options: list[str], tmp_path: Path) -> None:
    model = json.loads(path.read_text("utf-8"))
    described = Description(path, tmp_path / "device.yaml", *options)
    group = model["group"]
    all_fields = [field for field in fields(group, 0, str(model["id"]), (), {}) if field.at > 1]
    names = Counter(name for name, _ in {(field.name, field.path) for field in all_fields})
    end = max(field.at + field.facts["size"] for field in all_fields)
    chosen = random.Random(path.stem)
    for _ in range(20):
        words = [chosen.choice((0, 0xFFFF, 0x8000, 0x7FC0, chosen.getrandbits(16))) for _ in range(end)]
        for field in all_fields:
            if field.facts["type"] == "sunssf":
                words[field.at] = chosen.randint(-10, 10) & 0xFFFF
        for field in all_fields:
            if field.facts["type"] == "pad":
                continue
            point = described.point(field.path, field.element) if names[field.name] > 1 else None
            point = point or described.point(field.name, field.element) or described.point(field.path, field.element)
            assert point is not None, field.path
            first = field.at + (field.facts["type"] == "eui48")
            assert described.place(point) == tuple(range(first, field.at + field.facts["size"])), field.path
            assert described.value(point, words) == expected(field, words), field.path
