/*
 * Modbus frames: builds requests and reads answers, in the caller's buffers, over a serial line (RTU) or TCP.
 * Functions 01h 02h 03h 04h 05h 06h 08h 0Fh 10h. No heap; any bytes at any length are safe to parse. No state but the
 * caller's: everything may be called in an interrupt, with its own buffers, and a receiver from one place at a time.
 * SPDX-License-Identifier: 0BSD
 *
 * One C file of a program, and no other, says `#define FIELDSCRIBE_IMPLEMENTATION` before it includes this.
 */
#include "fieldscribe.h"
#include "fieldscribe_modbus_facts.h"

#ifndef FIELDSCRIBE_MODBUS_H
#define FIELDSCRIBE_MODBUS_H

#ifdef __cplusplus
extern "C" {
#endif

/* The longest frames there are. */
#define FIELDSCRIBE_MODBUS_RTU_MOST 256U
#define FIELDSCRIBE_MODBUS_TCP_MOST 260U

/* How many bytes fieldscribe_modbus_ask_rtu and _tcp receive at most for one answer: four of the longest frames. */
#define FIELDSCRIBE_MODBUS_ASK_MOST 1040U

typedef enum fieldscribe_modbus_status {
    FIELDSCRIBE_MODBUS_OK = 0,
    /* converting a value, of ..._read_POINT and ..._write_POINT alone: the numbers of fieldscribe_status */
    FIELDSCRIBE_MODBUS_OUT_OF_RANGE,
    FIELDSCRIBE_MODBUS_NOT_A_NUMBER,
    FIELDSCRIBE_MODBUS_UNKNOWN_VALUE,
    FIELDSCRIBE_MODBUS_ZERO_FACTOR,
    FIELDSCRIBE_MODBUS_NO_CASE,
    FIELDSCRIBE_MODBUS_OVERFLOW,
    FIELDSCRIBE_MODBUS_SPECIAL,
    /* building */
    FIELDSCRIBE_MODBUS_BAD_UNIT,         /* not a unit of this device, or a broadcast of what does not go to all */
    FIELDSCRIBE_MODBUS_BAD_FUNCTION,     /* the device does not know the function */
    FIELDSCRIBE_MODBUS_BAD_COUNT,        /* no items, too many, or no values for them */
    FIELDSCRIBE_MODBUS_BAD_ADDRESS,      /* the last item lies beyond FFFFh, or 08h has a sub-function but 0 */
    FIELDSCRIBE_MODBUS_BAD_VALUE,        /* a coil that is neither 0 nor 1 */
    FIELDSCRIBE_MODBUS_BAD_FRAMING,      /* the device speaks the other one alone: RTU or TCP */
    FIELDSCRIBE_MODBUS_BUFFER_TOO_SMALL, /* the caller's buffer does not hold the result */
    /* parsing */
    FIELDSCRIBE_MODBUS_SHORT_FRAME,
    FIELDSCRIBE_MODBUS_LONG_FRAME,
    FIELDSCRIBE_MODBUS_BAD_CRC,
    FIELDSCRIBE_MODBUS_BAD_PROTOCOL,
    FIELDSCRIBE_MODBUS_WRONG_TRANSACTION,
    FIELDSCRIBE_MODBUS_WRONG_UNIT,
    FIELDSCRIBE_MODBUS_WRONG_FUNCTION,
    FIELDSCRIBE_MODBUS_EXCEPTION,      /* the device refused; the reply holds its code */
    FIELDSCRIBE_MODBUS_BAD_BYTE_COUNT, /* a read that brings more or less than was asked for */
    FIELDSCRIBE_MODBUS_ECHO_MISMATCH,  /* a write that was answered with something else */
    FIELDSCRIBE_MODBUS_NOISE           /* of asking: bytes came, and no answer among them, or too many before it */
} fieldscribe_modbus_status;

typedef enum fieldscribe_modbus_framing {
    FIELDSCRIBE_MODBUS_RTU,
    FIELDSCRIBE_MODBUS_TCP
} fieldscribe_modbus_framing;

/*
 * What an answer says. The caller gives `values` with `room` items; `count` of them were stored: words, or 0 and 1, or
 * for 05h, 06h and 08h the value that was echoed, if there is room for it. `exception` is the device's code, or 0.
 */
typedef struct fieldscribe_modbus_reply {
    uint16_t *values;
    size_t room;
    uint16_t count;
    uint8_t exception;
} fieldscribe_modbus_reply;

typedef struct fieldscribe_modbus_request fieldscribe_modbus_request;

/* Puts a request into a frame, from the unit to the end of its data. */
typedef fieldscribe_modbus_status (*fieldscribe_modbus_putting)(const fieldscribe_modbus_profile *profile,
    const fieldscribe_modbus_request *request, uint8_t *buffer, size_t size, size_t *used);

/* Takes an answer, whose `pdu` starts at the function, that of the request, and has `size` bytes (at least 2). */
typedef fieldscribe_modbus_status (*fieldscribe_modbus_taking)(const fieldscribe_modbus_request *request,
    const uint8_t *pdu, size_t size, fieldscribe_modbus_reply *reply);

/*
 * A request, as fieldscribe_modbus_read, _write and _send make it. `values` has `given` items, at least `count` for
 * functions that write: words, or 0 and 1 for coils; 05h, 06h and 08h carry `first`, which was the first of them. For
 * 08h, which is written, too, `address` is the sub-function (0) and `first` the test data. `transaction` is used by TCP
 * alone. It brings what it needs to be put and answered, so that a program links what it asks for alone.
 */
struct fieldscribe_modbus_request {
    uint16_t transaction;
    uint16_t first;
    uint8_t unit;
    uint8_t function;
    uint16_t address;
    uint16_t count;
    const uint16_t *values;
    size_t given;
    fieldscribe_modbus_putting put;
    fieldscribe_modbus_taking take;
};

/* What requests are put and answered with: reads of words and of bits, and writes. */

fieldscribe_modbus_status fieldscribe_modbus_put_reading(const fieldscribe_modbus_profile *profile,
    const fieldscribe_modbus_request *request, uint8_t *buffer, size_t size, size_t *used);

fieldscribe_modbus_status fieldscribe_modbus_put_writing(const fieldscribe_modbus_profile *profile,
    const fieldscribe_modbus_request *request, uint8_t *buffer, size_t size, size_t *used);

fieldscribe_modbus_status fieldscribe_modbus_take_words(const fieldscribe_modbus_request *request, const uint8_t *pdu,
    size_t size, fieldscribe_modbus_reply *reply);

fieldscribe_modbus_status fieldscribe_modbus_take_bits(const fieldscribe_modbus_request *request, const uint8_t *pdu,
    size_t size, fieldscribe_modbus_reply *reply);

fieldscribe_modbus_status fieldscribe_modbus_take_echo(const fieldscribe_modbus_request *request, const uint8_t *pdu,
    size_t size, fieldscribe_modbus_reply *reply);

/* Functions that read coils or discrete inputs. */
static inline bool fieldscribe_modbus_reads_bits(uint8_t function)
{
    return (function == 0x01U) || (function == 0x02U);
}

/* The request that reads a point or a block. */
FIELDSCRIBE_CHECKED static inline fieldscribe_modbus_request fieldscribe_modbus_read(
    uint8_t unit, const fieldscribe_modbus_reading *what)
{
    const fieldscribe_modbus_request request = {0U, 0U, unit, what->function, what->address, what->count, NULL, 0U,
        &fieldscribe_modbus_put_reading,
        fieldscribe_modbus_reads_bits(what->function) ? &fieldscribe_modbus_take_bits : &fieldscribe_modbus_take_words};
    return request;
}

/*
 * The request that writes a point, with `given` words (or coils), which no frame is built of if they are too few. One
 * alone (05h, 06h, 08h) is copied; several stay the caller's and are read when the frame is built, and never after.
 */
FIELDSCRIBE_CHECKED static inline fieldscribe_modbus_request fieldscribe_modbus_write(
    uint8_t unit, const fieldscribe_modbus_writing *what, const uint16_t *values, size_t given)
{
    const uint16_t first = ((values != NULL) && (given > 0U)) ? values[0] : 0U;
    const fieldscribe_modbus_request request = {0U, first, unit, what->function, what->address, what->count, values,
        given, &fieldscribe_modbus_put_writing, &fieldscribe_modbus_take_echo};
    return request;
}

/* The request of a command. */
FIELDSCRIBE_CHECKED static inline fieldscribe_modbus_request fieldscribe_modbus_send(
    uint8_t unit, const fieldscribe_modbus_command *command)
{
    return fieldscribe_modbus_write(unit, &command->write, &command->value, 1U);
}

/* The bytes of the answer to a request, unless the device refuses it; 0 where nobody answers: it goes to all units. */
FIELDSCRIBE_CHECKED uint32_t fieldscribe_modbus_reply_length(const fieldscribe_modbus_profile *profile,
    fieldscribe_modbus_framing framing, const fieldscribe_modbus_request *request);

/*
 * How many bytes of the answer are still to be waited for when `length` of them have come into a buffer of `size`, and
 * never more than fit; 0 when it is whole, and where nobody answers. As soon as an answer says how long it is, that
 * counts, so that one of another length than was asked for is received as a whole, and refused.
 */
FIELDSCRIBE_CHECKED uint32_t fieldscribe_modbus_left(const fieldscribe_modbus_profile *profile,
    fieldscribe_modbus_framing framing, const fieldscribe_modbus_request *request, const uint8_t *buffer, size_t size,
    size_t length);

/*
 * What picks the answer to one request out of bytes as they come. The answer so far is in the first `length` bytes of
 * the caller's `buffer`, all of it when it is `done`. `dropped` counts bytes that were no part of it: noise, an answer
 * to something else, a wrong checksum. If nothing came and nothing was dropped, nobody answers. An answer of another
 * length than was asked for is received, too, where it fits into the buffer; parsing says what is wrong with it.
 */
typedef struct fieldscribe_modbus_receiver {
    uint8_t *buffer;
    size_t size;
    size_t length;
    size_t dropped;
    size_t next; /* so many bytes say more about the answer */
    bool done;
    uint8_t unit;
    uint8_t function;
    uint16_t transaction;
    size_t (*begun)(const struct fieldscribe_modbus_receiver *receiver, const uint8_t *bytes, size_t length);
} fieldscribe_modbus_receiver;

/*
 * A receiver for the answer to a request, which it does not need again. It is done at once where nobody answers, and
 * where `size` bytes are too few for the answer; parsing then says SHORT_FRAME.
 */

FIELDSCRIBE_CHECKED fieldscribe_modbus_receiver fieldscribe_modbus_await_rtu(const fieldscribe_modbus_profile *profile,
    const fieldscribe_modbus_request *request, uint8_t *buffer, size_t size);

FIELDSCRIBE_CHECKED fieldscribe_modbus_receiver fieldscribe_modbus_await_tcp(const fieldscribe_modbus_profile *profile,
    const fieldscribe_modbus_request *request, uint8_t *buffer, size_t size);

/*
 * Gives a receiver bytes, one or many, and says how many of them it took: all, but for those that came behind the whole
 * answer. Those belong to the next one.
 */
size_t fieldscribe_modbus_receive(fieldscribe_modbus_receiver *receiver, const uint8_t *bytes, size_t count);

/*
 * Tells a receiver that the line is silent: an answer that is not done may stand behind noise that looked like the
 * beginning of a longer one.
 */
void fieldscribe_modbus_silent(fieldscribe_modbus_receiver *receiver);

/* The frame of a request in `buffer`; `length` says how many of its `size` bytes were used, 0 on an error. */

FIELDSCRIBE_CHECKED fieldscribe_modbus_status fieldscribe_modbus_build_rtu(const fieldscribe_modbus_profile *profile,
    const fieldscribe_modbus_request *request, uint8_t *buffer, size_t size, size_t *length);

FIELDSCRIBE_CHECKED fieldscribe_modbus_status fieldscribe_modbus_build_tcp(const fieldscribe_modbus_profile *profile,
    const fieldscribe_modbus_request *request, uint8_t *buffer, size_t size, size_t *length);

/* Reads the answer to a request. */

FIELDSCRIBE_CHECKED fieldscribe_modbus_status fieldscribe_modbus_parse_rtu(
    const fieldscribe_modbus_request *request, const uint8_t *bytes, size_t length, fieldscribe_modbus_reply *reply);

FIELDSCRIBE_CHECKED fieldscribe_modbus_status fieldscribe_modbus_parse_tcp(
    const fieldscribe_modbus_request *request, const uint8_t *bytes, size_t length, fieldscribe_modbus_reply *reply);

/*
 * The same without unit, head and checksum, for a stack that adds and removes them: a PDU, which begins with the
 * function. To build one, `buffer` needs room for one byte more.
 */
FIELDSCRIBE_CHECKED fieldscribe_modbus_status fieldscribe_modbus_build_pdu(const fieldscribe_modbus_profile *profile,
    const fieldscribe_modbus_request *request, uint8_t *buffer, size_t size, size_t *length);

FIELDSCRIBE_CHECKED fieldscribe_modbus_status fieldscribe_modbus_parse_pdu(
    const fieldscribe_modbus_request *request, const uint8_t *pdu, size_t length, fieldscribe_modbus_reply *reply);

/*
 * The same by framing: one that is constant links its own functions alone.
 *
 * Reading a point over a serial line; `words` has as many as the point, and `buffer` room for the longest answer.
 * `receive` is yours: false when the line stays silent.
 *
 *     const fieldscribe_modbus_rw *const point = &hitachi_l200_base_frequency_frame;
 *     uint8_t buffer[FIELDSCRIBE_MODBUS_RTU_MOST];
 *     uint16_t words[1];
 *     fieldscribe_modbus_reply reply = {words, FIELDSCRIBE_COUNT(words), 0U, 0U};
 *     request = fieldscribe_modbus_read(unit, &point->read);
 *     status = fieldscribe_modbus_build(&profile, FIELDSCRIBE_MODBUS_RTU, &request, buffer, sizeof buffer, &length);
 *     discard();      (when RTU was silent for 3.5 characters; a late answer would be taken for this one)
 *     send(buffer, length);      (where you hear yourself, on RS-485, drop these `length` bytes again)
 *     receiver = fieldscribe_modbus_await(&profile, FIELDSCRIBE_MODBUS_RTU, &request, buffer, sizeof buffer);
 *     while ((!receiver.done) && receive(&byte)) {      (noise before the answer is dropped)
 *         (void)fieldscribe_modbus_receive(&receiver, &byte, 1U);
 *     }
 *     fieldscribe_modbus_silent(&receiver);      (the answer may stand behind noise that looks like a longer one)
 *     status = fieldscribe_modbus_parse(FIELDSCRIBE_MODBUS_RTU, &request, buffer, receiver.length, &reply);
 *     fits = fieldscribe_take_u16(point->layout, words, reply.count, &raw);
 *
 * SHORT_FRAME says that no answer came. Whatever went wrong: wait until the line is silent before you ask again, or a
 * late answer is taken for the next one. Where you can wait for so many bytes at once, and there is no noise (TCP),
 * fieldscribe_modbus_left tells how many.
 *
 * Reading a block (..._BLOCK_MOST words hold any of the device), in the same way: for each of its points,
 * in = fieldscribe_modbus_words_in(&request, &reply, &point->read), then
 * fieldscribe_take_u16(point->layout, in, point->read.count, &raw), which is false where `in` is NULL.
 *
 * Writing one: ..._encode says whether the number may be written, and a special code (..._INACTIVE) is such a raw
 * number as it stands; fieldscribe_put_u16(point->layout, raw, words, count) puts any that fits into the words, then
 * fieldscribe_modbus_write(unit, &point->write, words, count). Its answer is parsed, too: OK says that the device took
 * it, and the reply may be {NULL, 0U, 0U, 0U}. Nobody answers what goes to all units: nothing is left to be received,
 * so skip the parsing.
 * A point that only some bits of a word are has `update` for `write`: read its word first, put the bits, write it back.
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
 * A line that requests go over. `send` waits until the line is silent (over RTU for 3.5 characters, or the device takes
 * no notice of the request), drops what has come in and sends; `receive` waits for a byte, and is false when none comes
 * within so many milliseconds. Both are yours and get `context`. `buffer` has room for the longest request and answer.
 */
typedef struct fieldscribe_modbus_line {
    const fieldscribe_modbus_profile *profile;
    uint8_t *buffer;
    size_t size;
    void (*send)(void *context, const uint8_t *bytes, size_t length);
    bool (*receive)(void *context, uint32_t milliseconds, uint8_t *byte);
    void *context;
    uint32_t answer_ms; /* how long an answer may take to begin; it has that time once more after noise */
    uint32_t pause_ms;  /* how long a pause within an answer may be */
} fieldscribe_modbus_line;

/*
 * Sends a request and waits for its answer: building, sending, receiving and parsing in one. SHORT_FRAME says that none
 * came, or its beginning alone; NOISE that other bytes came (an answer with a wrong checksum, of another unit, at
 * another baud rate), or ASK_MOST bytes with no answer in them. Nothing is sent where `buffer` or the reply is too
 * small for the answer (BUFFER_TOO_SMALL). What goes to all units is OK when it is sent, as nobody answers. Over TCP
 * give each request another `transaction`: by that a late answer is told from the one waited for.
 */

FIELDSCRIBE_CHECKED fieldscribe_modbus_status fieldscribe_modbus_ask_rtu(const fieldscribe_modbus_line *line,
    const fieldscribe_modbus_request *request, fieldscribe_modbus_reply *reply);

FIELDSCRIBE_CHECKED fieldscribe_modbus_status fieldscribe_modbus_ask_tcp(const fieldscribe_modbus_line *line,
    const fieldscribe_modbus_request *request, fieldscribe_modbus_reply *reply);

/*
 * A unit on a line: the part of a handle, such as `hitachi_l200_device`, that ..._read_POINT and ..._write_POINT use.
 * Each call sends one request and waits for its answer; a point that shares its word is read before it is written.
 */
typedef struct fieldscribe_modbus_unit {
    const fieldscribe_modbus_line *line;
    fieldscribe_modbus_status (*ask)(const fieldscribe_modbus_line *line, const fieldscribe_modbus_request *request,
        fieldscribe_modbus_reply *reply); /* fieldscribe_modbus_ask_rtu or _tcp */
    uint8_t number;
    uint8_t exception;    /* the device's code if the last call returned EXCEPTION, else 0 */
    uint16_t transaction; /* of the next request; over TCP alone */
} fieldscribe_modbus_unit;

/* One word (or coil) of a unit. */
FIELDSCRIBE_CHECKED fieldscribe_modbus_status fieldscribe_modbus_read_word(
    fieldscribe_modbus_unit *unit, uint8_t function, uint16_t address, uint16_t *word);

FIELDSCRIBE_CHECKED fieldscribe_modbus_status fieldscribe_modbus_write_word(
    fieldscribe_modbus_unit *unit, uint8_t function, uint16_t address, uint16_t word);

/* Several words (or coils) of a unit, of a point or a block: `words` has `count` of them. */
FIELDSCRIBE_CHECKED fieldscribe_modbus_status fieldscribe_modbus_read_words(
    fieldscribe_modbus_unit *unit, const fieldscribe_modbus_reading *what, uint16_t *words, size_t count);

FIELDSCRIBE_CHECKED fieldscribe_modbus_status fieldscribe_modbus_write_words(
    fieldscribe_modbus_unit *unit, const fieldscribe_modbus_writing *what, const uint16_t *words, size_t count);

/*
 * Reads the number of a row. BAD_FUNCTION says that nothing was sent, because the row is of another device than the
 * unit, or cannot be read, or written; OUT_OF_RANGE that the number may not be written.
 */
FIELDSCRIBE_CHECKED fieldscribe_modbus_status fieldscribe_modbus_read_row(
    fieldscribe_modbus_unit *unit, const fieldscribe_modbus_row *row, int64_t *number);

/* Writes the number of a row; a point that shares its word is read first. */
FIELDSCRIBE_CHECKED fieldscribe_modbus_status fieldscribe_modbus_write_row(
    fieldscribe_modbus_unit *unit, const fieldscribe_modbus_row *row, int64_t number);

/* Start of a function that reads or writes a point. */
#define FIELDSCRIBE_MODBUS_CALL FIELDSCRIBE_CHECKED static inline fieldscribe_modbus_status

/* The status of a conversion. */
FIELDSCRIBE_MODBUS_CALL fieldscribe_modbus_converted(fieldscribe_status status)
{
    return (fieldscribe_modbus_status)status;
}

/*
 * Bodies of these functions, which have a `device`. `number` and `decoded` take `word` (or `words`), `encoded` stores
 * in `raw`, from which `bits` (or `split`) makes what is written.
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

#define FIELDSCRIBE_MODBUS_READ_WORDS(frame, count, to, number) \
    uint16_t words[count] = {0}; \
    const fieldscribe_modbus_status status = \
        fieldscribe_modbus_read_words(&device->unit, &(frame).read, words, count); \
    if (status == FIELDSCRIBE_MODBUS_OK) { \
        *(to) = (number); \
    } \
    return status;

#define FIELDSCRIBE_MODBUS_DECODE_WORDS(frame, count, decoded) \
    uint16_t words[count] = {0}; \
    const fieldscribe_modbus_status status = \
        fieldscribe_modbus_read_words(&device->unit, &(frame).read, words, count); \
    return (status == FIELDSCRIBE_MODBUS_OK) ? fieldscribe_modbus_converted(decoded) : status;

#define FIELDSCRIBE_MODBUS_WRITE_WORD(function, address, type, encoded, bits) \
    type raw = (type)0; \
    const fieldscribe_modbus_status status = fieldscribe_modbus_converted(encoded); \
    return (status == FIELDSCRIBE_MODBUS_OK) ? fieldscribe_modbus_write_word(&device->unit, function, address, bits) \
                                             : status;

#define FIELDSCRIBE_MODBUS_WRITE_WORDS(frame, count, type, encoded, split) \
    type raw = (type)0; \
    uint16_t words[count]; \
    const fieldscribe_modbus_status status = fieldscribe_modbus_converted(encoded); \
    split; \
    return (status == FIELDSCRIBE_MODBUS_OK) \
        ? fieldscribe_modbus_write_words(&device->unit, &(frame).write, words, count) : status;

#define FIELDSCRIBE_MODBUS_UPDATE_WORD(from, from_address, function, address, type, encoded, bits) \
    type raw = (type)0; \
    uint16_t word = 0U; \
    fieldscribe_modbus_status status = fieldscribe_modbus_converted(encoded); \
    if (status == FIELDSCRIBE_MODBUS_OK) { \
        status = fieldscribe_modbus_read_word(&device->unit, from, from_address, &word); \
    } \
    return (status == FIELDSCRIBE_MODBUS_OK) ? fieldscribe_modbus_write_word(&device->unit, function, address, bits) \
                                             : status;

/* The words of a point, or its coils, in what a block's request brought; NULL when that does not hold all of them. */
FIELDSCRIBE_CHECKED const uint16_t *fieldscribe_modbus_words_in(const fieldscribe_modbus_request *request,
    const fieldscribe_modbus_reply *reply, const fieldscribe_modbus_reading *point);

/* The checksum of RTU frames; its low byte travels first. */
FIELDSCRIBE_CHECKED uint16_t fieldscribe_modbus_crc(const uint8_t *bytes, size_t length);

#ifdef __cplusplus
}
#endif

#endif

/* ---- The one definition ---- */

#if defined(FIELDSCRIBE_IMPLEMENTATION) && !defined(FIELDSCRIBE_MODBUS_IMPLEMENTED)
#define FIELDSCRIBE_MODBUS_IMPLEMENTED

#ifdef __cplusplus
extern "C" {
#endif

uint16_t fieldscribe_modbus_crc(const uint8_t *bytes, size_t length)
{
    static const uint16_t nibbles[16] = {0x0000U, 0xCC01U, 0xD801U, 0x1400U, 0xF001U, 0x3C00U, 0x2800U, 0xE401U,
        0xA001U, 0x6C00U, 0x7800U, 0xB401U, 0x5000U, 0x9C01U, 0x8801U, 0x4400U};
    uint16_t crc = 0xFFFFU;
    size_t at;
    for (at = 0U; at < length; ++at) {
        crc = (uint16_t)(crc ^ bytes[at]);
        crc = (uint16_t)((uint16_t)(crc >> 4) ^ nibbles[crc & 0xFU]);
        crc = (uint16_t)((uint16_t)(crc >> 4) ^ nibbles[crc & 0xFU]);
    }
    return crc;
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
    return (function >= 0x01U) && (function <= 0x04U);
}

/* The bytes of an answer that begins with this code and this byte, from its code on; 0 if it answers something else. */
static size_t fieldscribe_modbus_pdu(uint8_t function, uint8_t code, uint8_t count)
{
    size_t bytes = 0U;
    if (code == (function | 0x80U)) {
        bytes = 2U;
    } else if (code == function) {
        bytes = fieldscribe_modbus_reads(function) ? (2U + (size_t)count) : 5U;
    } else {
        /* none */
    }
    return bytes;
}

/* 05h carries FF00h for on; every other single value travels as it is. */
static uint16_t fieldscribe_modbus_single(const fieldscribe_modbus_request *request)
{
    if (request->function == 0x05U) {
        return (request->first != 0U) ? 0xFF00U : 0x0000U;
    }
    return request->first;
}

/* What the device knows of a function; NULL when it does not know it. */
static const fieldscribe_modbus_function *fieldscribe_modbus_find(
    const fieldscribe_modbus_profile *profile, uint8_t code)
{
    size_t at;
    for (at = 0U; at < profile->function_count; ++at) {
        if (profile->functions[at].code == code) {
            return &profile->functions[at];
        }
    }
    return NULL;
}

/* Whether this device takes the request, whatever it writes. */
static fieldscribe_modbus_status fieldscribe_modbus_allows(
    const fieldscribe_modbus_profile *profile, const fieldscribe_modbus_request *request)
{
    const fieldscribe_modbus_function *const known = fieldscribe_modbus_find(profile, request->function);
    bool to_one;
    if (known == NULL) {
        return FIELDSCRIBE_MODBUS_BAD_FUNCTION;
    }
    to_one = (request->unit >= profile->first_unit) && (request->unit <= profile->last_unit);
    if ((request->unit == profile->broadcast) ? !known->broadcast : !to_one) {
        return FIELDSCRIBE_MODBUS_BAD_UNIT;
    }
    if ((request->count == 0U) || (request->count > known->most)) {
        return FIELDSCRIBE_MODBUS_BAD_COUNT;
    }
    if (((uint32_t)request->address + request->count) > 0x10000U) {
        return FIELDSCRIBE_MODBUS_BAD_ADDRESS;
    }
    return FIELDSCRIBE_MODBUS_OK;
}

/* Whether it takes what is written, too. */
static fieldscribe_modbus_status fieldscribe_modbus_allows_values(const fieldscribe_modbus_request *request)
{
    const uint8_t function = request->function;
    uint16_t at;
    if ((request->values == NULL) || (request->given == 0U) || (request->given < request->count)) {
        return FIELDSCRIBE_MODBUS_BAD_COUNT;
    }
    if ((function == 0x08U) && (request->address != 0U)) {
        return FIELDSCRIBE_MODBUS_BAD_ADDRESS;
    }
    if ((function == 0x05U) && (request->first > 1U)) {
        return FIELDSCRIBE_MODBUS_BAD_VALUE;
    }
    if (function == 0x0FU) {
        for (at = 0U; at < request->count; ++at) {
            if (request->values[at] > 1U) {
                return FIELDSCRIBE_MODBUS_BAD_VALUE;
            }
        }
    }
    return FIELDSCRIBE_MODBUS_OK;
}

/* How many data bytes 0Fh and 10h carry. */
static uint32_t fieldscribe_modbus_data_bytes(
    const fieldscribe_modbus_profile *profile, const fieldscribe_modbus_request *request)
{
    uint32_t bytes = (uint32_t)request->count * 2U;
    if (request->function == 0x0FU) {
        bytes = ((uint32_t)request->count + 7U) / 8U;
        bytes += profile->pads_coil_bytes ? (bytes % 2U) : 0U;
    }
    return bytes;
}

/* Eight coils from one of them on, as a byte; 0 for those behind the last. */
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

/* Writes the data of 0Fh and 10h behind their byte count. */
static void fieldscribe_modbus_put_values(
    const fieldscribe_modbus_request *request, uint8_t *data, uint32_t data_bytes)
{
    uint32_t at;
    if (request->function == 0x10U) {
        for (at = 0U; at < (data_bytes / 2U); ++at) {
            fieldscribe_modbus_put(data + (2U * at), request->values[at]);
        }
        return;
    }
    for (at = 0U; at < data_bytes; ++at) {
        data[at] = fieldscribe_modbus_coils(request, 8U * at);
    }
}

/* The six bytes with which all requests begin. */
static void fieldscribe_modbus_put_head(const fieldscribe_modbus_request *request, uint16_t number, uint8_t *buffer)
{
    buffer[0] = request->unit;
    buffer[1] = request->function;
    fieldscribe_modbus_put(&buffer[2], request->address);
    fieldscribe_modbus_put(&buffer[4], number);
}

fieldscribe_modbus_status fieldscribe_modbus_put_reading(const fieldscribe_modbus_profile *profile,
    const fieldscribe_modbus_request *request, uint8_t *buffer, size_t size, size_t *used)
{
    fieldscribe_modbus_status status = FIELDSCRIBE_MODBUS_BAD_FUNCTION;
    if (fieldscribe_modbus_reads(request->function)) {
        status = fieldscribe_modbus_allows(profile, request);
    }
    if (status != FIELDSCRIBE_MODBUS_OK) {
        return status;
    }
    if (size < 6U) {
        return FIELDSCRIBE_MODBUS_BUFFER_TOO_SMALL;
    }
    fieldscribe_modbus_put_head(request, request->count, buffer);
    *used = 6U;
    return FIELDSCRIBE_MODBUS_OK;
}

fieldscribe_modbus_status fieldscribe_modbus_put_writing(const fieldscribe_modbus_profile *profile,
    const fieldscribe_modbus_request *request, uint8_t *buffer, size_t size, size_t *used)
{
    const uint8_t function = request->function;
    const bool several = (function == 0x0FU) || (function == 0x10U);
    const bool single = (function == 0x05U) || (function == 0x06U) || (function == 0x08U);
    const size_t before = several ? 7U : 6U; /* the data */
    fieldscribe_modbus_status status = FIELDSCRIBE_MODBUS_BAD_FUNCTION;
    uint32_t data_bytes = 0U;
    if (several || single) {
        status = fieldscribe_modbus_allows(profile, request);
    }
    if (status == FIELDSCRIBE_MODBUS_OK) {
        status = fieldscribe_modbus_allows_values(request);
    }
    if (status != FIELDSCRIBE_MODBUS_OK) {
        return status;
    }
    if (several) {
        data_bytes = fieldscribe_modbus_data_bytes(profile, request);
    }
    if ((data_bytes > 0xFFU) || (size < before) || (data_bytes > (size - before))) {
        return FIELDSCRIBE_MODBUS_BUFFER_TOO_SMALL;
    }
    fieldscribe_modbus_put_head(request, several ? request->count : fieldscribe_modbus_single(request), buffer);
    if (several) {
        buffer[6] = (uint8_t)data_bytes;
        fieldscribe_modbus_put_values(request, &buffer[7], data_bytes);
    }
    *used = before + (size_t)data_bytes;
    return FIELDSCRIBE_MODBUS_OK;
}

/* The request from the unit to the end of its data; one that none of the functions above made has no way there. */
static fieldscribe_modbus_status fieldscribe_modbus_put_request(const fieldscribe_modbus_profile *profile,
    const fieldscribe_modbus_request *request, uint8_t *buffer, size_t size, size_t *used)
{
    return (request->put == NULL) ? FIELDSCRIBE_MODBUS_BAD_FUNCTION
                                  : request->put(profile, request, buffer, size, used);
}

fieldscribe_modbus_status fieldscribe_modbus_build_rtu(const fieldscribe_modbus_profile *profile,
    const fieldscribe_modbus_request *request, uint8_t *buffer, size_t size, size_t *length)
{
    fieldscribe_modbus_status status = FIELDSCRIBE_MODBUS_BAD_FRAMING;
    size_t used = 0U;
    *length = 0U;
    if (profile->rtu) {
        status = fieldscribe_modbus_put_request(profile, request, buffer, (size > 2U) ? (size - 2U) : 0U, &used);
    }
    if (status == FIELDSCRIBE_MODBUS_OK) {
        const uint16_t crc = fieldscribe_modbus_crc(buffer, used);
        buffer[used] = (uint8_t)(crc & 0xFFU);
        buffer[used + 1U] = (uint8_t)(crc >> 8);
        *length = used + 2U;
    }
    return status;
}

fieldscribe_modbus_status fieldscribe_modbus_build_tcp(const fieldscribe_modbus_profile *profile,
    const fieldscribe_modbus_request *request, uint8_t *buffer, size_t size, size_t *length)
{
    fieldscribe_modbus_status status = FIELDSCRIBE_MODBUS_BAD_FRAMING;
    size_t used = 0U;
    *length = 0U;
    if (profile->tcp) {
        uint8_t *const behind = &buffer[(size > 6U) ? 6U : 0U]; /* the head */
        status = fieldscribe_modbus_put_request(profile, request, behind, (size > 6U) ? (size - 6U) : 0U, &used);
    }
    if (status == FIELDSCRIBE_MODBUS_OK) {
        fieldscribe_modbus_put(buffer, request->transaction);
        fieldscribe_modbus_put(&buffer[2], 0U);
        fieldscribe_modbus_put(&buffer[4], (uint16_t)used);
        *length = used + 6U;
    }
    return status;
}

fieldscribe_modbus_status fieldscribe_modbus_build_pdu(const fieldscribe_modbus_profile *profile,
    const fieldscribe_modbus_request *request, uint8_t *buffer, size_t size, size_t *length)
{
    size_t used = 0U;
    size_t at;
    const fieldscribe_modbus_status status = fieldscribe_modbus_put_request(profile, request, buffer, size, &used);
    *length = 0U;
    if ((status == FIELDSCRIBE_MODBUS_OK) && (used > 0U)) {
        *length = used - 1U;
        for (at = 0U; at < *length; ++at) { /* over the unit */
            buffer[at] = buffer[at + 1U];
        }
    }
    return status;
}

/* How many values there is room for in a reply. */
static size_t fieldscribe_modbus_room(const fieldscribe_modbus_reply *reply)
{
    return (reply->values == NULL) ? 0U : reply->room;
}

fieldscribe_modbus_status fieldscribe_modbus_take_words(const fieldscribe_modbus_request *request,
    const uint8_t *pdu, size_t size, fieldscribe_modbus_reply *reply)
{
    const uint16_t count = request->count;
    const uint8_t bytes = pdu[1];
    uint16_t at;
    if ((size != (2U + (size_t)bytes)) || ((bytes % 2U) != 0U) || (count != (bytes / 2U))) {
        return FIELDSCRIBE_MODBUS_BAD_BYTE_COUNT;
    }
    if (fieldscribe_modbus_room(reply) < count) {
        return FIELDSCRIBE_MODBUS_BUFFER_TOO_SMALL;
    }
    for (at = 0U; at < count; ++at) {
        reply->values[at] = fieldscribe_modbus_get(&pdu[2U + (2U * (size_t)at)]);
    }
    reply->count = count;
    return FIELDSCRIBE_MODBUS_OK;
}

fieldscribe_modbus_status fieldscribe_modbus_take_bits(const fieldscribe_modbus_request *request,
    const uint8_t *pdu, size_t size, fieldscribe_modbus_reply *reply)
{
    const uint16_t count = request->count;
    const uint8_t bytes = pdu[1];
    uint32_t most;
    uint16_t at;
    if (size != (2U + (size_t)bytes)) {
        return FIELDSCRIBE_MODBUS_BAD_BYTE_COUNT;
    }
    most = (uint32_t)bytes * 8U;
    if ((count > most) || (((uint32_t)count + 7U) < most)) {
        return FIELDSCRIBE_MODBUS_BAD_BYTE_COUNT;
    }
    if (fieldscribe_modbus_room(reply) < count) {
        return FIELDSCRIBE_MODBUS_BUFFER_TOO_SMALL;
    }
    for (at = 0U; at < count; ++at) {
        reply->values[at] = (uint16_t)(((uint32_t)pdu[2U + (at / 8U)] >> (at % 8U)) & 1U);
    }
    reply->count = count;
    return FIELDSCRIBE_MODBUS_OK;
}

/* What was written comes back, or how many items were. */
fieldscribe_modbus_status fieldscribe_modbus_take_echo(const fieldscribe_modbus_request *request,
    const uint8_t *pdu, size_t size, fieldscribe_modbus_reply *reply)
{
    const bool several = (request->function == 0x0FU) || (request->function == 0x10U);
    uint16_t number = request->count;
    if (size != 5U) {
        return (size < 5U) ? FIELDSCRIBE_MODBUS_SHORT_FRAME : FIELDSCRIBE_MODBUS_LONG_FRAME;
    }
    if (!several) {
        if (request->given == 0U) {
            return FIELDSCRIBE_MODBUS_ECHO_MISMATCH;
        }
        number = fieldscribe_modbus_single(request);
    }
    if ((fieldscribe_modbus_get(pdu + 1) != request->address) || (fieldscribe_modbus_get(pdu + 3) != number)) {
        return FIELDSCRIBE_MODBUS_ECHO_MISMATCH;
    }
    if ((!several) && (fieldscribe_modbus_room(reply) > 0U)) {
        reply->values[0] = request->first;
        reply->count = 1U;
    }
    return FIELDSCRIBE_MODBUS_OK;
}

/* Reads an answer of the right unit from its function on, which is that of the request or refuses it. */
static fieldscribe_modbus_status fieldscribe_modbus_take_answer(const fieldscribe_modbus_request *request,
    const uint8_t *pdu, size_t size, fieldscribe_modbus_reply *reply)
{
    if (pdu[0] != request->function) {
        if (size > 2U) {
            return FIELDSCRIBE_MODBUS_LONG_FRAME;
        }
        reply->exception = pdu[1];
        return FIELDSCRIBE_MODBUS_EXCEPTION;
    }
    return (request->take == NULL) ? FIELDSCRIBE_MODBUS_WRONG_FUNCTION : request->take(request, pdu, size, reply);
}

/* Nothing has come yet. */
static void fieldscribe_modbus_clear(fieldscribe_modbus_reply *reply)
{
    reply->count = 0U;
    reply->exception = 0U;
}

fieldscribe_modbus_status fieldscribe_modbus_parse_rtu(
    const fieldscribe_modbus_request *request, const uint8_t *bytes, size_t length, fieldscribe_modbus_reply *reply)
{
    size_t pdu;
    fieldscribe_modbus_clear(reply);
    if (length < 5U) {
        return FIELDSCRIBE_MODBUS_SHORT_FRAME;
    }
    pdu = fieldscribe_modbus_pdu(request->function, bytes[1], bytes[2]);
    if ((pdu != 0U) && (length != (pdu + 3U))) {
        return (length < (pdu + 3U)) ? FIELDSCRIBE_MODBUS_SHORT_FRAME : FIELDSCRIBE_MODBUS_LONG_FRAME;
    }
    if (fieldscribe_modbus_crc(bytes, length) != 0U) { /* with its checksum behind it, every frame has the checksum 0 */
        return FIELDSCRIBE_MODBUS_BAD_CRC;
    }
    if (bytes[0] != request->unit) {
        return FIELDSCRIBE_MODBUS_WRONG_UNIT;
    }
    if (pdu == 0U) {
        return FIELDSCRIBE_MODBUS_WRONG_FUNCTION;
    }
    return fieldscribe_modbus_take_answer(request, &bytes[1], pdu, reply);
}

fieldscribe_modbus_status fieldscribe_modbus_parse_tcp(
    const fieldscribe_modbus_request *request, const uint8_t *bytes, size_t length, fieldscribe_modbus_reply *reply)
{
    size_t expected;
    fieldscribe_modbus_clear(reply);
    if (length < 9U) {
        return FIELDSCRIBE_MODBUS_SHORT_FRAME;
    }
    if (fieldscribe_modbus_get(bytes + 2) != 0U) {
        return FIELDSCRIBE_MODBUS_BAD_PROTOCOL;
    }
    expected = 6U + (size_t)fieldscribe_modbus_get(bytes + 4);
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
    return fieldscribe_modbus_take_answer(request, &bytes[7], length - 7U, reply);
}

fieldscribe_modbus_status fieldscribe_modbus_parse_pdu(
    const fieldscribe_modbus_request *request, const uint8_t *pdu, size_t length, fieldscribe_modbus_reply *reply)
{
    size_t expected;
    fieldscribe_modbus_clear(reply);
    if (length < 2U) {
        return FIELDSCRIBE_MODBUS_SHORT_FRAME;
    }
    expected = fieldscribe_modbus_pdu(request->function, pdu[0], pdu[1]);
    if (expected == 0U) {
        return FIELDSCRIBE_MODBUS_WRONG_FUNCTION;
    }
    if (length != expected) {
        return (length < expected) ? FIELDSCRIBE_MODBUS_SHORT_FRAME : FIELDSCRIBE_MODBUS_LONG_FRAME;
    }
    return fieldscribe_modbus_take_answer(request, pdu, length, reply);
}

/* The bytes of an answer, from the unit to the end of what it is about. */
static uint32_t fieldscribe_modbus_answer(const fieldscribe_modbus_request *request)
{
    if (fieldscribe_modbus_reads_bits(request->function)) {
        return 3U + (((uint32_t)request->count + 7U) / 8U);
    }
    return fieldscribe_modbus_reads(request->function) ? (3U + ((uint32_t)request->count * 2U)) : 6U;
}

/* The bytes of a frame beside that: its checksum, or its head. */
static uint32_t fieldscribe_modbus_around(fieldscribe_modbus_framing framing)
{
    return (framing == FIELDSCRIBE_MODBUS_TCP) ? 6U : 2U;
}

uint32_t fieldscribe_modbus_reply_length(const fieldscribe_modbus_profile *profile,
    fieldscribe_modbus_framing framing, const fieldscribe_modbus_request *request)
{
    if (request->unit == profile->broadcast) {
        return 0U;
    }
    return fieldscribe_modbus_around(framing) + fieldscribe_modbus_answer(request);
}

/* The bytes of the answer that has come as far as a refusal is long, by what it says; else those that are expected. */
static uint32_t fieldscribe_modbus_told(
    fieldscribe_modbus_framing framing, uint8_t function, const uint8_t *buffer, uint32_t expected)
{
    const uint8_t code = buffer[1];
    const bool refused = (code & 0x80U) != 0U; /* whatever it answers */
    uint32_t whole = expected;
    if (framing == FIELDSCRIBE_MODBUS_TCP) {
        whole = 6U + (uint32_t)fieldscribe_modbus_get(buffer + 4);
    } else if (refused || (code == function)) {
        whole = 3U + (uint32_t)fieldscribe_modbus_pdu(refused ? (code & 0x7FU) : function, code, buffer[2]);
    } else {
        /* as long as what was written asks for */
    }
    return whole;
}

uint32_t fieldscribe_modbus_left(const fieldscribe_modbus_profile *profile, fieldscribe_modbus_framing framing,
    const fieldscribe_modbus_request *request, const uint8_t *buffer, size_t size, size_t length)
{
    const uint32_t refusal = fieldscribe_modbus_around(framing) + 3U; /* the shortest answer */
    uint32_t whole = fieldscribe_modbus_reply_length(profile, framing, request);
    if (whole != 0U) {
        whole = (length < refusal) ? refusal : fieldscribe_modbus_told(framing, request->function, buffer, whole);
    }
    if (whole > size) {
        whole = (uint32_t)size;
    }
    return (length < whole) ? (whole - (uint32_t)length) : 0U;
}

/* How many bytes an answer has at least that so many begin; 0 where they begin none, or its checksum is wrong. */
static size_t fieldscribe_modbus_begun_rtu(
    const fieldscribe_modbus_receiver *receiver, const uint8_t *bytes, size_t length)
{
    size_t whole = length + 1U; /* the next byte says more */
    if (length > 1U) {
        const size_t pdu = fieldscribe_modbus_pdu(receiver->function, bytes[1], (length > 2U) ? bytes[2] : 0U);
        whole = (pdu != 0U) ? (3U + pdu) : 0U;
    }
    if ((bytes[0] != receiver->unit) || (whole > receiver->size) ||
        ((whole <= length) && (fieldscribe_modbus_crc(bytes, whole) != 0U))) {
        whole = 0U;
    }
    return whole;
}

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
    if (((at < length) && (at < 4U)) || (whole < shortest) || (whole > receiver->size) ||
        ((length > 6U) && (bytes[6] != receiver->unit)) ||
        ((length > 7U) && (fieldscribe_modbus_pdu(receiver->function, bytes[7], 0U) == 0U))) {
        whole = 0U;
    } else if (length < 8U) {
        whole = length + 1U; /* the next byte says more */
    } else {
        /* as it says */
    }
    return whole;
}

/* A receiver, without what tells how an answer begins. */
static fieldscribe_modbus_receiver fieldscribe_modbus_await_any(
    const fieldscribe_modbus_request *request, uint32_t whole, uint8_t *buffer, size_t size)
{
    fieldscribe_modbus_receiver receiver;
    receiver.buffer = buffer;
    receiver.size = size;
    receiver.length = 0U;
    receiver.dropped = 0U;
    receiver.next = 1U;
    receiver.done = (whole == 0U) || (whole > size);
    receiver.unit = request->unit;
    receiver.function = request->function;
    receiver.transaction = request->transaction;
    receiver.begun = NULL;
    return receiver;
}

fieldscribe_modbus_receiver fieldscribe_modbus_await_rtu(const fieldscribe_modbus_profile *profile,
    const fieldscribe_modbus_request *request, uint8_t *buffer, size_t size)
{
    fieldscribe_modbus_receiver receiver = fieldscribe_modbus_await_any(
        request, fieldscribe_modbus_reply_length(profile, FIELDSCRIBE_MODBUS_RTU, request), buffer, size);
    receiver.begun = &fieldscribe_modbus_begun_rtu;
    return receiver;
}

fieldscribe_modbus_receiver fieldscribe_modbus_await_tcp(const fieldscribe_modbus_profile *profile,
    const fieldscribe_modbus_request *request, uint8_t *buffer, size_t size)
{
    fieldscribe_modbus_receiver receiver = fieldscribe_modbus_await_any(
        request, fieldscribe_modbus_reply_length(profile, FIELDSCRIBE_MODBUS_TCP, request), buffer, size);
    receiver.begun = &fieldscribe_modbus_begun_tcp;
    return receiver;
}

/*
 * Drops bytes until the rest may be the answer, and what came behind it when it is whole. On a silent line a whole
 * answer comes before one that was only begun.
 */
static void fieldscribe_modbus_settle(fieldscribe_modbus_receiver *receiver, bool silent)
{
    const size_t length = receiver->length;
    size_t whole = 1U;
    size_t begin = length;
    size_t from;
    size_t to = 0U;
    bool settled = false;
    for (from = 0U; (from < length) && (!settled); ++from) {
        const size_t least = receiver->begun(receiver, &receiver->buffer[from], length - from);
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

/* Adds a byte to an answer that is not done. */
static void fieldscribe_modbus_add(fieldscribe_modbus_receiver *receiver, uint8_t byte)
{
    if (receiver->length < receiver->size) {
        receiver->buffer[receiver->length] = byte;
        ++receiver->length;
        if (receiver->length >= receiver->next) {
            fieldscribe_modbus_settle(receiver, false);
        }
    }
}

size_t fieldscribe_modbus_receive(fieldscribe_modbus_receiver *receiver, const uint8_t *bytes, size_t count)
{
    size_t taken = 0U;
    while ((taken < count) && (!receiver->done)) {
        fieldscribe_modbus_add(receiver, bytes[taken]);
        ++taken;
    }
    return taken;
}

void fieldscribe_modbus_silent(fieldscribe_modbus_receiver *receiver)
{
    if (!receiver->done) {
        fieldscribe_modbus_settle(receiver, true);
    }
}

/*
 * Sends the `length` bytes of a request, and receives its answer; a line that is never silent comes to an end, too. OK
 * says that the receiver has an answer to parse, or none because nobody answers.
 */
static fieldscribe_modbus_status fieldscribe_modbus_exchange(const fieldscribe_modbus_line *line,
    const fieldscribe_modbus_request *request, size_t length, fieldscribe_modbus_receiver *receiver,
    const fieldscribe_modbus_reply *reply)
{
    const bool answered = request->unit != line->profile->broadcast;
    const size_t needed = fieldscribe_modbus_reads(request->function) ? request->count : 0U;
    uint16_t left = FIELDSCRIBE_MODBUS_ASK_MOST;
    uint32_t wait = line->answer_ms;
    bool again = true; /* after noise that is followed by silence, an answer has its time once more */
    uint8_t byte = 0U;
    if (answered && (receiver->done || (fieldscribe_modbus_room(reply) < needed))) {
        return FIELDSCRIBE_MODBUS_BUFFER_TOO_SMALL;
    }
    line->send(line->context, line->buffer, length);
    while ((!receiver->done) && (left > 0U)) {
        if (line->receive(line->context, wait, &byte)) {
            fieldscribe_modbus_add(receiver, byte);
            wait = line->pause_ms;
            --left;
        } else if (again && (receiver->length == 0U) && (receiver->dropped > 0U)) {
            again = false;
            wait = line->answer_ms;
        } else {
            break;
        }
    }
    fieldscribe_modbus_silent(receiver);
    if (!receiver->done) {
        return (receiver->dropped > 0U) ? FIELDSCRIBE_MODBUS_NOISE : FIELDSCRIBE_MODBUS_SHORT_FRAME;
    }
    return FIELDSCRIBE_MODBUS_OK;
}

fieldscribe_modbus_status fieldscribe_modbus_ask_rtu(const fieldscribe_modbus_line *line,
    const fieldscribe_modbus_request *request, fieldscribe_modbus_reply *reply)
{
    size_t length;
    fieldscribe_modbus_status status =
        fieldscribe_modbus_build_rtu(line->profile, request, line->buffer, line->size, &length);
    fieldscribe_modbus_clear(reply);
    if (status == FIELDSCRIBE_MODBUS_OK) {
        fieldscribe_modbus_receiver receiver =
            fieldscribe_modbus_await_rtu(line->profile, request, line->buffer, line->size);
        status = fieldscribe_modbus_exchange(line, request, length, &receiver, reply);
        if ((status == FIELDSCRIBE_MODBUS_OK) && (receiver.length > 0U)) { /* it is whole, and of the unit */
            status = fieldscribe_modbus_take_answer(request, &line->buffer[1], receiver.length - 3U, reply);
        }
    }
    return status;
}

fieldscribe_modbus_status fieldscribe_modbus_ask_tcp(const fieldscribe_modbus_line *line,
    const fieldscribe_modbus_request *request, fieldscribe_modbus_reply *reply)
{
    size_t length;
    fieldscribe_modbus_status status =
        fieldscribe_modbus_build_tcp(line->profile, request, line->buffer, line->size, &length);
    fieldscribe_modbus_clear(reply);
    if (status == FIELDSCRIBE_MODBUS_OK) {
        fieldscribe_modbus_receiver receiver =
            fieldscribe_modbus_await_tcp(line->profile, request, line->buffer, line->size);
        status = fieldscribe_modbus_exchange(line, request, length, &receiver, reply);
        if ((status == FIELDSCRIBE_MODBUS_OK) && (receiver.length > 0U)) {
            status = fieldscribe_modbus_take_answer(request, &line->buffer[7], receiver.length - 7U, reply);
        }
    }
    return status;
}

/* Exchanges one request of a unit. */
static fieldscribe_modbus_status fieldscribe_modbus_call(
    fieldscribe_modbus_unit *unit, fieldscribe_modbus_request *request, uint16_t *words, size_t count)
{
    fieldscribe_modbus_reply reply = {words, count, 0U, 0U};
    fieldscribe_modbus_status status;
    request->transaction = unit->transaction;
    unit->transaction = (uint16_t)((unit->transaction + 1U) & 0xFFFFU);
    status = unit->ask(unit->line, request, &reply);
    unit->exception = reply.exception;
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

/* True if raw numbers of the layout, which has up to 32 bits, have a sign. */
static bool fieldscribe_modbus_is_signed(const fieldscribe_layout *layout)
{
    return (layout->type == (uint8_t)FIELDSCRIBE_S8) || (layout->type == (uint8_t)FIELDSCRIBE_S16) ||
        (layout->type == (uint8_t)FIELDSCRIBE_S32);
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
        const int64_t raw = fieldscribe_modbus_is_signed(row->layout)
            ? (int64_t)fieldscribe_layout_signed_field(row->layout, words)
            : (int64_t)fieldscribe_layout_field(row->layout, words);
        *number = fieldscribe_divide((raw * row->divisor) - row->add, row->factor);
    }
    return status;
}

/* True if the raw number fits the layout: it is then in the words. */
static bool fieldscribe_modbus_put_raw(const fieldscribe_layout *layout, int64_t raw, uint16_t *words)
{
    bool fits = false;
    if (fieldscribe_modbus_is_signed(layout)) {
        if ((raw >= INT32_MIN) && (raw <= INT32_MAX)) {
            fits = fieldscribe_layout_put_signed(layout, (int32_t)raw, words);
        }
    } else if ((raw >= 0) && (raw <= (int64_t)UINT32_MAX)) {
        fits = fieldscribe_layout_put(layout, (uint32_t)raw, words);
    } else {
        fits = false;
    }
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

#ifdef __cplusplus
}
#endif

#endif
