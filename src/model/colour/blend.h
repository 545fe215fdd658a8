/* Blend modes: what a colour of a source and one of its backdrop give where both are there.
 *
 *     separable          each channel by itself: multiply, screen, ... exclusion
 *     not separable      hue, saturation, color, luminosity: of the colour as a whole
 *
 * W3C Compositing and Blending Level 1, chapter 10. CELSPAN_BLEND_ADD has no such colour: it adds
 * what is premultiplied (engine/compose/over.h). The two modes after it are those of painting
 * programs, and separable.
 *
 * Colours are not premultiplied, and in 0..1. Lane 3 has no meaning. Every operation is exact IEEE
 * arithmetic, so the bits do not depend on the instruction set.
 */
#pragma once

#include <math.h>
#include <stdbool.h>

#include "base/vector.h"
#include "celspan/celspan.h"

#define CS_BLEND_COUNT (CELSPAN_BLEND_SOFT_LIGHT_PHOTOSHOP + 1)

/* Added to a mode: the source shows only as far as its backdrop is there, whose alpha it leaves; so
 * a mode of this kind is never CELSPAN_BLEND_NORMAL. What "add" gives is then clamped to 1. */
#define CS_BLEND_WITHIN 32
#define CS_BLEND_MODE(blend) ((celspan_blend)((unsigned)(blend) & (CS_BLEND_WITHIN - 1)))

/* The words of celspan_blend, ended by NULL. */
extern const char *const cs_blend_words[];

static inline float cs_blend_hard(float b, float s) {
  return s <= 0.5f ? b * (2 * s) : b + (2 * s - 1) - b * (2 * s - 1);
}

static inline float cs_blend_dodge(float b, float s) {
  if (b <= 0)
    return 0;
  return b >= 1 - s ? 1 : b / (1 - s);
}

static inline float cs_blend_burn(float b, float s) {
  if (b >= 1)
    return 1;
  return 1 - b >= s ? 0 : 1 - (1 - b) / s;
}

static inline float cs_blend_softlight(float b, float s) {
  if (s <= 0.5f)
    return b - (1 - 2 * s) * b * (1 - b);
  float d = b <= 0.25f ? ((16 * b - 12) * b + 4) * b : sqrtf(b);
  return b + (2 * s - 1) * (d - b);
}

static inline float cs_blend_softlight_photoshop(float b, float s) {
  return s <= 0.5f ? cs_blend_softlight(b, s) : b + (2 * s - 1) * (sqrtf(b) - b);
}

static inline float cs_blend_channel(celspan_blend mode, float b, float s) {
  switch (mode) {
  case CELSPAN_BLEND_OVERLAY:
    return cs_blend_hard(s, b);
  case CELSPAN_BLEND_COLOR_DODGE:
    return cs_blend_dodge(b, s);
  case CELSPAN_BLEND_COLOR_BURN:
    return cs_blend_burn(b, s);
  case CELSPAN_BLEND_HARD_LIGHT:
    return cs_blend_hard(b, s);
  case CELSPAN_BLEND_SOFT_LIGHT_PHOTOSHOP:
    return cs_blend_softlight_photoshop(b, s);
  default:
    return cs_blend_softlight(b, s);
  }
}

/* ---------------------------------------------------------------- colours as a whole */

static inline float cs_blend_lum(cs_v4 c) { return 0.3f * c[0] + 0.59f * c[1] + 0.11f * c[2]; }

static inline float cs_blend_least(cs_v4 c) {
  float least = c[0] < c[1] ? c[0] : c[1];
  return least < c[2] ? least : c[2];
}

static inline float cs_blend_most(cs_v4 c) {
  float most = c[0] > c[1] ? c[0] : c[1];
  return most > c[2] ? most : c[2];
}

/* Moved towards its own luminosity until it is in 0..1. */
static inline cs_v4 cs_blend_clip(cs_v4 c) {
  float lum = cs_blend_lum(c), least = cs_blend_least(c), most = cs_blend_most(c);
  if (least < 0)
    c = lum + (c - lum) * (lum / (lum - least));
  if (most > 1)
    c = lum + (c - lum) * ((1 - lum) / (most - lum));
  return c;
}

static inline cs_v4 cs_blend_set_lum(cs_v4 c, float lum) {
  return cs_blend_clip(c + (lum - cs_blend_lum(c)));
}

static inline float cs_blend_sat(cs_v4 c) { return cs_blend_most(c) - cs_blend_least(c); }

/* Its least channel becomes 0, its greatest `sat`, and that between them keeps its place. */
static inline cs_v4 cs_blend_set_sat(cs_v4 c, float sat) {
  float least = cs_blend_least(c), range = cs_blend_most(c) - least;
  return range > 0 ? (c - least) * (sat / range) : cs_v4_all(0);
}

static inline cs_v4 cs_blend_whole(celspan_blend mode, cs_v4 b, cs_v4 s) {
  switch (mode) {
  case CELSPAN_BLEND_HUE:
    return cs_blend_set_lum(cs_blend_set_sat(s, cs_blend_sat(b)), cs_blend_lum(b));
  case CELSPAN_BLEND_SATURATION:
    return cs_blend_set_lum(cs_blend_set_sat(b, cs_blend_sat(s)), cs_blend_lum(b));
  case CELSPAN_BLEND_COLOR:
    return cs_blend_set_lum(s, cs_blend_lum(b));
  default:
    return cs_blend_set_lum(b, cs_blend_lum(s));
  }
}

/* ---------------------------------------------------------------- any mode */

/* b: of the backdrop; s: of the source. ADD is that of sources within their backdrops. */
static inline cs_v4 cs_blend_colour(celspan_blend mode, cs_v4 b, cs_v4 s) {
  switch (mode) {
  case CELSPAN_BLEND_NORMAL:
    return s;
  case CELSPAN_BLEND_ADD:
  case CELSPAN_BLEND_LINEAR_DODGE:
    return cs_v4_min(b + s, cs_v4_all(1));
  case CELSPAN_BLEND_MULTIPLY:
    return b * s;
  case CELSPAN_BLEND_SCREEN:
    return b + s - b * s;
  case CELSPAN_BLEND_DARKEN:
    return cs_v4_min(b, s);
  case CELSPAN_BLEND_LIGHTEN:
    return cs_v4_max(b, s);
  case CELSPAN_BLEND_DIFFERENCE:
    return cs_v4_max(b - s, s - b);
  case CELSPAN_BLEND_EXCLUSION:
    return b + s - 2 * b * s;
  case CELSPAN_BLEND_HUE:
  case CELSPAN_BLEND_SATURATION:
  case CELSPAN_BLEND_COLOR:
  case CELSPAN_BLEND_LUMINOSITY:
    return cs_blend_whole(mode, b, s);
  default:
    break;
  }
  return (cs_v4){cs_blend_channel(mode, b[0], s[0]), cs_blend_channel(mode, b[1], s[1]),
                 cs_blend_channel(mode, b[2], s[2]), 0};
}
