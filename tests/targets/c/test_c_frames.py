"""Generated C of frames as firmware uses it: requests, answers, telegrams, and any bytes at all."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import pytest
from fieldscribe.model import Point
from fieldscribe.resources import templates_dir
from fieldscribe.targets import c
from support import wrong_bytes
from support.c_device import SANITIZING, STANDARDS, WARNINGS, driver, program, run_program, write_headers
from support.described import made, shipped
from support.places import ROOT
from support.toolchains import compiled, run, succeed, tool

FAMILIES = ("can", "uss")
COMPILERS = ("gcc", "clang")


CAN_DIALOGUE = program("can_dialogue")

CAN_WRONG_BYTES = program("can_wrong_bytes")


def can_wrong_bytes() -> str:
    """The program with the frames that all languages refuse alike."""
    right = ", ".join(f"0x{byte:02X}U" for byte in wrong_bytes.RIGHT)
    pairs = [
        f"{{{place}U, FIELDSCRIBE_CAN_{reason.upper()}}}"
        for reason, places in wrong_bytes.WRONG.items()
        for place in places
    ]
    return CAN_WRONG_BYTES.replace("@RIGHT@", right).replace("@WRONG@", ", ".join(pairs))


CAN_TELEGRAM = program("can_telegram")

USS_DIALOGUE = program("uss_dialogue")

USES = {"can": CAN_DIALOGUE, "can_telegram": CAN_TELEGRAM, "can_wrong_bytes": can_wrong_bytes(), "uss": USS_DIALOGUE}


@pytest.mark.full(seconds=0.5)
@pytest.mark.parametrize(
    ("use", "way", "standard"),
    [
        ("can", "clang", "c++11"),
        ("can_telegram", "gcc", "c99"),
        ("can_wrong_bytes", "clang", "c++11"),
        ("uss", "gcc", "c99"),
        ("uss", "clang", "c++11"),
    ],
)
def test_a_dialogue(use: str, way: str, standard: str, folder: Path, tmp_path: Path) -> None:
    run_program(USES[use], way, folder, tmp_path, standard=standard)


DRAW = """
static uint32_t state = 1U;
static uint32_t draw(void)
{
    state = (uint32_t)(((uint64_t)state * 48271U) % 2147483647U);
    return state;
}
"""

CAN_NOISE = program("can_noise")

USS_NOISE = program("uss_noise")


@pytest.mark.parametrize("way", SANITIZING)
@pytest.mark.parametrize("noise", [CAN_NOISE, USS_NOISE], ids=FAMILIES)
def test_any_bytes_are_safe_to_parse(noise: str, way: str, folder: Path, tmp_path: Path) -> None:
    run_program(noise.replace("@DRAW@", DRAW), way, folder, tmp_path)


# what no generated table holds, and no request that can be sent
STRANGE = {"can": program("strange_can"), "uss": program("strange_uss"), "modbus": program("strange_modbus")}


@pytest.mark.parametrize("way", SANITIZING)
@pytest.mark.parametrize("family", sorted(STRANGE))
def test_strange_tables_and_requests_are_safe(family: str, way: str, folder: Path, tmp_path: Path) -> None:
    """Numbers that shift too far, frames of no words, links of one word, echoes of no value."""
    runtime = templates_dir() / "c" / "runtime"
    run_program(STRANGE[family].replace("\\\\", "\\"), way, folder, tmp_path, f"-I{runtime}")


@pytest.mark.parametrize("family", FAMILIES)
def test_a_runtime_of_another_version_is_refused(family: str, folder: Path, tmp_path: Path) -> None:
    for path in folder.glob("*.h"):
        text = path.read_text("utf-8")
        renewed = re.sub(rf"(#define \w+_{family.upper()}_INTERFACE) \d+", r"\1 99", text)
        (tmp_path / path.name).write_text(renewed, encoding="utf-8")
    header = tmp_path / f"kitchen_{family}_{family}.h"
    done = run([tool("gcc"), "-std=c99", "-fsyntax-only", "-x", "c", header])
    assert done.returncode != 0
    assert "of another version" in done.stderr


SECTIONS = ("-ffunction-sections", "-fdata-sections", "-Wl,--gc-sections")
"""What leaves out functions that nobody calls."""

CAN_FIRMWARE = program("can_firmware")

USS_FIRMWARE = program("uss_firmware")


@pytest.mark.full(seconds=1)
@pytest.mark.parametrize("firmware", [CAN_FIRMWARE, USS_FIRMWARE], ids=FAMILIES)
def test_cortex_m0_image_is_without_float(firmware: str, folder: Path, tmp_path: Path) -> None:
    """Frames, a factor of type f32 and limits by factors: 64-bit integers at most."""
    (tmp_path / "firmware.c").write_text(firmware, encoding="utf-8")
    flags = ("-mcpu=cortex-m0", "-mthumb", "-Os", "-std=c99", "-nostartfiles", "-Wl,-e,start", f"-I{folder}")
    image = compiled(
        "arm-none-eabi-gcc", (*flags, *SECTIONS, *WARNINGS), tmp_path / "firmware.c", tmp_path / "firmware.elf"
    )
    symbols = succeed([tool("arm-none-eabi-nm"), image])
    assert "start" in symbols
    assert not re.search(r"__aeabi_[df]|__[a-z]*[sd]f[0-9]", symbols)
    text = int(succeed([tool("arm-none-eabi-size"), image]).splitlines()[1].split()[0])
    print(f"Cortex-M0, -Os, a dialogue: .text {text} bytes")
    assert text <= 4320


# words in memory that has not one more than is told: too few are refused, and nothing beyond them is touched
TOO_FEW = {"modbus": program("too_few_modbus"), "uss": program("too_few_uss"), "can": program("too_few_can")}


@pytest.mark.parametrize("way", SANITIZING)
@pytest.mark.parametrize("family", sorted(TOO_FEW))
def test_too_few_words_are_refused(family: str, way: str, folder: Path, tmp_path: Path) -> None:
    device = "kitchen_sink" if family == "modbus" else f"kitchen_{family}"
    text = f"""
#include <stdlib.h>
#define FIELDSCRIBE_IMPLEMENTATION
#include "{device}_{family}.h"
static int refuses(uint16_t *one)
{{{TOO_FEW[family]}}}
int main(void)
{{
    uint16_t *const one = (uint16_t *)malloc(sizeof(uint16_t));
    int result;
    one[0] = 0xA5A5U;
    result = refuses(one);
    free(one);
    return result;
}}
"""
    run_program(text, way, folder, tmp_path)


def test_a_point_of_two_words_does_not_fit_into_one(folder: Path, tmp_path: Path) -> None:
    """Functions of points say in their parameters how many words they take; gcc holds arrays against that."""
    for count in (2, 1):
        text = f"""#include "kitchen_sink.h"
uint16_t use(uint32_t raw);
uint16_t use(uint32_t raw)
{{
    uint16_t words[{count}];
    kitchen_sink_plain_u32_to_words(raw, words);
    return words[0];
}}
"""
        (tmp_path / "two.c").write_text(text, "utf-8")
        flags = ("-std=c99", "-O1", *WARNINGS, f"-I{folder}", "-c", "-o", tmp_path / "o")
        done = run([tool("gcc"), *flags, tmp_path / "two.c"])
        assert (done.returncode == 0) == (count == 2)
        assert count == 2 or re.search("overflow|array-bounds", done.stderr)


BLOCK = program("modbus_block")


@pytest.mark.parametrize("way", SANITIZING)
def test_a_point_comes_out_of_a_block(way: str, folder: Path, tmp_path: Path) -> None:
    run_program(BLOCK, way, folder, tmp_path)


@pytest.mark.full(seconds=0.5)
@pytest.mark.parametrize("language", ["c", "c++"])
@pytest.mark.parametrize("family", ["modbus", "can", "uss"])
def test_the_definition_may_be_asked_for_late(family: str, language: str, folder: Path, tmp_path: Path) -> None:
    """A header that another header brought in before still defines its functions when it is included for them."""
    header = f"kitchen_{'sink' if family == 'modbus' else family}_{family}.h"
    call = {"modbus": "fieldscribe_modbus_crc(bytes, 1U)", "uss": "fieldscribe_uss_check(bytes, 1U)"}
    text = f"""#include "{header}"
#define FIELDSCRIBE_IMPLEMENTATION
#include "{header}"
#include "{header}"
int main(void)
{{
    const uint8_t bytes[1] = {{0U}};
    const fieldscribe_layout layout = {{FIELDSCRIBE_U8, 1U, 0U, false, 0U, 0xFFU, 0U, 0U}};
    uint16_t word = bytes[0];
    return fieldscribe_put_u8(&layout, 1U, &word, 1U) && {call.get(family, "fieldscribe_can_reply_length(NULL)")} != 1U
        ? 0
        : 1;
}}
"""
    (tmp_path / "late.c").write_text(text, "utf-8")
    compiler = ("gcc", "-std=c99") if language == "c" else ("g++", "-x", "c++", "-std=c++11")
    image = tmp_path / "late"
    succeed([tool(compiler[0]), *compiler[1:], *WARNINGS, f"-I{folder}", "-o", image, tmp_path / "late.c"])
    succeed([image])


RENAMED = program("renamed")


def renamed(point: Point) -> Point:
    """The point with an old name, which its enum had too if it is called after the point."""
    was = (f"old_{point.name}",)
    if point.enum_names == (point.item,):
        return replace(point, was=was, enum_names=(point.item, *was))
    return replace(point, was=was)


@pytest.mark.full(seconds=0.6)
def test_each_name_of_a_renamed_point_has_its_old_one(tmp_path: Path) -> None:
    """Frames, structs and enums of its own like constants and functions."""
    for name in ("kitchen_sink", "kitchen_codes", "kitchen_can", "kitchen_uss"):
        kitchen = made(name)
        plain = replace(kitchen, points=tuple(replace(one, was=()) for one in kitchen.points))
        points = tuple(renamed(one) if one.generated else one for one in plain.points)
        device = replace(plain, points=points)
        names = {name for one in c.identifiers(device) for name in one.names}
        assert {name for one in c.identifiers(plain) for name in one.names} < names
        generated = {point.item for point in points if point.generated}
        begin = len(f"{name}_")
        for one in c.identifiers(plain):
            whole = one.owner.of or one.owner
            for known in one.names if whole.kind == "point" and whole.name in generated else ():
                old, at = "OLD_" if known.isupper() else "old_", known.lower().find(whole.name, begin)
                assert f"{known[:at]}{old}{known[at:]}" in names or known.endswith(("_rule", "_ranges"))
    write_headers(device, tmp_path)
    (tmp_path / "old.c").write_text(RENAMED, "utf-8")
    flags = ("-std=c99", "-O1", *WARNINGS, f"-I{tmp_path / 'c'}")
    succeed([compiled("gcc", flags, tmp_path / "old.c", tmp_path / "old")])


USER = program("user_of_headers")

MANY = """
#include <stdint.h>
#include <stddef.h>
@DECLARED@
volatile int result;
uint8_t frame[8];
@ENTRY@
{
@CALLED@
    @END@
}
"""


def users(
    folder: Path, count: int, *, defined: int, entry: str = "int main(void)", end: str = "return 0;"
) -> list[Path]:
    """C files that each use Modbus, `defined` of which have the implementation, and one that calls them."""
    made = []
    for number in range(1, count + 1):
        head = "#define FIELDSCRIBE_IMPLEMENTATION\n" if number <= defined else ""
        path = folder / f"user_{number}.c"
        path.write_text(head + USER.replace("@NUMBER@", str(number)), "utf-8")
        made.append(path)
    declared = "\n".join(f"int user_{n}(const uint8_t *, size_t, uint8_t *);" for n in range(1, count + 1))
    called = "\n".join(f"    result += user_{n}(frame, 8U, frame);" for n in range(1, count + 1))
    text = MANY.replace("@DECLARED@", declared).replace("@CALLED@", called).replace("@END@", end)
    path = folder / "main.c"
    path.write_text(text.replace("@ENTRY@", entry), "utf-8")
    return [*made, path]


@pytest.mark.parametrize("language", ["c", pytest.param("c++", marks=pytest.mark.full(seconds=1))])
def test_many_files_share_one_definition(language: str, folder: Path, tmp_path: Path) -> None:
    flags = ("-std=c99",) if language == "c" else ("-x", "c++", "-std=c++11")
    files = users(tmp_path, 3, defined=1)
    build = [tool("g++" if language == "c++" else "gcc"), *flags, *WARNINGS, f"-I{folder}"]
    succeed([*build, "-Wno-missing-declarations", "-o", tmp_path / "one", *files])


@pytest.mark.full(seconds=1)
@pytest.mark.parametrize("language", ["c", "c++"])
def test_a_forgotten_or_doubled_definition_does_not_link(language: str, folder: Path, tmp_path: Path) -> None:
    """The linker names the function."""
    flags = ("-std=c99",) if language == "c" else ("-x", "c++", "-std=c++11")
    build = [tool("g++" if language == "c++" else "gcc"), *flags, f"-I{folder}", "-o", tmp_path / "one"]
    forgotten = run([*build, *users(tmp_path, 2, defined=0)])
    assert forgotten.returncode != 0
    assert "undefined reference to `fieldscribe_modbus_build_rtu'" in forgotten.stderr
    doubled = run([*build, *users(tmp_path, 2, defined=2)])
    assert doubled.returncode != 0
    assert "multiple definition of `fieldscribe_modbus_build_rtu'" in doubled.stderr


def linked(count: int, folder: Path, out: Path) -> Path:
    """A Cortex-M0 image of so many files that use Modbus."""
    files = users(out, count, defined=1, entry="void start(void);\nvoid start(void)", end="for (;;) {\n    }")
    flags = ("-mcpu=cortex-m0", "-mthumb", "-Os", "-std=c99", "-nostartfiles", "-Wl,-e,start")
    image = out / f"image_{count}.elf"
    succeed([tool("arm-none-eabi-gcc"), *flags, *SECTIONS, f"-I{folder}", "-o", image, *files])
    return image


@pytest.mark.full(seconds=2)
def test_the_runtime_is_linked_once(folder: Path, tmp_path: Path) -> None:
    """A third file that uses Modbus costs its own calls and tables alone."""
    sizes = []
    for count in (1, 2, 3):
        image = linked(count, folder, tmp_path)
        names = re.findall(r" [Tt] (fieldscribe_\w+)", succeed([tool("arm-none-eabi-nm"), image]))
        assert "fieldscribe_modbus_build_rtu" in names
        assert len(names) == len(set(names))
        sizes.append(int(succeed([tool("arm-none-eabi-size"), image]).splitlines()[1].split()[0]))
    print(f"Cortex-M0, -Os, one, two and three files that use Modbus: {sizes} bytes")
    assert sizes[2] - sizes[1] <= 264


ONE_POINT = program("one_point")


@pytest.mark.full(seconds=1)
def test_a_program_that_reads_registers_links_nothing_else(tmp_path: Path) -> None:
    """Requests bring what they need: neither what writes nor what reads bits is in the image."""
    device = shipped("hitachi_l200")
    write_headers(device, tmp_path)
    (tmp_path / "one.c").write_text(ONE_POINT, "utf-8")
    flags = ("-mcpu=cortex-m0", "-mthumb", "-Os", "-std=c99", "-nostartfiles", "-Wl,-e,start", f"-I{tmp_path / 'c'}")
    image = compiled("arm-none-eabi-gcc", (*flags, *SECTIONS, *WARNINGS), tmp_path / "one.c", tmp_path / "one.elf")
    symbols = succeed([tool("arm-none-eabi-nm"), image])
    assert not re.search("take_echo|put_writing|put_several|_tcp", symbols)
    text = int(succeed([tool("arm-none-eabi-size"), image]).splitlines()[1].split()[0])
    print(f"Cortex-M0, -Os, one register read over RTU: .text {text} bytes")
    assert text <= 970


MISUSE = {
    "no `write` of a point that is only read": (
        "(void)fieldscribe_modbus_write(1U, &kitchen_sink_@R@_frame.write, words, 2U);",
        "write",
    ),
    "a bit group is not written like a word": (
        "(void)fieldscribe_modbus_write(1U, &kitchen_sink_ratio_frame.write, words, 2U);",
        "write",
    ),
    "what reads does not write": (
        "(void)fieldscribe_modbus_write(1U, &kitchen_sink_ratio_frame.read, words, 2U);",
        "incompatible|cannot convert|no matching function|no known conversion",
    ),
    "a point of another device": (
        "(void)kitchen_sink_read_run(other, NULL);",
        r"kitchen_sink_device.*kitchen_uss_device|kitchen_uss_device.*kitchen_sink_device",
    ),
}
IGNORED = {
    "a status is not ignored": (
        "fieldscribe_modbus_parse(FIELDSCRIBE_MODBUS_RTU, request, bytes, 8U, reply);",
        "unused-result|nodiscard|warn_unused_result",
    ),
    "whether a number fits is not ignored": (
        "fieldscribe_put_u16(kitchen_sink_ratio_frame.layout, 9U, words, 2U);",
        "unused-result|nodiscard|warn_unused_result",
    ),
}
"""Apart, as gcc looks for these only where all else is right."""


@pytest.mark.full(seconds=0.5)
@pytest.mark.parametrize(("compiler", "standard"), [("gcc", "c99"), ("clang", "c++11"), ("gcc", "c++17")])
@pytest.mark.parametrize("misuse", [MISUSE, IGNORED], ids=["types", "ignored"])
def test_misuse_does_not_compile(
    misuse: dict[str, tuple[str, str]], compiler: str, standard: str, folder: Path, tmp_path: Path
) -> None:
    """Each line that is wrong is told, and no other."""
    names = re.findall(r"fieldscribe_modbus_r kitchen_sink_(\w+)_frame", (folder / "kitchen_sink_modbus.h").read_text())
    calls = "".join(f"    {call.replace('@R@', names[0])}\n" for call, _ in misuse.values())
    text = f"""#include "kitchen_sink_modbus.h"
#include "kitchen_uss_uss.h"
void use(uint16_t *words, const uint8_t *bytes, const fieldscribe_modbus_request *request,
    fieldscribe_modbus_reply *reply, kitchen_uss_device *other);
void use(uint16_t *words, const uint8_t *bytes, const fieldscribe_modbus_request *request,
    fieldscribe_modbus_reply *reply, kitchen_uss_device *other)
{{
    (void)other, (void)words, (void)bytes, (void)request, (void)reply;
{calls}}}
"""
    (tmp_path / "wrong.c").write_text(text, "utf-8")
    words = [tool(driver(compiler, standard)), *STANDARDS[standard], *WARNINGS, f"-I{folder}", "-c"]
    done = run([*words, "-o", tmp_path / "one.o", tmp_path / "wrong.c"])
    assert done.returncode != 0
    messages = re.split(r"^\S*wrong\.c:(\d+):\d+: error: ", done.stderr, flags=re.MULTILINE)
    said_at: dict[int, str] = {}
    for line, message in zip(map(int, messages[1::2]), messages[2::2], strict=True):
        said_at[line] = said_at.get(line, "") + message
    first = text[: text.index(calls)].count("\n") + 1
    assert sorted(said_at) == list(range(first, first + len(misuse)))
    for line, (_, said) in enumerate(misuse.values(), first):
        assert re.search(said, said_at[line], re.DOTALL), said_at[line]


def test_no_line_is_longer_than_a_screen(folder: Path) -> None:
    """Headers of frames, their runtimes and the conformance programs."""
    frames = [*folder.glob("kitchen_*_modbus.h"), *folder.glob("kitchen_*_can.h"), *folder.glob("kitchen_*_uss.h")]
    for path in (*frames, *folder.glob("fieldscribe*.h"), *folder.glob("conformance/*.c")):
        assert [line for line in path.read_text("utf-8").splitlines() if len(line) > 120] == [], path.name


@pytest.mark.parametrize(
    ("header", "lines", "size"), [("hitachi_l200_modbus.h", 2700, 176_000), ("woodward_mpu2s_can.h", 2000, 110_000)]
)
def test_what_a_firmware_team_vendors_for_frames_is_small(header: str, lines: int, size: int) -> None:
    """Frames of 236 points, and of 268."""
    text = (ROOT / "generated/c" / header).read_text("utf-8")
    assert text.count("\n") <= lines
    assert len(text.encode()) <= size
