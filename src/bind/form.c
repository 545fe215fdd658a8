#include "bind/form.h"

#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <string.h>

#include "base/number.h"
#include "bind/host.h"
#include "bind/suggest.h"
#include "bind/userdata.h"

#define MOST_FIELDS 32

_Noreturn void cs_form_fail(const cs_form *form, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  const char *text = lua_pushvfstring(form->L, format, arguments);
  va_end(arguments);
  luaL_error(form->L, "%s: %s", form->noun->name, text);
  for (;;) /* luaL_error does not return, though its declaration does not say so */
    ;
}

const char *cs_form_digits(lua_State *L, double number) {
  if (isnan(number)) /* whose sign means nothing */
    return lua_pushliteral(L, "nan");
  bool is_whole = fabs(number) < 1e15 && number == floor(number);
  return is_whole ? lua_pushfstring(L, "%I", (LUAI_UACINT)number)
                  : lua_pushfstring(L, "%f", number);
}

void cs_form_try(const cs_form *form, celspan_status status) {
  cs_host_try(form->L, form->noun->name, status);
}

/* ---------------------------------------------------------------- names */

static size_t list_names(const cs_noun *noun, const char **names) {
  size_t count = 0;
  for (const cs_field *field = noun->fields; field->name && count < MOST_FIELDS; field++)
    names[count++] = field->name;
  return count;
}

static bool is_known(const cs_noun *noun, const char *name) {
  for (const cs_field *field = noun->fields; field->name; field++)
    if (strcmp(field->name, name) == 0)
      return true;
  return false;
}

static _Noreturn void fail_unknown(const cs_form *form, const char *name) {
  const char *names[MOST_FIELDS] = {0};
  size_t count = list_names(form->noun, names);
  const char *nearest = cs_suggest_name(name, names, count);
  if (nearest)
    cs_form_fail(form, "unknown field '%s'; did you mean '%s'?", name, nearest);
  if (count == 0)
    cs_form_fail(form, "unknown field '%s'; there are no named fields", name);
  luaL_Buffer list;
  luaL_buffinit(form->L, &list);
  for (size_t i = 0; i < count; i++) {
    luaL_addstring(&list, i ? ", " : "");
    luaL_addstring(&list, names[i]);
  }
  luaL_pushresult(&list);
  cs_form_fail(form, "unknown field '%s'; the fields are %s", name, lua_tostring(form->L, -1));
}

static void check_position(const cs_form *form, lua_Integer place, lua_Integer length) {
  if (form->noun->list == CS_LIST_NONE)
    cs_form_fail(form, "takes named fields only, but was given a value at place %I",
                 (LUAI_UACINT)place);
  if (place < 1 || place > length)
    cs_form_fail(form, "there is a value at place %I of the list, but none at place %I",
                 (LUAI_UACINT)place, (LUAI_UACINT)(length + 1));
}

/* Checks all names before any value, so that a mistyped name is what people read about. Of
 * several unknown names the least is reported, whatever the order of the table. */
static void check_names(const cs_form *form) {
  lua_State *L = form->L;
  lua_Integer length = (lua_Integer)lua_rawlen(L, form->table);
  const char *unknown = NULL;
  for (lua_pushnil(L); lua_next(L, form->table); lua_pop(L, 1)) {
    if (lua_type(L, -2) == LUA_TSTRING) {
      const char *name = lua_tostring(L, -2);
      if (!is_known(form->noun, name) && (!unknown || strcmp(name, unknown) < 0))
        unknown = name;
    } else if (lua_isinteger(L, -2))
      check_position(form, lua_tointeger(L, -2), length);
    else
      cs_form_fail(form, "a field's name must be a word, got %s", cs_userdata_type(L, -2));
  }
  if (unknown)
    fail_unknown(form, unknown);
}

static void check_either(const cs_form *form) {
  const char *const *either = form->noun->either;
  if (either[0] && cs_form_has(form, either[0]) && cs_form_has(form, either[1]))
    cs_form_fail(form, "give '%s' or '%s', not both", either[0], either[1]);
}

cs_form cs_form_open(lua_State *L, const cs_noun *noun, int index) {
  cs_form form = {L, noun, lua_absindex(L, index)};
  luaL_checkstack(L, 40, noun->name);
  if (lua_type(L, index) != LUA_TTABLE)
    cs_form_fail(&form, "takes a table, %s{ ... }, got %s", noun->name, cs_userdata_type(L, index));
  check_names(&form);
  check_either(&form);
  return form;
}

/* ---------------------------------------------------------------- fields */

/* Pushes a field; the answer is its type. */
static int get_field(const cs_form *form, const char *name) {
  lua_pushstring(form->L, name);
  return lua_rawget(form->L, form->table);
}

static _Noreturn void fail_type(const cs_form *form, const char *name, const char *wanted) {
  cs_form_fail(form, "field '%s' must be %s, got %s", name, wanted, cs_userdata_type(form->L, -1));
}

bool cs_form_has(const cs_form *form, const char *name) {
  bool found = get_field(form, name) != LUA_TNIL;
  lua_pop(form->L, 1);
  return found;
}

double cs_form_number(const cs_form *form, const char *name) {
  if (get_field(form, name) != LUA_TNUMBER)
    fail_type(form, name, "a number");
  double number = lua_tonumber(form->L, -1);
  lua_pop(form->L, 1);
  return number;
}

double cs_form_number_or(const cs_form *form, const char *name, double fallback) {
  return cs_form_has(form, name) ? cs_form_number(form, name) : fallback;
}

int cs_form_integer_or(const cs_form *form, const char *name, int fallback) {
  if (!cs_form_has(form, name))
    return fallback;
  double number = cs_form_number(form, name);
  if (!(number >= INT_MIN && number <= INT_MAX) || number != (int)number)
    cs_form_fail(form, "field '%s' must be a whole number, got %s", name,
                 cs_form_digits(form->L, number));
  return (int)number;
}

const char *cs_form_text(const cs_form *form, const char *name) {
  if (get_field(form, name) != LUA_TSTRING)
    fail_type(form, name, "a string");
  const char *text = lua_tostring(form->L, -1); /* the table keeps it alive */
  if (strlen(text) != lua_rawlen(form->L, -1))
    cs_form_fail(form, "field '%s' must not hold a zero byte", name);
  lua_pop(form->L, 1);
  return text;
}

const char *cs_form_text_or(const cs_form *form, const char *name, const char *fallback) {
  return cs_form_has(form, name) ? cs_form_text(form, name) : fallback;
}

int cs_form_choice(const cs_form *form, const char *name, const char *const *names) {
  if (!cs_form_has(form, name))
    return 0;
  const char *word = cs_form_text(form, name);
  for (int i = 0; names[i]; i++)
    if (strcmp(names[i], word) == 0)
      return i;
  lua_pushliteral(form->L, "");
  for (int i = 0; names[i]; i++) {
    lua_pushfstring(form->L, "%s\"%s\"", i ? names[i + 1] ? ", " : " or " : "", names[i]);
    lua_concat(form->L, 2);
  }
  cs_form_fail(form, "field '%s' must be %s, got \"%s\"", name, lua_tostring(form->L, -1), word);
}

/* ---------------------------------------------------------------- arrays of numbers */

static bool is_array(lua_State *L, int index, int least, int most) {
  if (lua_type(L, index) != LUA_TTABLE)
    return false;
  int length = (int)lua_rawlen(L, index);
  bool good = length >= least && length <= most;
  for (int i = 1; good && i <= length; i++) {
    good = lua_rawgeti(L, index, i) == LUA_TNUMBER;
    lua_pop(L, 1);
  }
  return good;
}

static double number_at(lua_State *L, int index, int place) {
  lua_rawgeti(L, index, place);
  double number = lua_tonumber(L, -1);
  lua_pop(L, 1);
  return number;
}

bool cs_form_numbers(const cs_form *form, const char *name, int count, double *out) {
  lua_State *L = form->L;
  if (get_field(form, name) == LUA_TNIL) {
    lua_pop(L, 1);
    return false;
  }
  int place = lua_gettop(L);
  if (!is_array(L, place, count, count)) {
    bool is_table = lua_istable(L, place);
    cs_form_fail(form, "field '%s' must be an array of %d numbers, got %s", name, count,
                 is_table ? lua_pushfstring(L, "a table of %d values", (int)lua_rawlen(L, place))
                          : cs_userdata_type(L, place));
  }
  for (int i = 0; i < count; i++)
    out[i] = number_at(L, place, i + 1);
  lua_pop(L, 1);
  return true;
}

bool cs_form_point_or(const cs_form *form, const char *name, celspan_point *out) {
  double pair[2];
  if (!cs_form_numbers(form, name, 2, pair))
    return false;
  *out = (celspan_point){pair[0], pair[1]};
  return true;
}

celspan_point cs_form_point(const cs_form *form, const char *name) {
  celspan_point point;
  if (!cs_form_point_or(form, name, &point))
    cs_form_fail(form, "field '%s' must be a point {x, y}, got nil", name);
  return point;
}

bool cs_form_box(const cs_form *form, const char *name, celspan_box *out) {
  double n[4];
  if (!cs_form_numbers(form, name, 4, n))
    return false;
  *out = (celspan_box){n[0], n[1], n[2], n[3]};
  return true;
}

/* ---------------------------------------------------------------- colours */

/* Reads the value at index: a paint, or a string that names a colour. */
static bool read_paint(lua_State *L, int index, celspan_paint *out) {
  if (lua_type(L, index) == LUA_TSTRING)
    return celspan_paint_parse(lua_tostring(L, index), out);
  const cs_userdata *value = cs_userdata_test(L, index, &cs_kind_paint);
  if (value)
    *out = value->paint;
  return value != NULL;
}

static _Noreturn void fail_colour(const cs_form *form, const char *subject, const char *wanted) {
  if (lua_type(form->L, -1) == LUA_TSTRING)
    cs_form_fail(form, "%s must be %s, got \"%s\"", subject, wanted, lua_tostring(form->L, -1));
  cs_form_fail(form, "%s must be %s, got %s", subject, wanted, cs_userdata_type(form->L, -1));
}

static _Noreturn void fail_field_colour(const cs_form *form, const char *name, const char *wanted) {
  const char *subject = lua_pushfstring(form->L, "field '%s'", name);
  lua_insert(form->L, -2);
  fail_colour(form, subject, wanted);
}

bool cs_form_light(const cs_form *form, const char *name, celspan_light *out) {
  lua_State *L = form->L;
  int type = get_field(form, name);
  int place = lua_gettop(L);
  celspan_paint paint;
  if (type == LUA_TSTRING && celspan_paint_parse(lua_tostring(L, place), &paint)) {
    *out = (celspan_light){paint.pigment[0], paint.pigment[1], paint.pigment[2], paint.beta};
  } else if (type != LUA_TNIL) {
    if (!is_array(L, place, 3, 4))
      fail_field_colour(form, name, "a light {r, g, b}, {r, g, b, a} or \"#rrggbb\"");
    bool has_matte = lua_rawlen(L, place) == 4;
    *out = (celspan_light){(float)number_at(L, place, 1), (float)number_at(L, place, 2),
                           (float)number_at(L, place, 3),
                           has_matte ? (float)number_at(L, place, 4) : 1.0f};
  }
  lua_pop(L, 1);
  return type != LUA_TNIL;
}

celspan_texture *cs_form_texture(const cs_form *form, const char *name) {
  lua_State *L = form->L;
  if (get_field(form, name) == LUA_TNIL)
    return NULL;
  cs_userdata *value = cs_userdata_test(L, -1, &cs_kind_texture);
  if (!value)
    value = cs_userdata_test(L, -1, &cs_kind_paint);
  if (value)
    return value->handle; /* kept alive by the table */
  celspan_paint paint;
  if (!read_paint(L, -1, &paint))
    fail_field_colour(form, name, "a paint, a texture or a colour like \"#rrggbb\"");
  value = cs_userdata_push(L, &cs_noun_paint);
  celspan_texture *texture = NULL;
  cs_form_try(form, celspan_texture_create_paint(cs_host_context(L), &paint, &texture));
  value->handle = texture;
  return texture;
}

/* ---------------------------------------------------------------- lists */

int cs_form_length(const cs_form *form) {
  size_t length = lua_rawlen(form->L, form->table);
  if (length > 10000000)
    cs_form_fail(form, "the list has %I items; at most 10000000 are allowed", (LUAI_UACINT)length);
  return (int)length;
}

void cs_form_item(const cs_form *form, int i, int type, const char *what, const char *shape) {
  if (lua_rawgeti(form->L, form->table, i) != type)
    cs_form_fail(form, "%s %d must be %s, got %s", what, i, shape, cs_userdata_type(form->L, -1));
}

void *cs_form_scratch(lua_State *L, size_t count, size_t size) {
  return lua_newuserdatauv(L, count ? count * size : 1, 0);
}

celspan_point *cs_form_points(const cs_form *form, int index, int count, const double **weights) {
  lua_State *L = form->L;
  int list = lua_absindex(L, index);
  celspan_point *points = cs_form_scratch(L, (size_t)count, sizeof *points);
  double *weight = weights ? cs_form_scratch(L, (size_t)count, sizeof *weight) : NULL;
  for (int i = 0; i < count; i++) {
    lua_rawgeti(L, list, i + 1);
    int place = lua_gettop(L);
    if (!is_array(L, place, 2, weights ? 3 : 2))
      cs_form_fail(form, "point %d must be %s, got %s", i + 1,
                   weights ? "{x, y} or {x, y, weight}" : "{x, y}",
                   lua_istable(L, place) ? "a table of other values" : cs_userdata_type(L, place));
    points[i] = (celspan_point){number_at(L, place, 1), number_at(L, place, 2)};
    if (weights) {
      bool has_weight = lua_rawlen(L, place) == 3;
      weight[i] = has_weight ? number_at(L, place, 3) : 1;
      if (has_weight)
        *weights = weight;
    }
    lua_pop(L, 1);
  }
  return points;
}

double *cs_form_array(const cs_form *form, const char *name, size_t *count) {
  lua_State *L = form->L;
  if (get_field(form, name) == LUA_TNIL)
    return NULL;
  int place = lua_gettop(L);
  if (!is_array(L, place, 0, INT_MAX))
    fail_type(form, name, "an array of numbers");
  *count = lua_rawlen(L, place);
  double *numbers = cs_form_scratch(L, *count, sizeof *numbers);
  for (size_t i = 0; i < *count; i++)
    numbers[i] = number_at(L, place, (int)i + 1);
  return numbers;
}

double cs_form_tuple_number(const cs_form *form, int index, int i, const char *what, int item) {
  if (lua_rawgeti(form->L, index, i) != LUA_TNUMBER)
    cs_form_fail(form, "%s %d: its value %d must be a number, got %s", what, item, i,
                 cs_userdata_type(form->L, -1));
  double number = lua_tonumber(form->L, -1);
  lua_pop(form->L, 1);
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
    subject = lua_pushfstring(L, "%s %d: its value %d", what, item, i);
    lua_insert(L, -2);
    fail_colour(form, subject, "a paint or a colour like \"#rrggbb\"");
  }
  lua_pop(L, 1);
  return paint;
}

double cs_form_argument(lua_State *L, int index, const char *function, const char *name) {
  if (lua_type(L, index) != LUA_TNUMBER)
    luaL_error(L, "%s: %s must be a number, got %s", function, name, cs_userdata_type(L, index));
  double number = lua_tonumber(L, index);
  if (!(fabs(number) <= CS_NUMBER_LIMIT))
    luaL_error(L, "%s: %s must be a number from -1e12 to 1e12, got %s", function, name,
               cs_form_digits(L, number));
  return number;
}
