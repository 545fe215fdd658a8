#include "filter/centre.h"

#ifdef __AVX512F__
#include <immintrin.h>
#endif

enum { BATCH = CS_ADVANCE_BATCH };

static inline void find_columns(const double *x, int32_t width, int32_t columns[BATCH]) {
  for (int k = 0; k < BATCH; k++) {
    double centre = x[k] - 0.5;
    int32_t column = (int32_t)centre;
    column += centre > column;
    column = column > 0 ? column : 0;
    columns[k] = column < width ? column : width;
  }
}

/* Puts those of a batch that are visible one after the other; returns how many. */
static inline size_t pack(const int32_t columns[BATCH], const bool *is_visible, size_t count,
                          int32_t *ends) {
#ifdef __AVX512F__
  __m128i flags = _mm_loadu_si128((const __m128i *)(const void *)is_visible);
  unsigned visible = _mm_test_epi8_mask(flags, flags);
  visible &= count < BATCH ? (1u << count) - 1 : UINT16_MAX;
  __m512i packed = _mm512_maskz_compress_epi32((__mmask16)visible, _mm512_loadu_si512(columns));
  _mm512_storeu_si512(ends, packed);
  return (size_t)__builtin_popcount(visible);
#else
  size_t found = 0;
  for (size_t k = 0; k < BATCH && k < count; k++) {
    ends[found] = columns[k];
    found += is_visible[k];
  }
  return found;
#endif
}

size_t CS_WIDE(cs_centre_ends)(const double *x, const bool *is_visible, size_t count, int32_t width,
                               int32_t *ends) {
  size_t found = 0;
  for (size_t i = 0; i < count; i += BATCH) {
    int32_t columns[BATCH];
    find_columns(x + i, width, columns);
    found += pack(columns, is_visible + i, count - i, ends + found);
  }
  return found;
}

typedef int32_t quad __attribute__((vector_size(16)));

static inline quad load_quad(const int32_t *from) {
  quad v;
  memcpy(&v, from, sizeof v);
  return v;
}

/* The fields that a place is made of, which begin a span. */
static inline void store_place(celspan_span *span, quad place) {
  _Static_assert(offsetof(celspan_span, x1) == 4 && offsetof(celspan_span, kind) == 8 &&
                     offsetof(celspan_span, origin) == 12 && sizeof span->kind == 4,
                 "");
  memcpy(span, &place, sizeof place);
}

static inline bool rises(const int32_t *ends, size_t count) {
  int32_t falls = 0;
#pragma omp simd reduction(| : falls)
  for (size_t k = 0; k < count; k++)
    falls |= ends[k] >= ends[k + 1];
  return !falls;
}

bool CS_WIDE(cs_centre_place)(celspan_span *spans, const int32_t *ends, size_t count) {
  const quad single = {CELSPAN_SPAN_SINGLE, CELSPAN_SPAN_SINGLE};
  if (!rises(ends, count))
    return false;
  for (size_t k = 0; k < count; k += CS_CENTRE_BATCH) {
    quad from = load_quad(ends + k), to = load_quad(ends + k + 1);
    quad low = __builtin_shufflevector(from, to, 0, 4, 1, 5);
    quad high = __builtin_shufflevector(from, to, 2, 6, 3, 7);
    quad low_rest = __builtin_shufflevector(single, from, 0, 4, 0, 5);
    quad high_rest = __builtin_shufflevector(single, from, 0, 6, 0, 7);
    store_place(&spans[k], __builtin_shufflevector(low, low_rest, 0, 1, 4, 5));
    store_place(&spans[k + 1], __builtin_shufflevector(low, low_rest, 2, 3, 6, 7));
    store_place(&spans[k + 2], __builtin_shufflevector(high, high_rest, 0, 1, 4, 5));
    store_place(&spans[k + 3], __builtin_shufflevector(high, high_rest, 2, 3, 6, 7));
  }
  return true;
}
