#include "lua/bind/host.h"

#include <errno.h>
#include <lauxlib.h>
#include <string.h>

#include "inside/context.h"
#include "lua/bind/caller.h"

static const char host_key = 0; /* addresses in the registry */
static const char folder_key = 0;
static const char asked_key = 0;

void cs_host_unref(cs_host *host) {
  if (!host || --host->references > 0)
    return;
  cs_memory *memory = host->memory;
  cs_mem_free(memory, host, sizeof *host);
  cs_memory_unref(memory);
}

static int close_host(lua_State *L) {
  cs_host **box = lua_touserdata(L, 1);
  cs_host *host = *box;
  if (!host)
    return 0;
  *box = NULL;
  if (host->rules)
    host->rules->close(host->rules->user);
  host->rules = NULL;
  if (host->owns_context)
    celspan_context_destroy(host->context);
  host->context = NULL;
  host->state = NULL;
  cs_host_unref(host);
  return 0;
}

static lua_State *main_thread(lua_State *L) {
  lua_rawgeti(L, LUA_REGISTRYINDEX, LUA_RIDX_MAINTHREAD);
  lua_State *thread = lua_tothread(L, -1);
  lua_pop(L, 1);
  return thread;
}

cs_host *cs_host_find(lua_State *L) {
  cs_host *host = NULL;
  if (lua_rawgetp(L, LUA_REGISTRYINDEX, &host_key) == LUA_TUSERDATA)
    host = *(cs_host **)lua_touserdata(L, -1);
  lua_pop(L, 1);
  return host;
}

/* Makes the host, with one reference; without memory the context does not change. */
static cs_host *create_host(lua_State *thread, celspan_context *context, bool owns_context) {
  cs_host *host = cs_mem_array(context->memory, 1, sizeof *host);
  if (host)
    *host = (cs_host){.references = 1,
                      .memory = cs_memory_ref(context->memory),
                      .state = thread,
                      .context = context,
                      .owns_context = owns_context};
  return host;
}

void cs_host_open(lua_State *L, celspan_context *context) {
  if (cs_host_find(L))
    return;
  cs_host **box = lua_newuserdatauv(L, sizeof *box, 0);
  *box = NULL;
  lua_createtable(L, 0, 1);
  lua_pushcfunction(L, close_host);
  lua_setfield(L, -2, "__gc");
  lua_setmetatable(L, -2);
  lua_State *thread = main_thread(L);

  bool is_ours = !context;
  if (is_ours && celspan_context_create(NULL, &context) != CELSPAN_OK)
    luaL_error(L, "celspan: not enough memory for a context");
  *box = create_host(thread, context, is_ours);
  if (!*box) {
    if (is_ours)
      celspan_context_destroy(context);
    luaL_error(L, "celspan: not enough memory to open the module");
  }
  lua_rawsetp(L, LUA_REGISTRYINDEX, &host_key);
}

cs_host *cs_host_get(lua_State *L) {
  cs_host *host = cs_host_find(L);
  if (!host)
    luaL_error(L, "celspan is closed in this Lua state");
  return host;
}

celspan_context *cs_host_context(lua_State *L) { return cs_host_get(L)->context; }

lua_State *cs_host_enter(lua_State *L) {
  cs_host *host = cs_host_get(L);
  lua_State *before = host->state;
  host->state = L;
  return before;
}

void cs_host_leave(lua_State *L, lua_State *before) { cs_host_get(L)->state = before; }

/* The context's sentence. A refusal of the core begins with a noun ("ellipse: "), which is left
 * out, because the script may have used another word. */
static const char *sentence_of(const cs_host *host) {
  const char *sentence = celspan_context_error(host->context);
  size_t word = strspn(sentence, "abcdefghijklmnopqrstuvwxyz_");
  bool has_noun = (host->failure == CELSPAN_BAD_ARGUMENT || host->failure == CELSPAN_LIMIT) &&
                  strncmp(sentence + word, ": ", 2) == 0;
  return has_noun ? sentence + word + 2 : sentence;
}

/* Notes the failure. A lack of memory ends a script in a sandbox. */
static cs_host *note_failure(lua_State *L, celspan_status status) {
  cs_host *host = cs_host_get(L);
  host->failure = status;
  if (status == CELSPAN_NO_MEMORY && host->rules)
    host->rules->starve(host->rules->user, L, sentence_of(host));
  return host;
}

void cs_host_try(lua_State *L, const char *noun, celspan_status status) {
  if (status == CELSPAN_OK)
    return;
  const cs_host *host = note_failure(L, status);
  cs_caller_error(L, "%s: %s", noun, sentence_of(host));
}

int cs_host_fail(lua_State *L, celspan_status status) {
  note_failure(L, status);
  luaL_pushfail(L);
  lua_pushstring(L, celspan_context_error(cs_host_context(L)));
  return 2;
}

int cs_host_fail_input(lua_State *L, celspan_status status) {
  return cs_host_fail(L, status == CELSPAN_LIMIT ? CELSPAN_INPUT : status);
}

celspan_status cs_host_blame(lua_State *L, const char *message) {
  cs_host *host = cs_host_get(L);
  const char *sentence = sentence_of(host);
  bool is_core = host->failure != CELSPAN_OK && sentence[0] && strstr(message, sentence);
  return is_core ? host->failure : CELSPAN_CALLBACK;
}

void cs_host_set_folder(lua_State *L, const char *folder) {
  lua_pushstring(L, folder);
  lua_rawsetp(L, LUA_REGISTRYINDEX, &folder_key);
}

bool cs_host_push_folder(lua_State *L) {
  bool found = lua_rawgetp(L, LUA_REGISTRYINDEX, &folder_key) == LUA_TSTRING;
  if (!found)
    lua_pop(L, 1);
  return found;
}

/* ---------------------------------------------------------------- rules */

void cs_host_begin(lua_State *L, cs_host_call call, int64_t number) {
  const cs_host_rules *rules = cs_host_get(L)->rules;
  if (rules)
    rules->begin(rules->user, L, call, number);
}

void cs_host_end(lua_State *L) {
  const cs_host_rules *rules = cs_host_get(L)->rules;
  if (rules)
    rules->end(rules->user);
}

/* Notes a path in a table of paths: a list, and each path as a key, whose value is whether the
 * script may read there. */
static void remember(lua_State *L, const char *path, bool is_admitted) {
  if (lua_rawgetp(L, LUA_REGISTRYINDEX, &asked_key) == LUA_TTABLE) {
    lua_pushstring(L, path);
    lua_pushvalue(L, -1);
    if (lua_rawget(L, -3) == LUA_TNIL) {
      lua_pushvalue(L, -2);
      lua_rawseti(L, -4, (lua_Integer)lua_rawlen(L, -4) + 1);
    }
    lua_pop(L, 1);
    lua_pushboolean(L, is_admitted);
    lua_rawset(L, -3);
  }
  lua_pop(L, 1);
}

void cs_host_remember_asked(lua_State *L) {
  lua_newtable(L);
  lua_rawsetp(L, LUA_REGISTRYINDEX, &asked_key);
}

void cs_host_push_asked(lua_State *L) {
  lua_rawgetp(L, LUA_REGISTRYINDEX, &asked_key);
  cs_host_remember_asked(L);
}

void cs_host_charge(lua_State *L, uint64_t steps) {
  const cs_host *host = cs_host_get(L);
  if (host->rules && host->rules->charge)
    host->rules->charge(host->rules->user, L, steps);
}

bool cs_host_admits(lua_State *L, const char *path) {
  const cs_host_rules *rules = cs_host_get(L)->rules;
  bool is_admitted = !rules || !rules->admits || rules->admits(rules->user, path);
  remember(L, path, is_admitted);
  return is_admitted;
}

void cs_host_admit(lua_State *L, const char *path) {
  const cs_host_rules *rules = cs_host_get(L)->rules;
  remember(L, path, false);
  if (rules && rules->admit)
    rules->admit(rules->user, L, path);
  remember(L, path, true);
}

void cs_host_remember(lua_State *L, const char *path) { remember(L, path, true); }

bool cs_host_confines(lua_State *L) {
  const cs_host_rules *rules = cs_host_get(L)->rules;
  return rules && rules->admits;
}

void cs_host_allow(lua_State *L, const char *folder) {
  const cs_host_rules *rules = cs_host_get(L)->rules;
  if (!rules || !rules->allow || rules->allow(rules->user, folder))
    return;
  if (errno == ENOMEM)
    cs_host_try(L, folder, cs_fail_memory(cs_host_context(L)));
  luaL_error(L, "%s: there are too many folders to let scripts read there", folder);
}

bool cs_host_may_write(lua_State *L, const char *path) {
  const cs_host_rules *rules = cs_host_get(L)->rules;
  return !rules || !rules->may_write || rules->may_write(rules->user, L, path);
}
