#include "lua/module/parameters.h"

#include <lauxlib.h>
#include <math.h>
#include <string.h>

#include "celspan/lua.h"
#include "inside/description.h"
#include "lua/bind/put.h"
#include "lua/bind/take.h"
#include "lua/module/visit.h"

int cs_parameters_settings(lua_State *L) {
  luaL_getsubtable(L, LUA_REGISTRYINDEX, "celspan.settings");
  return 1;
}

/* ---------------------------------------------------------------- giving */

/* Appends the table on top of the stack to the table below it, and pops both. */
static void append(lua_State *L) {
  lua_rawseti(L, -2, (lua_Integer)lua_rawlen(L, -2) + 1);
  lua_pop(L, 1);
}

void cs_parameters_give(lua_State *L, const char *source, const char *name, size_t length,
                        const char *text) {
  cs_parameters_settings(L);
  lua_createtable(L, 0, 3);
  cs_put_text(L, "source", source);
  lua_pushlstring(L, name, length);
  lua_setfield(L, -2, "name");
  cs_put_text(L, "text", text);
  append(L);
}

void cs_parameters_give_json(lua_State *L, const char *path, const char *json, size_t size) {
  cs_parameters_settings(L);
  lua_createtable(L, 0, 2);
  lua_pushfstring(L, "--set-from %s: ", path);
  lua_setfield(L, -2, "source");
  lua_pushlstring(L, json, size);
  lua_setfield(L, -2, "json");
  append(L);
}

/* The registry; light userdata: a name and a value. Runs protected. */
static int give(lua_State *L) {
  const char *const *words = lua_touserdata(L, 2);
  cs_parameters_give(L, "set: ", words[0], strlen(words[0]), words[1]);
  return 0;
}

celspan_status celspan_lua_set(lua_State *L, const char *name, const char *value) {
  const char *words[] = {name, value};
  celspan_context *context = celspan_lua_context(L);
  if (context && (!name || !value))
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "set: the %s is missing",
                   name ? "value" : "name");
  return cs_visit(L, LUA_REGISTRYINDEX, give, words, 0);
}

/* ---------------------------------------------------------------- a run */

void cs_parameters_begin(lua_State *L) {
  cs_parameters_settings(L);
  cs_put_text(L, "declared", NULL);
  cs_put_text(L, "refused", NULL);
  lua_pop(L, 1);
}

/* With the settings on top of the stack, pushes the sentence that refuses one of them. false: none
 * is refused. */
static bool push_refusal(lua_State *L, bool has_ended) {
  int settings = lua_gettop(L);
  if (lua_getfield(L, settings, "refused") != LUA_TNIL)
    return true;
  if (!has_ended || lua_getfield(L, settings, "declared") != LUA_TNIL ||
      lua_rawgeti(L, settings, 1) != LUA_TTABLE)
    return false;
  lua_getfield(L, -1, "source");
  lua_pushliteral(L, "the script declares no parameters (celspan.parameters)");
  lua_concat(L, 2);
  lua_pushvalue(L, -1);
  lua_setfield(L, settings, "refused");
  return true;
}

/* The registry; light userdata: whether the script has come to its end. Runs protected. */
static int end(lua_State *L) {
  const bool *has_ended = lua_touserdata(L, 2);
  cs_parameters_settings(L);
  int settings = lua_gettop(L);
  bool is_refused = push_refusal(L, *has_ended);
  for (lua_Unsigned i = lua_rawlen(L, settings); i > 0; i--) {
    lua_pushnil(L);
    lua_rawseti(L, settings, (lua_Integer)i);
  }
  return is_refused ? lua_error(L) : 0;
}

celspan_status cs_parameters_end(lua_State *L, bool has_ended) {
  return cs_visit(L, LUA_REGISTRYINDEX, end, &has_ended, 0);
}

/* The registry, light userdata: the answer. Runs protected. */
static int ask_refused(lua_State *L) {
  bool *is_refused = lua_touserdata(L, 2);
  cs_parameters_settings(L);
  *is_refused = lua_getfield(L, -1, "refused") != LUA_TNIL;
  return 0;
}

bool cs_parameters_are_refused(lua_State *L) {
  bool is_refused = false;
  return cs_visit(L, LUA_REGISTRYINDEX, ask_refused, &is_refused, 0) == CELSPAN_OK && is_refused;
}

/* ---------------------------------------------------------------- what is declared */

/* Pushes the list of what is declared, or nil. */
static size_t push_declared(lua_State *L) {
  cs_parameters_settings(L);
  return lua_getfield(L, -1, "declared") == LUA_TTABLE ? (size_t)lua_rawlen(L, -1) : 0;
}

/* The registry, light userdata: the number. Runs protected. */
static int count_all(lua_State *L) {
  *(size_t *)lua_touserdata(L, 2) = push_declared(L);
  return 0;
}

size_t celspan_lua_parameter_count(lua_State *L) {
  size_t count = 0;
  return cs_visit(L, LUA_REGISTRYINDEX, count_all, &count, 0) == CELSPAN_OK ? count : 0;
}

static celspan_parameter_kind kind_of(lua_State *L) {
  static const char *const kinds[] = {"text",   "file",   "number", "boolean",
                                      "choice", "colour", "point",  "ease"};
  const char *word = cs_take_text(L, -1, "kind");
  int kind = 0;
  while (kind < CELSPAN_PARAMETER_EASE && strcmp(kinds[kind], word) != 0)
    kind++;
  return (celspan_parameter_kind)kind;
}

/* Pushes the list of choices on top of the stack as a list of C. */
static void push_texts(lua_State *L) {
  int list = lua_gettop(L);
  size_t count = lua_rawlen(L, list);
  const char **texts = lua_newuserdatauv(L, count * sizeof *texts, 0);
  for (size_t i = 0; i < count; i++, lua_pop(L, 1)) {
    lua_rawgeti(L, list, (lua_Integer)i + 1);
    texts[i] = lua_tostring(L, -1);
  }
}

/* The choices of the parameter on top of the stack, which keeps them as a list of C. */
static void read_choices(lua_State *L, celspan_parameter *out) {
  int parameter = lua_gettop(L);
  if (lua_getfield(L, parameter, "choices") == LUA_TTABLE) {
    out->choice_count = lua_rawlen(L, -1);
    if (lua_getfield(L, parameter, "texts") == LUA_TNIL) {
      lua_pop(L, 1);
      push_texts(L);
      lua_pushvalue(L, -1);
      lua_setfield(L, parameter, "texts");
    }
    out->choices = lua_touserdata(L, -1);
  }
  lua_settop(L, parameter);
}

typedef struct question {
  size_t place;
  celspan_parameter answer;
} question;

/* The registry, light userdata: the question. Runs protected. */
static int read_one(lua_State *L) {
  question *q = lua_touserdata(L, 2);
  size_t count = push_declared(L);
  if (q->place >= count)
    return luaL_error(L, "parameter %I: the script has %I", (LUAI_UACINT)q->place,
                      (LUAI_UACINT)count);
  lua_rawgeti(L, -1, (lua_Integer)q->place + 1);
  q->answer = (celspan_parameter){.struct_size = sizeof q->answer,
                                  .name = cs_take_text(L, -1, "name"),
                                  .kind = kind_of(L),
                                  .text = cs_take_text(L, -1, "text"),
                                  .number = cs_take_number(L, -1, "default", 0),
                                  .least = cs_take_number(L, -1, "min", -INFINITY),
                                  .most = cs_take_number(L, -1, "max", INFINITY),
                                  .about = cs_take_text(L, -1, "about")};
  read_choices(L, &q->answer);
  return 0;
}

celspan_status celspan_lua_parameter(lua_State *L, size_t place, celspan_parameter *out) {
  question q = {.place = place};
  CS_TRY(cs_visit(L, LUA_REGISTRYINDEX, read_one, &q, 0));
  return CS_RESULT(celspan_lua_context(L), "parameter", celspan_parameter, &q.answer, out);
}
