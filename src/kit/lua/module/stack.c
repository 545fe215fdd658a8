/* Frames taken apart by their lights, celspan_stack, for relight.stack. */
#include <lauxlib.h>

#include "celspan/relight.h"
#include "inside/scene.h"
#include "lua/bind/host.h"
#include "lua/bind/put.h"
#include "lua/bind/userdata.h"
#include "lua/module/native.h"
#include "lua/module/pixels.h"
#include "lua/module/subject.h"

#define STACK "celspan.stack"
enum { NUMBERS = 8 }; /* numbers of one light */

/* ---------------------------------------------------------------- the value */

typedef struct holder {
  celspan_stack *stack; /* NULL: released */
  int32_t x, y;         /* the place of the first pixel in the whole frame */
} holder;

static int release(lua_State *L) {
  holder *held = luaL_checkudata(L, 1, STACK);
  celspan_stack_unref(held->stack);
  held->stack = NULL;
  return 0;
}

static const holder *holder_at(lua_State *L, int index) {
  const holder *held = luaL_checkudata(L, index, STACK);
  luaL_argcheck(L, held->stack, index, "is closed");
  return held;
}

/* ---------------------------------------------------------------- making */

static void push_cel(lua_State *L, const celspan_cel *cel) {
  lua_createtable(L, 0, 2);
  cs_put_text(L, "name", celspan_cel_name(cel));
  cs_put_flag(L, "has_front", cel->front.is_given);
}

/* The values of a stack for scripts. */
static void push_facts(lua_State *L, const celspan_rostrum *rostrum, celspan_space space,
                       const celspan_stack *stack) {
  int32_t width, height;
  celspan_stack_size(stack, &width, &height);
  lua_createtable(L, 0, 6);
  lua_createtable(L, (int)rostrum->cel_count, 0);
  for (size_t i = 0; i < rostrum->cel_count; i++) {
    push_cel(L, rostrum->cels[i]);
    lua_rawseti(L, -2, (lua_Integer)i + 1);
  }
  lua_setfield(L, -2, "cels");
  cs_put_number(L, "brightness", rostrum->brightness);
  cs_put_flag(L, "mixes_codes", space == CELSPAN_SPACE_SRGB);
  cs_put_number(L, "width", width);
  cs_put_number(L, "height", height);
  cs_put_number(L, "bytes", (lua_Number)celspan_stack_bytes(stack));
}

int cs_stack_make(lua_State *L) {
  lua_settop(L, 2);
  cs_options options;
  celspan_context *context = cs_host_context(L);
  CS_HOST_TRY(L, cs_subject_read(L, &cs_noun_stack, &options));
  holder *held = cs_userdata_push_holder(L, STACK, sizeof *held, release);
  lua_State *before = cs_host_enter(L);
  celspan_status status = celspan_stack_create(context, &options.desc, &held->stack);
  cs_host_leave(L, before);
  CS_HOST_TRY(L, status);
  held->x = options.desc.crop_x;
  held->y = options.desc.crop_y;
  push_facts(L, options.desc.exposures[0].rostrum, options.desc.space, held->stack);
  return 2;
}

/* ---------------------------------------------------------------- lights */

int cs_stack_lights(lua_State *L) {
  const holder *held = holder_at(L, 1);
  size_t count = celspan_stack_light_count(held->stack);
  celspan_stack_light *lights = cs_form_scratch(L, count, sizeof *lights);
  celspan_stack_lights(held->stack, lights);
  lua_createtable(L, (int)(NUMBERS * count), 0);
  for (size_t i = 0; i < count; i++) {
    const celspan_light *f = &lights[i].front, *b = &lights[i].back;
    const float values[NUMBERS] = {f->r, f->g, f->b, f->a, b->r, b->g, b->b, b->a};
    for (size_t k = 0; k < NUMBERS; k++) {
      lua_pushnumber(L, values[k]);
      lua_rawseti(L, -2, (lua_Integer)(NUMBERS * i + k + 1));
    }
  }
  return 1;
}

static celspan_light light_at(lua_State *L, int index, size_t first) {
  float values[4];
  for (size_t k = 0; k < 4; k++) {
    lua_rawgeti(L, index, (lua_Integer)(first + k + 1));
    values[k] = (float)luaL_checknumber(L, -1);
    lua_pop(L, 1);
  }
  return (celspan_light){values[0], values[1], values[2], values[3]};
}

/* The lights of the list at index 2, in scratch memory on the stack. *is_opaque: a matte of 1 lies
 * behind everything. */
static const celspan_stack_light *read_lights(lua_State *L, size_t count, bool *is_opaque) {
  celspan_stack_light *lights = cs_form_scratch(L, count, sizeof *lights);
  luaL_checktype(L, 2, LUA_TTABLE);
  *is_opaque = false;
  for (size_t i = 0; i < count; i++) {
    lights[i] = (celspan_stack_light){light_at(L, 2, NUMBERS * i), light_at(L, 2, NUMBERS * i + 4)};
    *is_opaque = *is_opaque || lights[i].back.a == 1;
  }
  return lights;
}

int cs_stack_light(lua_State *L) {
  const holder *held = holder_at(L, 1);
  celspan_context *context = cs_host_context(L);
  int32_t width, height;
  bool is_opaque;
  const celspan_stack_light *lights =
      read_lights(L, celspan_stack_light_count(held->stack), &is_opaque);
  celspan_stack_size(held->stack, &width, &height);
  float *pixels = cs_pixels_push(L, width, height, held->x, held->y, is_opaque);
  if (!pixels)
    return luaL_error(L, "stack: %d x %d pixels cannot be held in memory", width, height);
  celspan_status status = celspan_stack_pixels(context, held->stack, lights, 0, pixels);
  return status == CELSPAN_OK ? 1 : cs_host_fail(L, status);
}
