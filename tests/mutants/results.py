"""Stored verdicts: one line of JSON for each mutant, in a folder that git ignores."""

from __future__ import annotations

import json
from pathlib import Path

from mutants.judges import Verdict


class Results:
    """The verdicts of one seed on one state of what is judged."""

    def __init__(self, file: Path) -> None:
        self.file = file
        file.parent.mkdir(parents=True, exist_ok=True)
        lines = file.read_text("utf-8").splitlines() if file.exists() else []
        self._known = dict(_entry(line) for line in lines if line.endswith("}"))

    def get(self, key: str) -> Verdict | None:
        """Return the verdict of an earlier run, if there is one."""
        return self._known.get(key)

    def put(self, key: str, verdict: Verdict) -> None:
        """Store a verdict at once, so that a run can be stopped anywhere."""
        self._known[key] = verdict
        with self.file.open("a", encoding="utf-8") as file:
            file.write(json.dumps({"key": key, "outcome": verdict.outcome, "by": verdict.by}) + "\n")


def _entry(line: str) -> tuple[str, Verdict]:
    data = json.loads(line)
    return data["key"], Verdict(data["outcome"], data["by"])
