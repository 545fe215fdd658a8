/* Verbs in Lua: the text verbs/NAME.lua, with a table of services and the request as its arguments.
 *
 *   main --> cs_lua_verb_run --> verbs/NAME.lua --> verbs/program.lua  the program's state
 *                                   |
 *                                   +--> service.c: reports; file_service.c, ...: files, processes
 *                                   +--> script_service.c --> script.c   the script's state
 *
 * Texts are part of the binary. A state loads the text of its verb. Services, which are the fields
 * of `program`, are made when the verb asks for them: first those in C; program.lua is loaded for
 * the first name that C does not have; celspan's modules, when one of them is required.
 */
#pragma once

#include "program/options/request.h"

/* Runs a verb. Returns the outcome, which has been reported. */
cs_exit cs_lua_verb_run(celspan_context *context, const cs_request *request);
