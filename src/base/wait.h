/* Waiting for other threads, but never long: between two moments the waiter can look at a clock, a
 * signal, a progress bar.
 */
#ifndef CS_BASE_WAIT_H
#define CS_BASE_WAIT_H

#include <pthread.h>
#include <stdbool.h>

/* A condition for cs_wait_moment; ended by pthread_cond_destroy. */
void cs_wait_init(pthread_cond_t *condition);
/* Waits until the condition is signalled (true), or a tenth of a second by the monotonic clock. The
 * mutex is held, and let go while it waits. */
bool cs_wait_moment(pthread_cond_t *condition, pthread_mutex_t *mutex);

#endif
