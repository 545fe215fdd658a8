/* string: Lua's functions where their time is bounded; the functions with patterns are defined
 * here. */
#include <lauxlib.h>
#include <limits.h>
#include <string.h>

#include "lua/sandbox/guard.h"
#include "lua/sandbox/library.h"
#include "lua/sandbox/pattern.h"

#define BYTES_A_STEP 16

/* ---------------------------------------------------------------- finding */

/* The position given by an argument, counted from 0; length + 1 if it is beyond the end. */
static size_t place_of(lua_State *L, int argument, size_t length) {
  lua_Integer place = luaL_optinteger(L, argument, 1);
  if (place < 0)
    place = (lua_Integer)length + place < 0 ? 0 : (lua_Integer)length + place;
  else if (place > 0)
    place--;
  return (size_t)place > length ? length + 1 : (size_t)place;
}

static cs_match match_of(lua_State *L, const char *subject, size_t length, const char *pattern,
                         size_t pattern_length) {
  return (cs_match){.L = L,
                    .subject = subject,
                    .subject_end = subject + length,
                    .pattern_end = pattern + pattern_length};
}

/* The characters examined are charged, so a loop over the matches in a text takes steps in
 * proportion to the text. A single search is short enough to be charged afterwards. */
static int find_plain(lua_State *L, const char *subject, size_t length, size_t from,
                      const char *pattern, size_t size) {
  const char *start = subject + from;
  const char *found = size ? memmem(start, length - from, pattern, size) : start;
  size_t looked_at = found ? (size_t)(found - start) : length - from;
  cs_guard_charge(L, looked_at / BYTES_A_STEP + size);
  if (!found) {
    luaL_pushfail(L);
    return 1;
  }
  lua_pushinteger(L, found - subject + 1);
  lua_pushinteger(L, found - subject + (lua_Integer)size);
  return 2;
}

static bool has_specials(const char *pattern, size_t size) {
  for (size_t i = 0; i < size; i++)
    if (pattern[i] && strchr("^$*+?.([%-", pattern[i]))
      return true;
  return false;
}

/* Finds the first match from `from` on: its begin and end; NULL: there is none. */
static const char *search(cs_match *m, const char *from, const char *pattern, const char **end) {
  bool is_anchored = pattern < m->pattern_end && *pattern == '^';
  for (const char *at = from; at <= m->subject_end; at++) {
    *end = cs_pattern_match(m, at, pattern + is_anchored);
    if (*end)
      return at;
    if (is_anchored)
      break;
  }
  return NULL;
}

static int find_or_match(lua_State *L, bool finds) {
  size_t length, size;
  const char *subject = luaL_checklstring(L, 1, &length), *end;
  const char *pattern = luaL_checklstring(L, 2, &size);
  size_t from = place_of(L, 3, length);
  if (from > length) {
    luaL_pushfail(L);
    return 1;
  }
  if (finds && (lua_toboolean(L, 4) || !has_specials(pattern, size)))
    return find_plain(L, subject, length, from, pattern, size);
  cs_match m = match_of(L, subject, length, pattern, size);
  const char *begin = search(&m, subject + from, pattern, &end);
  cs_pattern_end(&m);
  if (!begin) {
    luaL_pushfail(L);
    return 1;
  }
  if (!finds)
    return cs_pattern_push_all(&m, begin, end);
  lua_pushinteger(L, begin - subject + 1);
  lua_pushinteger(L, end - subject);
  return 2 + cs_pattern_push_all(&m, NULL, NULL);
}

static int find(lua_State *L) { return find_or_match(L, true); }

static int match(lua_State *L) { return find_or_match(L, false); }

/* upvalues: subject, pattern, next start, end of the last match (-1: none yet) */
static int next_match(lua_State *L) {
  size_t length, size;
  const char *subject = lua_tolstring(L, lua_upvalueindex(1), &length), *end;
  const char *pattern = lua_tolstring(L, lua_upvalueindex(2), &size);
  lua_Integer from = lua_tointeger(L, lua_upvalueindex(3));
  lua_Integer last = lua_tointeger(L, lua_upvalueindex(4));
  cs_match m = match_of(L, subject, length, pattern, size);
  for (const char *at = subject + from; at <= m.subject_end; at++) {
    end = cs_pattern_match(&m, at, pattern);
    if (!end || end - subject == last)
      continue;
    cs_pattern_end(&m);
    lua_pushinteger(L, end - subject);
    lua_copy(L, -1, lua_upvalueindex(3));
    lua_replace(L, lua_upvalueindex(4));
    return cs_pattern_push_all(&m, at, end);
  }
  cs_pattern_end(&m);
  return 0;
}

static int gmatch(lua_State *L) {
  size_t length;
  luaL_checklstring(L, 1, &length);
  luaL_checkstring(L, 2);
  size_t from = place_of(L, 3, length);
  lua_settop(L, 2);
  lua_pushinteger(L, (lua_Integer)from);
  lua_pushinteger(L, -1);
  lua_pushcclosure(L, next_match, 4);
  return 1;
}

/* ---------------------------------------------------------------- replacing */

/* Adds the text of argument 3, in which %1 to %9 mean captures and %0 means the whole match. */
static void add_text(cs_match *m, luaL_Buffer *out, const char *begin, const char *end) {
  size_t size;
  const char *text = lua_tolstring(m->L, 3, &size), *last = text + size;
  for (; text < last; text++) {
    if (*text != '%') {
      luaL_addchar(out, *text);
    } else if (++text < last && *text == '%') {
      luaL_addchar(out, '%');
    } else if (text < last && *text == '0') {
      luaL_addlstring(out, begin, (size_t)(end - begin));
    } else if (text < last && *text >= '1' && *text <= '9') {
      cs_pattern_push(m, *text - '1', begin, end);
      luaL_tolstring(m->L, -1, NULL); /* a position is a number */
      lua_remove(m->L, -2);
      luaL_addvalue(out);
    } else {
      luaL_error(m->L, "invalid use of '%%' in replacement string");
    }
  }
}

/* Adds the replacement that argument 3 gives for this match. Returns whether the text changes. */
static bool add_value(cs_match *m, luaL_Buffer *out, const char *begin, const char *end) {
  lua_State *L = m->L;
  int type = lua_type(L, 3);
  if (type == LUA_TFUNCTION) {
    lua_pushvalue(L, 3);
    lua_call(L, cs_pattern_push_all(m, begin, end), 1);
  } else if (type == LUA_TTABLE) {
    cs_pattern_push(m, 0, begin, end);
    lua_gettable(L, 3);
  } else {
    add_text(m, out, begin, end);
    return true;
  }
  if (!lua_toboolean(L, -1)) {
    lua_pop(L, 1);
    luaL_addlstring(out, begin, (size_t)(end - begin));
    return false;
  }
  if (!lua_isstring(L, -1))
    luaL_error(L, "invalid replacement value (a %s)", luaL_typename(L, -1));
  luaL_addvalue(out);
  return true;
}

static int gsub(lua_State *L) {
  size_t length, size;
  const char *subject = luaL_checklstring(L, 1, &length), *at = subject, *last = NULL;
  const char *pattern = luaL_checklstring(L, 2, &size);
  int type = lua_type(L, 3);
  luaL_argexpected(
      L, type == LUA_TNUMBER || type == LUA_TSTRING || type == LUA_TFUNCTION || type == LUA_TTABLE,
      3, "string/function/table");
  lua_Integer most = luaL_optinteger(L, 4, (lua_Integer)length + 1), count = 0;
  bool is_anchored = size > 0 && *pattern == '^', is_changed = false;
  cs_match m = match_of(L, subject, length, pattern, size);
  luaL_Buffer out;
  luaL_buffinit(L, &out);
  while (count < most) {
    const char *end = cs_pattern_match(&m, at, pattern + is_anchored);
    if (end && end != last) {
      count++;
      is_changed |= add_value(&m, &out, at, end);
      at = last = end;
    } else if (at < m.subject_end) {
      luaL_addchar(&out, *at++);
    } else {
      break;
    }
    if (is_anchored)
      break;
  }
  cs_pattern_end(&m);
  if (is_changed) {
    luaL_addlstring(&out, at, (size_t)(m.subject_end - at));
    luaL_pushresult(&out);
  } else {
    lua_pushvalue(L, 1);
  }
  lua_pushinteger(L, count);
  return 2;
}

/* ---------------------------------------------------------------- the rest */

static int rep(lua_State *L) {
  size_t size, gap, all;
  luaL_checklstring(L, 1, &size);
  lua_Integer count = luaL_checkinteger(L, 2);
  luaL_optlstring(L, 3, "", &gap);
  if (count <= 0 || size + gap == 0) {
    lua_pushliteral(L, "");
    return 1;
  }
  if (__builtin_mul_overflow(size + gap, (size_t)count, &all) || all > INT_MAX)
    return luaL_error(L, "resulting string too large");
  cs_guard_charge(L, (uint64_t)count + all / BYTES_A_STEP);
  return cs_library_call(L);
}

/* The letter of the conversion at the '%' at `at`; '\0': there is none. */
static char conversion_at(const char *at) { return at[1 + strspn(at + 1, "-+ #0123456789.")]; }

/* Converts values for %s to texts without addresses; refuses %p, which is an address. */
static int format(lua_State *L) {
  int argument = 1;
  size_t size;
  const char *at = luaL_checklstring(L, 1, &size), *end = at + size;
  for (; at < end; at++) {
    if (*at != '%')
      continue;
    if (at[1] == '%') {
      at++;
      continue;
    }
    char letter = conversion_at(at);
    argument++;
    if (letter == 'p')
      return luaL_error(L, "format: '%%p' is not in the sandbox, because addresses differ in "
                           "each run");
    if (letter == 's' && lua_gettop(L) >= argument) {
      cs_library_push_text(L, argument);
      lua_replace(L, argument);
    }
  }
  return cs_library_call(L);
}

/* upvalue 1: Lua's function, which processes the text of argument 1. */
static int charged(lua_State *L) {
  size_t size;
  luaL_checklstring(L, 1, &size);
  cs_guard_charge(L, size / BYTES_A_STEP);
  return cs_library_call(L);
}

/* Sets functions in the table on top. Each wraps the function of the same name in the table below
 * it. */
static void wrap(lua_State *L, const char *const *names, lua_CFunction function) {
  for (; *names; names++) {
    lua_getfield(L, -2, *names);
    lua_pushcclosure(L, function, 1);
    lua_setfield(L, -2, *names);
  }
}

void cs_library_push_string(lua_State *L) {
  static const char *const same[] = {"byte",     "char",   "len",  "sub",
                                     "packsize", "unpack", "pack", NULL};
  static const char *const by_length[] = {"lower", "upper", "reverse", NULL};
  static const char *const rep_name[] = {"rep", NULL}, *const format_name[] = {"format", NULL};
  static const luaL_Reg own[] = {
      {"find", find}, {"match", match}, {"gmatch", gmatch}, {"gsub", gsub}, {NULL, NULL}};
  cs_library_push_part(L, "string", same, own);
  lua_getglobal(L, "string");
  lua_insert(L, -2);
  wrap(L, by_length, charged);
  wrap(L, rep_name, rep);
  wrap(L, format_name, format);
  lua_remove(L, -2);
}
