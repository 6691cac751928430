"""The command line: what it prints where, and how it ends."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from importlib import import_module
from io import StringIO
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import pytest
from fieldscribe import __version__
from fieldscribe.cli import COMMANDS, main
from fieldscribe.cli.common import description_paths, print_json
from fieldscribe.resources import descriptions_dir
from support.described import group, head, write

if TYPE_CHECKING:
    from collections.abc import Callable

L200 = str(descriptions_dir() / "hitachi_l200")
pytestmark = pytest.mark.usefixtures("loads_once")

PACKAGES = Path(import_module("fieldscribe").__file__ or "").parents[1]

DEVICE = head(
    device="small_drive",
    vendor="Acme",
    model="S1",
    title="{en: Small drive}",
    bus="{framings: [rtu], units: 1..32, functions: {03h: {name: read_registers, max: 16}, 06h: write_register}}",
    variants="{size: {title: {en: Size}, values: {small: {title: {en: Small}}, large: {title: {en: Large}}}}}",
    parts="[main.yaml]",
)
POINTS = """\
- {code: P1, name: speed, title: {en: "TITLE"}, at: 10h, range: 0..4000, scale: value = raw * 0.1, unit: Hz}
- {code: P2, name: ratio, title: {en: Ratio}, at: 12h, range: 1..500}
- {code: P3, name: voltage, title: {en: Voltage}, at: 14h, range: 0..1000, scale: raw = value * ratio / 400, unit: V}
- {code: P4, name: state, title: {en: State}, at: 16h, access: r, enum: {0: stop, 1: run}}
"""
MAIN = group(POINTS, title="{en: Main}", access="rw", numbering="{modicon: wire + 1}")


class Result(NamedTuple):
    """What a run did."""

    code: int
    out: str
    err: str


@pytest.fixture
def run(capsys: pytest.CaptureFixture[str]) -> Callable[..., Result]:
    """Runs the command line in this process."""

    def run_it(*words: str) -> Result:
        code = main(words)
        return Result(code, *capsys.readouterr())

    return run_it


@pytest.fixture
def small(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with ./descriptions/small_drive, as the working folder."""
    folder = tmp_path / "descriptions" / "small_drive"
    write(folder, DEVICE, main=MAIN.replace("TITLE", "Speed"))
    monkeypatch.chdir(tmp_path)
    return folder


def test_every_command_is_listed_as_it_says(run: Callable[..., Result]) -> None:
    listed = run("--help").out
    for name, does in COMMANDS.items():
        assert does in listed
        shown = run(name, "--help")
        assert shown.code == 0
        assert f"fieldscribe {name}" in shown.out
        assert "examples:" in shown.out
        assert "nds with " in shown.out


def test_version_and_usage(run: Callable[..., Result]) -> None:
    assert run("--version") == (0, f"fieldscribe {__version__}\n", "")
    nothing = run()
    assert (nothing.code, nothing.out) == (2, "")
    assert "commands:" in nothing.err
    assert run("-V") == run("--version")
    wrong = run("chekc")
    assert wrong.code == 2
    assert "did you mean `check`?" in wrong.err
    assert "did you mean `--format`?" in run("check", "--formt", "json").err
    for words in (("check", "--colour"), ("explain",), ("--nothing",), ("export", "xml", "x")):
        assert run(*words).code == 2


def test_the_questions_of_a_commissioning_engineer(run: Callable[..., Result]) -> None:
    told = run("explain", L200, "A020")
    assert told.code == 0
    for part in (
        "A020 base_frequency",
        "1028h (4136)",
        "4137",
        "0..400 Hz",
        "raw x 0.1 Hz",
        "01 03 10 28 00 01",
        "enter",
    ):
        assert part in told.out
    assert "modicon 4137" in run("explain", L200, "4137").out
    frame = run("decode", L200, "05 06 10 28 01 F4 0C 91")
    assert frame.code == 0
    for part in ("RTU, unit 5", "06h", "A020 base_frequency = 50 Hz (raw 500", "reply that repeats it", "ok (0C 91)"):
        assert part in frame.out
    wrong = run("decode", L200, "05 06 10 28 01 F4 A8 54")
    assert wrong.code == 1
    for part in ("A020 base_frequency = 50 Hz", "wrong: A8 54; these bytes give 0C 91", "write_base_frequency_crc"):
        assert part in wrong.out
    sent = run("encode", L200, "A020", "50 Hz", "--unit", "5", "--frame")
    assert sent.out == "05 06 10 28 01 F4 0C 91\n"
    assert "A020 base_frequency = 50 Hz: raw 500 = 01F4h" in sent.err


def test_check_a_whole_device(run: Callable[..., Result]) -> None:
    told = run("check", L200)
    assert (told.code, told.err) == (0, "")
    assert told.out.startswith("hitachi_l200: ")


def test_check(run: Callable[..., Result], small: Path) -> None:
    assert run("check").out == "small_drive: 4 points (4 generated) in 1 group, 0 errata, 0 printed frames\n"
    data = json.loads(run("check", "--format", "json").out)
    assert data["findings"] == []
    assert data["devices"][0]["points"] == 4
    (small / "main.yaml").write_text(MAIN.replace("at: 12h", "at: 10h"), "utf-8")
    wrong = run("check")
    assert wrong.code == 1
    assert " --> descriptions/small_drive/main.yaml:9:" in wrong.out
    assert "^" in wrong.out
    assert "1 error in 1 file" in wrong.out
    data = json.loads(run("check", "--format", "json").out)
    assert data["findings"][0]["line"] == 9
    assert run("explain", "small_drive", "P1").code == 1
    assert json.loads(run("explain", "small_drive", "P1", "--format", "json").out)["findings"]


def test_check_finds_the_same_device_twice_as_generate_does(run: Callable[..., Result], small: Path) -> None:
    """Both ask the one rule."""
    other = small.parent / "second"
    other.mkdir()
    for file in small.iterdir():
        (other / file.name).write_text(file.read_text("utf-8"), "utf-8")
    for words in (("check",), ("generate", "--target", "docs", "--list-outputs")):
        told = run(*words)
        assert told.code == 1, words
        assert "duplicate-device" in told.out + told.err
        assert "described twice in this run, first in descriptions/second/device.yaml" in told.out + told.err
    assert run("check").out.count("4 points") == 1


def test_without_paths_the_device_of_the_folder_is_meant(
    run: Callable[..., Result], small: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(small)
    told = run("check")
    assert (told.code, told.err) == (0, "")
    assert told.out.startswith("small_drive: ")
    listed = run("generate", "--target", "docs", "--list-outputs")
    assert (listed.code, "docs/small_drive.md" in listed.out) == (0, True)
    assert "hitachi" not in listed.out


def test_a_part_is_no_device(run: Callable[..., Result], small: Path) -> None:
    """One finding, not one for each key that a device has."""
    told = run("check", str(small / "device.yaml"), str(small / "main.yaml"))
    assert told.code == 1
    assert "`main.yaml` is a part of a description and no device file" in told.out
    assert "name device.yaml beside it" in told.out
    assert "1 error in 1 file" in told.out


def test_device_arguments(run: Callable[..., Result], small: Path, tmp_path: Path) -> None:
    for device in ("small_drive", "descriptions/small_drive", str(small / "device.yaml")):
        assert run("explain", device, "P1").out.startswith("P1 speed: Speed\n")
    assert run("explain", "hitachi_l200", "A020").code == 0
    unknown = run("explain", "small_drve", "P1")
    assert unknown.code == 2
    assert "did you mean `small_drive`?" in unknown.err
    assert run("explain", "P1", "P1", "--descriptions", str(tmp_path / "none")).code == 2
    assert run("explain", "hitachi_l200", "A020", "--descriptions", "descriptions").code == 2
    (tmp_path / "empty").mkdir()
    empty = run("explain", "empty", "P1")
    assert empty.code == 2
    assert "holds no device.yaml" in empty.err
    assert run("check", "empty").code == 1
    assert run("check", "nowhere").code == 2
    assert run("explain", "x" * 5000, "P1").code == 2


def test_a_folder_of_several_devices(run: Callable[..., Result], small: Path) -> None:
    write(small.parent / "other", DEVICE)
    several = run("explain", "descriptions", "P1")
    assert several.code == 2
    assert "holds 2 devices" in several.err


def test_explain(run: Callable[..., Result], small: Path) -> None:
    unknown = run("explain", "small_drive", "sped")
    assert unknown.code == 2
    assert "did you mean `speed`?" in unknown.err
    assert "described near it: `ratio` or `voltage`" in run("explain", "small_drive", "wire:0x13").err
    both = run("explain", "small_drive", "11h")
    assert "Found as" in both.out
    data = json.loads(run("explain", "small_drive", "P2", "--format", "json").out)
    assert data["found"][0]["heading"] == "P2 ratio: Ratio"
    assert run("explain", "small_drive", "P2", "--variant", "size=small").code == 0
    assert "did you mean `large`?" in run("explain", "small_drive", "P2", "--variant", "size=larg").err


def test_explain_what_is_no_point(run: Callable[..., Result]) -> None:
    assert run("explain", L200, "enter").out.startswith("command enter")
    assert "closed" in run("explain", L200, "0x35").out
    assert run("explain", L200, "write_base_frequency_crc").out.startswith("erratum write_base_frequency_crc")


def test_decode(run: Callable[..., Result], small: Path) -> None:
    unquoted = run("decode", "small_drive", *["01", "06", "00", "10", "01", "F4", "88", "18"])
    assert "P1 speed = 50 Hz" in unquoted.out
    for text, words in (("05061", "5 digits"), ("05 zz", "`zz` (piece 2)"), ("", "no bytes")):
        wrong = run("decode", "small_drive", text)
        assert (wrong.code, wrong.out) == (2, "")
        assert words in wrong.err
    request, reply = "01 03 00 14 00 01 C4 0E", "01 03 02 00 64 B9 AF"
    missing = run("decode", "small_drive", reply, "--request", request)
    assert "depends on P2 ratio" in missing.out
    assert "--with P2=VALUE" in missing.out
    given = run("decode", "small_drive", request, reply, "--with", "ratio=200")
    assert "P3 voltage = 200 V (raw 100" in given.out
    data = json.loads(run("decode", "small_drive", request, reply, "--with", "P2=200", "--format", "json").out)
    assert [one["kind"] for one in data["frames"]] == ["request", "reply"]
    assert data["frames"][1]["items"][0]["value"] == "200"
    assert run("decode", "small_drive", request, "--unit", "2").out == "no frame of that unit\n"


@pytest.mark.parametrize(
    ("words", "code", "said"),
    [
        (("P1", "50"), 0, "P1 speed = 50 Hz: raw 500 = 01F4h"),
        (("P1", "500 Hz"), 1, "500 Hz is outside 0..400 Hz"),
        (("P1", "-5Hz"), 1, "-5 Hz is outside 0..400 Hz"),
        (("P1", "50 V"), 2, "is in Hz"),
        (("P9", "50"), 2, "has no point `P9`"),
        (("sped", "50"), 2, "did you mean `speed`"),
        (("P3", "50"), 2, "give --with P2=VALUE"),
        (("P3", "50", "--with", "P2=400"), 0, "raw 50"),
        (("P3", "50", "--with", "P2"), 2, "--with POINT=VALUE"),
        (("P3", "50", "--with", "P7=1"), 2, "has no point `P7`"),
        (("P4", "run"), 1, "read only"),
        (("P1", "50", "--frame", "--unit", "300"), 1, "unit number"),
        (("P1", "50", "--variant", "size"), 2, "axis=value"),
        (("P1", "50", "--variant", "size=small", "--variant", "size=large"), 2, "choose one value of each axis"),
    ],
)
def test_encode(run: Callable[..., Result], small: Path, words: tuple[str, ...], code: int, said: str) -> None:
    told = run("encode", "small_drive", *words)
    assert told.code == code
    assert said in (told.err if code else told.out)
    if code:
        assert told.out == ""


def test_encode_as_json(run: Callable[..., Result], small: Path) -> None:
    data = json.loads(run("encode", "small_drive", "P1", "50", "--frame", "--format", "json").out)
    assert (data["raw"], data["hex"], data["frame"]) == (500, "1F4", "01 06 00 10 01 F4 88 18")


CAN, USS = str(descriptions_dir() / "woodward_mpu2s"), str(descriptions_dir() / "siemens_mm4")


@pytest.mark.parametrize(
    ("words", "code", "said"),
    [
        (
            ("decode", CAN, "321#DD00051E13880064"),
            0,
            "321#DD00051E13880064\n  Frame        CAN 321h, unit 1, visualisation",
        ),
        (
            ("decode", CAN, "DD", "00", "05", "1E", "13", "88", "00", "64", "--can-id", "321"),
            0,
            "generator_frequency = 50 Hz",
        ),
        (("decode", CAN, "321#DD00051E13880064", "--with", "PGNEXPO=3"), 0, "generator_active_power = 100000 W"),
        (("decode", CAN, "33F#FF0101FB00000000"), 1, "Checksum     wrong: 00 00; these bytes give FE FA"),
        (("decode", CAN, "321#DD00051E13880064", "--unit", "2"), 0, "no frame of that unit"),
        (("decode", CAN, "DD00"), 2, "or give the identifier with --can-id 321"),
        (("decode", CAN, "321#00", "--pkw", "0"), 2, "--pkw is for uss devices"),
        (("decode", CAN, "321#00", "--framing", "rtu"), 2, "--framing is for modbus and uss devices"),
        (("decode", L200, "00", "--can-id", "1"), 2, "--can-id is for can devices"),
        (("decode", L200, "00", "--framing", "pkw"), 2, "it takes rtu, tcp"),
        (
            ("decode", USS, "020E01143A0000000000000000000023"),
            0,
            "USS, unit 1: request, task 1 read_value, parameter 1082",
        ),
        (("decode", USS, "143A", "0000", "0000", "0000", "--framing", "pkw"), 0, "parameter 1082"),
        (
            ("decode", USS, "143A 0000 0000", "243A 0000 4248", "--framing", "pkw", "--pkw", "9"),
            2,
            "it has 0, 3, 4, 127",
        ),
        (
            ("decode", USS, "12BC 0000 0000 0005", "--framing", "pkw", "--pkw", "4", "--direction", "response"),
            0,
            "uss_rs485",
        ),
        (("encode", CAN, "fault_text_terminal_62", "OIL", "--frame"), 0, "33F#EE0102E3"),
        (("encode", CAN, "relay_1_event_1", "5", "--with-word", "12FFh"), 0, "33F#EE01"),
        (("encode", CAN, "relay_1_event_1", "5", "--frame"), 1, "say --with-word WORD"),
        (("encode", CAN, "2", "500", "--keep"), 2, "--keep is for uss devices"),
        (("encode", USS, "P1082", "40", "--framing", "pkw", "--keep"), 0, "D43A 0000 4220 0000\n"),
        (("encode", USS, "P2010", "6", "--index", "1", "--framing", "pkw"), 0, "700A 8001 0006 0000\n"),
        (("encode", USS, "HSW", "40"), 2, "give --with P2009=VALUE"),
        (("encode", USS, "HSW", "40", "--with", "P2000=50", "--with", "P2009=0"), 0, "raw 13107 = 3333h"),
        (("explain", CAN, "can:321"), 0, "can mean 3 things"),
        (("explain", USS, "P2010[1]"), 0, "index 1"),
        (("explain", USS, "error:17"), 0, "not_in_this_operating_state"),
    ],
)
def test_the_other_families(run: Callable[..., Result], words: tuple[str, ...], code: int, said: str) -> None:
    told = run(*words)
    assert told.code == code, told.err
    assert said in (told.out if told.out else told.err)


def test_frames_from_standard_input(run: Callable[..., Result], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stdin", StringIO("(1.5) can0 321#DD010302000007D0\n\n(1.6) can0 321#DD00051E13880064\n"))
    data = json.loads(run("decode", CAN, "-", "--format", "json").out)
    assert [one["time"] for one in data["frames"]] == ["1.5", "1.6"]
    assert data["frames"][1]["items"][2]["value"] == "100000"


def test_encoded_texts_as_json(run: Callable[..., Result]) -> None:
    data = json.loads(run("encode", CAN, "fault_text_terminal_62", "OIL", "--frame", "--format", "json").out)
    assert (data["raw"], data["frame"], len(data["frames"])) == (None, None, 8)
    assert data["hex"].startswith("4F494C2020")


def test_export(run: Callable[..., Result], small: Path) -> None:
    data = json.loads(run("export", "json", "small_drive").out)
    assert data["device"] == "small_drive"
    assert len(data["points"]) == 4


def test_no_escape_code_reaches_the_terminal(run: Callable[..., Result], small: Path) -> None:
    """Neither from a title that compiles, nor from a line that does not."""
    hostile = MAIN.replace("TITLE", "\\e[31mred\\u202e\\a")
    (small / "main.yaml").write_text(hostile, "utf-8")
    runs = [
        run("check"),
        run("explain", "small_drive", "P1"),
        run("explain", "small_drive", "P1", "--format", "json"),
        run("decode", "small_drive", "01 06 00 10 01 F4 88 18"),
        run("export", "json", "small_drive"),
        run("explain", "small_drive", "\x1b[31m"),
        run("encode", "small_drive", "P1", "\x1b[31m"),
    ]
    (small / "main.yaml").write_text(hostile.replace("at: 12h", "at: \u202e12h"), "utf-8")
    runs.append(run("check"))
    assert runs[-1].code == 1
    for told in runs:
        for text in (told.out, told.err):
            assert not {"\x1b", "\u202e", "\x07"} & set(text)


class _Screen(StringIO):
    """A terminal to write to."""

    def isatty(self) -> bool:
        """Somebody looks on."""
        return True


@pytest.mark.parametrize(
    ("no_colour", "term", "coloured"), [("", "xterm", True), ("1", "xterm", False), ("", "dumb", False)]
)
def test_colour_is_for_terminals(
    monkeypatch: pytest.MonkeyPatch, small: Path, no_colour: str, term: str, coloured: bool
) -> None:
    screen = _Screen()
    monkeypatch.setenv("NO_COLOR", no_colour)
    monkeypatch.setenv("TERM", term)
    monkeypatch.setattr(sys, "stdout", screen)
    assert main(["explain", "small_drive", "P1"]) == 0
    (small / "empty").mkdir()
    assert main(["check", str(small / "empty")]) == 1
    assert ("\x1b[" in screen.getvalue()) == coloured
    assert "P1 speed: Speed" in screen.getvalue()
    assert "no-device" in screen.getvalue()


@pytest.mark.parametrize(
    ("error", "code", "said"),
    [
        (KeyboardInterrupt(), 130, ""),
        (PermissionError(13, "Permission denied", "a.yaml"), 2, "Permission denied: a.yaml"),
        (ZeroDivisionError("odd\x1b"), 2, "internal error: ZeroDivisionError: odd\\x1b"),
    ],
)
def test_no_traceback(
    monkeypatch: pytest.MonkeyPatch, run: Callable[..., Result], error: BaseException, code: int, said: str
) -> None:
    def fail(_: object) -> int:
        raise error

    monkeypatch.setattr("fieldscribe.cli.check.run", fail)
    monkeypatch.delenv("FIELDSCRIBE_DEBUG", raising=False)
    told = run("check")
    assert told.code == code
    assert said in told.err
    assert "Traceback" not in told.err
    assert told.err.count("\n") <= 1
    monkeypatch.setenv("FIELDSCRIBE_DEBUG", "1")
    assert ("Traceback" in run("check").err) == ("internal" in said)


def _process(*words: str, **more: str) -> subprocess.CompletedProcess[str]:
    environment = {**os.environ, "PYTHONPATH": str(PACKAGES), **more}
    command = [sys.executable, "-m", "fieldscribe", *words]
    return subprocess.run(command, capture_output=True, text=True, env=environment, timeout=60, check=False)


def test_as_a_process() -> None:
    told = _process("decode", L200, "05 06 10 28 01 F4 0C 91", PYTHONIOENCODING="ascii")
    assert (told.returncode, told.stderr) == (0, "")
    assert "A020 base_frequency = 50 Hz" in told.stdout
    assert "\x1b" not in told.stdout


def test_a_reader_that_goes_away() -> None:
    command = f'"{sys.executable}" -m fieldscribe export json "{L200}" | head -c 1'
    environment = {**os.environ, "PYTHONPATH": str(PACKAGES)}
    told = subprocess.run(command, shell=True, capture_output=True, text=True, env=environment, timeout=60, check=False)
    assert (told.stdout, told.stderr) == ("{", "")


def test_a_closed_stdout_is_no_bug() -> None:
    """A caller may close it: there is nothing to write to, and the exit code still tells."""
    command = f"{sys.executable} -m fieldscribe decode {L200} '05 06 10 28 01 F4 0C 91' >&-"
    environment = {**os.environ, "PYTHONPATH": str(PACKAGES)}
    done = subprocess.run(command, shell=True, capture_output=True, text=True, env=environment, timeout=60, check=False)
    assert (done.returncode, done.stderr) == (0, "")


def _rtu(text: str) -> str:
    """Bytes with their check."""
    data = bytes.fromhex(text)
    crc = 0xFFFF
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = crc >> 1 ^ (0xA001 if crc & 1 else 0)
    return (data + crc.to_bytes(2, "little")).hex(" ")


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ((L200, _rtu("01 06 10 28 FF FF")), "6553.5 Hz is outside 0..400 Hz"),
        ((L200, _rtu("01 03 10 28 00 05")), "the device takes at most 4 of them in one request"),
        ((L200, _rtu("01 03 00 30 00 01")), "the manual closes 002Fh to 08FFh"),
        ((L200, _rtu("28 03 10 28 00 01")), "the device cannot have unit 40"),
        ((L200, _rtu("01 04 10 28 00 01")), "the device does not know function 04h"),
        ((L200, "00 07 00 00 00 06 05 03 10 28 00 01", "--framing", "tcp"), "the manual knows only RTU frames"),
        ((L200, _rtu("00 03 10 28 00 01")), "only writes may be sent to all units"),
        ((CAN, "321#DDFF000000000000"), "the manual knows multiplexers 0 to 22 only"),
        ((USS, "A43A 0000 0000 0000", "--framing", "pkw"), "the device cannot do this task"),
        ((USS, "343A 0000 4220", "--framing", "pkw", "--pkw", "3"), "does not fit into this parameter part"),
        ((USS, "007F 0000", "--framing", "pzd"), "breaks what is always written: bit 10 always 1"),
    ],
)
def test_decode_ends_with_1_for_what_a_sound_frame_asks_wrongly(
    run: Callable[..., Result], words: tuple[str, ...], said: str
) -> None:
    """The frame itself is whole; what it asks for or writes is not what the device takes."""
    told = run("decode", *words)
    assert (told.code, said in told.out) == (1, True), told.out
    data = json.loads(run("decode", *words, "--format", "json").out)["frames"][0]
    assert data["faults"] == []
    assert data["findings"] or any(item["findings"] for item in data["items"])


@pytest.mark.parametrize(
    "words",
    [
        (L200, _rtu("01 06 10 28 01 F4")),
        (L200, _rtu("00 06 10 28 01 F4")),
        (L200, _rtu("01 03 10 28 00 01"), _rtu("01 03 02 FF FF")),
        (L200, _rtu("01 03 10 29 00 01")),
        (USS, "020E01143A0000000000000000000023"),
    ],
)
def test_decode_ends_with_0_for_notes_and_for_what_replies_bring(
    run: Callable[..., Result], words: tuple[str, ...]
) -> None:
    told = run("decode", *words)
    assert told.code == 0, told.out


CONDITIONS = """\
- {name: mode, title: {en: Mode}, at: 17h, enum: {0: local, 1: remote}}
- {name: cascade, title: {en: Cascade}, at: 18h, range: 0..100, when: size == large and mode == remote}
- {name: simple, title: {en: Simple}, at: 19h, range: 0..100, when: size == small}
- {name: double, title: {en: Double}, at: 19h, range: 0..200, when: size == large}
"""


def test_what_the_chosen_variant_does_not_have_is_refused(run: Callable[..., Result], small: Path) -> None:
    """A condition that the variant makes impossible is named, in every command that takes variants."""
    (small / "main.yaml").write_text(MAIN.replace("TITLE", "Speed") + CONDITIONS, "utf-8")
    only = "it exists only when size == large and mode == remote"
    encode, chosen = ("encode", "small_drive", "cascade", "10", "--frame"), ("--variant", "size=small")
    frame = run(*encode).out.strip()
    assert run(*encode, "--variant", "size=large").out.strip() == frame
    refused = run(*encode, *chosen)
    assert (refused.code, refused.out) == (1, "")
    assert f"cascade: {only}" in refused.err
    heard = run("decode", "small_drive", frame, *chosen)
    assert heard.code == 1
    assert f"Cascade; {only}" in heard.out
    assert run("decode", "small_drive", frame).code == 0
    read = "01 03 00 18 00 01 04 0D"
    assert only in run("decode", "small_drive", read, *chosen).out
    told = run("explain", "small_drive", "wire:0x18", *chosen)
    assert (told.code, told.out) == (1, "")
    assert only in told.err
    assert run("explain", "small_drive", "cascade").code == 0


def test_without_descriptions_the_shipped_ones_are_meant(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """And that is said; a folder of one's own, and a device that lies here, come first."""
    monkeypatch.chdir(tmp_path)
    assert description_paths([]) == [descriptions_dir()]
    assert capsys.readouterr().err == (
        "there is no folder descriptions here: these are the devices that come with fieldscribe\n"
    )
    (tmp_path / "descriptions").mkdir()
    assert description_paths([]) == [Path("descriptions")]
    (tmp_path / "device.yaml").touch()
    assert description_paths([]) == [Path("device.yaml")]
    assert description_paths([Path("descriptions")]) == [Path("descriptions")]
    assert capsys.readouterr().err == ""


def test_json_ends_with_its_line(capsys: pytest.CaptureFixture[str]) -> None:
    print_json({"ü": [1]})
    assert capsys.readouterr().out == '{\n  "\\u00fc": [\n    1\n  ]\n}\n'


def test_of_points_at_one_address_the_chosen_variant_has_one(run: Callable[..., Result], small: Path) -> None:
    (small / "main.yaml").write_text(MAIN.replace("TITLE", "Speed") + CONDITIONS, "utf-8")
    frame = run("encode", "small_drive", "wire:0x19", "10", "--frame", "--variant", "size=small").out.strip()
    heard = run("decode", "small_drive", frame, "--variant", "size=small")
    assert heard.code == 0
    assert "simple = 10" in heard.out
    assert "double" not in heard.out
    assert "double" not in run("explain", "small_drive", "wire:0x19", "--variant", "size=small").out


def test_decode_says_that_limits_could_not_be_checked(run: Callable[..., Result], small: Path) -> None:
    """A write that nobody held against its limits is not told as if it were fine."""
    limited = "- {name: limited, title: {en: Limited}, at: 1Ah, range: 0 .. ratio.raw}\n"
    (small / "main.yaml").write_text(MAIN.replace("TITLE", "Speed") + limited, "utf-8")
    frame = run("encode", "small_drive", "limited", "10", "--with", "P2=20", "--frame").out.strip()
    heard = run("decode", "small_drive", frame)
    assert heard.code == 0
    assert "not held against its limits, which depend on P2 ratio: give --with ratio=VALUE" in " ".join(
        heard.out.split()
    )
    assert "not held" not in run("decode", "small_drive", frame, "--with", "P2=20").out
    assert run("decode", "small_drive", frame, "--with", "P2=5").code == 1
