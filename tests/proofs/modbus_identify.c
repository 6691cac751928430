/*
 * Proofs of fieldscribe_modbus_identify.h: any table of expectations, of a unit that brings any words and any status.
 */
#define FIELDSCRIBE_IMPLEMENTATION
#include "arbitrary.h"
#include "fieldscribe_modbus_identify.h"
#include "modbus_items.h"

#define ROWS 3U /* each count is followed alone, as is each count of axes */
#define AXES 3U
#define TEXT 4U

static fieldscribe_modbus_expectation rows[ROWS];
static fieldscribe_modbus_reading reading;
static fieldscribe_modbus_unit unit;
static fieldscribe_modbus_line line;
static uint16_t words[FIELDSCRIBE_MODBUS_IDENTIFY_WORDS];
static uint8_t found[AXES];
static char text[TEXT];
static char other[TEXT];
static volatile uint8_t number;

/* As generated code does: it looks at the words that the point has, and a request brings at most. */
static fieldscribe_status holds_anything(const uint16_t *held)
{
    (void)held[0];
    (void)held[FIELDSCRIBE_MODBUS_IDENTIFY_WORDS - 1U];
    return number % 2U != 0U ? FIELDSCRIBE_OK : FIELDSCRIBE_UNKNOWN_VALUE;
}

/* A table of expectations of so many axes. */
static void expect(uint8_t axes)
{
    size_t at;
    //@ loop unroll ROWS;
    for (at = 0U; at < ROWS; ++at) {
        rows[at].axis = (uint8_t)(rows[at].axis % axes);
        rows[at].holds = &holds_anything;
    }
    unit.line = &line;
    unit.ask = &bring_anything;
    unit.late = number % 2U != 0U;
}

void prove_is_same_text(uint8_t length, uint8_t second)
{
    if (length < TEXT && second < TEXT) {
        //@ split length;
        //@ split second;
        text[TEXT - 1U] = '\0';
        other[TEXT - 1U] = '\0';
        (void)fieldscribe_is_same_text(&text[length], &other[second]);
    }
}

void prove_expect(fieldscribe_modbus_base base)
{
    const fieldscribe_modbus_reading *held = number % 2U != 0U ? &reading : NULL;
    bool fits;
    expect(AXES);
    (void)fieldscribe_modbus_expect(&unit, base, &rows[ROWS - 1U], &held, words, &fits);
}

void prove_identify(fieldscribe_modbus_base base, size_t count, uint8_t axes)
{
    if (count > 0U && count <= ROWS && axes > 0U && axes <= AXES) {
        //@ split count;
        //@ split axes;
        expect(axes);
        (void)fieldscribe_modbus_identify(&unit, base, EXACTLY(count, rows), count, EXACTLY(axes, found), axes);
    }
}
