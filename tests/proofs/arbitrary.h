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

#endif
