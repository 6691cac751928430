"""How much of our own descriptions a draft from the text of the manual has right, with nobody helping.

It reads the texts of the manuals: FIELDSCRIBE_MANUALS is the folder that holds them. `FIGURES` is what was measured;
less fails, and whoever makes it better writes the new figure here.
"""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from fieldscribe.cli import main
from support.described import shipped
from support.import_accuracy import FACTS, accuracy, imported

if TYPE_CHECKING:
    from collections.abc import Mapping

    from fieldscribe.model import Device

FIGURES: Mapping[str, tuple[str | None, int, tuple[int, ...]]] = {
    "hitachi_l200": (None, 256, (256, 245, 255, 255)),
    "jumo_controller": (None, 25, (19, 11, 17, 11)),
    "nord_sk5xxe": (None, 66, (12, 12, 12, 12)),
    "siemens_mm4": ("holding", 58, (0, 0, 0, 0)),
    "woodward_mpu2s": ("holding", 291, (150, 128, 148, 129)),
}
"""By device: the space to import to (a draft has no bus but that of Modbus), the points of our description, and of how
many of them the draft has the right address, range, unit and step."""


def _text_of(truth: Device) -> Path:
    """The text of the manual, or the test is skipped."""
    folder, file = os.environ.get("FIELDSCRIBE_MANUALS"), truth.documents[0].file
    if not folder:
        pytest.skip("set FIELDSCRIBE_MANUALS to the folder with the manuals' texts")
    assert file is not None
    return Path(folder) / file


@pytest.mark.full(seconds=2)
@pytest.mark.parametrize("device", FIGURES)
def test_as_much_is_right_as_was_measured(device: str, tmp_path: Path) -> None:
    truth = shipped(device)
    space, count, least = FIGURES[device]
    found, wrong = accuracy(truth, imported(_text_of(truth), tmp_path, space))
    print(f"{device}:", ", ".join(f"{fact} {right} of {of}" for fact, (right, of) in found.items()), *wrong, sep="\n  ")
    assert len(truth.points) == count
    assert all(found[fact][0] >= right for fact, right in zip(FACTS, least, strict=True)), found


NUMBERS_OF_A_BROKEN_CELL = ("printed modicon", "printed wire", "address")
"""Those of A031 in the L200, which the text parts in the wrong place."""


@pytest.mark.full(seconds=3)
@pytest.mark.parametrize("device", [device for device, (_, _, least) in FIGURES.items() if any(least)])
def test_a_draft_stands_in_its_manual(device: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = _text_of(shipped(device))
    imported(text, tmp_path, FIGURES[device][0])
    main(["audit", str(tmp_path), "--manual", str(text), "--report", "json"])  # what a draft leaves out is to do
    missing = json.loads(capsys.readouterr().out)["missing"]
    numbers = [fact for fact in missing if fact["fact"] not in ("title", "enum")]
    assert len(numbers) <= len(NUMBERS_OF_A_BROKEN_CELL), numbers


@pytest.mark.full(seconds=2)
def test_nineteen_of_twenty_are_right_and_nothing_is_made_up(tmp_path: Path) -> None:
    truth = shipped("hitachi_l200")
    drafted = imported(_text_of(truth), tmp_path)
    assert drafted is not None
    known = {(point.space, point.address) for point in truth.points} | {point.code for point in truth.points}
    assert [p.name for p in drafted.points if (p.space, p.address) not in known and p.code not in known] == []
    assert all(right * 20 >= of * 19 for right, of in accuracy(truth, drafted)[0].values())
