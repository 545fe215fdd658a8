/* Blend modes in doubles, written from the text of W3C Compositing and Blending Level 1, and
 * spaces, from IEC 61966-2-1, without a look at the formulas of model/colour/blend.h,
 * space.h and transfer.c, which the tests compare with these. */
#include <math.h>

#include "base/elementary.h"
#include "base/number.h"
#include "model/colour/blend.h"
#include "model/scene/oracle.h"

/* Modes that leap take numbers as equal if they differ by less: half a code of 15 bits. */
#define EQUAL 0x1p-16

const cs_oracle_sight cs_oracle_nothing = {{0, 0, 0}, {1, 1, 1}, 1};

/* ---------------------------------------------------------------- separable modes */

static double multiply(double b, double s) { return b * s; }
static double screen(double b, double s) { return 1 - (1 - b) * (1 - s); }
static double hard_light(double b, double s) {
  return s <= 0.5 ? multiply(b, 2 * s) : screen(b, 2 * s - 1);
}
static double overlay(double b, double s) { return hard_light(s, b); }

static double color_dodge(double b, double s) {
  if (b == 0)
    return 0;
  return s == 1 ? 1 : fmin(1, b / (1 - s));
}

static double color_burn(double b, double s) {
  if (b == 1)
    return 1;
  return s == 0 ? 0 : 1 - fmin(1, (1 - b) / s);
}

static double softlight(double b, double s) {
  double d = b <= 0.25 ? ((16 * b - 12) * b + 4) * b : sqrt(b);
  return s <= 0.5 ? b - (1 - 2 * s) * b * (1 - b) : b + (2 * s - 1) * (d - b);
}

/* Photoshop's mode, which has no polynomial for dark backdrops. */
static double softlight_photoshop(double b, double s) {
  return s <= 0.5 ? 2 * b * s + b * b * (1 - 2 * s) : 2 * b * (1 - s) + sqrt(b) * (2 * s - 1);
}

static double linear_dodge(double b, double s) { return fmin(1, b + s); }
static double difference(double b, double s) { return fabs(b - s); }
static double exclusion(double b, double s) { return b + s - 2 * b * s; }

static double unit(double x) { return fmax(0, fmin(x, 1)); }

/* Those of painting programs: PDF has no formulas for them, and these are the usual ones. */
static double linear_burn(double b, double s) { return fmax(0, b + s - 1); }
static double linear_light(double b, double s) { return unit(b + 2 * s - 1); }
static double subtract(double b, double s) { return fmax(0, b - s); }
static double hard_mix(double b, double s) { return b <= EQUAL || b + s < 1 - EQUAL ? 0 : 1; }

static double vivid_light(double b, double s) {
  return s < 0.5 ? color_burn(b, 2 * s) : color_dodge(b, 2 * s - 1);
}

static double pin_light(double b, double s) {
  return s < 0.5 ? fmin(b, 2 * s) : fmax(b, 2 * s - 1);
}

static double divide(double b, double s) {
  if (b == 0)
    return 0;
  return s == 0 ? 1 : fmin(1, b / s);
}

static double (*const separable[])(double b, double s) = {
    [CELSPAN_BLEND_MULTIPLY] = multiply,
    [CELSPAN_BLEND_SCREEN] = screen,
    [CELSPAN_BLEND_OVERLAY] = overlay,
    [CELSPAN_BLEND_DARKEN] = fmin,
    [CELSPAN_BLEND_LIGHTEN] = fmax,
    [CELSPAN_BLEND_COLOR_DODGE] = color_dodge,
    [CELSPAN_BLEND_COLOR_BURN] = color_burn,
    [CELSPAN_BLEND_HARD_LIGHT] = hard_light,
    [CELSPAN_BLEND_SOFT_LIGHT] = softlight,
    [CELSPAN_BLEND_DIFFERENCE] = difference,
    [CELSPAN_BLEND_EXCLUSION] = exclusion,
    [CELSPAN_BLEND_LINEAR_DODGE] = linear_dodge,
    [CELSPAN_BLEND_SOFT_LIGHT_PHOTOSHOP] = softlight_photoshop,
    [CELSPAN_BLEND_LINEAR_BURN] = linear_burn,
    [CELSPAN_BLEND_VIVID_LIGHT] = vivid_light,
    [CELSPAN_BLEND_LINEAR_LIGHT] = linear_light,
    [CELSPAN_BLEND_PIN_LIGHT] = pin_light,
    [CELSPAN_BLEND_HARD_MIX] = hard_mix,
    [CELSPAN_BLEND_SUBTRACT] = subtract,
    [CELSPAN_BLEND_DIVIDE] = divide,
};

/* ---------------------------------------------------------------- the others */

typedef struct colour {
  double c[3];
} colour;

static double lum(colour x) { return 0.3 * x.c[0] + 0.59 * x.c[1] + 0.11 * x.c[2]; }
static double least(colour x) { return fmin(x.c[0], fmin(x.c[1], x.c[2])); }
static double most(colour x) { return fmax(x.c[0], fmax(x.c[1], x.c[2])); }
static double sat(colour x) { return most(x) - least(x); }

static colour clip_colour(colour x) {
  double l = lum(x), n = least(x), m = most(x);
  for (int i = 0; i < 3 && n < 0; i++)
    x.c[i] = l + (x.c[i] - l) * l / (l - n);
  for (int i = 0; i < 3 && m > 1; i++)
    x.c[i] = l + (x.c[i] - l) * (1 - l) / (m - l);
  return x;
}

static colour set_lum(colour x, double l) {
  double d = l - lum(x);
  return clip_colour((colour){{x.c[0] + d, x.c[1] + d, x.c[2] + d}});
}

static colour set_sat(colour x, double s) {
  double n = least(x), range = sat(x);
  for (int i = 0; i < 3; i++)
    x.c[i] = range > 0 ? (x.c[i] - n) * s / range : 0;
  return x;
}

static colour blend_whole(celspan_blend mode, colour b, colour s) {
  if (mode == CELSPAN_BLEND_HUE)
    return set_lum(set_sat(s, sat(b)), lum(b));
  if (mode == CELSPAN_BLEND_SATURATION)
    return set_lum(set_sat(b, sat(s)), lum(b));
  return mode == CELSPAN_BLEND_COLOR ? set_lum(s, lum(b)) : set_lum(b, lum(s));
}

static colour blend(celspan_blend mode, colour b, colour s) {
  double lighter = lum(s) - lum(b);
  if (mode == CELSPAN_BLEND_DARKER_COLOR)
    return lighter < -EQUAL ? s : b;
  if (mode == CELSPAN_BLEND_LIGHTER_COLOR)
    return lighter > EQUAL ? s : b;
  if (mode >= CELSPAN_BLEND_HUE && mode <= CELSPAN_BLEND_LUMINOSITY)
    return blend_whole(mode, b, s);
  for (int i = 0; i < 3; i++)
    s.c[i] = mode == CELSPAN_BLEND_NORMAL ? s.c[i]
             : mode == CELSPAN_BLEND_ADD  ? fmin(1, b.c[i] + s.c[i])
                                          : separable[mode](b.c[i], s.c[i]);
  return s;
}

/* ---------------------------------------------------------------- what is seen */

double cs_oracle_alpha(const cs_oracle_sight *sight) {
  return 1 - sight->keep * (sight->through[0] + sight->through[1] + sight->through[2]) / 3;
}

static colour colour_of(const cs_oracle_sight *sight, double alpha) {
  colour x = {{0, 0, 0}};
  for (int i = 0; i < 3 && alpha > 0; i++)
    x.c[i] = cs_number_clamp(sight->light[i] / alpha, 0, 1);
  return x;
}

cs_oracle_sight cs_oracle_before(const cs_oracle_sight *front, const cs_oracle_sight *back) {
  cs_oracle_sight both = {.keep = front->keep * back->keep};
  for (int i = 0; i < 3; i++) {
    both.light[i] = front->light[i] + front->through[i] * back->light[i];
    both.through[i] = front->through[i] * back->through[i];
  }
  return both;
}

static cs_oracle_sight add(const cs_oracle_sight *source, const cs_oracle_sight *back) {
  cs_oracle_sight sum = {.keep = 1};
  for (int i = 0; i < 3; i++) {
    sum.light[i] = source->light[i] + back->light[i];
    double alpha = (1 - source->through[i]) + (1 - back->keep * back->through[i]);
    sum.through[i] = 1 - fmin(1, alpha);
  }
  return sum;
}

cs_oracle_sight cs_oracle_blend(celspan_blend mode, const cs_oracle_sight *source,
                                const cs_oracle_sight *back) {
  if (mode == CELSPAN_BLEND_NORMAL)
    return cs_oracle_before(source, back);
  if (mode == CELSPAN_BLEND_ADD)
    return add(source, back);
  double as = cs_oracle_alpha(source), ab = cs_oracle_alpha(back);
  bool is_within = (unsigned)mode & CS_BLEND_WITHIN;
  colour mixed = blend(CS_BLEND_MODE(mode), colour_of(back, ab), colour_of(source, as));
  cs_oracle_sight both = is_within ? *back : cs_oracle_before(source, back);
  double beyond = is_within ? 0 : 1 - ab;
  for (int i = 0; i < 3; i++)
    both.light[i] = source->light[i] * beyond + back->light[i] * (1 - as) + as * ab * mixed.c[i];
  return both;
}

cs_oracle_sight cs_oracle_fade(const cs_oracle_sight *sight, double weight) {
  cs_oracle_sight faded = {.keep = 1};
  for (int i = 0; i < 3; i++) {
    faded.light[i] = weight * sight->light[i];
    faded.through[i] = 1 - weight + weight * sight->through[i];
  }
  return faded;
}

/* ---------------------------------------------------------------- spaces */

/* The formula is written so that 1 gives exactly 1. */
static double encode(double light) {
  return light <= 0.0031308 ? 12.92 * light : 1 + 1.055 * (cs_elementary_pow(light, 1 / 2.4) - 1);
}

static double decode(double code) {
  return code <= 0.04045 ? code / 12.92 : cs_elementary_pow((code + 0.055) / 1.055, 2.4);
}

double cs_oracle_convert(celspan_space to, double s, double share) {
  double there = fmax(share, fmin(fabs(s), 1));
  if (there <= 0)
    return s;
  double value = fabs(s) / there;
  return copysign(there * (to == CELSPAN_SPACE_SRGB ? encode(value) : decode(value)), s);
}

cs_oracle_sight cs_oracle_leave(celspan_space to, const cs_oracle_sight *sight) {
  cs_oracle_sight left = *sight;
  for (int c = 0; c < 3; c++)
    left.light[c] = cs_oracle_convert(to, sight->light[c], 1 - sight->keep * sight->through[c]);
  return left;
}
