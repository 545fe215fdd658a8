/* Crowds: intervals in which very many translucent edges share pixels, so that following their
 * intersections would cost far more than looking at samples of each pixel: hatching, hair, rain.
 *
 *      p      p+1
 *      +------/+     pixel by pixel, layer by layer from the camera backwards:
 *      | .  ./ |       inside   which of the samples lie in the layer
 *      |   ./. |       area     how much of the pixel it covers, from its edges: exact
 *      |. ./.  |       weight   area / share of the samples inside
 *      |  /.  .|       light += paint * weight * (what the samples inside still let through)
 *      +-/-----+
 *
 * So the areas of all edges are exact, and the samples only say how layers overlap. An edge costs
 * the same however many others share its pixels, and no order of the edges is needed.
 *
 * The samples are points of a lattice: no two share a height or a column, and lines in all
 * directions divide them evenly. How many there are depends on the two strongest layers that have
 * edges in the pixel. A pixel is then within 1/255 of the exact mean. Layers that wind around
 * points of one pixel in more than two ways are not weighted.
 *
 * Invariants: a pixel depends on the edges that it contains and the layers present in it alone. As
 * for local sweeps (local_sweep.h), nothing changes left and right of the interval.
 */
#pragma once

#include "base/wide.h"
#include "engine/area/intervals.h"

#define CS_CROWD_LEAST 32     /* the least number of boundaries of a crowd */
#define CS_CROWD_A_PIXEL 6    /* the least number of samples in a pixel, on the average */
#define CS_CROWD_SUMS 16      /* partial sums over samples: the same number on all machines */
#define CS_CROWD_SAMPLES 2048 /* the most in a pixel */

/* The samples of a pixel, from top to foot. */
typedef struct cs_crowd_lattice {
  _Alignas(CS_WIDE_LINE) float x[CS_CROWD_SAMPLES]; /* from the pixel's corner, as y */
  _Alignas(CS_WIDE_LINE) float y[CS_CROWD_SAMPLES];
  int32_t count;
} cs_crowd_lattice;

/* A straight piece of a boundary, relative to a pixel. */
typedef struct cs_crowd_line {
  float x, slope, top, foot; /* x: at the top of the piece */
  int32_t direction;
} cs_crowd_line;

/* The samples of a pixel that lie in a layer: -1 in `inside`; the others are 0. */
typedef struct cs_crowd_cover {
  int32_t count; /* the count of the samples inside */
  /* the least and the greatest number of times that the layer winds around a sample */
  int32_t low, high;
} cs_crowd_cover;

/* ---- crowd_wide.c */

/* Finds the samples inside a layer. The layer winds `base` times around the left side of a pixel
 * and has the edges `lines` in it. A sample is inside where (winding & mask) != 0. inside: room for
 * all samples. */
CS_WIDE_DECLARE(cs_crowd_cover, cs_crowd_find,
                (const cs_crowd_lattice *lattice, const cs_crowd_line *lines, size_t line_count,
                 int32_t base, int32_t mask, int32_t *inside));
/* Dims the samples inside: the light that they still transmit is reduced by `share`. Returns the
 * sum of this light before the call. */
CS_WIDE_DECLARE(float, cs_crowd_dim,
                (float *through, const int32_t *inside, int32_t count, float share));

/* ---- crowd.c */

typedef struct cs_crowd_piece {
  double xa, xb;    /* x at the top and at the foot of the piece, from the left of the frame */
  double top, foot; /* heights from the top of the row: 0..1 */
  double by_twice;  /* 1 / twice the width of the piece */
  float slope;      /* dx/dy */
} cs_crowd_piece;

/* A boundary in the row. If the boundary has begun or ended further left, the member is a step of
 * winding below that height. */
typedef struct cs_crowd_member {
  uint32_t layer;
  uint32_t piece, piece_count;
  uint32_t next; /* the next member that enters in the same column; UINT32_MAX: none */
  int32_t direction;
  int32_t end; /* the first column to the right of the member */
  double top, foot;
  bool is_passed; /* the composer has crossed it */
} cs_crowd_member;

/* A member that reaches the current column. Members of nearer layers come first. */
typedef struct cs_crowd_live {
  uint64_t key; /* the key of its layer and its number */
  int32_t end;  /* the member's */
} cs_crowd_live;

/* The memory that a worker keeps for crowds. */
typedef struct cs_crowd_room {
  cs_crowd_lattice lattices[3];
  /* by channel; only the first channel is used if all are equal */
  _Alignas(CS_WIDE_LINE) float through[3][CS_CROWD_SAMPLES];
  _Alignas(CS_WIDE_LINE) int32_t inside[CS_CROWD_SAMPLES];
} cs_crowd_room;

typedef struct cs_crowd {
  cs_isa isa;
  void *storage;       /* the memory of the room; NULL: not needed yet */
  cs_crowd_room *room; /* aligned to a line of the cache */
  cs_crowd_piece *pieces;
  cs_crowd_member *members;
  uint32_t *entering;      /* by column: the first member that enters there */
  cs_crowd_live *live;     /* members in the current column */
  cs_crowd_live *arriving; /* members that were not in the previous column */
  uint32_t *leaving;       /* members that were only in the previous column */
  cs_crowd_line *lines;    /* the lines of a layer in a pixel */
  size_t piece_count, piece_capacity, member_count, member_capacity;
  size_t arriving_count, arriving_capacity;
  size_t entering_capacity, live_count, live_capacity, leaving_capacity, line_capacity;
} cs_crowd;

void cs_crowd_init(cs_crowd *crowd);
void cs_crowd_finish(cs_crowd *crowd, cs_memory *memory);
/* Whether an interval of a whole row is crowded. */
bool cs_crowd_suits(const cs_intervals *intervals, const cs_interval *interval,
                    const cs_composer *composer, int32_t width);
/* Draws the members of a sweep, and those that begin, through a whole row. The composer is left of
 * all members, before and after the call. extent: the columns of the members; next: the least x of
 * everything that is drawn after the members; right: the cell right of the members. Errors:
 * NO_MEMORY, and the errors of painting. */
CELSPAN_CHECKED celspan_status cs_crowd_draw(cs_crowd *crowd, cs_local_sweep *sweep,
                                             cs_extent extent, double next, const cs_cell *right);
