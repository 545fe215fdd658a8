#include "model/scene/displace.h"

#include <math.h>

#include "base/counted.h"
#include "base/description.h"
#include "base/elementary.h"
#include "model/scene/bounds.h"
#include "model/scene/check.h"
#include "model/scene/effect.h"
#include "model/scene/extend.h"
#include "model/scene/shift.h"

#define DEGREE 0.017453292519943295 /* radians */
#define ZOOM_MOST 90                /* per cent: beyond it, a point could be seen anywhere */
#define SPIN_MOST 180               /* degrees: to either side, a whole turn */

/* ---------------------------------------------------------------- objects */

/* frame: where the result ends. */
static celspan_status compose(celspan_context *context, celspan_object *object, cs_shift *shift,
                              const celspan_box *frame, celspan_object **out) {
  celspan_cel *cel;
  CS_TRY(cs_cel_of_pixels(context, &object, 1, (cs_cel_reading){.shift = shift}, &cel));
  celspan_status status = cs_effect_compose(context, cel, frame, 1, out);
  celspan_cel_unref(cel);
  return status;
}

/* The object, continued beyond its bounds as far as the shift reads, ends there. */
static celspan_status compose_extended(celspan_context *context, celspan_object *object,
                                       cs_shift *shift, const celspan_box *box,
                                       celspan_object **out) {
  const celspan_box far = cs_shift_reads(shift, box);
  const celspan_matrix identity = celspan_matrix_identity();
  double reach = fmax(fmax(box->x - far.x, far.x + far.width - box->x - box->width),
                      fmax(box->y - far.y, far.y + far.height - box->y - box->height));
  celspan_object *extended;
  CS_TRY(cs_extend(context, &object, 1, &identity, box, reach, &extended));
  celspan_status status = compose(context, extended, shift, box, out);
  celspan_object_unref(extended);
  return status;
}

/* For an object without a mode. */
static celspan_status add(celspan_context *context, celspan_object *object, cs_shift *shift,
                          celspan_blur_edge edge, celspan_object **out) {
  celspan_box box = {0};
  bool is_there;
  CS_TRY(cs_bounds_object(context, object, &is_there, &box));
  const celspan_box frame = cs_shift_shows(shift, &box);
  shift->is_cut = edge == CELSPAN_BLUR_EXTEND && box.width > 0 && box.height > 0;
  shift->hash = cs_shift_hash(shift);
  if (is_there && shift->is_cut)
    return compose_extended(context, object, shift, &box, out);
  if (is_there && frame.width > 0 && frame.height > 0)
    return compose(context, object, shift, &frame, out);
  *out = celspan_object_ref(object);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- displacement */

typedef struct displacement {
  celspan_displace_desc desc;
  bool moves_clear;
} displacement;

static celspan_status add_displacement(celspan_context *context, celspan_object *object,
                                       const void *user, celspan_object **out) {
  const displacement *given = user;
  const celspan_displace_desc *desc = &given->desc;
  celspan_cel_desc fields = CELSPAN_CEL_DESC;
  cs_shift *shift;
  CS_TRY(CS_COUNTED_MAKE(context, shift));
  shift->kind = CS_SHIFT_DISPLACED;
  shift->channels[0] = desc->x;
  shift->channels[1] = desc->y;
  shift->scale = desc->scale;
  shift->space = desc->space;
  shift->moves_clear = given->moves_clear;
  fields.objects = (celspan_object *const *)&desc->by;
  fields.object_count = 1;
  celspan_status status = celspan_cel_create(context, &fields, &shift->by);
  if (status == CELSPAN_OK)
    status = add(context, object, shift, CELSPAN_BLUR_CLEAR, out);
  cs_shift_unref(shift);
  return status;
}

static celspan_status check_displacement(celspan_context *context, const celspan_object *object,
                                         const celspan_displace_desc *desc) {
  CS_TRY(cs_check_given(context, "displace", "the object", object));
  CS_TRY(cs_check_given(context, "displace", "by", desc->by));
  CS_TRY(cs_check_choice(context, "displace", "x", (unsigned)desc->x, CELSPAN_CHANNEL_ALPHA + 1));
  CS_TRY(cs_check_choice(context, "displace", "y", (unsigned)desc->y, CELSPAN_CHANNEL_ALPHA + 1));
  CS_TRY(
      cs_check_choice(context, "displace", "space", (unsigned)desc->space, CELSPAN_SPACE_SRGB + 1));
  return cs_check_range(context, "displace", "scale", desc->scale, -CELSPAN_BLUR_MOST,
                        CELSPAN_BLUR_MOST);
}

celspan_status celspan_object_displace(celspan_context *context, celspan_object *object,
                                       const celspan_displace_desc *desc, celspan_object **out) {
  return cs_displace_object(context, object, desc, false, out);
}

celspan_status cs_displace_object(celspan_context *context, celspan_object *object,
                                  const celspan_displace_desc *desc, bool moves_clear,
                                  celspan_object **out) {
  CS_READ(context, "displace", celspan_displace_desc, desc);
  CS_TRY(check_displacement(context, object, desc));
  displacement fields = {*desc, moves_clear};
  fields.desc.space = cs_space_inside(desc->space, CELSPAN_SPACE_SRGB);
  if (desc->scale != 0)
    return cs_effect_make(context, object, add_displacement, &fields, out);
  *out = celspan_object_ref(object);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- blurs with a direction */

/* By celspan_blur_along. */
static const cs_shift_kind kinds[] = {CS_SHIFT_LINE, CS_SHIFT_LINE, CS_SHIFT_ZOOM, CS_SHIFT_SPIN};
static const double most[] = {0, CELSPAN_BLUR_MOST, ZOOM_MOST, SPIN_MOST};

/* A direction in degrees; whole quarters are exact. */
static celspan_point direction_of(double degrees) {
  double turn = fmod(degrees, 360), sine, cosine;
  cs_elementary_sincos(turn * DEGREE, &sine, &cosine);
  if (fmod(turn, 90) == 0)
    return (celspan_point){round(cosine), round(sine)};
  return (celspan_point){cosine, sine};
}

static celspan_status add_blur(celspan_context *context, celspan_object *object, const void *user,
                               celspan_object **out) {
  const celspan_blur_desc *desc = user;
  const celspan_point direction = direction_of(desc->degrees);
  cs_shift *shift;
  CS_TRY(CS_COUNTED_MAKE(context, shift));
  shift->kind = kinds[desc->along];
  shift->at = desc->centre;
  if (shift->kind == CS_SHIFT_LINE)
    shift->at = (celspan_point){desc->radius * direction.x, desc->radius * direction.y};
  else
    shift->extent = desc->radius * (shift->kind == CS_SHIFT_ZOOM ? 0.01 : DEGREE);
  celspan_status status = add(context, object, shift, desc->edge, out);
  cs_shift_unref(shift);
  return status;
}

static celspan_status check_blur(celspan_context *context, const celspan_blur_desc *desc) {
  CS_TRY(cs_check_range(context, "blur", "radius", desc->radius, 0, most[desc->along]));
  CS_TRY(cs_check_choice(context, "blur", "edge", (unsigned)desc->edge, CELSPAN_BLUR_EXTEND + 1));
  CS_TRY(cs_check_number(context, "blur", "angle", desc->degrees));
  CS_TRY(cs_check_point(context, "blur", "centre", 0, desc->centre));
  if (desc->kernel != CELSPAN_DEFOCUS_GAUSSIAN && desc->kernel != CELSPAN_DEFOCUS_BOX)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "blur: a blur with angle, zoom or spin is a box; leave kernel out");
  return CELSPAN_OK;
}

celspan_status cs_displace_blur(celspan_context *context, celspan_object *object,
                                const celspan_blur_desc *desc, celspan_object **out) {
  CS_TRY(check_blur(context, desc));
  if (desc->radius > 0)
    return cs_effect_make(context, object, add_blur, desc, out);
  *out = celspan_object_ref(object);
  return CELSPAN_OK;
}
