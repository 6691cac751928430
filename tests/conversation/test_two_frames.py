"""Whole frames behind each other are told apart, by their lengths and checksums."""

from __future__ import annotations

import pytest
from fieldscribe.conversation.decoder import decode
from fieldscribe.families.frame_results import Options
from support.described import shipped

WRITE, READ = "05 06 10 28 01 F4 0C 91", "08 01 00 06 00 05 1C 91"
TCP = "00 07 00 00 00 06 05 03 10 28 00 01"
TELEGRAM = "02 0E 01 143A 0000 0000 0000 047F 3333 58"
FIRST, SECOND = "321#DD010302000007D0", "321#DD00051E13880064"


@pytest.mark.parametrize(
    ("device", "text", "sizes"),
    [
        ("hitachi_l200", WRITE, [8]),
        ("hitachi_l200", f"{WRITE} {WRITE}", [8, 8]),
        ("hitachi_l200", f"{WRITE}{READ}{WRITE}".replace(" ", ""), [8, 8, 8]),
        ("hitachi_l200", f"{READ} 08 01 01 17 12 1A", [8, 6]),
        ("hitachi_l200", f"{WRITE} 05 06 10 28 01 F4", [8, 6]),
        ("hitachi_l200", f"{WRITE} 00", [9]),
        ("hitachi_l200", f"05 06 10 28 01 F4 {WRITE}", [14]),
        ("hitachi_l200", f"{TCP} {TCP}", [12, 12]),
        ("hitachi_l200", f"{TCP} 00 08", [14]),
        ("siemens_mm4", TELEGRAM, [16]),
        ("siemens_mm4", f"{TELEGRAM} {TELEGRAM}", [16, 16]),
        ("siemens_mm4", f"{TELEGRAM} 02 0E 01 143A", [16, 5]),
        ("woodward_mpu2s", f"{FIRST} {SECOND}", [8, 8]),
        ("woodward_mpu2s", f"(1.5) can0 {FIRST} (1.6) can0 {SECOND}", [8, 8]),
    ],
)
def test_frames_in_one_argument(device: str, text: str, sizes: list[int]) -> None:
    decoded = decode(shipped(device), {}, [text], Options())
    assert [len(str(frame.as_data()["bytes"]).split()) for frame in decoded] == sizes
    begins = [1 + sum(sizes[:place]) for place in range(len(sizes))]
    texts = [
        f"these bytes hold {len(sizes)} frames; this is number {n}, from byte {at} on" for n, at in enumerate(begins, 1)
    ]
    told = [note for frame in decoded for note in frame.notes if "these bytes hold" in note]
    assert told == (texts if len(sizes) > 1 and device != "woodward_mpu2s" else [])


def test_the_second_frame_answers_the_first() -> None:
    _, reply = decode(shipped("hitachi_l200"), {}, [f"{READ} 08 01 01 17 12 1A"], Options())
    assert reply.kind == "reply"
    assert reply.items[0].point
