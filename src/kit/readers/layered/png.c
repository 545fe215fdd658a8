#include "readers/layered/png.h"

#include <stdlib.h>
#include <string.h>

#include "common/bytes.h"
#include "readers/layered/contents.h"

enum { GREY = 0, RGB = 2, INDEXED = 3, GREY_ALPHA = 4, RGBA = 6 };

typedef struct png_source {
  cs_rows_source base;
  cs_zip_member member; /* without its name */
  int depth, colour;    /* as the header says */
  int channels;
} png_source;

typedef struct png_rows {
  cs_rows base;
  cs_stream chunks; /* reads the data of all IDAT chunks */
  cs_zip_stream member;
  cs_stream_inflate inflate;
  uint32_t left;                /* bytes left in the current IDAT chunk */
  bool is_ended;                /* the next chunk is not an IDAT */
  unsigned char *packed, *last; /* the current row and the row above, unfiltered; see packed_size */
  size_t packed_size;
  unsigned char colours[256][4];
  int colour_count;
  bool has_key; /* one colour is clear */
  uint16_t key[3];
} png_rows;

/* ---------------------------------------------------------------- the header */

static int channels_of(int colour) {
  return colour == RGB ? 3 : colour == RGBA ? 4 : colour == GREY_ALPHA ? 2 : 1;
}

static bool is_depth(int colour, int depth) {
  if (colour == GREY)
    return depth == 1 || depth == 2 || depth == 4 || depth == 8 || depth == 16;
  if (colour == INDEXED)
    return depth == 1 || depth == 2 || depth == 4 || depth == 8;
  return (colour == RGB || colour == GREY_ALPHA || colour == RGBA) && (depth == 8 || depth == 16);
}

static celspan_status fail(celspan_context *context, const cs_input *input, const char *name,
                           const char *sentence) {
  return cs_input_fail(context, input, -1, CELSPAN_INPUT, "%s: %s", name, sentence);
}

/* The signature and the chunk of the header. */
static celspan_status read_header(celspan_context *context, const cs_input *input, const char *name,
                                  const unsigned char head[33], png_source *source) {
  const unsigned char *header = head + 16;
  uint32_t width = cs_bytes_big32(header), height = cs_bytes_big32(header + 4);
  if (memcmp(head, "\x89PNG\r\n\x1a\n", 8) != 0 || memcmp(head + 12, "IHDR", 4) != 0)
    return fail(context, input, name, "is not a PNG picture");
  source->depth = header[8];
  source->colour = header[9];
  source->channels = channels_of(source->colour);
  if (!is_depth(source->colour, source->depth) || header[10] != 0 || header[11] != 0)
    return fail(context, input, name, "its PNG header is damaged");
  if (header[12] != 0)
    return fail(context, input, name, "is an interlaced PNG; only others are read in paintings");
  CS_TRY(cs_contents_check_size(context, input, name, width, height));
  source->base.width = (int32_t)width;
  source->base.height = (int32_t)height;
  source->base.bits = source->depth == 16 ? 16 : 8;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- chunks */

/* The head of the next chunk. */
static celspan_status next_chunk(png_rows *rows, celspan_context *context, char type[4]) {
  unsigned char head[8];
  CS_TRY(cs_stream_read(rows->member.bytes, context, head, sizeof head, "a PNG picture"));
  rows->left = cs_bytes_big32(head);
  memcpy(type, head + 4, 4);
  return CELSPAN_OK;
}

static celspan_status skip(png_rows *rows, celspan_context *context, size_t count) {
  unsigned char bytes[1024];
  for (size_t step; count > 0; count -= step) {
    step = count < sizeof bytes ? count : sizeof bytes;
    CS_TRY(cs_stream_read(rows->member.bytes, context, bytes, step, "a PNG picture"));
  }
  return CELSPAN_OK;
}

static celspan_status pull_data(cs_stream *stream, celspan_context *context, void *bytes,
                                size_t size, size_t *got) {
  png_rows *rows = (png_rows *)((char *)stream - offsetof(png_rows, chunks));
  char type[4];
  *got = 0;
  while (rows->left == 0 && !rows->is_ended) {
    CS_TRY(skip(rows, context, 4)); /* the checksum of the previous chunk */
    CS_TRY(next_chunk(rows, context, type));
    rows->is_ended = memcmp(type, "IDAT", 4) != 0;
  }
  if (rows->is_ended)
    return CELSPAN_OK;
  CS_TRY(rows->member.bytes->pull(rows->member.bytes, context, bytes,
                                  size < rows->left ? size : rows->left, got));
  rows->left -= (uint32_t)*got;
  return CELSPAN_OK;
}

static celspan_status read_colours(png_rows *rows, celspan_context *context) {
  unsigned char bytes[768];
  if (rows->left > sizeof bytes || rows->left % 3 != 0)
    return fail(context, rows->chunks.input, "a PNG picture", "its palette is damaged");
  CS_TRY(cs_stream_read(rows->member.bytes, context, bytes, rows->left, "a palette"));
  rows->colour_count = (int)(rows->left / 3);
  for (int i = 0; i < rows->colour_count; i++) {
    memcpy(rows->colours[i], bytes + 3 * i, 3);
    rows->colours[i][3] = 255;
  }
  return skip(rows, context, 4);
}

static celspan_status read_transparency(png_rows *rows, celspan_context *context, int colour) {
  unsigned char bytes[256];
  if (rows->left > sizeof bytes || (colour == GREY && rows->left < 2) ||
      (colour == RGB && rows->left < 6))
    return fail(context, rows->chunks.input, "a PNG picture", "its transparency is damaged");
  CS_TRY(cs_stream_read(rows->member.bytes, context, bytes, rows->left, "transparency"));
  for (uint32_t i = 0; colour == INDEXED && i < rows->left; i++)
    rows->colours[i][3] = bytes[i];
  rows->has_key = colour == GREY || colour == RGB;
  for (int c = 0; c < 3 && rows->has_key; c++)
    rows->key[c] = cs_bytes_big16(bytes + (colour == RGB ? 2 * c : 0));
  return skip(rows, context, 4);
}

/* Moves to the data of the first IDAT. */
static celspan_status find_data(png_rows *rows, celspan_context *context) {
  const png_source *source = (const png_source *)rows->base.source;
  char type[4];
  CS_TRY(skip(rows, context, 33));
  for (;;) {
    CS_TRY(next_chunk(rows, context, type));
    if (memcmp(type, "IDAT", 4) == 0)
      return CELSPAN_OK;
    if (memcmp(type, "IEND", 4) == 0)
      return fail(context, rows->chunks.input, "a PNG picture", "has no data");
    if (memcmp(type, "PLTE", 4) == 0)
      CS_TRY(read_colours(rows, context));
    else if (memcmp(type, "tRNS", 4) == 0)
      CS_TRY(read_transparency(rows, context, source->colour));
    else
      CS_TRY(skip(rows, context, (size_t)rows->left + 4));
  }
}

/* ---------------------------------------------------------------- rows */

static unsigned char nearest(int left, int above, int corner) {
  int guess = left + above - corner;
  int to_left = abs(guess - left), to_above = abs(guess - above), to_corner = abs(guess - corner);
  if (to_left <= to_above && to_left <= to_corner)
    return (unsigned char)left;
  return (unsigned char)(to_above <= to_corner ? above : corner);
}

/* Adds the prediction of the filter to each byte; false: an unknown filter. step: the bytes of a
 * pixel, at least 1. The bytes to the left of the first pixel are 0. Source: PNG (Third Edition),
 * 9.2. */
static bool unfilter(int filter, unsigned char *row, const unsigned char *last, size_t size,
                     size_t step) {
  size_t first = step < size ? step : size;
  for (size_t i = 0; i < first && filter > 1; i++)
    row[i] = (unsigned char)(row[i] + (filter == 3 ? last[i] / 2 : last[i]));
  switch (filter) {
  case 1:
    for (size_t i = first; i < size; i++)
      row[i] = (unsigned char)(row[i] + row[i - step]);
    break;
  case 2:
    for (size_t i = first; i < size; i++)
      row[i] = (unsigned char)(row[i] + last[i]);
    break;
  case 3:
    for (size_t i = first; i < size; i++)
      row[i] = (unsigned char)(row[i] + (row[i - step] + last[i]) / 2);
    break;
  case 4:
    for (size_t i = first; i < size; i++)
      row[i] = (unsigned char)(row[i] + nearest(row[i - step], last[i], last[i - step]));
    break;
  default:
    break;
  }
  return filter >= 0 && filter < 5;
}

/* The coded value i of a row. */
static uint16_t value_of(const unsigned char *row, size_t i, int depth) {
  if (depth == 16)
    return cs_bytes_big16(row + 2 * i);
  if (depth == 8)
    return row[i];
  size_t place = i * (size_t)depth;
  return (uint16_t)(row[place / 8] >> (8 - depth - (int)(place % 8)) & ((1 << depth) - 1));
}

static void pixel_of(const png_rows *rows, size_t x, uint16_t rgba[4]) {
  const png_source *source = (const png_source *)rows->base.source;
  int channels = source->channels, depth = source->depth, most = (1 << depth) - 1;
  uint16_t values[4] = {0};
  for (int c = 0; c < channels; c++)
    values[c] = value_of(rows->packed + 1, x * (size_t)channels + (size_t)c, depth);
  if (source->colour == INDEXED) {
    for (int c = 0; c < 4; c++)
      rgba[c] = rows->colours[values[0]][c];
    return;
  }
  bool is_grey = channels < 3;
  for (int c = 0; c < 3; c++)
    rgba[c] = values[is_grey ? 0 : c];
  bool is_clear = rows->has_key && rgba[0] == rows->key[0] && rgba[1] == rows->key[1] &&
                  rgba[2] == rows->key[2];
  rgba[3] = channels % 2 == 0 ? values[channels - 1] : is_clear ? 0 : (uint16_t)most;
  for (int c = 0; c < 4 && depth < 8; c++) /* to 8 bits */
    rgba[c] = (uint16_t)(rgba[c] * (255 / most));
}

/* Rows of the two common forms: 8 bits and three or four channels; false: the form is different. */
static bool put_plain_row(const png_rows *rows, unsigned char *out) {
  const png_source *source = (const png_source *)rows->base.source;
  const unsigned char *from = rows->packed + 1;
  if (source->depth != 8 || (source->colour != RGBA && source->colour != RGB) || rows->has_key)
    return false;
  if (source->colour == RGBA)
    memcpy(out, from, cs_rows_size(&source->base));
  for (int32_t x = 0; x < source->base.width && source->colour == RGB; x++) {
    memcpy(out + 4 * (size_t)x, from + 3 * (size_t)x, 3);
    out[4 * (size_t)x + 3] = 255;
  }
  return true;
}

static void put_row(const png_rows *rows, void *out) {
  const cs_rows_source *source = rows->base.source;
  uint16_t rgba[4];
  for (size_t x = 0; x < (size_t)source->width; x++) {
    pixel_of(rows, x, rgba);
    if (source->bits == 16)
      memcpy((unsigned char *)out + 8 * x, rgba, sizeof rgba);
    for (size_t c = 0; c < 4 && source->bits == 8; c++)
      ((unsigned char *)out)[4 * x + c] = (unsigned char)rgba[c];
  }
}

static celspan_status next(cs_rows *base, celspan_context *context, void *row) {
  png_rows *rows = (png_rows *)base;
  const png_source *source = (const png_source *)base->source;
  size_t bits = (size_t)source->channels * (size_t)source->depth;
  CS_TRY(cs_stream_read(&rows->inflate.base, context, rows->packed, rows->packed_size,
                        "the data of a PNG picture"));
  if (!unfilter(rows->packed[0], rows->packed + 1, rows->last + 1, rows->packed_size - 1,
                bits < 8 ? 1 : bits / 8))
    return fail(context, rows->chunks.input, "a PNG picture", "a row has an unknown filter");
  if (!put_plain_row(rows, row))
    put_row(rows, row);
  unsigned char *above = rows->last;
  rows->last = rows->packed;
  rows->packed = above;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- life */

static void free_rows(cs_rows *base) {
  png_rows *rows = (png_rows *)base;
  cs_memory *memory = base->memory;
  cs_mem_free(memory, rows->packed, rows->packed_size);
  cs_mem_free(memory, rows->last, rows->packed_size);
  cs_mem_free(memory, rows, sizeof *rows);
}

static void end(cs_rows *base) {
  png_rows *rows = (png_rows *)base;
  cs_stream_inflate_finish(&rows->inflate);
  cs_zip_close(&rows->member);
  free_rows(base);
}

static celspan_status open(png_rows *rows, celspan_context *context, const cs_input *input) {
  const png_source *source = (const png_source *)rows->base.source;
  CS_TRY(cs_zip_open(context, input, &source->member, &rows->member));
  rows->chunks = (cs_stream){pull_data, input};
  celspan_status status = find_data(rows, context);
  if (status == CELSPAN_OK)
    status = cs_stream_inflate_init(&rows->inflate, context, &rows->chunks, CS_STREAM_ZLIB);
  if (status != CELSPAN_OK)
    cs_zip_close(&rows->member);
  return status;
}

static celspan_status begin(const cs_rows_source *base, celspan_context *context,
                            const cs_input *input, cs_rows **out) {
  const png_source *source = (const png_source *)base;
  size_t bits = (size_t)source->channels * (size_t)source->depth;
  png_rows *rows = cs_mem_array(base->memory, 1, sizeof *rows);
  if (!rows)
    return cs_fail_memory(context);
  rows->base = (cs_rows){base, base->memory};
  rows->packed_size = 1 + ((size_t)base->width * bits + 7) / 8;
  rows->packed = cs_mem_array(base->memory, rows->packed_size, 1);
  rows->last = cs_mem_array(base->memory, rows->packed_size, 1);
  celspan_status status =
      rows->packed && rows->last ? open(rows, context, input) : cs_fail_memory(context);
  return CS_GIVE(status, &rows->base, free_rows, out);
}

static void destroy(cs_rows_source *source) {
  cs_mem_free(source->memory, source, sizeof(png_source));
}

static const cs_rows_kind kind = {begin, next, end, destroy};

celspan_status cs_png_create(celspan_context *context, const cs_input *input,
                             const cs_zip_member *member, cs_rows_source **out) {
  cs_zip_stream stream;
  unsigned char head[33];
  CS_TRY(cs_zip_open(context, input, member, &stream));
  celspan_status status = cs_stream_read(stream.bytes, context, head, sizeof head, "a PNG picture");
  cs_zip_close(&stream);
  CS_TRY(status);
  png_source found = {.base = {.kind = &kind, .memory = context->memory}, .member = *member};
  CS_TRY(read_header(context, input, member->name, head, &found));
  found.member.name = "a PNG picture"; /* the archive's table is freed after reading */
  png_source *source;
  CS_TRY(CS_MAKE(context, source, 1));
  *source = found;
  *out = &source->base;
  return CELSPAN_OK;
}
