/* Strips: rows of a frame made together by a worker, delivered in order.
 *
 *   workers --rows, strip by strip--> strips --in order, by the calling thread--> sink
 *
 * A sink that takes shares (output/sinks/shares.h) gets the rows from the workers directly,
 * and the shares are then joined in order. The calling thread works too while it has nothing to
 * deliver.
 *
 * INVARIANT: the sink gets the same spans, or the codes of these where the frame has a coder,
 * whatever the number of workers and the height of strips; if rows fail, the failure of the topmost
 * of them is reported.
 */
#include "frames/render/row_worker.h"

#include "base/pipeline.h"
#include "engine/span/row_queue.h"
#include "output/sinks/shares.h"

/* Strips that may be made ahead of delivery, for each worker. */
#define AHEAD 3
/* Rows of a share at most, where the sink asks for no number. */
#define SHARE_ROWS 1024
/* After this many rows of a share a worker asks whether the share is still wanted. */
#define CHECK_ROWS 32

typedef struct strip {
  cs_row_queue rows;         /* where the sink takes no shares */
  void *share;               /* where the sink takes shares */
  celspan_statistics counts; /* the counts of the share's rows */
} strip;

typedef struct delivery {
  celspan_context *context;
  const celspan_frame_desc *desc;
  const celspan_sink *sink;
  celspan_statistics *statistics;
  int32_t rows_done, rows_total;
} delivery;

typedef struct strips {
  celspan_context *context;
  const cs_frame *frame;
  delivery *delivery;
  cs_pipeline *pipeline;
  bool has_shares;
  cs_shares shares;
  CS_ARRAY(cs_row_worker, row_workers); /* one for each worker */
  CS_ARRAY(strip, ring);                /* strip i lies at i % ring_size */
  void **share_workers; /* the sink's own data for each worker, where there are shares */
  int worker_count, ring_size;
  int32_t strip_height;
  int32_t total; /* strips of the frame */
} strips;

/* ---------------------------------------------------------------- delivery */

/* Reads the spans only where some are arrays. */
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

/* ---------------------------------------------------------------- making a strip */

static int32_t first_row(const strips *s, int32_t index) { return index * s->strip_height; }

static int32_t end_row(const strips *s, int32_t index) {
  int64_t end = (int64_t)first_row(s, index) + s->strip_height;
  return end < s->frame->crop_height ? (int32_t)end : s->frame->crop_height;
}

/* Whether the rest of a share, which may take long, is still wanted. Only the calling thread may
 * ask the caller; if the caller cancels, the other threads end their shares too. */
static bool is_wanted(strips *s, int worker, int32_t index) {
  if (worker == 0 && !goes_on(s->delivery))
    cs_pipeline_end_at(s->pipeline, 0);
  return cs_pipeline_is_wanted(s->pipeline, (size_t)index);
}

static inline void aim(cs_row_worker *row_worker, const cs_shares *shares, void *worker,
                       int32_t y) {
  if (shares->pixels)
    cs_row_worker_aim(row_worker, shares->pixels(shares->user, worker, y));
}

static celspan_status make_share_row(strips *s, int worker, strip *made, int32_t y, bool counts) {
  cs_row_worker *row_worker = &s->row_workers[worker];
  const cs_row *row;
  aim(row_worker, &s->shares, s->share_workers[worker], y);
  CS_TRY(cs_row_worker_row(row_worker, y, &row));
  if (counts)
    count_spans(&made->counts, row->spans, row->count, row->varied);
  return s->shares.row ? s->shares.row(s->shares.user, s->share_workers[worker],
                                       &row_worker->context, y, row->spans, row->count)
                       : CELSPAN_OK;
}

static celspan_status make_share(strips *s, int worker, int32_t index, strip *made) {
  const cs_shares *shares = &s->shares;
  celspan_context *context = &s->row_workers[worker].context;
  int32_t first = first_row(s, index), end = end_row(s, index);
  made->counts = (celspan_statistics){0};
  if (shares->begin)
    CS_TRY(shares->begin(s->share_workers[worker], context, made->share, index));
  for (int32_t y = first - (shares->takes_above && first > 0); y < end; y++) {
    CS_TRY(make_share_row(s, worker, made, y, y >= first));
    if ((y - first) % CHECK_ROWS == CHECK_ROWS - 1 && !is_wanted(s, worker, index))
      return CELSPAN_CANCELLED;
  }
  return shares->end ? shares->end(s->share_workers[worker], context) : CELSPAN_OK;
}

static celspan_status make_rows(strips *s, int worker, int32_t index, strip *made) {
  cs_row_worker *row_worker = &s->row_workers[worker];
  int32_t end = end_row(s, index);
  cs_row_queue_clear(&made->rows);
  for (int32_t y = first_row(s, index); y < end; y++) {
    const cs_row *row;
    CS_TRY(cs_row_worker_row(row_worker, y, &row));
    CS_TRY(cs_frame_queue_row(&row_worker->context, s->frame, y, row, &made->rows));
  }
  return CELSPAN_OK;
}

/* Each thread begins its own worker, whose memory would otherwise lie in another core's cache. */
static celspan_status begin_worker(const strips *s, int worker) {
  cs_row_worker *row_worker = &s->row_workers[worker];
  return row_worker->frame ? CELSPAN_OK : cs_row_worker_init(row_worker, s->context, s->frame);
}

static celspan_status make_strip(void *user, celspan_context *context, int worker, size_t item) {
  strips *s = user;
  strip *made = &s->ring[item % (size_t)s->ring_size];
  celspan_status status = begin_worker(s, worker);
  if (status == CELSPAN_OK)
    status = s->has_shares ? make_share(s, worker, (int32_t)item, made)
                           : make_rows(s, worker, (int32_t)item, made);
  return status == CELSPAN_OK
             ? CELSPAN_OK
             : cs_fail(context, status, "%s", s->row_workers[worker].context.error);
}

/* ---------------------------------------------------------------- delivering strips in order */

static void add_counts(celspan_statistics *sum, const celspan_statistics *counts) {
  sum->rows += counts->rows;
  sum->spans += counts->spans;
  sum->single += counts->single;
  sum->gradient += counts->gradient;
  sum->array += counts->array;
  sum->pixels_in_arrays += counts->pixels_in_arrays;
}

static celspan_status join_share(const strips *s, const strip *made, int32_t index) {
  delivery *d = s->delivery;
  add_counts(d->statistics, &made->counts);
  d->rows_done += (int32_t)made->counts.rows;
  if (s->shares.join)
    CS_TRY(s->shares.join(s->shares.user, d->context, made->share, index));
  return report_progress(d);
}

static celspan_status deliver_strip(void *user, celspan_context *context, size_t item,
                                    celspan_status status) {
  const strips *s = user;
  const strip *made = &s->ring[item % (size_t)s->ring_size];
  (void)context;
  if (!cs_pipeline_is_wanted(s->pipeline, item))
    return stop(s->delivery);
  CS_TRY(status);
  if (s->has_shares)
    return join_share(s, made, (int32_t)item);
  for (size_t k = 0; k < made->rows.count; k++) {
    cs_row_queue_row row = cs_row_queue_get(&made->rows, k);
    CS_TRY(deliver_row(s->delivery, row.spans, row.count, row.varied));
  }
  return report_progress(s->delivery);
}

/* After the calling thread was asked to stop, in the middle of a share, nobody is asked again. */
static celspan_status report_idle(void *user, celspan_context *context) {
  const strips *s = user;
  (void)context;
  return cs_pipeline_is_wanted(s->pipeline, 0) ? report_progress(s->delivery) : stop(s->delivery);
}

static celspan_status deliver_all(strips *s) {
  for (int32_t i = 0; i < s->total; i++) {
    CS_TRY(cs_pipeline_deliver(s->pipeline, s->context, (size_t)s->ring_size - 1));
    if (!cs_pipeline_has_room(s->pipeline))
      break;
    cs_pipeline_add(s->pipeline, s->context, CS_PIPELINE_ANYWHERE, CELSPAN_OK);
  }
  return cs_pipeline_deliver(s->pipeline, s->context, 0);
}

static celspan_status run_pipeline(strips *s) {
  const cs_pipeline_desc desc = {.count = (size_t)s->total,
                                 .slots = (size_t)s->ring_size,
                                 .threads = s->worker_count - 1,
                                 .owner_claims = true,
                                 .user = s,
                                 .make = make_strip,
                                 .deliver = deliver_strip,
                                 .idle = report_idle};
  CS_TRY(cs_pipeline_create(s->context, &desc, &s->pipeline));
  celspan_status status = deliver_all(s);
  cs_pipeline_destroy(s->pipeline);
  return status;
}

/* ---------------------------------------------------------------- several workers */

static void close_shares(strips *s) {
  const cs_shares *shares = &s->shares;
  for (int i = 0; shares->close_worker && s->share_workers && i < s->worker_count; i++)
    shares->close_worker(shares->user, s->context, s->share_workers[i]);
  for (int i = 0; shares->close_share && s->ring && i < s->ring_size; i++)
    shares->close_share(shares->user, s->context, s->ring[i].share);
  cs_mem_free(s->context->memory, s->share_workers,
              (size_t)s->worker_count * sizeof *s->share_workers);
}

static celspan_status open_shares(strips *s) {
  const cs_shares *shares = &s->shares;
  CS_TRY(CS_MAKE(s->context, s->share_workers, (size_t)s->worker_count));
  for (int i = 0; shares->open_worker && i < s->worker_count; i++)
    CS_TRY(shares->open_worker(shares->user, s->context, &s->share_workers[i]));
  for (int i = 0; shares->open_share && i < s->ring_size; i++)
    CS_TRY(shares->open_share(shares->user, s->context, &s->ring[i].share));
  return CELSPAN_OK;
}

static celspan_status open_strips(strips *s) {
  CS_TRY(CS_ARRAY_MAKE(s->context, s->row_workers, (size_t)s->worker_count));
  CS_TRY(CS_ARRAY_MAKE(s->context, s->ring, (size_t)s->ring_size));
  return s->has_shares ? open_shares(s) : CELSPAN_OK;
}

static void close_strips(strips *s) {
  cs_memory *memory = s->context->memory;
  close_shares(s);
  for (int i = 0; s->row_workers && i < s->worker_count; i++)
    cs_row_worker_finish(&s->row_workers[i]);
  for (int i = 0; s->ring && i < s->ring_size; i++)
    cs_row_queue_finish(&s->ring[i].rows, memory);
  CS_ARRAYS_FREE(memory, s, row_workers, ring);
}

static uint64_t sum_evaluations(const cs_row_worker *row_workers, int count) {
  uint64_t sum = 0;
  for (int i = 0; row_workers && i < count; i++)
    sum += cs_row_worker_evaluations(&row_workers[i]);
  return sum;
}

/* Between two of its strips a worker must advance past the rows of the other workers. Where the
 * rows of a strip are not stored, strips may be high, so that this happens rarely. */
static int32_t choose_rows(const strips *s, const celspan_frame_desc *desc) {
  const cs_frame *frame = s->frame;
  int32_t share = frame->crop_height / (frame->workers * 16);
  if (s->shares.rows > 0)
    return s->shares.rows;
  if (!s->has_shares || desc->strip_rows > 0 || share <= frame->strip_height)
    return frame->strip_height;
  return share < SHARE_ROWS ? share : SHARE_ROWS;
}

static celspan_status render_together(celspan_context *context, const cs_frame *frame,
                                      delivery *d) {
  strips s = {.context = context, .frame = frame, .delivery = d};
  /* If there were only one share, only one worker could make the rows. */
  s.has_shares = cs_sink_shares(d->sink, &s.shares) && s.shares.rows < frame->crop_height;
  if (!s.has_shares)
    s.shares = (cs_shares){.rows = 0};
  s.strip_height = choose_rows(&s, d->desc);
  s.total = (int32_t)(((int64_t)frame->crop_height + s.strip_height - 1) / s.strip_height);
  s.worker_count = frame->workers < s.total ? frame->workers : (int)s.total;
  s.ring_size = s.worker_count * AHEAD;
  celspan_status status = open_strips(&s);
  if (status == CELSPAN_OK)
    status = run_pipeline(&s);
  d->statistics->colour_evaluations += sum_evaluations(s.row_workers, s.worker_count);
  close_strips(&s);
  return status;
}

/* ---------------------------------------------------------------- one worker */

static celspan_status deliver_rows(cs_row_worker *row_worker, const cs_frame *frame, delivery *d) {
  cs_shares shares;
  if (!cs_memory_sink_shares(d->sink, &shares))
    shares.pixels = NULL;
  for (int32_t y = 0; y < frame->crop_height; y++) {
    const cs_row *row;
    aim(row_worker, &shares, NULL, y);
    celspan_status status = cs_row_worker_row(row_worker, y, &row);
    if (status != CELSPAN_OK)
      return cs_fail(d->context, status, "%s", row_worker->context.error);
    CS_TRY(deliver_row(d, row->spans, row->count, row->varied));
    if ((y + 1) % frame->strip_height == 0 || y + 1 == frame->crop_height)
      CS_TRY(report_progress(d));
  }
  return CELSPAN_OK;
}

/* Rows go from their maker to the sink without a copy. */
static celspan_status render_alone(celspan_context *context, const cs_frame *frame, delivery *d) {
  cs_row_worker row_worker;
  celspan_status status = cs_row_worker_init(&row_worker, context, frame);
  status = status == CELSPAN_OK ? deliver_rows(&row_worker, frame, d)
                                : cs_fail(context, status, "%s", row_worker.context.error);
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
  return render_together(context, frame, &d);
}
