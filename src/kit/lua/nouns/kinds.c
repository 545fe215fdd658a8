/* The operations on values: the functions of the core, by kind. */
#include "inside/scene.h"
#include "lua/bind/construct.h"
#include "lua/bind/named.h"
#include "lua/bind/require.h"
#include "lua/nouns/nouns.h"

/* ---------------------------------------------------------------- functions without their types */

#define VALUE(type)                                                                                \
  static void type##_unref(void *handle) { celspan_##type##_unref(handle); }                       \
  static celspan_status type##_named(celspan_context *context, void *handle, const char *name,     \
                                     void **out) {                                                 \
    celspan_##type *made = NULL;                                                                   \
    celspan_status status = celspan_##type##_named(context, handle, name, &made);                  \
    if (status == CELSPAN_OK)                                                                      \
      *out = made;                                                                                 \
    return status;                                                                                 \
  }                                                                                                \
  static const char *type##_name_of(const void *handle) { return celspan_##type##_name(handle); }  \
  static celspan_origin type##_origin_of(const void *handle) {                                     \
    return celspan_##type##_origin(handle);                                                        \
  }
VALUE(texture)
VALUE(object)
VALUE(cel)
VALUE(rostrum)

#define PLACED(type)                                                                               \
  static celspan_status type##_transform(celspan_context *context, void *handle,                   \
                                         const celspan_matrix *matrix, void **out) {               \
    celspan_##type *made = NULL;                                                                   \
    celspan_status status = celspan_##type##_transform(context, handle, matrix, &made);            \
    if (status == CELSPAN_OK)                                                                      \
      *out = made;                                                                                 \
    return status;                                                                                 \
  }                                                                                                \
  static celspan_status type##_fade(celspan_context *context, void *handle, double k,              \
                                    void **out) {                                                  \
    celspan_##type *made = NULL;                                                                   \
    celspan_status status = celspan_##type##_fade(context, handle, k, &made);                      \
    if (status == CELSPAN_OK)                                                                      \
      *out = made;                                                                                 \
    return status;                                                                                 \
  }                                                                                                \
  static celspan_status type##_bounds(celspan_context *context, const void *handle,                \
                                      bool *is_there, celspan_box *out) {                          \
    return cs_bounds_##type(context, handle, is_there, out);                                       \
  }                                                                                                \
  static bool type##_contains(const void *handle, celspan_point point) {                           \
    return celspan_##type##_contains(handle, point);                                               \
  }
PLACED(object)
PLACED(cel)

static celspan_blend object_mode(const void *handle) { return celspan_object_mode(handle); }
static celspan_blend cel_mode(const void *handle) { return celspan_cel_mode(handle); }
static celspan_status object_blend(celspan_context *context, void *handle, celspan_blend mode,
                                   void **out) {
  celspan_object *made = NULL;
  celspan_status status = celspan_object_blend(context, handle, mode, &made);
  if (status == CELSPAN_OK)
    *out = made;
  return status;
}

/* ---------------------------------------------------------------- kinds */

#define HAS_VALUE(type)                                                                            \
  .unref = type##_unref, .named = type##_named, .name_of = type##_name_of,                         \
  .origin_of = type##_origin_of
#define HAS_PLACE(type)                                                                            \
  .transform = type##_transform, .fade = type##_fade, .bounds = type##_bounds,                     \
  .contains = type##_contains, .own_size = sizeof(cs_anchor)

static const luaL_Reg texture_methods[] = {
    {"with", cs_construct_with}, {"named", cs_named_method}, {NULL, NULL}};

const cs_kind cs_kind_paint = {.name = "celspan.paint",
                               HAS_VALUE(texture),
                               .methods = texture_methods,
                               .own_size = sizeof(celspan_paint)};
const cs_kind cs_kind_texture = {
    .name = "celspan.texture", HAS_VALUE(texture), .methods = texture_methods};
static const cs_written object_written[] = {
    {"warp", "celspan.warp", "apply"}, {"boil", "celspan.warp", "boil"}, {0}};
const cs_kind cs_kind_object = {.name = "celspan.object",
                                HAS_VALUE(object),
                                HAS_PLACE(object),
                                .mode = object_mode,
                                .blend = object_blend,
                                .methods = cs_placed_object_methods,
                                .written = object_written,
                                .operators = cs_boolean_operators};
const cs_kind cs_kind_cel = {.name = "celspan.cel",
                             HAS_VALUE(cel),
                             HAS_PLACE(cel),
                             .mode = cel_mode,
                             .methods = cs_placed_methods};
const cs_kind cs_kind_rostrum = {.name = "celspan.rostrum",
                                 HAS_VALUE(rostrum),
                                 .methods = cs_placed_methods,
                                 .operators = cs_boolean_operators};

const cs_kind *const cs_kinds[] = {
    &cs_kind_object,  &cs_kind_cel,  &cs_kind_paint, &cs_kind_texture,
    &cs_kind_rostrum, &cs_kind_film, &cs_kind_frame, NULL};
