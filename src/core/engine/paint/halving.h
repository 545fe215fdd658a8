/* Curves of colour along a row as linear spans: a curve becomes one line if it is straight
 * enough, else it is halved.
 *
 *   colour
 *     |                        *  last
 *     |                 o. - '
 *     |           o. - '             *  ends of the line
 *     |     o. - '                   o  the curve, compared with the line at 1/4, 1/2 and 3/4 of
 *     | *  first                        the way
 *     +-+---+-----+-----+------+----> column
 *       x0       / \        x1 - 1
 *                a curve that is halved ends in one column and continues in the next, so its halves
 *                do not overlap
 *
 * A curve of two columns is always straight, so the depth of halving is at most log2 of the width.
 */
#pragma once

#include "engine/span/row.h"
#include "engine/span/run.h"

/* The error that spans may have, unless the frame says another one. */
#define CS_HALVING_ERROR (1.0f / 1023)

/* A point of a curve: at the middle of a column. */
typedef struct cs_halving_point {
  int32_t column;
  double at; /* for the curve's own use */
  cs_v4 colour;
} cs_halving_point;

typedef struct cs_halving_curve cs_halving_curve;
struct cs_halving_curve {
  celspan_context *context;
  float tolerance; /* how far a line may be from the curve at its quarters: cs_halving_tolerance */
  cs_row *row;     /* the row to which the spans are appended */
  /* Whether the line from one point to another is near the curve between them. */
  celspan_status (*test)(cs_halving_curve *curve, const cs_halving_point *first,
                         const cs_halving_point *last, bool *is_straight);
  /* The points of the columns `column` and `column` + 1. */
  celspan_status (*split)(cs_halving_curve *curve, int32_t column, cs_halving_point points[2]);
};

/* Appends the curve between two points, their columns included. Errors: those of the curve, and
 * NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_halving_fit(cs_halving_curve *curve,
                                              const cs_halving_point *first,
                                              const cs_halving_point *last);
/* The same for a curve that is known not to be straight. */
CELSPAN_CHECKED celspan_status cs_halving_split(cs_halving_curve *curve,
                                                const cs_halving_point *first,
                                                const cs_halving_point *last);

/* The column at `quarter` quarters of the way from the first column of a run to its last. */
static inline int32_t cs_halving_quarter(cs_run run, int quarter) {
  return run.x0 + (int32_t)((int64_t)(run.x1 - 1 - run.x0) * quarter / 4);
}

/* The run of columns from one point to another, both included. */
static inline cs_run cs_halving_run(const cs_halving_point *first, const cs_halving_point *last) {
  return (cs_run){first->column, last->column + 1, 0};
}

/* Half the error that the frame's spans may have; error 0: the usual one. */
static inline float cs_halving_tolerance(float error) {
  return 0.5f * (error > 0 ? error : CS_HALVING_ERROR);
}

/* Whether a colour is near the line between two points, which are more than a column apart. */
static inline bool cs_halving_is_near(const cs_halving_curve *curve, const cs_halving_point *first,
                                      const cs_halving_point *last, int32_t column, cs_v4 colour) {
  float share = (float)(column - first->column) / (float)(last->column - first->column);
  cs_v4 line = first->colour + share * (last->colour - first->colour);
  for (int c = 0; c < 4; c++)
    if (!(__builtin_fabsf(colour[c] - line[c]) <= curve->tolerance))
      return false;
  return true;
}

/* Appends the line between two points. */
static inline CELSPAN_CHECKED celspan_status cs_halving_put(const cs_halving_curve *curve,
                                                            const cs_halving_point *first,
                                                            const cs_halving_point *last) {
  float steps = last->column > first->column ? (float)(last->column - first->column) : 1;
  return cs_row_gradient(curve->context, curve->row, first->column, last->column + 1, first->colour,
                         (last->colour - first->colour) / steps);
}
