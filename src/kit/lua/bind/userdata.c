#include "lua/bind/userdata.h"

#include <lauxlib.h>
#include <stdlib.h>
#include <string.h>

#include "inside/colour.h"
#include "lua/bind/caller.h"
#include "lua/bind/put.h"
#include "lua/bind/require.h"
#include "lua/bind/suggest.h"
#include "lua/bind/unknown.h"

/* Deep enough for all fields: a list of points. */
#define COPY_DEPTH 3
#define MOST_NAMES 64
#define MOST_SHOWN 60 /* bytes of a text in a message */

/* ---------------------------------------------------------------- making */

static size_t round_up(size_t size) { return (size + 7) & ~(size_t)7; }

cs_userdata *cs_userdata_push_packed(lua_State *L, const cs_noun *noun, bool is_placed,
                                     const cs_packed *packed) {
  const cs_kind *kind = noun->kind;
  size_t own = round_up(kind->own_size), placement = is_placed ? sizeof(cs_placement) : 0;
  bool has_values = packed->size == 0 || packed->has_other;
  cs_userdata *value = lua_newuserdatauv(L, sizeof *value + own + placement + packed->size,
                                         has_values ? 1 + kind->kept : 0);
  memset(value, 0, sizeof *value + own);
  value->noun = noun;
  value->is_placed = is_placed;
  value->packed = (uint16_t)packed->size;
  const cs_placement nowhere = {celspan_matrix_identity(), 1};
  if (is_placed)
    cs_userdata_place(value, &nowhere);
  memcpy((char *)cs_userdata_own(value) + own + placement, packed->bytes, packed->size);
  luaL_setmetatable(L, kind->name);
  return value;
}

cs_userdata *cs_userdata_push(lua_State *L, const cs_noun *noun) {
  const cs_packed none = {.size = 0};
  return cs_userdata_push_packed(L, noun, false, &none);
}

void *cs_userdata_own(const cs_userdata *value) { return (void *)(value + 1); }

static cs_placement *placement_of(const cs_userdata *value) {
  size_t own = round_up(value->noun->kind->own_size);
  return (cs_placement *)((char *)cs_userdata_own(value) + own);
}

cs_placement cs_userdata_placement(const cs_userdata *value) {
  return value->is_placed ? *placement_of(value) : (cs_placement){celspan_matrix_identity(), 1};
}

void cs_userdata_place(cs_userdata *value, const cs_placement *placement) {
  *placement_of(value) = *placement;
}

static const unsigned char *packed_of(const cs_userdata *value) {
  return (const unsigned char *)(placement_of(value) + (value->is_placed ? 1 : 0));
}

cs_userdata *cs_userdata_push_like(lua_State *L, int index, bool is_placed) {
  index = lua_absindex(L, index);
  const cs_userdata *from = lua_touserdata(L, index);
  bool has_value = lua_getiuservalue(L, index, 1) != LUA_TNONE;
  cs_packed packed = {.size = from->packed, .has_other = has_value};
  memcpy(packed.bytes, packed_of(from), packed.size);
  cs_userdata *copy = cs_userdata_push_packed(L, from->noun, is_placed || from->is_placed, &packed);
  copy->shown = from->shown;
  memcpy(cs_userdata_own(copy), cs_userdata_own(from), from->noun->kind->own_size);
  const cs_placement placement = cs_userdata_placement(from);
  if (copy->is_placed)
    cs_userdata_place(copy, &placement);
  lua_insert(L, -2);
  lua_setiuservalue(L, -2, 1); /* it is never changed, so it can be shared */
  return copy;
}

void cs_userdata_push_kept(lua_State *L, int index) {
  const cs_userdata *value = lua_touserdata(L, index);
  lua_getiuservalue(L, index, 1);
  if (!value->packed)
    return;
  cs_packed_push_fields(L, value->noun, packed_of(value), -1);
  lua_remove(L, -2);
}

/* Pushes a copy of the table at index, with room for `room` fields; tables deeper than `depth`
 * are left out. */
static void push_copy(lua_State *L, int index, int room, int depth) {
  index = lua_absindex(L, index);
  luaL_checkstack(L, 6, "copying a table");
  lua_createtable(L, (int)lua_rawlen(L, index), room);
  for (lua_pushnil(L); lua_next(L, index); lua_pop(L, 1)) {
    lua_pushvalue(L, -2);
    if (!lua_istable(L, -2))
      lua_pushvalue(L, -2);
    else if (depth > 0)
      push_copy(L, -2, 0, depth - 1);
    else
      lua_pushnil(L);
    lua_rawset(L, -5);
  }
}

/* Fields of the table at index that are not in its list. */
static int count_fields(lua_State *L, int index) {
  int count = -(int)lua_rawlen(L, index);
  for (lua_pushnil(L); lua_next(L, index); lua_pop(L, 1))
    count++;
  return count > 0 ? count : 0;
}

void cs_userdata_push_copy(lua_State *L, int table, int more) {
  table = lua_absindex(L, table);
  push_copy(L, table, count_fields(L, table) + more, COPY_DEPTH);
}

void cs_userdata_push_fields(lua_State *L, int index) {
  const cs_userdata *value = lua_touserdata(L, index);
  lua_Integer count = value->shown;
  cs_userdata_push_kept(L, index);
  if (value->packed)
    return;
  if (count == 0)
    cs_userdata_push_copy(L, -1, 0);
  else
    lua_createtable(L, (int)count, 0);
  for (lua_Integer i = 1; i <= count; i++) {
    lua_rawgeti(L, -2, i);
    lua_rawseti(L, -2, i);
  }
  lua_remove(L, -2);
}

/* ---------------------------------------------------------------- finding */

cs_userdata *cs_userdata_test(lua_State *L, int index, const cs_kind *kind) {
  cs_userdata *value = luaL_testudata(L, index, kind->name);
  if (value && kind->unref && !value->handle)
    cs_caller_error(L, "this %s was released already", value->noun->name);
  return value;
}

cs_userdata *cs_userdata_any(lua_State *L, int index) {
  for (const cs_kind *const *kind = cs_kinds; *kind; kind++)
    if (*kind != &cs_kind_frame && luaL_testudata(L, index, (*kind)->name))
      return cs_userdata_test(L, index, *kind);
  return NULL;
}

cs_userdata *cs_userdata_self(lua_State *L, const cs_kind *kind, const char *method) {
  cs_userdata *value = cs_userdata_test(L, 1, kind);
  if (!value)
    cs_caller_error(L, "%s: call it as a method, value:%s(...), got %s", method, method,
                    cs_userdata_type(L, 1));
  return value;
}

const char *cs_userdata_type(lua_State *L, int index) {
  for (const cs_kind *const *kind = cs_kinds; *kind; kind++) {
    const cs_userdata *value = luaL_testudata(L, index, (*kind)->name);
    if (value && value->noun == &cs_noun_rostrum_object)
      return lua_pushstring(L, "a rostrum as an object, which belongs in a cel");
    if (value)
      return lua_pushfstring(L, "a %s", value->noun->name);
  }
  return lua_pushstring(L, luaL_typename(L, index));
}

const char *cs_userdata_number(lua_State *L, int index) {
  return lua_type(L, index) == LUA_TNUMBER ? luaL_tolstring(L, index, NULL)
                                           : cs_userdata_type(L, index);
}

const char *cs_userdata_shown(lua_State *L, int index) {
  char shown[MOST_SHOWN + 1];
  size_t size, kept;
  if (lua_type(L, index) != LUA_TSTRING)
    return cs_userdata_type(L, index);
  const char *text = lua_tolstring(L, index, &size);
  kept = size < MOST_SHOWN ? size : MOST_SHOWN;
  while (kept < size && kept > 0 && ((unsigned char)text[kept] & 0xc0) == 0x80)
    kept--; /* not in the middle of a UTF-8 character */
  for (size_t i = 0; i < kept; i++)
    shown[i] = (unsigned char)text[i] < ' ' || text[i] == 0x7f ? '?' : text[i];
  shown[kept] = '\0';
  return lua_pushfstring(L, "\"%s%s\"", shown, kept < size ? "..." : "");
}

/* ---------------------------------------------------------------- metamethods */

bool cs_userdata_has_field(const cs_noun *noun, const char *name) {
  const cs_field *field = noun->fields;
  while (field->name && strcmp(field->name, name) != 0)
    field = cs_field_next(field);
  return field->name != NULL;
}

static int compare(const void *a, const void *b) {
  return strcmp(*(const char *const *)a, *(const char *const *)b);
}

/* Raises the message that a name cannot be read, with the names that can be read. The names of
 * methods are the keys of the table at `methods`. */
static int fail_unknown(lua_State *L, const cs_noun *noun, int methods) {
  const char *names[MOST_NAMES];
  size_t count = 0;
  for (const cs_field *field = noun->fields; field->name && count < MOST_NAMES - 4;
       field = cs_field_next(field))
    names[count++] = cs_suggest_shown(field->name);
  size_t first = count;
  if (noun->kind->named) {
    names[count++] = "name";
    names[count++] = "origin";
  }
  if (noun->kind->mode)
    names[count++] = "mode";
  if (noun->kind->transform)
    names[count++] = "pivot";
  for (lua_pushnil(L); count < MOST_NAMES && lua_next(L, methods); lua_pop(L, 1))
    if (!cs_userdata_has_field(noun, lua_tostring(L, -2)))
      names[count++] = lua_tostring(L, -2); /* the table keeps it alive */
  qsort(names + first, count - first, sizeof *names, compare);
  cs_unknown_fail_name(L, noun->name, lua_tostring(L, 2), names, count);
}

/* Pushes the field `name` or `origin` of a value; false if the key is another one, or values of
 * this kind have no names. */
static bool push_name(lua_State *L, const cs_userdata *value, const char *key) {
  bool is_name = strcmp(key, "name") == 0;
  const cs_kind *kind = value->noun->kind;
  if ((!is_name && strcmp(key, "origin") != 0) || !kind->origin_of || !value->handle)
    return false;
  celspan_origin at = kind->origin_of(value->handle);
  const char *name = kind->name_of(value->handle);
  if (is_name && name[0])
    lua_pushstring(L, name);
  else if (!is_name && at.line > 0)
    lua_pushfstring(L, "%s:%d", at.source, (int)at.line);
  else
    lua_pushnil(L);
  return true;
}

/* Pushes the mode of a value; false if the key is another one, or values of this kind have no
 * modes. */
static bool push_mode(lua_State *L, const cs_userdata *value, const char *key) {
  const cs_kind *kind = value->noun->kind;
  if (strcmp(key, "mode") != 0 || !kind->mode || !value->handle)
    return false;
  lua_pushstring(L, cs_blend_words[kind->mode(value->handle)]);
  return true;
}

/* Pushes the pivot of a value, or nil; false if the key is another one, or values of this kind have
 * no pivots. */
static bool push_pivot(lua_State *L, const cs_userdata *value, const char *key) {
  if (strcmp(key, "pivot") != 0 || !value->noun->kind->transform)
    return false;
  const cs_anchor *anchor = cs_userdata_own(value);
  lua_pushnil(L);
  if (!anchor->has_pivot)
    return true;
  lua_createtable(L, 2, 0);
  const double point[2] = {anchor->pivot.x, anchor->pivot.y};
  for (int i = 0; i < 2; i++) {
    lua_pushnumber(L, point[i]);
    lua_rawseti(L, -2, i + 1);
  }
  return true;
}

/* Pushes the field named by argument 2, nil if it was left out; false if there is no such field. */
static bool push_read(lua_State *L, const cs_userdata *value) {
  lua_pushnil(L);
  bool is_place = lua_isinteger(L, 2);
  bool is_hidden = is_place && value->shown && lua_tointeger(L, 2) > value->shown;
  if (is_hidden)
    return true;
  cs_userdata_push_kept(L, 1);
  if (!lua_istable(L, -1))
    return true;
  lua_pushvalue(L, 2);
  int type = lua_rawget(L, -2);
  if (type == LUA_TTABLE)
    cs_userdata_push_copy(L, -1, 0);
  return type != LUA_TNIL || lua_type(L, 2) != LUA_TSTRING ||
         cs_userdata_has_field(value->noun, lua_tostring(L, 2));
}

/* Replaces argument 2, another spelling of a field, by celspan's; false: it is no such
 * spelling. */
static bool respell(lua_State *L, const cs_userdata *value) {
  char out[CS_SUGGEST_SIZE];
  const char *own = cs_suggest_own(lua_tostring(L, 2), true, out);
  if (!own || !cs_userdata_has_field(value->noun, own))
    return false;
  lua_pushstring(L, own);
  lua_replace(L, 2);
  return true;
}

/* Returns a method, or else a field; tables are returned as copies. */
static int index_value(lua_State *L) {
  const cs_kind *kind = lua_touserdata(L, lua_upvalueindex(2));
  const cs_userdata *value = luaL_checkudata(L, 1, kind->name);
  lua_settop(L, 2);
  lua_pushvalue(L, 2);
  if (!lua_isnil(L, 2) && lua_rawget(L, lua_upvalueindex(1)) != LUA_TNIL)
    return 1;
  const char *key = lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : NULL;
  if (key && (push_name(L, value, key) || push_mode(L, value, key) || push_pivot(L, value, key)))
    return 1;
  if (lua_isnil(L, 2) || push_read(L, value) || (key && respell(L, value) && push_read(L, value)))
    return 1;
  return fail_unknown(L, value->noun, lua_upvalueindex(1));
}

/* Items of the list that a value was made from, which can be read as value[1], value[2], ... */
static int count_items(lua_State *L) {
  const cs_kind *kind = lua_touserdata(L, lua_upvalueindex(1));
  const cs_userdata *value = luaL_checkudata(L, 1, kind->name);
  cs_userdata_push_kept(L, 1);
  bool has_fields = lua_istable(L, -1);
  lua_Integer all = has_fields ? (lua_Integer)lua_rawlen(L, -1) : 0;
  lua_pushinteger(L, value->shown ? value->shown : all);
  return 1;
}

static int refuse_assignment(lua_State *L) {
  const cs_kind *kind = lua_touserdata(L, lua_upvalueindex(1));
  const cs_userdata *value = luaL_checkudata(L, 1, kind->name);
  bool is_frame = kind == &cs_kind_frame;
  return cs_caller_error(L, "%ss are immutable%s", value->noun->name,
                         is_frame ? "" : "; use :with{...}");
}

static int release_value(lua_State *L) {
  const cs_kind *kind = lua_touserdata(L, lua_upvalueindex(1));
  cs_userdata *value = luaL_checkudata(L, 1, kind->name);
  if (kind->unref && value->handle)
    kind->unref(value->handle);
  value->handle = NULL;
  return 0;
}

/* Pushes "a, b, c" for one to four numbers in the array at index; else nothing. */
static bool push_numbers(lua_State *L, int index) {
  int count = (int)lua_rawlen(L, index);
  if (count < 1 || count > 4)
    return false;
  lua_pushliteral(L, "");
  for (int i = 1; i <= count; i++) {
    if (lua_rawgeti(L, index, i) != LUA_TNUMBER) {
      lua_pop(L, 2);
      return false;
    }
    lua_pushfstring(L, "%s%s", i > 1 ? ", " : "", luaL_tolstring(L, -1, NULL));
    lua_replace(L, -3);
    lua_pop(L, 1);
    lua_concat(L, 2);
  }
  return true;
}

/* Pushes "name = 3" or "name = {1, 2}" for a field that is a number or a short list of numbers. */
static bool push_field(lua_State *L, int fields, const char *name) {
  lua_pushstring(L, name);
  int type = lua_rawget(L, fields), value = lua_gettop(L);
  bool is_shown = type == LUA_TNUMBER || (type == LUA_TTABLE && push_numbers(L, value));
  if (type == LUA_TNUMBER)
    lua_pushfstring(L, "%s = %s", name, luaL_tolstring(L, value, NULL));
  else if (is_shown)
    lua_pushfstring(L, "%s = {%s}", name, lua_tostring(L, -1));
  if (is_shown)
    lua_replace(L, value);
  lua_settop(L, is_shown ? value : value - 1);
  return is_shown;
}

/* Pushes the contents of the array part: "3 objects", or its numbers. */
static bool push_list(lua_State *L, const cs_userdata *value, int fields) {
  const cs_noun *noun = value->noun;
  int count = (int)(value->shown ? value->shown : (lua_Integer)lua_rawlen(L, fields));
  if (noun->list == CS_LIST_ITEMS)
    lua_pushfstring(L, "%d %s%s", count, noun->item, count == 1 ? "" : "s");
  return noun->list == CS_LIST_ITEMS || (noun->list == CS_LIST_TUPLE && push_numbers(L, fields));
}

/* Appends the text on top of the stack to the text below it. */
static void join(lua_State *L, int *count) {
  lua_pushstring(L, (*count)++ ? ", " : "{ ");
  lua_insert(L, -2);
  lua_concat(L, 3);
}

/* The kind and the most important numbers: circle{ centre = {10, 20}, radius = 5 }. */
static int describe(lua_State *L) {
  const cs_kind *kind = lua_touserdata(L, lua_upvalueindex(1));
  const cs_userdata *value = luaL_checkudata(L, 1, kind->name);
  const cs_noun *noun = value->noun;
  lua_settop(L, 1);
  cs_userdata_push_kept(L, 1);
  bool has_fields = lua_istable(L, 2);
  lua_pushstring(L, noun->name);
  if (push_name(L, value, "name") && !lua_isnil(L, -1)) {
    lua_pushfstring(L, "%s \"%s\"", noun->name, lua_tostring(L, -1));
    lua_replace(L, -3);
  }
  lua_settop(L, 3);
  int count = 0;
  if (has_fields && push_list(L, value, 2))
    join(L, &count);
  for (const cs_field *field = noun->fields; has_fields && field->name;
       field = cs_field_next(field))
    if (push_field(L, 2, field->name))
      join(L, &count);
  if (count) {
    lua_pushliteral(L, " }");
    lua_concat(L, 2);
  }
  return 1;
}

/* Keeps the table on top of the stack as the metatable of a kind, hidden from scripts. Pops it. */
static void keep_metatable(lua_State *L, const char *kind) {
  cs_put_text(L, "__name", kind);
  lua_pushstring(L, kind); /* the result of getmetatable: no script can call __gc */
  lua_setfield(L, -2, "__metatable");
  lua_setfield(L, LUA_REGISTRYINDEX, kind);
}

void cs_userdata_open_metatable(lua_State *L, const char *name, const luaL_Reg *functions) {
  luaL_newmetatable(L, name);
  luaL_setfuncs(L, functions, 0);
  cs_put_text(L, "__metatable", name);
  lua_pop(L, 1);
}

void cs_userdata_register(lua_State *L, const cs_kind *kind) {
  static const luaL_Reg plain[] = {{"__newindex", refuse_assignment},
                                   {"__len", count_items},
                                   {"__tostring", describe},
                                   {"__gc", release_value},
                                   {NULL, NULL}};
  bool is_known = luaL_getmetatable(L, kind->name) == LUA_TTABLE;
  lua_pop(L, 1);
  if (is_known)
    return;
  lua_newtable(L);
  lua_pushlightuserdata(L, (void *)kind);
  luaL_setfuncs(L, plain, 1);
  if (kind->operators)
    luaL_setfuncs(L, kind->operators, 0);
  lua_newtable(L);
  luaL_setfuncs(L, kind->methods, 0);
  cs_require_methods(L, kind->written);
  lua_pushlightuserdata(L, (void *)kind);
  lua_pushcclosure(L, index_value, 2);
  lua_setfield(L, -2, "__index");
  keep_metatable(L, kind->name);
}

/* ---------------------------------------------------------------- holders */

static void push_metatable(lua_State *L, const char *kind, lua_CFunction release) {
  if (luaL_getmetatable(L, kind) == LUA_TTABLE)
    return;
  lua_pop(L, 1);
  lua_createtable(L, 0, 3);
  lua_pushcfunction(L, release);
  lua_setfield(L, -2, "__gc");
  keep_metatable(L, kind);
  luaL_getmetatable(L, kind);
}

void *cs_userdata_push_holder(lua_State *L, const char *kind, size_t size, lua_CFunction release) {
  void *held = lua_newuserdatauv(L, size, 1);
  memset(held, 0, size);
  push_metatable(L, kind, release);
  lua_setmetatable(L, -2);
  return held;
}
