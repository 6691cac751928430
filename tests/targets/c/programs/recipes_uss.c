#define profile siemens_mm4_uss_profile
int main(void)
{
    static const fieldscribe_uss_link link = {4U, 2U, false};
    static const uint16_t sent[2] = {0U, 0U};
    static uint16_t heard[2];
    const uint8_t unit = 3U;
    uint32_t raw = 0U;
    int times;
    static const uint8_t words_come[] = {2U, 14U, 3U, 0x24U, 0x3AU, 0U, 0U, 0x42U, 0x48U, 0U, 0U, 0xFAU, 0x31U, 0U, 0U};
    for (answered = 0U; answered < sizeof words_come; ++answered) {
        answer[answered] = words_come[answered];
    }
    answer[answered] = fieldscribe_uss_check(answer, answered);
    ++answered;
    for (times = 0; times < 3; ++times) {
        fieldscribe_uss_request request;
        fieldscribe_uss_receiver receiver;
        fieldscribe_uss_status status;
        size_t length;
        uint8_t byte;
        bool fits;
        line[end] = 0xFFU;
        ++end;
        {
            @RECIPE@
            if (status != FIELDSCRIBE_USS_OK || !fits || raw != 0x42480000U) {
                return 1;
            }
        }
    }
    return 0;
}
