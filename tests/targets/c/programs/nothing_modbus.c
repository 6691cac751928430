    static const fieldscribe_modbus_reading two = {3U, 8U, 2U};
    static const fieldscribe_modbus_reading one_bit = {1U, 8U, 1U};
    static const fieldscribe_modbus_writing one = {6U, 8U, 1U};
    static const fieldscribe_modbus_writing several = {16U, 8U, 2U};
    static const uint8_t words_come[] = {1, 3, 4, 0, 1, 0, 2, 0x2A, 0x32};
    static const uint8_t bits_come[] = {1, 1, 1, 1, 0x90, 0x48};
    static const uint16_t where[2] = {8U, 9U};
    const fieldscribe_text text = {where, 8U, 2U};
    const fieldscribe_modbus_profile *const profile = &kitchen_sink_modbus_profile;
    fieldscribe_modbus_request request = fieldscribe_modbus_write(1U, &one, NULL, 1U);
    fieldscribe_modbus_reply reply = {NULL, 9U, 0U, 0U};
    uint8_t bytes[FIELDSCRIBE_MODBUS_RTU_MOST];
    uint16_t words[2] = {0U, 0U};
    uint16_t raw;
    int64_t wide;
    size_t length;
    if (fieldscribe_modbus_build(profile, FIELDSCRIBE_MODBUS_RTU, &request, bytes, sizeof bytes, &length) !=
        FIELDSCRIBE_MODBUS_BAD_COUNT) {
        return 1;
    }
    request = fieldscribe_modbus_write(1U, &several, NULL, 2U);
    if (fieldscribe_modbus_build(profile, FIELDSCRIBE_MODBUS_RTU, &request, bytes, sizeof bytes, &length) !=
        FIELDSCRIBE_MODBUS_BAD_COUNT) {
        return 2;
    }
    request = fieldscribe_modbus_read(1U, &two);
    if (fieldscribe_modbus_parse(FIELDSCRIBE_MODBUS_RTU, &request, words_come, sizeof words_come, &reply) !=
        FIELDSCRIBE_MODBUS_BUFFER_TOO_SMALL) {
        return 3;
    }
    reply.count = 2U;
    if (fieldscribe_modbus_words_in(&request, &reply, &two) != NULL) {
        return 4;
    }
    request = fieldscribe_modbus_read(1U, &one_bit);
    if (fieldscribe_modbus_parse(FIELDSCRIBE_MODBUS_RTU, &request, bits_come, sizeof bits_come, &reply) !=
        FIELDSCRIBE_MODBUS_BUFFER_TOO_SMALL) {
        return 5;
    }
    request = fieldscribe_modbus_write(1U, &one, words, 1U);
    if (fieldscribe_modbus_build(profile, FIELDSCRIBE_MODBUS_RTU, &request, bytes, sizeof bytes, &length) !=
            FIELDSCRIBE_MODBUS_OK ||
        fieldscribe_modbus_parse(FIELDSCRIBE_MODBUS_RTU, &request, bytes, length, &reply) != FIELDSCRIBE_MODBUS_OK ||
        reply.count != 0U) {
        return 6;
    }
    return fieldscribe_take_u16(NULL, words, 2U, &raw) || fieldscribe_take_s64(NULL, words, 2U, &wide) ||
            fieldscribe_put_s64(NULL, 1, words, 2U) || fieldscribe_take_text(NULL, words, 2U, words, 2U) ||
            fieldscribe_put_text(NULL, words, 2U, words, 2U) || fieldscribe_put_u16(NULL, 1U, words, 2U) ||
            fieldscribe_take_text(&text, NULL, 2U, words, 2U) || fieldscribe_take_text(&text, words, 2U, NULL, 2U) ||
            fieldscribe_put_text(&text, NULL, 2U, words, 2U) || fieldscribe_put_text(&text, words, 2U, NULL, 2U)
        ? 7
        : 0;
