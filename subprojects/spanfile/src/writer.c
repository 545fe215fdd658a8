/* Rows to records:
 *
 *   runs, pixels --pack--> row --fit to the row above--> record 'P', 'M' or 'S' --> output.h
 *
 * A row that can be read first (a key row), and one that has other spans than the row above, is
 * written whole, as 'P'. For others the end of each span is stored as a difference of its move: the
 * distance of the end from that in the row above, minus the same for the row before.
 *
 *   row 7   |------20       moves      differences
 *   row 8   |-------22         2
 *   row 9   |---------24       2       0: an edge that goes straight on costs two bits a row
 *
 * Every SF_KEY_ROWS rows there is a key row, whatever came before, so the rows from there to the
 * next such row are the same bytes wherever they are packed: as a part, by a writer of its own that
 * has no file, and the bytes are joined to a file later.
 *
 *   part 0 |key ... key .....|                      keys: entries for the index when it is joined
 *   part 1                   |key .........|
 *   file   header |bytes of part 0| node |bytes of part 1| ... trailer
 */
#include "fit.h"
#include "output.h"
#include "pack.h"
#include "store.h"

enum {
  /* The codes for differences of -1, 0, 1 and others: two bits each, the first lowest. */
  MOVE_CODES = 0xd2
};

/* Where the records of a part go. */
typedef struct part_bytes {
  uint32_t first; /* row */
  uint32_t key_count;
  uint32_t key_rows[SF_KEY_ROWS];
  uint64_t key_offsets[SF_KEY_ROWS];
  sf_bytes bytes;
} part_bytes;

struct spanfile_writer {
  sf_memory memory;
  sf_output *output; /* NULL: a part */
  part_bytes *part;  /* NULL: a file */
  uint32_t width, height, strip_height;
  spanfile_format format;
  size_t pixel_size;
  spanfile_status status;
  uint32_t end;      /* the row before which the file or the part ends */
  uint64_t y;        /* complete rows; more than end: finished */
  sf_row row, above; /* the current row, and the last complete one */
  sf_row fitted;
  int64_t *moves; /* of the ends in `above`, from the row above that */
  size_t move_capacity;
  sf_bytes record;     /* room for the head, SF_HEAD_BYTES, then the payload */
  uint64_t key_offset; /* the key offset of the latest key row */
};

static spanfile_status fail(spanfile_writer *writer, spanfile_status status) {
  if (writer->status == SPANFILE_OK)
    writer->status = status;
  return writer->status;
}

/* ---------------------------------------------------------------- bytes */

static uint64_t position(const spanfile_writer *writer) {
  return writer->part ? writer->part->bytes.size : sf_output_position(writer->output);
}

static bool put(spanfile_writer *writer, const void *bytes, size_t size) {
  bool is_put = writer->part ? sf_bytes_add(&writer->memory, &writer->part->bytes, bytes, size)
                             : sf_output_put(writer->output, bytes, size);
  if (!is_put)
    fail(writer, writer->part ? SPANFILE_NO_MEMORY : SPANFILE_WRITE_FAILED);
  return is_put;
}

/* The record that comes next is that of a key row. */
static bool note_key(spanfile_writer *writer, uint32_t row) {
  part_bytes *p = writer->part;
  if (p) {
    p->key_rows[p->key_count] = row;
    p->key_offsets[p->key_count++] = p->bytes.size;
  } else if (!sf_output_key(writer->output, row)) {
    fail(writer, SPANFILE_WRITE_FAILED);
    return false;
  }
  writer->key_offset = position(writer);
  return true;
}

/* ---------------------------------------------------------------- records */

/* Empties the record and makes room for a payload. */
static bool begin_record(spanfile_writer *writer, size_t payload) {
  writer->record.size = 0;
  if (!sf_bytes_room(&writer->memory, &writer->record, SF_HEAD_BYTES + payload + SF_CHECK_BYTES)) {
    fail(writer, SPANFILE_NO_MEMORY);
    return false;
  }
  writer->record.size = SF_HEAD_BYTES;
  return true;
}

/* Completes the record with kind and length before the payload and the checksum after it, and puts
 * it into the file. */
static bool put_record(spanfile_writer *writer, unsigned char kind, uint32_t row) {
  unsigned char *start;
  size_t size = sf_record_seal(writer->record.at + SF_HEAD_BYTES,
                               writer->record.size - SF_HEAD_BYTES, kind, row, &start);
  return put(writer, start, size);
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
  unsigned char *codes = writer->record.at + SF_HEAD_BYTES, *more = codes + (count + 3) / 4;
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
    writer->record.size = SF_HEAD_BYTES;
    return put_record(writer, SF_SAME, (uint32_t)writer->y);
  }
  if (values->size > 0)
    memcpy(writer->record.at + writer->record.size, values->at, values->size);
  writer->record.size += values->size;
  return put_record(writer, SF_MOVED, (uint32_t)writer->y);
}

/* ---------------------------------------------------------------- rows */

static bool is_key_due(const spanfile_writer *writer) {
  return writer->y % SF_KEY_ROWS == 0 || position(writer) - writer->key_offset >= SF_KEY_BYTES;
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
    return note_key(writer, (uint32_t)writer->y) && put_packets(writer) && clear_moves(writer);
  if (fit_above(writer))
    return put_moves(writer);
  return writer->status == SPANFILE_OK && put_packets(writer) && clear_moves(writer);
}

static bool has_room(const spanfile_writer *writer, uint64_t count) {
  return writer->y < writer->end && count <= writer->width - sf_row_end(&writer->row);
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
  if (writer->y >= writer->end || sf_row_end(&writer->row) != writer->width)
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

/* ---------------------------------------------------------------- the beginning */

/* A writer with neither file nor part yet. */
static spanfile_status create(const spanfile_writer_desc *desc, spanfile_writer **out) {
  bool has_format = desc->format == SPANFILE_SRGB8 || desc->format == SPANFILE_HALF;
  spanfile_info info = {desc->width, desc->height, desc->format, desc->strip_row,
                        desc->strip_height};
  if (desc->width == 0 || desc->height == 0 || !has_format || !sf_has_place(&info))
    return SPANFILE_BAD_ARGUMENT;
  sf_memory memory = sf_memory_of(desc->resize, desc->resize_user);
  spanfile_writer *writer = sf_allocate(&memory, sizeof *writer);
  if (!writer)
    return SPANFILE_NO_MEMORY;
  *writer = (spanfile_writer){.memory = memory,
                              .width = desc->width,
                              .height = desc->height,
                              .strip_height = desc->strip_height,
                              .format = desc->format,
                              .pixel_size = spanfile_pixel_size(desc->format)};
  *out = writer;
  return SPANFILE_OK;
}

spanfile_status spanfile_writer_create(const spanfile_writer_desc *desc, spanfile_writer **out) {
  spanfile_writer *writer;
  spanfile_status status = desc->write ? create(desc, &writer) : SPANFILE_BAD_ARGUMENT;
  if (status != SPANFILE_OK)
    return status;
  writer->output = sf_output_create(&writer->memory, desc);
  if (!writer->output) {
    spanfile_writer_destroy(writer);
    return SPANFILE_NO_MEMORY;
  }
  writer->end = desc->height;
  *out = writer;
  return SPANFILE_OK;
}

/* ---------------------------------------------------------------- parts */

spanfile_status spanfile_writer_create_part(const spanfile_writer_desc *desc,
                                            spanfile_writer **out) {
  spanfile_writer *writer;
  spanfile_status status = create(desc, &writer);
  if (status != SPANFILE_OK)
    return status;
  writer->part = sf_allocate(&writer->memory, sizeof *writer->part);
  if (!writer->part) {
    spanfile_writer_destroy(writer);
    return SPANFILE_NO_MEMORY;
  }
  writer->part->bytes = (sf_bytes){0};
  *out = writer;
  return spanfile_writer_begin_part(writer, 0);
}

spanfile_status spanfile_writer_begin_part(spanfile_writer *writer, uint32_t row) {
  if (!writer->part || row >= writer->height || row % SPANFILE_PART_ROWS != 0)
    return fail(writer, SPANFILE_BAD_ARGUMENT);
  uint32_t left = writer->height - row;
  writer->status = SPANFILE_OK;
  writer->y = row;
  writer->end = row + (left < SPANFILE_PART_ROWS ? left : SPANFILE_PART_ROWS);
  sf_row_clear(&writer->row);
  writer->part->first = row;
  writer->part->key_count = 0;
  writer->part->bytes.size = 0;
  return SPANFILE_OK;
}

/* Whether a part is complete and is the next one of the file. */
static bool fits(const spanfile_writer *writer, const spanfile_writer *part) {
  return !writer->part && part->part && part->y == part->end && part->row.count == 0 &&
         writer->row.count == 0 && writer->y == part->part->first && writer->width == part->width &&
         writer->height == part->height && writer->format == part->format;
}

spanfile_status spanfile_writer_join(spanfile_writer *writer, const spanfile_writer *part) {
  if (writer->status != SPANFILE_OK)
    return writer->status;
  if (part->status != SPANFILE_OK)
    return fail(writer, part->status);
  if (!fits(writer, part))
    return fail(writer, SPANFILE_BAD_ARGUMENT);
  const part_bytes *p = part->part;
  for (uint32_t i = 0; i < p->key_count; i++) {
    uint64_t from = p->key_offsets[i];
    uint64_t to = i + 1 < p->key_count ? p->key_offsets[i + 1] : p->bytes.size;
    if (!note_key(writer, p->key_rows[i]) || !put(writer, p->bytes.at + from, (size_t)(to - from)))
      return writer->status;
  }
  writer->y = part->end;
  return SPANFILE_OK;
}

/* ---------------------------------------------------------------- the end */

spanfile_status spanfile_writer_finish(spanfile_writer *writer) {
  if (writer->status != SPANFILE_OK)
    return writer->status;
  if (writer->part || writer->y != writer->height || writer->row.count > 0)
    return fail(writer, SPANFILE_BAD_ARGUMENT);
  const spanfile_info info = {.height = writer->height, .strip_height = writer->strip_height};
  if (!sf_output_end(writer->output, &info))
    fail(writer, SPANFILE_WRITE_FAILED);
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
  if (writer->part)
    sf_bytes_free(&memory, &writer->part->bytes);
  sf_release(&memory, writer->part, sizeof *writer->part);
  sf_output_destroy(&memory, writer->output);
  sf_release(&memory, writer, sizeof *writer);
}
