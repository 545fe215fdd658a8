#include "base/pipeline.h"

#include <string.h>
#include <time.h>

#include "base/arrays.h"
#include "base/thread_pool.h"

enum { MOMENT = 100000000, SECOND = 1000000000 }; /* nanoseconds */

typedef struct slot {
  cs_pipeline_step step;
  bool is_done;
  celspan_status status;
  char error[CS_ERROR_SIZE]; /* set unless the status is OK */
} slot;

struct cs_pipeline {
  cs_memory *memory;
  cs_pipeline_desc desc;
  CS_ARRAY(slot, slots);
  CS_ARRAY(celspan_context, contexts); /* one for each thread */
  CS_ARRAY(cs_thread, threads);
  int thread_count;        /* started */
  cs_account_kind account; /* the account of the owner */
  pthread_mutex_t lock;
  pthread_cond_t added_some, done_some;
  size_t added, claimed, delivered;
  atomic_size_t end;
  bool is_over;
};

/* ---------------------------------------------------------------- cursors */

void cs_pipeline_end_at(cs_pipeline *p, size_t item) {
  size_t end = atomic_load(&p->end);
  while (item < end && !atomic_compare_exchange_weak(&p->end, &end, item)) {
  }
}

bool cs_pipeline_is_wanted(const cs_pipeline *p, size_t item) {
  return item < atomic_load(&p->end);
}

int cs_pipeline_threads(const cs_pipeline *p) { return p->thread_count; }

/* Only the owner moves these cursors, so it may read them without the lock. */
bool cs_pipeline_has_room(const cs_pipeline *p) {
  return cs_pipeline_is_wanted(p, p->added) && p->added - p->delivered < p->desc.slots;
}

static slot *slot_of(const cs_pipeline *p, size_t item) { return &p->slots[item % p->desc.slots]; }

/* ---------------------------------------------------------------- making (under the lock) */

/* The next item that any worker may make; false if there is none. */
static bool claim(cs_pipeline *p, size_t *item) {
  while (p->claimed < p->added) {
    const slot *s = slot_of(p, p->claimed);
    *item = p->claimed++;
    if (s->step == CS_PIPELINE_ANYWHERE && !s->is_done && cs_pipeline_is_wanted(p, *item))
      return true;
  }
  return false;
}

static void set_done(cs_pipeline *p, const celspan_context *context, size_t item,
                     celspan_status status) {
  slot *s = slot_of(p, item);
  s->status = status;
  if (status != CELSPAN_OK)
    memcpy(s->error, context->error, sizeof s->error);
  s->is_done = true;
  if (status != CELSPAN_OK && !p->desc.keeps_going)
    cs_pipeline_end_at(p, item + 1);
}

/* Releases the lock while the item is being made. */
static void make(cs_pipeline *p, celspan_context *context, int worker, size_t item) {
  pthread_mutex_unlock(&p->lock);
  celspan_status status = p->desc.make(p->desc.user, context, worker, item);
  pthread_mutex_lock(&p->lock);
  set_done(p, context, item, status);
  if (worker == 0)
    return;
  pthread_cond_signal(&p->done_some);
  if (p->desc.tell)
    p->desc.tell(p->desc.user);
}

static void run_worker(void *user, int worker) {
  cs_pipeline *p = user;
  size_t item;
  cs_account_set(p->memory, p->account);
  pthread_mutex_lock(&p->lock);
  while (!p->is_over) {
    if (claim(p, &item))
      make(p, &p->contexts[worker - 1], worker, item);
    else
      pthread_cond_wait(&p->added_some, &p->lock);
  }
  pthread_mutex_unlock(&p->lock);
}

/* ---------------------------------------------------------------- the owner */

void cs_pipeline_add(cs_pipeline *p, celspan_context *context, cs_pipeline_step step,
                     celspan_status status) {
  pthread_mutex_lock(&p->lock);
  size_t item = p->added++;
  slot *s = slot_of(p, item);
  s->step = step;
  s->is_done = false;
  if (status != CELSPAN_OK || step == CS_PIPELINE_NOTHING)
    set_done(p, context, item, status);
  else if (step == CS_PIPELINE_HERE)
    make(p, context, 0, item);
  else
    pthread_cond_signal(&p->added_some);
  pthread_mutex_unlock(&p->lock);
}

static bool is_ready(const cs_pipeline *p) {
  const slot *first = slot_of(p, p->delivered);
  return p->delivered < p->added && (first->is_done || first->step == CS_PIPELINE_IN_ORDER);
}

bool cs_pipeline_is_ready(cs_pipeline *p) {
  pthread_mutex_lock(&p->lock);
  bool answer = is_ready(p);
  pthread_mutex_unlock(&p->lock);
  return answer;
}

/* Returns false if nothing has changed after a short time. */
static bool wait_for_news(cs_pipeline *p) {
  struct timespec until;
  if (!p->desc.idle)
    return pthread_cond_wait(&p->done_some, &p->lock) == 0;
  clock_gettime(CLOCK_MONOTONIC, &until);
  until.tv_nsec += MOMENT;
  until.tv_sec += until.tv_nsec / SECOND;
  until.tv_nsec %= SECOND;
  return pthread_cond_timedwait(&p->done_some, &p->lock, &until) == 0;
}

/* Called while the first item is not complete: makes this item or another one, or waits. */
static celspan_status work_or_wait(cs_pipeline *p, celspan_context *context) {
  size_t item = p->delivered;
  if (is_ready(p) || (p->desc.owner_claims && claim(p, &item))) {
    make(p, context, 0, item);
    return CELSPAN_OK;
  }
  if (wait_for_news(p))
    return CELSPAN_OK;
  pthread_mutex_unlock(&p->lock);
  celspan_status status = p->desc.idle(p->desc.user, context);
  pthread_mutex_lock(&p->lock);
  return status;
}

static celspan_status deliver_first(cs_pipeline *p, celspan_context *context) {
  const slot *first = slot_of(p, p->delivered);
  pthread_mutex_unlock(&p->lock);
  if (first->status != CELSPAN_OK)
    memcpy(context->error, first->error, sizeof first->error);
  celspan_status status = p->desc.deliver(p->desc.user, context, p->delivered, first->status);
  pthread_mutex_lock(&p->lock);
  if (status != CELSPAN_OK)
    return status;
  p->delivered++;
  if (p->claimed < p->delivered) /* nobody claims items that the owner has already made */
    p->claimed = p->delivered;
  return CELSPAN_OK;
}

celspan_status cs_pipeline_deliver(cs_pipeline *p, celspan_context *context, size_t left) {
  celspan_status status = CELSPAN_OK;
  pthread_mutex_lock(&p->lock);
  while (status == CELSPAN_OK && p->added - p->delivered > left)
    status =
        slot_of(p, p->delivered)->is_done ? deliver_first(p, context) : work_or_wait(p, context);
  pthread_mutex_unlock(&p->lock);
  return status;
}

/* ---------------------------------------------------------------- life */

static void init_locks(cs_pipeline *p) {
  pthread_condattr_t monotonic;
  pthread_condattr_init(&monotonic);
  pthread_condattr_setclock(&monotonic, CLOCK_MONOTONIC);
  pthread_mutex_init(&p->lock, NULL);
  pthread_cond_init(&p->added_some, NULL);
  pthread_cond_init(&p->done_some, &monotonic);
  pthread_condattr_destroy(&monotonic);
}

static celspan_status allocate(celspan_context *context, cs_pipeline *p) {
  size_t threads = (size_t)p->desc.threads;
  CS_TRY(CS_ARRAY_MAKE(context, p->slots, p->desc.slots));
  CS_TRY(CS_ARRAY_MAKE(context, p->contexts, threads));
  return CS_ARRAY_MAKE(context, p->threads, threads);
}

celspan_status cs_pipeline_create(celspan_context *context, const cs_pipeline_desc *desc,
                                  cs_pipeline **out) {
  cs_pipeline *p;
  CS_TRY(CS_MAKE(context, p, 1));
  p->memory = context->memory;
  p->account = cs_account_of(context->memory);
  p->desc = *desc;
  atomic_init(&p->end, desc->count);
  init_locks(p);
  celspan_status status = allocate(context, p);
  if (status != CELSPAN_OK) {
    cs_pipeline_destroy(p);
    return status;
  }
  for (int i = 0; i < desc->threads; i++)
    cs_context_branch(&p->contexts[i], context);
  p->thread_count = cs_threads_start(p->threads, desc->threads, run_worker, p);
  *out = p;
  return CELSPAN_OK;
}

void cs_pipeline_destroy(cs_pipeline *p) {
  if (!p)
    return;
  cs_pipeline_end_at(p, 0);
  pthread_mutex_lock(&p->lock);
  p->is_over = true;
  pthread_cond_broadcast(&p->added_some);
  pthread_mutex_unlock(&p->lock);
  cs_threads_join(p->threads, p->thread_count);
  CS_ARRAYS_FREE(p->memory, p, slots, threads);
  pthread_cond_destroy(&p->done_some);
  pthread_cond_destroy(&p->added_some);
  pthread_mutex_destroy(&p->lock);
  cs_mem_free(p->memory, p, sizeof *p);
}
