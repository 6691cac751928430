/*
 * After each instruction of a function of a receiver, an interrupt calls another one: x86 stops after each while its
 * trap flag is set. A number of two words is of one frame, whoever interrupts whom.
 */
#define _GNU_SOURCE /* REG_EFL */
#include <limits.h>
#include <signal.h>
#include <ucontext.h>
#define FIELDSCRIBE_IMPLEMENTATION
#include "fieldscribe_can.h"
#define TRAP_FLAG 0x100

static const fieldscribe_can_profile profile = {1U, 9U, 11U};
static const fieldscribe_can_message message = {0x100U, false,
    {{FIELDSCRIBE_CAN_CONSTANT, 0U}, {FIELDSCRIBE_CAN_CONSTANT, 0U}, {FIELDSCRIBE_CAN_WORD, 0U},
        {FIELDSCRIBE_CAN_WORD, 1U}, {FIELDSCRIBE_CAN_WORD, 2U}, {FIELDSCRIBE_CAN_WORD, 3U},
        {FIELDSCRIBE_CAN_CONSTANT, 0U}, {FIELDSCRIBE_CAN_CONSTANT, 0U}}};
static const fieldscribe_can_telegram telegram = {&profile, &message, 2U, 2U};
static const fieldscribe_can_heard number = {0U, 1U};
static fieldscribe_can_slot slots[1];
static fieldscribe_can_receiver receiver;
static uint8_t pattern;
static uint8_t previous;
static unsigned steps;
static unsigned wanted; /* the instruction that a frame comes after; 0: a reader comes after each */
static unsigned whole;
static unsigned torn;
static unsigned wrong;

static void take(void)
{
    fieldscribe_can_frame frame = {0x100U, 8U, {0U, 0U, 0U, 0U, 0U, 0U, 0U, 0U}};
    unsigned at;
    previous = pattern;
    pattern = (uint8_t)((pattern % 200U) + 1U);
    for (at = 2U; at < 6U; ++at) {
        frame.data[at] = pattern;
    }
    wrong += fieldscribe_can_take(&receiver, &frame, pattern) ? 0U : 1U;
}

static void read_number(void)
{
    uint16_t words[2] = {0U, 0U};
    const fieldscribe_can_status status = fieldscribe_can_received(&receiver, &number, words, 2U);
    const uint16_t expected = (uint16_t)(pattern * 0x0101U);
    const uint16_t before = (uint16_t)(previous * 0x0101U);
    if (status == FIELDSCRIBE_CAN_OK) {
        ++whole;
        wrong += (words[0] == words[1] && (words[0] == expected || words[0] == before)) ? 0U : 1U;
    } else {
        ++torn;
        wrong += (status == FIELDSCRIBE_CAN_TORN && wanted == 0U) ? 0U : 1U;
    }
}

static void interrupt(int signal, siginfo_t *info, void *context)
{
    (void)signal;
    (void)info;
    ++steps;
    if (wanted == 0U) {
        read_number();
    } else if (steps == wanted) {
        take();
        ((ucontext_t *)context)->uc_mcontext.gregs[REG_EFL] &= ~TRAP_FLAG; /* nothing comes after it */
    } else {
        /* not yet */
    }
}

static void step(void (*function)(void))
{
    steps = 0U;
    __asm__ volatile("pushfq\n orl %0, (%%rsp)\n popfq" : : "i"(TRAP_FLAG) : "cc", "memory");
    function();
    __asm__ volatile("pushfq\n andl %0, (%%rsp)\n popfq" : : "i"(~TRAP_FLAG) : "cc", "memory");
}

int main(void)
{
    unsigned most;
    struct sigaction action = {0};
    action.sa_sigaction = &interrupt;
    action.sa_flags = SA_SIGINFO;
    (void)sigaction(SIGTRAP, &action, NULL);
    receiver = fieldscribe_can_listen(&telegram, 1U, slots, 1U);
    take();
    take();
    step(&take);
    if (wrong != 0U || whole < 50U || torn == 0U || torn > (whole / 2U)) {
        return 1;
    }
    wanted = UINT_MAX;
    step(&read_number);
    most = steps;
    for (wanted = 1U; wanted <= most; ++wanted) {
        step(&read_number);
    }
    return wrong == 0U && most > 50U ? 0 : 2;
}
