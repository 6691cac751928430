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
