/* Films in Lua: the value that a script returns, and its frames one by one.
 *
 *   cs_lua_film_read    the facts of a film
 *   cs_lua_film_build   frame n as exposures, for callers outside of Lua
 *
 * INVARIANT: cs_lua_film_read and cs_lua_film_build do not raise: an error of the frame function
 * comes back as a status with its sentence in the context, "shot.lua:12: frame 37: circle: ...".
 */
#pragma once

#include <lua.h>

#include "inside/films.h"

/* film: index of a film. The texts live as long as the film. */
void cs_lua_film_read(lua_State *L, int film, cs_film_info *out);
/* (film) -> the list of its sounds (sounds.h), with the places of their files: beside the Lua file
 * that made the film, otherwise beside the script. */
int cs_lua_film_sounds(lua_State *L);
/* (film) -> its captions, and where they are the name of a file its path, and another path that was
 * searched or nil. Files are searched for as for sounds. */
int cs_lua_film_captions(lua_State *L);
/* Calls the frame function. out: new, must be finished; not changed on failure. */
CELSPAN_CHECKED celspan_status cs_lua_film_build(lua_State *L, int film, int64_t number,
                                                 cs_film_frame *out);

/* Pushes a film of one frame around the rostrum at index. Raises. */
void cs_lua_film_push_still(lua_State *L, int rostrum, int32_t width, int32_t height);
/* Pushes the film of a script's result at index: a film, or for a rostrum a film of one frame, 1920
 * x 1080, 24 a second. For any other value, returns false and pushes nothing. Raises. */
bool cs_lua_film_push(lua_State *L, int index);
/* Calls the frame function for a frame and pushes its result, checked to be exposures; raises with
 * the frame's number in the message. */
void cs_lua_film_push_frame(lua_State *L, int film, int64_t number);
