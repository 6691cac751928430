"""The pages in Chromium, from the file system: search, keyboard, copying, widths, schemes, print, and axe."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from fieldscribe.cli import main
from support.described import shipped
from support.made_once import made_once
from support.own_pages import HOSTILE, made
from support.toolchains import NODE_MODULES, npm_package, succeed, tool

FOR_AXE = (
    "index",
    "fieldscribe/README",
    "fieldscribe/descriptions/language/which-key",
    "fieldscribe/descriptions/using/c",
    "hostile/index",
    "hostile/fieldscribe/README",
)
FINDS = {
    "view_of": ("view_of", "fieldscribe/descriptions/KEYS.html#"),
    "other readings": ("Other readings", "fieldscribe/descriptions/using/listen.html#other-readings"),
    "0x1028": ("A020 base_frequency", "hitachi_l200.html#point=base_frequency"),
    "SIGNALS can": ("Signals", "fieldscribe/descriptions/language/can.html#signals"),
}
"""What people type, with the first place found, and the start of where Enter leads."""

pytestmark = pytest.mark.full(seconds=0.2)  # but for the first, which visits the pages for all


@pytest.fixture(scope="module")
def seen(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """What a reader meets, of our pages with two devices, and of hostile ones."""
    site = made_once(tmp_path_factory, "site", visit)
    return dict(json.loads((site / "seen.json").read_text("utf-8")))


def visit(site: Path) -> None:
    """Write the pages into a folder, visit them, and keep what was seen beside them."""
    assert main(["docs", "hitachi_l200", "jumo_controller", "--pages", "--format", "html", "--out", str(site)]) == 0
    title = {"en": f"<img src=x onerror=alert(1)>\u202e{'long' * 99}"}
    device = replace(
        shipped("jumo_controller"), vendor=title["en"], model="</script><script>alert(1)</script>", title=title
    )
    hostile, _ = made(site / "sources", [device], README=HOSTILE + "x" * 999 + "\n\n    " + "y" * 999)
    for path, text in hostile.items():
        (site / "hostile" / path).parent.mkdir(parents=True, exist_ok=True)
        (site / "hostile" / path).write_text(text, "utf-8")
    npm_package("playwright-core"), npm_package("axe-core")
    words = [*(f"{path}.html" for path in FOR_AXE), "--", *FINDS, "zzyzx"]
    script = Path(__file__).with_name("visit.mjs")
    seen = succeed([tool("node"), script, site, tool("chromium-headless-shell"), NODE_MODULES, *words])
    (site / "seen.json").write_text(seen, "utf-8")


@pytest.mark.full(seconds=20)
def test_nothing_is_wrong_and_nothing_leaves_the_pages(seen: dict[str, Any]) -> None:
    assert seen["troubles"] == []


def test_nothing_scrolls_sideways(seen: dict[str, Any]) -> None:
    assert seen["wide"] == []


def test_axe_finds_nothing(seen: dict[str, Any]) -> None:
    assert seen["axe"] == {}


@pytest.mark.parametrize("query", FINDS)
def test_the_search_leads_there(query: str, seen: dict[str, Any]) -> None:
    title, place = FINDS[query]
    search = seen["searches"][query]
    assert search["found"][0].startswith(title)
    assert search["first"].startswith(title)
    assert search["at"].startswith(place)
    assert title.split(" ")[-1].lower().replace("_", " ") in search["marked"].lower().replace("_", " ")
    assert search["cleared"] == ["", True, "search"]


def test_a_search_without_a_hit(seen: dict[str, Any]) -> None:
    assert seen["searches"]["zzyzx"]["found"] == []


def test_code_is_copied_and_the_chosen_scheme_stays(seen: dict[str, Any]) -> None:
    assert seen["copied"].startswith("- code: A020\n")
    light, dark, elsewhere = seen["papers"]
    assert light != dark == elsewhere


def test_print_has_the_text_alone(seen: dict[str, Any]) -> None:
    assert seen["printed"] == 0
