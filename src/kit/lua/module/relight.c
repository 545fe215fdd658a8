/* Light removed from pictures, for celspan.relight. */
#include <lauxlib.h>

#include "celspan/relight.h"
#include "inside/pictures.h"
#include "inside/scene.h"
#include "lua/bind/bare.h"
#include "lua/bind/files.h"
#include "lua/bind/form.h"
#include "lua/bind/host.h"
#include "lua/bind/named.h"
#include "lua/bind/put.h"
#include "lua/bind/userdata.h"
#include "lua/module/native.h"

/* ---------------------------------------------------------------- values */

/* The light that was removed from the picture cannot be computed again from fields. */
static const cs_noun noun = {.name = "relit", .kind = &cs_kind_texture, CS_BARE};

/* Pushes a closed value. Returns where it holds the texture that the core makes. */
static celspan_texture **push_value(lua_State *L, celspan_context *context) {
  cs_named_begin(L, context);
  return (celspan_texture **)&cs_bare_push(L, &noun)->handle;
}

/* Returns the value on top of the stack, or the failure, to the script. */
static int finish(lua_State *L, celspan_context *context, celspan_status status) {
  cs_named_end(context);
  CS_HOST_TRY(L, status);
  return 1;
}

static celspan_texture *texture_at(lua_State *L, int index) {
  cs_userdata *value = cs_userdata_test(L, index, &cs_kind_texture);
  luaL_argcheck(L, value, index, "must be a picture");
  return value->handle;
}

static celspan_light_field field_at(lua_State *L, int index) {
  celspan_light_field field = CELSPAN_ZERO;
  cs_read_numbers(L, index, 3, field.colour);
  if (lua_getfield(L, index, "terms") == LUA_TTABLE)
    for (int c = 0; c < 3; c++) {
      lua_rawgeti(L, -1, c + 1);
      cs_read_numbers(L, lua_gettop(L), CELSPAN_LIGHT_FIELD_TERMS, field.terms[c]);
      lua_pop(L, 1);
    }
  lua_pop(L, 1);
  return field;
}

static void push_field(lua_State *L, const celspan_light_field *field, bool is_uneven) {
  cs_push_numbers(L, field->colour, 3);
  if (!is_uneven)
    return;
  lua_createtable(L, 3, 0);
  for (int c = 0; c < 3; c++) {
    cs_push_numbers(L, field->terms[c], CELSPAN_LIGHT_FIELD_TERMS);
    lua_rawseti(L, -2, c + 1);
  }
  lua_setfield(L, -2, "terms");
}

/* ---------------------------------------------------------------- lights */

int cs_relight_size(lua_State *L) {
  const celspan_texture *texture = texture_at(L, 1);
  celspan_context *context = cs_host_context(L);
  celspan_picture_info info;
  luaL_argcheck(L, texture->variation->picture, 1, "must be a picture");
  CS_HOST_TRY(L, cs_store_info(context, texture->variation->picture, &info));
  lua_pushinteger(L, info.width);
  lua_pushinteger(L, info.height);
  return 2;
}

int cs_relight_estimate(lua_State *L) {
  celspan_context *context = cs_host_context(L);
  celspan_light_estimate_desc desc = CELSPAN_LIGHT_ESTIMATE_DESC;
  double patch[4] = {0, 0, 0, 0};
  desc.picture = texture_at(L, 1);
  desc.clue = (celspan_light_clue)luaL_checkinteger(L, 2);
  cs_read_numbers(L, 3, 3, desc.colour);
  if (!lua_isnoneornil(L, 4))
    cs_read_numbers(L, 4, 4, patch);
  desc.patch = (celspan_box){patch[0], patch[1], patch[2], patch[3]};
  desc.is_uneven = lua_toboolean(L, 5);
  desc.blank = lua_isnoneornil(L, 6) ? NULL : texture_at(L, 6);
  celspan_light_field field;
  CS_HOST_TRY(L, celspan_light_estimate(context, &desc, &field));
  push_field(L, &field, desc.is_uneven);
  return 1;
}

int cs_relight_shape(lua_State *L) {
  celspan_light_field field = field_at(L, 1);
  int32_t width = (int32_t)luaL_checkinteger(L, 2), height = (int32_t)luaL_checkinteger(L, 3);
  celspan_context *context = cs_host_context(L);
  celspan_texture **texture = push_value(L, context);
  return finish(L, context, celspan_light_field_texture(context, &field, width, height, texture));
}

/* ---------------------------------------------------------------- light taken off */

int cs_relight_picture(lua_State *L) {
  const celspan_texture *picture = texture_at(L, 1);
  celspan_light_field light = field_at(L, 2);
  celspan_context *context = cs_host_context(L);
  celspan_texture **texture = push_value(L, context);
  return finish(L, context, celspan_relight_picture(context, picture, &light, texture));
}

int cs_relight_exposures(lua_State *L) {
  const celspan_texture *front = texture_at(L, 1), *back = texture_at(L, 3);
  celspan_light_field front_light = field_at(L, 2), back_light = field_at(L, 4);
  celspan_context *context = cs_host_context(L);
  celspan_texture **texture = push_value(L, context);
  return finish(
      L, context,
      celspan_relight_exposures(context, front, &front_light, back, &back_light, texture));
}

/* The picture at index, and its ground at the next index. */
static celspan_relight_ground ground_at(lua_State *L, int index) {
  celspan_relight_ground ground = {.picture = texture_at(L, index)};
  if (lua_istable(L, index + 1))
    cs_read_numbers(L, index + 1, 3, ground.colour);
  else
    ground.ground = texture_at(L, index + 1);
  return ground;
}

int cs_relight_grounds(lua_State *L) {
  const celspan_relight_ground grounds[2] = {ground_at(L, 1), ground_at(L, 3)};
  celspan_light_field light = field_at(L, 5);
  celspan_context *context = cs_host_context(L);
  celspan_texture **texture = push_value(L, context);
  return finish(L, context, celspan_relight_grounds(context, grounds, &light, texture));
}

/* ---------------------------------------------------------------- files */

int cs_relight_write(lua_State *L) {
  const celspan_texture *texture = texture_at(L, 1);
  const char *path = luaL_checkstring(L, 2);
  celspan_context *context = cs_host_context(L);
  if (!cs_host_may_write(L, path))
    return cs_host_fail(L, CELSPAN_CALLBACK);
  CS_HOST_TRY(L, celspan_relight_write(context, texture, path));
  lua_pushboolean(L, true);
  return 1;
}

int cs_relight_read(lua_State *L) {
  const char *path = cs_files_find(L, cs_files_name(L, 1), NULL);
  celspan_context *context = cs_host_context(L);
  celspan_texture **texture = push_value(L, context);
  return finish(L, context, celspan_relight_read(context, path, texture));
}
