/* Films: what a script returns, and its frames one by one. The command line's way into Lua.
 *
 *   cs_film_load   runs a script and leaves its film on the stack
 *   cs_film_info   what the film says of itself
 *   cs_film_build  frame n as exposures, which keep their scene alive by references of the core
 *
 * INVARIANT: nothing here raises but cs_film_push_frame: Lua errors come back as a status with a
 * sentence in the context, "shot.lua:12: frame 37: circle: ...", and a traceback that
 * cs_film_traceback gives until the next call.
 */
#ifndef CS_BIND_FILM_H
#define CS_BIND_FILM_H

#include <lua.h>

#include "celspan/celspan.h"

typedef struct cs_film_info {
  int32_t width, height; /* film units, and pixels unless another size is asked for */
  double frames_second;
  int64_t first, count; /* frames first .. first + count - 1 */
  const char *title;    /* NULL: none; the film's own, borrowed */
  const char *sound;    /* NULL: none; as the script wrote it */
  double sound_offset;  /* seconds */
} cs_film_info;

typedef struct cs_film_frame {
  celspan_exposure *exposures; /* each rostrum is a reference of this frame's */
  size_t count;
} cs_film_frame;

/* Runs a script with the arguments as `...`, its folder as the base of relative file names and the
 * first place of `require`. A rostrum becomes a film of one frame, 1920 x 1080, 24 a second. On
 * success the film is pushed. The state must have celspan opened.
 * Errors: INPUT when the script cannot be read; CALLBACK when it fails or returns something else;
 * the core's own status when its refusal is what was raised. */
CELSPAN_CHECKED celspan_status cs_film_load(lua_State *L, const char *path, int argument_count,
                                            const char *const *arguments);
/* film: index of a film. The texts live as long as the film. */
void cs_film_read(lua_State *L, int film, cs_film_info *out);
/* Calls the frame function. out: new, to be given to cs_film_finish_frame; untouched on failure. */
CELSPAN_CHECKED celspan_status cs_film_build(lua_State *L, int film, int64_t number,
                                             cs_film_frame *out);
void cs_film_finish_frame(cs_film_frame *frame);
/* The Lua traceback of the last failure, without celspan's own levels; "" when there is none. */
const char *cs_film_traceback(lua_State *L);

/* Pushes a film of one frame around the rostrum at index. Raises. */
void cs_film_push_still(lua_State *L, int rostrum, int32_t width, int32_t height);
/* Calls the frame function for a frame and pushes what it returns, checked to be exposures; raises
 * with the frame's number in the message. */
void cs_film_push_frame(lua_State *L, int film, int64_t number);

#endif
