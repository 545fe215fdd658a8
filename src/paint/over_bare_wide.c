#include "colour/srgb8_lanes.h"
#include "colour/srgb8_planes.h"
#include "paint/over_bare.h"
#include "paint/over_wide.h"

/* Multiplying by white and by a fade of 1 changes nothing, and the transmissions of a pixel are
 * equal: so much remains of clear, add_picture, add_light and to_rgba. */

static const float uncovered[4] = {0, 0, 0, 1};

/* A picture behind what was folded. */
static inline cs_wide fold(cs_wide before, cs_wide v) {
  const cs_wide_int colours = CS_WIDE_PIXEL(-1, -1, -1, 0);
  cs_wide through = CS_WIDE_SPREAD(before, 3);
  return cs_wide_choose(colours, before + through * v, through * (1 - cs_wide_unit(v)));
}

/* Where something shines through it. */
static inline cs_wide_int shines_through(cs_wide folded) {
  const cs_wide_int transmission = CS_WIDE_PIXEL(0, 0, 0, -1);
  return (folded != 0) & transmission;
}

cs_over_bare_range CS_WIDE(cs_over_bare_fold)(bool is_first, const float (*rgba)[4],
                                              cs_over_bare_range range, float (*folded)[4]) {
  const cs_wide nothing = cs_over_wide_all(uncovered);
  cs_over_bare_range shines = {range.end, range.first};
  for (int32_t i = range.first; i < range.end; i += CS_OVER_WIDE_PIXELS) {
    cs_wide v = fold(is_first ? nothing : cs_wide_load(folded[i]), cs_wide_load(rgba[i]));
    cs_wide_store(folded[i], v);
    if (!cs_wide_any(shines_through(v)))
      continue;
    shines.first = i < shines.first ? i : shines.first;
    shines.end = i + CS_OVER_WIDE_PIXELS;
  }
  shines.end = shines.end < range.end ? shines.end : range.end;
  shines.first = shines.first < shines.end ? shines.first : shines.end;
  return shines;
}

void CS_WIDE(cs_over_bare_mix_rgba)(const cs_back_light *behind, bool is_first,
                                    const float (*rgba)[4], int32_t count, const float (*folded)[4],
                                    float (*out)[4]) {
  const cs_wide_int colours = CS_WIDE_PIXEL(-1, -1, -1, 0);
  const cs_wide nothing = cs_over_wide_all(uncovered),
                light = cs_over_wide_all((const float *)&behind->light);
  const float keep = behind->keep;
  for (int32_t i = 0; i < count; i += CS_OVER_WIDE_PIXELS) {
    cs_wide v = fold(is_first ? nothing : cs_wide_load(folded[i]), cs_wide_load(rgba[i]));
    cs_wide through = CS_WIDE_SPREAD(v, 3);
    cs_over_wide_put(cs_wide_choose(colours, v + through * light, 1 - keep * through), i, count,
                     out);
  }
}

#ifdef __AVX512F__

/* Sixteen pixels by channel: lane 4 l + j is pixel 4 j + l. */
static inline cs_srgb8_planes load_planes(const float (*rgba)[4]) {
  __m512 v0 = _mm512_loadu_ps(rgba[0]), v1 = _mm512_loadu_ps(rgba[4]);
  __m512 v2 = _mm512_loadu_ps(rgba[8]), v3 = _mm512_loadu_ps(rgba[12]);
  __m512d rg = (__m512d)_mm512_unpacklo_ps(v0, v1), next_rg = (__m512d)_mm512_unpacklo_ps(v2, v3);
  __m512d ba = (__m512d)_mm512_unpackhi_ps(v0, v1), next_ba = (__m512d)_mm512_unpackhi_ps(v2, v3);
  return (cs_srgb8_planes){
      {(cs_wide)_mm512_unpacklo_pd(rg, next_rg), (cs_wide)_mm512_unpackhi_pd(rg, next_rg),
       (cs_wide)_mm512_unpacklo_pd(ba, next_ba), (cs_wide)_mm512_unpackhi_pd(ba, next_ba)}};
}

static inline void store_pixels(cs_wide_int pixels, int32_t count, unsigned char *out) {
  const __m512i order = _mm512_setr_epi32(0, 4, 8, 12, 1, 5, 9, 13, 2, 6, 10, 14, 3, 7, 11, 15);
  __mmask16 those = count < 16 ? (__mmask16)((1 << count) - 1) : 0xffff;
  _mm512_mask_storeu_epi32(out, those, _mm512_permutexvar_epi32(order, (__m512i)pixels));
}

void CS_WIDE(cs_over_bare_mix_codes)(const cs_back_light *behind, bool is_first,
                                     const float (*rgba)[4], int32_t count,
                                     const float (*folded)[4], unsigned char *out) {
  for (int32_t i = 0; i < count; i += 16) {
    cs_srgb8_planes picture = load_planes(rgba + i), made = {{{0}, {0}, {0}, cs_wide_all(1)}};
    if (!is_first)
      made = load_planes(folded + i);
    cs_wide through = made.channels[3], left = through * (1 - cs_wide_unit(picture.channels[3]));
    for (int c = 0; c < 3; c++)
      made.channels[c] =
          (made.channels[c] + through * picture.channels[c]) + left * behind->light[c];
    made.channels[3] = 1 - behind->keep * left;
    store_pixels(cs_srgb8_code_planes(&made), count - i, out + 4 * (size_t)i);
  }
}

#else

void CS_WIDE(cs_over_bare_mix_codes)(const cs_back_light *behind, bool is_first,
                                     const float (*rgba)[4], int32_t count,
                                     const float (*folded)[4], unsigned char *out) {
  float made[CS_OVER_ROW_BATCH][4];
  CS_WIDE(cs_over_bare_mix_rgba)(behind, is_first, rgba, count, folded, made);
  CS_WIDE(cs_srgb8_code)(made[0], (size_t)count, out);
}

#endif
