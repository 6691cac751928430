/*
 * Proofs of how raw numbers lie in words (fieldscribe.h): one harness or more for each of its functions, named
 * prove_FUNCTION or prove_FUNCTION__WHAT. A layout is any that a table of ours can hold: of 1, 2 or 4 words, each in a
 * place of its own among them, bits that are in the words, and no more than the type has.
 */
#define FIELDSCRIBE_IMPLEMENTATION
#include "arbitrary.h"
#include "fieldscribe.h"

#define TEXT 12U

static fieldscribe_layout layout;
static fieldscribe_text text;
static uint16_t words[4];
static uint16_t reading[TEXT];
static uint16_t addressed[TEXT];
static uint16_t addresses[TEXT];
static volatile uint8_t number;

/* A layout of so many words in any order, with the mask at any shift. */
static void lay(uint8_t type, uint8_t count)
{
    layout.type = type;
    layout.words = count;
    layout.shares = number % 2U != 0U;
    layout.order = count == 4U ? 0x0123U : count == 2U ? (number % 2U != 0U ? 0x01U : 0x10U) : 0x00U;
    layout.shift = (uint8_t)(layout.shift & 0xFU);
}

static uint16_t *own(uint8_t count)
{
    return EXACTLY(count, words);
}

/* Words that are told to be fewer than the point has are not touched. */
void prove_layout_fits(uint8_t type, size_t count)
{
    uint16_t raw;
    if (count <= 4U) {
        //@ split count;
        lay(type, 1U);
        (void)fieldscribe_layout_fits(&layout, own((uint8_t)count), count, FIELDSCRIBE_U16);
        layout.mask = layout.mask & 0xFFFFU;
        (void)fieldscribe_take_u16(&layout, own((uint8_t)count), count, &raw);
        (void)fieldscribe_take_u16(&layout, NULL, count, &raw);
        (void)fieldscribe_take_u16(NULL, own((uint8_t)count), count, &raw);
    }
}

void prove_layout_fits__two(uint8_t type, size_t count, uint32_t raw)
{
    if (count <= 4U) {
        //@ split count;
        lay(type, 2U);
        (void)fieldscribe_layout_fits(&layout, own((uint8_t)count), count, FIELDSCRIBE_U32);
        (void)fieldscribe_put_u32(&layout, raw, own((uint8_t)count), count);
        (void)fieldscribe_put_u32(&layout, raw, NULL, count);
    }
}

void prove_layout_place(uint8_t significance)
{
    lay(layout.type, 4U);
    if (significance < 4U) {
        (void)fieldscribe_layout_place(&layout, significance);
    }
}

void prove_layout_joined(void)
{
    lay(layout.type, 1U);
    (void)fieldscribe_layout_joined(&layout, own(1U));
    lay(layout.type, 2U);
    (void)fieldscribe_layout_joined(&layout, own(2U));
}

void prove_layout_field(void)
{
    lay(layout.type, 1U);
    (void)fieldscribe_layout_field(&layout, own(1U));
    lay(layout.type, 2U);
    (void)fieldscribe_layout_field(&layout, own(2U));
}

void prove_layout_most(void)
{
    lay(layout.type, 1U);
    (void)fieldscribe_layout_most(&layout);
    lay(layout.type, 2U);
    (void)fieldscribe_layout_most(&layout);
}

void prove_layout_signed_field(void)
{
    lay(layout.type, 1U);
    (void)fieldscribe_layout_signed_field(&layout, own(1U));
    lay(layout.type, 2U);
    (void)fieldscribe_layout_signed_field(&layout, own(2U));
}

void prove_layout_joined_wide(void)
{
    lay(layout.type, 4U);
    (void)fieldscribe_layout_joined_wide(&layout, own(4U));
}

void prove_layout_store(uint64_t bits)
{
    lay(layout.type, 1U);
    fieldscribe_layout_store(&layout, bits, own(1U));
    lay(layout.type, 2U);
    fieldscribe_layout_store(&layout, bits, own(2U));
    lay(layout.type, 4U);
    fieldscribe_layout_store(&layout, bits, own(4U));
}

void prove_layout_put_bits(uint32_t raw)
{
    lay(layout.type, 1U);
    fieldscribe_layout_put_bits(&layout, raw, own(1U));
    lay(layout.type, 2U);
    fieldscribe_layout_put_bits(&layout, raw, own(2U));
}

void prove_layout_put(uint32_t raw)
{
    lay(layout.type, 1U);
    (void)fieldscribe_layout_put(&layout, raw, own(1U));
    lay(layout.type, 2U);
    (void)fieldscribe_layout_put(&layout, raw, own(2U));
}

void prove_layout_put_signed(int32_t raw)
{
    lay(layout.type, 1U);
    (void)fieldscribe_layout_put_signed(&layout, raw, own(1U));
    lay(layout.type, 2U);
    (void)fieldscribe_layout_put_signed(&layout, raw, own(2U));
}

void prove_take_bit(uint8_t type)
{
    bool raw;
    lay(type, 1U);
    (void)fieldscribe_take_bit(&layout, own(1U), 1U, &raw);
}

void prove_put_bit(void)
{
    lay((uint8_t)FIELDSCRIBE_BIT, 1U);
    (void)fieldscribe_put_bit(&layout, number % 2U != 0U, own(1U), 1U);
    lay((uint8_t)(FIELDSCRIBE_BIT + 1U), 1U);
    (void)fieldscribe_put_bit(&layout, number % 2U != 0U, own(1U), 1U);
}

void prove_take_u8(uint8_t type, uint8_t shift)
{
    uint8_t raw;
    if (shift <= 8U) {
        //@ split shift;
        lay(type, 1U);
        layout.shift = shift;
        layout.mask = (layout.mask & 0xFFU) << shift;
        (void)fieldscribe_take_u8(&layout, own(1U), 1U, &raw);
    }
}

void prove_put_u8(uint8_t raw)
{
    lay((uint8_t)FIELDSCRIBE_U8, 1U);
    (void)fieldscribe_put_u8(&layout, raw, own(1U), 1U);
    lay((uint8_t)(FIELDSCRIBE_U8 + 1U), 1U);
    (void)fieldscribe_put_u8(&layout, raw, own(1U), 1U);
}

void prove_take_s8(uint8_t type, uint8_t shift)
{
    int8_t raw;
    if (shift <= 8U) {
        //@ split shift;
        lay(type, 1U);
        layout.shift = shift;
        layout.mask = (layout.mask & 0xFFU) << shift;
        (void)fieldscribe_take_s8(&layout, own(1U), 1U, &raw);
    }
}

void prove_put_s8(int8_t raw)
{
    lay((uint8_t)FIELDSCRIBE_S8, 1U);
    (void)fieldscribe_put_s8(&layout, raw, own(1U), 1U);
    lay((uint8_t)(FIELDSCRIBE_S8 + 1U), 1U);
    (void)fieldscribe_put_s8(&layout, raw, own(1U), 1U);
}

void prove_take_u16(uint8_t type)
{
    uint16_t raw;
    lay(type, 1U);
    layout.mask = layout.mask & 0xFFFFU;
    (void)fieldscribe_take_u16(&layout, own(1U), 1U, &raw);
}

void prove_put_u16(uint16_t raw)
{
    lay((uint8_t)FIELDSCRIBE_U16, 1U);
    (void)fieldscribe_put_u16(&layout, raw, own(1U), 1U);
    lay((uint8_t)(FIELDSCRIBE_U16 + 1U), 1U);
    (void)fieldscribe_put_u16(&layout, raw, own(1U), 1U);
}

void prove_take_s16(uint8_t type)
{
    int16_t raw;
    lay(type, 1U);
    layout.mask = layout.mask & 0xFFFFU;
    (void)fieldscribe_take_s16(&layout, own(1U), 1U, &raw);
}

void prove_put_s16(int16_t raw)
{
    lay((uint8_t)FIELDSCRIBE_S16, 1U);
    (void)fieldscribe_put_s16(&layout, raw, own(1U), 1U);
    lay((uint8_t)(FIELDSCRIBE_S16 + 1U), 1U);
    (void)fieldscribe_put_s16(&layout, raw, own(1U), 1U);
}

void prove_take_u32(uint8_t type)
{
    uint32_t raw;
    lay(type, 2U);
    layout.mask = layout.mask & 0xFFFFFFFFU;
    (void)fieldscribe_take_u32(&layout, own(2U), 2U, &raw);
}

void prove_put_u32(uint32_t raw)
{
    lay((uint8_t)FIELDSCRIBE_U32, 2U);
    (void)fieldscribe_put_u32(&layout, raw, own(2U), 2U);
    lay((uint8_t)(FIELDSCRIBE_U32 + 1U), 2U);
    (void)fieldscribe_put_u32(&layout, raw, own(2U), 2U);
}

void prove_take_s32(uint8_t type)
{
    int32_t raw;
    lay(type, 2U);
    layout.mask = layout.mask & 0xFFFFFFFFU;
    (void)fieldscribe_take_s32(&layout, own(2U), 2U, &raw);
}

void prove_put_s32(int32_t raw)
{
    lay((uint8_t)FIELDSCRIBE_S32, 2U);
    (void)fieldscribe_put_s32(&layout, raw, own(2U), 2U);
    lay((uint8_t)(FIELDSCRIBE_S32 + 1U), 2U);
    (void)fieldscribe_put_s32(&layout, raw, own(2U), 2U);
}

void prove_take_u64(uint8_t type)
{
    uint64_t raw;
    lay(type, 4U);
    (void)fieldscribe_take_u64(&layout, own(4U), 4U, &raw);
}

void prove_put_u64(uint64_t raw)
{
    lay((uint8_t)FIELDSCRIBE_U64, 4U);
    (void)fieldscribe_put_u64(&layout, raw, own(4U), 4U);
    lay((uint8_t)(FIELDSCRIBE_U64 + 1U), 4U);
    (void)fieldscribe_put_u64(&layout, raw, own(4U), 4U);
}

void prove_take_s64(uint8_t type)
{
    int64_t raw;
    lay(type, 4U);
    (void)fieldscribe_take_s64(&layout, own(4U), 4U, &raw);
}

void prove_put_s64(int64_t raw)
{
    lay((uint8_t)FIELDSCRIBE_S64, 4U);
    (void)fieldscribe_put_s64(&layout, raw, own(4U), 4U);
    lay((uint8_t)(FIELDSCRIBE_S64 + 1U), 4U);
    (void)fieldscribe_put_s64(&layout, raw, own(4U), 4U);
}

/* The words of a text lie anywhere among them. */
static void write_text(uint16_t count)
{
    size_t at;
    //@ loop unroll TEXT;
    for (at = 0U; at < count; ++at) {
        addresses[at] = (uint16_t)(1000U + addresses[at] % count);
    }
    text.addresses = addresses;
    text.first = 1000U;
    text.words = count;
}

void prove_take_text(uint16_t count)
{
    if (count > 0U && count <= TEXT) {
        //@ split count;
        write_text(count);
        (void)fieldscribe_take_text(&text, EXACTLY(count, addressed), count, EXACTLY(count, reading), count);
        (void)fieldscribe_take_text(&text, EXACTLY(count - 1U, addressed), count - 1U, reading, TEXT);
        (void)fieldscribe_take_text(&text, addressed, TEXT, EXACTLY(count - 1U, reading), count - 1U);
        (void)fieldscribe_take_text(&text, NULL, TEXT, reading, TEXT);
        (void)fieldscribe_take_text(&text, addressed, TEXT, NULL, TEXT);
    }
}

void prove_put_text(uint16_t count)
{
    if (count > 0U && count <= TEXT) {
        //@ split count;
        write_text(count);
        (void)fieldscribe_put_text(&text, EXACTLY(count, reading), count, EXACTLY(count, addressed), count);
        (void)fieldscribe_put_text(&text, EXACTLY(count - 1U, reading), count - 1U, addressed, TEXT);
        (void)fieldscribe_put_text(&text, reading, TEXT, EXACTLY(count - 1U, addressed), count - 1U);
        (void)fieldscribe_put_text(&text, NULL, TEXT, addressed, TEXT);
        (void)fieldscribe_put_text(&text, reading, TEXT, NULL, TEXT);
    }
}
