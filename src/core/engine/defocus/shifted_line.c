#include "engine/defocus/shifted_line.h"

#include "base/number.h"

#include <math.h>

#define RECENT 16 /* weights that the nodes of the next tap may be among */
#define TOGETHER CS_DEFOCUS_SUMS_TOGETHER
#define FAR (1 << 28) /* nodes: a tap that is as far is beyond the border of every grid */

/* ---------------------------------------------------------------- weights */

static void add_weight(cs_shifted_line *line, int32_t x, int32_t y, double weight) {
  size_t k = line->count, oldest = k > RECENT ? k - RECENT : 0;
  int32_t wide = x < 0 ? -x : x, high = y < 0 ? -y : y;
  if (!(weight > 0) || (x == 0 && y == 0))
    return;
  while (k > oldest && (line->weights[k - 1].x != x || line->weights[k - 1].y != y))
    k--;
  if (k > oldest)
    line->weights[k - 1].weight += (float)weight;
  else
    line->weights[line->count++] = (cs_shifted_weight){x, y, (float)weight};
  line->extent[0] = wide > line->extent[0] ? wide : line->extent[0];
  line->extent[1] = high > line->extent[1] ? high : line->extent[1];
}

static void add_tap(cs_shifted_line *line, double x, double y, double weight) {
  x = cs_number_clamp(x, -FAR, FAR);
  y = cs_number_clamp(y, -FAR, FAR);
  int32_t i = cs_number_floor(x), j = cs_number_floor(y);
  double across = x - i, down = y - j;
  add_weight(line, i, j, (1 - across) * (1 - down) * weight);
  add_weight(line, i + 1, j, across * (1 - down) * weight);
  add_weight(line, i, j + 1, (1 - across) * down * weight);
  add_weight(line, i + 1, j + 1, across * down * weight);
}

celspan_status cs_shifted_line_init(celspan_context *context, const double end[2], size_t taps,
                                    cs_shifted_line *out) {
  *out = (cs_shifted_line){0};
  CS_TRY(CS_ARRAY_RESERVE(context, out->weights, 2 * taps + 2));
  for (size_t k = (taps + 1) / 2; k < taps; k++) {
    double t = (2 * (double)k + 1) / (double)taps - 1;
    add_tap(out, t * end[0], t * end[1], 1 / (double)taps);
  }
  return CELSPAN_OK;
}

void cs_shifted_line_finish(cs_shifted_line *line, cs_memory *memory) {
  CS_ARRAYS_FREE(memory, line, weights, weights);
  *line = (cs_shifted_line){0};
}

/* ---------------------------------------------------------------- the rows */

static size_t plane_floats(const cs_shifted_line_rows *w) {
  return 4 * (size_t)w->height * (size_t)w->width;
}

/* A extent that matters: beyond it everything is the border of the grid. */
static void place_columns(cs_shifted_line_rows *w) {
  const double extent = w->line->extent[0], count = w->count, left = w->left;
  const double end = fmin(left + extent, w->from->grid->columns) + count;
  w->low = (int32_t)fmin(fmax(left - extent, -count), left);
  w->width = (int32_t)(fmax(end, left + count) - w->low);
}

celspan_status cs_shifted_line_begin(celspan_context *context, const cs_shifted_line *line,
                                     cs_shifted_source *from, int32_t left, int32_t count,
                                     cs_shifted_line_rows *out) {
  int32_t height = 2 * line->extent[1] + 1;
  *out = (cs_shifted_line_rows){.line = line, .from = from, .left = left};
  out->count = (count + TOGETHER - 1) / TOGETHER * TOGETHER;
  out->height = height < from->grid->rows ? height : from->grid->rows;
  place_columns(out);
  CS_TRY(CS_ARRAY_MAKE(context, out->nodes, (size_t)from->grid->planes * plane_floats(out)));
  CS_TRY(CS_ARRAY_MAKE(context, out->pairs, line->count + 1));
  return CS_ARRAY_MAKE(context, out->sums, 4 * (size_t)out->count);
}

static int32_t row_at(const cs_shifted_line_rows *w, int32_t j) {
  return (int32_t)cs_number_clamp(j, 0, w->from->grid->rows - 1);
}

/* Where the first of the summed columns lies in a plane, or what equals it: x and y nodes away. */
static size_t place_of(const cs_shifted_line_rows *w, int32_t j, int32_t x, int32_t y) {
  double column = cs_number_clamp((double)w->left + x - w->low, 0, w->width - w->count);
  size_t row = (size_t)(row_at(w, j + y) % w->height);
  return 4 * (row * (size_t)w->width + (size_t)column);
}

/* Copies `count` nodes of a row from column `low` on, continued by its ends. */
static void copy_row(const float *row, int32_t low, int32_t columns, int32_t count, float *out) {
  int32_t first = (int32_t)cs_number_clamp(-(double)low, 0, count);
  int32_t end = (int32_t)cs_number_clamp((double)columns - low, 0, count);
  for (int32_t i = 0; i < first; i++)
    memcpy(out + 4 * (size_t)i, row, 4 * sizeof *out);
  if (end > first)
    memcpy(out + 4 * (size_t)first, row + 4 * (size_t)(low + first),
           4 * (size_t)(end - first) * sizeof *out);
  for (int32_t i = end > first ? end : first; i < count; i++)
    memcpy(out + 4 * (size_t)i, row + 4 * (size_t)(columns - 1), 4 * sizeof *out);
}

/* Copies the rows around row j that are not there yet. */
static celspan_status fill(celspan_context *context, cs_shifted_line_rows *w, int32_t j) {
  cs_shifted_source *from = w->from;
  int32_t extent = w->line->extent[1], first = row_at(w, j - extent), last = row_at(w, j + extent);
  for (w->next = w->next > first ? w->next : first; w->next <= last; w->next++) {
    CS_TRY(cs_shifted_source_take(context, from, w->next, w->next));
    size_t at = 4 * (size_t)(w->next % w->height) * (size_t)w->width;
    for (int plane = 0; plane < from->grid->planes; plane++)
      copy_row(from->rows[w->next] + (size_t)plane * from->plane, w->low, from->grid->columns,
               w->width, w->nodes + (size_t)plane * plane_floats(w) + at);
  }
  return CELSPAN_OK;
}

static void place_pairs(const cs_shifted_line_rows *w, int32_t j) {
  for (size_t k = 0; k < w->line->count; k++) {
    const cs_shifted_weight *a = &w->line->weights[k];
    w->pairs[k] =
        (cs_defocus_pair){place_of(w, j, -a->x, -a->y), place_of(w, j, a->x, a->y), a->weight};
  }
}

celspan_status cs_shifted_line_row(celspan_context *context, cs_isa isa, cs_shifted_line_rows *rows,
                                   int plane, int32_t j, const float **out) {
  CS_TRY(fill(context, rows, j));
  if (plane == 0)
    place_pairs(rows, j);
  CS_WIDE_CHOOSE(isa, cs_defocus_sums_about)
  (rows->pairs, (int32_t)rows->line->count, rows->nodes + (size_t)plane * plane_floats(rows),
   place_of(rows, j, 0, 0), rows->count, rows->sums);
  *out = rows->sums;
  return CELSPAN_OK;
}
