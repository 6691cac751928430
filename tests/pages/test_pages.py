"""Our own pages as HTML: what their Markdown becomes, where their links lead, and the files of an index."""

from __future__ import annotations

import json
import re
import shlex
import sys
from html.parser import HTMLParser
from operator import attrgetter
from pathlib import Path
from posixpath import dirname, join, normpath
from typing import Any

import pytest
from fieldscribe.cli import main
from fieldscribe.diagnostics import Report
from fieldscribe.pages.site import site_files
from fieldscribe.pages.texts import markdown_reader, page_of
from fieldscribe.pipeline import load_device
from fieldscribe.resources import render
from support.described import shipped
from support.own_pages import HOSTILE, made
from support.places import ROOT

PAGE = (ROOT / "descriptions/using/pages.md").read_text("utf-8")
DEVICES = ("hitachi_l200", "nord_sk5xxe")


def test_nothing_of_a_text_becomes_markup() -> None:
    page = page_of("README.md", HOSTILE)
    tags = set(re.findall(r"<(\w+)", page.html()))
    assert tags == {"h1", "h2", "a", "code", "p", "div", "table", "thead", "tbody", "tr", "th", "td"}
    assert not re.search(r'\son\w+="|href="(?!#|https://example)|\u202e|a mark of ours', page.html())
    assert page.title == '<script>alert(1)</script> "x" & <b>'
    assert "<h1" in page.html()
    assert "&lt;script&gt;alert(1)&lt;/script&gt; &quot;x&quot; &amp; <code>&lt;b&gt;</code>" in page.html()


def test_headings_and_rows_have_anchors_of_their_own() -> None:
    page = page_of("README.md", HOSTILE)
    rows = [(section.anchor, section.level, " ".join(section.words)) for section in page.sections[1:]]
    head = "scriptalert1script-x--b"
    assert rows == [
        (f"{head}-a-any", 0, "<i>first</i>"),
        (f"{head}-a-any-1", 0, "the next"),
        ("twice", 2, ""),
        ("twice-1", 2, ""),
    ]
    assert all(f'id="{section.anchor}"' in page.html() for section in page.sections)


@pytest.mark.parametrize(
    ("link", "leads"),
    [
        ("CHANGELOG.md", "CHANGELOG.html"),
        ("CHANGELOG.md#1-new", "CHANGELOG.html#1-new"),
        ("#own", "#own"),
        ("descriptions/hitachi_l200/", "../hitachi_l200.html"),
        ("https://example.org/a.md", "https://example.org/a.md"),
        ("descriptions/nord_sk5xxe/", None),
        ("generator/README.md", None),
    ],
)
def test_where_links_lead(link: str, leads: str | None, tmp_path: Path) -> None:
    files, report = made(tmp_path, README=f"# First\n\nsee [there]({link})\n\n## Own\n", CHANGELOG="# 1: new\n")
    expected = "see there" if leads is None else f'see <a href="{leads}">there</a>'
    assert expected in files["fieldscribe/README.html"]
    assert not report.findings


@pytest.mark.parametrize("link", ["NOTES.md", "CHANGELOG.md#old", "#old", "descriptions/KEYS.md"])
def test_a_link_that_leads_nowhere_is_a_finding(link: str, tmp_path: Path) -> None:
    _, report = made(tmp_path, README=f"# First\n\nsee\n[there]({link})\n", CHANGELOG="# 1\n")
    (finding,) = report.findings
    assert (finding.rule, finding.span.file, finding.span.line) == ("broken-link", str(tmp_path / "README.md"), 4)
    assert f"`{link}` leads to no page or heading" in finding.message


class Links(HTMLParser):
    """What a page leads to, and the anchors that it has."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.targets: list[str] = []
        self.anchors: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        of = dict(attrs)
        self.anchors += filter(None, [of.get("id")])
        self.targets += [target for key in ("href", "src") if (target := of.get(key))]


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder that the command of our page makes."""
    (command,) = re.findall(r"(?s)```sh\nfieldscribe (.*?)\n```", PAGE)
    out = tmp_path_factory.mktemp("site")
    assert main(shlex.split(command.replace("--out site", f"--out {out}"))) == 0
    return out


@pytest.mark.full(seconds=1)
def test_the_files_of_the_page_are_made(site: Path) -> None:
    named = re.findall(r"(?m)^\| `(.*?)`", PAGE)
    assert "index.html" in named
    assert all((site / name).is_file() for name in named)
    assert '"index":"index.html"' in (site / "hitachi_l200.html").read_text("utf-8")
    assert '"index":' not in (ROOT / "generated/docs/hitachi_l200.html").read_text("utf-8")


def test_every_page_is_there_and_every_link_leads_somewhere(site: Path) -> None:
    pages = {path.relative_to(site).as_posix(): Links(path.read_text("utf-8")) for path in site.rglob("*.html")}
    sources = [*ROOT.glob("*.md"), *(ROOT / "descriptions").rglob("*.md")]
    assert {path for path in pages if path.startswith("fieldscribe/")} == {
        f"fieldscribe/{path.relative_to(ROOT).with_suffix('.html').as_posix()}" for path in sources
    }
    for path, page in pages.items():
        assert len(page.anchors) == len(set(page.anchors)), path
        for target in page.targets:
            if "://" not in target:
                name, _, anchor = target.partition("#")
                there = normpath(join(dirname(path), name)) if name else path
                assert (site / there).is_file(), f"{path}: {target}"
                assert not anchor or anchor in pages[there].anchors, f"{path}: {target}"


def data(script: str) -> dict[str, Any]:
    """The rows of the search by the path of their place."""
    places = json.loads(script.rpartition("startPages(")[2].removesuffix(");\n"))
    return {path: rows for path, _, rows in places}


def test_the_search_has_every_key_and_section(site: Path) -> None:
    places = data((site / "index.js").read_text("utf-8"))
    rows = places["fieldscribe/descriptions/KEYS.html"]
    keys = (ROOT / "descriptions/KEYS.md").read_text("utf-8")
    titles = [title for _, title, *_ in rows]
    assert set(re.findall(r"(?m)^\| `([^`]+)`", keys)) <= set(titles)
    assert set(re.findall(r"(?m)^#+ (.*)$", keys.replace("`", ""))) <= set(titles)
    assert all(places.values())


def test_the_command_says_what_it_lacks(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def said(*words: str) -> tuple[int, str]:
        return main(["docs", *words, "--out", str(tmp_path)]), capsys.readouterr().err

    assert said("--format", "html") == (
        2,
        "fieldscribe: DEVICE is missing\n  hint: name devices, or say --pages for the pages of fieldscribe itself\n",
    )
    assert said("--pages", "--format", "csv") == (2, "fieldscribe: --pages is for --format html\n")
    markdown_reader.cache_clear()
    monkeypatch.setitem(sys.modules, "markdown_it", None)
    assert said("--pages", "--format", "html") == (
        2,
        'fieldscribe: --pages needs markdown-it-py\n  hint: pip install "fieldscribe[html]"\n',
    )
    assert not list(tmp_path.iterdir())


@pytest.mark.full(seconds=2)
def test_a_second_run_finds_nothing_to_do(site: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["docs", *DEVICES, "--pages", "--format", "html", "--out", str(site)]
    assert main([*words, "--check"]) == 0
    assert re.search(r"^0 of \d+ files of index in .* are not current\n", capsys.readouterr().out, re.MULTILINE)
    (site / "index.css").write_text("body { color: red; }\n", "utf-8")
    assert main(words) == 1
    assert "index.css is in the way: it was edited" in capsys.readouterr().err
    (site / "index.css").unlink()
    assert main(words) == 0
    assert re.search(r"^1 written, 0 removed, \d+ unchanged of index in", capsys.readouterr().out, re.MULTILINE)


def test_without_our_pages_they_go_and_the_index_stays(site: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["docs", *DEVICES, "--format", "html", "--out", str(site)]
    assert main(words) == 0
    assert re.search(r"^3 written, \d+ removed, 1 unchanged of index in", capsys.readouterr().out, re.MULTILINE)
    assert not list(site.glob("fieldscribe/**/*.html"))
    assert "fieldscribe/" not in (site / "index.html").read_text("utf-8")


def test_the_index_lists_devices_and_finds_their_points_by_any_number() -> None:
    devices = [shipped("hitachi_l200"), shipped("woodward_mpu2s")]
    files = dict(site_files(devices, (), "fieldscribe docs", render))
    assert files.keys() == {"index.html", "index.css", "index.js"}
    cells = re.findall(r"<t[hd][^>]*>(?:<a href=\"(.*?)\">)?(.*?)<", files["index.html"].partition("<tbody>")[2])
    assert cells[:7] == [
        ("hitachi_l200.html", "L200"),
        *(("", text) for text in ("Hitachi", "Frequency inverter / Frequenzumrichter", "modbus: rtu")),
        *(("", text) for text in ("256", "236", "162")),
    ]
    rows = {title: words for _, title, words, _ in data(files["index.js"])["hitachi_l200.html"]}
    words = rows["A020 base_frequency: Base frequency / Basisfrequenz"].split()
    assert {"1028h", "4136", "0x1028", "4137", "404137"} <= set(words)


@pytest.mark.parametrize("device", sorted((ROOT / "tests/devices").iterdir()), ids=attrgetter("name"))
def test_any_device_has_a_row_for_each_point(device: Path) -> None:
    described = load_device(device / "device.yaml", Report())
    assert described is not None
    files = dict(site_files([described], (), "fieldscribe docs", render))
    assert [anchor for anchor, *_ in data(files["index.js"])[f"{described.id}.html"]] == [
        f"point={point.item}" for point in described.points
    ]
    assert "alert(" not in files["index.html"]
