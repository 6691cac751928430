"""Every way to be wrong has a case in tests/bad: a description whose first lines say what must be found.

A case is a file, or a folder with `expected.txt` where one file cannot show it. After a change of wording, look at what
`FIELDSCRIBE_ACCEPT=1 pytest tests/checks/test_bad.py` makes of the expectations, and commit it if it is right.
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

import pytest
from support.expectations import accept, expected, findings_of, wording
from support.places import TESTS

if TYPE_CHECKING:
    from pathlib import Path

BAD = TESTS / "bad"
CASES = sorted(path for path in BAD.iterdir() if path.is_dir() or path.suffix == ".yaml")


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.stem)
def test_bad(case: Path) -> None:
    """The findings are exactly those that the case expects, with place, wording and hint."""
    if os.environ.get("FIELDSCRIBE_ACCEPT"):
        accept(case)
    found = wording(case, findings_of(case))
    assert found, "a bad case must be refused"
    assert found == expected(case)


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.stem)
def test_every_finding_helps(case: Path) -> None:
    """Every finding has a place and says what to do, in clean printable text of a bearable length."""
    for one in findings_of(case):
        assert one.span.file
        assert one.span.line >= 1
        assert one.span.column >= 1
        assert one.hint, one.message
        assert f"{one.message}{one.hint}".isprintable()
        assert len(one.message) < 300, one.message
        assert not one.message.endswith(".")
        assert "Traceback" not in one.message
