/* Cells become fills.
 *
 *     light along an axis      .....--''''|      is sampled between its stops; of the samples those
 *     in codes, straight       |__________|      stay between which codes are nearly straight lines
 */
#include <math.h>
#include <string.h>

#include "inside/colour.h"
#include "inside/hash.h"
#include "writers/parcels/making.h"

enum { SAMPLES = 64, STRETCHES = 256 /* between stops, at most */ };
#define GOOD 0.6            /* codes: how far colours may be from a straight line */
#define BESIDE (1.0 / 4096) /* so near to an end of a stretch, colours count as the end's */

/* ---------------------------------------------------------------- stops */

typedef struct sample {
  double at;      /* 0 to 1 */
  float codes[4]; /* 0 to 255, straight */
} sample;

static sample sample_of(double at, const planefile_cell *colour) {
  sample out = {.at = at};
  double alpha = (double)colour->colour[3] / PLANEFILE_WHITE;
  out.codes[3] = (float)(alpha > 1 ? 255 : alpha > 0 ? 255 * alpha : 0);
  for (int c = 0; c < 3 && alpha > 0; c++) {
    float light = (float)(colour->colour[c] / (double)colour->colour[3]);
    light = light > 1 ? 1 : light > 0 ? light : 0;
    out.codes[c] = 255 * cs_transfer_encode(CELSPAN_TRANSFER_SRGB, light);
  }
  return out;
}

/* How far the samples between two of them are from a straight line; *worst: which one. */
static float find_error(const sample *all, size_t from, size_t to, size_t *worst) {
  float most = 0;
  for (size_t i = from + 1; i < to; i++) {
    float share = (float)((all[i].at - all[from].at) / (all[to].at - all[from].at));
    for (int c = 0; c < 4; c++) {
      float line = all[from].codes[c] + share * (all[to].codes[c] - all[from].codes[c]);
      float error = fabsf(line - all[i].codes[c]);
      error *= c < 3 ? all[i].codes[3] / 255 : 1;
      if (error > most) {
        most = error;
        *worst = i;
      }
    }
  }
  return most;
}

static celspan_status put_stop(celspan_context *context, const sample *of, size_t first,
                               cs_parcels *out) {
  cs_fill_stop stop = {.at = of->at};
  for (int c = 0; c < 4; c++)
    stop.code[c] = (unsigned char)(of->codes[c] + 0.5f);
  const cs_fill_stop *last = out->stop_count > first ? &out->stops[out->stop_count - 1] : NULL;
  if (last && last->at == stop.at && memcmp(last->code, stop.code, 4) == 0)
    return CELSPAN_OK;
  return CS_ARRAY_APPEND(context, out->stops, out->stop_count, stop);
}

/* Puts the stops that samples after `from` need, up to `to`. */
static celspan_status thin(celspan_context *context, const sample *all, size_t from, size_t to,
                           size_t first, cs_parcels *out) {
  size_t middle = 0;
  if (find_error(all, from, to, &middle) > (float)GOOD) {
    CS_TRY(thin(context, all, from, middle, first, out));
    return thin(context, all, middle, to, first, out);
  }
  return put_stop(context, &all[to], first, out);
}

/* A clear sample has the colour of its neighbour, which it is mixed with. */
static void colour_clear(sample *all, size_t count) {
  for (size_t i = 1; i < count; i++)
    if (!(all[i].codes[3] > 0))
      memcpy(all[i].codes, all[i - 1].codes, 3 * sizeof(float));
  for (size_t i = count - 1; i-- > 0;)
    if (!(all[i].codes[3] > 0))
      memcpy(all[i].codes, all[i + 1].codes, 3 * sizeof(float));
}

/* A cell and its axis, of which the numbers from..to are shown. */
typedef struct gradient {
  celspan_context *context;
  const planefile_plane *plane;
  const planefile_band *of;
  uint32_t number; /* the number of the cell */
  double from, to;
} gradient;

/* Between two places without a stop between them. */
static celspan_status put_stretch(const gradient *g, double from, double to, size_t first,
                                  cs_parcels *out) {
  planefile_cell colours[SAMPLES + 2];
  sample all[SAMPLES + 2];
  double length = to - from, whole = g->to - g->from, beside = length * BESIDE;
  if (!planefile_along(g->plane, g->of, g->number, from, from + beside, 1, &colours[0]) ||
      !planefile_along(g->plane, g->of, g->number, from, to, SAMPLES, &colours[1]) ||
      !planefile_along(g->plane, g->of, g->number, to - beside, to, 1, &colours[SAMPLES + 1]))
    return cs_fail_memory(g->context);
  for (size_t i = 0; i < SAMPLES + 2; i++) {
    double share = i == 0 ? 0 : i == SAMPLES + 1 ? 1 : ((double)i - 0.5) / SAMPLES;
    all[i] = sample_of((from - g->from + share * length) / whole, &colours[i]);
  }
  all[0].at = (from - g->from) / whole;
  all[SAMPLES + 1].at = (to - g->from) / whole;
  colour_clear(all, SAMPLES + 2);
  CS_TRY(put_stop(g->context, &all[0], first, out));
  return thin(g->context, all, 0, SAMPLES + 1, first, out);
}

/* Before the first stop, or after the last one. */
static celspan_status put_rest(const gradient *g, double from, double to, double at, size_t first,
                               cs_parcels *out) {
  planefile_cell colour;
  if (!planefile_along(g->plane, g->of, g->number, from, to, 1, &colour))
    return cs_fail_memory(g->context);
  sample rest = sample_of(at, &colour);
  return put_stop(g->context, &rest, first, out);
}

/* Lists the numbers at which stops are, in order, each once. Returns how many; STRETCHES + 1 if
 * there are more than STRETCHES. */
static size_t list_places(const gradient *g, double *out) {
  const planefile_program program = g->of->programs[g->number];
  size_t count = 0;
  for (uint32_t i = 0; i < program.step_count; i++) {
    const planefile_step *step = &g->of->steps[program.step + i];
    for (uint32_t k = 0; step->kind == PLANEFILE_RAMP && k < step->stop_count; k++) {
      double at = g->of->stops[step->stop + k].at;
      size_t place = count;
      while (place > 0 && out[place - 1] >= at)
        place--;
      if (place < count && out[place] == at)
        continue;
      if (count == STRETCHES)
        return STRETCHES + 1;
      memmove(out + place + 1, out + place, (count - place) * sizeof *out);
      out[place] = at;
      count++;
    }
  }
  return count;
}

static celspan_status put_stops(const gradient *g, const double *places, size_t count,
                                cs_fill *fill, cs_parcels *out) {
  double length = g->to - g->from;
  fill->stop = out->stop_count;
  CS_TRY(put_rest(g, g->from - length, g->from, 0, fill->stop, out));
  for (double from = g->from; from < g->to;) {
    double to = g->to;
    for (size_t i = 0; i < count; i++)
      to = places[i] > from && places[i] < to ? places[i] : to;
    CS_TRY(put_stretch(g, from, to, fill->stop, out));
    from = to;
  }
  CS_TRY(put_rest(g, g->to, g->to + length, 1, fill->stop, out));
  fill->stop_count = out->stop_count - fill->stop;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- axes */

/* Where a linear axis has the numbers from and to. False: nowhere. */
static bool place_linear(const planefile_axis *axis, const gradient *g, const cs_parcels *size,
                         cs_fill *out) {
  double a = axis->p[0] / size->width, b = axis->p[1] / size->height, square = a * a + b * b;
  double begin = (g->from - axis->p[2]) / square, end = (g->to - axis->p[2]) / square;
  out->kind = CS_FILL_LINEAR;
  out->from = (celspan_point){a * begin, b * begin};
  out->to = (celspan_point){a * end, b * end};
  return isfinite(out->from.x) && isfinite(out->from.y) && isfinite(out->to.x) &&
         isfinite(out->to.y);
}

/* |u| - f u_x = t is the circle (x - d t)^2 + y^2 = r^2 t^2 where x is u_x sqrt(1 - f^2), with r
 * = 1 / sqrt(1 - f^2) and d = f r. */
static bool place_radial(const planefile_axis *axis, const gradient *g, const cs_parcels *size,
                         cs_fill *out) {
  double f = axis->focus, narrow = sqrt(1 - f * f), unit = g->to;
  double p[3] = {axis->p[0] / size->width * narrow, axis->p[1] / size->height * narrow,
                 axis->p[2] * narrow};
  double q[3] = {axis->q[0] / size->width, axis->q[1] / size->height, axis->q[2]};
  double over = p[0] * q[1] - p[1] * q[0];
  const double inverse[6] = {q[1] * unit,  -p[1] * unit, p[1] * q[2] - p[2] * q[1],
                             -q[0] * unit, p[0] * unit,  p[2] * q[0] - p[0] * q[2]};
  bool is_finite = narrow > 0 && unit > 0;
  for (int i = 0; i < 6; i++) {
    out->matrix[i] = inverse[i] / over;
    is_finite &= isfinite(out->matrix[i]) != 0;
  }
  out->kind = CS_FILL_RADIAL;
  out->centre = f / narrow;
  out->radius = 1 / narrow;
  return is_finite;
}

/* *out stays clear where no gradient of vectors is the same. */
static celspan_status make_gradient(celspan_context *context, const celspan_plane *plane,
                                    const planefile_band *band, uint32_t cell, cs_fill *out,
                                    cs_parcels *parcels) {
  const planefile_axis *axis = planefile_only_axis(band, cell);
  gradient g = {context, plane->plane, band, cell, 0, 0};
  double places[STRETCHES + 1];
  if (!axis || axis->w[0] != 0 || axis->w[1] != 0 || axis->w[2] != 1)
    return CELSPAN_OK;
  size_t count = list_places(&g, places);
  if (count > STRETCHES)
    return CELSPAN_OK;
  bool is_linear = axis->kind == PLANEFILE_LINEAR;
  g.from = is_linear ? places[0] : 0;
  g.to = places[count - 1] > g.from || !is_linear ? places[count - 1] : g.from + 1;
  cs_fill made = {0};
  if (!(is_linear ? place_linear : place_radial)(axis, &g, parcels, &made))
    return CELSPAN_OK;
  CS_TRY(put_stops(&g, places, count, &made, parcels));
  *out = made;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- fills */

static bool is_opaque(const cs_fill *fill, const cs_parcels *parcels) {
  bool opaque = fill->kind != CS_FILL_FLAT || fill->code[3] == 255;
  for (size_t i = 0; i < fill->stop_count; i++)
    opaque &= parcels->stops[fill->stop + i].code[3] == 255;
  return opaque;
}

static cs_hash hash_of(const cs_fill *fill, const cs_parcels *parcels) {
  cs_hash hash = cs_hash_begin((uint64_t)fill->kind);
  cs_hash_bytes(&hash, fill->code, sizeof fill->code);
  const double numbers[] = {fill->from.x, fill->from.y, fill->to.x,
                            fill->to.y,   fill->centre, fill->radius};
  cs_hash_numbers(&hash, numbers, sizeof numbers / sizeof *numbers);
  cs_hash_numbers(&hash, fill->matrix, 6);
  for (size_t i = 0; i < fill->stop_count; i++) {
    cs_hash_number(&hash, parcels->stops[fill->stop + i].at);
    cs_hash_bytes(&hash, parcels->stops[fill->stop + i].code, 4);
  }
  return cs_hash_end(hash);
}

/* The number of an equal fill, or of a new one. */
static celspan_status find(celspan_context *context, cs_fill fill, cs_fill_table *table,
                           cs_parcels *parcels, uint32_t *out) {
  size_t number = parcels->fill_count;
  cs_hash key = hash_of(&fill, parcels);
  if (cs_hash_table_find(&table->known, key, &number)) {
    parcels->stop_count -= fill.stop_count;
  } else {
    fill.is_opaque = is_opaque(&fill, parcels);
    CS_TRY(cs_hash_table_add(&table->known, context, key, number));
    CS_TRY(CS_ARRAY_APPEND(context, parcels->fills, parcels->fill_count, fill));
  }
  *out = (uint32_t)number;
  return CELSPAN_OK;
}

celspan_status cs_fill_find(celspan_context *context, const celspan_plane *plane,
                            const planefile_band *band, uint32_t cell, cs_fill_table *table,
                            cs_parcels *parcels, uint32_t *out) {
  const bool is_faced = *out > 0;
  cs_fill fill = {.kind = CS_FILL_FLAT};
  *out = 0;
  if (!band->programs || band->programs[cell].step_count == 0) {
    planefile_srgb8(plane->plane, band->cells[cell], fill.code);
    return fill.code[3] == 0 ? CELSPAN_OK : find(context, fill, table, parcels, out);
  }
  fill.kind = CS_FILL_CLEAR;
  CS_TRY(make_gradient(context, plane, band, cell, &fill, parcels));
  if (fill.kind != CS_FILL_CLEAR)
    return find(context, fill, table, parcels, out);
  fill = (cs_fill){.kind = CS_FILL_PICTURE, .is_opaque = planefile_hides(band, cell, is_faced)};
  uint32_t *picture = &table->pictures[fill.is_opaque];
  if (*picture == 0) {
    *picture = (uint32_t)parcels->fill_count;
    CS_TRY(CS_ARRAY_APPEND(context, parcels->fills, parcels->fill_count, fill));
  }
  *out = *picture;
  return CELSPAN_OK;
}
