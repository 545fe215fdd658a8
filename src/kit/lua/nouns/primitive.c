/* Primitives: rect, triangle, circle, ellipse, polygon, nurbs, path, image. */
#include <math.h>

#include "lua/bind/fields.h"
#include "lua/bind/host.h"
#include "lua/bind/list.h"
#include "lua/bind/numbers.h"
#include "lua/nouns/contours.h"
#include "lua/nouns/nouns.h"
#include "lua/nouns/texture.h"

static const char *const rules[] = {"nonzero", "evenodd", NULL};
#define RULE(desc)                                                                                 \
  "rule", CS_CHOICE(desc, rule, rules), .preset = "nonzero", .written = "celspan.rule"

/* ---------------------------------------------------------------- rect */

/* Value number `place` of a rectangle's array part. */
static double corner(const cs_form *form, int place, const char *name) {
  lua_State *L = form->L;
  bool good = lua_rawgeti(L, form->table, place) == LUA_TNUMBER && isfinite(lua_tonumber(L, -1));
  const char *subject = good ? name : lua_pushfstring(L, "value %d (%s)", place, name);
  double number = cs_numbers_check(L, good ? -1 : -2, form->noun->name, subject);
  lua_pop(L, 1);
  return number;
}

static void check_length(const cs_form *form, int wanted, const char *shape) {
  int length = cs_form_length(form);
  if (length != wanted)
    cs_form_fail(form, "takes %s, got %d values", shape, length);
}

/* The radii of the four corners, or NULL if there is one for all, in the description. */
static const double *read_radii(const cs_form *form, celspan_rect_desc *desc) {
  size_t count = 0;
  int type = cs_form_get(form, "radius");
  if (type != LUA_TTABLE) {
    if (type != LUA_TNIL)
      desc->radius = cs_numbers_check(form->L, -1, form->noun->name, "field 'radius'");
    return NULL;
  }
  const double *radii = cs_form_array(form, "radius", &count);
  if (count != 4)
    cs_form_fail(form, "field 'radius' must be a number or four numbers, got %d", (int)count);
  return radii;
}

static void create_rect(const cs_form *form, cs_userdata *value) {
  celspan_rect_desc desc = {.struct_size = sizeof desc,
                            .x = corner(form, 1, "x"),
                            .y = corner(form, 2, "y"),
                            .width = corner(form, 3, "width"),
                            .height = corner(form, 4, "height")};
  check_length(form, 4, "four numbers: x, y, width, height");
  cs_fields_read(form, &desc);
  const double *radii = read_radii(form, &desc);
  celspan_object *object = NULL;
  celspan_context *context = cs_host_context(form->L);
  cs_form_try(form, radii ? celspan_object_create_rounded(context, &desc, radii, &object)
                          : celspan_object_create_rect(context, &desc, &object));
  value->handle = object;
}

static const cs_field rect_fields[] = {{"radius", CS_OWN("number|number[]"), .preset = "0",
                                        .about = "Of all corners, or {top left, top right, bottom "
                                                 "right, bottom left}"},
                                       {CS_TEXTURE(celspan_rect_desc, texture)},
                                       {0}};

/* ---------------------------------------------------------------- triangle, polygon */

static void create_triangle(const cs_form *form, cs_userdata *value) {
  check_length(form, 3, "three points {x, y}");
  const celspan_point *points = cs_form_points(form, form->table, 3, NULL);
  celspan_triangle_desc desc = {.struct_size = sizeof desc,
                                .points = {points[0], points[1], points[2]}};
  cs_fields_read(form, &desc);
  celspan_object *object = NULL;
  cs_form_try(form, celspan_object_create_triangle(cs_host_context(form->L), &desc, &object));
  value->handle = object;
}

static const cs_field triangle_fields[] = {{CS_TEXTURE(celspan_triangle_desc, texture)}, {0}};

static void create_polygon(const cs_form *form, cs_userdata *value) {
  int count = cs_form_length(form);
  celspan_polygon_desc desc = {.struct_size = sizeof desc,
                               .points = cs_form_points(form, form->table, (size_t)count, NULL),
                               .point_count = (size_t)count};
  cs_fields_read(form, &desc);
  celspan_object *object = NULL;
  cs_form_try(form, celspan_object_create_polygon(cs_host_context(form->L), &desc, &object));
  value->handle = object;
}

static const cs_field polygon_fields[] = {
    {RULE(celspan_polygon_desc)}, {CS_TEXTURE(celspan_polygon_desc, texture)}, {0}};

/* ---------------------------------------------------------------- circle, ellipse */

static void create_circle(const cs_form *form, cs_userdata *value) {
  celspan_ellipse_desc desc = {.struct_size = sizeof desc, .texture = NULL};
  cs_fields_read(form, &desc);
  desc.radius_y = desc.radius_x;
  celspan_object *object = NULL;
  cs_form_try(form, celspan_object_create_ellipse(cs_host_context(form->L), &desc, &object));
  value->handle = object;
}

static const cs_field circle_fields[] = {
    {"centre", CS_POINT(celspan_ellipse_desc, centre), .is_required = true},
    {"radius", CS_NUMBER(celspan_ellipse_desc, radius_x), CS_FROM(0), .is_required = true},
    {CS_TEXTURE(celspan_ellipse_desc, texture)},
    {0}};

typedef struct ellipse {
  celspan_point centre;
  double radii[2];
  celspan_texture *texture;
} ellipse;

static void create_ellipse(const cs_form *form, cs_userdata *value) {
  ellipse e = {.texture = NULL};
  cs_fields_read(form, &e);
  const celspan_ellipse_desc desc = {sizeof desc, e.centre, e.radii[0], e.radii[1], e.texture};
  celspan_object *object = NULL;
  cs_form_try(form, celspan_object_create_ellipse(cs_host_context(form->L), &desc, &object));
  value->handle = object;
}

static const cs_field ellipse_fields[] = {
    {"centre", CS_POINT(ellipse, centre), .is_required = true},
    {"radii", CS_NUMBERS(ellipse, radii), .is_required = true, .shape = "radii {rx, ry}"},
    {CS_TEXTURE(ellipse, texture)},
    {0}};

/* ---------------------------------------------------------------- nurbs, path */

static void create_nurbs(const cs_form *form, cs_userdata *value) {
  lua_State *L = form->L;
  celspan_nurbs_desc desc = {.struct_size = sizeof desc, .degree = 3, .texture = NULL};
  cs_fields_read(form, &desc);
  if (cs_form_get(form, "points") != LUA_TTABLE)
    cs_form_fail(form, "field 'points' must be an array of points {x, y} or {x, y, weight}, got %s",
                 cs_userdata_type(L, -1));
  desc.point_count = (size_t)cs_list_length(L, -1);
  desc.points = cs_form_points(form, -1, desc.point_count, &desc.weights);
  desc.knots = cs_form_array(form, "knots", &desc.knot_count);
  celspan_object *object = NULL;
  cs_form_try(form, celspan_object_create_nurbs(cs_host_context(L), &desc, &object));
  value->handle = object;
}

static const char *const closures[] = {"periodic", "clamped", NULL};
static const cs_field nurbs_fields[] = {
    {"points", CS_OWN("number[][]"), .is_required = true,
     .about = "{x, y} or {x, y, weight}; the point itself, not multiplied by its weight"},
    {"degree", CS_WHOLE(celspan_nurbs_desc, degree), .least = 1, .most = 15, .preset = "3"},
    {"knots", CS_OWN("number[]"), .fallback = "uniform"},
    {"closed", CS_CHOICE(celspan_nurbs_desc, closure, closures), .preset = "periodic"},
    {RULE(celspan_nurbs_desc)},
    {CS_TEXTURE(celspan_nurbs_desc, texture)},
    {0}};

static void create_path(const cs_form *form, cs_userdata *value) {
  celspan_path_desc desc = {.struct_size = sizeof desc, .data = NULL};
  cs_fields_read(form, &desc);
  if (!desc.data && !cs_form_has(form, "contours"))
    cs_form_fail(form, "give one of 'd' and 'contours'");
  const cs_contour_list given = cs_contours_field(form);
  desc.contours = given.items;
  desc.contour_count = given.count;
  celspan_object *object = NULL;
  cs_form_try(form, celspan_object_create_path(cs_host_context(form->L), &desc, &object));
  value->handle = object;
}

static const cs_field path_fields[] = {
    {"d", CS_TEXT(celspan_path_desc, data), .about = "SVG path data; open subpaths are closed"},
    {CS_CONTOURS},
    {RULE(celspan_path_desc)},
    {CS_TEXTURE(celspan_path_desc, texture)},
    {0}};

/* ---------------------------------------------------------------- image */

static void create_image(const cs_form *form, cs_userdata *value) {
  cs_texture_picture read = {.picture = CELSPAN_PICTURE_DESC, .image = CELSPAN_IMAGE_DESC};
  read.image.picture = &read.picture;
  cs_texture_read_picture(form, lua_gettop(form->L), &read);
  celspan_object *object = NULL;
  cs_form_try(form, celspan_object_create_image(cs_host_context(form->L), &read.image, &object));
  value->handle = object;
}

static const char *const fits[] = {"fill", "contain", "cover", NULL};
static const cs_field image_fields[] = {
    {"x", CS_NUMBER(cs_texture_picture, image.x), .preset = "0"},
    {"y", CS_NUMBER(cs_texture_picture, image.y), .preset = "0"},
    {"w", CS_NUMBER(cs_texture_picture, image.width), CS_FROM(0),
     .about = "If only one of w and h is given, the aspect ratio is kept",
     .fallback = "the width of the picture"},
    {"h", CS_NUMBER(cs_texture_picture, image.height), CS_FROM(0)},
    {"fit", CS_CHOICE(cs_texture_picture, image.fit, fits), .preset = "fill",
     .about = "If both w and h are given"},
    {.more = cs_texture_picture_fields}};

/* ---------------------------------------------------------------- the nouns */

#define OBJECT(noun)                                                                               \
  .name = #noun, .kind = &cs_kind_object, .fields = noun##_fields, .create = create_##noun
const cs_noun cs_noun_rect = {OBJECT(rect),
                              .about = "A rectangle.",
                              .list = CS_LIST_TUPLE,
                              .item = "number",
                              .item_written = "number",
                              .item_about = "x, y, width, height",
                              .places = "{x, y, w, h}"};
const cs_noun cs_noun_triangle = {
    OBJECT(triangle), .about = "A triangle.",          .list = CS_LIST_TUPLE,
    .item = "point",  .item_written = "celspan.point", .item_about = "Three points"};
static const cs_place circle_places[] = {{"centre", 2}, {"radius", 1}, {0}};
const cs_noun cs_noun_circle = {OBJECT(circle), .about = "A circle, also as { x, y, radius }.",
                                .places = "{x, y, r}", .by_place = circle_places};
static const cs_place ellipse_places[] = {{"centre", 2}, {"radii", 2}, {0}};
const cs_noun cs_noun_ellipse = {OBJECT(ellipse), .about = "An ellipse, also as { x, y, rx, ry }.",
                                 .places = "{x, y, rx, ry}", .by_place = ellipse_places};
const cs_noun cs_noun_polygon = {OBJECT(polygon), .about = "A closed polygon.",
                                 .list = CS_LIST_ITEMS, .item = "point",
                                 .item_written = "celspan.point"};
const cs_noun cs_noun_nurbs = {OBJECT(nurbs),
                               .about = "A closed curve of any degree, with or without weights."};
const cs_noun cs_noun_path = {OBJECT(path),
                              .about = "The area inside lines, curves and arcs. Give one of d and "
                                       "contours.",
                              .either = {"d", "contours"}};
const cs_noun cs_noun_image = {OBJECT(image), .about = "A rectangle textured with a picture.",
                               CS_TEXTURE_PICTURE_EITHER};
