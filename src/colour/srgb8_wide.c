/* Vector code approximates, and the exact curve is asked only where a rounding may go either way:
 *
 *   colour --divided by alpha, held to 0..1--> x --curve--> y = 255 f(x) + 1/2 --> floor(y)
 *
 * x^(1/2.4) is the power of its octave, from a table that fits a register or two, times a
 * polynomial over the octave. y is then right within UNSURE, so its floor is right unless y lies
 * within UNSURE of a whole number: such pixels, one in a hundred and fifty, are coded one by one.
 */
#include "colour/srgb8.h"

#include <stdbool.h>

#ifdef __AVX2__
#include <immintrin.h>
#endif

static void code_pixels(const float *rgba, size_t count, unsigned char *out) {
  for (; count > 0; count--, rgba += 4, out += 4) {
    uint32_t pixel = cs_srgb8_pixel(rgba);
    memcpy(out, &pixel, sizeof pixel);
  }
}

#ifdef __AVX2__

#define CHUNK 64 /* pixels */
#define LANES (4 * CHUNK)
#define FEW 12 /* pixels that are quicker one by one than as a chunk */
#define UNSURE 0x1p-10f

/* 255 * 1.055 * 2^(e / 2.4), by the last four bits of the exponent e + 127 of a float from 2^-13 to
 * 1: what is smaller lies on the straight part of the curve. */
static const float octave_powers[16] = {0,
                                        0,
                                        0x1.931502p+2f,
                                        0x1.0d0666p+3f,
                                        0x1.671af4p+3f,
                                        0x1.df591ap+3f,
                                        0x1.3fed2cp+4f,
                                        0x1.ab0cf2p+4f,
                                        0x1.1d05a6p+5f,
                                        0x1.7c7574p+5f,
                                        0x1.fbda00p+5f,
                                        0x1.52f344p+6f,
                                        0x1.c471bep+6f,
                                        0x1.2df86ap+7f,
                                        0x1.931502p+7f,
                                        0x1.0d0666p+8f};

/* (1.5 + t)^(1/2.4), |t| <= 1/2, right within 2e-6 of itself. */
static const float powers[6] = {0x1.2f1e0ep+0f, 0x1.50cc54p-2f,  -0x1.05932cp-4f,
                                0x1.6fdd6cp-6f, -0x1.5d06acp-7f, 0x1.51156ap-8f};

/* One chunk on its way. */
typedef struct chunk {
  float values[LANES];                    /* 0..1, colours straight */
  float octaves[LANES];                   /* the powers of their octaves */
  uint16_t unsure[LANES / CS_WIDE_LANES]; /* a bit a lane */
} chunk;

static inline int differs_from_one(const float *rgba, int lanes) {
  cs_wide_int differ = {0};
  for (int i = 0; i < lanes; i += CS_WIDE_LANES)
    differ |= CS_WIDE_SPREAD(cs_wide_load(rgba + i), 3) != 1;
  int any = 0;
  for (int i = 0; i < CS_WIDE_LANES; i++)
    any |= differ[i];
  return any;
}

/* Fills values. What is not a number counts as 0. */
static inline void hold_values(const float *rgba, int lanes, chunk *c) {
  const cs_wide_int colours = CS_WIDE_PIXEL(-1, -1, -1, 0);
  const cs_wide none = {0}, one = cs_wide_all(1);
  bool divides = differs_from_one(rgba, lanes);
  for (int i = 0; i < lanes; i += CS_WIDE_LANES) {
    cs_wide v = cs_wide_load(rgba + i);
    if (divides) {
      cs_wide alpha = CS_WIDE_SPREAD(v, 3);
      cs_wide_int is_seen = alpha > 0;
      v = cs_wide_choose(is_seen, v / cs_wide_choose(is_seen & colours, alpha, one), none);
    }
    v = cs_wide_choose(v > 0, v, none);
    cs_wide_store(c->values + i, cs_wide_choose(v < 1, v, one));
  }
}

/* Numbers below 256 to bytes. */
static inline void store_bytes(unsigned char *out, cs_wide_int numbers) {
#ifdef __AVX512F__
  _mm_storeu_si128((__m128i *)(void *)out, _mm512_cvtepi32_epi8((__m512i)numbers));
#else
  __m128i low = _mm256_castsi256_si128((__m256i)numbers);
  __m128i words = _mm_packs_epi32(low, _mm256_extracti128_si256((__m256i)numbers, 1));
  _mm_storel_epi64((__m128i *)(void *)out, _mm_packus_epi16(words, words));
#endif
}

/* A mask as a bit a lane. */
static inline int bits_of(cs_wide_int mask) {
#ifdef __AVX512F__
  return (int)_mm512_movepi32_mask((__m512i)mask);
#else
  return _mm256_movemask_ps((__m256)mask);
#endif
}

/* Codes of the values, to be trusted where unsure is 0. */
static inline void code_values(chunk *c, int lanes, unsigned char *out) {
  const cs_wide slope = CS_WIDE_PIXEL(255 * 12.92f, 255 * 12.92f, 255 * 12.92f, 255);
  const cs_wide knee = CS_WIDE_PIXEL(0.0031308f, 0.0031308f, 0.0031308f, 2);
  for (int i = 0; i < lanes; i += CS_WIDE_LANES) {
    cs_wide x = cs_wide_load(c->values + i), octave = cs_wide_load(c->octaves + i);
    cs_wide t = (cs_wide)(((cs_wide_int)x & 0x7fffff) | 0x3f800000) - 1.5f;
    cs_wide power = powers[4] + t * powers[5];
    for (int k = 3; k >= 0; k--)
      power = powers[k] + t * power;
    cs_wide y = cs_wide_choose(x <= knee, x * slope + 0.5f, octave * power + (0.5f - 255 * 0.055f));
    cs_wide_int code = __builtin_convertvector(y, cs_wide_int);
    cs_wide rest = y - __builtin_convertvector(code, cs_wide);
    store_bytes(out + i, code);
    c->unsure[i / CS_WIDE_LANES] = (uint16_t)bits_of((rest < UNSURE) | (rest > 1 - UNSURE));
  }
}

static inline void code_unsure(const float *rgba, const chunk *c, int lanes,
                               unsigned char *out) {
  for (int i = 0; i < lanes; i += CS_WIDE_LANES)
    if (c->unsure[i / CS_WIDE_LANES])
      code_pixels(rgba + i, CS_WIDE_LANES / 4, out + i);
}

/* Fills octaves. */
static inline void find_octaves(chunk *c, int lanes) {
#ifdef __AVX512F__
  const __m512 table = _mm512_loadu_ps(octave_powers);
  for (int i = 0; i < lanes; i += 16) {
    __m512i bits = _mm512_loadu_si512(c->values + i);
    _mm512_storeu_ps(c->octaves + i, _mm512_permutexvar_ps(_mm512_srli_epi32(bits, 23), table));
  }
#else
  const __m256 low = _mm256_loadu_ps(octave_powers), high = _mm256_loadu_ps(octave_powers + 8);
  for (int i = 0; i < lanes; i += 8) {
    __m256i bits = _mm256_loadu_si256((const __m256i *)(const void *)(c->values + i));
    __m256i octave = _mm256_srli_epi32(bits, 23);
    __m256 is_high = _mm256_castsi256_ps(_mm256_slli_epi32(octave, 28)); /* bit 3 as the sign */
    _mm256_storeu_ps(c->octaves + i,
                     _mm256_blendv_ps(_mm256_permutevar8x32_ps(low, octave),
                                      _mm256_permutevar8x32_ps(high, octave), is_high));
  }
#endif
}

/* lanes: a multiple of 16, at most LANES. */
static void code_chunk(const float *rgba, int lanes, unsigned char *out) {
  chunk c;
  hold_values(rgba, lanes, &c);
  find_octaves(&c, lanes);
  code_values(&c, lanes, out);
  code_unsure(rgba, &c, lanes, out);
}

void CS_WIDE(cs_srgb8_code)(const float *rgba, size_t count, unsigned char *out) {
  for (; count >= CHUNK; count -= CHUNK, rgba += LANES, out += LANES)
    code_chunk(rgba, LANES, out);
  size_t whole = count < FEW ? 0 : 4 * (count / 4 * 4);
  if (whole > 0)
    code_chunk(rgba, (int)whole, out);
  code_pixels(rgba + whole, count - whole / 4, out + whole);
}

#else

void CS_WIDE(cs_srgb8_code)(const float *rgba, size_t count, unsigned char *out) {
  code_pixels(rgba, count, out);
}

#endif
