    static const uint8_t more[] = {2, 14, 3, 0x14, 0x3A, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0x2C};
    static const uint8_t less[] = {2, 10, 3, 0x14, 0x3A, 0, 0, 0, 1, 0, 0, 0x24};
    const fieldscribe_uss_link fixed = {4U, 1U, false};
    const fieldscribe_uss_request request = fieldscribe_uss_read(3U, &kitchen_uss_maximum_frequency_frame.read);
    uint16_t heard[4];
    fieldscribe_uss_reply reply = {heard, 4U, 0U, 0U, 0U, 0U};
    return whole(&fixed, more) == sizeof more && whole(&fixed, less) == sizeof less &&
            fieldscribe_uss_parse(&kitchen_uss_uss_profile, &fixed, &request, more, sizeof more, &reply) ==
                FIELDSCRIBE_USS_WRONG_LENGTH &&
            fieldscribe_uss_parse(&kitchen_uss_uss_profile, &fixed, &request, less, sizeof less, &reply) ==
                FIELDSCRIBE_USS_WRONG_LENGTH &&
            fieldscribe_uss_left(&fixed, more + 1, 99U, 2U) == 12U /* noise says nothing */
        ? 0
        : 1;
}
