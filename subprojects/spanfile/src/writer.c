/* Rows to records:
 *
 *   runs, pixels --pack--> row --fit to the row above--> record 'P', 'M' or 'S' --> buffer -->
 * write
 *                           |
 *                       key rows --> node of level 0 --full--> node of level 1 --full--> ...
 *                                    512 entries               an entry for each node below
 *
 * A row that can be read first (a key row), and one that has other spans than the row above, is
 * written whole, as 'P'. For others the end of each span is stored as a difference of its move: how
 * far the end lies from that in the row above, less the same of the row before.
 *
 *   row 7   |------20       moves      differences
 *   row 8   |-------22         2
 *   row 9   |---------24       2       0: an edge that goes straight on costs two bits a row
 *
 * INVARIANT: memory does not grow with the height. A node of the index is written when it is full.
 */
#include "crc32c.h"
#include "fit.h"
#include "pack.h"
#include "store.h"

enum {
  BUFFER_BYTES = 256 * 1024,
  HEAD_BYTES = 1 + SF_LENGTH_BYTES,
  /* The codes for differences of -1, 0, 1 and others: two bits each, the first lowest. */
  MOVE_CODES = 0xd2
};

typedef struct index_node {
  uint32_t count;
  unsigned char entries[SF_NODE_ENTRIES * SF_ENTRY_BYTES];
} index_node;

struct spanfile_writer {
  sf_memory memory;
  bool (*write)(void *user, const void *bytes, size_t size);
  void *user;
  uint32_t width, height;
  spanfile_format format;
  size_t pixel_size;
  spanfile_status status;
  uint64_t y;        /* complete rows; more than height: finished */
  sf_row row, above; /* the current row, and the last complete one */
  sf_row fitted;
  int64_t *moves; /* of the ends in `above`, from the row above that */
  size_t move_capacity;
  sf_bytes record; /* room for the head, HEAD_BYTES, then the payload */
  uint32_t key_row;
  uint64_t key_offset;
  uint64_t flushed; /* bytes that were passed to `write` */
  size_t buffered;
  index_node nodes[SF_LEVELS];
  unsigned char buffer[BUFFER_BYTES];
};

static spanfile_status fail(spanfile_writer *writer, spanfile_status status) {
  if (writer->status == SPANFILE_OK)
    writer->status = status;
  return writer->status;
}

/* ---------------------------------------------------------------- bytes */

static uint64_t position(const spanfile_writer *writer) {
  return writer->flushed + writer->buffered;
}

static bool write_out(spanfile_writer *writer, const void *bytes, size_t size) {
  if (size > 0 && !writer->write(writer->user, bytes, size)) {
    fail(writer, SPANFILE_WRITE_FAILED);
    return false;
  }
  writer->flushed += size;
  return true;
}

static bool flush(spanfile_writer *writer) {
  size_t size = writer->buffered;
  writer->buffered = 0;
  return write_out(writer, writer->buffer, size);
}

static bool put(spanfile_writer *writer, const void *bytes, size_t size) {
  if (size > BUFFER_BYTES - writer->buffered && !flush(writer))
    return false;
  if (size > BUFFER_BYTES)
    return write_out(writer, bytes, size);
  memcpy(writer->buffer + writer->buffered, bytes, size);
  writer->buffered += size;
  return true;
}

/* ---------------------------------------------------------------- records */

/* Empties the record and makes room for a payload. */
static bool begin_record(spanfile_writer *writer, size_t payload) {
  writer->record.size = 0;
  if (!sf_bytes_room(&writer->memory, &writer->record, HEAD_BYTES + payload + SF_CHECK_BYTES)) {
    fail(writer, SPANFILE_NO_MEMORY);
    return false;
  }
  writer->record.size = HEAD_BYTES;
  return true;
}

/* Completes the record with kind and length before the payload and the checksum after it, and puts
 * it into the file. */
static bool put_record(spanfile_writer *writer, unsigned char kind, uint32_t row) {
  unsigned char head[1 + 10], *start;
  size_t payload = writer->record.size - HEAD_BYTES;
  head[0] = kind;
  size_t head_size = 1 + sf_store_varint(head + 1, payload);
  start = writer->record.at + HEAD_BYTES - head_size;
  memcpy(start, head, head_size);
  size_t size = head_size + payload;
  sf_store_32(start + size, sf_crc32c_record(row, start, size));
  return put(writer, start, size + SF_CHECK_BYTES);
}

/* ---------------------------------------------------------------- the index */

static bool put_node(spanfile_writer *writer, int level, uint64_t *offset) {
  index_node *node = &writer->nodes[level];
  size_t size = node->count * (size_t)SF_ENTRY_BYTES;
  if (!begin_record(writer, 4 + size))
    return false;
  unsigned char *payload = writer->record.at + HEAD_BYTES;
  sf_store_32(payload, (uint32_t)level);
  memcpy(payload + 4, node->entries, size);
  writer->record.size += 4 + size;
  *offset = position(writer);
  return put_record(writer, SF_INDEX, SF_INDEX_ROW);
}

static void add_entry(index_node *node, uint32_t row, uint64_t offset) {
  unsigned char *entry = node->entries + node->count++ * (size_t)SF_ENTRY_BYTES;
  sf_store_32(entry, row);
  sf_store_64(entry + 4, offset);
}

/* Writes a full node and adds an entry for it to the node one level higher, which has room. */
static bool pass_on(spanfile_writer *writer, int level) {
  uint64_t offset;
  index_node *node = &writer->nodes[level];
  if (!put_node(writer, level, &offset))
    return false;
  add_entry(&writer->nodes[level + 1], sf_load_32(node->entries), offset);
  node->count = 0;
  return true;
}

/* Room for one more key row in the lowest node. */
static bool make_room(spanfile_writer *writer) {
  int full = 0;
  while (full < SF_LEVELS - 1 && writer->nodes[full].count == SF_NODE_ENTRIES)
    full++;
  for (int level = full - 1; level >= 0; level--)
    if (!pass_on(writer, level))
      return false;
  return true;
}

static bool note_key(spanfile_writer *writer) {
  if (!make_room(writer))
    return false;
  writer->key_row = (uint32_t)writer->y;
  writer->key_offset = position(writer);
  add_entry(&writer->nodes[0], writer->key_row, writer->key_offset);
  return true;
}

/* Writes the nodes that are not full, the lowest first; the last one is the root. */
static bool finish_index(spanfile_writer *writer, uint64_t *root, int *levels) {
  int top = SF_LEVELS - 1;
  while (top > 0 && writer->nodes[top].count == 0)
    top--;
  for (int level = 0; level < top; level++)
    if (writer->nodes[level].count > 0 && !pass_on(writer, level))
      return false;
  *levels = top + 1;
  return put_node(writer, top, root);
}

/* ---------------------------------------------------------------- a row as packets */

static void add_head(sf_bytes *record, uint32_t kind, uint32_t count) {
  unsigned char *at = record->at + record->size;
  at[0] = (unsigned char)kind;
  at[1] = (unsigned char)(count - 1);
  at[2] = (unsigned char)((count - 1) >> 8);
  record->size += 3;
}

static size_t add_span(spanfile_writer *writer, const spanfile_span *span, uint32_t length,
                       const unsigned char *values) {
  size_t used = 0;
  for (uint32_t done = 0; done < length; done += SF_PACKET_MOST) {
    uint32_t count = length - done < SF_PACKET_MOST ? length - done : SF_PACKET_MOST;
    uint32_t pixels = span->kind == SPANFILE_RAW ? count : span->kind == SPANFILE_RUN ? 1 : 2;
    sf_bytes *record = &writer->record;
    add_head(record, span->kind, count);
    size_t size = pixels * writer->pixel_size;
    if (span->kind == SPANFILE_RUN) {
      sf_store_pixel(record->at + record->size, writer->pixel_size, span->pixel);
    } else {
      memcpy(record->at + record->size, values + used, size);
      used += size;
    }
    record->size += size;
  }
  return used;
}

static bool put_packets(spanfile_writer *writer) {
  const sf_row *row = &writer->row;
  size_t packets = row->count + writer->width / SF_PACKET_MOST;
  if (!begin_record(writer, packets * (3 + writer->pixel_size) + row->values.size))
    return false;
  const unsigned char *values = sf_bytes_start(&row->values);
  uint32_t start = 0;
  for (size_t i = 0; i < row->count; i++) {
    const spanfile_span *span = &row->spans[i];
    values += add_span(writer, span, span->end - start, values);
    start = span->end;
  }
  return put_record(writer, SF_PACKETS, (uint32_t)writer->y);
}

/* ---------------------------------------------------------------- a row as moves */

static bool has_same_values(const sf_row *row, const sf_row *above) {
  return row->values.size == above->values.size &&
         (row->values.size == 0 || memcmp(row->values.at, above->values.at, row->values.size) == 0);
}

/* Puts the codes of all ends but the last, and the differences that have no code after them.
 * Returns whether any end moved. */
static bool add_moves(spanfile_writer *writer) {
  size_t count = writer->row.count - 1;
  const spanfile_span *now = writer->row.spans, *before = writer->above.spans;
  unsigned char *codes = writer->record.at + HEAD_BYTES, *more = codes + (count + 3) / 4;
  uint64_t moved = 0;
  unsigned byte = 0;
  for (size_t i = 0; i < count; i++) {
    int64_t move = (int64_t)now[i].end - (int64_t)before[i].end, rest = move - writer->moves[i];
    uint64_t index = (uint64_t)(rest + 1);
    unsigned code = MOVE_CODES >> 2 * (index < 3 ? index : 3) & 3;
    writer->moves[i] = move;
    moved |= (uint64_t)move;
    if (code == 3)
      more += sf_store_varint(more, sf_zigzag(rest));
    byte |= code << 2 * (i % 4);
    if (i % 4 == 3 || i + 1 == count) {
      *codes++ = (unsigned char)byte;
      byte = 0;
    }
  }
  writer->record.size = (size_t)(more - writer->record.at);
  return moved != 0;
}

static bool put_moves(spanfile_writer *writer) {
  enum { MOVE_BYTES = 6 }; /* two bits, and a varint of a difference of 34 bits */
  const sf_bytes *values = &writer->row.values;
  if (!begin_record(writer, writer->row.count * MOVE_BYTES + values->size))
    return false;
  bool is_moved = add_moves(writer);
  if (!is_moved && has_same_values(&writer->row, &writer->above)) {
    writer->record.size = HEAD_BYTES;
    return put_record(writer, SF_SAME, (uint32_t)writer->y);
  }
  if (values->size > 0)
    memcpy(writer->record.at + writer->record.size, values->at, values->size);
  writer->record.size += values->size;
  return put_record(writer, SF_MOVED, (uint32_t)writer->y);
}

/* ---------------------------------------------------------------- rows */

static bool is_key_due(const spanfile_writer *writer) {
  return writer->y == 0 || writer->y - writer->key_row >= SF_KEY_ROWS ||
         position(writer) - writer->key_offset >= SF_KEY_BYTES;
}

static bool clear_moves(spanfile_writer *writer) {
  size_t count = writer->row.count;
  if (count > writer->move_capacity) {
    sf_release(&writer->memory, writer->moves, writer->move_capacity * sizeof *writer->moves);
    writer->move_capacity = 0;
    writer->moves = sf_allocate(&writer->memory, 2 * count * sizeof *writer->moves);
    if (!writer->moves) {
      fail(writer, SPANFILE_NO_MEMORY);
      return false;
    }
    writer->move_capacity = 2 * count;
  }
  memset(writer->moves, 0, count * sizeof *writer->moves);
  return true;
}

/* Whether the row has, or can be given, the spans of the row above. */
static bool fit_above(spanfile_writer *writer) {
  if (sf_fit_is_alike(&writer->row, &writer->above))
    return true;
  sf_fitted fitted =
      sf_fit(&writer->memory, writer->format, &writer->row, &writer->above, &writer->fitted);
  if (fitted == SF_FIT_NO_MEMORY)
    fail(writer, SPANFILE_NO_MEMORY);
  if (fitted == SF_FIT_ALIKE || fitted == SF_FIT_NEAR) {
    sf_row row = writer->row;
    writer->row = writer->fitted;
    writer->fitted = row;
  }
  return fitted == SF_FIT_ALIKE;
}

static bool put_row(spanfile_writer *writer) {
  if (is_key_due(writer)) /* the row itself, which has not been fitted to rows above */
    return note_key(writer) && put_packets(writer) && clear_moves(writer);
  if (fit_above(writer))
    return put_moves(writer);
  return writer->status == SPANFILE_OK && put_packets(writer) && clear_moves(writer);
}

static bool has_room(const spanfile_writer *writer, uint64_t count) {
  return writer->y < writer->height && count <= writer->width - sf_row_end(&writer->row);
}

spanfile_status spanfile_writer_runs(spanfile_writer *writer, const spanfile_run *runs,
                                     size_t run_count) {
  uint64_t count = 0;
  bool has_empty = false;
  for (size_t i = 0; i < run_count; i++) {
    count += runs[i].count;
    has_empty |= runs[i].count == 0;
  }
  if (writer->status != SPANFILE_OK)
    return writer->status;
  if (has_empty || !has_room(writer, count))
    return fail(writer, SPANFILE_BAD_ARGUMENT);
  return sf_pack_runs(&writer->memory, &writer->row, writer->pixel_size, runs, run_count)
             ? SPANFILE_OK
             : fail(writer, SPANFILE_NO_MEMORY);
}

spanfile_status spanfile_writer_run(spanfile_writer *writer, uint32_t count, uint64_t pixel) {
  spanfile_run run = {count, pixel};
  return spanfile_writer_runs(writer, &run, count > 0);
}

spanfile_status spanfile_writer_pixels(spanfile_writer *writer, const void *pixels,
                                       uint32_t count) {
  if (writer->status != SPANFILE_OK || count == 0)
    return writer->status;
  if (!has_room(writer, count))
    return fail(writer, SPANFILE_BAD_ARGUMENT);
  return sf_pack_pixels(&writer->memory, &writer->row, writer->format, pixels, count)
             ? SPANFILE_OK
             : fail(writer, SPANFILE_NO_MEMORY);
}

spanfile_status spanfile_writer_row(spanfile_writer *writer) {
  if (writer->status != SPANFILE_OK)
    return writer->status;
  if (writer->y >= writer->height || sf_row_end(&writer->row) != writer->width)
    return fail(writer, SPANFILE_BAD_ARGUMENT);
  if (!put_row(writer))
    return writer->status;
  sf_row above = writer->above;
  writer->above = writer->row;
  writer->row = above;
  sf_row_clear(&writer->row);
  writer->y++;
  return SPANFILE_OK;
}

/* ---------------------------------------------------------------- beginning and end */

static bool put_header(spanfile_writer *writer) {
  unsigned char header[SF_HEADER_BYTES] = {0};
  header[0] = SF_ID_BYTES;
  header[2] = SF_IMAGE_TYPE;
  header[16] = (unsigned char)(8 * writer->pixel_size);
  header[17] = 0x20 | (writer->format == SPANFILE_SRGB8 ? 8 : 0); /* from the top; bits of alpha */
  memcpy(header + 18, sf_magic, sizeof sf_magic);
  sf_store_32(header + 26, writer->width);
  sf_store_32(header + 30, writer->height);
  sf_store_32(header + 34, writer->format);
  sf_store_32(header + 42, sf_crc32c(0, header, 42));
  return put(writer, header, sizeof header);
}

static bool put_end(spanfile_writer *writer, uint64_t root, int levels) {
  unsigned char trailer[SF_TRAILER_BYTES] = {0};
  memcpy(trailer, sf_end_magic, sizeof sf_end_magic);
  sf_store_64(trailer + 8, root);
  sf_store_64(trailer + 16, position(writer) + SF_END_BYTES);
  sf_store_32(trailer + 24, writer->height);
  sf_store_32(trailer + 28, (uint32_t)levels);
  sf_store_32(trailer + 36, sf_crc32c(0, trailer, 36));
  return put(writer, trailer, sizeof trailer) && put(writer, sf_footer, sizeof sf_footer);
}

spanfile_status spanfile_writer_create(const spanfile_writer_desc *desc, spanfile_writer **out) {
  bool has_format = desc->format == SPANFILE_SRGB8 || desc->format == SPANFILE_HALF;
  if (desc->width == 0 || desc->height == 0 || !has_format || !desc->write)
    return SPANFILE_BAD_ARGUMENT;
  sf_memory memory = sf_memory_of(desc->resize, desc->resize_user);
  spanfile_writer *writer = sf_allocate(&memory, sizeof *writer);
  if (!writer)
    return SPANFILE_NO_MEMORY;
  memset(writer, 0, offsetof(spanfile_writer, nodes));
  for (int level = 0; level < SF_LEVELS; level++)
    writer->nodes[level].count = 0;
  writer->memory = memory;
  writer->write = desc->write;
  writer->user = desc->user;
  writer->width = desc->width;
  writer->height = desc->height;
  writer->format = desc->format;
  writer->pixel_size = spanfile_pixel_size(desc->format);
  (void)put_header(writer); /* fits the buffer */
  *out = writer;
  return SPANFILE_OK;
}

spanfile_status spanfile_writer_finish(spanfile_writer *writer) {
  uint64_t root;
  int levels;
  if (writer->status != SPANFILE_OK)
    return writer->status;
  if (writer->y != writer->height || writer->row.count > 0)
    return fail(writer, SPANFILE_BAD_ARGUMENT);
  if (finish_index(writer, &root, &levels) && put_end(writer, root, levels))
    (void)flush(writer);
  writer->y = (uint64_t)writer->height + 1; /* nothing may follow */
  return writer->status;
}

void spanfile_writer_destroy(spanfile_writer *writer) {
  if (!writer)
    return;
  sf_memory memory = writer->memory;
  sf_row_free(&memory, &writer->row);
  sf_row_free(&memory, &writer->above);
  sf_row_free(&memory, &writer->fitted);
  sf_release(&memory, writer->moves, writer->move_capacity * sizeof *writer->moves);
  sf_bytes_free(&memory, &writer->record);
  sf_release(&memory, writer, sizeof *writer);
}
