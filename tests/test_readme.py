"""The programs of the README do what it says."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
REPLIES = """
from fieldscribe_runtime.modbus.frames import crc

def answer(request):
    body = request[:2] + bytes((2, 0x01, 0xF4)) if request[1] == 3 else request[:-2]
    asked.append(request[:-2].hex())
    return body + crc(body).to_bytes(2, "little")

asked = []
"""


def test_the_first_program_in_python_talks_to_a_drive() -> None:
    [program] = re.findall(r"```python\n(from .*?)```", (ROOT / "README.md").read_text("utf-8"), re.DOTALL)
    answered = program.replace('the whole reply."""', 'the whole reply."""\n        return answer(request)')
    assert answered != program
    done = subprocess.run(
        [sys.executable, "-c", REPLIES + answered + "print(*asked)"],
        cwd=ROOT / "generated/python",
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.stderr == ""
    assert done.stdout.splitlines()[0] == "50.0"
    asked = done.stdout.splitlines()[1].split()
    assert asked[0] == "0106102801f4"  # A020: 50.0 Hz
    assert asked[-2:] == ["010610590000", "010609000001"]  # A061: inactive; then the command that keeps it
