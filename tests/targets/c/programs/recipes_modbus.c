#define profile hitachi_l200_modbus_profile
int main(void)
{
    const uint8_t unit = 5U;
    uint16_t raw = 0U;
    uint16_t crc;
    int times;
    static const uint8_t words_come[] = {5U, 3U, 2U, 1U, 0xF4U};
    for (answered = 0U; answered < sizeof words_come; ++answered) {
        answer[answered] = words_come[answered];
    }
    crc = fieldscribe_modbus_crc(answer, answered);
    answer[answered] = (uint8_t)(crc & 0xFFU);
    answer[answered + 1U] = (uint8_t)(crc >> 8);
    answered += 2U;
    for (times = 0; times < 3; ++times) {
        fieldscribe_modbus_request request;
        fieldscribe_modbus_receiver receiver;
        fieldscribe_modbus_status status;
        size_t length;
        uint8_t byte;
        bool fits;
        line[end] = 0xFFU;
        ++end;
        {
            @RECIPE@
            if (status != FIELDSCRIBE_MODBUS_OK || !fits || raw != 500U) {
                return 1;
            }
        }
    }
    return 0;
}
