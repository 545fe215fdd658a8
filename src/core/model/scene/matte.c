/* Mattes that are grown and blurred first.
 *
 *     shapes of opaque colours   grow as their outlines do (grow.h)
 *     anything else              is a white silhouette first. Where it is at least half there it
 *                                counts as whole, by a key, and that has an outline of its alpha:
 *
 *         grown    the silhouette, and the outline of its whole part
 *         choked   the silhouette without the outline of the whole part of what it is not
 *
 *     feather                    is a blur of that
 */
#include <math.h>

#include "base/description.h"
#include "model/scene/bounds.h"
#include "model/scene/check.h"
#include "model/scene/effect.h"
#include "model/scene/grow.h"

/* Half of white, as a code of sRGB; and how far around it a silhouette is whole by parts. */
#define HALF 0.735356
#define AROUND 0.02

/* ---------------------------------------------------------------- by alpha */

/* White within a rectangle, as far as the matte is there. */
static celspan_status make_silhouette(celspan_context *context, celspan_object *by,
                                      const celspan_rect_desc *place, celspan_matte_from from,
                                      bool inverts, celspan_object **out) {
  const celspan_paint paint = celspan_paint_rgb(1, 1, 1, 1);
  celspan_rect_desc desc = *place;
  celspan_object *ground = NULL;
  CS_TRY(celspan_texture_create_paint(context, &paint, &desc.texture));
  celspan_status status = celspan_object_create_rect(context, &desc, &ground);
  celspan_texture_unref(desc.texture);
  if (status == CELSPAN_OK)
    status = celspan_object_create_matte(context, ground, by, from, inverts, out);
  celspan_object_unref(ground);
  return status;
}

/* Puts one object over another, in light. */
static celspan_status stack(celspan_context *context, celspan_object *rear, celspan_object *front,
                            celspan_object **out) {
  celspan_object *const both[] = {rear, front};
  celspan_group_desc desc = CELSPAN_GROUP_DESC;
  desc.objects = both;
  desc.object_count = 2;
  desc.space = CELSPAN_SPACE_LINEAR;
  return celspan_object_create_group(context, &desc, out);
}

/* A silhouette before black, keyed by its luma: whole where it was at least half there. */
static celspan_status harden(celspan_context *context, celspan_object *silhouette,
                             const celspan_rect_desc *place, celspan_object **out) {
  celspan_key_desc key = CELSPAN_KEY_DESC;
  celspan_object *ground, *grey = NULL;
  key.by = CELSPAN_KEY_LUMA;
  key.from = HALF - AROUND;
  key.to = HALF + AROUND;
  CS_TRY(celspan_object_create_rect(context, place, &ground));
  celspan_status status = stack(context, ground, silhouette, &grey);
  if (status == CELSPAN_OK)
    status = celspan_object_key(context, grey, &key, out);
  celspan_object_unref(ground);
  celspan_object_unref(grey);
  return status;
}

/* The whole part of what a matte is, or is not, with an outline. */
static celspan_status spread(celspan_context *context, celspan_object *by,
                             const celspan_rect_desc *place, const celspan_matte_desc *desc,
                             celspan_object **out) {
  celspan_outline_desc fields = CELSPAN_OUTLINE_DESC;
  celspan_object *silhouette, *hard = NULL;
  fields.width = fabs(desc->grow);
  CS_TRY(make_silhouette(context, by, place, desc->from, desc->grow < 0, &silhouette));
  celspan_status status = harden(context, silhouette, place, &hard);
  if (status == CELSPAN_OK)
    status = celspan_object_outline(context, hard, &fields, out);
  celspan_object_unref(silhouette);
  celspan_object_unref(hard);
  return status;
}

/* What a matte is not must reach farther than its bounds by the width, and by that of a blur. */
static celspan_status grow_alpha(celspan_context *context, celspan_object *by,
                                 const celspan_box *box, const celspan_matte_desc *desc,
                                 celspan_object **out) {
  const double far = desc->grow < 0 ? -2 * desc->grow : 0;
  const celspan_rect_desc place = {sizeof place, box->x, box->y, box->width, box->height, 0, NULL};
  const celspan_rect_desc around = {
      sizeof around, box->x - far, box->y - far, box->width + 2 * far, box->height + 2 * far, 0,
      NULL};
  celspan_object *own, *wide = NULL;
  CS_TRY(make_silhouette(context, by, &place, desc->from, false, &own));
  celspan_status status = spread(context, by, &around, desc, &wide);
  if (status == CELSPAN_OK && desc->grow < 0)
    status = celspan_object_create_matte(context, own, wide, CELSPAN_MATTE_ALPHA, true, out);
  else if (status == CELSPAN_OK)
    status = stack(context, wide, own, out);
  celspan_object_unref(own);
  celspan_object_unref(wide);
  return status;
}

/* Nothing that is empty grows. */
static celspan_status grow_any(celspan_context *context, celspan_object *by,
                               const celspan_matte_desc *desc, celspan_object **out) {
  celspan_box box = {0};
  bool is_there;
  CS_TRY(cs_bounds_object(context, by, &is_there, &box));
  if (is_there && box.width > 0 && box.height > 0)
    return grow_alpha(context, by, &box, desc, out);
  *out = celspan_object_ref(by);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- grown and blurred */

/* Whether the shapes of a matte say all about it. */
static bool is_solid(const celspan_object *by) {
  return by->fade == 1 && by->data->mixing == CS_MIXING_OPAQUE && cs_grow_is_vector(by);
}

/* *by: replaced by the grown matte, whose strength is its alpha then. */
static celspan_status grow(celspan_context *context, celspan_object **by,
                           celspan_matte_desc *desc) {
  const cs_grow how = {desc->grow, CELSPAN_STROKE_JOIN_ROUND};
  const bool is_shape = desc->from == CELSPAN_MATTE_ALPHA && is_solid(*by);
  celspan_object *grown = NULL;
  celspan_status status =
      is_shape ? cs_grow_object(context, *by, &how, &grown) : grow_any(context, *by, desc, &grown);
  desc->from = CELSPAN_MATTE_ALPHA;
  return cs_effect_replace(by, status, grown);
}

static celspan_status feather(celspan_context *context, celspan_object **by,
                              const celspan_matte_desc *desc) {
  celspan_blur_desc fields = CELSPAN_BLUR_DESC;
  celspan_object *soft = NULL;
  fields.radius = desc->feather;
  celspan_status status = celspan_object_blur(context, *by, &fields, &soft);
  return cs_effect_replace(by, status, soft);
}

static celspan_status check(celspan_context *context, celspan_object *by,
                            const celspan_matte_desc *desc) {
  CS_TRY(cs_check_given(context, "matte", "the object that it is matted by", by));
  CS_TRY(
      cs_check_choice(context, "matte", "from", (unsigned)desc->from, CELSPAN_MATTE_DISSOLVE + 1));
  CS_TRY(
      cs_check_range(context, "matte", "grow", desc->grow, -CELSPAN_BLUR_MOST, CELSPAN_BLUR_MOST));
  if (desc->grow != 0 && desc->from == CELSPAN_MATTE_DISSOLVE)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "matte: grow is not possible with from = dissolve; grow the art instead");
  return cs_check_range(context, "matte", "feather", desc->feather, 0, CELSPAN_BLUR_MOST);
}

celspan_status celspan_object_matte(celspan_context *context, celspan_object *art,
                                    celspan_object *by, const celspan_matte_desc *desc,
                                    celspan_object **out) {
  CS_READ(context, "matte", celspan_matte_desc, desc);
  CS_TRY(check(context, by, desc));
  celspan_matte_desc left = *desc;
  celspan_object *soft = celspan_object_ref(by);
  celspan_status status = CELSPAN_OK;
  if (left.grow != 0)
    status = grow(context, &soft, &left);
  if (status == CELSPAN_OK && left.feather > 0)
    status = feather(context, &soft, &left);
  if (status == CELSPAN_OK)
    status = celspan_object_create_matte(context, art, soft, left.from, left.invert, out);
  celspan_object_unref(soft);
  return status;
}
