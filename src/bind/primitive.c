/* Primitives: rect, triangle, circle, ellipse, polygon, nurbs, path, image. */
#include <math.h>

#include "bind/construct.h"
#include "bind/host.h"
#include "bind/numbers.h"
#include "bind/openers.h"
#include "bind/texture.h"
#include "bind/userdata.h"

static const char *const rules[] = {"nonzero", "evenodd", NULL};

static celspan_rule read_rule(const cs_form *form) {
  return (celspan_rule)cs_form_choice(form, "rule", rules);
}

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

static void create_rect(const cs_form *form, cs_userdata *value) {
  celspan_rect_desc desc = {.x = corner(form, 1, "x"),
                            .y = corner(form, 2, "y"),
                            .width = corner(form, 3, "width"),
                            .height = corner(form, 4, "height"),
                            .radius = cs_form_number_or(form, "radius", 0)};
  check_length(form, 4, "four numbers: x, y, width, height");
  desc.texture = cs_form_texture(form, "texture");
  celspan_object *object = NULL;
  cs_form_try(form, celspan_object_create_rect(cs_host_context(form->L), &desc, &object));
  value->handle = object;
}

static void create_triangle(const cs_form *form, cs_userdata *value) {
  check_length(form, 3, "three points {x, y}");
  const celspan_point *points = cs_form_points(form, form->table, 3, NULL);
  celspan_triangle_desc desc = {.points = {points[0], points[1], points[2]},
                                .texture = cs_form_texture(form, "texture")};
  celspan_object *object = NULL;
  cs_form_try(form, celspan_object_create_triangle(cs_host_context(form->L), &desc, &object));
  value->handle = object;
}

static void create_ellipse(const cs_form *form, cs_userdata *value) {
  double radii[2];
  if (!cs_form_numbers(form, "radii", 2, radii))
    cs_numbers_fail_missing(form->L, form->noun->name, "radii", 2);
  celspan_ellipse_desc desc = {.centre = cs_form_point(form, "centre"),
                               .radius_x = radii[0],
                               .radius_y = radii[1],
                               .texture = cs_form_texture(form, "texture")};
  celspan_object *object = NULL;
  cs_form_try(form, celspan_object_create_ellipse(cs_host_context(form->L), &desc, &object));
  value->handle = object;
}

/* The core knows ellipses only: its messages about radii are put into words about the radius. */
static void create_circle(const cs_form *form, cs_userdata *value) {
  lua_State *L = form->L;
  celspan_context *context = cs_host_context(L);
  double radius = cs_form_number(form, "radius");
  celspan_ellipse_desc desc = {.centre = cs_form_point(form, "centre"),
                               .radius_x = radius,
                               .radius_y = radius,
                               .texture = cs_form_texture(form, "texture")};
  celspan_object *object = NULL;
  celspan_status status = celspan_object_create_ellipse(context, &desc, &object);
  if (status == CELSPAN_BAD_ARGUMENT) {
    const char *sentence = luaL_gsub(L, celspan_context_error(context), "radii[1]", "radius");
    status = celspan_context_fail(context, status, "%s", sentence);
  }
  cs_form_try(form, status);
  value->handle = object;
}

static void create_polygon(const cs_form *form, cs_userdata *value) {
  int count = cs_form_length(form);
  celspan_polygon_desc desc = {.points = cs_form_points(form, form->table, (size_t)count, NULL),
                               .point_count = (size_t)count,
                               .rule = read_rule(form),
                               .texture = cs_form_texture(form, "texture")};
  celspan_object *object = NULL;
  cs_form_try(form, celspan_object_create_polygon(cs_host_context(form->L), &desc, &object));
  value->handle = object;
}

static void create_nurbs(const cs_form *form, cs_userdata *value) {
  static const char *const closures[] = {"periodic", "clamped", NULL};
  lua_State *L = form->L;
  celspan_nurbs_desc desc = {.degree = cs_form_integer_or(form, "degree", 3),
                             .closure =
                                 (celspan_nurbs_closure)cs_form_choice(form, "closed", closures),
                             .rule = read_rule(form)};
  if (desc.degree == 0) /* 0 means the default in the core */
    cs_form_fail(form, "field 'degree' must be at least 1, got 0");
  lua_pushliteral(L, "points");
  if (lua_rawget(L, form->table) != LUA_TTABLE)
    cs_form_fail(form, "field 'points' must be an array of points {x, y} or {x, y, weight}, got %s",
                 cs_userdata_type(L, -1));
  desc.point_count = lua_rawlen(L, -1);
  desc.points = cs_form_points(form, -1, desc.point_count, &desc.weights);
  desc.knots = cs_form_array(form, "knots", &desc.knot_count);
  desc.texture = cs_form_texture(form, "texture");
  celspan_object *object = NULL;
  cs_form_try(form, celspan_object_create_nurbs(cs_host_context(L), &desc, &object));
  value->handle = object;
}

static void create_path(const cs_form *form, cs_userdata *value) {
  celspan_path_desc desc = {.data = cs_form_text(form, "d"),
                            .rule = read_rule(form),
                            .texture = cs_form_texture(form, "texture")};
  celspan_object *object = NULL;
  cs_form_try(form, celspan_object_create_path(cs_host_context(form->L), &desc, &object));
  value->handle = object;
}

static void create_image(const cs_form *form, cs_userdata *value) {
  static const char *const fits[] = {"fill", "contain", "cover", NULL};
  int place = lua_gettop(form->L);
  celspan_image_desc desc = {.x = cs_form_number_or(form, "x", 0),
                             .y = cs_form_number_or(form, "y", 0),
                             .width = cs_form_number_or(form, "w", 0),
                             .height = cs_form_number_or(form, "h", 0),
                             .fit = (celspan_fit)cs_form_choice(form, "fit", fits)};
  cs_texture_read_picture(form, place, &desc.picture);
  celspan_object *object = NULL;
  cs_form_try(form, celspan_object_create_image(cs_host_context(form->L), &desc, &object));
  value->handle = object;
}

#define TEXTURE                                                                                    \
  { "texture", "#000000" }
#define RULE                                                                                       \
  { "rule", "nonzero" }
static const cs_field rect_fields[] = {{"radius", "0"}, TEXTURE, {0}};
static const cs_field triangle_fields[] = {TEXTURE, {0}};
static const cs_field circle_fields[] = {{"centre", NULL}, {"radius", NULL}, TEXTURE, {0}};
static const cs_field ellipse_fields[] = {{"centre", NULL}, {"radii", NULL}, TEXTURE, {0}};
static const cs_field polygon_fields[] = {RULE, TEXTURE, {0}};
static const cs_field nurbs_fields[] = {
    {"points", NULL}, {"degree", "3"}, {"knots", NULL}, {"closed", "periodic"}, RULE, TEXTURE, {0}};
static const cs_field path_fields[] = {{"d", NULL}, RULE, TEXTURE, {0}};
static const cs_field image_fields[] = {
    CS_TEXTURE_PICTURE_FIELDS, {"x", "0"}, {"y", "0"}, {"w", NULL}, {"h", NULL},
    {"fit", "fill"},           {0}};

#define OBJECT(noun)                                                                               \
  .name = #noun, .kind = &cs_kind_object, .fields = noun##_fields, .create = create_##noun
static const cs_noun nouns[] = {
    {OBJECT(rect), .list = CS_LIST_TUPLE, .item = "number", .places = "{x, y, w, h}"},
    {OBJECT(triangle), .list = CS_LIST_TUPLE, .item = "point"},
    {OBJECT(circle)},
    {OBJECT(ellipse)},
    {OBJECT(polygon), .list = CS_LIST_ITEMS, .item = "point"},
    {OBJECT(nurbs)},
    {OBJECT(path)},
    {OBJECT(image), CS_TEXTURE_PICTURE_EITHER},
};

void cs_open_primitive(lua_State *L) {
  for (size_t i = 0; i < sizeof nouns / sizeof *nouns; i++) {
    cs_construct_push(L, &nouns[i]);
    lua_setfield(L, -2, nouns[i].name);
  }
}
