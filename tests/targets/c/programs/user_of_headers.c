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
