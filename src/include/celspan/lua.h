/* celspan for Lua 5.4: for hosts that embed Lua, and the entry points of the loadable module.
 *
 *   celspan_lua_open(L, context)              celspan in a state, under the host's context
 *   celspan_film film = celspan_lua_film(L, -1)      what a script returned
 *   celspan_lua_frame(L, -1, film.first, &frame)     a frame of it, to render by the C interface
 *
 * `require "celspan"` then finds the module, and the animation library (celspan.ease, celspan.keys,
 * ...) with it, without any search path. If the library package is open by then, modules that no
 * path of the host has are found beside the file that requires them, as a film wants it. Every Lua
 * state has one context: that of the host, or one of its own, destroyed with the state.
 *
 * No celspan_lua_ function raises, calls the panic function, or changes the stack: failures come
 * back as a status, with their sentence in the state's context. They are called on the thread that
 * owns the state. Lua's own memory comes from the allocator of the state, all else from the
 * context's.
 */
#ifndef CELSPAN_LUA_H
#define CELSPAN_LUA_H

#include "celspan/celspan.h"

#ifdef __cplusplus
extern "C" {
#endif

#include <lua.h> /* in here, because it does not say by itself that it is C */

CELSPAN_API int luaopen_celspan(lua_State *L);

/* Opens celspan as luaL_requiref would. All that scripts make and render then goes through
 * `context`: its memory function, its limits, its last error. context: borrowed until the state is
 * closed, NULL for one of the state's own. It must not be in use by another thread while Lua runs.
 * In a state that is open already it must be the same, or NULL. Errors: BAD_ARGUMENT when the state
 * has another context; NO_MEMORY. The sentence is in `context`. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_lua_open(lua_State *L, celspan_context *context);
/* The context of a state; NULL when celspan was not opened in it, or is closed again. */
CELSPAN_API celspan_context *celspan_lua_context(lua_State *L);

/* The rostrum at index, NULL for anything else. It lives as long as the value in Lua; with
 * celspan_rostrum_ref as long as you like. */
CELSPAN_API celspan_rostrum *celspan_lua_rostrum(lua_State *L, int index);

/* What a film says of itself. */
typedef struct celspan_film {
  int32_t width, height; /* film units, and pixels unless another size is wanted */
  double frames_second;
  int64_t first, count; /* the frames are first .. first + count - 1; count 0: not a film */
  const char *title;    /* NULL: none. Texts live as long as the film's value in Lua */
  const char *sound;    /* the one file of it, as the script wrote it; NULL: none, or a list */
  double sound_offset;  /* seconds by which all sounds begin later */
} celspan_film;

/* The film at index. A rostrum is a film of one frame, 1920 x 1080, 24 a second, as on the command
 * line. For anything else, and without memory, count is 0 and the sentence says what was found. */
CELSPAN_API celspan_film celspan_lua_film(lua_State *L, int index);

/* Calls the frame function of the film, or takes the rostrum, at index, for a frame's number. out:
 * new, for celspan_lua_frame_drop: the exposures, and the film's size as that of the film and of
 * the frame; set size, crop, workers and progress as you like and render it by any call that takes
 * a frame. Whatever Lua does meanwhile, its scene lives until it is dropped. Any thread may render
 * it with a context of its own, unless the film uses scan-line procedures, which enter Lua. Errors:
 * BAD_ARGUMENT for a number outside the film or a value that is not one; CALLBACK for an error of
 * the script, "shot.lua:12: frame 37: ..."; the core's own where it refused the scene. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_lua_frame(lua_State *L, int index,
                                                             int64_t number,
                                                             celspan_frame_desc *out);
/* Lets the exposures go. Without scan-line procedures any thread, before or after the state is
 * closed. A desc that is all zero or was dropped may be dropped too. */
CELSPAN_API void celspan_lua_frame_drop(celspan_frame_desc *frame);

#ifdef __cplusplus
}
#endif
#endif
