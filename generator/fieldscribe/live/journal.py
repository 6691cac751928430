"""The journal of a restore: a line before and after each write, on the disk before the next step.

Whatever ends a restore, the journal tells what was written: the next start reads it.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, NamedTuple

from fieldscribe.safe_files import read_regular
from fieldscribe.text import line

_MOST_BYTES = 32 << 20


class Interrupted(NamedTuple):
    """A restore that did not end: when and on which device, what was written, what perhaps was, and what was not."""

    started: str
    device: str
    written: list[str]
    perhaps: list[str]
    left: list[str]

    def lines(self) -> Iterator[str]:
        """Yield the same as text."""
        yield f"the restore of {self.started} to {self.device} did not end"
        for what, names in (("written", self.written), ("perhaps written", self.perhaps), ("not written", self.left)):
            if names:
                yield f"{what}: {', '.join(names)}"


class Journal:
    """The journal of a restore that runs. `names` are what it writes, in order."""

    def __init__(self, path: Path, names: list[str], facts: dict[str, Any]) -> None:
        """Begin behind what the file has of earlier ones. Raises OSError."""
        self._stream = path.open("a", encoding="utf-8")
        if self._stream.tell():
            self._stream.write("\n")  # the last line of one that was killed may have no end
        started = datetime.now(UTC).isoformat(timespec="seconds")
        self._note({"started": started, **facts, "writes": names})

    def begin(self, number: int, **facts: Any) -> None:
        """Note that a write comes next; `facts` are what the point held before, and what it gets."""
        self._note({"begin": number, **facts})

    def done(self, number: int) -> None:
        """Note that the device has it."""
        self._note({"done": number})

    def refused(self, number: int, why: str) -> None:
        """Note that the device did not take it."""
        self._note({"refused": number, "why": why})

    def end(self) -> None:
        """Note that all is done."""
        self._note({"ended": datetime.now(UTC).isoformat(timespec="seconds")})

    def close(self) -> None:
        """Close the file."""
        self._stream.close()

    def _note(self, facts: dict[str, Any]) -> None:
        self._stream.write(json.dumps(facts) + "\n")
        self._stream.flush()
        os.fsync(self._stream.fileno())


def interrupted(path: Path) -> Interrupted | None:
    """Return the last restore of a journal, if it did not end; None if it did, and without a journal.

    A line that was not written whole counts as missing. Raises OSError.
    """
    try:
        lines = read_regular(path, _MOST_BYTES).data.decode("utf-8", "replace").split("\n")
    except FileNotFoundError:
        return None
    notes: list[dict[str, Any]] = []
    for note in _notes(lines):
        notes = [note] if "writes" in note else [*notes, note]
    if not notes or "writes" not in notes[0] or "ended" in notes[-1]:
        return None
    head = notes[0]
    names = [line(str(name)) for name in head["writes"]]
    states = {note[key]: key for note in notes for key in ("begin", "done", "refused") if type(note.get(key)) is int}
    of = {
        state: [name for number, name in enumerate(names) if states.get(number) in keys]
        for state, keys in (("written", ("done",)), ("perhaps", ("begin",)), ("left", (None, "refused")))
    }
    device = f"{head.get('device')}, unit {head.get('unit')}, {head.get('line')}"
    return Interrupted(line(str(head.get("started"))), line(device), **of)


def _notes(lines: list[str]) -> Iterator[dict[str, Any]]:
    """Yield the lines that are whole."""
    for text in lines:
        try:
            note = json.loads(text)
        except (ValueError, RecursionError):
            continue
        if isinstance(note, dict):
            yield note
