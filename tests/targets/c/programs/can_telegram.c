#include <string.h>
#define FIELDSCRIBE_IMPLEMENTATION
#include "kitchen_can_can.h"
static uint32_t time = UINT32_MAX - 1U;
/* Each frame comes 10 later than the one before; the clock runs over. */
static int taken(fieldscribe_can_receiver *receiver, uint8_t multiplexer, uint8_t pattern)
{
    fieldscribe_can_frame frame = {0x322U, 8U, {0xDDU, 0U, 0U, 0U, 0U, 0U, 0U, 0U}};
    frame.data[1] = multiplexer;
    memset(frame.data + 2, pattern, 6U);
    time = (uint32_t)(((uint64_t)time + 10U) & UINT32_MAX);
    return fieldscribe_can_take(receiver, &frame, time);
}
int main(void)
{
    fieldscribe_can_slot slots[KITCHEN_CAN_TELEGRAM_MEASUREMENTS_SLOTS];
    fieldscribe_can_receiver receiver = fieldscribe_can_listen(
        &kitchen_can_telegram_measurements, 2U, slots, KITCHEN_CAN_TELEGRAM_MEASUREMENTS_SLOTS);
    uint32_t hours = 7U;
    uint32_t age = 0U;
    int8_t exponent = 0;
    uint16_t words[2] = {9U, 9U};
    uint16_t text[KITCHEN_CAN_DISPLAY_WORDS];
    if (fieldscribe_can_received(&receiver, &kitchen_can_power_exponent_frame.heard, words, 2U) !=
            FIELDSCRIBE_CAN_MISSING ||
        words[0] != 9U || !taken(&receiver, 0U, 0xFEU) ||
        taken(&receiver, KITCHEN_CAN_TELEGRAM_MEASUREMENTS_SLOTS, 0U) ||
        fieldscribe_can_received(&receiver, &kitchen_can_power_exponent_frame.heard, words, 2U) !=
            FIELDSCRIBE_CAN_OK ||
        !fieldscribe_take_s8(kitchen_can_power_exponent_frame.layout, words, 2U, &exponent) || exponent != -2) {
        return 1;
    }
    /* a number over two frames counts once its high word came before and after its low word */
    words[0] = 9U;
    if (!taken(&receiver, 1U, 0x01U) || !taken(&receiver, 2U, 0x02U) ||
        fieldscribe_can_received(&receiver, &kitchen_can_operating_hours_frame.heard, words, 2U) !=
            FIELDSCRIBE_CAN_TORN ||
        words[0] != 9U || !taken(&receiver, 1U, 0x01U) ||
        fieldscribe_can_received(&receiver, &kitchen_can_operating_hours_frame.heard, words, 2U) !=
            FIELDSCRIBE_CAN_OK ||
        !fieldscribe_take_u32(kitchen_can_operating_hours_frame.layout, words, 2U, &hours) || hours != 0x01010202U) {
        return 2;
    }
    /* its low word came after the first high word, two frames ago; then one frame ago, between the two high words */
    if (fieldscribe_can_age(&receiver, &kitchen_can_operating_hours_frame.heard, time + 1U, &age) !=
            FIELDSCRIBE_CAN_OK ||
        age != 11U || !taken(&receiver, 2U, 0x03U) ||
        fieldscribe_can_age(&receiver, &kitchen_can_operating_hours_frame.heard, time, &age) != FIELDSCRIBE_CAN_OK ||
        age != 20U ||
        fieldscribe_can_age(&receiver, &kitchen_can_power_exponent_frame.heard, time, &age) != FIELDSCRIBE_CAN_OK ||
        age != 50U) {
        return 5;
    }
    if (fieldscribe_can_word(&receiver, KITCHEN_CAN_TELEGRAM_MEASUREMENTS_WORDS, words) != FIELDSCRIBE_CAN_MISSING) {
        return 3;
    }
    return fieldscribe_can_received_text(&receiver, &kitchen_can_display_frame.heard, text,
               KITCHEN_CAN_DISPLAY_WORDS) == FIELDSCRIBE_CAN_MISSING
        ? 0
        : 4;
}
