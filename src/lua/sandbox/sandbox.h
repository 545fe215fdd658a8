/* The sandbox of a script: its rights and limits.
 *
 *   plugins/isolate/roots.h   the folders that it may read     library.h  its globals
 *   plugins/isolate/strict.h  the rights of the process        guard.h    memory, time, steps
 *
 * A trusted script has the whole of Lua, and only the limits that were requested.
 */
#pragma once

#include "lua/bind/host.h"
#include "lua/sandbox/guard.h"
#include "plugins/isolate/roots.h"

typedef struct cs_sandbox {
  cs_guard guard;
  cs_roots roots;
  cs_host_rules rules;
  char *search;       /* templates of require, searched after the script's folder; owned */
  const char *output; /* paths with this prefix may be written; borrowed; NULL: none may */
} cs_sandbox;

void cs_sandbox_init(cs_sandbox *sandbox, const cs_limits *limits);
void cs_sandbox_finish(cs_sandbox *sandbox);

/* Allows scripts to read below the folder, and to find modules in it. false: there are too many
 * folders, or no memory. */
bool cs_sandbox_allow(cs_sandbox *sandbox, const char *folder);
/* The same for the folders of a search path such as "/lib/?.lua;/more/?.lua". */
bool cs_sandbox_allow_search(cs_sandbox *sandbox, const char *search);

/* Installs the rules in the host of the state. is_trusted: limits only. The state was created with
 * cs_guard_allocate, and the host is open. */
void cs_sandbox_attach(cs_sandbox *sandbox, lua_State *L, bool is_trusted);

/* Opens the libraries of a new state and the globals of the script. Raises errors. */
void cs_sandbox_open_libraries(lua_State *L);
/* Opens the functions that need the sandbox; called last, after attaching. Raises errors. */
void cs_sandbox_open_globals(cs_sandbox *sandbox, lua_State *L);
