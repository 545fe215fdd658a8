/* Frames that one thread builds in order, ahead of the workers that make them.
 *
 *   build (calling thread, in order) --> make (any worker) --> finish (calling thread, in order)
 *
 * A Lua state may be behind build; no worker ever enters it. A frame carries a block of memory from
 * step to step. At most a few frames for each worker are built and not yet finished. The order is
 * kept by base/pipeline.h.
 *
 * INVARIANT: frames are finished in order, whatever the number of workers, so the reports about
 * them do not depend on that number either. If several frames fail, the run ends with the failure
 * of the first of them.
 */
#pragma once

#include "base/pipeline.h"

/* A frame being made: for cs_frame_pipeline_progress. */
typedef struct cs_frame_pipeline_frame cs_frame_pipeline_frame;

typedef struct cs_frame_pipeline {
  size_t count;      /* the count of frames */
  int workers;       /* 0: one per processor */
  bool keeps_going;  /* after the failure of a frame, other frames are still made */
  size_t frame_size; /* bytes that a frame carries; zero when it is built */
  /* Frames that are built and not yet finished, at most; 0: as many as suit the workers. With 1 the
   * calling thread makes each frame, and has all workers for it. */
  size_t slots;
  void *user;
  /* *step: who makes the frame; ANYWHERE unless it is set. HERE: before the next one is built. */
  celspan_status (*build)(void *user, size_t index, void *carried, cs_pipeline_step *step);
  /* context: the calling thread's, or a branch. workers: threads that it may use itself. */
  celspan_status (*make)(void *user, celspan_context *context, void *carried, int workers,
                         cs_frame_pipeline_frame *frame);
  /* status: the result of the earlier steps; its message is in the context. A returned status other
   * than OK ends the run. */
  celspan_status (*finish)(void *user, void *carried, celspan_status status);
  /* Frees the data of the frame, once for each frame that had to be built. Calling thread. */
  void (*release)(void *user, void *carried);
  /* Called now and then; share: of the frames that are not finished yet, in frames. false ends the
   * run. Calling thread; may be NULL. */
  bool (*tick)(void *user, double share);
} cs_frame_pipeline;

/* Errors: those of finish; CANCELLED; NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_frame_pipeline_run(celspan_context *context,
                                                     const cs_frame_pipeline *pipeline);
/* A celspan_frame_desc.progress function; user: the frame. false when the frame is no longer
 * wanted. */
bool cs_frame_pipeline_progress(void *frame, int32_t rows_done, int32_t rows_total);
