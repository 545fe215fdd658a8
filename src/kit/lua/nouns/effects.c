/* object:blur, object:displace, object:sharpen, object:shadow, object:glow and object:outline; cels
 * have the last three.
 * The result is a value with the object as its list and the options as its fields. */
#include "inside/colour.h"
#include "lua/bind/caller.h"
#include "lua/bind/construct.h"
#include "lua/bind/fields.h"
#include "lua/bind/host.h"
#include "lua/nouns/nouns.h"
#include "lua/nouns/shape.h"

const char *const cs_nouns_kernels[] = {"gaussian", "box", "disc", "pixel", NULL};
const char *const cs_nouns_edges[] = {"clear", "extend", NULL};

/* ---------------------------------------------------------------- nouns */

#define CREATE(effect, FIELDS)                                                                     \
  static void create_##effect(const cs_form *form, cs_userdata *value) {                           \
    celspan_##effect##_desc desc = FIELDS;                                                         \
    celspan_object **object = cs_shape_items(form, 1), *made = NULL;                               \
    cs_fields_read(form, &desc);                                                                   \
    cs_form_try(form, celspan_object_##effect(cs_host_context(form->L), object[0], &desc, &made)); \
    value->handle = made;                                                                          \
  }
CREATE(sharpen, CELSPAN_SHARPEN_DESC)
CREATE(shadow, CELSPAN_SHADOW_DESC)
CREATE(glow, CELSPAN_GLOW_DESC)
CREATE(outline, CELSPAN_OUTLINE_DESC)

#define RADIUS .least = 0, .most = CELSPAN_BLUR_MOST

/* A blur along a line, a ray or an arc, if one of these fields is given. */
static celspan_blur_along find_along(const cs_form *form) {
  static const char *const names[] = {"angle", "zoom", "spin"};
  celspan_blur_along along = CELSPAN_BLUR_AROUND;
  for (int i = 0; i < 3; i++) {
    if (!cs_form_has(form, names[i]))
      continue;
    if (along != CELSPAN_BLUR_AROUND)
      cs_form_fail(form, "give only one of 'angle', 'zoom' and 'spin'");
    along = (celspan_blur_along)(CELSPAN_BLUR_LINE + i);
  }
  if (along != CELSPAN_BLUR_AROUND && cs_form_has(form, "kernel"))
    cs_form_fail(form, "'kernel' does not go with 'angle', 'zoom' or 'spin', which are even");
  return along;
}

static void create_blur(const cs_form *form, cs_userdata *value) {
  celspan_blur_desc desc = CELSPAN_BLUR_DESC;
  celspan_object **object = cs_shape_items(form, 1), *made = NULL;
  cs_fields_read(form, &desc);
  desc.along = find_along(form);
  cs_form_try(form, celspan_object_blur(cs_host_context(form->L), object[0], &desc, &made));
  value->handle = made;
}

static const cs_field blur_rows[] = {
    {"radius", CS_NUMBER(celspan_blur_desc, radius), RADIUS, .is_required = true,
     .about = "As of defocus, in the object's units"},
    {"kernel", CS_CHOICE(celspan_blur_desc, kernel, cs_nouns_kernels), .preset = "gaussian"},
    {"edge", CS_CHOICE(celspan_blur_desc, edge, cs_nouns_edges), .preset = "clear",
     .about = "Beyond its bounds: nothing, or what lies on their edge"},
    {"angle", CS_NUMBER(celspan_blur_desc, degrees),
     .about = "Along a line: degrees, clockwise from the right"},
    {"zoom", CS_POINT(celspan_blur_desc, centre),
     .about = "Along rays from this point; radius: per cent of the distance, at most 90"},
    {"spin", CS_POINT(celspan_blur_desc, centre),
     .about = "Along arcs about this point; radius: degrees, at most 180"},
    {0}};
const cs_noun cs_noun_blur = {CS_FROM_OBJECT(blur, "How an object is blurred.")};

typedef struct displace_fields {
  celspan_displace_desc desc;
  int space; /* the space of cs_space_words */
} displace_fields;

static void create_displace(const cs_form *form, cs_userdata *value) {
  displace_fields fields = {CELSPAN_DISPLACE_DESC, CELSPAN_SPACE_SRGB - CELSPAN_SPACE_LINEAR};
  celspan_object **object = cs_shape_items(form, 1), *made = NULL;
  cs_fields_read(form, &fields);
  fields.desc.space = (celspan_space)(CELSPAN_SPACE_LINEAR + fields.space);
  cs_form_get(form, "by");
  cs_userdata *by = cs_shape_at(form->L, -1);
  if (!by)
    cs_form_fail(form, "field 'by' must be an object, got %s", cs_userdata_type(form->L, -1));
  fields.desc.by = by->handle; /* the table or the stack keeps it alive */
  cs_form_try(form,
              celspan_object_displace(cs_host_context(form->L), object[0], &fields.desc, &made));
  value->handle = made;
}

static const char *const channels[] = {"r", "g", "b", "a", NULL};
static const cs_field displace_rows[] = {
    {"by", CS_OWN("celspan.shape"), .is_required = true,
     .about = "The object whose colours say how far, in the object's units"},
    {"x", CS_CHOICE(displace_fields, desc.x, channels), .preset = "r",
     .about = "The channel that moves along x"},
    {"y", CS_CHOICE(displace_fields, desc.y, channels), .preset = "g",
     .about = "The channel that moves along y"},
    {"scale", CS_NUMBER(displace_fields, desc.scale), .least = -CELSPAN_BLUR_MOST,
     .most = CELSPAN_BLUR_MOST, .preset = "20",
     .about = "Units between the points that black and white show"},
    {"space", CS_CHOICE(displace_fields, space, cs_space_words), .preset = "srgb",
     .about = "Of the channels: codes, or light"},
    {0}};
const cs_noun cs_noun_displace = {CS_FROM_OBJECT(displace, "How an object is displaced.")};

static const cs_field sharpen_rows[] = {
    {"radius", CS_NUMBER(celspan_sharpen_desc, radius), .least = 0,
     .most = CELSPAN_SHARPEN_RADIUS_MOST, .preset = "2",
     .about = "Of the blur that it is compared with"},
    {"amount", CS_NUMBER(celspan_sharpen_desc, amount), .least = 0, .most = CELSPAN_SHARPEN_MOST,
     .preset = "1", .about = "How often the difference is added"},
    {0}};
const cs_noun cs_noun_sharpen = {CS_FROM_OBJECT(sharpen, "How an object is sharpened.")};

static const cs_field shadow_rows[] = {
    {"offset", CS_POINT(celspan_shadow_desc, offset), .about = "How far the shadow is moved",
     .fallback = "{0, 0}"},
    {"blur", CS_NUMBER(celspan_shadow_desc, blur), RADIUS, .preset = "0",
     .about = "The radius that it is blurred by"},
    {"colour", CS_SURFACE(celspan_shadow_desc, colour), .preset = "#000000"},
    {"opacity", CS_NUMBER(celspan_shadow_desc, opacity), .preset = "1", .about = "Limited to 0..1"},
    {"inside", CS_FLAG(celspan_shadow_desc, is_inside),
     .about = "Whether it lies within the object, over it", .fallback = "false"},
    {"only", CS_FLAG(celspan_shadow_desc, is_alone),
     .about = "Whether the object itself is left out", .fallback = "false"},
    {0}};
const cs_noun cs_noun_shadow = {CS_FROM_OBJECT(shadow, "What shadow an object has.")};

static const cs_field glow_rows[] = {
    {"radius", CS_NUMBER(celspan_glow_desc, radius), RADIUS, .is_required = true,
     .about = "As of a blur"},
    {"colour", CS_SURFACE(celspan_glow_desc, colour), .is_required = true},
    {"gain", CS_NUMBER(celspan_glow_desc, gain), CS_FROM(0), .preset = "1",
     .about = "What its light is multiplied by"},
    {0}};
const cs_noun cs_noun_glow = {CS_FROM_OBJECT(glow, "How an object glows.")};

static const cs_field outline_rows[] = {
    {"width", CS_NUMBER(celspan_outline_desc, width), RADIUS, .is_required = true,
     .about = "How far it reaches beyond the shape"},
    {"texture", CS_SURFACE(celspan_outline_desc, texture), .preset = "#000000"},
    {"join", CS_CHOICE(celspan_outline_desc, join, cs_nouns_joins), .preset = "round",
     .about = "At the corners of shapes"},
    {"blur", CS_NUMBER(celspan_outline_desc, blur), RADIUS, .preset = "0",
     .about = "The radius that it is blurred by"},
    {"opacity", CS_NUMBER(celspan_outline_desc, opacity), .preset = "1",
     .about = "Limited to 0..1"},
    {"only", CS_FLAG(celspan_outline_desc, is_alone),
     .about = "Whether the object itself is left out", .fallback = "false"},
    {0}};
const cs_noun cs_noun_outline = {CS_FROM_OBJECT(outline, "What outline an object has.")};

/* ---------------------------------------------------------------- methods */

/* Pushes a copy of the options at `options`, with the object at `object` as its list. */
static void push_options(lua_State *L, const cs_noun *noun, int options, int object) {
  if (lua_isnoneornil(L, options))
    lua_createtable(L, 1, 1);
  else if (lua_istable(L, options))
    cs_userdata_push_copy(L, options, 2);
  else
    cs_caller_error(L, "%s: its options must be a table, got %s", noun->name,
                    cs_userdata_type(L, options));
  lua_pushvalue(L, object);
  lua_rawseti(L, -2, 1);
}

static void check_object(lua_State *L, const cs_noun *noun) {
  if (!cs_shape_at(L, 1))
    cs_userdata_self(L, &cs_kind_object, noun->name);
}

int cs_nouns_blur(lua_State *L) {
  lua_settop(L, 3);
  check_object(L, &cs_noun_blur);
  push_options(L, &cs_noun_blur, 3, 1);
  lua_pushnumber(L, cs_form_argument(L, 2, "blur", "the radius"));
  lua_setfield(L, 4, "radius");
  cs_construct_value(L, &cs_noun_blur, 4);
  return 1;
}

/* The cel at index 1, with all its objects joined into one object that has the effect. */
static int change_cel(lua_State *L, const cs_noun *noun) {
  cs_userdata_push_fields(L, 1);
  lua_newtable(L);
  int count = (int)lua_rawlen(L, 3);
  for (int i = 1; i <= count; i++) {
    lua_rawgeti(L, 3, i);
    lua_rawseti(L, 4, i);
  }
  cs_construct_value(L, &cs_noun_group, 4);
  push_options(L, noun, 2, lua_gettop(L));
  cs_construct_value(L, noun, lua_gettop(L));
  lua_createtable(L, 1, 0);
  lua_insert(L, 2);
  lua_rawseti(L, 2, 1);
  lua_settop(L, 2);
  return cs_construct_with(L);
}

/* The object at index 1 with the effect. */
static int change_object(lua_State *L, const cs_noun *noun) {
  lua_settop(L, 2);
  check_object(L, noun);
  push_options(L, noun, 2, 1);
  cs_construct_value(L, noun, 3);
  return 1;
}

static int apply(lua_State *L, const cs_noun *noun) {
  lua_settop(L, 2);
  return cs_userdata_test(L, 1, &cs_kind_cel) ? change_cel(L, noun) : change_object(L, noun);
}

int cs_nouns_displace(lua_State *L) { return change_object(L, &cs_noun_displace); }

int cs_nouns_sharpen(lua_State *L) { return change_object(L, &cs_noun_sharpen); }

int cs_nouns_shadow(lua_State *L) { return apply(L, &cs_noun_shadow); }

int cs_nouns_glow(lua_State *L) { return apply(L, &cs_noun_glow); }

int cs_nouns_outline(lua_State *L) { return apply(L, &cs_noun_outline); }
