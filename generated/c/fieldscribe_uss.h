/*
 * USS telegrams: builds requests and parses answers in the caller's buffers. A telegram carries a parameter part (PKW:
 * one task for one parameter, or its answer) and process data (PZD: words that every telegram exchanges). No heap.
 * Parsing is safe for any bytes of any length. All state is the caller's: every function may run in an interrupt with
 * its own buffers, but only one context may use a receiver.
 * SPDX-License-Identifier: 0BSD
 *
 * Exactly one C file of a program defines FIELDSCRIBE_IMPLEMENTATION before it includes this header.
 *
 * To read a parameter over a serial line: `sent` and `heard` are words of process data; `receive` is your function. It
 * returns false when the line stays silent.
 *
 *     const fieldscribe_uss_rw *const point = &siemens_mm4_maximum_frequency_frame;
 *     uint8_t buffer[FIELDSCRIBE_USS_MOST];
 *     uint16_t words[2];
 *     const fieldscribe_uss_words process = {sent, link.pzd};
 *     fieldscribe_uss_reply reply = {heard, link.pzd, 0U, 0U, 0U, 0U};
 *     request = fieldscribe_uss_read(unit, &point->read);
 *     status = fieldscribe_uss_build(&profile, &link, &request, &process, buffer, sizeof buffer, &length);
 *     discard();      (received bytes: else a late answer is taken for this one)
 *     send(buffer, length);      (if the line echoes, as RS-485 can, drop these `length` bytes again)
 *     receiver = fieldscribe_uss_await(&link, &request, buffer, sizeof buffer);
 *     while ((!receiver.done) && receive(&byte)) {      (noise before the answer is dropped)
 *         (void)fieldscribe_uss_receive(&receiver, &byte, 1U);
 *     }
 *     fieldscribe_uss_silent(&receiver);      (there may be an answer after noise that looks like a longer one)
 *     status = fieldscribe_uss_parse(&profile, &link, &request, buffer, receiver.length, &reply);
 *     status = fieldscribe_uss_words_of_reply(&reply, &point->read, words, FIELDSCRIBE_COUNT(words));
 *     fits = fieldscribe_take_u32(point->layout, words, FIELDSCRIBE_COUNT(words), &raw);
 *
 * WRONG_START and WRONG_LENGTH then mean that no answer arrived. After any error, wait until the line is silent before
 * the next request: otherwise a late answer is taken for the next one.
 *
 * To write one: ..._encode makes the raw number and checks that it may be written; the macro of a special code is
 * already a raw number. fieldscribe_put_u32(point->layout, raw, words, count) stores it in the words without that
 * check, and fieldscribe_uss_write(unit, &point->write, words, count) makes the request and copies the words. Parse
 * its answer too: OK means that the device accepted the write.
 * A point that has only some bits of a word has `update`, not `write`: read the word, put the bits, write it back.
 *
 * A point of the received process data: in = fieldscribe_uss_words_heard(&point->heard, heard, link.pzd), then
 * fieldscribe_take_s16(point->layout, in, point->heard.words, &raw), which returns false if `in` is NULL. To send one,
 * do the same with `sent` and fieldscribe_put_s16.
 */
#include "fieldscribe.h"

#ifndef FIELDSCRIBE_USS_H
#define FIELDSCRIBE_USS_H

#ifdef __cplusplus
extern "C" {
#endif

/* The version that device headers check; it increases when they must be generated again. */
#define FIELDSCRIBE_USS_INTERFACE 4

/* The length of the longest telegram. */
#define FIELDSCRIBE_USS_MOST 256U

/* The most bytes that fieldscribe_uss_ask receives for one answer: four of the longest telegrams. */
#define FIELDSCRIBE_USS_ASK_MOST 1024U

/* The length of a variable parameter part: as long as its content needs. */
#define FIELDSCRIBE_USS_VARIABLE 127U

/* In a profile: the device takes no broadcast. */
#define FIELDSCRIBE_USS_NO_BROADCAST 0xFFFFU

/* The highest parameter number. */
#define FIELDSCRIBE_USS_LAST_PARAMETER 31999U

typedef enum fieldscribe_uss_status {
    FIELDSCRIBE_USS_OK = 0,
    /* conversion, only from ..._read_POINT, _write_ and _store_: the numbers of fieldscribe_status */
    FIELDSCRIBE_USS_OUT_OF_RANGE,
    FIELDSCRIBE_USS_NOT_A_NUMBER,
    FIELDSCRIBE_USS_UNKNOWN_VALUE,
    FIELDSCRIBE_USS_ZERO_FACTOR,
    FIELDSCRIBE_USS_NO_CASE,
    FIELDSCRIBE_USS_OVERFLOW,
    FIELDSCRIBE_USS_SPECIAL,
    FIELDSCRIBE_USS_MALFORMED,
    /* building */
    FIELDSCRIBE_USS_BAD_LINK,         /* a length of the parameter part or process data that the device does not have */
    FIELDSCRIBE_USS_BAD_UNIT,         /* not a unit of this device */
    FIELDSCRIBE_USS_BAD_TASK,         /* the device does not support the task, or the link has no parameter part */
    FIELDSCRIBE_USS_BAD_PARAMETER,    /* beyond 31999 */
    FIELDSCRIBE_USS_BAD_INDEX,        /* beyond 255 */
    FIELDSCRIBE_USS_BAD_VALUE,        /* the value does not fit its words, or too few words were given */
    FIELDSCRIBE_USS_BUFFER_TOO_SMALL, /* the caller's buffer is too small for the result */
    /* parsing */
    FIELDSCRIBE_USS_WRONG_START,
    FIELDSCRIBE_USS_WRONG_LENGTH,
    FIELDSCRIBE_USS_WRONG_CHECK,
    FIELDSCRIBE_USS_WRONG_UNIT,
    FIELDSCRIBE_USS_WRONG_PARAMETER, /* the answer is for another parameter or index */
    FIELDSCRIBE_USS_NO_ANSWER,       /* the device is still working on the task: ask again */
    FIELDSCRIBE_USS_REFUSED,         /* the device refused; the reply holds its error number */
    FIELDSCRIBE_USS_NO_RIGHTS,       /* the parameter part has no control right: the device refuses to write */
    FIELDSCRIBE_USS_WRONG_RESPONSE,  /* the response does not belong to this task */
    FIELDSCRIBE_USS_NOISE            /* only from fieldscribe_uss_ask: bytes without an answer, or too many before it */
} fieldscribe_uss_status;

/* The name of a status in lower case, for logs: "no_answer"; "unknown" for any other number. */
const char *fieldscribe_uss_status_name(fieldscribe_uss_status status);

/* The set-up of master and device: words of the parameter part (0, 3, 4 or 127) and of the process data. */
typedef struct fieldscribe_uss_link {
    uint8_t pkw;
    uint8_t pzd;
    bool single_first; /* with 4 words, a single word is in the first of the two for the value */
} fieldscribe_uss_link;

/* A task, and the responses that mean success: bit n stands for response n. */
typedef struct fieldscribe_uss_task {
    uint8_t number;
    uint16_t answers;
} fieldscribe_uss_task;

/* What a device supports. */
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

/* Reads a parameter whose value has `width` words. */
typedef struct fieldscribe_uss_reading {
    uint8_t task;
    uint16_t parameter;
    uint16_t index;
    uint8_t width;
} fieldscribe_uss_reading;

/* Writes a parameter. */
typedef struct fieldscribe_uss_writing {
    uint8_t task;
    uint16_t parameter;
    uint16_t index;
    uint8_t width;
} fieldscribe_uss_writing;

/* The position of a point in the received or sent process data, and its number of words. */
typedef struct fieldscribe_uss_heard {
    uint16_t position;
    uint8_t words;
} fieldscribe_uss_heard;

typedef struct fieldscribe_uss_sent {
    uint16_t position;
    uint8_t words;
} fieldscribe_uss_sent;

/*
 * A point by its access: `read`, `write`, or `update` if it shares its word with other points; `heard` and `sent` for
 * process data.
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

/* An invalid width: fewer words were given than the value has. */
#define FIELDSCRIBE_USS_TOO_FEW_WORDS 0xFFU

/* A request for a parameter. `width` is the number of words of the value: 0 (none), 1 or 2. */
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
 * A parsed answer: the words of the value and the value, or the error number if the device refused. The caller provides
 * `process` with `room` words for the received process data; keep the words to send in another array.
 */
typedef struct fieldscribe_uss_reply {
    uint16_t *process;
    size_t room;
    uint8_t response;
    uint8_t width;
    uint32_t value;
    uint16_t error;
} fieldscribe_uss_reply;

/* The request without a task, which only exchanges process data. */
FIELDSCRIBE_CHECKED fieldscribe_uss_request fieldscribe_uss_exchange(uint8_t unit);

/* The request that reads a parameter. */
FIELDSCRIBE_CHECKED fieldscribe_uss_request fieldscribe_uss_read(uint8_t unit, const fieldscribe_uss_reading *what);

/* The request that writes a parameter. The high word comes first; with fewer words than the value has: BAD_VALUE. */
FIELDSCRIBE_CHECKED fieldscribe_uss_request fieldscribe_uss_write(
    uint8_t unit, const fieldscribe_uss_writing *what, const uint16_t *words, size_t count);

/* Builds the telegram of a request in `buffer`; `length` is the number of bytes used, 0 after an error. */
FIELDSCRIBE_CHECKED fieldscribe_uss_status fieldscribe_uss_build(const fieldscribe_uss_profile *profile,
    const fieldscribe_uss_link *link, const fieldscribe_uss_request *request, const fieldscribe_uss_words *process,
    uint8_t *buffer, size_t size, size_t *length);

/*
 * Builds a broadcast, which nobody answers. `mask` is in the place of the parameter part: devices take only the bits
 * that are set there from the words of process data.
 */
FIELDSCRIBE_CHECKED fieldscribe_uss_status fieldscribe_uss_build_broadcast(const fieldscribe_uss_profile *profile,
    const fieldscribe_uss_link *link, const uint16_t mask[4], const fieldscribe_uss_words *process, uint8_t *buffer,
    size_t size, size_t *length);

/* The length of an answer over the link; the least length if the parameter part is variable. */
FIELDSCRIBE_CHECKED uint32_t fieldscribe_uss_reply_length(const fieldscribe_uss_link *link);

/*
 * The number of bytes to wait for when `length` bytes of the answer are in a buffer of `size`: never more than fit, and
 * 0 when the answer is complete. Once the answer states its own length, that length counts: an answer of an unexpected
 * length is received completely, and parsing refuses it. Do not wait after a broadcast: nobody answers it.
 */
FIELDSCRIBE_CHECKED uint32_t fieldscribe_uss_left(
    const fieldscribe_uss_link *link, const uint8_t *buffer, size_t size, size_t length);

/*
 * Finds the answer to one request in a stream of bytes. The first `length` bytes of the caller's `buffer` are the
 * answer so far, and the whole answer when `done`. `dropped` counts bytes that did not belong to it: noise, telegrams
 * of other units, a wrong check byte. If nothing arrived and nothing was dropped, no device answered. A telegram of an
 * unexpected length is received too if it fits the buffer; parsing reports the wrong length.
 */
typedef struct fieldscribe_uss_receiver {
    uint8_t *buffer;
    size_t size;
    size_t length;
    size_t dropped;
    size_t next; /* the length at which to look at the answer again */
    bool done;
    uint8_t unit;
} fieldscribe_uss_receiver;

/* A receiver for the answer to a request; it is done at once if `size` is too small for any answer. */
FIELDSCRIBE_CHECKED fieldscribe_uss_receiver fieldscribe_uss_await(
    const fieldscribe_uss_link *link, const fieldscribe_uss_request *request, uint8_t *buffer, size_t size);

/*
 * Passes bytes to a receiver and returns how many it took: all, except those after the end of the answer. These belong
 * to the next answer.
 */
size_t fieldscribe_uss_receive(fieldscribe_uss_receiver *receiver, const uint8_t *bytes, size_t count);

/*
 * Tells a receiver that the line is silent. The receiver then looks for a complete answer after noise that looked like
 * the start of a longer one.
 */
void fieldscribe_uss_silent(fieldscribe_uss_receiver *receiver);

/*
 * Parses the answer to `request`. Every valid telegram brings the words of process data, even if it brings no value
 * (NO_ANSWER, REFUSED, NO_RIGHTS, WRONG_PARAMETER, WRONG_RESPONSE); an invalid one leaves them unchanged. Fields of the
 * reply that the answer does not have are 0.
 */
FIELDSCRIBE_CHECKED fieldscribe_uss_status fieldscribe_uss_parse(const fieldscribe_uss_profile *profile,
    const fieldscribe_uss_link *link, const fieldscribe_uss_request *request, const uint8_t *bytes, size_t length,
    fieldscribe_uss_reply *reply);

/*
 * A line to send telegrams on. Both functions are yours and get `context`. `send` waits until the line was silent for
 * two characters, drops received bytes, and sends. `receive` waits for a byte and returns false if none comes within
 * that many milliseconds. `buffer` has room for the longest telegram.
 */
typedef struct fieldscribe_uss_line {
    const fieldscribe_uss_profile *profile;
    const fieldscribe_uss_link *link;
    uint8_t *buffer;
    size_t size;
    void (*send)(void *context, const uint8_t *bytes, size_t length);
    bool (*receive)(void *context, uint32_t milliseconds, uint8_t *byte);
    void *context;
    uint32_t answer_ms; /* the longest time until an answer starts; it starts anew after noise */
    uint32_t pause_ms;  /* the longest pause within an answer */
} fieldscribe_uss_line;

/*
 * Sends a request with words of process data and waits for its answer: build, send, receive and parse in one call.
 * WRONG_START means that nothing arrived, WRONG_LENGTH that the answer broke off, NOISE that other bytes arrived (an
 * answer with a wrong check byte, from another unit or at another baud rate), or ASK_MOST bytes without an answer.
 * BUFFER_TOO_SMALL: nothing was sent, because the reply has no room for the words of process data.
 */
FIELDSCRIBE_CHECKED fieldscribe_uss_status fieldscribe_uss_ask(const fieldscribe_uss_line *line,
    const fieldscribe_uss_request *request, const fieldscribe_uss_words *process, fieldscribe_uss_reply *reply);

/*
 * The words of the value in an answer, the high word first, if `count` is enough; WRONG_RESPONSE if the value has
 * another width.
 */
FIELDSCRIBE_CHECKED fieldscribe_uss_status fieldscribe_uss_words_of_reply(
    const fieldscribe_uss_reply *reply, const fieldscribe_uss_reading *what, uint16_t *words, size_t count);

/*
 * A unit on a line: the part of a handle, such as `siemens_mm4_device`, that ..._read_POINT, ..._write_POINT and
 * ..._store_POINT use. Each call sends one request and waits for its answer; if a point shares its word, a write reads
 * that word first. Each request sends `sent`, each answer fills `heard`: both have as many words as the link.
 */
typedef struct fieldscribe_uss_unit {
    const fieldscribe_uss_line *line;
    fieldscribe_uss_status (*ask)(const fieldscribe_uss_line *line, const fieldscribe_uss_request *request,
        const fieldscribe_uss_words *process, fieldscribe_uss_reply *reply); /* fieldscribe_uss_ask */
    const uint16_t *sent;
    uint16_t *heard;
    uint8_t number;
    uint16_t error; /* the device's error number if the last call returned REFUSED, else 0 */
} fieldscribe_uss_unit;
/* The initial value of a unit. */
#define FIELDSCRIBE_USS_UNIT(line, ask, sent, heard, number) {(line), (ask), (sent), (heard), (number), 0U}

/* Exchanges only process data. */
FIELDSCRIBE_CHECKED fieldscribe_uss_status fieldscribe_uss_exchange_words(fieldscribe_uss_unit *unit);

/* Read or write the `count` words of a parameter of a unit, the high word first. */
FIELDSCRIBE_CHECKED fieldscribe_uss_status fieldscribe_uss_read_words(
    fieldscribe_uss_unit *unit, const fieldscribe_uss_reading *what, uint16_t *words, size_t count);

FIELDSCRIBE_CHECKED fieldscribe_uss_status fieldscribe_uss_write_words(
    fieldscribe_uss_unit *unit, const fieldscribe_uss_writing *what, const uint16_t *words, size_t count);

/* Start of a function that reads or writes a point. */
#define FIELDSCRIBE_USS_CALL FIELDSCRIBE_CHECKED static inline fieldscribe_uss_status

/* Converts a status of a conversion. */
FIELDSCRIBE_USS_CALL fieldscribe_uss_converted(fieldscribe_status status)
{
    return (fieldscribe_uss_status)status;
}

/*
 * The bodies of these functions, which have a parameter `device`. `number` and `decoded` are expressions of `word` (or
 * `words`); `encoded` stores a raw number in `raw`, and `bits` (or `split`) makes the words to write from it.
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

/* The words of a point in `count` words of process data; NULL if some are missing. */
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

/* The last byte of a telegram: the exclusive or of all bytes before it. */
FIELDSCRIBE_CHECKED uint8_t fieldscribe_uss_check(const uint8_t *bytes, size_t length);

#ifdef __cplusplus
}
#endif

#endif

/* ---- Definitions ---- */

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

/* The task with this number; NULL if the device does not support it. */
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

/* True if a single word is in the second of the two words for the value. */
static bool fieldscribe_uss_single_last(const fieldscribe_uss_link *link)
{
    return (link->pkw == 4U) && !link->single_first;
}

/* True if the device supports this length of the parameter part. */
static bool fieldscribe_uss_allows_pkw(const fieldscribe_uss_profile *profile, uint8_t pkw)
{
    size_t at = 0U;
    while ((at < profile->pkw_count) && (profile->pkw[at] != pkw)) {
        ++at;
    }
    return at < profile->pkw_count;
}

/* The number of words of process data to send. */
static size_t fieldscribe_uss_count(const fieldscribe_uss_words *process)
{
    return (process->words == NULL) ? 0U : process->count;
}

/* True if the device supports the link's number of process data words, and `count` is that number. */
static bool fieldscribe_uss_allows_pzd(
    const fieldscribe_uss_profile *profile, const fieldscribe_uss_link *link, size_t count)
{
    return (count == link->pzd) && (link->pzd >= profile->least_pzd) && (link->pzd <= profile->most_pzd);
}

/* OK if the device accepts the request. */
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

/* Builds a telegram; `head` is its parameter part of `head_bytes` bytes. */
static fieldscribe_uss_status fieldscribe_uss_assemble(uint8_t address, const uint8_t *head, size_t head_bytes,
    const fieldscribe_uss_words *process, uint8_t *buffer, size_t size, size_t *length)
{
    const size_t most = (size < FIELDSCRIBE_USS_MOST) ? size : FIELDSCRIBE_USS_MOST;
    const size_t around = 4U + head_bytes; /* start, length, address and check */
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
    fieldscribe_uss_put(head + 6, (uint16_t)(value & 0xFFFFU)); /* not sent if the part has 3 words */
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

/* True if an answer over the link can have a parameter part of this many words. */
static bool fieldscribe_uss_fits(const fieldscribe_uss_link *link, size_t words)
{
    return (link->pkw == FIELDSCRIBE_USS_VARIABLE) ? (words >= 3U) : (words == link->pkw);
}

/* Parses the parameter part of an answer; it has `words` words. */
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
        return FIELDSCRIBE_USS_WRONG_LENGTH; /* no device has such a link */
    }
    head = fieldscribe_uss_get(part);
    first = fieldscribe_uss_get(part + 4);
    second = (words > 3U) ? fieldscribe_uss_get(part + 6) : 0U;
    response = (uint8_t)(head >> 12);
    is_double = (response == 2U) || (response == 5U);
    if (request->task == 0U) {
        reply->response = response; /* no task: there is no value */
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

/* An empty reply. */
static void fieldscribe_uss_clear(fieldscribe_uss_reply *reply)
{
    reply->response = 0U;
    reply->width = 0U;
    reply->value = 0U;
    reply->error = 0U;
}

/* The number of words of process data that fit into a reply. */
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
    size_t words; /* words of the parameter part */
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

/* The least length of an answer that starts with these bytes; 0 if none does, or if its check byte is wrong. */
static size_t fieldscribe_uss_begun(const fieldscribe_uss_receiver *receiver, const uint8_t *bytes, size_t length)
{
    const size_t shortest = 4U;
    size_t whole = (length > 1U) ? (2U + (size_t)bytes[1]) : shortest;
    if ((bytes[0] != 0x02U) || (whole < shortest) || (whole > receiver->size) ||
        ((length > 2U) && (bytes[2] != receiver->unit)) ||
        ((whole <= length) && (fieldscribe_uss_check(bytes, whole) != 0U))) { /* including the check byte it is 0 */
        whole = 0U;
    } else if (length < 3U) {
        whole = length + 1U; /* the next byte is needed */
    } else {
        /* its own length */
    }
    return whole;
}

/*
 * Drops bytes until the rest may be the answer, and bytes after its end. On a silent line, a complete answer counts
 * before an earlier incomplete one.
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
        bool again = true; /* after noise and silence, wait `answer_ms` once more */
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

/* Sends one request to a unit and receives the answer with its value. */
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
