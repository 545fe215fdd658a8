#include "film/frame_pipeline.h"

#include <pthread.h>
#include <signal.h>
#include <string.h>

#include "base/wait.h"
#include "render/frame.h"

enum {
  AHEAD = 2,        /* frames a worker that are built or made, and not yet finished */
  SHARE_ONE = 65536 /* a whole frame, in the shares of turns */
};

typedef struct run run;

struct cs_frame_pipeline_turn {
  run *run;
  size_t index;
  bool is_here; /* made by the calling thread */
  atomic_int share;
};

/* Where a frame is kept from its building to its end; all but the turn's share is written under the
 * run's lock once workers may see it. */
typedef struct slot {
  void *frame;
  cs_frame_pipeline_turn turn;
  cs_frame_pipeline_step step;
  bool is_done;
  celspan_status status;
  char error[sizeof((celspan_context *)0)->error];
} slot;

struct run {
  celspan_context *context;
  const cs_frame_pipeline *pipeline;
  int workers, thread_count;
  pthread_t *threads;
  slot *slots; /* a ring: frame i lies at i % slot_count */
  size_t slot_count;
  size_t built, claimed, finished;
  atomic_size_t end; /* frames from here on are not wanted any more */
  bool is_over;
  pthread_mutex_t lock;
  pthread_cond_t work, done;
};

static slot *slot_of(run *r, size_t index) { return &r->slots[index % r->slot_count]; }

/* ---------------------------------------------------------------- progress */

static void end_at(run *r, size_t index) {
  size_t end = atomic_load(&r->end);
  while (index < end && !atomic_compare_exchange_weak(&r->end, &end, index)) {
  }
}

/* Frames are built and finished by this thread, so it knows which are on their way. */
static bool tick(run *r) {
  if (!r->pipeline->tick)
    return true;
  double share = 0;
  for (size_t i = r->finished; i < r->built + 1 && i < r->finished + r->slot_count; i++)
    share += (double)atomic_load(&slot_of(r, i)->turn.share) / SHARE_ONE;
  return r->pipeline->tick(r->pipeline->user, share);
}

bool cs_frame_pipeline_progress(void *user, int32_t rows_done, int32_t rows_total) {
  cs_frame_pipeline_turn *turn = user;
  atomic_store(&turn->share, (int)((int64_t)rows_done * SHARE_ONE / (rows_total ? rows_total : 1)));
  if (turn->is_here && !tick(turn->run))
    end_at(turn->run, 0);
  return turn->index < atomic_load(&turn->run->end);
}

/* ---------------------------------------------------------------- making */

/* As many workers go on as there are frames left for them; the last frames get more than one. */
static int workers_of(const run *r, size_t index) {
  size_t left = r->pipeline->count - index;
  return left < (size_t)r->workers ? (int)((size_t)r->workers / left) : 1;
}

static celspan_status make(run *r, celspan_context *context, slot *s, int workers) {
  celspan_status status =
      r->pipeline->make(r->pipeline->user, context, s->frame, workers, &s->turn);
  if (status == CELSPAN_OK)
    atomic_store(&s->turn.share, SHARE_ONE);
  else
    memcpy(s->error, context->error, sizeof s->error);
  return status;
}

/* The lock is held. */
static void set_done(run *r, slot *s, celspan_status status) {
  s->status = status;
  s->is_done = true;
  if (status != CELSPAN_OK && !r->pipeline->keeps_going)
    end_at(r, s->turn.index + 1);
  pthread_cond_signal(&r->done);
}

/* The next frame for a worker, or NULL; the lock is held. */
static slot *claim(run *r) {
  while (r->claimed < r->built) {
    slot *s = slot_of(r, r->claimed++);
    if (s->step == CS_FRAME_PIPELINE_ANYWHERE && !s->is_done &&
        s->turn.index < atomic_load(&r->end))
      return s;
  }
  return NULL;
}

static void *worker_main(void *argument) {
  run *r = argument;
  celspan_context own;
  cs_context_branch(&own, r->context);
  pthread_mutex_lock(&r->lock);
  while (!r->is_over) {
    slot *s = claim(r);
    if (!s) {
      pthread_cond_wait(&r->work, &r->lock);
      continue;
    }
    pthread_mutex_unlock(&r->lock);
    celspan_status status = make(r, &own, s, workers_of(r, s->turn.index));
    pthread_mutex_lock(&r->lock);
    set_done(r, s, status);
  }
  pthread_mutex_unlock(&r->lock);
  return NULL;
}

/* ---------------------------------------------------------------- the calling thread */

static void make_here(run *r, slot *s) {
  s->turn.is_here = true;
  celspan_status status = make(r, r->context, s, r->workers);
  pthread_mutex_lock(&r->lock);
  set_done(r, s, status);
  pthread_mutex_unlock(&r->lock);
}

/* What workers see of the slot is all there before `built` counts it. */
static void build_next(run *r) {
  const cs_frame_pipeline *pipeline = r->pipeline;
  slot *s = slot_of(r, r->built);
  memset(s->frame, 0, pipeline->frame_size);
  s->turn.run = r;
  s->turn.index = r->built;
  s->turn.is_here = s->is_done = false;
  s->step = CS_FRAME_PIPELINE_ANYWHERE;
  atomic_store(&s->turn.share, 0);
  celspan_status status = pipeline->build(pipeline->user, r->built, s->frame, &s->step);
  if (status == CELSPAN_OK && s->step == CS_FRAME_PIPELINE_ANYWHERE && r->thread_count == 0)
    s->step = CS_FRAME_PIPELINE_HERE;
  if (status != CELSPAN_OK)
    memcpy(s->error, r->context->error, sizeof s->error);
  if (status == CELSPAN_OK && s->step == CS_FRAME_PIPELINE_HERE)
    make_here(r, s);
  pthread_mutex_lock(&r->lock);
  if (status != CELSPAN_OK || s->step == CS_FRAME_PIPELINE_NOTHING)
    set_done(r, s, status);
  r->built++;
  pthread_cond_signal(&r->work);
  pthread_mutex_unlock(&r->lock);
}

static celspan_status stop(run *r) {
  end_at(r, 0);
  return cs_fail(r->context, CELSPAN_CANCELLED, "stopped after %zu of %zu frames", r->finished,
                 r->pipeline->count);
}

static celspan_status tick_or_stop(run *r) { return tick(r) ? CELSPAN_OK : stop(r); }

static celspan_status finish_first(run *r, slot *s) {
  if (s->status != CELSPAN_OK)
    memcpy(r->context->error, s->error, sizeof s->error);
  celspan_status status = r->pipeline->finish(r->pipeline->user, s->frame, s->status);
  r->pipeline->release(r->pipeline->user, s->frame);
  atomic_store(&s->turn.share, 0);
  pthread_mutex_lock(&r->lock);
  r->finished++;
  if (r->claimed < r->finished) /* its slot will hold another frame */
    r->claimed = r->finished;
  pthread_mutex_unlock(&r->lock);
  return status == CELSPAN_OK ? tick_or_stop(r) : status;
}

static bool is_done(run *r, slot *s) {
  pthread_mutex_lock(&r->lock);
  bool answer = s->is_done;
  pthread_mutex_unlock(&r->lock);
  return answer;
}

static celspan_status wait_for(run *r, slot *s) {
  pthread_mutex_lock(&r->lock);
  bool is_news = s->is_done || cs_wait_moment(&r->done, &r->lock);
  pthread_mutex_unlock(&r->lock);
  return is_news ? CELSPAN_OK : tick_or_stop(r);
}

static bool can_build(run *r) {
  return r->built < atomic_load(&r->end) && r->built - r->finished < r->slot_count;
}

static celspan_status go_on(run *r) {
  slot *first = slot_of(r, r->finished);
  bool is_built = r->finished < r->built;
  if (is_built && !is_done(r, first) && first->step == CS_FRAME_PIPELINE_IN_TURN)
    make_here(r, first);
  if (is_built && is_done(r, first))
    return finish_first(r, first);
  if (!can_build(r))
    return is_built ? wait_for(r, first) : stop(r);
  build_next(r);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- life */

static int count_threads(const run *r) {
  size_t count = r->pipeline->count;
  if (r->workers < 2 || count < 2)
    return 0;
  return count < (size_t)r->workers ? (int)count : r->workers;
}

static celspan_status make_slots(run *r) {
  cs_memory *memory = r->context->memory;
  r->slots = cs_mem_array(memory, r->slot_count, sizeof *r->slots);
  for (size_t i = 0; r->slots && i < r->slot_count; i++) {
    r->slots[i].frame = cs_mem_array(memory, 1, r->pipeline->frame_size);
    if (!r->slots[i].frame)
      return cs_fail_memory(r->context);
  }
  return r->slots ? CELSPAN_OK : cs_fail_memory(r->context);
}

static void free_slots(run *r) {
  cs_memory *memory = r->context->memory;
  for (size_t i = 0; r->slots && i < r->slot_count; i++)
    cs_mem_free(memory, r->slots[i].frame, r->pipeline->frame_size);
  cs_mem_free(memory, r->slots, r->slot_count * sizeof *r->slots);
}

/* Signals stay with the calling thread. Fewer threads than wanted make the same frames. */
static int start_threads(run *r, int wanted) {
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  int started = 0;
  while (started < wanted && pthread_create(&r->threads[started], NULL, worker_main, r) == 0)
    started++;
  pthread_sigmask(SIG_SETMASK, &before, NULL);
  return started;
}

static void stop_threads(run *r) {
  pthread_mutex_lock(&r->lock);
  r->is_over = true;
  pthread_cond_broadcast(&r->work);
  pthread_mutex_unlock(&r->lock);
  while (r->thread_count > 0)
    pthread_join(r->threads[--r->thread_count], NULL);
}

static void init_locks(run *r) {
  pthread_mutex_init(&r->lock, NULL);
  pthread_cond_init(&r->work, NULL);
  cs_wait_init(&r->done);
}

static void finish_locks(run *r) {
  pthread_cond_destroy(&r->done);
  pthread_cond_destroy(&r->work);
  pthread_mutex_destroy(&r->lock);
}

static celspan_status run_frames(run *r) {
  celspan_status status = CELSPAN_OK;
  r->thread_count = start_threads(r, r->thread_count);
  while (status == CELSPAN_OK && r->finished < r->pipeline->count)
    status = go_on(r);
  end_at(r, 0);
  stop_threads(r);
  for (; r->finished < r->built; r->finished++)
    r->pipeline->release(r->pipeline->user, slot_of(r, r->finished)->frame);
  return status;
}

celspan_status cs_frame_pipeline_run(celspan_context *context, const cs_frame_pipeline *pipeline) {
  run r = {
      .context = context, .pipeline = pipeline, .workers = cs_frame_workers(pipeline->workers)};
  int wanted = count_threads(&r);
  r.thread_count = wanted;
  r.slot_count = wanted ? (size_t)wanted * AHEAD + 1 : 1;
  atomic_init(&r.end, pipeline->count);
  init_locks(&r);
  r.threads = cs_mem_array(context->memory, (size_t)wanted, sizeof *r.threads);
  celspan_status status = wanted && !r.threads ? cs_fail_memory(context) : make_slots(&r);
  if (status == CELSPAN_OK)
    status = run_frames(&r);
  free_slots(&r);
  cs_mem_free(context->memory, r.threads, (size_t)wanted * sizeof *r.threads);
  finish_locks(&r);
  return status;
}
