/* Boolean objects, by name and by operator. A chain of one operator becomes a single object: a ~ b
 * ~ c is xor{a, b, c}. */
#include "lua/bind/caller.h"
#include "lua/bind/construct.h"
#include "lua/bind/form.h"
#include "lua/bind/host.h"
#include "lua/bind/named.h"
#include "lua/nouns/nouns.h"
#include "lua/nouns/shape.h"

static void create(const cs_form *form, cs_userdata *value, celspan_operator op) {
  int count = cs_form_length(form);
  celspan_object **operands = cs_shape_items(form, count);
  celspan_object *object = NULL;
  cs_form_try(form, celspan_object_create_boolean(cs_host_context(form->L), op, operands,
                                                  (size_t)count, &object));
  value->handle = object;
}

static void create_union(const cs_form *form, cs_userdata *value) {
  create(form, value, CELSPAN_OPERATOR_UNION);
}
static void create_intersection(const cs_form *form, cs_userdata *value) {
  create(form, value, CELSPAN_OPERATOR_INTERSECTION);
}
static void create_difference(const cs_form *form, cs_userdata *value) {
  create(form, value, CELSPAN_OPERATOR_DIFFERENCE);
}
static void create_xor(const cs_form *form, cs_userdata *value) {
  create(form, value, CELSPAN_OPERATOR_XOR);
}
static void create_clip(const cs_form *form, cs_userdata *value) {
  create(form, value, CELSPAN_OPERATOR_CLIP);
}

static const cs_field no_fields[] = {{0}};
#define BOOLEAN(noun)                                                                              \
  .name = #noun, .kind = &cs_kind_object, .fields = no_fields, .item = "object",                   \
  .item_written = "celspan.shape", .create = create_##noun
const cs_noun cs_noun_union = {BOOLEAN(union), .list = CS_LIST_ITEMS, .has_gaps = true};
const cs_noun cs_noun_intersection = {BOOLEAN(intersection), .list = CS_LIST_ITEMS};
const cs_noun cs_noun_difference = {BOOLEAN(difference), .list = CS_LIST_ITEMS};
const cs_noun cs_noun_xor = {BOOLEAN(xor), .list = CS_LIST_ITEMS, .has_gaps = true};
static const cs_noun noun_clip = {BOOLEAN(clip), .list = CS_LIST_TUPLE};

int cs_nouns_clip(lua_State *L) {
  static const char *const names[] = {"the art", "the shape"};
  for (int i = 1; i <= 2; i++)
    if (!cs_shape_at(L, i))
      return cs_caller_error(L, "clip: argument %d, %s, must be an object, got %s", i, names[i - 1],
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
  cs_userdata *value = cs_shape_at(L, index);
  if (!value)
    cs_caller_error(L, "operator %s: both sides must be objects, the %s one is %s", sign,
                    index == 1 ? "left" : "right", cs_userdata_type(L, index));
  return value;
}

/* Pushes the operands of a chain: the left value's, then the right value. If the left value
 * shows all of its table, the table is extended and shared, which can happen only once for each
 * table. Its room doubles like the core's, so that a value that uses only the beginning keeps few
 * operands of other values alive. */
static void push_operands(lua_State *L, lua_Integer count) {
  if (count == 1) {
    lua_createtable(L, 2, 0);
    lua_pushvalue(L, 1);
    lua_rawseti(L, -2, 1);
  } else {
    lua_getiuservalue(L, 1, 1);
    bool is_full = (count & (count - 1)) == 0;
    if (is_full || (lua_Integer)lua_rawlen(L, -1) != count) {
      cs_userdata_push_fields(L, 1);
      lua_remove(L, -2);
    }
  }
  lua_pushvalue(L, 2);
  lua_rawseti(L, -2, count + 1);
}

/* Makes the same value as cs_construct_value does for a table of all operands, but without visiting
 * the earlier operands of a chain such as a | b | c. */
static int operate(lua_State *L, const cs_noun *noun, celspan_operator op, const char *sign) {
  const cs_userdata *left = operand(L, 1, sign);
  celspan_object *const pair[] = {left->handle, operand(L, 2, sign)->handle};
  bool goes_on = left->is_chain && left->noun == noun;
  lua_Integer count = goes_on ? left->shown : 1;
  celspan_context *context = cs_host_context(L);
  celspan_object *object = NULL;
  lua_settop(L, 2);
  cs_userdata *value = cs_userdata_push(L, noun);
  cs_named_begin(L, context);
  cs_host_try(L, noun->name,
              goes_on ? celspan_object_extend_boolean(context, pair[0], &pair[1], 1, &object)
                      : celspan_object_create_boolean(context, op, pair, 2, &object));
  cs_named_end(context);
  value->handle = object;
  value->is_chain = true;
  value->shown = (int32_t)(count + 1); /* at most CS_SCENE_PRIMITIVES operands */
  push_operands(L, count);
  lua_setiuservalue(L, 3, 1);
  return 1;
}

static int operate_union(lua_State *L) {
  return operate(L, &cs_noun_union, CELSPAN_OPERATOR_UNION, "|");
}
static int operate_intersection(lua_State *L) {
  return operate(L, &cs_noun_intersection, CELSPAN_OPERATOR_INTERSECTION, "&");
}
static int operate_difference(lua_State *L) {
  return operate(L, &cs_noun_difference, CELSPAN_OPERATOR_DIFFERENCE, "-");
}
static int operate_xor(lua_State *L) { return operate(L, &cs_noun_xor, CELSPAN_OPERATOR_XOR, "~"); }

/* Operators that other programs have, and a call of a field as if it were a method. */
static int refuse_sum(lua_State *L) {
  return cs_caller_error(L, "objects are no numbers: a | b shows both, a - b cuts b out, and "
                            "a:scale(2) makes it larger");
}

static int refuse_call(lua_State *L) {
  return cs_caller_error(L, "%s is no function: leave out the parentheses, as in art.object",
                         cs_userdata_type(L, 1));
}

const luaL_Reg cs_boolean_operators[] = {{"__bor", operate_union},
                                         {"__band", operate_intersection},
                                         {"__sub", operate_difference},
                                         {"__bxor", operate_xor},
                                         {"__add", refuse_sum},
                                         {"__mul", refuse_sum},
                                         {"__div", refuse_sum},
                                         {"__call", refuse_call},
                                         {NULL, NULL}};
