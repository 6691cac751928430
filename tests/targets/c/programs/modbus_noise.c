#include <stdlib.h>
#define FIELDSCRIBE_IMPLEMENTATION
#include "sample_drive_modbus.h"
static uint32_t state = 1U;
static uint32_t draw(void)
{
    state = (uint32_t)(((uint64_t)state * 48271U) % 2147483647U);
    return state;
}
int main(void)
{
    static const uint8_t codes[] = {1, 2, 3, 4, 5, 6, 8, 15, 16, 43};
    const uint16_t written[1] = {1U};
    unsigned round_number;
    for (round_number = 0; round_number < 200000U; ++round_number) {
        const uint16_t count = (uint16_t)(draw() % 130U + 1U);
        const fieldscribe_modbus_reading what = {codes[draw() % 10U], 2U, count};
        const fieldscribe_modbus_writing to = {what.function, 2U, 1U};
        const fieldscribe_modbus_request request = fieldscribe_modbus_reads(what.function)
            ? fieldscribe_modbus_read(1U, &what)
            : fieldscribe_modbus_write(1U, &to, written, 1U);
        const size_t length = draw() % 24U;
        uint8_t *const bytes = (uint8_t *)malloc(length + 1U);
        uint8_t *const exact = bytes + 1;
        uint16_t *const values = (uint16_t *)malloc(count * sizeof(uint16_t));
        fieldscribe_modbus_reply reply = {values, count, 0U, 0U};
        size_t at;
        const fieldscribe_modbus_framing framing = draw() % 2U != 0U ? FIELDSCRIBE_MODBUS_RTU : FIELDSCRIBE_MODBUS_TCP;
        const size_t head = framing == FIELDSCRIBE_MODBUS_TCP ? 6U : 0U;
        for (at = 0; at < length; ++at) {
            exact[at] = (uint8_t)(draw() & 0xFFU);
        }
        if (length > head + 4U && draw() % 4U != 0U) { /* mostly frames that get far */
            exact[head] = 1U;
            exact[head + 1U] = request.function;
            exact[head + 2U] = (uint8_t)(length - head - (head != 0U ? 3U : 5U));
            if (head != 0U) {
                fieldscribe_modbus_put(exact, 0U);
                fieldscribe_modbus_put(exact + 2, 0U);
                fieldscribe_modbus_put(exact + 4, (uint16_t)(length - 6U));
            } else {
                const uint16_t crc = fieldscribe_modbus_crc(exact, length - 2U);
                exact[length - 2U] = (uint8_t)(crc & 0xFFU);
                exact[length - 1U] = (uint8_t)(crc >> 8);
            }
        }
        if (fieldscribe_modbus_left(&sample_drive_modbus_profile, framing, &request, exact, 300U, length) >
            300U - length) { /* whatever they say of their length, no more than fit */
            return 2;
        }
        if (fieldscribe_modbus_parse(framing, &request, exact, length, &reply) != FIELDSCRIBE_MODBUS_OK &&
            reply.count > 0U) {
            return 1;
        }
        free(values);
        free(bytes);
    }
    return 0;
}
