"""Every way to be wrong has a case in tests/bad: a description whose first lines say what must be found.

A case is a file, or a folder with `expected.txt` where one file cannot show it. After a change of wording, look at what
`FIELDSCRIBE_ACCEPT=1 pytest tests/checks/test_bad.py` makes of the expectations, and commit it if it is right.
"""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from fieldscribe.diagnostics import Diagnostic
from support.expectations import accept, expected, findings_of, wording
from support.places import TESTS

BAD = TESTS / "bad"
CASES = sorted(path for path in BAD.iterdir() if path.is_dir() or path.suffix == ".yaml")


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.stem)
def test_bad(case: Path) -> None:
    """The findings are exactly those that the case expects, with place, wording and hint, and each of them helps."""
    if os.environ.get("FIELDSCRIBE_ACCEPT"):
        accept(case)
    findings = findings_of(case)
    assert findings, "a bad case must have findings"
    assert wording(case, findings) == expected(case)
    for one in findings:
        helps(one)


def helps(finding: Diagnostic) -> None:
    """It has a place and says what to do, in clean printable text of a bearable length."""
    assert finding.span.file
    assert finding.span.line >= 1
    assert finding.span.column >= 1
    assert finding.hint, finding.message
    assert f"{finding.message}{finding.hint}".isprintable()
    assert len(finding.message) < 300, finding.message
    assert not finding.message.endswith(".")
    assert "Traceback" not in finding.message
