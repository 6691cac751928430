/* The same with generated headers, which recover from noise, and write, too. */
#include "exchange.h"
#define FIELDSCRIBE_IMPLEMENTATION
#include "hitachi_l200_modbus.h"

static uint8_t buffer[64];

static void send(void *context, const uint8_t *bytes, size_t length)
{
    (void)context;
    line_send(bytes, length);
}

static bool receive(void *context, uint32_t milliseconds, uint8_t *byte)
{
    (void)context;
    (void)milliseconds;
    return line_receive(byte);
}

static const fieldscribe_modbus_line line = {
    &hitachi_l200_modbus_profile, buffer, sizeof buffer, &send, &receive, NULL, 1000U, 100U};

int build(uint8_t unit, int which, uint8_t *bytes, size_t size)
{
    size_t length;
    const fieldscribe_modbus_request request =
        fieldscribe_modbus_read(unit, &hitachi_l200_monitor_d_blocks[which]);
    return (fieldscribe_modbus_build_rtu(&hitachi_l200_modbus_profile, &request, bytes, size, &length) ==
               FIELDSCRIBE_MODBUS_OK) ? (int)length : 0;
}

int parse(uint8_t unit, int which, const uint8_t *bytes, size_t length, monitor *values)
{
    uint16_t words[HITACHI_L200_BLOCK_MOST];
    hitachi_l200_monitor_d_group group;
    fieldscribe_modbus_reply reply = {words, FIELDSCRIBE_COUNT(words), 0U, 0U};
    const fieldscribe_modbus_request request =
        fieldscribe_modbus_read(unit, &hitachi_l200_monitor_d_blocks[which]);
    const fieldscribe_modbus_status status = fieldscribe_modbus_parse_rtu(&request, bytes, length, &reply);
    if (status != FIELDSCRIBE_MODBUS_OK) {
        return (status == FIELDSCRIBE_MODBUS_EXCEPTION) ? reply.exception : -1;
    }
    hitachi_l200_monitor_d_group_decode((size_t)which, words, &group);
    if (which == 0) {
        values->frequency = group.output_frequency_count;
        values->current = group.motor_current_count;
        values->direction = group.rotation_direction_raw;
    } else {
        values->voltage = group.output_voltage_count;
    }
    return 0;
}

int ask(uint8_t unit, monitor *values)
{
    uint16_t words[3];
    fieldscribe_modbus_reply reply = {words, FIELDSCRIBE_COUNT(words), 0U, 0U};
    const fieldscribe_modbus_request request = fieldscribe_modbus_read(unit, &hitachi_l200_monitor_d_blocks[0]);
    const fieldscribe_modbus_status status = fieldscribe_modbus_ask_rtu(&line, &request, &reply);
    if (status != FIELDSCRIBE_MODBUS_OK) {
        return (status == FIELDSCRIBE_MODBUS_EXCEPTION) ? reply.exception : -(int)status;
    }
    values->frequency = hitachi_l200_output_frequency_decode_count(words[0]);
    values->current = hitachi_l200_motor_current_decode_count(words[1]);
    values->direction = words[2];
    return 0;
}

#if PART == 5
#define READ_AND_WRITE(point) \
    { \
        int32_t count; \
        if (hitachi_l200_read_##point(&drive, &count) == FIELDSCRIBE_MODBUS_OK) { \
            sink = hitachi_l200_write_##point(&drive, count); \
        } \
    }

static hitachi_l200_device drive = {FIELDSCRIBE_MODBUS_UNIT(&line, &fieldscribe_modbus_ask_rtu, 5U)};
static volatile fieldscribe_modbus_status sink;
void points(void);

void points(void)
{
    READ_AND_WRITE(base_frequency)
#if POINTS > 1
    READ_AND_WRITE(motor_protection_level)
#endif
}
#endif
