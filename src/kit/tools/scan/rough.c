#include "tools/scan/rough.h"

#include <math.h>
#include <string.h>

#include "inside/context.h"
#include "inside/number.h"
#include "inside/sort.h"

/* SPOTS along the longer side: of A4 a spot is a third of a millimetre. POST: spots of a side. FEW:
 * an edge takes more than one line in this many. */
enum { SPOTS = 900, POST = 8, FILLED = 4, PAD = FILLED, FEW = 40 };
/* Less of the paper's brightness is what lies behind the paper. */
#define BEHIND 0.4f
#define NONE (-1.0f)

static inline bool is_less(const float *a, const float *b) { return *a < *b; }
CS_SORT_DEFINE(sort_floats, float, is_less)

static float sorted_at(float *values, size_t count, double share) {
  sort_floats(values, count);
  return values[(size_t)((double)(count - 1) * share)];
}

/* ---------------------------------------------------------------- spots */

/* What is clear becomes white. */
static void whiten(cs_scan *scan) {
  unsigned char *code = scan->codes;
  for (size_t i = (size_t)scan->width * (size_t)scan->height; i > 0; i--, code += 4)
    for (int c = 0; c < 3; c++)
      code[c] = (unsigned char)(255 - (255 - code[c]) * code[3] / 255);
}

static void fill_row(cs_rough *page, int32_t y) {
  float *spots = page->spots + (size_t)y * (size_t)page->width;
  const int32_t side = page->side;
  for (int32_t x = 0; x < page->width; x++)
    spots[x] = 0;
  for (int32_t row = 0; row < side; row++) {
    const unsigned char *code = cs_scan_at(&page->scan, 0, y * side + row);
    for (int32_t x = 0; x < page->width; x++)
      for (int32_t i = 0; i < side; i++, code += 4)
        spots[x] += cs_rough_brightness(code);
  }
  for (int32_t x = 0; x < page->width; x++)
    spots[x] /= (float)(side * side);
}

/* The medians of the codes in the middles of the spots: most of a scan is paper. */
static void measure_paper(cs_rough *page) {
  const uint32_t half = (uint32_t)page->width * (uint32_t)page->height / 2;
  uint32_t counts[3][256] = {{0}};
  for (int32_t y = 0; y < page->height; y++)
    for (int32_t x = 0; x < page->width; x++) {
      int32_t middle = page->side / 2;
      const unsigned char *code =
          cs_scan_at(&page->scan, x * page->side + middle, y * page->side + middle);
      for (int c = 0; c < 3; c++)
        counts[c][code[c]]++;
    }
  for (int c = 0; c < 3; c++) {
    int code = 0;
    for (uint32_t below = counts[c][0]; below <= half && code < 255; below += counts[c][code])
      code++;
    page->paper[c] = (float)(code > 0 ? code : 1) / 255;
  }
}

static float paper_of(const cs_rough *page) {
  return 0.301f * page->paper[0] + 0.586f * page->paper[1] + 0.113f * page->paper[2];
}

/* ---------------------------------------------------------------- edges */

/* The spot `in` spots from a side of the picture, in line i along it. */
static float spot_from(const cs_rough *page, int side, int32_t i, int32_t in) {
  bool is_column = side % 2 == 0;
  int32_t x = is_column ? in : i, y = is_column ? i : in;
  if (side == 2)
    x = page->width - 1 - in;
  if (side == 3)
    y = page->height - 1 - in;
  return page->spots[(size_t)y * (size_t)page->width + (size_t)x];
}

/* How many spots from a side the paper begins in line i; 0: at the side, or not in a quarter. */
static float paper_from(const cs_rough *page, int side, int32_t i) {
  int32_t most = (side % 2 == 0 ? page->width : page->height) / 4;
  float limit = BEHIND * paper_of(page), before = 0;
  for (int32_t in = 0; in <= most; in++) {
    float here = spot_from(page, side, i, in);
    if (here >= limit)
      return in == 0 ? 0 : (float)in + 0.5f - (here - limit) / (here - before);
    before = here;
  }
  return 0;
}

/* Where the paper begins along a side: `count` places, each in the middle of a line. */
typedef struct places {
  size_t count;
  float *lines, *at, *rest; /* rest: as much room */
} places;

/* The line through most of the places, by medians, so that what is drawn across the edge and the
 * ends of the other edges do not count. Returns whether the places agree on it. In spots. */
static bool fit_edge(const places *p, double line[2]) {
  size_t half = p->count / 2;
  for (size_t i = 0; i < half; i++)
    p->rest[i] = (p->at[i + half] - p->at[i]) / (p->lines[i + half] - p->lines[i]);
  line[1] = (double)sorted_at(p->rest, half, 0.5);
  for (size_t i = 0; i < p->count; i++)
    p->rest[i] = p->at[i] - (float)line[1] * p->lines[i];
  double middle = (double)sorted_at(p->rest, p->count, 0.5), sum = 0;
  size_t near = 0;
  for (size_t i = 0; i < p->count; i++)
    if (fabs((double)p->rest[i] - middle) <= 1) {
      sum += (double)p->rest[i];
      near++;
    }
  line[0] = sum / (double)near;
  return 2 * near > p->count;
}

/* Where only a few lines begin later than at the side, they are drawn there. */
static void find_edge(cs_rough *page, int side, places *p) {
  int32_t count = side % 2 == 0 ? page->height : page->width;
  double line[2];
  p->count = 0;
  for (int32_t i = 0; i < count; i++) {
    float at = paper_from(page, side, i);
    p->lines[p->count] = (float)i + 0.5f;
    p->at[p->count] = at;
    p->count += at > 0;
  }
  page->has_edge[side] = (int32_t)p->count > count / FEW && fit_edge(p, line);
  page->edges[side][0] = page->has_edge[side] ? line[0] * page->side : 0;
  page->edges[side][1] = page->has_edge[side] ? line[1] : 0;
}

static celspan_status find_edges(cs_rough *page) {
  size_t room = (size_t)(page->width > page->height ? page->width : page->height);
  float *numbers;
  CS_TRY(CS_MAKE(page->context, numbers, 3 * room));
  places p = {0, numbers, numbers + room, numbers + 2 * room};
  for (int side = 0; side < 4; side++)
    find_edge(page, side, &p);
  cs_mem_free(page->context->memory, numbers, 3 * room * sizeof *numbers);
  return CELSPAN_OK;
}

/* Cuts first .. end where slope * x <= rest does not hold. */
static void cut(double slope, double rest, double *first, double *end) {
  if (slope > 0 && rest / slope < *end)
    *end = rest / slope;
  if (slope < 0 && rest / slope > *first)
    *first = rest / slope;
  if (slope == 0 && rest < 0)
    *end = *first;
}

void cs_rough_row(const cs_rough *page, int32_t y, double margin, int32_t *first, int32_t *end) {
  const double width = page->scan.width, middle = y + 0.5;
  double at[4];
  for (int side = 0; side < 4; side++)
    at[side] = page->edges[side][0] + (page->has_edge[side] ? margin : 0);
  double from = at[0] + page->edges[0][1] * middle;
  double to = width - at[2] - page->edges[2][1] * middle;
  cut(page->edges[1][1], middle - at[1], &from, &to);
  cut(page->edges[3][1], page->scan.height - middle - at[3], &from, &to);
  *first = cs_number_first_centre(cs_number_clamp(from, 0, width));
  *end = cs_number_first_centre(cs_number_clamp(to, 0, width));
}

/* ---------------------------------------------------------------- field */

/* The greatest, or the least, of the known numbers around each one, along one direction. */
static void spread(const float *from, size_t count, ptrdiff_t step, bool is_most, float *to) {
  for (ptrdiff_t i = 0; i < (ptrdiff_t)count; i++) {
    float best = NONE;
    ptrdiff_t first = i < FILLED ? 0 : i - FILLED;
    for (ptrdiff_t j = first; j <= i + FILLED && j < (ptrdiff_t)count; j++) {
      float value = from[j * step];
      if (value >= 0 && (best < 0 || (is_most ? value > best : value < best)))
        best = value;
    }
    to[i * step] = best;
  }
}

/* A padded grid. */
typedef struct grid {
  size_t width, height;
  float *values, *rest;
} grid;

static void spread_both(const grid *g, bool is_most) {
  for (size_t y = 0; y < g->height; y++)
    spread(g->values + y * g->width, g->width, 1, is_most, g->rest + y * g->width);
  for (size_t x = 0; x < g->width; x++)
    spread(g->rest + x, g->height, (ptrdiff_t)g->width, is_most, g->values + x);
}

static bool is_pad(const grid *g, size_t i) {
  size_t x = i % g->width, y = i / g->width;
  return x < PAD || y < PAD || x >= g->width - PAD || y >= g->height - PAD;
}

/* Fills what is darker than its surroundings, or brighter. The pads keep a slope at the border as
 * it is. */
static void fill_narrow(const grid *g, bool is_dark) {
  for (size_t i = 0; i < g->width * g->height; i++)
    if (is_pad(g, i))
      g->values[i] = NONE;
  spread_both(g, is_dark);
  spread_both(g, !is_dark);
}

/* The paper in the spots of a post: brighter than most of them. */
static float post_of(const cs_rough *page, int32_t column, int32_t row) {
  float values[POST * POST];
  size_t count = 0;
  for (int32_t y = row * POST; y < (row + 1) * POST && y < page->height; y++) {
    int32_t first, end;
    cs_rough_row(page, y * page->side + page->side / 2, 2 * page->side, &first, &end);
    for (int32_t x = column * POST; x < (column + 1) * POST && x < page->width; x++)
      if (x * page->side >= first && (x + 1) * page->side <= end)
        values[count++] = page->spots[(size_t)y * (size_t)page->width + (size_t)x];
  }
  return count >= POST ? sorted_at(values, count, 0.6) : NONE;
}

static void fill_field(cs_rough *page, const grid *g) {
  for (size_t i = 0; i < g->width * g->height; i++)
    g->values[i] =
        is_pad(g, i) ? NONE
                     : post_of(page, (int32_t)(i % g->width) - PAD, (int32_t)(i / g->width) - PAD);
  fill_narrow(g, true);
  fill_narrow(g, false);
  for (int32_t y = 0; y < page->down; y++)
    for (int32_t x = 0; x < page->across; x++) {
      float value = g->values[(size_t)(y + PAD) * g->width + (size_t)(x + PAD)];
      page->field[(size_t)y * (size_t)page->across + (size_t)x] =
          value > 0.05f ? value : paper_of(page);
    }
}

static celspan_status make_field(cs_rough *page) {
  page->across = (page->width + POST - 1) / POST;
  page->down = (page->height + POST - 1) / POST;
  CS_TRY(CS_MAKE(page->context, page->field, (size_t)page->across * (size_t)page->down));
  grid g = {(size_t)page->across + 2 * PAD, (size_t)page->down + 2 * PAD, NULL, NULL};
  size_t count = g.width * g.height;
  CS_TRY(CS_MAKE(page->context, g.values, 2 * count));
  g.rest = g.values + count;
  fill_field(page, &g);
  cs_mem_free(page->context->memory, g.values, 2 * count * sizeof *g.values);
  return CELSPAN_OK;
}

/* The posts before and after a pixel, and the share of the later one. */
static float between(int32_t at, int32_t side, int32_t count, int32_t *before, int32_t *after) {
  float place = ((float)at + 0.5f) / (float)(side * POST) - 0.5f;
  *before = place > 0 ? (int32_t)place : 0;
  *after = *before + 1 < count ? *before + 1 : count - 1;
  *before = *before < count ? *before : count - 1;
  return cs_number_clampf(place - (float)*before, 0, 1);
}

void cs_rough_field(const cs_rough *page, int32_t y, float *row) {
  int32_t above, below, left, right;
  float v = between(y, page->side, page->down, &above, &below);
  const float *upper = page->field + (size_t)above * (size_t)page->across;
  const float *lower = page->field + (size_t)below * (size_t)page->across;
  for (int32_t x = 0; x < page->scan.width; x++) {
    float u = between(x, page->side, page->across, &left, &right);
    float a = upper[left] + v * (lower[left] - upper[left]);
    float b = upper[right] + v * (lower[right] - upper[right]);
    row[x] = a + u * (b - a);
  }
}

/* ---------------------------------------------------------------- a page */

static celspan_status fill(cs_rough *page, const cs_picture *picture) {
  CS_TRY(cs_scan_read(page->context, picture, &page->scan));
  if (page->scan.has_clear)
    whiten(&page->scan);
  int32_t wide = page->scan.width, high = page->scan.height, longer = wide > high ? wide : high;
  int32_t shorter = wide < high ? wide : high;
  page->side = longer < SPOTS ? 1 : (longer + SPOTS / 2) / SPOTS;
  if (shorter / page->side < 2 * POST)
    return cs_fail(page->context, CELSPAN_BAD_ARGUMENT,
                   "%s: %d x %d pixels are too few for a scanned drawing", cs_picture_name(picture),
                   wide, high);
  page->width = wide / page->side;
  page->height = high / page->side;
  CS_TRY(CS_MAKE(page->context, page->spots, (size_t)page->width * (size_t)page->height));
  for (int32_t y = 0; y < page->height; y++)
    fill_row(page, y);
  measure_paper(page);
  CS_TRY(find_edges(page));
  return make_field(page);
}

celspan_status cs_rough_create(celspan_context *context, const cs_picture *picture,
                               cs_rough **out) {
  cs_rough *page;
  CS_TRY(CS_MAKE(context, page, 1));
  page->context = context;
  celspan_status status = fill(page, picture);
  return CS_GIVE(status, page, cs_rough_destroy, out);
}

void cs_rough_destroy(cs_rough *page) {
  if (!page)
    return;
  cs_memory *memory = page->context->memory;
  if (page->scan.codes)
    cs_scan_finish(&page->scan, page->context);
  cs_mem_free(memory, page->spots,
              (size_t)page->width * (size_t)page->height * sizeof *page->spots);
  cs_mem_free(memory, page->field, (size_t)page->across * (size_t)page->down * sizeof *page->field);
  cs_mem_free(memory, page, sizeof *page);
}
