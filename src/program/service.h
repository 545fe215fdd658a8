/* Verbs in Lua: the text verbs/NAME.lua, with a table of services and the request as its arguments.
 *
 *   main --> cs_service_run --> verbs/program.lua, verbs/NAME.lua     the program's state
 *                                   |
 *                                   +--> services: reports, files, processes
 *                                   +--> film_service.c --> script.c   the script's state
 *
 * Texts are part of the binary. A state loads program.lua and the text of its verb, and celspan's
 * modules when one of them is required.
 *
 * INVARIANT: a script's film has a Lua state of its own. Only numbers, texts and references to
 * values of the core pass from it to the program's state, never values of Lua. A service that fails
 * reports why and ends the verb with its exit code, unless it is one that returns a message.
 */
#ifndef CS_CLI_SERVICE_H
#define CS_CLI_SERVICE_H

#include <lauxlib.h>

#include "program/request.h"

/* A text in the binary, which ends with a zero. */
typedef struct cs_text {
  const char *name; /* of its file */
  const char *bytes;
  size_t size;
} cs_text;

extern const cs_text cs_verb_texts[]; /* the last one has no name */

typedef struct cs_program {
  celspan_context *context;
  const cs_request *request;
  cs_exit outcome; /* of the service that ended the verb; OK: none did */
} cs_program;

/* Runs a verb. Its outcome, reported. */
cs_exit cs_service_run(celspan_context *context, const cs_request *request);

/* The text of that name, which there is. */
const cs_text *cs_service_text(const char *name);
/* Pushes the text of that name as a function. Raises. */
void cs_service_load(lua_State *L, const char *name);
/* Adds services to the table on top of the stack. */
void cs_service_add(lua_State *L, const luaL_Reg *functions);

/* For services: the program that they belong to. */
cs_program *cs_service_program(lua_State *L);
/* Ends the verb with an exit code, whose reason was reported unless it is OK. Does not return. */
int cs_service_end(lua_State *L, cs_exit outcome);
/* Ends the verb unless the outcome is OK. */
void cs_service_require(lua_State *L, cs_exit outcome);
/* The same for a status, whose sentence is in the context and is reported. */
void cs_service_try(lua_State *L, celspan_status status);

/* Each adds its services to the table on top of the stack. */
void cs_service_add_film(lua_State *L);
void cs_service_add_files(lua_State *L);
void cs_service_add_pictures(lua_State *L);
void cs_service_add_processes(lua_State *L);

#endif
