/* The one place where threads are started, and work on numbered steps that is forked and joined.
 *
 * INVARIANTS
 *   Signals from outside are delivered to the calling thread alone.
 *   Where the system gives fewer threads than are wanted, fewer do the same work.
 */
#ifndef CS_BASE_THREAD_POOL_H
#define CS_BASE_THREAD_POOL_H

#include <pthread.h>
#include <stdint.h>

typedef struct cs_thread {
  pthread_t id;
  void (*run)(void *user, int worker);
  void *user;
  int worker;
} cs_thread;

/* Starts up to `wanted` threads that call run(user, worker), workers being numbered from 1 on.
 * Returns how many there are: the first ones of `threads`, which stay where they are until the
 * threads are joined. */
int cs_threads_start(cs_thread *threads, int wanted, void (*run)(void *user, int worker),
                     void *user);
void cs_threads_join(cs_thread *threads, int count);

/* Calls step(user, worker, i) once for every i in [0, count), in no particular order, from up to
 * `workers` threads, of which the caller's is worker 0; returns when all are done. */
void cs_thread_pool_run(int workers, int32_t count, void (*step)(void *user, int worker, int32_t i),
                        void *user);

#endif
