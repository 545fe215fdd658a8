#include "lua/bind/anchor.h"

#include <string.h>

#include "inside/geometry.h"
#include "lua/bind/caller.h"
#include "lua/bind/form.h"
#include "lua/bind/host.h"
#include "lua/bind/numbers.h"
#include "lua/bind/suggest.h"

/* By rows of three; the pivot is no place of the bounds. */
static const char *const words[] = {"top left",     "top",   "top right",   "left",
                                    "centre",       "right", "bottom left", "bottom",
                                    "bottom right", "pivot"};
enum { COUNT = sizeof words / sizeof *words, PIVOT = COUNT - 1 };

bool cs_anchor_is_whole(lua_State *L, int index) {
  return lua_type(L, index) == LUA_TSTRING || lua_istable(L, index);
}

static cs_anchor *anchor_of(const cs_userdata *value) { return cs_userdata_own(value); }

/* Raises: the word at index names no place. */
static _Noreturn void refuse_word(lua_State *L, int index, const char *method) {
  const char *word = lua_tostring(L, index), *near = cs_suggest_name(word, words, COUNT);
  luaL_Buffer list;
  luaL_buffinit(L, &list);
  for (int i = 0; !near && i < COUNT; i++) {
    luaL_addstring(&list, i == 0 ? "; the places are \"" : ", \"");
    luaL_addstring(&list, words[i]);
    luaL_addchar(&list, '"');
  }
  luaL_pushresult(&list);
  cs_caller_error(L, "%s: there is no place %s%s", method, cs_userdata_shown(L, index),
                  near ? lua_pushfstring(L, "; did you mean \"%s\"?", near) : lua_tostring(L, -1));
  for (;;) /* cs_caller_error does not return, though its declaration does not say so */
    ;
}

static celspan_point read_pivot(lua_State *L, const char *method, const cs_userdata *value) {
  const cs_anchor *anchor = anchor_of(value);
  if (!anchor->has_pivot && !anchor->has_baseline)
    cs_caller_error(L, "%s: this %s has no pivot: give it one, value:with { pivot = { x, y } }",
                    method, value->noun->name);
  return anchor->has_pivot ? anchor->pivot : anchor->baseline;
}

/* The place that the word at index names. */
static bool read_word(lua_State *L, int index, const char *method, const cs_userdata *value,
                      celspan_point *out) {
  const cs_anchor *anchor = anchor_of(value);
  const char *word = lua_tostring(L, index);
  char spelled[CS_SUGGEST_SIZE];
  const char *own = cs_suggest_own(word, false, spelled);
  bool is_there = false;
  celspan_box box;
  int i = 0;
  while (i < COUNT && strcmp(words[i], own ? own : word) != 0)
    i++;
  if (i == COUNT)
    refuse_word(L, index, method);
  if (i == PIVOT) {
    *out = read_pivot(L, method, value);
    return true;
  }
  cs_host_try(L, method,
              value->noun->kind->bounds(cs_host_context(L), value->handle, &is_there, &box));
  if (!is_there)
    return false;
  *out = (celspan_point){box.x + box.width * (i % 3) / 2, box.y + box.height * (i / 3) / 2};
  if (i / 3 == 2 && anchor->has_baseline)
    out->y = anchor->baseline.y;
  return true;
}

bool cs_anchor_read(lua_State *L, int index, const char *method, const cs_userdata *value,
                    celspan_point *out) {
  const cs_numbers_name name = {.noun = method,
                                .whole = "the centre",
                                .item = "value %d of the centre",
                                .shape = "a point {x, y}"};
  double pair[2] = {0, 0};
  if (lua_type(L, index) == LUA_TSTRING)
    return read_word(L, index, method, value, out);
  if (lua_istable(L, index)) {
    cs_numbers_read(L, index, &name, 2, 2, pair);
  } else if (!lua_isnoneornil(L, index) || !lua_isnoneornil(L, index + 1)) {
    pair[0] = cs_form_argument(L, index, method, "the centre's x");
    pair[1] = cs_form_argument(L, index + 1, method, "the centre's y");
  }
  *out = (celspan_point){pair[0], pair[1]};
  return true;
}

/* ---------------------------------------------------------------- pivots */

static celspan_point moved(const celspan_matrix *matrix, celspan_point from) {
  const cs_hpoint to = cs_matrix_apply(matrix, (cs_hpoint){from.x, from.y, 1});
  return (celspan_point){to.x / to.w, to.y / to.w};
}

void cs_anchor_move(cs_userdata *value, const celspan_matrix *matrix) {
  cs_anchor *anchor = anchor_of(value);
  if (anchor->has_pivot)
    anchor->pivot = moved(matrix, anchor->pivot);
  if (anchor->has_baseline)
    anchor->baseline = moved(matrix, anchor->baseline);
}

void cs_anchor_keep_pivot(const cs_userdata *from, cs_userdata *value) {
  anchor_of(value)->pivot = anchor_of(from)->pivot;
  anchor_of(value)->has_pivot = anchor_of(from)->has_pivot;
}

void cs_anchor_set_pivot(lua_State *L, int index) {
  const cs_userdata *value = lua_touserdata(L, -1);
  const celspan_matrix nowhere = celspan_matrix_identity();
  celspan_point pivot;
  if (!cs_anchor_is_whole(L, index))
    cs_caller_error(L,
                    "with: the pivot must be a point {x, y} or a place such as \"bottom\", got %s",
                    cs_userdata_type(L, index));
  bool is_there = cs_anchor_read(L, index, "with", value, &pivot);
  cs_userdata *copy = cs_userdata_push_like(L, -1, false);
  cs_host_try(
      L, "with",
      value->noun->kind->transform(cs_host_context(L), value->handle, &nowhere, &copy->handle));
  if (is_there) {
    anchor_of(copy)->pivot = pivot;
    anchor_of(copy)->has_pivot = true;
  }
  lua_remove(L, -2);
}
