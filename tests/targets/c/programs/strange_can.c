#define FIELDSCRIBE_IMPLEMENTATION
#include "fieldscribe_can.h"
int main(void)
{
    static const fieldscribe_can_profile profile = {1U, 9U, 11U};
    static const fieldscribe_can_message message = {0x100U, false, {{FIELDSCRIBE_CAN_ADDRESS, 200U},
        {FIELDSCRIBE_CAN_RAW, 9U}, {FIELDSCRIBE_CAN_UNIT, 64U}, {FIELDSCRIBE_CAN_WORD, 0U}, {FIELDSCRIBE_CAN_WORD, 1U},
        {FIELDSCRIBE_CAN_WORD, 255U}, {FIELDSCRIBE_CAN_CONSTANT, 0U}, {FIELDSCRIBE_CAN_CONSTANT, 0U}}};
    static const fieldscribe_can_telegram none = {&profile, &message, 5U, 0U};
    static const fieldscribe_can_telegram many = {&profile, &message, 5U, 200U};
    fieldscribe_can_slot slots[2];
    fieldscribe_can_frame frame = {0x100U, 8U, {0xFFU, 0xFFU, 1U, 2U, 3U, 4U, 0U, 0U}};
    fieldscribe_can_receiver receiver = fieldscribe_can_listen(&none, 1U, slots, 2U);
    fieldscribe_can_content content = {1U, 0U, 0U};
    uint16_t raw = 0U;
    if (fieldscribe_can_slots(&none) != 2U || fieldscribe_can_slots(&many) != 2U ||
        fieldscribe_can_parse(&message, &frame, &content) != FIELDSCRIBE_CAN_OK || content.raw != 0xFE00U) {
        return 1;
    }
    return fieldscribe_can_take(&receiver, &frame, 0U) &&
            fieldscribe_can_word(&receiver, 0U, &raw) == FIELDSCRIBE_CAN_OK && raw == 0x0203U &&
            fieldscribe_can_word(&receiver, 4U, &raw) == FIELDSCRIBE_CAN_MISSING
        ? 0
        : 2;
}
