/* Objects that are changed by a rule about neighbouring pixels: of SVG filters, and sharpened
 * ones. */
#include <math.h>

#include "base/description.h"
#include "model/scene/bounds.h"
#include "model/scene/check.h"
#include "model/scene/effect.h"
#include "model/scene/nearby.h"

/* The frame as a clear object, so that the rule acts on all of it. */
static celspan_status make_clear(celspan_context *context, const celspan_box *frame,
                                 celspan_object **out) {
  const celspan_paint clear = celspan_paint_rgb(0, 0, 0, 0);
  celspan_texture *texture;
  CS_TRY(celspan_texture_create_paint(context, &clear, &texture));
  const celspan_rect_desc desc = {sizeof desc,   frame->x, frame->y, frame->width,
                                  frame->height, 0,        texture};
  celspan_status status = celspan_object_create_rect(context, &desc, out);
  celspan_texture_unref(texture);
  return status;
}

celspan_status cs_nearby_object_create(celspan_context *context, celspan_object *object,
                                       cs_nearby *nearby, const celspan_box *frame,
                                       celspan_object **out) {
  celspan_object *objects[2] = {NULL, object};
  celspan_cel *cel = NULL;
  CS_TRY(make_clear(context, frame, &objects[0]));
  celspan_status status =
      cs_cel_of_pixels(context, objects, object ? 2 : 1, (cs_cel_reading){.nearby = nearby}, &cel);
  celspan_object_unref(objects[0]);
  if (status == CELSPAN_OK)
    status = cs_effect_compose(context, cel, frame, 1, out);
  celspan_cel_unref(cel);
  return status;
}

/* ---------------------------------------------------------------- sharpen */

/* How far pixels at the edge of an object may extend beyond it, in its units. */
#define EXTENT 2

/* For an object without a mode. */
static celspan_status add_sharpness(celspan_context *context, celspan_object *object,
                                    const void *user, celspan_object **out) {
  const celspan_sharpen_desc *desc = user;
  const cs_nearby fields = {
      .kind = CS_NEARBY_SHARPEN, .radius = desc->radius, .amount = desc->amount};
  celspan_box box = {0};
  cs_nearby *nearby;
  bool is_there;
  CS_TRY(cs_bounds_object(context, object, &is_there, &box));
  if (!is_there || !(box.width > 0 && box.height > 0)) {
    *out = celspan_object_ref(object);
    return CELSPAN_OK;
  }
  CS_TRY(cs_nearby_create(context, &fields, &nearby));
  const double beyond = EXTENT * fmax(1, desc->radius);
  const celspan_box frame = {box.x - beyond, box.y - beyond, box.width + 2 * beyond,
                             box.height + 2 * beyond};
  celspan_status status = cs_nearby_object_create(context, object, nearby, &frame, out);
  cs_nearby_unref(nearby);
  return status;
}

celspan_status celspan_object_sharpen(celspan_context *context, celspan_object *object,
                                      const celspan_sharpen_desc *desc, celspan_object **out) {
  CS_READ(context, "sharpen", celspan_sharpen_desc, desc);
  CS_TRY(cs_check_given(context, "sharpen", "the object", object));
  CS_TRY(
      cs_check_range(context, "sharpen", "radius", desc->radius, 0, CELSPAN_SHARPEN_RADIUS_MOST));
  CS_TRY(cs_check_range(context, "sharpen", "amount", desc->amount, 0, CELSPAN_SHARPEN_MOST));
  if (desc->radius > 0 && desc->amount > 0)
    return cs_effect_make(context, object, add_sharpness, desc, out);
  *out = celspan_object_ref(object);
  return CELSPAN_OK;
}
