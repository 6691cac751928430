/*
 * Proofs of fieldscribe_modbus.h: one harness or more for each of its functions, named prove_FUNCTION or
 * prove_FUNCTION__WHAT. Where a function is given several arrays, each is exactly as long as it is told in one of the
 * harnesses. `split` has Frama-C follow each length on its own.
 */
#define FIELDSCRIBE_IMPLEMENTATION
#include "arbitrary.h"
#include "fieldscribe_modbus.h"
#include "modbus_items.h"

#define STEPS 6U    /* bytes that a receiver has got, or words of a point: each way through them is followed alone */
#define KNOWN 3U    /* places of a marker: each is looked at alone */
#define FRAMES 264U /* longer than the longest frame, of 260 bytes */
#ifndef SHORT
#define SHORT 32U   /* where build is followed with exact arrays; put_values for all counts of words */
#endif
#define ITEMS 256U  /* as many are followed exactly; more in arrays that may be longer than told */
#define WORDS 128U  /* more than a byte count can announce: 255 bytes are 127 words */

static uint8_t frame[FRAMES];
static uint8_t long_frame[LARGE];
static uint16_t items[ITEMS];
static uint16_t many_items[LARGE / 2U];
static fieldscribe_modbus_profile profile;
static fieldscribe_modbus_request request;
static fieldscribe_modbus_reply reply;
static fieldscribe_modbus_reading reading;
static fieldscribe_modbus_writing writing;
static fieldscribe_modbus_command command;
static fieldscribe_modbus_receiver receiver;
static fieldscribe_modbus_line line;
static volatile uint8_t number;

/* A profile that knows any functions. */
static void know(void)
{
    profile.pads_coil_bytes = number % 2U != 0U;
    profile.rtu = number % 2U != 0U;
    profile.tcp = number % 2U != 0U;
}

/* A request that reads, and one that writes. */
static void of_any_kind(void)
{
    request.writer = number % 2U != 0U ? &fieldscribe_modbus_writes : NULL;
}

/* A request of so many items, in an array that has no more. */
static void ask(uint16_t count)
{
    request.count = count;
    request.values = EXACTLY(count, items);
    of_any_kind();
}

/* A request of any number of items that fits into the memory of a small machine. */
static void ask_any(void)
{
    if (request.count > sizeof many_items / sizeof many_items[0]) {
        request.count = 0U;
    }
    request.values = many_items;
    of_any_kind();
}

/* A reply with room for so many items. */
static void into(uint16_t *values, size_t room)
{
    reply.values = values;
    reply.room = room;
}

void prove_read(uint8_t unit)
{
    request = fieldscribe_modbus_read(unit, &reading);
}

void prove_write(uint8_t unit)
{
    request = fieldscribe_modbus_write(unit, &writing, items, ITEMS);
    request = fieldscribe_modbus_write(unit, &writing, EXACTLY(1U, items), 1U);
    request = fieldscribe_modbus_write(unit, &writing, items, 0U);
    request = fieldscribe_modbus_write(unit, &writing, NULL, ITEMS);
}

void prove_send(uint8_t unit)
{
    request = fieldscribe_modbus_send(unit, &command);
}

void prove_crc(size_t length)
{
    if (length <= FRAMES) {
        //@ split length;
        NOT_BETWEEN(length, FRAMES);
        (void)fieldscribe_modbus_crc(EXACTLY(length, frame), length);
    }
}

void prove_crc__long(size_t length)
{
    if (length <= LARGE) {
        (void)fieldscribe_modbus_crc(long_frame, length);
    }
}

void prove_get(void)
{
    (void)fieldscribe_modbus_get(EXACTLY(2U, frame));
}

void prove_put(uint16_t number)
{
    fieldscribe_modbus_put(EXACTLY(2U, frame), number);
}

void prove_reads(uint8_t function)
{
    (void)fieldscribe_modbus_reads(function);
}

void prove_has_unit(void)
{
    if (request.function < FIELDSCRIBE_MODBUS_FUNCTIONS) { /* known by then */
        (void)fieldscribe_modbus_has_unit(&profile, &request);
    }
}

void prove_allows(void)
{
    know();
    ask_any();
    (void)fieldscribe_modbus_allows(&profile, &request);
}

void prove_allows__no_values(void)
{
    know();
    request.values = NULL;
    of_any_kind();
    if (request.function < 0x05U) {
        (void)fieldscribe_modbus_allows(&profile, &request);
    } else {
        (void)fieldscribe_modbus_allows(&profile, &request);
    }
}

void prove_allows__values(uint16_t count)
{
    if (count <= ITEMS) {
        //@ split count;
        NOT_BETWEEN(count, ITEMS);
        know();
        ask(count);
        (void)fieldscribe_modbus_allows(&profile, &request);
    }
}

void prove_are_coils(uint16_t count)
{
    if (count <= ITEMS) {
        //@ split count;
        NOT_BETWEEN(count, ITEMS);
        ask(count);
        (void)fieldscribe_modbus_are_coils(&request);
    }
}

void prove_coils(uint16_t count, uint16_t byte)
{
    if (count <= ITEMS) {
        //@ split count;
        NOT_BETWEEN(count, ITEMS);
        ask(count);
        (void)fieldscribe_modbus_coils(&request, 8U * (uint32_t)byte);
    }
}

/* By kind of function, so that Frama-C knows in each call what the frame consists of. */
static void build_into(fieldscribe_modbus_framing framing, uint8_t *buffer, size_t size)
{
    size_t length;
    if (request.function == 0x00U) {
        (void)fieldscribe_modbus_build(&profile, framing, &request, buffer, size, &length);
    } else if (request.function < 0x05U) {
        (void)fieldscribe_modbus_build(&profile, framing, &request, buffer, size, &length);
    } else if (request.function < 0x0FU) {
        (void)fieldscribe_modbus_build(&profile, framing, &request, buffer, size, &length);
    } else if (request.function == 0x0FU) {
        (void)fieldscribe_modbus_build(&profile, framing, &request, buffer, size, &length);
    } else if (request.function == 0x10U) {
        (void)fieldscribe_modbus_build(&profile, framing, &request, buffer, size, &length);
    } else {
        (void)fieldscribe_modbus_build(&profile, framing, &request, buffer, size, &length);
    }
}

/* By kind of function, so that Frama-C knows in each call what the frame consists of. */
static void put_by_function(fieldscribe_modbus_status (*put)(const fieldscribe_modbus_profile *,
    const fieldscribe_modbus_request *, uint8_t *, size_t *), size_t size)
{
    size_t used = size;
    if (request.function < 0x0FU) {
        (void)put(&profile, &request, EXACTLY(size, frame), &used);
    } else if (request.function == 0x0FU) {
        (void)put(&profile, &request, EXACTLY(size, frame), &used);
    } else if (request.function == 0x10U) {
        (void)put(&profile, &request, EXACTLY(size, frame), &used);
    } else {
        (void)put(&profile, &request, EXACTLY(size, frame), &used);
    }
}

void prove_put_coils(size_t size)
{
    if (size <= SHORT) {
        //@ split size;
        know();
        ask_any();
        put_by_function(&fieldscribe_modbus_put_coils, size);
    }
}

void prove_put_values(size_t size)
{
    if (size <= SHORT) {
        //@ split size;
        know();
        ask_any();
        put_by_function(&fieldscribe_modbus_put_values, size);
    }
}

/* Any count of words, in a frame that is long enough for all that a byte count announces. */
void prove_put_values__words(uint16_t count)
{
    size_t used = FRAMES;
    if (count <= WORDS) {
        //@ split count;
        NOT_BETWEEN(count, WORDS);
        ask(count);
        request.function = 0x10U;
        (void)fieldscribe_modbus_put_values(&profile, &request, frame, &used);
    }
}

void prove_put_values__no_values(size_t size)
{
    if (size <= SHORT) {
        know();
        request.values = NULL;
        put_by_function(&fieldscribe_modbus_put_coils, size);
        put_by_function(&fieldscribe_modbus_put_values, size);
    }
}

void prove_put_request(size_t size)
{
    if (size >= 6U && size <= SHORT) {
        //@ split size;
        know();
        ask_any();
        put_by_function(&fieldscribe_modbus_put_request, size);
    }
}

void prove_build_rtu(size_t size)
{
    if (size <= SHORT) {
        //@ split size;
        know();
        ask_any();
        build_into(FIELDSCRIBE_MODBUS_RTU, EXACTLY(size, frame), size);
    }
}

static void build_pdu_into(uint8_t *buffer, size_t size)
{
    size_t length;
    if (request.function < 0x0FU) {
        (void)fieldscribe_modbus_build_pdu(&profile, &request, buffer, size, &length);
    } else if (request.function == 0x0FU) {
        (void)fieldscribe_modbus_build_pdu(&profile, &request, buffer, size, &length);
    } else if (request.function == 0x10U) {
        (void)fieldscribe_modbus_build_pdu(&profile, &request, buffer, size, &length);
    } else {
        (void)fieldscribe_modbus_build_pdu(&profile, &request, buffer, size, &length);
    }
}

void prove_build_pdu(size_t size)
{
    if (size <= SHORT) {
        //@ split size;
        know();
        ask_any();
        build_pdu_into(EXACTLY(size, frame), size);
    }
}

void prove_build_tcp(size_t size)
{
    if (size <= SHORT) {
        //@ split size;
        know();
        ask_any();
        build_into(FIELDSCRIBE_MODBUS_TCP, EXACTLY(size, frame), size);
    }
}

void prove_build__long_buffer(void)
{
    know();
    ask_any();
    build_into(FIELDSCRIBE_MODBUS_RTU, frame, FRAMES);
    build_into(FIELDSCRIBE_MODBUS_TCP, frame, FRAMES);
}

void prove_build__no_values(void)
{
    know();
    request.values = NULL;
    of_any_kind();
    build_into(FIELDSCRIBE_MODBUS_RTU, frame, FRAMES);
    build_into(FIELDSCRIBE_MODBUS_TCP, frame, FRAMES);
}

void prove_build__values(uint16_t count)
{
    if (count <= SHORT) {
        //@ split count;
        know();
        ask(count);
        build_into(FIELDSCRIBE_MODBUS_RTU, frame, FRAMES); /* what frames a request does not read them */
    }
}

void prove_take_answer__data(size_t size, size_t room)
{
    if (size >= 2U && size <= FRAMES) {
        //@ split size;
        NOT_BETWEEN(size, FRAMES);
        ask_any();
        into(many_items, room);
        BY_ITEMS(size - 2U, fieldscribe_modbus_take_answer(&request, EXACTLY(size, frame), size, &reply));
    }
}

void prove_take_answer__values(size_t size, size_t room)
{
    const size_t stored = room < ITEMS ? room : ITEMS;
    if (size >= 2U && size <= FRAMES) {
        //@ split stored;
        NOT_BETWEEN(stored, ITEMS);
        ask_any();
        into(EXACTLY(stored, items), stored);
        BY_ITEMS(FRAMES - 2U, fieldscribe_modbus_take_answer(&request, frame, size, &reply));
    }
}

void prove_take_echo(size_t size, size_t room)
{
    if (size >= 2U && size <= FRAMES) {
        //@ split size;
        NOT_BETWEEN(size, FRAMES);
        ask_any();
        into(many_items, room);
        (void)fieldscribe_modbus_take_echo(&request, EXACTLY(size, frame), size, &reply);
    }
}

void prove_take_echo__request(uint16_t count, size_t size)
{
    if (count <= WORDS && size >= 2U && size <= FRAMES) {
        //@ split count;
        NOT_BETWEEN(count, WORDS);
        ask(count);
        into(many_items, LARGE / 2U);
        (void)fieldscribe_modbus_take_echo(&request, frame, size, &reply);
    }
}

void prove_take_tcp(size_t size, size_t room)
{
    if (size >= 2U && size <= FRAMES) {
        //@ split size;
        NOT_BETWEEN(size, FRAMES);
        ask_any();
        into(many_items, room);
        BY_ITEMS(size - 2U, fieldscribe_modbus_take_tcp(&request, EXACTLY(size, frame), size, &reply));
    }
}

void prove_parse_rtu(size_t length, size_t room)
{
    if (length <= FRAMES) {
        //@ split length;
        NOT_BETWEEN(length, FRAMES);
        ask_any();
        into(many_items, room);
        BY_ITEMS(BEHIND(5U, length), fieldscribe_modbus_parse_rtu(&request, EXACTLY(length, frame), length, &reply));
    }
}

void prove_parse_pdu(size_t length, size_t room)
{
    if (length <= FRAMES) {
        //@ split length;
        NOT_BETWEEN(length, FRAMES);
        ask_any();
        into(many_items, room);
        BY_ITEMS(BEHIND(2U, length), fieldscribe_modbus_parse_pdu(&request, EXACTLY(length, frame), length, &reply));
    }
}

void prove_parse_tcp(size_t length, size_t room)
{
    if (length <= FRAMES) {
        //@ split length;
        NOT_BETWEEN(length, FRAMES);
        ask_any();
        into(many_items, room);
        BY_ITEMS(BEHIND(9U, length), fieldscribe_modbus_parse_tcp(&request, EXACTLY(length, frame), length, &reply));
    }
}

void prove_parse__no_values(size_t length, size_t room)
{
    if (length <= SHORT) {
        //@ split length;
        request.values = NULL; /* an answer is held against the request alone */
        of_any_kind();
        into(many_items, room);
        BY_ITEMS(BEHIND(5U, length), fieldscribe_modbus_parse(
            FIELDSCRIBE_MODBUS_RTU, &request, EXACTLY(length, frame), length, &reply));
        BY_ITEMS(BEHIND(9U, length), fieldscribe_modbus_parse(
            FIELDSCRIBE_MODBUS_TCP, &request, EXACTLY(length, frame), length, &reply));
    }
}

void prove_parse__long_frame(fieldscribe_modbus_framing framing, size_t length, size_t room)
{
    if (length <= LARGE) {
        ask_any();
        into(many_items, room);
        BY_ITEMS(DATA_MOST, fieldscribe_modbus_parse(framing, &request, long_frame, length, &reply));
    }
}

void prove_parse__values(fieldscribe_modbus_framing framing, size_t length, size_t room)
{
    const size_t stored = room < WORDS ? room : WORDS;
    if (length <= FRAMES) {
        //@ split stored;
        NOT_BETWEEN(stored, WORDS);
        ask_any();
        into(EXACTLY(stored, items), stored);
        BY_ITEMS(DATA_MOST, fieldscribe_modbus_parse(framing, &request, frame, length, &reply));
    }
}

/* Nothing is stored where there is nothing, whatever room is told. */
void prove_take_answer__no_room(size_t size, size_t room)
{
    if (size >= 2U && size <= FRAMES) {
        ask_any();
        into(NULL, room);
        (void)fieldscribe_modbus_take_answer(&request, frame, size, &reply);
        (void)fieldscribe_modbus_take_echo(&request, frame, size, &reply);
        (void)fieldscribe_modbus_words_in(&request, &reply, &reading);
    }
}

void prove_answer(void)
{
    (void)fieldscribe_modbus_answer(&request);
}

void prove_around(fieldscribe_modbus_framing framing)
{
    (void)fieldscribe_modbus_around(framing);
}

void prove_reply_length(fieldscribe_modbus_framing framing)
{
    (void)fieldscribe_modbus_reply_length(&profile, framing, &request);
}

void prove_left(size_t size, size_t length)
{
    if (length <= FRAMES) {
        //@ split length;
        NOT_BETWEEN(length, FRAMES);
        (void)fieldscribe_modbus_left(&profile, FIELDSCRIBE_MODBUS_RTU, &request, EXACTLY(length, frame), size, length);
        (void)fieldscribe_modbus_left(&profile, FIELDSCRIBE_MODBUS_TCP, &request, EXACTLY(length, frame), size, length);
    }
}

void prove_left__long_frame(size_t size, size_t length)
{
    if (length <= LARGE) {
        (void)fieldscribe_modbus_left(&profile, FIELDSCRIBE_MODBUS_RTU, &request, long_frame, size, length);
        (void)fieldscribe_modbus_left(&profile, FIELDSCRIBE_MODBUS_TCP, &request, long_frame, size, length);
    }
}

/* What is found is read to its end: all of it was brought. */
void prove_words_in(uint16_t count)
{
    if (count <= SHORT && reading.count <= SHORT) {
        const uint16_t *found;
        //@ split count;
        //@ split reading.count;
        into(EXACTLY(count, items), count);
        reply.count = count;
        found = fieldscribe_modbus_words_in(&request, &reply, &reading);
        if (found != NULL && reading.count > 0U) {
            (void)found[0];
            (void)found[reading.count - 1U];
        }
    }
}

void prove_await(size_t size)
{
    ask_any();
    receiver = fieldscribe_modbus_await(&profile, FIELDSCRIBE_MODBUS_RTU, &request, frame, size);
    receiver = fieldscribe_modbus_await(&profile, FIELDSCRIBE_MODBUS_TCP, &request, frame, size);
}

void prove_await_rtu(size_t size)
{
    receiver = fieldscribe_modbus_await_rtu(&profile, &request, frame, size);
}

void prove_await_tcp(size_t size)
{
    receiver = fieldscribe_modbus_await_tcp(&profile, &request, frame, size);
}

void prove_rtu_receiver(size_t size)
{
    receiver = fieldscribe_modbus_rtu_receiver(&request, frame, size);
}

void prove_tcp_receiver(size_t size)
{
    receiver = fieldscribe_modbus_tcp_receiver(&request, frame, size);
}

void prove_pdu(uint8_t function, uint8_t code, uint8_t count)
{
    (void)fieldscribe_modbus_pdu(function, code, count);
}

/* A receiver of any kind, which so many bytes have come to. */
static void has(uint8_t *buffer, size_t size, size_t length)
{
    receiver.buffer = buffer;
    receiver.size = size;
    receiver.length = length;
    receiver.done = number % 2U != 0U;
    receiver.begun = number % 2U != 0U ? &fieldscribe_modbus_begun_tcp : &fieldscribe_modbus_begun_rtu;
}

void prove_begun_rtu(size_t size, size_t length)
{
    if (length <= SHORT) {
        //@ split length;
        has(frame, size, length);
        (void)fieldscribe_modbus_begun_rtu(&receiver, EXACTLY(length, frame), length);
    }
}

void prove_begun_tcp(size_t size, size_t length)
{
    if (length <= SHORT) {
        //@ split length;
        has(frame, size, length);
        (void)fieldscribe_modbus_begun_tcp(&receiver, EXACTLY(length, frame), length);
    }
}

void prove_settle(size_t size, size_t length)
{
    if (length <= STEPS) {
        //@ split length;
        has(EXACTLY(length, frame), size, length);
        fieldscribe_modbus_settle(&receiver, number % 2U != 0U);
    }
}

void prove_silent(size_t size, size_t length)
{
    if (length <= STEPS) {
        //@ split length;
        has(EXACTLY(length, frame), size, length);
        fieldscribe_modbus_silent(&receiver);
    }
}

/* A byte for a receiver with any bytes, then another one. */
void prove_receive(size_t size, size_t length, size_t count)
{
    if (size <= STEPS && length <= STEPS && count <= 1U) {
        //@ split size;
        //@ split length;
        //@ split count;
        has(EXACTLY(size, frame), size, length);
        (void)fieldscribe_modbus_receive(&receiver, EXACTLY(count, long_frame), count);
        //@ split receiver.length;
        (void)fieldscribe_modbus_receive(&receiver, EXACTLY(1U, long_frame), 1U);
    }
}

/* A line that stays silent; what a receiver makes of bytes is followed above. */
static void send_nothing(void *context, const uint8_t *bytes, size_t length)
{
    (void)context;
    (void)bytes;
    (void)length;
}

static bool receive_nothing(void *context, uint32_t milliseconds, uint8_t *byte)
{
    (void)context;
    (void)milliseconds;
    *byte = number;
    return false;
}

static void link(uint8_t *buffer, size_t size)
{
    line.profile = &profile;
    line.buffer = buffer;
    line.size = size;
    line.send = &send_nothing;
    line.receive = &receive_nothing;
    line.context = NULL;
    know();
    ask_any();
    request.writer = NULL;
    request.late = number % 2U != 0U;
}

void prove_listen(size_t size)
{
    if (size >= 5U && size <= SHORT) {
        //@ split size;
        link(EXACTLY(size, frame), size);
        receiver = fieldscribe_modbus_rtu_receiver(&request, line.buffer, size);
        fieldscribe_modbus_listen(&line, &receiver);
    }
}

void prove_exchange(size_t size, size_t room)
{
    if (size <= SHORT) {
        //@ split size;
        link(EXACTLY(size, frame), size);
        into(items, room);
        receiver = fieldscribe_modbus_rtu_receiver(&request, line.buffer, size);
        (void)fieldscribe_modbus_exchange(&line, &request, &reply, 3U, size, &receiver);
    }
}

void prove_ask_rtu(size_t size)
{
    if (size <= SHORT) {
        //@ split size;
        link(EXACTLY(size, frame), size);
        into(items, ITEMS);
        (void)fieldscribe_modbus_ask_rtu(&line, &request, &reply);
    }
}

void prove_ask_tcp(size_t size)
{
    if (size <= SHORT) {
        //@ split size;
        link(EXACTLY(size, frame), size);
        into(items, ITEMS);
        (void)fieldscribe_modbus_ask_tcp(&line, &request, &reply);
    }
}

static fieldscribe_modbus_unit unit;

/* A unit on that line, over which any words may be read and written. */
static void on_line(void)
{
    link(frame, FRAMES);
    unit.line = &line;
    unit.ask = &fieldscribe_modbus_ask_rtu;
    unit.late = number % 2U != 0U;
}

void prove_call(size_t count)
{
    if (count <= SHORT) {
        //@ split count;
        on_line();
        (void)fieldscribe_modbus_call(&unit, &request, EXACTLY(count, items), count);
    }
}

void prove_read_words(size_t count)
{
    if (count <= SHORT) {
        //@ split count;
        on_line();
        (void)fieldscribe_modbus_read_words(&unit, &reading, EXACTLY(count, items), count);
    }
}

void prove_write_words(size_t count)
{
    if (count <= SHORT) {
        //@ split count;
        on_line();
        writing.count = (uint16_t)count;
        (void)fieldscribe_modbus_write_words(&unit, &writing, EXACTLY(count, items), count);
    }
}

void prove_read_word(uint8_t function, uint16_t address)
{
    on_line();
    (void)fieldscribe_modbus_read_word(&unit, function, address, EXACTLY(1U, items));
}

void prove_write_word(uint8_t function, uint16_t address, uint16_t word)
{
    on_line();
    (void)fieldscribe_modbus_write_word(&unit, function, address, word);
}

#define ROWS 3U /* of a selection: each count is followed alone */

static fieldscribe_modbus_selection wanted_rows[ROWS];
static fieldscribe_modbus_selection other_rows[ROWS];
static fieldscribe_modbus_selected selected;

/* So many rows: behind the last nothing is looked at. */
static const fieldscribe_modbus_selection *rows_of(fieldscribe_modbus_selection *rows, size_t count)
{
    size_t at;
    //@ loop unroll ROWS;
    for (at = 0U; at < ROWS; ++at) {
        rows[at].last = number % 2U != 0U || at + 1U == ROWS;
    }
    return count == 0U ? NULL : &rows[ROWS - count];
}

/* A unit that brings anything, of which some rows stand, perhaps. */
static void select_before(size_t standing)
{
    on_line();
    unit.ask = &bring_anything;
    selected.rows = rows_of(other_rows, standing);
}

void prove_stands(size_t standing)
{
    if (standing <= ROWS) {
        //@ split standing;
        (void)fieldscribe_modbus_stands(rows_of(other_rows, standing), rows_of(wanted_rows, 1U));
    }
}

void prove_write_selection(void)
{
    select_before(0U);
    (void)fieldscribe_modbus_write_selection(&unit, rows_of(wanted_rows, 1U));
}

void prove_selects(size_t count, unsigned status)
{
    if (count <= ROWS) {
        //@ split count;
        select_before(ROWS);
        (void)fieldscribe_modbus_selects(
            &unit, &selected, rows_of(wanted_rows, count), (fieldscribe_modbus_status)status);
    }
}

void prove_select(size_t count, size_t standing)
{
    if (count <= ROWS && standing <= ROWS) {
        //@ split count;
        //@ split standing;
        select_before(standing);
        (void)fieldscribe_modbus_select(&unit, &selected, rows_of(wanted_rows, count));
    }
}

void prove_read_selected(size_t count, size_t words)
{
    if (count <= ROWS && words <= STEPS) {
        //@ split count;
        //@ split words;
        select_before(1U);
        reading.count = (uint16_t)words;
        (void)fieldscribe_modbus_read_selected(
            &unit, &selected, rows_of(wanted_rows, count), &reading, EXACTLY(words, items));
    }
}

void prove_write_selected(size_t count, size_t words)
{
    if (count <= ROWS && words <= STEPS) {
        //@ split count;
        //@ split words;
        select_before(1U);
        writing.count = (uint16_t)words;
        (void)fieldscribe_modbus_write_selected(
            &unit, &selected, rows_of(wanted_rows, count), &writing, EXACTLY(words, items));
    }
}

static fieldscribe_modbus_base base;
static fieldscribe_modbus_chain chain;

void prove_is_within(uint16_t address, uint16_t count)
{
    (void)fieldscribe_modbus_is_within(base, address, count);
}

void prove_reading_at(void)
{
    reading = fieldscribe_modbus_reading_at(base, &reading);
}

void prove_writing_at(void)
{
    writing = fieldscribe_modbus_writing_at(base, &writing);
}

/* A marker of so many words, at one of three places. */
static void chained(uint16_t words)
{
    on_line();
    chain.marker = EXACTLY(words, items);
    chain.marker_words = words;
    chain.places = EXACTLY(KNOWN, many_items);
    chain.place_count = KNOWN;
}

void prove_is_marked(uint16_t words, uint16_t place)
{
    if (words <= FIELDSCRIBE_MODBUS_MARKER_MOST + 1U) {
        //@ split words;
        fieldscribe_modbus_status status;
        chained(words);
        (void)fieldscribe_modbus_is_marked(&unit, &chain, place, &status);
    }
}

void prove_find(uint16_t block)
{
    chained(2U);
    (void)fieldscribe_modbus_find(&unit, &chain, block, &base);
}

void prove_converted(fieldscribe_status status)
{
    (void)fieldscribe_modbus_converted(status);
}

static fieldscribe_layout layout;
static fieldscribe_modbus_row row;

/* Any row for that unit: a number of up to 32 bits in one or two words, on a line with counts of up to 32 bits. */
static void of_row(void)
{
    static const fieldscribe_modbus_profile other = {0U, 0U, false, false, false, 0U, 0U, {0U}};
    on_line();
    layout.shares = number % 2U != 0U;
    layout.words = number % 2U != 0U ? 2U : 1U;
    layout.order = layout.words == 1U ? 0x00U : number % 2U != 0U ? 0x01U : 0x10U;
    layout.shift = (uint8_t)(layout.shift & 0xFU);
    row.layout = &layout;
    row.profile = number % 2U != 0U ? line.profile : &other;
    row.read = number % 2U != 0U ? &reading : NULL;
    row.write = number % 2U != 0U ? &writing : NULL;
    row.factor = row.factor > 0 ? row.factor : 1;
    row.divisor = row.divisor > 0 ? row.divisor : 1;
    row.low = row.low >= INT32_MIN ? row.low : INT32_MIN;
    row.high = row.high <= INT32_MAX ? row.high : INT32_MAX;
}

void prove_is_signed(void)
{
    (void)fieldscribe_modbus_is_signed(&layout);
}

void prove_read_row(void)
{
    int64_t got;
    of_row();
    (void)fieldscribe_modbus_read_row(&unit, &row, &got);
}

void prove_in_order(void)
{
    fieldscribe_modbus_in_order(&layout, EXACTLY(2U, items));
}

void prove_put_raw(int64_t raw)
{
    of_row();
    (void)fieldscribe_modbus_put_raw(&layout, raw, EXACTLY(2U, items));
}

void prove_write_row(int64_t wanted)
{
    of_row();
    row.read = &reading; /* a point that shares its word is readable */
    writing.count = layout.words;
    (void)fieldscribe_modbus_write_row(&unit, &row, wanted);
}

/* Rows at any base; its words are as many as the layout has, or none. */
void prove_read_row_at(fieldscribe_modbus_base at)
{
    static fieldscribe_modbus_based_row based;
    int64_t got;
    of_row();
    based.row = row;
    (void)fieldscribe_modbus_read_row_at(&unit, &based, at, &got);
}

void prove_write_row_at(fieldscribe_modbus_base at, int64_t wanted)
{
    static fieldscribe_modbus_based_row based;
    of_row();
    row.read = &reading;
    writing.count = layout.words;
    based.row = row;
    (void)fieldscribe_modbus_write_row_at(&unit, &based, at, wanted);
}

void prove_status_name(unsigned status)
{
    (void)fieldscribe_modbus_status_name((fieldscribe_modbus_status)status);
}
