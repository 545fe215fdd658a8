#include "readers/layered/zip.h"

#include <stdlib.h>
#include <string.h>

#include "common/bytes.h"

enum { LOCAL_HEADER = 30, ENTRY = 46, END = 22, END_64 = 56, LOCATOR_64 = 20 };
enum { ENCRYPTED = 1 };

static celspan_status fail(celspan_context *context, const cs_input *input, int64_t offset,
                           const char *sentence) {
  return cs_input_fail(context, input, offset, CELSPAN_INPUT, "%s", sentence);
}

/* ---------------------------------------------------------------- the end of the table */

/* The place of the table, as the record at its end gives it. */
typedef struct table_place {
  uint64_t offset, size, count;
} table_place;

/* Searches for the end of the table, after which a comment of up to 65535 bytes may follow. */
static celspan_status find_end(celspan_context *context, const cs_input *input,
                               unsigned char end[END], int64_t *at) {
  unsigned char bytes[4096 + END];
  int64_t least = input->size - END - 65535;
  for (int64_t high = input->size - END; high >= 0 && high >= least; high -= 4096) {
    int64_t low = high > 4095 ? high - 4095 : 0;
    CS_TRY(cs_input_read(context, input, low, bytes, (size_t)(high - low) + END));
    for (int64_t i = high - low; i >= 0; i--)
      if (memcmp(bytes + i, "PK\5\6", 4) == 0) {
        memcpy(end, bytes + i, END);
        *at = low + i;
        return CELSPAN_OK;
      }
  }
  return fail(context, input, -1,
              "is not a zip archive, or is cut off: the end of its table is "
              "missing");
}

/* The 64-bit end of the table, for archives whose numbers do not fit. */
static celspan_status read_end_64(celspan_context *context, const cs_input *input, int64_t end_at,
                                  table_place *out) {
  unsigned char locator[LOCATOR_64], end[END_64];
  if (end_at < LOCATOR_64)
    return CELSPAN_OK;
  CS_TRY(cs_input_read(context, input, end_at - LOCATOR_64, locator, sizeof locator));
  if (memcmp(locator, "PK\6\7", 4) != 0)
    return CELSPAN_OK;
  uint64_t at = cs_bytes_little64(locator + 8);
  if (at > (uint64_t)input->size - END_64)
    return fail(context, input, end_at - LOCATOR_64 + 8, "the end of the table lies outside");
  CS_TRY(cs_input_read(context, input, (int64_t)at, end, sizeof end));
  if (memcmp(end, "PK\6\6", 4) != 0)
    return fail(context, input, (int64_t)at, "the 64-bit end of the table is missing");
  *out = (table_place){cs_bytes_little64(end + 48), cs_bytes_little64(end + 40),
                       cs_bytes_little64(end + 32)};
  return CELSPAN_OK;
}

static celspan_status find_table(celspan_context *context, const cs_input *input,
                                 table_place *out) {
  unsigned char end[END];
  int64_t at;
  if (input->size < END)
    return fail(context, input, -1, "is not a zip archive: it is too short");
  CS_TRY(find_end(context, input, end, &at));
  *out = (table_place){cs_bytes_little32(end + 16), cs_bytes_little32(end + 12),
                       cs_bytes_little16(end + 10)};
  if (out->offset == UINT32_MAX || out->size == UINT32_MAX || out->count == UINT16_MAX)
    CS_TRY(read_end_64(context, input, at, out));
  if (out->offset > (uint64_t)at || out->size > (uint64_t)at - out->offset)
    return fail(context, input, at, "the table of members lies outside");
  if (out->size > CS_ZIP_TABLE)
    return cs_input_fail(context, input, at, CELSPAN_LIMIT,
                         "the table of members has %llu bytes; at most %d are read",
                         (unsigned long long)out->size, CS_ZIP_TABLE);
  if (out->count > CS_ZIP_MEMBERS)
    return cs_input_fail(context, input, at, CELSPAN_LIMIT,
                         "the archive has %llu members; at most %d are read",
                         (unsigned long long)out->count, CS_ZIP_MEMBERS);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- the table */

/* Replaces a number that did not fit by the next 64-bit number of the extra field. */
static bool widen(int64_t *number, const unsigned char **at, const unsigned char *end) {
  if (*number != UINT32_MAX)
    return true;
  if (end - *at < 8 || cs_bytes_little64(*at) > INT64_MAX)
    return false;
  *number = (int64_t)cs_bytes_little64(*at);
  *at += 8;
  return true;
}

/* Takes sizes and offset from the extra field of 64-bit numbers, if it exists. */
static bool read_extra(const unsigned char *at, size_t size, cs_zip_member *member) {
  const unsigned char *end = at + size;
  while (end - at >= 4) {
    size_t length = cs_bytes_little16(at + 2);
    const unsigned char *field = at + 4;
    if ((size_t)(end - field) < length)
      return true; /* it is not in the standard form, and is ignored */
    at = field + length;
    if (cs_bytes_little16(field - 4) == 1)
      return widen(&member->unpacked, &field, at) && widen(&member->packed, &field, at) &&
             widen(&member->header, &field, at);
  }
  return true;
}

/* The entry at `at` of the table; its name goes to `name`. */
static celspan_status read_entry(celspan_context *context, const cs_input *input, cs_zip *zip,
                                 size_t *at, char **name) {
  const unsigned char *entry = zip->table + *at;
  int64_t place = zip->table_at + (int64_t)*at;
  size_t left = zip->table_size - *at;
  if (left < ENTRY || memcmp(entry, "PK\1\2", 4) != 0)
    return fail(context, input, place, "an entry of the table of members is damaged");
  size_t name_size = cs_bytes_little16(entry + 28), extra = cs_bytes_little16(entry + 30);
  size_t size = ENTRY + name_size + extra + cs_bytes_little16(entry + 32);
  if (left < size)
    return fail(context, input, place, "an entry of the table of members is cut off");
  cs_zip_member member = {.name = *name,
                          .header = cs_bytes_little32(entry + 42),
                          .packed = cs_bytes_little32(entry + 20),
                          .unpacked = cs_bytes_little32(entry + 24),
                          .sum = cs_bytes_little32(entry + 16),
                          .flags = cs_bytes_little16(entry + 8),
                          .method = cs_bytes_little16(entry + 10)};
  if (!read_extra(entry + ENTRY + name_size, extra, &member) ||
      member.header > zip->table_at - LOCAL_HEADER || member.packed > zip->table_at)
    return fail(context, input, place, "a member lies outside the archive");
  memcpy(*name, entry + ENTRY, name_size);
  (*name)[name_size] = 0;
  *name += name_size + 1;
  *at += size;
  zip->members[zip->count++] = member;
  return CELSPAN_OK;
}

/* Names lie in memory in the order of the table. */
static int by_name(const void *a, const void *b) {
  const cs_zip_member *one = a, *other = b;
  int order = strcmp(one->name, other->name);
  return order != 0 ? order : one->name < other->name ? -1 : 1;
}

static celspan_status read_table(celspan_context *context, const cs_input *input, cs_zip *zip,
                                 const table_place *place) {
  zip->table_at = (int64_t)place->offset;
  zip->table_size = (size_t)place->size;
  zip->capacity = (size_t)place->count;
  if (zip->table_size < ENTRY * zip->capacity)
    return fail(context, input, zip->table_at, "the table of members is too short");
  if (zip->capacity == 0)
    return CELSPAN_OK;
  /* A name is shorter than its entry, so there is room for the NUL. */
  zip->names_size = zip->table_size;
  zip->table = cs_mem_resize(zip->memory, NULL, 0, zip->table_size);
  zip->names = cs_mem_resize(zip->memory, NULL, 0, zip->names_size);
  zip->members = cs_mem_array(zip->memory, zip->capacity, sizeof *zip->members);
  if (!zip->table || !zip->names || !zip->members)
    return cs_fail_memory(context);
  CS_TRY(cs_input_read(context, input, zip->table_at, zip->table, zip->table_size));
  char *name = zip->names;
  for (size_t at = 0; zip->count < zip->capacity;)
    CS_TRY(read_entry(context, input, zip, &at, &name));
  qsort(zip->members, zip->count, sizeof *zip->members, by_name);
  return CELSPAN_OK;
}

celspan_status cs_zip_read(celspan_context *context, const cs_input *input, cs_zip *out) {
  *out = (cs_zip){.memory = context->memory};
  table_place place = {0, 0, 0};
  CS_TRY(find_table(context, input, &place));
  celspan_status status = read_table(context, input, out, &place);
  if (status != CELSPAN_OK)
    cs_zip_finish(out);
  return status;
}

void cs_zip_finish(cs_zip *zip) {
  cs_mem_free(zip->memory, zip->table, zip->table_size);
  cs_mem_free(zip->memory, zip->names, zip->names_size);
  cs_mem_free(zip->memory, zip->members, zip->capacity * sizeof *zip->members);
  *zip = (cs_zip){.memory = zip->memory};
}

/* The index of the first member whose name is not less than `name`; of several members with one
 * name, the first in the table. */
size_t cs_zip_place(const cs_zip *zip, const char *name) {
  size_t low = 0, high = zip->count;
  while (low < high) {
    size_t middle = low + (high - low) / 2;
    if (strcmp(zip->members[middle].name, name) < 0)
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

const cs_zip_member *cs_zip_find(const cs_zip *zip, const char *name) {
  size_t place = cs_zip_place(zip, name);
  bool is_found = place < zip->count && strcmp(zip->members[place].name, name) == 0;
  return is_found ? &zip->members[place] : NULL;
}

/* ---------------------------------------------------------------- members */

static celspan_status check_member(celspan_context *context, const cs_input *input,
                                   const cs_zip_member *member) {
  if (member->flags & ENCRYPTED)
    return cs_input_fail(context, input, member->header, CELSPAN_INPUT, "\"%s\" is encrypted",
                         member->name);
  if (member->method != 0 && member->method != 8)
    return cs_input_fail(context, input, member->header, CELSPAN_INPUT,
                         "\"%s\" is compressed by method %d; stored and deflated members are read",
                         member->name, member->method);
  return CELSPAN_OK;
}

celspan_status cs_zip_open(celspan_context *context, const cs_input *input,
                           const cs_zip_member *member, cs_zip_stream *out) {
  unsigned char header[LOCAL_HEADER];
  if (member->header == CS_ZIP_BARE) {
    cs_stream_range_init(&out->range, input, 0, member->packed);
    out->bytes = &out->range.base;
    return CELSPAN_OK;
  }
  CS_TRY(check_member(context, input, member));
  CS_TRY(cs_input_read(context, input, member->header, header, sizeof header));
  if (memcmp(header, "PK\3\4", 4) != 0)
    return cs_input_fail(context, input, member->header, CELSPAN_INPUT,
                         "the header of \"%s\" is missing", member->name);
  int64_t at = member->header + LOCAL_HEADER + cs_bytes_little16(header + 26) +
               cs_bytes_little16(header + 28);
  if (at > input->size || member->packed > input->size - at)
    return cs_input_fail(context, input, at, CELSPAN_INPUT, "\"%s\" is cut off", member->name);
  cs_stream_range_init(&out->range, input, at, at + member->packed);
  out->bytes = &out->range.base;
  if (member->method == 0)
    return CELSPAN_OK;
  CS_TRY(cs_stream_inflate_init(&out->inflate, context, &out->range.base, CS_STREAM_RAW_DEFLATE));
  out->bytes = &out->inflate.base;
  return CELSPAN_OK;
}

void cs_zip_close(cs_zip_stream *stream) {
  if (stream->bytes == &stream->inflate.base)
    cs_stream_inflate_finish(&stream->inflate);
}

static celspan_status check_sum(celspan_context *context, const cs_input *input,
                                const cs_zip_member *member, const unsigned char *bytes,
                                size_t size) {
  return crc32_z(0, bytes, size) == member->sum
             ? CELSPAN_OK
             : cs_input_fail(context, input, member->header, CELSPAN_INPUT,
                             "\"%s\" is damaged: its checksum is wrong", member->name);
}

celspan_status cs_zip_load(celspan_context *context, const cs_input *input,
                           const cs_zip_member *member, size_t most, unsigned char **out,
                           size_t *size) {
  cs_zip_stream stream;
  CS_TRY(cs_zip_open(context, input, member, &stream));
  unsigned char *bytes;
  size_t count;
  celspan_status status = cs_stream_load(stream.bytes, context, member->name, most, &bytes, &count);
  cs_zip_close(&stream);
  CS_TRY(status);
  status = check_sum(context, input, member, bytes, count);
  if (status != CELSPAN_OK) {
    cs_mem_free(context->memory, bytes, count + 1);
    return status;
  }
  *out = bytes;
  *size = count;
  return CELSPAN_OK;
}
