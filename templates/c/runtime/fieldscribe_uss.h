/*
 * USS telegrams: builds requests and reads answers, in the caller's buffers. A telegram carries a parameter part (PKW:
 * one task for one parameter, and its answer) and process data (PZD: words that are exchanged with every telegram).
 * No heap; any bytes at any length are safe to parse. No state but the caller's: everything may be called in an
 * interrupt, with its own buffers, and a receiver from one place at a time.
 * SPDX-License-Identifier: 0BSD
 *
 * One C file of a program, and no other, says `#define FIELDSCRIBE_IMPLEMENTATION` before it includes this.
 *
 * Reading a parameter over a serial line; `sent` and `heard` are words of process data. `receive` is yours: false when
 * the line stays silent.
 *
 *     const fieldscribe_uss_rw *const point = &siemens_mm4_maximum_frequency_frame;
 *     uint8_t buffer[FIELDSCRIBE_USS_MOST];
 *     uint16_t words[2];
 *     const fieldscribe_uss_words process = {sent, link.pzd};
 *     fieldscribe_uss_reply reply = {heard, link.pzd, 0U, 0U, 0U, 0U};
 *     request = fieldscribe_uss_read(unit, &point->read);
 *     status = fieldscribe_uss_build(&profile, &link, &request, &process, buffer, sizeof buffer, &length);
 *     discard();      (what has come in: a late answer would be taken for this one)
 *     send(buffer, length);      (where you hear yourself, on RS-485, drop these `length` bytes again)
 *     receiver = fieldscribe_uss_await(&link, &request, buffer, sizeof buffer);
 *     while ((!receiver.done) && receive(&byte)) {      (noise before the answer is dropped)
 *         (void)fieldscribe_uss_receive(&receiver, &byte, 1U);
 *     }
 *     fieldscribe_uss_silent(&receiver);      (the answer may stand behind noise that looks like a longer one)
 *     status = fieldscribe_uss_parse(&profile, &link, &request, buffer, receiver.length, &reply);
 *     status = fieldscribe_uss_words_of_reply(&reply, &point->read, words, FIELDSCRIBE_COUNT(words));
 *     fits = fieldscribe_take_u32(point->layout, words, FIELDSCRIBE_COUNT(words), &raw);
 *
 * WRONG_START and WRONG_LENGTH then say that no answer came. Whatever went wrong: wait until the line is silent before
 * you ask again, or a late answer is taken for the next one.
 *
 * Writing one: ..._encode says whether the number may be written, and the macro of a special code is such a raw number
 * as it stands; fieldscribe_put_u32(point->layout, raw, words, count) puts any that fits into the words, then
 * fieldscribe_uss_write(unit, &point->write, words, count), which copies them. Its answer is parsed, too: OK says that
 * the device took it.
 * A point that only some bits of a word are has `update` for `write`: read its word first, put the bits, write it back.
 *
 * A point of the process data: in = fieldscribe_uss_words_heard(&point->heard, heard, link.pzd), then
 * fieldscribe_take_s16(point->layout, in, point->heard.words, &raw), which is false where `in` is NULL; the same with
 * `sent` and put.
 */
#include "fieldscribe.h"

#ifndef FIELDSCRIBE_USS_H
#define FIELDSCRIBE_USS_H

#ifdef __cplusplus
extern "C" {
#endif

/* What the headers of devices rely on: it grows when they have to be generated anew. */
#define FIELDSCRIBE_USS_INTERFACE 4

/* The longest telegram there is. */
#define FIELDSCRIBE_USS_MOST 256U

/* How many bytes fieldscribe_uss_ask receives at most for one answer: four of the longest telegrams. */
#define FIELDSCRIBE_USS_ASK_MOST 1024U

/* The length of a parameter part that is as long as its content needs. */
#define FIELDSCRIBE_USS_VARIABLE 127U

/* In a profile: no address byte is a broadcast. */
#define FIELDSCRIBE_USS_NO_BROADCAST 0xFFFFU

/* Parameters are numbered from 0 up to here. */
#define FIELDSCRIBE_USS_LAST_PARAMETER 31999U

typedef enum fieldscribe_uss_status {
    FIELDSCRIBE_USS_OK = 0,
    /* converting a value, of ..._read_POINT, _write_ and _store_ alone: the numbers of fieldscribe_status */
    FIELDSCRIBE_USS_OUT_OF_RANGE,
    FIELDSCRIBE_USS_NOT_A_NUMBER,
    FIELDSCRIBE_USS_UNKNOWN_VALUE,
    FIELDSCRIBE_USS_ZERO_FACTOR,
    FIELDSCRIBE_USS_NO_CASE,
    FIELDSCRIBE_USS_OVERFLOW,
    FIELDSCRIBE_USS_SPECIAL,
    FIELDSCRIBE_USS_MALFORMED,
    /* building */
    FIELDSCRIBE_USS_BAD_LINK,         /* a parameter part or a number of process data words that the device has not */
    FIELDSCRIBE_USS_BAD_UNIT,         /* not a unit of this device */
    FIELDSCRIBE_USS_BAD_TASK,         /* the device does not know the task, or the link has no parameter part for it */
    FIELDSCRIBE_USS_BAD_PARAMETER,    /* beyond 31999 */
    FIELDSCRIBE_USS_BAD_INDEX,        /* beyond 255 */
    FIELDSCRIBE_USS_BAD_VALUE,        /* the value does not fit into the words for it, or has fewer */
    FIELDSCRIBE_USS_BUFFER_TOO_SMALL, /* the caller's buffer does not hold the result */
    /* parsing */
    FIELDSCRIBE_USS_WRONG_START,
    FIELDSCRIBE_USS_WRONG_LENGTH,
    FIELDSCRIBE_USS_WRONG_CHECK,
    FIELDSCRIBE_USS_WRONG_UNIT,
    FIELDSCRIBE_USS_WRONG_PARAMETER, /* the answer is about another parameter or index */
    FIELDSCRIBE_USS_NO_ANSWER,       /* the task has not been answered yet: ask again */
    FIELDSCRIBE_USS_REFUSED,         /* the device refused; the reply holds its error */
    FIELDSCRIBE_USS_NO_RIGHTS,       /* the parameter part is not in control */
    FIELDSCRIBE_USS_WRONG_RESPONSE,  /* no response to this task */
    FIELDSCRIBE_USS_NOISE            /* of asking: bytes came, and no answer among them, or too many before it */
} fieldscribe_uss_status;

/* The name of a status in small letters, for a log: "no_answer"; "unknown" for another number. */
const char *fieldscribe_uss_status_name(fieldscribe_uss_status status);

/* How master and device are set: words of the parameter part (0, 3, 4 or 127), and of the process data. */
typedef struct fieldscribe_uss_link {
    uint8_t pkw;
    uint8_t pzd;
    bool single_first; /* with 4 words, a single word stands in the first of the two for the value */
} fieldscribe_uss_link;

/* A task, and the responses that mean success: bit n stands for response n. */
typedef struct fieldscribe_uss_task {
    uint8_t number;
    uint16_t answers;
} fieldscribe_uss_task;

/* What a device understands. */
typedef struct fieldscribe_uss_profile {
    const fieldscribe_uss_task *tasks;
    size_t task_count;
    const uint8_t *pkw;
    size_t pkw_count;
    uint8_t first_unit;
    uint8_t last_unit;
    uint16_t broadcast;
    uint8_t least_pzd;
    uint8_t most_pzd;
} fieldscribe_uss_profile;

/* What reads a parameter: its value has `width` words. */
typedef struct fieldscribe_uss_reading {
    uint8_t task;
    uint16_t parameter;
    uint16_t index;
    uint8_t width;
} fieldscribe_uss_reading;

/* What writes one. */
typedef struct fieldscribe_uss_writing {
    uint8_t task;
    uint16_t parameter;
    uint16_t index;
    uint8_t width;
} fieldscribe_uss_writing;

/* Where a point stands in the words of process data that are heard, and in those that are sent, and how many it has. */
typedef struct fieldscribe_uss_heard {
    uint16_t position;
    uint8_t words;
} fieldscribe_uss_heard;

typedef struct fieldscribe_uss_sent {
    uint16_t position;
    uint8_t words;
} fieldscribe_uss_sent;

/*
 * A point by what may be done with it: `read`, `write`, or `update` bits of a word that it shares with other points;
 * for process data `heard` and `sent`.
 */
typedef struct fieldscribe_uss_r {
    const fieldscribe_layout *layout;
    fieldscribe_uss_reading read;
} fieldscribe_uss_r;

typedef struct fieldscribe_uss_w {
    const fieldscribe_layout *layout;
    fieldscribe_uss_writing write;
} fieldscribe_uss_w;

typedef struct fieldscribe_uss_rw {
    const fieldscribe_layout *layout;
    fieldscribe_uss_reading read;
    fieldscribe_uss_writing write;
} fieldscribe_uss_rw;

typedef struct fieldscribe_uss_u {
    const fieldscribe_layout *layout;
    fieldscribe_uss_writing update;
} fieldscribe_uss_u;

typedef struct fieldscribe_uss_ru {
    const fieldscribe_layout *layout;
    fieldscribe_uss_reading read;
    fieldscribe_uss_writing update;
} fieldscribe_uss_ru;

typedef struct fieldscribe_uss_h {
    const fieldscribe_layout *layout;
    fieldscribe_uss_heard heard;
} fieldscribe_uss_h;

typedef struct fieldscribe_uss_s {
    const fieldscribe_layout *layout;
    fieldscribe_uss_sent sent;
} fieldscribe_uss_s;

typedef struct fieldscribe_uss_hs {
    const fieldscribe_layout *layout;
    fieldscribe_uss_heard heard;
    fieldscribe_uss_sent sent;
} fieldscribe_uss_hs;

/* A width that no value has: fewer words were given than were to be written. */
#define FIELDSCRIBE_USS_TOO_FEW_WORDS 0xFFU

/* What is asked of a parameter. `width` is how many words the value has: 0 for none, 1 or 2. */
typedef struct fieldscribe_uss_request {
    uint8_t unit;
    uint8_t task;
    uint16_t parameter;
    uint16_t index;
    uint8_t width;
    uint32_t value;
} fieldscribe_uss_request;

/* Words of process data to send: as many as the link has. */
typedef struct fieldscribe_uss_words {
    const uint16_t *words;
    size_t count;
} fieldscribe_uss_words;

/*
 * What an answer says: the words of the value and the value, or the error when the device refused. The caller gives
 * `process` with `room` words for process data, which is not where those are that are sent next.
 */
typedef struct fieldscribe_uss_reply {
    uint16_t *process;
    size_t room;
    uint8_t response;
    uint8_t width;
    uint32_t value;
    uint16_t error;
} fieldscribe_uss_reply;

/* A request for no parameter: only process data is exchanged. */
FIELDSCRIBE_CHECKED fieldscribe_uss_request fieldscribe_uss_exchange(uint8_t unit);

/* The request that reads a parameter. */
FIELDSCRIBE_CHECKED fieldscribe_uss_request fieldscribe_uss_read(uint8_t unit, const fieldscribe_uss_reading *what);

/* The request that writes one: of `count` words as many as its value has, the high one first; fewer are BAD_VALUE. */
FIELDSCRIBE_CHECKED fieldscribe_uss_request fieldscribe_uss_write(
    uint8_t unit, const fieldscribe_uss_writing *what, const uint16_t *words, size_t count);

/* The telegram of a request in `buffer`; `length` says how many of its `size` bytes were used, 0 on an error. */
FIELDSCRIBE_CHECKED fieldscribe_uss_status fieldscribe_uss_build(const fieldscribe_uss_profile *profile,
    const fieldscribe_uss_link *link, const fieldscribe_uss_request *request, const fieldscribe_uss_words *process,
    uint8_t *buffer, size_t size, size_t *length);

/*
 * A telegram for all units, which nobody answers. `mask` stands where the parameter part is: only the bits that are set
 * there are taken from the words of process data.
 */
FIELDSCRIBE_CHECKED fieldscribe_uss_status fieldscribe_uss_build_broadcast(const fieldscribe_uss_profile *profile,
    const fieldscribe_uss_link *link, const uint16_t mask[4], const fieldscribe_uss_words *process, uint8_t *buffer,
    size_t size, size_t *length);

/* The bytes of an answer over the link; the fewest, where the parameter part is as long as its content needs. */
FIELDSCRIBE_CHECKED uint32_t fieldscribe_uss_reply_length(const fieldscribe_uss_link *link);

/*
 * How many bytes of the answer are still to be waited for when `length` of them have come into a buffer of `size`, and
 * never more than fit; 0 when it is whole. As soon as an answer says how long it is, that counts, so that one of
 * another length than the link has is received as a whole, and refused. Nobody answers a broadcast: do not wait.
 */
FIELDSCRIBE_CHECKED uint32_t fieldscribe_uss_left(
    const fieldscribe_uss_link *link, const uint8_t *buffer, size_t size, size_t length);

/*
 * What picks the answer to one request out of bytes as they come. The answer so far is in the first `length` bytes of
 * the caller's `buffer`, all of it when it is `done`. `dropped` counts bytes that were no part of it: noise, a telegram
 * of another unit, a wrong check. If nothing came and nothing was dropped, nobody answers. A telegram of another length
 * than the link has is received, too, where it fits into the buffer; parsing says that its length is wrong.
 */
typedef struct fieldscribe_uss_receiver {
    uint8_t *buffer;
    size_t size;
    size_t length;
    size_t dropped;
    size_t next; /* so many bytes say more about the answer */
    bool done;
    uint8_t unit;
} fieldscribe_uss_receiver;

/* A receiver for the answer to a request; it is done at once where `size` bytes are too few for any. */
FIELDSCRIBE_CHECKED fieldscribe_uss_receiver fieldscribe_uss_await(
    const fieldscribe_uss_link *link, const fieldscribe_uss_request *request, uint8_t *buffer, size_t size);

/*
 * Gives a receiver bytes, one or many, and says how many of them it took: all, but for those that came behind the whole
 * answer. Those belong to the next one.
 */
size_t fieldscribe_uss_receive(fieldscribe_uss_receiver *receiver, const uint8_t *bytes, size_t count);

/*
 * Tells a receiver that the line is silent: an answer that is not done may stand behind noise that looked like the
 * beginning of a longer one.
 */
void fieldscribe_uss_silent(fieldscribe_uss_receiver *receiver);

/*
 * Reads the answer to `request`. The words of process data, as many as the link has, come with every good telegram,
 * also with one that brings no value (NO_ANSWER, REFUSED, NO_RIGHTS, WRONG_PARAMETER, WRONG_RESPONSE), and stay as they
 * were if it is not good. What an answer does not say is 0 in the reply.
 */
FIELDSCRIBE_CHECKED fieldscribe_uss_status fieldscribe_uss_parse(const fieldscribe_uss_profile *profile,
    const fieldscribe_uss_link *link, const fieldscribe_uss_request *request, const uint8_t *bytes, size_t length,
    fieldscribe_uss_reply *reply);

/*
 * A line that telegrams go over. `send` waits until the line is silent for two characters, drops what has come in and
 * sends; `receive` waits for a byte, and is false when none comes within so many milliseconds. Both are yours and get
 * `context`.
 * `buffer` has room for the longest telegram.
 */
typedef struct fieldscribe_uss_line {
    const fieldscribe_uss_profile *profile;
    const fieldscribe_uss_link *link;
    uint8_t *buffer;
    size_t size;
    void (*send)(void *context, const uint8_t *bytes, size_t length);
    bool (*receive)(void *context, uint32_t milliseconds, uint8_t *byte);
    void *context;
    uint32_t answer_ms; /* how long an answer may take to begin; it has that time once more after noise */
    uint32_t pause_ms;  /* how long a pause within an answer may be */
} fieldscribe_uss_line;

/*
 * Sends a request with words of process data and waits for its answer: building, sending, receiving and parsing in one.
 * WRONG_START says that nothing came, WRONG_LENGTH that it broke off; NOISE that other bytes came (an answer with a
 * wrong check, of another unit, at another baud rate), or ASK_MOST bytes with no answer in them. Nothing is sent where
 * the reply has no room for the words of process data (BUFFER_TOO_SMALL).
 */
FIELDSCRIBE_CHECKED fieldscribe_uss_status fieldscribe_uss_ask(const fieldscribe_uss_line *line,
    const fieldscribe_uss_request *request, const fieldscribe_uss_words *process, fieldscribe_uss_reply *reply);

/*
 * The words of the value that an answer brings, the high one first, where `count` are room enough; WRONG_RESPONSE when
 * it has another width.
 */
FIELDSCRIBE_CHECKED fieldscribe_uss_status fieldscribe_uss_words_of_reply(
    const fieldscribe_uss_reply *reply, const fieldscribe_uss_reading *what, uint16_t *words, size_t count);

/*
 * A unit on a line: the part of a handle, such as `siemens_mm4_device`, that ..._read_POINT, ..._write_POINT and
 * ..._store_POINT use. Each call sends one request and waits for its answer; a point that shares its word is read
 * before it is written. `sent` goes with each request, `heard` comes with each answer: as many words as the link has.
 */
typedef struct fieldscribe_uss_unit {
    const fieldscribe_uss_line *line;
    fieldscribe_uss_status (*ask)(const fieldscribe_uss_line *line, const fieldscribe_uss_request *request,
        const fieldscribe_uss_words *process, fieldscribe_uss_reply *reply); /* fieldscribe_uss_ask */
    const uint16_t *sent;
    uint16_t *heard;
    uint8_t number;
    uint16_t error; /* the device's error if the last call returned REFUSED, else 0 */
} fieldscribe_uss_unit;
/* A unit that has not been asked yet. */
#define FIELDSCRIBE_USS_UNIT(line, ask, sent, heard, number) {(line), (ask), (sent), (heard), (number), 0U}

/* Exchanges process data alone. */
FIELDSCRIBE_CHECKED fieldscribe_uss_status fieldscribe_uss_exchange_words(fieldscribe_uss_unit *unit);

/* The words of a parameter of a unit, the high one first: there are `count`. */
FIELDSCRIBE_CHECKED fieldscribe_uss_status fieldscribe_uss_read_words(
    fieldscribe_uss_unit *unit, const fieldscribe_uss_reading *what, uint16_t *words, size_t count);

FIELDSCRIBE_CHECKED fieldscribe_uss_status fieldscribe_uss_write_words(
    fieldscribe_uss_unit *unit, const fieldscribe_uss_writing *what, const uint16_t *words, size_t count);

/* Start of a function that reads or writes a point. */
#define FIELDSCRIBE_USS_CALL FIELDSCRIBE_CHECKED static inline fieldscribe_uss_status

/* The status of a conversion. */
FIELDSCRIBE_USS_CALL fieldscribe_uss_converted(fieldscribe_status status)
{
    return (fieldscribe_uss_status)status;
}

/*
 * Bodies of these functions, which have a `device`. `number` and `decoded` take `word` (or `words`), `encoded` stores
 * in `raw`, from which `bits` (or `split`) makes what is written.
 */

#define FIELDSCRIBE_USS_READ_WORD(frame, to, number) \
    uint16_t word = 0U; \
    const fieldscribe_uss_status status = fieldscribe_uss_read_words(&device->unit, &(frame).read, &word, 1U); \
    if (status == FIELDSCRIBE_USS_OK) { \
        *(to) = (number); \
    } \
    return status;

#define FIELDSCRIBE_USS_DECODE_WORD(frame, decoded) \
    uint16_t word = 0U; \
    const fieldscribe_uss_status status = fieldscribe_uss_read_words(&device->unit, &(frame).read, &word, 1U); \
    return (status == FIELDSCRIBE_USS_OK) ? fieldscribe_uss_converted(decoded) : status;

#define FIELDSCRIBE_USS_READ_WORDS(frame, to, number) \
    uint16_t words[2] = {0U, 0U}; \
    const fieldscribe_uss_status status = fieldscribe_uss_read_words(&device->unit, &(frame).read, words, 2U); \
    if (status == FIELDSCRIBE_USS_OK) { \
        *(to) = (number); \
    } \
    return status;

#define FIELDSCRIBE_USS_DECODE_WORDS(frame, decoded) \
    uint16_t words[2] = {0U, 0U}; \
    const fieldscribe_uss_status status = fieldscribe_uss_read_words(&device->unit, &(frame).read, words, 2U); \
    return (status == FIELDSCRIBE_USS_OK) ? fieldscribe_uss_converted(decoded) : status;

#define FIELDSCRIBE_USS_WRITE_WORD(frame, type, encoded, bits) \
    type raw = (type)0; \
    const fieldscribe_uss_status status = fieldscribe_uss_converted(encoded); \
    const uint16_t word = (bits); \
    return (status == FIELDSCRIBE_USS_OK) ? fieldscribe_uss_write_words(&device->unit, &(frame).write, &word, 1U) \
                                          : status;

#define FIELDSCRIBE_USS_WRITE_WORDS(frame, type, encoded, split) \
    type raw = (type)0; \
    uint16_t words[2]; \
    const fieldscribe_uss_status status = fieldscribe_uss_converted(encoded); \
    split; \
    return (status == FIELDSCRIBE_USS_OK) ? fieldscribe_uss_write_words(&device->unit, &(frame).write, words, 2U) \
                                          : status;

#define FIELDSCRIBE_USS_UPDATE_WORD(from, frame, type, encoded, bits) \
    type raw = (type)0; \
    uint16_t word = 0U; \
    fieldscribe_uss_status status = fieldscribe_uss_converted(encoded); \
    if (status == FIELDSCRIBE_USS_OK) { \
        status = fieldscribe_uss_read_words(&device->unit, &(from).read, &word, 1U); \
    } \
    word = (bits); \
    return (status == FIELDSCRIBE_USS_OK) ? fieldscribe_uss_write_words(&device->unit, &(frame).update, &word, 1U) \
                                          : status;

/* The words of one point among the `count` of process data; NULL when those do not hold all of them. */
FIELDSCRIBE_CHECKED static inline const uint16_t *fieldscribe_uss_words_heard(
    const fieldscribe_uss_heard *where, const uint16_t *process, size_t count)
{
    if ((process == NULL) || (where->words > count) || (where->position > (count - where->words))) {
        return NULL;
    }
    return &process[where->position];
}

FIELDSCRIBE_CHECKED static inline uint16_t *fieldscribe_uss_words_sent(
    const fieldscribe_uss_sent *where, uint16_t *process, size_t count)
{
    if ((process == NULL) || (where->words > count) || (where->position > (count - where->words))) {
        return NULL;
    }
    return &process[where->position];
}

/* The last byte of a telegram: all before it, combined by exclusive or. */
FIELDSCRIBE_CHECKED uint8_t fieldscribe_uss_check(const uint8_t *bytes, size_t length);

#ifdef __cplusplus
}
#endif

#endif

/* ---- The one definition ---- */

#if defined(FIELDSCRIBE_IMPLEMENTATION) && !defined(FIELDSCRIBE_USS_IMPLEMENTED)
#define FIELDSCRIBE_USS_IMPLEMENTED

const char *fieldscribe_uss_status_name(fieldscribe_uss_status status)
{
    static const char *const names[] = {"ok", "out_of_range", "not_a_number", "unknown_value", "zero_factor", "no_case",
        "overflow", "special", "malformed", "bad_link", "bad_unit", "bad_task", "bad_parameter", "bad_index",
        "bad_value", "buffer_too_small", "wrong_start", "wrong_length", "wrong_check", "wrong_unit", "wrong_parameter",
        "no_answer", "refused", "no_rights", "wrong_response", "noise"};
    return ((size_t)status < FIELDSCRIBE_COUNT(names)) ? names[(size_t)status] : "unknown";
}

fieldscribe_uss_request fieldscribe_uss_exchange(uint8_t unit)
{
    const fieldscribe_uss_request request = {unit, 0U, 0U, 0U, 0U, 0U};
    return request;
}

fieldscribe_uss_request fieldscribe_uss_read(uint8_t unit, const fieldscribe_uss_reading *what)
{
    const fieldscribe_uss_request request = {unit, what->task, what->parameter, what->index, 0U, 0U};
    return request;
}

fieldscribe_uss_request fieldscribe_uss_write(
    uint8_t unit, const fieldscribe_uss_writing *what, const uint16_t *words, size_t count)
{
    fieldscribe_uss_request request = {unit, what->task, what->parameter, what->index, what->width, 0U};
    size_t at;
    if ((words == NULL) || (count < what->width)) {
        request.width = FIELDSCRIBE_USS_TOO_FEW_WORDS;
        return request;
    }
    for (at = 0U; at < what->width; ++at) {
        request.value = (request.value << 16) | words[at];
    }
    return request;
}

static uint16_t fieldscribe_uss_get(const uint8_t *bytes)
{
    return (uint16_t)(((uint32_t)bytes[0] << 8) | bytes[1]);
}

static void fieldscribe_uss_put(uint8_t *bytes, uint16_t number)
{
    bytes[0] = (uint8_t)(number >> 8);
    bytes[1] = (uint8_t)(number & 0xFFU);
}

uint8_t fieldscribe_uss_check(const uint8_t *bytes, size_t length)
{
    uint8_t check = 0U;
    size_t at;
    for (at = 0U; at < length; ++at) {
        check = (uint8_t)(check ^ bytes[at]);
    }
    return check;
}

/* The task of that number; NULL when the device does not know it. */
static const fieldscribe_uss_task *fieldscribe_uss_find(const fieldscribe_uss_profile *profile, uint8_t number)
{
    size_t at;
    for (at = 0U; at < profile->task_count; ++at) {
        if (profile->tasks[at].number == number) {
            return &profile->tasks[at];
        }
    }
    return NULL;
}

/* The index word: the index, and the page of 2000 parameters in bits 15, 12, 13, 14 (its lowest bit in bit 15). */
static uint16_t fieldscribe_uss_index_word(uint16_t parameter, uint16_t index)
{
    const uint32_t page = parameter / 2000U;
    return (uint16_t)(index | ((page & 1U) << 15) | (((page >> 1) & 7U) << 12));
}

/* Whether a single word stands in the second of the two words for the value. */
static bool fieldscribe_uss_single_last(const fieldscribe_uss_link *link)
{
    return (link->pkw == 4U) && !link->single_first;
}

/* Whether the device can be set to such a parameter part. */
static bool fieldscribe_uss_allows_pkw(const fieldscribe_uss_profile *profile, uint8_t pkw)
{
    size_t at = 0U;
    while ((at < profile->pkw_count) && (profile->pkw[at] != pkw)) {
        ++at;
    }
    return at < profile->pkw_count;
}

/* How many words of process data there are to send. */
static size_t fieldscribe_uss_count(const fieldscribe_uss_words *process)
{
    return (process->words == NULL) ? 0U : process->count;
}

/* Whether the device can be set to so many words of process data, and `count` is how many there are. */
static bool fieldscribe_uss_allows_pzd(
    const fieldscribe_uss_profile *profile, const fieldscribe_uss_link *link, size_t count)
{
    return (count == link->pzd) && (link->pzd >= profile->least_pzd) && (link->pzd <= profile->most_pzd);
}

/* Whether this device takes the request. */
static fieldscribe_uss_status fieldscribe_uss_allows(const fieldscribe_uss_profile *profile,
    const fieldscribe_uss_link *link, const fieldscribe_uss_request *request, size_t pzd_count)
{
    if (!fieldscribe_uss_allows_pkw(profile, link->pkw) || !fieldscribe_uss_allows_pzd(profile, link, pzd_count)) {
        return FIELDSCRIBE_USS_BAD_LINK;
    }
    if ((request->unit < profile->first_unit) || (request->unit > profile->last_unit)) {
        return FIELDSCRIBE_USS_BAD_UNIT;
    }
    if ((fieldscribe_uss_find(profile, request->task) == NULL) || ((link->pkw == 0U) && (request->task != 0U))) {
        return FIELDSCRIBE_USS_BAD_TASK;
    }
    if (request->parameter > FIELDSCRIBE_USS_LAST_PARAMETER) {
        return FIELDSCRIBE_USS_BAD_PARAMETER;
    }
    if (request->index > 0xFFU) {
        return FIELDSCRIBE_USS_BAD_INDEX;
    }
    if ((request->width > 2U) || ((request->width == 2U) && (link->pkw == 3U)) ||
        ((request->width < 2U) && ((request->value >> (16U * request->width)) != 0U))) {
        return FIELDSCRIBE_USS_BAD_VALUE;
    }
    return FIELDSCRIBE_USS_OK;
}

/* Puts a telegram together: `head` has `head_bytes` bytes of parameter part. */
static fieldscribe_uss_status fieldscribe_uss_assemble(uint8_t address, const uint8_t *head, size_t head_bytes,
    const fieldscribe_uss_words *process, uint8_t *buffer, size_t size, size_t *length)
{
    const size_t most = (size < FIELDSCRIBE_USS_MOST) ? size : FIELDSCRIBE_USS_MOST;
    const size_t around = 4U + head_bytes; /* with start, length, address and check */
    const size_t count = fieldscribe_uss_count(process);
    size_t used;
    size_t at;
    if ((most < around) || (count > ((most - around) / 2U))) {
        return FIELDSCRIBE_USS_BUFFER_TOO_SMALL;
    }
    used = around + (2U * count);
    buffer[0] = 0x02U;
    buffer[1] = (uint8_t)((used - 2U) & 0xFFU);
    buffer[2] = address;
    for (at = 0U; at < head_bytes; ++at) {
        buffer[3U + at] = head[at];
    }
    for (at = 0U; at < count; ++at) {
        fieldscribe_uss_put(buffer + 3U + head_bytes + (2U * at), process->words[at]);
    }
    buffer[used - 1U] = fieldscribe_uss_check(buffer, used - 1U);
    *length = used;
    return FIELDSCRIBE_USS_OK;
}

fieldscribe_uss_status fieldscribe_uss_build(const fieldscribe_uss_profile *profile,
    const fieldscribe_uss_link *link, const fieldscribe_uss_request *request, const fieldscribe_uss_words *process,
    uint8_t *buffer, size_t size, size_t *length)
{
    const fieldscribe_uss_status status =
        fieldscribe_uss_allows(profile, link, request, fieldscribe_uss_count(process));
    uint32_t value = request->value;
    uint8_t head[8];
    *length = 0U;
    if (status != FIELDSCRIBE_USS_OK) {
        return status;
    }
    if ((request->width == 1U) && !fieldscribe_uss_single_last(link)) {
        value <<= 16; /* into the first of the two words */
    }
    fieldscribe_uss_put(head, (uint16_t)((((uint32_t)request->task & 0xFU) << 12) | (request->parameter % 2000U)));
    fieldscribe_uss_put(head + 2, fieldscribe_uss_index_word(request->parameter, request->index));
    fieldscribe_uss_put(head + 4, (uint16_t)(value >> 16));
    fieldscribe_uss_put(head + 6, (uint16_t)(value & 0xFFFFU)); /* left out where the part has 3 words */
    return fieldscribe_uss_assemble(request->unit, head, (link->pkw == 0U) ? 0U : ((link->pkw == 3U) ? 6U : 8U),
        process, buffer, size, length);
}

fieldscribe_uss_status fieldscribe_uss_build_broadcast(const fieldscribe_uss_profile *profile,
    const fieldscribe_uss_link *link, const uint16_t mask[4], const fieldscribe_uss_words *process, uint8_t *buffer,
    size_t size, size_t *length)
{
    uint8_t head[8];
    size_t at;
    *length = 0U;
    if ((profile->broadcast > 0xFFU) || !fieldscribe_uss_allows_pzd(profile, link, fieldscribe_uss_count(process))) {
        return FIELDSCRIBE_USS_BAD_LINK;
    }
    for (at = 0U; at < 4U; ++at) {
        fieldscribe_uss_put(head + (2U * at), mask[at]);
    }
    return fieldscribe_uss_assemble(
        (uint8_t)profile->broadcast, head, sizeof head, process, buffer, size, length);
}

/* Whether a parameter part of that many words can come over the link. */
static bool fieldscribe_uss_fits(const fieldscribe_uss_link *link, size_t words)
{
    return (link->pkw == FIELDSCRIBE_USS_VARIABLE) ? (words >= 3U) : (words == link->pkw);
}

/* Reads the parameter part of an answer, which has `words` words. */
static fieldscribe_uss_status fieldscribe_uss_take(const fieldscribe_uss_profile *profile,
    const fieldscribe_uss_link *link, const fieldscribe_uss_request *request, const uint8_t *part, size_t words,
    fieldscribe_uss_reply *reply)
{
    const fieldscribe_uss_task *const task = fieldscribe_uss_find(profile, request->task);
    uint16_t head;
    uint16_t first;
    uint16_t second;
    uint8_t response;
    bool is_double;
    if (words < 3U) {
        return FIELDSCRIBE_USS_WRONG_LENGTH; /* of no link that a device has */
    }
    head = fieldscribe_uss_get(part);
    first = fieldscribe_uss_get(part + 4);
    second = (words > 3U) ? fieldscribe_uss_get(part + 6) : 0U;
    response = (uint8_t)(head >> 12);
    is_double = (response == 2U) || (response == 5U);
    if (request->task == 0U) {
        reply->response = response; /* nothing was asked: there is no value */
        return FIELDSCRIBE_USS_OK;
    }
    if (response == 0U) {
        return FIELDSCRIBE_USS_NO_ANSWER;
    }
    if (((head & 0x0FFFU) != (request->parameter % 2000U)) ||
        (fieldscribe_uss_get(part + 2) != fieldscribe_uss_index_word(request->parameter, request->index))) {
        return FIELDSCRIBE_USS_WRONG_PARAMETER;
    }
    if (response == 7U) {
        reply->response = response;
        reply->error = first;
        return FIELDSCRIBE_USS_REFUSED;
    }
    if (response == 8U) {
        return FIELDSCRIBE_USS_NO_RIGHTS;
    }
    if ((task == NULL) || ((((uint32_t)task->answers >> response) & 1U) == 0U)) {
        return FIELDSCRIBE_USS_WRONG_RESPONSE;
    }
    if (is_double && (words < 4U)) {
        return FIELDSCRIBE_USS_WRONG_LENGTH;
    }
    reply->response = response;
    reply->width = is_double ? 2U : 1U;
    if (is_double) {
        reply->value = ((uint32_t)first << 16) | second;
    } else {
        reply->value = fieldscribe_uss_single_last(link) ? second : first;
    }
    return FIELDSCRIBE_USS_OK;
}

/* Nothing has come yet. */
static void fieldscribe_uss_clear(fieldscribe_uss_reply *reply)
{
    reply->response = 0U;
    reply->width = 0U;
    reply->value = 0U;
    reply->error = 0U;
}

/* How many words of process data there is room for in a reply. */
static size_t fieldscribe_uss_room(const fieldscribe_uss_reply *reply)
{
    return (reply->process == NULL) ? 0U : reply->room;
}

fieldscribe_uss_status fieldscribe_uss_parse(const fieldscribe_uss_profile *profile,
    const fieldscribe_uss_link *link, const fieldscribe_uss_request *request, const uint8_t *bytes, size_t length,
    fieldscribe_uss_reply *reply)
{
    fieldscribe_uss_status status = FIELDSCRIBE_USS_OK;
    size_t all; /* words of data */
    size_t words; /* of them in the parameter part */
    size_t at;
    fieldscribe_uss_clear(reply);
    if ((length == 0U) || (bytes[0] != 0x02U)) {
        return FIELDSCRIBE_USS_WRONG_START;
    }
    if ((length < 4U) || (((size_t)bytes[1] + 2U) != length) || ((length % 2U) != 0U)) {
        return FIELDSCRIBE_USS_WRONG_LENGTH;
    }
    all = (length - 4U) / 2U;
    if ((all < link->pzd) || !fieldscribe_uss_fits(link, all - link->pzd)) {
        return FIELDSCRIBE_USS_WRONG_LENGTH;
    }
    words = all - link->pzd;
    if (fieldscribe_uss_check(bytes, length - 1U) != bytes[length - 1U]) {
        return FIELDSCRIBE_USS_WRONG_CHECK;
    }
    if (bytes[2] != request->unit) {
        return FIELDSCRIBE_USS_WRONG_UNIT;
    }
    if (fieldscribe_uss_room(reply) < link->pzd) {
        return FIELDSCRIBE_USS_BUFFER_TOO_SMALL;
    }
    if (link->pkw != 0U) {
        status = fieldscribe_uss_take(profile, link, request, bytes + 3, words, reply);
    }
    if (status != FIELDSCRIBE_USS_WRONG_LENGTH) {
        size_t from = words;
        for (at = 0U; (at < link->pzd) && (from < all); ++at) {
            reply->process[at] = fieldscribe_uss_get(bytes + 3U + (2U * from));
            ++from;
        }
    }
    return status;
}

uint32_t fieldscribe_uss_reply_length(const fieldscribe_uss_link *link)
{
    const uint32_t part = (link->pkw == FIELDSCRIBE_USS_VARIABLE) ? 3U : link->pkw;
    return 4U + (2U * (part + link->pzd));
}

uint32_t fieldscribe_uss_left(
    const fieldscribe_uss_link *link, const uint8_t *buffer, size_t size, size_t length)
{
    uint32_t whole = fieldscribe_uss_reply_length(link);
    if ((length >= 2U) && (buffer[0] == 0x02U)) {
        whole = 2U + (uint32_t)buffer[1];
    }
    if (whole > size) {
        whole = (uint32_t)size;
    }
    return (length < whole) ? (whole - (uint32_t)length) : 0U;
}

fieldscribe_uss_receiver fieldscribe_uss_await(
    const fieldscribe_uss_link *link, const fieldscribe_uss_request *request, uint8_t *buffer, size_t size)
{
    fieldscribe_uss_receiver receiver;
    receiver.buffer = buffer;
    receiver.size = size;
    receiver.length = 0U;
    receiver.dropped = 0U;
    receiver.next = 1U;
    receiver.done = fieldscribe_uss_reply_length(link) > size;
    receiver.unit = request->unit;
    return receiver;
}

/* How many bytes an answer has at least that so many begin; 0 where they begin none, or where its check is wrong. */
static size_t fieldscribe_uss_begun(const fieldscribe_uss_receiver *receiver, const uint8_t *bytes, size_t length)
{
    const size_t shortest = 4U;
    size_t whole = (length > 1U) ? (2U + (size_t)bytes[1]) : shortest;
    if ((bytes[0] != 0x02U) || (whole < shortest) || (whole > receiver->size) ||
        ((length > 2U) && (bytes[2] != receiver->unit)) ||
        ((whole <= length) && (fieldscribe_uss_check(bytes, whole) != 0U))) { /* with the check it is 0 */
        whole = 0U;
    } else if (length < 3U) {
        whole = length + 1U; /* the next byte says more */
    } else {
        /* as it says */
    }
    return whole;
}

/*
 * Drops bytes until the rest may be the answer, and what came behind it when it is whole. On a silent line a whole
 * answer comes before one that was only begun.
 */
static void fieldscribe_uss_settle(fieldscribe_uss_receiver *receiver, bool silent)
{
    const size_t length = receiver->length;
    size_t whole = 1U;
    size_t begin = length;
    size_t from;
    size_t to = 0U;
    bool settled = false;
    for (from = 0U; (from < length) && (!settled); ++from) {
        const size_t least = fieldscribe_uss_begun(receiver, &receiver->buffer[from], length - from);
        settled = (least != 0U) && ((!silent) || (least <= (length - from)));
        if (settled || ((least != 0U) && (begin == length))) {
            begin = from;
            whole = least;
        }
    }
    receiver->next = whole;
    receiver->done = whole <= (length - begin);
    receiver->length = receiver->done ? whole : (length - begin);
    receiver->dropped += length - receiver->length;
    for (; (to < begin) && (begin < length); ++begin) {
        receiver->buffer[to] = receiver->buffer[begin];
        ++to;
    }
}

size_t fieldscribe_uss_receive(fieldscribe_uss_receiver *receiver, const uint8_t *bytes, size_t count)
{
    size_t taken = 0U;
    while ((taken < count) && (receiver->length < receiver->size) && (!receiver->done)) {
        receiver->buffer[receiver->length] = bytes[taken];
        ++receiver->length;
        ++taken;
        if (receiver->length >= receiver->next) {
            fieldscribe_uss_settle(receiver, false);
        }
    }
    return taken;
}

void fieldscribe_uss_silent(fieldscribe_uss_receiver *receiver)
{
    if (!receiver->done) {
        fieldscribe_uss_settle(receiver, true);
    }
}

fieldscribe_uss_status fieldscribe_uss_ask(const fieldscribe_uss_line *line,
    const fieldscribe_uss_request *request, const fieldscribe_uss_words *process, fieldscribe_uss_reply *reply)
{
    size_t length;
    fieldscribe_uss_status status =
        fieldscribe_uss_build(line->profile, line->link, request, process, line->buffer, line->size, &length);
    fieldscribe_uss_clear(reply);
    if ((status == FIELDSCRIBE_USS_OK) && (fieldscribe_uss_room(reply) < line->link->pzd)) {
        status = FIELDSCRIBE_USS_BUFFER_TOO_SMALL;
    }
    if (status == FIELDSCRIBE_USS_OK) {
        fieldscribe_uss_receiver receiver = fieldscribe_uss_await(line->link, request, line->buffer, line->size);
        uint8_t byte = 0U;
        uint16_t left = FIELDSCRIBE_USS_ASK_MOST;
        uint32_t wait = line->answer_ms;
        bool again = true; /* after noise that is followed by silence, an answer has its time once more */
        line->send(line->context, line->buffer, length);
        while ((!receiver.done) && (left > 0U)) {
            if (line->receive(line->context, wait, &byte)) {
                (void)fieldscribe_uss_receive(&receiver, &byte, 1U);
                wait = line->pause_ms;
                --left;
            } else if (again && (receiver.length == 0U) && (receiver.dropped > 0U)) {
                again = false;
                wait = line->answer_ms;
            } else {
                break;
            }
        }
        fieldscribe_uss_silent(&receiver);
        status = ((!receiver.done) && (receiver.dropped > 0U))
            ? FIELDSCRIBE_USS_NOISE
            : fieldscribe_uss_parse(line->profile, line->link, request, line->buffer, receiver.length, reply);
    }
    return status;
}

fieldscribe_uss_status fieldscribe_uss_words_of_reply(
    const fieldscribe_uss_reply *reply, const fieldscribe_uss_reading *what, uint16_t *words, size_t count)
{
    uint32_t left = reply->value;
    uint8_t at;
    if (reply->width != what->width) {
        return FIELDSCRIBE_USS_WRONG_RESPONSE;
    }
    if ((words == NULL) || (count < reply->width)) {
        return FIELDSCRIBE_USS_BUFFER_TOO_SMALL;
    }
    for (at = reply->width; at > 0U; --at) {
        words[at - 1U] = (uint16_t)(left & 0xFFFFU);
        left >>= 16;
    }
    return FIELDSCRIBE_USS_OK;
}

/* Exchanges one request of a unit, which brings the value of its reply. */
static fieldscribe_uss_status fieldscribe_uss_call(
    fieldscribe_uss_unit *unit, const fieldscribe_uss_request *request, fieldscribe_uss_reply *reply)
{
    const size_t count = unit->line->link->pzd;
    const fieldscribe_uss_words process = {unit->sent, count};
    fieldscribe_uss_status status;
    reply->process = unit->heard;
    reply->room = count;
    fieldscribe_uss_clear(reply);
    status = unit->ask(unit->line, request, &process, reply);
    unit->error = reply->error;
    return status;
}

fieldscribe_uss_status fieldscribe_uss_exchange_words(fieldscribe_uss_unit *unit)
{
    const fieldscribe_uss_request request = fieldscribe_uss_exchange(unit->number);
    fieldscribe_uss_reply reply;
    return fieldscribe_uss_call(unit, &request, &reply);
}

fieldscribe_uss_status fieldscribe_uss_read_words(
    fieldscribe_uss_unit *unit, const fieldscribe_uss_reading *what, uint16_t *words, size_t count)
{
    const fieldscribe_uss_request request = fieldscribe_uss_read(unit->number, what);
    fieldscribe_uss_reply reply;
    const fieldscribe_uss_status status = fieldscribe_uss_call(unit, &request, &reply);
    return (status == FIELDSCRIBE_USS_OK) ? fieldscribe_uss_words_of_reply(&reply, what, words, count) : status;
}

fieldscribe_uss_status fieldscribe_uss_write_words(
    fieldscribe_uss_unit *unit, const fieldscribe_uss_writing *what, const uint16_t *words, size_t count)
{
    const fieldscribe_uss_request request = fieldscribe_uss_write(unit->number, what, words, count);
    fieldscribe_uss_reply reply;
    return fieldscribe_uss_call(unit, &request, &reply);
}

#endif
