/* What the device at a port says that it is: `identify PORT`; prints how many requests it took, and who it is. */
#include <arpa/inet.h>
#include <netinet/in.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#define FIELDSCRIBE_IMPLEMENTATION
#include "kitchen_sink_modbus.h"

static int wire;
static unsigned requests;

static void put(void *context, const uint8_t *bytes, size_t length)
{
    (void)context;
    ++requests;
    (void)!write(wire, bytes, length);
}

static bool get(void *context, uint32_t milliseconds, uint8_t *byte)
{
    (void)context;
    (void)milliseconds;
    return read(wire, byte, 1U) == 1;
}

static fieldscribe_modbus_status answers_seven(const fieldscribe_modbus_line *line,
    const fieldscribe_modbus_request *request, fieldscribe_modbus_reply *reply)
{
    (void)line;
    reply->values[0] = 7U;
    reply->count = request->count;
    return FIELDSCRIBE_MODBUS_OK;
}

static fieldscribe_status is_seven(const uint16_t *words)
{
    return words[0] == 7U ? FIELDSCRIBE_OK : FIELDSCRIBE_UNKNOWN_VALUE;
}

/* Two values of an axis fit: the first one counts. */
static bool finds_the_first(void)
{
    static const fieldscribe_modbus_expectation rows[] = {
        {1U, 1U, {3U, 0U, 1U}, &is_seven}, {1U, 2U, {3U, 1U, 1U}, &is_seven}};
    static const fieldscribe_modbus_base base = {0U, 0xFFFFU};
    fieldscribe_modbus_unit unit = FIELDSCRIBE_MODBUS_UNIT(NULL, &answers_seven, 1U);
    uint8_t found[2];
    return fieldscribe_modbus_identify(&unit, base, rows, 2U, found, 2U) == FIELDSCRIBE_MODBUS_OK && found[0] == 1U &&
        found[1] == 1U;
}

int main(int count, char **arguments)
{
    static uint8_t buffer[FIELDSCRIBE_MODBUS_TCP_MOST];
    static const fieldscribe_modbus_line line = {
        &kitchen_sink_modbus_profile, buffer, sizeof buffer, &put, &get, NULL, 1000U, 100U};
    kitchen_sink_device device = {
        FIELDSCRIBE_MODBUS_UNIT(&line, &fieldscribe_modbus_ask_tcp, 1U), FIELDSCRIBE_MODBUS_NOTHING_SELECTED};
    kitchen_sink_identity identity = {false, 9U, 9U};
    struct sockaddr_in place;
    char name[KITCHEN_SINK_MODEL_NAME_CHARACTERS + 1U] = "";
    fieldscribe_modbus_status status;
    memset(&place, 0, sizeof place);
    place.sin_family = AF_INET;
    place.sin_port = htons((uint16_t)atoi(arguments[count - 1]));
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    wire = socket(AF_INET, SOCK_STREAM, 0);
    if (!finds_the_first() || connect(wire, (const struct sockaddr *)&place, sizeof place) != 0) {
        return 2;
    }
    status = kitchen_sink_identify(&device, &identity);
    printf("%u %s %d %u %u", requests, fieldscribe_modbus_status_name(status), identity.is_described,
        identity.voltage_variant, identity.model_variant);
    status = kitchen_sink_read_model_name(&device, name);
    printf(" %s %s\n", fieldscribe_modbus_status_name(status), name);
    return close(wire);
}
