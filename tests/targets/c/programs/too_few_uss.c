    const fieldscribe_uss_link link = {4U, 1U, false};
    const fieldscribe_uss_words process = {one, 1U};
    const fieldscribe_uss_reply reply = {NULL, 0U, 2U, 2U, 0x12345678U, 0U};
    const fieldscribe_uss_request request =
        fieldscribe_uss_write(1U, &kitchen_uss_maximum_frequency_frame.write, one, 1U);
    uint8_t frame[FIELDSCRIBE_USS_MOST];
    size_t length = 0U;
    int16_t raw = 9;
    if (fieldscribe_uss_words_of_reply(&reply, &kitchen_uss_maximum_frequency_frame.read, one, 1U) !=
            FIELDSCRIBE_USS_BUFFER_TOO_SMALL || one[0] != 0xA5A5U) {
        return 1;
    }
    if (fieldscribe_uss_build(&kitchen_uss_uss_profile, &link, &request, &process, frame, sizeof frame, &length) !=
        FIELDSCRIBE_USS_BAD_VALUE) {
        return 2;
    }
    /* a link with one word of process data does not carry the second */
    if (fieldscribe_uss_words_heard(&kitchen_uss_main_actual_value_frame.heard, one, 1U) != NULL ||
        fieldscribe_uss_words_sent(&kitchen_uss_main_setpoint_frame.sent, one, 1U) != NULL ||
        fieldscribe_uss_words_sent(&kitchen_uss_control_word_frame.sent, one, 1U) != one) {
        return 3;
    }
    return fieldscribe_take_s16(kitchen_uss_main_actual_value_frame.layout,
               fieldscribe_uss_words_heard(&kitchen_uss_main_actual_value_frame.heard, one, 1U),
               kitchen_uss_main_actual_value_frame.heard.words, &raw) ||
            fieldscribe_put_s16(kitchen_uss_main_setpoint_frame.layout, raw,
                fieldscribe_uss_words_sent(&kitchen_uss_main_setpoint_frame.sent, one, 1U),
                kitchen_uss_main_setpoint_frame.sent.words)
        ? 4
        : 0;
