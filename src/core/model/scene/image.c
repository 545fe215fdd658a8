/* Images: a rectangle, and a picture fitted to it.
 *
 *     fill              contain            cover
 *   +--------+        +--------+         .........
 *   |########|        |        |         +--------+
 *   |########|        |########|         |########|    +--+  the rectangle
 *   |########|        |########|         |########|    ####  the picture where it is drawn
 *   |########|        |        |         +--------+    ....  the picture beyond the rectangle
 *   +--------+        +--------+         .........
 */
#include <math.h>

#include "base/description.h"
#include "model/pictures/picture.h"
#include "model/scene/check.h"

static celspan_status check(celspan_context *context, const celspan_image_desc *desc) {
  CS_TRY(cs_check_number(context, "image", "x", desc->x));
  CS_TRY(cs_check_number(context, "image", "y", desc->y));
  CS_TRY(cs_check_size(context, "image", "w", desc->width));
  CS_TRY(cs_check_size(context, "image", "h", desc->height));
  return cs_check_choice(context, "image", "fit", (unsigned)desc->fit, CELSPAN_FIT_COVER + 1);
}

static celspan_status read_size(celspan_context *context, const celspan_image_desc *desc,
                                double *width, double *height) {
  celspan_picture_info info = CELSPAN_PICTURE_INFO;
  CS_TRY(celspan_picture_inspect(context, desc->picture, &info));
  *width = info.width;
  *height = info.height;
  return CELSPAN_OK;
}

/* A box of the picture's proportions in the middle of another box: the largest that fits into it,
 * or the smallest that covers it. */
static celspan_box fitted(celspan_box box, double width, double height, celspan_fit fit) {
  double scale_x = box.width / width, scale_y = box.height / height;
  double scale = fit == CELSPAN_FIT_CONTAIN ? fmin(scale_x, scale_y) : fmax(scale_x, scale_y);
  double fitted_width = scale == scale_x ? box.width : width * scale;
  double fitted_height = scale == scale_y ? box.height : height * scale;
  return (celspan_box){box.x + (box.width - fitted_width) / 2,
                       box.y + (box.height - fitted_height) / 2, fitted_width, fitted_height};
}

/* *frame: the rectangle that is drawn. *picture: where the whole picture lies. */
static celspan_status place(celspan_context *context, const celspan_image_desc *desc,
                            celspan_box *frame, celspan_box *picture) {
  bool has_width = desc->width > 0, has_height = desc->height > 0;
  *frame = (celspan_box){desc->x, desc->y, desc->width, desc->height};
  *picture = *frame;
  if (has_width && has_height && desc->fit == CELSPAN_FIT_FILL)
    return CELSPAN_OK;
  double width, height;
  CS_TRY(read_size(context, desc, &width, &height));
  if (has_width && has_height) {
    *picture = fitted(*frame, width, height, desc->fit);
    /* The edge of the picture becomes the outline of the rectangle, so that it is antialiased. */
    if (desc->fit == CELSPAN_FIT_CONTAIN && desc->picture->wrap == CELSPAN_WRAP_CLEAR)
      *frame = *picture;
    return CELSPAN_OK;
  }
  frame->width = has_width ? desc->width : has_height ? desc->height * width / height : width;
  frame->height = has_height ? desc->height : has_width ? desc->width * height / width : height;
  *picture = *frame;
  return CELSPAN_OK;
}

celspan_status celspan_object_create_image(celspan_context *context, const celspan_image_desc *desc,
                                           celspan_object **out) {
  CS_READ(context, "image", celspan_image_desc, desc);
  const celspan_picture_desc *shown = desc->picture;
  CS_READ(context, "image: picture", celspan_picture_desc, shown);
  desc_whole.picture = shown;
  CS_TRY(check(context, desc));
  celspan_box frame;
  celspan_picture_desc picture = *desc->picture;
  picture.has_box = true;
  CS_TRY(place(context, desc, &frame, &picture.box));
  /* The picture now fills the rectangle, and the rectangle's outline decides where it ends. Because
   * the picture is clamped, it has a colour also at the centre of a pixel that the outline covers
   * only in part. */
  if (picture.wrap == CELSPAN_WRAP_CLEAR)
    picture.wrap = CELSPAN_WRAP_CLAMP;
  celspan_texture *texture;
  CS_TRY(celspan_texture_create_picture(context, &picture, &texture));
  celspan_rect_desc rect = {sizeof rect, frame.x, frame.y, frame.width, frame.height, 0, texture};
  celspan_status status = celspan_object_create_rect(context, &rect, out);
  celspan_texture_unref(texture);
  return status;
}
