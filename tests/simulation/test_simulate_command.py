"""`fieldscribe simulate`, bench files, and the fixture for pytest."""

from __future__ import annotations

import json
import os
import signal
import socket
import struct
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from fieldscribe.cli import main
from fieldscribe.diagnostics import UnclearError
from fieldscribe.simulation import Simulated
from fieldscribe.simulation.bench import Bench, carry_out

L200 = "hitachi_l200"


def ends(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> tuple[int, str]:
    return main(["simulate", *arguments, "--for", "0"]), "".join(capsys.readouterr())


def test_a_port_that_is_taken_ends_with_the_reason(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    trace = tmp_path / "trace"
    held = '{"of": "the simulator that has the port"}\n'
    trace.write_text(held, "utf-8")
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        code, printed = ends([L200, "--tcp", str(port), "--trace", str(trace)], capsys)
    assert (code, trace.read_text("utf-8")) == (2, held)
    assert f"port {port} of 127.0.0.1 cannot be served: it is taken" in printed


def test_a_file_that_is_no_trace_is_kept(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "mine").write_text("[lines]\n", "utf-8")
    code, printed = ends([L200, "--trace", str(tmp_path / "mine")], capsys)
    assert (code, (tmp_path / "mine").read_text("utf-8")) == (2, "[lines]\n")
    assert "is there, and no trace: it would be lost" in printed


@pytest.mark.parametrize(
    ("arguments", "reason"),
    [
        ([L200, "--serial", "/dev/no_such_port"], "`/dev/no_such_port` cannot be served: No such file or directory"),
        ([L200, "--serial", os.devnull], f"`{os.devnull}` cannot be served: Inappropriate ioctl for device"),
        ([L200, "--tcp", "no.such.host.invalid:0"], "port 0 of no.such.host.invalid cannot be served: "),
        ([L200, "--tcp", "99999"], "`99999` is no TCP port"),
        ([L200, "--tcp", "192.0.2.1:0"], "port 0 of 192.0.2.1 cannot be served: Cannot assign requested address\n"),
        ([L200, "--tcp", "x"], "`x` is no TCP port"),
        ([L200, "--can", "virtual:x"], "hitachi_l200 is on no can line"),
        ([L200, "--with", "slot=3"], "no address depends on `slot=3`"),
        ([L200, "--tcp", "0", "--framing", "uss"], "hitachi_l200 is on no tcp line with uss"),
        ([L200, "--unit", "99"], "hitachi_l200 has no unit 99"),
        ([L200, f"{L200}@1"], "two devices on the line have the unit 1"),
        ([L200, "eastron_sdm630@x"], "`eastron_sdm630@x` names no unit"),
        ([L200, "siemens_mm4"], "devices of modbus and uss cannot share a line"),
        ([L200, "--set", "A020"], "--set: `A020` gives no value"),
        ([L200, "--set", "A020=fast"], "`fast` is no number"),
        ([L200, "--set", "A099=1"], "has no point `A099`"),
        ([L200, "--unmet", "stopped"], "no write needs the condition `stopped`"),
        ([L200, "--fault", "tired"], "there is no fault `tired`"),
        ([L200, "--fault", "late soon"], "`soon` does not belong to the fault `late`"),
        ([L200, "--fault", "late 0.5 101%"], "`101%` does not belong to the fault `late`"),
        ([L200, "--fault", "silent x0"], "`x0` does not belong to the fault `silent`"),
        ([L200, "--time-scale", "-1"], "a time scale is a number from 0"),
        ([], "there is nothing to simulate"),
        ([L200, "--tcp", "0", "--speed", "300"], "a TCP line has no speed"),
        ([L200, "--serial", "--speed", "0"], "`0` is no number of bits per second from 1 to 100000000"),
        ([f"{L200}@1", "--unit", "2"], f"--unit would have no effect on `{L200}@1`"),
        (["--bench", "bench.yaml", "--set", "A020=5"], "a bench file is given, and --set would have no effect"),
        (["--bench", "bench.yaml", "--time-scale", "2"], "--time-scale would have no effect"),
    ],
)
def test_what_cannot_be_simulated_ends_with_the_reason(
    arguments: list[str], reason: str, capsys: pytest.CaptureFixture[str]
) -> None:
    code, printed = ends(arguments, capsys)
    assert code == 2
    assert reason in printed


def test_nobody_beyond_this_machine_is_served_unless_it_is_wanted(capsys: pytest.CaptureFixture[str]) -> None:
    assert "on tcp://127.0.0.1:" in ends([L200], capsys)[1]
    assert "on tcp://127.0.0.1:" in ends([L200, "--tcp", "0"], capsys)[1]
    assert "on tcp://0.0.0.0:" in ends([L200, "--tcp", "0.0.0.0:0"], capsys)[1]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("lines: 3\n", ":1:8: `lines` is a list"),
        (
            "lines:\n- {tcp: 0, devices: [{device: nord_sk5xxe, refusals: {nosuch: 0}}]}\n",
            ":2:63: modbus has no refusal `nosuch`\n  hint: there are function, address, format, absent, part",
        ),
        ("", ":1:1: the file is empty\n  hint: write `lines:`"),
        ("# no lines\n", ":2:1: the file holds only comments\n  hint: write `lines:`"),
        ("- tcp: 5020\n", ":1:1: a document must be a mapping of keys to values\n  hint: write `lines:`"),
        ("line: []\n", ":1:7: there is no key `line` here"),
        ("lines: []\n", ":1:8: there is no line\n  hint: write"),
        ("lines:\n- {tcp: 0, serial: x, devices: []}\n", ":2:3: a line is one of tcp, serial and can"),
        ("lines:\n- {tcp: 0, devices: []}\n", ":2:3: a line is one of tcp, serial and can, and has devices"),
        ("lines:\n- {tcp: 0, devices: [{device: nothing}]}\n", ":2:31: there is no device `nothing`"),
        ("lines:\n- {tcp: 0, devices: [{device: eastron}]}\n", "`eastron`\n  hint: did you mean `eastron_sdm630`?"),
        ("lines:\n- {tcp: 0, devices: [{device: nord_sk5xxe, behaviour: maybe}]}\n", ":2:55: `maybe` is not yes or no"),
        ("lines:\n- {tcp: 0, devices: [{device: nord_sk5xxe, unit: one}]}\n", ":2:50: `unit` is a whole number"),
        ("lines:\n- {tcp: 0, devices: [{device: nord_sk5xxe, units: 1-4}]}\n", ":2:51: `1-4` is no interval"),
        ("lines:\n- {tcp: 0, devices: [{device: nord_sk5xxe, units: 4..1}]}\n", ":2:51: `4..1` is no interval"),
        ("lines:\n- {tcp: 0, devices: [nord_sk5xxe]}\n", ":2:22: this is no mapping"),
        ("lines: [\n", ":2:1: this is not YAML"),
        ("lines:\n- {tcp: 0, faults: [tired], devices: [{device: nord_sk5xxe}]}\n", "there is no fault `tired`"),
    ],
)
def test_a_wrong_bench_file_says_where(
    text: str, message: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "bench.yaml").write_text(text, "utf-8")
    code, printed = ends(["--bench", str(tmp_path / "bench.yaml")], capsys)
    assert code == 2
    assert message in printed


def test_the_console_reads_writes_and_spoils() -> None:
    devices = [{"device": L200, "units": "1..2", "behaviour": False}, {"device": "eastron_sdm630", "unit": 3}]
    bench = Bench({"lines": [{"devices": devices}], "time_scale": 0})
    (line,) = bench.lines
    assert carry_out(bench, "@1 set A020=60 Hz") == ""
    assert carry_out(bench, "@1 get A020") == "1 A020 = 60"
    assert carry_out(bench, "@2 get base_frequency") == "2 base_frequency = 50"
    assert carry_out(bench, "@3 unmet password_entered") == ""
    assert line.core.devices[2].conditions == {"password_entered": False}
    assert carry_out(bench, "fault cut 4 x2") == ""
    assert [fault.kind for fault in line.faults.waiting] == ["cut"]
    assert (
        carry_out(bench, "clear")
        == carry_out(bench, "restart")
        == carry_out(bench, "advance 2.5")
        == carry_out(bench, "")
        == ""
    )
    assert (line.faults.waiting, bench.clock.now()) == ([], 2.5)
    assert carry_out(bench, "help").startswith("get POINT")
    for wrong in (
        "@9 get A020",
        "get A020",
        "@1 set A020",
        "@1 set A020=fast",
        "get",
        "advance",
        "advance far",
        "advance nan",
        "advance 1e400",
        "advance -1",
        "met hope",
        "fault",
    ):
        with pytest.raises(UnclearError):
            carry_out(bench, wrong)
    with pytest.raises(EOFError):
        carry_out(bench, "quit")


def test_a_trace_can_be_thrown_away(capsys: pytest.CaptureFixture[str]) -> None:
    assert ends([L200, "--trace", os.devnull], capsys)[0] == 0


@pytest.mark.parametrize(
    ("commands", "last"),
    [
        (f"set A020=60{' ' * 1000}\n" * 200 + "set A020=40\nget A020\nquit\n", "1 A020 = 40"),
        ("get A020\nquit\nget F002\n", "1 A020 = 50"),
        ("x" * 300_000 + "\nget A020\nquit\n", "1 A020 = 50"),
    ],
)
@pytest.mark.parametrize("piped", [False, True])
def test_long_files_of_commands(commands: str, last: str, tmp_path: Path, *, piped: bool) -> None:
    """None of them ends where the reads of a pipe or of a file end."""
    (tmp_path / "commands").write_text(commands, "utf-8")
    command = [sys.executable, "-m", "fieldscribe", "simulate", L200, "--tcp", "0", "--for", "60" if piped else "0"]
    with open(tmp_path / "commands", encoding="utf-8") as file:
        given: dict[str, Any] = {"input": commands} if piped else {"stdin": file}
        done = subprocess.run(command, **given, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout.splitlines()[-2:]) == (0, [last, "0 requests"])


def test_no_command_is_carried_out_after_the_end() -> None:
    command = [sys.executable, "-m", "fieldscribe", "simulate", L200, "--tcp", "0", "--for", "0.1"]
    text = f"set A020=60{' ' * 1000}\nget A020\n" * 2000
    done = subprocess.run(command, input=text, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout.splitlines()[-1]) == (0, "0 requests")


@pytest.mark.parametrize("device", [L200, "eastron_sdm630"])
def test_help_names_the_quantities_of_the_behaviour(device: str) -> None:
    said = carry_out(Bench({"lines": [{"devices": [{"device": device}]}]}), "help")
    assert ("load                Motor current at any speed (%)\n" in said) is (device == L200)
    assert ("\nexternal_trip_code  Code of an external trip, which the manual does not name\n" in said) is (
        device == L200
    )


def test_commands_come_from_a_file_too(tmp_path: Path) -> None:
    (tmp_path / "commands").write_text("set A020=60\nget A020\nget", "utf-8")
    command = [sys.executable, "-m", "fieldscribe", "simulate", L200, "--tcp", "0", "--for", "0"]
    with open(tmp_path / "commands", encoding="utf-8") as commands:
        done = subprocess.run(command, stdin=commands, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout.splitlines()[1:]) == (0, ["1 A020 = 60", "0 requests"])
    assert done.stderr == "fieldscribe: `get` needs more\n  hint: `help` says what\n"


@pytest.mark.full(seconds=2)
def test_the_command_serves_until_a_signal(tmp_path: Path) -> None:
    trace = tmp_path / "trace.jsonl"
    trace.write_text('{"line": "an older one"}\n', "utf-8")
    words = [L200, "--tcp", "0", "--strict", "--trace", str(trace), "--fault", "exception x1"]
    command = [sys.executable, "-m", "fieldscribe", "simulate", *words]
    with subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as running:
        assert running.stdout is not None
        port = int(running.stdout.readline().rpartition(":")[2])
        with socket.create_connection(("127.0.0.1", port)) as client:
            for request, reply in (("000100000006010310280001", "8304"), ("000200000006010300030001", "8302")):
                client.sendall(bytes.fromhex(request))
                assert client.recv(300)[7:].hex() == reply
        running.send_signal(signal.SIGTERM)
        printed, complaints = running.communicate()
    assert running.returncode == 1
    assert printed == "2 requests, 1 against the manual\n"
    assert complaints == "address: nothing is at holding 3 (manual, line 138)\n"
    assert [json.loads(line)["fault"] for line in trace.read_text("utf-8").splitlines()] == ["exception", None]


def test_the_fixture_runs_devices(simulated_device: Callable[..., Simulated]) -> None:
    drive, other = simulated_device(L200, values={"A020": 12.5}), simulated_device(L200, on="serial")
    assert (drive.port > 0, other.port, drive.values["A020"]) == (True, 0, 12.5)
    drive.values["output_frequency"] = 30.0
    assert drive.values["d001"] == 30
    with pytest.raises(KeyError, match="has no point `A999`"):
        drive.values["A999"] = 1
    with pytest.raises(ValueError, match=r"base_frequency cannot hold 9999: raw 99990 is outside 0\.\.65535"):
        drive.values["A020"] = 9999
    wrong: tuple[tuple[dict[str, Any], str], ...] = (
        ({"on": "usb"}, "there is no line `usb`"),
        ({"variants": ["400V"]}, "`400V` is no variant"),
    )
    for settings, message in wrong:
        with pytest.raises(UnclearError, match=message) as error:
            simulated_device(L200, **settings)
        assert error.value.__notes__[0].startswith("hint: ")


def test_clients_that_do_not_wait_for_their_answers_do_no_harm(
    simulated_device: Callable[..., Simulated],
    caplog: pytest.LogCaptureFixture,
) -> None:
    drive = simulated_device(L200, behaviour=False)
    request = bytes.fromhex("000100000006010310280001")
    for noise in (b"", b"\x00\x01\xff", request[:7]):
        client = socket.create_connection(("127.0.0.1", drive.port))
        client.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))  # it ends with a reset
        client.sendall((noise + request) * 400)
        client.close()
    with socket.create_connection(("127.0.0.1", drive.port)) as client:
        client.sendall(request)
        assert client.recv(300).hex() == "00010000000501030201f4"
    assert caplog.messages == []
