"""Errors of the runtime as the command line says them."""

from __future__ import annotations

from pathlib import Path

import pytest
from fieldscribe.live.readings import chosen, in_words
from fieldscribe_runtime import AccessError, FieldscribeError, RequestError
from support.described import described, loaded_in


@pytest.mark.parametrize(
    ("error", "facts", "whole", "alone"),
    [
        (AccessError("it is only written"), {}, "P1 a: it is only written", "it is only written"),
        (
            AccessError("depends on model"),
            {"undecided": "model"},
            *("depends on model: give --variant model=VALUE",) * 2,
        ),
        (
            RequestError("bad_base", "where this is depends on slot"),
            {"undecided": "slot", "group": "main"},
            "group main: where this is depends on slot: give --with slot=VALUE",
            "where this is depends on slot: give --with slot=VALUE",
        ),
        (FieldscribeError("lost"), {"needs": "b", "group": "main"}, "group main: P1 a: needs b: lost", "needs b: lost"),
    ],
)
def test_what_a_program_passes_is_an_option_here(
    error: FieldscribeError, facts: dict[str, str], whole: str, alone: str
) -> None:
    for name, fact in facts.items():
        setattr(error, name, fact)
    error.point = "P1 a" if "P1 a" in whole else None
    assert (in_words(error), in_words(error, alone=True)) == (whole, alone)


def test_a_code_of_several_sets_reads_each(tmp_path: Path) -> None:
    model = loaded_in(tmp_path, described("- {name: ramp, code: P1, at: 1, sets: {2: {at: 2, code: P1}}}\n"))
    assert chosen(model, ["P1"]).items == [point.item for point in model.points]
    assert len(model.points) == 2
