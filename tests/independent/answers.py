"""What a point of a description has to answer: where it is, which raw numbers it takes, what they mean."""

from __future__ import annotations

import re
import struct
from collections.abc import Mapping
from fractions import Fraction
from functools import cached_property
from math import isfinite
from typing import Any

from independent.arithmetic import evaluate, is_number, line_of, nearest, number
from independent.reader import NOTHING, Description, Row

YES = ("yes", "true")

Settings = dict[str, int]
"""Raw numbers of other points, by item."""

_BIT_SPACES = ("coil", "discrete")
_BYTES = {"ipv4": 4, "ipv6": 16, "eui48": 6, "eui64": 8}
"""How many bytes a notation has; of others two a word."""


class UnknownError(Exception):
    """This reader does not work that out."""


def _width_of(kind: str) -> int:
    """How many bits a type has; of a text or bytes, one word."""
    return {"bit": 1, "text": 16, "bytes": 16}.get(kind) or int(kind[1:])


def _length_of(parts: list[str] | dict[str, str], held: int) -> int:
    """How many bytes the parts of a date take: one each in a list, else those of the words that are named."""
    if isinstance(parts, list):
        return len(parts)
    return held * max(int((re.findall(r"word (\d+)", place) or ["1"])[0]) for place in parts.values())


class Point:
    """One point, as its row says it."""

    def __init__(self, description: Description, row: Row) -> None:
        self.device = description
        self.row = row
        self.item: str = row["item"]
        self.type: str = row.get("type", "bit" if row.get("space") in _BIT_SPACES else "u16")
        if "parts" in row:
            self.type = "bytes"
        self.has_bytes = self.type in ("text", "bytes")

    @cached_property
    def settled(self) -> bool:
        """Whether address, type and scale are known and the point can be reached at all."""
        unsettled = any(self.row.get(key) in NOTHING for key in ("at", "type", "scale") if key in self.row)
        unsettled = unsettled or "untyped" in self.row
        closed = self.row.get("access") == "none" or self.row.get("reserved") in YES
        return "at" in self.row and not unsettled and not closed

    def is_beyond(self, kind: str) -> bool:
        """Whether this reader knows nothing of it: places of CAN signals, meanings of coded numbers."""
        places = ("address", "place", "words", "write_address")
        return self.row.get("space") == "signal" if kind in places else "coding" in self.row

    @cached_property
    def bits(self) -> tuple[int, int] | None:
        """The highest and the lowest bit of a group inside its word."""
        if "bits" not in self.row:
            return None
        return self._numbered(self.row["bits"])

    def _numbered(self, key: str) -> tuple[int, int]:
        """The highest and the lowest bit of a key, counted from 0 at the lowest, however the row counts them."""
        said = self.row.get("bit_numbers", "")
        first, _, last = key.partition("..")
        one, other = (number(end) - said.startswith("from 1") for end in (first, last or first))
        if said.endswith("at the top"):
            one, other = (_width_of(self.type) - 1 - bit for bit in (one, other))
        return max(one, other), min(one, other)

    @cached_property
    def width(self) -> int:
        """How many bits the raw number has."""
        return self.bits[0] - self.bits[1] + 1 if self.bits else _width_of(self.type)

    @cached_property
    def outer(self) -> tuple[int, int]:
        """What the bits can hold."""
        if self.type.startswith("s"):
            return -(1 << self.width - 1), (1 << self.width - 1) - 1
        return 0, (1 << self.width) - 1

    @cached_property
    def addresses(self) -> list[int]:
        """All words, the one with the high part or the first characters first."""
        if isinstance(self.row["at"], list):
            return [number(each) for each in self.row["at"]]
        first, _, last = self.row["at"].partition("..")
        if last:
            start, end = number(first), number(last)
            return list(range(start, end + 1)) if start <= end else list(range(start, end - 1, -1))
        two = self.row.get("per_word") != "1" and self.row.get("encoding") != "utf-16"
        held = (2 if two else 1) if self.has_bytes else 16
        size = self.row["characters"] if self.type == "text" else _width_of(self.type)
        if self.type == "bytes":
            size = _BYTES.get(self.row.get("notation", "hex")) or 2 * int(self.row.get("length", 1))
        if "parts" in self.row:
            size = max(int(size), _length_of(self.row["parts"], held))
        count = -(-int(size) // held)
        if self.device.family == "uss" and self.row["space"] == "parameter":
            return [number(first)]
        ascending = list(range(number(first), number(first) + count))
        return ascending[::-1] if self._order == "low first" else ascending

    @property
    def _order(self) -> str:
        return str(self.row.get("words", self._shared(self.device.words)))

    def _shared(self, orders: Any) -> str:
        """What the bus says of the type."""
        wider = f"{self.type[0]}{next((width for width in (16, 32, 64) if width >= _width_of(self.type)), 0)}"
        return str(orders.get(wider, "high first") if isinstance(orders, dict) else orders)

    def on_the_wire(self, raw: int, count: int) -> list[int]:
        """The words of a raw number, the high one first."""
        coding, bits = self.row.get("coding"), raw & (1 << 16 * count) - 1
        if coding == "bcd":
            bits = int(str(raw), 16) if len(str(raw)) <= self.width // 4 else raw
        elif coding:
            bits = (1 << self.width - 1) | -raw if raw < 0 else raw
        whole = [bits >> 16 * (count - 1 - place) & 0xFFFF for place in range(count)]
        swapped = self.row.get("bytes", self._shared(self.device.bytes)) == "low first"
        return [(word & 0xFF) << 8 | word >> 8 for word in whole] if swapped else whole

    @cached_property
    def references(self) -> dict[str, int]:
        """What the group's `numbering` makes of the address on the wire."""
        found: dict[str, Fraction] = {"wire": Fraction(self.addresses[0] if self.has_bytes else min(self.addresses))}
        for key, rule in self.row.get("numbering", {}).items():
            found[key] = evaluate(rule, lambda name, _: found[name])
        return {key: int(exact) for key, exact in found.items() if key != "wire"}

    # ---- names ----

    @cached_property
    def entries(self) -> dict[int, str]:
        """The names of numbers, of a digit where the point is digits."""
        if self.type in ("f32", "f64") and "enum" in self.row:
            form = ">f" if self.type == "f32" else ">d"
            rows: Row = self.row["enum"]
            return {int.from_bytes(struct.pack(form, float(key)), "big"): _name(entry) for key, entry in rows.items()}
        return self.device_entries(self.row.get("enum") or self.row.get("digits", {}).get("enum", {}))

    def device_entries(self, enum: Row | str) -> dict[int, str]:
        """The names of an enum, given in place or by its name."""
        rows: Row = self.device.enums[enum] if isinstance(enum, str) else enum
        pairs = (
            (number(key), entry if isinstance(entry, str) else entry["name"])
            for key, entry in rows.items()
            if is_number(key)
        )
        return dict(pairs)

    @cached_property
    def flags(self) -> dict[str, tuple[int, int, int, dict[int, str]]]:
        """Of each flag: lowest bit, width, the value that means its name, names of its numbers."""
        found = {}
        for key, entry in self.row.get("flags", {}).items():
            high, low = self._numbered(key)
            lowest = low - (self.bits[1] if self.bits else 0)
            facts = {} if isinstance(entry, str) else entry
            values = self.device_entries(facts["values"]) if "values" in facts else {}
            found[_name(entry)] = (lowest, high - low + 1, int(facts.get("active", 1)), values)
        return found

    # ---- raw and value ----

    def line(self, settings: Settings, points: Mapping[str, Point]) -> tuple[Fraction, Fraction]:
        """Slope and start of raw = slope * value + start."""
        rule = self.row.get("scale", "raw = value")
        if isinstance(rule, list):
            rule = self._case(rule, settings, points)
        left, _, right = rule.partition("=")

        def named(name: str, part: str) -> Fraction:
            return _of_point(_found(points, name), part, settings, points)

        if left.strip() == "raw":
            return line_of(right, "value", named)
        slope, start = line_of(right, "raw", named)
        return 1 / slope, -start / slope

    def _case(self, cases: list[Row], settings: Settings, points: Mapping[str, Point]) -> str:
        for case in cases:
            name, _, wanted = case["when"].partition("==")
            if settings[_found(points, name.strip()).row["name"]] == number(wanted):
                rule: str = case["rule"]
                return rule
        raise UnknownError("no case holds")

    def intervals(self, settings: Settings, points: Mapping[str, Point]) -> list[tuple[int, int]]:
        """The raw numbers that may be written, as pairs of ends."""
        if "range" in self.row:
            return [self._interval(one, settings, points) for one in _parts(self.row["range"])]
        if "range_in_units" in self.row:
            for name, raw in settings.items():
                _found(points, name).expect(raw)
            slope, start = self.line(settings, points)
            ends = [
                [nearest(slope * Fraction(end) + start) for end in one.split("..")]
                for one in _parts(self.row["range_in_units"])
            ]
            return [(min(pair), max(pair)) for pair in ends]
        if self.entries and self.row.get("open") not in YES:
            return [(raw, raw) for raw in sorted(self.entries)]
        return [self.outer]

    def _interval(self, text: str, settings: Settings, points: Mapping[str, Point]) -> tuple[int, int]:
        low, _, high = (part.strip() for part in text.partition(".."))
        return self._end(low, settings, points), self._end(high or low, settings, points)

    def _end(self, text: str, settings: Settings, points: Mapping[str, Point]) -> int:
        def named(name: str, part: str) -> Fraction:
            point = _found(points, name)
            raw = settings[point.row["name"]]
            if raw in point.special:
                raise UnknownError("a limit that does not apply")
            point.expect(raw)
            return _of_point(point, part, settings, points)

        return number(text) if is_number(text) else nearest(evaluate(text, named))

    def expect(self, raw: int) -> None:
        """Raises UnknownError if the point never holds that number: what follows then is no fact of the YAML."""
        if self.outermost and not self.outermost[0] <= raw <= self.outermost[1]:
            raise UnknownError("a limit by a number that is none")

    @cached_property
    def outermost(self) -> tuple[int, int] | None:
        """The least and the greatest constant end of the range."""
        parts = _parts(self.row.get("range", ""))
        ends = [number(end) for one in parts for end in one.split("..") if is_number(end)]
        return (min(ends), max(ends)) if ends else None

    @cached_property
    def fixed(self) -> tuple[int, int]:
        """The mask of the bits that are always written as a constant, and the constant."""
        mask = constant = 0
        for key, value in self.row.get("fixed", {}).items():
            high, low = self._numbered(key)
            ones = (1 << high - low + 1) - 1
            mask, constant = mask | ones << low, constant | number(value) << low
        return mask, constant

    @cached_property
    def special(self) -> dict[int, str]:
        """Every raw number that is no quantity, with its name."""
        return {raw: name for (low, high), (name, _) in self.codes.items() for raw in range(low, high + 1)}

    @cached_property
    def writable_codes(self) -> set[int]:
        """The special codes that may be written."""
        bands = [span for span, (_, writable) in self.codes.items() if writable]
        return {raw for low, high in bands for raw in range(low, high + 1)}

    @cached_property
    def codes(self) -> dict[tuple[int, int], tuple[str, bool]]:
        """The special codes, with names and whether they may be written: what is nearer to the point wins."""
        found: dict[tuple[int, int], tuple[str, bool]] = {}
        for key, entry in (pair for layer in self._layers() for pair in layer.items()):
            low, _, high = key.partition("..")
            span = self._signed(number(low)), self._signed(number(high or low))
            name = "" if entry in NOTHING else _name(entry)
            found = {one: told for one, told in found.items() if one != span and told[0] != name}
            if name and self.outer[0] <= span[0] and span[1] <= self.outer[1]:
                found[span] = name, isinstance(entry, dict) and entry.get("writable") in YES
        return found

    def _layers(self) -> list[Row]:
        """Maps of special codes, the farthest first: device, group, format, the point's own."""
        own = [self.row.get("format_special", {}), self.row.get("special", {})]
        if self.bits or self.type in ("bit", "text", "bytes"):
            return own
        floating = self.type in ("f32", "f64")
        around = [
            layer
            for for_all, types in self.row.get("around", ())
            for layer in ({} if floating else for_all, types.get(self.type, {}).get("special", {}))
        ]
        return around + own

    def _signed(self, code: int) -> int:
        """The number that a pattern is in a signed type."""
        return code - (1 << self.width) if self.type.startswith("s") and code > self.outer[1] else code


def _name(entry: str | Row) -> str:
    """The name that an entry of a map gives, alone or among other facts."""
    name: str = entry if isinstance(entry, str) else entry["name"]
    return name


def _parts(text: str | list[str]) -> list[str]:
    """The intervals and single numbers of a range."""
    return text if isinstance(text, list) else [part.strip() for part in re.split(r"[|,]", text)]


def _found(points: Mapping[str, Point], name: str) -> Point:
    """The point of that name or code; of several variants, any."""
    for point in points.values():
        if name in (point.item, point.row["name"], point.row.get("code")):
            return point
    raise UnknownError(f"no point {name}")


def _of_point(point: Point, part: str, settings: Settings, points: Mapping[str, Point]) -> Fraction:
    """The number that a formula takes from another point."""
    raw = settings[point.row["name"]]
    if part == "raw":
        return Fraction(raw)
    if point.type in ("f32", "f64"):
        value = float_of(raw, point.width)
        if not isfinite(value):
            raise UnknownError("not a number")
        return Fraction(value)
    slope, start = point.line(settings, points)
    return (raw - start) / slope


def float_of(pattern: int, width: int) -> float:
    """The number that a binary32 or binary64 pattern is."""
    found: float = struct.unpack(">f" if width == 32 else ">d", pattern.to_bytes(width // 8, "big"))[0]
    return found
