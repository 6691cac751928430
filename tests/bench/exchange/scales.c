/* Conversions whose scale needs another point at run time, each as the only one of its program, or two together. */
#include <stdint.h>
#if PART == 8
#include "woodward_mpu2s.h"
#else
#include "siemens_mm4.h"
#endif

int scale(void);

#if PART == 6 || PART == 7
#define REFERENCE 0x42480000U /* 50 Hz, which 4000h stands for */
#define HALF 2500000
#else
#define REFERENCE 0x42AE999AU /* 87.3 Hz: all bits of the number matter */
#define HALF 4365000
#endif
#if PART == 6 || PART == 9 || PART == 10
static int encode(void)
{
    volatile uint32_t reference_frequency = REFERENCE;
    const siemens_mm4_with_reference_frequency_and_uss_normalisation with = {reference_frequency, 0U};
    uint16_t raw = 0U;
    volatile int64_t count = HALF;
    return (siemens_mm4_main_setpoint_encode_count(count, &with, &raw) != FIELDSCRIBE_OK) || (raw != 0x2000U);
}
#endif
#if PART == 7 || PART == 9 || PART == 10
static int decode(void)
{
    volatile uint32_t reference_frequency = REFERENCE;
    const siemens_mm4_with_reference_frequency_and_uss_normalisation with = {reference_frequency, 0U};
    int64_t count = 0;
    volatile uint16_t raw = 0x2000U;
    return (siemens_mm4_main_actual_value_decode_count(raw, &with, &count) != FIELDSCRIBE_OK) || (count != HALF);
}
#endif

__attribute__((noinline)) int scale(void)
{
#if PART == 6
    return encode();
#elif PART == 7
    return decode();
#elif PART == 8
    int64_t count = 0;
    volatile uint16_t raw = 4000U;
    volatile int8_t exponent = -1;
    return (woodward_mpu2s_generator_voltage_l1_l2_decode_count(raw, exponent, &count) != FIELDSCRIBE_OK) ||
           (count == 0);
#elif PART == 9 || PART == 10
    volatile int part = PART;
    return (part == 9) ? encode() : decode();
#else
    return 0;
#endif
}
