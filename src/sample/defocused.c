#include "sample/defocused.h"

#include "base/number.h"

#include <math.h>

/* How far a line between knots may stray from the nodes: half of what a ramp is allowed. */
#define TOLERANCE (0.25f / 1023)
#define STILL 3 /* equal nodes in a row that are worth a piece of their own */

/* ---------------------------------------------------------------- knots */

typedef struct node_row {
  const float (*planes[2])[4]; /* nodes */
  int plane_count;
  int32_t last; /* node */
  bool
      is_split; /* nodes are shown as they are: a line may end in one and the next begin after it */
} node_row;

static void free_knots(cs_defocused_knots *knots, cs_memory *memory) {
  cs_mem_free(memory, knots->at, knots->at_capacity * sizeof *knots->at);
  cs_mem_free(memory, knots->values, knots->value_capacity * sizeof *knots->values);
  cs_mem_free(memory, knots->still, knots->still_capacity * sizeof *knots->still);
  *knots = (cs_defocused_knots){0};
}

static void add_knot(const node_row *row, int32_t i, cs_defocused_knots *out) {
  float(*values)[4] = out->values + out->count * (size_t)row->plane_count;
  for (int plane = 0; plane < row->plane_count; plane++)
    memcpy(values[plane], row->planes[plane][i], sizeof *values);
  out->at[out->count++] = i;
}

static bool is_still(const node_row *row, int32_t i) {
  for (int plane = 0; plane < row->plane_count; plane++)
    if (!cs_v4_same(cs_v4_load(row->planes[plane][i]), cs_v4_load(row->planes[plane][i + 1])))
      return false;
  return true;
}

/* The last node of the constant stretch from i on; i where it is too short to tell. */
static int32_t still_end(const node_row *row, int32_t i) {
  int32_t end = i;
  while (end < row->last && is_still(row, end))
    end++;
  return end - i >= STILL || end == row->last ? end : i;
}

/* Lines from a node on, as steep as the nodes after it allow. */
typedef struct swing {
  cs_v4 least[2], most[2];
} swing;

static inline bool is_within(cs_v4 value, cs_v4 least, cs_v4 most) {
  typedef long long words __attribute__((vector_size(16)));
  words lanes = (words)((value >= least) & (value <= most));
  return (lanes[0] & lanes[1]) == -1;
}

/* Whether the line from node `from` to node i is near all between; then takes node i in. */
static inline bool swing_reaches(swing *s, const node_row *row, int32_t from, int32_t i) {
  float across = 1 / (float)(i - from);
  cs_v4 slack = cs_v4_all(TOLERANCE * across);
  for (int plane = 0; plane < row->plane_count; plane++) {
    cs_v4 start = cs_v4_load(row->planes[plane][from]);
    cs_v4 slope = (cs_v4_load(row->planes[plane][i]) - start) * across;
    if (!is_within(slope, s->least[plane], s->most[plane]))
      return false;
    s->least[plane] = cs_v4_max(s->least[plane], slope - slack);
    s->most[plane] = cs_v4_min(s->most[plane], slope + slack);
  }
  return true;
}

/* The last node that a line from `from` reaches, where no constant stretch begins before. */
static int32_t swing_end(const node_row *row, int32_t from) {
  swing s = {{cs_v4_all(-INFINITY), cs_v4_all(-INFINITY)},
             {cs_v4_all(INFINITY), cs_v4_all(INFINITY)}};
  for (int32_t i = from + 1; i <= row->last; i++) {
    if (!swing_reaches(&s, row, from, i))
      return i - 1;
    if (i < row->last && is_still(row, i) && still_end(row, i) > i)
      return i;
  }
  return row->last;
}

/* What a line between two nodes adds to the sum of the nodes between them. */
static cs_v4 light_added(const node_row *row, int plane, int32_t from, int32_t to) {
  const float(*nodes)[4] = row->planes[plane];
  cs_v4 sum = cs_v4_all(0), ends = cs_v4_load(nodes[from]) + cs_v4_load(nodes[to]);
  for (int32_t i = from + 1; i < to; i++)
    sum += cs_v4_load(nodes[i]);
  return ends * (0.5f * (float)(to - from - 1)) - sum;
}

/* Whether a row's knot stays what it is: at its ends, and beside constant stretches. */
static bool is_fixed(const cs_defocused_knots *knots, size_t first, size_t k) {
  return k == first || k + 1 == knots->count || knots->still[k - first] ||
         knots->still[k - first - 1];
}

/* Lines through nodes lie above a hollow and below a hill: each moves its ends by half of what it
 * adds, or the one that may move by all, so that the row keeps its light. first: of the row's
 * knots. */
static void balance(const node_row *row, cs_defocused_knots *knots, size_t first) {
  size_t planes = (size_t)row->plane_count;
  for (size_t p = 0; p < planes; p++) {
    cs_v4 owed = cs_v4_all(0); /* by the line that ends in the knot */
    for (size_t k = first; k + 1 < knots->count; k++) {
      bool moves = !is_fixed(knots, first, k);
      cs_v4 added = light_added(row, (int)p, knots->at[k], knots->at[k + 1]);
      cs_v4 here = is_fixed(knots, first, k + 1) ? added : 0.5f * added;
      if (moves) {
        float *value = knots->values[k * planes + p];
        float wide = 0.5f * (float)(knots->at[k + 1] - knots->at[k - 1]);
        cs_v4_store(value, cs_v4_bounded(cs_v4_load(value) - (owed + here) * (1 / wide)));
      }
      owed = moves ? added - here : added;
    }
  }
}

/* Appends the knots of a row. */
static celspan_status add_row(celspan_context *context, const node_row *row,
                              cs_defocused_knots *out) {
  size_t first = out->count, limit = first + (size_t)row->last + 1;
  CS_TRY(cs_mem_reserve(context, (void **)&out->at, &out->at_capacity, limit, sizeof *out->at));
  CS_TRY(cs_mem_reserve(context, (void **)&out->values, &out->value_capacity,
                        limit * (size_t)row->plane_count, sizeof *out->values));
  CS_TRY(cs_mem_reserve(context, (void **)&out->still, &out->still_capacity, (size_t)row->last + 1,
                        sizeof *out->still));
  add_knot(row, 0, out);
  for (int32_t i = 0; i < row->last;) {
    int32_t still = still_end(row, i);
    out->still[out->count - 1 - first] = still > i;
    i = still > i ? still : swing_end(row, i);
    add_knot(row, i, out);
    if (row->is_split && !out->still[out->count - 2 - first] && i + 1 < row->last &&
        still_end(row, i) == i) {
      out->still[out->count - 1 - first] = false;
      add_knot(row, ++i, out);
    }
  }
  out->still[out->count - 1 - first] = false;
  balance(row, out, first);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- bands */

void cs_defocus_band_free(cs_defocus_band *band, cs_memory *memory) {
  cs_mem_free(memory, band->nodes, band->node_count * sizeof *band->nodes);
  cs_mem_free(memory, band->rows, band->row_capacity * sizeof *band->rows);
  free_knots(&band->knots, memory);
  *band = (cs_defocus_band){0};
}

size_t cs_defocus_band_bytes(const cs_defocus_band *band) {
  return band->node_count * sizeof *band->nodes + band->row_capacity * sizeof *band->rows +
         band->knots.at_capacity * sizeof *band->knots.at +
         band->knots.value_capacity * sizeof *band->knots.values +
         band->knots.still_capacity * sizeof *band->knots.still;
}

static const float (*band_row(const cs_defocused *soft, const cs_defocus_band *band, int plane,
                              int32_t row))[4] {
  size_t at = (size_t)plane * (size_t)soft->band_rows + (size_t)(row % soft->band_rows);
  return (const float(*)[4])band->nodes + at * (size_t)soft->columns;
}

static node_row band_nodes(const cs_defocused *soft, const cs_defocus_band *band, int32_t row) {
  node_row out = {
      .plane_count = soft->planes, .last = soft->columns - 1, .is_split = soft->pitch_x == 1};
  for (int plane = 0; plane < soft->planes; plane++)
    out.planes[plane] = band_row(soft, band, plane, row);
  return out;
}

/* Gives back the room that knots did not need. */
static void fit(cs_memory *memory, void **items, size_t *capacity, size_t count, size_t size) {
  void *smaller = cs_mem_resize(memory, *items, *capacity * size, count * size);
  if (!smaller)
    return;
  *items = smaller;
  *capacity = count;
}

celspan_status cs_defocus_band_thin(const cs_defocused *soft, celspan_context *context,
                                    int32_t rows, cs_defocus_band *band) {
  cs_memory *memory = context->memory;
  cs_defocused_knots *knots = &band->knots;
  CS_TRY(cs_mem_reserve(context, (void **)&band->rows, &band->row_capacity, (size_t)rows + 1,
                        sizeof *band->rows));
  for (int32_t row = 0; row < rows; row++) {
    node_row nodes = band_nodes(soft, band, row);
    band->rows[row] = knots->count;
    CS_TRY(add_row(context, &nodes, knots));
  }
  band->rows[rows] = knots->count;
  fit(memory, (void **)&knots->at, &knots->at_capacity, knots->count, sizeof *knots->at);
  fit(memory, (void **)&knots->values, &knots->value_capacity, knots->count * (size_t)soft->planes,
      sizeof *knots->values);
  cs_mem_free(memory, band->nodes, band->node_count * sizeof *band->nodes);
  band->nodes = NULL;
  band->node_count = 0;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- rows */

static void drop_band(const cs_defocused *soft, celspan_context *context, cs_defocused_view *seen,
                      int i) {
  if (seen->bands[i])
    soft->release(soft, context, seen->bands[i]);
  seen->bands[i] = NULL;
}

void cs_defocused_leave(const cs_defocused *soft, celspan_context *context,
                        cs_defocused_view *seen) {
  drop_band(soft, context, seen, 0);
  drop_band(soft, context, seen, 1);
  free_knots(&seen->own, context->memory);
  cs_mem_free(context->memory, seen->blended,
              (size_t)soft->columns * (size_t)soft->planes * sizeof *seen->blended);
  *seen = (cs_defocused_view){0};
}

/* Band `number` as one of the two held, which are those of an even and of an odd number. */
static celspan_status hold_band(const cs_defocused *soft, celspan_context *context,
                                cs_defocused_view *seen, int32_t number,
                                const cs_defocus_band **out) {
  int i = number % 2;
  if (!seen->bands[i] || seen->numbers[i] != number) {
    drop_band(soft, context, seen, i);
    CS_TRY(soft->acquire(soft, context, number, &seen->bands[i]));
    seen->numbers[i] = number;
  }
  *out = seen->bands[i];
  return CELSPAN_OK;
}

static celspan_status blend_rows(const cs_defocused *soft, celspan_context *context,
                                 cs_defocused_view *seen, node_row *upper, const node_row *lower,
                                 float share) {
  size_t columns = (size_t)soft->columns, size = columns * (size_t)soft->planes;
  if (!seen->blended &&
      !(seen->blended = cs_mem_array(context->memory, size, sizeof *seen->blended)))
    return cs_fail_memory(context);
  for (int plane = 0; plane < soft->planes; plane++) {
    const float(*a)[4] = upper->planes[plane], (*b)[4] = lower->planes[plane];
    float(*out)[4] = seen->blended + (size_t)plane * columns;
    for (size_t i = 0; i < columns; i++) {
      cs_v4 above = cs_v4_load(a[i]);
      cs_v4_store(out[i], above + share * (cs_v4_load(b[i]) - above));
    }
    upper->planes[plane] = (const float(*)[4])out;
  }
  return CELSPAN_OK;
}

static celspan_status make_knots(const cs_defocused *soft, celspan_context *context,
                                 cs_defocused_view *seen, const cs_defocus_band *upper, int32_t row,
                                 float share) {
  node_row nodes = band_nodes(soft, upper, row);
  if (share > 0) {
    const cs_defocus_band *lower;
    CS_TRY(hold_band(soft, context, seen, (row + 1) / soft->band_rows, &lower));
    node_row below = band_nodes(soft, lower, row + 1);
    CS_TRY(blend_rows(soft, context, seen, &nodes, &below, share));
  }
  seen->own.count = 0;
  CS_TRY(add_row(context, &nodes, &seen->own));
  seen->at = seen->own.at;
  seen->values = (const float(*)[4])seen->own.values;
  seen->count = seen->own.count;
  return CELSPAN_OK;
}

celspan_status cs_defocused_stand(const cs_defocused *soft, celspan_context *context,
                                  cs_defocused_view *seen, double y) {
  if (seen->stands && seen->y == y)
    return CELSPAN_OK;
  double at = cs_number_clamp(y / soft->pitch_y + 0.5, 0, soft->rows - 1);
  int32_t row = cs_number_floor(at);
  row = row > soft->rows - 2 ? soft->rows - 2 : row;
  const cs_defocus_band *band;
  seen->stands = false;
  CS_TRY(hold_band(soft, context, seen, row / soft->band_rows, &band));
  if (band->nodes) {
    CS_TRY(make_knots(soft, context, seen, band, row, (float)(at - row)));
  } else {
    size_t first = band->rows[row % soft->band_rows];
    seen->at = band->knots.at + first;
    seen->values = (const float(*)[4])band->knots.values + first * (size_t)soft->planes;
    seen->count = band->rows[row % soft->band_rows + 1] - first;
  }
  seen->stands = true;
  seen->y = y;
  return CELSPAN_OK;
}

size_t cs_defocused_find(const cs_defocused_view *seen, double at, size_t hint) {
  size_t low = 0, high = seen->count - 1; /* at[low] <= at, at < at[high] or high is the last */
  if (hint < high && seen->at[hint] <= at) {
    low = hint;
    if (hint + 1 == high || at < seen->at[hint + 1])
      return hint;
    if (hint + 2 == high || at < seen->at[hint + 2])
      return hint + 1;
  }
  while (high - low > 1) {
    size_t middle = low + (high - low) / 2;
    *(seen->at[middle] <= at ? &low : &high) = middle;
  }
  return low;
}

void cs_defocused_paint(const cs_defocused *soft, const cs_defocused_view *seen, double x,
                        size_t *piece, cs_v4 *s, cs_v4 *t) {
  double at = cs_defocused_at(soft, x);
  size_t k = *piece = cs_defocused_find(seen, at, *piece), planes = (size_t)soft->planes;
  float share = (float)((at - seen->at[k]) / (seen->at[k + 1] - seen->at[k]));
  const float(*a)[4] = seen->values + k * planes, (*b)[4] = a + planes;
  cs_v4 left = cs_v4_load(a[0]), value = left + share * (cs_v4_load(b[0]) - left);
  *s = value;
  (*s)[3] = 0;
  *t = cs_v4_all(1 - value[3]);
  if (planes == 2) {
    left = cs_v4_load(a[1]);
    *t = left + share * (cs_v4_load(b[1]) - left);
  }
  (*t)[3] = 0;
}

size_t cs_defocused_break_limit(const cs_defocused *soft) { return (size_t)soft->columns; }

size_t cs_defocused_breaks(const cs_defocused *soft, const cs_defocused_view *seen, double x0,
                           double x1, double *breaks) {
  size_t count = 0;
  for (size_t k = cs_defocused_find(seen, cs_defocused_at(soft, x0), 0); k < seen->count; k++) {
    double x = (seen->at[k] - 0.5) * soft->pitch_x;
    if (x >= x1)
      break;
    if (x > x0)
      breaks[count++] = x;
  }
  return count;
}
