#include "tools/scan/holes.h"

#include <math.h>
#include <string.h>

#include "inside/elementary.h"
#include "inside/number.h"
#include "inside/sort.h"
#include "tools/scan/blots.h"

/* How far a spot differs from the paper where there may be a hole: darker; brighter at least, where
 * the paper is hardly darker than white. */
#define DARKER 0.2f
#define BRIGHTER 0.02f
#define MILLIMETRES 25.4
/* The greatest sine of the turn; how far from 1 the scale of a scan with the right `dpi` may be. */
#define MOST_TURN 0.27
#define MOST_SCALE 0.03
enum { BLOTS = 64, SHADES = 256 }; /* BLOTS: half of them dark, half of them bright */

/* The blots that may be holes, in spots, and what is wanted. */
typedef struct search {
  cs_rough *page;
  cs_blot blots[BLOTS];
  size_t count;
  const cs_hole *holes;
  size_t hole_count;
  double unit; /* spots for a millimetre */
} search;

/* A way to lay the holes on the page: x + y i of a hole, times (re + im i), plus (x, y). In spots.
 */
typedef struct laying {
  double re, im, x, y;
  int32_t found;
  uint8_t of_hole[CS_ROUGH_HOLES]; /* the blot of each hole; BLOTS: none */
} laying;

/* ---------------------------------------------------------------- candidates */

/* The mean of 3 x 3 spots, because a bright hole differs from the paper hardly more than its grain.
 */
static float mean_at(const cs_rough *page, int32_t x, int32_t y) {
  float sum = 0;
  if (x < 1 || y < 1 || x + 1 >= page->width || y + 1 >= page->height)
    return page->spots[(size_t)y * (size_t)page->width + (size_t)x];
  for (int32_t v = y - 1; v <= y + 1; v++) {
    const float *spot = page->spots + (size_t)v * (size_t)page->width + (size_t)x;
    sum += spot[-1] + spot[0] + spot[1];
  }
  return sum / 9;
}

/* A bright hole is as white as the light, which a shadow dims as much as the paper. */
static bool may_be_hole(const cs_rough *page, float spot, float paper, bool is_bright) {
  float white = 0.4f * (1 / page->paper[1] - 1);
  float least = white > BRIGHTER ? white : BRIGHTER;
  return is_bright ? spot > paper * (1 + least) : spot < paper * (1 - DARKER);
}

static void mark_row(const cs_rough *page, int32_t y, bool is_bright, float *field, uint8_t *row) {
  int32_t first, end, middle = y * page->side + page->side / 2;
  cs_rough_row(page, middle, 2 * page->side, &first, &end);
  cs_rough_field(page, middle, field);
  for (int32_t x = 0; x < page->width; x++) {
    float paper = field[x * page->side + page->side / 2];
    bool is_inside = x * page->side >= first && (x + 1) * page->side <= end;
    row[x] = is_inside && may_be_hole(page, mean_at(page, x, y), paper, is_bright);
  }
}

static inline bool is_larger(const cs_blot *a, const cs_blot *b) {
  return a->area != b->area ? a->area > b->area : a->y0 != b->y0 ? a->y0 < b->y0 : a->x0 < b->x0;
}
CS_SORT_DEFINE(sort_blots, cs_blot, is_larger)

/* Adds the largest of the compact blots. */
static void choose(search *s, cs_blots *blots) {
  size_t kept = 0;
  for (size_t i = 0; i < blots->count; i++) {
    const cs_blot *blot = &blots->list[i];
    int32_t wide = blot->x1 - blot->x0, high = blot->y1 - blot->y0;
    bool is_compact = 2 * blot->area > (uint32_t)wide * (uint32_t)high;
    if (blot->area >= 8 && is_compact && wide < s->page->width / 4 && high < s->page->height / 4)
      blots->list[kept++] = *blot;
  }
  sort_blots(blots->list, kept);
  kept = kept < BLOTS / 2 ? kept : BLOTS / 2;
  if (kept > 0)
    memcpy(s->blots + s->count, blots->list, kept * sizeof *s->blots);
  s->count += kept;
}

static celspan_status find_blots(search *s, bool is_bright) {
  const cs_rough *page = s->page;
  celspan_context *context = page->context;
  size_t wide = (size_t)page->width, count = wide * (size_t)page->height;
  size_t columns = (size_t)page->scan.width;
  float *field;
  uint8_t *plane;
  cs_blots blots;
  CS_TRY(CS_MAKE(context, field, columns));
  celspan_status status = CS_MAKE(context, plane, count);
  for (int32_t y = 0; y < page->height && status == CELSPAN_OK; y++)
    mark_row(page, y, is_bright, field, plane + (size_t)y * wide);
  if (status == CELSPAN_OK)
    status = cs_blots_find(context, plane, page->width, page->height, &blots);
  if (status == CELSPAN_OK) {
    choose(s, &blots);
    cs_blots_finish(&blots, context);
  }
  cs_mem_free(context->memory, plane, count);
  cs_mem_free(context->memory, field, columns * sizeof *field);
  return status;
}

/* ---------------------------------------------------------------- laying the holes */

static celspan_point middle_of(const cs_blot *blot) {
  return (celspan_point){(blot->x0 + blot->x1) / 2.0, (blot->y0 + blot->y1) / 2.0};
}

static double larger(double a, double b) { return a > b ? a : b; }

/* Whether a blot has the size that a hole has when it is laid so. */
static bool is_of_size(const laying *l, const cs_blot *blot, const cs_hole *hole) {
  double re = fabs(l->re), im = fabs(l->im), room = 4;
  double wide = hole->width * re + hole->height * im, high = hole->width * im + hole->height * re;
  double area = (re * re + im * im) * hole->width * hole->height;
  return fabs(blot->x1 - blot->x0 - wide) <= larger(0.2 * wide, room) &&
         fabs(blot->y1 - blot->y0 - high) <= larger(0.2 * high, room) && blot->area > 0.55 * area &&
         blot->area < 1.3 * area + room * (wide + high);
}

/* Finds the blot of each hole of a laying. */
static void count_holes(const search *s, laying *l) {
  l->found = 0;
  for (size_t h = 0; h < s->hole_count; h++) {
    const cs_hole *hole = &s->holes[h];
    double x = l->x + hole->x * l->re - hole->y * l->im;
    double y = l->y + hole->x * l->im + hole->y * l->re, best = larger(l->re, 2);
    l->of_hole[h] = BLOTS;
    for (size_t i = 0; i < s->count; i++) {
      celspan_point at = middle_of(&s->blots[i]);
      double distance = cs_number_length(at.x - x, at.y - y);
      if (distance >= best || !is_of_size(l, &s->blots[i], hole))
        continue;
      best = distance;
      l->of_hole[h] = (uint8_t)i;
    }
    l->found += l->of_hole[h] < BLOTS;
  }
}

/* Lays two holes on two blots. Returns whether such a turn and scale are possible. */
static bool lay(const search *s, const size_t hole[2], const size_t blot[2], laying *out) {
  const cs_hole *a = &s->holes[hole[0]], *b = &s->holes[hole[1]];
  celspan_point p = middle_of(&s->blots[blot[0]]), q = middle_of(&s->blots[blot[1]]);
  double x = b->x - a->x, y = b->y - a->y, dx = q.x - p.x, dy = q.y - p.y;
  double square = x * x + y * y;
  if (square == 0)
    return false;
  out->re = (dx * x + dy * y) / square;
  out->im = (dy * x - dx * y) / square;
  out->x = p.x - a->x * out->re + a->y * out->im;
  out->y = p.y - a->x * out->im - a->y * out->re;
  return out->re > s->unit / 8 && out->re < s->unit * 8 && fabs(out->im) <= MOST_TURN * out->re;
}

static double scale_of(const search *s, const laying *l) {
  return cs_number_length(l->re, l->im) / s->unit;
}

static bool is_better(const search *s, const laying *a, const laying *b) {
  bool is_right = fabs(scale_of(s, a) - 1) <= MOST_SCALE;
  bool was_right = b->found > 0 && fabs(scale_of(s, b) - 1) <= MOST_SCALE;
  bool is_whole = a->found == (int32_t)s->hole_count;
  bool was_whole = b->found == (int32_t)s->hole_count;
  if (a->found < 2 || (!is_right && !is_whole))
    return false;
  if (is_whole != was_whole)
    return is_whole;
  return is_right != was_right ? is_right : a->found > b->found;
}

static void try_pairs(const search *s, const size_t hole[2], laying *best) {
  for (size_t i = 0; i < s->count; i++)
    for (size_t j = 0; j < s->count; j++) {
      laying l;
      if (i == j || !lay(s, hole, (const size_t[]){i, j}, &l) ||
          !is_of_size(&l, &s->blots[i], &s->holes[hole[0]]) ||
          !is_of_size(&l, &s->blots[j], &s->holes[hole[1]]))
        continue;
      count_holes(s, &l);
      if (is_better(s, &l, best))
        *best = l;
    }
}

/* ---------------------------------------------------------------- the middle of a hole */

/* How far the pixels of a row of a box are from the paper, as shades. */
typedef struct shading {
  const cs_rough *page;
  float *paper; /* the field of the row */
} shading;

/* The mean of a square, in which grain is little and the middle of a hole stays where it is. */
static uint8_t shade_at(const shading *s, int32_t x, int32_t y) {
  const cs_scan *scan = &s->page->scan;
  const int32_t side = s->page->side;
  int32_t x0 = x > side ? x - side : 0, x1 = x + side < scan->width ? x + side : scan->width - 1;
  int32_t y0 = y > side ? y - side : 0, y1 = y + side < scan->height ? y + side : scan->height - 1;
  float sum = 0;
  for (int32_t v = y0; v <= y1; v++)
    for (int32_t u = x0; u <= x1; u++)
      sum += cs_rough_brightness(cs_scan_at(scan, u, v));
  float share = sum / ((float)((x1 - x0 + 1) * (y1 - y0 + 1)) * s->paper[x]);
  return (uint8_t)cs_number_clampf(fabsf(1 - share) * (SHADES - 1) + 0.5f, 0, SHADES - 1);
}

/* The shade of the inside: of most pixels of the box. */
static int inside_of(const shading *s, const celspan_rectangle *box) {
  uint32_t counts[SHADES] = {0}, below = 0;
  for (int32_t y = box->y; y < box->y + box->height; y++) {
    cs_rough_field(s->page, y, s->paper);
    for (int32_t x = box->x; x < box->x + box->width; x++)
      counts[shade_at(s, x, y)]++;
  }
  uint32_t wanted = (uint32_t)(box->width * box->height) / 10 * 7;
  int shade = 0;
  while (shade < SHADES - 1 && (below += counts[shade]) <= wanted)
    shade++;
  return shade > 0 ? shade : 1;
}

/* The middle of what the hole covers: a pixel counts from a quarter of the way between paper and
 * hole on, and fully from three quarters on. */
static celspan_point middle_in(const shading *s, const celspan_rectangle *box) {
  double sum = 0, across = 0, down = 0;
  float inside = (float)inside_of(s, box);
  for (int32_t y = box->y; y < box->y + box->height; y++) {
    cs_rough_field(s->page, y, s->paper);
    for (int32_t x = box->x; x < box->x + box->width; x++) {
      float cover = cs_number_clampf(2 * (float)shade_at(s, x, y) / inside - 0.5f, 0, 1);
      sum += (double)cover;
      across += (double)cover * (x + 0.5);
      down += (double)cover * (y + 0.5);
    }
  }
  return sum > 0 ? (celspan_point){across / sum, down / sum}
                 : (celspan_point){box->x + box->width / 2.0, box->y + box->height / 2.0};
}

/* The pixels of a blot, and some around it. */
static celspan_rectangle around(const search *s, const cs_blot *blot, double millimetres) {
  const int32_t side = s->page->side, more = cs_number_ceil(millimetres * s->unit * side);
  int32_t x0 = blot->x0 * side - more, y0 = blot->y0 * side - more;
  int32_t x1 = blot->x1 * side + more, y1 = blot->y1 * side + more;
  x0 = x0 > 0 ? x0 : 0;
  y0 = y0 > 0 ? y0 : 0;
  x1 = x1 < s->page->scan.width ? x1 : s->page->scan.width;
  y1 = y1 < s->page->scan.height ? y1 : s->page->scan.height;
  return (celspan_rectangle){x0, y0, x1 - x0, y1 - y0};
}

/* The middle of a hole, which the page keeps with some rim, in pixels. */
static celspan_point measure(const search *s, const cs_blot *blot, float *row) {
  celspan_rectangle box = around(s, blot, 0.6), rim = around(s, blot, 1.2);
  shading shades = {s->page, row};
  s->page->holes[s->page->hole_count++] = (celspan_box){rim.x, rim.y, rim.width, rim.height};
  return middle_in(&shades, &box);
}

/* ---------------------------------------------------------------- the fit */

/* The turn, scale and place that are nearest to all holes. unit: pixels for a millimetre. */
static void fit(const cs_hole *holes, const celspan_point *at, size_t count, double unit,
                cs_pegs *out) {
  double n = (double)count, x = 0, y = 0, px = 0, py = 0, re = 0, im = 0, square = 0;
  for (size_t i = 0; i < count; i++) {
    x += holes[i].x / n;
    y += holes[i].y / n;
    px += at[i].x / n;
    py += at[i].y / n;
  }
  for (size_t i = 0; i < count; i++) {
    double dx = holes[i].x - x, dy = holes[i].y - y, ex = at[i].x - px, ey = at[i].y - py;
    re += dx * ex + dy * ey;
    im += dx * ey - dy * ex;
    square += dx * dx + dy * dy;
  }
  re /= square;
  im /= square;
  out->scale = cs_number_length(re, im) / unit;
  out->turn = cs_elementary_atan2(im, re);
  out->x = px - x * re + y * im;
  out->y = py - x * im - y * re;
  for (size_t i = 0; i < count; i++)
    out->error =
        larger(out->error, cs_number_length(out->x + holes[i].x * re - holes[i].y * im - at[i].x,
                                            out->y + holes[i].x * im + holes[i].y * re - at[i].y) /
                               unit);
}

static celspan_status measure_all(const search *s, const laying *best, double unit, cs_pegs *out) {
  celspan_point at[CS_ROUGH_HOLES];
  float *row;
  size_t columns = (size_t)s->page->scan.width;
  CS_TRY(CS_MAKE(s->page->context, row, columns));
  for (size_t h = 0; h < s->hole_count; h++)
    at[h] = measure(s, &s->blots[best->of_hole[h]], row);
  cs_mem_free(s->page->context->memory, row, columns * sizeof *row);
  fit(s->holes, at, s->hole_count, unit, out);
  return CELSPAN_OK;
}

celspan_status cs_holes_find(cs_rough *page, double dpi, const cs_hole *holes, size_t count,
                             cs_pegs *out) {
  search s = {.page = page, .holes = holes, .hole_count = count};
  laying best = {.found = 0};
  double unit = dpi / MILLIMETRES;
  s.unit = unit / page->side;
  page->hole_count = 0;
  CS_TRY(find_blots(&s, false));
  CS_TRY(find_blots(&s, true));
  for (size_t a = 0; a < count; a++)
    for (size_t b = a + 1; b < count; b++)
      try_pairs(&s, (const size_t[]){a, b}, &best);
  *out = (cs_pegs){.found = best.found};
  return best.found == (int32_t)count ? measure_all(&s, &best, unit, out) : CELSPAN_OK;
}
