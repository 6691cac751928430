/*
 * Runs conformance vectors (JSON, one object a line) through generated code. No heap; a line is held in a buffer.
 * A generated program supplies an adapter per point, made of the macros below; include the generated headers first.
 *
 * SPDX-License-Identifier: 0BSD
 */
#ifndef FIELDSCRIBE_CONFORMANCE_H
#define FIELDSCRIBE_CONFORMANCE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    FIELDSCRIBE_LINE_MOST = 32768,
    FIELDSCRIBE_TEXT_MOST = 256,
    FIELDSCRIBE_WITH_MOST = 16,
    FIELDSCRIBE_VALUES_MOST = 2048,
    FIELDSCRIBE_WORDS_MOST = 128,
    FIELDSCRIBE_BYTES_MOST = 512,
    FIELDSCRIBE_CONSTANTS_MOST = 32,
    FIELDSCRIBE_SHOWN_FAILURES = 20
};

typedef enum fieldscribe_kind {
    FIELDSCRIBE_KIND_DECODE = 0,
    FIELDSCRIBE_KIND_ENCODE,
    FIELDSCRIBE_KIND_DECODE_COUNT,
    FIELDSCRIBE_KIND_ENCODE_COUNT,
    FIELDSCRIBE_KIND_CHECK,
    FIELDSCRIBE_KIND_NAME,
    FIELDSCRIBE_KIND_SPECIAL,
    FIELDSCRIBE_KIND_FLAG,
    FIELDSCRIBE_KIND_FLAG_NAME,
    FIELDSCRIBE_KIND_BITS,
    FIELDSCRIBE_KIND_WORDS,
    FIELDSCRIBE_KIND_ADDRESS,
    FIELDSCRIBE_KIND_BUILD,
    FIELDSCRIBE_KIND_REPLY,
    FIELDSCRIBE_KIND_PRINTED_BUILD,
    FIELDSCRIBE_KIND_PRINTED_REPLY,
    FIELDSCRIBE_KIND_BLOCK,
    FIELDSCRIBE_KIND_PLACE,
    FIELDSCRIBE_KIND_FIXED,
    FIELDSCRIBE_KIND_TEXT_DECODE,
    FIELDSCRIBE_KIND_TEXT_ENCODE,
    FIELDSCRIBE_KIND_DIGITS,
    FIELDSCRIBE_KIND_DIGITS_ENCODE,
    FIELDSCRIBE_KIND_CAN_BUILD,
    FIELDSCRIBE_KIND_CAN_PARSE,
    FIELDSCRIBE_KIND_CAN_TELEGRAM,
    FIELDSCRIBE_KIND_USS_BUILD,
    FIELDSCRIBE_KIND_USS_BROADCAST,
    FIELDSCRIBE_KIND_USS_REPLY,
    FIELDSCRIBE_KIND_USS_PRINTED_BUILD,
    FIELDSCRIBE_KIND_USS_PRINTED_REPLY,
    FIELDSCRIBE_KINDS
} fieldscribe_kind;

static const char *const fieldscribe_kind_names[FIELDSCRIBE_KINDS] = {"decode", "encode", "decode_count", "encode_count",
    "check", "name", "special", "flag", "flag_name", "bits", "words", "address", "build", "reply", "printed_build", "printed_reply",
    "block", "place", "fixed", "text_decode", "text_encode", "digits", "digits_encode", "can_build", "can_parse", "can_telegram",
    "uss_build", "uss_broadcast", "uss_reply", "uss_printed_build", "uss_printed_reply"};

/* An integer of any width and sign: its two's complement pattern in 64 bits, and whether it was written with a minus. */
typedef struct fieldscribe_number {
    uint64_t bits;
    bool negative;
} fieldscribe_number;

/* What a line asks. */
typedef struct fieldscribe_vector {
    int kind; /* a fieldscribe_kind */
    const char *line;
    char point[FIELDSCRIBE_TEXT_MOST];
    char name[FIELDSCRIBE_TEXT_MOST]; /* of a flag or a special */
    fieldscribe_number raw;
    fieldscribe_number count;
    fieldscribe_number word;
    fieldscribe_number replaced;
    double value;
    fieldscribe_number with[FIELDSCRIBE_WITH_MOST];
    uint16_t words[FIELDSCRIBE_WORDS_MOST]; /* of a text, or digits */
    uint8_t bytes[FIELDSCRIBE_BYTES_MOST]; /* of a text */
    size_t byte_count;
    const void *receiver; /* of a telegram, as its family has it */
} fieldscribe_vector;

/* A constant of a point beside its address: a number, or a text. */
typedef struct fieldscribe_constant {
    const char *key;
    uint64_t number;
    const char *text;
} fieldscribe_constant;

/* What the generated code answered; `answered` stays false when it has no function for that. */
typedef struct fieldscribe_outcome {
    bool answered;
    int status; /* a status of the device; 0 is ok */
    const char *status_text; /* the name of the status, where it is none of the device */
    bool untouched; /* nothing was stored although the status is not ok */
    uint64_t raw;
    uint64_t number; /* a count, a flag's number, the result of an insertion, the low end of a special, an address */
    uint64_t other; /* the high end of a special, the number of words, a space */
    double value;
    const char *text; /* a name, a code */
    uint16_t words[FIELDSCRIBE_WORDS_MOST];
    size_t word_count;
    char bytes[FIELDSCRIBE_BYTES_MOST];
    size_t byte_count;
    fieldscribe_constant constants[FIELDSCRIBE_CONSTANTS_MOST];
    size_t constant_count;
} fieldscribe_outcome;

typedef struct fieldscribe_status_name {
    int status;
    const char *name;
} fieldscribe_status_name;

typedef struct fieldscribe_adapter {
    const char *point;
    const char *arguments[FIELDSCRIBE_WITH_MOST];
    void (*run)(const fieldscribe_vector *v, fieldscribe_outcome *out);
} fieldscribe_adapter;

#if defined(FIELDSCRIBE_MODBUS_H)
typedef struct fieldscribe_blocks {
    const char *group;
    const fieldscribe_modbus_block *blocks;
    size_t count;
} fieldscribe_blocks;
#endif

#if defined(FIELDSCRIBE_CAN_H)
typedef struct fieldscribe_named_message {
    const char *name;
    const fieldscribe_can_message *message;
} fieldscribe_named_message;

typedef struct fieldscribe_named_telegram {
    const char *name;
    const fieldscribe_can_telegram *telegram;
} fieldscribe_named_telegram;
#endif

typedef struct fieldscribe_suite {
    const char *device;
    const char *digest;
    const char *const *spaces;
    const fieldscribe_status_name *statuses;
    const fieldscribe_adapter *adapters;
    const char *const *telegrams;
#if defined(FIELDSCRIBE_MODBUS_H)
    const fieldscribe_modbus_profile *profile;
    const fieldscribe_blocks *blocks;
#elif defined(FIELDSCRIBE_CAN_H)
    const fieldscribe_can_profile *profile;
    const fieldscribe_named_message *messages;
    const fieldscribe_named_telegram *cyclic;
#elif defined(FIELDSCRIBE_USS_H)
    const fieldscribe_uss_profile *profile;
#endif
} fieldscribe_suite;

/* ---- Adapters ---- */

/* The raw numbers of other points, as further arguments of a call; or none. */
#define FIELDSCRIBE_ALONE
#define FIELDSCRIBE_WITH(index, type) , (type)v->with[index].bits

/* Whether a number can be passed in that type at all; one that cannot is out of range by the type alone. */
#define FIELDSCRIBE_FITS_int32_t(n) ((uint64_t)(int32_t)(n).bits == (n).bits && ((int32_t)(n).bits < 0) == (n).negative)
#define FIELDSCRIBE_FITS_int64_t(n) (((int64_t)(n).bits < 0) == (n).negative)
#define FIELDSCRIBE_FITS_uint64_t(n) (!(n).negative)

#define FIELDSCRIBE_CHECK(function, raw_type, with)                       \
    case FIELDSCRIBE_KIND_CHECK:                                          \
        out->status = (int)function((raw_type)v->raw.bits with);          \
        out->untouched = true;                                            \
        out->answered = true;                                             \
        break;

#define FIELDSCRIBE_ENCODE_COUNT(function, count_type, raw_type, with)                  \
    case FIELDSCRIBE_KIND_ENCODE_COUNT: {                                               \
        raw_type raw = (raw_type)1;                                                     \
        out->status = 1; /* out of range */                                             \
        if (FIELDSCRIBE_FITS_##count_type(v->count)) {                                  \
            out->status = (int)function((count_type)v->count.bits with, &raw);          \
        }                                                                               \
        out->untouched = raw == (raw_type)1;                                            \
        out->raw = (uint64_t)raw;                                                       \
        out->answered = true;                                                           \
        break;                                                                          \
    }

#define FIELDSCRIBE_DECODE_COUNT(function, count_type, raw_type, with)                       \
    case FIELDSCRIBE_KIND_DECODE_COUNT:                                                      \
        out->number = (uint64_t)(count_type)function((raw_type)v->raw.bits with);            \
        out->answered = true;                                                                \
        break;

#define FIELDSCRIBE_TRY_DECODE_COUNT(function, count_type, raw_type, with)                   \
    case FIELDSCRIBE_KIND_DECODE_COUNT: {                                                    \
        count_type count = (count_type)1;                                                    \
        out->status = (int)function((raw_type)v->raw.bits with, &count);                     \
        out->untouched = count == (count_type)1;                                             \
        out->number = (uint64_t)count;                                                       \
        out->answered = true;                                                                \
        break;                                                                               \
    }

#if defined(FIELDSCRIBE_NO_FLOAT)
#define FIELDSCRIBE_ENCODE(function, real_type, raw_type, with)
#define FIELDSCRIBE_DECODE(function, real_type, raw_type, with)
#define FIELDSCRIBE_TRY_DECODE(function, real_type, raw_type, with)
#else
#define FIELDSCRIBE_ENCODE(function, real_type, raw_type, with)                              \
    case FIELDSCRIBE_KIND_ENCODE: {                                                          \
        raw_type raw = (raw_type)1;                                                          \
        out->status = (int)function((real_type)v->value with, &raw);                         \
        out->untouched = raw == (raw_type)1;                                                 \
        out->raw = (uint64_t)raw;                                                            \
        out->answered = true;                                                                \
        break;                                                                               \
    }

#define FIELDSCRIBE_DECODE(function, real_type, raw_type, with)                              \
    case FIELDSCRIBE_KIND_DECODE:                                                            \
        out->value = (double)function((raw_type)v->raw.bits with);                           \
        out->answered = true;                                                                \
        break;

#define FIELDSCRIBE_TRY_DECODE(function, real_type, raw_type, with)                          \
    case FIELDSCRIBE_KIND_DECODE: {                                                          \
        real_type value = (real_type)1;                                                      \
        out->status = (int)function((raw_type)v->raw.bits with, &value);                     \
        out->untouched = value >= (real_type)1 && value <= (real_type)1;                     \
        out->value = (double)value;                                                          \
        out->answered = true;                                                                \
        break;                                                                               \
    }
#endif

#define FIELDSCRIBE_NAME(function, number_type)                   \
    case FIELDSCRIBE_KIND_NAME:                                   \
        out->text = function((number_type)v->raw.bits);           \
        out->answered = true;                                     \
        break;

#define FIELDSCRIBE_BITS(function, raw_type)                                                               \
    case FIELDSCRIBE_KIND_BITS:                                                                            \
        out->raw = (uint64_t)function##_extract((uint16_t)v->word.bits);                                   \
        out->number = (uint64_t)function##_insert((uint16_t)v->word.bits, (raw_type)v->replaced.bits);     \
        out->answered = true;                                                                              \
        break;

#define FIELDSCRIBE_WORDS(function, raw_type, count)                     \
    case FIELDSCRIBE_KIND_WORDS:                                         \
        function##_to_words((raw_type)v->raw.bits, out->words);          \
        out->word_count = count;                                         \
        out->raw = (uint64_t)function##_from_words(out->words);          \
        out->answered = true;                                            \
        break;

/* A point whose only word is the raw number itself. */
#define FIELDSCRIBE_ONE_WORD(raw_type)                                   \
    case FIELDSCRIBE_KIND_WORDS:                                         \
        out->words[0] = (uint16_t)(raw_type)v->raw.bits;                 \
        out->word_count = 1U;                                            \
        out->raw = (uint64_t)(raw_type)v->raw.bits;                      \
        out->answered = true;                                            \
        break;

#define FIELDSCRIBE_ADDRESS(macro, others)               \
    case FIELDSCRIBE_KIND_ADDRESS:                       \
        out->number = macro##_ADDRESS;                   \
        out->other = macro##_WORDS;                      \
        out->word_count = (size_t)macro##_SPACE;         \
        others                                           \
        out->answered = true;                            \
        break;

/* What stands beside an address, as far as the point has it. */
#define FIELDSCRIBE_CODE(macro) out->text = macro##_CODE;
#define FIELDSCRIBE_RAWS(macro)                                                  \
    fieldscribe_keep(out, "raw_min", (uint64_t)(macro##_RAW_MIN), NULL);         \
    fieldscribe_keep(out, "raw_max", (uint64_t)(macro##_RAW_MAX), NULL);
#define FIELDSCRIBE_DECIMALS(macro) fieldscribe_keep(out, "decimals", (uint64_t)(macro##_DECIMALS), NULL);
#define FIELDSCRIBE_REFERENCE(macro, name, key) fieldscribe_keep(out, key, (uint64_t)(macro##_##name), NULL);
#define FIELDSCRIBE_REFERENCE_TEXT(macro, name, key) fieldscribe_keep(out, key, 0U, macro##_##name);

/* The words of a point in order, and what stands beside them. */
#define FIELDSCRIBE_PLACED(macro, offset) fieldscribe_put_word(out, (uint16_t)(macro##_ADDRESS + offset));
#define FIELDSCRIBE_INDEX(macro) fieldscribe_keep(out, "index", (uint64_t)(macro##_INDEX), NULL);
#define FIELDSCRIBE_TELEGRAM(macro) fieldscribe_keep(out, "telegram", (uint64_t)(macro##_TELEGRAM), NULL);
#define FIELDSCRIBE_PLACE(addresses, others)             \
    case FIELDSCRIBE_KIND_PLACE:                         \
        addresses                                        \
        others                                           \
        out->answered = true;                            \
        break;
#define FIELDSCRIBE_PLACE_OF_TEXT(macro, function, others)                             \
    case FIELDSCRIBE_KIND_PLACE: {                                                     \
        size_t at;                                                                     \
        for (at = 0U; at < sizeof function##_addresses / sizeof(uint16_t); ++at) {     \
            fieldscribe_put_word(out, function##_addresses[at]);                       \
        }                                                                              \
        others                                                                         \
        out->answered = true;                                                          \
        break;                                                                         \
    }

#define FIELDSCRIBE_FIXED(macro)                         \
    case FIELDSCRIBE_KIND_FIXED:                         \
        out->number = (uint64_t)(macro##_FIXED_MASK);    \
        out->other = (uint64_t)(macro##_FIXED_BITS);     \
        out->answered = true;                            \
        break;

#define FIELDSCRIBE_TEXT_DECODE(function, macro)                             \
    case FIELDSCRIBE_KIND_TEXT_DECODE:                                       \
        out->byte_count = function##_decode(v->words, out->bytes);           \
        out->answered = out->bytes[out->byte_count] == '\0';                 \
        break;

#define FIELDSCRIBE_TEXT_ENCODE(function, macro)                                                         \
    case FIELDSCRIBE_KIND_TEXT_ENCODE:                                                                   \
        out->status = (int)function##_encode((const char *)v->bytes, v->byte_count, out->words);         \
        out->untouched = out->words[0] == 0U;                                                            \
        out->word_count = macro##_WORDS;                                                                 \
        out->answered = true;                                                                            \
        break;

#define FIELDSCRIBE_DIGITS(function, digit_type, macro)                  \
    case FIELDSCRIBE_KIND_DIGITS: {                                      \
        digit_type digits[macro##_DIGITS];                               \
        size_t at;                                                       \
        function##_decode((uint16_t)v->raw.bits, digits);                \
        for (at = 0U; at < macro##_DIGITS; ++at) {                       \
            fieldscribe_put_word(out, digits[at]);                       \
        }                                                                \
        out->answered = true;                                            \
        break;                                                           \
    }

#define FIELDSCRIBE_DIGITS_ENCODE(function, digit_type, macro)           \
    case FIELDSCRIBE_KIND_DIGITS_ENCODE: {                               \
        digit_type digits[macro##_DIGITS];                               \
        uint16_t raw = 1U;                                               \
        size_t at;                                                       \
        for (at = 0U; at < macro##_DIGITS; ++at) {                       \
            digits[at] = (digit_type)v->words[at];                       \
        }                                                                \
        out->status = (int)function##_encode(digits, &raw);              \
        out->untouched = raw == 1U;                                      \
        out->raw = raw;                                                  \
        out->answered = true;                                            \
        break;                                                           \
    }

/* A point of a telegram, out of what was received. */
#define FIELDSCRIBE_RECEIVED(function, raw_type)                                                         \
    case FIELDSCRIBE_KIND_CAN_TELEGRAM: {                                                                \
        raw_type raw = (raw_type)1;                                                                      \
        const fieldscribe_can_status status =                                                            \
            function##_received((const fieldscribe_can_receiver *)v->receiver, &raw);                    \
        out->status = (int)status;                                                                       \
        out->status_text = fieldscribe_can_status_text(status);                                          \
        out->untouched = raw == (raw_type)1;                                                             \
        out->raw = (uint64_t)raw;                                                                        \
        out->answered = true;                                                                            \
        break;                                                                                           \
    }

#define FIELDSCRIBE_FLAG(flag, bits)              \
    if (strcmp(v->name, flag) == 0) {             \
        out->number = (uint64_t)(bits);           \
        out->answered = true;                     \
    }

#define FIELDSCRIBE_FLAG_NAME(flag, value, constant)                                                           \
    if (strcmp(v->name, flag) == 0 && fieldscribe_same_text(fieldscribe_member(v->line, "name"), value)) {     \
        out->raw = (uint64_t)(constant);                                                                       \
        out->answered = true;                                                                                  \
    }

#define FIELDSCRIBE_SPECIAL(special, first, last) \
    if (strcmp(v->name, special) == 0) {          \
        out->number = (uint64_t)(first);          \
        out->other = (uint64_t)(last);            \
        out->answered = true;                     \
    }

static inline void fieldscribe_put_word(fieldscribe_outcome *out, uint16_t word)
{
    if (out->word_count < (size_t)FIELDSCRIBE_WORDS_MOST) {
        out->words[out->word_count] = word;
    }
    ++out->word_count;
}

#if defined(FIELDSCRIBE_CAN_H)
static inline const char *fieldscribe_can_status_text(fieldscribe_can_status status)
{
    static const char *const names[] = {"ok", "bad_unit", "bad_address", "bad_value", "wrong_id", "wrong_length",
        "wrong_constant", "wrong_unit", "wrong_check", "wrong_address", "echo_mismatch", "missing", "torn"};
    return names[(size_t)status];
}
#endif

/* One more constant; more than there is room for agree with no line. */
static inline void fieldscribe_keep(fieldscribe_outcome *out, const char *key, uint64_t number, const char *text)
{
    if (out->constant_count < (size_t)FIELDSCRIBE_CONSTANTS_MOST) {
        out->constants[out->constant_count].key = key;
        out->constants[out->constant_count].number = number;
        out->constants[out->constant_count].text = text;
    }
    ++out->constant_count;
}

/* ---- Reading a line ---- */

static const char *fieldscribe_skip_string(const char *at)
{
    ++at;
    while (*at != '\0' && *at != '"') {
        at += (*at == '\\' && at[1] != '\0') ? 2 : 1;
    }
    return *at == '"' ? at + 1 : at;
}

/* Behind the value that starts at `at`. */
static const char *fieldscribe_skip_value(const char *at)
{
    int depth = 0;
    while (*at != '\0') {
        if (*at == '"') {
            at = fieldscribe_skip_string(at);
            continue;
        }
        if (*at == '{' || *at == '[') {
            ++depth;
        } else if (*at == '}' || *at == ']') {
            if (depth == 0) {
                return at;
            }
            --depth;
        } else if (*at == ',' && depth == 0) {
            return at;
        }
        ++at;
    }
    return at;
}

/* The value of a key of the object that starts at `object`; NULL when it has no such key. */
static const char *fieldscribe_member(const char *object, const char *key)
{
    const size_t length = strlen(key);
    const char *at = object + 1;
    for (;;) {
        const char *name;
        bool found;
        while (*at == ' ' || *at == ',') {
            ++at;
        }
        if (*at != '"') {
            return NULL;
        }
        name = at + 1;
        at = fieldscribe_skip_string(at);
        found = strncmp(name, key, length) == 0 && name[length] == '"';
        while (*at == ' ' || *at == ':') {
            ++at;
        }
        if (found) {
            return at;
        }
        at = fieldscribe_skip_value(at);
    }
}

/* How many keys the object that starts at `object` has. */
static size_t fieldscribe_keys(const char *object)
{
    size_t count = 0U;
    const char *at = object + 1;
    for (;;) {
        while (*at == ' ' || *at == ',') {
            ++at;
        }
        if (*at != '"') {
            return count;
        }
        ++count;
        at = fieldscribe_skip_string(at);
        while (*at == ' ' || *at == ':') {
            ++at;
        }
        at = fieldscribe_skip_value(at);
    }
}

/* Copies a string value; an absent or too long one is empty. Of escapes vectors have only those of \" and \\. */
static void fieldscribe_text(const char *value, char *text, size_t size)
{
    size_t length = 0U;
    text[0] = '\0';
    if (value == NULL || *value != '"') {
        return;
    }
    ++value;
    while (*value != '\0' && *value != '"') {
        if (*value == '\\' && value[1] != '\0') {
            ++value;
        }
        if (length + 1U == size) {
            text[0] = '\0';
            return;
        }
        text[length] = *value;
        ++length;
        ++value;
    }
    text[length] = '\0';
}

static fieldscribe_number fieldscribe_integer(const char *value)
{
    fieldscribe_number number = {0U, false};
    if (value == NULL) {
        return number;
    }
    number.negative = *value == '-';
    number.bits = (uint64_t)strtoull(number.negative ? value + 1 : value, NULL, 10);
    if (number.negative && number.bits != 0U) {
        number.bits = ~(number.bits - 1U);
    }
    return number;
}

/* A binary64 number from 16 hexadecimal digits. */
static double fieldscribe_real(const char *value)
{
    char text[FIELDSCRIBE_TEXT_MOST];
    uint64_t bits;
    double number = 0.0;
    fieldscribe_text(value, text, sizeof text);
    bits = (uint64_t)strtoull(text, NULL, 16);
    memcpy(&number, &bits, sizeof number);
    return number;
}

/* Same bits, or both not a number. */
static bool fieldscribe_same_real(double a, double b)
{
    const bool nan_a = !(a < 0.0 || a >= 0.0);
    const bool nan_b = !(b < 0.0 || b >= 0.0);
    return (nan_a || nan_b) ? (nan_a && nan_b) : memcmp(&a, &b, sizeof a) == 0;
}

/* Reads an array of numbers; returns how many there are (at most `most` are stored). */
static size_t fieldscribe_array(const char *value, uint16_t *numbers, size_t most)
{
    size_t count = 0U;
    if (value == NULL || *value != '[') {
        return 0U;
    }
    ++value;
    while (*value != '\0' && *value != ']') {
        if (*value == ' ' || *value == ',') {
            ++value;
            continue;
        }
        if (count < most) {
            numbers[count] = (uint16_t)fieldscribe_integer(value).bits;
        }
        ++count;
        value = fieldscribe_skip_value(value);
    }
    return count;
}

static int fieldscribe_digit(char digit)
{
    if (digit >= '0' && digit <= '9') {
        return digit - '0';
    }
    return digit >= 'a' && digit <= 'f' ? digit - 'a' + 10 : digit >= 'A' && digit <= 'F' ? digit - 'A' + 10 : -1;
}

/* Bytes from hexadecimal text; returns how many. */
static size_t fieldscribe_bytes(const char *value, uint8_t *bytes, size_t most)
{
    size_t count = 0U;
    if (value == NULL || *value != '"') {
        return 0U;
    }
    ++value;
    while (count < most) {
        const int high = fieldscribe_digit(value[0]);
        const int low = high < 0 ? -1 : fieldscribe_digit(value[1]);
        if (low < 0) {
            break;
        }
        bytes[count] = (uint8_t)(high * 16 + low);
        ++count;
        value += 2;
    }
    return count;
}

static bool fieldscribe_same_text(const char *value, const char *text)
{
    char expected[FIELDSCRIBE_TEXT_MOST];
    if (value == NULL || *value != '"') {
        return text == NULL;
    }
    fieldscribe_text(value, expected, sizeof expected);
    return text != NULL && strcmp(expected, text) == 0;
}

static bool fieldscribe_same_integer(const char *line, const char *key, uint64_t number)
{
    const char *const value = fieldscribe_member(line, key);
    return value != NULL && fieldscribe_integer(value).bits == number;
}

/* ---- Points ---- */

static const char *fieldscribe_status_text(const fieldscribe_status_name *statuses, int status)
{
    while (statuses->name != NULL && statuses->status != status) {
        ++statuses;
    }
    return statuses->name != NULL ? statuses->name : "unknown status";
}

static void fieldscribe_read_vector(const char *line, const fieldscribe_adapter *adapter, fieldscribe_vector *v)
{
    const char *const with = fieldscribe_member(line, "with");
    const char *const flag = fieldscribe_member(line, "flag");
    size_t at;
    v->line = line;
    v->raw = fieldscribe_integer(fieldscribe_member(line, "raw"));
    v->count = fieldscribe_integer(fieldscribe_member(line, "count"));
    v->word = fieldscribe_integer(fieldscribe_member(line, "word"));
    v->replaced = fieldscribe_integer(fieldscribe_member(line, "replaced"));
    v->value = fieldscribe_real(fieldscribe_member(line, "float"));
    fieldscribe_text(flag != NULL ? flag : fieldscribe_member(line, "special"), v->name, sizeof v->name);
    if (v->kind == FIELDSCRIBE_KIND_TEXT_DECODE || v->kind == FIELDSCRIBE_KIND_DIGITS_ENCODE) {
        const char *const parts = v->kind == FIELDSCRIBE_KIND_TEXT_DECODE ? "words" : "digits";
        (void)fieldscribe_array(fieldscribe_member(line, parts), v->words, FIELDSCRIBE_WORDS_MOST);
    } else if (v->kind == FIELDSCRIBE_KIND_TEXT_ENCODE) {
        v->byte_count = fieldscribe_bytes(fieldscribe_member(line, "text"), v->bytes, sizeof v->bytes);
    }
    for (at = 0U; at < FIELDSCRIBE_WITH_MOST && adapter->arguments[at] != NULL; ++at) {
        v->with[at] = fieldscribe_integer(with != NULL ? fieldscribe_member(with, adapter->arguments[at]) : NULL);
    }
}

/* Whether the constants of a point are those that the line gives, and no more. */
static bool fieldscribe_same_constants(const char *line, const fieldscribe_outcome *out)
{
    static const size_t others = 6U; /* kind, point, space, address, words, code */
    size_t at;
    if (out->constant_count > (size_t)FIELDSCRIBE_CONSTANTS_MOST || fieldscribe_keys(line) != others + out->constant_count) {
        return false;
    }
    for (at = 0U; at < out->constant_count; ++at) {
        const fieldscribe_constant *const one = &out->constants[at];
        const bool same = one->text != NULL ? fieldscribe_same_text(fieldscribe_member(line, one->key), one->text)
                                            : fieldscribe_same_integer(line, one->key, one->number);
        if (!same) {
            return false;
        }
    }
    return fieldscribe_same_text(fieldscribe_member(line, "code"), out->text);
}

/* Whether the words are those that the line gives under a key. */
static bool fieldscribe_same_words(const char *line, const char *key, const fieldscribe_outcome *out)
{
    uint16_t words[FIELDSCRIBE_WORDS_MOST];
    const size_t count = fieldscribe_array(fieldscribe_member(line, key), words, FIELDSCRIBE_WORDS_MOST);
    return count == out->word_count && count <= (size_t)FIELDSCRIBE_WORDS_MOST &&
        memcmp(words, out->words, count * sizeof words[0]) == 0;
}

static bool fieldscribe_same_bytes(const char *line, const char *key, const void *bytes, size_t length)
{
    uint8_t expected[FIELDSCRIBE_BYTES_MOST];
    const size_t count = fieldscribe_bytes(fieldscribe_member(line, key), expected, sizeof expected);
    return count == length && memcmp(expected, bytes, count) == 0;
}

/* Whether the index and the telegram of a point are those of the line, where `null` stands for none. */
static bool fieldscribe_same_place(const fieldscribe_suite *suite, const char *line, const fieldscribe_outcome *out)
{
    const char *const index = fieldscribe_member(line, "index");
    const char *const telegram = fieldscribe_member(line, "telegram");
    size_t expected = 0U;
    size_t at;
    if (index == NULL || telegram == NULL) {
        return false;
    }
    expected += *index != 'n' ? 1U : 0U;
    expected += *telegram != 'n' ? 1U : 0U;
    for (at = 0U; at < out->constant_count; ++at) {
        const fieldscribe_constant *const one = &out->constants[at];
        const bool same = strcmp(one->key, "index") == 0
            ? *index != 'n' && fieldscribe_integer(index).bits == one->number
            : fieldscribe_same_text(telegram, suite->telegrams[one->number]);
        if (!same) {
            return false;
        }
    }
    return out->constant_count == expected && fieldscribe_same_words(line, "addresses", out);
}

/* Whether the answer is the one that the line gives. */
static bool fieldscribe_agrees(const fieldscribe_suite *suite, const fieldscribe_vector *v, const fieldscribe_outcome *out)
{
    const char *const line = v->line;
    const char *const status = fieldscribe_member(line, "status");
    const char *const answered =
        out->status_text != NULL ? out->status_text : fieldscribe_status_text(suite->statuses, out->status);
    if (status != NULL && !fieldscribe_same_text(status, answered)) {
        return false;
    }
    if (out->status != 0) {
        return out->untouched;
    }
    switch (v->kind) {
    case FIELDSCRIBE_KIND_DECODE:
        return fieldscribe_same_real(out->value, v->value);
    case FIELDSCRIBE_KIND_ENCODE:
    case FIELDSCRIBE_KIND_ENCODE_COUNT:
        return fieldscribe_same_integer(line, "raw", out->raw);
    case FIELDSCRIBE_KIND_DECODE_COUNT:
        return fieldscribe_same_integer(line, "count", out->number);
    case FIELDSCRIBE_KIND_CHECK:
        return true;
    case FIELDSCRIBE_KIND_NAME:
        return fieldscribe_same_text(fieldscribe_member(line, "name"), out->text);
    case FIELDSCRIBE_KIND_SPECIAL:
        return fieldscribe_same_integer(line, "low", out->number) && fieldscribe_same_integer(line, "high", out->other);
    case FIELDSCRIBE_KIND_FLAG:
        return fieldscribe_same_integer(line, "number", out->number);
    case FIELDSCRIBE_KIND_FLAG_NAME:
        return fieldscribe_same_integer(line, "raw", out->raw);
    case FIELDSCRIBE_KIND_BITS:
        return fieldscribe_same_integer(line, "raw", out->raw) && fieldscribe_same_integer(line, "result", out->number);
    case FIELDSCRIBE_KIND_WORDS:
        return fieldscribe_same_words(line, "words", out) && fieldscribe_same_integer(line, "raw", out->raw);
    case FIELDSCRIBE_KIND_PLACE:
        return fieldscribe_same_place(suite, line, out);
    case FIELDSCRIBE_KIND_FIXED:
        return fieldscribe_same_integer(line, "mask", out->number) && fieldscribe_same_integer(line, "bits", out->other);
    case FIELDSCRIBE_KIND_TEXT_DECODE:
        return fieldscribe_same_bytes(line, "text", out->bytes, out->byte_count);
    case FIELDSCRIBE_KIND_TEXT_ENCODE:
        return fieldscribe_same_words(line, "words", out);
    case FIELDSCRIBE_KIND_DIGITS:
        return fieldscribe_same_words(line, "digits", out);
    case FIELDSCRIBE_KIND_DIGITS_ENCODE:
    case FIELDSCRIBE_KIND_CAN_TELEGRAM:
        return fieldscribe_same_integer(line, "raw", out->raw);
    case FIELDSCRIBE_KIND_ADDRESS:
        return fieldscribe_same_integer(line, "address", out->number) &&
            fieldscribe_same_integer(line, "words", out->other) &&
            fieldscribe_same_text(fieldscribe_member(line, "space"), suite->spaces[out->word_count]) &&
            fieldscribe_same_constants(line, out);
    default:
        return false;
    }
}

static bool fieldscribe_run_point(const fieldscribe_suite *suite, const char *line, fieldscribe_vector *v)
{
    static const fieldscribe_adapter *last = NULL; /* vectors of one point stand together */
    fieldscribe_outcome out;
    const fieldscribe_adapter *adapter = last;
    fieldscribe_text(fieldscribe_member(line, "point"), v->point, sizeof v->point);
    if (adapter == NULL || strcmp(adapter->point, v->point) != 0) {
        adapter = suite->adapters;
        while (adapter->point != NULL && strcmp(adapter->point, v->point) != 0) {
            ++adapter;
        }
    }
    if (adapter->point == NULL) {
        return false;
    }
    last = adapter;
    fieldscribe_read_vector(line, adapter, v);
    memset(&out, 0, sizeof out);
    adapter->run(v, &out);
    return out.answered && fieldscribe_agrees(suite, v, &out);
}

/* ---- Frames ---- */

#if defined(FIELDSCRIBE_MODBUS_H)
static const char *fieldscribe_modbus_status_text(fieldscribe_modbus_status status)
{
    static const char *const names[] = {"ok", "bad_unit", "bad_function", "bad_count", "bad_address", "bad_value",
        "bad_framing", "buffer_too_small", "short_frame", "long_frame", "bad_crc", "bad_protocol", "wrong_transaction", "wrong_unit", "wrong_function",
        "exception", "bad_byte_count", "echo_mismatch"};
    return names[(size_t)status];
}

static fieldscribe_modbus_framing fieldscribe_read_request(
    const char *line, uint16_t *values, fieldscribe_modbus_request *request)
{
    const char *const given = fieldscribe_member(line, "values");
    request->transaction = (uint16_t)fieldscribe_integer(fieldscribe_member(line, "transaction")).bits;
    request->unit = (uint8_t)fieldscribe_integer(fieldscribe_member(line, "unit")).bits;
    request->function = (uint8_t)fieldscribe_integer(fieldscribe_member(line, "function")).bits;
    request->address = (uint16_t)fieldscribe_integer(fieldscribe_member(line, "address")).bits;
    request->count = (uint16_t)fieldscribe_integer(fieldscribe_member(line, "count")).bits;
    request->values = NULL;
    if (given != NULL && *given == '[') {
        const size_t count = fieldscribe_array(given, values, FIELDSCRIBE_VALUES_MOST);
        if (fieldscribe_member(line, "count") == NULL) {
            request->count = (uint16_t)count;
        }
        request->values = count != 0U ? values : NULL;
    }
    return fieldscribe_same_text(fieldscribe_member(line, "framing"), "tcp") ? FIELDSCRIBE_MODBUS_TCP
                                                                             : FIELDSCRIBE_MODBUS_RTU;
}

static bool fieldscribe_run_build(const fieldscribe_suite *suite, const char *line)
{
    static uint16_t values[FIELDSCRIBE_VALUES_MOST];
    uint8_t expected[512];
    uint8_t built[FIELDSCRIBE_MODBUS_TCP_MOST];
    fieldscribe_modbus_request request;
    size_t length = 0U;
    const fieldscribe_modbus_framing framing = fieldscribe_read_request(line, values, &request);
    const fieldscribe_modbus_status status =
        fieldscribe_modbus_build(suite->profile, framing, &request, built, sizeof built, &length);
    const size_t wanted = fieldscribe_bytes(fieldscribe_member(line, "bytes"), expected, sizeof expected);
    return fieldscribe_same_text(fieldscribe_member(line, "status"), fieldscribe_modbus_status_text(status)) &&
        length == wanted && memcmp(built, expected, length) == 0;
}

static bool fieldscribe_run_reply(const char *line)
{
    static uint16_t values[FIELDSCRIBE_VALUES_MOST];
    static uint16_t wanted[FIELDSCRIBE_VALUES_MOST];
    static uint16_t read[FIELDSCRIBE_VALUES_MOST];
    uint8_t bytes[1024];
    fieldscribe_modbus_request request;
    fieldscribe_modbus_reply reply;
    const fieldscribe_modbus_framing framing = fieldscribe_read_request(line, values, &request);
    const size_t length = fieldscribe_bytes(fieldscribe_member(line, "bytes"), bytes, sizeof bytes);
    const fieldscribe_modbus_status status =
        fieldscribe_modbus_parse(framing, &request, bytes, length, read, FIELDSCRIBE_VALUES_MOST, &reply);
    const size_t count = fieldscribe_array(fieldscribe_member(line, "values_out"), wanted, FIELDSCRIBE_VALUES_MOST);
    const char *const exception = fieldscribe_member(line, "exception");
    return fieldscribe_same_text(fieldscribe_member(line, "status"), fieldscribe_modbus_status_text(status)) &&
        reply.count == count && memcmp(read, wanted, count * sizeof read[0]) == 0 &&
        (uint64_t)reply.exception == (exception != NULL && *exception != 'n' ? fieldscribe_integer(exception).bits : 0U);
}

static bool fieldscribe_run_block(const fieldscribe_suite *suite, const char *line)
{
    static const char *const spaces[] = {"", "coil", "discrete", "holding", "input"};
    const uint64_t index = fieldscribe_integer(fieldscribe_member(line, "index")).bits;
    const fieldscribe_blocks *group = suite->blocks;
    const fieldscribe_modbus_block *block;
    while (group->group != NULL && !fieldscribe_same_text(fieldscribe_member(line, "group"), group->group)) {
        ++group;
    }
    if (group->group == NULL || index >= group->count) {
        return false;
    }
    block = &group->blocks[index];
    return block->function >= 1U && block->function <= 4U &&
        fieldscribe_same_text(fieldscribe_member(line, "space"), spaces[block->function]) &&
        fieldscribe_same_integer(line, "function", block->function) &&
        fieldscribe_same_integer(line, "address", block->address) &&
        fieldscribe_same_integer(line, "count", block->count);
}
#endif

#if defined(FIELDSCRIBE_CAN_H) || defined(FIELDSCRIBE_USS_H)
/* A number from 0 on, or `most` for one that is larger. */
static uint32_t fieldscribe_at_most(const char *line, const char *key, uint32_t most)
{
    const fieldscribe_number number = fieldscribe_integer(fieldscribe_member(line, key));
    return number.negative || number.bits > most ? most : (uint32_t)number.bits;
}
#endif

#if defined(FIELDSCRIBE_CAN_H)
static const fieldscribe_can_message *fieldscribe_find_message(const fieldscribe_suite *suite, const char *line)
{
    const fieldscribe_named_message *one = suite->messages;
    while (one->name != NULL && !fieldscribe_same_text(fieldscribe_member(line, "message"), one->name)) {
        ++one;
    }
    return one->message;
}

static fieldscribe_can_frame fieldscribe_read_frame(uint64_t id, const char *data)
{
    uint8_t bytes[FIELDSCRIBE_BYTES_MOST] = {0U};
    fieldscribe_can_frame frame;
    frame.id = (uint32_t)id;
    frame.length = (uint8_t)fieldscribe_bytes(data, bytes, 255U);
    memcpy(frame.data, bytes, sizeof frame.data);
    return frame;
}

static bool fieldscribe_run_can_build(const fieldscribe_suite *suite, const char *line)
{
    const fieldscribe_can_message *const message = fieldscribe_find_message(suite, line);
    const uint32_t unit = fieldscribe_at_most(line, "unit", UINT32_MAX);
    const uint32_t address = fieldscribe_at_most(line, "address", UINT32_MAX);
    const uint32_t raw = fieldscribe_at_most(line, "raw", UINT32_MAX);
    fieldscribe_can_frame frame;
    fieldscribe_can_status status;
    memset(&frame, 0, sizeof frame);
    if (message == NULL) {
        return false;
    }
    status = fieldscribe_can_build(suite->profile, message, unit, address, raw, &frame);
    return fieldscribe_same_text(fieldscribe_member(line, "status"), fieldscribe_can_status_text(status)) &&
        fieldscribe_same_integer(line, "id", frame.id) && fieldscribe_same_bytes(line, "bytes", frame.data, frame.length);
}

static bool fieldscribe_run_can_parse(const fieldscribe_suite *suite, const char *line)
{
    const fieldscribe_can_message *const message = fieldscribe_find_message(suite, line);
    const fieldscribe_can_frame frame = fieldscribe_read_frame(
        fieldscribe_integer(fieldscribe_member(line, "id")).bits, fieldscribe_member(line, "bytes"));
    uint16_t address = 1U;
    uint16_t raw = 1U;
    fieldscribe_can_status status;
    if (message == NULL) {
        return false;
    }
    status = fieldscribe_can_parse(message, (uint8_t)fieldscribe_at_most(line, "unit", 255U), &frame, &address, &raw);
    return fieldscribe_same_text(fieldscribe_member(line, "status"), fieldscribe_can_status_text(status)) &&
        fieldscribe_same_integer(line, "address", address) && fieldscribe_same_integer(line, "raw", raw);
}

/* Feeds the frames of a line to a receiver; false when it takes others than it should. */
static bool fieldscribe_feed(const char *line, fieldscribe_can_receiver *receiver)
{
    uint16_t taken[FIELDSCRIBE_WORDS_MOST] = {0U};
    const size_t count = fieldscribe_array(fieldscribe_member(line, "taken"), taken, FIELDSCRIBE_WORDS_MOST);
    const char *at = fieldscribe_member(line, "frames");
    size_t fed = 0U;
    if (at == NULL || *at != '[' || count > (size_t)FIELDSCRIBE_WORDS_MOST) {
        return false;
    }
    ++at;
    while (*at == '[' || *at == ' ' || *at == ',') {
        if (*at == '[') {
            const char *const data = strchr(at, '"');
            const fieldscribe_can_frame frame = fieldscribe_read_frame(fieldscribe_integer(at + 1).bits, data);
            if (fed == count || fieldscribe_can_take(receiver, &frame) != (taken[fed] != 0U)) {
                return false;
            }
            ++fed;
            at = fieldscribe_skip_value(at);
        } else {
            ++at;
        }
    }
    return fed == count;
}

static bool fieldscribe_run_can_telegram(const fieldscribe_suite *suite, const char *line, fieldscribe_vector *v)
{
    static fieldscribe_can_slot slots[256];
    const fieldscribe_named_telegram *one = suite->cyclic;
    fieldscribe_can_receiver receiver;
    while (one->name != NULL && !fieldscribe_same_text(fieldscribe_member(line, "telegram"), one->name)) {
        ++one;
    }
    if (one->name == NULL || fieldscribe_can_slots(one->telegram) > 256U) {
        return false;
    }
    memset(slots, 0x5A, sizeof slots);
    receiver = fieldscribe_can_listen(one->telegram, (uint8_t)fieldscribe_at_most(line, "unit", 255U), slots);
    v->receiver = &receiver;
    return fieldscribe_feed(line, &receiver) && fieldscribe_run_point(suite, line, v);
}
#endif

#if defined(FIELDSCRIBE_USS_H)
static const char *fieldscribe_uss_status_text(fieldscribe_uss_status status)
{
    static const char *const names[] = {"ok", "bad_link", "bad_unit", "bad_task", "bad_parameter", "bad_index",
        "bad_value", "buffer_too_small", "wrong_start", "wrong_length", "wrong_check", "wrong_unit", "wrong_parameter",
        "no_answer", "refused", "no_rights", "wrong_response"};
    return names[(size_t)status];
}

static fieldscribe_uss_link fieldscribe_read_link(const char *line)
{
    const char *const single_first = fieldscribe_member(line, "single_first");
    fieldscribe_uss_link link;
    link.pkw = (uint8_t)fieldscribe_at_most(line, "pkw", 255U);
    link.pzd = (uint8_t)fieldscribe_at_most(line, "pzd", 255U);
    link.single_first = single_first != NULL && *single_first == 't';
    return link;
}

static fieldscribe_uss_request fieldscribe_read_task(const char *line)
{
    fieldscribe_uss_request request;
    request.unit = (uint8_t)fieldscribe_at_most(line, "unit", 255U);
    request.task = (uint8_t)fieldscribe_at_most(line, "task", 255U);
    request.parameter = (uint16_t)fieldscribe_at_most(line, "parameter", 65535U);
    request.index = (uint16_t)fieldscribe_at_most(line, "index", 65535U);
    request.width = (uint8_t)fieldscribe_at_most(line, "width", 255U);
    request.value = fieldscribe_at_most(line, "value", UINT32_MAX);
    return request;
}

static bool fieldscribe_run_uss_build(const fieldscribe_suite *suite, const char *line)
{
    uint16_t words[FIELDSCRIBE_WORDS_MOST] = {0U};
    uint8_t built[FIELDSCRIBE_USS_MOST];
    size_t length = 0U;
    const fieldscribe_uss_link link = fieldscribe_read_link(line);
    const fieldscribe_uss_request request = fieldscribe_read_task(line);
    const size_t count = fieldscribe_array(fieldscribe_member(line, "words"), words, FIELDSCRIBE_WORDS_MOST);
    fieldscribe_uss_status status =
        fieldscribe_uss_build(suite->profile, &link, &request, words, count, built, sizeof built, &length);
    if (status == FIELDSCRIBE_USS_OK && !fieldscribe_same_integer(line, "value", request.value)) {
        status = FIELDSCRIBE_USS_BAD_VALUE; /* the argument's type alone refuses it */
        length = 0U;
    }
    return fieldscribe_same_text(fieldscribe_member(line, "status"), fieldscribe_uss_status_text(status)) &&
        fieldscribe_same_bytes(line, "bytes", built, length);
}

static bool fieldscribe_run_uss_broadcast(const fieldscribe_suite *suite, const char *line)
{
    uint16_t mask[4] = {0U};
    uint16_t words[FIELDSCRIBE_WORDS_MOST] = {0U};
    uint8_t built[FIELDSCRIBE_USS_MOST];
    size_t length = 0U;
    const fieldscribe_uss_link link = fieldscribe_read_link(line);
    const size_t masks = fieldscribe_array(fieldscribe_member(line, "mask"), mask, 4U);
    const size_t count = fieldscribe_array(fieldscribe_member(line, "words"), words, FIELDSCRIBE_WORDS_MOST);
    const fieldscribe_uss_status status =
        fieldscribe_uss_build_broadcast(suite->profile, &link, mask, words, count, built, sizeof built, &length);
    return masks == 4U &&
        fieldscribe_same_text(fieldscribe_member(line, "status"), fieldscribe_uss_status_text(status)) &&
        fieldscribe_same_bytes(line, "bytes", built, length);
}

static bool fieldscribe_run_uss_reply(const fieldscribe_suite *suite, const char *line)
{
    uint16_t words[FIELDSCRIBE_WORDS_MOST] = {0U};
    uint16_t wanted[FIELDSCRIBE_WORDS_MOST];
    uint8_t bytes[FIELDSCRIBE_BYTES_MOST];
    fieldscribe_uss_reply reply;
    const fieldscribe_uss_link link = fieldscribe_read_link(line);
    const fieldscribe_uss_request request = fieldscribe_read_task(line);
    const size_t length = fieldscribe_bytes(fieldscribe_member(line, "bytes"), bytes, sizeof bytes);
    const fieldscribe_uss_status status = fieldscribe_uss_parse(
        suite->profile, &link, &request, bytes, length, words, FIELDSCRIBE_WORDS_MOST, &reply);
    const size_t count = fieldscribe_array(fieldscribe_member(line, "words"), wanted, FIELDSCRIBE_WORDS_MOST);
    return fieldscribe_same_text(fieldscribe_member(line, "status"), fieldscribe_uss_status_text(status)) &&
        fieldscribe_same_integer(line, "response", reply.response) &&
        fieldscribe_same_integer(line, "width", reply.width) && fieldscribe_same_integer(line, "value", reply.value) &&
        fieldscribe_same_integer(line, "error", reply.error) && count == (status == FIELDSCRIBE_USS_OK ? link.pzd : 0U) &&
        memcmp(words, wanted, count * sizeof words[0]) == 0;
}
#endif

/* ---- The run ---- */

static int fieldscribe_kind_of(const char *line)
{
    int kind = 0;
    const char *const value = fieldscribe_member(line, "kind");
    while (kind < (int)FIELDSCRIBE_KINDS && !fieldscribe_same_text(value, fieldscribe_kind_names[kind])) {
        ++kind;
    }
    return kind;
}

static bool fieldscribe_skips(int kind)
{
#if defined(FIELDSCRIBE_NO_FLOAT)
    return kind == FIELDSCRIBE_KIND_DECODE || kind == FIELDSCRIBE_KIND_ENCODE;
#else
    (void)kind;
    return false;
#endif
}

static bool fieldscribe_run_line(const fieldscribe_suite *suite, const char *line, fieldscribe_vector *v)
{
#if defined(FIELDSCRIBE_MODBUS_H)
    if (v->kind == FIELDSCRIBE_KIND_BUILD || v->kind == FIELDSCRIBE_KIND_PRINTED_BUILD) {
        return fieldscribe_run_build(suite, line);
    }
    if (v->kind == FIELDSCRIBE_KIND_REPLY || v->kind == FIELDSCRIBE_KIND_PRINTED_REPLY) {
        return fieldscribe_run_reply(line);
    }
    if (v->kind == FIELDSCRIBE_KIND_BLOCK) {
        return fieldscribe_run_block(suite, line);
    }
#elif defined(FIELDSCRIBE_CAN_H)
    if (v->kind == FIELDSCRIBE_KIND_CAN_BUILD) {
        return fieldscribe_run_can_build(suite, line);
    }
    if (v->kind == FIELDSCRIBE_KIND_CAN_PARSE) {
        return fieldscribe_run_can_parse(suite, line);
    }
    if (v->kind == FIELDSCRIBE_KIND_CAN_TELEGRAM) {
        return fieldscribe_run_can_telegram(suite, line, v);
    }
#elif defined(FIELDSCRIBE_USS_H)
    if (v->kind == FIELDSCRIBE_KIND_USS_BUILD || v->kind == FIELDSCRIBE_KIND_USS_PRINTED_BUILD) {
        return fieldscribe_run_uss_build(suite, line);
    }
    if (v->kind == FIELDSCRIBE_KIND_USS_BROADCAST) {
        return fieldscribe_run_uss_broadcast(suite, line);
    }
    if (v->kind == FIELDSCRIBE_KIND_USS_REPLY || v->kind == FIELDSCRIBE_KIND_USS_PRINTED_REPLY) {
        return fieldscribe_run_uss_reply(suite, line);
    }
#endif
    return fieldscribe_run_point(suite, line, v);
}

/* Whether the vectors were made for these headers. */
static bool fieldscribe_fits(const fieldscribe_suite *suite, const char *head)
{
    char digest[FIELDSCRIBE_TEXT_MOST];
    fieldscribe_text(fieldscribe_member(head, "digest"), digest, sizeof digest);
    return fieldscribe_same_integer(head, "format", 1U) &&
        fieldscribe_same_text(fieldscribe_member(head, "device"), suite->device) &&
        strncmp(digest, suite->digest, strlen(suite->digest)) == 0;
}

static int fieldscribe_report(unsigned long *passed, unsigned long *failed)
{
    unsigned long all_passed = 0U;
    unsigned long all_failed = 0U;
    int kind;
    for (kind = 0; kind < (int)FIELDSCRIBE_KINDS; ++kind) {
        if (passed[kind] + failed[kind] > 0U) {
            printf("%s %lu passed, %lu failed\n", fieldscribe_kind_names[kind], passed[kind], failed[kind]);
        }
        all_passed += passed[kind];
        all_failed += failed[kind];
    }
    printf("total %lu passed, %lu failed\n", all_passed, all_failed);
    return all_failed == 0U && all_passed > 0U ? 0 : 1;
}

static int fieldscribe_run_file(const fieldscribe_suite *suite, FILE *file)
{
    static char line[FIELDSCRIBE_LINE_MOST];
    static fieldscribe_vector v;
    unsigned long passed[FIELDSCRIBE_KINDS] = {0U};
    unsigned long failed[FIELDSCRIBE_KINDS] = {0U};
    unsigned long shown = 0U;
    bool fits = false;
    while (fgets(line, (int)sizeof line, file) != NULL) {
        const char *object = line;
        while (*object == ' ') {
            ++object;
        }
        if (strchr(line, '\n') == NULL && strlen(line) + 1U == sizeof line) {
            fprintf(stderr, "a line has more than %d characters\n", FIELDSCRIBE_LINE_MOST);
            return 2;
        }
        if (strncmp(object, "{\"format\"", 9U) == 0) {
            fits = fieldscribe_fits(suite, object);
        }
        if (strncmp(object, "{\"kind\"", 7U) != 0) {
            continue;
        }
        v.kind = fieldscribe_kind_of(object);
        if (v.kind == (int)FIELDSCRIBE_KINDS) {
            fprintf(stderr, "unknown kind: %s", object);
            return 2;
        }
        if (fieldscribe_skips(v.kind)) {
            continue;
        }
        if (fieldscribe_run_line(suite, object, &v)) {
            ++passed[v.kind];
        } else {
            ++failed[v.kind];
            if (shown < FIELDSCRIBE_SHOWN_FAILURES) {
                fprintf(stderr, "failed: %s", object);
                ++shown;
            }
        }
    }
    if (!fits) {
        fprintf(stderr, "these vectors were made from another description than %s %s\n", suite->device, suite->digest);
        return 1;
    }
    return fieldscribe_report(passed, failed);
}

static int fieldscribe_run(const fieldscribe_suite *suite, int argc, char **argv)
{
    FILE *file;
    int result;
    if (argc != 2) {
        fprintf(stderr, "usage: %s_conformance VECTORS\n", suite->device);
        return 2;
    }
    file = fopen(argv[1], "r");
    if (file == NULL) {
        fprintf(stderr, "cannot read %s\n", argv[1]);
        return 2;
    }
    result = fieldscribe_run_file(suite, file);
    fclose(file);
    return result;
}

#endif
