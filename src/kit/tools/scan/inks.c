#include "tools/scan/inks.h"

#include <math.h>
#include <string.h>

#include "inside/context.h"
#include "inside/number.h"
#include "tools/trace/regions.h"

/* SHADES of brightness; FULL: of the paper. RIM: of an edge of the paper, in spots, that is not
 * drawn on. */
enum { SHADES = 512, FULL = 400, HALF = 128, RIM = 3 };
/* How much more a hue counts than a darkness. */
#define HUE 2.0f
/* The share of the pixels of an ink that are darker than its full colour. */
#define FULL_SHARE 0.2
#define LEAST_FULL 24

typedef struct making {
  const cs_rough *page;
  const cs_inks_desc *desc;
  size_t width, pixels; /* of the scan */
  float middle, white;  /* of the shares of the field: the paper's, and where ink begins */
  uint8_t *dark;        /* the page: 0 paper .. 255 */
  uint8_t *ink;         /* the page: the number of the ink; NULL: there is one */
  cs_inks *out;
} making;

/* ---------------------------------------------------------------- darkness */

static void count_row(const making *m, int32_t y, uint32_t counts[SHADES]) {
  int32_t first, end;
  cs_rough_row(m->page, y, RIM, &first, &end);
  const float *field = cs_rough_field(m->page, y);
  for (int32_t x = first; x < end; x++) {
    float share = cs_rough_brightness(cs_scan_at(&m->page->scan, x, y)) / field[x];
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

/* In a shadow the grain is as large as before it was divided out, times the same. */
static void darken_row(const making *m, int32_t y) {
  int32_t first, end;
  float foot = (m->middle - m->white) * m->page->paper;
  uint8_t *dark = m->dark + (size_t)y * m->width;
  cs_rough_row(m->page, y, RIM, &first, &end);
  const float *field = cs_rough_field(m->page, y);
  for (int32_t x = first; x < end; x++) {
    float white = m->middle * field[x] - foot;
    float bright = cs_rough_brightness(cs_scan_at(&m->page->scan, x, y));
    if (bright < white)
      dark[x] = (uint8_t)((1 - bright / white) * 254.5f + 0.5f);
  }
}

static void clear_holes(const making *m) {
  for (size_t i = 0; i < m->page->hole_count; i++) {
    const celspan_box *box = &m->page->holes[i];
    for (size_t y = 0; y < (size_t)box->height; y++)
      memset(m->dark + ((size_t)box->y + y) * m->width + (size_t)box->x, 0, (size_t)box->width);
  }
}

static celspan_status drop_dust(const making *m) {
  const cs_scan *scan = &m->page->scan;
  cs_regions blots;
  if (m->desc->dust == 0)
    return CELSPAN_OK;
  const cs_region_source source =
      cs_region_source_mask(m->dark, scan->width, scan->height, CS_CORNERS_JOIN);
  CS_TRY(cs_regions_make(m->page->context, &source, &blots));
  for (int32_t y = 0; y < scan->height; y++)
    for (size_t i = blots.rows[y]; i < blots.rows[y + 1]; i++) {
      const cs_region_run *run = &blots.runs[i];
      if (blots.list[run->region].area <= m->desc->dust)
        memset(m->dark + (size_t)y * (size_t)scan->width + (size_t)run->x0, 0,
               (size_t)(cs_regions_end(&blots, y, i) - run->x0));
    }
  cs_regions_finish(&blots, m->page->context);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- inks apart */

/* From the colour of the paper, white, to the colour with these codes. */
static cs_oklab way_to(const making *m, const float code[3]) {
  float light[3];
  for (int c = 0; c < 3; c++)
    light[c] = m->page->scan.curve.light[cs_srgb8_byte(code[c])];
  cs_oklab lab = cs_oklab_of(light);
  return (cs_oklab){lab.L - 1, HUE * lab.a, HUE * lab.b};
}

/* The ways of unit length to the inks. */
static void list_ways(const making *m, cs_oklab *ways) {
  for (size_t i = 0; i < m->desc->count; i++) {
    const unsigned char *code = m->desc->codes[i];
    cs_oklab way = way_to(m, (const float[]){code[0] / 255.0f, code[1] / 255.0f, code[2] / 255.0f});
    double length = sqrt((double)cs_oklab_apart(way, (cs_oklab){0, 0, 0}));
    float unit = length > 0 ? (float)(1 / length) : 0;
    ways[i] = (cs_oklab){way.L * unit, way.a * unit, way.b * unit};
  }
}

/* By the mean of the 3 x 3 pixels that are drawn: the dark ones count most, and have the purest
 * hue. */
static cs_oklab way_at(const making *m, float field, int32_t x, int32_t y) {
  const cs_rough *page = m->page;
  uint32_t sum[3] = {0}, count = 0;
  float code[3];
  for (int32_t v = y > 0 ? y - 1 : 0; v <= y + 1 && v < page->scan.height; v++)
    for (int32_t u = x > 0 ? x - 1 : 0; u <= x + 1 && u < page->scan.width; u++) {
      if (m->dark[(size_t)v * m->width + (size_t)u] == 0)
        continue;
      for (int c = 0; c < 3; c++)
        sum[c] += cs_scan_at(&page->scan, u, v)[c];
      count += 255;
    }
  for (int c = 0; c < 3; c++)
    code[c] = (float)sum[c] * page->paper / ((float)count * page->code[c] * field);
  return way_to(m, code);
}

/* The ink whose way from the paper is most like that of a pixel. */
static void part_row(const making *m, const cs_oklab *ways, int32_t y) {
  const size_t row = (size_t)y * m->width;
  const float *field = cs_rough_field(m->page, y);
  for (size_t x = 0; x < m->width; x++) {
    float most = -2;
    if (m->dark[row + x] == 0)
      continue;
    const cs_oklab to = way_at(m, field[x], (int32_t)x, y);
    for (size_t i = 0; i < m->desc->count; i++) {
      float dot = ways[i].L * to.L + ways[i].a * to.a + ways[i].b * to.b;
      if (dot <= most)
        continue;
      most = dot;
      m->ink[row + x] = (uint8_t)i;
    }
  }
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
  for (size_t i = 0; i < m->pixels; i++)
    counts[m->dark[i]] += !m->ink || m->ink[i] == ink;
  counts[0] = 0;
  return (int)(shade_at(counts, 256, 1 - FULL_SHARE) * FULL);
}

static celspan_status make_layer(const making *m, size_t ink) {
  const unsigned char *code = m->desc->codes[ink];
  cs_layer_desc layer = {.width = m->page->scan.width,
                         .height = m->page->scan.height,
                         .code = {code[0], code[1], code[2]},
                         .place = m->desc->place};
  uint8_t alpha[256];
  int full = full_of(m, ink);
  full = full > LEAST_FULL ? full : LEAST_FULL;
  for (int i = 0; i < 256; i++)
    alpha[i] = (uint8_t)(i < full ? (i * 255 + full / 2) / full : 255);
  CS_TRY(CS_MAKE(m->page->context, layer.plane, m->pixels));
  for (size_t i = 0; i < m->pixels; i++) {
    layer.plane[i] = !m->ink || m->ink[i] == ink ? alpha[m->dark[i]] : 0;
    m->out->covered += layer.plane[i] >= HALF;
  }
  return cs_layer_create(m->page->context, &layer, &m->out->layers[ink]);
}

/* ---------------------------------------------------------------- together */

static celspan_status make(making *m) {
  celspan_context *context = m->page->context;
  const int32_t height = m->page->scan.height;
  cs_oklab ways[CS_INKS_MOST];
  CS_TRY(CS_MAKE(context, m->dark, m->pixels));
  find_tones(m);
  for (int32_t y = 0; y < height; y++)
    darken_row(m, y);
  clear_holes(m);
  CS_TRY(drop_dust(m));
  if (m->desc->count > 1) {
    CS_TRY(CS_MAKE(context, m->ink, m->pixels));
    list_ways(m, ways);
    for (int32_t y = 0; y < height; y++)
      part_row(m, ways, y);
  }
  for (size_t i = 0; i < m->desc->count; i++)
    CS_TRY(make_layer(m, i));
  return CELSPAN_OK;
}

celspan_status cs_inks_make(const cs_rough *page, const cs_inks_desc *desc, cs_inks *out) {
  cs_memory *memory = page->context->memory;
  const size_t width = (size_t)page->scan.width;
  making m = {.page = page,
              .desc = desc,
              .out = out,
              .width = width,
              .pixels = width * (size_t)page->scan.height};
  *out = (cs_inks){0};
  celspan_status status = make(&m);
  cs_mem_free(memory, m.dark, m.pixels);
  cs_mem_free(memory, m.ink, m.pixels);
  return status;
}

void cs_inks_finish(cs_inks *inks) {
  for (size_t i = 0; i < CS_INKS_MOST; i++)
    celspan_surface_unref(inks->layers[i]);
  *inks = (cs_inks){0};
}
