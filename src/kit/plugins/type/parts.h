/* Declarations that the files of the type module share: see the tables in readers/type/module.h and
 * readers/type/letters.h. */
#pragma once

#include "celspan/text.h"
#include "readers/type/module.h"

/* XML through expat. */
celspan_status cs_xml_parse_bytes(const char *bytes, size_t size, const cs_xml_handler *handler,
                                  cs_type_failure *failure);

/* The order of characters through FriBidi, and where lines may end through libunibreak. */
celspan_status cs_order_embeddings(const uint32_t *characters, size_t count,
                                   celspan_direction direction, uint8_t *embeddings, uint8_t *base);
celspan_status cs_order_end_line(const uint32_t *characters, size_t begin, size_t end, uint8_t base,
                                 uint8_t *embeddings);
celspan_status cs_order_breaks(const uint32_t *characters, size_t count, const char *language,
                               uint8_t *breaks);
