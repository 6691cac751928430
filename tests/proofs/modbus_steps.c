/*
 * Proofs of fieldscribe_modbus_steps.h: any words of a step, in arrays that are exactly as long as it says.
 */
#include "arbitrary.h"
#include "fieldscribe_modbus_steps.h"

#define WORDS 8U    /* each count is followed alone */
#define ARGUMENTS 3U

static fieldscribe_modbus_word words[WORDS];
static fieldscribe_modbus_step step;
static uint16_t held[WORDS];
static uint16_t arguments[ARGUMENTS];

void prove_fill(size_t count)
{
    if (count <= WORDS) {
        size_t at;
        //@ loop unroll WORDS;
        for (at = 0U; at < WORDS; ++at) {
            words[at].argument = (uint8_t)(words[at].argument % ARGUMENTS);
        }
        //@ split count;
        step.read.count = (uint16_t)count;
        step.words = EXACTLY(count, words);
        (void)fieldscribe_modbus_steps_fill(&step, arguments, EXACTLY(count, held));
    }
}

void prove_fill__without_arguments(size_t count)
{
    if (count <= WORDS) {
        size_t at;
        //@ loop unroll WORDS;
        for (at = 0U; at < WORDS; ++at) {
            words[at].factor = 0U;
        }
        step.read.count = (uint16_t)count;
        step.words = words;
        (void)fieldscribe_modbus_steps_fill(&step, NULL, held);
    }
}
