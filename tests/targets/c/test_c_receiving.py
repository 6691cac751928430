"""What a receiver in C lives through: recipes of the headers, noise, answers of a wrong length, words that are gone."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import TYPE_CHECKING

import pytest
from fieldscribe.resources import templates_dir
from support.c_device import SANITIZERS, SANITIZING, WARNINGS, write_headers
from support.described import made, shipped
from support.toolchains import compiled, run, succeed, tool

if TYPE_CHECKING:
    from pathlib import Path

KITCHENS = {"modbus": "kitchen_sink", "can": "kitchen_can", "uss": "kitchen_uss"}
DEVICES = {"modbus": "hitachi_l200", "can": "woodward_mpu2s", "uss": "siemens_mm4"}
"""The devices that the recipes name."""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The headers of a kitchen of each family, side by side."""
    out = tmp_path_factory.mktemp("kitchens")
    for name in KITCHENS.values():
        write_headers(made(name), out)
    return out / "c"


def recipe(family: str) -> str:
    """The statements at the top of a family's runtime; remarks stand in brackets behind them, or alone."""
    text = (templates_dir() / "c" / "runtime" / f"fieldscribe_{family}.h").read_text("utf-8")
    head = text[: text.index("*/")]
    lines = re.findall(r"^ \*     (.*)$", head, re.MULTILINE)
    return "\n".join(re.sub(r"(^|\s{2,})\(.*\)$", "", line) for line in lines)


# a line on which a byte of noise has come before each request, and another comes before the answer
SERIAL_LINE = """
static uint8_t line[600];
static size_t begin;
static size_t end;
static uint8_t answer[300];
static size_t answered;
static void discard(void)
{
    begin = end;
}
static void send(const uint8_t *bytes, size_t length)
{
    size_t at;
    (void)bytes;
    (void)length;
    line[end] = answer[0];
    ++end;
    for (at = 0U; at < answered; ++at) {
        line[end] = answer[at];
        ++end;
    }
}
static bool receive(uint8_t *byte)
{
    if (begin == end) {
        exit(9); /* the line stays silent */
    }
    *byte = line[begin];
    ++begin;
    return true;
}
"""

RECIPES = {
    "modbus": """
#define profile hitachi_l200_modbus_profile
int main(void)
{
    const uint8_t unit = 5U;
    uint16_t raw = 0U;
    uint16_t crc;
    int times;
    static const uint8_t words_come[] = {5U, 3U, 2U, 1U, 0xF4U};
    for (answered = 0U; answered < sizeof words_come; ++answered) {
        answer[answered] = words_come[answered];
    }
    crc = fieldscribe_modbus_crc(answer, answered);
    answer[answered] = (uint8_t)(crc & 0xFFU);
    answer[answered + 1U] = (uint8_t)(crc >> 8);
    answered += 2U;
    for (times = 0; times < 3; ++times) {
        fieldscribe_modbus_request request;
        fieldscribe_modbus_receiver receiver;
        fieldscribe_modbus_status status;
        size_t length;
        uint8_t byte;
        bool fits;
        line[end] = 0xFFU;
        ++end;
        {
            @RECIPE@
            if (status != FIELDSCRIBE_MODBUS_OK || !fits || raw != 500U) {
                return 1;
            }
        }
    }
    return 0;
}
""",
    "uss": """
#define profile siemens_mm4_uss_profile
int main(void)
{
    static const fieldscribe_uss_link link = {4U, 2U, false};
    static const uint16_t sent[2] = {0U, 0U};
    static uint16_t heard[2];
    const uint8_t unit = 3U;
    uint32_t raw = 0U;
    int times;
    static const uint8_t words_come[] = {2U, 14U, 3U, 0x24U, 0x3AU, 0U, 0U, 0x42U, 0x48U, 0U, 0U, 0xFAU, 0x31U, 0U, 0U};
    for (answered = 0U; answered < sizeof words_come; ++answered) {
        answer[answered] = words_come[answered];
    }
    answer[answered] = fieldscribe_uss_check(answer, answered);
    ++answered;
    for (times = 0; times < 3; ++times) {
        fieldscribe_uss_request request;
        fieldscribe_uss_receiver receiver;
        fieldscribe_uss_status status;
        size_t length;
        uint8_t byte;
        bool fits;
        line[end] = 0xFFU;
        ++end;
        {
            @RECIPE@
            if (status != FIELDSCRIBE_USS_OK || !fits || raw != 0x42480000U) {
                return 1;
            }
        }
    }
    return 0;
}
""",
    "can": """
#define dialogue woodward_mpu2s_can_dialogue
static bool late = true; /* an answer of an earlier question is still there */
static void discard(void)
{
    late = false;
}
static void send(fieldscribe_can_frame *asked)
{
    const fieldscribe_can_content content = {
        1U, woodward_mpu2s_password_level_2_frame.read.address, late ? 7U : 8U};
    if (fieldscribe_can_build(dialogue.profile, dialogue.read_answer, &content, asked) != FIELDSCRIBE_CAN_OK) {
        exit(9);
    }
}
int main(void)
{
    const uint8_t unit = 1U;
    fieldscribe_can_frame frame;
    fieldscribe_can_status status;
    uint16_t word = 0U;
    uint16_t raw = 0U;
    bool fits;
    @RECIPE@
    return status == FIELDSCRIBE_CAN_OK && fits && raw == 8U ? 0 : 1;
}
""",
}


@pytest.mark.parametrize("compiler", SANITIZING)
@pytest.mark.parametrize("family", sorted(RECIPES))
def test_the_recipe_of_a_runtime_works(family: str, compiler: str, tmp_path: Path) -> None:
    """As it stands there, also with noise before the request and the answer; its names are each of one thing."""
    name = DEVICES[family]
    device = shipped(name)
    write_headers(device, tmp_path)
    program = ("" if family == "can" else SERIAL_LINE) + RECIPES[family].replace("@RECIPE@", recipe(family))
    head = f'#include <stdlib.h>\n#define FIELDSCRIBE_IMPLEMENTATION\n#include "{name}_{family}.h"\n'
    (tmp_path / "recipe.c").write_text(head + program, "utf-8")
    # statuses on the way are given, and not all of them looked at
    allowed = ("-Wno-unused-but-set-variable", "-Wno-float-equal")
    flags = ("-std=c99", "-O1", *WARNINGS, *allowed, *SANITIZERS[compiler], f"-I{tmp_path / 'c'}")
    succeed([compiled(compiler, flags, tmp_path / "recipe.c", tmp_path / "recipe")])


@pytest.mark.parametrize("family", ["modbus", "uss"])
def test_a_recipe_says_what_a_serial_line_does(family: str) -> None:
    """Echoes of one's own bytes, answers that come late, and what a write is answered with."""
    text = (templates_dir() / "c" / "runtime" / f"fieldscribe_{family}.h").read_text("utf-8")
    head = re.sub(r"\s*\n \*\s*", " ", text[: text.index("*/")])
    for said in ("drop these `length` bytes again", "until the line is silent", "Its answer is parsed, too"):
        assert said in head


TOLD = {
    "modbus": """
    static const fieldscribe_modbus_reading two = {3U, 100U, 2U};
    static const fieldscribe_modbus_reading nine = {1U, 100U, 9U};
    static const uint8_t more[] = {1, 3, 6, 0, 1, 0, 2, 0, 3, 0xFD, 0x74};
    static const uint8_t less[] = {1, 3, 2, 0, 1, 0x79, 0x84};
    static const uint8_t bits[] = {1, 1, 1, 5, 0x91, 0x8B};
    static const uint8_t none[] = {1, 3, 0, 0x20, 0xF0};
    static const uint8_t tcp[] = {0, 0, 0, 0, 0, 5, 1, 3, 2, 0, 1};
    uint16_t words[9];
    fieldscribe_modbus_reply reply = {words, 9U, 0U, 0U};
    fieldscribe_modbus_request request = fieldscribe_modbus_read(1U, &two);
    return whole(FIELDSCRIBE_MODBUS_RTU, &request, more, 99U) == sizeof more &&
            whole(FIELDSCRIBE_MODBUS_RTU, &request, less, 99U) == sizeof less &&
            whole(FIELDSCRIBE_MODBUS_RTU, &request, none, 99U) == sizeof none &&
            whole(FIELDSCRIBE_MODBUS_RTU, &request, more, 10U) == 10U &&
            whole(FIELDSCRIBE_MODBUS_TCP, &request, tcp, 99U) == sizeof tcp &&
            fieldscribe_modbus_parse(FIELDSCRIBE_MODBUS_RTU, &request, more, sizeof more, &reply) ==
                FIELDSCRIBE_MODBUS_BAD_BYTE_COUNT &&
            fieldscribe_modbus_parse(FIELDSCRIBE_MODBUS_RTU, &request, less, sizeof less, &reply) ==
                FIELDSCRIBE_MODBUS_BAD_BYTE_COUNT &&
            fieldscribe_modbus_parse(FIELDSCRIBE_MODBUS_RTU, &request, none, sizeof none, &reply) ==
                FIELDSCRIBE_MODBUS_BAD_BYTE_COUNT &&
            fieldscribe_modbus_parse(FIELDSCRIBE_MODBUS_TCP, &request, tcp, sizeof tcp, &reply) ==
                FIELDSCRIBE_MODBUS_BAD_BYTE_COUNT &&
            (request = fieldscribe_modbus_read(1U, &nine),
                whole(FIELDSCRIBE_MODBUS_RTU, &request, bits, 99U) == sizeof bits) &&
            fieldscribe_modbus_parse(FIELDSCRIBE_MODBUS_RTU, &request, bits, sizeof bits, &reply) ==
                FIELDSCRIBE_MODBUS_BAD_BYTE_COUNT
        ? 0
        : 1;
}
""",
    "uss": """
    static const uint8_t more[] = {2, 14, 3, 0x14, 0x3A, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0x2C};
    static const uint8_t less[] = {2, 10, 3, 0x14, 0x3A, 0, 0, 0, 1, 0, 0, 0x24};
    const fieldscribe_uss_link fixed = {4U, 1U, false};
    const fieldscribe_uss_request request = fieldscribe_uss_read(3U, &kitchen_uss_maximum_frequency_frame.read);
    uint16_t heard[4];
    fieldscribe_uss_reply reply = {heard, 4U, 0U, 0U, 0U, 0U};
    return whole(&fixed, more) == sizeof more && whole(&fixed, less) == sizeof less &&
            fieldscribe_uss_parse(&kitchen_uss_uss_profile, &fixed, &request, more, sizeof more, &reply) ==
                FIELDSCRIBE_USS_WRONG_LENGTH &&
            fieldscribe_uss_parse(&kitchen_uss_uss_profile, &fixed, &request, less, sizeof less, &reply) ==
                FIELDSCRIBE_USS_WRONG_LENGTH &&
            fieldscribe_uss_left(&fixed, more + 1, 99U, 2U) == 12U /* noise says nothing */
        ? 0
        : 1;
}
""",
}

WHOLE = {
    "modbus": """
/* How many bytes a receiver takes that gets them one by one. */
static size_t whole(
    fieldscribe_modbus_framing framing, const fieldscribe_modbus_request *request, const uint8_t *bytes, size_t size)
{
    size_t got = 0U;
    while (fieldscribe_modbus_left(&kitchen_sink_modbus_profile, framing, request, bytes, size, got) > 0U) {
        ++got;
    }
    return got;
}
""",
    "uss": """
static size_t whole(const fieldscribe_uss_link *link, const uint8_t *bytes)
{
    size_t got = 0U;
    while (fieldscribe_uss_left(link, bytes, 99U, got) > 0U) {
        ++got;
    }
    return got;
}
""",
}


@pytest.mark.parametrize("compiler", SANITIZING)
@pytest.mark.parametrize("family", sorted(TOLD))
def test_an_answer_of_another_length_is_received_whole(
    family: str, compiler: str, folder: Path, tmp_path: Path
) -> None:
    """What it says of its length counts: it is refused for that, without waiting for bytes that never come."""
    head = f'#define FIELDSCRIBE_IMPLEMENTATION\n#include "{KITCHENS[family]}_{family}.h"\n'
    (tmp_path / "told.c").write_text(f"{head}{WHOLE[family]}int main(void)\n{{{TOLD[family]}", "utf-8")
    flags = ("-std=c99", "-O1", *WARNINGS, *SANITIZERS[compiler], f"-I{folder}")
    succeed([compiled(compiler, flags, tmp_path / "told.c", tmp_path / "told")])


GONE = """
#define FIELDSCRIBE_IMPLEMENTATION
#include "kitchen_sink_modbus.h"
/* A state machine takes its words for something else as soon as the request is on its way. */
int main(void)
{
    static const uint8_t functions[] = {5U, 6U, 8U, 15U, 16U};
    size_t at;
    for (at = 0U; at < FIELDSCRIBE_COUNT(functions); ++at) {
        const fieldscribe_modbus_writing what = {functions[at], 0U, 1U};
        uint16_t words[1] = {1U};
        const fieldscribe_modbus_request request = fieldscribe_modbus_write(1U, &what, words, 1U);
        uint8_t bytes[11];
        uint16_t echoed = 1U;
        fieldscribe_modbus_reply reply = {&echoed, 1U, 0U, 0U};
        fieldscribe_modbus_status status;
        size_t length = 0U;
        uint16_t crc;
        status = fieldscribe_modbus_build(
            &kitchen_sink_modbus_profile, FIELDSCRIBE_MODBUS_RTU, &request, bytes, sizeof bytes, &length);
        if (status != FIELDSCRIBE_MODBUS_OK) {
            return (int)status;
        }
        words[0] = 7U;
        crc = fieldscribe_modbus_crc(bytes, 6U); /* the answer: the first six bytes */
        bytes[6] = (uint8_t)(crc & 0xFFU);
        bytes[7] = (uint8_t)(crc >> 8);
        if (fieldscribe_modbus_parse(FIELDSCRIBE_MODBUS_RTU, &request, bytes, 8U, &reply) != FIELDSCRIBE_MODBUS_OK ||
            echoed != 1U) {
            return 100;
        }
    }
    return 0;
}
"""


@pytest.mark.parametrize("compiler", SANITIZING)
def test_an_answer_does_not_need_the_words_that_were_written(compiler: str, folder: Path, tmp_path: Path) -> None:
    (tmp_path / "gone.c").write_text(GONE, "utf-8")
    flags = ("-std=c99", "-O1", *WARNINGS, *SANITIZERS[compiler], f"-I{folder}")
    succeed([compiled(compiler, flags, tmp_path / "gone.c", tmp_path / "gone")])


NOTHING = {
    "modbus": """
    static const fieldscribe_modbus_reading two = {3U, 8U, 2U};
    static const fieldscribe_modbus_reading one_bit = {1U, 8U, 1U};
    static const fieldscribe_modbus_writing one = {6U, 8U, 1U};
    static const fieldscribe_modbus_writing several = {16U, 8U, 2U};
    static const uint8_t words_come[] = {1, 3, 4, 0, 1, 0, 2, 0x2A, 0x32};
    static const uint8_t bits_come[] = {1, 1, 1, 1, 0x90, 0x48};
    static const uint16_t where[2] = {8U, 9U};
    const fieldscribe_text text = {where, 8U, 2U};
    const fieldscribe_modbus_profile *const profile = &kitchen_sink_modbus_profile;
    fieldscribe_modbus_request request = fieldscribe_modbus_write(1U, &one, NULL, 1U);
    fieldscribe_modbus_reply reply = {NULL, 9U, 0U, 0U};
    uint8_t bytes[FIELDSCRIBE_MODBUS_RTU_MOST];
    uint16_t words[2] = {0U, 0U};
    uint16_t raw;
    size_t length;
    if (fieldscribe_modbus_build(profile, FIELDSCRIBE_MODBUS_RTU, &request, bytes, sizeof bytes, &length) !=
        FIELDSCRIBE_MODBUS_BAD_COUNT) {
        return 1;
    }
    request = fieldscribe_modbus_write(1U, &several, NULL, 2U);
    if (fieldscribe_modbus_build(profile, FIELDSCRIBE_MODBUS_RTU, &request, bytes, sizeof bytes, &length) !=
        FIELDSCRIBE_MODBUS_BAD_COUNT) {
        return 2;
    }
    request = fieldscribe_modbus_read(1U, &two);
    if (fieldscribe_modbus_parse(FIELDSCRIBE_MODBUS_RTU, &request, words_come, sizeof words_come, &reply) !=
        FIELDSCRIBE_MODBUS_BUFFER_TOO_SMALL) {
        return 3;
    }
    reply.count = 2U;
    if (fieldscribe_modbus_words_in(&request, &reply, &two) != NULL) {
        return 4;
    }
    request = fieldscribe_modbus_read(1U, &one_bit);
    if (fieldscribe_modbus_parse(FIELDSCRIBE_MODBUS_RTU, &request, bits_come, sizeof bits_come, &reply) !=
        FIELDSCRIBE_MODBUS_BUFFER_TOO_SMALL) {
        return 5;
    }
    request = fieldscribe_modbus_write(1U, &one, words, 1U);
    if (fieldscribe_modbus_build(profile, FIELDSCRIBE_MODBUS_RTU, &request, bytes, sizeof bytes, &length) !=
            FIELDSCRIBE_MODBUS_OK ||
        fieldscribe_modbus_parse(FIELDSCRIBE_MODBUS_RTU, &request, bytes, length, &reply) != FIELDSCRIBE_MODBUS_OK ||
        reply.count != 0U) {
        return 6;
    }
    return fieldscribe_take_u16(NULL, words, 2U, &raw) || fieldscribe_put_u16(NULL, 1U, words, 2U) ||
            fieldscribe_take_text(&text, NULL, 2U, words, 2U) || fieldscribe_take_text(&text, words, 2U, NULL, 2U) ||
            fieldscribe_put_text(&text, NULL, 2U, words, 2U) || fieldscribe_put_text(&text, words, 2U, NULL, 2U)
        ? 7
        : 0;
""",
    "uss": """
    const fieldscribe_uss_link link = {4U, 1U, false};
    const fieldscribe_uss_words process = {NULL, 1U};
    static const uint16_t sent[1] = {0U};
    const fieldscribe_uss_words full = {sent, 1U};
    static const uint16_t mask[4] = {0U, 0U, 0U, 0U};
    static const uint8_t answer[] = {2, 12, 3, 0x24, 0x3A, 0, 0, 0x42, 0x48, 0, 0, 0, 0, 0x19};
    fieldscribe_uss_request request = fieldscribe_uss_read(3U, &kitchen_uss_maximum_frequency_frame.read);
    fieldscribe_uss_reply reply = {NULL, 9U, 0U, 0U, 0U, 0U};
    uint8_t bytes[FIELDSCRIBE_USS_MOST];
    size_t length;
    const fieldscribe_uss_profile *const profile = &kitchen_uss_uss_profile;
    if (fieldscribe_uss_build(profile, &link, &request, &process, bytes, sizeof bytes, &length) !=
            FIELDSCRIBE_USS_BAD_LINK ||
        fieldscribe_uss_build_broadcast(profile, &link, mask, &process, bytes, sizeof bytes, &length) !=
            FIELDSCRIBE_USS_BAD_LINK) {
        return 1;
    }
    if (fieldscribe_uss_parse(profile, &link, &request, answer, sizeof answer, &reply) !=
        FIELDSCRIBE_USS_BUFFER_TOO_SMALL) {
        return 2;
    }
    reply.width = 2U;
    if (fieldscribe_uss_words_of_reply(&reply, &kitchen_uss_maximum_frequency_frame.read, NULL, 2U) !=
            FIELDSCRIBE_USS_BUFFER_TOO_SMALL ||
        fieldscribe_uss_words_heard(&kitchen_uss_main_actual_value_frame.heard, NULL, 2U) != NULL ||
        fieldscribe_uss_words_sent(&kitchen_uss_main_setpoint_frame.sent, NULL, 2U) != NULL) {
        return 3;
    }
    request = fieldscribe_uss_write(3U, &kitchen_uss_maximum_frequency_frame.write, NULL, 2U);
    return fieldscribe_uss_build(profile, &link, &request, &full, bytes, sizeof bytes, &length) ==
            FIELDSCRIBE_USS_BAD_VALUE
        ? 0
        : 4;
""",
    "can": """
    static const fieldscribe_can_frame frame = {0x322U, 8U, {0xDDU, 0U, 1U, 1U, 1U, 1U, 1U, 1U}};
    static fieldscribe_can_slot slots[KITCHEN_CAN_TELEGRAM_MEASUREMENTS_SLOTS];
    fieldscribe_can_receiver receiver = fieldscribe_can_listen(&kitchen_can_telegram_measurements, 2U, NULL, 99U);
    if (fieldscribe_can_take(&receiver, &frame)) {
        return 1;
    }
    receiver = fieldscribe_can_listen(&kitchen_can_telegram_measurements, 2U, slots, FIELDSCRIBE_COUNT(slots));
    return fieldscribe_can_take(&receiver, &frame) &&
            fieldscribe_can_received(&receiver, &kitchen_can_operating_hours_frame.heard, NULL, 2U) ==
                FIELDSCRIBE_CAN_BUFFER_TOO_SMALL &&
            fieldscribe_can_received_text(&receiver, &kitchen_can_display_frame.heard, NULL, 99U) ==
                FIELDSCRIBE_CAN_BUFFER_TOO_SMALL
        ? 0
        : 2;
""",
}


@pytest.mark.parametrize("compiler", SANITIZING)
@pytest.mark.parametrize("family", sorted(NOTHING))
def test_where_there_is_nothing_nothing_is_read_or_stored(
    family: str, compiler: str, folder: Path, tmp_path: Path
) -> None:
    """NULL with a count beside it is refused like too few."""
    head = f'#define FIELDSCRIBE_IMPLEMENTATION\n#include "{KITCHENS[family]}_{family}.h"\n'
    (tmp_path / "nothing.c").write_text(f"{head}int main(void)\n{{{NOTHING[family]}}}\n", "utf-8")
    flags = ("-std=c99", "-O1", *WARNINGS, *SANITIZERS[compiler], f"-I{folder}")
    succeed([compiled(compiler, flags, tmp_path / "nothing.c", tmp_path / "nothing")])


@pytest.mark.parametrize("family", sorted(KITCHENS))
def test_headers_of_two_descriptions_do_not_compile_together(family: str, tmp_path: Path) -> None:
    """One that was left behind when the other was generated anew is named."""
    name = KITCHENS[family]
    device = made(name)
    write_headers(device, tmp_path)
    frames = tmp_path / "c" / f"{name}_{family}.h"
    check: list[str | Path] = [tool("gcc"), "-std=c99", *WARNINGS, "-fsyntax-only", "-x", "c", frames]
    succeed(check)
    write_headers(replace(device, digest="0123456789abcdef" * 4), tmp_path / "next")
    (tmp_path / "c" / f"{name}.h").write_bytes((tmp_path / "next" / "c" / f"{name}.h").read_bytes())
    done = run(check)
    assert done.returncode != 0
    assert f"{name}.h is of another description" in done.stderr


READS = """
#define FIELDSCRIBE_NO_FLOAT
#define FIELDSCRIBE_IMPLEMENTATION
#include "kitchen_sink_modbus.h"
uint8_t buffer[FIELDSCRIBE_MODBUS_RTU_MOST];
volatile size_t heard;
volatile uint32_t shown;
void start(void);
void start(void)
{
    uint16_t words[2];
    uint32_t raw = 0U;
    size_t length = 0U;
    fieldscribe_modbus_reply reply = {words, 2U, 0U, 0U};
    const fieldscribe_modbus_request request = fieldscribe_modbus_read(1U, &kitchen_sink_plain_u32_frame.read);
    if (fieldscribe_modbus_build(&kitchen_sink_modbus_profile, FIELDSCRIBE_MODBUS_RTU, &request, buffer,
            sizeof buffer, &length) == FIELDSCRIBE_MODBUS_OK &&
        fieldscribe_modbus_parse(FIELDSCRIBE_MODBUS_RTU, &request, buffer, heard, &reply) == FIELDSCRIBE_MODBUS_OK &&
        fieldscribe_take_u32(kitchen_sink_plain_u32_frame.layout, words, reply.count, &raw)) {
        shown = raw;
    }
    for (;;) {
    }
}
"""


def test_what_is_not_asked_for_is_left_out_by_sections_of_functions_alone(folder: Path, tmp_path: Path) -> None:
    """No table holds what reads and writes together, so nobody has to know of -fdata-sections."""
    (tmp_path / "reads.c").write_text(READS, "utf-8")
    flags = ("-mcpu=cortex-m0", "-mthumb", "-Os", "-std=c99", "-nostartfiles", "-Wl,-e,start", f"-I{folder}")
    sections = ("-ffunction-sections", "-Wl,--gc-sections")
    image = compiled("arm-none-eabi-gcc", (*flags, *sections, *WARNINGS), tmp_path / "reads.c", tmp_path / "reads.elf")
    symbols = succeed([tool("arm-none-eabi-nm"), image])
    assert not re.search("take_bits|take_echo|put_writing|put_values|_tcp", symbols)


ASK = """
#define FIELDSCRIBE_IMPLEMENTATION
#include "kitchen_sink_modbus.h"
/* What came late for transaction 1, its end cut off, and the answer to transaction 2. */
static const uint8_t tcp[] = {0, 1, 0, 0, 0, 5, 1, 3, 2, 0, 9, 0, 1, 0, 0, 0, 5, 1, 3, 0, 2, 0, 0, 0, 5, 1, 3, 2, 1, 2};
static size_t heard;
static size_t sent;
static void send(void *context, const uint8_t *bytes, size_t length)
{
    (void)bytes;
    *(size_t *)context = length;
}
static bool receive(void *context, uint8_t *byte)
{
    (void)context;
    if (heard == sizeof tcp) {
        return false;
    }
    *byte = tcp[heard];
    ++heard;
    return true;
}
int main(void)
{
    static const fieldscribe_modbus_function functions[] = {{3U, 9U, false}, {6U, 1U, true}};
    static const fieldscribe_modbus_profile profile = {functions, 2U, 1U, 9U, 0U, false, true, true};
    static const fieldscribe_modbus_reading what = {3U, 100U, 1U};
    static const fieldscribe_modbus_writing to_all = {6U, 100U, 1U};
    uint8_t buffer[FIELDSCRIBE_MODBUS_TCP_MOST];
    const fieldscribe_modbus_line line = {&profile, buffer, sizeof buffer, &send, &receive, &sent};
    const fieldscribe_modbus_line narrow = {&profile, buffer, 11U, &send, &receive, &sent};
    uint16_t word = 0U;
    fieldscribe_modbus_reply reply = {&word, 1U, 0U, 0U};
    fieldscribe_modbus_request request = fieldscribe_modbus_read(1U, &what);
    request.transaction = 2U;
    if (fieldscribe_modbus_ask_tcp(&narrow, &request, &reply) != FIELDSCRIBE_MODBUS_BUFFER_TOO_SMALL || sent != 0U) {
        return 1;
    }
    if (fieldscribe_modbus_ask_tcp(&line, &request, &reply) != FIELDSCRIBE_MODBUS_OK || word != 258U || sent != 12U) {
        return 2;
    }
    if (fieldscribe_modbus_ask_tcp(&line, &request, &reply) != FIELDSCRIBE_MODBUS_SHORT_FRAME) {
        return 3;
    }
    heard = 0U;
    request = fieldscribe_modbus_write(0U, &to_all, &word, 1U);
    if (fieldscribe_modbus_ask_rtu(&line, &request, &reply) != FIELDSCRIBE_MODBUS_OK || sent != 8U || heard != 0U) {
        return 4;
    }
    return 0;
}
"""


@pytest.mark.full(seconds=2)
def test_a_line_is_asked(folder: Path, tmp_path: Path) -> None:
    """Over TCP an answer to an earlier request is dropped; nobody is waited for who does not answer."""
    (tmp_path / "ask.c").write_text(ASK, "utf-8")
    flags = ("-std=c99", "-O1", *WARNINGS, *SANITIZERS["gcc"], f"-I{folder}")
    succeed([compiled("gcc", flags, tmp_path / "ask.c", tmp_path / "ask")])


BABBLE = """
#define FIELDSCRIBE_IMPLEMENTATION
#include "kitchen_sink_modbus.h"
#include "kitchen_uss_uss.h"
/* What comes again and again, or once; never more than an answer is waited for. */
static const uint8_t *said;
static size_t length;
static size_t heard;
static size_t most;
static void send(void *context, const uint8_t *bytes, size_t count)
{
    (void)context;
    (void)bytes;
    (void)count;
    heard = 0U;
}
static bool receive(void *context, uint8_t *byte)
{
    (void)context;
    if (heard == most) {
        return false;
    }
    *byte = said[heard % length];
    ++heard;
    return true;
}
static void say(const uint8_t *bytes, size_t count, size_t times)
{
    said = bytes;
    length = count;
    most = count * times;
}
int main(void)
{
    static const fieldscribe_modbus_function functions[] = {{3U, 9U, false}};
    static const fieldscribe_modbus_profile profile = {functions, 1U, 1U, 9U, 0U, false, true, true};
    static const fieldscribe_modbus_reading what = {3U, 100U, 1U};
    static const uint8_t good[] = {1, 3, 2, 0, 1, 0x79, 0x84};
    static const uint8_t wrong_crc[] = {1, 3, 2, 0, 1, 0x79, 0x85};
    static const uint8_t other_unit[] = {2, 3, 2, 0, 1, 0x3D, 0x84};
    static const uint8_t tcp[] = {0, 0, 0, 0, 0, 5, 2, 3, 2, 0, 1};
    static const uint8_t wrong_check[] = {2, 12, 3, 0x14, 0x3A, 0, 0, 0, 0, 0, 1, 0, 0, 0x23};
    static const struct {
        const uint8_t *bytes;
        size_t length;
        size_t times;
        fieldscribe_modbus_status status;
    } rows[] = {
        {good, sizeof good, 1U, FIELDSCRIBE_MODBUS_OK},
        {good, sizeof good, 0U, FIELDSCRIBE_MODBUS_SHORT_FRAME},
        {good, 3U, 1U, FIELDSCRIBE_MODBUS_SHORT_FRAME},
        {wrong_crc, sizeof wrong_crc, 1U, FIELDSCRIBE_MODBUS_NOISE},
        {other_unit, sizeof other_unit, 1U, FIELDSCRIBE_MODBUS_NOISE},
        {other_unit, sizeof other_unit, 1000U, FIELDSCRIBE_MODBUS_NOISE},
    };
    const fieldscribe_uss_link link = {4U, 1U, false};
    uint8_t buffer[FIELDSCRIBE_MODBUS_TCP_MOST];
    uint16_t word = 0U;
    uint16_t sent = 0U;
    const fieldscribe_modbus_line line = {&profile, buffer, sizeof buffer, &send, &receive, NULL};
    const fieldscribe_uss_line other = {
        &kitchen_uss_uss_profile, &link, buffer, sizeof buffer, &send, &receive, NULL};
    const fieldscribe_uss_words process = {&sent, 1U};
    fieldscribe_modbus_reply reply = {&word, 1U, 7U, 7U};
    fieldscribe_uss_reply answer = {&word, 1U, 0U, 0U, 0U, 0U};
    const fieldscribe_modbus_request request = fieldscribe_modbus_read(1U, &what);
    const fieldscribe_uss_request task = fieldscribe_uss_read(3U, &kitchen_uss_maximum_frequency_frame.read);
    size_t at;
    for (at = 0U; at < FIELDSCRIBE_COUNT(rows); ++at) {
        say(rows[at].bytes, rows[at].length, rows[at].times);
        if (fieldscribe_modbus_ask_rtu(&line, &request, &reply) != rows[at].status || reply.exception != 0U) {
            return (int)at + 1;
        }
    }
    if (heard != FIELDSCRIBE_MODBUS_ASK_MOST) {
        return 10;
    }
    say(tcp, sizeof tcp, 1000U);
    if (fieldscribe_modbus_ask_tcp(&line, &request, &reply) != FIELDSCRIBE_MODBUS_NOISE ||
        heard != FIELDSCRIBE_MODBUS_ASK_MOST) {
        return 11;
    }
    say(wrong_check, sizeof wrong_check, 1U);
    if (fieldscribe_uss_ask(&other, &task, &process, &answer) != FIELDSCRIBE_USS_NOISE) {
        return 12;
    }
    say(wrong_check, sizeof wrong_check, 1000U);
    if (fieldscribe_uss_ask(&other, &task, &process, &answer) != FIELDSCRIBE_USS_NOISE ||
        heard != FIELDSCRIBE_USS_ASK_MOST) {
        return 13;
    }
    say(wrong_check, sizeof wrong_check, 0U);
    if (fieldscribe_uss_ask(&other, &task, &process, &answer) != FIELDSCRIBE_USS_WRONG_START) {
        return 14;
    }
    return 0;
}
"""


@pytest.mark.full(seconds=2)
def test_a_line_that_babbles_comes_to_an_end(folder: Path, tmp_path: Path) -> None:
    """And bytes that are no answer are told from silence."""
    (tmp_path / "babble.c").write_text(BABBLE, "utf-8")
    flags = ("-std=c99", "-O1", *WARNINGS, *SANITIZERS["gcc"], f"-I{folder}")
    succeed([compiled("gcc", flags, tmp_path / "babble.c", tmp_path / "babble")])
