#include "lua/sandbox/guard.h"

#include <lauxlib.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/context.h"
#include "base/thread_pool.h"
#include "lua/bind/caller.h"
#include "lua/bind/lua_error.h"

enum {
  STRIDE = 1000,       /* instructions between two calls of the hook */
  CLOCK_STEPS = 20000, /* steps that C functions charge between two readings of the clock */
  POLL = 100000000     /* nanoseconds between two checks of the watchdog */
};
#define SECOND INT64_C(1000000000)
#define GRACE (SECOND) /* after the deadline, before the process is ended */

static int64_t now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (int64_t)t.tv_sec * SECOND + t.tv_nsec;
}

/* New threads of a Lua state copy the extra space of the main thread. */
cs_guard *cs_guard_of(lua_State *L) { return *(cs_guard **)lua_getextraspace(L); }

void cs_guard_init(cs_guard *guard, const cs_limits *limits) {
  *guard = (cs_guard){.limits = *limits};
}

/* ---------------------------------------------------------------- memory */

/* The current position in the script; for a coroutine, the place of its resume. */
static void note_refusal(cs_guard *guard) {
  lua_Debug info;
  for (int level = 0; guard->L && lua_getstack(guard->L, level, &info); level++) {
    lua_getinfo(guard->L, "Sl", &info);
    if (info.currentline <= 0 || strncmp(info.source, "@celspan/", 9) == 0)
      continue;
    guard->refused_line = info.currentline;
    snprintf(guard->refused_in, sizeof guard->refused_in, "%s", info.short_src);
    return;
  }
}

static bool is_too_much(const cs_guard *guard, size_t more) {
  size_t most = guard->limits.memory;
  return most && (more > most ||
                  guard->bytes + cs_account_scene_bytes(guard->context->memory) > most - more);
}

void *cs_guard_allocate(void *user, void *storage, size_t old_size, size_t new_size) {
  cs_guard *guard = user;
  size_t before = storage ? old_size : 0; /* without a block it is the kind of object */
  if (new_size > before && guard->depth > 0 && is_too_much(guard, new_size - before)) {
    guard->is_refused = true;
    note_refusal(guard);
    return NULL;
  }
  void *resized = new_size ? realloc(storage, new_size) : NULL;
  if (!new_size)
    free(storage);
  if (resized || !new_size)
    guard->bytes += new_size - before;
  return resized;
}

/* The guard of the script call in this thread; NULL: there is none. Workers that render at the same
 * time do not count for the script. */
static _Thread_local cs_guard *entered;

cs_account *cs_guard_account(void) {
  static _Thread_local cs_account account;
  return &account;
}

static bool refuses_scene(const cs_memory *memory, size_t more) {
  if (!entered || entered->context->memory != memory || !is_too_much(entered, more))
    return false;
  entered->is_scene_refused = true;
  note_refusal(entered);
  return true;
}

/* ---------------------------------------------------------------- tripping */

static void count_hook(lua_State *L, lua_Debug *where);

static bool has_hook(const cs_guard *guard) {
  return guard->limits.steps || guard->limits.seconds > 0 || guard->is_interrupted;
}

static void set_hook(const cs_guard *guard, lua_State *L) {
  if (guard->tripped[0])
    lua_sethook(L, count_hook, LUA_MASKCOUNT, 1);
  else if (has_hook(guard))
    lua_sethook(L, count_hook, LUA_MASKCOUNT, STRIDE);
}

/* Raises the sentence, by which lua/bind/host.h finds the status. */
static void raise_limit(lua_State *L, cs_guard *guard) {
  set_hook(guard, L);
  if (strcmp(guard->tripped, "interrupted") == 0)
    luaL_error(L, "interrupted");
  if (!cs_lua_error_position(guard->tripped))
    cs_caller_error(L, "%s", guard->tripped);
  lua_pushstring(L, guard->tripped);
  lua_error(L);
}

static void trip_steps(cs_guard *guard) {
  snprintf(guard->tripped, sizeof guard->tripped,
           "more than %llu step%s in a frame (--limit steps=N allows more)",
           (unsigned long long)guard->limits.steps, guard->limits.steps == 1 ? "" : "s");
}

static void tell_time(const cs_guard *guard, char *sentence, size_t size) {
  double seconds = guard->limits.seconds;
  snprintf(sentence, size,
           "the script ran for more than %g second%s (--limit time=SECONDS allows more)", seconds,
           seconds == 1 ? "" : "s");
}

static void trip_time(cs_guard *guard) { tell_time(guard, guard->tripped, sizeof guard->tripped); }

static void trip_memory(cs_guard *guard) {
  bool is_large = guard->limits.memory >= (size_t)1 << 20;
  int length = guard->refused_line ? snprintf(guard->tripped, sizeof guard->tripped,
                                              "%s:%d: ", guard->refused_in, guard->refused_line)
                                   : 0;
  snprintf(guard->tripped + length, sizeof guard->tripped - (size_t)length,
           "the script needs more than %zu %s (--limit memory=SIZE allows more)",
           guard->limits.memory >> (is_large ? 20 : 10), is_large ? "MiB" : "KiB");
}

/* Compares with the limits and raises an error when one is exceeded. */
static void check(lua_State *L, cs_guard *guard) {
  guard->checked = guard->steps;
  int64_t deadline = atomic_load_explicit(&guard->deadline, memory_order_relaxed);
  if (guard->is_interrupted && guard->is_interrupted())
    snprintf(guard->tripped, sizeof guard->tripped, "interrupted");
  else if (guard->limits.steps && guard->steps > guard->limits.steps)
    trip_steps(guard);
  else if (deadline && now() > deadline)
    trip_time(guard);
  if (guard->tripped[0])
    raise_limit(L, guard);
}

static void count_hook(lua_State *L, lua_Debug *where) {
  (void)where;
  cs_guard *guard = cs_guard_of(L);
  if (guard->depth == 0)
    return;
  if (guard->tripped[0])
    raise_limit(L, guard);
  if (lua_gethookcount(L) == 1) /* a coroutine that an earlier limit interrupted */
    set_hook(guard, L);
  guard->steps += STRIDE;
  check(L, guard);
}

void cs_guard_charge(lua_State *L, uint64_t steps) {
  cs_guard *guard = cs_guard_of(L);
  if (!guard || guard->depth == 0)
    return;
  guard->steps += steps;
  if (guard->tripped[0])
    raise_limit(L, guard);
  if (guard->steps - guard->checked > CLOCK_STEPS)
    check(L, guard);
}

bool cs_guard_print(lua_State *L, size_t bytes) {
  cs_guard *guard = cs_guard_of(L);
  guard->printed += bytes;
  if (!guard->limits.print || guard->printed <= guard->limits.print)
    return !guard->is_silent;
  snprintf(guard->tripped, sizeof guard->tripped,
           "more than %zu KiB printed in a frame (--limit print=SIZE allows more)",
           guard->limits.print >> 10);
  raise_limit(L, guard);
  return false;
}

void cs_guard_starve(lua_State *L, const char *sentence) {
  cs_guard *guard = cs_guard_of(L);
  if (!guard || guard->depth == 0)
    return;
  if (guard->is_scene_refused)
    trip_memory(guard);
  else
    snprintf(guard->tripped, sizeof guard->tripped, "%s", sentence);
  raise_limit(L, guard);
}

/* ---------------------------------------------------------------- calls */

void cs_guard_attach(cs_guard *guard, lua_State *L, celspan_context *context) {
  guard->L = L;
  guard->context = context;
  context->memory->refuses = refuses_scene;
  context->memory->account = cs_guard_account;
  *(cs_guard **)lua_getextraspace(L) = guard;
  set_hook(guard, L);
}

static void kill_late(cs_guard *guard) {
  char sentence[160];
  int64_t deadline = atomic_load_explicit(&guard->deadline, memory_order_relaxed);
  if (!deadline || now() <= deadline + GRACE)
    return;
  tell_time(guard, sentence, sizeof sentence);
  guard->kill(sentence);
}

static void *watch(void *user) {
  cs_guard *guard = user;
  pthread_mutex_lock(&guard->lock);
  while (!guard->is_finished) {
    struct timespec until;
    clock_gettime(CLOCK_MONOTONIC, &until);
    until.tv_nsec += POLL;
    until.tv_sec += until.tv_nsec / SECOND;
    until.tv_nsec %= SECOND;
    pthread_cond_timedwait(&guard->finished, &guard->lock, &until);
    kill_late(guard);
  }
  pthread_mutex_unlock(&guard->lock);
  return NULL;
}

/* Without this thread only the hook ends scripts. It blocks signals, which are for the main
 * thread. */
static void start_watchdog(cs_guard *guard) {
  sigset_t all, before;
  pthread_condattr_t attributes;
  pthread_condattr_init(&attributes);
  pthread_condattr_setclock(&attributes, CLOCK_MONOTONIC);
  pthread_mutex_init(&guard->lock, NULL);
  pthread_cond_init(&guard->finished, &attributes);
  pthread_condattr_destroy(&attributes);
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  guard->has_watchdog = cs_thread_create(&guard->watchdog, watch, guard) == 0;
  pthread_sigmask(SIG_SETMASK, &before, NULL);
  if (!guard->has_watchdog)
    guard->kill = NULL;
}

void cs_guard_finish(cs_guard *guard) {
  if (!guard->has_watchdog)
    return;
  pthread_mutex_lock(&guard->lock);
  guard->is_finished = true;
  pthread_cond_signal(&guard->finished);
  pthread_mutex_unlock(&guard->lock);
  pthread_join(guard->watchdog, NULL);
  pthread_cond_destroy(&guard->finished);
  pthread_mutex_destroy(&guard->lock);
  guard->has_watchdog = false;
}

static void set_deadline(cs_guard *guard) {
  if (!(guard->limits.seconds > 0))
    return;
  if (!guard->has_watchdog && guard->kill)
    start_watchdog(guard);
  atomic_store_explicit(&guard->deadline, now() + (int64_t)(guard->limits.seconds * SECOND),
                        memory_order_relaxed);
}

bool cs_guard_begin(cs_guard *guard, lua_State *L, cs_host_call call) {
  int depth = guard->depth++;
  if (depth > 0 && !(depth == 1 && guard->is_verb && call == CS_HOST_FRAME))
    return false;
  guard->is_verb = guard->is_verb || call == CS_HOST_VERB;
  entered = guard;
  if (depth == 0)
    guard->account = cs_account_set(guard->context->memory, CS_ACCOUNT_SCRIPT);
  guard->tripped[0] = '\0';
  guard->is_refused = guard->is_scene_refused = false;
  guard->refused_line = 0;
  if (call != CS_HOST_PROCEDURE)
    guard->steps = guard->checked = guard->printed = 0;
  set_hook(guard, L);
  set_deadline(guard);
  return true;
}

void cs_guard_end(cs_guard *guard) {
  if (--guard->depth > 0)
    return;
  entered = NULL;
  cs_account_set(guard->context->memory, guard->account);
  guard->is_verb = false;
  atomic_store_explicit(&guard->deadline, 0, memory_order_relaxed);
}

/* ---------------------------------------------------------------- catching */

/* When an allocation fails, Lua collects garbage and tries again, so a failure alone means little.
 * The auxiliary library raises its own message in place of Lua's memory error. */
static bool is_of_memory(const cs_guard *guard, int outcome, const char *message) {
  bool is_lua = outcome == LUA_ERRMEM || (message && strstr(message, "not enough memory"));
  return guard->is_scene_refused || (guard->is_refused && is_lua);
}

const char *cs_guard_limit(cs_guard *guard, int outcome, const char *message) {
  if (!guard->tripped[0] && is_of_memory(guard, outcome, message))
    trip_memory(guard);
  return guard->tripped[0] ? guard->tripped : NULL;
}

void cs_guard_pass(lua_State *L, int outcome) {
  cs_guard *guard = cs_guard_of(L);
  const char *sentence = guard ? cs_guard_limit(guard, outcome, lua_tostring(L, -1)) : NULL;
  if (!sentence && guard && cs_lua_error_is_memory(L, outcome))
    lua_error(L); /* of the system: what a script makes must not depend on it */
  if (!sentence)
    return;
  set_hook(guard, L);
  if (outcome == LUA_ERRMEM || !lua_isstring(L, -1)) {
    lua_pop(L, 1);
    lua_pushstring(L, sentence);
  }
  lua_error(L);
}

/* true ... | false, message. `before`: values of the stack below the results. */
static int finish(lua_State *L, int outcome, lua_KContext before) {
  if (outcome == LUA_OK || outcome == LUA_YIELD)
    return lua_gettop(L) - (int)before;
  cs_guard_pass(L, outcome);
  lua_pushboolean(L, 0);
  lua_insert(L, -2);
  return 2;
}

int cs_guard_pcall(lua_State *L) {
  luaL_checkany(L, 1);
  lua_pushboolean(L, 1);
  lua_insert(L, 1);
  return finish(L, lua_pcallk(L, lua_gettop(L) - 2, LUA_MULTRET, 0, 0, finish), 0);
}

/* upvalue 1: the script's handler, which is not called for limits. */
static int handle(lua_State *L) {
  const cs_guard *guard = cs_guard_of(L);
  lua_settop(L, 1);
  if (guard && guard->tripped[0])
    return 1;
  lua_pushvalue(L, lua_upvalueindex(1));
  lua_insert(L, 1);
  lua_call(L, 1, 1);
  return 1;
}

int cs_guard_xpcall(lua_State *L) {
  int count = lua_gettop(L);
  luaL_checktype(L, 2, LUA_TFUNCTION);
  lua_pushvalue(L, 2);
  lua_pushcclosure(L, handle, 1);
  lua_replace(L, 2);
  lua_pushboolean(L, 1);
  lua_pushvalue(L, 1);
  lua_rotate(L, 3, 2); /* f, handler, true, f, arguments */
  return finish(L, lua_pcallk(L, count - 2, LUA_MULTRET, 2, 2, finish), 2);
}
