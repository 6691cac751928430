#define FIELDSCRIBE_NO_FLOAT
#define FIELDSCRIBE_IMPLEMENTATION
#include "kitchen_sink_modbus.h"
volatile int64_t wanted;
volatile uint32_t pattern;
volatile uint16_t word;
volatile int32_t result;
uint8_t frame[FIELDSCRIBE_MODBUS_TCP_MOST];
void start(void);
void start(void)
{
    int16_t current = 0;
    uint16_t words[2];
    size_t length = 0U;
    fieldscribe_modbus_request request;
    result = (int32_t)kitchen_sink_current_encode_count(wanted, 3000U, &current);
    result += (int32_t)kitchen_sink_plain_f32_check(pattern);
    word = kitchen_sink_ratio_insert(word, 200U);
    result += (int32_t)fieldscribe_put_u32(kitchen_sink_plain_u32_frame.layout, pattern, words, 2U);
    request = fieldscribe_modbus_write(1U, &kitchen_sink_plain_u32_frame.write, words, 2U);
    result += (int32_t)fieldscribe_modbus_build(
        &kitchen_sink_modbus_profile, FIELDSCRIBE_MODBUS_TCP, &request, frame, sizeof frame, &length);
    for (;;) {
    }
}
