/* OpenEXR of one part in rows, packed by zlib.
 * Source: OpenEXR File Layout, and Technical Introduction to OpenEXR (openexr.com).
 *
 *   magic, version | attributes, 0 | place of each chunk | chunks
 *   a chunk: first row, size, rows; a row: the values of each channel, in the order of their names
 *
 * A chunk has 16 rows, or one if rows are wide, so that memory holds little of a picture with very
 * many channels. The writer knows no files and takes no memory of its own, except zlib's: the core
 * and the picture module that works without OpenImageIO both write with it.
 *
 * INVARIANT: after a failed call only the memory may be released.
 */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#define CS_EXR_MAGIC 20000630u

/* The version, its flag for names of more than 31 bytes, and the most bytes that a name may have
 * then. */
enum { CS_EXR_VERSION = 2, CS_EXR_LONG_NAMES = 0x400, CS_EXR_NAME = 255 };

/* The packings by zlib: one row in a chunk, or CS_EXR_LINES. */
enum { CS_EXR_ROW = 2, CS_EXR_ROWS = 3, CS_EXR_LINES = 16 };

typedef enum cs_exr_type { CS_EXR_WHOLE, CS_EXR_HALF, CS_EXR_FLOAT } cs_exr_type;

/* A channel, and where its values are in a row that is put, in the machine's byte order, which is
 * little endian: the first `offset` bytes from the beginning, each next one `stride` further. */
typedef struct cs_exr_channel {
  const char *name;
  cs_exr_type type; /* HALF or FLOAT */
  size_t offset, stride;
} cs_exr_channel;

/* An attribute of any type; its bytes are in the order of the file. */
typedef struct cs_exr_attribute {
  const char *name, *type;
  const void *bytes;
  size_t size;
} cs_exr_attribute;

static inline cs_exr_attribute cs_exr_text(const char *name, const char *text) {
  return (cs_exr_attribute){name, "string", text, strlen(text)};
}

/* The attributes of a frame in a film: its number, and the rate where it is known. */
typedef struct cs_exr_timing {
  cs_exr_attribute attributes[2]; /* they point into this structure, which must not be moved */
  size_t count;
  unsigned char frame[4], rate[8];
} cs_exr_timing;

/* Everything is borrowed until the end. */
typedef struct cs_exr_picture {
  int32_t width, height;
  const cs_exr_channel *channels; /* in the order of their names (cs_exr_sort) */
  size_t channel_count;
  const cs_exr_attribute *attributes;
  size_t attribute_count;
  const float *primaries; /* x and y of red, green, blue and white; NULL: none are written */
} cs_exr_picture;

/* The destination: bytes in any order. false: stop. */
typedef struct cs_exr_target {
  bool (*put)(void *user, uint64_t offset, const void *bytes, size_t size);
  void *user;
} cs_exr_target;

typedef struct cs_exr {
  const cs_exr_picture *picture;
  cs_exr_target target;
  uint64_t at;   /* the offset of the next bytes */
  uint64_t list; /* where the list of the places of chunks is */
  size_t row;    /* bytes of one row */
  int lines;     /* rows of a chunk */
  int32_t done;  /* rows */
  int kept;      /* rows in the chunk that is not full */
  unsigned char *places, *rows, *scratch, *packed;
} cs_exr;

/* frames_second: 0 where it is not known. */
void cs_exr_time(cs_exr_timing *timing, double frames_second, int32_t frame);
/* Puts channels into the order that the format asks for. */
void cs_exr_sort(cs_exr_channel *channels, size_t count);
/* The bytes of memory that a writer of this picture needs. */
size_t cs_exr_memory(const cs_exr_picture *picture);
/* Writes the header. memory: as many bytes as cs_exr_memory says; borrowed until the end. */
bool cs_exr_begin(cs_exr *exr, const cs_exr_picture *picture, cs_exr_target target, void *memory);
/* The next row, from the top. */
bool cs_exr_row(cs_exr *exr, const unsigned char *row);
/* Completes the file, after the last row. */
bool cs_exr_end(cs_exr *exr);
