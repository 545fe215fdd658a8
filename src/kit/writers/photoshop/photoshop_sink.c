/* The pixels of a document. */
#include <errno.h>
#include <string.h>
#include <unistd.h>

#include "inside/context.h"
#include "inside/files.h"
#include "inside/sinks.h"
#include "writers/photoshop/bytes.h"
#include "writers/photoshop/photoshop.h"

typedef struct photoshop_sink {
  cs_photoshop *document;
  cs_photoshop_layer *layer; /* NULL: the merged picture */
  celspan_coding coding;
  size_t row_size;
  unsigned char *row, *plane, *packed; /* of all channels; of one; the same when it is packed */
  cs_photoshop_rows rows;
} photoshop_sink;

static size_t plane_size(const photoshop_sink *sink) { return sink->row_size / 4; }

/* ---------------------------------------------------------------- rows */

/* The values of one channel of a row as the file has them. */
static void take_plane(const photoshop_sink *sink, int channel) {
  unsigned char *out = sink->plane;
  size_t size = sink->row_size / (size_t)sink->document->width / 4; /* of a value */
  const unsigned char *from = sink->row + (size_t)channel * size;
  for (int32_t x = 0; x < sink->document->width; x++, from += 4 * size, out += size) {
    out[0] = from[size - 1];
    out[size - 1] = from[0];
  }
}

/* A premultiplied code over white is greater by what its alpha leaves free. Light without a matte
 * has more colour than alpha. */
static int over_white(int code, int alpha, int most) {
  int sum = code + most - alpha;
  return sum < most ? sum : most;
}

static void lay_over_white8(unsigned char *row, size_t width) {
  for (size_t x = 0; x < width; x++, row += 4)
    for (int c = 0; c < 3; c++)
      row[c] = (unsigned char)over_white(row[c], row[3], UINT8_MAX);
}

static void lay_over_white16(unsigned char *row, size_t width) {
  uint16_t pixel[4];
  for (size_t x = 0; x < width; x++, row += sizeof pixel) {
    memcpy(pixel, row, sizeof pixel);
    for (int c = 0; c < 3; c++)
      pixel[c] = (uint16_t)over_white(pixel[c], pixel[3], UINT16_MAX);
    memcpy(row, pixel, sizeof pixel);
  }
}

static void make_row(const photoshop_sink *sink, const celspan_span *spans, size_t span_count) {
  size_t width = (size_t)sink->document->width;
  cs_pixels_row(&sink->coding, spans, span_count, sink->row);
  if (sink->layer || sink->rows.channels == 3)
    return;
  if (sink->coding.depth == CELSPAN_DEPTH_8)
    lay_over_white8(sink->row, width);
  else
    lay_over_white16(sink->row, width);
}

static celspan_status check_size(const photoshop_sink *sink, celspan_context *context) {
  const cs_photoshop *document = sink->document;
  const cs_file *merged = document->merged.waiting; /* none yet while it is written */
  uint64_t size = cs_file_size(document->file) + cs_file_size(sink->rows.waiting) +
                  sink->rows.size_count * sizeof *sink->rows.sizes +
                  (merged ? cs_file_size(merged) : 0);
  return size < INT32_MAX ? CELSPAN_OK
                          : cs_fail(context, CELSPAN_LIMIT,
                                    "%s: the file has 2 GiB or more, which is the limit of this "
                                    "format: write OpenEXR or PNG files, or a smaller --size",
                                    document->path);
}

/* Layers begin with alpha, and the merged picture ends with it. */
static int source_of(const photoshop_sink *sink, int channel) {
  return sink->layer ? (channel + 3) % 4 : channel;
}

static celspan_status put_row(void *user, celspan_context *context, int32_t y,
                              const celspan_span *spans, size_t span_count) {
  photoshop_sink *sink = user;
  make_row(sink, spans, span_count);
  for (int c = 0; c < sink->rows.channels; c++) {
    take_plane(sink, source_of(sink, c));
    size_t packed = cs_pack_bits(sink->plane, plane_size(sink), sink->packed);
    sink->rows.sizes[c * sink->document->height + y] = (uint16_t)packed;
    CS_TRY(cs_file_write(sink->rows.waiting, context, sink->packed, packed));
  }
  return check_size(sink, context);
}

/* ---------------------------------------------------------------- channels */

/* The packed rows of a picture on their way into the document. */
typedef struct transfer {
  const cs_photoshop *document;
  const cs_photoshop_rows *rows;
  int descriptor;
  unsigned char *packed; /* a row */
} transfer;

static celspan_status put(const transfer *t, const void *bytes, size_t size) {
  return cs_file_write(t->document->file, t->document->context, bytes, size);
}

static celspan_status put_16(const transfer *t, uint32_t number) {
  unsigned char bytes[2];
  cs_big_endian_store(bytes, number, 2);
  return put(t, bytes, sizeof bytes);
}

static celspan_status put_packing(const transfer *t) {
  enum { PACK_BITS = 1 };
  return put_16(t, PACK_BITS);
}

static celspan_status put_table(const transfer *t, int channel) {
  int32_t height = t->document->height;
  for (int32_t y = 0; y < height; y++)
    CS_TRY(put_16(t, t->rows->sizes[channel * height + y]));
  return CELSPAN_OK;
}

static celspan_status fail_reading(const cs_photoshop *document, const char *why) {
  return cs_fail(document->context, CELSPAN_OUTPUT, "%s: cannot read its temporary file back: %s",
                 document->path, why);
}

static celspan_status move_row(const transfer *t, uint64_t at, size_t size) {
  char text[CS_ERROR_TEXT_SIZE];
  ssize_t got = cs_open_read_at(t->descriptor, t->packed, size, (off_t)at);
  if (got == (ssize_t)size)
    return put(t, t->packed, size);
  return fail_reading(t->document, got < 0 ? cs_error_text(errno, text) : "it has become shorter");
}

static celspan_status put_rows(const transfer *t, int channel) {
  int32_t height = t->document->height;
  uint64_t at = 0;
  for (int32_t y = 0; y < height; y++)
    for (int c = 0; c < t->rows->channels; c++) {
      size_t size = t->rows->sizes[c * height + y];
      if (c == channel)
        CS_TRY(move_row(t, at, size));
      at += size;
    }
  return CELSPAN_OK;
}

static celspan_status put_layer(const transfer *t, cs_photoshop_layer *layer) {
  for (int c = 0; c < t->rows->channels; c++) {
    uint64_t start = cs_file_size(t->document->file);
    CS_TRY(put_packing(t));
    CS_TRY(put_table(t, c));
    CS_TRY(put_rows(t, c));
    layer->sizes[c] = (uint32_t)(cs_file_size(t->document->file) - start);
  }
  return CELSPAN_OK;
}

static celspan_status put_merged(const transfer *t) {
  CS_TRY(put_packing(t));
  for (int c = 0; c < t->rows->channels; c++)
    CS_TRY(put_table(t, c));
  for (int c = 0; c < t->rows->channels; c++)
    CS_TRY(put_rows(t, c));
  return CELSPAN_OK;
}

static celspan_status open_waiting(transfer *t) {
  const cs_photoshop *document = t->document;
  char text[CS_ERROR_TEXT_SIZE];
  const char *name;
  CS_TRY(cs_file_temporary(t->rows->waiting, document->context, &name));
  t->descriptor = cs_open_to_read(name);
  return t->descriptor >= 0 ? CELSPAN_OK : fail_reading(document, cs_error_text(errno, text));
}

/* layer: NULL for the merged picture. */
static celspan_status move_rows(const cs_photoshop *document, const cs_photoshop_rows *rows,
                                cs_photoshop_layer *layer) {
  transfer t = {.document = document, .rows = rows};
  size_t size = CS_PACK_BITS_MOST((size_t)document->width * cs_pixels_size(&document->coding) / 4);
  CS_TRY(open_waiting(&t));
  t.packed = cs_mem_array(document->context->memory, size, 1);
  celspan_status status = !t.packed ? cs_fail_memory(document->context)
                          : layer   ? put_layer(&t, layer)
                                    : put_merged(&t);
  cs_mem_free(document->context->memory, t.packed, size);
  close(t.descriptor);
  return status;
}

static void finish_rows(celspan_context *context, cs_photoshop_rows *rows) {
  cs_file_discard(rows->waiting, context);
  cs_mem_free(context->memory, rows->sizes, rows->size_count * sizeof *rows->sizes);
  *rows = (cs_photoshop_rows){0};
}

celspan_status cs_photoshop_end_merged(cs_photoshop *document, celspan_status outcome) {
  if (outcome == CELSPAN_OK)
    outcome = move_rows(document, &document->merged, NULL);
  finish_rows(document->context, &document->merged);
  return outcome;
}

/* ---------------------------------------------------------------- the sink */

static celspan_status begin(void *user, celspan_context *context, int32_t width, int32_t height) {
  photoshop_sink *sink = user;
  cs_photoshop_rows *rows = &sink->rows;
  sink->row_size = (size_t)width * cs_pixels_size(&sink->coding);
  rows->size_count = (size_t)height * (size_t)rows->channels;
  CS_TRY(CS_MAKE(context, sink->row, sink->row_size));
  CS_TRY(CS_MAKE(context, sink->plane, plane_size(sink)));
  CS_TRY(CS_MAKE(context, sink->packed, CS_PACK_BITS_MOST(plane_size(sink))));
  CS_TRY(CS_MAKE(context, rows->sizes, rows->size_count));
  return cs_file_create(context, NULL, sink->document->path, &rows->waiting);
}

/* The rows of the merged picture wait until those of all layers are in the document. */
static celspan_status end(void *user, celspan_context *context, celspan_status outcome) {
  photoshop_sink *sink = user;
  cs_photoshop *document = sink->document;
  if (outcome == CELSPAN_OK && sink->layer)
    outcome = move_rows(document, &sink->rows, sink->layer);
  if (outcome == CELSPAN_OK && !sink->layer) {
    document->merged = sink->rows;
    sink->rows = (cs_photoshop_rows){0};
  }
  finish_rows(context, &sink->rows);
  cs_mem_free(context->memory, sink->row, sink->row_size);
  cs_mem_free(context->memory, sink->plane, plane_size(sink));
  cs_mem_free(context->memory, sink->packed, CS_PACK_BITS_MOST(plane_size(sink)));
  cs_mem_free(context->memory, sink, sizeof *sink);
  return outcome;
}

celspan_status cs_photoshop_sink(cs_photoshop *document, cs_photoshop_layer *layer,
                                 celspan_sink *out) {
  photoshop_sink *sink;
  CS_TRY(CS_MAKE(document->context, sink, 1));
  sink->document = document;
  sink->layer = layer;
  sink->rows.channels = layer || !document->is_opaque ? 4 : 3;
  sink->coding = document->coding;
  if (!layer && !document->is_opaque)
    sink->coding.alpha = CS_ALPHA_CODED;
  *out = (celspan_sink){CS_SINK_CALLS, .user = sink,
                        .takes_codes = cs_pixels_takes_codes(&sink->coding)};
  return CELSPAN_OK;
}
