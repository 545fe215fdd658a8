/* The Lua modules that are built in, and where the others of a page come from.
 *
 *   texts.c        all are built in
 *   texts_page.c   some come with more.json, when a script asks for one of them; celspan-whole.wasm
 *                  has more of them built in
 */
#pragma once

#include "lua/bind/built_in.h"

/* Those that are built in. */
extern const cs_built_in cs_module_texts[], cs_whole_texts[];

/* cs_built_in_load for any module of lua/celspan. */
void cs_texts_load(lua_State *L, const char *folder, const char *file);
