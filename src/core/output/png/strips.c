#include "output/png/strips.h"

#include <string.h>

#include "base/pipeline.h"
#include "engine/span/row_queue.h"

enum {
  STRIP_PIXELS = 1 << 18, /* enough work for a separate thread */
  STRIP_ROWS = 64, /* the most rows of a strip, which may be reached because flat rows are short */
  STRIP_PIXELS_MOST = 1 << 20, /* spans of pictures need 16 bytes for each pixel */
  WORKERS_MOST = 64,
  AHEAD = 2 /* strips that are filled and not yet written, for each worker */
};

/* Bytes of the stream, in a buffer that grows. */
typedef struct buffer {
  unsigned char *bytes;
  size_t size, capacity;
} buffer;

typedef struct strip {
  cs_row_queue rows; /* including the row above, except in the first strip */
  buffer packed;
  cs_deflate_sum sum;
} strip;

typedef struct worker {
  celspan_context context; /* a branch */
  cs_png_strips *strips;
  cs_png_rows rows;
  cs_deflate *deflate;
  buffer *packed; /* where its stream is written now */
} worker;

struct cs_png_strips {
  cs_png_picture picture;
  cs_deflate_write write;
  void *user;
  int32_t strip_rows, total;
  int32_t row; /* the next row */
  cs_deflate_sum sum;
  int worker_count;
  worker *workers;       /* created with the first row */
  strip *ring;           /* strip i lies at i % ring_size */
  int32_t ring_size;     /* 1 if one worker writes without a pipeline */
  cs_pipeline *pipeline; /* NULL if there is one worker, or before the first row */
};

/* ---------------------------------------------------------------- one strip */

static celspan_status append(void *user, celspan_context *context, const void *bytes, size_t size) {
  buffer *packed = *(buffer **)user;
  CS_TRY(CS_RESERVE(context, packed->bytes, packed->capacity, packed->size + size));
  memcpy(packed->bytes + packed->size, bytes, size);
  packed->size += size;
  return CELSPAN_OK;
}

static celspan_status begin_strip(worker *w, int32_t index) {
  unsigned char header[CS_DEFLATE_HEADER];
  cs_deflate_begin(w->deflate);
  cs_png_rows_restart(&w->rows);
  if (index > 0)
    return CELSPAN_OK;
  cs_deflate_header(header);
  return append(&w->packed, &w->context, header, sizeof header);
}

static void empty(worker *w, buffer *packed) {
  packed->size = 0;
  w->packed = packed;
}

static celspan_status put_rows(worker *w, int32_t index, strip *s) {
  empty(w, &s->packed);
  CS_TRY(begin_strip(w, index));
  for (size_t i = 0; i < s->rows.count; i++) {
    cs_row_queue_row row = cs_row_queue_get(&s->rows, i);
    if (i == 0 && index > 0)
      CS_TRY(cs_png_rows_set_above(&w->rows, &w->context, row.spans, row.count));
    else
      CS_TRY(cs_png_rows_put(&w->rows, &w->context, row.spans, row.count, w->deflate));
  }
  return cs_deflate_end(w->deflate, &w->context, &s->sum);
}

/* Writes the packed bytes from `start` on, which belong to a strip. The last strip ends the
 * stream. */
static celspan_status write_strip(cs_png_strips *strips, celspan_context *context, int32_t index,
                                  cs_deflate_sum sum, buffer *packed, size_t start, size_t end) {
  unsigned char trailer[CS_DEFLATE_TRAILER];
  strips->sum = cs_deflate_join(strips->sum, sum);
  if (index == strips->total - 1) {
    cs_deflate_trailer(strips->sum, trailer);
    CS_TRY(append(&packed, context, trailer, sizeof trailer));
    end = packed->size;
  }
  return strips->write(strips->user, context, packed->bytes + start, end - start);
}

static celspan_status write_whole(cs_png_strips *strips, celspan_context *context, int32_t index,
                                  strip *s) {
  return write_strip(strips, context, index, s->sum, &s->packed, 0, s->packed.size);
}

/* ---------------------------------------------------------------- one thread */

static int32_t row_of_strip(const cs_png_strips *strips) {
  return strips->row % strips->strip_rows;
}

static bool is_last_row(const cs_png_strips *strips, int32_t y) {
  return y % strips->strip_rows == strips->strip_rows - 1 || y == strips->picture.height - 1;
}

static bool ends_strip(const cs_png_strips *strips) { return is_last_row(strips, strips->row); }

static celspan_status report(celspan_context *context, celspan_status status, const char *error) {
  return status == CELSPAN_OK ? status : cs_fail(context, status, "%s", error);
}

static celspan_status pack_row(cs_png_strips *strips, const celspan_span *spans,
                               size_t span_count) {
  worker *w = strips->workers;
  strip *s = strips->ring;
  if (row_of_strip(strips) == 0) {
    empty(w, &s->packed);
    CS_TRY(begin_strip(w, strips->row / strips->strip_rows));
  }
  CS_TRY(cs_png_rows_put(&w->rows, &w->context, spans, span_count, w->deflate));
  return ends_strip(strips) ? cs_deflate_end(w->deflate, &w->context, &s->sum) : CELSPAN_OK;
}

static celspan_status put_row_alone(cs_png_strips *strips, celspan_context *context,
                                    const celspan_span *spans, size_t span_count) {
  CS_TRY(report(context, pack_row(strips, spans, span_count), strips->workers->context.error));
  if (!ends_strip(strips))
    return CELSPAN_OK;
  return write_whole(strips, context, strips->row / strips->strip_rows, strips->ring);
}

/* ---------------------------------------------------------------- several threads */

static celspan_status pack_strip(void *user, celspan_context *context, int number, size_t item) {
  cs_png_strips *strips = user;
  worker *w = &strips->workers[number];
  celspan_status status =
      put_rows(w, (int32_t)item, &strips->ring[item % (size_t)strips->ring_size]);
  return report(context, status, w->context.error);
}

static celspan_status write_packed(void *user, celspan_context *context, size_t item,
                                   celspan_status status) {
  cs_png_strips *strips = user;
  CS_TRY(status);
  return write_whole(strips, context, (int32_t)item,
                     &strips->ring[item % (size_t)strips->ring_size]);
}

static celspan_status start_pipeline(cs_png_strips *strips, celspan_context *context) {
  const cs_pipeline_desc desc = {.count = (size_t)strips->total,
                                 .slots = (size_t)strips->ring_size,
                                 .threads = strips->worker_count - 1,
                                 .owner_claims = true,
                                 .user = strips,
                                 .make = pack_strip,
                                 .deliver = write_packed};
  return cs_pipeline_create(context, &desc, &strips->pipeline);
}

/* Passes the full strip to the workers and makes room for another one. */
static celspan_status pass_on(cs_png_strips *strips, celspan_context *context) {
  cs_pipeline_add(strips->pipeline, context, CS_PIPELINE_ANYWHERE, CELSPAN_OK);
  return cs_pipeline_deliver(strips->pipeline, context, (size_t)strips->ring_size - 1);
}

static strip *strip_of_row(const cs_png_strips *strips, int32_t y) {
  return &strips->ring[y / strips->strip_rows % strips->ring_size];
}

/* Begins a strip with the last row of the previous strip, which is not overwritten until the whole
 * ring has been used. */
static celspan_status begin_keeping(cs_png_strips *strips, celspan_context *context, strip *s) {
  cs_row_queue_clear(&s->rows);
  if (strips->row == 0)
    return CELSPAN_OK;
  const cs_row_queue *before = &strip_of_row(strips, strips->row - 1)->rows;
  cs_row_queue_row above = cs_row_queue_get(before, before->count - 1);
  return cs_row_queue_add(context, &s->rows, above.spans, above.count);
}

static celspan_status put_row_shared(cs_png_strips *strips, celspan_context *context,
                                     const celspan_span *spans, size_t span_count) {
  strip *s = strip_of_row(strips, strips->row);
  if (row_of_strip(strips) == 0)
    CS_TRY(begin_keeping(strips, context, s));
  CS_TRY(cs_row_queue_add(context, &s->rows, spans, span_count));
  return ends_strip(strips) ? pass_on(strips, context) : CELSPAN_OK;
}

/* ---------------------------------------------------------------- all strips */

static celspan_status init_strips(cs_png_strips *strips, celspan_context *context);

celspan_status cs_png_strips_row(cs_png_strips *strips, celspan_context *context,
                                 const celspan_span *spans, size_t span_count) {
  if (!strips->workers)
    CS_TRY(init_strips(strips, context));
  CS_TRY(strips->pipeline ? put_row_shared(strips, context, spans, span_count)
                          : put_row_alone(strips, context, spans, span_count));
  strips->row++;
  return CELSPAN_OK;
}

celspan_status cs_png_strips_finish(cs_png_strips *strips, celspan_context *context) {
  return strips->pipeline ? cs_pipeline_deliver(strips->pipeline, context, 0) : CELSPAN_OK;
}

static int32_t choose_strip_rows(int32_t width) {
  int32_t least = STRIP_PIXELS / width, most = STRIP_PIXELS_MOST / width;
  int32_t rows = most < STRIP_ROWS ? most : STRIP_ROWS;
  return least > rows ? least : rows > 1 ? rows : 1;
}

static int choose_workers(const cs_png_strips *strips, celspan_context *context) {
  int workers = cs_context_workers(context, strips->picture.workers, WORKERS_MOST);
  return workers < strips->total ? (int)workers : (int)strips->total;
}

static celspan_status init_worker(cs_png_strips *strips, celspan_context *context, worker *w) {
  cs_context_branch(&w->context, context);
  w->strips = strips;
  cs_png_rows_begin(&w->rows, strips->picture.coding, strips->picture.width,
                    strips->picture.is_opaque);
  w->rows.is_strip = strips->picture.is_strip;
  return report(context,
                cs_deflate_create(&w->context, w->rows.pixel_size, append, &w->packed, &w->deflate),
                w->context.error);
}

static celspan_status init_strips(cs_png_strips *strips, celspan_context *context) {
  CS_TRY(CS_MAKE(context, strips->workers, (size_t)strips->worker_count));
  CS_TRY(CS_MAKE(context, strips->ring, (size_t)strips->ring_size));
  for (int i = 0; i < strips->worker_count; i++)
    CS_TRY(init_worker(strips, context, &strips->workers[i]));
  return strips->worker_count > 1 ? start_pipeline(strips, context) : CELSPAN_OK;
}

celspan_status cs_png_strips_create(celspan_context *context, const cs_png_picture *picture,
                                    cs_deflate_write write, void *user, cs_png_strips **out) {
  cs_png_strips *strips;
  CS_TRY(CS_MAKE(context, strips, 1));
  strips->picture = *picture;
  strips->write = write;
  strips->user = user;
  strips->strip_rows = choose_strip_rows(picture->width);
  strips->total = (picture->height - 1) / strips->strip_rows + 1;
  strips->worker_count = choose_workers(strips, context);
  strips->ring_size = strips->worker_count > 1 ? AHEAD * strips->worker_count : 1;
  strips->sum = CS_DEFLATE_SUM_EMPTY;
  *out = strips;
  return CELSPAN_OK;
}

static void free_strip(strip *s, cs_memory *memory) {
  cs_row_queue_finish(&s->rows, memory);
  cs_mem_free(memory, s->packed.bytes, s->packed.capacity);
}

static void free_worker(worker *w, celspan_context *context) {
  cs_png_rows_end(&w->rows, context);
  cs_deflate_destroy(w->deflate, context);
}

void cs_png_strips_destroy(cs_png_strips *strips, celspan_context *context) {
  if (!strips)
    return;
  cs_memory *memory = context->memory;
  cs_pipeline_destroy(strips->pipeline);
  for (int i = 0; strips->workers && i < strips->worker_count; i++)
    free_worker(&strips->workers[i], context);
  for (int32_t i = 0; strips->workers && strips->ring && i < strips->ring_size; i++)
    free_strip(&strips->ring[i], memory);
  cs_mem_free(memory, strips->workers, (size_t)strips->worker_count * sizeof *strips->workers);
  cs_mem_free(memory, strips->ring, (size_t)strips->ring_size * sizeof *strips->ring);
  cs_mem_free(memory, strips, sizeof *strips);
}

/* ---------------------------------------------------------------- shares */

/* The number of strips in a share: so many that the row above it, which is made twice, costs
 * little. */
enum { SHARE_STRIPS = 4, SHARES_A_WORKER = 8 };

typedef struct share {
  buffer packed;
  int32_t first; /* strip */
  int32_t count; /* strips that have been packed */
  size_t ends[SHARE_STRIPS];
  cs_deflate_sum sums[SHARE_STRIPS];
} share;

typedef struct worker_state {
  worker worker;
  share *share;
} worker_state;

static int32_t share_strips(const cs_png_strips *strips) {
  int32_t count = strips->total / (strips->worker_count * SHARES_A_WORKER);
  return count < 1 ? 1 : count < SHARE_STRIPS ? count : SHARE_STRIPS;
}

static celspan_status open_share(void *user, celspan_context *context, void **out) {
  (void)user;
  *out = cs_mem_array(context->memory, 1, sizeof(share));
  return *out ? CELSPAN_OK : cs_fail_memory(context);
}

static void close_share(void *user, celspan_context *context, void *made) {
  share *p = made;
  (void)user;
  if (p)
    cs_mem_free(context->memory, p->packed.bytes, p->packed.capacity);
  cs_mem_free(context->memory, p, sizeof *p);
}

static void close_worker(void *user, celspan_context *context, void *made) {
  worker_state *state = made;
  (void)user;
  if (state)
    free_worker(&state->worker, context);
  cs_mem_free(context->memory, state, sizeof *state);
}

static celspan_status open_worker(void *user, celspan_context *context, void **out) {
  worker_state *state = cs_mem_array(context->memory, 1, sizeof *state);
  *out = state;
  return state ? init_worker(user, context, &state->worker) : cs_fail_memory(context);
}

static celspan_status begin_share(void *made, celspan_context *context, void *filled,
                                  int32_t index) {
  worker_state *state = made;
  state->share = filled;
  state->share->first = index * share_strips(state->worker.strips);
  state->share->count = 0;
  empty(&state->worker, &state->share->packed);
  return report(context, begin_strip(&state->worker, state->share->first),
                state->worker.context.error);
}

static celspan_status pack_share_row(worker_state *state, int32_t y, const celspan_span *spans,
                                     size_t span_count) {
  const cs_png_strips *strips = state->worker.strips;
  share *p = state->share;
  worker *w = &state->worker;
  if (y < p->first * strips->strip_rows)
    return cs_png_rows_set_above(&w->rows, &w->context, spans, span_count);
  if (y % strips->strip_rows == 0 && p->count > 0)
    CS_TRY(begin_strip(w, p->first + p->count));
  CS_TRY(cs_png_rows_put(&w->rows, &w->context, spans, span_count, w->deflate));
  if (!is_last_row(strips, y))
    return CELSPAN_OK;
  CS_TRY(cs_deflate_end(w->deflate, &w->context, &p->sums[p->count]));
  p->ends[p->count++] = p->packed.size;
  return CELSPAN_OK;
}

static celspan_status put_share_row(void *user, void *made, celspan_context *context, int32_t y,
                                    const celspan_span *spans, size_t span_count) {
  worker_state *state = made;
  (void)user;
  return report(context, pack_share_row(state, y, spans, span_count), state->worker.context.error);
}

static celspan_status join_share(void *user, celspan_context *context, void *made, int32_t index) {
  cs_png_strips *strips = user;
  share *p = made;
  (void)index;
  for (int32_t i = 0; i < p->count; i++)
    CS_TRY(write_strip(strips, context, p->first + i, p->sums[i], &p->packed,
                       i > 0 ? p->ends[i - 1] : 0, p->ends[i]));
  return CELSPAN_OK;
}

cs_shares cs_png_strips_shares(cs_png_strips *strips) {
  return (cs_shares){.user = strips,
                     .rows = share_strips(strips) * strips->strip_rows,
                     .takes_above = true,
                     CS_SHARES_CALLS};
}
