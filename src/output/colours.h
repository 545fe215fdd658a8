/* The colours of single spans, coded together: many at a time cost a fraction of one by one. */
#ifndef CS_OUTPUT_COLOURS_H
#define CS_OUTPUT_COLOURS_H

#include <string.h>

#include "celspan/celspan.h"

enum { CS_COLOURS_MOST = 512 };

typedef struct cs_colours {
  float rgba[4 * CS_COLOURS_MOST];
  unsigned char coded[8 * CS_COLOURS_MOST];
} cs_colours;

/* Codes the colour of each span, at most CS_COLOURS_MOST; what becomes of spans that are not single
 * means nothing. coding: resolved, not float. */
void cs_colours_code(cs_colours *colours, const celspan_coding *coding, const celspan_span *spans,
                     size_t count);

/* Of span i, as bytes of memory, the first lowest. pixel_size: 4 or 8. */
static inline uint64_t cs_colours_pixel(const cs_colours *colours, size_t pixel_size, size_t i) {
  uint64_t eight;
  uint32_t four;
  if (pixel_size == 8)
    return memcpy(&eight, colours->coded + 8 * i, sizeof eight), eight;
  return memcpy(&four, colours->coded + 4 * i, sizeof four), four;
}

#endif
