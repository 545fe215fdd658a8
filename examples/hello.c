/* The shortest program: cc hello.c $(pkg-config --cflags --libs celspan) && ./a.out hello.png */
#include <celspan/celspan.h>

int main(int count, char **arguments) {
  celspan_ellipse_desc disc = CELSPAN_ELLIPSE_DESC;
  celspan_cel_desc cel = CELSPAN_CEL_DESC;
  celspan_rostrum_desc scene = CELSPAN_ROSTRUM_DESC;
  celspan_context *context;
  celspan_object *object = NULL;
  celspan_cel *sheet = NULL;
  celspan_rostrum *rostrum = NULL;
  disc.centre.x = disc.centre.y = 60;
  disc.radius_x = disc.radius_y = 40; /* black, as nothing else is said */
  cel.objects = &object, cel.object_count = 1;
  scene.cels = &sheet, scene.cel_count = 1;
  scene.back.r = scene.back.g = scene.back.b = scene.back.a = 1; /* white paper, lit from behind */
  if (count != 2 || celspan_context_create(NULL, &context) != CELSPAN_OK)
    return 1;
  bool is_good = celspan_object_create_ellipse(context, &disc, &object) == CELSPAN_OK &&
                 celspan_cel_create(context, &cel, &sheet) == CELSPAN_OK &&
                 celspan_rostrum_create(context, &scene, &rostrum) == CELSPAN_OK &&
                 celspan_rostrum_write(context, rostrum, 120, 120, arguments[1]) == CELSPAN_OK;
  celspan_object_unref(object), celspan_cel_unref(sheet), celspan_rostrum_unref(rostrum);
  celspan_context_destroy(context);
  return !is_good;
}
