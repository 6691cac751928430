/*
 * Commands of several requests in order: a set-up sequence, a key with its complement, a mailbox.
 * SPDX-License-Identifier: 0BSD
 *
 *     const uint16_t arguments[] = {unit};
 *     for (at = 0U; at < GENSET_COMMAND_CLOSE_BREAKER_STEPS; ++at) {
 *         const fieldscribe_modbus_step *const step = &genset_command_close_breaker_steps[at];
 *
 * 1. Skip the step if it is `conditional` and the condition in its comment is false.
 * 2. If `read.function` is not 0, read the words: fieldscribe_modbus_read(unit, &step->read). If the step is `based`,
 *    its addresses count from the base in the comment: pass fieldscribe_modbus_reading_at(base, &step->read), and in
 *    4. fieldscribe_modbus_writing_at(base, &step->write).
 * 3. done = fieldscribe_modbus_steps_fill(step, arguments, words).
 * 4. If `write.function` is not 0, write the words: fieldscribe_modbus_write(unit, &step->write, words,
 *    step->write.count). Otherwise repeat from 2 until `done`, for at most `within` milliseconds.
 */
#include "fieldscribe_modbus_facts.h"

#ifndef FIELDSCRIBE_MODBUS_STEPS_H
#define FIELDSCRIBE_MODBUS_STEPS_H

/* A word: constant + factor * arguments[argument], modulo 65536, in the bits of `mask`; other bits do not change. */
typedef struct fieldscribe_modbus_word {
    uint16_t constant;
    uint16_t factor;
    uint16_t mask;
    uint8_t argument;
} fieldscribe_modbus_word;

/* A step. Both requests have the same address and count; the function is 0 for a request that is not sent. */
typedef struct fieldscribe_modbus_step {
    fieldscribe_modbus_reading read;
    fieldscribe_modbus_writing write;
    const fieldscribe_modbus_word *words;
    uint32_t within;
    bool conditional;
    bool based;
} fieldscribe_modbus_step;

/*
 * Puts the bits of a step into `words`: those just read, or any if the step reads nothing. Returns true if no word
 * changed. `arguments` are those of the command, at the indices that the header of the device defines: NULL if there
 * are none; cast a negative one to uint16_t.
 */
static inline bool fieldscribe_modbus_steps_fill(
    const fieldscribe_modbus_step *step, const uint16_t *arguments, uint16_t *words)
{
    bool same = true;
    uint16_t at;
    for (at = 0U; at < step->read.count; ++at) {
        const fieldscribe_modbus_word *const word = &step->words[at];
        const uint32_t product =
            (word->factor != 0U) ? ((uint32_t)word->factor * (uint32_t)arguments[word->argument]) : 0U;
        const uint32_t number = ((uint32_t)word->constant + product) & (uint32_t)word->mask;
        const uint32_t filled = ((uint32_t)words[at] & ~(uint32_t)word->mask & 0xFFFFU) | number;
        same = same && (filled == (uint32_t)words[at]);
        words[at] = (uint16_t)filled;
    }
    return same;
}

#endif
