/* Placing the visible cells of a row of pixel centres, many boundaries at once.
 *
 *   x            1.7  2.1  3.2  5.5       of all boundaries, in batches
 *   is_visible    1    0    1    1
 *   column        2    2    3    5        ceil(x - 1/2), clamped to the row
 *   ends          2         3    5        those of visible boundaries, moved together
 *   spans       [0,2)     [2,3) [3,5)     from one end to the next
 */
#include "engine/row/centre.h"

#include <stddef.h>

#ifdef __AVX512F__
#include <immintrin.h>
#endif

enum { BATCH = CS_ADVANCE_BATCH };

/* The fields that a span begins with. */
typedef struct span_head {
  int32_t x0, x1, kind, origin;
} span_head;

_Static_assert(offsetof(celspan_span, x1) == offsetof(span_head, x1) &&
                   offsetof(celspan_span, kind) == offsetof(span_head, kind) &&
                   offsetof(celspan_span, origin) == offsetof(span_head, origin) &&
                   CELSPAN_SPAN_SINGLE == 0,
               "heads are written as a whole");

static inline void put_head(celspan_span *span, int32_t from, int32_t to) {
  memcpy(span, &(span_head){from, to, CELSPAN_SPAN_SINGLE, from}, sizeof(span_head));
}

/* The ends found so far. */
typedef struct found_ends {
  size_t count;
  int32_t last;
  bool has_empty; /* two ends are the same column: a cell has no column */
} found_ends;

#ifdef __AVX512F__

static inline __m256i find_eight(const double *x) {
  __m512d centres = _mm512_sub_pd(_mm512_loadu_pd(x), _mm512_set1_pd(0.5));
  return _mm512_cvt_roundpd_epi32(centres, _MM_FROUND_TO_POS_INF | _MM_FROUND_NO_EXC);
}

static inline __m512i find_columns(const double *x, int32_t width) {
  __m512i columns = _mm512_castsi256_si512(find_eight(x));
  columns = _mm512_inserti64x4(columns, find_eight(x + BATCH / 2), 1);
  columns = _mm512_max_epi32(columns, _mm512_setzero_si512());
  return _mm512_min_epi32(columns, _mm512_set1_epi32(width));
}

/* Spans from[k]..to[k]. */
static inline void put_heads(celspan_span *spans, __m512i from, __m512i to) {
  const __m512i four = _mm512_set1_epi32(4);
  __m512i order = _mm512_setr_epi32(0, 16, 0, 0, 1, 17, 0, 1, 2, 18, 0, 2, 3, 19, 0, 3);
  for (int k = 0; k < BATCH; k += 4, order = _mm512_add_epi32(order, four)) {
    __m512i heads = _mm512_maskz_permutex2var_epi32(0xbbbb, from, order, to);
    _mm_storeu_si128((__m128i *)(void *)&spans[k], _mm512_castsi512_si128(heads));
    _mm_storeu_si128((__m128i *)(void *)&spans[k + 1], _mm512_extracti32x4_epi32(heads, 1));
    _mm_storeu_si128((__m128i *)(void *)&spans[k + 2], _mm512_extracti32x4_epi32(heads, 2));
    _mm_storeu_si128((__m128i *)(void *)&spans[k + 3], _mm512_extracti32x4_epi32(heads, 3));
  }
}

static inline void place_batch(found_ends *p, const double *x, const bool *is_visible, size_t count,
                               int32_t width, celspan_span *spans, int32_t *ends) {
  __m128i flags = _mm_loadu_si128((const __m128i *)(const void *)is_visible);
  unsigned visible = _mm_test_epi8_mask(flags, flags);
  visible &= count < BATCH ? (1u << count) - 1 : UINT16_MAX;
  unsigned found = (unsigned)__builtin_popcount(visible);
  __m512i to = _mm512_maskz_compress_epi32((__mmask16)visible, find_columns(x, width));
  __m512i from = _mm512_alignr_epi32(to, _mm512_set1_epi32(p->last), 15);
  p->has_empty |= (_mm512_cmple_epi32_mask(to, from) & ((1u << found) - 1)) != 0;
  _mm512_storeu_si512(ends + p->count, to);
  put_heads(spans + p->count, from, to);
  __m512i all = _mm512_permutexvar_epi32(_mm512_set1_epi32((int)found - 1), to);
  p->last = found > 0 ? _mm_cvtsi128_si32(_mm512_castsi512_si128(all)) : p->last;
  p->count += found;
}

#else

static inline void find_columns(const double *x, int32_t width, int32_t columns[BATCH]) {
  for (int k = 0; k < BATCH; k++) {
    double centre = x[k] > 0.5 ? x[k] - 0.5 : 0; /* a value that is not a number becomes 0, too */
    centre = centre < width ? centre : width;
    int32_t column = (int32_t)centre;
    columns[k] = column + (centre > column);
  }
}

static inline void place_batch(found_ends *p, const double *x, const bool *is_visible, size_t count,
                               int32_t width, celspan_span *spans, int32_t *ends) {
  int32_t columns[BATCH];
  size_t first = p->count, most = count < BATCH ? count : BATCH;
  find_columns(x, width, columns);
  for (size_t k = 0; k < most; k++) { /* all are written, and some are overwritten */
    ends[p->count] = columns[k];
    p->count += is_visible[k];
  }
  for (size_t k = first; k < p->count; k++) {
    put_head(&spans[k], p->last, ends[k]);
    p->has_empty |= ends[k] <= p->last;
    p->last = ends[k];
  }
}

#endif

size_t CS_WIDE(cs_centre_place)(const double *x, const bool *is_visible, size_t count,
                                int32_t width, celspan_span *spans, int32_t *ends) {
  found_ends p = {0, 0, false};
  for (size_t i = 0; i < count; i += BATCH)
    place_batch(&p, x + i, is_visible + i, count - i, width, spans, ends);
  ends[p.count] = width;
  put_head(&spans[p.count], p.last, width);
  return p.has_empty || p.last >= width ? 0 : p.count + 1;
}
