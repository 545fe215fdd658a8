/* Pictures of drawings: from the bytes of a file to pixels. */
#include "readers/svg/draw/image.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "common/address.h"
#include "inside/number.h"
#include "inside/pictures.h"
#include "readers/layered/png.h"

/* Rows that the picture module gives at a time. */
#define ROWS 16

/* A picture while it is decoded: rows of RGBA codes, alpha straight unless it is said. */
typedef struct decoding {
  cs_svg_reading *reading;
  const cs_svg_node *node;
  int32_t width, height;
  int bits; /* the bits of a code: 8 or 16 */
  celspan_alpha alpha;
  unsigned char *pixels; /* owned */
} decoding;

celspan_status cs_svg_image_count(cs_svg_reading *reading, const cs_svg_node *node,
                                  uint64_t bytes) {
  if (bytes <= CS_SVG_IMAGE_BYTES - reading->image_bytes) {
    reading->image_bytes += bytes;
    return CELSPAN_OK;
  }
  return cs_fail(reading->context, CELSPAN_LIMIT,
                 "line %u: the images of the drawing have more than %llu bytes", node->line,
                 (unsigned long long)CS_SVG_IMAGE_BYTES);
}

/* ---------------------------------------------------------------- what both ways share */

static celspan_status note(const decoding *d, const char *reason) {
  return cs_svg_skip(d->reading, d->node, "image: %s", reason);
}

static celspan_status note_failure(const decoding *d, celspan_status status) {
  if (status != CELSPAN_INPUT && status != CELSPAN_LIMIT)
    return status;
  return note(d, d->reading->context->error);
}

static size_t row_bytes(const decoding *d) { return (size_t)d->width * 4 * (size_t)(d->bits / 8); }

static size_t all_bytes(const decoding *d) { return row_bytes(d) * (size_t)d->height; }

/* Makes room for the pixels, whose size is known now. */
static celspan_status make_room(decoding *d) {
  CS_TRY(cs_svg_image_count(d->reading, d->node, all_bytes(d)));
  d->pixels = cs_mem_resize(d->reading->context->memory, NULL, 0, all_bytes(d));
  return d->pixels ? CELSPAN_OK : cs_fail_memory(d->reading->context);
}

static celspan_status make_surface(const decoding *d, celspan_surface **out) {
  celspan_surface_desc desc = CELSPAN_SURFACE_DESC;
  desc.width = d->width;
  desc.height = d->height;
  desc.format = d->bits == 16 ? CELSPAN_SURFACE_RGBA16 : CELSPAN_SURFACE_RGBA8;
  desc.alpha = d->alpha;
  desc.pixels = d->pixels;
  return celspan_surface_create(d->reading->context, &desc, out);
}

/* ---------------------------------------------------------------- PNG */

static celspan_status read_png_rows(decoding *d, const cs_input *input,
                                    const cs_rows_source *source) {
  celspan_context *context = d->reading->context;
  cs_rows *rows;
  CS_TRY(source->kind->begin(source, context, input, &rows));
  celspan_status status = CELSPAN_OK;
  for (int32_t y = 0; y < d->height && status == CELSPAN_OK; y++)
    status = source->kind->next(rows, context, d->pixels + (size_t)y * row_bytes(d));
  source->kind->end(rows);
  return status;
}

static celspan_status finish_png(decoding *d, const cs_input *input, const cs_rows_source *source,
                                 celspan_surface **out) {
  d->width = source->width;
  d->height = source->height;
  d->bits = source->bits;
  d->alpha = CELSPAN_ALPHA_STRAIGHT;
  CS_TRY(make_room(d));
  celspan_status status = read_png_rows(d, input, source);
  return status == CELSPAN_OK ? make_surface(d, out) : note_failure(d, status);
}

static celspan_status read_png(decoding *d, const unsigned char *bytes, size_t size,
                               celspan_surface **out) {
  celspan_context *context = d->reading->context;
  const cs_input input = {
      .path = "embedded PNG", .bytes = bytes, .is_known = true, .size = (int64_t)size};
  const cs_zip_member member = {.name = "the picture",
                                .header = CS_ZIP_BARE,
                                .packed = (int64_t)size,
                                .unpacked = (int64_t)size};
  cs_rows_source *source;
  celspan_status status = cs_png_create(context, &input, &member, &source);
  if (status != CELSPAN_OK)
    return note_failure(d, status);
  status = finish_png(d, &input, source, out);
  source->kind->destroy(source);
  return status;
}

/* ---------------------------------------------------------------- other formats */

/* Converts shares of full scale, which the module gives, back to codes. */
static void put_codes(const decoding *d, const float *rgba, size_t count, unsigned char *out) {
  for (size_t i = 0; i < count; i++) {
    float share = cs_number_clampf(rgba[i], 0, 1);
    uint16_t wide = (uint16_t)(share * 65535 + 0.5f);
    if (d->bits == 16)
      memcpy(out + 2 * i, &wide, sizeof wide);
    else
      out[i] = (unsigned char)(share * 255 + 0.5f);
  }
}

static celspan_status read_module_rows(decoding *d, const cs_picture_module *module,
                                       cs_picture_reader *reader, cs_picture_failure *failure) {
  cs_memory *memory = d->reading->context->memory;
  size_t row = 4 * (size_t)d->width;
  float *batch = cs_mem_array(memory, ROWS * row, sizeof *batch);
  celspan_status status = CELSPAN_OK;
  if (!batch)
    return cs_fail_memory(d->reading->context);
  for (int32_t y = 0; y < d->height && status == CELSPAN_OK; y += ROWS) {
    int32_t rows = d->height - y < ROWS ? d->height - y : ROWS;
    status = module->read(reader, 0, y, d->width, rows, batch, failure);
    if (status == CELSPAN_OK)
      put_codes(d, batch, (size_t)rows * row, d->pixels + (size_t)y * row_bytes(d));
  }
  cs_mem_free(memory, batch, ROWS * row * sizeof *batch);
  return status;
}

/* The module's sentence without the name of the file, which has no meaning for the user. */
static celspan_status note_module(const decoding *d, celspan_status status, const char *name,
                                  const char *sentence) {
  size_t size = strlen(name);
  bool has_name = strncmp(sentence, name, size) == 0 && strncmp(sentence + size, ": ", 2) == 0;
  if (status == CELSPAN_NO_MEMORY)
    return cs_fail_memory(d->reading->context);
  return note(d, sentence + (has_name ? size + 2 : 0));
}

static celspan_status read_opened(decoding *d, const cs_picture_module *module,
                                  cs_picture_reader *reader, const cs_picture_header *header,
                                  const char *name, celspan_surface **out) {
  cs_picture_failure failure = {CELSPAN_OK, ""};
  d->width = header->info.width;
  d->height = header->info.height;
  d->bits = header->bits == 8 ? 8 : 16;
  d->alpha = header->alpha == CS_PICTURE_ALPHA_CODED ? CELSPAN_ALPHA_PREMULTIPLIED
                                                     : CELSPAN_ALPHA_STRAIGHT;
  if (header->bits == 0 || strcmp(header->info.colour, "srgb") != 0)
    return note(d, "its colours are not sRGB-coded; save it as a file beside the drawing");
  CS_TRY(make_room(d));
  celspan_status status = read_module_rows(d, module, reader, &failure);
  return status == CELSPAN_OK ? make_surface(d, out) : note_module(d, status, name, failure.text);
}

static celspan_status read_by_module(decoding *d, int descriptor, celspan_surface **out) {
  const cs_picture_module *module;
  cs_picture_reader *reader;
  cs_picture_header header;
  cs_picture_failure failure = {CELSPAN_OK, ""};
  char name[40];
  celspan_status status = cs_store_module(d->reading->context, CELSPAN_INPUT, &module);
  if (status != CELSPAN_OK)
    return note_failure(d, status);
  snprintf(name, sizeof name, "/proc/self/fd/%d", descriptor);
  const cs_picture_request request = {.file = name};
  status = module->open(&request, &reader, &header, &failure);
  if (status != CELSPAN_OK)
    return note_module(d, status, name, failure.text);
  status = read_opened(d, module, reader, &header, name, out);
  module->close(reader);
  return status;
}

static celspan_status read_other(decoding *d, const unsigned char *bytes, size_t size,
                                 celspan_surface **out) {
  int descriptor = cs_address_file(bytes, size);
  if (descriptor < 0)
    return note(d, strerror(errno));
  celspan_status status = read_by_module(d, descriptor, out);
  close(descriptor);
  return status;
}

/* ---------------------------------------------------------------- either */

/* Whether the bytes are a PNG whose rows come in order. Source: PNG (Third Edition), 11.2.1. */
static bool is_plain_png(const unsigned char *bytes, size_t size) {
  const size_t interlace = 28;
  return size >= 4 && memcmp(bytes, "\x89PNG", 4) == 0 &&
         (size <= interlace || bytes[interlace] == 0);
}

celspan_status cs_svg_image_picture(cs_svg_reading *reading, const cs_svg_node *node,
                                    const unsigned char *bytes, size_t size,
                                    celspan_surface **out) {
  decoding d = {.reading = reading, .node = node};
  *out = NULL;
  celspan_status status =
      is_plain_png(bytes, size) ? read_png(&d, bytes, size, out) : read_other(&d, bytes, size, out);
  cs_mem_free(reading->context->memory, d.pixels, all_bytes(&d));
  return status;
}
