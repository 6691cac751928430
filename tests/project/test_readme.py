"""The programs of the README do what it says."""

from __future__ import annotations

import importlib
import re
import subprocess
import sys

from support.places import ROOT
from support.python_package import imported

LINE = """
import sys, types
from fieldscribe_runtime.modbus.frames import crc

class Serial:
    def __init__(self, *settings, **more):
        self.reply = b""

    def reset_input_buffer(self):
        self.reply = b""

    def write(self, request):
        asked.append(request[:-2].hex())
        number = b"\\0\\3" if request[2:4] == bytes.fromhex("1019") else b"\\1\\xf4"
        body = request[:2] + bytes((2 * request[5],)) + number * request[5] if request[1] == 3 else request[:-2]
        self.reply = body + crc(body).to_bytes(2, "little")

    def read(self, size):
        read, self.reply = self.reply[:size], self.reply[size:]
        return read

asked = []
sys.modules["serial"] = types.ModuleType("serial")
sys.modules["serial"].Serial = Serial
"""


def test_the_first_program_in_python_talks_to_a_drive() -> None:
    [program] = re.findall(r"```python\n(import serial.*?)```", (ROOT / "README.md").read_text("utf-8"), re.DOTALL)
    done = subprocess.run(
        [sys.executable, "-c", LINE + program + "print(*asked)"],
        cwd=ROOT / "generated/python",
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.stderr == ""
    printed = done.stdout.splitlines()
    assert printed[:3] == ["50.0 Hz", "modbus", "50.0"]
    assert printed[3].startswith("{'network_frequency_setpoint': 50.0, ")
    asked = printed[4].split()
    assert asked[0] == "0106102801f4"  # A020: 50.0 Hz
    assert asked[3:5] == ["010610190003", "010310280001"]  # A002: Modbus; A020
    at = asked.index("010610590000")  # A061: inactive, after the lower limit was asked for
    assert asked[at + 1] == "010609000001"  # the command that keeps it


def test_what_the_readme_says_of_points_is_so() -> None:
    for package in imported(ROOT / "generated/python", "hitachi_l200"):
        assert package.HitachiL200.base_frequency.decode(500) == 50.0
        first, *_ = package.HitachiL200.layouts("status")
        assert first.decode(bytes(first.size)).keys() == {point.facts.name for point in first.points}
    for package in imported(ROOT / "generated/python", "woodward_mpu2s"):
        can = importlib.import_module("fieldscribe_runtime.can")
        decoder = can.Decoder(package.WoodwardMpu2s, "visualisation", unit=1)
        assert decoder.decode(can.Frame(0x321, bytes.fromhex("DD11001400000000")))["battery_voltage"] == 2.0
