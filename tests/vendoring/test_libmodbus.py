"""Other people's Modbus: the page for libmodbus, and our client against a server of libmodbus."""

from __future__ import annotations

import re
import shlex
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest
from fieldscribe.cli import main
from fieldscribe.diagnostics import Report
from fieldscribe.model import Device, Point
from fieldscribe.simulation import simulated
from support.c_device import PROGRAMS, WARNINGS
from support.loaded_once import load_device
from support.places import ROOT
from support.toolchains import libmodbus, succeed, tool

DEVICES = ("eastron_sdm630", "hitachi_l200", "jumo_controller", "nord_sk5xxe")
PAGE = ROOT / "descriptions/using/c-libmodbus.md"
CALLS = """
#include <stdio.h>
#include <stdlib.h>
#define CHECK(that) if (!(that)) { fprintf(stderr, "line %d: %s\\n", __LINE__, #that); exit(1); }
int main(int argc, char **argv)
{
    modbus_t *const bus = modbus_new_tcp("127.0.0.1", atoi(argv[argc - 1]));
    static const fieldscribe_modbus_writing several = {15U, 0U, 1U};
    hitachi_l200_monitor_d_group group;
    int32_t tenths;
    uint16_t words[2];
    CHECK(modbus_connect(bus) == 0 && modbus_set_slave(bus, 1) == 0)
    CHECK(!set_base_frequency(bus, 4010) && set_base_frequency(bus, 600))
    CHECK(base_frequency(bus, &tenths) && tenths == 600)
    CHECK(acceleration_time(bus, 123456) && read_words(bus, &hitachi_l200_acceleration_time_frame.read, words))
    CHECK(words[0] == 1U && words[1] == 0xE240U)
    CHECK(run(bus, true) && read_words(bus, &hitachi_l200_run_command_frame.read, words) && words[0] == 1U)
    CHECK(!write_words(bus, &several, words) && errno == EMBXILFUN)
    CHECK(monitor(bus, &group) && group.output_frequency_count == (uint16_t)(0x1001 * 40503L + 12345L))
    modbus_close(bus);
    modbus_free(bus);
    return 0;
}
"""


@pytest.fixture(scope="module")
def port(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """The port of a server of libmodbus."""
    headers, library = libmodbus()
    server = tmp_path_factory.mktemp("server") / "server"
    words = "-std=gnu99", headers, str(PROGRAMS / "libmodbus_server.c"), library
    succeed([tool("gcc"), *words, "-o", server])
    with subprocess.Popen([server], stdout=subprocess.PIPE, text=True) as running:
        assert running.stdout is not None
        try:
            yield running.stdout.readline().strip()
        finally:
            running.kill()


def build(text: str, folder: Path, *flags: str) -> Path:
    """Compile a program without a warning; `flags` come last."""
    source = folder / "program.c"
    source.write_text(text, "utf-8")
    warnings = (*WARNINGS, "-Wno-unused-function", "-O1", "-fsanitize=address,undefined")
    succeed([tool("gcc"), "-std=c99", *warnings, source, "-o", folder / "program", *flags])
    return folder / "program"


@pytest.mark.full(seconds=3)
def test_the_page_on_libmodbus(port: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    text = PAGE.read_text("utf-8")
    monkeypatch.chdir(tmp_path)
    [command] = re.findall(r"^\$ fieldscribe (vendor .*)$", text, re.MULTILINE)
    assert main(shlex.split(command)) == 0
    *blocks, _ = re.findall(r"^```c\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
    succeed([build("".join(blocks) + CALLS, tmp_path, "-Idrivers", *libmodbus()), port])


CONNECTED = """
#include <arpa/inet.h>
#include <stdio.h>
#include <stdlib.h>
int main(int argc, char **argv)
{
    struct sockaddr_in place = {.sin_family = AF_INET, .sin_port = htons((uint16_t)atoi(argv[argc - 1]))};
    const int connected = socket(AF_INET, SOCK_STREAM, 0);
    int32_t tenths = 0;
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (connect(connected, (const struct sockaddr *)&place, sizeof place) != 0) {
        return 2;
    }
    const fieldscribe_modbus_status status = first(connected, &tenths);
    (void)printf("%d %ld\\n", (int)status, (long)tenths);
    return 0;
}
"""


@pytest.mark.full(seconds=3)
@pytest.mark.parametrize(("faults", "said"), [([], "0 312\n"), (["silent"], None), (["drop"], None)])
def test_a_socket_without_libmodbus(faults: list[str], said: str | None, tmp_path: Path) -> None:
    *_, block = re.findall(r"^```c\n(.*?)^```$", PAGE.read_text("utf-8"), re.MULTILINE | re.DOTALL)
    program = build(block + CONNECTED, tmp_path, f"-I{ROOT / 'generated/c'}", "-D_POSIX_C_SOURCE=200809L")
    with simulated("hitachi_l200", values={"output_frequency": 31.2}, behaviour=False, faults=faults) as drive:
        done = subprocess.run([program, str(drive.port)], capture_output=True, text=True, check=True)
    assert done.stdout == said if said else done.stdout[:2] != "0 "


@pytest.mark.full(seconds=5)
def test_our_client_reads_and_writes_every_point_of_a_server_of_libmodbus(port: str, tmp_path: Path) -> None:
    tables = [table for name in DEVICES for table in tables_of(device_of(name))]
    runs = "".join(f"    run_{name}();\n" for name in DEVICES)
    (tmp_path / "points.inc").write_text("\n".join([*tables, f"static void run_all(void)\n{{\n{runs}}}\n"]), "utf-8")
    program = (PROGRAMS / "libmodbus_points.c").read_text("utf-8")
    succeed([build(program, tmp_path, f"-I{ROOT / 'generated/c'}", f"-I{tmp_path}"), port])


def device_of(name: str) -> Device:
    """The device of that name in this repository."""
    device = load_device(ROOT / "descriptions" / name / "device.yaml", Report())
    assert device is not None
    return device


def tables_of(device: Device) -> Iterator[str]:
    """The rows of a device's points, and the function that tries them, then the struct of each group."""
    header = (ROOT / f"generated/c/{device.id}_modbus.h").read_text("utf-8")
    frames = re.findall(rf"^static const fieldscribe_modbus_(r|w|rw|ru) {device.id}_(\w+)_frame", header, re.MULTILINE)
    points = {point.item: point for point in device.points}
    reachable = [point.item for point in device.points if point.generated and point.addresses]
    assert [item for _, item in frames] == reachable
    yield f"static const row {device.id}_rows[] = {{"
    for ways, item in frames:
        frame = f"{device.id}_{item}_frame"
        read = f"&{frame}.read" if "r" in ways else "NULL"
        write = f"&{frame}.write" if "w" in ways else f"&{frame}.update" if "u" in ways else "NULL"
        yield f'    {{"{item}", &{frame}.layout, {read}, {write}, INT64_C({raw_of(points[item])})}},'
    yield f"}};\nstatic void run_{device.id}(void)\n{{"
    yield f"    run({device.id}_rows, FIELDSCRIBE_COUNT({device.id}_rows), &{device.id}_modbus_profile);"
    for group in filter(device.blocks.get, device.blocks):
        yield from checks_of_group(device, group, header)
    yield "}\n"


def checks_of_group(device: Device, group: str, header: str) -> Iterator[str]:
    """The statements that fill the struct of a group and compare its members with the points read one by one."""
    struct, blocks = f"{device.id}_{group}_group", f"{device.id}_{group}_blocks"
    body = header.partition(f"typedef struct {struct} {{")[2].partition("}")[0]
    members = re.findall(r"(\w+)_(raw|count);", body)
    readable = {point.item for point in device.points if point.group == group and point.generated and point.readable}
    assert {item for item, _ in members} == readable
    yield f"    {{\n        {struct} group;\n        uint16_t words[64];\n        size_t at;"
    yield f"        for (at = 0U; at < FIELDSCRIBE_COUNT({blocks}); ++at) {{"
    yield f'            CHECK(ask(fieldscribe_modbus_read(1U, &{blocks}[at]), words, 64U) == 0, "{group}")'
    yield f"            {struct}_decode(at, words, &group);\n        }}"
    for item, kind in members:
        frame = f"{device.id}_{item}_frame"
        number = f'read_number({frame}.layout, &{frame}.read, "{item}")'
        if kind == "count":
            point = next(point for point in device.points if point.item == item)
            raw_type = f"{'int' if point.info.signed else 'uint'}{point.info.bits}_t"
            number = f"{device.id}_{item}_decode_count(({raw_type}){number})"
        yield f'        CHECK((int64_t)group.{item}_{kind} == {number}, "{item}")'
    yield "    }"


def raw_of(point: Point) -> int:
    """The raw number of a point in the pattern of the server."""
    if not point.readable:
        return 0
    if point.space in ("coil", "discrete"):
        return int(point.addresses[0] % 3 == 0)
    raw = 0
    for address in point.addresses:  # the high word first
        raw = raw << 16 | (address * 40503 + 12345) & 0xFFFF
    bits = point.info.bits
    if point.bits is not None:
        high, low = point.bits
        bits = high - low + 1
        raw >>= low
    raw &= (1 << bits) - 1
    return raw - (1 << bits) if point.info.signed and raw >> (bits - 1) else raw
