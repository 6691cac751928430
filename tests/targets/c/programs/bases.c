/* Bases of addresses: given and found, in a unit whose registers are `held` from `first` on; the rest is refused. */
#define FIELDSCRIBE_IMPLEMENTATION
#include "kitchen_blocks_rows.h"
#include <stdlib.h>
#include <string.h>

#define CHECK(holds) do { if (!(holds)) { exit(__LINE__ & 0x7F ? __LINE__ & 0x7F : 1); } } while (0)

static uint16_t held[0x10000];
static bool there[0x10000];
static size_t asked;

static fieldscribe_modbus_status ask(const fieldscribe_modbus_line *line, const fieldscribe_modbus_request *request,
    fieldscribe_modbus_reply *reply)
{
    uint8_t bytes[FIELDSCRIBE_MODBUS_RTU_MOST];
    size_t length = 0U;
    size_t at;
    fieldscribe_modbus_status status = fieldscribe_modbus_build(
        &kitchen_blocks_modbus_profile, FIELDSCRIBE_MODBUS_RTU, request, bytes, sizeof bytes, &length);
    (void)line;
    if (status != FIELDSCRIBE_MODBUS_OK) {
        return status;
    }
    ++asked;
    for (at = request->address; at < (size_t)request->address + request->count; ++at) {
        if (!there[at]) {
            reply->exception = 2U;
            return FIELDSCRIBE_MODBUS_EXCEPTION;
        }
        if (fieldscribe_modbus_reads(request->function)) {
            reply->values[at - request->address] = held[at];
        } else {
            held[at] = request->number;
        }
    }
    reply->count = request->count;
    return FIELDSCRIBE_MODBUS_OK;
}

static void put(uint16_t first, const uint16_t *words, size_t count)
{
    size_t at;
    memset(there, 0, sizeof there);
    asked = 0U;
    for (at = 0U; at < count; ++at) {
        held[first + at] = words[at];
        there[first + at] = true;
    }
}

#define PUT(first, ...) do { static const uint16_t w[] = {__VA_ARGS__}; put(first, w, sizeof w / sizeof w[0]); } while (0)

static fieldscribe_modbus_status find(uint16_t block, fieldscribe_modbus_base *base)
{
    fieldscribe_modbus_unit unit = {NULL, &ask, 1U, 0U, 0U, false};
    return fieldscribe_modbus_find(&unit, &kitchen_blocks_models, block, base);
}

/* Rows: plain, of an array, of bits, behind a found block; each does what the functions of its point do. */
static const fieldscribe_modbus_based_row level = KITCHEN_BLOCKS_LEVEL_ROW;
static const fieldscribe_modbus_based_row mode = KITCHEN_BLOCKS_MODE_ROW;
static const fieldscribe_modbus_based_row energy = KITCHEN_BLOCKS_ENERGY_ROW;
static const fieldscribe_modbus_row firmware = KITCHEN_BLOCKS_FIRMWARE_ROW;

static void rows(void)
{
    fieldscribe_modbus_line line = {&kitchen_blocks_modbus_profile, NULL, 0U, NULL, NULL, NULL, 0U, 0U};
    kitchen_blocks_device device = {{&line, &ask, 1U, 0U, 0U, false}};
    const fieldscribe_modbus_base base = kitchen_blocks_slot_half_base(3U, 1U);
    const fieldscribe_modbus_base early = {3016U, 4U}; /* level is behind its end */
    int64_t number = 0;
    PUT(3021U, 405U, 1U, 2U, 0xFFF1U);
    CHECK(fieldscribe_modbus_read_row_at(&device.unit, &level, base, &number) == FIELDSCRIBE_MODBUS_OK && number == 405);
    CHECK(fieldscribe_modbus_read_row_at(&device.unit, &energy, base, &number) == FIELDSCRIBE_MODBUS_OK);
    CHECK(number == 0x10002);
    CHECK(fieldscribe_modbus_write_row_at(&device.unit, &level, base, 1000) == FIELDSCRIBE_MODBUS_OK);
    CHECK(held[3021] == 1000U);
    CHECK(fieldscribe_modbus_write_row_at(&device.unit, &mode, base, 5) == FIELDSCRIBE_MODBUS_OK && held[3024] == 0xFFFBU);
    asked = 0U;
    CHECK(fieldscribe_modbus_write_row_at(&device.unit, &level, base, 1001) == FIELDSCRIBE_MODBUS_OUT_OF_RANGE);
    CHECK(fieldscribe_modbus_write_row_at(&device.unit, &energy, base, 1) == FIELDSCRIBE_MODBUS_BAD_FUNCTION);
    CHECK(fieldscribe_modbus_write_row_at(&device.unit, &level, early, 1) == FIELDSCRIBE_MODBUS_BAD_COUNT);
    CHECK(fieldscribe_modbus_write_row_at(&device.unit, &mode, early, 1) == FIELDSCRIBE_MODBUS_BAD_COUNT);
    CHECK(fieldscribe_modbus_read_row_at(&device.unit, &level, early, &number) == FIELDSCRIBE_MODBUS_BAD_COUNT);
    CHECK(asked == 0U && number == 0x10002 && held[3021] == 1000U);
    PUT(5U, 17U);
    CHECK(fieldscribe_modbus_read_row(&device.unit, &firmware, &number) == FIELDSCRIBE_MODBUS_OK && number == 17);
}

/* The first two steps of `dim`: each says that it counts from a base, which moves it; one of `close` does not. */
static void steps(void)
{
    const fieldscribe_modbus_base base = kitchen_blocks_slot_half_base(3U, 1U);
    const uint16_t arguments[] = {50U};
    const fieldscribe_modbus_step *step = kitchen_blocks_command_dim_steps;
    fieldscribe_modbus_line line = {&kitchen_blocks_modbus_profile, NULL, 0U, NULL, NULL, NULL, 0U, 0U};
    fieldscribe_modbus_unit unit = {&line, &ask, 1U, 0U, 0U, false};
    uint16_t words[1] = {0U};
    size_t at;
    PUT(3021U, 405U, 0U, 0U, 0xFFF0U);
    for (at = 0U; at < 2U; ++at, ++step) {
        const fieldscribe_modbus_reading read = fieldscribe_modbus_reading_at(base, &step->read);
        const fieldscribe_modbus_writing write = fieldscribe_modbus_writing_at(base, &step->write);
        CHECK(step->based && step->conditional == (at == 1U));
        CHECK(read.function == 0U ||
            fieldscribe_modbus_read_words(&unit, &read, words, 1U) == FIELDSCRIBE_MODBUS_OK);
        (void)fieldscribe_modbus_steps_fill(step, arguments, words);
        CHECK(fieldscribe_modbus_write_words(&unit, &write, words, write.count) == FIELDSCRIBE_MODBUS_OK);
    }
    CHECK(held[3021] == 500U && held[3024] == 0xFFF1U);
    CHECK(!kitchen_blocks_command_close_steps[1].based && kitchen_blocks_command_close_steps[2].based);
}

int main(void)
{
    kitchen_blocks_device device = {{NULL, &ask, 1U, 0U, 0U, false}};
    fieldscribe_modbus_base base = kitchen_blocks_slot_half_base(3U, 1U);
    fieldscribe_modbus_reading block;
    int32_t count = 0;
    CHECK(base.start == 3016U && base.last == 0xFFFFU - 3016U);
    CHECK(kitchen_blocks_slot_half_base(15U, 0U).start == 15000U);
    PUT(3021U, 405U);
    CHECK(kitchen_blocks_read_level(&device, base, &count) == FIELDSCRIBE_MODBUS_OK && count == 405);
    CHECK(kitchen_blocks_write_level(&device, base, 12) == FIELDSCRIBE_MODBUS_OK && held[3021] == 12U);
    asked = 0U;
    base = kitchen_blocks_slot_half_base(0U, 0U);
    CHECK(kitchen_blocks_read_level(&device, base, &count) == FIELDSCRIBE_MODBUS_BAD_COUNT && asked == 0U);
    base = kitchen_blocks_slot_half_base(16U, 0U);
    CHECK(kitchen_blocks_write_level(&device, base, 12) == FIELDSCRIBE_MODBUS_BAD_COUNT && asked == 0U);
    base = kitchen_blocks_slot_half_base(1U, 2U);
    CHECK(kitchen_blocks_write_level(&device, base, 12) == FIELDSCRIBE_MODBUS_BAD_COUNT && asked == 0U);

    PUT(50000U, 0x5375U, 0x6E53U, 1U, 1U, 9U, 160U, 8U, 11U, 21U, 0U, 31U, 12U, 22U, 0U, 32U, 0xFFFFU, 0U);
    CHECK(find(KITCHEN_BLOCKS_MODELS_160, &base) == FIELDSCRIBE_MODBUS_OK && asked == 5U);
    CHECK(base.start == 50005U && base.last == 9U);
    CHECK(kitchen_blocks_read_module_id_index_2(&device, base, &count) == FIELDSCRIBE_MODBUS_OK && count == 12);
    CHECK(kitchen_blocks_write_module_limit_index_2(&device, base, 5) == FIELDSCRIBE_MODBUS_OK && held[50012] == 5U);
    asked = 0U;
    CHECK(kitchen_blocks_read_module_id_index_3(&device, base, &count) == FIELDSCRIBE_MODBUS_BAD_COUNT && asked == 0U);
    block = fieldscribe_modbus_reading_at(base, &kitchen_blocks_modules_blocks[1]);
    CHECK(block.address == 50011U && block.count == 4U);
    CHECK(fieldscribe_modbus_reading_at(base, &kitchen_blocks_modules_blocks[2]).count == 0U);
    CHECK(find(KITCHEN_BLOCKS_MODELS_103, &base) == FIELDSCRIBE_MODBUS_UNKNOWN_VALUE && asked == 6U);

    PUT(0U, 0x5375U, 0x6E53U, 103U, 50U, 1U);
    CHECK(find(103U, &base) == FIELDSCRIBE_MODBUS_OK && base.start == 2U && base.last == 51U && asked == 3U);
    CHECK(find(7U, &base) == FIELDSCRIBE_MODBUS_EXCEPTION);
    PUT(0U, 0x5375U, 0x6E53U, 7U, 0xFFFFU);
    CHECK(find(7U, &base) == FIELDSCRIBE_MODBUS_OVERFLOW);
    PUT(0U, 0x5375U, 0x6E53U, 7U, 0xFFFCU);
    CHECK(find(7U, &base) == FIELDSCRIBE_MODBUS_OK && base.last == 0xFFFDU);
    CHECK(find(8U, &base) == FIELDSCRIBE_MODBUS_OVERFLOW);
    PUT(0U, 1U);
    CHECK(find(7U, &base) == FIELDSCRIBE_MODBUS_UNKNOWN_VALUE && asked == 3U);
    rows();
    steps();
    memset(there, 1, sizeof there);
    memset(held, 0, sizeof held);
    held[0] = 0x5375U;
    held[1] = 0x6E53U;
    asked = 0U;
    CHECK(find(7U, &base) == FIELDSCRIBE_MODBUS_OVERFLOW && asked == 2U + FIELDSCRIBE_MODBUS_BLOCKS_MOST);
    return 0;
}
