/* What a film answers while somebody looks at it (celspan watch): pictures and sounds in memory,
 * the objects at a point, and the files that it reads. Methods of a film in Lua, without the film.
 */
#pragma once

#include <lua.h>

#include "program/script.h"

int cs_stage_picture(lua_State *L, cs_script *script);
int cs_stage_hits(lua_State *L, cs_script *script);
int cs_stage_files(lua_State *L, cs_script *script);
int cs_stage_sound(lua_State *L, cs_script *script);
int cs_stage_wave(lua_State *L, cs_script *script);
