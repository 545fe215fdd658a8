/* What objects and cels can do: transforms, fades, bounds. */
#include "bind/host.h"
#include "bind/named.h"
#include "bind/openers.h"
#include "bind/placed.h"
#include "bind/stroke.h"
#include "bind/userdata.h"
#include "scene/bounds.h"

static void unref(void *handle) { celspan_object_unref(handle); }

static celspan_status transform(celspan_context *context, void *handle,
                                const celspan_matrix *matrix, void **out) {
  celspan_object *object = NULL;
  celspan_status status = celspan_object_transform(context, handle, matrix, &object);
  if (status == CELSPAN_OK)
    *out = object;
  return status;
}

static celspan_status fade(celspan_context *context, void *handle, double k, void **out) {
  celspan_object *object = NULL;
  celspan_status status = celspan_object_fade(context, handle, k, &object);
  if (status == CELSPAN_OK)
    *out = object;
  return status;
}

static celspan_status bounds(celspan_context *context, const void *handle, bool *is_there,
                             celspan_box *out) {
  return cs_bounds_object(context, handle, is_there, out);
}

static bool contains(const void *handle, celspan_point point) {
  return celspan_object_contains(handle, point);
}

const cs_kind cs_kind_object = {.name = "celspan.object",
                                .unref = unref,
                                .transform = transform,
                                .fade = fade,
                                .bounds = bounds,
                                .contains = contains,
                                .push_field = cs_named_push_field};

/* The methods of everything that has a place, and one more. */
#define MOST_METHODS 16

void cs_open_object(lua_State *L) {
  luaL_Reg methods[MOST_METHODS] = {{"stroke", cs_stroke_method}};
  for (int i = 0; cs_placed_methods[i].name; i++)
    methods[i + 1] = cs_placed_methods[i];
  cs_userdata_register(L, &cs_kind_object, methods);
}
