/*
 * What all generated headers share: how raw numbers lie in words of 16 bits.
 *
 * Declarations may be included anywhere. The functions are defined once in a program: one C file, and no other, says
 * `#define FIELDSCRIBE_IMPLEMENTATION` before it includes the headers of frames that the program uses.
 *
 * SPDX-License-Identifier: 0BSD
 */
#ifndef FIELDSCRIBE_H
#define FIELDSCRIBE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The compiler warns where the result is dropped. */
#if defined(__cplusplus) && (__cplusplus >= 201703L)
#define FIELDSCRIBE_CHECKED [[nodiscard]]
#elif defined(__STDC_VERSION__) && (__STDC_VERSION__ >= 202311L)
#define FIELDSCRIBE_CHECKED [[nodiscard]]
#elif defined(__GNUC__)
#define FIELDSCRIBE_CHECKED __attribute__((warn_unused_result))
#else
#define FIELDSCRIBE_CHECKED
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Raw numbers in words ---- */

/* The C type of a raw number; the pattern of a floating-point number is U32 or U64. */
typedef enum fieldscribe_type {
    FIELDSCRIBE_BIT,
    FIELDSCRIBE_U8,
    FIELDSCRIBE_S8,
    FIELDSCRIBE_U16,
    FIELDSCRIBE_S16,
    FIELDSCRIBE_U32,
    FIELDSCRIBE_S32,
    FIELDSCRIBE_U64,
    FIELDSCRIBE_S64
} fieldscribe_type;

/* How a raw number lies in words. */
typedef struct fieldscribe_layout {
    uint8_t type;        /* a fieldscribe_type */
    uint8_t words;       /* 1, 2 or 4 */
    uint16_t order;      /* a hexadecimal digit a word, the high word first: its place (0x01: high word first) */
    bool shares;         /* the other bits of its word are other points: they go back as they were read */
    uint8_t shift;       /* its lowest bit in the word */
    uint64_t mask;       /* its bits in the words */
    uint64_t fixed_mask; /* bits that are always written as... */
    uint64_t fixed_bits; /* ...these */
} fieldscribe_layout;

/*
 * The raw number out of words. False, and nothing stored, when the point's raw number has another type: a call that
 * is right once is always right.
 */
FIELDSCRIBE_CHECKED bool fieldscribe_take_bit(const fieldscribe_layout *layout, const uint16_t *words, bool *raw);
FIELDSCRIBE_CHECKED bool fieldscribe_take_u8(const fieldscribe_layout *layout, const uint16_t *words, uint8_t *raw);
FIELDSCRIBE_CHECKED bool fieldscribe_take_s8(const fieldscribe_layout *layout, const uint16_t *words, int8_t *raw);
FIELDSCRIBE_CHECKED bool fieldscribe_take_u16(const fieldscribe_layout *layout, const uint16_t *words, uint16_t *raw);
FIELDSCRIBE_CHECKED bool fieldscribe_take_s16(const fieldscribe_layout *layout, const uint16_t *words, int16_t *raw);
FIELDSCRIBE_CHECKED bool fieldscribe_take_u32(const fieldscribe_layout *layout, const uint16_t *words, uint32_t *raw);
FIELDSCRIBE_CHECKED bool fieldscribe_take_s32(const fieldscribe_layout *layout, const uint16_t *words, int32_t *raw);
FIELDSCRIBE_CHECKED bool fieldscribe_take_u64(const fieldscribe_layout *layout, const uint16_t *words, uint64_t *raw);
FIELDSCRIBE_CHECKED bool fieldscribe_take_s64(const fieldscribe_layout *layout, const uint16_t *words, int64_t *raw);

/*
 * The raw number into words. A point that shares its word changes its own bits alone: words[0] must hold the word as
 * it was just read. False, and nothing stored, when the raw number has another type or more bits than the point.
 */
FIELDSCRIBE_CHECKED bool fieldscribe_put_bit(const fieldscribe_layout *layout, bool raw, uint16_t *words);
FIELDSCRIBE_CHECKED bool fieldscribe_put_u8(const fieldscribe_layout *layout, uint8_t raw, uint16_t *words);
FIELDSCRIBE_CHECKED bool fieldscribe_put_s8(const fieldscribe_layout *layout, int8_t raw, uint16_t *words);
FIELDSCRIBE_CHECKED bool fieldscribe_put_u16(const fieldscribe_layout *layout, uint16_t raw, uint16_t *words);
FIELDSCRIBE_CHECKED bool fieldscribe_put_s16(const fieldscribe_layout *layout, int16_t raw, uint16_t *words);
FIELDSCRIBE_CHECKED bool fieldscribe_put_u32(const fieldscribe_layout *layout, uint32_t raw, uint16_t *words);
FIELDSCRIBE_CHECKED bool fieldscribe_put_s32(const fieldscribe_layout *layout, int32_t raw, uint16_t *words);
FIELDSCRIBE_CHECKED bool fieldscribe_put_u64(const fieldscribe_layout *layout, uint64_t raw, uint16_t *words);
FIELDSCRIBE_CHECKED bool fieldscribe_put_s64(const fieldscribe_layout *layout, int64_t raw, uint16_t *words);

/* A text: where each of its words is, in the order of reading. */
typedef struct fieldscribe_text {
    const uint16_t *addresses;
    uint16_t first; /* the lowest of them */
    uint16_t words;
} fieldscribe_text;

/* Words in the order of their addresses, as frames carry them, into the order of reading, and back. */
void fieldscribe_take_text(const fieldscribe_text *text, const uint16_t *words, uint16_t *reading);
void fieldscribe_put_text(const fieldscribe_text *text, const uint16_t *reading, uint16_t *words);

#ifdef __cplusplus
}
#endif

#endif

/* ---- The one definition ---- */

#if defined(FIELDSCRIBE_IMPLEMENTATION) && !defined(FIELDSCRIBE_IMPLEMENTED)
#define FIELDSCRIBE_IMPLEMENTED

#ifdef __cplusplus
extern "C" {
#endif

/* Where a word stands; `significance` counts from the low word. */
static size_t fieldscribe_layout_place(const fieldscribe_layout *layout, uint8_t significance)
{
    return ((size_t)layout->order >> (4U * significance)) & 0xFU;
}

/* The low 32 bits of the words, one number. */
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
    return (field > most) ? (-1 - (int32_t)(~field & most)) : (int32_t)(field & most);
}

/* Puts words in their places. */
static void fieldscribe_layout_store(const fieldscribe_layout *layout, uint64_t number, uint16_t *words)
{
    uint64_t left = (number & ~layout->fixed_mask) | layout->fixed_bits;
    uint8_t at;
    for (at = 0U; at < layout->words; ++at) {
        words[fieldscribe_layout_place(layout, at)] = (uint16_t)(left & 0xFFFFU);
        left >>= 16;
    }
}

/* Stores bits that fit: in a word that is shared beside the others, else with the sign above them. */
static void fieldscribe_layout_put_bits(const fieldscribe_layout *layout, uint32_t bits, uint16_t *words)
{
    uint32_t number = bits;
    if (layout->shares) {
        const uint32_t mask = (uint32_t)(layout->mask & 0xFFFFU);
        number = (words[0] & ~mask) | ((bits & fieldscribe_layout_most(layout)) << layout->shift);
    }
    fieldscribe_layout_store(layout, number, words);
}

/* Stores a number from 0 on; false when it has more bits than the point. */
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

bool fieldscribe_take_bit(const fieldscribe_layout *layout, const uint16_t *words, bool *raw)
{
    if (layout->type != (uint8_t)FIELDSCRIBE_BIT) {
        return false;
    }
    *raw = fieldscribe_layout_field(layout, words) != 0U;
    return true;
}

bool fieldscribe_take_u8(const fieldscribe_layout *layout, const uint16_t *words, uint8_t *raw)
{
    if (layout->type != (uint8_t)FIELDSCRIBE_U8) {
        return false;
    }
    *raw = (uint8_t)(fieldscribe_layout_field(layout, words) & 0xFFU);
    return true;
}

bool fieldscribe_take_s8(const fieldscribe_layout *layout, const uint16_t *words, int8_t *raw)
{
    if (layout->type != (uint8_t)FIELDSCRIBE_S8) {
        return false;
    }
    *raw = (int8_t)fieldscribe_layout_signed_field(layout, words);
    return true;
}

bool fieldscribe_take_u16(const fieldscribe_layout *layout, const uint16_t *words, uint16_t *raw)
{
    if (layout->type != (uint8_t)FIELDSCRIBE_U16) {
        return false;
    }
    *raw = (uint16_t)(fieldscribe_layout_field(layout, words) & 0xFFFFU);
    return true;
}

bool fieldscribe_take_s16(const fieldscribe_layout *layout, const uint16_t *words, int16_t *raw)
{
    if (layout->type != (uint8_t)FIELDSCRIBE_S16) {
        return false;
    }
    *raw = (int16_t)fieldscribe_layout_signed_field(layout, words);
    return true;
}

bool fieldscribe_take_u32(const fieldscribe_layout *layout, const uint16_t *words, uint32_t *raw)
{
    if (layout->type != (uint8_t)FIELDSCRIBE_U32) {
        return false;
    }
    *raw = fieldscribe_layout_field(layout, words);
    return true;
}

bool fieldscribe_take_s32(const fieldscribe_layout *layout, const uint16_t *words, int32_t *raw)
{
    if (layout->type != (uint8_t)FIELDSCRIBE_S32) {
        return false;
    }
    *raw = fieldscribe_layout_signed_field(layout, words);
    return true;
}

bool fieldscribe_take_u64(const fieldscribe_layout *layout, const uint16_t *words, uint64_t *raw)
{
    if (layout->type != (uint8_t)FIELDSCRIBE_U64) {
        return false;
    }
    *raw = fieldscribe_layout_joined_wide(layout, words) & layout->mask;
    return true;
}

bool fieldscribe_take_s64(const fieldscribe_layout *layout, const uint16_t *words, int64_t *raw)
{
    const uint64_t most = layout->mask >> 1;
    uint64_t bits;
    if (layout->type != (uint8_t)FIELDSCRIBE_S64) {
        return false;
    }
    bits = fieldscribe_layout_joined_wide(layout, words) & layout->mask;
    *raw = (bits > most) ? (-1 - (int64_t)(~bits & most)) : (int64_t)(bits & most);
    return true;
}

bool fieldscribe_put_bit(const fieldscribe_layout *layout, bool raw, uint16_t *words)
{
    return (layout->type == (uint8_t)FIELDSCRIBE_BIT) && fieldscribe_layout_put(layout, raw ? 1U : 0U, words);
}

bool fieldscribe_put_u8(const fieldscribe_layout *layout, uint8_t raw, uint16_t *words)
{
    return (layout->type == (uint8_t)FIELDSCRIBE_U8) && fieldscribe_layout_put(layout, raw, words);
}

bool fieldscribe_put_s8(const fieldscribe_layout *layout, int8_t raw, uint16_t *words)
{
    return (layout->type == (uint8_t)FIELDSCRIBE_S8) && fieldscribe_layout_put_signed(layout, raw, words);
}

bool fieldscribe_put_u16(const fieldscribe_layout *layout, uint16_t raw, uint16_t *words)
{
    return (layout->type == (uint8_t)FIELDSCRIBE_U16) && fieldscribe_layout_put(layout, raw, words);
}

bool fieldscribe_put_s16(const fieldscribe_layout *layout, int16_t raw, uint16_t *words)
{
    return (layout->type == (uint8_t)FIELDSCRIBE_S16) && fieldscribe_layout_put_signed(layout, raw, words);
}

bool fieldscribe_put_u32(const fieldscribe_layout *layout, uint32_t raw, uint16_t *words)
{
    return (layout->type == (uint8_t)FIELDSCRIBE_U32) && fieldscribe_layout_put(layout, raw, words);
}

bool fieldscribe_put_s32(const fieldscribe_layout *layout, int32_t raw, uint16_t *words)
{
    return (layout->type == (uint8_t)FIELDSCRIBE_S32) && fieldscribe_layout_put_signed(layout, raw, words);
}

bool fieldscribe_put_u64(const fieldscribe_layout *layout, uint64_t raw, uint16_t *words)
{
    if (layout->type != (uint8_t)FIELDSCRIBE_U64) {
        return false;
    }
    fieldscribe_layout_store(layout, raw, words);
    return true;
}

bool fieldscribe_put_s64(const fieldscribe_layout *layout, int64_t raw, uint16_t *words)
{
    if (layout->type != (uint8_t)FIELDSCRIBE_S64) {
        return false;
    }
    fieldscribe_layout_store(layout, (raw < 0) ? ~(uint64_t)(-1 - raw) : (uint64_t)raw, words);
    return true;
}

void fieldscribe_take_text(const fieldscribe_text *text, const uint16_t *words, uint16_t *reading)
{
    size_t at;
    for (at = 0U; at < text->words; ++at) {
        reading[at] = words[text->addresses[at] - text->first];
    }
}

void fieldscribe_put_text(const fieldscribe_text *text, const uint16_t *reading, uint16_t *words)
{
    size_t at;
    for (at = 0U; at < text->words; ++at) {
        words[text->addresses[at] - text->first] = reading[at];
    }
}

#ifdef __cplusplus
}
#endif

#endif
