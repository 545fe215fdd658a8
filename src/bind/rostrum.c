/* The rostrum: cels, lights, camera. */
#include "bind/construct.h"
#include "bind/host.h"
#include "bind/light.h"
#include "bind/named.h"
#include "bind/openers.h"
#include "bind/options.h"
#include "bind/placed.h"
#include "bind/userdata.h"

static void unref(void *handle) { celspan_rostrum_unref(handle); }

const cs_kind cs_kind_rostrum = {
    .name = "celspan.rostrum", .unref = unref, .push_field = cs_named_push_field};

static const cs_field camera_fields[] = {{"centre", NULL}, {"width", NULL}, {"rotate", NULL}, {0}};
static const cs_noun noun_camera = {.name = "rostrum: camera", .fields = camera_fields};

static void read_camera(const cs_form *form, celspan_rostrum_desc *desc) {
  lua_State *L = form->L;
  lua_pushliteral(L, "camera");
  if (lua_rawget(L, form->table) == LUA_TNIL)
    return;
  cs_form inner = cs_form_open(L, &noun_camera, -1);
  desc->has_camera_centre = cs_form_point_or(&inner, "centre", &desc->camera_centre);
  desc->has_camera_width = cs_form_has(&inner, "width");
  desc->camera_width = cs_form_number_or(&inner, "width", 0);
  desc->camera_rotation = cs_placed_radians(cs_form_number_or(&inner, "rotate", 0));
}

/* The cels of the array part: scratch memory, left on the stack. */
static celspan_cel **read_cels(const cs_form *form, int count) {
  lua_State *L = form->L;
  celspan_cel **cels = cs_form_scratch(L, (size_t)count, sizeof *cels);
  lua_createtable(L, count, 0); /* holds them, as cs_shape_items does objects */
  int kept = lua_gettop(L);
  for (int i = 0; i < count; i++) {
    lua_rawgeti(L, form->table, i + 1);
    cs_userdata *item = cs_userdata_test(L, -1, &cs_kind_cel);
    if (!item)
      cs_form_fail(form, "item %d must be a cel, got %s", i + 1, cs_userdata_type(L, -1));
    cels[i] = item->handle;
    lua_rawseti(L, kept, i + 1);
  }
  return cels;
}

static celspan_rostrum *create_rostrum(const cs_form *form) {
  celspan_rostrum_desc desc = CELSPAN_ROSTRUM_DESC;
  double size[2] = {0, 0};
  int count = cs_form_length(form);
  desc.cels = read_cels(form, count);
  desc.cel_count = (size_t)count;
  desc.has_front = cs_light_read(form, "front", &desc.front, &desc.front_texture);
  cs_light_read(form, "back", &desc.back, &desc.back_texture);
  desc.brightness = cs_form_number_or(form, "brightness", 1);
  desc.has_size = cs_form_numbers(form, "size", 2, size);
  desc.width = size[0];
  desc.height = size[1];
  read_camera(form, &desc);
  cs_options_antialias(form, &desc.antialias, &desc.filter);
  celspan_rostrum *rostrum = NULL;
  cs_form_try(form, celspan_rostrum_create(cs_host_context(form->L), &desc, &rostrum));
  return rostrum;
}

static void create(const cs_form *form, cs_userdata *value) {
  value->handle = create_rostrum(form);
}

/* The object that a rostrum is inside a cel: made again by :with. */
static void create_object(const cs_form *form, cs_userdata *value) {
  celspan_rostrum *rostrum = create_rostrum(form);
  celspan_object *object = NULL;
  celspan_status status = celspan_object_create_rostrum(cs_host_context(form->L), rostrum, &object);
  celspan_rostrum_unref(rostrum);
  cs_form_try(form, status);
  value->handle = object;
}

static const cs_field fields[] = {{"front", NULL},
                                  {"back", NULL},
                                  {"brightness", "1"},
                                  {"camera", NULL},
                                  {"antialias", "area"},
                                  {"size", NULL},
                                  {0}};
const cs_noun cs_noun_rostrum = {.name = "rostrum",
                                 .kind = &cs_kind_rostrum,
                                 .list = CS_LIST_ITEMS,
                                 .item = "cel",
                                 .fields = fields,
                                 .create = create};

const cs_noun cs_noun_rostrum_object = {.name = "rostrum",
                                        .kind = &cs_kind_object,
                                        .list = CS_LIST_ITEMS,
                                        .item = "cel",
                                        .fields = fields,
                                        .create = create_object};

void cs_open_rostrum(lua_State *L) {
  cs_userdata_register(L, &cs_kind_rostrum, cs_placed_methods);
  cs_construct_push(L, &cs_noun_rostrum);
  lua_setfield(L, -2, cs_noun_rostrum.name);
}
