#define FIELDSCRIBE_NO_FLOAT
#define FIELDSCRIBE_IMPLEMENTATION
#include "kitchen_can_can.h"
volatile int64_t wanted;
volatile int32_t result;
fieldscribe_can_frame frame;
fieldscribe_can_slot slots[KITCHEN_CAN_TELEGRAM_MEASUREMENTS_SLOTS];
void start(void);
void start(void)
{
    fieldscribe_can_receiver receiver = fieldscribe_can_listen(
        &kitchen_can_telegram_measurements, 1U, slots, KITCHEN_CAN_TELEGRAM_MEASUREMENTS_SLOTS);
    uint16_t words[2] = {0U, 0U};
    uint16_t raw = 0U;
    result = (int32_t)kitchen_can_voltage_setpoint_100v_encode_count(wanted, 400U, &raw);
    result += (int32_t)fieldscribe_put_u16(kitchen_can_voltage_setpoint_100v_frame.layout, raw, words, 2U);
    result += (int32_t)fieldscribe_can_write(
        &kitchen_can_can_dialogue, 1U, &kitchen_can_voltage_setpoint_100v_frame.write, words[0], &frame);
    result += (int32_t)fieldscribe_can_take(&receiver, &frame, 0U);
    result += (int32_t)fieldscribe_can_received(&receiver, &kitchen_can_operating_hours_frame.heard, words, 2U);
    for (;;) {
    }
}
