"""The file of vectors: its lines, counts and notation, and what it holds for points that the sample lacks."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace

import pytest
from fieldscribe.families import family
from fieldscribe.model import Entry, Enum, Flag, Limit, Special
from fieldscribe.targets.vectors.lines import KINDS, Lines, Row
from support.models import allowed, linear, point, sample_bus, sample_device, scaled, titles, value_of
from support.sample_vectors import SAMPLE, VECTORS, text_of, vectors
from support.vector_file import counts_of, vectors_of


def test_one_vector_per_line_with_counts_before() -> None:
    text = text_of(SAMPLE)
    assert text.startswith("vectors\t2\tsample_drive\t1.2.0\t0123456789abcdef")
    assert text.endswith("\n")
    kinds = Counter(vector["kind"] for vector in VECTORS)
    known = KINDS | family(SAMPLE.family).part("targets.vectors").KINDS
    assert counts_of(text) == {
        kind: kinds[kind] for kind in kinds if "python" in (Row(kind, known[kind]).only or "python")
    }
    lines = Counter(line.split("\t")[0] for line in text.splitlines())
    assert {kind: lines[kind] for kind in kinds} == kinds


def test_units_of_points_are_vectors() -> None:
    symbols = {
        vector["point"]: vector["symbol"] for vector in vectors_of(text_of(SAMPLE)) if vector["kind"] == "symbol"
    }
    assert symbols == {
        point.item: point.unit.symbol for point in SAMPLE.points if point.generated and point.unit.symbol
    }


def test_the_same_text_twice_and_no_vector_twice() -> None:
    text = text_of(SAMPLE)
    assert text == text_of(sample_device())
    repeated = [line for line, times in Counter(map(repr, VECTORS)).items() if times > 1]
    assert repeated == []


def test_a_device_without_points_is_still_a_file() -> None:
    bus = replace(sample_bus(), framings=(), exceptions=())
    device = replace(sample_device(()), bus=bus, frames=(), blocks={}, commands=(), variants={})
    assert vectors(device) == []


@pytest.mark.parametrize("text", ["", "-", "%", "a\tb\nc", "x=1,2", "\u202e\u2028", "100 %", "\x00\x7f"])
def test_any_text_comes_back(text: str) -> None:
    lines = Lines()
    lines.set("point", "one")
    lines.add("name", 1, text)
    assert vectors_of(lines.text("device", "1", "0")) == [{"kind": "name", "point": "one", "raw": 1, "name": text}]


def test_a_line_that_the_table_does_not_know_is_refused() -> None:
    lines = Lines()
    with pytest.raises(TypeError, match="check: raw takes int, no str"):
        lines.add("check", "x", "ok")
    with pytest.raises(ValueError, match="check lacks status"):
        lines.add("check", 1)
    with pytest.raises(ValueError, match="check has no more than 2 fields"):
        lines.add("check", 1, "ok", 3)


def test_a_set_ends_those_behind_it() -> None:
    lines = Lines()
    lines.set("point", "one")
    lines.set("with", {"other": 5})
    lines.add("check", 1, "ok")
    lines.set("point", "two")
    lines.add("check", 1, "ok")
    lines.set("with", {"other": 5})
    lines.add("check", 2, "ok")
    found = [vector.get("with") for vector in vectors_of(lines.text("device", "1", "0"))]
    assert found == [{"other": "5"}, None, {"other": "5"}]


def test_documented_points_have_no_vectors() -> None:
    named_points = {vector["point"] for vector in VECTORS if "point" in vector}
    assert named_points == {one.item for one in SAMPLE.points if one.generated}


def test_the_amount_stays_bounded() -> None:
    one = point("one", 1, scale=scaled(256), decimals=3, allowed=allowed((10, 4000)))
    kinds = Counter(vector["kind"] for vector in vectors(sample_device((one,))) if vector.get("point") == "one")
    assert kinds.total() - kinds["read"] - kinds["write"] <= 45  # the first point of a device has the bad answers


def test_u64_numbers_beyond_int64_are_raw_only() -> None:
    found = vectors(sample_device((point("wide", 1, "u64"),)))
    counts = [vector["count"] for vector in found if "count" in vector and "point" in vector]
    assert max(counts) == 2**63 - 1
    assert {"kind": "check", "point": "wide", "raw": 2**64 - 1, "status": "ok"} in found


def test_a_limit_that_divides_by_zero() -> None:
    limit = Limit(linear(100, 0, value_of("ratio", -1)), (), 1, 100)
    subject = point("subject", 1, scale=scaled(10), decimals=1, allowed=allowed((0, limit)))
    found = vectors(sample_device((subject, point("ratio", 2, allowed=allowed((1, 100))))))
    zero = [vector for vector in found if vector.get("with") == {"ratio": 0}]
    assert {(vector["kind"], vector["status"]) for vector in zero} == {
        (kind, "zero_factor") for kind in ("encode", "encode_count", "check")
    }


def test_a_point_that_only_lifts_a_limit_is_an_argument() -> None:
    limit = Limit(linear(7), (("mode", ((2, 2), (4, 4))),), 0, 100)
    subject = point("subject", 1, allowed=allowed((0, limit)))
    found = vectors(sample_device((subject, point("mode", 2, allowed=allowed((0, 9))))))
    checks = {(one["with"]["mode"], one["status"]) for one in found if one["kind"] == "check" and one.get("raw") == 100}
    assert subject.arguments == subject.limit_arguments == ("mode",)
    assert {(2, "ok"), (4, "ok")} <= checks
    wrong_limits = [one for one in found if one.get("with", {}).get("mode") in (0, 9) and one["kind"] == "check"]
    assert {one["raw"]: one["status"] for one in wrong_limits} | {7: "ok", 8: "out_of_range"} == {
        one["raw"]: one["status"] for one in wrong_limits
    }


def test_factors_with_slope_and_intercept_find_their_zero() -> None:
    subject = point("subject", 1, scale=scaled(1, 0, value_of("other", slope=2, intercept=-8)))
    found = vectors(sample_device((subject, point("other", 2, allowed=allowed((0, 9))))))
    zeros = {vector["with"]["other"] for vector in found if vector.get("status") == "zero_factor"}
    assert zeros == {4}


def test_counts_reach_the_ends_of_int64_only_where_the_type_does() -> None:
    narrow = point("narrow", 1, scale=scaled(10), decimals=1)
    wide = point("wide", 2, "u32", scale=scaled(1), decimals=2)
    found = vectors(sample_device((narrow, wide)))
    tops = {
        item: max(one["count"] for one in found if one.get("point") == item and one["kind"] == "encode_count")
        for item in ("narrow", "wide")
    }
    assert tops == {"narrow": 2**31 - 1, "wide": 2**63 - 1}


def test_read_only_and_write_only_points() -> None:
    found = vectors(sample_device((point("read", 1, access="r"), point("write", 2, access="w"))))
    kinds = {item: {one["kind"] for one in found if one.get("point") == item} for item in ("read", "write")}
    reads = {"address", "facts", "decode_count", "read"}
    assert kinds == {"read": reads, "write": {"address", "facts", "encode_count", "check", "write"}}


def test_names_cannot_break_the_file() -> None:
    enum = Enum("odd", (Entry(1, 'a"b\n', titles("x"), None),), True)
    flag = Flag(0, 1, '"', titles("x"), 1, ())
    special = Special(3, 3, "\\", titles("x"), False)
    device = sample_device(
        (point("a", 1, enum=enum, allowed=allowed((1, 1))), point("b", 2, flags=(flag,), specials=(special,)))
    )
    found = vectors(device)
    assert {"kind": "name", "point": "a", "raw": 1, "name": 'a"b\n'} in found
    assert {"kind": "special", "point": "b", "special": "\\", "low": 3, "high": 3} in found
