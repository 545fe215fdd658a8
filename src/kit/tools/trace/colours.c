/* Oklab: Bjorn Ottosson, "A perceptual color space for image processing", 2020. */
#include "tools/trace/colours.h"

#include <string.h>

#include "inside/colour.h"
#include "inside/elementary.h"
#include "inside/pictures.h"

enum { BITS = 5, BINS = 1 << 3 * BITS, ROUNDS = 32 };
/* The greatest difference between codes of neighbours in a flat place. */
#define FLAT 20
/* If at least one pixel in this many is flat, only flat places count. */
#define FLAT_SHARE 50
/* A colour with this share of the pixels is as likely to be chosen as any more frequent one. */
#define FULL_SHARE 500
/* Colours with a smaller squared distance look the same. */
#define SAME 0.0009f
/* Colours within this squared distance are counted with the fullest bin. */
#define ABOUT 0.003f

typedef struct bin {
  uint64_t count, sum[3];
  cs_oklab lab;
  uint32_t group;
} bin;

/* ---------------------------------------------------------------- Oklab */

static double cube_root(double x) { return x > 0 ? cs_elementary_pow(x, 1.0 / 3) : 0; }

cs_oklab cs_oklab_of(const float light[3]) {
  double r = (double)light[0], g = (double)light[1], b = (double)light[2];
  double l = cube_root(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  double m = cube_root(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  double s = cube_root(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return (cs_oklab){(float)(0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s),
                    (float)(1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s),
                    (float)(0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s)};
}

static void set_colour(cs_flat_colour *colour, const cs_scan *scan, const unsigned char code[3]) {
  for (int c = 0; c < 3; c++) {
    colour->code[c] = code[c];
    colour->light.c[c] = scan->curve.light[code[c]];
  }
  colour->light.c[3] = 1;
  colour->lab = cs_oklab_of(colour->light.c);
}

/* ---------------------------------------------------------------- bins */

static int apart(int a, int b) { return a < b ? b - a : a - b; }

static bool is_like(const unsigned char *a, const unsigned char *b) {
  return apart(a[0], b[0]) <= FLAT && apart(a[1], b[1]) <= FLAT && apart(a[2], b[2]) <= FLAT &&
         apart(a[3], b[3]) <= FLAT;
}

static void add_pixel(bin *bins, const unsigned char *code) {
  const int shift = 8 - BITS;
  bin *into = &bins[(code[0] >> shift) << 2 * BITS | (code[1] >> shift) << BITS | code[2] >> shift];
  into->count++;
  for (int c = 0; c < 3; c++)
    into->sum[c] += code[c];
}

/* Fills the bins with all opaque pixels, or only with the flat ones. Returns their number. */
static uint64_t fill_bins(const cs_scan *scan, bool is_flat, bin *bins) {
  uint64_t total = 0;
  size_t stride = 4 * (size_t)scan->width;
  memset(bins, 0, BINS * sizeof *bins);
  for (int32_t y = is_flat; y < scan->height; y++) {
    const unsigned char *code = cs_scan_at(scan, is_flat, y);
    for (int32_t x = is_flat; x < scan->width; x++, code += 4) {
      if (code[3] < 128 || (is_flat && !(is_like(code, code - 4) && is_like(code, code - stride))))
        continue;
      add_pixel(bins, code);
      total++;
    }
  }
  return total;
}

static void mean_code(const uint64_t sum[3], uint64_t count, unsigned char code[3]) {
  for (int c = 0; c < 3; c++)
    code[c] = (unsigned char)((sum[c] + count / 2) / count);
}

/* Keeps only the bins that are not empty, and sets their places in Oklab. */
static size_t pack_bins(const cs_scan *scan, bin *bins) {
  size_t count = 0;
  for (size_t i = 0; i < BINS; i++) {
    cs_flat_colour mean;
    unsigned char code[3];
    if (bins[i].count == 0)
      continue;
    mean_code(bins[i].sum, bins[i].count, code);
    set_colour(&mean, scan, code);
    bins[count] = bins[i];
    bins[count++].lab = mean.lab;
  }
  return count;
}

/* ---------------------------------------------------------------- k-means */

typedef struct groups {
  bin *bins;
  size_t bin_count, count;
  uint64_t total;
  cs_oklab centres[CS_COLOURS_MOST];
} groups;

static size_t fullest(const groups *g) {
  size_t best = 0;
  for (size_t i = 1; i < g->bin_count; i++)
    if (g->bins[i].count > g->bins[best].count)
      best = i;
  return best;
}

static float distance_to(const groups *g, cs_oklab lab, uint32_t *group) {
  float least = 1e30f;
  for (size_t k = 0; k < g->count; k++) {
    float distance = cs_oklab_apart(lab, g->centres[k]);
    if (distance < least) {
      least = distance;
      *group = (uint32_t)k;
    }
  }
  return least;
}

/* Adds the bin that is farthest from all centres; a bin of few pixels counts less. false: none is
 * far enough. */
static bool add_centre(groups *g) {
  double full = (double)g->total / FULL_SHARE, most = 0;
  size_t best = 0;
  for (size_t i = 0; i < g->bin_count; i++) {
    uint32_t group;
    double distance = (double)distance_to(g, g->bins[i].lab, &group);
    double weight = (double)g->bins[i].count < full ? (double)g->bins[i].count / full : 1;
    if (distance > (double)SAME && distance * weight > most) {
      most = distance * weight;
      best = i;
    }
  }
  if (most > 0)
    g->centres[g->count++] = g->bins[best].lab;
  return most > 0;
}

static bool assign(groups *g) {
  bool has_changed = false;
  for (size_t i = 0; i < g->bin_count; i++) {
    uint32_t group = 0;
    distance_to(g, g->bins[i].lab, &group);
    has_changed = has_changed || group != g->bins[i].group;
    g->bins[i].group = group;
  }
  return has_changed;
}

/* A group without bins keeps its centre. */
static void move_centres(groups *g) {
  double sums[CS_COLOURS_MOST][4] = {{0}};
  for (size_t i = 0; i < g->bin_count; i++) {
    double *sum = sums[g->bins[i].group], weight = (double)g->bins[i].count;
    sum[0] += weight * (double)g->bins[i].lab.L;
    sum[1] += weight * (double)g->bins[i].lab.a;
    sum[2] += weight * (double)g->bins[i].lab.b;
    sum[3] += weight;
  }
  for (size_t k = 0; k < g->count; k++)
    if (sums[k][3] > 0)
      g->centres[k] = (cs_oklab){(float)(sums[k][0] / sums[k][3]), (float)(sums[k][1] / sums[k][3]),
                                 (float)(sums[k][2] / sums[k][3])};
}

static void find_groups(groups *g, size_t wanted) {
  g->centres[g->count++] = g->bins[fullest(g)].lab;
  while (g->count < wanted && add_centre(g)) {
  }
  for (int round = 0; round < ROUNDS && (assign(g) || round == 0); round++)
    move_centres(g);
}

/* ---------------------------------------------------------------- colours */

/* The mean of the colours near the fullest bin of a group. Returns the group's pixels; 0: there are
 * none. */
static uint64_t colour_of_group(const groups *g, uint32_t group, unsigned char code[3]) {
  const bin *top = NULL;
  uint64_t sum[3] = {0}, about = 0, count = 0;
  for (const bin *b = g->bins; b < g->bins + g->bin_count; b++) {
    if (b->group == group && (!top || b->count > top->count))
      top = b;
    count += b->group == group ? b->count : 0;
  }
  for (const bin *b = g->bins; top && b < g->bins + g->bin_count; b++) {
    if (b->group != group || cs_oklab_apart(b->lab, top->lab) > ABOUT)
      continue;
    about += b->count;
    for (int c = 0; c < 3; c++)
      sum[c] += b->sum[c];
  }
  if (about > 0)
    mean_code(sum, about, code);
  return count;
}

static bool is_listed(const cs_colours *colours, const unsigned char code[3]) {
  for (size_t i = 0; i < colours->count; i++)
    if (memcmp(colours->list[i].code, code, 3) == 0)
      return true;
  return false;
}

/* Lists the colours in descending order of their pixels: each is inserted before groups that have
 * fewer. */
static void list_colours(const groups *g, const cs_scan *scan, cs_colours *out) {
  uint64_t counts[CS_COLOURS_MOST + 1];
  out->count = 0;
  for (uint32_t group = 0; group < g->count; group++) {
    unsigned char code[3];
    uint64_t count = colour_of_group(g, group, code);
    if (count == 0 || is_listed(out, code))
      continue;
    size_t at = out->count++;
    for (; at > 0 && counts[at - 1] < count; at--) {
      counts[at] = counts[at - 1];
      out->list[at] = out->list[at - 1];
    }
    counts[at] = count;
    set_colour(&out->list[at], scan, code);
  }
  out->list[out->count] = (cs_flat_colour){.code = {0}};
}

static void fill(groups *g, const cs_scan *scan, bool is_flat) {
  g->total = fill_bins(scan, is_flat, g->bins);
  g->bin_count = pack_bins(scan, g->bins);
}

celspan_status cs_colours_find(celspan_context *context, const cs_scan *scan, size_t wanted,
                               cs_colours *out) {
  groups g = {.bins = cs_mem_array(context->memory, BINS, sizeof(bin))};
  if (!g.bins)
    return cs_fail_memory(context);
  out->count = 0;
  out->list[0] = (cs_flat_colour){.code = {0}};
  uint64_t pixels = (uint64_t)scan->width * (uint64_t)scan->height;
  fill(&g, scan, false);
  if (g.bin_count > wanted) {
    fill(&g, scan, true);
    if (g.total <= pixels / FLAT_SHARE)
      fill(&g, scan, false);
  }
  if (g.bin_count > 0) {
    find_groups(&g, wanted);
    list_colours(&g, scan, out);
  }
  cs_mem_free(context->memory, g.bins, BINS * sizeof(bin));
  return CELSPAN_OK;
}

celspan_status cs_colours_take(celspan_context *context, const cs_scan *scan,
                               const unsigned char *codes, size_t count, cs_colours *out) {
  out->count = 0;
  for (size_t i = 0; i < count; i++) {
    if (is_listed(out, codes + 3 * i))
      return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                     "trace: colour %zu of the list is there twice; each colour must be "
                     "different",
                     i + 1);
    set_colour(&out->list[out->count++], scan, codes + 3 * i);
  }
  out->list[count] = (cs_flat_colour){.code = {0}};
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- scan */

static size_t bytes_of(const cs_scan *scan) {
  return (size_t)scan->width * (size_t)scan->height * 4;
}

/* One row of a block: its codes if they are exact; otherwise its texels are coded. */
static void copy_row(const cs_picture_block *block, int32_t row, int32_t count, cs_srgb8 code,
                     unsigned char *out) {
  if (block->is_coded && block->codes)
    memcpy(out, block->codes[row], (size_t)count * 4);
  else
    code(block->texels + 4 * (size_t)row * CS_PICTURE_BLOCK, (size_t)count, out);
}

static celspan_status read_block(celspan_context *context, const cs_picture *picture, cs_scan *scan,
                                 int32_t x, int32_t y) {
  int32_t columns = scan->width - x < CS_PICTURE_BLOCK ? scan->width - x : CS_PICTURE_BLOCK;
  int32_t rows = scan->height - y < CS_PICTURE_BLOCK ? scan->height - y : CS_PICTURE_BLOCK;
  cs_srgb8 code = cs_srgb8_choose(cs_isa_best());
  cs_picture_block *block;
  CS_TRY(cs_load_block(context, picture, 0, x / CS_PICTURE_BLOCK, y / CS_PICTURE_BLOCK, &block));
  for (int32_t row = 0; row < rows; row++)
    copy_row(block, row, columns, code,
             scan->codes + 4 * ((size_t)(y + row) * (size_t)scan->width + (size_t)x));
  scan->has_clear = scan->has_clear || block->opacity != CS_PICTURE_OPAQUE;
  cs_store_release(block);
  return CELSPAN_OK;
}

static celspan_status read_blocks(celspan_context *context, const cs_picture *picture,
                                  cs_scan *scan) {
  for (int32_t y = 0; y < scan->height; y += CS_PICTURE_BLOCK)
    for (int32_t x = 0; x < scan->width; x += CS_PICTURE_BLOCK)
      CS_TRY(read_block(context, picture, scan, x, y));
  return CELSPAN_OK;
}

celspan_status cs_scan_read(celspan_context *context, const cs_picture *picture, cs_scan *out) {
  celspan_picture_info info;
  CS_TRY(cs_store_info(context, picture, &info));
  if ((int64_t)info.width * info.height > CS_SCAN_MOST)
    return cs_fail(context, CELSPAN_LIMIT,
                   "%s: %d x %d pixels are more than can be traced, %d in all; shrink the picture "
                   "or trace parts of it",
                   cs_picture_name(picture), info.width, info.height, CS_SCAN_MOST);
  *out = (cs_scan){.width = info.width, .height = info.height};
  cs_srgb8_make_curve(&out->curve);
  out->codes = cs_mem_resize(context->memory, NULL, 0, bytes_of(out));
  if (!out->codes)
    return cs_fail_memory(context);
  celspan_status status = read_blocks(context, picture, out);
  if (status != CELSPAN_OK)
    cs_scan_finish(out, context);
  return status;
}

void cs_scan_finish(cs_scan *scan, celspan_context *context) {
  cs_mem_free(context->memory, scan->codes, bytes_of(scan));
  scan->codes = NULL;
}
