/* Conversions whose scale needs another point at run time, each as the only one of its program. */
#include <stdint.h>
#if PART >= 8
#include "woodward_mpu2s.h"
#else
#include "siemens_mm4.h"
#endif

int scale(void);

__attribute__((noinline)) int scale(void)
{
#if PART == 6 || PART == 7
    volatile uint32_t reference_frequency = 0x42480000U; /* 50 Hz, which 4000h stands for */
    const siemens_mm4_with_reference_frequency_and_uss_normalisation with = {reference_frequency, 0U};
#endif
#if PART == 6
    uint16_t raw = 0U;
    volatile int64_t count = 2500000;
    return (siemens_mm4_main_setpoint_encode_count(count, &with, &raw) != FIELDSCRIBE_OK) || (raw != 0x2000U);
#elif PART == 7
    int64_t count = 0;
    volatile uint16_t raw = 0x2000U;
    return (siemens_mm4_main_actual_value_decode_count(raw, &with, &count) != FIELDSCRIBE_OK) ||
           (count != 2500000);
#elif PART == 8
    int64_t count = 0;
    volatile uint16_t raw = 4000U;
    volatile int8_t exponent = -1;
    return (woodward_mpu2s_generator_voltage_l1_l2_decode_count(raw, exponent, &count) != FIELDSCRIBE_OK) ||
           (count == 0);
#else
    return 0;
#endif
}
