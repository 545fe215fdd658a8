/* Textures: gradients and pictures. */
#include "bind/texture.h"

#include "bind/construct.h"
#include "bind/files.h"
#include "bind/host.h"
#include "bind/named.h"
#include "bind/openers.h"
#include "bind/userdata.h"

static void unref_texture(void *handle) { celspan_texture_unref(handle); }

const cs_kind cs_kind_texture = {
    .name = "celspan.texture", .unref = unref_texture, .push_field = cs_named_push_field};

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

/* The stops {at, paint} of the array part: scratch memory, left on the stack. */
static celspan_stop *read_stops(const cs_form *form, int count) {
  celspan_stop *stops = cs_form_scratch(form->L, (size_t)count, sizeof *stops);
  for (int i = 0; i < count; i++) {
    cs_form_item(form, i + 1, LUA_TTABLE, "stop", "{at, paint}");
    stops[i].at = cs_form_tuple_number(form, -1, 1, "stop", i + 1);
    stops[i].paint = cs_form_tuple_paint(form, -1, 2, "stop", i + 1);
    lua_pop(form->L, 1);
  }
  return stops;
}

/* Gives the gradient the matrix and the spread of the form; *texture is the value's from the first on,
 * so that it is released where one is refused. */
static void read_extent(const cs_form *form, celspan_texture *texture, cs_userdata *value) {
  static const char *const spreads[] = {"hold", "repeat", "reflect", NULL};
  celspan_context *context = cs_host_context(form->L);
  celspan_matrix matrix;
  value->handle = texture;
  if (cs_form_numbers(form, "matrix", 9, matrix.m)) {
    cs_form_try(form, celspan_texture_with_matrix(context, value->handle, &matrix, &texture));
    celspan_texture_unref(value->handle);
    value->handle = texture;
  }
  celspan_spread spread = (celspan_spread)cs_form_choice(form, "spread", spreads);
  if (spread != CELSPAN_SPREAD_HOLD) {
    cs_form_try(form, celspan_texture_with_spread(context, value->handle, spread, &texture));
    celspan_texture_unref(value->handle);
    value->handle = texture;
  }
}

static void create_linear(const cs_form *form, cs_userdata *value) {
  celspan_point from = cs_form_point(form, "from"), to = cs_form_point(form, "to");
  int count = cs_form_length(form);
  celspan_stop *stops = read_stops(form, count);
  celspan_texture *texture = NULL;
  cs_form_try(form, celspan_texture_create_linear(cs_host_context(form->L), from, to, stops,
                                                  (size_t)count, &texture));
  read_extent(form, texture, value);
}

static void create_radial(const cs_form *form, cs_userdata *value) {
  celspan_point centre = cs_form_point(form, "centre"), focus = centre;
  (void)cs_form_point_or(form, "focus", &focus);
  double radius = cs_form_number(form, "radius");
  int count = cs_form_length(form);
  celspan_stop *stops = read_stops(form, count);
  celspan_texture *texture = NULL;
  cs_form_try(form, celspan_texture_create_focal(cs_host_context(form->L), centre, radius, focus,
                                                 stops, (size_t)count, &texture));
  read_extent(form, texture, value);
}

const char *const cs_texture_pixels_fields[] = {"size", "format", "alpha", NULL};

/* Reads the fields of a file, or of pixels, of the value at index `holder`. */
static void read_content(const cs_form *form, int holder, celspan_picture_desc *desc) {
  if (cs_form_has(form, "pixels"))
    desc->surface = cs_pixel_string_surface(form, holder);
  else
    desc->file = cs_files_find(form->L, cs_form_text(form, "file"), &desc->tried);
}

void cs_texture_read_picture(const cs_form *form, int holder, celspan_picture_desc *desc) {
  static const char *const samplings[] = {"auto", "nearest", "bilinear", "bicubic", NULL};
  static const char *const wraps[] = {"clear", "clamp", "repeat", NULL};
  static const char *const uses[] = {"paint", "gel", NULL};
  *desc = (celspan_picture_desc){0};
  desc->colour = cs_form_text_or(form, "colour", NULL);
  desc->layer = cs_form_text_or(form, "layer", NULL);
  desc->subimage = cs_form_integer_or(form, "subimage", 0);
  desc->sampling = (celspan_sampling)cs_form_choice(form, "sampling", samplings);
  desc->wrap = (celspan_wrap)cs_form_choice(form, "wrap", wraps);
  desc->use = (celspan_picture_use)cs_form_choice(form, "as", uses);
  desc->has_source = cs_form_box(form, "source", &desc->source);
  read_content(form, holder, desc);
}

static void create_picture(const cs_form *form, cs_userdata *value) {
  celspan_picture_desc desc;
  cs_texture_read_picture(form, lua_gettop(form->L), &desc);
  desc.has_box = cs_form_box(form, "box", &desc.box);
  celspan_texture *texture = NULL;
  cs_form_try(form, celspan_texture_create_picture(cs_host_context(form->L), &desc, &texture));
  value->handle = texture;
}

static const cs_field no_fields[] = {{0}};
static const cs_field linear_fields[] = {
    {"from", NULL}, {"to", NULL}, {"spread", NULL}, {"matrix", NULL}, {0}};
static const cs_field radial_fields[] = {{"centre", NULL}, {"radius", NULL}, {"focus", NULL},
                                         {"spread", NULL}, {"matrix", NULL}, {0}};
static const cs_field picture_fields[] = {CS_TEXTURE_PICTURE_FIELDS, {"box", NULL}, {0}};

static const cs_noun nouns[] = {
    {.name = "gradient",
     .kind = &cs_kind_texture,
     .list = CS_LIST_TUPLE,
     .item = "corner",
     .fields = no_fields,
     .create = create_gradient},
    {.name = "linear",
     .kind = &cs_kind_texture,
     .list = CS_LIST_ITEMS,
     .item = "stop",
     .fields = linear_fields,
     .create = create_linear},
    {.name = "radial",
     .kind = &cs_kind_texture,
     .list = CS_LIST_ITEMS,
     .item = "stop",
     .fields = radial_fields,
     .create = create_radial},
    {.name = "picture",
     .kind = &cs_kind_texture,
     .fields = picture_fields,
     CS_TEXTURE_PICTURE_EITHER,
     .create = create_picture},
};

void cs_open_texture(lua_State *L) {
  static const luaL_Reg methods[] = {
      {"with", cs_construct_with}, {"named", cs_named_method}, {NULL, NULL}};
  cs_userdata_register(L, &cs_kind_texture, methods);
  for (size_t i = 0; i < sizeof nouns / sizeof *nouns; i++) {
    cs_construct_push(L, &nouns[i]);
    lua_setfield(L, -2, nouns[i].name);
  }
}
