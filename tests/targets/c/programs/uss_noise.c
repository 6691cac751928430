#include <stdlib.h>
#define FIELDSCRIBE_IMPLEMENTATION
#include "kitchen_uss_uss.h"
@DRAW@
int main(void)
{
    static const uint8_t lengths[] = {0U, 3U, 4U, 127U, 5U};
    unsigned round_number;
    unsigned good = 0U;
    for (round_number = 0; round_number < 300000U; ++round_number) {
        const fieldscribe_uss_link link = {lengths[draw() % 5U], (uint8_t)(draw() % 5U), draw() % 2U == 0U};
        const fieldscribe_uss_reading what = {(uint8_t)(draw() % 16U), 700U, 0U, 1U};
        const fieldscribe_uss_request request = fieldscribe_uss_read(1U, &what);
        const size_t length = draw() % 30U;
        uint8_t *const bytes = (uint8_t *)malloc(length + 1U);
        uint8_t *const exact = bytes + 1;
        uint16_t *const words = (uint16_t *)malloc((link.pzd + 1U) * sizeof(uint16_t));
        fieldscribe_uss_reply reply = {words, link.pzd, 0U, 0U, 0U, 0U};
        size_t at;
        for (at = 0U; at < length; ++at) {
            exact[at] = (uint8_t)(draw() & 0xFFU);
        }
        if (length > 8U && draw() % 4U != 0U) { /* mostly telegrams that get far */
            exact[0] = 0x02U;
            exact[1] = (uint8_t)(length - 2U);
            exact[2] = 1U;
            exact[3] = (uint8_t)(draw() % 16U * 16U + 2U);
            exact[4] = 0xBCU;
            exact[5] = 0U;
            exact[6] = 0U;
            exact[length - 1U] = fieldscribe_uss_check(exact, length - 1U);
        }
        if (fieldscribe_uss_left(&link, exact, 999U, length) > 257U) {
            return 2;
        }
        if (fieldscribe_uss_parse(&kitchen_uss_uss_profile, &link, &request, exact, length, &reply) ==
            FIELDSCRIBE_USS_OK) {
            ++good;
        }
        free(words);
        free(bytes);
    }
    return good > 1000U ? 0 : 1;
}
