#include "trips.h"
#define TRIP(point, type, first)                                                           \
    for (at = first; at <= first + 65535; ++at) {                                          \
        const type raw = (type)at;                                                         \
        type again = (type)(raw ^ 1);                                                      \
        if (trips_##point##_encode(trips_##point##_decode(raw), &again) != FIELDSCRIBE_OK ||     \
            again != raw) {                                                                \
            return 1;                                                                      \
        }                                                                                  \
        again = (type)(raw ^ 1);                                                           \
        if (trips_##point##_encode_count(trips_##point##_decode_count(raw), &again) !=     \
                FIELDSCRIBE_OK || again != raw) {                                                \
            return 2;                                                                      \
        }                                                                                  \
    }
int main(void)
{
    int32_t at;
    TRIP(tenth, uint16_t, 0)
    TRIP(fine, uint16_t, 0)
    TRIP(sevenths, uint16_t, 0)
    TRIP(falling, int16_t, -32768)
    TRIP(shifted, int16_t, -32768)
    return 0;
}
