/* Values in the colours of another palette, for ink.recolour. */
#include <lauxlib.h>
#include <stdio.h>
#include <string.h>

#include "inside/colour.h"
#include "lua/bind/bare.h"
#include "lua/bind/host.h"
#include "lua/bind/put.h"
#include "lua/bind/userdata.h"
#include "lua/module/native.h"
#include "tools/recolour/recolour.h"

#define RECOLOURING "celspan.recolouring"
enum { STEPS_A_PIXEL = 16 }; /* steps of the sandbox */

static const cs_noun noun_object = {.name = "recoloured", .kind = &cs_kind_object, CS_BARE};
static const cs_noun noun_texture = {.name = "recoloured", .kind = &cs_kind_texture, CS_BARE};

static int release(lua_State *L) {
  cs_recolour *recolour = lua_touserdata(L, 1);
  if (recolour->context)
    cs_recolour_finish(recolour);
  recolour->context = NULL;
  return 0;
}

/* The codes of the list of lights at an index, as scratch memory on the stack. */
static const double *codes_at(lua_State *L, int index, size_t *count) {
  luaL_checktype(L, index, LUA_TTABLE);
  *count = lua_rawlen(L, index);
  double *codes = lua_newuserdatauv(L, (*count + 1) * sizeof *codes, 0);
  for (size_t i = 0; i < *count; i++) {
    lua_rawgeti(L, index, (lua_Integer)i + 1);
    codes[i] = cs_transfer_code(luaL_checknumber(L, -1));
    lua_pop(L, 1);
  }
  return codes;
}

int cs_recolour_make(lua_State *L) {
  size_t count, same;
  bool is_linear = lua_toboolean(L, 3), is_strict = lua_toboolean(L, 4);
  const double *from = codes_at(L, 1, &count), *to = codes_at(L, 2, &same);
  luaL_argcheck(L, count == same && count > 0 && count % 3 == 0, 2, "three numbers a colour");
  cs_recolour *recolour = cs_userdata_push_holder(L, RECOLOURING, sizeof *recolour, release);
  *recolour = (cs_recolour){.context = cs_host_context(L), .is_strict = is_strict};
  cs_host_try(
      L, "recolour",
      cs_swatches_init(recolour->context, from, to, count / 3, is_linear, &recolour->swatches));
  cs_host_try(L, "recolour", cs_recolour_begin(recolour));
  return 1;
}

/* Pushes an object or a texture in the new colours. */
static void push_recoloured(lua_State *L, cs_recolour *recolour, cs_userdata *from,
                            bool is_object) {
  celspan_object *object = NULL;
  celspan_texture *texture = NULL;
  cs_userdata *value = cs_bare_push(L, is_object ? &noun_object : &noun_texture);
  if (is_object)
    memcpy(cs_userdata_own(value), cs_userdata_own(from), noun_object.kind->own_size);
  cs_host_try(L, "recolour",
              is_object ? cs_recolour_object(recolour, from->handle, &object)
                        : cs_recolour_texture(recolour, from->handle, &texture));
  value->handle = is_object ? (void *)object : (void *)texture;
}

int cs_recolour_see(lua_State *L) {
  cs_recolour *recolour = luaL_checkudata(L, 1, RECOLOURING);
  const cs_userdata *from = cs_userdata_test(L, 2, &cs_kind_rostrum);
  celspan_rostrum *rostrum = NULL;
  luaL_argcheck(L, from, 2, "a rostrum is needed");
  recolour->only_known = true;
  recolour->strange_count = 0;
  cs_host_try(L, "recolour", cs_recolour_rostrum(recolour, from->handle, &rostrum));
  celspan_rostrum_unref(rostrum);
  return 0;
}

int cs_recolour_value(lua_State *L) {
  cs_recolour *recolour = luaL_checkudata(L, 1, RECOLOURING);
  cs_userdata *object = cs_userdata_test(L, 2, &cs_kind_object);
  cs_userdata *texture = cs_userdata_test(L, 2, &cs_kind_texture);
  recolour->work = 0;
  recolour->object = NULL;
  if (!object && !texture)
    return 0;
  push_recoloured(L, recolour, object ? object : texture, object != NULL);
  cs_host_charge(L, STEPS_A_PIXEL * (uint64_t)recolour->work);
  return 1;
}

int cs_recolour_strange(lua_State *L) {
  const cs_recolour *recolour = luaL_checkudata(L, 1, RECOLOURING);
  lua_createtable(L, (int)recolour->strange_count, 0);
  for (size_t i = 0; i < recolour->strange_count; i++) {
    const cs_strange *strange = &recolour->strange[i];
    char colour[8];
    snprintf(colour, sizeof colour, "#%06x", (unsigned)strange->rgb);
    lua_createtable(L, 0, 5);
    cs_put_text(L, "colour", colour);
    cs_put_integer(L, "count", strange->count);
    cs_put_text(L, "place", strange->place);
    if (strange->x >= 0) {
      cs_put_integer(L, "x", strange->x);
      cs_put_integer(L, "y", strange->y);
    }
    lua_rawseti(L, -2, (lua_Integer)i + 1);
  }
  return 1;
}
