/* Soft layers: a defocused cel as values at the nodes of a grid over the frame.
 *
 *   bands of nodes (filter/soften.c makes them) --two rows, by height--> the nodes of a row
 *                                               --between two nodes, linear--> paint at a place
 *
 * Node (i, j) stands at ((i - 1/2) pitch_x, (j - 1/2) pitch_y) pixels: in the middles of the grid's
 * cells, the first of which lies before the frame. A plane holds four values a node: the paint's S
 * and its matte (1 - the mean of T); where T differs from channel to channel a second plane holds
 * T.
 *
 * Invariant: what a node holds is a function of the cel, its placement and the frame's size.
 */
#ifndef CS_COMPOSE_SOFT_H
#define CS_COMPOSE_SOFT_H

#include "base/context.h"
#include "base/vector.h"

/* band_rows rows of nodes, plane after plane. */
typedef struct cs_soft_band {
  float (*nodes)[4];
} cs_soft_band;

typedef struct cs_soft cs_soft;
struct cs_soft {
  double pitch_x, pitch_y; /* pixels */
  int32_t columns, rows;   /* nodes, at least 2 */
  int32_t band_rows;
  int planes;
  /* Bands are shared; one that was acquired stays until it is released. Threads: any.
   * Errors: NO_MEMORY, and those of the rows of the cel. */
  celspan_status (*acquire)(const cs_soft *soft, celspan_context *context, int32_t band,
                            cs_soft_band **out);
  void (*release)(const cs_soft *soft, celspan_context *context, cs_soft_band *band);
};

/* A soft layer as one worker sees it. */
typedef struct cs_seen_soft {
  cs_soft_band *bands[2]; /* held; NULL: none */
  int32_t numbers[2];     /* theirs */
  bool stands;            /* nodes are those at height y */
  double y;
  float (*nodes)[4]; /* plane after plane */
} cs_seen_soft;

void cs_soft_leave(const cs_soft *soft, celspan_context *context, cs_seen_soft *seen);
/* Brings `seen` to the height y, pixels. */
CELSPAN_CHECKED celspan_status cs_soft_stand(const cs_soft *soft, celspan_context *context,
                                             cs_seen_soft *seen, double y);
/* The paint at x, at the height where `seen` stands. */
void cs_soft_paint(const cs_soft *soft, const cs_seen_soft *seen, double x, cs_v4 *s, cs_v4 *t);
/* Where, x0 < x < x1, straight lines through the paint must end so that none strays far from it,
 * and where it begins or ends to be constant: at most cs_soft_break_limit. Returns how many. */
size_t cs_soft_breaks(const cs_soft *soft, const cs_seen_soft *seen, double x0, double x1,
                      double *breaks);
size_t cs_soft_break_limit(const cs_soft *soft);

#endif
