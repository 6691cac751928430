"""Whatever a stranger's file holds: findings or a device, never an exception, never out of memory or time."""

from __future__ import annotations

import json
import os
import time
from typing import TYPE_CHECKING, Any

import pytest
from fieldscribe.diagnostics import Report
from fieldscribe.pipeline import load_device, outputs
from fieldscribe.targets import TARGETS
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from support.described import DEVICES, compiled, described, loaded_in
from support.descriptions_as_values import BAD, HOSTILE, SINK, WHOLES, as_texts, changed, load_files, nodes, rewrite
from support.made_up import write_device

if TYPE_CHECKING:
    from pathlib import Path


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
FILE = (DEVICES / "kitchen_sink" / "scales.yaml").read_bytes()

WRONG: st.SearchStrategy[Any] = st.one_of(
    st.just(...),
    st.none(),
    st.booleans(),
    st.integers(-(10**70), 10**70),
    st.integers(-5, 70000),
    st.sampled_from(
        ["", " ", "0x", "1..2", "2..1", "0..65535", "raw", "value = raw", "raw = value * speed", "-1", "~", "a"]
    ),
    st.sampled_from(
        ["value = raw * 10 ** power_exponent", "0 | speed..1", "1e400", "9" * 64, "energy.raw", "base + 1"]
    ),
    st.sampled_from(
        ["f32", "u64", "bit", "s8", "low first", "none", "w", "holding", "coil", "on_off", "event", "mode == 0"]
    ),
    st.sampled_from(
        [
            "text",
            "parameter",
            "telegram",
            "xor 0..5",
            "multiplexer",
            "words",
            "739..732",
            "320h + unit",
            "P2000",
            "1..15",
        ]
    ),
    st.sampled_from(
        [{"number": 5, "sets": 2}, {"number": 2010, "indices": "0..1"}, {"count": 4, "enum": "switch2"}, {"3..0": 5}]
    ),
    st.text(max_size=12),
    st.lists(st.one_of(st.integers(), st.text(max_size=3)), max_size=3),
    st.dictionaries(
        st.sampled_from(["name", "en", "0", "1..0", "x-y", "at", "zz", "voltage=230V"]), st.text(max_size=5)
    ),
    st.sampled_from(HOSTILE),
)

CAREFUL = settings(
    deadline=None,
    max_examples=int(os.environ.get("FIELDSCRIBE_EXAMPLES", "50")),
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.function_scoped_fixture],
)


@pytest.mark.parametrize("device", WHOLES, ids=lambda one: one["device.yaml"][0]["device"])
def test_the_whole_device_is_fine(tmp_path: Path, device: dict[str, Any]) -> None:
    """What the mutations start from has no errors."""
    assert load_files(tmp_path / "device", device).findings == ()


@CAREFUL
@given(st.lists(st.tuples(st.sampled_from(PATHS), WRONG), min_size=1, max_size=4))
def test_wrong_values_anywhere(tmp_path: Path, changes: list[tuple[tuple[Any, tuple[Any, ...]], Any]]) -> None:
    """Values of wrong types, wrong numbers and missing keys at any place are findings."""
    device = changes[0][0][0]
    for (_, path), wrong in changes:
        try:
            device = changed(device, path, wrong)
        except (KeyError, IndexError, TypeError, ValueError):
            continue  # an earlier change took the place away
    for one in load_files(tmp_path / "device", device).findings:
        assert one.message.isprintable()
        assert one.hint


@CAREFUL
@given(st.lists(st.tuples(st.integers(0, len(FILE) - 1), st.integers(0, 255)), min_size=1, max_size=6), st.booleans())
def test_bytes_flipped(tmp_path: Path, flips: list[tuple[int, int]], drop: bool) -> None:
    """Any bytes anywhere, or lines taken away."""
    data = bytearray(FILE)
    for place, byte in flips:
        data[place % len(data)] = byte
    if drop:
        lines = bytes(data).split(b"\n")
        for place, _ in flips:
            del lines[place % len(lines)]
        data = bytearray(b"\n".join(lines))
    head = (
        (DEVICES / "kitchen_sink" / "device.yaml").read_text("utf-8").replace("types.yaml, scales.yaml", "scales.yaml")
    )
    (tmp_path / "scales.yaml").write_bytes(bytes(data))
    for name in ("bus", "shared", "ranges", "names", "repeats", "bits", "printed", "words"):
        (tmp_path / f"{name}.yaml").write_bytes((DEVICES / "kitchen_sink" / f"{name}.yaml").read_bytes())
    load_text(tmp_path, head)


@CAREFUL
@given(st.binary(max_size=200), st.integers(0, max(1, len(TEXTS) - 400)))
def test_any_text(tmp_path: Path, noise: bytes, start: int) -> None:
    """Noise, and pieces of descriptions with noise in them."""
    load_text(tmp_path, noise)
    load_text(tmp_path, TEXTS[start : start + 200] + noise + TEXTS[start + 200 : start + 400])


_FREE = {
    "en",
    "de",
    "fr",
    "vendor",
    "model",
    "code",
    "section",
    "since",
    "until",
    "why",
    "where",
    "taken",
    "edition",
} | {*("quantity", "x-note", "title", "note", "timing")}


@pytest.mark.full(seconds=0.2)
@pytest.mark.parametrize("start", WHOLES, ids=lambda one: one["device.yaml"][0]["device"])
@pytest.mark.parametrize("text", HOSTILE, ids=range(len(HOSTILE)))
def test_hostile_texts_compile(tmp_path: Path, text: str, start: dict[str, Any]) -> None:
    """Any text in every free-text field compiles, and no target stumbles over it."""
    device = start
    paths = [path for holder, path in PATHS if holder is start]
    for path in paths:
        if path[-1] not in _FREE or ("errata" in path and path[-1] == "taken"):
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


@pytest.mark.full(seconds=25)
def test_rows_cannot_explode(tmp_path: Path) -> None:
    """A thousand rows of four thousand points each end in a finding."""
    rows = ",\n".join(f"{{name: a{row}, at: 1, sets: 64, indices: 64}}" for row in range(1000))
    group = "group: a\nspace: holding\naddressing: number\nsource: {document: manual, section: x}"
    texts = {**as_texts(SINK), "words.yaml": f"{group}\npoints: [{rows}]"}
    started = time.process_time()
    _, findings = compiled(rewrite(tmp_path / "device", texts))
    rules = {one.rule for one in findings}
    assert "too-many-items" in rules
    assert time.process_time() - started < 60


def test_aliases_cannot_explode(tmp_path: Path) -> None:
    """Nine levels of nine aliases each end in a finding, quickly."""
    lines = ["x-0: &a0 [x, x, x, x, x, x, x, x, x]"]
    lines += [f"x-{level}: &a{level} [{', '.join([f'*a{level - 1}'] * 9)}]" for level in range(1, 12)]
    started = time.process_time()
    rules = {one.rule for one in load_text(tmp_path, "\n".join(lines)).findings}
    assert rules == {"yaml-size"}
    assert time.process_time() - started < 1


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
    """A hundred thousand unknown keys cost no more than the thousand that are told."""
    text = "\n".join(f"unknown_key_{number}: 1" for number in range(100_000))
    started = time.process_time()
    assert len(load_text(tmp_path, text).findings) == 1001  # the last one says that there are more
    assert time.process_time() - started < 5


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
