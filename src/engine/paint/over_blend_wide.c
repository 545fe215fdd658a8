/* Blend modes of a row of pixels, a register at a time: the formulas of model/colour/blend.h and of
 * cs_over_blend, to the bit.
 *
 *     register   r g b . r g b . r g b . r g b .     lane 3 has no meaning
 *     spread     r r r r r r r r r r r r r r r r     a channel, for what is said of whole colours
 */
#include "engine/paint/over_row.h"
#include "engine/paint/over_wide.h"

/* ---------------------------------------------------------------- channels */

static inline cs_wide multiply_or_screen(cs_wide b, cs_wide s) {
  cs_wide twice = 2 * s - 1;
  return cs_wide_choose(s <= 0.5f, b * (2 * s), b + twice - b * twice);
}

static inline cs_wide dodge(cs_wide b, cs_wide s) {
  cs_wide bright = cs_wide_choose(b >= 1 - s, cs_wide_all(1), b / (1 - s));
  return cs_wide_choose(b <= 0, cs_wide_all(0), bright);
}

static inline cs_wide burn(cs_wide b, cs_wide s) {
  cs_wide dark = cs_wide_choose(1 - b >= s, cs_wide_all(0), 1 - (1 - b) / s);
  return cs_wide_choose(b >= 1, cs_wide_all(1), dark);
}

/* bright: what a backdrop becomes under white. */
static inline cs_wide softly(cs_wide b, cs_wide s, cs_wide bright) {
  return cs_wide_choose(s <= 0.5f, b - (1 - 2 * s) * b * (1 - b), b + (2 * s - 1) * (bright - b));
}

static inline cs_wide softlight(cs_wide b, cs_wide s) {
  return softly(b, s, cs_wide_choose(b <= 0.25f, ((16 * b - 12) * b + 4) * b, cs_wide_sqrt(b)));
}

/* ---------------------------------------------------------------- colours as a whole */

static inline cs_wide lum(cs_wide c) {
  return 0.3f * CS_WIDE_SPREAD(c, 0) + 0.59f * CS_WIDE_SPREAD(c, 1) + 0.11f * CS_WIDE_SPREAD(c, 2);
}

static inline cs_wide least(cs_wide c) {
  return cs_wide_min(cs_wide_min(CS_WIDE_SPREAD(c, 0), CS_WIDE_SPREAD(c, 1)), CS_WIDE_SPREAD(c, 2));
}

static inline cs_wide most(cs_wide c) {
  return cs_wide_max(cs_wide_max(CS_WIDE_SPREAD(c, 0), CS_WIDE_SPREAD(c, 1)), CS_WIDE_SPREAD(c, 2));
}

static inline cs_wide clip(cs_wide c) {
  cs_wide middle = lum(c), low = least(c), high = most(c);
  c = cs_wide_choose(low < 0, middle + (c - middle) * (middle / (middle - low)), c);
  return cs_wide_choose(high > 1, middle + (c - middle) * ((1 - middle) / (high - middle)), c);
}

static inline cs_wide set_lum(cs_wide c, cs_wide value) { return clip(c + (value - lum(c))); }

static inline cs_wide set_sat(cs_wide c, cs_wide value) {
  cs_wide low = least(c), range = most(c) - low;
  return cs_wide_choose(range > 0, (c - low) * (value / range), cs_wide_all(0));
}

static inline cs_wide whole(celspan_blend mode, cs_wide b, cs_wide s) {
  switch (mode) {
  case CELSPAN_BLEND_HUE:
    return set_lum(set_sat(s, most(b) - least(b)), lum(b));
  case CELSPAN_BLEND_SATURATION:
    return set_lum(set_sat(b, most(s) - least(s)), lum(b));
  case CELSPAN_BLEND_COLOR:
    return set_lum(s, lum(b));
  default:
    return set_lum(b, lum(s));
  }
}

/* ---------------------------------------------------------------- any mode */

static inline cs_wide blend(celspan_blend mode, cs_wide b, cs_wide s) {
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
    return multiply_or_screen(s, b);
  case CELSPAN_BLEND_HARD_LIGHT:
    return multiply_or_screen(b, s);
  case CELSPAN_BLEND_COLOR_DODGE:
    return dodge(b, s);
  case CELSPAN_BLEND_COLOR_BURN:
    return burn(b, s);
  case CELSPAN_BLEND_SOFT_LIGHT:
    return softlight(b, s);
  case CELSPAN_BLEND_SOFT_LIGHT_PHOTOSHOP:
    return softly(b, s, cs_wide_choose(s <= 0.5f, b, cs_wide_sqrt(b)));
  default:
    return whole(mode, b, s);
  }
}

static inline cs_wide alpha_of(cs_wide t, float keep) { return 1 - keep * cs_over_wide_mean(t); }

/* The colour of premultiplied light, as cs_over_colour. Most backdrops are opaque: light divided by
 * 1 is the same to the bit. */
static inline cs_wide colour_of(cs_wide e, cs_wide alpha) {
  if (cs_wide_any(alpha != 1))
    e = cs_wide_choose(alpha > 0, e * (1 / alpha), cs_wide_all(0));
  return cs_wide_min(cs_wide_max(e, cs_wide_all(0)), cs_wide_all(1));
}

/* A row of sources, and what they are put over. */
typedef struct blending {
  const cs_over_row_state *source;
  float fade, keep; /* of the sources; of their backdrop */
  int32_t count;
} blending;

static inline cs_wide source_e(const blending *b, int32_t i) {
  return b->fade * cs_wide_load(b->source->e[i]);
}

static inline cs_wide source_t(const blending *b, int32_t i) {
  return (1 - b->fade) + b->fade * cs_wide_load(b->source->t[i]);
}

static void add_all(const blending *b, cs_over_row_state *back) {
  for (int32_t i = 0; i < b->count; i += CS_OVER_WIDE_PIXELS) {
    cs_wide rest = source_t(b, i) - (1 - b->keep * cs_wide_load(back->t[i]));
    cs_wide_store(back->e[i], source_e(b, i) + cs_wide_load(back->e[i]));
    cs_wide_store(back->t[i], cs_wide_max(rest, cs_wide_all(0)));
  }
}

static void blend_all(const blending *b, celspan_blend mode, cs_over_row_state *back) {
  bool is_within = (unsigned)mode & CS_BLEND_WITHIN;
  for (int32_t i = 0; i < b->count; i += CS_OVER_WIDE_PIXELS) {
    cs_wide se = source_e(b, i), st = source_t(b, i);
    cs_wide be = cs_wide_load(back->e[i]), bt = cs_wide_load(back->t[i]);
    cs_wide as = alpha_of(st, 1), ab = alpha_of(bt, b->keep);
    cs_wide both = blend(CS_BLEND_MODE(mode), colour_of(be, ab), colour_of(se, as));
    cs_wide e = (1 - as) * be;
    cs_wide_store(back->e[i], (is_within ? e : (1 - ab) * se + e) + (as * ab) * both);
    cs_wide_store(back->t[i], is_within ? bt : st * bt);
  }
}

void CS_WIDE(cs_over_row_blend)(const cs_over_row_state *source, int32_t count, float fade,
                                celspan_blend mode, float keep, cs_over_row_state *back) {
  const blending b = {source, fade, keep, count};
  if (mode == CELSPAN_BLEND_ADD)
    add_all(&b, back);
  else
    blend_all(&b, mode, back);
}
