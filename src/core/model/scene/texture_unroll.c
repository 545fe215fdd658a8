#include "model/scene/texture_unroll.h"

#include <math.h>

#include "base/number.h"
#include "model/geometry/matrix.h"
#include "model/scene/check.h"

/* ---------------------------------------------------------------- which periods are seen */

/* The place of a point along the gradient, in periods; for a radial gradient a bound from above.
 * at: in the gradient's own units. */
static double place_of(const celspan_texture *texture, cs_hpoint at) {
  const celspan_point *a = &texture->variation->points[0], *b = &texture->variation->points[1];
  double x = at.x / at.w, y = at.y / at.w;
  if (texture->kind == CS_TEXTURE_LINEAR) {
    double dx = b->x - a->x, dy = b->y - a->y;
    return ((x - a->x) * dx + (y - a->y) * dy) / (dx * dx + dy * dy);
  }
  double px = x - a->x - b->x, py = y - a->y - b->y, radius = texture->variation->radius;
  double rest = radius * radius - b->x * b->x - b->y * b->y, half = -(px * b->x + py * b->y);
  return (sqrt(half * half + rest * (px * px + py * py)) - half) / rest;
}

/* The periods in which the corners of a box lie. The whole box lies between them, since a radial
 * gradient is convex and begins at 0. False if the horizon of the matrix goes through the box. */
static bool find_periods(const celspan_texture *texture, const celspan_box *box, double *first,
                         double *last) {
  const celspan_matrix identity = celspan_matrix_identity();
  double least = texture->kind == CS_TEXTURE_RADIAL ? 0 : HUGE_VAL, most = 0;
  for (int i = 0; i < 4; i++) {
    const cs_hpoint corner = {box->x + (i & 1) * box->width, box->y + (i >> 1) * box->height, 1};
    const cs_hpoint at = cs_matrix_apply(
        texture->variation->has_matrix ? &texture->variation->inverse : &identity, corner);
    if (!(at.w > 0))
      return false;
    double place = place_of(texture, at);
    least = fmin(least, place);
    most = i == 0 ? place : fmax(most, place);
  }
  *first = floor(least);
  *last = fmax(ceil(most), *first + 1);
  return cs_number_is_sane(*first) && cs_number_is_sane(*last);
}

/* ---------------------------------------------------------------- stops */

/* How many stops one period needs, including stops that extend its outer colours to its ends. */
static size_t stops_of_period(const celspan_texture *texture) {
  return texture->variation->stop_count + 2;
}

static cs_stop stop_of_period(const celspan_texture *texture, size_t index, bool is_turned) {
  size_t last = texture->variation->stop_count + 1, from = is_turned ? last - index : index;
  const cs_stop *stops = texture->variation->stops;
  cs_stop stop = from == 0      ? (cs_stop){0, stops[0].paint}
                 : from == last ? (cs_stop){1, stops[last - 2].paint}
                                : stops[from - 1];
  if (is_turned)
    stop.at = 1 - stop.at;
  return stop;
}

static void fill_stops(const celspan_texture *texture, double first, double count,
                       celspan_texture *out) {
  size_t next = 0;
  for (double period = 0; period < count; period++) {
    bool is_turned =
        texture->variation->spread == CELSPAN_SPREAD_REFLECT && fmod(fabs(first + period), 2) == 1;
    for (size_t i = 0; i < stops_of_period(texture); i++) {
      cs_stop stop = stop_of_period(texture, i, is_turned);
      stop.at = (period + stop.at) / count;
      cs_texture_own(out)->stops[next++] = stop;
    }
  }
}

/* ---------------------------------------------------------------- the whole */

/* The ends of the first and the last period. */
static void lengthen(celspan_texture *texture, double first, double last) {
  cs_texture_variation *own = cs_texture_own(texture);
  celspan_point a = own->points[0], b = own->points[1];
  if (texture->kind == CS_TEXTURE_LINEAR) {
    double dx = b.x - a.x, dy = b.y - a.y;
    own->points[0] = (celspan_point){a.x + first * dx, a.y + first * dy};
    own->points[1] = (celspan_point){a.x + last * dx, a.y + last * dy};
    return;
  }
  /* The focus stays; the centre moves away from it as the circle grows. */
  own->points[0] = (celspan_point){a.x - (last - 1) * b.x, a.y - (last - 1) * b.y};
  own->points[1] = (celspan_point){last * b.x, last * b.y};
  own->radius *= last;
}

static celspan_status unroll(celspan_context *context, celspan_texture *texture, double first,
                             double last, celspan_texture **out) {
  double count = last - first;
  celspan_texture *made;
  if (count * (double)stops_of_period(texture) > CS_UNROLL_STOPS)
    return cs_fail(
        context, CELSPAN_LIMIT,
        "%s: the gradient is repeated %s times where it is shown; with its stops, at most %d "
        "times are allowed",
        texture->kind == CS_TEXTURE_LINEAR ? "linear" : "radial", cs_check_number_text(count).text,
        CS_UNROLL_STOPS / (int)stops_of_period(texture));
  CS_TRY(cs_texture_copy(context, texture, (size_t)count * stops_of_period(texture),
                         cs_mark_keep(texture->mark), &made));
  fill_stops(texture, first, count, made);
  lengthen(made, first, last);
  cs_texture_variation *own = cs_texture_own(made);
  own->spread = CELSPAN_SPREAD_HOLD;
  celspan_texture_unref(own->origin);
  own->origin = celspan_texture_ref(texture);
  cs_texture_rehash(made);
  *out = made;
  return CELSPAN_OK;
}

celspan_status cs_texture_unroll(celspan_context *context, celspan_texture **texture,
                                 const celspan_box *box) {
  celspan_texture *from = *texture, *made = NULL;
  if (from->variation->spread == CELSPAN_SPREAD_HOLD)
    return CELSPAN_OK;
  double half = floor(0.5 * CS_UNROLL_STOPS / (double)stops_of_period(from));
  double first = from->kind == CS_TEXTURE_RADIAL ? 0 : -half, last = fmax(half, 1);
  if (box && !find_periods(from, box, &first, &last))
    return cs_fail(context, CELSPAN_LIMIT,
                   "%s: a gradient that repeats must not be shown at the horizon of its matrix",
                   from->kind == CS_TEXTURE_LINEAR ? "linear" : "radial");
  CS_TRY(unroll(context, from, first, last, &made));
  celspan_texture_unref(from);
  *texture = made;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- the faces */

static bool is_gradient(const celspan_texture *texture) {
  return texture->kind == CS_TEXTURE_LINEAR || texture->kind == CS_TEXTURE_RADIAL;
}

/* A copy to be changed; a gradient that was made flat stays flat. */
static celspan_status copy(celspan_context *context, const celspan_texture *texture,
                           celspan_texture **out) {
  return cs_texture_copy(context, texture, texture->variation->stop_count,
                         cs_mark_keep(texture->mark), out);
}

celspan_status celspan_texture_with_spread(celspan_context *context, celspan_texture *texture,
                                           celspan_spread spread, celspan_texture **out) {
  celspan_texture *made;
  CS_TRY(
      cs_check_choice(context, "spread", "spread", (unsigned)spread, CELSPAN_SPREAD_REFLECT + 1));
  CS_TRY(cs_check_given(context, "spread", "the texture", texture));
  if (!is_gradient(texture) && texture->kind != CS_TEXTURE_FLAT)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "spread: only linear and radial gradients have one");
  CS_TRY(copy(context, texture, &made));
  if (is_gradient(made))
    cs_texture_own(made)->spread = spread;
  cs_texture_rehash(made);
  *out = made;
  return CELSPAN_OK;
}

celspan_status celspan_texture_with_matrix(celspan_context *context, celspan_texture *texture,
                                           const celspan_matrix *matrix, celspan_texture **out) {
  const celspan_matrix identity = celspan_matrix_identity();
  const celspan_paint clear = celspan_paint_rgb(0, 0, 0, 0);
  celspan_texture *made;
  celspan_matrix whole, inverse;
  CS_TRY(cs_check_given(context, "matrix", "the matrix", matrix));
  CS_TRY(cs_check_given(context, "matrix", "the texture", texture));
  if (texture->variation->fit != CS_TEXTURE_FIT_NONE)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "matrix: a gradient without points fits what it paints; give it points");
  CS_TRY(copy(context, texture, &made));
  celspan_status status = cs_check_transform(
      context, made->variation->has_matrix ? &made->variation->matrix : &identity, matrix, &whole);
  bool is_singular = status == CELSPAN_OK && !celspan_matrix_inverse(whole, &inverse);
  if (status != CELSPAN_OK || is_singular) {
    celspan_texture_unref(made);
    return is_singular ? celspan_texture_create_paint(context, &clear, out) : status;
  }
  if (made->kind != CS_TEXTURE_FLAT) {
    cs_texture_variation *own = cs_texture_own(made);
    own->has_matrix = true;
    own->matrix = whole;
    own->inverse = inverse;
  }
  cs_texture_rehash(made);
  *out = made;
  return CELSPAN_OK;
}
