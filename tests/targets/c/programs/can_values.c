#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#define FIELDSCRIBE_IMPLEMENTATION
#include "DEVICE_can.h"

#define UNIT 2U
#define CHECK(that) if (!(that)) { fprintf(stderr, "line %d: %s\n", __LINE__, #that); exit(1); }

@DRAW@

/* A member of the struct against its words, as the receiver has them; `number` is what its name says. */
#define MEMBER(item, take, type, member, number) \
    { \
        uint16_t words[4] = {0U, 0U, 0U, 0U}; \
        type raw = (type)0; \
        CHECK(fieldscribe_can_received(&receiver, &item##_frame.heard, words, 4U) == FIELDSCRIBE_CAN_OK) \
        CHECK(take) \
        CHECK(values.member == (number)) \
    }

int main(void)
{
    static fieldscribe_can_slot slots[DEVICE_SLOTS];
    DEVICE_TELEGRAM_values values;
    DEVICE_TELEGRAM_values before;
    fieldscribe_can_receiver receiver =
        fieldscribe_can_listen(&DEVICE_telegram_TELEGRAM, UNIT, slots, FIELDSCRIBE_COUNT(slots));
    unsigned round;
    memset(&values, 0, sizeof values);
    for (round = 0U; round < 100U; ++round) {
        fieldscribe_can_frame frame = {0x320U + UNIT, 8U, {0xDDU, 0U, 0U, 0U, 0U, 0U, 0U, 0U}};
        unsigned part;
        unsigned at;
        for (part = 0U; part < DEVICE_SLOTS; ++part) {
            frame.data[1] = (uint8_t)part;
            for (at = 2U; at < 8U; ++at) {
                frame.data[at] = (uint8_t)(draw() & 0xFFU);
            }
            CHECK(DEVICE_TELEGRAM_values_take(&frame, UNIT, &values))
            CHECK(fieldscribe_can_take(&receiver, &frame, 0U))
        }
        MEMBERS
        /* no part of the telegram, another unit, no unit of the device, and a frame that is cut */
        before = values;
        frame.data[1] = DEVICE_SLOTS;
        CHECK(!DEVICE_TELEGRAM_values_take(&frame, UNIT, &values))
        frame.data[1] = 0U;
        CHECK(!DEVICE_TELEGRAM_values_take(&frame, UNIT + 1U, &values))
        frame.id = 0x320U + 200U;
        CHECK(!DEVICE_TELEGRAM_values_take(&frame, 200U, &values))
        frame.id = 0x320U + UNIT;
        frame.length = 7U;
        CHECK(!DEVICE_TELEGRAM_values_take(&frame, UNIT, &values))
        CHECK(memcmp(&before, &values, sizeof values) == 0)
    }
    return 0;
}
