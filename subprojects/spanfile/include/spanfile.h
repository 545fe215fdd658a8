/* spanfile - pictures as rows of spans, in a file.
 *
 * A span file is an extended Targa: the pixels of a row are runs of one colour, gradients between
 * two, and raw pixels; a row that repeats the one above, or differs from it only in where its spans
 * end, is stored as just that. So the size of a file follows the number of spans and not of pixels,
 * and a picture may be millions of pixels a side. docs/spanfile.md specifies it byte by byte.
 *
 * The writer streams: it calls back with bytes in order and holds one row and less than 1 MiB. The
 * reader asks for bytes where it needs them and gives any row, in any order.
 *
 * Depends on the C library alone. No globals, no printing; every failure is a status. A writer or
 * reader belongs to one thread at a time.
 *
 * Ownership: borrowed - used during the call and forgotten; new - the caller destroys it.
 */
#ifndef SPANFILE_H
#define SPANFILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum spanfile_status {
  SPANFILE_OK = 0,
  SPANFILE_NO_MEMORY,
  SPANFILE_BAD_ARGUMENT, /* the caller's mistake */
  SPANFILE_BAD_FILE,     /* truncated, altered, or not a span file */
  SPANFILE_READ_FAILED,  /* the read function returned false */
  SPANFILE_WRITE_FAILED  /* the write function returned false */
} spanfile_status;

/* Pixels are red, green, blue, alpha. */
typedef enum spanfile_format {
  SPANFILE_SRGB8 = 1, /* 4 bytes: sRGB-coded, alpha straight */
  SPANFILE_HALF = 2   /* 8 bytes: IEEE binary16, little endian; linear light, premultiplied */
} spanfile_format;

/* 4 or 8 bytes. */
size_t spanfile_pixel_size(spanfile_format format);

typedef enum spanfile_kind {
  SPANFILE_RAW = 0,     /* as many pixels in `values` as it is long */
  SPANFILE_RUN = 1,     /* one pixel, repeated */
  SPANFILE_GRADIENT = 2 /* the first and the last pixel in `values`; 2 to 32768 long */
} spanfile_kind;

typedef struct spanfile_span {
  uint32_t end;   /* the column after its last; it begins where the one before ends */
  uint32_t kind;  /* spanfile_kind */
  uint64_t pixel; /* run: its bytes, the first lowest; else 0 */
} spanfile_span;

/* A row: sorted spans from column 0 to the width, none empty. Neighbouring runs differ, and raw
 * spans are never neighbours. */
typedef struct spanfile_row {
  const spanfile_span *spans;
  size_t count;
  const unsigned char *values; /* the values of raw and gradient spans, in order */
} spanfile_row;

/* One hook for all memory: block NULL allocates, new_size 0 frees and returns NULL, else resizes.
 */
typedef void *(*spanfile_resize)(void *user, void *block, size_t old_size, size_t new_size);

/* ---------------------------------------------------------------- writing */

typedef struct spanfile_writer spanfile_writer;

typedef struct spanfile_writer_desc {
  uint32_t width, height; /* at least 1 */
  spanfile_format format;
  bool (*write)(void *user, const void *bytes, size_t size); /* the next bytes; false: failed */
  void *user;
  spanfile_resize resize; /* NULL: the C library's */
  void *resize_user;
  /* Of a strip, some rows of a larger picture: the row there that its row 0 is, and how many rows
   * that has; strip_height 0: a picture by itself. See spanfile_joiner. */
  uint32_t strip_row, strip_height;
} spanfile_writer_desc;

/* desc: borrowed, its functions used until the end. out: new. */
spanfile_status spanfile_writer_create(const spanfile_writer_desc *desc, spanfile_writer **out);
/* NULL is ignored. */
void spanfile_writer_destroy(spanfile_writer *writer);

/* The next pixels of the current row: `count` times one pixel (its bytes, the first lowest), or an
 * array of pixels as bytes. Runs and gradients are found in arrays, short runs are kept as pixels:
 * the pixels that are read back are the same, the spans need not be. Errors stick: all later
 * calls fail with the same status. BAD_ARGUMENT: more pixels than the row has. */
spanfile_status spanfile_writer_run(spanfile_writer *writer, uint32_t count, uint64_t pixel);
spanfile_status spanfile_writer_pixels(spanfile_writer *writer, const void *pixels, uint32_t count);
/* Many runs in one call, which is faster; equal neighbours are one run. */
typedef struct spanfile_run {
  uint32_t count; /* at least 1 */
  uint64_t pixel;
} spanfile_run;
spanfile_status spanfile_writer_runs(spanfile_writer *writer, const spanfile_run *runs,
                                     size_t run_count);
/* Ends the row. BAD_ARGUMENT: pixels are missing, or all rows have been written. */
spanfile_status spanfile_writer_row(spanfile_writer *writer);
/* After the last row: index and trailer, and all bytes to the write function. */
spanfile_status spanfile_writer_finish(spanfile_writer *writer);

/* Parts of a picture, packed by several threads: a part is the rows from a multiple of
 * SPANFILE_PART_ROWS up to the next one, or to the height. It is a writer without a file, which
 * holds the bytes of its part. Parts are joined to the file in order; the bytes of the file are
 * what one writer would have written of the same rows.
 *
 *   spanfile_writer_create_part(&desc, &part);            one or several for each thread
 *   spanfile_writer_begin_part(part, 256); rows           side by side
 *   spanfile_writer_join(file, part);                     in order
 */
#define SPANFILE_PART_ROWS 256

/* desc: as that of the file; write is not used. out: new; rows of its first part may follow. */
spanfile_status spanfile_writer_create_part(const spanfile_writer_desc *desc,
                                            spanfile_writer **out);
/* Forgets the part that was packed, and any failure, and begins the one whose first row this is. */
spanfile_status spanfile_writer_begin_part(spanfile_writer *part, uint32_t row);
/* Adds a complete part, the next of the file. part: borrowed. */
spanfile_status spanfile_writer_join(spanfile_writer *writer, const spanfile_writer *part);

/* ---------------------------------------------------------------- reading */

typedef struct spanfile_reader spanfile_reader;

/* Where and why a file is refused. */
typedef struct spanfile_fault {
  uint64_t offset;  /* the offset of the byte of the file where it was found */
  char reason[120]; /* "row 7: the checksum is wrong" */
} spanfile_fault;

typedef struct spanfile_source {
  /* All bytes of [offset, offset + size), which lies within the file; false: failed. */
  bool (*read)(void *user, uint64_t offset, void *bytes, size_t size);
  void *user;
  uint64_t size;          /* the size of the file */
  spanfile_resize resize; /* NULL: the C library's */
  void *resize_user;
} spanfile_source;

typedef struct spanfile_info {
  uint32_t width, height;
  spanfile_format format;
  uint32_t strip_row, strip_height; /* of a strip; strip_height 0: a picture by itself */
} spanfile_info;

/* The bytes from the start that spanfile_is needs. */
enum { SPANFILE_MAGIC_BYTES = 26 };
/* Whether a file that begins with these bytes claims to be a span file. */
bool spanfile_is(const void *bytes, size_t size);

/* Reads header and trailer. source: borrowed, its functions used until the end. out: new. fault:
 * set when the status is not OK; may be NULL, here and below. */
spanfile_status spanfile_reader_create(const spanfile_source *source, spanfile_reader **out,
                                       spanfile_fault *fault);
void spanfile_reader_destroy(spanfile_reader *reader);
spanfile_info spanfile_reader_info(const spanfile_reader *reader);

/* Row y. Valid until the next call. The next row costs its own bytes, any other at most 256 rows or
 * 64 KiB and a row more. After a failure other rows can be asked for. Memory: 64 KiB, the row's
 * bytes in the file, and at most twice its spans and values. */
spanfile_status spanfile_reader_row(spanfile_reader *reader, uint32_t y, spanfile_row *out,
                                    spanfile_fault *fault);
/* Reads every byte: OK when the file is whole and every checksum right. counts: NULL, or rows by
 * how they are stored and spans by kind. */
typedef struct spanfile_counts {
  uint64_t literal_rows, moved_rows, same_rows;
  uint64_t spans[3]; /* by spanfile_kind */
} spanfile_counts;
spanfile_status spanfile_reader_check(spanfile_reader *reader, spanfile_counts *counts,
                                      spanfile_fault *fault);

/* ---------------------------------------------------------------- strips */

/* Puts strips, which are files of their own, under one another: their records are copied, not
 * unpacked. The bytes are those that one writer would have written of all rows. Strips begin at
 * multiples of SPANFILE_PART_ROWS. Memory: less than 1 MiB, whatever is in the files. */
typedef struct spanfile_joiner spanfile_joiner;

/* desc: of the whole picture. Otherwise as spanfile_writer_create. */
spanfile_status spanfile_joiner_create(const spanfile_writer_desc *desc, spanfile_joiner **out);
/* The next strip. source: borrowed during the call. BAD_FILE, with the fault: not a span file, or
 * not the strip that comes next, or a record is wrong. After a failure the joiner can only be
 * destroyed. */
spanfile_status spanfile_joiner_add(spanfile_joiner *joiner, const spanfile_source *source,
                                    spanfile_fault *fault);
/* After the last strip: index and trailer. BAD_ARGUMENT: rows are missing. */
spanfile_status spanfile_joiner_finish(spanfile_joiner *joiner);
/* NULL is ignored. */
void spanfile_joiner_destroy(spanfile_joiner *joiner);

/* The pixels of columns [x0, x1), within the row, as bytes. Any thread. */
void spanfile_row_pixels(spanfile_format format, const spanfile_row *row, uint32_t x0, uint32_t x1,
                         void *pixels);
/* The pixels [first, first + count) of a gradient of `length` pixels between two. Any thread. */
void spanfile_gradient_pixels(spanfile_format format, const void *ends, uint32_t length,
                              uint32_t first, uint32_t count, void *pixels);

#ifdef __cplusplus
}
#endif
#endif
