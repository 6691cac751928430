"""The page of a device in Chromium, from the file system: search, filters, links, keyboard, widths, schemes, axe."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from fieldscribe.model import Device
from fieldscribe.resources import render
from fieldscribe.targets.docs import html_files
from fieldscribe.targets.docs.cells import scope_of
from support.described import shipped
from support.made_once import made_once
from support.toolchains import NODE_MODULES, npm_package, succeed, tool

FINDS = {
    "A020": "base_frequency",
    "0x1028": "base_frequency",
    "1028h": "base_frequency",
    "4136": "base_frequency",
    "4137": "base_frequency",
    "404137": "base_frequency",
    "basisfrequenz": "base_frequency",
}
"""What people type, with the point that Enter opens; the addresses are those that the manual prints for A020."""
HASHES = (
    "",
    "#point=base_frequency",
    "#point=run_source",
    "#decoder",
    "#maps",
    "#bus",
    "#frames",
    "#errata",
    "#device",
)

pytestmark = pytest.mark.full(seconds=0.2)  # but for the first, which visits the page for all


def _visited(device: Device, folder: Path, queries: list[str], hashes: list[str]) -> dict[str, Any]:
    npm_package("playwright-core"), npm_package("axe-core")
    [(path, text)] = html_files(scope_of(device), render)
    page = folder / path
    page.write_text(text, "utf-8")
    visit = Path(__file__).with_name("visit_device.mjs")
    wanted = json.dumps({"queries": queries, "hashes": hashes})
    return dict(json.loads(succeed([tool("node"), visit, page, tool("chromium-headless-shell"), NODE_MODULES, wanted])))


@pytest.fixture(scope="module")
def seen(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """What a reader meets on the page of the L200."""
    queries = [*FINDS, "a020_start_value", "illegal_function"]

    def visit(folder: Path) -> None:
        visited = _visited(shipped("hitachi_l200"), folder, queries, list(HASHES))
        (folder / "seen.json").write_text(json.dumps(visited), "utf-8")

    return dict(json.loads((made_once(tmp_path_factory, "page_of_l200", visit) / "seen.json").read_text("utf-8")))


@pytest.mark.full(seconds=30)
def test_nothing_is_wrong_and_nothing_leaves_the_page(seen: dict[str, Any]) -> None:
    assert seen["troubles"] == []


def test_nothing_scrolls_sideways(seen: dict[str, Any]) -> None:
    assert seen["wide"] == []


def test_names_have_room_at_any_width(seen: dict[str, Any]) -> None:
    assert seen["narrowest"] > 150


def test_axe_finds_nothing(seen: dict[str, Any]) -> None:
    assert seen["axe"] == {}


@pytest.mark.parametrize("query", FINDS)
def test_the_search_leads_to_the_point(query: str, seen: dict[str, Any]) -> None:
    assert seen["searches"][query]["points"][0] == FINDS[query]
    assert seen["searches"][query]["at"] == f"#point={FINDS[query]}"


def test_the_search_finds_errata(seen: dict[str, Any]) -> None:
    assert "a020_start_value" in seen["searches"]["a020_start_value"]["places"]


def test_filters_and_the_choices_that_stay(seen: dict[str, Any]) -> None:
    assert seen["filtered"][0] > 0
    assert seen["filtered"][1] == ["r"]
    assert seen["variant"] == ["400V", 0]


def test_a_variant_that_is_gone_hides_nothing(seen: dict[str, Any]) -> None:
    assert seen["gone"] == ["", "256 of 256 points"]


def test_a_slash_begins_a_search_and_arrows_go_to_points(seen: dict[str, Any]) -> None:
    assert seen["typed"] == ["base_freq", "base_frequency"]


def test_a_link_to_a_group_lists_it_alone(seen: dict[str, Any]) -> None:
    """Whatever was searched before."""
    query, listed, in_group = seen["group"]
    assert query == ""
    assert 0 < listed == in_group < 256


def test_a_link_to_a_point_that_is_gone_says_so(seen: dict[str, Any]) -> None:
    assert seen["doubts"] == ["0..5open: whether 5 may be written in a 200 V unit"]
    assert seen["unknown"] == "There is no point gone: 256 of 256 points"


def test_a_range_beside_a_unit_is_no_raw_number(seen: dict[str, Any]) -> None:
    """Where the scale is not known, the raw range says what it is."""
    assert seen["ranges"]["base_frequency"] == "0..400"
    assert seen["ranges"]["scaled_output_frequency"] == "raw 0..999999"


def test_escape_clears_what_finds_nothing(seen: dict[str, Any]) -> None:
    assert seen["nothing"].startswith("0 of ")
    assert seen["cleared"] == ""


def test_a_list_that_was_short_grows_while_one_scrolls(seen: dict[str, Any]) -> None:
    assert seen["scrolled"] is True


def test_the_list_shows_the_point_beside_it(seen: dict[str, Any]) -> None:
    """Where it was opened by keyboard, and by a link."""
    assert seen["beside"] == [True, True]


def test_the_scheme_changes_and_stays(seen: dict[str, Any]) -> None:
    light, dark, again = seen["papers"]
    assert light != dark == again


def test_print_shows_the_list_alone_and_opens_errata(seen: dict[str, Any]) -> None:
    assert seen["printed"] == [False, True, True]


def test_a_hostile_description_is_shown_as_text(tmp_path: Path) -> None:
    hostile = f"<img src=x onerror=alert(1)></script><script>alert(2)</script>\u202e{'long' * 99}"
    device = shipped("jumo_controller")
    points = tuple(replace(point, title={"en": hostile}, note={"en": hostile}) for point in device.points)
    groups = tuple(replace(group, title={"en": hostile}) for group in device.groups)
    points = (replace(points[0], was=("earlier",)), *points[1:])
    device = replace(device, vendor=hostile, model="-->", title={"en": hostile}, points=points, groups=groups)
    first = next(point.item for point in points if point.generated)
    seen = _visited(device, tmp_path, ["onerror"], ["", f"#point={first}", "#point=earlier"])
    assert seen["shown"]["#point=earlier"] == points[0].item
    assert (seen["troubles"], seen["wide"]) == ([], [])
    assert seen["searches"]["onerror"]["points"]
    assert seen["elements"] == 4  # the data, the vectors, the code and the script of the page
