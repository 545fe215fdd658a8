#include "model/colour/transfer.h"

#include "base/elementary.h"
#include "model/colour/power.h"
#include "model/colour/transfer_tables.h"

static double power(const cs_power *of, double x) {
  return x >= CS_POWER_LEAST && x < CS_POWER_END ? cs_power_of(of, x)
                                                 : cs_elementary_pow(x, of->exponent);
}

/* ---------------------------------------------------------------- the curves, for x >= 0 */

double cs_transfer_code(double x) {
  return cs_power_srgb_encoded(x, x <= CS_POWER_SRGB_LIGHT ? 0 : power(&cs_power_srgb_encoding, x));
}
double cs_transfer_light(double x) {
  double base = cs_power_srgb_base(x);
  return cs_power_srgb_decoded(x,
                               x <= CS_POWER_SRGB_CODE ? 0 : power(&cs_power_srgb_decoding, base));
}

/* ITU-R BT.709, 1.2. */
static double rec709_encode(double x) {
  return x < 0.018 ? 4.5 * x : 1.099 * power(&rec709_encoding, x) - 0.099;
}
static double rec709_decode(double x) {
  return x < 0.081 ? x / 4.5 : power(&rec709_decoding, (x + 0.099) / 1.099);
}

/* ---------------------------------------------------------------- Cineon */

#define LN10 2.302585092994046
/* 10^((95 - 685)/300): the light of code 95, black, before it is subtracted. */
#define CINEON_BLACK 0.010797751623277096
/* 10^(-685/300): the light of code 0, below which nothing can be coded. */
#define CINEON_FLOOR 0.005207948328595464

static double cineon_encode(double x) {
  double light = x * (1 - CINEON_BLACK) + CINEON_BLACK;
  double decades = cs_elementary_log(light < CINEON_FLOOR ? CINEON_FLOOR : light) / LN10;
  return (685 + 300 * decades) / 1023;
}

static double cineon_decode(double x) {
  double light = cs_elementary_exp((x * 1023 - 685) / 300 * LN10);
  return (light - CINEON_BLACK) / (1 - CINEON_BLACK);
}

/* ---------------------------------------------------------------- */

typedef double (*curve)(double);

static float mirrored(curve of, float x) {
  return (float)(x < 0 ? -of(-(double)x) : of((double)x));
}

float cs_transfer_decode(celspan_transfer transfer, float coded) {
  switch (transfer) {
  case CELSPAN_TRANSFER_SRGB:
    return mirrored(cs_transfer_light, coded);
  case CELSPAN_TRANSFER_REC709:
    return mirrored(rec709_decode, coded);
  case CELSPAN_TRANSFER_CINEON:
    return (float)cineon_decode((double)coded);
  default:
    return coded;
  }
}

float cs_transfer_encode(celspan_transfer transfer, float linear) {
  switch (transfer) {
  case CELSPAN_TRANSFER_SRGB:
    return mirrored(cs_transfer_code, linear);
  case CELSPAN_TRANSFER_REC709:
    return mirrored(rec709_encode, linear);
  case CELSPAN_TRANSFER_CINEON:
    return (float)cineon_encode((double)linear);
  default:
    return linear;
  }
}

/* Within 1/128 of an octave the code changes at most once, so the first code of the interval and
 * one comparison give the code. */
uint8_t cs_transfer_srgb8(float linear) {
  if (!(linear >= 0x1p-13f))
    return 0;
  if (linear >= 1)
    return 255;
  uint32_t bits;
  memcpy(&bits, &linear, sizeof bits);
  unsigned code = srgb8_first[(bits >> 16) - ((127 - 13) << 7)];
  return (uint8_t)(code + (linear >= srgb8_step[code + 1]));
}
