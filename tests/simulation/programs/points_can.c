/* Listens to a telegram, reads each parameter and writes it back; the bus is standard input and output. */
#include <poll.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>
#define FIELDSCRIBE_IMPLEMENTATION
#include "woodward_mpu2s_can.h"

#define UNIT 3U
#define FRAMES_MOST 200U

static const fieldscribe_can_dialogue *const dialogue = &woodward_mpu2s_can_dialogue;
static fieldscribe_can_slot slots[WOODWARD_MPU2S_TELEGRAM_VISUALISATION_SLOTS];
static fieldscribe_can_receiver telegram;

static bool send(const fieldscribe_can_frame *frame)
{
    const uint8_t bytes[13] = {0U, 0U, (uint8_t)(frame->id >> 8), (uint8_t)frame->id, 8U, frame->data[0],
        frame->data[1], frame->data[2], frame->data[3], frame->data[4], frame->data[5], frame->data[6], frame->data[7]};
    return write(1, bytes, sizeof bytes) == (ssize_t)sizeof bytes;
}

static bool receive(fieldscribe_can_frame *frame)
{
    struct pollfd bus = {0, POLLIN, 0};
    uint8_t bytes[13];
    if ((poll(&bus, 1, 1000) <= 0) || (read(0, bytes, sizeof bytes) != (ssize_t)sizeof bytes)) {
        return false;
    }
    frame->id = ((uint32_t)bytes[2] << 8) | bytes[3];
    frame->length = bytes[4];
    (void)memcpy(frame->data, &bytes[5], 8U);
    (void)fieldscribe_can_take(&telegram, frame, 0U);
    return true;
}

static void point(const char *name, const fieldscribe_can_reading *what, const fieldscribe_can_writing *writing)
{
    fieldscribe_can_frame frame;
    uint16_t word = 0U;
    unsigned left;
    bool done = false;
    if ((fieldscribe_can_read(dialogue, UNIT, what, &frame) == FIELDSCRIBE_CAN_OK) && send(&frame)) {
        for (left = FRAMES_MOST; !done && (left > 0U) && receive(&frame); --left) {
            done = fieldscribe_can_read_answer(dialogue, UNIT, what, &frame, &word) == FIELDSCRIBE_CAN_OK;
        }
    }
    if (done && (writing != NULL)) {
        done = false;
        if ((fieldscribe_can_write(dialogue, UNIT, writing, word, &frame) == FIELDSCRIBE_CAN_OK) && send(&frame)) {
            for (left = FRAMES_MOST; !done && (left > 0U) && receive(&frame); --left) {
                done = fieldscribe_can_write_answer(dialogue, UNIT, writing, word, &frame) == FIELDSCRIBE_CAN_OK;
            }
        }
    }
    (void)fprintf(stderr, "%s %d %u\n", name, done ? 0 : 1, (unsigned)word);
}

static void value(const char *name, const fieldscribe_can_heard *what, size_t count)
{
    uint16_t words[2] = {0U, 0U};
    const int status = (int)fieldscribe_can_received(&telegram, what, words, count);
    (void)fprintf(stderr, "%s %d %lu\n", name, status,
        (count > 1U) ? ((unsigned long)words[0] << 16) | words[1] : (unsigned long)words[0]);
}

int main(void)
{
    telegram = fieldscribe_can_listen(
        &woodward_mpu2s_telegram_visualisation, UNIT, slots, FIELDSCRIBE_COUNT(slots));
#include "points.inc"
    return 0;
}
