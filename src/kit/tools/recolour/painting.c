#include "tools/recolour/painting.h"

#include <math.h>
#include <string.h>

#include "inside/colour.h"

/* How far the codes of a pixel are from a mixture that was rounded to 8 or 16 bits, at most. */
#define ROUNDED (0.9 / 255)
#define ROUNDED_FINELY (1.3 / 65535)
enum { MOST = 8 };

/* Marks of pixels that have no colour of the table: alone, or of an area. */
static const cs_swatch alone, area;

static const float *pixel(const cs_painting *painting, int32_t x, int32_t y) {
  return painting->rgba + 4 * ((size_t)y * (size_t)painting->width + (size_t)x);
}

static const cs_swatch **exact_at(const cs_painting *painting, int32_t x, int32_t y) {
  return painting->exact + ((size_t)y * (size_t)painting->width + (size_t)x);
}

static bool is_inside(const cs_painting *painting, int32_t x, int32_t y) {
  return x >= 0 && y >= 0 && x < painting->width && y < painting->height;
}

static bool is_same(const float a[4], const float b[4]) {
  return a[0] == b[0] && a[1] == b[1] && a[2] == b[2] && a[3] == b[3];
}

static void code_of(const float rgba[4], double code[3]) {
  for (int c = 0; c < 3; c++)
    code[c] = cs_transfer_code(rgba[c] > 0 ? (double)rgba[c] / (double)rgba[3] : 0);
}

/* ---------------------------------------------------------------- exact colours */

static const cs_swatch *find(cs_painting *painting, const float rgba[4]) {
  double code[3];
  if (!(rgba[3] > 0))
    return NULL;
  code_of(rgba, code);
  for (int c = 0; c < 3 && rgba[3] == 1; c++)
    if (fabs(code[c] * 255 - floor(code[c] * 255 + 0.5)) > 0.002)
      painting->rounded = ROUNDED_FINELY;
  const cs_swatch *found = cs_swatches_find(painting->swatches, code, painting->within);
  return found ? found : &alone;
}

/* Returns whether most of what is visible has a colour of the table. */
static bool find_exact(cs_painting *painting) {
  size_t count = (size_t)painting->width * (size_t)painting->height, visible = 0, strange = 0;
  painting->rounded = ROUNDED;
  for (size_t i = 0; i < count; i++) {
    const float *rgba = painting->rgba + 4 * i;
    bool is_known = i > 0 && is_same(rgba, rgba - 4);
    painting->exact[i] = is_known ? painting->exact[i - 1] : find(painting, rgba);
    visible += painting->exact[i] != NULL;
    strange += painting->exact[i] == &alone;
  }
  return strange <= visible / 2;
}

/* Whether three neighbours of a pixel are like it: along an edge only two are. */
static bool is_area(const cs_painting *painting, int32_t x, int32_t y) {
  int same = -1; /* without itself */
  for (int32_t j = y - 1; j <= y + 1; j++)
    for (int32_t i = x - 1; i <= x + 1; i++)
      same += is_inside(painting, i, j) && is_same(pixel(painting, i, j), pixel(painting, x, y));
  return same >= 3;
}

static void find_areas(cs_painting *painting) {
  for (int32_t y = 0; y < painting->height; y++)
    for (int32_t x = 0; x < painting->width; x++)
      if (*exact_at(painting, x, y) == &alone && is_area(painting, x, y))
        *exact_at(painting, x, y) = &area;
}

/* ---------------------------------------------------------------- mixtures */

/* What is known about a pixel. */
typedef struct search {
  const cs_painting *painting;
  int32_t x, y;
  float alpha;
  cs_mixture mixture;
  cs_swatch near[MOST];      /* the nearest first */
  size_t count, table_count; /* the first ones are of the table */
} search;

static bool is_found(const search *s) { return s->mixture.off <= s->painting->rounded; }

/* Adds a colour and tries it with each one before. */
static void add(search *s, const cs_swatch *colour) {
  for (size_t i = 0; i < s->count; i++)
    if (memcmp(s->near[i].code, colour->code, sizeof colour->code) == 0)
      return;
  if (s->count == MOST)
    return;
  for (size_t i = 0; i < s->count; i++)
    cs_mixture_try(&s->mixture, &s->near[i], colour, NULL);
  s->near[s->count++] = *colour;
}

/* Adds the pixels around, the nearest first, until those of one distance explain the colour: those
 * of the table, or the areas with colours that stay. A pixel with alpha may be a colour
 * of the table alone. */
static void visit(search *s, bool is_strange) {
  const cs_painting *painting = s->painting;
  for (int i = 0; i < CS_PAINTING_AROUND; i++) {
    const int8_t *to = painting->around[i];
    int32_t x = s->x + to[0], y = s->y + to[1];
    if (to[2] && is_found(s))
      return;
    const cs_swatch *exact = is_inside(painting, x, y) ? *exact_at(painting, x, y) : NULL;
    cs_swatch stays;
    double code[3];
    if (!exact || exact == &alone || (exact == &area) != is_strange)
      continue;
    if (is_strange) {
      code_of(pixel(painting, x, y), code);
      stays = cs_swatches_stay(painting->swatches, code);
    } else if (s->alpha < 1) {
      cs_mixture_try(&s->mixture, exact, exact, NULL);
    }
    add(s, is_strange ? &stays : exact);
  }
}

static void search_around(search *s, bool is_strange) {
  visit(s, is_strange);
  if (!is_strange)
    s->table_count = s->count;
  for (size_t i = 2; i < s->count && !is_found(s); i++)
    for (size_t j = 1; j < i; j++)
      for (size_t k = 0; k < j; k++)
        cs_mixture_try(&s->mixture, &s->near[i], &s->near[j], &s->near[k]);
}

static void try_all(search *s) {
  const cs_swatches *swatches = s->painting->swatches;
  for (size_t i = 0; i < swatches->count; i++) {
    cs_mixture_try(&s->mixture, &s->near[0], &swatches->list[i], NULL);
    if (s->table_count > 1) {
      cs_mixture_try(&s->mixture, &s->near[1], &swatches->list[i], NULL);
      cs_mixture_try(&s->mixture, &s->near[0], &s->near[1], &swatches->list[i]);
    }
  }
}

/* The new colour of a pixel that has none exactly; false: it stays. */
static bool mix(search *s, const double code[3]) {
  s->mixture = cs_mixture_begin(s->painting->swatches, code);
  /* A faint colour may have been rounded after it was multiplied by its alpha. */
  const double faint = ROUNDED / (double)s->alpha;
  search_around(s, false);
  if (s->mixture.off > faint)
    search_around(s, true);
  if (s->table_count > 0 && s->count == s->table_count && s->mixture.off > faint)
    try_all(s);
  return s->table_count > 0 && s->mixture.off <= faint;
}

/* ---------------------------------------------------------------- pixels */

static void recolour(cs_painting *painting, int32_t x, int32_t y) {
  const cs_swatch *exact = *exact_at(painting, x, y);
  const double *to = exact ? exact->to : NULL;
  float *rgba = painting->rgba + (pixel(painting, x, y) - painting->rgba);
  search s = {.painting = painting, .x = x, .y = y, .alpha = rgba[3]};
  double code[3], light[3];
  if (!exact)
    return;
  if (exact == &alone || exact == &area) {
    code_of(rgba, code);
    to = exact == &alone && mix(&s, code) ? s.mixture.colour.to : NULL;
  }
  if (!to && painting->report && s.count == s.table_count)
    painting->report(painting->user, code, x, y);
  if (!to)
    return;
  cs_swatches_light(painting->swatches, to, light);
  for (int c = 0; c < 3; c++)
    rgba[c] = (float)(light[c] * (double)rgba[3]);
  painting->is_changed = true;
}

static void order_around(cs_painting *painting) {
  int count = 0;
  for (int distance = 1; distance <= 2 * CS_PAINTING_RADIUS * CS_PAINTING_RADIUS; distance++) {
    int first = count;
    for (int8_t dy = -CS_PAINTING_RADIUS; dy <= CS_PAINTING_RADIUS; dy++)
      for (int8_t dx = -CS_PAINTING_RADIUS; dx <= CS_PAINTING_RADIUS; dx++)
        if (dx * dx + dy * dy == distance) {
          int8_t *to = painting->around[count++];
          to[0] = dx;
          to[1] = dy;
          to[2] = count == first + 1;
        }
  }
}

celspan_status cs_painting_recolour(celspan_context *context, cs_painting *painting) {
  size_t count = (size_t)painting->width * (size_t)painting->height;
  CS_TRY(CS_MAKE(context, painting->exact, count));
  order_around(painting);
  bool is_recoloured = find_exact(painting) || !painting->only_known;
  find_areas(painting);
  for (int32_t y = 0; y < painting->height && is_recoloured; y++)
    for (int32_t x = 0; x < painting->width; x++)
      recolour(painting, x, y);
  cs_mem_free(context->memory, painting->exact, count * sizeof *painting->exact);
  return CELSPAN_OK;
}
