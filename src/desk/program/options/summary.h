/* The report of --report: what a run was, in one JSON object, for those who run many.
 *
 * The file is complete or absent, as all files are (output/sinks/file.h).
 */
#pragma once

#include "inside/films.h"
#include "program/options/progress.h"
#include "program/options/request.h"

enum { CS_SUMMARY_SLOWEST = 10 };

/* The slowest frames so far, the slowest first. */
typedef struct cs_summary {
  struct {
    int64_t number;
    double seconds;
  } slowest[CS_SUMMARY_SLOWEST];
  size_t count;
} cs_summary;

typedef struct cs_summary_run {
  const cs_request *request;
  const cs_progress *progress;
  cs_progress_failures failed;
  cs_exit outcome;
  bool has_video; /* ffmpeg is asked for its version */
} cs_summary_run;

void cs_summary_add(cs_summary *summary, const cs_shoot_frame *frame);
/* Writes the file of --report, if it was given. A failure is reported. */
cs_exit cs_summary_write(const cs_summary *summary, celspan_context *context,
                         const cs_summary_run *run);
