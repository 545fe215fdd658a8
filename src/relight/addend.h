/* What a unit of one light adds to each pixel of a frame, as rows of spans that are made to be summed.
 *
 *     row of a frame    | 0 0 0 0 0 0 |1|3|4|2| 9 9 9 9 9 9 9 9 9 9 |7|0|0|2|2|2|2| 0 0 0
 *     spans here                      |-array-|------- single ------|---array-----|
 *
 *   what is 0 has no span; short spans become the numbers of an array, one plane of them where the
 *   channels are alike, else three; long ones stay singles and gradients
 *
 * INVARIANT: the spans of a row are sorted and disjoint, and their values lie in `values` in the order
 * of the spans: a single has three, a gradient six (colour, and slope a column), an array one or three
 * for each column, plane by plane.
 */
#ifndef CS_RELIGHT_ADDEND_H
#define CS_RELIGHT_ADDEND_H

#include "base/context.h"
#include "base/wide.h"

typedef enum cs_addend_kind {
  CS_ADDEND_SINGLE,
  CS_ADDEND_GRADIENT,
  CS_ADDEND_GREY,  /* an array of one plane */
  CS_ADDEND_ARRAY, /* of three */
} cs_addend_kind;

typedef struct cs_addend_span {
  int32_t x0, x1;
  int32_t origin; /* GRADIENT: the column of its colour */
  cs_addend_kind kind;
  size_t first; /* of its values */
} cs_addend_span;

typedef struct cs_addend {
  int32_t width, height;
  size_t *rows; /* the first span of each row, and the end of the last */
  cs_addend_span *spans;
  float *values;
  size_t span_count, span_capacity;
  size_t value_count, value_capacity;
} cs_addend;

/* Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_addend_init(celspan_context *context, int32_t width,
                                              int32_t height, cs_addend *out);
void cs_addend_finish(cs_addend *addend, cs_memory *memory);
size_t cs_addend_bytes(const cs_addend *addend);

/* Fills an addend, row by row. */
typedef struct cs_addend_writer {
  cs_addend *addend;
  bool is_through;   /* what comes through is added, 1 - alpha, instead of the colours */
  float *dense;      /* planes of a row: what is not in spans yet */
  int32_t from, end; /* of that */
} cs_addend_writer;

/* addend: initialized, borrowed. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_addend_writer_init(celspan_context *context, cs_addend *addend,
                                                     bool is_through, cs_addend_writer *out);
void cs_addend_writer_finish(celspan_context *context, cs_addend_writer *writer);
/* Row y, which follows the last one. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_addend_writer_row(celspan_context *context,
                                                    cs_addend_writer *writer, int32_t y,
                                                    const celspan_span *spans, size_t count);

/* Adds row y, times a weight for each channel, to three planes of `width` numbers, one after the
 * other. */
void cs_addend_add(const cs_addend *addend, cs_isa isa, int32_t y, const float weights[3],
                   float *planes);

/* ---- addend_wide.c */

CS_WIDE_DECLARE(void, cs_addend_plane,
                (float *restrict out, const float *restrict in, float weight, int32_t count));
CS_WIDE_DECLARE(void, cs_addend_constant, (float *out, float value, int32_t count));
/* Column k of those counted gets weight * (colour + slope * (first + k)). */
CS_WIDE_DECLARE(void, cs_addend_line,
                (float *out, float weight, float colour, float slope, int32_t first,
                 int32_t count));
/* Pixels of three planes, and of what comes through, for their alpha. */
CS_WIDE_DECLARE(void, cs_addend_pixels,
                (const float *restrict planes, const float *restrict through, float keep,
                 int32_t count, float *restrict rgba));

#endif
