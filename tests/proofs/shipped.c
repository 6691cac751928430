/*
 * Proofs with the tables of shipped devices: any bytes, requests and lengths through builder and parser, as firmware
 * that vendors these headers calls them.
 */
#define FIELDSCRIBE_IMPLEMENTATION
#include "arbitrary.h"
/* the sources, not the copies beside the devices */
#include "fieldscribe_can.h"
#include "fieldscribe_modbus.h"
#include "fieldscribe_uss.h"
#include "modbus_items.h"

#include "jumo_controller_modbus.h"
#include "siemens_mm4_uss.h"
#include "woodward_mpu2s_can.h"

#define FRAMES 300U

static uint8_t bytes[FRAMES];
static uint16_t items[LARGE / 2U];
static fieldscribe_modbus_request request;
static fieldscribe_modbus_reply reply;
static fieldscribe_uss_request task;
static fieldscribe_uss_reply answer;
static fieldscribe_uss_link link;
static fieldscribe_can_frame frame;
static fieldscribe_can_slot slots[WOODWARD_MPU2S_TELEGRAM_VISUALISATION_SLOTS];
static fieldscribe_can_heard where;
static volatile uint8_t number;

void prove_jumo_controller(size_t length, size_t room)
{
    size_t used;
    if (length <= FRAMES) {
        request.values = items;
        request.writer = request.function > 0x04U ? &fieldscribe_modbus_writes : NULL;
        reply.values = items;
        reply.room = room;
        if (request.count <= LARGE / 2U) {
            (void)fieldscribe_modbus_build(
                &jumo_controller_modbus_profile, FIELDSCRIBE_MODBUS_RTU, &request, bytes, FRAMES, &used);
            //@ split length;
            NOT_BETWEEN(length, FRAMES);
            BY_ITEMS(BEHIND(5U, length), fieldscribe_modbus_parse(
                FIELDSCRIBE_MODBUS_RTU, &request, EXACTLY(length, bytes), length, &reply));
        }
    }
}

void prove_siemens_mm4(size_t length, size_t room)
{
    const fieldscribe_uss_words process = {items, link.pzd};
    size_t used;
    if (length <= FRAMES) {
        answer.process = items;
        answer.room = room;
        link.single_first = number % 2U != 0U;
        (void)fieldscribe_uss_build(&siemens_mm4_uss_profile, &link, &task, &process, bytes, FRAMES, &used);
        //@ split length;
        NOT_BETWEEN(length, FRAMES);
        (void)fieldscribe_uss_parse(
            &siemens_mm4_uss_profile, &link, &task, EXACTLY(length, bytes), length, &answer);
    }
}

void prove_woodward_mpu2s(uint8_t unit)
{
    const fieldscribe_can_dialogue *const talk = &woodward_mpu2s_can_dialogue;
    fieldscribe_can_receiver receiver =
        fieldscribe_can_listen(&woodward_mpu2s_telegram_visualisation, unit, slots, FIELDSCRIBE_COUNT(slots));
    uint16_t words[2] = {0U, 0U};
    uint16_t raw = 0U;
    int heard;
    (void)fieldscribe_can_read_answer(talk, unit, &woodward_mpu2s_password_level_2_frame.read, &frame, &words[0]);
    (void)fieldscribe_take_u16(woodward_mpu2s_password_level_2_frame.layout, words, 1U, &raw);
    (void)fieldscribe_put_u16(woodward_mpu2s_password_level_2_frame.layout, raw, words, 1U);
    (void)fieldscribe_can_write(talk, unit, &woodward_mpu2s_password_level_2_frame.write, words[0], &frame);
    for (heard = 0; heard < 100; ++heard) {
        frame.data[1] = number;
        frame.data[2] = number;
        (void)fieldscribe_can_take(&receiver, &frame, number);
        (void)fieldscribe_can_received(&receiver, &where, words, 2U);
    }
}
