/*
 * What the C programs of tests/fuzz share: they read cases from standard input and print one line for each. Each frame
 * lies in memory of exactly its length, so that the sanitizers see one byte too far.
 */
#ifndef CASES_H
#define CASES_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

/* `size` bytes of the next case; ends the program where there are none left. */
static inline void take_bytes(uint8_t *bytes, size_t size)
{
    if (fread(bytes, 1U, size, stdin) != size) {
        exit(0);
    }
}

/* The next little-endian number of so many bytes. */
static inline uint32_t take(size_t size)
{
    uint8_t bytes[4] = {0U, 0U, 0U, 0U};
    take_bytes(bytes, size);
    return (uint32_t)bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}

/* Memory of exactly so many bytes. */
static inline void *exactly(size_t size)
{
    void *const memory = malloc(size);
    if (memory == NULL && size > 0U) {
        abort();
    }
    return memory;
}

#endif
