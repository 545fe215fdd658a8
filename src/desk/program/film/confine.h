/* The rights and limits of scripts and pictures, as the command line gives them: --trust, --strict,
 * --allow, --limit.
 */
#pragma once

#include "lua/sandbox/sandbox.h"
#include "program/options/request.h"

enum { CS_FONT_FOLDERS = 2 }; /* folders that belong to the user */

/* The rights of a script. */
typedef struct cs_confined {
  celspan_lua_limits limits;                                /* their folders are the folders
                                                               below */
  const char *folders[CS_TEXTS_MOST + 2 + CS_FONT_FOLDERS]; /* --allow, and fonts */
  char fonts[CS_FONT_FOLDERS][4096];
  bool is_trusted; /* limits only */
} cs_confined;

/* Lets separate processes decode pictures, unless the pictures are trusted. OK, or reported. */
cs_exit cs_confine_pictures(celspan_context *context, const cs_request *request);
/* Finds how much memory this run may hold, and sets the sizes of the caches. Must be called before
 * anything else. OK, or reported. */
cs_exit cs_confine_memory(const cs_request *request, celspan_context_desc *desc);
/* Limits the memory that is held. Frames that are rendered at the same time have their own limit
 * within it. */
void cs_confine_rendering(celspan_context *context, const cs_request *request);
/* Divides the memory that this process may hold: each process that is started from now on gets one
 * part. */
void cs_confine_divide(unsigned parts);
/* Refuses the options of scripts for a verb that reads a FILE and runs no script. OK, or reported.
 */
cs_exit cs_confine_refuse(const cs_request *request);
/* Whether a script of this request has a sandbox or a limit. */
bool cs_confine_is_needed(const cs_request *request);
/* Finds the limits of a script for the request, and enters strict mode if it is requested. OK, or
 * reported. *out must not move until the sandbox is open. */
cs_exit cs_confine_open(const cs_request *request, const char *script, cs_confined *out);
