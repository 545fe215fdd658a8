/* celspan.cel: a list of objects with its own transform, fade and defocus. */
#include "bind/construct.h"
#include "bind/form.h"
#include "bind/host.h"
#include "bind/light.h"
#include "bind/named.h"
#include "bind/openers.h"
#include "bind/placed.h"
#include "bind/shape.h"
#include "bind/userdata.h"
#include "scene/bounds.h"

static void unref(void *handle) { celspan_cel_unref(handle); }

static celspan_status transform(celspan_context *context, void *handle,
                                const celspan_matrix *matrix, void **out) {
  celspan_cel *cel = NULL;
  celspan_status status = celspan_cel_transform(context, handle, matrix, &cel);
  if (status == CELSPAN_OK)
    *out = cel;
  return status;
}

static celspan_status fade(celspan_context *context, void *handle, double k, void **out) {
  celspan_cel *cel = NULL;
  celspan_status status = celspan_cel_fade(context, handle, k, &cel);
  if (status == CELSPAN_OK)
    *out = cel;
  return status;
}

static celspan_status bounds(celspan_context *context, const void *handle, bool *is_there,
                             celspan_box *out) {
  return cs_bounds_cel(context, handle, is_there, out);
}

static bool contains(const void *handle, celspan_point point) {
  return celspan_cel_contains(handle, point);
}

const cs_kind cs_kind_cel = {.name = "celspan.cel",
                             .unref = unref,
                             .transform = transform,
                             .fade = fade,
                             .bounds = bounds,
                             .contains = contains,
                             .push_field = cs_named_push_field};

static const cs_field defocus_fields[] = {{"radius", NULL}, {"kernel", "gaussian"}, {0}};
static const cs_noun noun_defocus = {.name = "cel: defocus", .fields = defocus_fields};

/* The field `defocus` is a number or { radius =, kernel = }. */
static void read_defocus(const cs_form *form, celspan_cel_desc *desc) {
  static const char *const kernels[] = {"gaussian", "box", "disc", NULL};
  lua_State *L = form->L;
  lua_pushliteral(L, "defocus");
  int type = lua_rawget(L, form->table);
  if (type == LUA_TNUMBER)
    desc->defocus_radius = lua_tonumber(L, -1);
  else if (type == LUA_TTABLE) {
    cs_form inner = cs_form_open(L, &noun_defocus, -1);
    desc->defocus_radius = cs_form_number(&inner, "radius");
    desc->defocus_kernel = (celspan_defocus_kernel)cs_form_choice(&inner, "kernel", kernels);
  } else if (type != LUA_TNIL)
    cs_form_fail(form, "field 'defocus' must be a radius or {radius =, kernel =}, got %s",
                 cs_userdata_type(L, -1));
}

static void create(const cs_form *form, cs_userdata *value) {
  lua_State *L = form->L;
  celspan_cel_desc desc = CELSPAN_CEL_DESC;
  int count = cs_form_length(form);
  desc.objects = cs_shape_items(form, count);
  desc.object_count = (size_t)count;
  desc.has_front = cs_light_read(form, "front", &desc.front, &desc.front_texture);
  cs_light_read(form, "back", &desc.back, &desc.back_texture);
  desc.has_viewport = cs_form_box(form, "viewport", &desc.viewport);
  read_defocus(form, &desc);
  desc.opacity = cs_form_number_or(form, "opacity", 1);
  celspan_cel *cel = NULL;
  cs_form_try(form, celspan_cel_create(cs_host_context(L), &desc, &cel));
  value->handle = cel;
}

static const cs_field fields[] = {{"front", NULL},   {"back", NULL},   {"viewport", NULL},
                                  {"defocus", NULL}, {"opacity", "1"}, {0}};
static const cs_noun noun = {.name = "cel",
                             .kind = &cs_kind_cel,
                             .list = CS_LIST_ITEMS,
                             .item = "object",
                             .fields = fields,
                             .create = create};

void cs_open_cel(lua_State *L) {
  cs_userdata_register(L, &cs_kind_cel, cs_placed_methods);
  cs_construct_push(L, &noun);
  lua_setfield(L, -2, noun.name);
}
