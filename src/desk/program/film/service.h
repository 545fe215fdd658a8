/* Services: the functions in C that verbs call (program/services/lua_verb.h).
 *
 * INVARIANT: a script's film has a Lua state of its own. Only numbers, texts and references to
 * values of the core pass from it to the program's state, never values of Lua. A service that fails
 * reports why and ends the verb with its exit code, unless it is one that returns a message.
 */
#pragma once

#include <lauxlib.h>

#include "inside/hash.h"
#include "program/options/progress.h"

/* One run of a verb that is written in Lua. */
typedef struct cs_session {
  celspan_context *context;
  const cs_request *request;
  cs_exit outcome;      /* the outcome of the service that ended the verb; OK: no service did */
  bool has_shared;      /* the services of program.lua are there */
  cs_progress progress; /* without a noun: the verb does not count frames */
} cs_session;

/* A service or method whose name in Lua is the name of its function. */
#define CS_SERVICE(name)                                                                           \
  { #name, name }

/* For __index: pushes the function with the name that is argument 2, and keeps it in the table that
 * is argument 1. lists: NULL at the end. false: there is none, and nothing is pushed. */
bool cs_service_find(lua_State *L, const luaL_Reg *const *lists);
/* Adds methods to the table on top of the stack. */
void cs_service_add(lua_State *L, const luaL_Reg *functions);

/* For methods: the contents of the field `open` of the table that is argument 1. */
void *cs_service_opened(lua_State *L);

/* Pushes a value with "celspan" and the words of the list of strings at index, ended by NULL. The
 * list keeps the strings alive. */
const char **cs_service_push_words(lua_State *L, int index);

/* A field of the table that is argument 2, which keeps it alive; NULL: it is no text. */
const char *cs_service_text(lua_State *L, const char *name);
/* Pushes a hash as 32 hexadecimal digits. */
void cs_service_push_hash(lua_State *L, cs_hash hash);

/* For services: the run that they belong to. */
cs_session *cs_service_session(lua_State *L);
/* Ends the verb with an exit code; unless it is OK, the reason has been reported. Does not
 * return. */
int cs_service_end(lua_State *L, cs_exit outcome);
/* Ends the verb unless the outcome is OK. */
void cs_service_require(lua_State *L, cs_exit outcome);
/* The same for a status, whose sentence is in the context and is reported. */
void cs_service_try(lua_State *L, celspan_status status);

/* The services of each file, by name; the last one has no name. */
extern const luaL_Reg cs_services_compare[], cs_services_reports[], cs_services_script[],
    cs_services_files[], cs_services_pictures[], cs_services_processes[], cs_services_renderers[],
    cs_services_stage[], cs_services_shown[], cs_services_watchers[], cs_services_web[];
/* Methods of a film beside those of script_service.c. */
extern const luaL_Reg cs_methods_scene[], cs_methods_shooting[];
