/* The processor's instruction counter, where the system gives access to it: many virtual machines
 * have none, and on others only root may read it.
 */
#pragma once

#ifdef __cplusplus
extern "C" {
#endif

/* Instructions in user space by the calling thread, and by those that it has started since the
 * first call of this function; NAN without a counter. To be called by one thread only. */
double bench_instructions(void);

#ifdef __cplusplus
}
#endif
