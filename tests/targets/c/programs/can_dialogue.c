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
        !shows(&frame, 0x33FU, "\xFF\x05\x01\xFB\x00\x00\xFE\xFE")) {
        return 1;
    }
    frame.id = 0x325U;
    memcpy(frame.data, "\xFF\x05\x01\xFB\x01\x90\xFF\x6E", 8U);
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
        !shows(&frame, 0x33FU, "\xEE\x05\x00\x0B\x2D\x00\xC3\x0E")) {
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
    if (kitchen_can_fault_text_1_encode("Hot", 3U, words) != FIELDSCRIBE_OK) {
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
