/* celspan.stroke and primitive:stroke: a line and its width. */
#include "bind/stroke.h"

#include "bind/caller.h"
#include "bind/construct.h"
#include "bind/form.h"
#include "bind/host.h"
#include "bind/numbers.h"
#include "bind/openers.h"
#include "bind/userdata.h"

static bool read_flag(const cs_form *form, const char *name) {
  lua_State *L = form->L;
  lua_pushstring(L, name);
  int type = lua_rawget(L, form->table);
  if (type != LUA_TNIL && type != LUA_TBOOLEAN)
    cs_form_fail(form, "field '%s' must be true or false, got %s", name, cs_userdata_type(L, -1));
  bool flag = lua_toboolean(L, -1);
  lua_pop(L, 1);
  return flag;
}

/* Points and widths are scratch memory, left on the stack. */
static void read_points(const cs_form *form, celspan_stroke_desc *desc) {
  lua_State *L = form->L;
  lua_pushliteral(L, "points");
  int type = lua_rawget(L, form->table), list = lua_gettop(L);
  if (type == LUA_TNIL)
    return;
  if (type != LUA_TTABLE)
    cs_form_fail(form, "field 'points' must be an array of points {x, y} or {x, y, width}, got %s",
                 cs_userdata_type(L, -1));
  size_t count = lua_rawlen(L, list);
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
  lua_pushliteral(L, "outline");
  if (lua_rawget(L, form->table) == LUA_TNIL)
    return;
  const cs_userdata *value = cs_userdata_test(L, -1, &cs_kind_object);
  if (!value)
    cs_form_fail(form, "field 'outline' must be a primitive, got %s", cs_userdata_type(L, -1));
  desc->outline = value->handle; /* kept alive by the table */
}

static void check_line(const cs_form *form) {
  static const char *const names[] = {"points", "d", "outline"};
  int given = 0;
  for (int i = 0; i < 3; i++)
    given += cs_form_has(form, names[i]);
  if (given != 1)
    cs_form_fail(form, "give %s of 'points', 'd' and 'outline'", given == 0 ? "one" : "only one");
}

static void create(const cs_form *form, cs_userdata *value) {
  static const char *const caps[] = {"butt", "round", "square", NULL};
  static const char *const joins[] = {"miter", "round", "bevel", NULL};
  celspan_stroke_desc desc = CELSPAN_STROKE_DESC;
  check_line(form);
  desc.width = cs_form_number_or(form, "width", desc.width);
  desc.cap = (celspan_stroke_cap)cs_form_choice(form, "cap", caps);
  desc.join = (celspan_stroke_join)cs_form_choice(form, "join", joins);
  desc.miter = cs_form_number_or(form, "miter", desc.miter);
  desc.dash_offset = cs_form_number_or(form, "dash_offset", 0);
  desc.closed = read_flag(form, "closed");
  desc.degree = cs_form_integer_or(form, "degree", desc.degree);
  desc.from = cs_form_number_or(form, "from", desc.from);
  desc.to = cs_form_number_or(form, "to", desc.to);
  cs_form_numbers(form, "taper", 2, desc.taper);
  desc.data = cs_form_text_or(form, "d", NULL);
  desc.dashes = cs_form_array(form, "dash", &desc.dash_count);
  read_points(form, &desc);
  read_outline(form, &desc);
  desc.texture = cs_form_texture(form, "texture");
  celspan_object *object = NULL;
  cs_form_try(form, celspan_object_create_stroke(cs_host_context(form->L), &desc, &object));
  value->handle = object;
}

static const cs_field fields[] = {
    {"points", NULL},     {"d", NULL},       {"outline", NULL},      {"width", "1"},
    {"cap", "butt"},      {"join", "miter"}, {"miter", "4"},         {"dash", NULL},
    {"dash_offset", "0"}, {"closed", NULL},  {"degree", "1"},        {"taper", NULL},
    {"from", "0"},        {"to", "1"},       {"texture", "#000000"}, {0}};
static const cs_noun noun = {
    .name = "stroke", .kind = &cs_kind_object, .fields = fields, .create = create};

/* Places and fades the stroke on top of the stack as another value is. */
static void place_like(lua_State *L, const cs_userdata *like) {
  if (!like->is_placed)
    return;
  const cs_userdata *plain = lua_touserdata(L, -1);
  cs_userdata *value = cs_userdata_push_like(L, -1, true);
  const cs_kind *kind = noun.kind;
  const cs_placement placement = cs_userdata_placement(like);
  void *faded = NULL;
  celspan_context *context = cs_host_context(L);
  cs_host_try(L, noun.name,
              kind->transform(context, plain->handle, &placement.matrix, &value->handle));
  cs_host_try(L, noun.name, kind->fade(context, value->handle, placement.fade, &faded));
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
  cs_construct_value(L, &noun, 3);
  place_like(L, self);
  return 1;
}

void cs_open_stroke(lua_State *L) {
  cs_construct_push(L, &noun);
  lua_setfield(L, -2, noun.name);
}
