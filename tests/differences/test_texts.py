"""How differences are reported to people: the texts of values, subjects, places and steps."""

from __future__ import annotations

from typing import Any

import pytest
from fieldscribe.differences.changes import Comparison, as_data, fact_of, subject_of
from fieldscribe.differences.comparison import Difference, Thing
from fieldscribe.differences.rendering import as_markdown, as_text, value_text
from fieldscribe.differences.sides import Side

CASE: dict[str, Any] = {"when": None, "num": "1", "den": "1", "offset": "0", "uses": []}
TEN_TO = {"point": "exponent", "part": "raw", "ten_to": -1}
WHOLE = {"point": "other", "part": "raw", "times": 2, "plus": 3, "power": 1}
CONDITION = {
    "any": [{"all": [{"of": "a", "is": "==", "than": 1}, {"of": "b", "is": "in", "than": [1, 2]}]}, {"all": []}]
}


@pytest.mark.parametrize(
    ("fact", "value", "text"),
    [
        ("unit", "", "none"),
        ("unit", None, "none"),
        ("unit", "Hz", "Hz"),
        ("range", None, "all that the type holds"),
        ("range", [], "all that the type holds"),
        ("order of words", None, "as usual"),
        ("order of words", [1, 0], "1, 0"),
        ("open", True, "yes"),
        ("open", False, "no"),
        ("address", 9, "9"),
        ("address", 10, "10 (000Ah)"),
        ("identifier", 801, "801 (0321h)"),
        ("number", 3, "3"),
        ("default", 10, "10"),
        ("range", [[0, 4000]], "0..4000"),
        ("range", [[0, 1], [5, 5], ["min(4, a.raw)", 9]], "0..1 | 5 | min(4, a.raw)..9"),
        ("units", [1, 247], "1..247"),
        ("gaps", {"holding": [[1, 2], [5, 5]], "coil": [[7, 8]]}, "holding 1..2 | 5; coil 7..8"),
        ("bits", [3, 0], "3..0"),
        ("bits", [4, 4], "4"),
        ("raw", 7, "7"),
        ("raw", [7, 9], "7..9"),
        ("serial", {"baud": {"9600": "9600"}, "data": {"1": "8", "2": "7"}}, "baud 9600; data 1 8, 2 7"),
        ("title", {"en": "Speed", "de": "Tempo"}, "en: Speed; de: Tempo"),
        ("title", "Manual", "Manual"),
        ("note of the bus", {"en": "Slow"}, "en: Slow"),
        ("scale", [CASE], "raw = value"),
        ("scale", [{**CASE, "num": "10", "den": "3", "offset": "5/2"}], "raw = value * 10 / 3 + 5/2"),
        ("scale", [{**CASE, "offset": "-4"}], "raw = value - 4"),
        ("scale", [{**CASE, "uses": [{"point": "ratio", "part": "value", "power": 1}]}], "raw = value * ratio"),
        ("scale", [{**CASE, "uses": [TEN_TO]}], "raw = value / 10 ** exponent.raw"),
        ("scale", [{**CASE, "uses": [WHOLE]}], "raw = value * (other.raw * 2 + 3)"),
        ("scale", [{**CASE, "when": {"point": "mode", "raw": 1}}, CASE], "when mode == 1: raw = value; raw = value"),
        ("when", CONDITION, "a == 1 and b in 1, 2 or "),
        ("fixed", {"mask": 3, "bits": 1, "else": None}, "mask 3; bits 1"),
        ("step", [{"from": 0, "step": 5}], "from 0; step 5"),
    ],
)
def test_a_value(fact: str, value: Any, text: str) -> None:
    assert value_text(fact, value) == text


def side(version: str) -> Side:
    return Side({"device": "pump", "version": version, "family": "modbus"}, None, f"{version}.json")


def comparison(*found: Difference, old: str = "1.2.3", new: str = "1.2.3") -> Comparison:
    """A comparison of two exported models that found these differences."""
    compared = Comparison("pump", side(old), side(new))
    compared.__dict__["differences"] = list(found)
    return compared


def difference(weight: str, *things: Thing, fact: str = "", old: Any = None, new: Any = None) -> Difference:
    return Difference(weight, things, fact, old, new)


POINT, OTHER = Thing("point", "speed", "speed"), Thing("point", "load", "load")
ENTRY = Thing("entry", "run", "run")
RENAMED = Thing("point", "speed", "pace")


@pytest.mark.parametrize(
    ("found", "lines"),
    [
        (difference("wire", POINT, fact="address", old=1, new=16), ["speed: address 1 -> 16 (0010h)"]),
        (difference("behaviour", fact="units", old=[1, 2], new=[1, 3]), ["units 1..2 -> 1..3"]),
        (difference("wire", POINT, ENTRY, fact="raw", old=1, new=2), ["speed: entry run raw 1 -> 2"]),
        (difference("compatible", Thing("point", None, "new_one"), new="new_one"), ["new_one is new (point)"]),
        (difference("api", Thing("command", "enter", None), old="enter"), ["command:enter is gone (command)"]),
        (difference("api", POINT, Thing("entry", None, "run"), new="run"), ["speed: entry run is new"]),
        (difference("api", RENAMED, old="speed", new="pace"), ["speed is now pace"]),
        (
            difference("compatible", RENAMED, old="speed", new="pace"),
            ["speed is now pace; the old name stays as a deprecated alias"],
        ),
        (difference("api", Thing("group", "a", "b"), old="a", new="b"), ["group:a is now b"]),
        (difference("api", POINT, Thing("entry", "run", "go"), old="run", new="go"), ["speed: entry run is now go"]),
        (
            difference("behaviour", Thing("erratum", None, "odd"), new={"points": ["a"], "printed": "x"}),
            ["erratum:odd is new (erratum): points a; printed x"],
        ),
    ],
)
def test_a_sentence(found: Difference, lines: list[str]) -> None:
    printed = ["".join(text for _, text in line).strip() for line in as_text([comparison(found)])]
    assert printed[2:3] == lines
    assert printed[0] == "pump 1.2.3"
    assert printed[3] == "1.2.3.json"
    assert printed[-1] == "1 difference"


def test_the_same_difference_of_several_points_is_one_line() -> None:
    found = [
        difference("api", Thing("point", f"p{number}", f"p{number}"), fact="access", old="r", new="w")
        for number in range(14)
    ]
    text = ["".join(part for _, part in line) for line in as_text([comparison(*found)])]
    names = ", ".join(f"p{number}" for number in range(12))
    assert text[2] == f"    14 points ({names} and 2 more): access r -> w"
    assert text[-1] == "14 differences"
    markdown = list(as_markdown([comparison(*found[:2])]))
    assert markdown[6] == "- 2 points (`p0`, `p1`): access r \N{RIGHTWARDS ARROW} w"


BELOW_1 = "(below 1.0 the middle number says what breaks)"


@pytest.mark.parametrize(
    ("old", "new", "weight", "release", "advice"),
    [
        ("1.2.3", "1.2.3", "wire", "2.0.0", "the version must take a major step: 2.0.0 or more, it says 1.2.3"),
        ("1.2.3", "2.0.0", "api", "2.0.0", "a major step of the version: 1.2.3 -> 2.0.0"),
        ("1.2.3", "1.3.0", "compatible", "1.3.0", "a minor step of the version: 1.2.3 -> 1.3.0"),
        ("1.2.3", "1.2.4", "behaviour", "1.3.0", "the version must take a minor step: 1.3.0 or more, it says 1.2.4"),
        ("1.2.3", "1.2.4", "docs", "1.2.4", "a patch step of the version: 1.2.3 -> 1.2.4"),
        (
            "0.2.3",
            "0.2.4",
            "wire",
            "0.3.0",
            f"the version must take a major step: 0.3.0 or more, it says 0.2.4 {BELOW_1}",
        ),
        ("dev", "dev", "docs", "dev", "a patch step of the version (dev is not a version like 1.2.3)"),
    ],
)
def test_the_step_that_the_version_must_take(old: str, new: str, weight: str, release: str, advice: str) -> None:
    compared = comparison(difference(weight, POINT, fact="address", old=1, new=2), old=old, new=new)
    lines = ["".join(text for _, text in line).strip() for line in as_text([compared])]
    assert advice in lines
    assert lines[0] == f"pump {old}" + (f" -> {new}" if old != new else "")
    assert next(iter(as_markdown([compared]))) == f"## pump {release}"


@pytest.mark.parametrize(("old", "new"), [(None, "1.0.0"), ("1.0.0", None)])
def test_a_device_that_comes_or_goes(old: str | None, new: str | None) -> None:
    compared = Comparison("pump", side(old) if old else None, side(new) if new else None)
    [found] = compared.differences
    assert (found.weight, found.old, found.new) == (("api", "pump", None) if old else ("compatible", None, "pump"))
    text = "".join(text for line in as_text([compared]) for _, text in line)
    assert ("the device is gone" if old else "a new device") in text
    assert next(iter(as_markdown([compared]))) == "## pump 1.0.0"


def test_data() -> None:
    found = difference("wire", POINT, ENTRY, fact="raw", old=1, new=2)
    [change] = as_data([comparison(found)])["changes"]
    assert (subject_of(found), fact_of(found)) == (change["point"], change["fact"]) == ("speed", "entry run raw")
    assert change["places"] == {"old": "1.2.3.json", "new": "1.2.3.json"}
    assert change["symbols_missing"] == ["old", "new"]
    assert as_data([comparison(found)])["step"] == "major"
