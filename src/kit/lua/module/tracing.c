/* The shapes of a picture, for celspan.trace. */
#include <lauxlib.h>
#include <stdio.h>

#include "celspan/trace.h"
#include "inside/colour.h"
#include "inside/pictures.h"
#include "inside/scene.h"
#include "lua/bind/form.h"
#include "lua/bind/host.h"
#include "lua/bind/list.h"
#include "lua/bind/put.h"
#include "lua/bind/userdata.h"
#include "lua/module/native.h"
#include "tools/trace/result.h"

#define MOST_COLOURS 64

/* ---------------------------------------------------------------- the value */

CS_HOLDER_RELEASE(release, celspan_trace, celspan_trace_unref)

/* ---------------------------------------------------------------- options */

/* The codes of colour i of the list on top of the stack. */
static bool read_code(lua_State *L, int i, unsigned char *code) {
  celspan_paint paint;
  lua_rawgeti(L, -1, i);
  const char *text = lua_tostring(L, -1);
  bool is_read = text && cs_form_colour(text, &paint) && paint.beta == 1;
  for (int c = 0; c < 3 && is_read; c++)
    code[c] = cs_transfer_srgb8(paint.pigment[c]);
  lua_pop(L, 1);
  return is_read;
}

/* Argument 1: the name of a file, or a celspan.picture of pixels. */
static void read_picture(lua_State *L, celspan_picture_desc *out) {
  const cs_userdata *value = cs_userdata_test(L, 1, &cs_kind_texture);
  const celspan_texture *texture = value ? value->handle : NULL;
  if (texture && texture->variation && texture->variation->picture)
    out->surface = texture->variation->picture->surface;
  if (!out->surface)
    out->file = luaL_checkstring(L, 1);
}

/* Argument 2. codes: room for all colours. */
static celspan_trace_desc read_options(lua_State *L, celspan_picture_desc *picture,
                                       unsigned char codes[3 * MOST_COLOURS]) {
  celspan_trace_desc desc = CELSPAN_TRACE_DESC;
  read_picture(L, picture);
  desc.picture = picture;
  luaL_checktype(L, 2, LUA_TTABLE);
  if (lua_getfield(L, 2, "colours") == LUA_TTABLE) {
    desc.colours = (int32_t)cs_list_length(L, -1);
    desc.codes = codes;
    for (int i = 0; i < desc.colours && i < MOST_COLOURS; i++)
      if (!read_code(L, i + 1, codes + 3 * i))
        luaL_error(L, "trace: colours[%d] must be a colour like #336699", i + 1);
  } else {
    desc.colours = (int32_t)luaL_optinteger(L, -1, desc.colours);
  }
  lua_getfield(L, 2, "smooth");
  desc.smooth = luaL_optnumber(L, -1, desc.smooth);
  lua_getfield(L, 2, "speckle");
  desc.speckle = (int32_t)luaL_optinteger(L, -1, desc.speckle);
  lua_getfield(L, 2, "lines");
  desc.lines = lua_toboolean(L, -1);
  lua_pop(L, 4);
  return desc;
}

/* ---------------------------------------------------------------- shapes */

static void set_number(lua_State *L, const char *name, double number) {
  lua_Integer whole = (lua_Integer)number;
  if ((double)whole == number)
    lua_pushinteger(L, whole);
  else
    lua_pushnumber(L, number);
  lua_setfield(L, -2, name);
}

static void push_points(lua_State *L, const celspan_trace_shape *shape) {
  lua_createtable(L, (int)shape->point_count, 0);
  for (size_t i = 0; i < shape->point_count; i++) {
    const celspan_point *at = &shape->points[i];
    cs_push_numbers(L, (const double[]){at->x, at->y, shape->widths[i]}, 3);
    lua_rawseti(L, -2, (lua_Integer)i + 1);
  }
}

static void push_shape(lua_State *L, const celspan_trace_shape *shape) {
  char colour[8];
  snprintf(colour, sizeof colour, "#%02x%02x%02x", shape->colour[0], shape->colour[1],
           shape->colour[2]);
  lua_createtable(L, 0, 6);
  cs_put_text(L, "colour", colour);
  set_number(L, "x", shape->x);
  set_number(L, "y", shape->y);
  set_number(L, "area", shape->area);
  if (shape->data) {
    cs_put_text(L, "d", shape->data);
    return;
  }
  push_points(L, shape);
  lua_setfield(L, -2, "points");
  cs_put_flag(L, "closed", shape->is_closed);
}

static void push_result(lua_State *L, const celspan_trace *trace) {
  int32_t width, height;
  celspan_trace_shape shape = CELSPAN_TRACE_SHAPE;
  celspan_trace_size(trace, &width, &height);
  lua_createtable(L, 0, 3);
  set_number(L, "width", width);
  set_number(L, "height", height);
  lua_createtable(L, (int)celspan_trace_shape_count(trace), 0);
  for (size_t i = 0; celspan_trace_shape_at(trace, i, &shape); i++) {
    push_shape(L, &shape);
    lua_rawseti(L, -2, (lua_Integer)i + 1);
  }
  lua_setfield(L, -2, "shapes");
}

/* Pushes a holder of the tracing of arguments 1 and 2. */
static celspan_status push_tracing(lua_State *L, const celspan_trace **out) {
  unsigned char codes[3 * MOST_COLOURS];
  celspan_picture_desc picture = CELSPAN_PICTURE_DESC;
  celspan_trace_desc desc = read_options(L, &picture, codes);
  celspan_trace **trace = cs_userdata_push_holder(L, "celspan.tracing", sizeof *trace, release);
  celspan_status status = cs_result_make(cs_host_context(L), &desc, trace);
  *out = *trace;
  return status;
}

int cs_tracing_make(lua_State *L) {
  const celspan_trace *trace;
  CS_HOST_TRY(L, push_tracing(L, &trace));
  push_result(L, trace);
  return 1;
}

int cs_tracing_write(lua_State *L) {
  const celspan_trace *trace;
  const char *output = luaL_checkstring(L, 3);
  if (!cs_host_may_write(L, output))
    return cs_host_fail(L, CELSPAN_CALLBACK);
  CS_HOST_TRY(L, push_tracing(L, &trace));
  CS_HOST_TRY(L, celspan_trace_write(cs_host_context(L), trace, output));
  lua_pushboolean(L, true);
  return 1;
}
