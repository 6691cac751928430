/* The board's serial line, as fieldscribe_modbus_line wants it. */
#ifndef BOARD_H
#define BOARD_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Waits until the line is silent for 3.5 characters, drops what has come in, then sends. */
void uart_send(void *context, const uint8_t *bytes, size_t length);

/* Waits for a byte; false when none comes within the time. */
bool uart_receive(void *context, uint32_t milliseconds, uint8_t *byte);

#endif
