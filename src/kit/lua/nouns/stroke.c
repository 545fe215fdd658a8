/* celspan.stroke and primitive:stroke: a line and its width. */
#include "lua/bind/caller.h"
#include "lua/bind/construct.h"
#include "lua/bind/fields.h"
#include "lua/bind/host.h"
#include "lua/bind/list.h"
#include "lua/bind/numbers.h"
#include "lua/nouns/contours.h"
#include "lua/nouns/nouns.h"

/* Points and widths are scratch memory, left on the stack. */
static void read_points(const cs_form *form, celspan_stroke_desc *desc) {
  lua_State *L = form->L;
  int type = cs_form_get(form, "points"), list = lua_gettop(L);
  if (type == LUA_TNIL)
    return;
  if (type != LUA_TTABLE)
    cs_form_fail(form, "field 'points' must be an array of points {x, y} or {x, y, width}, got %s",
                 cs_userdata_type(L, -1));
  size_t count = (size_t)cs_list_length(L, list);
  celspan_point *points = cs_form_scratch(L, count, sizeof *points);
  double *widths = cs_form_scratch(L, count, sizeof *widths);
  cs_numbers_name name = {.noun = form->noun->name,
                          .whole = "point %d",
                          .item = "point %d: its value %d",
                          .shape = "{x, y} or {x, y, width}"};
  for (int i = 0; i < (int)count; i++) {
    double n[3] = {0, 0, desc->width};
    name.number = i + 1;
    lua_rawgeti(L, list, i + 1);
    if (cs_numbers_read(L, -1, &name, 2, 3, n) == 3)
      desc->widths = widths;
    points[i] = (celspan_point){n[0], n[1]};
    widths[i] = n[2];
    lua_pop(L, 1);
  }
  desc->points = points;
  desc->point_count = count;
}

static void read_outline(const cs_form *form, celspan_stroke_desc *desc) {
  lua_State *L = form->L;
  if (cs_form_get(form, "outline") == LUA_TNIL)
    return;
  const cs_userdata *value = cs_userdata_test(L, -1, &cs_kind_object);
  if (!value)
    cs_form_fail(form, "field 'outline' must be a primitive, got %s", cs_userdata_type(L, -1));
  desc->outline = value->handle; /* the table keeps it alive */
}

static void check_line(const cs_form *form) {
  static const char *const names[] = {"points", "d", "outline", "contours"};
  int given = 0;
  for (int i = 0; i < 4; i++)
    given += cs_form_has(form, names[i]);
  if (given != 1)
    cs_form_fail(form, "give %s of 'points', 'd', 'outline' and 'contours'",
                 given == 0 ? "one" : "only one");
}

static void create(const cs_form *form, cs_userdata *value) {
  celspan_stroke_desc desc = CELSPAN_STROKE_DESC;
  check_line(form);
  cs_fields_read(form, &desc);
  desc.dashes = cs_form_array(form, "dash", &desc.dash_count);
  read_points(form, &desc);
  read_outline(form, &desc);
  const cs_contour_list given = cs_contours_field(form);
  desc.contours = given.items;
  desc.contour_count = given.count;
  celspan_object *object = NULL;
  cs_form_try(form, celspan_object_create_stroke(cs_host_context(form->L), &desc, &object));
  value->handle = object;
}

const char *const cs_nouns_caps[] = {"butt", "round", "square", NULL};
static const char *const profiles[] = {"straight", "round", NULL};
const char *const cs_nouns_joins[] = {"miter", "round", "bevel", NULL};

#define DESC celspan_stroke_desc
static const cs_field style_fields[] = {
    {"width", CS_NUMBER(DESC, width), CS_FROM(0), .preset = "1",
     .about = "For points without their own"},
    {"cap", CS_CHOICE(DESC, cap, cs_nouns_caps), .preset = "butt"},
    {"join", CS_CHOICE(DESC, join, cs_nouns_joins), .preset = "miter"},
    {"miter", CS_NUMBER(DESC, miter), .least = 1, .most = 1e6, .preset = "4",
     .about = "The longest miter, in widths"},
    {"dash", CS_OWN("number[]"), .about = "Lengths drawn and left out in turn"},
    {"dash_offset", CS_NUMBER(DESC, dash_offset), .preset = "0",
     .about = "The distance into the dashes at which each subpath begins; while it grows, dashes "
              "move towards the beginning"},
    {"taper", CS_NUMBERS(DESC, taper),
     .about = "{begin, end}: lengths over which the width grows from 0 and falls to 0"},
    {"profile", CS_CHOICE(DESC, profile, profiles), .preset = "straight",
     .about = "Of tapers; round: without a corner where the taper ends"},
    {"from", CS_NUMBER(DESC, from), .preset = "0",
     .about = "Where drawing begins, as a fraction of the whole length"},
    {"to", CS_NUMBER(DESC, to), .preset = "1", .about = "Where drawing ends"},
    {CS_TEXTURE(DESC, texture)},
    {0}};
static const cs_field fields[] = {
    {"points", CS_OWN("number[][]"), .about = "{x, y} or {x, y, width}"},
    {"d", CS_TEXT(DESC, data), .about = "SVG path data; Z closes a subpath"},
    {"outline", CS_OWN("celspan.object"), .about = "A primitive, in its own units"},
    {CS_CONTOURS},
    {"closed", CS_FLAG(DESC, closed), .about = "Whether the line returns to its first point"},
    {"degree", CS_WHOLE(DESC, degree), .least = 1, .most = 15, .preset = "1",
     .about = "Of the spline through the points"},
    {.more = style_fields}};
const cs_noun cs_noun_stroke_style = {
    .name = "stroke.style", .table = "celspan.stroke.style", .fields = style_fields};
const cs_noun cs_noun_stroke = {
    .name = "stroke",
    .about = "A line with a width. Give exactly one of points, d, outline and contours.",
    .kind = &cs_kind_object,
    .fields = fields,
    .create = create};

/* Gives the stroke on top of the stack the place and the fade of another value. */
static void place_like(lua_State *L, const cs_userdata *like) {
  if (!like->is_placed)
    return;
  const cs_userdata *plain = lua_touserdata(L, -1);
  cs_userdata *value = cs_userdata_push_like(L, -1, true);
  const cs_kind *kind = cs_noun_stroke.kind;
  const cs_placement placement = cs_userdata_placement(like);
  void *faded = NULL;
  celspan_context *context = cs_host_context(L);
  cs_host_try(L, cs_noun_stroke.name,
              kind->transform(context, plain->handle, &placement.matrix, &value->handle));
  cs_host_try(L, cs_noun_stroke.name, kind->fade(context, value->handle, placement.fade, &faded));
  kind->unref(value->handle);
  value->handle = faded;
  cs_userdata_place(value, &placement);
  lua_remove(L, -2);
}

int cs_stroke_method(lua_State *L) {
  const cs_userdata *self = cs_userdata_self(L, &cs_kind_object, "stroke");
  lua_settop(L, 2);
  if (lua_isnil(L, 2))
    lua_newtable(L);
  else if (lua_istable(L, 2))
    cs_userdata_push_copy(L, 2, 1);
  else
    return cs_caller_error(L, "stroke: takes a table, primitive:stroke{ ... }, got %s",
                           cs_userdata_type(L, 2));
  lua_pushliteral(L, "outline");
  lua_pushvalue(L, 1);
  lua_rawset(L, 3);
  cs_construct_value(L, &cs_noun_stroke, 3);
  place_like(L, self);
  return 1;
}
