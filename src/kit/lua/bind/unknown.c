#include "lua/bind/unknown.h"

#include <lauxlib.h>
#include <string.h>

#include "lua/bind/caller.h"
#include "lua/bind/suggest.h"

#define MOST_NAMES 48
#define MOST_PLACES 9
#define NAME_SIZE 8

/* ---------------------------------------------------------------- places */

/* The names in a shape such as {x, y}. */
typedef struct place_list {
  char names[MOST_PLACES][NAME_SIZE];
  int count;
} place_list;

static place_list split(const char *text) {
  place_list places = {.count = 0};
  const char *at = text + strcspn(text, "{");
  at += *at == '{'; /* "" has no places */
  while (places.count < MOST_PLACES) {
    at += strspn(at, " ,");
    size_t size = strcspn(at, " ,}");
    if (size == 0 || size >= NAME_SIZE)
      break;
    memcpy(places.names[places.count++], at, size);
    at += size;
  }
  return places;
}

/* Pushes a field of the table, also under a longer name; returns its type. */
static int get(lua_State *L, int table, const char *name, const char **called) {
  static const char *const longer[][2] = {{"w", "width"}, {"h", "height"}, {"r", "red"},
                                          {"g", "green"}, {"b", "blue"},   {"x", "cx"},
                                          {"y", "cy"}};
  *called = name;
  lua_pushstring(L, name);
  int type = lua_rawget(L, table);
  for (size_t i = 0; type == LUA_TNIL && i < sizeof longer / sizeof *longer; i++) {
    if (strcmp(longer[i][0], name) != 0)
      continue;
    lua_pop(L, 1);
    *called = longer[i][1];
    lua_pushstring(L, *called);
    type = lua_rawget(L, table);
  }
  return type;
}

/* Appends the text on top of the stack to the text below it, with a comma between unless it is the
   first.
 */
static void join(lua_State *L, int i) {
  lua_pushstring(L, i > 0 ? ", " : "");
  lua_insert(L, -2);
  lua_concat(L, 3);
}

/* Pushes the values of the places, "10, 20", or with their names, "x = 10, y = 20". Values that the
 * table lacks are replaced by their names, or left out. */
static void push_values(lua_State *L, int table, const place_list *places, bool is_named) {
  int shown = 0;
  lua_pushliteral(L, "");
  for (int i = 0; i < places->count; i++) {
    const char *called;
    int type = get(L, table, places->names[i], &called);
    if (type == LUA_TNIL && is_named) {
      lua_pop(L, 1);
      continue;
    }
    const char *value = type == LUA_TNUMBER ? luaL_tolstring(L, -1, NULL) : places->names[i];
    if (type != LUA_TNUMBER)
      lua_pushnil(L); /* replaces the text of the number */
    if (is_named)
      lua_pushfstring(L, "%s = %s", called, type == LUA_TNUMBER ? value : "...");
    else
      lua_pushstring(L, value);
    lua_replace(L, -3);
    lua_pop(L, 1);
    join(L, shown++);
  }
}

static bool names_one(lua_State *L, int table, const place_list *places) {
  bool found = false;
  for (int i = 0; i < places->count; i++) {
    const char *called;
    found |= get(L, table, places->names[i], &called) != LUA_TNIL;
    lua_pop(L, 1);
  }
  return found;
}

/* Pushes "before{10, 20}, not before{x = 10, y = 20}". */
static const char *push_both(lua_State *L, int table, const char *text, const char *before,
                             const char *gap) {
  place_list places = split(text);
  push_values(L, table, &places, false);
  push_values(L, table, &places, true);
  return lua_pushfstring(L, "write %s{%s%s%s}, not %s{%s%s%s}", before, gap, lua_tostring(L, -2),
                         gap, before, gap, lua_tostring(L, -1), gap);
}

bool cs_unknown_push_places(lua_State *L, int index, const char *text) {
  index = lua_absindex(L, index);
  place_list places = split(text);
  if (!names_one(L, index, &places))
    return false;
  push_both(L, index, text, "", "");
  lua_replace(L, -3);
  lua_pop(L, 1);
  return true;
}

/* ---------------------------------------------------------------- fields */

static bool is_place(const place_list *places, const char *name) {
  static const char *const longer[][2] = {
      {"width", "w"}, {"height", "h"}, {"cx", "x"}, {"cy", "y"}};
  for (size_t i = 0; i < sizeof longer / sizeof *longer; i++)
    if (strcmp(name, longer[i][0]) == 0)
      name = longer[i][1];
  bool found = false;
  for (int i = 0; i < places->count; i++)
    found |= strcmp(places->names[i], name) == 0;
  return found;
}

/* Raises: the numbers of a field were given one by one, such as x and y for centre. */
static void fail_parts(lua_State *L, const cs_noun *noun, int table, const char *name) {
  for (const cs_field *field = noun->fields; field->name; field = cs_field_next(field)) {
    place_list places = split(field->shape ? field->shape : "");
    if (!is_place(&places, name))
      continue;
    push_values(L, table, &places, false);
    push_values(L, table, &places, true);
    cs_caller_error(L, "%s: unknown field '%s'; write %s = {%s}, not %s", noun->name, name,
                    field->name, lua_tostring(L, -2), lua_tostring(L, -1));
  }
}

/* Raises: the items of the list have no name. */
static void fail_list(lua_State *L, const cs_noun *noun, int table, const char *name) {
  static const char *const lists[] = {"list", "items", "children", "operands", "shapes"};
  if (noun->list == CS_LIST_NONE || !noun->item)
    return;
  place_list places = split(noun->places ? noun->places : "");
  if (noun->places && is_place(&places, name))
    cs_caller_error(L, "%s: %s", noun->name, push_both(L, table, noun->places, noun->name, " "));
  bool is_list = strcmp(lua_pushfstring(L, "%ss", noun->item), name) == 0;
  for (size_t i = 0; i < sizeof lists / sizeof *lists; i++)
    is_list |= strcmp(lists[i], name) == 0;
  if (is_list)
    cs_caller_error(L,
                    "%s: unknown field '%s'; write the %ss into the table itself, %s{ a, b, ... "
                    "}, not %s{ %s = ... }",
                    noun->name, name, noun->item, noun->name, noun->name, name);
}

static bool is_word(const char *const *words, const char *word) {
  while (words && *words && strcmp(*words, word) != 0)
    words++;
  return words && *words;
}

const char *cs_unknown_field_of(const cs_noun *noun, const char *word) {
  for (const cs_field *field = noun->fields; field->name; field = cs_field_next(field))
    if (field->type == CS_TYPE_CHOICE && is_word(field->choices, word))
      return field->name;
  return NULL;
}

/* Raises if the value is a word of another field, as in winding = "evenodd". */
static void fail_choice(lua_State *L, const cs_noun *noun, int table, const char *name) {
  lua_getfield(L, table, name);
  const char *word = lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : NULL;
  const char *field = word ? cs_unknown_field_of(noun, word) : NULL;
  if (field)
    cs_caller_error(L, "%s: unknown field '%s'; write %s = \"%s\"", noun->name, name, field, word);
  lua_pop(L, 1);
}

/* Raises for names that a noun does not have, with a hint to use something else. */
static void fail_elsewhere(lua_State *L, const cs_noun *noun, const char *name) {
  static const struct {
    const char *noun, *field, *hint; /* noun: NULL: any */
  } others[] = {
      {"text", "along", "celspan.letters(text, nil, { along = ... }) sets a text along a path"},
      {"cel", "z", "multiplane { film = f.size, { cel, z = ... } } has depths"},
      {NULL, "weight", "write variations = { wght = 700 }"},
      {NULL, "bold", "write variations = { wght = 700 }"},
      {NULL, "stroke", "value:stroke { width = 2, fill = ... } is the line along its edge"}};
  for (size_t i = 0; i < sizeof others / sizeof *others; i++)
    if ((!others[i].noun || strcmp(others[i].noun, noun->name) == 0) &&
        strcmp(others[i].field, name) == 0)
      cs_caller_error(L, "%s: unknown field '%s'; %s", noun->name, name, others[i].hint);
}

/* ---------------------------------------------------------------- raising */

static const char *push_names(lua_State *L, const char *const *names, size_t count) {
  luaL_Buffer list;
  luaL_buffinit(L, &list);
  for (size_t i = 0; i < count; i++) {
    luaL_addstring(&list, i ? ", " : "");
    luaL_addstring(&list, names[i]);
  }
  luaL_pushresult(&list);
  return lua_tostring(L, -1);
}

_Noreturn void cs_unknown_fail_name(lua_State *L, const char *noun, const char *name,
                                    const char *const *names, size_t count) {
  const char *nearest = cs_suggest_name(name, names, count);
  if (nearest)
    cs_caller_error(L, "%s: unknown field '%s'; did you mean '%s'?", noun, name, nearest);
  else if (count == 0)
    cs_caller_error(L, "%s: unknown field '%s'; %s", noun, name,
                    strcmp(cs_suggest_shown(name), "fill") == 0 ? "write object:paint(fill)"
                                                                : "there are no named fields");
  else
    cs_caller_error(L, "%s: unknown field '%s'; the fields are %s", noun, name,
                    push_names(L, names, count));
  for (;;) /* cs_caller_error does not return, though its declaration does not say so */
    ;
}

_Noreturn void cs_unknown_fail(lua_State *L, const cs_noun *noun, int table, const char *name) {
  const char *names[MOST_NAMES] = {0};
  size_t count = 0;
  for (const cs_field *field = noun->fields; field->name && count < MOST_NAMES;
       field = cs_field_next(field))
    names[count++] = cs_suggest_shown(field->name);
  fail_list(L, noun, table, name);
  fail_parts(L, noun, table, name);
  fail_choice(L, noun, table, name);
  fail_elsewhere(L, noun, name);
  cs_unknown_fail_name(L, noun->name, name, names, count);
}
