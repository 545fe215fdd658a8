/* The rostrum: cels, lights, camera. */
#include "lua/bind/fields.h"
#include "lua/bind/host.h"
#include "lua/nouns/grade.h"
#include "lua/nouns/grain.h"
#include "lua/nouns/light.h"
#include "lua/nouns/nouns.h"
#include "lua/nouns/options.h"
#include "lua/nouns/placed.h"
#include "lua/nouns/space.h"

#define DESC celspan_rostrum_desc
static const cs_field camera_fields[] = {
    {"centre", CS_POINT(DESC, camera_centre), CS_HAS(DESC, has_camera_centre)},
    {"width", CS_NUMBER(DESC, camera_width), CS_HAS(DESC, has_camera_width), CS_ABOVE_0,
     .about = "Of the visible area"},
    {"rotate", CS_NUMBER(DESC, camera_radians),
     .about = "Degrees; turns the camera, so the picture turns the other way", .fallback = "0"},
    {0}};
const cs_noun cs_noun_camera = {.name = "rostrum: camera",
                                .about = "The part of the film that is visible.",
                                .table = "celspan.camera",
                                .fields = camera_fields};

static void read_camera(const cs_form *form, celspan_rostrum_desc *desc) {
  lua_State *L = form->L;
  if (cs_form_get(form, "camera") == LUA_TNIL)
    return;
  cs_form inner = cs_form_open(L, &cs_noun_camera, -1);
  cs_fields_read(&inner, desc);
  desc->camera_radians = cs_placed_radians(desc->camera_radians);
}

/* The cels of the array part: scratch memory, left on the stack. */
static celspan_cel **read_cels(const cs_form *form, int count) {
  lua_State *L = form->L;
  celspan_cel **cels = cs_form_scratch(L, (size_t)count, sizeof *cels);
  lua_createtable(L, count, 0); /* keeps the cels, as cs_shape_items keeps objects */
  int kept = lua_gettop(L);
  for (int i = 0; i < count; i++) {
    lua_rawgeti(L, form->table, i + 1);
    cs_userdata *item = cs_userdata_test(L, -1, &cs_kind_cel);
    bool is_object = cs_userdata_test(L, -1, &cs_kind_object) != NULL;
    if (!item)
      cs_form_fail(form, "item %d must be a cel, got %s%s", i + 1, cs_userdata_type(L, -1),
                   is_object ? ": put it into celspan.cel { ... }" : "");
    cels[i] = item->handle;
    lua_rawseti(L, kept, i + 1);
  }
  return cels;
}

typedef struct rostrum_form {
  celspan_rostrum_desc desc;
  double size[2];
  cs_own_space space;
} rostrum_form;

static celspan_rostrum *create_rostrum(const cs_form *form) {
  rostrum_form read = {.desc = CELSPAN_ROSTRUM_DESC};
  int count = cs_form_length(form);
  celspan_rostrum_desc *desc = &read.desc;
  desc->cels = read_cels(form, count);
  desc->cel_count = (size_t)count;
  desc->has_front =
      cs_light_read(form, "front", &desc->front, &desc->front_is_colour, &desc->front_texture);
  cs_light_read(form, "back", &desc->back, &desc->back_is_colour, &desc->back_texture);
  cs_fields_read(form, &read);
  desc->space = cs_own_space_of(&read.space);
  desc->width = read.size[0];
  desc->height = read.size[1];
  read_camera(form, desc);
  cs_options_antialias(form, &desc->antialias, &desc->filter);
  desc->grain = cs_grain_push_texture(form);
  desc->grade = cs_grade_of(form);
  celspan_rostrum *rostrum = NULL;
  celspan_status status = celspan_rostrum_create(cs_host_context(form->L), desc, &rostrum);
  celspan_grade_unref(desc->grade);
  cs_form_try(form, status);
  return rostrum;
}

static void create(const cs_form *form, cs_userdata *value) {
  value->handle = create_rostrum(form);
}

/* The object that a rostrum becomes inside a cel; made again by :with. */
static void create_object(const cs_form *form, cs_userdata *value) {
  celspan_rostrum *rostrum = create_rostrum(form);
  celspan_object *object = NULL;
  celspan_status status = celspan_object_create_rostrum(cs_host_context(form->L), rostrum, &object);
  celspan_rostrum_unref(rostrum);
  cs_form_try(form, status);
  value->handle = object;
}

static const cs_field fields[] = {
    {"front", CS_OWN("celspan.light"), .about = "For the cels without their own"},
    {"back", CS_OWN("celspan.light"),
     .about = "Behind the rearmost cel: \"#fff\" is a white ground"},
    {"brightness", CS_NUMBER(rostrum_form, desc.brightness), CS_FROM(0), .preset = "1",
     .about = "Multiplies the light, not alpha"},
    {"camera", CS_OWN("celspan.camera")},
    {"antialias", CS_OWN("celspan.antialias"), .preset = "area"},
    {"size", CS_SIZE(rostrum_form, size), CS_HAS(rostrum_form, desc.has_size),
     .about = "Film units: the size of its own film; required for use as an object"},
    CS_GRADE_FIELD,
    CS_GRAIN_FIELD,
    CS_OWN_SPACE(rostrum_form, space, "that of the film, or of what it is an object of"),
    {0}};
const cs_noun cs_noun_rostrum = {.name = "rostrum",
                                 .about = "Cels under one camera. With a size it is also an "
                                          "object; transforms and fades return that object.",
                                 .kind = &cs_kind_rostrum,
                                 CS_ITEMS("cel", "celspan.cel"),
                                 .fields = fields,
                                 .create = create};

const cs_noun cs_noun_rostrum_object = {.name = "rostrum",
                                        .kind = &cs_kind_object,
                                        .list = CS_LIST_ITEMS,
                                        .has_gaps = true,
                                        .item = "cel",
                                        .fields = fields,
                                        .create = create_object};
