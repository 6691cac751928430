#define FIELDSCRIBE_NO_FLOAT
#include "sample_drive.h"
volatile int32_t wanted;
volatile int32_t shown;
volatile uint16_t wire;
void start(void);
void start(void)
{
    uint16_t raw = 0U;
    if (sample_drive_base_frequency_encode_count(wanted, &raw) == FIELDSCRIBE_OK) {
        wire = raw;
    }
    shown = sample_drive_base_frequency_decode_count(wire);
    for (;;) {
    }
}
