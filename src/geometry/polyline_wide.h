/* Groups of vertices in vector code: all vertices of a group at once (polyline_wide.c).
 *
 *   points at even steps --seats--> parameters --points there--> places beside the curve
 *
 * A piece in powers goes all the way at once (cs_polyline_powers); the points of others are made
 * one at a time between the two steps (polyline.c).
 */
#ifndef CS_GEOMETRY_POLYLINE_WIDE_H
#define CS_GEOMETRY_POLYLINE_WIDE_H

#include "base/wide.h"
#include "geometry/boundary.h"

#define CS_POLYLINE_ROOM (CS_BOUNDARY_GROUP + 1)

/* The fields of cs_polyline_point, of all vertices of a group. */
typedef struct cs_polyline_points {
  double x[CS_POLYLINE_ROOM], y[CS_POLYLINE_ROOM];
  double slope_x[CS_POLYLINE_ROOM], slope_y[CS_POLYLINE_ROOM];
  double bend_x[CS_POLYLINE_ROOM], bend_y[CS_POLYLINE_ROOM];
} cs_polyline_points;

/* The seats of a group's vertices. */
typedef struct cs_polyline_seats {
  double t[CS_POLYLINE_ROOM + 2];  /* of vertex k at k + 1; 0 before the first and after the last */
  double y[CS_POLYLINE_ROOM];      /* the whole height nearest to each */
  int64_t whole[CS_POLYLINE_ROOM]; /* -1: the vertex is moved there; 0: it is not */
  double bent[CS_POLYLINE_ROOM];   /* 1: no arc can be near the curve here; 0 */
} cs_polyline_seats;

/* The vertices of a group: on the curve, and displaced so that chords keep the area. Elements
 * beyond a short group are not used. */
typedef struct cs_polyline_vertices {
  double x[CS_POLYLINE_ROOM + 1], y[CS_POLYLINE_ROOM + 1];
  double slope[CS_POLYLINE_ROOM]; /* dx/dy of the chord that begins there; 0 without height */
  double on_x[CS_POLYLINE_ROOM], on_y[CS_POLYLINE_ROOM];
  /* The same with piece->half on the curve too; set where halves are wanted. */
  double halved_x[CS_POLYLINE_ROOM], halved_y[CS_POLYLINE_ROOM];
  bool is_bent_above, is_bent_below; /* no arc can be near the curve at the first, at the last */
} cs_polyline_vertices;

/* c: the coefficients of a piece in powers, 4 of x and 4 of y. first: the group's first vertex.
 * stride: from vertex to vertex, more than 1 for the groups of a leap. */
CS_WIDE_DECLARE(void, cs_polyline_powers,
                (const double c[8], const cs_boundary_piece *piece, uint32_t first, uint32_t stride,
                 cs_polyline_vertices *out));
/* The two steps of it. points: those at even steps, and those at the seats. */
CS_WIDE_DECLARE(void, cs_polyline_sit,
                (const cs_polyline_points *points, const cs_boundary_piece *piece, uint32_t first,
                 uint32_t stride, cs_polyline_seats *out));
CS_WIDE_DECLARE(void, cs_polyline_place,
                (const cs_polyline_points *points, const cs_boundary_piece *piece, uint32_t first,
                 uint32_t stride, const cs_polyline_seats *seats, cs_polyline_vertices *out));

/* An arc: x + down (mean + curve (down - height)) at y + down. */
typedef struct cs_polyline_arc {
  double x, y, height, mean, curve;
} cs_polyline_arc;

/* Whether an arc for the vertices first..end is too far from one of their places on the curve. */
CS_WIDE_DECLARE(bool, cs_polyline_strays,
                (const cs_polyline_arc *arc, const cs_polyline_vertices *vertices, int first,
                 int end));

#endif
