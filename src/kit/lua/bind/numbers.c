#include "lua/bind/numbers.h"

#include <lauxlib.h>
#include <math.h>
#include <string.h>

#include "lua/bind/caller.h"
#include "lua/bind/list.h"
#include "lua/bind/unknown.h"
#include "lua/bind/userdata.h"

const char *cs_numbers_digits(lua_State *L, double number) {
  if (isnan(number)) /* the sign of NaN has no meaning */
    return lua_pushliteral(L, "nan");
  bool is_whole = fabs(number) < 1e15 && number == floor(number);
  return is_whole ? lua_pushfstring(L, "%I", (LUAI_UACINT)number)
                  : lua_pushfstring(L, "%f", number);
}

/* ---------------------------------------------------------------- what is wrong */

static void fail_number(lua_State *L, int index, const char *noun, const char *subject) {
  if (lua_type(L, index) != LUA_TNUMBER)
    cs_caller_error(L, "%s: %s must be a number, got %s", noun, subject,
                    cs_userdata_type(L, index));
  cs_caller_error(L, "%s: %s must be a finite number, got %s", noun, subject,
                  cs_numbers_digits(L, lua_tonumber(L, index)));
}

double cs_numbers_check(lua_State *L, int index, const char *noun, const char *subject) {
  double number = lua_tonumber(L, index);
  if (lua_type(L, index) != LUA_TNUMBER || !isfinite(number))
    fail_number(L, index, noun, subject);
  return number;
}

static const char *push_whole(lua_State *L, const cs_numbers_name *name) {
  return name->field    ? lua_pushfstring(L, "field '%s'", name->field)
         : name->number ? lua_pushfstring(L, name->whole, name->number)
                        : lua_pushstring(L, name->whole);
}

static const char *push_item(lua_State *L, const cs_numbers_name *name, int i) {
  return name->field    ? lua_pushfstring(L, "%s[%d]", name->field, i)
         : name->number ? lua_pushfstring(L, name->item, name->number, i)
                        : lua_pushfstring(L, name->item, i);
}

/* Checks the values of the list from number `first` up to `last`. */
static void check_values(lua_State *L, int index, const cs_numbers_name *name, int first,
                         int last) {
  for (int i = first; i <= last; i++) {
    lua_rawgeti(L, index, i);
    if (lua_type(L, -1) != LUA_TNUMBER || !isfinite(lua_tonumber(L, -1))) {
      const char *item = push_item(L, name, i);
      fail_number(L, lua_gettop(L) - 1, name->noun, item);
    }
    lua_pop(L, 1);
  }
}

static int fail_list(lua_State *L, int index, const cs_numbers_name *name, int least, int most) {
  const char *whole = push_whole(L, name),
             *shape =
                 name->shape ? name->shape : lua_pushfstring(L, "an array of %d numbers", most);
  if (lua_type(L, index) != LUA_TTABLE)
    return cs_caller_error(L, "%s: %s must be %s, got %s", name->noun, whole, shape,
                           cs_userdata_type(L, index));
  const char *places = strchr(shape, '{');
  if (places && cs_unknown_push_places(L, index, places))
    return cs_caller_error(L, "%s: %s must be %s: %s", name->noun, whole, shape,
                           lua_tostring(L, -1));
  int length = (int)cs_list_length(L, index);
  if (length == 0 && lua_rawgeti(L, index, least) == LUA_TNIL) {
    bool has_names = lua_next(L, index) != 0; /* after the nil that is on top of the stack */
    return cs_caller_error(L, "%s: %s must be %s, got %s", name->noun, whole, shape,
                           has_names ? "a table of other values" : "an empty table");
  }
  check_values(L, index, name, 1, least);
  check_values(L, index, name, least + 1, length < most ? length : most);
  return cs_caller_error(L, "%s: %s must be %s, got %d value%s", name->noun, whole, shape, length,
                         length == 1 ? "" : "s");
}

/* ---------------------------------------------------------------- reading */

/* Reads the next `count` values. Returns whether they are finite numbers. */
static bool read(lua_State *L, int index, int count, double *out) {
  bool good = true;
  for (int i = 0; good && i < count; i++) {
    good = lua_rawgeti(L, index, i + 1) == LUA_TNUMBER;
    out[i] = lua_tonumber(L, -1);
    good = good && isfinite(out[i]);
    lua_pop(L, 1);
  }
  return good;
}

int cs_numbers_read(lua_State *L, int index, const cs_numbers_name *name, int least, int most,
                    double *out) {
  index = lua_absindex(L, index);
  bool is_table = lua_type(L, index) == LUA_TTABLE;
  size_t length = is_table ? (size_t)cs_list_length(L, index) : 0;
  if (!is_table || length < (size_t)least || length > (size_t)most ||
      !read(L, index, (int)length, out))
    fail_list(L, index, name, least, most);
  return (int)length;
}

void cs_numbers_read_all(lua_State *L, int index, const cs_numbers_name *name, int count,
                         double *out) {
  index = lua_absindex(L, index);
  if (!read(L, index, count, out))
    check_values(L, index, name, 1, count);
}
