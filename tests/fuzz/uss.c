/* Answers of USS drives through the parser in C, with the tasks of kitchen_uss. */
#define FIELDSCRIBE_IMPLEMENTATION
#include "cases.h"
#include "kitchen_uss_uss.h"

static const char *const names[] = {"ok", "out_of_range", "not_a_number", "unknown_value", "zero_factor", "no_case",
    "overflow", "special", "malformed", "bad_link", "bad_unit", "bad_task", "bad_parameter", "bad_index", "bad_value",
    "buffer_too_small", "wrong_start", "wrong_length", "wrong_check", "wrong_unit", "wrong_parameter", "no_answer",
    "refused", "no_rights", "wrong_response"};

/* Whether process data come with an answer of that status. */
static bool brings_words(fieldscribe_uss_status status)
{
    return status == FIELDSCRIBE_USS_OK || status >= FIELDSCRIBE_USS_WRONG_PARAMETER;
}

int main(void)
{
    for (;;) {
        fieldscribe_uss_link link;
        fieldscribe_uss_request request = {0U, 0U, 0U, 0U, 0U, 0U};
        fieldscribe_uss_reply reply;
        fieldscribe_uss_status status;
        uint16_t *words;
        uint8_t *frame;
        size_t length;
        uint8_t at;
        link.pkw = (uint8_t)take(1U);
        link.pzd = (uint8_t)take(1U);
        link.single_first = take(1U) != 0U;
        request.unit = (uint8_t)take(1U);
        request.task = (uint8_t)take(1U);
        request.parameter = (uint16_t)take(2U);
        request.index = (uint16_t)take(2U);
        length = take(2U);
        frame = exactly(length);
        take_bytes(frame, length);
        words = exactly(2U * (size_t)link.pzd);
        reply.process = words;
        reply.room = link.pzd;
        status = fieldscribe_uss_parse(&kitchen_uss_uss_profile, &link, &request, frame, length, &reply);
        printf("%s %u %u %u %u", names[status], reply.response, reply.width, (unsigned)reply.value, reply.error);
        for (at = 0U; brings_words(status) && at < link.pzd; ++at) {
            printf(" %u", words[at]);
        }
        printf("\n");
        free(words);
        free(frame);
    }
}
