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
 * they do not depend on the computer. They are counted per load or frame. Time is measured per
 * outermost call: that of the processor, so that a script on a busy machine does not fail, and ten
 * times as much by the clock, so that one that waits ends, too.
 */
#pragma once

#include <lua.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <time.h>

#include "lua/bind/host.h"

/* 0: without limit */
typedef struct cs_limits {
  size_t memory;  /* bytes */
  uint64_t steps; /* in a load or a frame */
  double seconds; /* of the processor, in one call into the script */
  size_t print;   /* bytes in a load or a frame */
} cs_limits;

#define CS_LIMITS_DEFAULT                                                                          \
  (cs_limits) { (size_t)512 << 20, UINT64_C(2000000000), 60, (size_t)1 << 20 }

typedef struct cs_guard {
  cs_limits limits;
  celspan_context *context; /* borrowed; its memory counts too; NULL before cs_guard_attach */
  lua_State *L;             /* the main thread; NULL before cs_guard_attach */
  /* Whether the script must end for another reason, which the hook then raises; NULL: there is
   * none. */
  bool (*is_interrupted)(void);
  /* Called by the watchdog thread with the sentence; ends the process. */
  void (*kill)(const char *sentence);
  size_t bytes, told; /* of Lua; of those the memory of the context knows, within PIECE bytes */
  int depth;          /* of calls into the script */
  cs_account_kind account; /* of the thread before the outermost call */
  bool is_verb;            /* the outermost call is of a verb */
  bool is_refused;         /* memory, to Lua, in this call */
  bool is_scene_refused;   /* the same, to the scene */
  int refused_line;        /* where, if it is known; 0 */
  char refused_in[LUA_IDSIZE];
  char reason[256];        /* why it was refused last, where that limit was not; "" */
  uint64_t steps, checked; /* in this frame; at the last reading of the clock */
  size_t printed;
  bool is_silent;              /* what is printed is counted, and not shown */
  char tripped[CS_ERROR_SIZE]; /* the sentence of the exceeded limit; "": none */
  /* The beginning of the call, in nanoseconds of the monotonic clock, 0: nothing is measured; and
   * of the processor clock of its thread. Written by that thread, read by the watchdog, too. */
  _Atomic(int64_t) begun, begun_processor;
  _Atomic(clockid_t) processor_clock;
  bool has_watchdog, is_finished;
  pthread_t watchdog;
  pthread_mutex_t lock; /* of is_finished */
  pthread_cond_t finished;
} cs_guard;

/* Starts without a state; the state is created with the allocator of the guard. */
void cs_guard_init(cs_guard *guard, const cs_limits *limits);
/* The state must have been closed. */
void cs_guard_finish(cs_guard *guard);
/* lua_Alloc; user: the guard. */
void *cs_guard_allocate(void *user, void *storage, size_t old_size, size_t new_size);
/* Attaches the main thread of a state, and all coroutines that are created later. */
void cs_guard_attach(cs_guard *guard, lua_State *L, celspan_context *context);

/* The account of this thread: cs_memory.account of a program. */
cs_account *cs_guard_account(void);

/* The guard of a state, or NULL. */
cs_guard *cs_guard_of(lua_State *L);

/* Whether the call has limits of its own, because it is not inside a call that has. */
bool cs_guard_begin(cs_guard *guard, lua_State *L, cs_host_call call);
void cs_guard_end(cs_guard *guard);

/* Counts work of C functions as steps. Raises an error when a limit is exceeded. */
void cs_guard_charge(lua_State *L, uint64_t steps);
/* Counts printed bytes. Raises an error when a limit is exceeded. Whether they are shown. */
bool cs_guard_print(lua_State *L, size_t bytes);

/* There was no memory, as the sentence says: in a call into the script raises it, or that of the
 * limit of memory where that was the reason. Like an exceeded limit, it ends the outermost call. */
void cs_guard_starve(lua_State *L, const char *sentence);

/* The sentence of the limit that ended a call with this result of lua_pcall and this message (NULL:
 * not a string); NULL: no limit did. */
const char *cs_guard_limit(cs_guard *guard, int outcome, const char *message);
/* After a failed call, with its message on top: raises the exceeded limit again, if there is
 * one. */
void cs_guard_pass(lua_State *L, int outcome);

/* pcall and xpcall that propagate limits. */
int cs_guard_pcall(lua_State *L);
int cs_guard_xpcall(lua_State *L);
