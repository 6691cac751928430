/* A drive by a script, for programs on this machine: what it must be asked, byte for byte, and what it answers. */
#ifndef HOST_H
#define HOST_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "board.h"

typedef struct step {
    size_t asked_length;
    uint8_t asked[32];
    size_t answer_length; /* 0: it says nothing */
    uint8_t answer[32];
} step;

static const step *script;
static size_t said;

void uart_send(void *context, const uint8_t *bytes, size_t length)
{
    (void)context;
    if (length != script->asked_length || memcmp(bytes, script->asked, length) != 0) {
        size_t at;
        for (at = 0U; at < length; ++at) {
            fprintf(stderr, "%02x ", bytes[at]);
        }
        fprintf(stderr, "was not to be asked\n");
        exit(3);
    }
    said = 0U;
    ++script;
}

bool uart_receive(void *context, uint32_t milliseconds, uint8_t *byte)
{
    const step *const now = script - 1;
    (void)context;
    (void)milliseconds;
    if (said == now->answer_length) {
        return false;
    }
    *byte = now->answer[said];
    ++said;
    return true;
}

#define CHECK(that) \
    if (!(that)) { \
        fprintf(stderr, "line %d: %s\n", __LINE__, #that); \
        exit(4); \
    }

#endif
