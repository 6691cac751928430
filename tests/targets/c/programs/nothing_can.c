    static const fieldscribe_can_frame frame = {0x322U, 8U, {0xDDU, 0U, 1U, 1U, 1U, 1U, 1U, 1U}};
    static fieldscribe_can_slot slots[KITCHEN_CAN_TELEGRAM_MEASUREMENTS_SLOTS];
    fieldscribe_can_receiver receiver = fieldscribe_can_listen(&kitchen_can_telegram_measurements, 2U, NULL, 99U);
    if (fieldscribe_can_take(&receiver, &frame, 0U)) {
        return 1;
    }
    receiver = fieldscribe_can_listen(&kitchen_can_telegram_measurements, 2U, slots, FIELDSCRIBE_COUNT(slots));
    return fieldscribe_can_take(&receiver, &frame, 0U) &&
            fieldscribe_can_received(&receiver, &kitchen_can_operating_hours_frame.heard, NULL, 2U) ==
                FIELDSCRIBE_CAN_BUFFER_TOO_SMALL &&
            fieldscribe_can_received_text(&receiver, &kitchen_can_display_frame.heard, NULL, 99U) ==
                FIELDSCRIBE_CAN_BUFFER_TOO_SMALL
        ? 0
        : 2;
