#include "output/single_colours.h"

#include "output/pixels.h"

/* Pixels that vector code handles together. The count is rounded up to a multiple, so that none is
 * coded one by one; the colours beyond it are left over from earlier calls. */
enum { AT_ONCE = 4 };

void cs_single_colours_code(cs_single_colours *colours, const celspan_coding *coding,
                            const celspan_span *spans, size_t count) {
  for (size_t i = 0; i < count; i++)
    memcpy(colours->rgba + 4 * i, spans[i].colour, sizeof spans[i].colour);
  size_t whole = (count + AT_ONCE - 1) / AT_ONCE * AT_ONCE;
  celspan_span all = {.x1 = (int32_t)whole, .kind = CELSPAN_SPAN_ARRAY, .array = colours->rgba};
  cs_pixels_row(coding, &all, 1, colours->coded);
}
