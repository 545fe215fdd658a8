/* The one context of a Lua state, and the state that outlives single calls.
 *
 * INVARIANT: a host is reference counted. The Lua state has one reference until it closes, and
 * every scan-line procedure has one, because objects may outlive their state. After closing,
 * `state` and `context` are NULL and nothing enters Lua any more.
 */
#ifndef CS_BIND_HOST_H
#define CS_BIND_HOST_H

#include <lua.h>

#include "celspan/celspan.h"

typedef struct cs_host {
  size_t references;
  lua_State *state; /* the thread that Lua callbacks run on */
  celspan_context *context;
  bool owns_context;
  celspan_status failure; /* of the last core call that raised; its sentence is in the context */
} cs_host;

/* Makes the host of this state if it has none. context: NULL makes one; else borrowed, and must
 * outlive the state. Raises when there is no memory. */
void cs_host_open(lua_State *L, celspan_context *context);
/* Raises when the state has no host or is closing. */
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

/* The folder that relative file names are resolved against; "" is the current directory. */
void cs_host_set_folder(lua_State *L, const char *folder);
/* Pushes path, made relative to the folder unless it is absolute, and returns it. */
const char *cs_host_resolve(lua_State *L, const char *path);

#endif
