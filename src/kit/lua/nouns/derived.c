/* Objects that are made of another one by a method and keep no fields: object:paint(texture), a
 * rectangle with the texture inside the shape; object:warp{...}, the object bent by a map; and
 * object:boil{...}, the same by a random one. */
#include <math.h>

#include "inside/context.h"
#include "inside/elementary.h"
#include "inside/number.h"
#include "inside/scene.h"
#include "lua/bind/bare.h"
#include "lua/bind/caller.h"
#include "lua/bind/form.h"
#include "lua/bind/host.h"
#include "lua/bind/lua_error.h"
#include "lua/nouns/nouns.h"

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
  const cs_form form = {.L = L, .noun = &argument, .table = 2};
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

/* Bends the object at index 1 as desc says, for a method. Errors of the map: m->outcome. */
static int bend(lua_State *L, const char *method, celspan_warp_desc *desc, const mapping *m) {
  const cs_userdata *object = cs_userdata_self(L, &cs_kind_object, method);
  celspan_object *bent = NULL;
  luaL_checkstack(L, 20, method);
  cs_userdata *value = cs_bare_push(L, &noun_warped);
  celspan_status status = celspan_object_warp(cs_host_context(L), object->handle, desc, &bent);
  if (m->outcome != LUA_OK)
    return lua_error(L);
  cs_host_try(L, method, status);
  value->handle = bent;
  return 1;
}

/* A description with the numbers `within` and `pieces` at these places. */
static celspan_warp_desc read_desc(lua_State *L, int within, celspan_warp_map map, void *user) {
  celspan_warp_desc desc = CELSPAN_WARP_DESC;
  desc.map = map;
  desc.user = user;
  desc.within = luaL_checknumber(L, within);
  desc.pieces = (size_t)fmin(fmax(luaL_optnumber(L, within + 1, (double)desc.pieces), 0), 1e9);
  return desc;
}

int cs_derived_warp(lua_State *L) {
  mapping m = {.L = L, .function = 2, .outcome = LUA_OK};
  celspan_warp_desc desc = read_desc(L, 3, map_point, &m);
  lua_settop(L, 2);
  return bend(L, "warp", &desc, &m);
}

/* ---------------------------------------------------------------- boil */

enum {
  STEPS_A_POINT = 16, /* steps of the sandbox */
  POINTS_A_CHARGE = 4096
};

/* A grid whose points are moved at random, and between them smoothly: motion.noise of Lua at whole
 * numbers, to the bit. */
typedef struct boiling {
  mapping mapping;       /* its outcome is the one of counting steps */
  uint64_t across, down; /* seeds */
  uint64_t step;
  double amount, grain; /* units */
  /* The square of the grid in which the last point was, and how far its corners are moved along x
   * and along y: most points lie in the square of the point before. */
  double i, j, corners[2][4];
  uint64_t points;
} boiling;

/* The whole number of a coordinate. Beyond 2^53 it has no fraction. */
static uint64_t whole_of(double at) {
  if (!isfinite(at))
    at = 0;
  return (uint64_t)(int64_t)(fabs(at) >= 0x1p53 ? fmod(at, 0x1p53) : at);
}

/* -1..1 for a point of the grid. */
static double grid_value(uint64_t seed, double x, double y, uint64_t step) {
  uint64_t state = seed ^ whole_of(x) * UINT64_C(0x2545f4914f6cdd1d) ^
                   whole_of(y) * UINT64_C(0x27d4eb2f165667c5) ^ step;
  return (double)(cs_splitmix_next(&state) >> 11) * 0x1p-52 - 1;
}

static void enter_square(boiling *b, double i, double j) {
  const uint64_t seeds[2] = {b->across, b->down};
  b->i = i;
  b->j = j;
  for (int axis = 0; axis < 2; axis++)
    for (int k = 0; k < 4; k++)
      b->corners[axis][k] = b->amount * grid_value(seeds[axis], i + k % 2, j + k / 2, b->step);
}

/* Where a coordinate is moved to, in a square of which (u, v) is the share before the place. The
 * order of the sums decides the last bit. */
static double moved(const double corners[4], double at, double u, double v) {
  double near = corners[0] + (corners[1] - corners[0]) * u;
  return at + near + (corners[2] + (corners[3] - corners[2]) * u - near) * v;
}

static double eased(double t) { return t * t * t * (t * (6 * t - 15) + 10); }

static int charge_points(lua_State *L) {
  cs_host_charge(L, (uint64_t)STEPS_A_POINT * POINTS_A_CHARGE);
  return 0;
}

static celspan_status boil_point(void *user, celspan_context *context, celspan_point from,
                                 celspan_point *to) {
  boiling *b = user;
  double i = floor(from.x / b->grain), j = floor(from.y / b->grain);
  double u = eased(from.x / b->grain - i), v = eased(from.y / b->grain - j);
  if (i != b->i || j != b->j)
    enter_square(b, i, j);
  to->x = moved(b->corners[0], from.x, u, v);
  to->y = moved(b->corners[1], from.y, u, v);
  if (++b->points % POINTS_A_CHARGE > 0)
    return CELSPAN_OK;
  lua_State *L = b->mapping.L;
  lua_pushcfunction(L, charge_points);
  b->mapping.outcome = cs_lua_error_settle(L, lua_pcall(L, 0, 0, 0), 0);
  return b->mapping.outcome == LUA_OK
             ? CELSPAN_OK
             : celspan_context_fail(context, CELSPAN_CALLBACK, "boil: a limit was reached");
}

int cs_derived_boil(lua_State *L) {
  boiling b = {.mapping = {.L = L, .outcome = LUA_OK},
               .across = (uint64_t)luaL_checkinteger(L, 2),
               .down = (uint64_t)luaL_checkinteger(L, 3),
               .step = whole_of(luaL_checknumber(L, 4)),
               .amount = luaL_checknumber(L, 5),
               .grain = luaL_checknumber(L, 6),
               .i = NAN};
  celspan_warp_desc desc = read_desc(L, 7, boil_point, &b);
  lua_settop(L, 1);
  bend(L, "boil", &desc, &b.mapping);
  cs_host_charge(L, STEPS_A_POINT * (b.points % POINTS_A_CHARGE));
  return 1;
}
