/* Asks by libmodbus: `foreign tcp PORT UNIT` or `foreign serial PATH UNIT`; lines are as `of_program` writes them. */
#include <errno.h>
#include <modbus.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MOST 2000

static uint8_t bits[MOST];
static uint16_t words[MOST];

static int asked(modbus_t *bus, int function, int address, int count)
{
    switch (function) {
    case 1:
        return modbus_read_bits(bus, address, count, bits);
    case 2:
        return modbus_read_input_bits(bus, address, count, bits);
    case 3:
        return modbus_read_registers(bus, address, count, words);
    case 4:
        return modbus_read_input_registers(bus, address, count, words);
    case 5:
        return modbus_write_bit(bus, address, words[0]);
    case 6:
        return modbus_write_register(bus, address, words[0]);
    case 15:
        return modbus_write_bits(bus, address, count, bits);
    default:
        return modbus_write_registers(bus, address, count, words);
    }
}

/* The number of an exception. Of a vendor's the library says only that it is bad: the request is sent once more. */
static int refusal(modbus_t *bus, int unit, int function, int address, int count)
{
    uint8_t request[MOST] = {(uint8_t)unit, (uint8_t)function, (uint8_t)(address >> 8), (uint8_t)address};
    uint8_t reply[MODBUS_MAX_ADU_LENGTH];
    int size = 6;
    int at;
    if (errno != EMBBADEXC) {
        return errno - MODBUS_ENOBASE;
    }
    if (function < 5 || function > 6) {
        request[4] = (uint8_t)(count >> 8);
        request[5] = (uint8_t)count;
    } else {
        request[4] = (uint8_t)(function == 6 ? words[0] >> 8 : words[0] ? 0xFF : 0);
        request[5] = (uint8_t)(function == 6 ? words[0] : 0);
    }
    if (function == 15) {
        request[size++] = (uint8_t)((count + 7) / 8);
        for (at = 0; at < count; ++at) {
            request[size + at / 8] |= (uint8_t)(bits[at] << at % 8);
        }
        size += (count + 7) / 8;
    } else if (function == 16) {
        request[size++] = (uint8_t)(2 * count);
        for (at = 0; at < count; ++at) {
            request[size++] = (uint8_t)(words[at] >> 8);
            request[size++] = (uint8_t)words[at];
        }
    }
    modbus_send_raw_request(bus, request, size);
    size = modbus_receive_confirmation(bus, reply);
    at = modbus_get_header_length(bus);
    return size > at + 1 && reply[at] == (function | 0x80) ? reply[at + 1] : -1;
}

static void ask(modbus_t *bus, int unit, int function, int address, int count)
{
    int at;
    if (function > 4) {
        for (at = 0; at < count; ++at) {
            unsigned item = 0;
            (void)scanf("%u", &item);
            words[at] = (uint16_t)item;
            bits[at] = (uint8_t)(item != 0);
        }
    }
    if (asked(bus, function, address, count) < 0) {
        const int code = errno > MODBUS_ENOBASE && errno <= EMBBADEXC && errno != EMBBADCRC && errno != EMBBADDATA
            ? refusal(bus, unit, function, address, count) : -1;
        if (code < 0) {
            printf("failed %s\n", modbus_strerror(errno));
        } else {
            printf("refused %d\n", code);
        }
    } else {
        printf("ok");
        for (at = 0; function < 5 && at < count; ++at) {
            printf(" %d", function < 3 ? bits[at] : words[at]);
        }
        printf("\n");
    }
    fflush(stdout);
}

int main(int argc, char **argv)
{
    const int unit = atoi(argv[argc - 1]);
    modbus_t *const bus = strcmp(argv[1], "tcp") == 0 ? modbus_new_tcp("127.0.0.1", atoi(argv[2]))
                                                      : modbus_new_rtu(argv[2], 19200, 'N', 8, 1);
    int function;
    int address;
    int count;
    if (bus == NULL || modbus_set_slave(bus, unit) != 0 || modbus_connect(bus) != 0) {
        return 1;
    }
    while (scanf("%d %d %d", &function, &address, &count) == 3) {
        ask(bus, unit, function, address, count);
    }
    modbus_close(bus);
    modbus_free(bus);
    return 0;
}
