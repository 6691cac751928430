/*
 * Types for the facts of a Modbus device and its points: functions, addresses, counts. There is no code here: programs
 * with a Modbus stack of their own do not need fieldscribe_modbus.h.
 * SPDX-License-Identifier: 0BSD
 */
#include "fieldscribe.h"

#ifndef FIELDSCRIBE_MODBUS_FACTS_H
#define FIELDSCRIBE_MODBUS_FACTS_H

/* The version that device headers check; it increases when they must be generated again. */
#define FIELDSCRIBE_MODBUS_INTERFACE 7

/* In a profile: the device has no broadcast address. */
#define FIELDSCRIBE_MODBUS_NO_BROADCAST 0xFFFFU

/* Parts that vendoring leaves out if no chosen point or function needs them. */
#define FIELDSCRIBE_MODBUS_COILS    /* part: functions 01h, 02h, 05h and 0Fh */
#define FIELDSCRIBE_MODBUS_WRITES   /* part: functions 05h to 10h, fieldscribe_modbus_write*, fieldscribe_modbus_send */
#define FIELDSCRIBE_MODBUS_OVER_TCP /* part: TCP, pages, fieldscribe_modbus_*tcp, fieldscribe_modbus_select* */

/* The limits of function codes: all are below the first, those that read below the second. */
#define FIELDSCRIBE_MODBUS_READS 5U
#if defined(FIELDSCRIBE_MODBUS_WRITES)
#define FIELDSCRIBE_MODBUS_FUNCTIONS 17U
#else
#define FIELDSCRIBE_MODBUS_FUNCTIONS FIELDSCRIBE_MODBUS_READS
#endif

/* What a device supports. */
typedef struct fieldscribe_modbus_profile {
    uint8_t first_unit;
    uint8_t last_unit;
    bool rtu;
    bool tcp;
#if defined(FIELDSCRIBE_MODBUS_WRITES)
    bool pads_coil_bytes; /* 0Fh carries an even number of data bytes */
    uint16_t broadcast;   /* the unit number that addresses all units */
    uint32_t to_all;      /* bit n: function n may be broadcast */
#endif
    uint16_t most[FIELDSCRIBE_MODBUS_FUNCTIONS]; /* the most items in a request of function n; 0: not supported */
} fieldscribe_modbus_profile;

/* The most coils or inputs in a request; 0 if the runtime is compiled without them. */
#if defined(FIELDSCRIBE_MODBUS_COILS)
#define FIELDSCRIBE_MODBUS_OF_COILS(most) (most)
#else
#define FIELDSCRIBE_MODBUS_OF_COILS(most) 0U
#endif

/* The initial value of a profile; f1 and so on are the most items of each function. */
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
 * The first address of points whose addresses count from a base, and the last one relative to it. Their sum is at most
 * 65535. The base of a block that was not found has a larger sum: nothing is read or written there.
 */
typedef struct fieldscribe_modbus_base {
    uint16_t start;
    uint16_t last;
} fieldscribe_modbus_base;

/* The most words of a marker. */
#define FIELDSCRIBE_MODBUS_MARKER_MOST 8U

/*
 * A chain of blocks after a marker: each block starts with its id and the number of words that follow these two; the id
 * `end` ends the chain. The marker is at one of `places`.
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
 * What must be written before an address means a point, such as a page and an index: rows up to the one marked `last`.
 * The bits of `mask` in the word (or coil) at `address` become `word`. If the mask does not cover the whole word, the
 * function `read` reads the word first.
 */
typedef struct fieldscribe_modbus_selection {
    uint16_t address;
    uint16_t mask;
    uint16_t word;
    uint8_t read;
    uint8_t write;
    bool last;
} fieldscribe_modbus_selection;

/* A point by its access: `read`, `write`, or `update` if it shares its word with other points. */
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

/* The same for a text. */
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
 * Its number counts units of 10^-decimals: (raw * divisor - add) / factor. Where that needs more than the raw number,
 * `decimals` is FIELDSCRIBE_MODBUS_RAW, and the number is the raw one. Numbers from `low` to `high` may be written;
 * `write` is NULL if the point is not writable, or if special codes or other points decide which numbers may be
 * written: use ..._write_POINT then. FIELDSCRIBE_NAMES adds the name and the unit: define it in all files of a program
 * or in none.
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

/* The same for a point whose address counts from a base: for fieldscribe_modbus_read_row_at and ..._write_row_at. */
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

/* A command: a named constant to write. */
typedef struct fieldscribe_modbus_command {
    fieldscribe_modbus_writing write;
    uint16_t value;
} fieldscribe_modbus_command;

#endif
