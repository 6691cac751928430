"""The file that keeps a fingerprint: who writes it, when it is read, and what is said of a bad one."""

from __future__ import annotations

import json
import os
from hashlib import sha256
from pathlib import Path

import pytest
from fieldscribe.audit.layout import Fingerprint, FingerprintError
from fieldscribe.cli import main
from fieldscribe.diagnostics import Report
from fieldscribe.pipeline import load_analysis
from fieldscribe.resources import descriptions_dir
from support.described import group, head, together

TEXT = "# Fan\n\n| Speed | 1001h | 0-900 |\n| Ramp | 1002h | 1-60 |\n"
MOVED = TEXT.replace("# Fan\n", "# Fan\n\nOf what moves, and how.\n").replace("| 1002h | 1-60", "| 1002h\n| 1-60")
POINTS = "- {name: speed, at: 1001h, range: 0..900, line: 3}\n- {name: ramp, at: 1002h, range: 1..60, line: 4}\n"
DIGEST = sha256(TEXT.encode()).hexdigest()
KEPT = Fingerprint.of(TEXT, DIGEST).written()
AUDIT = ("--report", "json")


@pytest.fixture(name="fan")
def _fan(tmp_path: Path) -> Path:
    """A folder with a description of one file, and the texts beside it."""
    documents = f"{{manual: {{title: Manual, language: en, file: fan.txt, sha256: {DIGEST}}}}}"
    (tmp_path / "fan").mkdir()
    device = together(head(device="fan", documents=documents), group(POINTS))
    (tmp_path / "fan" / "device.yaml").write_text(device, encoding="utf-8")
    (tmp_path / "fan.txt").write_text(TEXT, encoding="utf-8")
    (tmp_path / "new.txt").write_text(MOVED, encoding="utf-8")
    return tmp_path


def run(fan: Path, *words: str, manual: str = "fan.txt") -> int:
    return main(["audit", str(fan / "fan"), "--manual", str(fan / manual), *words])


def test_it_is_kept_beside_the_description_and_read_for_a_new_text(
    fan: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(fan, manual="new.txt") == 1
    assert "hint: no fingerprint of the text that was transcribed is kept" in capsys.readouterr().out
    assert run(fan, "--fingerprint") == 0
    assert capsys.readouterr().out.splitlines()[-1].startswith("kept: ")
    assert (fan / "fan" / "manual.fingerprint").read_text(encoding="utf-8") == KEPT
    assert run(fan, "--fingerprint") == 0
    assert capsys.readouterr().out.splitlines()[-1].startswith("kept before: ")
    run(fan, *AUDIT, manual="new.txt")
    found = json.loads(capsys.readouterr().out)
    assert (found["missing"], found["unused_numbers"]) == ([], [])
    assert [(one["subject"], one["line"], one["now"]) for one in found["moved"]] == [("speed", 3, 5), ("ramp", 4, 6)]


def test_a_description_that_is_one_file_has_its_name_in_front(fan: Path) -> None:
    (fan / "fan" / "device.yaml").rename(fan / "fan" / "fan.yaml")
    assert main(["audit", str(fan / "fan" / "fan.yaml"), "--manual", str(fan / "fan.txt"), "--fingerprint"]) == 0
    assert (fan / "fan" / "fan.manual.fingerprint").is_file()


def test_accept_keeps_that_of_the_new_text(fan: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(fan, "--fingerprint") == 0
    old = ("--old", str(fan / "fan.txt"), "--renumber", "--accept", "--file", "new.txt")
    assert run(fan, *old, manual="new.txt") == 0
    kept = (fan / "fan" / "manual.fingerprint").read_text(encoding="utf-8")
    assert kept == Fingerprint.of(MOVED, sha256(MOVED.encode()).hexdigest()).written()
    capsys.readouterr()


REFUSED = {
    "another text": ("new.txt", "`new.txt` is not the text that documents.manual records"),
    "a checksum that is missing": ("fan.txt", "documents.manual records no text"),
}


@pytest.mark.parametrize(("manual", "message"), REFUSED.values(), ids=REFUSED)
def test_only_the_recorded_text_has_one(
    manual: str, message: str, fan: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    if "no text" in message:
        device = fan / "fan" / "device.yaml"
        device.write_text(device.read_text(encoding="utf-8").replace(f", sha256: {DIGEST}", ""), encoding="utf-8")
    assert run(fan, "--fingerprint", manual=manual) == 2
    assert message in capsys.readouterr().err
    assert not (fan / "fan" / "manual.fingerprint").exists()


def test_with_the_old_text_accept_is_the_word(fan: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(fan, "--fingerprint", "--old", str(fan / "fan.txt"), manual="new.txt") == 2
    assert "with --old say --accept" in capsys.readouterr().err


def test_that_of_another_text_is_as_good_as_none(fan: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A description that was given another checksum by hand."""
    (fan / "fan" / "manual.fingerprint").write_text(KEPT.replace(DIGEST, "0" * 64), encoding="utf-8")
    assert run(fan, manual="new.txt") == 1
    assert "hint: no fingerprint" in capsys.readouterr().out


BAD = {
    "empty": ("", 1),
    "something else": ("hello\n", 1),
    "a short checksum": (KEPT.replace(DIGEST, DIGEST[1:]), 1),
    "a later form": (KEPT.replace("fingerprint 1", "fingerprint 2"), 1),
    "words": (KEPT + "Motor, 3 phases\n", 6),
    "bytes": (KEPT + "\x00\x1b[31m\n", 6),
    "bytes that are no text": (KEPT + "\ufffd\n", 6),
}


@pytest.mark.parametrize(("text", "line"), BAD.values(), ids=BAD)
def test_a_bad_one_is_named_with_its_line(text: str, line: int, fan: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(FingerprintError) as caught:
        Fingerprint.read(text)
    assert caught.value.line == line
    (fan / "fan" / "manual.fingerprint").write_text(text, encoding="utf-8")
    assert run(fan, manual="new.txt") == 1
    printed = capsys.readouterr()
    assert f"manual.fingerprint:{line}: " in printed.err
    assert "keep a new one" in printed.err
    assert printed.out == ""


def test_other_ends_of_lines_are_no_fault(fan: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """As an editor or a checkout on another system writes them."""
    place = fan / "fan" / "manual.fingerprint"
    place.write_bytes(b"\xef\xbb\xbf" + KEPT.replace("\n", "\r\n").encode())
    run(fan, *AUDIT, manual="new.txt")
    found = json.loads(capsys.readouterr().out)
    assert (found["fingerprint"], found["missing"]) == (True, [])


def test_too_many_lines_are_refused() -> None:
    with pytest.raises(FingerprintError, match="at most"):
        Fingerprint.read(KEPT + "\n" * 200_001)


@pytest.mark.parametrize("words", [("--fingerprint",), AUDIT], ids=["written", "read"])
def test_links_and_pipes_are_no_fingerprints(
    words: tuple[str, ...], fan: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """What lies beside a description is as hostile as that: nothing is written through a link, nothing waits."""
    place, precious = fan / "fan" / "manual.fingerprint", fan / "precious"
    precious.write_text("precious", encoding="utf-8")
    manual = "new.txt" if words == AUDIT else "fan.txt"
    place.symlink_to(precious)
    assert run(fan, *words, manual=manual) == 2
    assert "is a link" in capsys.readouterr().err
    assert precious.read_text(encoding="utf-8") == "precious"
    place.unlink()
    os.mkfifo(place)
    assert run(fan, *words, manual=manual) in (1, 2)
    assert "pipe" in capsys.readouterr().err


def test_a_foreign_file_in_its_place_is_left_alone(fan: Path, capsys: pytest.CaptureFixture[str]) -> None:
    place = fan / "fan" / "manual.fingerprint"
    place.write_text("my notes\n", encoding="utf-8")
    assert run(fan, "--fingerprint") == 1
    assert "manual.fingerprint:1: " in capsys.readouterr().err
    assert place.read_text(encoding="utf-8") == "my notes\n"


SHIPPED = sorted(descriptions_dir().glob("*/device.yaml"))


@pytest.mark.parametrize("file", SHIPPED, ids=lambda file: file.parent.name)
def test_shipped_ones_are_current(file: Path) -> None:
    """They say of which text they are; with the manuals at hand they are made anew and compared."""
    subject = load_analysis(file, Report())
    assert subject is not None
    [document] = subject.scope.documents.values()
    kept = (file.parent / f"{document.id}.fingerprint").read_text(encoding="utf-8")
    assert Fingerprint.read(kept).sha256 == document.sha256
    assert Fingerprint.read(kept).written() == kept
    manuals = os.environ.get("FIELDSCRIBE_MANUALS")
    if manuals and document.file:
        text = (Path(manuals) / document.file).read_text(encoding="utf-8-sig")
        assert Fingerprint.of(text, str(document.sha256)).written() == kept
