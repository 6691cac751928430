/* What proofs of Modbus parsers share. */
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

#endif
