/* Records to rows.
 *
 *   row y + 1   current row + the next record --> current row
 *   any row     root --> node --> ... --> key row --record by record--> row
 *
 * INVARIANT: nothing in the file is trusted. Every number is checked before it is used, and memory
 * is allocated only for data that the file contains.
 *
 * One file, because opening, finding a row and reading records share the checks and the state of
 * the reader.
 */
#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>

#include "crc32c.h"
#include "pixels.h"
#include "store.h"

enum { WINDOW_BYTES = 64 * 1024 };

/* Bytes of the file that are in memory. */
typedef struct file_window {
  sf_bytes bytes;
  uint64_t offset;
} file_window;

struct spanfile_reader {
  sf_memory memory;
  bool (*read)(void *user, uint64_t offset, void *bytes, size_t size);
  void *user;
  spanfile_info info;
  size_t pixel_size;
  uint64_t root, end; /* offsets: of the root of the index, and of the trailer */
  uint32_t levels;
  file_window window;
  bool has_row;
  uint32_t y; /* of the current row */
  sf_row row;
  bool has_gradients; /* in the current row */
  int64_t *moves;     /* of its ends, from the row above it */
  size_t move_capacity;
  uint64_t next; /* offset of the record after it */
  spanfile_counts counts;
  spanfile_fault *fault; /* the fault of the call in progress; may be NULL */
};

typedef struct file_record {
  unsigned char kind;
  uint64_t offset;
  const unsigned char *payload;
  size_t size;
  uint64_t next;
} file_record;

__attribute__((format(printf, 4, 5))) static spanfile_status
fail(spanfile_fault *fault, spanfile_status status, uint64_t offset, const char *format, ...) {
  if (fault) {
    va_list arguments;
    fault->offset = offset;
    va_start(arguments, format);
    vsnprintf(fault->reason, sizeof fault->reason, format, arguments);
    va_end(arguments);
  }
  return status;
}

#define REFUSE(reader, offset, ...) fail((reader)->fault, SPANFILE_BAD_FILE, offset, __VA_ARGS__)
#define TRY(call)                                                                                  \
  do {                                                                                             \
    spanfile_status try_status = (call);                                                           \
    if (try_status != SPANFILE_OK)                                                                 \
      return try_status;                                                                           \
  } while (0)

static spanfile_status fail_memory(const spanfile_reader *reader, uint64_t offset) {
  return fail(reader->fault, SPANFILE_NO_MEMORY, offset, "no memory");
}

/* ---------------------------------------------------------------- bytes */

/* Bytes [offset, offset + size) of the file, which must lie before the trailer. */
static spanfile_status view(spanfile_reader *reader, uint64_t offset, size_t size,
                            const unsigned char **out) {
  file_window *window = &reader->window;
  if (offset < window->offset || offset - window->offset > window->bytes.size ||
      window->bytes.size - (offset - window->offset) < size) {
    uint64_t wanted = size < WINDOW_BYTES ? WINDOW_BYTES : size;
    wanted = wanted < reader->end - offset ? wanted : reader->end - offset;
    window->bytes.size = 0;
    if (!sf_bytes_room(&reader->memory, &window->bytes, (size_t)wanted))
      return fail_memory(reader, offset);
    if (!reader->read(reader->user, offset, window->bytes.at, (size_t)wanted))
      return fail(reader->fault, SPANFILE_READ_FAILED, offset, "cannot read");
    window->offset = offset;
    window->bytes.size = (size_t)wanted;
  }
  *out = window->bytes.at + (offset - window->offset);
  return SPANFILE_OK;
}

/* The subject of a message. */
typedef struct subject_text {
  char text[24];
} subject_text;
static subject_text subject(uint32_t row) {
  subject_text out = {"the index"};
  if (row != SF_INDEX_ROW)
    snprintf(out.text, sizeof out.text, "row %" PRIu32, row);
  return out;
}

/* The record at an offset before the trailer. Its checksum is right for `row`, or for the index if
 * it is a record of that. Valid until the next call. */
static spanfile_status view_record(spanfile_reader *reader, uint64_t offset, uint32_t row,
                                   file_record *out) {
  const unsigned char *bytes;
  uint64_t left = reader->end - offset, length;
  size_t head = left < 1 + SF_LENGTH_BYTES ? (size_t)left : 1 + SF_LENGTH_BYTES;
  TRY(view(reader, offset, head, &bytes));
  size_t length_size = head > 1 ? sf_load_varint(bytes + 1, head - 1, &length) : 0;
  if (length_size == 0)
    return REFUSE(reader, offset, "%s: its record has no valid length", subject(row).text);
  uint64_t rest = left - 1 - length_size;
  if (rest < SF_CHECK_BYTES || length > rest - SF_CHECK_BYTES || length > SIZE_MAX / 4)
    return REFUSE(reader, offset, "%s: its record runs past the end", subject(row).text);
  size_t size = 1 + length_size + (size_t)length;
  TRY(view(reader, offset, size + SF_CHECK_BYTES, &bytes));
  uint32_t of = bytes[0] == SF_INDEX ? SF_INDEX_ROW : row;
  if (sf_load_32(bytes + size) != sf_crc32c_record(of, bytes, size))
    return REFUSE(reader, offset, "%s: the checksum is wrong", subject(row).text);
  *out = (file_record){.kind = bytes[0],
                       .offset = offset,
                       .payload = bytes + 1 + length_size,
                       .size = (size_t)length,
                       .next = offset + size + SF_CHECK_BYTES};
  return SPANFILE_OK;
}

/* ---------------------------------------------------------------- a row as packets */

static uint32_t values_of(uint32_t kind, uint32_t length) {
  return kind == SPANFILE_RAW ? length : kind == SPANFILE_GRADIENT ? 2 : 0;
}

/* *at: advances beyond the packet. */
static spanfile_status read_packet(spanfile_reader *reader, const file_record *record, size_t *at) {
  const unsigned char *packet = record->payload + *at;
  size_t left = record->size - *at;
  uint64_t offset = record->next - SF_CHECK_BYTES - left;
  if (left < 3)
    return REFUSE(reader, offset, "row %" PRIu32 ": a packet is cut", reader->y);
  uint32_t kind = packet[0], code = packet[1] | (uint32_t)packet[2] << 8, count = code + 1;
  if (kind > SPANFILE_GRADIENT || count > SF_PACKET_MOST)
    return REFUSE(reader, offset, "row %" PRIu32 ": there is no such packet", reader->y);
  if (count > reader->info.width - sf_row_end(&reader->row))
    return REFUSE(reader, offset, "row %" PRIu32 ": more pixels than the row has", reader->y);
  uint32_t pixels = kind == SPANFILE_RUN ? 1 : values_of(kind, count);
  size_t size = pixels * reader->pixel_size;
  if (left - 3 < size)
    return REFUSE(reader, offset, "row %" PRIu32 ": a packet is cut", reader->y);
  bool is_run = kind == SPANFILE_RUN;
  reader->has_gradients |= kind == SPANFILE_GRADIENT;
  uint64_t pixel = is_run ? sf_load_pixel(packet + 3, reader->pixel_size) : 0;
  if (!sf_row_add(&reader->memory, &reader->row, count, kind, pixel) ||
      (!is_run && !sf_bytes_add(&reader->memory, &reader->row.values, packet + 3, size)))
    return fail_memory(reader, offset);
  *at += 3 + size;
  return SPANFILE_OK;
}

/* Gradients of the current row must have a proper length and finite ends. */
static spanfile_status check_gradients(spanfile_reader *reader, const file_record *record) {
  const sf_row *row = &reader->row;
  if (!reader->has_gradients)
    return SPANFILE_OK;
  const unsigned char *values = sf_bytes_start(&row->values);
  uint32_t start = 0;
  for (size_t i = 0; i < row->count; start = row->spans[i++].end) {
    uint32_t kind = row->spans[i].kind, length = row->spans[i].end - start;
    if (kind == SPANFILE_GRADIENT && (length < 2 || length > SF_PACKET_MOST))
      return REFUSE(reader, record->offset, "row %" PRIu32 ": a gradient of %" PRIu32 " pixels",
                    reader->y, length);
    if (kind == SPANFILE_GRADIENT && !sf_pixels_are_finite(reader->info.format, values))
      return REFUSE(reader, record->offset, "row %" PRIu32 ": a gradient to infinity", reader->y);
    values += values_of(kind, length) * reader->pixel_size;
  }
  return SPANFILE_OK;
}

static spanfile_status clear_moves(spanfile_reader *reader) {
  size_t count = reader->row.count;
  if (count > reader->move_capacity) {
    sf_release(&reader->memory, reader->moves, reader->move_capacity * sizeof *reader->moves);
    reader->move_capacity = 0;
    reader->moves = sf_allocate(&reader->memory, reader->row.capacity * sizeof *reader->moves);
    if (!reader->moves)
      return fail_memory(reader, reader->next);
    reader->move_capacity = reader->row.capacity;
  }
  memset(reader->moves, 0, count * sizeof *reader->moves);
  return SPANFILE_OK;
}

static spanfile_status read_packets(spanfile_reader *reader, const file_record *record) {
  sf_row_clear(&reader->row);
  reader->has_gradients = false;
  for (size_t at = 0; at < record->size;)
    TRY(read_packet(reader, record, &at));
  if (sf_row_end(&reader->row) != reader->info.width)
    return REFUSE(reader, record->offset, "row %" PRIu32 ": the number of pixels is wrong",
                  reader->y);
  TRY(check_gradients(reader, record));
  return clear_moves(reader);
}

/* ---------------------------------------------------------------- a row as moves */

/* Moves all ends but the last. *at: the bytes that were read. *pixels: adds those that the values
 * of the row must have. */
static spanfile_status read_moves(spanfile_reader *reader, const file_record *record, size_t *at,
                                  uint64_t *pixels) {
  size_t count = reader->row.count - 1, more = (count + 3) / 4;
  uint64_t offset = record->offset;
  spanfile_span *spans = reader->row.spans;
  uint32_t start = 0, width = reader->info.width;
  if (record->size < more)
    return REFUSE(reader, offset, "row %" PRIu32 ": moves are missing", reader->y);
  for (size_t i = 0; i < count; i++) {
    unsigned code = record->payload[i / 4] >> 2 * (i % 4) & 3;
    int64_t rest = code == 2 ? -1 : (int64_t)code;
    if (code == 3) {
      size_t left = record->size - more;
      uint64_t number;
      size_t size = sf_load_varint(record->payload + more, left < 5 ? left : 5, &number);
      if (size == 0)
        return REFUSE(reader, offset, "row %" PRIu32 ": a move is not a valid number", reader->y);
      rest = sf_unzigzag(number);
      more += size;
    }
    int64_t move = reader->moves[i] + rest, end = (int64_t)spans[i].end + move;
    if (end <= (int64_t)start || end >= (int64_t)width)
      return REFUSE(reader, offset, "row %" PRIu32 ": span %zu ends out of order", reader->y,
                    i + 1);
    reader->moves[i] = move;
    *pixels += values_of(spans[i].kind, (uint32_t)end - start);
    start = spans[i].end = (uint32_t)end;
  }
  *pixels += values_of(spans[count].kind, width - start);
  *at = more;
  return SPANFILE_OK;
}

static spanfile_status read_moved(spanfile_reader *reader, const file_record *record) {
  sf_row *row = &reader->row;
  size_t at = 0;
  uint64_t pixels = 0;
  TRY(read_moves(reader, record, &at, &pixels));
  if (pixels * reader->pixel_size != record->size - at)
    return REFUSE(reader, record->offset, "row %" PRIu32 ": the number of pixels is wrong",
                  reader->y);
  row->values.size = 0;
  if (!sf_bytes_add(&reader->memory, &row->values, record->payload + at, record->size - at))
    return fail_memory(reader, record->offset);
  return check_gradients(reader, record);
}

static spanfile_status read_same(spanfile_reader *reader, const file_record *record) {
  if (record->size > 0)
    return REFUSE(reader, record->offset, "row %" PRIu32 ": bytes too many", reader->y);
  return clear_moves(reader);
}

/* ---------------------------------------------------------------- rows */

/* Makes row reader->y of its record. Unless that has packets, the current row must be the one
 * above. */
static spanfile_status read_row(spanfile_reader *reader, const file_record *record, bool is_first) {
  reader->next = record->next;
  switch (is_first && record->kind != SF_PACKETS ? 0 : record->kind) {
  case SF_PACKETS:
    reader->counts.literal_rows++;
    return read_packets(reader, record);
  case SF_MOVED:
    reader->counts.moved_rows++;
    return read_moved(reader, record);
  case SF_SAME:
    reader->counts.same_rows++;
    return read_same(reader, record);
  default:
    return REFUSE(reader, record->offset, "row %" PRIu32 ": there is no such record here",
                  reader->y);
  }
}

/* The first record from `offset` on that is not of the index. */
static spanfile_status view_row(spanfile_reader *reader, uint64_t offset, file_record *out) {
  do {
    if (offset == reader->end)
      return REFUSE(reader, offset, "row %" PRIu32 ": is missing", reader->y);
    TRY(view_record(reader, offset, reader->y, out));
    offset = out->next;
  } while (out->kind == SF_INDEX);
  return SPANFILE_OK;
}

/* Makes row y the current one, from the first record of a row at `offset` or after. */
static spanfile_status advance_to(spanfile_reader *reader, uint32_t y, uint64_t offset,
                                  bool is_first) {
  file_record record = {0};
  reader->y = y;
  reader->has_row = false;
  TRY(view_row(reader, offset, &record));
  TRY(read_row(reader, &record, is_first));
  reader->has_row = true;
  return SPANFILE_OK;
}

/* ---------------------------------------------------------------- the index */

static spanfile_status view_node(spanfile_reader *reader, uint64_t offset, uint32_t level,
                                 file_record *out) {
  TRY(view_record(reader, offset, SF_INDEX_ROW, out));
  size_t entries = out->size >= 4 ? out->size - 4 : 0;
  bool is_node = out->kind == SF_INDEX && entries > 0 && entries % SF_ENTRY_BYTES == 0 &&
                 entries <= SF_NODE_ENTRIES * (size_t)SF_ENTRY_BYTES &&
                 sf_load_32(out->payload) == level;
  return is_node ? SPANFILE_OK : REFUSE(reader, offset, "a node of the index is wrong");
}

/* The last entry whose row is y or above it. */
static const unsigned char *find_entry(const file_record *node, uint32_t y) {
  const unsigned char *entries = node->payload + 4;
  size_t low = 0, high = (node->size - 4) / SF_ENTRY_BYTES;
  while (high - low > 1) {
    size_t middle = low + (high - low) / 2;
    if (sf_load_32(entries + middle * SF_ENTRY_BYTES) <= y)
      low = middle;
    else
      high = middle;
  }
  return entries + low * SF_ENTRY_BYTES;
}

/* The key row at or above y. */
static spanfile_status find_key(spanfile_reader *reader, uint32_t y, uint32_t *key,
                                uint64_t *offset) {
  *offset = reader->root;
  for (uint32_t level = reader->levels; level-- > 0;) {
    file_record node = {0};
    TRY(view_node(reader, *offset, level, &node));
    const unsigned char *entry = find_entry(&node, y);
    *key = sf_load_32(entry);
    *offset = sf_load_64(entry + 4);
    if (*key > y || *offset < SF_HEADER_BYTES || *offset >= node.offset)
      return REFUSE(reader, node.offset, "the index leads nowhere");
  }
  return SPANFILE_OK;
}

/* ---------------------------------------------------------------- asking for rows */

static spanfile_status go_to(spanfile_reader *reader, uint32_t y) {
  if (reader->has_row && reader->y == y)
    return SPANFILE_OK;
  if (!reader->has_row || y != reader->y + 1) {
    uint32_t key = 0;
    uint64_t offset = SF_HEADER_BYTES;
    if (y > 0)
      TRY(find_key(reader, y, &key, &offset));
    if (!reader->has_row || reader->y > y || reader->y < key)
      TRY(advance_to(reader, key, offset, true));
  }
  while (reader->y < y)
    TRY(advance_to(reader, reader->y + 1, reader->next, false));
  return SPANFILE_OK;
}

spanfile_status spanfile_reader_row(spanfile_reader *reader, uint32_t y, spanfile_row *out,
                                    spanfile_fault *fault) {
  if (y >= reader->info.height)
    return fail(fault, SPANFILE_BAD_ARGUMENT, 0, "row %" PRIu32 " is not in 0..%" PRIu32, y,
                reader->info.height - 1);
  reader->fault = fault;
  TRY(go_to(reader, y));
  *out = (spanfile_row){reader->row.spans, reader->row.count, sf_bytes_start(&reader->row.values)};
  return SPANFILE_OK;
}

/* After the last row there are only records of the index, and the last one is the root. */
static spanfile_status check_end(spanfile_reader *reader) {
  uint64_t offset = reader->next, last = 0;
  while (offset < reader->end) {
    file_record record = {0};
    TRY(view_record(reader, offset, SF_INDEX_ROW, &record));
    if (record.kind != SF_INDEX)
      return REFUSE(reader, offset, "more rows than the picture has");
    last = offset;
    offset = record.next;
  }
  return last == reader->root ? SPANFILE_OK
                              : REFUSE(reader, last, "the index does not end in its root");
}

spanfile_status spanfile_reader_check(spanfile_reader *reader, spanfile_counts *counts,
                                      spanfile_fault *fault) {
  reader->fault = fault;
  reader->has_row = false;
  reader->counts = (spanfile_counts){0};
  for (uint64_t y = 0; y < reader->info.height; y++) {
    TRY(go_to(reader, (uint32_t)y));
    for (size_t i = 0; i < reader->row.count; i++)
      reader->counts.spans[reader->row.spans[i].kind]++;
  }
  TRY(check_end(reader));
  if (counts)
    *counts = reader->counts;
  return SPANFILE_OK;
}

/* ---------------------------------------------------------------- opening */

bool spanfile_is(const void *bytes, size_t size) {
  const unsigned char *header = bytes;
  return size >= SPANFILE_MAGIC_BYTES && header[0] == SF_ID_BYTES && header[2] == SF_IMAGE_TYPE &&
         memcmp(header + 18, sf_magic, sizeof sf_magic - 1) == 0;
}

static spanfile_status read_header(spanfile_reader *reader, uint64_t size) {
  unsigned char header[SF_HEADER_BYTES];
  if (size < SF_HEADER_BYTES + SF_END_BYTES)
    return REFUSE(reader, size, "too short for a span file");
  if (!reader->read(reader->user, 0, header, sizeof header))
    return fail(reader->fault, SPANFILE_READ_FAILED, 0, "cannot read");
  if (!spanfile_is(header, sizeof header))
    return REFUSE(reader, 0, "not a span file");
  if (header[25] != sf_magic[7])
    return REFUSE(reader, 25, "of version %d; this reads version 1", header[25]);
  if (sf_load_32(header + 42) != sf_crc32c(0, header, 42))
    return REFUSE(reader, 0, "the checksum of the header is wrong");
  uint32_t format = sf_load_32(header + 34);
  reader->info = (spanfile_info){.width = sf_load_32(header + 26),
                                 .height = sf_load_32(header + 30),
                                 .strip_row = sf_load_32(header + 38)};
  if (reader->info.width == 0 || reader->info.height == 0)
    return REFUSE(reader, 26, "a picture without pixels");
  if (format != SPANFILE_SRGB8 && format != SPANFILE_HALF)
    return REFUSE(reader, 34, "pixel format %" PRIu32 " is unknown", format);
  reader->info.format = (spanfile_format)format;
  reader->pixel_size = spanfile_pixel_size(reader->info.format);
  return SPANFILE_OK;
}

static spanfile_status read_trailer(spanfile_reader *reader, uint64_t size) {
  unsigned char trailer[SF_END_BYTES];
  uint64_t at = size - SF_END_BYTES;
  reader->end = at;
  if (!reader->read(reader->user, at, trailer, sizeof trailer))
    return fail(reader->fault, SPANFILE_READ_FAILED, at, "cannot read");
  if (memcmp(trailer, sf_end_magic, sizeof sf_end_magic) != 0 ||
      memcmp(trailer + SF_TRAILER_BYTES, sf_footer, SF_FOOTER_BYTES) != 0)
    return REFUSE(reader, at, "cut: there is no trailer at the end");
  if (sf_load_32(trailer + 36) != sf_crc32c(0, trailer, 36))
    return REFUSE(reader, at, "the checksum of the trailer is wrong");
  if (sf_load_64(trailer + 16) != size)
    return REFUSE(reader, at + 16, "of %" PRIu64 " bytes, but its trailer declares %" PRIu64, size,
                  sf_load_64(trailer + 16));
  if (sf_load_32(trailer + 24) != reader->info.height)
    return REFUSE(reader, at + 24, "of %" PRIu32 " rows, but its trailer declares %" PRIu32,
                  reader->info.height, sf_load_32(trailer + 24));
  reader->info.strip_height = sf_load_32(trailer + 32);
  if (!sf_has_place(&reader->info))
    return REFUSE(reader, at + 32, "rows from %" PRIu32 " on are not a strip of %" PRIu32 " rows",
                  reader->info.strip_row, reader->info.strip_height);
  reader->root = sf_load_64(trailer + 8);
  if (reader->root < SF_HEADER_BYTES || reader->root >= at)
    return REFUSE(reader, at + 8, "the index is not in the file");
  reader->levels = sf_load_32(trailer + 28);
  if (reader->levels < 1 || reader->levels > SF_LEVELS)
    return REFUSE(reader, at + 28, "an index of %" PRIu32 " levels", reader->levels);
  return SPANFILE_OK;
}

spanfile_status spanfile_reader_create(const spanfile_source *source, spanfile_reader **out,
                                       spanfile_fault *fault) {
  sf_memory memory = sf_memory_of(source->resize, source->resize_user);
  spanfile_reader *reader = sf_allocate(&memory, sizeof *reader);
  if (!reader)
    return fail(fault, SPANFILE_NO_MEMORY, 0, "no memory");
  *reader = (spanfile_reader){
      .memory = memory, .read = source->read, .user = source->user, .fault = fault};
  spanfile_status status = read_header(reader, source->size);
  if (status == SPANFILE_OK)
    status = read_trailer(reader, source->size);
  if (status == SPANFILE_OK)
    *out = reader;
  else
    spanfile_reader_destroy(reader);
  return status;
}

void spanfile_reader_destroy(spanfile_reader *reader) {
  if (!reader)
    return;
  sf_memory memory = reader->memory;
  sf_row_free(&memory, &reader->row);
  sf_release(&memory, reader->moves, reader->move_capacity * sizeof *reader->moves);
  sf_bytes_free(&memory, &reader->window.bytes);
  sf_release(&memory, reader, sizeof *reader);
}

spanfile_info spanfile_reader_info(const spanfile_reader *reader) { return reader->info; }
