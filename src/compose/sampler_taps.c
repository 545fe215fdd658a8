/* Pictures that lie at an angle or in perspective: the mean of taps spread over the pixel, each the
 * mix of the four texels about it, or the texel under it.
 *
 *   centres of pixels --moved by a tap--> quads of texels --by stretches in one block--> mixes
 */
#include "compose/sampler_parts.h"

#define ENLARGED (1 << 8 | 1) /* the plan of pixels that one tap is enough for */
#define ROWS_AHEAD 2.5 /* texels are fetched into the cache so many rows before they are mixed */
#define WIDE(run, name) CS_WIDE_CHOOSE((run)->sampler->isa, name)

/* ---------------------------------------------------------------- one tap a pixel */

static void bring_home(const cs_sampler *s, int32_t count, double *u, double *v) {
  for (int32_t i = 0; i < count; i++) {
    u[i] = cs_sampler_home(u[i], s->width, s->wrap);
    v[i] = cs_sampler_home(v[i], s->height, s->wrap);
  }
}

/* A quad that no block holds. */
static void mix_apart(const cs_sampling *run, int level, const cs_sampler_quads *quads, int32_t i,
                      float rgba[4]) {
  cs_v4 quad[4], column[2];
  for (int k = 0; k < 4; k++)
    quad[k] = cs_v4_load(cs_sampling_texel(run, level, quads->x[i] + k % 2, quads->y[i] + k / 2));
  for (int k = 0; k < 2; k++)
    column[k] = quad[k] + quads->down[i] * (quad[k + 2] - quad[k]);
  cs_v4_store(rgba, column[0] + quads->across[i] * (column[1] - column[0]));
}

/* Bytes from a quad to one that the row after the next mixes. u, v, near: of a centre. */
static ptrdiff_t reach_ahead(const cs_sampler *s, int level, double u, double v, double near) {
  double rows = ROWS_AHEAD * near / (double)((int64_t)1 << level);
  double across = (s->m[1] - u * s->m[7]) * rows, down = (s->m[4] - v * s->m[7]) * rows;
  if (!(fabs(across) < CS_PICTURE_BLOCK && fabs(down) < CS_PICTURE_BLOCK))
    return 0;
  return ((ptrdiff_t)rint(down) * CS_PICTURE_BLOCK + (ptrdiff_t)rint(across)) *
         (ptrdiff_t)(4 * sizeof(float));
}

/* seen: pixels that are not need not be mixed; NULL: all are. */
static void mix_stretches(const cs_sampling *run, int level, const cs_sampler_quads *quads,
                          const int32_t *seen, int32_t count, ptrdiff_t ahead, float (*rgba)[4]) {
  for (int32_t i = 0, end; i < count; i = end) {
    int32_t key = quads->key[i];
    end = i + 1;
    if (key < 0) {
      if (!seen || seen[i])
        mix_apart(run, level, quads, i, rgba[i]);
      continue;
    }
    while (end < count && quads->key[end] == key)
      end++;
    const float *block =
        cs_texels_block(run->texels, &run->sampler->source, level, key & 0x7fff, key >> 15);
    WIDE(run, cs_sampler_mix_quads)(block, quads, i, end - i, ahead, rgba + i);
  }
}

static void tap_linear(const cs_sampling *run, int level, cs_sampler_tap tap, int32_t from,
                       int32_t count, const cs_sampler_centres *centres, float (*rgba)[4]) {
  const cs_sampler *s = run->sampler;
  double u[CS_SAMPLER_BATCH], v[CS_SAMPLER_BATCH];
  cs_sampler_quads quads;
  WIDE(run, cs_sampler_move)(s, tap, from, count, centres, u, v);
  if (s->wrap == CELSPAN_WRAP_REPEAT)
    bring_home(s, count, u, v);
  WIDE(run, cs_sampler_find_quads)(s, level, count, u, v, &quads);
  mix_stretches(run, level, &quads, centres->all_seen ? NULL : centres->seen + from, count,
                reach_ahead(s, level, centres->u[from], centres->v[from], centres->near[from]),
                rgba);
}

static void tap_nearest(const cs_sampling *run, int32_t count, const cs_sampler_centres *centres,
                        float (*rgba)[4]) {
  const cs_sampler *s = run->sampler;
  for (int32_t i = 0; i < count; i++) {
    double u = cs_sampler_home(centres->u[i], s->width, s->wrap) + CS_SAMPLER_SAME;
    double v = cs_sampler_home(centres->v[i], s->height, s->wrap) + CS_SAMPLER_SAME;
    if (centres->all_seen || centres->seen[i])
      memcpy(rgba[i], cs_sampling_texel(run, 0, cs_sampler_floor(u), cs_sampler_floor(v)),
             sizeof *rgba);
  }
}

static void tap_cubic(const cs_sampling *run, int32_t from, int32_t count,
                      const cs_sampler_centres *centres, float (*rgba)[4]) {
  const cs_sampler *s = run->sampler;
  for (int32_t i = from; i < from + count; i++)
    if (centres->all_seen || centres->seen[i])
      cs_sampler_cubic(run, cs_sampler_home(centres->u[i], s->width, s->wrap),
                       cs_sampler_home(centres->v[i], s->height, s->wrap), rgba[i - from]);
}

/* ---------------------------------------------------------------- means */

static void tap_mean(const cs_sampling *run, int level, int columns, int rows, int32_t from,
                     int32_t count, const cs_sampler_centres *centres, float (*rgba)[4]) {
  float first[CS_SAMPLER_BATCH][4], next[CS_SAMPLER_BATCH][4];
  int taps = columns * rows;
  if (taps == 1) {
    tap_linear(run, level, (cs_sampler_tap){0, 0}, from, count, centres, rgba);
    return;
  }
  memset(rgba, 0, (size_t)count * sizeof *rgba);
  for (int k = 0; k < taps; k++) {
    cs_sampler_tap tap = {(k % columns + 0.5) / columns - 0.5, (k / columns + 0.5) / rows - 0.5};
    tap_linear(run, level, tap, from, count, centres, k ? next : first);
    if (k)
      WIDE(run, cs_sampler_add_row)
      ((const float(*)[4])next, (const float(*)[4])first, 1, count, rgba);
  }
  WIDE(run, cs_sampler_end_sum)((const float(*)[4])first, (float)taps, count, rgba);
}

/* Stretches of pixels whose means are made alike. */
static void tap_plans(const cs_sampling *run, int32_t count, const cs_sampler_centres *centres,
                      float (*rgba)[4]) {
  int32_t plans[CS_SAMPLER_BATCH];
  WIDE(run, cs_sampler_plan_taps)(run->sampler, count, centres, plans);
  for (int32_t i = 0, end; i < count; i = end) {
    for (end = i + 1; end < count && plans[end] == plans[i];)
      end++;
    if (run->sampler->kernel == CS_SAMPLER_CUBIC && plans[i] == ENLARGED)
      tap_cubic(run, i, end - i, centres, rgba + i);
    else
      tap_mean(run, plans[i] >> 16, plans[i] >> 8 & 0xff, plans[i] & 0xff, i, end - i, centres,
               rgba + i);
  }
}

/* ---------------------------------------------------------------- runs */

static void tap_batch(const cs_sampling *run, int32_t count, const cs_sampler_centres *centres,
                      float (*rgba)[4]) {
  const cs_sampler *s = run->sampler;
  if (s->kernel == CS_SAMPLER_NEAREST)
    tap_nearest(run, count, centres, rgba);
  else if (s->kernel == CS_SAMPLER_LINEAR)
    tap_linear(run, 0, (cs_sampler_tap){0, 0}, 0, count, centres, rgba);
  else if (s->way == CS_SAMPLER_PERSPECTIVE)
    tap_plans(run, count, centres, rgba);
  else
    tap_mean(run, s->level, s->columns, s->rows, 0, count, centres, rgba);
}

/* The usual case, without the detour over centres: one tap a pixel, all of them seen. */
static void tap_plainly(const cs_sampling *run, int32_t x0, int32_t count, double y,
                        float (*rgba)[4]) {
  const cs_sampler *s = run->sampler;
  double u[CS_SAMPLER_BATCH], v[CS_SAMPLER_BATCH];
  cs_sampler_quads quads;
  WIDE(run, cs_sampler_place_taps)(s, x0, count, y, u, v);
  WIDE(run, cs_sampler_find_quads)(s, 0, count, u, v, &quads);
  mix_stretches(run, 0, &quads, NULL, count, reach_ahead(s, 0, 0, 0, 1), rgba);
}

void cs_sampler_taps_run(const cs_sampling *run, int32_t x0, int32_t count, double y,
                         float (*rgba)[4]) {
  const cs_sampler *s = run->sampler;
  cs_sampler_centres centres;
  bool is_plain =
      s->way == CS_SAMPLER_TAPS && s->kernel == CS_SAMPLER_LINEAR && s->wrap == CELSPAN_WRAP_CLAMP;
  for (int32_t done = 0; done < count; done += CS_SAMPLER_BATCH) {
    int32_t batch = count - done < CS_SAMPLER_BATCH ? count - done : CS_SAMPLER_BATCH;
    if (is_plain) {
      tap_plainly(run, x0 + done, batch, y, rgba + done);
      continue;
    }
    if (s->way == CS_SAMPLER_PERSPECTIVE)
      WIDE(run, cs_sampler_map_perspective)(s->m, x0 + done, batch, y, &centres);
    else
      WIDE(run, cs_sampler_map_affine)(s->m, x0 + done, batch, y, &centres);
    centres.all_seen = s->way == CS_SAMPLER_TAPS && s->wrap != CELSPAN_WRAP_CLEAR;
    if (!centres.all_seen)
      WIDE(run, cs_sampler_see)(s, batch, &centres);
    tap_batch(run, batch, &centres, rgba + done);
    if (!centres.all_seen)
      WIDE(run, cs_sampler_clear_unseen)(centres.seen, batch, rgba + done);
  }
}
