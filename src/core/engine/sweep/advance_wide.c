/* Sixty-four boundaries at a time, LANES of them in one instruction:
 *
 *      boundary   0 1 2 3 | 4 5 6 7 | ...     (four lanes)
 *      ends       0 0 1 0   0 0 0 0           a bit for each segment with y1 <= y
 *      rises      1 1 1 1   0 1 1 1           a bit for each x_next right of the one before it
 *                           ^                 clear: boundary 4 has crossed boundary 3
 *
 * For `rises`, shift() makes the vector 3..6 from the vectors 0..3 and 4..7, and 4..7 is compared
 * with it. The set bits of `ends` become a list; of `rises` only the number of clear bits matters.
 */
#include "engine/sweep/advance.h"

#ifdef __x86_64__
#include <immintrin.h>
#endif

enum { LANES = CS_WIDE_LANES / 2, FEW = 4 };

typedef double lanes __attribute__((vector_size(8 * LANES)));
typedef int64_t masks __attribute__((vector_size(8 * LANES)));

static inline lanes load(const double *from) {
  lanes v;
  memcpy(&v, from, sizeof v);
  return v;
}

/* One bit a lane: where a < b, and where a <= b. */
static inline uint64_t are_less(lanes a, lanes b) {
#ifdef __AVX512F__
  return _mm512_cmp_pd_mask((__m512d)a, (__m512d)b, _CMP_LT_OQ);
#elif defined(__AVX2__)
  return (uint64_t)_mm256_movemask_pd((__m256d)(a < b));
#else
  masks mask = a < b;
  return ((uint64_t)mask[0] & 1) | ((uint64_t)mask[1] & 2);
#endif
}

static inline uint64_t are_at_most(lanes a, lanes b) {
#ifdef __AVX512F__
  return _mm512_cmp_pd_mask((__m512d)a, (__m512d)b, _CMP_LE_OQ);
#elif defined(__AVX2__)
  return (uint64_t)_mm256_movemask_pd((__m256d)(a <= b));
#else
  masks mask = a <= b;
  return ((uint64_t)mask[0] & 1) | ((uint64_t)mask[1] & 2);
#endif
}

/* The last lane of `before`, then all lanes of v but the last. */
static inline lanes shift(lanes before, lanes v) {
#ifdef __AVX512F__
  return (lanes)_mm512_alignr_epi64((__m512i)v, (__m512i)before, 7);
#elif defined(__AVX2__)
  return __builtin_shufflevector(before, v, 3, 4, 5, 6);
#else
  return __builtin_shufflevector(before, v, 1, 2);
#endif
}

/* The first `count` bits, up to 64. */
static inline uint64_t first_bits(size_t count) {
  return count < 64 ? ((uint64_t)1 << count) - 1 : UINT64_MAX;
}

/* Appends first + the index of every set bit to a list; returns its new length. Mostly few bits are
 * set, but how many cannot be predicted: the first FEW are written without a branch. */
static inline size_t list_bits(uint64_t bits, size_t first, uint32_t *list, size_t length) {
  for (int k = 0; k < FEW; k++) {
    list[length] = (uint32_t)first + (uint32_t)__builtin_ctzll(bits | (uint64_t)1 << 63);
    length += bits != 0;
    bits &= bits - 1;
  }
  for (; bits != 0; bits &= bits - 1)
    list[length++] = (uint32_t)(first + (size_t)__builtin_ctzll(bits));
  return length;
}

cs_advanced CS_WIDE(cs_advance_to)(const cs_segments *segments, size_t count, double y,
                                   double *x_next, uint32_t *ended) {
  cs_advanced found = {0, 0};
  const double *x0 = segments->x0, *y0 = segments->y0;
  const double *slope = segments->slope, *curve = segments->curve, *y1 = segments->y1;
  const lanes limit = (lanes){0} + y;
  lanes last = (lanes){0} - __builtin_inf();
  for (size_t first = 0; first < count; first += 64) {
    uint64_t ends = 0, rises = 0;
    for (size_t k = 0; k < 64 && first + k < count; k += LANES) {
      size_t i = first + k;
      lanes down = y - load(y0 + i);
      lanes x = load(x0 + i) + down * (load(slope + i) + down * load(curve + i));
      memcpy(x_next + i, &x, sizeof x);
      ends |= are_at_most(load(y1 + i), limit) << k;
      rises |= are_less(shift(last, x), x) << k;
      last = x;
    }
    found.falls += (size_t)__builtin_popcountll(~rises & first_bits(count - first));
    ends &= first_bits(count - first);
    if (ends != 0)
      found.ended = list_bits(ends, first, ended, found.ended);
  }
  return found;
}

bool CS_WIDE(cs_advance_rises)(const double *x, size_t count) {
  if (count < 2)
    return true;
  int64_t falls = 0, pairs = (int64_t)count - 1, whole = (int64_t)cs_advance_whole(count - 1);
#pragma omp simd reduction(+ : falls)
  for (int64_t i = 0; i < whole; i++)
    falls += !(x[i] < x[i + 1]) & (i < pairs);
  return falls == 0;
}
