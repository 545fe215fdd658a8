/* Blend modes of a row of pixels, a register at a time: as cs_over_blend, to the bit. */
#include "engine/paint/over_row.h"
#include "engine/paint/over_wide.h"
#include "model/colour/blend_lanes.h"

static inline cs_wide alpha_of(cs_wide t, float keep) { return 1 - keep * cs_over_wide_mean(t); }

/* The colour of premultiplied light, as cs_over_colour. Most backdrops are opaque: light divided by
 * 1 is the same to the bit. */
static inline cs_wide colour_of(cs_wide e, cs_wide alpha) {
  if (cs_wide_any(alpha != 1))
    e = cs_wide_choose(alpha > 0, e * (1 / alpha), cs_wide_all(0));
  return cs_wide_min(cs_wide_max(e, cs_wide_all(0)), cs_wide_all(1));
}

/* A row of sources, and the backdrops below them. */
typedef struct blending {
  const cs_over_row_state *source;
  float fade, keep; /* fade: of the sources; keep: of their backdrop */
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
    cs_wide both = cs_blend_lanes(CS_BLEND_MODE(mode), colour_of(be, ab), colour_of(se, as));
    cs_wide e = (1 - as) * be;
    cs_wide_store(back->e[i], (is_within ? e : (1 - ab) * se + e) + (as * ab) * both);
    cs_wide_store(back->t[i], is_within ? bt : st * bt);
  }
}

void CS_WIDE(cs_over_row_blend)(cs_over_row_state *source, int32_t count, float fade,
                                celspan_blend mode, float keep, cs_over_row_state *back) {
  cs_over_wide_clear_rest(source->t, count);
  cs_over_wide_clear_rest(back->t, count);
  const blending b = {source, fade, keep, count};
  if (mode == CELSPAN_BLEND_ADD)
    add_all(&b, back);
  else
    blend_all(&b, mode, back);
}
