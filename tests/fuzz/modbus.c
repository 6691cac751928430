/* Answers of Modbus devices through the parser in C. */
#define FIELDSCRIBE_IMPLEMENTATION
#include "cases.h"
#include "fieldscribe_modbus.h"

static const char *const names[] = {"ok", "out_of_range", "not_a_number", "unknown_value", "zero_factor", "no_case",
    "overflow", "special", "bad_unit", "bad_function", "bad_count", "bad_address", "bad_value",
    "bad_framing", "buffer_too_small", "short_frame", "long_frame", "bad_crc", "bad_protocol", "wrong_transaction", "wrong_unit",
    "wrong_function", "exception", "bad_byte_count", "echo_mismatch"};

/* What is written: the number itself, or its bits one after the other to coils. */
static uint16_t value_of(const fieldscribe_modbus_request *request, uint16_t number, uint16_t at)
{
    return request->function == 0x05U || request->function == 0x0FU ? (uint16_t)(number >> at % 16U & 1U) : number;
}

int main(void)
{
    for (;;) {
        fieldscribe_modbus_reply reply;
        fieldscribe_modbus_request request;
        const fieldscribe_modbus_framing framing = take(1U) != 0U ? FIELDSCRIBE_MODBUS_TCP : FIELDSCRIBE_MODBUS_RTU;
        uint16_t number;
        uint16_t *written;
        uint16_t *values;
        uint8_t *frame;
        size_t length;
        uint16_t at;
        fieldscribe_modbus_status status;
        request.unit = (uint8_t)take(1U);
        request.function = (uint8_t)take(1U);
        request.address = (uint16_t)take(2U);
        request.count = (uint16_t)take(2U);
        request.transaction = (uint16_t)take(2U);
        number = (uint16_t)take(2U);
        length = take(2U);
        frame = exactly(length);
        take_bytes(frame, length);
        written = exactly(2U * (size_t)request.count);
        for (at = 0U; at < request.count; ++at) {
            written[at] = value_of(&request, number, at);
        }
        request.values = request.function <= 0x04U ? NULL : written;
        request.given = request.function <= 0x04U ? 0U : request.count;
        request.first = request.given > 0U ? written[0] : 0U;
        request.put =
            request.function > 0x04U ? &fieldscribe_modbus_put_writing : &fieldscribe_modbus_put_reading;
        request.take = request.function > 0x04U ? &fieldscribe_modbus_take_echo
            : fieldscribe_modbus_reads_bits(request.function) ? &fieldscribe_modbus_take_bits
                                                              : &fieldscribe_modbus_take_words;
        values = exactly(2U * (size_t)request.count);
        reply.values = values;
        reply.room = request.count;
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
