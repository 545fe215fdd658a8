#include "bind/light.h"

#include "bind/userdata.h"

static const cs_field fields[] = {{"texture", NULL}, {"gain", "1"}, {"on", "frame"}, {"matte", "1"}, {0}};
static const cs_noun noun = {.name = "light", .fields = fields};

/* { texture =, gain =, on =, matte = } on top of the stack. light: what it is called, "cel: front". */
static void read_shape(lua_State *L, const char *light, celspan_light_texture *out) {
  static const char *const places[] = {"frame", "cel", NULL};
  cs_noun named = noun;
  named.name = light;
  cs_form form = cs_form_open(L, &named, -1);
  out->gain = cs_form_number_or(&form, "gain", 1);
  out->on = (celspan_light_place)cs_form_choice(&form, "on", places);
  out->matte = cs_form_number_or(&form, "matte", 1);
  out->texture = cs_form_texture(&form, "texture");
  if (!out->texture)
    cs_form_fail(&form, "field 'texture' is missing");
}

static bool has_field(lua_State *L, const char *name) {
  lua_pushstring(L, name);
  bool found = lua_rawget(L, -2) != LUA_TNIL;
  lua_pop(L, 1);
  return found;
}

/* Whether the value on top of the stack is a table of names alone, but those of colours, which are
 * told where the numbers go. */
static bool has_names_alone(lua_State *L) {
  return lua_rawlen(L, -1) == 0 && !has_field(L, "r") && !has_field(L, "g") && !has_field(L, "b") &&
         (lua_pushnil(L), lua_next(L, -2)) && (lua_pop(L, 2), true);
}

/* Whether it is a light with a shape, well or badly described. */
static bool is_shape(lua_State *L) {
  if (!lua_istable(L, -1))
    return false;
  for (const cs_field *field = fields; field->name; field++)
    if (has_field(L, field->name))
      return true;
  return has_names_alone(L);
}

bool cs_light_read(const cs_form *form, const char *name, celspan_light *flat,
                   celspan_light_texture *shape) {
  lua_State *L = form->L;
  lua_pushstring(L, name);
  lua_rawget(L, form->table);
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
  lua_pop(L, 1);
  return cs_form_light(form, name, flat);
}
