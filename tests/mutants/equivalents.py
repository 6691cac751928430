"""Mutants that change nothing which can be seen, each with its reason.

`equivalent.jsonl` holds one of them a line: the language, the kind of file, the line before and after, and why. A line
is found again by its text, with the device's name as `{device}`, so that it survives regeneration.
"""

from __future__ import annotations

import json
import re
from pathlib import Path

from mutants.sources import Mutant

FILE = Path(__file__).parent / "equivalent.jsonl"

Named = dict[tuple[str, str, str, str], str]


def named() -> Named:
    """The reason of each, by language, kind, before and after."""
    rows = [json.loads(line) for line in FILE.read_text("utf-8").splitlines()]
    return {(row["language"], row["kind"], row["before"], row["after"]): row["reason"] for row in rows}


def entry(language: str, mutant: Mutant) -> tuple[str, str, str, str]:
    """What a mutant is called there."""
    return language, mutant.kind, _neutral(mutant.before, mutant.device), _neutral(mutant.after, mutant.device)


def _neutral(text: str, device: str) -> str:
    if not device:
        return text
    camel = "".join(part.title() for part in device.split("_"))
    return re.sub(rf"{device}|{device.upper()}|{camel}", "{device}", text)
