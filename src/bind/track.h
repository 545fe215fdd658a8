/* Following what moves, for lua/celspan/track.lua; no script sees these. */
#ifndef CS_BIND_TRACK_H
#define CS_BIND_TRACK_H

#include <lua.h>

/* tracker(bytes, width, height, model, {x, y, w, h} [, mask]) -> tracker | nil, message. bytes: RGBA
 * in 16-bit codes; mask: likewise, of what is followed by its alpha; model: from 0. */
int cs_track_tracker(lua_State *L);
/* follow(tracker, bytes, width, height) -> {matrix} | nil, message; nil alone: lost. Then corners,
 * agreeing, error. */
int cs_track_follow(lua_State *L);
/* rewind(tracker) */
int cs_track_rewind(lua_State *L);
/* inverse(matrix) -> the inverse of nine numbers; nil: there is none */
int cs_track_inverse(lua_State *L);

#endif
