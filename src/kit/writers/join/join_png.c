/* PNG strips: their image data is a zlib stream each, of segments that end with whole bytes and
 * refer to nothing outside (output/deflate/deflate.h), so the segments of all strips make one
 * stream.
 *
 *   strip 0   header (2) | segments | last block, checksum (6)
 *   strip 1   header (2) | segments | last block, checksum (6)
 *                          |                               \
 *   file      header (2) | segments of 0 | segments of 1 | last block, checksum of all (6)
 *
 * The first row of a strip is filtered without the row above (output/sinks/strip.h), so filters
 * stay as they are. The checksum of the whole is computed from the checksums and sizes of the
 * strips (adler32_combine).
 *
 * Chunks are copied one for one, each with a checksum of its own; those before the image data come
 * from the first strip and must be the same in all.
 */
#include <string.h>
#include <zlib.h>

#include "inside/png.h"
#include "writers/join/format.h"

enum { SIDE_MOST = 1048576, SIZE_MOST = 0x7fffffff };

static const char IMAGE_DATA[] = "IDAT";

typedef struct chunk {
  uint64_t offset; /* the offset of its head */
  uint32_t size;   /* the size of its data */
  char type[5];
  unsigned char tail[CS_PNG_CHUNK_TAIL];
} chunk;

static uint64_t data_of(const chunk *c) { return c->offset + CS_PNG_CHUNK_HEAD; }

static uint64_t after(const chunk *c) { return data_of(c) + c->size + CS_PNG_CHUNK_TAIL; }

static bool is_a(const chunk *c, const char *type) { return memcmp(c->type, type, 4) == 0; }

static celspan_status read_chunk(celspan_context *context, const cs_join_part *part,
                                 uint64_t offset, chunk *out) {
  unsigned char head[CS_PNG_CHUNK_HEAD];
  CS_TRY(cs_join_part_read(context, part, offset, head, sizeof head));
  *out = (chunk){.offset = offset, .size = cs_png_load_32(head)};
  memcpy(out->type, head + 4, 4);
  if (out->size > SIZE_MOST)
    return cs_join_part_fail(context, part,
                             "byte %llu: there is no valid chunk; render the strip again",
                             (unsigned long long)offset);
  return cs_join_part_read(context, part, data_of(out) + out->size, out->tail, sizeof out->tail);
}

static bool claims(const unsigned char start[CS_JOIN_START]) {
  return memcmp(start, cs_png_signature, sizeof cs_png_signature) == 0;
}

/* ---------------------------------------------------------------- what a part is */

static celspan_status refuse(celspan_context *context, const cs_join_part *part, const char *why) {
  return cs_join_part_fail(context, part,
                           "is not a strip that celspan has written (%s): 'celspan render "
                           "--strip' makes them",
                           why);
}

/* 8 or 16 bits of RGB or RGBA, not interlaced. */
static celspan_status read_header(celspan_context *context, cs_join_part *part, const chunk *c) {
  unsigned char header[CS_PNG_HEADER];
  if (!is_a(c, "IHDR") || c->size != sizeof header)
    return refuse(context, part, "it does not begin with a header");
  CS_TRY(cs_join_part_read(context, part, data_of(c), header, sizeof header));
  uint32_t width = cs_png_load_32(header), height = cs_png_load_32(header + 4);
  if (width < 1 || height < 1 || width > SIDE_MOST || height > SIDE_MOST)
    return refuse(context, part, "its size");
  if ((header[8] != 8 && header[8] != 16) || (header[9] != 2 && header[9] != 6) || header[10] ||
      header[11] || header[12])
    return refuse(context, part, "its kind of pixels");
  part->width = (int32_t)width;
  part->height = (int32_t)height;
  cs_hash_word(&part->form, width);
  cs_hash_bytes(&part->form, header + 8, 5);
  return CELSPAN_OK;
}

static celspan_status read_place(celspan_context *context, cs_join_part *part, const chunk *c) {
  unsigned char place[8];
  if (c->size != sizeof place)
    return refuse(context, part, "its place");
  CS_TRY(cs_join_part_read(context, part, data_of(c), place, sizeof place));
  uint32_t row = cs_png_load_32(place), height = cs_png_load_32(place + 4);
  if (row > SIDE_MOST || height > SIDE_MOST)
    return refuse(context, part, "its place");
  part->strip = (cs_strip){(int32_t)row, (int32_t)height};
  return CELSPAN_OK;
}

/* Everything before the image data; *c: the first chunk of the data. All other chunks are compared
 * by their checksums. */
static celspan_status read_front(celspan_context *context, cs_join_part *part, chunk *c) {
  CS_TRY(read_chunk(context, part, CS_PNG_SIGNATURE, c));
  CS_TRY(read_header(context, part, c));
  for (;;) {
    CS_TRY(read_chunk(context, part, after(c), c));
    if (is_a(c, IMAGE_DATA))
      return CELSPAN_OK;
    if (is_a(c, "IEND"))
      return refuse(context, part, "it has no image data");
    if (is_a(c, CS_STRIP_MARK)) {
      CS_TRY(read_place(context, part, c));
      continue;
    }
    cs_hash_bytes(&part->form, c->type, 4);
    cs_hash_word(&part->form, c->size);
    cs_hash_bytes(&part->form, c->tail, sizeof c->tail);
  }
}

/* The image data, up to the end of the file. */
static celspan_status read_body(celspan_context *context, cs_join_part *part, chunk *c) {
  uint32_t last = 0, first = c->size;
  part->body = c->offset;
  while (is_a(c, IMAGE_DATA)) {
    last = c->size;
    CS_TRY(read_chunk(context, part, after(c), c));
  }
  part->body_end = c->offset;
  if (!is_a(c, "IEND") || c->size != 0 || after(c) != part->size)
    return refuse(context, part, "what follows the image data");
  if (first < CS_DEFLATE_HEADER || last < CS_DEFLATE_TRAILER)
    return refuse(context, part, "how its image data is divided");
  return CELSPAN_OK;
}

static celspan_status inspect(celspan_context *context, cs_join_part *part) {
  chunk c = {0};
  part->form = cs_hash_begin('P');
  CS_TRY(read_front(context, part, &c));
  if (part->strip.height == 0)
    return refuse(context, part, "it does not say which rows it has");
  CS_TRY(read_body(context, part, &c));
  part->form = cs_hash_end(part->form);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- copies of chunks */

/* The part of a chunk that is copied: its data, without `skipped` bytes at the start and `dropped`
 * bytes at the end, and then `more`. */
typedef struct copied {
  uint32_t skipped, dropped;
  const unsigned char *more;
  uint32_t more_size;
} copied;

/* Writes the bytes of a piece that are kept. at: the offset of the piece in the data. */
static celspan_status put_piece(cs_joining *joining, celspan_context *context, const copied *what,
                                uint32_t size, uint32_t at, uint32_t count, uLong *sum) {
  uint32_t from = at < what->skipped ? what->skipped : at, end = size - what->dropped;
  uint32_t to = at + count < end ? at + count : end;
  if (from >= to)
    return CELSPAN_OK;
  const unsigned char *bytes = joining->piece + (from - at);
  *sum = crc32_z(*sum, bytes, to - from);
  return cs_file_write(joining->file, context, bytes, to - from);
}

/* Verifies the checksum of the chunk that is read, and computes one for the chunk that is
 * written. */
static celspan_status copy_data(cs_joining *joining, celspan_context *context,
                                const cs_join_part *part, const chunk *c, const copied *what,
                                uLong *sum) {
  uLong was = crc32_z(0, (const unsigned char *)c->type, 4);
  for (uint32_t at = 0, count; at < c->size; at += count) {
    count = c->size - at < CS_JOIN_PIECE ? c->size - at : CS_JOIN_PIECE;
    CS_TRY(cs_join_part_read(context, part, data_of(c) + at, joining->piece, count));
    was = crc32_z(was, joining->piece, count);
    CS_TRY(put_piece(joining, context, what, c->size, at, count, sum));
  }
  if (was != cs_png_load_32(c->tail))
    return cs_join_part_fail(context, part,
                             "byte %llu: the checksum of a chunk is wrong; render "
                             "the strip again",
                             (unsigned long long)c->offset);
  return CELSPAN_OK;
}

static celspan_status copy_chunk(cs_joining *joining, celspan_context *context,
                                 const cs_join_part *part, const chunk *c, copied what) {
  unsigned char head[CS_PNG_CHUNK_HEAD], tail[CS_PNG_CHUNK_TAIL];
  uint32_t size = c->size - what.skipped - what.dropped + what.more_size;
  if (size == 0 && is_a(c, IMAGE_DATA))
    return CELSPAN_OK;
  uLong sum = crc32_z(0, (const unsigned char *)c->type, 4);
  cs_png_store_32(head, size);
  memcpy(head + 4, c->type, 4);
  CS_TRY(cs_file_write(joining->file, context, head, sizeof head));
  CS_TRY(copy_data(joining, context, part, c, &what, &sum));
  if (what.more_size > 0) /* zlib returns 0 if the bytes are NULL */
    sum = crc32_z(sum, what.more, what.more_size);
  cs_png_store_32(tail, (uint32_t)sum);
  CS_TRY(cs_file_write(joining->file, context, what.more, what.more_size));
  return cs_file_write(joining->file, context, tail, sizeof tail);
}

/* ---------------------------------------------------------------- the file */

/* The header, with the height of the whole picture. */
static celspan_status put_header(cs_joining *joining, celspan_context *context,
                                 const cs_join_part *first, const chunk *c) {
  unsigned char header[CS_PNG_HEADER];
  CS_TRY(cs_join_part_read(context, first, data_of(c), header, sizeof header));
  cs_png_store_32(header + 4, (uint32_t)first->strip.height);
  return cs_png_chunk_put(joining->file, context, "IHDR", header, sizeof header);
}

static celspan_status begin(cs_joining *joining, celspan_context *context,
                            const cs_join_part *first) {
  chunk c = {0};
  joining->sum = CS_DEFLATE_SUM_EMPTY;
  CS_TRY(cs_file_write(joining->file, context, cs_png_signature, sizeof cs_png_signature));
  CS_TRY(read_chunk(context, first, CS_PNG_SIGNATURE, &c));
  CS_TRY(put_header(joining, context, first, &c));
  for (uint64_t at = after(&c); at < first->body; at = after(&c)) {
    CS_TRY(read_chunk(context, first, at, &c));
    if (!is_a(&c, CS_STRIP_MARK))
      CS_TRY(copy_chunk(joining, context, first, &c, (copied){0}));
  }
  return CELSPAN_OK;
}

/* Bytes of the rows, each with the number of its filter. */
static celspan_status add_sum(cs_joining *joining, celspan_context *context,
                              const cs_join_part *part, const unsigned char *trailer) {
  unsigned char header[CS_PNG_HEADER];
  CS_TRY(cs_join_part_read(context, part, CS_PNG_SIGNATURE + CS_PNG_CHUNK_HEAD, header,
                           sizeof header));
  uint64_t pixel = header[8] / 8u * (header[9] == 6 ? 4u : 3u);
  cs_deflate_sum sum = {.adler = cs_png_load_32(trailer + 2),
                        .size = (1 + pixel * (uint64_t)part->width) * (uint64_t)part->height};
  joining->sum = cs_deflate_join(joining->sum, sum);
  return CELSPAN_OK;
}

/* The last chunk of a part, without the end of the part's stream. The last part gets the end of the
 * whole stream. */
static celspan_status add_last(cs_joining *joining, celspan_context *context,
                               const cs_join_part *part, const chunk *c, uint32_t skipped) {
  unsigned char trailer[CS_DEFLATE_TRAILER], own[CS_DEFLATE_TRAILER];
  CS_TRY(cs_join_part_read(context, part, data_of(c) + c->size - sizeof trailer, trailer,
                           sizeof trailer));
  cs_deflate_trailer((cs_deflate_sum){.adler = cs_png_load_32(trailer + 2)}, own);
  if (memcmp(trailer, own, sizeof own) != 0 || c->size < skipped + sizeof trailer)
    return refuse(context, part, "how its image data ends");
  CS_TRY(add_sum(joining, context, part, trailer));
  cs_deflate_trailer(joining->sum, own);
  bool is_end = part->strip.row + part->height == part->strip.height;
  copied what = {skipped, sizeof trailer, own, is_end ? sizeof own : 0};
  return copy_chunk(joining, context, part, c, what);
}

static celspan_status check_start(celspan_context *context, const cs_join_part *part) {
  unsigned char start[CS_DEFLATE_HEADER], own[CS_DEFLATE_HEADER];
  cs_deflate_header(own);
  CS_TRY(cs_join_part_read(context, part, part->body + CS_PNG_CHUNK_HEAD, start, sizeof start));
  return memcmp(start, own, sizeof own) == 0 ? CELSPAN_OK
                                             : refuse(context, part, "how its image data begins");
}

static celspan_status add(cs_joining *joining, celspan_context *context, const cs_join_part *part) {
  uint32_t skipped = part->strip.row > 0 ? CS_DEFLATE_HEADER : 0;
  chunk c = {0};
  CS_TRY(check_start(context, part));
  for (uint64_t at = part->body; at < part->body_end; at = after(&c), skipped = 0) {
    CS_TRY(read_chunk(context, part, at, &c));
    CS_TRY(after(&c) == part->body_end
               ? add_last(joining, context, part, &c, skipped)
               : copy_chunk(joining, context, part, &c, (copied){.skipped = skipped}));
  }
  return CELSPAN_OK;
}

static celspan_status end(cs_joining *joining, celspan_context *context) {
  return cs_png_chunk_put(joining->file, context, "IEND", "", 0);
}

const cs_join_format cs_join_png = {"PNG", {"png"}, claims, inspect, begin, add, end};
