#include "bind/options.h"

#include <limits.h>
#include <string.h>

#include "bind/value.h"

/* ---------------------------------------------------------------- antialiasing */

static const cs_field kernel_fields[] = {{"kernel", NULL}, {"radius", NULL}, {"rows", NULL}, {0}};
static const cs_noun noun_kernel = {.name = "antialias", .fields = kernel_fields};

static void check_kernel(const cs_form *form) {
  static const char *const kernels[] = {"box", "gaussian", "mitchell", "lanczos", NULL};
  lua_pushliteral(form->L, "kernel");
  if (lua_rawget(form->L, form->table) != LUA_TFUNCTION) {
    cs_form_text(form, "kernel");
    cs_form_choice(form, "kernel", kernels);
  }
  cs_form_number_or(form, "radius", 0);
  cs_form_integer_or(form, "rows", 16);
}

bool cs_options_antialias(const cs_form *form, celspan_antialias_mode *out) {
  static const char *const modes[] = {"area", "none", NULL};
  lua_State *L = form->L;
  lua_pushliteral(L, "antialias");
  int type = lua_rawget(L, form->table);
  if (type == LUA_TTABLE) {
    cs_form inner = cs_form_open(L, &noun_kernel, -1);
    check_kernel(&inner);
    cs_form_fail(form, "antialias: kernel filters are not built into this version; "
                       "use \"area\" or \"none\"");
  }
  if (type != LUA_TNIL && type != LUA_TSTRING)
    cs_form_fail(form, "field 'antialias' must be \"area\" or \"none\", got %s",
                 cs_value_type(L, -1));
  lua_pop(L, 1);
  if (type != LUA_TNIL)
    *out = (celspan_antialias_mode)cs_form_choice(form, "antialias", modes);
  return type != LUA_TNIL;
}

/* ---------------------------------------------------------------- frames */

static void read_integers(const cs_form *form, const char *name, int count, int32_t *out) {
  double numbers[4];
  if (!cs_form_numbers(form, name, count, numbers))
    return;
  for (int i = 0; i < count; i++) {
    if (!(numbers[i] >= INT_MIN && numbers[i] <= INT_MAX) || numbers[i] != (int)numbers[i])
      cs_form_fail(form, "field '%s' must hold whole numbers of pixels, got %f", name, numbers[i]);
    out[i] = (int32_t)numbers[i];
  }
}

void cs_options_read(const cs_form *form, cs_options_frame *out) {
  celspan_frame_desc *desc = &out->desc;
  *desc = CELSPAN_FRAME_DESC;
  double film[2] = {0, 0};
  int32_t size[2] = {1920, 1080}, crop[4] = {0, 0, 0, 0};
  cs_form_numbers(form, "film", 2, film);
  read_integers(form, "size", 2, size);
  read_integers(form, "crop", 4, crop);
  desc->film_width = film[0];
  desc->film_height = film[1];
  desc->width = size[0];
  desc->height = size[1];
  desc->crop_x = crop[0];
  desc->crop_y = crop[1];
  desc->crop_width = crop[2];
  desc->crop_height = crop[3];
  desc->workers = cs_form_integer_or(form, "workers", 0);
  if (cs_options_antialias(form, &out->antialias))
    desc->antialias = &out->antialias;
}

cs_form cs_options_open(lua_State *L, const cs_noun *noun, int index) {
  if (lua_isnoneornil(L, index)) {
    lua_newtable(L);
    index = lua_gettop(L);
  }
  return cs_form_open(L, noun, index);
}

/* ---------------------------------------------------------------- exposures */

/* Exposure i of a list; its rostrum is put into the table `anchors`, because callbacks may change
 * the list while it is rendered. */
static celspan_exposure read_exposure(lua_State *L, int list, int anchors, int i,
                                      const char *name) {
  if (lua_rawgeti(L, list, i) != LUA_TTABLE)
    luaL_error(L, "%s: exposure %d must be {rostrum, weight}, got %s", name, i,
               cs_value_type(L, -1));
  lua_rawgeti(L, -1, 1);
  const cs_value *rostrum = cs_value_test(L, -1, &cs_kind_rostrum);
  if (!rostrum)
    luaL_error(L, "%s: exposure %d: its first value must be a rostrum, got %s", name, i,
               cs_value_type(L, -1));
  int type = lua_rawgeti(L, -2, 2);
  if (type != LUA_TNUMBER && type != LUA_TNIL)
    luaL_error(L, "%s: exposure %d: its weight must be a number, got %s", name, i,
               cs_value_type(L, -1));
  double weight = type == LUA_TNIL ? 1 : lua_tonumber(L, -1);
  lua_pop(L, 1);
  lua_rawseti(L, anchors, i);
  lua_pop(L, 1);
  return (celspan_exposure){rostrum->handle, weight};
}

void cs_options_exposures(lua_State *L, int index, const char *name, celspan_frame_desc *desc) {
  index = lua_absindex(L, index);
  const cs_value *rostrum = cs_value_test(L, index, &cs_kind_rostrum);
  if (!rostrum && (!lua_istable(L, index) || lua_rawlen(L, index) > 100000))
    luaL_error(L, "%s must be a rostrum or a list {{rostrum, weight}, ...}, got %s", name,
               lua_istable(L, index) ? "a list that is too long" : cs_value_type(L, index));
  size_t count = rostrum ? 1 : lua_rawlen(L, index);
  celspan_exposure *exposures = cs_form_scratch(L, count, sizeof *exposures);
  lua_newtable(L);
  int anchors = lua_gettop(L);
  if (rostrum)
    exposures[0] = (celspan_exposure){rostrum->handle, 1};
  else
    for (size_t i = 0; i < count; i++)
      exposures[i] = read_exposure(L, index, anchors, (int)i + 1, name);
  desc->exposures = exposures;
  desc->exposure_count = count;
}
