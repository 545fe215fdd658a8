/* Rows of a level to rows of tiles. */
#include "cli/tiles/rows.h"

#include <string.h>

#include "base/context.h"
#include "cli/interrupt.h"

/* Neighbouring tiles a thread takes at a time: enough to walk the spans on from one to the next. */
enum { SHARE = 8 };

/* ---------------------------------------------------------------- keeping rows */

static cs_kept_row *slot(const cs_tile_rows *rows, int32_t y) {
  return &rows->ring[y % rows->ring_count];
}

static const celspan_span *kept_row(const void *user, int32_t y, size_t *count) {
  const cs_kept_row *kept = slot(user, y);
  *count = kept->count;
  return kept->spans;
}

/* Spans of two or three pixels take more room than their pixels. */
static bool is_dense(const celspan_span *spans, size_t count) {
  return count * sizeof *spans > (size_t)spans[count - 1].x1 * 4 * sizeof(float);
}

static celspan_status keep_colours(celspan_context *context, cs_kept_row *kept,
                                   const celspan_span *spans, size_t count) {
  int32_t width = spans[count - 1].x1;
  float *colours = cs_arena_take(context, &kept->colours, (size_t)width * 4 * sizeof(float));
  if (!colours)
    return CELSPAN_NO_MEMORY;
  for (size_t i = 0; i < count; i++)
    for (int32_t x = spans[i].x0; x < spans[i].x1; x++)
      celspan_span_colour(&spans[i], x, colours + 4 * (size_t)x);
  CS_TRY(cs_mem_reserve(context, (void **)&kept->spans, &kept->capacity, 1, sizeof *kept->spans));
  kept->spans[0] =
      (celspan_span){.x0 = 0, .x1 = width, .kind = CELSPAN_SPAN_ARRAY, .array = colours};
  kept->count = 1;
  return CELSPAN_OK;
}

static celspan_status keep(celspan_context *context, cs_kept_row *kept, const celspan_span *spans,
                           size_t count) {
  cs_arena_reset(&kept->colours);
  if (is_dense(spans, count))
    return keep_colours(context, kept, spans, count);
  CS_TRY(
      cs_mem_reserve(context, (void **)&kept->spans, &kept->capacity, count, sizeof *kept->spans));
  kept->count = count;
  memcpy(kept->spans, spans, count * sizeof *spans);
  for (size_t i = 0; i < count; i++) {
    celspan_span *span = &kept->spans[i];
    if (span->kind != CELSPAN_SPAN_ARRAY)
      continue;
    size_t size = (size_t)(span->x1 - span->x0) * 4 * sizeof(float);
    float *colours = cs_arena_take(context, &kept->colours, size);
    if (!colours)
      return CELSPAN_NO_MEMORY;
    span->array = memcpy(colours, span->array, size);
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- a row of tiles */

typedef struct tile_row_job {
  cs_tile_rows *rows;
  int32_t row, row_count; /* of tiles; of pixels */
  atomic_int next;        /* column of tiles, from the first */
  atomic_int failed;      /* a worker + 1, the first that failed; 0: none */
} tile_row_job;

typedef struct tile_hand {
  tile_row_job *job;
  int index;
  pthread_t thread;
  celspan_status status;
} tile_hand;

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

static void *write_tiles(void *user) {
  tile_hand *hand = user;
  tile_row_job *job = hand->job;
  const cs_pyramid_box *tiles = &job->rows->tiles;
  while (hand->status == CELSPAN_OK && !atomic_load(&job->failed)) {
    int32_t first = tiles->x0 + atomic_fetch_add(&job->next, SHARE);
    if (first >= tiles->x1)
      break;
    int32_t end = first + SHARE < tiles->x1 ? first + SHARE : tiles->x1;
    hand->status = write_share(job, &job->rows->writers[hand->index], first, end);
  }
  int none = 0;
  if (hand->status != CELSPAN_OK)
    atomic_compare_exchange_strong(&job->failed, &none, hand->index + 1);
  return NULL;
}

/* The calling thread is the first hand; threads that cannot be had are done without. */
static celspan_status write_tile_row(cs_tile_rows *rows, celspan_context *context, int32_t row) {
  cs_pyramid_box tiles = {rows->tiles.x0, row, rows->tiles.x1, row + 1};
  cs_pyramid_box pixels = cs_pyramid_pixels(rows->output->pyramid, rows->level, &tiles);
  tile_row_job job = {.rows = rows, .row = row, .row_count = pixels.y1 - pixels.y0};
  int32_t shares = (tiles.x1 - tiles.x0 + SHARE - 1) / SHARE;
  int wanted = rows->workers < shares ? rows->workers : (int)shares, started = 1;
  tile_hand *hands = cs_mem_array(context->memory, (size_t)wanted, sizeof *hands);
  if (!hands)
    return cs_fail_memory(context);
  for (int i = 0; i < wanted; i++)
    hands[i] = (tile_hand){.job = &job, .index = i};
  while (started < wanted &&
         pthread_create(&hands[started].thread, NULL, write_tiles, &hands[started]) == 0)
    started++;
  write_tiles(&hands[0]);
  for (int i = 1; i < started; i++)
    pthread_join(hands[i].thread, NULL);
  int failed = atomic_load(&job.failed) - 1;
  celspan_status status = failed < 0 ? CELSPAN_OK : hands[failed].status;
  cs_mem_free(context->memory, hands, (size_t)wanted * sizeof *hands);
  if (status == CELSPAN_OK || status == CELSPAN_CANCELLED)
    return status;
  return cs_fail(context, status, "%s", rows->writers[failed].context.error);
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
  for (int32_t i = 0; i < rows->ring_count; i++)
    cs_arena_init(&rows->ring[i].colours);
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
  CS_TRY(keep(context, slot(rows, y), spans, span_count));
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
  for (int32_t i = 0; rows->ring && i < rows->ring_count; i++) {
    cs_kept_row *kept = &rows->ring[i];
    cs_mem_free(context->memory, kept->spans, kept->capacity * sizeof *kept->spans);
    cs_arena_finish(&kept->colours, context->memory);
  }
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
