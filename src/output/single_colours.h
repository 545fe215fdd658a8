/* The coded colours of single spans. Most spans of a drawn frame have one colour and few pixels;
 * coded together, their colours cost a fraction of what they cost one by one.
 *
 * INVARIANT: entry i belongs to span i of the last call; that of a span which is not single has no
 * meaning.
 */
#ifndef CS_OUTPUT_SINGLE_COLOURS_H
#define CS_OUTPUT_SINGLE_COLOURS_H

#include <string.h>

#include "celspan/celspan.h"

enum { CS_SINGLE_COLOURS_MOST = 512 };

typedef struct cs_single_colours {
  float rgba[4 * CS_SINGLE_COLOURS_MOST];
  unsigned char coded[8 * CS_SINGLE_COLOURS_MOST];
} cs_single_colours;

/* count: at most CS_SINGLE_COLOURS_MOST. coding: resolved, not float. */
void cs_single_colours_code(cs_single_colours *colours, const celspan_coding *coding,
                            const celspan_span *spans, size_t count);

/* The coded pixel of span i, its first byte lowest. pixel_size: 4 or 8. */
static inline uint64_t cs_single_colours_pixel(const cs_single_colours *colours, size_t pixel_size,
                                               size_t i) {
  uint64_t eight;
  uint32_t four;
  if (pixel_size == 8)
    return memcpy(&eight, colours->coded + 8 * i, sizeof eight), eight;
  return memcpy(&four, colours->coded + 4 * i, sizeof four), four;
}

#endif
