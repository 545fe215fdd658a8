/* A stage makes renders while calls fail: it has a context and a Lua state with the renders of a
 * script such as tests/faults/renders.lua, a folder for files, and a plan for each kind of calls.
 * After the renders of a list comes one of a surface that this host fills, which scripts cannot
 * make.
 */
#pragma once

#include "celspan/lua.h"
#include "tests/faults/calls.h"
#include "tests/support/memory.h"

enum { STAGE_SENTENCE = 1024, STAGE_RENDERS = 64 };

typedef struct stage_item {
  int film;    /* in Lua's registry; LUA_NOREF: the surface */
  int workers; /* of its frames */
} stage_item;

typedef struct stage {
  memory_watch watch; /* of the context's allocations */
  fault_plan lua;     /* of the allocations of Lua */
  /* of the calls to the host's functions: progress, sinks, surfaces, procedures */
  fault_plan host;
  celspan_context *context;
  lua_State *L; /* the renders of the script at 1 */
  const char *folder;
  celspan_rostrum *surface; /* NULL: the script makes its films one after the other */
  stage_item items[STAGE_RENDERS];
  size_t item_count;
} stage;

typedef struct stage_outcome {
  celspan_status status;
  char sentence[STAGE_SENTENCE]; /* if status is not OK */
  bool has_result;
  uint64_t result[2]; /* a digest of the render */
} stage_outcome;

/* script: run with `root` and a function that represents a procedure of the host. folder: must be
 * empty. false: the script failed, and reported why on standard error. */
bool stage_open(stage *s, const char *script, const char *root, const char *folder);
/* Memory that is still allocated is a failed check. */
void stage_close(stage *s);

/* Renders are counted from 0. */
/* A field of a render as text; NULL: it does not exist. It lives as long as the stage. */
const char *stage_render_text(const stage *s, size_t number, const char *field);
/* The n-th sink of a render, from 0; NULL: there are no more. The first is "digest". */
const char *stage_render_sink(const stage *s, size_t number, size_t n);

/* Makes the first frame of a render, from the script's function to the sink's end. sink: "digest",
 * "float", "rows", "sink", "probe", or the ending of a file, optionally after "dither."; "png16" is
 * a PNG with 16 bits. The folder must be empty; a file that was made is removed again. */
void stage_render(stage *s, size_t number, const char *sink, stage_outcome *out);
/* How many files are in the folder. */
int stage_count_files(const stage *s);
