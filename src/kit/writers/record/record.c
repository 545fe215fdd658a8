#include "writers/record/record.h"

#include <math.h>

#include "inside/frames.h"
#include "inside/hash.h"
#include "inside/number.h"
#include "writers/record/pictures.h"
#include "writers/record/programs.h"

#define COUNT_MOST (UINT32_MAX / 4) /* more of anything is refused */
#define WINDINGS_MOST ((size_t)1 << 24)

typedef struct recorder {
  celspan_context *context;
  const cs_plan *plan;
  cs_recording *out;
  cs_events events;
  uint32_t *chain_of;  /* by chain of the plan: the chain of the record plus 1; 0: none yet */
  cs_hash_table cells; /* found by their colours, their layers or what these show */
  cs_hash_table axes;
  cs_record_source source;
  const planefile_rounding *rounding; /* NULL: colours are not rounded */
} recorder;

void cs_record_finish(cs_recording *record, cs_memory *memory) {
  cs_record_pictures_finish(record);
  CS_ARRAYS_FREE(memory, record, points, sources);
  *record = (cs_recording){0};
}

planefile_band cs_record_plane(cs_recording *record) {
  cs_record_pictures_join(record);
  return (planefile_band){.foot = PLANEFILE_SIDE,
                          .points = record->points,
                          .pieces = record->pieces,
                          .chains = record->chains,
                          .borders = record->borders,
                          .cells = record->cells,
                          .programs = record->programs,
                          .steps = record->steps,
                          .axes = record->axes,
                          .stops = record->stops,
                          .pictures = record->pictures,
                          .point_count = (uint32_t)record->point_count,
                          .piece_count = (uint32_t)record->piece_count,
                          .chain_count = (uint32_t)record->chain_count,
                          .border_count = (uint32_t)record->border_count,
                          .cell_count = (uint32_t)record->cell_count,
                          .step_count = (uint32_t)record->step_count,
                          .axis_count = (uint32_t)record->axis_count,
                          .stop_count = (uint32_t)record->stop_count,
                          .picture_count = (uint32_t)record->picture_count};
}

/* ---------------------------------------------------------------- cells */

static planefile_cell cell_of(const recorder *r, cs_v4 colour) {
  planefile_cell out;
  for (int c = 0; c < 4; c++) {
    double channel = floor((double)colour[c] * PLANEFILE_WHITE + 0.5);
    out.colour[c] = (int32_t)cs_number_clamp(channel, -PLANEFILE_BRIGHT, PLANEFILE_BRIGHT);
  }
  return r->rounding ? planefile_round(r->rounding, out) : out;
}

/* Adds a cell under a key. */
static celspan_status add_cell(recorder *r, cs_hash key, planefile_cell cell,
                               planefile_program program, uint32_t *out) {
  cs_recording *record = r->out;
  *out = (uint32_t)record->cell_count;
  CS_TRY(CS_ARRAY_APPEND(r->context, record->programs, record->program_count, program));
  CS_TRY(CS_ARRAY_APPEND(r->context, record->cells, record->cell_count, cell));
  return cs_hash_table_add(&r->cells, r->context, key, *out);
}

/* Whether the cell of a key is known; *out: its number. */
static bool is_known(const recorder *r, cs_hash key, uint32_t *out) {
  size_t number = 0;
  bool found = cs_hash_table_find(&r->cells, key, &number);
  *out = (uint32_t)number;
  return found;
}

/* The number of the cell of a colour. */
static celspan_status find_cell(recorder *r, cs_v4 colour, uint32_t *out) {
  const planefile_cell cell = cell_of(r, colour * cs_v4_all(r->source.weight));
  cs_hash key = cs_hash_begin(0x63656c6cu);
  for (int c = 0; c < 4; c++)
    cs_hash_word(&key, (uint64_t)cell.colour[c]);
  key = cs_hash_end(key);
  if (is_known(r, key, out))
    return CELSPAN_OK;
  return add_cell(r, key, cell, (planefile_program){0, 0}, out);
}

/* Adds a cell with the latest program of the record under a key, or finds one that shows the same,
 * and forgets the program. */
static celspan_status add_varied(recorder *r, cs_hash key, const planefile_program *made,
                                 uint32_t *out) {
  cs_recording *record = r->out;
  cs_hash content = cs_record_program_hash(record, made);
  if (!is_known(r, content, out)) {
    CS_TRY(add_cell(r, content, (planefile_cell){{0}}, *made, out));
    return cs_hash_table_add(&r->cells, r->context, key, *out);
  }
  record->step_count = made->step;
  for (uint32_t i = made->step; i < made->step + made->step_count; i++)
    if (record->steps[i].kind == PLANEFILE_RAMP && record->steps[i].stop < record->stop_count)
      record->stop_count = record->steps[i].stop;
  return cs_hash_table_add(&r->cells, r->context, key, *out);
}

/* The number of the cell of a program. */
static celspan_status find_varied(recorder *r, const cs_program *program, uint32_t *out) {
  planefile_program made;
  cs_hash key = cs_hash_begin(0x76617279u);
  for (uint32_t i = 0; i < program->length; i++)
    cs_hash_word(&key, program->items[i].layer);
  key = cs_hash_end(key);
  if (is_known(r, key, out))
    return CELSPAN_OK;
  CS_TRY(cs_record_program(&r->source, program, r->out, &made));
  return add_varied(r, key, &made, out);
}

/* The number of a cell; a cs_events_visitor. */
static celspan_status find_shown(void *user, cs_composer *composer, const cs_cell *cell,
                                 uint32_t *out) {
  recorder *r = user;
  if (cell->length == 0)
    return find_cell(r, cell->colour, out);
  const cs_program program = cs_composer_program(composer, cell);
  return find_varied(r, &program, out);
}

/* ---------------------------------------------------------------- curves */

/* A point in the middle between two places of the grid, as points often are, goes to the greater
 * one, wherever it has been moved to, though its coordinate is then a little less or more. */
#define MIDDLE (0.5 + 1.0 / 1024)

/* The nearest place on the grid. */
static int32_t to_units(double pixels, uint16_t count) {
  const double steps = (double)planefile_steps(count), far = 4 * steps;
  double step = floor(pixels / CS_RECORD_SIDE * steps + (count > 0 ? MIDDLE : 0.5));
  return (int32_t)planefile_place_of((int64_t)cs_number_clamp(step, -far, far), count);
}

/* Heights are rounded to those of the sweep first, because borders end where chains do. */
static planefile_point point_at(const recorder *r, double x, double y) {
  planefile_grid grid = r->out->grid;
  double height = floor(y * CS_COURSE_UNIT + 0.5) / CS_COURSE_UNIT;
  return (planefile_point){to_units(x, grid.columns), to_units(height, grid.rows),
                           PLANEFILE_WEIGHT};
}

/* The control points of a piece, from its coefficients in powers; its end points are known. */
static void from_powers(const recorder *r, const cs_hpoint *c, int degree, planefile_point *out) {
  for (int i = 1; i < degree; i++) {
    double second = degree == 3 && i == 2 ? 1.0 / 3 : 0, first = (double)i / degree;
    out[i] = point_at(r, c[0].x + first * c[1].x + second * c[2].x,
                      c[0].y + first * c[1].y + second * c[2].y);
  }
}

static void from_rational(const recorder *r, const cs_hpoint *p, int degree, planefile_point *out) {
  for (int i = 0; i <= degree; i++) {
    if (i > 0 && i < degree)
      out[i] = point_at(r, p[i].x / p[i].w, p[i].y / p[i].w);
    out[i].w = (uint32_t)floor(p[i].w / p[0].w * PLANEFILE_WEIGHT + 0.5);
  }
}

/* Adds a piece of a chain, for which there is room. */
static void add_piece(recorder *r, const cs_boundary_piece *piece) {
  cs_recording *out = r->out;
  bool is_line = piece->degree < 2; /* lines have no points in the list, which may be empty */
  const cs_hpoint *points = is_line ? NULL : r->plan->boundaries.points + piece->point;
  planefile_point *to = &out->points[out->point_count];
  out->pieces[out->piece_count++] =
      (planefile_piece){(uint32_t)out->point_count, piece->degree, !is_line && !piece->is_power};
  to[0] = point_at(r, piece->x0, piece->y0);
  to[piece->degree] = point_at(r, piece->x1, piece->y1);
  if (!is_line && piece->is_power)
    from_powers(r, points, piece->degree, to);
  else if (!is_line)
    from_rational(r, points, piece->degree, to);
  out->point_count += piece->degree + (size_t)1;
}

/* Whether all pieces of a chain can be in a plane. */
static bool has_curves(const recorder *r, const cs_boundary_chain *chain) {
  const cs_boundary_piece *pieces = &r->plan->boundaries.pieces[chain->piece];
  for (uint32_t i = 0; i < chain->piece_count; i++)
    if (pieces[i].degree > 3)
      return false;
  return true;
}

static celspan_status reserve(recorder *r, size_t pieces) {
  cs_recording *out = r->out;
  if (out->point_count > COUNT_MOST || out->border_count > COUNT_MOST ||
      out->cell_count > COUNT_MOST || out->step_count > COUNT_MOST || out->stop_count > COUNT_MOST)
    return cs_fail(r->context, CELSPAN_LIMIT, "plane: there is too much in it");
  CS_TRY(CS_ARRAY_RESERVE(r->context, out->points, out->point_count + 4 * pieces));
  CS_TRY(CS_ARRAY_RESERVE(r->context, out->pieces, out->piece_count + pieces));
  return CS_ARRAY_RESERVE(r->context, out->chains, out->chain_count + 1);
}

static celspan_status add_chain(recorder *r, const cs_boundary_chain *chain, uint32_t *out) {
  cs_recording *record = r->out;
  CS_TRY(reserve(r, chain->piece_count));
  *out = (uint32_t)record->chain_count;
  record->chains[record->chain_count++] =
      (planefile_chain){(uint32_t)record->piece_count, chain->piece_count};
  for (uint32_t i = 0; i < chain->piece_count; i++)
    add_piece(r, &r->plan->boundaries.pieces[chain->piece + i]);
  return CELSPAN_OK;
}

static planefile_point course_point(const recorder *r, const cs_course_point *at) {
  const double unit = 1.0 / CS_COURSE_UNIT;
  return point_at(r, at->x * unit, at->y * unit);
}

/* Adds a chain of lines that follows a course. */
static celspan_status add_lines(recorder *r, uint32_t course, uint32_t *out) {
  cs_recording *record = r->out;
  const cs_course *of = &r->events.courses.courses[course];
  const cs_course_point *points = r->events.courses.points + of->first;
  CS_TRY(reserve(r, of->count));
  *out = (uint32_t)record->chain_count;
  record->chains[record->chain_count++] =
      (planefile_chain){(uint32_t)record->piece_count, of->count - 1};
  for (uint32_t k = 0; k + 1 < of->count; k++) {
    record->pieces[record->piece_count++] =
        (planefile_piece){(uint32_t)record->point_count, 1, false};
    record->points[record->point_count++] = course_point(r, &points[k]);
    record->points[record->point_count++] = course_point(r, &points[k + 1]);
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- borders */

/* The heights between which borders of a chain of the record may lie. */
static void find_limits(const cs_recording *record, uint32_t number, int32_t *least,
                        int32_t *most) {
  const planefile_chain *chain = &record->chains[number];
  const planefile_piece *first = &record->pieces[chain->piece];
  const planefile_piece *last = first + chain->piece_count - 1;
  int32_t top = record->points[first->point].y, foot = record->points[last->point + last->degree].y;
  *least = top > 0 ? top : 0;
  *most = foot < PLANEFILE_SIDE ? foot : PLANEFILE_SIDE;
}

/* A height of the sweep, converted to units of a plane. */
static int32_t height_of(const recorder *r, int32_t y) {
  return to_units(y * (1.0 / CS_COURSE_UNIT), r->out->grid.rows);
}

static celspan_status find_chain(recorder *r, uint32_t course, uint32_t *out) {
  const cs_boundary_chain *chain = &r->plan->boundaries.chains[course];
  uint32_t *known = &r->chain_of[course];
  if (*known == 0) {
    CS_TRY(has_curves(r, chain) ? add_chain(r, chain, known) : add_lines(r, course, known));
    ++*known;
  }
  *out = *known - 1;
  return CELSPAN_OK;
}

/* Adds a part of a chain as a border, unless it is lower than a unit. */
static celspan_status add_border(recorder *r, const cs_events_part *part) {
  cs_recording *record = r->out;
  planefile_border border = {.left = part->left, .right = part->right};
  int32_t least, most;
  CS_TRY(find_chain(r, part->course, &border.chain));
  find_limits(record, border.chain, &least, &most);
  border.top = (int32_t)cs_number_clamp(height_of(r, part->top), least, most);
  border.foot = (int32_t)cs_number_clamp(height_of(r, part->foot), least, most);
  return border.top >= border.foot
             ? CELSPAN_OK
             : CS_ARRAY_APPEND(r->context, record->borders, record->border_count, border);
}

/* Adds the visible borders; the two sides of a bundle are always the same cell. */
static celspan_status add_borders(recorder *r) {
  const cs_events *events = &r->events;
  for (size_t i = 0; i < events->part_count; i++)
    if (events->parts[i].course < r->plan->boundaries.chain_count)
      CS_TRY(add_border(r, &events->parts[i]));
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- the record */

/* The cell around each plan is added to cell 0, the cell around the sum of all plans. */
static void add_to_sum(const recorder *r, uint32_t cell) {
  planefile_cell *cells = r->out->cells;
  for (int c = 0; c < 4 && cell > 0; c++) {
    double sum = (double)cells[0].colour[c] + cells[cell].colour[c];
    cells[0].colour[c] = (int32_t)cs_number_clamp(sum, -PLANEFILE_BRIGHT, PLANEFILE_BRIGHT);
  }
}

celspan_status cs_record_begin_sum(celspan_context *context, cs_recording *out) {
  const planefile_program none = {0, 0};
  const planefile_cell clear = {{0}};
  CS_TRY(CS_ARRAY_APPEND(context, out->programs, out->program_count, none));
  return CS_ARRAY_APPEND(context, out->cells, out->cell_count, clear);
}

/* The number of all layers that may have an axis. */
static size_t axis_count(const cs_plan *plan) {
  return plan->stack.shade_count + plan->stack.image_count + plan->stack.defocused_count + 1;
}

static celspan_status record(recorder *r) {
  const cs_plan *plan = r->plan;
  size_t chains = plan->boundaries.chain_count + 1, axes = axis_count(plan);
  uint32_t first = (uint32_t)r->out->cell_count; /* its cell 0 */
  const cs_events_rows rows = {0, plan->height, plan->height, plan->height};
  const cs_events_limits limits = {WINDINGS_MOST, WINDINGS_MOST, 0};
  CS_TRY(cs_events_find(r->context, &plan->boundaries, &plan->cull, rows, limits, &r->events));
  if (r->events.missing)
    return cs_fail(r->context, CELSPAN_LIMIT, "plane: there is too much in it");
  CS_TRY(CS_MAKE(r->context, r->source.axes, axes));
  CS_TRY(CS_MAKE(r->context, r->chain_of, chains));
  CS_TRY(cs_events_show(r->context, plan, &r->events, find_shown, r));
  add_to_sum(r, first);
  return add_borders(r);
}

celspan_status cs_record_put_plan(celspan_context *context, const cs_plan *plan, float weight,
                                  const planefile_rounding *rounding, cs_recording *out) {
  recorder r = {.context = context, .plan = plan, .out = out, .rounding = rounding};
  cs_memory *memory = context->memory;
  size_t chains = plan->boundaries.chain_count + 1, axes = axis_count(plan);
  r.source.context = context;
  r.source.weight = weight;
  r.source.is_coded = rounding;
  r.source.known = &r.axes;
  r.source.stack = &plan->stack;
  r.source.defocus = plan->defocus;
  celspan_status status = record(&r);
  if (r.source.axes)
    cs_mem_free(memory, r.source.axes, axes * sizeof *r.source.axes);
  if (r.chain_of)
    cs_mem_free(memory, r.chain_of, chains * sizeof *r.chain_of);
  cs_events_finish(&r.events, memory);
  cs_hash_table_finish(&r.axes, context);
  cs_hash_table_finish(&r.cells, context);
  return status;
}
