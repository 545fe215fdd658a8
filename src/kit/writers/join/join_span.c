/* Strips of span files: the library spanfile copies their records. */
#include <inttypes.h>

#include "writers/join/format.h"

enum { SIDE_MOST = 1048576 };

static bool claims(const unsigned char start[CS_JOIN_START]) {
  return spanfile_is(start, CS_JOIN_START);
}

/* ---------------------------------------------------------------- the library's callbacks */

typedef struct part_source {
  celspan_context *context;
  const cs_join_part *part;
} part_source;

static bool read_bytes(void *user, uint64_t offset, void *bytes, size_t size) {
  const part_source *from = user;
  return cs_join_part_read(from->context, from->part, offset, bytes, size) == CELSPAN_OK;
}

static bool put_bytes(void *user, const void *bytes, size_t size) {
  const cs_joining *joining = user;
  return cs_file_write(joining->file, joining->context, bytes, size) == CELSPAN_OK;
}

static spanfile_source source_of(part_source *from) {
  return (spanfile_source){.read = read_bytes,
                           .user = from,
                           .size = from->part->size,
                           .resize = cs_mem_resize_of,
                           .resize_user = from->context->memory};
}

/* If a callback has failed, it has set the error already. */
static celspan_status report(celspan_context *context, spanfile_status status,
                             const cs_join_part *part, const spanfile_fault *fault) {
  switch (status) {
  case SPANFILE_OK:
    return CELSPAN_OK;
  case SPANFILE_NO_MEMORY:
    return cs_fail_memory(context);
  case SPANFILE_READ_FAILED:
    return CELSPAN_INPUT;
  case SPANFILE_WRITE_FAILED:
    return CELSPAN_OUTPUT;
  default:
    return cs_join_part_fail(context, part, "byte %" PRIu64 ": %s; render the strip again",
                             fault->offset, fault->reason);
  }
}

/* ---------------------------------------------------------------- the format */

static celspan_status inspect(celspan_context *context, cs_join_part *part) {
  part_source from = {context, part};
  spanfile_source source = source_of(&from);
  spanfile_fault fault = {0};
  spanfile_reader *reader;
  CS_TRY(report(context, spanfile_reader_create(&source, &reader, &fault), part, &fault));
  spanfile_info info = spanfile_reader_info(reader);
  spanfile_reader_destroy(reader);
  if (info.width > SIDE_MOST || info.height > SIDE_MOST || info.strip_height > SIDE_MOST)
    return cs_join_part_fail(context, part, "is of more than %d pixels a side", SIDE_MOST);
  part->width = (int32_t)info.width;
  part->height = (int32_t)info.height;
  part->strip = (cs_strip){(int32_t)info.strip_row, (int32_t)info.strip_height};
  part->form = cs_hash_begin('S');
  cs_hash_word(&part->form, info.width);
  cs_hash_word(&part->form, info.format);
  part->form = cs_hash_end(part->form);
  return CELSPAN_OK;
}

/* The format of the pixels is not stored in a part, so it is read again. */
static celspan_status begin(cs_joining *joining, celspan_context *context,
                            const cs_join_part *first) {
  part_source from = {context, first};
  spanfile_source source = source_of(&from);
  spanfile_fault fault = {0};
  spanfile_reader *reader;
  CS_TRY(report(context, spanfile_reader_create(&source, &reader, &fault), first, &fault));
  spanfile_writer_desc desc = {.width = (uint32_t)first->width,
                               .height = (uint32_t)first->strip.height,
                               .format = spanfile_reader_info(reader).format,
                               .write = put_bytes,
                               .user = joining,
                               .resize = cs_mem_resize_of,
                               .resize_user = context->memory};
  spanfile_reader_destroy(reader);
  return report(context, spanfile_joiner_create(&desc, &joining->spanfile), first, &fault);
}

static celspan_status add(cs_joining *joining, celspan_context *context, const cs_join_part *part) {
  part_source from = {context, part};
  spanfile_source source = source_of(&from);
  spanfile_fault fault = {0};
  joining->context = context;
  return report(context, spanfile_joiner_add(joining->spanfile, &source, &fault), part, &fault);
}

/* All rows have arrived, so only writing can fail. */
static celspan_status end(cs_joining *joining, celspan_context *context) {
  joining->context = context;
  return spanfile_joiner_finish(joining->spanfile) == SPANFILE_OK ? CELSPAN_OK : CELSPAN_OUTPUT;
}

const cs_join_format cs_join_span = {"span", {"span"}, claims, inspect, begin, add, end};
