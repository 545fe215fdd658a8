/* Soft layers: a defocused cel as values at the nodes of a grid over the frame.
 *
 *   bands (defocus/defocus.c makes them) --a row, or two blended--> knots: straight pieces of a row
 *                                      --between two knots, linear--> paint at a place
 *
 * Node (i, j) stands at ((i - 1/2) pitch_x, (j - 1/2) pitch_y) pixels: in the middles of the grid's
 * cells, the first of which lies before the frame. A plane holds four values a node: the paint's S
 * and its matte (1 - the mean of T); where T differs from channel to channel a second plane holds
 * T.
 *
 * Invariant: what a node holds is a function of the cel, its placement and the frame's size; lines
 * from knot to knot stray from the nodes by at most a quarter of 1/1023.
 */
#ifndef CS_SAMPLE_DEFOCUSED_H
#define CS_SAMPLE_DEFOCUSED_H

#include "base/context.h"
#include "base/vector.h"

/* Rows as straight pieces: equal values at two knots are a constant stretch. */
typedef struct cs_defocused_knots {
  int32_t *at;        /* nodes, ascending in each row, from the first to the last */
  float (*values)[4]; /* of each knot, plane after plane */
  bool *still;        /* scratch: of the row being made, which pieces are constant */
  size_t count, at_capacity, value_capacity, still_capacity;
} cs_defocused_knots;

/* band_rows rows of nodes: plane after plane, or as knots. */
typedef struct cs_defocus_band {
  float (*nodes)[4]; /* NULL where they are knots */
  size_t node_count;
  cs_defocused_knots knots;
  size_t *rows; /* the first knot of each row, and the end: band_rows + 1 */
  size_t row_capacity;
} cs_defocus_band;

typedef struct cs_defocused cs_defocused;
struct cs_defocused {
  double pitch_x, pitch_y; /* pixels */
  int32_t columns, rows;   /* nodes, at least 2 */
  int32_t band_rows;
  int planes;
  /* Bands are shared; one that was acquired stays until it is released. Threads: any.
   * Errors: NO_MEMORY, and those of the rows of the cel. */
  celspan_status (*acquire)(const cs_defocused *soft, celspan_context *context, int32_t band,
                            cs_defocus_band **out);
  void (*release)(const cs_defocused *soft, celspan_context *context, cs_defocus_band *band);
};

/* A soft layer as one worker sees it. */
typedef struct cs_defocused_view {
  cs_defocus_band *bands[2]; /* held; NULL: none */
  int32_t numbers[2];        /* theirs */
  bool stands;               /* the knots are those at height y */
  double y;
  const int32_t *at; /* the knots of the row: a band's, or its own */
  const float (*values)[4];
  size_t count;
  cs_defocused_knots own;
  float (*blended)[4]; /* a row of nodes, plane after plane */
} cs_defocused_view;

/* ---- bands */

void cs_defocus_band_free(cs_defocus_band *band, cs_memory *memory);
size_t cs_defocus_band_bytes(const cs_defocus_band *band);
/* Turns the nodes of a band of `rows` rows into knots. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_defocus_band_thin(const cs_defocused *soft,
                                                    celspan_context *context, int32_t rows,
                                                    cs_defocus_band *band);

/* ---- rows */

void cs_defocused_leave(const cs_defocused *soft, celspan_context *context,
                        cs_defocused_view *seen);
/* Brings `seen` to the height y, pixels. */
CELSPAN_CHECKED celspan_status cs_defocused_stand(const cs_defocused *soft,
                                                  celspan_context *context, cs_defocused_view *seen,
                                                  double y);
/* Where x lies among the nodes. */
static inline double cs_defocused_at(const cs_defocused *soft, double x) {
  double at = x / soft->pitch_x + 0.5, last = soft->columns - 1;
  return at < 0 ? 0 : at > last ? last : at;
}
static inline cs_v4 cs_defocused_value(const cs_defocused *soft, const cs_defocused_view *seen,
                                       size_t knot, int plane) {
  return cs_v4_load(seen->values[knot * (size_t)soft->planes + (size_t)plane]);
}
/* The piece that holds a place: its first knot. hint: where to look first. */
size_t cs_defocused_find(const cs_defocused_view *seen, double at, size_t hint);
/* The paint at x, at the height where `seen` stands. *piece: a hint, and where x was found. */
void cs_defocused_paint(const cs_defocused *soft, const cs_defocused_view *seen, double x,
                        size_t *piece, cs_v4 *s, cs_v4 *t);
/* The knots in x0 < x < x1, as places along the row: at most cs_defocused_break_limit. Returns how
 * many.
 */
size_t cs_defocused_breaks(const cs_defocused *soft, const cs_defocused_view *seen, double x0,
                           double x1, double *breaks);
size_t cs_defocused_break_limit(const cs_defocused *soft);

#endif
