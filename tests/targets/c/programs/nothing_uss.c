    const fieldscribe_uss_link link = {4U, 1U, false};
    const fieldscribe_uss_words process = {NULL, 1U};
    static const uint16_t sent[1] = {0U};
    const fieldscribe_uss_words full = {sent, 1U};
    static const uint16_t mask[4] = {0U, 0U, 0U, 0U};
    static const uint8_t answer[] = {2, 12, 3, 0x24, 0x3A, 0, 0, 0x42, 0x48, 0, 0, 0, 0, 0x19};
    fieldscribe_uss_request request = fieldscribe_uss_read(3U, &kitchen_uss_maximum_frequency_frame.read);
    fieldscribe_uss_reply reply = {NULL, 9U, 0U, 0U, 0U, 0U};
    uint8_t bytes[FIELDSCRIBE_USS_MOST];
    size_t length;
    const fieldscribe_uss_profile *const profile = &kitchen_uss_uss_profile;
    if (fieldscribe_uss_build(profile, &link, &request, &process, bytes, sizeof bytes, &length) !=
            FIELDSCRIBE_USS_BAD_LINK ||
        fieldscribe_uss_build_broadcast(profile, &link, mask, &process, bytes, sizeof bytes, &length) !=
            FIELDSCRIBE_USS_BAD_LINK) {
        return 1;
    }
    if (fieldscribe_uss_parse(profile, &link, &request, answer, sizeof answer, &reply) !=
        FIELDSCRIBE_USS_BUFFER_TOO_SMALL) {
        return 2;
    }
    reply.width = 2U;
    if (fieldscribe_uss_words_of_reply(&reply, &kitchen_uss_maximum_frequency_frame.read, NULL, 2U) !=
            FIELDSCRIBE_USS_BUFFER_TOO_SMALL ||
        fieldscribe_uss_words_heard(&kitchen_uss_main_actual_value_frame.heard, NULL, 2U) != NULL ||
        fieldscribe_uss_words_sent(&kitchen_uss_main_setpoint_frame.sent, NULL, 2U) != NULL) {
        return 3;
    }
    request = fieldscribe_uss_write(3U, &kitchen_uss_maximum_frequency_frame.write, NULL, 2U);
    return fieldscribe_uss_build(profile, &link, &request, &full, bytes, sizeof bytes, &length) ==
            FIELDSCRIBE_USS_BAD_VALUE
        ? 0
        : 4;
