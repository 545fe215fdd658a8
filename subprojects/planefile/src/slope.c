#include "slope.h"

int64_t pf_divide(int64_t number, int64_t divisor) {
  int64_t out = number / divisor;
  return out - (number < out * divisor);
}

static int32_t guess_channel(int64_t way, int64_t from, int64_t slope, bool is_inverse) {
  int64_t factor = is_inverse ? PF_SLOPE : slope, divisor = is_inverse ? slope : PF_SLOPE;
  int64_t to = from + pf_divide(way * factor + divisor / 2, divisor);
  return (int32_t)(to < -PLANEFILE_BRIGHT  ? -PLANEFILE_BRIGHT
                   : to > PLANEFILE_BRIGHT ? PLANEFILE_BRIGHT
                                           : to);
}

bool pf_guess(const pf_beside *beside, const planefile_cell *cell, planefile_cell *out) {
  int side = beside->after[1] == cell;
  const planefile_cell *was = beside->before[!side], *is = beside->after[!side];
  const planefile_cell *from = beside->before[side];
  if (beside->slope == 0 || beside->after[side] != cell || !was || !is || !from || is == cell)
    return false;
  bool is_inverse = (beside->slope > 0) != (side == 1);
  int64_t slope = beside->slope > 0 ? beside->slope : -(int64_t)beside->slope;
  for (int c = 0; c < 4; c++)
    out->colour[c] =
        guess_channel((int64_t)is->colour[c] - was->colour[c], from->colour[c], slope, is_inverse);
  return true;
}
