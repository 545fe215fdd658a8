/* OpenRaster: a zip archive with a picture of each layer. Source: OpenRaster 0.0.6
 * (openraster.org).
 *
 *   mimetype | mergedimage.png | data/1.png, the rearmost | data/2.png | ... |
 *   Thumbnails/thumbnail.png | stack.xml, from the front
 */
#include <stdio.h>
#include <string.h>

#include "common/blend_names.h"
#include "common/markup.h"
#include "inside/sinks.h"
#include "writers/apart/apart.h"
#include "writers/archive/archive.h"

enum { THUMBNAIL = 256 }; /* pixels a side at most */

typedef struct ora_writing {
  cs_apart_writing base;
  cs_archive archive;
} ora_writing;

/* ---------------------------------------------------------------- pictures */

static celspan_status put_picture(ora_writing *w, const char *name,
                                  const celspan_frame_desc *picture) {
  cs_apart_writing *base = &w->base;
  celspan_sink sink;
  base->file.is_opaque = celspan_frame_is_opaque(picture);
  CS_TRY(cs_archive_begin(&w->archive, name));
  CS_TRY(cs_sink_png_part(base->context, base->path, w->archive.file, &base->file, &sink));
  CS_TRY(cs_apart_render(base, picture, &sink));
  return cs_archive_end(&w->archive, base->path);
}

static celspan_status put(cs_apart_writing *base, const celspan_frame_desc *picture, size_t index) {
  char name[CS_ARCHIVE_NAME];
  snprintf(name, sizeof name, "data/%zu.png", index);
  return put_picture((ora_writing *)base, index ? name : "mergedimage.png", picture);
}

static int32_t scale(int32_t length, double by) {
  int32_t scaled = (int32_t)(length * by);
  return length > 0 && scaled < 1 ? 1 : scaled;
}

/* Where a crop begins: before the end of the side, when both are rounded. */
static int32_t place(double at, int32_t side) {
  return (int32_t)at < side ? (int32_t)at : side - 1;
}

static celspan_status put_thumbnail(ora_writing *w) {
  celspan_frame_desc frame = w->base.frame;
  int32_t width = w->base.width, height = w->base.height;
  double by = (double)THUMBNAIL / (width > height ? width : height);
  by = by < 1 ? by : 1;
  frame.width = scale(frame.width, by);
  frame.height = scale(frame.height, by);
  frame.crop_width = scale(frame.crop_width, by);
  frame.crop_height = scale(frame.crop_height, by);
  frame.crop_x = place(frame.crop_x * by, frame.width);
  frame.crop_y = place(frame.crop_y * by, frame.height);
  return put_picture(w, "Thumbnails/thumbnail.png", &frame);
}

/* ---------------------------------------------------------------- the list of layers */

enum { ENTRY = CS_MARKUP_MOST * CS_APART_NAME + 256 }; /* the most bytes of a layer in the list */

static char *describe(char *out, const cs_apart *apart, size_t index) {
  const cs_apart_layer *layer = &apart->layers[index];
  char mode[CS_BLEND_WORD];
  cs_blend_openraster(layer->blend, mode);
  out = cs_markup_put(stpcpy(out, "  <layer name=\""), cs_apart_title(layer));
  return out + sprintf(out,
                       "\" src=\"data/%zu.png\" x=\"0\" y=\"0\" opacity=\"%.9g\" "
                       "visibility=\"visible\" composite-op=\"%s\"/>\n",
                       index + 1, layer->opacity, mode);
}

static size_t write_list(const cs_apart_writing *w, char *xml) {
  char *end = xml;
  end += sprintf(end,
                 "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                 "<image version=\"0.0.6\" w=\"%d\" h=\"%d\">\n <stack>\n",
                 (int)w->width, (int)w->height);
  for (size_t i = w->apart.count; i-- > 0;)
    end = describe(end, &w->apart, i);
  return (size_t)(stpcpy(end, " </stack>\n</image>\n") - xml);
}

static celspan_status put_list(ora_writing *w) {
  size_t size = (w->base.apart.count + 1) * ENTRY;
  char *xml;
  CS_TRY(CS_MAKE(w->base.context, xml, size));
  celspan_status status =
      cs_archive_put(&w->archive, w->base.path, "stack.xml", xml, write_list(&w->base, xml));
  cs_mem_free(w->base.context->memory, xml, size);
  return status;
}

/* ---------------------------------------------------------------- all */

static celspan_status begin(cs_apart_writing *base) {
  static const char type[] = "image/openraster";
  ora_writing *w = (ora_writing *)base;
  w->archive.context = base->context;
  base->file.coding = &base->coding;
  base->file.title = NULL;
  base->count++; /* the thumbnail */
  CS_TRY(cs_file_create(base->context, NULL, base->path, &w->archive.file));
  return cs_archive_put(&w->archive, base->path, "mimetype", type, sizeof type - 1);
}

static celspan_status complete(ora_writing *w) {
  CS_TRY(put_thumbnail(w));
  CS_TRY(put_list(w));
  return cs_archive_complete(&w->archive);
}

static celspan_status end(cs_apart_writing *base, celspan_status outcome) {
  ora_writing *w = (ora_writing *)base;
  if (outcome == CELSPAN_OK)
    outcome = complete(w);
  cs_archive_finish(&w->archive);
  return w->archive.file ? cs_file_end(w->archive.file, base->context, outcome) : outcome;
}

static bool has_mode(celspan_blend blend) {
  (void)blend; /* in words of Krita where the specification has none */
  return true;
}

const cs_apart_format cs_apart_ora = {.size = sizeof(ora_writing),
                                      .depth = CELSPAN_DEPTH_8,
                                      .has_mode = has_mode,
                                      .begin = begin,
                                      .put = put,
                                      .end = end};
