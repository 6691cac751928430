#define FIELDSCRIBE_IMPLEMENTATION
#include "sample_drive_modbus.h"
int main(void)
{
    static const uint8_t answer[] = {0, 7, 0, 0, 0, 6, 1, 6, 0x10, 0x28, 1, 0xF4};
    const uint16_t written[1] = {500U};
    static const fieldscribe_modbus_writing what = {6U, 0x1028U, 1U};
    fieldscribe_modbus_request request = fieldscribe_modbus_write(1U, &what, written, 1U);
    fieldscribe_modbus_reply reply = {NULL, 0U, 9U, 9U};
    uint16_t value = 0U;
    request.transaction = 7U;
    if (fieldscribe_modbus_parse(FIELDSCRIBE_MODBUS_TCP, &request, answer, sizeof answer, &reply) !=
            FIELDSCRIBE_MODBUS_OK || reply.count != 0U) {
        return 1;
    }
    reply.values = &value;
    reply.room = 1U;
    if (fieldscribe_modbus_parse(FIELDSCRIBE_MODBUS_TCP, &request, answer, sizeof answer, &reply) !=
            FIELDSCRIBE_MODBUS_OK || reply.count != 1U || value != 500U) {
        return 2;
    }
    return 0;
}
