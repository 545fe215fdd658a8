#include "engine/sample/sampler.h"

#include "engine/sample/sampler_codes.h"
#include "engine/sample/sampler_level.h"
#include "engine/sample/sampler_pixel.h"
#include "engine/sample/sampler_row.h"
#include "engine/sample/sampler_taps.h"
#include "model/colour/srgb8_decode.h"

#define SAME_SCALE 1e-12

/* ---------------------------------------------------------------- how samples are made */

typedef struct footprint {
  double ux, vx; /* how the place on the picture moves with each pixel to the right */
  double uy, vy; /* how it moves with each pixel down */
} footprint;

static bool is_copy(const double m[9]) {
  return fabs(m[0] - 1) <= SAME_SCALE && fabs(m[4] - 1) <= SAME_SCALE && fabs(m[1]) <= SAME_SCALE &&
         fabs(m[3]) <= SAME_SCALE && fabs(m[2] - rint(m[2])) <= CS_SAMPLER_SAME &&
         fabs(m[5] - rint(m[5])) <= CS_SAMPLER_SAME && fabs(m[2]) < 1e9 && fabs(m[5]) < 1e9;
}

static bool is_enlarged(const footprint *f) {
  double wide = fabs(f->ux) + fabs(f->uy), high = fabs(f->vx) + fabs(f->vy);
  double right = f->ux * f->ux + f->vx * f->vx, below = f->uy * f->uy + f->vy * f->vy;
  const double most = 1 + CS_SAMPLER_SAME;
  return (wide <= most && high <= most) || (right <= most && below <= most);
}

static void plan_tilted(cs_sampler *s, const footprint *f) {
  double right = f->ux * f->ux + f->vx * f->vx, below = f->uy * f->uy + f->vy * f->vy;
  double shorter = sqrt(fmin(right, below)), longer = sqrt(fmax(right, below));
  s->kernel = CS_SAMPLER_TILTED;
  s->level = cs_sampler_level(s->level_count, shorter, longer, CS_SAMPLER_TAP_TEXELS,
                              CS_SAMPLER_MOST_TAPS);
  double texel = (double)((int64_t)1 << s->level);
  s->columns = cs_sampler_tap_count(right, texel);
  s->rows = cs_sampler_tap_count(below, texel);
}

static void plan_box(cs_sampler *s, const footprint *f) {
  double wide = fabs(f->ux) + fabs(f->uy), high = fabs(f->vx) + fabs(f->vy);
  wide = wide > 1 + CS_SAMPLER_SAME ? wide : 1;
  high = high > 1 + CS_SAMPLER_SAME ? high : 1;
  s->kernel = CS_SAMPLER_BOX;
  /* Smaller levels of a picture in tiles are files, which are read in place of its many pixels. */
  double texels = s->picture->tiles.size > 0 ? 1 : CS_SAMPLER_BOX_TEXELS;
  s->level = cs_sampler_level(s->level_count, wide < high ? wide : high, wide < high ? high : wide,
                              texels, CS_SAMPLER_MOST_BOX);
  double most = (double)((int64_t)CS_SAMPLER_MOST_BOX << s->level);
  s->wide = wide < most ? wide : most;
  s->high = high < most ? high : most;
}

static void plan_affine(cs_sampler *s) {
  footprint f = {.ux = s->m[0], .vx = s->m[3], .uy = s->m[1], .vy = s->m[4]};
  double kept = fabs(f.ux) + fabs(f.vy), crossed = fabs(f.vx) + fabs(f.uy);
  bool is_upright = crossed <= SAME_SCALE * kept, is_sideways = kept <= SAME_SCALE * crossed;
  s->placement = is_upright ? CS_SAMPLER_UPRIGHT : CS_SAMPLER_AFFINE;
  if (s->sampling == CELSPAN_SAMPLING_NEAREST) {
    s->kernel = CS_SAMPLER_NEAREST;
  } else if (s->sampling == CELSPAN_SAMPLING_BICUBIC && is_enlarged(&f)) {
    s->kernel = CS_SAMPLER_BICUBIC;
    s->placement = CS_SAMPLER_SINGLE;
  } else if (s->sampling == CELSPAN_SAMPLING_BILINEAR || is_enlarged(&f)) {
    s->kernel = CS_SAMPLER_BILINEAR;
  } else if (is_upright || is_sideways) {
    plan_box(s, &f);
    s->placement = is_upright ? CS_SAMPLER_UPRIGHT : CS_SAMPLER_SINGLE;
  } else {
    plan_tilted(s, &f);
  }
}

static cs_sampler_kernel perspective_kernel(celspan_sampling sampling) {
  switch (sampling) {
  case CELSPAN_SAMPLING_NEAREST:
    return CS_SAMPLER_NEAREST;
  case CELSPAN_SAMPLING_BILINEAR:
    return CS_SAMPLER_BILINEAR;
  case CELSPAN_SAMPLING_BICUBIC:
    return CS_SAMPLER_BICUBIC;
  case CELSPAN_SAMPLING_AUTO:
    break;
  }
  return CS_SAMPLER_TILTED;
}

/* How far from its centre the texels of a sample may lie, in picture pixels. */
static double radius_of(const cs_sampler *s) {
  double texel = (double)((int64_t)1 << s->level);
  double slant = fabs(s->m[0]) + fabs(s->m[1]), fall = fabs(s->m[3]) + fabs(s->m[4]);
  switch (s->placement == CS_SAMPLER_COPY ? CS_SAMPLER_NEAREST : s->kernel) {
  case CS_SAMPLER_NEAREST:
    return 0.25;
  case CS_SAMPLER_BILINEAR:
    return 0.51;
  case CS_SAMPLER_BICUBIC:
    return 2;
  case CS_SAMPLER_BOX:
    return 0.5 * fmax(s->wide, s->high) + texel;
  case CS_SAMPLER_TILTED:
    return 0.5 * fmax(slant, fall) + texel;
  }
  return INFINITY;
}

/* As many columns as lie on the texels of one block, a power of two. */
static int32_t opacity_columns(const cs_sampler *s) {
  double across = fmax(fabs(s->m[0]), fabs(s->m[3]));
  int32_t columns = CS_PICTURE_BLOCK;
  while (columns < 1 << 20 && 2 * columns * across <= CS_PICTURE_BLOCK)
    columns *= 2;
  return columns;
}

void cs_sampler_prepare(cs_sampler *s) {
  s->source = cs_block_cache_source_of(s->picture);
  s->reads_codes = cs_srgb8_decodes(s->isa);
  s->level_count = cs_mip_levels_count(s->width, s->height);
  memcpy(s->m, s->inverse.m, sizeof s->m);
  if (!(s->m[6] == 0 && s->m[7] == 0 && s->m[8] > 0)) {
    s->placement = CS_SAMPLER_PERSPECTIVE;
    s->kernel = perspective_kernel(s->sampling);
    s->opacity_columns = INT32_MAX;
    return;
  }
  for (int i = 0; i < 9; i++)
    s->m[i] /= s->inverse.m[8];
  if (is_copy(s->m)) {
    s->placement = CS_SAMPLER_COPY;
    s->moved_u = (int64_t)rint(s->m[2]);
    s->moved_v = (int64_t)rint(s->m[5]);
  } else
    plan_affine(s);
  s->radius = radius_of(s);
  s->opacity_columns = opacity_columns(s);
}

/* ---------------------------------------------------------------- copies */

static int32_t smaller(int32_t a, int32_t b) { return a < b ? a : b; }

/* The form in which a row of texels is copied. */
typedef enum copied { LIGHT, CODES } copied;

static void set_clear(int32_t count, cs_sampler_texels *out) {
  *out = (cs_sampler_texels){.count = count, .rows = 1, .opacity = CS_PICTURE_CLEAR};
}

/* The texels of a row from (x, y) on which lie in one block: `most` of them and `most_rows` rows at
 * most. They are written to their place once: a copy made at once of fields that were just stored
 * one by one would wait for the stores. */
static void find_in_block(const cs_sampling *run, int32_t x, int32_t y, int32_t most,
                          int32_t most_rows, cs_sampler_texels *out) {
  const cs_sampler *s = run->sampler;
  const cs_block_cache_slot *slot = cs_block_cache_slot_of(
      run->blocks, &s->source, 0, x / CS_PICTURE_BLOCK, y / CS_PICTURE_BLOCK);
  int32_t row = y % CS_PICTURE_BLOCK, column = x % CS_PICTURE_BLOCK;
  int32_t rows = smaller(most_rows, smaller(CS_PICTURE_BLOCK - row, s->height - y));
  most = smaller(most, smaller(CS_PICTURE_BLOCK - column, s->width - x));
  if (!slot->texels) /* it could not be read: the status of the blocks says why */
    set_clear(most, out);
  else
    *out = (cs_sampler_texels){.count = most,
                               .rows = rows,
                               .opacity = slot->opacity,
                               .are_coded = slot->codes,
                               .codes = slot->block->codes[row] + 4 * column,
                               .light = slot->texels + 4 * (CS_PICTURE_BLOCK * row + column)};
}

/* The same for row v from column u on. Both may lie outside the picture; the wrap mode then
 * decides. */
static void find_at(const cs_sampling *run, int64_t u, int64_t v, int32_t most,
                    cs_sampler_texels *out) {
  const cs_sampler *s = run->sampler;
  if (s->wrap == CELSPAN_WRAP_REPEAT) {
    u = ((u % s->width) + s->width) % s->width;
    v = ((v % s->height) + s->height) % s->height;
  }
  bool is_row_outside = v < 0 || v >= s->height, is_inside = u >= 0 && u < s->width;
  if (s->wrap == CELSPAN_WRAP_CLEAR && (is_row_outside || !is_inside)) {
    set_clear(!is_row_outside && u < 0 && -u < most ? (int32_t)-u : most, out);
    return;
  }
  int32_t y = v < 0 ? 0 : is_row_outside ? s->height - 1 : (int32_t)v;
  int32_t x = is_inside ? (int32_t)u : u < 0 ? 0 : s->width - 1;
  find_in_block(run, x, y, is_inside ? most : 1, is_row_outside ? 1 : CS_PICTURE_BLOCK, out);
}

static void find_texels(const cs_sampling *sampling, cs_run run, cs_sampler_texels *out) {
  const cs_sampler *s = sampling->sampler;
  find_at(sampling, run.x0 + s->moved_u, cs_number_floor(run.y) + s->moved_v, run.x1 - run.x0, out);
}

/* Copies texels. The row below is fetched into the cache now, so that it is there in time. */
static void copy_texels(const cs_sampling *run, const cs_sampler_texels *texels, copied what,
                        unsigned char *out) {
  const cs_sampler *s = run->sampler;
  bool reads_codes = what == CODES || (texels->are_coded && s->reads_codes);
  size_t texel = reads_codes ? 4 : 4 * sizeof(float), count = (size_t)texels->count;
  size_t row = texel * (reads_codes ? CS_PICTURE_CODES_ROW : CS_PICTURE_BLOCK);
  const char *from = reads_codes ? (const char *)texels->codes : (const char *)texels->light;
  if (!from) {
    memset(out, 0, count * (what == CODES ? 4 : 4 * sizeof(float)));
    return;
  }
  if (reads_codes && what == LIGHT)
    CS_WIDE_CHOOSE(s->isa, cs_sampler_decode_codes)
  (run->blocks->curve, texels->codes, texels->count, (float(*)[4])(void *)out);
  else memcpy(out, from, count * texel);
  for (size_t ahead = 0; ahead < count * texel; ahead += 64)
    __builtin_prefetch(from + row + ahead);
}

/* Returns whether the codes of all texels are exact. */
static bool copy_run(const cs_sampling *sampling, cs_run run, copied what, void *out) {
  const size_t size = what == CODES ? 4 : 4 * sizeof(float);
  unsigned char *to = out;
  bool are_exact = true;
  for (cs_sampler_texels texels; run.x0 < run.x1; run.x0 += texels.count) {
    find_texels(sampling, run, &texels);
    copy_texels(sampling, &texels, what, to);
    to += (size_t)texels.count * size;
    are_exact &= texels.are_coded || texels.opacity == CS_PICTURE_CLEAR;
  }
  return are_exact;
}

/* At most CS_SAMPLER_BATCH pixels as planes; false where their codes are not exact. */
static bool copy_planes(const cs_sampling *sampling, cs_run run, float (*planes)[4]) {
  unsigned char codes[4 * (CS_SAMPLER_BATCH + CS_SAMPLES_PLANE)];
  int32_t count = run.x1 - run.x0;
  memset(codes + 4 * (size_t)count, 0, 4 * CS_SAMPLES_PLANE);
  if (!copy_run(sampling, run, CODES, codes) || !sampling->blocks->curve)
    return false;
  CS_WIDE_CHOOSE(sampling->sampler->isa, cs_sampler_decode_planes)
  (sampling->blocks->curve, codes, count, planes);
  return true;
}

celspan_status cs_sampler_texels_at(cs_block_cache *blocks, const cs_sampler *sampler, cs_run run,
                                    cs_sampler_texels *out) {
  blocks->status = CELSPAN_OK;
  find_texels(&(cs_sampling){sampler, blocks}, run, out);
  return blocks->status;
}

celspan_status cs_sampler_codes(cs_block_cache *blocks, const cs_sampler *sampler, cs_run run,
                                unsigned char *codes) {
  blocks->status = CELSPAN_OK;
  copy_run(&(cs_sampling){sampler, blocks}, run, CODES, codes);
  return blocks->status;
}

/* ---------------------------------------------------------------- runs */

celspan_status cs_sampler_run(cs_block_cache *blocks, const cs_sampler *sampler, cs_run run,
                              float (*rgba)[4]) {
  cs_sampling sampling = {sampler, blocks};
  blocks->status = CELSPAN_OK;
  switch (sampler->placement) {
  case CS_SAMPLER_COPY:
    copy_run(&sampling, run, LIGHT, rgba);
    break;
  case CS_SAMPLER_UPRIGHT:
    cs_sampler_row_run(&sampling, run, rgba);
    break;
  case CS_SAMPLER_AFFINE:
  case CS_SAMPLER_PERSPECTIVE:
    cs_sampler_taps_run(&sampling, run, rgba);
    break;
  case CS_SAMPLER_SINGLE:
    cs_sampler_pixel_run(&sampling, run, rgba);
    break;
  }
  return blocks->status;
}

celspan_status cs_sampler_samples(cs_block_cache *blocks, const cs_sampler *sampler, cs_run run,
                                  cs_samples *out) {
  cs_sampling sampling = {sampler, blocks};
  blocks->status = CELSPAN_OK;
  out->are_planes = false;
  if (sampler->isa == CS_ISA_AVX512 && sampler->reads_codes)
    out->are_planes = sampler->placement == CS_SAMPLER_COPY
                          ? copy_planes(&sampling, run, out->rgba)
                          : cs_sampler_taps_planes(&sampling, run, out->rgba);
  return out->are_planes ? blocks->status : cs_sampler_run(blocks, sampler, run, out->rgba);
}

celspan_status cs_sampler_at(cs_block_cache *blocks, const cs_sampler *sampler,
                             const int32_t *columns, int32_t count, double y, float (*rgba)[4]) {
  if (sampler->placement != CS_SAMPLER_UPRIGHT) {
    for (int32_t i = 0; i < count; i++) {
      cs_run pixel = {columns[i], columns[i] + 1, y};
      CS_TRY(cs_sampler_run(blocks, sampler, pixel, rgba + i));
    }
    return CELSPAN_OK;
  }
  blocks->status = CELSPAN_OK;
  cs_sampler_row_at(&(cs_sampling){sampler, blocks}, columns, count, y, rgba);
  return blocks->status;
}
