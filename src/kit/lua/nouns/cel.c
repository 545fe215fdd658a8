/* celspan.cel: a list of objects with its own lights and defocus. */
#include "inside/colour.h"
#include "lua/bind/construct.h"
#include "lua/bind/fields.h"
#include "lua/bind/host.h"
#include "lua/nouns/grade.h"
#include "lua/nouns/grain.h"
#include "lua/nouns/light.h"
#include "lua/nouns/nouns.h"
#include "lua/nouns/shape.h"

#define DESC celspan_cel_desc
static const cs_field defocus_fields[] = {
    {"radius", CS_NUMBER(DESC, defocus_radius), CS_FROM(0), .is_required = true,
     .about = "Film units on the frame"},
    {"kernel", CS_CHOICE(DESC, defocus_kernel, cs_nouns_kernels), .preset = "gaussian"},
    {"edge", CS_CHOICE(DESC, defocus_edge, cs_nouns_edges), .preset = "clear",
     .about = "Beyond the frame: the art, or what lies on its edge"},
    {0}};
const cs_noun cs_noun_defocus = {.name = "cel: defocus",
                                 .about = "How far a cel is out of focus.",
                                 .table = "celspan.defocus",
                                 .fields = defocus_fields};

/* The field `defocus` is a number or { radius =, kernel =, edge = }. */
static void read_defocus(const cs_form *form, celspan_cel_desc *desc) {
  lua_State *L = form->L;
  int type = cs_form_get(form, "defocus");
  if (type == LUA_TNUMBER)
    desc->defocus_radius = lua_tonumber(L, -1);
  else if (type == LUA_TTABLE) {
    cs_form inner = cs_form_open(L, &cs_noun_defocus, -1);
    cs_fields_read(&inner, desc);
  } else if (type != LUA_TNIL)
    cs_form_fail(form, "field 'defocus' must be a radius or {radius =, kernel =, edge =}, got %s",
                 cs_userdata_type(L, -1));
}

static void create(const cs_form *form, cs_userdata *value) {
  lua_State *L = form->L;
  celspan_cel_desc desc = CELSPAN_CEL_DESC;
  int count = cs_form_length(form);
  desc.objects = cs_shape_items(form, count);
  desc.object_count = (size_t)count;
  celspan_object *grainy = NULL;
  if (cs_grain_push_object(form)) {
    grainy = ((const cs_userdata *)lua_touserdata(L, -1))->handle; /* the stack keeps it alive */
    desc.objects = &grainy;
    desc.object_count = 1;
  }
  desc.has_front =
      cs_light_read(form, "front", &desc.front, &desc.front_is_colour, &desc.front_texture);
  cs_light_read(form, "back", &desc.back, &desc.back_is_colour, &desc.back_texture);
  read_defocus(form, &desc);
  cs_fields_read(form, &desc);
  desc.grade = cs_grade_of(form);
  celspan_cel *cel = NULL;
  celspan_status status = celspan_cel_create(cs_host_context(L), &desc, &cel);
  celspan_grade_unref(desc.grade);
  cs_form_try(form, status);
  value->handle = cel;
}

int cs_nouns_cel_of(lua_State *L) {
  const cs_userdata *object = cs_userdata_any(L, 1);
  lua_createtable(L, 1, 0);
  lua_pushvalue(L, 1);
  lua_rawseti(L, -2, 1);
  cs_construct_like(L, &cs_noun_cel, -1, object);
  return 1;
}

static const cs_field fields[] = {
    {"front", CS_OWN("celspan.light"), .fallback = "that of the rostrum, else white"},
    {"back", CS_OWN("celspan.light"),
     .about = "Shines through the whole frame from behind this cel", .fallback = "none"},
    {"viewport", CS_BOX(DESC, viewport), CS_HAS(DESC, has_viewport),
     .about = "The part that fills the frame"},
    {"defocus", CS_OWN("number|celspan.defocus"), .about = "A radius, or with a kernel"},
    {"blend", CS_CHOICE(DESC, blend, cs_blend_words), .written = "celspan.mode",
     .about = "How it is combined with its backdrop", .fallback = "normal"},
    CS_GRADE_FIELD,
    CS_GRAIN_FIELD,
    {"opacity", CS_NUMBER(DESC, opacity), .preset = "1", .about = "Limited to 0..1"},
    {0}};
const cs_noun cs_noun_cel = {.name = "cel",
                             .about = "A sheet with objects and its own lights.",
                             .kind = &cs_kind_cel,
                             CS_ITEMS("object", "celspan.shape"),
                             .fields = fields,
                             .create = create};
