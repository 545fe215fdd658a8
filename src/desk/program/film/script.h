/* A script's film, opened for a verb in a Lua state of its own. Its faults are reported as the
 * command line reports faults.
 */
#pragma once

#include "inside/hash.h"
#include "lua/nouns/lua_film.h"
#include "lua/sandbox/sandbox.h"
#include "program/options/request.h"

#define CS_SCRIPT_FILM 1 /* index of the film on the state's stack */

typedef struct cs_script {
  celspan_context *context; /* borrowed */
  lua_State *L;             /* owned; NULL: not open */
  cs_film_info film;        /* the texts live as long as the state */
  int64_t number;           /* the number of the frame built last */
  cs_film_frame frame;      /* that frame; owned */
  cs_hash given;            /* the hash of its arguments and the values of its parameters */
  bool is_trusted;          /* the script has the whole of Lua */
  bool asks_files;          /* the paths that it asks for are remembered */
  bool asks_warnings;       /* warnings are kept */
  bool is_silent;           /* what the script prints is not shown */
  cs_sandbox *sandbox;      /* the sandbox of the state; NULL: the whole of Lua without limits */
} cs_script;

/* From now on a signal interrupts this state too. */
void cs_script_watch(lua_State *L);
/* From now on a signal interrupts only scripts: the verb checks for signals itself. */
void cs_script_unwatch(void);
/* For Lua, show(text): writes the output of a script to standard error. */
int cs_script_show(lua_State *L);
/* Reports that a new state could not be prepared, for the reason on top of its stack; NULL: there
 * was no memory for the state. Returns the outcome. */
cs_exit cs_script_report_start(lua_State *L);

/* Gives the values of --set and --set-from to the scripts that a state with celspan runs. OK, or
 * reported. */
cs_exit cs_script_give_settings(celspan_context *context, const cs_request *request, lua_State *L);

/* Runs the script under the request. OK, or reported; *out may be closed in both cases. is_silent:
 * it was run before, and prints nothing now. */
cs_exit cs_script_open(celspan_context *context, const cs_request *request, const char *path,
                       bool is_silent, cs_script *out);
void cs_script_close(cs_script *script);

/* Builds a frame of the film and frees the previous one. On failure the sentence, which names the
 * frame, is in the context. */
celspan_status cs_script_try(cs_script *script, int64_t number);
/* The same, with failures reported. */
cs_exit cs_script_build(cs_script *script, int64_t number);
/* Builds the frame of --frame, or the first, and describes it under the request. */
cs_exit cs_script_frame(cs_script *script, const cs_request *request, celspan_frame_desc *out);
/* Reports "frame N: ..." unless the status is OK; for failures after the frame was built. */
cs_exit cs_script_failure(const cs_script *script, celspan_status status);
