"""A second reading of the model, slow and plain, that answers any vector of a point."""

from __future__ import annotations

import math
import struct
from fractions import Fraction
from typing import TYPE_CHECKING

from fieldscribe.model import Device, Factor, Limit, Point

from support.models import (
    named,
)

if TYPE_CHECKING:
    from collections.abc import Iterator

    from support.vector_file import Vector


def f64(value: float) -> str:
    """The bits of a binary64."""
    return struct.pack(">d", value).hex()


def near(value: Fraction) -> int:
    """The nearest integer, halves away from zero."""
    return int(value + Fraction(1, 2)) if value >= 0 else -int(-value + Fraction(1, 2))


class RefusedError(Exception):
    """The status that is not ok."""


def factor_of(factor: Factor, given_: dict[str, int], source: Point) -> Fraction:
    """What a factor multiplies a rule by."""
    number = factor.slope * given_[factor.point] + factor.intercept
    if factor.ten_to:
        bounds = source.allowed.intervals[0]
        if not int(str(bounds.low)) <= given_[factor.point] <= int(str(bounds.high)):
            raise RefusedError("overflow")
        return Fraction(10) ** (factor.power * number)
    return Fraction(number) ** factor.power if number or factor.power > 0 else Fraction(0)


class Reading:
    """Answers vectors of one device's points."""

    def __init__(self, device: Device) -> None:
        self.device = device

    def answer(self, vector: Vector) -> Vector:
        """The vector as this reading has it."""
        subject = named(self.device, vector["point"])
        try:
            return getattr(self, vector["kind"])(subject, vector) or {}
        except RefusedError as refusal:
            return {"status": str(refusal)}

    def rule(self, subject: Point, vector: Vector) -> tuple[Fraction, Fraction]:
        """The ratio and the offset in force."""
        given_ = vector.get("with", {})
        for case in subject.scale or ():
            if case.point is None or given_[case.point] == case.raw:
                product = Fraction(1)
                for factor in case.rule.factors:
                    product *= factor_of(factor, given_, named(self.device, factor.point))
                if not product:
                    raise RefusedError("zero_factor")
                return case.rule.ratio * product, case.rule.offset
        raise RefusedError("no_case")

    def limit(self, bound: int | Limit, given_: dict[str, int], *, low: bool) -> int:
        """A bound at these settings."""
        if isinstance(bound, int):
            return bound
        if any(first <= given_[name] <= last for name, bands in bound.unless for first, last in bands):
            return bound.least if low else bound.greatest
        product = bound.rule.ratio
        for factor in bound.rule.factors:
            product *= factor_of(factor, given_, named(self.device, factor.point))
        found = near(product + bound.rule.offset)
        return max(found, bound.least) if low else min(found, bound.greatest)

    def admit(self, subject: Point, raw: int, given_: dict[str, int]) -> None:
        """Refuses what may not be written."""
        for one in subject.allowed.intervals:
            if self.limit(one.low, given_, low=True) <= raw <= self.limit(one.high, given_, low=False):
                return
        raise RefusedError("unknown_value" if subject.enum is not None and subject.enum.closed else "out_of_range")

    def present(self, subject: Point, raw: int) -> None:
        """Refuses numbers that are special codes."""
        if any(special.low <= raw <= special.high for special in subject.specials):
            raise RefusedError("special")

    def decode(self, subject: Point, vector: Vector) -> Vector:
        raw = vector["raw"]
        self.present(subject, raw)
        if subject.form == "float":
            form, size = (">f", 4) if subject.type == "f32" else (">d", 8)
            value = struct.unpack(form, raw.to_bytes(size, "big"))[0]
        else:
            ratio, offset = self.rule(subject, vector)
            value = float((raw - offset) / ratio)
        return {"status": "ok", "float": f64(math.nan if math.isnan(value) else value)}

    def encode(self, subject: Point, vector: Vector) -> Vector:
        value = struct.unpack(">d", bytes.fromhex(vector["float"]))[0]
        if math.isnan(value):
            raise RefusedError("not_a_number")
        if subject.form == "float":
            return self.encode_float(subject, value)
        self.rule(subject, vector)
        case = next(one for one in subject.scale or () if one.point is None or vector["with"][one.point] == one.raw)
        num, den = case.rule.ratio.numerator, case.rule.ratio.denominator
        for factor in case.rule.factors:
            number = factor_of(factor, vector["with"], named(self.device, factor.point))
            num, den = num * number.numerator, den * number.denominator
        value = value * float(num) / float(den) + float(case.rule.offset)
        if math.isinf(value):
            raise RefusedError("out_of_range")
        raw = near(Fraction(value))
        self.present(subject, raw)
        self.admit(subject, raw, vector.get("with", {}))
        return {"status": "ok", "raw": raw}

    def encode_float(self, subject: Point, value: float) -> Vector:
        form = ">f" if subject.type == "f32" else ">d"
        try:
            packed = struct.pack(form, value)
        except OverflowError:
            raise RefusedError("out_of_range") from None
        if math.isfinite(value):
            self.present(subject, int.from_bytes(packed, "big"))
        self.admit_float(subject, struct.unpack(form, packed)[0])
        return {"status": "ok", "raw": int.from_bytes(packed, "big")}

    def admit_float(self, subject: Point, number: float) -> None:
        """Refuses numbers of the type beyond the limits, as the type has those."""
        form = ">f" if subject.type == "f32" else ">d"
        if math.isnan(number):
            raise RefusedError("not_a_number")
        spans = [
            [struct.unpack(form, struct.pack(form, float(end)))[0] for end in one] for one in subject.allowed.units
        ]
        if math.isinf(number) or (spans and not any(low <= number <= high for low, high in spans)):
            raise RefusedError("out_of_range")

    def decode_count(self, subject: Point, vector: Vector) -> Vector:
        raw = vector["raw"]
        self.present(subject, raw)
        if subject.scale is None:
            return {"status": "ok", "count": raw}
        ratio, offset = self.rule(subject, vector)
        count = near((raw - offset) / ratio * 10 ** (subject.decimals or 0))
        if not -(2**63) <= count < 2**63:
            raise RefusedError("overflow")
        return {"status": "ok", "count": count}

    def encode_count(self, subject: Point, vector: Vector) -> Vector:
        ratio, offset = (Fraction(1), Fraction(0)) if subject.scale is None else self.rule(subject, vector)
        power = 1 if subject.scale is None else 10 ** (subject.decimals or 0)
        raw = near(Fraction(vector["count"], power) * ratio + offset)
        self.present(subject, raw)
        self.admit(subject, raw, vector.get("with", {}))
        return {"status": "ok", "raw": raw}

    def check(self, subject: Point, vector: Vector) -> Vector:
        if any(one.low <= vector["raw"] <= one.high and one.writable for one in subject.specials):
            return {"status": "ok"}
        self.present(subject, vector["raw"])
        if subject.form == "float":
            form, size = (">f", 4) if subject.type == "f32" else (">d", 8)
            self.admit_float(subject, struct.unpack(form, vector["raw"].to_bytes(size, "big"))[0])
            return {"status": "ok"}
        self.admit(subject, vector["raw"], vector.get("with", {}))
        return {"status": "ok"}

    def name(self, subject: Point, vector: Vector) -> Vector:
        entries = subject.enum.entries if subject.enum else ()
        return {"name": next((entry.name for entry in entries if entry.raw == vector["raw"]), None)}

    def special(self, subject: Point, vector: Vector) -> Vector:
        found = [one for one in subject.specials if one.name == vector["special"]]
        return {"low": found[0].low, "high": found[0].high} if found else {"low": None}

    def special_name(self, subject: Point, vector: Vector) -> Vector:
        found = [one for one in subject.specials if one.low <= vector["raw"] <= one.high]
        return {"name": found[0].name, "no_value": int(found[0].no_value)} if found else {}

    def flag(self, subject: Point, vector: Vector) -> Vector:
        found = [one for one in subject.flags if one.name == vector["flag"]]
        return {"number": (vector["raw"] >> found[0].low) % 2 ** found[0].width} if found else {"number": None}

    def flag_name(self, subject: Point, vector: Vector) -> Vector:
        found = [entry for one in subject.flags if one.name == vector["flag"] for entry in one.values]
        return {"name": next((entry.name for entry in found if entry.raw == vector["raw"]), None)}

    def bits(self, subject: Point, vector: Vector) -> Vector:
        assert subject.bits is not None
        low, size = subject.bits[1], 1 << subject.width
        raw = vector["word"] // 2**low % size
        rest = vector["word"] - raw * 2**low
        signed = subject.info.signed and raw >= size // 2
        return {"raw": raw - size if signed else raw, "result": rest + vector["replaced"] % size * 2**low}

    def words(self, subject: Point, vector: Vector) -> Vector:
        count = subject.words
        by_address = {
            where: vector["raw"] // 65536 ** (count - 1 - place) % 65536
            for place, where in enumerate(subject.addresses)
        }
        return {"words": [by_address[where] for where in sorted(by_address)]}

    def address(self, subject: Point, vector: Vector) -> Vector:
        del vector
        found: Vector = {"space": subject.space, "address": subject.address, "words": subject.words}
        found["references"] = {key: str(number) for key, number in subject.references.items()}
        found["code"] = subject.code
        if subject.form == "float":
            return found
        ends = [(one.low, one.high) for one in subject.allowed.intervals]
        lows = [low.least if isinstance(low, Limit) else low for low, _ in ends]
        highs = [high.greatest if isinstance(high, Limit) else high for _, high in ends]
        found |= {"raw_min": min(lows, default=subject.least), "raw_max": max(highs, default=subject.greatest)}
        return found | ({"decimals": subject.decimals} if subject.form == "scaled" else {})


def wrong(device: Device, against: list[Vector]) -> Iterator[Vector]:
    """Vectors that the plain reading of `device` does not answer as they say."""
    reading = Reading(device)
    for vector in against:
        if hasattr(reading, vector["kind"]):
            answer = reading.answer(vector)
            if any(vector.get(key) != value for key, value in answer.items()):
                yield {**vector, "instead": answer}
