#include "fieldscribe.h"
#define MUST(what) if (!(what)) { return __LINE__ % 200 + 1; }
static const fieldscribe_wide_name names[] = {{UINT64_C(18446744073709551615), "all"}, {UINT64_C(4294967296), "high"}};
static const fieldscribe_name small[] = {{-5, "below"}, {70000, "above"}};
static const fieldscribe_range ranges[] = {{-3, -1}, {4, 4}};
int main(void)
{
    int64_t sum = 0;
    uint16_t raw = 7U;
    uint16_t words[4];
    MUST(fieldscribe_wide_name_of(names, FIELDSCRIBE_COUNT(names), UINT64_C(18446744073709551615))[0] == 'a')
    MUST(fieldscribe_wide_name_of(names, FIELDSCRIBE_COUNT(names), UINT64_C(4294967296))[0] == 'h')
    MUST(fieldscribe_wide_name_of(names, FIELDSCRIBE_COUNT(names), 0U) == NULL)
    MUST(fieldscribe_name_of(small, FIELDSCRIBE_COUNT(small), -5)[0] == 'b')
    MUST(fieldscribe_name_of(small, FIELDSCRIBE_COUNT(small), 70000)[0] == 'a')
    MUST(fieldscribe_name_of(small, FIELDSCRIBE_COUNT(small), INT64_C(4294967291)) == NULL)
    MUST(fieldscribe_check_ranges(-4, ranges, FIELDSCRIBE_COUNT(ranges)) == FIELDSCRIBE_OUT_OF_RANGE)
    MUST(fieldscribe_check_ranges(-3, ranges, FIELDSCRIBE_COUNT(ranges)) == FIELDSCRIBE_OK)
    MUST(fieldscribe_check_ranges(-1, ranges, FIELDSCRIBE_COUNT(ranges)) == FIELDSCRIBE_OK)
    MUST(fieldscribe_check_ranges(4, ranges, FIELDSCRIBE_COUNT(ranges)) == FIELDSCRIBE_OK)
    MUST(fieldscribe_check_ranges(5, ranges, FIELDSCRIBE_COUNT(ranges)) == FIELDSCRIBE_OUT_OF_RANGE)
    MUST(fieldscribe_add(INT64_MAX, 0, &sum) && sum == INT64_MAX && !fieldscribe_add(INT64_MAX, 1, &sum))
    MUST(fieldscribe_add(INT64_MIN, 0, &sum) && sum == INT64_MIN && !fieldscribe_add(INT64_MIN, -1, &sum))
    MUST(fieldscribe_add(-INT64_MAX, -1, &sum) && sum == INT64_MIN && fieldscribe_add(-1, 1, &sum) && sum == 0)
    MUST(fieldscribe_multiply(-INT64_MAX, 1, &sum) && sum == -INT64_MAX && !fieldscribe_multiply(INT64_MIN, 1, &sum))
    MUST(!fieldscribe_multiply(INT64_C(4294967296), INT64_C(2147483648), &sum))
    MUST(fieldscribe_multiply(INT64_C(4294967296), INT64_C(2147483647), &sum) && sum == INT64_C(9223372032559808512))
    MUST(fieldscribe_encode_u16(-1, 0, 9, &raw) == FIELDSCRIBE_OUT_OF_RANGE && raw == 7U)
    MUST(fieldscribe_encode_u16(10, 0, 9, &raw) == FIELDSCRIBE_OUT_OF_RANGE && raw == 7U)
    MUST(fieldscribe_encode_u16(9, 0, 9, &raw) == FIELDSCRIBE_OK && raw == 9U)
    MUST(fieldscribe_shift(-1, 3U) == -1 && fieldscribe_shift(-8, 3U) == -1 && fieldscribe_shift(15, 3U) == 1)
    MUST(fieldscribe_shift_wide(INT64_MIN, 62U) == -2)
    MUST(fieldscribe_halves(-1, 1U) == -1 && fieldscribe_halves(1, 1U) == 1 && fieldscribe_halves(-5, 2U) == -1)
    MUST(fieldscribe_divide(-3, 2) == -2 && fieldscribe_divide(3, 2) == 2 && fieldscribe_divide(-4, 3) == -1)
    MUST(fieldscribe_either(FIELDSCRIBE_OK, FIELDSCRIBE_ZERO_FACTOR) == FIELDSCRIBE_ZERO_FACTOR)
    MUST(fieldscribe_either(FIELDSCRIBE_OVERFLOW, FIELDSCRIBE_ZERO_FACTOR) == FIELDSCRIBE_OVERFLOW)
    MUST(fieldscribe_either(FIELDSCRIBE_OUT_OF_RANGE, FIELDSCRIBE_OK) == FIELDSCRIBE_OK)
    MUST(fieldscribe_either(FIELDSCRIBE_OUT_OF_RANGE, FIELDSCRIBE_OUT_OF_RANGE) == FIELDSCRIBE_OUT_OF_RANGE)
    fieldscribe_split64(UINT64_C(0x0123456789ABCDEF), &words[3], &words[1], &words[2], &words[0]);
    MUST(words[3] == 0x0123U && words[1] == 0x4567U && words[2] == 0x89ABU && words[0] == 0xCDEFU)
    MUST(fieldscribe_join64(words[3], words[1], words[2], words[0]) == UINT64_C(0x0123456789ABCDEF))
    MUST(fieldscribe_extract_wide(UINT64_C(0xF0F0000000000000), UINT64_C(0xFF00000000000000), 56U) == 0xF0U)
    return 0;
}
