/* Bytes one after the other: of a part of a file, or inflated from another stream.
 *
 *   file --range--> packed bytes --inflate--> bytes
 *
 * INVARIANT: a stream gives no byte twice, and never more than its range has; the memory that it
 * uses does not depend on how much it gives. Its input is open while it is read from.
 */
#pragma once

#include <zlib.h>

#include "readers/layered/input.h"

#define CS_STREAM_BUFFER 16384

typedef struct cs_stream cs_stream;
struct cs_stream {
  /* Gets up to `size` bytes: at least 1, except at the end of the stream, where *got is 0. */
  celspan_status (*pull)(cs_stream *stream, celspan_context *context, void *bytes, size_t size,
                         size_t *got);
  const cs_input *input; /* borrowed; for messages */
};

/* Exactly `size` bytes. what: the item, for the message if the stream ends before. Errors:
 * INPUT. */
CELSPAN_CHECKED celspan_status cs_stream_read(cs_stream *stream, celspan_context *context,
                                              void *bytes, size_t size, const char *what);

/* The rest of the stream, at most `most` bytes, in new memory of *size + 1 bytes that ends with a
 * NUL. Memory is allocated as bytes arrive. name: for the message. Errors: INPUT, LIMIT,
 * NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_stream_load(cs_stream *stream, celspan_context *context,
                                              const char *name, size_t most, unsigned char **out,
                                              size_t *size);

/* Bytes [at, end) of a file. */
typedef struct cs_stream_range {
  cs_stream base;
  int64_t at, end;
  size_t next, count; /* in the buffer */
  unsigned char buffer[CS_STREAM_BUFFER];
} cs_stream_range;

void cs_stream_range_init(cs_stream_range *range, const cs_input *input, int64_t at, int64_t end);

typedef enum cs_stream_wrapping {
  CS_STREAM_RAW_DEFLATE, /* as in zip files */
  CS_STREAM_ZLIB         /* as in PNG and PSD */
} cs_stream_wrapping;

/* Inflates the bytes of another stream. */
typedef struct cs_stream_inflate {
  cs_stream base;
  cs_stream *source; /* borrowed */
  cs_memory *memory; /* borrowed */
  z_stream zlib;
  bool is_ended;
  unsigned char buffer[CS_STREAM_BUFFER];
} cs_stream_inflate;

/* Errors: NO_MEMORY; there is nothing to finish then. */
CELSPAN_CHECKED celspan_status cs_stream_inflate_init(cs_stream_inflate *stream,
                                                      celspan_context *context, cs_stream *source,
                                                      cs_stream_wrapping wrapping);
void cs_stream_inflate_finish(cs_stream_inflate *stream);
