#include "frames/film/frame_pipeline.h"

#include <string.h>

#include "frames/render/frame.h"

enum {
  AHEAD = 2,        /* frames for each worker that are built or made, and not yet finished */
  SHARE_ONE = 65536 /* a whole frame, in the shares of frames */
};

typedef struct run run;

/* Where a frame is kept from its building to its end. */
struct cs_frame_pipeline_frame {
  run *run;
  size_t index;
  void *carried;
  bool is_here;     /* the calling thread makes it */
  atomic_int share; /* the share of the frame that is made */
};

struct run {
  celspan_context *context;
  const cs_frame_pipeline *desc;
  cs_pipeline *pipeline;
  int workers;
  cs_frame_pipeline_frame *ring; /* frame i lies at i % ring_size */
  size_t ring_size;
  size_t built, finished; /* frames; counted by the calling thread */
};

static cs_frame_pipeline_frame *frame_of(const run *r, size_t index) {
  return &r->ring[index % r->ring_size];
}

/* ---------------------------------------------------------------- progress */

static bool tick(const run *r) {
  if (!r->desc->tick)
    return true;
  double share = 0;
  for (size_t i = r->finished; i < r->built; i++)
    share += (double)atomic_load(&frame_of(r, i)->share) / SHARE_ONE;
  return r->desc->tick(r->desc->user, share);
}

bool cs_frame_pipeline_progress(void *user, int32_t rows_done, int32_t rows_total) {
  cs_frame_pipeline_frame *frame = user;
  const run *r = frame->run;
  atomic_store(&frame->share,
               (int)((int64_t)rows_done * SHARE_ONE / (rows_total ? rows_total : 1)));
  if (frame->is_here && !tick(r))
    cs_pipeline_end_at(r->pipeline, 0);
  return cs_pipeline_is_wanted(r->pipeline, frame->index);
}

static celspan_status stop(run *r) {
  cs_pipeline_end_at(r->pipeline, 0);
  return cs_fail(r->context, CELSPAN_CANCELLED, "stopped after %zu of %zu frames", r->finished,
                 r->desc->count);
}

/* Nobody is asked again after a frame of the calling thread was asked to stop: then no frame is
 * wanted. After a failure, the frames before the failed one are still wanted. */
static celspan_status tick_or_stop(run *r) {
  return cs_pipeline_is_wanted(r->pipeline, 0) && tick(r) ? CELSPAN_OK : stop(r);
}

/* ---------------------------------------------------------------- one frame */

/* While enough frames are left, each worker makes one; the last frames get several workers each. */
static int workers_of(const run *r, size_t index) {
  size_t left = r->desc->count - index;
  return left < (size_t)r->workers ? (int)((size_t)r->workers / left) : 1;
}

static celspan_status make(void *user, celspan_context *context, int worker, size_t item) {
  const run *r = user;
  cs_frame_pipeline_frame *frame = frame_of(r, item);
  frame->is_here = worker == 0;
  celspan_status status = r->desc->make(r->desc->user, context, frame->carried,
                                        worker == 0 ? r->workers : workers_of(r, item), frame);
  if (status == CELSPAN_OK)
    atomic_store(&frame->share, SHARE_ONE);
  return status;
}

/* Without other threads a frame is made before the next one is built. */
static void build_next(run *r) {
  const cs_frame_pipeline *desc = r->desc;
  size_t index = r->built++;
  cs_frame_pipeline_frame *frame = frame_of(r, index);
  cs_pipeline_step step = CS_PIPELINE_ANYWHERE;
  memset(frame->carried, 0, desc->frame_size);
  frame->run = r;
  frame->index = index;
  atomic_store(&frame->share, 0);
  celspan_status status = desc->build(desc->user, index, frame->carried, &step);
  if (step == CS_PIPELINE_ANYWHERE && cs_pipeline_threads(r->pipeline) == 0)
    step = CS_PIPELINE_HERE;
  cs_pipeline_add(r->pipeline, r->context, step, status);
}

static celspan_status finish(void *user, celspan_context *context, size_t item,
                             celspan_status status) {
  run *r = user;
  cs_frame_pipeline_frame *frame = frame_of(r, item);
  (void)context;
  status = r->desc->finish(r->desc->user, frame->carried, status);
  r->desc->release(r->desc->user, frame->carried);
  r->finished++;
  return status == CELSPAN_OK ? tick_or_stop(r) : status;
}

static celspan_status tick_idle(void *user, celspan_context *context) {
  (void)context;
  return tick_or_stop(user);
}

/* ---------------------------------------------------------------- all frames */

/* Finishes the next frame if it is made; otherwise builds a frame if there is room; otherwise
 * waits. */
static celspan_status go_on(run *r) {
  size_t waiting = r->built - r->finished;
  if (!cs_pipeline_is_ready(r->pipeline) && cs_pipeline_has_room(r->pipeline))
    build_next(r);
  else if (waiting > 0)
    return cs_pipeline_deliver(r->pipeline, r->context, waiting - 1);
  else
    return stop(r);
  return CELSPAN_OK;
}

static celspan_status run_frames(run *r) {
  celspan_status status = CELSPAN_OK;
  while (status == CELSPAN_OK && r->finished < r->desc->count)
    status = go_on(r);
  return status;
}

static int count_threads(const run *r) {
  size_t count = r->desc->count;
  if (r->workers < 2 || count < 2 || r->desc->slots == 1)
    return 0;
  return count < (size_t)r->workers ? (int)count : r->workers;
}

static size_t size_ring(const run *r, int threads) {
  size_t size = threads ? (size_t)threads * AHEAD + 1 : 1, slots = r->desc->slots;
  return slots && slots < size ? slots : size;
}

static celspan_status make_ring(run *r) {
  cs_memory *memory = r->context->memory;
  r->ring = cs_mem_array(memory, r->ring_size, sizeof *r->ring);
  for (size_t i = 0; r->ring && i < r->ring_size; i++) {
    r->ring[i].carried = cs_mem_array(memory, 1, r->desc->frame_size);
    if (!r->ring[i].carried)
      return cs_fail_memory(r->context);
  }
  return r->ring ? CELSPAN_OK : cs_fail_memory(r->context);
}

static void free_ring(run *r) {
  cs_memory *memory = r->context->memory;
  for (; r->finished < r->built; r->finished++)
    r->desc->release(r->desc->user, frame_of(r, r->finished)->carried);
  for (size_t i = 0; r->ring && i < r->ring_size; i++)
    cs_mem_free(memory, r->ring[i].carried, r->desc->frame_size);
  cs_mem_free(memory, r->ring, r->ring_size * sizeof *r->ring);
}

celspan_status cs_frame_pipeline_run(celspan_context *context, const cs_frame_pipeline *pipeline) {
  run r = {.context = context,
           .desc = pipeline,
           .workers = cs_frame_workers(context, pipeline->workers)};
  int threads = count_threads(&r);
  r.ring_size = size_ring(&r, threads);
  const cs_pipeline_desc desc = {.count = pipeline->count,
                                 .slots = r.ring_size,
                                 .threads = threads,
                                 .keeps_going = pipeline->keeps_going,
                                 .user = &r,
                                 .make = make,
                                 .deliver = finish,
                                 .idle = tick_idle};
  celspan_status status = make_ring(&r);
  if (status == CELSPAN_OK)
    status = cs_pipeline_create(context, &desc, &r.pipeline);
  if (status == CELSPAN_OK)
    status = run_frames(&r);
  cs_pipeline_destroy(r.pipeline);
  free_ring(&r);
  return status;
}
