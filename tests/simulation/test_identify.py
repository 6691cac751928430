"""Who a simulated device says that it is: `identify` finds the device, its variants, and no other."""

from __future__ import annotations

import json
from itertools import product

import pytest
from fieldscribe.cli import main
from fieldscribe.simulation import simulated
from support.places import TESTS
from support.quick import full_but

SINK = TESTS / "devices/kitchen_sink"
TOLD = ("fronius_datamanager",)
"""The devices whose manuals give something to tell them by."""
MODBUS = ("eastron_sdm630", "fronius_datamanager", "hitachi_l200", "jumo_controller", "nord_sk5xxe")
LINES = {**dict.fromkeys(MODBUS, ("tcp", "")), "siemens_mm4": ("serial", "uss://"), "woodward_mpu2s": ("can", "")}


@pytest.mark.parametrize("name", full_but(("hitachi_l200", *TOLD), LINES))
@pytest.mark.usefixtures("loads_once")
def test_each_device_is_itself_and_no_other(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    on, scheme = LINES[name]
    with simulated(name, on=on) as device:
        code = main(["identify", "--format", "json", "--line", scheme + device.url])
    found = json.loads(capsys.readouterr().out)
    assert (code, found["fits"]) == ((0, {name: {}}) if name in TOLD else (1, {}))
    assert (name in found["without_identify"]) == (name not in TOLD)


@pytest.mark.full(seconds=0.5)
@pytest.mark.parametrize(("voltage", "model"), [*product(("230V", "400V"), ("small", "large"))])
def test_variants_are_what_was_simulated(voltage: str, model: str, capsys: pytest.CaptureFixture[str]) -> None:
    """Texts and numbers, facts of the device and of variants about one point."""
    with simulated(SINK, on="tcp", variants=[f"voltage={voltage}", f"model={model}"]) as device:
        assert main(["identify", str(SINK), "--line", device.url]) == 0
    assert capsys.readouterr().out == f"it is kitchen_sink, voltage={voltage}, model={model}\n"
