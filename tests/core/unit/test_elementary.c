/* base/elementary.c against the C library in long double, whose error is less than the last bit of
 * a double; and its bits, which must be the same with every compiler.
 */
#include "base/elementary.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/functions.h"
#include "base/hash.h"
#include "base/number.h"
#include "tests/support/check.h"
#include "tests/support/random.h"

static test_random numbers = {1};

static double uniform(double low, double high) { return random_between(&numbers, low, high); }

static double relative(double value, long double truth) {
  long double error = fabsl(value - truth), size = fabsl(truth);
  return (double)(error == 0 ? 0 : error / size);
}

static double absolute(double value, long double truth) { return (double)fabsl(value - truth); }

static double larger(double a, double b) { return b > a ? b : a; }

static void check_angles(double limit) {
  double worst = 0, worst_tangent = 0;
  for (int i = 0; i < 200000; i++) {
    double x = uniform(-limit, limit), s, c;
    cs_elementary_sincos(x, &s, &c);
    worst = larger(worst, absolute(s, sinl(x)));
    worst = larger(worst, absolute(c, cosl(x)));
    worst_tangent = larger(worst_tangent, relative(cs_elementary_tan(x), tanl(x)));
  }
  CHECK_NEAR(worst, 0, 1.2e-16);
  CHECK_NEAR(worst_tangent, 0, 4e-16);
}

static void check_quarter_turns(void) {
  for (int quarter = -2000; quarter <= 2000; quarter++) {
    double x = quarter * 1.5707963267948966, s, c;
    cs_elementary_sincos(x, &s, &c);
    CHECK(relative(s, sinl(x)) < 4e-16 && relative(c, cosl(x)) < 4e-16);
  }
  double s, c;
  cs_elementary_sincos(0, &s, &c);
  CHECK(s == 0 && c == 1);
}

static void check_arc_tangent(void) {
  double worst = 0;
  for (int i = 0; i < 300000; i++) {
    double y = uniform(-1, 1), x = uniform(-1, 1);
    if (i % 3 == 0)
      y *= 1e-9;
    worst = larger(worst, relative(cs_elementary_atan2(y, x), atan2l(y, x)));
  }
  CHECK_NEAR(worst, 0, 4e-16);
  static const double axes[] = {0.0, -0.0, 1, -1};
  for (int i = 0; i < 16; i++)
    CHECK(cs_elementary_atan2(axes[i / 4], axes[i % 4]) == atan2(axes[i / 4], axes[i % 4]));
}

static void check_exponential_and_logarithm(void) {
  double worst_exp = 0, worst_log = 0;
  for (int i = 0; i < 300000; i++) {
    double x = i % 2 ? uniform(-1, 1) : uniform(-700, 709);
    worst_exp = larger(worst_exp, relative(cs_elementary_exp(x), expl(x)));
    double y = i % 2 ? uniform(0.5, 2) : exp(uniform(-700, 700));
    worst_log = larger(worst_log, relative(cs_elementary_log(y), logl(y)));
  }
  CHECK_NEAR(worst_exp, 0, 1.3e-16);
  CHECK_NEAR(worst_log, 0, 1.3e-16);
  CHECK(cs_elementary_exp(0) == 1 && cs_elementary_log(1) == 0);
  CHECK(isinf(cs_elementary_exp(710)) && cs_elementary_exp(-746) == 0);
  CHECK_NEAR(cs_elementary_log(5e-324), log(5e-324), 1e-13);
  CHECK(cs_elementary_log(0) == -HUGE_VAL && isnan(cs_elementary_log(-1)));
  CHECK(isnan(cs_elementary_exp(NAN)) && isnan(cs_elementary_log(NAN)));
}

static void check_power(void) {
  double worst = 0;
  static const double exponents[] = {2.4, 1 / 2.4, 0.45, 1 / 0.45, -3.7, 0.5, 20};
  for (int i = 0; i < 300000; i++) {
    double base = i % 2 ? uniform(0, 1) : exp(uniform(-6, 6)), exponent = exponents[i % 7];
    worst = larger(worst, relative(cs_elementary_pow(base, exponent), powl(base, exponent)));
  }
  CHECK_NEAR(worst, 0, 1.3e-16);
  static const double corners[] = {0, 1, 2, 0.5, HUGE_VAL, 1e300, 5e-324};
  static const double powers[] = {0, 1, -1, 2, 2.4, -1000, 1e12, -1e12};
  for (int i = 0; i < 7; i++)
    for (int j = 0; j < 8; j++) {
      double ours = cs_elementary_pow(corners[i], powers[j]), theirs = pow(corners[i], powers[j]);
      CHECK(ours == theirs || relative(ours, theirs) < 4e-16);
    }
  CHECK(isnan(cs_elementary_pow(-1, 2)) && isnan(cs_elementary_pow(NAN, 2)));
}

/* The numbers from which the expected sum in check_bits was computed. */
static double pinned(uint64_t *state, double low, double high) {
  *state = *state * 6364136223846793005u + 1442695040888963407u;
  return low + (high - low) * ((double)(*state >> 11) * 0x1p-53);
}

/* The bits are the same with every compiler. */
static void check_bits(void) {
  cs_hash hash = cs_hash_begin(0);
  uint64_t state = 7;
  for (int i = 0; i < 100000; i++) {
    double x = pinned(&state, -1000, 1000), y = pinned(&state, 0, 1), s, c;
    cs_elementary_sincos(x, &s, &c);
    cs_hash_number(&hash, s);
    cs_hash_number(&hash, c);
    cs_hash_number(&hash, cs_elementary_atan2(x, y));
    cs_hash_number(&hash, cs_elementary_exp(y));
    cs_hash_number(&hash, cs_elementary_log(y));
    cs_hash_number(&hash, cs_elementary_pow(y, 2.4));
  }
  CHECK(cs_hash_end(hash).a == 0x2ba0495d3fc3a12du);
}

/* The functions for all numbers: as those of the C library where these are exact, and within an
 * error of the last bits elsewhere. */
static bool agree(double ours, double theirs) {
  if (isnan(theirs) || isinf(theirs) || theirs == 0)
    return isnan(theirs) ? isnan(ours) : ours == theirs && !signbit(ours) == !signbit(theirs);
  return relative(ours, theirs) < 4e-16;
}

static void check_all_numbers(void) {
  static const double all[] = {0.0,   -0.0,     1,    -1,       0.5,       -0.5,   2,
                               -2,    3,        -3,   1e300,    -1e300,    5e-324, 1e22,
                               -1e22, 0x1p1023, 4e15, INFINITY, -INFINITY, NAN};
  enum { COUNT = sizeof all / sizeof *all };
  for (int i = 0; i < COUNT; i++) {
    double x = all[i];
    CHECK(agree(cs_function_sin(x), sin(x)) && agree(cs_function_cos(x), cos(x)));
    CHECK(agree(cs_function_tan(x), tan(x)) && agree(cs_function_asin(x), asin(x)));
    CHECK(agree(cs_function_acos(x), acos(x)) && agree(cs_function_log2(x), log2(x)));
    CHECK(agree(cs_function_log10(x), log10(x)));
    CHECK(agree(cs_elementary_exp(x), exp(x)) && agree(cs_elementary_log(x), log(x)));
    for (int j = 0; j < COUNT; j++) {
      CHECK(agree(cs_function_pow(x, all[j]), pow(x, all[j])));
      CHECK(agree(cs_function_atan2(x, all[j]), atan2(x, all[j])));
    }
  }
  for (int i = -1074; i < 1024; i++)
    CHECK(cs_function_log2(ldexp(1, i)) == i && cs_function_pow(2, i) == ldexp(1, i));
}

/* A number of single precision by the bits of a double: 29 of them go, to the nearest even one. */
static double by_bits(double x) {
  uint64_t bits;
  memcpy(&bits, &x, sizeof bits);
  bits += 0xfffffff + (bits >> 29 & 1);
  bits &= ~(uint64_t)0x1fffffff;
  memcpy(&x, &bits, sizeof x);
  return x;
}

static void round_both(const double *restrict x, double *restrict rounded) {
  rounded[0] = cs_number_single(x[0]);
  rounded[1] = cs_number_single(x[1]);
}

/* Of neighbours in memory, in a function of its own, as compilers compute two numbers at once. */
static void check_single(void) {
  void (*volatile round)(const double *restrict, double *restrict) = round_both;
  for (int i = 0; i < 1000; i++) {
    double first = uniform(-1, 1), second = uniform(-1e9, 1e9);
    double x[2] = {first, second}, rounded[2];
    round(x, rounded);
    CHECK(rounded[0] == by_bits(x[0]) && rounded[1] == by_bits(x[1]));
  }
}

int main(void) {
  check_all_numbers();
  check_single();
  check_angles(10);
  check_angles(1e15);
  check_angles(1e300);
  check_angles(1e6);
  check_quarter_turns();
  check_arc_tangent();
  check_exponential_and_logarithm();
  check_power();
  check_bits();
  return check_done();
}
