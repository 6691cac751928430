/*
 * What conformance programs of Modbus devices have beside the core: exchanges of points, and frames.
 *
 * SPDX-License-Identifier: 0BSD
 */
#ifndef FIELDSCRIBE_CONFORMANCE_MODBUS_H
#define FIELDSCRIBE_CONFORMANCE_MODBUS_H

#include "fieldscribe_conformance.h"
#include "fieldscribe_modbus.h"

typedef struct fieldscribe_blocks {
    const char *group;
    const fieldscribe_modbus_reading *blocks;
    size_t count;
} fieldscribe_blocks;

/* Compares the members of a group that come from the words of a reading with the vector. */
typedef void (*fieldscribe_members)(
    fieldscribe_vector *v, const fieldscribe_modbus_reading *what, const uint16_t *words);

/* The tables of a device. */
typedef struct fieldscribe_tables {
    const fieldscribe_modbus_profile *profile;
    const fieldscribe_blocks *blocks;
    const fieldscribe_members *members; /* of each group, up to NULL */
    uint16_t most; /* the items of the largest block */
} fieldscribe_tables;

static inline const fieldscribe_tables *fieldscribe_tables_of(const fieldscribe_vector *v)
{
    return (const fieldscribe_tables *)v->suite->family;
}

static inline fieldscribe_modbus_framing fieldscribe_framing(fieldscribe_vector *v)
{
    return fieldscribe_spells(fieldscribe_field(v, "framing"), "tcp") ? FIELDSCRIBE_MODBUS_TCP : FIELDSCRIBE_MODBUS_RTU;
}

/* The request of a block. */
static inline fieldscribe_modbus_request fieldscribe_request_of(uint8_t function, uint16_t address, uint16_t count)
{
    const fieldscribe_modbus_reading block = {function, address, count};
    return fieldscribe_modbus_read(1U, &block);
}

/* Checks that a point is found in a block that contains it, and in none that cuts it or has other items. */
FIELDSCRIBE_ONCE bool fieldscribe_is_in_blocks(const fieldscribe_modbus_reading *point)
{
    uint16_t values[FIELDSCRIBE_ROOM];
    const uint8_t function = point->function;
    const uint16_t before = (uint16_t)(point->address == 0U ? 0U : 1U);
    const uint16_t first = (uint16_t)(point->address - before);
    const uint16_t count = (uint16_t)(before + point->count);
    const fieldscribe_modbus_request block = fieldscribe_request_of(function, first, count);
    const fieldscribe_modbus_request less = fieldscribe_request_of(function, first, (uint16_t)(count - 1U));
    const fieldscribe_modbus_request late = fieldscribe_request_of(function, (uint16_t)(point->address + 1U), count);
    const fieldscribe_modbus_request other = fieldscribe_request_of((uint8_t)(function ^ 1U), first, count);
    const fieldscribe_modbus_reply whole = {values, FIELDSCRIBE_ROOM, count, 0U};
    const fieldscribe_modbus_reply cut = {values, FIELDSCRIBE_ROOM, (uint16_t)(count - 1U), 0U};
    const fieldscribe_modbus_reply nowhere = {NULL, FIELDSCRIBE_ROOM, count, 0U};
    return fieldscribe_modbus_words_in(&block, &whole, point) == values + before &&
        fieldscribe_modbus_words_in(&less, &cut, point) == NULL &&
        fieldscribe_modbus_words_in(&block, &cut, point) == NULL &&
        fieldscribe_modbus_words_in(&less, &whole, point) == NULL &&
        fieldscribe_modbus_words_in(&block, &nowhere, point) == NULL &&
        fieldscribe_modbus_words_in(&late, &whole, point) == NULL &&
        fieldscribe_modbus_words_in(&other, &whole, point) == NULL;
}

/* Memory for a reply of this size. */
static inline fieldscribe_modbus_reply fieldscribe_reply_into(uint16_t *values, size_t room)
{
    fieldscribe_modbus_reply reply;
    fieldscribe_fill(&reply, sizeof reply);
    reply.values = values;
    reply.room = room;
    return reply;
}

/*
 * A receiver that asks before each byte how many are missing learns at the last byte that it is the last. It is
 * never told more than fit, and nothing where nobody answers.
 */
static inline void fieldscribe_receives(fieldscribe_vector *v, fieldscribe_modbus_framing framing,
    const fieldscribe_modbus_request *request, const uint8_t *bytes, size_t length)
{
    const fieldscribe_modbus_profile *const profile = fieldscribe_tables_of(v)->profile;
    const size_t shortest = framing == FIELDSCRIBE_MODBUS_TCP ? 9U : 5U;
    const bool silent = request->unit == profile->broadcast;
    size_t got;
    for (got = 0U; got <= length; ++got) {
        const size_t left = (got < shortest && shortest < length ? shortest : length) - got;
        fieldscribe_agree(v,
            fieldscribe_modbus_left(profile, framing, request, bytes, length, got) == (silent ? 0U : left) &&
                fieldscribe_modbus_left(profile, framing, request, bytes, got, got) == 0U);
        fieldscribe_agree(v, silent || left == 0U ||
            fieldscribe_modbus_left(profile, framing, request, bytes, got + left - 1U, got) == left - 1U);
    }
}

/* An answer that is no refusal is as long as the request says, and a receiver learns so while it comes. */
static inline void fieldscribe_is_awaited(fieldscribe_vector *v, fieldscribe_modbus_framing framing,
    const fieldscribe_modbus_request *request, const uint8_t *bytes, size_t length, fieldscribe_modbus_status status)
{
    const fieldscribe_modbus_profile *const profile = fieldscribe_tables_of(v)->profile;
    if (status == FIELDSCRIBE_MODBUS_OK) {
        const uint32_t awaited = fieldscribe_modbus_reply_length(profile, framing, request);
        fieldscribe_agree(v, request->unit == profile->broadcast ? awaited == 0U : awaited == length);
    }
    if (status == FIELDSCRIBE_MODBUS_OK || status == FIELDSCRIBE_MODBUS_EXCEPTION) {
        fieldscribe_receives(v, framing, request, bytes, length);
    }
}

/* Sends a request of the script and parses what comes back. */
FIELDSCRIBE_ONCE fieldscribe_modbus_status fieldscribe_ask_any(
    fieldscribe_vector *v, size_t place, const fieldscribe_modbus_request *request, fieldscribe_modbus_reply *reply)
{
    const fieldscribe_modbus_framing framing = fieldscribe_framing(v);
    uint8_t bytes[FIELDSCRIBE_BYTES_MOST];
    fieldscribe_modbus_request numbered = *request;
    fieldscribe_modbus_status status;
    const char *sent = NULL;
    const char *received = NULL;
    size_t length = 0U;
    if (!fieldscribe_step(v, place, &sent, &received)) {
        return FIELDSCRIBE_MODBUS_NOISE;
    }
    fieldscribe_agree(v, request->transaction == 0U);
    numbered.transaction = framing == FIELDSCRIBE_MODBUS_TCP ? 1U : 0U; /* as scripts count */
    status =
        fieldscribe_modbus_build(fieldscribe_tables_of(v)->profile, framing, &numbered, bytes, sizeof bytes, &length);
    fieldscribe_agree(v, status == FIELDSCRIBE_MODBUS_OK);
    fieldscribe_sends(v, sent, bytes, length);
    numbered.values = NULL; /* an answer is compared with the request alone */
    length = fieldscribe_hex(received, bytes, sizeof bytes);
    status = fieldscribe_modbus_parse(framing, &numbered, bytes, length, reply);
    fieldscribe_is_awaited(v, framing, &numbered, bytes, length, status);
    return status;
}

/* The same, with the status of the vector. */
FIELDSCRIBE_ONCE fieldscribe_modbus_status fieldscribe_ask(
    fieldscribe_vector *v, size_t place, const fieldscribe_modbus_request *request, fieldscribe_modbus_reply *reply)
{
    const fieldscribe_modbus_status status = fieldscribe_ask_any(v, place, request, reply);
    fieldscribe_is_text(v, "status", fieldscribe_modbus_status_name(status));
    return status;
}

/* Sends a request of the script and reads the reply into `words`; returns whether it was an answer. */
FIELDSCRIBE_ONCE bool fieldscribe_exchange(
    fieldscribe_vector *v, size_t place, const fieldscribe_modbus_request *request, uint16_t *words)
{
    fieldscribe_modbus_reply reply = fieldscribe_reply_into(words, FIELDSCRIBE_ROOM);
    return fieldscribe_ask(v, place + v->selecting, request, &reply) == FIELDSCRIBE_MODBUS_OK;
}

/* The vector whose exchange a call does, and how many of its steps were done. */
static fieldscribe_vector *fieldscribe_called;
static uint16_t fieldscribe_done;

FIELDSCRIBE_ONCE fieldscribe_modbus_status fieldscribe_ask_script(const fieldscribe_modbus_line *line,
    const fieldscribe_modbus_request *request, fieldscribe_modbus_reply *reply)
{
    fieldscribe_modbus_request plain = *request;
    const uint16_t place = fieldscribe_done++;
    fieldscribe_agree(fieldscribe_called, line == NULL && request->transaction == place && !request->late);
    plain.transaction = 0U;
    return fieldscribe_ask(fieldscribe_called, place, &plain, reply);
}

/* The unit of a handle whose exchange is the script. */
FIELDSCRIBE_ONCE fieldscribe_modbus_unit fieldscribe_called_unit(fieldscribe_vector *v)
{
    fieldscribe_modbus_unit unit =
        FIELDSCRIBE_MODBUS_UNIT(NULL, &fieldscribe_ask_script, (uint8_t)fieldscribe_bits(v, "unit"));
    fieldscribe_agree(v, unit.exception == 0U);
    unit.exception = 0x7FU;
    fieldscribe_called = v;
    fieldscribe_done = 0U;
    return unit;
}

/* The steps of the script that select the point; a selection that stands is not written again. */
#define FIELDSCRIBE_SELECTED(selection)                                                          \
    if (fieldscribe_asks(v, "read") || fieldscribe_asks(v, "write")) {                           \
        fieldscribe_modbus_selected selected = FIELDSCRIBE_MODBUS_NOTHING_SELECTED;              \
        fieldscribe_modbus_unit unit = fieldscribe_called_unit(v);                               \
        fieldscribe_agree(v, fieldscribe_modbus_select(&unit, &selected, selection) == FIELDSCRIBE_MODBUS_OK); \
        v->selecting = fieldscribe_done;                                                         \
        fieldscribe_agree(v, fieldscribe_modbus_select(&unit, &selected, selection) == FIELDSCRIBE_MODBUS_OK); \
        fieldscribe_agree(v, v->selecting == fieldscribe_done && selected.rows == (selection));  \
    }

/* For a point that C cannot select: no function does what the line asks. */
#define FIELDSCRIBE_NO_FUNCTION                                                                  \
    if (fieldscribe_asks(v, "read") || fieldscribe_asks(v, "write")) {                           \
        memset(v->own.used, true, sizeof v->own.used);                                           \
        v->answered = true;                                                                      \
    }

/* Checks that a call does the whole script, and returns its status and whether an answer is still due. */
FIELDSCRIBE_ONCE void fieldscribe_is_called(
    fieldscribe_vector *v, const fieldscribe_modbus_unit *unit, int status, int converted)
{
    const fieldscribe_modbus_status exchanged =
        converted == 0 ? (fieldscribe_modbus_status)status : FIELDSCRIBE_MODBUS_OK;
    fieldscribe_is_text(v, "status", fieldscribe_modbus_status_name(exchanged));
    fieldscribe_agree(v, converted == 0 || converted == status);
    fieldscribe_agree(v, fieldscribe_done == fieldscribe_steps(v) && unit->transaction == fieldscribe_done);
    fieldscribe_agree(v, (unit->exception != 0U) == (exchanged == FIELDSCRIBE_MODBUS_EXCEPTION));
    fieldscribe_agree(v, unit->late == (exchanged == FIELDSCRIBE_MODBUS_SHORT_FRAME ||
        exchanged == FIELDSCRIBE_MODBUS_NOISE || exchanged == FIELDSCRIBE_MODBUS_BAD_BYTE_COUNT ||
        exchanged == FIELDSCRIBE_MODBUS_ECHO_MISMATCH));
}

/* Writes words, which are overwritten before the answer comes. */
FIELDSCRIBE_ONCE void fieldscribe_writes(
    fieldscribe_vector *v, size_t place, const fieldscribe_modbus_writing *what, const uint16_t *words, size_t count)
{
    uint16_t echoed[FIELDSCRIBE_ROOM];
    const fieldscribe_modbus_request request =
        fieldscribe_modbus_write((uint8_t)fieldscribe_bits(v, "unit"), what, words, count);
    (void)fieldscribe_exchange(v, place, &request, echoed);
}

/* Fills the words of a block with those of a reading and all others with a byte; whether the block has them. */
FIELDSCRIBE_ONCE bool fieldscribe_is_placed(uint16_t *all, const fieldscribe_modbus_reading *block,
    const fieldscribe_modbus_reading *what, const uint16_t *words, int byte)
{
    const size_t place = what->address < block->address ? block->count : (size_t)what->address - block->address;
    if (block->function != what->function || place + what->count > block->count) {
        return false;
    }
    memset(all, byte, (size_t)block->count * sizeof all[0]);
    memcpy(all + place, words, (size_t)what->count * sizeof words[0]);
    return true;
}

FIELDSCRIBE_ONCE void fieldscribe_fills_groups(
    fieldscribe_vector *v, const fieldscribe_modbus_reading *what, const uint16_t *words)
{
    const fieldscribe_members *members = fieldscribe_tables_of(v)->members;
    fieldscribe_modbus_reading from_base = *what; /* blocks of groups count from there, too */
    from_base.address = (uint16_t)(what->address - v->base);
    for (; *members != NULL; ++members) {
        (*members)(v, &from_base, words);
    }
}

#define FIELDSCRIBE_COMMAND(command, constant, number)                                           \
    if (fieldscribe_asks_of(v, "command", "command", command)) {                                 \
        uint16_t echoed[FIELDSCRIBE_ROOM];                                                       \
        const fieldscribe_modbus_request request =                                               \
            fieldscribe_modbus_send((uint8_t)fieldscribe_bits(v, "unit"), &(constant));          \
        fieldscribe_is_number(v, "value", (number));                                             \
        (void)fieldscribe_exchange(v, 0U, &request, echoed);                                     \
    }

/* A step of a command: its requests, and its words in place of those that the device held. */
#define FIELDSCRIBE_STEPS(command, steps, ...)                                                   \
    if (fieldscribe_asks_of(v, "step", "command", command)) {                                    \
        uint16_t words[FIELDSCRIBE_ROOM];                                                        \
        uint16_t held[FIELDSCRIBE_ROOM];                                                         \
        const uint16_t arguments[] = __VA_ARGS__;                                                \
        const fieldscribe_modbus_step *const step = &(steps)[fieldscribe_bits(v, "index")];      \
        const size_t count = fieldscribe_numbers(v, "held", held, FIELDSCRIBE_ROOM);             \
        bool same;                                                                               \
        (void)fieldscribe_numbers(v, "held", words, FIELDSCRIBE_ROOM);                           \
        same = fieldscribe_modbus_steps_fill(step, arguments, words);                             \
        fieldscribe_is_words(v, "words", words, count);                                          \
        fieldscribe_agree(v, same == (memcmp(words, held, count * sizeof words[0]) == 0));       \
        fieldscribe_is_count(v, "read", step->read.function);                                    \
        fieldscribe_is_count(v, "write", step->write.function);                                  \
        fieldscribe_is_number(v, "address", step->read.address);                                 \
        fieldscribe_is_number(v, "address", step->write.address);                                \
        fieldscribe_agree(v, step->read.count == count && step->write.count == count);           \
        fieldscribe_is_count(v, "within", step->within);                                         \
        fieldscribe_is_number(v, "conditional", step->conditional ? 1U : 0U);                    \
        fieldscribe_agree(v, fieldscribe_absent(fieldscribe_field(v, "base")) == !step->based);  \
    }

/* The address of a base in the vector. */
FIELDSCRIBE_ONCE fieldscribe_modbus_base fieldscribe_base_of(fieldscribe_vector *v, const char *name)
{
    const char *const start = fieldscribe_pair(v, "starts", name);
    const char *const last = fieldscribe_pair(v, "lasts", name);
    fieldscribe_modbus_base base = {0xFFFFU, 0xFFFFU};
    if (start == NULL || last == NULL) {
        fieldscribe_differs(v, name);
    }
    if (start != NULL && last != NULL) {
        base.start = (uint16_t)fieldscribe_pattern(start);
        base.last = (uint16_t)fieldscribe_pattern(last);
    }
    return base;
}

#define FIELDSCRIBE_BASE(name) , fieldscribe_base_of(v, name)

/* A base that follows from given numbers; it has no address if one of them is out of range. */
FIELDSCRIBE_ONCE void fieldscribe_is_base(fieldscribe_vector *v, bool known, fieldscribe_modbus_base base)
{
    (void)fieldscribe_field(v, "script"); /* for languages whose devices find bases themselves */
    if (known) {
        fieldscribe_is_number(v, "start", base.start);
        fieldscribe_is_number(v, "last", base.last);
    } else {
        fieldscribe_agree(v, base.start == 0xFFFFU && base.last == 0xFFFFU);
    }
}

static inline uint16_t fieldscribe_given(fieldscribe_vector *v, const char *name)
{
    const char *const number = fieldscribe_pair(v, "given", name);
    return number == NULL ? 0U : (uint16_t)fieldscribe_pattern(number);
}

#define FIELDSCRIBE_GIVEN_BASE(name, at)                                                         \
    if (fieldscribe_asks_of(v, "base", "base", name)) {                                          \
        fieldscribe_is_base(v, fieldscribe_spells(fieldscribe_field(v, "status"), "ok"), at);    \
    }

FIELDSCRIBE_ONCE fieldscribe_modbus_status fieldscribe_ask_walking(const fieldscribe_modbus_line *line,
    const fieldscribe_modbus_request *request, fieldscribe_modbus_reply *reply)
{
    fieldscribe_modbus_request plain = *request;
    const uint16_t place = fieldscribe_done++;
    plain.transaction = 0U;
    return line != NULL ? FIELDSCRIBE_MODBUS_NOISE : fieldscribe_ask_any(fieldscribe_called, place, &plain, reply);
}

/* The start of a block, which is found in the first requests of the script. */
FIELDSCRIBE_ONCE void fieldscribe_is_found(
    fieldscribe_vector *v, const fieldscribe_modbus_chain *chain, uint16_t block)
{
    const char *const expected = fieldscribe_field(v, "status");
    fieldscribe_modbus_unit unit = fieldscribe_called_unit(v);
    fieldscribe_modbus_base base = {0xFFFFU, 0xFFFFU};
    fieldscribe_modbus_status status;
    unit.ask = &fieldscribe_ask_walking;
    status = fieldscribe_modbus_find(&unit, chain, block, &base);
    if (fieldscribe_spells(expected, "no_marker") || fieldscribe_spells(expected, "no_block")) {
        fieldscribe_agree(v, status == FIELDSCRIBE_MODBUS_UNKNOWN_VALUE);
    } else if (fieldscribe_spells(expected, "bad_chain")) {
        fieldscribe_agree(v, status == FIELDSCRIBE_MODBUS_OVERFLOW);
    } else {
        fieldscribe_is_text(v, "status", fieldscribe_modbus_status_name(status));
    }
    fieldscribe_agree(v, fieldscribe_absent(fieldscribe_field(v, "given")));
    fieldscribe_is_base(v, status == FIELDSCRIBE_MODBUS_OK, base);
}

#define FIELDSCRIBE_FOUND_BLOCK(name, chain, block)                                              \
    if (fieldscribe_asks_of(v, "base", "base", name)) {                                          \
        fieldscribe_is_found(v, &(chain), (block));                                              \
    }

/* The frame of a point at its base; a base that ends before the point has none. */
#define FIELDSCRIBE_AT_BASE(frame_type, frame, name)                                             \
    frame_type moved = frame;                                                                    \
    fieldscribe_modbus_base at_base = {0U, 0U};                                                  \
    if (fieldscribe_asks(v, "read") || fieldscribe_asks(v, "write")) {                           \
        at_base = fieldscribe_base_of(v, name);                                                  \
        v->base = at_base.start;                                                                 \
    }
#define FIELDSCRIBE_READ_AT_BASE                                                                 \
    moved.read = fieldscribe_modbus_reading_at(at_base, &moved.read);
#define FIELDSCRIBE_WRITE_AT_BASE                                                                \
    moved.write = fieldscribe_modbus_writing_at(at_base, &moved.write);
#define FIELDSCRIBE_UPDATE_AT_BASE                                                               \
    moved.update = fieldscribe_modbus_writing_at(at_base, &moved.update);

#define FIELDSCRIBE_READ(frame, kind)                                                            \
    if (fieldscribe_asks(v, "read")) {                                                           \
        uint16_t words[FIELDSCRIBE_ROOM];                                                        \
        const fieldscribe_modbus_request request =                                               \
            fieldscribe_modbus_read((uint8_t)fieldscribe_bits(v, "unit"), &(frame).read);        \
        fieldscribe_fill(words, sizeof words);                                                   \
        if (fieldscribe_exchange(v, 0U, &request, words)) {                                      \
            fieldscribe_untouched(v, words + request.count, sizeof words - request.count * sizeof words[0]); \
            fieldscribe_taken_##kind(v, (frame).layout, words);                                  \
            fieldscribe_agree(v, v->selecting != 0U || fieldscribe_is_in_blocks(&(frame).read)); \
            fieldscribe_fills_groups(v, &(frame).read, words);                                   \
        }                                                                                        \
    }

#define FIELDSCRIBE_READ_TEXT(frame, total)                                                      \
    if (fieldscribe_asks(v, "read")) {                                                           \
        uint16_t words[FIELDSCRIBE_ROOM];                                                        \
        const fieldscribe_modbus_request request =                                               \
            fieldscribe_modbus_read((uint8_t)fieldscribe_bits(v, "unit"), &(frame).read);        \
        fieldscribe_fill(words, sizeof words);                                                   \
        if (fieldscribe_exchange(v, 0U, &request, words)) {                                      \
            fieldscribe_untouched(v, words + request.count, sizeof words - request.count * sizeof words[0]); \
            fieldscribe_is_words(v, "words", words, request.count);                              \
            fieldscribe_agree(v, request.count == (total) && (frame).text.words == (total) &&    \
                fieldscribe_reads_text(&(frame).text, words));                                   \
            fieldscribe_fills_groups(v, &(frame).read, words);                                   \
        }                                                                                        \
    }

#define FIELDSCRIBE_WRITE(frame, kind)                                                           \
    if (fieldscribe_asks(v, "write")) {                                                          \
        uint16_t words[FIELDSCRIBE_ROOM];                                                        \
        const size_t count = (frame).write.count;                                                \
        fieldscribe_fill(words, sizeof words);                                                   \
        fieldscribe_put_field_##kind(v, (frame).layout, "raw", words);                           \
        fieldscribe_untouched(v, words + count, sizeof words - count * sizeof words[0]);         \
        fieldscribe_writes(v, 0U, &(frame).write, words, count);                                 \
    }

#define FIELDSCRIBE_WRITE_TEXT(frame, total)                                                     \
    if (fieldscribe_asks(v, "write")) {                                                          \
        uint16_t words[FIELDSCRIBE_ROOM];                                                        \
        uint16_t given[total] = {0U};                                                            \
        uint16_t reading[total] = {0U};                                                          \
        size_t at;                                                                               \
        fieldscribe_agree(v, fieldscribe_numbers(v, "words", given, total) == (total));          \
        for (at = 0U; at < (total); ++at) {                                                      \
            reading[at] = given[fieldscribe_rank((frame).text.addresses, total, at)];            \
        }                                                                                        \
        fieldscribe_fill(words, sizeof words);                                                   \
        fieldscribe_agree(v, !fieldscribe_put_text(&(frame).text, reading, (total) - 1U, words, total) && \
            !fieldscribe_put_text(&(frame).text, reading, total, words, (total) - 1U));          \
        fieldscribe_untouched(v, words, sizeof words);                                           \
        fieldscribe_agree(v, fieldscribe_put_text(&(frame).text, reading, total, words, total)); \
        fieldscribe_untouched(v, words + (total), sizeof words - (total) * sizeof words[0]);     \
        fieldscribe_writes(v, 0U, &(frame).write, words, total);                                 \
    }

/* A group of bits: its word is read, and written back with other bits. */
#define FIELDSCRIBE_UPDATE(frame, kind)                                                          \
    if (fieldscribe_asks(v, "write")) {                                                          \
        uint16_t words[FIELDSCRIBE_ROOM];                                                        \
        const uint8_t unit = (uint8_t)fieldscribe_bits(v, "unit");                               \
        const fieldscribe_modbus_request request = fieldscribe_modbus_read(unit, &(frame).read); \
        if (fieldscribe_exchange(v, 0U, &request, words)) {                                      \
            fieldscribe_put_field_##kind(v, (frame).layout, "raw", words);                       \
            fieldscribe_writes(v, 1U, &(frame).update, words, 1U);                               \
        }                                                                                        \
    }

/* Whether the words of a text in the order of reading are those of the answer. */
FIELDSCRIBE_ONCE bool fieldscribe_reads_text(const fieldscribe_text *text, const uint16_t *words)
{
    uint16_t reading[FIELDSCRIBE_ROOM];
    size_t at = 0U;
    if (fieldscribe_take_text(text, words, text->words - 1U, reading, FIELDSCRIBE_ROOM) ||
        fieldscribe_take_text(text, words, text->words, reading, text->words - 1U) ||
        !fieldscribe_take_text(text, words, text->words, reading, text->words)) {
        return false;
    }
    while (at < text->words && reading[at] == words[fieldscribe_rank(text->addresses, text->words, at)]) {
        ++at;
    }
    return at == text->words;
}

/* ---- Rows ---- */

/* A unit of eight words, for whatever is read and written. */
static uint16_t fieldscribe_held[8];

FIELDSCRIBE_ONCE fieldscribe_modbus_status fieldscribe_ask_held(const fieldscribe_modbus_line *line,
    const fieldscribe_modbus_request *request, fieldscribe_modbus_reply *reply)
{
    uint16_t *const words = &fieldscribe_held[request->address % 8U];
    const size_t size = (size_t)request->count * sizeof words[0];
    if (line == NULL || request->count == 0U || request->address % 8U + request->count > 8U) {
        return FIELDSCRIBE_MODBUS_BAD_COUNT;
    }
    if (request->function == 3U) {
        memcpy(reply->values, words, size);
        reply->count = request->count;
    } else {
        memcpy(words, request->values, size);
    }
    return FIELDSCRIBE_MODBUS_OK;
}

/* The words of a row with its number, the words of another number, and a number that does not fit. */
typedef struct fieldscribe_row_case {
    fieldscribe_layout layout;
    int32_t factor;
    int32_t add;
    int32_t divisor;
    uint16_t words[2];
    int64_t number;
    int64_t put;
    uint16_t written[2];
    int64_t beyond;
} fieldscribe_row_case;

static inline void fieldscribe_holds_row(fieldscribe_vector *v, const fieldscribe_row_case *one)
{
    const fieldscribe_modbus_profile *const profile = fieldscribe_tables_of(v)->profile;
    const fieldscribe_modbus_line line = {profile, NULL, 0U, NULL, NULL, NULL, 0U, 0U};
    const fieldscribe_modbus_line foreign = {NULL, NULL, 0U, NULL, NULL, NULL, 0U, 0U};
    const fieldscribe_modbus_reading read = {3U, 1U, one->layout.words};
    const fieldscribe_modbus_writing write = {16U, 1U, one->layout.words};
    const fieldscribe_modbus_base base = {2U, 3U};
    const fieldscribe_modbus_base early = {2U, 0U};
    const size_t size = one->layout.words * sizeof one->words[0];
    fieldscribe_modbus_unit unit = FIELDSCRIBE_MODBUS_UNIT(&line, &fieldscribe_ask_held, 1U);
    fieldscribe_modbus_based_row based;
    fieldscribe_modbus_row *const row = &based.row;
    int64_t number = 9;
    fieldscribe_fill(&based, sizeof based);
    row->profile = profile;
    row->layout = &one->layout;
    row->read = &read;
    row->write = &write;
    row->low = row->high = one->put;
    row->factor = one->factor;
    row->add = one->add;
    row->divisor = one->divisor;
    memset(fieldscribe_held, 0x5A, sizeof fieldscribe_held);
    memcpy(&fieldscribe_held[1], one->words, size);
    fieldscribe_agree(v,
        fieldscribe_modbus_read_row(&unit, row, &number) == FIELDSCRIBE_MODBUS_OK && number == one->number);
    fieldscribe_agree(v, fieldscribe_modbus_write_row(&unit, row, one->put + 1) == FIELDSCRIBE_MODBUS_OUT_OF_RANGE &&
        fieldscribe_modbus_write_row(&unit, row, one->put - 1) == FIELDSCRIBE_MODBUS_OUT_OF_RANGE);
    row->low = row->high = one->beyond;
    fieldscribe_agree(v, fieldscribe_modbus_write_row(&unit, row, one->beyond) == FIELDSCRIBE_MODBUS_OUT_OF_RANGE &&
        memcmp(&fieldscribe_held[1], one->words, size) == 0);
    row->low = row->high = one->put;
    fieldscribe_agree(v, fieldscribe_modbus_write_row(&unit, row, one->put) == FIELDSCRIBE_MODBUS_OK &&
        memcmp(&fieldscribe_held[1], one->written, size) == 0 && fieldscribe_held[1U + one->layout.words] == 0x5A5AU);
    memcpy(&fieldscribe_held[3], one->words, size);
    fieldscribe_agree(v, fieldscribe_modbus_read_row_at(&unit, &based, base, &number) == FIELDSCRIBE_MODBUS_OK &&
        number == one->number);
    fieldscribe_agree(v, fieldscribe_modbus_write_row_at(&unit, &based, base, one->put) == FIELDSCRIBE_MODBUS_OK &&
        memcmp(&fieldscribe_held[3], one->written, size) == 0);
    fieldscribe_agree(v,
        fieldscribe_modbus_read_row_at(&unit, &based, early, &number) == FIELDSCRIBE_MODBUS_BAD_COUNT &&
            fieldscribe_modbus_write_row_at(&unit, &based, early, one->put) == FIELDSCRIBE_MODBUS_BAD_COUNT);
    unit.line = &foreign;
    fieldscribe_agree(v, fieldscribe_modbus_read_row(&unit, row, &number) == FIELDSCRIBE_MODBUS_BAD_FUNCTION &&
        fieldscribe_modbus_write_row(&unit, row, one->put) == FIELDSCRIBE_MODBUS_BAD_FUNCTION);
    unit.line = &line;
    row->read = NULL;
    row->write = NULL;
    fieldscribe_agree(v,
        fieldscribe_modbus_read_row_at(&unit, &based, base, &number) == FIELDSCRIBE_MODBUS_BAD_FUNCTION &&
            fieldscribe_modbus_write_row_at(&unit, &based, base, one->put) == FIELDSCRIBE_MODBUS_BAD_FUNCTION);
    fieldscribe_agree(v, unit.exception == 0U && number == one->number);
}

/* Rows of every kind of layout, which few programs have. */
static inline void fieldscribe_holds_rows(fieldscribe_vector *v)
{
    static const fieldscribe_row_case cases[] = {
        {{FIELDSCRIBE_U16, 1U, 0x0U, false, 0U, 0xFFFFU, 0U, 0U}, 1, 0, 1, {0xFFFEU}, 65534, 7, {7U}, 65536},
        {{FIELDSCRIBE_S16, 1U, 0x0U, false, 0U, 0xFFFFU, 0U, 0U}, 3, 5, 10, {0xFFF9U}, -25, -24, {0xFFF9U}, 109300},
        {{FIELDSCRIBE_U32, 2U, 0x10U, false, 0U, UINT32_MAX, 0U, 0U}, 2, 6, 1, {1U, 0x8000U}, 1073741822, 1,
            {8U, 0U}, 2147483648},
        {{FIELDSCRIBE_U32, 2U, 0x01U, false, 0U, UINT32_MAX, 0U, 0U}, 1, 0, 1, {0xFFFFU, 0xFFFFU}, UINT32_MAX,
            UINT32_MAX, {0xFFFFU, 0xFFFFU}, (int64_t)UINT32_MAX + 1},
        {{FIELDSCRIBE_S32, 2U, 0x01U, false, 0U, UINT32_MAX, 0U, 0U}, 1, 0, 1, {0xFFFFU, 0xFFFEU}, -2,
            INT32_MIN, {0x8000U, 0U}, (int64_t)INT32_MIN - 1},
        {{FIELDSCRIBE_S32, 2U, 0x01U, false, 0U, UINT32_MAX, 0U, 0U}, 1, 0, 1, {0x8000U, 1U}, -INT32_MAX,
            INT32_MAX, {0x7FFFU, 0xFFFFU}, (int64_t)INT32_MAX + 1},
        {{FIELDSCRIBE_U8, 1U, 0x0U, true, 4U, 0x0FF0U, 0U, 0U}, 1, 0, 1, {0xAFEBU}, 254, 1, {0xA01BU}, 256},
        {{FIELDSCRIBE_S8, 1U, 0x0U, true, 4U, 0x0FF0U, 0U, 0U}, 1, 0, 1, {0xAFEBU}, -2, -128, {0xA80BU}, -129},
        {{FIELDSCRIBE_BIT, 1U, 0x0U, true, 3U, 0x0008U, 0U, 0U}, 1, 0, 1, {0xFFF7U}, 0, 1, {0xFFFFU}, 2},
        {{FIELDSCRIBE_LOW_FIRST, 2U, 0x01U, false, 0U, UINT32_MAX, 0U, 0U}, 1, 0, 1, {0x0102U, 0x0304U}, 0x02010403,
            0x0A0B0C0D, {0x0B0AU, 0x0D0CU}, -1},
        {{FIELDSCRIBE_LOW_FIRST_SIGNED, 1U, 0x0U, false, 0U, 0xFFFFU, 0U, 0U}, 1, 0, 1, {0xFEFFU}, -2, 258,
            {0x0201U}, 32768},
    };
    size_t at;
    fieldscribe_agree(v, FIELDSCRIBE_MODBUS_RAW == -1); /* no number of decimals */
    for (at = 0U; at < sizeof cases / sizeof cases[0]; ++at) {
        fieldscribe_holds_row(v, &cases[at]);
    }
}

#ifdef FIELDSCRIBE_MODBUS_IDENTIFY_H
/* ---- Identification ---- */

static unsigned fieldscribe_asked;

/* The unit of eight words; it refuses address 8, and a request at address 9 is lost. */
FIELDSCRIBE_ONCE fieldscribe_modbus_status fieldscribe_ask_refused(const fieldscribe_modbus_line *line,
    const fieldscribe_modbus_request *request, fieldscribe_modbus_reply *reply)
{
    fieldscribe_modbus_request again = *request;
    again.function = 3U;
    ++fieldscribe_asked;
    return request->address == 8U   ? FIELDSCRIBE_MODBUS_EXCEPTION
           : request->address == 9U ? FIELDSCRIBE_MODBUS_NOISE
                                    : fieldscribe_ask_held(line, &again, reply);
}

FIELDSCRIBE_ONCE fieldscribe_status fieldscribe_is_five(const uint16_t *words)
{
    return words[0] == 5U ? FIELDSCRIBE_OK : FIELDSCRIBE_UNKNOWN_VALUE;
}

FIELDSCRIBE_ONCE fieldscribe_status fieldscribe_is_odd(const uint16_t *words)
{
    return words[0] % 2U == 1U ? FIELDSCRIBE_OK : FIELDSCRIBE_OUT_OF_RANGE;
}

/* Checks as what a unit with 5 in the words 1, 2 and 5 and 7 in word 3 is identified, and in how many requests. */
typedef struct fieldscribe_identity_case {
    size_t count;
    fieldscribe_modbus_expectation rows[3];
    fieldscribe_modbus_status status;
    uint8_t found[3];
    unsigned asked;
} fieldscribe_identity_case;

static inline void fieldscribe_identifies(fieldscribe_vector *v)
{
#define FIELDSCRIBE_EXPECTED(axis, value, function, address, count, what) \
    {axis, value, {function, address, count}, &fieldscribe_is_##what}
    static const fieldscribe_identity_case cases[] = {
        {2U, {FIELDSCRIBE_EXPECTED(0U, 1U, 3U, 1U, 1U, five), FIELDSCRIBE_EXPECTED(0U, 1U, 3U, 3U, 1U, five)},
            FIELDSCRIBE_MODBUS_OK, {0U, 0U, 0U}, 2U},
        {3U, {FIELDSCRIBE_EXPECTED(0U, 1U, 3U, 1U, 1U, five), FIELDSCRIBE_EXPECTED(1U, 1U, 3U, 3U, 1U, five),
            FIELDSCRIBE_EXPECTED(1U, 2U, 3U, 2U, 1U, five)}, FIELDSCRIBE_MODBUS_OK, {1U, 2U, 0U}, 3U},
        {3U, {FIELDSCRIBE_EXPECTED(0U, 1U, 3U, 1U, 1U, five), FIELDSCRIBE_EXPECTED(1U, 1U, 3U, 8U, 1U, five),
            FIELDSCRIBE_EXPECTED(1U, 2U, 3U, 8U, 1U, five)}, FIELDSCRIBE_MODBUS_OK, {1U, 0U, 0U}, 3U},
        {2U, {FIELDSCRIBE_EXPECTED(0U, 1U, 3U, 8U, 1U, five), FIELDSCRIBE_EXPECTED(1U, 1U, 3U, 1U, 1U, five)},
            FIELDSCRIBE_MODBUS_OK, {0U, 0U, 0U}, 1U},
        {2U, {FIELDSCRIBE_EXPECTED(0U, 1U, 3U, 1U, 1U, five), FIELDSCRIBE_EXPECTED(1U, 1U, 3U, 9U, 1U, five)},
            FIELDSCRIBE_MODBUS_NOISE, {1U, 0U, 0U}, 2U},
        {3U, {FIELDSCRIBE_EXPECTED(1U, 1U, 3U, 1U, 1U, five), FIELDSCRIBE_EXPECTED(1U, 2U, 3U, 1U, 1U, five),
            FIELDSCRIBE_EXPECTED(2U, 3U, 3U, 1U, 1U, five)}, FIELDSCRIBE_MODBUS_OK, {1U, 1U, 3U}, 1U},
        {3U, {FIELDSCRIBE_EXPECTED(1U, 1U, 3U, 1U, 1U, five), FIELDSCRIBE_EXPECTED(1U, 1U, 4U, 1U, 1U, five),
            FIELDSCRIBE_EXPECTED(1U, 1U, 4U, 1U, 2U, five)}, FIELDSCRIBE_MODBUS_OK, {1U, 1U, 0U}, 3U},
        {2U, {FIELDSCRIBE_EXPECTED(0U, 1U, 3U, 0U, 1U, odd), FIELDSCRIBE_EXPECTED(1U, 1U, 3U, 1U, 1U, odd)},
            FIELDSCRIBE_MODBUS_OUT_OF_RANGE, {0U, 0U, 0U}, 1U}
    };
#undef FIELDSCRIBE_EXPECTED
    static const uint16_t held[8] = {0U, 5U, 5U, 7U, 0U, 5U, 0U, 0U};
    static const fieldscribe_modbus_base whole = {0U, 0xFFFFU};
    static const fieldscribe_modbus_base later = {4U, 7U};
    const fieldscribe_modbus_line line = {
        fieldscribe_tables_of(v)->profile, NULL, 0U, NULL, NULL, NULL, 0U, 0U};
    fieldscribe_modbus_unit unit = FIELDSCRIBE_MODBUS_UNIT(&line, &fieldscribe_ask_refused, 1U);
    uint8_t found[3];
    size_t at;
    memcpy(fieldscribe_held, held, sizeof held);
    for (at = 0U; at < FIELDSCRIBE_COUNT(cases); ++at) {
        const fieldscribe_identity_case *const one = &cases[at];
        fieldscribe_asked = 0U;
        fieldscribe_fill(found, sizeof found);
        fieldscribe_agree(v,
            fieldscribe_modbus_identify(&unit, whole, one->rows, one->count, found, 3U) == one->status &&
                memcmp(found, one->found, sizeof found) == 0 && fieldscribe_asked == one->asked);
    }
    fieldscribe_agree(v, fieldscribe_modbus_identify(&unit, later, cases[0].rows, 1U, found, 3U) ==
            FIELDSCRIBE_MODBUS_OK && found[0] == 1U);
}

#endif
/* ---- Frames ---- */

static fieldscribe_modbus_framing fieldscribe_read_request(
    fieldscribe_vector *v, uint16_t *values, fieldscribe_modbus_request *request)
{
    const size_t given = fieldscribe_numbers(v, "values", values, FIELDSCRIBE_VALUES_MOST);
    const uint8_t unit = (uint8_t)fieldscribe_bits(v, "unit");
    const fieldscribe_modbus_reading read = {(uint8_t)fieldscribe_bits(v, "function"),
        (uint16_t)fieldscribe_bits(v, "address"), (uint16_t)fieldscribe_bits(v, "count")};
    const fieldscribe_modbus_writing write = {read.function, read.address, read.count};
    *request = fieldscribe_modbus_reads(read.function) ? fieldscribe_modbus_read(unit, &read)
                                                       : fieldscribe_modbus_write(unit, &write, values, given);
    request->transaction = (uint16_t)fieldscribe_bits(v, "transaction");
    return fieldscribe_framing(v);
}

/* The bytes of a frame before its PDU. */
static size_t fieldscribe_before_pdu(fieldscribe_modbus_framing framing)
{
    return framing == FIELDSCRIBE_MODBUS_TCP ? 7U : 1U;
}

/* A buffer of exactly the length suffices, a shorter one does not; and a write needs values. */
static void fieldscribe_rebuild(fieldscribe_vector *v, fieldscribe_modbus_framing framing,
    const fieldscribe_modbus_request *request, const uint8_t *expected, size_t length)
{
    const fieldscribe_modbus_profile *const profile = fieldscribe_tables_of(v)->profile;
    const fieldscribe_modbus_writing less = {request->function, request->address, request->count};
    fieldscribe_modbus_request empty;
    const size_t inner = length - fieldscribe_modbus_around(framing) + 1U; /* from the unit on */
    uint8_t built[FIELDSCRIBE_MODBUS_TCP_MOST];
    size_t again = SIZE_MAX;
    fieldscribe_fill(built, sizeof built);
    fieldscribe_agree(v,
        fieldscribe_modbus_build(profile, framing, request, built, length - 1U, &again) ==
            FIELDSCRIBE_MODBUS_BUFFER_TOO_SMALL && again == 0U);
    fieldscribe_untouched(v, built, sizeof built);
    fieldscribe_agree(v,
        fieldscribe_modbus_build(profile, framing, request, built, length, &again) == FIELDSCRIBE_MODBUS_OK &&
            again == length && memcmp(built, expected, length) == 0);
    fieldscribe_agree(v,
        fieldscribe_modbus_build_pdu(profile, request, built, inner - 1U, &again) ==
                FIELDSCRIBE_MODBUS_BUFFER_TOO_SMALL && again == 0U &&
            fieldscribe_modbus_build_pdu(profile, request, built, inner, &again) == FIELDSCRIBE_MODBUS_OK &&
            again == inner - 1U &&
            memcmp(built, &expected[fieldscribe_before_pdu(framing)], again) == 0);
    empty = fieldscribe_modbus_write(request->unit, &less, request->values, (size_t)request->count - 1U);
    fieldscribe_agree(v, fieldscribe_modbus_reads(request->function) ||
        fieldscribe_modbus_build(profile, framing, &empty, built, sizeof built, &again) ==
            FIELDSCRIBE_MODBUS_BAD_COUNT);
}

static void fieldscribe_run_build(fieldscribe_vector *v)
{
    static uint16_t values[FIELDSCRIBE_VALUES_MOST];
    uint8_t built[FIELDSCRIBE_MODBUS_TCP_MOST];
    fieldscribe_modbus_request request;
    size_t length = SIZE_MAX;
    const fieldscribe_modbus_framing framing = fieldscribe_read_request(v, values, &request);
    fieldscribe_modbus_status status;
    fieldscribe_fill(built, sizeof built);
    status =
        fieldscribe_modbus_build(fieldscribe_tables_of(v)->profile, framing, &request, built, sizeof built, &length);
    fieldscribe_is_text(v, "status", fieldscribe_modbus_status_name(status));
    fieldscribe_agree(v, length <= sizeof built);
    if (length <= sizeof built) {
        fieldscribe_is_bytes(v, "bytes", built, length);
        fieldscribe_untouched(v, built + length, sizeof built - length);
    }
    if (status == FIELDSCRIBE_MODBUS_OK && length > 0U) {
        const fieldscribe_modbus_profile *const profile = fieldscribe_tables_of(v)->profile;
        const uint32_t awaited = fieldscribe_modbus_reply_length(profile, framing, &request);
        fieldscribe_agree(v, (awaited == 0U) == (request.unit == profile->broadcast));
        fieldscribe_rebuild(v, framing, &request, built, length);
    }
}

/* Room for exactly the received values suffices, less does not; an echo is compared with what was sent. */
static void fieldscribe_reparse(fieldscribe_vector *v, fieldscribe_modbus_framing framing,
    const fieldscribe_modbus_request *request, const uint8_t *bytes, size_t length)
{
    static uint16_t read[FIELDSCRIBE_VALUES_MOST];
    const bool reads = fieldscribe_modbus_reads(request->function);
    const bool several = request->function == 0x0FU || request->function == 0x10U;
    const size_t room = reads ? request->count : 1U;
    const uint8_t *const pdu = &bytes[fieldscribe_before_pdu(framing)];
    const size_t inner = length - fieldscribe_modbus_around(framing);
    fieldscribe_modbus_request empty = *request;
    fieldscribe_modbus_reply reply = fieldscribe_reply_into(read, room - 1U);
    fieldscribe_fill(read, sizeof read);
    fieldscribe_agree(v,
        fieldscribe_modbus_parse(framing, request, bytes, length, &reply) ==
            (reads ? FIELDSCRIBE_MODBUS_BUFFER_TOO_SMALL : FIELDSCRIBE_MODBUS_OK) && reply.count == 0U);
    fieldscribe_untouched(v, read, sizeof read);
    reply.room = room;
    fieldscribe_agree(v,
        fieldscribe_modbus_parse(framing, request, bytes, length, &reply) == FIELDSCRIBE_MODBUS_OK &&
            reply.count == (several ? 0U : room));
    fieldscribe_agree(v,
        fieldscribe_modbus_parse_pdu(request, pdu, inner, &reply) == FIELDSCRIBE_MODBUS_OK &&
            reply.count == (several ? 0U : room));
    fieldscribe_agree(v,
        fieldscribe_modbus_parse_pdu(request, pdu, inner - 1U, &reply) == FIELDSCRIBE_MODBUS_SHORT_FRAME &&
            fieldscribe_modbus_parse_pdu(request, pdu, 1U, &reply) == FIELDSCRIBE_MODBUS_SHORT_FRAME &&
            fieldscribe_modbus_parse_pdu(request, pdu, inner + 1U, &reply) == FIELDSCRIBE_MODBUS_LONG_FRAME);
    empty.function = (uint8_t)(request->function + 1U);
    fieldscribe_agree(
        v, fieldscribe_modbus_parse_pdu(&empty, pdu, inner, &reply) == FIELDSCRIBE_MODBUS_WRONG_FUNCTION);
    empty.function = request->function;
    fieldscribe_agree(
        v, fieldscribe_modbus_parse(framing, request, NULL, 0U, &reply) == FIELDSCRIBE_MODBUS_SHORT_FRAME);
    if (!reads && !several) {
        empty.count = 0U;
        fieldscribe_agree(v, fieldscribe_modbus_parse(framing, &empty, bytes, length, &reply) ==
            FIELDSCRIBE_MODBUS_ECHO_MISMATCH);
    }
}

/* A receiver finds the answer after noise, in pieces of any size, and takes no byte after it. */
static void fieldscribe_finds(fieldscribe_vector *v, fieldscribe_modbus_framing framing,
    const fieldscribe_modbus_request *request, const uint8_t *bytes, size_t length)
{
    static const size_t pieces[] = {1U, 2U, SIZE_MAX};
    const fieldscribe_modbus_profile *const profile = fieldscribe_tables_of(v)->profile;
    const size_t size = fieldscribe_modbus_reply_length(profile, framing, request);
    uint8_t buffer[FIELDSCRIBE_BYTES_MOST];
    fieldscribe_stream stream;
    unsigned kind;
    size_t at;
    for (kind = 0U; kind < 12U && size < sizeof buffer; ++kind) {
        const size_t noise = fieldscribe_stream_noise(
            &stream, kind % 4U, bytes, length, framing == FIELDSCRIBE_MODBUS_TCP ? 1U : length - 1U);
        const size_t piece = pieces[kind / 4U];
        fieldscribe_modbus_receiver receiver = fieldscribe_modbus_await(profile, framing, request, buffer, size);
        size_t taken = 0U;
        fieldscribe_fill(buffer, sizeof buffer);
        fieldscribe_stream_add(&stream, bytes, length);
        fieldscribe_stream_add(&stream, bytes, 1U);
        for (at = 0U; at < stream.count; at += taken) {
            const size_t most = stream.count - at;
            fieldscribe_agree(v, receiver.done == (at == noise + length));
            taken = fieldscribe_modbus_receive(&receiver, stream.bytes + at, most < piece ? most : piece);
            if (taken == 0U) {
                break;
            }
        }
        fieldscribe_agree(v, receiver.done && at == noise + length && receiver.dropped == noise &&
            receiver.length == length && memcmp(buffer, bytes, length) == 0);
        fieldscribe_untouched(v, buffer + size, sizeof buffer - size);
        receiver = fieldscribe_modbus_await(profile, framing, request, buffer, size - 1U);
        fieldscribe_agree(v, receiver.done && receiver.length == 0U);
    }
}

/* After silence, a refusal is found after the start of a longer answer. */
static void fieldscribe_finds_in_silence(fieldscribe_vector *v, const fieldscribe_modbus_request *request,
    const uint8_t *bytes, size_t length)
{
    const fieldscribe_modbus_profile *const profile = fieldscribe_tables_of(v)->profile;
    const size_t size = fieldscribe_modbus_reply_length(profile, FIELDSCRIBE_MODBUS_RTU, request);
    const uint8_t begin[] = {bytes[0], (uint8_t)(bytes[1] & 0x7FU), (uint8_t)(size - 5U)};
    uint8_t buffer[FIELDSCRIBE_BYTES_MOST];
    fieldscribe_modbus_receiver receiver =
        fieldscribe_modbus_await(profile, FIELDSCRIBE_MODBUS_RTU, request, buffer, size);
    if (length + sizeof begin < size && size < sizeof buffer) {
        (void)fieldscribe_modbus_receive(&receiver, begin, sizeof begin);
        (void)fieldscribe_modbus_receive(&receiver, bytes, length);
        fieldscribe_agree(v, !receiver.done && receiver.length == length + sizeof begin);
        fieldscribe_modbus_silent(&receiver);
        fieldscribe_agree(v, receiver.done && receiver.length == length && receiver.dropped == sizeof begin &&
            memcmp(buffer, bytes, length) == 0);
        fieldscribe_modbus_silent(&receiver);
        fieldscribe_agree(v, receiver.done && receiver.length == length);
    }
}

static inline fieldscribe_modbus_status fieldscribe_asks_line_of(fieldscribe_vector *v,
    fieldscribe_modbus_framing framing, const fieldscribe_modbus_request *request, fieldscribe_stream *stream,
    fieldscribe_modbus_reply *reply, size_t size)
{
    uint8_t buffer[FIELDSCRIBE_BYTES_MOST];
    const fieldscribe_modbus_line line = {fieldscribe_tables_of(v)->profile, buffer, size,
        &fieldscribe_stream_send, &fieldscribe_stream_receive, stream, FIELDSCRIBE_ANSWER_MS,
        FIELDSCRIBE_PAUSE_MS};
    return framing == FIELDSCRIBE_MODBUS_TCP ? fieldscribe_modbus_ask_tcp(&line, request, reply)
                                             : fieldscribe_modbus_ask_rtu(&line, request, reply);
}

static inline fieldscribe_modbus_status fieldscribe_asks_line(fieldscribe_vector *v, fieldscribe_modbus_framing framing,
    const fieldscribe_modbus_request *request, fieldscribe_stream *stream, fieldscribe_modbus_reply *reply)
{
    return fieldscribe_asks_line_of(v, framing, request, stream, reply, FIELDSCRIBE_BYTES_MOST);
}

/* Nothing is sent if the answer has no room; late bytes are dropped before a request; nobody answers a broadcast. */
static void fieldscribe_asks_with_care(fieldscribe_vector *v, fieldscribe_modbus_framing framing,
    const fieldscribe_modbus_request *request, const uint8_t *bytes, size_t length)
{
    static uint16_t read[FIELDSCRIBE_VALUES_MOST];
    const fieldscribe_modbus_profile *const profile = fieldscribe_tables_of(v)->profile;
    const size_t size = fieldscribe_modbus_reply_length(profile, framing, request);
    fieldscribe_modbus_reply reply = fieldscribe_reply_into(read, FIELDSCRIBE_VALUES_MOST);
    fieldscribe_modbus_request other = *request;
    fieldscribe_stream stream;
    memset(&stream, 0, sizeof stream);
    fieldscribe_agree(v, fieldscribe_asks_line_of(v, framing, request, &stream, &reply, size - 1U) ==
        FIELDSCRIBE_MODBUS_BUFFER_TOO_SMALL);
    reply.room = request->count - 1U;
    fieldscribe_agree(v, !fieldscribe_modbus_reads(request->function) ||
        fieldscribe_asks_line(v, framing, request, &stream, &reply) == FIELDSCRIBE_MODBUS_BUFFER_TOO_SMALL);
    fieldscribe_agree(v, stream.sent_count == 0U && reply.count == 0U);
    reply.room = request->count;
    if (framing == FIELDSCRIBE_MODBUS_RTU) {
        fieldscribe_stream_add(&stream, bytes, length);
        fieldscribe_stream_add(&stream, bytes, length);
        stream.silence = length;
        other.late = true;
        fieldscribe_agree(v, fieldscribe_asks_line(v, framing, &other, &stream, &reply) == FIELDSCRIBE_MODBUS_OK &&
            stream.given == stream.count);
        stream.endless = true;
        fieldscribe_agree(v, fieldscribe_asks_line(v, framing, &other, &stream, &reply) != FIELDSCRIBE_MODBUS_OK &&
            stream.given < stream.count + 3U * FIELDSCRIBE_MODBUS_ASK_MOST);
    }
    if (profile->broadcast <= 0xFFU && ((profile->to_all >> request->function) & 1U) != 0U) {
        memset(&stream, 0, sizeof stream);
        other.unit = (uint8_t)profile->broadcast;
        other.late = false;
        stream.waited = 1U;
        fieldscribe_agree(v, fieldscribe_asks_line(v, framing, &other, &stream, &reply) == FIELDSCRIBE_MODBUS_OK &&
            stream.sent_count > 0U && stream.waited == 1U);
    }
}

/* What cannot be built is not sent. */
static void fieldscribe_sends_nothing(fieldscribe_vector *v)
{
    static uint16_t values[FIELDSCRIBE_VALUES_MOST];
    static uint16_t read[FIELDSCRIBE_VALUES_MOST];
    fieldscribe_modbus_request request;
    fieldscribe_modbus_reply reply = fieldscribe_reply_into(read, FIELDSCRIBE_VALUES_MOST);
    fieldscribe_stream stream;
    const fieldscribe_modbus_framing framing = fieldscribe_read_request(v, values, &request);
    memset(&stream, 0, sizeof stream);
    if (!fieldscribe_spells(fieldscribe_field(v, "status"), "ok")) {
        const fieldscribe_modbus_status status = fieldscribe_asks_line(v, framing, &request, &stream, &reply);
        fieldscribe_is_text(v, "status", fieldscribe_modbus_status_name(status));
        fieldscribe_agree(v, stream.sent_count == 0U && reply.count == 0U && reply.exception == 0U);
    }
}

/* Asking returns what parsing does, whatever comes before the answer, and ends if none comes. */
static void fieldscribe_is_asked(fieldscribe_vector *v, fieldscribe_modbus_framing framing,
    const fieldscribe_modbus_request *request, const uint8_t *bytes, size_t length, fieldscribe_modbus_status parsed)
{
    static uint16_t read[FIELDSCRIBE_VALUES_MOST];
    static uint16_t expected[FIELDSCRIBE_VALUES_MOST];
    uint8_t built[FIELDSCRIBE_BYTES_MOST];
    size_t sent = 0U;
    const fieldscribe_modbus_profile *const profile = fieldscribe_tables_of(v)->profile;
    fieldscribe_modbus_reply reply = fieldscribe_reply_into(read, FIELDSCRIBE_VALUES_MOST);
    fieldscribe_modbus_reply parsing = fieldscribe_reply_into(expected, FIELDSCRIBE_VALUES_MOST);
    const size_t hurt = framing == FIELDSCRIBE_MODBUS_TCP ? 1U : length - 1U;
    fieldscribe_stream stream;
    unsigned kind;
    if (fieldscribe_modbus_build(profile, framing, request, built, sizeof built, &sent) != FIELDSCRIBE_MODBUS_OK) {
        return;
    }
    fieldscribe_agree(v, fieldscribe_modbus_parse(framing, request, bytes, length, &parsing) == parsed);
    for (kind = 0U; kind < 4U; ++kind) {
        (void)fieldscribe_stream_noise(&stream, kind, bytes, length, hurt);
        fieldscribe_stream_add(&stream, bytes, length);
        fieldscribe_agree(v, fieldscribe_asks_line(v, framing, request, &stream, &reply) == parsed &&
            reply.count == parsing.count && reply.exception == parsing.exception &&
            memcmp(read, expected, reply.count * sizeof read[0]) == 0 && stream.given == stream.count);
        fieldscribe_agree(v, stream.sent_count == sent && memcmp(stream.sent, built, sent) == 0);
        (void)fieldscribe_stream_noise(&stream, kind, bytes, length, hurt);
        fieldscribe_stream_add(&stream, bytes, length - 1U); /* the last byte does not come */
        fieldscribe_agree(v, kind == 2U || fieldscribe_asks_line(v, framing, request, &stream, &reply) ==
            (kind == 0U ? FIELDSCRIBE_MODBUS_SHORT_FRAME : FIELDSCRIBE_MODBUS_NOISE));
        fieldscribe_agree(v, kind != 0U || stream.waited == FIELDSCRIBE_PAUSE_MS);
    }
    (void)fieldscribe_stream_noise(&stream, 1U, bytes, length, hurt);
    fieldscribe_stream_add(&stream, bytes, length);
    stream.silence = 1U; /* after noise and silence, an answer has its full time again */
    fieldscribe_agree(v, fieldscribe_asks_line(v, framing, request, &stream, &reply) == parsed &&
        stream.patience == FIELDSCRIBE_ANSWER_MS);
    if (parsed == FIELDSCRIBE_MODBUS_OK) {
        fieldscribe_asks_with_care(v, framing, request, bytes, length);
    } else if (framing == FIELDSCRIBE_MODBUS_RTU) {
        fieldscribe_finds_in_silence(v, request, bytes, length);
    } else {
        /* a refusal over TCP says its length */
    }
    memset(&stream, 0, sizeof stream);
    fieldscribe_agree(
        v, fieldscribe_asks_line(v, framing, request, &stream, &reply) == FIELDSCRIBE_MODBUS_SHORT_FRAME &&
            stream.waited == FIELDSCRIBE_ANSWER_MS);
    (void)fieldscribe_stream_noise(&stream, 1U, bytes, length, 0U);
    stream.endless = true;
    fieldscribe_agree(v, fieldscribe_asks_line(v, framing, request, &stream, &reply) == FIELDSCRIBE_MODBUS_NOISE &&
        stream.given <= FIELDSCRIBE_MODBUS_ASK_MOST && stream.given + 9U > FIELDSCRIBE_MODBUS_ASK_MOST);
}

static void fieldscribe_run_reply(fieldscribe_vector *v)
{
    static uint16_t values[FIELDSCRIBE_VALUES_MOST];
    static uint16_t read[FIELDSCRIBE_VALUES_MOST];
    uint8_t bytes[FIELDSCRIBE_BYTES_MOST];
    fieldscribe_modbus_request request;
    fieldscribe_modbus_reply reply = fieldscribe_reply_into(read, FIELDSCRIBE_VALUES_MOST);
    fieldscribe_modbus_status status;
    const fieldscribe_modbus_framing framing = fieldscribe_read_request(v, values, &request);
    const size_t length = fieldscribe_bytes(v, "bytes", bytes, sizeof bytes);
    fieldscribe_fill(read, sizeof read);
    status = fieldscribe_modbus_parse(framing, &request, bytes, length, &reply);
    fieldscribe_is_text(v, "status", fieldscribe_modbus_status_name(status));
    fieldscribe_agree(v, reply.count <= (size_t)FIELDSCRIBE_VALUES_MOST);
    if (reply.count <= (size_t)FIELDSCRIBE_VALUES_MOST) {
        fieldscribe_is_words(v, "values_out", read, reply.count);
        fieldscribe_untouched(v, read + reply.count, sizeof read - reply.count * sizeof read[0]);
    }
    fieldscribe_is_count(v, "exception", reply.exception);
    fieldscribe_is_awaited(v, framing, &request, bytes, length, status);
    if (status == FIELDSCRIBE_MODBUS_OK) {
        fieldscribe_reparse(v, framing, &request, bytes, length);
    }
    if ((status == FIELDSCRIBE_MODBUS_OK || status == FIELDSCRIBE_MODBUS_EXCEPTION) &&
        request.unit != fieldscribe_tables_of(v)->profile->broadcast) {
        fieldscribe_finds(v, framing, &request, bytes, length);
        fieldscribe_is_asked(v, framing, &request, bytes, length, status);
    }
}

/* How many functions the device knows. */
static uint64_t fieldscribe_known_functions(const fieldscribe_modbus_profile *profile)
{
    uint64_t known = 0U;
    size_t function;
    for (function = 0U; function < FIELDSCRIBE_MODBUS_FUNCTIONS; ++function) {
        known += profile->most[function] != 0U ? 1U : 0U;
    }
    return known;
}

/* What the profile says of a function. */
static void fieldscribe_run_function(fieldscribe_vector *v)
{
    const fieldscribe_modbus_profile *const profile = fieldscribe_tables_of(v)->profile;
    const uint64_t function = fieldscribe_bits(v, "number");
    fieldscribe_agree(v, fieldscribe_bits(v, "index") < fieldscribe_known_functions(profile));
    if (function < FIELDSCRIBE_MODBUS_FUNCTIONS) {
        fieldscribe_agree(v, !fieldscribe_modbus_reads(0x00U) && !fieldscribe_modbus_reads(0x05U));
        fieldscribe_is_number(v, "most", profile->most[function]);
        fieldscribe_is_number(v, "broadcast", (profile->to_all >> function) & 1U);
    }
}

static void fieldscribe_run_limit(fieldscribe_vector *v)
{
    const fieldscribe_modbus_profile *const profile = fieldscribe_tables_of(v)->profile;
    fieldscribe_holds_long_numbers(v);
    fieldscribe_holds_rows(v);
#ifdef FIELDSCRIBE_MODBUS_IDENTIFY_H
    fieldscribe_identifies(v);
#endif
    FIELDSCRIBE_NAMES_STATUS(modbus, MODBUS, "buffer_too_small", BUFFER_TOO_SMALL)
    FIELDSCRIBE_NAMES_STATUS(modbus, MODBUS, "noise", NOISE)
    FIELDSCRIBE_NAMES_STATUSES(fieldscribe_modbus_status, fieldscribe_modbus_status_name)
    FIELDSCRIBE_LIMIT("first_unit", profile->first_unit)
    FIELDSCRIBE_LIMIT("last_unit", profile->last_unit)
    FIELDSCRIBE_LIMIT("functions", fieldscribe_known_functions(profile))
    FIELDSCRIBE_LIMIT("broadcast", profile->broadcast)
    FIELDSCRIBE_LIMIT("no_broadcast", FIELDSCRIBE_MODBUS_NO_BROADCAST)
    FIELDSCRIBE_LIMIT("rtu_bytes", FIELDSCRIBE_MODBUS_RTU_MOST)
    FIELDSCRIBE_LIMIT("tcp_bytes", FIELDSCRIBE_MODBUS_TCP_MOST)
}

/* The items of the largest block of all groups. */
static inline uint16_t fieldscribe_largest(const fieldscribe_blocks *group)
{
    uint16_t most = 0U;
    size_t at;
    for (; group->group != NULL; ++group) {
        for (at = 0U; at < group->count; ++at) {
            most = group->blocks[at].count > most ? group->blocks[at].count : most;
        }
    }
    return most;
}

static void fieldscribe_run_block(fieldscribe_vector *v)
{
    static const char *const spaces[] = {"", "coil", "discrete", "holding", "input"};
    const uint64_t address = fieldscribe_bits(v, "address");
    size_t at = 0U;
    const fieldscribe_blocks *group = fieldscribe_tables_of(v)->blocks;
    const fieldscribe_modbus_reading *block;
    fieldscribe_modbus_request request;
    while (group->group != NULL && !fieldscribe_spells(fieldscribe_field(v, "group"), group->group)) {
        ++group;
    }
    while (at < group->count && (group->blocks[at].address != address ||
        group->blocks[at].function != fieldscribe_bits(v, "function"))) {
        ++at;
    }
    if (group->group == NULL || at == group->count) {
        return;
    }
    block = &group->blocks[at];
    request = fieldscribe_modbus_read(1U, block);
    fieldscribe_agree(v, fieldscribe_tables_of(v)->most == fieldscribe_largest(fieldscribe_tables_of(v)->blocks));
    fieldscribe_agree(v, request.unit == 1U && request.values == NULL &&
        request.function == block->function && request.address == block->address && request.count == block->count);
    fieldscribe_is_text(v, "space", block->function >= 1U && block->function <= 4U ? spaces[block->function] : NULL);
    fieldscribe_is_number(v, "count", block->count);
}

static bool fieldscribe_run_frame(fieldscribe_vector *v)
{
    if (fieldscribe_asks(v, "build")) {
        fieldscribe_run_build(v);
        fieldscribe_sends_nothing(v);
    } else if (fieldscribe_asks(v, "reply")) {
        fieldscribe_run_reply(v);
    } else if (fieldscribe_asks(v, "block")) {
        fieldscribe_run_block(v);
    } else if (fieldscribe_asks(v, "function")) {
        fieldscribe_run_function(v);
    } else if (fieldscribe_asks(v, "limit")) {
        fieldscribe_run_limit(v);
    } else {
        return false;
    }
    return true;
}

#endif
