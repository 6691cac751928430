#define FIELDSCRIBE_NO_FLOAT
#define FIELDSCRIBE_IMPLEMENTATION
#include "kitchen_sink_modbus.h"
uint8_t buffer[FIELDSCRIBE_MODBUS_RTU_MOST];
volatile size_t heard;
volatile uint32_t shown;
void start(void);
void start(void)
{
    uint16_t words[2];
    uint32_t raw = 0U;
    size_t length = 0U;
    fieldscribe_modbus_reply reply = {words, 2U, 0U, 0U};
    const fieldscribe_modbus_request request = fieldscribe_modbus_read(1U, &kitchen_sink_plain_u32_frame.read);
    if (fieldscribe_modbus_build(&kitchen_sink_modbus_profile, FIELDSCRIBE_MODBUS_RTU, &request, buffer,
            sizeof buffer, &length) == FIELDSCRIBE_MODBUS_OK &&
        fieldscribe_modbus_parse(FIELDSCRIBE_MODBUS_RTU, &request, buffer, heard, &reply) == FIELDSCRIBE_MODBUS_OK &&
        fieldscribe_take_u32(kitchen_sink_plain_u32_frame.layout, words, reply.count, &raw)) {
        shown = raw;
    }
    for (;;) {
    }
}
