/* Cody and Waite's reductions, Taylor series on the reduced ranges, and sums of two doubles
 * ("pairs", after Dekker) wherever one double would lose the last bits. Every constant is a
 * quotient of integers or consists of the leading bits of pi or ln 2, so it can be checked by
 * hand. */
#include "base/elementary.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/number.h"

/* An unevaluated sum: |lo| is at most half a last place of hi. */
typedef struct pair {
  double hi, lo;
} pair;

static pair pair_sum(double a, double b) {
  double sum = a + b;
  double b_part = sum - a;
  return (pair){sum, (a - (sum - b_part)) + (b - b_part)};
}

static void split(double a, double *high, double *low) {
  double scaled = a * 134217729.0; /* 2^27 + 1 */
  *high = scaled - (scaled - a);
  *low = a - *high;
}

static pair pair_product(double a, double b) {
  double a_high, a_low, b_high, b_low, product = a * b;
  split(a, &a_high, &a_low);
  split(b, &b_high, &b_low);
  double rest = a_high * b_high - product;
  return (pair){product, ((rest + a_high * b_low) + a_low * b_high) + a_low * b_low};
}

static pair pair_multiply(pair a, pair b) {
  pair product = pair_product(a.hi, b.hi);
  return pair_sum(product.hi, product.lo + (a.hi * b.lo + a.lo * b.hi));
}

/* c[0] + c[1] x + ... + c[count-1] x^(count-1). */
static double polynomial(const double *c, int count, double x) {
  double sum = c[count - 1];
  for (int i = count - 2; i >= 0; i--)
    sum = sum * x + c[i];
  return sum;
}

/* 2^exponent for a normal result, -1022..1023. */
static double power_of_two(int exponent) {
  uint64_t bits = (uint64_t)(exponent + 1023) << 52;
  double power;
  memcpy(&power, &bits, sizeof power);
  return power;
}

/* ---------------------------------------------------------------- sine, cosine, tangent */

/* pi/2 in three parts; the first two have 33 bits, so their products with the number of quarter
 * turns are exact up to 2^20 turns. */
#define HALF_PI_A 0x1.921fb544p+0
#define HALF_PI_B 0x1.0b4611a6p-34
#define HALF_PI_C 0x1.3198a2e037073p-69
#define HALF_PI_HIGH 0x1.921fb54442d18p+0
#define HALF_PI_LOW 0x1.1a62633145c07p-54
#define TWO_OVER_PI 0x1.45f306dc9c883p-1

#define FAR 1e6 /* from this angle on, more bits of 2/pi are needed */

/* 2/pi after 64 zeros, 32 bits a word. */
static const uint32_t two_over_pi[] = {
    0,          0,          0xa2f9836e, 0x4e441529, 0xfc2757d1, 0xf534ddc0, 0xdb629599, 0x3c439041,
    0xfe5163ab, 0xdebbc561, 0xb7246e3a, 0x424dd2e0, 0x06492eea, 0x09d1921c, 0xfe1deb1c, 0xb129a73e,
    0xe88235f5, 0x2ebb4484, 0xe99c7026, 0xb45f7e41, 0x3991d639, 0x835339f4, 0x9c845f8b, 0xbdf9283b,
    0x1ff897ff, 0xde05980f, 0xef2f118b, 0x5a0a6d1f, 0x6d367ecf, 0x27cb09b7, 0x4f463f66, 0x9e5fea2d,
    0x7527bac7, 0xebe5f17b, 0x3d0739f7, 0x8a5292ea, 0x6bfb5fb1, 0x1f8d5d08, 0x56033046};

enum { LIMBS = 6 };

/* The quarter turns of mantissa 2^exponent, in 192 bits, the first two of which are before the
 * point. The bits of 2/pi before those that are used here give multiples of four quarter turns. */
static void find_turns(uint64_t mantissa, int exponent, uint32_t out[LIMBS]) {
  const uint32_t *words = two_over_pi + (exponent + 62) / 32;
  int shift = (exponent + 62) % 32;
  uint64_t low = 0, high = 0, before = 0; /* the carry, and the factor of the previous limb */
  for (int i = LIMBS - 1; i >= 0; i--) {
    uint64_t two = (uint64_t)words[i] << 32 | words[i + 1];
    uint64_t factor = two << shift >> 32;
    low += (mantissa & UINT32_MAX) * factor;
    high += (mantissa >> 32) * before + (uint32_t)low;
    out[i] = (uint32_t)high;
    low >>= 32;
    high >>= 32;
    before = factor;
  }
}

static pair reduce_far_angle(double radians, double *turns) {
  int exponent;
  uint32_t at[LIMBS];
  double mantissa = frexp(fabs(radians), &exponent) * 0x1p53;
  find_turns((uint64_t)mantissa, exponent - 53, at);
  double sign = radians < 0 ? -1 : 1;
  *turns = sign * (double)((at[0] + (UINT64_C(1) << 29)) >> 30);
  for (int i = 0; i < LIMBS - 1; i++)
    at[i] = at[i] << 2 | at[i + 1] >> 30;
  pair high = pair_sum((int32_t)at[0] * 0x1p-32, at[1] * 0x1p-64);
  pair low = pair_sum(at[2] * 0x1p-96, at[3] * 0x1p-128);
  pair rest = pair_sum(high.hi, high.lo + low.hi);
  return pair_multiply((pair){sign * rest.hi, sign * (rest.lo + low.lo)},
                       (pair){HALF_PI_HIGH, HALF_PI_LOW});
}

/* The angle minus `turns` quarter turns, in -pi/4..pi/4. */
static pair reduce_angle(double radians, double *turns) {
  if (fabs(radians) > FAR && fabs(radians) < HUGE_VAL)
    return reduce_far_angle(radians, turns);
  *turns = rint(radians * TWO_OVER_PI);
  pair near = pair_sum(radians - *turns * HALF_PI_A, -(*turns * HALF_PI_B));
  return pair_sum(near.hi, near.lo - *turns * HALF_PI_C);
}

static double sine_near_zero(pair angle) {
  static const double c[] = {
      -1.0 / 6,        1.0 / 120,        -1.0 / 5040,          1.0 / 362880,
      -1.0 / 39916800, 1.0 / 6227020800, -1.0 / 1307674368000, 1.0 / 355687428096000};
  double x = angle.hi, x2 = x * x;
  return x + (x * x2 * polynomial(c, 8, x2) + angle.lo * (1 - 0.5 * x2));
}

static double cosine_near_zero(pair angle) {
  static const double c[] = {
      1.0 / 24,        -1.0 / 720,         1.0 / 40320,         -1.0 / 3628800,
      1.0 / 479001600, -1.0 / 87178291200, 1.0 / 20922789888000};
  double x = angle.hi, x2 = x * x;
  pair head = pair_sum(1, -0.5 * x2);
  return head.hi + (head.lo + (x2 * x2 * polynomial(c, 7, x2) - x * angle.lo));
}

void cs_elementary_sincos(double radians, double *sine, double *cosine) {
  double turns;
  pair angle = reduce_angle(radians, &turns);
  double s = sine_near_zero(angle), c = cosine_near_zero(angle);
  switch (cs_number_to_int32(turns - 4 * floor(turns / 4))) {
  case 0:
    *sine = s, *cosine = c;
    break;
  case 1:
    *sine = c, *cosine = -s;
    break;
  case 2:
    *sine = -s, *cosine = -c;
    break;
  default:
    *sine = -c, *cosine = s;
    break;
  }
}

double cs_elementary_tan(double radians) {
  double sine, cosine;
  cs_elementary_sincos(radians, &sine, &cosine);
  return sine / cosine;
}

/* ---------------------------------------------------------------- arc tangent */

/* atan(k/8): the nearest double, and the remainder. */
static const pair atan_of_eighths[9] = {{0, 0},
                                        {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
                                        {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
                                        {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
                                        {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
                                        {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
                                        {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
                                        {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
                                        {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55}};

/* atan(small/large) for 0 <= small <= large, large > 0: within 1/16 of a table entry, then
 * atan(u) = atan(c) + atan((u - c)/(1 + c u)). */
static pair atan_of_ratio(double small, double large) {
  static const double c[] = {-1.0 / 3, 1.0 / 5, -1.0 / 7, 1.0 / 9, -1.0 / 11, 1.0 / 13};
  int entry = cs_number_to_int32(rint(small / large * 8));
  double eighth = entry / 8.0;
  double u = (small - eighth * large) / (large + eighth * small), u2 = u * u;
  pair base = atan_of_eighths[entry], sum = pair_sum(base.hi, u);
  return (pair){sum.hi, sum.lo + (base.lo + u * u2 * polynomial(c, 6, u2))};
}

double cs_elementary_atan2(double y, double x) {
  double up = fabs(y), across = fabs(x);
  pair angle = {0, 0};
  if (up > across) {
    pair rest = atan_of_ratio(across, up);
    angle = pair_sum(HALF_PI_HIGH, -rest.hi);
    angle.lo += HALF_PI_LOW - rest.lo;
  } else if (across > 0) {
    angle = atan_of_ratio(up, across);
  }
  if (signbit(x)) {
    pair supplement = pair_sum(2 * HALF_PI_HIGH, -angle.hi);
    angle = (pair){supplement.hi, supplement.lo + (2 * HALF_PI_LOW - angle.lo)};
  }
  return copysign(angle.hi + angle.lo, y);
}

/* ---------------------------------------------------------------- exponential, logarithm, power */

/* ln 2 in two parts; the first has 42 bits, so its product with any exponent is exact. */
#define LN2_A 0x1.62e42fefa38p-1
#define LN2_B 0x1.ef35793c7673p-45
#define LOG2_E 0x1.71547652b82fep+0

static double exp_of_pair(pair x) {
  static const double c[] = {1.0 / 2,       1.0 / 6,        1.0 / 24,        1.0 / 120,
                             1.0 / 720,     1.0 / 5040,     1.0 / 40320,     1.0 / 362880,
                             1.0 / 3628800, 1.0 / 39916800, 1.0 / 479001600, 1.0 / 6227020800};
  if (x.hi != x.hi)
    return x.hi;
  if (x.hi > 709.8)
    return HUGE_VAL;
  if (x.hi < -745.2)
    return 0;
  double exponent = rint(x.hi * LOG2_E);
  pair r = pair_sum(x.hi - exponent * LN2_A, x.lo - exponent * LN2_B);
  pair head = pair_sum(1, r.hi);
  double tail = r.hi * r.hi * polynomial(c, 12, r.hi) + r.lo * (1 + r.hi);
  double mantissa = head.hi + (head.lo + tail);
  int whole = cs_number_to_int32(exponent), half = whole / 2;
  return mantissa * power_of_two(half) * power_of_two(whole - half);
}

/* Mantissa in sqrt(1/2)..sqrt(2) and exponent of a positive finite number. */
static double split_exponent(double x, int *exponent) {
  int bias = 1023;
  if (x < 0x1p-1022) {
    x *= 0x1p54;
    bias += 54;
  }
  uint64_t bits;
  memcpy(&bits, &x, sizeof bits);
  *exponent = (int)(bits >> 52) - bias;
  bits = (bits & 0xfffffffffffffu) | (uint64_t)1023 << 52;
  memcpy(&x, &bits, sizeof x);
  if (x > 1.4142135623730951) {
    x *= 0.5;
    ++*exponent;
  }
  return x;
}

/* ln m = 2 f (1 + s/3 + s^2/5 + ...) with f = (m - 1)/(m + 1) and s = f^2 <= 0.0295. About 65 bits
 * are right, which a power with an exponent of up to a thousand needs. */
static pair log_as_pair(double x) {
  static const double c[] = {1.0 / 5,  1.0 / 7,  1.0 / 9,  1.0 / 11, 1.0 / 13, 1.0 / 15,
                             1.0 / 17, 1.0 / 19, 1.0 / 21, 1.0 / 23, 1.0 / 25};
  int exponent;
  double m = split_exponent(x, &exponent);
  pair below = pair_sum(m, 1);
  double quotient = (m - 1) / below.hi;
  pair back = pair_product(quotient, below.hi);
  pair f = {quotient, (((m - 1) - back.hi) - back.lo - quotient * below.lo) / below.hi};
  pair s = pair_multiply(f, f);
  pair third =
      pair_sum(0x1.5555555555555p-2, 0x1.5555555555555p-56 + s.hi * polynomial(c, 11, s.hi));
  pair correction = pair_multiply(f, pair_multiply(s, third));
  pair sum = pair_sum(exponent * LN2_A, 2 * f.hi);
  pair more = pair_sum(sum.hi, 2 * correction.hi);
  double low = (sum.lo + more.lo) + (exponent * LN2_B + 2 * (f.lo + correction.lo));
  return pair_sum(more.hi, low);
}

double cs_elementary_exp(double x) { return exp_of_pair((pair){x, 0}); }

double cs_elementary_log(double x) {
  if (!(x > 0))
    return x == 0 ? -HUGE_VAL : NAN;
  if (x == HUGE_VAL)
    return x;
  pair log = log_as_pair(x);
  return log.hi + log.lo;
}

double cs_elementary_pow(double base, double exponent) {
  if (exponent == 0 || base == 1)
    return 1;
  if (!(base > 0) || base == HUGE_VAL)
    return base != base || base < 0 ? NAN : (base == 0) == (exponent > 0) ? 0 : HUGE_VAL;
  pair log = log_as_pair(base);
  double rough = exponent * log.hi;
  if (!(fabs(rough) < 1000))
    return exp_of_pair((pair){rough, 0});
  pair product = pair_product(exponent, log.hi);
  return exp_of_pair(pair_sum(product.hi, product.lo + exponent * log.lo));
}
