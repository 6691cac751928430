#define FIELDSCRIBE_NO_FLOAT
#define FIELDSCRIBE_IMPLEMENTATION
#include "kitchen_uss_uss.h"
volatile int64_t wanted;
volatile uint32_t reference;
volatile int64_t shown;
volatile int32_t result;
uint8_t frame[FIELDSCRIBE_USS_MOST];
void start(void);
void start(void)
{
    const fieldscribe_uss_link link = {FIELDSCRIBE_USS_VARIABLE, 2U, false};
    const fieldscribe_uss_request request = fieldscribe_uss_read(1U, &kitchen_uss_maximum_frequency_frame.read);
    uint16_t words[KITCHEN_USS_TELEGRAM_TASK_WORDS] = {0U};
    const fieldscribe_uss_words process = {words, 2U};
    fieldscribe_uss_reply reply = {words, 2U, 0U, 0U, 0U, 0U};
    size_t length = 0U;
    int16_t raw = 0;
    int64_t count = 0;
    const kitchen_uss_with_normalisation_and_reference_frequency with = {0U, reference};
    result = (int32_t)kitchen_uss_main_setpoint_encode_count(wanted, &with, &raw);
    result += (int32_t)fieldscribe_put_s16(kitchen_uss_main_setpoint_frame.layout, raw,
        fieldscribe_uss_words_sent(&kitchen_uss_main_setpoint_frame.sent, words, 2U),
        kitchen_uss_main_setpoint_frame.sent.words);
    result += (int32_t)fieldscribe_uss_build(
        &kitchen_uss_uss_profile, &link, &request, &process, frame, sizeof frame, &length);
    result += (int32_t)fieldscribe_uss_parse(
        &kitchen_uss_uss_profile, &link, &request, frame, length, &reply);
    result += (int32_t)fieldscribe_take_s16(kitchen_uss_main_actual_value_frame.layout,
        fieldscribe_uss_words_heard(&kitchen_uss_main_actual_value_frame.heard, words, 2U),
        kitchen_uss_main_actual_value_frame.heard.words, &raw);
    result += (int32_t)kitchen_uss_main_actual_value_decode_count(raw, &with, &count);
    shown = count;
    for (;;) {
    }
}
