/* Services: the functions in C that verbs in Lua call (program/services/lua_verb.h).
 *
 * INVARIANT: a script's film has a Lua state of its own. Only numbers, texts and references to
 * values of the core pass from it to the program's state, never values of Lua. A service that fails
 * reports why and ends the verb with its exit code, unless it is one that returns a message.
 */
#pragma once

#include <lauxlib.h>

#include "program/options/progress.h"

/* One run of a verb that is written in Lua. */
typedef struct cs_session {
  celspan_context *context;
  const cs_request *request;
  cs_exit outcome;      /* the outcome of the service that ended the verb; OK: no service did */
  cs_progress progress; /* frame_count 0: the verb does not count frames */
} cs_session;

/* A service or method whose name in Lua is the name of its function. */
#define CS_SERVICE(name)                                                                           \
  { #name, name }

/* Adds services to the table on top of the stack. */
void cs_service_add(lua_State *L, const luaL_Reg *functions);

/* For methods: the contents of the field `open` of the table that is argument 1. */
void *cs_service_opened(lua_State *L);

/* Pushes a value with "celspan" and the words of the list of strings at index, ended by NULL. The
 * list keeps the strings alive. */
const char **cs_service_push_words(lua_State *L, int index);

/* For services: the run that they belong to. */
cs_session *cs_service_session(lua_State *L);
/* Ends the verb with an exit code; unless it is OK, the reason has been reported. Does not
 * return. */
int cs_service_end(lua_State *L, cs_exit outcome);
/* Ends the verb unless the outcome is OK. */
void cs_service_require(lua_State *L, cs_exit outcome);
/* The same for a status, whose sentence is in the context and is reported. */
void cs_service_try(lua_State *L, celspan_status status);

/* Each function adds its services to the table on top of the stack. */
void cs_service_add_reports(lua_State *L);
void cs_service_add_film(lua_State *L);
void cs_service_add_files(lua_State *L);
void cs_service_add_pictures(lua_State *L);
void cs_service_add_processes(lua_State *L);
void cs_service_add_renderers(lua_State *L);
void cs_service_add_stage(lua_State *L);
void cs_service_add_watchers(lua_State *L);
void cs_service_add_web(lua_State *L);
