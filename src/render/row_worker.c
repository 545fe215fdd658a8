#include "render/row_worker.h"

celspan_status cs_row_worker_init(cs_row_worker *worker, celspan_context *context,
                                  const cs_frame *frame) {
  *worker = (cs_row_worker){.frame = frame};
  cs_context_branch(&worker->context, context);
  cs_row_init(&worker->sum);
  worker->makers = cs_mem_array(context->memory, frame->count, sizeof *worker->makers);
  worker->rows = cs_mem_array(context->memory, frame->count, sizeof *worker->rows);
  if (frame->count > 0 && (!worker->makers || !worker->rows))
    return cs_fail_memory(&worker->context);
  for (size_t i = 0; i < frame->count; i++) {
    cs_row_init(&worker->rows[i]);
    worker->rows[i].takes_codes = frame->takes_codes && frame->count == 1 && frame->weights[0] == 1;
    CS_TRY(cs_row_maker_init(&worker->makers[i], &worker->context, &frame->plans[i]));
  }
  return CELSPAN_OK;
}

void cs_row_worker_finish(cs_row_worker *worker) {
  if (!worker->frame)
    return;
  cs_memory *memory = worker->context.memory;
  for (size_t i = 0; i < worker->frame->count; i++) {
    if (worker->makers)
      cs_row_maker_finish(&worker->makers[i]);
    if (worker->rows)
      cs_row_finish(&worker->rows[i], memory);
  }
  cs_row_finish(&worker->sum, memory);
  cs_mem_free(memory, worker->makers, worker->frame->count * sizeof *worker->makers);
  cs_mem_free(memory, worker->rows, worker->frame->count * sizeof *worker->rows);
  *worker = (cs_row_worker){0};
}

static celspan_status expose(cs_row_worker *worker, cs_row **out) {
  const cs_frame *frame = worker->frame;
  *out = &worker->sum;
  cs_row_clear(&worker->sum);
  if (frame->count == 0)
    return cs_row_single(&worker->context, &worker->sum, 0, frame->width, cs_v4_all(0));
  return cs_row_expose(&worker->context, &worker->sum, worker->rows, frame->weights, frame->count);
}

celspan_status cs_row_worker_row(cs_row_worker *worker, int32_t y, const cs_row **out) {
  const cs_frame *frame = worker->frame;
  for (size_t i = 0; i < frame->count; i++)
    CS_TRY(cs_row_make(&worker->makers[i], frame->crop_y + y, &worker->rows[i]));
  cs_row *row = worker->rows;
  if (frame->count != 1 || frame->weights[0] != 1)
    CS_TRY(expose(worker, &row));
  if (frame->crop_width != frame->width)
    cs_row_crop(row, frame->crop_x, frame->crop_x + frame->crop_width);
  *out = row;
  return CELSPAN_OK;
}

uint64_t cs_row_worker_evaluations(const cs_row_worker *worker) {
  uint64_t evaluations = 0;
  for (size_t i = 0; worker->makers && i < worker->frame->count; i++)
    evaluations += worker->makers[i].composer.evaluations + worker->makers[i].painter.evaluations;
  return evaluations;
}
