/*
 * The types of what is known of a Modbus device and its points: functions, addresses, counts. There is no code here:
 * programs with a Modbus stack of their own do without fieldscribe_modbus.h.
 * SPDX-License-Identifier: 0BSD
 */
#include "fieldscribe.h"

#ifndef FIELDSCRIBE_MODBUS_FACTS_H
#define FIELDSCRIBE_MODBUS_FACTS_H

/* What the headers of devices rely on: it grows when they have to be generated anew. */
#define FIELDSCRIBE_MODBUS_INTERFACE 6

/* In a profile: no unit number is a broadcast. */
#define FIELDSCRIBE_MODBUS_NO_BROADCAST 0xFFFFU

/* What vendoring leaves out where no chosen point needs it, and no function of these names is chosen. */
#define FIELDSCRIBE_MODBUS_COILS    /* part: functions 01h, 02h, 05h and 0Fh */
#define FIELDSCRIBE_MODBUS_WRITES   /* part: functions 05h to 10h, fieldscribe_modbus_write*, fieldscribe_modbus_send */
#define FIELDSCRIBE_MODBUS_OVER_TCP /* part: TCP beside RTU, fieldscribe_modbus_*tcp */

/* All functions have codes below this, and those that read below the other. */
#define FIELDSCRIBE_MODBUS_READS 5U
#if defined(FIELDSCRIBE_MODBUS_WRITES)
#define FIELDSCRIBE_MODBUS_FUNCTIONS 17U
#else
#define FIELDSCRIBE_MODBUS_FUNCTIONS FIELDSCRIBE_MODBUS_READS
#endif

/* What a device understands. */
typedef struct fieldscribe_modbus_profile {
    uint8_t first_unit;
    uint8_t last_unit;
    bool rtu;
    bool tcp;
#if defined(FIELDSCRIBE_MODBUS_WRITES)
    bool pads_coil_bytes; /* 0Fh carries an even number of data bytes */
    uint16_t broadcast;   /* the unit that all listen to */
    uint32_t to_all;      /* bit n: function n may go to all units at once */
#endif
    uint16_t most[FIELDSCRIBE_MODBUS_FUNCTIONS]; /* how many items a request of function n carries; 0: not known */
} fieldscribe_modbus_profile;

/* The number of coils, or of inputs, unless the runtime has nothing for them. */
#if defined(FIELDSCRIBE_MODBUS_COILS)
#define FIELDSCRIBE_MODBUS_OF_COILS(most) (most)
#else
#define FIELDSCRIBE_MODBUS_OF_COILS(most) 0U
#endif

/* A profile of these facts: f1 and the like are the most items of each function. */
#if defined(FIELDSCRIBE_MODBUS_WRITES)
#define FIELDSCRIBE_MODBUS_PROFILE( \
    first, last, rtu, tcp, pads, broadcast, to_all, f1, f2, f3, f4, f5, f6, f8, f15, f16) \
    {first, last, rtu, tcp, pads, broadcast, to_all, \
        {0U, FIELDSCRIBE_MODBUS_OF_COILS(f1), FIELDSCRIBE_MODBUS_OF_COILS(f2), f3, f4, \
            FIELDSCRIBE_MODBUS_OF_COILS(f5), f6, 0U, f8, 0U, 0U, 0U, 0U, 0U, 0U, \
            FIELDSCRIBE_MODBUS_OF_COILS(f15), f16}}
#else
#define FIELDSCRIBE_MODBUS_PROFILE( \
    first, last, rtu, tcp, pads, broadcast, to_all, f1, f2, f3, f4, f5, f6, f8, f15, f16) \
    {first, last, rtu, tcp, {0U, FIELDSCRIBE_MODBUS_OF_COILS(f1), FIELDSCRIBE_MODBUS_OF_COILS(f2), f3, f4}}
#endif

/* Consecutive addresses that one request reads: those of a point, or a block of several points. */
typedef struct fieldscribe_modbus_reading {
    uint8_t function;
    uint16_t address;
    uint16_t count;
} fieldscribe_modbus_reading;

/* Consecutive addresses that one request writes. */
typedef struct fieldscribe_modbus_writing {
    uint8_t function;
    uint16_t address;
    uint16_t count;
} fieldscribe_modbus_writing;

/*
 * What the addresses of some points count from, and the last address that does. `start` and `last` together are 65535
 * at most; in a base that is not known they are more, and nothing is read or written there.
 */
typedef struct fieldscribe_modbus_base {
    uint16_t start;
    uint16_t last;
} fieldscribe_modbus_base;

/* The most words of a marker. */
#define FIELDSCRIBE_MODBUS_MARKER_MOST 8U

/*
 * Blocks that a device has behind a marker: each starts with its id and the number of words that follow these two;
 * `end` in place of an id ends them. The marker stands at one of `places`.
 */
typedef struct fieldscribe_modbus_chain {
    const uint16_t *marker;
    const uint16_t *places;
    size_t place_count;
    uint16_t marker_words;
    uint16_t end;
    uint8_t function;
} fieldscribe_modbus_chain;

/*
 * What is written before an address means a point, such as a page and an index: rows up to the `last` one. The bits of
 * `mask` in the word (or coil) at `address` become `word`; if these are not all, the function `read` reads the others.
 */
typedef struct fieldscribe_modbus_selection {
    uint16_t address;
    uint16_t mask;
    uint16_t word;
    uint8_t read;
    uint8_t write;
    bool last;
} fieldscribe_modbus_selection;

/* A point by what may be done with it: `read`, `write`, or `update` bits of a word that it shares with other points. */
typedef struct fieldscribe_modbus_r {
    const fieldscribe_layout *layout;
    fieldscribe_modbus_reading read;
} fieldscribe_modbus_r;

typedef struct fieldscribe_modbus_w {
    const fieldscribe_layout *layout;
    fieldscribe_modbus_writing write;
} fieldscribe_modbus_w;

typedef struct fieldscribe_modbus_rw {
    const fieldscribe_layout *layout;
    fieldscribe_modbus_reading read;
    fieldscribe_modbus_writing write;
} fieldscribe_modbus_rw;

typedef struct fieldscribe_modbus_ru {
    const fieldscribe_layout *layout;
    fieldscribe_modbus_reading read;
    fieldscribe_modbus_writing update;
} fieldscribe_modbus_ru;

/* The same for texts. */
typedef struct fieldscribe_modbus_text_r {
    fieldscribe_text text;
    fieldscribe_modbus_reading read;
} fieldscribe_modbus_text_r;

typedef struct fieldscribe_modbus_text_w {
    fieldscribe_text text;
    fieldscribe_modbus_writing write;
} fieldscribe_modbus_text_w;

typedef struct fieldscribe_modbus_text_rw {
    fieldscribe_text text;
    fieldscribe_modbus_reading read;
    fieldscribe_modbus_writing write;
} fieldscribe_modbus_text_rw;

/*
 * A point in a table of yours: static const fieldscribe_modbus_row rows[] = {HITACHI_L200_OUTPUT_FREQUENCY_ROW, ...};
 * Its number is its count in 10^-decimals units, which is (raw * divisor - add) / factor; where that takes more
 * than the raw number, `decimals` is FIELDSCRIBE_MODBUS_RAW, and the number is the raw one. Numbers from `low`
 * to `high` may be written; `write` is NULL if nothing may be, or if special codes or other points decide what
 * may: ..._write_POINT does. FIELDSCRIBE_NAMES, which a program defines in all its files or in none, adds the
 * name and the unit.
 */
typedef struct fieldscribe_modbus_row {
    const fieldscribe_modbus_profile *profile;
    const fieldscribe_layout *layout;
    const fieldscribe_modbus_reading *read;
    const fieldscribe_modbus_writing *write;
    int64_t low;
    int64_t high;
    int32_t factor;
    int32_t add;
    int32_t divisor;
    int8_t decimals;
#ifdef FIELDSCRIBE_NAMES
    const char *name;
    const char *unit;
#endif
} fieldscribe_modbus_row;

/* The same of a point whose addresses count from a base, for fieldscribe_modbus_read_row_at and ..._write_row_at. */
typedef struct fieldscribe_modbus_based_row {
    fieldscribe_modbus_row row;
} fieldscribe_modbus_based_row;

#define FIELDSCRIBE_MODBUS_RAW (-1)

#ifdef FIELDSCRIBE_NAMES
#define FIELDSCRIBE_MODBUS_ROW(profile, layout, read, write, low, high, factor, add, divisor, decimals, name, unit) \
    {profile, layout, read, write, low, high, factor, add, divisor, decimals, name, unit}
#else
#define FIELDSCRIBE_MODBUS_ROW(profile, layout, read, write, low, high, factor, add, divisor, decimals, name, unit) \
    {profile, layout, read, write, low, high, factor, add, divisor, decimals}
#endif
#define FIELDSCRIBE_MODBUS_BASED_ROW( \
    profile, layout, read, write, low, high, factor, add, divisor, decimals, name, unit) \
    {FIELDSCRIBE_MODBUS_ROW(profile, layout, read, write, low, high, factor, add, divisor, decimals, name, unit)}

/* A named constant that is written. */
typedef struct fieldscribe_modbus_command {
    fieldscribe_modbus_writing write;
    uint16_t value;
} fieldscribe_modbus_command;

#endif
