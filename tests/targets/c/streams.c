/*
 * Streams of bytes through the receivers in C. Each case says what was asked, how large the buffer is, how many bytes
 * come at once, and the bytes; each answer is printed as it is found, and what was dropped before it. Then the line is
 * silent.
 */
#define FIELDSCRIBE_IMPLEMENTATION
#include "cases.h"
#include "fieldscribe_modbus.h"
#include "fieldscribe_uss.h"

static const fieldscribe_modbus_profile profile = {
    1U, 247U, true, true, false, 0U, 0x40U, {0U, 2000U, 0U, 125U, 0U, 0U, 1U}};

typedef union either {
    fieldscribe_modbus_receiver modbus;
    fieldscribe_uss_receiver uss;
} either;

static void await(bool modbus, const uint8_t *asked, uint8_t *buffer, size_t size, either *receiver)
{
    if (modbus) {
        const fieldscribe_modbus_framing framing = asked[0] == 1U ? FIELDSCRIBE_MODBUS_TCP : FIELDSCRIBE_MODBUS_RTU;
        const fieldscribe_modbus_reading what = {asked[2], 0U, asked[3]};
        fieldscribe_modbus_request request = fieldscribe_modbus_read(asked[1], &what);
        request.transaction = 0x0102U;
        receiver->modbus = fieldscribe_modbus_await(&profile, framing, &request, buffer, size);
    } else {
        const fieldscribe_uss_link link = {asked[2], asked[3], false};
        const fieldscribe_uss_request request = fieldscribe_uss_exchange(asked[1]);
        receiver->uss = fieldscribe_uss_await(&link, &request, buffer, size);
    }
}

/* What was dropped, and the answer; or how many bytes of it have come. */
static void print(bool modbus, const either *receiver)
{
    const uint8_t *const buffer = modbus ? receiver->modbus.buffer : receiver->uss.buffer;
    const size_t length = modbus ? receiver->modbus.length : receiver->uss.length;
    size_t at;
    printf("%u:", (unsigned)(modbus ? receiver->modbus.dropped : receiver->uss.dropped));
    if (!(modbus ? receiver->modbus.done : receiver->uss.done)) {
        printf("%u", (unsigned)length);
        return;
    }
    for (at = 0U; at < length; ++at) {
        printf("%02x", buffer[at]);
    }
    printf(" ");
}

int main(void)
{
    for (;;) {
        uint8_t asked[4];
        bool modbus;
        bool done;
        size_t size;
        size_t at_once;
        size_t count;
        uint8_t *buffer;
        either receiver;
        take_bytes(asked, sizeof asked);
        modbus = asked[0] < 2U;
        size = take(2U);
        at_once = take(2U);
        count = take(2U);
        buffer = exactly(size);
        await(modbus, asked, buffer, size, &receiver);
        done = modbus ? receiver.modbus.done : receiver.uss.done;
        if (done) {
            printf("none");
        }
        while (count > 0U) {
            const size_t some = count < at_once ? count : at_once;
            uint8_t *const bytes = exactly(some);
            size_t used = 0U;
            take_bytes(bytes, some);
            count -= some;
            while (used < some && !done) {
                const size_t taken = modbus ? fieldscribe_modbus_receive(&receiver.modbus, bytes + used, some - used)
                                            : fieldscribe_uss_receive(&receiver.uss, bytes + used, some - used);
                used += taken;
                if (modbus ? receiver.modbus.done : receiver.uss.done) {
                    print(modbus, &receiver);
                    await(modbus, asked, buffer, size, &receiver);
                } else if (taken == 0U) {
                    abort(); /* nothing was taken, and nothing is done */
                } else {
                    /* there is more */
                }
            }
            free(bytes);
        }
        if (!done) {
            if (modbus) {
                fieldscribe_modbus_silent(&receiver.modbus);
            } else {
                fieldscribe_uss_silent(&receiver.uss);
            }
            print(modbus, &receiver);
        }
        printf("\n");
        free(buffer);
    }
}
