#include "tools/scan/holes.h"

#include <math.h>

#include "inside/elementary.h"
#include "inside/number.h"
#include "inside/sort.h"
#include "tools/trace/regions.h"

/* How far a spot differs from the paper where there may be a hole: darker; brighter at least, where
 * the paper is hardly darker than white. */
#define DARKER 0.2f
#define BRIGHTER 0.02f
#define MILLIMETRES 25.4
/* The greatest sine of the turn; how far from 1 the scale of a scan with the right `dpi` may be. */
#define MOST_TURN 0.27
#define MOST_SCALE 0.03
/* How far from the wanted one the area of a hole may be, and the deviation of the grain around it,
 * as shares. */
#define MOST_OFF 0.25
#define MOST_GRAIN 0.26
enum { BLOTS = 64 }; /* half of them dark, half of them bright */

/* The blots that may be holes, and what is wanted. */
typedef struct search {
  cs_rough *page;
  cs_region blots[BLOTS];
  size_t count;
  const cs_hole *holes;
  size_t hole_count;
  double unit; /* pixels for a millimetre */
} search;

/* A way to lay the holes on the page: x + y i of a hole, times (re + im i), plus (x, y). In
 * pixels. */
typedef struct laying {
  double re, im, x, y;
  int32_t found, rank;
  size_t of_hole[CS_ROUGH_HOLES]; /* the blot of each hole; BLOTS: none */
} laying;

/* ---------------------------------------------------------------- candidates */

/* The mean of the spots around one, because a bright hole differs from the paper hardly more than
 * its grain. Its rim is a shadow. */
static float mean_at(const cs_rough *page, int32_t x, int32_t y, int32_t radius) {
  float sum = 0;
  if (x < radius || y < radius || x + radius >= page->width || y + radius >= page->height)
    return 1;
  for (int32_t v = y - radius; v <= y + radius; v++)
    for (int32_t u = x - radius; u <= x + radius; u++)
      sum += page->spots[(size_t)v * (size_t)page->width + (size_t)u];
  return sum / (float)((2 * radius + 1) * (2 * radius + 1));
}

static void mark(const cs_rough *page, bool is_bright, uint8_t *plane) {
  float white = 0.3f * (1 / page->code[1] - 1);
  float least = white > BRIGHTER ? white : BRIGHTER;
  for (int32_t y = 0; y < page->height; y++)
    for (int32_t x = 0; x < page->width; x++)
      *plane++ =
          is_bright ? mean_at(page, x, y, 2) > 1 + least : mean_at(page, x, y, 1) < 1 - DARKER;
}

static inline bool is_larger(const cs_region *a, const cs_region *b) {
  return a->area != b->area ? a->area > b->area : a->y0 != b->y0 ? a->y0 < b->y0 : a->x0 < b->x0;
}
CS_SORT_DEFINE(sort_blots, cs_region, is_larger)

/* Adds the largest of the compact blots. */
static void choose(search *s, cs_regions *blots) {
  size_t most = s->count + BLOTS / 2;
  sort_blots(blots->list, blots->count);
  for (size_t i = 0; i < blots->count && s->count < most; i++) {
    const cs_region *blot = &blots->list[i];
    int32_t wide = blot->x1 - blot->x0, high = blot->y1 - blot->y0;
    bool is_compact = 2 * blot->area > (uint32_t)wide * (uint32_t)high;
    if (blot->label && blot->area >= 8 && is_compact && wide < s->page->width / 4 &&
        high < s->page->height / 4)
      s->blots[s->count++] = *blot;
  }
}

static celspan_status find_blots(search *s, bool is_bright) {
  const cs_rough *page = s->page;
  size_t count = (size_t)page->width * (size_t)page->height;
  uint8_t *plane;
  cs_regions blots;
  CS_TRY(CS_MAKE(page->context, plane, count));
  mark(page, is_bright, plane);
  const cs_region_source source =
      cs_region_source_mask(plane, page->width, page->height, CS_CORNERS_JOIN);
  celspan_status status = cs_regions_make(page->context, &source, &blots);
  cs_mem_free(page->context->memory, plane, count);
  CS_TRY(status);
  choose(s, &blots);
  cs_regions_finish(&blots, page->context);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- laying the holes */

static celspan_point laid(const laying *l, const cs_hole *hole) {
  return (celspan_point){l->x + hole->x * l->re - hole->y * l->im,
                         l->y + hole->x * l->im + hole->y * l->re};
}

/* The size of the box around a hole that is laid so. */
static celspan_point extent(const laying *l, const cs_hole *hole) {
  double re = fabs(l->re), im = fabs(l->im);
  return (celspan_point){hole->width * re + hole->height * im,
                         hole->width * im + hole->height * re};
}

/* The turn, scale and place that bring holes nearest to where they are. */
static void fit(const cs_hole *holes, const celspan_point *at, size_t count, laying *out) {
  double x = 0, y = 0, px = 0, py = 0, re = 0, im = 0, square = 0;
  for (size_t i = 0; i < count; i++) {
    x += holes[i].x / (double)count;
    y += holes[i].y / (double)count;
    px += at[i].x / (double)count;
    py += at[i].y / (double)count;
  }
  for (size_t i = 0; i < count; i++) {
    double dx = holes[i].x - x, dy = holes[i].y - y;
    re += dx * (at[i].x - px) + dy * (at[i].y - py);
    im += dx * (at[i].y - py) - dy * (at[i].x - px);
    square += dx * dx + dy * dy;
  }
  out->re = re / square;
  out->im = im / square;
  out->x = px - x * out->re + y * out->im;
  out->y = py - x * out->im - y * out->re;
}

static celspan_point middle_of(const search *s, size_t blot) {
  const cs_region *b = &s->blots[blot];
  const double half = s->page->side / 2.0;
  return (celspan_point){(b->x0 + b->x1) * half, (b->y0 + b->y1) * half};
}

static bool is_near(double a, double b, double room) {
  return fabs(a - b) <= cs_number_most(0.2 * b, room);
}

/* Whether a blot has the size that a hole has when it is laid so. */
static bool is_of_size(const search *s, const laying *l, size_t blot, const cs_hole *hole) {
  const cs_region *b = &s->blots[blot];
  const double side = s->page->side, room = 4 * side, covered = b->area * side * side;
  celspan_point size = extent(l, hole);
  double area = (l->re * l->re + l->im * l->im) * hole->width * hole->height;
  return is_near((b->x1 - b->x0) * side, size.x, room) &&
         is_near((b->y1 - b->y0) * side, size.y, room) && covered > 0.55 * area &&
         covered < 1.3 * area + room * (size.x + size.y);
}

/* Finds the blot of each hole, and how good the laying is: best are all holes at the right scale,
 * then all at another one, then some at the right one. */
static void count_holes(const search *s, laying *l) {
  l->found = 0;
  for (size_t h = 0; h < s->hole_count; h++) {
    celspan_point at = laid(l, &s->holes[h]);
    double best = cs_number_most(l->re, 2 * s->page->side);
    l->of_hole[h] = BLOTS;
    for (size_t i = 0; i < s->count; i++) {
      celspan_point middle = middle_of(s, i);
      double distance = cs_number_length(middle.x - at.x, middle.y - at.y);
      if (distance >= best || !is_of_size(s, l, i, &s->holes[h]))
        continue;
      best = distance;
      l->of_hole[h] = i;
    }
    l->found += l->of_hole[h] < BLOTS;
  }
  bool is_right = fabs(cs_number_length(l->re, l->im) / s->unit - 1) <= MOST_SCALE;
  bool is_whole = l->found == (int32_t)s->hole_count;
  l->rank = l->found + (is_right ? CS_ROUGH_HOLES : 0) + (is_whole ? 2 * CS_ROUGH_HOLES : 0);
  if (l->found < 2 || (!is_right && !is_whole))
    l->rank = 0;
}

/* Lays two holes on two blots, if such a turn and scale are possible. */
static void try_pair(const search *s, const size_t hole[2], const size_t blot[2], laying *best) {
  const cs_hole holes[2] = {s->holes[hole[0]], s->holes[hole[1]]};
  const celspan_point at[2] = {middle_of(s, blot[0]), middle_of(s, blot[1])};
  laying l;
  fit(holes, at, 2, &l);
  if (!(l.re > s->unit / 8 && l.re < s->unit * 8 && fabs(l.im) <= MOST_TURN * l.re) ||
      !is_of_size(s, &l, blot[0], &holes[0]) || !is_of_size(s, &l, blot[1], &holes[1]))
    return;
  count_holes(s, &l);
  if (l.rank > best->rank)
    *best = l;
}

/* ---------------------------------------------------------------- the middle of a hole */

/* The pixels around a hole that is laid so, as far from the border as the squares of `away`
 * need. */
static celspan_rectangle around(const search *s, const laying *l, const cs_hole *hole,
                                double millimetres) {
  const cs_scan *scan = &s->page->scan;
  celspan_point at = laid(l, hole), size = extent(l, hole);
  double x = size.x / 2 + millimetres * s->unit, y = size.y / 2 + millimetres * s->unit;
  double side = s->page->side, right = scan->width - side, bottom = scan->height - side;
  int32_t x0 = (int32_t)cs_number_clamp(at.x - x, side, right);
  int32_t y0 = (int32_t)cs_number_clamp(at.y - y, side, bottom);
  return (celspan_rectangle){x0, y0, (int32_t)cs_number_clamp(at.x + x, side, right) - x0,
                             (int32_t)cs_number_clamp(at.y + y, side, bottom) - y0};
}

/* How far a pixel differs from the paper, which is the way of the hole: the mean of a square, in
 * which grain is little and the middle of a hole stays where it is. */
static double away_at(const cs_rough *page, const float *field, int32_t x, int32_t y) {
  const int32_t side = page->side;
  float sum = 0;
  for (int32_t v = y - side; v <= y + side; v++)
    for (int32_t u = x - side; u <= x + side; u++)
      sum += cs_rough_brightness(cs_scan_at(&page->scan, u, v));
  return (double)(sum / ((float)((2 * side + 1) * (2 * side + 1)) * field[x]) - 1);
}

/* What a hole covers: a pixel counts from a quarter of the way between paper and hole on, and fully
 * from three quarters on. */
typedef struct cover {
  double sum, squares;      /* of the way to a hole, bright or dark */
  double area, x, y;        /* what is covered, and the sums of its places */
  double rest, mean, grain; /* the pixels that are not, and the sums of their way and its squares */
} cover;

static void add_way(cover *c, double way) {
  c->sum += way > 0 ? way : 0;
  c->squares += way > 0 ? way * way : 0;
}

static void add_cover(cover *c, double way, double x, double y) {
  double share = cs_number_clamp(2 * fabs(way) - 0.5, 0, 1);
  c->area += share;
  c->x += share * x;
  c->y += share * y;
  c->rest += share < 0.5;
  c->mean += share < 0.5 ? way : 0;
  c->grain += share < 0.5 ? way * way : 0;
}

static cover cover_of(const cs_rough *page, const celspan_rectangle *box, double sign) {
  cover c = {0};
  for (int pass = 0; pass < 2; pass++)
    for (int32_t y = box->y; y < box->y + box->height; y++) {
      const float *field = cs_rough_field(page, y);
      for (int32_t x = box->x; x < box->x + box->width; x++) {
        double way = sign * away_at(page, field, x, y);
        if (pass == 0)
          add_way(&c, way);
        else if (c.sum > 0)
          add_cover(&c, way * c.sum / c.squares, x + 0.5, y + 0.5);
      }
    }
  return c;
}

/* The middle of hole h in pixels; the page keeps the hole with some rim. Returns whether the hole
 * has the area that it should have, and is clearly brighter or darker than the grain around it. */
static bool measure(const search *s, const laying *l, size_t h, celspan_point *out) {
  const cs_hole *hole = &s->holes[h];
  const cs_region *blot = &s->blots[l->of_hole[h]];
  const celspan_rectangle box = around(s, l, hole, 0.8), rim = around(s, l, hole, 1.2);
  float inside = mean_at(s->page, (blot->x0 + blot->x1) / 2, (blot->y0 + blot->y1) / 2, 1);
  const cover c = cover_of(s->page, &box, inside > 1 ? 1 : -1);
  double area = (l->re * l->re + l->im * l->im) * hole->width * hole->height;
  area *= hole->width == hole->height ? 0.7854 : 1;
  s->page->holes[h] = (celspan_box){rim.x, rim.y, rim.width, rim.height};
  if (fabs(c.area / area - 1) > MOST_OFF ||
      c.grain * c.rest - c.mean * c.mean > MOST_GRAIN * MOST_GRAIN * c.rest * c.rest)
    return false;
  *out = (celspan_point){c.x / c.area, c.y / c.area};
  return true;
}

/* Twice, because the pixels around a hole are better known after the first time. */
static void measure_all(const search *s, laying *l, cs_pegs *out) {
  celspan_point at[CS_ROUGH_HOLES];
  for (size_t h = 0; h < s->hole_count; h++)
    at[h] = middle_of(s, l->of_hole[h]);
  for (int pass = 0; pass < 2; pass++) {
    fit(s->holes, at, s->hole_count, l);
    out->found = 0;
    for (size_t h = 0; h < s->hole_count; h++)
      out->found += measure(s, l, h, &at[h]);
  }
  fit(s->holes, at, s->hole_count, l);
  for (size_t h = 0; h < s->hole_count; h++) {
    celspan_point place = laid(l, &s->holes[h]);
    double off = cs_number_length(place.x - at[h].x, place.y - at[h].y) / s->unit;
    out->error = cs_number_most(out->error, off);
  }
}

celspan_status cs_holes_find(cs_rough *page, double dpi, const cs_hole *holes, size_t count,
                             cs_pegs *out) {
  search s = {.page = page, .holes = holes, .hole_count = count, .unit = dpi / MILLIMETRES};
  laying best = {.found = 0};
  page->hole_count = 0;
  CS_TRY(find_blots(&s, false));
  CS_TRY(find_blots(&s, true));
  for (size_t a = 0; a < count; a++)
    for (size_t b = a + 1; b < count; b++)
      for (size_t i = 0; i < s.count; i++)
        for (size_t j = 0; j < s.count; j++)
          if (i != j)
            try_pair(&s, (const size_t[]){a, b}, (const size_t[]){i, j}, &best);
  *out = (cs_pegs){.found = best.found};
  if (best.found < (int32_t)count)
    return CELSPAN_OK;
  measure_all(&s, &best, out);
  page->hole_count = count;
  out->scale = cs_number_length(best.re, best.im) / s.unit;
  out->turn = cs_elementary_atan2(best.im, best.re);
  out->x = best.x;
  out->y = best.y;
  return CELSPAN_OK;
}
