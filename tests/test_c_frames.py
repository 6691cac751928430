"""Generated C of the CAN and USS families as firmware uses it: requests, answers, telegrams, and any bytes at all."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import pytest
import wrong_bytes
from c_device import SANITIZERS, STANDARDS, WARNINGS, driver, kitchen, write_headers
from fieldscribe.resources import templates_dir
from toolchains import compiled, run, succeed, tool

if TYPE_CHECKING:
    from pathlib import Path

FAMILIES = ("can", "uss")
COMPILERS = ("gcc", "clang")


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The headers of both kitchens, side by side."""
    out = tmp_path_factory.mktemp("kitchens")
    for family in FAMILIES:
        write_headers(kitchen(f"kitchen_{family}"), out)
    return out / "c"


CAN_DIALOGUE = """
#include <string.h>
#include "kitchen_can_can.h"
static int shows(const fieldscribe_can_frame *frame, uint32_t id, const char *bytes)
{
    return frame->id == id && frame->length == 8U && memcmp(frame->data, bytes, 8U) == 0;
}
int main(void)
{
    fieldscribe_can_frame frame = {0U, 0U, {0U}};
    uint16_t raw = 0U;
    uint16_t words[KITCHEN_CAN_FAULT_TEXT_1_WORDS] = {0U};
    char text[KITCHEN_CAN_FAULT_TEXT_1_CHARACTERS + 1U];
    uint8_t digits[KITCHEN_CAN_INPUT_DELAYS_DIGITS];
    size_t at;
    if (kitchen_can_transformer_secondary_read_request(5U, &frame) != FIELDSCRIBE_CAN_OK ||
        !shows(&frame, 0x33FU, "\\xFF\\x05\\x01\\xFB\\x00\\x00\\xFE\\xFE")) {
        return 1;
    }
    frame.id = 0x325U;
    memcpy(frame.data, "\\xFF\\x05\\x01\\xFB\\x01\\x90\\xFF\\x6E", 8U);
    if (kitchen_can_transformer_secondary_read_answer(5U, &frame, &raw) != FIELDSCRIBE_CAN_OK || raw != 400U ||
        kitchen_can_voltage_limit_read_answer(5U, &frame, &raw) != FIELDSCRIBE_CAN_WRONG_ADDRESS || raw != 400U ||
        kitchen_can_transformer_secondary_read_answer(6U, &frame, &raw) != FIELDSCRIBE_CAN_WRONG_ID) {
        return 2;
    }
    if (kitchen_can_frequency_setpoint_write_request(5U, 0x2D00U, &frame) != FIELDSCRIBE_CAN_OK ||
        !shows(&frame, 0x33FU, "\\xEE\\x05\\x00\\x0B\\x2D\\x00\\xC3\\x0E")) {
        return 3;
    }
    frame.id = 0x325U;
    if (kitchen_can_frequency_setpoint_write_answer(5U, 0x2D00U, &frame) != FIELDSCRIBE_CAN_OK ||
        kitchen_can_frequency_setpoint_write_answer(5U, 0x2D01U, &frame) != FIELDSCRIBE_CAN_ECHO_MISMATCH ||
        kitchen_can_frequency_setpoint_write_request(31U, 0x2D00U, &frame) != FIELDSCRIBE_CAN_BAD_UNIT) {
        return 4;
    }
    /* bits of a shared word, with constants beside them */
    if (kitchen_can_slow_ramp_write_request(5U, 0xFFFFU, false, &frame) != FIELDSCRIBE_CAN_OK ||
        frame.data[4] != 0xFFU || frame.data[5] != 0x07U) {
        return 5;
    }
    frame.id = 0x325U;
    if (kitchen_can_slow_ramp_write_answer(5U, 0xFFFFU, false, &frame) != FIELDSCRIBE_CAN_OK ||
        kitchen_can_slow_ramp_write_answer(5U, 0xFFFFU, true, &frame) != FIELDSCRIBE_CAN_ECHO_MISMATCH) {
        return 12;
    }
    frame.data[0] = 0xFFU;
    frame.data[6] = (uint8_t)(frame.data[6] ^ 0x11U);
    if (kitchen_can_slow_ramp_read_word(5U, &frame, &raw) != FIELDSCRIBE_CAN_OK || raw != 0xFF07U) {
        return 13;
    }
    /* a text: a message for each word */
    if (kitchen_can_fault_text_1_encode("Hot", 3U, words) != KITCHEN_CAN_OK) {
        return 6;
    }
    for (at = 0U; at < KITCHEN_CAN_FAULT_TEXT_1_WORDS; ++at) {
        if (kitchen_can_fault_text_1_write_request(1U, at, words, &frame) != FIELDSCRIBE_CAN_OK) {
            return 7;
        }
        frame.id = 0x321U;
        if (kitchen_can_fault_text_1_write_answer(1U, at, words, &frame) != FIELDSCRIBE_CAN_OK) {
            return 14;
        }
        words[at] = 0U;
        frame.data[0] = 0xFFU;
        frame.data[6] = (uint8_t)(frame.data[6] ^ 0x11U);
        if (kitchen_can_fault_text_1_read_answer(1U, at, &frame, words) != FIELDSCRIBE_CAN_OK) {
            return 8;
        }
    }
    if (kitchen_can_fault_text_1_write_request(1U, at, words, &frame) != FIELDSCRIBE_CAN_BAD_ADDRESS ||
        kitchen_can_fault_text_1_decode(words, text) != 3U || strcmp(text, "Hot") != 0) {
        return 9;
    }
    kitchen_can_input_delays_decode(12345U, digits);
    if (digits[0] != 12U || digits[1] != 3U || digits[3] != 5U) {
        return 10;
    }
    return KITCHEN_CAN_WORDS_GROUP_COUNT == sizeof kitchen_can_words_group / sizeof kitchen_can_words_group[0] ? 0 : 11;
}
"""

CAN_WRONG_BYTES = """
#include <string.h>
#include "kitchen_can_can.h"
static const uint8_t right[8] = {@RIGHT@};
static const struct {
    unsigned place;
    fieldscribe_can_status reason;
} wrong[] = {@WRONG@};
int main(void)
{
    fieldscribe_can_frame frame = {0x705U, 8U, {0U}};
    fieldscribe_can_slot slots[KITCHEN_CAN_TELEGRAM_HEARTBEAT_SLOTS];
    fieldscribe_can_receiver receiver = kitchen_can_telegram_heartbeat_listen(5U, slots);
    const uint8_t nobody[8] = {5U, 31U, 0U, 0U, 0U, 0U, 5U, 31U};
    uint16_t beats = 0U;
    uint16_t address = 0U;
    uint16_t raw = 0U;
    size_t at;
    for (at = 0U; at < sizeof wrong / sizeof wrong[0]; ++at) {
        memcpy(frame.data, right, 8U);
        frame.data[wrong[at].place] = (uint8_t)(frame.data[wrong[at].place] ^ 0x20U);
        if (fieldscribe_can_take(&receiver, &frame) ||
            fieldscribe_can_parse(&kitchen_can_message_heartbeat, 5U, &frame, &address, &raw) != wrong[at].reason) {
            return 1 + (int)at;
        }
    }
    memcpy(frame.data, right, 8U);
    if (!fieldscribe_can_take(&receiver, &frame) ||
        kitchen_can_beats_received(&receiver, &beats) != FIELDSCRIBE_CAN_OK || beats != 0x1234U) {
        return 20;
    }
    /* no device has that unit, though the frame is a good one */
    receiver = kitchen_can_telegram_heartbeat_listen(31U, slots);
    frame.id = 0x71FU;
    memcpy(frame.data, nobody, 8U);
    return fieldscribe_can_take(&receiver, &frame) ? 21 : 0;
}
"""


def can_wrong_bytes() -> str:
    """The program with the frames that all languages refuse alike."""
    right = ", ".join(f"0x{byte:02X}U" for byte in wrong_bytes.RIGHT)
    pairs = [
        f"{{{place}U, FIELDSCRIBE_CAN_{reason.upper()}}}"
        for reason, places in wrong_bytes.WRONG.items()
        for place in places
    ]
    return CAN_WRONG_BYTES.replace("@RIGHT@", right).replace("@WRONG@", ", ".join(pairs))


CAN_TELEGRAM = """
#include <string.h>
#include "kitchen_can_can.h"
static int taken(fieldscribe_can_receiver *receiver, uint8_t multiplexer, uint8_t pattern)
{
    fieldscribe_can_frame frame = {0x322U, 8U, {0xDDU, 0U, 0U, 0U, 0U, 0U, 0U, 0U}};
    frame.data[1] = multiplexer;
    memset(frame.data + 2, pattern, 6U);
    return fieldscribe_can_take(receiver, &frame);
}
int main(void)
{
    fieldscribe_can_slot slots[KITCHEN_CAN_TELEGRAM_MEASUREMENTS_SLOTS];
    fieldscribe_can_receiver receiver = kitchen_can_telegram_measurements_listen(2U, slots);
    uint32_t hours = 7U;
    int8_t exponent = 0;
    uint16_t word = 0U;
    if (kitchen_can_power_exponent_received(&receiver, &exponent) != FIELDSCRIBE_CAN_MISSING || exponent != 0 ||
        !taken(&receiver, 0U, 0xFEU) || taken(&receiver, KITCHEN_CAN_TELEGRAM_MEASUREMENTS_SLOTS, 0U) ||
        kitchen_can_power_exponent_received(&receiver, &exponent) != FIELDSCRIBE_CAN_OK || exponent != -2) {
        return 1;
    }
    /* a number over two frames counts once its high word came before and after its low word */
    if (!taken(&receiver, 1U, 0x01U) || !taken(&receiver, 2U, 0x02U) ||
        kitchen_can_operating_hours_received(&receiver, &hours) != FIELDSCRIBE_CAN_TORN || hours != 7U ||
        !taken(&receiver, 1U, 0x01U) ||
        kitchen_can_operating_hours_received(&receiver, &hours) != FIELDSCRIBE_CAN_OK || hours != 0x01010202U) {
        return 2;
    }
    if (fieldscribe_can_word(&receiver, KITCHEN_CAN_TELEGRAM_MEASUREMENTS_WORDS, &word) != FIELDSCRIBE_CAN_MISSING) {
        return 3;
    }
    return kitchen_can_display_received(&receiver, &word) == FIELDSCRIBE_CAN_MISSING ? 0 : 4;
}
"""

USS_DIALOGUE = """
#include <string.h>
#include "kitchen_uss_uss.h"
int main(void)
{
    static const uint8_t answer[] = {0x02, 0x0C, 0x03, 0x12, 0xBC, 0, 0, 0, 0x02, 0xFA, 0x31, 0, 0, 0x6A};
    static const uint8_t refusal[] = {0x02, 0x0C, 0x03, 0x74, 0x3A, 0, 0, 0, 0x11, 0xFA, 0x31, 0, 0, 0x99};
    const fieldscribe_uss_link link = {FIELDSCRIBE_USS_VARIABLE, 2U, false};
    const uint16_t mask[4] = {6U, 0xFFFFU, 0U, 0U};
    uint8_t frame[FIELDSCRIBE_USS_MOST];
    uint16_t words[KITCHEN_USS_TELEGRAM_TASK_WORDS];
    size_t length = 0U;
    int16_t raw = 0;
    uint16_t source = 0U;
    fieldscribe_uss_reply reply;
    fieldscribe_uss_request request = kitchen_uss_command_source_read_request(3U);
    kitchen_uss_telegram_task_start(words);
    if (words[0] != 0U || words[1] != 0U || /* no bit that makes the control word count: reading commands nothing */
        kitchen_uss_main_setpoint_encode_count(4000000, 0U, 0x42480000U, &raw) != KITCHEN_USS_OK || raw != 0x3333) {
        return 1;
    }
    kitchen_uss_control_word_to_pzd(0x007FU, words); /* the constant bit comes by itself */
    kitchen_uss_main_setpoint_to_pzd(raw, words);
    if (fieldscribe_uss_build(&kitchen_uss_uss_profile, &link, &request, words, 2U, frame, sizeof frame, &length) !=
            FIELDSCRIBE_USS_OK ||
        length != 16U ||
        memcmp(frame, "\\x02\\x0E\\x03\\x12\\xBC\\0\\0\\0\\0\\0\\0\\x04\\x7F\\x33\\x33\\xDA", 16U) != 0) {
        return 2;
    }
    if (fieldscribe_uss_build(&kitchen_uss_uss_profile, &link, &request, words, 2U, frame, 15U, &length) !=
            FIELDSCRIBE_USS_BUFFER_TOO_SMALL ||
        length != 0U) {
        return 3;
    }
    if (fieldscribe_uss_parse(&kitchen_uss_uss_profile, &link, &request, answer, sizeof answer, words, 4U, &reply) !=
            FIELDSCRIBE_USS_OK ||
        !kitchen_uss_command_source_from_reply(&reply, &source) || source != KITCHEN_USS_COMMAND_SOURCE_TERMINALS ||
        kitchen_uss_status_word_from_pzd(words) != 0xFA31U || kitchen_uss_main_actual_value_from_pzd(words) != 0) {
        return 4;
    }
    if (fieldscribe_uss_parse(&kitchen_uss_uss_profile, &link, &request, answer, sizeof answer, words, 1U, &reply) !=
        FIELDSCRIBE_USS_BUFFER_TOO_SMALL) {
        return 5;
    }
    request = kitchen_uss_maximum_frequency_write_request(3U, 0x42200000U);
    if (request.task != KITCHEN_USS_TASK_WRITE_DOUBLE_WORD ||
        fieldscribe_uss_parse(&kitchen_uss_uss_profile, &link, &request, refusal, sizeof refusal, words, 4U, &reply) !=
            FIELDSCRIBE_USS_REFUSED ||
        reply.error != KITCHEN_USS_ERROR_NOT_NOW ||
        kitchen_uss_status_word_from_pzd(words) != 0xFA31U ||
        strcmp(kitchen_uss_error_name(reply.error), "not_now") != 0) {
        return 6;
    }
    request = kitchen_uss_maximum_frequency_write_eeprom_request(3U, 0x42200000U);
    if (request.task != 13U || request.width != 2U || request.parameter != 1082U) {
        return 7;
    }
    request = kitchen_uss_baud_rate_index_1_write_eeprom_request(3U, 6U);
    if (request.task != 12U || request.index != 1U || request.width != 1U || request.value != 6U) {
        return 8;
    }
    request = kitchen_uss_reaction_write_request(3U, -5);
    reply.width = 1U;
    reply.value = 0xFFFBU;
    if (request.value != 0xFFFBU || !kitchen_uss_reaction_from_reply(&reply, &raw) || raw != -5 ||
        kitchen_uss_error_name(3U) != NULL) {
        return 9;
    }
    if (fieldscribe_uss_build_broadcast(
            &kitchen_uss_uss_profile, &link, mask, words, 2U, frame, sizeof frame, &length) != FIELDSCRIBE_USS_OK ||
        frame[2] != 0x20U || length != 16U) {
        return 10;
    }
    request = fieldscribe_uss_exchange(3U);
    return request.task == KITCHEN_USS_TASK_NO_TASK && request.unit == 3U ? 0 : 11;
}
"""

USES = {
    "can": CAN_DIALOGUE,
    "can_telegram": CAN_TELEGRAM,
    "can_wrong_bytes": can_wrong_bytes(),
    "uss": USS_DIALOGUE,
}


@pytest.mark.parametrize("standard", ["c99", "c++11"])
@pytest.mark.parametrize("compiler", COMPILERS)
@pytest.mark.parametrize("use", USES)
def test_a_dialogue(use: str, compiler: str, standard: str, folder: Path, tmp_path: Path) -> None:
    (tmp_path / "use.c").write_text(USES[use], encoding="utf-8")
    flags = (*STANDARDS[standard], "-O1", *WARNINGS, *SANITIZERS[compiler], f"-I{folder}")
    succeed([compiled(driver(compiler, standard), flags, tmp_path / "use.c", tmp_path / "use")])


DRAW = """
static uint32_t state = 1U;
static uint32_t draw(void)
{
    state = (uint32_t)(((uint64_t)state * 48271U) % 2147483647U);
    return state;
}
"""

CAN_NOISE = """
#include <stdlib.h>
#include "kitchen_can_can.h"
@DRAW@
int main(void)
{
    static const fieldscribe_can_message *const messages[] = {
        &kitchen_can_message_read_answer, &kitchen_can_message_write_request, &kitchen_can_message_heartbeat};
    fieldscribe_can_slot *const slots =
        (fieldscribe_can_slot *)malloc(KITCHEN_CAN_TELEGRAM_MEASUREMENTS_SLOTS * sizeof(fieldscribe_can_slot));
    fieldscribe_can_receiver receiver = kitchen_can_telegram_measurements_listen(1U, slots);
    unsigned round_number;
    unsigned taken = 0U;
    for (round_number = 0; round_number < 300000U; ++round_number) {
        fieldscribe_can_frame frame;
        uint16_t address;
        uint16_t raw;
        uint32_t hours;
        size_t at;
        frame.id = draw() % 4U == 0U ? draw() : 0x321U;
        frame.length = (uint8_t)(draw() % 4U == 0U ? draw() % 256U : 8U);
        for (at = 0U; at < 8U; ++at) {
            frame.data[at] = (uint8_t)(draw() & 0xFFU);
        }
        if (draw() % 2U == 0U) {
            frame.data[0] = 0xDDU;
            frame.data[1] = (uint8_t)(draw() % 8U);
        }
        (void)fieldscribe_can_parse(messages[draw() % 3U], (uint8_t)(draw() & 0xFFU), &frame, &address, &raw);
        taken += fieldscribe_can_take(&receiver, &frame) ? 1U : 0U;
        (void)kitchen_can_operating_hours_received(&receiver, &hours);
    }
    free(slots);
    return taken > 1000U ? 0 : 1;
}
"""

USS_NOISE = """
#include <stdlib.h>
#include "kitchen_uss_uss.h"
@DRAW@
int main(void)
{
    static const uint8_t lengths[] = {0U, 3U, 4U, 127U, 5U};
    unsigned round_number;
    unsigned good = 0U;
    for (round_number = 0; round_number < 300000U; ++round_number) {
        const fieldscribe_uss_link link = {lengths[draw() % 5U], (uint8_t)(draw() % 5U), draw() % 2U == 0U};
        fieldscribe_uss_request request = fieldscribe_uss_read(1U, (uint8_t)(draw() % 16U), 700U, 0U);
        const size_t length = draw() % 30U;
        uint8_t *const bytes = (uint8_t *)malloc(length + 1U);
        uint8_t *const exact = bytes + 1;
        uint16_t *const words = (uint16_t *)malloc((link.pzd + 1U) * sizeof(uint16_t));
        fieldscribe_uss_reply reply;
        size_t at;
        for (at = 0U; at < length; ++at) {
            exact[at] = (uint8_t)(draw() & 0xFFU);
        }
        if (length > 8U && draw() % 4U != 0U) { /* mostly telegrams that get far */
            exact[0] = 0x02U;
            exact[1] = (uint8_t)(length - 2U);
            exact[2] = 1U;
            exact[3] = (uint8_t)(draw() % 16U * 16U + 2U);
            exact[4] = 0xBCU;
            exact[5] = 0U;
            exact[6] = 0U;
            exact[length - 1U] = fieldscribe_uss_check(exact, length - 1U);
        }
        if (fieldscribe_uss_parse(&kitchen_uss_uss_profile, &link, &request, exact, length, words, link.pzd, &reply) ==
            FIELDSCRIBE_USS_OK) {
            ++good;
        }
        free(words);
        free(bytes);
    }
    return good > 1000U ? 0 : 1;
}
"""


@pytest.mark.parametrize("compiler", COMPILERS)
@pytest.mark.parametrize("noise", [CAN_NOISE, USS_NOISE], ids=FAMILIES)
def test_any_bytes_are_safe_to_parse(noise: str, compiler: str, folder: Path, tmp_path: Path) -> None:
    (tmp_path / "noise.c").write_text(noise.replace("@DRAW@", DRAW), encoding="utf-8")
    flags = ("-std=c99", "-O1", *WARNINGS, *SANITIZERS[compiler], f"-I{folder}")
    succeed([compiled(compiler, flags, tmp_path / "noise.c", tmp_path / "noise")])


# what no generated table holds, and no request that can be sent
STRANGE = {
    "can": """
#include "fieldscribe_can.h"
int main(void)
{
    static const fieldscribe_can_profile profile = {1U, 9U, 11U};
    static const fieldscribe_can_message message = {0x100U, false, {{FIELDSCRIBE_CAN_ADDRESS, 200U},
        {FIELDSCRIBE_CAN_RAW, 9U}, {FIELDSCRIBE_CAN_UNIT, 64U}, {FIELDSCRIBE_CAN_WORD, 0U}, {FIELDSCRIBE_CAN_WORD, 1U},
        {FIELDSCRIBE_CAN_WORD, 255U}, {FIELDSCRIBE_CAN_CONSTANT, 0U}, {FIELDSCRIBE_CAN_CONSTANT, 0U}}};
    static const fieldscribe_can_telegram none = {&profile, &message, 5U, 0U};
    static const fieldscribe_can_telegram many = {&profile, &message, 5U, 200U};
    fieldscribe_can_slot slots[2];
    fieldscribe_can_frame frame = {0x100U, 8U, {0xFFU, 0xFFU, 1U, 2U, 3U, 4U, 0U, 0U}};
    fieldscribe_can_receiver receiver = fieldscribe_can_listen(&none, 1U, slots);
    uint16_t address = 0U;
    uint16_t raw = 0U;
    if (fieldscribe_can_slots(&none) != 2U || fieldscribe_can_slots(&many) != 2U ||
        fieldscribe_can_parse(&message, 1U, &frame, &address, &raw) != FIELDSCRIBE_CAN_OK || raw != 0xFE00U) {
        return 1;
    }
    return fieldscribe_can_take(&receiver, &frame) &&
            fieldscribe_can_word(&receiver, 0U, &raw) == FIELDSCRIBE_CAN_OK && raw == 0x0203U &&
            fieldscribe_can_word(&receiver, 4U, &raw) == FIELDSCRIBE_CAN_MISSING
        ? 0
        : 2;
}
""",
    "uss": """
#include <stdlib.h>
#include <string.h>
#include "kitchen_uss_uss.h"
int main(void)
{
    static const fieldscribe_uss_link link = {1U, 0U, false}; /* one word: no device has such a parameter part */
    const fieldscribe_uss_request request = fieldscribe_uss_read(3U, 1U, 0U, 0U);
    uint8_t *const bytes = malloc(6U);
    fieldscribe_uss_reply reply;
    fieldscribe_uss_status status;
    if (bytes == NULL) {
        return 1;
    }
    memcpy(bytes, "\\x02\\x04\\x03\\x10\\x00\\x15", 6U);
    status = fieldscribe_uss_parse(&kitchen_uss_uss_profile, &link, &request, bytes, 6U, NULL, 0U, &reply);
    free(bytes);
    return status == FIELDSCRIBE_USS_WRONG_LENGTH ? 0 : 2;
}
""",
    "modbus": """
#include "fieldscribe_modbus.h"
int main(void)
{
    static const uint8_t frame[12] = {0U, 0U, 0U, 0U, 0U, 6U, 1U, 6U, 0U, 0U, 0U, 0U};
    uint16_t one[1] = {0U};
    const fieldscribe_modbus_request nothing = fieldscribe_modbus_write(1U, 0x06U, 0U, 0U, one + 1);
    fieldscribe_modbus_reply reply;
    return fieldscribe_modbus_parse(FIELDSCRIBE_MODBUS_TCP, &nothing, frame, 12U, NULL, 0U, &reply) ==
            FIELDSCRIBE_MODBUS_ECHO_MISMATCH
        ? 0
        : 1;
}
""",
}


@pytest.mark.parametrize("compiler", COMPILERS)
@pytest.mark.parametrize("family", sorted(STRANGE))
def test_strange_tables_and_requests_are_safe(family: str, compiler: str, folder: Path, tmp_path: Path) -> None:
    """Numbers that shift too far, frames of no words, links of one word, echoes of no value."""
    (tmp_path / "strange.c").write_text(STRANGE[family].replace("\\\\", "\\"), "utf-8")
    runtime = templates_dir() / "c" / "runtime"
    flags = ("-std=c99", "-g", *WARNINGS, *SANITIZERS[compiler], f"-I{folder}", f"-I{runtime}")
    succeed([compiled(compiler, flags, tmp_path / "strange.c", tmp_path / "strange")])


@pytest.mark.parametrize("family", FAMILIES)
def test_a_runtime_of_another_version_is_refused(family: str, folder: Path, tmp_path: Path) -> None:
    for path in folder.glob("*.h"):
        text = path.read_text("utf-8")
        renewed = text.replace(f"_{family.upper()}_INTERFACE 1\n", f"_{family.upper()}_INTERFACE 2\n")
        (tmp_path / path.name).write_text(renewed, encoding="utf-8")
    header = tmp_path / f"kitchen_{family}_{family}.h"
    done = run([tool("gcc"), "-std=c99", "-fsyntax-only", "-x", "c", header])
    assert done.returncode != 0
    assert "of another version" in done.stderr


CAN_FIRMWARE = """
#define FIELDSCRIBE_NO_FLOAT
#include "kitchen_can_can.h"
volatile int64_t wanted;
volatile int32_t result;
fieldscribe_can_frame frame;
fieldscribe_can_slot slots[KITCHEN_CAN_TELEGRAM_MEASUREMENTS_SLOTS];
void start(void);
void start(void)
{
    fieldscribe_can_receiver receiver = kitchen_can_telegram_measurements_listen(1U, slots);
    uint32_t hours = 0U;
    uint16_t raw = 0U;
    result = (int32_t)kitchen_can_voltage_setpoint_100v_encode_count(wanted, 400U, &raw);
    result += (int32_t)kitchen_can_voltage_setpoint_100v_write_request(1U, raw, &frame);
    result += (int32_t)fieldscribe_can_take(&receiver, &frame);
    result += (int32_t)kitchen_can_operating_hours_received(&receiver, &hours);
    for (;;) {
    }
}
"""

USS_FIRMWARE = """
#define FIELDSCRIBE_NO_FLOAT
#include "kitchen_uss_uss.h"
volatile int64_t wanted;
volatile uint32_t reference;
volatile int64_t shown;
volatile int32_t result;
uint8_t frame[FIELDSCRIBE_USS_MOST];
void start(void);
void start(void)
{
    const fieldscribe_uss_link link = {FIELDSCRIBE_USS_VARIABLE, 2U, false};
    const fieldscribe_uss_request request = kitchen_uss_maximum_frequency_read_request(1U);
    fieldscribe_uss_reply reply;
    uint16_t words[KITCHEN_USS_TELEGRAM_TASK_WORDS];
    size_t length = 0U;
    int16_t raw = 0;
    int64_t count = 0;
    kitchen_uss_telegram_task_start(words);
    result = (int32_t)kitchen_uss_main_setpoint_encode_count(wanted, 0U, reference, &raw);
    kitchen_uss_main_setpoint_to_pzd(raw, words);
    result += (int32_t)fieldscribe_uss_build(
        &kitchen_uss_uss_profile, &link, &request, words, 2U, frame, sizeof frame, &length);
    result += (int32_t)fieldscribe_uss_parse(
        &kitchen_uss_uss_profile, &link, &request, frame, length, words, 2U, &reply);
    result += (int32_t)kitchen_uss_main_actual_value_decode_count(
        kitchen_uss_main_actual_value_from_pzd(words), 0U, reference, &count);
    shown = count;
    for (;;) {
    }
}
"""


@pytest.mark.parametrize("firmware", [CAN_FIRMWARE, USS_FIRMWARE], ids=FAMILIES)
def test_cortex_m0_image_is_without_float(firmware: str, folder: Path, tmp_path: Path) -> None:
    """Frames, a factor of type f32 and limits by factors: 64-bit integers at most."""
    (tmp_path / "firmware.c").write_text(firmware, encoding="utf-8")
    flags = ("-mcpu=cortex-m0", "-mthumb", "-Os", "-std=c99", "-nostartfiles", "-Wl,-e,start", f"-I{folder}")
    image = compiled("arm-none-eabi-gcc", (*flags, *WARNINGS), tmp_path / "firmware.c", tmp_path / "firmware.elf")
    symbols = succeed([tool("arm-none-eabi-nm"), image])
    assert "start" in symbols
    assert not re.search(r"__aeabi_[df]|__[a-z]*[sd]f[0-9]", symbols)
    text = int(succeed([tool("arm-none-eabi-size"), image]).splitlines()[1].split()[0])
    print(f"Cortex-M0, -Os, a dialogue: .text {text} bytes")
    assert text <= 4096
