#include "base/decimal.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

static bool is_digit(char c) { return c >= '0' && c <= '9'; }

/* value (0, or at least 1) * 10^exponent, with a single rounding as long as the power is exact (up
 * to 10^22). */
static double scale_by_ten(double value, int64_t exponent) {
  static const double powers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                  1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                  1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  for (; exponent < -22 && value > 0; exponent += 22)
    value /= 1e22;
  if (!(value > 0))
    return 0;
  if (exponent > 22)
    return HUGE_VAL;
  return exponent < 0 ? value / powers[-exponent] : value * powers[exponent];
}

/* The digits that were read: the first nineteen fit into the mantissa, all others only move the
 * point. */
typedef struct decimal {
  uint64_t mantissa;
  int64_t exponent;
  int digits;
  bool is_given; /* there was a digit, perhaps 0 */
} decimal;

static const char *read_digits(const char *text, decimal *number, bool is_fraction) {
  for (; is_digit(*text); text++) {
    number->is_given = true;
    if (number->digits == 19) {
      number->exponent += !is_fraction;
      continue;
    }
    number->mantissa = 10 * number->mantissa + (uint64_t)(*text - '0');
    number->digits += number->mantissa > 0;
    number->exponent -= is_fraction;
  }
  return text;
}

/* An exponent such as "e-3". */
static const char *read_exponent(const char *text, decimal *number) {
  const char *p = text;
  if (*p != 'e' && *p != 'E')
    return text;
  p++;
  bool is_negative = *p == '-';
  if (*p == '-' || *p == '+')
    p++;
  if (!is_digit(*p))
    return text;
  int64_t exponent = 0;
  for (; is_digit(*p); p++)
    exponent = exponent < 1000000000 ? 10 * exponent + (*p - '0') : exponent;
  number->exponent += is_negative ? -exponent : exponent;
  return p;
}

const char *cs_decimal_read(const char *text, double *out) {
  bool is_negative = *text == '-';
  if (is_negative || *text == '+')
    text++;
  decimal number = {0, 0, 0, false};
  text = read_digits(text, &number, false);
  if (*text == '.')
    text = read_digits(text + 1, &number, true);
  if (!number.is_given)
    return NULL;
  text = read_exponent(text, &number);
  double value = scale_by_ten((double)number.mantissa, number.exponent);
  *out = is_negative ? -value : value;
  return text;
}
