#define FIELDSCRIBE_IMPLEMENTATION
#include "kitchen_sink_modbus.h"
#define CHECK(that) \
    if (!(that)) { \
        return __LINE__ & 0x7F; \
    }
/* Unit 1 answers each request after `delay` ms with the address as its word, one answer behind the other. */
static struct {
    uint8_t byte;
    uint32_t time;
} queue[299];
static size_t first;
static size_t last;
static uint32_t now;
static uint32_t delay;
static size_t received;
static bool babbles;
static void send(void *context, const uint8_t *bytes, size_t length)
{
    uint8_t answer[7] = {1U, 3U, 2U, bytes[2], bytes[3], 0U, 0U};
    const uint16_t crc = fieldscribe_modbus_crc(answer, 5U);
    size_t at;
    (void)context;
    (void)length;
    answer[5] = (uint8_t)(crc & 0xFFU);
    answer[6] = (uint8_t)(crc >> 8);
    while (first < last && queue[first].time <= now) {
        ++first;
    }
    for (at = 0U; bytes[0] == 1U && at < sizeof answer; ++at) {
        queue[last].byte = answer[at];
        queue[last].time = now + delay + (uint32_t)at;
        ++last;
    }
}
static bool receive(void *context, uint32_t milliseconds, uint8_t *byte)
{
    (void)context;
    ++received;
    *byte = 0xFFU;
    if (babbles) {
        return true;
    }
    if (first == last || queue[first].time > now + milliseconds) {
        now += milliseconds;
        return false;
    }
    now = queue[first].time > now ? queue[first].time : now;
    *byte = queue[first].byte;
    ++first;
    return true;
}
static fieldscribe_modbus_status ask_again(const fieldscribe_modbus_line *line,
    const fieldscribe_modbus_request *request, fieldscribe_modbus_reply *reply)
{
    fieldscribe_modbus_request again = *request;
    fieldscribe_modbus_status status = fieldscribe_modbus_ask_rtu(line, request, reply);
    delay = 5U;
    if (status == FIELDSCRIBE_MODBUS_SHORT_FRAME) {
        again.late = true;
        status = fieldscribe_modbus_ask_rtu(line, &again, reply);
    }
    return status;
}
static bool reads(fieldscribe_modbus_unit *unit, uint16_t address)
{
    uint16_t word = 0U;
    return fieldscribe_modbus_read_word(unit, 3U, address, &word) == FIELDSCRIBE_MODBUS_OK && word == address;
}
int main(void)
{
    static const fieldscribe_modbus_profile profile = {1U, 9U, true, true, false, 0U, 0U, {0U, 0U, 0U, 9U}};
    static uint8_t buffer[FIELDSCRIBE_MODBUS_TCP_MOST];
    static const fieldscribe_modbus_line line = {&profile, buffer, sizeof buffer, &send, &receive, NULL, 50U, 10U};
    fieldscribe_modbus_unit unit = {&line, &fieldscribe_modbus_ask_rtu, 1U, 0U, 0U, false};
    fieldscribe_modbus_unit patient = {&line, &ask_again, 1U, 0U, 0U, false};
    fieldscribe_modbus_unit dead = {&line, &fieldscribe_modbus_ask_rtu, 2U, 0U, 0U, false};
    fieldscribe_modbus_unit tcp = {&line, &fieldscribe_modbus_ask_tcp, 2U, 0U, 0U, true};
    uint16_t round;
    delay = 60U;
    CHECK(!reads(&unit, 300U) && unit.late);
    delay = 5U;
    for (round = 0U; round < 3U; ++round) {
        CHECK(reads(&unit, 600U) && reads(&unit, 300U) && !unit.late);
    }
    delay = 60U;
    for (round = 0U; round < 3U; ++round) {
        CHECK(reads(&patient, 300U) && reads(&patient, 600U));
    }
    now = 1000U;
    CHECK(!reads(&dead, 300U) && now == 1050U);
    CHECK(reads(&unit, 600U) && now == 1061U); /* a unit that is off costs another one nothing */
    CHECK(!reads(&dead, 300U) && now == 1161U && dead.late);
    CHECK(!reads(&tcp, 300U) && now == 1211U); /* there, transactions tell late answers */
    received = 0U;
    babbles = true;
    CHECK(!reads(&dead, 300U) && received > FIELDSCRIBE_MODBUS_ASK_MOST && received <= 2U * FIELDSCRIBE_MODBUS_ASK_MOST);
    return 0;
}
