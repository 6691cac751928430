#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#define FIELDSCRIBE_IMPLEMENTATION
#include "DEVICE_rows.h"

#define CHECK(that, row) \
    if (!(that)) { \
        fprintf(stderr, "%s (%s), line %d: %s\n", (row)->name, (row)->unit, __LINE__, #that); \
        exit(1); \
    }

TABLE

/* A unit of two words, of which it holds what was written. */
static uint16_t held[2];
static size_t writes;

static fieldscribe_modbus_status ask(const fieldscribe_modbus_line *line, const fieldscribe_modbus_request *request,
    fieldscribe_modbus_reply *reply)
{
    size_t at;
    (void)line;
    if (reply->values != NULL) {
        for (at = 0U; at < request->count; ++at) {
            reply->values[at] = held[at];
        }
        reply->count = request->count;
    } else {
        ++writes;
        for (at = 0U; at < request->count; ++at) {
            held[at] = request->values[at];
        }
    }
    return FIELDSCRIBE_MODBUS_OK;
}

static const fieldscribe_modbus_line line = {&DEVICE_modbus_profile, NULL, 0U, NULL, NULL, NULL, 0U, 0U};
static const fieldscribe_modbus_line foreign = {NULL, NULL, 0U, NULL, NULL, NULL, 0U, 0U};
static const uint16_t SAMPLES[] = {0U, 1U, 2U, 99U, 100U, 101U, 0x00FFU, 0x1234U, 0x7FFFU, 0x8000U, 0x8001U, 0xFFFFU};

static void put(const fieldscribe_modbus_row *row, size_t high, size_t low)
{
    held[0] = SAMPLES[high];
    held[1] = SAMPLES[low];
    if (row->layout->mask == 1U) {
        held[0] &= 1U;
    }
}

#define READ(function, facts, type) \
    { \
        static const fieldscribe_modbus_row row = facts; \
        for (high = 0U; high < FIELDSCRIBE_COUNT(SAMPLES); ++high) { \
            for (low = 0U; low < FIELDSCRIBE_COUNT(SAMPLES); ++low) { \
                type count = (type)0; \
                put(&row, high, low); \
                CHECK(function(&drive, &count) == FIELDSCRIBE_MODBUS_OK, &row) \
                CHECK(fieldscribe_modbus_read_row(&drive.unit, &row, &number) == FIELDSCRIBE_MODBUS_OK, &row) \
                CHECK(number == (int64_t)count, &row) \
            } \
        } \
    }

/* Numbers beside both limits, and some between them. */
static int64_t sample(const fieldscribe_modbus_row *row, int64_t at)
{
    if (at < 5) {
        return row->low - 2 + at;
    }
    return (at < 10) ? (row->high - 7 + at) : (row->low + ((at - 10) * (((row->high - row->low) / 50) + 1)));
}

#define WRITE(function, facts, type) \
    { \
        static const fieldscribe_modbus_row row = facts; \
        int64_t at; \
        for (at = 0; at < 60; ++at) { \
            uint16_t by_function[2]; \
            fieldscribe_modbus_status expected; \
            size_t sent; \
            number = sample(&row, at); \
            if ((sizeof(type) == 1U) && ((number < 0) || (number > 1))) { \
                continue; /* a bool */ \
            } \
            put(&row, 7U, 9U); \
            writes = 0U; \
            expected = function(&drive, (type)number); \
            sent = writes; \
            memcpy(by_function, held, sizeof held); \
            put(&row, 7U, 9U); \
            writes = 0U; \
            CHECK((fieldscribe_modbus_write_row(&drive.unit, &row, number) == FIELDSCRIBE_MODBUS_OK) == \
                    (expected == FIELDSCRIBE_MODBUS_OK), &row) \
            CHECK((writes == sent) && (memcmp(by_function, held, sizeof held) == 0), &row) \
        } \
    }

int main(void)
{
    DEVICE_device drive = {FIELDSCRIBE_MODBUS_UNIT(&line, &ask, 1U)};
    size_t high;
    size_t low;
    int64_t number = 0;
    LINES
    for (high = 0U; high < FIELDSCRIBE_COUNT(table); ++high) {
        const fieldscribe_modbus_status status = fieldscribe_modbus_read_row(&drive.unit, &table[high], &number);
        CHECK(status == ((table[high].read != NULL) ? FIELDSCRIBE_MODBUS_OK : FIELDSCRIBE_MODBUS_BAD_FUNCTION),
            &table[high])
        if (table[high].write == NULL) {
            CHECK(fieldscribe_modbus_write_row(&drive.unit, &table[high], 0) == FIELDSCRIBE_MODBUS_BAD_FUNCTION,
                &table[high])
        }
    }
    drive.unit.line = &foreign;
    CHECK(fieldscribe_modbus_read_row(&drive.unit, &table[0], &number) == FIELDSCRIBE_MODBUS_BAD_FUNCTION, &table[0])
    CHECK(fieldscribe_modbus_write_row(&drive.unit, &table[0], 0) == FIELDSCRIBE_MODBUS_BAD_FUNCTION, &table[0])
    return 0;
}
