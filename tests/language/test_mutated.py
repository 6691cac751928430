"""Descriptions changed at random places: whatever `check` makes of them, what passes it compiles for every target.

Seeded and bounded; `FIELDSCRIBE_MUTANTS=20000` asks for more of the same row.
"""

from __future__ import annotations

import os
import random
from typing import TYPE_CHECKING, Any

import pytest
from fieldscribe.diagnostics import Report
from fieldscribe.pipeline import load_device, outputs
from fieldscribe.targets import TARGETS
from support.descriptions_as_values import WHOLES, as_texts, as_yaml, changed, nodes, rewrite

if TYPE_CHECKING:
    from pathlib import Path

MUTANTS = int(os.environ.get("FIELDSCRIBE_MUTANTS", "80"))
PARTS = 8

WRONG: tuple[Any, ...] = (
    *(None, True, -1, 0, 1, 2, 7, 8, 15, 16, 17, 31, 32, 64, 127, 247, 255, 256, 731, 4096, 65535, 65536, 1 << 31),
    *(-(1 << 63), 1 << 64, 10**40, "", " ", "-1", "256", "0", "1", "300..301", "0..5", "5..0", "-5..5", "1..", "..1"),
    *("0FFh", "FFFFh", "1.5", "-0.1", "1e9", "1e-9", "4E20", "0b11", "u64", "s64", "f32", "f64", "s8", "u8", "bit"),
    *("text", "r", "w", "rw", "none", "high first", "low first", "value = raw * 0.001", "raw = value * 3 / 7 + 2"),
    *("value = raw / 65536", "value = raw * 10 ** 12", "value = -raw", "raw", "mode == 0", "mode == 0 and mode == 1"),
    *("voltage == 230V", "speed > 3", "firmware 2.0", "always", "never", "choice", "yes", "no", "latin-1", "xor 0..5"),
    *("name", "unit", "address", "raw_min", "class", "a", "self", "ok", "status", "P0731", "request", "cyclic"),
    *([], {}, [1], ["0"], [1, 2, 3], ["1..3"], {"0": "a"}, {"0": "a", "1": "b"}, {"3..0": "a"}, {"name": "x"}),
    *({"number": 5}, {"number": 5, "sets": 2}, {"number": 731, "indices": "0..1"}, {"en": "x"}, {"de": "y", "en": "x"}),
)
"""Values of every type that some key takes, and that most do not."""


def mutant(seed: int) -> dict[str, str]:
    """The texts of one device, with one to three places changed; in every second one the value of another stands."""
    chance = random.Random(seed)
    start = WHOLES[seed % len(WHOLES)]
    device = start
    paths = sorted(nodes(start), key=str)
    for _ in range(chance.randint(1, 3)):
        path = chance.choice(paths)
        new = chance.choice(WRONG) if chance.random() < 0.5 else _at(start, chance.choice(paths))
        quoted = chance.random() < 0.2 and isinstance(new, int)
        try:
            device = changed(device, path, ... if chance.random() < 0.1 else str(new) if quoted else new)
        except (KeyError, IndexError, TypeError, ValueError):
            continue  # an earlier change took the place away
    return as_texts(device)


def aliased(seed: int) -> dict[str, str]:
    """The texts of one device in which a value stands at two places of a file, the second time as an alias."""
    chance = random.Random(seed)
    files: dict[str, Any] = WHOLES[seed % len(WHOLES)]
    name = chance.choice(sorted(files))
    (start,) = files[name]
    paths = [path for path in nodes(start) if isinstance(_at(start, path), dict | list)]
    places = sorted(range(len(paths)), key=lambda _: chance.random())[:2]
    first, second = (paths[place] for place in sorted(places))
    if first == second[: len(first)]:
        return as_texts(files)
    mark, other = "\x01first\x01", "\x01second\x01"
    text = as_yaml(changed(changed(start, second, other), first, mark))
    value = as_yaml(_at(start, first))
    return {**as_texts(files), name: text.replace(as_yaml(mark), f"&a {value}").replace(as_yaml(other), "*a ")}


def _at(value: Any, path: tuple[Any, ...]) -> Any:
    for key in path:
        value = value[key]
    return value


def _compiles(texts: dict[str, str], folder: Path) -> bool:
    """Whether it passes `check`; then every target can do it."""
    report = Report()
    device = load_device(rewrite(folder / "device", texts), report)
    assert (device is None) == report.has_errors
    for one in report.findings:
        assert one.message.isprintable()
        assert one.hint
    for _ in () if device is None else outputs(device, TARGETS):
        pass
    return device is not None


@pytest.mark.parametrize("part", range(PARTS))
def test_mutants(part: int, tmp_path: Path) -> None:
    """Wrong types at every key, quoted numbers, values of other places: findings, or files."""
    for seed in range(part, MUTANTS, PARTS):
        try:
            _compiles(mutant(seed), tmp_path)
        except Exception as error:
            raise AssertionError(f"mutant({seed})") from error


@pytest.mark.parametrize("part", range(2))
def test_aliases_from_everywhere_to_everywhere(part: int, tmp_path: Path) -> None:
    """A value that is right at one place stands at another one."""
    for seed in range(part, MUTANTS // 2, 2):
        try:
            _compiles(aliased(seed), tmp_path)
        except Exception as error:
            raise AssertionError(f"aliased({seed})") from error
