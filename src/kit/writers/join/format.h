/* How the strips of each format are put together: the functions that join.c calls.
 *
 *   inspect, for every part --> begin --> add, for every part --> end
 *
 * INVARIANT: inspect reads the data about the rows, add reads the rows; neither unpacks a pixel,
 * and memory is that of a cs_joining whatever the files hold.
 */
#pragma once

#include <spanfile.h>

#include "inside/hash.h"
#include "inside/png.h"
#include "inside/sinks.h"

/* A file that will be joined: its place, and its bytes. Its contents are not trusted: numbers are
 * checked before they are used, and nothing is allocated by them. */
typedef struct cs_join_part {
  const char *path; /* borrowed */
  int descriptor;   /* -1: not open */
  uint64_t size;    /* bytes of the file */
  int32_t width, height;
  cs_strip strip;
  cs_hash form; /* the form of all properties that the strips of a picture have in common */
  uint64_t body, body_end; /* the bytes that contain the rows; PNG: body_end is where IEND begins */
} cs_join_part;

/* Errors: INPUT, also for anything but an ordinary file. */
CELSPAN_CHECKED celspan_status cs_join_part_open(celspan_context *context, const char *path,
                                                 cs_join_part *out);
void cs_join_part_close(cs_join_part *part);
/* All bytes of [offset, offset + size). Errors: INPUT, also where the file ends before. */
CELSPAN_CHECKED celspan_status cs_join_part_read(celspan_context *context, const cs_join_part *part,
                                                 uint64_t offset, void *bytes, size_t size);
/* Records INPUT with the sentence "PATH: what". */
celspan_status cs_join_part_fail(celspan_context *context, const cs_join_part *part,
                                 const char *format, ...) __attribute__((format(printf, 3, 4)));

enum { CS_JOIN_START = 26, CS_JOIN_PIECE = 1 << 16 };

typedef struct cs_joining {
  cs_file *file;             /* the file that is made */
  celspan_context *context;  /* the call's in progress, for callbacks of the library spanfile */
  cs_deflate_sum sum;        /* PNG: of all rows so far */
  spanfile_joiner *spanfile; /* span files; owned */
  unsigned char extension[CS_TGA_EXTENSION];
  unsigned char piece[CS_JOIN_PIECE]; /* a piece of a part while it is copied */
} cs_joining;

typedef struct cs_join_format {
  const char *name;       /* in messages */
  const char *endings[3]; /* the endings of the output's name; NULL after the last one */
  /* Whether a file with this beginning is of the format. */
  bool (*claims)(const unsigned char start[CS_JOIN_START]);
  /* Fills in all fields of an open part. Errors: INPUT. */
  celspan_status (*inspect)(celspan_context *context, cs_join_part *part);
  /* first: has been inspected, and is open. Errors: INPUT, OUTPUT, NO_MEMORY, here and below. */
  celspan_status (*begin)(cs_joining *joining, celspan_context *context, const cs_join_part *first);
  celspan_status (*add)(cs_joining *joining, celspan_context *context, const cs_join_part *part);
  celspan_status (*end)(cs_joining *joining, celspan_context *context);
} cs_join_format;

extern const cs_join_format cs_join_png, cs_join_tga, cs_join_span;
