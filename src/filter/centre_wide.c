#include "filter/centre.h"

void CS_WIDE(cs_centre_columns)(const double *restrict x, size_t count, int32_t width,
                                int32_t *restrict columns) {
  int64_t whole = (int64_t)cs_advance_whole(count);
#pragma omp simd
  for (int64_t i = 0; i < whole; i++) {
    double centre = x[i] - 0.5;
    int32_t column = (int32_t)centre;
    column += centre > column;
    column = column > 0 ? column : 0;
    columns[i] = column < width ? column : width;
  }
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
