/* What both ways do: D001, D002 and D003 of the L200 in one request, D004 in another; over a line, the first alone. */
#ifndef EXCHANGE_H
#define EXCHANGE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct monitor {
    int32_t frequency;
    int32_t current;
    uint16_t direction;
    int32_t voltage;
} monitor;

/* The length of the request, or 0. */
int build(uint8_t unit, int which, uint8_t *buffer, size_t size);

/* These: 0, the code of an exception, or a negative number. */
int parse(uint8_t unit, int which, const uint8_t *bytes, size_t length, monitor *values);
int ask(uint8_t unit, monitor *values);

/* The line of both: what it answers. */
void line_send(const uint8_t *bytes, size_t length);
bool line_receive(uint8_t *byte);

#endif
