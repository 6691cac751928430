"""Places in the text are looked for when a finding asks for them: a sound description needs none."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import replace
from typing import TYPE_CHECKING

from fieldscribe.diagnostics import Report, Span
from fieldscribe.language import source
from fieldscribe.pipeline import load_analysis, load_device
from fieldscribe.resources import descriptions_dir

if TYPE_CHECKING:
    import pytest

DEVICE = descriptions_dir() / "nord_sk5xxe" / "device.yaml"


def test_a_sound_description_asks_for_no_place(monkeypatch: pytest.MonkeyPatch) -> None:
    looked: list[str] = []
    monkeypatch.setattr(source, "find_positions", looked.append)
    assert load_device(DEVICE, Report()) is not None
    assert looked == []


def test_a_place_is_looked_for_once_and_compares_with_all_others() -> None:
    asked: list[None] = []

    def find() -> tuple[int, int]:
        asked.append(None)
        return 3, 5

    sought, known = Span.sought("a", find, 2), Span("a", 3, 5, 2)
    assert sought == known
    assert hash(sought) == hash(known)
    assert asked == [None]
    assert sought.moved(4) == Span("a", 3, 9, 2)
    assert sorted([Span("b", 1, 1), Span("a", 3, 6), sought]) == [known, Span("a", 3, 6), Span("b", 1, 1)]


def test_a_device_without_its_digest_is_else_the_same() -> None:
    whole, analysis = load_device(DEVICE, Report()), load_analysis(DEVICE, Report())
    assert whole is not None
    assert analysis is not None
    assert analysis.device.digest == ""
    assert replace(whole, digest="") == analysis.device


def test_check_imports_nothing_that_it_does_not_need() -> None:
    """A quick command starts quickly: what takes long to import is left to those that use it."""
    code = (
        "import sys\nfrom fieldscribe.cli import main\nmain(['check', sys.argv[1]])\n"
        "print(sorted({'jinja2', 'json', 'hashlib', 'asyncio'} & set(sys.modules)))"
    )
    command = [sys.executable, "-I", "-c", code, str(descriptions_dir() / "jumo_controller")]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "[]"
