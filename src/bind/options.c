#include "bind/options.h"

#include <limits.h>
#include <math.h>
#include <string.h>

#include "bind/caller.h"
#include "bind/numbers.h"
#include "bind/userdata.h"
#include "scene/antialias.h"

/* ---------------------------------------------------------------- antialiasing */

static const cs_field kernel_fields[] = {{"kernel", NULL}, {"radius", NULL}, {"rows", NULL}, {0}};
static const cs_noun noun_kernel = {.name = "antialias", .fields = kernel_fields};

/* A kernel given as a function: its values at the points where the core samples it. */
typedef struct kernel_values {
  double radius;
  double values[CS_ANTIALIAS_SAMPLES];
} kernel_values;

static celspan_status kernel_value(void *user, celspan_context *context, double x, double *out) {
  const kernel_values *kernel = user;
  (void)context;
  *out = kernel->values[(int)((x / kernel->radius + 1) * (CS_ANTIALIAS_SAMPLES / 2))];
  return CELSPAN_OK;
}

/* Samples the function on top of the stack, which is replaced by the values. It is not called for a
 * radius that the core will refuse. */
static void sample_function(const cs_form *form, celspan_filter_desc *filter) {
  lua_State *L = form->L;
  int function = lua_gettop(L);
  kernel_values *kernel = cs_form_scratch(L, 1, sizeof *kernel);
  kernel->radius = filter->radius;
  for (int i = 0; filter->radius > 0 && filter->radius < HUGE_VAL && i < CS_ANTIALIAS_SAMPLES;
       i++) {
    double x = ((2 * i + 1.0) / CS_ANTIALIAS_SAMPLES - 1) * filter->radius;
    lua_pushvalue(L, function);
    lua_pushnumber(L, x);
    lua_call(L, 1, 1);
    if (lua_type(L, -1) != LUA_TNUMBER)
      cs_form_fail(form, "the kernel function must return a number, got %s at x = %f",
                   cs_userdata_type(L, -1), x);
    kernel->values[i] = lua_tonumber(L, -1);
    lua_pop(L, 1);
  }
  filter->kernel = CELSPAN_KERNEL_FUNCTION;
  filter->function = kernel_value;
  filter->function_user = kernel;
  lua_replace(L, function);
}

static void read_kernel(const cs_form *form, celspan_filter_desc *filter) {
  static const char *const kernels[] = {"box", "gaussian", "mitchell", "lanczos", NULL};
  *filter = (celspan_filter_desc){.has_radius = cs_form_has(form, "radius")};
  if (filter->has_radius)
    filter->radius = cs_form_number(form, "radius");
  filter->rows = cs_form_integer_or(form, "rows", 0);
  if (filter->rows == 0 && cs_form_has(form, "rows"))
    cs_form_fail(form, "rows is 0; it must be between 1 and 256");
  lua_pushliteral(form->L, "kernel");
  if (lua_rawget(form->L, form->table) == LUA_TFUNCTION) {
    sample_function(form, filter);
    return;
  }
  cs_form_text(form, "kernel");
  filter->kernel = (celspan_kernel)cs_form_choice(form, "kernel", kernels);
  lua_pop(form->L, 2);
}

bool cs_options_antialias(const cs_form *form, celspan_antialias_mode *mode,
                          celspan_filter_desc *filter) {
  static const char *const modes[] = {"area", "none", NULL};
  lua_State *L = form->L;
  lua_pushliteral(L, "antialias");
  int type = lua_rawget(L, form->table);
  if (type == LUA_TTABLE) {
    cs_form inner = cs_form_open(L, &noun_kernel, -1);
    read_kernel(&inner, filter);
    *mode = CELSPAN_ANTIALIAS_FILTER;
    return true;
  }
  if (type != LUA_TNIL && type != LUA_TSTRING)
    cs_form_fail(form, "field 'antialias' must be \"area\", \"none\" or {kernel =, ...}, got %s",
                 cs_userdata_type(L, -1));
  lua_pop(L, 1);
  if (type != LUA_TNIL)
    *mode = (celspan_antialias_mode)cs_form_choice(form, "antialias", modes);
  return type != LUA_TNIL;
}

/* ---------------------------------------------------------------- coding */

static celspan_depth read_depth(const cs_form *form) {
  static const char *const words[] = {"default", "8", "16", "half", "float"};
  lua_State *L = form->L;
  lua_pushliteral(L, "depth");
  int type = lua_rawget(L, form->table), depth = 0;
  const char *given = type == LUA_TNUMBER   ? cs_form_digits(L, lua_tonumber(L, -1)) /* 8 is "8" */
                      : type == LUA_TSTRING ? lua_tostring(L, -1)
                                            : cs_userdata_type(L, -1);
  while (depth < 5 && strcmp(words[depth], given) != 0)
    depth++;
  if (type != LUA_TNIL && depth == 5)
    cs_form_fail(form, "field 'depth' must be 8, 16, \"half\" or \"float\", got %s",
                 type == LUA_TSTRING ? cs_userdata_shown(L, -1) : given);
  return type == LUA_TNIL ? CELSPAN_DEPTH_DEFAULT : (celspan_depth)depth;
}

static void read_dither(const cs_form *form, celspan_coding *out) {
  lua_pushliteral(form->L, "dither");
  int type = lua_rawget(form->L, form->table);
  if (type != LUA_TNIL && type != LUA_TBOOLEAN)
    cs_form_fail(form, "field 'dither' must be true or false, got %s",
                 cs_userdata_type(form->L, -1));
  bool dithers = lua_toboolean(form->L, -1);
  lua_pop(form->L, 1);
  if (dithers && out->depth != CELSPAN_DEPTH_DEFAULT && out->depth != CELSPAN_DEPTH_8)
    cs_form_fail(form, "field 'dither' makes 8 bits; leave 'depth' out or give 8");
  if (dithers)
    out->depth = CELSPAN_DEPTH_8_DITHER;
}

void cs_options_coding(const cs_form *form, celspan_coding *out) {
  static const char *const colours[] = {"default", "linear", "srgb", "rec709", "cineon", NULL};
  static const char *const alphas[] = {"default", "straight", "premultiplied", NULL};
  out->depth = read_depth(form);
  out->transfer = (celspan_transfer)cs_form_choice(form, "colour", colours);
  out->alpha = (celspan_alpha)cs_form_choice(form, "alpha", alphas);
  read_dither(form, out);
}

/* ---------------------------------------------------------------- frames */

static void read_integers(const cs_form *form, const char *name, int count, int32_t *out) {
  double numbers[4];
  if (!cs_form_numbers(form, name, count, numbers))
    return;
  for (int i = 0; i < count; i++) {
    if (!(numbers[i] >= INT_MIN && numbers[i] <= INT_MAX) || numbers[i] != (int)numbers[i])
      cs_form_fail(form, "field '%s' must hold whole numbers of pixels, got %s", name,
                   cs_form_digits(form->L, numbers[i]));
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
  if (desc->workers < 0)
    cs_form_fail(form, "field 'workers' must be 0 or more, got %d", desc->workers);
  desc->tolerance = cs_form_number_or(form, "tolerance", 0);
  if (desc->tolerance != 0 && !(desc->tolerance >= 0x1p-20 && desc->tolerance <= 1))
    cs_form_fail(form, "field 'tolerance' must be from 2^-20 to 1, got %s",
                 cs_form_digits(form->L, desc->tolerance));
  if (cs_options_antialias(form, &out->antialias, &desc->filter))
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
    cs_caller_error(L, "%s: exposure %d must be {rostrum, weight}, got %s", name, i,
                    cs_userdata_type(L, -1));
  lua_rawgeti(L, -1, 1);
  const cs_userdata *rostrum = cs_userdata_test(L, -1, &cs_kind_rostrum);
  if (!rostrum)
    cs_caller_error(L, "%s: exposure %d: its first value must be a rostrum, got %s", name, i,
                    cs_userdata_type(L, -1));
  double weight = 1;
  const char *subject = lua_pushfstring(L, "exposure %d: its weight", i);
  if (lua_rawgeti(L, -3, 2) != LUA_TNIL)
    weight = cs_numbers_check(L, -1, name, subject);
  lua_pop(L, 2);
  lua_rawseti(L, anchors, i);
  lua_pop(L, 1);
  return (celspan_exposure){rostrum->handle, weight};
}

void cs_options_exposures(lua_State *L, int index, const char *name, celspan_frame_desc *desc) {
  index = lua_absindex(L, index);
  const cs_userdata *rostrum = cs_userdata_test(L, index, &cs_kind_rostrum);
  if (!rostrum && (!lua_istable(L, index) || lua_rawlen(L, index) > 100000))
    cs_caller_error(L, "%s must be a rostrum or a list {{rostrum, weight}, ...}, got %s", name,
                    lua_istable(L, index) ? "a list that is too long" : cs_userdata_type(L, index));
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
