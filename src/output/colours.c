#include "output/colours.h"

#include "output/pixels.h"

enum { AT_ONCE = 4 }; /* that vector code takes; the rest would be coded one by one */

void cs_colours_code(cs_colours *colours, const celspan_coding *coding, const celspan_span *spans,
                     size_t count) {
  for (size_t i = 0; i < count; i++)
    memcpy(colours->rgba + 4 * i, spans[i].colour, sizeof spans[i].colour);
  size_t whole = (count + AT_ONCE - 1) / AT_ONCE * AT_ONCE; /* some are left from before */
  celspan_span all = {.x1 = (int32_t)whole, .kind = CELSPAN_SPAN_ARRAY, .array = colours->rgba};
  cs_pixels_row(coding, &all, 1, colours->coded);
}
