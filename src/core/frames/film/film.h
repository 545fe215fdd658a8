/* A film and its frames as the core sees them. Who builds the frames does not matter here: a
 * script, through celspan/lua.h, or anything else that can give exposures for a number.
 *
 * INVARIANT: the exposures of a frame keep their scene alive by references of their own, so that a
 * frame can be rendered by any thread after its builder has gone on to the next one.
 */
#pragma once

#include "celspan/celspan.h"

/* A name for a range of frames, from one frame to another. */
typedef struct cs_film_mark {
  const char *name;
  int64_t frame, last;
  bool has_last; /* false: see cs_film_mark_last */
} cs_film_mark;

typedef struct cs_film_info {
  int32_t width, height; /* film units, and pixels unless another size is asked for */
  celspan_space space;
  double frames_second;
  int64_t first, count; /* frames first .. first + count - 1 */
  const char *title;    /* NULL: none; the film's own, borrowed */
  bool has_sound;       /* one file or more */
  bool has_captions;
  bool has_poster; /* the film says which */
  int64_t poster;  /* the frame that stands for the film; `first` unless it says another */
  const cs_film_mark *marks; /* in the order of their frames; the film's own, borrowed */
  size_t mark_count;
} cs_film_info;

typedef struct cs_film_frame {
  celspan_exposure *exposures; /* made by cs_film_frame_init alone, owned; each holds a reference to
                                  its rostrum */
  size_t count;
  bool repeats; /* the frame is one of several: see celspan_frame_desc */
} cs_film_frame;

/* Copies the exposures and takes a reference to each rostrum. out: new, must be finished, by any
 * thread, before or after the context ends. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_film_frame_init(cs_film_frame *out, celspan_context *context,
                                                  const celspan_exposure *exposures, size_t count);
/* A frame that is all zero, or finished already, may be finished too. */
void cs_film_frame_finish(cs_film_frame *frame);
/* The last frame of a mark. */
int64_t cs_film_mark_last(const cs_film_info *film, size_t mark);
/* Describes a frame of a film as far as the film says it: the space, the exposures, which are
 * borrowed, and the size in film units, unless *out has one. Whoever describes a frame of a film
 * does it here, so that no part of it is forgotten. */
void cs_film_expose(const cs_film_info *film, const cs_film_frame *frame, celspan_frame_desc *out);
