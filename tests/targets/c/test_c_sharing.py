"""What points of a header share is there once. A struct is named by its fields, the rest after its first point."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import pytest
from fieldscribe.model import Device, Factor, Point
from fieldscribe.pipeline import outputs
from fieldscribe.targets import c
from fieldscribe.targets.identifiers import clashes
from support.c_device import run_program, write_headers
from support.models import allowed, device_of, point, scaled, value_of

LISTED = allowed((1, 1), (3, 3), (5, 5), (9, 9))


def ruled(name: str, address: int, *factors: Factor) -> Point:
    return point(name, address, "s16", access="r", scale=scaled(1, 0, *factors))


FACTORS = (point("rated", 0), point("shown", 1), point("other", 2))
RATED_SHOWN = (value_of("rated", -1), value_of("shown"))
SHARING = (
    ruled("first", 10, *RATED_SHOWN),
    ruled("second", 11, *RATED_SHOWN),
    ruled("turned", 12, *reversed(RATED_SHOWN)),
    ruled("by_rated", 13, value_of("rated")),
    ruled("by_other", 14, value_of("other")),
    point("listed", 15, allowed=LISTED),
    point("listed_too", 16, allowed=LISTED),
)


def made(*points: Point) -> Device:
    return device_of("sharing", (*FACTORS, *points))


def header(device: Device) -> str:
    return next(text for _, path, text in outputs(device, ["c"]) if path == "c/sharing.h")


def test_points_with_the_same_content_share_it() -> None:
    text = header(made(*SHARING))
    assert re.findall(r"typedef struct (\w+) {", text) == ["sharing_with_rated_and_shown"]
    assert "    uint16_t rated_raw;\n    uint16_t shown_raw;\n} sharing_with_rated_and_shown;" in text
    rules = re.findall(r"fieldscribe_rule (sharing_\w+_rule)\(\s*(.*?)\)", text)
    assert rules == [
        ("sharing_first_rule", "const sharing_with_rated_and_shown *with"),
        ("sharing_turned_rule", "const sharing_with_rated_and_shown *with"),  # divided first, which is another rule
        ("sharing_by_rated_rule", "uint16_t other_raw"),
    ]
    assert re.findall(r"fieldscribe_range (\w+)\[", text) == ["sharing_listed_ranges"]
    called = [re.findall(rf"(\w+)_decode\([^{{]*{{[^}}]*{rule}\(", text) for rule, _ in rules]
    assert called == [["sharing_first", "sharing_second"], ["sharing_turned"], ["sharing_by_rated", "sharing_by_other"]]


@pytest.mark.parametrize(
    ("names", "struct"),
    [(("b", "a"), "sharing_with_a_and_b"), (("a" * 41, "b" * 42), f"sharing_with_{'a' * 41}_and_{'b' * 42}")],
)
def test_a_struct_is_named_by_its_fields(names: tuple[str, str], struct: str) -> None:
    factors = [point(name, 30 + at) for at, name in enumerate(names)]
    text = header(made(*factors, ruled("new", 20, *map(value_of, names))))
    assert re.findall(r"typedef struct (\w+) {", text) == re.findall(f"{struct}(?= {{)", text) != []


def test_two_structs_of_one_name_clash() -> None:
    factors = [point(name, 30 + at) for at, name in enumerate(("a_and_b", "c", "a", "b_and_c"))]
    points = [ruled("one", 20, *map(value_of, ("a_and_b", "c"))), ruled("two", 21, *map(value_of, ("a", "b_and_c")))]
    assert [one.name for one in clashes(c.identifiers(made(*factors, *points)))] == ["sharing_with_a_and_b_and_c"]


OLD = {
    "alone": ({"rated": ("nominal",)}, {"nominal_and_shown"}),
    "together": (
        {"rated": ("nominal",), "shown": ("printed",)},
        {"nominal_and_printed", "nominal_and_shown"},  # `printed, rated` is another order of the fields
    ),
    "more than once": ({"rated": ("nominal", "plate")}, {"nominal_and_shown", "plate_and_shown"}),
    "in another order": ({"rated": ("top",)}, set()),
}


@pytest.mark.parametrize(("was", "old"), OLD.values(), ids=OLD)
def test_a_struct_keeps_the_old_names_of_its_points(was: dict[str, tuple[str, ...]], old: set[str]) -> None:
    device = made(*SHARING)
    device = replace(device, points=tuple(replace(one, was=was.get(one.name, ())) for one in device.points))
    aliases = re.findall(r"#define sharing_with_(\w+) sharing_with_rated_and_shown\n", header(device))
    assert sorted(aliases) == sorted(old)
    assert list(clashes(c.identifiers(device))) == []


def test_old_names_of_a_struct_are_few() -> None:
    """Those of its points multiply: of ten points with one old name there would be a thousand."""
    names = [f"p{at}" for at in range(10)]
    factors = [point(name, 30 + at, was=(f"p{at}_old",)) for at, name in enumerate(names)]
    text = header(made(*factors, ruled("new", 20, *map(value_of, names))))
    assert len(re.findall("#define sharing_with_", text)) == 63


USER = """
#include "sharing.h"
int main(void)
{
    const sharing_with_rated_and_shown with = {.rated_raw = 2U, .shown_raw = 3U};
    int64_t first = 0;
    int64_t turned = 0;
    int64_t alone = 0;
    return sharing_first_decode_count(12, &with, &first) == FIELDSCRIBE_OK && first == 8 &&
            sharing_turned_decode_count(12, &with, &turned) == FIELDSCRIBE_OK && turned == first &&
            sharing_by_other_decode_count(12, 4U, &alone) == FIELDSCRIBE_OK && alone == 3
        ? 0
        : 1;
}
"""


def test_points_that_share_are_computed_each_with_its_own_numbers(tmp_path: Path) -> None:
    folder = write_headers(made(*SHARING), tmp_path)
    run_program(USER, "quick", folder / "c", tmp_path)
