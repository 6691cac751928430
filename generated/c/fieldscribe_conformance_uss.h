/*
 * What conformance programs of USS devices have beside the core: exchanges of points, and frames.
 *
 * SPDX-License-Identifier: 0BSD
 */
#ifndef FIELDSCRIBE_CONFORMANCE_USS_H
#define FIELDSCRIBE_CONFORMANCE_USS_H

#include "fieldscribe_conformance.h"
#include "fieldscribe_uss.h"

/* The tables of a device. */
typedef struct fieldscribe_tables {
    const fieldscribe_uss_profile *profile;
} fieldscribe_tables;

static inline const fieldscribe_tables *fieldscribe_tables_of(const fieldscribe_vector *v)
{
    return (const fieldscribe_tables *)v->suite->family;
}

static fieldscribe_uss_link fieldscribe_read_link(fieldscribe_vector *v)
{
    fieldscribe_uss_link link;
    link.pkw = (uint8_t)fieldscribe_at_most(v, "pkw", 255U);
    link.pzd = (uint8_t)fieldscribe_at_most(v, "pzd", 255U);
    link.single_first = fieldscribe_bits(v, "single_first") != 0U;
    return link;
}

/* Memory for a reply with this many words of process data. */
static inline fieldscribe_uss_reply fieldscribe_reply_into(uint16_t *process, size_t room)
{
    fieldscribe_uss_reply reply;
    fieldscribe_fill(&reply, sizeof reply);
    reply.process = process;
    reply.room = room;
    return reply;
}

/* A receiver that asks before each byte how many are missing learns at the last byte, not before, that it is. */
static inline void fieldscribe_receives(
    fieldscribe_vector *v, const fieldscribe_uss_link *link, const uint8_t *bytes, size_t length)
{
    const bool varies = link->pkw == FIELDSCRIBE_USS_VARIABLE;
    const uint32_t shortest = fieldscribe_uss_reply_length(link);
    size_t got;
    fieldscribe_agree(v, varies ? shortest == 10U + 2U * link->pzd : shortest == length);
    for (got = 0U; got <= length; ++got) {
        const size_t known = got < 2U ? shortest : length;
        fieldscribe_agree(v, fieldscribe_uss_left(link, bytes, length, got) == known - got);
        fieldscribe_agree(v, fieldscribe_uss_left(link, bytes, got, got) == 0U);
        fieldscribe_agree(v, got == known || fieldscribe_uss_left(link, bytes, known - 1U, got) == known - 1U - got);
    }
}

/* Sends a request of the script with process data and parses what comes back; the status is that of the answer. */
FIELDSCRIBE_ONCE fieldscribe_uss_status fieldscribe_ask(fieldscribe_vector *v, size_t place,
    const fieldscribe_uss_request *request, const fieldscribe_uss_words *process, fieldscribe_uss_reply *reply)
{
    const fieldscribe_uss_link link = fieldscribe_read_link(v);
    uint8_t bytes[FIELDSCRIBE_BYTES_MOST];
    const char *sent = NULL;
    const char *received = NULL;
    fieldscribe_uss_status status;
    size_t length = 0U;
    if (!fieldscribe_step(v, place, &sent, &received)) {
        return FIELDSCRIBE_USS_NOISE;
    }
    status = fieldscribe_uss_build(
        fieldscribe_tables_of(v)->profile, &link, request, process, bytes, sizeof bytes, &length);
    fieldscribe_agree(v, status == FIELDSCRIBE_USS_OK);
    fieldscribe_sends(v, sent, bytes, length);
    length = fieldscribe_hex(received, bytes, sizeof bytes);
    status = fieldscribe_uss_parse(fieldscribe_tables_of(v)->profile, &link, request, bytes, length, reply);
    fieldscribe_is_text(v, "status", fieldscribe_uss_status_name(status));
    return status;
}

/* The same with words that are sent and replaced by those of the answer; returns whether there is one. */
FIELDSCRIBE_ONCE bool fieldscribe_exchange(fieldscribe_vector *v, size_t place, const fieldscribe_uss_request *request,
    uint16_t *words, fieldscribe_uss_reply *reply)
{
    const fieldscribe_uss_words process = {words, fieldscribe_read_link(v).pzd};
    *reply = fieldscribe_reply_into(words, 256U);
    return fieldscribe_ask(v, place, request, &process, reply) == FIELDSCRIBE_USS_OK;
}

/* The vector whose exchange a call does, its line, and how many of its steps were done. */
static fieldscribe_vector *fieldscribe_called;
static fieldscribe_uss_link fieldscribe_called_link;
static fieldscribe_uss_line fieldscribe_called_line;
static size_t fieldscribe_done;

FIELDSCRIBE_ONCE fieldscribe_uss_status fieldscribe_ask_script(const fieldscribe_uss_line *line,
    const fieldscribe_uss_request *request, const fieldscribe_uss_words *process, fieldscribe_uss_reply *reply)
{
    const size_t count = line->link->pzd;
    fieldscribe_agree(fieldscribe_called, line == &fieldscribe_called_line && process->count == count &&
        reply->room == count && reply->process != NULL);
    return fieldscribe_ask(fieldscribe_called, fieldscribe_done++, request, process, reply);
}

/* The unit of a handle whose exchange is the script. */
FIELDSCRIBE_ONCE fieldscribe_uss_unit fieldscribe_called_unit(fieldscribe_vector *v)
{
    static const uint16_t sent[256] = {0U};
    static uint16_t heard[256];
    fieldscribe_uss_unit unit = FIELDSCRIBE_USS_UNIT(
        &fieldscribe_called_line, &fieldscribe_ask_script, sent, heard, (uint8_t)fieldscribe_bits(v, "unit"));
    fieldscribe_agree(v, unit.error == 0U);
    unit.error = 0x7FU;
    fieldscribe_called = v;
    fieldscribe_called_link = fieldscribe_read_link(v);
    fieldscribe_called_line.link = &fieldscribe_called_link;
    fieldscribe_done = 0U;
    return unit;
}

/* Checks that a call does the whole script and returns the status of its exchange or conversion. */
FIELDSCRIBE_ONCE void fieldscribe_is_called(
    fieldscribe_vector *v, const fieldscribe_uss_unit *unit, int status, int converted)
{
    const fieldscribe_uss_status exchanged = converted == 0 ? (fieldscribe_uss_status)status : FIELDSCRIBE_USS_OK;
    fieldscribe_is_text(v, "status", fieldscribe_uss_status_name(exchanged));
    fieldscribe_agree(v, converted == 0 || converted == status);
    fieldscribe_agree(v, fieldscribe_done == fieldscribe_steps(v));
    fieldscribe_agree(v, unit->error != 0x7FU && (unit->error == 0U || exchanged == FIELDSCRIBE_USS_REFUSED));
}

/* The words of a value; none for a value of another width. */
FIELDSCRIBE_ONCE void fieldscribe_is_value(fieldscribe_vector *v, const fieldscribe_uss_reply *reply,
    const fieldscribe_uss_reading *what, uint16_t *words)
{
    fieldscribe_uss_reply other = *reply;
    uint16_t untouched[3];
    fieldscribe_fill(untouched, sizeof untouched);
    fieldscribe_agree(v, fieldscribe_uss_words_of_reply(reply, what, words, what->width) == FIELDSCRIBE_USS_OK);
    other.width = (uint8_t)(3U - reply->width);
    fieldscribe_agree(v, fieldscribe_uss_words_of_reply(&other, what, untouched, 3U) == FIELDSCRIBE_USS_WRONG_RESPONSE);
    other.width = 0U;
    fieldscribe_agree(v, fieldscribe_uss_words_of_reply(&other, what, untouched, 3U) == FIELDSCRIBE_USS_WRONG_RESPONSE);
    fieldscribe_agree(v, fieldscribe_uss_words_of_reply(reply, what, untouched, what->width - 1U) ==
        FIELDSCRIBE_USS_BUFFER_TOO_SMALL);
    fieldscribe_untouched(v, untouched, sizeof untouched);
    fieldscribe_agree(v, fieldscribe_uss_words_of_reply(reply, what, untouched, what->width) == FIELDSCRIBE_USS_OK);
    fieldscribe_untouched(v, untouched + what->width, sizeof untouched - what->width * sizeof untouched[0]);
}

#define FIELDSCRIBE_READ(frame, kind)                                                            \
    if (fieldscribe_asks(v, "read")) {                                                           \
        uint16_t words[256] = {0U};                                                              \
        uint16_t value[2] = {0U, 0U};                                                            \
        fieldscribe_uss_reply reply;                                                             \
        const fieldscribe_uss_request request =                                                  \
            fieldscribe_uss_read((uint8_t)fieldscribe_bits(v, "unit"), &(frame).read);           \
        if (fieldscribe_exchange(v, 0U, &request, words, &reply)) {                              \
            fieldscribe_is_value(v, &reply, &(frame).read, value);                               \
            fieldscribe_taken_##kind(v, (frame).layout, value);                                  \
        }                                                                                        \
    }

#define FIELDSCRIBE_WRITE(what, frame, kind)                                                     \
    if (fieldscribe_asks(v, what)) {                                                             \
        uint16_t words[256] = {0U};                                                              \
        uint16_t value[2] = {0U, 0U};                                                            \
        fieldscribe_uss_reply reply;                                                             \
        fieldscribe_uss_request request;                                                         \
        fieldscribe_put_field_##kind(v, (frame).layout, "raw", value);                           \
        request = fieldscribe_uss_write(                                                         \
            (uint8_t)fieldscribe_bits(v, "unit"), &(frame).write, value, (frame).write.width - 1U); \
        fieldscribe_agree(v, request.width == FIELDSCRIBE_USS_TOO_FEW_WORDS);                    \
        request = fieldscribe_uss_write(                                                         \
            (uint8_t)fieldscribe_bits(v, "unit"), &(frame).write, value, (frame).write.width);   \
        fieldscribe_agree(v, request.width == (frame).layout->words);                            \
        (void)fieldscribe_exchange(v, 0U, &request, words, &reply);                              \
    }

/* A group of bits: its word is read, and written back with other bits. */
#define FIELDSCRIBE_UPDATE(what, reading, frame, kind)                                           \
    if (fieldscribe_asks(v, what)) {                                                             \
        uint16_t words[256] = {0U};                                                              \
        uint16_t value[2] = {0U, 0U};                                                            \
        fieldscribe_uss_reply reply;                                                             \
        const uint8_t unit = (uint8_t)fieldscribe_bits(v, "unit");                               \
        fieldscribe_uss_request request = fieldscribe_uss_read(unit, &(reading));                \
        if (fieldscribe_exchange(v, 0U, &request, words, &reply)) {                              \
            fieldscribe_is_value(v, &reply, &(reading), value);                                  \
            fieldscribe_put_field_##kind(v, (frame).layout, "raw", value);                       \
            request = fieldscribe_uss_write(unit, &(frame).update, value, 1U);                   \
            (void)fieldscribe_exchange(v, 1U, &request, words, &reply);                          \
        }                                                                                        \
    }

/* A word of process data that is sent or received without a task. */
#define FIELDSCRIBE_SEND(frame, kind)                                                            \
    if (fieldscribe_asks(v, "write")) {                                                          \
        uint16_t words[256] = {0U};                                                              \
        fieldscribe_uss_reply reply;                                                             \
        const fieldscribe_uss_request request = fieldscribe_uss_exchange((uint8_t)fieldscribe_bits(v, "unit")); \
        fieldscribe_put_field_##kind(                                                            \
            v, (frame).layout, "raw", fieldscribe_uss_words_sent(&(frame).sent, words, 256U));   \
        (void)fieldscribe_exchange(v, 0U, &request, words, &reply);                              \
    }

/* The words of a point are in process data where its address says, whatever the link has. */
#define FIELDSCRIBE_LIES_IN(frame, way, macro)                                                   \
    if (fieldscribe_asks(v, "place")) {                                                          \
        fieldscribe_agree(v, (frame).way.position == macro##_ADDRESS);                           \
        fieldscribe_agree(v, (frame).way.words == (frame).layout->words);                        \
    }

/* The same without a telegram: one or two words at their place; the others are unchanged. */
#define FIELDSCRIBE_PUT(frame, kind, macro, count)                                               \
    FIELDSCRIBE_LIES_IN(frame, sent, macro)                                                      \
    if (fieldscribe_asks(v, "words") || fieldscribe_asks(v, "bits")) {                           \
        const bool part = fieldscribe_asks(v, "bits");                                           \
        uint16_t words[count];                                                                   \
        uint16_t *const own =                                                                    \
            fieldscribe_uss_words_sent(&(frame).sent, words, macro##_ADDRESS + (frame).layout->words); \
        fieldscribe_agree(v, fieldscribe_uss_words_sent(                                         \
            &(frame).sent, words, macro##_ADDRESS + (frame).layout->words - 1U) == NULL);        \
        fieldscribe_fill(words, sizeof words);                                                   \
        own[0] = part ? (uint16_t)fieldscribe_bits(v, "word") : 0U;                              \
        fieldscribe_put_field_##kind(v, (frame).layout, part ? "replaced" : "raw", own);         \
        if (part) {                                                                              \
            fieldscribe_is_number(v, "result", own[0]);                                          \
        } else {                                                                                 \
            fieldscribe_is_words(v, "words", own, (frame).layout->words);                                \
        }                                                                                        \
        fieldscribe_untouched(v, words, macro##_ADDRESS * sizeof words[0]);                      \
        fieldscribe_untouched(v, words + macro##_ADDRESS + (frame).layout->words,                        \
            sizeof words - (macro##_ADDRESS + (frame).layout->words) * sizeof words[0]);                 \
    }
#define FIELDSCRIBE_TAKE(frame, kind, macro, count)                                              \
    FIELDSCRIBE_LIES_IN(frame, heard, macro)                                                     \
    if (fieldscribe_asks(v, "words") || fieldscribe_asks(v, "bits")) {                           \
        uint16_t words[count];                                                                   \
        fieldscribe_fill(words, sizeof words);                                                   \
        if (fieldscribe_asks(v, "bits")) {                                                       \
            words[macro##_ADDRESS] = (uint16_t)fieldscribe_bits(v, "word");                      \
        } else {                                                                                 \
            (void)fieldscribe_numbers(v, "words", words + macro##_ADDRESS, (frame).layout->words);       \
        }                                                                                        \
        fieldscribe_agree(v, fieldscribe_uss_words_heard(                                        \
            &(frame).heard, words, macro##_ADDRESS + (frame).layout->words - 1U) == NULL);       \
        fieldscribe_taken_##kind(v, (frame).layout,                                              \
            fieldscribe_uss_words_heard(&(frame).heard, words, macro##_ADDRESS + (frame).layout->words)); \
    }

#define FIELDSCRIBE_HEAR(frame, kind)                                                            \
    if (fieldscribe_asks(v, "read")) {                                                           \
        uint16_t words[256] = {0U};                                                              \
        fieldscribe_uss_reply reply;                                                             \
        const fieldscribe_uss_request request = fieldscribe_uss_exchange((uint8_t)fieldscribe_bits(v, "unit")); \
        if (fieldscribe_exchange(v, 0U, &request, words, &reply)) {                              \
            fieldscribe_taken_##kind(                                                            \
                v, (frame).layout, fieldscribe_uss_words_heard(&(frame).heard, words, 256U));    \
        }                                                                                        \
    }

/* ---- Frames ---- */

static fieldscribe_uss_request fieldscribe_read_task(fieldscribe_vector *v)
{
    fieldscribe_uss_request request;
    request.unit = (uint8_t)fieldscribe_at_most(v, "unit", 255U);
    request.task = (uint8_t)fieldscribe_at_most(v, "task", 255U);
    request.parameter = (uint16_t)fieldscribe_at_most(v, "parameter", 65535U);
    request.index = (uint16_t)fieldscribe_at_most(v, "index", 65535U);
    request.width = 0U;
    request.value = 0U;
    return request;
}

/* The telegram of the line in `built`, with nothing after it. */
static void fieldscribe_is_telegram(
    fieldscribe_vector *v, fieldscribe_uss_status status, const uint8_t *built, size_t size, size_t length)
{
    fieldscribe_is_text(v, "status", fieldscribe_uss_status_name(status));
    fieldscribe_agree(v, length <= size);
    if (length <= size) {
        fieldscribe_is_bytes(v, "bytes", built, length);
        fieldscribe_untouched(v, built + length, size - length);
    }
}

static void fieldscribe_run_uss_build(fieldscribe_vector *v)
{
    uint16_t words[FIELDSCRIBE_BYTES_MOST] = {0U};
    uint8_t built[FIELDSCRIBE_USS_MOST];
    uint8_t exact[FIELDSCRIBE_USS_MOST];
    size_t length = SIZE_MAX;
    size_t again = SIZE_MAX;
    const fieldscribe_uss_profile *const profile = fieldscribe_tables_of(v)->profile;
    const fieldscribe_uss_link link = fieldscribe_read_link(v);
    fieldscribe_uss_request request = fieldscribe_read_task(v);
    const fieldscribe_uss_words process = {words, fieldscribe_numbers(v, "words", words, FIELDSCRIBE_BYTES_MOST)};
    fieldscribe_uss_status status;
    request.width = (uint8_t)fieldscribe_at_most(v, "width", 255U);
    request.value = fieldscribe_at_most(v, "value", UINT32_MAX);
    fieldscribe_fill(built, sizeof built);
    status = fieldscribe_uss_build(profile, &link, &request, &process, built, sizeof built, &length);
    if (status == FIELDSCRIBE_USS_OK && fieldscribe_bits(v, "value") != request.value) {
        fieldscribe_fill(built, sizeof built);
        status = FIELDSCRIBE_USS_BAD_VALUE; /* the argument's type alone refuses it */
        length = 0U;
    }
    fieldscribe_is_telegram(v, status, built, sizeof built, length);
    if (status == FIELDSCRIBE_USS_OK && length > 0U && length <= sizeof built) {
        fieldscribe_fill(exact, sizeof exact);
        status = fieldscribe_uss_build(profile, &link, &request, &process, exact, length - 1U, &again);
        fieldscribe_agree(v, status == FIELDSCRIBE_USS_BUFFER_TOO_SMALL && again == 0U);
        fieldscribe_untouched(v, exact, sizeof exact);
        status = fieldscribe_uss_build(profile, &link, &request, &process, exact, length, &again);
        fieldscribe_agree(v, status == FIELDSCRIBE_USS_OK && again == length && memcmp(built, exact, length) == 0);
    }
}

static void fieldscribe_run_uss_broadcast(fieldscribe_vector *v)
{
    uint16_t mask[4] = {0U};
    uint16_t words[FIELDSCRIBE_BYTES_MOST] = {0U};
    uint8_t built[FIELDSCRIBE_USS_MOST];
    size_t length = SIZE_MAX;
    const fieldscribe_uss_link link = fieldscribe_read_link(v);
    const size_t masks = fieldscribe_numbers(v, "mask", mask, 4U);
    const fieldscribe_uss_words process = {words, fieldscribe_numbers(v, "words", words, FIELDSCRIBE_BYTES_MOST)};
    fieldscribe_uss_status status;
    fieldscribe_fill(built, sizeof built);
    status = fieldscribe_uss_build_broadcast(
        fieldscribe_tables_of(v)->profile, &link, mask, &process, built, sizeof built, &length);
    fieldscribe_agree(v, masks == 4U);
    fieldscribe_is_telegram(v, status, built, sizeof built, length);
}

/* Process data comes with every valid telegram, also with one without a value; otherwise nothing is stored. */
static void fieldscribe_are_heard(fieldscribe_vector *v, fieldscribe_uss_status status, const uint16_t *words,
    const uint8_t *bytes, size_t length, size_t count)
{
    const bool good = status == FIELDSCRIBE_USS_OK || status >= FIELDSCRIBE_USS_WRONG_PARAMETER;
    const size_t heard = good ? count : 0U;
    size_t at;
    for (at = 0U; at < heard; ++at) {
        fieldscribe_agree(v, words[at] == fieldscribe_uss_get(bytes + length - 1U - 2U * (count - at)));
    }
    fieldscribe_untouched(v, words + heard, (FIELDSCRIBE_BYTES_MOST - heard) * sizeof words[0]);
}

/* A receiver finds the answer after noise, in pieces of any size, and takes no byte after it. */
static void fieldscribe_finds(fieldscribe_vector *v, const fieldscribe_uss_link *link,
    const fieldscribe_uss_request *request, const uint8_t *bytes, size_t length)
{
    static const size_t pieces[] = {1U, 2U, SIZE_MAX};
    uint8_t buffer[FIELDSCRIBE_BYTES_MOST];
    fieldscribe_stream stream;
    unsigned kind;
    size_t at;
    for (kind = 0U; kind < 12U && length < sizeof buffer; ++kind) {
        const size_t noise = fieldscribe_stream_noise(&stream, kind % 4U, bytes, length, length - 1U);
        const size_t piece = pieces[kind / 4U];
        fieldscribe_uss_receiver receiver = fieldscribe_uss_await(link, request, buffer, length);
        size_t taken = 0U;
        fieldscribe_fill(buffer, sizeof buffer);
        fieldscribe_stream_add(&stream, bytes, length);
        fieldscribe_stream_add(&stream, bytes, 1U);
        for (at = 0U; at < stream.count; at += taken) {
            const size_t most = stream.count - at;
            fieldscribe_agree(v, receiver.done == (at == noise + length));
            taken = fieldscribe_uss_receive(&receiver, stream.bytes + at, most < piece ? most : piece);
            if (taken == 0U) {
                break;
            }
        }
        fieldscribe_agree(v, receiver.done && at == noise + length && receiver.dropped == noise &&
            receiver.length == length && memcmp(buffer, bytes, length) == 0);
        fieldscribe_untouched(v, buffer + length, sizeof buffer - length);
        receiver = fieldscribe_uss_await(link, request, buffer, fieldscribe_uss_reply_length(link) - 1U);
        fieldscribe_agree(v, receiver.done && receiver.length == 0U);
    }
}

/* A telegram without a task exchanges process data only. */
static inline fieldscribe_uss_status fieldscribe_asks_line(fieldscribe_vector *v, const fieldscribe_uss_link *link,
    const fieldscribe_uss_request *request, fieldscribe_stream *stream, fieldscribe_uss_reply *reply)
{
    uint8_t buffer[FIELDSCRIBE_BYTES_MOST];
    static const uint16_t nothing[FIELDSCRIBE_BYTES_MOST] = {0U};
    const fieldscribe_uss_words process = {nothing, link->pzd};
    const fieldscribe_uss_line line = {fieldscribe_tables_of(v)->profile, link, buffer, sizeof buffer,
        &fieldscribe_stream_send, &fieldscribe_stream_receive, stream, FIELDSCRIBE_ANSWER_MS, FIELDSCRIBE_PAUSE_MS};
    if (request->task == 0U && reply->room >= link->pzd) {
        uint16_t heard[FIELDSCRIBE_BYTES_MOST] = {0U};
        fieldscribe_stream same = *stream;
        fieldscribe_uss_line again = line;
        fieldscribe_uss_unit unit = FIELDSCRIBE_USS_UNIT(&again, &fieldscribe_uss_ask, nothing, heard, request->unit);
        fieldscribe_uss_status status;
        again.context = &same;
        status = fieldscribe_uss_exchange_words(&unit);
        fieldscribe_agree(v, status == fieldscribe_uss_ask(&line, request, &process, reply) &&
            memcmp(heard, reply->process, status == FIELDSCRIBE_USS_OK ? link->pzd * sizeof heard[0] : 0U) == 0);
        return status;
    }
    return fieldscribe_uss_ask(&line, request, &process, reply);
}

/* Asking returns what parsing does, whatever comes before the answer, and ends if none comes. */
static void fieldscribe_is_asked(fieldscribe_vector *v, const fieldscribe_uss_link *link,
    const fieldscribe_uss_request *request, const uint8_t *bytes, size_t length, const fieldscribe_uss_reply *parsed)
{
    uint16_t words[FIELDSCRIBE_BYTES_MOST] = {0U};
    fieldscribe_uss_reply reply = fieldscribe_reply_into(words, FIELDSCRIBE_BYTES_MOST);
    fieldscribe_stream stream;
    unsigned kind;
    uint8_t built[FIELDSCRIBE_USS_MOST];
    size_t sent = 0U;
    const fieldscribe_uss_words process = {words, link->pzd};
    if (fieldscribe_uss_build(fieldscribe_tables_of(v)->profile, link, request, &process, built, sizeof built, &sent) !=
        FIELDSCRIBE_USS_OK) {
        return;
    }
    memset(&stream, 0, sizeof stream);
    fieldscribe_agree(v, fieldscribe_asks_line(v, link, request, &stream, &reply) == FIELDSCRIBE_USS_WRONG_START &&
        stream.waited == FIELDSCRIBE_ANSWER_MS);
    fieldscribe_agree(v, stream.sent_count == sent && stream.sent[0] == built[0] && stream.sent[2] == built[2]);
    for (kind = 0U; kind < 4U; ++kind) {
        (void)fieldscribe_stream_noise(&stream, kind, bytes, length, length - 1U);
        fieldscribe_stream_add(&stream, bytes, length);
        fieldscribe_agree(v, fieldscribe_asks_line(v, link, request, &stream, &reply) == FIELDSCRIBE_USS_OK &&
            reply.value == parsed->value && reply.width == parsed->width && stream.given == stream.count &&
            memcmp(words, parsed->process, link->pzd * sizeof words[0]) == 0);
        (void)fieldscribe_stream_noise(&stream, kind, bytes, length, length - 1U);
        fieldscribe_stream_add(&stream, bytes, length - 1U); /* the last byte does not come */
        fieldscribe_agree(v, kind == 2U || fieldscribe_asks_line(v, link, request, &stream, &reply) ==
            (kind == 0U ? FIELDSCRIBE_USS_WRONG_LENGTH : FIELDSCRIBE_USS_NOISE));
        fieldscribe_agree(v, kind != 0U || stream.waited == FIELDSCRIBE_PAUSE_MS);
    }
    (void)fieldscribe_stream_noise(&stream, 1U, bytes, length, 0U);
    fieldscribe_stream_add(&stream, bytes, length);
    stream.silence = 1U;
    fieldscribe_agree(v, fieldscribe_asks_line(v, link, request, &stream, &reply) == FIELDSCRIBE_USS_OK &&
        stream.patience == FIELDSCRIBE_ANSWER_MS);
    memset(&stream, 0, sizeof stream);
    reply.room = (link->pzd == 0U) ? 0U : (link->pzd - 1U);
    fieldscribe_agree(v, link->pzd == 0U ||
        (fieldscribe_asks_line(v, link, request, &stream, &reply) == FIELDSCRIBE_USS_BUFFER_TOO_SMALL &&
            stream.sent_count == 0U));
    reply.room = FIELDSCRIBE_BYTES_MOST;
    (void)fieldscribe_stream_noise(&stream, 1U, bytes, length, 0U);
    stream.endless = true;
    fieldscribe_agree(v, fieldscribe_asks_line(v, link, request, &stream, &reply) == FIELDSCRIBE_USS_NOISE &&
        stream.given == FIELDSCRIBE_USS_ASK_MOST);
}

static void fieldscribe_run_uss_reply(fieldscribe_vector *v)
{
    uint16_t words[FIELDSCRIBE_BYTES_MOST];
    uint8_t bytes[FIELDSCRIBE_BYTES_MOST];
    fieldscribe_uss_reply reply = fieldscribe_reply_into(words, FIELDSCRIBE_BYTES_MOST);
    fieldscribe_uss_reply again = reply;
    const fieldscribe_uss_profile *const profile = fieldscribe_tables_of(v)->profile;
    const fieldscribe_uss_link link = fieldscribe_read_link(v);
    const fieldscribe_uss_request request = fieldscribe_read_task(v);
    const size_t length = fieldscribe_bytes(v, "bytes", bytes, sizeof bytes);
    fieldscribe_uss_status status;
    fieldscribe_fill(words, sizeof words);
    status = fieldscribe_uss_parse(profile, &link, &request, bytes, length, &reply);
    fieldscribe_is_text(v, "status", fieldscribe_uss_status_name(status));
    fieldscribe_is_count(v, "response", reply.response);
    fieldscribe_is_count(v, "width", reply.width);
    fieldscribe_is_count(v, "value", reply.value);
    fieldscribe_is_count(v, "error", reply.error);
    fieldscribe_is_words(v, "words", words, status == FIELDSCRIBE_USS_OK ? link.pzd : 0U);
    fieldscribe_are_heard(v, status, words, bytes, length, link.pzd);
    if (status == FIELDSCRIBE_USS_OK) {
        fieldscribe_receives(v, &link, bytes, length);
        fieldscribe_finds(v, &link, &request, bytes, length);
        fieldscribe_is_asked(v, &link, &request, bytes, length, &reply);
        again.room = link.pzd;
        fieldscribe_agree(
            v, fieldscribe_uss_parse(profile, &link, &request, bytes, length, &again) == FIELDSCRIBE_USS_OK);
    }
    if (status == FIELDSCRIBE_USS_OK && link.pzd > 0U) {
        fieldscribe_fill(words, sizeof words);
        again.room = link.pzd - 1U;
        fieldscribe_agree(v, fieldscribe_uss_parse(profile, &link, &request, bytes, length, &again) ==
            FIELDSCRIBE_USS_BUFFER_TOO_SMALL);
        fieldscribe_untouched(v, words, sizeof words);
    }
}

/* What the profile says of a task. */
static void fieldscribe_run_function(fieldscribe_vector *v)
{
    const fieldscribe_uss_profile *const profile = fieldscribe_tables_of(v)->profile;
    const uint64_t index = fieldscribe_bits(v, "index");
    if (index < profile->task_count) {
        fieldscribe_is_number(v, "number", profile->tasks[index].number);
        fieldscribe_is_number(v, "answers", profile->tasks[index].answers);
    }
}

static void fieldscribe_run_limit(fieldscribe_vector *v)
{
    const fieldscribe_uss_profile *const profile = fieldscribe_tables_of(v)->profile;
    fieldscribe_holds_long_numbers(v);
    FIELDSCRIBE_NAMES_STATUS(uss, USS, "buffer_too_small", BUFFER_TOO_SMALL)
    FIELDSCRIBE_NAMES_STATUS(uss, USS, "noise", NOISE)
    FIELDSCRIBE_NAMES_STATUSES(fieldscribe_uss_status, fieldscribe_uss_status_name)
    FIELDSCRIBE_LIMIT("first_unit", profile->first_unit)
    FIELDSCRIBE_LIMIT("last_unit", profile->last_unit)
    FIELDSCRIBE_LIMIT("functions", profile->task_count)
    FIELDSCRIBE_LIMIT("broadcast", profile->broadcast)
    FIELDSCRIBE_LIMIT("no_broadcast", FIELDSCRIBE_USS_NO_BROADCAST)
    FIELDSCRIBE_LIMIT("telegram_bytes", FIELDSCRIBE_USS_MOST)
    FIELDSCRIBE_LIMIT("last_parameter", FIELDSCRIBE_USS_LAST_PARAMETER)
    FIELDSCRIBE_LIMIT("least_process_words", profile->least_pzd)
    FIELDSCRIBE_LIMIT("most_process_words", profile->most_pzd)
    FIELDSCRIBE_LIMIT("parameter_parts", profile->pkw_count)
}

static bool fieldscribe_run_frame(fieldscribe_vector *v)
{
    if (fieldscribe_asks(v, "function")) {
        fieldscribe_run_function(v);
    } else if (fieldscribe_asks(v, "limit")) {
        fieldscribe_run_limit(v);
    } else if (fieldscribe_asks(v, "uss_build")) {
        fieldscribe_run_uss_build(v);
    } else if (fieldscribe_asks(v, "uss_broadcast")) {
        fieldscribe_run_uss_broadcast(v);
    } else if (fieldscribe_asks(v, "uss_reply")) {
        fieldscribe_run_uss_reply(v);
    } else {
        return false;
    }
    return true;
}

#endif
