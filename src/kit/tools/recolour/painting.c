#include "tools/recolour/painting.h"

#include <math.h>

#include "inside/colour.h"

/* How far the codes of a pixel are from a mixture that was rounded to 8 or 16 bits, at most. */
#define ROUNDED (0.9 / 255)
#define ROUNDED_FINELY (1.3 / 65535)
enum { MOST = 8, STRANGE = 4 };

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
  const cs_swatch *near[MOST]; /* the nearest first */
  size_t count, table_count;   /* the first ones are of the table */
  cs_swatch strange[STRANGE];
} search;

static bool is_found(const search *s) { return s->mixture.off <= s->painting->rounded; }

/* Adds a colour and tries it with each one before. */
static void add(search *s, const cs_swatch *colour) {
  for (size_t i = 0; i < s->count; i++)
    if (s->near[i] == colour)
      return;
  if (s->count == MOST)
    return;
  for (size_t i = 0; i < s->count; i++)
    cs_mixture_try(&s->mixture, s->near[i], colour, NULL);
  s->near[s->count++] = colour;
}

static void add_strange(search *s, int32_t x, int32_t y) {
  double code[3];
  size_t known = s->count - s->table_count;
  code_of(pixel(s->painting, x, y), code);
  for (size_t i = 0; i < known; i++)
    if (s->strange[i].code[0] == code[0] && s->strange[i].code[1] == code[1] &&
        s->strange[i].code[2] == code[2])
      return;
  if (known == STRANGE || s->count == MOST)
    return;
  s->strange[known] = cs_swatches_stay(s->painting->swatches, code);
  add(s, &s->strange[known]);
}

/* A neighbour with a colour of the table; of a pixel with alpha it may be the whole mixture. */
static void add_exact(search *s, const cs_swatch *colour) {
  if (s->alpha < 1)
    cs_mixture_try(&s->mixture, colour, colour, NULL);
  add(s, colour);
}

static int32_t squared(const int8_t at[2]) { return at[0] * at[0] + at[1] * at[1]; }

/* Visits the pixels around, the nearest first, until those of one distance explain the colour. */
static void visit(search *s, bool is_strange) {
  const cs_painting *painting = s->painting;
  for (int i = 0; i < CS_PAINTING_AROUND; i++) {
    const int8_t *to = painting->around[i];
    if (i > 0 && squared(to) > squared(painting->around[i - 1]) && is_found(s))
      return;
    if (!is_inside(painting, s->x + to[0], s->y + to[1]))
      continue;
    const cs_swatch *exact = *exact_at(painting, s->x + to[0], s->y + to[1]);
    if (is_strange && exact == &area)
      add_strange(s, s->x + to[0], s->y + to[1]);
    else if (!is_strange && exact && exact != &alone && exact != &area)
      add_exact(s, exact);
  }
}

static void search_around(search *s, bool is_strange) {
  visit(s, is_strange);
  if (!is_strange)
    s->table_count = s->count;
  for (size_t i = 2; i < s->count && !is_found(s); i++)
    for (size_t j = 1; j < i; j++)
      for (size_t k = 0; k < j; k++)
        cs_mixture_try(&s->mixture, s->near[i], s->near[j], s->near[k]);
}

static void try_all(search *s) {
  const cs_swatches *swatches = s->painting->swatches;
  for (size_t i = 0; i < swatches->count; i++) {
    cs_mixture_try(&s->mixture, s->near[0], &swatches->list[i], NULL);
    if (s->table_count > 1) {
      cs_mixture_try(&s->mixture, s->near[1], &swatches->list[i], NULL);
      cs_mixture_try(&s->mixture, s->near[0], s->near[1], &swatches->list[i]);
    }
  }
}

/* The new colour of a pixel that has none exactly; false: it stays. */
static bool mix(search *s, const float rgba[4], const double code[3]) {
  s->alpha = rgba[3];
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

static void set(cs_painting *painting, float *rgba, const double to[3]) {
  double light[3];
  cs_swatches_light(painting->swatches, to, light);
  for (int c = 0; c < 3; c++)
    rgba[c] = (float)(light[c] * (double)rgba[3]);
  painting->is_changed = true;
}

static void recolour(cs_painting *painting, int32_t x, int32_t y) {
  const cs_swatch *exact = *exact_at(painting, x, y);
  float *rgba = painting->rgba + (pixel(painting, x, y) - painting->rgba);
  search s = {.painting = painting, .x = x, .y = y};
  double code[3];
  if (!exact)
    return;
  if (exact != &alone && exact != &area) {
    set(painting, rgba, exact->to);
    return;
  }
  code_of(rgba, code);
  if (exact == &alone && mix(&s, rgba, code))
    set(painting, rgba, s.mixture.colour.to);
  else if (painting->report && s.count == s.table_count)
    painting->report(painting->user, code, x, y);
}

static void order_around(cs_painting *painting) {
  int count = 0;
  for (int distance = 1; distance <= 2 * CS_PAINTING_RADIUS * CS_PAINTING_RADIUS; distance++)
    for (int8_t dy = -CS_PAINTING_RADIUS; dy <= CS_PAINTING_RADIUS; dy++)
      for (int8_t dx = -CS_PAINTING_RADIUS; dx <= CS_PAINTING_RADIUS; dx++)
        if (dx * dx + dy * dy == distance) {
          painting->around[count][0] = dx;
          painting->around[count++][1] = dy;
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
