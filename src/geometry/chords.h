/* Chords of a monotone piece for rows in which much happens: the nearest polyline with few vertices,
 * one like the other, made eight at a time.
 *
 *     *          vertex 0: the end of the piece
 *      \ .
 *       \  .  curve
 *        o  .    vertices between the ends are displaced outwards, so that the area left of the
 *        |  .    chords is the area left of the curve; those beside an end by half as much again,
 *        o .     because an end cannot be displaced
 *       /.
 *      *         vertex `chords`: the other end
 *
 * The polyline of polyline.h has arcs and longer groups, which pay where a chain goes through many
 * rows. These chords pay where it goes through few.
 *
 * Invariants: vertex k is a function of the piece and k alone; the ends are those of the piece, bit
 * by bit; no chord is further than CS_CHORDS_SAG 0.01from the curve, nearly.
 */
#ifndef CS_GEOMETRY_CHORDS_H
#define CS_GEOMETRY_CHORDS_H

#include "base/wide.h"
#include "geometry/boundary.h"

#define CS_CHORDS_BATCH 8
#define CS_CHORDS_SAG 0.01 /* pixels */

/* Vertices one after the other, and the slope dx/dy of the chord from each to the next. */
typedef struct cs_chords {
  double x[CS_CHORDS_BATCH + 1], y[CS_CHORDS_BATCH + 1], slope[CS_CHORDS_BATCH];
} cs_chords;

/* How many chords a piece has here. */
uint32_t cs_chords_count(const cs_boundary_piece *piece);
/* Makes the vertices from `first` on, CS_CHORDS_BATCH + 1 or as many as there are. chords: the
 * count. Returns how many chords lie between them, 1..CS_CHORDS_BATCH. A chord without height has
 * no slope. */
uint32_t cs_chords_make(const cs_boundary_set *set, const cs_boundary_piece *piece, uint32_t chords,
                        uint32_t first, cs_chords *out);

/* ---- chords_wide.c */

/* How far a vertex is displaced, in units of C'' times the square of its step. */
static inline double cs_chords_share(double vertex, double chords) {
  double beside = (vertex == 1 ? 0.5 : 0.0) + (vertex + 1 == chords ? 0.5 : 0.0);
  return (1 + beside) * (1.0 / 12);
}

/* All of a batch. c: coefficients of powers, 4 of x and 4 of y. */
CS_WIDE_DECLARE(void, cs_chords_powers,
                (const double c[8], const cs_boundary_piece *piece, double chords, double first,
                 cs_chords *out));
/* The slopes of a batch. */
CS_WIDE_DECLARE(void, cs_chords_slopes, (cs_chords * chords));

#endif
