/*
 * Modbus frames over a serial line (RTU) or TCP: builds requests and parses answers in the caller's buffers.
 * Functions 01h 02h 03h 04h 05h 06h 08h 0Fh 10h. No heap. Parsing is safe for any bytes of any length. All state is
 * the caller's: every function may run in an interrupt with its own buffers, but only one context may use a receiver.
 * SPDX-License-Identifier: 0BSD
 *
 * Exactly one C file of a program defines FIELDSCRIBE_IMPLEMENTATION before it includes this header.
 */
#include "fieldscribe.h"
#include "fieldscribe_modbus_facts.h"

#ifndef FIELDSCRIBE_MODBUS_H
#define FIELDSCRIBE_MODBUS_H

#ifdef __cplusplus
extern "C" {
#endif

/* The lengths of the longest frames. */
#define FIELDSCRIBE_MODBUS_RTU_MOST 256U
#define FIELDSCRIBE_MODBUS_TCP_MOST 260U

/* The most bytes that ask_rtu and ask_tcp receive for one answer: four of the longest frames. */
#define FIELDSCRIBE_MODBUS_ASK_MOST 1040U

typedef enum fieldscribe_modbus_status {
    FIELDSCRIBE_MODBUS_OK = 0,
    /* conversion, only from ..._read_POINT and ..._write_POINT: the numbers of fieldscribe_status */
    FIELDSCRIBE_MODBUS_OUT_OF_RANGE,
    FIELDSCRIBE_MODBUS_NOT_A_NUMBER,
    FIELDSCRIBE_MODBUS_UNKNOWN_VALUE,
    FIELDSCRIBE_MODBUS_ZERO_FACTOR,
    FIELDSCRIBE_MODBUS_NO_CASE,
    FIELDSCRIBE_MODBUS_OVERFLOW,
    FIELDSCRIBE_MODBUS_SPECIAL,
    FIELDSCRIBE_MODBUS_MALFORMED,
    /* building */
    FIELDSCRIBE_MODBUS_BAD_UNIT,         /* not a unit of this device, or a function that cannot be broadcast */
    FIELDSCRIBE_MODBUS_BAD_FUNCTION,     /* the device does not support the function */
    FIELDSCRIBE_MODBUS_BAD_COUNT,        /* no items, too many, or too few values */
    FIELDSCRIBE_MODBUS_BAD_ADDRESS,      /* the last item is after FFFFh, or 08h has a sub-function other than 0 */
    FIELDSCRIBE_MODBUS_BAD_VALUE,        /* a coil that is neither 0 nor 1 */
    FIELDSCRIBE_MODBUS_BAD_FRAMING,      /* the device supports only the other framing */
    FIELDSCRIBE_MODBUS_BUFFER_TOO_SMALL, /* the caller's buffer is too small for the result */
    /* parsing */
    FIELDSCRIBE_MODBUS_SHORT_FRAME,
    FIELDSCRIBE_MODBUS_LONG_FRAME,
    FIELDSCRIBE_MODBUS_BAD_CRC,
    FIELDSCRIBE_MODBUS_BAD_PROTOCOL,
    FIELDSCRIBE_MODBUS_WRONG_TRANSACTION,
    FIELDSCRIBE_MODBUS_WRONG_UNIT,
    FIELDSCRIBE_MODBUS_WRONG_FUNCTION,
    FIELDSCRIBE_MODBUS_EXCEPTION,      /* the device refused; the reply holds its code */
    FIELDSCRIBE_MODBUS_BAD_BYTE_COUNT, /* the answer to a read has more or fewer items than requested */
    FIELDSCRIBE_MODBUS_ECHO_MISMATCH,  /* the answer to a write does not repeat the request */
    FIELDSCRIBE_MODBUS_NOISE           /* only from ask_*: bytes without an answer, or too many before it */
} fieldscribe_modbus_status;

/* The name of a status in lower case, for logs: "bad_crc"; "unknown" for any other number. */
const char *fieldscribe_modbus_status_name(fieldscribe_modbus_status status);

typedef enum fieldscribe_modbus_framing {
    FIELDSCRIBE_MODBUS_RTU,
    FIELDSCRIBE_MODBUS_TCP
} fieldscribe_modbus_framing;

/*
 * A parsed answer. The caller provides `values` with `room` items; `count` of them are filled in: words, or coils as 0
 * and 1; for 05h, 06h and 08h the echoed value, if there is room. `exception` is the device's exception code, or 0.
 */
typedef struct fieldscribe_modbus_reply {
    uint16_t *values;
    size_t room;
    uint16_t count;
    uint8_t exception;
} fieldscribe_modbus_reply;

/* A request, as made by fieldscribe_modbus_read, _write and _send. For 08h, `address` is the sub-function (0). */
typedef struct fieldscribe_modbus_request {
    uint8_t unit;
    uint8_t function;
    uint16_t address;
    uint16_t count;
    bool late; /* the answer to an earlier request may still arrive: ask_rtu waits for silence first */
#if defined(FIELDSCRIBE_MODBUS_OVER_TCP)
    uint16_t transaction; /* TCP only: the answer repeats it */
#endif
#if defined(FIELDSCRIBE_MODBUS_WRITES)
    uint16_t number;        /* the field after the address: the count, or the value of 05h, 06h and 08h */
    const uint16_t *values; /* those of 0Fh and 10h */
    const struct fieldscribe_modbus_writer *writer; /* NULL for a read: a program that only reads links no writer */
#endif
} fieldscribe_modbus_request;

/* The request that reads a point or a block. */
FIELDSCRIBE_CHECKED static inline fieldscribe_modbus_request fieldscribe_modbus_read(
    uint8_t unit, const fieldscribe_modbus_reading *what)
{
    const fieldscribe_modbus_request request = {unit, what->function, what->address, what->count, false,
#if defined(FIELDSCRIBE_MODBUS_OVER_TCP)
        0U,
#endif
#if defined(FIELDSCRIBE_MODBUS_WRITES)
        what->count, NULL, NULL,
#endif
    };
    return request;
}

/*
 * The request that writes a point. `given` is the number of values (words or coils); with too few, building returns
 * BAD_COUNT. A single value (05h, 06h, 08h) is copied. Several values stay in the caller's array, which must not change
 * until the frame is built.
 */
FIELDSCRIBE_CHECKED fieldscribe_modbus_request fieldscribe_modbus_write(
    uint8_t unit, const fieldscribe_modbus_writing *what, const uint16_t *values, size_t given);

/* The request of a command. */
FIELDSCRIBE_CHECKED static inline fieldscribe_modbus_request fieldscribe_modbus_send(
    uint8_t unit, const fieldscribe_modbus_command *command)
{
    return fieldscribe_modbus_write(unit, &command->write, &command->value, 1U);
}

/* The length of a normal answer to a request, in bytes; 0 for a broadcast, which gets no answer. */
FIELDSCRIBE_CHECKED uint32_t fieldscribe_modbus_reply_length(const fieldscribe_modbus_profile *profile,
    fieldscribe_modbus_framing framing, const fieldscribe_modbus_request *request);

/*
 * The number of bytes to wait for when `length` bytes of the answer are in a buffer of `size`: never more than fit, and
 * 0 when the answer is complete or the request is a broadcast. Once the answer states its own length, that length
 * counts: an answer of an unexpected length is received completely, and parsing refuses it.
 */
FIELDSCRIBE_CHECKED uint32_t fieldscribe_modbus_left(const fieldscribe_modbus_profile *profile,
    fieldscribe_modbus_framing framing, const fieldscribe_modbus_request *request, const uint8_t *buffer, size_t size,
    size_t length);

/* Finds the answer to one request in a stream of bytes. */
typedef struct fieldscribe_modbus_receiver {
    uint8_t *buffer; /* the caller's */
    size_t size;
    size_t length;  /* bytes of the answer so far; the whole answer when `done` */
    size_t dropped; /* bytes that did not belong to the answer */
    size_t next;    /* the length at which to look at the answer again */
    uint8_t unit;
    uint8_t function;
    bool done;
#if defined(FIELDSCRIBE_MODBUS_OVER_TCP)
    uint16_t transaction;
    size_t (*begun)(const struct fieldscribe_modbus_receiver *receiver, const uint8_t *bytes, size_t length);
#endif
} fieldscribe_modbus_receiver;

/*
 * A receiver for the answer to a request; the request is not needed afterwards. The receiver is done at once for a
 * broadcast, and where `size` is too small for the answer: parsing then returns SHORT_FRAME. It drops noise, answers to
 * other requests, and frames with a wrong checksum. The last few bytes are judged when more arrive, or when
 * fieldscribe_modbus_silent is called. If nothing arrived and nothing was dropped, no device answered. An answer of an
 * unexpected length is received too if it fits the buffer; parsing reports the mistake.
 */

FIELDSCRIBE_CHECKED fieldscribe_modbus_receiver fieldscribe_modbus_await_rtu(const fieldscribe_modbus_profile *profile,
    const fieldscribe_modbus_request *request, uint8_t *buffer, size_t size);

FIELDSCRIBE_CHECKED fieldscribe_modbus_receiver fieldscribe_modbus_await_tcp(const fieldscribe_modbus_profile *profile,
    const fieldscribe_modbus_request *request, uint8_t *buffer, size_t size);

/*
 * Passes bytes to a receiver and returns how many it took: all, except those after the end of the answer. These belong
 * to the next answer.
 */
size_t fieldscribe_modbus_receive(fieldscribe_modbus_receiver *receiver, const uint8_t *bytes, size_t count);

/*
 * Tells a receiver that the line is silent. The receiver then looks for a complete answer after noise that looked like
 * the start of a longer one.
 */
void fieldscribe_modbus_silent(fieldscribe_modbus_receiver *receiver);

/* Builds the frame of a request in `buffer`; `length` is the number of bytes used, 0 after an error. */
FIELDSCRIBE_CHECKED fieldscribe_modbus_status fieldscribe_modbus_build_rtu(const fieldscribe_modbus_profile *profile,
    const fieldscribe_modbus_request *request, uint8_t *buffer, size_t size, size_t *length);

/* Builds the frame for TCP. */
FIELDSCRIBE_CHECKED fieldscribe_modbus_status fieldscribe_modbus_build_tcp(const fieldscribe_modbus_profile *profile,
    const fieldscribe_modbus_request *request, uint8_t *buffer, size_t size, size_t *length);

/* Parses the answer to a request. */

FIELDSCRIBE_CHECKED fieldscribe_modbus_status fieldscribe_modbus_parse_rtu(
    const fieldscribe_modbus_request *request, const uint8_t *bytes, size_t length, fieldscribe_modbus_reply *reply);

FIELDSCRIBE_CHECKED fieldscribe_modbus_status fieldscribe_modbus_parse_tcp(
    const fieldscribe_modbus_request *request, const uint8_t *bytes, size_t length, fieldscribe_modbus_reply *reply);

/*
 * The same for the PDU alone (function and data, without unit, header and checksum), for a Modbus stack that adds and
 * removes the rest. To build a PDU, `buffer` needs room for one more byte.
 */
FIELDSCRIBE_CHECKED fieldscribe_modbus_status fieldscribe_modbus_build_pdu(const fieldscribe_modbus_profile *profile,
    const fieldscribe_modbus_request *request, uint8_t *buffer, size_t size, size_t *length);

FIELDSCRIBE_CHECKED fieldscribe_modbus_status fieldscribe_modbus_parse_pdu(
    const fieldscribe_modbus_request *request, const uint8_t *pdu, size_t length, fieldscribe_modbus_reply *reply);

/*
 * The same for a framing given as an argument; a constant framing links only its own functions.
 *
 * To read a point over a serial line: `words` has the size of the point, `buffer` room for the longest answer, and
 * `receive` is your function: it returns false when the line stays silent.
 *
 *     const fieldscribe_modbus_rw *const point = &hitachi_l200_base_frequency_frame;
 *     uint8_t buffer[FIELDSCRIBE_MODBUS_RTU_MOST];
 *     uint16_t words[1];
 *     fieldscribe_modbus_reply reply = {words, FIELDSCRIBE_COUNT(words), 0U, 0U};
 *     request = fieldscribe_modbus_read(unit, &point->read);
 *     status = fieldscribe_modbus_build(&profile, FIELDSCRIBE_MODBUS_RTU, &request, buffer, sizeof buffer, &length);
 *     discard();      (after 3.5 characters of silence (RTU); else a late answer is taken for this one)
 *     send(buffer, length);      (if the line echoes, as RS-485 can, drop these `length` bytes again)
 *     receiver = fieldscribe_modbus_await(&profile, FIELDSCRIBE_MODBUS_RTU, &request, buffer, sizeof buffer);
 *     while ((!receiver.done) && receive(&byte)) {      (noise before the answer is dropped)
 *         (void)fieldscribe_modbus_receive(&receiver, &byte, 1U);
 *     }
 *     fieldscribe_modbus_silent(&receiver);      (there may be an answer after noise that looks like a longer one)
 *     status = fieldscribe_modbus_parse(FIELDSCRIBE_MODBUS_RTU, &request, buffer, receiver.length, &reply);
 *     fits = fieldscribe_take_u16(point->layout, words, reply.count, &raw);
 *
 * SHORT_FRAME means that no answer arrived. After any error, wait until the line is silent before the next request:
 * otherwise a late answer is taken for the next one. Where there is no noise (TCP), you can wait for several bytes at
 * once: fieldscribe_modbus_left returns how many.
 *
 * To read a block (..._BLOCK_MOST words hold any block of the device), do the same. Then for each of its points:
 * in = fieldscribe_modbus_words_in(&request, &reply, &point->read), and
 * fieldscribe_take_u16(point->layout, in, point->read.count, &raw), which returns false if `in` is NULL.
 *
 * To write a point: ..._encode makes the raw number and checks that it may be written; the macro of a special code
 * (..._INACTIVE) is a raw number already. fieldscribe_put_u16(point->layout, raw, words, count) stores it in the words
 * without that check, and fieldscribe_modbus_write(unit, &point->write, words, count) makes the request. Parse its
 * answer too: OK means that the device accepted the write; the reply may be {NULL, 0U, 0U, 0U}. A broadcast gets no
 * answer, so skip receiving and parsing.
 * A point that has only some bits of a word has `update`, not `write`: read the word, put the bits, write it back.
 */
FIELDSCRIBE_CHECKED static inline fieldscribe_modbus_status fieldscribe_modbus_build(
    const fieldscribe_modbus_profile *profile, fieldscribe_modbus_framing framing,
    const fieldscribe_modbus_request *request, uint8_t *buffer, size_t size, size_t *length)
{
    return (framing == FIELDSCRIBE_MODBUS_TCP) ? fieldscribe_modbus_build_tcp(profile, request, buffer, size, length)
                                               : fieldscribe_modbus_build_rtu(profile, request, buffer, size, length);
}

FIELDSCRIBE_CHECKED static inline fieldscribe_modbus_status fieldscribe_modbus_parse(
    fieldscribe_modbus_framing framing, const fieldscribe_modbus_request *request, const uint8_t *bytes, size_t length,
    fieldscribe_modbus_reply *reply)
{
    return (framing == FIELDSCRIBE_MODBUS_TCP) ? fieldscribe_modbus_parse_tcp(request, bytes, length, reply)
                                               : fieldscribe_modbus_parse_rtu(request, bytes, length, reply);
}

FIELDSCRIBE_CHECKED static inline fieldscribe_modbus_receiver fieldscribe_modbus_await(
    const fieldscribe_modbus_profile *profile, fieldscribe_modbus_framing framing,
    const fieldscribe_modbus_request *request, uint8_t *buffer, size_t size)
{
    return (framing == FIELDSCRIBE_MODBUS_TCP) ? fieldscribe_modbus_await_tcp(profile, request, buffer, size)
                                               : fieldscribe_modbus_await_rtu(profile, request, buffer, size);
}

/*
 * A line to send requests on. Both functions are yours and get `context`. `send` waits until the line is silent (over
 * RTU for 3.5 characters, or the device ignores the request), drops received bytes, and sends. `receive` waits for a
 * byte and returns false if none comes within that many milliseconds. `buffer` has room for the longest request and
 * answer.
 */
typedef struct fieldscribe_modbus_line {
    const fieldscribe_modbus_profile *profile;
    uint8_t *buffer;
    size_t size;
    void (*send)(void *context, const uint8_t *bytes, size_t length);
    bool (*receive)(void *context, uint32_t milliseconds, uint8_t *byte);
    void *context;
    uint32_t answer_ms; /* the longest time until an answer starts; it starts anew after noise */
    uint32_t pause_ms;  /* the longest pause within an answer */
} fieldscribe_modbus_line;

/*
 * Sends a request and waits for its answer: build, send, receive and parse in one call. SHORT_FRAME means that nothing,
 * or only the start of an answer, arrived; NOISE that other bytes arrived (an answer with a wrong checksum, from
 * another unit or at another baud rate), or ASK_MOST bytes without an answer. BUFFER_TOO_SMALL: nothing was sent,
 * because `buffer` or the reply is too small for the answer. A broadcast returns OK when it is sent. After SHORT_FRAME
 * or NOISE, set `late` in the next request to that unit, even if it is the same request: it is sent after `answer_ms`
 * of silence, or after ASK_MOST bytes. fieldscribe_modbus_read_words and similar functions do this themselves.
 */
FIELDSCRIBE_CHECKED fieldscribe_modbus_status fieldscribe_modbus_ask_rtu(const fieldscribe_modbus_line *line,
    const fieldscribe_modbus_request *request, fieldscribe_modbus_reply *reply);

/* The same over TCP: instead of `late`, give each request a new `transaction`, so that late answers are recognized. */
FIELDSCRIBE_CHECKED fieldscribe_modbus_status fieldscribe_modbus_ask_tcp(const fieldscribe_modbus_line *line,
    const fieldscribe_modbus_request *request, fieldscribe_modbus_reply *reply);

/*
 * A unit on a line: the part of a handle, such as `hitachi_l200_device`, that ..._read_POINT and ..._write_POINT use.
 * Each call sends one request and waits for its answer; if a point shares its word, a write reads that word first.
 */
typedef struct fieldscribe_modbus_unit {
    const fieldscribe_modbus_line *line;
    fieldscribe_modbus_status (*ask)(const fieldscribe_modbus_line *line, const fieldscribe_modbus_request *request,
        fieldscribe_modbus_reply *reply); /* fieldscribe_modbus_ask_rtu or _tcp */
    uint8_t number;
    uint8_t exception;    /* the device's exception code if the last call returned EXCEPTION, else 0 */
    bool late;            /* for the next request: the answer to the last one may still arrive */
#if defined(FIELDSCRIBE_MODBUS_OVER_TCP)
    uint16_t transaction; /* for the next request */
#endif
} fieldscribe_modbus_unit;
/* The initial value of a unit. */
#if defined(FIELDSCRIBE_MODBUS_OVER_TCP)
#define FIELDSCRIBE_MODBUS_UNIT(line, ask, number) {(line), (ask), (number), 0U, false, 0U}
#else
#define FIELDSCRIBE_MODBUS_UNIT(line, ask, number) {(line), (ask), (number), 0U, false}
#endif

/* Read or write one word (or coil) of a unit. */
FIELDSCRIBE_CHECKED fieldscribe_modbus_status fieldscribe_modbus_read_word(
    fieldscribe_modbus_unit *unit, uint8_t function, uint16_t address, uint16_t *word);

FIELDSCRIBE_CHECKED fieldscribe_modbus_status fieldscribe_modbus_write_word(
    fieldscribe_modbus_unit *unit, uint8_t function, uint16_t address, uint16_t word);

/* Read or write `count` words (or coils): of a point, a block or a part of a long text. */
FIELDSCRIBE_CHECKED fieldscribe_modbus_status fieldscribe_modbus_read_words(
    fieldscribe_modbus_unit *unit, const fieldscribe_modbus_reading *what, uint16_t *words, size_t count);

FIELDSCRIBE_CHECKED fieldscribe_modbus_status fieldscribe_modbus_write_words(
    fieldscribe_modbus_unit *unit, const fieldscribe_modbus_writing *what, const uint16_t *words, size_t count);

/*
 * The selection that the device has now. It is forgotten when a call fails, and when a request is sent by another
 * function: `next` is then no longer the number of the next request of the unit.
 */
typedef struct fieldscribe_modbus_selected {
    const fieldscribe_modbus_selection *rows;
    uint16_t next;
} fieldscribe_modbus_selected;
#define FIELDSCRIBE_MODBUS_NOTHING_SELECTED {NULL, 0U}

/* Writes the rows of a selection that the device does not have yet; none if `rows` is NULL. */
FIELDSCRIBE_CHECKED fieldscribe_modbus_status fieldscribe_modbus_select(
    fieldscribe_modbus_unit *unit, fieldscribe_modbus_selected *selected, const fieldscribe_modbus_selection *rows);

/* Writes the selection of a point, then reads its words. */
FIELDSCRIBE_CHECKED fieldscribe_modbus_status fieldscribe_modbus_read_selected(fieldscribe_modbus_unit *unit,
    fieldscribe_modbus_selected *selected, const fieldscribe_modbus_selection *rows,
    const fieldscribe_modbus_reading *what, uint16_t *words);

/* Writes the selection, then the words. A write without a selection forgets the current one: it may change the page. */
FIELDSCRIBE_CHECKED fieldscribe_modbus_status fieldscribe_modbus_write_selected(fieldscribe_modbus_unit *unit,
    fieldscribe_modbus_selected *selected, const fieldscribe_modbus_selection *rows,
    const fieldscribe_modbus_writing *what, const uint16_t *words);

/*
 * Reads the number of a row. BAD_FUNCTION: nothing was sent, because the row belongs to another device than the unit,
 * or cannot be read (or written). OUT_OF_RANGE: the number may not be written.
 */
FIELDSCRIBE_CHECKED fieldscribe_modbus_status fieldscribe_modbus_read_row(
    fieldscribe_modbus_unit *unit, const fieldscribe_modbus_row *row, int64_t *number);

/* Writes the number of a row; a point that shares its word is read first. */
FIELDSCRIBE_CHECKED fieldscribe_modbus_status fieldscribe_modbus_write_row(
    fieldscribe_modbus_unit *unit, const fieldscribe_modbus_row *row, int64_t number);

/* The same for a row whose address counts from a base. BAD_COUNT: nothing was sent, because it is outside the base. */
FIELDSCRIBE_CHECKED fieldscribe_modbus_status fieldscribe_modbus_read_row_at(fieldscribe_modbus_unit *unit,
    const fieldscribe_modbus_based_row *row, fieldscribe_modbus_base base, int64_t *number);

FIELDSCRIBE_CHECKED fieldscribe_modbus_status fieldscribe_modbus_write_row_at(fieldscribe_modbus_unit *unit,
    const fieldscribe_modbus_based_row *row, fieldscribe_modbus_base base, int64_t number);

/* Start of a function that reads or writes a point. */
#define FIELDSCRIBE_MODBUS_CALL FIELDSCRIBE_CHECKED static inline fieldscribe_modbus_status

/* Convert a status of a conversion. */
FIELDSCRIBE_MODBUS_CALL fieldscribe_modbus_converted(fieldscribe_status status)
{
    return (fieldscribe_modbus_status)status;
}

/*
 * The bodies of these functions, which have a parameter `device`. `number` and `decoded` are expressions of `word` (or
 * `words`); `encoded` stores a raw number in `raw`, and `bits` (or `split`) makes the words to write from it.
 */

#define FIELDSCRIBE_MODBUS_READ_WORD(function, address, to, number) \
    uint16_t word = 0U; \
    const fieldscribe_modbus_status status = fieldscribe_modbus_read_word(&device->unit, function, address, &word); \
    if (status == FIELDSCRIBE_MODBUS_OK) { \
        *(to) = (number); \
    } \
    return status;

#define FIELDSCRIBE_MODBUS_DECODE_WORD(function, address, decoded) \
    uint16_t word = 0U; \
    const fieldscribe_modbus_status status = fieldscribe_modbus_read_word(&device->unit, function, address, &word); \
    return (status == FIELDSCRIBE_MODBUS_OK) ? fieldscribe_modbus_converted(decoded) : status;

#define FIELDSCRIBE_MODBUS_READ_WORDS(function, address, count, to, number) \
    static const fieldscribe_modbus_reading what = {function, address, count}; \
    uint16_t words[count] = {0}; \
    const fieldscribe_modbus_status status = fieldscribe_modbus_read_words(&device->unit, &what, words, count); \
    if (status == FIELDSCRIBE_MODBUS_OK) { \
        *(to) = (number); \
    } \
    return status;

/* `high` is the index of the high one of two words. */
#define FIELDSCRIBE_MODBUS_READ_LONG(function, address, high, to, number) \
    static const fieldscribe_modbus_reading what = {function, address, 2U}; \
    uint16_t words[2] = {0U, 0U}; \
    const fieldscribe_modbus_status status = fieldscribe_modbus_read_words(&device->unit, &what, words, 2U); \
    const uint32_t raw = fieldscribe_join32(words[high], words[1U - (high)]); \
    if (status == FIELDSCRIBE_MODBUS_OK) { \
        *(to) = (number); \
    } \
    return status;

#define FIELDSCRIBE_MODBUS_DECODE_LONG(function, address, high, decoded) \
    static const fieldscribe_modbus_reading what = {function, address, 2U}; \
    uint16_t words[2] = {0U, 0U}; \
    const fieldscribe_modbus_status status = fieldscribe_modbus_read_words(&device->unit, &what, words, 2U); \
    const uint32_t raw = fieldscribe_join32(words[high], words[1U - (high)]); \
    return (status == FIELDSCRIBE_MODBUS_OK) ? fieldscribe_modbus_converted(decoded) : status;

#define FIELDSCRIBE_MODBUS_DECODE_WORDS(function, address, count, decoded) \
    static const fieldscribe_modbus_reading what = {function, address, count}; \
    uint16_t words[count] = {0}; \
    const fieldscribe_modbus_status status = \
        fieldscribe_modbus_read_words(&device->unit, &what, words, count); \
    return (status == FIELDSCRIBE_MODBUS_OK) ? fieldscribe_modbus_converted(decoded) : status;

/* Texts, bytes and dates: `taken` decodes `words`, `put` encodes into them; both may set `status`. */
#define FIELDSCRIBE_MODBUS_TAKE_WORDS(function, address, count, taken) \
    static const fieldscribe_modbus_reading what = {function, address, count}; \
    uint16_t words[count] = {0}; \
    fieldscribe_modbus_status status = fieldscribe_modbus_read_words(&device->unit, &what, words, count); \
    if (status == FIELDSCRIBE_MODBUS_OK) { \
        taken; \
    } \
    return status;

#define FIELDSCRIBE_MODBUS_PUT_WORDS(function, address, count, put) \
    static const fieldscribe_modbus_writing what = {function, address, count}; \
    uint16_t words[count] = {0}; \
    fieldscribe_modbus_status status = FIELDSCRIBE_MODBUS_OK; \
    put; \
    return (status == FIELDSCRIBE_MODBUS_OK) \
        ? fieldscribe_modbus_write_words(&device->unit, &what, words, count) : status;

#define FIELDSCRIBE_MODBUS_WRITE_WORD(function, address, type, encoded, bits) \
    type raw = (type)0; \
    const fieldscribe_modbus_status status = fieldscribe_modbus_converted(encoded); \
    return (status == FIELDSCRIBE_MODBUS_OK) ? fieldscribe_modbus_write_word(&device->unit, function, address, bits) \
                                             : status;

#define FIELDSCRIBE_MODBUS_WRITE_WORDS(function, address, count, type, encoded, split) \
    static const fieldscribe_modbus_writing what = {function, address, count}; \
    type raw = (type)0; \
    uint16_t words[count]; \
    const fieldscribe_modbus_status status = fieldscribe_modbus_converted(encoded); \
    split; \
    return (status == FIELDSCRIBE_MODBUS_OK) \
        ? fieldscribe_modbus_write_words(&device->unit, &what, words, count) : status;

#define FIELDSCRIBE_MODBUS_WRITE_LONG(function, address, high, type, encoded) \
    static const fieldscribe_modbus_writing what = {function, address, 2U}; \
    type raw = (type)0; \
    uint16_t words[2]; \
    const fieldscribe_modbus_status status = fieldscribe_modbus_converted(encoded); \
    fieldscribe_split32((uint32_t)raw, &words[high], &words[1U - (high)]); \
    return (status == FIELDSCRIBE_MODBUS_OK) ? fieldscribe_modbus_write_words(&device->unit, &what, words, 2U) : status;

#define FIELDSCRIBE_MODBUS_UPDATE_WORD(from, from_address, function, address, type, encoded, bits) \
    type raw = (type)0; \
    uint16_t word = 0U; \
    fieldscribe_modbus_status status = fieldscribe_modbus_converted(encoded); \
    if (status == FIELDSCRIBE_MODBUS_OK) { \
        status = fieldscribe_modbus_read_word(&device->unit, from, from_address, &word); \
    } \
    return (status == FIELDSCRIBE_MODBUS_OK) ? fieldscribe_modbus_write_word(&device->unit, function, address, bits) \
                                             : status;

/* The same for a device with pages: `rows` is the selection of the point, or NULL. */

#define FIELDSCRIBE_MODBUS_SELECTED_READ_WORD(rows, function, address, to, number) \
    static const fieldscribe_modbus_reading what = {function, address, 1U}; \
    uint16_t word = 0U; \
    const fieldscribe_modbus_status status = \
        fieldscribe_modbus_read_selected(&device->unit, &device->selected, rows, &what, &word); \
    if (status == FIELDSCRIBE_MODBUS_OK) { \
        *(to) = (number); \
    } \
    return status;

#define FIELDSCRIBE_MODBUS_SELECTED_DECODE_WORD(rows, function, address, decoded) \
    static const fieldscribe_modbus_reading what = {function, address, 1U}; \
    uint16_t word = 0U; \
    const fieldscribe_modbus_status status = \
        fieldscribe_modbus_read_selected(&device->unit, &device->selected, rows, &what, &word); \
    return (status == FIELDSCRIBE_MODBUS_OK) ? fieldscribe_modbus_converted(decoded) : status;

#define FIELDSCRIBE_MODBUS_SELECTED_READ_WORDS(rows, function, address, count, to, number) \
    static const fieldscribe_modbus_reading what = {function, address, count}; \
    uint16_t words[count] = {0}; \
    const fieldscribe_modbus_status status = \
        fieldscribe_modbus_read_selected(&device->unit, &device->selected, rows, &what, words); \
    if (status == FIELDSCRIBE_MODBUS_OK) { \
        *(to) = (number); \
    } \
    return status;

#define FIELDSCRIBE_MODBUS_SELECTED_DECODE_WORDS(rows, function, address, count, decoded) \
    static const fieldscribe_modbus_reading what = {function, address, count}; \
    uint16_t words[count] = {0}; \
    const fieldscribe_modbus_status status = \
        fieldscribe_modbus_read_selected(&device->unit, &device->selected, rows, &what, words); \
    return (status == FIELDSCRIBE_MODBUS_OK) ? fieldscribe_modbus_converted(decoded) : status;

#define FIELDSCRIBE_MODBUS_SELECTED_WRITE_WORD(rows, function, address, type, encoded, bits) \
    static const fieldscribe_modbus_writing what = {function, address, 1U}; \
    type raw = (type)0; \
    const fieldscribe_modbus_status status = fieldscribe_modbus_converted(encoded); \
    const uint16_t word = bits; \
    return (status == FIELDSCRIBE_MODBUS_OK) \
        ? fieldscribe_modbus_write_selected(&device->unit, &device->selected, rows, &what, &word) : status;

#define FIELDSCRIBE_MODBUS_SELECTED_WRITE_WORDS(rows, function, address, count, type, encoded, split) \
    static const fieldscribe_modbus_writing what = {function, address, count}; \
    type raw = (type)0; \
    uint16_t words[count]; \
    const fieldscribe_modbus_status status = fieldscribe_modbus_converted(encoded); \
    split; \
    return (status == FIELDSCRIBE_MODBUS_OK) \
        ? fieldscribe_modbus_write_selected(&device->unit, &device->selected, rows, &what, words) : status;

#define FIELDSCRIBE_MODBUS_SELECTED_UPDATE_WORD( \
    rows, from, from_address, function, address, type, encoded, bits) \
    static const fieldscribe_modbus_reading before = {from, from_address, 1U}; \
    static const fieldscribe_modbus_writing what = {function, address, 1U}; \
    type raw = (type)0; \
    uint16_t word = 0U; \
    fieldscribe_modbus_status status = fieldscribe_modbus_converted(encoded); \
    if (status == FIELDSCRIBE_MODBUS_OK) { \
        status = fieldscribe_modbus_read_selected(&device->unit, &device->selected, rows, &before, &word); \
    } \
    word = bits; \
    return (status == FIELDSCRIBE_MODBUS_OK) \
        ? fieldscribe_modbus_write_selected(&device->unit, &device->selected, rows, &what, &word) : status;

/* True if these addresses are within the base. */
static inline bool fieldscribe_modbus_is_within(fieldscribe_modbus_base base, uint16_t address, uint16_t count)
{
    return (((uint32_t)address + count) <= ((uint32_t)base.last + 1U)) &&
        (((uint32_t)base.start + base.last) <= 0xFFFFU);
}

/*
 * The reading moved to a base; it may be a block. If it does not end within the base, its count is 0: building the
 * request then returns BAD_COUNT, and nothing is sent.
 */
static inline fieldscribe_modbus_reading fieldscribe_modbus_reading_at(
    fieldscribe_modbus_base base, const fieldscribe_modbus_reading *what)
{
    fieldscribe_modbus_reading at = {
        what->function, (uint16_t)(((uint32_t)base.start + what->address) & 0xFFFFU), 0U};
    if (fieldscribe_modbus_is_within(base, what->address, what->count)) {
        at.count = what->count;
    }
    return at;
}

/* The same for a writing. */
static inline fieldscribe_modbus_writing fieldscribe_modbus_writing_at(
    fieldscribe_modbus_base base, const fieldscribe_modbus_writing *what)
{
    fieldscribe_modbus_writing at = {
        what->function, (uint16_t)(((uint32_t)base.start + what->address) & 0xFFFFU), 0U};
    if (fieldscribe_modbus_is_within(base, what->address, what->count)) {
        at.count = what->count;
    }
    return at;
}

/*
 * Finds a block and stores where its addresses start in `base`. UNKNOWN_VALUE: the device has no such block, or no
 * marker. OVERFLOW: the chain of blocks does not end.
 */
FIELDSCRIBE_CHECKED fieldscribe_modbus_status fieldscribe_modbus_find(fieldscribe_modbus_unit *unit,
    const fieldscribe_modbus_chain *chain, uint16_t block, fieldscribe_modbus_base *base);

/* The bodies of functions that also have a parameter `base`. */

#define FIELDSCRIBE_MODBUS_BASED_READ_WORD(function, address, to, number) \
    uint16_t word = 0U; \
    const fieldscribe_modbus_reading what = {function, address, 1U}; \
    const fieldscribe_modbus_reading at = fieldscribe_modbus_reading_at(base, &what); \
    const fieldscribe_modbus_status status = fieldscribe_modbus_read_words(&device->unit, &at, &word, 1U); \
    if (status == FIELDSCRIBE_MODBUS_OK) { \
        *(to) = (number); \
    } \
    return status;

#define FIELDSCRIBE_MODBUS_BASED_DECODE_WORD(function, address, decoded) \
    uint16_t word = 0U; \
    const fieldscribe_modbus_reading what = {function, address, 1U}; \
    const fieldscribe_modbus_reading at = fieldscribe_modbus_reading_at(base, &what); \
    const fieldscribe_modbus_status status = fieldscribe_modbus_read_words(&device->unit, &at, &word, 1U); \
    return (status == FIELDSCRIBE_MODBUS_OK) ? fieldscribe_modbus_converted(decoded) : status;

#define FIELDSCRIBE_MODBUS_BASED_READ_WORDS(function, address, count, to, number) \
    uint16_t words[count] = {0}; \
    const fieldscribe_modbus_reading what = {function, address, count}; \
    const fieldscribe_modbus_reading at = fieldscribe_modbus_reading_at(base, &what); \
    const fieldscribe_modbus_status status = fieldscribe_modbus_read_words(&device->unit, &at, words, count); \
    if (status == FIELDSCRIBE_MODBUS_OK) { \
        *(to) = (number); \
    } \
    return status;

#define FIELDSCRIBE_MODBUS_BASED_DECODE_WORDS(function, address, count, decoded) \
    uint16_t words[count] = {0}; \
    const fieldscribe_modbus_reading what = {function, address, count}; \
    const fieldscribe_modbus_reading at = fieldscribe_modbus_reading_at(base, &what); \
    const fieldscribe_modbus_status status = fieldscribe_modbus_read_words(&device->unit, &at, words, count); \
    return (status == FIELDSCRIBE_MODBUS_OK) ? fieldscribe_modbus_converted(decoded) : status;

#define FIELDSCRIBE_MODBUS_BASED_TAKE_WORDS(function, address, number, taken) \
    uint16_t words[number] = {0}; \
    const fieldscribe_modbus_reading what = {function, address, number}; \
    const fieldscribe_modbus_reading at = fieldscribe_modbus_reading_at(base, &what); \
    fieldscribe_modbus_status status = fieldscribe_modbus_read_words(&device->unit, &at, words, at.count); \
    if (status == FIELDSCRIBE_MODBUS_OK) { \
        taken; \
    } \
    return status;

#define FIELDSCRIBE_MODBUS_BASED_PUT_WORDS(function, address, number, put) \
    uint16_t words[number] = {0}; \
    const fieldscribe_modbus_writing what = {function, address, number}; \
    const fieldscribe_modbus_writing at = fieldscribe_modbus_writing_at(base, &what); \
    fieldscribe_modbus_status status = FIELDSCRIBE_MODBUS_OK; \
    put; \
    return (status == FIELDSCRIBE_MODBUS_OK) ? fieldscribe_modbus_write_words(&device->unit, &at, words, at.count) \
                                             : status;

#define FIELDSCRIBE_MODBUS_BASED_WRITE_WORD(function, address, type, encoded, bits) \
    type raw = (type)0; \
    const fieldscribe_modbus_writing what = {function, address, 1U}; \
    const fieldscribe_modbus_writing at = fieldscribe_modbus_writing_at(base, &what); \
    const fieldscribe_modbus_status status = fieldscribe_modbus_converted(encoded); \
    const uint16_t word = bits; \
    return (status == FIELDSCRIBE_MODBUS_OK) ? fieldscribe_modbus_write_words(&device->unit, &at, &word, at.count) \
                                             : status;

#define FIELDSCRIBE_MODBUS_BASED_WRITE_WORDS(function, address, number, type, encoded, split) \
    type raw = (type)0; \
    uint16_t words[number]; \
    const fieldscribe_modbus_writing what = {function, address, number}; \
    const fieldscribe_modbus_writing at = fieldscribe_modbus_writing_at(base, &what); \
    const fieldscribe_modbus_status status = fieldscribe_modbus_converted(encoded); \
    split; \
    return (status == FIELDSCRIBE_MODBUS_OK) ? fieldscribe_modbus_write_words(&device->unit, &at, words, at.count) \
                                             : status;

#define FIELDSCRIBE_MODBUS_BASED_UPDATE_WORD(from, from_address, function, address, type, encoded, bits) \
    type raw = (type)0; \
    uint16_t word = 0U; \
    const fieldscribe_modbus_reading read = {from, from_address, 1U}; \
    const fieldscribe_modbus_reading read_at = fieldscribe_modbus_reading_at(base, &read); \
    const fieldscribe_modbus_writing what = {function, address, 1U}; \
    const fieldscribe_modbus_writing at = fieldscribe_modbus_writing_at(base, &what); \
    fieldscribe_modbus_status status = fieldscribe_modbus_converted(encoded); \
    if (status == FIELDSCRIBE_MODBUS_OK) { \
        status = fieldscribe_modbus_read_words(&device->unit, &read_at, &word, 1U); \
    } \
    if (status == FIELDSCRIBE_MODBUS_OK) { \
        word = bits; \
        status = fieldscribe_modbus_write_words(&device->unit, &at, &word, at.count); \
    } \
    return status;

/* The words (or coils) of a point in the answer to a block's request; NULL if some are missing. */
FIELDSCRIBE_CHECKED const uint16_t *fieldscribe_modbus_words_in(const fieldscribe_modbus_request *request,
    const fieldscribe_modbus_reply *reply, const fieldscribe_modbus_reading *point);

/* The checksum of RTU frames; the low byte is sent first. */
FIELDSCRIBE_CHECKED uint16_t fieldscribe_modbus_crc(const uint8_t *bytes, size_t length);

#ifdef __cplusplus
}
#endif

#endif

/* ---- Definitions ---- */

#if defined(FIELDSCRIBE_IMPLEMENTATION) && !defined(FIELDSCRIBE_MODBUS_IMPLEMENTED)
#define FIELDSCRIBE_MODBUS_IMPLEMENTED

const char *fieldscribe_modbus_status_name(fieldscribe_modbus_status status)
{
    static const char *const names[] = {"ok", "out_of_range", "not_a_number", "unknown_value", "zero_factor", "no_case",
        "overflow", "special", "malformed", "bad_unit", "bad_function", "bad_count", "bad_address", "bad_value",
        "bad_framing", "buffer_too_small", "short_frame", "long_frame", "bad_crc", "bad_protocol", "wrong_transaction",
        "wrong_unit", "wrong_function", "exception", "bad_byte_count", "echo_mismatch", "noise"};
    return ((size_t)status < FIELDSCRIBE_COUNT(names)) ? names[(size_t)status] : "unknown";
}

uint16_t fieldscribe_modbus_crc(const uint8_t *bytes, size_t length)
{
    static const uint16_t nibbles[16] = {0x0000U, 0xCC01U, 0xD801U, 0x1400U, 0xF001U, 0x3C00U, 0x2800U, 0xE401U,
        0xA001U, 0x6C00U, 0x7800U, 0xB401U, 0x5000U, 0x9C01U, 0x8801U, 0x4400U};
    uint32_t crc = 0xFFFFU;
    size_t at;
    for (at = 0U; at < length; ++at) {
        crc ^= bytes[at];
        crc = (crc >> 4) ^ nibbles[crc & 0xFU];
        crc = (crc >> 4) ^ nibbles[crc & 0xFU];
    }
    return (uint16_t)(crc & 0xFFFFU);
}

static uint16_t fieldscribe_modbus_get(const uint8_t *bytes)
{
    return (uint16_t)(((uint32_t)bytes[0] << 8) | bytes[1]);
}

static void fieldscribe_modbus_put(uint8_t *bytes, uint16_t number)
{
    bytes[0] = (uint8_t)(number >> 8);
    bytes[1] = (uint8_t)(number & 0xFFU);
}

static bool fieldscribe_modbus_reads(uint8_t function)
{
#if defined(FIELDSCRIBE_MODBUS_WRITES)
    return (function >= 0x01U) && (function <= 0x04U);
#else
    (void)function;
    return true;
#endif
}

/* The length of the normal answer to a request, from the function on. */
static uint32_t fieldscribe_modbus_answer(const fieldscribe_modbus_request *request)
{
#if defined(FIELDSCRIBE_MODBUS_COILS)
    if (request->function <= 0x02U) {
        return 2U + (((uint32_t)request->count + 7U) / 8U);
    }
#endif
    return fieldscribe_modbus_reads(request->function) ? (2U + ((uint32_t)request->count * 2U)) : 5U;
}

/* The length, from the function on, of an answer that begins with these two bytes; 0 if it answers another request. */
static uint32_t fieldscribe_modbus_pdu(uint8_t function, uint8_t code, uint32_t count)
{
    if (code == function) {
        return fieldscribe_modbus_reads(function) ? (2U + count) : 5U;
    }
    return (code == (function | 0x80U)) ? 2U : 0U; /* an exception, or nothing */
}

/* True if the device has the unit, or if all units may get the function. */
static bool fieldscribe_modbus_has_unit(
    const fieldscribe_modbus_profile *profile, const fieldscribe_modbus_request *request)
{
#if defined(FIELDSCRIBE_MODBUS_WRITES)
    if (request->unit == profile->broadcast) {
        return ((profile->to_all >> request->function) & 1U) != 0U;
    }
#endif
    return (request->unit >= profile->first_unit) && (request->unit <= profile->last_unit);
}

/* OK if the device accepts the request, apart from its values. */
static fieldscribe_modbus_status fieldscribe_modbus_allows(
    const fieldscribe_modbus_profile *profile, const fieldscribe_modbus_request *request)
{
#if defined(FIELDSCRIBE_MODBUS_WRITES)
    const uint8_t end = (request->writer == NULL) ? FIELDSCRIBE_MODBUS_READS : FIELDSCRIBE_MODBUS_FUNCTIONS;
#else
    const uint8_t end = FIELDSCRIBE_MODBUS_READS;
#endif
    if ((request->function >= end) || (profile->most[request->function] == 0U)) {
        return FIELDSCRIBE_MODBUS_BAD_FUNCTION;
    }
    if (!fieldscribe_modbus_has_unit(profile, request)) {
        return FIELDSCRIBE_MODBUS_BAD_UNIT;
    }
    if ((request->count == 0U) || (request->count > profile->most[request->function])) {
        return FIELDSCRIBE_MODBUS_BAD_COUNT;
    }
    return ((((uint32_t)request->address + request->count - 1U) >> 16) != 0U) /* the last item */
        ? FIELDSCRIBE_MODBUS_BAD_ADDRESS
        : FIELDSCRIBE_MODBUS_OK;
}

/* Builds and checks requests that write: a program that only reads does not link it. */
struct fieldscribe_modbus_writer {
    fieldscribe_modbus_status (*put)(const fieldscribe_modbus_profile *profile,
        const fieldscribe_modbus_request *request, uint8_t *buffer, size_t *size);
    fieldscribe_modbus_status (*take)(
        const fieldscribe_modbus_request *request, const uint8_t *pdu, size_t size, fieldscribe_modbus_reply *reply);
};

/* Builds the request from the unit to the end of its data. `size` is the room, at least 6, then the bytes used. */
static fieldscribe_modbus_status fieldscribe_modbus_put_request(const fieldscribe_modbus_profile *profile,
    const fieldscribe_modbus_request *request, uint8_t *buffer, size_t *size)
{
    fieldscribe_modbus_status status = fieldscribe_modbus_allows(profile, request);
#if defined(FIELDSCRIBE_MODBUS_WRITES)
    if ((status == FIELDSCRIBE_MODBUS_OK) && (request->writer != NULL)) {
        status = request->writer->put(profile, request, buffer, size);
    } else {
        *size = 6U;
    }
#else
    *size = 6U;
#endif
    if (status == FIELDSCRIBE_MODBUS_OK) {
        buffer[0] = request->unit;
        buffer[1] = request->function;
        fieldscribe_modbus_put(&buffer[2], request->address);
#if defined(FIELDSCRIBE_MODBUS_WRITES)
        fieldscribe_modbus_put(&buffer[4], request->number);
#else
        fieldscribe_modbus_put(&buffer[4], request->count);
#endif
    }
    return status;
}

/* Eight coils as a byte; those after the last are 0. */
static uint8_t fieldscribe_modbus_coils(const fieldscribe_modbus_request *request, uint32_t first)
{
    uint8_t byte = 0U;
    uint32_t at;
    for (at = 0U; at < 8U; ++at) {
        const uint32_t place = first + at;
        if ((place < request->count) && (request->values[place] != 0U)) {
            byte = (uint8_t)(byte | ((uint32_t)1U << at));
        }
    }
    return byte;
}

/* True if all values to write are coils, 0 or 1. */
static bool fieldscribe_modbus_are_coils(const fieldscribe_modbus_request *request)
{
    uint16_t at = 0U;
    while ((at < request->count) && (request->values[at] <= 1U)) {
        ++at;
    }
    return at == request->count;
}

/* Writes the byte count and the data of 0Fh. */
static fieldscribe_modbus_status fieldscribe_modbus_put_coils(const fieldscribe_modbus_profile *profile,
    const fieldscribe_modbus_request *request, uint8_t *buffer, size_t *size)
{
    uint32_t data_bytes = ((uint32_t)request->count + 7U) / 8U;
    uint32_t at;
    data_bytes += profile->pads_coil_bytes ? (data_bytes % 2U) : 0U;
    if ((request->values == NULL) || (!fieldscribe_modbus_are_coils(request))) {
        return FIELDSCRIBE_MODBUS_BAD_VALUE;
    }
    if ((data_bytes > 0xFFU) || ((7U + data_bytes) > *size)) {
        return FIELDSCRIBE_MODBUS_BUFFER_TOO_SMALL;
    }
    buffer[6] = (uint8_t)data_bytes;
    for (at = 0U; at < data_bytes; ++at) {
        buffer[7U + at] = fieldscribe_modbus_coils(request, 8U * at);
    }
    *size = 7U + (size_t)data_bytes;
    return FIELDSCRIBE_MODBUS_OK;
}

/* Checks a single value, or writes the byte count and the data of several. */
static fieldscribe_modbus_status fieldscribe_modbus_put_values(const fieldscribe_modbus_profile *profile,
    const fieldscribe_modbus_request *request, uint8_t *buffer, size_t *size)
{
    const uint32_t data_bytes = (uint32_t)request->count * 2U;
    uint32_t at;
#if defined(FIELDSCRIBE_MODBUS_COILS)
    if (request->function == 0x0FU) {
        return fieldscribe_modbus_put_coils(profile, request, buffer, size);
    }
    if ((request->function == 0x05U) && (request->number != 0U) && (request->number != 0xFF00U)) {
        return FIELDSCRIBE_MODBUS_BAD_VALUE;
    }
#else
    (void)profile;
#endif
    if (request->function != 0x10U) { /* a single value: that of 08h is for sub-function 0 */
        *size = 6U;
        return ((request->function == 0x08U) && (request->address != 0U)) ? FIELDSCRIBE_MODBUS_BAD_ADDRESS
                                                                          : FIELDSCRIBE_MODBUS_OK;
    }
    if ((request->values == NULL) || (data_bytes > 0xFFU) || ((7U + data_bytes) > *size)) {
        return FIELDSCRIBE_MODBUS_BUFFER_TOO_SMALL;
    }
    buffer[6] = (uint8_t)data_bytes;
    for (at = 0U; at < (data_bytes / 2U); ++at) {
        fieldscribe_modbus_put(&buffer[7U + (2U * at)], request->values[at]);
    }
    *size = 7U + (size_t)data_bytes;
    return FIELDSCRIBE_MODBUS_OK;
}

/* Checks the echo: the value that was written, or the number of items. */
static fieldscribe_modbus_status fieldscribe_modbus_take_echo(
    const fieldscribe_modbus_request *request, const uint8_t *pdu, size_t size, fieldscribe_modbus_reply *reply)
{
    if ((size != 5U) || (request->count == 0U) || (fieldscribe_modbus_get(&pdu[1]) != request->address) ||
        (fieldscribe_modbus_get(&pdu[3]) != request->number)) {
        return FIELDSCRIBE_MODBUS_ECHO_MISMATCH;
    }
    if ((request->function <= 0x08U) && (reply->values != NULL) && (reply->room > 0U)) {
        reply->values[0] = request->number;
        reply->count = 1U;
#if defined(FIELDSCRIBE_MODBUS_COILS)
        if (request->function == 0x05U) {
            reply->values[0] = (uint16_t)(request->number >> 15);
        }
#endif
    }
    return FIELDSCRIBE_MODBUS_OK;
}

static const struct fieldscribe_modbus_writer fieldscribe_modbus_writes = {
    &fieldscribe_modbus_put_values, &fieldscribe_modbus_take_echo};

fieldscribe_modbus_request fieldscribe_modbus_write(
    uint8_t unit, const fieldscribe_modbus_writing *what, const uint16_t *values, size_t given)
{
    fieldscribe_modbus_request request = {
        unit, what->function, what->address, 0U, false,
#if defined(FIELDSCRIBE_MODBUS_OVER_TCP)
        0U,
#endif
        0U, values, &fieldscribe_modbus_writes};
    if ((values != NULL) && (given > 0U) && (given >= what->count) && !fieldscribe_modbus_reads(what->function)) {
        request.count = what->count;
        request.number = (what->function > 0x08U) ? what->count : values[0];
#if defined(FIELDSCRIBE_MODBUS_COILS)
        if (what->function == 0x05U) { /* FF00h is on; 1 marks an invalid coil */
            request.number = (uint16_t)((values[0] > 1U) ? 1U : (values[0] * 0xFF00U));
        }
#endif
    }
    return request;
}

fieldscribe_modbus_status fieldscribe_modbus_build_rtu(const fieldscribe_modbus_profile *profile,
    const fieldscribe_modbus_request *request, uint8_t *buffer, size_t size, size_t *length)
{
    fieldscribe_modbus_status status = FIELDSCRIBE_MODBUS_BUFFER_TOO_SMALL;
    *length = 0U;
#if defined(FIELDSCRIBE_MODBUS_OVER_TCP)
    if (!profile->rtu) {
        return FIELDSCRIBE_MODBUS_BAD_FRAMING;
    }
#endif
    if (size >= 8U) {
        size_t used = size - 2U;
        status = fieldscribe_modbus_put_request(profile, request, buffer, &used);
        if (status == FIELDSCRIBE_MODBUS_OK) {
            const uint16_t crc = fieldscribe_modbus_crc(buffer, used);
            buffer[used] = (uint8_t)(crc & 0xFFU);
            buffer[used + 1U] = (uint8_t)(crc >> 8);
            *length = used + 2U;
        }
    }
    return status;
}

fieldscribe_modbus_status fieldscribe_modbus_build_tcp(const fieldscribe_modbus_profile *profile,
    const fieldscribe_modbus_request *request, uint8_t *buffer, size_t size, size_t *length)
{
    fieldscribe_modbus_status status = FIELDSCRIBE_MODBUS_BUFFER_TOO_SMALL;
    *length = 0U;
    if (!profile->tcp) {
        status = FIELDSCRIBE_MODBUS_BAD_FRAMING;
    } else if (size >= 12U) {
        size_t used = size - 6U;
        status = fieldscribe_modbus_put_request(profile, request, &buffer[6], &used);
        if (status == FIELDSCRIBE_MODBUS_OK) {
            fieldscribe_modbus_put(buffer, request->transaction);
            fieldscribe_modbus_put(&buffer[2], 0U);
            fieldscribe_modbus_put(&buffer[4], (uint16_t)used);
            *length = used + 6U;
        }
    } else {
        /* it is too small */
    }
    return status;
}

fieldscribe_modbus_status fieldscribe_modbus_build_pdu(const fieldscribe_modbus_profile *profile,
    const fieldscribe_modbus_request *request, uint8_t *buffer, size_t size, size_t *length)
{
    fieldscribe_modbus_status status = FIELDSCRIBE_MODBUS_BUFFER_TOO_SMALL;
    size_t used = size;
    size_t at;
    *length = 0U;
    if (size >= 6U) {
        status = fieldscribe_modbus_put_request(profile, request, buffer, &used);
    }
    if (status == FIELDSCRIBE_MODBUS_OK) {
        *length = used - 1U;
        for (at = 0U; at < *length; ++at) { /* over the unit number */
            buffer[at] = buffer[at + 1U];
        }
    }
    return status;
}

/* Parses an answer with the right unit and function, or an exception: its own `size` bytes, from the function on. */
static fieldscribe_modbus_status fieldscribe_modbus_take_answer(
    const fieldscribe_modbus_request *request, const uint8_t *pdu, size_t size, fieldscribe_modbus_reply *reply)
{
#if defined(FIELDSCRIBE_MODBUS_COILS)
    const uint32_t count = request->count;
    const uint32_t data_bytes = (request->function <= 0x02U) ? ((count + 7U) / 8U) : (count * 2U);
#else
    const uint32_t data_bytes = (uint32_t)request->count * 2U;
#endif
    uint32_t at;
    if (pdu[0] != request->function) {
        reply->exception = pdu[1];
        return FIELDSCRIBE_MODBUS_EXCEPTION;
    }
#if defined(FIELDSCRIBE_MODBUS_WRITES)
    if (request->writer != NULL) {
        return request->writer->take(request, pdu, size, reply);
    }
#endif
    if ((uint32_t)size != (2U + data_bytes)) {
        return FIELDSCRIBE_MODBUS_BAD_BYTE_COUNT;
    }
    if ((reply->values == NULL) || (reply->room < request->count)) {
        return FIELDSCRIBE_MODBUS_BUFFER_TOO_SMALL;
    }
    reply->count = request->count;
    for (at = 0U; at < request->count; ++at) {
#if defined(FIELDSCRIBE_MODBUS_COILS)
        reply->values[at] = (uint16_t)((request->function <= 0x02U)
            ? (((uint32_t)pdu[2U + (at / 8U)] >> (at % 8U)) & 1U)
            : fieldscribe_modbus_get(&pdu[2U + (2U * at)]));
#else
        reply->values[at] = fieldscribe_modbus_get(&pdu[2U + (2U * at)]);
#endif
    }
    return FIELDSCRIBE_MODBUS_OK;
}

fieldscribe_modbus_status fieldscribe_modbus_parse_rtu(
    const fieldscribe_modbus_request *request, const uint8_t *bytes, size_t length, fieldscribe_modbus_reply *reply)
{
    size_t pdu;
    reply->count = 0U;
    reply->exception = 0U;
    if (length < 5U) {
        return FIELDSCRIBE_MODBUS_SHORT_FRAME;
    }
    pdu = (size_t)fieldscribe_modbus_pdu(request->function, bytes[1], bytes[2]);
    if ((pdu != 0U) && (length != (pdu + 3U))) {
        return (length < (pdu + 3U)) ? FIELDSCRIBE_MODBUS_SHORT_FRAME : FIELDSCRIBE_MODBUS_LONG_FRAME;
    }
    if (fieldscribe_modbus_crc(bytes, length) != 0U) { /* the checksum over a frame and its checksum is 0 */
        return FIELDSCRIBE_MODBUS_BAD_CRC;
    }
    if (bytes[0] != request->unit) {
        return FIELDSCRIBE_MODBUS_WRONG_UNIT;
    }
    return (pdu == 0U) ? FIELDSCRIBE_MODBUS_WRONG_FUNCTION
                       : fieldscribe_modbus_take_answer(request, &bytes[1], pdu, reply);
}

#if defined(FIELDSCRIBE_MODBUS_OVER_TCP)
/* The same for a frame whose header states its length. */
static fieldscribe_modbus_status fieldscribe_modbus_take_tcp(
    const fieldscribe_modbus_request *request, const uint8_t *pdu, size_t size, fieldscribe_modbus_reply *reply)
{
    const size_t whole = (size_t)fieldscribe_modbus_pdu(request->function, pdu[0], pdu[1]);
    if (size == whole) {
        return fieldscribe_modbus_take_answer(request, pdu, size, reply);
    }
    if ((pdu[0] == request->function) && fieldscribe_modbus_reads(request->function)) {
        return FIELDSCRIBE_MODBUS_BAD_BYTE_COUNT;
    }
    return (size < whole) ? FIELDSCRIBE_MODBUS_SHORT_FRAME : FIELDSCRIBE_MODBUS_LONG_FRAME;
}
#endif

fieldscribe_modbus_status fieldscribe_modbus_parse_tcp(
    const fieldscribe_modbus_request *request, const uint8_t *bytes, size_t length, fieldscribe_modbus_reply *reply)
{
    size_t expected;
    reply->count = 0U;
    reply->exception = 0U;
    if (length < 9U) {
        return FIELDSCRIBE_MODBUS_SHORT_FRAME;
    }
    if (fieldscribe_modbus_get(&bytes[2]) != 0U) {
        return FIELDSCRIBE_MODBUS_BAD_PROTOCOL;
    }
    expected = 6U + (size_t)fieldscribe_modbus_get(&bytes[4]);
    if (length != expected) {
        return (length < expected) ? FIELDSCRIBE_MODBUS_SHORT_FRAME : FIELDSCRIBE_MODBUS_LONG_FRAME;
    }
    if (fieldscribe_modbus_get(bytes) != request->transaction) {
        return FIELDSCRIBE_MODBUS_WRONG_TRANSACTION;
    }
    if (bytes[6] != request->unit) {
        return FIELDSCRIBE_MODBUS_WRONG_UNIT;
    }
    if (fieldscribe_modbus_pdu(request->function, bytes[7], bytes[8]) == 0U) {
        return FIELDSCRIBE_MODBUS_WRONG_FUNCTION;
    }
    return fieldscribe_modbus_take_tcp(request, &bytes[7], length - 7U, reply);
}

fieldscribe_modbus_status fieldscribe_modbus_parse_pdu(
    const fieldscribe_modbus_request *request, const uint8_t *pdu, size_t length, fieldscribe_modbus_reply *reply)
{
    size_t expected;
    reply->count = 0U;
    reply->exception = 0U;
    if (length < 2U) {
        return FIELDSCRIBE_MODBUS_SHORT_FRAME;
    }
    expected = (size_t)fieldscribe_modbus_pdu(request->function, pdu[0], pdu[1]);
    if ((expected != 0U) && (length != expected)) {
        return (length < expected) ? FIELDSCRIBE_MODBUS_SHORT_FRAME : FIELDSCRIBE_MODBUS_LONG_FRAME;
    }
    return (expected == 0U) ? FIELDSCRIBE_MODBUS_WRONG_FUNCTION
                            : fieldscribe_modbus_take_answer(request, pdu, expected, reply);
}

/* The bytes of a frame around its PDU: unit and checksum, or the header with the unit. */
static uint32_t fieldscribe_modbus_around(fieldscribe_modbus_framing framing)
{
    return (framing == FIELDSCRIBE_MODBUS_TCP) ? 7U : 3U;
}

uint32_t fieldscribe_modbus_reply_length(const fieldscribe_modbus_profile *profile,
    fieldscribe_modbus_framing framing, const fieldscribe_modbus_request *request)
{
#if defined(FIELDSCRIBE_MODBUS_WRITES)
    if (request->unit == profile->broadcast) {
        return 0U;
    }
#else
    (void)profile;
#endif
    return fieldscribe_modbus_around(framing) + fieldscribe_modbus_answer(request);
}

uint32_t fieldscribe_modbus_left(const fieldscribe_modbus_profile *profile, fieldscribe_modbus_framing framing,
    const fieldscribe_modbus_request *request, const uint8_t *buffer, size_t size, size_t length)
{
    const uint32_t shortest = fieldscribe_modbus_around(framing) + 2U;
    uint32_t whole = fieldscribe_modbus_reply_length(profile, framing, request);
    if ((whole != 0U) && (length < shortest)) {
        whole = shortest;
    } else if ((whole != 0U) && (framing == FIELDSCRIBE_MODBUS_TCP)) {
        whole = 6U + (uint32_t)fieldscribe_modbus_get(&buffer[4]);
    } else if ((whole != 0U) && ((buffer[1] & 0x80U) != 0U)) { /* an exception, whatever it answers */
        whole = shortest;
    } else if ((whole != 0U) && (buffer[1] == request->function)) {
        whole = 3U + fieldscribe_modbus_pdu(request->function, request->function, buffer[2]);
    } else {
        /* a broadcast, or an answer that does not state its length */
    }
    if (whole > size) {
        whole = (uint32_t)size;
    }
    return (length < whole) ? (whole - (uint32_t)length) : 0U;
}

/* The least length of an answer that starts with these bytes, if any; 0 if none does, or if it is corrupt. */
static size_t fieldscribe_modbus_begun_rtu(
    const fieldscribe_modbus_receiver *receiver, const uint8_t *bytes, size_t length)
{
    size_t whole = 5U; /* the shortest answer */
    if ((length > 0U) && (bytes[0] != receiver->unit)) {
        return 0U;
    }
    if (length > 1U) {
        whole = 3U + (size_t)fieldscribe_modbus_pdu(receiver->function, bytes[1], (length > 2U) ? bytes[2] : 0U);
        if ((whole == 3U) || (whole > receiver->size) ||
            ((whole <= length) && (fieldscribe_modbus_crc(bytes, whole) != 0U))) {
            return 0U;
        }
    }
    return whole;
}

/* The same over TCP. */
static size_t fieldscribe_modbus_begun_tcp(
    const fieldscribe_modbus_receiver *receiver, const uint8_t *bytes, size_t length)
{
    const uint8_t head[4] = {
        (uint8_t)(receiver->transaction >> 8), (uint8_t)(receiver->transaction & 0xFFU), 0U, 0U};
    const size_t shortest = 9U;
    size_t whole = (length > 5U) ? (6U + (size_t)fieldscribe_modbus_get(&bytes[4])) : shortest;
    size_t at = 0U;
    while ((at < length) && (at < 4U) && (bytes[at] == head[at])) {
        ++at;
    }
    if ((length > 0U) &&
        (((at < length) && (at < 4U)) || (whole < shortest) || (whole > receiver->size) ||
            ((length > 6U) && (bytes[6] != receiver->unit)) ||
            ((length > 7U) && (fieldscribe_modbus_pdu(receiver->function, bytes[7], 0U) == 0U)))) {
        whole = 0U;
    } else if (length < 8U) {
        whole = shortest; /* enough to see whose answer it is */
    } else {
        /* its own length */
    }
    return whole;
}

static fieldscribe_modbus_receiver fieldscribe_modbus_rtu_receiver(
    const fieldscribe_modbus_request *request, uint8_t *buffer, size_t size)
{
    const fieldscribe_modbus_receiver receiver = {buffer, size, 0U, 0U, 5U, request->unit, request->function, false,
#if defined(FIELDSCRIBE_MODBUS_OVER_TCP)
        request->transaction, &fieldscribe_modbus_begun_rtu,
#endif
    };
    return receiver;
}

static fieldscribe_modbus_receiver fieldscribe_modbus_tcp_receiver(
    const fieldscribe_modbus_request *request, uint8_t *buffer, size_t size)
{
    const fieldscribe_modbus_receiver receiver = {buffer, size, 0U, 0U, 9U, request->unit, request->function, false,
        request->transaction, &fieldscribe_modbus_begun_tcp};
    return receiver;
}

fieldscribe_modbus_receiver fieldscribe_modbus_await_rtu(const fieldscribe_modbus_profile *profile,
    const fieldscribe_modbus_request *request, uint8_t *buffer, size_t size)
{
    fieldscribe_modbus_receiver receiver = fieldscribe_modbus_rtu_receiver(request, buffer, size);
    const uint32_t whole = fieldscribe_modbus_reply_length(profile, FIELDSCRIBE_MODBUS_RTU, request);
    receiver.done = (whole == 0U) || (whole > size);
    return receiver;
}

fieldscribe_modbus_receiver fieldscribe_modbus_await_tcp(const fieldscribe_modbus_profile *profile,
    const fieldscribe_modbus_request *request, uint8_t *buffer, size_t size)
{
    fieldscribe_modbus_receiver receiver = fieldscribe_modbus_tcp_receiver(request, buffer, size);
    const uint32_t whole = fieldscribe_modbus_reply_length(profile, FIELDSCRIBE_MODBUS_TCP, request);
    receiver.done = (whole == 0U) || (whole > size);
    return receiver;
}

/* Drops bytes until the rest may be the answer, and bytes after its end; after `silence` a complete answer wins. */
static void fieldscribe_modbus_settle(fieldscribe_modbus_receiver *receiver, bool silence)
{
    const size_t end = receiver->length;
    size_t at = 0U;
    size_t from = 0U;
    size_t rest;
    size_t least;
    bool whole_only = silence;
    for (;;) {
        rest = end - from;
#if defined(FIELDSCRIBE_MODBUS_OVER_TCP)
        least = receiver->begun(receiver, &receiver->buffer[from], rest);
#else
        least = fieldscribe_modbus_begun_rtu(receiver, &receiver->buffer[from], rest);
#endif
        if ((least != 0U) && ((!whole_only) || (least <= rest))) {
            break;
        }
        ++from;
        if (rest == 0U) { /* there is no complete answer: look for the start of one */
            whole_only = false;
            from = 0U;
        }
    }
    receiver->next = least;
    receiver->done = least <= rest;
    if (receiver->done) {
        rest = least; /* drop bytes after the answer */
    }
    receiver->length = rest;
    receiver->dropped += end - rest;
    for (; (at < from) && (from < end); ++from) {
        receiver->buffer[at] = receiver->buffer[from];
        ++at;
    }
}

size_t fieldscribe_modbus_receive(fieldscribe_modbus_receiver *receiver, const uint8_t *bytes, size_t count)
{
    size_t taken = 0U;
    while ((taken < count) && (!receiver->done) && (receiver->length < receiver->size)) {
        receiver->buffer[receiver->length] = bytes[taken];
        ++receiver->length;
        ++taken;
        if (receiver->length >= receiver->next) {
            fieldscribe_modbus_settle(receiver, false);
        }
    }
    return taken;
}

void fieldscribe_modbus_silent(fieldscribe_modbus_receiver *receiver)
{
    if (!receiver->done) {
        fieldscribe_modbus_settle(receiver, true);
    }
}

/* Receives an answer until it is complete, the line is silent, or ASK_MOST bytes arrived. */
static void fieldscribe_modbus_listen(const fieldscribe_modbus_line *line, fieldscribe_modbus_receiver *receiver)
{
    uint32_t wait = line->answer_ms;
    bool comes = true;
    while (comes && (!receiver->done) && ((receiver->dropped + receiver->next) <= FIELDSCRIBE_MODBUS_ASK_MOST)) {
        while (comes && (receiver->length < receiver->next)) {
            comes = line->receive(line->context, wait, &receiver->buffer[receiver->length]);
            receiver->length += comes ? 1U : 0U;
            wait = line->pause_ms;
        }
        if (comes) {
            fieldscribe_modbus_settle(receiver, false);
        }
    }
    if (!receiver->done) {
        fieldscribe_modbus_settle(receiver, true);
    }
}

/* Sends a built request and receives the answer, which has `around` bytes beside its PDU; after noise it waits on. */
static fieldscribe_modbus_status fieldscribe_modbus_exchange(const fieldscribe_modbus_line *line,
    const fieldscribe_modbus_request *request, const fieldscribe_modbus_reply *reply, size_t around, size_t length,
    fieldscribe_modbus_receiver *receiver)
{
    if (((around + fieldscribe_modbus_answer(request)) > line->size) ||
        (fieldscribe_modbus_reads(request->function) && ((reply->values == NULL) || (reply->room < request->count)))) {
        return FIELDSCRIBE_MODBUS_BUFFER_TOO_SMALL;
    }
    line->send(line->context, line->buffer, length);
#if defined(FIELDSCRIBE_MODBUS_WRITES)
    if (request->unit == line->profile->broadcast) { /* nobody answers */
        return FIELDSCRIBE_MODBUS_OK;
    }
#endif
    fieldscribe_modbus_listen(line, receiver);
    if (receiver->dropped == 0U) {
        return FIELDSCRIBE_MODBUS_SHORT_FRAME;
    }
    if (receiver->length == 0U) {
        fieldscribe_modbus_listen(line, receiver);
    }
    return FIELDSCRIBE_MODBUS_NOISE;
}

fieldscribe_modbus_status fieldscribe_modbus_ask_rtu(const fieldscribe_modbus_line *line,
    const fieldscribe_modbus_request *request, fieldscribe_modbus_reply *reply)
{
    fieldscribe_modbus_receiver receiver;
    fieldscribe_modbus_status status;
    size_t length;
    size_t dropped;
    uint8_t byte;
    bool late = request->late;
    for (dropped = 0U; late && (dropped < FIELDSCRIBE_MODBUS_ASK_MOST); ++dropped) {
        late = line->receive(line->context, line->answer_ms, &byte);
    }
    reply->count = 0U;
    reply->exception = 0U;
    status = fieldscribe_modbus_build_rtu(line->profile, request, line->buffer, line->size, &length);
    if (status != FIELDSCRIBE_MODBUS_OK) {
        return status;
    }
    receiver = fieldscribe_modbus_rtu_receiver(request, line->buffer, line->size);
    status = fieldscribe_modbus_exchange(line, request, reply, 3U, length, &receiver);
    return receiver.done ? fieldscribe_modbus_take_answer(request, &line->buffer[1], receiver.length - 3U, reply)
                         : status;
}

fieldscribe_modbus_status fieldscribe_modbus_ask_tcp(const fieldscribe_modbus_line *line,
    const fieldscribe_modbus_request *request, fieldscribe_modbus_reply *reply)
{
    fieldscribe_modbus_receiver receiver;
    fieldscribe_modbus_status status;
    size_t length;
    reply->count = 0U;
    reply->exception = 0U;
    status = fieldscribe_modbus_build_tcp(line->profile, request, line->buffer, line->size, &length);
    if (status != FIELDSCRIBE_MODBUS_OK) {
        return status;
    }
    receiver = fieldscribe_modbus_tcp_receiver(request, line->buffer, line->size);
    status = fieldscribe_modbus_exchange(line, request, reply, 7U, length, &receiver);
    return receiver.done ? fieldscribe_modbus_take_tcp(request, &line->buffer[7], receiver.length - 7U, reply)
                         : status;
}

/* Sends one request to a unit and receives the answer. */
static fieldscribe_modbus_status fieldscribe_modbus_call(
    fieldscribe_modbus_unit *unit, fieldscribe_modbus_request *request, uint16_t *words, size_t count)
{
    fieldscribe_modbus_reply reply = {words, count, 0U, 0U};
    fieldscribe_modbus_status status;
    request->late = unit->late;
#if defined(FIELDSCRIBE_MODBUS_OVER_TCP)
    request->transaction = unit->transaction;
    unit->transaction = (uint16_t)((unit->transaction + 1U) & 0xFFFFU);
#endif
    status = unit->ask(unit->line, request, &reply);
    unit->exception = reply.exception;
    unit->late = (status == FIELDSCRIBE_MODBUS_SHORT_FRAME) || (status == FIELDSCRIBE_MODBUS_NOISE) ||
        (status == FIELDSCRIBE_MODBUS_BAD_BYTE_COUNT) || (status == FIELDSCRIBE_MODBUS_ECHO_MISMATCH);
    return status;
}

fieldscribe_modbus_status fieldscribe_modbus_read_words(
    fieldscribe_modbus_unit *unit, const fieldscribe_modbus_reading *what, uint16_t *words, size_t count)
{
    fieldscribe_modbus_request request = fieldscribe_modbus_read(unit->number, what);
    return fieldscribe_modbus_call(unit, &request, words, count);
}

fieldscribe_modbus_status fieldscribe_modbus_write_words(
    fieldscribe_modbus_unit *unit, const fieldscribe_modbus_writing *what, const uint16_t *words, size_t count)
{
    fieldscribe_modbus_request request = fieldscribe_modbus_write(unit->number, what, words, count);
    return fieldscribe_modbus_call(unit, &request, NULL, 0U);
}

fieldscribe_modbus_status fieldscribe_modbus_read_word(
    fieldscribe_modbus_unit *unit, uint8_t function, uint16_t address, uint16_t *word)
{
    const fieldscribe_modbus_reading what = {function, address, 1U};
    return fieldscribe_modbus_read_words(unit, &what, word, 1U);
}

fieldscribe_modbus_status fieldscribe_modbus_write_word(
    fieldscribe_modbus_unit *unit, uint8_t function, uint16_t address, uint16_t word)
{
    const fieldscribe_modbus_writing what = {function, address, 1U};
    return fieldscribe_modbus_write_words(unit, &what, &word, 1U);
}

/* True if the row is one of the current selection. */
static bool fieldscribe_modbus_stands(
    const fieldscribe_modbus_selection *standing, const fieldscribe_modbus_selection *row)
{
    const fieldscribe_modbus_selection *at = standing;
    bool more = at != NULL;
    bool stands = false;
    while (more && !stands) {
        stands = (at->address == row->address) && (at->mask == row->mask) && (at->word == row->word);
        more = !at->last;
        ++at;
    }
    return stands;
}

/* Writes the bits of a row. */
static fieldscribe_modbus_status fieldscribe_modbus_write_selection(
    fieldscribe_modbus_unit *unit, const fieldscribe_modbus_selection *row)
{
    fieldscribe_modbus_status status = FIELDSCRIBE_MODBUS_OK;
    uint16_t word = 0U;
    if (row->read != 0U) {
        status = fieldscribe_modbus_read_word(unit, row->read, row->address, &word);
    }
    if (status == FIELDSCRIBE_MODBUS_OK) {
        word = (uint16_t)(((uint32_t)word & ~(uint32_t)row->mask) | row->word);
        status = fieldscribe_modbus_write_word(unit, row->write, row->address, word);
    }
    return status;
}

/* Records the selection after a call. */
static fieldscribe_modbus_status fieldscribe_modbus_selects(const fieldscribe_modbus_unit *unit,
    fieldscribe_modbus_selected *selected, const fieldscribe_modbus_selection *rows, fieldscribe_modbus_status status)
{
    selected->rows = (status == FIELDSCRIBE_MODBUS_OK) ? rows : NULL;
    selected->next = unit->transaction;
    return status;
}

fieldscribe_modbus_status fieldscribe_modbus_select(
    fieldscribe_modbus_unit *unit, fieldscribe_modbus_selected *selected, const fieldscribe_modbus_selection *rows)
{
    const fieldscribe_modbus_selection *const standing =
        (selected->next == unit->transaction) ? selected->rows : NULL;
    const fieldscribe_modbus_selection *row = rows;
    fieldscribe_modbus_status status = FIELDSCRIBE_MODBUS_OK;
    bool more = rows != NULL;
    while (more && (status == FIELDSCRIBE_MODBUS_OK)) {
        if (!fieldscribe_modbus_stands(standing, row)) {
            status = fieldscribe_modbus_write_selection(unit, row);
        }
        more = !row->last;
        ++row;
    }
    return fieldscribe_modbus_selects(unit, selected, (rows != NULL) ? rows : standing, status);
}

fieldscribe_modbus_status fieldscribe_modbus_read_selected(fieldscribe_modbus_unit *unit,
    fieldscribe_modbus_selected *selected, const fieldscribe_modbus_selection *rows,
    const fieldscribe_modbus_reading *what, uint16_t *words)
{
    fieldscribe_modbus_status status = fieldscribe_modbus_select(unit, selected, rows);
    if (status == FIELDSCRIBE_MODBUS_OK) {
        status = fieldscribe_modbus_read_words(unit, what, words, what->count);
        status = fieldscribe_modbus_selects(unit, selected, selected->rows, status);
    }
    return status;
}

fieldscribe_modbus_status fieldscribe_modbus_write_selected(fieldscribe_modbus_unit *unit,
    fieldscribe_modbus_selected *selected, const fieldscribe_modbus_selection *rows,
    const fieldscribe_modbus_writing *what, const uint16_t *words)
{
    fieldscribe_modbus_status status = fieldscribe_modbus_select(unit, selected, rows);
    if (status == FIELDSCRIBE_MODBUS_OK) {
        status = fieldscribe_modbus_write_words(unit, what, words, what->count);
        status = fieldscribe_modbus_selects(unit, selected, rows, status);
    }
    return status;
}

/* True if raw numbers of the layout (up to 32 bits) are signed. */
static bool fieldscribe_modbus_is_signed(const fieldscribe_layout *layout)
{
    return (layout->type == (uint8_t)FIELDSCRIBE_S8) || (layout->type == (uint8_t)FIELDSCRIBE_S16) ||
        (layout->type == (uint8_t)FIELDSCRIBE_S32) || (layout->type == (uint8_t)FIELDSCRIBE_LOW_FIRST_SIGNED);
}

/* Swaps the bytes of both words if the low one comes first. */
static void fieldscribe_modbus_in_order(const fieldscribe_layout *layout, uint16_t *words)
{
    if (layout->type >= (uint8_t)FIELDSCRIBE_LOW_FIRST) {
        words[0] = fieldscribe_exchanged(words[0]);
        words[1] = fieldscribe_exchanged(words[1]);
    }
}

fieldscribe_modbus_status fieldscribe_modbus_read_row(
    fieldscribe_modbus_unit *unit, const fieldscribe_modbus_row *row, int64_t *number)
{
    uint16_t words[2] = {0U, 0U};
    fieldscribe_modbus_status status = FIELDSCRIBE_MODBUS_BAD_FUNCTION;
    if ((row->profile == unit->line->profile) && (row->read != NULL) && (row->layout->words <= 2U)) {
        status = fieldscribe_modbus_read_words(unit, row->read, words, row->layout->words);
    }
    if (status == FIELDSCRIBE_MODBUS_OK) {
        int64_t raw;
        fieldscribe_modbus_in_order(row->layout, words);
        raw = fieldscribe_modbus_is_signed(row->layout) ? (int64_t)fieldscribe_layout_signed_field(row->layout, words)
                                                        : (int64_t)fieldscribe_layout_field(row->layout, words);
        *number = fieldscribe_divide((raw * row->divisor) - row->add, row->factor);
    }
    return status;
}

/* Stores the raw number in the words; false if it does not fit the layout. */
static bool fieldscribe_modbus_put_raw(const fieldscribe_layout *layout, int64_t raw, uint16_t *words)
{
    bool fits = false;
    fieldscribe_modbus_in_order(layout, words);
    if (fieldscribe_modbus_is_signed(layout)) {
        if ((raw >= INT32_MIN) && (raw <= INT32_MAX)) {
            fits = fieldscribe_layout_put_signed(layout, (int32_t)raw, words);
        }
    } else if ((raw >= 0) && (raw <= (int64_t)UINT32_MAX)) {
        fits = fieldscribe_layout_put(layout, (uint32_t)raw, words);
    } else {
        fits = false;
    }
    fieldscribe_modbus_in_order(layout, words);
    return fits;
}

fieldscribe_modbus_status fieldscribe_modbus_write_row(
    fieldscribe_modbus_unit *unit, const fieldscribe_modbus_row *row, int64_t number)
{
    uint16_t words[2] = {0U, 0U};
    fieldscribe_modbus_status status = FIELDSCRIBE_MODBUS_OK;
    if ((row->profile != unit->line->profile) || (row->write == NULL) || (row->layout->words > 2U)) {
        status = FIELDSCRIBE_MODBUS_BAD_FUNCTION;
    } else if ((number < row->low) || (number > row->high)) {
        status = FIELDSCRIBE_MODBUS_OUT_OF_RANGE;
    } else {
        const int64_t raw = fieldscribe_divide((number * row->factor) + row->add, row->divisor);
        if (row->layout->shares) {
            status = fieldscribe_modbus_read_words(unit, row->read, words, row->layout->words);
        }
        if (status == FIELDSCRIBE_MODBUS_OK) {
            status = fieldscribe_modbus_put_raw(row->layout, raw, words)
                ? fieldscribe_modbus_write_words(unit, row->write, words, row->layout->words)
                : FIELDSCRIBE_MODBUS_OUT_OF_RANGE;
        }
    }
    return status;
}

fieldscribe_modbus_status fieldscribe_modbus_read_row_at(fieldscribe_modbus_unit *unit,
    const fieldscribe_modbus_based_row *row, fieldscribe_modbus_base base, int64_t *number)
{
    fieldscribe_modbus_row moved = row->row;
    fieldscribe_modbus_reading read = {0U, 0U, 0U};
    if (moved.read != NULL) {
        read = fieldscribe_modbus_reading_at(base, moved.read);
        moved.read = &read;
    }
    return fieldscribe_modbus_read_row(unit, &moved, number);
}

fieldscribe_modbus_status fieldscribe_modbus_write_row_at(fieldscribe_modbus_unit *unit,
    const fieldscribe_modbus_based_row *row, fieldscribe_modbus_base base, int64_t number)
{
    fieldscribe_modbus_row moved = row->row;
    fieldscribe_modbus_reading read = {0U, 0U, 0U};
    fieldscribe_modbus_writing write = {0U, 0U, 0U};
    if (moved.read != NULL) {
        read = fieldscribe_modbus_reading_at(base, moved.read);
        moved.read = &read;
    }
    if (moved.write != NULL) {
        write = fieldscribe_modbus_writing_at(base, moved.write);
        moved.write = &write;
    }
    return fieldscribe_modbus_write_row(unit, &moved, number);
}

/* The most blocks that a search reads, so that a broken device cannot keep the line busy. */
#define FIELDSCRIBE_MODBUS_BLOCKS_MOST 256U

/* True if the words at this address are the marker of the chain; `status` is that of reading them. */
static bool fieldscribe_modbus_is_marked(fieldscribe_modbus_unit *unit, const fieldscribe_modbus_chain *chain,
    uint16_t place, fieldscribe_modbus_status *status)
{
    uint16_t words[FIELDSCRIBE_MODBUS_MARKER_MOST] = {0};
    const fieldscribe_modbus_reading what = {chain->function, place, chain->marker_words};
    size_t at;
    bool same;
    *status = fieldscribe_modbus_read_words(unit, &what, words, FIELDSCRIBE_MODBUS_MARKER_MOST);
    same = (*status == FIELDSCRIBE_MODBUS_OK) && (chain->marker_words <= FIELDSCRIBE_MODBUS_MARKER_MOST);
    for (at = 0U; same && (at < chain->marker_words); ++at) {
        same = words[at] == chain->marker[at];
    }
    return same;
}

fieldscribe_modbus_status fieldscribe_modbus_find(fieldscribe_modbus_unit *unit,
    const fieldscribe_modbus_chain *chain, uint16_t block, fieldscribe_modbus_base *base)
{
    fieldscribe_modbus_status status = FIELDSCRIBE_MODBUS_OK;
    uint32_t place = 0x10000U;
    size_t at;
    for (at = 0U; (at < chain->place_count) && (place == 0x10000U); ++at) {
        if (fieldscribe_modbus_is_marked(unit, chain, chain->places[at], &status)) {
            place = (uint32_t)chain->places[at] + chain->marker_words;
        } else if ((status != FIELDSCRIBE_MODBUS_OK) && (status != FIELDSCRIBE_MODBUS_EXCEPTION)) {
            return status;
        } else {
            /* no marker here */
        }
    }
    if (place == 0x10000U) {
        return FIELDSCRIBE_MODBUS_UNKNOWN_VALUE;
    }
    for (at = 0U; (at < FIELDSCRIBE_MODBUS_BLOCKS_MOST) && (place < 0xFFFFU); ++at) {
        uint16_t head[2] = {0U, 0U};
        const fieldscribe_modbus_reading what = {chain->function, (uint16_t)place, 2U};
        status = fieldscribe_modbus_read_words(unit, &what, head, 2U);
        if (status != FIELDSCRIBE_MODBUS_OK) {
            return status;
        }
        if (head[0] == chain->end) {
            return FIELDSCRIBE_MODBUS_UNKNOWN_VALUE;
        }
        if ((place + 1U + head[1]) > 0xFFFFU) {
            return FIELDSCRIBE_MODBUS_OVERFLOW;
        }
        if (head[0] == block) {
            base->start = (uint16_t)place;
            base->last = (uint16_t)(head[1] + 1U);
            return FIELDSCRIBE_MODBUS_OK;
        }
        place += 2U + (uint32_t)head[1];
    }
    return FIELDSCRIBE_MODBUS_OVERFLOW;
}

const uint16_t *fieldscribe_modbus_words_in(const fieldscribe_modbus_request *request,
    const fieldscribe_modbus_reply *reply, const fieldscribe_modbus_reading *point)
{
    uint32_t before;
    if ((reply->values == NULL) || (reply->count != request->count) || (point->function != request->function) ||
        (point->address < request->address) || (point->count > reply->count)) {
        return NULL;
    }
    before = (uint32_t)point->address - request->address;
    return (before > ((uint32_t)reply->count - point->count)) ? NULL : &reply->values[before];
}

#endif
