/* The pixels of a layer, row after row from the top, as the readers of all formats give them.
 *
 *   cs_rows_source   where the pixels are: file, offsets, form. Made when the painting is read;
 *                    immutable
 *   cs_rows          an iterator over them, from the first row to the last; made when pixels are
 *                    needed, destroyed after the last row
 *
 * A row is RGBA, interleaved, alpha straight, 8 or 16 bits per channel in the machine's byte order,
 * coded as in the file.
 *
 * INVARIANT: rows are given in order, each once.
 */
#pragma once

#include "readers/layered/input.h"

typedef struct cs_rows cs_rows;
typedef struct cs_rows_source cs_rows_source;

typedef struct cs_rows_kind {
  /* Begins at the first row. input: must be open now, and whenever rows are read; borrowed. Errors:
   * INPUT, LIMIT, NO_MEMORY; *out does not change then. */
  celspan_status (*begin)(const cs_rows_source *source, celspan_context *context,
                          const cs_input *input, cs_rows **out);
  /* The next row. Errors: INPUT, NO_MEMORY. */
  celspan_status (*next)(cs_rows *rows, celspan_context *context, void *row);
  void (*end)(cs_rows *rows);
  void (*destroy)(cs_rows_source *source); /* frees the source */
} cs_rows_kind;

/* The first member of the structure of every kind. */
struct cs_rows_source {
  const cs_rows_kind *kind;
  cs_memory *memory;     /* borrowed from the painting */
  int32_t width, height; /* 1 or more */
  int bits;              /* the bits of a channel: 8 or 16 */
};

struct cs_rows {
  const cs_rows_source *source;
  cs_memory *memory;
};

static inline size_t cs_rows_size(const cs_rows_source *source) {
  return (size_t)source->width * 4 * (size_t)(source->bits / 8);
}
