"""The page on C: its first program runs as firmware on an emulated Cortex-M0, every other block against a script."""

from __future__ import annotations

import os
import re
import select
import shlex
import shutil
import subprocess
import time
from pathlib import Path
from typing import NamedTuple

import pytest
from fieldscribe.cli import main
from support.c_device import SANITIZERS, WARNINGS
from support.places import ROOT
from support.toolchains import succeed, tool

PAGES = ("c", "c-points", "c-uss", "c-can")
BOARD = ROOT / "tests/firmware"
MANUAL = ROOT / "descriptions/hitachi_l200/bus.yaml"
LINES = 35
"""What the first program may have at most, with its head and its remarks."""
FLASH = 2670
"""Bytes of the whole firmware, with the board's start-up and UART (2,660 with gcc 12)."""
BETWEEN = 0.004
"""Seconds of silence between frames that a drive wants: 3.5 characters of 11 bits at 9600 baud."""
BUS = """
#include "woodward_mpu2s_can.h"
void can_send(const fieldscribe_can_frame *frame);
bool can_receive(fieldscribe_can_frame *frame);
uint32_t milliseconds(void);
"""


class Page(NamedTuple):
    """The programs of the page, and the folder with the drivers that its commands left."""

    folder: Path
    firmware: str
    modbus: str
    uss: str
    can: str


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Page:
    folder = tmp_path_factory.mktemp("page")
    texts = [(ROOT / f"descriptions/using/{name}.md").read_text("utf-8") for name in PAGES]
    text = "\n".join(texts)
    before = os.getcwd()
    os.chdir(folder)
    try:
        for of_page in texts:
            for command in re.findall(r"^\$ fieldscribe (vendor .*)$", of_page, re.MULTILINE):
                assert main(shlex.split(command)) == 0
            if not Path("first").exists():
                shutil.copytree("drivers", "first")  # with nothing but what the first program needs
    finally:
        os.chdir(before)
    board, sending, firmware, *fragments, uss, can = re.findall(r"^```c\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
    assert sending in (BOARD / "board.c").read_text("utf-8")
    (folder / "page").mkdir()
    (folder / "page/board.h").write_text(board, "utf-8")
    (folder / "bus.h").write_text(BUS, "utf-8")
    modbus = firmware.replace("int main(void)", "void firmware(void);\nvoid firmware(void)") + "".join(fragments)
    return Page(folder, firmware, modbus, uss, can)


def crc(text: str) -> str:
    """A frame with its checksum, as a manual prints it."""
    register = 0xFFFF
    for byte in bytes.fromhex(text):
        register ^= byte
        for _ in range(8):
            register = register >> 1 ^ (0xA001 if register & 1 else 0)
    return (bytes.fromhex(text) + register.to_bytes(2, "little")).hex(" ").upper()


def bcc(text: str) -> str:
    """A telegram of USS with its check."""
    check = 0
    for byte in bytes.fromhex(text):
        check ^= byte
    return f"{text} {check:02X}"


def printed_write() -> str:
    """The manual's frame that writes 50 Hz, with the checksum that the erratum took for the misprinted one."""
    text = MANUAL.read_text("utf-8")
    frame = re.search(r"name: write_base_frequency,.*?bytes: ([0-9A-F ]+),", text)
    taken = re.search(r"id: write_base_frequency_crc\n.*?taken: \{crc: \"([0-9A-F ]+)\"\}", text, re.DOTALL)
    assert frame is not None
    assert taken is not None
    return f"{frame[1][:-5]}{taken[1]}"


READ = crc("05 03 10 01 00 01")
WRITE = "05 06 10 28 01 F4 0C 91"


def test_frames_here_are_those_of_the_manual() -> None:
    assert printed_write() == WRITE == crc(WRITE[:-6])
    assert crc("05 03 00 11 00 03") in MANUAL.read_text("utf-8")  # the other example, likewise


@pytest.mark.full(seconds=1)
def test_the_first_program_is_short(page: Page) -> None:
    assert sum(1 for line in page.firmware.splitlines() if line.strip()) <= LINES


class Machine:
    """An emulated board, its serial line in our hands: a drive that takes no notice of what comes too early."""

    def __init__(self, firmware: Path) -> None:
        options = ("-M", "microbit", "-display", "none", "-monitor", "none", "-serial", "stdio")
        words = [tool("qemu-system-arm"), *options, "-kernel", str(firmware)]
        pipe = subprocess.PIPE
        self._process = subprocess.Popen(words, bufsize=0, stdin=pipe, stdout=pipe, stderr=subprocess.DEVNULL)
        self._spoke = 0.0

    def asks(self, seconds: float = 20.0) -> str:
        """The next eight bytes of the firmware."""
        out = self._process.stdout
        assert out is not None
        got, end = b"", time.monotonic() + seconds
        while len(got) < 8 and time.monotonic() < end:
            if select.select([out], [], [], 0.2)[0]:
                early = not got and time.monotonic() - self._spoke < BETWEEN
                got += os.read(out.fileno(), 8 - len(got))
                got = b"" if early else got
        return got.hex(" ").upper()

    def answer(self, text: str) -> None:
        """Bytes to the firmware."""
        assert self._process.stdin is not None
        self._spoke = time.monotonic()
        self._process.stdin.write(bytes.fromhex(text))

    def stop(self) -> None:
        self._process.kill()
        self._process.wait()


@pytest.fixture(scope="module")
def firmware(page: Page) -> Path:
    """The first program, as the page has it, for the board."""
    (page.folder / "main.c").write_text(page.firmware, "utf-8")
    flags = ("-std=c99", "-mcpu=cortex-m0", "-mthumb", "-Os", "-ffunction-sections", "-fdata-sections", *WARNINGS)
    link = ("-DFIELDSCRIBE_NO_FLOAT", "-nostartfiles", "-Wl,--gc-sections", "-T", BOARD / "microbit.ld")
    sources = (f"-I{page.folder / 'first'}", f"-I{BOARD}", page.folder / "main.c", BOARD / "board.c")
    succeed([tool("arm-none-eabi-gcc"), *flags, *link, *sources, "-o", page.folder / "main.elf"])
    return page.folder / "main.elf"


@pytest.mark.full(seconds=2)
def test_the_firmware_is_small(firmware: Path) -> None:
    [_, sizes] = succeed([tool("arm-none-eabi-size"), firmware]).splitlines()
    text, data = map(int, sizes.split()[:2])
    assert text + data <= FLASH


@pytest.mark.full(seconds=4)
def test_the_firmware_speaks_as_the_manual_says(firmware: Path) -> None:
    """Against a drive that is noisy, silent, refuses, and answers in pieces."""
    machine = Machine(firmware)
    try:
        assert machine.asks() == READ
        machine.answer("00 05 FF 05 03")  # noise, some of it like an answer
        machine.answer(crc("05 03 02 01 2C"))
        assert machine.asks() == WRITE
        machine.answer(WRITE)
        assert machine.asks() == READ
        assert machine.asks() == READ  # again, after it got no answer
        machine.answer(crc("05 83 03"))
        assert machine.asks() == READ  # again, after it was refused
        answer = crc("05 03 02 00 00")
        machine.answer(answer[:11])
        time.sleep(0.05)
        machine.answer(answer[11:])
        assert machine.asks() == WRITE
        machine.answer(crc("05 86 22"))
        assert machine.asks() == READ
        machine.answer(crc("05 03 02 01 F4"))
        assert machine.asks() == READ  # it runs as fast as it shall: nothing is written
    finally:
        machine.stop()


def script_of(steps: list[tuple[str, str]]) -> str:
    """The same as an array in C."""

    def bytes_of(text: str) -> str:
        return "{" + ", ".join(f"0x{byte}" for byte in text.split() or ["0"]) + "}"

    rows = ",\n".join(
        f"{{{len(requested.split())}, {bytes_of(requested)}, {len(output.split())}, {bytes_of(output)}}}"
        for requested, output in steps
    )
    return f"static const step steps[] = {{{rows}}};\n"


def run_here(page: Page, program: str, *, board: bool) -> str:
    """Compiles a program, runs it with all sanitizers, and returns what it printed."""
    source = page.folder / "program.c"
    source.write_text(program, "utf-8")
    flags = ("-std=c99", "-O1", *WARNINGS, "-Wno-unused-function", "-Wno-float-equal", *SANITIZERS["gcc"])
    folders = (
        f"-I{page.folder / 'drivers'}",
        f"-I{page.folder}",
        f"-I{BOARD}" if board else f"-I{page.folder / 'page'}",
    )
    assert not succeed([tool("gcc"), *flags, *folders, "-o", page.folder / "program", source])
    return succeed([page.folder / "program"])


BLOCK = crc("05 03 10 01 00 03")
CURRENT = crc("05 03 10 02 00 01")
BASE = crc("05 03 10 28 00 01")
LIMIT = crc("05 06 10 59 01 F4")
NO_LIMIT = crc("05 06 10 59 00 00")
ENTER = crc("05 06 09 00 00 01")
MODBUS = """
int main(void)
{
    static const uint8_t noise[] = {0x05U, 0x03U, 0x05U};
    static const uint8_t longer[] = {0x05U, 0x03U, 0xC8U}; /* as of an answer with 200 bytes */
    hitachi_l200_monitor_d_group group = {0};
    uint16_t frequency;
    script = steps;
    CHECK(is_not_available_now()); /* at the third time */
    CHECK(!is_not_available_now());
    CHECK(monitor(&group) && group.output_frequency_count == 300 && group.motor_current_count == 512);
    CHECK(group.rotation_direction_raw == 1U && !monitor(&group));
    poll();
    CHECK(!set(0U, 1) && !set(2U, 4001) && set(2U, 500));
    CHECK(!limit(4001, 0U, 400U) && !limit(600, 0U, 50U) && !limit(20, 30U, 50U));
    CHECK(limit(500, 0U, 50U) && limit(0, 0U, 50U));
    CHECK(store());
    begin();
    CHECK(!came(noise, sizeof noise, &frequency));
    CHECK(!came(script[-1].answer, 3U, &frequency));
    CHECK(came(script[-1].answer + 3, 4U, &frequency) && frequency == 257U && receiver.dropped == 3U);
    begin();
    CHECK(!came(longer, sizeof longer, &frequency) && !came(script[-1].answer, 7U, &frequency));
    CHECK(came(NULL, 0U, &frequency) && frequency == 257U && receiver.dropped == 3U);
    CHECK(script == steps + FIELDSCRIBE_COUNT(steps));
    return 0;
}
"""


@pytest.mark.full(seconds=3)
def test_blocks_on_modbus(page: Page) -> None:
    steps = [
        *((WRITE, ""), (WRITE, "FF"), (WRITE, crc("05 86 22"))),
        (WRITE, crc("05 86 21")),
        *((BLOCK, crc("05 03 06 01 2C 02 00 00 01")), (BLOCK, crc("05 83 21"))),
        *((READ, crc("05 03 02 01 2C")), (CURRENT, ""), (BASE, crc("05 03 02 01 F4")), (WRITE, WRITE)),
        *((LIMIT, LIMIT), (NO_LIMIT, NO_LIMIT), (ENTER, ENTER)),
        *[(READ, crc("05 03 02 01 01"))] * 2,
    ]
    names = '#define FIELDSCRIBE_NAMES\n#include "host.h"\n'
    printed = run_here(page, f"{names}{page.modbus}{script_of(steps)}{MODBUS}", board=True)
    assert printed == "output_frequency: 30.0 Hz\nbase_frequency: 50.0 Hz\n"


USS = """
int main(void)
{
    bool fault = true;
    int64_t actual = 0;
    script = steps;
    CHECK(limit(5000) == FIELDSCRIBE_USS_OK && heard[0] == 0xFA31U && heard[1] == 0x1234U);
    CHECK(command(false, 4000000) && sent[0] == 0x047EU && sent[1] == 0x3333U);
    CHECK(command(true, 4000000) && !command(true, 400000000));
    CHECK(limit(4000) == FIELDSCRIBE_USS_REFUSED && drive.unit.error == 17U);
    CHECK(strcmp(siemens_mm4_error_name(drive.unit.error), "not_in_this_operating_state") == 0);
    CHECK(limit(4000) == FIELDSCRIBE_USS_NOISE && drive.unit.error == 0U);
    CHECK(exchange(&fault, &actual) && !fault && actual == 3999939);
    CHECK(!exchange(&fault, &actual));
    return 0;
}
"""


@pytest.mark.full(seconds=2)
def test_blocks_on_uss(page: Page) -> None:
    """The parameter parts are those of the manual."""
    text = (ROOT / "descriptions/siemens_mm4/frames.yaml").read_text("utf-8")
    assert "143A 0000 0000 0000" in text
    assert "243A 0000 4248 0000" in text
    assert "047E 3333" in text
    request, answer = "02 0E 03 14 3A 00 00 00 00 00 00", "02 0E 03 24 3A 00 00 42 48 00 00 FA 31 12 34"
    still, running = bcc(f"{request} 00 00 00 00"), bcc(f"{request} 04 7F 33 33")
    stored = bcc("02 0E 03 D4 3A 00 00 42 20 00 00 04 7F 33 33")
    refusal = bcc("02 0E 03 74 3A 00 00 00 11 00 00 FA 31 12 34")
    run = bcc("02 0E 03 00 00 00 00 00 00 00 00 04 7F 33 33")
    runs = bcc("02 0E 03 00 00 00 00 00 00 00 00 FB 34 33 33")
    steps = [
        (still, f"02 {bcc(answer)}"),
        *((running, bcc(answer)), (stored, refusal), (running, bcc(answer)[:-2] + "00")),
        *((run, runs), (run, "")),
    ]
    includes = '#include "host.h"\n#include <string.h>\n'
    run_here(page, f"{includes}{page.uss}{script_of(steps)}{USS}", board=True)


CAN = """
#include <stdio.h>
#include <stdlib.h>
#define CHECK(that) if (!(that)) { fprintf(stderr, "line %d: %s\\n", __LINE__, #that); exit(4); }
/* A unit that holds words, by bytes as the manual lays them out; what it says comes behind another unit's words. */
static uint16_t words[0x200];
static fieldscribe_can_frame answer;
static size_t left;
static bool babbles; /* another's telegrams, without an end */
static uint32_t clock_now;
uint32_t milliseconds(void)
{
    return clock_now;
}
void can_send(const fieldscribe_can_frame *asked)
{
    const size_t address = ((size_t)asked->data[2] << 8) | asked->data[3];
    const uint8_t *const data = asked->data;
    CHECK(asked->id == 0x33FU && asked->length == 8U && data[1] == 7U && address < 0x200U);
    CHECK(data[6] == (data[0] ^ data[2] ^ data[4]) && data[7] == (data[1] ^ data[3] ^ data[5]));
    CHECK(data[0] == 0xFFU || data[0] == 0xEEU);
    if (data[0] == 0xEEU) {
        words[address] = (uint16_t)(((uint32_t)data[4] << 8) | data[5]);
    }
    answer = *asked;
    answer.id = 0x327U;
    answer.data[4] = (uint8_t)(words[address] >> 8);
    answer.data[5] = (uint8_t)(words[address] & 0xFFU);
    answer.data[6] = data[0] ^ data[2] ^ answer.data[4];
    answer.data[7] = data[1] ^ data[3] ^ answer.data[5];
    left = 2U;
}
bool can_receive(fieldscribe_can_frame *frame)
{
    if (left == 0U) {
        return false;
    }
    *frame = answer;
    frame->id += (left == 2U) || babbles ? 1U : 0U;
    left -= babbles ? 0U : 1U;
    return true;
}
int main(void)
{
    const fieldscribe_can_frame first = {0x327U, 8U, {0xDDU, 0U, 0U, 1U, 0x13U, 0x88U, 0U, 0U}};
    const fieldscribe_can_frame second = {0x327U, 8U, {0xDDU, 1U, 0U, 0xFFU, 0U, 0U, 0U, 0U}};
    const fieldscribe_can_frame seventh = {0x327U, 8U, {0xDDU, 6U, 0U, 0U, 0x0FU, 0xA0U, 0U, 0U}};
    int64_t count = 1;
    int64_t millivolts;
    int32_t hundredths = 0;
    words[507] = 20000U;
    words[0x128] = 2000U;
    words[0x13] = 0x3FFFU;
    CHECK(rated_voltage(7U, &millivolts) && millivolts == 40000); /* 2000 * 400 / 20000 V */
    CHECK(switch_frequency_controller(7U, true) && words[0x13] == 0xFFFFU);
    CHECK(switch_frequency_controller(7U, false) && words[0x13] == 0x3FFFU);
    CHECK(!rated_voltage(31U, &millivolts));
    babbles = true;
    CHECK(!rated_voltage(7U, &millivolts) && !switch_frequency_controller(7U, true));
    listen(7U);
    CHECK(!frequency(&hundredths));
    can_interrupt(&first);
    clock_now += 1000U;
    CHECK(frequency(&hundredths) && hundredths == 5000);
    ++clock_now;
    CHECK(!frequency(&hundredths));
    CHECK(!voltage(&count) && latest_frequency() == 5000);
    can_interrupt(&seventh);
    CHECK(!voltage(&count)); /* without the exponent */
    can_interrupt(&second);
    CHECK(voltage(&count) && count == 4000000); /* 4000 * 10 ** -1 V */
    return 0;
}
"""


@pytest.mark.full(seconds=2)
def test_blocks_on_can(page: Page) -> None:
    run_here(page, f"{page.can}{CAN}", board=False)
