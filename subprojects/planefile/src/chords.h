/* Chords of a piece at the size at which it is drawn.
 *
 *      o  vertices lie beside the curve, at even steps of its parameter, displaced outwards so that
 *     /.  the area left of the chords is that left of the curve. The ends of a piece lie on it, and
 *    o .  the chords there are shorter by a square root of 2: then the displacement of their other
 *     \.  ends makes up for all of the area.
 *      o
 *
 * INVARIANT: a vertex is a function of the piece, the size of the frame and its own number, so
 * that it does not matter which of them are made.
 */
#pragma once

#include "layout.h"

#define PF_HEIGHT 65536 /* of a row: heights are multiples of 1 / it */

/* A piece of the frame, in HEIGHTths of pixels in both directions. */
typedef struct pf_curve {
  double x[4], y[4]; /* coefficients of powers; homogeneous where it is rational, otherwise
                      * displaced */
  double w[4];       /* where it is rational */
  double x0, x1;     /* at its ends */
  int64_t y0, y1;
  double low, high; /* no point of it is outside, in x */
  double step;      /* the step of the parameter */
  uint32_t chords;
  bool is_rational;
} pf_curve;

typedef struct pf_vertex {
  double x;
  int64_t y;
} pf_vertex;

/* From (x0, y0) down to (x1, y1). */
typedef struct pf_chord {
  double x0, x1, slope; /* slope: dx / dy */
  int64_t y0, y1;
} pf_chord;

/* Units of a plane to HEIGHTths of pixels. */
typedef struct pf_scale {
  double x, y;
} pf_scale;

/* Its ends and limits, and one chord. points: degree + 1. */
void pf_curve_make(const planefile_point *points, const planefile_piece *piece, pf_scale scale,
                   pf_curve *out);
/* Its coefficients, and as many chords as it needs; it has been made. */
void pf_curve_bend(const planefile_point *points, const planefile_piece *piece, pf_scale scale,
                   pf_curve *curve);
/* Vertex 0 to `chords`. */
pf_vertex pf_curve_vertex(const pf_curve *curve, uint32_t vertex);
/* The chord that begins at a height or above it, and ends below. */
uint32_t pf_curve_find(const pf_curve *curve, int64_t y);

/* The nearest whole number. */
static inline int64_t pf_round(double number) {
  double next = number + 0.5;
  int64_t whole = (int64_t)next;
  return whole - ((double)whole > next);
}
