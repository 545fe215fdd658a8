/* Programs that vary as formulas, cut into lines: gradients, procedures, defocused cels,
 * and pictures enlarged so far that a texel is some pixels wide.
 *
 *     colour
 *       |             ___________
 *       |           /:           :`-._          a run is cut where a formula bends or a texel
 *       |         /  :           :    `-._      begins (ends.h); between two cuts it becomes one
 *       |  _____/    :           :        |     span if it is straight enough, else it is halved
 *       |  |    :    :           :        |     (halving.h); if halving would give short pieces,
 *       +--+----+----+-----------+--------+---> it is painted pixel by pixel, together with
 *          x0  cut  cut         cut       x1    neighbours of which this is true
 *                                         column
 */
#include "engine/paint/run.h"

#include "base/number.h"
#include "base/sort.h"
#include "engine/paint/colours.h"
#include "engine/paint/gradient_table.h"
#include "engine/paint/halving.h"
#include "engine/paint/over_row.h"
#include "engine/paint/painter.h"
#include "engine/span/row.h"
#include "engine/span/run.h"

/* ---------------------------------------------------------------- where a run is cut */

/* Where a run is cut into lines: at the columns in which a formula of its program bends, or a texel
 * begins. Both ends of the run are among them.
 *
 *     columns                x0                          x1
 *                            |                           |
 *     layer with stops       |      '        '           |
 *     texels of a picture    |  '        '       '       |       the columns of each layer ascend,
 *                            |                           |       and are merged:
 *     ends                   '  '   '    '   '   '       '
 */

/* Columns, ascending, in room of the row's own arena: the scratch arena is used again for every
 * colour. */
typedef struct cut_list {
  int32_t *columns, *other; /* other: room to merge into */
  double *breaks;           /* the breaks of one layer */
  size_t count;
} cut_list;

typedef struct finder {
  cs_painter *painter;
  const cs_program *program;
  cs_run run;
} finder;

/* ---------------------------------------------------------------- breaks of one layer */

static size_t procedure_breaks(const cs_procedure_span *span, cs_run run, double *out) {
  size_t count = 0;
  for (size_t i = 1; i + 1 < span->paint_count; i++) {
    double u = (double)i / (double)(span->paint_count - 1);
    double x = span->x0 + u * (span->x1 - span->x0);
    if (x > run.x0 && x < run.x1)
      out[count++] = x;
  }
  return count;
}

static size_t break_limit(const finder *f, cs_item item) {
  const cs_stack *stack = f->painter->stack;
  const cs_layer *layer = &stack->layers[item.layer];
  switch ((cs_layer_kind)layer->kind) {
  case CS_LAYER_SHADED:
    return cs_shade_break_limit(&stack->shades[layer->index]);
  case CS_LAYER_SCANLINE:
    return f->program->procedure_spans[item.procedure_span].paint_count;
  case CS_LAYER_DEFOCUSED:
    return cs_defocused_break_limit(stack->defocused[layer->index]);
  case CS_LAYER_PICTURE:
    return cs_sampler_texel_edge_limit(&f->painter->images[layer->index].sampler, f->run);
  case CS_LAYER_FLAT:
    break;
  }
  return 0;
}

/* Where a formula bends inside the run, in any order. */
static celspan_status find_breaks(const finder *f, cs_item item, double *out, size_t *count) {
  const cs_stack *stack = f->painter->stack;
  const cs_layer *layer = &stack->layers[item.layer];
  *count = 0;
  if (layer->kind == CS_LAYER_SHADED) {
    *count = cs_shade_breaks(&stack->shades[layer->index], f->run, out);
  } else if (layer->kind == CS_LAYER_SCANLINE) {
    *count = procedure_breaks(&f->program->procedure_spans[item.procedure_span], f->run, out);
  } else if (layer->kind == CS_LAYER_DEFOCUSED) {
    const cs_defocused *defocused = stack->defocused[layer->index];
    cs_defocused_view *view = &f->painter->defocused[layer->index];
    CS_TRY(cs_defocused_move(defocused, f->painter->context, view, f->run.y));
    *count = cs_defocused_breaks(defocused, view, f->run, out);
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- the columns of all */

/* Merges the last `count` columns, which ascend, with those before. */
static void merge(cut_list *list, size_t count) {
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

static inline bool is_before(const int32_t *a, const int32_t *b) { return *a < *b; }

CS_SORT_DEFINE(sort_columns, int32_t, is_before)

static celspan_status add_formula(const finder *f, cs_item item, cut_list *list) {
  size_t count;
  int32_t *columns = list->columns + list->count;
  CS_TRY(find_breaks(f, item, list->breaks, &count));
  for (size_t i = 0; i < count; i++)
    columns[i] = cs_number_first_centre(list->breaks[i]);
  sort_columns(columns, count);
  merge(list, count);
  return CELSPAN_OK;
}

static celspan_status add_item(const finder *f, cs_item item, cut_list *list) {
  const cs_layer *layer = &f->painter->stack->layers[item.layer];
  if (layer->kind == CS_LAYER_FLAT)
    return CELSPAN_OK;
  if (layer->kind == CS_LAYER_SHADED &&
      cs_gradient_table_is_one_section(&f->painter->stack->shades[layer->index], f->run.x0 + 0.5,
                                       f->run.x1 - 0.5, f->run.y))
    return CELSPAN_OK;
  if (layer->kind != CS_LAYER_PICTURE)
    return add_formula(f, item, list);
  merge(list, cs_sampler_texel_edges(&f->painter->images[layer->index].sampler, f->run,
                                     list->columns + list->count));
  return CELSPAN_OK;
}

static celspan_status make_room(const finder *f, cs_arena *arena, cut_list *out) {
  size_t limit = 2;
  for (uint32_t i = 0; i < f->program->length; i++)
    limit += break_limit(f, f->program->items[i]);
  out->breaks =
      cs_arena_take(f->painter->context, arena, limit * (sizeof(double) + 2 * sizeof(int32_t)));
  if (!out->breaks)
    return CELSPAN_NO_MEMORY;
  out->columns = (int32_t *)(out->breaks + limit);
  out->other = out->columns + limit;
  out->count = 0;
  return CELSPAN_OK;
}

/* The columns at which a run is cut, ascending, its own two ends among them. The pictures of the
 * program are grids (cs_sampler_is_grid). Errors: NO_MEMORY, and those of making defocused cels. */
static CELSPAN_CHECKED celspan_status find_ends(cs_painter *painter, const cs_program *program,
                                                cs_run run, cs_row *row, cut_list *out) {
  finder f = {painter, program, run};
  CS_TRY(make_room(&f, &row->colours, out));
  for (uint32_t i = 0; i < program->length; i++)
    CS_TRY(add_item(&f, program->items[i], out));
  size_t kept = 1;
  out->other[0] = run.x0;
  for (size_t i = 0; i < out->count; i++)
    if (out->columns[i] > out->other[kept - 1] && out->columns[i] < run.x1)
      out->other[kept++] = out->columns[i];
  out->other[kept++] = run.x1;
  out->columns = out->other;
  out->count = kept;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- lines */

#define SHORT 32 /* columns: halving costs more than to paint the pixels of shorter pieces */

/* A curve of colour along a run of a program. */
typedef struct colour_curve {
  cs_halving_curve curve;
  cs_painter *painter;
  const cs_program *program;
  const cs_gradient_table *table; /* the table of the program, or NULL */
  double y;
  int32_t short_from, short_end; /* columns before the next line whose pieces would be short */
} colour_curve;

/* Many colours cost little more than one, since a batch is folded layer by layer. So the columns of
 * many lines are gathered before their colours are computed. */
static celspan_status find_colours(const colour_curve *c, const int32_t *columns, int32_t count,
                                   float (*rgba)[4]) {
  cs_batch batch = {columns, 0, count, c->y};
  if (!c->table)
    return cs_painter_batch_colours(c->painter, c->program, &batch, rgba);
  c->painter->evaluations += (uint64_t)count;
  cs_gradient_table_colours(c->table, &batch, rgba);
  return CELSPAN_OK;
}

/* Whether a line is near the curve. inner: the colours at the quarters. */
static bool is_straight(const cs_halving_curve *curve, const cs_halving_point *first,
                        const cs_halving_point *last, const float (*inner)[4]) {
  cs_run run = cs_halving_run(first, last);
  for (int quarter = 1; quarter <= 3 && run.x1 - run.x0 > 2; quarter++)
    if (!cs_halving_is_near(curve, first, last, cs_halving_quarter(run, quarter),
                            cs_v4_load(inner[quarter - 1])))
      return false;
  return true;
}

static celspan_status test_program(cs_halving_curve *curve, const cs_halving_point *first,
                                   const cs_halving_point *last, bool *out) {
  int32_t columns[3];
  float inner[3][4] = {{0}};
  for (int k = 0; k < 3; k++)
    columns[k] = cs_halving_quarter(cs_halving_run(first, last), k + 1);
  if (last->column - first->column > 1)
    CS_TRY(find_colours((colour_curve *)curve, columns, 3, inner));
  *out = is_straight(curve, first, last, (const float(*)[4])inner);
  return CELSPAN_OK;
}

static celspan_status split_program(cs_halving_curve *curve, int32_t column,
                                    cs_halving_point points[2]) {
  int32_t columns[2] = {column, column + 1};
  float rgba[2][4];
  CS_TRY(find_colours((colour_curve *)curve, columns, 2, rgba));
  for (int k = 0; k < 2; k++)
    points[k] = (cs_halving_point){columns[k], 0, cs_v4_load(rgba[k])};
  return CELSPAN_OK;
}

/* How many colours of the curve between two cuts are computed first. */
typedef enum line_shape {
  STEPPED = 1,  /* one colour, at any column */
  STRAIGHT = 2, /* a line, by its ends */
  CURVED = 5    /* ends and quarters; more if they are not on a line */
} line_shape;

enum { MOST_BENDS = 2 }; /* of one layer: where there are more, several layers vary: no table */

static int bend_of(const cs_painter *painter, const cs_layer *layer) {
  if (layer->kind == CS_LAYER_FLAT)
    return 0;
  if (layer->kind != CS_LAYER_PICTURE ||
      painter->stack->images[layer->index].texture->variation->use == CELSPAN_PICTURE_GEL)
    return 2;
  if (painter->images[layer->index].sampler.kernel == CS_SAMPLER_NEAREST)
    return 0;
  return painter->stack->images[layer->index].space == CELSPAN_SPACE_SRGB ? 2 : 1;
}

static int count_bends(const cs_painter *painter, const cs_program *program) {
  int bends = 0;
  for (uint32_t i = 0; i < program->length; i++)
    bends += bend_of(painter, &painter->stack->layers[program->items[i].layer]);
  return bends;
}

/* One layer that is linear between two cuts gives a line, since light, fades and flat layers act
 * linearly; the product of two such layers gives a curve, and so do modes, mattes, and pictures of
 * light where codes are mixed. */
static line_shape shape_of(const cs_painter *painter, const cs_program *program, int bends) {
  if (bends > 0 && cs_program_curves(painter->stack, program))
    return CURVED;
  return bends == 0 ? STEPPED : bends == 1 ? STRAIGHT : CURVED;
}

/* How many colours of a line are computed first: for a short line, no more than it has columns. */
static int32_t count_colours(line_shape shape, cs_run run) {
  return run.x1 - run.x0 < (int32_t)shape ? run.x1 - run.x0 : (int32_t)shape;
}

static void pick_columns(line_shape shape, cs_run run, int32_t *columns) {
  int32_t count = count_colours(shape, run);
  for (int32_t k = 0; k < count; k++)
    columns[k] = count < (int32_t)shape ? run.x0 + k
                 : shape == STEPPED     ? run.x0 + (run.x1 - run.x0) / 2
                                        : cs_halving_quarter(run, shape == STRAIGHT ? 4 * k : k);
}

/* The colours of a line at its quarters, of those at the columns of pick_columns. */
static void pick_quarters(cs_run run, const float (*rgba)[4], float (*inner)[4]) {
  for (int k = 1; k <= 3; k++)
    memcpy(inner[k - 1], rgba[run.x1 - run.x0 < CURVED ? cs_halving_quarter(run, k) - run.x0 : k],
           sizeof inner[0]);
}

/* Whether a curve would be halved into short pieces. With each halving a curve comes four times as
 * near to its line. */
static bool has_short_pieces(const cs_halving_curve *curve, const cs_halving_point *first,
                             const cs_halving_point *last, const float (*inner)[4]) {
  cs_run run = cs_halving_run(first, last);
  int32_t columns = run.x1 - run.x0;
  cs_halving_curve coarse = *curve;
  while (columns >= SHORT && !is_straight(&coarse, first, last, inner)) {
    coarse.tolerance *= 4;
    columns /= 2;
  }
  return columns < SHORT;
}

/* The pixels of the curves that wait because their pieces are short. */
static celspan_status put_short(colour_curve *c) {
  cs_run run = {c->short_from, c->short_end, c->y};
  c->short_from = c->short_end;
  return run.x1 > run.x0 ? cs_painter_pixels(c->painter, c->program, run, c->curve.row)
                         : CELSPAN_OK;
}

static celspan_status put_line(colour_curve *c, line_shape shape, cs_run run,
                               const float (*rgba)[4]) {
  cs_halving_point first = {run.x0, 0, cs_v4_load(rgba[0])};
  cs_halving_point last = {run.x1 - 1, 0, cs_v4_load(rgba[count_colours(shape, run) - 1])};
  float inner[3][4];
  if (shape == STEPPED)
    return cs_row_single(c->curve.context, c->curve.row, run.x0, run.x1, first.colour);
  if (shape == CURVED)
    pick_quarters(run, rgba, inner);
  const float(*quarters)[4] = (const float(*)[4])inner;
  bool is_curved = shape == CURVED && !is_straight(&c->curve, &first, &last, quarters);
  if (is_curved && has_short_pieces(&c->curve, &first, &last, quarters)) {
    c->short_end = run.x1;
    return CELSPAN_OK;
  }
  CS_TRY(put_short(c));
  c->short_from = c->short_end = run.x1;
  return is_curved ? cs_halving_split(&c->curve, &first, &last)
                   : cs_halving_put(&c->curve, &first, &last);
}

/* The columns of the lines from `line` on, as many lines as fit into a batch. Returns the line
 * after them. */
static size_t pick_batch(line_shape shape, const cut_list *ends, size_t line, double y,
                         int32_t *columns, int32_t *count) {
  *count = 0;
  for (; line + 1 < ends->count && *count + (int32_t)shape <= CS_OVER_ROW_BATCH; line++) {
    cs_run run = {ends->columns[line], ends->columns[line + 1], y};
    pick_columns(shape, run, columns + *count);
    *count += count_colours(shape, run);
  }
  return line;
}

static celspan_status put_lines(colour_curve *c, line_shape shape, const cut_list *ends) {
  int32_t columns[CS_OVER_ROW_BATCH], count;
  float rgba[CS_OVER_ROW_BATCH][4];
  c->curve.test = test_program;
  c->curve.split = split_program;
  for (size_t i = 0, after; i + 1 < ends->count; i = after) {
    after = pick_batch(shape, ends, i, c->y, columns, &count);
    CS_TRY(find_colours(c, columns, count, rgba));
    const float(*colours)[4] = (const float(*)[4])rgba;
    for (; i < after; i++) {
      cs_run run = {ends->columns[i], ends->columns[i + 1], c->y};
      CS_TRY(put_line(c, shape, run, colours));
      colours += count_colours(shape, run);
    }
  }
  return put_short(c);
}

/* ---------------------------------------------------------------- runs */

celspan_status cs_lines_run(cs_painter *painter, const cs_program *program, cs_run run,
                            cs_row *row) {
  const cs_gradient_table *table = NULL;
  cut_list ends;
  const int bends = count_bends(painter, program);
  if (bends > MOST_BENDS && run.x1 - run.x0 < SHORT) /* its lines would be short */
    return cs_painter_pixels(painter, program, run, row);
  if (bends <= MOST_BENDS)
    CS_TRY(cs_gradient_table_find(painter->gradients, program, &table));
  if (cs_gradient_run_fits(table))
    return cs_gradient_run(painter, table, run, row);
  CS_TRY(find_ends(painter, program, run, row, &ends));
  colour_curve c = {.curve = {.context = painter->context,
                              .tolerance = cs_halving_tolerance(painter->stack->span_error),
                              .row = row},
                    .painter = painter,
                    .program = program,
                    .table = table,
                    .y = run.y,
                    .short_from = run.x0,
                    .short_end = run.x0};
  return put_lines(&c, shape_of(painter, program, bends), &ends);
}
