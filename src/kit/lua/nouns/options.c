#include "lua/nouns/options.h"

#include <math.h>
#include <string.h>

#include "inside/scene.h"
#include "lua/bind/userdata.h"

/* ---------------------------------------------------------------- antialiasing */

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

/* Samples the function on top of the stack, and replaces it by the values. The function is not
 * called for a radius that the core will refuse. */
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

static const char *const kernels[] = {"box", "gaussian", "mitchell", "lanczos", NULL};
#define DESC celspan_filter_desc
static const cs_field kernel_fields[] = {
    {"kernel", CS_OWN("\"box\"|\"gaussian\"|\"mitchell\"|\"lanczos\"|fun(x: number): number"),
     .is_required = true, .about = "x: pixels from the centre"},
    {"radius", CS_NUMBER(DESC, radius), CS_HAS(DESC, has_radius), .least = 0, .most = 256,
     .about = "Pixels; a function needs one", .fallback = "by the kernel"},
    {"rows", CS_WHOLE(DESC, rows), .least = 1, .most = 256,
     .about = "Pieces of the height of a pixel", .fallback = "16"},
    {0}};
const cs_noun cs_noun_filter = {
    .name = "antialias",
    .about = "A separable antialiasing filter, normalised, cut off at its radius.",
    .table = "celspan.filter",
    .fields = kernel_fields};

/* { kernel =, radius =, rows = } on top of the stack; pushed values are left there. */
static const celspan_filter_desc *read_kernel(const cs_form *outer) {
  lua_State *L = outer->L;
  int table = lua_gettop(L);
  cs_noun named = cs_noun_filter;
  named.name = lua_pushfstring(L, "%s: antialias", outer->noun->name);
  cs_form form = cs_form_open(L, &named, table);
  celspan_filter_desc *filter = cs_form_scratch(L, 1, sizeof *filter);
  *filter = CELSPAN_FILTER_DESC;
  cs_fields_read(&form, filter);
  if (cs_form_get(&form, "kernel") == LUA_TFUNCTION)
    sample_function(&form, filter);
  else
    filter->kernel = (celspan_kernel)cs_fields_word(&form, "kernel", kernels);
  return filter;
}

bool cs_options_antialias(const cs_form *form, celspan_antialias_mode *mode,
                          const celspan_filter_desc **filter) {
  static const char *const modes[] = {"area", "none", NULL};
  int type = cs_form_get(form, "antialias");
  if (type == LUA_TTABLE) {
    *filter = read_kernel(form);
    *mode = CELSPAN_ANTIALIAS_FILTER;
    return true;
  }
  if (type != LUA_TNIL && type != LUA_TSTRING)
    cs_form_fail(form, "field 'antialias' must be \"area\", \"none\" or {kernel =, ...}, got %s",
                 cs_userdata_type(form->L, -1));
  if (type != LUA_TNIL)
    *mode = (celspan_antialias_mode)cs_fields_word(form, "antialias", modes);
  lua_pop(form->L, 1);
  return type != LUA_TNIL;
}

/* ---------------------------------------------------------------- coding */

static celspan_depth read_depth(const cs_form *form) {
  static const char *const words[] = {"default", "8", "16", "half", "float"};
  lua_State *L = form->L;
  int type = cs_form_get(form, "depth"), depth = 0;
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

static void check_dither(const cs_form *form, cs_options *out) {
  celspan_depth depth = out->coding.depth;
  if (out->dithers && depth != CELSPAN_DEPTH_DEFAULT && depth != CELSPAN_DEPTH_8)
    cs_form_fail(form, "field 'dither' makes 8 bits; leave 'depth' out or give 8");
  if (out->dithers)
    out->coding.depth = CELSPAN_DEPTH_8_DITHER;
}

/* ---------------------------------------------------------------- reading */

static const char *const colours[] = {"default", "linear", "srgb", "rec709", "cineon", NULL};
static const char *const alphas[] = {"default", "straight", "premultiplied", NULL};

#define CODING                                                                                     \
  {"depth", CS_OWN("8|16|\"half\"|\"float\""), .about = "Bits, or floats"},                        \
      {"colour", CS_CHOICE(cs_options, coding.transfer, colours)},                                 \
      {"alpha", CS_CHOICE(cs_options, coding.alpha, alphas)}, {                                    \
    "dither", CS_FLAG(cs_options, dithers), .about = "8 bits without bands"                        \
  }
#define FORMAT                                                                                     \
  { "format", CS_TEXT(cs_options, format), .fallback = "by the ending of the file" }

#define FRAME                                                                                      \
  {                                                                                                \
    "frame", CS_WHOLE(cs_options, frame), CS_HAS(cs_options, has_frame), .about = "Of a film",     \
                                                                         .fallback = "its first"   \
  }
#define FILM "film", CS_SIZE(cs_options, film), CS_HAS(cs_options, has_film)

static const cs_field coding_fields[] = {CODING, {0}};
static const cs_field file_fields[] = {FORMAT, CODING, {0}};
static const cs_field frame_fields[] = {
    {"size", CS_PIXELS(cs_options, size), CS_HAS(cs_options, has_size), .shape = "a size {w, h}",
     .about = "In pixels", .fallback = "{1920, 1080}"},
    {FILM, .about = "In film units", .fallback = "the size"},
    {"crop", CS_PIXELS(cs_options, crop), .shape = "a box {x, y, w, h}", .about = "In pixels"},
    {"workers", CS_WHOLE(cs_options, desc.workers), CS_FROM(0), .about = "Threads",
     .fallback = "0: one for each processor"},
    {"antialias", CS_OWN("celspan.antialias"), .about = "Instead of that of each rostrum"},
    {"tolerance", CS_NUMBER(cs_options, desc.tolerance), CS_HAS(cs_options, desc.has_tolerance),
     .about = "How far gradient spans may be from the exact colours, 2^-20 to 1",
     .fallback = "1/1023"},
    {0}};
static const cs_field render_fields[] = {
    {"frames", CS_OWN("string|integer"), .about = "\"1-10,20-30:2,45\", \"2s-4s\" or a mark",
     .fallback = "all"},
    {"progress", CS_OWN("fun(share: number, frame: integer): boolean?"),
     .about = "The share of the whole job that is done; false stops"},
    FORMAT,
    CODING,
    {.more = frame_fields}};
static const cs_field pixels_fields[] = {FRAME, {.more = frame_fields}};
static const cs_field spans_fields[] = {
    {"rows", CS_NUMBERS(cs_options, rows), CS_HAS(cs_options, has_rows),
     .shape = "rows {first, last}", .written = "integer[]", .about = "Inclusive, from 0"},
    FRAME,
    {.more = frame_fields}};
static const cs_field probe_fields[] = {
    {FILM, .about = "In film units", .fallback = "that of the film, else {1920, 1080}"},
    FRAME,
    {0}};

static const cs_field plane_fields[] = {{"depth", CS_OWN("8|16"),
                                         .about = "Bits of colours: 8, a smaller file, or 16",
                                         .fallback = "16"},
                                        {.more = probe_fields}};

static const cs_field view_fields[] = {
    {"size", CS_PIXELS(cs_options, size), CS_HAS(cs_options, has_size), .shape = "a size {w, h}",
     .about = "In pixels", .fallback = "that of the plane, a pixel for each unit"},
    {"crop", CS_PIXELS(cs_options, crop), .shape = "a box {x, y, w, h}", .about = "In pixels"},
    {"antialias", CS_OWN("\"area\"|\"none\""), .fallback = "\"area\""},
    {0}};

#define OPTIONS(noun, rows)                                                                        \
  const cs_noun cs_noun_##noun = {                                                                 \
      .name = #noun, .table = "celspan." #noun ".options", .fields = rows};
OPTIONS(render, render_fields)
OPTIONS(pixels, pixels_fields)
const cs_noun cs_noun_stack = {.name = "stack", .fields = pixels_fields};
OPTIONS(bytes, coding_fields)
OPTIONS(write, file_fields)
OPTIONS(spans, spans_fields)
OPTIONS(probe, probe_fields)
OPTIONS(plane, plane_fields)
const cs_noun cs_noun_plane_view = {
    .name = "plane view", .table = "celspan.plane.view", .fields = view_fields};

static void set_sizes(cs_options *out) {
  celspan_frame_desc *desc = &out->desc;
  desc->film_width = out->has_film ? out->film[0] : out->size[0];
  desc->film_height = out->has_film ? out->film[1] : out->size[1];
  desc->width = out->size[0];
  desc->height = out->size[1];
  desc->crop_x = out->crop[0];
  desc->crop_y = out->crop[1];
  desc->crop_width = out->crop[2];
  desc->crop_height = out->crop[3];
}

void cs_options_read(lua_State *L, const cs_noun *noun, int index, cs_options *out) {
  if (lua_isnoneornil(L, index)) {
    lua_newtable(L);
    index = lua_gettop(L);
  }
  const cs_form form = cs_form_open(L, noun, index);
  *out = (cs_options){
      .form = form, .desc = CELSPAN_FRAME_DESC, .coding = CELSPAN_CODING, .size = {1920, 1080}};
  cs_fields_read(&form, out);
  out->coding.depth = read_depth(&form);
  check_dither(&form, out);
  set_sizes(out);
  double tolerance = out->desc.tolerance;
  if (out->desc.has_tolerance && !(tolerance >= 0x1p-20 && tolerance <= 1))
    cs_form_fail(&form, "field 'tolerance' must be from 2^-20 to 1, got %s",
                 cs_form_digits(L, tolerance));
  out->desc.has_antialias = cs_options_antialias(&form, &out->desc.antialias, &out->desc.filter);
}

void cs_options_use_film(cs_options *options, const cs_film_info *film) {
  celspan_frame_desc *desc = &options->desc;
  if (!options->has_size) {
    desc->width = film->width;
    desc->height = film->height;
  }
  if (!options->has_film) {
    desc->film_width = film->width;
    desc->film_height = film->height;
  }
}
