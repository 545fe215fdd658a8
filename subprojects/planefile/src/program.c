/* The colours of programs, some pixels at a time. */
#include <math.h>

#include "program.h"

#define UNIT (1.0 / PLANEFILE_WHITE)

/* ---------------------------------------------------------------- light of codes */

/* The light of a code above 0, exactly: the fifth root is found from above, where each step of
 * Newton's comes nearer. */
static double light_of(double code) {
  if (code <= 0.04045)
    return code / 12.92;
  double base = (code + 0.055) / 1.055, square = base * base;
  double root = square > 1 ? square : 1, next = root;
  do {
    root = next;
    double fourth = root * root * root * root;
    next = (4 * root + square / fourth) / 5;
  } while (next < root);
  return square * root;
}

void pf_light_curve_make(pf_light_curve *out) {
  for (int i = 0; i <= PF_CURVE; i++)
    out->light[i] = light_of((double)i / PF_CURVE);
}

static double find_light(const pf_light_curve *curve, double code) {
  double size = code < 0 ? -code : code, light;
  if (size < 1) {
    int at = (int)(size * PF_CURVE);
    double from = curve->light[at];
    light = from + (size * PF_CURVE - at) * (curve->light[at + 1] - from);
  } else {
    light = light_of(size);
  }
  return code < 0 ? -light : light;
}

/* A colour of codes, premultiplied. A channel brighter than alpha is taken as if alpha were the
 * channel, up to 1. */
static void convert(const pf_light_curve *curve, double colour[4]) {
  for (int c = 0; c < 3; c++) {
    double size = colour[c] < 0 ? -colour[c] : colour[c], share = size < 1 ? size : 1;
    share = colour[3] > share ? colour[3] : share;
    if (share > 0)
      colour[c] = share * find_light(curve, colour[c] / share);
  }
}

/* ---------------------------------------------------------------- ramps */

/* The values of an axis at a pixel; false: there is nothing. */
typedef struct place {
  double p, q;
} place;

static inline double on_plane(const double plane[3], double x, double y) {
  return plane[0] * x + (plane[1] * y + plane[2]);
}

static bool find_place(const planefile_axis *axis, double x, double y, place *out) {
  double w = on_plane(axis->w, x, y);
  out->p = on_plane(axis->p, x, y) / w;
  out->q = on_plane(axis->q, x, y) / w;
  if (axis->kind == PLANEFILE_RADIAL)
    out->p = sqrt(out->p * out->p + out->q * out->q) - axis->focus * out->p;
  return w > 0 && out->p == out->p && out->q == out->q;
}

static void mix(const planefile_cell *from, const planefile_cell *to, double share, double out[4]) {
  for (int c = 0; c < 4; c++)
    out[c] = UNIT * (from->colour[c] + share * ((double)to->colour[c] - from->colour[c]));
}

/* *next: the stop after the place, where it was for the pixel before; the number of stops: none. */
static void mix_stops(const planefile_stop *stops, uint32_t count, double at, uint32_t *next,
                      double out[4]) {
  while (*next < count && stops[*next].at <= at)
    ++*next;
  while (*next > 0 && stops[*next - 1].at > at)
    --*next;
  if (*next == 0 || *next == count) {
    const planefile_cell *end = &stops[*next == 0 ? 0 : count - 1].colour;
    mix(end, end, 0, out);
    return;
  }
  const planefile_stop *from = &stops[*next - 1], *to = from + 1;
  mix(&from->colour, &to->colour, (at - from->at) / (to->at - from->at), out);
}

static double limit(double number, double most) {
  return number > most ? most : number > 0 ? number : 0;
}

static void mix_corners(const planefile_stop *stops, place at, double out[4]) {
  for (int c = 3; c >= 0; c--) {
    double first = stops[0].colour.colour[c];
    double second = stops[1].colour.colour[c] - first, third = stops[2].colour.colour[c] - first;
    out[c] = limit(UNIT * (first + (at.p * second + at.q * third)), c == 3 ? 1 : out[3]);
  }
}

/* ---------------------------------------------------------------- layers */

static inline void put_over(double front[4], const double layer[4]) {
  double through = 1 - front[3];
  for (int c = 0; c < 4; c++)
    front[c] += through * layer[c];
}

static void add_flat(const planefile_cell *colour, uint32_t count, pf_colours *out) {
  double layer[4];
  mix(colour, colour, 0, layer);
  for (uint32_t k = 0; k < count; k++)
    put_over(out->at[k], layer);
}

static void add_ramp(const planefile_band *band, const planefile_step *step,
                     const pf_pixels *pixels, pf_colours *out) {
  const planefile_axis *axis = &band->axes[step->axis];
  const planefile_stop *stops = &band->stops[step->stop];
  double y = (pixels->y + 0.5) / pixels->height;
  uint32_t next = 0;
  for (uint32_t k = 0; k < pixels->count; k++) {
    place at;
    double layer[4];
    if (!find_place(axis, (pixels->x + (k + 0.5)) / pixels->width, y, &at))
      continue;
    if (axis->kind == PLANEFILE_TRIANGLE)
      mix_corners(stops, at, layer);
    else
      mix_stops(stops, step->stop_count, at.p, &next, layer);
    put_over(out->at[k], layer);
  }
}

/* A group becomes a layer of the group around it. */
static void leave(const planefile_step *step, const pf_light_curve *curve, uint32_t count,
                  pf_colours *group, pf_colours *around) {
  double factors[4];
  mix(&step->colour, &step->colour, 0, factors);
  for (uint32_t k = 0; k < count; k++) {
    if (step->converts)
      convert(curve, group->at[k]);
    for (int c = 0; c < 4; c++)
      group->at[k][c] *= factors[c];
    put_over(around->at[k], group->at[k]);
  }
}

void pf_program_colours(const planefile_band *band, planefile_program program,
                        const pf_light_curve *curve, const pf_pixels *pixels,
                        pf_colours room[PLANEFILE_DEPTH + 1]) {
  pf_colours *now = room;
  size_t size = pixels->count * sizeof *now->at;
  memset(now, 0, size);
  for (uint32_t i = 0; i < program.step_count; i++) {
    const planefile_step *step = &band->steps[program.step + i];
    if (step->kind == PLANEFILE_ENTER) {
      memset(++now, 0, size);
    } else if (step->kind == PLANEFILE_LEAVE) {
      leave(step, curve, pixels->count, now, now - 1);
      now--;
    } else if (step->kind == PLANEFILE_RAMP) {
      add_ramp(band, step, pixels, now);
    } else {
      add_flat(&step->colour, pixels->count, now);
    }
  }
}
