#include "lua/sandbox/guard.h"

#include <lauxlib.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "inside/context.h"
#include "inside/threads.h"
#include "lua/bind/caller.h"
#include "lua/bind/lua_error.h"

enum {
  STRIDE = 1000,       /* instructions between two calls of the hook */
  CLOCK_STEPS = 20000, /* steps that C functions charge between two readings of the clock */
  PIECE = 65536,       /* bytes of Lua that are not yet counted in the memory of the whole run */
  WAITING = 10,        /* how many times the limit of time may pass by the clock */
  POLL = 100000000     /* nanoseconds between two checks of the watchdog */
};
#define SECOND INT64_C(1000000000)
#define GRACE (SECOND) /* the time between the limit and the end of the process */

/* Returns 0 if the thread of the clock has ended. */
static int64_t read_clock(clockid_t clock) {
  struct timespec t;
  return clock_gettime(clock, &t) == 0 ? (int64_t)t.tv_sec * SECOND + t.tv_nsec : 0;
}

void cs_guard_init(cs_guard *guard, const celspan_lua_limits *limits) {
  *guard = (cs_guard){.limits = *limits};
}

const char *cs_guard_hint(const cs_guard *guard, const char *words) {
  return guard->has_options ? words : "";
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

/* Bytes held for the script: Lua's and the scene's. */
static size_t held(const cs_guard *guard) {
  return guard->bytes + cs_account_scene_bytes(guard->context->memory);
}

static bool is_too_much(const cs_guard *guard, size_t more) {
  size_t most = guard->limits.memory;
  return most && (more > most || held(guard) > most - more);
}

typedef enum verdict { ALLOWED, ENDS_SCRIPT, IS_REFUSED } verdict;

/* If the whole run has no room left, the script is the cause if it holds at least half of the
 * memory. is_piece: the request is so small that the limit of the run is not checked yet. */
static verdict judge(cs_guard *guard, size_t more, bool is_piece) {
  cs_memory *memory = guard->context->memory;
  if (guard->depth > 0 && is_too_much(guard, more)) {
    guard->reason[0] = '\0';
    return ENDS_SCRIPT;
  }
  if (is_piece || cs_account_allows(memory, more))
    return ALLOWED;
  bool is_its = guard->depth > 0 && held(guard) >= cs_account_bytes(memory) / 2 &&
                cs_account_tell(memory, guard->reason, sizeof guard->reason);
  return is_its ? ENDS_SCRIPT : IS_REFUSED;
}

/* When the state ends, the count must be exact, so that later states do not begin with a
 * remainder. */
static void count_bytes(cs_guard *guard, size_t change) {
  guard->bytes += change;
  bool is_near = guard->bytes <= guard->told + PIECE && guard->told <= guard->bytes + PIECE;
  if (!guard->context || (is_near && guard->bytes > 0))
    return;
  cs_account_beside(guard->context->memory, guard->bytes - guard->told);
  guard->told = guard->bytes;
}

/* lua_Alloc; user: the guard. */
static void *allocate(void *user, void *storage, size_t old_size, size_t new_size) {
  cs_guard *guard = user;
  size_t before = storage ? old_size : 0; /* without a block, old_size is the kind of object */
  verdict found = ALLOWED;
  if (new_size > before && guard->context)
    found =
        judge(guard, new_size - before, guard->bytes + (new_size - before) <= guard->told + PIECE);
  if (found == ENDS_SCRIPT) {
    guard->is_refused = true;
    note_refusal(guard);
  }
  if (found != ALLOWED)
    return NULL;
  void *resized = guard->below(guard->below_user, storage, old_size, new_size);
  if (resized || !new_size)
    count_bytes(guard, new_size - before);
  if (guard->bytes == 0) /* the state has been closed */
    guard->ended(guard);
  return resized;
}

cs_guard *cs_guard_of(lua_State *L) {
  void *user;
  return lua_getallocf(L, &user) == allocate ? user : NULL;
}

/* The guard of the script call in this thread; NULL: there is none. Workers that render at the same
 * time do not count for the script. */
static _Thread_local cs_guard *entered;

cs_account *cs_guard_account(void) {
  static _Thread_local cs_account account;
  return &account;
}

static bool refuses_scene(const cs_memory *memory, size_t more) {
  if (!entered || entered->context->memory != memory || judge(entered, more, false) != ENDS_SCRIPT)
    return false;
  entered->is_scene_refused = true;
  note_refusal(entered);
  return true;
}

/* ---------------------------------------------------------------- tripping */

static void count_hook(lua_State *L, lua_Debug *where);

static bool has_hook(const cs_guard *guard) {
  return guard->limits.steps || guard->limits.seconds > 0 || guard->limits.is_interrupted;
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
  snprintf(guard->tripped, sizeof guard->tripped, "more than %llu step%s in a frame%s",
           (unsigned long long)guard->limits.steps, guard->limits.steps == 1 ? "" : "s",
           cs_guard_hint(guard, " (--limit steps=N allows more)"));
}

typedef enum lateness { IN_TIME, RAN, WAITED } lateness;

/* A thread uses no more time of a processor than passes: so its clock, which is slower to read, is
 * only read late. */
static lateness find_lateness(const cs_guard *guard, int64_t grace) {
  double limit = guard->limits.seconds * SECOND + (double)grace;
  int64_t begun = atomic_load_explicit(&guard->begun, memory_order_relaxed);
  double passed = begun ? (double)(read_clock(CLOCK_MONOTONIC) - begun) : 0;
  if (passed <= limit)
    return IN_TIME;
  clockid_t clock = atomic_load_explicit(&guard->processor_clock, memory_order_relaxed);
  int64_t from = atomic_load_explicit(&guard->begun_processor, memory_order_relaxed);
  return (double)(read_clock(clock) - from) > limit ? RAN
         : passed > WAITING * limit                 ? WAITED
                                                    : IN_TIME;
}

static void tell_time(const cs_guard *guard, lateness how, char *sentence, size_t size) {
  double seconds = guard->limits.seconds;
  if (how == RAN)
    snprintf(sentence, size, "the script ran for more than %g second%s%s", seconds,
             seconds == 1 ? "" : "s", cs_guard_hint(guard, " (--limit time=SECONDS allows more)"));
  else
    snprintf(sentence, size, "the script waited, or was kept waiting, for more than %g seconds%s",
             WAITING * seconds, cs_guard_hint(guard, " (ten times --limit time=SECONDS)"));
}

static void trip_memory(cs_guard *guard) {
  bool is_large = guard->limits.memory >= (size_t)1 << 20;
  int length = guard->refused_line ? snprintf(guard->tripped, sizeof guard->tripped,
                                              "%s:%d: ", guard->refused_in, guard->refused_line)
                                   : 0;
  char *rest = guard->tripped + length;
  size_t size = sizeof guard->tripped - (size_t)length;
  if (guard->reason[0])
    snprintf(rest, size, "the script needs more memory than there is: %s", guard->reason);
  else
    snprintf(rest, size, "the script needs more than %zu %s%s",
             guard->limits.memory >> (is_large ? 20 : 10), is_large ? "MiB" : "KiB",
             cs_guard_hint(guard, " (--limit memory=SIZE allows more)"));
}

/* Compares the counts with the limits, and raises an error if one is exceeded. */
static void check(lua_State *L, cs_guard *guard) {
  guard->checked = guard->steps;
  lateness late = IN_TIME;
  if (guard->limits.is_interrupted && guard->limits.is_interrupted(guard->limits.user))
    snprintf(guard->tripped, sizeof guard->tripped, "interrupted");
  else if (guard->limits.steps && guard->steps > guard->limits.steps)
    trip_steps(guard);
  else if ((late = find_lateness(guard, 0)) != IN_TIME)
    tell_time(guard, late, guard->tripped, sizeof guard->tripped);
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
  if (lua_gethookcount(L) == 1) /* the hook of a coroutine that an earlier limit interrupted */
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

void cs_guard_print(lua_State *L, const char *text, size_t size) {
  cs_guard *guard = cs_guard_of(L);
  const celspan_lua_limits *limits = &guard->limits;
  guard->printed += size;
  if (limits->print && guard->printed > limits->print) {
    snprintf(guard->tripped, sizeof guard->tripped, "more than %zu KiB printed in a frame%s",
             limits->print >> 10, cs_guard_hint(guard, " (--limit print=SIZE allows more)"));
    raise_limit(L, guard);
  }
  if (limits->printed)
    limits->printed(limits->user, text, size);
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
  guard->below = lua_getallocf(L, &guard->below_user);
  guard->bytes = ((size_t)lua_gc(L, LUA_GCCOUNT) << 10) + (size_t)lua_gc(L, LUA_GCCOUNTB);
  context->memory->refuses = refuses_scene;
  context->memory->account = cs_guard_account;
  cs_account_beside(context->memory, guard->bytes);
  guard->told = guard->bytes;
  lua_setallocf(L, allocate, guard);
  set_hook(guard, L);
}

void cs_guard_detach(cs_guard *guard) {
  cs_account_beside(guard->context->memory, 0 - guard->told);
  guard->context = NULL;
}

static void kill_late(cs_guard *guard) {
  char sentence[160];
  lateness late = find_lateness(guard, GRACE);
  if (late == IN_TIME)
    return;
  tell_time(guard, late, sentence, sizeof sentence);
  guard->limits.overdue(guard->limits.user, sentence);
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

/* Without this thread, only the hook can end scripts. The thread blocks signals, which are for the
 * main thread. */
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
    guard->limits.overdue = NULL;
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

static void start_clocks(cs_guard *guard) {
  clockid_t clock;
  if (!(guard->limits.seconds > 0))
    return;
  if (!guard->has_watchdog && guard->limits.overdue)
    start_watchdog(guard);
  if (pthread_getcpuclockid(pthread_self(), &clock) != 0)
    clock = CLOCK_MONOTONIC;
  atomic_store_explicit(&guard->processor_clock, clock, memory_order_relaxed);
  atomic_store_explicit(&guard->begun_processor, read_clock(clock), memory_order_relaxed);
  atomic_store_explicit(&guard->begun, read_clock(CLOCK_MONOTONIC), memory_order_relaxed);
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
  guard->reason[0] = '\0';
  guard->refused_line = 0;
  if (call != CS_HOST_PROCEDURE)
    guard->steps = guard->checked = guard->printed = 0;
  set_hook(guard, L);
  start_clocks(guard);
  return true;
}

void cs_guard_end(cs_guard *guard) {
  if (--guard->depth > 0)
    return;
  entered = NULL;
  cs_account_set(guard->context->memory, guard->account);
  guard->is_verb = false;
  atomic_store_explicit(&guard->begun, 0, memory_order_relaxed);
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
    lua_error(L); /* a failure of the system: the results of a script must not depend on it */
  if (!sentence)
    return;
  set_hook(guard, L);
  if (outcome == LUA_ERRMEM || !lua_isstring(L, -1)) {
    lua_pop(L, 1);
    lua_pushstring(L, sentence);
  }
  lua_error(L);
}

/* true ... | false, message. before: the number of values on the stack below the results. */
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
