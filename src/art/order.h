/* The order of characters through FriBidi, and where lines may end through libunibreak: see the
 * table in artwork/type.h. */
#ifndef CS_ART_ORDER_H
#define CS_ART_ORDER_H

#include "artwork/type.h"

celspan_status cs_order_embeddings(const uint32_t *characters, size_t count,
                                   celspan_direction direction, uint8_t *embeddings, uint8_t *base);
celspan_status cs_order_end_line(const uint32_t *characters, size_t begin, size_t end, uint8_t base,
                                 uint8_t *embeddings);
celspan_status cs_order_breaks(const uint32_t *characters, size_t count, const char *language,
                               uint8_t *breaks);

#endif
