/* Texels that are stored as codes of 4 bytes and decoded in registers, to the same floats as
 * cs_srgb8_colour gives.
 *
 * So 16 texels are fetched as 64 bytes, not 256, and decoded in fewer instructions than it would
 * take to load them one by one.
 */
#include "engine/sample/sampler_codes.h"
#include "model/colour/srgb8_decode.h"

#define SAME CS_SAMPLER_SAME

/* ---------------------------------------------------------------- places */

/* The first texel of a quad along an axis. *share: the share of its second texels in the mix. */
static inline double begin(double u, float *share) {
  double place = u - 0.5, whole = floor(place + SAME), rest = place - whole;
  *share = rest >= SAME ? (float)rest : 0.0f;
  return whole;
}

/* The same, clamped to the picture; beyond an edge the share is 0. */
static inline int32_t begin_inside(double u, int32_t last, float *share) {
  double whole = begin(u, share);
  bool is_inside = (whole >= 0) & (whole < last);
  *share = is_inside ? *share : 0.0f;
  int32_t at = (int32_t)whole;
  at = at > 0 ? at : 0;
  return at < last ? at : last;
}

void CS_WIDE(cs_sampler_clamp_quads)(const cs_sampler *sampler, int32_t count,
                                     const double *restrict u, const double *restrict v,
                                     cs_sampler_clamped *restrict clamped) {
  int32_t last_x = sampler->width - 1, last_y = sampler->height - 1;
  int32_t left = last_x, top = last_y, right = 0, bottom = 0;
  for (int32_t i = 0; i < count; i++) {
    int32_t x = begin_inside(u[i], last_x, &clamped->across[i]),
            y = begin_inside(v[i], last_y, &clamped->down[i]);
    clamped->x[i] = x;
    clamped->y[i] = y;
    left = x < left ? x : left;
    right = x > right ? x : right;
    top = y < top ? y : top;
    bottom = y > bottom ? y : bottom;
  }
  clamped->left = left;
  clamped->top = top;
  clamped->right = right;
  clamped->bottom = bottom;
}

/* Where the code of a texel is, as tile << 16 | bytes. columns: of tiles. first: the number that
 * the picture's first block would have as a tile, at most 0. */
static inline int32_t place_of(uint32_t x, uint32_t y, int32_t columns, int32_t first,
                               uint32_t *touched) {
  uint32_t column = x / CS_PICTURE_BLOCK, row = y / CS_PICTURE_BLOCK;
  uint32_t tile = row * (uint32_t)columns + column + (uint32_t)first;
  uint32_t in_block = y % CS_PICTURE_BLOCK * CS_PICTURE_CODES_ROW + x % CS_PICTURE_BLOCK;
  *touched |= (uint32_t)1 << tile;
  return (int32_t)(tile << 16 | 4 * in_block);
}

uint32_t CS_WIDE(cs_sampler_tile_quads)(const cs_sampler *sampler, const cs_sampler_tiles *tiles,
                                        int32_t count, cs_sampler_clamped *restrict clamped) {
  int32_t columns = tiles->columns, first = -tiles->row * columns - tiles->column;
  int32_t last = sampler->height - 1;
  uint32_t touched = 0;
  for (int32_t i = 0; i < count; i++) {
    int32_t x = clamped->x[i], y = clamped->y[i];
    clamped->above[i] = place_of((uint32_t)x, (uint32_t)y, columns, first, &touched);
    clamped->below[i] = place_of((uint32_t)x, (uint32_t)(y + (y < last)), columns, first, &touched);
  }
  return touched;
}

uint32_t CS_WIDE(cs_sampler_place_quads)(const cs_sampler *sampler, int32_t x0, int32_t count,
                                         double y, const cs_sampler_tiles *tiles,
                                         cs_sampler_clamped *restrict clamped) {
  const double *m = sampler->m;
  double row_u = m[1] * y + m[2], row_v = m[4] * y + m[5], m0 = m[0], m3 = m[3];
  int32_t columns = tiles->columns, first = -tiles->row * columns - tiles->column;
  uint32_t touched = 0;
  for (int32_t i = 0; i < count; i++) {
    double x = (double)(x0 + i) + 0.5;
    uint32_t left = (uint32_t)(int32_t)begin(m0 * x + row_u, &clamped->across[i]);
    uint32_t top = (uint32_t)(int32_t)begin(m3 * x + row_v, &clamped->down[i]);
    clamped->above[i] = place_of(left, top, columns, first, &touched);
    clamped->below[i] = place_of(left, top + 1, columns, first, &touched);
  }
  return touched;
}

/* ---------------------------------------------------------------- codes to light */

/* The codes of two neighbouring texels. */
static inline const unsigned char *pair_at(const cs_sampler_tiles *tiles, int32_t place) {
  return tiles->codes[place >> 16] + (place & 0xffff);
}

static inline void mix_one_by_one(const cs_srgb8_curve *curve, const cs_sampler_tiles *tiles,
                                  const cs_sampler_clamped *clamped, int32_t from, int32_t count,
                                  float (*rgba)[4]) {
  for (int32_t i = from; i < count; i++) {
    const unsigned char *above = pair_at(tiles, clamped->above[i]);
    const unsigned char *below = pair_at(tiles, clamped->below[i]);
    float quad[4][4];
    for (int k = 0; k < 4; k++)
      cs_srgb8_colour(curve, (k < 2 ? above : below) + 4 * (k % 2), quad[k]);
    for (int c = 0; c < 4; c++) {
      float left = quad[0][c] + clamped->down[i] * (quad[2][c] - quad[0][c]);
      float right = quad[1][c] + clamped->down[i] * (quad[3][c] - quad[1][c]);
      rgba[i][c] = left + clamped->across[i] * (right - left);
    }
  }
}

static inline void decode_one_by_one(const cs_srgb8_curve *curve, const unsigned char *codes,
                                     int32_t count, float (*rgba)[4]) {
  for (int32_t i = 0; i < count; i++)
    cs_srgb8_colour(curve, codes + 4 * (size_t)i, rgba[i]);
}

#ifdef __AVX512F__

#define BYTES CS_SRGB8_BYTES
#define TEXELS 16      /* in 64 bytes of codes */
#define COLOURS 0x7777 /* the lanes of red, green and blue in four pixels */
/* Pixels a prefetch: a row of the frame soon leaves a row of texels that lies at an angle. */
#define NEAR 2

/* Four registers of codes, four bytes a texel. */
typedef struct codes {
  __m512i of[4];
} codes;

/* Transposes dwords within each 128 bits: dword k of v[j] becomes dword j of of[k]. */
BYTES static inline codes transpose(__m512i v0, __m512i v1, __m512i v2, __m512i v3) {
  __m512i low = _mm512_unpacklo_epi32(v0, v1), next_low = _mm512_unpacklo_epi32(v2, v3);
  __m512i high = _mm512_unpackhi_epi32(v0, v1), next_high = _mm512_unpackhi_epi32(v2, v3);
  return (codes){{_mm512_unpacklo_epi64(low, next_low), _mm512_unpackhi_epi64(low, next_low),
                  _mm512_unpacklo_epi64(high, next_high), _mm512_unpackhi_epi64(high, next_high)}};
}

static inline void store_planes(const cs_srgb8_fours *channels, float (*planes)[4]) {
  for (int c = 0; c < 4; c++)
    _mm512_storeu_ps(planes[4 * c], channels->of[c]);
}

/* Stores a plane's pixels one by one. */
BYTES static inline void store_pixels(const cs_srgb8_fours *channels, float (*rgba)[4]) {
  codes pixels = transpose((__m512i)channels->of[0], (__m512i)channels->of[1],
                           (__m512i)channels->of[2], (__m512i)channels->of[3]);
  for (int j = 0; j < 4; j++)
    _mm512_storeu_si512(rgba[4 * j], pixels.of[j]);
}

/* ---- pixels that are copied */

BYTES static inline void decode_texels(const cs_srgb8_tables *t, const unsigned char *from,
                                       float (*rgba)[4]) {
  const __m512i apart = _mm512_setr_epi32(0, 4, 8, 12, 1, 5, 9, 13, 2, 6, 10, 14, 3, 7, 11, 15);
  __m512i code = _mm512_permutexvar_epi32(apart, _mm512_loadu_si512(from));
  cs_srgb8_fours light = cs_srgb8_decode(t, code);
  __m512 alpha = cs_srgb8_alphas(code);
  __m512 each[4] = {_mm512_permute_ps(alpha, 0x00), _mm512_permute_ps(alpha, 0x55),
                    _mm512_permute_ps(alpha, 0xaa), _mm512_permute_ps(alpha, 0xff)};
  for (int k = 0; k < 4; k++)
    _mm512_storeu_ps(rgba[4 * k], _mm512_mask_mul_ps(each[k], COLOURS, each[k], light.of[k]));
}

BYTES void CS_WIDE(cs_sampler_decode_codes)(const cs_srgb8_curve *curve, const unsigned char *from,
                                            int32_t count, float (*rgba)[4]) {
  if (count < TEXELS) {
    decode_one_by_one(curve, from, count, rgba);
    return;
  }
  cs_srgb8_tables t = cs_srgb8_load_tables(curve);
  /* The last sixteen end with the last pixel, so some of them may be made twice. */
  for (int32_t done = 0; done < count; done += TEXELS) {
    int32_t at = done + TEXELS <= count ? done : count - TEXELS;
    decode_texels(&t, from + 4 * (size_t)at, rgba + at);
  }
}

BYTES void CS_WIDE(cs_sampler_decode_planes)(const cs_srgb8_curve *curve, const unsigned char *from,
                                             int32_t count, float (*planes)[4]) {
  cs_srgb8_tables t = cs_srgb8_load_tables(curve);
  for (int32_t i = 0; i < count; i += CS_SAMPLES_PLANE) {
    cs_srgb8_fours made = cs_srgb8_decode_plane(&t, _mm512_loadu_si512(from + 4 * (size_t)i));
    store_planes(&made, planes + i);
  }
}

/* ---- pixels that are mixed */

/* The addresses of the upper or of the lower pairs of texels of some pixels. */
BYTES static inline void find_pairs(const cs_sampler_tiles *tiles, const int32_t *places,
                                    int32_t count, const unsigned char **at) {
  const __m512i bases = _mm512_loadu_si512(tiles->codes);
  const __m512i more = _mm512_loadu_si512(tiles->codes + 8);
  for (int32_t i = 0; i < count; i += 8) {
    __m256i some = _mm256_loadu_si256((const __m256i *)(const void *)(places + i));
    __m512i place = _mm512_cvtepu32_epi64(some), tile = _mm512_srli_epi64(place, 16);
    __m512i base = _mm512_permutex2var_epi64(bases, tile, more);
    __m512i inside = _mm512_and_si512(place, _mm512_set1_epi64(0xffff));
    _mm512_storeu_si512(at + i, _mm512_add_epi64(base, inside));
  }
}

/* The quads of four pixels. */
BYTES static inline __m512i load_quads(const unsigned char *const *above,
                                       const unsigned char *const *below) {
  __m512i quads = _mm512_castsi128_si512(_mm_loadl_epi64((const void *)above[0]));
  for (int k = 0; k < 4; k++) {
    __m128i upper = _mm_loadl_epi64((const void *)above[k]);
    __m128i lower = _mm_loadl_epi64((const void *)below[k]);
    if (k > 0)
      quads = _mm512_mask_broadcastq_epi64(quads, (__mmask8)(1 << 2 * k), upper);
    quads = _mm512_mask_broadcastq_epi64(quads, (__mmask8)(2 << 2 * k), lower);
  }
  return quads;
}

/* One channel of sixteen quads, in the order in which decode returns a register for each texel of
 * the quad. first: which bytes of the registers 0 and 1, or 2 and 3, are that channel. */
BYTES static inline __m512i channel_of(const codes *quads, __m512i first) {
  __m512i above = _mm512_permutex2var_epi8(quads->of[0], first, quads->of[1]);
  __m512i below = _mm512_permutex2var_epi8(quads->of[2], first, quads->of[3]);
  return _mm512_mask_blend_epi8(0xff00ff00ff00ff00u, above, below);
}

static inline __m512 mix(__m512 a, __m512 b, __m512 share) {
  return _mm512_add_ps(a, _mm512_mul_ps(share, _mm512_sub_ps(b, a)));
}

static inline __m512 mix_texels(const cs_srgb8_fours *texels, __m512 across, __m512 down) {
  return mix(mix(texels->of[0], texels->of[2], down), mix(texels->of[1], texels->of[3], down),
             across);
}

BYTES static inline void mix_sixteen(const cs_srgb8_tables *t, const codes *quads, bool are_opaque,
                                     __m512 across, __m512 down, bool are_planes,
                                     float (*rgba)[4]) {
  /* In each 128 bits, byte 4 k + j is the first byte of dword j of register k; for k = 2 and 3 of
   * register k - 2, since channel_of applies the same bytes to the registers 2 and 3. */
  const __m512i red = _mm512_add_epi8(
      _mm512_broadcast_i32x4(
          _mm_setr_epi8(0, 4, 8, 12, 64, 68, 72, 76, 0, 4, 8, 12, 64, 68, 72, 76)),
      _mm512_setr_epi64(0, 0, 0x1010101010101010, 0x1010101010101010, 0x2020202020202020,
                        0x2020202020202020, 0x3030303030303030, 0x3030303030303030));
  cs_srgb8_fours alpha, made = {{{0}, {0}, {0}, _mm512_set1_ps(1)}};
  for (int k = 0; k < 4 && !are_opaque; k++)
    alpha.of[k] = cs_srgb8_alphas(quads->of[k]);
  if (!are_opaque)
    made.of[3] = mix_texels(&alpha, across, down);
  for (int c = 0; c < 3; c++) {
    cs_srgb8_fours light =
        cs_srgb8_decode(t, channel_of(quads, _mm512_add_epi8(red, _mm512_set1_epi8((char)c))));
    for (int k = 0; k < 4 && !are_opaque; k++)
      light.of[k] = _mm512_mul_ps(light.of[k], alpha.of[k]);
    made.of[c] = mix_texels(&light, across, down);
  }
  if (are_planes)
    store_planes(&made, rgba);
  else
    store_pixels(&made, rgba);
}

BYTES void CS_WIDE(cs_sampler_mix_codes)(const cs_srgb8_curve *curve, const cs_sampler_tiles *tiles,
                                         const cs_sampler_clamped *clamped, int32_t count,
                                         bool are_planes, float (*rgba)[4]) {
  const __m512i apart = _mm512_setr_epi32(0, 4, 8, 12, 1, 5, 9, 13, 2, 6, 10, 14, 3, 7, 11, 15);
  const unsigned char *above[CS_SAMPLER_BATCH], *below[CS_SAMPLER_BATCH];
  cs_srgb8_tables t = cs_srgb8_load_tables(curve);
  int32_t whole = count / TEXELS * TEXELS;
  find_pairs(tiles, clamped->above, whole, above);
  find_pairs(tiles, clamped->below, whole, below);
  for (int32_t i = 0; i < whole; i += TEXELS) {
    for (int k = 0; k < TEXELS; k += NEAR)
      __builtin_prefetch(above[i + k] + tiles->ahead);
    codes quads = transpose(
        load_quads(above + i, below + i), load_quads(above + i + 4, below + i + 4),
        load_quads(above + i + 8, below + i + 8), load_quads(above + i + 12, below + i + 12));
    __m512 across = _mm512_permutexvar_ps(apart, _mm512_loadu_ps(clamped->across + i));
    __m512 down = _mm512_permutexvar_ps(apart, _mm512_loadu_ps(clamped->down + i));
    if (tiles->are_opaque)
      mix_sixteen(&t, &quads, true, across, down, are_planes, rgba + i);
    else
      mix_sixteen(&t, &quads, false, across, down, are_planes, rgba + i);
  }
  mix_one_by_one(curve, tiles, clamped, whole, count, rgba);
}

#else

void CS_WIDE(cs_sampler_decode_codes)(const cs_srgb8_curve *curve, const unsigned char *codes,
                                      int32_t count, float (*rgba)[4]) {
  decode_one_by_one(curve, codes, count, rgba);
}

void CS_WIDE(cs_sampler_decode_planes)(const cs_srgb8_curve *curve, const unsigned char *codes,
                                       int32_t count, float (*planes)[4]) {
  decode_one_by_one(curve, codes, count, planes);
}

void CS_WIDE(cs_sampler_mix_codes)(const cs_srgb8_curve *curve, const cs_sampler_tiles *tiles,
                                   const cs_sampler_clamped *clamped, int32_t count,
                                   bool are_planes, float (*rgba)[4]) {
  (void)are_planes;
  mix_one_by_one(curve, tiles, clamped, 0, count, rgba);
}

#endif
