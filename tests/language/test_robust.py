"""Whatever a stranger's file holds: findings or a device, never an exception, never out of memory or time."""

from __future__ import annotations

import json
import os
import time
from pathlib import Path
from typing import Any

import pytest
from fieldscribe.diagnostics import MOST_FINDINGS, Report
from fieldscribe.pipeline import load_device, load_outline, outputs
from fieldscribe.resolve import expand
from fieldscribe.targets import TARGETS
from fuzz.descriptions import mutant, trial
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from support.described import compiled, described, loaded_in
from support.descriptions_as_values import BAD, HOSTILE, SINK, WHOLES, as_texts, changed, nodes, rewrite
from support.made_up import write_device


def load_text(tmp_path: Path, text: str | bytes) -> Report:
    """What the compiler finds in a text."""
    file = tmp_path / "device.yaml"
    file.write_bytes(text if isinstance(text, bytes) else text.encode("utf-8", "surrogatepass"))
    report = Report()
    device = load_device(file, report)
    assert (device is None) == report.has_errors
    return report


PATHS = [(device, path) for device in WHOLES for path in sorted(nodes(device), key=str)]
TEXTS = b"".join(file.read_bytes() for file in sorted(BAD.glob("[a-f]*.yaml"))[::6])
MUTANTS = int(os.environ.get("FIELDSCRIBE_MUTANTS", "80"))
PARTS = 8
SEED = 20261122

CAREFUL = settings(suppress_health_check=[HealthCheck.too_slow, HealthCheck.function_scoped_fixture])


@pytest.mark.parametrize(
    "part", [0, 1, *(pytest.param(part, marks=pytest.mark.full(seconds=4)) for part in range(2, PARTS))]
)
def test_mutants_end_in_findings_or_compile_for_every_target(part: int, tmp_path: Path) -> None:
    """Wrong values at every key, quoted numbers, values of other places, lines and characters changed, aliases."""
    for index in range(part, MUTANTS, PARTS):
        file = rewrite(tmp_path / "device", mutant(SEED, index))
        assert trial(file, compiled=True) is None, f"mutant({SEED}, {index})"


@CAREFUL
@given(st.binary(max_size=200), st.integers(0, max(1, len(TEXTS) - 400)))
def test_any_text(tmp_path: Path, noise: bytes, start: int) -> None:
    """Noise, and pieces of descriptions with noise in them."""
    load_text(tmp_path, noise)
    load_text(tmp_path, TEXTS[start : start + 200] + noise + TEXTS[start + 200 : start + 400])


_FREE = "en de fr vendor model code section since until why where taken edition quantity x-note title note timing"


@pytest.mark.full(seconds=0.2)
@pytest.mark.parametrize("start", WHOLES, ids=lambda one: one["device.yaml"][0]["device"])
@pytest.mark.parametrize("text", HOSTILE, ids=range(len(HOSTILE)))
def test_hostile_texts_compile(tmp_path: Path, text: str, start: dict[str, Any]) -> None:
    """Any text in every free-text field compiles, and no target stumbles over it."""
    device = start
    paths = [path for holder, path in PATHS if holder is start]
    for path in paths:
        if path[-1] not in _FREE.split() or ("errata" in path and path[-1] == "taken"):
            continue
        if path[-1] == "code" and start is not SINK:
            continue  # formulas and frames name points by their codes
        before = device
        for key in path:
            before = before[key]
        if isinstance(before, str):
            limit = 30 if path[-1] in ("code", "since", "until", "edition", "quantity") else 190
            short = text[:limit] + (str(paths.index(path)) if path[-1] == "code" else "")
            device = changed(device, path, short)
    device = json.loads(json.dumps(device).replace('"S01"', '"speed"'))
    loaded, findings = compiled(rewrite(tmp_path / "device", as_texts(device)))
    assert findings == ()
    assert loaded is not None
    for _, name, made in outputs(loaded, TARGETS):
        assert name.isascii()
        assert ".." not in name
        assert "\x1b" not in made
        assert "\x00" not in made
        assert "\u202e" not in made


def test_rows_cannot_explode(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of hundreds of rows of four thousand points each, those beyond the limit are not expanded."""
    monkeypatch.setattr(expand, "MOST_POINTS", expand.MOST_POINTS // 20)
    expanded: list[str] = []
    expand_row = expand._point

    def noted(scope: Any, group: Any, point: Any) -> Any:
        expanded.append(point["name"])
        return expand_row(scope, group, point)

    monkeypatch.setattr(expand, "_point", noted)
    rows = ",\n".join(f"{{name: many_{row}, at: 1, sets: 64, indices: 64}}" for row in range(400))
    group = "group: a\nspace: holding\naddressing: number\nsource: {document: manual, section: x}"
    texts = {**as_texts(SINK), "words.yaml": f"{group}\npoints: [{rows}]"}
    _, findings = compiled(rewrite(tmp_path / "device", texts))
    assert "too-many-items" in {one.rule for one in findings}
    assert [name for name in expanded if name.startswith("many_")] == ["many_0", "many_1"]


@pytest.mark.parametrize("opening", ["[", "{a: ", "- ", "? ", "[{a: "])
def test_nesting_ends_in_a_finding(tmp_path: Path, opening: str) -> None:
    """Ten megabytes of nesting end in a finding, quickly."""
    started = time.process_time()
    found = load_text(tmp_path, opening * (10_000_000 // len(opening))).findings
    assert [one.rule for one in found] in (["yaml-depth"], ["yaml-key"], ["yaml-syntax"])
    assert time.process_time() - started < 5


def test_a_huge_file_is_refused_unread(tmp_path: Path) -> None:
    """Files beyond the limit are not parsed."""
    assert [one.rule for one in load_text(tmp_path, b"#" * (17 << 20)).findings] == ["file-too-large"]


def test_many_errors_stay_quick(tmp_path: Path) -> None:
    """Twenty thousand unknown keys cost no more than the thousand that are told."""
    text = "\n".join(f"unknown_key_{number}: 1" for number in range(20_000))
    started = time.process_time()
    assert len(load_text(tmp_path, text).findings) == 1001  # the last one says that there are more
    assert time.process_time() - started < 1.5


def test_values_beyond_the_last_finding_reach_no_later_stage(tmp_path: Path) -> None:
    """The shape of a file is checked up to the limit of findings, and no further stage takes what follows."""
    rows = "".join(f"- {{name: p{n}, at: {n}, type: text, characters: x}}\n" for n in range(MOST_FINDINGS + 1))
    assert len(load_text(tmp_path, described(rows)).findings) == MOST_FINDINGS + 1
    assert load_outline(tmp_path / "device.yaml", Report()) is None


@pytest.mark.full(seconds=2)
def test_long_chains_do_not_recurse(tmp_path: Path) -> None:
    """More points than Python has frames, each of which needs the next one, end in findings or a device."""
    for facts in ("range: 0..p{next}.raw", "scale: raw = value * p{next}"):
        points = [f"- {{name: p{n}, at: {n}, {facts.format(next=(n + 1) % 1500)}}}\n" for n in range(1500)]
        started = time.process_time()
        load_text(tmp_path, described("".join(points)))
        assert time.process_time() - started < 5


@pytest.mark.full(seconds=4)
def test_cost_grows_with_the_points(tmp_path: Path) -> None:
    """Ten times the points take about ten times the time."""
    seconds = []
    for count in (500, 5000):
        file = write_device(tmp_path / str(count), count)
        best = []
        for _ in range(2):
            report, started = Report(), time.process_time()
            assert load_device(file, report) is not None, report.findings
            best.append(time.process_time() - started)
        seconds.append(min(best))
    assert seconds[1] < 25 * seconds[0]


def test_a_factor_that_can_only_be_zero_is_a_device(tmp_path: Path) -> None:
    """Every value is then an error at run time, and no number is too large for it."""
    points = """\
- {name: ratio, at: 1, range: 0..0}
- {name: power, at: 2, type: s64, scale: value = raw / ratio}
- {name: force, at: 6, type: s64, scale: value = raw * ratio}
"""
    assert len(loaded_in(tmp_path, described(points)).points) == 3
