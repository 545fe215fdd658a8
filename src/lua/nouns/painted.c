/* object:paint(texture): a rectangle with the texture, inside the shape. */
#include "base/context.h"
#include "lua/bind/form.h"
#include "lua/bind/host.h"
#include "lua/nouns/nouns.h"
#include "model/scene/scene.h"

static void refuse_change(const cs_form *form, cs_userdata *value) {
  (void)value;
  cs_form_fail(form, "it was made of another object and has no fields to change");
}

static const cs_field no_fields[] = {{0}};
static const cs_noun noun_painted = {.name = "painted",
                                     .kind = &cs_kind_object,
                                     .list = CS_LIST_NONE,
                                     .fields = no_fields,
                                     .create = refuse_change};
static const cs_noun argument = {.name = "paint", .fields = no_fields};

/* The shape cut out of a rectangle that just covers it. */
static celspan_status fill(celspan_context *context, celspan_object *shape, const celspan_box *box,
                           celspan_texture *texture, celspan_object **out) {
  const celspan_rect_desc desc = {box->x, box->y, box->width, box->height, 0, texture};
  celspan_object *pair[2] = {NULL, shape};
  CS_TRY(celspan_object_create_rect(context, &desc, &pair[0]));
  celspan_status status = celspan_object_create_boolean(context, CELSPAN_CLIP, pair, 2, out);
  celspan_object_unref(pair[0]);
  return status;
}

/* Replaces *object by a copy with the fade and the name, where there are any. */
static celspan_status finish(celspan_context *context, double fade, const char *name,
                             celspan_object **object) {
  celspan_object *faded = NULL, *named = NULL;
  celspan_status status = celspan_object_fade(context, *object, fade, &faded);
  if (status == CELSPAN_OK && name)
    status = celspan_object_named(context, faded, name, &named);
  if (named)
    celspan_object_unref(faded);
  celspan_object_unref(*object);
  *object = named ? named : faded;
  return status;
}

int cs_painted_method(lua_State *L) {
  const cs_userdata *shape = cs_userdata_self(L, &cs_kind_object, "paint");
  const cs_form form = {L, &argument, 2};
  celspan_context *context = cs_host_context(L);
  celspan_box box;
  lua_settop(L, 2);
  celspan_texture *texture = cs_form_texture(&form, "texture");
  if (!celspan_object_bounds(shape->handle, &box)) {
    lua_settop(L, 1);
    return 1;
  }
  lua_getfield(L, 1, "name");
  const char *name = lua_tostring(L, -1);
  cs_userdata *value = cs_userdata_push(L, &noun_painted);
  lua_newtable(L);
  lua_setiuservalue(L, -2, 1);
  celspan_object *object = NULL;
  cs_host_try(L, "paint", fill(context, shape->handle, &box, texture, &object));
  celspan_status status =
      finish(context, ((const celspan_object *)shape->handle)->fade, name, &object);
  value->handle = object; /* also where it failed, to be released */
  cs_host_try(L, "paint", status);
  return 1;
}
