/* How far a run is: a bar on a terminal, lines in a log, or a form that other programs read.
 *
 *   json     on standard error, an object a line: {"event":"frame","number":3,...}
 *   openjd   on standard output, the lines of Open Job Description: openjd_progress: 12.5
 *
 * INVARIANT  Percentage and remaining time refer to the whole run; 100 % is shown only when it is
 * done.
 */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "program/options/request.h"

typedef struct cs_progress {
  cs_progress_style style; /* never AUTO once started */
  size_t frame_count, frames_done;
  size_t copied, kept;   /* finished frames that were copied, or kept */
  const char *noun;      /* what is counted: "frame", unless it is changed after the start */
  const char *output;    /* the output of -o, for the log; NULL: there is none */
  double started, shown; /* seconds of the monotonic clock */
  double pause;          /* the least seconds between two lines, or between two states of the bar */
} cs_progress;

/* From now on diagnostics have the form for this style. */
void cs_progress_choose(cs_progress_style style);
/* style: the style of a request without --progress. */
void cs_progress_start(cs_progress *progress, const cs_request *request, cs_progress_style style,
                       size_t frame_count);
/* share: of the frames that are being made, in frames. Returns false after a signal to stop. */
bool cs_progress_tick(cs_progress *progress, double share);
/* Counts a finished frame. what: the file; how: "made", "copied" or "kept". */
void cs_progress_frame(cs_progress *progress, int64_t frame, const char *what, const char *how);
/* The frames that failed. */
typedef struct cs_progress_failures {
  const int64_t *frames;
  size_t count;
} cs_progress_failures;

/* Removes the bar, and reports a summary if all frames are done. Nothing is reported afterwards.
 * outcome: the exit code, unless a signal stopped the run. */
void cs_progress_end(cs_progress *progress, cs_progress_failures failed, int outcome);
