/* A reel: frames that one thread builds in order, ahead of the workers that make them.
 *
 *   build (calling thread, in order) --> make (any worker) --> finish (calling thread, in order)
 *
 * What builds may hold a Lua state, which no worker ever enters. A frame carries a block of memory
 * from step to step. At most a few frames a worker are built and not yet finished.
 *
 * INVARIANT: frames are finished in order, whatever the number of workers, so what is told of them
 * does not depend on it either; the failure that ends a run is that of its first frame that failed.
 */
#ifndef CS_FILM_FRAME_PIPELINE_H
#define CS_FILM_FRAME_PIPELINE_H

#include "base/context.h"

typedef enum cs_frame_pipeline_step {
  CS_FRAME_PIPELINE_ANYWHERE = 0, /* by any worker */
  CS_FRAME_PIPELINE_HERE,         /* by the calling thread, before the next frame is built */
  CS_FRAME_PIPELINE_IN_TURN, /* by the calling thread, when all frames before it are finished */
  CS_FRAME_PIPELINE_NOTHING  /* there is nothing to make */
} cs_frame_pipeline_step;

/* A frame being made: for cs_frame_pipeline_progress. */
typedef struct cs_frame_pipeline_turn cs_frame_pipeline_turn;

typedef struct cs_frame_pipeline {
  size_t count;      /* of frames */
  int workers;       /* 0: one a processor */
  bool keeps_going;  /* failures of frames do not keep others from being made */
  size_t frame_size; /* bytes that a frame carries; zero when it is built */
  void *user;
  /* *step is ANYWHERE unless it is set. */
  celspan_status (*build)(void *user, size_t index, void *frame, cs_frame_pipeline_step *step);
  /* context: the calling thread's, or a branch. workers: threads that it may use itself. */
  celspan_status (*make)(void *user, celspan_context *context, void *frame, int workers,
                         cs_frame_pipeline_turn *turn);
  /* status: of what came before, with its sentence in the context. What is returned ends the run
   * unless it is OK. */
  celspan_status (*finish)(void *user, void *frame, celspan_status status);
  /* Lets go of what the frame carries, once for each that was to be built. Calling thread. */
  void (*release)(void *user, void *frame);
  /* Called now and then; share: of the frames that are not finished yet, in frames. false ends the
   * run. Calling thread; may be NULL. */
  bool (*tick)(void *user, double share);
} cs_frame_pipeline;

/* Errors: those of finish; CANCELLED; NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_frame_pipeline_run(celspan_context *context,
                                                     const cs_frame_pipeline *pipeline);
/* A celspan_frame_desc.progress function; user: the turn. false when the frame is not wanted any
 * more. */
bool cs_frame_pipeline_progress(void *turn, int32_t rows_done, int32_t rows_total);

#endif
