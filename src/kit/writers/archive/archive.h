/* A zip archive. Members are stored as they are, as pictures are packed already, or deflated.
 * Source: APPNOTE.TXT of PKWARE, 4.3.
 *
 *   member: head, name, bytes | member | ... | list of all members | end
 *
 * A member's bytes are appended to the file; its head, which has their sum and number, is written
 * again when they are there.
 *
 * INVARIANT: a member that was begun is ended before the next one. Archives stay below 4 GiB.
 */
#pragma once

#include "inside/context.h"
#include "inside/sinks.h"

enum { CS_ARCHIVE_NAME = 40 };

typedef struct cs_archive_member {
  char name[CS_ARCHIVE_NAME];
  bool is_deflated;
  uint32_t at, sum, size, packed; /* size: of its bytes; packed: of those in the file */
} cs_archive_member;

typedef struct cs_archive {
  celspan_context *context;
  cs_file *file; /* borrowed, and empty at the beginning */
  CS_ARRAY(cs_archive_member, members);
  size_t count;
} cs_archive;

/* name: of at most CS_ARCHIVE_NAME - 1 bytes. Errors: OUTPUT, NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_archive_begin(cs_archive *archive, const char *name);
/* path: for the message. Errors: OUTPUT; LIMIT for an archive that is too large. */
CELSPAN_CHECKED celspan_status cs_archive_end(cs_archive *archive, const char *path);
/* A whole member. */
CELSPAN_CHECKED celspan_status cs_archive_put(cs_archive *archive, const char *path,
                                              const char *name, const void *bytes, size_t size);
/* A whole member, deflated. Errors: NO_MEMORY, too. */
CELSPAN_CHECKED celspan_status cs_archive_pack(cs_archive *archive, const char *path,
                                               const char *name, const void *bytes, size_t size);
/* Writes the list, after the last member. */
CELSPAN_CHECKED celspan_status cs_archive_complete(cs_archive *archive);
/* Frees the list, which does not end the file. */
void cs_archive_finish(cs_archive *archive);
