/* Loops over the registers of pixels: see over_channels.h. */
#include "engine/paint/over_channels.h"

#include "engine/paint/shade_stretch.h"
#include "model/colour/srgb8_lanes.h"

void CS_WIDE(cs_over_channels_clear)(cs_over_channels *pixels, int32_t count) {
  pixels->count = count;
  pixels->keep = 1;
  for (int32_t k = 0; k < count; k += CS_WIDE_LANES) {
    for (int c = 0; c < 3; c++)
      cs_wide_store(pixels->light[c] + k, cs_wide_all(0));
    cs_wide_store(pixels->through + k, cs_wide_all(1));
  }
}

void CS_WIDE(cs_over_channels_add_flat)(cs_over_channels *pixels, const cs_over_pair *lit) {
  for (int32_t k = 0; k < pixels->count; k += CS_WIDE_LANES) {
    const cs_wide through = cs_wide_load(pixels->through + k);
    for (int c = 0; c < 3; c++) {
      float *light = pixels->light[c] + k;
      cs_wide_store(light, cs_wide_load(light) + through * lit->e[c]);
    }
    cs_wide_store(pixels->through + k, through * lit->t[0]);
  }
}

void CS_WIDE(cs_over_channels_add_light)(cs_over_channels *pixels, const float light[4]) {
  for (int32_t k = 0; k < pixels->count; k += CS_WIDE_LANES)
    for (int c = 0; c < 3; c++) {
      float *to = pixels->light[c] + k;
      cs_wide_store(to, cs_wide_load(to) + cs_wide_load(pixels->through + k) * light[c]);
    }
}

void CS_WIDE(cs_over_channels_light)(cs_over_channels *pixels, const cs_over_channels *front) {
  const cs_wide brightest = cs_wide_all(CS_LAYER_BRIGHTEST);
  for (int32_t k = 0; k < pixels->count; k += CS_WIDE_LANES)
    for (int c = 0; c < 3; c++) {
      float *light = pixels->light[c] + k;
      const cs_wide lit = cs_wide_load(light) * cs_wide_load(front->light[c] + k);
      cs_wide_store(light, cs_wide_choose(lit > brightest, brightest, lit));
    }
}

/* ---------------------------------------------------------------- gradients */

enum { ROOM = CS_SHADE_PLACES + CS_WIDE_LANES }; /* whole registers are read and written */

static_assert(CS_OVER_ROW_BATCH <= CS_SHADE_PLACES, "the places of a batch are found together");

/* The pixels of a batch, as pixels of a layer with a gradient. */
typedef struct piece {
  const cs_layer *layer;
  const cs_shade *shade;
  const cs_batch *batch;
  int32_t count;
  double at[ROOM]; /* where they lie along the stops */
} piece;

static inline int32_t whole(int32_t count) {
  return (count + CS_WIDE_LANES - 1) / CS_WIDE_LANES * CS_WIDE_LANES;
}

/* is_radial, has_focus: constants of each caller. */
static inline void find_affine(piece *p, bool is_radial, bool has_focus) {
  const cs_shade_row row = cs_shade_row_of(p->shade, p->batch->y);
  for (int32_t k = 0; k < p->count; k += CS_WIDE_LANES) {
    const double x = p->batch->x0 + k + 0.5;
#pragma omp simd
    for (int32_t i = 0; i < CS_WIDE_LANES; i++)
      p->at[k + i] = cs_shade_row_at(&row, x + i, is_radial, has_focus);
  }
}

static void find_listed(piece *p) {
  double x[ROOM];
  for (int32_t k = 0; k < p->count; k++)
    x[k] = cs_batch_centre(p->batch, k);
  cs_shade_find(p->shade, x, p->count, p->batch->y, p->at);
  for (int32_t k = p->count; k < whole(p->count); k++)
    p->at[k] = p->at[p->count - 1];
}

static inline void find_places(piece *p) {
  const celspan_texture *texture = p->shade->texture;
  if (p->batch->columns || !p->shade->is_affine ||
      (texture->kind != CS_TEXTURE_RADIAL && texture->kind != CS_TEXTURE_LINEAR))
    find_listed(p);
  else if (texture->kind == CS_TEXTURE_LINEAR)
    find_affine(p, false, false);
  else if (p->shade->eccentricity > 0)
    find_affine(p, true, true);
  else
    find_affine(p, true, false);
}

/* The paints of a stretch, in all lanes. */
typedef struct paints {
  cs_wide s[3], t, s_step[3], t_step;
} paints;

static inline paints paints_of(const cs_shade_stretch *part) {
  const cs_wide none = {0}; /* a number less 0 is the number in all lanes */
  paints out;
  for (int c = 0; c < 3; c++) {
    out.s[c] = part->paint.s[c] - none;
    out.s_step[c] = part->step.s[c] - none;
  }
  out.t = part->paint.t[0] - none;
  out.t_step = part->step.t[0] - none;
  return out;
}

/* Adds pixels of register k whose shares of the way along a stretch are known. is_lit, a constant
 * of each caller: light and fade change paints. mask: the lanes of these pixels; the others are
 * kept. */
static inline void add_lanes(cs_over_channels *pixels, size_t k, const paints *r,
                             const cs_layer *layer, cs_wide share, cs_wide_int mask, bool is_lit) {
  const float fade = layer->fade;
  const cs_wide through = cs_wide_load(pixels->through + k);
  for (int c = 0; c < 3; c++) {
    float *light = pixels->light[c] + k;
    const cs_wide before = cs_wide_load(light), s = r->s[c] + share * r->s_step[c];
    const cs_wide after = before + through * (is_lit ? layer->front[c] * (fade * s) : s);
    cs_wide_store(light, cs_wide_choose(mask, after, before));
  }
  const cs_wide t = r->t + share * r->t_step;
  const cs_wide after = through * (is_lit ? (1 - fade) + fade * t : t);
  cs_wide_store(pixels->through + k, cs_wide_choose(mask, after, through));
}

static inline cs_wide shares_of(const cs_shade_stretch *part, const double *at) {
  float shares[CS_WIDE_LANES];
  cs_shade_stretch_shares(part, at, CS_WIDE_LANES, shares);
  return cs_wide_load(shares);
}

enum { ALL = (1 << CS_WIDE_LANES) - 1 };

/* A bit for each lane whose place lies in a stretch. */
static inline unsigned lanes_in(const cs_shade_stretch *part, const double *at) {
  unsigned lanes = 0;
#if defined(__AVX512F__)
  for (int i = 0; i < CS_WIDE_LANES; i += 8) {
    const __m512d v = _mm512_loadu_pd(at + i);
    const __mmask8 begun = _mm512_cmp_pd_mask(v, _mm512_set1_pd(part->from), _CMP_GE_OQ);
    lanes |= (unsigned)_mm512_mask_cmp_pd_mask(begun, v, _mm512_set1_pd(part->to), _CMP_LT_OQ) << i;
  }
#elif defined(__AVX2__)
  for (int i = 0; i < CS_WIDE_LANES; i += 4) {
    const __m256d v = _mm256_loadu_pd(at + i);
    const __m256d begun = _mm256_cmp_pd(v, _mm256_set1_pd(part->from), _CMP_GE_OQ);
    const __m256d ends = _mm256_cmp_pd(v, _mm256_set1_pd(part->to), _CMP_LT_OQ);
    lanes |= (unsigned)_mm256_movemask_pd(_mm256_and_pd(begun, ends)) << i;
  }
#else
  for (int i = 0; i < CS_WIDE_LANES; i++)
    lanes |= (unsigned)(at[i] >= part->from && at[i] < part->to) << i;
#endif
  return lanes;
}

static inline cs_wide_int mask_of(unsigned lanes) {
  cs_wide_int bits;
  for (int i = 0; i < CS_WIDE_LANES; i++)
    bits[i] = 1 << i;
  return (bits & (int32_t)lanes) != 0;
}

/* Whether all shares are above 0 and below 1: then their places lie in the stretch, since rounding
 * keeps the order of places. */
static inline bool are_shares(cs_wide shares) {
  return !cs_wide_any(~((shares > 0) & (shares < 1)));
}

/* Adds the registers from pixel k of the piece on that lie in a stretch as a whole, if its paints
 * change. Returns the pixel after them. */
static inline size_t add_whole(cs_over_channels *pixels, const piece *p,
                               const cs_shade_stretch *part, size_t k, bool is_lit) {
  const size_t count = part->length != 0 ? (size_t)p->count : 0;
  const cs_shade_stretch own = *part; /* the compiler sees that nothing changes it */
  const paints r = paints_of(part);
  for (; k < count; k += CS_WIDE_LANES) {
    const cs_wide shares = shares_of(&own, p->at + k);
    if (!are_shares(shares))
      break;
    add_lanes(pixels, k, &r, p->layer, shares, mask_of(ALL), is_lit);
  }
  return k;
}

/* Adds a register that lies in several stretches, the first of them perhaps a known one. Returns
 * the last. */
static inline cs_shade_stretch add_mixed(cs_over_channels *pixels, const piece *p,
                                         cs_shade_stretch part, size_t k, bool is_lit) {
  const double *at = p->at + k;
  for (unsigned rest = ALL, lanes; rest != 0; rest &= ~lanes) {
    lanes = lanes_in(&part, at) & rest;
    if (lanes == 0) {
      const int lane = __builtin_ctz(rest);
      part = cs_shade_stretch_at(p->shade->texture, at[lane]);
      lanes = (lanes_in(&part, at) | 1u << lane) & rest;
    }
    const paints r = paints_of(&part);
    add_lanes(pixels, k, &r, p->layer, shares_of(&part, at), mask_of(lanes), is_lit);
  }
  return part;
}

/* Whole registers: what lies in the lanes after the last pixel is not read. */
static inline void add_piece(cs_over_channels *pixels, piece *p, bool is_lit) {
  find_places(p);
  const size_t count = (size_t)p->count;
  cs_shade_stretch part = cs_shade_stretch_at(p->shade->texture, p->at[0]);
  for (size_t k = 0; k < count; k += CS_WIDE_LANES) {
    k = add_whole(pixels, p, &part, k, is_lit);
    if (k < count)
      part = add_mixed(pixels, p, part, k, is_lit);
  }
}

void CS_WIDE(cs_over_channels_add_shade)(cs_over_channels *pixels, const cs_layer *layer,
                                         const cs_shade *shade, const cs_batch *batch) {
  piece p; /* not all of it is needed */
  p.layer = layer;
  p.shade = shade;
  p.batch = batch;
  p.count = pixels->count;
  if (cs_shade_is_bare(layer))
    add_piece(pixels, &p, false);
  else
    add_piece(pixels, &p, true);
}

void CS_WIDE(cs_over_channels_to_codes)(const cs_over_channels *pixels, int32_t first,
                                        int32_t count, unsigned char *out) {
  for (int32_t k = 0; k < count; k += CS_WIDE_LANES) {
    cs_srgb8_planes colours;
    for (int c = 0; c < 3; c++)
      colours.channels[c] = cs_wide_load(pixels->light[c] + first + k);
    colours.channels[3] = 1 - pixels->keep * cs_wide_load(pixels->through + first + k);
    const cs_wide_int codes = cs_srgb8_code_planes(&colours, false);
    const int32_t left = count - k;
    memcpy(out + 4 * (size_t)k, &codes, 4 * (size_t)(left < CS_WIDE_LANES ? left : CS_WIDE_LANES));
  }
}
