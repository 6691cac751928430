    static fieldscribe_can_frame frame = {0x322U, 8U, {0xDDU, 0U, 1U, 1U, 1U, 1U, 1U, 1U}};
    fieldscribe_can_slot *const slots = (fieldscribe_can_slot *)malloc(sizeof(fieldscribe_can_slot));
    fieldscribe_can_slot enough[KITCHEN_CAN_TELEGRAM_MEASUREMENTS_SLOTS];
    fieldscribe_can_receiver receiver = fieldscribe_can_listen(&kitchen_can_telegram_measurements, 2U, slots, 1U);
    uint16_t word = 9U;
    if (fieldscribe_can_take(&receiver, &frame, 0U) ||
        fieldscribe_can_word(&receiver, 0U, &word) != FIELDSCRIBE_CAN_MISSING || word != 9U) {
        return 1;
    }
    free(slots);
    receiver = fieldscribe_can_listen(&kitchen_can_telegram_measurements, 2U, enough, FIELDSCRIBE_COUNT(enough));
    if (!fieldscribe_can_take(&receiver, &frame, 0U) || fieldscribe_can_word(&receiver, 0U, &word) != FIELDSCRIBE_CAN_OK) {
        return 2;
    }
    return fieldscribe_can_received(&receiver, &kitchen_can_operating_hours_frame.heard, one, 1U) ==
                FIELDSCRIBE_CAN_BUFFER_TOO_SMALL &&
            fieldscribe_can_received_text(&receiver, &kitchen_can_display_frame.heard, one, 0U) ==
                FIELDSCRIBE_CAN_BUFFER_TOO_SMALL &&
            one[0] == 0xA5A5U
        ? 0
        : 3;
