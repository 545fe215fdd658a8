#include "tools/trace/spline.h"

#include <math.h>
#include <string.h>

#include "inside/number.h"

enum { DEGREE = 3, STEPS = 80 };

typedef struct fitter {
  const cs_station *stations;
  size_t count; /* the count of stations */
  bool is_closed;
  double *parameters; /* 0..1 along the line */
  size_t controls;
} fitter;

/* ---------------------------------------------------------------- basis */

/* The weights of four control points, from *first on, at a parameter. */
typedef struct basis {
  size_t first;
  double w[4];
} basis;

static double knot_at(size_t i, size_t controls) {
  return i <= DEGREE ? 0 : i >= controls ? (double)(controls - DEGREE) : (double)(i - DEGREE);
}

/* Clamped: the rule of Cox and de Boor. Needs four control points. */
static basis clamped_basis(double parameter, size_t controls) {
  double spans = (double)(controls - DEGREE), u = parameter * spans;
  size_t piece = u >= spans ? controls - DEGREE - 1 : (size_t)u, at = piece + DEGREE;
  double left[4], right[4];
  basis b = {piece, {1, 0, 0, 0}};
  for (size_t j = 1; j <= DEGREE; j++) {
    double saved = 0;
    left[j] = u - knot_at(at + 1 - j, controls);
    right[j] = knot_at(at + j, controls) - u;
    for (size_t r = 0; r < j; r++) {
      double part = b.w[r] / (right[r + 1] + left[j - r]);
      b.w[r] = saved + right[r + 1] * part;
      saved = left[j - r] * part;
    }
    b.w[j] = saved;
  }
  return b;
}

static basis periodic_basis(double parameter, size_t controls) {
  double u = parameter * (double)controls;
  size_t piece = (size_t)u;
  double t = u - (double)piece, s = 1 - t;
  return (basis){piece % controls,
                 {s * s * s / 6, (3 * t * t * t - 6 * t * t + 4) / 6,
                  (3 * s * s * s - 6 * s * s + 4) / 6, t * t * t / 6}};
}

static basis basis_at(const fitter *f, size_t station) {
  return f->is_closed ? periodic_basis(f->parameters[station], f->controls)
                      : clamped_basis(f->parameters[station], f->controls);
}

static size_t control_of(const fitter *f, const basis *b, int k) {
  return (b->first + (size_t)k) % f->controls;
}

static void set_parameters(fitter *f) {
  double sum = 0;
  size_t last = f->count - 1;
  for (size_t i = 0; i <= last; i++) {
    f->parameters[i] = sum;
    const double *a = f->stations[i].v, *b = f->stations[i == last ? 0 : i + 1].v;
    if (i < last || f->is_closed)
      sum += cs_number_length(a[0] - b[0], a[1] - b[1]);
  }
  for (size_t i = 0; i <= last; i++)
    f->parameters[i] = sum > 0 ? f->parameters[i] / sum : 0;
}

/* ---------------------------------------------------------------- least squares */

/* The curve must go through the ends of an open line, so these count more. */
static double weight_of(const fitter *f, size_t station) {
  return !f->is_closed && (station == 0 || station == f->count - 1) ? 100 : 1;
}

static cs_station value_at(const fitter *f, const cs_station *controls, size_t station) {
  basis b = basis_at(f, station);
  cs_station value = {{0, 0, 0}};
  for (int k = 0; k < 4; k++)
    for (int c = 0; c < 3; c++)
      value.v[c] += b.w[k] * controls[control_of(f, &b, k)].v[c];
  return value;
}

/* out = normal matrix * in, with a little of the identity, so that it is never singular. */
static void apply(const fitter *f, const cs_station *in, cs_station *out) {
  for (size_t i = 0; i < f->controls; i++)
    for (int c = 0; c < 3; c++)
      out[i].v[c] = 1e-7 * in[i].v[c];
  for (size_t i = 0; i < f->count; i++) {
    basis b = basis_at(f, i);
    cs_station value = value_at(f, in, i);
    for (int k = 0; k < 4; k++)
      for (int c = 0; c < 3; c++)
        out[control_of(f, &b, k)].v[c] += weight_of(f, i) * b.w[k] * value.v[c];
  }
}

/* The remaining error of the stations, weighted. */
static void residual(const fitter *f, const cs_station *controls, cs_station *out) {
  memset(out, 0, f->controls * sizeof *out);
  for (size_t i = 0; i < f->count; i++) {
    basis b = basis_at(f, i);
    cs_station value = value_at(f, controls, i);
    for (int k = 0; k < 4; k++)
      for (int c = 0; c < 3; c++)
        out[control_of(f, &b, k)].v[c] +=
            weight_of(f, i) * b.w[k] * (f->stations[i].v[c] - value.v[c]);
  }
}

static double dot(const cs_station *a, const cs_station *b, size_t count) {
  double sum = 0;
  for (size_t i = 0; i < count; i++)
    for (int c = 0; c < 3; c++)
      sum += a[i].v[c] * b[i].v[c];
  return sum;
}

static void add_scaled(cs_station *to, double factor, const cs_station *from, size_t count) {
  for (size_t i = 0; i < count; i++)
    for (int c = 0; c < 3; c++)
      to[i].v[c] += factor * from[i].v[c];
}

/* room: three times as many as the controls. */
static void solve(const fitter *f, cs_station *controls, cs_station *room) {
  size_t n = f->controls;
  cs_station *left = room, *way = room + n, *image = room + 2 * n;
  residual(f, controls, left);
  memcpy(way, left, n * sizeof *way);
  double square = dot(left, left, n);
  for (int step = 0; step < STEPS && square > 1e-12; step++) {
    apply(f, way, image);
    double factor = square / dot(way, image, n);
    add_scaled(controls, factor, way, n);
    add_scaled(left, -factor, image, n);
    double next = dot(left, left, n);
    for (size_t i = 0; i < n; i++)
      for (int c = 0; c < 3; c++)
        way[i].v[c] = left[i].v[c] + next / square * way[i].v[c];
    square = next;
  }
}

/* Sets the first approximation: control points on the line itself. */
static void begin(const fitter *f, cs_station *controls) {
  for (size_t i = 0; i < f->controls; i++) {
    double at = f->is_closed ? ((double)i - 1) / (double)f->controls
                             : (double)i / (double)(f->controls - 1);
    at = at < 0 ? at + 1 : at;
    controls[i] = f->stations[(size_t)(at * (double)(f->count - 1) + 0.5)];
  }
}

static bool is_near(const fitter *f, const cs_station *controls, double tolerance) {
  for (size_t i = 0; i < f->count; i++) {
    cs_station value = value_at(f, controls, i);
    double dx = value.v[0] - f->stations[i].v[0], dy = value.v[1] - f->stations[i].v[1];
    double dw = value.v[2] - f->stations[i].v[2];
    if (dx * dx + dy * dy > tolerance * tolerance || fabs(dw) > 2 * tolerance)
      return false;
  }
  return true;
}

static void fit(fitter *f, double tolerance, cs_station *controls, cs_station *room) {
  for (f->controls = DEGREE + 1;; f->controls += f->controls / 3 + 1) {
    if (f->controls > f->count)
      f->controls = f->count;
    begin(f, controls);
    solve(f, controls, room);
    if (f->controls == f->count || is_near(f, controls, tolerance))
      return;
  }
}

celspan_status cs_spline_fit(celspan_context *context, const cs_station *stations, size_t count,
                             bool is_closed, double tolerance, cs_spline *out) {
  cs_memory *memory = context->memory;
  fitter f = {stations, count, is_closed, NULL, 0};
  cs_station *controls = cs_mem_array(memory, count, sizeof *controls);
  cs_station *room = cs_mem_array(memory, 3 * count, sizeof *room);
  f.parameters = cs_mem_array(memory, count, sizeof *f.parameters);
  *out = (cs_spline){.controls = NULL};
  bool is_made = controls && room && f.parameters;
  if (is_made && count <= DEGREE) {
    memcpy(controls, stations, count * sizeof *controls);
    f.controls = count;
  } else if (is_made) {
    set_parameters(&f);
    fit(&f, tolerance, controls, room);
  }
  out->controls = is_made ? cs_mem_array(memory, f.controls, sizeof *controls) : NULL;
  out->count = f.controls;
  is_made = out->controls;
  if (is_made)
    memcpy(out->controls, controls, f.controls * sizeof *controls);
  cs_mem_free(memory, controls, count * sizeof *controls);
  cs_mem_free(memory, room, 3 * count * sizeof *room);
  cs_mem_free(memory, f.parameters, count * sizeof *f.parameters);
  return is_made ? CELSPAN_OK : cs_fail_memory(context);
}

/* The rule of de Casteljau, for four points at most. */
static cs_station bezier_at(cs_station v[4], size_t count, double t) {
  for (size_t left = count - 1; left > 0; left--)
    for (size_t i = 0; i < left; i++)
      for (int c = 0; c < 3; c++)
        v[i].v[c] += t * (v[i + 1].v[c] - v[i].v[c]);
  return v[0];
}

cs_station cs_spline_at(const celspan_point *points, const double *widths, size_t count,
                        bool is_closed, double parameter) {
  parameter -= is_closed ? floor(parameter) : 0;
  basis b = {0, {0}};
  if (count > DEGREE)
    b = is_closed ? periodic_basis(parameter, count) : clamped_basis(parameter, count);
  cs_station v[4] = {{{0}}}, sum = {{0, 0, 0}};
  for (size_t k = 0; k < 4 && k < count; k++) {
    size_t i = (b.first + k) % count;
    v[k] = (cs_station){{points[i].x, points[i].y, widths[i]}};
    for (int c = 0; c < 3; c++)
      sum.v[c] += b.w[k] * v[k].v[c];
  }
  return count > DEGREE ? sum : bezier_at(v, count, parameter);
}
