/* What proofs of Modbus share. */
#ifndef MODBUS_ITEMS_H
#define MODBUS_ITEMS_H

/* The most bytes of data that an answer announces, and those behind a head. */
#define DATA_MOST 255U
#define BEHIND(head, length) (((length) > (head)) ? ((length) - (head)) : 0U)

/*
 * A call that parses the answer to `request`, by whether its items are bits and fit into so many bytes of data, so that
 * Frama-C knows that items are taken only if they fit.
 */
#define BY_ITEMS(bytes, call) \
    if (request.function <= 0x02U) { \
        if (request.count > 8U * (bytes)) { \
            (void)(call); \
        } else { \
            (void)(call); \
        } \
    } else if (request.count > (bytes) / 2U) { \
        (void)(call); \
    } else { \
        (void)(call); \
    }

static volatile uint16_t any_word;

/* A unit of which any request brings any words and any status. */
static fieldscribe_modbus_status bring_anything(const fieldscribe_modbus_line *line,
    const fieldscribe_modbus_request *request, fieldscribe_modbus_reply *reply)
{
    size_t at;
    (void)line;
    (void)request;
    for (at = 0U; (reply->values != NULL) && (at < reply->room); ++at) {
        reply->values[at] = any_word;
    }
    reply->exception = (uint8_t)(any_word & 0xFFU);
    return (fieldscribe_modbus_status)(any_word % ((uint16_t)FIELDSCRIBE_MODBUS_NOISE + 1U));
}

#endif
