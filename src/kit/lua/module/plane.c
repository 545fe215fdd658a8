/* celspan.plane and celspan.plane_read: frames without a size, drawn at any size. */
#include <string.h>

#include "celspan/plane.h"
#include "lua/bind/caller.h"
#include "lua/bind/files.h"
#include "lua/bind/host.h"
#include "lua/bind/unknown.h"
#include "lua/bind/userdata.h"
#include "lua/module/native.h"
#include "lua/module/pixels.h"
#include "lua/module/subject.h"
#include "writers/plane/plane.h"

static int finish_plane(lua_State *L) {
  celspan_plane **plane = luaL_checkudata(L, 1, CS_NATIVE_PLANE);
  celspan_plane_unref(*plane);
  *plane = NULL;
  return 0;
}

/* Pushes a Lua value before its plane is made, so that an error at any point leaks nothing. */
static celspan_plane **push_plane(lua_State *L) {
  celspan_plane **plane = lua_newuserdatauv(L, sizeof *plane, 0);
  *plane = NULL;
  luaL_setmetatable(L, CS_NATIVE_PLANE);
  return plane;
}

static int finish(lua_State *L, celspan_status status) {
  return status == CELSPAN_OK ? 1 : cs_host_fail(L, status);
}

/* The `self` of a method; raises for anything but a plane. */
static const celspan_plane *self(lua_State *L, const char *method) {
  celspan_plane **plane = luaL_testudata(L, 1, CS_NATIVE_PLANE);
  if (!plane || !*plane)
    cs_caller_error(L, "%s: call it as a method, plane:%s(...), got %s", method, method,
                    cs_userdata_type(L, 1));
  return *plane;
}

/* ---------------------------------------------------------------- made and read */

static celspan_status make(lua_State *L, const cs_options *options, celspan_plane **out) {
  const celspan_frame_desc *desc = &options->desc;
  lua_State *before = cs_host_enter(L);
  celspan_plane_desc plane = CELSPAN_PLANE_DESC;
  plane.width = desc->film_width;
  plane.height = desc->film_height;
  plane.depth = cs_plane_depth(options->coding.depth);
  plane.space = desc->space;
  celspan_status status =
      cs_plane_expose(cs_host_context(L), desc->exposures, desc->exposure_count, &plane, out);
  cs_host_leave(L, before);
  return status;
}

int cs_plane_make(lua_State *L) {
  lua_settop(L, 2);
  cs_options options;
  celspan_status status = cs_subject_read(L, &cs_noun_plane, &options);
  celspan_depth depth = options.coding.depth;
  if (depth == CELSPAN_DEPTH_HALF || depth == CELSPAN_DEPTH_FLOAT)
    cs_form_fail(&options.form, "field 'depth' must be 8 or 16");
  if (status == CELSPAN_OK)
    status = make(L, &options, push_plane(L));
  return finish(L, status);
}

int cs_plane_open_file(lua_State *L) {
  const char *tried, *path;
  if (lua_type(L, 1) != LUA_TSTRING)
    return cs_caller_error(L,
                           "plane_read: argument 1 must be a file name like \"one.plane\", got %s",
                           cs_userdata_type(L, 1));
  path = cs_files_find(L, cs_files_name(L, 1), &tried);
  return finish(L, celspan_plane_read(cs_host_context(L), path, push_plane(L)));
}

/* ---------------------------------------------------------------- written and drawn */

/* plane:write(path) -> true | nil, message */
static int write_plane(lua_State *L) {
  const celspan_plane *plane = self(L, "write");
  if (lua_type(L, 2) != LUA_TSTRING)
    return cs_caller_error(L, "write: argument 1 must be a file name like \"one.plane\", got %s",
                           cs_userdata_type(L, 2));
  if (!cs_host_may_write(L, lua_tostring(L, 2)))
    return cs_host_fail(L, CELSPAN_CALLBACK);
  CS_HOST_TRY(L, celspan_plane_write(cs_host_context(L), plane, lua_tostring(L, 2)));
  lua_pushboolean(L, true);
  return 1;
}

static int32_t natural_side(double units) {
  return units < 1 ? 1 : units < INT32_MAX ? (int32_t)(units + 0.5) : INT32_MAX;
}

static celspan_plane_view read_view(lua_State *L, const celspan_plane *plane, cs_options *options) {
  celspan_plane_view view = CELSPAN_PLANE_VIEW;
  double width, height;
  cs_options_read(L, &cs_noun_plane_view, 2, options);
  celspan_plane_size(plane, &width, &height);
  view.width = options->has_size ? options->size[0] : natural_side(width);
  view.height = options->has_size ? options->size[1] : natural_side(height);
  view.crop_x = options->crop[0];
  view.crop_y = options->crop[1];
  view.crop_width = options->crop[2];
  view.crop_height = options->crop[3];
  view.antialias = options->desc.antialias;
  return view;
}

/* plane:pixels{ size =, crop =, antialias = } -> image | nil, message */
static int pixels(lua_State *L) {
  static const celspan_coding coding = {.struct_size = sizeof coding,
                                        .depth = CELSPAN_DEPTH_FLOAT,
                                        .transfer = CELSPAN_TRANSFER_LINEAR,
                                        .alpha = CELSPAN_ALPHA_PREMULTIPLIED};
  const celspan_plane *plane = self(L, "pixels");
  cs_options options;
  lua_settop(L, 2);
  const celspan_plane_view view = read_view(L, plane, &options);
  int32_t width = view.crop_width ? view.crop_width : view.width;
  int32_t height = view.crop_height ? view.crop_height : view.height;
  if (width <= 0 || height <= 0)
    cs_form_fail(&options.form, "%d x %d pixels are asked for; each side must be at least 1", width,
                 height);
  float *out =
      cs_pixels_push(L, width, height, view.crop_x, view.crop_y, celspan_plane_is_opaque(plane));
  if (!out)
    cs_form_fail(&options.form, "%d x %d pixels cannot be held in memory; draw a crop", width,
                 height);
  return finish(L, celspan_plane_pixels(cs_host_context(L), plane, &view, &coding, out,
                                        (size_t)width * 4 * sizeof(float)));
}

/* plane:frame(number) -> plane | nil, message */
static int choose_frame(lua_State *L) {
  const celspan_plane *plane = self(L, "frame");
  double rate;
  int is_whole, count = celspan_plane_frames(plane, &rate);
  lua_Integer number = lua_tointegerx(L, 2, &is_whole);
  if (!is_whole || number < 1 || number > count)
    return cs_caller_error(L, "frame: argument 1 must be a whole number from 1 to %d, got %s",
                           count, lua_isnumber(L, 2) ? lua_tostring(L, 2) : cs_userdata_type(L, 2));
  return finish(
      L, celspan_plane_frame(cs_host_context(L), plane, (int32_t)(number - 1), push_plane(L)));
}

/* ---------------------------------------------------------------- the value */

/* Pushes the field of that name, if it is a number. */
static bool push_number(lua_State *L, const celspan_plane *plane, const char *name) {
  double width, height, rate;
  int32_t count = celspan_plane_frames(plane, &rate);
  celspan_plane_size(plane, &width, &height);
  if (strcmp(name, "bytes") == 0)
    lua_pushinteger(L, (lua_Integer)celspan_plane_bytes(plane));
  else if (strcmp(name, "frames") == 0)
    lua_pushinteger(L, count);
  else if (strcmp(name, "fps") == 0)
    lua_pushnumber(L, rate);
  else if (strcmp(name, "width") == 0 || strcmp(name, "height") == 0)
    lua_pushnumber(L, name[0] == 'w' ? width : height);
  else
    return false;
  return true;
}

static int index_plane(lua_State *L) {
  static const luaL_Reg methods[] = {
      {"pixels", pixels}, {"write", write_plane}, {"frame", choose_frame}};
  static const char *const names[] = {"width", "height", "bytes", "frames",
                                      "fps",   "pixels", "write", "frame"};
  celspan_plane *const *plane = luaL_checkudata(L, 1, CS_NATIVE_PLANE);
  if (lua_type(L, 2) != LUA_TSTRING)
    return 0;
  const char *name = lua_tostring(L, 2);
  for (size_t i = 0; i < sizeof methods / sizeof *methods; i++)
    if (strcmp(name, methods[i].name) == 0) {
      lua_pushcfunction(L, methods[i].func);
      return 1;
    }
  if (!push_number(L, *plane, name))
    cs_unknown_fail_name(L, "plane", name, names, sizeof names / sizeof *names);
  return 1;
}

static int describe(lua_State *L) {
  celspan_plane *const *plane = luaL_checkudata(L, 1, CS_NATIVE_PLANE);
  double width, height;
  celspan_plane_size(*plane, &width, &height);
  lua_pushfstring(L, "plane{ %f x %f, %I bytes }", width, height,
                  (LUAI_UACINT)celspan_plane_bytes(*plane));
  return 1;
}

void cs_plane_open(lua_State *L) {
  static const luaL_Reg metamethods[] = {
      {"__index", index_plane}, {"__tostring", describe}, {"__gc", finish_plane}, {NULL, NULL}};
  cs_userdata_open_metatable(L, CS_NATIVE_PLANE, metamethods);
}
