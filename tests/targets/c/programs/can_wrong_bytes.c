#include <string.h>
#define FIELDSCRIBE_IMPLEMENTATION
#include "kitchen_can_can.h"
static const uint8_t right[8] = {@RIGHT@};
static const struct {
    unsigned place;
    fieldscribe_can_status reason;
} wrong[] = {@WRONG@};
int main(void)
{
    fieldscribe_can_frame frame = {0x705U, 8U, {0U}};
    fieldscribe_can_slot slots[KITCHEN_CAN_TELEGRAM_HEARTBEAT_SLOTS];
    fieldscribe_can_receiver receiver = fieldscribe_can_listen(
        &kitchen_can_telegram_heartbeat, 5U, slots, KITCHEN_CAN_TELEGRAM_HEARTBEAT_SLOTS);
    const uint8_t nobody[8] = {5U, 31U, 0U, 0U, 0U, 0U, 5U, 31U};
    uint16_t beats = 0U;
    fieldscribe_can_content content = {5U, 0U, 0U};
    size_t at;
    for (at = 0U; at < sizeof wrong / sizeof wrong[0]; ++at) {
        memcpy(frame.data, right, 8U);
        frame.data[wrong[at].place] = (uint8_t)(frame.data[wrong[at].place] ^ 0x20U);
        if (fieldscribe_can_take(&receiver, &frame, 0U) ||
            fieldscribe_can_parse(&kitchen_can_message_heartbeat, &frame, &content) != wrong[at].reason) {
            return 1 + (int)at;
        }
    }
    memcpy(frame.data, right, 8U);
    if (!fieldscribe_can_take(&receiver, &frame, 0U) ||
        fieldscribe_can_received(&receiver, &kitchen_can_beats_frame.heard, &beats, 1U) != FIELDSCRIBE_CAN_OK ||
        beats != 0x1234U) {
        return 20;
    }
    /* no device has that unit, though the frame is a good one */
    receiver = fieldscribe_can_listen(
        &kitchen_can_telegram_heartbeat, 31U, slots, KITCHEN_CAN_TELEGRAM_HEARTBEAT_SLOTS);
    frame.id = 0x71FU;
    memcpy(frame.data, nobody, 8U);
    return fieldscribe_can_take(&receiver, &frame, 0U) ? 21 : 0;
}
