#define FIELDSCRIBE_NO_FLOAT
#define FIELDSCRIBE_IMPLEMENTATION
#include "hitachi_l200_modbus.h"
uint8_t frame[FIELDSCRIBE_MODBUS_RTU_MOST];
volatile size_t heard;
volatile uint16_t shown;
void start(void);
static bool exchange(const fieldscribe_modbus_request *request, fieldscribe_modbus_reply *reply)
{
    const fieldscribe_modbus_profile *const profile = &hitachi_l200_modbus_profile;
    size_t length = 0U;
    return fieldscribe_modbus_build(profile, FIELDSCRIBE_MODBUS_RTU, request, frame, sizeof frame, &length) ==
            FIELDSCRIBE_MODBUS_OK &&
        fieldscribe_modbus_parse(FIELDSCRIBE_MODBUS_RTU, request, frame, heard, reply) == FIELDSCRIBE_MODBUS_OK;
}
void start(void)
{
    uint16_t words[1];
    uint16_t raw = 0U;
    fieldscribe_modbus_reply reply = {words, 1U, 0U, 0U};
    const fieldscribe_modbus_request request = fieldscribe_modbus_read(5U, &hitachi_l200_base_frequency_frame.read);
    if (exchange(&request, &reply) &&
        fieldscribe_take_u16(hitachi_l200_base_frequency_frame.layout, words, reply.count, &raw)) {
        shown = raw;
    }
    for (;;) {
    }
}
