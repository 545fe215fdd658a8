#include "tools/track/grey.h"

#include <math.h>
#include <string.h>

#include "inside/number.h"
#include "inside/sort.h"

enum { LEAST_SIDE = 16 };

static celspan_status allocate(celspan_context *context, int32_t width, int32_t height,
                               cs_grey_levels *levels) {
  size_t count = (size_t)width * (size_t)height;
  float *values = cs_mem_array(levels->memory, count, sizeof *values);
  if (!values)
    return cs_fail_memory(context);
  levels->levels[levels->count++] = (cs_grey){width, height, values};
  return CELSPAN_OK;
}

static int32_t held(int32_t at, int32_t size) { return at < 0 ? 0 : at < size ? at : size - 1; }

/* The mean of the pixels 2 i - 1 .. 2 i + 2 of a line by the weights 1 3 3 1; `stride` is from one
 * to the next. */
static float halved(const float *line, int32_t size, ptrdiff_t stride, int32_t i) {
  float outer = line[held(2 * i - 1, size) * stride] + line[held(2 * i + 2, size) * stride];
  float inner = line[held(2 * i, size) * stride] + line[held(2 * i + 1, size) * stride];
  return (outer + 3 * inner) / 8;
}

static void halve_row(const cs_grey *from, int32_t y, float *lines, cs_grey *to) {
  const int32_t width = from->width;
  for (int32_t x = 0; x < width; x++)
    lines[x] = halved(from->values + x, from->height, width, y);
  for (int32_t x = 0; x < to->width; x++)
    to->values[(size_t)y * (size_t)to->width + (size_t)x] = halved(lines, width, 1, x);
}

static celspan_status append_level(celspan_context *context, cs_grey_levels *levels) {
  const cs_grey from = levels->levels[levels->count - 1];
  float *lines = cs_mem_array(levels->memory, (size_t)from.width, sizeof *lines);
  if (!lines)
    return cs_fail_memory(context);
  celspan_status status = allocate(context, from.width / 2, from.height / 2, levels);
  if (status == CELSPAN_OK)
    for (int32_t y = 0; y < from.height / 2; y++)
      halve_row(&from, y, lines, &levels->levels[levels->count - 1]);
  cs_mem_free(levels->memory, lines, (size_t)from.width * sizeof *lines);
  return status;
}

static celspan_status fill(celspan_context *context, const float *values, int32_t width,
                           int32_t height, int32_t count, cs_grey_levels *levels) {
  CS_TRY(allocate(context, width, height, levels));
  memcpy(levels->levels[0].values, values, (size_t)width * (size_t)height * sizeof *values);
  for (int32_t side = width < height ? width : height; levels->count < count; side /= 2) {
    if (side / 2 < LEAST_SIDE)
      break;
    CS_TRY(append_level(context, levels));
  }
  return CELSPAN_OK;
}

celspan_status cs_grey_levels_make(celspan_context *context, const float *values, int32_t width,
                                   int32_t height, int32_t count, cs_grey_levels *out) {
  *out = (cs_grey_levels){.memory = context->memory};
  celspan_status status = fill(context, values, width, height, count, out);
  if (status != CELSPAN_OK)
    cs_grey_levels_finish(out);
  return status;
}

void cs_grey_levels_finish(cs_grey_levels *levels) {
  for (int32_t i = 0; i < levels->count; i++) {
    const cs_grey *grey = &levels->levels[i];
    cs_mem_free(levels->memory, grey->values,
                (size_t)grey->width * (size_t)grey->height * sizeof *grey->values);
  }
  *levels = (cs_grey_levels){0};
}

/* ---------------------------------------------------------------- features */

#define SQUARE 3 /* the radius over which slopes are summed */
/* of values in 0..1, summed over a square: a smaller strength is noise */
#define LEAST_STRENGTH 2e-4
#define LEAST_SHARE 0.005 /* share of the strongest corner's strength */

typedef struct candidate {
  float strength;
  int32_t x, y;
} candidate;

/* The strongest comes first; equally strong ones are ordered from top to bottom and from left
 * to right. */
static inline bool precedes(const candidate *a, const candidate *b) {
  if (a->strength != b->strength)
    return a->strength > b->strength;
  return a->y != b->y ? a->y < b->y : a->x < b->x;
}

CS_SORT_DEFINE(sort_candidates, candidate, precedes)

/* The smaller eigenvalue around a pixel that is at least SQUARE + 1 pixels from the border. */
static float strength_at(const cs_grey *grey, int32_t x, int32_t y) {
  float xx = 0, xy = 0, yy = 0;
  const ptrdiff_t stride = grey->width;
  for (int32_t v = y - SQUARE; v <= y + SQUARE; v++) {
    const float *row = grey->values + (ptrdiff_t)v * stride;
    for (int32_t u = x - SQUARE; u <= x + SQUARE; u++) {
      float slope_x = (row[u + 1] - row[u - 1]) / 2;
      float slope_y = (row[u + stride] - row[u - stride]) / 2;
      xx += slope_x * slope_x;
      xy += slope_x * slope_y;
      yy += slope_y * slope_y;
    }
  }
  float half = (xx - yy) / 2;
  return (xx + yy) / 2 - sqrtf(half * half + xy * xy);
}

/* A map of strengths over the region. */
typedef struct map {
  int32_t x0, y0, width, height;
  float *strengths;
} map;

static float strength_in(const map *m, int32_t x, int32_t y) {
  return m->strengths[(size_t)y * (size_t)m->width + (size_t)x];
}

static void measure(const cs_grey *grey, const cs_features_region *region, map *m) {
  for (int32_t y = 0; y < m->height; y++)
    for (int32_t x = 0; x < m->width; x++) {
      int32_t column = m->x0 + x, row = m->y0 + y;
      const uint8_t *mask = region->mask;
      bool is_wanted = !mask || mask[(size_t)row * (size_t)grey->width + (size_t)column];
      m->strengths[(size_t)y * (size_t)m->width + (size_t)x] =
          is_wanted ? strength_at(grey, column, row) : 0;
    }
}

/* Whether no neighbour is stronger; of equally strong ones, the first is a peak. */
static bool is_peak(const map *m, int32_t x, int32_t y) {
  float strength = strength_in(m, x, y);
  for (int32_t v = y - 1; v <= y + 1; v++)
    for (int32_t u = x - 1; u <= x + 1; u++) {
      if (u < 0 || v < 0 || u >= m->width || v >= m->height || (u == x && v == y))
        continue;
      bool is_before = v < y || (v == y && u < x);
      if (strength_in(m, u, v) > strength || (is_before && strength_in(m, u, v) == strength))
        return false;
    }
  return strength > (float)LEAST_STRENGTH;
}

static celspan_status list_peaks(celspan_context *context, const map *m, candidate **list,
                                 size_t *capacity, size_t *count) {
  for (int32_t y = 0; y < m->height; y++)
    for (int32_t x = 0; x < m->width; x++) {
      if (!is_peak(m, x, y))
        continue;
      CS_TRY(CS_APPEND(context, *list, *count, *capacity,
                       (candidate){strength_in(m, x, y), m->x0 + x, m->y0 + y}));
    }
  return CELSPAN_OK;
}

/* Keeps the candidates, strongest first, that are at least `apart` from all candidates kept before
 * them. */
static size_t spread(const candidate *list, size_t count, double apart, celspan_point *out) {
  size_t taken = 0;
  for (size_t i = 0; i < count && taken < CS_FEATURES_MOST; i++) {
    bool is_free = (double)list[i].strength >= LEAST_SHARE * (double)list[0].strength;
    for (size_t k = 0; k < taken && is_free; k++)
      is_free = cs_number_length(out[k].x - list[i].x, out[k].y - list[i].y) >= apart;
    if (is_free)
      out[taken++] = (celspan_point){list[i].x, list[i].y};
  }
  return taken;
}

static int32_t clamp(int32_t value, int32_t low, int32_t high) {
  return value < low ? low : value > high ? high : value;
}

/* The part of the region in which slopes can be summed around each pixel. */
static map map_of(const cs_grey *grey, const cs_features_region *region) {
  enum { BORDER = SQUARE + 1 };
  int32_t x0 = clamp(region->x0, BORDER, grey->width),
          x1 = clamp(region->x1, 0, grey->width - BORDER);
  int32_t y0 = clamp(region->y0, BORDER, grey->height),
          y1 = clamp(region->y1, 0, grey->height - BORDER);
  return (map){x0, y0, x1 > x0 ? x1 - x0 : 0, y1 > y0 ? y1 - y0 : 0, NULL};
}

static celspan_status choose(celspan_context *context, const map *m, celspan_point *out,
                             size_t *count) {
  candidate *list = NULL;
  size_t capacity = 0, found = 0;
  celspan_status status = list_peaks(context, m, &list, &capacity, &found);
  if (status == CELSPAN_OK) {
    sort_candidates(list, found);
    double apart = sqrt((double)m->width * m->height / CS_FEATURES_MOST) * 0.6;
    *count = spread(list, found, apart > 4 ? apart : 4, out);
  }
  cs_mem_free(context->memory, list, capacity * sizeof *list);
  return status;
}

celspan_status cs_features_find(celspan_context *context, const cs_grey *grey,
                                const cs_features_region *region, celspan_point *out,
                                size_t *count) {
  map m = map_of(grey, region);
  size_t size = (size_t)m.width * (size_t)m.height;
  *count = 0;
  if (size == 0)
    return CELSPAN_OK;
  CS_TRY(CS_MAKE(context, m.strengths, size));
  measure(grey, region, &m);
  celspan_status status = choose(context, &m, out, count);
  cs_mem_free(context->memory, m.strengths, size * sizeof *m.strengths);
  return status;
}
