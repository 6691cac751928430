"""Files of a user that a command rewrites: all of them, or none."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from fieldscribe.authoring.formatting import rewrite
from fieldscribe.diagnostics import UnclearError
from fieldscribe.output.writing import replace


def test_a_file_that_cannot_be_replaced_leaves_the_others(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    first, second = tmp_path / "first.yaml", tmp_path / "second.yaml"
    for file in (first, second):
        file.write_text("old\n")

    def full_at_last(place: Path, *rest: Any, **more: Any) -> None:
        if place == second:
            raise OSError(28, "No space left on device", str(second))
        replace(place, *rest, **more)

    monkeypatch.setattr("fieldscribe.authoring.formatting.replace", full_at_last)
    with pytest.raises(UnclearError, match=r"cannot write .*second\.yaml: No space left on device"):
        rewrite({str(file): ("old\n", "new\n") for file in (first, second)})
    assert (first.read_text(), second.read_text()) == ("old\n", "old\n")


def test_a_file_that_was_changed_meanwhile_is_left(tmp_path: Path) -> None:
    file = tmp_path / "device.yaml"
    file.write_text("newer\n")
    with pytest.raises(UnclearError, match=r"`device\.yaml` was changed while it was read"):
        rewrite({str(file): ("old\n", "new\n")})
    assert file.read_text() == "newer\n"
