#include "lua/bind/named.h"

#include <lauxlib.h>
#include <string.h>

#include "lua/bind/caller.h"
#include "lua/bind/host.h"

/* ---------------------------------------------------------------- lines */

/* The address of this variable is a key of the registry. Its value is a list of texts, which also
 * has the number of each text under the text itself, and the two answers below.
 *
 *   in walk, from shot.lua:88          the callers of a value's line
 *   in walk, from shot.lua:88 0 H Hey  the same for a text, with a head of HEAD bytes and the words
 */
static const char texts_key = 0;

enum { KEEPS_CALLERS = 0, KEEPS_WORDS = -1 };
enum { HEAD = sizeof(double) + 1 }; /* the size of the em, and a flag for letters */

static void keep(lua_State *L, lua_Integer what, bool is_kept) {
  if (lua_rawgetp(L, LUA_REGISTRYINDEX, &texts_key) != LUA_TTABLE) {
    lua_newtable(L);
    lua_pushvalue(L, -1);
    lua_rawsetp(L, LUA_REGISTRYINDEX, &texts_key);
    lua_remove(L, -2);
  }
  lua_pushboolean(L, is_kept);
  lua_rawseti(L, -2, what);
  lua_pop(L, 1);
}

void cs_named_keep_callers(lua_State *L, bool is_kept) { keep(L, KEEPS_CALLERS, is_kept); }

void cs_named_keep_words(lua_State *L, bool is_kept) { keep(L, KEEPS_WORDS, is_kept); }

/* Pushes the list, if the state keeps it; otherwise nothing. */
static bool push_list(lua_State *L, lua_Integer what) {
  bool is_kept = false;
  if (lua_rawgetp(L, LUA_REGISTRYINDEX, &texts_key) == LUA_TTABLE) {
    lua_rawgeti(L, -1, what);
    is_kept = lua_toboolean(L, -1);
    lua_pop(L, 1);
  }
  if (!is_kept)
    lua_pop(L, 1);
  return is_kept;
}

/* Pushes the text with this number, or nil. */
static void push_text(lua_State *L, uint32_t number) {
  if (lua_rawgetp(L, LUA_REGISTRYINDEX, &texts_key) == LUA_TTABLE && number > 0)
    lua_rawgeti(L, -1, number);
  else
    lua_pushnil(L);
  lua_remove(L, -2);
}

void cs_named_push_callers(lua_State *L, uint32_t number) {
  push_text(L, number);
  const char *text = lua_tostring(L, -1);
  lua_pushstring(L, text ? text : ""); /* the text ends where the words begin */
  lua_remove(L, -2);
}

/* Pops a text, and the list below it. Returns the number of the text. */
static uint32_t number_of(lua_State *L) {
  lua_pushvalue(L, -1);
  if (lua_rawget(L, -3) != LUA_TNUMBER) {
    lua_Integer number = (lua_Integer)lua_rawlen(L, -3) + 1;
    lua_pushvalue(L, -2);
    lua_rawseti(L, -4, number);
    lua_pushvalue(L, -2);
    lua_pushinteger(L, number);
    lua_rawset(L, -5);
    lua_pop(L, 1);
    lua_pushinteger(L, number);
  }
  uint32_t number = (uint32_t)lua_tointeger(L, -1);
  lua_pop(L, 3);
  return number;
}

/* The number of the current callers; 0: callers are not kept. */
static uint32_t find_callers(lua_State *L) {
  if (!push_list(L, KEEPS_CALLERS))
    return 0;
  cs_caller_push_callers(L);
  return number_of(L);
}

void cs_named_add_words(lua_State *L, celspan_context *context, const cs_named_words *words) {
  char head[HEAD];
  luaL_checkstack(L, 8, "too many words");
  if (!push_list(L, KEEPS_WORDS))
    return;
  memcpy(head, &words->em, sizeof words->em);
  head[HEAD - 1] = words->has_letters;
  cs_named_push_callers(L, context->origin.callers);
  lua_pushlstring(L, "", 1);
  lua_pushlstring(L, head, HEAD);
  lua_pushlstring(L, words->text, words->size);
  lua_concat(L, 4);
  context->origin.callers = number_of(L);
}

bool cs_named_push_words(lua_State *L, uint32_t number, cs_named_words *out) {
  push_text(L, number);
  size_t size = 0;
  const char *text = lua_tolstring(L, -1, &size);
  size_t callers = text ? strlen(text) + 1 : 0; /* with its zero; the size counts one more */
  if (!text || size < callers + HEAD)
    return false;
  memcpy(&out->em, text + callers, sizeof out->em);
  out->has_letters = text[callers + HEAD - 1];
  out->text = text + callers + HEAD;
  out->size = size - callers - HEAD;
  return true;
}

void cs_named_begin(lua_State *L, celspan_context *context) {
  lua_Debug at;
  luaL_checkstack(L, 6, "too many callers");
  if (!cs_caller_find(L, &at)) {
    cs_named_end(context);
    return;
  }
  celspan_context_set_origin(context, at.short_src, at.currentline);
  context->origin.callers = find_callers(L);
}

void cs_named_begin_as(celspan_context *context, const cs_userdata *value) {
  const cs_kind *kind = value->noun->kind;
  if (!kind->origin_of)
    return;
  celspan_origin at = kind->origin_of(value->handle);
  celspan_context_set_origin(context, at.source, at.line);
}

void cs_named_end(celspan_context *context) { celspan_context_set_origin(context, NULL, 0); }

/* ---------------------------------------------------------------- names */

void cs_named_copy(lua_State *L, const cs_userdata *from, cs_userdata *value) {
  const cs_kind *kind = value->noun->kind, *old = from->noun->kind;
  const char *name = old->name_of && kind->named ? old->name_of(from->handle) : "";
  void *made = NULL;
  if (!name[0])
    return;
  cs_host_try(L, "named", kind->named(cs_host_context(L), value->handle, name, &made));
  kind->unref(value->handle);
  value->handle = made;
}

int cs_named_method(lua_State *L) {
  const cs_userdata *value = cs_userdata_any(L, 1);
  if (!value || !value->noun->kind->named)
    return cs_caller_error(L, "named: call it as a method, value:named(\"hand\"), got %s",
                           cs_userdata_type(L, 1));
  if (lua_type(L, 2) != LUA_TSTRING)
    return cs_caller_error(L, "named: the name must be a string, got %s", cs_userdata_type(L, 2));
  const char *name = lua_tostring(L, 2);
  if (strlen(name) != lua_rawlen(L, 2))
    return cs_caller_error(L, "named: the name must not hold a zero byte");
  cs_userdata *copy = cs_userdata_push_like(L, 1, false);
  cs_host_try(L, "named",
              value->noun->kind->named(cs_host_context(L), value->handle, name, &copy->handle));
  return 1;
}
