/*
 * CAN frames by layout: builds messages and reads answers, and gathers cyclic telegrams that come in several frames.
 * No heap; the state of a receiver is the caller's. Any bytes at any length are safe to parse.
 *
 * SPDX-License-Identifier: 0BSD
 */
#ifndef FIELDSCRIBE_CAN_H
#define FIELDSCRIBE_CAN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What the headers of devices rely on: it grows when they have to be generated anew. */
#define FIELDSCRIBE_CAN_INTERFACE 1

/* All messages have eight bytes of data, which hold at most four words. */
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
    FIELDSCRIBE_CAN_WRONG_CONSTANT, /* a byte that is always the same is another */
    FIELDSCRIBE_CAN_WRONG_UNIT,
    FIELDSCRIBE_CAN_WRONG_CHECK,   /* bytes do not agree with those that they combine */
    FIELDSCRIBE_CAN_WRONG_ADDRESS, /* the answer is about another parameter */
    FIELDSCRIBE_CAN_ECHO_MISMATCH, /* the device answers a write with another word than the one that was written */
    /* telegrams */
    FIELDSCRIBE_CAN_MISSING, /* the frame that carries a word has not come yet */
    FIELDSCRIBE_CAN_TORN     /* two words of one number may be of different times: wait for more frames */
} fieldscribe_can_status;

/* A data frame; of `length` bytes (which a stranger may make larger than 8) the first eight are in `data`. */
typedef struct fieldscribe_can_frame {
    uint32_t id;
    uint8_t length;
    uint8_t data[FIELDSCRIBE_CAN_BYTES];
} fieldscribe_can_frame;

/* What a byte of a message carries. */
typedef enum fieldscribe_can_kind {
    FIELDSCRIBE_CAN_CONSTANT = 0, /* number: the byte */
    FIELDSCRIBE_CAN_UNIT,         /* number: how many bits the byte lies above bit 0; the same below */
    FIELDSCRIBE_CAN_ADDRESS,
    FIELDSCRIBE_CAN_RAW,
    FIELDSCRIBE_CAN_MULTIPLEXER,
    FIELDSCRIBE_CAN_WORD, /* number: twice the word of the frame, and 1 more for its low byte */
    FIELDSCRIBE_CAN_XOR   /* number: a mask of the bytes of the message that are combined */
} fieldscribe_can_kind;

typedef struct fieldscribe_can_role {
    uint8_t kind; /* a fieldscribe_can_kind */
    uint8_t number;
} fieldscribe_can_role;

/* A layout of bytes with an identifier, to which the unit number may be added. */
typedef struct fieldscribe_can_message {
    uint32_t id;
    bool adds_unit;
    fieldscribe_can_role roles[FIELDSCRIBE_CAN_BYTES];
} fieldscribe_can_message;

/* What a device understands. */
typedef struct fieldscribe_can_profile {
    uint8_t first_unit;
    uint8_t last_unit;
    uint8_t identifier_bits; /* 11 or 29 */
} fieldscribe_can_profile;

/* A cyclic layout of words; a message with a multiplexer carries `per_frame` of them at a time. */
typedef struct fieldscribe_can_telegram {
    const fieldscribe_can_profile *profile;
    const fieldscribe_can_message *message;
    uint16_t words;
    uint8_t per_frame;
} fieldscribe_can_telegram;

/* The words of one multiplexer, as they came last and the time before; `now` and `before` count taken frames, 0 is never. */
typedef struct fieldscribe_can_slot {
    uint64_t now;
    uint64_t before;
    uint16_t words_now[FIELDSCRIBE_CAN_WORDS];
    uint16_t words_before[FIELDSCRIBE_CAN_WORDS];
} fieldscribe_can_slot;

/* Gathers the frames of one telegram of one unit; `slots` has one item for each frame that the telegram consists of. */
typedef struct fieldscribe_can_receiver {
    const fieldscribe_can_telegram *telegram;
    fieldscribe_can_slot *slots;
    uint64_t clock;
    uint8_t unit;
} fieldscribe_can_receiver;

static inline uint32_t fieldscribe_can_id(const fieldscribe_can_message *message, uint8_t unit)
{
    return message->id + (message->adds_unit ? unit : 0U);
}

/* How far the byte of a role lies above bit 0 of its number; whatever a table says, less than the bits of a word. */
static inline unsigned fieldscribe_can_shift(fieldscribe_can_role role)
{
    return role.number & 0xFU;
}

/* The bytes in `mask`, combined by exclusive or. */
static inline uint8_t fieldscribe_can_xor(const uint8_t data[FIELDSCRIBE_CAN_BYTES], uint8_t mask)
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

/* The frame of a message. A message that carries no address or no raw number takes any; 0 is usual. */
static inline fieldscribe_can_status fieldscribe_can_build(const fieldscribe_can_profile *profile,
    const fieldscribe_can_message *message, uint32_t unit, uint32_t address, uint32_t raw, fieldscribe_can_frame *frame)
{
    unsigned at;
    if (unit < profile->first_unit || unit > profile->last_unit) {
        return FIELDSCRIBE_CAN_BAD_UNIT;
    }
    if (address > 0xFFFFU) {
        return FIELDSCRIBE_CAN_BAD_ADDRESS;
    }
    if (raw > 0xFFFFU) {
        return FIELDSCRIBE_CAN_BAD_VALUE;
    }
    frame->id = fieldscribe_can_id(message, (uint8_t)unit);
    frame->length = FIELDSCRIBE_CAN_BYTES;
    for (at = 0U; at < FIELDSCRIBE_CAN_BYTES; ++at) {
        const fieldscribe_can_role role = message->roles[at];
        uint32_t byte = 0U;
        if (role.kind == FIELDSCRIBE_CAN_CONSTANT) {
            byte = role.number;
        } else if (role.kind == FIELDSCRIBE_CAN_UNIT) {
            byte = unit >> fieldscribe_can_shift(role);
        } else if (role.kind == FIELDSCRIBE_CAN_ADDRESS) {
            byte = address >> fieldscribe_can_shift(role);
        } else if (role.kind == FIELDSCRIBE_CAN_RAW) {
            byte = raw >> fieldscribe_can_shift(role);
        }
        frame->data[at] = (uint8_t)(byte & 0xFFU);
    }
    for (at = 0U; at < FIELDSCRIBE_CAN_BYTES; ++at) {
        if (message->roles[at].kind == FIELDSCRIBE_CAN_XOR) {
            frame->data[at] = fieldscribe_can_xor(frame->data, message->roles[at].number);
        }
    }
    return FIELDSCRIBE_CAN_OK;
}

/* Whether every byte of that kind is what it has to be. */
static inline bool fieldscribe_can_agrees(
    const fieldscribe_can_message *message, uint8_t kind, uint8_t unit, const uint8_t data[FIELDSCRIBE_CAN_BYTES])
{
    unsigned at;
    for (at = 0U; at < FIELDSCRIBE_CAN_BYTES; ++at) {
        const fieldscribe_can_role role = message->roles[at];
        uint8_t expected = role.number; /* a constant */
        if (role.kind != kind) {
            continue;
        }
        if (kind == FIELDSCRIBE_CAN_UNIT) {
            expected = (uint8_t)((uint32_t)unit >> fieldscribe_can_shift(role));
        } else if (kind == FIELDSCRIBE_CAN_XOR) {
            expected = fieldscribe_can_xor(data, role.number);
        }
        if (data[at] != expected) {
            return false;
        }
    }
    return true;
}

/* Whether a frame is that message of that unit. */
static inline fieldscribe_can_status fieldscribe_can_recognize(
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

/* Reads address and raw number of a message; 0 for what it does not carry, and unless the result is OK. */
static inline fieldscribe_can_status fieldscribe_can_parse(const fieldscribe_can_message *message, uint8_t unit,
    const fieldscribe_can_frame *frame, uint16_t *address, uint16_t *raw)
{
    const fieldscribe_can_status status = fieldscribe_can_recognize(message, unit, frame);
    unsigned at;
    *address = 0U;
    *raw = 0U;
    if (status != FIELDSCRIBE_CAN_OK) {
        return status;
    }
    for (at = 0U; at < FIELDSCRIBE_CAN_BYTES; ++at) {
        const fieldscribe_can_role role = message->roles[at];
        if (role.kind == FIELDSCRIBE_CAN_ADDRESS) {
            *address = (uint16_t)((*address | ((uint32_t)frame->data[at] << fieldscribe_can_shift(role))) & 0xFFFFU);
        } else if (role.kind == FIELDSCRIBE_CAN_RAW) {
            *raw = (uint16_t)((*raw | ((uint32_t)frame->data[at] << fieldscribe_can_shift(role))) & 0xFFFFU);
        }
    }
    return FIELDSCRIBE_CAN_OK;
}

/* Whether a message has a byte of that kind. */
static inline bool fieldscribe_can_carries(const fieldscribe_can_message *message, uint8_t kind)
{
    unsigned at = 0U;
    while (at < FIELDSCRIBE_CAN_BYTES && message->roles[at].kind != kind) {
        ++at;
    }
    return at < FIELDSCRIBE_CAN_BYTES;
}

/* The frame that asks for the word at `address`. */
static inline fieldscribe_can_status fieldscribe_can_ask(const fieldscribe_can_profile *profile,
    const fieldscribe_can_message *message, uint8_t unit, uint16_t address, fieldscribe_can_frame *frame)
{
    return fieldscribe_can_build(profile, message, unit, address, 0U, frame);
}

/* Reads the word that answers for `address`; 0 unless the result is OK. */
static inline fieldscribe_can_status fieldscribe_can_answer(const fieldscribe_can_message *message, uint8_t unit,
    uint16_t address, const fieldscribe_can_frame *frame, uint16_t *word)
{
    uint16_t answered;
    const fieldscribe_can_status status = fieldscribe_can_parse(message, unit, frame, &answered, word);
    if (status == FIELDSCRIBE_CAN_OK && answered != address && fieldscribe_can_carries(message, FIELDSCRIBE_CAN_ADDRESS)) {
        *word = 0U;
        return FIELDSCRIBE_CAN_WRONG_ADDRESS;
    }
    return status;
}

/* Whether a frame confirms that `written` stands at `address` now: the device tells what it took. */
static inline fieldscribe_can_status fieldscribe_can_confirm(const fieldscribe_can_message *message, uint8_t unit,
    uint16_t address, uint16_t written, const fieldscribe_can_frame *frame)
{
    uint16_t word;
    const fieldscribe_can_status status = fieldscribe_can_answer(message, unit, address, frame, &word);
    if (status == FIELDSCRIBE_CAN_OK && word != written && fieldscribe_can_carries(message, FIELDSCRIBE_CAN_RAW)) {
        return FIELDSCRIBE_CAN_ECHO_MISMATCH;
    }
    return status;
}

/* ---- Cyclic telegrams ---- */

/* How many words a frame carries: whatever a table says, as many as a slot has room for, and not none. */
static inline uint8_t fieldscribe_can_per_frame(const fieldscribe_can_telegram *telegram)
{
    return telegram->per_frame == 0U || telegram->per_frame > FIELDSCRIBE_CAN_WORDS ? (uint8_t)FIELDSCRIBE_CAN_WORDS
                                                                                    : telegram->per_frame;
}

/* How many frames, and so slots, a telegram consists of. */
static inline size_t fieldscribe_can_slots(const fieldscribe_can_telegram *telegram)
{
    const uint8_t per_frame = fieldscribe_can_per_frame(telegram);
    return (size_t)telegram->words / per_frame + (telegram->words % per_frame != 0U ? 1U : 0U);
}

/* A receiver that has not heard anything yet. */
static inline fieldscribe_can_receiver fieldscribe_can_listen(
    const fieldscribe_can_telegram *telegram, uint8_t unit, fieldscribe_can_slot *slots)
{
    static const fieldscribe_can_slot silent = {0U, 0U, {0U, 0U, 0U, 0U}, {0U, 0U, 0U, 0U}};
    fieldscribe_can_receiver receiver;
    size_t at;
    for (at = 0U; at < fieldscribe_can_slots(telegram); ++at) {
        slots[at] = silent;
    }
    receiver.telegram = telegram;
    receiver.slots = slots;
    receiver.clock = 0U;
    receiver.unit = unit;
    return receiver;
}

/* Takes a frame, if it is one of the telegram. To a unit that the device cannot have nothing belongs. */
static inline bool fieldscribe_can_take(fieldscribe_can_receiver *receiver, const fieldscribe_can_frame *frame)
{
    const fieldscribe_can_message *const message = receiver->telegram->message;
    const fieldscribe_can_profile *const profile = receiver->telegram->profile;
    fieldscribe_can_slot *slot;
    uint8_t multiplexer = 0U;
    unsigned at;
    if (receiver->unit < profile->first_unit || receiver->unit > profile->last_unit) {
        return false;
    }
    if (fieldscribe_can_recognize(message, receiver->unit, frame) != FIELDSCRIBE_CAN_OK) {
        return false;
    }
    for (at = 0U; at < FIELDSCRIBE_CAN_BYTES; ++at) {
        if (message->roles[at].kind == FIELDSCRIBE_CAN_MULTIPLEXER) {
            multiplexer = frame->data[at];
        }
    }
    if (multiplexer >= fieldscribe_can_slots(receiver->telegram)) {
        return false;
    }
    slot = &receiver->slots[multiplexer];
    ++receiver->clock;
    slot->before = slot->now;
    slot->now = receiver->clock;
    for (at = 0U; at < FIELDSCRIBE_CAN_WORDS; ++at) {
        slot->words_before[at] = slot->words_now[at];
        slot->words_now[at] = 0U;
    }
    for (at = 0U; at < FIELDSCRIBE_CAN_BYTES; ++at) {
        const fieldscribe_can_role role = message->roles[at];
        if (role.kind == FIELDSCRIBE_CAN_WORD && role.number < FIELDSCRIBE_CAN_BYTES) {
            uint16_t *const word = &slot->words_now[role.number / 2U];
            *word = (uint16_t)(*word | ((uint32_t)frame->data[at] << (role.number % 2U != 0U ? 0U : 8U)));
        }
    }
    return true;
}

/* The slot of a word, into which something came; NULL if nothing did, or the telegram has no such word. */
static inline const fieldscribe_can_slot *fieldscribe_can_heard(
    const fieldscribe_can_receiver *receiver, uint16_t position)
{
    const fieldscribe_can_slot *slot;
    if (position >= receiver->telegram->words) {
        return NULL;
    }
    slot = &receiver->slots[position / fieldscribe_can_per_frame(receiver->telegram)];
    return slot->now == 0U ? NULL : slot;
}

/* The newest word at a position of the telegram, which counts from 0. */
static inline fieldscribe_can_status fieldscribe_can_word(
    const fieldscribe_can_receiver *receiver, uint16_t position, uint16_t *word)
{
    const fieldscribe_can_slot *const slot = fieldscribe_can_heard(receiver, position);
    if (slot == NULL) {
        return FIELDSCRIBE_CAN_MISSING;
    }
    *word = slot->words_now[position % fieldscribe_can_per_frame(receiver->telegram)];
    return FIELDSCRIBE_CAN_OK;
}

/*
 * The high and the low word of one number. Where they come in different frames, they are believed only when the same
 * high word came before and after the low one.
 */
static inline fieldscribe_can_status fieldscribe_can_pair(
    const fieldscribe_can_receiver *receiver, uint16_t high, uint16_t low, uint16_t *high_word, uint16_t *low_word)
{
    const uint8_t per_frame = fieldscribe_can_per_frame(receiver->telegram);
    const fieldscribe_can_slot *const a = fieldscribe_can_heard(receiver, high);
    const fieldscribe_can_slot *const b = fieldscribe_can_heard(receiver, low);
    uint16_t found_high;
    uint16_t found_low;
    if (a == NULL || b == NULL) {
        return FIELDSCRIBE_CAN_MISSING;
    }
    found_high = a->words_now[high % per_frame];
    found_low = b->words_now[low % per_frame];
    if (a != b) {
        const bool around = a->before != 0U && a->words_before[high % per_frame] == found_high;
        if (a->now > b->now) {
            if (!around || a->before > b->now) {
                return FIELDSCRIBE_CAN_TORN;
            }
        } else {
            if (!around || b->before < a->before || b->before > a->now) { /* never counts as before all */
                return FIELDSCRIBE_CAN_TORN;
            }
            found_low = b->words_before[low % per_frame];
        }
    }
    *high_word = found_high;
    *low_word = found_low;
    return FIELDSCRIBE_CAN_OK;
}

#ifdef __cplusplus
}
#endif

#endif
