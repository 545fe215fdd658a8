/* A script's film, opened for a verb in a Lua state of its own; its faults are reported in the
 * words of the command line.
 */
#ifndef CS_CLI_SHOT_H
#define CS_CLI_SHOT_H

#include "bind/film.h"
#include "cli/request.h"

#define CS_SHOT_FILM 1 /* where the film stands on the state's stack */

typedef struct cs_shot {
  celspan_context *context; /* borrowed */
  lua_State *L;             /* owned; NULL: not open */
  cs_film_info film;        /* its texts live as long as the state */
  int64_t number;           /* of the frame built last */
  cs_film_frame frame;      /* that frame; owned */
} cs_shot;

/* Runs the script of the request. OK, or reported; either way *out may be closed. */
cs_exit cs_shot_open(celspan_context *context, const cs_request *request, cs_shot *out);
void cs_shot_close(cs_shot *shot);

/* Builds a frame of the film; the one before is gone. The sentence, which names the frame, stands
 * in the context. */
celspan_status cs_shot_try(cs_shot *shot, int64_t number);
/* The same, with failures reported. */
cs_exit cs_shot_build(cs_shot *shot, int64_t number);
/* Builds the frame of --frame, or the first, and describes it under the request. */
cs_exit cs_shot_frame(cs_shot *shot, const cs_request *request, celspan_frame_desc *out);
/* Reports "frame N: ..." unless status is OK: for what is done with a frame that was built. */
cs_exit cs_shot_failure(const cs_shot *shot, celspan_status status);

#endif
