/* The one context of a Lua state, and the state that outlives single calls.
 *
 * INVARIANT: a host is reference counted. The Lua state has one reference until it closes, and
 * every scan-line procedure has one, because objects may outlive their state. After closing,
 * `state` and `context` are NULL and nothing enters Lua any more.
 */
#ifndef CS_BIND_HOST_H
#define CS_BIND_HOST_H

#include <lua.h>

#include "base/context.h"

typedef struct cs_host {
  size_t references;
  cs_memory *memory; /* counted; that of the context */
  lua_State *state;  /* the thread that Lua callbacks run on */
  celspan_context *context;
  bool owns_context;
  celspan_status failure; /* of the last core call that raised; its sentence is in the context */
} cs_host;

/* Makes the host of this state if it has none. context: NULL makes one; else borrowed, and must
 * outlive the state. Raises when there is no memory. */
void cs_host_open(lua_State *L, celspan_context *context);
/* The host; NULL when the state has none or is closing. Never raises. */
cs_host *cs_host_find(lua_State *L);
/* The same, but raises where there is none. */
cs_host *cs_host_get(lua_State *L);
celspan_context *cs_host_context(lua_State *L);
void cs_host_unref(cs_host *host);

/* Callbacks run on L until cs_host_leave is called with what cs_host_enter returned. */
lua_State *cs_host_enter(lua_State *L);
void cs_host_leave(lua_State *L, lua_State *before);

/* Raises the context's sentence at the caller's line, "noun: sentence", unless status is OK. */
void cs_host_try(lua_State *L, const char *noun, celspan_status status);
/* The status of a message that was raised: the core's own when the message contains the core's
 * sentence, else CALLBACK. */
celspan_status cs_host_blame(lua_State *L, const char *message);

/* The folder of the script that the host runs; "" is the current directory. */
void cs_host_set_folder(lua_State *L, const char *folder);
/* Pushes it; false, and nothing pushed, where no script is run. */
bool cs_host_push_folder(lua_State *L);

#endif
