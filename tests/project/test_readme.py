"""The programs of the README do what it says."""

from __future__ import annotations

import importlib

from support.places import ROOT
from support.python_package import imported


def test_what_the_readme_says_of_points_is_so() -> None:
    for package in imported(ROOT / "generated/python", "hitachi_l200"):
        assert package.HitachiL200.base_frequency.decode(500) == 50.0
        first, *_ = package.HitachiL200.layouts("status")
        assert first.decode(bytes(first.size)).keys() == {point.facts.name for point in first.points}
    for package in imported(ROOT / "generated/python", "woodward_mpu2s"):
        can = importlib.import_module("fieldscribe_runtime.can")
        decoder = can.Decoder(package.WoodwardMpu2s, "visualisation", unit=1)
        assert decoder.decode(can.Frame(0x321, bytes.fromhex("DD11001400000000")))["battery_voltage"] == 2.0
