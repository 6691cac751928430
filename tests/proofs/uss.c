/*
 * Proofs of fieldscribe_uss.h: one harness or more for each of its functions, named prove_FUNCTION or
 * prove_FUNCTION__WHAT. Where a function is given several arrays, each is exactly as long as it is told in one of the
 * harnesses. `split` has Frama-C follow each length on its own.
 */
#define FIELDSCRIBE_IMPLEMENTATION
#include "arbitrary.h"
#include "fieldscribe_uss.h"

#define FRAMES 300U /* longer than the longest telegram */
#ifndef SHORT
#define SHORT 48U   /* where build is followed with exact arrays; assemble, which fills them, for all lengths */
#endif
#define WORDS 256U  /* more than a link can be set to */
#define STEPS 6U    /* bytes that a receiver has got: each way through them is followed alone */
#define KNOWN 3U    /* tasks and lengths that a profile knows: each is looked at alone */

static uint8_t frame[FRAMES];
static uint8_t long_frame[LARGE];
static uint16_t words[WORDS];
static uint16_t masks[4];
static uint8_t part[514];
static uint8_t lengths[KNOWN];
static fieldscribe_uss_task tasks[KNOWN];
static fieldscribe_uss_profile profile;
static fieldscribe_uss_link link;
static fieldscribe_uss_request request;
static fieldscribe_uss_reply reply;
static fieldscribe_uss_words process;
static fieldscribe_uss_reading reading;
static fieldscribe_uss_writing writing;
static fieldscribe_uss_heard heard;
static fieldscribe_uss_sent sent;
static fieldscribe_uss_receiver receiver;
static fieldscribe_uss_line line;
static volatile uint8_t number;

/* A profile of any tasks and lengths, so many of both, and no room for more. */
static void know(size_t count)
{
    profile.tasks = EXACTLY(count, tasks);
    profile.task_count = count;
    profile.pkw = EXACTLY(count, lengths);
    profile.pkw_count = count;
    link.single_first = number % 2U != 0U;
}

/* Process data to send: so many words. */
static void send(const uint16_t *those, size_t count)
{
    process.words = those;
    process.count = count;
}

/* A reply with room for so many words of process data. */
static void into(uint16_t *those, size_t room)
{
    reply.process = those;
    reply.room = room;
}

void prove_exchange(uint8_t unit)
{
    request = fieldscribe_uss_exchange(unit);
}

void prove_read(uint8_t unit)
{
    request = fieldscribe_uss_read(unit, &reading);
}

void prove_write(uint8_t unit, size_t count)
{
    if (count <= WORDS) {
        //@ split count;
        NOT_BETWEEN(count, WORDS);
        request = fieldscribe_uss_write(unit, &writing, EXACTLY(count, words), count);
        request = fieldscribe_uss_write(unit, &writing, NULL, count);
    }
}

void prove_words_of_reply(size_t count)
{
    if (count <= WORDS) {
        //@ split count;
        NOT_BETWEEN(count, WORDS);
        (void)fieldscribe_uss_words_of_reply(&reply, &reading, EXACTLY(count, words), count);
        (void)fieldscribe_uss_words_of_reply(&reply, &reading, NULL, count);
    }
}

/* What is found is read to its end. */
void prove_words_heard(size_t count)
{
    if (count <= SHORT && heard.words <= 4U) {
        const uint16_t *found;
        //@ split heard.words;
        //@ split count;
        found = fieldscribe_uss_words_heard(&heard, EXACTLY(count, words), count);
        if (found != NULL && heard.words > 0U) {
            (void)found[0];
            (void)found[heard.words - 1U];
        }
    }
}

void prove_words_sent(size_t count)
{
    if (count <= SHORT && sent.words <= 4U) {
        uint16_t *found;
        //@ split sent.words;
        //@ split count;
        found = fieldscribe_uss_words_sent(&sent, EXACTLY(count, words), count);
        if (found != NULL && sent.words > 0U) {
            found[0] = 0U;
            found[sent.words - 1U] = 0U;
        }
    }
}

void prove_reply_length(void)
{
    (void)fieldscribe_uss_reply_length(&link);
}

void prove_left(size_t size, size_t length)
{
    if (length <= FRAMES) {
        //@ split length;
        NOT_BETWEEN(length, FRAMES);
        (void)fieldscribe_uss_left(&link, EXACTLY(length, frame), size, length);
    }
}

void prove_await(size_t size)
{
    receiver = fieldscribe_uss_await(&link, &request, frame, size);
}

/* A receiver of any kind, which so many bytes have come to. */
static void has(uint8_t *buffer, size_t size, size_t length)
{
    receiver.buffer = buffer;
    receiver.size = size;
    receiver.length = length;
    receiver.done = number % 2U != 0U;
}

void prove_begun(size_t size, size_t length)
{
    if (length > 0U && length <= FRAMES) {
        //@ split length;
        NOT_BETWEEN(length, FRAMES);
        has(frame, size, length);
        (void)fieldscribe_uss_begun(&receiver, EXACTLY(length, frame), length);
    }
}

void prove_settle(size_t size, size_t length)
{
    if (length <= STEPS) {
        //@ split length;
        has(EXACTLY(length, frame), size, length);
        fieldscribe_uss_settle(&receiver, number % 2U != 0U);
    }
}

void prove_silent(size_t size, size_t length)
{
    if (length <= STEPS) {
        //@ split length;
        has(EXACTLY(length, frame), size, length);
        fieldscribe_uss_silent(&receiver);
    }
}

void prove_clear(void)
{
    fieldscribe_uss_clear(&reply);
}

void prove_room(size_t room)
{
    into(number % 2U != 0U ? NULL : words, room);
    (void)fieldscribe_uss_room(&reply);
}

void prove_receive(size_t size, size_t length, size_t count)
{
    if (size <= STEPS && length <= STEPS && count <= 2U) {
        //@ split size;
        //@ split length;
        //@ split count;
        has(EXACTLY(size, frame), size, length);
        (void)fieldscribe_uss_receive(&receiver, EXACTLY(count, part), count);
    }
}

void prove_get(void)
{
    (void)fieldscribe_uss_get(EXACTLY(2U, frame));
}

void prove_put(uint16_t word)
{
    fieldscribe_uss_put(EXACTLY(2U, frame), word);
}

void prove_check(size_t length)
{
    if (length <= FRAMES) {
        //@ split length;
        NOT_BETWEEN(length, FRAMES);
        (void)fieldscribe_uss_check(EXACTLY(length, frame), length);
    }
}

void prove_check__long(size_t length)
{
    if (length <= LARGE) {
        (void)fieldscribe_uss_check(long_frame, length);
    }
}

void prove_find(size_t count, uint8_t task)
{
    if (count <= KNOWN) {
        //@ split count;
        know(count);
        (void)fieldscribe_uss_find(&profile, task);
    }
}

void prove_index_word(uint16_t parameter, uint16_t index)
{
    (void)fieldscribe_uss_index_word(parameter, index);
}

void prove_single_last(void)
{
    know(0U);
    (void)fieldscribe_uss_single_last(&link);
}

void prove_allows_pkw(size_t count, uint8_t pkw)
{
    if (count <= KNOWN) {
        //@ split count;
        know(count);
        (void)fieldscribe_uss_allows_pkw(&profile, pkw);
    }
}

void prove_count(size_t count)
{
    send(words, count);
    (void)fieldscribe_uss_count(&process);
    send(NULL, count);
    (void)fieldscribe_uss_count(&process);
}

void prove_allows_pzd(size_t count)
{
    (void)fieldscribe_uss_allows_pzd(&profile, &link, count);
}

void prove_allows(size_t count, size_t pzd_count)
{
    if (count <= KNOWN) {
        //@ split count;
        know(count);
        (void)fieldscribe_uss_allows(&profile, &link, &request, pzd_count);
    }
}

void prove_assemble__buffer(uint8_t address, size_t pzd_count, size_t size)
{
    if (pzd_count <= WORDS && size <= FRAMES) {
        size_t length;
        //@ split size;
        NOT_BETWEEN(size, FRAMES);
        send(words, pzd_count);
        (void)fieldscribe_uss_assemble(address, part, 0U, &process, EXACTLY(size, frame), size, &length);
        (void)fieldscribe_uss_assemble(address, part, 6U, &process, EXACTLY(size, frame), size, &length);
        (void)fieldscribe_uss_assemble(address, part, 8U, &process, EXACTLY(size, frame), size, &length);
    }
}

void prove_assemble__words(uint8_t address, size_t head_bytes, size_t pzd_count, size_t size)
{
    if ((head_bytes == 0U || head_bytes == 6U || head_bytes == 8U) && pzd_count <= WORDS && size <= FRAMES) {
        size_t length;
        //@ split pzd_count;
        NOT_BETWEEN(pzd_count, WORDS);
        //@ split head_bytes;
        send(EXACTLY(pzd_count, words), pzd_count);
        (void)fieldscribe_uss_assemble(address, EXACTLY(head_bytes, part), head_bytes, &process, frame, size, &length);
    }
}

void prove_build__buffer(size_t pzd_count, size_t size)
{
    if (pzd_count <= WORDS && size <= SHORT) {
        size_t length;
        //@ split size;
        know(KNOWN);
        send(words, pzd_count);
        if (link.pkw == 0U) {
            (void)fieldscribe_uss_build(&profile, &link, &request, &process, EXACTLY(size, frame), size, &length);
        } else if (link.pkw < 3U) {
            (void)fieldscribe_uss_build(&profile, &link, &request, &process, EXACTLY(size, frame), size, &length);
        } else if (link.pkw == 3U) {
            (void)fieldscribe_uss_build(&profile, &link, &request, &process, EXACTLY(size, frame), size, &length);
        } else {
            (void)fieldscribe_uss_build(&profile, &link, &request, &process, EXACTLY(size, frame), size, &length);
        }
    }
}

void prove_build__words(size_t pzd_count, size_t size)
{
    if (pzd_count <= SHORT && size <= FRAMES) {
        size_t length;
        //@ split pzd_count;
        know(KNOWN);
        send(EXACTLY(pzd_count, words), pzd_count);
        (void)fieldscribe_uss_build(
            &profile, &link, &request, &process, frame, size, &length);
    }
}

void prove_build_broadcast__buffer(size_t pzd_count, size_t size)
{
    if (pzd_count <= WORDS && size <= SHORT) {
        size_t length;
        //@ split size;
        know(KNOWN);
        send(words, pzd_count);
        (void)fieldscribe_uss_build_broadcast(
            &profile, &link, masks, &process, EXACTLY(size, frame), size, &length);
    }
}

void prove_build_broadcast__words(size_t pzd_count, size_t size)
{
    if (pzd_count <= SHORT && size <= FRAMES) {
        size_t length;
        //@ split pzd_count;
        know(KNOWN);
        send(EXACTLY(pzd_count, words), pzd_count);
        (void)fieldscribe_uss_build_broadcast(
            &profile, &link, masks, &process, frame, size, &length);
    }
}

/* Words that are not there are as many as the link has: none is read. */
void prove_build__no_words(size_t pzd_count)
{
    size_t length;
    know(KNOWN);
    send(NULL, pzd_count);
    (void)fieldscribe_uss_build(&profile, &link, &request, &process, frame, FRAMES, &length);
    (void)fieldscribe_uss_build_broadcast(&profile, &link, masks, &process, frame, FRAMES, &length);
}

void prove_fits(size_t count)
{
    (void)fieldscribe_uss_fits(&link, count);
}

void prove_take(size_t count)
{
    if (count <= sizeof part / 2U) {
        //@ split count;
        know(KNOWN);
        (void)fieldscribe_uss_take(&profile, &link, &request, EXACTLY(2U * count, part), count, &reply);
    }
}

void prove_parse__frame(size_t length, size_t room)
{
    if (length <= FRAMES) {
        //@ split length;
        NOT_BETWEEN(length, FRAMES);
        know(KNOWN);
        into(words, room);
        (void)fieldscribe_uss_parse(
            &profile, &link, &request, EXACTLY(length, frame), length, &reply);
    }
}

void prove_parse__long_frame(size_t length, size_t room)
{
    if (length <= LARGE) {
        know(KNOWN);
        into(words, room);
        (void)fieldscribe_uss_parse(&profile, &link, &request, long_frame, length, &reply);
    }
}

void prove_parse__no_words(size_t length, size_t room)
{
    if (length <= FRAMES) {
        //@ split length;
        NOT_BETWEEN(length, FRAMES);
        know(KNOWN);
        into(NULL, room);
        (void)fieldscribe_uss_parse(&profile, &link, &request, EXACTLY(length, frame), length, &reply);
    }
}

void prove_parse__words(size_t length, size_t room)
{
    const size_t stored = room < WORDS ? room : WORDS;
    if (length <= FRAMES) {
        //@ split stored;
        NOT_BETWEEN(stored, WORDS);
        know(KNOWN);
        into(EXACTLY(stored, words), stored);
        (void)fieldscribe_uss_parse(
            &profile, &link, &request, frame, length, &reply);
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

void prove_ask(size_t size, size_t pzd_count)
{
    if (size <= SHORT && pzd_count <= WORDS) {
        //@ split size;
        line.profile = &profile;
        line.link = &link;
        line.buffer = EXACTLY(size, frame);
        line.size = size;
        line.send = &send_nothing;
        line.receive = &receive_nothing;
        line.context = NULL;
        know(KNOWN);
        send(words, pzd_count);
        into(words, WORDS);
        if (link.pkw == 0U) {
            (void)fieldscribe_uss_ask(&line, &request, &process, &reply);
        } else if (link.pkw < 3U) {
            (void)fieldscribe_uss_ask(&line, &request, &process, &reply);
        } else if (link.pkw == 3U) {
            (void)fieldscribe_uss_ask(&line, &request, &process, &reply);
        } else {
            (void)fieldscribe_uss_ask(&line, &request, &process, &reply);
        }
    }
}

static fieldscribe_uss_unit unit;

/* What any exchange may bring; fieldscribe_uss_ask is proven above. */
static fieldscribe_uss_status ask_any(const fieldscribe_uss_line *on, const fieldscribe_uss_request *what,
    const fieldscribe_uss_words *with, fieldscribe_uss_reply *into_reply)
{
    (void)on;
    (void)what;
    (void)with;
    into_reply->width = number;
    into_reply->value = request.value;
    into_reply->error = reply.error;
    return (number % 2U != 0U) ? FIELDSCRIBE_USS_OK : FIELDSCRIBE_USS_REFUSED;
}

static void on_line(void)
{
    line.link = &link;
    unit.line = &line;
    unit.ask = &ask_any;
    unit.sent = words;
    unit.heard = words;
}

void prove_call(void)
{
    on_line();
    (void)fieldscribe_uss_call(&unit, &request, &reply);
}

void prove_exchange_words(void)
{
    on_line();
    (void)fieldscribe_uss_exchange_words(&unit);
}

void prove_read_words(size_t count)
{
    if (count <= 2U) {
        //@ split count;
        on_line();
        (void)fieldscribe_uss_read_words(&unit, &reading, EXACTLY(count, words), count);
    }
}

void prove_write_words(size_t count)
{
    if (count <= 2U) {
        //@ split count;
        on_line();
        (void)fieldscribe_uss_write_words(&unit, &writing, EXACTLY(count, words), count);
    }
}

void prove_converted(fieldscribe_status status)
{
    (void)fieldscribe_uss_converted(status);
}

void prove_status_name(unsigned status)
{
    (void)fieldscribe_uss_status_name((fieldscribe_uss_status)status);
}
