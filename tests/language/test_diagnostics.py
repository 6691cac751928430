"""Findings as people and machines see them."""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import pytest
from fieldscribe import pipeline
from fieldscribe.cli import main
from fieldscribe.diagnostics import (
    MOST_FINDINGS,
    Diagnostic,
    Report,
    Span,
    as_data,
    as_lines,
    columns,
    split_lines,
    summary,
    visible,
)
from fieldscribe.model import Device
from fieldscribe.output import generation
from fieldscribe.pipeline import TargetError
from support.described import described, write

FILES = {
    "a.yaml": ["fieldscribe: 1", "points:", "- {name: x, at: 1028h}", "- {name: y, at: 1028h}"],
    "long.yaml": ["x" * 5000 + "HERE" + "y" * 5000],
    "wide.yaml": ["title: 温度 bad"],
    "hostile.yaml": ["title: \x1b[31mred\u202e bad"],
    "tab.yaml": ["\tbad"],
}


def _read(name: str) -> Sequence[str] | None:
    return FILES.get(name)


def _text(*findings: Diagnostic) -> list[str]:
    return ["".join(piece for _, piece in one) for one in as_lines(findings, _read)]


def test_a_finding_in_full() -> None:
    one = Diagnostic(
        "address-overlap",
        "`y` is at the address of `x`",
        Span("a.yaml", 4, 16, 5),
        "say so with `bits`",
        ((Span("a.yaml", 3, 16, 5), "`x` is here"),),
    )
    assert _text(one) == [
        "error[address-overlap]: `y` is at the address of `x`",
        " --> a.yaml:4:16",
        "4 | - {name: y, at: 1028h}",
        "  |                ^^^^^",
        " ::: a.yaml:3:16: `x` is here",
        "3 | - {name: x, at: 1028h}",
        "  |                ^^^^^",
        "  = hint: say so with `bits`",
        "",
    ]


@pytest.mark.parametrize(
    "span", [Span("none.yaml", 1, 1), Span("a.yaml", 99, 1), Span("a.yaml", 0, 0), Span("a.yaml", 1, 900, 50)]
)
def test_places_that_are_not_there(span: Span) -> None:
    lines = _text(Diagnostic("x", "m", span))
    assert lines[0] == "error[x]: m"


def test_long_lines_are_cut_around_the_place() -> None:
    lines = _text(Diagnostic("x", "m", Span("long.yaml", 1, 5001, 4)))
    assert len(lines[2]) < 140
    at = lines[3].index("^")
    assert lines[2][at : at + 4] == "HERE"
    assert lines[3].count("^") == 4


@pytest.mark.parametrize(
    ("size", "column", "shown"),
    [
        (70, 1, "a" * 70),
        (71, 1, "a" * 60 + " ..."),
        (120, 51, "a" * 120),
        (121, 52, "... " + "a" * 110),
        (131, 51, "a" * 110 + " ..."),
        (200, 101, "... " + "a" * 100 + " ..."),
    ],
)
def test_a_line_is_cut_forty_characters_before_and_sixty_behind(size: int, column: int, shown: str) -> None:
    """But not for the sake of ten more, which the dots would take up again."""
    lines = [
        "".join(piece for _, piece in one)
        for one in as_lines([Diagnostic("x", "m", Span("a", 1, column))], {"a": ["a" * size]}.get)
    ]
    assert lines[2] == f"1 | {shown}"
    assert lines[3] == "  | " + " " * (column - 1 if column <= 51 else 44) + "^"


def test_marks_stand_below_wide_characters() -> None:
    lines = _text(Diagnostic("x", "m", Span("wide.yaml", 1, 11, 3)))
    assert columns(lines[3][: lines[3].index("^")]) == columns(lines[2][: lines[2].index("bad")])


def test_nothing_in_a_file_reaches_the_terminal() -> None:
    lines = _text(Diagnostic("x", "odd \x1b]0;title\x07", Span("hostile.yaml", 1, 17, 3), "\u2066hint"))
    text = "\n".join(lines)
    assert "\x1b" not in text
    assert "\u202e" not in text
    assert "\u2066" not in text
    assert "<U+001B>[31mred<U+202E> bad" in lines[2]


def test_tabs_have_a_width() -> None:
    lines = _text(Diagnostic("x", "m", Span("tab.yaml", 1, 2, 3)))
    assert lines[2].index("bad") == lines[3].index("^")


def test_visible_keeps_what_is_seen() -> None:
    assert visible("Größe °C 温度") == "Größe °C 温度"
    assert visible("a\udc80\x7f\u2028") == "a<U+DC80><U+007F><U+2028>"


def test_summary() -> None:
    report = Report()
    assert summary(report) == ""
    report.warning("x", "m", Span("a", 1, 1))
    report.warning("x", "n", Span("a", 1, 1))
    assert summary(report) == "2 warnings"
    report.error("x", "m", Span("a", 1, 1))
    assert summary(report) == "1 error in 1 file; 2 warnings"
    report.error("x", "m", Span("b", 1, 1))
    report.error("x", "n", Span("b", 1, 1))
    assert summary(report) == "3 errors in 2 files; 2 warnings"


def test_data() -> None:
    (one,) = as_data([Diagnostic("x", "m", Span("a", 1, 2, 3), None, ((Span("b", 4, 5), "there"),))])
    assert one == {
        "rule": "x",
        "severity": "error",
        "message": "m",
        "file": "a",
        "line": 1,
        "column": 2,
        "width": 3,
        "hint": None,
        "related": [{"message": "there", "file": "b", "line": 4, "column": 5, "width": 1}],
    }


def test_a_report_keeps_findings_in_order_and_each_once() -> None:
    """By file and place; nothing that a terminal obeys gets into them, and a hint is not needed."""
    report = Report()
    report.error("b", "later\nline", Span("a", 2, 1), "do\x1b this", [(Span("b", 1, 1), "there")])
    report.warning("c", "odd", Span("a", 1, 9))
    assert (report.has_errors, report.count) == (True, 2)
    report.error("a", "sooner", Span("a", 1, 9))
    report.error("a", "sooner", Span("a", 1, 9))
    assert report.findings == (
        Diagnostic("a", "sooner", Span("a", 1, 9), None, (), "error"),
        Diagnostic("c", "odd", Span("a", 1, 9), None, (), "warning"),
        Diagnostic("b", "later line", Span("a", 2, 1), "do this", ((Span("b", 1, 1), "there"),), "error"),
    )
    warned = Report()
    warned.warning("c", "odd", Span("a", 1, 9), "what\u202e now")
    assert not warned.has_errors
    assert [finding.hint for finding in warned.findings] == ["what now"]


def test_errors_beyond_the_limit_are_counted_and_checks_may_stop() -> None:
    report = Report()
    for number in range(MOST_FINDINGS):
        assert not report.full
        report.error("a", f"{number}", Span("a", 1, 1))
    assert report.full
    assert report.findings[-1].message == "checking stopped at 1000 errors: there may be more"
    for number in (1, MOST_FINDINGS, MOST_FINDINGS, MOST_FINDINGS + 1):
        report.error("a", f"{number}", Span("a", 2 if number >= MOST_FINDINGS else 1, 1))
    assert (report.findings[-1].message, report.findings[-1].span.line) == ("2 more errors are not shown", 2)
    assert summary(report) == "1002 errors in 1 file"


def test_warnings_never_drop_an_error() -> None:
    """Each level has its own limit, and each report: what is added to a run of many devices is never lost."""
    device, run = Report(), Report()
    for number in range(MOST_FINDINGS + 1):
        device.warning("a", f"{number}", Span("a", 1, 1))
    assert not device.full
    run.extend(device)
    run.error("b", "wrong", Span("b", 1, 1))
    run.warning("b", "odd", Span("b", 1, 1))
    assert run.has_errors
    assert [finding.message for finding in run.findings[-3:]] == ["wrong", "odd", "1 more warning is not shown"]
    assert (run.count, summary(run)) == (MOST_FINDINGS + 3, "1 error in 1 file; 1002 warnings")
    renamed = run.in_files(lambda name: f"x/{name}")
    assert (renamed.count, renamed.has_errors) == (run.count, True)


@pytest.mark.parametrize(("fails", "form"), [("description", "json"), ("target", "text")])
def test_a_failing_device_is_told_behind_a_thousand_warnings(
    fails: str, form: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Exit code 0 means that every device asked for was written."""
    rows = [f"- {{name: p{at}, at: {at}, scale: value = raw * 0.00610352}}\n" for at in range(MOST_FINDINGS + 100)]
    write(tmp_path / "a_many", described("".join(rows), device="a_many"))
    write(tmp_path / "b_fails", described("- {name: p, at: 0}\n", device="b_fails"))
    if fails == "description":
        with (tmp_path / "b_fails" / "device.yaml").open("a") as file:
            file.write("- {name: q, at: 0, range: 5..1}\n")
    else:
        original = pipeline.outputs

        def outputs(device: Device, *arguments: Any) -> Iterator[tuple[str, str, str]]:
            if device.id == "b_fails":
                raise TargetError("c") from ValueError("broken")
            return original(device, *arguments)

        monkeypatch.setattr(generation, "outputs", outputs)
    out = tmp_path / "out"
    code = main(["generate", str(tmp_path), "--target", "c", "--out", str(out), "--format", form])
    said = "".join(capsys.readouterr())
    assert code == 1
    assert "range-reversed" in said if fails == "description" else "internal-error" in said
    assert "100 more warnings are not shown" in said
    assert not list(out.rglob("b_fails*"))


def test_a_further_place_is_told_but_not_to_whom_it_happened() -> None:
    report, elsewhere = Report(), (Span("a", 3, 1), "used here")
    report.error("a", "here", Span("a", 3, 1, 5))
    report.error("a", "there", Span("a", 1, 1), related=[(Span("b", 1, 1), "first")])
    related = [finding.related for finding in report.with_place(*elsewhere).findings]
    assert related == [((Span("b", 1, 1), "first"), elsewhere), ()]


def test_lines_are_counted_as_yaml_counts_them() -> None:
    assert split_lines("a\r\nb\rc\nd\x85e\u2028f\x0cg") == ["a", "b", "c", "d", "e", "f\x0cg"]


def test_thousands_of_findings_are_quick() -> None:
    findings = [Diagnostic("x", f"m{n}", Span("long.yaml", 1, n + 1, 4), "hint") for n in range(5000)]
    started = time.perf_counter()
    assert sum(1 for _ in as_lines(findings, _read)) == 30000
    assert time.perf_counter() - started < 2
