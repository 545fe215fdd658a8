/* Draws a leaf from numbers:
 * cc contours.c $(pkg-config --cflags --libs celspan) && ./a.out leaf.png */
#include <celspan/celspan.h>

/* A contour that is drawn point by point, and one that lies in an array. */
static celspan_status draw_leaf(celspan_context *context, celspan_contours *contours,
                                celspan_object *objects[2]) {
  celspan_path_desc leaf = CELSPAN_PATH_DESC;
  celspan_contours_move_to(contours, 20, 100);
  celspan_contours_cubic_to(contours, 20, 40, 60, 20, 100, 20);
  celspan_contours_cubic_to(contours, 100, 70, 75, 100, 20, 100);
  celspan_contours_close(contours);
  celspan_status status = celspan_contours_get(contours, &leaf.contours, &leaf.contour_count);
  if (status == CELSPAN_OK)
    status = celspan_object_create_path(context, &leaf, &objects[0]);
  if (status != CELSPAN_OK)
    return status;
  const celspan_point rib[] = {{12, 108}, {40, 90}, {60, 70}, {84, 36}}; /* one cubic */
  const celspan_contour line = {rib, 4, false};
  const celspan_paint white = celspan_paint_rgb(1, 1, 1, 1);
  celspan_stroke_desc stroke = CELSPAN_STROKE_DESC;
  stroke.contours = &line, stroke.contour_count = 1;
  stroke.width = 3;
  status = celspan_texture_create_paint(context, &white, &stroke.texture);
  if (status == CELSPAN_OK)
    status = celspan_object_create_stroke(context, &stroke, &objects[1]);
  celspan_texture_unref(stroke.texture);
  return status;
}

int main(int count, char **arguments) {
  celspan_cel_desc cel = CELSPAN_CEL_DESC;
  celspan_rostrum_desc scene = CELSPAN_ROSTRUM_DESC;
  celspan_context *context;
  celspan_contours *contours = NULL;
  celspan_object *objects[2] = {NULL, NULL};
  celspan_cel *sheet = NULL;
  celspan_rostrum *rostrum = NULL;
  cel.objects = objects, cel.object_count = 2;
  scene.cels = &sheet, scene.cel_count = 1;
  scene.back.r = scene.back.g = scene.back.b = scene.back.a = 1;
  if (count != 2 || celspan_context_create(NULL, &context) != CELSPAN_OK)
    return 1;
  bool is_good = celspan_contours_create(context, &contours) == CELSPAN_OK &&
                 draw_leaf(context, contours, objects) == CELSPAN_OK &&
                 celspan_cel_create(context, &cel, &sheet) == CELSPAN_OK &&
                 celspan_rostrum_create(context, &scene, &rostrum) == CELSPAN_OK &&
                 celspan_rostrum_write(context, rostrum, 120, 120, arguments[1]) == CELSPAN_OK;
  celspan_contours_destroy(contours);
  celspan_object_unref(objects[0]), celspan_object_unref(objects[1]);
  celspan_cel_unref(sheet), celspan_rostrum_unref(rostrum);
  celspan_context_destroy(context);
  return !is_good;
}
