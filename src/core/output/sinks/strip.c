#include "output/sinks/strip.h"

cs_strip cs_strip_of(const celspan_file_desc *file) {
  return (cs_strip){file->strip_row, file->strip_height};
}

bool cs_strip_fits(cs_strip strip, int32_t height) {
  int64_t end = (int64_t)strip.row + height;
  return strip.row >= 0 && strip.row % CS_STRIP_ROWS == 0 && height > 0 && end <= strip.height &&
         (end % CS_STRIP_ROWS == 0 || end == strip.height);
}

celspan_status cs_strip_check(celspan_context *context, const char *path, cs_strip strip,
                              int32_t height) {
  if (strip.height == 0 || cs_strip_fits(strip, height))
    return CELSPAN_OK;
  return cs_fail(
      context, CELSPAN_BAD_ARGUMENT,
      "%s: rows %d to %lld are not a strip of a frame of %d rows: strips begin and end at "
      "multiples of %d rows, or at the end",
      path, (int)strip.row, (long long)strip.row + height - 1, (int)strip.height, CS_STRIP_ROWS);
}
