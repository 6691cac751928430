/* What a careful engineer writes: it checks unit, function, length and checksum, and gives up on noise. */
#include "exchange.h"

static const struct {
    uint16_t address;
    uint8_t count;
} blocks[2] = {{0x1001, 3}, {0x100B, 1}};

static uint8_t buffer[64];

static uint16_t crc16(const uint8_t *bytes, size_t length)
{
    static const uint16_t nibbles[16] = {0x0000, 0xCC01, 0xD801, 0x1400, 0xF001, 0x3C00, 0x2800, 0xE401, 0xA001, 0x6C00,
        0x7800, 0xB401, 0x5000, 0x9C01, 0x8801, 0x4400};
    uint16_t crc = 0xFFFF;
    while (length--) {
        crc ^= *bytes++;
        crc = (crc >> 4) ^ nibbles[crc & 15];
        crc = (crc >> 4) ^ nibbles[crc & 15];
    }
    return crc;
}

static uint16_t word(const uint8_t *bytes)
{
    return (uint16_t)(bytes[0] << 8 | bytes[1]);
}

int build(uint8_t unit, int which, uint8_t *bytes, size_t size)
{
    uint16_t crc;
    if (unit < 1 || unit > 32 || size < 8) {
        return 0;
    }
    bytes[0] = unit;
    bytes[1] = 3;
    bytes[2] = (uint8_t)(blocks[which].address >> 8);
    bytes[3] = (uint8_t)blocks[which].address;
    bytes[4] = 0;
    bytes[5] = blocks[which].count;
    crc = crc16(bytes, 6);
    bytes[6] = (uint8_t)crc;
    bytes[7] = (uint8_t)(crc >> 8);
    return 8;
}

int parse(uint8_t unit, int which, const uint8_t *bytes, size_t length, monitor *values)
{
    const uint8_t count = blocks[which].count;
    if (length < 5 || bytes[0] != unit || crc16(bytes, length) != 0) {
        return -1;
    }
    if (bytes[1] == 0x83 && length == 5) {
        return bytes[2];
    }
    if (bytes[1] != 3 || bytes[2] != 2 * count || length != 5u + bytes[2]) {
        return -2;
    }
    if (which == 0) {
        values->frequency = word(bytes + 3);
        values->current = word(bytes + 5);
        values->direction = word(bytes + 7);
    } else {
        values->voltage = word(bytes + 3);
    }
    return 0;
}

int ask(uint8_t unit, monitor *values)
{
    size_t length = 0;
    size_t whole = 5;
    const int request = build(unit, 0, buffer, sizeof buffer);
    if (!request) {
        return -3;
    }
    line_send(buffer, (size_t)request);
    while (length < whole && line_receive(&buffer[length])) {
        length++;
        if (length == 3) {
            whole = (buffer[1] & 0x80) ? 5u : 5u + buffer[2];
            if (whole > sizeof buffer) {
                return -4;
            }
        }
    }
    return length < whole ? -5 : parse(unit, 0, buffer, length, values);
}
