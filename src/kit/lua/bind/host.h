/* The one context of a Lua state, and the state that outlives single calls.
 *
 * INVARIANT: a host is reference counted. The Lua state has one reference until it closes, and
 * every scan-line procedure has one, because objects may outlive their state. After closing,
 * `state` and `context` are NULL, and Lua is not called any more.
 */
#pragma once

#include <lua.h>

#include "inside/context.h"

/* Why the script is called. Frames that the Lua of a verb builds have their own limits. */
typedef enum cs_host_call {
  CS_HOST_LOAD,      /* the script itself is run */
  CS_HOST_FRAME,     /* a frame is built */
  CS_HOST_PROCEDURE, /* a part of a frame that was built before */
  CS_HOST_VERB       /* Lua of the command line works on the values of the script */
} cs_host_call;

/* The questions that the bindings ask a sandbox, on the thread that runs Lua. `user` is the first
 * argument of every function. */
typedef struct cs_host_rules {
  void *user;
  /* Before and after a call into the script; calls may be nested. number: of the frame; else 0. */
  void (*begin)(void *user, lua_State *L, cs_host_call call, int64_t number);
  void (*end)(void *user);
  /* Whether the script may read the file or folder at this path; the answer does not depend on
   * whether it exists. NULL: it may read all. */
  bool (*admits)(void *user, const char *path);
  /* Raises an error if the script may not read there. */
  void (*admit)(void *user, lua_State *L, const char *path);
  /* Allows the script to read below this folder, too. false: this cannot be noted. NULL: it is not
   * needed. */
  bool (*allow)(void *user, const char *folder);
  /* Whether the script may write to this path. If not, the message that refuses it is in the
   * context. NULL: it may write everywhere. */
  bool (*may_write)(void *user, lua_State *L, const char *path);
  /* The sentence of the limit that ended a call; NULL: no limit ended it. The outcome of lua_pcall
   * and the message (NULL: not a text) are those of the call. */
  const char *(*limit)(void *user, int outcome, const char *message);
  /* Counts work of C functions as steps. Raises an error when a limit is exceeded. NULL: work is
   * not counted. */
  void (*charge)(void *user, lua_State *L, uint64_t steps);
  /* Raises the message that there was no memory, or the message about the exceeded limit, in a way
   * that no script can catch. */
  void (*starve)(void *user, lua_State *L, const char *sentence);
  /* The state is closed, and the context with it. */
  void (*close)(void *user);
} cs_host_rules;

typedef struct cs_host {
  size_t references;
  cs_memory *memory; /* counted; the memory of the context */
  lua_State *state;  /* the thread that Lua callbacks run on */
  celspan_context *context;
  bool owns_context;
  celspan_status failure; /* of the last core call that failed; its sentence is in the context */
  const cs_host_rules *rules; /* borrowed; NULL: the state has no sandbox and no limits */
} cs_host;

/* Makes the host of this state if it has none. context: NULL: a new one is made; otherwise it is
 * borrowed, and must outlive the state. Raises if there is no memory. */
void cs_host_open(lua_State *L, celspan_context *context);
/* The host; NULL when the state has none or is closing. Never raises. */
cs_host *cs_host_find(lua_State *L);
/* The same, but raises an error if there is none. */
cs_host *cs_host_get(lua_State *L);
celspan_context *cs_host_context(lua_State *L);
void cs_host_unref(cs_host *host);

/* Callbacks run on L until cs_host_leave is called with the result of cs_host_enter. */
lua_State *cs_host_enter(lua_State *L);
void cs_host_leave(lua_State *L, lua_State *before);

/* Raises the context's sentence at the caller's line, "noun: sentence", unless status is OK. */
void cs_host_try(lua_State *L, const char *noun, celspan_status status);
/* Pushes nil and the context's message, for a function that returns errors in this way. A script
 * that raises the message raises it with this status. Returns 2, the number of pushed values. In a
 * sandbox a lack of memory is raised instead, as by cs_host_try: the results of a script must not
 * depend on it. */
int cs_host_fail(lua_State *L, celspan_status status);
/* Ends a function in this way if a call fails. */
#define CS_HOST_TRY(L, call)                                                                       \
  do {                                                                                             \
    celspan_status try_status_ = (call);                                                           \
    if (try_status_ != CELSPAN_OK)                                                                 \
      return cs_host_fail(L, try_status_);                                                         \
  } while (0)
/* The same as cs_host_fail, for a reader: what is too large or too deep for it is a fault of the
 * file (INPUT). */
int cs_host_fail_input(lua_State *L, celspan_status status);
/* The status of a message that was raised: the core's own when the message contains the core's
 * sentence, else CALLBACK. */
celspan_status cs_host_blame(lua_State *L, const char *message);

/* Before and after a call into the script; without rules nothing happens. */
void cs_host_begin(lua_State *L, cs_host_call call, int64_t number);
void cs_host_end(lua_State *L);
/* Counts work of C functions as steps of the script. Raises. */
void cs_host_charge(lua_State *L, uint64_t steps);
/* Whether the script may read at this path. */
bool cs_host_admits(lua_State *L, const char *path);
/* Raises an error unless the script may read at this path. It is called before the file is examined
 * in any way, even for its existence. */
void cs_host_admit(lua_State *L, const char *path);
/* Notes a file that was read because another file names it. Raises without memory. */
void cs_host_remember(lua_State *L, const char *path);
/* Whether a sandbox restricts the files that scripts read and write, and the functions that they
 * call. */
bool cs_host_confines(lua_State *L);
/* Lets the script read below a folder. Raises. */
void cs_host_allow(lua_State *L, const char *folder);
/* Whether the script may write there; else the sentence is in the context. */
bool cs_host_may_write(lua_State *L, const char *path);

/* From now on, the paths that the script asks to read are remembered, whether they exist or not. */
void cs_host_remember_asked(lua_State *L);
/* Pushes the list of paths that were remembered since the last call. Each path is also a key: its
 * value says whether the script was allowed to read there. Raises. */
void cs_host_push_asked(lua_State *L);

/* The folder of the script that the host runs; "" is the current directory. */
void cs_host_set_folder(lua_State *L, const char *folder);
/* Pushes this folder. If no script is run, returns false and pushes nothing. */
bool cs_host_push_folder(lua_State *L);
