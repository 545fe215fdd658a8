/* Textures: gradients, noise, pictures and patterns. */
#include "lua/nouns/texture.h"

#include <limits.h>
#include <math.h>
#include <string.h>

#include "inside/films.h"
#include "lua/bind/fields.h"
#include "lua/bind/files.h"
#include "lua/bind/host.h"
#include "lua/bind/numbers.h"
#include "lua/bind/require.h"
#include "lua/nouns/nouns.h"
#include "readers/layered/dzi.h"

static void create_gradient(const cs_form *form, cs_userdata *value) {
  int count = cs_form_length(form);
  if (count != 3)
    cs_form_fail(form, "takes three corners {x, y, paint}, got %d", count);
  celspan_point points[3];
  celspan_paint paints[3];
  for (int i = 0; i < 3; i++) {
    cs_form_item(form, i + 1, LUA_TTABLE, "corner", "{x, y, paint}");
    points[i].x = cs_form_tuple_number(form, -1, 1, "corner", i + 1);
    points[i].y = cs_form_tuple_number(form, -1, 2, "corner", i + 1);
    paints[i] = cs_form_tuple_paint(form, -1, 3, "corner", i + 1);
  }
  celspan_texture *texture = NULL;
  cs_form_try(form,
              celspan_texture_create_gradient(cs_host_context(form->L), points, paints, &texture));
  value->handle = texture;
}

/* The colours of a list as stops at even distances. */
static void spread_colours(const cs_form *form, int list, size_t count, celspan_stop *stops) {
  for (size_t i = 0; i < count; i++)
    stops[i] = (celspan_stop){count > 1 ? (double)i / (double)(count - 1) : 0,
                              cs_form_tuple_paint(form, list, (int)i + 1, "colour", 0)};
}

/* The stops {at, paint} of the array part, or its colours: scratch memory, left on the stack. */
static celspan_stop *read_stops(const cs_form *form, int count) {
  celspan_stop *stops = cs_form_scratch(form->L, (size_t)count, sizeof *stops);
  const int type = lua_rawgeti(form->L, form->table, 1);
  const bool has_colours = type == LUA_TSTRING || type == LUA_TUSERDATA;
  lua_pop(form->L, 1);
  if (has_colours) {
    spread_colours(form, form->table, (size_t)count, stops);
    return stops;
  }
  for (int i = 0; i < count; i++) {
    cs_form_item(form, i + 1, LUA_TTABLE, "stop", "{at, paint}");
    stops[i].at = cs_form_tuple_number(form, -1, 1, "stop", i + 1);
    stops[i].paint = cs_form_tuple_paint(form, -1, 2, "stop", i + 1);
    lua_pop(form->L, 1);
  }
  return stops;
}

/* The fields of a gradient along a line or around a point, while they are read. */
typedef struct gradient {
  celspan_point from, to; /* or centre, focus */
  double radius;
  double angle; /* degrees */
  bool has_from, has_focus, has_radius, has_angle, has_matrix;
  celspan_matrix matrix;
  celspan_spread spread;
  celspan_stop *stops; /* scratch memory, left on the stack */
  size_t count;
} gradient;

static void read_gradient(const cs_form *form, gradient *out) {
  *out = (gradient){.spread = CELSPAN_SPREAD_HOLD};
  cs_fields_read(form, out);
  int count = cs_form_length(form);
  out->stops = read_stops(form, count);
  out->count = (size_t)count;
}

/* Gives the gradient its matrix and its spread. The value owns the texture already, so that the
 * texture is released if one of these is refused. */
static void set_extent(const cs_form *form, const gradient *given, celspan_texture *texture,
                       cs_userdata *value) {
  celspan_context *context = cs_host_context(form->L);
  value->handle = texture;
  if (given->has_matrix) {
    cs_form_try(form,
                celspan_texture_with_matrix(context, value->handle, &given->matrix, &texture));
    celspan_texture_unref(value->handle);
    value->handle = texture;
  }
  if (given->spread != CELSPAN_SPREAD_HOLD) {
    cs_form_try(form, celspan_texture_with_spread(context, value->handle, given->spread, &texture));
    celspan_texture_unref(value->handle);
    value->handle = texture;
  }
}

/* A gradient without points. */
static void create_fitted(const cs_form *form, const gradient *given, celspan_fitted_desc *desc,
                          cs_userdata *value) {
  celspan_texture *texture = NULL;
  desc->stops = given->stops;
  desc->stop_count = given->count;
  cs_form_try(form, celspan_texture_create_fitted(cs_host_context(form->L), desc, &texture));
  set_extent(form, given, texture, value);
}

/* By rows of three, without the middle. */
static const char *const sides[] = {"top left",    "top",    "top right",    "left", "right",
                                    "bottom left", "bottom", "bottom right", NULL};

/* The fields of a linear gradient without points: `to`, on top of the stack, or `angle`. */
static celspan_fitted_desc read_fit(const cs_form *form, const gradient *given) {
  celspan_fitted_desc desc = CELSPAN_FITTED_DESC;
  const bool has_side = !lua_isnil(form->L, -1);
  if (has_side && given->has_angle)
    cs_form_fail(form, "give 'to' or 'angle', not both");
  if (has_side) {
    int place = cs_fields_word(form, "to", sides);
    place += place >= 4;
    desc.to_x = place % 3 - 1;
    desc.to_y = place / 3 - 1;
  }
  desc.fit = given->has_angle ? CELSPAN_GRADIENT_ANGLE : CELSPAN_GRADIENT_SIDE;
  desc.degrees = given->angle;
  return desc;
}

static void read_point(const cs_form *form, const char *field, celspan_point *out) {
  const cs_numbers_name name = {
      .noun = form->noun->name, .field = field, .shape = "a point {x, y}"};
  double pair[2];
  cs_form_get(form, field);
  cs_numbers_read(form->L, -1, &name, 2, 2, pair);
  *out = (celspan_point){pair[0], pair[1]};
}

static void create_linear(const cs_form *form, cs_userdata *value) {
  gradient g;
  celspan_texture *texture = NULL;
  read_gradient(form, &g);
  if (cs_form_get(form, "to") != LUA_TTABLE && !g.has_from) {
    celspan_fitted_desc desc = read_fit(form, &g);
    create_fitted(form, &g, &desc, value);
    return;
  }
  read_point(form, "from", &g.from);
  read_point(form, "to", &g.to);
  if (g.has_angle)
    cs_form_fail(form, "give 'angle', or 'from' and 'to', not both");
  cs_form_try(form, celspan_texture_create_linear(cs_host_context(form->L), g.from, g.to, g.stops,
                                                  g.count, &texture));
  set_extent(form, &g, texture, value);
}

static void create_radial(const cs_form *form, cs_userdata *value) {
  gradient g;
  celspan_texture *texture = NULL;
  read_gradient(form, &g);
  if (!g.has_from && !g.has_radius && !g.has_focus) {
    celspan_fitted_desc desc = CELSPAN_FITTED_DESC;
    desc.fit = CELSPAN_GRADIENT_ELLIPSE;
    create_fitted(form, &g, &desc, value);
    return;
  }
  read_point(form, "centre", &g.from);
  if (!g.has_radius)
    cs_form_fail(form, "field 'radius' must be a number, got nil");
  cs_form_try(form, celspan_texture_create_focal(cs_host_context(form->L), g.from, g.radius,
                                                 g.has_focus ? g.to : g.from, g.stops, g.count,
                                                 &texture));
  set_extent(form, &g, texture, value);
}

#define RADIANS 0.017453292519943295 /* in a degree */

static void create_conic(const cs_form *form, cs_userdata *value) {
  gradient g;
  celspan_texture *texture = NULL;
  read_gradient(form, &g);
  cs_form_try(form, celspan_texture_create_conic(cs_host_context(form->L), g.from,
                                                 RADIANS * fmod(g.angle, 360), g.stops, g.count,
                                                 &texture));
  set_extent(form, &g, texture, value);
}

static const char *const spreads[] = {"hold", "repeat", "reflect", NULL};
static const cs_field no_fields[] = {{0}};
static const cs_field extent_fields[] = {
    {"spread", CS_CHOICE(gradient, spread, spreads), .about = "The values before 0 and after 1",
     .fallback = "\"hold\""},
    {"matrix", CS_NUMBERS(gradient, matrix), CS_HAS(gradient, has_matrix),
     .about = "Nine numbers: moves the gradient alone"},
    {0}};
static const cs_field linear_fields[] = {
    {"from", CS_POINT(gradient, from), CS_HAS(gradient, has_from), .about = "Where 0 lies",
     .fallback = "the side opposite `to`, of the bounds of what is painted"},
    {"to", CS_OWN("celspan.place"),
     .about = "Where 1 lies: a point, with `from`; or a side or a corner",
     .fallback = "\"bottom\""},
    {"angle", CS_NUMBER(gradient, angle), CS_HAS(gradient, has_angle),
     .about = "In place of `from` and `to`: where 1 lies, in degrees clockwise from up"},
    {.more = extent_fields}};
static const cs_field radial_fields[] = {
    {"centre", CS_POINT(gradient, from), CS_HAS(gradient, has_from),
     .fallback = "the middle of the bounds of what is painted, with an ellipse that touches them"},
    {"radius", CS_NUMBER(gradient, radius), CS_HAS(gradient, has_radius), CS_FROM(0),
     .about = "Of the circle where 1 lies, with `centre`"},
    {"focus", CS_POINT(gradient, to), CS_HAS(gradient, has_focus), .about = "Where 0 lies",
     .fallback = "the centre"},
    {.more = extent_fields}};

static const cs_field conic_fields[] = {{"centre", CS_POINT(gradient, from), .is_required = true},
                                        {"angle", CS_NUMBER(gradient, angle), .preset = "0",
                                         .about = "Where 0 lies, in degrees clockwise from up"},
                                        {"matrix", CS_NUMBERS(gradient, matrix),
                                         CS_HAS(gradient, has_matrix),
                                         .about = "Nine numbers: moves the gradient alone"},
                                        {0}};

/* ---------------------------------------------------------------- noise */

#define OCTAVES_MOST 16
#define COLOURS_MOST 64

typedef struct noise {
  celspan_noise_desc desc;
  bool has_octaves, has_gain, has_matrix;
  celspan_matrix matrix;
} noise;

/* The colours as stops at even distances: scratch memory, left on the stack. */
static void read_colours(const cs_form *form, celspan_noise_desc *out) {
  lua_State *L = form->L;
  int type = cs_form_get(form, "colours");
  if (type == LUA_TNIL)
    return;
  size_t count = type == LUA_TTABLE ? (size_t)lua_rawlen(L, -1) : 0;
  if (count < 2 || count > COLOURS_MOST)
    cs_form_fail(form, "field 'colours' must be a list of 2 to %d colours", COLOURS_MOST);
  int list = lua_gettop(L);
  celspan_stop *stops = cs_form_scratch(L, count, sizeof *stops);
  spread_colours(form, list, count, stops);
  out->stops = stops;
  out->stop_count = count;
}

static void create_noise(const cs_form *form, cs_userdata *value) {
  noise n = {.desc = CELSPAN_NOISE_DESC};
  cs_fields_read(form, &n);
  bool is_one = n.desc.kind != CELSPAN_NOISE_FRACTAL && n.desc.kind != CELSPAN_NOISE_TURBULENCE;
  if (is_one && (n.has_octaves || n.has_gain))
    cs_form_fail(form, "field '%s' needs the kind \"fractal\" or \"turbulence\"",
                 n.has_octaves ? "octaves" : "gain");
  read_colours(form, &n.desc);
  celspan_texture *texture = NULL;
  cs_form_try(form, celspan_texture_create_noise(cs_host_context(form->L), &n.desc, &texture));
  set_extent(form, &(gradient){.has_matrix = n.has_matrix, .matrix = n.matrix}, texture, value);
}

static const char *const noises[] = {"perlin", "value", "fractal", "turbulence",
                                     "cells",  "white", NULL};
static const cs_field noise_fields[] = {
    {"kind", CS_CHOICE(noise, desc.kind, noises), .preset = "perlin",
     .about = "One octave of hills, of values, of cells or of squares; or the sum of several"},
    {"size", CS_NUMBER(noise, desc.size), CS_ABOVE_0, .preset = "100",
     .about = "The side of a cell of the first octave"},
    {"octaves", CS_WHOLE(noise, desc.octaves), CS_HAS(noise, has_octaves), .least = 1,
     .most = OCTAVES_MOST, .about = "Of fractal and turbulence: each has half the size of the last",
     .fallback = "4"},
    {"gain", CS_NUMBER(noise, desc.gain), CS_HAS(noise, has_gain), .most = 1,
     .about = "Of fractal and turbulence: an octave's height, as a share of that before",
     .fallback = "0.5"},
    {"seed", CS_WHOLE(noise, desc.seed), .least = -INT_MAX, .most = INT_MAX, .preset = "0",
     .about = "Another number is another noise"},
    {"at", CS_NUMBER(noise, desc.at), .preset = "0",
     .about = "The third dimension, in cells: change it to let the noise move"},
    {"fade", CS_FLAG(noise, desc.fades), .preset = "true",
     .about = "Whether octaves finer than pixels fade out"},
    {"colours", CS_OWN("celspan.colour[]"), .about = "Two or more, from 0 to 1 at even distances",
     .fallback = "{ \"#000\", \"#fff\" }"},
    {"matrix", CS_NUMBERS(noise, matrix), CS_HAS(noise, has_matrix),
     .about = "Nine numbers: moves the noise alone"},
    {0}};

/* ---------------------------------------------------------------- pictures */

const char *const cs_texture_pixels_fields[] = {"size", "format", "alpha", NULL};

/* The name of the file, or of one of a sequence of files; pushes it. */
static const char *name_of_file(const cs_form *form, const cs_texture_picture *read) {
  char name[PATH_MAX];
  if (!read->has_frame)
    return read->file;
  if (!cs_sequence_has_number(read->file))
    cs_form_fail(form,
                 "field 'frame' needs a file with a place for its number, such as "
                 "\"roto.####.png\", got \"%s\"",
                 read->file);
  cs_form_try(
      form, cs_sequence_name(cs_host_context(form->L), read->file, read->frame, name, sizeof name));
  return lua_pushstring(form->L, name);
}

/* A picture in tiles is described by its file, which is read now. */
static void read_tiles(const cs_form *form, celspan_picture_desc *desc) {
  if (!desc->file || !cs_dzi_is(desc->file))
    return;
  celspan_picture_tiles *tiles = cs_form_scratch(form->L, 1, sizeof *tiles);
  cs_form_try(form, cs_dzi_read(cs_host_context(form->L), desc->file, tiles));
  lua_pushlstring(form->L, desc->file, strlen(desc->file) - strlen(".dzi"));
  desc->file = lua_pushfstring(form->L, "%s_files", lua_tostring(form->L, -1));
  desc->tiles = tiles;
  cs_host_admit(form->L, desc->file);
}

void cs_texture_read_picture(const cs_form *form, int holder, cs_texture_picture *out) {
  celspan_picture_desc *desc = &out->picture;
  cs_fields_read(form, out);
  if (out->has_frame && !out->file)
    cs_form_fail(form, "field 'frame' needs field 'file'");
  if (cs_form_has(form, "pixels"))
    desc->surface = cs_pixel_string_surface(form, &out->pixels, holder);
  else if (out->file)
    desc->file = cs_files_find(form->L, name_of_file(form, out), NULL);
  else
    cs_form_fail(form, "field 'file' must be a string, got nil");
  read_tiles(form, desc);
}

/* A picture with details is a pattern of it and of them, which is made in Lua. */
static void create_detailed(const cs_form *form, cs_userdata *value) {
  lua_State *L = form->L;
  cs_require_module(L, "celspan.details");
  lua_getfield(L, -1, "texture");
  lua_pushvalue(L, form->table);
  lua_call(L, 1, 1);
  value->handle = celspan_texture_ref(cs_userdata_test(L, -1, &cs_kind_texture)->handle);
}

static void create_picture(const cs_form *form, cs_userdata *value) {
  if (cs_form_has(form, "details")) {
    create_detailed(form, value);
    return;
  }
  cs_texture_picture read = {.picture = CELSPAN_PICTURE_DESC};
  cs_texture_read_picture(form, lua_gettop(form->L), &read);
  celspan_texture *texture = NULL;
  cs_form_try(form,
              celspan_texture_create_picture(cs_host_context(form->L), &read.picture, &texture));
  value->handle = texture;
}

static const char *const samplings[] = {"auto", "nearest", "bilinear", "bicubic", NULL};
static const char *const wraps[] = {"clear", "clamp", "repeat", NULL};
static const char *const uses[] = {"paint", "gel", NULL};

#define READ cs_texture_picture
const cs_field cs_texture_picture_fields[] = {
    {"file", CS_TEXT(READ, file),
     .about = "Relative to the script; required unless `pixels` is given"},
    {"frame", CS_WHOLE(READ, frame), CS_HAS(READ, has_frame),
     .about = "The number in the name of the file, where the name has #### or %04d"},
    {"colour", CS_TEXT(READ, picture.colour),
     .about = "\"srgb\", \"linear\", \"rec709\" or \"cineon\"", .fallback = "by the file"},
    {"sampling", CS_CHOICE(READ, picture.sampling, samplings), .preset = "auto"},
    {"as", CS_CHOICE(READ, picture.use, uses), .preset = "paint",
     .about = "Paint, or a slide lit from behind"},
    {"wrap", CS_CHOICE(READ, picture.wrap, wraps), .preset = "clear", .about = "Outside the box"},
    {"subimage", CS_WHOLE(READ, picture.subimage), .about = "From 0", .fallback = "0"},
    {"layer", CS_TEXT(READ, picture.layer), .about = "The name of a subimage"},
    {"source", CS_BOX(READ, picture.source), CS_HAS(READ, picture.has_source),
     .written = "integer[]", .about = "A part of the picture, in its pixels"},
    {"smooth", CS_FLAG(READ, picture.smooth),
     .about = "Alpha of 8 bits without steps, for painted glows"},
    {"pixels", CS_OWN("string"), .about = "Pixels in memory, rows from top to bottom without gaps"},
    {"size", CS_PIXELS(READ, pixels.size), CS_HAS(READ, pixels.has_size), .least = 1,
     .most = CS_PIXEL_STRING_SIDE, .shape = "a size {w, h}", .about = "Of the pixels"},
    {"format", CS_CHOICE(READ, pixels.format, cs_pixel_string_formats),
     .about = "Of the pixels, in the machine's byte order", .fallback = "\"rgba8\""},
    {"alpha", CS_CHOICE(READ, pixels.alpha, cs_pixel_string_alphas), CS_HAS(READ, pixels.has_alpha),
     .about = "Of the pixels", .fallback = "integers straight, floats premultiplied"},
    {0}};
static const cs_field picture_fields[] = {
    {"box", CS_BOX(READ, picture.box), CS_HAS(READ, picture.has_box),
     .fallback = "the bounding rectangle of the primitive"},
    {"details", CS_OWN("table[]"), .about = "Pictures over parts of it, {box =, file =}"},
    {.more = cs_texture_picture_fields}};

/* ---------------------------------------------------------------- patterns */

static void create_pattern(const cs_form *form, cs_userdata *value) {
  lua_State *L = form->L;
  celspan_pattern_desc desc = CELSPAN_PATTERN_DESC;
  cs_fields_read(form, &desc);
  cs_form_get(form, "art");
  const cs_userdata *art = cs_userdata_test(L, -1, &cs_kind_object);
  if (!art)
    cs_form_fail(form, "field 'art' must be an object, got %s", cs_userdata_type(L, -1));
  desc.art = art->handle; /* the table keeps it alive */
  celspan_texture *texture = NULL;
  cs_form_try(form, celspan_texture_create_pattern(cs_host_context(L), &desc, &texture));
  value->handle = texture;
}

static const cs_field pattern_fields[] = {
    {"art", CS_OWN("celspan.object"), .is_required = true, .about = "What is repeated"},
    {"box", CS_BOX(celspan_pattern_desc, box), .is_required = true,
     .about = "The part of the art that is repeated, in its units"},
    {"matrix", CS_NUMBERS(celspan_pattern_desc, matrix), CS_HAS(celspan_pattern_desc, has_matrix),
     .about = "Nine numbers: moves the pattern alone"},
    {0}};

const cs_noun cs_noun_gradient = {.name = "gradient",
                                  .about =
                                      "The triangle gradient; it continues outside the triangle.",
                                  .kind = &cs_kind_texture,
                                  .list = CS_LIST_TUPLE,
                                  .item = "corner",
                                  .item_written = "table",
                                  .item_about = "Three corners {x, y, paint}",
                                  .fields = no_fields,
                                  .create = create_gradient};

#define STOPS                                                                                      \
  .kind = &cs_kind_texture, .list = CS_LIST_ITEMS, .item = "stop",                                 \
  .item_written = "table|celspan.colour",                                                          \
  .item_about = "Stops {at, paint}, at ascending in 0..1; or colours, at even distances"
const cs_noun cs_noun_linear = {.name = "linear",
                                .about =
                                    "A gradient along a line; beyond the ends it holds or repeats.",
                                STOPS,
                                .fields = linear_fields,
                                .create = create_linear};
const cs_noun cs_noun_radial = {
    .name = "radial",
    .about = "A gradient around a point; outside the circle it holds or repeats.",
    STOPS,
    .fields = radial_fields,
    .create = create_radial};
const cs_noun cs_noun_conic = {.name = "conic",
                               .about = "A gradient once round a point, clockwise.",
                               STOPS,
                               .fields = conic_fields,
                               .create = create_conic};
const cs_noun cs_noun_noise = {.name = "noise",
                               .about = "Random hills, clouds or cells, without end.",
                               .kind = &cs_kind_texture,
                               .fields = noise_fields,
                               .create = create_noise};
const cs_noun cs_noun_picture = {
    .name = "picture",
    .about = "A picture as a texture: a file, read when it is first visible, or pixels in memory.",
    .kind = &cs_kind_texture,
    .fields = picture_fields,
    CS_TEXTURE_PICTURE_EITHER,
    .create = create_picture};
const cs_noun cs_noun_pattern = {
    .name = "pattern",
    .about = "Art that is repeated over the plane, as a texture of primitives.",
    .kind = &cs_kind_texture,
    .fields = pattern_fields,
    .create = create_pattern};
