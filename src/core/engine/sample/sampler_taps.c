#include "engine/sample/sampler_taps.h"

#include "engine/sample/sampler_codes.h"
#include "engine/sample/sampler_pixel.h"
#include "engine/sample/sampler_row.h"

#define ENLARGED (1 << 8 | 1) /* the plan of pixels that one tap is enough for */
#define ROWS_AHEAD 3.5        /* rows: how far ahead texels are fetched into the cache */
#define WIDE(run, name) CS_WIDE_CHOOSE((run)->sampler->isa, name)

/* ---------------------------------------------------------------- one tap a pixel */

static void reduce(const cs_sampler *s, int32_t count, double *u, double *v) {
  for (int32_t i = 0; i < count; i++) {
    u[i] = cs_sampler_reduce(u[i], s->width, s->wrap);
    v[i] = cs_sampler_reduce(v[i], s->height, s->wrap);
  }
}

/* A quad whose texels are not all in one block. */
static void mix_apart(const cs_sampling *run, int level, const cs_sampler_quads *quads, int32_t i,
                      float rgba[4]) {
  cs_v4 quad[4], column[2];
  for (int k = 0; k < 4; k++)
    quad[k] = cs_v4_load(cs_sampling_texel(run, level, quads->x[i] + k % 2, quads->y[i] + k / 2));
  for (int k = 0; k < 2; k++)
    column[k] = quad[k] + quads->down[i] * (quad[k + 2] - quad[k]);
  cs_v4_store(rgba, column[0] + quads->across[i] * (column[1] - column[0]));
}

/* The distance in texels, inside a block, from a quad to the quad that the row after the next will
 * mix at the same column; 0 where that quad is in another block. u, v, near: of a pixel's
 * centre. */
static ptrdiff_t texels_ahead(const cs_sampler *s, int level, double u, double v, double near) {
  double rows = ROWS_AHEAD * near / (double)((int64_t)1 << level);
  double across = (s->m[1] - u * s->m[7]) * rows, down = (s->m[4] - v * s->m[7]) * rows;
  if (!(fabs(across) < CS_PICTURE_BLOCK && fabs(down) < CS_PICTURE_BLOCK))
    return 0;
  return (ptrdiff_t)rint(down) * CS_PICTURE_BLOCK + (ptrdiff_t)rint(across);
}

/* Places on the picture that are mixed, one a pixel. */
typedef struct places {
  const double *u, *v;
  const int32_t *visible; /* pixels with 0 here need not be mixed; NULL: all are visible */
  ptrdiff_t ahead;        /* texels (texels_ahead) */
} places;

static void mix_stretches(const cs_sampling *run, int level, const cs_sampler_quads *quads,
                          const places *at, int32_t count, float (*rgba)[4]) {
  for (int32_t i = 0, end; i < count; i = end) {
    int32_t key = quads->key[i];
    end = i + 1;
    if (key < 0) {
      if (!at->visible || at->visible[i])
        mix_apart(run, level, quads, i, rgba[i]);
      continue;
    }
    while (end < count && quads->key[end] == key)
      end++;
    const float *block =
        cs_block_cache_block(run->blocks, &run->sampler->source, level, key & 0x7fff, key >> 15);
    WIDE(run, cs_sampler_mix_quads)
    (block, quads, i, end - i, 4 * (ptrdiff_t)sizeof(float) * at->ahead, rgba + i);
  }
}

/* Finds the blocks of the tiles that are touched; false if they are not all coded, or too many for
 * the cache at a time. */
static bool find_tiles(const cs_sampling *run, uint32_t touched, cs_sampler_tiles *tiles) {
  cs_block_cache *blocks = run->blocks;
  const uint32_t before = blocks->fetches;
  tiles->are_opaque = true;
  for (uint32_t rest = touched; rest; rest &= rest - 1) {
    int32_t tile = __builtin_ctz(rest);
    const cs_block_cache_slot *slot = cs_block_cache_slot_of(blocks, &run->sampler->source, 0,
                                                             tiles->column + tile % tiles->columns,
                                                             tiles->row + tile / tiles->columns);
    if (!slot->codes)
      return false;
    tiles->codes[tile] = slot->codes;
    tiles->are_opaque = tiles->are_opaque && slot->opacity == CS_PICTURE_OPAQUE;
  }
  return blocks->fetches == before;
}

static bool mix_tiles(const cs_sampling *run, uint32_t touched, cs_sampler_tiles *tiles,
                      const cs_sampler_clamped *clamped, int32_t count, bool are_planes,
                      float (*rgba)[4]) {
  /* The second search fetches nothing, unless the cache cannot keep all these blocks at once. */
  if (!find_tiles(run, touched, tiles) && !find_tiles(run, touched, tiles))
    return false;
  WIDE(run, cs_sampler_mix_codes)(run->blocks->curve, tiles, clamped, count, are_planes, rgba);
  return true;
}

/* Mixes codes; quads outside the picture are clamped to it. False if that cannot be done here. */
static bool mix_coded(const cs_sampling *run, int32_t count, const places *at, float (*rgba)[4]) {
  cs_sampler_clamped clamped;
  cs_sampler_tiles tiles;
  WIDE(run, cs_sampler_clamp_quads)(run->sampler, count, at->u, at->v, &clamped);
  if (!cs_sampler_lay_tiles(run->sampler, &clamped, &tiles))
    return false;
  uint32_t touched = WIDE(run, cs_sampler_tile_quads)(run->sampler, &tiles, count, &clamped);
  tiles.ahead = 4 * at->ahead;
  return mix_tiles(run, touched, &tiles, &clamped, count, false, rgba);
}

/* Bounds of the quads of an affine map. Its first and its last quad are the outermost ones. False
 * if not all quads are in the picture. */
static bool bound_quads(const cs_sampler *s, int32_t x0, int32_t count, double y,
                        cs_sampler_clamped *out) {
  const double *m = s->m;
  double row_u = m[1] * y + m[2], row_v = m[4] * y + m[5], last = x0 + count - 0.5;
  double u[2] = {m[0] * (x0 + 0.5) + row_u, m[0] * last + row_u};
  double v[2] = {m[3] * (x0 + 0.5) + row_v, m[3] * last + row_v};
  double left = fmin(u[0], u[1]), right = fmax(u[0], u[1]);
  double top = fmin(v[0], v[1]), bottom = fmax(v[0], v[1]);
  if (!(left >= 1 && top >= 1 && right < s->width - 1 && bottom < s->height - 1))
    return false;
  out->left = (int32_t)(left - 0.5 + CS_SAMPLER_SAME);
  out->top = (int32_t)(top - 0.5 + CS_SAMPLER_SAME);
  out->right = (int32_t)(right - 0.5 + CS_SAMPLER_SAME);
  out->bottom = (int32_t)(bottom - 0.5 + CS_SAMPLER_SAME);
  return true;
}

/* One tap for each pixel of an affine map; all taps are inside the picture. */
static bool tap_inside(const cs_sampling *run, int32_t x0, int32_t count, double y, bool are_planes,
                       float (*rgba)[4]) {
  const cs_sampler *s = run->sampler;
  cs_sampler_clamped clamped;
  cs_sampler_tiles tiles;
  if (!s->reads_codes || !bound_quads(s, x0, count, y, &clamped) ||
      !cs_sampler_lay_tiles(s, &clamped, &tiles))
    return false;
  uint32_t touched = WIDE(run, cs_sampler_place_quads)(s, x0, count, y, &tiles, &clamped);
  tiles.ahead = 4 * texels_ahead(s, 0, 0, 0, 1);
  return mix_tiles(run, touched, &tiles, &clamped, count, are_planes, rgba);
}

/* Mixes the four texels of a level about each of some places. */
static void mix_places(const cs_sampling *run, int level, int32_t count, const places *at,
                       float (*rgba)[4]) {
  const cs_sampler *s = run->sampler;
  cs_sampler_quads quads;
  if (s->reads_codes && level == 0 && s->wrap != CELSPAN_WRAP_REPEAT &&
      mix_coded(run, count, at, rgba))
    return;
  WIDE(run, cs_sampler_find_quads)(s, level, count, at->u, at->v, &quads);
  mix_stretches(run, level, &quads, at, count, rgba);
}

static void tap_linear(const cs_sampling *run, int level, cs_sampler_tap tap, int32_t from,
                       int32_t count, const cs_sampler_centres *centres, float (*rgba)[4]) {
  const cs_sampler *s = run->sampler;
  double u[CS_SAMPLER_BATCH], v[CS_SAMPLER_BATCH];
  WIDE(run, cs_sampler_move)(s, tap, from, count, centres, u, v);
  if (s->wrap == CELSPAN_WRAP_REPEAT)
    reduce(s, count, u, v);
  const places at = {
      u, v, centres->all_visible ? NULL : centres->visible + from,
      texels_ahead(s, level, centres->u[from], centres->v[from], centres->near[from])};
  mix_places(run, level, count, &at, rgba);
}

static void tap_nearest(const cs_sampling *run, int32_t count, const cs_sampler_centres *centres,
                        float (*rgba)[4]) {
  const cs_sampler *s = run->sampler;
  for (int32_t i = 0; i < count; i++) {
    double u = cs_sampler_reduce(centres->u[i], s->width, s->wrap) + CS_SAMPLER_SAME;
    double v = cs_sampler_reduce(centres->v[i], s->height, s->wrap) + CS_SAMPLER_SAME;
    if (centres->all_visible || centres->visible[i])
      memcpy(rgba[i], cs_sampling_texel(run, 0, cs_sampler_floor(u), cs_sampler_floor(v)),
             sizeof *rgba);
  }
}

static void tap_cubic(const cs_sampling *run, int32_t from, int32_t count,
                      const cs_sampler_centres *centres, float (*rgba)[4]) {
  const cs_sampler *s = run->sampler;
  for (int32_t i = from; i < from + count; i++)
    if (centres->all_visible || centres->visible[i])
      cs_sampler_bicubic(run, cs_sampler_reduce(centres->u[i], s->width, s->wrap),
                         cs_sampler_reduce(centres->v[i], s->height, s->wrap), rgba[i - from]);
}

/* ---------------------------------------------------------------- means */

/* How a pixel's mean is made: columns x rows taps on a mip level. */
typedef struct tap_plan {
  int level, columns, rows;
} tap_plan;

static void tap_mean(const cs_sampling *run, tap_plan plan, int32_t from, int32_t count,
                     const cs_sampler_centres *centres, float (*rgba)[4]) {
  float first[CS_SAMPLER_BATCH][4], next[CS_SAMPLER_BATCH][4];
  const int level = plan.level, columns = plan.columns, rows = plan.rows, taps = columns * rows;
  if (taps == 1) {
    tap_linear(run, level, (cs_sampler_tap){0, 0}, from, count, centres, rgba);
    return;
  }
  memset(rgba, 0, (size_t)count * sizeof *rgba);
  for (int k = 0; k < taps; k++) {
    cs_sampler_tap tap = {(k % columns + 0.5) / columns - 0.5, (k / columns + 0.5) / rows - 0.5};
    tap_linear(run, level, tap, from, count, centres, k ? next : first);
    if (k)
      WIDE(run, cs_sampler_add_row)
    ((const float(*)[4])next, (const float(*)[4])first, 1, count, rgba);
  }
  WIDE(run, cs_sampler_end_sum)((const float(*)[4])first, (float)taps, count, rgba);
}

/* Neighbouring pixels whose means are made in the same way are made together. */
static void tap_plans(const cs_sampling *run, int32_t count, const cs_sampler_centres *centres,
                      float (*rgba)[4]) {
  int32_t plans[CS_SAMPLER_BATCH];
  WIDE(run, cs_sampler_plan_taps)(run->sampler, count, centres, plans);
  for (int32_t i = 0, end; i < count; i = end) {
    for (end = i + 1; end < count && plans[end] == plans[i];)
      end++;
    if (run->sampler->kernel == CS_SAMPLER_BICUBIC && plans[i] == ENLARGED)
      tap_cubic(run, i, end - i, centres, rgba + i);
    else
      tap_mean(run, (tap_plan){plans[i] >> 16, plans[i] >> 8 & 0xff, plans[i] & 0xff}, i, end - i,
               centres, rgba + i);
  }
}

/* ---------------------------------------------------------------- runs */

static void tap_batch(const cs_sampling *run, int32_t count, const cs_sampler_centres *centres,
                      float (*rgba)[4]) {
  const cs_sampler *s = run->sampler;
  if (s->kernel == CS_SAMPLER_NEAREST)
    tap_nearest(run, count, centres, rgba);
  else if (s->kernel == CS_SAMPLER_BILINEAR)
    tap_linear(run, 0, (cs_sampler_tap){0, 0}, 0, count, centres, rgba);
  else if (s->placement == CS_SAMPLER_PERSPECTIVE)
    tap_plans(run, count, centres, rgba);
  else
    tap_mean(run, (tap_plan){s->level, s->columns, s->rows}, 0, count, centres, rgba);
}

/* The usual case, one tap a pixel and all pixels visible: centres need not be computed first. */
static void tap_plainly(const cs_sampling *run, int32_t x0, int32_t count, double y,
                        float (*rgba)[4]) {
  const cs_sampler *s = run->sampler;
  double u[CS_SAMPLER_BATCH], v[CS_SAMPLER_BATCH];
  if (tap_inside(run, x0, count, y, false, rgba))
    return;
  WIDE(run, cs_sampler_place_taps)(s, x0, count, y, u, v);
  const places at = {u, v, NULL, texels_ahead(s, 0, 0, 0, 1)};
  mix_places(run, 0, count, &at, rgba);
}

/* Whether a sample is one tap at its pixel's centre. */
static bool is_one_tap(const cs_sampler *s) {
  return s->placement == CS_SAMPLER_AFFINE && s->kernel == CS_SAMPLER_BILINEAR;
}

bool cs_sampler_taps_planes(const cs_sampling *run, cs_run pixels, float (*planes)[4]) {
  int32_t count = (pixels.x1 - pixels.x0 + CS_SAMPLES_PLANE - 1) & -CS_SAMPLES_PLANE;
  return is_one_tap(run->sampler) && tap_inside(run, pixels.x0, count, pixels.y, true, planes);
}

void cs_sampler_taps_run(const cs_sampling *run, cs_run pixels, float (*rgba)[4]) {
  const cs_sampler *s = run->sampler;
  const int32_t x0 = pixels.x0, count = pixels.x1 - pixels.x0;
  const double y = pixels.y;
  cs_sampler_centres centres;
  bool is_plain = is_one_tap(s) && s->wrap == CELSPAN_WRAP_CLAMP;
  for (int32_t done = 0; done < count; done += CS_SAMPLER_BATCH) {
    int32_t batch = count - done < CS_SAMPLER_BATCH ? count - done : CS_SAMPLER_BATCH;
    if (is_plain) {
      tap_plainly(run, x0 + done, batch, y, rgba + done);
      continue;
    }
    if (s->placement == CS_SAMPLER_PERSPECTIVE)
      WIDE(run, cs_sampler_map_perspective)(s->m, x0 + done, batch, y, &centres);
    else
      WIDE(run, cs_sampler_map_affine)(s->m, x0 + done, batch, y, &centres);
    centres.all_visible = s->placement == CS_SAMPLER_AFFINE && s->wrap != CELSPAN_WRAP_CLEAR;
    if (!centres.all_visible)
      WIDE(run, cs_sampler_mark_visible)(s, batch, &centres);
    tap_batch(run, batch, &centres, rgba + done);
    if (!centres.all_visible)
      WIDE(run, cs_sampler_clear_invisible)(centres.visible, batch, rgba + done);
  }
}
