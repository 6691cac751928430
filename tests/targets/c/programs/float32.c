#include "sample_drive.h"
int main(void)
{
    uint32_t at;
    for (at = 0; at <= 65535U; ++at) {
        const uint16_t raw = (uint16_t)at;
        uint16_t again = 1;
        fieldscribe_real value = sample_drive_frequency_fine_decode(raw);
        if (sample_drive_frequency_fine_encode(value, &again) != FIELDSCRIBE_OK || again != raw) {
            return 1;
        }
        value = sample_drive_main_frequency_decode(raw); /* the old name of base_frequency */
        if (raw <= SAMPLE_DRIVE_BASE_FREQUENCY_RAW_MAX &&
            (sample_drive_base_frequency_encode(value, &again) != FIELDSCRIBE_OK || again != raw)) {
            return 2;
        }
        if (sizeof(sample_drive_third_decode(raw)) != sizeof(fieldscribe_real)) {
            return 3;
        }
    }
    return sizeof(sample_drive_acceleration_time_decode(1U)) == sizeof(double) ? 0 : 4;
}
