/* celspan.group, celspan.key and celspan.matte: objects that are composited by themselves. */
#include "inside/colour.h"
#include "lua/bind/caller.h"
#include "lua/bind/construct.h"
#include "lua/bind/fields.h"
#include "lua/bind/host.h"
#include "lua/nouns/grade.h"
#include "lua/nouns/nouns.h"
#include "lua/nouns/shape.h"
#include "lua/nouns/space.h"

/* ---------------------------------------------------------------- groups */

typedef struct group_fields {
  celspan_group_desc desc;
  bool has_isolate, isolate;
  cs_own_space space;
} group_fields;

static void create_group(const cs_form *form, cs_userdata *value) {
  group_fields fields = {.desc = CELSPAN_GROUP_DESC};
  int count = cs_form_length(form);
  celspan_object *group = NULL;
  fields.desc.objects = cs_shape_items(form, count);
  fields.desc.object_count = (size_t)count;
  cs_fields_read(form, &fields);
  if (fields.has_isolate)
    fields.desc.isolate = fields.isolate ? CELSPAN_ISOLATION_ON : CELSPAN_ISOLATION_OFF;
  fields.desc.space = cs_own_space_of(&fields.space);
  fields.desc.grade = cs_grade_of(form);
  celspan_status status =
      celspan_object_create_group(cs_host_context(form->L), &fields.desc, &group);
  celspan_grade_unref(fields.desc.grade);
  cs_form_try(form, status);
  value->handle = group;
}

#define FIELDS group_fields
static const cs_field group_rows[] = {
    {"opacity", CS_NUMBER(FIELDS, desc.opacity), .preset = "1",
     .about = "Of the group as a whole; limited to 0..1"},
    {"blend", CS_CHOICE(FIELDS, desc.blend, cs_blend_words), .written = "celspan.mode",
     .about = "How it is combined with its backdrop", .fallback = "normal"},
    CS_OWN_SPACE(FIELDS, space, "the space around it"),
    CS_GRADE_FIELD,
    {"isolate", CS_FLAG(FIELDS, isolate), CS_HAS(FIELDS, has_isolate),
     .about = "Whether modes inside act only inside",
     .fallback = "true if it is faded, has a mode, a grade, or another space than what it "
                 "is in"},
    {0}};
const cs_noun cs_noun_group = {.name = "group",
                               .about = "Objects that are composited by themselves, then put into "
                                        "the picture as one.",
                               .kind = &cs_kind_object,
                               CS_ITEMS("object", "celspan.shape"),
                               .fields = group_rows,
                               .create = create_group};

/* ---------------------------------------------------------------- keys */

typedef struct key_fields {
  celspan_key_desc desc;
  bool is_luma;
} key_fields;

/* By luma there is neither a screen nor its spill. */
static void check_luma(const cs_form *form) {
  static const char *const of_colour[] = {"tolerance", "softness", "spill"};
  for (size_t i = 0; i < sizeof of_colour / sizeof *of_colour; i++)
    if (cs_form_has(form, of_colour[i]))
      cs_form_fail(form, "field '%s' goes with 'colour'; with luma = true, give 'from' and 'to'",
                   of_colour[i]);
}

static void create_key(const cs_form *form, cs_userdata *value) {
  key_fields fields = {.desc = CELSPAN_KEY_DESC};
  int count = cs_form_length(form);
  celspan_object **art = cs_shape_items(form, count), *key = NULL;
  if (count != 1)
    cs_form_fail(form, "it takes one object, got %d; make a group of several", count);
  cs_fields_read(form, &fields);
  if (fields.is_luma)
    check_luma(form);
  fields.desc.by = fields.is_luma ? CELSPAN_KEY_LUMA : CELSPAN_KEY_CHROMA;
  cs_form_try(form, celspan_object_key(cs_host_context(form->L), art[0], &fields.desc, &key));
  value->handle = key;
}

#define KEY key_fields
static const cs_field key_rows[] = {
    {"colour", CS_SURFACE(KEY, desc.colour), .about = "Of the screen; not grey",
     .fallback = "\"#0b0\""},
    {"tolerance", CS_NUMBER(KEY, desc.tolerance), CS_FROM(0),
     .about = "Clear where Cb and Cr are as near as this to the colour's", .fallback = "0.2"},
    {"softness", CS_NUMBER(KEY, desc.softness), CS_FROM(0),
     .about = "How much farther away it is whole", .fallback = "0.1"},
    {"spill", CS_NUMBER(KEY, desc.spill), .most = 1,
     .about = "The part of the screen's light in the art that is taken off", .fallback = "1"},
    {"luma", CS_FLAG(KEY, is_luma), .about = "By brightness, not by hue", .fallback = "false"},
    {"from", CS_NUMBER(KEY, desc.from), .about = "The code of luma at which it is clear",
     .fallback = "0"},
    {"to", CS_NUMBER(KEY, desc.to), .about = "And at which it is whole", .fallback = "1"},
    {0}};
static const char *const of_luma[] = {"from", "to", NULL};
const cs_noun cs_noun_key = {.name = "key",
                             .about = "An object, clear where it has the colour of a screen.",
                             .kind = &cs_kind_object,
                             CS_ITEMS("object", "celspan.shape"),
                             .fields = key_rows,
                             .either = {"colour", "luma"},
                             .second = of_luma,
                             .create = create_key};

/* ---------------------------------------------------------------- mattes */

static void create_matte(const cs_form *form, cs_userdata *value) {
  celspan_matte_desc desc = CELSPAN_MATTE_DESC;
  celspan_object **both = cs_shape_items(form, 2), *matte = NULL;
  cs_fields_read(form, &desc);
  cs_form_try(form,
              celspan_object_matte(cs_host_context(form->L), both[0], both[1], &desc, &matte));
  value->handle = matte;
}

#define MATTE celspan_matte_desc
static const char *const sources[] = {"alpha", "luma", "dissolve", NULL};
static const cs_field matte_rows[] = {
    {"from", CS_CHOICE(MATTE, from, sources), .preset = "alpha",
     .about = "What of the matte counts"},
    {"invert", CS_FLAG(MATTE, invert), .about = "The art is present where the matte is not",
     .fallback = "false"},
    {"grow", CS_NUMBER(MATTE, grow), .least = -CELSPAN_BLUR_MOST, .most = CELSPAN_BLUR_MOST,
     .preset = "0", .about = "Units that the matte grows by; below 0 it is choked"},
    {"feather", CS_NUMBER(MATTE, feather), .most = CELSPAN_BLUR_MOST, .preset = "0",
     .about = "The radius of its blur"},
    {0}};
const cs_noun cs_noun_matte = {CS_FROM_OBJECT(matte, "How a matte is used.")};

static void check_objects(lua_State *L) {
  static const char *const names[] = {"the art", "what it is matted by"};
  for (int i = 1; i <= 2; i++)
    if (!cs_shape_at(L, i))
      cs_caller_error(L, "matte: argument %d, %s, must be an object, got %s", i, names[i - 1],
                      cs_userdata_type(L, i));
}

/* The fields of the value: the options, and the two objects as its list. */
int cs_nouns_matte(lua_State *L) {
  lua_settop(L, 3);
  check_objects(L);
  if (!lua_isnil(L, 3) && !lua_istable(L, 3))
    return cs_caller_error(L,
                           "matte: argument 3 must be a table {from =, invert =, grow =, "
                           "feather =}, got %s",
                           cs_userdata_type(L, 3));
  lua_createtable(L, 2, 2);
  for (int i = 1; i <= 2; i++) {
    lua_pushvalue(L, i);
    lua_rawseti(L, -2, i);
  }
  if (lua_istable(L, 3))
    for (lua_pushnil(L); lua_next(L, 3); lua_pop(L, 1)) {
      lua_pushvalue(L, -2);
      lua_pushvalue(L, -2);
      lua_rawset(L, 4);
    }
  cs_construct_value(L, &cs_noun_matte, 4);
  return 1;
}
