/* A file that is to be joined: where it belongs, and the bytes of it.
 *
 * INVARIANT: nothing in the file is believed. Numbers are checked before they are used, and nothing is
 * allocated by them.
 */
#ifndef CS_OUTPUT_JOIN_PART_H
#define CS_OUTPUT_JOIN_PART_H

#include "base/hash.h"
#include "output/strip.h"

typedef struct cs_join_part {
  const char *path; /* borrowed */
  int descriptor;   /* -1: not open */
  uint64_t size;    /* bytes of the file */
  int32_t width, height;
  cs_strip strip;
  cs_hash form;            /* of everything that all strips of a picture have in common */
  uint64_t body, body_end; /* bytes that hold the rows; PNG: body_end is where IEND begins */
} cs_join_part;

/* Errors: INPUT, also for what is not an ordinary file. */
CELSPAN_CHECKED celspan_status cs_join_part_open(celspan_context *context, const char *path,
                                                 cs_join_part *out);
void cs_join_part_close(cs_join_part *part);
/* All bytes of [offset, offset + size). Errors: INPUT, also where the file ends before. */
CELSPAN_CHECKED celspan_status cs_join_part_read(celspan_context *context, const cs_join_part *part,
                                                 uint64_t offset, void *bytes, size_t size);
/* INPUT: "PATH: what". */
celspan_status cs_join_part_fail(celspan_context *context, const cs_join_part *part,
                                 const char *format, ...) __attribute__((format(printf, 3, 4)));

#endif
