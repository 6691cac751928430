/* CAN frames through the parser and the receivers in C, with the messages of kitchen_can. */
#define FIELDSCRIBE_IMPLEMENTATION
#include "cases.h"
#include "kitchen_can_can.h"

#define UNIT 5U

static const char *const names[] = {"ok", "bad_unit", "bad_address", "bad_value", "wrong_id", "wrong_length",
    "wrong_constant", "wrong_unit", "wrong_check", "wrong_address", "echo_mismatch", "missing", "torn"};

static const fieldscribe_can_message *const messages[] = {
#include "messages.inc"
};

/* Offers a frame to a receiver, and prints whether it was taken and what one word is now. */
static void hear(fieldscribe_can_receiver *receiver, const fieldscribe_can_frame *frame, uint16_t position)
{
    uint16_t word = 0U;
    const bool taken = fieldscribe_can_take(receiver, frame, 0U);
    const fieldscribe_can_status status = fieldscribe_can_word(receiver, position, &word);
    printf(" %d %s %u", taken, names[status], word);
}

int main(void)
{
    fieldscribe_can_slot slots[KITCHEN_CAN_TELEGRAM_MEASUREMENTS_SLOTS];
    fieldscribe_can_slot slot[KITCHEN_CAN_TELEGRAM_HEARTBEAT_SLOTS];
    fieldscribe_can_receiver measurements = fieldscribe_can_listen(&kitchen_can_telegram_measurements, UNIT, slots, KITCHEN_CAN_TELEGRAM_MEASUREMENTS_SLOTS);
    fieldscribe_can_receiver heartbeat = fieldscribe_can_listen(&kitchen_can_telegram_heartbeat, UNIT, slot, KITCHEN_CAN_TELEGRAM_HEARTBEAT_SLOTS);
    for (;;) {
        const uint32_t message = take(1U);
        const uint8_t unit = (uint8_t)take(1U);
        const uint16_t position = (uint16_t)take(2U);
        fieldscribe_can_frame frame = {0U, 0U, {0U, 0U, 0U, 0U, 0U, 0U, 0U, 0U}};
        fieldscribe_can_content content = {unit, 0U, 0U};
        uint8_t *bytes;
        fieldscribe_can_status status;
        unsigned at;
        frame.id = take(4U);
        frame.length = (uint8_t)take(2U);
        bytes = exactly(frame.length);
        take_bytes(bytes, frame.length);
        for (at = 0U; at < frame.length && at < FIELDSCRIBE_CAN_BYTES; ++at) {
            frame.data[at] = bytes[at];
        }
        status = fieldscribe_can_parse(messages[message], &frame, &content);
        printf("%s %u %u", names[status], (unsigned)content.address, (unsigned)content.raw);
        hear(&measurements, &frame, position);
        hear(&heartbeat, &frame, 0U);
        printf("\n");
        free(bytes);
    }
}
