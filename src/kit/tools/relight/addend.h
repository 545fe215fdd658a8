/* What a unit of one light adds to each pixel of a frame, as rows of spans that are made to be
 * summed.
 *
 *     row of a frame    | 0 0 0 0 0 0 |1|3|4|2| 9 9 9 9 9 9 9 9 9 9 |7|0|0|2|2|2|2| 0 0 0
 *     spans here                      |-array-|------- single ------|---array-----|
 *
 *   what is 0 has no span; short spans become the numbers of an array, one plane of them where the
 *   channels are alike, else three; long ones stay singles and gradients
 *
 * Arrays end where a piece of the row does, CS_ADDEND_PIECE columns. Their numbers are codes of 16
 * bits from the least to the greatest of each plane, half a step off at most, and faint ones are
 * left out, as long as what all addends of a frame are off by in that piece stays within a budget;
 * else floats.
 *
 * INVARIANT: the spans of a row are sorted and disjoint, and their values lie in `values` in the
 * order of the spans: a single has three, a gradient six (colour, and slope a column), floats one
 * or three for each column, plane by plane; codes have the least number and the step of each plane,
 * then codes likewise, two in the room of a value.
 */
#pragma once

#include "inside/context.h"
#include "inside/wide.h"

typedef enum cs_addend_kind {
  CS_ADDEND_SINGLE,
  CS_ADDEND_GRADIENT,
  CS_ADDEND_FLOATS,
  CS_ADDEND_CODES,
} cs_addend_kind;

/* Columns of a piece of a row. */
#define CS_ADDEND_PIECE 64

typedef struct cs_addend_span {
  int32_t x0, x1;
  int32_t origin;       /* GRADIENT: the column at which its colour is given */
  uint16_t kind;        /* cs_addend_kind */
  uint16_t plane_count; /* FLOATS, CODES: 1 or 3 */
  size_t first;         /* where its values begin */
} cs_addend_span;

typedef struct cs_addend {
  int32_t width, height;
  CS_ARRAY(size_t, rows); /* the first span of each row, and the end of the last */
  CS_ARRAY(cs_addend_span, spans);
  CS_ARRAY(float, values);
  size_t span_count, value_count;
} cs_addend;

/* Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_addend_init(celspan_context *context, int32_t width,
                                              int32_t height, cs_addend *out);
void cs_addend_finish(cs_addend *addend, cs_memory *memory);
size_t cs_addend_bytes(const cs_addend *addend);

/* The total error of all addends of a frame, in each piece of each row. */
typedef struct cs_addend_budget {
  int32_t pieces, height; /* pieces of a row */
  float *spent;
} cs_addend_budget;

/* Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_addend_budget_init(celspan_context *context, int32_t width,
                                                     int32_t height, cs_addend_budget *out);
void cs_addend_budget_finish(cs_addend_budget *budget, cs_memory *memory);

/* Fills an addend, row by row. */
typedef struct cs_addend_writer {
  cs_addend *addend;
  cs_addend_budget *budget; /* borrowed */
  float *spent;             /* what the current row has used */
  cs_isa isa;
  size_t plane_count; /* 3 for colours, or 1 for the transmitted light, 1 - alpha */
  float *dense;       /* the planes of a row: numbers that are not yet in spans */
  int32_t from, end;  /* of that */
} cs_addend_writer;

/* addend, budget: initialized, borrowed. is_through: the transmitted light is added instead of
 * colours. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_addend_writer_init(celspan_context *context, cs_addend *addend,
                                                     cs_addend_budget *budget, bool is_through,
                                                     cs_addend_writer *out);
void cs_addend_writer_finish(celspan_context *context, cs_addend_writer *writer);
/* Adds row y, the row after the previous one. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_addend_writer_row(celspan_context *context,
                                                    cs_addend_writer *writer, int32_t y,
                                                    const celspan_span *spans, size_t count);

/* ---- addend_wide.c */

/* Pixels as planes of their colours, or as a plane of 1 - alpha. */
CS_WIDE_DECLARE(void, cs_addend_split,
                (const float *rgba, int32_t count, float *red, float *green, float *blue));
CS_WIDE_DECLARE(void, cs_addend_through, (const float *rgba, int32_t count, float *through));

/* Adds row y, times a weight for each channel, to three planes, `stride` numbers apart. */
CS_WIDE_DECLARE(void, cs_addend_add,
                (const cs_addend *addend, int32_t y, const float weights[3], size_t stride,
                 float *planes));
/* Pixels from four planes: three of colours, and one of the transmitted light, of which `keep`
 * counts. */
CS_WIDE_DECLARE(void, cs_addend_pixels,
                (const float *planes, size_t stride, float keep, int32_t count, float *rgba));
