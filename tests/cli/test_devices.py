"""Which descriptions a command is about: paths, ids, variants, what is here and what is shipped; and `check`."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from fieldscribe.cli.common import description_paths
from fieldscribe.resources import descriptions_dir
from support.described import write
from support.small_drive import DEVICE, MAIN, Output

pytestmark = pytest.mark.usefixtures("loads_once")

OWN = """fieldscribe: 1
device: hitachi_l200
version: 7.0.0
vendor: Example
model: Own
title: Own
family: modbus
documents: {manual: {title: Own, language: en}}
bus: {framings: [rtu], units: 1..247, functions: {03h: read_holding_registers}}
---
group: main
access: r
space: holding
source: {document: manual, section: "1"}
points:
- {name: own, at: 1}
"""
CONDITIONS = """\
- {name: mode, title: {en: Mode}, at: 17h, enum: {0: local, 1: remote}}
- {name: cascade, title: {en: Cascade}, at: 18h, range: 0..100, when: size == large and mode == remote}
- {name: simple, title: {en: Simple}, at: 19h, range: 0..100, when: size == small}
- {name: double, title: {en: Double}, at: 19h, range: 0..200, when: size == large}
"""


def test_check(run: Callable[..., Output], small: Path) -> None:
    assert run("check") == (0, "small_drive: 4 points (4 generated) in 1 group, 0 errata, 0 printed frames\n", "")
    data = json.loads(run("check", "--format", "json").out)
    assert (data["findings"], data["devices"][0]["points"]) == ([], 4)
    (small / "main.yaml").write_text(MAIN.replace("at: 12h", "at: 10h"), "utf-8")
    wrong = run("check")
    assert wrong.code == 1
    for part in (" --> descriptions/small_drive/main.yaml:9:", "^", "1 error in 1 file"):
        assert part in wrong.out
    assert json.loads(run("check", "--format", "json").out)["findings"][0]["line"] == 9
    assert json.loads(run("explain", "small_drive", "P1", "--format", "json").out)["findings"]


def test_check_and_generate_find_the_same_device_twice(run: Callable[..., Output], small: Path) -> None:
    write(small.parent / "second", DEVICE, main=MAIN)
    for words in (("check",), ("generate", "--target", "docs", "--list-outputs")):
        told = run(*words)
        assert told.code == 1, words
        assert "duplicate-device" in told.out + told.err
        assert "described twice in this run, first in descriptions/second/device.yaml" in told.out + told.err
    assert run("check").out.count("4 points") == 1


def test_without_paths_the_device_of_the_working_folder_is_taken(
    run: Callable[..., Output], small: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(small)
    assert run("check").out.startswith("small_drive: ")
    listed = run("generate", "--target", "docs", "--list-outputs")
    assert (listed.code, "docs/small_drive.md" in listed.out) == (0, True)
    assert "hitachi" not in listed.out


def test_a_part_is_no_device(run: Callable[..., Output], small: Path) -> None:
    """There is one finding, not one for each key that a device has."""
    told = run("check", str(small / "device.yaml"), str(small / "main.yaml"))
    assert told.code == 1
    for part in ("`main.yaml` is a part of a description", "name device.yaml beside it", "1 error in 1 file"):
        assert part in told.out


def test_device_arguments(run: Callable[..., Output], small: Path, tmp_path: Path) -> None:
    for device in ("small_drive", "descriptions/small_drive", str(small / "device.yaml")):
        assert run("explain", device, "P1").out.startswith("P1 speed: Speed\n")
    assert run("explain", "hitachi_l200", "A020").code == 0
    (tmp_path / "empty").mkdir()
    write(small.parent / "other", DEVICE)
    for words, message in (
        (["small_drve"], "did you mean `small_drive`?"),
        (["P1", "--descriptions", str(tmp_path / "none")], "there is no folder"),
        (["hitachi_l200", "--descriptions", "descriptions"], "there is no device"),
        (["empty"], "holds no device.yaml"),
        (["descriptions"], "holds 2 devices"),
        (["x" * 5000], "name too long"),
    ):
        told = run("explain", *words, "P1")
        assert (told.code, told.out) == (2, "")
        assert message in told.err or message.title() in told.err.title()
    assert run("check", "empty").code == 1


def test_without_descriptions_the_shipped_ones_are_taken(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """A message says so; ./descriptions and ./device.yaml come first."""
    monkeypatch.chdir(tmp_path)
    assert description_paths([]) == [descriptions_dir()]
    assert capsys.readouterr().err == (
        "there is no folder descriptions here: these are the devices that come with fieldscribe\n"
    )
    (tmp_path / "descriptions").mkdir()
    assert description_paths([]) == description_paths([Path("descriptions")]) == [Path("descriptions")]
    (tmp_path / "device.yaml").touch()
    assert description_paths([]) == [Path("device.yaml")]
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize("folder", ["hitachi_l200", "descriptions/hitachi_l200"])
def test_a_device_that_is_here_comes_before_a_shipped_one(
    folder: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, run: Callable[..., Output]
) -> None:
    write(tmp_path / folder, OWN)
    monkeypatch.chdir(tmp_path)
    for command in (
        "explain hitachi_l200 own",
        "generate hitachi_l200 --list-outputs --target docs",
        "check hitachi_l200",
        "list hitachi_l200",
        "search Own --device hitachi_l200",
        f"diff hitachi_l200 {folder}",
    ):
        told = run(*command.split())
        assert told.code == 0, command
        assert "Frequenzumrichter" not in told.out + told.err
    assert json.loads(run("export", "json", "hitachi_l200").out)["version"] == "7.0.0"
    assert "7.0.0" in run("list").out


def test_a_folder_without_a_description_hides_no_device(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, run: Callable[..., Output]
) -> None:
    (tmp_path / "hitachi_l200").mkdir()
    monkeypatch.chdir(tmp_path)
    for command in ("check hitachi_l200", "explain hitachi_l200 A020"):
        assert run(*command.split()).code == 0


def test_what_the_chosen_variant_does_not_have_is_refused(run: Callable[..., Output], small: Path) -> None:
    """The message names the condition, in every command that takes variants."""
    (small / "main.yaml").write_text(MAIN.replace("TITLE", "Speed") + CONDITIONS, "utf-8")
    condition = "it exists only when size == large and mode == remote"
    encode, chosen = ("encode", "small_drive", "cascade", "10", "--frame"), ("--variant", "size=small")
    frame = run(*encode).out.strip()
    assert run(*encode, "--variant", "size=large").out.strip() == frame
    for words in (encode, ("explain", "small_drive", "wire:0x18")):
        refused = run(*words, *chosen)
        assert (refused.code, refused.out) == (1, "")
        assert f"cascade: {condition}" in refused.err
    decoded = run("decode", "small_drive", frame, *chosen)
    assert (decoded.code, f"Cascade; {condition}" in decoded.out) == (1, True)
    assert run("decode", "small_drive", frame).code == 0
    assert condition in run("decode", "small_drive", "01 03 00 18 00 01 04 0D", *chosen).out
    assert run("explain", "small_drive", "cascade").code == 0


def test_of_points_at_one_address_the_chosen_variant_has_one(run: Callable[..., Output], small: Path) -> None:
    (small / "main.yaml").write_text(MAIN.replace("TITLE", "Speed") + CONDITIONS, "utf-8")
    frame = run("encode", "small_drive", "wire:0x19", "10", "--frame", "--variant", "size=small").out.strip()
    decoded = run("decode", "small_drive", frame, "--variant", "size=small")
    assert decoded.code == 0
    assert "simple = 10" in decoded.out
    assert "double" not in decoded.out
    assert "double" not in run("explain", "small_drive", "wire:0x19", "--variant", "size=small").out


def test_limits_of_an_unknown_scale_stay_values(run: Callable[..., Output], small: Path) -> None:
    """They have no raw numbers, so nothing may round them."""
    point = "- {name: slope, title: {en: Slope}, at: 30h, unit: Hz, range_in_units: 0.4..2.6, scale: ~}\n"
    (small / "main.yaml").write_text(MAIN + point, "utf-8")
    assert "0.4..2.6 Hz" in run("list", "small_drive").out
    explained = run("explain", "small_drive", "slope").out
    assert "Range          0.4..2.6 Hz\n" in explained
    assert "Raw range" not in explained
    points = json.loads(run("export", "json", "small_drive").out)["points"]
    assert points[-1]["raw"]["ranges"] == [["0.4", "2.6"]]
    run("docs", "small_drive", "--format", "csv", "--out", "tables")
    assert ",0.4,2.6," in Path("tables/small_drive.csv").read_text("utf-8")
