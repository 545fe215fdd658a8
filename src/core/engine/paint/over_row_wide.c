/* The arithmetic of over.h, a register at a time. The last register of a row of pixels may go
 * beyond them, never beyond the batch.
 */
#include "engine/paint/over_row.h"
#include "engine/paint/over_wide.h"

/* is_first, a constant of each loop: nothing has been added yet, and the state has no contents. */
static inline void add(cs_over_row_state *state, int32_t i, cs_wide s, cs_wide t, bool is_first) {
  cs_wide e = is_first ? cs_wide_all(0) : cs_wide_load(state->e[i]);
  cs_wide through = is_first ? cs_wide_all(1) : cs_wide_load(state->t[i]);
  cs_wide_store(state->e[i], e + through * s);
  cs_wide_store(state->t[i], through * t);
}

void CS_WIDE(cs_over_row_clear)(cs_over_row_state *state, int32_t count) {
  for (int32_t i = 0; i < count; i += CS_OVER_WIDE_PIXELS) {
    cs_wide_store(state->e[i], cs_wide_all(0));
    cs_wide_store(state->t[i], cs_wide_all(1));
  }
}

static inline void add_flats(cs_over_row_state *state, int32_t count, cs_wide s, cs_wide t,
                             bool is_first) {
  for (int32_t i = 0; i < count; i += CS_OVER_WIDE_PIXELS)
    add(state, i, s, t, is_first);
}

void CS_WIDE(cs_over_row_add_flat)(cs_over_row_state *state, int32_t count, bool is_first,
                                   const float s[4], const float t[4]) {
  cs_wide wide_s = cs_over_wide_all(s), wide_t = cs_over_wide_all(t);
  if (is_first)
    add_flats(state, count, wide_s, wide_t, true);
  else
    add_flats(state, count, wide_s, wide_t, false);
}

static inline void add_pictures(cs_over_row_state *state, int32_t count, const float front[4],
                                float fade, bool is_gel, const float (*rgba)[4], bool is_first) {
  const cs_wide_int rgb = CS_WIDE_PIXEL(-1, -1, -1, 0);
  cs_wide light = cs_over_wide_all(front);
  for (int32_t i = 0; i < count; i += CS_OVER_WIDE_PIXELS) {
    cs_wide v = cs_wide_load(rgba[i]);
    cs_wide clear = 1 - cs_wide_unit(CS_WIDE_SPREAD(v, 3));
    cs_wide colour = (cs_wide)((cs_wide_int)v & rgb);
    if (is_gel)
      add(state, i, cs_wide_all(0), (1 - fade) + fade * cs_wide_unit(clear + colour), is_first);
    else
      add(state, i, light * (fade * colour), (1 - fade) + fade * clear, is_first);
  }
}

void CS_WIDE(cs_over_row_add_picture)(cs_over_row_state *state, int32_t count, bool is_first,
                                      const float front[4], float fade, bool is_gel,
                                      const float (*rgba)[4]) {
  if (is_first)
    add_pictures(state, count, front, fade, is_gel, rgba, true);
  else
    add_pictures(state, count, front, fade, is_gel, rgba, false);
}

static inline void add_paints(cs_over_row_state *state, int32_t count, const float front[4],
                              float fade, const float (*s)[4], const float (*t)[4], bool is_first) {
  cs_wide light = cs_over_wide_all(front);
  for (int32_t i = 0; i < count; i += CS_OVER_WIDE_PIXELS)
    add(state, i, light * (fade * cs_wide_load(s[i])), (1 - fade) + fade * cs_wide_load(t[i]),
        is_first);
}

void CS_WIDE(cs_over_row_add_paints)(cs_over_row_state *state, int32_t count, bool is_first,
                                     const float front[4], float fade, const float (*s)[4],
                                     const float (*t)[4]) {
  if (is_first)
    add_paints(state, count, front, fade, s, t, true);
  else
    add_paints(state, count, front, fade, s, t, false);
}

void CS_WIDE(cs_over_row_add_light)(cs_over_row_state *state, int32_t count, const float light[4]) {
  cs_wide wide = cs_over_wide_all(light);
  for (int32_t i = 0; i < count; i += CS_OVER_WIDE_PIXELS)
    cs_wide_store(state->e[i], cs_wide_load(state->e[i]) + cs_wide_load(state->t[i]) * wide);
}

void CS_WIDE(cs_over_row_add_back)(cs_over_row_state *state, int32_t count, const float gain[4],
                                   const float (*s)[4]) {
  cs_wide wide = cs_over_wide_all(gain);
  for (int32_t i = 0; i < count; i += CS_OVER_WIDE_PIXELS)
    cs_wide_store(state->e[i], cs_wide_load(state->e[i]) +
                                   cs_wide_load(state->t[i]) * (wide * cs_wide_load(s[i])));
}

void CS_WIDE(cs_over_row_make_front)(int32_t count, const float gain[4], const float (*s)[4],
                                     float (*front)[4]) {
  cs_wide wide = cs_over_wide_all(gain);
  for (int32_t i = 0; i < count; i += CS_OVER_WIDE_PIXELS)
    cs_wide_store(front[i], wide * cs_wide_load(s[i]));
}

void CS_WIDE(cs_over_row_light_group)(cs_over_row_state *state, int32_t count,
                                      const float (*front)[4]) {
  const cs_wide brightest = cs_wide_all(CS_LAYER_BRIGHTEST);
  for (int32_t i = 0; i < count; i += CS_OVER_WIDE_PIXELS) {
    cs_wide lit = cs_wide_load(state->e[i]) * cs_wide_load(front[i]);
    cs_wide_store(state->e[i], cs_wide_choose(lit > brightest, brightest, lit));
  }
}

void CS_WIDE(cs_over_row_add_group)(cs_over_row_state *outer, int32_t count, float fade,
                                    const cs_over_row_state *inner) {
  for (int32_t i = 0; i < count; i += CS_OVER_WIDE_PIXELS)
    add(outer, i, fade * cs_wide_load(inner->e[i]), (1 - fade) + fade * cs_wide_load(inner->t[i]),
        false);
}

static inline cs_over_pair pair_at(const cs_over_row_state *state, int32_t i) {
  return (cs_over_pair){cs_v4_load(state->e[i]), cs_v4_load(state->t[i])};
}

/* The light of a group, converted to the space around it. */
static inline void leave_space(cs_over_row_state *state, int32_t count, celspan_space to,
                               float keep) {
  const cs_wide_int colours = CS_WIDE_PIXEL(-1, -1, -1, 0);
  float shares[CS_OVER_ROW_BATCH][4];
  shares[0][0] = 0; /* as the compiler asks: the loop fills all that is read */
  for (int32_t i = 0; i < count; i += CS_OVER_WIDE_PIXELS)
    cs_wide_store(shares[i], 1 - keep * cs_wide_load(state->t[i]));
  CS_WIDE(cs_space_pixels)(to, shares[0], count, state->e[0]);
  for (int32_t i = 0; i < count; i += CS_OVER_WIDE_PIXELS)
    cs_wide_store(state->e[i], (cs_wide)((cs_wide_int)cs_wide_load(state->e[i]) & colours));
}

static inline void grade_all(cs_over_row_state *state, int32_t count, const cs_group *group,
                             float keep) {
  for (int32_t i = 0; i < count; i++)
    cs_v4_store(state->e[i], cs_over_grade(group, pair_at(state, i), keep));
}

void CS_WIDE(cs_over_row_develop)(cs_over_row_state *state, int32_t count, const cs_group *group,
                                  float keep) {
  keep = group->is_frame ? keep : 1;
  if (cs_group_keys(group))
    CS_WIDE(cs_over_row_key)(state, count, &group->grade->keying, (celspan_space)group->space);
  else if (group->grade)
    grade_all(state, count, group, keep);
  if (group->converts != CELSPAN_SPACE_AROUND)
    leave_space(state, count, (celspan_space)group->converts, keep);
  for (int32_t i = 0; group->has_front && i < count; i++) {
    cs_over_pair pair = pair_at(state, i);
    cs_v4_store(state->e[i], cs_over_lit(group->front, 1, pair.e, pair.t).e);
  }
}

static inline cs_over_pair faded(float fade, cs_over_pair pair) {
  return (cs_over_pair){fade * pair.e, (1 - fade) + fade * pair.t};
}

void CS_WIDE(cs_over_row_matte)(const cs_over_row_state *head, int32_t count, const cs_group *group,
                                float fade, cs_over_row_state *art) {
  for (int32_t i = 0; i < count; i++) {
    float m = cs_over_strength(group, head ? faded(fade, pair_at(head, i)) : cs_over_pair_clear);
    cs_over_pair pair = pair_at(art, i);
    pair = group->dissolves ? cs_over_dissolve(m, pair) : faded(m, pair);
    cs_v4_store(art->e[i], pair.e);
    cs_v4_store(art->t[i], pair.t);
  }
}

/* Alpha is the mean of the three mattes: 1 where nothing shines through, as in most pixels. */
static inline cs_wide to_rgba(cs_wide e, cs_wide t, float keep) {
  const cs_wide_int colours = CS_WIDE_PIXEL(-1, -1, -1, 0);
  if (!cs_wide_any(t != 0))
    return cs_wide_choose(colours, e, cs_wide_all(1));
  return cs_wide_choose(colours, e, 1 - keep * cs_over_wide_mean(t));
}

void CS_WIDE(cs_over_row_to_rgba)(cs_over_row_state *state, int32_t count, float keep,
                                  float (*rgba)[4]) {
  cs_over_wide_clear_rest(state->t, count);
  for (int32_t i = 0; i < count; i += CS_OVER_WIDE_PIXELS)
    cs_over_wide_put(to_rgba(cs_wide_load(state->e[i]), cs_wide_load(state->t[i]), keep), i, count,
                     rgba);
}
