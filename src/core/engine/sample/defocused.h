/* Defocused cels as values at the nodes of a grid over the frame.
 *
 *     node (i, j) is at ((i - 1/2) pitch_x, (j - 1/2) pitch_y) pixels; i and j are counted from the
 *     first column and the first row of the part that is there
 *
 *         o - - - - o - - - - o - - - - o       j      o  nodes; the first column and row of them
 *         :    |    :         :         :              lie outside the frame
 *         :  --+----:---------:---------:---  y = 0
 *         :    |    :         :         :
 *         o - - - - o - - - - o - - - - o       j + 1
 *         :    |    :         :         :
 *      -  -  - | -  -  -  -  -  -  -  -  -  -   a row of the frame: mixed from the rows of nodes
 *         :    |    :         :         :       above and below
 *              x = 0
 *
 *   bands (defocus/ makes them) --a row, or two mixed--> vertices --along the line--> paint at x
 *
 * Where a cel has a grid of its own (defocus/), a row of nodes at the height of the frame's row is
 * mixed from that grid when it is asked for, as far as there is anything in it, and kept by the
 * view alone: there are no bands. Where nodes are pixels, they are the paint, without vertices: of
 * such a mixed row, or of the bands of a shifted cel.
 *
 * A plane holds four values a node: the paint's S and its matte (1 - the mean of T); where T
 * differs from channel to channel a second plane holds T.
 *
 * Invariant: the values of a node are a function of the cel, its placement and the frame's size;
 * the nodes of a mixed row beyond its visible ones are clear.
 */
#pragma once

#include "base/arrays.h"
#include "base/vector.h"
#include "engine/sample/node_row.h"
#include "engine/span/run.h"

/* The nodes of one row, plane after plane. Stretches of one colour are known group by group: in an
 * even group all nodes are equal, and only its first and its last one need to be there. */
typedef struct cs_defocused_nodes {
  const float (*planes[2])[4];
  const bool *even; /* for each group, in all planes together; NULL: unknown */
} cs_defocused_nodes;

/* A band: band_rows rows of nodes that are made and kept together, plane after plane or as
 * polylines. */
typedef struct cs_defocus_band {
  CS_ARRAY(float[4], nodes); /* NULL where they are polylines */
  CS_ARRAY(size_t, rows);    /* the first vertex of each row, and the end: band_rows + 1 */
  size_t row_count;
  cs_node_polyline polyline;
} cs_defocus_band;

/* Columns [first, end) of a row of nodes. */
typedef struct cs_defocused_range {
  int32_t first, end;
} cs_defocused_range;

typedef struct cs_defocused cs_defocused;
struct cs_defocused_view;
struct cs_defocused {
  double pitch_x, pitch_y;  /* pixels */
  int32_t first_x, first_y; /* the numbers of the first node, and where it lies, in pitches */
  double left, top;
  int32_t columns, rows; /* nodes, at least 2 */
  int32_t band_rows;
  int planes;
  /* Bands are shared; one that was acquired is kept until it is released. Threads: any.
   * Errors: NO_MEMORY, and those of the rows of the cel. */
  celspan_status (*acquire)(const cs_defocused *defocused, celspan_context *context, int32_t band,
                            cs_defocus_band **out);
  void (*release)(const cs_defocused *defocused, celspan_context *context, cs_defocus_band *band);
  /* NULL: there are bands. Fills `mixed` of a view, which has its room, and then `visible`, at a
   * height in pixels; gives up what the view keeps for that.
   * Errors: NO_MEMORY, and those of the rows of the cel. */
  celspan_status (*mix)(const cs_defocused *defocused, celspan_context *context,
                        struct cs_defocused_view *view, double y);
  void (*forget)(celspan_context *context, struct cs_defocused_view *view);
  bool are_pixels; /* each node is a pixel, of a mixed row or of a band, which has all its nodes */
};

/* A defocused cel as one worker sees it, along one row. */
typedef struct cs_defocused_view {
  cs_defocus_band *bands[2]; /* acquired; NULL: none */
  int32_t numbers[2];        /* the numbers of these bands */
  bool is_placed;            /* the vertices are those at height y */
  double y;
  const int32_t *at; /* the vertices of the row: of a band, or its own */
  const float (*values)[4];
  size_t count;
  cs_node_polyline own;
  CS_ARRAY(float[4], mixed);   /* a row of nodes, plane after plane */
  struct cs_regrid_rows *rows; /* only of mixed rows */
  cs_defocused_range visible;  /* the nodes of a row of pixels, or of a mixed one, that may not be
                                  clear */
  const float (*pixels[2])[4]; /* where nodes are pixels: the row of them, by plane */
} cs_defocused_view;

/* ---- bands */

void cs_defocus_band_free(cs_defocus_band *band, cs_memory *memory);
size_t cs_defocus_band_bytes(const cs_defocus_band *band);
/* Room for the nodes of a band, which are not set. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_defocus_band_room(const cs_defocused *defocused,
                                                    celspan_context *context,
                                                    cs_defocus_band *band);
/* Begins a band of `rows` rows that is kept as polylines; adds its next row; gives back the room
 * that was not needed. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_defocus_band_begin(celspan_context *context, int32_t rows,
                                                     cs_defocus_band *band);
CELSPAN_CHECKED celspan_status cs_defocus_band_add(const cs_defocused *defocused,
                                                   celspan_context *context,
                                                   const cs_defocused_nodes *nodes,
                                                   cs_defocus_band *band);
CELSPAN_CHECKED celspan_status cs_defocus_band_end(const cs_defocused *defocused,
                                                   celspan_context *context, cs_defocus_band *band);
/* How many groups a row of nodes has. */
static inline int32_t cs_defocused_groups(const cs_defocused *defocused) {
  return (defocused->columns + CS_DEFOCUSED_GROUP - 1) / CS_DEFOCUSED_GROUP;
}

/* ---- rows */

/* Gives up all that a view has acquired. */
void cs_defocused_release(const cs_defocused *defocused, celspan_context *context,
                          cs_defocused_view *view);
/* Moves a view to the height y, pixels. Errors: NO_MEMORY, and those of making a band. */
CELSPAN_CHECKED celspan_status cs_defocused_move(const cs_defocused *defocused,
                                                 celspan_context *context, cs_defocused_view *view,
                                                 double y);
/* Where x lies among the nodes of a row. */
static inline double cs_defocused_at(const cs_defocused *defocused, double x) {
  double at = x / defocused->pitch_x - defocused->left, last = defocused->columns - 1;
  return at < 0 ? 0 : at > last ? last : at;
}
static inline cs_v4 cs_defocused_value(const cs_defocused *defocused, const cs_defocused_view *view,
                                       size_t vertex, int plane) {
  return cs_v4_load(view->values[vertex * (size_t)defocused->planes + (size_t)plane]);
}
/* The line that a place among the nodes is on: its first vertex. hint: where to search first. */
size_t cs_defocused_find(const cs_defocused_view *view, double at, size_t hint);
/* Columns of a frame: `count` columns from x0 on, or the listed ones. */
typedef struct cs_defocused_places {
  const int32_t *columns; /* NULL: x0 .. */
  int32_t x0, count;
} cs_defocused_places;
/* The paints at the centres of columns; lane 3 is 0. */
void cs_defocused_paints(const cs_defocused *defocused, const cs_defocused_view *view,
                         const cs_defocused_places *places, float (*s)[4], float (*t)[4]);
/* Where nodes are pixels: the columns of a frame that may not be clear at a view's height. */
static inline cs_defocused_range cs_defocused_visible(const cs_defocused *defocused,
                                                      const cs_defocused_view *view) {
  int32_t left = defocused->first_x - 1; /* the column of the first node */
  return (cs_defocused_range){left + view->visible.first, left + view->visible.end};
}
/* The samples of `count` columns from x0 on, if nodes are pixels, there is one plane, and all these
 * columns have samples; otherwise NULL. */
const float (*cs_defocused_samples(const cs_defocused *defocused, const cs_defocused_view *view,
                                   int32_t x0, int32_t count))[4];
/* The most that each channel lets through anywhere in a run, at the height of the view. */
cs_v4 cs_defocused_through(const cs_defocused *defocused, const cs_defocused_view *view,
                           cs_run run);
/* The vertices inside a run, as places x along the row; at most as many as the limit says. Returns
 * how many. */
size_t cs_defocused_breaks(const cs_defocused *defocused, const cs_defocused_view *view, cs_run run,
                           double *breaks);
size_t cs_defocused_break_limit(const cs_defocused *defocused);
