/* Multiplying by white and by a fade of 1 changes nothing, and the transmissions of a pixel are
 * equal: what follows remains of clear, add_picture, add_light and to_rgba of the general fold.
 *
 * Pixels go through in groups: where there are planes (engine/sample/samples.h) of sixteen, a
 * register for each channel; else of as many as one register holds.
 */
#include "engine/paint/over_bare.h"
#include "engine/paint/over_wide.h"
#include "model/colour/srgb8_decode.h"
#include "model/colour/srgb8_lanes.h"
#include "model/pictures/store.h"

#ifdef __AVX512F__

enum { GROUP = CS_SAMPLES_PLANE };

typedef cs_srgb8_planes group;

static inline group nothing_folded(void) { return (group){{{0}, {0}, {0}, cs_wide_all(1)}}; }
static inline group clear(void) { return (group){{{0}, {0}, {0}, {0}}}; }

static inline group load_group(const float (*planes)[4]) {
  group v;
  for (int c = 0; c < 4; c++)
    v.channels[c] = cs_wide_load(planes[4 * c]);
  return v;
}

static inline void store_group(float (*planes)[4], const group *v) {
  for (int c = 0; c < 4; c++)
    cs_wide_store(planes[4 * c], v->channels[c]);
}

/* From pixel by pixel to planes; it is its own reverse. */
static inline group transpose(const float (*rgba)[4]) {
  __m512 v0 = _mm512_loadu_ps(rgba[0]), v1 = _mm512_loadu_ps(rgba[4]);
  __m512 v2 = _mm512_loadu_ps(rgba[8]), v3 = _mm512_loadu_ps(rgba[12]);
  __m512d rg = (__m512d)_mm512_unpacklo_ps(v0, v1), next_rg = (__m512d)_mm512_unpacklo_ps(v2, v3);
  __m512d ba = (__m512d)_mm512_unpackhi_ps(v0, v1), next_ba = (__m512d)_mm512_unpackhi_ps(v2, v3);
  return (group){
      {(cs_wide)_mm512_unpacklo_pd(rg, next_rg), (cs_wide)_mm512_unpackhi_pd(rg, next_rg),
       (cs_wide)_mm512_unpacklo_pd(ba, next_ba), (cs_wide)_mm512_unpackhi_pd(ba, next_ba)}};
}

static inline group load_samples(const cs_samples *samples, int32_t at) {
  return samples->are_planes ? load_group(samples->rgba + at) : transpose(samples->rgba + at);
}

/* A picture behind what was folded. */
static inline group fold(group before, group v) {
  cs_wide through = before.channels[3];
  for (int c = 0; c < 3; c++)
    v.channels[c] = before.channels[c] + through * v.channels[c];
  v.channels[3] = through * (1 - cs_wide_unit(v.channels[3]));
  return v;
}

static inline group add_light(group v, const cs_back_light *behind) {
  cs_wide through = v.channels[3];
  for (int c = 0; c < 3; c++)
    v.channels[c] = v.channels[c] + through * behind->light[c];
  v.channels[3] = 1 - behind->keep * through;
  return v;
}

/* Whether something shines through the first `count` pixels. */
static inline bool shines_through(group v, int32_t count) {
  const __m512i pixels = _mm512_setr_epi32(0, 4, 8, 12, 1, 5, 9, 13, 2, 6, 10, 14, 3, 7, 11, 15);
  __mmask16 those = _mm512_cmplt_epi32_mask(pixels, _mm512_set1_epi32(count));
  __m512 through = (__m512)v.channels[3];
  return _mm512_mask_cmp_ps_mask(those, through, _mm512_setzero_ps(), _CMP_NEQ_UQ) != 0;
}

static inline void put_rgba(group v, int32_t count, float (*rgba)[4]) {
  float planes[GROUP][4];
  store_group(planes, &v);
  v = transpose((const float(*)[4])planes);
  if (count >= GROUP) {
    store_group(rgba, &v);
    return;
  }
  store_group(planes, &v);
  memcpy(rgba, planes, (size_t)count * sizeof *rgba);
}

static inline void put_codes(group v, int32_t count, unsigned char *out) {
  const __m512i order = _mm512_setr_epi32(0, 4, 8, 12, 1, 5, 9, 13, 2, 6, 10, 14, 3, 7, 11, 15);
  __m512i pixels = _mm512_permutexvar_epi32(order, (__m512i)cs_srgb8_code_planes(&v, false));
  __mmask16 those = count < GROUP ? (__mmask16)((1 << count) - 1) : 0xffff;
  _mm512_mask_storeu_epi32(out, those, pixels);
}

#else

enum { GROUP = CS_OVER_WIDE_PIXELS };

typedef cs_wide group;

static inline group nothing_folded(void) { return (group)CS_WIDE_PIXEL(0, 0, 0, 1); }
static inline group clear(void) { return cs_wide_all(0); }
static inline group load_group(const float (*rgba)[4]) { return cs_wide_load(rgba[0]); }
static inline void store_group(float (*rgba)[4], const group *v) { cs_wide_store(rgba[0], *v); }

static inline group load_samples(const cs_samples *samples, int32_t at) {
  return load_group(samples->rgba + at);
}

/* A picture behind what was folded. */
static inline group fold(group before, group v) {
  const cs_wide_int colours = CS_WIDE_PIXEL(-1, -1, -1, 0);
  cs_wide through = CS_WIDE_SPREAD(before, 3);
  return cs_wide_choose(colours, before + through * v, through * (1 - cs_wide_unit(v)));
}

static inline group add_light(group v, const cs_back_light *behind) {
  const cs_wide_int colours = CS_WIDE_PIXEL(-1, -1, -1, 0);
  cs_wide through = CS_WIDE_SPREAD(v, 3), light = cs_over_wide_all((const float *)&behind->light);
  return cs_wide_choose(colours, v + through * light, 1 - behind->keep * through);
}

/* Whether something shines through the first `count` pixels. */
static inline bool shines_through(group v, int32_t count) {
  const cs_wide_int transmission = CS_WIDE_PIXEL(0, 0, 0, -1);
  cs_wide_int shines = (v != 0) & transmission;
  for (int32_t k = 4 * count; k < CS_WIDE_LANES; k++)
    shines[k] = 0;
  return cs_wide_any(shines);
}

static inline void put_rgba(group v, int32_t count, float (*rgba)[4]) {
  cs_over_wide_put(v, 0, count, rgba);
}

#endif

/* ---------------------------------------------------------------- all groups */

/* The group of pixels from pixel i on: the fold of the pictures before the last one, and the last
 * picture. */
static inline group folded_before(const cs_over_bare *over, int32_t i) {
  return over->is_first ? nothing_folded() : load_group(over->folded + i);
}

static inline group last_at(const cs_over_bare *over, int32_t i) {
  const cs_over_bare_range *shown = &over->shown;
  bool is_shown = i >= shown->first && i < shown->end;
  return is_shown ? load_samples(&over->last, i - shown->first) : clear();
}

cs_over_bare_range CS_WIDE(cs_over_bare_fold)(cs_over_bare *over) {
  const cs_over_bare_range range = over->shown;
  cs_over_bare_range shines = {range.end, range.first};
  for (int32_t i = range.first; i < range.end; i += GROUP) {
    group v = fold(folded_before(over, i), last_at(over, i));
    store_group(over->folded + i, &v);
    if (!shines_through(v, range.end - i))
      continue;
    shines.first = i < shines.first ? i : shines.first;
    shines.end = i + GROUP;
  }
  shines.end = shines.end < range.end ? shines.end : range.end;
  shines.first = shines.first < shines.end ? shines.first : shines.end;
  return shines;
}

static inline group mix(const cs_back_light *behind, const cs_over_bare *over, int32_t i) {
  return add_light(fold(folded_before(over, i), last_at(over, i)), behind);
}

void CS_WIDE(cs_over_bare_mix_rgba)(const cs_back_light *behind, const cs_over_bare *over,
                                    float (*out)[4]) {
  for (int32_t i = 0; i < over->count; i += GROUP)
    put_rgba(mix(behind, over, i), over->count - i, out + i);
}

void CS_WIDE(cs_over_bare_mix_codes)(const cs_back_light *behind, const cs_over_bare *over,
                                     unsigned char *out) {
#ifdef __AVX512F__
  for (int32_t i = 0; i < over->count; i += GROUP)
    put_codes(mix(behind, over, i), over->count - i, out + 4 * (size_t)i);
#else
  float made[CS_OVER_ROW_BATCH][4];
  CS_WIDE(cs_over_bare_mix_rgba)(behind, over, made);
  CS_WIDE(cs_srgb8_code)(made[0], (size_t)over->count, out);
#endif
}

/* ---------------------------------------------------------------- copies */

#ifdef __AVX512F__

CS_SRGB8_BYTES static inline group decode_group(const cs_srgb8_tables *tables, __m512i codes) {
  cs_srgb8_fours made = cs_srgb8_decode_plane(tables, codes);
  return (group){
      {(cs_wide)made.of[0], (cs_wide)made.of[1], (cs_wide)made.of[2], (cs_wide)made.of[3]}};
}

/* One picture over another in sixteen pixels; the pixels from `count` on are not stored. The next
 * rows of the pictures are fetched into the cache now, so that they are there in time. */
CS_SRGB8_BYTES static inline void mix_codes(const cs_srgb8_tables *tables,
                                            const unsigned char *front, const unsigned char *rear,
                                            int32_t count, unsigned char *out) {
  const __m512i opaque = _mm512_set1_epi32((int32_t)0xff000000);
  __mmask16 those = (__mmask16)(count < GROUP ? (1 << count) - 1 : 0xffff);
  __m512i near = _mm512_mask_loadu_epi32(opaque, those, front), far = opaque;
  __builtin_prefetch(front + 4 * CS_PICTURE_CODES_ROW);
  __builtin_prefetch(rear + 4 * CS_PICTURE_CODES_ROW);
  if (_mm512_cmplt_epu32_mask(near, opaque) == 0) {
    _mm512_mask_storeu_epi32(out, those, near);
    return;
  }
  far = _mm512_mask_loadu_epi32(far, those, rear);
  if ((_mm512_test_epi32_mask(near, opaque) & those) == 0) {
    _mm512_mask_storeu_epi32(out, those, far);
    return;
  }
  group mixed = fold(fold(nothing_folded(), decode_group(tables, near)), decode_group(tables, far));
  mixed.channels[3] = cs_wide_all(1);
  put_codes(mixed, count, out);
}

CS_SRGB8_BYTES void CS_WIDE(cs_over_bare_mix_copies)(const cs_srgb8_curve *curve,
                                                     const unsigned char *front,
                                                     const unsigned char *rear, int32_t count,
                                                     unsigned char *out) {
  cs_srgb8_tables tables = cs_srgb8_load_tables(curve);
  for (int32_t i = 0; i < count; i += GROUP)
    mix_codes(&tables, front + 4 * (size_t)i, rear + 4 * (size_t)i, count - i, out + 4 * (size_t)i);
}

#else

void CS_WIDE(cs_over_bare_mix_copies)(const cs_srgb8_curve *curve, const unsigned char *front,
                                      const unsigned char *rear, int32_t count,
                                      unsigned char *out) {
  for (int32_t i = 0; i < count; i++, front += 4, rear += 4, out += 4) {
    float near[4], far[4];
    cs_srgb8_colour(curve, front, near);
    cs_srgb8_colour(curve, rear, far);
    for (int c = 0; c < 4; c++)
      near[c] += (1 - near[3]) * far[c];
    uint32_t pixel = cs_srgb8_pixel(near);
    memcpy(out, &pixel, sizeof pixel);
  }
}

#endif
