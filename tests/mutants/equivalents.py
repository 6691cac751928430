"""Mutants that change nothing which can be seen, each with its reason.

`equivalent.jsonl` holds one of them a line: the language, the kind of file, the line before and after, and why. A line
is found again by its text, with the device's name as `{device}`, so that it survives regeneration. Where many lines
are equivalent for one reason, a rule says so for all of them.
"""

from __future__ import annotations

import json
import re
from functools import cache
from pathlib import Path

from mutants.sources import Mutant

FILE = Path(__file__).parent / "equivalent.jsonl"

Named = dict[tuple[str, str, str, str], str]


_ROWS_IN_ANY_ORDER = re.compile(r"(?:modbusBlock|Block|Block::new)\(.*\),")
"""A read of a group: all of them bring the same words in any order."""
_POWER = re.compile(r"(power(?:: |=)-)[1-9]\d*(?=, f32|[ )])")
"""A divisor, of which only the sign of the power is asked; not that of a power of ten."""


def is_equivalent(language: str, mutant: Mutant) -> bool:
    """Whether a mutant is named, or falls under a rule."""
    before, after = _neutral(mutant.before, mutant.device), _neutral(mutant.after, mutant.device)
    rows, others = before.split(" / "), after.split(" / ")
    reordered = sorted(rows) == sorted(others) and all(map(_ROWS_IN_ANY_ORDER.fullmatch, rows))
    powers = language != "generator" and _POWER.sub(r"\g<1>1", before) == _POWER.sub(r"\g<1>1", after)
    return reordered or powers or (language, mutant.kind, before, after) in named()


@cache
def named() -> Named:
    """The reason of each, by language, kind, before and after."""
    rows = [json.loads(line) for line in FILE.read_text("utf-8").splitlines()]
    return {(row["language"], row["kind"], row["before"], row["after"]): row["reason"] for row in rows}


def _neutral(text: str, device: str) -> str:
    if not device:
        return text
    camel = "".join(part.title() for part in device.split("_"))
    return re.sub(rf"{device}|{device.upper()}|{camel}", "{device}", text)
