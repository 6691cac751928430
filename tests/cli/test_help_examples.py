"""Every example of `--help` runs as it stands, and does what it shows: ends so, says so, makes these files."""

from __future__ import annotations

import re
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import pytest
from fieldscribe.cli import COMMANDS, command_named, discovery, live_options
from fieldscribe.live.lines import LineAddress, read_line
from fieldscribe.live.snapshots import Held, defaults
from fieldscribe.simulation import simulated
from support.described import shipped
from support.help_examples import (
    asked_for,
    audited,
    committed,
    drafted,
    examples_of,
    ran,
    stops_at_once,
    with_one_device,
    workplace,
)


class Claim(NamedTuple):
    """What an example does: how it ends, a pattern in what it prints, one in its messages, and what is there then."""

    code: int
    said: str
    told: str = ""
    made: str = ""


A020 = r"A020 base_frequency: .*\n  Found as +"
MAXIMUM = r"P1082 maximum_frequency"

CLAIMS = {
    "check": {
        "": Claim(0, r"hitachi_l200: \d+ points (.|\n)*woodward_mpu2s: \d+ points"),
        "descriptions/hitachi_l200 --format json": Claim(0, r'"device": "hitachi_l200"(.|\n)*"findings": \[\]'),
    },
    "generate": {
        "hitachi_l200 --target c --out firmware/drivers": Claim(
            0, r"\d+ written, .* in firmware/drivers", made="firmware/drivers/c/hitachi_l200.h"
        ),
        "--check": Claim(1, r"stale: generated/c/hitachi_l200\.h"),
        "--check --strict-version": Claim(1, r"stale: generated/c/hitachi_l200\.h"),
    },
    "export": {
        "json hitachi_l200": Claim(0, r'"device": "hitachi_l200"'),
        "json hitachi_l200 | jq '.points[] | select(.code == \"A020\")'": Claim(
            0, r'"points": \[(.|\n)*"code": "A020"'
        ),
        "dbc woodward_mpu2s --unit 3 > mpu2s_3.dbc": Claim(0, r"BO_ 803 "),  # 323h
    },
    "explain": {
        "hitachi_l200 A020": Claim(0, A020 + "code A020"),
        "hitachi_l200 0x1028": Claim(0, A020 + r"wire address 1028h \(4136\), holding"),
        "hitachi_l200 modicon:4137 --as-documented": Claim(0, A020 + "modicon 4137"),
        "woodward_mpu2s nr:2": Claim(0, r"generator_frequency: .*\n  Found as +nr 2"),
        "woodward_mpu2s can:321": Claim(0, "message visualisation: .*\n  Found as +CAN identifier 321h of unit 1"),
        'siemens_mm4 "P2010[1]"': Claim(
            0, r"P2010 uss_baud_rate_index_1: (.|\n)*Wire address +07DAh \(2010\), index 1"
        ),
        "siemens_mm4 error:17": Claim(0, "error 17 not_in_this_operating_state"),
        "hitachi_l200 d001 --raw 0xFE0C": Claim(0, r"is outside 0\.\.400 Hz\n  Doubt +as a signed number it is -50 Hz"),
        "hitachi_l200 unit:Hz": Claim(0, r"Hz: hertz(.|\n)*Points +network_frequency_setpoint"),
    },
    "listen": {
        "hitachi_l200 --capture plant.pcapng": Claim(0, r"10\.0\.0\.1:4000  unit 1  read  output_frequency = 50 Hz"),
        'hitachi_l200=1 nord_sk5xxe=2 --line "rtu:///dev/ttyUSB0?baud=9600"': Claim(2, "^$", "it cannot be opened"),
        "woodward_mpu2s --line can://socketcan/can0 --for 60": Claim(2, "^$", "python-can cannot open it"),
        "hitachi_l200=1 nord_sk5xxe=2 --capture gateway.log --write gateway.pcapng": Claim(
            0, r"unit 1  read  base_frequency\n", made="gateway.pcapng"
        ),
        "woodward_mpu2s --capture - --summary": Claim(0, r"2 exchanges(.|\n)*generator_power_exponent"),
        "woodward_mpu2s --capture candump.log --format jsonl": Claim(0, r'"generator_frequency = 50 Hz"'),
    },
    "decode": {
        'hitachi_l200 "05 06 10 28 01 F4 0C 91"': Claim(0, r"A020 base_frequency = 50 Hz(.|\n)*ok \(0C 91\)"),
        "hitachi_l200 0801000600051C91 --format json": Claim(0, r'"point": "digital_input_5"(.|\n)*"checks": "ok'),
        'hitachi_l200 "08 01 01 17 12 1A" --request "08 01 00 06 00 05 1C 91"': Claim(
            0, r"digital_input_3 = on (.|\n)*digital_input_4 = off (.|\n)*ok \(12 1A\)"
        ),
        "woodward_mpu2s 321#DD00051513880064 321#DD010302000007D0": Claim(
            0, r"telegram_identification = 1301 (.|\n)* 50 Hz (.|\n)*before: generator_active_power = 100000 W"
        ),
        'woodward_mpu2s "DD 00 05 15 13 88 00 64" --can-id 321': Claim(0, r"telegram_identification = 1301 "),
        "woodward_mpu2s --log candump.log": Claim(0, r"^\(1\.5\) can0 321#(.|\n)*^\(1\.6\) can0 321#"),
        "hitachi_l200 --log gateway.log": Claim(0, r"^  Says +A020 base_frequency: "),
        "woodward_mpu2s - --format jsonl": Claim(0, r'^{"device": .*"time": "1\.5".*}\n{.*"time": "1\.6".*}\n$'),
        'siemens_mm4 "02 0E 01 143A 0000 0000 0000 047F 3333 58"': Claim(
            0, rf"{MAXIMUM}: (.|\n)*STW control_word = raw 1151 = 047Fh(.|\n)*  Bit 0 +1  on\n(.|\n)*ok \(58\)"
        ),
        'siemens_mm4 --framing pkw "143A 0000 0000 0000" "243A 0000 4248 0000"': Claim(0, f"{MAXIMUM} = 50 Hz "),
        'siemens_mm4 --framing pzd --direction response "FA31 0000"': Claim(
            0, r"ZSW status_word (.|\n)*  Bit 0 +1  ready_to_switch_on\n"
        ),
    },
    "encode": {
        'hitachi_l200 A020 "50 Hz"': Claim(0, "base_frequency = 50 Hz: raw 500 = 01F4h"),
        "hitachi_l200 A020 50 --unit 5 --frame": Claim(0, "^05 06 10 28 01 F4 0C 91\n$", "= 50 Hz: raw 500"),
        "hitachi_l200 A061 50 --with A062=10 --with A004=60": Claim(0, "upper_frequency_limit = 50 Hz: raw 500"),
        "hitachi_l200 A061 inactive": Claim(0, r"upper_frequency_limit = inactive .*: raw 0 "),
        'woodward_mpu2s fault_text_terminal_62 "OIL PRESSURE" --frame': Claim(
            0, r"^(33F#EE01[0-9A-F]{12}\n){8}$", "a text takes 8 messages"
        ),
        "woodward_mpu2s power_measurement_phases three_phase --with-word 0400h --frame": Claim(
            0, r"^33F#EE0100150C00E214\n$", "the word becomes 0C00h"
        ),
        "siemens_mm4 P1082 40 --unit 3 --pkw 4 --keep --frame": Claim(
            0, "^02 0E 03 D4 3A 00 00 42 20 00 00 (.*)\n$", "task 13 store_double_word"
        ),
        "siemens_mm4 HSW 40 --with P2000=50 --with P2009=0 --with STW=047Fh --frame": Claim(
            0, "^02 0E 01 (00 ){8}04 7F 33 33 76\n$", "rounded to about 39.99"
        ),
    },
    "read": {
        "hitachi_l200 A020 F002 --line tcp://192.168.0.20": Claim(0, "^A020 base_frequency +50 Hz\nF002 "),
        'hitachi_l200 status --line "rtu:///dev/ttyUSB0?baud=19200" --unit 3': Claim(0, "^inverter_status +running"),
        'siemens_mm4 P1082 --line "uss:///dev/ttyUSB0?pkw=4&pzd=2" -v': Claim(
            0, "P1082 maximum_frequency +50 Hz", "1 request"
        ),
        "woodward_mpu2s generator_frequency --line can://socketcan/can0 --format json": Claim(
            0, '"name": "generator_frequency",(.|\n)*"unit": "Hz"'
        ),
        "pump output_frequency": Claim(0, "^d001 output_frequency .* Hz"),
    },
    "write": {
        "hitachi_l200 A020=50 --line tcp://192.168.0.20": Claim(2, "^$", "nobody can be asked here"),
        'hitachi_l200 "A003=50 Hz" A002=modbus --keep --line rtu:///dev/ttyUSB0 --unit 3': Claim(
            2, "^$", r"A003 (.|\n)* enter (.|\n)*the memory is rated for 100000 of these\n"
        ),
        "hitachi_l200 run_command=run --yes --line tcp://192.168.0.20": Claim(0, "written: run_command = run"),
        "hitachi_l200 enter --line tcp://192.168.0.20": Claim(2, "^$", "  enter "),
        'siemens_mm4 P1082=40 --keep --line "uss:///dev/ttyUSB0?pkw=4&pzd=2"': Claim(
            2, "^$", "P1082 (.|\n)*write only when: stopped\n.*each write wears the memory"
        ),
        "pump network_frequency_setpoint=12.5": Claim(2, "^$", "network_frequency_setpoint = 12.5 Hz"),
    },
    "monitor": {
        "hitachi_l200 status --line tcp://192.168.0.20": Claim(0, "inverter_status", "ended after"),
        "hitachi_l200 d001 d002 --every 0.2 --line rtu:///dev/ttyUSB0 --unit 3": Claim(
            0, "d001 .*\n.*d002", "ended after"
        ),
        "pump status --format csv > pump.csv": Claim(0, "^time,name,code,value", "ended after"),
        "pump status --format jsonl --count 60": Claim(0, '^{"time": ', "ended after"),
    },
    "scan": {
        '--line "rtu:///dev/ttyUSB0?baud=19200"': Claim(0, "^unit 3  holding 0x0000: "),
        "--line rtu:///dev/ttyUSB0 --units 1-4,247 --timeout 0.5": Claim(0, "^unit 3  "),
        "hitachi_l200 --line tcp://192.168.0.20": Claim(0, "^unit 1  running = "),
    },
    "identify": {
        "--line tcp://192.168.0.20": Claim(
            1, "it is not fronius_datamanager: .*\nnot asked for, as their descriptions have no `identify`: "
        ),
        "fronius_datamanager --line tcp://192.168.0.20 --unit 1": Claim(1, "it is not fronius_datamanager: "),
        "pump": Claim(1, "^not asked for, as their descriptions have no `identify`: hitachi_l200\n$"),
    },
    "snapshot": {
        "hitachi_l200 --line tcp://192.168.0.20 --out before.json": Claim(0, "^234 points in before.json\n$"),
        'siemens_mm4 --line "uss:///dev/ttyUSB0?pkw=4&pzd=2" --variant interface=rs485 --out drive.json': Claim(
            0, r"^\d+ points in drive.json\n$", made="drive.json"
        ),
        "pump --out pump.json": Claim(0, "^234 points", made="pump.json"),
    },
    "compare": {
        "before.json after.json": Claim(1, "  A020 base_frequency  60 Hz -> 40 Hz\n1 difference"),
        "meter.json": Claim(1, "  demand_period  1 min -> 60 min\n1 difference"),
        "before.json after.json --all --format json": Claim(1, '"name": "base_frequency"'),
    },
    "restore": {
        "before.json --dry-run": Claim(0, "^would be written: A020 base_frequency = 60 Hz"),
        "before.json": Claim(2, "^$", "nobody can be asked here"),
        "before.json --keep --yes --line rtu:///dev/ttyUSB0 --unit 3": Claim(
            0, "^written: A020 (.|\n)*^written: enter", made="before.json.journal"
        ),
        "before.json pump --only A020 --only standard_a --yes": Claim(0, "^written: A020 base_frequency = 60 Hz"),
    },
    "audit": {
        "hitachi_l200 --manual hitachi_l200_modbus.txt": Claim(
            1, r"the text that was transcribed(.|\n)*facts +\d+, \d+ of them not where"
        ),
        "hitachi_l200 --manual new.txt --report html > audit.html": Claim(1, "(?i)<html"),
        "hitachi_l200 --old hitachi_l200_modbus.txt --manual new.txt": Claim(
            1, r"numbers +37 places cite lines of the old edition: add --renumber"
        ),
        "hitachi_l200 --old hitachi_l200_modbus.txt --manual new.txt --renumber --accept --file new.txt": Claim(
            1, r"renumbered: \d+ lines in 1 file\nnot accepted: not every cited fact stands"
        ),
    },
    "diff": {
        "HEAD~1:descriptions/hitachi_l200 descriptions/hitachi_l200": Claim(1, "entry run_button is now run_key"),
        "v1.2.0:descriptions descriptions --format markdown > changes.md": Claim(1, r"^## hitachi\\_l200 2\.0\.0"),
        "released.json hitachi_l200 --fail-on breaking": Claim(0, "no difference"),
        "old/my_drive my_drive --keep-names": Claim(0, "no difference"),
    },
    "list": {
        "": Claim(0, r"^hitachi_l200 +modbus(.|\n)*^woodward_mpu2s +can"),
        "--family modbus --format json": Claim(0, r'"device": "hitachi_l200"(?!(.|\n)*siemens)'),
        "hitachi_l200": Claim(0, r"^ +run_command +coil +0000h"),
        'hitachi_l200 --matching "A0*" --access w': Claim(0, r"^A001 +frequency_source(?!(.|\n)*\nA1)"),
        "woodward_mpu2s --unit Hz --space telegram": Claim(0, r"generator_frequency(.|\n)*busbar_frequency"),
        "siemens_mm4 --group parameters --format csv": Claim(0, r"^code,name,.*\nr0000,display_value,"),
    },
    "search": {
        "Hochlaufzeit": Claim(0, "F002 acceleration_time: "),
        "acceleration time": Claim(0, "F002 acceleration_time: "),
        "E07": Claim(0, r"enum `Overvoltage \(E07\)` \(7\)"),
        "error:21h": Claim(0, "hitachi_l200 exception 21h "),
        "4.2.40 --device woodward_mpu2s": Claim(0, "section `4.2.40`"),
        "ueberspannung --format json": Claim(0, r"\\u00dcberspannung"),
    },
    "completion": {
        "bash > ~/.local/share/bash-completion/completions/fieldscribe": Claim(0, "complete .* fieldscribe\n$"),
        "zsh > ~/.zfunc/_fieldscribe": Claim(0, "^#compdef fieldscribe\n"),
        "fish > ~/.config/fish/completions/fieldscribe.fish": Claim(0, "complete -c fieldscribe "),
        "bash": Claim(0, "complete .* fieldscribe\n$"),
    },
    "init": {
        "": Claim(2, "^$", "missing: DEVICE, --family, "),
        'heat_pump --family modbus --vendor Example --model "HP 12" --title "Heat pump"': Claim(
            0, "made descriptions/heat_pump/device.yaml", made="descriptions/heat_pump/device.yaml"
        ),
    },
    "import": {
        "table registers.csv --device heat_pump --out heat_pump/device.yaml": Claim(
            0, "", made="heat_pump/device.yaml"
        ),
        "table manual.txt --list": Claim(0, r"701\.\.704 +points +.*2 address, 3 name"),
        "table manual.txt --lines 650..1050 --space holding --address-part 2 > registers.yaml": Claim(
            0, r"space: holding\n(.|\n)*- code: A002\n"
        ),
        "table list.csv --column code=1 --column address=3 --column range=6": Claim(
            0, r"- code: A001\n(.|\n)*at: 1\n(.|\n)*0\.\.400"
        ),
        "sunspec models --models 1,103,160 --device inverter --out inverter/device.yaml": Claim(
            0, "", "3 models, 67 points, 67 whole", made="inverter/device.yaml"
        ),
        "wb config-heater.json --device heater --out heater/device.yaml": Claim(
            0, "", r"20 rows, 16 whole; not carried: condition \(2\)", made="heater/device.yaml"
        ),
    },
    "fmt": {
        "": Claim(0, "0 formatted, "),
        "heat_pump --check": Claim(0, "0 not formatted"),
        "- < status.yaml": Claim(0, r"- \{name: speed, at: 1\}"),
    },
    "watch": {
        "heat_pump --out bindings": Claim(0, r"^\d\d:\d\d:\d\d heat_pump: \d+ written", made="bindings/c/heat_pump.h"),
        "--target c,docs": Claim(
            0, r"^\d\d:\d\d:\d\d hitachi_l200: \d+ written", made="generated/docs/hitachi_l200.md"
        ),
    },
    "simulate": {
        "hitachi_l200 --tcp 5020": Claim(0, r"^hitachi_l200 answers as unit 1 on tcp://127\.0\.0\.1:\d+\n0 requests$"),
        "hitachi_l200 eastron_sdm630@2 --serial": Claim(0, r"^eastron_sdm630 answers as unit 2 on /dev/"),
        'hitachi_l200 --set A020=60 --fault "late 0.5 x3" --strict --for 10': Claim(
            0, "^0 requests, 0 against the manual$"
        ),
        "--bench bench.yaml --trace trace.jsonl": Claim(
            0, r"unit 12 on tcp://(.|\n)*unit 1 on /dev/", made="trace.jsonl"
        ),
    },
    "vendor": {
        "c hitachi_l200 --out firmware/drivers": Claim(0, "", made="firmware/drivers/hitachi_l200.h"),
        "c hitachi_l200 --out firmware/drivers --points A001,D001,run_command": Claim(
            0, "", made="firmware/drivers/hitachi_l200.h"
        ),
        "c hitachi_l200 --out firmware/drivers --points @points.txt --single-file": Claim(
            0, "", made="firmware/drivers/hitachi_l200.h"
        ),
        "python woodward_mpu2s --out tools": Claim(0, "", made="tools/woodward_mpu2s/__init__.py"),
        'rust siemens_mm4 --out crates --points "P10*,status_word"': Claim(0, "", made="crates/siemens_mm4/Cargo.toml"),
        "typescript nord_sk5xxe --out drivers": Claim(0, "", made="drivers/nord_sk5xxe/index.js"),
        "--check": Claim(1, r"missing: vendored/hitachi_l200\.h"),
    },
    "docs": {
        "hitachi_l200 --format xlsx --out tables": Claim(0, "", made="tables/hitachi_l200.xlsx"),
        "siemens_mm4 jumo_controller --format csv --out tables": Claim(0, "", made="tables/siemens_mm4_meanings.csv"),
        "woodward_mpu2s --format html --out pages": Claim(0, "", made="pages/woodward_mpu2s.html"),
        "nord_sk5xxe --format markdown --out manuals": Claim(0, "", made="manuals/nord_sk5xxe.md"),
        "hitachi_l200 nord_sk5xxe --pages --format html --out site": Claim(
            0, "(?m)^[0-9]+ written, .* of index in site", made="site/index.html"
        ),
        "descriptions --format html --out all": Claim(
            0, "(?m)^[0-9]+ written, .* of index in all", made="all/index.html"
        ),
        "hitachi_l200 --format xlsx --out tables --check": Claim(0, "^0 of 2 files of hitachi_l200 in tables are not"),
    },
    "units": {
        "": Claim(0, r"^Hz +hertz \(frequency\)"),
        "kVAh mW": Claim(0, r"kVAh +kilovolt-ampere-hour .*= 1000 VAh\nmW +milliwatt "),
        "pressure --format json": Claim(0, r'"symbol": "Pa"'),
    },
    "schema": {
        "> schema.json": Claim(0, '"\\$schema": '),
        "--page > KEYS.md": Claim(0, "^# All keys of the description language\n"),
        "--export > exported-model.json": Claim(0, "urn:fieldscribe:export:"),
    },
}


def test_every_command_has_examples_and_every_example_a_claim() -> None:
    """A new example needs a line in the table above."""
    printed = {
        name: {_called(example.printed, name) for example in examples_of(command_named(name).example)}
        for name in COMMANDS
    }
    assert printed == {name: set(claims) for name, claims in CLAIMS.items()}
    for name in COMMANDS:
        assert command_named(name).example.count(f"fieldscribe {name}") >= len(printed[name])


def _called(printed: str, command: str) -> str:
    """What stands behind the command."""
    return printed.partition(f"fieldscribe {command}")[2].strip().rstrip(")")


ON_LINES = ("read", "write", "monitor", "scan", "identify", "snapshot", "restore")


@pytest.fixture
def lines(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Simulated devices where the examples have theirs, and a project that names one; nothing runs for ever."""
    values = {"base_frequency": 50, "inverter_status": "running"}
    project = '[lines]\nbench = "tcp://192.168.0.20"\n[stations.pump]\ndescription = "hitachi_l200"\nline = "bench"\n'
    (tmp_path / "fieldscribe.toml").write_text(project, "utf-8")
    monkeypatch.setattr(time, "sleep", _interrupted)
    monkeypatch.setattr(discovery, "_TIMEOUT", 0.02)
    with (
        simulated("hitachi_l200", values=values) as on_tcp,
        simulated("hitachi_l200", values=values, unit=3, on="serial") as on_serial,
        simulated("siemens_mm4", values={"maximum_frequency": 50, "uss_pkw_length_index_0": 4}) as mm4,
        simulated("woodward_mpu2s"),
    ):
        places = {
            "uss:///dev/ttyUSB0?": f"uss://{mm4.path}?",
            "socketcan/can0": "virtual/woodward_mpu2s",
            "192.168.0.20": f"127.0.0.1:{on_tcp.port}",
            "rtu:///dev/ttyUSB0": f"rtu://{on_serial.path}",
        }

        def read_elsewhere(text: str) -> LineAddress:
            for place, simulated_place in places.items():
                text = text.replace(place, simulated_place)
            return read_line(text)

        monkeypatch.setattr(live_options, "read_line", read_elsewhere)
        yield


def snapshots(folder: Path) -> None:
    """Files of a drive with two base frequencies, and of a meter."""
    meter = defaults(shipped("eastron_sdm630"))
    period = meter.points["demand_period"]._replace(value=1.0, text="1 min")
    texts = {"meter": replace(meter, line="x", points={**meter.points, "demand_period": period}).as_text()}
    for name, hertz in (("before", 60), ("after", 40)):
        held = Held("A020", float(hertz), "Hz", f"{hertz} Hz", 10 * hertz, "setting")
        drive = replace(meter, device="hitachi_l200", line="tcp://192.168.0.20", unit=1, taken="2027-01-01T12:00:00")
        texts[name] = replace(drive, points={"base_frequency": held}).as_text()
    for name, text in texts.items():
        (folder / f"{name}.json").write_text(text, "utf-8")


def _interrupted(seconds: float) -> None:
    if seconds >= 0.05:  # the wait of monitor, and not the silence of a line
        raise KeyboardInterrupt


FOLDERS = {
    "audit": audited,
    "diff": committed,
    "vendor": asked_for,
    "compare": snapshots,
    "restore": snapshots,
    **dict.fromkeys(("fmt", "generate", "watch"), with_one_device),
}
"""What the folder of a command needs beside the descriptions."""
CHANGES = ("audit", "diff", "fmt", "generate", "watch", "init", "import")
"""The commands whose examples, or folders, write to the descriptions."""


@pytest.mark.usefixtures("loads_once")
@pytest.mark.full(seconds=1)
@pytest.mark.parametrize("command", CLAIMS)
def test_examples_do_what_they_show(
    command: str, tmp_path: Path, request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder, capsys = workplace(tmp_path, changes=command in CHANGES), request.getfixturevalue("capsys")
    if command in FOLDERS:
        FOLDERS[command](folder)
    if command in ("diff", "fmt", "watch"):
        drafted(folder, capsys)
    if command in ("simulate", "watch"):
        stops_at_once(monkeypatch)
    if command in ON_LINES:
        request.getfixturevalue("lines")
    capsys.readouterr()
    for example in examples_of(command_named(command).example):
        claim = CLAIMS[command][_called(example.printed, command)]
        result = ran(example, folder, capsys, monkeypatch)
        assert result.code == claim.code, (example.printed, result)
        assert re.search(claim.said, result.said, re.MULTILINE), (example.printed, result)
        assert re.search(claim.told, result.told), (example.printed, result.told)
        assert (folder / claim.made).exists(), example.printed
