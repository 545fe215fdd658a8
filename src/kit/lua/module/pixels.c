/* celspan.pixels: a frame into memory; linear, premultiplied floats, which can be coded and
 * written. */
#include "lua/module/pixels.h"

#include <string.h>

#include "inside/context.h"
#include "inside/wide.h"
#include "lua/bind/caller.h"
#include "lua/bind/host.h"
#include "lua/bind/unknown.h"
#include "lua/bind/userdata.h"
#include "lua/module/native.h"
#include "lua/module/subject.h"

#define IMAGE "celspan.pixels"

typedef struct image {
  int32_t width, height;
  int32_t x, y;   /* the place of the first pixel in the whole frame */
  bool is_opaque; /* every pixel's alpha is certain to be 1 */
  /* RGBA, rows from top to bottom; after this structure, beginning at a line of the cache */
  float *pixels;
} image;

static int32_t coordinate(lua_State *L, int index, const char *name, int32_t size) {
  int is_whole = 0; /* 2.0 is a whole number too */
  lua_Integer at = lua_type(L, index) == LUA_TNUMBER ? lua_tointegerx(L, index, &is_whole) : -1;
  if (!is_whole || at < 0 || at >= size)
    cs_caller_error(L, "get: %s must be a whole number from 0 to %d, got %s", name, size - 1,
                    cs_userdata_number(L, index));
  return (int32_t)at;
}

/* The `self` of a method; raises for anything but an image. */
static const image *self(lua_State *L, const char *method) {
  const image *picture = luaL_testudata(L, 1, IMAGE);
  if (!picture)
    cs_caller_error(L, "%s: call it as a method, image:%s(...), got %s", method, method,
                    cs_userdata_type(L, 1));
  return picture;
}

static int get(lua_State *L) {
  const image *picture = self(L, "get");
  int32_t x = coordinate(L, 2, "x", picture->width), y = coordinate(L, 3, "y", picture->height);
  const float *pixel = picture->pixels + 4 * ((size_t)y * (size_t)picture->width + (size_t)x);
  for (int c = 0; c < 4; c++)
    lua_pushnumber(L, pixel[c]);
  return 4;
}

/* ---------------------------------------------------------------- coded */

/* A row as one span. */
static celspan_span span_of(const image *picture, int32_t y) {
  return (celspan_span){.x1 = picture->width,
                        .kind = CELSPAN_SPAN_ARRAY,
                        .array = picture->pixels + 4 * (size_t)y * (size_t)picture->width};
}

/* image:bytes{ depth =, colour =, alpha = }: RGBA, rows from top to bottom. */
static int bytes(lua_State *L) {
  const image *picture = self(L, "bytes");
  lua_settop(L, 2);
  cs_options options;
  cs_options_read(L, &cs_noun_bytes, 2, &options);
  size_t row = (size_t)picture->width * celspan_coding_pixel_size(&options.coding), size;
  if (__builtin_mul_overflow(row, (size_t)picture->height, &size))
    cs_form_fail(&options.form, "%d x %d pixels are too many for a string", picture->width,
                 picture->height);
  luaL_Buffer buffer;
  char *out = luaL_buffinitsize(L, &buffer, size);
  for (int32_t y = 0; y < picture->height; y++) {
    celspan_span span = span_of(picture, y);
    celspan_spans_code_at(&options.coding, picture->x, picture->y + y, &span, 1,
                          out + (size_t)y * row);
  }
  luaL_pushresultsize(&buffer, size);
  return 1;
}

static celspan_status write_rows(celspan_context *context, const celspan_sink *sink,
                                 const image *picture) {
  CS_TRY(sink->begin(sink->user, context, picture->width, picture->height));
  for (int32_t y = 0; y < picture->height; y++) {
    celspan_span span = span_of(picture, y);
    CS_TRY(sink->row(sink->user, context, y, &span, 1));
  }
  return CELSPAN_OK;
}

/* image:write(path [, options]) -> true | nil, message */
static int write_image(lua_State *L) {
  const image *picture = self(L, "write");
  lua_settop(L, 3);
  if (lua_type(L, 2) != LUA_TSTRING)
    return cs_caller_error(L, "write: argument 1 must be a file name like \"one.png\", got %s",
                           cs_userdata_type(L, 2));
  cs_options options;
  cs_options_read(L, &cs_noun_write, 3, &options);
  celspan_file_desc file = CELSPAN_FILE_DESC;
  file.coding = &options.coding;
  file.format = options.format;
  file.is_opaque = picture->is_opaque;
  file.place_x = picture->x;
  file.place_y = picture->y;
  celspan_context *context = cs_host_context(L);
  if (!cs_host_may_write(L, lua_tostring(L, 2)))
    return cs_host_fail(L, CELSPAN_CALLBACK);
  celspan_sink sink = CELSPAN_SINK;
  CS_HOST_TRY(L, celspan_file_sink_create(context, lua_tostring(L, 2), &file, &sink));
  CS_HOST_TRY(L, sink.end(sink.user, context, write_rows(context, &sink, picture)));
  lua_pushboolean(L, true);
  return 1;
}

/* ---------------------------------------------------------------- the value */

static int index_image(lua_State *L) {
  const image *picture = luaL_checkudata(L, 1, IMAGE);
  static const char *const names[] = {"width", "height", "get", "bytes", "write"};
  if (lua_type(L, 2) != LUA_TSTRING)
    return 0;
  const char *name = lua_tostring(L, 2);
  if (strcmp(name, "get") == 0)
    lua_pushcfunction(L, get);
  else if (strcmp(name, "bytes") == 0)
    lua_pushcfunction(L, bytes);
  else if (strcmp(name, "write") == 0)
    lua_pushcfunction(L, write_image);
  else if (strcmp(name, "width") == 0)
    lua_pushinteger(L, picture->width);
  else if (strcmp(name, "height") == 0)
    lua_pushinteger(L, picture->height);
  else
    cs_unknown_fail_name(L, "pixels", name, names, 3);
  return 1;
}

static int describe(lua_State *L) {
  const image *picture = luaL_checkudata(L, 1, IMAGE);
  lua_pushfstring(L, "pixels{ %d x %d }", picture->width, picture->height);
  return 1;
}

float *cs_pixels_push(lua_State *L, int32_t width, int32_t height, int32_t x, int32_t y,
                      bool is_opaque) {
  uint64_t count = (uint64_t)width * (uint64_t)height, pixel = 4 * sizeof(float);
  if (count > UINT64_C(1) << 32 || count > (SIZE_MAX - sizeof(image) - CS_WIDE_LINE) / pixel)
    return NULL;
  image *picture =
      lua_newuserdatauv(L, sizeof *picture + CS_WIDE_LINE + (size_t)(count * pixel), 0);
  picture->width = width;
  picture->height = height;
  picture->x = x;
  picture->y = y;
  picture->is_opaque = is_opaque;
  picture->pixels = cs_wide_align(picture + 1);
  luaL_setmetatable(L, IMAGE);
  return picture->pixels;
}

static float *push_image(const cs_form *form, const celspan_frame_desc *desc) {
  int32_t width = desc->crop_width ? desc->crop_width : desc->width;
  int32_t height = desc->crop_height ? desc->crop_height : desc->height;
  if (width <= 0 || height <= 0)
    cs_form_fail(form, "%d x %d pixels are asked for; each side must be at least 1", width, height);
  float *pixels = cs_pixels_push(form->L, width, height, desc->crop_x, desc->crop_y,
                                 celspan_frame_is_opaque(desc));
  if (!pixels)
    cs_form_fail(form, "%d x %d pixels cannot be held in memory; render a crop, or into a file",
                 width, height);
  return pixels;
}

int cs_pixels_make(lua_State *L) {
  lua_settop(L, 2);
  cs_options options;
  const celspan_frame_desc *desc = &options.desc;
  CS_HOST_TRY(L, cs_subject_read(L, &cs_noun_pixels, &options));
  float *out = push_image(&options.form, desc);
  int32_t width = desc->crop_width ? desc->crop_width : desc->width;
  celspan_coding coding = {.struct_size = sizeof coding,
                           .depth = CELSPAN_DEPTH_FLOAT,
                           .transfer = CELSPAN_TRANSFER_LINEAR,
                           .alpha = CELSPAN_ALPHA_PREMULTIPLIED};
  lua_State *before = cs_host_enter(L);
  celspan_status status = celspan_frame_pixels(cs_host_context(L), desc, &coding, out,
                                               (size_t)width * 4 * sizeof(float), NULL);
  cs_host_leave(L, before);
  return status == CELSPAN_OK ? 1 : cs_host_fail(L, status);
}

void cs_pixels_open(lua_State *L) {
  static const luaL_Reg metamethods[] = {
      {"__index", index_image}, {"__tostring", describe}, {NULL, NULL}};
  cs_userdata_open_metatable(L, IMAGE, metamethods);
}
