#include "base/thread_pool.h"

#include <signal.h>
#include <stdatomic.h>

#define THREADS_MOST 64

/* Signals that a thread raises itself, by a fault: blocked, they would end the process without the
 * host's handler, or a sanitizer, having been called. */
static const int faults[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTRAP, SIGSYS};

/* ---------------------------------------------------------------- threads */

static void *thread_main(void *argument) {
  const cs_thread *thread = argument;
  thread->run(thread->user, thread->worker);
  return NULL;
}

int cs_threads_start(cs_thread *threads, int wanted, void (*run)(void *user, int worker),
                     void *user) {
  sigset_t all, before;
  int started = 0;
  if (wanted < 1)
    return 0;
  sigfillset(&all);
  for (size_t i = 0; i < sizeof faults / sizeof *faults; i++)
    sigdelset(&all, faults[i]);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  for (; started < wanted; started++) {
    cs_thread *thread = &threads[started];
    *thread = (cs_thread){.run = run, .user = user, .worker = started + 1};
    if (pthread_create(&thread->id, NULL, thread_main, thread) != 0)
      break;
  }
  pthread_sigmask(SIG_SETMASK, &before, NULL);
  return started;
}

void cs_threads_join(cs_thread *threads, int count) {
  while (count > 0)
    pthread_join(threads[--count].id, NULL);
}

/* ---------------------------------------------------------------- fork and join */

typedef struct job {
  void (*step)(void *user, int worker, int32_t i);
  void *user;
  int32_t count;
  atomic_int_least32_t next;
} job;

static void work(void *user, int worker) {
  job *j = user;
  for (int32_t i; (i = atomic_fetch_add(&j->next, 1)) < j->count;)
    j->step(j->user, worker, i);
}

void cs_thread_pool_run(int workers, int32_t count, void (*step)(void *user, int worker, int32_t i),
                        void *user) {
  job j = {.step = step, .user = user, .count = count};
  cs_thread threads[THREADS_MOST];
  int wanted = (workers < count ? workers : (int)count) - 1;
  int started = cs_threads_start(threads, wanted < THREADS_MOST ? wanted : THREADS_MOST, work, &j);
  work(&j, 0);
  cs_threads_join(threads, started);
}
