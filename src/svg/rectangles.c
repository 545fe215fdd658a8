#include "svg/rectangles.h"

celspan_matrix cs_svg_box_matrix(const celspan_box *box) {
  return (celspan_matrix){{box->width, 0, box->x, 0, box->height, box->y, 0, 0, 1}};
}

celspan_status cs_svg_rectangle(cs_svg_reading *reading, const celspan_box *box,
                                const celspan_matrix *matrix, celspan_object **out) {
  const celspan_rect_desc desc = {box->x, box->y, box->width, box->height, 0, NULL};
  celspan_object *object;
  CS_TRY(celspan_object_create_rect(reading->context, &desc, &object));
  celspan_status status = celspan_object_transform(reading->context, object, matrix, out);
  celspan_object_unref(object);
  return status;
}
