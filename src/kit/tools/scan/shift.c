#include "tools/scan/shift.h"

#include <math.h>

#include "inside/number.h"
#include "tools/track/grey.h"

enum { SIZES = 4, SHARE = 12 };
/* Less darkness is paper. */
#define PAPER 0.08f

static celspan_status darken(const cs_rough *page, cs_grey_levels *out) {
  size_t count = (size_t)page->width * (size_t)page->height;
  float *dark;
  CS_TRY(CS_MAKE(page->context, dark, count));
  for (size_t i = 0; i < count; i++)
    dark[i] = page->spots[i] < 1 - PAPER ? 1 - page->spots[i] : 0;
  celspan_status status =
      cs_grey_levels_make(page->context, dark, page->width, page->height, SIZES, out);
  cs_mem_free(page->context->memory, dark, count * sizeof *dark);
  return status;
}

/* The sum of the products where `a` is moved by (x, y) onto b. */
static double alike(const cs_grey *a, const cs_grey *b, int32_t x, int32_t y) {
  double sum = 0;
  int32_t left = x > 0 ? x : 0, right = x < 0 ? a->width + x : a->width;
  for (int32_t v = y > 0 ? y : 0; v < (y < 0 ? a->height + y : a->height); v++) {
    const float *from = a->values + (size_t)(v - y) * (size_t)a->width;
    const float *to = b->values + (size_t)v * (size_t)b->width;
    float row = 0;
    for (int32_t u = left; u < right; u++)
      row += from[u - x] * to[u];
    sum += (double)row;
  }
  return sum;
}

/* Moves (*x, *y) to the best of the shifts around it. */
static double search(const cs_grey *a, const cs_grey *b, int32_t radius, int32_t *x, int32_t *y) {
  int32_t middle_x = *x, middle_y = *y;
  double best = -1;
  for (int32_t dy = -radius; dy <= radius; dy++)
    for (int32_t dx = -radius; dx <= radius; dx++) {
      double sum = alike(a, b, middle_x + dx, middle_y + dy);
      if (sum <= best)
        continue;
      best = sum;
      *x = middle_x + dx;
      *y = middle_y + dy;
    }
  return best;
}

/* Where a parabola through three values, one apart, is highest, from the middle one. */
static double summit(double before, double here, double after) {
  double bend = before - 2 * here + after;
  return bend < 0 ? cs_number_clamp((before - after) / (2 * bend), -0.5, 0.5) : 0;
}

static void find(const cs_grey_levels *from, const cs_grey_levels *onto, int32_t side,
                 cs_rough_shift *out) {
  const cs_grey *a = from->levels, *b = onto->levels;
  int32_t x = 0, y = 0, longer = a->width > a->height ? a->width : a->height;
  double best = 0;
  for (int32_t i = from->count - 1; i >= 0; i--) {
    bool is_first = i == from->count - 1;
    x *= 2;
    y *= 2;
    best = search(&a[i], &b[i], is_first ? (longer >> i) / SHARE : 2, &x, &y);
  }
  out->x = side * (x + summit(alike(a, b, x - 1, y), best, alike(a, b, x + 1, y)));
  out->y = side * (y + summit(alike(a, b, x, y - 1), best, alike(a, b, x, y + 1)));
  double squares = alike(a, a, 0, 0) * alike(b, b, 0, 0);
  out->likeness = squares > 0 ? best / sqrt(squares) : 0;
}

celspan_status cs_shift_find(const cs_rough *page, const cs_rough *onto, cs_rough_shift *out) {
  cs_grey_levels a = {0}, b = {0};
  celspan_status status = darken(page, &a);
  if (status == CELSPAN_OK)
    status = darken(onto, &b);
  if (status == CELSPAN_OK)
    find(&a, &b, page->side, out);
  cs_grey_levels_finish(&a);
  cs_grey_levels_finish(&b);
  return status;
}
