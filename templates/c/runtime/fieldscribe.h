/*
 * SPDX-License-Identifier: 0BSD
 *
 * The shared part of generated headers: status codes, limits, scales, rules that need other points, names of numbers,
 * bits, words and texts. <device>.h holds the facts of a device and calls these functions. This file needs no heap and
 * no library, and keeps no state: every function may run in an interrupt.
 *
 * Headers of points need only this file. Headers of frames also need functions that a program must define exactly
 * once: one C file writes `#define FIELDSCRIBE_IMPLEMENTATION` before it includes the headers of frames.
 *
 * ..._encode checks a value against the limits of its point. The macro of a special code is already a raw number; do
 * not encode it. `in steps of` in a comment says how the device rounds values; nothing here checks it.
 *
 * FIELDSCRIBE_NO_FLOAT leaves out everything that computes with floating-point numbers.
 * FIELDSCRIBE_FLOAT32 makes fieldscribe_real a float: values of points with at most 24 significant bits.
 * Floating-point results are exact to the bit. Therefore -ffast-math, its parts and x87 arithmetic are errors here.
 * Clang defines no macro for some of these parts (-freciprocal-math and others): on x86 this header turns them off; do
 * not pass them for other machines.
 */
#ifndef FIELDSCRIBE_H
#define FIELDSCRIBE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Increased when this file no longer fits headers that were generated earlier. */
#define FIELDSCRIBE_INTERFACE 2

#if !defined(FIELDSCRIBE_NO_FLOAT)
#include <float.h>
#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && (__FINITE_MATH_ONLY__ != 0)) || \
    defined(__RECIPROCAL_MATH__) || defined(__ASSOCIATIVE_MATH__)
#error "Compile without -ffast-math, -Ofast and their parts, or define FIELDSCRIBE_NO_FLOAT."
#endif
#if (FLT_RADIX != 2) || (FLT_MANT_DIG != 24)
#error "A float has not 24 bits here: define FIELDSCRIBE_NO_FLOAT."
#elif (DBL_MANT_DIG != 53) && !defined(FIELDSCRIBE_FLOAT32)
#error "A double has not 53 bits here: define FIELDSCRIBE_NO_FLOAT, or FIELDSCRIBE_FLOAT32 if all values fit a float."
#endif
#if (FLT_EVAL_METHOD != 0) && (FLT_EVAL_METHOD != 16) /* 16 affects only half floats */
#error "The arithmetic here has excess precision (x87): take -msse2 -mfpmath=sse, or define FIELDSCRIBE_NO_FLOAT."
#endif
#if DBL_MANT_DIG == 53
#define FIELDSCRIBE_DOUBLE /* a double is a binary64 number */
#endif
/* Machines with fused multiply-add. Clang defines a macro only on x86 and ARM, MSVC nowhere. */
#if defined(__FP_FAST_FMA) || defined(__FP_FAST_FMAF) || defined(__FMA__) || defined(__FMA4__) || \
    defined(__ARM_FEATURE_FMA) || defined(_MSC_VER) || \
    (defined(__clang__) && !defined(__i386__) && !defined(__x86_64__) && !defined(__arm__))
#define FIELDSCRIBE_PRODUCT volatile /* rounds a product before the next step */
#else
#define FIELDSCRIBE_PRODUCT const
#endif
#if defined(__clang__) && (defined(__i386__) || defined(__x86_64__))
#define FIELDSCRIBE_KEEP_PRECISE /* turn off -freciprocal-math and others, for which clang defines no macro */
#endif
#endif

/* The result of a conversion; 0 is success. */
typedef enum fieldscribe_status {
    FIELDSCRIBE_OK = 0,
    FIELDSCRIBE_OUT_OF_RANGE,  /* the value or raw number may not be written, or does not exist */
    FIELDSCRIBE_NOT_A_NUMBER,  /* the value is NaN */
    FIELDSCRIBE_UNKNOWN_VALUE, /* the number has no name, and the enum allows no others */
    FIELDSCRIBE_ZERO_FACTOR,   /* another point that the scale needs is zero or a special code */
    FIELDSCRIBE_NO_CASE,       /* the scale has no case for the number of the other point */
    FIELDSCRIBE_OVERFLOW,      /* the result does not fit */
    FIELDSCRIBE_SPECIAL,       /* the raw number is a special code: ..._special_name gives its name */
    FIELDSCRIBE_MALFORMED      /* the words are no valid text (UTF-8 or UTF-16), or no date */
} fieldscribe_status;

/* Starts a function whose result callers must use, and one that returns a status. */
#if (defined(__cplusplus) && (__cplusplus >= 201703L)) || \
    (!defined(__cplusplus) && defined(__STDC_VERSION__) && (__STDC_VERSION__ >= 202311L))
#define FIELDSCRIBE_CHECKED [[nodiscard]]
#elif defined(__GNUC__)
#define FIELDSCRIBE_CHECKED __attribute__((warn_unused_result))
#else
#define FIELDSCRIBE_CHECKED
#endif
#define FIELDSCRIBE_STATUS FIELDSCRIBE_CHECKED static inline fieldscribe_status

/* The number of rows of an array. */
#define FIELDSCRIBE_COUNT(array) (sizeof(array) / sizeof((array)[0]))

/* The number if the status is OK, else 0. */
typedef struct fieldscribe_whole {
    fieldscribe_status status;
    int64_t number;
} fieldscribe_whole;

static inline fieldscribe_whole fieldscribe_whole_of(int64_t number)
{
    const fieldscribe_whole whole = {FIELDSCRIBE_OK, number};
    return whole;
}

static inline fieldscribe_whole fieldscribe_no_whole(fieldscribe_status status)
{
    const fieldscribe_whole whole = {status, 0};
    return whole;
}

/* Return the number if it is within the limits. */
static inline fieldscribe_whole fieldscribe_whole_in(int64_t number, int64_t low, int64_t high)
{
    return ((number < low) || (number > high)) ? fieldscribe_no_whole(FIELDSCRIBE_OUT_OF_RANGE)
                                               : fieldscribe_whole_of(number);
}

/* The first status that is not OK. */
FIELDSCRIBE_STATUS fieldscribe_both(fieldscribe_status first, fieldscribe_status second)
{
    return (first != FIELDSCRIBE_OK) ? first : second;
}

/* For closed enums: a number out of range is an unknown value. */
FIELDSCRIBE_STATUS fieldscribe_known(fieldscribe_status status)
{
    return (status == FIELDSCRIBE_OUT_OF_RANGE) ? FIELDSCRIBE_UNKNOWN_VALUE : status;
}

/* ---- Numbers ---- */

static inline bool fieldscribe_within(int32_t number, int32_t low, int32_t high)
{
    return (number >= low) && (number <= high);
}

static inline bool fieldscribe_within_wide(int64_t number, int64_t low, int64_t high)
{
    return (number >= low) && (number <= high);
}

static inline bool fieldscribe_within_u64(uint64_t number, uint64_t low, uint64_t high)
{
    return (number >= low) && (number <= high);
}

FIELDSCRIBE_STATUS fieldscribe_check(int32_t number, int32_t low, int32_t high)
{
    return fieldscribe_within(number, low, high) ? FIELDSCRIBE_OK : FIELDSCRIBE_OUT_OF_RANGE;
}

FIELDSCRIBE_STATUS fieldscribe_check_wide(int64_t number, int64_t low, int64_t high)
{
    return ((number < low) || (number > high)) ? FIELDSCRIBE_OUT_OF_RANGE : FIELDSCRIBE_OK;
}

FIELDSCRIBE_STATUS fieldscribe_check_u64(uint64_t number, uint64_t low, uint64_t high)
{
    return fieldscribe_within_u64(number, low, high) ? FIELDSCRIBE_OK : FIELDSCRIBE_OUT_OF_RANGE;
}

/* A range with both ends included. */
typedef struct fieldscribe_range {
    int32_t low;
    int32_t high;
} fieldscribe_range;

/* OK if the number is in one of the ranges. */
FIELDSCRIBE_STATUS fieldscribe_check_ranges(int32_t number, const fieldscribe_range *ranges, size_t count)
{
    fieldscribe_status status = FIELDSCRIBE_OUT_OF_RANGE;
    size_t at;
    for (at = 0U; at < count; ++at) {
        if (fieldscribe_within(number, ranges[at].low, ranges[at].high)) {
            status = FIELDSCRIBE_OK;
        }
    }
    return status;
}

#define FIELDSCRIBE_CHECK_RANGES(number, ranges) fieldscribe_check_ranges((number), (ranges), FIELDSCRIBE_COUNT(ranges))

/* The number whose two's complement pattern is in the low bits of `bits`; `sign` is the highest of them. */
static inline int32_t fieldscribe_signed(uint16_t bits, uint16_t sign)
{
    return (int32_t)((uint32_t)bits ^ (uint32_t)sign) - (int32_t)sign;
}

/* The number with that two's complement pattern. */
static inline int32_t fieldscribe_signed32(uint32_t bits)
{
    return (bits <= (uint32_t)INT32_MAX) ? (int32_t)bits : (-1 - (int32_t)(~bits));
}

/* The number with that two's complement pattern. */
static inline int64_t fieldscribe_signed64(uint64_t bits)
{
    return (bits <= (uint64_t)INT64_MAX) ? (int64_t)bits : (-1 - (int64_t)(~bits));
}

/* The magnitude of a number. */
static inline uint64_t fieldscribe_magnitude(int64_t number)
{
    return (number < 0) ? ((uint64_t)(-(number + 1)) + 1U) : (uint64_t)number;
}

/* ---- Store a number and return its status ---- */

FIELDSCRIBE_STATUS fieldscribe_keep_bool(fieldscribe_status status, bool number, bool *to)
{
    if (status == FIELDSCRIBE_OK) {
        *to = number;
    }
    return status;
}

FIELDSCRIBE_STATUS fieldscribe_keep_u8(fieldscribe_status status, uint8_t number, uint8_t *to)
{
    if (status == FIELDSCRIBE_OK) {
        *to = number;
    }
    return status;
}

FIELDSCRIBE_STATUS fieldscribe_keep_s8(fieldscribe_status status, int8_t number, int8_t *to)
{
    if (status == FIELDSCRIBE_OK) {
        *to = number;
    }
    return status;
}

FIELDSCRIBE_STATUS fieldscribe_keep_u16(fieldscribe_status status, uint16_t number, uint16_t *to)
{
    if (status == FIELDSCRIBE_OK) {
        *to = number;
    }
    return status;
}

FIELDSCRIBE_STATUS fieldscribe_keep_s16(fieldscribe_status status, int16_t number, int16_t *to)
{
    if (status == FIELDSCRIBE_OK) {
        *to = number;
    }
    return status;
}

FIELDSCRIBE_STATUS fieldscribe_keep_u32(fieldscribe_status status, uint32_t number, uint32_t *to)
{
    if (status == FIELDSCRIBE_OK) {
        *to = number;
    }
    return status;
}

FIELDSCRIBE_STATUS fieldscribe_keep_s32(fieldscribe_status status, int32_t number, int32_t *to)
{
    if (status == FIELDSCRIBE_OK) {
        *to = number;
    }
    return status;
}

FIELDSCRIBE_STATUS fieldscribe_keep_u64(fieldscribe_status status, uint64_t number, uint64_t *to)
{
    if (status == FIELDSCRIBE_OK) {
        *to = number;
    }
    return status;
}

FIELDSCRIBE_STATUS fieldscribe_keep_s64(fieldscribe_status status, int64_t number, int64_t *to)
{
    if (status == FIELDSCRIBE_OK) {
        *to = number;
    }
    return status;
}

/* Store a number if it is within the limits. */
FIELDSCRIBE_STATUS fieldscribe_encode_bool(int32_t number, int32_t low, int32_t high, bool *raw)
{
    if ((number < low) || (number > high)) {
        return FIELDSCRIBE_OUT_OF_RANGE;
    }
    *raw = number != 0;
    return FIELDSCRIBE_OK;
}

FIELDSCRIBE_STATUS fieldscribe_encode_u8(int32_t number, int32_t low, int32_t high, uint8_t *raw)
{
    if ((number < low) || (number > high)) {
        return FIELDSCRIBE_OUT_OF_RANGE;
    }
    *raw = (uint8_t)number;
    return FIELDSCRIBE_OK;
}

FIELDSCRIBE_STATUS fieldscribe_encode_s8(int32_t number, int32_t low, int32_t high, int8_t *raw)
{
    if ((number < low) || (number > high)) {
        return FIELDSCRIBE_OUT_OF_RANGE;
    }
    *raw = (int8_t)number;
    return FIELDSCRIBE_OK;
}

FIELDSCRIBE_STATUS fieldscribe_encode_u16(int32_t number, int32_t low, int32_t high, uint16_t *raw)
{
    if ((number < low) || (number > high)) {
        return FIELDSCRIBE_OUT_OF_RANGE;
    }
    *raw = (uint16_t)number;
    return FIELDSCRIBE_OK;
}

FIELDSCRIBE_STATUS fieldscribe_encode_s16(int32_t number, int32_t low, int32_t high, int16_t *raw)
{
    if ((number < low) || (number > high)) {
        return FIELDSCRIBE_OUT_OF_RANGE;
    }
    *raw = (int16_t)number;
    return FIELDSCRIBE_OK;
}

FIELDSCRIBE_STATUS fieldscribe_encode_u32(int64_t number, int64_t low, int64_t high, uint32_t *raw)
{
    if ((number < low) || (number > high)) {
        return FIELDSCRIBE_OUT_OF_RANGE;
    }
    *raw = (uint32_t)number;
    return FIELDSCRIBE_OK;
}

FIELDSCRIBE_STATUS fieldscribe_encode_s32(int64_t number, int64_t low, int64_t high, int32_t *raw)
{
    if ((number < low) || (number > high)) {
        return FIELDSCRIBE_OUT_OF_RANGE;
    }
    *raw = (int32_t)number;
    return FIELDSCRIBE_OK;
}

FIELDSCRIBE_STATUS fieldscribe_encode_u64(uint64_t number, uint64_t low, uint64_t high, uint64_t *raw)
{
    if ((number < low) || (number > high)) {
        return FIELDSCRIBE_OUT_OF_RANGE;
    }
    *raw = number;
    return FIELDSCRIBE_OK;
}

FIELDSCRIBE_STATUS fieldscribe_encode_s64(int64_t number, int64_t low, int64_t high, int64_t *raw)
{
    if ((number < low) || (number > high)) {
        return FIELDSCRIBE_OUT_OF_RANGE;
    }
    *raw = number;
    return FIELDSCRIBE_OK;
}

FIELDSCRIBE_STATUS fieldscribe_store_u8(fieldscribe_whole whole, uint8_t *to)
{
    return fieldscribe_keep_u8(whole.status, (uint8_t)whole.number, to);
}

FIELDSCRIBE_STATUS fieldscribe_store_s8(fieldscribe_whole whole, int8_t *to)
{
    return fieldscribe_keep_s8(whole.status, (int8_t)whole.number, to);
}

FIELDSCRIBE_STATUS fieldscribe_store_u16(fieldscribe_whole whole, uint16_t *to)
{
    return fieldscribe_keep_u16(whole.status, (uint16_t)whole.number, to);
}

FIELDSCRIBE_STATUS fieldscribe_store_s16(fieldscribe_whole whole, int16_t *to)
{
    return fieldscribe_keep_s16(whole.status, (int16_t)whole.number, to);
}

FIELDSCRIBE_STATUS fieldscribe_store_u32(fieldscribe_whole whole, uint32_t *to)
{
    return fieldscribe_keep_u32(whole.status, (uint32_t)whole.number, to);
}

FIELDSCRIBE_STATUS fieldscribe_store_s32(fieldscribe_whole whole, int32_t *to)
{
    return fieldscribe_keep_s32(whole.status, (int32_t)whole.number, to);
}

FIELDSCRIBE_STATUS fieldscribe_store_u64(fieldscribe_whole whole, uint64_t *to)
{
    return fieldscribe_keep_u64(whole.status, (uint64_t)whole.number, to);
}

FIELDSCRIBE_STATUS fieldscribe_store_s64(fieldscribe_whole whole, int64_t *to)
{
    return fieldscribe_keep_s64(whole.status, whole.number, to);
}

/* ---- Scales in integers ---- */

/* number / 2^bits, rounded towards minus infinity. */
static inline int32_t fieldscribe_shift(int32_t number, uint32_t bits)
{
    return (number < 0) ? (-1 - ((-1 - number) >> bits)) : (number >> bits);
}

static inline int64_t fieldscribe_shift_wide(int64_t number, uint32_t bits)
{
    return (number < 0) ? (-1 - ((-1 - number) >> bits)) : (number >> bits);
}

/* number / 2^bits to the nearest integer, halves away from zero. */
static inline int32_t fieldscribe_halves(int32_t number, uint32_t bits)
{
    return fieldscribe_shift(number + (int32_t)((uint32_t)1U << (bits - 1U)) - ((number < 0) ? 1 : 0), bits);
}

static inline int64_t fieldscribe_halves_wide(int64_t number, uint32_t bits)
{
    return fieldscribe_shift_wide(number + (int64_t)((uint64_t)1U << (bits - 1U)) - ((number < 0) ? 1 : 0), bits);
}

/*
 * number * (much + little / 2^fine) / 2^bits to the nearest integer: divides without a division. For each point that
 * uses it, the compiler proves that the result is exact, with halves away from zero, and that 32 bits are enough.
 */
static inline int32_t fieldscribe_nearly(int32_t number, int32_t much, int32_t little, uint32_t fine, uint32_t bits)
{
    const int32_t half = (int32_t)((uint32_t)1U << (bits - 1U));
    return fieldscribe_shift((number * much) + fieldscribe_shift(number * little, fine) + half, bits);
}

/* The same in 64 bits. */
static inline int64_t fieldscribe_nearly_wide(
    int64_t number, int64_t much, int64_t little, uint32_t fine, uint32_t bits)
{
    const int64_t half = (int64_t)((uint64_t)1U << (bits - 1U));
    return fieldscribe_shift_wide((number * much) + fieldscribe_shift_wide(number * little, fine) + half, bits);
}

/* The quotient to the nearest integer, halves away from zero; the divisor is positive. */
static inline int64_t fieldscribe_divide(int64_t number, int64_t divisor)
{
    const int64_t half = divisor / 2;
    return ((number < 0) ? (number - half) : (number + half)) / divisor;
}

/* ---- 128 bits ---- */

typedef struct fieldscribe_u128 {
    uint64_t high;
    uint64_t low;
} fieldscribe_u128;

static inline fieldscribe_u128 fieldscribe_product(uint64_t a, uint64_t b)
{
    fieldscribe_u128 product;
    if ((((a | b) >> 32) == 0U) || (((a >> 16) | (b >> 48)) == 0U)) {
        product.high = 0U;
        product.low = a * b;
    } else {
        const uint64_t half_word = UINT64_C(0xFFFFFFFF);
        const uint64_t lowest = (a & half_word) * (b & half_word);
        const uint64_t cross = ((a >> 32) * (b & half_word)) + (lowest >> 32);
        const uint64_t middle = ((a & half_word) * (b >> 32)) + (cross & half_word);
        product.high = ((a >> 32) * (b >> 32)) + (cross >> 32) + (middle >> 32);
        product.low = ((middle & half_word) << 32) | (lowest & half_word);
    }
    return product;
}

/* The next bit of the quotient of a long division. The divisor is at most 2^63, the remainder `rest` less than it. */
static inline uint64_t fieldscribe_quotient_bit(fieldscribe_u128 *number, uint64_t *rest, uint64_t divisor)
{
    uint64_t bit = 0U;
    *rest = (*rest << 1) | (number->high >> 63);
    number->high = ((number->high & (uint64_t)INT64_MAX) << 1) | (number->low >> 63);
    number->low = (number->low & (uint64_t)INT64_MAX) << 1;
    if (*rest >= divisor) {
        *rest -= divisor;
        bit = 1U;
    }
    return bit;
}

/* The next bits of a quotient, at most 32. The remainder `rest` is less than the divisor, which is below 2^63. */
static inline uint32_t fieldscribe_quotient_bits(uint64_t *rest, uint64_t divisor, int32_t bits)
{
    uint64_t left = *rest;
    uint32_t quotient = 0U;
    int32_t more;
    for (more = bits; more > 0; --more) {
        left <<= 1;
        quotient = (quotient & 0x7FFFFFFFU) << 1;
        if (left >= divisor) {
            left -= divisor;
            quotient |= 1U;
        }
    }
    *rest = left;
    return quotient;
}

/*
 * 2 * number / (divisor * fives) * 2^shift, rounded down, in 32 bits; false, with nothing stored, if these may be too
 * few. The lowest bits of long divisors take no part in the division, and may make the quotient one less; nor do those
 * of a long number, where they cannot change it.
 */
static inline bool fieldscribe_narrow_ratio(
    uint64_t number, uint64_t divisor, uint64_t fives, int32_t shift, uint64_t *twice, bool *left_over)
{
    uint64_t leading = number;
    uint32_t lost = 0U;
    uint32_t rest;
    uint32_t over;
    uint32_t lowest;
    uint32_t end;
    uint32_t quotient = 1U; /* ahead of its bits; at `end` all of them are there */
    uint32_t apart = 16U;   /* the size of `lowest` */
    uint32_t up = 0U;       /* at most 66 */
    int32_t bits;
    if ((divisor > 0x7FFFFFFFU) || (fives > 0xFFFFU) || (shift < -63) || (shift > 62)) {
        return false;
    }
    for (; leading > 0x3FFFFFFFU; leading >>= 4) {
        lost |= (uint32_t)(leading & 0xFU);
        up += 4U;
    }
    rest = (uint32_t)leading;
    lowest = ((uint32_t)divisor & 0xFFFFU) * (uint32_t)fives;
    over = (((uint32_t)divisor >> 16) * (uint32_t)fives) + (lowest >> 16);
    lowest &= 0xFFFFU;
    while ((over <= 0x7FFFFFU) && (apart > 0U)) {
        apart -= 8U;
        over = (over << 8) | (lowest >> apart);
        lowest &= ((uint32_t)1U << apart) - 1U;
    }
    for (; over <= rest; over <<= 1) {
        lowest <<= 1;
        ++up;
    }
    bits = shift + 1 + (int32_t)(up & 0x7FU) - (int32_t)apart;
    for (; (bits > 4) && (rest < (over >> 4)); rest <<= 4) {
        bits -= 4;
    }
    if ((bits < 1) || (bits > 30) || (lowest > (0x7FFFFFFFU >> bits))) {
        return false;
    }
    end = (uint32_t)1U << bits;
    do {
        rest <<= 1;
        quotient <<= 1;
        if (rest >= over) {
            rest -= over;
            ++quotient;
        }
    } while (quotient < end);
    quotient -= end;
    lowest *= quotient;
    *left_over = (lost != 0U) || (((uint64_t)rest << apart) != lowest);
    lowest = (lowest + (((uint32_t)1U << apart) - 1U)) >> apart;
    /* `rest` was doubled at most 4 times more than `end`: lost bits would add less than 16 times `end` to it */
    if ((lost != 0U) && ((rest < lowest) || (((over - rest) >> 4) <= end))) {
        return false;
    }
    *twice = quotient;
    if (rest < lowest) {
        --*twice;
    }
    return true;
}

/* 2 * number / divisor * 2^shift, rounded down, in 64 bits; false, with nothing stored, if these may be too few. */
static inline bool fieldscribe_short_ratio(
    uint64_t number, uint64_t divisor, int32_t shift, uint64_t *twice, bool *left_over)
{
    uint64_t rest = number;
    uint64_t over = divisor;
    uint64_t quotient = 0U;
    uint32_t up = 0U;
    int32_t bits;
    if (((number | divisor) > (uint64_t)INT64_MAX) || (shift < -63) || (shift > 62)) {
        return false;
    }
    for (; over <= rest; over <<= 1) {
        ++up;
    }
    bits = shift + 1 + (int32_t)(up & 0x3FU); /* at most 63 */
    if ((over > (uint64_t)INT64_MAX) || (bits > 64)) {
        return false;
    }
    if (bits > 32) {
        quotient = (uint64_t)fieldscribe_quotient_bits(&rest, over, bits - 32) << 32;
        bits = 32;
    }
    *twice = quotient | fieldscribe_quotient_bits(&rest, over, bits);
    *left_over = rest != 0U;
    return true;
}

/*
 * 2 * a * b / (divisor * fives) * 2^shift, rounded down; `left_over` tells if there is a remainder. False if the result
 * needs more than 64 bits, or the product of the divisors, which is above 0, more than 63.
 */
static inline bool fieldscribe_twice_ratio(
    uint64_t a, uint64_t b, uint64_t divisor, uint64_t fives, int32_t shift, uint64_t *twice, bool *left_over)
{
    fieldscribe_u128 number = {0U, a};
    fieldscribe_u128 over = {0U, divisor};
    uint64_t rest = 0U;
    uint64_t quotient = 0U;
    int32_t bit = -129;
    bool fits = true;
    if (b != 1U) {
        number = fieldscribe_product(a, b);
    }
    if (number.high == 0U) {
        if ((divisor == 1U) && (fives == 1U) && (shift > -64) && (shift < 63) &&
            ((shift < 0) || (number.low <= ((uint64_t)INT64_MAX >> shift)))) {
            *twice = (shift < 0) ? (number.low >> (-1 - shift)) : ((number.low << shift) << 1);
            *left_over = (shift < -1) && ((*twice << (-1 - shift)) != number.low);
            return true;
        }
        if (fieldscribe_narrow_ratio(number.low, divisor, fives, shift, twice, left_over)) {
            return true;
        }
    }
    if (fives != 1U) {
        over = fieldscribe_product(divisor, fives);
    }
    if ((over.high != 0U) || (over.low > ((uint64_t)INT64_MAX + 1U))) {
        return false;
    }
    if ((number.high == 0U) && fieldscribe_short_ratio(number.low, over.low, shift, twice, left_over)) {
        return true;
    }
    while (fits && (bit < shift)) {
        const uint64_t next = fieldscribe_quotient_bit(&number, &rest, over.low);
        fits = quotient <= (uint64_t)INT64_MAX;
        quotient = ((quotient & (uint64_t)INT64_MAX) << 1) | next;
        ++bit;
    }
    *twice = quotient;
    *left_over = (rest | number.high | number.low) != 0U;
    return fits;
}

/* The magnitude of the sum of a 128-bit and a 63-bit number; `apart`: their signs differ. */
static inline fieldscribe_u128 fieldscribe_sum(fieldscribe_u128 number, uint64_t add, bool apart, bool *negative)
{
    if (!apart) {
        number.high += (number.low > (UINT64_MAX - add)) ? 1U : 0U;
        number.low = (number.low > (UINT64_MAX - add)) ? (add - (UINT64_MAX - number.low) - 1U) : (number.low + add);
    } else if ((number.high == 0U) && (number.low < add)) {
        number.low = add - number.low;
        *negative = !*negative;
    } else {
        number.high -= (number.low < add) ? 1U : 0U;
        number.low = (number.low < add) ? (UINT64_MAX - (add - number.low) + 1U) : (number.low - add);
    }
    return number;
}

/*
 * The count (size * factor + add) / divisor, as sign and magnitude, to the nearest integer, halves away from zero: for
 * numerators of more than 64 bits. Factor and addend are below 2^63, the divisor is in 1..2^63.
 */
FIELDSCRIBE_STATUS fieldscribe_exact_count(bool negative, uint64_t size, uint64_t factor, bool subtracts, uint64_t add,
    uint64_t divisor, int64_t *count)
{
    const uint64_t most = (uint64_t)INT64_MAX;
    bool below = negative;
    fieldscribe_u128 number = fieldscribe_sum(fieldscribe_product(size, factor), add, negative != subtracts, &below);
    fieldscribe_status status = FIELDSCRIBE_OVERFLOW;
    uint64_t rest = 0U;
    uint64_t quotient = 0U;
    int32_t bit;
    bool fits = true;
    for (bit = 0; fits && (bit < 128); ++bit) {
        const uint64_t next = fieldscribe_quotient_bit(&number, &rest, divisor);
        fits = quotient <= most;
        quotient = ((quotient & most) << 1) | next;
    }
    quotient += ((quotient < UINT64_MAX) && (rest >= (divisor - rest))) ? 1U : 0U;
    if (fits && (quotient <= most)) {
        *count = below ? -(int64_t)quotient : (int64_t)quotient;
        status = FIELDSCRIBE_OK;
    } else if (fits && below && (quotient == (most + 1U))) {
        *count = INT64_MIN;
        status = FIELDSCRIBE_OK;
    } else {
        status = FIELDSCRIBE_OVERFLOW;
    }
    return status;
}

/* number * num / (den * fives) * 2^shift to the nearest integer, halves away from zero; false if it does not fit. */
static inline bool fieldscribe_ratio_of(
    int64_t number, int64_t num, int64_t den, int64_t fives, int32_t shift, int64_t *result)
{
    const bool negative = (number < 0) != ((num < 0) != (den < 0));
    uint64_t twice = 0U;
    bool left_over = false;
    const bool fits = fieldscribe_twice_ratio(fieldscribe_magnitude(number), fieldscribe_magnitude(num),
        fieldscribe_magnitude(den), (uint64_t)fives, shift, &twice, &left_over);
    twice = (twice / 2U) + (twice & 1U);
    if ((!fits) || (twice > (uint64_t)INT64_MAX)) {
        return false;
    }
    *result = negative ? -(int64_t)twice : (int64_t)twice;
    return true;
}

/* a * b; false if it does not fit int64_t. */
static inline bool fieldscribe_multiply(int64_t a, int64_t b, int64_t *product)
{
    fieldscribe_u128 size;
    if ((a >= 0) && (a <= 0x7FFFFFFF) && (b >= 0) && (b <= 0xFFFF)) { /* two products of 32 bits */
        const uint32_t high = ((uint32_t)a >> 16) * (uint32_t)b;
        const uint32_t low = ((uint32_t)a & 0xFFFFU) * (uint32_t)b;
        *product = (int64_t)(((uint64_t)high << 16) + low);
        return true;
    }
    size = fieldscribe_product(fieldscribe_magnitude(a), fieldscribe_magnitude(b));
    if ((size.high != 0U) || (size.low > (uint64_t)INT64_MAX)) {
        return false;
    }
    *product = ((a < 0) != (b < 0)) ? -(int64_t)size.low : (int64_t)size.low;
    return true;
}

/* a + b; false if it does not fit int64_t. */
static inline bool fieldscribe_add(int64_t a, int64_t b, int64_t *sum)
{
    uint64_t size;
    if ((a >= 0) && (b >= 0)) {
        size = (uint64_t)a + (uint64_t)b;
        *sum = (size <= (uint64_t)INT64_MAX) ? (int64_t)size : 0;
        return size <= (uint64_t)INT64_MAX;
    }
    if ((a < 0) && (b < 0)) {
        size = (uint64_t)(-1 - a) + (uint64_t)(-1 - b);
        *sum = (size < (uint64_t)INT64_MAX) ? (-2 - (int64_t)size) : 0;
        return size < (uint64_t)INT64_MAX;
    }
    *sum = a + b;
    return true;
}

/* ---- binary32 patterns and counts, in integer arithmetic ---- */

/* The magnitude of a number as mantissa and power of two; the exponent is above 104 only for infinity and NaN. */
static inline uint32_t fieldscribe_f32_mantissa(uint32_t bits)
{
    return (bits & 0x7FFFFFU) | ((((bits >> 23) & 0xFFU) != 0U) ? 0x800000U : 0U);
}

static inline int32_t fieldscribe_f32_exponent(uint32_t bits)
{
    const uint32_t power = (bits >> 23) & 0xFFU;
    return (int32_t)((power != 0U) ? power : 1U) - 150;
}

/* The count of a pattern; `tens` counts (1 to 10^12) are one unit. OVERFLOW beyond -(2^63 - 1)..2^63 - 1. */
FIELDSCRIBE_STATUS fieldscribe_count_of_f32(uint32_t bits, int64_t tens, int64_t *count)
{
    const int32_t exponent = fieldscribe_f32_exponent(bits);
    uint64_t size = (uint64_t)fieldscribe_f32_mantissa(bits) * (uint64_t)tens;
    bool fits = exponent < 40; /* else at least 2^23 times 2^40 */
    if (fits && (exponent < 0)) {
        size = (exponent < -64) ? 0U : (size >> (-1 - exponent));
        size = (size / 2U) + (size & 1U);
    } else if (fits) {
        fits = size <= ((uint64_t)INT64_MAX >> exponent);
        size = fits ? (size << exponent) : 0U;
    } else {
        size = 0U;
    }
    if ((!fits) || (size > (uint64_t)INT64_MAX)) {
        return ((exponent > 104) && ((bits & 0x7FFFFFU) != 0U)) ? FIELDSCRIBE_NOT_A_NUMBER : FIELDSCRIBE_OVERFLOW;
    }
    *count = (bits > 0x7FFFFFFFU) ? -(int64_t)size : (int64_t)size;
    return FIELDSCRIBE_OK;
}

/* The pattern nearest to a count, ties to even; `tens` counts (1 to 10^18) are one unit. */
static inline fieldscribe_whole fieldscribe_f32_of_count(int64_t count, int64_t tens)
{
    uint64_t rest = fieldscribe_magnitude(count);
    uint64_t over = fieldscribe_magnitude(tens);
    uint32_t mantissa;
    int32_t power = 126;
    if (rest == 0U) {
        return fieldscribe_whole_of(0);
    }
    for (; (over <= (rest >> 1)) && (power < 200); over <<= 1) {
        ++power;
    }
    for (; (rest < over) && (power > 50); rest <<= 1) {
        --power;
    }
    rest -= over; /* the leading bit; 24 more follow, the last for rounding */
    mantissa = 0x1000000U | fieldscribe_quotient_bits(&rest, over, 24);
    mantissa += ((rest != 0U) || ((mantissa & 2U) != 0U)) ? 1U : 0U;
    mantissa = (mantissa >> 1) + ((uint32_t)power << 23);
    return fieldscribe_whole_of((int64_t)((count < 0) ? (mantissa | 0x80000000U) : mantissa));
}

/* ---- Rules: scales and limits that need the raw numbers of other points ---- */

/* raw = value * num / den * 2^shift + offset / parts, if the status is OK. */
typedef struct fieldscribe_rule {
    fieldscribe_status status;
    int32_t shift;
    int64_t num;
    int64_t den;
    int64_t offset;
    int64_t parts;
} fieldscribe_rule;

static inline fieldscribe_rule fieldscribe_rule_of(int64_t num, int64_t den, int64_t offset, int64_t parts)
{
    fieldscribe_rule rule;
    rule.status = FIELDSCRIBE_OK;
    rule.shift = 0;
    rule.num = num;
    rule.den = den;
    rule.offset = offset;
    rule.parts = parts;
    return rule;
}

/* Marks a rule as failed; keeps the first failure. */
static inline fieldscribe_rule fieldscribe_rule_fails(fieldscribe_rule rule, fieldscribe_status status)
{
    rule.status = fieldscribe_both(rule.status, status);
    return rule;
}

/* A failed rule, for example because the scale has no case for the number of another point. */
static inline fieldscribe_rule fieldscribe_no_rule(fieldscribe_status status)
{
    return fieldscribe_rule_fails(fieldscribe_rule_of(1, 1, 0, 1), status);
}

/* The rule, with OVERFLOW unless `fits`. */
static inline fieldscribe_rule fieldscribe_rule_if(fieldscribe_rule rule, bool fits)
{
    return fieldscribe_rule_fails(rule, fits ? FIELDSCRIBE_OK : FIELDSCRIBE_OVERFLOW);
}

/* The rule, with OVERFLOW unless the number is within the limits. */
static inline fieldscribe_rule fieldscribe_rule_within(fieldscribe_rule rule, int64_t number, int64_t low, int64_t high)
{
    return fieldscribe_rule_if(rule, fieldscribe_within_wide(number, low, high));
}

/* Multiply a limit by a factor; it may be zero. */
static inline fieldscribe_rule fieldscribe_rule_scaled(fieldscribe_rule rule, int64_t factor)
{
    int64_t num = factor;
    const bool fits = (rule.num == 1) ? (factor > INT64_MIN) : fieldscribe_multiply(rule.num, factor, &num);
    rule.num = num;
    return fieldscribe_rule_if(rule, fits);
}

/* Multiply a scale by a factor other than zero. */
static inline fieldscribe_rule fieldscribe_rule_times(fieldscribe_rule rule, int64_t factor)
{
    const fieldscribe_status status = (factor == 0) ? FIELDSCRIBE_ZERO_FACTOR : FIELDSCRIBE_OK;
    return fieldscribe_rule_scaled(fieldscribe_rule_fails(rule, status), factor);
}

/* Divide by a factor other than zero. */
static inline fieldscribe_rule fieldscribe_rule_over(fieldscribe_rule rule, int64_t factor)
{
    const fieldscribe_status status = (factor == 0) ? FIELDSCRIBE_ZERO_FACTOR : FIELDSCRIBE_OK;
    int64_t den = factor;
    const bool fits = (rule.den == 1) ? (factor > INT64_MIN) : fieldscribe_multiply(rule.den, factor, &den);
    rule.den = den;
    return fieldscribe_rule_if(fieldscribe_rule_fails(rule, status), fits);
}

/* Multiply by ten to the power of an exponent. */
static inline fieldscribe_rule fieldscribe_rule_ten_to(fieldscribe_rule rule, int64_t exponent)
{
    int64_t *const grows = (exponent < 0) ? &rule.den : &rule.num;
    uint64_t left = fieldscribe_magnitude(exponent);
    while ((left > 0U) && (rule.status == FIELDSCRIBE_OK)) {
        if (!fieldscribe_multiply(*grows, 10, grows)) {
            rule.status = FIELDSCRIBE_OVERFLOW;
        }
        --left;
    }
    return rule;
}

/*
 * Multiply or divide by the number of a binary32 pattern, and multiply by 2^twos; zero, infinity and NaN are no
 * factors.
 */
static inline fieldscribe_rule fieldscribe_rule_f32(fieldscribe_rule rule, uint32_t bits, bool divides, int32_t twos)
{
    const int32_t exponent = fieldscribe_f32_exponent(bits);
    const uint32_t size = (exponent > 104) ? 0U : fieldscribe_f32_mantissa(bits);
    const int64_t factor = (bits > 0x7FFFFFFFU) ? -(int64_t)size : (int64_t)size;
    rule.shift += twos + (divides ? -exponent : exponent);
    return divides ? fieldscribe_rule_over(rule, factor) : fieldscribe_rule_times(rule, factor);
}

/*
 * count * num / (den * tens) * 2^shift + offset / parts to the nearest integer, rounded once; false if it is far
 * outside all raw numbers. The sum is computed as twice the number of parts, plus the remainder of a division.
 */
static inline bool fieldscribe_lifted(const fieldscribe_rule *rule, int64_t count, int64_t tens, int64_t *raw)
{
    const bool negative = (count < 0) != ((rule->num < 0) != (rule->den < 0));
    uint64_t twice = 0U;
    bool left_over = false;
    int64_t parts = 0;
    int64_t num = 0;
    int64_t sum = 0;
    if ((!fieldscribe_multiply(rule->num, rule->parts, &num)) ||
        (!fieldscribe_twice_ratio(fieldscribe_magnitude(count), fieldscribe_magnitude(num),
            fieldscribe_magnitude(rule->den), (uint64_t)tens, rule->shift, &twice, &left_over)) ||
        (twice > (uint64_t)INT64_MAX) || (!fieldscribe_multiply(rule->offset, 2, &sum)) ||
        (!fieldscribe_add(sum, negative ? -(int64_t)twice : (int64_t)twice, &sum))) {
        return false;
    }
    /* if the signs differ, the magnitude is a little less; otherwise the remainder does not change the rounding */
    if (left_over && (sum != 0) && ((sum < 0) != negative)) {
        sum += (sum < 0) ? 1 : -1;
    }
    return fieldscribe_multiply(rule->parts, 2, &parts) && fieldscribe_ratio_of(sum, 1, parts, 1, 0, raw);
}

/* The raw number of `count`; `tens` counts are one unit. False if it does not fit. */
static inline bool fieldscribe_apply_rule(const fieldscribe_rule *rule, int64_t count, int64_t tens, int64_t *raw)
{
    return (rule->offset == 0) ? fieldscribe_ratio_of(count, rule->num, rule->den, tens, rule->shift, raw)
                               : fieldscribe_lifted(rule, count, tens, raw);
}

/* The raw number of a count, if it is in low..high. */
static inline fieldscribe_whole fieldscribe_ruled_count(
    fieldscribe_rule rule, int64_t count, int64_t tens, int64_t low, int64_t high)
{
    int64_t raw = 0;
    if (rule.status != FIELDSCRIBE_OK) {
        return fieldscribe_no_whole(rule.status);
    }
    return fieldscribe_apply_rule(&rule, count, tens, &raw) ? fieldscribe_whole_in(raw, low, high)
                                                            : fieldscribe_no_whole(FIELDSCRIBE_OUT_OF_RANGE);
}

/* The same for a rule without an offset, where fives * 2^twos counts are one unit. */
static inline fieldscribe_whole fieldscribe_ratio_count(
    fieldscribe_rule rule, int64_t count, int64_t fives, int32_t twos, int64_t low, int64_t high)
{
    int64_t raw = 0;
    if (rule.status != FIELDSCRIBE_OK) {
        return fieldscribe_no_whole(rule.status);
    }
    return fieldscribe_ratio_of(count, rule.num, rule.den, fives, rule.shift - twos, &raw)
        ? fieldscribe_whole_in(raw, low, high)
        : fieldscribe_no_whole(FIELDSCRIBE_OUT_OF_RANGE);
}

/* The count of a raw number by a rule without an offset, where fives * 2^twos counts are one unit. */
FIELDSCRIBE_STATUS fieldscribe_decode_ratio(
    fieldscribe_rule rule, int64_t raw, int64_t fives, int32_t twos, int64_t *count)
{
    int64_t den = 0;
    int64_t number = 0;
    if (rule.status != FIELDSCRIBE_OK) {
        return rule.status;
    }
    if ((!fieldscribe_multiply(rule.den, fives, &den)) ||
        (!fieldscribe_ratio_of(raw, den, rule.num, 1, twos - rule.shift, &number))) {
        return FIELDSCRIBE_OVERFLOW;
    }
    *count = number;
    return FIELDSCRIBE_OK;
}

/* The count of a raw number. */
FIELDSCRIBE_STATUS fieldscribe_decode_count(fieldscribe_rule rule, int64_t raw, int64_t tens, int64_t *count)
{
    fieldscribe_whole whole = fieldscribe_no_whole(rule.status);
    int64_t number = 0;
    int64_t num = 0;
    int64_t den = 0;
    if ((whole.status == FIELDSCRIBE_OK) &&
        ((!fieldscribe_multiply(raw, rule.parts, &number)) || (!fieldscribe_add(number, -rule.offset, &number)) ||
            (!fieldscribe_multiply(rule.den, tens, &den)) || (!fieldscribe_multiply(rule.num, rule.parts, &num)) ||
            (!fieldscribe_ratio_of(number, den, num, 1, -rule.shift, &whole.number)))) {
        whole.status = FIELDSCRIBE_OVERFLOW;
    }
    return fieldscribe_store_s64(whole, count);
}

/* The count of a raw number: number * 10^power, power in 0..most (at most 9); OVERFLOW for any other power. */
FIELDSCRIBE_STATUS fieldscribe_decode_power(int64_t raw, int32_t power, int32_t most, int64_t *count)
{
    static const int32_t powers[] = {1, 10, 100, 1000, 10000, 100000, 1000000, 10000000, 100000000, 1000000000};
    if ((power < 0) || (power > most)) {
        return FIELDSCRIBE_OVERFLOW;
    }
    *count = raw * powers[power];
    return FIELDSCRIBE_OK;
}

/* The limit that a rule computes. */
static inline fieldscribe_whole fieldscribe_limit(fieldscribe_rule rule)
{
    fieldscribe_whole limit = fieldscribe_no_whole(rule.status);
    if ((limit.status == FIELDSCRIBE_OK) && (!fieldscribe_apply_rule(&rule, 1, 1, &limit.number))) {
        limit.status = FIELDSCRIBE_OVERFLOW;
    }
    return limit;
}

/* The same for a rule with a floating-point factor; a limit that does not fit becomes INT64_MIN or INT64_MAX. */
static inline fieldscribe_whole fieldscribe_limit_f32(fieldscribe_rule rule)
{
    fieldscribe_whole limit = fieldscribe_no_whole(rule.status);
    if ((limit.status == FIELDSCRIBE_OK) && (!fieldscribe_apply_rule(&rule, 1, 1, &limit.number))) {
        limit.number = ((rule.num < 0) != (rule.den < 0)) ? INT64_MIN : INT64_MAX;
    }
    return limit;
}

/* A limit as a quotient, to the nearest integer; the divisor is zero or positive. */
static inline fieldscribe_whole fieldscribe_limit_ratio(int64_t number, int64_t divisor)
{
    return (divisor == 0) ? fieldscribe_no_whole(FIELDSCRIBE_ZERO_FACTOR)
                          : fieldscribe_whole_of(fieldscribe_divide(number, divisor));
}

/* The larger of two numbers. */
static inline int64_t fieldscribe_larger(int64_t first, int64_t second)
{
    return (first > second) ? first : second;
}

/* The smaller of two numbers. */
static inline int64_t fieldscribe_smaller(int64_t first, int64_t second)
{
    return (first < second) ? first : second;
}

/* The limit, but at least `least`. */
static inline fieldscribe_whole fieldscribe_no_less(fieldscribe_whole limit, int64_t least)
{
    limit.number = fieldscribe_larger(limit.number, least);
    return limit;
}

/* The limit, but at most `most`. */
static inline fieldscribe_whole fieldscribe_no_more(fieldscribe_whole limit, int64_t most)
{
    limit.number = fieldscribe_smaller(limit.number, most);
    return limit;
}

/* OK if the number is between two limits. */
FIELDSCRIBE_STATUS fieldscribe_between(int64_t number, fieldscribe_whole low, fieldscribe_whole high)
{
    return fieldscribe_both(
        fieldscribe_both(low.status, high.status), fieldscribe_check_wide(number, low.number, high.number));
}

/* OK if one of two checks allows the number; a failure to compute a limit takes precedence. */
FIELDSCRIBE_STATUS fieldscribe_either(fieldscribe_status one, fieldscribe_status other)
{
    fieldscribe_status status = ((one == FIELDSCRIBE_OK) || (other == FIELDSCRIBE_OK)) ? FIELDSCRIBE_OK : one;
    if ((other != FIELDSCRIBE_OK) && (other != FIELDSCRIBE_OUT_OF_RANGE)) {
        status = other;
    }
    if ((one != FIELDSCRIBE_OK) && (one != FIELDSCRIBE_OUT_OF_RANGE)) {
        status = one;
    }
    return status;
}

/* ---- Names ---- */

/* A number and its name. */
typedef struct fieldscribe_name {
    int32_t number;
    const char *name;
} fieldscribe_name;

/* The same for numbers of up to 64 bits, by their two's complement pattern. */
typedef struct fieldscribe_wide_name {
    uint64_t bits;
    const char *name;
} fieldscribe_wide_name;

/* The name of a number in a table without gaps; NULL if it has none. */
static inline const char *fieldscribe_name_at(const char *const *names, size_t count, int64_t number)
{
    return ((number >= 0) && ((uint64_t)number < count)) ? names[(size_t)number] : NULL;
}

#define FIELDSCRIBE_NAME_AT(names, number) fieldscribe_name_at((names), FIELDSCRIBE_COUNT(names), (number))

/* The name of a number; NULL if it has none. */
static inline const char *fieldscribe_name_of(const fieldscribe_name *names, size_t count, int64_t number)
{
    const char *name = NULL;
    size_t at;
    for (at = 0U; (at < count) && (name == NULL); ++at) {
        name = (names[at].number == number) ? names[at].name : NULL;
    }
    return name;
}

static inline const char *fieldscribe_wide_name_of(const fieldscribe_wide_name *names, size_t count, uint64_t bits)
{
    const char *name = NULL;
    size_t at;
    for (at = 0U; (at < count) && (name == NULL); ++at) {
        name = (names[at].bits == bits) ? names[at].name : NULL;
    }
    return name;
}

/* ---- Bits, words, digits, texts ---- */

/* The bits of a mask, right-aligned. */
static inline uint16_t fieldscribe_extract(uint16_t word, uint16_t mask, uint32_t shift)
{
    return (uint16_t)(((uint32_t)word & mask) >> shift);
}

static inline uint64_t fieldscribe_extract_wide(uint64_t raw, uint64_t mask, uint32_t shift)
{
    return (raw & mask) >> shift;
}

/* The word with the bits of the mask replaced. */
static inline uint16_t fieldscribe_insert(uint16_t word, uint16_t mask, uint32_t shift, uint16_t bits)
{
    return (uint16_t)(((uint32_t)word & ~(uint32_t)mask) | (((uint32_t)bits << shift) & mask));
}

/* The word with its constant bits set. */
static inline uint16_t fieldscribe_fix(uint16_t word, uint16_t mask, uint16_t bits)
{
    return (uint16_t)(((uint32_t)word & ~(uint32_t)mask) | bits);
}

static inline uint32_t fieldscribe_fix32(uint32_t raw, uint32_t mask, uint32_t bits)
{
    return (raw & ~mask) | bits;
}

static inline uint64_t fieldscribe_fix64(uint64_t raw, uint64_t mask, uint64_t bits)
{
    return (raw & ~mask) | bits;
}

/* The word with its bytes swapped. */
static inline uint16_t fieldscribe_exchanged(uint16_t word)
{
    return (uint16_t)((((uint32_t)word & 0xFFU) << 8) | ((uint32_t)word >> 8));
}

/* Words to numbers and back, the high word first. */
static inline uint32_t fieldscribe_join32(uint16_t high, uint16_t low)
{
    return ((uint32_t)high << 16) | low;
}

static inline uint64_t fieldscribe_join64(uint16_t first, uint16_t second, uint16_t third, uint16_t last)
{
    return ((uint64_t)fieldscribe_join32(first, second) << 32) | fieldscribe_join32(third, last);
}

static inline void fieldscribe_split32(uint32_t bits, uint16_t *high, uint16_t *low)
{
    *high = (uint16_t)(bits >> 16);
    *low = (uint16_t)(bits & 0xFFFFU);
}

static inline void fieldscribe_split64(
    uint64_t bits, uint16_t *first, uint16_t *second, uint16_t *third, uint16_t *last)
{
    fieldscribe_split32((uint32_t)(bits >> 32), first, second);
    fieldscribe_split32((uint32_t)(bits & 0xFFFFFFFFU), third, last);
}

/*
 * Decimal digits of four bits each (BCD); `most` is the largest number that these bits can hold. Bits that are not
 * decimal digits decode as a number with too many digits: the bits themselves, or the least such number if that is
 * greater. A number with too many digits encodes as its own bits.
 */
static inline uint32_t fieldscribe_of_bcd(uint32_t bits, uint32_t most)
{
    uint32_t number = 0U;
    uint32_t above = 1U;
    uint32_t left = bits;
    uint32_t places;
    bool decimal = true;
    for (places = most; places != 0U; places >>= 4) {
        const uint32_t digit = left & 0xFU;
        decimal = decimal && (digit < 10U);
        number += digit * above;
        above *= 10U;
        left >>= 4;
    }
    return decimal ? number : ((bits < above) ? above : bits);
}

static inline uint32_t fieldscribe_bcd_of(uint32_t number, uint32_t most)
{
    uint32_t bits = 0U;
    uint32_t left;
    if (number > 99999999U) {
        return number;
    }
    for (left = 0x80000000U; left != 0U; left >>= 1) { /* bit by bit: doubling a digit of 5 or more carries */
        const uint32_t carries = (bits + 0x33333333U) & 0x88888888U;
        bits = ((bits + ((carries >> 2) | (carries >> 3))) << 1) | (((number & left) != 0U) ? 1U : 0U);
    }
    return (bits > most) ? number : bits;
}

/* The same for up to 16 digits. */
static inline uint64_t fieldscribe_of_bcd_wide(uint64_t bits, uint64_t most)
{
    uint64_t number = 0U;
    uint64_t above = 1U;
    uint64_t left = bits;
    uint64_t places;
    bool decimal = true;
    for (places = most; places != 0U; places >>= 4) {
        const uint64_t digit = left & 0xFU;
        decimal = decimal && (digit < 10U);
        number += digit * above;
        above *= 10U;
        left >>= 4;
    }
    return decimal ? number : ((bits < above) ? above : bits);
}

static inline uint64_t fieldscribe_bcd_of_wide(uint64_t number, uint64_t most)
{
    uint64_t bits = 0U;
    uint64_t above = 1U;
    uint64_t left = number;
    uint64_t places;
    for (places = most; places != 0U; places >>= 4) {
        bits += (left % 10U) * above;
        above = (above & (UINT64_MAX >> 4)) << 4; /* the mask keeps sanitizers from reporting lost bits */
        left /= 10U;
    }
    return (left == 0U) ? bits : number;
}

/* Sign and magnitude: the highest bit is the sign; minus zero decodes as 0. */
static inline int64_t fieldscribe_of_sign_and_magnitude(uint64_t bits, uint64_t sign)
{
    const uint64_t below = bits & (sign - 1U) & (uint64_t)INT64_MAX;
    const int64_t magnitude = (int64_t)below;
    return ((bits & sign) != 0U) ? -magnitude : magnitude;
}

static inline uint64_t fieldscribe_sign_and_magnitude(int64_t number, uint64_t sign)
{
    return (fieldscribe_magnitude(number) & (sign - 1U)) | ((number < 0) ? sign : 0U);
}

/* The decimal digits of a word, highest first; the highest one takes the rest of the number. */
static inline void fieldscribe_digits_of(uint16_t raw, uint16_t *digits, size_t count)
{
    uint16_t rest = raw;
    size_t at;
    for (at = count; at > 1U; --at) {
        digits[at - 1U] = (uint16_t)(rest % 10U);
        rest = (uint16_t)(rest / 10U);
    }
    digits[0] = rest;
}

/* The same for a raw number that may be a special code, which has no digits. */
FIELDSCRIBE_STATUS fieldscribe_quantity_digits(bool special, uint16_t raw, uint16_t *digits, size_t count)
{
    if (special) {
        return FIELDSCRIBE_SPECIAL;
    }
    fieldscribe_digits_of(raw, digits, count);
    return FIELDSCRIBE_OK;
}

/* OK if each digit of the word has a name. */
FIELDSCRIBE_STATUS fieldscribe_check_digits(uint16_t raw, size_t count, const fieldscribe_name *names, size_t known)
{
    fieldscribe_status status = FIELDSCRIBE_OK;
    uint16_t rest = raw;
    size_t at;
    for (at = count; at > 0U; --at) {
        const uint16_t digit = (uint16_t)((at > 1U) ? (rest % 10U) : rest);
        if (fieldscribe_name_of(names, known, (int64_t)digit) == NULL) {
            status = FIELDSCRIBE_UNKNOWN_VALUE;
        }
        rest = (uint16_t)(rest / 10U);
    }
    return status;
}

/* Store the word of these digits, if each has a name. */
static inline fieldscribe_whole fieldscribe_number_of_digits(
    const uint16_t *digits, size_t count, const fieldscribe_name *names, size_t known)
{
    uint32_t number = 0U;
    size_t at;
    for (at = 0U; at < count; ++at) {
        if (fieldscribe_name_of(names, known, (int64_t)digits[at]) == NULL) {
            return fieldscribe_no_whole(FIELDSCRIBE_UNKNOWN_VALUE);
        }
        number = (number * 10U) + digits[at];
        if (number > 0xFFFFU) {
            return fieldscribe_no_whole(FIELDSCRIBE_UNKNOWN_VALUE);
        }
    }
    return fieldscribe_whole_of((int64_t)number);
}

/* True if a character is printable ASCII, or ISO 8859-1 if `latin`. */
static inline bool fieldscribe_is_printable(unsigned char code, bool latin)
{
    return (code >= 0x20U) && ((code <= 0x7EU) || (latin && (code >= 0xA0U)));
}

/* Store two characters in each word, the first in the high byte, and pad with spaces. */
FIELDSCRIBE_STATUS fieldscribe_words_of_text(const char *text, size_t length, bool latin, uint16_t *words, size_t count)
{
    const unsigned char *const codes = (const unsigned char *)text;
    size_t at;
    if (length > (2U * count)) {
        return FIELDSCRIBE_OUT_OF_RANGE;
    }
    for (at = 0U; at < length; ++at) {
        if (!fieldscribe_is_printable(codes[at], latin)) {
            return FIELDSCRIBE_OUT_OF_RANGE;
        }
    }
    for (at = 0U; at < count; ++at) {
        const unsigned char high = ((2U * at) < length) ? codes[2U * at] : (unsigned char)0x20U;
        const size_t next = (2U * at) + 1U;
        const unsigned char low = (next < length) ? codes[next] : (unsigned char)0x20U;
        words[at] = (uint16_t)(((uint32_t)high << 8) | low);
    }
    return FIELDSCRIBE_OK;
}

/* Store all characters without trailing spaces, then a 0; returns the length. */
static inline size_t fieldscribe_text_of_words(const uint16_t *words, size_t count, char *text)
{
    unsigned char *const codes = (unsigned char *)text;
    size_t length = 2U * count;
    size_t at;
    for (at = 0U; at < count; ++at) {
        codes[2U * at] = (unsigned char)(words[at] >> 8);
        codes[(2U * at) + 1U] = (unsigned char)(words[at] & 0xFFU);
    }
    while ((length > 0U) && (text[length - 1U] == ' ')) {
        --length;
    }
    text[length] = '\0';
    return length;
}

/*
 * Texts in other layouts, with `in_word` characters in each word. Of two, the first is the high byte; a single one is
 * the low byte; `low_first` swaps the bytes of each word. Words are padded with `fill`; a text ends at the first 0.
 */
static inline uint32_t fieldscribe_packed_shift(size_t at, size_t in_word, bool low_first)
{
    const bool is_low = (in_word == 1U) || ((at % 2U) != 0U);
    return (is_low == low_first) ? 8U : 0U;
}

/* Store characters, padded; the other byte of a single one is 0. Trailing spaces are not part of the text. */
static inline void fieldscribe_pack(const unsigned char *codes, size_t length, uint16_t *words, size_t most,
    size_t in_word, bool low_first, unsigned char fill)
{
    size_t end = length;
    size_t at;
    while ((end > 0U) && (codes[end - 1U] == 0x20U)) {
        --end;
    }
    for (at = 0U; at < (most + (most % in_word)); ++at) {
        const uint32_t code = (at < end) ? codes[at] : fill;
        const uint32_t other = ((at % in_word) == 0U) ? 0U : words[at / in_word];
        words[at / in_word] = (uint16_t)(other | (code << fieldscribe_packed_shift(at, in_word, low_first)));
    }
}

/* Store a text; OUT_OF_RANGE if it does not fit or has a character that is not printable. */
FIELDSCRIBE_STATUS fieldscribe_packed_words_of_text(const char *text, size_t length, bool latin, uint16_t *words,
    size_t most, size_t in_word, bool low_first, unsigned char fill)
{
    const unsigned char *const codes = (const unsigned char *)text;
    size_t at;
    if (length > most) {
        return FIELDSCRIBE_OUT_OF_RANGE;
    }
    for (at = 0U; at < length; ++at) {
        if (!fieldscribe_is_printable(codes[at], latin)) {
            return FIELDSCRIBE_OUT_OF_RANGE;
        }
    }
    fieldscribe_pack(codes, length, words, most, in_word, low_first, fill);
    return FIELDSCRIBE_OK;
}

/* Store the characters up to the padding, without trailing spaces, then a 0; returns the length. */
static inline size_t fieldscribe_packed_text_of_words(
    const uint16_t *words, size_t most, size_t in_word, bool low_first, unsigned char fill, char *text)
{
    unsigned char *const codes = (unsigned char *)text;
    size_t length = 0U;
    while (length < most) {
        const uint32_t shift = fieldscribe_packed_shift(length, in_word, low_first);
        codes[length] = (unsigned char)(((uint32_t)words[length / in_word] >> shift) & 0xFFU);
        if ((fill == 0U) && (codes[length] == 0U)) {
            break;
        }
        ++length;
    }
    while ((length > 0U) && (text[length - 1U] == ' ')) {
        --length;
    }
    text[length] = '\0';
    return length;
}

/* Bytes from words in these layouts, and back; the other byte of a single one is 0. */
static inline void fieldscribe_bytes_of_words(
    const uint16_t *words, size_t count, size_t in_word, bool low_first, uint8_t *bytes)
{
    size_t at;
    for (at = 0U; at < count; ++at) {
        const uint32_t shift = fieldscribe_packed_shift(at, in_word, low_first);
        bytes[at] = (uint8_t)(((uint32_t)words[at / in_word] >> shift) & 0xFFU);
    }
}

static inline void fieldscribe_words_of_bytes(
    const uint8_t *bytes, size_t count, size_t in_word, bool low_first, uint16_t *words)
{
    size_t at;
    for (at = 0U; at < count; ++at) {
        const uint32_t other = ((at % in_word) == 0U) ? 0U : words[at / in_word];
        const uint32_t shift = fieldscribe_packed_shift(at, in_word, low_first);
        words[at / in_word] = (uint16_t)(other | ((uint32_t)bytes[at] << shift));
    }
}

/* ---- UTF-8 and UTF-16 ---- */

/* The number of bytes of a character in UTF-8. */
static inline size_t fieldscribe_utf8_size(uint32_t number)
{
    size_t size = 1U;
    if (number >= 0x80U) {
        ++size;
    }
    if (number >= 0x800U) {
        ++size;
    }
    if (number >= 0x10000U) {
        ++size;
    }
    return size;
}

/* The first character of a text and the number of its bytes; 0 bytes if it is no valid UTF-8. */
static inline size_t fieldscribe_utf8_first(const unsigned char *codes, size_t length, uint32_t *character)
{
    const uint32_t lead = codes[0];
    uint32_t number = lead;
    size_t size = 1U;
    size_t at;
    if (lead >= 0x80U) {
        size = 2U;
        if (lead >= 0xE0U) {
            ++size;
        }
        if (lead >= 0xF0U) {
            ++size;
        }
        number &= 0xFFU >> size;
    }
    if (size > length) {
        return 0U;
    }
    for (at = 1U; at < size; ++at) {
        if ((codes[at] & 0xC0U) != 0x80U) {
            return 0U;
        }
        number = (number << 6) | (codes[at] & 0x3FU);
    }
    *character = number;
    if ((number > 0x10FFFFU) || ((number >= 0xD800U) && (number <= 0xDFFFU)) || ((lead & 0xC0U) == 0x80U)) {
        return 0U;
    }
    return (fieldscribe_utf8_size(number) == size) ? size : 0U;
}

/* True if a text is UTF-8 without control characters; counts its UTF-16 units. */
static inline bool fieldscribe_utf8_is_printable(const char *text, size_t length, size_t *units)
{
    const unsigned char *const codes = (const unsigned char *)text;
    bool fine = true;
    size_t at = 0U;
    *units = 0U;
    while (fine && (at < length)) {
        uint32_t number = 0U;
        const size_t size = fieldscribe_utf8_first(&codes[at], length - at, &number);
        fine = (size > 0U) && (number >= 0x20U) && ((number < 0x7FU) || (number > 0x9FU));
        *units += (size > 3U) ? 2U : 1U;
        at += size;
    }
    return fine;
}

/* Store a UTF-8 text, two bytes a word; OUT_OF_RANGE if it does not fit or is not UTF-8. */
FIELDSCRIBE_STATUS fieldscribe_words_of_utf8(const char *text, size_t length, uint16_t *words, size_t most,
    size_t in_word, bool low_first, unsigned char fill)
{
    size_t units;
    if ((length > most) || !fieldscribe_utf8_is_printable(text, length, &units)) {
        return FIELDSCRIBE_OUT_OF_RANGE;
    }
    fieldscribe_pack((const unsigned char *)text, length, words, most, in_word, low_first, fill);
    return FIELDSCRIBE_OK;
}

/* The UTF-8 text of words with two bytes each; MALFORMED if it is not UTF-8. */
FIELDSCRIBE_STATUS fieldscribe_utf8_of_words(const uint16_t *words, size_t most, size_t in_word, bool low_first,
    unsigned char fill, char *text, size_t *length)
{
    const unsigned char *const codes = (const unsigned char *)text;
    bool fine = true;
    size_t at = 0U;
    *length = fieldscribe_packed_text_of_words(words, most, in_word, low_first, fill, text);
    while (fine && (at < *length)) {
        uint32_t number = 0U;
        const size_t size = fieldscribe_utf8_first(&codes[at], *length - at, &number);
        fine = size > 0U;
        at += size;
    }
    return fine ? FIELDSCRIBE_OK : FIELDSCRIBE_MALFORMED;
}

static inline uint16_t fieldscribe_in_order(uint32_t word, bool low_first)
{
    return (uint16_t)(low_first ? (((word & 0xFFU) << 8) | (word >> 8)) : word);
}

/* Store a UTF-8 text as UTF-16, one unit a word, padded; OUT_OF_RANGE if it does not fit or is not UTF-8. */
FIELDSCRIBE_STATUS fieldscribe_words_of_utf16(
    const char *text, size_t length, uint16_t *words, size_t most, bool low_first, unsigned char fill)
{
    const unsigned char *const codes = (const unsigned char *)text;
    size_t units;
    size_t end = length;
    size_t from = 0U;
    size_t at = 0U;
    if (!fieldscribe_utf8_is_printable(text, length, &units) || (units > most)) {
        return FIELDSCRIBE_OUT_OF_RANGE;
    }
    while ((end > 0U) && (codes[end - 1U] == 0x20U)) {
        --end;
    }
    while (at < most) {
        uint32_t number = fill;
        if (from < end) {
            from += fieldscribe_utf8_first(&codes[from], end - from, &number);
        }
        if ((number > 0xFFFFU) && ((at + 1U) < most)) {
            words[at] = fieldscribe_in_order(0xD7C0U + (number >> 10), low_first);
            number = 0xDC00U | (number & 0x3FFU);
            ++at;
        }
        words[at] = fieldscribe_in_order(number & 0xFFFFU, low_first);
        ++at;
    }
    return FIELDSCRIBE_OK;
}

/* Append a character as UTF-8; returns the new length. */
static inline size_t fieldscribe_append_utf8(unsigned char *codes, size_t length, uint32_t number)
{
    const size_t size = fieldscribe_utf8_size(number);
    uint32_t rest = number;
    size_t at;
    for (at = size - 1U; at > 0U; --at) {
        codes[length + at] = (unsigned char)(0x80U | (rest & 0x3FU));
        rest >>= 6;
    }
    if (size > 1U) {
        rest |= 0xF00U >> size;
    }
    codes[length] = (unsigned char)(rest & 0xFFU);
    return length + size;
}

/*
 * The text of UTF-16 words as UTF-8, up to the padding and without trailing spaces; it has up to three bytes for each
 * of `most` words. MALFORMED if it is not UTF-16.
 */
FIELDSCRIBE_STATUS fieldscribe_utf16_of_words(
    const uint16_t *words, size_t most, bool low_first, unsigned char fill, char *text, size_t *length)
{
    unsigned char *const codes = (unsigned char *)text;
    fieldscribe_status status = FIELDSCRIBE_OK;
    size_t end = 0U;
    size_t at = 0U;
    while ((at < most) && ((fill != 0U) || (words[at] != 0U))) {
        uint32_t number = fieldscribe_in_order(words[at], low_first);
        ++at;
        if ((number >= 0xD800U) && (number <= 0xDFFFU)) {
            const uint32_t next = (at < most) ? fieldscribe_in_order(words[at], low_first) : 0U;
            if ((number > 0xDBFFU) || (next < 0xDC00U) || (next > 0xDFFFU)) {
                status = FIELDSCRIBE_MALFORMED;
                break;
            }
            number = 0x10000U + ((number & 0x3FFU) << 10) + (next & 0x3FFU);
            ++at;
        }
        end = fieldscribe_append_utf8(codes, end, number);
    }
    while ((end > 0U) && (text[end - 1U] == ' ')) {
        --end;
    }
    text[end] = '\0';
    *length = end;
    return status;
}

/* ---- Floating-point patterns ---- */

/* The rank of a bit pattern among all numbers; negative numbers have negative ranks. */
static inline int32_t fieldscribe_f32_order(uint32_t bits)
{
    const int32_t size = (int32_t)(bits & 0x7FFFFFFFU);
    return (bits > 0x7FFFFFFFU) ? -size : size;
}

static inline int64_t fieldscribe_f64_order(uint64_t bits)
{
    const int64_t size = (int64_t)(bits & (uint64_t)INT64_MAX);
    return (bits > (uint64_t)INT64_MAX) ? -size : size;
}

/* OK if the rank of a pattern is between two ranks. */
FIELDSCRIBE_STATUS fieldscribe_check_f32(uint32_t bits, int32_t low, int32_t high)
{
    const int32_t order = fieldscribe_f32_order(bits);
    const bool number = fieldscribe_within(order, -0x7F800000, 0x7F800000);
    return number ? fieldscribe_check(order, low, high) : FIELDSCRIBE_NOT_A_NUMBER;
}

FIELDSCRIBE_STATUS fieldscribe_check_f64(uint64_t bits, int64_t low, int64_t high)
{
    const int64_t infinity = INT64_C(0x7FF0000000000000);
    const int64_t order = fieldscribe_f64_order(bits);
    const bool number = fieldscribe_within_wide(order, -infinity, infinity);
    return number ? fieldscribe_check_wide(order, low, high) : FIELDSCRIBE_NOT_A_NUMBER;
}

#if !defined(FIELDSCRIBE_NO_FLOAT)

/* ---- Values in floating point ---- */

#if defined(FIELDSCRIBE_KEEP_PRECISE)
#pragma float_control(push)
#pragma float_control(precise, on)
#endif

#if defined(FIELDSCRIBE_FLOAT32)
typedef float fieldscribe_real;
#else
typedef double fieldscribe_real;
#endif

/* value * factor, rounded before the next step: compilers must not fuse the two. */
static inline fieldscribe_real fieldscribe_times(fieldscribe_real value, fieldscribe_real factor)
{
    FIELDSCRIBE_PRODUCT fieldscribe_real product = value * factor;
    return product;
}

/* The quotient of two integers that fieldscribe_real holds exactly. */
static inline fieldscribe_real fieldscribe_ratio(int32_t number, int32_t divisor)
{
    return (fieldscribe_real)number / (fieldscribe_real)divisor;
}

/* The status of a value outside the limits, which may be NaN. */
FIELDSCRIBE_STATUS fieldscribe_outside(bool is_number)
{
    return is_number ? FIELDSCRIBE_OUT_OF_RANGE : FIELDSCRIBE_NOT_A_NUMBER;
}

FIELDSCRIBE_STATUS fieldscribe_keep_real(fieldscribe_status status, fieldscribe_real number, fieldscribe_real *to)
{
    if (status == FIELDSCRIBE_OK) {
        *to = number;
    }
    return status;
}

/* The nearest integer, halves away from zero, of what rounds to low..high, or nearly (limits below 2^31 - 1). */
FIELDSCRIBE_STATUS fieldscribe_round(fieldscribe_real number, int32_t low, int32_t high, int32_t *whole)
{
    fieldscribe_real rest;
    if (!((number > (fieldscribe_real)(low - 1)) && (number < (fieldscribe_real)(high + 1)))) {
        return fieldscribe_outside((number < 0) || (number >= 0));
    }
    *whole = (int32_t)number;
    rest = number - (fieldscribe_real)*whole;
    *whole += ((rest >= (fieldscribe_real)0.5) ? 1 : 0) - ((rest <= (fieldscribe_real)-0.5) ? 1 : 0);
    return FIELDSCRIBE_OK;
}

/* The same, for a number that is checked before it is stored. */
static inline fieldscribe_whole fieldscribe_rounded(fieldscribe_real number, int32_t low, int32_t high)
{
    int32_t nearest = 0;
    const fieldscribe_status status = fieldscribe_round(number, low, high, &nearest);
    return (status == FIELDSCRIBE_OK) ? fieldscribe_whole_in(nearest, low, high) : fieldscribe_no_whole(status);
}

FIELDSCRIBE_STATUS fieldscribe_round_u8(fieldscribe_real number, int32_t low, int32_t high, uint8_t *raw)
{
    int32_t whole = 0;
    const fieldscribe_status status = fieldscribe_round(number, low, high, &whole);
    return (status == FIELDSCRIBE_OK) ? fieldscribe_encode_u8(whole, low, high, raw) : status;
}

FIELDSCRIBE_STATUS fieldscribe_round_s8(fieldscribe_real number, int32_t low, int32_t high, int8_t *raw)
{
    int32_t whole = 0;
    const fieldscribe_status status = fieldscribe_round(number, low, high, &whole);
    return (status == FIELDSCRIBE_OK) ? fieldscribe_encode_s8(whole, low, high, raw) : status;
}

FIELDSCRIBE_STATUS fieldscribe_round_u16(fieldscribe_real number, int32_t low, int32_t high, uint16_t *raw)
{
    int32_t whole = 0;
    const fieldscribe_status status = fieldscribe_round(number, low, high, &whole);
    return (status == FIELDSCRIBE_OK) ? fieldscribe_encode_u16(whole, low, high, raw) : status;
}

FIELDSCRIBE_STATUS fieldscribe_round_s16(fieldscribe_real number, int32_t low, int32_t high, int16_t *raw)
{
    int32_t whole = 0;
    const fieldscribe_status status = fieldscribe_round(number, low, high, &whole);
    return (status == FIELDSCRIBE_OK) ? fieldscribe_encode_s16(whole, low, high, raw) : status;
}

/* Copies bytes: a cast would convert the number, and aliasing is undefined. */
static inline void fieldscribe_copy(void *to, const void *from, size_t size)
{
#if defined(__GNUC__)
    __builtin_memcpy(to, from, size);
#else
    size_t at;
    for (at = 0U; at < size; ++at) {
        ((unsigned char *)to)[at] = ((const unsigned char *)from)[at];
    }
#endif
}

/* The number with that IEEE 754 bit pattern. */
static inline fieldscribe_real fieldscribe_f32_of_bits(uint32_t bits)
{
    float number = 0;
    fieldscribe_copy(&number, &bits, sizeof number);
    return (fieldscribe_real)number;
}

/* The bit pattern of the nearest float, ties to even. */
static inline fieldscribe_whole fieldscribe_bits_of_f32(fieldscribe_real number)
{
    float narrow;
    uint32_t pattern = 0U;
#if defined(FIELDSCRIBE_FLOAT32)
    const float over = 3.4028234663852886e+38F; /* the largest float */
    const bool fits = (number >= -over) && (number <= over);
#else
    const double over = 3.4028235677973366e+38; /* from here on a double rounds to infinity */
    const bool fits = (number > -over) && (number < over);
#endif
    if (!fits) {
        return fieldscribe_no_whole(fieldscribe_outside((number < 0) || (number >= 0)));
    }
    narrow = (float)number;
    fieldscribe_copy(&pattern, &narrow, sizeof pattern);
    return fieldscribe_whole_of((int64_t)pattern);
}

#if defined(FIELDSCRIBE_DOUBLE)

static inline double fieldscribe_times_wide(double value, double factor)
{
    FIELDSCRIBE_PRODUCT double product = value * factor;
    return product;
}

/* The quotient of two integers that a double holds exactly. */
static inline double fieldscribe_ratio_wide(int64_t number, int64_t divisor)
{
    return (double)number / (double)divisor;
}

FIELDSCRIBE_STATUS fieldscribe_keep_double(fieldscribe_status status, double number, double *to)
{
    if (status == FIELDSCRIBE_OK) {
        *to = number;
    }
    return status;
}

/* The nearest integer, halves away from zero. */
FIELDSCRIBE_STATUS fieldscribe_round_wide(double number, int64_t *whole)
{
    double rest;
    if (!((number >= -9223372036854775808.0) && (number < 9223372036854775808.0))) {
        return fieldscribe_outside((number < 0) || (number >= 0));
    }
    *whole = (int64_t)number;
    rest = number - (double)*whole; /* 0 from 2^53 on */
    *whole += ((rest >= 0.5) && (*whole < INT64_MAX)) ? 1 : 0;
    *whole -= ((rest <= -0.5) && (*whole > INT64_MIN)) ? 1 : 0;
    return FIELDSCRIBE_OK;
}

/* The same, if it is in low..high. */
static inline fieldscribe_whole fieldscribe_rounded_wide(double number, int64_t low, int64_t high)
{
    int64_t nearest = 0;
    const fieldscribe_status status = fieldscribe_round_wide(number, &nearest);
    return (status == FIELDSCRIBE_OK) ? fieldscribe_whole_in(nearest, low, high) : fieldscribe_no_whole(status);
}

FIELDSCRIBE_STATUS fieldscribe_round_u32(double number, int64_t low, int64_t high, uint32_t *raw)
{
    int64_t whole = 0;
    const fieldscribe_status status = fieldscribe_round_wide(number, &whole);
    return (status == FIELDSCRIBE_OK) ? fieldscribe_encode_u32(whole, low, high, raw) : status;
}

FIELDSCRIBE_STATUS fieldscribe_round_s32(double number, int64_t low, int64_t high, int32_t *raw)
{
    int64_t whole = 0;
    const fieldscribe_status status = fieldscribe_round_wide(number, &whole);
    return (status == FIELDSCRIBE_OK) ? fieldscribe_encode_s32(whole, low, high, raw) : status;
}

/* The number with that IEEE 754 bit pattern. */
static inline double fieldscribe_f64_of_bits(uint64_t bits)
{
    double number = 0;
    fieldscribe_copy(&number, &bits, sizeof number);
    return number;
}

/* The bit pattern of a double. */
static inline fieldscribe_whole fieldscribe_bits_of_f64(double number)
{
    uint64_t pattern = 0U;
    if (!((number >= -1.7976931348623157e+308) && (number <= 1.7976931348623157e+308))) {
        return fieldscribe_no_whole(fieldscribe_outside((number < 0) || (number >= 0)));
    }
    fieldscribe_copy(&pattern, &number, sizeof pattern);
    return fieldscribe_whole_of(fieldscribe_signed64(pattern));
}

/* Two to the power of an exponent of -1022..1023. */
static inline double fieldscribe_two_to(int32_t exponent)
{
    return fieldscribe_f64_of_bits((uint64_t)((uint32_t)(1023 + exponent)) << 52);
}

/* The number divided to the nearest double, ties to even; the divisor is below 2^63. */
static inline double fieldscribe_long_quotient(fieldscribe_u128 number, uint64_t divisor)
{
    const uint64_t exact = UINT64_C(1) << 53;
    uint64_t rest = 0U;
    uint64_t quotient = 0U;
    uint64_t tail;
    int32_t left;
    double value;
    /* 55 bits: two more than a double has; then the remainder */
    for (left = 128; (quotient < (exact * 2U)) && (left > -128); --left) {
        quotient = (quotient << 1) | fieldscribe_quotient_bit(&number, &rest, divisor);
    }
    tail = quotient & 3U;
    quotient >>= 2;
    if ((tail == 3U) || ((tail == 2U) && (((rest | number.high | number.low) != 0U) || ((quotient & 1U) != 0U)))) {
        ++quotient;
    }
    value = (double)quotient;
    for (left += 2; left > 0; --left) {
        value *= 2;
    }
    for (; left < 0; ++left) {
        value *= 0.5;
    }
    return value;
}

/*
 * (size * factor + add) / divisor as sign and magnitude, to the nearest double, ties to even: for numerators that a
 * double does not hold exactly. Factor, addend and divisor are below 2^63.
 */
static inline double fieldscribe_quotient(
    bool negative, uint64_t size, uint64_t factor, bool subtracts, uint64_t add, uint64_t divisor)
{
    const uint64_t exact = UINT64_C(1) << 53;
    bool below = negative;
    const fieldscribe_u128 number =
        fieldscribe_sum(fieldscribe_product(size, factor), add, negative != subtracts, &below);
    double value;
    if ((number.high | number.low) == 0U) {
        return 0;
    }
    if ((number.high == 0U) && (number.low <= exact) && (divisor <= exact)) {
        value = (double)number.low / (double)divisor;
    } else {
        value = fieldscribe_long_quotient(number, divisor);
    }
    return below ? -value : value;
}

/* The raw number of a value by a rule, if it is in low..high. */
static inline fieldscribe_whole fieldscribe_ruled_value(fieldscribe_rule rule, double value, int64_t low, int64_t high)
{
    double number;
    if (!((value < 0) || (value >= 0))) {
        return fieldscribe_no_whole(FIELDSCRIBE_NOT_A_NUMBER);
    }
    if (rule.status != FIELDSCRIBE_OK) {
        return fieldscribe_no_whole(rule.status);
    }
    number = fieldscribe_times_wide(value, (double)rule.num) / (double)rule.den;
    if (rule.shift != 0) {
        number *= fieldscribe_two_to(rule.shift); /* exact */
    }
    if (rule.offset != 0) {
        number += (double)rule.offset / (double)rule.parts;
    }
    return fieldscribe_rounded_wide(number, low, high);
}

/* The value of a raw number by a rule: one division of two exact integers gives the nearest double. */
FIELDSCRIBE_STATUS fieldscribe_decode_value(fieldscribe_rule rule, int64_t raw, double *value)
{
    int64_t number = 0;
    int64_t num = 0;
    if ((rule.status == FIELDSCRIBE_OK) &&
        ((!fieldscribe_multiply(raw, rule.parts, &number)) || (!fieldscribe_add(number, -rule.offset, &number)) ||
            (!fieldscribe_multiply(number, rule.den, &number)) ||
            (!fieldscribe_multiply(rule.num, rule.parts, &num)))) {
        rule.status = FIELDSCRIBE_OVERFLOW;
    }
    if (rule.status == FIELDSCRIBE_OK) {
        *value = (number == 0) ? 0.0 : ((double)number / (double)num); /* 0, never -0 */
        *value *= fieldscribe_two_to(-rule.shift); /* exact */
    }
    return rule.status;
}

/* The same by a 128-bit division, for numerators that no double holds; the raw number is sign and magnitude. */
FIELDSCRIBE_STATUS fieldscribe_decode_wide(fieldscribe_rule rule, bool negative, uint64_t size, double *value)
{
    const bool turned = (rule.num < 0) != (rule.den < 0);
    int64_t num = 0;
    int64_t den = 0;
    int64_t lift = 0;
    if ((rule.status == FIELDSCRIBE_OK) &&
        ((!fieldscribe_multiply(rule.num, rule.parts, &num)) || (!fieldscribe_multiply(rule.den, rule.parts, &den)) ||
            (!fieldscribe_multiply(rule.offset, rule.den, &lift)))) {
        rule.status = FIELDSCRIBE_OVERFLOW;
    }
    if (rule.status == FIELDSCRIBE_OK) {
        *value = fieldscribe_quotient(negative != turned, size, fieldscribe_magnitude(den), (rule.offset > 0) != turned,
            fieldscribe_magnitude(lift), fieldscribe_magnitude(num));
        *value *= fieldscribe_two_to(-rule.shift); /* exact */
    }
    return rule.status;
}

#endif
#if defined(FIELDSCRIBE_KEEP_PRECISE)
#pragma float_control(pop)
#endif
#endif

/* ---- Raw numbers in words ---- */

/*
 * The C type of a raw number; a floating-point pattern is U32 or U64. Points of the last three types have functions of
 * their own: ..._from_words and ..._to_words, or ..._extract and ..._insert for bits that share a word.
 */
typedef enum fieldscribe_type {
    FIELDSCRIBE_BIT,
    FIELDSCRIBE_U8,
    FIELDSCRIBE_S8,
    FIELDSCRIBE_U16,
    FIELDSCRIBE_S16,
    FIELDSCRIBE_U32,
    FIELDSCRIBE_S32,
    FIELDSCRIBE_U64,
    FIELDSCRIBE_S64,
    FIELDSCRIBE_LOW_FIRST,        /* any of the above, the low byte of each word first */
    FIELDSCRIBE_LOW_FIRST_SIGNED, /* the same, signed */
    FIELDSCRIBE_CODED             /* decimal digits, or sign and magnitude */
} fieldscribe_type;

/* The position of a raw number in words. */
typedef struct fieldscribe_layout {
    uint8_t type;        /* a fieldscribe_type */
    uint8_t words;       /* 1, 2 or 4 */
    uint16_t order;      /* the position of each word, one hexadecimal digit each, the high word first */
    bool shares;         /* other points have bits in its word: they are preserved */
    uint8_t shift;       /* the position of its lowest bit in the word */
    uint64_t mask;       /* its bits in the words */
    uint64_t fixed_mask; /* constant bits... */
    uint64_t fixed_bits; /* ...and their values */
} fieldscribe_layout;

#ifdef __cplusplus
extern "C" {
#endif

/*
 * The raw number in `count` words. False, with nothing stored, if the point's raw number has another type (which does
 * not depend on the words: test the call once), or if there are no words, or fewer than the point has. Each family
 * finds the words of a point in its own way: in a block (fieldscribe_modbus_words_in), in a telegram
 * (fieldscribe_can_received) or in process data (fieldscribe_uss_words_heard).
 */

FIELDSCRIBE_CHECKED bool fieldscribe_take_bit(
    const fieldscribe_layout *layout, const uint16_t *words, size_t count, bool *raw);

FIELDSCRIBE_CHECKED bool fieldscribe_take_u8(
    const fieldscribe_layout *layout, const uint16_t *words, size_t count, uint8_t *raw);

FIELDSCRIBE_CHECKED bool fieldscribe_take_s8(
    const fieldscribe_layout *layout, const uint16_t *words, size_t count, int8_t *raw);

FIELDSCRIBE_CHECKED bool fieldscribe_take_u16(
    const fieldscribe_layout *layout, const uint16_t *words, size_t count, uint16_t *raw);

FIELDSCRIBE_CHECKED bool fieldscribe_take_s16(
    const fieldscribe_layout *layout, const uint16_t *words, size_t count, int16_t *raw);

FIELDSCRIBE_CHECKED bool fieldscribe_take_u32(
    const fieldscribe_layout *layout, const uint16_t *words, size_t count, uint32_t *raw);

FIELDSCRIBE_CHECKED bool fieldscribe_take_s32(
    const fieldscribe_layout *layout, const uint16_t *words, size_t count, int32_t *raw);

FIELDSCRIBE_CHECKED bool fieldscribe_take_u64(
    const fieldscribe_layout *layout, const uint16_t *words, size_t count, uint64_t *raw);

FIELDSCRIBE_CHECKED bool fieldscribe_take_s64(
    const fieldscribe_layout *layout, const uint16_t *words, size_t count, int64_t *raw);

/*
 * Stores the raw number in words. For a point that shares its word, words[0] must hold the word as just read: only the
 * point's bits change. False, with nothing stored, if the raw number has another type or more bits than the point, or
 * if there are no words, or fewer than the point has. Limits are not checked: pass the result of ..._encode, or call
 * ..._check first.
 */

FIELDSCRIBE_CHECKED bool fieldscribe_put_bit(const fieldscribe_layout *layout, bool raw, uint16_t *words, size_t count);

FIELDSCRIBE_CHECKED bool fieldscribe_put_u8(
    const fieldscribe_layout *layout, uint8_t raw, uint16_t *words, size_t count);

FIELDSCRIBE_CHECKED bool fieldscribe_put_s8(
    const fieldscribe_layout *layout, int8_t raw, uint16_t *words, size_t count);

FIELDSCRIBE_CHECKED bool fieldscribe_put_u16(
    const fieldscribe_layout *layout, uint16_t raw, uint16_t *words, size_t count);

FIELDSCRIBE_CHECKED bool fieldscribe_put_s16(
    const fieldscribe_layout *layout, int16_t raw, uint16_t *words, size_t count);

FIELDSCRIBE_CHECKED bool fieldscribe_put_u32(
    const fieldscribe_layout *layout, uint32_t raw, uint16_t *words, size_t count);

FIELDSCRIBE_CHECKED bool fieldscribe_put_s32(
    const fieldscribe_layout *layout, int32_t raw, uint16_t *words, size_t count);

FIELDSCRIBE_CHECKED bool fieldscribe_put_u64(
    const fieldscribe_layout *layout, uint64_t raw, uint16_t *words, size_t count);

FIELDSCRIBE_CHECKED bool fieldscribe_put_s64(
    const fieldscribe_layout *layout, int64_t raw, uint16_t *words, size_t count);

/* A text: the address of each of its words, in reading order. */
typedef struct fieldscribe_text {
    const uint16_t *addresses;
    uint16_t first; /* the lowest address */
    uint16_t words;
} fieldscribe_text;
/*
 * Words from the order of their addresses, as in frames, to reading order, and back. False, with nothing stored, if an
 * array is NULL or has fewer words than the text; `count` and `room` are their sizes.
 */
FIELDSCRIBE_CHECKED bool fieldscribe_take_text(
    const fieldscribe_text *text, const uint16_t *words, size_t count, uint16_t *reading, size_t room);
FIELDSCRIBE_CHECKED bool fieldscribe_put_text(
    const fieldscribe_text *text, const uint16_t *reading, size_t count, uint16_t *words, size_t room);

#ifdef __cplusplus
}
#endif

#endif

/* ---- Definitions ---- */

#if defined(FIELDSCRIBE_IMPLEMENTATION) && !defined(FIELDSCRIBE_IMPLEMENTED)
#define FIELDSCRIBE_IMPLEMENTED

/* True if the layout has this type, and there are enough words. */
static bool fieldscribe_layout_fits(
    const fieldscribe_layout *layout, const uint16_t *words, size_t count, fieldscribe_type type)
{
    return (layout != NULL) && (words != NULL) && (layout->type == (uint8_t)type) && (count >= layout->words);
}

/* The position of a word; `significance` is 0 for the low word. */
static size_t fieldscribe_layout_place(const fieldscribe_layout *layout, uint8_t significance)
{
    return ((size_t)layout->order >> (4U * significance)) & 0xFU;
}

/* The low 32 bits of the words as one number. */
static uint32_t fieldscribe_layout_joined(const fieldscribe_layout *layout, const uint16_t *words)
{
    uint32_t number = 0U;
    uint8_t left;
    for (left = layout->words; left > 0U; --left) {
        number = (number << 16) | words[fieldscribe_layout_place(layout, (uint8_t)(left - 1U))];
    }
    return number;
}

/* All bits of the words. */
static uint64_t fieldscribe_layout_joined_wide(const fieldscribe_layout *layout, const uint16_t *words)
{
    uint64_t number = 0U;
    uint8_t left;
    for (left = layout->words; left > 0U; --left) {
        number = (number << 16) | words[fieldscribe_layout_place(layout, (uint8_t)(left - 1U))];
    }
    return number;
}

/* The bits of the point, right-aligned. */
static uint32_t fieldscribe_layout_field(const fieldscribe_layout *layout, const uint16_t *words)
{
    return (fieldscribe_layout_joined(layout, words) & (uint32_t)(layout->mask & 0xFFFFFFFFU)) >> layout->shift;
}

/* The largest number that the bits of the point can hold. */
static uint32_t fieldscribe_layout_most(const fieldscribe_layout *layout)
{
    return (uint32_t)(layout->mask & 0xFFFFFFFFU) >> layout->shift;
}

/* The bits of the point as a number in two's complement. */
static int32_t fieldscribe_layout_signed_field(const fieldscribe_layout *layout, const uint16_t *words)
{
    const uint32_t field = fieldscribe_layout_field(layout, words);
    const uint32_t most = fieldscribe_layout_most(layout) >> 1;
    return (field > most) ? (-1 - (int32_t)(~field & most)) : (int32_t)field;
}

/* Store the words at their positions. */
static void fieldscribe_layout_store(const fieldscribe_layout *layout, uint64_t number, uint16_t *words)
{
    uint64_t left = (number & ~layout->fixed_mask) | layout->fixed_bits;
    uint8_t at;
    for (at = 0U; at < layout->words; ++at) {
        words[fieldscribe_layout_place(layout, at)] = (uint16_t)(left & 0xFFFFU);
        left >>= 16;
    }
}

/* Store bits that fit: preserve the other bits of a shared word; otherwise extend the sign. */
static void fieldscribe_layout_put_bits(const fieldscribe_layout *layout, uint32_t bits, uint16_t *words)
{
    uint32_t number = bits;
    if (layout->shares) {
        const uint32_t mask = (uint32_t)(layout->mask & 0xFFFFU);
        number = (words[0] & ~mask) | ((bits & fieldscribe_layout_most(layout)) << layout->shift);
    }
    fieldscribe_layout_store(layout, number, words);
}

/* Store an unsigned number; false if it has more bits than the point. */
static bool fieldscribe_layout_put(const fieldscribe_layout *layout, uint32_t raw, uint16_t *words)
{
    if (raw > fieldscribe_layout_most(layout)) {
        return false;
    }
    fieldscribe_layout_put_bits(layout, raw, words);
    return true;
}

/* The same for a number in two's complement. */
static bool fieldscribe_layout_put_signed(const fieldscribe_layout *layout, int32_t raw, uint16_t *words)
{
    const uint32_t size = (raw < 0) ? (uint32_t)(-1 - raw) : (uint32_t)raw;
    if (size > (fieldscribe_layout_most(layout) >> 1)) {
        return false;
    }
    fieldscribe_layout_put_bits(layout, (raw < 0) ? ~size : size, words);
    return true;
}

bool fieldscribe_take_bit(const fieldscribe_layout *layout, const uint16_t *words, size_t count, bool *raw)
{
    if (!fieldscribe_layout_fits(layout, words, count, FIELDSCRIBE_BIT)) {
        return false;
    }
    *raw = fieldscribe_layout_field(layout, words) != 0U;
    return true;
}

bool fieldscribe_take_u8(const fieldscribe_layout *layout, const uint16_t *words, size_t count, uint8_t *raw)
{
    if (!fieldscribe_layout_fits(layout, words, count, FIELDSCRIBE_U8)) {
        return false;
    }
    *raw = (uint8_t)(fieldscribe_layout_field(layout, words) & 0xFFU);
    return true;
}

bool fieldscribe_take_s8(const fieldscribe_layout *layout, const uint16_t *words, size_t count, int8_t *raw)
{
    if (!fieldscribe_layout_fits(layout, words, count, FIELDSCRIBE_S8)) {
        return false;
    }
    *raw = (int8_t)fieldscribe_layout_signed_field(layout, words);
    return true;
}

bool fieldscribe_take_u16(const fieldscribe_layout *layout, const uint16_t *words, size_t count, uint16_t *raw)
{
    if (!fieldscribe_layout_fits(layout, words, count, FIELDSCRIBE_U16)) {
        return false;
    }
    *raw = (uint16_t)(fieldscribe_layout_field(layout, words) & 0xFFFFU);
    return true;
}

bool fieldscribe_take_s16(const fieldscribe_layout *layout, const uint16_t *words, size_t count, int16_t *raw)
{
    if (!fieldscribe_layout_fits(layout, words, count, FIELDSCRIBE_S16)) {
        return false;
    }
    *raw = (int16_t)fieldscribe_layout_signed_field(layout, words);
    return true;
}

bool fieldscribe_take_u32(const fieldscribe_layout *layout, const uint16_t *words, size_t count, uint32_t *raw)
{
    if (!fieldscribe_layout_fits(layout, words, count, FIELDSCRIBE_U32)) {
        return false;
    }
    *raw = fieldscribe_layout_field(layout, words);
    return true;
}

bool fieldscribe_take_s32(const fieldscribe_layout *layout, const uint16_t *words, size_t count, int32_t *raw)
{
    if (!fieldscribe_layout_fits(layout, words, count, FIELDSCRIBE_S32)) {
        return false;
    }
    *raw = fieldscribe_layout_signed_field(layout, words);
    return true;
}

bool fieldscribe_take_u64(const fieldscribe_layout *layout, const uint16_t *words, size_t count, uint64_t *raw)
{
    if (!fieldscribe_layout_fits(layout, words, count, FIELDSCRIBE_U64)) {
        return false;
    }
    *raw = fieldscribe_layout_joined_wide(layout, words) & layout->mask;
    return true;
}

bool fieldscribe_take_s64(const fieldscribe_layout *layout, const uint16_t *words, size_t count, int64_t *raw)
{
    uint64_t most;
    uint64_t bits;
    if (!fieldscribe_layout_fits(layout, words, count, FIELDSCRIBE_S64)) {
        return false;
    }
    most = layout->mask >> 1;
    bits = fieldscribe_layout_joined_wide(layout, words) & layout->mask;
    *raw = (bits > most) ? (-1 - (int64_t)(~bits & most)) : (int64_t)bits;
    return true;
}

bool fieldscribe_put_bit(const fieldscribe_layout *layout, bool raw, uint16_t *words, size_t count)
{
    return fieldscribe_layout_fits(layout, words, count, FIELDSCRIBE_BIT) &&
        fieldscribe_layout_put(layout, raw ? 1U : 0U, words);
}

bool fieldscribe_put_u8(const fieldscribe_layout *layout, uint8_t raw, uint16_t *words, size_t count)
{
    return fieldscribe_layout_fits(layout, words, count, FIELDSCRIBE_U8) && fieldscribe_layout_put(layout, raw, words);
}

bool fieldscribe_put_s8(const fieldscribe_layout *layout, int8_t raw, uint16_t *words, size_t count)
{
    return fieldscribe_layout_fits(layout, words, count, FIELDSCRIBE_S8) &&
        fieldscribe_layout_put_signed(layout, raw, words);
}

bool fieldscribe_put_u16(const fieldscribe_layout *layout, uint16_t raw, uint16_t *words, size_t count)
{
    return fieldscribe_layout_fits(layout, words, count, FIELDSCRIBE_U16) && fieldscribe_layout_put(layout, raw, words);
}

bool fieldscribe_put_s16(const fieldscribe_layout *layout, int16_t raw, uint16_t *words, size_t count)
{
    return fieldscribe_layout_fits(layout, words, count, FIELDSCRIBE_S16) &&
        fieldscribe_layout_put_signed(layout, raw, words);
}

bool fieldscribe_put_u32(const fieldscribe_layout *layout, uint32_t raw, uint16_t *words, size_t count)
{
    return fieldscribe_layout_fits(layout, words, count, FIELDSCRIBE_U32) && fieldscribe_layout_put(layout, raw, words);
}

bool fieldscribe_put_s32(const fieldscribe_layout *layout, int32_t raw, uint16_t *words, size_t count)
{
    return fieldscribe_layout_fits(layout, words, count, FIELDSCRIBE_S32) &&
        fieldscribe_layout_put_signed(layout, raw, words);
}

bool fieldscribe_put_u64(const fieldscribe_layout *layout, uint64_t raw, uint16_t *words, size_t count)
{
    if (!fieldscribe_layout_fits(layout, words, count, FIELDSCRIBE_U64) || (raw > layout->mask)) {
        return false;
    }
    fieldscribe_layout_store(layout, raw, words);
    return true;
}

bool fieldscribe_put_s64(const fieldscribe_layout *layout, int64_t raw, uint16_t *words, size_t count)
{
    const uint64_t size = (raw < 0) ? (uint64_t)(-1 - raw) : (uint64_t)raw;
    if (!fieldscribe_layout_fits(layout, words, count, FIELDSCRIBE_S64) || (size > (layout->mask >> 1))) {
        return false;
    }
    fieldscribe_layout_store(layout, (raw < 0) ? ~size : size, words);
    return true;
}

bool fieldscribe_take_text(
    const fieldscribe_text *text, const uint16_t *words, size_t count, uint16_t *reading, size_t room)
{
    size_t at;
    if ((text == NULL) || (words == NULL) || (reading == NULL) || (count < text->words) || (room < text->words)) {
        return false;
    }
    for (at = 0U; at < text->words; ++at) {
        reading[at] = words[text->addresses[at] - text->first];
    }
    return true;
}

bool fieldscribe_put_text(
    const fieldscribe_text *text, const uint16_t *reading, size_t count, uint16_t *words, size_t room)
{
    size_t at;
    if ((text == NULL) || (words == NULL) || (reading == NULL) || (count < text->words) || (room < text->words)) {
        return false;
    }
    for (at = 0U; at < text->words; ++at) {
        words[text->addresses[at] - text->first] = reading[at];
    }
    return true;
}

#endif
