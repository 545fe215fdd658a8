/* Places among the nodes of a grid, many at a time in loops of a few steps each, which become
 * vector code; and the nodes there. */
#include "engine/defocus/shifted.h"

#include "base/vector.h"
#include "model/colour/power.h"
#include "model/colour/space.h"

#define TOGETHER 32 /* places */
#define SIDES 8     /* of which the least and the greatest are found in lanes of their own */

static inline void convert(celspan_space to, int32_t count, float *shares) {
  if (to == CELSPAN_SPACE_SRGB)
    for (int32_t i = 0; i < count; i++)
      shares[i] = cs_power_srgb_near(shares[i]); /* no move shows its error */
  else
    for (int32_t i = 0; i < count; i++)
      shares[i] = cs_space_channel(to, shares[i], 1);
}

/* count: at most TOGETHER; mostly that, which is a constant then. */
static inline void find_moves(const cs_shifted_moving *moving, const float (*nodes)[4],
                              int32_t count, double *out) {
  const double scale = moving->scale, clear = moving->clear;
  const bool is_alpha = moving->channel == CELSPAN_CHANNEL_ALPHA;
  const float *channel = &nodes[0][moving->channel];
  float alpha[TOGETHER], shares[TOGETHER];
  for (int32_t i = 0; i < count; i++) {
    alpha[i] = nodes[i][CELSPAN_CHANNEL_ALPHA];
    shares[i] = channel[4 * i];
  }
  for (int32_t i = 0; i < count; i++) {
    float whole = is_alpha || !(alpha[i] > 0) ? 1 : alpha[i], share = shares[i] / whole;
    share = share > 0 ? share : 0;
    shares[i] = share < 1 ? share : 1;
  }
  if (moving->is_converted && !is_alpha)
    convert(moving->space, count, shares);
  for (int32_t i = 0; i < count; i++) {
    double move = scale * ((double)shares[i] - 0.5);
    out[i] = alpha[i] > 0 ? move : clear;
  }
}

void CS_WIDE(cs_shifted_moves)(const cs_shifted_moving *moving, const float (*nodes)[4],
                               int32_t count, double *out) {
  int32_t first = 0;
  for (; first + TOGETHER <= count; first += TOGETHER)
    find_moves(moving, nodes + first, TOGETHER, out + first);
  if (first < count)
    find_moves(moving, nodes + first, count - first, out + first);
}

void CS_WIDE(cs_shifted_move)(const double start[2], const double step[2], const double units[2][2],
                              int32_t count, double *x, double *y) {
  const double x0 = start[0], y0 = start[1], x_step = step[0], y_step = step[1];
  const double xx = units[0][0], xy = units[0][1], yx = units[1][0], yy = units[1][1];
  for (int32_t i = 0; i < count; i++) {
    double across = x[i], down = y[i];
    x[i] = x0 + x_step * i + (xx * across + xy * down);
    y[i] = y0 + y_step * i + (yx * across + yy * down);
  }
}

/* What is not a number is 0. */
static inline double clamped(double at, double last) {
  at = at > 0 ? at : 0;
  return at < last ? at : last;
}

void CS_WIDE(cs_shifted_settle)(const double last[2], int32_t count, double *x, double *y,
                                double range[2]) {
  const double right = last[0], bottom = last[1];
  double low[SIDES], high[SIDES];
  int32_t i = 0;
  for (int k = 0; k < SIDES; k++) {
    low[k] = bottom;
    high[k] = 0;
  }
  for (; i + SIDES <= count; i += SIDES)
    for (int k = 0; k < SIDES; k++) {
      double down = clamped(y[i + k], bottom);
      x[i + k] = clamped(x[i + k], right);
      y[i + k] = down;
      low[k] = down < low[k] ? down : low[k];
      high[k] = down > high[k] ? down : high[k];
    }
  for (; i < count; i++) {
    x[i] = clamped(x[i], right);
    y[i] = clamped(y[i], bottom);
    low[0] = y[i] < low[0] ? y[i] : low[0];
    high[0] = y[i] > high[0] ? y[i] : high[0];
  }
  for (int k = 1; k < SIDES; k++) {
    low[0] = low[k] < low[0] ? low[k] : low[0];
    high[0] = high[k] > high[0] ? high[k] : high[0];
  }
  range[0] = low[0];
  range[1] = high[0];
}

static inline cs_v4 mix(const float *upper, const float *lower, float across, float down) {
  cs_v4 a = cs_v4_load(upper), b = cs_v4_load(lower);
  a += across * (cs_v4_load(upper + 4) - a);
  b += across * (cs_v4_load(lower + 4) - b);
  return a + down * (b - a);
}

static inline void read_all(const cs_shifted_nodes *nodes, const double *x, const double *y,
                            int32_t count, bool adds, float *out) {
  const float *const *rows = nodes->rows;
  const int32_t right = nodes->columns - 2, bottom = nodes->count - 2;
  int32_t columns[TOGETHER], above[TOGETHER];
  float across[TOGETHER], down[TOGETHER];
  for (int32_t first = 0; first < count; first += TOGETHER) {
    int32_t some = count - first < TOGETHER ? count - first : TOGETHER;
    for (int32_t k = 0; k < some; k++) {
      int32_t i = (int32_t)x[first + k], j = (int32_t)y[first + k];
      i = i < right ? i : right;
      j = j < bottom ? j : bottom;
      columns[k] = 4 * i;
      above[k] = j;
      across[k] = (float)(x[first + k] - i);
      down[k] = (float)(y[first + k] - j);
    }
    for (int32_t k = 0; k < some; k++, out += 4) {
      size_t at = nodes->offset + (size_t)columns[k];
      cs_v4 value = mix(rows[above[k]] + at, rows[above[k] + 1] + at, across[k], down[k]);
      cs_v4_store(out, adds ? cs_v4_load(out) + value : value);
    }
  }
}

void CS_WIDE(cs_shifted_read)(const cs_shifted_nodes *nodes, const double *x, const double *y,
                              int32_t count, bool adds, float *out) {
  if (adds)
    read_all(nodes, x, y, count, true, out);
  else
    read_all(nodes, x, y, count, false, out);
}
