/* Finds where texels begin along a row of an enlarged picture, with the same arithmetic that
 * samples the texels: a column belongs to the texel in which the centre of the column lies.
 *
 *     texels    |     0     |     1     |     2     |
 *     pixels    | . | . | . | . | . | . | . | . | . |
 *     edges                 ^           ^                first columns of another texel (nearest)
 *                     ^           ^                      or of another pair of centres (bilinear)
 */
#include "engine/sample/sampler.h"
#include "engine/sample/sampler_texel.h"

/* Pixels a texel: from this width on, a span for each texel costs less than its pixels. */
#define WIDE_TEXEL 4

bool cs_sampler_is_grid(const cs_sampler *s) {
  return s->placement == CS_SAMPLER_UPRIGHT &&
         (s->kernel == CS_SAMPLER_NEAREST || s->kernel == CS_SAMPLER_BILINEAR) &&
         fabs(s->m[0]) * WIDE_TEXEL <= 1 + CS_SAMPLER_SAME && fabs(s->m[0]) > 0;
}

/* The place of a column, as a number whose whole part names the texel under its centre (nearest) or
 * the left one of the pair about it (bilinear). */
static inline double place_of(const cs_sampler *s, int32_t column, double y) {
  double u = cs_sampler_row_u(s, column, y);
  return s->kernel == CS_SAMPLER_NEAREST ? u + CS_SAMPLER_SAME : u - 0.5 + CS_SAMPLER_SAME;
}

/* Appends the columns inside a run at which the texel changes; a texel is some columns wide. */
static size_t walk_texels(const cs_sampler *s, cs_run run, int32_t *columns) {
  const int32_t x0 = run.x0, x1 = run.x1;
  const double y = run.y;
  double start = place_of(s, x0, y), across = 1 / s->m[0];
  bool grows = s->m[0] > 0;
  double edge = floor(start) + grows; /* the next place at which the texel changes */
  size_t count = 0;
  for (int32_t column = x0;; edge += grows ? 1 : -1) {
    double guess = x0 + (edge - start) * across;
    int32_t next = guess < x1 ? (int32_t)guess : x1;
    next = next > column ? next : column + 1;
    while (next - 1 > column && (place_of(s, next - 1, y) >= edge) == grows)
      next--;
    while (next < x1 && (place_of(s, next, y) >= edge) != grows)
      next++;
    if (next >= x1)
      return count;
    columns[count++] = column = next;
  }
}

/* The column whose centre is the first to pass `u`, give or take one. */
static int32_t column_of(const cs_sampler *s, double u, int32_t x0, int32_t x1, double y) {
  double x = (u - (s->m[1] * y + s->m[2])) / s->m[0] - 0.5;
  return cs_number_ceil(cs_number_clamp(x, x0, x1));
}

static bool is_clear(const cs_sampler *s, int32_t column, double y) {
  return cs_sampler_is_outside(cs_sampler_row_u(s, column, y), s->width, s->wrap);
}

/* The columns that a picture which does not repeat covers; beyond them the row has one colour. */
static cs_run find_picture(const cs_sampler *s, cs_run run) {
  const int32_t x0 = run.x0, x1 = run.x1;
  const double y = run.y;
  int32_t left = column_of(s, s->m[0] > 0 ? 0 : s->width, x0, x1, y);
  int32_t right = column_of(s, s->m[0] > 0 ? s->width : 0, left, x1, y);
  while (left > x0 && !is_clear(s, left - 1, y) && s->wrap == CELSPAN_WRAP_CLEAR)
    left--;
  while (left < right && is_clear(s, left, y))
    left++;
  while (right < x1 && !is_clear(s, right, y) && s->wrap == CELSPAN_WRAP_CLEAR)
    right++;
  while (right > left && is_clear(s, right - 1, y))
    right--;
  return cs_run_between(run, left, right);
}

size_t cs_sampler_texel_edge_limit(const cs_sampler *s, cs_run run) {
  double texels = fabs(s->m[0]) * (double)(run.x1 - run.x0);
  double most = s->wrap == CELSPAN_WRAP_REPEAT || texels < s->width ? texels : s->width;
  return (size_t)most + 8;
}

size_t cs_sampler_texel_edges(const cs_sampler *s, cs_run run, int32_t *columns) {
  size_t count = 0;
  cs_run inside = run;
  if (cs_sampler_is_outside(cs_sampler_row_v(s, run.y), s->height, s->wrap))
    return 0;
  if (s->wrap != CELSPAN_WRAP_REPEAT)
    inside = find_picture(s, run);
  if (inside.x0 >= inside.x1)
    return 0;
  if (inside.x0 > run.x0)
    columns[count++] = inside.x0;
  count += walk_texels(s, inside, columns + count);
  if (inside.x1 < run.x1)
    columns[count++] = inside.x1;
  return count;
}
