"""Records behave as the classes that `dataclasses` makes."""

from __future__ import annotations

import copy
import dataclasses
import pickle
import subprocess
import sys
from typing import Any

import pytest
from fieldscribe import records
from fieldscribe.records import names_of, replace, values_of
from support.places import ROOT


def _kinds(dataclass: Any, field: Any) -> Any:
    """The same classes, made in both ways."""

    @dataclass(frozen=True, slots=True)
    class Base:
        first: int

    @dataclass(frozen=True, slots=True)
    class Frozen(Base):
        name: str = "n"
        note: str = field(default="", compare=False)
        items: tuple[int, ...] = ()
        silent: int = field(default=0, repr=False)

    @dataclass(slots=True)
    class Open:
        values: list[int] = field(default_factory=list)
        total: int = 0

        def __post_init__(self) -> None:
            self.total += len(self.values)

    @dataclass(frozen=True)
    class Single:
        only: str

    @dataclass(slots=True, eq=False)
    class Same:
        only: str

    return Frozen, Open, Single, Same


OURS = _kinds(records.dataclass, records.field)
THEIRS = _kinds(dataclasses.dataclass, dataclasses.field)


def test_only_attributes_that_were_named_can_be_set() -> None:
    """A slip of the pen fails at once, and thousands of points need no dictionary each."""
    frozen, opened, single, _ = _kinds(records.dataclass, records.field)
    made = opened()
    made.total = 5
    with pytest.raises(AttributeError):
        made.totl = 5
    assert [hasattr(each, "__dict__") for each in (frozen(1), made, single("a"))] == [False, False, True]


@pytest.mark.parametrize(("ours", "theirs"), [*zip(OURS, THEIRS, strict=True)], ids=lambda kind: kind.__name__)
def test_names_and_signs_are_the_same(ours: Any, theirs: Any) -> None:
    assert list(names_of(ours)) == [field.name for field in dataclasses.fields(theirs)]
    assert ours.__match_args__ == theirs.__match_args__
    assert getattr(ours, "__slots__", None) == getattr(theirs, "__slots__", None)
    assert (ours.__hash__ is None) == (theirs.__hash__ is None)


@pytest.mark.parametrize("index", range(4))
def test_objects_are_shown_compared_and_hashed_alike(index: int) -> None:
    given: list[tuple[Any, ...]] = [("a",), ("b",), ("a",)]
    if index == 0:
        given = [(1,), (1, "m"), (1, "n", "note"), (1, "n", "", (1, 2), 5)]
    elif index == 1:
        given = [([1, 2],), ([], 4), ([1, 2], 0)]
    ours, theirs = ([kind(*values) for values in given] for kind in (OURS[index], THEIRS[index]))
    assert [repr(one) for one in ours] == [repr(one) for one in theirs]
    assert [one == other for one in ours for other in ours] == [one == other for one in theirs for other in theirs]
    assert ours[0] != theirs[0]
    if OURS[index].__hash__ is not None and index != 3:
        assert [hash(one) for one in ours] == [hash(one) for one in theirs]


def test_lists_are_made_for_each_object() -> None:
    kind = OURS[1]
    assert kind().values is not kind().values
    assert kind(values=[1]).total == 1


def test_wrong_arguments_are_refused() -> None:
    for values in ((), (1, 2, 3, 4, 5, 6)):
        with pytest.raises(TypeError):
            OURS[0](*values)
    with pytest.raises(TypeError):
        replace(OURS[2]("a"), other=1)


def test_replaced_copied_and_taken_apart() -> None:
    one = OURS[0](1, "m", items=(1,))
    assert replace(one, name="z") == dataclasses.replace(one, name="z") == OURS[0](1, "z", "", (1,))
    assert copy.copy(one) == copy.deepcopy(one) == one
    assert values_of(one) == dataclasses.asdict(one)
    assert dataclasses.astuple(one) == (1, "m", "", (1,), 0)
    assert dataclasses.is_dataclass(one)


def test_what_the_standard_library_reads_is_made_once() -> None:
    """It compiles six methods, and `dataclasses.replace` asks for it each time."""
    for kind in OURS:
        assert kind.__dataclass_fields__ is kind.__dataclass_fields__


def test_records_of_the_model_can_be_pickled() -> None:
    from fieldscribe.diagnostics import Diagnostic, Span

    finding = Diagnostic("rule", "message", Span("a", 1, 1))
    assert pickle.loads(pickle.dumps(finding)) == finding


def test_check_imports_nothing_that_it_does_not_need() -> None:
    """What takes long to import, and what a description without anchors never needs."""
    code = (
        "import sys\nfrom fieldscribe.cli import main\nmain(['check', sys.argv[1]])\n"
        "print(sorted({'yaml', 'jinja2', 'json', 'dataclasses', 'inspect', 'rich', 'hashlib'} & set(sys.modules)))"
    )
    command = [sys.executable, "-I", "-c", code, str(ROOT / "descriptions" / "jumo_controller")]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "[]"
