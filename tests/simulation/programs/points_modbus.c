/* Reads each point of a Modbus device, writes a number and reads it, is refused another: `tcp|rtu|serial PLACE UNIT`. */
#include <arpa/inet.h>
#include <fcntl.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>
#define FIELDSCRIBE_IMPLEMENTATION
#include "device.inc"

#define MOST 32U

static int line_of_device;
static uint8_t buffer[FIELDSCRIBE_MODBUS_TCP_MOST];
static fieldscribe_modbus_unit unit;

static void to_line(void *context, const uint8_t *bytes, size_t length)
{
    (void)context;
    if (write(line_of_device, bytes, length) != (ssize_t)length) {
        exit(3);
    }
}

static bool from_line(void *context, uint32_t milliseconds, uint8_t *byte)
{
    struct pollfd waiting = {line_of_device, POLLIN, 0};
    (void)context;
    return (poll(&waiting, 1, (int)milliseconds) == 1) && (read(line_of_device, byte, 1) == 1);
}

static int opened(const char *framing, const char *place)
{
    struct sockaddr_in there = {0};
    int socket_of_device;
    if (strcmp(framing, "serial") == 0) {
        return open(place, O_RDWR | O_NOCTTY); /* the other end has made it raw */
    }
    there.sin_family = AF_INET;
    there.sin_port = htons((uint16_t)atoi(place));
    there.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socket_of_device = socket(AF_INET, SOCK_STREAM, 0);
    return (connect(socket_of_device, (struct sockaddr *)&there, sizeof there) == 0) ? socket_of_device : -1;
}

/* Where the addresses of a point count from: 0, or the start of a block. */
static fieldscribe_modbus_base base_of(uint16_t block)
{
    static fieldscribe_modbus_base base;
    static uint16_t known;
    static const fieldscribe_modbus_chain *const chain = CHAIN;
    const fieldscribe_modbus_base none = {0U, 0xFFFFU};
    if ((block != 0U) && (block != known)) {
        known = block;
        if ((chain == NULL) || (fieldscribe_modbus_find(&unit, chain, block, &base) != FIELDSCRIBE_MODBUS_OK)) {
            exit(4);
        }
    }
    return (block == 0U) ? none : base;
}

static void print(fieldscribe_modbus_status status, const uint16_t *words, size_t count)
{
    size_t at;
    printf(" %d", (int)status);
    for (at = 0U; at < count; ++at) {
        printf(" %u", (unsigned)words[at]);
    }
}

static void point(const char *name, uint16_t block, const fieldscribe_modbus_reading *read_with,
    const fieldscribe_modbus_writing *write_with, const uint16_t *taken, const uint16_t *refused)
{
    const fieldscribe_modbus_base base = base_of(block);
    uint16_t before[MOST] = {0U};
    uint16_t after[MOST] = {0U};
    fieldscribe_modbus_reading from = {0U, 0U, 0U};
    printf("%s", name);
    if (read_with != NULL) {
        from = fieldscribe_modbus_reading_at(base, read_with);
        print(fieldscribe_modbus_read_words(&unit, &from, before, from.count), before, from.count);
    }
    if (write_with != NULL) {
        const fieldscribe_modbus_writing to = fieldscribe_modbus_writing_at(base, write_with);
        print(fieldscribe_modbus_write_words(&unit, &to, taken, to.count), NULL, 0U);
        if (read_with != NULL) {
            print(fieldscribe_modbus_read_words(&unit, &from, after, from.count), after, from.count);
            print(fieldscribe_modbus_write_words(&unit, &to, before, to.count), NULL, 0U);
        }
        if (refused != NULL) {
            const fieldscribe_modbus_status status = fieldscribe_modbus_write_words(&unit, &to, refused, to.count);
            printf(" %d", (status == FIELDSCRIBE_MODBUS_EXCEPTION) ? (int)unit.exception : -1);
        }
    }
    printf("\n");
}

int main(int argc, char **argv)
{
    static fieldscribe_modbus_profile profile;
    static const fieldscribe_modbus_line line = {
        &profile, buffer, sizeof buffer, &to_line, &from_line, NULL, 2000U, 500U};
    profile = PROFILE;
    profile.tcp = true; /* a drive with a gateway in front */
    if (argc != 4) {
        return 2;
    }
    line_of_device = opened(argv[1], argv[2]);
    unit.line = &line;
    unit.ask = (strcmp(argv[1], "tcp") == 0) ? &fieldscribe_modbus_ask_tcp : &fieldscribe_modbus_ask_rtu;
    unit.number = (uint8_t)atoi(argv[3]);
#include "points.inc"
    return 0;
}
