#define WIDTH(what) (void)0
#define REFUSED FIELDSCRIBE_MODBUS_EXCEPTION
#define ERROR exception
#define IS(what) (last.unit == 3U && last.function == (what).function && last.address == (what).address && \
    last.count == (what).count)
static fieldscribe_modbus_request last;
static fieldscribe_modbus_status ask(const fieldscribe_modbus_line *line, const fieldscribe_modbus_request *request,
    fieldscribe_modbus_reply *reply)
{
    size_t at;
    (void)line;
    last = *request;
    if (refuses) {
        reply->exception = 0x22U;
        return REFUSED;
    }
    for (at = 0U; at < request->count; ++at) {
        if (reply->values != NULL) {
            reply->values[at] = held[at];
        } else {
            held[at] = request->values[at];
        }
    }
    writes += (reply->values == NULL) ? 1U : 0U;
    return FIELDSCRIBE_MODBUS_OK;
}
