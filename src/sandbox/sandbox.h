/* The sandbox of a script: what it may do by itself, and how much.
 *
 *   roots.h    where it may read                  library.h  what is in its globals
 *   guard.h    how much memory, time, steps       strict.h   what the kernel lets the process do
 *
 * A script that is trusted has the whole of Lua, and those limits alone that are asked for.
 */
#ifndef CS_SANDBOX_SANDBOX_H
#define CS_SANDBOX_SANDBOX_H

#include "bind/host.h"
#include "sandbox/guard.h"
#include "sandbox/roots.h"

typedef struct cs_sandbox {
  cs_guard guard;
  cs_roots roots;
  cs_host_rules rules;
  char *search;       /* templates of require, after those of the script's folder; owned */
  const char *output; /* what begins with this may be written; borrowed; NULL: nothing may */
} cs_sandbox;

void cs_sandbox_init(cs_sandbox *sandbox, const cs_limits *limits);
void cs_sandbox_finish(cs_sandbox *sandbox);

/* Lets scripts read below the folder, and modules be found there. false: there are too many, or no
 * memory. */
bool cs_sandbox_allow(cs_sandbox *sandbox, const char *folder);
/* Likewise below the folders of a search path such as "/lib/?.lua;/more/?.lua". */
bool cs_sandbox_allow_search(cs_sandbox *sandbox, const char *search);

/* Makes the state's host obey the rules. is_trusted: limits alone. The state is made with
 * cs_guard_allocate, and the host is open. */
void cs_sandbox_attach(cs_sandbox *sandbox, lua_State *L, bool is_trusted);

/* Gives a new state its libraries and the script its globals. Raises. */
void cs_sandbox_open_libraries(lua_State *L);
/* After that, and after attaching: the functions that need the sandbox. Raises. */
void cs_sandbox_open_globals(cs_sandbox *sandbox, lua_State *L);

#endif
