    static const fieldscribe_modbus_writing two = {0x10U, 8U, 2U};
    static const fieldscribe_modbus_writing single = {0x06U, 8U, 1U};
    const fieldscribe_modbus_profile *const profile = &kitchen_sink_modbus_profile;
    const fieldscribe_layout *const layout = kitchen_sink_plain_u32_frame.layout;
    uint8_t frame[FIELDSCRIBE_MODBUS_RTU_MOST];
    size_t length = 0U;
    uint32_t raw = 9U;
    fieldscribe_modbus_request request = fieldscribe_modbus_write(1U, &two, one, 1U);
    if (fieldscribe_take_u32(layout, one, 1U, &raw) || fieldscribe_put_u32(layout, raw, one, 1U) ||
        fieldscribe_take_u32(layout, NULL, 2U, &raw) || raw != 9U || one[0] != 0xA5A5U) {
        return 1;
    }
    if (fieldscribe_modbus_build(profile, FIELDSCRIBE_MODBUS_RTU, &request, frame, sizeof frame, &length) !=
        FIELDSCRIBE_MODBUS_BAD_COUNT) {
        return 2;
    }
    request = fieldscribe_modbus_write(1U, &single, one, 0U); /* nor is an echo held against what is not there */
    return fieldscribe_modbus_build(profile, FIELDSCRIBE_MODBUS_RTU, &request, frame, sizeof frame, &length) ==
            FIELDSCRIBE_MODBUS_BAD_COUNT
        ? 0
        : 3;
