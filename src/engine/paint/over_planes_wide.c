/* Loops over the registers of planes: see over_planes.h. */
#include "engine/paint/over_planes.h"

#include "engine/paint/shade_stretch.h"
#include "model/colour/srgb8_lanes.h"

void CS_WIDE(cs_over_planes_clear)(cs_over_planes *planes, int32_t count) {
  planes->count = count;
  planes->keep = 1;
  for (int32_t k = 0; k < count; k += CS_WIDE_LANES) {
    for (int c = 0; c < 3; c++)
      cs_wide_store(planes->light[c] + k, cs_wide_all(0));
    cs_wide_store(planes->through + k, cs_wide_all(1));
  }
}

void CS_WIDE(cs_over_planes_add_flat)(cs_over_planes *planes, const cs_over_pair *lit) {
  for (int32_t k = 0; k < planes->count; k += CS_WIDE_LANES) {
    const cs_wide through = cs_wide_load(planes->through + k);
    for (int c = 0; c < 3; c++) {
      float *light = planes->light[c] + k;
      cs_wide_store(light, cs_wide_load(light) + through * lit->e[c]);
    }
    cs_wide_store(planes->through + k, through * lit->t[0]);
  }
}

void CS_WIDE(cs_over_planes_add_light)(cs_over_planes *planes, const float light[4]) {
  for (int32_t k = 0; k < planes->count; k += CS_WIDE_LANES)
    for (int c = 0; c < 3; c++) {
      float *to = planes->light[c] + k;
      cs_wide_store(to, cs_wide_load(to) + cs_wide_load(planes->through + k) * light[c]);
    }
}

/* ---------------------------------------------------------------- gradients */

enum { ROOM = CS_SHADE_PLACES + CS_WIDE_LANES }; /* whole registers are read and written */

/* Up to CS_SHADE_PLACES pixels of a layer with a gradient. */
typedef struct piece {
  const cs_layer *layer;
  const cs_shade *shade;
  const cs_batch *batch;
  int32_t first, count; /* of the batch's pixels */
  double at[ROOM];      /* where they lie along the stops */
  float shares[ROOM];
} piece;

static inline int32_t whole(int32_t count) {
  return (count + CS_WIDE_LANES - 1) / CS_WIDE_LANES * CS_WIDE_LANES;
}

/* is_radial: a constant of each caller. */
static inline void find_affine(piece *p, bool is_radial) {
  const cs_shade_row row = cs_shade_row_of(p->shade, p->batch->y);
  const double x0 = p->batch->x0 + p->first + 0.5;
  const int32_t count = whole(p->count);
#pragma omp simd
  for (int32_t k = 0; k < count; k++)
    p->at[k] = cs_shade_row_at(&row, x0 + k, is_radial);
}

static void find_listed(piece *p) {
  double x[ROOM];
  for (int32_t k = 0; k < p->count; k++)
    x[k] = cs_batch_centre(p->batch, p->first + k);
  cs_shade_find(p->shade, x, p->count, p->batch->y, p->at);
  for (int32_t k = p->count; k < whole(p->count); k++)
    p->at[k] = p->at[p->count - 1];
}

static inline void find_places(piece *p) {
  const celspan_texture *texture = p->shade->texture;
  if (p->batch->columns || !p->shade->is_affine ||
      (texture->kind != CS_TEXTURE_RADIAL && texture->kind != CS_TEXTURE_LINEAR))
    find_listed(p);
  else if (texture->kind == CS_TEXTURE_RADIAL)
    find_affine(p, true);
  else
    find_affine(p, false);
}

/* One register of a stretch, of pixels from k on. is_lit, a constant of each caller: light and fade
 * change paints. mask: the lanes that lie in the stretch; the others are kept. */
static inline void add_register(cs_over_planes *planes, const cs_layer *layer,
                                const cs_shade_stretch *part, cs_wide share, cs_wide_int mask,
                                int32_t k, bool is_lit) {
  const float fade = layer->fade;
  const cs_wide through = cs_wide_load(planes->through + k);
  for (int c = 0; c < 3; c++) {
    float *light = planes->light[c] + k;
    const cs_wide before = cs_wide_load(light), s = part->paint.s[c] + share * part->step.s[c];
    const cs_wide after = before + through * (is_lit ? layer->front[c] * (fade * s) : s);
    cs_wide_store(light, cs_wide_choose(mask, after, before));
  }
  const cs_wide t = part->paint.t[0] + share * part->step.t[0];
  const cs_wide after = through * (is_lit ? (1 - fade) + fade * t : t);
  cs_wide_store(planes->through + k, cs_wide_choose(mask, after, through));
}

/* The first lanes of a register. */
static inline cs_wide_int first_lanes(int32_t count) {
  cs_wide_int number;
  for (int i = 0; i < CS_WIDE_LANES; i++)
    number[i] = i;
  return number < count;
}

/* Pixels that lie in a stretch, from pixel `first` of the piece on. */
static inline void add_stretch(cs_over_planes *planes, const piece *p, const cs_shade_stretch *part,
                               int32_t first, int32_t count, bool is_lit) {
  const cs_shade_stretch own = *part; /* the compiler sees that nothing changes it */
  const cs_layer *layer = p->layer;
  const int32_t from = p->first + first;
  const cs_wide_int all = first_lanes(CS_WIDE_LANES);
  int32_t i = 0;
  for (; i + CS_WIDE_LANES <= count; i += CS_WIDE_LANES)
    add_register(planes, layer, &own, cs_wide_load(p->shares + i), all, from + i, is_lit);
  if (i < count)
    add_register(planes, layer, &own, cs_wide_load(p->shares + i), first_lanes(count - i), from + i,
                 is_lit);
}

static inline void add_piece(cs_over_planes *planes, piece *p, bool is_lit) {
  find_places(p);
  for (int32_t k = 0, count; k < p->count; k += count) {
    const cs_shade_stretch part = cs_shade_find_stretch(p->shade, p->at[k]);
    count = cs_shade_stretch_extent(&part, p->at + k, p->count - k);
    cs_shade_stretch_shares(&part, p->at + k, whole(count), p->shares);
    add_stretch(planes, p, &part, k, count, is_lit);
  }
}

void CS_WIDE(cs_over_planes_add_shade)(cs_over_planes *planes, const cs_layer *layer,
                                       const cs_shade *shade, const cs_batch *batch) {
  piece p;
  p.layer = layer;
  p.shade = shade;
  p.batch = batch;
  p.first = 0;
  const bool is_lit = !cs_shade_is_bare(layer);
  for (; p.first < planes->count; p.first += p.count) {
    const int32_t left = planes->count - p.first;
    p.count = left < CS_SHADE_PLACES ? left : CS_SHADE_PLACES;
    if (is_lit)
      add_piece(planes, &p, true);
    else
      add_piece(planes, &p, false);
  }
}

void CS_WIDE(cs_over_planes_to_codes)(const cs_over_planes *planes, int32_t first, int32_t count,
                                      unsigned char *out) {
  for (int32_t k = 0; k < count; k += CS_WIDE_LANES) {
    cs_srgb8_planes colours;
    for (int c = 0; c < 3; c++)
      colours.channels[c] = cs_wide_load(planes->light[c] + first + k);
    colours.channels[3] = 1 - planes->keep * cs_wide_load(planes->through + first + k);
    const cs_wide_int pixels = cs_srgb8_code_planes(&colours, false);
    const int32_t left = count - k;
    memcpy(out + 4 * (size_t)k, &pixels, 4 * (size_t)(left < CS_WIDE_LANES ? left : CS_WIDE_LANES));
  }
}
