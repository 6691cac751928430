/* Reads each parameter, writes it back and into the EEPROM; the line is standard input and output. */
#include <poll.h>
#include <stdio.h>
#include <unistd.h>
#define FIELDSCRIBE_IMPLEMENTATION
#include "siemens_mm4_uss.h"

static void to_line(void *context, const uint8_t *bytes, size_t length)
{
    (void)context;
    if (write(1, bytes, length) != (ssize_t)length) {
        _exit(3);
    }
}

static bool from_line(void *context, uint32_t milliseconds, uint8_t *byte)
{
    struct pollfd line = {0, POLLIN, 0};
    (void)context;
    return (poll(&line, 1, (int)milliseconds) > 0) && (read(0, byte, 1) == 1);
}

static const fieldscribe_uss_link link_of_drive = {PKW, 2U, false};
static uint8_t buffer[FIELDSCRIBE_USS_MOST];
static const fieldscribe_uss_line line = {
    &siemens_mm4_uss_profile, &link_of_drive, buffer, sizeof buffer, &to_line, &from_line, NULL, 2000U, 500U};
static const uint16_t sent[2] = {0x047EU, 0U};
static uint16_t heard[2];
static fieldscribe_uss_unit unit = FIELDSCRIBE_USS_UNIT(&line, &fieldscribe_uss_ask, sent, heard, 1U);

static void point(const char *name, const fieldscribe_uss_reading *what, const fieldscribe_uss_writing *ram,
    const fieldscribe_uss_writing *eeprom)
{
    uint16_t words[2] = {0U, 0U};
    int status = (int)fieldscribe_uss_read_words(&unit, what, words, what->width);
    if ((status == 0) && (ram != NULL)) {
        status = (int)fieldscribe_uss_write_words(&unit, ram, words, what->width);
    }
    if ((status == 0) && (eeprom != NULL)) {
        status = (int)fieldscribe_uss_write_words(&unit, eeprom, words, what->width);
    }
    (void)fprintf(stderr, "%s %d %lu\n", name, status,
        (what->width > 1U) ? ((unsigned long)words[0] << 16) | words[1] : (unsigned long)words[0]);
}

int main(void)
{
    const fieldscribe_uss_reading unknown = {1U, 1999U, 0U, 1U};
    uint16_t word;
#include "points.inc"
    (void)fprintf(stderr, "- %d %u\n", (int)fieldscribe_uss_read_words(&unit, &unknown, &word, 1U), (unsigned)unit.error);
    (void)fprintf(stderr, "status_word 0 %u\n", (unsigned)heard[0]);
    return 0;
}
