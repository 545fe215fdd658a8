/* The formulas of blend modes (blend.h), for as many colours at once as a register has.
 *
 *     register   r g b . r g b . r g b . r g b .     lane 3 has no meaning
 *     spread     r r r r r r r r r r r r r r r r     a channel, for what is said of whole colours
 */
#pragma once

#include "base/wide.h"
#include "celspan/celspan.h"

/* HARD_MIX, DARKER_COLOR and LIGHTER_COLOR leap where two numbers are equal. Numbers that differ by
 * less than this count as equal, so that rounding decides nothing. */
#define CS_BLEND_EQUAL 0x1p-16f

/* ---------------------------------------------------------------- channels */

static inline cs_wide cs_blend_lanes_hard(cs_wide b, cs_wide s) {
  cs_wide twice = 2 * s - 1;
  return cs_wide_choose(s <= 0.5f, b * (2 * s), b + twice - b * twice);
}

static inline cs_wide cs_blend_lanes_dodge(cs_wide b, cs_wide s) {
  cs_wide bright = cs_wide_choose(b >= 1 - s, cs_wide_all(1), b / (1 - s));
  return cs_wide_choose(b <= 0, cs_wide_all(0), bright);
}

static inline cs_wide cs_blend_lanes_burn(cs_wide b, cs_wide s) {
  cs_wide dark = cs_wide_choose(1 - b >= s, cs_wide_all(0), 1 - (1 - b) / s);
  return cs_wide_choose(b >= 1, cs_wide_all(1), dark);
}

/* bright: the result over a backdrop under a white source. */
static inline cs_wide cs_blend_lanes_softly(cs_wide b, cs_wide s, cs_wide bright) {
  return cs_wide_choose(s <= 0.5f, b - (1 - 2 * s) * b * (1 - b), b + (2 * s - 1) * (bright - b));
}

static inline cs_wide cs_blend_lanes_softlight(cs_wide b, cs_wide s) {
  return cs_blend_lanes_softly(
      b, s, cs_wide_choose(b <= 0.25f, ((16 * b - 12) * b + 4) * b, cs_wide_sqrt(b)));
}

static inline cs_wide cs_blend_lanes_vivid(cs_wide b, cs_wide s) {
  return cs_wide_choose(s < 0.5f, cs_blend_lanes_burn(b, 2 * s),
                        cs_blend_lanes_dodge(b, 2 * s - 1));
}

static inline cs_wide cs_blend_lanes_divide(cs_wide b, cs_wide s) {
  cs_wide bright = cs_wide_choose(b >= s, cs_wide_all(1), b / s);
  return cs_wide_choose(b <= 0, cs_wide_all(0), bright);
}

/* ---------------------------------------------------------------- colours as a whole */

static inline cs_wide cs_blend_lanes_lum(cs_wide c) {
  return 0.3f * CS_WIDE_SPREAD(c, 0) + 0.59f * CS_WIDE_SPREAD(c, 1) + 0.11f * CS_WIDE_SPREAD(c, 2);
}

static inline cs_wide cs_blend_lanes_least(cs_wide c) {
  return cs_wide_min(cs_wide_min(CS_WIDE_SPREAD(c, 0), CS_WIDE_SPREAD(c, 1)), CS_WIDE_SPREAD(c, 2));
}

static inline cs_wide cs_blend_lanes_most(cs_wide c) {
  return cs_wide_max(cs_wide_max(CS_WIDE_SPREAD(c, 0), CS_WIDE_SPREAD(c, 1)), CS_WIDE_SPREAD(c, 2));
}

/* Moves the colour towards its own luminosity until all channels are in 0..1. */
static inline cs_wide cs_blend_lanes_clip(cs_wide c) {
  cs_wide middle = cs_blend_lanes_lum(c), low = cs_blend_lanes_least(c),
          high = cs_blend_lanes_most(c);
  c = cs_wide_choose(low < 0, middle + (c - middle) * (middle / (middle - low)), c);
  return cs_wide_choose(high > 1, middle + (c - middle) * ((1 - middle) / (high - middle)), c);
}

static inline cs_wide cs_blend_lanes_set_lum(cs_wide c, cs_wide value) {
  return cs_blend_lanes_clip(c + (value - cs_blend_lanes_lum(c)));
}

/* The least channel becomes 0 and the greatest `value`; the middle one keeps its relative place. */
static inline cs_wide cs_blend_lanes_set_sat(cs_wide c, cs_wide value) {
  cs_wide low = cs_blend_lanes_least(c), range = cs_blend_lanes_most(c) - low;
  return cs_wide_choose(range > 0, (c - low) * (value / range), cs_wide_all(0));
}

static inline cs_wide cs_blend_lanes_whole(celspan_blend mode, cs_wide b, cs_wide s) {
  switch (mode) {
  case CELSPAN_BLEND_HUE:
    return cs_blend_lanes_set_lum(
        cs_blend_lanes_set_sat(s, cs_blend_lanes_most(b) - cs_blend_lanes_least(b)),
        cs_blend_lanes_lum(b));
  case CELSPAN_BLEND_SATURATION:
    return cs_blend_lanes_set_lum(
        cs_blend_lanes_set_sat(b, cs_blend_lanes_most(s) - cs_blend_lanes_least(s)),
        cs_blend_lanes_lum(b));
  case CELSPAN_BLEND_COLOR:
    return cs_blend_lanes_set_lum(s, cs_blend_lanes_lum(b));
  case CELSPAN_BLEND_DARKER_COLOR:
    return cs_wide_choose(cs_blend_lanes_lum(s) < cs_blend_lanes_lum(b) - CS_BLEND_EQUAL, s, b);
  case CELSPAN_BLEND_LIGHTER_COLOR:
    return cs_wide_choose(cs_blend_lanes_lum(s) > cs_blend_lanes_lum(b) + CS_BLEND_EQUAL, s, b);
  default:
    return cs_blend_lanes_set_lum(b, cs_blend_lanes_lum(s));
  }
}

/* ---------------------------------------------------------------- painting programs */

static inline cs_wide cs_blend_lanes_painted(celspan_blend mode, cs_wide b, cs_wide s) {
  switch (mode) {
  case CELSPAN_BLEND_LINEAR_BURN:
    return cs_wide_max(b + s - 1, cs_wide_all(0));
  case CELSPAN_BLEND_VIVID_LIGHT:
    return cs_blend_lanes_vivid(b, s);
  case CELSPAN_BLEND_LINEAR_LIGHT:
    return cs_wide_unit(b + (2 * s - 1));
  case CELSPAN_BLEND_PIN_LIGHT:
    return cs_wide_max(cs_wide_min(b, 2 * s), 2 * s - 1);
  case CELSPAN_BLEND_HARD_MIX:
    return cs_wide_choose((b > CS_BLEND_EQUAL) & (b + s >= 1 - CS_BLEND_EQUAL), cs_wide_all(1),
                          cs_wide_all(0));
  case CELSPAN_BLEND_SUBTRACT:
    return cs_wide_max(b - s, cs_wide_all(0));
  case CELSPAN_BLEND_DIVIDE:
    return cs_blend_lanes_divide(b, s);
  default:
    return cs_blend_lanes_whole(mode, b, s);
  }
}

/* ---------------------------------------------------------------- any mode */

/* b: the backdrops; s: the sources. ADD is only the mode of sources within their backdrops. */
static inline cs_wide cs_blend_lanes(celspan_blend mode, cs_wide b, cs_wide s) {
  switch (mode) {
  case CELSPAN_BLEND_NORMAL:
    return s;
  case CELSPAN_BLEND_ADD:
  case CELSPAN_BLEND_LINEAR_DODGE:
    return cs_wide_min(b + s, cs_wide_all(1));
  case CELSPAN_BLEND_MULTIPLY:
    return b * s;
  case CELSPAN_BLEND_SCREEN:
    return b + s - b * s;
  case CELSPAN_BLEND_DARKEN:
    return cs_wide_min(b, s);
  case CELSPAN_BLEND_LIGHTEN:
    return cs_wide_max(b, s);
  case CELSPAN_BLEND_DIFFERENCE:
    return cs_wide_max(b - s, s - b);
  case CELSPAN_BLEND_EXCLUSION:
    return b + s - 2 * b * s;
  case CELSPAN_BLEND_OVERLAY:
    return cs_blend_lanes_hard(s, b);
  case CELSPAN_BLEND_HARD_LIGHT:
    return cs_blend_lanes_hard(b, s);
  case CELSPAN_BLEND_COLOR_DODGE:
    return cs_blend_lanes_dodge(b, s);
  case CELSPAN_BLEND_COLOR_BURN:
    return cs_blend_lanes_burn(b, s);
  case CELSPAN_BLEND_SOFT_LIGHT:
    return cs_blend_lanes_softlight(b, s);
  case CELSPAN_BLEND_SOFT_LIGHT_PHOTOSHOP:
    return cs_blend_lanes_softly(b, s, cs_wide_choose(s <= 0.5f, b, cs_wide_sqrt(b)));
  default:
    return cs_blend_lanes_painted(mode, b, s);
  }
}
