/*
 * Proofs of fieldscribe_can.h: one harness or more for each of its functions, named prove_FUNCTION or
 * prove_FUNCTION__WHAT. Messages have any roles with any numbers. A receiver has exactly the slots of its telegram.
 */
#define FIELDSCRIBE_IMPLEMENTATION
#include "arbitrary.h"
#include "fieldscribe_can.h"

#ifdef ENDS
#define WORDS 6U
#else
#define WORDS 12U /* of a telegram that is followed with exactly its slots */
#endif
#define SLOTS (LARGE / sizeof(fieldscribe_can_slot))

static uint8_t data[FIELDSCRIBE_CAN_BYTES];
static uint16_t word[2];
static fieldscribe_can_role role;
static fieldscribe_can_message message;
static fieldscribe_can_profile profile;
static fieldscribe_can_frame frame;
static fieldscribe_can_slot slots[SLOTS];
static fieldscribe_can_slot slot;
static fieldscribe_can_telegram telegram;
static fieldscribe_can_receiver receiver;
static fieldscribe_can_content content;
static fieldscribe_can_dialogue dialogue;
static fieldscribe_can_reading reading;
static fieldscribe_can_writing writing;
static fieldscribe_can_text_reading text_reading;
static fieldscribe_can_text_writing text_writing;
static fieldscribe_can_heard where;
static fieldscribe_can_text_heard text_where;
static uint16_t text[WORDS];
static uint16_t positions[WORDS];
static uint16_t pair[2];
static uint32_t times[2];
static fieldscribe_can_choice choices[3];
static fieldscribe_can_signal signal;
static fieldscribe_can_signal rows[2];
static fieldscribe_can_signals signals;
static uint8_t bytes[3];
static volatile uint8_t number;
static volatile uint32_t time;

/* A telegram of so many words, and a receiver that heard anything. */
static void hear(uint16_t words, uint8_t per_frame)
{
    message.adds_unit = number % 2U != 0U;
    telegram.profile = &profile;
    telegram.message = &message;
    telegram.words = words;
    telegram.per_frame = per_frame;
    receiver.telegram = &telegram;
    receiver.slot_count = fieldscribe_can_slots(&telegram);
    receiver.slots = EXACTLY(receiver.slot_count, slots);
}

void prove_id(uint8_t unit)
{
    hear(0U, 1U);
    (void)fieldscribe_can_id(&message, unit);
}

void prove_shift(void)
{
    (void)fieldscribe_can_shift(role);
}

void prove_xor(uint8_t mask)
{
    (void)fieldscribe_can_xor(data, mask);
}

void prove_build(void)
{
    hear(0U, 1U);
    (void)fieldscribe_can_build(&profile, &message, &content, &frame);
}

void prove_unit(void)
{
    (void)fieldscribe_can_unit(&content);
}

void prove_reply_length(void)
{
    (void)fieldscribe_can_reply_length(&message);
    (void)fieldscribe_can_reply_length(NULL);
}

void prove_agrees(uint8_t kind, uint8_t unit)
{
    (void)fieldscribe_can_agrees(&message, kind, unit, data);
}

void prove_recognize(uint8_t unit)
{
    hear(0U, 1U);
    (void)fieldscribe_can_recognize(&message, unit, &frame);
}

void prove_parse(void)
{
    hear(0U, 1U);
    (void)fieldscribe_can_parse(&message, &frame, &content);
}

void prove_carries(uint8_t kind)
{
    (void)fieldscribe_can_carries(&message, kind);
}

/* A dialogue of messages with any roles; `answers` says whether the device answers at all. */
static void talk(bool answers)
{
    hear(0U, 1U);
    dialogue.profile = &profile;
    dialogue.read = &message;
    dialogue.write = &message;
    dialogue.read_answer = answers ? &message : NULL;
    dialogue.write_answer = answers ? &message : NULL;
}

void prove_answer(void)
{
    hear(0U, 1U);
    (void)fieldscribe_can_answer(&message, &frame, &content);
    (void)fieldscribe_can_answer(NULL, &frame, &content);
}

void prove_read(uint8_t unit)
{
    talk(true);
    (void)fieldscribe_can_read(&dialogue, unit, &reading, &frame);
}

void prove_read_answer(uint8_t unit)
{
    talk(true);
    (void)fieldscribe_can_read_answer(&dialogue, unit, &reading, &frame, EXACTLY(1U, word));
    talk(false);
    (void)fieldscribe_can_read_answer(&dialogue, unit, &reading, &frame, EXACTLY(1U, word));
}

void prove_write(uint8_t unit)
{
    talk(true);
    (void)fieldscribe_can_write(&dialogue, unit, &writing, word[0], &frame);
}

void prove_write_answer(uint8_t unit)
{
    talk(true);
    (void)fieldscribe_can_write_answer(&dialogue, unit, &writing, word[0], &frame);
    talk(false);
    (void)fieldscribe_can_write_answer(&dialogue, unit, &writing, word[0], &frame);
}

void prove_word_to_read(uint16_t count, size_t at)
{
    if (count <= WORDS) {
        //@ split count;
        text_reading.addresses = EXACTLY(count, text);
        text_reading.words = count;
        (void)fieldscribe_can_word_to_read(&text_reading, at, &reading);
    }
}

void prove_word_to_write(uint16_t count, size_t at)
{
    if (count <= WORDS) {
        //@ split count;
        text_writing.addresses = EXACTLY(count, text);
        text_writing.words = count;
        (void)fieldscribe_can_word_to_write(&text_writing, at, &writing);
    }
}

void prove_per_frame(void)
{
    (void)fieldscribe_can_per_frame(&telegram);
}

void prove_slots(void)
{
    (void)fieldscribe_can_slots(&telegram);
}

void prove_listen(uint16_t words, uint8_t per_frame)
{
    if (words <= WORDS && per_frame <= 5U) {
        //@ split words;
        //@ split per_frame;
        hear(words, per_frame);
        receiver = fieldscribe_can_listen(&telegram, receiver.unit, receiver.slots, receiver.slot_count);
    }
}

/* Of slots that are too few none is touched. */
void prove_listen__too_few(size_t count)
{
    if (count <= WORDS) {
        //@ split count;
        hear(WORDS, 1U);
        receiver = fieldscribe_can_listen(&telegram, receiver.unit, EXACTLY(count, slots), count);
        (void)fieldscribe_can_take(&receiver, &frame, time);
        (void)fieldscribe_can_heard_slot(&receiver, where.low, &slot);
        receiver = fieldscribe_can_listen(&telegram, receiver.unit, NULL, SLOTS);
        (void)fieldscribe_can_take(&receiver, &frame, time);
    }
}

void prove_take(uint16_t words, uint8_t per_frame)
{
    if (words <= WORDS && per_frame <= 5U) {
        //@ split words;
        //@ split per_frame;
        hear(words, per_frame);
        (void)fieldscribe_can_take(&receiver, &frame, time);
    }
}

void prove_heard_slot(uint16_t words, uint8_t per_frame, uint16_t position)
{
    if (words <= WORDS && per_frame <= 5U) {
        //@ split words;
        //@ split per_frame;
        hear(words, per_frame);
        (void)fieldscribe_can_heard_slot(&receiver, position, &slot);
    }
}

void prove_word(uint16_t words, uint8_t per_frame, uint16_t position)
{
    if (words <= WORDS && per_frame <= 5U) {
        //@ split words;
        //@ split per_frame;
        hear(words, per_frame);
        (void)fieldscribe_can_word(&receiver, position, EXACTLY(1U, word));
    }
}

void prove_received(uint16_t words, uint8_t per_frame)
{
    if (words <= WORDS && per_frame <= 5U) {
        //@ split words;
        //@ split per_frame;
        hear(words, per_frame);
        (void)fieldscribe_can_received(&receiver, &where, word, 2U);
        (void)fieldscribe_can_received(&receiver, &where, EXACTLY(1U, word), 1U);
        (void)fieldscribe_can_received(&receiver, &where, EXACTLY(0U, word), 0U);
        (void)fieldscribe_can_received(&receiver, &where, NULL, 2U);
    }
}

void prove_pair(uint16_t words, uint8_t per_frame)
{
    if (words <= WORDS && per_frame <= 5U) {
        //@ split words;
        //@ split per_frame;
        hear(words, per_frame);
        (void)fieldscribe_can_pair(&receiver, &where, pair, times);
    }
}

void prove_since(uint32_t now)
{
    (void)fieldscribe_can_since(time, now);
}

void prove_age(uint16_t words, uint8_t per_frame, uint32_t now)
{
    if (words <= WORDS && per_frame <= 5U) {
        uint32_t age;
        //@ split words;
        //@ split per_frame;
        hear(words, per_frame);
        (void)fieldscribe_can_age(&receiver, &where, now, &age);
    }
}

void prove_words(void)
{
    uint16_t words[FIELDSCRIBE_CAN_WORDS];
    fieldscribe_can_words(&message, &frame, words);
}

/* Telegrams of any words in a frame, as long as a small machine has room for. */
static void hear_long(void)
{
    if (telegram.words >= SLOTS) {
        telegram.words = 0U;
    }
    telegram.profile = &profile;
    telegram.message = &message;
    message.adds_unit = number % 2U != 0U;
    receiver.telegram = &telegram;
    receiver.slots = slots;
    receiver.slot_count = SLOTS;
}

void prove_unpack(uint8_t unit)
{
    uint16_t words[FIELDSCRIBE_CAN_WORDS];
    size_t part = 0U;
    hear_long();
    (void)fieldscribe_can_unpack(&telegram, unit, &frame, &part, words);
}

void prove_around(uint8_t place)
{
    if (place < FIELDSCRIBE_CAN_WORDS) {
        (void)fieldscribe_can_around(&slots[0], &slots[1], place);
    }
}

void prove_listen__long(uint8_t unit)
{
    hear_long();
    receiver = fieldscribe_can_listen(&telegram, unit, slots, SLOTS);
}

void prove_take__long(void)
{
    hear_long();
    (void)fieldscribe_can_take(&receiver, &frame, time);
}

void prove_word__long(uint16_t position)
{
    hear_long();
    (void)fieldscribe_can_word(&receiver, position, EXACTLY(1U, word));
}

void prove_received__long(void)
{
    hear_long();
    (void)fieldscribe_can_received(&receiver, &where, word, 2U);
}

/* With exactly the words of the text; those of the telegram are proven by `word`. */
void prove_received_text(uint16_t count)
{
    if (count <= WORDS) {
        //@ split count;
        hear_long();
        text_where.positions = EXACTLY(count, positions);
        text_where.words = count;
        (void)fieldscribe_can_received_text(&receiver, &text_where, EXACTLY(count, text), count);
        if (count > 0U) {
            (void)fieldscribe_can_received_text(&receiver, &text_where, EXACTLY(count - 1U, text), count - 1U);
        }
    }
}

void prove_status_name(unsigned status)
{
    (void)fieldscribe_can_status_name((fieldscribe_can_status)status);
}

/* A message of two signals, with any table; the choices of the second are exactly there. */
static void carry(uint16_t several)
{
    choices[0].more = number % 2U != 0U;
    choices[1].more = number % 2U != 0U;
    choices[2].more = number % 2U != 0U;
    rows[0].low_first = number % 2U != 0U;
    rows[1].low_first = number % 2U != 0U;
    signal.low_first = number % 2U != 0U;
    rows[0].when = NULL;
    rows[1].choices = several;
    rows[1].when = EXACTLY(several, choices);
    signals.profile = &profile;
    signals.adds_unit = number % 2U != 0U;
    signals.signals = rows;
    signals.count = 2U;
}

void prove_words_of(void)
{
    carry(0U);
    (void)fieldscribe_can_words_of(&signal);
}

void prove_piece_at(unsigned done)
{
    carry(0U);
    (void)fieldscribe_can_piece_at(&signal, done);
}

void prove_get(void)
{
    carry(0U);
    (void)fieldscribe_can_get(&signal, bytes, 3U);
}

void prove_set(uint64_t raw)
{
    carry(0U);
    fieldscribe_can_set(&signal, raw, bytes, 3U);
}

void prove_selected(uint16_t several)
{
    if (several <= 3U) {
        //@ split several;
        carry(several);
        (void)fieldscribe_can_selected(&rows[1], text, WORDS);
    }
}

void prove_signals_id(uint8_t unit)
{
    carry(0U);
    (void)fieldscribe_can_signals_id(&signals, unit);
}

void prove_take_signals(uint8_t unit, uint32_t id, uint16_t count)
{
    if (count <= WORDS) {
        //@ split count;
        carry(3U);
        (void)fieldscribe_can_take_signals(&signals, unit, id, bytes, 3U, EXACTLY(count, text), count);
    }
}

void prove_comes(uint16_t at, uint16_t count)
{
    if (count <= WORDS) {
        //@ split count;
        carry(3U);
        (void)fieldscribe_can_comes(&signals, at, EXACTLY(count, text), count);
    }
}

void prove_put_signals(uint16_t count)
{
    if (count <= WORDS) {
        //@ split count;
        carry(3U);
        (void)fieldscribe_can_put_signals(&signals, EXACTLY(count, text), count, bytes, 3U);
    }
}
