#include "lua/nouns/contours.h"

#include <math.h>
#include <string.h>

#include "lua/bind/caller.h"
#include "lua/bind/list.h"
#include "lua/bind/numbers.h"
#include "lua/bind/userdata.h"

/* Reads a contour in one pass over its table, in which places come in any order. False: something
 * is wrong with it. */
static bool read_contour(lua_State *L, int index, size_t count, double *out, bool *closed) {
  bool good = true;
  size_t found = 0;
  for (lua_pushnil(L); lua_next(L, index); lua_pop(L, 1)) {
    lua_Integer place = lua_isinteger(L, -2) ? lua_tointeger(L, -2) : 0;
    if (place >= 1 && (size_t)place <= count) {
      out[place - 1] = lua_type(L, -1) == LUA_TNUMBER ? lua_tonumber(L, -1) : NAN;
      good = good && isfinite(out[place - 1]);
      found++;
    } else {
      good = good && lua_type(L, -2) == LUA_TSTRING && lua_isboolean(L, -1) &&
             strcmp(lua_tostring(L, -2), "closed") == 0;
      *closed = lua_toboolean(L, -1);
    }
  }
  return good && found == count && count % 6 == 2;
}

/* Of the names beside the numbers: the first in sorted order that is not `closed`, or NULL. */
static const char *find_unknown(lua_State *L, int index) {
  const char *unknown = NULL;
  for (lua_pushnil(L); lua_next(L, index); lua_pop(L, 1)) {
    const char *name = lua_type(L, -2) == LUA_TSTRING ? lua_tostring(L, -2) : NULL;
    if (name && strcmp(name, "closed") != 0 && (!unknown || strcmp(name, unknown) < 0))
      unknown = name;
  }
  return unknown;
}

/* Says what is wrong with contour `number`, the table at index. */
static void fail_contour(lua_State *L, const char *noun, int index, int number) {
  const cs_numbers_name name = {.noun = noun, .item = "contours[%d][%d]", .number = number};
  const int count = (int)cs_list_length(L, index);
  const char *unknown = find_unknown(L, index);
  if (unknown)
    cs_caller_error(L,
                    "%s: contours[%d] has the field '%s'; beside its numbers it may only have "
                    "'closed'",
                    noun, number, unknown);
  lua_pushliteral(L, "closed");
  lua_rawget(L, index);
  if (!lua_isnil(L, -1) && !lua_isboolean(L, -1))
    cs_caller_error(L, "%s: contours[%d].closed must be true or false, got %s", noun, number,
                    cs_userdata_shown(L, -1));
  cs_numbers_read_all(L, index, &name, count, cs_form_scratch(L, (size_t)count, sizeof(double)));
  cs_caller_error(L, "%s: contours[%d] has %d numbers; it must have 2, and 6 more for each piece",
                  noun, number, count);
}

/* The numbers of all contours of the list at index. */
static size_t count_numbers(lua_State *L, const char *noun, int list, int count) {
  size_t sum = 0;
  for (int i = 1; i <= count; i++) {
    if (lua_rawgeti(L, list, i) != LUA_TTABLE)
      cs_caller_error(L, "%s: contours[%d] must be a list of numbers, { x, y, ... }, got %s", noun,
                      i, cs_userdata_type(L, -1));
    sum += lua_rawlen(L, -1);
    lua_pop(L, 1);
  }
  return sum;
}

cs_contour_list cs_contours_read(lua_State *L, const char *noun) {
  const int list = lua_gettop(L);
  if (!lua_istable(L, list))
    cs_caller_error(L, "%s: contours must be a list of contours { x, y, ... }, got %s", noun,
                    cs_userdata_type(L, list));
  cs_contour_list contours = {.count = (size_t)cs_list_length(L, list)};
  size_t sum = count_numbers(L, noun, list, (int)contours.count), at = 0;
  contours.items = cs_form_scratch(L, contours.count, sizeof *contours.items);
  celspan_point *points = cs_form_scratch(L, sum / 2 + 1, sizeof *points);
  for (size_t i = 0; i < contours.count; i++) {
    lua_rawgeti(L, list, (lua_Integer)i + 1);
    size_t count = lua_rawlen(L, -1);
    bool closed = false;
    if (at + count / 2 > sum / 2 ||
        !read_contour(L, lua_gettop(L), count, (double *)&points[at], &closed))
      fail_contour(L, noun, lua_gettop(L), (int)i + 1);
    contours.items[i] = (celspan_contour){&points[at], count / 2, closed};
    at += count / 2;
    lua_pop(L, 1);
  }
  return contours;
}

cs_contour_list cs_contours_field(const cs_form *form) {
  return cs_form_get(form, "contours") == LUA_TNIL ? (cs_contour_list){NULL, 0}
                                                   : cs_contours_read(form->L, form->noun->name);
}
