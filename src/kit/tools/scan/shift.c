#include "tools/scan/shift.h"

#include <math.h>

#include "inside/context.h"
#include "inside/number.h"

enum { PLANES = 4, SHARE = 12 };
/* Less darkness is paper. */
#define PAPER 0.08f

typedef struct plane {
  int32_t width, height;
  float *dark;
} plane;

static void finish(celspan_context *context, plane planes[PLANES]) {
  for (int i = 0; i < PLANES; i++)
    cs_mem_free(context->memory, planes[i].dark,
                (size_t)planes[i].width * (size_t)planes[i].height * sizeof(float));
}

static void fill_row(const cs_rough *page, int32_t y, float *field, float *dark) {
  int32_t first, end, middle = y * page->side + page->side / 2;
  cs_rough_row(page, middle, 3 * page->side, &first, &end);
  cs_rough_field(page, middle, field);
  for (int32_t x = 0; x < page->width; x++) {
    int32_t at = x * page->side + page->side / 2;
    float share = page->spots[(size_t)y * (size_t)page->width + (size_t)x] / field[at];
    dark[x] = at >= first && at < end && share < 1 - PAPER ? 1 - share : 0;
  }
}

static void halve(const plane *from, plane *to) {
  for (int32_t y = 0; y < to->height; y++)
    for (int32_t x = 0; x < to->width; x++) {
      const float *p = from->dark + (size_t)(2 * y) * (size_t)from->width + (size_t)(2 * x);
      to->dark[(size_t)y * (size_t)to->width + (size_t)x] =
          (p[0] + p[1] + p[from->width] + p[from->width + 1]) / 4;
    }
}

static celspan_status make(const cs_rough *page, plane planes[PLANES]) {
  celspan_context *context = page->context;
  float *field;
  for (int i = 0; i < PLANES; i++) {
    planes[i] = (plane){page->width >> i, page->height >> i, NULL};
    CS_TRY(CS_MAKE(context, planes[i].dark, (size_t)planes[i].width * (size_t)planes[i].height));
  }
  CS_TRY(CS_MAKE(context, field, (size_t)page->scan.width));
  for (int32_t y = 0; y < page->height; y++)
    fill_row(page, y, field, planes[0].dark + (size_t)y * (size_t)page->width);
  cs_mem_free(context->memory, field, (size_t)page->scan.width * sizeof *field);
  for (int i = 1; i < PLANES; i++)
    halve(&planes[i - 1], &planes[i]);
  return CELSPAN_OK;
}

/* The sum of the products where `a` is moved by (x, y) onto b. */
static double alike(const plane *a, const plane *b, int32_t x, int32_t y) {
  double sum = 0;
  int32_t left = x > 0 ? x : 0, right = x < 0 ? a->width + x : a->width;
  for (int32_t v = y > 0 ? y : 0; v < (y < 0 ? a->height + y : a->height); v++) {
    const float *from = a->dark + (size_t)(v - y) * (size_t)a->width;
    const float *to = b->dark + (size_t)v * (size_t)b->width;
    float row = 0;
    for (int32_t u = left; u < right; u++)
      row += from[u - x] * to[u];
    sum += (double)row;
  }
  return sum;
}

/* Moves (*x, *y) to the best of the shifts around it. */
static double search(const plane *a, const plane *b, int32_t radius, int32_t *x, int32_t *y) {
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

static void find(const plane *a, const plane *b, int32_t side, cs_rough_shift *out) {
  int32_t x = 0, y = 0, longer = a->width > a->height ? a->width : a->height;
  double best = search(&a[PLANES - 1], &b[PLANES - 1], (longer >> (PLANES - 1)) / SHARE, &x, &y);
  for (int i = PLANES - 2; i >= 0; i--) {
    x *= 2;
    y *= 2;
    best = search(&a[i], &b[i], 2, &x, &y);
  }
  out->x = side * (x + summit(alike(a, b, x - 1, y), best, alike(a, b, x + 1, y)));
  out->y = side * (y + summit(alike(a, b, x, y - 1), best, alike(a, b, x, y + 1)));
  double squares = alike(a, a, 0, 0) * alike(b, b, 0, 0);
  out->likeness = squares > 0 ? best / sqrt(squares) : 0;
}

celspan_status cs_shift_find(const cs_rough *page, const cs_rough *onto, cs_rough_shift *out) {
  plane a[PLANES] = {{0}}, b[PLANES] = {{0}};
  celspan_status status = make(page, a);
  if (status == CELSPAN_OK)
    status = make(onto, b);
  if (status == CELSPAN_OK)
    find(a, b, page->side, out);
  finish(page->context, a);
  finish(page->context, b);
  return status;
}
