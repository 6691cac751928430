/* Reads and writes points of a window in the order of support/windows.py: `windows PORT`. */
#include <arpa/inet.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <unistd.h>
#define FIELDSCRIBE_IMPLEMENTATION
#include "kitchen_sink_modbus.h"

static int line_of_device;
static uint8_t buffer[FIELDSCRIBE_MODBUS_TCP_MOST];

static void to_line(void *context, const uint8_t *bytes, size_t length)
{
    (void)context;
    if (write(line_of_device, bytes, length) != (ssize_t)length) {
        exit(3);
    }
}

static bool from_line(void *context, uint32_t milliseconds, uint8_t *byte)
{
    (void)context;
    (void)milliseconds;
    return read(line_of_device, byte, 1) == 1;
}

static const fieldscribe_modbus_line line = {
    &kitchen_sink_modbus_profile, buffer, sizeof buffer, &to_line, &from_line, NULL, 2000U, 500U};
static kitchen_sink_device device = {
    FIELDSCRIBE_MODBUS_UNIT(&line, &fieldscribe_modbus_ask_tcp, 1U), FIELDSCRIBE_MODBUS_NOTHING_SELECTED};

#define READ(type, point) do { \
    type number = 0; \
    const fieldscribe_modbus_status status = kitchen_sink_read_##point(&device, &number); \
    printf("%s %ld\n", fieldscribe_modbus_status_name(status), (long)number); \
} while (0)
#define WRITE(point, number) puts(fieldscribe_modbus_status_name(kitchen_sink_write_##point(&device, number)))

int main(int argc, char **argv)
{
    struct sockaddr_in there = {0};
    uint16_t word = 0U;
    there.sin_family = AF_INET;
    there.sin_port = htons((uint16_t)atoi(argv[argc - 1]));
    there.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    line_of_device = socket(AF_INET, SOCK_STREAM, 0);
    if (connect(line_of_device, (struct sockaddr *)&there, sizeof there) != 0) {
        return 2;
    }
    READ(int32_t, input_delay_index_2);
    READ(int64_t, input_counter_index_2);
    READ(int32_t, page);
    READ(int32_t, input_delay_index_2);
    WRITE(input_delay_index_3, 45);
    READ(int32_t, output_mode);
    READ(int32_t, input_delay_index_3);
    WRITE(page, 0);
    READ(int32_t, input_delay_index_3);
    WRITE(input_delay_index_1, 501);
    READ(int32_t, input_delay_index_3);
    puts(fieldscribe_modbus_status_name(fieldscribe_modbus_read_word(&device.unit, 3U, 0x7FFFU, &word)));
    READ(int32_t, input_delay_index_3);
    return 0;
}
