/* The same arithmetic as the composer's fold of one cell, a register at a time. The last register
 * of a row of pixels may reach beyond them, never beyond the batch.
 */
#include "compose/blend.h"

#define PIXELS (CS_WIDE_LANES / 4)

static inline cs_wide four(const float v[4]) {
  const cs_wide wide = CS_WIDE_PIXEL(v[0], v[1], v[2], v[3]);
  return wide;
}

static inline cs_wide hold(cs_wide v) {
  v = cs_wide_choose(v < 0, cs_wide_all(0), v);
  return cs_wide_choose(v > 1, cs_wide_all(1), v);
}

static inline void add(cs_blend_level *level, int32_t i, cs_wide s, cs_wide t) {
  cs_wide through = cs_wide_load(level->t[i]);
  cs_wide_store(level->e[i], cs_wide_load(level->e[i]) + through * s);
  cs_wide_store(level->t[i], through * t);
}

void CS_WIDE(cs_blend_clear)(cs_blend_level *level, int32_t count) {
  for (int32_t i = 0; i < count; i += PIXELS) {
    cs_wide_store(level->e[i], cs_wide_all(0));
    cs_wide_store(level->t[i], cs_wide_all(1));
  }
}

void CS_WIDE(cs_blend_add_flat)(cs_blend_level *level, int32_t count, const float s[4],
                                const float t[4]) {
  cs_wide wide_s = four(s), wide_t = four(t);
  for (int32_t i = 0; i < count; i += PIXELS)
    add(level, i, wide_s, wide_t);
}

void CS_WIDE(cs_blend_add_picture)(cs_blend_level *level, int32_t count, const float front[4],
                                   float fade, bool is_gel, const float (*rgba)[4]) {
  const cs_wide_int colours = CS_WIDE_PIXEL(-1, -1, -1, 0);
  cs_wide light = four(front);
  for (int32_t i = 0; i < count; i += PIXELS) {
    cs_wide v = cs_wide_load(rgba[i]);
    cs_wide clear = 1 - hold(CS_WIDE_SPREAD(v, 3)), colour = (cs_wide)((cs_wide_int)v & colours);
    if (is_gel)
      add(level, i, cs_wide_all(0), (1 - fade) + fade * hold(clear + colour));
    else
      add(level, i, light * (fade * colour), (1 - fade) + fade * clear);
  }
}

void CS_WIDE(cs_blend_add_paints)(cs_blend_level *level, int32_t count, const float front[4],
                                  float fade, const float (*s)[4], const float (*t)[4]) {
  cs_wide light = four(front);
  for (int32_t i = 0; i < count; i += PIXELS)
    add(level, i, light * (fade * cs_wide_load(s[i])), (1 - fade) + fade * cs_wide_load(t[i]));
}

void CS_WIDE(cs_blend_add_light)(cs_blend_level *level, int32_t count, const float light[4]) {
  cs_wide wide = four(light);
  for (int32_t i = 0; i < count; i += PIXELS)
    cs_wide_store(level->e[i], cs_wide_load(level->e[i]) + cs_wide_load(level->t[i]) * wide);
}

void CS_WIDE(cs_blend_add_group)(cs_blend_level *outer, int32_t count, float fade,
                                 const cs_blend_level *inner) {
  for (int32_t i = 0; i < count; i += PIXELS)
    add(outer, i, fade * cs_wide_load(inner->e[i]), (1 - fade) + fade * cs_wide_load(inner->t[i]));
}

/* Alpha is the mean of the three mattes, as cs_stack_mean takes it. */
static inline cs_wide to_rgba(cs_wide e, cs_wide t, float keep) {
  const cs_wide_int colours = CS_WIDE_PIXEL(-1, -1, -1, 0);
  cs_wide first = CS_WIDE_SPREAD(t, 0), second = CS_WIDE_SPREAD(t, 1), third = CS_WIDE_SPREAD(t, 2);
  cs_wide mean = first + ((second - first) + (third - first)) * (1.0f / 3);
  return cs_wide_choose(colours, e, 1 - keep * mean);
}

static inline void put(cs_wide colour, int32_t i, int32_t count, float (*rgba)[4]) {
  if (i + PIXELS <= count)
    cs_wide_store(rgba[i], colour);
  else
    memcpy(rgba[i], &colour, (size_t)(count - i) * sizeof *rgba);
}

void CS_WIDE(cs_blend_to_rgba)(const cs_blend_level *level, int32_t count, float keep,
                               float (*rgba)[4]) {
  for (int32_t i = 0; i < count; i += PIXELS)
    put(to_rgba(cs_wide_load(level->e[i]), cs_wide_load(level->t[i]), keep), i, count, rgba);
}

/* Multiplying by white and by a fade of 1 changes nothing, and the transmissions of a pixel are
 * equal: what is left of add_picture and to_rgba. */
void CS_WIDE(cs_blend_fold_bare)(const float (*const *layers)[4], uint32_t layer_count,
                                 int32_t count, float (*rgba)[4]) {
  const cs_wide_int colours = CS_WIDE_PIXEL(-1, -1, -1, 0);
  for (int32_t i = 0; i < count; i += PIXELS) {
    cs_wide e = cs_wide_all(0), t = cs_wide_all(1);
    for (uint32_t k = 0; k < layer_count; k++) {
      cs_wide v = cs_wide_load(layers[k][i]);
      e += t * v;
      t *= 1 - hold(CS_WIDE_SPREAD(v, 3));
    }
    put(cs_wide_choose(colours, e, 1 - t), i, count, rgba);
  }
}
