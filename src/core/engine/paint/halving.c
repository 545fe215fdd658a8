#include "engine/paint/halving.h"

celspan_status cs_halving_fit(cs_halving_curve *curve, const cs_halving_point *first,
                              const cs_halving_point *last) {
  bool is_straight;
  CS_TRY(curve->test(curve, first, last, &is_straight));
  return is_straight ? cs_halving_put(curve, first, last) : cs_halving_split(curve, first, last);
}

celspan_status cs_halving_split(cs_halving_curve *curve, const cs_halving_point *first,
                                const cs_halving_point *last) {
  cs_halving_point inner[2];
  int32_t middle = first->column + (last->column + 1 - first->column) / 2;
  CS_TRY(curve->split(curve, middle - 1, inner));
  CS_TRY(cs_halving_fit(curve, first, &inner[0]));
  return cs_halving_fit(curve, &inner[1], last);
}
