"""The comparison of a description with the second reading of its manual.

A description is transcribed from its manual once, and the manual is read a second time by other eyes: both say the same
facts in one schema (`readings/README.md`). What was settled between them is stored as settled, so here is no excuse: a
fact is equal or not.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from fieldscribe.diagnostics import Report
from fieldscribe.model import Device

from support.loaded_once import load_device
from support.places import ROOT
from support.second_reading_facts import Row, described, notes

READINGS = ROOT / "tests/readings"
READ_TWICE = sorted(path.stem for path in READINGS.glob("*.jsonl"))


@dataclass(frozen=True, slots=True)
class Difference:
    """One fact that a description and its reading do not have alike; None is what one of them does not have."""

    device: str
    row: str
    line: int | None
    fact: str
    described: object
    read: object

    def __str__(self) -> str:
        where = f"{self.device}: {self.row}, line {self.line} of the manual"
        return f"{where}: {self.fact}: the description says {_text(self.described)}, the reading {_text(self.read)}"


def differences(device_name: str, folder: Path) -> list[Difference]:
    """Where the description in a folder is not what its second reading says; empty if they agree in every fact."""
    report = Report()
    device = load_device(folder / "device.yaml", report)
    if device is None:
        return [Difference(device_name, "the description", None, "check", str(one), None) for one in report.findings]
    ours = {key(row): row for row in described(device)}
    theirs = {key(row): row for row in rows(device_name) if row["kind"] != "note"}
    found = [one for of in {**theirs, **ours} for one in _compared(device_name, of, ours.get(of), theirs.get(of))]
    return found + list(_unsaid(device_name, device))


def errata(folder: Path) -> set[str]:
    """What the description in a folder says of its manual."""
    device = load_device(folder / "device.yaml", Report())
    return {one.id for one in device.errata} if device else set()


def rows(name: str) -> list[Row]:
    """All rows of a reading."""
    return [json.loads(line) for line in (READINGS / f"{name}.jsonl").read_text("utf-8").splitlines()]


def key(row: Row) -> str:
    """What tells a row from the others."""
    dropped = {"kind", "facts", "settled"} if row["kind"] == "frame" else {"kind", "line", "facts", "settled"}
    told = {name: value for name, value in row.items() if name not in dropped}
    return " ".join([row["kind"], *(f"{name}={value}" for name, value in told.items() if value is not None)])


def _compared(device: str, of: str, ours: Row | None, theirs: Row | None) -> Iterator[Difference]:
    line = (theirs or ours or {})["line"]
    if ours is None or theirs is None:
        yield Difference(device, of, line, "the whole row", ours and ours["facts"], theirs and theirs["facts"])
        return
    if ours["line"] is not None and ours["line"] != theirs["line"]:
        yield Difference(device, of, line, "line", ours["line"], theirs["line"])
    for fact in {**theirs["facts"], **ours["facts"]}:
        said, read = ours["facts"].get(fact), theirs["facts"].get(fact)
        if said != read:
            yield from (Difference(device, of, line, *part) for part in _parts(fact, said, read))


def _parts(fact: str, said: object, read: object) -> Iterator[tuple[str, object, object]]:
    """The entries of a fact that differ, so that a message shows one of a hundred names."""
    if isinstance(said, dict) and isinstance(read, dict):
        for name in {**read, **said}:
            if said.get(name) != read.get(name):
                yield f"{fact} {name}", said.get(name), read.get(name)
    else:
        yield fact, said, read


def _unsaid(name: str, device: Device) -> Iterator[Difference]:
    """What the reading found said in words, and the description's note does not say."""
    said = notes(device)
    for row in rows(name):
        for phrase in row["facts"]["says"] if row["kind"] == "note" else ():
            if phrase not in said.get(row["of"], ""):
                yield Difference(name, f"note of {row['of']}", row["line"], "words", None, phrase)


def settled_wrongly(name: str, named: set[str]) -> list[str]:
    """What is said to be settled, but was read as it counts now, has no reason, or rests on an erratum that is none."""
    settled = [(row, fact, told) for row in rows(name) for fact, told in row.get("settled", {}).items()]
    wrong = [f"{key(row)}: {fact}" for row, fact, told in settled if told["read"] == row["facts"].get(fact)]
    wrong += [f"{key(row)}: {fact}: no reason" for row, fact, told in settled if not told["why"]]
    lists = [
        (key(row), ids) for row, _, told in settled for ids in re.findall(r"errat(?:um|a)( [\w, ]+|\))", told["why"])
    ]
    return wrong + [
        f"{of}: {one} is no erratum" for of, ids in lists for one in ids.split(", ") if one.strip() not in named
    ]


def unanswered(name: str, named: set[str]) -> list[str]:
    """Findings of the second reader without an erratum or a reason, and answers that name what is not there."""
    answers: dict[str, Any] = json.loads((READINGS / f"{name}_answers.json").read_text("utf-8"))
    text = (READINGS / f"{name}_findings.md").read_text("utf-8")
    numbers = re.findall(r"(?m)^(\d+)\. ", text)
    wrong = [f"{number}: no answer" for number in numbers if not answers.get(number)]
    wrong += [f"{number}: no finding" for number in answers if number not in numbers]
    told = {number: one for number, one in answers.items() if isinstance(one, list)}
    return wrong + [
        f"{number}: {one} is no erratum" for number, some in told.items() for one in some if one not in named
    ]


def _text(value: object) -> str:
    return "nothing" if value is None else json.dumps(value, ensure_ascii=False)
