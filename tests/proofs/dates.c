/*
 * Proofs of fieldscribe_dates.h: any words, any numbers of a date and time, and any table of parts whose fields and
 * words there are, in arrays that are exactly as long as it says.
 */
#include "arbitrary.h"
#include "fieldscribe_dates.h"

#define WORDS 4U

static uint16_t words[WORDS];
static uint32_t numbers[FIELDSCRIBE_DATE_FIELDS];
static fieldscribe_date_part parts[FIELDSCRIBE_DATE_FIELDS];
static fieldscribe_date_form form;
static fieldscribe_date_time time;
static volatile uint8_t number;

/* A table of so many parts, in that many words: each has bits of one word. */
static void lay(uint8_t count, uint8_t held)
{
    uint8_t at;
    //@ loop unroll FIELDSCRIBE_DATE_FIELDS;
    for (at = 0U; at < FIELDSCRIBE_DATE_FIELDS; ++at) {
        parts[at].field = (uint8_t)(parts[at].field % FIELDSCRIBE_DATE_FIELDS);
        parts[at].word = (uint8_t)(parts[at].word % held);
        parts[at].low = (uint8_t)(parts[at].low % 16U);
    }
    form.parts = EXACTLY(count, parts);
    form.count = count;
    form.bcd = number % 2U != 0U;
    form.low_first = number % 2U != 0U;
}

void prove_date_has(uint8_t count, uint8_t field)
{
    if (count <= FIELDSCRIBE_DATE_FIELDS) {
        //@ split count;
        lay(count, WORDS);
        (void)fieldscribe_date_has(&form, field);
    }
}

void prove_date_decimal(uint16_t bits)
{
    (void)fieldscribe_date_decimal(bits);
}

void prove_date_digits(uint16_t decimal)
{
    (void)fieldscribe_date_digits(decimal);
}

void prove_date_is_real(uint8_t count)
{
    if (count <= FIELDSCRIBE_DATE_FIELDS) {
        //@ split count;
        lay(count, WORDS);
        (void)fieldscribe_date_is_real(&form, numbers);
    }
}

void prove_date_of_words(uint8_t count, uint8_t held)
{
    if (count <= FIELDSCRIBE_DATE_FIELDS && held > 0U && held <= WORDS) {
        //@ split count;
        //@ split held;
        lay(count, held);
        (void)fieldscribe_date_of_words(EXACTLY(held, words), &form, &time);
    }
}

void prove_date_weekday(uint16_t sunday)
{
    (void)fieldscribe_date_weekday(&time, sunday);
}

void prove_words_of_date(uint8_t count, uint8_t held)
{
    if (count <= FIELDSCRIBE_DATE_FIELDS && held > 0U && held <= WORDS) {
        //@ split count;
        //@ split held;
        lay(count, held);
        (void)fieldscribe_words_of_date(&time, &form, EXACTLY(held, words), held);
    }
}
