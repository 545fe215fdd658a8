/* Limits of a Lua state: memory, steps, time and what is printed.
 *
 *   begin ... the script runs ... end          begin: a load, a frame, a call of a procedure
 *     every STRIDE instructions  --hook--> steps and clock are compared with the limits
 *     long C functions           --cs_guard_charge--> the same
 *     each allocation            --> Lua's bytes and the scene's are compared with the limit
 *     deadline + GRACE seconds   --watchdog thread--> the process ends: nothing else stops a C call
 *
 * INVARIANT: a limit that was hit stays hit until the outermost call ends: the hook then fires at
 * every instruction, and the pcall, xpcall and resume of this room pass it on. So no script goes on
 * after it, and none can catch it.
 *
 * Steps are instructions of Lua's machine, and what C functions charge for their work; they do not
 * depend on the machine. They are counted from the beginning of a load or frame; the clock counts
 * each outermost call by itself.
 */
#ifndef CS_SANDBOX_GUARD_H
#define CS_SANDBOX_GUARD_H

#include <lua.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "bind/host.h"
#include "celspan/celspan.h"

/* 0: without limit */
typedef struct cs_limits {
  size_t memory;  /* bytes */
  uint64_t steps; /* in a load or a frame */
  double seconds; /* in one call into the script */
  size_t print;   /* bytes in a load or a frame */
} cs_limits;

#define CS_LIMITS_DEFAULT                                                                          \
  (cs_limits) { (size_t)512 << 20, UINT64_C(2000000000), 60, (size_t)1 << 20 }

typedef struct cs_guard {
  cs_limits limits;
  celspan_context *context; /* borrowed; its memory counts too; NULL until cs_guard_attach */
  lua_State *L;             /* the main thread; NULL until cs_guard_attach */
  /* Called where a script may be ended for another reason, which is then what the hook raises;
   * NULL: there is none. */
  bool (*is_interrupted)(void);
  /* Called by the watchdog thread with the sentence; ends the process. */
  void (*kill)(const char *sentence);
  size_t bytes;          /* of Lua */
  int depth;             /* of calls into the script */
  bool is_verb;          /* the outermost is of a verb */
  bool is_refused;       /* memory was, to Lua, in this call */
  bool is_scene_refused; /* likewise, to the scene */
  int refused_line;      /* where, if it is known; 0 */
  char refused_in[LUA_IDSIZE];
  uint64_t steps, checked; /* in this frame; of them at the last look at the clock */
  size_t printed;
  char tripped[256];         /* the sentence of the limit that was hit; "": none */
  _Atomic(int64_t) deadline; /* of the call, in nanoseconds of the monotonic clock; 0: none */
  bool has_watchdog, is_finished;
  pthread_t watchdog;
  pthread_mutex_t lock; /* of is_finished */
  pthread_cond_t finished;
} cs_guard;

/* Begins without a state, which is made with the guard's allocator. */
void cs_guard_init(cs_guard *guard, const cs_limits *limits);
/* The state must be closed. */
void cs_guard_finish(cs_guard *guard);
/* lua_Alloc; user: the guard. */
void *cs_guard_allocate(void *user, void *storage, size_t old_size, size_t new_size);
/* The state's main thread belongs to this guard, and so do all coroutines that are made later. */
void cs_guard_attach(cs_guard *guard, lua_State *L, celspan_context *context);

/* The guard of this state; NULL: it has none. */
cs_guard *cs_guard_of(lua_State *L);

/* Whether the call has limits of its own, and is not part of one that has. */
bool cs_guard_begin(cs_guard *guard, lua_State *L, cs_host_call call);
void cs_guard_end(cs_guard *guard);

/* Counts work that is no instruction; raises when a limit is hit. */
void cs_guard_charge(lua_State *L, uint64_t steps);
/* Counts what is printed; raises when a limit is hit. */
void cs_guard_print(lua_State *L, size_t bytes);

/* The sentence of the limit that made a call end with this outcome of lua_pcall and this message
 * (NULL: no text); NULL: none did. */
const char *cs_guard_limit(cs_guard *guard, int outcome, const char *message);
/* After a failed call whose message is on top: raises the limit that was hit again, if one was. */
void cs_guard_pass(lua_State *L, int outcome);

/* pcall and xpcall that pass on limits. */
int cs_guard_pcall(lua_State *L);
int cs_guard_xpcall(lua_State *L);

#endif
