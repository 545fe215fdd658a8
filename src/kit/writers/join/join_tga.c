/* Targa strips: packets end with their row, so bodies are copied one after another without
 * changes. */
#include <string.h>

#include "writers/join/format.h"

enum { BODY = CS_TGA_HEADER + CS_TGA_PLACE, END = CS_TGA_EXTENSION + CS_TGA_FOOTER };

static bool claims(const unsigned char start[CS_JOIN_START]) {
  bool is_flat = start[17] == 0x28 || start[17] == 0x20;
  return start[0] == CS_TGA_PLACE && start[1] == 0 && start[2] == 10 && is_flat &&
         memcmp(start + CS_TGA_HEADER, CS_STRIP_MARK, 4) == 0;
}

/* The extension is directly before the footer, which points to it. */
static celspan_status read_end(celspan_context *context, cs_join_part *part) {
  unsigned char end[END];
  CS_TRY(cs_join_part_read(context, part, part->size < END ? part->size : part->size - END, end,
                           sizeof end));
  const unsigned char *footer = end + CS_TGA_EXTENSION;
  if (memcmp(footer + 8, CS_TGA_SIGNATURE, sizeof CS_TGA_SIGNATURE) != 0)
    return cs_join_part_fail(context, part,
                             "is truncated: it has no footer; render the strip "
                             "again");
  part->body = BODY;
  part->body_end = cs_tga_load_32(footer);
  if (part->body_end == 0)
    return cs_join_part_fail(context, part, "has more than 4 GiB of rows: make more strips");
  if (part->body_end < BODY || part->body_end + END != part->size)
    return cs_join_part_fail(context, part,
                             "its footer declares %llu bytes of rows, but the file has %llu "
                             "bytes: render the strip again",
                             (unsigned long long)part->body_end, (unsigned long long)part->size);
  cs_hash_bytes(&part->form, end, CS_TGA_EXTENSION);
  return CELSPAN_OK;
}

static celspan_status inspect(celspan_context *context, cs_join_part *part) {
  unsigned char start[BODY];
  CS_TRY(cs_join_part_read(context, part, 0, start, sizeof start));
  part->width = (int32_t)cs_tga_load_16(start + 12);
  part->height = (int32_t)cs_tga_load_16(start + 14);
  uint32_t row = cs_tga_load_32(start + 22), height = cs_tga_load_32(start + 26);
  if (row > CS_TGA_SIDE_MOST || height > CS_TGA_SIDE_MOST)
    return cs_join_part_fail(context, part, "declares row %u of %u: Targa files have at most %d",
                             (unsigned)row, (unsigned)height, CS_TGA_SIDE_MOST);
  part->strip = (cs_strip){(int32_t)row, (int32_t)height};
  part->form = cs_hash_begin('T');
  cs_hash_bytes(&part->form, start, 14);
  cs_hash_bytes(&part->form, start + 16, 2);
  CS_TRY(read_end(context, part));
  part->form = cs_hash_end(part->form);
  return CELSPAN_OK;
}

static celspan_status begin(cs_joining *joining, celspan_context *context,
                            const cs_join_part *first) {
  unsigned char header[CS_TGA_HEADER];
  CS_TRY(cs_join_part_read(context, first, 0, header, sizeof header));
  CS_TRY(cs_join_part_read(context, first, first->body_end, joining->extension,
                           sizeof joining->extension));
  header[0] = 0;
  cs_tga_store_16(header + 14, (unsigned)first->strip.height);
  return cs_file_write(joining->file, context, header, sizeof header);
}

static celspan_status add(cs_joining *joining, celspan_context *context, const cs_join_part *part) {
  for (uint64_t at = part->body, size; at < part->body_end; at += size) {
    uint64_t left = part->body_end - at;
    size = left < CS_JOIN_PIECE ? left : CS_JOIN_PIECE;
    CS_TRY(cs_join_part_read(context, part, at, joining->piece, (size_t)size));
    CS_TRY(cs_file_write(joining->file, context, joining->piece, (size_t)size));
  }
  return CELSPAN_OK;
}

static celspan_status end(cs_joining *joining, celspan_context *context) {
  return cs_tga_put_end(joining->file, context, joining->extension);
}

const cs_join_format cs_join_tga = {"Targa", {"tga", "targa"}, claims, inspect, begin, add, end};
