#include "tools/scan/inks.h"

#include <math.h>
#include <string.h>

#include "inside/context.h"
#include "inside/number.h"
#include "tools/scan/blots.h"

/* SHADES of brightness; FULL: of the paper. */
enum { SHADES = 512, FULL = 400, HALF = 128 };
/* Of an edge of the paper, in spots: what is not drawn on. */
#define RIM 3
/* How much more a hue counts than a darkness. */
#define HUE 2.0f
/* The share of the pixels of an ink that are darker than its full colour. */
#define FULL_SHARE 0.2
#define LEAST_FULL 24

typedef struct making {
  const cs_rough *page;
  const cs_inks_desc *desc;
  float middle, white; /* of the shares of the field: the paper's, and where ink begins */
  float *field;        /* of a row */
  uint8_t *dark;       /* the page: 0 paper .. 255 */
  uint8_t *ink;        /* the page: the number of the ink; NULL: there is one */
  cs_inks *out;
} making;

static size_t size_of(const cs_rough *page) {
  return (size_t)page->scan.width * (size_t)page->scan.height;
}

static float paper_at(const making *m) {
  return 0.301f * m->page->paper[0] + 0.586f * m->page->paper[1] + 0.113f * m->page->paper[2];
}

/* ---------------------------------------------------------------- black and white */

static void count_row(const making *m, int32_t y, uint32_t counts[SHADES]) {
  int32_t first, end;
  const unsigned char *code = cs_scan_at(&m->page->scan, 0, y);
  cs_rough_row(m->page, y, RIM * m->page->side, &first, &end);
  cs_rough_field(m->page, y, m->field);
  for (int32_t x = first; x < end; x++) {
    float share = cs_rough_brightness(code + 4 * (size_t)x) / m->field[x];
    counts[share < (float)SHADES / FULL ? (int)(share * FULL) : SHADES - 1]++;
  }
}

/* The shade below which a share of the pixels under `end` lie. */
static float shade_at(const uint32_t counts[SHADES], int end, double share) {
  uint64_t total = 0, below = 0;
  for (int i = 0; i < end; i++)
    total += counts[i];
  int shade = 0;
  while (shade < end - 1 && (double)(below += counts[shade]) < (double)total * share)
    shade++;
  return ((float)shade + 0.5f) / FULL;
}

/* White is what the paper's grain does not go below: five times its deviation, which a quarter of
 * the pixels lie two thirds of from the middle. */
static void find_tones(making *m) {
  uint32_t counts[SHADES] = {0};
  for (int32_t y = 0; y < m->page->scan.height; y += 2)
    count_row(m, y, counts);
  m->middle = shade_at(counts, SHADES, 0.5);
  float grain = 5 * (m->middle - shade_at(counts, SHADES, 0.25)) / 0.674f;
  m->white = m->middle - cs_number_clampf(grain, 0.05f, 0.5f);
  m->out->black = (double)shade_at(counts, (int)(m->white * FULL), FULL_SHARE);
  m->out->white = (double)m->white;
  if (!m->desc->has_tones)
    return;
  m->white = (float)(m->out->white = m->desc->white);
  m->middle = m->middle > m->white ? m->middle : m->white;
  m->out->black = m->desc->black;
}

/* ---------------------------------------------------------------- darkness */

/* In a shadow the grain is as large as before it was divided out, times the same. */
static void darken_row(const making *m, int32_t y, uint8_t *dark) {
  int32_t first, end;
  float foot = (m->middle - m->white) * paper_at(m);
  const unsigned char *code = cs_scan_at(&m->page->scan, 0, y);
  cs_rough_row(m->page, y, RIM * m->page->side, &first, &end);
  cs_rough_field(m->page, y, m->field);
  for (int32_t x = first; x < end; x++) {
    float white = m->middle * m->field[x] - foot;
    float share = cs_rough_brightness(code + 4 * (size_t)x);
    if (share < white)
      dark[x] = (uint8_t)((1 - share / white) * 254.5f + 0.5f);
  }
}

static void clear_holes(const making *m) {
  for (size_t i = 0; i < m->page->hole_count; i++) {
    const celspan_box *box = &m->page->holes[i];
    for (int32_t y = 0; y < (int32_t)box->height; y++)
      memset(m->dark + ((size_t)box->y + (size_t)y) * (size_t)m->page->scan.width + (size_t)box->x,
             0, (size_t)box->width);
  }
}

static celspan_status drop_dust(const making *m) {
  const cs_scan *scan = &m->page->scan;
  cs_blots blots;
  if (m->desc->dust == 0)
    return CELSPAN_OK;
  CS_TRY(cs_blots_find(m->page->context, m->dark, scan->width, scan->height, &blots));
  for (size_t i = 0; i < blots.run_count; i++) {
    const cs_blot_run *run = &blots.runs[i];
    if (blots.list[run->blot].area <= m->desc->dust)
      memset(m->dark + (size_t)run->y * (size_t)scan->width + (size_t)run->x0, 0,
             (size_t)(run->x1 - run->x0));
  }
  cs_blots_finish(&blots, m->page->context);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- inks apart */

/* From the colour of the paper to another one. */
static cs_oklab way_of(const float light[3]) {
  cs_oklab lab = cs_oklab_of(light);
  return (cs_oklab){lab.L - 1, HUE * lab.a, HUE * lab.b};
}

static void find_ways(const making *m, int32_t y, cs_oklab *row) {
  const cs_scan *scan = &m->page->scan;
  const uint8_t *dark = m->dark + (size_t)y * (size_t)scan->width;
  float paper = paper_at(m), light[3];
  cs_rough_field(m->page, y, m->field);
  for (int32_t x = 0; x < scan->width; x++) {
    row[x] = (cs_oklab){0, 0, 0};
    if (dark[x] == 0)
      continue;
    const unsigned char *code = cs_scan_at(scan, x, y);
    for (int c = 0; c < 3; c++)
      light[c] = scan->curve.light[cs_srgb8_byte((float)code[c] / 255 * paper /
                                                 (m->page->paper[c] * m->field[x]))];
    row[x] = way_of(light);
  }
}

/* The ink whose way from the paper is most like this one. */
static uint8_t nearest(const cs_oklab *ways, size_t count, cs_oklab to) {
  uint8_t best = 0;
  float most = -2;
  for (size_t i = 0; i < count; i++) {
    const cs_oklab *w = &ways[i];
    float dot = w->L * to.L + w->a * to.a + w->b * to.b;
    if (dot <= most)
      continue;
    most = dot;
    best = (uint8_t)i;
  }
  return best;
}

/* The ways of unit length to the inks. */
static void list_ways(const making *m, cs_oklab *ways) {
  for (size_t i = 0; i < m->desc->count; i++) {
    float light[3];
    for (int c = 0; c < 3; c++)
      light[c] = m->page->scan.curve.light[m->desc->codes[i][c]];
    cs_oklab way = way_of(light);
    double length = sqrt((double)cs_oklab_apart(way, (cs_oklab){0, 0, 0}));
    float unit = length > 0 ? (float)(1 / length) : 0;
    ways[i] = (cs_oklab){way.L * unit, way.a * unit, way.b * unit};
  }
}

/* The inks of row y, by the sum over 3 x 3 pixels: the dark ones count most, and they have the
 * purest hue. rows: the ways of the row above, of this one, and of the row below. */
static void part_row(const making *m, int32_t y, const cs_oklab *ways, cs_oklab *const rows[3]) {
  int32_t width = m->page->scan.width;
  size_t first = (size_t)y * (size_t)width;
  for (int32_t x = 0; x < width; x++) {
    cs_oklab sum = {0, 0, 0};
    if (m->dark[first + (size_t)x] == 0)
      continue;
    for (int32_t i = x > 0 ? x - 1 : 0; i <= x + 1 && i < width; i++)
      for (int j = 0; j < 3; j++) {
        sum.L += rows[j][i].L;
        sum.a += rows[j][i].a;
        sum.b += rows[j][i].b;
      }
    m->ink[first + (size_t)x] = nearest(ways, m->desc->count, sum);
  }
}

static celspan_status part_inks(const making *m) {
  cs_oklab ways[CS_INKS_MOST], *rows;
  size_t width = (size_t)m->page->scan.width;
  int32_t height = m->page->scan.height;
  CS_TRY(CS_MAKE(m->page->context, rows, 4 * width)); /* the last one stays clear */
  list_ways(m, ways);
  for (int32_t y = -1; y < height; y++) {
    cs_oklab *at[3];
    for (int32_t i = 0; i < 3; i++) {
      int32_t row = y - 1 + i;
      at[i] = row < 0 || row >= height ? rows + 3 * width : rows + (size_t)(row % 3) * width;
    }
    if (y + 1 < height)
      find_ways(m, y + 1, at[2]);
    if (y >= 0)
      part_row(m, y, ways, at);
  }
  cs_mem_free(m->page->context->memory, rows, 4 * width * sizeof *rows);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- alpha */

static float darkness_of(const unsigned char code[3]) { return 1 - cs_rough_brightness(code); }

/* How dark the full colour of an ink is on the page. */
static int full_of(const making *m, size_t ink) {
  const cs_inks_desc *desc = m->desc;
  uint32_t counts[SHADES] = {0};
  float most = 0;
  for (size_t i = 0; i < desc->count; i++)
    most = darkness_of(desc->codes[i]) > most ? darkness_of(desc->codes[i]) : most;
  if (desc->has_tones) {
    float own = most > 0 ? darkness_of(desc->codes[ink]) / most : 1;
    return (int)(255 * (1 - (float)(desc->black / desc->white)) * own + 0.5f);
  }
  for (size_t i = 0; i < size_of(m->page); i++)
    counts[m->dark[i]] += !m->ink || m->ink[i] == ink;
  counts[0] = 0;
  return (int)(shade_at(counts, 256, 1 - FULL_SHARE) * FULL);
}

static void fill_plane(const making *m, size_t ink, uint8_t *plane) {
  uint8_t alpha[256];
  int full = full_of(m, ink);
  full = full > LEAST_FULL ? full : LEAST_FULL;
  for (int i = 0; i < 256; i++)
    alpha[i] = (uint8_t)(i < full ? (i * 255 + full / 2) / full : 255);
  for (size_t i = 0; i < size_of(m->page); i++) {
    plane[i] = !m->ink || m->ink[i] == ink ? alpha[m->dark[i]] : 0;
    m->out->covered += plane[i] >= HALF;
  }
}

/* ---------------------------------------------------------------- together */

static celspan_status make(making *m) {
  celspan_context *context = m->page->context;
  size_t count = size_of(m->page), width = (size_t)m->page->scan.width;
  CS_TRY(CS_MAKE(context, m->field, width));
  CS_TRY(CS_MAKE(context, m->dark, count));
  find_tones(m);
  for (int32_t y = 0; y < m->page->scan.height; y++)
    darken_row(m, y, m->dark + (size_t)y * width);
  clear_holes(m);
  CS_TRY(drop_dust(m));
  if (m->desc->count > 1) {
    CS_TRY(CS_MAKE(context, m->ink, count));
    CS_TRY(part_inks(m));
  }
  for (size_t i = 0; i < m->desc->count; i++) {
    CS_TRY(CS_MAKE(context, m->out->planes[i], count));
    fill_plane(m, i, m->out->planes[i]);
  }
  return CELSPAN_OK;
}

celspan_status cs_inks_make(const cs_rough *page, const cs_inks_desc *desc, cs_inks *out) {
  cs_memory *memory = page->context->memory;
  *out = (cs_inks){.context = page->context, .count = desc->count, .pixels = size_of(page)};
  making m = {.page = page, .desc = desc, .out = out};
  celspan_status status = make(&m);
  cs_mem_free(memory, m.field, (size_t)page->scan.width * sizeof *m.field);
  cs_mem_free(memory, m.dark, out->pixels);
  cs_mem_free(memory, m.ink, out->pixels);
  return status;
}

void cs_inks_finish(cs_inks *inks) {
  for (size_t i = 0; i < inks->count; i++)
    cs_mem_free(inks->context->memory, inks->planes[i], inks->pixels);
  *inks = (cs_inks){0};
}
