#include "lua/bind/packed.h"

#include <string.h>

#define LIST_MOST 9 /* the most numbers of a list, or items */

enum { NIL, INTEGER, FLOAT, LIST, OTHER };

/* ---------------------------------------------------------------- packing */

/* Packing continues until something does not fit. */
typedef struct packer {
  lua_State *L;
  cs_packed *out;
  bool fits;
} packer;

static void put(cs_packed *out, const void *bytes, size_t size) {
  memcpy(out->bytes + out->size, bytes, size);
  out->size += size;
}

static void put_byte(packer *p, unsigned char byte) {
  p->fits = p->fits && p->out->size < CS_PACKED_SIZE;
  if (p->fits)
    put(p->out, &byte, 1);
}

static void put_number(packer *p, int index) {
  bool is_integer = lua_isinteger(p->L, index);
  lua_Integer integer = lua_tointeger(p->L, index);
  lua_Number number = lua_tonumber(p->L, index);
  put_byte(p, is_integer ? INTEGER : FLOAT);
  p->fits = p->fits && p->out->size + sizeof number <= CS_PACKED_SIZE;
  if (p->fits && is_integer)
    put(p->out, &integer, sizeof integer);
  else if (p->fits)
    put(p->out, &number, sizeof number);
}

/* How many keys the table on top of the stack has. */
static size_t count_keys(lua_State *L) {
  size_t count = 0;
  for (lua_pushnil(L); lua_next(L, -2); lua_pop(L, 1))
    count++;
  return count;
}

/* Packs the table on top of the stack, a list that contains only numbers. */
static void put_list(packer *p) {
  size_t count = lua_rawlen(p->L, -1);
  p->fits = p->fits && count <= LIST_MOST && count_keys(p->L) == count;
  put_byte(p, LIST);
  put_byte(p, (unsigned char)count);
  for (size_t i = 1; i <= count && p->fits; i++) {
    p->fits = lua_rawgeti(p->L, -1, (lua_Integer)i) == LUA_TNUMBER;
    put_number(p, -1);
    lua_pop(p->L, 1);
  }
}

/* Packs the value on top of the stack. other: the index at which a value of another type is
 * stored. */
static void put_value(packer *p, int other) {
  switch (lua_type(p->L, -1)) {
  case LUA_TNIL:
    put_byte(p, NIL);
    break;
  case LUA_TNUMBER:
    put_number(p, -1);
    break;
  case LUA_TTABLE:
    put_list(p);
    break;
  default:
    p->fits = p->fits && !p->out->has_other;
    p->out->has_other = true;
    put_byte(p, OTHER);
    lua_pushvalue(p->L, -1);
    lua_replace(p->L, other);
  }
}

/* Whether the values of a noun can be packed at all. */
static bool is_packable(const cs_noun *noun) {
  return noun->list != CS_LIST_ITEMS && !noun->complete && noun->kind && noun->kind->bounds &&
         noun->kind->kept == 0;
}

void cs_packed_push_other(lua_State *L, const cs_noun *noun, int fields, cs_packed *out) {
  packer p = {L, out, is_packable(noun)};
  size_t count = p.fits ? lua_rawlen(L, fields) : 0;
  out->size = 0;
  out->has_other = false;
  lua_pushnil(L);
  int other = lua_gettop(L);
  p.fits = p.fits && count <= LIST_MOST;
  put_byte(&p, (unsigned char)count);
  for (size_t i = 1; i <= count && p.fits; i++) {
    lua_rawgeti(L, fields, (lua_Integer)i);
    put_value(&p, other);
    lua_pop(L, 1);
  }
  for (const cs_field *field = noun->fields; field->name && p.fits; field = cs_field_next(field)) {
    lua_pushstring(L, field->name);
    lua_rawget(L, fields);
    put_value(&p, other);
    lua_pop(L, 1);
  }
  if (!p.fits)
    out->size = 0;
}

void cs_packed_begin(cs_packed *packed) {
  packed->has_other = false;
  packed->bytes[0] = 0;
  packed->size = 1;
}

void cs_packed_add_number(cs_packed *packed, double number) {
  packed->bytes[packed->size++] = FLOAT;
  put(packed, &number, sizeof number);
}

void cs_packed_add_list(cs_packed *packed, const double *numbers, int count) {
  packed->bytes[packed->size++] = LIST;
  packed->bytes[packed->size++] = (unsigned char)count;
  for (int i = 0; i < count; i++)
    cs_packed_add_number(packed, numbers[i]);
}

/* ---------------------------------------------------------------- unpacking */

static void push_value(lua_State *L, const unsigned char **at, int other) {
  lua_Integer integer;
  lua_Number number;
  int count;
  switch (*(*at)++) {
  case INTEGER:
    memcpy(&integer, *at, sizeof integer);
    *at += sizeof integer;
    lua_pushinteger(L, integer);
    break;
  case FLOAT:
    memcpy(&number, *at, sizeof number);
    *at += sizeof number;
    lua_pushnumber(L, number);
    break;
  case LIST:
    count = *(*at)++;
    lua_createtable(L, count, 0);
    for (int i = 1; i <= count; i++) {
      push_value(L, at, other);
      lua_rawseti(L, -2, i);
    }
    break;
  case OTHER:
    lua_pushvalue(L, other);
    break;
  default:
    lua_pushnil(L);
  }
}

void cs_packed_push_fields(lua_State *L, const cs_noun *noun, const unsigned char *bytes,
                           int other) {
  int count = *bytes++;
  luaL_checkstack(L, 6, "reading a value");
  other = lua_absindex(L, other);
  lua_createtable(L, count, 4);
  for (int i = 1; i <= count; i++) {
    push_value(L, &bytes, other);
    lua_rawseti(L, -2, i);
  }
  for (const cs_field *field = noun->fields; field->name; field = cs_field_next(field)) {
    lua_pushstring(L, field->name);
    push_value(L, &bytes, other);
    lua_rawset(L, -3);
  }
  cs_packed_set_presets(L, noun, lua_gettop(L));
}

void cs_packed_set_presets(lua_State *L, const cs_noun *noun, int table) {
  for (const cs_field *field = noun->fields; field->name; field = cs_field_next(field)) {
    if (!field->preset)
      continue;
    lua_pushstring(L, field->name);
    if (lua_rawget(L, table) == LUA_TNIL) {
      lua_pushstring(L, field->name);
      if (!lua_stringtonumber(L, field->preset))
        lua_pushstring(L, field->preset);
      lua_rawset(L, table);
    }
    lua_pop(L, 1);
  }
}
