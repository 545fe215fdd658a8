#include "base/thread_pool.h"

#include <signal.h>
#include <stdatomic.h>

#define THREADS_MOST 64
/* the usual limit of processes; only address space is reserved */
#define STACK_SIZE ((size_t)8 << 20)

/* Signals that a thread causes itself by a fault: if they were blocked, they would end the process
 * before the host's handler or a sanitizer is called. */
static const int faults[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTRAP, SIGSYS};

/* ---------------------------------------------------------------- threads */

static void *thread_main(void *argument) {
  const cs_thread *thread = argument;
  thread->run(thread->user, thread->worker);
  return NULL;
}

int cs_thread_create(pthread_t *id, void *(*run)(void *), void *user) {
  pthread_attr_t attributes;
  int error = pthread_attr_init(&attributes);
  if (error)
    return error;
  error = pthread_attr_setstacksize(&attributes, STACK_SIZE);
  if (!error)
    error = pthread_create(id, &attributes, run, user);
  pthread_attr_destroy(&attributes);
  return error;
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
    if (cs_thread_create(&thread->id, thread_main, thread) != 0)
      break;
  }
  pthread_sigmask(SIG_SETMASK, &before, NULL);
  return started;
}

void cs_threads_join(cs_thread *threads, int count) {
  while (count > 0)
    pthread_join(threads[--count].id, NULL);
}

static void pass(void *user, int worker) {
  pthread_mutex_t *gate = user;
  (void)worker;
  pthread_mutex_lock(gate);
  pthread_mutex_unlock(gate);
}

/* The threads wait for the gate, so that all of them exist at the same time. */
bool cs_threads_are_free(int wanted) {
  cs_thread threads[THREADS_MOST];
  pthread_mutex_t gate = PTHREAD_MUTEX_INITIALIZER;
  wanted = wanted < THREADS_MOST ? wanted : THREADS_MOST;
  pthread_mutex_lock(&gate);
  int started = cs_threads_start(threads, wanted, pass, &gate);
  pthread_mutex_unlock(&gate);
  cs_threads_join(threads, started);
  pthread_mutex_destroy(&gate);
  return started == wanted;
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
