/* The parts of making parcels: fills.c, arcs.c. */
#pragma once

#include "inside/hash.h"
#include "writers/parcels/parcels.h"
#include "writers/plane/plane_data.h"

/* Fills by what they are, so that each is there once. */
typedef struct cs_fill_table {
  cs_hash_table known;
  uint32_t pictures[2]; /* the numbers of the fills of pictures, translucent, opaque; 0: none yet */
} cs_fill_table;

/* The fill of a cell, a new one if need be. *out: before, 1 if all borders of the cell face it (see
 * planefile_hides), and else 0. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_fill_find(celspan_context *context, const celspan_plane *plane,
                                            const planefile_band *band, uint32_t cell,
                                            cs_fill_table *table, cs_parcels *parcels,
                                            uint32_t *out);

/* Borders beyond the sides of the frame, 0 on the left and 1 on the right: at a height, by how much
 * the sum of their fills changes. */
typedef struct cs_side_change {
  int side;
  int32_t height;
  int64_t by;
  uint64_t squares; /* by how much the sum of their squares does */
} cs_side_change;

typedef struct cs_frame_sides {
  cs_side_change *changes;
  size_t count, capacity;
} cs_frame_sides;

/* Adds a part of a border. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_sides_add(celspan_context *context, cs_frame_sides *sides,
                                            int side, int32_t top, int32_t foot, uint32_t left,
                                            uint32_t right);
/* Appends the arcs along the sides; is_sum becomes true where several fills lie along one. Errors:
 * those of cs_arc_put. */
CELSPAN_CHECKED celspan_status cs_sides_put(celspan_context *context, cs_frame_sides *sides,
                                            cs_parcels *parcels);
void cs_sides_finish(cs_frame_sides *sides, cs_memory *memory);

/* Appends the arcs of a border, and adds the parts beyond the frame. Errors: NO_MEMORY; LIMIT. */
CELSPAN_CHECKED celspan_status cs_arc_put(celspan_context *context, const planefile_band *band,
                                          const planefile_border *border, uint32_t left,
                                          uint32_t right, cs_frame_sides *sides,
                                          cs_parcels *parcels);
/* Says that there are too many arcs: LIMIT. */
CELSPAN_CHECKED celspan_status cs_arc_refuse(celspan_context *context);
/* Appends a part of one of the frame's sides, inside of which there is a fill. */
CELSPAN_CHECKED celspan_status cs_arc_put_side(celspan_context *context, int side, int32_t top,
                                               int32_t foot, uint32_t fill, cs_parcels *parcels);

/* Heights in units that may be one, because the plane has rounded them: in steps of its grid. */
static inline int32_t cs_parcels_apart(const cs_parcels *parcels) {
  enum { UNITS = 64, STEPS = 4 };
  return parcels->rows > 1 ? STEPS * parcels->rows : UNITS;
}

/* The share of a curve, or of a line, at which it comes to a height in film units; where an arc is
 * at a height. */
double cs_curve_share(const cs_parcel_curve *curve, double y);
double cs_arc_x(const cs_parcels *parcels, uint32_t arc, double y);

/* The arcs at a height in units, from left to right. Those that are nearer to each other than the
 * plane's rounding may have exchanged their places. */
typedef struct cs_beside {
  celspan_context *context;
  const cs_parcels *parcels;
  double height;
  uint32_t *arcs;
  size_t count;
} cs_beside;
/* Gets an arc by its place in the row. */
typedef celspan_status cs_beside_visit(const cs_beside *row, size_t place, void *user);
/* Visits each arc that has a height, at some heights between its ends. Errors: NO_MEMORY, and those
 * of visits, after which none follows. */
CELSPAN_CHECKED celspan_status cs_beside_walk(celspan_context *context, const cs_parcels *parcels,
                                              int visits, cs_beside_visit *visit, void *user);
/* How wide it is between two arcs of the row, across the first one, in film units. */
double cs_beside_gap(const cs_beside *row, size_t place, size_t other);

/* How far apart two borders of one shape may be by the plane's rounding, across and down, in film
 * units. */
celspan_point cs_parcels_near(const cs_parcels *parcels);
/* Joins arcs between which there is a fill that is no wider than the plane's rounding, and drops
 * those that separate nothing. Errors: NO_MEMORY; LIMIT. */
CELSPAN_CHECKED celspan_status cs_parcels_join_slivers(celspan_context *context,
                                                       cs_parcels *parcels);
/* Moves ends of arcs that meet to one point. The loops of all fills must be there. Errors:
 * NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_joints_make(celspan_context *context, cs_parcels *parcels);

/* BAD_ARGUMENT if places of the plane have several fills, because it is a sum. */
CELSPAN_CHECKED celspan_status cs_parcels_refuse_sums(celspan_context *context,
                                                      const cs_parcels *parcels);
