/* Shooting a film: its frames built by Lua in order, made by several workers, and put into files or
 * digests. What celspan.render and the command line share.
 *
 * A frame that shows the same as an earlier one of the run is copied. Frames that hold scan-line
 * procedures never are: a procedure has no name but itself, and is called by the thread that holds
 * the Lua state, before that goes on to the next frame.
 *
 * INVARIANT: what is told of frames comes in their order and does not depend on the workers.
 */
#ifndef CS_BIND_SHOOT_H
#define CS_BIND_SHOOT_H

#include "base/hash.h"
#include "bind/film.h"
#include "film/sequence.h"

#define CS_SHOOT_PATH 4096

typedef enum cs_shoot_way {
  CS_SHOOT_MADE = 0,
  CS_SHOOT_COPIED, /* from an equal frame */
  CS_SHOOT_KEPT    /* it was there already */
} cs_shoot_way;

typedef struct cs_shoot_frame {
  int64_t number;
  char path[CS_SHOOT_PATH]; /* "" where there is no file */
  cs_shoot_way way;
  bool is_named; /* it holds no procedure: `scene` and `inputs` tell what it shows */
  cs_hash scene;
  cs_hash inputs; /* its pictures' files, where `keep` is given */
  uint64_t digest[2];
} cs_shoot_frame;

typedef struct cs_shoot {
  lua_State *L;
  int film; /* absolute index */
  celspan_context *context;
  const cs_sequence *frames;
  const char *pattern;      /* of the files' names; NULL: no files */
  celspan_frame_desc frame; /* without exposures; workers: of the whole run */
  celspan_file_desc file;   /* without what it takes from the film and its frames */
  bool has_digests;         /* of each frame's pixels */
  bool keeps_going;         /* a frame that fails does not end the run */
  bool keeps_nothing;       /* every frame is made anew, as if it were the first */
  void *user;
  /* Instead of files: called by the calling thread, in order. NULL: files. */
  celspan_status (*put)(void *user, const celspan_frame_desc *frame);
  /* Whether the frame, which is named as far as it can be, is there already; it sets the digest
   * where there are digests. Calling thread. NULL: none is. */
  bool (*keep)(void *user, cs_shoot_frame *frame);
  /* A frame came to its end, in order; status: with its sentence, which names the frame, in the
   * context. What is returned ends the run unless it is OK. */
  celspan_status (*told)(void *user, const cs_shoot_frame *frame, celspan_status status);
  /* As in cs_frame_pipeline: share of the frames that were not told of yet, in frames. May be NULL.
   */
  bool (*tick)(void *user, double share);
} cs_shoot;

/* Errors: those of `told`; CANCELLED; NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_shoot_run(const cs_shoot *shoot);

#endif
