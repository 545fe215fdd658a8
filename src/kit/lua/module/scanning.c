/* Scanned drawings, for celspan.ink. */
#include <lauxlib.h>

#include "inside/colour.h"
#include "inside/context.h"
#include "inside/pictures.h"
#include "inside/scene.h"
#include "lua/bind/form.h"
#include "lua/bind/host.h"
#include "lua/bind/list.h"
#include "lua/bind/put.h"
#include "lua/bind/userdata.h"
#include "lua/module/native.h"
#include "lua/nouns/pixel_string.h"
#include "tools/scan/holes.h"
#include "tools/scan/inks.h"
#include "tools/scan/shift.h"

#define PAGE "celspan.page"

CS_HOLDER_RELEASE(release_page, cs_rough, cs_rough_destroy)

static cs_rough *page_at(lua_State *L, int index) {
  cs_rough **holder = luaL_checkudata(L, index, PAGE);
  luaL_argcheck(L, *holder, index, "is closed");
  return *holder;
}

static int push_numbers(lua_State *L, const double *numbers, int count) {
  for (int i = 0; i < count; i++)
    lua_pushnumber(L, numbers[i]);
  return count;
}

/* ---------------------------------------------------------------- a page, and where it lies */

int cs_scanning_open(lua_State *L) {
  celspan_context *context = cs_host_context(L);
  celspan_picture_desc desc = CELSPAN_PICTURE_DESC;
  cs_picture *picture;
  double dpi = 0;
  desc.file = luaL_checkstring(L, 1);
  cs_rough **page = cs_userdata_push_holder(L, PAGE, sizeof *page, release_page);
  CS_HOST_TRY(L, cs_picture_create(context, &desc, &picture));
  celspan_status status = cs_store_dpi(context, picture, &dpi);
  if (status == CELSPAN_OK)
    status = cs_rough_create(context, picture, page);
  cs_picture_unref(picture);
  CS_HOST_TRY(L, status);
  lua_pushinteger(L, (*page)->scan.width);
  lua_pushinteger(L, (*page)->scan.height);
  lua_pushnumber(L, dpi);
  return 4;
}

int cs_scanning_close(lua_State *L) {
  page_at(L, 1);
  return release_page(L);
}

int cs_scanning_pegs(lua_State *L) {
  cs_rough *page = page_at(L, 1);
  double dpi = luaL_checknumber(L, 2);
  cs_hole holes[CS_ROUGH_HOLES];
  cs_pegs pegs;
  luaL_checktype(L, 3, LUA_TTABLE);
  size_t count = lua_rawlen(L, 3);
  luaL_argcheck(L, count >= 2 && count <= CS_ROUGH_HOLES, 3, "has too few or too many holes");
  for (size_t i = 0; i < count; i++) {
    double hole[4];
    lua_rawgeti(L, 3, (lua_Integer)i + 1);
    cs_read_numbers(L, lua_gettop(L), 4, hole);
    holes[i] = (cs_hole){hole[0], hole[1], hole[2], hole[3]};
    lua_pop(L, 1);
  }
  CS_HOST_TRY(L, cs_holes_find(page, dpi, holes, count, &pegs));
  lua_pushinteger(L, pegs.found);
  return 1 +
         push_numbers(L, (const double[]){pegs.scale, pegs.turn, pegs.x, pegs.y, pegs.error}, 5);
}

int cs_scanning_corners(lua_State *L) {
  cs_rough_place place;
  if (!cs_rough_paper(page_at(L, 1), &place))
    return 0;
  return push_numbers(L, (const double[]){place.turn, place.x, place.y, place.error}, 4);
}

int cs_scanning_shift(lua_State *L) {
  cs_rough_shift shift;
  CS_HOST_TRY(L, cs_shift_find(page_at(L, 1), page_at(L, 2), &shift));
  return push_numbers(L, (const double[]){shift.x, shift.y, shift.likeness}, 3);
}

/* ---------------------------------------------------------------- lines */

/* Arguments 2 to 6: the place and size of the result, the colours, the least area, and black and
 * white, if given. */
static cs_inks_desc read_desc(lua_State *L) {
  cs_inks_desc desc = {.dust = (uint32_t)luaL_checkinteger(L, 4)};
  double place[7];
  cs_read_numbers(L, 2, 7, place);
  desc.place = (cs_layer_place){place[0], place[1],          place[2],         place[3],
                                place[4], (int32_t)place[5], (int32_t)place[6]};
  luaL_checktype(L, 3, LUA_TTABLE);
  for (int i = 1; i <= (int)cs_list_length(L, 3) && i <= CS_INKS_MOST; i++) {
    celspan_paint paint;
    lua_rawgeti(L, 3, i);
    luaL_argcheck(L, cs_form_colour(luaL_checkstring(L, -1), &paint), 3, "is no colour");
    for (int c = 0; c < 3; c++)
      desc.codes[desc.count][c] = cs_transfer_srgb8(paint.pigment[c]);
    desc.count++;
    lua_pop(L, 1);
  }
  desc.has_tones = !lua_isnoneornil(L, 5);
  desc.black = desc.has_tones ? luaL_checknumber(L, 5) : 0;
  desc.white = desc.has_tones ? luaL_checknumber(L, 6) : 0;
  return desc;
}

/* Also if Lua has no memory for the result. */
static int release_inks(lua_State *L) {
  cs_inks_finish(lua_touserdata(L, 1));
  return 0;
}

int cs_scanning_lines(lua_State *L) {
  lua_settop(L, 6);
  const cs_rough *page = page_at(L, 1);
  const cs_inks_desc desc = read_desc(L);
  cs_inks *inks = cs_userdata_push_holder(L, "celspan.inks", sizeof *inks, release_inks);
  CS_HOST_TRY(L, cs_inks_make(page, &desc, inks));
  lua_createtable(L, (int)desc.count, 0);
  for (size_t i = 0; i < desc.count; i++) {
    cs_pixel_string_push_surface(L, inks->layers[i]);
    lua_rawseti(L, -2, (lua_Integer)i + 1);
  }
  lua_pushnumber(L, inks->black);
  lua_pushnumber(L, inks->white);
  lua_pushinteger(L, (lua_Integer)inks->covered);
  return 4;
}
