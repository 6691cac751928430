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
