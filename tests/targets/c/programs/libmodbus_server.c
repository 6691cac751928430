/* A server of libmodbus on a free port, which it prints: words and bits are a pattern of their addresses. */
#include <arpa/inet.h>
#include <modbus.h>
#include <stdio.h>
#include <stdlib.h>

#define ADDRESSES 0x10000

int main(void)
{
    uint8_t query[MODBUS_TCP_MAX_ADU_LENGTH];
    struct sockaddr_in here;
    socklen_t size = sizeof here;
    modbus_t *const bus = modbus_new_tcp("127.0.0.1", 0);
    modbus_mapping_t *const map = modbus_mapping_new(ADDRESSES, ADDRESSES, ADDRESSES, ADDRESSES);
    int listening = modbus_tcp_listen(bus, 1);
    int at;
    for (at = 0; at < ADDRESSES; ++at) {
        map->tab_bits[at] = map->tab_input_bits[at] = (uint8_t)(at % 3 == 0);
        map->tab_registers[at] = map->tab_input_registers[at] = (uint16_t)(at * 40503L + 12345L);
    }
    if (listening < 0 || getsockname(listening, (struct sockaddr *)&here, &size) != 0) {
        return 1;
    }
    printf("%u\n", ntohs(here.sin_port));
    fflush(stdout);
    while (modbus_tcp_accept(bus, &listening) >= 0) {
        int length = modbus_receive(bus, query);
        while (length >= 0) {
            if (length > 0) {
                (void)modbus_reply(bus, query, length, map);
            }
            length = modbus_receive(bus, query);
        }
        modbus_close(bus);
    }
    return 1;
}
