/*
 * What the proofs share. Frama-C starts each harness with every argument and every global that is not const arbitrary
 * within its type (-lib-entry), so that a harness only has to say where pointers lead.
 */
#ifndef ARBITRARY_H
#define ARBITRARY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The last `count` items of an array: one step too far leaves the array, which Frama-C sees. */
#define EXACTLY(count, array) ((array) + (sizeof(array) / sizeof(array)[0] - (count)))

/* The longest object that a machine of 16 bits has room for, in bytes; others have more. */
#define LARGE 32767U

/*
 * With -DENDS, of the lengths that are followed alone those between are left out: what a program does at a short length
 * it does at a longer one, but for constants, which lie near the longest.
 */
#ifdef ENDS
#define SHORT 24U
#define NOT_BETWEEN(length, most) \
    if (((length) > SHORT) && ((length) < ((most) - 12U))) { \
        return; \
    }
#else
#define NOT_BETWEEN(length, most)
#endif

#endif
