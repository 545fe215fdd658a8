/* JSON (RFC 8259) as tables, for lua/celspan/base/json.lua.
 *
 * INVARIANT: a reader begins at the first byte of what it reads, leaves `at` behind it, and pushes
 * the value. If it returns false, `problem` says what is wrong at `at`; NULL: it is too deep. The
 * text ends with a zero byte, which Lua puts behind it.
 */
#include <ctype.h>
#include <lauxlib.h>
#include <stdlib.h>
#include <string.h>

#include "lua/bind/host.h"
#include "lua/module/native.h"

enum { DEPTH = 100, SLOTS = 8 /* of the stack, for a value */ };

typedef struct json_text {
  lua_State *L;
  const char *at, *end, *problem;
  int depth;
} json_text;

static bool fail(json_text *t, const char *problem) {
  t->problem = problem;
  return false;
}

static char skip(json_text *t) {
  t->at += strspn(t->at, " \t\r\n");
  return *t->at;
}

/* The number of an escape at its u, which is skipped; below 0: it is no number. */
static long read_hex(json_text *t) {
  char digits[5] = {0};
  if (t->at[0] != 'u' || strspn(t->at + 1, "0123456789abcdefABCDEF") < 4)
    return -1;
  memcpy(digits, t->at + 1, 4);
  t->at += 5;
  return strtol(digits, NULL, 16);
}

/* At the u of an escape. Pairs of surrogates are joined; half a pair is no character. */
static bool add_unicode(json_text *t, luaL_Buffer *out) {
  long code = read_hex(t);
  if (code < 0)
    return fail(t, "\\u needs four hexadecimal digits");
  const char *half = t->at;
  if (code >= 0xd800 && code < 0xdc00 && *t->at++ == '\\') {
    long low = read_hex(t);
    if (low >= 0xdc00 && low < 0xe000) {
      code = 0x10000 + (code - 0xd800) * 0x400 + low - 0xdc00;
      half = t->at;
    }
  }
  t->at = half;
  lua_pushfstring(t->L, "%U", (unsigned long)(code >= 0xd800 && code < 0xe000 ? 0xfffd : code));
  luaL_addvalue(out);
  return true;
}

/* At the character behind a backslash. */
static bool add_escape(json_text *t, luaL_Buffer *out) {
  static const char letters[] = "\"\\/bfnrt", meant[] = "\"\\/\b\f\n\r\t";
  if (*t->at == 'u')
    return add_unicode(t, out);
  const char *found = *t->at ? strchr(letters, *t->at) : NULL;
  if (!found)
    return fail(t, "unknown escape in a string");
  t->at++;
  luaL_addchar(out, meant[found - letters]);
  return true;
}

static bool read_string(json_text *t) {
  luaL_Buffer out;
  luaL_buffinit(t->L, &out);
  do {
    const char *from = ++t->at;
    if (from[-1] == '\\') {
      if (!add_escape(t, &out))
        return false;
      from = t->at;
    }
    while ((unsigned char)*t->at >= ' ' && *t->at != '"' && *t->at != '\\')
      t->at++;
    luaL_addlstring(&out, from, (size_t)(t->at - from));
  } while (*t->at == '\\');
  luaL_pushresult(&out);
  if (*t->at != '"')
    return fail(t, t->at < t->end ? "a control character in a string" : "a string does not end");
  t->at++;
  return true;
}

/* The end of the digits at a place; NULL: there are none. */
static const char *digits_end(const char *at) {
  size_t count = strspn(at, "0123456789");
  return count > 0 ? at + count : NULL;
}

static bool read_number(json_text *t) {
  const char *first = t->at + (*t->at == '-'), *end = digits_end(first);
  if (end && *first == '0' && end > first + 1)
    end = NULL;
  if (end && *end == '.')
    end = digits_end(end + 1);
  if (end && (*end == 'e' || *end == 'E'))
    end = digits_end(end + 1 + (end[1] == '+' || end[1] == '-'));
  if (!end)
    return fail(t, "a value is missing or not JSON");
  char digits[32] = {0};
  size_t size = (size_t)(end - t->at);
  const char *text = digits;
  if (size < sizeof digits)
    memcpy(digits, t->at, size); /* the usual case makes no text for the collector */
  else
    text = lua_pushlstring(t->L, t->at, size);
  (void)lua_stringtonumber(t->L, text); /* Lua reads all that JSON has */
  if (text != digits)
    lua_remove(t->L, -2);
  t->at = end;
  return true;
}

/* null: the value at 2 stands for it. */
static bool read_word(json_text *t) {
  static const char *const words[] = {"false", "true", "null"};
  for (int i = 0; i < 3; i++) {
    size_t size = strlen(words[i]);
    if (strncmp(t->at, words[i], size) != 0 || isalpha((unsigned char)t->at[size]))
      continue;
    t->at += size;
    if (i < 2)
      lua_pushboolean(t->L, i);
    else
      lua_pushvalue(t->L, 2);
    return true;
  }
  return read_number(t);
}

static bool read_value(json_text *t);

/* A name and a colon, at the quote. */
static bool read_name(json_text *t) {
  if (*t->at != '"')
    return fail(t, "a name in quotes is missing in an object");
  if (!read_string(t))
    return false;
  if (skip(t) != ':')
    return fail(t, "a colon is missing in an object");
  t->at++;
  return true;
}

/* At a bracket. */
static bool read_all(json_text *t, bool is_object) {
  const char close = is_object ? '}' : ']';
  lua_newtable(t->L);
  t->at++;
  for (lua_Integer i = 1; skip(t) != close || i > 1; i++) {
    if ((is_object && !read_name(t)) || !read_value(t))
      return false;
    if (is_object)
      lua_rawset(t->L, -3);
    else
      lua_rawseti(t->L, -2, i);
    if (skip(t) == close)
      break;
    if (*t->at != ',')
      return fail(t, is_object ? "a comma or } is missing in an object"
                               : "a comma or ] is missing in an array");
    t->at++;
  }
  t->at++;
  return true;
}

static bool read_value(json_text *t) {
  if (t->depth >= DEPTH)
    return fail(t, NULL);
  luaL_checkstack(t->L, SLOTS, "JSON");
  t->depth++;
  char sign = skip(t);
  bool is_read = sign == '{' || sign == '[' ? read_all(t, sign == '{')
                 : sign == '"'              ? read_string(t)
                                            : read_word(t);
  t->depth--;
  return is_read;
}

int cs_json_text_read(lua_State *L) {
  size_t size;
  const char *text = luaL_checklstring(L, 1, &size);
  json_text t = {.L = L, .at = text, .end = text + size};
  lua_settop(L, 2);
  cs_host_charge(L, size);
  t.at += strncmp(text, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0; /* a byte order mark is skipped */
  if (read_value(&t) && (skip(&t), t.at == t.end || fail(&t, "something follows the value")))
    return 1;
  int line = 1;
  for (; text < t.at; text++)
    line += *text == '\n';
  if (!t.problem) /* a fault of the file */
    return cs_host_fail(L, cs_fail(cs_host_context(L), CELSPAN_INPUT,
                                   "line %d: nested deeper than %d levels", line, DEPTH));
  luaL_pushfail(L);
  lua_pushfstring(L, "line %d: %s", line, t.problem);
  return 2;
}
