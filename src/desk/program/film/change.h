/* What --cel, --background and --onion change in a film between building a frame and making it.
 *
 *   --cel NAME     only the cels of that name remain, with their lights; the rostrum's own back
 *                  light does not. A frame without such a cel is empty, but some frame must have
 *                  one
 *   --background   a back light of matte 1 behind everything. If the rostrum has a flat back light
 *                  of its own, with matte a, the background shines through 1 - a of it; a back
 *                  light with a shape is added to the background. Where the weights of exposures
 *                  add up to less than 1 it has the rest
 *   --onion B,A    the film of the script is replaced by one that shows each frame with tinted
 *                  copies of those before and after it (verbs/onion.lua)
 *
 * INVARIANT: without these options, frames stay as they are.
 */
#pragma once

#include "inside/films.h"
#include "program/film/script.h"

typedef struct cs_frame_change {
  const char *cel; /* the name of the cels that are kept; NULL: all */
  bool has_background;
  float background[3]; /* linear light */
} cs_frame_change;

cs_frame_change cs_change_read(const cs_request *request);
/* Changes a frame's rostrums. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_change_frame(celspan_context *context,
                                               const cs_frame_change *change, cs_film_frame *frame);
/* Replaces the film of the script by the film of --onion. frame: the size of the output. OK, also
 * if the option is not given; or reported. */
cs_exit cs_change_lay_onion(cs_script *script, const cs_request *request,
                            const celspan_frame_desc *frame);

typedef struct cs_onion {
  int32_t counts[2];     /* frames before, after */
  int32_t width, height; /* the width and height of the skins, in pixels */
  const char *cel;       /* --cel; NULL: none */
  const char *labels;    /* for celspan watch, see verbs/onion.lua; NULL: a render */
} cs_onion;
/* cs_script_try for one frame of the film with skins; the film of the script remains. */
CELSPAN_CHECKED celspan_status cs_change_try_onion(cs_script *script, const cs_onion *onion,
                                                   int64_t number);
