#include <stdlib.h>
#include <string.h>
#define FIELDSCRIBE_IMPLEMENTATION
#include "kitchen_uss_uss.h"
int main(void)
{
    static const fieldscribe_uss_link link = {1U, 0U, false}; /* one word: no device has such a parameter part */
    static const fieldscribe_uss_reading what = {1U, 0U, 0U, 1U};
    const fieldscribe_uss_request request = fieldscribe_uss_read(3U, &what);
    uint8_t *const bytes = malloc(6U);
    fieldscribe_uss_reply reply = {NULL, 0U, 0U, 0U, 0U, 0U};
    fieldscribe_uss_status status;
    if (bytes == NULL) {
        return 1;
    }
    memcpy(bytes, "\x02\x04\x03\x10\x00\x15", 6U);
    status = fieldscribe_uss_parse(&kitchen_uss_uss_profile, &link, &request, bytes, 6U, &reply);
    free(bytes);
    return status == FIELDSCRIBE_USS_WRONG_LENGTH ? 0 : 2;
}
