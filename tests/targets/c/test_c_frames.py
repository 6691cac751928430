"""Generated C of frames as firmware uses it: requests, answers, telegrams, and any bytes at all."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import TYPE_CHECKING

import pytest
from fieldscribe.render import render
from fieldscribe.resources import templates_dir
from fieldscribe.targets import c
from support import wrong_bytes
from support.c_device import SANITIZERS, SANITIZING, STANDARDS, WARNINGS, driver, write_headers
from support.described import made, shipped
from support.models import changed
from support.toolchains import compiled, run, succeed, tool

if TYPE_CHECKING:
    from pathlib import Path

    from fieldscribe.model import Point

FAMILIES = ("can", "uss")
KITCHENS = ("kitchen_sink", "kitchen_can", "kitchen_uss")
COMPILERS = ("gcc", "clang")


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The headers of a kitchen of each family, side by side."""
    out = tmp_path_factory.mktemp("kitchens")
    for name in KITCHENS:
        write_headers(made(name), out)
    return out / "c"


CAN_DIALOGUE = """
#include <string.h>
#define FIELDSCRIBE_IMPLEMENTATION
#include "kitchen_can_can.h"
static const fieldscribe_can_dialogue *const talk = &kitchen_can_can_dialogue;
static int shows(const fieldscribe_can_frame *frame, uint32_t id, const char *bytes)
{
    return frame->id == id && frame->length == 8U && memcmp(frame->data, bytes, 8U) == 0;
}
int main(void)
{
    fieldscribe_can_frame frame = {0U, 0U, {0U}};
    uint16_t raw = 0U;
    uint16_t word = 0xFFFFU;
    uint16_t words[KITCHEN_CAN_FAULT_TEXT_1_WORDS] = {0U};
    char text[KITCHEN_CAN_FAULT_TEXT_1_CHARACTERS + 1U];
    uint16_t digits[KITCHEN_CAN_INPUT_DELAYS_DIGITS];
    fieldscribe_can_reading read_one;
    fieldscribe_can_writing write_one;
    size_t at;
    if (fieldscribe_can_read(talk, 5U, &kitchen_can_transformer_secondary_frame.read, &frame) != FIELDSCRIBE_CAN_OK ||
        !shows(&frame, 0x33FU, "\\xFF\\x05\\x01\\xFB\\x00\\x00\\xFE\\xFE")) {
        return 1;
    }
    frame.id = 0x325U;
    memcpy(frame.data, "\\xFF\\x05\\x01\\xFB\\x01\\x90\\xFF\\x6E", 8U);
    if (fieldscribe_can_id(talk->read_answer, 5U) != 0x325U || fieldscribe_can_reply_length(talk->read_answer) != 8U ||
        fieldscribe_can_reply_length(NULL) != 0U ||
        fieldscribe_can_read_answer(talk, 5U, &kitchen_can_transformer_secondary_frame.read, &frame, &word) !=
            FIELDSCRIBE_CAN_OK ||
        !fieldscribe_take_u16(kitchen_can_transformer_secondary_frame.layout, &word, 1U, &raw) || raw != 400U ||
        fieldscribe_can_read_answer(talk, 5U, &kitchen_can_voltage_limit_frame.read, &frame, &word) !=
            FIELDSCRIBE_CAN_WRONG_ADDRESS ||
        word != 400U ||
        fieldscribe_can_read_answer(talk, 6U, &kitchen_can_transformer_secondary_frame.read, &frame, &word) !=
            FIELDSCRIBE_CAN_WRONG_ID) {
        return 2;
    }
    if (!fieldscribe_put_u16(kitchen_can_frequency_setpoint_frame.layout, 0x2D00U, &word, 1U) ||
        fieldscribe_can_write(talk, 5U, &kitchen_can_frequency_setpoint_frame.write, word, &frame) !=
            FIELDSCRIBE_CAN_OK ||
        !shows(&frame, 0x33FU, "\\xEE\\x05\\x00\\x0B\\x2D\\x00\\xC3\\x0E")) {
        return 3;
    }
    frame.id = 0x325U;
    raw = 0x2D01U;
    if (fieldscribe_can_write_answer(talk, 5U, &kitchen_can_frequency_setpoint_frame.write, word, &frame) !=
            FIELDSCRIBE_CAN_OK ||
        fieldscribe_can_write_answer(talk, 5U, &kitchen_can_frequency_setpoint_frame.write, raw, &frame) !=
            FIELDSCRIBE_CAN_ECHO_MISMATCH ||
        fieldscribe_can_write(talk, 31U, &kitchen_can_frequency_setpoint_frame.write, word, &frame) !=
            FIELDSCRIBE_CAN_BAD_UNIT) {
        return 4;
    }
    /* bits of a shared word, with constants beside them */
    word = 0xFFFFU;
    if (!fieldscribe_put_bit(kitchen_can_slow_ramp_frame.layout, false, &word, 1U) ||
        fieldscribe_can_write(talk, 5U, &kitchen_can_slow_ramp_frame.update, word, &frame) != FIELDSCRIBE_CAN_OK ||
        frame.data[4] != 0xFFU || frame.data[5] != 0x07U) {
        return 5;
    }
    frame.id = 0x325U;
    if (fieldscribe_can_write_answer(talk, 5U, &kitchen_can_slow_ramp_frame.update, word, &frame) !=
        FIELDSCRIBE_CAN_OK) {
        return 12;
    }
    frame.data[0] = 0xFFU;
    frame.data[6] = (uint8_t)(frame.data[6] ^ 0x11U);
    if (fieldscribe_can_read_answer(talk, 5U, &kitchen_can_slow_ramp_frame.read, &frame, &raw) != FIELDSCRIBE_CAN_OK ||
        raw != 0xFF07U) {
        return 13;
    }
    /* a text: a message for each word */
    if (kitchen_can_fault_text_1_encode("Hot", 3U, words) != KITCHEN_CAN_OK) {
        return 6;
    }
    for (at = 0U; at < KITCHEN_CAN_FAULT_TEXT_1_WORDS; ++at) {
        if (fieldscribe_can_word_to_write(&kitchen_can_fault_text_1_frame.write, at, &write_one) !=
                FIELDSCRIBE_CAN_OK ||
            fieldscribe_can_word_to_read(&kitchen_can_fault_text_1_frame.read, at, &read_one) != FIELDSCRIBE_CAN_OK ||
            fieldscribe_can_write(talk, 1U, &write_one, words[at], &frame) != FIELDSCRIBE_CAN_OK) {
            return 7;
        }
        frame.id = 0x321U;
        if (fieldscribe_can_write_answer(talk, 1U, &write_one, words[at], &frame) != FIELDSCRIBE_CAN_OK) {
            return 14;
        }
        words[at] = 0U;
        frame.data[0] = 0xFFU;
        frame.data[6] = (uint8_t)(frame.data[6] ^ 0x11U);
        if (fieldscribe_can_read_answer(talk, 1U, &read_one, &frame, &words[at]) != FIELDSCRIBE_CAN_OK) {
            return 8;
        }
    }
    if (fieldscribe_can_word_to_write(&kitchen_can_fault_text_1_frame.write, at, &write_one) !=
            FIELDSCRIBE_CAN_BAD_ADDRESS ||
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
#define FIELDSCRIBE_IMPLEMENTATION
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
    fieldscribe_can_receiver receiver = fieldscribe_can_listen(
        &kitchen_can_telegram_heartbeat, 5U, slots, KITCHEN_CAN_TELEGRAM_HEARTBEAT_SLOTS);
    const uint8_t nobody[8] = {5U, 31U, 0U, 0U, 0U, 0U, 5U, 31U};
    uint16_t beats = 0U;
    fieldscribe_can_content content = {5U, 0U, 0U};
    size_t at;
    for (at = 0U; at < sizeof wrong / sizeof wrong[0]; ++at) {
        memcpy(frame.data, right, 8U);
        frame.data[wrong[at].place] = (uint8_t)(frame.data[wrong[at].place] ^ 0x20U);
        if (fieldscribe_can_take(&receiver, &frame) ||
            fieldscribe_can_parse(&kitchen_can_message_heartbeat, &frame, &content) != wrong[at].reason) {
            return 1 + (int)at;
        }
    }
    memcpy(frame.data, right, 8U);
    if (!fieldscribe_can_take(&receiver, &frame) ||
        fieldscribe_can_received(&receiver, &kitchen_can_beats_frame.heard, &beats, 1U) != FIELDSCRIBE_CAN_OK ||
        beats != 0x1234U) {
        return 20;
    }
    /* no device has that unit, though the frame is a good one */
    receiver = fieldscribe_can_listen(
        &kitchen_can_telegram_heartbeat, 31U, slots, KITCHEN_CAN_TELEGRAM_HEARTBEAT_SLOTS);
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
#define FIELDSCRIBE_IMPLEMENTATION
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
    fieldscribe_can_receiver receiver = fieldscribe_can_listen(
        &kitchen_can_telegram_measurements, 2U, slots, KITCHEN_CAN_TELEGRAM_MEASUREMENTS_SLOTS);
    uint32_t hours = 7U;
    int8_t exponent = 0;
    uint16_t words[2] = {9U, 9U};
    uint16_t text[KITCHEN_CAN_DISPLAY_WORDS];
    if (fieldscribe_can_received(&receiver, &kitchen_can_power_exponent_frame.heard, words, 2U) !=
            FIELDSCRIBE_CAN_MISSING ||
        words[0] != 9U || !taken(&receiver, 0U, 0xFEU) ||
        taken(&receiver, KITCHEN_CAN_TELEGRAM_MEASUREMENTS_SLOTS, 0U) ||
        fieldscribe_can_received(&receiver, &kitchen_can_power_exponent_frame.heard, words, 2U) !=
            FIELDSCRIBE_CAN_OK ||
        !fieldscribe_take_s8(kitchen_can_power_exponent_frame.layout, words, 2U, &exponent) || exponent != -2) {
        return 1;
    }
    /* a number over two frames counts once its high word came before and after its low word */
    words[0] = 9U;
    if (!taken(&receiver, 1U, 0x01U) || !taken(&receiver, 2U, 0x02U) ||
        fieldscribe_can_received(&receiver, &kitchen_can_operating_hours_frame.heard, words, 2U) !=
            FIELDSCRIBE_CAN_TORN ||
        words[0] != 9U || !taken(&receiver, 1U, 0x01U) ||
        fieldscribe_can_received(&receiver, &kitchen_can_operating_hours_frame.heard, words, 2U) !=
            FIELDSCRIBE_CAN_OK ||
        !fieldscribe_take_u32(kitchen_can_operating_hours_frame.layout, words, 2U, &hours) || hours != 0x01010202U) {
        return 2;
    }
    if (fieldscribe_can_word(&receiver, KITCHEN_CAN_TELEGRAM_MEASUREMENTS_WORDS, words) != FIELDSCRIBE_CAN_MISSING) {
        return 3;
    }
    return fieldscribe_can_received_text(&receiver, &kitchen_can_display_frame.heard, text,
               KITCHEN_CAN_DISPLAY_WORDS) == FIELDSCRIBE_CAN_MISSING
        ? 0
        : 4;
}
"""

USS_DIALOGUE = """
#include <string.h>
#define FIELDSCRIBE_IMPLEMENTATION
#include "kitchen_uss_uss.h"
static const fieldscribe_uss_profile *const drive = &kitchen_uss_uss_profile;
int main(void)
{
    static const uint8_t answer[] = {0x02, 0x0C, 0x03, 0x12, 0xBC, 0, 0, 0, 0x02, 0xFA, 0x31, 0, 0, 0x6A};
    static const uint8_t refusal[] = {0x02, 0x0C, 0x03, 0x74, 0x3A, 0, 0, 0, 0x11, 0xFA, 0x31, 0, 0, 0x99};
    const fieldscribe_uss_link link = {FIELDSCRIBE_USS_VARIABLE, 2U, false};
    const uint16_t mask[4] = {6U, 0xFFFFU, 0U, 0U};
    uint8_t frame[FIELDSCRIBE_USS_MOST];
    uint16_t words[KITCHEN_USS_TELEGRAM_TASK_WORDS] = {0U}; /* no bit that makes the control word count */
    uint16_t heard[KITCHEN_USS_TELEGRAM_TASK_WORDS];
    uint16_t value[2];
    size_t length = 0U;
    int16_t raw = 0;
    uint16_t source = 0U;
    const fieldscribe_uss_words process = {words, 2U};
    fieldscribe_uss_reply reply = {heard, KITCHEN_USS_TELEGRAM_TASK_WORDS, 0U, 0U, 0U, 0U};
    fieldscribe_uss_request request = fieldscribe_uss_read(3U, &kitchen_uss_command_source_frame.read);
    const kitchen_uss_with_normalisation_and_reference_frequency setpoint = {0U, 0x42480000U};
    if (kitchen_uss_main_setpoint_encode_count(4000000, &setpoint, &raw) != KITCHEN_USS_OK || raw != 0x3333) {
        return 1;
    }
    /* the constant bit comes by itself */
    if (!fieldscribe_put_u16(kitchen_uss_control_word_frame.layout, 0x007FU,
            fieldscribe_uss_words_sent(&kitchen_uss_control_word_frame.sent, words, 2U),
            kitchen_uss_control_word_frame.sent.words) ||
        !fieldscribe_put_s16(kitchen_uss_main_setpoint_frame.layout, raw,
            fieldscribe_uss_words_sent(&kitchen_uss_main_setpoint_frame.sent, words, 2U),
            kitchen_uss_main_setpoint_frame.sent.words) ||
        fieldscribe_uss_build(drive, &link, &request, &process, frame, sizeof frame, &length) != FIELDSCRIBE_USS_OK ||
        length != 16U ||
        memcmp(frame, "\\x02\\x0E\\x03\\x12\\xBC\\0\\0\\0\\0\\0\\0\\x04\\x7F\\x33\\x33\\xDA", 16U) != 0) {
        return 2;
    }
    if (fieldscribe_uss_build(drive, &link, &request, &process, frame, 15U, &length) !=
            FIELDSCRIBE_USS_BUFFER_TOO_SMALL ||
        length != 0U) {
        return 3;
    }
    if (fieldscribe_uss_parse(drive, &link, &request, answer, sizeof answer, &reply) != FIELDSCRIBE_USS_OK ||
        fieldscribe_uss_words_of_reply(&reply, &kitchen_uss_command_source_frame.read, value, 2U) !=
            FIELDSCRIBE_USS_OK ||
        !fieldscribe_take_u16(kitchen_uss_command_source_frame.layout, value, 2U, &source) ||
        source != KITCHEN_USS_COMMAND_SOURCE_TERMINALS ||
        fieldscribe_uss_words_heard(&kitchen_uss_status_word_frame.heard, heard, 2U)[0] != 0xFA31U ||
        fieldscribe_uss_words_heard(&kitchen_uss_main_actual_value_frame.heard, heard, 2U)[0] != 0U) {
        return 4;
    }
    reply.room = 1U;
    if (fieldscribe_uss_parse(drive, &link, &request, answer, sizeof answer, &reply) !=
        FIELDSCRIBE_USS_BUFFER_TOO_SMALL) {
        return 5;
    }
    reply.room = KITCHEN_USS_TELEGRAM_TASK_WORDS;
    if (!fieldscribe_put_u32(kitchen_uss_maximum_frequency_frame.layout, 0x42200000U, value, 2U)) {
        return 6;
    }
    request = fieldscribe_uss_write(3U, &kitchen_uss_maximum_frequency_frame.write, value, 2U);
    if (request.task != KITCHEN_USS_TASK_WRITE_DOUBLE_WORD || request.value != 0x42200000U ||
        fieldscribe_uss_parse(drive, &link, &request, refusal, sizeof refusal, &reply) != FIELDSCRIBE_USS_REFUSED ||
        reply.error != KITCHEN_USS_ERROR_NOT_NOW || heard[0] != 0xFA31U ||
        strcmp(kitchen_uss_error_name(reply.error), "not_now") != 0) {
        return 7;
    }
    request = fieldscribe_uss_write(3U, &kitchen_uss_maximum_frequency_eeprom_frame.write, value, 2U);
    if (request.task != 13U || request.width != 2U || request.parameter != 1082U) {
        return 8;
    }
    value[0] = 6U;
    request = fieldscribe_uss_write(3U, &kitchen_uss_baud_rate_index_1_eeprom_frame.write, value, 2U);
    if (request.task != 12U || request.index != 1U || request.width != 1U || request.value != 6U) {
        return 9;
    }
    if (!fieldscribe_put_s16(kitchen_uss_reaction_frame.layout, -5, value, 2U) || value[0] != 0xFFFBU ||
        !fieldscribe_take_s16(kitchen_uss_reaction_frame.layout, value, 2U, &raw) || raw != -5 ||
        kitchen_uss_error_name(3U) != NULL) {
        return 10;
    }
    if (fieldscribe_uss_build_broadcast(drive, &link, mask, &process, frame, sizeof frame, &length) !=
            FIELDSCRIBE_USS_OK ||
        frame[2] != 0x20U || length != 16U) {
        return 11;
    }
    request = fieldscribe_uss_exchange(3U);
    return request.task == KITCHEN_USS_TASK_NO_TASK && request.unit == 3U ? 0 : 12;
}
"""

USES = {
    "can": CAN_DIALOGUE,
    "can_telegram": CAN_TELEGRAM,
    "can_wrong_bytes": can_wrong_bytes(),
    "uss": USS_DIALOGUE,
}


@pytest.mark.full(seconds=0.5)
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
#define FIELDSCRIBE_IMPLEMENTATION
#include "kitchen_can_can.h"
@DRAW@
int main(void)
{
    static const fieldscribe_can_message *const messages[] = {
        &kitchen_can_message_read_answer, &kitchen_can_message_write_request, &kitchen_can_message_heartbeat};
    fieldscribe_can_slot *const slots =
        (fieldscribe_can_slot *)malloc(KITCHEN_CAN_TELEGRAM_MEASUREMENTS_SLOTS * sizeof(fieldscribe_can_slot));
    fieldscribe_can_receiver receiver = fieldscribe_can_listen(
        &kitchen_can_telegram_measurements, 1U, slots, KITCHEN_CAN_TELEGRAM_MEASUREMENTS_SLOTS);
    unsigned round_number;
    unsigned taken = 0U;
    unsigned torn = 0U;
    for (round_number = 0; round_number < 300000U; ++round_number) {
        fieldscribe_can_frame frame;
        uint16_t words[2];
        fieldscribe_can_content content = {0U, 0U, 0U};
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
        content.unit = draw() & 0x1FFU;
        if (fieldscribe_can_parse(messages[draw() % 3U], &frame, &content) != FIELDSCRIBE_CAN_OK &&
            (content.address != 0U || content.raw != 0U)) {
            return 2;
        }
        taken += fieldscribe_can_take(&receiver, &frame) ? 1U : 0U;
        torn += fieldscribe_can_received(&receiver, &kitchen_can_operating_hours_frame.heard, words, 2U) ==
                FIELDSCRIBE_CAN_TORN
            ? 1U
            : 0U;
    }
    free(slots);
    return taken > 1000U && torn > 1000U ? 0 : 1;
}
"""

USS_NOISE = """
#include <stdlib.h>
#define FIELDSCRIBE_IMPLEMENTATION
#include "kitchen_uss_uss.h"
@DRAW@
int main(void)
{
    static const uint8_t lengths[] = {0U, 3U, 4U, 127U, 5U};
    unsigned round_number;
    unsigned good = 0U;
    for (round_number = 0; round_number < 300000U; ++round_number) {
        const fieldscribe_uss_link link = {lengths[draw() % 5U], (uint8_t)(draw() % 5U), draw() % 2U == 0U};
        const fieldscribe_uss_reading what = {(uint8_t)(draw() % 16U), 700U, 0U, 1U};
        const fieldscribe_uss_request request = fieldscribe_uss_read(1U, &what);
        const size_t length = draw() % 30U;
        uint8_t *const bytes = (uint8_t *)malloc(length + 1U);
        uint8_t *const exact = bytes + 1;
        uint16_t *const words = (uint16_t *)malloc((link.pzd + 1U) * sizeof(uint16_t));
        fieldscribe_uss_reply reply = {words, link.pzd, 0U, 0U, 0U, 0U};
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
        if (fieldscribe_uss_left(&link, exact, 999U, length) > 257U) {
            return 2;
        }
        if (fieldscribe_uss_parse(&kitchen_uss_uss_profile, &link, &request, exact, length, &reply) ==
            FIELDSCRIBE_USS_OK) {
            ++good;
        }
        free(words);
        free(bytes);
    }
    return good > 1000U ? 0 : 1;
}
"""


@pytest.mark.parametrize("compiler", SANITIZING)
@pytest.mark.parametrize("noise", [CAN_NOISE, USS_NOISE], ids=FAMILIES)
def test_any_bytes_are_safe_to_parse(noise: str, compiler: str, folder: Path, tmp_path: Path) -> None:
    (tmp_path / "noise.c").write_text(noise.replace("@DRAW@", DRAW), encoding="utf-8")
    flags = ("-std=c99", "-O1", *WARNINGS, *SANITIZERS[compiler], f"-I{folder}")
    succeed([compiled(compiler, flags, tmp_path / "noise.c", tmp_path / "noise")])


# what no generated table holds, and no request that can be sent
STRANGE = {
    "can": """
#define FIELDSCRIBE_IMPLEMENTATION
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
    fieldscribe_can_receiver receiver = fieldscribe_can_listen(&none, 1U, slots, 2U);
    fieldscribe_can_content content = {1U, 0U, 0U};
    uint16_t raw = 0U;
    if (fieldscribe_can_slots(&none) != 2U || fieldscribe_can_slots(&many) != 2U ||
        fieldscribe_can_parse(&message, &frame, &content) != FIELDSCRIBE_CAN_OK || content.raw != 0xFE00U) {
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
#define FIELDSCRIBE_IMPLEMENTATION
#include "kitchen_uss_uss.h"
int main(void)
{
    static const fieldscribe_uss_link link = {1U, 0U, false}; /* one word: no device has such a parameter part */
    static const fieldscribe_uss_reading what = {1U, 0U, 0U, 1U};
    const fieldscribe_uss_request request = fieldscribe_uss_read(3U, &what);
    uint8_t *const bytes = malloc(6U);
    fieldscribe_uss_reply reply = {NULL, 0U, 0U, 0U, 0U, 0U};
    fieldscribe_uss_status status;
    if (bytes == NULL) {
        return 1;
    }
    memcpy(bytes, "\\x02\\x04\\x03\\x10\\x00\\x15", 6U);
    status = fieldscribe_uss_parse(&kitchen_uss_uss_profile, &link, &request, bytes, 6U, &reply);
    free(bytes);
    return status == FIELDSCRIBE_USS_WRONG_LENGTH ? 0 : 2;
}
""",
    "modbus": """
#define FIELDSCRIBE_IMPLEMENTATION
#include "fieldscribe_modbus.h"
int main(void)
{
    static const uint8_t frame[12] = {0U, 0U, 0U, 0U, 0U, 6U, 1U, 6U, 0U, 0U, 0U, 0U};
    uint16_t one[1] = {0U};
    static const fieldscribe_modbus_writing what = {0x06U, 0U, 0U};
    const fieldscribe_modbus_request nothing = fieldscribe_modbus_write(1U, &what, one + 1, 0U);
    fieldscribe_modbus_reply reply = {NULL, 0U, 0U, 0U};
    return fieldscribe_modbus_parse(FIELDSCRIBE_MODBUS_TCP, &nothing, frame, 12U, &reply) ==
            FIELDSCRIBE_MODBUS_ECHO_MISMATCH
        ? 0
        : 1;
}
""",
}


@pytest.mark.parametrize("compiler", SANITIZING)
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
        renewed = re.sub(rf"(#define \w+_{family.upper()}_INTERFACE) \d+", r"\1 99", text)
        (tmp_path / path.name).write_text(renewed, encoding="utf-8")
    header = tmp_path / f"kitchen_{family}_{family}.h"
    done = run([tool("gcc"), "-std=c99", "-fsyntax-only", "-x", "c", header])
    assert done.returncode != 0
    assert "of another version" in done.stderr


SECTIONS = ("-ffunction-sections", "-fdata-sections", "-Wl,--gc-sections")
"""What leaves out functions that nobody calls."""

CAN_FIRMWARE = """
#define FIELDSCRIBE_NO_FLOAT
#define FIELDSCRIBE_IMPLEMENTATION
#include "kitchen_can_can.h"
volatile int64_t wanted;
volatile int32_t result;
fieldscribe_can_frame frame;
fieldscribe_can_slot slots[KITCHEN_CAN_TELEGRAM_MEASUREMENTS_SLOTS];
void start(void);
void start(void)
{
    fieldscribe_can_receiver receiver = fieldscribe_can_listen(
        &kitchen_can_telegram_measurements, 1U, slots, KITCHEN_CAN_TELEGRAM_MEASUREMENTS_SLOTS);
    uint16_t words[2] = {0U, 0U};
    uint16_t raw = 0U;
    result = (int32_t)kitchen_can_voltage_setpoint_100v_encode_count(wanted, 400U, &raw);
    result += (int32_t)fieldscribe_put_u16(kitchen_can_voltage_setpoint_100v_frame.layout, raw, words, 2U);
    result += (int32_t)fieldscribe_can_write(
        &kitchen_can_can_dialogue, 1U, &kitchen_can_voltage_setpoint_100v_frame.write, words[0], &frame);
    result += (int32_t)fieldscribe_can_take(&receiver, &frame);
    result += (int32_t)fieldscribe_can_received(&receiver, &kitchen_can_operating_hours_frame.heard, words, 2U);
    for (;;) {
    }
}
"""

USS_FIRMWARE = """
#define FIELDSCRIBE_NO_FLOAT
#define FIELDSCRIBE_IMPLEMENTATION
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
    const fieldscribe_uss_request request = fieldscribe_uss_read(1U, &kitchen_uss_maximum_frequency_frame.read);
    uint16_t words[KITCHEN_USS_TELEGRAM_TASK_WORDS] = {0U};
    const fieldscribe_uss_words process = {words, 2U};
    fieldscribe_uss_reply reply = {words, 2U, 0U, 0U, 0U, 0U};
    size_t length = 0U;
    int16_t raw = 0;
    int64_t count = 0;
    const kitchen_uss_with_normalisation_and_reference_frequency with = {0U, reference};
    result = (int32_t)kitchen_uss_main_setpoint_encode_count(wanted, &with, &raw);
    result += (int32_t)fieldscribe_put_s16(kitchen_uss_main_setpoint_frame.layout, raw,
        fieldscribe_uss_words_sent(&kitchen_uss_main_setpoint_frame.sent, words, 2U),
        kitchen_uss_main_setpoint_frame.sent.words);
    result += (int32_t)fieldscribe_uss_build(
        &kitchen_uss_uss_profile, &link, &request, &process, frame, sizeof frame, &length);
    result += (int32_t)fieldscribe_uss_parse(
        &kitchen_uss_uss_profile, &link, &request, frame, length, &reply);
    result += (int32_t)fieldscribe_take_s16(kitchen_uss_main_actual_value_frame.layout,
        fieldscribe_uss_words_heard(&kitchen_uss_main_actual_value_frame.heard, words, 2U),
        kitchen_uss_main_actual_value_frame.heard.words, &raw);
    result += (int32_t)kitchen_uss_main_actual_value_decode_count(raw, &with, &count);
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
    image = compiled(
        "arm-none-eabi-gcc", (*flags, *SECTIONS, *WARNINGS), tmp_path / "firmware.c", tmp_path / "firmware.elf"
    )
    symbols = succeed([tool("arm-none-eabi-nm"), image])
    assert "start" in symbols
    assert not re.search(r"__aeabi_[df]|__[a-z]*[sd]f[0-9]", symbols)
    text = int(succeed([tool("arm-none-eabi-size"), image]).splitlines()[1].split()[0])
    print(f"Cortex-M0, -Os, a dialogue: .text {text} bytes")
    assert text <= 4112


# a receiver that knows how long an answer is before it comes, byte by byte as a UART gives them
SERIAL = """
#include <string.h>
#define FIELDSCRIBE_IMPLEMENTATION
#include "kitchen_sink_modbus.h"
static const uint8_t *line;
static size_t waiting;
/* Like a driver: at most so many bytes, here one; more than were asked for would belong to the next answer. */
static size_t receive(uint8_t *bytes, size_t most)
{
    if (waiting == 0U || most == 0U) {
        return 0U;
    }
    bytes[0] = *line;
    ++line;
    --waiting;
    return 1U;
}
static size_t heard(fieldscribe_modbus_framing framing, const fieldscribe_modbus_request *request, uint8_t *frame)
{
    size_t got = 0U;
    uint32_t left = fieldscribe_modbus_left(
        &kitchen_sink_modbus_profile, framing, request, frame, FIELDSCRIBE_MODBUS_TCP_MOST, got);
    while (left > 0U && waiting > 0U) {
        got += receive(frame + got, left);
        left = fieldscribe_modbus_left(
        &kitchen_sink_modbus_profile, framing, request, frame, FIELDSCRIBE_MODBUS_TCP_MOST, got);
    }
    return got;
}
int main(void)
{
    /* an answer of four words, a refusal, and the beginning of something else, in one stream */
    static const uint8_t rtu[] = {1, 3, 4, 0, 1, 0, 2, 0x2A, 0x32, 1, 0x83, 2, 0xC0, 0xF1, 1, 3};
    static const uint8_t tcp[] = {0, 0, 0, 0, 0, 5, 1, 1, 2, 1, 1, 0, 0, 0, 0, 0, 3, 1, 0x81, 2, 9};
    static const fieldscribe_modbus_reading two_words = {3U, 100U, 2U};
    static const fieldscribe_modbus_reading nine_bits = {1U, 100U, 9U};
    static const fieldscribe_modbus_writing one_word = {6U, 100U, 1U};
    const fieldscribe_modbus_profile *const profile = &kitchen_sink_modbus_profile;
    uint16_t words[9] = {0U};
    uint8_t frame[FIELDSCRIBE_MODBUS_TCP_MOST];
    fieldscribe_modbus_reply reply = {words, 9U, 0U, 0U};
    fieldscribe_modbus_request request = fieldscribe_modbus_read(1U, &two_words);
    size_t got;
    line = rtu;
    waiting = sizeof rtu;
    got = heard(FIELDSCRIBE_MODBUS_RTU, &request, frame);
    if (got != 9U || got != fieldscribe_modbus_reply_length(profile, FIELDSCRIBE_MODBUS_RTU, &request) ||
        fieldscribe_modbus_parse(FIELDSCRIBE_MODBUS_RTU, &request, frame, got, &reply) != FIELDSCRIBE_MODBUS_OK ||
        words[1] != 2U) {
        return 1;
    }
    got = heard(FIELDSCRIBE_MODBUS_RTU, &request, frame);
    if (got != 5U || waiting != 2U ||
        fieldscribe_modbus_parse(FIELDSCRIBE_MODBUS_RTU, &request, frame, got, &reply) !=
            FIELDSCRIBE_MODBUS_EXCEPTION ||
        reply.exception != 2U) {
        return 2;
    }
    request = fieldscribe_modbus_read(1U, &nine_bits);
    line = tcp;
    waiting = sizeof tcp;
    got = heard(FIELDSCRIBE_MODBUS_TCP, &request, frame);
    if (got != 11U || got != fieldscribe_modbus_reply_length(profile, FIELDSCRIBE_MODBUS_TCP, &request) ||
        fieldscribe_modbus_parse(FIELDSCRIBE_MODBUS_TCP, &request, frame, got, &reply) != FIELDSCRIBE_MODBUS_OK ||
        words[8] != 1U) {
        return 3;
    }
    got = heard(FIELDSCRIBE_MODBUS_TCP, &request, frame);
    if (got != 9U || waiting != 1U) {
        return 4;
    }
    request = fieldscribe_modbus_write(1U, &one_word, words, 9U);
    if (fieldscribe_modbus_reply_length(profile, FIELDSCRIBE_MODBUS_RTU, &request) != 8U ||
        fieldscribe_modbus_reply_length(profile, FIELDSCRIBE_MODBUS_TCP, &request) != 12U) {
        return 5;
    }
    /* a buffer that is too small for the answer is filled, and no more */
    if (fieldscribe_modbus_left(profile, FIELDSCRIBE_MODBUS_RTU, &request, rtu, 4U, 0U) != 4U ||
        fieldscribe_modbus_left(profile, FIELDSCRIBE_MODBUS_RTU, &request, rtu, 7U, 5U) != 2U ||
        fieldscribe_modbus_left(profile, FIELDSCRIBE_MODBUS_RTU, &request, rtu, 7U, 7U) != 0U) {
        return 6;
    }
    request.unit = (uint8_t)profile->broadcast; /* to all: nobody answers */
    return profile->broadcast == 0U &&
            fieldscribe_modbus_reply_length(profile, FIELDSCRIBE_MODBUS_RTU, &request) == 0U &&
            fieldscribe_modbus_left(profile, FIELDSCRIBE_MODBUS_RTU, &request, frame, sizeof frame, 0U) == 0U &&
            fieldscribe_modbus_left(profile, FIELDSCRIBE_MODBUS_TCP, &request, frame, sizeof frame, 0U) == 0U
        ? 0
        : 7;
}
"""

SERIAL_USS = """
#define FIELDSCRIBE_IMPLEMENTATION
#include "kitchen_uss_uss.h"
int main(void)
{
    static const uint8_t answer[] = {0x02, 0x0C, 0x03, 0x12, 0xBC, 0, 0, 0, 0x02, 0xFA, 0x31, 0, 0, 0x6A};
    const fieldscribe_uss_link varies = {FIELDSCRIBE_USS_VARIABLE, 2U, false};
    const fieldscribe_uss_link fixed = {4U, 2U, false};
    const fieldscribe_uss_link none = {0U, 2U, false};
    if (fieldscribe_uss_reply_length(&varies) != 14U || fieldscribe_uss_reply_length(&fixed) != 16U ||
        fieldscribe_uss_reply_length(&none) != 8U) {
        return 1;
    }
    if (fieldscribe_uss_left(&varies, answer, 99U, 0U) != 14U ||
        fieldscribe_uss_left(&varies, answer, 99U, 2U) != 12U ||
        fieldscribe_uss_left(&varies, answer, 99U, 14U) != 0U ||
        fieldscribe_uss_left(&varies, answer, 99U, 99U) != 0U) {
        return 2;
    }
    if (fieldscribe_uss_left(&varies, answer, 13U, 2U) != 11U || fieldscribe_uss_left(&fixed, answer, 2U, 2U) != 0U) {
        return 4;
    }
    return fieldscribe_uss_left(&fixed, answer, 99U, 1U) == 15U &&
        fieldscribe_uss_left(&fixed, answer, 99U, 2U) == 12U && /* the answer says how long it is */
        fieldscribe_uss_left(&none, answer, 99U, 1U) == 7U ? 0 : 3;
}
"""


@pytest.mark.parametrize("compiler", SANITIZING)
@pytest.mark.parametrize("use", ["modbus", "uss"])
def test_a_receiver_knows_how_long_an_answer_is(use: str, compiler: str, folder: Path, tmp_path: Path) -> None:
    """It takes the bytes of one answer from a stream, and not one more."""
    (tmp_path / "serial.c").write_text(SERIAL if use == "modbus" else SERIAL_USS, "utf-8")
    flags = ("-std=c99", "-O1", *WARNINGS, *SANITIZERS[compiler], f"-I{folder}")
    succeed([compiled(compiler, flags, tmp_path / "serial.c", tmp_path / "serial")])


# words in memory that has not one more than is told: too few are refused, and nothing beyond them is touched
TOO_FEW = {
    "modbus": """
    static const fieldscribe_modbus_writing two = {0x10U, 8U, 2U};
    const fieldscribe_modbus_profile *const profile = &kitchen_sink_modbus_profile;
    const fieldscribe_layout *const layout = kitchen_sink_plain_u32_frame.layout;
    uint8_t frame[FIELDSCRIBE_MODBUS_RTU_MOST];
    size_t length = 0U;
    uint32_t raw = 9U;
    fieldscribe_modbus_request request = fieldscribe_modbus_write(1U, &two, one, 1U);
    if (fieldscribe_take_u32(layout, one, 1U, &raw) || fieldscribe_put_u32(layout, raw, one, 1U) ||
        fieldscribe_take_u32(layout, NULL, 2U, &raw) || raw != 9U || one[0] != 0xA5A5U) {
        return 1;
    }
    if (fieldscribe_modbus_build(profile, FIELDSCRIBE_MODBUS_RTU, &request, frame, sizeof frame, &length) !=
        FIELDSCRIBE_MODBUS_BAD_COUNT) {
        return 2;
    }
    request.given = 0U; /* nor is an echo held against what is not there */
    request.function = 0x06U;
    request.count = 1U;
    return fieldscribe_modbus_build(profile, FIELDSCRIBE_MODBUS_RTU, &request, frame, sizeof frame, &length) ==
            FIELDSCRIBE_MODBUS_BAD_COUNT
        ? 0
        : 3;
""",
    "uss": """
    const fieldscribe_uss_link link = {4U, 1U, false};
    const fieldscribe_uss_words process = {one, 1U};
    const fieldscribe_uss_reply reply = {NULL, 0U, 2U, 2U, 0x12345678U, 0U};
    const fieldscribe_uss_request request =
        fieldscribe_uss_write(1U, &kitchen_uss_maximum_frequency_frame.write, one, 1U);
    uint8_t frame[FIELDSCRIBE_USS_MOST];
    size_t length = 0U;
    int16_t raw = 9;
    if (fieldscribe_uss_words_of_reply(&reply, &kitchen_uss_maximum_frequency_frame.read, one, 1U) !=
            FIELDSCRIBE_USS_BUFFER_TOO_SMALL || one[0] != 0xA5A5U) {
        return 1;
    }
    if (fieldscribe_uss_build(&kitchen_uss_uss_profile, &link, &request, &process, frame, sizeof frame, &length) !=
        FIELDSCRIBE_USS_BAD_VALUE) {
        return 2;
    }
    /* a link with one word of process data does not carry the second */
    if (fieldscribe_uss_words_heard(&kitchen_uss_main_actual_value_frame.heard, one, 1U) != NULL ||
        fieldscribe_uss_words_sent(&kitchen_uss_main_setpoint_frame.sent, one, 1U) != NULL ||
        fieldscribe_uss_words_sent(&kitchen_uss_control_word_frame.sent, one, 1U) != one) {
        return 3;
    }
    return fieldscribe_take_s16(kitchen_uss_main_actual_value_frame.layout,
               fieldscribe_uss_words_heard(&kitchen_uss_main_actual_value_frame.heard, one, 1U),
               kitchen_uss_main_actual_value_frame.heard.words, &raw) ||
            fieldscribe_put_s16(kitchen_uss_main_setpoint_frame.layout, raw,
                fieldscribe_uss_words_sent(&kitchen_uss_main_setpoint_frame.sent, one, 1U),
                kitchen_uss_main_setpoint_frame.sent.words)
        ? 4
        : 0;
""",
    "can": """
    static fieldscribe_can_frame frame = {0x322U, 8U, {0xDDU, 0U, 1U, 1U, 1U, 1U, 1U, 1U}};
    fieldscribe_can_slot *const slots = (fieldscribe_can_slot *)malloc(sizeof(fieldscribe_can_slot));
    fieldscribe_can_slot enough[KITCHEN_CAN_TELEGRAM_MEASUREMENTS_SLOTS];
    fieldscribe_can_receiver receiver = fieldscribe_can_listen(&kitchen_can_telegram_measurements, 2U, slots, 1U);
    uint16_t word = 9U;
    if (fieldscribe_can_take(&receiver, &frame) ||
        fieldscribe_can_word(&receiver, 0U, &word) != FIELDSCRIBE_CAN_MISSING || word != 9U) {
        return 1;
    }
    free(slots);
    receiver = fieldscribe_can_listen(&kitchen_can_telegram_measurements, 2U, enough, FIELDSCRIBE_COUNT(enough));
    if (!fieldscribe_can_take(&receiver, &frame) || fieldscribe_can_word(&receiver, 0U, &word) != FIELDSCRIBE_CAN_OK) {
        return 2;
    }
    return fieldscribe_can_received(&receiver, &kitchen_can_operating_hours_frame.heard, one, 1U) ==
                FIELDSCRIBE_CAN_BUFFER_TOO_SMALL &&
            fieldscribe_can_received_text(&receiver, &kitchen_can_display_frame.heard, one, 0U) ==
                FIELDSCRIBE_CAN_BUFFER_TOO_SMALL &&
            one[0] == 0xA5A5U
        ? 0
        : 3;
""",
}


@pytest.mark.parametrize("compiler", SANITIZING)
@pytest.mark.parametrize("family", sorted(TOO_FEW))
def test_too_few_words_are_refused(family: str, compiler: str, folder: Path, tmp_path: Path) -> None:
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
    (tmp_path / "few.c").write_text(text, "utf-8")
    flags = ("-std=c99", "-O1", *WARNINGS, *SANITIZERS[compiler], f"-I{folder}")
    succeed([compiled(compiler, flags, tmp_path / "few.c", tmp_path / "few")])


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


BLOCK = """
#define FIELDSCRIBE_IMPLEMENTATION
#include "kitchen_sink_modbus.h"
int main(void)
{
    const fieldscribe_modbus_reading *const point = &kitchen_sink_plain_u32_frame.read;
    const fieldscribe_modbus_reading block = {point->function, (uint16_t)(point->address - 1U), 4U};
    const fieldscribe_modbus_reading other = {point->function, (uint16_t)(point->address - 1U), 3U};
    const fieldscribe_modbus_request asked = fieldscribe_modbus_read(1U, &block);
    const fieldscribe_modbus_request wrong = fieldscribe_modbus_read(1U, &other);
    const fieldscribe_modbus_reading next = {point->function, (uint16_t)(point->address + 2U), 2U};
    const fieldscribe_modbus_reading before = {point->function, (uint16_t)(point->address - 2U), 1U};
    uint16_t words[4] = {7U, 0x1234U, 0x5678U, 8U};
    fieldscribe_modbus_reply reply = {words, 4U, 4U, 0U};
    uint32_t raw = 0U;
    if (!fieldscribe_take_u32(kitchen_sink_plain_u32_frame.layout,
            fieldscribe_modbus_words_in(&asked, &reply, point), point->count, &raw) ||
        (raw != 0x12345678U && raw != 0x56781234U)) {
        return 1;
    }
    if (fieldscribe_modbus_words_in(&asked, &reply, &next) != NULL ||
        fieldscribe_modbus_words_in(&asked, &reply, &before) != NULL ||
        fieldscribe_modbus_words_in(&wrong, &reply, point) != NULL) { /* the reply is to another request */
        return 2;
    }
    reply.count = 0U; /* as after an answer that was not good */
    return fieldscribe_take_u32(kitchen_sink_plain_u32_frame.layout,
               fieldscribe_modbus_words_in(&asked, &reply, point), point->count, &raw)
        ? 3
        : 0;
}
"""


@pytest.mark.parametrize("compiler", SANITIZING)
def test_a_point_comes_out_of_a_block(compiler: str, folder: Path, tmp_path: Path) -> None:
    (tmp_path / "block.c").write_text(BLOCK, "utf-8")
    flags = ("-std=c99", "-O1", *WARNINGS, *SANITIZERS[compiler], f"-I{folder}")
    succeed([compiled(compiler, flags, tmp_path / "block.c", tmp_path / "block")])


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


RENAMED = """
#define FIELDSCRIBE_IMPLEMENTATION
#include "kitchen_uss_uss.h"
int main(void)
{
    const kitchen_uss_with_old_normalisation_and_old_reference_frequency with = {0U, 0x42480000U};
    int16_t raw = 0;
    const fieldscribe_uss_request request = fieldscribe_uss_read(3U, &kitchen_uss_old_command_source_frame.read);
    return request.parameter == kitchen_uss_command_source_frame.read.parameter &&
            kitchen_uss_old_maximum_frequency_eeprom_frame.write.parameter == 1082U &&
            kitchen_uss_old_main_setpoint_encode_count(4000000, &with, &raw) == KITCHEN_USS_OK && raw == 0x3333 &&
            kitchen_uss_old_command_source_name(KITCHEN_USS_OLD_COMMAND_SOURCE_TERMINALS) != NULL
        ? 0
        : 1;
}
"""


def renamed(point: Point) -> Point:
    """The point with an old name, which its enum had too if it is called after the point."""
    enum, was = point.enum, (f"old_{point.name}",)
    if enum is None or enum.name != point.item:
        return replace(point, was=was)
    return changed(point, was=was, enum=replace(enum, was=was))


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
                old = "OLD_" if known.isupper() else "old_"
                assert f"{known[:begin]}{old}{known[begin:]}" in names
    write_headers(device, tmp_path)
    (tmp_path / "old.c").write_text(RENAMED, "utf-8")
    flags = ("-std=c99", "-O1", *WARNINGS, f"-I{tmp_path / 'c'}")
    succeed([compiled("gcc", flags, tmp_path / "old.c", tmp_path / "old")])


USER = """
#include "kitchen_sink_modbus.h"
int user_@NUMBER@(const uint8_t *bytes, size_t length, uint8_t *frame);
int user_@NUMBER@(const uint8_t *bytes, size_t length, uint8_t *frame)
{
    uint16_t words[2];
    uint32_t raw = 0U;
    size_t used = 0U;
    fieldscribe_modbus_reply reply = {words, 2U, 0U, 0U};
    const fieldscribe_modbus_request request = fieldscribe_modbus_read(@NUMBER@U, &kitchen_sink_plain_u32_frame.read);
    if (fieldscribe_modbus_build(&kitchen_sink_modbus_profile, FIELDSCRIBE_MODBUS_RTU, &request, frame, 8U, &used) !=
            FIELDSCRIBE_MODBUS_OK ||
        fieldscribe_modbus_parse(FIELDSCRIBE_MODBUS_RTU, &request, bytes, length, &reply) != FIELDSCRIBE_MODBUS_OK ||
        !fieldscribe_take_u32(kitchen_sink_plain_u32_frame.layout, words, 2U, &raw)) {
        return 0;
    }
    return raw == 7U ? 1 : 2;
}
"""

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


@pytest.mark.parametrize("language", ["c", "c++"])
def test_many_files_share_one_definition(language: str, folder: Path, tmp_path: Path) -> None:
    flags = ("-std=c99",) if language == "c" else ("-x", "c++", "-std=c++11")
    files = users(tmp_path, 3, defined=1)
    build = [tool("g++" if language == "c++" else "gcc"), *flags, *WARNINGS, f"-I{folder}"]
    succeed([*build, "-Wno-missing-declarations", "-o", tmp_path / "one", *files])


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


ONE_POINT = """
#define FIELDSCRIBE_NO_FLOAT
#define FIELDSCRIBE_IMPLEMENTATION
#include "hitachi_l200_modbus.h"
uint8_t frame[FIELDSCRIBE_MODBUS_RTU_MOST];
volatile size_t heard;
volatile uint16_t shown;
void start(void);
static bool exchange(const fieldscribe_modbus_request *request, fieldscribe_modbus_reply *reply)
{
    const fieldscribe_modbus_profile *const profile = &hitachi_l200_modbus_profile;
    size_t length = 0U;
    return fieldscribe_modbus_build(profile, FIELDSCRIBE_MODBUS_RTU, request, frame, sizeof frame, &length) ==
            FIELDSCRIBE_MODBUS_OK &&
        fieldscribe_modbus_parse(FIELDSCRIBE_MODBUS_RTU, request, frame, heard, reply) == FIELDSCRIBE_MODBUS_OK;
}
void start(void)
{
    uint16_t words[1];
    uint16_t raw = 0U;
    fieldscribe_modbus_reply reply = {words, 1U, 0U, 0U};
    const fieldscribe_modbus_request request = fieldscribe_modbus_read(5U, &hitachi_l200_base_frequency_frame.read);
    if (exchange(&request, &reply) &&
        fieldscribe_take_u16(hitachi_l200_base_frequency_frame.layout, words, reply.count, &raw)) {
        shown = raw;
    }
    for (;;) {
    }
}
"""


def test_a_program_that_reads_registers_links_nothing_else(tmp_path: Path) -> None:
    """Requests bring what they need: neither what writes nor what reads bits is in the image."""
    device = shipped("hitachi_l200")
    write_headers(device, tmp_path)
    (tmp_path / "one.c").write_text(ONE_POINT, "utf-8")
    flags = ("-mcpu=cortex-m0", "-mthumb", "-Os", "-std=c99", "-nostartfiles", "-Wl,-e,start", f"-I{tmp_path / 'c'}")
    image = compiled("arm-none-eabi-gcc", (*flags, *SECTIONS, *WARNINGS), tmp_path / "one.c", tmp_path / "one.elf")
    symbols = succeed([tool("arm-none-eabi-nm"), image])
    assert not re.search("take_bits|take_echo|put_writing|put_values|_tcp", symbols)
    text = int(succeed([tool("arm-none-eabi-size"), image]).splitlines()[1].split()[0])
    print(f"Cortex-M0, -Os, one register read over RTU: .text {text} bytes")
    assert text <= 1000


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
    "a status is not ignored": (
        "fieldscribe_modbus_parse(FIELDSCRIBE_MODBUS_RTU, request, bytes, 8U, reply);",
        "unused-result|nodiscard|warn_unused_result",
    ),
    "whether a number fits is not ignored": (
        "fieldscribe_put_u16(kitchen_sink_ratio_frame.layout, 9U, words, 2U);",
        "unused-result|nodiscard|warn_unused_result",
    ),
}


@pytest.mark.full(seconds=0.2)
@pytest.mark.parametrize("standard", ["c99", "c++11", "c++17"])
@pytest.mark.parametrize("compiler", COMPILERS)
@pytest.mark.parametrize("misuse", MISUSE)
def test_misuse_does_not_compile(misuse: str, compiler: str, standard: str, folder: Path, tmp_path: Path) -> None:
    call, said = MISUSE[misuse]
    text = """#include "kitchen_sink_modbus.h"
void use(uint16_t *words, const uint8_t *bytes, const fieldscribe_modbus_request *request,
    fieldscribe_modbus_reply *reply);
void use(uint16_t *words, const uint8_t *bytes, const fieldscribe_modbus_request *request,
    fieldscribe_modbus_reply *reply)
{
    (void)words;
    (void)bytes;
    (void)request;
    (void)reply;
    { @CALL@ }
}
"""
    read_only = re.search(
        r"fieldscribe_modbus_r kitchen_sink_(\w+)_frame", (folder / "kitchen_sink_modbus.h").read_text()
    )
    assert read_only is not None
    words: list[str | Path] = [
        tool(driver(compiler, standard)),
        *STANDARDS[standard],
        *WARNINGS,
        f"-I{folder}",
        "-c",
        "-o",
        tmp_path / "one.o",
    ]
    (tmp_path / "right.c").write_text(text.replace("@CALL@", ""), "utf-8")
    succeed([*words, tmp_path / "right.c"])
    (tmp_path / "wrong.c").write_text(text.replace("@CALL@", call.replace("@R@", read_only[1])), "utf-8")
    done = run([*words, tmp_path / "wrong.c"])
    assert done.returncode != 0
    assert re.search(said, done.stderr)


def test_no_line_is_longer_than_a_screen(folder: Path) -> None:
    """Headers of frames, their runtimes and the conformance programs."""
    frames = [*folder.glob("kitchen_*_modbus.h"), *folder.glob("kitchen_*_can.h"), *folder.glob("kitchen_*_uss.h")]
    for path in (*frames, *folder.glob("fieldscribe*.h"), *folder.glob("conformance/*.c")):
        assert [line for line in path.read_text("utf-8").splitlines() if len(line) > 120] == [], path.name


def test_the_drive_is_small() -> None:
    """What a firmware team is asked to vendor for the frames of 236 points, and of 268."""
    for name, lines, size in (("hitachi_l200", 700, 45_000), ("woodward_mpu2s", 2000, 110_000)):
        outputs = c.outputs(shipped(name), render)
        header = next(text for path, text in outputs if path.endswith((f"{name}_modbus.h", "_can.h")))
        assert header.count("\n") <= lines
        assert len(header.encode()) <= size
