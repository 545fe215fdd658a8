#include "geometry/chords.h"

#include "base/number.h"
#include "geometry/polyline.h"

#include <math.h>

uint32_t cs_chords_count(const cs_boundary_piece *piece) {
  if (piece->chords <= 1)
    return 1;
  double sag = piece->sag / (piece->step * piece->step); /* of one chord */
  double wanted = sqrt(sag * (1 / CS_CHORDS_SAG));
  return wanted <= 1 ? 1 : (uint32_t)ceil(wanted);
}

/* A vertex between the ends, of any curve. */
static void make_vertex(const cs_boundary_set *set, const cs_boundary_piece *piece, double chords,
                        double vertex, double *x, double *y) {
  double step = 1 / chords, by = step * step * cs_chords_share(vertex, chords);
  cs_polyline_point p = cs_polyline_at(set, piece, vertex * step);
  *x = cs_number_clamp(p.x - by * p.bend_x, piece->left, piece->right);
  *y = cs_number_clamp(p.y - by * p.bend_y, piece->y0, piece->y1);
}

static void make_inner(const cs_boundary_set *set, const cs_boundary_piece *piece, uint32_t chords,
                       uint32_t first, uint32_t count, cs_chords *out) {
  if (piece->is_power) {
    double c[8];
    cs_polyline_powers_of(set, piece, c);
    CS_WIDE_CHOOSE(cs_isa_best(), cs_chords_powers)(c, piece, chords, first, out);
  } else {
    for (uint32_t k = 1; k <= count; k++)
      make_vertex(set, piece, chords, (double)first + k, &out->x[k], &out->y[k]);
  }
}

uint32_t cs_chords_make(const cs_boundary_set *set, const cs_boundary_piece *piece, uint32_t chords,
                        uint32_t first, cs_chords *out) {
  uint32_t rest = chords - first, count = rest < CS_CHORDS_BATCH ? rest : CS_CHORDS_BATCH;
  if (chords > 1)
    make_inner(set, piece, chords, first, count, out);
  if (first == 0) {
    out->x[0] = piece->x0;
    out->y[0] = piece->y0;
  } else {
    make_vertex(set, piece, chords, first, &out->x[0], &out->y[0]);
  }
  if (count == rest) {
    out->x[count] = piece->x1;
    out->y[count] = piece->y1;
  }
  if (count == 1)
    out->slope[0] = (out->x[1] - out->x[0]) / (out->y[1] - out->y[0]);
  else
    CS_WIDE_CHOOSE(cs_isa_best(), cs_chords_slopes)(out);
  return count;
}
