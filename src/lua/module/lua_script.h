/* Running a script: the command line's way into Lua.
 *
 * INVARIANT: nothing here raises. A Lua error comes back as a status, with its sentence in the
 * context.
 */
#pragma once

#include <lua.h>
#include <stdbool.h>

#include "celspan/celspan.h"

/* Runs a script, or shows artwork (lua/module/artwork.h), with the arguments as `...`. Its folder
 * is the base of relative file names and the first place where `require` looks. A rostrum that it
 * returns becomes a film of one frame, 1920 x 1080, 24 a second. On success the film is pushed.
 * The state must have celspan opened.
 * Errors: INPUT when the script cannot be read; CALLBACK when it fails or returns something else;
 * the core's own status when the script raised a refusal of the core. */
CELSPAN_CHECKED celspan_status cs_lua_script_run(lua_State *L, const char *path, int argument_count,
                                                 const char *const *arguments);

/* Whether a file can be a script at all, by its first bytes. false: it contains binary data, or is
 * a picture whose format is text; Lua itself refuses compiled chunks. Only files that can be read
 * twice are read; for pipes and missing files the result is true, and Lua reports what is wrong. */
bool cs_lua_script_accepts(const char *path);
