"""When points exist: what follows from conditions is what trying all values shows."""

from __future__ import annotations

import random
from collections.abc import Mapping
from itertools import product
from pathlib import Path
from typing import Any

import pytest
from fieldscribe import wording
from fieldscribe.conditions import Comparison, Condition, Domain, ends_before, possible
from fieldscribe.export import export_model
from fieldscribe.language.formula.conditions import Comparison as Parsed
from fieldscribe.language.formula.conditions import parse_condition
from support.described import compile_in, described

DOMAINS: dict[str, Domain] = {"mode": ((0, 0), (2, 2), (5, 5)), "level": ((-3, 4),), "size": ("small", "large", "550")}
VALUES: dict[str, list[Any]] = {"mode": [0, 2, 5], "level": list(range(-3, 5)), "size": ["small", "large", "550"]}
EVERY = [dict(zip(VALUES, one, strict=True)) for one in product(*VALUES.values())]


def _comparison(chance: random.Random) -> Comparison:
    name = chance.choice(list(VALUES))
    if name == "size":
        return Comparison(name, chance.choice(("==", "!=")), (chance.choice(VALUES[name]),))
    test = chance.choice(("==", "!=", "<", "<=", ">", ">=", "in"))
    numbers = tuple([chance.randint(-5, 7) for _ in range(3 if test == "in" else 1)])
    return Comparison(name, test, numbers)


def test_possible_agrees_with_trying_all_values() -> None:
    """A clause can be true exactly if some values make it true."""
    for seed in range(400):
        chance = random.Random(seed)
        clause = tuple([_comparison(chance) for _ in range(chance.randint(1, 5))])
        tried = any(Condition((clause,)).holds(values) for values in EVERY)
        assert possible(clause, DOMAINS.__getitem__) == tried, seed


def _text(chance: random.Random, depth: int) -> str:
    if depth == 0:
        one = _comparison(chance)
        than = f"({', '.join(map(str, one.than))})" if one.test == "in" else f"{one.than[0]}"
        return f"{one.of} {one.test} {than}"
    if chance.random() < 0.3:
        return f"not ({_text(chance, depth - 1)})"
    word = chance.choice((" and ", " or "))
    return "(" + word.join(_text(chance, depth - 1) for _ in range(2)) + ")"


def _meant(one: Parsed) -> Any:
    return tuple([each.text if one.name.name == "size" else int(each.value) for each in one.constants])


def _python(text: str, values: Mapping[str, Any]) -> bool:
    names = {**values, "small": "small", "large": "large"}
    return bool(eval(text.replace(" 550", " '550'").replace("(550", "('550'"), {"__builtins__": {}}, names))


def test_clauses_are_true_when_the_text_is() -> None:
    """The condition of the author, as Python reads it, and its clauses agree for all values."""
    for seed in range(200):
        _means_what_it_says(_text(random.Random(seed), 3))


def _means_what_it_says(text: str) -> None:
    clauses: Any = tuple(
        tuple(Comparison(one.name.name, one.op, _meant(one)) for one in clause) for clause in parse_condition(text)
    )
    for values in EVERY:
        assert Condition(clauses).holds(values) == _python(text, values), (text, values)


@pytest.mark.parametrize(
    ("until", "since", "before"),
    [
        ("firmware 3.7", "firmware 3.8", True),
        ("firmware 3.9", "firmware 3.10", True),
        ("firmware 3.7", "firmware 3.7", False),
        ("firmware 3.7", "firmware 3.7.0", False),
        ("firmware 3.7", "firmware 3.7.1", True),
        ("Firmware  3.7", "firmware 3.8", True),
        ("firmware 3.7", "hardware 4", False),
        ("V2.1a", "V2.1b", True),
        ("V2.1", "v2.1a", True),
        ("the last one", "firmware 2", False),
        ("firmware 4", "firmware 3", False),
        ("2009", "2010", True),
        (None, "firmware 2", False),
    ],
)
def test_versions_are_compared_number_by_number(until: str | None, since: str | None, before: bool) -> None:
    """Number by number, of what counts the same."""
    assert ends_before(until, since) == before


POINTS = """\
- {name: mode, at: 0, enum: {0: off, 1: slow, 2: fast}}
- {name: level, at: 1, range: 0..100, scale: value = raw * 0.1, unit: V}
- {name: a, at: 10, when: mode == off}
- {name: b, at: 10, when: "mode in (1, 2) and level < 5"}
- {name: c, at: 10, when: mode != off and not level < 5}
- {name: d, at: 11, when: model == 550}
- {name: e, at: 11, when: model == 550x}
- {name: f, at: 11, variants: {model=large: {range: 0..3}}}
- {name: g, at: 12, until: firmware 2.9}
- {name: h, at: 12, since: firmware 2.10}
- {name: i, at: 13, bits: 3..0, when: mode == 0}
- {name: j, at: 13, bits: 7..2, when: mode > 0}
"""


def test_points_that_never_coexist_may_share_an_address(tmp_path: Path) -> None:
    """What is never there at once may stand at one address; the model has the conditions as structure."""
    variants = '{model: {title: Model, values: {"550": {}, 550x: {}, large: {}}}}'
    device, findings = compile_in(tmp_path, described(POINTS, variants=variants))
    assert findings == ()
    assert device is not None
    points = {point.name: point for point in device.points}
    assert [wording.condition_text(points[name].when, points) for name in "abcde"] == [
        "mode == off",
        "mode in (slow, fast) and level < 5",
        "mode != off and level >= 5",
        "model == 550",
        "model == 550x",
    ]
    assert wording.condition_text(points["b"].when) == "mode.raw in (1, 2) and level.raw < 50"
    exported: Any = export_model(device)
    assert exported["format"] == 7
    assert {one["name"]: one["when"] for one in exported["points"] if one["name"] in "bd"} == {
        "b": {"any": [{"all": [{"of": "mode", "is": "in", "than": [1, 2]}, {"of": "level", "is": "<", "than": 50}]}]},
        "d": {"any": [{"all": [{"of": "model", "is": "==", "than": "550"}]}]},
    }


VIEWS = """\
- {name: mode, at: 0, range: 0..9}
- {name: a, at: 1, when: model.phases >= 2}
- {name: b, at: 2, when: model.kind == pro}
- {name: c, at: 3, when: mode == 1 or mode == 2 and model == small}
- {name: d, at: 4, when: exists(a) and exists(c)}
- {name: e, at: 4, when: not exists(c) and exists(a)}
- {name: f, at: 5, variants: {model=large: {}, model=small: {}}}
- {name: g, at: 6, when: exists(f)}
- {name: h, at: 6, when: not exists(g)}
- {name: target, at: 7, cases: {speed: {when: mode == 1, unit: Hz}, torque: {when: "mode in (2, 3)", unit: V}}}
- {name: i, at: 8, when: exists(target_torque)}
- {name: j, at: 3, view_of: c}
- {name: exists, at: 9}
- {name: l, at: 11, since: firmware 1.2, when: mode == 1}
- {name: m, at: 12, since: firmware 1.10, when: exists(l)}
- {name: n, at: 13, when: "(not exists(c) or model == large) and mode == 1"}
- {name: k, at: 10, when: exists == 3}
"""


def test_existence_is_written_out_and_properties_name_variants(tmp_path: Path) -> None:
    """The condition of another point stands in place of `exists`, turned round behind `not`."""
    variants = "{model: {values: {large: {phases: 3, kind: pro}, small: {phases: 2h}, tiny: {phases: 1}}}}"
    device, findings = compile_in(tmp_path, described(VIEWS, variants=variants))
    assert findings == ()
    assert device is not None
    conditions = {point.item: wording.condition_text(point.when) for point in device.points if point.when}
    assert conditions == {
        "a": "model in (large, small)",
        "b": "model in (large)",
        "c": "mode.raw == 1 or mode.raw == 2 and model == small",
        "d": "model in (large, small) and mode.raw == 1 or "
        "model in (large, small) and mode.raw == 2 and model == small",
        "e": "mode.raw != 1 and mode.raw != 2 and model in (large, small) or "
        "mode.raw != 1 and model != small and model in (large, small)",
        "g": "model == large or model == small",
        "h": "model != large and model != small",
        "target_speed": "mode.raw == 1",
        "target_torque": "mode.raw in (2, 3)",
        "i": "mode.raw in (2, 3)",
        "k": "exists.raw == 3",
        "l": "mode.raw == 1",
        "m": "mode.raw == 1",
        "n": "model == large and mode.raw == 1",
    }
    units = {point.name: (point.unit.symbol, point.title["en"]) for point in device.points if "target" in point.name}
    assert units == {"target_speed": ("Hz", "Target (speed)"), "target_torque": ("V", "Target (torque)")}


@pytest.mark.parametrize("at", ["4112", "1010h", "0x1010", '"H\'1010"', "0b1000000010000"])
def test_a_formula_of_what_selects_knows_the_number_in_any_notation(at: str, tmp_path: Path) -> None:
    rows = f"- {{name: page, at: 0, line: 1}}\n- {{name: paged, at: {at}, line: 2, select: {{page: number / 257}}}}\n"
    device, findings = compile_in(tmp_path, described(rows))
    assert device is not None, findings
    assert device.points[1].selects == (("page", 16),)
