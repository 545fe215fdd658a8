/* What can be seen of a plane, as parcels: areas with a fill each, which do not overlap.
 *
 *     plane --cells--> fills (fills.c)                  +-------+-----+
 *           --borders--> arcs (arcs.c) --> parcels      |   1   a  2  |     the arc a is the border
 *                        (make.c)                       +-------+-----+     of parcel 1 and of 2
 *
 * How to use them: cs_parcels_make, then for each fill that is not clear its loops, for each loop
 * its walks, for each walk its arc, down or up. The end of a walk and the beginning of the next one
 * are at one height: where they are apart, a horizontal line leads from one to the other. The loops
 * of a fill together, filled by the even-odd rule, are its parcel, holes included.
 *
 * Points are in film units. All is within the frame. The parcels of two fills share arcs, so that
 * whoever rounds the points of an arc rounds them for both.
 *
 * Invariant: each arc that a parcel has is walked once for the fill on its left and once for that
 * on its right; the parcel is on the left of the walker, where y points down: going down, an arc
 * has it on its right side, and going up on its left one.
 */
#pragma once

#include "celspan/plane.h"
#include "inside/context.h"

typedef enum cs_fill_kind {
  CS_FILL_CLEAR, /* fill 0 and no other */
  CS_FILL_FLAT,
  CS_FILL_LINEAR,
  CS_FILL_RADIAL,
  CS_FILL_PICTURE /* at most two, one of them opaque: whatever cannot be one of the others */
} cs_fill_kind;

/* Codes are 8 bits in sRGB, with straight alpha. */
typedef struct cs_fill_stop {
  double at; /* 0 to 1 */
  unsigned char code[4];
} cs_fill_stop;

/* Between stops, codes are mixed as they are, which is within about one code of the plane. */
typedef struct cs_fill {
  cs_fill_kind kind;
  bool is_opaque;        /* a picture is certainly opaque */
  unsigned char code[4]; /* FLAT */
  size_t stop, stop_count;
  celspan_point from, to; /* LINEAR: where 0 and 1 are */
  /* RADIAL: x' = m0 x + m1 y + m2, y' = m3 x + m4 y + m5 are film units, of a gradient with its
   * focus at 0, 0, where 0 is, and the circle of 1 about centre, 0 */
  double matrix[6], centre, radius;
  size_t loop, loop_count; /* loops of its parcel */
} cs_fill;

/* A line has its ends alone, in the first and the last point. */
typedef struct cs_parcel_curve {
  bool is_line;
  celspan_point points[4];
} cs_parcel_curve;

/* A border, downwards. Fills are numbers; outside of the frame all is clear. */
typedef struct cs_parcel_arc {
  size_t curve, curve_count; /* at least one */
  uint32_t left, right;
  int32_t top, foot; /* in units of the plane */
} cs_parcel_arc;

typedef struct cs_parcel_walk {
  uint32_t arc;
  bool is_up;
} cs_parcel_walk;

typedef struct cs_parcel_loop {
  size_t walk, walk_count;
} cs_parcel_loop;

typedef struct cs_parcels {
  double width, height; /* film units */
  CS_ARRAY(cs_fill, fills);
  CS_ARRAY(cs_fill_stop, stops);
  CS_ARRAY(cs_parcel_arc, arcs);
  CS_ARRAY(cs_parcel_curve, curves);
  CS_ARRAY(cs_parcel_walk, walks);
  CS_ARRAY(cs_parcel_loop, loops);
  size_t fill_count, stop_count, arc_count, curve_count, walk_count, loop_count;
  int32_t columns, rows; /* the steps of the plane's grid, across and down, in its units */
  bool is_sum;           /* it is the sum of several pictures and has no areas */
} cs_parcels;

enum { CS_PARCEL_ARCS = 1000000 }; /* at most */

/* out: must be finished in any case. Errors: NO_MEMORY; LIMIT for more borders than CS_PARCEL_ARCS;
 * BAD_ARGUMENT for a plane with is_sum, and for one whose borders do not meet. */
CELSPAN_CHECKED celspan_status cs_parcels_make(celspan_context *context, const celspan_plane *plane,
                                               cs_parcels *out);
void cs_parcels_finish(cs_parcels *parcels, cs_memory *memory);

/* Walks the loops of sets of fills: `sets` has a number for each fill, and 0 for those that are in
 * none. Appends loops to the parcels, set by set; *first: of each set from 0 its first loop, and
 * after the last one the end, set_count + 1 numbers. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_parcels_walk(celspan_context *context, cs_parcels *parcels,
                                               const uint32_t *sets, uint32_t set_count,
                                               size_t *first);
/* The end of a walk that it comes from, and the one that it leads to. */
celspan_point cs_parcel_begin(const cs_parcels *parcels, cs_parcel_walk walk);
celspan_point cs_parcel_end(const cs_parcels *parcels, cs_parcel_walk walk);

/* What draws borders. points: after the one where it is. */
typedef struct cs_parcel_stylus {
  void *user;
  void (*move)(void *user, celspan_point to);
  void (*line)(void *user, celspan_point to);
  void (*curve)(void *user, const celspan_point points[3]);
  void (*close_path)(void *user);
} cs_parcel_stylus;

/* Draws an arc from the beginning of a walk, where the stylus is. */
void cs_parcel_draw_arc(const cs_parcels *parcels, cs_parcel_walk walk,
                        const cs_parcel_stylus *stylus);
/* Draws a loop and closes it. */
void cs_parcel_draw_loop(const cs_parcels *parcels, const cs_parcel_loop *loop,
                         const cs_parcel_stylus *stylus);
