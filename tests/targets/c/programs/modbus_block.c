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
