"""`listen` pairs what belongs together and says what is wrong, whatever else is on the line."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable, Iterator
from io import BytesIO, TextIOWrapper
from pathlib import Path
from random import Random
from unittest.mock import MagicMock, PropertyMock

import can
import pytest
from fieldscribe.cli import main
from fieldscribe.diagnostics import UnclearError
from fieldscribe.families import family
from fieldscribe.families.frame_results import Options
from fieldscribe.families.modbus.frames import crc16
from fieldscribe.families.uss.telegrams import telegram
from fieldscribe.listening.chunks import BYTES, STREAM, Chunk, serial_chunks
from fieldscribe.listening.exchanges import Exchange, Statistics
from fieldscribe.listening.listener import Listener, Station
from fieldscribe.live.lines import read_line
from support.captured import classic, segment
from support.described import shipped

pytestmark = pytest.mark.usefixtures("loads_once")

Listen = Callable[..., tuple[int, list[str], str]]


@pytest.fixture
def listen(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Listen:
    """Runs the command on a capture; returns how it ends, its lines, and its messages."""

    def run(devices: str, capture: str | bytes, *words: str) -> tuple[int, list[str], str]:
        file = tmp_path / "capture"
        file.write_bytes(capture.encode() if isinstance(capture, str) else capture)
        code = main(["listen", *devices.split(), "--capture", str(file), *words])
        out, err = capsys.readouterr()
        return code, out.splitlines(), err

    return run


def rtu(text: str) -> bytes:
    """A frame with its CRC."""
    body = bytes.fromhex(text)
    return body + crc16(body).to_bytes(2, "little")


def tcp(number: int, text: str) -> bytes:
    """A frame with its header."""
    body = bytes.fromhex(text)
    return number.to_bytes(2, "big") + b"\0\0" + len(body).to_bytes(2, "big") + body


ASKED, CAME = rtu("01 03 1001 0002"), rtu("01 03 04 01F4 0064")
WRITTEN = rtu("01 06 1028 01F4")
READ = "unit 1  read  output_frequency = 50 Hz, motor_current = 10 %"
WROTE = "unit 1  write  base_frequency = 50 Hz"
UNANSWERED = "unit 1  read  output_frequency, motor_current"
SILENT = f"{UNANSWERED}  ! no answer"
ALONE = "03h read holding registers: reply with 4 bytes of data: 01 F4 00 64  ! an answer without a request"
NOISE = "! bytes that are no frame"
WRONG = "! the checksum is wrong"

LINES: dict[str, tuple[list[bytes], list[str]]] = {
    "one exchange": ([ASKED, CAME], [f"{READ}  (50.0 ms)"]),
    "in one piece": ([ASKED + CAME + WRITTEN + WRITTEN], [READ, WROTE]),
    "in single bytes": ([bytes((byte,)) for byte in ASKED + CAME], [f"{READ}  (400.0 ms)"]),
    "noise between": ([b"\xff\x00", ASKED, b"\x80\x80\x80", CAME], [NOISE, f"80 80 80  {NOISE}", READ]),
    "cut answer": ([ASKED, CAME[:5], ASKED, CAME], [WRONG, SILENT, f"{READ}  (50.0 ms)"]),
    "no answer": ([ASKED, ASKED, CAME], [SILENT, READ]),
    "doubled answer": ([ASKED, CAME, CAME], [READ, ALONE]),
    "refused": ([ASKED, rtu("01 83 02")], [f"{UNANSWERED}  (50.0 ms)  ! exception 02h address_not_found"]),
    "another unit answers": ([ASKED, rtu("02 03 04 01F4 0064")], ["it comes from another unit", UNANSWERED]),
    "wrong check": ([ASKED, CAME[:-1] + b"\0", ASKED, CAME], [f"{READ}  (50.0 ms)  {WRONG}", READ]),
    "a function of others": ([rtu("01 2B 0E 01 00")], ["function 2Bh is not one of the Modbus functions"]),
    "out of range": ([ASKED, rtu("01 03 04 FE0C 0064")], ["is outside 0..400 Hz, as a signed number it is -50 Hz"]),
    "at the end": ([ASKED], [UNANSWERED]),
    "to all": ([rtu("00 06 1028 01F4"), ASKED, CAME], ["unit 0  write  base_frequency = 50 Hz", READ]),
    "refused by the manual": ([rtu("01 06 1028 FFFF")] * 2, ["base_frequency: 6553.5 Hz is outside"]),
}


def logged(pieces: list[bytes]) -> str:
    """A log with these bytes, one line every 50 ms."""
    return "".join(f"{1700000000 + 0.05 * place:.3f} {data.hex(' ')}\n" for place, data in enumerate(pieces))


@pytest.mark.parametrize("name", LINES)
def test_a_serial_line(name: str, listen: Listen) -> None:
    """There is a line for each exchange, in the order in which they end, and nothing else."""
    pieces, expected = LINES[name]
    code, lines, messages = listen("hitachi_l200", logged(pieces))
    exchanges = lines[: lines.index("")]
    assert len(exchanges) == len(expected)
    for text, line in zip(expected, exchanges, strict=True):
        assert line.startswith("22:13:2")
        assert text in line
    assert (code, messages) == (1 if any("!" in line for line in exchanges) else 0, "")


@pytest.mark.full(seconds=1)
def test_the_same_from_any_capture_and_from_what_was_written(listen: Listen, tmp_path: Path) -> None:
    pieces = [ASKED, CAME, WRITTEN, WRITTEN]
    _, lines, _ = listen("hitachi_l200", logged(pieces), "--write", str(tmp_path / "again.pcapng"))
    others = {
        "written": (tmp_path / "again.pcapng").read_bytes(),
        "pcap": classic(pieces, link=147, step=0.05),
        "times of a day": "".join(
            f"[22:13:20.{50 * place:03}] {way}: {data.hex()}\n"
            for place, (way, data) in enumerate(zip(("TX", "RX") * 2, pieces, strict=True))
        ),
        "dates": "".join(f"2023-11-14T22:13:20,{50 * n:03}Z -> {data.hex(':')}\n" for n, data in enumerate(pieces)),
    }
    for name, capture in others.items():
        assert listen("hitachi_l200", capture)[1] == lines, name


def test_a_network_with_several_requests_at_once(listen: Listen) -> None:
    """Answers belong to the request with their number, on their connection; frames may be split and share packets."""
    asked, other = tcp(1, "01 03 1001 0002"), tcp(2, "01 03 1028 0001")
    came, came_later = tcp(1, "01 03 04 01F4 0064"), tcp(2, "01 03 02 0258")
    packets = [
        segment(1, asked + other[:5]),
        segment(18, other[5:]),
        segment(1, asked, port=4001),
        segment(1, came_later + came, back=True),
        segment(1, tcp(1, "01 83 02"), back=True, port=4001),
    ]
    _, lines, _ = listen("hitachi_l200", classic(packets))
    assert [line.partition("  ")[2].partition("  (")[0] for line in lines[:3]] == [
        "10.0.0.1:4000  unit 1  read  base_frequency = 60 Hz",
        f"10.0.0.1:4000  {READ}",
        f"10.0.0.1:4001  {UNANSWERED}",
    ]
    assert listen("hitachi_l200", classic(packets), "--port", "502", "--port", "5020")[1:] == (lines, "")


def test_devices_by_unit(listen: Listen) -> None:
    pieces = [ASKED, CAME, rtu("02 03 1001 0001"), rtu("02 03 02 0001"), rtu("07 03 0000 0001")]
    _, lines, _ = listen("hitachi_l200=1 nord_sk5xxe=2", logged(pieces), "--format", "jsonl")
    exchanges, summary = [json.loads(line) for line in lines[:-1]], json.loads(lines[-1])["summary"]
    assert [(one["unit"], one["device"]) for one in exchanges] == [(1, "hitachi_l200"), (2, "nord_sk5xxe"), (7, None)]
    assert exchanges[0]["items"][0] == {
        "point": "output_frequency", "code": "d001", "raw": 500, "value": "50", "text": "output_frequency = 50 Hz"
    }  # fmt: skip
    assert summary["errors"] == [{"count": 1, "text": "unit 7: for a unit without a description"}]


def test_who_polls_what(listen: Listen) -> None:
    _, lines, _ = listen("hitachi_l200", logged([ASKED, CAME] * 10 + [WRITTEN] * 4), "--summary")
    assert lines[0] == "12 exchanges"
    assert (
        "10 x  every 100.0 ms  unit 1  read   output_frequency, motor_current  in 50.0 ms, at most 50.0 ms" in lines[3]
    )
    assert " 2 x   every 100.0 ms  unit 1  write  base_frequency" in lines[4]


def test_a_bus_with_messages(listen: Listen) -> None:
    texts = ["(1.0) can0 321#DD00051513880064", "(1.5) can0 321#DD010302000007D0", "(2.0) can0 7FF#00", "nothing"]
    _, lines, messages = listen("woodward_mpu2s", "\n".join(texts))
    assert "unit 1  visualisation  telegram_identification = 1301, generator_frequency = 50 Hz" in lines[0]
    assert "generator_active_power = 100000 W" in lines[1]
    assert "for a unit without" in lines[2]
    assert "1 line without a frame" in messages


@pytest.mark.parametrize(("writer", "file"), [(can.BLFWriter, "bus.blf"), (can.ASCWriter, "bus.asc")])
def test_captures_of_can_tools(writer: Callable[..., can.Listener], file: str, listen: Listen, tmp_path: Path) -> None:
    """The files are written by python-can; what is cut off is an error behind what is whole."""
    written = writer(tmp_path / file)
    for place, text in enumerate(("DD00051513880064", "DD010302000007D0") * 20):
        frame = can.Message(1e9 + place, 0x321, is_extended_id=False, data=bytes.fromhex(text), channel=0)
        written.on_message_received(frame)
    written.stop()
    whole = (tmp_path / file).read_bytes()
    _, lines, messages = listen("woodward_mpu2s", whole)
    assert "  unit 1  visualisation  telegram_identification = 1301, generator_frequency = 50 Hz" in lines[0]
    assert "40 exchanges" in lines
    assert messages == ""
    if file == "bus.blf":
        code, _, messages = listen("woodward_mpu2s", whole[:-50])
        assert (code, "no whole BLF file" in messages) == (2, True)


def test_captures_of_can_tools_need_python_can(listen: Listen, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "can", None)
    code, _, messages = listen("woodward_mpu2s", b"LOGG" + bytes(200))
    assert (code, messages.splitlines()[-1]) == (2, "  hint: pip install 'fieldscribe[live]'")


def test_telegrams(listen: Listen) -> None:
    asked, came = telegram(1, (0x143A, 0, 0, 0, 0x047F, 0x3333)), telegram(1, (0x243A, 0, 0x4248, 0, 0xFA31, 0x3333))
    _, lines, _ = listen("siemens_mm4", logged([asked, b"\x02", came, b"\x02\x0e\x01"]))
    assert "unit 1  read  maximum_frequency = 50 Hz" in "".join(lines)


@pytest.mark.parametrize(
    ("devices", "capture", "words", "expected"),
    [
        ("hitachi_l200", "hello\n" * 5, (), "it has no frame"),
        ("woodward_mpu2s", '{"request": "0000033fff0100c90000ffc8"}\n', (), "traces of `simulate` without CAN"),
        ("hitachi_l200", classic([b"\1"])[:-1], (), "cut off within packet 1"),
        ("hitachi_l200 siemens_mm4", logged([ASKED]), (), "devices of modbus and uss are not on one line"),
        ("hitachi_l200=x", "", (), "a unit is a number"),
        ("hitachi_l200", logged([ASKED]), ("--for", "5"), "--for would have no effect on a capture"),
        ("hitachi_l200", logged([ASKED]), ("--port", "70000"), "`70000` is no TCP port: they are 1 to 65535"),
        ("hitachi_l200", logged([ASKED]), ("--port", "5020"), "no data here goes to or from port 5020"),
        (
            "woodward_mpu2s",
            classic([bytes(16)], link=227),
            ("--port", "5020"),
            "no data here goes to or from port 5020",
        ),
        ("hitachi_l200", classic([bytes(16)], link=227), (), "1 frame of another kind of bus"),
    ],
)
def test_what_cannot_be_read(
    devices: str, capture: str | bytes, words: tuple[str, ...], expected: str, listen: Listen
) -> None:
    code, _, messages = listen(devices, capture, *words)
    assert expected in messages
    assert code == (0 if "another kind" in expected else 2)


@pytest.mark.parametrize("device", ["hitachi_l200", "siemens_mm4", "woodward_mpu2s"])
def test_any_bytes_are_safe(device: str) -> None:
    """Noise, and frames that are cut, doubled and mixed with it, in any pieces; what waits has a limit."""
    random = Random(26)
    good = [ASKED, CAME, WRITTEN, telegram(1, (0x143A, 0, 0, 0, 0x047F, 0x3333)), tcp(1, "01 03 1001 0002")]
    listener = Listener([Station(shipped(device))], Options())
    for number in range(3000):
        data = random.choice(good)
        data = random.choice((data, data[: random.randrange(20)], random.randbytes(random.randrange(300))))
        kind = random.choice(listener.part.KINDS)
        identifier = random.choice((0x321, 0x33F, random.getrandbits(29)))
        chunk = Chunk(number * 0.01, kind, data, str(number % 5), random.choice((None, True)), identifier=identifier)
        for exchange in listener.take(chunk):
            assert exchange.as_data()
    assert sum(len(exchange.cuts[0].data) for exchange in listener.rest()) < 10_000


def test_a_serial_line_that_others_talk_on() -> None:
    """The first chunk says that nothing came, so the line is open then."""
    ours, theirs = os.openpty()
    try:
        chunks = family("modbus").part("lines").receive(read_line(f"rtu://{os.ttyname(theirs)}?baud=19200"))
        assert next(chunks).data == b""
        os.write(ours, ASKED + CAME)
        listener, exchanges = Listener([Station(shipped("hitachi_l200"))], Options()), list[Exchange]()
        while not exchanges:
            exchanges += listener.take(next(chunks))
        assert [item.meaning for item in exchanges[0].content.items] == ["50 Hz", "10 %"]
    finally:
        os.close(ours)
        os.close(theirs)
    with pytest.raises(UnclearError, match="it went away"):
        for _ in chunks:
            pass


def test_a_serial_line_is_read_as_its_bytes_come(monkeypatch: pytest.MonkeyPatch) -> None:
    """One byte is awaited; what came with it is read at once."""
    port = MagicMock()
    type(port).in_waiting = PropertyMock(side_effect=[0, 3])
    port.read.side_effect = bytes
    monkeypatch.setattr("serial.serial_for_url", lambda *_, **__: port)
    chunks = serial_chunks(read_line("rtu:///dev/nowhere"), "8N1")
    assert [len(next(chunks).data), len(next(chunks).data)] == [1, 3]


def test_a_bus_that_others_talk_on() -> None:
    chunks = family("can").part("lines").receive(read_line("can://virtual/heard"))
    assert next(chunks).data == b""
    with can.Bus("heard", interface="virtual") as bus:
        bus.send(can.Message(arbitration_id=0x321, is_extended_id=False, data=bytes.fromhex("DD00051513880064")))
    listener = Listener([Station(shipped("woodward_mpu2s"))], Options())
    [exchange] = listener.take(next(chunks))
    assert exchange.content.items[1].meaning == "50 Hz"
    chunks.close()


@pytest.mark.full(seconds=0.7)
def test_lines_and_stations_of_a_project(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Names stand for lines and devices; what a line cannot do is said, and Ctrl-C ends with the summary."""
    (tmp_path / "fieldscribe.toml").write_text(
        '[lines]\nbench = "rtu:///dev/nowhere"\n[stations.pump]\ndescription = "hitachi_l200"\n'
        'line = "bench"\nunit = 1\n'
    )
    monkeypatch.chdir(tmp_path)
    for words, expected in (
        (["pump"], "it cannot be opened"),
        (["pump", "--line", "tcp://localhost"], "give --capture FILE"),
        (
            ["hitachi_l200", "--line", "rtu:///dev/x", "--capture", "x"],
            "either --capture FILE or --line LINE, not both",
        ),
        (["hitachi_l200=300", "--capture", "x"], "`hitachi_l200=300`: a unit is a number up to 255"),
        (["hitachi_l200=1", "eastron_sdm630=1", "--capture", "x"], "are both given for unit 1\n"),
        (["hitachi_l200", "eastron_sdm630", "--capture", "x"], "are both given for all other units\n"),
        (["hitachi_l200", "--line", "can://virtual/x"], "its lines are tcp://, rtu://, rtu+tcp://"),
    ):
        assert main(["listen", *words]) == 2
        assert expected in capsys.readouterr().err

    def receive(_: object) -> Iterator[Chunk]:
        yield Chunk(0.0, BYTES, ASKED + CAME)
        raise KeyboardInterrupt

    monkeypatch.setattr(family("modbus").part("lines"), "receive", receive)
    assert main(["listen", "pump"]) == 0
    assert f"{READ}\n\n1 exchange\n" in capsys.readouterr().out


@pytest.mark.full(seconds=0.6)
def test_what_never_comes_again_does_not_fill_the_memory() -> None:
    """Each connection, unit, address and finding is new; what no longer fits is counted together."""
    listener, statistics = Listener([Station(shipped("hitachi_l200"))], Options()), Statistics()
    count = 2500
    for number in range(count):
        asked = tcp(1, f"{number % 255 + 1:02X} 06 {number:04X} FFFF")
        place = f"10.0.0.{number}:4000"
        for sent in (True, False):
            for exchange in listener.take(Chunk(number * 0.01, STREAM, asked, place, sent)):
                statistics.add(exchange)
    data = statistics.as_data()
    assert data["exchanges"] == count
    for key in ("polls", "errors", "findings"):
        rows = data[key]
        assert isinstance(rows, list)
        assert len(rows) <= 2001
    assert sum(poll["count"] for poll in data["polls"]) == count  # type: ignore[attr-defined]  # it is a list of rows
    assert listener._requests.cache_info().currsize <= 1024


@pytest.mark.full(seconds=0.7)
def test_standard_input(listen: Listen, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    expected = listen("hitachi_l200", logged([ASKED, CAME]))
    monkeypatch.setattr(sys, "stdin", TextIOWrapper(BytesIO(logged([ASKED, CAME]).encode())))
    code = main(["listen", "hitachi_l200", "--capture", "-"])
    assert (code, capsys.readouterr().out.splitlines(), "") == expected
    monkeypatch.setattr(sys, "stdin", None)
    assert main(["listen", "hitachi_l200", "--capture", "-"]) == 2
    assert "standard input is closed" in capsys.readouterr().err


@pytest.mark.full(seconds=1.2)
@pytest.mark.parametrize("framed", [rtu, lambda text: tcp(7, text)], ids=["rtu", "tcp"])
def test_logs_and_traces_have_frames_of_both_kinds(listen: Listen, framed: Callable[[str], bytes]) -> None:
    asked, came = (framed(text).hex(" ") for text in ("01 03 1001 0002", "01 03 04 01F4 0064"))
    log = f"08:00:01.000 TX {asked}\n08:00:01.031 RX {came}\n"
    trace = json.dumps({"time": 1.5, "request": asked, "answer": came, "delay": 0.25, "refused": None}) + "\n"
    assert listen("hitachi_l200", log, "-v")[1][0].startswith(f"08:00:01.000  {READ}")
    assert listen("hitachi_l200", trace)[1][0] == f"00:00:01.500  {READ}  (250.0 ms)"
    for wrong in ('{"time": 1', "{}", '{"time": "x", "request": "", "answer": "", "delay": 0}', "[" * 9999, "{" * 9999):
        assert listen("hitachi_l200", f"{wrong}\n{trace}")[0] in (0, 2)


@pytest.mark.parametrize(
    ("device", "frames", "ends"),
    [
        (
            "hitachi_l200",
            ("05 06 10 28 01 F4 0C 91", "00 01 00 00 00 06 05 06 10 28 01 F4"),
            ("base_frequency (RTU, unit 5, 06h", "base_frequency (TCP, unit 5, 06h"),
        ),
        (
            "siemens_mm4",
            (
                "02 0E 01 34 3A 00 00 42 48 00 00 00 00 00 00 09",
                "02 0E 01 24 3A 00 00 42 48 00 00 FA 31 30 00 E2",
                "02 0E 01 D4 3A 00 00 42 48 00 00 00 00 00 00 E9",
                "02 0E 01 24 3A 00 00 42 48 00 00 FA 31 30 00 E2",
            ),
            ("task 3 write_double_word, parameter 1082)", "task 13 store_double_word, parameter 1082)"),
        ),
        ("hitachi_l200", ("05 06 10 28 01 F4 0C 91", "05 06 10 28 01 F4 0C 91"), ("write  base_frequency",)),
    ],
)
def test_rows_that_read_alike_name_their_requests(
    device: str, frames: tuple[str, ...], ends: tuple[str, ...], listen: Listen
) -> None:
    rows = [line for line in listen(device, "\n".join(frames), "--summary")[1] if " x  " in line and "write" in line]
    assert len(rows) == len(ends)
    assert all(end in row for end, row in zip(ends, rows, strict=True)), rows
    assert ends[1:] or rows[0].endswith(ends[0])
