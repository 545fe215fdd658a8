/* The common properties of the samples of some pixels, from the blocks of texels that they may come
 * from.
 *
 *     +-------+-------+-------+       a picture, in blocks of 64 x 64 texels
 *     | clear | clear | mixed |
 *     |    ...|...    |       |       the samples of the pixels [x0, x1) come from the texels in
 *     +----:--+--:----+-------+       the dotted rectangle; all the blocks that it touches are
 *     | clear | clear | opaque|       clear, so the samples are clear too
 *     |    ...|...    |       |
 *     +-------+-------+-------+
 *
 * An answer is the same as long as the same blocks are asked, which is for many rows: it is kept
 * with the heights between which they surely are. So it depends on the columns and the row alone.
 */
#include "engine/sample/sampler.h"
#include "engine/sample/sampler_texel.h"

#define MOST_BLOCKS 12 /* examined for opacity_columns columns */
#define SURELY 1e-3    /* rows by which rounding may move the edge of a block */

/* A rectangle of the picture, in its pixels. */
typedef struct area {
  double u0, v0, u1, v1;
} area;

/* The rectangle that the samples of a run may come from. */
static area area_of(const cs_sampler *s, cs_run run) {
  const double *m = s->m;
  double y = run.y, left = run.x0 + 0.5, right = run.x1 - 0.5, radius = s->radius;
  double ua = m[0] * left + m[1] * y + m[2], ub = m[0] * right + m[1] * y + m[2];
  double va = m[3] * left + m[4] * y + m[5], vb = m[3] * right + m[4] * y + m[5];
  return (area){(ua < ub ? ua : ub) - radius, (va < vb ? va : vb) - radius,
                (ua < ub ? ub : ua) + radius, (va < vb ? vb : va) + radius};
}

static bool is_beyond(const cs_sampler *s, const area *a) {
  return a->u1 < 0 || a->v1 < 0 || a->u0 >= s->width || a->v0 >= s->height;
}

static bool is_within(const cs_sampler *s, const area *a) {
  return a->u0 >= 0 && a->v0 >= 0 && a->u1 < s->width && a->v1 < s->height;
}

/* The block along an axis that holds a coordinate, clamped to the picture. */
static int32_t block_at(const cs_sampler *s, double u, int32_t size) {
  return (int32_t)cs_number_clamp(u, 0, size - 1) / CS_PICTURE_BLOCK >> s->level;
}

static cs_picture_opacity opacity_of_blocks(cs_block_cache *blocks, const cs_sampler *s,
                                            const area *a, int64_t most) {
  int32_t left = block_at(s, a->u0, s->width), right = block_at(s, a->u1, s->width);
  int32_t top = block_at(s, a->v0, s->height), bottom = block_at(s, a->v1, s->height);
  if ((int64_t)(right - left + 1) * (bottom - top + 1) > most)
    return CS_PICTURE_MIXED;
  cs_picture_opacity opacity = CS_PICTURE_MIXED;
  for (int32_t row = top; row <= bottom; row++)
    for (int32_t column = left; column <= right; column++) {
      const cs_block_cache_slot *slot =
          cs_block_cache_slot_of(blocks, &s->source, s->level, column, row);
      cs_picture_opacity next = slot->texels ? slot->opacity : CS_PICTURE_MIXED;
      bool is_first = row == top && column == left;
      if (next == CS_PICTURE_MIXED || (!is_first && next != opacity))
        return CS_PICTURE_MIXED;
      opacity = next;
    }
  return opacity;
}

/* Whether the block in the middle of the area is mixed, or has no texels: a quick answer, since the
 * area then counts as mixed. */
static bool is_mixed_inside(cs_block_cache *blocks, const cs_sampler *s, const area *a) {
  double u = 0.5 * (a->u0 + a->u1), v = 0.5 * (a->v0 + a->v1);
  if (!(u >= 0 && v >= 0 && u < s->width && v < s->height))
    return false;
  const cs_block_cache_slot *slot = cs_block_cache_slot_of(
      blocks, &s->source, s->level, (int32_t)u / CS_PICTURE_BLOCK >> s->level,
      (int32_t)v / CS_PICTURE_BLOCK >> s->level);
  return !slot->texels || slot->opacity == CS_PICTURE_MIXED;
}

static cs_picture_opacity opacity_of(cs_block_cache *blocks, const cs_sampler *s, const area *a,
                                     int64_t most) {
  if (is_mixed_inside(blocks, s, a))
    return CS_PICTURE_MIXED;
  bool is_clear = s->wrap == CELSPAN_WRAP_CLEAR, is_within_picture = is_within(s, a);
  if (is_clear && is_beyond(s, a))
    return CS_PICTURE_CLEAR;
  if (!is_within_picture && s->wrap == CELSPAN_WRAP_REPEAT)
    return CS_PICTURE_MIXED;
  cs_picture_opacity opacity = opacity_of_blocks(blocks, s, a, most);
  return opacity == CS_PICTURE_OPAQUE && !is_within_picture && is_clear ? CS_PICTURE_MIXED
                                                                        : opacity;
}

/* Narrows the rows until one edge of an area along an axis, which moves by a pixel of the picture
 * in `rows_each` rows, meets an edge of a block or of the picture. */
static inline void narrow(const cs_sampler *s, double edge, double rows_each, int32_t size,
                          double y, cs_block_cache_opacity *out) {
  const int32_t block = CS_PICTURE_BLOCK << s->level;
  double below = -INFINITY, above = 0;
  if (edge >= 0) {
    below = edge >= size ? size : (double)((int32_t)edge / block * block);
    above = edge >= size ? INFINITY : cs_number_least(below + block, size);
  }
  double before = (below - edge) * rows_each, after = (above - edge) * rows_each;
  out->from = cs_number_most(out->from, y + cs_number_least(before, after) + SURELY);
  out->to = cs_number_least(out->to, y + cs_number_most(before, after) - SURELY);
}

/* The same for both edges, which move by `step` a row. */
static inline void narrow_axis(const cs_sampler *s, double low, double high, double step,
                               int32_t size, double y, cs_block_cache_opacity *out) {
  if (step == 0)
    return;
  double rows_each = 1 / step;
  narrow(s, low, rows_each, size, y, out);
  narrow(s, high, rows_each, size, y, out);
}

static void find_opacity(cs_block_cache *blocks, const cs_sampler *s, cs_run run,
                         cs_block_cache_opacity *out) {
  area a = area_of(s, run);
  int64_t parts = (run.x1 - run.x0) / s->opacity_columns,
          most = MOST_BLOCKS * (parts > 1 ? parts : 1);
  cs_block_cache_opacity found = {.sampler = s,
                                  .x0 = run.x0,
                                  .x1 = run.x1,
                                  .from = -INFINITY,
                                  .to = INFINITY,
                                  .opacity = opacity_of(blocks, s, &a, most)};
  narrow_axis(s, a.u0, a.u1, s->m[1], s->width, run.y, &found);
  narrow_axis(s, a.v0, a.v1, s->m[4], s->height, run.y, &found);
  *out = found;
}

celspan_status cs_sampler_opacity(cs_block_cache *blocks, const cs_sampler *s, cs_run run,
                                  cs_picture_opacity *out) {
  bool is_wide = run.x1 - run.x0 > s->opacity_columns;
  uint32_t place = (uint32_t)(run.x0 / s->opacity_columns) + 333 * (uint32_t)is_wide;
  cs_block_cache_opacity *kept =
      &blocks->opacities[(place + s->source.salt) % CS_BLOCK_CACHE_OPACITIES];
  *out = CS_PICTURE_MIXED;
  blocks->status = CELSPAN_OK;
  if (s->placement == CS_SAMPLER_PERSPECTIVE)
    return CELSPAN_OK;
  if (!(kept->sampler == s && kept->x0 == run.x0 && kept->x1 == run.x1 && run.y >= kept->from &&
        run.y < kept->to))
    find_opacity(blocks, s, run, kept);
  *out = kept->opacity;
  if (blocks->status != CELSPAN_OK)
    kept->sampler = NULL;
  return blocks->status;
}
