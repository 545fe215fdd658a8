#include "paint/lines.h"

#include "paint/colours.h"
#include "paint/ends.h"
#include "paint/gradient_run.h"
#include "paint/halving.h"
#include "paint/over_row.h"

/* A curve of colour along a run of a program. */
typedef struct colour_curve {
  cs_curve curve;
  cs_painter *painter;
  const cs_program *program;
  const cs_gradient_table *table; /* of the program, or NULL */
  double y;
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

/* inner: the colours at the quarters. */
static bool is_straight(const cs_curve *curve, const cs_halving_point *first,
                        const cs_halving_point *last, const float (*inner)[4]) {
  cs_run run = cs_halving_run(first, last);
  for (int quarter = 1; quarter <= 3 && run.x1 - run.x0 > 2; quarter++)
    if (!cs_halving_is_near(curve, first, last, cs_halving_quarter(run, quarter),
                            cs_v4_load(inner[quarter - 1])))
      return false;
  return true;
}

static celspan_status test_program(cs_curve *curve, const cs_halving_point *first,
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

static celspan_status split_program(cs_curve *curve, int32_t column, cs_halving_point points[2]) {
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
  CURVED = 5    /* its ends and the quarters; more if they are not on a line */
} line_shape;

static int bend_of(const cs_painter *painter, const cs_layer *layer) {
  if (layer->kind == CS_LAYER_FLAT)
    return 0;
  if (layer->kind != CS_LAYER_PICTURE ||
      painter->stack->images[layer->index].texture->variation->use == CELSPAN_PICTURE_GEL)
    return 2;
  return painter->images[layer->index].sampler.kernel == CS_SAMPLER_NEAREST ? 0 : 1;
}

/* One layer that is linear between two cuts gives a line, since light, fades and flat layers act
 * linearly; the product of two such layers gives a curve. */
static line_shape shape_of(const cs_painter *painter, const cs_program *program) {
  int bends = 0;
  for (uint32_t i = 0; i < program->length; i++)
    bends += bend_of(painter, &painter->stack->layers[program->items[i].layer]);
  return bends == 0 ? STEPPED : bends == 1 ? STRAIGHT : CURVED;
}

static void pick_columns(line_shape shape, cs_run run, int32_t *columns) {
  if (shape == STEPPED)
    columns[0] = run.x0 + (run.x1 - run.x0) / 2;
  for (int k = 0; k < (int)shape && shape != STEPPED; k++)
    columns[k] = cs_halving_quarter(run, shape == STRAIGHT ? 4 * k : k);
}

static celspan_status put_line(colour_curve *c, line_shape shape, cs_run run,
                               const float (*rgba)[4]) {
  cs_halving_point first = {run.x0, 0, cs_v4_load(rgba[0])};
  cs_halving_point last = {run.x1 - 1, 0, cs_v4_load(rgba[shape - 1])};
  if (shape == STEPPED)
    return cs_row_single(c->curve.context, c->curve.row, run.x0, run.x1, first.colour);
  if (shape == CURVED && !is_straight(&c->curve, &first, &last, rgba + 1))
    return cs_halving_split(&c->curve, &first, &last);
  return cs_halving_put(&c->curve, &first, &last);
}

static celspan_status put_lines(colour_curve *c, const cs_ends *ends) {
  line_shape shape = shape_of(c->painter, c->program);
  int32_t columns[CS_OVER_ROW_BATCH];
  float rgba[CS_OVER_ROW_BATCH][4];
  const size_t each = (size_t)shape, most = CS_OVER_ROW_BATCH / each;
  c->curve.test = test_program;
  c->curve.split = split_program;
  for (size_t i = 0; i + 1 < ends->count; i += most) {
    const int32_t *end = ends->columns + i;
    size_t lines = ends->count - 1 - i < most ? ends->count - 1 - i : most;
    for (size_t k = 0; k < lines; k++)
      pick_columns(shape, (cs_run){end[k], end[k + 1], c->y}, columns + k * each);
    CS_TRY(find_colours(c, columns, (int32_t)(lines * each), rgba));
    for (size_t k = 0; k < lines; k++)
      CS_TRY(put_line(c, shape, (cs_run){end[k], end[k + 1], c->y},
                      (const float(*)[4])rgba + k * each));
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- runs */

celspan_status cs_lines_run(cs_painter *painter, const cs_program *program, cs_run run,
                            cs_row *row) {
  colour_curve c = {.curve = {.context = painter->context,
                              .tolerance = cs_halving_tolerance(painter->stack->span_error),
                              .row = row},
                    .painter = painter,
                    .program = program,
                    .y = run.y};
  cs_ends ends;
  CS_TRY(cs_gradient_table_find(painter->gradients, program, &c.table));
  if (cs_gradient_run_fits(c.table))
    return cs_gradient_run(painter, c.table, run, row);
  CS_TRY(cs_ends_find(painter, program, run, row, &ends));
  return put_lines(&c, &ends);
}
