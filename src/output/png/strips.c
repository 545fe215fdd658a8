#include "output/png/strips.h"

#include <pthread.h>
#include <string.h>
#include <unistd.h>

#include "span/row_queue.h"

enum {
  STRIP_PIXELS = 1 << 18,      /* enough to be worth a thread's while */
  STRIP_ROWS = 64,             /* flat rows are short: take so many where that is not too much */
  STRIP_PIXELS_MOST = 1 << 20, /* spans of pictures are 16 bytes a pixel */
  WORKERS_MOST = 64,
  AHEAD = 2 /* strips in hand, a lane */
};

/* A part of the stream, as it grows. */
typedef struct part {
  unsigned char *bytes;
  size_t size, capacity;
} part;

typedef struct strip {
  cs_row_queue rows; /* with the one above, unless it is the first strip */
  bool is_done;
  celspan_status status;
  char error[sizeof((celspan_context *)0)->error];
  part packed;
  cs_deflate_sum sum;
} strip;

typedef struct lane {
  celspan_context context; /* a branch */
  cs_png_strips *strips;
  cs_png_rows rows;
  cs_deflate *deflate;
  part *packed; /* of the strip in hand */
  pthread_t thread;
} lane;

struct cs_png_strips {
  cs_png_picture picture;
  cs_deflate_write write;
  void *user;
  int32_t strip_rows, total;
  int32_t row; /* the next one */
  cs_deflate_sum sum;
  lane *lanes;             /* the first is the caller's, the others have threads */
  int lane_count, started; /* lanes: from the first row on */
  strip *ring;             /* strip i lies at i % ring_size */
  int32_t ring_size;
  pthread_mutex_t mutex;
  pthread_cond_t filled_some, done_some;
  int32_t filled, claimed, written; /* strips, in this order */
  bool is_stopped;
};

/* ---------------------------------------------------------------- one strip */

static celspan_status append(void *user, celspan_context *context, const void *bytes, size_t size) {
  part *packed = *(part **)user;
  CS_TRY(
      cs_mem_reserve(context, (void **)&packed->bytes, &packed->capacity, packed->size + size, 1));
  memcpy(packed->bytes + packed->size, bytes, size);
  packed->size += size;
  return CELSPAN_OK;
}

static celspan_status begin_strip(lane *l, int32_t index) {
  unsigned char header[CS_DEFLATE_HEADER];
  cs_deflate_begin(l->deflate);
  cs_png_rows_restart(&l->rows);
  if (index > 0)
    return CELSPAN_OK;
  cs_deflate_header(header);
  return append(&l->packed, &l->context, header, sizeof header);
}

static void empty(lane *l, part *packed) {
  packed->size = 0;
  l->packed = packed;
}

static celspan_status put_rows(lane *l, int32_t index, strip *s) {
  empty(l, &s->packed);
  CS_TRY(begin_strip(l, index));
  for (size_t i = 0; i < s->rows.count; i++) {
    cs_row_queue_row row = cs_row_queue_get(&s->rows, i);
    if (i == 0 && index > 0)
      CS_TRY(cs_png_rows_set_above(&l->rows, &l->context, row.spans, row.count));
    else
      CS_TRY(cs_png_rows_put(&l->rows, &l->context, row.spans, row.count, l->deflate));
  }
  return cs_deflate_end(l->deflate, &l->context, &s->sum);
}

static void pack_strip(lane *l, int32_t index, strip *s) {
  s->status = put_rows(l, index, s);
  if (s->status != CELSPAN_OK)
    memcpy(s->error, l->context.error, sizeof s->error);
}

/* Writes what was packed from `start` on: a strip's own. The last one ends the stream. */
static celspan_status write_strip(cs_png_strips *strips, celspan_context *context, int32_t index,
                                  cs_deflate_sum sum, part *packed, size_t start, size_t end) {
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
  lane *l = strips->lanes;
  strip *s = strips->ring;
  if (row_of_strip(strips) == 0) {
    empty(l, &s->packed);
    CS_TRY(begin_strip(l, strips->row / strips->strip_rows));
  }
  CS_TRY(cs_png_rows_put(&l->rows, &l->context, spans, span_count, l->deflate));
  return ends_strip(strips) ? cs_deflate_end(l->deflate, &l->context, &s->sum) : CELSPAN_OK;
}

static celspan_status put_row_alone(cs_png_strips *strips, celspan_context *context,
                                    const celspan_span *spans, size_t span_count) {
  CS_TRY(report(context, pack_row(strips, spans, span_count), strips->lanes->context.error));
  if (!ends_strip(strips))
    return CELSPAN_OK;
  return write_whole(strips, context, strips->row / strips->strip_rows, strips->ring);
}

/* ---------------------------------------------------------------- several threads */

/* The next strip to be packed, or -1; the mutex is held. */
static int32_t claim(cs_png_strips *strips) {
  return strips->is_stopped || strips->claimed == strips->filled ? -1 : strips->claimed++;
}

/* Packs a claimed strip with the mutex let go. */
static void work(lane *l, int32_t index) {
  cs_png_strips *strips = l->strips;
  strip *s = &strips->ring[index % strips->ring_size];
  pthread_mutex_unlock(&strips->mutex);
  pack_strip(l, index, s);
  pthread_mutex_lock(&strips->mutex);
  s->is_done = true;
  pthread_cond_signal(&strips->done_some);
}

static void *lane_main(void *argument) {
  lane *l = argument;
  cs_png_strips *strips = l->strips;
  pthread_mutex_lock(&strips->mutex);
  while (!strips->is_stopped) {
    int32_t index = claim(strips);
    if (index >= 0)
      work(l, index);
    else
      pthread_cond_wait(&strips->filled_some, &strips->mutex);
  }
  pthread_mutex_unlock(&strips->mutex);
  return NULL;
}

static void start_threads(cs_png_strips *strips) {
  for (strips->started = 1; strips->started < strips->lane_count; strips->started++) {
    lane *l = &strips->lanes[strips->started];
    if (pthread_create(&l->thread, NULL, lane_main, l) != 0)
      break; /* fewer threads make the same bytes */
  }
}

static void stop_threads(cs_png_strips *strips) {
  pthread_mutex_lock(&strips->mutex);
  strips->is_stopped = true;
  pthread_cond_broadcast(&strips->filled_some);
  pthread_mutex_unlock(&strips->mutex);
  for (; strips->started > 1; strips->started--)
    pthread_join(strips->lanes[strips->started - 1].thread, NULL);
}

/* Writes strips in order until no more than `left` wait, packing one itself where the next is not
 * done; the mutex is held, and let go while it writes. */
static celspan_status write_until(cs_png_strips *strips, celspan_context *context, int32_t left) {
  while (strips->filled - strips->written > left) {
    int32_t index = strips->written;
    strip *s = &strips->ring[index % strips->ring_size];
    if (s->is_done) {
      pthread_mutex_unlock(&strips->mutex);
      celspan_status status = report(context, s->status, s->error);
      if (status == CELSPAN_OK)
        status = write_whole(strips, context, index, s);
      pthread_mutex_lock(&strips->mutex);
      CS_TRY(status);
      strips->written++;
      continue;
    }
    int32_t own = claim(strips);
    if (own >= 0)
      work(strips->lanes, own);
    else
      pthread_cond_wait(&strips->done_some, &strips->mutex);
  }
  return CELSPAN_OK;
}

/* Hands the strip that is full to the threads and makes room for another. */
static celspan_status hand_over(cs_png_strips *strips, celspan_context *context) {
  pthread_mutex_lock(&strips->mutex);
  strips->filled++;
  pthread_cond_signal(&strips->filled_some);
  celspan_status status = write_until(strips, context, strips->ring_size - 1);
  pthread_mutex_unlock(&strips->mutex);
  return status;
}

/* With the last row of the strip before, which nobody overwrites until the ring comes round. */
static celspan_status begin_keeping(cs_png_strips *strips, celspan_context *context, strip *s) {
  cs_row_queue_clear(&s->rows);
  s->is_done = false;
  if (strips->filled == 0)
    return CELSPAN_OK;
  const cs_row_queue *before = &strips->ring[(strips->filled - 1) % strips->ring_size].rows;
  cs_row_queue_row above = cs_row_queue_get(before, before->count - 1);
  return cs_row_queue_add(context, &s->rows, above.spans, above.count);
}

static celspan_status put_row_shared(cs_png_strips *strips, celspan_context *context,
                                     const celspan_span *spans, size_t span_count) {
  strip *s = &strips->ring[strips->filled % strips->ring_size];
  if (row_of_strip(strips) == 0)
    CS_TRY(begin_keeping(strips, context, s));
  CS_TRY(cs_row_queue_add(context, &s->rows, spans, span_count));
  return ends_strip(strips) ? hand_over(strips, context) : CELSPAN_OK;
}

/* ---------------------------------------------------------------- all strips */

static celspan_status init_strips(cs_png_strips *strips, celspan_context *context);

celspan_status cs_png_strips_row(cs_png_strips *strips, celspan_context *context,
                                 const celspan_span *spans, size_t span_count) {
  if (!strips->lanes)
    CS_TRY(init_strips(strips, context));
  CS_TRY(strips->lane_count > 1 ? put_row_shared(strips, context, spans, span_count)
                                : put_row_alone(strips, context, spans, span_count));
  strips->row++;
  return CELSPAN_OK;
}

celspan_status cs_png_strips_finish(cs_png_strips *strips, celspan_context *context) {
  pthread_mutex_lock(&strips->mutex);
  celspan_status status = write_until(strips, context, 0);
  pthread_mutex_unlock(&strips->mutex);
  return status;
}

static int32_t choose_strip_rows(int32_t width) {
  int32_t least = STRIP_PIXELS / width, most = STRIP_PIXELS_MOST / width;
  int32_t rows = most < STRIP_ROWS ? most : STRIP_ROWS;
  return least > rows ? least : rows > 1 ? rows : 1;
}

static int choose_lanes(const cs_png_strips *strips) {
  int64_t lanes = strips->picture.workers;
  if (lanes <= 0)
    lanes = sysconf(_SC_NPROCESSORS_ONLN);
  lanes = lanes > WORKERS_MOST ? WORKERS_MOST : lanes < 1 ? 1 : lanes;
  return lanes < strips->total ? (int)lanes : (int)strips->total;
}

static celspan_status init_lane(cs_png_strips *strips, celspan_context *context, lane *l) {
  cs_context_branch(&l->context, context);
  l->strips = strips;
  cs_png_rows_begin(&l->rows, strips->picture.coding, strips->picture.width,
                    strips->picture.is_opaque);
  return report(context,
                cs_deflate_create(&l->context, l->rows.pixel_size, append, &l->packed, &l->deflate),
                l->context.error);
}

static celspan_status init_strips(cs_png_strips *strips, celspan_context *context) {
  strips->lanes = cs_mem_array(context->memory, (size_t)strips->lane_count, sizeof *strips->lanes);
  strips->ring = cs_mem_array(context->memory, (size_t)strips->ring_size, sizeof *strips->ring);
  if (!strips->lanes || !strips->ring)
    return cs_fail_memory(context);
  for (int i = 0; i < strips->lane_count; i++)
    CS_TRY(init_lane(strips, context, &strips->lanes[i]));
  start_threads(strips);
  return CELSPAN_OK;
}

celspan_status cs_png_strips_create(celspan_context *context, const cs_png_picture *picture,
                                    cs_deflate_write write, void *user, cs_png_strips **out) {
  cs_png_strips *strips = cs_mem_array(context->memory, 1, sizeof *strips);
  if (!strips)
    return cs_fail_memory(context);
  strips->picture = *picture;
  strips->write = write;
  strips->user = user;
  strips->strip_rows = choose_strip_rows(picture->width);
  strips->total = (picture->height - 1) / strips->strip_rows + 1;
  strips->lane_count = choose_lanes(strips);
  strips->ring_size = strips->lane_count > 1 ? AHEAD * strips->lane_count : 1;
  strips->sum = CS_DEFLATE_SUM_EMPTY;
  pthread_mutex_init(&strips->mutex, NULL);
  pthread_cond_init(&strips->filled_some, NULL);
  pthread_cond_init(&strips->done_some, NULL);
  *out = strips;
  return CELSPAN_OK;
}

static void free_strip(strip *s, cs_memory *memory) {
  cs_row_queue_finish(&s->rows, memory);
  cs_mem_free(memory, s->packed.bytes, s->packed.capacity);
}

static void free_lane(lane *l, celspan_context *context) {
  cs_png_rows_end(&l->rows, context);
  cs_deflate_destroy(l->deflate, context);
}

void cs_png_strips_destroy(cs_png_strips *strips, celspan_context *context) {
  if (!strips)
    return;
  cs_memory *memory = context->memory;
  stop_threads(strips);
  for (int i = 0; strips->lanes && i < strips->lane_count; i++)
    free_lane(&strips->lanes[i], context);
  for (int32_t i = 0; strips->lanes && strips->ring && i < strips->ring_size; i++)
    free_strip(&strips->ring[i], memory);
  cs_mem_free(memory, strips->lanes, (size_t)strips->lane_count * sizeof *strips->lanes);
  cs_mem_free(memory, strips->ring, (size_t)strips->ring_size * sizeof *strips->ring);
  pthread_cond_destroy(&strips->done_some);
  pthread_cond_destroy(&strips->filled_some);
  pthread_mutex_destroy(&strips->mutex);
  cs_mem_free(memory, strips, sizeof *strips);
}

/* ---------------------------------------------------------------- parts */

/* So many strips in a part that the row above it, which is made twice, counts for little. */
enum { PART_STRIPS = 4, PARTS_A_LANE = 8 };

typedef struct piece {
  part packed;
  int32_t first; /* strip */
  int32_t count; /* strips that are packed */
  size_t ends[PART_STRIPS];
  cs_deflate_sum sums[PART_STRIPS];
} piece;

typedef struct worker {
  lane lane;
  piece *piece;
} worker;

static int32_t part_strips(const cs_png_strips *strips) {
  int32_t share = strips->total / (strips->lane_count * PARTS_A_LANE);
  return share < 1 ? 1 : share < PART_STRIPS ? share : PART_STRIPS;
}

static celspan_status open_piece(void *user, celspan_context *context, void **out) {
  (void)user;
  *out = cs_mem_array(context->memory, 1, sizeof(piece));
  return *out ? CELSPAN_OK : cs_fail_memory(context);
}

static void close_piece(void *user, celspan_context *context, void *made) {
  piece *p = made;
  (void)user;
  if (p)
    cs_mem_free(context->memory, p->packed.bytes, p->packed.capacity);
  cs_mem_free(context->memory, p, sizeof *p);
}

static void close_worker(void *user, celspan_context *context, void *made) {
  worker *h = made;
  (void)user;
  if (h)
    free_lane(&h->lane, context);
  cs_mem_free(context->memory, h, sizeof *h);
}

static celspan_status open_worker(void *user, celspan_context *context, void **out) {
  worker *h = cs_mem_array(context->memory, 1, sizeof *h);
  *out = h;
  return h ? init_lane(user, context, &h->lane) : cs_fail_memory(context);
}

static celspan_status begin_piece(void *made, celspan_context *context, void *filled,
                                  int32_t index) {
  worker *h = made;
  h->piece = filled;
  h->piece->first = index * part_strips(h->lane.strips);
  h->piece->count = 0;
  empty(&h->lane, &h->piece->packed);
  return report(context, begin_strip(&h->lane, h->piece->first), h->lane.context.error);
}

static celspan_status pack_piece_row(worker *h, int32_t y, const celspan_span *spans,
                                     size_t span_count) {
  const cs_png_strips *strips = h->lane.strips;
  piece *p = h->piece;
  lane *l = &h->lane;
  if (y < p->first * strips->strip_rows)
    return cs_png_rows_set_above(&l->rows, &l->context, spans, span_count);
  if (y % strips->strip_rows == 0 && p->count > 0)
    CS_TRY(begin_strip(l, p->first + p->count));
  CS_TRY(cs_png_rows_put(&l->rows, &l->context, spans, span_count, l->deflate));
  if (!is_last_row(strips, y))
    return CELSPAN_OK;
  CS_TRY(cs_deflate_end(l->deflate, &l->context, &p->sums[p->count]));
  p->ends[p->count++] = p->packed.size;
  return CELSPAN_OK;
}

static celspan_status put_piece_row(void *user, void *made, celspan_context *context, int32_t y,
                                    const celspan_span *spans, size_t span_count) {
  worker *h = made;
  (void)user;
  return report(context, pack_piece_row(h, y, spans, span_count), h->lane.context.error);
}

static celspan_status join_piece(void *user, celspan_context *context, void *made, int32_t index) {
  cs_png_strips *strips = user;
  piece *p = made;
  (void)index;
  for (int32_t i = 0; i < p->count; i++)
    CS_TRY(write_strip(strips, context, p->first + i, p->sums[i], &p->packed,
                       i > 0 ? p->ends[i - 1] : 0, p->ends[i]));
  return CELSPAN_OK;
}

cs_shares cs_png_strips_shares(cs_png_strips *strips) {
  return (cs_shares){.user = strips,
                     .rows = part_strips(strips) * strips->strip_rows,
                     .takes_above = true,
                     .open_worker = open_worker,
                     .close_worker = close_worker,
                     .open_share = open_piece,
                     .close_share = close_piece,
                     .begin = begin_piece,
                     .row = put_piece_row,
                     .join = join_piece};
}
