#include "busy/busy.h"

#include "paint/run.h"

void cs_busy_init(cs_busy *busy, const cs_row_tools *tools, const cs_boundary_set *set) {
  *busy = (cs_busy){.tools = *tools};
  cs_descent_init(&busy->descent, set);
  cs_mixer_init(&busy->mixer, tools, &busy->descent.units, &busy->columns);
}

void cs_busy_finish(cs_busy *busy, cs_memory *memory) {
  cs_descent_finish(&busy->descent, memory);
  if (busy->columns.width > 0)
    cs_columns_finish(&busy->columns, memory);
  cs_mixer_finish(&busy->mixer, memory);
  *busy = (cs_busy){0};
}

/* The walk along a row. */
typedef struct row_walk {
  cs_busy *busy;
  cs_composer *composer;
  cs_row *out;
  double centre;
  cs_row_writer writer; /* everything left of writer.from is written */
  cs_cell cell;         /* at the state of the composer; while it is known */
  bool is_known;
  uint32_t ahead; /* the unit of which `right` is known; NONE */
  cs_cell right;  /* right of that unit */
} row_walk;

#define NO_UNIT UINT32_MAX

static inline void find_cell(row_walk *w) {
  if (!w->is_known)
    cs_composer_cell(w->composer, &w->cell);
  w->is_known = true;
}

/* The walk is right of a unit now. */
static inline celspan_status pass(row_walk *w, const cs_unit *unit) {
  if (unit->y0 == 0)
    cs_composer_cross(w->composer, unit->layer, unit->direction);
  return unit->y0 > 0 || unit->y1 < 1 ? cs_mixer_pass(&w->busy->mixer, unit) : CELSPAN_OK;
}

/* ---------------------------------------------------------------- gaps */

/* Others may append to the row while the writer rests. */
static void rest_writer(row_walk *w) { cs_row_writer_end(&w->writer); }

/* more: spans that the writer may write. */
static celspan_status resume_writer(row_walk *w, int32_t from, size_t more) {
  CS_TRY(cs_row_reserve(w->composer->context, w->out, more));
  w->writer = cs_row_writer_begin(w->out, from);
  return CELSPAN_OK;
}

/* So many spans may follow: two at each touched column. */
static size_t spans_left(const row_walk *w) { return 2 * w->busy->columns.node_count + 2; }

static celspan_status draw_program(row_walk *w, int32_t to) {
  const cs_run run = {w->writer.from, to, w->centre};
  rest_writer(w);
  CS_TRY(cs_painter_run(w->busy->tools.painter, &w->cell, run, w->out));
  return resume_writer(w, to, spans_left(w));
}

/* Columns in which the row changes at some height, alike in all of them. */
static celspan_status draw_mixed(row_walk *w, int32_t to) {
  cs_mixer *mixer = &w->busy->mixer;
  while (w->writer.from < to) {
    cs_v4 colour;
    CS_TRY(cs_mixer_colour(mixer, w->writer.from, &w->cell, 0, &colour));
    if (mixer->varies) { /* it is another colour in each column */
      rest_writer(w);
      int32_t column = w->writer.from;
      CS_TRY(resume_writer(w, column, (size_t)(to - column) + spans_left(w)));
    }
    cs_row_writer_to(&w->writer, mixer->varies ? w->writer.from + 1 : to, colour);
  }
  return CELSPAN_OK;
}

/* What lies between the last touched column and column `to`. */
static celspan_status draw_gap(row_walk *w, int32_t to) {
  if (to <= w->writer.from)
    return CELSPAN_OK;
  find_cell(w);
  if (cs_mixer_has_events(&w->busy->mixer, &w->cell))
    return draw_mixed(w, to);
  if (w->cell.length > 0)
    return draw_program(w, to);
  cs_row_writer_to(&w->writer, to, w->cell.colour);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- columns */

/* The cell right of a unit that goes through the whole row. */
static const cs_cell *find_right(row_walk *w, uint32_t index, const cs_unit *unit) {
  if (w->ahead != index) {
    cs_composer_cross(w->composer, unit->layer, unit->direction);
    cs_composer_cell(w->composer, &w->right);
    cs_composer_cross(w->composer, unit->layer, -unit->direction);
    w->ahead = index;
  }
  return &w->right;
}

/* A column of which a list has the units. */
static celspan_status draw_shared(row_walk *w, uint32_t head, int32_t column) {
  cs_v4 colour;
  CS_TRY(cs_mixer_colour(&w->busy->mixer, column, &w->cell, head, &colour));
  cs_row_writer_to(&w->writer, column + 1, colour);
  return CELSPAN_OK;
}

/* A unit alone. */
static celspan_status draw_alone(row_walk *w, uint32_t head, const cs_unit *unit, int32_t column) {
  const cs_node *node = &w->busy->columns.nodes[head];
  const cs_cell *right = find_right(w, node->unit, unit);
  if (w->cell.length > 0 || right->length > 0)
    return draw_shared(w, head, column);
  cs_v4d step = cs_v4d_step(w->cell.colour, right->colour);
  cs_v4d all = cs_v4d_add(cs_v4_wide(w->cell.colour), cs_v4d_scale(node->area, step));
  cs_row_writer_to(&w->writer, column + 1, cs_v4_bounded(cs_v4_narrow(all)));
  return CELSPAN_OK;
}

static inline bool is_hidden(const row_walk *w, const cs_unit *unit) {
  return w->cell.cover != CS_STACK_NONE && unit->layer < w->cell.cover;
}

/* Passes a unit after its last column. */
static inline celspan_status leave(row_walk *w, uint32_t index, const cs_unit *unit,
                                   int32_t column) {
  if (unit->last != column)
    return CELSPAN_OK;
  CS_TRY(pass(w, unit));
  if (w->ahead == index) { /* its right side is here */
    w->cell = w->right;
    w->ahead = NO_UNIT;
  } else {
    w->is_known = is_hidden(w, unit);
    w->ahead = NO_UNIT;
  }
  return CELSPAN_OK;
}

/* A column with one unit, which goes through the whole row. */
static celspan_status draw_one(row_walk *w, uint32_t head, const cs_unit *unit, int32_t column) {
  if (!is_hidden(w, unit))
    CS_TRY(draw_alone(w, head, unit, column));
  return leave(w, w->busy->columns.nodes[head].unit, unit, column);
}

/* Passes the units of a list of which this is the last column. */
static celspan_status leave_all(row_walk *w, uint32_t head, int32_t column) {
  const cs_columns *columns = &w->busy->columns;
  w->ahead = NO_UNIT;
  for (uint32_t k = head; k != 0; k = columns->nodes[k].next) {
    const cs_unit *unit = &w->busy->descent.units.units[columns->nodes[k].unit];
    if (unit->last != column)
      continue;
    CS_TRY(pass(w, unit));
    w->is_known = w->is_known && (unit->y0 > 0 || is_hidden(w, unit));
  }
  return CELSPAN_OK;
}

/* Whether all units of a list lie on the left side of the column, which then is part of the gap on
 * their right. */
static bool are_beside(const row_walk *w, uint32_t head, int32_t column) {
  const cs_columns *columns = &w->busy->columns;
  for (uint32_t k = head; k != 0; k = columns->nodes[k].next) {
    const cs_unit *unit = &w->busy->descent.units.units[columns->nodes[k].unit];
    if (columns->nodes[k].area != unit->y1 - unit->y0 || unit->last != column)
      return false;
  }
  return true;
}

static celspan_status draw_column(row_walk *w, int32_t column) {
  const cs_columns *columns = &w->busy->columns;
  uint32_t head = columns->heads[column];
  const cs_unit *unit = &w->busy->descent.units.units[columns->nodes[head].unit];
  CS_TRY(draw_gap(w, column));
  if (are_beside(w, head, column))
    return leave_all(w, head, column);
  find_cell(w);
  if (columns->nodes[head].next == 0 && w->busy->mixer.event_count == 0 && unit->y0 == 0 &&
      unit->y1 == 1)
    return draw_one(w, head, unit, column);
  CS_TRY(draw_shared(w, head, column));
  return leave_all(w, head, column);
}

/* ---------------------------------------------------------------- rows */

/* Passes the units left of the frame, or those right of it. */
static celspan_status pass_beside(row_walk *w, bool is_left) {
  const cs_units *units = &w->busy->descent.units;
  for (size_t i = 0; i < units->count; i++) {
    const cs_unit *unit = &units->units[i];
    if (unit->last < unit->first && (unit->last < 0) == is_left)
      CS_TRY(pass(w, unit));
  }
  return CELSPAN_OK;
}

static celspan_status walk_row(row_walk *w) {
  const cs_columns *columns = &w->busy->columns;
  CS_TRY(resume_writer(w, 0, spans_left(w)));
  CS_TRY(pass_beside(w, true));
  for (int32_t column = 0; (column = cs_columns_next(columns, column)) < columns->width; column++)
    CS_TRY(draw_column(w, column));
  CS_TRY(draw_gap(w, columns->width));
  rest_writer(w);
  return pass_beside(w, false);
}

celspan_status cs_busy_row(cs_busy *busy, int32_t y, cs_row *out) {
  celspan_context *context = busy->tools.composer->context;
  if (busy->columns.width == 0)
    CS_TRY(cs_columns_init(context, &busy->columns, busy->tools.width));
  CS_TRY(cs_descent_row(context, &busy->descent, y));
  CS_TRY(cs_columns_list(context, &busy->columns, &busy->descent.units));
  busy->mixer.event_count = 0;
  busy->mixer.centre = y + 0.5;
  row_walk walk = {.busy = busy,
                   .composer = busy->tools.composer,
                   .out = out,
                   .centre = y + 0.5,
                   .ahead = NO_UNIT};
  celspan_status status = walk_row(&walk);
  cs_columns_clear(&busy->columns);
  return status;
}
