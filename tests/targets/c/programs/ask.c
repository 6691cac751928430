#define FIELDSCRIBE_IMPLEMENTATION
#include "kitchen_sink_modbus.h"
/* What came late for transaction 1, its end cut off, and the answer to transaction 2. */
static const uint8_t tcp[] = {0, 1, 0, 0, 0, 5, 1, 3, 2, 0, 9, 0, 1, 0, 0, 0, 5, 1, 3, 0, 2, 0, 0, 0, 5, 1, 3, 2, 1, 2};
static size_t heard;
static uint32_t waits; /* as it was told last */
static size_t sent;
static void send(void *context, const uint8_t *bytes, size_t length)
{
    (void)bytes;
    *(size_t *)context = length;
}
static bool receive(void *context, uint32_t milliseconds, uint8_t *byte)
{
    (void)context;
    waits = milliseconds;
    if (heard == sizeof tcp) {
        return false;
    }
    *byte = tcp[heard];
    ++heard;
    return true;
}
int main(void)
{
    static const fieldscribe_modbus_profile profile = {
        1U, 9U, true, true, false, 0U, 0x40U, {0U, 0U, 0U, 9U, 0U, 0U, 1U}};
    static const fieldscribe_modbus_reading what = {3U, 100U, 1U};
    static const fieldscribe_modbus_writing to_all = {6U, 100U, 1U};
    uint8_t buffer[FIELDSCRIBE_MODBUS_TCP_MOST];
    const fieldscribe_modbus_line line = {&profile, buffer, sizeof buffer, &send, &receive, &sent, 900U, 40U};
    const fieldscribe_modbus_line narrow = {&profile, buffer, 11U, &send, &receive, &sent, 900U, 40U};
    uint16_t words[2] = {0U, 0U};
    fieldscribe_modbus_reply reply = {words, 1U, 0U, 0U};
    const fieldscribe_modbus_line short_line = {&profile, buffer, 8U, &send, &receive, &sent, 900U, 40U};
    static const fieldscribe_modbus_reading two = {3U, 100U, 2U};
    fieldscribe_modbus_request request = fieldscribe_modbus_read(1U, &two);
    if (fieldscribe_modbus_ask_rtu(&line, &request, &reply) != FIELDSCRIBE_MODBUS_BUFFER_TOO_SMALL || sent != 0U) {
        return 5; /* the reply has no room */
    }
    reply.values = NULL;
    request = fieldscribe_modbus_read(1U, &what);
    if (fieldscribe_modbus_ask_tcp(&line, &request, &reply) != FIELDSCRIBE_MODBUS_BUFFER_TOO_SMALL || sent != 0U) {
        return 6;
    }
    reply.values = words;
    reply.room = 2U;
    request = fieldscribe_modbus_read(1U, &two);
    if (fieldscribe_modbus_ask_rtu(&short_line, &request, &reply) != FIELDSCRIBE_MODBUS_BUFFER_TOO_SMALL ||
        sent != 0U) {
        return 7; /* the request fits, its answer does not */
    }
    request = fieldscribe_modbus_read(1U, &what);
    request.transaction = 2U;
    if (fieldscribe_modbus_ask_tcp(&narrow, &request, &reply) != FIELDSCRIBE_MODBUS_BUFFER_TOO_SMALL || sent != 0U) {
        return 1;
    }
    if (fieldscribe_modbus_ask_tcp(&line, &request, &reply) != FIELDSCRIBE_MODBUS_OK || words[0] != 258U || sent != 12U) {
        return 2;
    }
    if (fieldscribe_modbus_ask_tcp(&line, &request, &reply) != FIELDSCRIBE_MODBUS_SHORT_FRAME || waits != 900U) {
        return 3;
    }
    heard = 0U;
    reply.count = 1U;
    reply.exception = 0x22U; /* of an earlier answer */
    request = fieldscribe_modbus_write(0U, &to_all, words, 1U);
    if (fieldscribe_modbus_ask_rtu(&short_line, &request, &reply) != FIELDSCRIBE_MODBUS_OK || sent != 8U ||
        heard != 0U || reply.count != 0U || reply.exception != 0U) {
        return 4;
    }
    return 0;
}
