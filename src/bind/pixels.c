/* celspan.pixels: a rostrum into memory; linear, premultiplied floats. */
#include <string.h>

#include "bind/host.h"
#include "bind/openers.h"
#include "bind/options.h"

#define IMAGE "celspan.pixels"

static const cs_field fields[] = {CS_OPTIONS_FIELDS, {0}};
static const cs_noun noun = {.name = "pixels", .fields = fields};

typedef struct image {
  int32_t width, height;
  float pixels[]; /* RGBA, rows top to bottom */
} image;

static int32_t coordinate(lua_State *L, int index, const char *name, int32_t size) {
  lua_Integer at = lua_isinteger(L, index) ? lua_tointeger(L, index) : -1;
  if (lua_type(L, index) == LUA_TNUMBER && lua_tonumber(L, index) == (lua_Number)(int)at)
    at = (lua_Integer)lua_tonumber(L, index);
  if (at < 0 || at >= size)
    luaL_error(L, "get: %s must be a whole number from 0 to %d, got %s", name, size - 1,
               luaL_tolstring(L, index, NULL));
  return (int32_t)at;
}

static int get(lua_State *L) {
  const image *picture = luaL_checkudata(L, 1, IMAGE);
  int32_t x = coordinate(L, 2, "x", picture->width), y = coordinate(L, 3, "y", picture->height);
  const float *pixel = picture->pixels + 4 * ((size_t)y * (size_t)picture->width + (size_t)x);
  for (int c = 0; c < 4; c++)
    lua_pushnumber(L, pixel[c]);
  return 4;
}

static int index_image(lua_State *L) {
  const image *picture = luaL_checkudata(L, 1, IMAGE);
  const char *name = lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : "";
  if (strcmp(name, "get") == 0)
    lua_pushcfunction(L, get);
  else if (strcmp(name, "width") == 0)
    lua_pushinteger(L, picture->width);
  else if (strcmp(name, "height") == 0)
    lua_pushinteger(L, picture->height);
  else
    lua_pushnil(L);
  return 1;
}

static int describe(lua_State *L) {
  const image *picture = luaL_checkudata(L, 1, IMAGE);
  lua_pushfstring(L, "pixels{ %d x %d }", picture->width, picture->height);
  return 1;
}

static image *push_image(const cs_form *form, const celspan_frame_desc *desc) {
  int32_t width = desc->crop_width ? desc->crop_width : desc->width;
  int32_t height = desc->crop_height ? desc->crop_height : desc->height;
  if (width <= 0 || height <= 0)
    cs_form_fail(form, "%d x %d pixels are asked for; each side must be at least 1", width, height);
  if ((int64_t)width * height > INT64_C(1) << 32)
    cs_form_fail(form, "%d x %d pixels cannot be held in memory; render a crop, or into a file",
                 width, height);
  size_t count = 4 * (size_t)width * (size_t)height;
  image *picture = lua_newuserdatauv(form->L, sizeof *picture + count * sizeof(float), 0);
  picture->width = width;
  picture->height = height;
  luaL_setmetatable(form->L, IMAGE);
  return picture;
}

static int pixels(lua_State *L) {
  lua_settop(L, 2);
  cs_form form = cs_options_open(L, &noun, 2);
  cs_options_frame frame;
  cs_options_read(&form, &frame);
  cs_options_exposures(L, 1, "pixels: argument 1", &frame.desc);
  image *picture = push_image(&form, &frame.desc);
  celspan_coding coding = {CELSPAN_DEPTH_FLOAT, CELSPAN_TRANSFER_LINEAR,
                           CELSPAN_ALPHA_PREMULTIPLIED};
  celspan_context *context = cs_host_context(L);
  lua_State *before = cs_host_enter(L);
  celspan_status status = celspan_frame_pixels(context, &frame.desc, &coding, picture->pixels,
                                               (size_t)picture->width * 4 * sizeof(float), NULL);
  cs_host_leave(L, before);
  if (status == CELSPAN_OK)
    return 1;
  luaL_pushfail(L);
  lua_pushstring(L, celspan_context_error(context));
  return 2;
}

void cs_open_pixels(lua_State *L) {
  static const luaL_Reg metamethods[] = {
      {"__index", index_image}, {"__tostring", describe}, {NULL, NULL}};
  luaL_newmetatable(L, IMAGE);
  luaL_setfuncs(L, metamethods, 0);
  lua_pop(L, 1);
  lua_pushcfunction(L, pixels);
  lua_setfield(L, -2, "pixels");
}
