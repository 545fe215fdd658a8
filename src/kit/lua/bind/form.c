#include "lua/bind/form.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "inside/number.h"
#include "lua/bind/caller.h"
#include "lua/bind/host.h"
#include "lua/bind/list.h"
#include "lua/bind/numbers.h"
#include "lua/bind/suggest.h"
#include "lua/bind/unknown.h"
#include "lua/bind/userdata.h"
#include "readers/svg/words/colours.h"

_Noreturn void cs_form_fail(const cs_form *form, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  const char *text = lua_pushvfstring(form->L, format, arguments);
  va_end(arguments);
  cs_caller_error(form->L, "%s: %s", form->noun->name, text);
  for (;;) /* cs_caller_error does not return, though its declaration does not say so */
    ;
}

const char *cs_form_digits(lua_State *L, double number) { return cs_numbers_digits(L, number); }

void cs_form_try(const cs_form *form, celspan_status status) {
  cs_host_try(form->L, form->noun->name, status);
}

/* ---------------------------------------------------------------- names */

static bool is_known(const cs_noun *noun, const char *name) {
  for (const cs_field *field = noun->fields; field->name; field = cs_field_next(field))
    if (strcmp(field->name, name) == 0)
      return true;
  return false;
}

/* celspan's name of a field that is spelled in another way; NULL: the noun has no such field. */
static const char *own_name(const cs_noun *noun, const char *name, char out[CS_SUGGEST_SIZE]) {
  const char *own = cs_suggest_own(name, true, out);
  return own && is_known(noun, own) ? own : NULL;
}

static void check_position(const cs_form *form, lua_Integer place) {
  if (form->noun->list == CS_LIST_NONE && !form->noun->by_place)
    cs_form_fail(form, "takes named fields only, but was given a value at place %I",
                 (LUAI_UACINT)place);
  if (place < 1)
    cs_form_fail(form, "there is a value at place %I of the list, which begins at place 1",
                 (LUAI_UACINT)place);
}

/* How many values of the list are not fields. */
static int count_kept(const cs_noun *noun) { return noun->list == CS_LIST_TUPLE ? 1 : 0; }

/* A list with a missing value could end there in one process, and later in another one. */
static void check_gaps(const cs_form *form) {
  lua_State *L = form->L;
  lua_Integer length = cs_form_length(form);
  lua_Integer gap = cs_list_find_gap(L, form->table, length, false);
  if (gap > 0)
    cs_form_fail(form, "there is a value at place %I of the list, but none at place %I",
                 (LUAI_UACINT)length, (LUAI_UACINT)gap);
}

static const char *least(const char *a, const char *b) { return !a || strcmp(b, a) < 0 ? b : a; }

/* Checks all names before any value, so that users first read about a mistyped name. Of several
 * unknown names, the first in sorted order is reported, whatever the order in the table. Returns
 * whether some fields are given by another name or by their place. */
static bool check_names(const cs_form *form) {
  lua_State *L = form->L;
  const cs_noun *noun = form->noun;
  const char *unknown = NULL, *twice = NULL;
  char out[CS_SUGGEST_SIZE];
  bool has_others = false;
  for (lua_pushnil(L); lua_next(L, form->table); lua_pop(L, 1)) {
    if (lua_type(L, -2) == LUA_TSTRING) {
      const char *name = lua_tostring(L, -2);
      if (is_known(noun, name))
        continue;
      const char *own = own_name(noun, name, out);
      has_others |= own != NULL;
      if (!own)
        unknown = least(unknown, name);
      else if (cs_form_has(form, own))
        twice = least(twice, name);
    } else if (lua_isinteger(L, -2)) {
      check_position(form, lua_tointeger(L, -2));
      has_others |= noun->by_place && lua_tointeger(L, -2) > count_kept(noun);
    } else
      cs_form_fail(form, "a field's name must be a word, got %s", cs_userdata_type(L, -2));
  }
  if (unknown)
    cs_unknown_fail(L, noun, form->table, unknown);
  if (twice)
    cs_form_fail(form, "'%s' and '%s' are one field: give one of them", twice,
                 own_name(noun, twice, out));
  return has_others;
}

/* Gives the copy of the table the fields that are in the list by their places. */
static void place_values(const cs_form *form, int copy) {
  lua_State *L = form->L;
  int at = count_kept(form->noun) + 1, wanted = at - 1;
  lua_Integer count = cs_list_length(L, form->table);
  for (const cs_place *place = form->noun->by_place; place->field; place++)
    wanted += place->count;
  if (count != wanted)
    cs_form_fail(form, "takes %s, got %I value%s", form->noun->places, (LUAI_UACINT)count,
                 count == 1 ? "" : "s");
  for (const cs_place *place = form->noun->by_place; place->field; place++) {
    lua_pushstring(L, place->field);
    lua_pushvalue(L, -1);
    if (lua_rawget(L, copy) != LUA_TNIL)
      cs_form_fail(form, "field '%s' is given by its place, too: give it once", place->field);
    if (place->count > 1)
      lua_createtable(L, place->count, 0);
    for (int i = 1; i <= place->count; i++) {
      lua_rawgeti(L, form->table, at++);
      if (place->count > 1)
        lua_rawseti(L, -2, i);
    }
    lua_remove(L, -2); /* nil */
    lua_rawset(L, copy);
  }
}

/* Replaces the table by a copy whose fields have celspan's names. */
static void settle(cs_form *form) {
  lua_State *L = form->L;
  const cs_noun *noun = form->noun;
  char own[CS_SUGGEST_SIZE];
  bool has_places = false;
  lua_createtable(L, count_kept(noun), 8);
  int copy = lua_gettop(L);
  for (lua_pushnil(L); lua_next(L, form->table); lua_pop(L, 1)) {
    bool is_name = lua_type(L, -2) == LUA_TSTRING,
         is_own = is_name && is_known(noun, lua_tostring(L, -2));
    bool has_place = !is_name && noun->by_place && lua_tointeger(L, -2) > count_kept(noun);
    has_places |= has_place;
    form->has_others |= is_name && !is_own;
    if (has_place)
      continue;
    if (is_name && !is_own)
      lua_pushstring(L, own_name(noun, lua_tostring(L, -2), own));
    else
      lua_pushvalue(L, -2);
    lua_pushvalue(L, -2);
    lua_rawset(L, copy);
  }
  if (has_places)
    place_values(form, copy);
  lua_replace(L, form->table);
}

void cs_form_settle(lua_State *L, const cs_noun *noun, int index) {
  cs_form form = {.L = L, .noun = noun, .table = lua_absindex(L, index)};
  luaL_checkstack(L, 40, noun->name);
  if (check_names(&form))
    settle(&form);
}

static void check_either(const cs_form *form) {
  const char *const *either = form->noun->either;
  if (either[0] && cs_form_has(form, either[0]) && cs_form_has(form, either[1]))
    cs_form_fail(form, "give '%s' or '%s', not both", either[0], either[1]);
  for (const char *const *name = form->noun->second; name && *name; name++)
    if (cs_form_has(form, *name) && !cs_form_has(form, either[1]))
      cs_form_fail(form, "field '%s' goes with '%s', which is not given", *name, either[1]);
}

cs_form cs_form_open(lua_State *L, const cs_noun *noun, int index) {
  cs_form form = {.L = L, .noun = noun, .table = lua_absindex(L, index)};
  luaL_checkstack(L, 40, noun->name);
  if (lua_type(L, index) != LUA_TTABLE)
    cs_form_fail(&form, "takes a table%s%s{ ... }, got %s", noun->kind ? ", " : " ",
                 noun->kind ? noun->name : "", cs_userdata_type(L, index));
  if (check_names(&form))
    settle(&form);
  check_gaps(&form);
  check_either(&form);
  return form;
}

/* ---------------------------------------------------------------- fields */

int cs_form_get(const cs_form *form, const char *name) {
  lua_pushstring(form->L, name);
  return lua_rawget(form->L, form->table);
}

bool cs_form_has(const cs_form *form, const char *name) {
  bool found = cs_form_get(form, name) != LUA_TNIL;
  lua_pop(form->L, 1);
  return found;
}

/* ---------------------------------------------------------------- colours */

const char *cs_form_hex(const char *text, char out[CS_FORM_HEX]) {
  celspan_paint paint;
  cs_svg_colour named;
  const char *end = text;
  if (celspan_paint_parse(text, &paint))
    return text;
  if (strchr(text, '(') || !cs_svg_take_colour(&end, &named) || *end || end == text)
    return NULL;
  int codes[3];
  for (int c = 0; c < 3; c++)
    codes[c] = (int)lround(255 * named.rgb[c]);
  snprintf(out, CS_FORM_HEX, named.alpha > 0 ? "#%02x%02x%02x" : "#0000", codes[0], codes[1],
           codes[2]);
  return out;
}

bool cs_form_colour(const char *text, celspan_paint *out) {
  char code[CS_FORM_HEX];
  const char *hex = text[0] == '#' ? text : cs_form_hex(text, code);
  return hex && celspan_paint_parse(hex, out);
}

const char *cs_form_shown_colour(lua_State *L, int index) {
  size_t count;
  const char *const *names = cs_svg_colour_names(&count);
  const char *word = lua_type(L, index) == LUA_TSTRING ? lua_tostring(L, index) : "";
  const char *shown = cs_userdata_shown(L, index), *nearest = cs_suggest_name(word, names, count);
  return nearest ? lua_pushfstring(L, "%s; did you mean \"%s\"?", shown, nearest) : shown;
}

/* Reads the value at index: a paint, or a string that names a colour. */
static bool read_paint(lua_State *L, int index, celspan_paint *out) {
  if (lua_type(L, index) == LUA_TSTRING)
    return cs_form_colour(lua_tostring(L, index), out);
  const cs_userdata *value = cs_userdata_test(L, index, &cs_kind_paint);
  if (value)
    *out = *(const celspan_paint *)cs_userdata_own(value);
  return value != NULL;
}

/* A word of another field says what was meant, as in fill = "evenodd". */
static _Noreturn void fail_colour(const cs_form *form, const char *subject, const char *wanted) {
  lua_State *L = form->L;
  const char *word = lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : NULL;
  const char *field = word ? cs_unknown_field_of(form->noun, word) : NULL;
  cs_form_fail(form, "%s must be %s, got %s", subject, wanted,
               field ? lua_pushfstring(L, "\"%s\"; write %s = \"%s\"", word, field, word)
                     : cs_form_shown_colour(L, -1));
}

celspan_texture *cs_form_texture(const cs_form *form, const char *name) {
  lua_State *L = form->L;
  cs_userdata *value = cs_userdata_test(L, -1, &cs_kind_texture);
  if (!value)
    value = cs_userdata_test(L, -1, &cs_kind_paint);
  if (value)
    return value->handle; /* the stack holds it */
  celspan_paint paint;
  if (!read_paint(L, -1, &paint)) {
    bool is_shown = form->has_others || lua_isnil(L, -1);
    const char *subject =
        lua_pushfstring(L, "field '%s'", is_shown ? cs_suggest_shown(name) : name);
    lua_insert(L, -2);
    fail_colour(form, subject, "a paint, a texture or a colour like \"#rrggbb\"");
  }
  value = cs_userdata_push(L, &cs_noun_paint);
  celspan_texture *texture = NULL;
  cs_form_try(form, celspan_texture_create_paint(cs_host_context(L), &paint, &texture));
  value->handle = texture;
  return texture;
}

/* ---------------------------------------------------------------- lists */

int cs_form_length(const cs_form *form) {
  lua_Integer length = cs_list_length(form->L, form->table);
  if (length > CS_FORM_ITEMS_MOST)
    cs_form_fail(form, "the list has %I items; at most %d are allowed", (LUAI_UACINT)length,
                 CS_FORM_ITEMS_MOST);
  return (int)length;
}

void cs_form_item(const cs_form *form, int i, int type, const char *what, const char *shape) {
  lua_State *L = form->L;
  if (lua_rawgeti(L, form->table, i) != type)
    cs_form_fail(form, "%s %d must be %s, got %s", what, i, shape, cs_userdata_type(L, -1));
  bool is_empty = type == LUA_TTABLE && lua_rawlen(L, -1) == 0;
  if (is_empty && cs_unknown_push_places(L, -1, shape))
    cs_form_fail(form, "%s %d must be %s: %s", what, i, shape, lua_tostring(L, -1));
}

void *cs_form_scratch(lua_State *L, size_t count, size_t size) {
  if (count > CS_FORM_ITEMS_MOST)
    cs_caller_error(L, "the list has %I items; at most %d are allowed", (LUAI_UACINT)count,
                    CS_FORM_ITEMS_MOST);
  return lua_newuserdatauv(L, count ? count * size : 1, 0);
}

celspan_point *cs_form_points(const cs_form *form, int index, size_t count,
                              const double **weights) {
  lua_State *L = form->L;
  int list = lua_absindex(L, index), most = weights ? 3 : 2;
  celspan_point *points = cs_form_scratch(L, count, sizeof *points);
  double *weight = weights ? cs_form_scratch(L, count, sizeof *weight) : NULL;
  cs_numbers_name name = {.noun = form->noun->name,
                          .whole = "point %d",
                          .item = "point %d: its value %d",
                          .shape = weights ? "{x, y} or {x, y, weight}" : "{x, y}"};
  for (int i = 0; i < (int)count; i++) {
    double n[3] = {0, 0, 1};
    name.number = i + 1;
    lua_rawgeti(L, list, i + 1);
    bool has_weight = cs_numbers_read(L, -1, &name, 2, most, n) == 3;
    points[i] = (celspan_point){n[0], n[1]};
    if (weights)
      weight[i] = n[2];
    if (has_weight)
      *weights = weight;
    lua_pop(L, 1);
  }
  return points;
}

double *cs_form_array(const cs_form *form, const char *name, size_t *count) {
  lua_State *L = form->L;
  int type = cs_form_get(form, name), place = lua_gettop(L);
  if (type == LUA_TNIL)
    return NULL;
  if (type != LUA_TTABLE)
    cs_form_fail(form, "field '%s' must be an array of numbers, got %s", name,
                 cs_userdata_type(L, -1));
  *count = (size_t)cs_list_length(L, place);
  const cs_numbers_name list = {.noun = form->noun->name, .field = name};
  double *numbers = cs_form_scratch(L, *count, sizeof *numbers);
  cs_numbers_read_all(L, place, &list, (int)*count, numbers);
  return numbers;
}

double cs_form_tuple_number(const cs_form *form, int index, int i, const char *what, int item) {
  lua_State *L = form->L;
  bool good = lua_rawgeti(L, index, i) == LUA_TNUMBER && isfinite(lua_tonumber(L, -1));
  const char *subject = good ? what : lua_pushfstring(L, "%s %d: its value %d", what, item, i);
  double number = cs_numbers_check(L, good ? -1 : -2, form->noun->name, subject);
  lua_pop(L, 1);
  return number;
}

celspan_paint cs_form_tuple_paint(const cs_form *form, int index, int i, const char *what,
                                  int item) {
  lua_State *L = form->L;
  index = lua_absindex(L, index);
  const char *subject = NULL;
  celspan_paint paint;
  lua_rawgeti(L, index, i);
  if (!read_paint(L, -1, &paint)) {
    subject = item ? lua_pushfstring(L, "%s %d: its value %d", what, item, i)
                   : lua_pushfstring(L, "%s %d", what, i);
    lua_insert(L, -2);
    fail_colour(form, subject, "a paint or a colour like \"#rrggbb\"");
  }
  lua_pop(L, 1);
  return paint;
}

double cs_form_argument(lua_State *L, int index, const char *function, const char *name) {
  double number = cs_numbers_check(L, index, function, name);
  if (fabs(number) > CS_NUMBER_LIMIT)
    cs_caller_error(L, "%s: %s must be between -1e12 and 1e12, got %s", function, name,
                    cs_form_digits(L, number));
  return number;
}
