/* The grain of a rostrum: what is drawn instead of it.
 *
 *   rostrum, in its space
 *     cel, under white light
 *       group, in sRGB codes
 *         the rostrum without its grain, as an object
 *         a sheet over its frame, in linear-light, which is where its backdrop is
 */
#include "model/scene/check.h"
#include "model/scene/primitive_data.h"

/* What is drawn of a rostrum: its frame, and how far a pixel filter reads beyond it. */
typedef struct grain_view {
  double width, height, margin;
  celspan_space space;
} grain_view;

/* The rostrum without its grain, as an object of a size, in a space. */
static celspan_status make_art(celspan_context *context, const celspan_rostrum *from,
                               const grain_view *view, celspan_object **out) {
  celspan_rostrum *bare;
  CS_TRY(cs_rostrum_with(context, from, from->cels, from->cel_count, &bare));
  celspan_texture_unref(bare->grain);
  bare->grain = NULL;
  bare->space = view->space;
  bare->has_size = true;
  bare->width = view->width;
  bare->height = view->height;
  cs_rostrum_rehash(bare);
  celspan_status status = cs_nested_create(context, bare, view->margin, out);
  celspan_rostrum_unref(bare);
  return status;
}

/* A sheet of grain over the frame, which is where its backdrop is. */
static celspan_status make_sheet(celspan_context *context, const celspan_rostrum *from,
                                 const grain_view *view, celspan_object **out) {
  const double margin = view->margin;
  const celspan_rect_desc desc = {.struct_size = sizeof desc,
                                  .x = -margin,
                                  .y = -margin,
                                  .width = view->width + 2 * margin,
                                  .height = view->height + 2 * margin,
                                  .texture = from->grain};
  celspan_object *rect;
  CS_TRY(celspan_object_create_rect(context, &desc, &rect));
  celspan_status status = cs_object_blend_within(context, rect, CELSPAN_BLEND_LINEAR_LIGHT, out);
  celspan_object_unref(rect);
  return status;
}

/* Both, in the codes of which one is added to the other. */
static celspan_status make_grainy(celspan_context *context, const celspan_rostrum *from,
                                  const grain_view *view, celspan_object **out) {
  celspan_object *parts[2] = {NULL, NULL};
  celspan_group_desc desc = CELSPAN_GROUP_DESC;
  celspan_status status = make_art(context, from, view, &parts[0]);
  if (status == CELSPAN_OK)
    status = make_sheet(context, from, view, &parts[1]);
  desc.objects = parts;
  desc.object_count = 2;
  desc.isolate = CELSPAN_ISOLATION_ON;
  desc.space = CELSPAN_SPACE_SRGB;
  if (status == CELSPAN_OK)
    status = celspan_object_create_group(context, &desc, out);
  celspan_object_unref(parts[0]);
  celspan_object_unref(parts[1]);
  return status;
}

/* A rostrum of a size, in a space, with one cel, of this object under white light. */
static celspan_status make_whole(celspan_context *context, celspan_object *object,
                                 const grain_view *view, celspan_rostrum **out) {
  celspan_cel_desc one = CELSPAN_CEL_DESC;
  celspan_rostrum_desc desc = CELSPAN_ROSTRUM_DESC;
  celspan_cel *cel;
  one.objects = &object;
  one.object_count = 1;
  CS_TRY(celspan_cel_create(context, &one, &cel));
  desc.cels = &cel;
  desc.cel_count = 1;
  desc.space = view->space;
  desc.has_size = true;
  desc.width = view->width;
  desc.height = view->height;
  celspan_status status = celspan_rostrum_create(context, &desc, out);
  celspan_cel_unref(cel);
  return status;
}

celspan_status cs_rostrum_shown(celspan_context *context, celspan_rostrum *rostrum, double width,
                                double height, double margin, celspan_space space,
                                celspan_rostrum **out) {
  const grain_view view = {width, height, margin, cs_space_inside(rostrum->space, space)};
  celspan_object *grainy;
  if (!rostrum->grain) {
    *out = celspan_rostrum_ref(rostrum);
    return CELSPAN_OK;
  }
  CS_TRY(make_grainy(context, rostrum, &view, &grainy));
  celspan_rostrum *shown;
  celspan_status status = make_whole(context, grainy, &view, &shown);
  celspan_object_unref(grainy);
  CS_TRY(status);
  status = cs_antialias_copy(context, &rostrum->antialias, &shown->antialias);
  cs_mark_drop(shown->mark);
  shown->mark = cs_mark_keep(rostrum->mark);
  cs_rostrum_rehash(shown);
  return CS_GIVE(status, shown, celspan_rostrum_unref, out);
}

celspan_status celspan_object_create_rostrum(celspan_context *context, celspan_rostrum *rostrum,
                                             celspan_object **out) {
  celspan_rostrum *shown;
  CS_TRY(cs_check_given(context, "rostrum", "the rostrum", rostrum));
  if (!rostrum->grain || !rostrum->has_size)
    return cs_nested_create(context, rostrum, 0, out);
  CS_TRY(cs_rostrum_shown(context, rostrum, rostrum->width, rostrum->height, 0,
                          CELSPAN_SPACE_LINEAR, &shown));
  celspan_status status = cs_nested_create(context, shown, 0, out);
  celspan_rostrum_unref(shown);
  return status;
}
