/* SIGINT, SIGTERM and SIGHUP: the first one asks for a clean stop at the next strip of rows, the
 * second one ends the program at once.
 *
 *   signal --> asked --0.7 s--> given up: unfinished files removed, dead by the signal
 *                 \--> noticed --0.7 s--> the same
 *                         \--> ended in order, dead by the signal
 *
 * INVARIANT: however the program ends by such a signal, it leaves no unfinished file. SIGPIPE and SIGXFSZ are ignored, so that a closed pipe or
 * a file that grew too long is a failed write with a message.
 */
#ifndef CS_CLI_INTERRUPT_H
#define CS_CLI_INTERRUPT_H

#include <stdbool.h>
#include <stdint.h>

void cs_interrupt_install(void);
/* The signal that asked to stop, or 0. Who is told is to end soon. */
int cs_interrupt_signal(void);
/* Sets a function that the first signal calls too; NULL: none. It may do only what is safe in a
 * signal handler. */
void cs_interrupt_call(void (*function)(void));
/* Dies by the signal that asked, so that the caller's shell sees 128 + n. */
void cs_interrupt_die(void);
/* A celspan_frame_desc.progress function: goes on until a signal asks to stop. user: not used. */
bool cs_interrupt_progress(void *user, int32_t rows_done, int32_t rows_total);

#endif
