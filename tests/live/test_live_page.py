"""The page on live devices: its console blocks, run against a simulated drive, print what stands there."""

from __future__ import annotations

import io
import re
import shlex
import sys
from contextlib import chdir
from pathlib import Path

import pytest
from fieldscribe.cli import main
from fieldscribe.simulation import Simulated, simulated
from support.places import ROOT

PAGE = (ROOT / "descriptions/using/live.md").read_text("utf-8")
BLOCKS = re.findall(r"^```console\n\$ fieldscribe (.*)\n((?:.*\n)*?)```$", PAGE, re.MULTILINE)
PORT = "127.0.0.1:5020"
VALUES = {
    "output_frequency": 12.5,
    "base_frequency": 50,
    "acceleration_time": 10,
    "maximum_frequency": 50,
    "lower_frequency_limit": 10,
    "network_frequency_setpoint": 20,
    "inverter_status": "running",
    "network_process_value": 0,
    "running": "stopped",
}


def printed(drive: Simulated, words: str, capsys: pytest.CaptureFixture[str]) -> str:
    """What a command prints, as the page has it: messages behind `! `, times left out, then the exit code."""
    code = main(shlex.split(words.replace(PORT, f"127.0.0.1:{drive.port}")))
    out, err = capsys.readouterr()
    text = out + "".join(f"! {line}\n" for line in err.splitlines()) + (f"[{code}]\n" if code else "")
    text = text.replace(f"127.0.0.1:{drive.port}", PORT)
    return re.sub(r"(?<=after )[\d.]+|^20\d\d-[^,]*", "…", text, flags=re.MULTILINE)


@pytest.mark.full(seconds=1)
@pytest.mark.usefixtures("loads_once")
def test_the_blocks_of_the_page_print_what_stands_there(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "stdin", io.StringIO())
    toml = re.search(r"^```toml\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)
    assert toml is not None
    assert len(BLOCKS) > 6
    with simulated("hitachi_l200", values=VALUES) as drive, chdir(tmp_path):
        project = toml[1].replace(PORT, f"127.0.0.1:{drive.port}")
        Path("fieldscribe.toml").write_text(project, "utf-8")
        for words, expected in BLOCKS:
            assert printed(drive, words, capsys) == expected, words
