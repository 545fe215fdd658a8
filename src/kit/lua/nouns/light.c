#include "lua/nouns/light.h"

#include "lua/bind/list.h"
#include "lua/bind/numbers.h"
#include "lua/nouns/nouns.h"

static const char *const places[] = {"frame", "cel", NULL};

#define DESC celspan_light_texture
static const cs_field fields[] = {
    {"texture", CS_SURFACE(DESC, texture), .is_required = true},
    {"gain", CS_NUMBER(DESC, gain), CS_FROM(0), .preset = "1"},
    {"on", CS_CHOICE(DESC, on, places), .preset = "frame",
     .about = "In film units on the frame, or in the units of the cel, moving with it"},
    {"matte", CS_NUMBER(DESC, matte), .least = 0, .most = 1, .preset = "1",
     .about = "The matte of a back light is its beta times this"},
    {0}};
const cs_noun cs_noun_light = {
    .name = "light",
    .about = "A light with a shape: gain times beta times pigment at each point.",
    .table = "celspan.light_shape",
    .fields = fields};

/* Reads { texture =, gain =, on =, matte = } on top of the stack. light: the light's name, such as
 * "cel: front". */
static void read_shape(lua_State *L, const char *light, celspan_light_texture *out) {
  cs_noun named = cs_noun_light;
  named.name = light;
  cs_form form = cs_form_open(L, &named, -1);
  cs_fields_read(&form, out);
}

static bool has_field(lua_State *L, const char *name) {
  lua_pushstring(L, name);
  bool found = lua_rawget(L, -2) != LUA_TNIL;
  lua_pop(L, 1);
  return found;
}

/* Whether all keys of the table on top of the stack are names, and none of them is a name of a
 * colour: for colours, the error says how to write the numbers. */
static bool has_names_alone(lua_State *L) {
  return cs_list_length(L, -1) == 0 && !has_field(L, "r") && !has_field(L, "g") &&
         !has_field(L, "b") && (lua_pushnil(L), lua_next(L, -2)) && (lua_pop(L, 2), true);
}

/* Whether the value is a light with a shape, even one with wrong fields. */
static bool is_shape(lua_State *L) {
  if (!lua_istable(L, -1))
    return false;
  for (const cs_field *field = fields; field->name; field = cs_field_next(field))
    if (has_field(L, field->name))
      return true;
  return has_names_alone(L);
}

/* {r, g, b}, {r, g, b, a} or "#rrggbb" on top of the stack. */
static celspan_light read_colour(const cs_form *form, const char *name) {
  lua_State *L = form->L;
  int type = lua_type(L, -1);
  celspan_paint paint;
  if (type == LUA_TSTRING && cs_form_colour(lua_tostring(L, -1), &paint))
    return (celspan_light){paint.pigment[0], paint.pigment[1], paint.pigment[2], paint.beta};
  if (type != LUA_TTABLE)
    cs_form_fail(form, "field '%s' must be a light {r, g, b}, {r, g, b, a} or \"#rrggbb\", got %s",
                 name, cs_form_shown_colour(L, -1));
  double n[4] = {0, 0, 0, 1};
  const cs_numbers_name list = {
      .noun = form->noun->name, .field = name, .shape = "a light {r, g, b, a}"};
  cs_numbers_read(L, -1, &list, 3, 4, n);
  return (celspan_light){(float)n[0], (float)n[1], (float)n[2], (float)n[3]};
}

bool cs_light_read(const cs_form *form, const char *name, celspan_light *flat, bool *is_colour,
                   celspan_light_texture *shape) {
  lua_State *L = form->L;
  int type = cs_form_get(form, name);
  *is_colour = type == LUA_TSTRING;
  if (cs_userdata_test(L, -1, &cs_kind_texture) || cs_userdata_test(L, -1, &cs_kind_paint)) {
    shape->texture = cs_form_texture(form, name);
    return true;
  }
  if (is_shape(L)) {
    const char *light = lua_pushfstring(L, "%s: %s", form->noun->name, name);
    lua_insert(L, -2); /* the name stays below */
    read_shape(L, light, shape);
    return true;
  }
  if (type != LUA_TNIL)
    *flat = read_colour(form, name);
  lua_pop(L, 1);
  return type != LUA_TNIL;
}
