#include <stdio.h>
#include "sample_drive.h"
#define TRY(name, raw_type, first, last, low, high)                                     \
    for (at = low; at <= high; ++at) {                                                  \
        const int32_t count = (int32_t)sample_drive_##name##_decode_count((raw_type)at); \
        fwrite(&count, sizeof count, 1U, stdout);                                       \
    }                                                                                   \
    for (at = first; at <= last; ++at) {                                                \
        raw_type raw = 0;                                                               \
        const int32_t status = (int32_t)sample_drive_##name##_encode_count(at, &raw);   \
        const int32_t found = status == 0 ? (int32_t)raw : INT32_MIN;                   \
        fwrite(&found, sizeof found, 1U, stdout);                                       \
    }
int main(void)
{
    int32_t at;
@TRIES@
    return 0;
}
