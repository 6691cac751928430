/*
 * Proofs of fieldscribe_can.h: one harness or more for each of its functions, named prove_FUNCTION or
 * prove_FUNCTION__WHAT. Messages have any roles with any numbers. A receiver has exactly the slots of its telegram.
 */
#include "arbitrary.h"
#include "fieldscribe_can.h"

#define WORDS 12U /* of a telegram that is followed with exactly its slots */
#define SLOTS (LARGE / sizeof(fieldscribe_can_slot))

static uint8_t data[FIELDSCRIBE_CAN_BYTES];
static uint16_t word;
static uint16_t other;
static fieldscribe_can_role role;
static fieldscribe_can_message message;
static fieldscribe_can_profile profile;
static fieldscribe_can_frame frame;
static fieldscribe_can_slot slots[SLOTS];
static fieldscribe_can_telegram telegram;
static fieldscribe_can_receiver receiver;
static volatile uint8_t number;

/* A telegram of so many words, and a receiver that heard anything. */
static void hear(uint16_t words, uint8_t per_frame)
{
    message.adds_unit = number % 2U != 0U;
    telegram.profile = &profile;
    telegram.message = &message;
    telegram.words = words;
    telegram.per_frame = per_frame;
    receiver.telegram = &telegram;
    receiver.slots = EXACTLY(fieldscribe_can_slots(&telegram), slots);
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

void prove_build(uint32_t unit, uint32_t address, uint32_t raw)
{
    hear(0U, 1U);
    (void)fieldscribe_can_build(&profile, &message, unit, address, raw, &frame);
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

void prove_parse(uint8_t unit)
{
    hear(0U, 1U);
    (void)fieldscribe_can_parse(&message, unit, &frame, &word, &other);
}

void prove_carries(uint8_t kind)
{
    (void)fieldscribe_can_carries(&message, kind);
}

void prove_ask(uint8_t unit, uint16_t address)
{
    hear(0U, 1U);
    (void)fieldscribe_can_ask(&profile, &message, unit, address, &frame);
}

void prove_answer(uint8_t unit, uint16_t address)
{
    hear(0U, 1U);
    (void)fieldscribe_can_answer(&message, unit, address, &frame, &word);
}

void prove_confirm(uint8_t unit, uint16_t address, uint16_t written)
{
    hear(0U, 1U);
    (void)fieldscribe_can_confirm(&message, unit, address, written, &frame);
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
        receiver = fieldscribe_can_listen(&telegram, receiver.unit, receiver.slots);
    }
}

void prove_take(uint16_t words, uint8_t per_frame)
{
    if (words <= WORDS && per_frame <= 5U) {
        //@ split words;
        //@ split per_frame;
        hear(words, per_frame);
        (void)fieldscribe_can_take(&receiver, &frame);
    }
}

void prove_heard(uint16_t words, uint8_t per_frame, uint16_t position)
{
    if (words <= WORDS && per_frame <= 5U) {
        //@ split words;
        //@ split per_frame;
        hear(words, per_frame);
        (void)fieldscribe_can_heard(&receiver, position);
    }
}

void prove_word(uint16_t words, uint8_t per_frame, uint16_t position)
{
    if (words <= WORDS && per_frame <= 5U) {
        //@ split words;
        //@ split per_frame;
        hear(words, per_frame);
        (void)fieldscribe_can_word(&receiver, position, &word);
    }
}

void prove_pair(uint16_t words, uint8_t per_frame, uint16_t high, uint16_t low)
{
    if (words <= WORDS && per_frame <= 5U) {
        //@ split words;
        //@ split per_frame;
        hear(words, per_frame);
        (void)fieldscribe_can_pair(&receiver, high, low, &word, &other);
    }
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
}

void prove_listen__long(uint8_t unit)
{
    hear_long();
    receiver = fieldscribe_can_listen(&telegram, unit, slots);
}

void prove_take__long(void)
{
    hear_long();
    (void)fieldscribe_can_take(&receiver, &frame);
}

void prove_word__long(uint16_t position)
{
    hear_long();
    (void)fieldscribe_can_word(&receiver, position, &word);
}

void prove_pair__long(uint16_t high, uint16_t low)
{
    hear_long();
    (void)fieldscribe_can_pair(&receiver, high, low, &word, &other);
}
