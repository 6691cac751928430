"""The calculator of the page in Chromium: values, raw numbers, words, bits, frames, by oracle and manual."""

from __future__ import annotations

import json
import struct
from collections.abc import Callable
from functools import cache
from pathlib import Path
from random import Random
from typing import Any, NamedTuple

import pytest
from fieldscribe.families.modbus.frames import crc16
from fieldscribe.model import Point
from fieldscribe.resources import render
from fieldscribe.targets.docs import html_files
from fieldscribe.targets.docs.cells import scope_of
from fieldscribe.targets.vectors.oracle import INFINITY, Oracle, Ratio, quotient
from support.described import DEVICES as KITCHENS
from support.described import made, shipped
from support.made_once import made_once
from support.places import ROOT
from support.quick import full_but
from support.toolchains import NODE_MODULES, npm_package, succeed, tool

RANDOM_NUMBERS = 500
DEVICES = ("hitachi_l200", "woodward_mpu2s")
EXPONENT = "generator_power_exponent"
BY_HAND = (
    ("hitachi_l200", {"point": "base_frequency", "field": "Value", "text": "50"}, "500", "01F4"),
    ("hitachi_l200", {"point": "base_frequency", "field": "Value", "text": "12,5"}, "125", "007D"),
    ("hitachi_l200", {"point": "base_frequency", "field": "Value", "text": "37.5 Hz"}, "375", "0177"),
    ("hitachi_l200", {"point": "base_frequency", "field": "Word", "text": "0FA0"}, "4000", "0FA0"),
    ("hitachi_l200", {"point": "base_frequency", "anew": True, "bits": [2, 8]}, "260", "0104"),
    ("hitachi_l200", {"point": "digital_outputs", "anew": True, "clicks": [0, 2]}, "5", "0005"),
    ("hitachi_l200", {"point": "run_command", "field": "Name", "text": "1"}, "1", "0001"),
    ("siemens_mm4", {"point": "control_word", "field": "Word", "text": "047F"}, "1151", "047F"),
    ("jumo_controller", {"point": "setpoint_1", "field": "Value", "text": "1"}, "1065353216", "0000 3F80"),
    ("hitachi_l200", {"point": "base_frequency", "field": "Word", "text": "0x01F4"}, "500", "0x01F4"),
    (
        "woodward_mpu2s",
        {"point": "generator_active_power", "field": "Value", "text": "123000", "then": {EXPONENT: "3"}},
        "123",
        "007B",
    ),
    (
        "siemens_mm4",
        {"point": "main_setpoint", "field": "Value", "text": "25", "then": {"reference_frequency": "50"}},
        "8192",
        "2000",
    ),
)
"""Device, what is typed, raw number and words: by the manuals, and 1.0 as IEEE 754 has it."""
FRAMES = (
    ("hitachi_l200", {"point": "base_frequency", "field": "Value", "text": "50"}, {
        "Read: request": "01 03 10 28 00 01 00 C2",
        "Write: request": "01 06 10 28 01 F4 0D 15",
        "Write: reply": "01 06 10 28 01 F4 0D 15",
    }),
    ("nord_sk5xxe", {"point": "setpoint_1", "field": "Raw", "text": "8000"}, {
        "Read: request": "01 03 0C 81 00 01 D7 72",
        "Read: reply": "01 03 02 1F 40 B1 84",
    }),
    ("woodward_mpu2s", {"point": "generator_voltage_factor"}, {"Read: request": "33F#FF0101FB0000FEFA"}),
    ("woodward_mpu2s", {"point": "generator_frequency", "field": "Raw", "text": "5000"}, {
        "From the device": "321#DD00000013880000",
    }),
    ("siemens_mm4", {"point": "control_word", "field": "Word", "text": "047F"}, {
        "To the device": "02 06 01 04 7F 00 00 7E",
    }),
    ("siemens_mm4", {"point": "command_source", "field": "Raw", "text": "5"}, {
        "Write: request": "02 0E 01 22 BC 00 00 00 05 00 00 00 00 00 00 96",
    }),
    ("siemens_mm4", {"point": "command_source", "field": "Parameter part", "text": "4"}, {
        "Write: request": "02 0E 01 22 BC 00 00 00 00 00 05 00 00 00 00 96",
        "Read: reply": "02 0E 01 12 BC 00 00 00 00 00 05 00 00 00 00 A6",
    }),
    ("fronius_datamanager", {"point": "ac_power", "field": "Raw", "text": "100", "then": {"Address of": "40069"}}, {
        "Read: request": "01 03 9C 93 00 01 5A 77",
        "Read: reply": "01 03 02 00 64 B9 AF",
    }),
    ("kitchen_blocks", {"point": "level", "field": "Value", "text": "40", "then": {"Slot": "3", "Half": "1"}}, {
        "Write: request": "01 06 0B CD 01 90 1B ED",
    }),
    ("kitchen_can", {"point": "only_large"}, {"Read: request": "33F#FF01002F0000FF2E"}),
)  # fmt: skip
"""Device, what is typed, frames: of the manuals, and put together by hand after them."""
REFUSED = [{"point": "base_frequency", "field": "Value", "text": text} for text in ("401", "fast", "", "1,500", "5 A")]
ROUNDED = {"point": "base_frequency", "field": "Value", "text": "37.54"}
WORDS = {
    "": "no words here, one is needed",
    "01F4 01F4": "2 words here, one is needed",
    "xyz": "xyz is no word",
    "12345": "12345 is no word",
}
FOREIGN_UNIT = {"point": "generator_frequency", "then": {"Unit": "300"}}
OF_FLOATS = {"decode": "02 06 01 04 7F 20 00 5E", "known": {"P2009": 0, "P2000": 50.0}}


def _reads(unit: int, address: int, *words: int) -> str:
    """The request and the reply that read these words, as two lines."""
    pdus = (
        struct.pack(">BBHH", unit, 3, address, len(words)),
        struct.pack(f">BBB{len(words)}H", unit, 3, 2 * len(words), *words),
    )
    return "\n".join((pdu + crc16(pdu).to_bytes(2, "little")).hex() for pdu in pdus)


_MARKER, _CURRENT = (0x5375, 0x6E53), (18, 0xFFFF)
_HEADS = [_reads(1, 50000, *_MARKER), _reads(1, 50002, 103, 8), _reads(1, 50012, 160, 10), _reads(1, 50024, 705, 20)]
IN_BLOCKS = {
    "\n".join(lines): names
    for lines, names in (
        ([_reads(1, 50004, *_CURRENT)], []),
        ([*_HEADS, _reads(1, 50004, *_CURRENT)], ["current", "current_sf"]),
        ([*_HEADS, _reads(2, 50004, *_CURRENT)], []),
        ([*_HEADS, _reads(1, 50022, 7, 40, 8)], ["module_id_index_3", "module_limit_index_3"]),
        ([*_HEADS, _reads(1, 50026, 3, 1), _reads(1, 50036, 0, 9)], ["curve_time"]),
    )
}
"""Frames of the chain of blocks, with the points that the page names in the last reply."""
IN_SLOT = {"decode": "01 06 0B CD 01 90 1B ED", "known": {"slot": 3, "half": 1}}
NO_WORD = {"point": "control_word", "field": "Raw", "text": "none"}
REPLIES = [
    {"point": "base_frequency", "field": "Read: reply", "text": text}
    for text in ("01 03 02 01 F4 B8 53", "01 03 02 01 F4 B8 54", "01 83 02 C0 F1")
]
"""The answer of the manual's example, the same with a wrong CRC, and an exception."""

Typed = Callable[[str, dict[str, Any]], dict[str, Any]]

pytestmark = pytest.mark.full(seconds=0.2)  # but for the first, which visits all pages


class _Sample(NamedTuple):
    point: Point
    settings: dict[str, int]
    raw: int
    ratio: Ratio

    @property
    def value(self) -> float:
        value = quotient(self.ratio.numerator(self.raw), self.ratio.denominator)
        assert abs(value) < INFINITY
        return value

    def steps(self) -> list[dict[str, Any]]:
        """The raw number typed, and then its value."""
        return [self.step("Raw", str(self.raw)), self.step("Value", repr(self.value))]

    def step(self, field: str, text: str) -> dict[str, Any]:
        return {"point": self.point.item, "needs": self.settings, "field": field, "text": text}


@cache
def _samples(device_id: str) -> list[_Sample]:
    """Random raw numbers of points with a scale, and of what the scale needs."""
    device = shipped(device_id)
    random, oracle = Random(device.id), Oracle({point.name: point for point in device.points})
    points = [point for point in device.points if point.generated and point.form == "scaled" and not point.specials]
    samples: list[_Sample] = []
    while len(samples) < RANDOM_NUMBERS // len(DEVICES):
        point = random.choice(points)
        settings = {}
        for name in point.arguments:
            low, high = oracle.points[name].outer
            settings[name] = random.randint(max(low, 1 if high >= 1 else low), min(high, 10_000))
        ratio = oracle.ratio(point.shape, settings)
        raw = random.randint(point.least, point.greatest)
        if isinstance(ratio, Ratio) and abs(ratio.numerator(raw)) < 1 << 53:
            samples.append(_Sample(point, settings, raw, ratio))
    return sorted(samples, key=lambda sample: sample.point.item)


def _steps(device_id: str) -> list[dict[str, Any]]:
    """All that is typed on the page of a device, one after the other."""
    by_hand = [step for device, step, *_ in (*BY_HAND, *FRAMES) if device == device_id]
    samples = _samples(device_id) if device_id in DEVICES else []
    l200 = [*REPLIES, *REFUSED, ROUNDED, *map(_words, WORDS)] if device_id == "hitachi_l200" else []
    bits = [NO_WORD] if device_id == "siemens_mm4" else []
    last: dict[str, list[dict[str, Any]]] = {
        "woodward_mpu2s": [FOREIGN_UNIT],
        "kitchen_blocks": [IN_SLOT, *({"decode": text} for text in IN_BLOCKS)],
        "siemens_mm4": [OF_FLOATS],
    }
    return [*by_hand, *l200, *bits, *(step for sample in samples for step in sample.steps()), *last.get(device_id, [])]


def _words(text: str) -> dict[str, Any]:
    return {"point": "base_frequency", "field": "Word", "text": text}


@pytest.fixture(scope="module")
def typed(tmp_path_factory: pytest.TempPathFactory) -> Typed:
    """What the fields say after a step on the page of a device: one browser visits all pages."""
    npm_package("playwright-core")
    devices = sorted({device for device, *_ in (*BY_HAND, *FRAMES)})
    steps_of = {device: _steps(device) for device in devices}

    def calculate(folder: Path) -> None:
        listed = folder / "steps.json"
        pages = {str(_page(device, folder)): steps for device, steps in steps_of.items()}
        listed.write_text(json.dumps(pages), "utf-8")
        program, browser = Path(__file__).with_name("calculate.mjs"), tool("chromium-headless-shell")
        said = succeed([tool("node"), program, browser, NODE_MODULES, listed])
        (folder / "said.json").write_text(said, "utf-8")

    done = json.loads((made_once(tmp_path_factory, "calculated", calculate) / "said.json").read_text("utf-8"))
    assert done["troubles"] == []
    said = {
        (Path(page).stem, json.dumps(step)): found
        for page, all_found in done["said"].items()
        for step, found in zip(steps_of[Path(page).stem], all_found, strict=True)
    }
    return lambda device, step: said[device, json.dumps(step)]


def _page(device: str, folder: Path) -> Path:
    """Return the page of a device; of one of the tests it is made in a folder."""
    if (KITCHENS / device).exists():
        [(name, text)] = html_files(scope_of(made(device)), render)
        (folder / name).write_text(text, "utf-8")
        return folder / name
    return ROOT / f"generated/docs/{device}.html"


@pytest.mark.parametrize("device_id", full_but(DEVICES[1:], DEVICES, seconds=20))
def test_random_numbers_are_those_of_the_oracle(device_id: str, typed: Typed) -> None:
    """Raw to value, and the value back to a raw number."""
    back = 0
    for sample in _samples(device_id):
        forth, again = (typed(device_id, step) for step in sample.steps())
        assert float(forth["value"]) == sample.value, (sample, forth)
        if not forth["wrong"] and sample.point.encodes_values:
            assert again["raw"] == str(sample.ratio.raw_of_float(sample.value)), (sample, again)
            back += 1
    assert back > len(_samples(device_id)) // 10


@pytest.mark.parametrize(("device_id", "step", "raw", "words"), BY_HAND)
def test_fields_follow_each_other(device_id: str, step: dict[str, Any], raw: str, words: str, typed: Typed) -> None:
    said = typed(device_id, step)
    assert (said["raw"], said["words"], said["wrong"]) == (raw, words, False)


def test_drawn_bits_follow_the_number(typed: Typed) -> None:
    step = {"point": "control_word", "field": "Word", "text": "047F"}
    assert typed("siemens_mm4", step)["drawn"] == [0, 1, 2, 3, 4, 5, 6, 10]


@pytest.mark.parametrize(("device_id", "step", "frames"), FRAMES)
def test_frames_are_those_of_the_manual(
    device_id: str, step: dict[str, Any], frames: dict[str, str], typed: Typed
) -> None:
    assert frames.items() <= typed(device_id, step)["frames"].items()


def test_an_address_that_counts_from_a_base_says_so(typed: Typed) -> None:
    said = {device: typed(device, step)["address"] for device, step, _ in FRAMES}
    assert said["fronius_datamanager"] == "+000Eh 14"
    assert said["hitachi_l200"] == "1028h 4136"


def test_what_may_not_be_written_says_so_and_has_no_frame(typed: Typed) -> None:
    for step in REFUSED:
        said = typed("hitachi_l200", step)
        assert said["wrong"]
        assert "Write: request" not in said["frames"]


def test_what_is_no_number_leaves_no_bits(typed: Typed) -> None:
    assert typed("siemens_mm4", NO_WORD)["drawn"] == []


def test_a_value_between_two_raw_numbers_says_so(typed: Typed) -> None:
    said = typed("hitachi_l200", ROUNDED)
    assert (said["raw"], said["wrong"]) == ("375", False)
    assert "37.54 is between two raw numbers" in said["status"]
    exact = {"point": "base_frequency", "field": "Value", "text": "37.5 Hz"}
    assert "between" not in typed("hitachi_l200", exact)["status"]


def test_a_reply_that_came_is_decoded(typed: Typed) -> None:
    good, torn, refused = (typed("hitachi_l200", step) for step in REPLIES)
    assert (good["value"], good["raw"], good["wrong"]) == ("50", "500", False)
    assert torn["wrong"]
    assert "CRC" in torn["status"]
    assert "address_not_found" in refused["status"]


@pytest.mark.parametrize("text", WORDS)
def test_what_is_no_word_is_told(text: str, typed: Typed) -> None:
    said = typed("hitachi_l200", _words(text))
    assert said["wrong"]
    assert WORDS[text] in said["status"]


def test_a_unit_that_cannot_be_has_no_frames(typed: Typed) -> None:
    assert typed("woodward_mpu2s", FOREIGN_UNIT)["frames"] == {}


def test_the_decoder_takes_numbers_that_addresses_depend_on(typed: Typed) -> None:
    [said] = typed("kitchen_blocks", IN_SLOT)
    assert said.startswith("level = 40 %")


def test_the_decoder_takes_values_of_floats(typed: Typed) -> None:
    """2000h is half of the reference frequency."""
    assert any(each.startswith("main_setpoint = 25 Hz") for each in typed("siemens_mm4", OF_FLOATS))


@pytest.mark.parametrize("text", IN_BLOCKS)
def test_the_decoder_finds_blocks_where_replies_show_them(text: str, typed: Typed) -> None:
    said = typed("kitchen_blocks", {"decode": text})
    names = [each.partition(" = ")[0] for each in said if " = " in each]
    assert names[-len(IN_BLOCKS[text]) :] == IN_BLOCKS[text] if IN_BLOCKS[text] else "current" not in names
