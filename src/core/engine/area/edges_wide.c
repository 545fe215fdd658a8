/* Plain loops that the compiler turns into vector code: each line is one operation on every
 * boundary. See edges.h for what one, two, second and fall are. */
#include "engine/area/edges.h"

void CS_WIDE(cs_edges_straight)(cs_edges *edges, const double *restrict top,
                                const double *restrict foot, size_t count, int32_t width) {
  double *restrict low = edges->low, *restrict high = edges->high;
  float *restrict one = edges->one, *restrict two = edges->two;
  float *restrict second = edges->second, *restrict fall = edges->fall;
  int32_t *restrict first = edges->first, *restrict end = edges->end;
  /* from this number on all doubles are whole numbers */
  const double right = width, whole = 0x1p52;
#pragma omp simd
  for (size_t i = 0; i < count; i++) {
    double a = top[i] < foot[i] ? top[i] : foot[i], b = top[i] < foot[i] ? foot[i] : top[i];
    double clamped = a > 0 ? a : 0, clamped_high = b > 0 ? b : 0;
    clamped = clamped < right ? clamped : right;
    clamped_high = clamped_high < right ? clamped_high : right;
    double near = (clamped + whole) - whole, near_high = (clamped_high + whole) - whole;
    double column = near - (near > clamped ? 1.0 : 0.0);
    double last = near_high + (near_high < clamped_high ? 1.0 : 0.0);
    double split = column + 1, by_twice = 0.5 / (b - a);
    double within = cs_cover_within(a, b, split);
    double first_of = cs_cover_first(a, split, by_twice);
    double last_of = cs_cover_last(b, last - 1, by_twice);
    double outside = (a < 0 ? clamped_high : 0) + (b > right ? right - clamped : 0);
    double least = outside > 0 ? column + 3 : last;
    low[i] = a;
    high[i] = b;
    double in_first = cs_cover_round(b > split ? first_of : within);
    double in_last = cs_cover_round(b > split ? last_of : 1);
    one[i] = (float)in_first;
    two[i] = (float)in_last;
    second[i] = (float)cs_cover_round((2 * (split - a) + 1) * by_twice);
    fall[i] = (float)(outside > 0 ? 0 : 2 * by_twice);
    first[i] = (int32_t)column;
    end[i] = (int32_t)(last < least ? least : last);
  }
}
