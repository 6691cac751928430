"""What stays of MISRA C:2012 is known, with how often and why."""

from __future__ import annotations

from pathlib import Path

import pytest
from misra.misra import TABLE, differences, found, written
from support.toolchains import tool


@pytest.mark.full(seconds=15)
def test_the_table_is_true(tmp_path: Path) -> None:
    """`make misra` says what differs; `--accept` counts again."""
    tool("cppcheck")
    assert list(differences(found(tmp_path))) == []


def test_every_rule_has_a_reason() -> None:
    rows = [row for row in TABLE.read_text("utf-8").splitlines() if row.startswith("| ") and "rule" not in row]
    assert len(rows) == len(written())
    assert all(len(row.split("|")[3].strip()) > 20 for row in rows)
