#include "readers/svg/document/objects.h"

#include <math.h>

#include "inside/scene.h"

/* The least ratio of the smaller radius of a blur to the greater one: smaller ratios look the same,
 * and would stretch the object without limit. */
#define LEAST_RADIUS 1e-3

celspan_status cs_svg_object_replace(celspan_status status, celspan_object *made,
                                     celspan_object **object) {
  celspan_object_unref(*object);
  *object = status == CELSPAN_OK ? made : NULL;
  return status;
}

celspan_status cs_svg_object_move(celspan_context *context, const celspan_matrix *matrix,
                                  celspan_object **object) {
  celspan_object *made = NULL;
  celspan_status status = celspan_object_transform(context, *object, matrix, &made);
  return cs_svg_object_replace(status, made, object);
}

celspan_status cs_svg_object_mask(celspan_context *context, celspan_object *art, celspan_object *by,
                                  bool inverts, celspan_object **out) {
  *out = art && !by && inverts ? celspan_object_ref(art) : NULL;
  return art && by
             ? celspan_object_create_matte(context, art, by, CELSPAN_MATTE_ALPHA, inverts, out)
             : CELSPAN_OK;
}

celspan_status cs_svg_object_fill(celspan_context *context, const celspan_box *box,
                                  celspan_texture *texture, celspan_object **out) {
  const celspan_rect_desc desc = {sizeof desc, box->x, box->y, box->width, box->height, 0, texture};
  return celspan_object_create_rect(context, &desc, out);
}

celspan_status cs_svg_object_flood(celspan_context *context, const celspan_box *box,
                                   const celspan_paint *paint, celspan_object **out) {
  celspan_texture *texture;
  CS_TRY(celspan_texture_create_paint(context, paint, &texture));
  celspan_status status = cs_svg_object_fill(context, box, texture, out);
  celspan_texture_unref(texture);
  return status;
}

celspan_status cs_svg_object_silhouette(celspan_context *context, celspan_object *object,
                                        const celspan_paint *paint, celspan_object **out) {
  celspan_box box;
  celspan_object *ground;
  bool is_there = false;
  *out = NULL;
  if (object)
    CS_TRY(cs_bounds_object(context, object, &is_there, &box));
  if (!is_there)
    return CELSPAN_OK;
  CS_TRY(cs_svg_object_flood(context, &box, paint, &ground));
  celspan_status status = cs_svg_object_mask(context, ground, object, false, out);
  celspan_object_unref(ground);
  return status;
}

/* The blur is round: before it the object is stretched along y, and after it the stretching is
 * reversed. */
celspan_status cs_svg_object_blur(celspan_context *context, const celspan_point *radius,
                                  celspan_defocus_kernel kernel, celspan_object **object) {
  const double most = fmax(radius->x, radius->y), x = fmax(radius->x, LEAST_RADIUS * most);
  const double stretch = fmax(radius->y, LEAST_RADIUS * most) / x;
  const celspan_matrix forth = celspan_matrix_scaling(1, 1 / stretch),
                       back = celspan_matrix_scaling(1, stretch);
  celspan_blur_desc desc = CELSPAN_BLUR_DESC;
  celspan_object *made = NULL;
  desc.radius = fmin(x, CELSPAN_BLUR_MOST);
  desc.kernel = kernel;
  if (stretch != 1)
    CS_TRY(cs_svg_object_move(context, &forth, object));
  celspan_status status = celspan_object_blur(context, *object, &desc, &made);
  CS_TRY(cs_svg_object_replace(status, made, object));
  return stretch != 1 ? cs_svg_object_move(context, &back, object) : CELSPAN_OK;
}
