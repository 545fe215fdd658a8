#include "frames/render/row_worker.h"

#include "frames/render/drawings.h"

/* ---------------------------------------------------------------- life */

static celspan_status begin_makers(cs_row_worker *worker, const cs_plan *plans) {
  for (size_t i = 0; i < worker->frame->count; i++)
    if (!cs_drawings_are_enough(&worker->frame->maps[i]))
      CS_TRY(cs_row_maker_init(&worker->makers[i], &worker->context, &plans[i]));
  return CELSPAN_OK;
}

static celspan_status begin_map_makers(cs_row_worker *worker) {
  const cs_map_frame *maps = worker->frame->maps;
  for (size_t i = 0; i < worker->frame->count; i++)
    if (cs_drawings_are_used(&maps[i]))
      CS_TRY(cs_map_maker_init(&worker->map_makers[i], &worker->context, &maps[i]));
  return CELSPAN_OK;
}

static uint64_t count_evaluations(const cs_row_worker *worker) {
  uint64_t evaluations = 0;
  for (size_t i = 0; worker->makers && i < worker->frame->count; i++)
    evaluations += worker->makers[i].composer.evaluations + worker->makers[i].painter.evaluations;
  for (size_t i = 0; worker->map_makers && i < worker->frame->count; i++)
    evaluations += cs_map_maker_evaluations(&worker->map_makers[i]);
  return evaluations;
}

static void finish_makers(cs_row_worker *worker) {
  worker->evaluations += count_evaluations(worker);
  for (size_t i = 0; worker->makers && i < worker->frame->count; i++)
    cs_row_maker_finish(&worker->makers[i]);
}

celspan_status cs_row_worker_init(cs_row_worker *worker, celspan_context *context,
                                  const cs_frame *frame) {
  *worker = (cs_row_worker){.frame = frame};
  cs_context_branch(&worker->context, context);
  cs_row_init(&worker->sum);
  cs_row_init(&worker->joined);
  CS_TRY(CS_ARRAY_MAKE(&worker->context, worker->makers, frame->count));
  CS_TRY(CS_ARRAY_MAKE(&worker->context, worker->map_makers, frame->count));
  CS_TRY(CS_ARRAY_MAKE(&worker->context, worker->rows, frame->count));
  if (frame->is_crowded)
    CS_TRY(CS_ARRAY_MAKE(&worker->context, worker->plans, frame->count));
  bool takes_codes = frame->takes_codes && frame->count == 1 && frame->weights[0] == 1;
  worker->joined.takes_codes = takes_codes;
  for (size_t i = 0; i < frame->count; i++) {
    cs_row_init(&worker->rows[i]);
    worker->rows[i].takes_codes = takes_codes;
  }
  CS_TRY(begin_map_makers(worker));
  return frame->is_crowded ? CELSPAN_OK : begin_makers(worker, frame->plans);
}

void cs_row_worker_finish(cs_row_worker *worker) {
  if (!worker->frame)
    return;
  cs_memory *memory = worker->context.memory;
  size_t count = worker->frame->count;
  finish_makers(worker);
  cs_frame_free_plans(worker->frame, worker->plans, memory);
  for (size_t i = 0; worker->map_makers && i < count; i++)
    cs_map_maker_finish(&worker->map_makers[i]);
  for (size_t i = 0; worker->rows && i < count; i++)
    cs_row_finish(&worker->rows[i], memory);
  cs_row_finish(&worker->sum, memory);
  cs_row_finish(&worker->joined, memory);
  cs_held_copy_finish(&worker->held, memory);
  CS_ARRAYS_FREE(memory, worker, makers, plans);
  *worker = (cs_row_worker){0};
}

/* ---------------------------------------------------------------- rows */

static celspan_status expose(cs_row_worker *worker, cs_row **out) {
  const cs_frame *frame = worker->frame;
  *out = &worker->sum;
  cs_row_clear(&worker->sum);
  if (frame->count == 0)
    return cs_row_single(&worker->context, &worker->sum, 0, frame->width, cs_v4_all(0));
  return cs_row_expose(&worker->context, &worker->sum, frame->view.space, worker->rows,
                       frame->weights, frame->count);
}

/* Row y of the frame, by the current makers. */
static celspan_status make_row(cs_row_worker *worker, int32_t y, cs_row **out) {
  const cs_frame *frame = worker->frame;
  for (size_t i = 0; i < frame->count; i++)
    CS_TRY(cs_drawings_have(&frame->maps[i], y)
               ? cs_map_maker_row(&worker->map_makers[i], y, &worker->rows[i])
               : cs_row_make(&worker->makers[i], y, &worker->rows[i]));
  *out = worker->rows;
  return frame->count != 1 || frame->weights[0] != 1 ? expose(worker, out) : CELSPAN_OK;
}

/* ---------------------------------------------------------------- panes */

static bool has_row(const cs_view *pane, int32_t y) {
  return y >= pane->first_row && y < pane->end_row;
}

/* Compiles a pane, and begins it unless it is crowded. The previous pane ends. */
static celspan_status begin_pane(cs_row_worker *worker, const cs_view *pane, bool *is_crowded) {
  finish_makers(worker);
  cs_frame_free_plans(worker->frame, worker->plans, worker->context.memory);
  worker->pane = (cs_view){0};
  CS_TRY(cs_frame_compile(&worker->context, worker->frame, pane, 1, worker->plans, is_crowded));
  if (*is_crowded)
    return CELSPAN_OK;
  CS_TRY(begin_makers(worker, worker->plans));
  worker->pane = *pane;
  return CELSPAN_OK;
}

/* Joins the panes between two columns of a row. Whole rows are divided, so that the bits of a pixel
 * do not depend on the crop. One pixel is a pane in any case. */
static celspan_status join_columns(cs_row_worker *worker, int32_t y, int32_t x0, int32_t x1) {
  const cs_frame *frame = worker->frame;
  cs_view pane = frame->view;
  cs_row *row;
  bool is_crowded;
  if (x1 <= frame->crop_x || x0 >= frame->crop_x + frame->crop_width)
    return CELSPAN_OK;
  pane.first_row = y;
  pane.end_row = y + 1;
  pane.first_column = x0;
  pane.end_column = x1;
  pane.most_dashes = x1 - x0 > 1 ? CS_COMPILE_DASHES : SIZE_MAX;
  CS_TRY(begin_pane(worker, &pane, &is_crowded));
  if (is_crowded) {
    int32_t middle = x0 + (x1 - x0) / 2;
    CS_TRY(join_columns(worker, y, x0, middle));
    return join_columns(worker, y, middle, x1);
  }
  CS_TRY(make_row(worker, y, &row));
  worker->pane = (cs_view){0}; /* the pane is not the whole row */
  return cs_row_append(&worker->context, &worker->joined, row, x0, x1);
}

/* Row y of a crowded frame. */
static celspan_status make_paned_row(cs_row_worker *worker, int32_t y, cs_row **out) {
  cs_view pane = worker->frame->view;
  bool is_crowded = !has_row(&worker->pane, y);
  while (is_crowded && pane.end_row - pane.first_row > 1) {
    int32_t middle = pane.first_row + (pane.end_row - pane.first_row) / 2;
    if (y < middle)
      pane.end_row = middle;
    else
      pane.first_row = middle;
    CS_TRY(begin_pane(worker, &pane, &is_crowded));
  }
  if (!is_crowded)
    return make_row(worker, y, out);
  *out = &worker->joined;
  cs_row_clear(&worker->joined);
  return join_columns(worker, y, pane.first_column, pane.end_column);
}

/* ---------------------------------------------------------------- the crop */

/* Whether the columns of the crop are the columns of the frame. */
static bool has_all_columns(const cs_frame *frame) {
  return frame->crop_x == 0 && frame->crop_width == frame->width;
}

/* A row of the crop that lies above or below the frame. */
static celspan_status make_clear_row(cs_row_worker *worker, cs_row **out) {
  *out = &worker->sum;
  cs_row_clear(&worker->sum);
  return cs_row_single(&worker->context, &worker->sum, 0, worker->frame->crop_width, cs_v4_all(0));
}

/* Cuts a row of the frame to the columns of the crop. */
static celspan_status crop_row(cs_row_worker *worker, cs_row *row) {
  const cs_frame *frame = worker->frame;
  if (has_all_columns(frame))
    return CELSPAN_OK;
  cs_row_crop(row, frame->crop_x, frame->crop_x + frame->crop_width);
  return cs_row_fill(&worker->context, row, frame->crop_width);
}

void cs_row_worker_aim(cs_row_worker *worker, unsigned char *pixels) {
  const cs_frame *frame = worker->frame;
  if (frame->count == 1 && !frame->is_crowded && has_all_columns(frame))
    worker->rows[0].pixels = worker->rows[0].takes_codes ? pixels : NULL;
}

celspan_status cs_row_worker_row(cs_row_worker *worker, int32_t y, const cs_row **out) {
  const cs_frame *frame = worker->frame;
  cs_row *row;
  int32_t place = frame->crop_y + y;
  bool is_outside = place < 0 || place >= frame->height;
  if (!is_outside && (*out = cs_held_find(frame, &worker->held, place)))
    return CELSPAN_OK;
  CS_TRY(is_outside          ? make_clear_row(worker, &row)
         : frame->is_crowded ? make_paned_row(worker, place, &row)
                             : make_row(worker, place, &row));
  *out = row;
  if (is_outside)
    return CELSPAN_OK;
  CS_TRY(crop_row(worker, row));
  *out = cs_held_add(&worker->context, frame, &worker->held, place, row);
  return CELSPAN_OK;
}

uint64_t cs_row_worker_evaluations(const cs_row_worker *worker) {
  return worker->evaluations + count_evaluations(worker);
}
