"""The harnesses of `make prove` cover all functions, and they see a planted bug."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest
from proofs.prove import FAMILIES, RUNTIME, alarm_lines, functions, header_of, prove, unproven
from support.toolchains import tool

PLANTED = {
    "cores": ("text_of_words", "at < count; ++at", "at <= count; ++at", "text"),
    "words": ("take_text", "at < text->words; ++at", "at <= text->words; ++at", "take_text"),
    "dates": ("words_of_date", "word < count; ++word", "word <= count; ++word", "words_of_date"),
    "modbus": ("crc", "at < length; ++at", "at <= length; ++at", "crc"),
    "modbus_identify": ("modbus_identify", "at < axes; ++at", "at <= axes; ++at", "identify"),
    "modbus_steps": ("fill", "at < step->read.count", "at <= step->read.count", "fill"),
    "can": ("listen", "at < receiver.slot_count", "at <= receiver.slot_count", "listen"),
    "uss": ("assemble", "at < head_bytes; ++at", "at <= head_bytes; ++at", "assemble__words"),
}
"""By family: a function, an end of a loop in it, the same one step too late, and the harness that sees it."""


@pytest.mark.parametrize("family", FAMILIES)
def test_every_function_has_a_harness(family: str) -> None:
    """A new function of a header without a proof is told."""
    assert functions(family)
    assert unproven(family) == []


def test_a_function_without_a_harness_is_told(tmp_path: Path) -> None:
    """Which one it is, whatever it gives back."""
    text = (RUNTIME / "fieldscribe_can.h").read_text("utf-8")
    added = "\nstatic const uint8_t *fieldscribe_can_new(\n    uint8_t one)\n{\n    return 0;\n}\n"
    (tmp_path / "fieldscribe_can.h").write_text(text + added, "utf-8")
    assert unproven("can", tmp_path) == ["new"]


@pytest.mark.full
@pytest.mark.parametrize("family", FAMILIES)
def test_a_planted_bug_is_found(family: str, tmp_path: Path) -> None:
    """One byte too far in one loop."""
    tool("frama-c")
    function, right, wrong, harness = PLANTED[family]
    for path in RUNTIME.glob("fieldscribe*.h"):
        shutil.copy(path, tmp_path)
    header = header_of(family, tmp_path)
    start = rf"\bfieldscribe_(?:{family}_)?{function}\([^;{{}}]*\)\n\{{"
    text = header.read_text("utf-8")
    [begin] = [found.end() for found in re.finditer(start, text)]
    before, after = text[:begin], text[begin:]
    assert right in after
    header.write_text(before + after.replace(right, wrong, 1), "utf-8")
    proof = prove(family, [harness], "x86_64", tmp_path, ends=True)
    assert proof.alarms
    assert any("out of bounds" in line for line in alarm_lines(proof.said))
