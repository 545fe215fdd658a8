/* The processor's own counter of instructions, where the system lends one: on many virtual machines
 * there is none, or only root may read it.
 */
#ifndef CELSPAN_BENCH_INSTRUCTIONS_H
#define CELSPAN_BENCH_INSTRUCTIONS_H

#ifdef __cplusplus
extern "C" {
#endif

/* Instructions in user space of the calling thread and of those it has started since this was first
 * asked; NAN without a counter. One thread asks. */
double bench_instructions(void);

#ifdef __cplusplus
}
#endif
#endif
