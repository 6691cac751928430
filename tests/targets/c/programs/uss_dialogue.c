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
    if (kitchen_uss_main_setpoint_encode_count(4000000, &setpoint, &raw) != FIELDSCRIBE_OK || raw != 0x3333) {
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
        memcmp(frame, "\x02\x0E\x03\x12\xBC\0\0\0\0\0\0\x04\x7F\x33\x33\xDA", 16U) != 0) {
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
