/*
 * Which device answers, and which of its variants: what its points hold, read in the order of the description.
 * SPDX-License-Identifier: 0BSD
 */
#include "fieldscribe_modbus.h"

#ifndef FIELDSCRIBE_MODBUS_IDENTIFY_H
#define FIELDSCRIBE_MODBUS_IDENTIFY_H

#define FIELDSCRIBE_MODBUS_IDENTIFY_WORDS 125U /* that one request reads */

/* What a point holds in the device (axis 0), or in a value of an axis of variants; both count from 1. */
typedef struct fieldscribe_modbus_expectation {
    uint8_t axis;
    uint8_t value;
    fieldscribe_modbus_reading read;
    fieldscribe_status (*holds)(const uint16_t *words); /* UNKNOWN_VALUE if they are something else */
} fieldscribe_modbus_expectation;

/* Whether a text is the other one. */
static inline bool fieldscribe_is_same_text(const char *text, const char *other)
{
    size_t at = 0U;
    while ((text[at] == other[at]) && (text[at] != '\0')) {
        ++at;
    }
    return text[at] == other[at];
}

/* Whether a point holds what is expected; it is read unless the row before was of the same words, and got them. */
static inline fieldscribe_modbus_status fieldscribe_modbus_expect(fieldscribe_modbus_unit *unit,
    fieldscribe_modbus_base base, const fieldscribe_modbus_expectation *row, const fieldscribe_modbus_reading **held,
    uint16_t *words, bool *fits)
{
    const fieldscribe_modbus_reading *const before = *held;
    fieldscribe_modbus_status status = FIELDSCRIBE_MODBUS_OK;
    if ((before == NULL) || (before->function != row->read.function) || (before->address != row->read.address) ||
        (before->count != row->read.count)) {
        const fieldscribe_modbus_reading what = fieldscribe_modbus_reading_at(base, &row->read);
        *held = NULL;
        status = fieldscribe_modbus_read_words(unit, &what, words, FIELDSCRIBE_MODBUS_IDENTIFY_WORDS);
    }
    if (status == FIELDSCRIBE_MODBUS_OK) {
        *held = &row->read;
        status = fieldscribe_modbus_converted(row->holds(words));
    }
    *fits = status == FIELDSCRIBE_MODBUS_OK;
    return ((status == FIELDSCRIBE_MODBUS_EXCEPTION) || (status == FIELDSCRIBE_MODBUS_UNKNOWN_VALUE))
               ? FIELDSCRIBE_MODBUS_OK
               : status;
}

/*
 * Fills in `found`: of each axis the first value whose points all hold what is expected, 0 if none does; found[0] is 1
 * if the device is the one described, else the others are 0. What the device refuses to read fits nothing. Addresses
 * count from `base`: {0U, 0xFFFFU} if from 0.
 */
FIELDSCRIBE_MODBUS_CALL fieldscribe_modbus_identify(fieldscribe_modbus_unit *unit, fieldscribe_modbus_base base,
    const fieldscribe_modbus_expectation *rows, size_t count, uint8_t *found, size_t axes)
{
    const fieldscribe_modbus_reading *held = NULL;
    uint16_t words[FIELDSCRIBE_MODBUS_IDENTIFY_WORDS] = {0U};
    fieldscribe_modbus_status status = FIELDSCRIBE_MODBUS_OK;
    size_t at;
    for (at = 0U; at < axes; ++at) {
        found[at] = 0U;
    }
    found[0] = (uint8_t)((rows[0].axis == 0U) ? 0U : 1U);
    at = 0U;
    while ((at < count) && (status == FIELDSCRIBE_MODBUS_OK) && ((rows[at].axis == 0U) || (found[0] != 0U))) {
        const uint8_t axis = rows[at].axis;
        const uint8_t value = rows[at].value;
        bool fits = found[axis] == 0U;
        while ((at < count) && (rows[at].axis == axis) && (rows[at].value == value)) {
            if (fits) {
                status = fieldscribe_modbus_expect(unit, base, &rows[at], &held, words, &fits);
            }
            ++at;
        }
        found[axis] = fits ? value : found[axis];
    }
    return status;
}

#endif
