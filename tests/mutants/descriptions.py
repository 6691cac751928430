"""Mutants of the descriptions: one fact of a random point is another, and somebody should notice.

Judged by `fieldscribe check`, by `fieldscribe audit` (it reports something that it did not report before), both as they
are run, and by the comparison with the second reading of the manual, in a copy of the descriptions.
"""

from __future__ import annotations

import contextlib
import importlib
import io
import json
import os
import random
import shutil
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from support.places import has_text

from mutants.children import StoppedError, in_child
from mutants.fact_changes import Edits, changes_of, siblings
from mutants.facts import Description, Fact, Point, read
from mutants.judges import KILLED, ROOT, SURVIVED, Verdict
from mutants.sources import TRIES, Mutant

SHARED = 0.25
_KEPT = ("fieldscribe", "yaml", "second_reading")
"""What forked judges need not import again."""
LIMIT = 60
"""Seconds after which a check is taken to hang."""


def drawn_facts(folder: Path, seed: str) -> Iterator[Mutant]:
    """Different mutants: a device, a point of it, a key of the point, a fact below the key, a change of the fact.

    A device counts by the root of its points and a key by the root of its facts; what a group says for all of its
    points (space, access, numbering) is drawn less often than what a point says for itself.
    """
    chance = random.Random(f"{seed} descriptions")
    devices = [read(path.parent) for path in sorted(folder.glob("*/device.yaml"))]
    weights = [len(one.points) ** 0.5 for one in devices]
    seen: set[str] = set()
    tries = 0
    while tries < TRIES:
        device = chance.choices(devices, weights)[0]
        mutant = _mutant(device, chance)
        tries += 1
        if mutant is not None and mutant.key not in seen:
            seen.add(mutant.key)
            tries = 0
            yield mutant


def _mutant(device: Description, chance: random.Random) -> Mutant | None:
    point = chance.choice(device.points)
    weights = [len(facts) ** 0.5 if key in point.own else SHARED for key, facts in point.facts.items()]
    key = chance.choices(list(point.facts), weights)[0]
    fact = chance.choice(point.facts[key])
    changes = changes_of(fact, _neighbours(device, point, fact), _used(device))
    return _changed(device, point, key, fact.path, chance.choice(changes)) if changes else None


def _neighbours(device: Description, point: Point, fact: Fact) -> list[Fact]:
    """Facts that could be taken for this one: of the same point, or the name of another point in the file."""
    if fact.keys == ("name",):
        return [one.facts["name"][0] for one in device.points if one.facts["name"][0].path == fact.path]
    return siblings(fact, point)


def _used(device: Description) -> dict[str, list[str]]:
    used: dict[str, list[str]] = {}
    for point in device.points:
        for some in point.facts.values():
            for fact in some:
                used.setdefault(fact.keys[-1], []).append(fact.text)
    return used


def _changed(device: Description, point: Point, key: str, path: str, edits: Edits) -> Mutant:
    before = text = device.texts[path]
    for start, end, after in sorted(edits, reverse=True):
        text = text[:start] + after + text[end:]
    pairs = [
        (number, old, new)
        for number, (old, new) in enumerate(zip(before.split("\n"), text.split("\n"), strict=True), 1)
        if old != new
    ]
    shown = " / ".join(old.strip() for _, old, _ in pairs), " / ".join(new.strip() for _, _, new in pairs)
    return Mutant(key, device.device, path, pairs[0][0] if pairs else 0, *shown, f"{point.name}: {key}", text)


class DescriptionJudge:
    """A copy of the descriptions, in which one file is changed."""

    def __init__(self, work: Path) -> None:
        self.work, self.folder = work, work / "descriptions"
        self.manuals = Path(os.environ["FIELDSCRIBE_MANUALS"]).resolve()
        shutil.rmtree(work, ignore_errors=True)
        shutil.copytree(ROOT / "descriptions", self.folder)
        self.readings = [
            *sorted((ROOT / "tests/support").glob("second_reading*.py")),
            *sorted((ROOT / "tests/readings").iterdir()),
        ]
        self.audits = {path.parent.name: self._first(path.parent.name) for path in self.folder.glob("*/device.yaml")}

    def _first(self, device: str) -> set[str]:
        """What the audit reports without a change; all else passes. What this imports is imported here."""

        def work(tell: Callable[[Any], None]) -> None:
            os.chdir(self.work)
            reported = sorted(_audited(device, self.manuals))
            noticed = _check(device) or _second_reading(device)
            modules = [name for name in sys.modules if name.startswith(_KEPT)]
            tell({"reported": reported, "noticed": noticed, "modules": modules})

        (told,) = in_child(work, LIMIT)
        assert not told["noticed"], f"it is noticed without a change: {device}"
        for module in told["modules"]:
            with contextlib.suppress(ImportError):
                importlib.import_module(module)
        return set(told["reported"])

    def verdict(self, mutant: Mutant) -> Verdict:
        """The first that notices."""
        changed, device = self.folder / mutant.path, mutant.device
        judges: dict[str, Callable[[], bool]] = {
            "check": lambda: _check(device),
            "audit": lambda: bool(_audited(device, self.manuals) - self.audits[device]),
            "second reading": lambda: _second_reading(device),
        }
        changed.write_text(mutant.text, encoding="utf-8")
        try:
            by = next((name for name, judge in judges.items() if _noticed(judge, self.work)), None)
        finally:
            shutil.copyfile(ROOT / "descriptions" / mutant.path, changed)
        return Verdict(SURVIVED, "") if by is None else Verdict(KILLED, by)


def _noticed(judge: Callable[[], bool], folder: Path) -> bool:
    """Run a judge in a process of its own, so that no module remembers another mutant; a crash notices it too."""

    def work(tell: Callable[[Any], None]) -> None:
        os.chdir(folder)
        tell({"noticed": judge()})

    try:
        return bool(in_child(work, LIMIT)[0]["noticed"])
    except StoppedError:
        return True


def _check(device: str) -> bool:
    return _fieldscribe("check", f"descriptions/{device}")[0] != 0


def _audited(device: str, manuals: Path) -> set[str]:
    """Everything that the audit reports, each as text; nothing without the manual's text."""
    if not has_text(device, manuals):
        return set()
    _, said = _fieldscribe("audit", f"descriptions/{device}", "--manual", str(manuals), "--format", "json")
    data = json.loads(said)
    return {f"{name} {json.dumps(one)}" for name, found in data.items() if isinstance(found, list) for one in found}


def _fieldscribe(*words: str) -> tuple[int, str]:
    from fieldscribe.cli import main

    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        code = main(list(words))
    return code, said.getvalue()


def _second_reading(device: str) -> bool:
    """Whether the description is not what the second reading of its manual says."""
    from support.second_reading import differences

    return bool(differences(device, Path("descriptions", device)))
