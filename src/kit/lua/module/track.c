/* Following a region through frames, for celspan.track. */
#include <stdint.h>
#include <string.h>

#include "celspan/track.h"
#include "lua/bind/form.h"
#include "lua/bind/host.h"
#include "lua/bind/put.h"
#include "lua/bind/userdata.h"
#include "lua/module/native.h"

#define TRACKER "celspan.tracker"
enum { PIXEL = 4 * sizeof(uint16_t) }; /* bytes */

/* ---------------------------------------------------------------- frames as light */

/* The string at index as a frame of coded light, in scratch memory on the stack. */
static celspan_luma push_luma(lua_State *L, int index, int32_t width, int32_t height) {
  size_t size, count = (size_t)width * (size_t)height;
  const char *bytes = luaL_checklstring(L, index, &size);
  luaL_argcheck(L, width > 0 && height > 0 && size / PIXEL == count && size % PIXEL == 0, index,
                "has another size");
  float *values = cs_form_scratch(L, count, sizeof *values);
  for (size_t i = 0; i < count; i++) {
    uint16_t rgba[4];
    memcpy(rgba, bytes + i * PIXEL, PIXEL);
    /* The weights of coded light: ITU-R BT.601. */
    values[i] = (0.299F * rgba[0] + 0.587F * rgba[1] + 0.114F * rgba[2]) / 65535;
  }
  return (celspan_luma){width, height, values};
}

/* The alpha of the string at index as a mask, in scratch memory; NULL where there is none. */
static const uint8_t *push_mask(lua_State *L, int index, size_t count) {
  size_t size;
  const char *bytes = lua_tolstring(L, index, &size);
  if (!bytes)
    return NULL;
  luaL_argcheck(L, size == count * PIXEL, index, "has another size");
  uint8_t *mask = cs_form_scratch(L, count, 1);
  for (size_t i = 0; i < count; i++) {
    uint16_t alpha;
    memcpy(&alpha, bytes + i * PIXEL + 3 * sizeof alpha, sizeof alpha);
    mask[i] = alpha >= 0x8000;
  }
  return mask;
}

/* ---------------------------------------------------------------- a tracker */

CS_HOLDER_RELEASE(release, celspan_tracker, celspan_tracker_destroy)

static double number_in(lua_State *L, int index, int i) {
  lua_rawgeti(L, index, i);
  double value = luaL_checknumber(L, -1);
  lua_pop(L, 1);
  return value;
}

int cs_track_tracker(lua_State *L) {
  lua_settop(L, 6);
  int32_t width = (int32_t)luaL_checkinteger(L, 2), height = (int32_t)luaL_checkinteger(L, 3);
  celspan_tracker_desc desc = {.struct_size = sizeof desc,
                               .model = (celspan_motion)luaL_checkinteger(L, 4)};
  luaL_checktype(L, 5, LUA_TTABLE);
  desc.region =
      (celspan_box){number_in(L, 5, 1), number_in(L, 5, 2), number_in(L, 5, 3), number_in(L, 5, 4)};
  celspan_context *context = cs_host_context(L);
  celspan_luma luma = push_luma(L, 1, width, height);
  desc.mask = push_mask(L, 6, (size_t)width * (size_t)height);
  celspan_tracker **holder = cs_userdata_push_holder(L, TRACKER, sizeof *holder, release);
  celspan_status status = celspan_tracker_create(context, &luma, &desc, holder);
  return status == CELSPAN_OK ? 1 : cs_host_fail(L, status);
}

static celspan_tracker *tracker_at(lua_State *L, int index) {
  celspan_tracker **holder = luaL_checkudata(L, index, TRACKER);
  luaL_argcheck(L, *holder, index, "is closed");
  return *holder;
}

static void push_matrix(lua_State *L, celspan_matrix matrix) {
  double numbers[9];
  for (int i = 0; i < 9; i++)
    numbers[i] = matrix.m[i] / matrix.m[8];
  cs_push_numbers(L, numbers, 9);
}

/* The motion of a sighting, for coordinates that are counted from the corner of the first pixel. */
static celspan_matrix from_corners(celspan_matrix motion) {
  celspan_matrix to_corner = celspan_matrix_translation(0.5, 0.5);
  celspan_matrix to_centre = celspan_matrix_translation(-0.5, -0.5);
  return celspan_matrix_then(celspan_matrix_then(to_centre, motion), to_corner);
}

int cs_track_follow(lua_State *L) {
  celspan_tracker *tracker = tracker_at(L, 1);
  celspan_luma luma =
      push_luma(L, 2, (int32_t)luaL_checkinteger(L, 3), (int32_t)luaL_checkinteger(L, 4));
  celspan_sighting sighting = CELSPAN_SIGHTING;
  CS_HOST_TRY(L, celspan_tracker_follow(tracker, &luma, &sighting));
  if (!sighting.is_found) {
    luaL_pushfail(L);
    return 1;
  }
  push_matrix(L, from_corners(sighting.matrix));
  lua_pushinteger(L, sighting.corner_count);
  lua_pushinteger(L, sighting.agreeing_count);
  lua_pushnumber(L, sighting.error);
  return 4;
}

int cs_track_rewind(lua_State *L) {
  celspan_tracker_rewind(tracker_at(L, 1));
  return 0;
}

int cs_track_inverse(lua_State *L) {
  celspan_matrix matrix;
  luaL_checktype(L, 1, LUA_TTABLE);
  for (int i = 0; i < 9; i++)
    matrix.m[i] = number_in(L, 1, i + 1);
  if (celspan_matrix_inverse(matrix, &matrix))
    push_matrix(L, matrix);
  else
    luaL_pushfail(L);
  return 1;
}
