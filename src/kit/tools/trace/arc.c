#include "tools/trace/arc.h"

#include <math.h>

#include "inside/number.h"

/* Steps of Newton's method to the least error, which is near 0. */
enum { STEPS = 8 };
/* An arc with a larger radius, in pixels, is a line. So are points whose distances from a line are
 * only rounding: as a share of their spread, squared. */
#define RADIUS_MOST 1e5
#define ROUNDING 1e-12

void cs_arc_add(cs_arc_sums *s, celspan_point point) {
  double x = point.x - s->origin.x, y = point.y - s->origin.y, z = x * x + y * y;
  s->count += 1;
  s->x += x, s->y += y;
  s->xx += x * x, s->xy += x * y, s->yy += y * y;
  s->xz += x * z, s->yz += y * z, s->zz += z * z;
}

/* The same sums, about the mean of the points and divided by their count; z is relative to the
 * mean, too. */
typedef struct moments {
  double x, y; /* the mean */
  double xx, xy, yy, xz, yz, zz;
} moments;

static void take_plane(const cs_arc_sums *s, moments *m) {
  double share = 1 / s->count;
  m->x = share * s->x, m->y = share * s->y;
  m->xx = share * s->xx - m->x * m->x;
  m->xy = share * s->xy - m->x * m->y;
  m->yy = share * s->yy - m->y * m->y;
}

/* With x = mx + u and y = my + v, z = u^2 + v^2 + 2 mx u + 2 my v + a constant. */
static void take_moments(const cs_arc_sums *s, moments *m) {
  take_plane(s, m);
  double share = 1 / s->count, z = share * (s->xx + s->yy), own = m->xx + m->yy;
  double mx = 2 * m->x, my = 2 * m->y;
  double xz = share * s->xz - m->x * z, yz = share * s->yz - m->y * z;
  m->xz = xz - mx * m->xx - my * m->xy;
  m->yz = yz - mx * m->xy - my * m->yy;
  m->zz = share * s->zz - z * z + mx * mx * m->xx + my * my * m->yy - 2 * mx * xz - 2 * my * yz +
          2 * mx * my * m->xy + own * own;
}

static double line_error(const moments *m) {
  double half = 0.5 * (m->xx - m->yy);
  double least = 0.5 * (m->xx + m->yy) - sqrt(half * half + m->xy * m->xy);
  return least > 0 ? least : 0;
}

double cs_arc_line_error(const cs_arc_sums *sums) {
  moments m;
  take_plane(sums, &m);
  return line_error(&m);
}

/* The least root of Taubin's characteristic polynomial. */
static double arc_error(const moments *m) {
  double z = m->xx + m->yy, area = m->xx * m->yy - m->xy * m->xy, spread = m->zz - z * z;
  double a3 = 4 * z, a2 = -3 * z * z - m->zz;
  double a1 = spread * z + 4 * area * z - m->xz * m->xz - m->yz * m->yz;
  double a0 = m->xz * (m->xz * m->yy - m->yz * m->xy) + m->yz * (m->yz * m->xx - m->xz * m->xy) -
              spread * area;
  double x = 0;
  for (int step = 0; step < STEPS; step++) {
    double y = a0 + x * (a1 + x * (a2 + x * a3)), slope = a1 + x * (2 * a2 + x * 3 * a3);
    double next = fabs(slope) > 1e-30 ? x - y / slope : x;
    double step_size = fabs(next - x);
    x = next;
    if (!(step_size > 1e-5 * fabs(x) + 1e-9))
      break;
  }
  return x > 0 ? x : 0;
}

double cs_arc_error(const cs_arc_sums *sums) {
  moments m;
  take_moments(sums, &m);
  double arc = arc_error(&m), line = line_error(&m);
  return arc < line ? arc : line;
}

/* ---------------------------------------------------------------- the fit */

static cs_arc line_of(const cs_arc_sums *s, const moments *m) {
  double half = 0.5 * (m->xx - m->yy), root = sqrt(half * half + m->xy * m->xy);
  /* The smaller eigenvalue has the direction across the points. */
  double nx = half > 0 ? -m->xy : root - half, ny = half > 0 ? root + half : -m->xy;
  double length = cs_number_length(nx, ny);
  nx = length > 0 ? nx / length : 0;
  ny = length > 0 ? ny / length : 1;
  return (cs_arc){.origin = {s->origin.x + m->x, s->origin.y + m->y}, .across = {nx, ny}};
}

static cs_arc circle_of(const cs_arc_sums *s, const moments *m) {
  double z = m->xx + m->yy, root = arc_error(m);
  double scale = 2 * (root * root - root * z + m->xx * m->yy - m->xy * m->xy);
  double x = m->xz * (m->yy - root) - m->yz * m->xy, y = m->yz * (m->xx - root) - m->xz * m->xy;
  double far = sqrt(x * x + y * y + z * scale * scale);
  if (!(fabs(scale) * RADIUS_MOST > far) || line_error(m) <= ROUNDING * z)
    return line_of(s, m);
  double radius = far / fabs(scale);
  return (cs_arc){.origin = {s->origin.x + m->x, s->origin.y + m->y},
                  .across = {-x / (scale * radius), -y / (scale * radius)},
                  .bend = 0.5 / radius,
                  .offset = -0.5 * z / radius};
}

cs_arc cs_arc_of(const cs_arc_sums *sums, bool is_line) {
  moments m;
  take_moments(sums, &m);
  return is_line ? line_of(sums, &m) : circle_of(sums, &m);
}

double cs_arc_off(const cs_arc *arc, celspan_point point, celspan_point *across) {
  double x = point.x - arc->origin.x, y = point.y - arc->origin.y;
  *across = (celspan_point){2 * arc->bend * x + arc->across.x, 2 * arc->bend * y + arc->across.y};
  return arc->bend * (x * x + y * y) + arc->across.x * x + arc->across.y * y + arc->offset;
}

celspan_point cs_arc_nearest(const cs_arc *arc, celspan_point point) {
  for (int step = 0; step < 3; step++) {
    celspan_point across;
    double off = cs_arc_off(arc, point, &across);
    double square = across.x * across.x + across.y * across.y;
    if (square < 1e-6)
      break;
    point.x -= off / square * across.x;
    point.y -= off / square * across.y;
  }
  return point;
}
