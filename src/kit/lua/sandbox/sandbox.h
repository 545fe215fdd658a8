/* The sandbox of a script: its rights and limits.
 *
 *   common/roots.h              the folders that it may read     library.h  its globals
 *   plugins/isolate/strict.h  the rights of the process        guard.h    memory, time, steps
 *
 * INVARIANT: it lives until the last block of its state is freed, and so longer than all that the
 * script made. A trusted script has the whole of Lua, and only the limits.
 */
#pragma once

#include "common/roots.h"
#include "lua/bind/host.h"
#include "lua/sandbox/guard.h"

typedef struct cs_sandbox {
  cs_guard guard;
  cs_roots roots;
  cs_host_rules rules;
  cs_memory *memory; /* counted; the memory of the context */
} cs_sandbox;

/* Adds the folders that scripts may read under these limits: the folders of the limits, and the
 * folders of templates such as "/lib/?.lua". false: as with cs_roots_add, or, with ENAMETOOLONG in
 * errno, a folder is too long. */
bool cs_sandbox_add_roots(const celspan_lua_limits *limits, cs_roots *roots);

/* Confines the state, in which celspan is open. is_trusted: only limits apply. The state owns the
 * result. Raises errors. */
cs_sandbox *cs_sandbox_open(lua_State *L, const celspan_lua_limits *limits, bool is_trusted);
