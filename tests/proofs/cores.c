/*
 * Proofs of the cores that points are made of (fieldscribe.h): for all numbers, limits, patterns, words and texts. What
 * the compiler proves before it writes a call is assumed here: limits lie in the type of the raw number, a product that
 * stands for a quotient fits its integers, and divisors are above 0.
 */
#include "arbitrary.h"
#include "fieldscribe.h"

#define ROWS 5U
#define TEXT 6U

static fieldscribe_range ranges[ROWS];
static fieldscribe_name names[ROWS];
static fieldscribe_wide_name wide_names[ROWS];
static const char *texts[ROWS];
static uint16_t words[TEXT];
static uint16_t digits[ROWS];
static char text[2U * TEXT + 1U];
static char given[2U * TEXT + 4U];
static char wide_text[3U * TEXT + 1U];
static size_t a_size;
static bool a_bool;
static uint8_t a_u8;
static int8_t an_s8;
static uint16_t a_u16;
static int16_t an_s16;
static uint32_t a_u32;
static int32_t an_s32;
static uint64_t a_u64;
static int64_t an_s64;
static volatile int32_t narrow;
static volatile int64_t wide;
static volatile uint64_t big;
static volatile uint32_t pattern;
static volatile uint8_t coin;
static volatile double real;

static fieldscribe_status any_status(void)
{
    return coin != 0U ? FIELDSCRIBE_OK : FIELDSCRIBE_OVERFLOW;
}

/* A number between two others. */
static int32_t between(int32_t low, int32_t high)
{
    const int32_t number = narrow;
    return number < low ? low : number > high ? high : number;
}

static int64_t between_wide(int64_t low, int64_t high)
{
    const int64_t number = wide;
    return number < low ? low : number > high ? high : number;
}

/* A rule as the functions below make them, with that numerator. */
static fieldscribe_rule rule_with(int64_t num)
{
    fieldscribe_rule rule = fieldscribe_rule_of(num, between_wide(1, INT64_MAX),
        between_wide(-INT64_MAX, INT64_MAX), between_wide(1, INT64_MAX));
    rule.shift = between(-700, 700);
    return rule;
}

static fieldscribe_rule any_rule(void)
{
    return rule_with(between_wide(-INT64_MAX, INT64_MAX));
}

void prove_status(void)
{
    fieldscribe_status status = fieldscribe_both(any_status(), any_status());
    status = fieldscribe_known(status);
    status = fieldscribe_either(status, any_status());
    (void)status;
}

void prove_checks(void)
{
    fieldscribe_status status = fieldscribe_check(narrow, narrow, narrow);
    status = fieldscribe_both(status, fieldscribe_check_wide(wide, wide, wide));
    status = fieldscribe_both(status, fieldscribe_check_u64(big, big, big));
    status = fieldscribe_both(status, fieldscribe_check_ranges(narrow, ranges, FIELDSCRIBE_COUNT(ranges)));
    (void)fieldscribe_within(narrow, narrow, narrow);
    (void)fieldscribe_within_wide(wide, wide, wide);
    (void)fieldscribe_within_u64(big, big, big);
    (void)status;
}

void prove_stored(void)
{
    fieldscribe_status status = fieldscribe_encode_bool(narrow, between(0, 1), between(0, 1), &a_bool);
    status = fieldscribe_encode_u8(narrow, between(0, UINT8_MAX), between(0, UINT8_MAX), &a_u8);
    status = fieldscribe_encode_s8(narrow, between(INT8_MIN, INT8_MAX), between(INT8_MIN, INT8_MAX), &an_s8);
    status = fieldscribe_encode_u16(narrow, between(0, UINT16_MAX), between(0, UINT16_MAX), &a_u16);
    status = fieldscribe_encode_s16(narrow, between(INT16_MIN, INT16_MAX), between(INT16_MIN, INT16_MAX), &an_s16);
    status = fieldscribe_encode_u32(wide, between_wide(0, UINT32_MAX), between_wide(0, UINT32_MAX), &a_u32);
    status = fieldscribe_encode_s32(wide, between(INT32_MIN, INT32_MAX), between(INT32_MIN, INT32_MAX), &an_s32);
    status = fieldscribe_encode_u64(big, big, big, &a_u64);
    status = fieldscribe_encode_s64(wide, wide, wide, &an_s64);
    status = fieldscribe_keep_bool(any_status(), coin != 0U, &a_bool);
    status = fieldscribe_keep_u8(any_status(), a_u8, &a_u8);
    status = fieldscribe_keep_s8(any_status(), an_s8, &an_s8);
    status = fieldscribe_keep_u16(any_status(), a_u16, &a_u16);
    status = fieldscribe_keep_s16(any_status(), an_s16, &an_s16);
    status = fieldscribe_keep_u32(any_status(), a_u32, &a_u32);
    status = fieldscribe_keep_s32(any_status(), an_s32, &an_s32);
    status = fieldscribe_keep_u64(any_status(), a_u64, &a_u64);
    status = fieldscribe_keep_s64(any_status(), an_s64, &an_s64);
    (void)status;
}

/* A whole number holds 0 or what lies in the limits, which lie in the type. */
void prove_whole(void)
{
    fieldscribe_status status = fieldscribe_store_u8(fieldscribe_whole_of(between(0, UINT8_MAX)), &a_u8);
    status = fieldscribe_store_s8(fieldscribe_whole_of(between(INT8_MIN, INT8_MAX)), &an_s8);
    status = fieldscribe_store_u16(fieldscribe_whole_of(between(0, UINT16_MAX)), &a_u16);
    status = fieldscribe_store_s16(fieldscribe_whole_of(between(INT16_MIN, INT16_MAX)), &an_s16);
    status = fieldscribe_store_u32(fieldscribe_whole_of(between_wide(0, UINT32_MAX)), &a_u32);
    status = fieldscribe_store_s32(fieldscribe_whole_of(between(INT32_MIN, INT32_MAX)), &an_s32);
    status = fieldscribe_store_u64(fieldscribe_whole_of(between_wide(0, INT64_MAX)), &a_u64);
    status = fieldscribe_store_s64(fieldscribe_whole_in(wide, wide, wide), &an_s64);
    status = fieldscribe_store_s64(fieldscribe_no_whole(any_status()), &an_s64);
    (void)status;
}

void prove_signs(void)
{
    (void)fieldscribe_signed(a_u16, 0x8000U);
    (void)fieldscribe_signed(a_u16, 0x80U);
    (void)fieldscribe_signed32(pattern);
    (void)fieldscribe_signed64(big);
    (void)fieldscribe_magnitude(wide);
}

void prove_quotients(void)
{
    (void)fieldscribe_shift(narrow, (uint32_t)between(0, 31));
    (void)fieldscribe_shift_wide(wide, (uint32_t)between(0, 63));
    (void)fieldscribe_halves(between(-0x3FFFFFFF, 0x3FFFFFFF), (uint32_t)between(1, 30));
    (void)fieldscribe_halves_wide(between_wide(-0x3FFFFFFFFFFFFFFF, 0x3FFFFFFFFFFFFFFF), (uint32_t)between(1, 62));
    (void)fieldscribe_nearly(between(-0x7FFF, 0x7FFF), between(0, 0x3FFF), between(0, 0x3FFF),
        (uint32_t)between(0, 30), (uint32_t)between(1, 29));
    (void)fieldscribe_nearly_wide(between(-0x3FFFFFFF, 0x3FFFFFFF), between(0, 0x3FFFFFFF), between(0, 0x3FFFFFFF),
        (uint32_t)between(0, 62), (uint32_t)between(1, 62));
    (void)fieldscribe_divide(
        between_wide(-0x3FFFFFFFFFFFFFFF, 0x3FFFFFFFFFFFFFFF), between_wide(1, 0x3FFFFFFFFFFFFFFF));
}

void prove_128_bits(void)
{
    fieldscribe_u128 product = fieldscribe_product(big, big);
    uint64_t rest = big;
    bool left_over = false;
    const fieldscribe_status status = fieldscribe_exact_count(coin != 0U, big, big, coin != 0U, big, big, &an_s64);
    (void)status;
    (void)fieldscribe_quotient_bit(&product, &rest, big);
    (void)fieldscribe_quotient_bits(&rest, big, between(0, 32));
    (void)fieldscribe_narrow_ratio(big, big, big, between(-63, 62), &a_u64, &left_over);
    (void)fieldscribe_short_ratio(big, big, narrow, &a_u64, &left_over);
    (void)fieldscribe_twice_ratio(big, big, big, big, narrow, &a_u64, &left_over);
    (void)fieldscribe_ratio_of(wide, wide, wide, between_wide(1, INT64_MAX), narrow, &an_s64);
    (void)fieldscribe_multiply(wide, wide, &an_s64);
    (void)fieldscribe_add(wide, wide, &an_s64);
}

void prove_rules(void)
{
    fieldscribe_rule rule = fieldscribe_rule_fails(any_rule(), any_status());
    rule = fieldscribe_rule_if(rule, coin != 0U);
    rule = fieldscribe_rule_within(rule, wide, wide, wide);
    rule = fieldscribe_rule_times(rule, wide);
    rule = fieldscribe_rule_over(rule, wide);
    rule = fieldscribe_rule_f32(rule, pattern, coin != 0U, between(-60, 60));
    rule = fieldscribe_rule_ten_to(rule, wide);
    rule = fieldscribe_rule_scaled(rule, wide);
    rule = fieldscribe_no_rule(FIELDSCRIBE_NO_CASE);
}

void prove_limits(void)
{
    fieldscribe_whole limit = fieldscribe_limit(any_rule());
    limit = fieldscribe_no_less(limit, wide);
    limit = fieldscribe_limit_f32(any_rule());
    limit = fieldscribe_no_more(limit, wide);
    limit = fieldscribe_limit_ratio(
        between_wide(-0x3FFFFFFFFFFFFFFF, 0x3FFFFFFFFFFFFFFF), between_wide(0, 0x3FFFFFFFFFFFFFFF));
    limit.number = fieldscribe_smaller(fieldscribe_larger(wide, wide), wide);
    if (fieldscribe_between(wide, limit, limit) == FIELDSCRIBE_OK) {
        a_bool = true;
    }
}

void prove_ruled(void)
{
    const fieldscribe_rule rule = any_rule();
    fieldscribe_whole whole = fieldscribe_ruled_count(rule, wide, between_wide(1, INT64_MAX), wide, wide);
    fieldscribe_status status = fieldscribe_decode_count(rule, wide, between_wide(1, INT64_MAX), &an_s64);
    fieldscribe_whole plain =
        fieldscribe_ratio_count(rule, wide, between_wide(1, INT64_MAX), between(0, 18), wide, wide);
    const int64_t fits = between_wide(INT64_MIN / 1000000000, INT64_MAX / 1000000000);
    status = fieldscribe_decode_ratio(rule, wide, between_wide(1, INT64_MAX), between(0, 18), &an_s64);
    status = fieldscribe_decode_power(fits, narrow, between(0, 9), &an_s64);
    (void)fieldscribe_apply_rule(&rule, wide, between_wide(1, INT64_MAX), &an_s64);
    (void)fieldscribe_lifted(&rule, wide, between_wide(1, INT64_MAX), &an_s64);
    (void)status;
    (void)whole;
    (void)plain;
}

void prove_names(void)
{
    (void)FIELDSCRIBE_NAME_AT(texts, wide);
    (void)fieldscribe_name_at(texts, FIELDSCRIBE_COUNT(texts), wide);
    (void)fieldscribe_name_of(names, FIELDSCRIBE_COUNT(names), wide);
    (void)fieldscribe_wide_name_of(wide_names, FIELDSCRIBE_COUNT(wide_names), big);
}

void prove_bits(void)
{
    (void)fieldscribe_extract(a_u16, a_u16, (uint32_t)between(0, 15));
    (void)fieldscribe_extract_wide(big, big, (uint32_t)between(0, 63));
    (void)fieldscribe_insert(a_u16, (uint16_t)between(0, UINT16_MAX), (uint32_t)between(0, 15), a_u16);
    (void)fieldscribe_fix(a_u16, (uint16_t)between(0, UINT16_MAX), (uint16_t)between(0, UINT16_MAX));
    (void)fieldscribe_fix32(pattern, pattern, pattern);
    (void)fieldscribe_fix64(big, big, big);
}

void prove_codings(uint64_t bits, uint64_t most, uint8_t sign)
{
    (void)fieldscribe_of_bcd((uint32_t)(bits & 0xFFFFFFFFU), (uint32_t)(most & 0xFFFFFFFFU));
    (void)fieldscribe_bcd_of((uint32_t)(bits & 0xFFFFFFFFU), (uint32_t)(most & 0xFFFFFFFFU));
    (void)fieldscribe_of_bcd_wide(bits, most);
    (void)fieldscribe_bcd_of_wide(bits, most);
    if ((sign > 0U) && (sign < 64U)) {
        (void)fieldscribe_of_sign_and_magnitude(bits, (uint64_t)1U << sign);
        (void)fieldscribe_sign_and_magnitude(an_s64, (uint64_t)1U << sign);
    }
}

void prove_words(void)
{
    words[0] = fieldscribe_exchanged(words[0]);
    fieldscribe_split32(pattern, &words[0], &words[1]);
    fieldscribe_split64(big, &words[0], &words[1], &words[2], &words[3]);
    (void)fieldscribe_join32(words[0], words[1]);
    (void)fieldscribe_join64(words[0], words[1], words[2], words[3]);
}

void prove_digits(void)
{
    fieldscribe_whole whole = fieldscribe_number_of_digits(digits, ROWS, names, FIELDSCRIBE_COUNT(names));
    fieldscribe_status status = fieldscribe_check_digits(a_u16, ROWS, names, FIELDSCRIBE_COUNT(names));
    status = fieldscribe_quantity_digits(coin != 0U, a_u16, digits, ROWS);
    fieldscribe_digits_of(a_u16, digits, ROWS);
    (void)status;
    (void)whole;
}

void prove_text(void)
{
    fieldscribe_status status = FIELDSCRIBE_OK;
    size_t length;
    for (length = 0U; length <= sizeof given; ++length) {
        status = fieldscribe_words_of_text(given, length, coin != 0U, words, TEXT);
    }
    (void)fieldscribe_is_printable(a_u8, coin != 0U);
    (void)fieldscribe_text_of_words(words, TEXT, text);
    for (length = 0U; length <= sizeof given; ++length) {
        status = fieldscribe_packed_words_of_text(given, length, coin != 0U, words, TEXT, 1U, coin != 0U, a_u8);
        status = fieldscribe_packed_words_of_text(given, length, coin != 0U, words, 2U * TEXT - 1U, 2U, coin != 0U, a_u8);
    }
    (void)fieldscribe_packed_shift(TEXT, 2U, coin != 0U);
    (void)fieldscribe_packed_text_of_words(words, TEXT, 1U, coin != 0U, a_u8, text);
    (void)fieldscribe_packed_text_of_words(words, 2U * TEXT - 1U, 2U, coin != 0U, a_u8, text);
    fieldscribe_bytes_of_words(words, TEXT, 1U, coin != 0U, (uint8_t *)text);
    fieldscribe_bytes_of_words(words, 2U * TEXT - 1U, 2U, coin != 0U, (uint8_t *)text);
    fieldscribe_words_of_bytes((const uint8_t *)given, TEXT, 1U, coin != 0U, words);
    fieldscribe_words_of_bytes((const uint8_t *)given, 2U * TEXT - 1U, 2U, coin != 0U, words);
    (void)status;
}

void prove_unicode(void)
{
    fieldscribe_status status = FIELDSCRIBE_OK;
    uint32_t number;
    size_t length;
    for (length = 0U; length <= 4U; ++length) {
        fieldscribe_pack((const unsigned char *)given, length, words, 3U, 2U, coin != 0U, a_u8);
        (void)fieldscribe_utf8_is_printable(given, length, &a_size);
        status = fieldscribe_words_of_utf8(given, length, words, 3U, 2U, coin != 0U, a_u8);
        status = fieldscribe_words_of_utf16(given, length, words, 2U, coin != 0U, a_u8);
    }
    (void)fieldscribe_utf8_first((const unsigned char *)given, 4U, &number);
    (void)fieldscribe_utf8_size(pattern);
    (void)fieldscribe_append_utf8((unsigned char *)wide_text, 0U, pattern);
    (void)fieldscribe_in_order(a_u16, coin != 0U);
    status = fieldscribe_utf8_of_words(words, 3U, 2U, coin != 0U, a_u8, text, &a_size);
    status = fieldscribe_utf16_of_words(words, 2U, coin != 0U, a_u8, wide_text, &a_size);
    (void)status;
}

void prove_patterns(void)
{
    fieldscribe_whole whole;
    fieldscribe_status status = fieldscribe_check_f32(pattern, narrow, narrow);
    status = fieldscribe_check_f64(big, wide, wide);
    status = fieldscribe_count_of_f32(pattern, between_wide(1, INT64_MAX), &an_s64);
    whole = fieldscribe_f32_of_count(wide, between_wide(1, INT64_MAX));
    (void)fieldscribe_f32_mantissa(pattern);
    (void)fieldscribe_f32_exponent(pattern);
    (void)whole;
    (void)fieldscribe_f32_order(pattern);
    (void)fieldscribe_f64_order(big);
    (void)status;
}

static void round_one(double value)
{
    const int32_t low = between(INT16_MIN, INT16_MAX);
    const int32_t high = between(INT16_MIN, INT16_MAX);
    fieldscribe_status status = fieldscribe_round(value, low, high, &an_s32);
    status = fieldscribe_round(value, between(INT32_MIN + 2, INT32_MAX - 2), between(INT32_MIN + 2, INT32_MAX - 2), &an_s32);
    status = fieldscribe_round_u8(value, between(0, UINT8_MAX), between(0, UINT8_MAX), &a_u8);
    status = fieldscribe_round_s8(value, between(INT8_MIN, INT8_MAX), between(INT8_MIN, INT8_MAX), &an_s8);
    status = fieldscribe_round_u16(value, between(0, UINT16_MAX), between(0, UINT16_MAX), &a_u16);
    status = fieldscribe_round_s16(value, low, high, &an_s16);
    status = fieldscribe_round_wide(value, &an_s64);
    status = fieldscribe_round_u32(value, between_wide(0, UINT32_MAX), between_wide(0, UINT32_MAX), &a_u32);
    status = fieldscribe_round_s32(value, between(INT32_MIN, INT32_MAX), between(INT32_MIN, INT32_MAX), &an_s32);
    (void)status;
}

/* Without a power of two, whose pattern this analysis takes for any number at all. */
static void round_whole(double value, fieldscribe_rule rule)
{
    fieldscribe_whole whole = fieldscribe_rounded(value, between(INT16_MIN, INT16_MAX), between(INT16_MIN, INT16_MAX));
    whole = fieldscribe_rounded_wide(value, wide, wide);
    rule.shift = 0;
    whole = fieldscribe_ruled_value(rule, value, wide, wide);
    (void)whole;
}

/*
 * All numbers, also infinite ones. What is none fails every comparison, which this analysis does not know: the vectors
 * have it, under a sanitizer. Nor is an infinite number times 0 a number.
 */
static double any_number(void)
{
    const double value = real;
    return value == value ? value : 0.0;
}

void prove_rounding(void)
{
    round_one(any_number());
}

void prove_rounded(void)
{
    round_whole(any_number(), rule_with(between_wide(1, INT64_MAX)));
    round_whole(any_number(), rule_with(between_wide(-INT64_MAX, -1)));
}

void prove_values(void)
{
    fieldscribe_real value = fieldscribe_times(real, real);
    double precise = fieldscribe_times_wide(real, real);
    fieldscribe_status status = fieldscribe_keep_real(any_status(), real, &value);
    status = fieldscribe_keep_double(any_status(), real, &precise);
    status = fieldscribe_decode_value(any_rule(), wide, &precise);
    status = fieldscribe_decode_wide(any_rule(), coin != 0U, big, &precise);
    status = fieldscribe_outside(coin != 0U);
    value = fieldscribe_ratio(narrow, between(1, INT32_MAX));
    precise = fieldscribe_ratio_wide(wide, between_wide(1, INT64_MAX));
    precise = fieldscribe_two_to(between(-1022, 1023));
    precise = fieldscribe_quotient(coin != 0U, big, big, coin != 0U, big, big);
    (void)status;
}

void prove_long_division(void)
{
    fieldscribe_u128 number = fieldscribe_product(big, big);
    bool negative = coin != 0U;
    number = fieldscribe_sum(number, big, coin != 0U, &negative);
    (void)fieldscribe_long_quotient(number, big);
}

void prove_conversions(void)
{
    fieldscribe_whole whole = fieldscribe_bits_of_f32(real);
    whole = fieldscribe_bits_of_f64(real);
    (void)fieldscribe_f32_of_bits(pattern);
    (void)fieldscribe_f64_of_bits(big);
    fieldscribe_copy(&a_u32, &pattern, sizeof a_u32);
    (void)whole;
}
