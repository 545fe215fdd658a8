/* Mattes: booleans of two operands, of which only the first is painted. They isolate.
 *
 *     shapes of opaque colours   grow as their outlines do (grow.h)
 *     anything else              is a white silhouette first, which has an outline of its alpha:
 *
 *         grown    silhouette with an outline as wide
 *         choked   the place around it, inside out: [ 1 - (1 - silhouette, grown) ]
 *
 *     feather                    is a blur of that
 */
#include <math.h>

#include "base/description.h"
#include "model/scene/bounds.h"
#include "model/scene/check.h"
#include "model/scene/grow.h"
#include "model/scene/primitive_data.h"

celspan_status celspan_object_create_matte(celspan_context *context, celspan_object *art,
                                           celspan_object *by, celspan_matte_from from, bool invert,
                                           celspan_object **out) {
  CS_TRY(cs_check_given(context, "matte", "the art", art));
  CS_TRY(cs_check_given(context, "matte", "the object that it is matted by", by));
  CS_TRY(cs_check_choice(context, "matte", "from", (unsigned)from, CELSPAN_MATTE_LUMA + 1));
  celspan_object *const both[] = {art, by};
  const cs_boolean look = {.op = CS_OPERATOR_MATTE,
                           .isolates = true,
                           .is_luma = from == CELSPAN_MATTE_LUMA,
                           .inverts = invert};
  cs_primitive_data *data;
  CS_TRY(cs_primitive_data_of_operands(context, "matte", &look, both, 2, &data));
  return cs_primitive_data_wrap(context, data, CELSPAN_OK, out);
}

/* ---------------------------------------------------------------- by alpha */

static celspan_status make_white(celspan_context *context, celspan_texture **out) {
  const celspan_paint paint = celspan_paint_rgb(1, 1, 1, 1);
  return celspan_texture_create_paint(context, &paint, out);
}

/* White within `box`, and beyond it by `grow`, as far as the matte is there. */
static celspan_status make_silhouette(celspan_context *context, celspan_object *by,
                                      const celspan_box *box, double grow, celspan_matte_from from,
                                      bool inverts, celspan_object **out) {
  celspan_rect_desc desc = {
      sizeof desc, box->x - grow, box->y - grow, box->width + 2 * grow, box->height + 2 * grow,
      0,           NULL};
  celspan_object *ground = NULL;
  CS_TRY(make_white(context, &desc.texture));
  celspan_status status = celspan_object_create_rect(context, &desc, &ground);
  celspan_texture_unref(desc.texture);
  if (status == CELSPAN_OK)
    status = celspan_object_create_matte(context, ground, by, from, inverts, out);
  celspan_object_unref(ground);
  return status;
}

/* The silhouette of what a matte is, or is not, and an outline around it. */
static celspan_status outline_silhouette(celspan_context *context, celspan_object *by,
                                         const celspan_box *box, double grow,
                                         const celspan_matte_desc *desc, bool inverts,
                                         celspan_object **out) {
  celspan_outline_desc fields = CELSPAN_OUTLINE_DESC;
  celspan_object *silhouette = NULL;
  CS_TRY(make_white(context, &fields.texture));
  fields.width = fabs(desc->grow);
  celspan_status status = make_silhouette(context, by, box, grow, desc->from, inverts, &silhouette);
  if (status == CELSPAN_OK)
    status = celspan_object_outline(context, silhouette, &fields, out);
  celspan_object_unref(silhouette);
  celspan_texture_unref(fields.texture);
  return status;
}

static celspan_status grow_alpha(celspan_context *context, celspan_object *by,
                                 const celspan_matte_desc *desc, celspan_object **out) {
  const double width = fabs(desc->grow);
  celspan_box box = {0};
  celspan_object *around;
  bool is_there;
  CS_TRY(cs_bounds_object(context, by, &is_there, &box));
  if (!is_there || !(box.width > 0 && box.height > 0)) {
    *out = celspan_object_ref(by);
    return CELSPAN_OK;
  }
  if (desc->grow > 0)
    return outline_silhouette(context, by, &box, 0, desc, false, out);
  CS_TRY(outline_silhouette(context, by, &box, 2 * width, desc, true, &around));
  celspan_status status = make_silhouette(context, around, &box, 0, CELSPAN_MATTE_ALPHA, true, out);
  celspan_object_unref(around);
  return status;
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
  celspan_object *grown;
  CS_TRY(is_shape ? cs_grow_object(context, *by, &how, &grown)
                  : grow_alpha(context, *by, desc, &grown));
  celspan_object_unref(*by);
  *by = grown;
  desc->from = CELSPAN_MATTE_ALPHA;
  return CELSPAN_OK;
}

static celspan_status feather(celspan_context *context, celspan_object **by,
                              const celspan_matte_desc *desc) {
  celspan_blur_desc fields = CELSPAN_BLUR_DESC;
  celspan_object *soft;
  fields.radius = desc->feather;
  CS_TRY(celspan_object_blur(context, *by, &fields, &soft));
  celspan_object_unref(*by);
  *by = soft;
  return CELSPAN_OK;
}

static celspan_status check(celspan_context *context, celspan_object *by,
                            const celspan_matte_desc *desc) {
  CS_TRY(cs_check_given(context, "matte", "the object that it is matted by", by));
  CS_TRY(cs_check_choice(context, "matte", "from", (unsigned)desc->from, CELSPAN_MATTE_LUMA + 1));
  CS_TRY(
      cs_check_range(context, "matte", "grow", desc->grow, -CELSPAN_BLUR_MOST, CELSPAN_BLUR_MOST));
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
