#include "tools/scan/rough.h"

#include <math.h>

#include "inside/context.h"
#include "inside/elementary.h"
#include "inside/number.h"
#include "inside/sort.h"

/* About SPOTS along the longer side, fewer than LINES: of A4 a spot is a third of a millimetre.
 * POST: spots of a side. FEW: an edge takes more than one line in this many. */
enum { SPOTS = 900, LINES = 2 * SPOTS, POST = 8, PAD = CS_ROUGH_PAD, FEW = 40 };
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
  const float share = 1.0f / (float)(side * side);
  for (int32_t row = 0; row < side; row++) {
    const unsigned char *code = cs_scan_at(&page->scan, 0, y * side + row);
    for (int32_t x = 0; x < page->width; x++)
      for (int32_t i = 0; i < side; i++, code += 4)
        spots[x] += cs_rough_brightness(code) * share;
  }
}

/* The medians of the codes in the middles of the spots: most of a scan is paper. */
static void measure_paper(cs_rough *page) {
  const uint32_t half = (uint32_t)page->width * (uint32_t)page->height / 2;
  const int32_t side = page->side;
  uint32_t counts[3][256] = {{0}};
  for (int32_t y = 0; y < page->height; y++)
    for (int32_t x = 0; x < page->width; x++)
      for (int c = 0; c < 3; c++)
        counts[c][cs_scan_at(&page->scan, x * side + side / 2, y * side + side / 2)[c]]++;
  for (int c = 0; c < 3; c++) {
    int code = 0;
    for (uint32_t below = counts[c][0]; below <= half && code < 255; below += counts[c][code])
      code++;
    page->code[c] = (float)(code > 0 ? code : 1) / 255;
  }
  page->paper = 0.301f * page->code[0] + 0.586f * page->code[1] + 0.113f * page->code[2];
}

/* ---------------------------------------------------------------- edges */

/* How many spots from a side the paper begins in line i; 0: at the side, or not in a quarter. */
static float paper_from(const cs_rough *page, int side, int32_t i) {
  const ptrdiff_t wide = page->width, high = page->height;
  ptrdiff_t step = side % 2 == 0 ? 1 : wide, along = side % 2 == 0 ? wide : 1;
  const float *spot = page->spots + i * along;
  float limit = BEHIND * page->paper, before = 0;
  if (side >= 2) {
    spot += step * ((side == 2 ? wide : high) - 1);
    step = -step;
  }
  for (int32_t in = 0; in <= (side % 2 == 0 ? wide : high) / 4; in++, spot += step) {
    if (*spot >= limit)
      return in == 0 ? 0 : (float)in + 0.5f - (*spot - limit) / (*spot - before);
    before = *spot;
  }
  return 0;
}

/* Where the paper begins: `count` places, each in the middle of a line. rest: as much room. */
typedef struct places {
  size_t count;
  float lines[LINES], at[LINES], rest[LINES];
} places;

/* The line through most of the places, by medians, so that what is drawn across the edge and the
 * ends of the other edges do not count. Returns whether the places agree on it. In spots. */
static bool fit_edge(places *p, double line[2]) {
  size_t half = p->count / 2, near = 0;
  for (size_t i = 0; i < half; i++)
    p->rest[i] = (p->at[i + half] - p->at[i]) / (p->lines[i + half] - p->lines[i]);
  line[1] = (double)sorted_at(p->rest, half, 0.5);
  for (size_t i = 0; i < p->count; i++)
    p->rest[i] = p->at[i] - (float)line[1] * p->lines[i];
  double middle = (double)sorted_at(p->rest, p->count, 0.5), sum = 0;
  for (size_t i = 0; i < p->count; i++)
    if (fabs((double)p->rest[i] - middle) <= 1) {
      sum += (double)p->rest[i];
      near++;
    }
  line[0] = sum / (double)near;
  return 2 * near > p->count;
}

/* Where only a few lines begin later than at the side, they are drawn there. */
static void find_edge(cs_rough *page, int side) {
  int32_t lines = side % 2 == 0 ? page->height : page->width;
  places p = {0};
  for (int32_t i = 0; i < lines; i++) {
    p.at[p.count] = paper_from(page, side, i);
    p.lines[p.count] = (float)i + 0.5f;
    p.count += p.at[p.count] > 0;
  }
  double *edge = page->edges[side];
  page->has_edge[side] = (int32_t)p.count > lines / FEW && p.count > 1 && fit_edge(&p, edge);
  edge[0] = page->has_edge[side] ? edge[0] * page->side : 0;
  edge[1] = page->has_edge[side] ? edge[1] : 0;
}

/* The middle is where the lines between opposite sides meet. */
bool cs_rough_paper(const cs_rough *page, cs_rough_place *out) {
  const double(*edges)[2] = page->edges;
  double x = (edges[0][0] + page->scan.width - edges[2][0]) / 2;
  double y = (edges[1][0] + page->scan.height - edges[3][0]) / 2;
  double right = (edges[0][1] - edges[2][1]) / 2, down = (edges[1][1] - edges[3][1]) / 2;
  double slope = (down - right) / 2;
  *out = (cs_rough_place){.turn = cs_elementary_atan2(slope, 1)};
  out->x = (x + right * y) / (1 - right * down);
  out->y = y + down * out->x;
  for (int side = 0; side < 4; side++) {
    double own = side == 0 || side == 3 ? -edges[side][1] : edges[side][1];
    out->error = cs_number_most(out->error, fabs(own - slope));
  }
  return page->has_edge[0] && page->has_edge[1] && page->has_edge[2] && page->has_edge[3];
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
    at[side] = page->edges[side][0] + (page->has_edge[side] ? margin * page->side : 0);
  double from = at[0] + page->edges[0][1] * middle;
  double to = width - at[2] - page->edges[2][1] * middle;
  cut(page->edges[1][1], middle - at[1], &from, &to);
  cut(page->edges[3][1], page->scan.height - middle - at[3], &from, &to);
  *first = cs_number_first_centre(cs_number_clamp(from, 0, width));
  *end = cs_number_first_centre(cs_number_clamp(to, 0, width));
}

/* The same for spots, which lie wholly on the paper. */
static void spots_of(const cs_rough *page, int32_t y, int32_t *first, int32_t *end) {
  cs_rough_row(page, y * page->side + page->side / 2, 2, first, end);
  *first = (*first + page->side - 1) / page->side;
  *end = *end / page->side < page->width ? *end / page->side : page->width;
}

/* ---------------------------------------------------------------- field */

/* The greatest, or the least, of the known numbers around each one, along one direction. */
static void spread(const float *from, ptrdiff_t count, ptrdiff_t step, bool is_most, float *to) {
  for (ptrdiff_t i = 0; i < count; i++) {
    float best = NONE;
    for (ptrdiff_t j = i < PAD ? 0 : i - PAD; j <= i + PAD && j < count; j++) {
      float value = from[j * step];
      if (value >= 0 && (best < 0 || (is_most ? value > best : value < best)))
        best = value;
    }
    to[i * step] = best;
  }
}

/* Fills what is narrow and darker than its surroundings, or brighter. The pads keep a slope at the
 * border as it is. rest: as much room as the field has. */
static void fill_narrow(cs_rough *page, bool is_dark, float *rest) {
  ptrdiff_t across = page->across, down = page->down;
  for (ptrdiff_t y = 0; y < down; y++)
    for (ptrdiff_t x = 0; x < across; x++)
      if (x < PAD || y < PAD || x >= across - PAD || y >= down - PAD)
        page->field[y * across + x] = NONE;
  for (int pass = 0; pass < 2; pass++) {
    for (ptrdiff_t y = 0; y < down; y++)
      spread(page->field + y * across, across, 1, is_dark == (pass == 0), rest + y * across);
    for (ptrdiff_t x = 0; x < across; x++)
      spread(rest + x, down, across, is_dark == (pass == 0), page->field + x);
  }
}

/* The paper in the spots of a post: brighter than most of them. */
static float post_of(const cs_rough *page, int32_t column, int32_t row) {
  float values[POST * POST];
  size_t count = 0;
  for (int32_t y = row * POST; y < (row + 1) * POST && y < page->height; y++) {
    int32_t first, end;
    spots_of(page, y, &first, &end);
    first = first > column * POST ? first : column * POST;
    end = end < (column + 1) * POST ? end : (column + 1) * POST;
    for (int32_t x = first; x < end; x++)
      values[count++] = page->spots[(size_t)y * (size_t)page->width + (size_t)x];
  }
  return count >= POST ? sorted_at(values, count, 0.6) : NONE;
}

static celspan_status make_field(cs_rough *page) {
  page->across = (page->width + POST - 1) / POST + 2 * PAD;
  page->down = (page->height + POST - 1) / POST + 2 * PAD;
  size_t count = (size_t)page->across * (size_t)page->down;
  float *rest, *post;
  CS_TRY(CS_MAKE(page->context, page->field, count));
  CS_TRY(CS_MAKE(page->context, rest, count));
  post = page->field;
  for (int32_t y = -PAD; y < page->down - PAD; y++)
    for (int32_t x = -PAD; x < page->across - PAD; x++)
      *post++ = x < 0 || y < 0 ? NONE : post_of(page, x, y);
  fill_narrow(page, true, rest);
  fill_narrow(page, false, rest);
  for (size_t i = 0; i < count; i++)
    page->field[i] = page->field[i] > 0.05f ? page->field[i] : page->paper;
  cs_mem_free(page->context->memory, rest, count * sizeof *rest);
  return CELSPAN_OK;
}

/* The field at the height of row y, at post `at` of the page, its pads included. */
static float post_at(const cs_rough *page, int32_t y, int32_t at) {
  float place = ((float)y + 0.5f) / (float)(page->side * POST) - 0.5f + PAD;
  const float *upper = page->field + (ptrdiff_t)place * page->across + at;
  return upper[0] + (place - (float)(int32_t)place) * (upper[page->across] - upper[0]);
}

const float *cs_rough_field(const cs_rough *page, int32_t y) {
  const int32_t post = page->side * POST;
  const float step = 1.0f / (float)post;
  for (int32_t at = PAD - 1, x = -(post / 2); x < page->scan.width; at++, x += post) {
    float before = post_at(page, y, at), slope = (post_at(page, y, at + 1) - before) * step;
    int32_t first = x > 0 ? x : 0;
    int32_t end = x + post < page->scan.width ? x + post : page->scan.width;
    for (int32_t i = first; i < end; i++)
      page->row[i] = before + slope * ((float)(i - x) + 0.5f);
  }
  return page->row;
}

/* ---------------------------------------------------------------- a page */

static void share_spots(cs_rough *page) {
  for (int32_t y = 0; y < page->height; y++) {
    float *spots = page->spots + (size_t)y * (size_t)page->width;
    const float *field = cs_rough_field(page, y * page->side + page->side / 2);
    int32_t first, end;
    spots_of(page, y, &first, &end);
    for (int32_t x = 0; x < page->width; x++)
      spots[x] = x >= first && x < end ? spots[x] / field[x * page->side + page->side / 2] : 1;
  }
}

static celspan_status fill(cs_rough *page, const cs_picture *picture) {
  CS_TRY(cs_scan_read(page->context, picture, &page->scan));
  if (page->scan.has_clear)
    whiten(&page->scan);
  int32_t wide = page->scan.width, high = page->scan.height, longer = wide > high ? wide : high;
  page->side = longer < SPOTS ? 1 : (longer + SPOTS / 2) / SPOTS;
  page->width = wide / page->side;
  page->height = high / page->side;
  if (page->width < 2 * POST || page->height < 2 * POST)
    return cs_fail(page->context, CELSPAN_BAD_ARGUMENT,
                   "%s: %d x %d pixels are too few for a scanned drawing", cs_picture_name(picture),
                   wide, high);
  CS_TRY(CS_MAKE(page->context, page->spots, (size_t)page->width * (size_t)page->height));
  CS_TRY(CS_MAKE(page->context, page->row, (size_t)wide));
  for (int32_t y = 0; y < page->height; y++)
    fill_row(page, y);
  measure_paper(page);
  for (int side = 0; side < 4; side++)
    find_edge(page, side);
  CS_TRY(make_field(page));
  share_spots(page);
  return CELSPAN_OK;
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
  cs_mem_free(memory, page->row, (size_t)page->scan.width * sizeof *page->row);
  cs_mem_free(memory, page, sizeof *page);
}
