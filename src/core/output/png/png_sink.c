/* PNG files (PNG 3rd edition, 5 and 11): chunks around the image data that strips.c makes.
 *
 *   signature | IHDR | sRGB or gAMA | tEXt, iTXt | csST, of a strip | IDAT, IDAT, ... | IEND
 */
#include <stdio.h>
#include <string.h>

#include "output/png/chunk.h"
#include "output/png/strips.h"
#include "output/sinks/pixels.h"
#include "output/sinks/sink.h"
#include "output/sinks/strip.h"

typedef struct png_sink {
  size_t allocated;
  const char *path;
  cs_file *file;         /* from begin to end */
  bool is_part;          /* the file is another's */
  cs_png_strips *strips; /* likewise */
  celspan_coding coding;
  bool is_opaque;
  cs_strip strip;
  int workers;
  size_t title_size;
  unsigned char title[]; /* the bytes of the chunk that holds the title */
} png_sink;

/* ---------------------------------------------------------------- chunks */

static celspan_status put_chunk(png_sink *sink, celspan_context *context, const char *type,
                                const void *bytes, size_t size) {
  return cs_png_chunk_put(sink->file, context, type, bytes, size);
}

static celspan_status put_image_data(void *user, celspan_context *context, const void *bytes,
                                     size_t size) {
  return put_chunk(user, context, "IDAT", bytes, size);
}

/* A space that has no chunk of its own is named in a text. */
static celspan_status put_space(png_sink *sink, celspan_context *context) {
  char text[300];
  static const char keyword[] = "colour\0\0\0\0"; /* not compressed, in no language */
  memcpy(text, keyword, sizeof keyword);
  int length = snprintf(text + sizeof keyword, sizeof text - sizeof keyword, "%s",
                        cs_pixels_colour(&sink->coding));
  size_t size = sizeof keyword + (size_t)(length < 0 ? 0 : length);
  return put_chunk(sink, context, "iTXt", text, size < sizeof text ? size : sizeof text - 1);
}

static celspan_status put_colour_space(png_sink *sink, celspan_context *context) {
  static const unsigned char perceptual[1] = {0};
  unsigned char gamma[4];
  cs_png_store_32(gamma, 100000);
  if (sink->coding.transfer == CELSPAN_TRANSFER_SRGB)
    return put_chunk(sink, context, "sRGB", perceptual, sizeof perceptual);
  if (sink->coding.transfer == CELSPAN_TRANSFER_LINEAR)
    return put_chunk(sink, context, "gAMA", gamma, sizeof gamma);
  return sink->coding.convert ? put_space(sink, context) : CELSPAN_OK;
}

static celspan_status put_place(png_sink *sink, celspan_context *context) {
  unsigned char place[8];
  cs_png_store_32(place, (uint32_t)sink->strip.row);
  cs_png_store_32(place + 4, (uint32_t)sink->strip.height);
  return sink->strip.height == 0 ? CELSPAN_OK
                                 : put_chunk(sink, context, CS_STRIP_MARK, place, sizeof place);
}

static celspan_status put_start(png_sink *sink, celspan_context *context, int32_t width,
                                int32_t height) {
  static const char software[] = "Software\0celspan";
  unsigned char header[CS_PNG_HEADER] = {0};
  cs_png_store_32(header, (uint32_t)width);
  cs_png_store_32(header + 4, (uint32_t)height);
  header[8] = sink->coding.depth == CELSPAN_DEPTH_16 ? 16 : 8;
  header[9] = sink->is_opaque ? 2 : 6; /* RGB or RGBA */
  CS_TRY(cs_file_write(sink->file, context, cs_png_signature, sizeof cs_png_signature));
  CS_TRY(put_chunk(sink, context, "IHDR", header, sizeof header));
  CS_TRY(put_colour_space(sink, context));
  CS_TRY(put_chunk(sink, context, "tEXt", software, sizeof software - 1));
  if (sink->title_size > 0)
    CS_TRY(put_chunk(sink, context, "iTXt", sink->title, sink->title_size));
  return put_place(sink, context);
}

/* ---------------------------------------------------------------- the sink */

static celspan_status begin(void *user, celspan_context *context, int32_t width, int32_t height) {
  png_sink *sink = user;
  cs_png_picture picture = {.coding = sink->coding,
                            .is_opaque = sink->is_opaque,
                            .is_strip = sink->strip.height > 0,
                            .width = width,
                            .height = height,
                            .workers = sink->workers};
  CS_TRY(cs_strip_check(context, sink->path, sink->strip, height));
  CS_TRY(cs_png_strips_create(context, &picture, put_image_data, sink, &sink->strips));
  if (!sink->is_part)
    CS_TRY(cs_file_create(context, NULL, sink->path, &sink->file));
  return put_start(sink, context, width, height);
}

static celspan_status put_row(void *user, celspan_context *context, int32_t y,
                              const celspan_span *spans, size_t span_count) {
  png_sink *sink = user;
  (void)y;
  return cs_png_strips_row(sink->strips, context, spans, span_count);
}

static celspan_status finish(png_sink *sink, celspan_context *context) {
  CS_TRY(cs_png_strips_finish(sink->strips, context));
  return put_chunk(sink, context, "IEND", "", 0);
}

static celspan_status end(void *user, celspan_context *context, celspan_status outcome) {
  png_sink *sink = user;
  if (outcome == CELSPAN_OK)
    outcome = finish(sink, context);
  if (!sink->is_part)
    outcome = cs_file_end(sink->file, context, outcome);
  cs_png_strips_destroy(sink->strips, context);
  cs_mem_free(context->memory, sink, sink->allocated);
  return outcome;
}

bool cs_png_sink_shares(const celspan_sink *sink, cs_shares *out) {
  if (sink->row != put_row)
    return false;
  *out = cs_png_strips_shares(((const png_sink *)sink->user)->strips);
  return true;
}

static const char title_head[] = "Title\0\0\0\0"; /* plain text, no language, UTF-8 */

static celspan_status check_coding(celspan_context *context, const char *path,
                                   const celspan_coding *coding) {
  if (coding->depth != CELSPAN_DEPTH_8 && coding->depth != CELSPAN_DEPTH_16)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "%s: PNG holds 8 or 16 bits per channel; for half and float use EXR or TIFF",
                   path);
  if (coding->alpha != CELSPAN_ALPHA_STRAIGHT)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "%s: PNG holds straight alpha; for premultiplied use EXR or TIFF", path);
  return CELSPAN_OK;
}

celspan_status cs_sink_png(celspan_context *context, const char *path,
                           const celspan_file_desc *file, celspan_sink *out) {
  celspan_coding coding = cs_pixels_resolve(file->coding, CELSPAN_DEPTH_8);
  CS_TRY(check_coding(context, path, &coding));
  size_t path_size = strlen(path) + 1, title = file->title ? strlen(file->title) : 0;
  size_t title_size = title > 0 ? sizeof title_head + title : 0;
  size_t size = sizeof(png_sink) + title_size + path_size;
  png_sink *sink;
  CS_TRY(cs_mem_make(context, (void **)&sink, 1, size));
  sink->allocated = size;
  sink->coding = coding;
  sink->is_opaque = file->is_opaque;
  sink->strip = cs_strip_of(file);
  sink->workers = file->workers;
  sink->title_size = title_size;
  if (title > 0) {
    memcpy(sink->title, title_head, sizeof title_head);
    memcpy(sink->title + sizeof title_head, file->title, title);
  }
  sink->path = memcpy(sink->title + title_size, path, path_size);
  *out = (celspan_sink){CS_SINK_CALLS, .user = sink,
                        .takes_codes = cs_pixels_takes_codes(&sink->coding)};
  return CELSPAN_OK;
}

celspan_status cs_sink_png_part(celspan_context *context, const char *path, cs_file *into,
                                const celspan_file_desc *file, celspan_sink *out) {
  CS_TRY(cs_sink_png(context, path, file, out));
  png_sink *sink = out->user;
  sink->file = into;
  sink->is_part = true;
  return CELSPAN_OK;
}
