/* What the picture module of a page lacks: the other formats of plugins/raster, and writing. */
#include "plugins/raster/raster.h"
#include "plugins/raster/write.h"

static celspan_status lack(cs_picture_failure *failure, const char *what) {
  return cs_raster_fail(failure, CELSPAN_INPUT,
                        "%s by the celspan of web pages, which reads PNG and JPEG", what);
}

#define LACKS(name)                                                                                \
  celspan_status name(const cs_raster_file *file, cs_raster *out, cs_picture_failure *failure) {   \
    (void)file, (void)out;                                                                         \
    return lack(failure, "has a format that is not read");                                         \
  }
LACKS(cs_raster_webp)
LACKS(cs_raster_tiff)
LACKS(cs_raster_exr)

celspan_status cs_write_open(const cs_picture_output *output, cs_picture_writer **out,
                             cs_picture_failure *failure) {
  (void)output, (void)out;
  return lack(failure, "is not written");
}

celspan_status cs_write_rows(cs_picture_writer *writer, int32_t y, int32_t count, const void *rows,
                             cs_picture_failure *failure) {
  (void)writer, (void)y, (void)count, (void)rows;
  return lack(failure, "is not written");
}

celspan_status cs_write_close(cs_picture_writer *writer, cs_picture_failure *failure) {
  (void)writer;
  return lack(failure, "is not written");
}

void cs_write_abandon(cs_picture_writer *writer) { (void)writer; }
