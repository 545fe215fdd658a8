/* Paints: the Beta colour model in Lua. */
#include "bind/construct.h"
#include "bind/form.h"
#include "bind/host.h"
#include "bind/openers.h"
#include "bind/userdata.h"

static void unref_paint(void *handle) { celspan_texture_unref(handle); }

const cs_kind cs_kind_paint = {.name = "celspan.paint", .unref = unref_paint};

/* Each paint gets a texture of that paint at once, so that the core checks it here and objects can
 * share it. */
static void fill(lua_State *L, const char *noun, cs_userdata *value, celspan_paint paint) {
  celspan_texture *texture = NULL;
  cs_host_try(L, noun, celspan_texture_create_paint(cs_host_context(L), &paint, &texture));
  value->handle = texture;
  value->paint = paint;
}

static celspan_paint from_doubles(const double pigment[3], const double medium[3], double beta) {
  celspan_paint paint = {.beta = (float)beta};
  for (int i = 0; i < 3; i++) {
    paint.pigment[i] = (float)pigment[i];
    paint.medium[i] = (float)medium[i];
  }
  return paint;
}

static void create_paint(const cs_form *form, cs_userdata *value) {
  double pigment[3] = {0, 0, 0}, medium[3] = {1, 1, 1};
  cs_form_numbers(form, "pigment", 3, pigment);
  cs_form_numbers(form, "medium", 3, medium);
  double beta = cs_form_number_or(form, "beta", 1);
  fill(form->L, form->noun->name, value, from_doubles(pigment, medium, beta));
}

static void set_triple(lua_State *L, const char *name, const double triple[3]) {
  lua_createtable(L, 3, 0);
  for (int i = 0; i < 3; i++) {
    lua_pushnumber(L, triple[i]);
    lua_rawseti(L, -2, i + 1);
  }
  lua_setfield(L, -2, name);
}

/* Adds what was left out, so that it can be read. */
static void complete_paint(lua_State *L, int fields) {
  if (lua_getfield(L, fields, "pigment") == LUA_TNIL) {
    lua_settop(L, fields);
    set_triple(L, "pigment", (const double[]){0, 0, 0});
  }
  lua_settop(L, fields);
  if (lua_getfield(L, fields, "medium") == LUA_TNIL) {
    lua_settop(L, fields);
    set_triple(L, "medium", (const double[]){1, 1, 1});
  }
  lua_settop(L, fields);
}

static const cs_field paint_fields[] = {{"pigment", NULL}, {"medium", NULL}, {"beta", "1"}, {0}};
const cs_noun cs_noun_paint = {.name = "paint",
                               .kind = &cs_kind_paint,
                               .fields = paint_fields,
                               .create = create_paint,
                               .complete = complete_paint};

static int push_paint(lua_State *L, const char *noun, const double pigment[3],
                      const double medium[3], double beta) {
  cs_userdata *value = cs_userdata_push(L, &cs_noun_paint);
  fill(L, noun, value, from_doubles(pigment, medium, beta));
  lua_createtable(L, 0, 3);
  set_triple(L, "pigment", pigment);
  set_triple(L, "medium", medium);
  lua_pushnumber(L, beta);
  lua_setfield(L, -2, "beta");
  lua_setiuservalue(L, -2, 1);
  return 1;
}

static void read_rgb(lua_State *L, const char *function, double rgb[3]) {
  static const char *const names[] = {"red", "green", "blue"};
  for (int i = 0; i < 3; i++)
    rgb[i] = cs_form_argument(L, i + 1, function, names[i]);
}

static int make_rgb(lua_State *L) {
  double pigment[3];
  read_rgb(L, "rgb", pigment);
  double alpha = lua_isnoneornil(L, 4) ? 1 : cs_form_argument(L, 4, "rgb", "alpha");
  return push_paint(L, "rgb", pigment, (const double[]){1, 1, 1}, alpha);
}

static int make_gel(lua_State *L) {
  double medium[3];
  read_rgb(L, "gel", medium);
  return push_paint(L, "gel", (const double[]){0, 0, 0}, medium, 0);
}

static celspan_paint mix_argument(lua_State *L, int index) {
  celspan_paint paint;
  if (lua_type(L, index) == LUA_TSTRING && celspan_paint_parse(lua_tostring(L, index), &paint))
    return paint;
  const cs_userdata *value = cs_userdata_test(L, index, &cs_kind_paint);
  if (!value)
    luaL_error(L, "mix: argument %d must be a paint or a colour like \"#rrggbb\", got %s", index,
               lua_isstring(L, index) ? lua_tostring(L, index) : cs_userdata_type(L, index));
  return value->paint;
}

static int mix(lua_State *L) {
  celspan_paint p = mix_argument(L, 1), q = mix_argument(L, 2);
  double u = cs_form_argument(L, 3, "mix", "the share of the second paint");
  if (!(u >= 0 && u <= 1))
    return luaL_error(L, "mix: the share of the second paint must be 0..1, got %s",
                      cs_form_digits(L, u));
  celspan_paint paint = celspan_paint_mix(p, q, (float)u);
  double pigment[3], medium[3];
  for (int i = 0; i < 3; i++) {
    pigment[i] = paint.pigment[i];
    medium[i] = paint.medium[i];
  }
  return push_paint(L, "mix", pigment, medium, paint.beta);
}

void cs_open_paint(lua_State *L) {
  static const luaL_Reg methods[] = {{"with", cs_construct_with}, {NULL, NULL}};
  static const luaL_Reg functions[] = {
      {"rgb", make_rgb}, {"gel", make_gel}, {"mix", mix}, {NULL, NULL}};
  cs_userdata_register(L, &cs_kind_paint, methods);
  luaL_setfuncs(L, functions, 0);
  cs_construct_push(L, &cs_noun_paint);
  lua_setfield(L, -2, "paint");
  push_paint(L, "clear", (const double[]){0, 0, 0}, (const double[]){1, 1, 1}, 0);
  lua_setfield(L, -2, "clear");
}
