#include "base/thread_pool.h"

#include <pthread.h>
#include <stdatomic.h>

#define THREADS_MOST 64

typedef struct crew {
  void (*step)(void *user, int32_t i);
  void *user;
  int32_t count;
  atomic_int_least32_t next;
} crew;

static void *work(void *user) {
  crew *c = user;
  for (int32_t i; (i = atomic_fetch_add(&c->next, 1)) < c->count;)
    c->step(c->user, i);
  return NULL;
}

void cs_thread_pool_run(int workers, int32_t count, void (*step)(void *user, int32_t i),
                        void *user) {
  crew c = {.step = step, .user = user, .count = count};
  pthread_t threads[THREADS_MOST];
  int wanted = (workers < count ? workers : count) - 1, started = 0;
  while (started < wanted && started < THREADS_MOST &&
         pthread_create(&threads[started], NULL, work, &c) == 0)
    started++;
  work(&c);
  while (started > 0)
    pthread_join(threads[--started], NULL);
}
