/* A run is cut where a formula of its program bends or a texel begins, and each piece becomes one
 * span if it is straight enough, else it is halved. The colours of many pieces are taken at once.
 */
#include "paint/lines.h"

#include "base/number.h"
#include "paint/colours.h"
#include "paint/gradient_run.h"
#include "paint/line.h"
#include "paint/over_row.h"
#include "paint/shade.h"

#include <math.h>
#include <stdlib.h>

/* ---------------------------------------------------------------- ramps */

typedef struct ramp {
  cs_painter *painter;
  const cs_program *program;
  const cs_gradient_table *table; /* of the program, or NULL */
  double y;
  cs_row *row;
} ramp;

static bool is_near(cs_v4 a, cs_v4 b) {
  for (int c = 0; c < 4; c++)
    if (!(fabsf(a[c] - b[c]) <= CS_LINE_TOLERANCE))
      return false;
  return true;
}

static celspan_status ramp_colours(const ramp *r, const int32_t *columns, int32_t count,
                                   float (*rgba)[4]) {
  return cs_painter_batch_colours(r->painter, r->program, &(cs_batch){columns, 0, count, r->y},
                                  rgba);
}

/* The colour of a column on the line between the end columns of [x0, x1). */
static cs_v4 on_line(int32_t x0, int32_t x1, cs_v4 first, cs_v4 last, int32_t column) {
  return first + (float)(column - x0) / (float)(x1 - 1 - x0) * (last - first);
}

/* Whether the line between the end columns of [x0, x1) is near the colours of the three quarters.
 */
static bool is_straight(int32_t x0, int32_t x1, cs_v4 first, cs_v4 last, const float (*inner)[4]) {
  for (int quarter = 1; quarter <= 3 && x1 - x0 > 2; quarter++)
    if (!is_near(cs_v4_load(inner[quarter - 1]),
                 on_line(x0, x1, first, last, cs_line_quarter((cs_run){x0, x1, 0}, quarter))))
      return false;
  return true;
}

static celspan_status put_halves(const ramp *r, int32_t x0, int32_t x1, cs_v4 first, cs_v4 last);

/* Appends [x0, x1) as straight pieces, halving until each is; `first`, `last`: the colours of its
 * end columns. A piece of two columns is always straight, so the depth is at most log2(width). */
static celspan_status put_ramp(const ramp *r, int32_t x0, int32_t x1, cs_v4 first, cs_v4 last) {
  int32_t columns[3];
  float inner[3][4] = {{0}};
  for (int k = 0; k < 3; k++)
    columns[k] = cs_line_quarter((cs_run){x0, x1, 0}, k + 1);
  if (x1 - x0 > 2)
    CS_TRY(ramp_colours(r, columns, 3, inner));
  return is_straight(x0, x1, first, last, (const float(*)[4])inner)
             ? cs_line_put(r->painter->context, r->row, (cs_run){x0, x1, 0}, first, last)
             : put_halves(r, x0, x1, first, last);
}

static celspan_status put_halves(const ramp *r, int32_t x0, int32_t x1, cs_v4 first, cs_v4 last) {
  int32_t middle = x0 + (x1 - x0) / 2, columns[2] = {middle - 1, middle};
  float rgba[2][4];
  CS_TRY(ramp_colours(r, columns, 2, rgba));
  CS_TRY(put_ramp(r, x0, middle, first, cs_v4_load(rgba[0])));
  return put_ramp(r, middle, x1, cs_v4_load(rgba[1]), last);
}

/* ---------------------------------------------------------------- pieces */

/* How many columns of a piece tell all of it. */
typedef enum piece_shape {
  STEPPED = 1,  /* one colour: any */
  STRAIGHT = 2, /* a line: its ends */
  CURVED = 5    /* its ends and the quarters, and more if they tell that it bends */
} piece_shape;

static int bend_of(const cs_painter *painter, const cs_layer *layer) {
  if (layer->kind == CS_LAYER_FLAT)
    return 0;
  const cs_image_layer *image = &painter->stack->images[layer->detail];
  if (layer->kind != CS_LAYER_PICTURE || image->texture->use == CELSPAN_PICTURE_GEL)
    return 2;
  return painter->images[layer->detail].sampler.kernel == CS_SAMPLER_NEAREST ? 0 : 1;
}

/* One leaf that varies as a line makes lines, since all that is done to it is linear; the product
 * of two does not. */
static piece_shape shape_of(const cs_painter *painter, const cs_program *program) {
  int bends = 0;
  for (uint32_t i = 0; i < program->length; i++)
    bends += bend_of(painter, &painter->stack->layers[program->items[i].layer]);
  return bends == 0 ? STEPPED : bends == 1 ? STRAIGHT : CURVED;
}

static void pick_columns(piece_shape shape, int32_t x0, int32_t x1, int32_t *columns) {
  if (shape == STEPPED)
    columns[0] = x0 + (x1 - x0) / 2;
  for (int k = 0; k < (int)shape && shape != STEPPED; k++)
    columns[k] = cs_line_quarter((cs_run){x0, x1, 0}, shape == STRAIGHT ? 4 * k : k);
}

static celspan_status put_piece(const ramp *r, piece_shape shape, int32_t x0, int32_t x1,
                                const float (*rgba)[4]) {
  cs_v4 first = cs_v4_load(rgba[0]), last = cs_v4_load(rgba[shape - 1]);
  if (shape == STEPPED)
    return cs_row_single(r->painter->context, r->row, x0, x1, first);
  if (shape == CURVED && !is_straight(x0, x1, first, last, rgba + 1))
    return put_halves(r, x0, x1, first, last);
  return cs_line_put(r->painter->context, r->row, (cs_run){x0, x1, 0}, first, last);
}

/* The pieces between neighbours of `ends`, which ascend. */
static celspan_status put_pieces(const ramp *r, const int32_t *ends, size_t count) {
  piece_shape shape = shape_of(r->painter, r->program);
  int32_t columns[CS_OVER_ROW_BATCH];
  float rgba[CS_OVER_ROW_BATCH][4];
  size_t most = CS_OVER_ROW_BATCH / (size_t)shape;
  for (size_t i = 0; i + 1 < count; i += most) {
    size_t pieces = count - 1 - i < most ? count - 1 - i : most;
    for (size_t k = 0; k < pieces; k++)
      pick_columns(shape, ends[i + k], ends[i + k + 1], columns + k * (size_t)shape);
    CS_TRY(ramp_colours(r, columns, (int32_t)(pieces * (size_t)shape), rgba));
    for (size_t k = 0; k < pieces; k++)
      CS_TRY(put_piece(r, shape, ends[i + k], ends[i + k + 1],
                       (const float(*)[4])rgba + k * (size_t)shape));
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- pieces of a table
 *
 * The same columns, but colours by themselves cost little: none is taken that does not count. */

static cs_v4 table_colour(const ramp *r, int32_t column) {
  r->painter->evaluations++;
  return cs_gradient_table_colour(r->table, column + 0.5, r->y);
}

/* middle: the colour of the second quarter. */
static bool is_table_straight(const ramp *r, int32_t x0, int32_t x1, cs_v4 first, cs_v4 last,
                              cs_v4 middle) {
  int32_t columns[3];
  for (int k = 0; k < 3; k++)
    columns[k] = cs_line_quarter((cs_run){x0, x1, 0}, k + 1);
  return is_near(middle, on_line(x0, x1, first, last, columns[1])) &&
         is_near(table_colour(r, columns[0]), on_line(x0, x1, first, last, columns[0])) &&
         is_near(table_colour(r, columns[2]), on_line(x0, x1, first, last, columns[2]));
}

static celspan_status put_table_ramp(const ramp *r, int32_t x0, int32_t x1, cs_v4 first,
                                     cs_v4 last) {
  int32_t centre = cs_line_quarter((cs_run){x0, x1, 0}, 2), middle = x0 + (x1 - x0) / 2;
  cs_v4 colour = first;
  if (x1 - x0 > 2)
    colour = table_colour(r, centre);
  if (x1 - x0 <= 2 || is_table_straight(r, x0, x1, first, last, colour))
    return cs_line_put(r->painter->context, r->row, (cs_run){x0, x1, 0}, first, last);
  cs_v4 before = centre == middle - 1 ? colour : table_colour(r, middle - 1);
  CS_TRY(put_table_ramp(r, x0, middle, first, before));
  cs_v4 after = centre == middle ? colour : table_colour(r, middle);
  return put_table_ramp(r, middle, x1, after, last);
}

static celspan_status put_table_pieces(const ramp *r, const int32_t *ends, size_t count) {
  for (size_t i = 0; i + 1 < count; i++)
    CS_TRY(put_table_ramp(r, ends[i], ends[i + 1], table_colour(r, ends[i]),
                          table_colour(r, ends[i + 1] - 1)));
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- where pieces end */

static int compare_columns(const void *a, const void *b) {
  int32_t p = *(const int32_t *)a, q = *(const int32_t *)b;
  return (p > q) - (p < q);
}

static size_t strip_break_limit(const cs_procedure_span *procedure_span) {
  return procedure_span->paint_count;
}

static size_t strip_breaks(const cs_procedure_span *procedure_span, double x0, double x1,
                           double *out) {
  size_t count = 0;
  for (size_t i = 1; i + 1 < procedure_span->paint_count; i++) {
    double u = (double)i / (double)(procedure_span->paint_count - 1);
    double x = procedure_span->x0 + u * (procedure_span->x1 - procedure_span->x0);
    if (x > x0 && x < x1)
      out[count++] = x;
  }
  return count;
}

static size_t formula_break_limit(const cs_painter *painter,
                                  const cs_procedure_span *procedure_spans, cs_item item) {
  const cs_stack *stack = painter->stack;
  const cs_layer *layer = &stack->layers[item.layer];
  return layer->kind == CS_LAYER_SHADED ? cs_shade_break_limit(&stack->shades[layer->detail])
         : layer->kind == CS_LAYER_SCANLINE
             ? strip_break_limit(&procedure_spans[item.procedure_span])
         : layer->kind == CS_LAYER_DEFOCUSED
             ? cs_defocused_break_limit(stack->defocused[layer->detail])
             : 0;
}

static celspan_status formula_breaks(cs_painter *painter, const cs_procedure_span *procedure_spans,
                                     cs_item item, double y, double x0, double x1, double *out,
                                     size_t *count) {
  const cs_stack *stack = painter->stack;
  const cs_layer *layer = &stack->layers[item.layer];
  *count = 0;
  if (layer->kind == CS_LAYER_SHADED) {
    *count = cs_shade_breaks(&stack->shades[layer->detail], y, x0, x1, out);
  } else if (layer->kind == CS_LAYER_SCANLINE) {
    *count = strip_breaks(&procedure_spans[item.procedure_span], x0, x1, out);
  } else if (layer->kind == CS_LAYER_DEFOCUSED) {
    const cs_defocused *soft = stack->defocused[layer->detail];
    cs_defocused_view *seen = &painter->defocused[layer->detail];
    CS_TRY(cs_defocused_stand(soft, painter->context, seen, y));
    *count = cs_defocused_breaks(soft, seen, x0, x1, out);
  }
  return CELSPAN_OK;
}

/* Columns that end pieces, ascending, in room of the row's own arena (the scratch arena is used
 * anew for every colour). */
typedef struct ends {
  int32_t *columns, *other; /* other: room to merge into */
  size_t count;
} ends;

static celspan_status make_room(const ramp *r, int32_t x0, int32_t x1, ends *out) {
  const cs_painter *painter = r->painter;
  size_t limit = 2;
  for (uint32_t i = 0; i < r->program->length; i++) {
    const cs_layer *layer = &painter->stack->layers[r->program->items[i].layer];
    limit += layer->kind == CS_LAYER_PICTURE
                 ? cs_sampler_step_limit(&painter->images[layer->detail].sampler, x0, x1)
                 : formula_break_limit(painter, r->program->procedure_spans, r->program->items[i]);
  }
  out->count = 0;
  out->columns = cs_arena_take(painter->context, &r->row->colours, limit * sizeof(int32_t));
  out->other = cs_arena_take(painter->context, &r->row->colours, limit * sizeof(int32_t));
  return out->columns && out->other ? CELSPAN_OK : CELSPAN_NO_MEMORY;
}

/* Merges the last `count` columns, which ascend, with those before. */
static void merge(ends *list, size_t count) {
  size_t before = list->count, i = 0, j = before, end = before + count;
  list->count = end;
  if (before == 0 || count == 0 || list->columns[before - 1] <= list->columns[before])
    return;
  for (size_t k = 0; k < end; k++)
    list->other[k] = j == end || (i < before && list->columns[i] <= list->columns[j])
                         ? list->columns[i++]
                         : list->columns[j++];
  int32_t *merged = list->other;
  list->other = list->columns;
  list->columns = merged;
}

static celspan_status add_formula(const ramp *r, cs_item item, int32_t x0, int32_t x1, ends *list) {
  cs_painter *painter = r->painter;
  size_t limit = formula_break_limit(painter, r->program->procedure_spans, item), count;
  double *breaks = cs_arena_take(painter->context, &r->row->colours, limit * sizeof *breaks);
  int32_t *columns = list->columns + list->count;
  if (!breaks)
    return CELSPAN_NO_MEMORY;
  CS_TRY(formula_breaks(painter, r->program->procedure_spans, item, r->y, x0, x1, breaks, &count));
  for (size_t i = 0; i < count; i++)
    columns[i] = cs_number_first_centre(breaks[i]);
  qsort(columns, count, sizeof *columns, compare_columns);
  merge(list, count);
  return CELSPAN_OK;
}

static celspan_status add_item(const ramp *r, cs_item item, int32_t x0, int32_t x1, ends *list) {
  const cs_layer *layer = &r->painter->stack->layers[item.layer];
  if (layer->kind == CS_LAYER_FLAT)
    return CELSPAN_OK;
  if (layer->kind != CS_LAYER_PICTURE)
    return add_formula(r, item, x0, x1, list);
  merge(list, cs_sampler_steps(&r->painter->images[layer->detail].sampler, x0, x1, r->y,
                               list->columns + list->count));
  return CELSPAN_OK;
}

/* The ends of all pieces of [x0, x1), each once. */
static celspan_status find_ends(const ramp *r, int32_t x0, int32_t x1, ends *out) {
  CS_TRY(make_room(r, x0, x1, out));
  for (uint32_t i = 0; i < r->program->length; i++)
    CS_TRY(add_item(r, r->program->items[i], x0, x1, out));
  size_t kept = 1;
  out->other[0] = x0;
  for (size_t i = 0; i < out->count; i++)
    if (out->columns[i] > out->other[kept - 1] && out->columns[i] < x1)
      out->other[kept++] = out->columns[i];
  out->other[kept++] = x1;
  out->columns = out->other;
  out->count = kept;
  return CELSPAN_OK;
}

celspan_status cs_lines_run(cs_painter *painter, const cs_program *program, cs_run run,
                            cs_row *row) {
  ramp r = {painter, program, NULL, run.y, row};
  ends list;
  CS_TRY(cs_gradient_table_find(painter->gradients, program, &r.table));
  if (cs_gradient_run_fits(r.table))
    return cs_gradient_run(painter, r.table, run, row);
  CS_TRY(find_ends(&r, run.x0, run.x1, &list));
  return r.table ? put_table_pieces(&r, list.columns, list.count)
                 : put_pieces(&r, list.columns, list.count);
}
