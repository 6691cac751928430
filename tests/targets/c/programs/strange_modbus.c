#define FIELDSCRIBE_IMPLEMENTATION
#include "fieldscribe_modbus.h"
int main(void)
{
    static const uint8_t frame[12] = {0U, 0U, 0U, 0U, 0U, 6U, 1U, 6U, 0U, 0U, 0U, 0U};
    uint16_t one[1] = {0U};
    static const fieldscribe_modbus_writing what = {0x06U, 0U, 0U};
    const fieldscribe_modbus_request nothing = fieldscribe_modbus_write(1U, &what, one + 1, 0U);
    fieldscribe_modbus_reply reply = {NULL, 0U, 0U, 0U};
    return fieldscribe_modbus_parse(FIELDSCRIBE_MODBUS_TCP, &nothing, frame, 12U, &reply) ==
            FIELDSCRIBE_MODBUS_ECHO_MISMATCH
        ? 0
        : 1;
}
