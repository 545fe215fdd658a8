/* What celspan_lua_run of celspan/lua.h can run: whether a file can be a script. */
#pragma once

#include <stdbool.h>

#include "celspan/lua.h"

/* Whether a file can be a script at all, by its first bytes. false: it contains binary data, or is
 * a picture whose format is text; Lua itself refuses compiled chunks. Only files that can be read
 * twice are read; for pipes and missing files the result is true, and Lua reports the error. */
bool cs_lua_script_accepts(const char *path);
