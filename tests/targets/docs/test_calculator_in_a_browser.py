"""The calculator of the page in Chromium: values, raw numbers, words, bits, frames, by oracle and manual."""

from __future__ import annotations

import json
from pathlib import Path
from random import Random
from typing import Any, NamedTuple

import pytest
from fieldscribe.model import Device, Point
from fieldscribe.targets.vectors.oracle import INFINITY, Oracle, Ratio, quotient
from support.described import shipped
from support.places import ROOT
from support.toolchains import NODE_MODULES, npm_package, succeed, tool

RANDOM_NUMBERS = 400
BY_HAND = (
    ("hitachi_l200", {"point": "base_frequency", "field": "Value", "text": "50"}, "500", "01F4"),
    ("hitachi_l200", {"point": "base_frequency", "field": "Value", "text": "12,5"}, "125", "007D"),
    ("hitachi_l200", {"point": "base_frequency", "field": "Word", "text": "0FA0"}, "4000", "0FA0"),
    ("hitachi_l200", {"point": "base_frequency", "bits": [2, 8]}, "260", "0104"),
    ("hitachi_l200", {"point": "run_command", "field": "Name", "text": "1"}, "1", "0001"),
    ("siemens_mm4", {"point": "control_word", "field": "Word", "text": "047F"}, "1151", "047F"),
    ("jumo_controller", {"point": "setpoint_1", "field": "Value", "text": "1"}, "1065353216", "0000 3F80"),
)
"""Device, what is typed, raw number and words: by the manuals, and 1.0 as IEEE 754 has it."""
FRAMES = (
    ("hitachi_l200", {"point": "base_frequency", "field": "Value", "text": "50"}, {
        "Read: request": "01 03 10 28 00 01 00 C2",
        "Write: request": "01 06 10 28 01 F4 0D 15",
        "Write: reply": "01 06 10 28 01 F4 0D 15",
    }),
    ("woodward_mpu2s", {"point": "generator_voltage_factor"}, {"Read: request": "33F#FF0101FB0000FEFA"}),
)  # fmt: skip

pytestmark = pytest.mark.full(seconds=30)


def _typed(device: str, steps: list[dict[str, Any]], folder: Path) -> list[dict[str, Any]]:
    """What the fields of the calculators say after each step."""
    npm_package("playwright-core")
    page, listed = ROOT / f"generated/docs/{device}.html", folder / "steps.json"
    listed.write_text(json.dumps(steps), "utf-8")
    program = Path(__file__).with_name("calculate.mjs")
    done = json.loads(succeed([tool("node"), program, page, tool("chromium-headless-shell"), NODE_MODULES, listed]))
    assert done["troubles"] == []
    said: list[dict[str, Any]] = done["said"]
    return said


class _Sample(NamedTuple):
    point: Point
    settings: dict[str, int]
    raw: int
    ratio: Ratio

    def step(self, field: str, text: str) -> dict[str, Any]:
        return {"point": self.point.item, "needs": self.settings, "field": field, "text": text}


def _samples(device: Device, count: int) -> list[_Sample]:
    """Random raw numbers of points with a scale, and of what the scale needs."""
    random, oracle = Random(device.id), Oracle({point.name: point for point in device.points})
    points = [point for point in device.points if point.generated and point.form == "scaled" and not point.specials]
    samples: list[_Sample] = []
    while len(samples) < count:
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


@pytest.mark.parametrize("device_id", ["hitachi_l200", "woodward_mpu2s"])
def test_random_numbers_are_those_of_the_oracle(device_id: str, tmp_path: Path) -> None:
    """Raw to value, and the value that is shown back to a raw number."""
    samples = _samples(shipped(device_id), RANDOM_NUMBERS // 2)
    forth = _typed(device_id, [sample.step("Raw", str(sample.raw)) for sample in samples], tmp_path)
    back = []
    for sample, said in zip(samples, forth, strict=True):
        value = quotient(sample.ratio.numerator(sample.raw), sample.ratio.denominator)
        assert abs(value) < INFINITY
        assert float(said["value"]) == value, (sample, said)
        if not said["wrong"] and sample.point.encodes_values:
            back.append((sample.step("Value", said["value"]), sample.ratio.raw_of_float(value)))
    assert len(back) > len(samples) // 10
    for (step, raw), said in zip(back, _typed(device_id, [step for step, _ in back], tmp_path), strict=True):
        assert said["raw"] == str(raw), (step, said)


@pytest.mark.parametrize(("device_id", "step", "raw", "words"), BY_HAND)
def test_fields_follow_each_other(device_id: str, step: dict[str, Any], raw: str, words: str, tmp_path: Path) -> None:
    [said] = _typed(device_id, [step], tmp_path)
    assert (said["raw"], said["words"], said["wrong"]) == (raw, words, False)


@pytest.mark.parametrize(("device_id", "step", "frames"), FRAMES)
def test_frames_are_those_of_the_manual(
    device_id: str, step: dict[str, Any], frames: dict[str, str], tmp_path: Path
) -> None:
    [said] = _typed(device_id, [step], tmp_path)
    assert frames.items() <= said["frames"].items()


def test_what_may_not_be_written_says_so_and_has_no_frame(tmp_path: Path) -> None:
    steps = [{"point": "base_frequency", "field": "Value", "text": text} for text in ("401", "fast", "")]
    for said in _typed("hitachi_l200", steps, tmp_path):
        assert said["wrong"]
        assert "Write: request" not in said["frames"]


def test_a_reply_that_came_is_decoded(tmp_path: Path) -> None:
    """The answer of the manual's example, and one with a wrong CRC."""
    texts = ("01 03 02 01 F4 B8 53", "01 03 02 01 F4 B8 54", "01 83 02 C0 F1")
    steps = [{"point": "base_frequency", "field": "Read: reply", "text": text} for text in texts]
    good, torn, refused = _typed("hitachi_l200", steps, tmp_path)
    assert (good["value"], good["raw"], good["wrong"]) == ("50", "500", False)
    assert torn["wrong"]
    assert "CRC" in torn["status"]
    assert "address_not_found" in refused["status"]
