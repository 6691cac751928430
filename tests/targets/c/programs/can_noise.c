#include <stdlib.h>
#define FIELDSCRIBE_IMPLEMENTATION
#include "kitchen_can_can.h"
@DRAW@
int main(void)
{
    static const fieldscribe_can_message *const messages[] = {
        &kitchen_can_message_read_answer, &kitchen_can_message_write_request, &kitchen_can_message_heartbeat};
    fieldscribe_can_slot *const slots =
        (fieldscribe_can_slot *)malloc(KITCHEN_CAN_TELEGRAM_MEASUREMENTS_SLOTS * sizeof(fieldscribe_can_slot));
    fieldscribe_can_receiver receiver = fieldscribe_can_listen(
        &kitchen_can_telegram_measurements, 1U, slots, KITCHEN_CAN_TELEGRAM_MEASUREMENTS_SLOTS);
    unsigned round_number;
    unsigned taken = 0U;
    unsigned torn = 0U;
    for (round_number = 0; round_number < 300000U; ++round_number) {
        fieldscribe_can_frame frame;
        uint16_t words[2];
        fieldscribe_can_content content = {0U, 0U, 0U};
        size_t at;
        frame.id = draw() % 4U == 0U ? draw() : 0x321U;
        frame.length = (uint8_t)(draw() % 4U == 0U ? draw() % 256U : 8U);
        for (at = 0U; at < 8U; ++at) {
            frame.data[at] = (uint8_t)(draw() & 0xFFU);
        }
        if (draw() % 2U == 0U) {
            frame.data[0] = 0xDDU;
            frame.data[1] = (uint8_t)(draw() % 8U);
        }
        content.unit = draw() & 0x1FFU;
        if (fieldscribe_can_parse(messages[draw() % 3U], &frame, &content) != FIELDSCRIBE_CAN_OK &&
            (content.address != 0U || content.raw != 0U)) {
            return 2;
        }
        taken += fieldscribe_can_take(&receiver, &frame, 0U) ? 1U : 0U;
        torn += fieldscribe_can_received(&receiver, &kitchen_can_operating_hours_frame.heard, words, 2U) ==
                FIELDSCRIBE_CAN_TORN
            ? 1U
            : 0U;
    }
    free(slots);
    return taken > 1000U && torn > 1000U ? 0 : 1;
}
