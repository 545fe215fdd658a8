#include "compose/soft.h"

#include "base/number.h"

/* How far a line through the nodes may stray from them: half of what a ramp is allowed. */
#define TOLERANCE (0.25f / 1023)
#define STILL 3 /* equal nodes in a row that are worth a span of their own */

static void drop_band(const cs_soft *soft, celspan_context *context, cs_seen_soft *seen, int i) {
  if (seen->bands[i])
    soft->release(soft, context, seen->bands[i]);
  seen->bands[i] = NULL;
}

void cs_soft_leave(const cs_soft *soft, celspan_context *context, cs_seen_soft *seen) {
  drop_band(soft, context, seen, 0);
  drop_band(soft, context, seen, 1);
  cs_mem_free(context->memory, seen->nodes,
              (size_t)soft->columns * (size_t)soft->planes * sizeof *seen->nodes);
  *seen = (cs_seen_soft){0};
}

/* Band `number` as one of the two held, which are those of an even and of an odd number. */
static celspan_status hold_band(const cs_soft *soft, celspan_context *context, cs_seen_soft *seen,
                                int32_t number, const cs_soft_band **out) {
  int i = number % 2;
  if (!seen->bands[i] || seen->numbers[i] != number) {
    drop_band(soft, context, seen, i);
    CS_TRY(soft->acquire(soft, context, number, &seen->bands[i]));
    seen->numbers[i] = number;
  }
  *out = seen->bands[i];
  return CELSPAN_OK;
}

static const float (*band_row(const cs_soft *soft, const cs_soft_band *band, int plane,
                              int32_t row))[4] {
  size_t at = (size_t)plane * (size_t)soft->band_rows + (size_t)(row % soft->band_rows);
  return (const float(*)[4])band->nodes + at * (size_t)soft->columns;
}

static void blend_rows(const cs_soft *soft, cs_seen_soft *seen, const cs_soft_band *upper,
                       const cs_soft_band *lower, int32_t row, float share) {
  size_t columns = (size_t)soft->columns;
  for (int plane = 0; plane < soft->planes; plane++) {
    const float(*a)[4] = band_row(soft, upper, plane, row);
    const float(*b)[4] = band_row(soft, lower, plane, row + 1);
    float(*out)[4] = seen->nodes + (size_t)plane * columns;
    for (size_t i = 0; i < columns; i++) {
      cs_v4 above = cs_v4_load(a[i]);
      cs_v4_store(out[i], above + share * (cs_v4_load(b[i]) - above));
    }
  }
}

celspan_status cs_soft_stand(const cs_soft *soft, celspan_context *context, cs_seen_soft *seen,
                             double y) {
  if (seen->stands && seen->y == y)
    return CELSPAN_OK;
  size_t size = (size_t)soft->columns * (size_t)soft->planes;
  if (!seen->nodes && !(seen->nodes = cs_mem_array(context->memory, size, sizeof *seen->nodes)))
    return cs_fail_memory(context);
  double at = cs_number_clamp(y / soft->pitch_y + 0.5, 0, soft->rows - 1);
  int32_t row = cs_number_floor(at);
  row = row > soft->rows - 2 ? soft->rows - 2 : row;
  const cs_soft_band *upper, *lower;
  seen->stands = false;
  CS_TRY(hold_band(soft, context, seen, row / soft->band_rows, &upper));
  CS_TRY(hold_band(soft, context, seen, (row + 1) / soft->band_rows, &lower));
  blend_rows(soft, seen, upper, lower, row, (float)(at - row));
  seen->stands = true;
  seen->y = y;
  return CELSPAN_OK;
}

void cs_soft_paint(const cs_soft *soft, const cs_seen_soft *seen, double x, cs_v4 *s, cs_v4 *t) {
  double at = cs_number_clamp(x / soft->pitch_x + 0.5, 0, soft->columns - 1);
  int32_t i = (int32_t)at;
  i = i > soft->columns - 2 ? soft->columns - 2 : i;
  float share = (float)(at - i);
  const float(*nodes)[4] = (const float(*)[4])seen->nodes + i;
  cs_v4 left = cs_v4_load(nodes[0]), value = left + share * (cs_v4_load(nodes[1]) - left);
  *s = value;
  (*s)[3] = 0;
  *t = cs_v4_all(1 - value[3]);
  if (soft->planes == 2) {
    nodes += soft->columns;
    left = cs_v4_load(nodes[0]);
    *t = left + share * (cs_v4_load(nodes[1]) - left);
  }
  (*t)[3] = 0;
}

/* ---------------------------------------------------------------- straight pieces */

/* A line from a node on, as steep as the nodes after it allow. */
typedef struct swing {
  int32_t from;
  cs_v4 start[2], least[2], most[2];
} swing;

static cs_v4 node(const cs_soft *soft, const cs_seen_soft *seen, int plane, int32_t i) {
  return cs_v4_load(seen->nodes[(size_t)plane * (size_t)soft->columns + (size_t)i]);
}

static void swing_begin(swing *line, const cs_soft *soft, const cs_seen_soft *seen, int32_t i) {
  line->from = i;
  for (int plane = 0; plane < soft->planes; plane++) {
    line->start[plane] = node(soft, seen, plane, i);
    line->least[plane] = cs_v4_all(-INFINITY);
    line->most[plane] = cs_v4_all(INFINITY);
  }
}

/* Whether the line from its first node to node i is near all between; then takes node i in. */
static bool swing_reaches(swing *line, const cs_soft *soft, const cs_seen_soft *seen, int32_t i) {
  float across = 1 / (float)(i - line->from), slack = TOLERANCE * across;
  bool reaches = true;
  for (int plane = 0; plane < soft->planes; plane++) {
    cs_v4 slope = (node(soft, seen, plane, i) - line->start[plane]) * across;
    for (int c = 0; c < 4; c++) {
      float low = slope[c] - slack, high = slope[c] + slack;
      float least = line->least[plane][c], most = line->most[plane][c];
      reaches &= slope[c] >= least && slope[c] <= most;
      line->least[plane][c] = low > least ? low : least;
      line->most[plane][c] = high < most ? high : most;
    }
  }
  return reaches;
}

static bool is_still(const cs_soft *soft, const cs_seen_soft *seen, int32_t i) {
  for (int plane = 0; plane < soft->planes; plane++)
    if (!cs_v4_same(node(soft, seen, plane, i), node(soft, seen, plane, i + 1)))
      return false;
  return true;
}

/* The last node of the constant stretch from i on. */
static int32_t still_end(const cs_soft *soft, const cs_seen_soft *seen, int32_t i, int32_t last) {
  while (i < last && is_still(soft, seen, i))
    i++;
  return i;
}

size_t cs_soft_break_limit(const cs_soft *soft) { return (size_t)soft->columns; }

size_t cs_soft_breaks(const cs_soft *soft, const cs_seen_soft *seen, double x0, double x1,
                      double *breaks) {
  double low = x0 / soft->pitch_x + 0.5, high = x1 / soft->pitch_x + 0.5;
  int32_t first = cs_number_floor(cs_number_clamp(low, 0, soft->columns - 2));
  int32_t last = cs_number_ceil(cs_number_clamp(high, 1, soft->columns - 1));
  size_t count = 0;
  swing line;
  swing_begin(&line, soft, seen, first);
  for (int32_t i = first; i < last; i++) {
    int32_t still = still_end(soft, seen, i, last);
    bool rests = still - i >= STILL;
    if (rests && i > line.from)
      breaks[count++] = (i - 0.5) * soft->pitch_x;
    i = rests ? still : i;
    if (rests || (i > line.from && !swing_reaches(&line, soft, seen, i + 1))) {
      if (i < last)
        breaks[count++] = (i - 0.5) * soft->pitch_x;
      swing_begin(&line, soft, seen, i);
      if (i < last)
        swing_reaches(&line, soft, seen, i + 1);
    } else if (i == line.from) {
      swing_reaches(&line, soft, seen, i + 1);
    }
  }
  size_t kept = 0;
  for (size_t i = 0; i < count; i++)
    if (breaks[i] > x0 && breaks[i] < x1)
      breaks[kept++] = breaks[i];
  return kept;
}
