/* micro:bit (nRF51822, Cortex-M0): start-up, and its UART with a timer for silence. */
#include "board.h"

#define REGISTER(address) (*(volatile uint32_t *)(address))
#define UART_START_RX REGISTER(0x40002000U)
#define UART_START_TX REGISTER(0x40002008U)
#define UART_RX_READY REGISTER(0x40002108U)
#define UART_TX_READY REGISTER(0x4000211CU)
#define UART_ENABLE REGISTER(0x40002500U)
#define UART_RX REGISTER(0x40002518U)
#define UART_TX REGISTER(0x4000251CU)
#define TIMER_START REGISTER(0x40008000U)
#define TIMER_CLEAR REGISTER(0x4000800CU)
#define TIMER_CAPTURE REGISTER(0x40008040U)
#define TIMER_BITS REGISTER(0x40008508U)
#define TIMER_PRESCALER REGISTER(0x40008510U)
#define TIMER_NOW REGISTER(0x40008540U)
#define BETWEEN 4011U    /* microseconds, 3.5 characters of 11 bits at 9600 baud */
#define BYTES_MOST 1024U /* for which a line that is never silent is waited for */

extern uint32_t _stack, _data_from, _data, _data_end, _bss, _bss_end;
int main(void);

void reset(void);
void reset(void)
{
    uint32_t *from = &_data_from;
    uint32_t *to;
    for (to = &_data; to < &_data_end; ++to) {
        *to = *from++;
    }
    for (to = &_bss; to < &_bss_end; ++to) {
        *to = 0U;
    }
    UART_ENABLE = 4U;
    UART_START_RX = 1U;
    UART_START_TX = 1U;
    TIMER_BITS = 3U;      /* 32 bits */
    TIMER_PRESCALER = 4U; /* 16 MHz to 1 MHz */
    TIMER_START = 1U;
    (void)main();
    for (;;) {
    }
}

static void fault(void)
{
    for (;;) {
    }
}

typedef union vector {
    const uint32_t *stack;
    void (*handler)(void);
} vector;

__attribute__((section(".vectors"), used)) static const vector vectors[] = {
    {.stack = &_stack}, {.handler = reset}, {.handler = fault}, {.handler = fault}};

/* Whether a byte comes within so many microseconds. */
static bool comes(uint32_t within, uint8_t *byte)
{
    TIMER_CLEAR = 1U;
    do {
        if (UART_RX_READY != 0U) {
            UART_RX_READY = 0U;
            *byte = (uint8_t)UART_RX;
            return true;
        }
        TIMER_CAPTURE = 1U;
    } while (TIMER_NOW < within);
    return false;
}

void uart_send(void *context, const uint8_t *bytes, size_t length)
{
    uint32_t left = BYTES_MOST;
    uint8_t dropped;
    (void)context;
    while ((left > 0U) && comes(BETWEEN, &dropped)) {
        --left;
    }
    while (length-- > 0U) {
        UART_TX_READY = 0U;
        UART_TX = *bytes++;
        while (UART_TX_READY == 0U) {
        }
    }
}

bool uart_receive(void *context, uint32_t milliseconds, uint8_t *byte)
{
    (void)context;
    return comes(1000U * milliseconds, byte);
}
