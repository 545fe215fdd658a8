/* Zip archives: the table at their end, and the bytes of a member.
 *
 *   local header  data  local header  data  ...  table (one entry a member)  end of table
 *                                                 ^---------------------------- offset
 *
 * Members are found by the table alone; nothing is ever written to a disk. Stored and deflated
 * members, and the 64-bit fields of large archives, are read; encrypted ones and archives in
 * several parts are refused.
 *
 * INVARIANT: a member's data lies inside the file and before the table. Its unpacked size is that
 * of the table, and is never trusted: memory is allocated as bytes arrive.
 *
 * Limits: CS_ZIP_MEMBERS members, a table of CS_ZIP_TABLE bytes.
 */
#pragma once

#include "readers/layered/stream.h"

#define CS_ZIP_MEMBERS 65536
#define CS_ZIP_TABLE (16 << 20)
#define CS_ZIP_BARE (-1) /* used as the header of a file that is not in an archive */

typedef struct cs_zip_member {
  const char *name; /* UTF-8 as in the archive; points into the table of the zip */
  int64_t header;   /* offset of the local header, or CS_ZIP_BARE */
  int64_t packed, unpacked;
  uint32_t sum; /* CRC-32 of the unpacked bytes */
  uint16_t flags, method;
} cs_zip_member;

typedef struct cs_zip {
  cs_memory *memory; /* borrowed */
  int64_t table_at;
  size_t table_size;
  unsigned char *table;
  char *names; /* ended by NUL each */
  size_t names_size;
  cs_zip_member *members; /* sorted by name; members of one name in the order of the table */
  size_t count, capacity;
} cs_zip;

/* Reads the table. Errors: INPUT, LIMIT, NO_MEMORY; then nothing must be finished. */
CELSPAN_CHECKED celspan_status cs_zip_read(celspan_context *context, const cs_input *input,
                                           cs_zip *out);
void cs_zip_finish(cs_zip *zip);
/* The first index in `members` with a name that is not less than this one; the count if there is
 * none. */
size_t cs_zip_place(const cs_zip *zip, const char *name);
/* The first member of that name in the table; NULL: there is none. */
const cs_zip_member *cs_zip_find(const cs_zip *zip, const char *name);

/* The bytes of a member, unpacked. */
typedef struct cs_zip_stream {
  cs_stream *bytes; /* one of the two streams below */
  cs_stream_range range;
  cs_stream_inflate inflate;
} cs_zip_stream;

/* Errors: INPUT, NO_MEMORY; there is nothing to finish then. */
CELSPAN_CHECKED celspan_status cs_zip_open(celspan_context *context, const cs_input *input,
                                           const cs_zip_member *member, cs_zip_stream *out);
void cs_zip_close(cs_zip_stream *stream);

/* All bytes of a member, at most `most`, verified by their checksum, in new memory of *size + 1
 * bytes that ends with a NUL. Errors: INPUT, LIMIT, NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_zip_load(celspan_context *context, const cs_input *input,
                                           const cs_zip_member *member, size_t most,
                                           unsigned char **out, size_t *size);
