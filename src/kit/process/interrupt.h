/* SIGINT, SIGTERM and SIGHUP: the first one requests a clean stop at the next strip of rows, the
 * second one ends the program at once.
 *
 *   signal --> requested --0.7 s--> killed: unfinished files removed, ended by the signal
 *                  \--> noticed --0.7 s--> the same
 *                          \--> stopped cleanly, ended by the signal
 *
 * INVARIANT: a program that ends by such a signal leaves no unfinished file. SIGPIPE and SIGXFSZ
 * are ignored, so that a closed pipe or a file that has become too long is a failed write with a
 * message.
 */
#pragma once

#include <poll.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

void cs_interrupt_install(void);
/* The signal that requested the stop, or 0. The caller that gets a signal must end soon. */
int cs_interrupt_signal(void);
/* Waits as poll(2) does, until a signal requests a stop; returns at once if one has done so before.
 * Only for the thread that gets signals. */
void cs_interrupt_wait(struct pollfd *sources, size_t count, int milliseconds);
/* Sets a function that the handler of the first signal calls; NULL: none. It may call only
 * functions that are safe in a signal handler. */
void cs_interrupt_call(void (*function)(void));
/* Ends the process by the signal that requested the stop, so that the shell sees 128 + n. */
void cs_interrupt_die(void);
/* A celspan_frame_desc.progress function: continues until a signal requests a stop. user:
 * unused. */
bool cs_interrupt_progress(void *user, int32_t rows_done, int32_t rows_total);
