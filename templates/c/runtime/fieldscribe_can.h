/*
 * CAN frames by layout: builds messages, parses answers, and collects cyclic telegrams that arrive in several frames.
 * No heap; the state of a receiver is the caller's. Parsing is safe for any bytes of any length.
 * SPDX-License-Identifier: 0BSD
 *
 * Exactly one C file of a program defines FIELDSCRIBE_IMPLEMENTATION before it includes this header.
 *
 * To read a parameter:
 *
 *     const fieldscribe_can_rw *const point = &woodward_mpu2s_password_level_2_frame;
 *     status = fieldscribe_can_read(&dialogue, unit, &point->read, &frame);
 *     discard();      (received frames: else a late answer is taken for this one)
 *     send(&frame);
 *     (pass each received frame; any status but OK: it is not this answer)
 *     status = fieldscribe_can_read_answer(&dialogue, unit, &point->read, &frame, &word);
 *     fits = fieldscribe_take_u16(point->layout, &word, 1U, &raw);
 *
 * To write one: ..._encode makes the raw number and checks that it may be written; the macro of a special code is
 * already a raw number. fieldscribe_put_u16(point->layout, raw, &word, 1U) stores it in the word without that check,
 * and fieldscribe_can_write(&dialogue, unit, &point->write, word, &frame) builds the frame.
 * fieldscribe_can_write_answer returns OK for the frame that confirms the write. A point that has only some bits of a
 * word has `update`, not `write`: read the word, put the bits, write it back. Over a serial gateway,
 * fieldscribe_can_reply_length returns the length of an answer. fieldscribe_can_id returns the identifier to let
 * through a filter.
 *
 * Interrupts: you can take the frames of a telegram in an interrupt and read its words elsewhere, or the reverse. What
 * is read is consistent, or TORN if the read interrupted fieldscribe_can_take. Only one context may take the frames of
 * a receiver. All other functions keep no state.
 */
#include "fieldscribe.h"

#ifndef FIELDSCRIBE_CAN_H
#define FIELDSCRIBE_CAN_H

#ifdef __cplusplus
extern "C" {
#endif

/* The version that device headers check; it increases when they must be generated again. */
#define FIELDSCRIBE_CAN_INTERFACE 2

/* All messages have eight bytes of data, so at most four words. */
#define FIELDSCRIBE_CAN_BYTES 8U
#define FIELDSCRIBE_CAN_WORDS 4U

typedef enum fieldscribe_can_status {
    FIELDSCRIBE_CAN_OK = 0,
    /* building */
    FIELDSCRIBE_CAN_BAD_UNIT,    /* not a unit of this device */
    FIELDSCRIBE_CAN_BAD_ADDRESS, /* beyond FFFFh */
    FIELDSCRIBE_CAN_BAD_VALUE,   /* beyond FFFFh */
    /* parsing */
    FIELDSCRIBE_CAN_WRONG_ID,
    FIELDSCRIBE_CAN_WRONG_LENGTH,
    FIELDSCRIBE_CAN_WRONG_CONSTANT, /* a constant byte is wrong */
    FIELDSCRIBE_CAN_WRONG_UNIT,
    FIELDSCRIBE_CAN_WRONG_CHECK,   /* a check byte does not match the bytes that it combines */
    FIELDSCRIBE_CAN_WRONG_ADDRESS, /* the answer is about another parameter */
    FIELDSCRIBE_CAN_ECHO_MISMATCH, /* the answer to a write has another word than was written */
    /* telegrams */
    FIELDSCRIBE_CAN_MISSING, /* the frame with the word has not arrived yet */
    FIELDSCRIBE_CAN_TORN,    /* the words may be of different cycles: wait for more frames */
    FIELDSCRIBE_CAN_BUFFER_TOO_SMALL /* the caller's array of words is too small for the result */
} fieldscribe_can_status;

/* The name of a status in lower case, for logs: "wrong_id"; "unknown" for any other number. */
const char *fieldscribe_can_status_name(fieldscribe_can_status status);

/* A data frame; `length` may exceed 8 in a foreign frame: `data` has the first eight bytes. */
typedef struct fieldscribe_can_frame {
    uint32_t id;
    uint8_t length;
    uint8_t data[FIELDSCRIBE_CAN_BYTES];
} fieldscribe_can_frame;

/* What a byte of a message carries. */
typedef enum fieldscribe_can_kind {
    FIELDSCRIBE_CAN_CONSTANT, /* number: the byte */
    FIELDSCRIBE_CAN_UNIT,     /* number: the position of the byte's lowest bit; also for the next ones */
    FIELDSCRIBE_CAN_ADDRESS,
    FIELDSCRIBE_CAN_RAW,
    FIELDSCRIBE_CAN_MULTIPLEXER,
    FIELDSCRIBE_CAN_WORD, /* number: twice the index of the word, plus 1 for its low byte */
    FIELDSCRIBE_CAN_XOR   /* number: a mask of the bytes that are combined */
} fieldscribe_can_kind;

typedef struct fieldscribe_can_role {
    uint8_t kind; /* a fieldscribe_can_kind */
    uint8_t number;
} fieldscribe_can_role;

/* The identifier of a message, to which the unit number may be added, and the layout of its bytes. */
typedef struct fieldscribe_can_message {
    uint32_t id;
    bool adds_unit;
    fieldscribe_can_role roles[FIELDSCRIBE_CAN_BYTES];
} fieldscribe_can_message;

/* What a device supports. */
typedef struct fieldscribe_can_profile {
    uint8_t first_unit;
    uint8_t last_unit;
    uint8_t identifier_bits; /* 11 or 29 */
} fieldscribe_can_profile;

/* The content of a message for one parameter; a message without address or raw number ignores them. */
typedef struct fieldscribe_can_content {
    uint32_t unit;
    uint32_t address;
    uint32_t raw;
} fieldscribe_can_content;

/* The messages that read and write one parameter, and those that answer; NULL if there is none. */
typedef struct fieldscribe_can_dialogue {
    const fieldscribe_can_profile *profile;
    const fieldscribe_can_message *read;
    const fieldscribe_can_message *read_answer;
    const fieldscribe_can_message *write;
    const fieldscribe_can_message *write_answer;
} fieldscribe_can_dialogue;

/* The parameter to read, or to write. */
typedef struct fieldscribe_can_reading {
    uint16_t address;
} fieldscribe_can_reading;

typedef struct fieldscribe_can_writing {
    uint16_t address;
} fieldscribe_can_writing;

/* The same for a text: one parameter for each of its words, in reading order. */
typedef struct fieldscribe_can_text_reading {
    const uint16_t *addresses;
    uint16_t words;
} fieldscribe_can_text_reading;

typedef struct fieldscribe_can_text_writing {
    const uint16_t *addresses;
    uint16_t words;
} fieldscribe_can_text_writing;

/* The positions of a point's high and low word in a telegram; the same position twice for one word. */
typedef struct fieldscribe_can_heard {
    uint16_t high;
    uint16_t low;
} fieldscribe_can_heard;

typedef struct fieldscribe_can_text_heard {
    const uint16_t *positions;
    uint16_t words;
} fieldscribe_can_text_heard;

/*
 * A point by its access: `read`, `write`, or `update` if it shares its word with other points; `heard` if it is in a
 * telegram.
 */
typedef struct fieldscribe_can_r {
    const fieldscribe_layout *layout;
    fieldscribe_can_reading read;
} fieldscribe_can_r;

typedef struct fieldscribe_can_w {
    const fieldscribe_layout *layout;
    fieldscribe_can_writing write;
} fieldscribe_can_w;

typedef struct fieldscribe_can_rw {
    const fieldscribe_layout *layout;
    fieldscribe_can_reading read;
    fieldscribe_can_writing write;
} fieldscribe_can_rw;

typedef struct fieldscribe_can_u {
    const fieldscribe_layout *layout;
    fieldscribe_can_writing update;
} fieldscribe_can_u;

typedef struct fieldscribe_can_ru {
    const fieldscribe_layout *layout;
    fieldscribe_can_reading read;
    fieldscribe_can_writing update;
} fieldscribe_can_ru;

typedef struct fieldscribe_can_h {
    const fieldscribe_layout *layout;
    fieldscribe_can_heard heard;
} fieldscribe_can_h;

typedef struct fieldscribe_can_text_r {
    fieldscribe_can_text_reading read;
} fieldscribe_can_text_r;

typedef struct fieldscribe_can_text_w {
    fieldscribe_can_text_writing write;
} fieldscribe_can_text_w;

typedef struct fieldscribe_can_text_rw {
    fieldscribe_can_text_reading read;
    fieldscribe_can_text_writing write;
} fieldscribe_can_text_rw;

typedef struct fieldscribe_can_text_h {
    fieldscribe_can_text_heard heard;
} fieldscribe_can_text_h;

/* A cyclic layout of words; each frame of its message carries `per_frame` of them. */
typedef struct fieldscribe_can_telegram {
    const fieldscribe_can_profile *profile;
    const fieldscribe_can_message *message;
    uint16_t words;
    uint8_t per_frame;
} fieldscribe_can_telegram;

/* The words of one multiplexer in its last two frames; `now` and `before` number the frames taken, 0: none. */
typedef struct fieldscribe_can_slot {
    uint64_t now;
    uint64_t before;
    uint32_t time_now;
    uint32_t time_before;
    uint16_t words_now[FIELDSCRIBE_CAN_WORDS];
    uint16_t words_before[FIELDSCRIBE_CAN_WORDS];
} fieldscribe_can_slot;

/* Collects the frames of one telegram of one unit; `slots` has one item for each frame of the telegram. */
typedef struct fieldscribe_can_receiver {
    const fieldscribe_can_telegram *telegram;
    fieldscribe_can_slot *slots;
    size_t slot_count;
    uint64_t clock;
    uint32_t changes; /* odd while a frame is being taken */
    uint8_t unit;
} fieldscribe_can_receiver;

/* A condition: the word of another signal has this raw number; `more`: or the next condition holds. */
typedef struct fieldscribe_can_choice {
    uint16_t word;
    uint16_t raw;
    bool more;
} fieldscribe_can_choice;

/*
 * The bits of a number in a message. `start` is the first bit as CAN databases count them: bit 7 of byte 1 is 15. It is
 * the lowest bit of the number if the low byte comes first, else the highest. A frame has the signal if all conditions
 * in `when` hold; of those joined by `more`, one is enough.
 */
typedef struct fieldscribe_can_signal {
    uint16_t start;
    uint8_t width;
    bool low_first;
    uint16_t choices;
    const fieldscribe_can_choice *when; /* NULL: every frame has the signal */
} fieldscribe_can_signal;

/* A message of signals. Each takes one word for 16 bits, the high word first, in the order of `signals`. */
typedef struct fieldscribe_can_signals {
    const fieldscribe_can_profile *profile;
    uint32_t id;
    bool adds_unit;
    uint8_t length;
    const fieldscribe_can_signal *signals;
    uint16_t count;
    uint16_t words;
} fieldscribe_can_signals;

/* The identifier of the message of a unit: a filter must let it through. */
FIELDSCRIBE_CHECKED uint32_t fieldscribe_can_id(const fieldscribe_can_message *message, uint8_t unit);

/* The number of data bytes of an answer; 0 if there is no answer. */
FIELDSCRIBE_CHECKED uint32_t fieldscribe_can_reply_length(const fieldscribe_can_message *answer);

/* Builds the frame of a message; stores nothing unless the result is OK. */
FIELDSCRIBE_CHECKED fieldscribe_can_status fieldscribe_can_build(const fieldscribe_can_profile *profile,
    const fieldscribe_can_message *message, const fieldscribe_can_content *content, fieldscribe_can_frame *frame);

/* Parses a message of content->unit; address and raw number are 0 if it has none, or unless the result is OK. */
FIELDSCRIBE_CHECKED fieldscribe_can_status fieldscribe_can_parse(
    const fieldscribe_can_message *message, const fieldscribe_can_frame *frame, fieldscribe_can_content *content);

/* Builds the frame that requests a parameter. */
FIELDSCRIBE_CHECKED fieldscribe_can_status fieldscribe_can_read(const fieldscribe_can_dialogue *dialogue, uint8_t unit,
    const fieldscribe_can_reading *what, fieldscribe_can_frame *frame);

/* Takes the word out of an answer; stores nothing unless the result is OK. */
FIELDSCRIBE_CHECKED fieldscribe_can_status fieldscribe_can_read_answer(const fieldscribe_can_dialogue *dialogue,
    uint8_t unit, const fieldscribe_can_reading *what, const fieldscribe_can_frame *frame, uint16_t *word);

/* Builds the frame that writes a word. */
FIELDSCRIBE_CHECKED fieldscribe_can_status fieldscribe_can_write(const fieldscribe_can_dialogue *dialogue, uint8_t unit,
    const fieldscribe_can_writing *what, uint16_t word, fieldscribe_can_frame *frame);

/* OK if a frame confirms a write: it carries the word that the device has now. */
FIELDSCRIBE_CHECKED fieldscribe_can_status fieldscribe_can_write_answer(const fieldscribe_can_dialogue *dialogue,
    uint8_t unit, const fieldscribe_can_writing *what, uint16_t word, const fieldscribe_can_frame *frame);

/* Word `at` of a text as a parameter to read or write; BAD_ADDRESS if the text has no such word. */
FIELDSCRIBE_CHECKED fieldscribe_can_status fieldscribe_can_word_to_read(
    const fieldscribe_can_text_reading *text, size_t at, fieldscribe_can_reading *word);
FIELDSCRIBE_CHECKED fieldscribe_can_status fieldscribe_can_word_to_write(
    const fieldscribe_can_text_writing *text, size_t at, fieldscribe_can_writing *word);

/* The number of frames of a telegram, which is the number of slots it needs. */
FIELDSCRIBE_CHECKED size_t fieldscribe_can_slots(const fieldscribe_can_telegram *telegram);

/*
 * Takes the words out of a frame if it belongs to the telegram of that unit: `per_frame` words, then 0, and the part of
 * the telegram that they are. No frame belongs to a unit number that the device cannot have.
 */
bool fieldscribe_can_unpack(const fieldscribe_can_telegram *telegram, uint8_t unit, const fieldscribe_can_frame *frame,
    size_t *part, uint16_t words[FIELDSCRIBE_CAN_WORDS]);

/*
 * An empty receiver for the telegram of one unit; it keeps using the slots. If `count` is less than the number of
 * frames of the telegram, it never takes one.
 */
FIELDSCRIBE_CHECKED fieldscribe_can_receiver fieldscribe_can_listen(
    const fieldscribe_can_telegram *telegram, uint8_t unit, fieldscribe_can_slot *slots, size_t count);

/*
 * Takes a frame that arrived at `time` by your clock (0 if you do not need ages), if it belongs to the telegram.
 */
bool fieldscribe_can_take(fieldscribe_can_receiver *receiver, const fieldscribe_can_frame *frame, uint32_t time);

/* The newest word at a position of the telegram, from 0 on. */
FIELDSCRIBE_CHECKED fieldscribe_can_status fieldscribe_can_word(
    const fieldscribe_can_receiver *receiver, uint16_t position, uint16_t *word);

/*
 * The words of a point, the high word first, if `count` is enough; stores nothing unless the result is OK. Two words
 * that arrive in different frames are accepted only if the same high word arrived before and after the low word.
 */
FIELDSCRIBE_CHECKED fieldscribe_can_status fieldscribe_can_received(const fieldscribe_can_receiver *receiver,
    const fieldscribe_can_heard *what, uint16_t *words, size_t count);

/*
 * The age of the words that fieldscribe_can_received takes: of the older frame, if there are two. `now` is by the clock
 * that times frames, which may overflow. Stores nothing unless the result is OK.
 */
FIELDSCRIBE_CHECKED fieldscribe_can_status fieldscribe_can_age(
    const fieldscribe_can_receiver *receiver, const fieldscribe_can_heard *what, uint32_t now, uint32_t *age);

/*
 * The words of a text in reading order; stores those before the first word that has not arrived, and none if the text
 * has more than `count`.
 */
FIELDSCRIBE_CHECKED fieldscribe_can_status fieldscribe_can_received_text(const fieldscribe_can_receiver *receiver,
    const fieldscribe_can_text_heard *what, uint16_t *words, size_t count);

/* The identifier of a message of signals of a unit. */
FIELDSCRIBE_CHECKED uint32_t fieldscribe_can_signals_id(const fieldscribe_can_signals *message, uint8_t unit);

/*
 * Takes the words of all signals out of a frame of `length` bytes, if `count` is enough; stores nothing unless the
 * result is OK. fieldscribe_can_comes says which of the signals this frame has.
 */
FIELDSCRIBE_CHECKED fieldscribe_can_status fieldscribe_can_take_signals(const fieldscribe_can_signals *message,
    uint8_t unit, uint32_t id, const uint8_t *data, size_t length, uint16_t *words, size_t count);

/* OK if the frame of these words has the signal with this first word; MISSING if its conditions are false. */
FIELDSCRIBE_CHECKED fieldscribe_can_status fieldscribe_can_comes(
    const fieldscribe_can_signals *message, uint16_t word, const uint16_t *words, size_t count);

/*
 * Puts the words of signals into the bytes of a frame, if `length` is enough; stores nothing unless the result is OK.
 * All other bits are 0, and those of signals that the frame does not have.
 */
FIELDSCRIBE_CHECKED fieldscribe_can_status fieldscribe_can_put_signals(const fieldscribe_can_signals *message,
    const uint16_t *words, size_t count, uint8_t *data, size_t length);

#ifdef __cplusplus
}
#endif

#endif

/* ---- Definitions ---- */

#if defined(FIELDSCRIBE_IMPLEMENTATION) && !defined(FIELDSCRIBE_CAN_IMPLEMENTED)
#define FIELDSCRIBE_CAN_IMPLEMENTED

const char *fieldscribe_can_status_name(fieldscribe_can_status status)
{
    static const char *const names[] = {"ok", "bad_unit", "bad_address", "bad_value", "wrong_id", "wrong_length",
        "wrong_constant", "wrong_unit", "wrong_check", "wrong_address", "echo_mismatch", "missing", "torn",
        "buffer_too_small"};
    return ((size_t)status < FIELDSCRIBE_COUNT(names)) ? names[(size_t)status] : "unknown";
}

uint32_t fieldscribe_can_id(const fieldscribe_can_message *message, uint8_t unit)
{
    return message->id + (message->adds_unit ? unit : 0U);
}

/* The position of a role's lowest bit; limited to the bits of a word, whatever the table says. */
static unsigned fieldscribe_can_shift(fieldscribe_can_role role)
{
    return role.number & 0xFU;
}

/* The bytes in `mask`, combined by exclusive or. */
static uint8_t fieldscribe_can_xor(const uint8_t data[FIELDSCRIBE_CAN_BYTES], uint8_t mask)
{
    uint8_t combined = 0U;
    unsigned at;
    for (at = 0U; at < FIELDSCRIBE_CAN_BYTES; ++at) {
        if ((((uint32_t)mask >> at) & 1U) != 0U) {
            combined = (uint8_t)(combined ^ data[at]);
        }
    }
    return combined;
}

fieldscribe_can_status fieldscribe_can_build(const fieldscribe_can_profile *profile,
    const fieldscribe_can_message *message, const fieldscribe_can_content *content, fieldscribe_can_frame *frame)
{
    const uint32_t unit = content->unit;
    unsigned at;
    if ((unit < profile->first_unit) || (unit > profile->last_unit)) {
        return FIELDSCRIBE_CAN_BAD_UNIT;
    }
    if (content->address > 0xFFFFU) {
        return FIELDSCRIBE_CAN_BAD_ADDRESS;
    }
    if (content->raw > 0xFFFFU) {
        return FIELDSCRIBE_CAN_BAD_VALUE;
    }
    frame->id = fieldscribe_can_id(message, (uint8_t)unit);
    frame->length = FIELDSCRIBE_CAN_BYTES;
    for (at = 0U; at < FIELDSCRIBE_CAN_BYTES; ++at) {
        const fieldscribe_can_role role = message->roles[at];
        uint32_t byte = 0U;
        if (role.kind == (uint8_t)FIELDSCRIBE_CAN_CONSTANT) {
            byte = role.number;
        } else if (role.kind == (uint8_t)FIELDSCRIBE_CAN_UNIT) {
            byte = unit >> fieldscribe_can_shift(role);
        } else if (role.kind == (uint8_t)FIELDSCRIBE_CAN_ADDRESS) {
            byte = content->address >> fieldscribe_can_shift(role);
        } else if (role.kind == (uint8_t)FIELDSCRIBE_CAN_RAW) {
            byte = content->raw >> fieldscribe_can_shift(role);
        }
        frame->data[at] = (uint8_t)(byte & 0xFFU);
    }
    for (at = 0U; at < FIELDSCRIBE_CAN_BYTES; ++at) {
        if (message->roles[at].kind == (uint8_t)FIELDSCRIBE_CAN_XOR) {
            frame->data[at] = fieldscribe_can_xor(frame->data, message->roles[at].number);
        }
    }
    return FIELDSCRIBE_CAN_OK;
}

/* True if every byte of a kind has the expected value. */
static bool fieldscribe_can_agrees(
    const fieldscribe_can_message *message, uint8_t kind, uint8_t unit, const uint8_t data[FIELDSCRIBE_CAN_BYTES])
{
    unsigned at;
    for (at = 0U; at < FIELDSCRIBE_CAN_BYTES; ++at) {
        const fieldscribe_can_role role = message->roles[at];
        uint8_t expected = role.number; /* a constant */
        if (role.kind != kind) {
            continue;
        }
        if (kind == (uint8_t)FIELDSCRIBE_CAN_UNIT) {
            expected = (uint8_t)((uint32_t)unit >> fieldscribe_can_shift(role));
        } else if (kind == (uint8_t)FIELDSCRIBE_CAN_XOR) {
            expected = fieldscribe_can_xor(data, role.number);
        }
        if (data[at] != expected) {
            return false;
        }
    }
    return true;
}

/* OK if a frame is this message of this unit. */
static fieldscribe_can_status fieldscribe_can_recognize(
    const fieldscribe_can_message *message, uint8_t unit, const fieldscribe_can_frame *frame)
{
    if (frame->id != fieldscribe_can_id(message, unit)) {
        return FIELDSCRIBE_CAN_WRONG_ID;
    }
    if (frame->length != FIELDSCRIBE_CAN_BYTES) {
        return FIELDSCRIBE_CAN_WRONG_LENGTH;
    }
    if (!fieldscribe_can_agrees(message, FIELDSCRIBE_CAN_CONSTANT, unit, frame->data)) {
        return FIELDSCRIBE_CAN_WRONG_CONSTANT;
    }
    if (!fieldscribe_can_agrees(message, FIELDSCRIBE_CAN_UNIT, unit, frame->data)) {
        return FIELDSCRIBE_CAN_WRONG_UNIT;
    }
    if (!fieldscribe_can_agrees(message, FIELDSCRIBE_CAN_XOR, unit, frame->data)) {
        return FIELDSCRIBE_CAN_WRONG_CHECK;
    }
    return FIELDSCRIBE_CAN_OK;
}

/* The unit of a content as a uint8_t; larger numbers are no unit. */
static uint8_t fieldscribe_can_unit(const fieldscribe_can_content *content)
{
    return (uint8_t)((content->unit > 0xFFU) ? 0xFFU : content->unit);
}

fieldscribe_can_status fieldscribe_can_parse(
    const fieldscribe_can_message *message, const fieldscribe_can_frame *frame, fieldscribe_can_content *content)
{
    const fieldscribe_can_status status = fieldscribe_can_recognize(message, fieldscribe_can_unit(content), frame);
    unsigned at;
    content->address = 0U;
    content->raw = 0U;
    if (status != FIELDSCRIBE_CAN_OK) {
        return status;
    }
    for (at = 0U; at < FIELDSCRIBE_CAN_BYTES; ++at) {
        const fieldscribe_can_role role = message->roles[at];
        const uint32_t part = ((uint32_t)frame->data[at] << fieldscribe_can_shift(role)) & 0xFFFFU;
        if (role.kind == (uint8_t)FIELDSCRIBE_CAN_ADDRESS) {
            content->address |= part;
        } else if (role.kind == (uint8_t)FIELDSCRIBE_CAN_RAW) {
            content->raw |= part;
        }
    }
    return FIELDSCRIBE_CAN_OK;
}

/* True if a message has a byte of this kind. */
static bool fieldscribe_can_carries(const fieldscribe_can_message *message, uint8_t kind)
{
    unsigned at = 0U;
    while ((at < FIELDSCRIBE_CAN_BYTES) && (message->roles[at].kind != kind)) {
        ++at;
    }
    return at < FIELDSCRIBE_CAN_BYTES;
}

uint32_t fieldscribe_can_reply_length(const fieldscribe_can_message *answer)
{
    return (answer != NULL) ? FIELDSCRIBE_CAN_BYTES : 0U;
}

/* Parses the answer for content->address; its word becomes content->raw. */
static fieldscribe_can_status fieldscribe_can_answer(
    const fieldscribe_can_message *message, const fieldscribe_can_frame *frame, fieldscribe_can_content *content)
{
    const uint32_t address = content->address;
    fieldscribe_can_status status;
    if (message == NULL) {
        return FIELDSCRIBE_CAN_WRONG_ID; /* there is no answer message */
    }
    status = fieldscribe_can_parse(message, frame, content);
    if ((status == FIELDSCRIBE_CAN_OK) && (content->address != address) &&
        fieldscribe_can_carries(message, FIELDSCRIBE_CAN_ADDRESS)) {
        return FIELDSCRIBE_CAN_WRONG_ADDRESS;
    }
    return status;
}

fieldscribe_can_status fieldscribe_can_read(const fieldscribe_can_dialogue *dialogue, uint8_t unit,
    const fieldscribe_can_reading *what, fieldscribe_can_frame *frame)
{
    const fieldscribe_can_content content = {unit, what->address, 0U};
    return fieldscribe_can_build(dialogue->profile, dialogue->read, &content, frame);
}

fieldscribe_can_status fieldscribe_can_read_answer(const fieldscribe_can_dialogue *dialogue, uint8_t unit,
    const fieldscribe_can_reading *what, const fieldscribe_can_frame *frame, uint16_t *word)
{
    fieldscribe_can_content content = {unit, what->address, 0U};
    const fieldscribe_can_status status = fieldscribe_can_answer(dialogue->read_answer, frame, &content);
    if (status == FIELDSCRIBE_CAN_OK) {
        *word = (uint16_t)(content.raw & 0xFFFFU);
    }
    return status;
}

fieldscribe_can_status fieldscribe_can_write(const fieldscribe_can_dialogue *dialogue, uint8_t unit,
    const fieldscribe_can_writing *what, uint16_t word, fieldscribe_can_frame *frame)
{
    const fieldscribe_can_content content = {unit, what->address, word};
    return fieldscribe_can_build(dialogue->profile, dialogue->write, &content, frame);
}

fieldscribe_can_status fieldscribe_can_write_answer(const fieldscribe_can_dialogue *dialogue, uint8_t unit,
    const fieldscribe_can_writing *what, uint16_t word, const fieldscribe_can_frame *frame)
{
    fieldscribe_can_content content = {unit, what->address, 0U};
    const fieldscribe_can_status status = fieldscribe_can_answer(dialogue->write_answer, frame, &content);
    if ((status == FIELDSCRIBE_CAN_OK) && (content.raw != word) &&
        fieldscribe_can_carries(dialogue->write_answer, FIELDSCRIBE_CAN_RAW)) {
        return FIELDSCRIBE_CAN_ECHO_MISMATCH;
    }
    return status;
}

fieldscribe_can_status fieldscribe_can_word_to_read(
    const fieldscribe_can_text_reading *text, size_t at, fieldscribe_can_reading *word)
{
    if (at >= text->words) {
        return FIELDSCRIBE_CAN_BAD_ADDRESS;
    }
    word->address = text->addresses[at];
    return FIELDSCRIBE_CAN_OK;
}

fieldscribe_can_status fieldscribe_can_word_to_write(
    const fieldscribe_can_text_writing *text, size_t at, fieldscribe_can_writing *word)
{
    if (at >= text->words) {
        return FIELDSCRIBE_CAN_BAD_ADDRESS;
    }
    word->address = text->addresses[at];
    return FIELDSCRIBE_CAN_OK;
}

/* ---- Cyclic telegrams ---- */

/* The number of words of a frame; limited to 1 up to the room of a slot, whatever the table says. */
static uint8_t fieldscribe_can_per_frame(const fieldscribe_can_telegram *telegram)
{
    if ((telegram->per_frame == 0U) || (telegram->per_frame > FIELDSCRIBE_CAN_WORDS)) {
        return (uint8_t)FIELDSCRIBE_CAN_WORDS;
    }
    return telegram->per_frame;
}

size_t fieldscribe_can_slots(const fieldscribe_can_telegram *telegram)
{
    const uint8_t per_frame = fieldscribe_can_per_frame(telegram);
    return ((size_t)telegram->words / per_frame) + (((telegram->words % per_frame) != 0U) ? 1U : 0U);
}

/* An empty slot. */
static const fieldscribe_can_slot fieldscribe_can_silent = {0U, 0U, 0U, 0U, {0U, 0U, 0U, 0U}, {0U, 0U, 0U, 0U}};

fieldscribe_can_receiver fieldscribe_can_listen(
    const fieldscribe_can_telegram *telegram, uint8_t unit, fieldscribe_can_slot *slots, size_t count)
{
    const size_t frames = fieldscribe_can_slots(telegram);
    fieldscribe_can_receiver receiver;
    size_t at;
    receiver.slot_count = ((slots == NULL) || (count < frames)) ? 0U : frames;
    for (at = 0U; at < receiver.slot_count; ++at) {
        slots[at] = fieldscribe_can_silent;
    }
    receiver.telegram = telegram;
    receiver.slots = slots;
    receiver.clock = 0U;
    receiver.changes = 0U;
    receiver.unit = unit;
    return receiver;
}

/* The words that a frame carries. */
static void fieldscribe_can_words(
    const fieldscribe_can_message *message, const fieldscribe_can_frame *frame, uint16_t words[FIELDSCRIBE_CAN_WORDS])
{
    unsigned at;
    for (at = 0U; at < FIELDSCRIBE_CAN_WORDS; ++at) {
        words[at] = 0U;
    }
    for (at = 0U; at < FIELDSCRIBE_CAN_BYTES; ++at) {
        const fieldscribe_can_role role = message->roles[at];
        if ((role.kind == (uint8_t)FIELDSCRIBE_CAN_WORD) && (role.number < FIELDSCRIBE_CAN_BYTES)) {
            uint16_t *const word = &words[role.number / 2U];
            *word = (uint16_t)(*word | ((uint32_t)frame->data[at] << (((role.number % 2U) != 0U) ? 0U : 8U)));
        }
    }
}

bool fieldscribe_can_unpack(const fieldscribe_can_telegram *telegram, uint8_t unit, const fieldscribe_can_frame *frame,
    size_t *part, uint16_t words[FIELDSCRIBE_CAN_WORDS])
{
    const fieldscribe_can_message *const message = telegram->message;
    uint8_t multiplexer = 0U;
    unsigned at;
    if ((unit < telegram->profile->first_unit) || (unit > telegram->profile->last_unit)) {
        return false;
    }
    if (fieldscribe_can_recognize(message, unit, frame) != FIELDSCRIBE_CAN_OK) {
        return false;
    }
    for (at = 0U; at < FIELDSCRIBE_CAN_BYTES; ++at) {
        if (message->roles[at].kind == (uint8_t)FIELDSCRIBE_CAN_MULTIPLEXER) {
            multiplexer = frame->data[at];
        }
    }
    if (multiplexer >= fieldscribe_can_slots(telegram)) {
        return false;
    }
    fieldscribe_can_words(message, frame, words);
    *part = multiplexer;
    return true;
}

bool fieldscribe_can_take(fieldscribe_can_receiver *receiver, const fieldscribe_can_frame *frame, uint32_t time)
{
    volatile uint32_t *const changes = &receiver->changes; /* volatile: keeps the order of the writes */
    volatile fieldscribe_can_slot *slot;
    uint16_t words[FIELDSCRIBE_CAN_WORDS] = {0U, 0U, 0U, 0U};
    size_t part = 0U;
    unsigned at;
    if (!fieldscribe_can_unpack(receiver->telegram, receiver->unit, frame, &part, words) ||
        (part >= receiver->slot_count)) {
        return false;
    }
    slot = &receiver->slots[part];
    ++receiver->clock;
    *changes = (*changes + 1U) & 0x7FFFFFFFU;
    slot->before = slot->now;
    slot->now = receiver->clock;
    slot->time_before = slot->time_now;
    slot->time_now = time;
    for (at = 0U; at < FIELDSCRIBE_CAN_WORDS; ++at) {
        slot->words_before[at] = slot->words_now[at];
        slot->words_now[at] = words[at];
    }
    *changes = (*changes + 1U) & 0x7FFFFFFFU;
    return true;
}

/* Copies a word's slot in a consistent state; MISSING if it is empty, or if the telegram has no such word. */
static fieldscribe_can_status fieldscribe_can_heard_slot(
    const fieldscribe_can_receiver *receiver, uint16_t position, fieldscribe_can_slot *copy)
{
    const volatile uint32_t *const changes = &receiver->changes; /* volatile: keeps the order of the reads */
    const size_t frame = (size_t)position / fieldscribe_can_per_frame(receiver->telegram);
    const volatile fieldscribe_can_slot *slot;
    uint32_t begin;
    uint32_t end;
    unsigned at;
    *copy = fieldscribe_can_silent;
    if ((position >= receiver->telegram->words) || (frame >= receiver->slot_count)) {
        return FIELDSCRIBE_CAN_MISSING;
    }
    slot = &receiver->slots[frame];
    do {
        begin = *changes;
        copy->now = slot->now;
        copy->before = slot->before;
        copy->time_now = slot->time_now;
        copy->time_before = slot->time_before;
        for (at = 0U; at < FIELDSCRIBE_CAN_WORDS; ++at) {
            copy->words_now[at] = slot->words_now[at];
            copy->words_before[at] = slot->words_before[at];
        }
        end = *changes;
    } while ((begin != end) && ((begin % 2U) == 0U)); /* a frame was taken during the copy */
    if ((begin % 2U) != 0U) {
        return FIELDSCRIBE_CAN_TORN;
    }
    return (copy->now == 0U) ? FIELDSCRIBE_CAN_MISSING : FIELDSCRIBE_CAN_OK;
}

fieldscribe_can_status fieldscribe_can_word(
    const fieldscribe_can_receiver *receiver, uint16_t position, uint16_t *word)
{
    fieldscribe_can_slot slot;
    const fieldscribe_can_status status = fieldscribe_can_heard_slot(receiver, position, &slot);
    if (status == FIELDSCRIBE_CAN_OK) {
        *word = slot.words_now[position % fieldscribe_can_per_frame(receiver->telegram)];
    }
    return status;
}

/* True if the same high word arrived before and after the low word, each in a frame of its own. */
static bool fieldscribe_can_around(
    const fieldscribe_can_slot *high, const fieldscribe_can_slot *low, uint8_t place)
{
    if ((high->before == 0U) || (high->words_before[place] != high->words_now[place])) {
        return false;
    }
    return (high->now > low->now) ? (high->before <= low->now)
                                  : ((low->before >= high->before) && (low->before <= high->now));
}

/* The high and the low word of a point and the times of their frames; the same twice for one word. */
static fieldscribe_can_status fieldscribe_can_pair(const fieldscribe_can_receiver *receiver,
    const fieldscribe_can_heard *what, uint16_t words[2], uint32_t times[2])
{
    const uint8_t per_frame = fieldscribe_can_per_frame(receiver->telegram);
    const uint8_t high_place = (uint8_t)(what->high % per_frame);
    const uint8_t low_place = (uint8_t)(what->low % per_frame);
    const bool apart = (what->high / per_frame) != (what->low / per_frame);
    fieldscribe_can_slot high;
    fieldscribe_can_slot low;
    const fieldscribe_can_status high_status = fieldscribe_can_heard_slot(receiver, what->high, &high);
    const fieldscribe_can_status low_status = fieldscribe_can_heard_slot(receiver, what->low, &low);
    bool before = false; /* the low word is that of the previous cycle */
    if ((high_status != FIELDSCRIBE_CAN_OK) || (low_status != FIELDSCRIBE_CAN_OK)) {
        return (high_status != FIELDSCRIBE_CAN_OK) ? high_status : low_status;
    }
    if (!apart) {
        low = high; /* both of the same frame */
    } else if (fieldscribe_can_around(&high, &low, high_place)) {
        before = high.now < low.now;
    } else {
        return FIELDSCRIBE_CAN_TORN;
    }
    words[0] = high.words_now[high_place];
    words[1] = before ? low.words_before[low_place] : low.words_now[low_place];
    times[0] = high.time_now;
    times[1] = before ? low.time_before : low.time_now;
    return FIELDSCRIBE_CAN_OK;
}

fieldscribe_can_status fieldscribe_can_received(const fieldscribe_can_receiver *receiver,
    const fieldscribe_can_heard *what, uint16_t *words, size_t count)
{
    const size_t needed = (what->high != what->low) ? 2U : 1U;
    fieldscribe_can_status status;
    uint16_t pair[2] = {0U, 0U};
    uint32_t times[2] = {0U, 0U};
    if ((words == NULL) || (count < needed)) {
        return FIELDSCRIBE_CAN_BUFFER_TOO_SMALL;
    }
    status = fieldscribe_can_pair(receiver, what, pair, times);
    if (status == FIELDSCRIBE_CAN_OK) {
        words[0] = pair[0];
        if (needed > 1U) {
            words[1] = pair[1];
        }
    }
    return status;
}

/* The time from one reading of a clock to a later one; the clock may have overflowed between them. */
static uint32_t fieldscribe_can_since(uint32_t time, uint32_t now)
{
    return (now >= time) ? (now - time) : (((UINT32_MAX - time) + now) + 1U);
}

fieldscribe_can_status fieldscribe_can_age(
    const fieldscribe_can_receiver *receiver, const fieldscribe_can_heard *what, uint32_t now, uint32_t *age)
{
    uint16_t pair[2] = {0U, 0U};
    uint32_t times[2] = {0U, 0U};
    const fieldscribe_can_status status = fieldscribe_can_pair(receiver, what, pair, times);
    if (status == FIELDSCRIBE_CAN_OK) {
        const uint32_t high = fieldscribe_can_since(times[0], now);
        const uint32_t low = fieldscribe_can_since(times[1], now);
        *age = (high > low) ? high : low;
    }
    return status;
}

fieldscribe_can_status fieldscribe_can_received_text(const fieldscribe_can_receiver *receiver,
    const fieldscribe_can_text_heard *what, uint16_t *words, size_t count)
{
    fieldscribe_can_status status =
        ((words == NULL) || (count < what->words)) ? FIELDSCRIBE_CAN_BUFFER_TOO_SMALL : FIELDSCRIBE_CAN_OK;
    size_t at;
    for (at = 0U; (at < what->words) && (status == FIELDSCRIBE_CAN_OK); ++at) {
        status = fieldscribe_can_word(receiver, what->positions[at], &words[at]);
    }
    return status;
}

/* ---- Signals ---- */

/* The number of words of a signal; at most 64 bits, whatever the table says. */
static uint16_t fieldscribe_can_words_of(const fieldscribe_can_signal *signal)
{
    return (uint16_t)(((signal->width < 64U) ? (signal->width + 15U) : 64U) / 16U);
}

/* The next bits of a signal: their byte, lowest bit in it, number, and position in the number. */
typedef struct fieldscribe_can_piece {
    size_t byte;
    unsigned low;
    unsigned bits;
    unsigned above;
} fieldscribe_can_piece;

/* The bits of a signal after the first `done`, in the order of the bytes on the bus; 0 bits: no more. */
static fieldscribe_can_piece fieldscribe_can_piece_at(const fieldscribe_can_signal *signal, unsigned done)
{
    const unsigned width = (signal->width < 64U) ? signal->width : 64U;
    const unsigned first = signal->low_first ? ((unsigned)signal->start % 8U) : (7U - ((unsigned)signal->start % 8U));
    const unsigned left = (done < width) ? (width - done) : 0U;
    const unsigned skipped = (first + done) % 8U;
    const unsigned there = 8U - skipped;
    fieldscribe_can_piece piece;
    piece.byte = ((size_t)signal->start / 8U) + ((first + done) / 8U);
    piece.bits = (there < left) ? there : left;
    piece.low = (signal->low_first ? skipped : (there - piece.bits)) & 7U;
    piece.above = (signal->low_first ? done : (left - piece.bits)) & 63U;
    return piece;
}

/* The bits of a signal as an unsigned number; missing bytes count as 0. */
static uint64_t fieldscribe_can_get(const fieldscribe_can_signal *signal, const uint8_t *data, size_t length)
{
    uint64_t raw = 0U;
    unsigned done = 0U;
    fieldscribe_can_piece piece = fieldscribe_can_piece_at(signal, done);
    while (piece.bits > 0U) {
        const uint32_t byte = (piece.byte < length) ? data[piece.byte] : 0U;
        raw |= (uint64_t)((byte >> piece.low) & ((1UL << piece.bits) - 1UL)) << piece.above;
        done += piece.bits;
        piece = fieldscribe_can_piece_at(signal, done);
    }
    return raw;
}

/* Sets the bits of a signal in bytes where they are 0. */
static void fieldscribe_can_set(const fieldscribe_can_signal *signal, uint64_t raw, uint8_t *data, size_t length)
{
    unsigned done = 0U;
    fieldscribe_can_piece piece = fieldscribe_can_piece_at(signal, done);
    while (piece.bits > 0U) {
        const uint32_t bits = (uint32_t)((raw >> piece.above) & ((1UL << piece.bits) - 1UL));
        if (piece.byte < length) {
            data[piece.byte] = (uint8_t)((data[piece.byte] | (bits << piece.low)) & 0xFFU);
        }
        done += piece.bits;
        piece = fieldscribe_can_piece_at(signal, done);
    }
}

/* True if a frame with these words has the signal. */
static bool fieldscribe_can_selected(const fieldscribe_can_signal *signal, const uint16_t *words, size_t count)
{
    bool fits = false;
    unsigned at;
    if (signal->when == NULL) {
        return true;
    }
    for (at = 0U; at < signal->choices; ++at) {
        const fieldscribe_can_choice *const choice = &signal->when[at];
        if ((choice->word < count) && (words[choice->word] == choice->raw)) {
            fits = true;
        }
        if (!choice->more) {
            if (!fits) {
                return false;
            }
            fits = false;
        }
    }
    return true;
}

uint32_t fieldscribe_can_signals_id(const fieldscribe_can_signals *message, uint8_t unit)
{
    return message->id + (message->adds_unit ? unit : 0U);
}

fieldscribe_can_status fieldscribe_can_take_signals(const fieldscribe_can_signals *message, uint8_t unit, uint32_t id,
    const uint8_t *data, size_t length, uint16_t *words, size_t count)
{
    size_t word = 0U;
    unsigned at;
    if ((unit < message->profile->first_unit) || (unit > message->profile->last_unit)) {
        return FIELDSCRIBE_CAN_BAD_UNIT;
    }
    if (id != fieldscribe_can_signals_id(message, unit)) {
        return FIELDSCRIBE_CAN_WRONG_ID;
    }
    if (length != message->length) {
        return FIELDSCRIBE_CAN_WRONG_LENGTH;
    }
    if (count < message->words) {
        return FIELDSCRIBE_CAN_BUFFER_TOO_SMALL;
    }
    for (at = 0U; at < message->count; ++at) {
        const uint64_t raw = fieldscribe_can_get(&message->signals[at], data, length);
        unsigned left = fieldscribe_can_words_of(&message->signals[at]);
        while ((left > 0U) && (word < count)) {
            const unsigned above = (16U * (left - 1U)) % 64U;
            words[word] = (uint16_t)((raw >> above) & 0xFFFFU);
            --left;
            ++word;
        }
    }
    return FIELDSCRIBE_CAN_OK;
}

fieldscribe_can_status fieldscribe_can_comes(
    const fieldscribe_can_signals *message, uint16_t word, const uint16_t *words, size_t count)
{
    size_t first = 0U;
    unsigned at = 0U;
    while ((at < message->count) && (first < word)) {
        first += fieldscribe_can_words_of(&message->signals[at]);
        ++at;
    }
    if ((at >= message->count) || (first != word)) {
        return FIELDSCRIBE_CAN_MISSING;
    }
    return fieldscribe_can_selected(&message->signals[at], words, count) ? FIELDSCRIBE_CAN_OK : FIELDSCRIBE_CAN_MISSING;
}

fieldscribe_can_status fieldscribe_can_put_signals(const fieldscribe_can_signals *message, const uint16_t *words,
    size_t count, uint8_t *data, size_t length)
{
    size_t word = 0U;
    size_t place;
    unsigned at;
    if ((count < message->words) || (length < message->length)) {
        return FIELDSCRIBE_CAN_BUFFER_TOO_SMALL;
    }
    for (place = 0U; place < length; ++place) {
        data[place] = 0U;
    }
    for (at = 0U; at < message->count; ++at) {
        const fieldscribe_can_signal *const signal = &message->signals[at];
        uint64_t raw = 0U;
        unsigned left = fieldscribe_can_words_of(signal);
        while ((left > 0U) && (word < count)) {
            raw = (raw << 16) | words[word];
            ++word;
            --left;
        }
        if (fieldscribe_can_selected(signal, words, count)) {
            fieldscribe_can_set(signal, raw, data, message->length);
        }
    }
    return FIELDSCRIBE_CAN_OK;
}

#endif
