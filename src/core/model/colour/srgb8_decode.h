/* Codes of 8 bits to light, 64 at a time, in the registers of AVX-512: for kernels (base/wide.h).
 * The instruction that looks bytes up in 64 entries is not in all processors that have AVX-512
 * (cs_srgb8_decodes), so functions that use this have the attribute CS_SRGB8_BYTES.
 *
 *     curve: 256 floats by code          registers of 64 bytes
 *     byte 0 of all floats               [0 .. 63] [64 .. 127] [128 .. 191] [192 .. 255]
 *     bytes 1, 2, 3                      likewise: 16 registers
 *
 *     64 codes --four instructions, by quarters--> byte 0 of 64 floats; bytes 1, 2, 3 likewise
 *
 * Invariant: the floats equal those of cs_srgb8_colour.
 */
#pragma once

#include "base/wide.h"
#include "model/colour/srgb8.h"

/* Whether the processor has the instructions of this file. */
static inline bool cs_srgb8_decodes(cs_isa isa) {
#ifdef __x86_64__
  return isa == CS_ISA_AVX512 && __builtin_cpu_supports("avx512vbmi");
#else
  (void)isa;
  return false;
#endif
}

#ifdef __AVX512F__

/* Aligned to lines of the cache. Otherwise the code before these loops would decide where they lie,
 * and a bad position makes them up to 8 % slower. */
#define CS_SRGB8_BYTES __attribute__((target("avx512vbmi"), aligned(64)))

typedef struct cs_srgb8_tables {
  __m512i quarters[4][4]; /* [byte of the float][quarter of the codes] */
} cs_srgb8_tables;

/* Four registers of sixteen floats: one channel of the four texels of sixteen pixels, or the four
 * channels of sixteen pixels. */
typedef struct cs_srgb8_fours {
  __m512 of[4];
} cs_srgb8_fours;

CS_SRGB8_BYTES static inline cs_srgb8_tables cs_srgb8_load_tables(const cs_srgb8_curve *curve) {
  cs_srgb8_tables t;
  for (int byte = 0; byte < 4; byte++)
    for (int i = 0; i < 4; i++)
      t.quarters[byte][i] = _mm512_loadu_si512(curve->bytes[byte] + 64 * i);
  return t;
}

/* Masks of the codes, out of 64, that lie in the second, the third and the last quarter of the
 * table. */
typedef struct cs_srgb8_quarters {
  __mmask64 second, third, last;
} cs_srgb8_quarters;

CS_SRGB8_BYTES static inline cs_srgb8_quarters cs_srgb8_quarters_of(__m512i code) {
  __mmask64 high = _mm512_movepi8_mask(code);
  __mmask64 odd = _mm512_test_epi8_mask(code, _mm512_set1_epi8(64));
  return (cs_srgb8_quarters){_kandn_mask64(high, odd), _kandn_mask64(odd, high),
                             _kand_mask64(odd, high)};
}

/* Reads one byte of the floats of 64 codes. To look up bytes in 64 entries takes one micro-
 * operation, in 128 entries three. */
CS_SRGB8_BYTES static inline __m512i cs_srgb8_read_table(const __m512i quarters[4],
                                                         cs_srgb8_quarters in, __m512i code) {
  __m512i made = _mm512_permutexvar_epi8(code, quarters[0]);
  made = _mm512_mask_permutexvar_epi8(made, in.second, code, quarters[1]);
  made = _mm512_mask_permutexvar_epi8(made, in.third, code, quarters[2]);
  return _mm512_mask_permutexvar_epi8(made, in.last, code, quarters[3]);
}

/* The light of 64 codes: in each 128 bits, dword j of the result's register k belongs to byte
 * 4 k + j of the codes. */
CS_SRGB8_BYTES static inline cs_srgb8_fours cs_srgb8_decode(const cs_srgb8_tables *t,
                                                            __m512i code) {
  cs_srgb8_quarters in = cs_srgb8_quarters_of(code);
  __m512i b0 = cs_srgb8_read_table(t->quarters[0], in, code),
          b1 = cs_srgb8_read_table(t->quarters[1], in, code);
  __m512i b2 = cs_srgb8_read_table(t->quarters[2], in, code),
          b3 = cs_srgb8_read_table(t->quarters[3], in, code);
  __m512i low = _mm512_unpacklo_epi8(b0, b1), low_high = _mm512_unpacklo_epi8(b2, b3);
  __m512i next = _mm512_unpackhi_epi8(b0, b1), next_high = _mm512_unpackhi_epi8(b2, b3);
  return (cs_srgb8_fours){{(__m512)_mm512_unpacklo_epi16(low, low_high),
                           (__m512)_mm512_unpackhi_epi16(low, low_high),
                           (__m512)_mm512_unpacklo_epi16(next, next_high),
                           (__m512)_mm512_unpackhi_epi16(next, next_high)}};
}

/* The alphas of sixteen pixels. */
CS_SRGB8_BYTES static inline __m512 cs_srgb8_alphas(__m512i pixels) {
  return _mm512_mul_ps(_mm512_cvtepi32_ps(_mm512_srli_epi32(pixels, 24)),
                       _mm512_set1_ps(1.0f / 255));
}

/* Sixteen pixels channel by channel, in the order of planes (srgb8_lanes.h). Two permutations in
 * one: the codes are put into that order, and their bytes are collected by channel. */
CS_SRGB8_BYTES static inline cs_srgb8_fours cs_srgb8_decode_plane(const cs_srgb8_tables *t,
                                                                  __m512i code) {
  const __m512i quarter = _mm512_broadcast_i32x4(
      _mm_setr_epi8(0, 16, 32, 48, 1, 17, 33, 49, 2, 18, 34, 50, 3, 19, 35, 51));
  const __m512i lane =
      _mm512_setr_epi64(0, 0, 0x0404040404040404, 0x0404040404040404, 0x0808080808080808,
                        0x0808080808080808, 0x0c0c0c0c0c0c0c0c, 0x0c0c0c0c0c0c0c0c);
  const __m512i apart = _mm512_setr_epi32(0, 4, 8, 12, 1, 5, 9, 13, 2, 6, 10, 14, 3, 7, 11, 15);
  cs_srgb8_fours made =
      cs_srgb8_decode(t, _mm512_permutexvar_epi8(_mm512_add_epi8(quarter, lane), code));
  __m512 alpha = cs_srgb8_alphas(_mm512_permutexvar_epi32(apart, code));
  for (int c = 0; c < 3; c++)
    made.of[c] = _mm512_mul_ps(made.of[c], alpha);
  made.of[3] = alpha;
  return made;
}

#endif
