"""The measuring of mutants (`make mutants`) changes what it should, the same in each run, and sees what survives."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import pytest
from mutants.batches import blamed, body_around, switched
from mutants.changes import Change, places_of
from mutants.children import BROKE_DOWN, StoppedError, in_child
from mutants.equivalents import FILE, is_equivalent, named
from mutants.judges import KILLED, LEFT_OUT, SURVIVED, Command, OfC
from mutants.sources import Mutant, Source, mutant_of, sources_of
from mutants.table import MARKS
from support.places import TESTS
from support.toolchains import tool

C = """\
/* 1 head */
#ifndef X_H
extern "C" {
#define X_COUNT 3U /* 4 of them */
static const uint16_t rows[] = {
    {0x0AU, true},
    {0x0BU, false}
};
enum {
    X_OK,
    X_BAD = 1
};
static inline int x(uint16_t words[2], int a)
{
    if (a < 5 && words[0]) {
        a = -1;
        return X_BAD;
    }
    puts("name", "a text");
    return X_OK;
}
#if defined(NO_FLOAT)
#endif
"""
PYTHON = '''\
"""Docs 1."""
from typing import Literal
Choice = Literal["230V"]
T = TypeVar("T")
@wrapped(1, frozen=True)
class A:
    """More 2."""
    size: int = 3
    def take(self, key: "A") -> bool:
        if key is not None:
            self.key = key
            raise KeyError("text 4 of it")
        return True and "name" in self
'''
RUST = """\
//! Docs 1.
#[must_use]
pub const SIZE: u16 = 0x0F_u16;
pub fn next<'a>(raw: &'a u8) -> Option<u8> {
    if *raw == 2 {
        return Some(raw | 1);
    }
    match raw {
        0 => Error::Low,
        1 => Error::High,
    }
}
#[cfg(test)]
mod tests { const A: u8 = 9; }
"""


def edits(language: str, text: str, what: str) -> set[tuple[str, str]]:
    """What is changed to what."""
    return {
        (text[one.start : one.end], one.after) for place in places_of(language, text).get(what, ()) for one in place
    }


def test_numbers_change_but_for_comments_and_sizes_of_parameters() -> None:
    changed = {before for before, _ in edits("c", C, "number")}
    assert changed == {"3U", "0x0AU", "0x0BU", "1", "5", "0"}
    assert edits("c", "int a = 0x0AU;", "number") == {("0x0AU", f"0x{n:02X}U") for n in (0, 2, 9, 11, 14)}
    assert {before for before, _ in edits("python", PYTHON, "number")} == {"3"}
    assert {before for before, _ in edits("rust", RUST, "number")} == {"0x0F_u16", "2", "1", "0"}


def test_operators_truth_and_conditions_change() -> None:
    assert edits("c", C, "operator") == {("<", "<="), ("&&", "||"), ("-", "")}
    assert edits("c", C, "truth") == {("true", "false"), ("false", "true")}
    assert edits("c", C, "condition") == {("a < 5 && words[0]", "0"), ("a < 5 && words[0]", "1")}
    assert edits("rust", RUST, "condition") == {("*raw == 2", "false"), ("*raw == 2", "true")}
    assert edits("python", PYTHON, "condition") == {("key is not None", "False"), ("key is not None", "True")}


def test_statements_names_and_neighbours_change() -> None:
    assert edits("c", C, "statement") == {("a = -1;", ";"), ('puts("name", "a text");', ";")}
    assert {before for before, _ in edits("python", PYTHON, "statement")} == {
        "self.key = key",
        'raise KeyError("text 4 of it")',
    }
    assert edits("c", C, "name in a string") == {('"name"', '"namx"'), ('"name"', '"ame"')}
    assert edits("python", PYTHON, "name in a string") == {('"name"', '"namx"'), ('"name"', '"ame"')}
    assert edits("c", C, "named constant") == {("X_OK", "X_BAD"), ("X_BAD", "X_OK")}
    assert edits("rust", RUST, "named constant") == {("Low", "High"), ("High", "Low")}
    assert edits("rust", RUST, "neighbours") == {("0 => Error::Low,\n        1", "1 => Error::Low,\n        0")}
    assert ("0x0AU, true},\n    {0x0BU", "0x0BU, true},\n    {0x0AU") in edits("c", C, "neighbours")


def test_each_equivalent_has_a_reason_and_a_language() -> None:
    assert FILE.is_file()
    for (language, kind, before, after), reason in named().items():
        assert language in MARKS
        assert kind
        assert before != after
        assert len(reason) > 20


READS = 'modbusBlock("holding", 0x03, 0x1140, 2),', 'modbusBlock("holding", 0x03, 0x1143, 2),'


@pytest.mark.parametrize(
    ("before", "after", "expected"),
    [
        (" / ".join(READS), " / ".join(reversed(READS)), True),
        (" / ".join(READS), " / ".join((READS[1], READS[1])), False),
        ('{"one", 1}, / {"two", 2},', '{"two", 2}, / {"one", 1},', False),
        ('factor("gain", { power: -1, f32: true })', 'factor("gain", { power: -2, f32: true })', True),
        ('Factor("gain", power=-1)', 'Factor("gain", power=-5)', True),
        ('Factor("gain", power=-1)', 'Factor("gain", power=-0)', False),
        ('Factor("gain", power=-1, ten_to=(-3, 3))', 'Factor("gain", power=-2, ten_to=(-3, 3))', False),
    ],
)
def test_reads_in_another_order_and_larger_powers_are_equivalent(before: str, after: str, *, expected: bool) -> None:
    mutant = Mutant("points", "", "dev.py", 1, before, after, "number", "")
    assert is_equivalent("python", mutant) == expected


@pytest.fixture
def base(tmp_path: Path) -> Path:
    """The output of a device whose vectors look at one of two constants."""
    (tmp_path / "base/c/conformance").mkdir(parents=True)
    (tmp_path / "base/vectors").mkdir()
    (tmp_path / "base/python/dev").mkdir(parents=True)
    (tmp_path / "base/python/dev/points.py").touch()
    (tmp_path / "base/vectors/dev.txt").touch()
    (tmp_path / "base/c/dev.h").write_text("#define DEV_A 1\n#define DEV_B 2\n", encoding="utf-8")
    program = '#include "../dev.h"\nint main(void) { return DEV_A == 1 && DEV_B ? 0 : 1; }\n'
    (tmp_path / "base/c/conformance/dev_conformance.c").write_text(program, encoding="utf-8")
    return tmp_path / "base"


def test_a_mutant_that_vectors_see_is_killed_and_one_that_they_do_not_survives(base: Path, tmp_path: Path) -> None:
    tool("gcc")
    (source,) = sources_of("c", base)
    judge = OfC(base, tmp_path / "work")
    verdicts = {
        change.after: judge.verdict(mutant_of(source, change)).outcome
        for change in (Change("number", 14, 15, "4"), Change("number", 30, 31, "3"), Change("number", 30, 31, "("))
    }
    assert verdicts == {"4": KILLED, "3": SURVIVED, "(": LEFT_OUT}
    assert (tmp_path / "work/c/c/dev.h").read_text("utf-8") == source.text


CHOICES = """\
#ifndef DEV_H
#define DEV_H
static int dev_a(int raw)
{
    return raw + 1;
}
static int dev_b(int raw)
{
    if (raw > 4) {
        raw = 4;
    }
    return raw * 2;
}
static const int dev_c = 3;
#endif
"""


class CountingBuilds(OfC):
    """Counts the programs that it builds."""

    count = 0

    def built(self, device: str, build: Sequence[str]) -> Command:
        self.count += 1
        return super().built(device, build)


def test_mutants_of_functions_are_built_and_judged_together(base: Path, tmp_path: Path) -> None:
    """Those that do not compile, or change no function, are judged alone: six mutants took six programs before."""
    tool("gcc")
    (base / "c/dev.h").write_text(CHOICES, encoding="utf-8")
    program = '#include "../dev.h"\nint main(void) { return dev_a(1) == 2 && dev_b(2) == 4 && dev_c == 3 ? 0 : 1; }\n'
    (base / "c/conformance/dev_conformance.c").write_text(program, encoding="utf-8")
    (source,) = sources_of("c", base)
    judge = CountingBuilds(base, tmp_path / "work")
    edits = [("+ 1", "+ 2"), ("+ 1", "+ (1"), ("raw > 4", "raw > 5"), ("* 2", "* 3"), ("* 2", "<< 1"), ("= 3", "= 5")]
    starts = [source.text.index(before) for before, _ in edits]
    changes = [Change("x", start, start + len(one[0]), one[1]) for start, one in zip(starts, edits, strict=True)]
    mutants = [mutant_of(source, change) for change in changes]
    found = dict(judge.verdicts(mutants))
    outcomes = [found[one].outcome for one in mutants]
    assert outcomes == [KILLED, LEFT_OUT, SURVIVED, KILLED, SURVIVED, KILLED]
    assert (tmp_path / "work/c/c/dev.h").read_text("utf-8") == source.text
    assert judge.count == 6, "four in two, as one does not compile; one with sanitizers; one alone; one alone and sound"


def test_functions_of_rust_choose_their_body_when_they_run() -> None:
    source = Source("rust", "points", "dev", "rust/dev/src/points.rs", RUST)
    changes = [Change("x", RUST.index("raw | 1"), RUST.index("raw | 1") + 7, after) for after in ("raw | 3", "raw")]
    first, second = (mutant_of(source, change) for change in changes)
    text, variants = switched("rust", RUST, source.path, {7: first, 9: second})
    assert (
        body_around("rust", RUST, mutant_of(source, Change("x", RUST.index("0x0F"), RUST.index("0x0F"), "1"))) is None
    )
    lines = text.splitlines()
    for one, changed in zip(variants, ("Some(raw | 3)", "Some(raw)"), strict=True):
        assert f"if ::fieldscribe_runtime::transports::mutant() == {one.number} {{" in lines[one.first - 1]
        assert [changed in line for line in lines[one.first - 1 : one.last]].count(True) == 1
    message = f"error[E0308]: mismatched types\n --> dev/src/points.rs:{variants[1].first + 2}:20\n"
    assert list(blamed("rust", message, {source.path: variants})) == [9]


HOUSE = '''\
"""Docs 1."""
from functools import lru_cache
Pair = tuple["Later", int]
@lru_cache(maxsize=4)
def larger(first: int, second: int = 2) -> int:
    """More 3."""
    assert first > 5
    if first is None:
        raise AssertionError("never 6")
    names = [name for name in "a b" if name in ("x", f"{first}y") and second]
    return max(first, wide(second, first))
def shown(lines: int) -> str:
    line = binding(8, "left", "right")
    return ""
if TYPE_CHECKING:
    LATER = 7
'''


def test_the_compiler_changes_where_it_says_what_to_do() -> None:
    found = {
        what: {(HOUSE[one.start : one.end], one.after) for place in places for one in place}
        for what, places in places_of("generator", HOUSE).items()
    }
    assert {before for before, _ in found["number"]} == {"2"}
    assert found["return"] == {("max(first, wide(second, first))", "None"), ('""', "'?'")}
    assert found["function"] == {("max", "min")}
    assert found["arguments"] >= {("wide(second, first)", "wide(first, second)")}
    assert not any(before.startswith("max") for before, _ in found["arguments"]), "max takes them in any order"
    assert found["comparison"] >= {("first is None", "first is not None")}
    assert ("first is None", "not (first is None)") in found["condition"]
    assert {after for _, after in found["part of a condition"]} == {"(name in ('x', f'{first}y'))", "(second)"}
    assert {"statement", "named constant"}.isdisjoint(found)
    assert not any("Later" in before for some in found.values() for before, _ in some)


def test_the_error_that_ends_a_child_is_told() -> None:
    """`make mutants` ended with the word break-down alone, and nobody knew why."""

    def work(tell: Callable[[Any], None]) -> None:
        tell({"seen": 1})
        raise KeyError("missing")

    with pytest.raises(StoppedError, match=BROKE_DOWN) as caught:
        in_child(work, 10)
    assert caught.value.told == [{"seen": 1}]
    assert "KeyError: 'missing'" in caught.value.__notes__[0]


JUDGED = """\
import sys
from pathlib import Path
from mutants.changes import Change
from mutants.generator import GeneratorJudge
from mutants.rooms import rooms
from mutants.sources import mutant_of

(source,) = (one for one in rooms()["fieldscribe"] if one.path.endswith("/{file}.py"))
judge = GeneratorJudge(Path(sys.argv[1]), [], [Path("{test}")])
for before, after in {changes}:
    start = source.text.index(before)
    print(judge.verdict(mutant_of(source, Change("x", start, start + len(before), after))).outcome)
"""


@pytest.mark.full(seconds=8)
def test_a_mutant_of_the_compiler_is_judged_by_tests_that_enter_it(tmp_path: Path) -> None:
    """In a process of its own, which must not have loaded the compiler."""
    changes = [
        ("return ", "return None and "),
        ("import re", "import nothing_of_that_name"),
        ("import re", "import re "),
    ]
    program = JUDGED.format(file="text", test=TESTS / "language/test_text.py", changes=changes)
    command = [sys.executable, "-c", program, str(tmp_path)]
    done = subprocess.run(command, cwd=TESTS, capture_output=True, text=True, check=True)
    assert done.stdout.split("\n") == [KILLED, LEFT_OUT, SURVIVED, ""]
