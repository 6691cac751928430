"""Every program on the page for Python runs as it stands there, on a server of pymodbus and a bus of python-can."""

from __future__ import annotations

import json
import logging
import re
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import can
import pytest
from fieldscribe.cli import main
from pymodbus import FramerType
from support.line_ends import pty_end
from support.modbus_server import server
from support.places import ROOT
from support.python_families import UssDrive
from support.python_package import imported, typed_findings

PAGE = "\n".join(
    (ROOT / f"descriptions/using/{name}.md").read_text("utf-8") for name in ("python", "python-transports")
)
GENERATED = ROOT / "generated/python"


@pytest.fixture
def packages() -> Iterator[Any]:
    yield from imported(GENERATED, "hitachi_l200")


def speak(bus: can.BusABC, stop: threading.Event) -> None:
    """Frames of the telegram, as the manual prints them, until somebody has heard enough."""
    frame = can.Message(arbitration_id=0x321, data=bytes.fromhex("DD11001400000000"), is_extended_id=False)
    while not stop.wait(0.02):
        bus.send(frame)


@pytest.mark.full(seconds=5)
@pytest.mark.usefixtures("packages")
def test_the_programs_run(capsys: pytest.CaptureFixture[str], caplog: pytest.LogCaptureFixture) -> None:
    blocks = re.findall(r"^```python\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)
    far, stop = can.Bus("can0", interface="virtual"), threading.Event()
    speaker = threading.Thread(target=speak, args=(far, stop), daemon=True)
    speaker.start()
    known: dict[str, Any] = {"__name__": "page"}
    printed = []
    mm4 = UssDrive()
    uss_end = pty_end(lambda request: [mm4.exchange(request)])
    with server(FramerType.RTU, word=1) as rtu, server(word=1) as tcp, uss_end as uss:
        for block in blocks:
            port = uss if "UssLine" in block else f"socket://127.0.0.1:{rtu}"
            here = block.replace("/dev/ttyUSB0", port).replace("socketcan", "virtual")
            here = here.replace('TcpLine("192.168.0.20")', f'TcpLine("127.0.0.1", {tcp})')
            exec(compile(here, "page", "exec"), known)
            printed.append(capsys.readouterr().out.splitlines())
    stop.set()
    speaker.join(2)
    far.shutdown()
    logging.getLogger("fieldscribe").setLevel(logging.NOTSET)
    first, many, rest, table, raw, facts, failing, traffic, watch, client, gateway, _, uss_block, bus = printed
    assert first == ["0.1 Hz"]
    assert watch == client == gateway == ["0.1"]
    assert [line[0] for line in many] == ["{", "{"]
    assert rest[:2] == ["output_frequency = 0.1", "base_frequency = 50.0"]
    assert rest[2].startswith("d007 error: d007 is documented only, as scaled_output_frequency: ")
    assert table[:2] == ["name,code,value,unit,raw,status,detail", "output_frequency,d001,0.1,Hz,1,ok,"]
    assert json.loads(table[-1])[0]["value"] == 0.1
    assert facts[:2] == ["Base frequency 0.0 400.0 Hz []", "Upper frequency limit 0.0 400.0 Hz ['inactive']"]
    assert facts[2:] == ["A020 base_frequency 50 Hz", "<enum 'RunSource'> modbus"]
    decode = ["decode", "hitachi_l200", "--descriptions", str(ROOT / "descriptions")]
    assert main([*decode, *caplog.messages[:3]]) == 0
    assert "A020 base_frequency = 50 Hz" in capsys.readouterr().out
    assert caplog.messages[0].startswith("unit 1: exception: the device answered exception 02h ")
    assert caplog.messages[1] == "unit 1 -> 01 03 10 28 00 01 00 C2 (A020 base_frequency)"
    assert caplog.messages[2].startswith("unit 1 <- 01 03 02 01 F4 B8 53 after ")
    assert traffic[0].startswith("<Traffic 1 requests, 1 replies; ")
    assert traffic[1] == "1 {} True"
    assert raw == ["500 50.0", "(500,)", "True", "<RunSource.MODBUS: 3>"]
    assert uss_block == ["45.0"]
    assert list(mm4.eeprom) == [(1082, 0)]
    assert failing[0].startswith("out_of_range")
    assert failing[1].startswith("2 ")
    assert "battery_voltage" in "".join(bus)


@pytest.mark.full(seconds=8)
def test_the_programs_have_types(tmp_path: Path) -> None:
    program = "\n".join(re.findall(r"^```python\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL))
    assert typed_findings(program, GENERATED, "hitachi_l200", tmp_path) == ""


def test_the_readme_has_the_first_program() -> None:
    first = re.findall(r"^```python\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)[0]
    assert first in (ROOT / "README.md").read_text("utf-8")
