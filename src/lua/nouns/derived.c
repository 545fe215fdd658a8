/* Objects that are made of another one by a method and keep no fields: object:paint(texture), a
 * rectangle with the texture inside the shape, and object:warp{...}, the object bent by a map. */
#include <math.h>

#include "base/context.h"
#include "base/number.h"
#include "lua/bind/bare.h"
#include "lua/bind/caller.h"
#include "lua/bind/form.h"
#include "lua/bind/host.h"
#include "lua/bind/lua_error.h"
#include "lua/nouns/nouns.h"
#include "model/scene/scene.h"

static const cs_noun noun_painted = {.name = "painted", .kind = &cs_kind_object, CS_BARE};
static const cs_noun noun_warped = {.name = "warped", .kind = &cs_kind_object, CS_BARE};
static const cs_noun argument = {.name = "paint", .fields = cs_bare_fields};

/* ---------------------------------------------------------------- paint */

/* The shape cut out of a rectangle that just covers it. */
static celspan_status fill(celspan_context *context, celspan_object *shape, const celspan_box *box,
                           celspan_texture *texture, celspan_object **out) {
  const celspan_rect_desc desc = {sizeof desc, box->x, box->y, box->width, box->height, 0, texture};
  celspan_object *pair[2] = {NULL, shape};
  CS_TRY(celspan_object_create_rect(context, &desc, &pair[0]));
  celspan_status status =
      celspan_object_create_boolean(context, CELSPAN_OPERATOR_CLIP, pair, 2, out);
  celspan_object_unref(pair[0]);
  return status;
}

/* Replaces *object by a copy that has the fade and the name, if they were given. */
static celspan_status finish(celspan_context *context, double fade, const char *name,
                             celspan_object **object) {
  celspan_object *faded = NULL, *named = NULL;
  celspan_status status = celspan_object_fade(context, *object, fade, &faded);
  if (status == CELSPAN_OK && name)
    status = celspan_object_named(context, faded, name, &named);
  if (named)
    celspan_object_unref(faded);
  celspan_object_unref(*object);
  *object = named ? named : faded;
  return status;
}

int cs_derived_paint(lua_State *L) {
  const cs_userdata *shape = cs_userdata_self(L, &cs_kind_object, "paint");
  const cs_form form = {L, &argument, 2};
  celspan_context *context = cs_host_context(L);
  celspan_box box;
  lua_settop(L, 2);
  celspan_texture *texture = cs_form_texture(&form, "texture");
  if (!celspan_object_bounds(shape->handle, &box)) {
    lua_settop(L, 1);
    return 1;
  }
  lua_getfield(L, 1, "name");
  const char *name = lua_tostring(L, -1);
  cs_userdata *value = cs_bare_push(L, &noun_painted);
  celspan_object *object = NULL;
  cs_host_try(L, "paint", fill(context, shape->handle, &box, texture, &object));
  celspan_status status =
      finish(context, ((const celspan_object *)shape->handle)->fade, name, &object);
  value->handle = object; /* set even after a failure, so that it is released */
  cs_host_try(L, "paint", status);
  return 1;
}

/* ---------------------------------------------------------------- warp */

/* The map is the function at index `function`. Its last error or its result is left on the
 * stack. */
typedef struct mapping {
  lua_State *L;
  int function;
  int outcome;
} mapping;

/* Reads the two numbers on top of the stack; false if they are not finite numbers. */
static bool read_point(lua_State *L, celspan_point *to) {
  bool is_good = lua_type(L, -2) == LUA_TNUMBER && lua_type(L, -1) == LUA_TNUMBER;
  *to = (celspan_point){lua_tonumber(L, -2), lua_tonumber(L, -1)};
  return is_good && cs_number_is_sane(to->x) && cs_number_is_sane(to->y);
}

/* Pushes a number in the form in which messages show it, or a word for any other value. */
static const char *push_result(lua_State *L, int index) {
  lua_Number number = lua_tonumber(L, index);
  if (number != number)
    return lua_pushliteral(L, "nan"); /* the sign of NaN has no meaning */
  return lua_type(L, index) == LUA_TNUMBER ? lua_pushfstring(L, "%f", number)
                                           : cs_userdata_type(L, index);
}

/* Pushes a message that the two values on top of the stack are wrong. */
static void push_refusal(lua_State *L, int function, celspan_point from) {
  int first = lua_gettop(L) - 1;
  const char *x = push_result(L, first), *y = push_result(L, first + 1);
  cs_caller_push_function(L, function);
  lua_pushfstring(L, "warp: the map must return two finite numbers, got %s and %s for %f, %f", x, y,
                  from.x, from.y);
  lua_concat(L, 2);
}

static celspan_status map_point(void *user, celspan_context *context, celspan_point from,
                                celspan_point *to) {
  mapping *m = user;
  lua_State *L = m->L;
  lua_pushvalue(L, m->function);
  lua_pushnumber(L, from.x);
  lua_pushnumber(L, from.y);
  m->outcome = cs_lua_error_settle(L, lua_pcall(L, 2, 2, 0), 2);
  if (m->outcome != LUA_OK)
    return celspan_context_fail(context, CELSPAN_CALLBACK, "warp: the map failed");
  if (!read_point(L, to)) {
    push_refusal(L, m->function, from);
    m->outcome = LUA_ERRRUN;
    return celspan_context_fail(context, CELSPAN_CALLBACK, "warp: the map failed");
  }
  lua_pop(L, 2);
  return CELSPAN_OK;
}

int cs_derived_warp(lua_State *L) {
  const cs_userdata *object = cs_userdata_self(L, &cs_kind_object, "warp");
  mapping m = {.L = L, .function = 2, .outcome = LUA_OK};
  celspan_warp_desc desc = CELSPAN_WARP_DESC;
  celspan_object *bent = NULL;
  desc.map = map_point;
  desc.user = &m;
  desc.within = luaL_checknumber(L, 3);
  desc.pieces = (size_t)fmin(fmax(luaL_optnumber(L, 4, (double)desc.pieces), 0), 1e9);
  lua_settop(L, 2);
  luaL_checkstack(L, 20, "warp");
  cs_userdata *value = cs_bare_push(L, &noun_warped);
  celspan_status status = celspan_object_warp(cs_host_context(L), object->handle, &desc, &bent);
  if (m.outcome != LUA_OK)
    return lua_error(L);
  cs_host_try(L, "warp", status);
  value->handle = bent;
  return 1;
}
