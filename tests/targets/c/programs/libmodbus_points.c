/* Reads each point of a server, writes those that may be written and reads them back: `points.inc` has the tables. */
#define _POSIX_C_SOURCE 200112L
#define FIELDSCRIBE_IMPLEMENTATION
#include "eastron_sdm630_modbus.h"
#include "hitachi_l200_modbus.h"
#include "jumo_controller_modbus.h"
#include "nord_sk5xxe_modbus.h"
#include <arpa/inet.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <unistd.h>

#define CHECK(that, name) \
    if (!(that)) { \
        fprintf(stderr, "%s: %s\n", name, #that); \
        exit(1); \
    }

/* What is read is `raw`; `read` or `write` is NULL for a point that cannot be. */
typedef struct row {
    const char *name;
    const fieldscribe_layout *const *layout;
    const fieldscribe_modbus_reading *read;
    const fieldscribe_modbus_writing *write;
    int64_t raw;
} row;

static int server;
static fieldscribe_modbus_profile profile;
static uint8_t buffer[FIELDSCRIBE_MODBUS_TCP_MOST];
static void send_all(void *context, const uint8_t *bytes, size_t length)
{
    (void)context;
    CHECK(write(server, bytes, length) == (ssize_t)length, "send")
}
static bool receive(void *context, uint32_t milliseconds, uint8_t *byte)
{
    struct pollfd waiting = {server, POLLIN, 0};
    (void)context;
    return poll(&waiting, 1, (int)milliseconds) == 1 && read(server, byte, 1) == 1;
}
static const fieldscribe_modbus_line line = {&profile, buffer, sizeof buffer, &send_all, &receive, NULL, 2000U, 500U};

static fieldscribe_modbus_status ask(fieldscribe_modbus_request request, uint16_t *words, size_t room)
{
    static uint16_t transaction;
    fieldscribe_modbus_reply reply = {words, room, 0U, 0U};
    request.transaction = ++transaction;
    return fieldscribe_modbus_ask_tcp(&line, &request, &reply);
}

#define TAKE(number, type, kind) \
    case number: { \
        type raw = (type)0; \
        CHECK(fieldscribe_take_##kind(layout, words, layout->words, &raw), "take") \
        return (int64_t)raw; \
    }
static int64_t number_in(const fieldscribe_layout *layout, const uint16_t *words)
{
    switch ((fieldscribe_type)layout->type) {
        TAKE(FIELDSCRIBE_BIT, bool, bit)
        TAKE(FIELDSCRIBE_U8, uint8_t, u8)
        TAKE(FIELDSCRIBE_S8, int8_t, s8)
        TAKE(FIELDSCRIBE_U16, uint16_t, u16)
        TAKE(FIELDSCRIBE_S16, int16_t, s16)
        TAKE(FIELDSCRIBE_U32, uint32_t, u32)
        TAKE(FIELDSCRIBE_S32, int32_t, s32)
        TAKE(FIELDSCRIBE_U64, uint64_t, u64)
        TAKE(FIELDSCRIBE_S64, int64_t, s64)
    default:
        abort();
    }
}

#define PUT(number, type, kind) \
    case number: \
        CHECK(fieldscribe_put_##kind(layout, (type)raw, words, layout->words), "put") \
        break;
static void put_number(const fieldscribe_layout *layout, int64_t raw, uint16_t *words)
{
    switch ((fieldscribe_type)layout->type) {
        PUT(FIELDSCRIBE_BIT, bool, bit)
        PUT(FIELDSCRIBE_U8, uint8_t, u8)
        PUT(FIELDSCRIBE_S8, int8_t, s8)
        PUT(FIELDSCRIBE_U16, uint16_t, u16)
        PUT(FIELDSCRIBE_S16, int16_t, s16)
        PUT(FIELDSCRIBE_U32, uint32_t, u32)
        PUT(FIELDSCRIBE_S32, int32_t, s32)
        PUT(FIELDSCRIBE_U64, uint64_t, u64)
        PUT(FIELDSCRIBE_S64, int64_t, s64)
    default:
        abort();
    }
}

static int64_t read_number(const fieldscribe_layout *layout, const fieldscribe_modbus_reading *what, const char *name)
{
    uint16_t words[4] = {0U, 0U, 0U, 0U};
    CHECK(ask(fieldscribe_modbus_read(1U, what), words, 4U) == FIELDSCRIBE_MODBUS_OK, name)
    return number_in(layout, words);
}

/* Writes the number with its lowest bit changed, reads it back, and leaves what was there. */
static void change(const row *point)
{
    const fieldscribe_modbus_reading same = {
        point->write->function == 5U || point->write->function == 15U ? 1U : 3U, point->write->address,
        point->write->count};
    const fieldscribe_layout *const layout = *point->layout;
    uint16_t before[4] = {0U, 0U, 0U, 0U};
    uint16_t words[4];
    uint16_t after[4];
    unsigned at;
    CHECK(ask(fieldscribe_modbus_read(1U, &same), before, 4U) == FIELDSCRIBE_MODBUS_OK, point->name)
    for (at = 0U; at < 4U; ++at) {
        words[at] = before[at];
    }
    put_number(layout, number_in(layout, before) ^ 1, words);
    CHECK(ask(fieldscribe_modbus_write(1U, point->write, words, point->write->count), NULL, 0U) ==
        FIELDSCRIBE_MODBUS_OK, point->name)
    CHECK(ask(fieldscribe_modbus_read(1U, &same), after, 4U) == FIELDSCRIBE_MODBUS_OK, point->name)
    CHECK(((number_in(layout, after) ^ number_in(layout, before) ^ 1) & ~(int64_t)layout->fixed_mask) == 0, point->name)
    for (at = 0U; at < point->write->count; ++at) {
        const uint16_t bits = (uint16_t)((layout->shares ? layout->mask : 0xFFFFU) | layout->fixed_mask);
        CHECK(((after[at] ^ before[at]) & (uint16_t)~bits) == 0U, point->name)
    }
    CHECK(ask(fieldscribe_modbus_write(1U, point->write, before, point->write->count), NULL, 0U) ==
        FIELDSCRIBE_MODBUS_OK, point->name)
}

static void run(const row *rows, size_t count, const fieldscribe_modbus_profile *of)
{
    size_t at;
    profile = *of;
    profile.tcp = true; /* libmodbus serves TCP; a drive with a gateway in between does, too */
    for (at = 0U; at < count; ++at) {
        const row *const point = &rows[at];
        if (point->read != NULL) {
            CHECK(read_number(*point->layout, point->read, point->name) == point->raw, point->name)
        }
        if (point->write != NULL) {
            change(point);
        }
    }
}

#include "points.inc"

int main(int argc, char **argv)
{
    struct sockaddr_in there = {0};
    there.sin_family = AF_INET;
    there.sin_port = htons((uint16_t)strtoul(argv[argc - 1], NULL, 10));
    there.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    server = socket(AF_INET, SOCK_STREAM, 0);
    CHECK(connect(server, (struct sockaddr *)&there, sizeof there) == 0, "connect")
    run_all();
    return 0;
}
