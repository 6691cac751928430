#define WIDTH(what) width = (what).width
#define REFUSED FIELDSCRIBE_USS_REFUSED
#define ERROR error
#define IS(what) (last.unit == 3U && last.task == (what).task && last.parameter == (what).parameter && \
    last.index == (what).index)
static const fieldscribe_uss_link link = {4U, 2U, false};
static const fieldscribe_uss_line line = {&DEVICE_uss_profile, &link, NULL, 0U, NULL, NULL, NULL, 0U, 0U};
static const uint16_t sent[2] = {0x047EU, 0U};
static uint16_t heard[2];
static fieldscribe_uss_request last;
static uint8_t width; /* of the value with which a read is answered */
static fieldscribe_uss_status ask(const fieldscribe_uss_line *on, const fieldscribe_uss_request *request,
    const fieldscribe_uss_words *process, fieldscribe_uss_reply *reply)
{
    last = *request;
    if (on != &line || process->words != sent || process->count != 2U || reply->process != heard || reply->room != 2U) {
        return FIELDSCRIBE_USS_NOISE;
    }
    if (refuses) {
        reply->error = 0x22U;
        return REFUSED;
    }
    if (request->width == 0U) {
        reply->width = width;
        reply->value = (width > 1U) ? ((uint32_t)held[0] << 16) | held[1] : held[0];
    } else {
        held[0] = (uint16_t)((request->width > 1U) ? request->value >> 16 : request->value);
        held[1] = (request->width > 1U) ? (uint16_t)(request->value & 0xFFFFU) : held[1];
        ++writes;
    }
    return FIELDSCRIBE_USS_OK;
}
