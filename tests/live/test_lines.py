"""Lines and stations: what they may be named, and what is said of those that cannot be."""

from __future__ import annotations

import termios
from argparse import Namespace
from collections.abc import Callable
from pathlib import Path

import pytest
from fieldscribe.cli.live_options import line_of
from fieldscribe.diagnostics import Report, UnclearError
from fieldscribe.families import families
from fieldscribe.live.lines import Station, examples, families_of, read_line, read_project, schemes_of
from fieldscribe.simulation import simulated
from fieldscribe.vendoring import project_file as vendoring
from support.small_drive import Output

SERIAL = {"baudrate": 9600, "mode": "8N1", "echo": False}


@pytest.mark.parametrize(
    ("text", "families", "place", "settings"),
    [
        ("tcp://192.168.0.20", ["modbus"], "192.168.0.20", {}),
        ("rtu+tcp://[::1]:4001", ["modbus"], "[::1]:4001", {}),
        ("rtu:///dev/ttyUSB0?baud=19200&parity=even", ["modbus"], "/dev/ttyUSB0", {"baud": "19200", "parity": "even"}),
        ("uss://COM3?pkw=4&pzd=2", ["uss"], "COM3", {"pkw": "4", "pzd": "2"}),
        ("can://socketcan/can0?bitrate=250000", ["can"], "socketcan/can0", {"bitrate": "250000"}),
    ],
)
def test_a_line_has_a_scheme_a_place_and_settings(
    text: str, families: list[str], place: str, settings: dict[str, str]
) -> None:
    line = read_line(text)
    assert [family.name for family in families_of(line)] == families
    assert (line.place, line.settings) == (place, settings)


@pytest.mark.parametrize(
    ("text", "host", "port"),
    [("tcp://a", "a", 502), ("tcp://a:5020", "a", 5020), ("tcp://[::1]", "::1", 502), ("tcp://[::1]:7", "::1", 7)],
)
def test_a_host_may_have_a_port(text: str, host: str, port: int) -> None:
    assert read_line(text).host_and_port(502) == (host, port)


@pytest.mark.parametrize(
    ("query", "settings"),
    [
        ("", SERIAL),
        ("?baud=19200&parity=even&stop=2&bits=7", {"baudrate": 19200, "mode": "7E2", "echo": False}),
        ("?echo=yes&parity=odd", {**SERIAL, "mode": "8O1", "echo": True}),
    ],
)
def test_a_serial_line_has_settings(query: str, settings: dict[str, object]) -> None:
    assert read_line(f"rtu:///dev/tty{query}").serial("8N1") == {"port": "/dev/tty", **settings}


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "`` is no line"),
        ("/dev/ttyUSB0", "`/dev/ttyUSB0` is no line"),
        ("tpc://a", "no line begins with `tpc://`"),
        ("tcp://a?baud=9600", "there is no setting `baud`; it takes no settings"),
        ("rtu:///dev/tty?baut=9600", "there is no setting `baut`; it takes baud, parity, stop, bits, echo"),
    ],
)
def test_what_is_no_line(text: str, message: str) -> None:
    with pytest.raises(UnclearError) as caught:
        read_line(text)
    assert message in caught.value.message
    assert caught.value.hint


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("rtu://?baud=9600", "it takes a port"),
        ("rtu:///dev/tty?baud=fast", "`baud` is a number from 1 to 10000000, not `fast`"),
        ("rtu:///dev/tty?baud=0", "`baud` is a number"),
        ("rtu:///dev/tty?parity=E", "`parity` is one of none, even, odd, not `E`"),
        ("rtu:///dev/tty?stop=3", "`stop` is one of 1, 2, not `3`"),
    ],
)
def test_wrong_settings_of_a_serial_line(text: str, message: str) -> None:
    with pytest.raises(UnclearError) as caught:
        read_line(text).serial("8N1")
    assert message in caught.value.message


def test_there_is_an_example_of_the_lines_of_each_family() -> None:
    shown = {read_line(text).scheme for text in examples()}
    assert all(shown & set(schemes_of(family)) for family in families())


@pytest.mark.parametrize(
    ("setting", "message"), [("pkw=99", "part is 0, 3, 4, 127 words long, not 99"), ("pzd=17", "process data")]
)
def test_a_link_that_the_device_does_not_have(setting: str, message: str, run: Callable[..., Output]) -> None:
    with simulated("siemens_mm4") as drive:
        done = run("read", "siemens_mm4", "P1082", "--line", f"uss://{drive.path}?{setting}")
    assert (done.code, done.out) == (2, "")
    assert message in done.err


@pytest.mark.parametrize("text", ["tcp://", "tcp://a:0", "tcp://a:99999", "tcp://a:x", "tcp://:502"])
def test_what_is_no_host(text: str) -> None:
    with pytest.raises(UnclearError, match="it takes a host and a port"):
        read_line(text).host_and_port(502)


def test_a_station_says_what_the_command_line_does_not(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    text = '[lines]\nbench = "tcp://a"\n[stations.pump]\ndescription = "hitachi_l200"\nline = "bench"\nunit = 3\n'
    (tmp_path / "fieldscribe.toml").write_text(text, "utf-8")
    monkeypatch.chdir(tmp_path)
    given = Namespace(device="pump", line=None, unit=None, variant=[], settings=[])
    assert (line_of(given), given.device, given.unit) == (read_line("tcp://a"), "hitachi_l200", 3)
    given = Namespace(device="pump", line="tcp://b", unit=4, variant=[], settings=[])
    assert (line_of(given), given.device, given.unit) == (read_line("tcp://b"), "hitachi_l200", 4)


def test_a_project_names_lines_and_stations(tmp_path: Path) -> None:
    file = tmp_path / "fieldscribe.toml"
    assert read_project(file) == ({}, {})
    file.write_text(
        'out = "drivers"\n[lines]\nbench = "tcp://a"\n[stations.pump]\ndescription = "hitachi_l200"\nline = "bench"\n'
        'unit = 3\nvariant = {voltage_class = "400V"}\nwith = {slot = 3}\n'
        '[stations.meter]\ndescription = "eastron_sdm630"\n',
        "utf-8",
    )
    lines, stations = read_project(file)
    assert lines == {"bench": "tcp://a"}
    assert stations["pump"] == Station("hitachi_l200", "bench", 3, ("voltage_class=400V",), ("slot=3",))
    assert stations["meter"] == Station("eastron_sdm630")
    file.write_text(file.read_text("utf-8") + '[[devices]]\ndevice = "hitachi_l200"\ntargets = ["c"]\n', "utf-8")
    report = Report()
    assert len(vendoring.read_project(file, report)) == 1
    assert not report.findings


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[lines", "this is no TOML"),
        ("lines = 3", "`lines` is no table"),
        ("[lines]\na = 3", "lines.a is no text"),
        ("[stations]\na = 3", "stations.a is no table"),
        ("[stations.a]\nline = 'b'", "stations.a has no `description`"),
        ("[stations.a]\ndescripton = 'b'", "stations.a has no key `descripton`"),
        ("[stations.a]\ndescription = 'b'\nunit = true", "stations.a.unit is no whole number"),
    ],
)
def test_what_is_wrong_in_a_project(text: str, message: str, tmp_path: Path) -> None:
    file = tmp_path / "fieldscribe.toml"
    file.write_text(text, "utf-8")
    with pytest.raises(UnclearError) as caught:
        read_project(file)
    assert message in caught.value.message
    assert str(file) in caught.value.message


def test_a_port_that_takes_no_such_settings(monkeypatch: pytest.MonkeyPatch, run: Callable[..., Output]) -> None:
    """Of an adapter that knows no such parity, pyserial lets the error of the system through."""

    def refuses(*_: object, **__: object) -> None:
        raise termios.error(22, "Invalid argument")

    monkeypatch.setattr("serial.serial_for_url", refuses)
    done = run("read", "hitachi_l200", "A020", "--line", "rtu:///dev/ttyUSB9?parity=even")
    assert (done.code, done.out) == (2, "")
    assert "/dev/ttyUSB9 cannot be set as the line needs it: (22, 'Invalid argument')" in done.err


def test_a_bus_without_its_package_says_how_to_install_it(
    monkeypatch: pytest.MonkeyPatch, run: Callable[..., Output]
) -> None:
    """The error is that of python-can without msgpack, whether that is installed here or not."""
    import can

    def lacking(*_: object, **__: object) -> None:
        raise can.CanInterfaceNotImplementedError("msgpack not installed")

    monkeypatch.setattr(can, "Bus", lacking)
    done = run("read", "woodward_mpu2s", "generator_frequency", "--line", "can://udp_multicast/239.74.163.2")
    assert (done.code, done.err.splitlines()[-1]) == (2, "  hint: pip install 'python-can[multicast]'")
