/* How far a render is, on standard error: a bar on a terminal, a line a frame elsewhere.
 *
 * INVARIANT  Percent and time left mean the whole job, and 100 % is said only when it is done.
 */
#ifndef CS_CLI_PROGRESS_H
#define CS_CLI_PROGRESS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "cli/values.h"

typedef struct cs_progress {
  cs_progress_style style; /* never AUTO once started */
  size_t frame_count, frames_done;
  const char *noun; /* of what is counted: "frame", unless it is changed after the start */
  double started, shown; /* seconds of the monotonic clock */
  double pause;          /* least seconds between two lines or two states of the bar */
} cs_progress;

/* Seconds since some fixed moment; never goes back. */
double cs_progress_clock(void);

void cs_progress_start(cs_progress *progress, cs_progress_style style, size_t frame_count);
/* A celspan_frame_desc.progress function; user: the cs_progress. false once a signal asks to
 * stop. */
bool cs_progress_rows(void *user, int32_t rows_done, int32_t rows_total);
/* A frame is finished; what: where it went. */
void cs_progress_frame(cs_progress *progress, int64_t frame, const char *what);
/* Takes the bar away; says what was done when all frames are. */
void cs_progress_end(cs_progress *progress);

#endif
