/* Strips to a file: records are copied piece by piece, with checksums for their new rows.
 *
 *   strip 0    header |P M M S ... P M| index | trailer
 *   strip 1    header |P M S ... M| index | trailer
 *   file       header |P M M S ... P M|P M S ... M| index, made again | trailer
 *                                      row 256: a key row in the strip and in the file
 *
 * INVARIANT: memory is a window of the strip and the file's output, whatever lengths the records
 * claim; a record whose checksum is wrong is refused, but its bytes have been passed on by then.
 */
#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>

#include "crc32c.h"
#include "output.h"

enum { WINDOW_BYTES = 64 * 1024, HEAD_MOST = 1 + SF_LENGTH_BYTES };

struct spanfile_joiner {
  sf_memory memory;
  sf_output *output;
  spanfile_info info; /* the info of the whole */
  uint32_t y;         /* the next row */
  uint64_t key_offset;
  const spanfile_source *source; /* the strip that is being added */
  spanfile_fault *fault;
  uint64_t at, end;           /* of its bytes: the next one, and the trailer */
  size_t window, window_size; /* the next byte in `bytes`, and how many there are */
  unsigned char bytes[WINDOW_BYTES];
};

__attribute__((format(printf, 3, 4))) static spanfile_status
fail(const spanfile_joiner *joiner, spanfile_status status, const char *format, ...) {
  if (joiner->fault) {
    va_list arguments;
    joiner->fault->offset = joiner->at;
    va_start(arguments, format);
    vsnprintf(joiner->fault->reason, sizeof joiner->fault->reason, format, arguments);
    va_end(arguments);
  }
  return status;
}

#define TRY(call)                                                                                  \
  do {                                                                                             \
    spanfile_status try_status = (call);                                                           \
    if (try_status != SPANFILE_OK)                                                                 \
      return try_status;                                                                           \
  } while (0)

/* ---------------------------------------------------------------- bytes of the strip */

/* Reads until at least `least` bytes, or all up to the trailer, are in the window. least: at most
 * HEAD_MOST. */
static spanfile_status fill(spanfile_joiner *joiner, size_t least) {
  size_t held = joiner->window_size - joiner->window;
  uint64_t left = joiner->end - joiner->at;
  if (held >= least || held == left)
    return SPANFILE_OK;
  memmove(joiner->bytes, joiner->bytes + joiner->window, held);
  size_t more = left < WINDOW_BYTES ? (size_t)left - held : WINDOW_BYTES - held;
  joiner->window = 0;
  joiner->window_size = held;
  if (!joiner->source->read(joiner->source->user, joiner->at + held, joiner->bytes + held, more))
    return fail(joiner, SPANFILE_READ_FAILED, "cannot read");
  joiner->window_size += more;
  return SPANFILE_OK;
}

static const unsigned char *take(spanfile_joiner *joiner, size_t size) {
  const unsigned char *bytes = joiner->bytes + joiner->window;
  joiner->window += size;
  joiner->at += size;
  return bytes;
}

static spanfile_status put(spanfile_joiner *joiner, const void *bytes, size_t size) {
  return sf_output_put(joiner->output, bytes, size)
             ? SPANFILE_OK
             : fail(joiner, SPANFILE_WRITE_FAILED, "cannot write");
}

/* ---------------------------------------------------------------- records */

typedef struct head {
  unsigned char kind;
  size_t size;      /* the size of the head itself */
  uint64_t payload; /* bytes */
} head;

static spanfile_status view_head(spanfile_joiner *joiner, head *out) {
  TRY(fill(joiner, HEAD_MOST));
  const unsigned char *bytes = joiner->bytes + joiner->window;
  size_t held = joiner->window_size - joiner->window;
  held = held < HEAD_MOST ? held : HEAD_MOST;
  size_t length = held > 1 ? sf_load_varint(bytes + 1, held - 1, &out->payload) : 0;
  if (length == 0)
    return fail(joiner, SPANFILE_BAD_FILE, "row %" PRIu32 ": its record has no valid length",
                joiner->y);
  out->kind = bytes[0];
  out->size = 1 + length;
  uint64_t rest = joiner->end - joiner->at - out->size;
  if (rest < SF_CHECK_BYTES || out->payload > rest - SF_CHECK_BYTES)
    return fail(joiner, SPANFILE_BAD_FILE, "row %" PRIu32 ": its record runs past the end",
                joiner->y);
  return SPANFILE_OK;
}

/* Passes bytes of a record on, unless it is one of the index, which is left out. was, is: checksums
 * for the row in the strip and in the file. */
static spanfile_status copy(spanfile_joiner *joiner, uint64_t size, bool is_row, uint32_t *was,
                            uint32_t *is) {
  while (size > 0) {
    TRY(fill(joiner, 1));
    size_t held = joiner->window_size - joiner->window;
    size_t count = size < held ? (size_t)size : held;
    const unsigned char *bytes = take(joiner, count);
    *was = sf_crc32c(*was, bytes, count);
    *is = sf_crc32c(*is, bytes, count);
    if (is_row)
      TRY(put(joiner, bytes, count));
    size -= count;
  }
  return SPANFILE_OK;
}

static uint32_t begin_sum(uint32_t row) {
  unsigned char number[4];
  sf_store_32(number, row);
  return sf_crc32c(0, number, sizeof number);
}

/* A record whose row in the strip is `row`. */
static spanfile_status copy_record(spanfile_joiner *joiner, uint32_t row, const head *record) {
  bool is_row = record->kind != SF_INDEX;
  uint32_t was = begin_sum(is_row ? row : SF_INDEX_ROW), is = begin_sum(joiner->y);
  unsigned char sum[SF_CHECK_BYTES];
  TRY(copy(joiner, record->size + record->payload, is_row, &was, &is));
  TRY(fill(joiner, SF_CHECK_BYTES));
  if (sf_load_32(take(joiner, SF_CHECK_BYTES)) != was)
    return fail(joiner, SPANFILE_BAD_FILE, "row %" PRIu32 ": the checksum is wrong", row);
  sf_store_32(sum, is);
  return is_row ? put(joiner, sum, sizeof sum) : SPANFILE_OK;
}

/* ---------------------------------------------------------------- rows */

/* The rule of the writer: every SF_KEY_ROWS rows, and after SF_KEY_BYTES. */
static spanfile_status note_key(spanfile_joiner *joiner, const head *record) {
  bool is_due = joiner->y % SF_KEY_ROWS == 0;
  bool is_whole = record->kind == SF_PACKETS;
  uint64_t position = sf_output_position(joiner->output);
  if (is_due && !is_whole)
    return fail(joiner, SPANFILE_BAD_FILE, "row %" PRIu32 ": is not stored whole", joiner->y);
  if (!is_due && !(is_whole && position - joiner->key_offset >= SF_KEY_BYTES))
    return SPANFILE_OK;
  if (!sf_output_key(joiner->output, joiner->y))
    return fail(joiner, SPANFILE_WRITE_FAILED, "cannot write");
  joiner->key_offset = sf_output_position(joiner->output);
  return SPANFILE_OK;
}

static spanfile_status copy_row(spanfile_joiner *joiner, uint32_t row, const head *record) {
  bool is_known = record->kind == SF_PACKETS || record->kind == SF_MOVED || record->kind == SF_SAME;
  if (!is_known)
    return fail(joiner, SPANFILE_BAD_FILE, "row %" PRIu32 ": there is no such record here", row);
  TRY(note_key(joiner, record));
  TRY(copy_record(joiner, row, record));
  joiner->y++;
  return SPANFILE_OK;
}

static spanfile_status copy_records(spanfile_joiner *joiner, uint32_t height) {
  uint32_t row = 0;
  while (joiner->at < joiner->end) {
    head record = {0};
    TRY(view_head(joiner, &record));
    if (record.kind == SF_INDEX) {
      TRY(copy_record(joiner, row, &record));
      continue;
    }
    if (row == height)
      return fail(joiner, SPANFILE_BAD_FILE, "more rows than the picture has");
    TRY(copy_row(joiner, row++, &record));
  }
  return row == height ? SPANFILE_OK
                       : fail(joiner, SPANFILE_BAD_FILE, "row %" PRIu32 ": is missing", row);
}

/* ---------------------------------------------------------------- strips */

static spanfile_status read_info(spanfile_joiner *joiner, spanfile_info *out) {
  spanfile_reader *reader;
  spanfile_status status = spanfile_reader_create(joiner->source, &reader, joiner->fault);
  if (status != SPANFILE_OK)
    return status;
  *out = spanfile_reader_info(reader);
  spanfile_reader_destroy(reader);
  return SPANFILE_OK;
}

spanfile_status spanfile_joiner_add(spanfile_joiner *joiner, const spanfile_source *source,
                                    spanfile_fault *fault) {
  spanfile_info info = {0};
  joiner->source = source;
  joiner->fault = fault;
  joiner->at = SF_HEADER_BYTES;
  joiner->window = joiner->window_size = 0;
  TRY(read_info(joiner, &info));
  joiner->end = source->size - SF_END_BYTES;
  if (info.strip_row != joiner->y || info.strip_height != joiner->info.height ||
      info.width != joiner->info.width || info.format != joiner->info.format)
    return fail(joiner, SPANFILE_BAD_FILE, "is not the strip that begins at row %" PRIu32,
                joiner->y);
  return copy_records(joiner, info.height);
}

spanfile_status spanfile_joiner_create(const spanfile_writer_desc *desc, spanfile_joiner **out) {
  bool has_format = desc->format == SPANFILE_SRGB8 || desc->format == SPANFILE_HALF;
  if (desc->width == 0 || desc->height == 0 || !has_format || desc->strip_height || !desc->write)
    return SPANFILE_BAD_ARGUMENT;
  sf_memory memory = sf_memory_of(desc->resize, desc->resize_user);
  spanfile_joiner *joiner = sf_allocate(&memory, sizeof *joiner);
  if (!joiner)
    return SPANFILE_NO_MEMORY;
  joiner->memory = memory;
  joiner->info = (spanfile_info){desc->width, desc->height, desc->format, 0, 0};
  joiner->y = 0;
  joiner->key_offset = 0;
  joiner->output = sf_output_create(&memory, desc);
  if (!joiner->output) {
    spanfile_joiner_destroy(joiner);
    return SPANFILE_NO_MEMORY;
  }
  *out = joiner;
  return SPANFILE_OK;
}

spanfile_status spanfile_joiner_finish(spanfile_joiner *joiner) {
  if (joiner->y != joiner->info.height)
    return SPANFILE_BAD_ARGUMENT;
  return sf_output_end(joiner->output, &joiner->info) ? SPANFILE_OK : SPANFILE_WRITE_FAILED;
}

void spanfile_joiner_destroy(spanfile_joiner *joiner) {
  if (!joiner)
    return;
  sf_memory memory = joiner->memory;
  sf_output_destroy(&memory, joiner->output);
  sf_release(&memory, joiner, sizeof *joiner);
}
