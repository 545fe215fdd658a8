/* Shooting a film: its frames are built in order by one thread, made by several workers, and put
 * into files, digests or a stream. celspan.render and the command line share it.
 *
 *   build --> keep?  -->  make, or copy from an equal frame  -->  give, finished
 *   \_____________/      \_________________________________/      \____________/
 *   calling thread,         any worker; copies, and           calling thread,
 *   in order                procedures: calling thread        in order
 *
 * The frames of a stream, such as a video, are made in slots, which are memory of the user, and
 * given on in order. A slow frame holds later ones back in their slots, and while no slot is free,
 * no frame is built.
 *
 * A frame that shows the same as an earlier frame of the run is copied from it; in a stream, from
 * the frame before it alone. Frames that contain scan-line procedures are never copied: a procedure
 * can be compared with nothing, and the calling thread has to call it before it builds the next
 * frame.
 *
 * INVARIANT: frames are reported in their order, and the reports do not depend on the number of
 * workers.
 */
#pragma once

#include "base/hash.h"
#include "frames/film/film.h"
#include "frames/film/sequence.h"
#include "output/sinks/file.h"

#define CS_SHOOT_PATH 4096

typedef enum cs_shoot_way {
  CS_SHOOT_MADE = 0,
  CS_SHOOT_COPIED, /* the file was copied from an equal frame */
  CS_SHOOT_KEPT    /* the file was there already */
} cs_shoot_way;

typedef struct cs_shoot_frame {
  int64_t number;
  char path[CS_SHOOT_PATH]; /* "" where there is no file */
  cs_shoot_way way;
  bool is_named; /* it contains no procedure: `scene` and `inputs` say what it shows */
  cs_hash scene;
  cs_hash inputs; /* of its pictures' files; set only where `keep` is given */
  uint64_t digest[2];
  double seconds;            /* how long building and making it took */
  cs_file_contents contents; /* the contents of its file, where that was made or copied */
} cs_shoot_frame;

/* A frame on its way into something else than a file. */
typedef struct cs_shoot_put {
  celspan_context *context; /* the context of the thread */
  const celspan_frame_desc *desc;
  size_t slot;
  cs_shoot_frame *frame;
} cs_shoot_put;

typedef struct cs_shoot {
  celspan_context *context;
  cs_film_info film;
  const cs_sequence *frames;
  const char *pattern;      /* the pattern of the files' names; NULL: no files */
  celspan_frame_desc frame; /* without exposures; workers: for the whole run */
  celspan_file_desc file;   /* without the fields that come from the film and its frames */
  bool has_digests;         /* each frame's pixels are hashed */
  bool keeps_going;         /* a frame that fails does not end the run */
  bool keeps_nothing;       /* nothing is carried over from one frame to the next */
  void *user;
  /* The exposures of a frame: new. Errors: with their sentence in the context. Calling thread, in
   * order. */
  celspan_status (*build)(void *user, int64_t number, cs_film_frame *out);
  /* The function that is called for each frame instead of writing a file; it sets the digest where
   * there are digests. With `give`, it makes the frame in a slot, in any thread; otherwise it is
   * called by the calling thread, in order, and slot is 0. NULL: files. */
  celspan_status (*put)(void *user, const cs_shoot_put *one);
  size_t slots; /* the slots of the stream; 0 without `give` */
  /* Gives the frame in a slot on; the slot is free afterwards. Calling thread, in order. NULL: it
   * is no stream. */
  celspan_status (*give)(void *user, size_t slot);
  /* Gives on once more the frame that was given last, because the next one equals it. Calling
   * thread, in order. NULL: such frames are made. */
  celspan_status (*repeat)(void *user);
  /* Writes the file of a frame instead of celspan_frame_write; such files are not copied. Any
   * thread. NULL: that one. */
  celspan_status (*write)(void *user, celspan_context *context, const celspan_frame_desc *desc,
                          const char *path, const celspan_file_desc *file);
  /* What the frame's file depends on, instead of cs_scene_hash. NULL: that. */
  cs_hash (*hash)(const celspan_exposure *exposures, size_t count);
  /* Whether the frame exists already. Its number, path and hashes are set; where there are digests,
   * this function sets the frame's. Calling thread. NULL: no frame exists. */
  bool (*keep)(void *user, cs_shoot_frame *frame);
  /* A frame is finished or has failed; in order. The sentence of a failure is in the context and
   * names the frame. A result other than OK ends the run. */
  celspan_status (*finished)(void *user, const cs_shoot_frame *frame, celspan_status status);
  /* As in cs_frame_pipeline: the share of the frames that are not reported yet, in frames. NULL:
   * nobody asks. */
  bool (*tick)(void *user, double share);
} cs_shoot;

/* Errors: those of `finished`; CANCELLED; NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_shoot_run(const cs_shoot *shoot);
/* Puts the frame's number before the sentence of a failure; a run that was stopped has none.
 * Returns the status. */
celspan_status cs_shoot_failure(celspan_context *context, int64_t number, celspan_status status);
