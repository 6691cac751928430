/* Prints what reads of d001 to d003 make of spoiled, cut and noisy answers, and of requests that the device refuses. */
#define FIELDSCRIBE_IMPLEMENTATION
#include "hitachi_l200_modbus.h"

#include <stdio.h>
#include <string.h>

static const uint8_t good[] = {5, 3, 6, 0x01, 0xF4, 0x00, 0x64, 0, 1, 0x23, 0xAE};
static uint8_t stream[64];
static size_t length;
static size_t at;

static void send(void *context, const uint8_t *bytes, size_t count)
{
    (void)context;
    (void)bytes;
    (void)count;
}

static bool receive(void *context, uint32_t milliseconds, uint8_t *byte)
{
    (void)context;
    (void)milliseconds;
    if (at >= length) {
        return false;
    }
    *byte = stream[at];
    ++at;
    return true;
}

static void tell(uint8_t unit, uint8_t function, uint16_t address, uint16_t count, size_t room)
{
    static uint8_t buffer[64];
    static uint16_t words[8];
    const fieldscribe_modbus_line line = {
        &hitachi_l200_modbus_profile, buffer, sizeof buffer, &send, &receive, NULL, 1U, 1U};
    const fieldscribe_modbus_reading what = {function, address, count};
    const fieldscribe_modbus_request request = fieldscribe_modbus_read(unit, &what);
    fieldscribe_modbus_reply reply = {words, room, 9U, 9U};
    size_t built;
    memset(words, 0, sizeof words);
    printf("%d", (int)fieldscribe_modbus_build_rtu(line.profile, &request, buffer, sizeof buffer, &built));
    printf(" %d", (int)fieldscribe_modbus_parse_rtu(&request, stream, length, &reply));
    printf(" %u %u %u", reply.count, reply.exception, words[0]);
    at = 0U;
    printf(" %d", (int)fieldscribe_modbus_ask_rtu(&line, &request, &reply));
    printf(" %u %u %u %u\n", reply.count, reply.exception, words[2], (unsigned)(built + at));
}

static void comes(size_t before, size_t count)
{
    memset(stream, 5, sizeof stream);
    memcpy(&stream[before], good, sizeof good);
    length = count;
}

int main(void)
{
    size_t place;
    unsigned value;
    for (place = 0U; place < sizeof good; ++place) {
        for (value = 0U; value < 256U; ++value) {
            comes(0U, sizeof good);
            stream[place] = (uint8_t)value;
            tell(5U, 3U, 0x1001U, 3U, 3U);
        }
        comes(0U, place);
        tell(5U, 3U, 0x1001U, 3U, 3U);
        comes(place, 11U + 2U * place);
        tell(5U, 3U, 0x1001U, 3U, 3U);
    }
    comes(0U, sizeof good);
    for (value = 0U; value < 256U; ++value) {
        tell((uint8_t)value, 3U, 0x1001U, 3U, 3U);
        tell(5U, (uint8_t)(value == 1U ? 0U : value), 0x1001U, 3U, 3U); /* coils are what a part leaves out */
        tell(5U, 3U, (uint16_t)(0xFF80U + value), 3U, value % 5U);
        tell(5U, 3U, 0x1001U, (uint16_t)value, 8U);
    }
    return 0;
}
