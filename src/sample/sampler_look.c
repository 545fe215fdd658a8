/* An answer holds as long as the same blocks are asked, which is for many rows: it is kept with the
 * heights between which they surely are. So it depends on nothing but the columns and the row.
 */
#include "sample/sampler_parts.h"

#define MOST_BLOCKS 12 /* looked at for as many columns as the sampler wants looked at */
#define SURELY 1e-3    /* of a row: what rounding may move an edge of a block */

/* A rectangle of the picture, in its pixels. */
typedef struct area {
  double u0, v0, u1, v1;
} area;

/* All that the samples of [x0, x1) may come from. */
static area area_of(const cs_sampler *s, int32_t x0, int32_t x1, double y) {
  const double *m = s->m;
  double left = x0 + 0.5, right = x1 - 0.5, reach = s->reach;
  double ua = m[0] * left + m[1] * y + m[2], ub = m[0] * right + m[1] * y + m[2];
  double va = m[3] * left + m[4] * y + m[5], vb = m[3] * right + m[4] * y + m[5];
  return (area){(ua < ub ? ua : ub) - reach, (va < vb ? va : vb) - reach,
                (ua < ub ? ub : ua) + reach, (va < vb ? vb : va) + reach};
}

static bool is_beyond(const cs_sampler *s, const area *a) {
  return a->u1 < 0 || a->v1 < 0 || a->u0 >= s->width || a->v0 >= s->height;
}

static bool is_within(const cs_sampler *s, const area *a) {
  return a->u0 >= 0 && a->v0 >= 0 && a->u1 < s->width && a->v1 < s->height;
}

/* The block along an axis that holds a coordinate, held to the picture. */
static int32_t block_at(const cs_sampler *s, double u, int32_t size) {
  return (int32_t)cs_number_clamp(u, 0, size - 1) / CS_PICTURE_BLOCK >> s->level;
}

static cs_picture_opacity look_at_blocks(cs_block_cache *texels, const cs_sampler *s, const area *a,
                                         int64_t most) {
  int32_t left = block_at(s, a->u0, s->width), right = block_at(s, a->u1, s->width);
  int32_t top = block_at(s, a->v0, s->height), bottom = block_at(s, a->v1, s->height);
  if ((int64_t)(right - left + 1) * (bottom - top + 1) > most)
    return CS_PICTURE_MIXED;
  cs_picture_opacity look = CS_PICTURE_MIXED;
  for (int32_t row = top; row <= bottom; row++)
    for (int32_t column = left; column <= right; column++) {
      const cs_block_cache_slot *slot =
          cs_block_cache_slot_of(texels, &s->source, s->level, column, row);
      cs_picture_opacity next = slot->texels ? slot->look : CS_PICTURE_MIXED;
      bool is_first = row == top && column == left;
      if (next == CS_PICTURE_MIXED || (!is_first && next != look))
        return CS_PICTURE_MIXED;
      look = next;
    }
  return look;
}

/* A quick answer, where there is one: that of the block in the middle, which is one of the
 * area's. */
static bool is_mixed_amid(cs_block_cache *texels, const cs_sampler *s, const area *a) {
  double u = 0.5 * (a->u0 + a->u1), v = 0.5 * (a->v0 + a->v1);
  if (!(u >= 0 && v >= 0 && u < s->width && v < s->height))
    return false;
  const cs_block_cache_slot *slot = cs_block_cache_slot_of(
      texels, &s->source, s->level, (int32_t)u / CS_PICTURE_BLOCK >> s->level,
      (int32_t)v / CS_PICTURE_BLOCK >> s->level);
  return !slot->texels || slot->look == CS_PICTURE_MIXED;
}

static cs_picture_opacity look_at(cs_block_cache *texels, const cs_sampler *s, const area *a,
                                  int64_t most) {
  if (is_mixed_amid(texels, s, a))
    return CS_PICTURE_MIXED;
  bool is_clear = s->wrap == CELSPAN_WRAP_CLEAR, is_within_picture = is_within(s, a);
  if (is_clear && is_beyond(s, a))
    return CS_PICTURE_CLEAR;
  if (!is_within_picture && s->wrap == CELSPAN_WRAP_REPEAT)
    return CS_PICTURE_MIXED;
  cs_picture_opacity look = look_at_blocks(texels, s, a, most);
  return look == CS_PICTURE_OPAQUE && !is_within_picture && is_clear ? CS_PICTURE_MIXED : look;
}

/* Narrows the rows until an edge of an area, which moves by `step` a row, meets the edge of a block
 * or of the picture. */
static void narrow(const cs_sampler *s, double edge, double step, int32_t size, double y,
                   cs_block_cache_look *out) {
  double block = (double)CS_PICTURE_BLOCK * (double)((int64_t)1 << s->level);
  double below = edge < 0 ? -INFINITY : edge >= size ? size : floor(edge / block) * block;
  double above = edge < 0 ? 0 : edge >= size ? INFINITY : fmin(below + block, size);
  if (step == 0)
    return;
  double before = (below - edge) / step, after = (above - edge) / step;
  out->from = fmax(out->from, y + fmin(before, after) + SURELY);
  out->to = fmin(out->to, y + fmax(before, after) - SURELY);
}

static void look_anew(cs_block_cache *texels, const cs_sampler *s, int32_t x0, int32_t x1, double y,
                      cs_block_cache_look *out) {
  area a = area_of(s, x0, x1, y);
  int64_t parts = (x1 - x0) / s->look_columns, most = MOST_BLOCKS * (parts > 1 ? parts : 1);
  cs_block_cache_look found = {.sampler = s,
                               .x0 = x0,
                               .x1 = x1,
                               .from = -INFINITY,
                               .to = INFINITY,
                               .look = look_at(texels, s, &a, most)};
  narrow(s, a.u0, s->m[1], s->width, y, &found);
  narrow(s, a.u1, s->m[1], s->width, y, &found);
  narrow(s, a.v0, s->m[4], s->height, y, &found);
  narrow(s, a.v1, s->m[4], s->height, y, &found);
  *out = found;
}

celspan_status cs_sampler_look(cs_block_cache *texels, const cs_sampler *s, int32_t x0, int32_t x1,
                               double y, cs_picture_opacity *out) {
  uint32_t place = (uint32_t)(x0 / s->look_columns) + 333 * (uint32_t)(x1 - x0 > s->look_columns);
  cs_block_cache_look *kept = &texels->looks[(place + s->source.salt) % CS_BLOCK_CACHE_LOOKS];
  *out = CS_PICTURE_MIXED;
  texels->status = CELSPAN_OK;
  if (s->way == CS_SAMPLER_PERSPECTIVE)
    return CELSPAN_OK;
  if (!(kept->sampler == s && kept->x0 == x0 && kept->x1 == x1 && y >= kept->from && y < kept->to))
    look_anew(texels, s, x0, x1, y, kept);
  *out = kept->look;
  if (texels->status != CELSPAN_OK)
    kept->sampler = NULL;
  return texels->status;
}
