/* What a call says of a device whose texts are UTF-8 and UTF-16: `identify_texts WORD...`, the words from 0 on. */
#include <stdio.h>
#include <stdlib.h>

#define FIELDSCRIBE_IMPLEMENTATION
#include "made_up_modbus.h"

static char **held;

static fieldscribe_modbus_status answers(const fieldscribe_modbus_line *line,
    const fieldscribe_modbus_request *request, fieldscribe_modbus_reply *reply)
{
    uint16_t at;
    (void)line;
    for (at = 0U; at < request->count; ++at) {
        reply->values[at] = (uint16_t)strtoul(held[request->address + at], NULL, 16);
    }
    reply->count = request->count;
    return FIELDSCRIBE_MODBUS_OK;
}

int main(int count, char **arguments)
{
    made_up_device device = {FIELDSCRIBE_MODBUS_UNIT(NULL, &answers, 1U)};
    made_up_identity identity = {false, 9U};
    held = arguments + 1;
    if (count == 9) {
        const fieldscribe_modbus_status status = made_up_identify(&device, &identity);
        printf("%d %d %u", (int)status, identity.is_described, identity.series_variant);
    }
    return count != 9;
}
