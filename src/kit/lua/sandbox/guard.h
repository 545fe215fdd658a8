/* Limits of a Lua state: memory, steps, time and printed bytes.
 *
 *   begin ... the script runs ... end          begin: a load, a frame, a call of a procedure
 *     every STRIDE instructions  --hook--> steps and clock are compared with the limits
 *     long C functions           --cs_guard_charge--> the same
 *     each allocation            --> Lua's bytes and the scene's are compared with the limit
 *     the limit of time + GRACE  --watchdog thread--> the process ends: nothing else stops a C call
 *
 * INVARIANT: an exceeded limit stays exceeded until the outermost call ends: the hook then fires at
 * every instruction, and pcall, xpcall and resume of this folder propagate it. So no script can
 * continue after it or catch it. The same holds for a lack of memory. If a function of the core has
 * hidden an exceeded limit, the call fails at its end (cs_lua_error_settle).
 *
 * Steps are instructions of the Lua virtual machine, and the charges of C functions for their work;
 * they do not depend on the computer. They are counted per load or frame. Time is measured for each
 * outermost call: processor time, so that a script on a busy machine does not fail, and ten times
 * as much time by the clock, so that a script that waits ends, too.
 */
#pragma once

#include <lua.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <time.h>

#include "celspan/lua.h"
#include "lua/bind/host.h"

typedef struct cs_guard {
  celspan_lua_limits limits; /* without folders */
  celspan_context *context;  /* borrowed; its memory counts too; NULL before cs_guard_attach */
  lua_State *L;              /* the main thread; NULL before cs_guard_attach */
  lua_Alloc below;           /* the previous allocator of the state, and its first argument */
  void *below_user;
  void (*ended)(struct cs_guard *guard); /* called after the last block of the state was freed */
  bool has_options;                      /* messages name options of the program */
  /* bytes of Lua; `told`: the bytes that the memory of the context knows, exact up to PIECE */
  size_t bytes, told;
  int depth;               /* the number of nested calls into the script */
  cs_account_kind account; /* the account of the thread before the outermost call */
  bool is_verb;            /* the outermost call is of a verb */
  bool is_refused;         /* Lua was refused memory in this call */
  bool is_scene_refused;   /* the scene was refused memory in this call */
  int refused_line;        /* the line at which that happened; 0: not known */
  char refused_in[LUA_IDSIZE];
  char reason[256]; /* why the other limit refused memory last; "": it did not */
  /* steps in this frame; the number of steps when the clock was last read */
  uint64_t steps, checked;
  size_t printed;
  char tripped[CS_ERROR_SIZE]; /* the sentence of the exceeded limit; "": none */
  /* The beginning of the call in nanoseconds: by the monotonic clock (0: time is not measured), and
   * by the processor clock of the call's thread. Written by this thread, and also read by the
   * watchdog. */
  _Atomic(int64_t) begun, begun_processor;
  _Atomic(clockid_t) processor_clock;
  bool has_watchdog, is_finished;
  pthread_t watchdog;
  pthread_mutex_t lock; /* protects is_finished */
  pthread_cond_t finished;
} cs_guard;

/* Starts without a state. */
void cs_guard_init(cs_guard *guard, const celspan_lua_limits *limits);
/* The state must have been closed, or never attached. */
void cs_guard_finish(cs_guard *guard);
/* Attaches the main thread of a state, and all coroutines that are created later. From now on the
 * guard is the allocator of the state, in front of the state's previous allocator. */
void cs_guard_attach(cs_guard *guard, lua_State *L, celspan_context *context);
/* Called if the context ends before the state. */
void cs_guard_detach(cs_guard *guard);
/* Words about an option, if the program runs the script; otherwise "". */
const char *cs_guard_hint(const cs_guard *guard, const char *words);

/* The account of this thread: cs_memory.account of a program. */
cs_account *cs_guard_account(void);

/* The guard of a state, or NULL. */
cs_guard *cs_guard_of(lua_State *L);

/* Begins a call. Returns whether the call has its own limits, because it is not inside another call
 * that has limits. */
bool cs_guard_begin(cs_guard *guard, lua_State *L, cs_host_call call);
void cs_guard_end(cs_guard *guard);

/* Counts work of C functions as steps. Raises an error when a limit is exceeded. */
void cs_guard_charge(lua_State *L, uint64_t steps);
/* Counts printed bytes, and passes them to the host. Raises an error when a limit is exceeded. */
void cs_guard_print(lua_State *L, const char *text, size_t size);

/* Called when there was no memory, as the message says. In a call into the script, raises this
 * message, or the message about the limit of memory if this limit was the reason. Like an exceeded
 * limit, it ends the outermost call. */
void cs_guard_starve(lua_State *L, const char *sentence);

/* The sentence of the limit that ended a call; NULL: no limit ended it. The result of lua_pcall and
 * the message (NULL: not a string) are those of the call. */
const char *cs_guard_limit(cs_guard *guard, int outcome, const char *message);
/* After a failed call, with its message on top: raises the exceeded limit again, if there is
 * one. */
void cs_guard_pass(lua_State *L, int outcome);

/* pcall and xpcall that propagate limits. */
int cs_guard_pcall(lua_State *L);
int cs_guard_xpcall(lua_State *L);
