"""Measures `decode` on streams of all families beside `cantools decode` on the same bus: processor time and memory.

.venv/bin/python tests/bench/stream_bench.py [--lines 200000]
"""

from __future__ import annotations

import argparse
import importlib
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from itertools import islice
from pathlib import Path
from random import Random

from fieldscribe.families.modbus.frames import crc16
from fieldscribe.families.uss.telegrams import telegram

sys.path.append(str(Path(__file__).resolve().parents[1]))
captured = importlib.import_module("support.captured")
FIELDSCRIBE = str(Path(sys.executable).with_name("fieldscribe"))
CANTOOLS = str(Path(sys.executable).with_name("cantools"))
KEEPS_BYTECODE = {
    "PYTHONDONTWRITEBYTECODE": "",
    "PYTHONPYCACHEPREFIX": str(Path(__file__).resolve().parents[2] / ".cache/python"),
}
"""Lets a measured command find its bytecode, also where the environment turns that off, as it is for users."""
SLOTS = 23
EXPONENTS = {1: 0x0100, 10: 0, 14: 0}
"""Words that scale others, by the multiplexer whose first word they are."""
REGISTERS = (0x1001, 0x1002, 0x1013, 0x1015, 0x1028, 0x1070, 0x1080)
PARAMETERS = (2, 5, 10, 11, 700, 1080, 1082, 1120)


def slowly(random: Random) -> Callable[[object], int]:
    """Numbers of which one in ten moves a little."""
    held: dict[object, int] = {}

    def word(place: object) -> int:
        held.setdefault(place, random.getrandbits(12))
        if random.random() < 0.1:
            held[place] = (held[place] + random.randint(-3, 3)) & 0xFFFF
        return held[place]

    return word


def at_random(random: Random) -> Callable[[object], int]:
    """Any numbers."""
    return lambda _place: random.getrandbits(16)


def telegrams(random: Random, word: Callable[[object], int], *, all_random: bool = False) -> Iterator[str]:
    """A multiplexed telegram on CAN as candump logs it; with `all_random` also its exponents and multiplexers."""
    number = 0
    while True:
        slot = random.randrange(SLOTS) if all_random else number % SLOTS
        words = [word((slot, place)) for place in range(3)]
        words[0] = words[0] if all_random else EXPONENTS.get(slot, words[0])
        data = "".join(f"{value:04X}" for value in words)
        yield f"({1700000000 + number / 500:.6f}) can0 321#DD{slot:02X}{data}"
        number += 1


def reads(random: Random, word: Callable[[object], int]) -> Iterator[str]:
    """Requests and replies of Modbus RTU."""
    while True:
        address, count = random.choice(REGISTERS), random.randint(1, 4)
        values = b"".join(word((address, at)).to_bytes(2, "big") for at in range(count))
        for pdu in (bytes((3, *divmod(address, 256), 0, count)), bytes((3, 2 * count)) + values):
            yield (b"\1" + pdu + crc16(b"\1" + pdu).to_bytes(2, "little")).hex(" ").upper()


def exchanges(random: Random, word: Callable[[object], int]) -> Iterator[str]:
    """Requests and answers of USS: a parameter, and process data."""
    while True:
        parameter = random.choice(PARAMETERS)
        yield telegram(1, (0x1000 | parameter, 0, 0, 0, word("control"), word("setpoint"))).hex().upper()
        values = word(parameter), word((parameter, "low"))
        yield telegram(1, (0x2000 | parameter, 0, *values, word("status"), word("actual"))).hex().upper()


def streams() -> Iterator[tuple[str, str, Iterator[str]]]:
    """What is sent, the device, and the lines."""
    random = Random(1)
    yield "CAN, slowly changing", "woodward_mpu2s", telegrams(random, slowly(random))
    yield "CAN, random words", "woodward_mpu2s", telegrams(random, at_random(random))
    yield "CAN, all random", "woodward_mpu2s", telegrams(random, at_random(random), all_random=True)
    for kind, words in (("slowly changing", slowly), ("random words", at_random)):
        yield f"Modbus, {kind}", "hitachi_l200", reads(random, words(random))
        yield f"USS, {kind}", "siemens_mm4", exchanges(random, words(random))


def measured(words: list[str], file: Path) -> tuple[float, float]:
    """Seconds of a processor and MiB that a command takes for a file as its standard input."""
    actions = [
        (os.POSIX_SPAWN_OPEN, 0, str(file), os.O_RDONLY, 0),
        *((os.POSIX_SPAWN_OPEN, stream, os.devnull, os.O_WRONLY, 0) for stream in (1, 2)),
    ]
    environment = {**os.environ, **KEEPS_BYTECODE}
    _, _, usage = os.wait4(os.posix_spawn(words[0], words, environment, file_actions=actions), 0)
    return usage.ru_utime, usage.ru_maxrss / 1024


def polls(random: Random, count: int) -> Iterator[bytes]:
    """A poll of Modbus in a network, of which one word in ten moves a little: Ethernet frames."""
    word, sent, came = slowly(random), 1, 1
    for number in range(count // 2):
        address, items = random.choice(REGISTERS), random.randint(1, 4)
        head = (number & 0xFFFF).to_bytes(2, "big") + b"\0\0"
        asked = head + bytes((0, 6, 1, 3, *divmod(address, 256), 0, items))
        values = b"".join(word((address, at)).to_bytes(2, "big") for at in range(items))
        answer = head + bytes((0, 3 + 2 * items, 1, 3, 2 * items)) + values
        yield captured.segment(sent, asked, seen=came)
        sent += len(asked)
        yield captured.segment(came, answer, back=True, seen=sent)
        came += len(answer)


def messages(lines: Iterator[str], count: int) -> Iterator[bytes]:
    """The messages of lines of candump, as packets of SocketCAN."""
    for line in islice(lines, count):
        identifier, data = line.rpartition(" ")[2].split("#")
        yield bytes.fromhex(identifier.zfill(8)) + bytes((len(data) // 2, 0, 0, 0)) + bytes.fromhex(data)


def captures(packets: int) -> Iterator[tuple[str, str, Iterator[bytes]]]:
    """What is in a capture, the device, and the bytes of the file."""
    yield "Modbus, slowly changing", "hitachi_l200", captured.classic_pieces(polls(Random(1), packets))
    for kind, words in (("slowly changing", slowly), ("random words", at_random)):
        random = Random(1)
        sent = messages(telegrams(random, words(random)), packets)
        yield f"CAN, {kind}", "woodward_mpu2s", captured.classic_pieces(sent, link=227)


def print_listening(packets: int) -> None:
    """Print what `listen` takes for captures, and `tshark -V` where it is installed: the mark is twice as long."""
    print(f"\n{f'listen, captures with {packets:,} packets':<48} {'seconds':>8} {'MiB':>5} {'ratio':>7}")
    tshark = shutil.which("tshark")
    if tshark is None:
        print("tshark is not installed")
    for what, device, pieces in captures(packets):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "capture.pcap"
            with file.open("wb") as stream:
                stream.writelines(pieces)
            peer, memory = measured([tshark, "-V", "-r", str(file)], file) if tshark else (0.0, 0.0)
            if tshark:
                print(f"{f'tshark -V: {what}':<48} {peer:8.2f} {memory:5.0f}")
            seconds, memory = measured([FIELDSCRIBE, "listen", device, "--capture", str(file)], file)
            print(f"{f'listen: {what}':<48} {seconds:8.2f} {memory:5.0f} {seconds / (peer or 1):7.2f}", flush=True)


def print_streams(lines: int) -> None:
    """Print a line a stream; the ratio is to cantools for the first one, with as many lines."""
    print(f"\n{f'decode, {lines:,} lines':<48} {'seconds':>8} {'MiB':>5} {'ratio':>7}")
    with tempfile.TemporaryDirectory() as folder:
        peer = None
        for what, device, stream in streams():
            file = Path(folder) / "stream.log"
            file.write_text("".join(f"{next(stream)}\n" for _ in range(lines)), "utf-8")
            if peer is None:
                database = Path(folder) / "device.dbc"
                database.write_bytes(subprocess.check_output([FIELDSCRIBE, "export", "dbc", device]))
                peer, memory = measured([CANTOOLS, "decode", str(database)], file)
                print(f"{'cantools decode, the first of these':<48} {peer:8.2f} {memory:5.0f}")
            seconds, memory = measured([FIELDSCRIBE, "decode", device, "-"], file)
            print(f"{what:<48} {seconds:8.2f} {memory:5.0f} {seconds / peer:7.2f}", flush=True)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lines", type=int, default=200_000)
    arguments = parser.parse_args()
    print_streams(arguments.lines)
    print_listening(arguments.lines)
