#define FIELDSCRIBE_IMPLEMENTATION
#include "kitchen_uss_uss.h"
int main(void)
{
    static const uint8_t answer[] = {0x02, 0x0C, 0x03, 0x12, 0xBC, 0, 0, 0, 0x02, 0xFA, 0x31, 0, 0, 0x6A};
    const fieldscribe_uss_link varies = {FIELDSCRIBE_USS_VARIABLE, 2U, false};
    const fieldscribe_uss_link fixed = {4U, 2U, false};
    const fieldscribe_uss_link none = {0U, 2U, false};
    if (fieldscribe_uss_reply_length(&varies) != 14U || fieldscribe_uss_reply_length(&fixed) != 16U ||
        fieldscribe_uss_reply_length(&none) != 8U) {
        return 1;
    }
    if (fieldscribe_uss_left(&varies, answer, 99U, 0U) != 14U ||
        fieldscribe_uss_left(&varies, answer, 99U, 2U) != 12U ||
        fieldscribe_uss_left(&varies, answer, 99U, 14U) != 0U ||
        fieldscribe_uss_left(&varies, answer, 99U, 99U) != 0U) {
        return 2;
    }
    if (fieldscribe_uss_left(&varies, answer, 13U, 2U) != 11U || fieldscribe_uss_left(&fixed, answer, 2U, 2U) != 0U) {
        return 4;
    }
    return fieldscribe_uss_left(&fixed, answer, 99U, 1U) == 15U &&
        fieldscribe_uss_left(&fixed, answer, 99U, 2U) == 12U && /* the answer says how long it is */
        fieldscribe_uss_left(&none, answer, 99U, 1U) == 7U ? 0 : 3;
}
