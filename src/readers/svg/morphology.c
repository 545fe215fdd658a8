#include "readers/svg/morphology.h"

#include <math.h>

#include "model/scene/bounds.h"
#include "model/scene/primitive_data.h"
#include "readers/svg/objects.h"

/* How many times brighter a mean is made. */
#define ALL_THERE 256

/* *object as a group with `factor` times its light. */
static celspan_status brighten(celspan_context *context, double factor, celspan_object **object) {
  celspan_grade_desc fields = CELSPAN_GRADE_DESC;
  celspan_object *made = NULL;
  fields.has_matrix = true;
  for (int c = 0; c < 3; c++)
    fields.matrix[c][c] = factor;
  celspan_status status = cs_object_graded(context, *object, &fields, &made);
  return cs_svg_object_replace(status, made, object);
}

/* The paint in a box as far as there is light, or as far as it is dark. */
static celspan_status paint_by(celspan_context *context, const celspan_box *box,
                               const celspan_paint *paint, celspan_object *light, bool inverts,
                               celspan_object **out) {
  celspan_object *ground;
  CS_TRY(cs_svg_object_flood(context, box, paint, &ground));
  celspan_status status =
      celspan_object_create_matte(context, ground, light, CELSPAN_MATTE_LUMA, inverts, out);
  celspan_object_unref(ground);
  return status;
}

/* Light of 1 in a box: where the object is, or for shrinking, where it is not. */
static celspan_status light_up(celspan_context *context, const celspan_box *box,
                               celspan_object *object, const cs_svg_morphology *wanted,
                               celspan_object **out) {
  const celspan_paint white = celspan_paint_rgb(1, 1, 1, 1);
  celspan_object *light;
  CS_TRY(cs_svg_object_silhouette(context, object, &white, &light));
  celspan_status status = brighten(context, 1 / (double)wanted->paint.beta, &light);
  if (status == CELSPAN_OK)
    status = paint_by(context, box, &white, light, wanted->shrinks, out);
  celspan_object_unref(light);
  return status;
}

static celspan_status paint_near(celspan_context *context, const celspan_box *box,
                                 celspan_object *object, const cs_svg_morphology *wanted,
                                 celspan_object **out) {
  celspan_object *light = NULL;
  CS_TRY(light_up(context, box, object, wanted, &light));
  celspan_status status = cs_svg_object_blur(context, &wanted->radius, CELSPAN_DEFOCUS_BOX, &light);
  if (status == CELSPAN_OK)
    status = brighten(context, ALL_THERE, &light);
  if (status == CELSPAN_OK)
    status = paint_by(context, box, &wanted->paint, light, wanted->shrinks, out);
  celspan_object_unref(light);
  return status;
}

celspan_status cs_svg_morphology_make(celspan_context *context, celspan_object *object,
                                      const cs_svg_morphology *wanted, celspan_object **out) {
  const double x = fmin(wanted->radius.x, CELSPAN_BLUR_MOST),
               y = fmin(wanted->radius.y, CELSPAN_BLUR_MOST);
  celspan_box box;
  bool is_there = false;
  if (object)
    CS_TRY(cs_bounds_object(context, object, &is_there, &box));
  if (!is_there || !(fmax(x, y) > 0)) {
    *out = object ? celspan_object_ref(object) : NULL;
    return CELSPAN_OK;
  }
  box = (celspan_box){box.x - x, box.y - y, box.width + 2 * x, box.height + 2 * y};
  return wanted->paint.beta > 0 ? paint_near(context, &box, object, wanted, out) : CELSPAN_OK;
}
