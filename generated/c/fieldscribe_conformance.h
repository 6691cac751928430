/*
 * Runs conformance vectors (fields between tabs, one vector a line) through generated code. No heap.
 * A generated program supplies a function per point, made of the macros below and of those of its family's file, which
 * includes this one; include the generated headers first.
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

#include "fieldscribe.h"

enum {
    FIELDSCRIBE_FORMAT = 2,
    FIELDSCRIBE_LINE_MOST = 16384,
    FIELDSCRIBE_FIELDS_MOST = 16,
    FIELDSCRIBE_KINDS_MOST = 96,
    FIELDSCRIBE_SETS_MOST = 16,
    FIELDSCRIBE_HEAD_MOST = 16384,
    FIELDSCRIBE_VALUES_MOST = 2048,
    FIELDSCRIBE_BYTES_MOST = 1024,
    FIELDSCRIBE_ROOM = 256, /* words that one exchange can bring, and more */
    FIELDSCRIBE_SHOWN_FAILURES = 20
};

/* A function that all points call, never inlined: copies at thousands of calls cost a minute of compilation. */
#if defined(__GNUC__)
#define FIELDSCRIBE_ONCE static __attribute__((noinline, unused))
#else
#define FIELDSCRIBE_ONCE static inline
#endif

/* A kind or a set, as the head of the file describes it. */
typedef struct fieldscribe_kind {
    const char *name;
    const char *keys[FIELDSCRIBE_FIELDS_MOST];
    bool notes[FIELDSCRIBE_FIELDS_MOST]; /* for people alone */
    size_t count;
    bool elsewhere; /* other languages say this in more than comments */
    unsigned long announced;
    unsigned long passed;
    unsigned long failed;
    unsigned long skipped;
} fieldscribe_kind;

/* The parts of a line. */
typedef struct fieldscribe_line {
    fieldscribe_kind *kind;
    char *fields[FIELDSCRIBE_FIELDS_MOST];
    bool used[FIELDSCRIBE_FIELDS_MOST];
    size_t count;
    char text[FIELDSCRIBE_LINE_MOST];
} fieldscribe_line;

struct fieldscribe_suite;

/* The question of a line, and whether all answers so far are right. */
typedef struct fieldscribe_vector {
    const struct fieldscribe_suite *suite;
    fieldscribe_line own;
    fieldscribe_line sets[FIELDSCRIBE_SETS_MOST];
    size_t set_count;
    bool answered;
    bool differs;
    const char *wrong; /* the field whose answer differs first, or what else does */
    char given[48];    /* the answer that the code gives instead, if it is one number or text */
    uint16_t base; /* the addresses of the point count from here */
    size_t selecting; /* the number of steps of the script that select the point */
    size_t matched; /* pairs of a map that were found */
    const void *receiver; /* of a telegram, as its family has it */
} fieldscribe_vector;

typedef struct fieldscribe_status_name {
    int status;
    const char *name;
} fieldscribe_status_name;

typedef struct fieldscribe_adapter {
    const char *point;
    void (*run)(fieldscribe_vector *v);
} fieldscribe_adapter;

typedef struct fieldscribe_suite {
    const char *device;
    const char *version;
    unsigned long major; /* the version as numbers, and as one number */
    unsigned long minor;
    unsigned long patch;
    unsigned long number;
    const char *digest;
    const fieldscribe_status_name *statuses;
    const fieldscribe_adapter *adapters;
    const char *const *telegrams;
    void (*run_code)(fieldscribe_vector *v);
    bool (*run_frame)(fieldscribe_vector *v); /* false for a line that is not about frames */
    const void *family;                       /* its tables, as the program of its family has them */
} fieldscribe_suite;

/* ---- Fields ---- */

static bool fieldscribe_absent(const char *field)
{
    return strcmp(field, "-") == 0;
}

/* Notes a difference, and the first one by name: a field, or what else differs. */
FIELDSCRIBE_ONCE void fieldscribe_differs(fieldscribe_vector *v, const char *what)
{
    if (!v->differs) {
        v->differs = true;
        v->wrong = what;
    }
}

/* The field of this name in the line, else in the nearest set before it; an unknown name is a difference. */
FIELDSCRIBE_ONCE const char *fieldscribe_field(fieldscribe_vector *v, const char *key)
{
    fieldscribe_line *line = &v->own;
    size_t left = v->set_count;
    size_t at;
    for (;;) {
        for (at = 0U; line->kind != NULL && at < line->kind->count; ++at) {
            if (strcmp(line->kind->keys[at], key) == 0) {
                line->used[at] = true;
                return at < line->count ? line->fields[at] : "-";
            }
        }
        if (left == 0U) {
            fieldscribe_differs(v, key);
            return "-";
        }
        --left;
        line = &v->sets[left];
    }
}

/* A number of any width and sign as a pattern in two's complement. */
static uint64_t fieldscribe_pattern(const char *text)
{
    const uint64_t size = (uint64_t)strtoull(*text == '-' ? text + 1 : text, NULL, 10);
    return *text == '-' && size != 0U ? ~(size - 1U) : size;
}

FIELDSCRIBE_ONCE uint64_t fieldscribe_bits(fieldscribe_vector *v, const char *key)
{
    return fieldscribe_pattern(fieldscribe_field(v, key));
}

/* A number from 0 on, or `most` for one that is larger or negative. */
static inline uint32_t fieldscribe_at_most(fieldscribe_vector *v, const char *key, uint32_t most)
{
    const char *const field = fieldscribe_field(v, key);
    const uint64_t number = fieldscribe_pattern(field);
    return *field == '-' && number != 0U ? most : number > most ? most : (uint32_t)number;
}

FIELDSCRIBE_ONCE double fieldscribe_number_of(fieldscribe_vector *v, const char *key)
{
    const char *const field = fieldscribe_field(v, key);
    const size_t length = strlen(field);
    uint64_t bits = (uint64_t)strtoull(field, NULL, 16);
    double number = 0.0;
    bits = length < 16U ? bits << (4U * (16U - (unsigned)length)) : bits;
    memcpy(&number, &bits, sizeof number);
    return number;
}

static int fieldscribe_digit(char digit)
{
    static const char digits[] = "0123456789abcdef0123456789ABCDEF";
    const char *const found = digit != '\0' ? strchr(digits, digit) : NULL;
    return found != NULL ? (int)((found - digits) & 15) : -1;
}

/* Stores the bytes of a field of hexadecimal digits, `most` at most; returns their number. */
static size_t fieldscribe_hex(const char *field, uint8_t *bytes, size_t most)
{
    size_t count = 0U;
    while (count < most && fieldscribe_digit(field[0]) >= 0 && fieldscribe_digit(field[1]) >= 0) {
        bytes[count] = (uint8_t)(fieldscribe_digit(field[0]) * 16 + fieldscribe_digit(field[1]));
        ++count;
        field += 2;
    }
    return count;
}

FIELDSCRIBE_ONCE size_t fieldscribe_bytes(fieldscribe_vector *v, const char *key, uint8_t *bytes, size_t most)
{
    return fieldscribe_hex(fieldscribe_field(v, key), bytes, most);
}

/* Stores the numbers of a list, `most` at most; returns how many there are. */
FIELDSCRIBE_ONCE size_t fieldscribe_numbers(fieldscribe_vector *v, const char *key, uint16_t *numbers, size_t most)
{
    const char *at = fieldscribe_field(v, key);
    size_t count = 0U;
    if (fieldscribe_absent(at)) {
        return 0U;
    }
    while (at != NULL) {
        if (count < most) {
            numbers[count] = (uint16_t)fieldscribe_pattern(at);
        }
        ++count;
        at = strchr(at, ',');
        at = at != NULL ? at + 1 : NULL;
    }
    return count;
}

/* Whether a field, up to its end, a comma or an equals sign, is this text once its escapes are undone. */
FIELDSCRIBE_ONCE bool fieldscribe_spells(const char *field, const char *text)
{
    while (*field != '\0' && *field != ',' && *field != '=') {
        char one = *field;
        if (one == '%') {
            uint8_t byte = 0U;
            const size_t escaped = fieldscribe_hex(field + 1, &byte, 1U);
            if (escaped == 0U) {
                ++field; /* a percent sign alone is an empty text */
                continue;
            }
            one = (char)byte;
            field += 2;
        }
        if (*text == '\0' || *text != one) {
            return false;
        }
        ++field;
        ++text;
    }
    return *text == '\0';
}

/* The value of a name in a map; NULL if the map does not have it. */
static const char *fieldscribe_pair(fieldscribe_vector *v, const char *key, const char *name)
{
    const char *at = fieldscribe_field(v, key);
    while (at != NULL && !fieldscribe_absent(at)) {
        const char *const equals = strchr(at, '=');
        if (equals != NULL && fieldscribe_spells(at, name)) {
            return equals + 1;
        }
        at = strchr(at, ',');
        at = at != NULL ? at + 1 : NULL;
    }
    return NULL;
}

/* The raw number of another point that this one needs. */
FIELDSCRIBE_ONCE uint64_t fieldscribe_with(fieldscribe_vector *v, const char *name)
{
    const char *const raw = fieldscribe_pair(v, "with", name);
    if (raw == NULL) {
        fieldscribe_differs(v, name);
    }
    return raw != NULL ? fieldscribe_pattern(raw) : 0U;
}

/* ---- Answers ---- */

FIELDSCRIBE_ONCE bool fieldscribe_asks(const fieldscribe_vector *v, const char *kind)
{
    return strcmp(v->own.kind->name, kind) == 0;
}

/* Whether the line asks about this part of the point. */
FIELDSCRIBE_ONCE bool fieldscribe_asks_of(fieldscribe_vector *v, const char *kind, const char *key, const char *name)
{
    return fieldscribe_asks(v, kind) && fieldscribe_spells(fieldscribe_field(v, key), name);
}

/* An answer to a field of the line, or to what else is named so. */
FIELDSCRIBE_ONCE void fieldscribe_agree_on(fieldscribe_vector *v, const char *what, bool same)
{
    v->answered = true;
    if (!same) {
        fieldscribe_differs(v, what);
    }
}

/* An answer that no single field has, such as the status of a call that must succeed. */
FIELDSCRIBE_ONCE void fieldscribe_agree(fieldscribe_vector *v, bool same)
{
    fieldscribe_agree_on(v, "a check beside the fields", same);
}

#define FIELDSCRIBE_ANSWER_MS 900U
#define FIELDSCRIBE_PAUSE_MS 40U

/*
 * The other end of a line: the bytes that come from it, the last one for ever if it is `endless`, and what was sent.
 * Before the byte at `silence` nothing comes once.
 */
typedef struct fieldscribe_stream {
    uint8_t bytes[4 * FIELDSCRIBE_BYTES_MOST];
    size_t count;
    size_t given;
    bool endless;
    size_t silence;    /* 0 for none */
    bool is_silent;    /* it has just been, so the next wait is... */
    uint32_t patience; /* ...this */
    uint32_t waited; /* for the last byte, or for one that did not come */
    uint8_t sent[FIELDSCRIBE_BYTES_MOST];
    size_t sent_count;
} fieldscribe_stream;

static inline void fieldscribe_stream_add(fieldscribe_stream *stream, const uint8_t *bytes, size_t count)
{
    size_t at;
    for (at = 0U; at < count && stream->count < sizeof stream->bytes; ++at) {
        stream->bytes[stream->count] = bytes[at];
        ++stream->count;
    }
}

/*
 * Noise of four kinds before an answer of at least four bytes: none, a byte that begins no answer, the start of an
 * answer that breaks off, and a whole answer with the byte `hurt` wrong. Returns its length.
 */
static inline size_t fieldscribe_stream_noise(
    fieldscribe_stream *stream, unsigned kind, const uint8_t *answer, size_t length, size_t hurt)
{
    const uint8_t wrong = (uint8_t)(answer[0] ^ 0xFFU);
    memset(stream, 0, sizeof *stream);
    if (kind == 1U) {
        fieldscribe_stream_add(stream, &wrong, 1U);
    } else if (kind == 2U) {
        fieldscribe_stream_add(stream, answer, 2U);
        fieldscribe_stream_add(stream, &wrong, 1U);
    } else if (kind == 3U && hurt < length && hurt < sizeof stream->bytes) {
        fieldscribe_stream_add(stream, answer, length);
        stream->bytes[hurt] ^= 0x10U;
    } else {
        /* none */
    }
    return stream->count;
}

static inline void fieldscribe_stream_send(void *context, const uint8_t *bytes, size_t length)
{
    fieldscribe_stream *const stream = (fieldscribe_stream *)context;
    stream->sent_count = length;
    memcpy(stream->sent, bytes, length < sizeof stream->sent ? length : sizeof stream->sent);
}

static inline bool fieldscribe_stream_receive(void *context, uint32_t milliseconds, uint8_t *byte)
{
    fieldscribe_stream *const stream = (fieldscribe_stream *)context;
    const bool more = stream->given < stream->count;
    stream->waited = milliseconds;
    stream->patience = stream->is_silent ? milliseconds : stream->patience;
    stream->is_silent = false;
    if (stream->silence != 0U && stream->silence == stream->given) {
        stream->silence = 0U;
        stream->is_silent = true;
        return false;
    }
    if (more || stream->endless) {
        *byte = stream->bytes[more ? stream->given : stream->count - 1U];
        ++stream->given;
        return true;
    }
    return false;
}

/* Keeps the answer of the code, if it is the first that differs. */
static inline void fieldscribe_gives_number(fieldscribe_vector *v, uint64_t bits)
{
    if (!v->differs) {
        (void)snprintf(v->given, sizeof v->given, "%lld", (long long)bits);
    }
}

FIELDSCRIBE_ONCE void fieldscribe_is_number(fieldscribe_vector *v, const char *key, uint64_t bits)
{
    const char *const field = fieldscribe_field(v, key);
    if (fieldscribe_absent(field) || fieldscribe_pattern(field) != bits) {
        fieldscribe_gives_number(v, bits);
        fieldscribe_differs(v, key);
    }
    v->answered = true;
}

/* The number of a field; 0 if it is absent, as when nothing was read. */
FIELDSCRIBE_ONCE void fieldscribe_is_count(fieldscribe_vector *v, const char *key, uint64_t bits)
{
    fieldscribe_agree_on(v, key, fieldscribe_bits(v, key) == bits);
}

FIELDSCRIBE_ONCE void fieldscribe_is_text(fieldscribe_vector *v, const char *key, const char *text)
{
    const char *const field = fieldscribe_field(v, key);
    const bool same = fieldscribe_absent(field) ? text == NULL : text != NULL && fieldscribe_spells(field, text);
    if (!same && !v->differs) {
        (void)snprintf(v->given, sizeof v->given, "%.40s", text != NULL ? text : "-");
    }
    fieldscribe_agree_on(v, key, same);
}

/* Whether two numbers have the same bits, or are both NaN; a binary32 value is compared with the nearest one. */
FIELDSCRIBE_ONCE void fieldscribe_is_real_of(fieldscribe_vector *v, size_t size, double b)
{
    const double wide = fieldscribe_number_of(v, "value");
    const float narrow = (float)wide;
    const double a = size == sizeof narrow ? (double)narrow : wide;
    const bool nan_a = !(a < 0.0 || a >= 0.0);
    const bool nan_b = !(b < 0.0 || b >= 0.0);
    fieldscribe_agree_on(v, "value", (nan_a || nan_b) ? (nan_a && nan_b) : memcmp(&a, &b, sizeof a) == 0);
}

FIELDSCRIBE_ONCE void fieldscribe_is_bytes(fieldscribe_vector *v, const char *key, const void *bytes, size_t length)
{
    uint8_t expected[FIELDSCRIBE_BYTES_MOST] = {0U};
    const size_t count = fieldscribe_bytes(v, key, expected, sizeof expected);
    fieldscribe_agree_on(v, key, count == length && memcmp(expected, bytes, count) == 0);
}

FIELDSCRIBE_ONCE void fieldscribe_is_words(fieldscribe_vector *v, const char *key, const uint16_t *words, size_t length)
{
    static uint16_t expected[FIELDSCRIBE_VALUES_MOST];
    const size_t count = fieldscribe_numbers(v, key, expected, FIELDSCRIBE_VALUES_MOST);
    fieldscribe_agree_on(v, key, count == length && count <= (size_t)FIELDSCRIBE_VALUES_MOST &&
        memcmp(expected, words, count * sizeof expected[0]) == 0);
}

/* The content of a caller's memory before a call, which shows what the call stores, and where. */
enum { FIELDSCRIBE_PATTERN = 0x5A };

FIELDSCRIBE_ONCE void fieldscribe_fill(void *memory, size_t size)
{
    memset(memory, FIELDSCRIBE_PATTERN, size);
}

/* Checks that nothing was stored from there on. */
FIELDSCRIBE_ONCE void fieldscribe_untouched(fieldscribe_vector *v, const void *memory, size_t size)
{
    const uint8_t *const bytes = (const uint8_t *)memory;
    size_t at = 0U;
    while (at < size && bytes[at] == (uint8_t)FIELDSCRIBE_PATTERN) {
        ++at;
    }
    fieldscribe_agree_on(v, "memory beyond the result", at == size);
}

/* One more pair of a map. */
FIELDSCRIBE_ONCE void fieldscribe_is_pair(fieldscribe_vector *v, const char *key, const char *name, uint64_t bits)
{
    const char *const found = fieldscribe_pair(v, key, name);
    fieldscribe_agree_on(v, name, found != NULL && fieldscribe_pattern(found) == bits);
    ++v->matched;
}

FIELDSCRIBE_ONCE void fieldscribe_is_text_pair(
    fieldscribe_vector *v, const char *key, const char *name, const char *text)
{
    const char *const found = fieldscribe_pair(v, key, name);
    fieldscribe_agree_on(v, name, found != NULL && fieldscribe_spells(found, text));
    ++v->matched;
}

/* The map has no more pairs than were asked for. */
FIELDSCRIBE_ONCE void fieldscribe_are_all_pairs(fieldscribe_vector *v, const char *key)
{
    const char *at = fieldscribe_field(v, key);
    size_t count = 0U;
    while (at != NULL && !fieldscribe_absent(at)) {
        ++count;
        at = strchr(at, ',');
        at = at != NULL ? at + 1 : NULL;
    }
    fieldscribe_agree_on(v, key, count == v->matched);
}

FIELDSCRIBE_ONCE void fieldscribe_is_status(fieldscribe_vector *v, int status)
{
    const fieldscribe_status_name *one = v->suite->statuses;
    while (one->name != NULL && one->status != status) {
        ++one;
    }
    fieldscribe_is_text(v, "status", one->name);
}

/* The name of a status that no vector has. */
#define FIELDSCRIBE_NAMES_STATUS(family, FAMILY, name, status)                                   \
    fieldscribe_agree(v, fieldscribe_spells(name, fieldscribe_##family##_status_name(FIELDSCRIBE_##FAMILY##_##status)));

/* A family's statuses begin with those of conversions, and have their names; 31 is the most that C++ lets them be. */
#define FIELDSCRIBE_NAMES_STATUSES(type, name_of)                                                \
    {                                                                                            \
        const fieldscribe_status_name *one = v->suite->statuses;                                 \
        for (; one->name != NULL; ++one) {                                                       \
            fieldscribe_agree(v, fieldscribe_spells(one->name, name_of((type)one->status)));     \
        }                                                                                        \
        fieldscribe_agree(v, fieldscribe_spells("unknown", name_of((type)31)));                  \
    }

/* Checks a status and, if it is ok, a number; otherwise nothing may have been stored. */
FIELDSCRIBE_ONCE void fieldscribe_stored(
    fieldscribe_vector *v, int status, const char *key, uint64_t bits, bool untouched)
{
    fieldscribe_is_status(v, status);
    if (status == 0) {
        fieldscribe_is_number(v, key, bits);
    } else {
        fieldscribe_agree_on(v, key, untouched && fieldscribe_absent(fieldscribe_field(v, key)));
    }
}

/* The content of a number before it is read: not the expected one, or 1 if none is expected. */
FIELDSCRIBE_ONCE uint64_t fieldscribe_other(fieldscribe_vector *v)
{
    return fieldscribe_bits(v, "raw") ^ 1U;
}

/* ---- What points answer ---- */

/* The raw numbers of other points, as further arguments of a call; or none. */
#define FIELDSCRIBE_ALONE
#define FIELDSCRIBE_WITH(name, type) , (type)fieldscribe_with(v, name)
#define FIELDSCRIBE_TOGETHER(filled) , filled(v)

/* Whether the type of an argument holds the number; if not, it is out of range by the type alone. */
FIELDSCRIBE_ONCE bool fieldscribe_fits_int32_t(const char *field)
{
    const uint64_t bits = fieldscribe_pattern(field);
    return (uint64_t)(int32_t)bits == bits && ((int32_t)bits < 0) == (*field == '-');
}

FIELDSCRIBE_ONCE bool fieldscribe_fits_int64_t(const char *field)
{
    return ((int64_t)fieldscribe_pattern(field) < 0) == (*field == '-');
}

FIELDSCRIBE_ONCE bool fieldscribe_fits_uint64_t(const char *field)
{
    return *field != '-';
}

#define FIELDSCRIBE_CHECK(function, raw_type, with)                                              \
    if (fieldscribe_asks(v, "check")) {                                                          \
        fieldscribe_is_status(v, (int)function((raw_type)fieldscribe_bits(v, "raw") with));      \
    }

#define FIELDSCRIBE_ENCODE_COUNT(function, count_type, raw_type, with)                           \
    if (fieldscribe_asks(v, "encode_count")) {                                                   \
        const raw_type before = (raw_type)((fieldscribe_bits(v, "count") & 1U) == 0U);           \
        raw_type raw = before;                                                                   \
        int status = 1; /* out of range */                                                       \
        if (fieldscribe_fits_##count_type(fieldscribe_field(v, "count"))) {                      \
            status = (int)function((count_type)fieldscribe_bits(v, "count") with, &raw);         \
        }                                                                                        \
        fieldscribe_stored(v, status, "raw", (uint64_t)raw, raw == before);                      \
    }

#define FIELDSCRIBE_DECODE_COUNT(function, count_type, raw_type, with)                           \
    if (fieldscribe_asks(v, "decode_count")) {                                                   \
        const count_type count = (count_type)function((raw_type)fieldscribe_bits(v, "raw") with); \
        fieldscribe_stored(v, 0, "count", (uint64_t)count, false);                               \
    }

#define FIELDSCRIBE_TRY_DECODE_COUNT(function, count_type, raw_type, with)                       \
    if (fieldscribe_asks(v, "decode_count")) {                                                   \
        count_type count = (count_type)1;                                                        \
        const int status = (int)function((raw_type)fieldscribe_bits(v, "raw") with, &count);     \
        fieldscribe_stored(v, status, "count", (uint64_t)count, count == (count_type)1);         \
    }

/* Counts of a binary32 pattern. */
#define FIELDSCRIBE_F32_DECODE_COUNT(function)                                                   \
    if (fieldscribe_asks(v, "f32_decode_count")) {                                               \
        int64_t count = 1;                                                                       \
        const int status = (int)function((uint32_t)fieldscribe_bits(v, "raw"), &count);          \
        fieldscribe_stored(v, status, "count", (uint64_t)count, count == 1);                     \
    }

#define FIELDSCRIBE_F32_DECIMALS(macro)                                                          \
    if (fieldscribe_asks(v, "f32_decimals")) {                                                   \
        fieldscribe_is_number(v, "decimals", (uint64_t)(macro##_DECIMALS));                      \
    }

#define FIELDSCRIBE_F32_ENCODE_COUNT(function)                                                   \
    if (fieldscribe_asks(v, "f32_encode_count")) {                                               \
        uint32_t raw = 1U;                                                                       \
        const int status = (int)function((int64_t)fieldscribe_bits(v, "count"), &raw);           \
        fieldscribe_stored(v, status, "raw", raw, raw == 1U);                                    \
    }

#if defined(FIELDSCRIBE_NO_FLOAT)
#define FIELDSCRIBE_ENCODE(function, real_type, raw_type, with)
#define FIELDSCRIBE_DECODE(function, real_type, raw_type, with)
#define FIELDSCRIBE_TRY_DECODE(function, real_type, raw_type, with)
#else
/* Whether the type holds a value of the line; with float, other values are left out. */
FIELDSCRIBE_ONCE bool fieldscribe_holds(fieldscribe_vector *v, size_t size)
{
    const double value = fieldscribe_number_of(v, "value");
    const float narrow = (float)value;
    const double back = (double)narrow;
    const bool held = size > sizeof narrow || !(back < value || back > value);
    if (!held) {
        (void)fieldscribe_field(v, "raw");
        fieldscribe_agree(v, !fieldscribe_absent(fieldscribe_field(v, "status")));
    }
    return held;
}

#define FIELDSCRIBE_ENCODE(function, real_type, raw_type, with)                                  \
    if (fieldscribe_asks(v, "encode") && fieldscribe_holds(v, sizeof(real_type))) {              \
        raw_type raw = (raw_type)1;                                                              \
        const int status = (int)function((real_type)fieldscribe_number_of(v, "value") with, &raw);    \
        fieldscribe_stored(v, status, "raw", (uint64_t)raw, raw == (raw_type)1);                 \
    }

#define FIELDSCRIBE_DECODE(function, real_type, raw_type, with)                                  \
    if (fieldscribe_asks(v, "decode")) {                                                         \
        fieldscribe_is_status(v, 0);                                                             \
        fieldscribe_is_real_of(v, sizeof(real_type), (double)function((raw_type)fieldscribe_bits(v, "raw") with)); \
    }

#define FIELDSCRIBE_TRY_DECODE(function, real_type, raw_type, with)                              \
    if (fieldscribe_asks(v, "decode")) {                                                         \
        real_type value = (real_type)1;                                                          \
        const int status = (int)function((raw_type)fieldscribe_bits(v, "raw") with, &value);     \
        fieldscribe_is_status(v, status);                                                        \
        if (status == 0) {                                                                       \
            fieldscribe_is_real_of(v, sizeof(real_type), (double)value);                         \
        } else {                                                                                 \
            fieldscribe_agree(v, value >= (real_type)1 && value <= (real_type)1);                \
        }                                                                                        \
    }
#endif

#define FIELDSCRIBE_NAME(function, number_type)                                                  \
    if (fieldscribe_asks(v, "name")) {                                                           \
        fieldscribe_is_text(v, "name", function((number_type)fieldscribe_bits(v, "raw")));       \
    }

/* The constants of names that several points share; the program has a function for them. */
#define FIELDSCRIBE_NAMES_OF(names) names_of_##names(v);

/* The constant of a name. */
#define FIELDSCRIBE_NAMED(named, constant)                                                       \
    if (fieldscribe_asks_of(v, "name", "name", named)) {                                         \
        fieldscribe_is_number(v, "raw", (uint64_t)(constant));                                   \
    }

/*
 * A group of bits in a word, with its macros _MASK and _SHIFT. `order` puts the high byte of the word first; it is a
 * cast if that is first already. `is_plain` says that the bits are the number.
 */
#define FIELDSCRIBE_BITS_IN(order, is_plain, function, raw_type, macro)                          \
    if (fieldscribe_asks(v, "bits")) {                                                           \
        const uint16_t word = (uint16_t)fieldscribe_bits(v, "word");                             \
        const raw_type put = (raw_type)fieldscribe_bits(v, "replaced");                          \
        const uint32_t ones = (uint32_t)(macro##_MASK) >> macro##_SHIFT;                         \
        fieldscribe_agree(v, !(is_plain) || (order(word) & (uint32_t)(macro##_MASK)) ==          \
            ((uint32_t)fieldscribe_bits(v, "raw") & ones) << macro##_SHIFT);                     \
        fieldscribe_is_number(v, "raw", (uint64_t)function##_extract(word));                     \
        fieldscribe_agree(v, function##_extract(order(macro##_MASK)) == function##_extract(0xFFFFU)); \
        fieldscribe_is_number(v, "result", (uint64_t)function##_insert(word, put));              \
    }

/* A group of bits whose high byte is first and that has no coding. */
#define FIELDSCRIBE_BITS(function, raw_type, macro) FIELDSCRIBE_BITS_IN((uint16_t), true, function, raw_type, macro)

#define FIELDSCRIBE_WORDS(function, raw_type, count)                                             \
    if (fieldscribe_asks(v, "words")) {                                                          \
        uint16_t words[count + 1U];                                                              \
        fieldscribe_fill(words, sizeof words);                                                   \
        function##_to_words((raw_type)fieldscribe_bits(v, "raw"), words);                        \
        fieldscribe_is_words(v, "words", words, count);                                          \
        fieldscribe_untouched(v, words + count, sizeof words[0]);                                \
        fieldscribe_is_number(v, "raw", (uint64_t)function##_from_words(words));                 \
    }

/* A point whose only word is the raw number itself. */
#define FIELDSCRIBE_ONE_WORD(raw_type)                                                           \
    if (fieldscribe_asks(v, "words")) {                                                          \
        const raw_type raw = (raw_type)fieldscribe_bits(v, "raw");                               \
        const uint16_t word = (uint16_t)raw;                                                     \
        fieldscribe_is_words(v, "words", &word, 1U);                                             \
        fieldscribe_is_number(v, "raw", (uint64_t)raw);                                          \
    }

/* A number that is its raw number: read and written, without special codes, and no other point in its limits. */
#define FIELDSCRIBE_PLAIN(point, number_type, raw_type)                                          \
    FIELDSCRIBE_CHECK(point##_check, raw_type, FIELDSCRIBE_ALONE)                                \
    FIELDSCRIBE_ENCODE_COUNT(point##_encode, number_type, raw_type, FIELDSCRIBE_ALONE)           \
    FIELDSCRIBE_DECODE_COUNT(point##_decode, number_type, raw_type, FIELDSCRIBE_ALONE)

/* A scaled number with counts and values: read and written, needs no other point, and decoding cannot fail. */
#define FIELDSCRIBE_COUNTS(point, count_type, raw_type, real_type)                               \
    FIELDSCRIBE_CHECK(point##_check, raw_type, FIELDSCRIBE_ALONE)                                \
    FIELDSCRIBE_ENCODE_COUNT(point##_encode_count, count_type, raw_type, FIELDSCRIBE_ALONE)      \
    FIELDSCRIBE_DECODE_COUNT(point##_decode_count, count_type, raw_type, FIELDSCRIBE_ALONE)      \
    FIELDSCRIBE_ENCODE(point##_encode, real_type, raw_type, FIELDSCRIBE_ALONE)                   \
    FIELDSCRIBE_DECODE(point##_decode, real_type, raw_type, FIELDSCRIBE_ALONE)

/* A header has space, code and references in comments only: here they are the model's. The code may be NULL. */
#define FIELDSCRIBE_ADDRESS(macro, space, word_count, code, others)                              \
    if (fieldscribe_asks(v, "address")) {                                                        \
        fieldscribe_is_number(v, "address", macro##_ADDRESS);                                    \
        fieldscribe_is_text(v, "space", space);                                                  \
        fieldscribe_is_number(v, "words", word_count);                                           \
        fieldscribe_is_text(v, "code", code);                                                    \
        others                                                                                   \
        fieldscribe_are_all_pairs(v, "references");                                              \
    }

/* The facts beside an address that not all points have. */
#define FIELDSCRIBE_REFERENCE(key, number) fieldscribe_is_pair(v, "references", key, (uint64_t)(number));
#define FIELDSCRIBE_REFERENCE_TEXT(key, text) fieldscribe_is_text_pair(v, "references", key, text);

/* The ends of the raw numbers: of a point without macros for them, as it is only read. */
#define FIELDSCRIBE_ONLY_READ(low, high)                                                         \
    fieldscribe_is_number(v, "raw_min", (uint64_t)(low));                                        \
    fieldscribe_is_number(v, "raw_max", (uint64_t)(high));

/* The same of a point that is written, with the macros _RAW_MIN and _RAW_MAX. */
#define FIELDSCRIBE_RAWS(macro)                                                                  \
    fieldscribe_is_number(v, "raw_min", (uint64_t)(macro##_RAW_MIN));                            \
    fieldscribe_is_number(v, "raw_max", (uint64_t)(macro##_RAW_MAX));
#define FIELDSCRIBE_DECIMALS(macro) fieldscribe_is_number(v, "decimals", (uint64_t)(macro##_DECIMALS));

/* The ends and the decimals of a point that is written and has counts. */
#define FIELDSCRIBE_COUNTED(macro)                                                               \
    FIELDSCRIBE_RAWS(macro)                                                                      \
    FIELDSCRIBE_DECIMALS(macro)

/* The words of a point in order, and the facts beside them. */
#define FIELDSCRIBE_INDEX(macro) fieldscribe_is_number(v, "index", (uint64_t)(macro##_INDEX));
#define FIELDSCRIBE_TELEGRAM(macro) fieldscribe_is_text(v, "telegram", v->suite->telegrams[macro##_TELEGRAM]);
#define FIELDSCRIBE_PLACED(macro, offset) (uint16_t)(macro##_ADDRESS + offset),
#define FIELDSCRIBE_PLACE(placed, others)                                                        \
    if (fieldscribe_asks(v, "place")) {                                                          \
        const uint16_t addresses[] = {placed};                                                   \
        fieldscribe_is_words(v, "addresses", addresses, sizeof addresses / sizeof addresses[0]); \
        others                                                                                   \
    }
#define FIELDSCRIBE_PLACE_OF_TEXT(macro, function, others)                                       \
    if (fieldscribe_asks(v, "place")) {                                                          \
        const size_t count = sizeof function##_addresses / sizeof function##_addresses[0];       \
        fieldscribe_is_words(v, "addresses", function##_addresses, count);                       \
        others                                                                                   \
    }

#define FIELDSCRIBE_WRITE_ADDRESS(macro)                                                         \
    if (fieldscribe_asks(v, "write_address")) {                                                  \
        fieldscribe_is_number(v, "address", (uint64_t)(macro##_WRITE_ADDRESS));                  \
    }

#define FIELDSCRIBE_DISPLAY(macro)                                                               \
    if (fieldscribe_asks(v, "display")) {                                                        \
        fieldscribe_is_number(v, "decimals", (uint64_t)(macro##_DISPLAY_DECIMALS));              \
    }

#define FIELDSCRIBE_EPOCH(macro)                                                                 \
    if (fieldscribe_asks(v, "epoch")) {                                                          \
        fieldscribe_is_number(v, "seconds", (uint64_t)(macro##_EPOCH));                          \
    }

#define FIELDSCRIBE_FIXED(macro)                                                                 \
    if (fieldscribe_asks(v, "fixed")) {                                                          \
        fieldscribe_is_number(v, "mask", (uint64_t)(macro##_FIXED_MASK));                        \
        fieldscribe_is_number(v, "bits", (uint64_t)(macro##_FIXED_BITS));                        \
    }

#define FIELDSCRIBE_TEXT_DECODE(function, macro)                                                 \
    if (fieldscribe_asks(v, "text_decode")) {                                                    \
        uint16_t words[macro##_WORDS];                                                           \
        char text[macro##_CHARACTERS + 2U];                                                      \
        const size_t count = fieldscribe_numbers(v, "words", words, macro##_WORDS);              \
        size_t length;                                                                           \
        fieldscribe_fill(text, sizeof text);                                                     \
        length = function##_decode(words, text);                                                 \
        fieldscribe_agree(v, count == macro##_WORDS && length <= macro##_CHARACTERS && text[length] == '\0'); \
        fieldscribe_untouched(v, text + macro##_CHARACTERS + 1U, 1U);                            \
        fieldscribe_is_bytes(v, "text", text, length);                                           \
    }

#define FIELDSCRIBE_ENCODE_OF(kind, function, macro)                                             \
    if (fieldscribe_asks(v, kind)) {                                                             \
        uint8_t text[FIELDSCRIBE_BYTES_MOST] = {0U};                                             \
        uint16_t words[macro##_WORDS + 1U];                                                      \
        const size_t length = fieldscribe_bytes(v, "text", text, sizeof text);                   \
        int status;                                                                              \
        fieldscribe_fill(words, sizeof words);                                                   \
        status = (int)function##_encode((const char *)text, length, words);                      \
        fieldscribe_is_status(v, status);                                                        \
        fieldscribe_untouched(v, words + (status == 0 ? macro##_WORDS : 0U),                     \
            status == 0 ? sizeof words[0] : sizeof words);                                       \
        fieldscribe_is_words(v, "words", words, status == 0 ? macro##_WORDS : 0U);               \
    }

#define FIELDSCRIBE_TEXT_ENCODE(function, macro) FIELDSCRIBE_ENCODE_OF("text_encode", function, macro)
#define FIELDSCRIBE_UNICODE_ENCODE(function, macro) FIELDSCRIBE_ENCODE_OF("unicode_encode", function, macro)

#define FIELDSCRIBE_UNICODE_DECODE(function, macro, bytes)                                       \
    if (fieldscribe_asks(v, "unicode_decode")) {                                                 \
        uint16_t words[macro##_WORDS];                                                           \
        char text[(bytes) + 2U];                                                                 \
        const size_t count = fieldscribe_numbers(v, "words", words, macro##_WORDS);              \
        size_t length = 0U;                                                                      \
        int status;                                                                              \
        fieldscribe_fill(text, sizeof text);                                                     \
        status = (int)function##_decode(words, text, &length);                                   \
        fieldscribe_is_status(v, status);                                                        \
        fieldscribe_agree(v, count == macro##_WORDS && length <= (bytes) && text[length] == '\0'); \
        fieldscribe_untouched(v, text + (bytes) + 1U, 1U);                                       \
        fieldscribe_is_bytes(v, "text", text, status == 0 ? length : 0U);                        \
    }

#define FIELDSCRIBE_BYTES_DECODE(function, macro)                                                \
    if (fieldscribe_asks(v, "bytes_decode")) {                                                   \
        uint16_t words[macro##_WORDS];                                                           \
        uint8_t bytes[macro##_BYTES + 1U];                                                       \
        const size_t count = fieldscribe_numbers(v, "words", words, macro##_WORDS);              \
        fieldscribe_fill(bytes, sizeof bytes);                                                   \
        function##_decode(words, bytes);                                                         \
        fieldscribe_agree(v, count == macro##_WORDS);                                            \
        fieldscribe_untouched(v, bytes + macro##_BYTES, 1U);                                     \
        fieldscribe_is_bytes(v, "bytes", (const char *)bytes, macro##_BYTES);                    \
    }

#define FIELDSCRIBE_BYTES_ENCODE(function, macro)                                                \
    if (fieldscribe_asks(v, "bytes_encode")) {                                                   \
        uint8_t bytes[macro##_BYTES] = {0U};                                                     \
        uint16_t words[macro##_WORDS + 1U];                                                      \
        const size_t length = fieldscribe_bytes(v, "bytes", bytes, sizeof bytes);                \
        fieldscribe_fill(words, sizeof words);                                                   \
        function##_encode(bytes, words);                                                         \
        fieldscribe_agree(v, length == sizeof bytes);                                            \
        fieldscribe_untouched(v, words + macro##_WORDS, sizeof words[0]);                        \
        fieldscribe_is_words(v, "words", words, macro##_WORDS);                                  \
    }

#define FIELDSCRIBE_DATE_DECODE(function, macro)                                                 \
    if (fieldscribe_asks(v, "date_decode")) {                                                    \
        uint16_t words[macro##_WORDS];                                                           \
        const size_t count = fieldscribe_numbers(v, "words", words, macro##_WORDS);              \
        fieldscribe_date_time time = {0U, 0U, 0U, 0U, 0U, 0U, 0U};                               \
        const int status = (int)function##_decode(words, &time);                                 \
        const uint16_t numbers[7] = {                                                            \
            time.year, time.month, time.day, time.hour, time.minute, time.second, time.millisecond}; \
        fieldscribe_agree(v, count == macro##_WORDS);                                            \
        fieldscribe_is_status(v, status);                                                        \
        fieldscribe_is_words(v, "numbers", numbers, status == 0 ? 7U : 0U);                      \
    }

#define FIELDSCRIBE_DATE_ENCODE(function, macro)                                                 \
    if (fieldscribe_asks(v, "date_encode")) {                                                    \
        uint16_t n[7] = {0U};                                                                    \
        uint16_t words[macro##_WORDS + 1U];                                                      \
        const size_t count = fieldscribe_numbers(v, "numbers", n, 7U);                           \
        const fieldscribe_date_time time = {                                                     \
            n[0], (uint8_t)n[1], (uint8_t)n[2], (uint8_t)n[3], (uint8_t)n[4], (uint8_t)n[5], n[6]}; \
        int status;                                                                              \
        fieldscribe_fill(words, sizeof words);                                                   \
        status = (int)function##_encode(&time, words);                                           \
        fieldscribe_agree(v, count == 7U);                                                       \
        fieldscribe_is_status(v, status);                                                        \
        fieldscribe_untouched(v, words + (status == 0 ? macro##_WORDS : 0U),                     \
            status == 0 ? sizeof words[0] : sizeof words);                                       \
        fieldscribe_is_words(v, "words", words, status == 0 ? macro##_WORDS : 0U);               \
    }

#define FIELDSCRIBE_DIGITS(function, digit_type, macro)                                          \
    if (fieldscribe_asks(v, "digits")) {                                                         \
        digit_type digits[macro##_DIGITS + 1U];                                                  \
        uint16_t numbers[macro##_DIGITS];                                                        \
        size_t at;                                                                               \
        fieldscribe_fill(digits, sizeof digits);                                                 \
        function##_decode((uint16_t)fieldscribe_bits(v, "raw"), digits);                         \
        for (at = 0U; at < macro##_DIGITS; ++at) {                                               \
            numbers[at] = digits[at];                                                            \
        }                                                                                        \
        fieldscribe_is_status(v, 0);                                                             \
        fieldscribe_untouched(v, digits + macro##_DIGITS, sizeof digits[0]);                     \
        fieldscribe_is_words(v, "digits", numbers, macro##_DIGITS);                              \
    }

#define FIELDSCRIBE_TRY_DIGITS(function, digit_type, macro)                                      \
    if (fieldscribe_asks(v, "digits")) {                                                         \
        digit_type digits[macro##_DIGITS] = {0U};                                                \
        uint16_t numbers[macro##_DIGITS] = {0U};                                                 \
        size_t at;                                                                               \
        const int status = (int)function##_decode((uint16_t)fieldscribe_bits(v, "raw"), digits); \
        for (at = 0U; at < macro##_DIGITS; ++at) {                                               \
            numbers[at] = digits[at];                                                            \
        }                                                                                        \
        fieldscribe_is_status(v, status);                                                        \
        fieldscribe_is_words(v, "digits", numbers, status == 0 ? macro##_DIGITS : 0U);           \
    }

#define FIELDSCRIBE_DIGITS_ENCODE(function, digit_type, macro)                                   \
    if (fieldscribe_asks(v, "digits_encode")) {                                                  \
        digit_type digits[macro##_DIGITS];                                                       \
        uint16_t numbers[macro##_DIGITS] = {0U};                                                 \
        uint16_t raw = 1U;                                                                       \
        int status;                                                                              \
        size_t at;                                                                               \
        const size_t count = fieldscribe_numbers(v, "digits", numbers, macro##_DIGITS);          \
        for (at = 0U; at < macro##_DIGITS; ++at) {                                               \
            digits[at] = (digit_type)numbers[at];                                                \
        }                                                                                        \
        status = (int)function##_encode(digits, &raw);                                           \
        fieldscribe_agree(v, count == macro##_DIGITS);                                           \
        fieldscribe_stored(v, status, "raw", raw, raw == 1U);                                    \
    }

/* A flag of several bits: its number and its place. */
#define FIELDSCRIBE_WIDE_FLAG(flag, raw_type, function, macro)                                   \
    if (fieldscribe_asks_of(v, "flag", "flag", flag)) {                                          \
        const uint64_t raw = fieldscribe_bits(v, "raw");                                         \
        fieldscribe_is_number(v, "number", (uint64_t)function((raw_type)raw));                   \
        fieldscribe_agree(v, (raw & (uint64_t)(macro##_MASK)) == fieldscribe_bits(v, "number") << macro##_SHIFT); \
    }

/* A flag of one bit, and whether it is true: `low` has the bits that are 0 when they are. */
#define FIELDSCRIBE_TRUTH(flag, raw_type, mask, low)                                             \
    if (fieldscribe_asks_of(v, "flag", "flag", flag)) {                                          \
        const raw_type raw = (raw_type)fieldscribe_bits(v, "raw");                               \
        fieldscribe_is_number(v, "number", (raw & (mask)) != 0U ? 1U : 0U);                      \
        fieldscribe_is_number(v, "truth", ((raw ^ (low)) & (mask)) != 0U ? 1U : 0U);             \
    }

#define FIELDSCRIBE_FLAG_NAME(flag, value, constant)                                             \
    if (fieldscribe_asks_of(v, "flag_name", "flag", flag) && fieldscribe_asks_of(v, "flag_name", "name", value)) { \
        fieldscribe_is_number(v, "raw", (uint64_t)(constant));                                   \
    }

#define FIELDSCRIBE_SPECIAL(special, first, last)                                                \
    if (fieldscribe_asks_of(v, "special", "special", special)) {                                 \
        fieldscribe_is_number(v, "low", (uint64_t)(first));                                      \
        fieldscribe_is_number(v, "high", (uint64_t)(last));                                      \
    }

/* The special code of a raw number, and the one that decoding returns. */
#define FIELDSCRIBE_SPECIAL_NAME(function, raw_type)                                             \
    if (fieldscribe_asks(v, "special_name")) {                                                   \
        const raw_type raw = (raw_type)fieldscribe_bits(v, "raw");                               \
        const char *const name = function##_special_name(raw);                                   \
        fieldscribe_is_text(v, "name", name);                                                    \
        fieldscribe_is_count(v, "no_value", function##_is_no_value(raw) ? 1U : 0U);              \
        fieldscribe_agree(v, function##_is_special(raw) == (name != NULL));                      \
    }                                                                                            \
    if (fieldscribe_asks(v, "decode") || fieldscribe_asks(v, "decode_count") || fieldscribe_asks(v, "digits")) {\
        const raw_type raw = (raw_type)fieldscribe_bits(v, "raw");                               \
        fieldscribe_is_text(v, "special", function##_special_name(raw));                         \
    }

/* ---- What the protocol names ---- */

#define FIELDSCRIBE_CODE_NUMBER(kind, code, constant)                                            \
    if ((fieldscribe_asks_of(v, "code", "what", kind) || fieldscribe_asks_of(v, "constant", "what", kind)) && \
        fieldscribe_spells(fieldscribe_field(v, "name"), code)) { \
        fieldscribe_is_number(v, "number", (uint64_t)(constant));                                \
    }

#define FIELDSCRIBE_CODE_NAME(kind, function)                                                    \
    if (fieldscribe_asks_of(v, "code", "what", kind) || fieldscribe_asks_of(v, "constant", "what", kind)) { \
        fieldscribe_is_text(v, "name", function((uint16_t)fieldscribe_bits(v, "number")));       \
        fieldscribe_agree(v, function(65535U) == NULL);                                          \
    }

#define FIELDSCRIBE_DOCUMENTED(point, space, macro, index)                                       \
    if (fieldscribe_asks_of(v, "documented", "name", point)) {                                   \
        fieldscribe_is_text(v, "space", space);                                                  \
        fieldscribe_is_number(v, "address", macro##_ADDRESS);                                    \
        fieldscribe_is_number(v, "words", macro##_WORDS);                                        \
        index                                                                                    \
    }

/* Whether the line asks about this part of the device, or about no part if there is none. */
FIELDSCRIBE_ONCE bool fieldscribe_is_part(fieldscribe_vector *v, const char *part)
{
    const char *const field = fieldscribe_field(v, "of");
    return fieldscribe_absent(field) ? *part == '\0' : fieldscribe_spells(field, part);
}

/* A number that limits the protocol, or a table. */
#define FIELDSCRIBE_LIMIT(limit, constant)                                                       \
    if (fieldscribe_asks_of(v, "limit", "what", limit)) {                                        \
        fieldscribe_is_number(v, "number", (uint64_t)(constant));                                \
    }
#define FIELDSCRIBE_LIMIT_OF(limit, part, constant)                                              \
    if (fieldscribe_asks_of(v, "size", "what", limit) && fieldscribe_is_part(v, part)) {         \
        fieldscribe_is_number(v, "number", (uint64_t)(constant));                                \
    }

/* What identifies a device, or a variant of it: a raw number or a text. */
#define FIELDSCRIBE_IDENTIFICATION_RAW(constant) fieldscribe_is_number(v, "raw", (uint64_t)(constant))
#define FIELDSCRIBE_IDENTIFICATION_TEXT(constant) fieldscribe_is_text(v, "text", constant)
#define FIELDSCRIBE_IDENTIFICATION(identification, point, is)                                                \
    if (fieldscribe_asks_of(v, "identification", "name", identification)) {                                  \
        fieldscribe_is_text(v, "of", point);                                                     \
        FIELDSCRIBE_IDENTIFICATION_##is;                                                               \
    }
#define FIELDSCRIBE_IDENTIFICATION_OF(identification, axis, value)                                           \
    if (fieldscribe_asks_of(v, "identification", "name", identification)) {                                  \
        fieldscribe_is_text_pair(v, "variant", axis, value);                                     \
        fieldscribe_are_all_pairs(v, "variant");                                                 \
    }

/* The old names of a point: each means the same as the new one. */
typedef void (*fieldscribe_function)(void);

FIELDSCRIBE_ONCE bool fieldscribe_same_function(fieldscribe_function one, fieldscribe_function other)
{
    return one == other;
}

FIELDSCRIBE_ONCE bool fieldscribe_same_object(const void *one, const void *other)
{
    return one == other;
}

FIELDSCRIBE_ONCE bool fieldscribe_same_number(uint64_t one, uint64_t other)
{
    return one == other;
}

#define FIELDSCRIBE_ALIAS(was, point, same)                                                      \
    if (fieldscribe_asks_of(v, "alias", "old", was)) {                                           \
        fieldscribe_is_text(v, "new", point);                                                    \
        fieldscribe_agree(v, same);                                                              \
    }
/* A struct has a name in place of an address. */
#define FIELDSCRIBE_ALIAS_OF_STRUCT(was, point, old_name, new_name)                              \
    FIELDSCRIBE_ALIAS(was, point, sizeof(old_name) == sizeof(new_name))
#define FIELDSCRIBE_ALIAS_OF_OBJECT(was, point, old_name, new_name)                              \
    FIELDSCRIBE_ALIAS(was, point, fieldscribe_same_object(&(old_name), &(new_name)))
#define FIELDSCRIBE_ALIAS_OF_NUMBER(was, point, old_name, new_name)                              \
    FIELDSCRIBE_ALIAS(was, point, fieldscribe_same_number((uint64_t)(old_name), (uint64_t)(new_name)))
#define FIELDSCRIBE_ALIAS_OF_TEXT(was, point, old_name, new_name)                                \
    FIELDSCRIBE_ALIAS(was, point, strcmp(old_name, new_name) == 0)
#define FIELDSCRIBE_ALIAS_OF_FUNCTION(was, point, old_name, new_name)                            \
    FIELDSCRIBE_ALIAS(                                                                           \
        was, point, fieldscribe_same_function((fieldscribe_function)(old_name), (fieldscribe_function)(new_name)))
#if defined(FIELDSCRIBE_NO_FLOAT)
#define FIELDSCRIBE_ALIAS_OF_FLOATING_FUNCTION(was, point, old_name, new_name)
#else
#define FIELDSCRIBE_ALIAS_OF_FLOATING_FUNCTION FIELDSCRIBE_ALIAS_OF_FUNCTION
#endif

#define FIELDSCRIBE_GROUP(group, array, size)                                                    \
    if (fieldscribe_asks_of(v, "group", "group", group)) {                                       \
        fieldscribe_agree(v, sizeof array / sizeof array[0] == size);                            \
        fieldscribe_is_words(v, "addresses", array, size);                                       \
    }

/* ---- Raw numbers in words ---- */

/* Whether the other bits of a word are other points, and which of them are constant. It answers no field of its own. */
FIELDSCRIBE_ONCE void fieldscribe_lies(
    fieldscribe_vector *v, const fieldscribe_layout *layout, bool shared, uint64_t mask, uint64_t bits)
{
    if (layout->shares != shared || layout->fixed_mask != mask || layout->fixed_bits != bits) {
        fieldscribe_differs(v, "the layout of the point's word");
    }
}

#define FIELDSCRIBE_LIES(frame, shared, mask, bits) fieldscribe_lies(v, (frame).layout, shared, mask, bits);

/* A number that shares no word, and has no constant bits. */
#define FIELDSCRIBE_LIES_ALONE(frame) FIELDSCRIBE_LIES(frame, false, 0U, 0U)

/* Such a number with a request that reads it and one that writes it; its family has both macros. */
#define FIELDSCRIBE_READ_WRITE(frame, kind)                                                      \
    FIELDSCRIBE_LIES_ALONE(frame)                                                                \
    FIELDSCRIBE_READ(frame, kind)                                                                \
    FIELDSCRIBE_WRITE(frame, kind)

/* The same layout, of another type. */
FIELDSCRIBE_ONCE fieldscribe_layout fieldscribe_other_type(const fieldscribe_layout *layout)
{
    fieldscribe_layout other = *layout;
    other.type = (uint8_t)(layout->type + 1U);
    return other;
}

/* The least number that has no room in the bits of a point, with or without a sign. */
FIELDSCRIBE_ONCE uint32_t fieldscribe_too_much(const fieldscribe_layout *layout)
{
    const uint32_t most = (uint32_t)(layout->mask >> layout->shift);
    const bool with_sign = layout->type == (uint8_t)FIELDSCRIBE_S8 || layout->type == (uint8_t)FIELDSCRIBE_S16;
    return (with_sign ? most >> 1 : most) + 1U;
}

/* Whether a point with words of its own has all the bits of its type, or the lower ones and some in each word. */
FIELDSCRIBE_ONCE bool fieldscribe_has_its_bits(const fieldscribe_layout *layout, size_t size)
{
    const uint64_t all = UINT64_MAX >> (64U - 8U * size);
    const uint64_t behind = layout->words > 1U ? UINT64_MAX >> (80U - 16U * layout->words) : all;
    const bool narrow = layout->mask > behind && layout->mask < all && (layout->mask & (layout->mask + 1U)) == 0U;
    return layout->shares || layout->type == (uint8_t)FIELDSCRIBE_BIT || layout->mask == all || narrow;
}

/* Whether the bits of a point are all that its type has. */
FIELDSCRIBE_ONCE bool fieldscribe_fills(const fieldscribe_layout *layout, size_t size)
{
    return layout->type == (uint8_t)FIELDSCRIBE_BIT || (layout->mask >> layout->shift) >> (8U * size - 1U) != 0U;
}

/*
 * By kind of number. `taken`: the raw number of the line out of words; a layout of another type stores nothing, and too
 * few words bring nothing. `put`: that of a field into words; one that has too few of them, or no room in a shared one,
 * changes nothing.
 */
#define FIELDSCRIBE_KIND(kind, raw_type)                                                         \
    FIELDSCRIBE_ONCE void fieldscribe_taken_##kind(                                              \
        fieldscribe_vector *v, const fieldscribe_layout *how, const uint16_t *from)              \
    {                                                                                            \
        const fieldscribe_layout other_type = fieldscribe_other_type(how);                       \
        raw_type raw = (raw_type)fieldscribe_other(v);                                           \
        fieldscribe_agree(v, fieldscribe_has_its_bits(how, sizeof raw));                         \
        fieldscribe_agree(v, !fieldscribe_take_##kind(&other_type, from, how->words, &raw) &&    \
            !fieldscribe_take_##kind(how, from, how->words - 1U, &raw) &&                        \
            !fieldscribe_take_##kind(how, NULL, how->words, &raw) && raw == (raw_type)fieldscribe_other(v)); \
        fieldscribe_agree(v, fieldscribe_take_##kind(how, from, how->words, &raw));              \
        fieldscribe_is_number(v, "raw", (uint64_t)raw);                                          \
    }                                                                                            \
    FIELDSCRIBE_ONCE void fieldscribe_put_field_##kind(                                          \
        fieldscribe_vector *v, const fieldscribe_layout *how, const char *field, uint16_t *into) \
    {                                                                                            \
        const fieldscribe_layout other_type = fieldscribe_other_type(how);                       \
        const raw_type raw = (raw_type)fieldscribe_bits(v, field);                               \
        const uint16_t before = into[0];                                                         \
        fieldscribe_agree(v, fieldscribe_has_its_bits(how, sizeof raw));                         \
        fieldscribe_agree(v, !fieldscribe_put_##kind(&other_type, raw, into, how->words) &&      \
            !fieldscribe_put_##kind(how, raw, into, how->words - 1U) &&                          \
            !fieldscribe_put_##kind(how, raw, NULL, how->words));                                \
        if (how->shares && !fieldscribe_fills(how, sizeof(raw_type))) {                          \
            fieldscribe_agree(v,                                                                 \
                !fieldscribe_put_##kind(how, (raw_type)fieldscribe_too_much(how), into, how->words)); \
        }                                                                                        \
        fieldscribe_agree(v, into[0] == before);                                                 \
        fieldscribe_agree(v, fieldscribe_put_##kind(how, raw, into, how->words));                \
    }

/* The same for a point with its own functions to read and write its words. */
#define FIELDSCRIBE_FORM(item, raw_type, taken, put)                                             \
    FIELDSCRIBE_ONCE void fieldscribe_taken_of_##item(                                           \
        fieldscribe_vector *v, const fieldscribe_layout *how, const uint16_t *words)             \
    {                                                                                            \
        fieldscribe_agree(v, how->type >= (uint8_t)FIELDSCRIBE_LOW_FIRST);                       \
        fieldscribe_is_number(v, "raw", (uint64_t)taken);                                        \
    }                                                                                            \
    FIELDSCRIBE_ONCE void fieldscribe_put_field_of_##item(                                       \
        fieldscribe_vector *v, const fieldscribe_layout *how, const char *field, uint16_t *words) \
    {                                                                                            \
        const raw_type raw = (raw_type)fieldscribe_bits(v, field);                               \
        fieldscribe_agree(v, how->type >= (uint8_t)FIELDSCRIBE_LOW_FIRST);                       \
        put;                                                                                     \
    }

FIELDSCRIBE_KIND(bit, bool)
FIELDSCRIBE_KIND(u8, uint8_t)
FIELDSCRIBE_KIND(s8, int8_t)
FIELDSCRIBE_KIND(u16, uint16_t)
FIELDSCRIBE_KIND(s16, int16_t)
FIELDSCRIBE_KIND(u32, uint32_t)
FIELDSCRIBE_KIND(s32, int32_t)
FIELDSCRIBE_KIND(u64, uint64_t)
FIELDSCRIBE_KIND(s64, int64_t)

/* Numbers with a sign around 0 and at the ends of their bits, in a word of their own and in one that is shared. */
static inline void fieldscribe_holds_signs(fieldscribe_vector *v)
{
    static const int16_t numbers[] = {0, 1, -1, 7, -8, 8, -9, INT16_MAX, INT16_MIN};
    static const fieldscribe_layout whole = {FIELDSCRIBE_S16, 1U, 0U, false, 0U, 0xFFFFU, 0U, 0U};
    static const fieldscribe_layout part = {FIELDSCRIBE_S16, 1U, 0U, true, 4U, 0x00F0U, 0U, 0U};
    static const fieldscribe_layout two = {FIELDSCRIBE_S32, 2U, 0x10U, false, 0U, 0xFFFFFFFFU, 0U, 0U};
    size_t at;
    for (at = 0U; at < sizeof numbers / sizeof numbers[0]; ++at) {
        const uint32_t bits = numbers[at] < 0 ? ~(uint32_t)(-1 - numbers[at]) : (uint32_t)numbers[at];
        const bool fits = numbers[at] >= -8 && numbers[at] <= 7;
        uint16_t words[2] = {0xA5A5U, 0xA5A5U};
        int16_t back = 99;
        int32_t wide = 99;
        fieldscribe_agree(v, fieldscribe_put_s16(&part, numbers[at], words, 1U) == fits);
        fieldscribe_agree(v, words[0] == (fits ? (0xA505U | ((bits & 0xFU) << 4)) : 0xA5A5U));
        fieldscribe_agree(v, fieldscribe_take_s16(&part, words, 1U, &back) && back == (fits ? numbers[at] : -6));
        fieldscribe_agree(v, fieldscribe_put_s16(&whole, numbers[at], words, 1U) && words[0] == (bits & 0xFFFFU));
        fieldscribe_agree(v, fieldscribe_take_s16(&whole, words, 1U, &back) && back == numbers[at]);
        fieldscribe_agree(v, fieldscribe_put_s32(&two, numbers[at], words, 2U) && words[1] == (bits >> 16));
        fieldscribe_agree(v, fieldscribe_take_s32(&two, words, 2U, &wide) && wide == numbers[at]);
    }
}

static inline void fieldscribe_refuses_long_numbers(
    fieldscribe_vector *v, const fieldscribe_layout *no_sign, const fieldscribe_layout *a_sign)
{
    uint16_t words[4] = {7U, 7U, 7U, 7U};
    int64_t back = 9;
    uint64_t same = 9U;
    fieldscribe_agree(v, !fieldscribe_put_s64(no_sign, 1, words, 4U) && !fieldscribe_put_u64(a_sign, 1U, words, 4U));
    fieldscribe_agree(v,
        !fieldscribe_take_s64(no_sign, words, 4U, &back) && !fieldscribe_take_u64(a_sign, words, 4U, &same));
    fieldscribe_agree(v, !fieldscribe_put_u64(no_sign, 1U, words, 3U) && !fieldscribe_put_s64(a_sign, 1, words, 3U));
    fieldscribe_agree(v,
        !fieldscribe_take_u64(no_sign, words, 3U, &same) && !fieldscribe_take_s64(a_sign, words, 3U, &back));
    fieldscribe_agree(v, words[0] == 7U && words[1] == 7U && words[3] == 7U && back == 9 && same == 9U);
}

/* Two structs that differed agree now in the bytes that a block filled in, and no other block fills in one of them. */
static inline void fieldscribe_fills_apart(
    fieldscribe_vector *v, const void *one, const void *other, unsigned char *filled, size_t size)
{
    size_t at;
    for (at = 0U; at < size; ++at) {
        const bool agree = ((const unsigned char *)one)[at] == ((const unsigned char *)other)[at];
        fieldscribe_agree(v, !agree || filled[at] == 0U);
        filled[at] = agree ? 1U : filled[at];
    }
}

#define FIELDSCRIBE_FILLS_APART(type, blocks)                                                    \
    {                                                                                            \
        uint16_t any[FIELDSCRIBE_VALUES_MOST];                                                   \
        unsigned char filled[sizeof(type)] = {0U};                                               \
        type one;                                                                                \
        type other;                                                                              \
        size_t block;                                                                            \
        fieldscribe_fill(any, sizeof any);                                                       \
        for (block = 0U; block < (blocks); ++block) {                                            \
            memset(&one, 0, sizeof one);                                                         \
            memset(&other, 0xFF, sizeof other);                                                  \
            type##_decode(block, any, &one);                                                     \
            type##_decode(block, any, &other);                                                   \
            fieldscribe_fills_apart(v, &one, &other, filled, sizeof one);                        \
        }                                                                                        \
        memset(&one, 0, sizeof one);                                                             \
        memset(&other, 0, sizeof other);                                                         \
        type##_decode((blocks), any, &one); /* there is no such block */                         \
        fieldscribe_agree(v, memcmp(&one, &other, sizeof one) == 0);                             \
    }

/* A count has no raw number, and a raw number no count, where a step to it takes more than 64 bits. */
static inline void fieldscribe_refuses_long_counts(fieldscribe_vector *v)
{
    static const fieldscribe_rule rules[] = {
        {FIELDSCRIBE_OK, 0, INT64_MAX, 1, 1, 2}, {FIELDSCRIBE_OK, 0, INT64_MAX, 1, 1, 1},
        {FIELDSCRIBE_OK, 0, 2, 1, 1, 1}, {FIELDSCRIBE_OK, 0, 1, 1, INT64_MAX, 1},
        {FIELDSCRIBE_OK, 0, 1, 1, INT64_MAX / 2, 1}};
    static const fieldscribe_rule decoded[] = {
        {FIELDSCRIBE_OK, 0, 1, 1, 0, INT64_MAX}, {FIELDSCRIBE_OK, 0, 1, 1, -INT64_MAX, 1},
        {FIELDSCRIBE_OK, 0, 1, INT64_MAX / 2, 0, 1}, {FIELDSCRIBE_OK, 0, INT64_MAX, 1, 0, 2},
        {FIELDSCRIBE_OK, 0, 1, INT64_MAX / 4, 0, 1}};
    int64_t count = 0;
    size_t at;
    for (at = 0U; at < sizeof rules / sizeof rules[0]; ++at) {
        fieldscribe_agree(v, fieldscribe_ruled_count(rules[at], INT64_MAX / 2, 1, INT64_MIN, INT64_MAX).status ==
                FIELDSCRIBE_OUT_OF_RANGE);
    }
    for (at = 0U; at < sizeof decoded / sizeof decoded[0]; ++at) {
        fieldscribe_agree(v, fieldscribe_decode_count(decoded[at], INT64_MAX / 2, 4, &count) == FIELDSCRIBE_OVERFLOW &&
                count == 0);
    }
    for (at = 2U; at < sizeof decoded / sizeof decoded[0]; at += 2U) {
        fieldscribe_agree(v, fieldscribe_decode_ratio(decoded[at], INT64_MAX / 2, 4, 0, &count) ==
                FIELDSCRIBE_OVERFLOW && count == 0);
    }
#if !defined(FIELDSCRIBE_NO_FLOAT) && !defined(FIELDSCRIBE_FLOAT32)
    fieldscribe_agree(v, fieldscribe_rounded_wide(-9223372036854775808.0, INT64_MIN, 0).number == INT64_MIN &&
            fieldscribe_rounded_wide(9223372036854775808.0, 0, INT64_MAX).status == FIELDSCRIBE_OUT_OF_RANGE);
#endif
}

/* Numbers of 64 bits in any order of words, which few devices have. */
static inline void fieldscribe_holds_long_numbers(fieldscribe_vector *v)
{
    static const int64_t numbers[] = {0, 1, -1, 0x0123456789ABCDEF, -0x0123456789ABCDEF, INT64_MAX, INT64_MIN};
    fieldscribe_layout with_sign = {FIELDSCRIBE_S64, 4U, 0x2031U, false, 0U, UINT64_MAX, 0U, 0U};
    fieldscribe_layout without = {FIELDSCRIBE_U64, 4U, 0x0123U, false, 0U, UINT64_MAX, 0U, 0U};
    size_t at;
    fieldscribe_holds_signs(v);
    fieldscribe_refuses_long_counts(v);
    for (at = 0U; at < sizeof numbers / sizeof numbers[0]; ++at) {
        const uint64_t bits = numbers[at] < 0 ? ~(uint64_t)(-1 - numbers[at]) : (uint64_t)numbers[at];
        uint16_t words[5] = {0U, 0U, 0U, 0U, 9U};
        int64_t back = 9;
        uint64_t same = 9U;
        fieldscribe_agree(v, fieldscribe_put_s64(&with_sign, numbers[at], words, 4U) && words[4] == 9U);
        fieldscribe_agree(v, words[2] == (bits >> 48) && words[0] == ((bits >> 32) & 0xFFFFU));
        fieldscribe_agree(v, words[3] == ((bits >> 16) & 0xFFFFU) && words[1] == (bits & 0xFFFFU));
        fieldscribe_agree(v, fieldscribe_take_s64(&with_sign, words, 4U, &back) && back == numbers[at]);
        fieldscribe_agree(v, fieldscribe_put_u64(&without, bits, words, 4U) && words[0] == (bits >> 48));
        fieldscribe_agree(v, fieldscribe_take_u64(&without, words, 4U, &same) && same == bits && words[4] == 9U);
    }
    with_sign.type = (uint8_t)FIELDSCRIBE_U64;
    without.type = (uint8_t)FIELDSCRIBE_S64;
    fieldscribe_refuses_long_numbers(v, &with_sign, &without);
}

/* ---- Whole exchanges ---- */

/* The step of a script at this position: what is sent and received; false if there is none. */
static inline bool fieldscribe_step(fieldscribe_vector *v, size_t place, const char **sent, const char **received)
{
    const char *at = fieldscribe_field(v, "script");
    if (!fieldscribe_asks(v, "command") && !fieldscribe_asks(v, "base")) {
        (void)fieldscribe_field(v, "needs"); /* used by languages whose devices read other points themselves */
    }
    while (place > 0U && at != NULL) {
        at = strchr(at, ',');
        at = at != NULL ? at + 1 : NULL;
        --place;
    }
    if (at == NULL || strchr(at, '=') == NULL) {
        fieldscribe_agree(v, false);
        return false;
    }
    *sent = at;
    *received = strchr(at, '=') + 1;
    return true;
}

/* The number of steps of a script. */
FIELDSCRIBE_ONCE size_t fieldscribe_steps(fieldscribe_vector *v)
{
    const char *at = fieldscribe_field(v, "script");
    size_t count = 1U;
    while ((at = strchr(at, ',')) != NULL) {
        ++at;
        ++count;
    }
    return count;
}

/*
 * A point in one call: its frames and its codec. `decode` stores what `raw` means in `number`, `encode` what
 * that is written as in `again`; each gives a status. A number is written if it stands for that raw number alone.
 */
#define FIELDSCRIBE_CALL_READ_BY(device_type, call, type, raw_type, with, decode)                \
    if (fieldscribe_asks(v, "read")) {                                                           \
        device_type device;                                                                      \
        int converted = 0;                                                                       \
        int status;                                                                              \
        type read;                                                                               \
        type number;                                                                             \
        fieldscribe_fill(&read, sizeof read);                                                    \
        fieldscribe_fill(&number, sizeof number);                                                \
        memset(&device, 0, sizeof device);                                                       \
        device.unit = fieldscribe_called_unit(v);                                                \
        status = (int)call(&device with, &read);                                                 \
        if (fieldscribe_spells(fieldscribe_field(v, "status"), "ok")) {                          \
            const raw_type raw = (raw_type)fieldscribe_bits(v, "raw");                           \
            converted = decode;                                                                  \
        }                                                                                        \
        fieldscribe_is_called(v, &device.unit, status, converted);                               \
        fieldscribe_agree(v, memcmp(&read, &number, sizeof read) == 0);                          \
    }

#define FIELDSCRIBE_CALL_WRITE_BY(kind, device_type, call, type, raw_type, with, decode, encode) \
    if (fieldscribe_asks(v, kind)) {                                                             \
        device_type device;                                                                      \
        const raw_type raw = (raw_type)fieldscribe_bits(v, "raw");                               \
        raw_type again = (raw_type)0;                                                            \
        type number = (type)0;                                                                   \
        memset(&device, 0, sizeof device);                                                       \
        device.unit = fieldscribe_called_unit(v);                                                \
        if (decode == 0 && encode == 0 && again == raw) {                                        \
            const int status = (int)call(&device with, number);                                  \
            fieldscribe_is_called(v, &device.unit, status, 0);                                   \
        }                                                                                        \
    }

/* A point that needs no other, read in one call. `means`: RAW, PLAIN or COUNT_OF; TRY_ before it if that may fail. */
#define FIELDSCRIBE_CALL_READ(device, item, type, raw_type, means)                               \
    FIELDSCRIBE_CALL_READ_BY(device##_device, device##_read_##item, type, raw_type, ,            \
        FIELDSCRIBE_DECODE_##means(device##_##item, type))

/* The same, written in one call; `kind` is write, or store for one that keeps the number. */
#define FIELDSCRIBE_CALL_WRITE(kind, device, item, type, raw_type, means)                        \
    FIELDSCRIBE_CALL_WRITE_BY(#kind, device##_device, device##_##kind##_##item, type, raw_type, , \
        FIELDSCRIBE_DECODE_##means(device##_##item, type), FIELDSCRIBE_ENCODE_##means(device##_##item, raw_type))

/* The same, both read and written. */
#define FIELDSCRIBE_CALLS(device, item, type, raw_type, means)                                   \
    FIELDSCRIBE_CALL_READ(device, item, type, raw_type, means)                                   \
    FIELDSCRIBE_CALL_WRITE(write, device, item, type, raw_type, means)

/* A text, bytes or a date in one call: `decoded` fills `held` from `words`, and is a status. */
#define FIELDSCRIBE_CALL_TEXT(device_type, type, size)                                           \
    device_type device;                                                                          \
    uint16_t words[FIELDSCRIBE_ROOM];                                                            \
    type held[size];                                                                             \
    size_t length = 0U;                                                                          \
    int status = 0;                                                                              \
    (void)length;                                                                                \
    memset(&device, 0, sizeof device);                                                           \
    device.unit = fieldscribe_called_unit(v);                                                    \
    fieldscribe_fill(held, sizeof held);                                                         \
    (void)fieldscribe_numbers(v, "words", words, FIELDSCRIBE_ROOM);
#define FIELDSCRIBE_LENGTH , length
#define FIELDSCRIBE_CALL_READ_TEXT(device_type, call, type, size, with, decoded)                 \
    if (fieldscribe_asks(v, "read")) {                                                           \
        FIELDSCRIBE_CALL_TEXT(device_type, type, size)                                           \
        type read[size];                                                                         \
        int converted = 0;                                                                       \
        fieldscribe_fill(read, sizeof read);                                                     \
        status = (int)call(&device with, read);                                                  \
        if (fieldscribe_spells(fieldscribe_field(v, "status"), "ok")) {                          \
            converted = decoded;                                                                 \
        }                                                                                        \
        fieldscribe_is_called(v, &device.unit, status, converted);                               \
        fieldscribe_agree(v, memcmp(read, held, sizeof read) == 0);                              \
    }
#define FIELDSCRIBE_CALL_WRITE_TEXT(device_type, call, type, size, with, beside, decoded)        \
    if (fieldscribe_asks(v, "write")) {                                                          \
        FIELDSCRIBE_CALL_TEXT(device_type, type, size)                                           \
        fieldscribe_agree(v, decoded == 0);                                                      \
        status = (int)call(&device with, held beside);                                           \
        fieldscribe_is_called(v, &device.unit, status, 0);                                       \
    }

/* What `means` stands for in these macros: `raw` to `number`, and `number` to `again`; each is a status. */
#define FIELDSCRIBE_DECODE_RAW(point, type) (number = (type)raw, 0)
#define FIELDSCRIBE_DECODE_PLAIN(point, type) (number = (type)point##_decode(raw), 0)
#define FIELDSCRIBE_DECODE_COUNT_OF(point, type) (number = (type)point##_decode_count(raw), 0)
#define FIELDSCRIBE_DECODE_TRY_PLAIN(point, type) (int)point##_decode(raw, &number)
#define FIELDSCRIBE_DECODE_TRY_COUNT_OF(point, type) (int)point##_decode_count(raw, &number)
#define FIELDSCRIBE_ENCODE_RAW(point, raw_type) (again = (raw_type)number, 0)
#define FIELDSCRIBE_ENCODE_PLAIN(point, raw_type) (again = (raw_type)number, 0)
#define FIELDSCRIBE_ENCODE_COUNT_OF(point, raw_type) (int)point##_encode_count(number, &again)
#define FIELDSCRIBE_ENCODE_TRY_PLAIN(point, raw_type) (int)point##_encode(number, &again)
#define FIELDSCRIBE_ENCODE_TRY_COUNT_OF(point, raw_type) (int)point##_encode_count(number, &again)

/* A character of words that hold two each, the first in the high byte. */
static inline uint8_t fieldscribe_character(const uint16_t *words, size_t at)
{
    const unsigned both = words[at / 2U];
    return (uint8_t)(at % 2U == 0U ? both >> 8 : both & 0xFFU);
}

/* Whether a text is the one in these words, without the blanks at its end. */
FIELDSCRIBE_ONCE bool fieldscribe_is_text_of(const char *text, const uint16_t *words, size_t count)
{
    size_t length = 2U * count;
    size_t at = 0U;
    while (length > 0U && fieldscribe_character(words, length - 1U) == 0x20U) {
        --length;
    }
    while (at < length && (uint8_t)text[at] == fieldscribe_character(words, at)) {
        ++at;
    }
    return at == length && text[length] == '\0';
}

/* The member of a struct `group` has the number of the vector's point, or the text in `words`. */
#define FIELDSCRIBE_MEMBER(name, is)                                                             \
    if (fieldscribe_spells(fieldscribe_field(v, "point"), name)) {                              \
        fieldscribe_agree(v, is);                                                                \
    }
#define FIELDSCRIBE_MEMBER_RAW(item, raw_type)                                                   \
    FIELDSCRIBE_MEMBER(#item, group.item##_raw == (raw_type)fieldscribe_bits(v, "raw"))
#define FIELDSCRIBE_MEMBER_COUNT(device, item, raw_type)                                         \
    FIELDSCRIBE_MEMBER(                                                                          \
        #item, group.item##_count == device##_##item##_decode_count((raw_type)fieldscribe_bits(v, "raw")))

#define FIELDSCRIBE_MEMBER_TEXT(item)                                                            \
    FIELDSCRIBE_MEMBER(#item, fieldscribe_is_text_of(group.item##_text, words, sizeof group.item##_text / 2U))
#define FIELDSCRIBE_MEMBER_PACKED(device, item)                                                  \
    if (fieldscribe_spells(fieldscribe_field(v, "point"), #item)) {                             \
        char text[sizeof group.item##_text];                                                     \
        (void)device##_##item##_decode(words, text);                                             \
        fieldscribe_agree(v, strcmp(text, group.item##_text) == 0);                              \
    }

#define FIELDSCRIBE_MEMBER_BYTES(device, item)                                                   \
    if (fieldscribe_spells(fieldscribe_field(v, "point"), #item)) {                             \
        uint8_t bytes[sizeof group.item##_bytes];                                                \
        device##_##item##_decode(words, bytes);                                                  \
        fieldscribe_agree(v, memcmp(bytes, group.item##_bytes, sizeof bytes) == 0);              \
    }

/* Whether these bytes are the ones that the step sends. */
static inline void fieldscribe_sends(fieldscribe_vector *v, const char *sent, const uint8_t *bytes, size_t length)
{
    uint8_t expected[FIELDSCRIBE_BYTES_MOST] = {0U};
    const size_t count = fieldscribe_hex(sent, expected, sizeof expected);
    const bool same = count == length && memcmp(expected, bytes, count) == 0;
    fieldscribe_agree_on(v, "the bytes that are sent", same);
}


/* The rank of the address at this position, counted from the lowest. */
FIELDSCRIBE_ONCE size_t fieldscribe_rank(const uint16_t *addresses, size_t count, size_t at)
{
    size_t rank = 0U;
    size_t other;
    for (other = 0U; other < count; ++other) {
        rank += addresses[other] < addresses[at] ? 1U : 0U;
    }
    return rank;
}

static void fieldscribe_run_point(fieldscribe_vector *v)
{
    static const fieldscribe_adapter *last = NULL; /* vectors of one point stand together */
    const char *const point = fieldscribe_field(v, "point");
    const fieldscribe_adapter *adapter = last;
    if (adapter == NULL || strcmp(adapter->point, point) != 0) {
        adapter = v->suite->adapters;
        while (adapter->point != NULL && strcmp(adapter->point, point) != 0) {
            ++adapter;
        }
    }
    if (adapter->point != NULL) {
        last = adapter;
        adapter->run(v);
    }
}


/* ---- The run ---- */

typedef struct fieldscribe_file {
    fieldscribe_vector v;
    fieldscribe_kind kinds[FIELDSCRIBE_KINDS_MOST];
    size_t kind_count;
    fieldscribe_kind sets[FIELDSCRIBE_SETS_MOST];
    size_t set_count;
    char head[FIELDSCRIBE_HEAD_MOST]; /* the names of kinds, sets and fields */
    size_t used;
    bool fits;
    unsigned long shown;
} fieldscribe_file;

/* Cuts the line at its tabs; returns how many parts there are. */
static size_t fieldscribe_split(char *text, char **parts, size_t most)
{
    size_t count = 0U;
    text[strcspn(text, "\r\n")] = '\0';
    while (text != NULL && count < most) {
        parts[count] = text;
        ++count;
        text = strchr(text, '\t');
        if (text != NULL) {
            *text = '\0';
            ++text;
        }
    }
    return count;
}

/* Keeps a name of the head up to its form; NULL when there is no room. */
static const char *fieldscribe_keep(fieldscribe_file *file, const char *name)
{
    const size_t length = strcspn(name, ":");
    char *const kept = file->head + file->used;
    if (length + 1U > sizeof file->head - file->used) {
        return NULL;
    }
    memcpy(kept, name, length);
    kept[length] = '\0';
    file->used += length + 1U;
    return kept;
}

/* One line of the head: the names of a kind's or a set's fields. */
static bool fieldscribe_declare(
    fieldscribe_file *file, fieldscribe_kind *kind, char **parts, size_t count, size_t first)
{
    size_t at;
    kind->name = fieldscribe_keep(file, parts[1]);
    kind->count = count - first;
    if (count < first || kind->name == NULL) {
        return false;
    }
    if (count > first && strncmp(parts[first], "only:", 5U) == 0) {
        kind->elsewhere = strncmp(parts[first] + 5, "c.", 2U) != 0 && strcmp(parts[first] + 5, "c") != 0;
        --kind->count;
        ++first;
    }
    for (at = first; at < count; ++at) {
        const char *const form = strchr(parts[at], ':');
        kind->keys[at - first] = fieldscribe_keep(file, parts[at]);
        kind->notes[at - first] = form != NULL && strcmp(form, ":note") == 0;
        if (kind->keys[at - first] == NULL) {
            return false;
        }
    }
    return true;
}

/* Whether the version of the suite, as text and as numbers, is this one. */
static bool fieldscribe_has_version(const fieldscribe_suite *suite, const char *version)
{
    char numbers[64];
    (void)snprintf(numbers, sizeof numbers, "%lu.%lu.%lu", suite->major, suite->minor, suite->patch);
    return strcmp(version, suite->version) == 0 && strcmp(version, numbers) == 0 &&
        suite->number == suite->major * 1000000UL + suite->minor * 1000UL + suite->patch;
}

/* Reads a line of the head; false if it is none. */
static bool fieldscribe_take_head(fieldscribe_file *file, char *text)
{
    char *parts[FIELDSCRIBE_FIELDS_MOST + 3];
    size_t count;
    if (strncmp(text, "vectors\t", 8U) != 0 && strncmp(text, "set\t", 4U) != 0 && strncmp(text, "kind\t", 5U) != 0) {
        return false;
    }
    count = fieldscribe_split(text, parts, sizeof parts / sizeof parts[0]);
    if (parts[0][0] == 'v') {
        file->fits = count == 5U && fieldscribe_pattern(parts[1]) == (uint64_t)FIELDSCRIBE_FORMAT &&
            strcmp(parts[2], file->v.suite->device) == 0 && fieldscribe_has_version(file->v.suite, parts[3]) &&
            strlen(file->v.suite->digest) == 16U && strncmp(parts[4], file->v.suite->digest, 16U) == 0;
    } else if (parts[0][0] == 's' && file->set_count < (size_t)FIELDSCRIBE_SETS_MOST) {
        file->fits = fieldscribe_declare(file, &file->sets[file->set_count], parts, count, 2U) && file->fits;
        ++file->set_count;
    } else if (parts[0][0] == 'k' && count > 2U && file->kind_count < (size_t)FIELDSCRIBE_KINDS_MOST) {
        file->kinds[file->kind_count].announced = strtoul(parts[2], NULL, 10);
        file->fits = fieldscribe_declare(file, &file->kinds[file->kind_count], parts, count, 3U) && file->fits;
        ++file->kind_count;
    }
    return true;
}

/* Splits the line by its kind; false if it has none of these kinds. */
static bool fieldscribe_take_apart(fieldscribe_line *line, const char *text, fieldscribe_kind *kinds, size_t count)
{
    char *parts[FIELDSCRIBE_FIELDS_MOST + 1];
    const size_t length = strcspn(text, "\t\r\n");
    size_t at = 0U;
    while (at < count && (strncmp(kinds[at].name, text, length) != 0 || kinds[at].name[length] != '\0')) {
        ++at;
    }
    if (at == count) {
        return false;
    }
    line->kind = &kinds[at];
    strcpy(line->text, text);
    line->count = fieldscribe_split(line->text, parts, sizeof parts / sizeof parts[0]) - 1U;
    for (at = 0U; at < line->count; ++at) {
        line->fields[at] = parts[at + 1U];
        line->used[at] = false;
    }
    return true;
}

/* Starts a set that the lines below share, and ends the sets that the head names after it. */
static bool fieldscribe_take_set(fieldscribe_file *file, const char *text)
{
    static fieldscribe_line line;
    size_t at;
    if (!fieldscribe_take_apart(&line, text, file->sets, file->set_count)) {
        return false;
    }
    at = (size_t)(line.kind - file->sets);
    (void)fieldscribe_take_apart(&file->v.sets[at], text, file->sets, file->set_count);
    file->v.sets[at].kind = line.count != 0U ? line.kind : NULL;
    for (++at; at < file->set_count; ++at) {
        file->v.sets[at].kind = NULL;
    }
    file->v.set_count = file->set_count;
    return true;
}

/* Whether the generated code has no such functions in this build. */
static bool fieldscribe_skips(const fieldscribe_vector *v)
{
#if defined(FIELDSCRIBE_NO_FLOAT)
    return v->own.kind->elsewhere || fieldscribe_asks(v, "decode") || fieldscribe_asks(v, "encode");
#else
    return v->own.kind->elsewhere;
#endif
}

/* Checks that every field of the line was compared with something, and all answers are right; else notes why not. */
static bool fieldscribe_passes(fieldscribe_vector *v)
{
    size_t at;
    if (!v->answered) {
        fieldscribe_differs(v, "nothing in the program answers it");
    }
    for (at = 0U; at < v->own.count; ++at) {
        if (at >= v->own.kind->count) {
            fieldscribe_differs(v, "the line has more fields than its kind");
        } else if (!v->own.used[at] && !v->own.kind->notes[at] && !fieldscribe_absent(v->own.fields[at])) {
            fieldscribe_differs(v, v->own.kind->keys[at]);
        } else {
            /* compared, or nothing to compare */
        }
    }
    return !v->differs;
}

static void fieldscribe_run_vector(fieldscribe_file *file, const char *text)
{
    fieldscribe_vector *const v = &file->v;
    if (fieldscribe_skips(v)) {
        ++v->own.kind->skipped;
        return;
    }
    v->answered = false;
    v->differs = false;
    v->wrong = "";
    v->given[0] = '\0';
    v->base = 0U;
    v->selecting = 0U;
    v->matched = 0U;
    if (fieldscribe_asks(v, "code") || fieldscribe_asks(v, "constant") || fieldscribe_asks(v, "command") ||
        fieldscribe_asks(v, "group") || fieldscribe_asks(v, "documented") || fieldscribe_asks(v, "size") ||
        fieldscribe_asks(v, "alias") || fieldscribe_asks(v, "identification") ||
        fieldscribe_asks(v, "step") || fieldscribe_asks(v, "base")) {
        v->suite->run_code(v);
    } else if (!v->suite->run_frame(v)) {
        fieldscribe_run_point(v);
    }
    if (fieldscribe_passes(v)) {
        ++v->own.kind->passed;
        return;
    }
    ++v->own.kind->failed;
    if (file->shown < (unsigned long)FIELDSCRIBE_SHOWN_FAILURES) {
        size_t at;
        for (at = 0U; at < v->set_count; ++at) {
            fprintf(stderr, "%s%s", v->sets[at].kind != NULL ? v->sets[at].kind->name : "",
                v->sets[at].kind != NULL ? (v->sets[at].count != 0U ? " " : "") : "");
            fprintf(stderr, "%s", v->sets[at].kind != NULL && v->sets[at].count != 0U ? v->sets[at].fields[0] : "");
            fprintf(stderr, "%s", v->sets[at].kind != NULL ? ": " : "");
        }
        fprintf(stderr, "failed: %s  differs: %s", text, v->wrong);
        fprintf(stderr, "%s%s\n", v->given[0] != '\0' ? ", here " : "", v->given);
        ++file->shown;
    }
}

static int fieldscribe_report(const fieldscribe_file *file)
{
    unsigned long passed = 0U;
    unsigned long failed = 0U;
    size_t at;
    for (at = 0U; at < file->kind_count; ++at) {
        const fieldscribe_kind *const kind = &file->kinds[at];
        if (kind->passed + kind->failed > 0U) {
            printf("%s %lu passed, %lu failed\n", kind->name, kind->passed, kind->failed);
        }
        passed += kind->passed;
        failed += kind->failed;
    }
    printf("total %lu passed, %lu failed\n", passed, failed);
    return failed == 0U && passed > 0U ? 0 : 1;
}

/* Whether there were as many vectors of each kind as the head says. */
static bool fieldscribe_complete(const fieldscribe_file *file)
{
    size_t at;
    for (at = 0U; at < file->kind_count; ++at) {
        const fieldscribe_kind *const kind = &file->kinds[at];
        if (kind->passed + kind->failed + kind->skipped != kind->announced) {
            return false;
        }
    }
    return true;
}

static int fieldscribe_run_file(fieldscribe_file *file, FILE *stream)
{
    static char text[FIELDSCRIBE_LINE_MOST];
    while (fgets(text, (int)sizeof text, stream) != NULL) {
        if (strchr(text, '\n') == NULL && strlen(text) + 1U == sizeof text) {
            fprintf(stderr, "a line has more than %d characters\n", (int)FIELDSCRIBE_LINE_MOST);
            return 2;
        }
        if (fieldscribe_take_head(file, text) || fieldscribe_take_set(file, text)) {
            continue;
        }
        if (!fieldscribe_take_apart(&file->v.own, text, file->kinds, file->kind_count)) {
            fprintf(stderr, "unknown kind: %s", text);
            return 2;
        }
        fieldscribe_run_vector(file, text);
    }
    if (!file->fits) {
        fprintf(stderr, "these vectors were made from another description than %s %s\n", file->v.suite->device,
            file->v.suite->digest);
        return 1;
    }
    if (!fieldscribe_complete(file)) {
        fprintf(stderr, "the file has other counts of vectors than it says\n");
        (void)fieldscribe_report(file);
        return 1;
    }
    return fieldscribe_report(file);
}

static int fieldscribe_run(const fieldscribe_suite *suite, int argc, char **argv)
{
    static fieldscribe_file file;
    FILE *stream;
    int result;
    if (argc != 2) {
        fprintf(stderr, "usage: %s_conformance VECTORS\n", suite->device);
        return 2;
    }
    stream = fopen(argv[1], "r");
    if (stream == NULL) {
        fprintf(stderr, "cannot read %s\n", argv[1]);
        return 2;
    }
    file.v.suite = suite;
    result = fieldscribe_run_file(&file, stream);
    fclose(stream);
    return result;
}

#endif
