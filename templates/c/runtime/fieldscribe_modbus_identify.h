/*
 * Identifies the device and its variant by what its points hold; reads them in the order of the description.
 * SPDX-License-Identifier: 0BSD
 */
#include "fieldscribe_modbus.h"

#ifndef FIELDSCRIBE_MODBUS_IDENTIFY_H
#define FIELDSCRIBE_MODBUS_IDENTIFY_H

#define FIELDSCRIBE_MODBUS_IDENTIFY_WORDS 125U /* the most words that one request reads */

/* What a point holds in the device (axis 0), or in one value of a variant axis; axes and values count from 1. */
typedef struct fieldscribe_modbus_expectation {
    uint8_t axis;
    uint8_t value;
    fieldscribe_modbus_reading read;
    fieldscribe_status (*holds)(const uint16_t *words); /* UNKNOWN_VALUE if the point holds something else */
} fieldscribe_modbus_expectation;

/* True if two texts are equal. */
static inline bool fieldscribe_is_same_text(const char *text, const char *other)
{
    size_t at = 0U;
    while ((text[at] == other[at]) && (text[at] != '\0')) {
        ++at;
    }
    return text[at] == other[at];
}

/* Checks that a point holds what is expected; reads it unless the previous row read the same words. */
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
 * Fills in `found`: for each axis the first value whose points all hold what is expected, or 0 if there is none;
 * found[0] is 1 if the device is the one described, otherwise all are 0. A point that the device refuses to read does
 * not match. Addresses count from `base`; pass {0U, 0xFFFFU} if they start at 0.
 */
FIELDSCRIBE_MODBUS_CALL fieldscribe_modbus_identify(fieldscribe_modbus_unit *unit, fieldscribe_modbus_base base,
    const fieldscribe_modbus_expectation *rows, size_t count, uint8_t *found, size_t axes)
{
    const fieldscribe_modbus_reading *held = NULL;
    uint16_t words[FIELDSCRIBE_MODBUS_IDENTIFY_WORDS] = {0};
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
