#include "lua/bind/lua_error.h"

#include <lauxlib.h>
#include <stdio.h>
#include <string.h>

#include "inside/context.h"
#include "lua/bind/caller.h"
#include "lua/bind/host.h"
#include "lua/bind/names.h"
#include "lua/bind/userdata.h"

/* ---------------------------------------------------------------- messages */

size_t cs_lua_error_position(const char *message) {
  for (const char *colon = strchr(message, ':'); colon; colon = strchr(colon + 1, ':')) {
    size_t digits = strspn(colon + 1, "0123456789");
    if (digits && strncmp(colon + 1 + digits, ": ", 2) == 0)
      return (size_t)(colon + 1 + digits + 2 - message);
  }
  return 0;
}

/* If a frame is built inside a frame, its callers are already in the message. */
static void push_chain(lua_State *L, const char *message, const char *position) {
  if (strstr(message, " (called from "))
    lua_pushliteral(L, "");
  else
    cs_caller_push_chain(L, position, lua_tocfunction(L, lua_upvalueindex(2)));
}

/* Pushes a hint that Lua's own message lacks: about the argument of a frame function, a number of
 * frames that is used like a frame, or a global without a value. */
static const char *push_hint(lua_State *L, const char *message) {
  static const char before[] = "a nil value (global '";
  const char *attempt = strstr(message, "attempt to "), *name = strstr(message, before);
  if (name && attempt) {
    name += sizeof before - 1;
    lua_pushlstring(L, name, strcspn(name, "'"));
    return cs_names_push_hint(L, lua_tostring(L, -1));
  }
  if (attempt && strstr(message, "index a number value"))
    return " (a number has no fields: f:on(2), f:twos() and f.time are numbers themselves)";
  return attempt && strstr(message, "celspan.frame")
             ? " (a frame function gets a table: write f.time, f.progress or f.number)"
             : "";
}

/* The message handler. A message without a position gets the position of the innermost function of
 * a script. If a frame is built inside a frame, its label is already in the message. */
static int handle_error(lua_State *L) {
  lua_settop(L, 1);
  const char *message = lua_type(L, 1) == LUA_TSTRING ? lua_tostring(L, 1) : NULL;
  if (!message)
    message = lua_pushfstring(L, "the error is not a message: %s", cs_userdata_type(L, 1));
  const char *label = lua_tostring(L, lua_upvalueindex(1));
  if (strstr(message, label))
    label = "";
  size_t position = cs_lua_error_position(message);
  if (position)
    lua_pushlstring(L, message, position);
  else
    cs_caller_push_position(L, lua_tocfunction(L, lua_upvalueindex(2)));
  const char *where = lua_tostring(L, -1);
  const char *hint = push_hint(L, message);
  lua_pushfstring(L, "%s%s%s", label, message + position, hint);
  push_chain(L, message, where);
  lua_pushfstring(L, "%s%s%s", where, lua_tostring(L, -2), lua_tostring(L, -1));
  return 1;
}

void cs_lua_error_push_handler(lua_State *L, const char *label, lua_CFunction last) {
  lua_pushstring(L, label);
  lua_pushcfunction(L, last);
  lua_pushcclosure(L, handle_error, 2);
}

/* function, arguments -> results. Runs protected. */
static int call_handled(lua_State *L) {
  cs_lua_error_push_handler(L, "", lua_tocfunction(L, 1));
  lua_insert(L, 1);
  if (lua_pcall(L, lua_gettop(L) - 2, LUA_MULTRET, 1) != LUA_OK)
    return lua_error(L);
  return lua_gettop(L) - 1;
}

int cs_lua_error_call(lua_State *L, int arguments, int results) {
  lua_pushcfunction(L, call_handled);
  lua_insert(L, -2 - arguments);
  return lua_pcall(L, arguments + 1, results, 0);
}

bool cs_lua_error_is_memory(lua_State *L, int outcome) {
  const char *message = lua_tostring(L, -1);
  return outcome == LUA_ERRMEM || (message && strcmp(message, "not enough memory") == 0);
}

/* ---------------------------------------------------------------- the context's sentence */

/* The status of the failure whose message is on top of the stack. */
static celspan_status status_of(lua_State *L, int outcome) {
  const char *message = lua_tostring(L, -1);
  return cs_lua_error_is_memory(L, outcome) ? CELSPAN_NO_MEMORY
         : message                          ? cs_host_blame(L, message)
                                            : CELSPAN_CALLBACK;
}

celspan_status cs_lua_error_report_as(lua_State *L, celspan_status status) {
  const char *message = lua_tostring(L, -1);
  char copy[1024]; /* the message may contain the sentence that is about to be replaced */
  snprintf(copy, sizeof copy, "%s", message ? message : "the error is not a message");
  lua_pop(L, 1);
  return celspan_context_fail(cs_host_context(L), status, "%s", copy);
}

/* If a script ended with the core's message, the system ended it, and not a limit. */
celspan_status cs_lua_error_limit(lua_State *L, int outcome, const char **text) {
  const cs_host_rules *rules = cs_host_get(L)->rules;
  const char *message = lua_tostring(L, -1);
  if (cs_lua_error_is_memory(L, outcome))
    outcome = LUA_ERRMEM;
  const char *sentence = rules ? rules->limit(rules->user, outcome, message) : NULL;
  if (!sentence)
    return CELSPAN_OK;
  *text = message && strstr(message, sentence) ? message : sentence;
  return cs_host_blame(L, *text) == CELSPAN_NO_MEMORY ? CELSPAN_NO_MEMORY : CELSPAN_LIMIT;
}

int cs_lua_error_settle(lua_State *L, int outcome, int results) {
  const cs_host_rules *rules = cs_host_get(L)->rules;
  if (outcome != LUA_OK || !rules || !rules->limit(rules->user, LUA_OK, NULL))
    return outcome;
  lua_pop(L, results);
  lua_pushnil(L);
  return LUA_ERRRUN;
}

/* Nothing is pushed, because there may be no memory. */
celspan_status cs_lua_error_report(lua_State *L, int outcome) {
  const char *text;
  char copy[CS_ERROR_SIZE]; /* as above */
  celspan_status limit = cs_lua_error_limit(L, outcome, &text);
  if (limit != CELSPAN_OK) {
    snprintf(copy, sizeof copy, "%s", text);
    lua_pop(L, 1);
    return celspan_context_fail(cs_host_context(L), limit, "%s", copy);
  }
  if (cs_lua_error_is_memory(L, outcome) &&
      cs_account_tell(cs_host_context(L)->memory, copy, sizeof copy)) {
    lua_pop(L, 1);
    return cs_fail_memory(cs_host_context(L));
  }
  return cs_lua_error_report_as(L, status_of(L, outcome));
}
