#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#define FIELDSCRIBE_IMPLEMENTATION
#include "DEVICE_FAMILY.h"

#define CHECK(that, item) if (!(that)) { fprintf(stderr, "%s: line %d: %s\n", #item, __LINE__, #that); exit(1); }

/* A unit that holds the words of any point; it refuses on demand. */
static uint16_t held[4];
static size_t writes;
static bool refuses;
static bool bits; /* a coil or an input: 0 or 1 */

@ASK@

static const uint16_t SAMPLES[] = {@SAMPLES@};
static const int64_t VALUES[] = {@VALUES@};
static DEVICE_device device = @HANDLE@;

static void fill(size_t from)
{
    size_t at;
    for (at = 0U; at < 4U; ++at) {
        held[at] = (uint16_t)(SAMPLES[from % FIELDSCRIBE_COUNT(SAMPLES)] & (bits ? 1U : 0xFFFFU));
        from = (from / FIELDSCRIBE_COUNT(SAMPLES)) + (3U * at);
    }
    writes = 0U;
}

/* `decode` gives the status, and stores what `raw` means in `want`. */
#define READ(item, kind, raw_type, type, decode) \
    WIDTH(DEVICE_##item##_frame.read); \
    for (at = 0U; at < 3000U; ++at) { \
        raw_type raw = (raw_type)0; \
        type want = (type)0; \
        type got = (type)0; \
        int status; \
        bits = DEVICE_##item##_frame.layout->mask == 1U; \
        fill(at); \
        CHECK(fieldscribe_take_##kind(DEVICE_##item##_frame.layout, held, 4U, &raw), item) \
        status = (int)(decode); \
        CHECK((int)DEVICE_read_##item(&device, &got) == status && IS(DEVICE_##item##_frame.read), item) \
        CHECK(memcmp(&got, &want, sizeof got) == 0, item) \
        refuses = true; \
        CHECK(DEVICE_read_##item(&device, &got) == REFUSED && device.unit.ERROR == 0x22U, item) \
        CHECK(memcmp(&got, &want, sizeof got) == 0, item) \
        refuses = false; \
    }

/* `encode` gives the status, and stores the raw number of `value`. */
#define WRITE(verb, item, frame, way, kind, raw_type, type, encode) \
    WIDTH(frame.way); \
    for (at = 0U; at < FIELDSCRIBE_COUNT(VALUES); ++at) { \
        const type value = (type)VALUES[at]; \
        raw_type raw = (raw_type)0; \
        const int status = (int)(encode); \
        uint16_t wanted[4]; \
        bits = frame.layout->mask == 1U; \
        fill(at); \
        memcpy(wanted, held, sizeof held); \
        refuses = true; \
        CHECK((int)DEVICE_##verb##_##item(&device, value) == ((status == 0) ? (int)REFUSED : status) && writes == 0U, item) \
        refuses = false; \
        CHECK((int)DEVICE_##verb##_##item(&device, value) == status, item) \
        if (status == 0) { \
            CHECK(fieldscribe_put_##kind(frame.layout, raw, wanted, 4U) && IS(frame.way), item) \
        } \
        CHECK(memcmp(wanted, held, sizeof held) == 0 && writes == ((status == 0) ? 1U : 0U), item) \
    }

int main(void)
{
    size_t at;
    LINES
    return 0;
}
