/*
 * Dates and times whose parts are bits of the words of a point, in the device's own time, without a time zone.
 * SPDX-License-Identifier: 0BSD
 */
#include "fieldscribe.h"

#ifndef FIELDSCRIBE_DATES_H
#define FIELDSCRIBE_DATES_H

/* A date and time. Decoding sets fields that the point does not have to 0; encoding ignores them. */
typedef struct fieldscribe_date_time {
    uint16_t year; /* for example 2026 */
    uint8_t month;
    uint8_t day;
    uint8_t hour;
    uint8_t minute;
    uint8_t second;
    uint16_t millisecond;
} fieldscribe_date_time;

#define FIELDSCRIBE_DATE_YEAR 0U
#define FIELDSCRIBE_DATE_MONTH 1U
#define FIELDSCRIBE_DATE_DAY 2U
#define FIELDSCRIBE_DATE_HOUR 3U
#define FIELDSCRIBE_DATE_MINUTE 4U
#define FIELDSCRIBE_DATE_SECOND 5U
#define FIELDSCRIBE_DATE_MILLISECOND 6U /* within the minute, if there is no second */
#define FIELDSCRIBE_DATE_WEEKDAY 7U     /* decoding ignores it */
#define FIELDSCRIBE_DATE_FIELDS 8U

/* A part: the index of its word, its lowest bit there, and a mask of its number. */
typedef struct fieldscribe_date_part {
    uint8_t field;
    uint8_t word;
    uint8_t low;
    uint16_t mask;
    uint16_t base; /* the year that 0 means; for a weekday, the number of Sunday: 0, 1, 6 or 7 */
} fieldscribe_date_part;

/* The parts of a point. */
typedef struct fieldscribe_date_form {
    const fieldscribe_date_part *parts;
    uint8_t count;
    bool bcd;       /* decimal digits of four bits each */
    bool low_first; /* the bytes of each word are swapped */
} fieldscribe_date_form;

static inline bool fieldscribe_date_has(const fieldscribe_date_form *form, uint8_t field)
{
    bool found = false;
    uint8_t at;
    for (at = 0U; at < form->count; ++at) {
        found = found || (form->parts[at].field == field);
    }
    return found;
}

/* The number with these decimal digits of four bits; more than any part holds if one is not a digit. */
static inline uint32_t fieldscribe_date_decimal(uint32_t bits)
{
    uint32_t number = 0U;
    uint32_t shift;
    bool decimal = true;
    for (shift = 16U; shift > 0U; shift -= 4U) {
        const uint32_t digit = (bits >> (shift - 4U)) & 0xFU;
        number = (number * 10U) + digit;
        decimal = decimal && (digit <= 9U);
    }
    return decimal ? number : 0x10000U;
}

/* The number in decimal digits of four bits each; it is less than 10000. */
static inline uint32_t fieldscribe_date_digits(uint32_t number)
{
    const uint32_t hundreds = ((number / 1000U) << 4U) | ((number / 100U) % 10U);
    return (hundreds << 8U) | (((number / 10U) % 10U) << 4U) | (number % 10U);
}

/* True if the fields are a date and time; the millisecond counts within its second. */
static inline bool fieldscribe_date_is_real(const fieldscribe_date_form *form, const uint32_t *numbers)
{
    const uint32_t year = numbers[FIELDSCRIBE_DATE_YEAR];
    const uint32_t month = numbers[FIELDSCRIBE_DATE_MONTH];
    bool real = true;
    if (fieldscribe_date_has(form, FIELDSCRIBE_DATE_DAY)) {
        const bool leap = ((year % 4U) == 0U) && (((year % 100U) != 0U) || ((year % 400U) == 0U));
        const uint32_t days = (month == 2U) ? (leap ? 29U : 28U) : (30U + ((month ^ (month >> 3U)) & 1U));
        real = (year >= 1U) && (year <= 9999U) && (month >= 1U) && (month <= 12U) &&
               (numbers[FIELDSCRIBE_DATE_DAY] >= 1U) && (numbers[FIELDSCRIBE_DATE_DAY] <= days);
    }
    if (fieldscribe_date_has(form, FIELDSCRIBE_DATE_HOUR)) {
        real = real && (numbers[FIELDSCRIBE_DATE_HOUR] <= 23U) && (numbers[FIELDSCRIBE_DATE_MINUTE] <= 59U) &&
               (numbers[FIELDSCRIBE_DATE_SECOND] <= 59U) && (numbers[FIELDSCRIBE_DATE_MILLISECOND] <= 999U);
    }
    return real;
}

/* MALFORMED if the words are no date and time, such as all zeros, all ones, or the 31st of February. */
static inline fieldscribe_status fieldscribe_date_of_words(
    const uint16_t *words, const fieldscribe_date_form *form, fieldscribe_date_time *time)
{
    uint32_t numbers[FIELDSCRIBE_DATE_FIELDS] = {0};
    uint8_t at;
    for (at = 0U; at < form->count; ++at) {
        const fieldscribe_date_part *const part = &form->parts[at];
        const uint16_t word = form->low_first ? fieldscribe_exchanged(words[part->word]) : words[part->word];
        const uint32_t bits = ((uint32_t)word >> part->low) & part->mask;
        numbers[part->field] = (form->bcd ? fieldscribe_date_decimal(bits) : bits) + part->base;
    }
    if (!fieldscribe_date_has(form, FIELDSCRIBE_DATE_SECOND)) {
        numbers[FIELDSCRIBE_DATE_SECOND] = numbers[FIELDSCRIBE_DATE_MILLISECOND] / 1000U;
        numbers[FIELDSCRIBE_DATE_MILLISECOND] %= 1000U;
    }
    if (!fieldscribe_date_is_real(form, numbers)) {
        return FIELDSCRIBE_MALFORMED;
    }
    time->year = (uint16_t)(numbers[FIELDSCRIBE_DATE_YEAR] & 0xFFFFU);
    time->month = (uint8_t)(numbers[FIELDSCRIBE_DATE_MONTH] & 0xFFU);
    time->day = (uint8_t)(numbers[FIELDSCRIBE_DATE_DAY] & 0xFFU);
    time->hour = (uint8_t)(numbers[FIELDSCRIBE_DATE_HOUR] & 0xFFU);
    time->minute = (uint8_t)(numbers[FIELDSCRIBE_DATE_MINUTE] & 0xFFU);
    time->second = (uint8_t)(numbers[FIELDSCRIBE_DATE_SECOND] & 0xFFU);
    time->millisecond = (uint16_t)(numbers[FIELDSCRIBE_DATE_MILLISECOND] & 0xFFFFU);
    return FIELDSCRIBE_OK;
}

/* The weekday of a date if Sunday has the number `sunday`. Days count from -0400-03-01, a Wednesday. */
static inline uint32_t fieldscribe_date_weekday(const fieldscribe_date_time *time, uint32_t sunday)
{
    const uint32_t year = (uint32_t)time->year + ((time->month < 3U) ? 399U : 400U);
    const uint32_t month = ((uint32_t)time->month + 9U) % 12U;
    const uint32_t days = (365U * year) + (year / 4U) - (year / 100U) + (year / 400U) + (((153U * month) + 2U) / 5U) +
                          (uint32_t)time->day - 1U;
    return (sunday < 6U) ? (((days + 3U) % 7U) + sunday) : (((days + 2U) % 7U) + sunday - 6U);
}

/* OUT_OF_RANGE if this is no date and time, or a part has no room for it: the words do not change then. */
static inline fieldscribe_status fieldscribe_words_of_date(
    const fieldscribe_date_time *time, const fieldscribe_date_form *form, uint16_t *words, size_t count)
{
    uint32_t numbers[FIELDSCRIBE_DATE_FIELDS];
    size_t word;
    uint8_t at;
    bool fits;
    numbers[FIELDSCRIBE_DATE_YEAR] = time->year;
    numbers[FIELDSCRIBE_DATE_MONTH] = time->month;
    numbers[FIELDSCRIBE_DATE_DAY] = time->day;
    numbers[FIELDSCRIBE_DATE_HOUR] = time->hour;
    numbers[FIELDSCRIBE_DATE_MINUTE] = time->minute;
    numbers[FIELDSCRIBE_DATE_SECOND] = time->second;
    numbers[FIELDSCRIBE_DATE_MILLISECOND] = time->millisecond;
    numbers[FIELDSCRIBE_DATE_WEEKDAY] = 0U;
    for (at = FIELDSCRIBE_DATE_MINUTE; at <= FIELDSCRIBE_DATE_MILLISECOND; ++at) {
        /* what is not written is not checked; a second may be in the milliseconds */
        const bool last = (at == FIELDSCRIBE_DATE_SECOND) && fieldscribe_date_has(form, FIELDSCRIBE_DATE_MILLISECOND);
        numbers[at] = (last || fieldscribe_date_has(form, at)) ? numbers[at] : 0U;
    }
    fits = fieldscribe_date_is_real(form, numbers);
    if (!fieldscribe_date_has(form, FIELDSCRIBE_DATE_SECOND)) {
        numbers[FIELDSCRIBE_DATE_MILLISECOND] += 1000U * numbers[FIELDSCRIBE_DATE_SECOND];
    }
    for (at = 0U; (at < form->count) && fits; ++at) {
        const fieldscribe_date_part *const part = &form->parts[at];
        const uint32_t most = form->bcd ? fieldscribe_date_decimal(0x9999U & (uint32_t)part->mask) : part->mask;
        const int32_t number = (part->field == FIELDSCRIBE_DATE_WEEKDAY)
            ? (int32_t)fieldscribe_date_weekday(time, part->base)
            : ((int32_t)numbers[part->field] - (int32_t)part->base);
        if ((number < 0) || (number > (int32_t)most)) {
            fits = false;
        } else {
            numbers[part->field] = form->bcd ? fieldscribe_date_digits((uint32_t)number) : (uint32_t)number;
        }
    }
    if (!fits) {
        return FIELDSCRIBE_OUT_OF_RANGE;
    }
    for (word = 0U; word < count; ++word) {
        uint32_t bits = 0U;
        for (at = 0U; at < form->count; ++at) {
            const fieldscribe_date_part *const part = &form->parts[at];
            bits |= ((size_t)part->word == word) ? (((numbers[part->field] & part->mask) << part->low) & 0xFFFFU) : 0U;
        }
        words[word] = form->low_first ? fieldscribe_exchanged((uint16_t)bits) : (uint16_t)bits;
    }
    return FIELDSCRIBE_OK;
}

#endif
