/* What several partial layers of a pixel of a crowd (crowd.h) show together: for each, how much
 * light reaches it where it is present, and how much passes it.
 *
 *   one, two   all sets of layers with their areas. Joint areas are sums over pairs of lines
 *   weak       any number of faint ones: products of means with the covariances of pairs. Taken
 *              only where what this leaves out is less than half a code
 *   strong     slabs of the pixel, at whose middle the spans between lines are exact. If slabs end
 *              wherever a line begins or ends or two cross, so is the pixel. With many lines they
 *              are even as well; each is composited along its spans, so shapes that abut never
 *              leave a gap
 *
 * A layer is present where the directions of the lines left of a point sum to an inside winding.
 * The left side of the pixel is made of lines at x = 0, too.
 *
 * Invariant: a plain layer's lines sum to 1 inside and to 0 outside, whatever its windings are and
 * whichever way it turns. So areas, and joint areas, are sums over lines.
 */
#pragma once

#include "base/wide.h"
#include "engine/area/crowd_lines.h"
#include "engine/compose/composer.h"

typedef struct cs_crowd_partial {
  const cs_layer *layer;
  size_t first, end; /* lines */
  double area;       /* the share of the pixel; plain layers only */
  int32_t mask;      /* inside where (sum & mask) != 0 */
  int32_t sum;       /* of a point in a slab, or of a set */
  bool is_plain;
  float hides;          /* the most of any channel */
  cs_v4 before;         /* what whole layers in front let through */
  cs_v4 reached, after; /* light that reaches the layer where it is present; and what passes it */
} cs_crowd_partial;

#define CS_CROWD_SUMS 8 /* partial sums: the same number on all machines */

/* Lines as single numbers, CS_CROWD_SUMS at a time. */
typedef struct cs_crowd_numbers {
  float *x, *slope, *top, *foot, *direction, *weight;
} cs_crowd_numbers;

/* A line at the middle of a slab. */
typedef struct cs_crowd_passage {
  double x;
  size_t line;
  cs_crowd_partial *partial;
} cs_crowd_passage;

typedef struct cs_crowd_solver {
  cs_isa isa;
  CS_ARRAY(cs_crowd_line, lines);
  CS_ARRAY(cs_crowd_partial, partials); /* the nearest first */
  CS_ARRAY(double, heights);            /* of slabs */
  CS_ARRAY(cs_crowd_passage, passages);
  CS_ARRAY(float, numbers); /* storage of cs_crowd_numbers */
  size_t line_count, partial_count;
} cs_crowd_solver;

/* Solves at least one partial layer: sets `reached` and `after` of each. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_crowd_solver_solve(cs_crowd_solver *solver,
                                                     celspan_context *context);
/* The greatest of the three channels. */
static inline float cs_crowd_most(cs_v4 v) {
  float most = v[0] > v[1] ? v[0] : v[1];
  return most > v[2] ? most : v[2];
}

/* ---- crowd_solver_wide.c */

/* Sum over lines [first, end) and all lines before them: direction * weight * twice the area right
 * of both. The weights of lines from `first` on must be 0. */
CS_WIDE_DECLARE(float, cs_crowd_solver_joint,
                (const cs_crowd_numbers *numbers, size_t first, size_t end));
