/* Answers of Modbus devices through the parser in C. */
#define FIELDSCRIBE_IMPLEMENTATION
#include "cases.h"
#include "fieldscribe_modbus.h"

static const char *const names[] = {"ok", "out_of_range", "not_a_number", "unknown_value", "zero_factor", "no_case",
    "overflow", "special", "malformed", "bad_unit", "bad_function", "bad_count", "bad_address", "bad_value",
    "bad_framing", "buffer_too_small", "short_frame", "long_frame", "bad_crc", "bad_protocol", "wrong_transaction", "wrong_unit",
    "wrong_function", "exception", "bad_byte_count", "echo_mismatch"};

/* What is written: the number itself, or its bits one after the other to coils. */
static uint16_t value_of(uint8_t function, uint16_t number, uint16_t at)
{
    return function == 0x05U || function == 0x0FU ? (uint16_t)(number >> at % 16U & 1U) : number;
}

int main(void)
{
    for (;;) {
        fieldscribe_modbus_reply reply;
        fieldscribe_modbus_request request;
        fieldscribe_modbus_reading reading;
        fieldscribe_modbus_writing writing;
        uint16_t transaction;
        uint8_t unit;
        const fieldscribe_modbus_framing framing = take(1U) != 0U ? FIELDSCRIBE_MODBUS_TCP : FIELDSCRIBE_MODBUS_RTU;
        uint16_t number;
        uint16_t *written;
        uint16_t *values;
        uint8_t *frame;
        size_t length;
        uint16_t at;
        fieldscribe_modbus_status status;
        unit = (uint8_t)take(1U);
        reading.function = (uint8_t)take(1U);
        reading.address = (uint16_t)take(2U);
        reading.count = (uint16_t)take(2U);
        transaction = (uint16_t)take(2U);
        number = (uint16_t)take(2U);
        length = take(2U);
        frame = exactly(length);
        take_bytes(frame, length);
        written = exactly(2U * (size_t)reading.count);
        for (at = 0U; at < reading.count; ++at) {
            written[at] = value_of(reading.function, number, at);
        }
        writing.function = reading.function;
        writing.address = reading.address;
        writing.count = reading.count;
        request = reading.function <= 0x04U ? fieldscribe_modbus_read(unit, &reading)
                                            : fieldscribe_modbus_write(unit, &writing, written, reading.count);
        request.transaction = transaction;
        values = exactly(2U * (size_t)reading.count);
        reply.values = values;
        reply.room = reading.count;
        status = fieldscribe_modbus_parse(framing, &request, frame, length, &reply);
        printf("%s %u", names[status], reply.exception);
        for (at = 0U; at < reply.count; ++at) {
            printf(" %u", values[at]);
        }
        printf("\n");
        free(values);
        free(written);
        free(frame);
    }
}
