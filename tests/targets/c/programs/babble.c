#define FIELDSCRIBE_IMPLEMENTATION
#include "kitchen_sink_modbus.h"
#include "kitchen_uss_uss.h"
/* What comes again and again, or once; never more than an answer is waited for. */
static const uint8_t *said;
static size_t length;
static size_t heard;
static uint32_t waits; /* as it was told last */
static size_t most;
static size_t gap; /* after so many bytes the line is silent for a time; 0: never */
static bool silent;
static void send(void *context, const uint8_t *bytes, size_t count)
{
    (void)context;
    (void)bytes;
    (void)count;
    heard = 0U;
    silent = true;
}
static bool receive(void *context, uint32_t milliseconds, uint8_t *byte)
{
    (void)context;
    waits = milliseconds;
    if (heard == most || (gap != 0U && (heard % gap == 0U) && !silent)) {
        silent = true;
        return false;
    }
    silent = false;
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
    static const fieldscribe_modbus_profile profile = {1U, 9U, true, true, false, 0U, 0U, {0U, 0U, 0U, 9U}};
    static const fieldscribe_modbus_reading what = {3U, 100U, 1U};
    static const uint8_t good[] = {1, 3, 2, 0, 1, 0x79, 0x84};
    static const uint8_t wrong_crc[] = {1, 3, 2, 0, 1, 0x79, 0x85};
    static const uint8_t other_unit[] = {2, 3, 2, 0, 1, 0x3D, 0x84};
    static const uint8_t others[] = {2, 3, 2, 0, 1, 0x3D, 0x84, 1, 3, 2, 0, 1, 0x79, 0x84};
    static const uint8_t two_words[] = {1, 3, 4, 0, 1, 0, 2, 0x2A, 0x32};
    static const uint8_t no_words[] = {1, 3, 0, 0x20, 0xF0};
    static const uint8_t behind_noise[] = {1, 3, 200, 1, 3, 2, 0, 1, 0x79, 0x84};
    static const uint8_t tcp[] = {0, 0, 0, 0, 0, 5, 2, 3, 2, 0, 1};
    static const uint8_t long_refusal[] = {0, 0, 0, 0, 0, 4, 1, 0x83, 2, 9};
    static const uint8_t wrong_check[] = {2, 12, 3, 0x14, 0x3A, 0, 0, 0, 0, 0, 1, 0, 0, 0x23};
    static const uint8_t longer[] = {2, 14, 3, 0x14, 0x3A, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0x20};
    static const struct {
        const uint8_t *bytes;
        size_t length;
        size_t times;
        fieldscribe_modbus_status status;
        uint32_t waits;
    } rows[] = {
        {good, sizeof good, 1U, FIELDSCRIBE_MODBUS_OK, 40U},
        {good, sizeof good, 0U, FIELDSCRIBE_MODBUS_SHORT_FRAME, 900U},
        {good, 3U, 1U, FIELDSCRIBE_MODBUS_SHORT_FRAME, 40U},
        {wrong_crc, sizeof wrong_crc, 1U, FIELDSCRIBE_MODBUS_NOISE, 900U},
        {two_words, sizeof two_words, 1U, FIELDSCRIBE_MODBUS_BAD_BYTE_COUNT, 40U},
        {no_words, sizeof no_words, 1U, FIELDSCRIBE_MODBUS_BAD_BYTE_COUNT, 40U},
        {behind_noise, sizeof behind_noise, 1U, FIELDSCRIBE_MODBUS_OK, 40U},
        {behind_noise, 4U, 1U, FIELDSCRIBE_MODBUS_SHORT_FRAME, 40U},
        {other_unit, 1U, 1U, FIELDSCRIBE_MODBUS_NOISE, 900U},
        {other_unit, sizeof other_unit, 1U, FIELDSCRIBE_MODBUS_NOISE, 900U},
        {other_unit, sizeof other_unit, 1000U, FIELDSCRIBE_MODBUS_NOISE, 40U},
    };
    const fieldscribe_uss_link link = {4U, 1U, false};
    uint8_t buffer[FIELDSCRIBE_MODBUS_TCP_MOST];
    uint16_t word = 0U;
    uint16_t sent = 0U;
    const fieldscribe_modbus_line line = {&profile, buffer, sizeof buffer, &send, &receive, NULL, 900U, 40U};
    const fieldscribe_uss_line other = {
        &kitchen_uss_uss_profile, &link, buffer, sizeof buffer, &send, &receive, NULL, 900U, 40U};
    const fieldscribe_uss_words process = {&sent, 1U};
    fieldscribe_modbus_reply reply = {&word, 1U, 7U, 7U};
    fieldscribe_uss_reply answer = {&word, 1U, 0U, 0U, 0U, 0U};
    const fieldscribe_modbus_request request = fieldscribe_modbus_read(1U, &what);
    const fieldscribe_uss_request task = fieldscribe_uss_read(3U, &kitchen_uss_maximum_frequency_frame.read);
    size_t at;
    for (at = 0U; at < FIELDSCRIBE_COUNT(rows); ++at) {
        say(rows[at].bytes, rows[at].length, rows[at].times);
        if (fieldscribe_modbus_ask_rtu(&line, &request, &reply) != rows[at].status || reply.exception != 0U ||
            waits != rows[at].waits) {
            return (int)at + 1;
        }
    }
    if (heard > FIELDSCRIBE_MODBUS_ASK_MOST || heard + sizeof good < FIELDSCRIBE_MODBUS_ASK_MOST) {
        return 20;
    }
    gap = sizeof other_unit;
    say(others, sizeof others, 1U);
    if (fieldscribe_modbus_ask_rtu(&line, &request, &reply) != FIELDSCRIBE_MODBUS_OK) {
        return 28; /* an answer that comes later than noise */
    }
    say(other_unit, sizeof other_unit, 1000U);
    if (fieldscribe_modbus_ask_rtu(&line, &request, &reply) != FIELDSCRIBE_MODBUS_NOISE || heard != 14U) {
        return 29; /* others talk as long as they like */
    }
    gap = 0U;
    say(tcp, sizeof tcp, 1000U);
    if (fieldscribe_modbus_ask_tcp(&line, &request, &reply) != FIELDSCRIBE_MODBUS_NOISE ||
        heard > FIELDSCRIBE_MODBUS_ASK_MOST || heard + sizeof tcp < FIELDSCRIBE_MODBUS_ASK_MOST) {
        return 21;
    }
    say(long_refusal, sizeof long_refusal, 1U);
    if (fieldscribe_modbus_ask_tcp(&line, &request, &reply) != FIELDSCRIBE_MODBUS_LONG_FRAME) {
        return 30;
    }
    say(wrong_check, sizeof wrong_check, 1U);
    if (fieldscribe_uss_ask(&other, &task, &process, &answer) != FIELDSCRIBE_USS_NOISE) {
        return 22;
    }
    say(wrong_check, sizeof wrong_check, 1000U);
    if (fieldscribe_uss_ask(&other, &task, &process, &answer) != FIELDSCRIBE_USS_NOISE ||
        heard != FIELDSCRIBE_USS_ASK_MOST) {
        return 23;
    }
    say(wrong_check, sizeof wrong_check, 0U);
    if (fieldscribe_uss_ask(&other, &task, &process, &answer) != FIELDSCRIBE_USS_WRONG_START) {
        return 24;
    }
    answer.error = 9U; /* of an earlier answer */
    answer.room = 0U;
    heard = 7U;
    if (fieldscribe_uss_ask(&other, &task, &process, &answer) != FIELDSCRIBE_USS_BUFFER_TOO_SMALL || heard != 7U ||
        answer.error != 0U) {
        return 25; /* nothing was sent */
    }
    answer.room = 1U;
    say(longer, sizeof longer, 1U);
    if (fieldscribe_uss_ask(&other, &task, &process, &answer) != FIELDSCRIBE_USS_WRONG_LENGTH) {
        return 26;
    }
    say(longer, 15U, 1U);
    if (fieldscribe_uss_ask(&other, &task, &process, &answer) != FIELDSCRIBE_USS_WRONG_LENGTH) {
        return 27; /* it broke off */
    }
    return 0;
}
