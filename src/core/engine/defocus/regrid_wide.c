/* Four rows of nodes mixed into one, in the lanes of registers; what is visible of it; and then its
 * columns, as many at a time as a register has pixels:
 *
 *     columns    first w w w   first w w w      the weights are spread over the channels
 *     four[k]    node          node             from the places that the columns begin at
 */
#include "engine/defocus/regrid.h"

#include "base/vector.h"

#define PIXELS (CS_WIDE_LANES / 4)
#define REGISTERS 4 /* registers that are looked at together */

_Static_assert(sizeof(cs_regrid_column) == sizeof(cs_v4), "a column lies where a pixel does");

/* ---------------------------------------------------------------- rows */

/* Values about the one before a place, by the weights of the other three. The others are subtracted
 * from it, because an instruction can read what it subtracts from memory. */
static inline cs_wide mixed(const cs_wide four[4], const cs_wide weights[3]) {
  return four[1] - (weights[0] * (four[1] - four[0]) + weights[1] * (four[1] - four[2]) +
                    weights[2] * (four[1] - four[3]));
}

static inline void mix_at(const float *const rows[4], const cs_wide weights[3], size_t at,
                          float *out) {
  cs_wide four[4];
  for (int k = 0; k < 4; k++)
    four[k] = cs_wide_load(rows[k] + at);
  cs_wide_store(out + at, mixed(four, weights));
}

void CS_WIDE(cs_regrid_mix)(const float *const rows[4], const float weights[3], size_t count,
                            float *out) {
  const float *const four[4] = {rows[0], rows[1], rows[2], rows[3]};
  const cs_wide shares[3] = {cs_wide_all(weights[0]), cs_wide_all(weights[1]),
                             cs_wide_all(weights[2])};
#pragma GCC unroll 4
  for (size_t i = 0; i < count / CS_WIDE_LANES; i++)
    mix_at(four, shares, i * CS_WIDE_LANES, out);
  mix_at(four, shares, count - CS_WIDE_LANES, out);
}

/* ---------------------------------------------------------------- what is visible */

static inline bool are_clear(const float *nodes) {
  cs_wide_int any = {0};
  for (int k = 0; k < REGISTERS; k++)
    any |= (cs_wide_int)cs_wide_load(nodes + k * CS_WIDE_LANES);
  return !cs_wide_any(any != 0);
}

static inline bool is_clear(const float node[4]) {
  return cs_v4_same(cs_v4_load(node), cs_v4_all(0));
}

cs_defocused_range CS_WIDE(cs_regrid_visible)(const float (*nodes)[4], cs_defocused_range within) {
  const int32_t together = REGISTERS * PIXELS;
  int32_t first = within.first, end = within.end;
  while (end - first >= together && are_clear(nodes[first]))
    first += together;
  while (first < end && is_clear(nodes[first]))
    first++;
  while (end - first >= together && are_clear(nodes[end - together]))
    end -= together;
  while (end > first && is_clear(nodes[end - 1]))
    end--;
  return (cs_defocused_range){first, end};
}

/* ---------------------------------------------------------------- columns */

/* Light and mattes are not negative, and a matte is at most 1; a cubic may pass these bounds. */
static inline void mix_columns(const cs_regrid_column *columns, const float (*nodes)[4],
                               float *out) {
  const cs_wide most = CS_WIDE_PIXEL(INFINITY, INFINITY, INFINITY, 1);
  cs_wide column, four[4];
  memcpy(&column, columns, sizeof column);
  for (int k = 0; k < 4; k++) {
    const float *pixels[PIXELS];
    for (int i = 0; i < PIXELS; i++)
      pixels[i] = nodes[columns[i].first + k];
    four[k] = cs_wide_pixels(pixels);
  }
  const cs_wide weights[3] = {CS_WIDE_SPREAD(column, 1), CS_WIDE_SPREAD(column, 2),
                              CS_WIDE_SPREAD(column, 3)};
  cs_wide_store(out, cs_wide_min(cs_wide_max(mixed(four, weights), cs_wide_all(0)), most));
}

void CS_WIDE(cs_regrid_across)(const cs_regrid_column *columns, int32_t count,
                               const float (*nodes)[4], float (*out)[4]) {
  int32_t whole = count - count % PIXELS, rest = count - whole;
  for (int32_t i = 0; i < whole; i += PIXELS)
    mix_columns(columns + i, nodes, out[i]);
  if (rest == 0)
    return;
  cs_regrid_column last[PIXELS];
  float mixed_last[PIXELS][4];
  for (int32_t i = 0; i < PIXELS; i++)
    last[i] = columns[i < rest ? whole + i : count - 1];
  mix_columns(last, nodes, mixed_last[0]);
  memcpy(out[whole], mixed_last, (size_t)rest * sizeof *out);
}
