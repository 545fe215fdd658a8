/* How far a render is: a bar on a terminal, a line a frame elsewhere, or what other programs read.
 *
 *   json     on standard error, an object a line: {"event":"frame","number":3,...}
 *   openjd   on standard output, the lines of Open Job Description: openjd_progress: 12.5
 *
 * INVARIANT  Percent and time left mean the whole job, and 100 % is said only when it is done.
 */
#ifndef CS_CLI_PROGRESS_H
#define CS_CLI_PROGRESS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "cli/argument.h"

typedef struct cs_progress {
  cs_progress_style style; /* never AUTO once started */
  size_t frame_count, frames_done;
  size_t copied, kept;   /* of those done */
  const char *noun;      /* of what is counted: "frame", unless it is changed after the start */
  double started, shown; /* seconds of the monotonic clock */
  double pause;          /* least seconds between two lines or two states of the bar */
} cs_progress;

/* Seconds since some fixed moment; never goes back. */
double cs_progress_clock(void);

/* Diagnostics take their form from the style from now on. */
void cs_progress_choose(cs_progress_style style);
void cs_progress_start(cs_progress *progress, cs_progress_style style, size_t frame_count);
/* share: of the frames on their way, in frames. false once a signal asks to stop. */
bool cs_progress_tick(cs_progress *progress, double share);
/* A frame is finished; what: where it went; how: "made", "copied" or "kept". */
void cs_progress_frame(cs_progress *progress, int64_t frame, const char *what, const char *how);
/* Takes the bar away; says what was done when all frames are. failed: the frames that were not. */
void cs_progress_end(cs_progress *progress, const int64_t *failed, size_t failed_count);

#endif
