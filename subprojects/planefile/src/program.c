/* The colours of programs, some pixels at a time. */
#include <math.h>

#include "program.h"

#define UNIT (1.0f / PLANEFILE_WHITE)

/* ---------------------------------------------------------------- light of codes */

/* The light of a code above 0: the fifth root is found from above, where each step of Newton's
 * comes nearer. */
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
  for (int i = 0; i <= PF_CURVE + 1; i++)
    out->light[i] = (float)light_of((double)i / PF_CURVE);
  for (int i = 0; i < 256; i++)
    out->codes[i] = (float)light_of(i / 255.0);
}

/* Of a code from 0 to 1. */
static inline float find_usual_light(const pf_light_curve *curve, float code) {
  int at = (int)(code * PF_CURVE);
  float from = curve->light[at];
  return from + (code * PF_CURVE - (float)at) * (curve->light[at + 1] - from);
}

static float find_light(const pf_light_curve *curve, float code) {
  float size = code < 0 ? -code : code;
  float light = size <= 1 ? find_usual_light(curve, size) : (float)light_of(size);
  return code < 0 ? -light : light;
}

/* A channel of premultiplied codes. One brighter than alpha is taken as if alpha were the channel,
 * up to 1. */
static float convert(const pf_light_curve *curve, float channel, float alpha) {
  float size = channel < 0 ? -channel : channel, share = size < 1 ? size : 1;
  share = alpha > share ? alpha : share;
  return share > 0 ? share * find_light(curve, channel / share) : channel;
}

/* Whether colours are opaque, and none is brighter than white. */
static bool are_usual(const pf_colours *colours, uint32_t count) {
  bool usual = true;
  for (uint32_t k = 0; k < count; k++)
    usual &= colours->channels[3][k] == 1;
  for (int c = 0; c < 3; c++)
    for (uint32_t k = 0; k < count; k++)
      usual &= colours->channels[c][k] >= 0 && colours->channels[c][k] <= 1;
  return usual;
}

static void convert_all(const pf_light_curve *curve, uint32_t count, pf_colours *colours) {
  float(*channels)[PF_BATCH] = colours->channels;
  bool usual = are_usual(colours, count);
  for (int c = 0; usual && c < 3; c++)
    for (uint32_t k = 0; k < count; k++)
      channels[c][k] = find_usual_light(curve, channels[c][k]);
  for (int c = 0; !usual && c < 3; c++)
    for (uint32_t k = 0; k < count; k++)
      channels[c][k] = convert(curve, channels[c][k], channels[3][k]);
}

/* ---------------------------------------------------------------- places */

/* The values of an axis at pixels; p is not a number where there is nothing. */
typedef struct places {
  double p[PF_BATCH], q[PF_BATCH];
} places;

static void find_plane(const double plane[3], const pf_pixels *pixels, double *out) {
  double step = plane[0] / pixels->width, first = pixels->x + 0.5;
  double rest = plane[1] * ((pixels->y + 0.5) / pixels->height) + plane[2];
  for (uint32_t k = 0; k < pixels->count; k++)
    out[k] = step * (first + k) + rest;
}

static void divide_by_w(const planefile_axis *axis, const pf_pixels *pixels, places *at) {
  double w[PF_BATCH];
  find_plane(axis->w, pixels, w);
  for (uint32_t k = 0; k < pixels->count; k++) {
    at->p[k] = w[k] > 0 ? at->p[k] / w[k] : NAN;
    at->q[k] = axis->kind != PLANEFILE_LINEAR ? at->q[k] / w[k] : 0;
  }
}

static void find_places(const planefile_axis *axis, const pf_pixels *pixels, places *at) {
  find_plane(axis->p, pixels, at->p);
  if (axis->kind != PLANEFILE_LINEAR)
    find_plane(axis->q, pixels, at->q);
  if (!pf_axis_is_affine(axis))
    divide_by_w(axis, pixels, at);
  for (uint32_t k = 0; axis->kind == PLANEFILE_RADIAL && k < pixels->count; k++)
    at->p[k] = sqrt(at->p[k] * at->p[k] + at->q[k] * at->q[k]) - axis->focus * at->p[k];
}

/* ---------------------------------------------------------------- ramps */

/* What a gradient shows from one stop to the next, before the first stop, or from the last one
 * on. */
typedef struct stretch {
  double from, to, scale; /* 1 / its length, or 0 */
  float colour[4], step[4];
} stretch;

static void put_unit(const planefile_cell *colour, float out[4]) {
  for (int c = 0; c < 4; c++)
    out[c] = UNIT * (float)colour->colour[c];
}

static stretch find_stretch(const planefile_stop *stops, uint32_t count, double at) {
  uint32_t next = 0;
  while (next < count && stops[next].at <= at)
    next++;
  const planefile_stop *from = &stops[next > 0 ? next - 1 : 0];
  stretch out = {.from = next > 0 ? from->at : -INFINITY, .to = INFINITY};
  put_unit(&from->colour, out.colour);
  if (next < count)
    out.to = stops[next].at;
  if (next > 0 && next < count) {
    float end[4];
    put_unit(&stops[next].colour, end);
    out.scale = 1 / (out.to - out.from);
    for (int c = 0; c < 4; c++)
      out.step[c] = end[c] - out.colour[c];
  }
  return out;
}

/* Pixels [k, end), which are all in it. */
static void fill(const stretch *of, const places *at, uint32_t k, uint32_t end, pf_colours *out) {
  float shares[PF_BATCH];
  for (uint32_t i = k; i < end; i++)
    shares[i] = of->scale > 0 ? (float)((at->p[i] - of->from) * of->scale) : 0;
  for (int c = 0; c < 4; c++)
    for (uint32_t i = k; i < end; i++)
      out->channels[c][i] = of->colour[c] + shares[i] * of->step[c];
}

static void mix_stops(const planefile_stop *stops, uint32_t stop_count, const places *at,
                      uint32_t count, pf_colours *out) {
  static const stretch none = {.from = INFINITY};
  for (uint32_t k = 0, end; k < count; k = end) {
    bool is_there = at->p[k] == at->p[k];
    stretch of = is_there ? find_stretch(stops, stop_count, at->p[k]) : none;
    for (end = k + 1; end < count && at->p[end] >= of.from && at->p[end] < of.to; end++) {
    }
    fill(&of, at, k, end, out);
  }
}

static float limit(float number, float most) {
  return number > most ? most : number > 0 ? number : 0;
}

static void mix_corners(const planefile_stop *stops, const places *at, uint32_t count,
                        pf_colours *out) {
  float first[4], second[4], third[4];
  put_unit(&stops[0].colour, first);
  put_unit(&stops[1].colour, second);
  put_unit(&stops[2].colour, third);
  for (uint32_t k = 0; k < count; k++)
    for (int c = 3; c >= 0; c--) {
      double mixed = first[c] + (at->p[k] * (double)(second[c] - first[c]) +
                                 at->q[k] * (double)(third[c] - first[c]));
      out->channels[c][k] = limit((float)mixed, c == 3 ? 1 : out->channels[3][k]);
    }
}

/* ---------------------------------------------------------------- layers */

/* What has been composed so far, of the pixels of a group. */
typedef struct front {
  pf_colours *colours, *veil;
  bool is_clear; /* and its colours have no contents yet */
  bool is_bare;  /* and its veil has none */
} front;

static void multiply_each(uint32_t count, pf_colours *to, const pf_colours *by) {
  for (int c = 0; c < 4; c++)
    for (uint32_t k = 0; k < count; k++)
      to->channels[c][k] *= by->channels[c][k];
}

static void put_over(uint32_t count, front *to, const pf_colours *restrict layer) {
  float through[PF_BATCH];
  for (uint32_t k = 0; k < count; k++)
    through[k] = 1 - to->colours->channels[3][k];
  for (int c = 0; c < 4; c++)
    for (uint32_t k = 0; k < count; k++)
      to->colours->channels[c][k] += through[k] * layer->channels[c][k];
}

/* Where a layer is made: in the group itself, if it is its first one. */
static pf_colours *begin_layer(const front *to, pf_colours *room) {
  return to->is_clear ? to->colours : room;
}

static void end_layer(uint32_t count, front *to, pf_colours *layer) {
  if (!to->is_bare)
    multiply_each(count, layer, to->veil);
  if (!to->is_clear)
    put_over(count, to, layer);
  to->is_clear = false;
}

static void fill_flat(const planefile_cell *colour, uint32_t count, pf_colours *out) {
  float flat[4];
  put_unit(colour, flat);
  for (int c = 0; c < 4; c++)
    for (uint32_t k = 0; k < count; k++)
      out->channels[c][k] = flat[c];
}

static void multiply(const planefile_cell *by, uint32_t count, pf_colours *colours) {
  float factors[4];
  put_unit(by, factors);
  for (int c = 0; c < 4; c++)
    for (uint32_t k = 0; k < count; k++)
      colours->channels[c][k] *= factors[c];
}

static void fill_ramp(const pf_program_source *source, const planefile_step *step,
                      const pf_pixels *pixels, pf_colours *out) {
  const planefile_band *band = source->band;
  const planefile_axis *axis = &band->axes[step->axis];
  const planefile_stop *stops = &band->stops[step->stop];
  places at;
  if (axis->kind == PLANEFILE_PICTURE) {
    pf_picture_colours(&source->pictures[axis->picture], axis, pixels, out);
    multiply(&stops->colour, pixels->count, out);
    return;
  }
  find_places(axis, pixels, &at);
  if (axis->kind == PLANEFILE_TRIANGLE)
    mix_corners(stops, &at, pixels->count, out);
  else
    mix_stops(stops, step->stop_count, &at, pixels->count, out);
}

static void add_layer(const pf_program_source *source, const planefile_step *step,
                      const pf_pixels *pixels, front *to) {
  pf_colours room, *layer = begin_layer(to, &room);
  if (step->kind == PLANEFILE_FLAT)
    fill_flat(&step->colour, pixels->count, layer);
  else
    fill_ramp(source, step, pixels, layer);
  end_layer(pixels->count, to, layer);
}

/* A pixel of a group becomes that of a veil. */
static void make_veil(uint8_t how, const float pixel[4], float out[4]) {
  float alpha = limit(pixel[3], 1), luma = 0.2126f * pixel[0] + 0.7152f * pixel[1];
  luma = limit(luma + 0.0722f * pixel[2], 1);
  float matte = how >= PLANEFILE_LUMA_MATTE ? luma : alpha;
  bool is_inverted = how == PLANEFILE_INVERTED_MATTE || how == PLANEFILE_INVERTED_LUMA;
  for (int c = 0; c < 4; c++)
    out[c] = how >= PLANEFILE_MATTE    ? is_inverted ? 1 - matte : matte
             : c == 3                  ? 1
             : how == PLANEFILE_GLASS  ? 1 - alpha + pixel[c]
             : how == PLANEFILE_SCREEN ? 1 - pixel[c]
                                       : pixel[c];
}

static float mean_of(const float veil[4]) { return (veil[0] + veil[1] + veil[2]) * (1.0f / 3); }

/* A group becomes a veil in the group around it. */
static void add_veil(uint8_t how, uint32_t count, const front *group, front *around) {
  float(*from)[PF_BATCH] = group->colours->channels, (*to)[PF_BATCH] = around->veil->channels;
  if (around->is_clear)
    memset(around->colours, 0, sizeof *around->colours);
  around->is_clear = false;
  for (uint32_t k = 0; k < count; k++) {
    const float pixel[4] = {from[0][k], from[1][k], from[2][k], from[3][k]};
    float veil[4], *alpha = &around->colours->channels[3][k], mean = 1;
    make_veil(how, pixel, veil);
    for (int c = 0; c < 4 && !around->is_bare; c++)
      veil[c] *= to[c][k];
    if (how == PLANEFILE_GLASS) { /* the mean goes into alpha */
      const float before[4] = {to[0][k], to[1][k], to[2][k], 1};
      mean = mean_of(veil) / (around->is_bare ? 1 : mean_of(before));
      mean = mean > 0 ? mean : 0;
      *alpha = 1 - (1 - *alpha) * mean;
    }
    for (int c = 0; c < 4; c++)
      to[c][k] = c == 3 ? veil[c] : mean > 0 ? veil[c] / mean : 0;
  }
  around->is_bare = false;
}

/* A group becomes what its step says, in the group around it. */
static void leave(const planefile_step *step, const pf_light_curve *curve, uint32_t count,
                  const front *group, front *around) {
  if (group->is_clear && step->how <= PLANEFILE_DECODED)
    return;
  if (group->is_clear)
    memset(group->colours, 0, sizeof *group->colours);
  if (step->how == PLANEFILE_DECODED)
    convert_all(curve, count, group->colours);
  multiply(&step->colour, count, group->colours);
  if (step->how > PLANEFILE_DECODED) {
    add_veil(step->how, count, group, around);
    return;
  }
  if (around->is_clear)
    *around->colours = *group->colours;
  end_layer(count, around, around->is_clear ? around->colours : group->colours);
}

void pf_program_colours(const pf_program_source *source, planefile_program program,
                        const pf_pixels *pixels, pf_colours room[PF_ROOM]) {
  front fronts[PLANEFILE_DEPTH + 1], *now = fronts;
  *now = (front){room, room + PLANEFILE_DEPTH + 1, true, true};
  for (uint32_t i = 0; i < program.step_count; i++) {
    const planefile_step *step = &source->band->steps[program.step + i];
    if (step->kind == PLANEFILE_ENTER) {
      now++;
      pf_colours *own = room + (now - fronts);
      *now = (front){own, own + PLANEFILE_DEPTH + 1, true, true};
    } else if (step->kind == PLANEFILE_LEAVE) {
      leave(step, source->curve, pixels->count, now, now - 1);
      now--;
    } else {
      add_layer(source, step, pixels, now);
    }
  }
  if (now->is_clear)
    memset(room, 0, sizeof *room);
}
