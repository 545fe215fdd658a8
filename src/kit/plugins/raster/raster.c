#include "plugins/raster/raster.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

celspan_status cs_raster_fail(cs_picture_failure *failure, celspan_status status,
                              const char *format, ...) {
  va_list words;
  va_start(words, format);
  failure->status = status;
  vsnprintf(failure->text, sizeof failure->text, format, words);
  va_end(words);
  return status;
}

size_t cs_raster_row(const cs_raster *raster) {
  return (size_t)raster->width * (size_t)raster->channels * (size_t)(raster->bits / 8);
}

celspan_status cs_raster_make(cs_raster *raster, uint64_t width, uint64_t height,
                              cs_picture_failure *failure) {
  if (width < 1 || height < 1)
    return cs_raster_fail(failure, CELSPAN_INPUT, "is a picture without pixels");
  if (width > CS_PICTURE_SIDE || height > CS_PICTURE_SIDE || width * height > CS_RASTER_PIXELS)
    return cs_raster_fail(failure, CELSPAN_LIMIT,
                          "is %llu x %llu pixels; at most 1048576 a side and 268435456 in all are "
                          "read without OpenImageIO",
                          (unsigned long long)width, (unsigned long long)height);
  raster->width = (int32_t)width;
  raster->height = (int32_t)height;
  raster->pixels = calloc((size_t)height, cs_raster_row(raster));
  return raster->pixels ? CELSPAN_OK : cs_raster_fail(failure, CELSPAN_NO_MEMORY, "out of memory");
}

void cs_raster_finish(cs_raster *raster) {
  free(raster->pixels);
  free(raster->parts);
  *raster = (cs_raster){.pixels = NULL};
}
