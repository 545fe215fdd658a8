/* The pixels of a document. */
#include "writers/apart/photoshop.h"

#include <string.h>

#include "common/bytes.h"

typedef struct photoshop_sink {
  cs_photoshop *document;
  size_t index; /* the number of the layer, from 1; 0: the merged picture */
  celspan_coding coding;
  size_t row_size;
  unsigned char *row, *plane, *packed; /* values of all channels; of one; and these packed */
  cs_photoshop_rows rows;
} photoshop_sink;

static size_t plane_size(const photoshop_sink *sink) { return sink->row_size / 4; }

/* ---------------------------------------------------------------- packed bytes
 *
 * PackBits, a packing of bytes by runs. Source: TIFF Revision 6.0 (Adobe, 1992), section 9.
 *
 *   0 .. 127     this number of bytes and one more follow
 *   129 .. 255   the byte that follows is repeated 257 minus this number of times
 */

/* The most bytes of a run or of single bytes, and the shortest run that is worth its two bytes
 * between single ones. */
enum { MOST = 128, RUN = 3 };

/* The most bytes that a row of one channel is packed into. */
static size_t packed_size(const photoshop_sink *sink) {
  return plane_size(sink) + (plane_size(sink) + MOST - 1) / MOST;
}

static size_t run_at(const unsigned char *row, size_t left) {
  size_t most = left < MOST ? left : MOST, count = 1;
  while (count < most && row[count] == row[0])
    count++;
  return count;
}

/* How many bytes come before the next run. */
static size_t single_at(const unsigned char *row, size_t left) {
  size_t most = left < MOST ? left : MOST, count = 1;
  while (count < most && run_at(row + count, left - count < RUN ? left - count : RUN) < RUN)
    count++;
  return count;
}

/* Packs a row, and returns the number of bytes. */
static size_t pack_bits(const unsigned char *row, size_t size, unsigned char *out) {
  unsigned char *end = out;
  for (size_t x = 0; x < size;) {
    size_t run = run_at(row + x, size - x);
    bool is_run = run >= RUN;
    size_t count = is_run ? run : single_at(row + x, size - x), stored = is_run ? 1 : count;
    *end++ = (unsigned char)(is_run ? 2 * MOST + 1 - count : count - 1);
    memcpy(end, row + x, stored);
    end += stored;
    x += count;
  }
  return (size_t)(end - out);
}

/* ---------------------------------------------------------------- rows */

/* The values of one channel of a row as the file has them. */
static void take_plane(const photoshop_sink *sink, int channel) {
  unsigned char *out = sink->plane;
  size_t size = sink->row_size / (size_t)sink->document->base.width / 4; /* size of a value */
  const unsigned char *from = sink->row + (size_t)channel * size;
  for (int32_t x = 0; x < sink->document->base.width; x++, from += 4 * size, out += size) {
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
  size_t width = (size_t)sink->document->base.width;
  cs_pixels_row(&sink->coding, spans, span_count, sink->row);
  if (sink->index > 0 || sink->rows.channels == 3)
    return;
  if (sink->coding.depth == CELSPAN_DEPTH_8)
    lay_over_white8(sink->row, width);
  else
    lay_over_white16(sink->row, width);
}

static uint64_t waiting_size(const cs_photoshop_rows *rows) {
  uint64_t size = 0;
  for (int c = 0; c < rows->channels; c++)
    size += cs_file_size(rows->waiting[c]);
  return size;
}

static celspan_status check_size(const photoshop_sink *sink, celspan_context *context) {
  const cs_photoshop *document = sink->document;
  uint64_t size = cs_file_size(document->file) + waiting_size(&sink->rows) +
                  waiting_size(&document->merged) + sink->rows.table_size;
  return size < INT32_MAX ? CELSPAN_OK
                          : cs_fail(context, CELSPAN_LIMIT,
                                    "%s: the file has 2 GiB or more, which is the limit of this "
                                    "format: write OpenEXR or PNG files, or a smaller --size",
                                    document->base.path);
}

/* Layers begin with alpha, and the merged picture ends with it. */
static int source_of(const photoshop_sink *sink, int channel) {
  return sink->index > 0 ? (channel + 3) % 4 : channel;
}

static celspan_status put_row(void *user, celspan_context *context, int32_t y,
                              const celspan_span *spans, size_t span_count) {
  photoshop_sink *sink = user;
  make_row(sink, spans, span_count);
  for (int c = 0; c < sink->rows.channels; c++) {
    take_plane(sink, source_of(sink, c));
    size_t packed = pack_bits(sink->plane, plane_size(sink), sink->packed);
    cs_bytes_put_big(sink->rows.table + 2 * (c * sink->document->base.height + y), packed, 2);
    CS_TRY(cs_file_write(sink->rows.waiting[c], context, sink->packed, packed));
  }
  return check_size(sink, context);
}

/* ---------------------------------------------------------------- channels */

static celspan_status put(void *document, const void *bytes, size_t size) {
  const cs_photoshop *to = document;
  return cs_file_write(to->file, to->base.context, bytes, size);
}

/* The way of packing, and the sizes of the packed rows of some channels. */
static celspan_status put_head(cs_photoshop *document, const unsigned char *table, size_t size) {
  static const unsigned char pack_bits_way[] = {0, 1};
  CS_TRY(put(document, pack_bits_way, sizeof pack_bits_way));
  return put(document, table, size);
}

static celspan_status put_rows(cs_photoshop *document, const cs_photoshop_rows *rows, int channel) {
  return cs_file_again(rows->waiting[channel], document->base.context, put, document);
}

static celspan_status put_layer(cs_photoshop *document, const cs_photoshop_rows *rows,
                                uint32_t sizes[CS_PHOTOSHOP_CHANNELS]) {
  size_t table = rows->table_size / CS_PHOTOSHOP_CHANNELS;
  for (int c = 0; c < CS_PHOTOSHOP_CHANNELS; c++) {
    uint64_t start = cs_file_size(document->file);
    CS_TRY(put_head(document, rows->table + (size_t)c * table, table));
    CS_TRY(put_rows(document, rows, c));
    sizes[c] = (uint32_t)(cs_file_size(document->file) - start);
  }
  return CELSPAN_OK;
}

static celspan_status put_merged(cs_photoshop *document) {
  const cs_photoshop_rows *rows = &document->merged;
  CS_TRY(put_head(document, rows->table, rows->table_size));
  for (int c = 0; c < rows->channels; c++)
    CS_TRY(put_rows(document, rows, c));
  return CELSPAN_OK;
}

static void finish_rows(celspan_context *context, cs_photoshop_rows *rows) {
  for (int c = 0; c < rows->channels; c++)
    cs_file_discard(rows->waiting[c], context);
  cs_mem_free(context->memory, rows->table, rows->table_size);
  *rows = (cs_photoshop_rows){0};
}

celspan_status cs_photoshop_end_merged(cs_photoshop *document, celspan_status outcome) {
  if (outcome == CELSPAN_OK)
    outcome = put_merged(document);
  finish_rows(document->base.context, &document->merged);
  return outcome;
}

/* ---------------------------------------------------------------- the sink */

static celspan_status begin(void *user, celspan_context *context, int32_t width, int32_t height) {
  photoshop_sink *sink = user;
  cs_photoshop_rows *rows = &sink->rows;
  sink->row_size = (size_t)width * cs_pixels_size(&sink->coding);
  rows->table_size = 2 * (size_t)height * (size_t)rows->channels;
  CS_TRY(CS_MAKE(context, sink->row, sink->row_size));
  CS_TRY(CS_MAKE(context, sink->plane, plane_size(sink)));
  CS_TRY(CS_MAKE(context, sink->packed, packed_size(sink)));
  CS_TRY(CS_MAKE(context, rows->table, rows->table_size));
  for (int c = 0; c < rows->channels; c++)
    CS_TRY(cs_file_create(context, NULL, sink->document->base.path, &rows->waiting[c]));
  return CELSPAN_OK;
}

/* The rows of the merged picture wait until the rows of all layers are in the document. */
static celspan_status end(void *user, celspan_context *context, celspan_status outcome) {
  photoshop_sink *sink = user;
  cs_photoshop *document = sink->document;
  if (outcome == CELSPAN_OK && sink->index > 0)
    outcome = put_layer(document, &sink->rows, document->sizes[sink->index - 1]);
  if (outcome == CELSPAN_OK && sink->index == 0) {
    document->merged = sink->rows;
    sink->rows = (cs_photoshop_rows){0};
  }
  finish_rows(context, &sink->rows);
  cs_mem_free(context->memory, sink->row, sink->row_size);
  cs_mem_free(context->memory, sink->plane, plane_size(sink));
  cs_mem_free(context->memory, sink->packed, packed_size(sink));
  cs_mem_free(context->memory, sink, sizeof *sink);
  return outcome;
}

celspan_status cs_photoshop_sink(cs_photoshop *document, size_t index, celspan_sink *out) {
  const bool has_alpha = index > 0 || !document->is_opaque;
  photoshop_sink *sink;
  CS_TRY(CS_MAKE(document->base.context, sink, 1));
  sink->document = document;
  sink->index = index;
  sink->rows.channels = has_alpha ? CS_PHOTOSHOP_CHANNELS : CS_PHOTOSHOP_CHANNELS - 1;
  sink->coding = document->base.coding;
  if (index == 0 && has_alpha)
    sink->coding.alpha = CS_ALPHA_CODED;
  *out = (celspan_sink){CS_SINK_CALLS, .user = sink,
                        .takes_codes = cs_pixels_takes_codes(&sink->coding)};
  return CELSPAN_OK;
}
