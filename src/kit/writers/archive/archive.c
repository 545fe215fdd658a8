#include "writers/archive/archive.h"

#include <stdio.h>
#include <string.h>
#include <zlib.h>

#include "common/bytes.h"

/* Of heads of members, of entries of the list, and of the end, in bytes. */
enum { HEAD = 30, ENTRY = 46, END = 22, NAMES_ARE_UTF8 = 0x800, VERSION = 20, DEFLATED = 8 };

/* What a zlib stream has before and after the deflated bytes. */
enum { ZLIB_HEAD = 2, ZLIB_TAIL = 4 };

/* The date 1 January 1980: equal frames have equal files. */
enum { DATE = 1 << 5 | 1 };

static unsigned char *store(unsigned char *at, uint32_t number, int bytes) {
  return cs_bytes_put_little(at, number, bytes);
}

/* What heads and entries share, from the needed version on. */
static unsigned char *store_member(unsigned char *at, const cs_archive_member *member) {
  at = store(at, VERSION, 2);
  at = store(at, NAMES_ARE_UTF8, 2);
  at = store(at, member->is_deflated ? DEFLATED : 0, 2);
  at = store(at, 0, 2); /* time */
  at = store(at, DATE, 2);
  at = store(at, member->sum, 4);
  at = store(at, member->packed, 4);
  at = store(at, member->size, 4);
  at = store(at, (uint32_t)strlen(member->name), 2);
  return store(at, 0, 2); /* more fields */
}

static void make_head(const cs_archive_member *member, unsigned char out[HEAD]) {
  (void)store_member(store(out, 0x04034b50, 4), member);
}

celspan_status cs_archive_begin(cs_archive *archive, const char *name) {
  unsigned char head[HEAD];
  CS_TRY(CS_ARRAY_RESERVE(archive->context, archive->members, archive->count + 1));
  cs_archive_member *member = &archive->members[archive->count++];
  *member = (cs_archive_member){.at = (uint32_t)cs_file_size(archive->file)};
  snprintf(member->name, sizeof member->name, "%s", name);
  make_head(member, head);
  CS_TRY(cs_file_write(archive->file, archive->context, head, sizeof head));
  CS_TRY(cs_file_write(archive->file, archive->context, member->name, strlen(member->name)));
  cs_file_sum_begin(archive->file);
  return CELSPAN_OK;
}

static celspan_status refuse_size(const cs_archive *archive, const char *path) {
  return cs_fail(archive->context, CELSPAN_LIMIT,
                 "%s: the file has 4 GiB or more, which no reader of this format expects", path);
}

/* Writes the head of the last member again, whose bytes in the file are there. */
static celspan_status end_member(cs_archive *archive, const char *path, cs_archive_member *member) {
  unsigned char head[HEAD];
  uint64_t end = cs_file_size(archive->file);
  /* The list must fit, too. */
  if (end > UINT32_MAX - (archive->count + 1) * (ENTRY + CS_ARCHIVE_NAME))
    return refuse_size(archive, path);
  member->packed = (uint32_t)(end - member->at - HEAD - strlen(member->name));
  if (!member->is_deflated)
    member->size = member->packed;
  make_head(member, head);
  return cs_file_write_at(archive->file, archive->context, member->at, head, sizeof head);
}

celspan_status cs_archive_end(cs_archive *archive, const char *path) {
  cs_archive_member *member = &archive->members[archive->count - 1];
  member->sum = cs_file_sum_end(archive->file);
  return end_member(archive, path, member);
}

celspan_status cs_archive_put(cs_archive *archive, const char *path, const char *name,
                              const void *bytes, size_t size) {
  CS_TRY(cs_archive_begin(archive, name));
  CS_TRY(cs_file_write(archive->file, archive->context, bytes, size));
  return cs_archive_end(archive, path);
}

/* room: of `packed`, in bytes. */
static celspan_status put_packed(cs_archive *archive, const char *path, const char *name,
                                 const void *bytes, size_t size, unsigned char *packed,
                                 size_t room) {
  uLongf used = room;
  if (compress2(packed, &used, bytes, size, Z_BEST_COMPRESSION) != Z_OK) /* it has room */
    return cs_fail(archive->context, CELSPAN_NO_MEMORY, "%s: no memory to pack '%s'", path, name);
  CS_TRY(cs_archive_begin(archive, name));
  CS_TRY(cs_file_write(archive->file, archive->context, packed + ZLIB_HEAD,
                       used - ZLIB_HEAD - ZLIB_TAIL));
  cs_archive_member *member = &archive->members[archive->count - 1];
  member->is_deflated = true;
  member->size = (uint32_t)size;
  member->sum = (uint32_t)crc32_z(0, bytes, size);
  return end_member(archive, path, member);
}

celspan_status cs_archive_pack(cs_archive *archive, const char *path, const char *name,
                               const void *bytes, size_t size) {
  if (size >= UINT32_MAX)
    return refuse_size(archive, path);
  const size_t room = compressBound(size);
  unsigned char *packed = cs_mem_resize(archive->context->memory, NULL, 0, room);
  if (!packed)
    return cs_fail_memory(archive->context);
  celspan_status status = put_packed(archive, path, name, bytes, size, packed, room);
  cs_mem_free(archive->context->memory, packed, room);
  return status;
}

static celspan_status put_entry(const cs_archive *archive, const cs_archive_member *member) {
  unsigned char entry[ENTRY] = {0};
  unsigned char *at = store(entry, 0x02014b50, 4);
  at = store_member(store(at, VERSION, 2), member);
  at = store(at, 0, 2); /* comment */
  at = store(at, 0, 2); /* disk */
  at = store(at, 0, 2); /* attributes, inside */
  at = store(at, 0, 4); /* and outside */
  (void)store(at, member->at, 4);
  CS_TRY(cs_file_write(archive->file, archive->context, entry, sizeof entry));
  return cs_file_write(archive->file, archive->context, member->name, strlen(member->name));
}

celspan_status cs_archive_complete(cs_archive *archive) {
  unsigned char end[END] = {0};
  uint64_t from = cs_file_size(archive->file);
  for (size_t i = 0; i < archive->count; i++)
    CS_TRY(put_entry(archive, &archive->members[i]));
  unsigned char *at = store(store(end, 0x06054b50, 4), 0, 4);
  at = store(store(at, (uint32_t)archive->count, 2), (uint32_t)archive->count, 2);
  at = store(at, (uint32_t)(cs_file_size(archive->file) - from), 4);
  (void)store(at, (uint32_t)from, 4);
  return cs_file_write(archive->file, archive->context, end, sizeof end);
}

void cs_archive_finish(cs_archive *archive) {
  CS_ARRAYS_FREE(archive->context->memory, archive, members, members);
}
