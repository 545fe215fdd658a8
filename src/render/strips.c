#include "render/strips.h"

#include "base/wait.h"
#include "output/shares.h"
#include "span/row_queue.h"

#include <pthread.h>

/* Bands that may be made ahead of delivery, a worker. */
#define AHEAD 3
/* Rows of a part at most, where the sink has no wish. */
#define PART_ROWS 1024
/* Rows from one look for a stop to the next. */
#define LOOK_ROWS 32

typedef struct strip {
  int32_t index; /* of the band held, or -1 */
  bool is_done;
  celspan_status status;
  char error[sizeof((celspan_context *)0)->error];
  cs_row_queue rows;         /* where the sink takes no parts */
  void *part;                /* else */
  celspan_statistics counts; /* of the part's rows */
} strip;

typedef struct delivery delivery;

typedef struct pool {
  celspan_context *context;
  const cs_frame *frame;
  delivery *delivery;
  cs_row_worker *row_workers;
  bool has_parts;
  cs_shares parts;
  void **hands;  /* one a lane, where there are parts */
  strip *strips; /* a ring: band i lies at i % band_count */
  int lane_count, band_count;
  int32_t strip_height;
  int32_t total;   /* bands of the frame */
  int32_t claimed; /* the next band to be made */
  int32_t delivered;
  bool is_stopped;
  atomic_bool is_cancelled; /* read without the mutex, amid parts */
  pthread_mutex_t mutex;
  pthread_cond_t done, room;
} pool;

struct delivery {
  celspan_context *context;
  const celspan_frame_desc *desc;
  const celspan_sink *sink;
  celspan_statistics *statistics;
  int32_t rows_done, rows_total;
};

/* ---------------------------------------------------------------- delivery */

/* Spans are looked at only where there are arrays. */
static inline void count_spans(celspan_statistics *statistics, const celspan_span *spans,
                               size_t count, cs_varied varied) {
  statistics->rows++;
  statistics->spans += count;
  statistics->single += count - varied.gradients - varied.arrays;
  statistics->gradient += varied.gradients;
  statistics->array += varied.arrays;
  for (size_t i = 0; varied.arrays > 0 && i < count; i++)
    if (spans[i].kind == CELSPAN_SPAN_ARRAY)
      statistics->pixels_in_arrays += (uint64_t)(spans[i].x1 - spans[i].x0);
}

static inline celspan_status deliver_row(delivery *d, const celspan_span *spans, size_t count,
                                         cs_varied varied) {
  count_spans(d->statistics, spans, count, varied);
  int32_t y = d->rows_done++;
  return d->sink->row ? d->sink->row(d->sink->user, d->context, y, spans, count) : CELSPAN_OK;
}

static bool goes_on(const delivery *d) {
  const celspan_frame_desc *desc = d->desc;
  return !desc->progress || desc->progress(desc->progress_user, d->rows_done, d->rows_total);
}

static celspan_status stop(const delivery *d) {
  return cs_fail(d->context, CELSPAN_CANCELLED, "stopped after %d of %d rows", (int)d->rows_done,
                 (int)d->rows_total);
}

static celspan_status report_progress(const delivery *d) {
  return goes_on(d) ? CELSPAN_OK : stop(d);
}

/* ---------------------------------------------------------------- making bands */

static int32_t band_first(const pool *p, int32_t index) { return index * p->strip_height; }

static int32_t band_end(const pool *p, int32_t index) {
  int64_t end = (int64_t)band_first(p, index) + p->strip_height;
  return end < p->frame->crop_height ? (int32_t)end : p->frame->crop_height;
}

static celspan_status make_part_row(pool *p, cs_row_worker *row_worker, strip *b, int32_t y) {
  const cs_row *row;
  CS_TRY(cs_row_worker_row(row_worker, y, &row));
  if (y >= band_first(p, b->index))
    count_spans(&b->counts, row->spans, row->count, row->varied);
  return p->parts.row ? p->parts.row(p->parts.user, p->hands[row_worker - p->row_workers],
                                     &row_worker->context, y, row->spans, row->count)
                      : CELSPAN_OK;
}

/* Parts may take long. The calling thread, which has the first lane, asks whether to go on; the
 * others hear of it. */
static celspan_status look(pool *p, cs_row_worker *row_worker) {
  if (row_worker == p->row_workers && !goes_on(p->delivery))
    atomic_store(&p->is_cancelled, true);
  return atomic_load(&p->is_cancelled) ? CELSPAN_CANCELLED : CELSPAN_OK;
}

static celspan_status make_part(pool *p, cs_row_worker *row_worker, strip *b) {
  const cs_shares *parts = &p->parts;
  void *hand = p->hands[row_worker - p->row_workers];
  int32_t first = band_first(p, b->index), end = band_end(p, b->index);
  b->counts = (celspan_statistics){0};
  if (parts->begin)
    CS_TRY(parts->begin(hand, &row_worker->context, b->part, b->index));
  for (int32_t y = first - (parts->takes_above && first > 0); y < end; y++) {
    CS_TRY(make_part_row(p, row_worker, b, y));
    if ((y - first) % LOOK_ROWS == LOOK_ROWS - 1)
      CS_TRY(look(p, row_worker));
  }
  return parts->end ? parts->end(hand, &row_worker->context) : CELSPAN_OK;
}

static celspan_status make_rows(pool *p, cs_row_worker *row_worker, strip *b) {
  int32_t end = band_end(p, b->index);
  cs_row_queue_clear(&b->rows);
  for (int32_t y = band_first(p, b->index); y < end; y++) {
    const cs_row *row;
    CS_TRY(cs_row_worker_row(row_worker, y, &row));
    CS_TRY(cs_row_queue_add(&row_worker->context, &b->rows, row->spans, row->count));
  }
  return CELSPAN_OK;
}

static void make_band(pool *p, cs_row_worker *row_worker, strip *b) {
  b->status = p->has_parts ? make_part(p, row_worker, b) : make_rows(p, row_worker, b);
  if (b->status != CELSPAN_OK)
    memcpy(b->error, row_worker->context.error, sizeof b->error);
}

/* The next band to be made, if there is one and room for it; the mutex is held. */
static strip *claim(pool *p) {
  if (p->is_stopped || p->claimed == p->total || p->claimed >= p->delivered + p->band_count)
    return NULL;
  strip *b = &p->strips[p->claimed % p->band_count];
  b->index = p->claimed++;
  b->is_done = false;
  return b;
}

/* Makes a claimed band with the mutex let go. */
static void work(pool *p, cs_row_worker *row_worker, strip *b) {
  pthread_mutex_unlock(&p->mutex);
  make_band(p, row_worker, b);
  pthread_mutex_lock(&p->mutex);
  b->is_done = true;
  pthread_cond_signal(&p->done);
}

typedef struct worker {
  pool *pool;
  cs_row_worker *row_worker;
  pthread_t thread;
} worker;

static void *worker_main(void *argument) {
  worker *w = argument;
  pool *p = w->pool;
  pthread_mutex_lock(&p->mutex);
  while (!p->is_stopped && p->claimed < p->total) {
    strip *b = claim(p);
    if (b)
      work(p, w->row_worker, b);
    else
      pthread_cond_wait(&p->room, &p->mutex);
  }
  pthread_mutex_unlock(&p->mutex);
  return NULL;
}

/* ---------------------------------------------------------------- the pool */

static void add_counts(celspan_statistics *sum, const celspan_statistics *counts) {
  sum->rows += counts->rows;
  sum->spans += counts->spans;
  sum->single += counts->single;
  sum->gradient += counts->gradient;
  sum->array += counts->array;
  sum->pixels_in_arrays += counts->pixels_in_arrays;
}

static celspan_status join_part(const pool *p, delivery *d, const strip *b) {
  add_counts(d->statistics, &b->counts);
  d->rows_done += (int32_t)b->counts.rows;
  if (p->parts.join)
    CS_TRY(p->parts.join(p->parts.user, d->context, b->part, b->index));
  return report_progress(d);
}

static celspan_status deliver_band(const pool *p, delivery *d, const strip *b) {
  if (b->status != CELSPAN_OK)
    return cs_fail(d->context, b->status, "%s", b->error);
  if (p->has_parts)
    return join_part(p, d, b);
  for (size_t k = 0; k < b->rows.count; k++) {
    cs_row_queue_row row = cs_row_queue_get(&b->rows, k);
    CS_TRY(deliver_row(d, row.spans, row.count, row.varied));
  }
  return report_progress(d);
}

/* While others work: the mutex is held, and let go meanwhile. */
static celspan_status look_up(pool *p, const delivery *d) {
  pthread_mutex_unlock(&p->mutex);
  celspan_status status = report_progress(d);
  pthread_mutex_lock(&p->mutex);
  return status;
}

/* Delivers bands in order, making one whenever the next is not there yet; the mutex is held, and
 * let go while the sink works. */
static celspan_status deliver_all(pool *p, delivery *d) {
  while (p->delivered < p->total) {
    if (atomic_load(&p->is_cancelled))
      return stop(d);
    strip *next = &p->strips[p->delivered % p->band_count];
    if (next->index == p->delivered && next->is_done) {
      pthread_mutex_unlock(&p->mutex);
      celspan_status status = deliver_band(p, d, next);
      pthread_mutex_lock(&p->mutex);
      CS_TRY(status);
      p->delivered++;
      pthread_cond_broadcast(&p->room);
      continue;
    }
    strip *own = claim(p);
    if (own)
      work(p, &p->row_workers[0], own);
    else if (!cs_wait_moment(&p->done, &p->mutex))
      CS_TRY(look_up(p, d));
  }
  return CELSPAN_OK;
}

static celspan_status run_pool(pool *p, delivery *d, worker *workers) {
  int started = 1; /* the calling thread is worker 0 */
  for (; started < p->lane_count; started++) {
    workers[started] = (worker){.pool = p, .row_worker = &p->row_workers[started]};
    if (pthread_create(&workers[started].thread, NULL, worker_main, &workers[started]) != 0)
      break; /* fewer workers make the same rows */
  }
  pthread_mutex_lock(&p->mutex);
  celspan_status status = deliver_all(p, d);
  p->is_stopped = true;
  atomic_store(&p->is_cancelled, true); /* parts that nobody waits for any more */
  pthread_cond_broadcast(&p->room);
  pthread_mutex_unlock(&p->mutex);
  while (--started > 0)
    pthread_join(workers[started].thread, NULL);
  return status;
}

static void close_parts(pool *p) {
  const cs_shares *parts = &p->parts;
  for (int i = 0; parts->close_worker && p->hands && i < p->lane_count; i++)
    parts->close_worker(parts->user, p->context, p->hands[i]);
  for (int i = 0; parts->close_share && p->strips && i < p->band_count; i++)
    parts->close_share(parts->user, p->context, p->strips[i].part);
  cs_mem_free(p->context->memory, p->hands, (size_t)p->lane_count * sizeof *p->hands);
}

static celspan_status open_parts(pool *p) {
  const cs_shares *parts = &p->parts;
  p->hands = cs_mem_array(p->context->memory, (size_t)p->lane_count, sizeof *p->hands);
  if (!p->hands)
    return cs_fail_memory(p->context);
  for (int i = 0; parts->open_worker && i < p->lane_count; i++)
    CS_TRY(parts->open_worker(parts->user, p->context, &p->hands[i]));
  for (int i = 0; parts->open_share && i < p->band_count; i++)
    CS_TRY(parts->open_share(parts->user, p->context, &p->strips[i].part));
  return CELSPAN_OK;
}

static void free_pool(pool *p, worker *workers) {
  cs_memory *memory = p->context->memory;
  close_parts(p);
  for (int i = 0; p->row_workers && i < p->lane_count; i++)
    cs_row_worker_finish(&p->row_workers[i]);
  for (int i = 0; p->strips && i < p->band_count; i++)
    cs_row_queue_finish(&p->strips[i].rows, memory);
  cs_mem_free(memory, p->row_workers, (size_t)p->lane_count * sizeof *p->row_workers);
  cs_mem_free(memory, p->strips, (size_t)p->band_count * sizeof *p->strips);
  cs_mem_free(memory, workers, (size_t)p->lane_count * sizeof *workers);
  pthread_cond_destroy(&p->done);
  pthread_cond_destroy(&p->room);
  pthread_mutex_destroy(&p->mutex);
}

static celspan_status init_lanes(celspan_context *context, const cs_frame *frame,
                                 cs_row_worker *row_workers, int count) {
  for (int i = 0; i < count; i++) {
    celspan_status status = cs_row_worker_init(&row_workers[i], context, frame);
    if (status != CELSPAN_OK)
      return cs_fail(context, status, "%s", row_workers[i].context.error);
  }
  return CELSPAN_OK;
}

static uint64_t sum_evaluations(const cs_row_worker *row_workers, int count) {
  uint64_t sum = 0;
  for (int i = 0; i < count; i++)
    sum += cs_row_worker_evaluations(&row_workers[i]);
  return sum;
}

static int32_t count_bands(const cs_frame *frame, int32_t strip_height) {
  return (int32_t)(((int64_t)frame->crop_height + strip_height - 1) / strip_height);
}

/* A lane that goes on to its next band passes over the rows of the others. Where nothing of a band
 * is kept it may be high, so that this is seldom. */
static int32_t choose_rows(const pool *p, const celspan_frame_desc *desc) {
  const cs_frame *frame = p->frame;
  int32_t share = frame->crop_height / (frame->workers * 16);
  if (p->parts.rows > 0)
    return p->parts.rows;
  if (!p->has_parts || desc->strip_rows > 0 || share <= frame->strip_height)
    return frame->strip_height;
  return share < PART_ROWS ? share : PART_ROWS;
}

static celspan_status render_pool(celspan_context *context, const cs_frame *frame, delivery *d) {
  pool p = {.context = context, .frame = frame, .delivery = d};
  p.has_parts = cs_shares_of_sink(d->sink, &p.parts);
  p.strip_height = choose_rows(&p, d->desc);
  int32_t total = p.total = count_bands(frame, p.strip_height);
  p.lane_count = frame->workers < total ? frame->workers : (int)total;
  p.band_count = p.lane_count * AHEAD;
  pthread_mutex_init(&p.mutex, NULL);
  cs_wait_init(&p.done);
  pthread_cond_init(&p.room, NULL);
  p.row_workers = cs_mem_array(context->memory, (size_t)p.lane_count, sizeof *p.row_workers);
  p.strips = cs_mem_array(context->memory, (size_t)p.band_count, sizeof *p.strips);
  worker *workers = cs_mem_array(context->memory, (size_t)p.lane_count, sizeof *workers);
  celspan_status status = CELSPAN_OK;
  if (!p.row_workers || !p.strips || !workers)
    status = cs_fail_memory(context);
  for (int i = 0; status == CELSPAN_OK && i < p.band_count; i++)
    p.strips[i].index = -1;
  if (status == CELSPAN_OK)
    status = init_lanes(context, frame, p.row_workers, p.lane_count);
  if (status == CELSPAN_OK && p.has_parts)
    status = open_parts(&p);
  if (status == CELSPAN_OK)
    status = run_pool(&p, d, workers);
  if (p.row_workers)
    d->statistics->colour_evaluations += sum_evaluations(p.row_workers, p.lane_count);
  free_pool(&p, workers);
  return status;
}

/* ---------------------------------------------------------------- one worker */

static celspan_status deliver_rows(cs_row_worker *row_worker, const cs_frame *frame, delivery *d) {
  for (int32_t y = 0; y < frame->crop_height; y++) {
    const cs_row *row;
    celspan_status status = cs_row_worker_row(row_worker, y, &row);
    if (status != CELSPAN_OK)
      return cs_fail(d->context, status, "%s", row_worker->context.error);
    CS_TRY(deliver_row(d, row->spans, row->count, row->varied));
    if ((y + 1) % frame->strip_height == 0 || y + 1 == frame->crop_height)
      CS_TRY(report_progress(d));
  }
  return CELSPAN_OK;
}

/* Rows go from the scan to the sink without a copy. */
static celspan_status render_alone(celspan_context *context, const cs_frame *frame, delivery *d) {
  cs_row_worker row_worker;
  celspan_status status = init_lanes(context, frame, &row_worker, 1);
  if (status == CELSPAN_OK)
    status = deliver_rows(&row_worker, frame, d);
  d->statistics->colour_evaluations += cs_row_worker_evaluations(&row_worker);
  cs_row_worker_finish(&row_worker);
  return status;
}

celspan_status cs_strips_render(celspan_context *context, const cs_frame *frame,
                                const celspan_frame_desc *desc, const celspan_sink *sink,
                                celspan_statistics *statistics) {
  delivery d = {context, desc, sink, statistics, 0, frame->crop_height};
  if (frame->workers == 1 || frame->crop_height <= frame->strip_height)
    return render_alone(context, frame, &d);
  return render_pool(context, frame, &d);
}
