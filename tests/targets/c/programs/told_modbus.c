    static const fieldscribe_modbus_reading two = {3U, 100U, 2U};
    static const fieldscribe_modbus_reading nine = {1U, 100U, 9U};
    static const uint8_t more[] = {1, 3, 6, 0, 1, 0, 2, 0, 3, 0xFD, 0x74};
    static const uint8_t less[] = {1, 3, 2, 0, 1, 0x79, 0x84};
    static const uint8_t bits[] = {1, 1, 1, 5, 0x91, 0x8B};
    static const uint8_t none[] = {1, 3, 0, 0x20, 0xF0};
    static const uint8_t tcp[] = {0, 0, 0, 0, 0, 5, 1, 3, 2, 0, 1};
    uint16_t words[9];
    fieldscribe_modbus_reply reply = {words, 9U, 0U, 0U};
    fieldscribe_modbus_request request = fieldscribe_modbus_read(1U, &two);
    return whole(FIELDSCRIBE_MODBUS_RTU, &request, more, 99U) == sizeof more &&
            whole(FIELDSCRIBE_MODBUS_RTU, &request, less, 99U) == sizeof less &&
            whole(FIELDSCRIBE_MODBUS_RTU, &request, none, 99U) == sizeof none &&
            whole(FIELDSCRIBE_MODBUS_RTU, &request, more, 10U) == 10U &&
            whole(FIELDSCRIBE_MODBUS_TCP, &request, tcp, 99U) == sizeof tcp &&
            fieldscribe_modbus_parse(FIELDSCRIBE_MODBUS_RTU, &request, more, sizeof more, &reply) ==
                FIELDSCRIBE_MODBUS_BAD_BYTE_COUNT &&
            fieldscribe_modbus_parse(FIELDSCRIBE_MODBUS_RTU, &request, less, sizeof less, &reply) ==
                FIELDSCRIBE_MODBUS_BAD_BYTE_COUNT &&
            fieldscribe_modbus_parse(FIELDSCRIBE_MODBUS_RTU, &request, none, sizeof none, &reply) ==
                FIELDSCRIBE_MODBUS_BAD_BYTE_COUNT &&
            fieldscribe_modbus_parse(FIELDSCRIBE_MODBUS_TCP, &request, tcp, sizeof tcp, &reply) ==
                FIELDSCRIBE_MODBUS_BAD_BYTE_COUNT &&
            (request = fieldscribe_modbus_read(1U, &nine),
                whole(FIELDSCRIBE_MODBUS_RTU, &request, bits, 99U) == sizeof bits) &&
            fieldscribe_modbus_parse(FIELDSCRIBE_MODBUS_RTU, &request, bits, sizeof bits, &reply) ==
                FIELDSCRIBE_MODBUS_BAD_BYTE_COUNT
        ? 0
        : 1;
}
