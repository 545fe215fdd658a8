#include "sample/sampler_parts.h"

#define SAME_SCALE 1e-12

/* ---------------------------------------------------------------- which way */

typedef struct footprint {
  double ux, vx; /* what a pixel to the right adds to its place on the picture */
  double uy, vy; /* what a pixel down adds */
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

int cs_sampler_level(int level_count, double shorter, double longer, double texels, double most) {
  int level = 0;
  while (level + 1 < level_count && (shorter >= 2 * texels || longer > most)) {
    level++;
    shorter *= 0.5;
    longer *= 0.5;
  }
  return level;
}

static int taps_along(double length, int level) {
  double taps = ceil(length / (double)((int64_t)1 << level) - CS_SAMPLER_SAME);
  return (int)cs_number_clamp(taps, 1, CS_SAMPLER_MOST_TAPS);
}

static void plan_tilted(cs_sampler *s, const footprint *f) {
  double right = sqrt(f->ux * f->ux + f->vx * f->vx), below = sqrt(f->uy * f->uy + f->vy * f->vy);
  s->kernel = CS_SAMPLER_TILTED;
  s->level =
      cs_sampler_level(s->level_count, right < below ? right : below, right < below ? below : right,
                       CS_SAMPLER_TAP_TEXELS, CS_SAMPLER_MOST_TAPS);
  s->columns = taps_along(right, s->level);
  s->rows = taps_along(below, s->level);
}

static void plan_box(cs_sampler *s, const footprint *f) {
  double wide = fabs(f->ux) + fabs(f->uy), high = fabs(f->vx) + fabs(f->vy);
  wide = wide > 1 + CS_SAMPLER_SAME ? wide : 1;
  high = high > 1 + CS_SAMPLER_SAME ? high : 1;
  s->kernel = CS_SAMPLER_BOX;
  s->level = cs_sampler_level(s->level_count, wide < high ? wide : high, wide < high ? high : wide,
                              CS_SAMPLER_BOX_TEXELS, CS_SAMPLER_MOST_BOX);
  double most = (double)((int64_t)CS_SAMPLER_MOST_BOX << s->level);
  s->wide = wide < most ? wide : most;
  s->high = high < most ? high : most;
}

static void plan_affine(cs_sampler *s) {
  footprint f = {.ux = s->m[0], .vx = s->m[3], .uy = s->m[1], .vy = s->m[4]};
  double kept = fabs(f.ux) + fabs(f.vy), crossed = fabs(f.vx) + fabs(f.uy);
  bool stays = crossed <= SAME_SCALE * kept, turns = kept <= SAME_SCALE * crossed;
  s->way = stays ? CS_SAMPLER_ROW : CS_SAMPLER_TAPS;
  if (s->sampling == CELSPAN_SAMPLING_NEAREST) {
    s->kernel = CS_SAMPLER_NEAREST;
  } else if (s->sampling == CELSPAN_SAMPLING_BICUBIC && is_enlarged(&f)) {
    s->kernel = CS_SAMPLER_CUBIC;
    s->way = CS_SAMPLER_PIXEL;
  } else if (s->sampling == CELSPAN_SAMPLING_BILINEAR || is_enlarged(&f)) {
    s->kernel = CS_SAMPLER_LINEAR;
  } else if (stays || turns) {
    plan_box(s, &f);
    s->way = stays ? CS_SAMPLER_ROW : CS_SAMPLER_PIXEL;
  } else {
    plan_tilted(s, &f);
  }
}

static cs_sampler_kernel perspective_kernel(celspan_sampling sampling) {
  switch (sampling) {
  case CELSPAN_SAMPLING_NEAREST:
    return CS_SAMPLER_NEAREST;
  case CELSPAN_SAMPLING_BILINEAR:
    return CS_SAMPLER_LINEAR;
  case CELSPAN_SAMPLING_BICUBIC:
    return CS_SAMPLER_CUBIC;
  case CELSPAN_SAMPLING_AUTO:
    break;
  }
  return CS_SAMPLER_TILTED;
}

/* How far from its centre a sample may reach, in picture pixels. */
static double reach_of(const cs_sampler *s) {
  double texel = (double)((int64_t)1 << s->level);
  double slant = fabs(s->m[0]) + fabs(s->m[1]), fall = fabs(s->m[3]) + fabs(s->m[4]);
  switch (s->way == CS_SAMPLER_COPY ? CS_SAMPLER_NEAREST : s->kernel) {
  case CS_SAMPLER_NEAREST:
    return 0.25;
  case CS_SAMPLER_LINEAR:
    return 0.51;
  case CS_SAMPLER_CUBIC:
    return 2;
  case CS_SAMPLER_BOX:
    return 0.5 * fmax(s->wide, s->high) + texel;
  case CS_SAMPLER_TILTED:
    return 0.5 * fmax(slant, fall) + texel;
  }
  return INFINITY;
}

/* As many columns as lie on the texels of one block, a power of two. */
static int32_t look_columns(const cs_sampler *s) {
  double across = fmax(fabs(s->m[0]), fabs(s->m[3]));
  int32_t columns = CS_PICTURE_BLOCK;
  while (columns < 1 << 20 && 2 * columns * across <= CS_PICTURE_BLOCK)
    columns *= 2;
  return columns;
}

void cs_sampler_prepare(cs_sampler *s) {
  s->source = cs_block_cache_source_of(s->picture);
  s->reads_codes = cs_sampler_decodes(s->isa);
  s->level_count = cs_levels_count(s->width, s->height);
  memcpy(s->m, s->inverse.m, sizeof s->m);
  if (!(s->m[6] == 0 && s->m[7] == 0 && s->m[8] > 0)) {
    s->way = CS_SAMPLER_PERSPECTIVE;
    s->kernel = perspective_kernel(s->sampling);
    s->look_columns = INT32_MAX;
    return;
  }
  for (int i = 0; i < 9; i++)
    s->m[i] /= s->inverse.m[8];
  if (is_copy(s->m))
    s->way = CS_SAMPLER_COPY;
  else
    plan_affine(s);
  s->reach = reach_of(s);
  s->look_columns = look_columns(s);
}

/* ---------------------------------------------------------------- copies */

static int32_t smaller(int32_t a, int32_t b) { return a < b ? a : b; }

/* What a row of texels is copied as. */
typedef enum copied { LIGHT, CODES } copied;

/* `count` texels from (x, y) on, which lie in one block. */
static void copy_part(const cs_sampling *run, int32_t x, int32_t y, int32_t count, copied what,
                      unsigned char *out) {
  const cs_sampler *s = run->sampler;
  const cs_block_cache_slot *slot = cs_block_cache_slot_of(
      run->texels, &s->source, 0, x / CS_PICTURE_BLOCK, y / CS_PICTURE_BLOCK);
  bool reads_codes = slot->texels && (what == CODES || (slot->codes && s->reads_codes));
  size_t texel = reads_codes ? 4 : 4 * sizeof(float), size = (size_t)count * texel;
  size_t row = texel * (reads_codes ? CS_PICTURE_CODES_ROW : CS_PICTURE_BLOCK);
  const char *from = !slot->texels ? (const char *)cs_block_cache_none
                     : reads_codes ? (const char *)slot->block->codes
                                   : (const char *)slot->texels;
  from += (size_t)(y % CS_PICTURE_BLOCK) * row + (size_t)(x % CS_PICTURE_BLOCK) * texel;
  if (reads_codes && what == LIGHT)
    CS_WIDE_CHOOSE(s->isa, cs_sampler_decode_codes)
  (run->texels->curve, (const unsigned char *)from, count, (float(*)[4])(void *)out);
  else memcpy(out, from, size);
  /* The row below follows in the block: fetched now, it is there in time. */
  for (size_t ahead = 0; ahead < size; ahead += 64)
    __builtin_prefetch(from + row + ahead);
}

/* `count` texels of row v from u on, both wherever. */
static void copy_texels(const cs_sampling *run, int64_t u, int64_t v, int32_t count, copied what,
                        unsigned char *out) {
  const cs_sampler *s = run->sampler;
  const size_t size = what == CODES ? 4 : 4 * sizeof(float);
  bool is_clear = s->wrap == CELSPAN_WRAP_CLEAR, repeats = s->wrap == CELSPAN_WRAP_REPEAT;
  if (repeats)
    v = ((v % s->height) + s->height) % s->height;
  bool is_row_outside = v < 0 || v >= s->height;
  int32_t y = v < 0 ? 0 : v >= s->height ? s->height - 1 : (int32_t)v;
  for (int32_t done = 0, part; done < count; done += part, out += (size_t)part * size) {
    int64_t at = u + done;
    if (repeats)
      at = ((at % s->width) + s->width) % s->width;
    bool is_inside = at >= 0 && at < s->width;
    part = 1;
    if (is_clear && (is_row_outside || !is_inside)) {
      memset(out, 0, size);
      continue;
    }
    int32_t x = is_inside ? (int32_t)at : at < 0 ? 0 : s->width - 1;
    if (is_inside)
      part = smaller(smaller(CS_PICTURE_BLOCK - x % CS_PICTURE_BLOCK, s->width - x), count - done);
    copy_part(run, x, y, part, what, out);
  }
}

static void copy_run(const cs_sampling *run, int32_t x0, int32_t count, double y, copied what,
                     void *out) {
  const double *m = run->sampler->m;
  copy_texels(run, x0 + (int64_t)rint(m[2]), (int64_t)floor(y + rint(m[5])), count, what, out);
}

celspan_status cs_sampler_codes(cs_block_cache *texels, const cs_sampler *sampler, int32_t x0,
                                int32_t count, double y, unsigned char *codes) {
  texels->status = CELSPAN_OK;
  copy_run(&(cs_sampling){sampler, texels}, x0, count, y, CODES, codes);
  return texels->status;
}

/* ---------------------------------------------------------------- runs */

celspan_status cs_sampler_run(cs_block_cache *texels, const cs_sampler *sampler, int32_t x0,
                              int32_t count, double y, float (*rgba)[4]) {
  cs_sampling run = {sampler, texels};
  texels->status = CELSPAN_OK;
  switch (sampler->way) {
  case CS_SAMPLER_COPY:
    copy_run(&run, x0, count, y, LIGHT, rgba);
    break;
  case CS_SAMPLER_ROW:
    cs_sampler_row_run(&run, x0, count, y, rgba);
    break;
  case CS_SAMPLER_TAPS:
  case CS_SAMPLER_PERSPECTIVE:
    cs_sampler_taps_run(&run, x0, count, y, rgba);
    break;
  case CS_SAMPLER_PIXEL:
    cs_sampler_pixel_run(&run, x0, count, y, rgba);
    break;
  }
  return texels->status;
}

celspan_status cs_sampler_at(cs_block_cache *texels, const cs_sampler *sampler,
                             const int32_t *columns, int32_t count, double y, float (*rgba)[4]) {
  if (sampler->way != CS_SAMPLER_ROW) {
    for (int32_t i = 0; i < count; i++)
      CS_TRY(cs_sampler_run(texels, sampler, columns[i], 1, y, rgba + i));
    return CELSPAN_OK;
  }
  texels->status = CELSPAN_OK;
  cs_sampler_row_at(&(cs_sampling){sampler, texels}, columns, count, y, rgba);
  return texels->status;
}
