#include "lua/nouns/nouns.h"

#include "lua/bind/put.h"
#include "lua/bind/suggest.h"
#include "lua/nouns/options.h"

const cs_noun *const cs_nouns_made[] = {&cs_noun_paint,
                                        &cs_noun_gradient,
                                        &cs_noun_linear,
                                        &cs_noun_radial,
                                        &cs_noun_conic,
                                        &cs_noun_noise,
                                        &cs_noun_picture,
                                        &cs_noun_pattern,
                                        &cs_noun_rect,
                                        &cs_noun_triangle,
                                        &cs_noun_circle,
                                        &cs_noun_ellipse,
                                        &cs_noun_polygon,
                                        &cs_noun_nurbs,
                                        &cs_noun_path,
                                        &cs_noun_stroke,
                                        &cs_noun_image,
                                        &cs_noun_text,
                                        &cs_noun_scanline,
                                        &cs_noun_union,
                                        &cs_noun_intersection,
                                        &cs_noun_difference,
                                        &cs_noun_xor,
                                        &cs_noun_group,
                                        &cs_noun_key,
                                        &cs_noun_cel,
                                        &cs_noun_rostrum,
                                        &cs_noun_film,
                                        NULL};

const cs_noun *const cs_nouns_tables[] = {&cs_noun_stroke_style, &cs_noun_glyph,
                                          &cs_noun_matte,        &cs_noun_blur,
                                          &cs_noun_displace,     &cs_noun_sharpen,
                                          &cs_noun_shadow,       &cs_noun_glow,
                                          &cs_noun_outline,      &cs_noun_light,
                                          &cs_noun_defocus,      &cs_noun_grain,
                                          &cs_noun_grade,        &cs_noun_camera,
                                          &cs_noun_filter,       &cs_noun_frame,
                                          &cs_noun_sound,        &cs_noun_render,
                                          &cs_noun_pixels,       &cs_noun_bytes,
                                          &cs_noun_write,        &cs_noun_spans,
                                          &cs_noun_probe,        &cs_noun_plane,
                                          &cs_noun_plane_view,   NULL};

/* ---------------------------------------------------------------- descriptions */

/* The type of a field in annotations, by cs_type; the type of a choice is made of its words. */
static const char *const written[] = {NULL,     "number",   "integer",   "boolean",        NULL,
                                      "string", "number[]", "integer[]", "celspan.surface"};

static void push_choices(lua_State *L, const char *const *words) {
  luaL_Buffer text;
  luaL_buffinit(L, &text);
  for (int i = 0; words[i]; i++) {
    luaL_addstring(&text, i ? "|\"" : "\"");
    luaL_addstring(&text, words[i]);
    luaL_addchar(&text, '"');
  }
  luaL_pushresult(&text);
}

static void push_field(lua_State *L, const cs_noun *noun, const cs_field *field) {
  bool has_place = noun->by_place && noun->list == CS_LIST_NONE;
  lua_createtable(L, 0, 10);
  cs_put_text(L, "name", cs_suggest_shown(field->name));
  if (!field->written && field->choices)
    push_choices(L, field->choices);
  else
    lua_pushstring(L, field->written ? field->written : written[field->type]);
  lua_setfield(L, -2, "type");
  cs_put_text(L, "read", field->read);
  cs_put_text(L, "shape", field->type == CS_TYPE_OWN ? NULL : field->shape);
  cs_put_text(L, "preset", field->preset);
  cs_put_text(L, "about", field->about);
  cs_put_text(L, "fallback", field->fallback);
  cs_put_flag(L, "is_required", field->is_required && !has_place);
  if (field->least >= field->most)
    return;
  cs_put_number(L, field->is_above ? "above" : "least", field->least);
  cs_put_number(L, field->most < CS_NUMBER_LIMIT ? "most" : "limit", field->most);
}

static void push_noun(lua_State *L, const cs_noun *noun) {
  lua_Integer count = 0;
  lua_newtable(L);
  cs_put_text(L, "name", noun->name);
  cs_put_text(L, "about", noun->about);
  cs_put_text(L, "table", noun->table);
  cs_put_text(L, "item", noun->item_written);
  cs_put_text(L, "items", noun->item_about);
  for (const cs_field *field = noun->fields; field->name; field = cs_field_next(field)) {
    push_field(L, noun, field);
    lua_rawseti(L, -2, ++count);
  }
}

int cs_nouns_push(lua_State *L) {
  const cs_noun *const *const lists[] = {cs_nouns_made, cs_nouns_tables};
  lua_newtable(L);
  for (int i = 0; i < 2; i++)
    for (const cs_noun *const *noun = lists[i]; *noun; noun++) {
      push_noun(L, *noun);
      lua_setfield(L, -2, (*noun)->name);
    }
  return 1;
}
