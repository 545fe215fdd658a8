#include "base/functions.h"

#include <math.h>
#include <stdbool.h>

#include "base/elementary.h"

double cs_function_sin(double x) {
  double sine, cosine;
  if (x == 0 || !isfinite(x))
    return x == 0 ? x : NAN;
  cs_elementary_sincos(x, &sine, &cosine);
  return sine;
}

double cs_function_cos(double x) {
  double sine, cosine;
  if (!isfinite(x))
    return NAN;
  cs_elementary_sincos(x, &sine, &cosine);
  return cosine;
}

double cs_function_tan(double x) {
  if (x == 0 || !isfinite(x))
    return x == 0 ? x : NAN;
  return cs_elementary_tan(x);
}

/* If arguments are infinite, only their directions count. */
double cs_function_atan2(double y, double x) {
  if (x != x || y != y)
    return NAN;
  if (isfinite(x) && isfinite(y))
    return cs_elementary_atan2(y, x);
  return cs_elementary_atan2(copysign(isfinite(y) ? 0 : 1, y), copysign(isfinite(x) ? 0 : 1, x));
}

double cs_function_asin(double x) { return cs_function_atan2(x, sqrt((1 - x) * (1 + x))); }

double cs_function_acos(double x) { return cs_function_atan2(sqrt((1 - x) * (1 + x)), x); }

double cs_function_log2(double x) {
  int power;
  if (isfinite(x) && frexp(x, &power) == 0.5)
    return power - 1;
  return cs_elementary_log(x) / cs_elementary_log(2);
}

double cs_function_log10(double x) { return cs_elementary_log(x) / cs_elementary_log(10); }

/* A negative base has a power only for whole exponents, and all large numbers are even. */
double cs_function_pow(double base, double exponent) {
  if (exponent == 0 || base == 1 || (base == -1 && isinf(exponent)))
    return 1;
  if (base != base || exponent != exponent)
    return NAN;
  bool is_whole = exponent == floor(exponent);
  if (base < 0 && isfinite(base) && !is_whole)
    return NAN;
  bool is_odd = is_whole && isfinite(exponent) && fmod(exponent, 2) != 0;
  double size = cs_elementary_pow(fabs(base), exponent);
  return signbit(base) && is_odd ? -size : size;
}
