#include "output/sinks/straight.h"

void CS_WIDE(cs_straight_divide)(float *rgba, int32_t count, bool keeps_clear) {
#pragma omp simd
  for (int32_t i = 0; i < count; i++) {
    float alpha = rgba[4 * i + 3], divisor = alpha > 0 ? alpha : 1;
    bool is_kept = keeps_clear || alpha > 0;
    for (int c = 0; c < 3; c++)
      rgba[4 * i + c] = is_kept ? rgba[4 * i + c] / divisor : 0;
  }
}

/* The products are exact in double. */
void CS_WIDE(cs_straight_words)(const float *restrict numbers, int32_t count,
                                uint16_t *restrict words) {
#pragma omp simd
  for (int32_t i = 0; i < count; i++) {
    float least = numbers[i] > 0 ? numbers[i] : 0, number = least < 1 ? least : 1;
    words[i] = (uint16_t)(int32_t)((double)number * 65535 + 0.5);
  }
}
