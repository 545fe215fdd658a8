/* OpenRaster: a zip archive with a picture of each layer. Source: OpenRaster 0.0.6
 * (openraster.org).
 *
 *   mimetype | mergedimage.png | data/1.png, the rearmost | data/2.png | ... |
 *   Thumbnails/thumbnail.png | stack.xml, from the front
 *
 * The merged picture comes before the layers, so that a picture that cannot be read is reported
 * with its place in the frame.
 */
#include <stdio.h>
#include <string.h>

#include "common/blend_names.h"
#include "common/markup.h"
#include "inside/frames.h"
#include "inside/sinks.h"
#include "writers/apart/apart.h"
#include "writers/archive/archive.h"

enum { THUMBNAIL = 256 }; /* pixels a side at most */

typedef struct writing {
  celspan_context *context;
  const char *path;
  const celspan_frame_desc *desc;
  celspan_file_desc file;
  celspan_coding coding;
  cs_apart apart;
  cs_apart_progress progress;
  cs_archive archive;
  char *xml;
  size_t xml_size;
} writing;

/* ---------------------------------------------------------------- pictures */

static celspan_status put_picture(writing *w, const char *name, const celspan_frame_desc *desc) {
  celspan_frame_desc frame = *desc;
  celspan_file_desc file = w->file;
  celspan_sink sink;
  file.is_opaque = celspan_frame_is_opaque(&frame);
  cs_apart_report_to(&w->progress, &frame);
  CS_TRY(cs_archive_begin(&w->archive, name));
  CS_TRY(cs_sink_png_part(w->context, w->path, w->archive.file, &file, &sink));
  CS_TRY(cs_frame_render_own(w->context, &frame, &sink, NULL));
  return cs_archive_end(&w->archive, w->path);
}

static celspan_status put_layer(writing *w, size_t index) {
  char name[CS_ARCHIVE_NAME];
  celspan_frame_desc frame = *w->desc;
  frame.exposures = w->apart.layers[index].exposures;
  frame.exposure_count = w->apart.layers[index].count;
  snprintf(name, sizeof name, "data/%zu.png", index + 1);
  return put_picture(w, name, &frame);
}

static int32_t scale(int32_t length, double by) {
  int32_t scaled = (int32_t)(length * by);
  return length > 0 && scaled < 1 ? 1 : scaled;
}

/* Where a crop begins: before the end of the side, when both are rounded. */
static int32_t place(double at, int32_t side) {
  return (int32_t)at < side ? (int32_t)at : side - 1;
}

static celspan_status put_thumbnail(writing *w) {
  celspan_frame_desc frame = *w->desc;
  bool has_crop = frame.crop_width > 0;
  int32_t width = has_crop ? frame.crop_width : frame.width;
  int32_t height = has_crop ? frame.crop_height : frame.height;
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

static celspan_status put_list(writing *w) {
  const celspan_frame_desc *desc = w->desc;
  w->xml_size = (w->apart.count + 1) * ENTRY;
  CS_TRY(CS_MAKE(w->context, w->xml, w->xml_size));
  char *end = w->xml;
  end += sprintf(end,
                 "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                 "<image version=\"0.0.6\" w=\"%d\" h=\"%d\">\n <stack>\n",
                 (int)(desc->crop_width > 0 ? desc->crop_width : desc->width),
                 (int)(desc->crop_height > 0 ? desc->crop_height : desc->height));
  for (size_t i = w->apart.count; i-- > 0;)
    end = describe(end, &w->apart, i);
  end = stpcpy(end, " </stack>\n</image>\n");
  return cs_archive_put(&w->archive, w->path, "stack.xml", w->xml, (size_t)(end - w->xml));
}

/* ---------------------------------------------------------------- all */

static celspan_status put_all(writing *w) {
  static const char type[] = "image/openraster";
  CS_TRY(cs_archive_put(&w->archive, w->path, "mimetype", type, sizeof type - 1));
  CS_TRY(put_picture(w, "mergedimage.png", w->desc));
  for (size_t i = 0; i < w->apart.count; i++)
    CS_TRY(put_layer(w, i));
  CS_TRY(put_thumbnail(w));
  CS_TRY(put_list(w));
  return cs_archive_complete(&w->archive);
}

static celspan_status write_file(writing *w) {
  CS_TRY(cs_file_create(w->context, NULL, w->path, &w->archive.file));
  return cs_file_end(w->archive.file, w->context, put_all(w));
}

celspan_status cs_apart_write_ora(celspan_context *context, const celspan_frame_desc *desc,
                                  const char *path, const celspan_file_desc *file) {
  writing w = {.context = context, .path = path, .desc = desc, .file = *file};
  w.archive.context = context;
  w.coding = cs_pixels_resolve(file->coding, CELSPAN_DEPTH_8);
  w.coding.space = desc->space;
  w.file.coding = &w.coding;
  w.file.title = NULL;
  CS_TRY(cs_frame_check(context, desc));
  CS_TRY(cs_apart_make(context, desc->exposures, desc->exposure_count, 0, &w.apart));
  celspan_status status = cs_apart_take_mixings(&w.apart, 0);
  w.progress = (cs_apart_progress){.desc = desc, .count = w.apart.count + 2};
  if (status == CELSPAN_OK)
    status = write_file(&w);
  cs_mem_free(context->memory, w.xml, w.xml_size);
  cs_archive_finish(&w.archive);
  cs_apart_finish(&w.apart);
  return status;
}
