/* Boolean objects, by name and by operator. A chain of one operator becomes a single object: a ~ b
 * ~ c is xor{a, b, c}. */
#include "bind/construct.h"
#include "bind/form.h"
#include "bind/host.h"
#include "bind/openers.h"
#include "bind/userdata.h"

/* The objects of the array part: scratch memory, left on the stack. */
static celspan_object **read_operands(const cs_form *form, int count) {
  lua_State *L = form->L;
  celspan_object **operands = cs_form_scratch(L, (size_t)count, sizeof *operands);
  for (int i = 0; i < count; i++) {
    lua_rawgeti(L, form->table, i + 1);
    cs_userdata *value = cs_userdata_test(L, -1, &cs_kind_object);
    if (!value)
      cs_form_fail(form, "item %d must be an object, got %s", i + 1, cs_userdata_type(L, -1));
    operands[i] = value->handle;
    lua_pop(L, 1);
  }
  return operands;
}

static void create(const cs_form *form, cs_userdata *value, celspan_operator op) {
  int count = cs_form_length(form);
  celspan_object **operands = read_operands(form, count);
  celspan_object *object = NULL;
  cs_form_try(form, celspan_object_create_boolean(cs_host_context(form->L), op, operands,
                                                  (size_t)count, &object));
  value->handle = object;
}

static void create_union(const cs_form *form, cs_userdata *value) {
  create(form, value, CELSPAN_UNION);
}
static void create_intersection(const cs_form *form, cs_userdata *value) {
  create(form, value, CELSPAN_INTERSECTION);
}
static void create_difference(const cs_form *form, cs_userdata *value) {
  create(form, value, CELSPAN_DIFFERENCE);
}
static void create_xor(const cs_form *form, cs_userdata *value) {
  create(form, value, CELSPAN_XOR);
}
static void create_clip(const cs_form *form, cs_userdata *value) {
  create(form, value, CELSPAN_CLIP);
}

static const cs_field no_fields[] = {{0}};
#define BOOLEAN(noun)                                                                              \
  .name = #noun, .kind = &cs_kind_object, .fields = no_fields, .item = "object",                   \
  .create = create_##noun
static const cs_noun noun_union = {BOOLEAN(union), .list = CS_LIST_ITEMS};
static const cs_noun noun_intersection = {BOOLEAN(intersection), .list = CS_LIST_ITEMS};
static const cs_noun noun_difference = {BOOLEAN(difference), .list = CS_LIST_ITEMS};
static const cs_noun noun_xor = {BOOLEAN(xor), .list = CS_LIST_ITEMS};
static const cs_noun noun_clip = {BOOLEAN(clip), .list = CS_LIST_TUPLE};

static int clip(lua_State *L) {
  static const char *const names[] = {"the art", "the shape"};
  for (int i = 1; i <= 2; i++)
    if (!cs_userdata_test(L, i, &cs_kind_object))
      return luaL_error(L, "clip: argument %d, %s, must be an object, got %s", i, names[i - 1],
                        cs_userdata_type(L, i));
  lua_createtable(L, 2, 0);
  for (int i = 1; i <= 2; i++) {
    lua_pushvalue(L, i);
    lua_rawseti(L, -2, i);
  }
  cs_construct_value(L, &noun_clip, lua_gettop(L));
  return 1;
}

/* ---------------------------------------------------------------- operators */

static cs_userdata *operand(lua_State *L, int index, const char *sign) {
  cs_userdata *value = cs_userdata_test(L, index, &cs_kind_object);
  if (!value)
    luaL_error(L, "operator %s: both sides must be objects, the %s one is %s", sign,
               index == 1 ? "left" : "right", cs_userdata_type(L, index));
  return value;
}

static int operate(lua_State *L, const cs_noun *noun, const char *sign) {
  const cs_userdata *left = operand(L, 1, sign);
  operand(L, 2, sign);
  lua_settop(L, 2);
  lua_newtable(L);
  lua_Integer count = 0;
  if (left->is_chain && left->noun == noun) {
    lua_getiuservalue(L, 1, 1);
    for (count = 0; lua_rawgeti(L, 4, count + 1) != LUA_TNIL; count++)
      lua_rawseti(L, 3, count + 1);
    lua_settop(L, 3);
  } else {
    lua_pushvalue(L, 1);
    lua_rawseti(L, 3, ++count);
  }
  lua_pushvalue(L, 2);
  lua_rawseti(L, 3, count + 1);
  cs_construct_value(L, noun, 3);
  cs_userdata *value = lua_touserdata(L, -1);
  value->is_chain = true;
  return 1;
}

static int operate_union(lua_State *L) { return operate(L, &noun_union, "|"); }
static int operate_intersection(lua_State *L) { return operate(L, &noun_intersection, "&"); }
static int operate_difference(lua_State *L) { return operate(L, &noun_difference, "-"); }
static int operate_xor(lua_State *L) { return operate(L, &noun_xor, "~"); }

void cs_open_boolean(lua_State *L) {
  static const cs_noun *const nouns[] = {&noun_union, &noun_intersection, &noun_difference,
                                         &noun_xor};
  static const luaL_Reg operators[] = {{"__bor", operate_union},
                                       {"__band", operate_intersection},
                                       {"__sub", operate_difference},
                                       {"__bxor", operate_xor},
                                       {NULL, NULL}};
  for (size_t i = 0; i < sizeof nouns / sizeof *nouns; i++) {
    cs_construct_push(L, nouns[i]);
    lua_setfield(L, -2, nouns[i]->name);
  }
  lua_pushcfunction(L, clip);
  lua_setfield(L, -2, "clip");
  luaL_getmetatable(L, cs_kind_object.name);
  luaL_setfuncs(L, operators, 0);
  lua_pop(L, 1);
}
