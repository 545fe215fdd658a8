/* Writing: coded rows to JPEG, WebP, TIFF and OpenEXR.
 *
 *   rows --a format's `rows`, `end`--> bytes --put--> the core's file
 *
 * INVARIANT: the first failure of `put` is reported, by cs_write_close at the latest.
 */
#pragma once

#include "plugins/raster/raster.h"

/* The functions of the table. The name of the file precedes each sentence. */
celspan_status cs_write_open(const cs_picture_output *output, cs_picture_writer **out,
                             cs_picture_failure *failure);
celspan_status cs_write_rows(cs_picture_writer *writer, int32_t y, int32_t count, const void *rows,
                             cs_picture_failure *failure);
celspan_status cs_write_close(cs_picture_writer *writer, cs_picture_failure *failure);
void cs_write_abandon(cs_picture_writer *writer);

/* The destination of a format: bytes in any order. */
typedef struct cs_write_target {
  bool (*put)(void *user, uint64_t offset, const void *bytes, size_t size);
  void *user;
  uint64_t at; /* the offset of the next bytes */
  uint64_t size;
  bool has_failed;   /* `put` */
  bool lacks_memory; /* set by a format that found none on the way */
} cs_write_target;

bool cs_write_put(cs_write_target *target, const void *bytes, size_t size);

/* A format: the functions of one file, whose state is `self`. */
typedef struct cs_write_format {
  const char *name;
  /* NULL: there is no memory. The output and its names are borrowed until the end. */
  void *(*begin)(const cs_picture_output *output, cs_write_target *target);
  bool (*rows)(void *self, int32_t count, const unsigned char *rows); /* from the top */
  bool (*end)(void *self);                                            /* completes the file */
  void (*destroy)(void *self);
} cs_write_format;

extern const cs_write_format cs_write_jpeg, cs_write_webp, cs_write_tiff, cs_write_exr;

/* The bytes of a row. */
size_t cs_write_row(const cs_picture_output *output);
