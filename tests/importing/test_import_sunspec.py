"""`import sunspec`: models to the description of a device, what is not carried, and files that are no models."""

from __future__ import annotations

import json
import os
from itertools import count
from pathlib import Path
from typing import Any

import pytest
from fieldscribe.cli import main
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from support.places import ROOT

FOLDER, OURS = (Path(__file__).parent / name for name in ("sunspec", "models"))


DRAFTS = {
    FOLDER / "inverter": ["--models", "1,103,160"],
    FOLDER / "curves": ["--models", "707", "--most", "2"],
    FOLDER / "curves_of_four": ["--models", "707", "--count", "NPt=4", "--most", "3", "--exponents", "4"],
    FOLDER / "all_types": ["--models", "63001"],
    OURS / "facts": ["--most", "2"],
    OURS / "counts": ["--models", "63101", "--most", "3", "--count", "M=2", "--count", "N=1", "--count", "W=4"],
}
"""The drafts beside the models, with the options that they are made with."""


@pytest.mark.parametrize("device", DRAFTS, ids=lambda device: device.name)
def test_models_become_a_device(device: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """FIELDSCRIBE_ACCEPT=1 writes the drafts; look at the difference."""
    assert main(["import", "sunspec", str(device.parent), "--device", device.name, *DRAFTS[device]]) == 0
    draft, report = capsys.readouterr()
    path = device.with_suffix(".draft")
    if os.environ.get("FIELDSCRIBE_ACCEPT"):
        path.write_text(f"{draft}# {report}", "utf-8")
    assert f"{draft}# {report}" == path.read_text("utf-8")


def point(**facts: Any) -> dict[str, Any]:
    return {"name": "A", "type": "uint16", "size": 1, **facts}


def model(*points: dict[str, Any], **facts: Any) -> dict[str, Any]:
    return {"id": 7, "group": {"name": "model", "type": "group", "points": points, **facts}}


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "is no JSON"),
        (b"[" * 100_000, "is no JSON"),
        (b"\xff\xfe\x00", "is no JSON"),
        (b'{"id": ' + b"9" * 5_000 + b"}", "is no JSON"),
        (b"[]", "`id` is missing"),
        (b'{"id": 70000, "group": {}}', "`id` is 70000"),
        (b'{"id": true, "group": {}}', "`id` is `True`"),
        (model(point(size="1")), "`size` of `A` is `1`"),
        (model(point(), count=-1), "`count` is -1"),
        (model(point(symbols=[{"name": "A"}])), "`value` of `A` is missing"),
        ({"id": 1, "group": {"name": "x", "points": {}}}, "`points` of `x` is `{}`"),
        (model(), "has no points"),
        (model(*[point()] * 5_001), "more than 5000 points and groups"),
        (model(groups=[model(groups=[model()["group"]] * 80)["group"]] * 80), "more than 5000 points and groups"),
    ],
)
def test_what_is_no_model_ends_in_a_message(
    content: bytes | dict[str, Any], message: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "model_7.json"
    path.write_bytes(content if isinstance(content, bytes) else json.dumps(content).encode())
    assert main(["import", "sunspec", str(path)]) == 1
    assert message in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--models", "1,2"], "there is no model 2"),
        (["--models", "1;2"], "are no numbers of models"),
        (["--count", "4"], "is no number of elements"),
        (["--base", "modicon"], "--base is for `import table`"),
    ],
)
def test_wrong_calls(words: list[str], message: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["import", "sunspec", str(FOLDER), *words]) in (1, 2)
    assert message in capsys.readouterr().err


def test_a_folder_without_models(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["import", "sunspec", str(tmp_path)]) == 1
    assert "there is no model" in capsys.readouterr().err


def test_two_files_of_one_model(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for name in ("model_7.json", "model_07.json"):
        (tmp_path / name).write_text(json.dumps(model(point())), "utf-8")
    assert main(["import", "sunspec", str(tmp_path)]) == 1
    assert "model_07.json and model_7.json both are model 7" in capsys.readouterr().err


def test_the_page(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What the page prints is what the commands print."""
    out = tmp_path / "inverter" / "device.yaml"
    options = [*DRAFTS[FOLDER / "inverter"], "--device", "inverter", "--out", str(out)]
    assert main(["import", "sunspec", str(FOLDER), *options]) == 0
    assert main(["check", str(out)]) == 0
    printed = capsys.readouterr()
    page = (ROOT / "descriptions/language/importing.md").read_text("utf-8")
    assert printed.err in page
    assert printed.out in page


NASTY = (
    *("", "A", "a", "W_SF", "class", "if", "{x}", "# c", "- x", "\0", "\u202e", "'", '"', "on", "~", "1", "²"),
    "x" * 400,
)
TEXTS = st.one_of(st.sampled_from(NASTY), st.text(max_size=8))
NAMES_OF_TYPES = """
int16 uint16 int32 uint64 acc16 acc32 acc64 enum16 enum32 bitfield16 bitfield32 bitfield64 float32 float64 string
sunssf ipaddr ipv6addr eui48 pad count raw16 what
"""
TYPES = st.sampled_from(NAMES_OF_TYPES.split())
SYMBOLS = st.fixed_dictionaries(
    {"name": TEXTS, "value": st.sampled_from([-1, 0, 1, 15, 16, 31, 63, 64, 65535, 1 << 70])},
    optional={"label": TEXTS, "desc": TEXTS},
)
POINTS = st.fixed_dictionaries(
    {"name": TEXTS, "type": TYPES, "size": st.sampled_from([0, 1, 1, 2, 2, 4, 8, 150, 65535])},
    optional={
        "label": TEXTS,
        "desc": TEXTS,
        "units": st.one_of(TEXTS, st.sampled_from(["V", "Secs", "% VRef"])),
        "sf": st.one_of(TEXTS, st.integers(-12, 12)),
        "access": st.sampled_from(["R", "RW", "X"]),
        "mandatory": st.sampled_from(["M", "O"]),
        "static": st.sampled_from(["S", "D"]),
        "symbols": st.lists(SYMBOLS, max_size=4),
        "comments": st.lists(TEXTS, max_size=2),
    },
)
GROUPS: st.SearchStrategy[dict[str, Any]] = st.recursive(
    st.fixed_dictionaries({"name": TEXTS, "points": st.lists(POINTS, max_size=5)}),
    lambda inner: st.fixed_dictionaries(
        {
            "name": TEXTS,
            "points": st.lists(POINTS, max_size=5),
            "count": st.one_of(TEXTS, st.sampled_from([0, 1, 2, 3, 65535])),
            "groups": st.lists(inner, max_size=3),
        }
    ),
    max_leaves=4,
)
NUMBERS = count()


@pytest.mark.full(seconds=1)
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow])
@given(GROUPS)
def test_a_draft_compiles(tmp_path: Path, capsys: pytest.CaptureFixture[str], group: dict[str, Any]) -> None:
    folder = tmp_path / str(next(NUMBERS))
    folder.mkdir()
    group["points"].append(point())
    (folder / "model_7.json").write_text(json.dumps({"id": 7, "group": group}), "utf-8")
    out = folder / "device.yaml"
    assert main(["import", "sunspec", str(folder), "--out", str(out)]) == 0, capsys.readouterr().err
    assert main(["check", str(out)]) == 0, capsys.readouterr().out + out.read_text("utf-8")
