/* What a film answers while somebody looks at it (celspan watch): pictures and sounds in memory,
 * the objects at a point, the cost of cels, and the files that it reads. Methods of a film in Lua,
 * without the film.
 */
#pragma once

#include <lua.h>

#include "program/script.h"

/* What is asked about the frame that was built last: of the frame with a size, a crop of it, as six
 * numbers from index 2 on. false: the crop is not within the frame, or has too many pixels; nil and
 * a message are pushed. */
bool cs_stage_frame(lua_State *L, const cs_script *script, celspan_frame_desc *out);

int cs_stage_picture(lua_State *L, cs_script *script);
int cs_stage_hits(lua_State *L, cs_script *script);
int cs_stage_files(lua_State *L, cs_script *script);
int cs_stage_sound(lua_State *L, cs_script *script);
int cs_stage_wave(lua_State *L, cs_script *script);
int cs_stage_alter(lua_State *L, cs_script *script);
int cs_stage_keep_line(lua_State *L, cs_script *script);
int cs_stage_costs(lua_State *L, cs_script *script);
int cs_stage_camera(lua_State *L, cs_script *script);
/* by: whose camera it is. */
int cs_stage_use_camera(lua_State *L, cs_script *script, const celspan_rostrum *by);
