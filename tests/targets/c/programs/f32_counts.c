#include <stdio.h>
#include "sample_drive.h"
#define POINT(name)                                                                          \
    if (sscanf(line, #name " encode %lld", &number) == 1) {                                  \
        status = sample_drive_##name##_encode_count(number, &raw);                           \
        printf("%d %lld\n", (int)status, status == FIELDSCRIBE_OK ? (long long)raw : 0);    \
    }                                                                                        \
    if (sscanf(line, #name " decode %lld", &number) == 1) {                                  \
        status = sample_drive_##name##_decode_count((uint32_t)number, &count);               \
        printf("%d %lld\n", (int)status, status == FIELDSCRIBE_OK ? (long long)count : 0);  \
    }
int main(void)
{
    char line[99];
    long long number;
    while (fgets(line, sizeof line, stdin) != NULL) {
        fieldscribe_status status;
        uint32_t raw = 0U;
        int64_t count = 0;
@POINTS@
    }
    return 0;
}
