"""A family is one folder and one line: `toy_family/` beside this, entered into the registry, and nothing else."""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest
from fieldscribe import targets
from fieldscribe.families import family
from support.described import group, head, together, write
from support.models import sample_device
from support.places import TESTS

HERE = TESTS
WITH_BELLS = (
    "from fieldscribe.families import FAMILIES; FAMILIES['bell'] = 'toy_family'; "
    "from fieldscribe.cli import main; import sys; sys.exit(main(sys.argv[1:]))"
)
DEVICE = together(
    head(
        device="carillon",
        family="bell",
        documents="{manual: {title: The manual, language: en}}",
        bus="{units: 1..4, strikes: 90, source: {section: Line}}",
        frames="[{name: ring_low, bytes: 31 42, says: {low: 1}, line: 7}]",
    ),
    group(
        "- {name: high, at: 0, line: 3}\n- {name: low, at: 1, range: 0..9, line: 4}\n",
        group="tones",
        title="Tones",
        space="tone",
        source="{section: Tones}",
        access="w",
        type="u16",
    ),
)


def run(folder: Path, *words: str) -> subprocess.CompletedProcess[str]:
    """The command line, with bells in the registry."""
    command = [sys.executable, "-c", WITH_BELLS, *words]
    return subprocess.run(
        command, cwd=folder, env={"PYTHONPATH": str(HERE)}, capture_output=True, text=True, check=False
    )


def described(folder: Path, text: str = DEVICE) -> Path:
    """A folder with the description of a carillon."""
    write(folder / "carillon", text)
    return folder


def test_docs_and_vectors(tmp_path: Path) -> None:
    made = run(described(tmp_path), "generate", "carillon", "--target", "docs,vectors", "--out", "out")
    assert (made.returncode, made.stderr) == (0, "")
    page = (tmp_path / "out/docs/carillon.md").read_text("utf-8")
    assert "| Strikes in a minute | 90 |" in page
    vectors = (tmp_path / "out/vectors/carillon.txt").read_text("utf-8").splitlines()
    assert "kind\tstrike\t2\tunit:int\ttone:int\tbytes:bytes" in vectors
    assert {"limit\tstrikes\t90", "strike\t1\t0\t3141", "strike\t1\t1\t3142"} <= set(vectors)


def test_targets_that_do_not_know_it(tmp_path: Path) -> None:
    refused = run(described(tmp_path), "generate", "carillon", "--target", "c,docs", "--out", "out")
    assert refused.returncode == 1
    assert "the target c does not know the family bell; nothing of carillon was written" in refused.stderr
    assert not (tmp_path / "out/docs").exists()


def test_findings_of_the_family(tmp_path: Path) -> None:
    foreign = run(described(tmp_path, DEVICE.replace("space: tone", "space: coil")), "check", "carillon")
    assert (foreign.returncode, "unknown-space" in foreign.stdout) == (1, True)
    wrong = DEVICE.replace("strikes: 90", "strikes: 2000").replace("31 42", "31 42 0A")
    write(tmp_path / "carillon", wrong)
    told = run(tmp_path, "check", "carillon").stdout
    assert "too-many-strikes" in told
    assert "this rings nothing" in told


@pytest.mark.full(seconds=1)
def test_what_people_ask(tmp_path: Path) -> None:
    folder = described(tmp_path)
    assert "space tone" in run(folder, "explain", "carillon", "low").stdout
    assert "raw 5" in run(folder, "encode", "carillon", "low", "5").stdout
    assert "frames of the family bell are not known here" in run(folder, "decode", "carillon", "31 42").stderr
    exported = json.loads(run(folder, "export", "json", "carillon").stdout)
    assert (exported["family"], exported["points"][1]["space"]) == ("bell", "tone")


def test_a_description_starts_with_it(tmp_path: Path) -> None:
    words = ("--family", "bell", "--vendor", "Example", "--model", "B 1", "--title", "Chimes")
    assert run(tmp_path, "init", "chimes", *words).returncode == 0
    assert run(tmp_path, "check", "chimes").stdout == (
        "chimes: 1 point (1 generated) in 1 group, 0 errata, 1 printed frame\n"
    )


def test_a_part_that_is_missing_is_none_and_one_that_breaks_says_so(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "choir/targets").mkdir(parents=True)
    for name, text in {
        "__init__": "",
        "notes": "HIGHEST = 81",
        "frame_decoder": "import nowhere_at_all",
        "targets/c": "",
    }.items():
        (tmp_path / f"choir/{name}.py").write_text(text, "utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    choir = replace(family("modbus"), folder="choir")
    assert choir.part("notes").HIGHEST == 81
    assert (choir.part("frames"), choir.part("bus_facts"), choir.part("checks.one")) == (None, None, None)
    with pytest.raises(ModuleNotFoundError, match="nowhere_at_all"):
        choir.part("frame_decoder")
    list(map(targets.target, targets.TARGETS))  # modules keep the function that is there when they are first imported
    monkeypatch.setattr("fieldscribe.families.family", lambda _: choir)
    knowing = {name: targets.knows(name, sample_device()) for name in targets.TARGETS}
    known = {"c": True, "python": False, "rust": False, "typescript": False, "docs": True, "vectors": True}
    assert {name: knowing[name] for name in known} == known
