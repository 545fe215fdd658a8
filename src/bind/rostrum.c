/* The rostrum: cels, lights, camera. */
#include "bind/construct.h"
#include "bind/host.h"
#include "bind/openers.h"
#include "bind/options.h"
#include "bind/placed.h"
#include "bind/userdata.h"

static void unref(void *handle) { celspan_rostrum_unref(handle); }

const cs_kind cs_kind_rostrum = {.name = "celspan.rostrum", .unref = unref};

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

static void create(const cs_form *form, cs_userdata *value) {
  lua_State *L = form->L;
  celspan_rostrum_desc desc = CELSPAN_ROSTRUM_DESC;
  int count = cs_form_length(form);
  celspan_cel **cels = cs_form_scratch(L, (size_t)count, sizeof *cels);
  for (int i = 0; i < count; i++) {
    lua_rawgeti(L, form->table, i + 1);
    cs_userdata *item = cs_userdata_test(L, -1, &cs_kind_cel);
    if (!item)
      cs_form_fail(form, "item %d must be a cel, got %s", i + 1, cs_userdata_type(L, -1));
    cels[i] = item->handle;
    lua_pop(L, 1);
  }
  desc.cels = cels;
  desc.cel_count = (size_t)count;
  desc.has_front = cs_form_light(form, "front", &desc.front);
  cs_form_light(form, "back", &desc.back);
  desc.brightness = cs_form_number_or(form, "brightness", 1);
  read_camera(form, &desc);
  cs_options_antialias(form, &desc.antialias, &desc.filter);
  celspan_rostrum *rostrum = NULL;
  cs_form_try(form, celspan_rostrum_create(cs_host_context(L), &desc, &rostrum));
  value->handle = rostrum;
}

static const cs_field fields[] = {{"front", NULL},  {"back", NULL},        {"brightness", "1"},
                                  {"camera", NULL}, {"antialias", "area"}, {0}};
const cs_noun cs_noun_rostrum = {.name = "rostrum",
                                 .kind = &cs_kind_rostrum,
                                 .list = CS_LIST_ITEMS,
                                 .item = "cel",
                                 .fields = fields,
                                 .create = create};

void cs_open_rostrum(lua_State *L) {
  static const luaL_Reg methods[] = {{"with", cs_construct_with}, {NULL, NULL}};
  cs_userdata_register(L, &cs_kind_rostrum, methods);
  cs_construct_push(L, &cs_noun_rostrum);
  lua_setfield(L, -2, cs_noun_rostrum.name);
}
