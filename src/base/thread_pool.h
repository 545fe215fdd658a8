/* A crew: threads that do the numbered steps of one job, side by side. */
#ifndef CS_BASE_THREAD_POOL_H
#define CS_BASE_THREAD_POOL_H

#include <stdint.h>

/* Calls step(user, i) once for every i in [0, count), in no particular order, from up to `workers`
 * threads, the caller's one of them; returns when all are done. Where no more threads can be had,
 * fewer do the same. */
void cs_thread_pool_run(int workers, int32_t count, void (*step)(void *user, int32_t i),
                        void *user);

#endif
