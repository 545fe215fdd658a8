/* Powers with a fixed exponent, which the curves of transfer.h need. A power x^exponent is the
 * product of three factors:
 *
 *   x = 2^e * c * (1 + r)            c: the middle of the i-th of 64 equal intervals of 1..2
 *   x^exponent = octave[e] * point[i] * (1 + r)^exponent
 *
 * The first two come from tables that are made at build time (make_transfer_tables.c), the third is
 * a binomial series of eight terms. The relative error is at most 4e-16, and this is several times
 * faster than cs_elementary_pow. Loops over it become vector code.
 */
#pragma once

#include <math.h>
#include <stdint.h>
#include <string.h>

enum { CS_POWER_POINTS = 64, CS_POWER_SERIES = 8, CS_POWER_OCTAVES = 24 };

#define CS_POWER_LEAST 0x1p-24
#define CS_POWER_END 0x1p25

typedef struct cs_power {
  double exponent, point[CS_POWER_POINTS], series[CS_POWER_SERIES];
  double octave[2 * CS_POWER_OCTAVES + 1]; /* the middle one belongs to 1 */
} cs_power;

extern const cs_power cs_power_srgb_encoding, cs_power_srgb_decoding;

/* A number divided as above. octave: e + OCTAVES. */
typedef struct cs_power_parts {
  int32_t octave, slice;
  double r;
} cs_power_parts;

/* x: at least LEAST, and less than END. */
static inline cs_power_parts cs_power_split(double x) {
  uint64_t bits, mantissa_bits;
  memcpy(&bits, &x, sizeof bits);
  int32_t octave = (int32_t)(bits >> 52) - 1023;
  int32_t slice = (int32_t)(bits >> 46 & (CS_POWER_POINTS - 1));
  mantissa_bits = (bits & 0xfffffffffffffu) | (uint64_t)1023 << 52;
  double mantissa, centre = 1 + (slice + 0.5) / CS_POWER_POINTS;
  memcpy(&mantissa, &mantissa_bits, sizeof mantissa);
  return (cs_power_parts){octave + CS_POWER_OCTAVES, slice, (mantissa - centre) / centre};
}

static inline double cs_power_scale(const cs_power *power, int32_t octave, int32_t slice) {
  return power->octave[octave] * power->point[slice];
}

static inline double cs_power_join(const cs_power *power, double scale, double r) {
  double r2 = r * r, r4 = r2 * r2;
  const double *c = power->series;
  double series = ((c[1] * r + c[2] * r2) + r2 * (c[3] * r + c[4] * r2)) +
                  r4 * ((c[5] * r + c[6] * r2) + c[7] * r2 * r);
  return scale + scale * series;
}

static inline double cs_power_of(const cs_power *power, double x) {
  const cs_power_parts parts = cs_power_split(x);
  return cs_power_join(power, cs_power_scale(power, parts.octave, parts.slice), parts.r);
}

/* ---- IEC 61966-2-1, the curve of sRGB, for x >= 0. It is a power above these limits, and a line
 * below them. */

#define CS_POWER_SRGB_LIGHT 0.0031308 /* linear light where the line ends */
#define CS_POWER_SRGB_CODE 0.04045    /* the code in 0..1 where the line ends */
#define CS_POWER_SRGB_SLOPE 12.92     /* how steep the line from light to codes is */

/* The base whose power is the light of a code. */
static inline double cs_power_srgb_base(double code) { return (code + 0.055) / 1.055; }

static inline double cs_power_srgb_encoded(double light, double power) {
  return light <= CS_POWER_SRGB_LIGHT ? CS_POWER_SRGB_SLOPE * light : 1.055 * power - 0.055;
}

/* The code of a light from 0 to 1, by a polynomial in the fourth root of the light, less 5/8: in
 * less time than the power, for what is not a colour. The error is at most 3e-7, and white is 1.
 * All sets of instructions have the same bits. */
static inline float cs_power_srgb_near(float light) {
  const float t = sqrtf(sqrtf(light)) - 0.625F, t2 = t * t, t4 = t2 * t2;
  const float code =
      (0x1.b54116p-2F + 0x1.490cc4p+0F * t + t2 * (0x1.5efae2p-1F - 0x1.f3bda2p-4F * t)) +
      t4 * ((0x1.0c56fcp-4F - 0x1.73ef94p-5F * t + t2 * (0x1.226840p-5F - 0x1.157b52p-4F * t)) +
            t4 * 0x1.6da99ap-4F);
  return light > (float)CS_POWER_SRGB_LIGHT ? code : (float)CS_POWER_SRGB_SLOPE * light;
}

static inline double cs_power_srgb_decoded(double code, double power) {
  return code <= CS_POWER_SRGB_CODE ? code / CS_POWER_SRGB_SLOPE : power;
}
