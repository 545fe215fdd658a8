/* The one place where threads are started, and work on numbered steps that is forked and joined.
 *
 * INVARIANTS
 *   Signals from outside are delivered to the calling thread alone.
 *   A thread has a stack of 8 MiB, whatever limit the process has for its own.
 *   Where the system gives fewer threads than are wanted, fewer do the same work.
 */
#pragma once

#include <pthread.h>
#include <stdbool.h>
#include <stdint.h>

typedef struct cs_thread {
  pthread_t id;
  void (*run)(void *user, int worker);
  void *user;
  int worker;
} cs_thread;

/* As pthread_create, with a stack of 8 MiB. The caller decides which signals the thread receives.
 * Returns an errno, or 0. */
int cs_thread_create(pthread_t *id, void *(*run)(void *), void *user);
/* Starts up to `wanted` threads that call run(user, worker); workers are numbered from 1. Returns
 * the number of started threads. They are the first items of `threads`, which must not be moved
 * until the threads are joined. */
int cs_threads_start(cs_thread *threads, int wanted, void (*run)(void *user, int worker),
                     void *user);
void cs_threads_join(cs_thread *threads, int count);

/* Whether the system allows `wanted` more threads at the same time; at most 64 are tried. */
bool cs_threads_are_free(int wanted);

/* Calls step(user, worker, i) once for every i in [0, count), in no particular order, from up to
 * `workers` threads, of which the caller's is worker 0; returns when all are done. */
void cs_thread_pool_run(int workers, int32_t count, void (*step)(void *user, int worker, int32_t i),
                        void *user);
