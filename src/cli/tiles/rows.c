/* Rows of a level to rows of tiles. */
#include "cli/tiles/rows.h"

#include "base/thread_pool.h"
#include "cli/interrupt.h"

/* Neighbouring tiles that a worker writes at a time: enough to walk the spans on from one to the
 * next. */
enum { SHARE = 8 };

/* ---------------------------------------------------------------- a row of tiles */

static cs_row_queue *queue_of(const cs_tile_rows *rows, int32_t y) {
  return &rows->ring[y % rows->ring_count];
}

static const celspan_span *kept_row(const void *user, int32_t y, size_t *count) {
  cs_row_queue_row kept = cs_row_queue_get(queue_of(user, y), 0);
  *count = kept.count;
  return kept.spans;
}

typedef struct tile_row_job {
  cs_tile_rows *rows;
  int32_t row, row_count; /* of tiles; of pixels */
  atomic_int failed;      /* the worker that failed first + 1; 0: none */
  celspan_status status;  /* of that worker, with its sentence in its writer's context */
} tile_row_job;

static celspan_status write_share(tile_row_job *job, cs_tile_writer *writer, int32_t first,
                                  int32_t end) {
  CS_TRY(cs_tile_writer_begin(writer, job->row_count));
  for (int32_t column = first; column < end; column++) {
    if (cs_interrupt_signal())
      return CELSPAN_CANCELLED;
    CS_TRY(cs_tile_writer_put(writer, job->rows->level, column, job->row));
  }
  return CELSPAN_OK;
}

static void write_tiles(void *user, int worker, int32_t share) {
  tile_row_job *job = user;
  const cs_pyramid_box *tiles = &job->rows->tiles;
  int32_t first = tiles->x0 + share * SHARE;
  int32_t end = first + SHARE < tiles->x1 ? first + SHARE : tiles->x1;
  int none = 0;
  if (atomic_load(&job->failed))
    return;
  celspan_status status = write_share(job, &job->rows->writers[worker], first, end);
  if (status != CELSPAN_OK && atomic_compare_exchange_strong(&job->failed, &none, worker + 1))
    job->status = status;
}

static celspan_status write_tile_row(cs_tile_rows *rows, celspan_context *context, int32_t row) {
  cs_pyramid_box tiles = {rows->tiles.x0, row, rows->tiles.x1, row + 1};
  cs_pyramid_box pixels = cs_pyramid_pixels(rows->output->pyramid, rows->level, &tiles);
  tile_row_job job = {.rows = rows, .row = row, .row_count = pixels.y1 - pixels.y0};
  cs_thread_pool_run(rows->workers, (tiles.x1 - tiles.x0 + SHARE - 1) / SHARE, write_tiles, &job);
  if (job.status == CELSPAN_OK || job.status == CELSPAN_CANCELLED)
    return job.status;
  return cs_fail(context, job.status, "%s",
                 rows->writers[atomic_load(&job.failed) - 1].context.error);
}

/* ---------------------------------------------------------------- the sink */

static celspan_status begin(void *user, celspan_context *context, int32_t width, int32_t height) {
  cs_tile_rows *rows = user;
  const cs_pyramid *pyramid = rows->output->pyramid;
  (void)width, (void)height;
  rows->ring_count = pyramid->tile + 2 * pyramid->overlap;
  rows->ring = cs_mem_array(context->memory, (size_t)rows->ring_count, sizeof *rows->ring);
  rows->writers = cs_mem_array(context->memory, (size_t)rows->workers, sizeof *rows->writers);
  if (!rows->ring || !rows->writers)
    return cs_fail_memory(context);
  for (int i = 0; i < rows->workers; i++)
    cs_tile_writer_init(&rows->writers[i], rows->output,
                        (cs_tile_source){kept_row, rows, rows->pixels.x0});
  return CELSPAN_OK;
}

/* The last rows of a level can finish several rows of tiles at once. */
static celspan_status put_row(void *user, celspan_context *context, int32_t y,
                              const celspan_span *spans, size_t span_count) {
  cs_tile_rows *rows = user;
  y += rows->pixels.y0;
  cs_row_queue_clear(queue_of(rows, y));
  CS_TRY(cs_row_queue_add_small(context, queue_of(rows, y), spans, span_count));
  while (rows->next < rows->tiles.y1) {
    cs_pyramid_box tiles = {rows->tiles.x0, rows->next, rows->tiles.x1, rows->next + 1};
    if (y + 1 < cs_pyramid_pixels(rows->output->pyramid, rows->level, &tiles).y1)
      break;
    CS_TRY(write_tile_row(rows, context, rows->next));
    CS_TRY(rows->finished(rows->user, context,
                          (cs_tile_row){rows->level, rows->next, tiles.x0, tiles.x1}));
    rows->next++;
  }
  return CELSPAN_OK;
}

static celspan_status end(void *user, celspan_context *context, celspan_status outcome) {
  cs_tile_rows *rows = user;
  for (int i = 0; rows->writers && i < rows->workers; i++)
    if (rows->writers[i].output)
      cs_tile_writer_finish(&rows->writers[i]);
  for (int32_t i = 0; rows->ring && i < rows->ring_count; i++)
    cs_row_queue_finish(&rows->ring[i], context->memory);
  cs_mem_free(context->memory, rows->ring, (size_t)rows->ring_count * sizeof *rows->ring);
  cs_mem_free(context->memory, rows->writers, (size_t)rows->workers * sizeof *rows->writers);
  rows->ring = NULL;
  rows->writers = NULL;
  return outcome;
}

celspan_sink cs_tile_rows_sink(cs_tile_rows *rows) {
  rows->ring = NULL;
  rows->writers = NULL;
  return (celspan_sink){rows, begin, put_row, end, false};
}
