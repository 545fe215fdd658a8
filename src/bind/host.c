#include "bind/host.h"

#include <lauxlib.h>
#include <stdlib.h>
#include <string.h>

static const char host_key = 0; /* addresses in the registry */
static const char folder_key = 0;

void cs_host_unref(cs_host *host) {
  if (host && --host->references == 0)
    free(host);
}

static int close_host(lua_State *L) {
  cs_host **box = lua_touserdata(L, 1);
  cs_host *host = *box;
  if (!host)
    return 0;
  *box = NULL;
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

static bool has_host(lua_State *L) {
  bool found = lua_rawgetp(L, LUA_REGISTRYINDEX, &host_key) == LUA_TUSERDATA;
  lua_pop(L, 1);
  return found;
}

void cs_host_open(lua_State *L, celspan_context *context) {
  if (has_host(L))
    return;
  cs_host **box = lua_newuserdatauv(L, sizeof *box, 0);
  *box = NULL;
  lua_createtable(L, 0, 1);
  lua_pushcfunction(L, close_host);
  lua_setfield(L, -2, "__gc");
  lua_setmetatable(L, -2);
  lua_State *thread = main_thread(L);

  cs_host *host = calloc(1, sizeof *host);
  if (!host)
    luaL_error(L, "celspan: not enough memory to open the module");
  *box = host;
  host->references = 1;
  host->state = thread;
  host->context = context;
  if (!context) {
    if (celspan_context_create(NULL, &host->context) != CELSPAN_OK)
      luaL_error(L, "celspan: not enough memory for a context");
    host->owns_context = true;
  }
  lua_rawsetp(L, LUA_REGISTRYINDEX, &host_key);
}

cs_host *cs_host_get(lua_State *L) {
  cs_host *host = NULL;
  if (lua_rawgetp(L, LUA_REGISTRYINDEX, &host_key) == LUA_TUSERDATA)
    host = *(cs_host **)lua_touserdata(L, -1);
  lua_pop(L, 1);
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
  size_t word = strspn(sentence, "abcdefghijklmnopqrstuvwxyz");
  bool has_noun = (host->failure == CELSPAN_BAD_ARGUMENT || host->failure == CELSPAN_LIMIT) &&
                  strncmp(sentence + word, ": ", 2) == 0;
  return has_noun ? sentence + word + 2 : sentence;
}

void cs_host_try(lua_State *L, const char *noun, celspan_status status) {
  if (status == CELSPAN_OK)
    return;
  cs_host *host = cs_host_get(L);
  host->failure = status;
  luaL_error(L, "%s: %s", noun, sentence_of(host));
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

const char *cs_host_resolve(lua_State *L, const char *path) {
  lua_rawgetp(L, LUA_REGISTRYINDEX, &folder_key);
  const char *folder = lua_tostring(L, -1);
  if (!folder || !folder[0] || path[0] == '/')
    lua_pushstring(L, path);
  else
    lua_pushfstring(L, "%s/%s", folder, path);
  lua_remove(L, -2);
  return lua_tostring(L, -1);
}
