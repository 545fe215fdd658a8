#include "paint/line.h"

celspan_status cs_line_fit(cs_curve *curve, const cs_line_point *first, const cs_line_point *last) {
  bool is_straight;
  CS_TRY(curve->test(curve, first, last, &is_straight));
  return is_straight ? cs_line_put(curve, first, last) : cs_line_halve(curve, first, last);
}

celspan_status cs_line_halve(cs_curve *curve, const cs_line_point *first,
                             const cs_line_point *last) {
  cs_line_point inner[2];
  int32_t middle = first->column + (last->column + 1 - first->column) / 2;
  CS_TRY(curve->split(curve, middle - 1, inner));
  CS_TRY(cs_line_fit(curve, first, &inner[0]));
  return cs_line_fit(curve, &inner[1], last);
}
