/*
 * What conformance programs of CAN devices have beside the core: exchanges of points, and frames.
 *
 * SPDX-License-Identifier: 0BSD
 */
#ifndef FIELDSCRIBE_CONFORMANCE_CAN_H
#define FIELDSCRIBE_CONFORMANCE_CAN_H

#include "fieldscribe_conformance.h"
#include "fieldscribe_can.h"

typedef struct fieldscribe_named_message {
    const char *name;
    const fieldscribe_can_message *message;
} fieldscribe_named_message;

typedef struct fieldscribe_named_signals {
    const char *name;
    const fieldscribe_can_signals *message;
} fieldscribe_named_signals;

typedef struct fieldscribe_named_telegram {
    const char *name;
    const fieldscribe_can_telegram *telegram;
} fieldscribe_named_telegram;

/* A function that compares the struct of a telegram, or of a message of signals, with the frames of a vector. A text is
   compared with its words. */
typedef struct fieldscribe_named_values {
    const char *name;
    void (*hold)(fieldscribe_vector *v, const uint16_t *words);
} fieldscribe_named_values;

/* The tables of a device. */
typedef struct fieldscribe_tables {
    const fieldscribe_can_profile *profile;
    const fieldscribe_can_dialogue *dialogue; /* NULL when no message asks for parameters */
    const fieldscribe_named_message *messages;
    const fieldscribe_named_telegram *cyclic;
    const fieldscribe_named_signals *of_signals;
    const fieldscribe_named_values *values;
} fieldscribe_tables;

static inline const fieldscribe_tables *fieldscribe_tables_of(const fieldscribe_vector *v)
{
    return (const fieldscribe_tables *)v->suite->family;
}

/* Frames are their identifier in four bytes and their data. */
static inline fieldscribe_can_frame fieldscribe_frame_of(const char *field)
{
    uint8_t bytes[FIELDSCRIBE_BYTES_MOST] = {0U};
    const size_t length = fieldscribe_hex(field, bytes, 64U);
    fieldscribe_can_frame frame;
    frame.id = ((uint32_t)bytes[0] << 24) | ((uint32_t)bytes[1] << 16) | ((uint32_t)bytes[2] << 8) | bytes[3];
    frame.length = (uint8_t)(length > 4U ? length - 4U : 0U);
    memcpy(frame.data, bytes + 4, sizeof frame.data);
    return frame;
}

static inline void fieldscribe_sends_frame(fieldscribe_vector *v, const char *sent, const fieldscribe_can_frame *frame)
{
    const fieldscribe_can_frame expected = fieldscribe_frame_of(sent);
    fieldscribe_agree(v, expected.id == frame->id && expected.length == frame->length &&
        memcmp(expected.data, frame->data, sizeof expected.data) == 0);
}

/* For a device, a frame that is no answer is a time-out, as it keeps waiting. */
static inline void fieldscribe_is_answer(fieldscribe_vector *v, fieldscribe_can_status status)
{
    const bool answers = status == FIELDSCRIBE_CAN_OK || status == FIELDSCRIBE_CAN_ECHO_MISMATCH;
    fieldscribe_is_text(v, "status", answers ? fieldscribe_can_status_name(status) : "timeout");
}

/* The answer of a unit that was not asked changes nothing; and where nobody answers, no frame is an answer. */
static inline void fieldscribe_refuses_others(
    fieldscribe_vector *v, uint8_t unit, const fieldscribe_can_reading *what, const fieldscribe_can_frame *answer)
{
    fieldscribe_can_frame frame = *answer;
    fieldscribe_can_dialogue silent = *fieldscribe_tables_of(v)->dialogue;
    uint16_t other = 0x5A5AU;
    silent.read_answer = NULL;
    fieldscribe_agree(
        v, fieldscribe_can_read_answer(&silent, unit, what, answer, &other) == FIELDSCRIBE_CAN_WRONG_ID);
    frame.id ^= 1U;
    fieldscribe_agree(v, fieldscribe_can_read_answer(fieldscribe_tables_of(v)->dialogue, unit, what, &frame, &other) ==
        FIELDSCRIBE_CAN_WRONG_ID);
    fieldscribe_agree(v, other == 0x5A5AU);
}

/* Reads a parameter as in this step of the script; returns whether its word came. */
FIELDSCRIBE_ONCE bool fieldscribe_asks_for(
    fieldscribe_vector *v, size_t place, const fieldscribe_can_reading *what, uint16_t *word)
{
    const fieldscribe_can_dialogue *const dialogue = fieldscribe_tables_of(v)->dialogue;
    const uint8_t unit = (uint8_t)fieldscribe_bits(v, "unit");
    const char *sent = NULL;
    const char *received = NULL;
    fieldscribe_can_frame frame;
    fieldscribe_can_status status;
    if (!fieldscribe_step(v, place, &sent, &received)) {
        return false;
    }
    fieldscribe_agree(v, fieldscribe_can_read(dialogue, unit, what, &frame) == FIELDSCRIBE_CAN_OK);
    fieldscribe_sends_frame(v, sent, &frame);
    frame = fieldscribe_frame_of(received);
    *word = 0x5A5AU;
    status = fieldscribe_can_read_answer(dialogue, unit, what, &frame, word);
    fieldscribe_is_answer(v, status);
    if (status == FIELDSCRIBE_CAN_OK) {
        fieldscribe_agree(v, frame.length == fieldscribe_can_reply_length(dialogue->read_answer));
        fieldscribe_refuses_others(v, unit, what, &frame);
        return true;
    }
    fieldscribe_agree(v, *word == 0x5A5AU);
    return false;
}

/* Writes a word as in this step of the script. */
FIELDSCRIBE_ONCE void fieldscribe_writes_to(
    fieldscribe_vector *v, size_t place, const fieldscribe_can_writing *what, const uint16_t *word)
{
    const fieldscribe_can_dialogue *const dialogue = fieldscribe_tables_of(v)->dialogue;
    const uint8_t unit = (uint8_t)fieldscribe_bits(v, "unit");
    const char *sent = NULL;
    const char *received = NULL;
    fieldscribe_can_frame frame;
    if (fieldscribe_step(v, place, &sent, &received)) {
        fieldscribe_agree(v, fieldscribe_can_write(dialogue, unit, what, *word, &frame) == FIELDSCRIBE_CAN_OK);
        fieldscribe_sends_frame(v, sent, &frame);
        frame = fieldscribe_frame_of(received);
        fieldscribe_is_answer(v, fieldscribe_can_write_answer(dialogue, unit, what, *word, &frame));
    }
}

#define FIELDSCRIBE_READ(frame, kind)                                                            \
    if (fieldscribe_asks(v, "read")) {                                                           \
        uint16_t word;                                                                           \
        if (fieldscribe_asks_for(v, 0U, &(frame).read, &word)) {                                 \
            fieldscribe_taken_##kind(v, (frame).layout, &word);                                  \
        } else {                                                                                 \
            fieldscribe_agree(v, fieldscribe_bits(v, "raw") == 0U);                              \
        }                                                                                        \
    }

#define FIELDSCRIBE_WRITE(frame, kind)                                                           \
    if (fieldscribe_asks(v, "write")) {                                                          \
        uint16_t word = 0x5A5AU;                                                                 \
        fieldscribe_put_field_##kind(v, (frame).layout, "raw", &word);                           \
        fieldscribe_writes_to(v, 0U, &(frame).write, &word);                                     \
    }

/* A group of bits: its word is read, and written back with other bits. */
#define FIELDSCRIBE_WRITE_SHARED(frame, kind)                                                    \
    if (fieldscribe_asks(v, "write")) {                                                          \
        uint16_t word;                                                                           \
        if (fieldscribe_asks_for(v, 0U, &(frame).read, &word)) {                                 \
            fieldscribe_put_field_##kind(v, (frame).layout, "raw", &word);                       \
            fieldscribe_writes_to(v, 1U, &(frame).update, &word);                                \
        }                                                                                        \
    }

/* Texts travel word by word; the script is in the order of the addresses. */
#define FIELDSCRIBE_READ_TEXT(point, macro)                                                      \
    if (fieldscribe_asks(v, "read")) {                                                           \
        fieldscribe_can_reading one = {0U};                                                      \
        uint16_t sorted[macro##_WORDS] = {0U};                                                   \
        size_t at;                                                                               \
        for (at = 0U; at < macro##_WORDS; ++at) {                                                \
            const size_t rank = fieldscribe_rank(point##_addresses, macro##_WORDS, at);          \
            fieldscribe_agree(v, fieldscribe_can_word_to_read(&point##_frame.read, at, &one) == FIELDSCRIBE_CAN_OK); \
            if (!fieldscribe_asks_for(v, rank, &one, &sorted[rank])) {                           \
                sorted[rank] = 0U;                                                               \
            }                                                                                    \
        }                                                                                        \
        fieldscribe_agree(v,                                                                     \
            fieldscribe_can_word_to_read(&point##_frame.read, at, &one) == FIELDSCRIBE_CAN_BAD_ADDRESS); \
        fieldscribe_is_words(v, "words", sorted, macro##_WORDS);                                 \
    }

#define FIELDSCRIBE_WRITE_TEXT(point, macro)                                                     \
    if (fieldscribe_asks(v, "write")) {                                                          \
        fieldscribe_can_writing one = {0U};                                                      \
        uint16_t sorted[macro##_WORDS] = {0U};                                                   \
        size_t at;                                                                               \
        fieldscribe_agree(v, fieldscribe_numbers(v, "words", sorted, macro##_WORDS) == macro##_WORDS); \
        for (at = 0U; at < macro##_WORDS; ++at) {                                                \
            const size_t rank = fieldscribe_rank(point##_addresses, macro##_WORDS, at);          \
            fieldscribe_agree(v, fieldscribe_can_word_to_write(&point##_frame.write, at, &one) == FIELDSCRIBE_CAN_OK); \
            fieldscribe_writes_to(v, rank, &one, &sorted[rank]);                                 \
        }                                                                                        \
        fieldscribe_agree(v,                                                                     \
            fieldscribe_can_word_to_write(&point##_frame.write, at, &one) == FIELDSCRIBE_CAN_BAD_ADDRESS); \
    }

/* The struct that the frames of the vector fill has the point's number, or the text in these words. */
FIELDSCRIBE_ONCE void fieldscribe_holds_values(fieldscribe_vector *v, const uint16_t *words)
{
    const fieldscribe_named_values *one = fieldscribe_tables_of(v)->values;
    while (one->name != NULL && !fieldscribe_spells(fieldscribe_field(v, "telegram"), one->name)) {
        ++one;
    }
    if (one->name != NULL) {
        one->hold(v, words);
    }
}

FIELDSCRIBE_ONCE fieldscribe_can_frame fieldscribe_read_frame(uint64_t id, const char *data)
{
    uint8_t bytes[FIELDSCRIBE_BYTES_MOST] = {0U};
    fieldscribe_can_frame frame;
    frame.id = (uint32_t)id;
    frame.length = (uint8_t)fieldscribe_hex(data, bytes, 255U);
    memcpy(frame.data, bytes, sizeof frame.data);
    return frame;
}

/* Reads the next frame of the field `frames`, such as `801=0102,802=03`; false after the last. */
FIELDSCRIBE_ONCE bool fieldscribe_next_frame(const char **at, fieldscribe_can_frame *frame)
{
    const char *data;
    if (*at == NULL || fieldscribe_absent(*at)) {
        return false;
    }
    data = strchr(*at, '=');
    *frame = fieldscribe_read_frame(fieldscribe_pattern(*at), data != NULL ? data + 1 : "");
    *at = strchr(*at, ',');
    *at = *at != NULL ? *at + 1 : NULL;
    return true;
}

/* The received frames came at times from 0 on; a clock may wrap around. */
FIELDSCRIBE_ONCE void fieldscribe_ages(fieldscribe_vector *v, const fieldscribe_can_heard *what)
{
    const fieldscribe_can_receiver *const receiver = (const fieldscribe_can_receiver *)v->receiver;
    uint32_t age = 0U;
    uint32_t later = 0U;
    fieldscribe_agree(v, fieldscribe_can_age(receiver, what, 1000U, &age) == FIELDSCRIBE_CAN_OK && age <= 1000U &&
        fieldscribe_can_age(receiver, what, UINT32_MAX, &later) == FIELDSCRIBE_CAN_OK &&
        later - age == UINT32_MAX - 1000U);
    fieldscribe_agree(v, what->high / receiver->telegram->per_frame != what->low / receiver->telegram->per_frame ||
        1000U - age == receiver->slots[what->high / receiver->telegram->per_frame].time_now);
}

/* A point of a telegram, from the received frames. */
#define FIELDSCRIBE_RECEIVED(frame, kind)                                                        \
    if (fieldscribe_asks(v, "can_telegram")) {                                                   \
        uint16_t words[3];                                                                       \
        fieldscribe_can_status status;                                                           \
        fieldscribe_fill(words, sizeof words);                                                   \
        fieldscribe_agree(v, fieldscribe_can_received((const fieldscribe_can_receiver *)v->receiver, &(frame).heard, \
            words, (frame).layout->words - 1U) == FIELDSCRIBE_CAN_BUFFER_TOO_SMALL);             \
        status = fieldscribe_can_received(                                                       \
            (const fieldscribe_can_receiver *)v->receiver, &(frame).heard, words, (frame).layout->words); \
        fieldscribe_is_text(v, "status", fieldscribe_can_status_name(status));                   \
        if (status == FIELDSCRIBE_CAN_OK) {                                                      \
            fieldscribe_untouched(v, words + (frame).layout->words, sizeof words[0]);            \
            fieldscribe_taken_##kind(v, (frame).layout, words);                                  \
            fieldscribe_ages(v, &(frame).heard);                                                 \
            fieldscribe_holds_values(v, words);                                                  \
        } else {                                                                                 \
            fieldscribe_untouched(v, words, sizeof words);                                       \
            fieldscribe_agree(v, fieldscribe_bits(v, "raw") == 0U);                              \
        }                                                                                        \
    }

/* A message of signals, by the name of its telegram; NULL when there is none. */
static inline const fieldscribe_can_signals *fieldscribe_find_signals(fieldscribe_vector *v)
{
    const fieldscribe_named_signals *one = fieldscribe_tables_of(v)->of_signals;
    while (one->name != NULL && !fieldscribe_spells(fieldscribe_field(v, "telegram"), one->name)) {
        ++one;
    }
    return one->message;
}

/* Room for all words of a message of signals, and one more. */
#define FIELDSCRIBE_SIGNAL_WORDS 513U

/* Extracts the words of the frame of a line; returns the status for the signal of this word. */
FIELDSCRIBE_ONCE fieldscribe_can_status fieldscribe_takes_signals(
    fieldscribe_vector *v, uint16_t word, uint16_t words[FIELDSCRIBE_SIGNAL_WORDS])
{
    const fieldscribe_can_signals *const message = fieldscribe_find_signals(v);
    const uint8_t unit = (uint8_t)fieldscribe_at_most(v, "unit", 255U);
    const uint32_t id = (uint32_t)fieldscribe_bits(v, "id");
    uint8_t data[FIELDSCRIBE_BYTES_MOST] = {0U};
    const size_t length = fieldscribe_hex(fieldscribe_field(v, "bytes"), data, FIELDSCRIBE_BYTES_MOST);
    const size_t count = message->words;
    fieldscribe_can_status status;
    size_t at;
    for (at = 0U; at < message->count; ++at) {
        fieldscribe_agree(v, (message->signals[at].when == NULL) == (message->signals[at].choices == 0U));
    }
    fieldscribe_fill(words, FIELDSCRIBE_SIGNAL_WORDS * sizeof words[0]);
    status = fieldscribe_can_take_signals(message, unit, id, data, length, words, count);
    if (status != FIELDSCRIBE_CAN_OK) {
        fieldscribe_untouched(v, words, FIELDSCRIBE_SIGNAL_WORDS * sizeof words[0]);
        return status;
    }
    fieldscribe_untouched(v, words + count, (FIELDSCRIBE_SIGNAL_WORDS - count) * sizeof words[0]);
    fieldscribe_agree(v, fieldscribe_can_take_signals(message, unit, id, data, length, words, count - 1U) ==
        FIELDSCRIBE_CAN_BUFFER_TOO_SMALL);
    if (message->profile->last_unit < 255U) {
        const uint8_t other = (uint8_t)(message->profile->last_unit + 1U);
        fieldscribe_agree(v, fieldscribe_can_take_signals(message, other, id, data, length, words, count) ==
            FIELDSCRIBE_CAN_BAD_UNIT);
    }
    fieldscribe_agree(v, fieldscribe_can_comes(message, message->words, words, count) == FIELDSCRIBE_CAN_MISSING);
    return fieldscribe_can_comes(message, word, words, count);
}

/* The words of one signal, and the numbers that select it, become the bytes of the line. */
FIELDSCRIBE_ONCE void fieldscribe_puts_signals(fieldscribe_vector *v, uint16_t word, uint16_t *words)
{
    const fieldscribe_can_signals *const message = fieldscribe_find_signals(v);
    uint8_t data[FIELDSCRIBE_BYTES_MOST] = {0U};
    uint8_t expected[FIELDSCRIBE_BYTES_MOST] = {0U};
    const size_t length = fieldscribe_hex(fieldscribe_field(v, "packed"), expected, FIELDSCRIBE_BYTES_MOST);
    size_t first = 0U;
    unsigned at = 0U;
    while (at < message->count && first < word) {
        first += fieldscribe_can_words_of(&message->signals[at]);
        ++at;
    }
    if (at < message->count && message->signals[at].when != NULL) {
        const fieldscribe_can_signal *const signal = &message->signals[at];
        for (at = 0U; at < signal->choices; ++at) {
            words[signal->when[at].word] = signal->when[at].raw;
        }
    }
    fieldscribe_fill(data, sizeof data);
    fieldscribe_agree(v, fieldscribe_can_put_signals(message, words, message->words, data, length) ==
        FIELDSCRIBE_CAN_OK && length == message->length && memcmp(data, expected, length) == 0);
    fieldscribe_untouched(v, data + length, sizeof data - length);
    fieldscribe_agree(v, fieldscribe_can_put_signals(message, words, message->words, data, length - 1U) ==
        FIELDSCRIBE_CAN_BUFFER_TOO_SMALL);
    fieldscribe_agree(v, fieldscribe_can_put_signals(message, words, message->words - 1U, data, length) ==
        FIELDSCRIBE_CAN_BUFFER_TOO_SMALL);
}

/* A signal of a message, extracted from a frame and inserted into one. */
#define FIELDSCRIBE_SIGNAL(frame, kind)                                                          \
    if (fieldscribe_asks(v, "can_signal")) {                                                     \
        uint16_t words[FIELDSCRIBE_SIGNAL_WORDS];                                                \
        const fieldscribe_can_status status = fieldscribe_takes_signals(v, (frame).heard.high, words); \
        fieldscribe_agree(v, (frame).heard.low + 1U == (frame).heard.high + (frame).layout->words); \
        fieldscribe_is_text(v, "status", fieldscribe_can_status_name(status));                   \
        if (status == FIELDSCRIBE_CAN_OK) {                                                      \
            fieldscribe_taken_##kind(v, (frame).layout, words + (frame).heard.high);             \
            fieldscribe_holds_values(v, words + (frame).heard.high);                             \
            memset(words, 0, sizeof words);                                                      \
            fieldscribe_put_field_##kind(v, (frame).layout, "raw", words + (frame).heard.high);  \
            fieldscribe_puts_signals(v, (frame).heard.high, words);                              \
        } else {                                                                                 \
            fieldscribe_agree(v, fieldscribe_bits(v, "raw") == 0U);                              \
        }                                                                                        \
    }

/* A text of a telegram: its words in reading order. */
#define FIELDSCRIBE_RECEIVED_TEXT(point, macro)                                                  \
    if (fieldscribe_asks(v, "can_text")) {                                                       \
        uint16_t words[macro##_WORDS + 1U];                                                      \
        fieldscribe_can_status status;                                                           \
        fieldscribe_fill(words, sizeof words);                                                   \
        fieldscribe_agree(v, fieldscribe_can_received_text((const fieldscribe_can_receiver *)v->receiver, \
            &point##_frame.heard, words, macro##_WORDS - 1U) == FIELDSCRIBE_CAN_BUFFER_TOO_SMALL); \
        fieldscribe_untouched(v, words, sizeof words);                                           \
        status = fieldscribe_can_received_text(                                                  \
            (const fieldscribe_can_receiver *)v->receiver, &point##_frame.heard, words, macro##_WORDS); \
        fieldscribe_is_text(v, "status", fieldscribe_can_status_name(status));                   \
        fieldscribe_is_words(v, "words", words, status == FIELDSCRIBE_CAN_OK ? macro##_WORDS : 0U); \
        fieldscribe_untouched(v, words + macro##_WORDS, sizeof words[0]);                        \
        if (status == FIELDSCRIBE_CAN_OK) {                                                      \
            fieldscribe_holds_values(v, words);                                                  \
        }                                                                                        \
    }

/* ---- Frames ---- */

static const fieldscribe_can_message *fieldscribe_find_message(fieldscribe_vector *v)
{
    const fieldscribe_named_message *one = fieldscribe_tables_of(v)->messages;
    while (one->name != NULL && !fieldscribe_spells(fieldscribe_field(v, "message"), one->name)) {
        ++one;
    }
    return one->message;
}

/* Bytes that do not come from the content of a message are still 0. */
static void fieldscribe_leaves_others(
    fieldscribe_vector *v, const fieldscribe_can_message *message, const fieldscribe_can_content *content)
{
    fieldscribe_can_message other = *message;
    fieldscribe_can_content full = *content;
    fieldscribe_can_frame frame;
    other.roles[0].kind = (uint8_t)FIELDSCRIBE_CAN_MULTIPLEXER;
    other.roles[0].number = 0U;
    full.raw = 0xFFFFU;
    fieldscribe_agree(v, fieldscribe_can_build(fieldscribe_tables_of(v)->profile, &other, &full, &frame) ==
        FIELDSCRIBE_CAN_OK);
    fieldscribe_agree(v, frame.data[0] == 0U);
}

static void fieldscribe_run_can_build(fieldscribe_vector *v)
{
    const fieldscribe_can_message *const message = fieldscribe_find_message(v);
    fieldscribe_can_content content;
    fieldscribe_can_frame frame;
    fieldscribe_can_status status;
    content.unit = fieldscribe_at_most(v, "unit", UINT32_MAX);
    content.address = fieldscribe_at_most(v, "address", UINT32_MAX);
    content.raw = fieldscribe_at_most(v, "raw", UINT32_MAX);
    fieldscribe_fill(&frame, sizeof frame);
    if (message != NULL) {
        status = fieldscribe_can_build(fieldscribe_tables_of(v)->profile, message, &content, &frame);
        fieldscribe_is_text(v, "status", fieldscribe_can_status_name(status));
        if (status == FIELDSCRIBE_CAN_OK) {
            fieldscribe_is_number(v, "id", frame.id);
            fieldscribe_agree(v, frame.length == FIELDSCRIBE_CAN_BYTES);
            fieldscribe_is_bytes(v, "bytes", frame.data, FIELDSCRIBE_CAN_BYTES);
            fieldscribe_leaves_others(v, message, &content);
        } else {
            fieldscribe_untouched(v, &frame, sizeof frame);
        }
    }
}

static void fieldscribe_run_can_parse(fieldscribe_vector *v)
{
    const fieldscribe_can_message *const message = fieldscribe_find_message(v);
    const fieldscribe_can_frame frame =
        fieldscribe_read_frame(fieldscribe_bits(v, "id"), fieldscribe_field(v, "bytes"));
    fieldscribe_can_content content = {0U, 1U, 1U};
    fieldscribe_can_status status;
    if (message != NULL) {
        content.unit = fieldscribe_at_most(v, "unit", UINT32_MAX);
        status = fieldscribe_can_parse(message, &frame, &content);
        fieldscribe_is_text(v, "status", fieldscribe_can_status_name(status));
        fieldscribe_is_count(v, "address", content.address);
        fieldscribe_is_count(v, "raw", content.raw);
    }
}

/* Slots in a caller's memory, followed by one that is not theirs. */
typedef struct fieldscribe_slots {
    fieldscribe_can_slot all[257];
} fieldscribe_slots;

/* A receiver whose slots are too few has no word, and touches none of them. */
static inline bool fieldscribe_hears_nothing(const fieldscribe_can_receiver *receiver)
{
    uint16_t word = 0x5A5AU;
    return fieldscribe_can_word(receiver, 0U, &word) == FIELDSCRIBE_CAN_MISSING && word == 0x5A5AU;
}

/* A receiver takes no frame for an impossible unit, and none without enough slots. */
static void fieldscribe_has_no_such_unit(
    fieldscribe_vector *v, const fieldscribe_can_receiver *receiver, const fieldscribe_can_frame *frame)
{
    static fieldscribe_slots slots;
    fieldscribe_can_profile profile = *receiver->telegram->profile;
    fieldscribe_can_telegram telegram = *receiver->telegram;
    fieldscribe_can_receiver other;
    if (fieldscribe_can_slots(&telegram) <= 256U && receiver->unit > 0U && receiver->unit < 255U) {
        telegram.profile = &profile;
        other = fieldscribe_can_listen(&telegram, receiver->unit, slots.all, fieldscribe_can_slots(&telegram) - 1U);
        fieldscribe_agree(v, !fieldscribe_can_take(&other, frame, 0U) && fieldscribe_hears_nothing(&other));
        other = fieldscribe_can_listen(&telegram, receiver->unit, slots.all, fieldscribe_can_slots(&telegram));
        profile.first_unit = (uint8_t)(receiver->unit + 1U);
        fieldscribe_agree(v, !fieldscribe_can_take(&other, frame, 0U));
        profile.first_unit = 0U;
        profile.last_unit = (uint8_t)(receiver->unit - 1U);
        fieldscribe_agree(v, !fieldscribe_can_take(&other, frame, 0U));
    }
}

/* Any byte may hold the number of the frame: it is exchanged with the first one. */
static void fieldscribe_finds_the_frame(
    fieldscribe_vector *v, const fieldscribe_can_receiver *receiver, const fieldscribe_can_frame *frame)
{
    static fieldscribe_slots slots;
    fieldscribe_can_message message = *receiver->telegram->message;
    fieldscribe_can_telegram telegram = *receiver->telegram;
    fieldscribe_can_frame turned = *frame;
    fieldscribe_can_receiver other;
    unsigned at = 0U;
    while (at < FIELDSCRIBE_CAN_BYTES && message.roles[at].kind != (uint8_t)FIELDSCRIBE_CAN_MULTIPLEXER) {
        ++at;
    }
    if (at == FIELDSCRIBE_CAN_BYTES || fieldscribe_can_carries(&message, FIELDSCRIBE_CAN_XOR) ||
        fieldscribe_can_slots(&telegram) > 256U) {
        return;
    }
    message.roles[0] = receiver->telegram->message->roles[at];
    message.roles[at] = receiver->telegram->message->roles[0];
    turned.data[0] = frame->data[at];
    turned.data[at] = frame->data[0];
    telegram.message = &message;
    other = fieldscribe_can_listen(&telegram, receiver->unit, slots.all, 256U);
    fieldscribe_agree(v, fieldscribe_can_take(&other, &turned, 9U) && slots.all[frame->data[at]].now == 1U &&
        slots.all[frame->data[at]].time_now == 9U);
}

/* Feeds the frames of a line to a receiver, which takes those that it should. */
static void fieldscribe_feed(fieldscribe_vector *v, fieldscribe_can_receiver *receiver)
{
    uint16_t taken[FIELDSCRIBE_BYTES_MOST] = {0U};
    uint16_t expected_taken[FIELDSCRIBE_BYTES_MOST] = {0U};
    const size_t count = fieldscribe_numbers(v, "taken", expected_taken, FIELDSCRIBE_BYTES_MOST);
    const char *at = fieldscribe_field(v, "frames");
    size_t fed = 0U;
    size_t part;
    uint16_t words[FIELDSCRIBE_CAN_WORDS];
    fieldscribe_can_frame frame;
    while (fed < (size_t)FIELDSCRIBE_BYTES_MOST && fieldscribe_next_frame(&at, &frame)) {
        taken[fed] = fieldscribe_can_take(receiver, &frame, (uint32_t)fed) ? 1U : 0U;
        fieldscribe_agree(v,
            fieldscribe_can_unpack(receiver->telegram, receiver->unit, &frame, &part, words) == (taken[fed] != 0U));
        if (taken[fed] != 0U) {
            fieldscribe_has_no_such_unit(v, receiver, &frame);
            fieldscribe_finds_the_frame(v, receiver, &frame);
        }
        ++fed;
    }
    fieldscribe_agree(v, fed == count && memcmp(taken, expected_taken, fed * sizeof taken[0]) == 0);
}

/* The telegram of the line, with a receiver that has received nothing; NULL if there is none. */
static const fieldscribe_named_telegram *fieldscribe_listen(
    fieldscribe_vector *v, fieldscribe_slots *slots, fieldscribe_can_receiver *receiver)
{
    const fieldscribe_named_telegram *one = fieldscribe_tables_of(v)->cyclic;
    while (one->name != NULL && !fieldscribe_spells(fieldscribe_field(v, "telegram"), one->name)) {
        ++one;
    }
    if (one->name == NULL || fieldscribe_can_slots(one->telegram) > 256U) {
        return NULL;
    }
    fieldscribe_fill(slots, sizeof *slots);
    *receiver = fieldscribe_can_listen(one->telegram, (uint8_t)fieldscribe_at_most(v, "unit", 255U), slots->all,
        fieldscribe_can_slots(one->telegram));
    return one;
}

/* Checks that nothing was stored after the slots, and that a wrong table counts as the most words in a frame. */
static void fieldscribe_stays_inside(
    fieldscribe_vector *v, const fieldscribe_slots *slots, const fieldscribe_can_telegram *telegram)
{
    const size_t used = fieldscribe_can_slots(telegram);
    fieldscribe_can_telegram odd = *telegram;
    fieldscribe_untouched(v, slots->all + used, sizeof *slots - used * sizeof slots->all[0]);
    odd.words = 9U;
    odd.per_frame = 0U;
    fieldscribe_agree(v, fieldscribe_can_slots(&odd) == 3U);
    odd.per_frame = 5U;
    fieldscribe_agree(v, fieldscribe_can_slots(&odd) == 3U);
    odd.per_frame = 3U;
    fieldscribe_agree(v, fieldscribe_can_slots(&odd) == 3U && fieldscribe_can_per_frame(&odd) == 3U);
}

static void fieldscribe_run_can_telegram(fieldscribe_vector *v)
{
    static fieldscribe_slots slots;
    fieldscribe_can_receiver receiver;
    const fieldscribe_named_telegram *const one = fieldscribe_listen(v, &slots, &receiver);
    if (one != NULL) {
        v->receiver = &receiver;
        fieldscribe_feed(v, &receiver);
        fieldscribe_stays_inside(v, &slots, one->telegram);
        v->answered = false; /* until the point answers too */
        fieldscribe_run_point(v);
        v->receiver = NULL;
    }
}

static void fieldscribe_run_can_taken(fieldscribe_vector *v)
{
    static fieldscribe_slots slots;
    fieldscribe_can_receiver receiver;
    const fieldscribe_named_telegram *const one = fieldscribe_listen(v, &slots, &receiver);
    uint16_t word = 0x5A5AU;
    if (one != NULL) {
        fieldscribe_agree(v, fieldscribe_can_word(&receiver, one->telegram->words, &word) == FIELDSCRIBE_CAN_MISSING);
        fieldscribe_feed(v, &receiver);
        fieldscribe_stays_inside(v, &slots, one->telegram);
        fieldscribe_agree(v, fieldscribe_can_word(&receiver, one->telegram->words, &word) == FIELDSCRIBE_CAN_MISSING);
        fieldscribe_agree(v, word == 0x5A5AU);
    }
}

static void fieldscribe_run_limit(fieldscribe_vector *v)
{
    const fieldscribe_can_profile *const profile = fieldscribe_tables_of(v)->profile;
    fieldscribe_holds_long_numbers(v);
    FIELDSCRIBE_NAMES_STATUS(can, CAN, "buffer_too_small", BUFFER_TOO_SMALL)
    FIELDSCRIBE_NAMES_STATUS(can, CAN, "wrong_address", WRONG_ADDRESS)
    FIELDSCRIBE_LIMIT("first_unit", profile->first_unit)
    FIELDSCRIBE_LIMIT("last_unit", profile->last_unit)
    FIELDSCRIBE_LIMIT("identifier_bits", profile->identifier_bits)
}

static bool fieldscribe_run_frame(fieldscribe_vector *v)
{
    if (fieldscribe_asks(v, "limit")) {
        fieldscribe_run_limit(v);
    } else if (fieldscribe_asks(v, "can_taken")) {
        fieldscribe_run_can_taken(v);
    } else if (fieldscribe_asks(v, "can_build")) {
        fieldscribe_run_can_build(v);
    } else if (fieldscribe_asks(v, "can_reply")) {
        fieldscribe_run_can_parse(v);
    } else if (fieldscribe_asks(v, "can_signal")) {
        v->answered = false; /* until the point answers too */
        fieldscribe_run_point(v);
    } else if (fieldscribe_asks(v, "can_telegram") || fieldscribe_asks(v, "can_text")) {
        fieldscribe_run_can_telegram(v);
    } else {
        return false;
    }
    return true;
}

#endif
