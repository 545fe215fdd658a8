/* A host that is built with declarations that are kept, or with ones that differ from them in the
 * length of structures: -DFACE="file". It draws a disc, checks the statistics of the frame, and
 * writes the picture: host PICTURE */
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include FACE

static celspan_context *context;

static void check(bool is_good, const char *what) {
  if (is_good)
    return;
  fprintf(stderr, "host: %s: %s\n", what, context ? celspan_context_error(context) : "");
  exit(1);
}

static void check_status(celspan_status status) { check(status == CELSPAN_OK, "failed"); }

#define BEGIN(type, name)                                                                          \
  type name;                                                                                       \
  type##_default(&name, sizeof name)

static celspan_rostrum *make_scene(void) {
  celspan_object *object;
  celspan_cel *sheet;
  celspan_rostrum *rostrum;
  BEGIN(celspan_ellipse_desc, disc);
  disc.centre.x = disc.centre.y = 60;
  disc.radius_x = disc.radius_y = 40;
  check_status(celspan_object_create_ellipse(context, &disc, &object));
  BEGIN(celspan_cel_desc, cel);
  check(cel.opacity == 1, "a default");
  cel.objects = &object;
  cel.object_count = 1;
  check_status(celspan_cel_create(context, &cel, &sheet));
  BEGIN(celspan_rostrum_desc, scene);
  scene.cels = &sheet;
  scene.cel_count = 1;
  scene.back = (celspan_light){1, 1, 1, 1};
  check_status(celspan_rostrum_create(context, &scene, &rostrum));
  celspan_object_unref(object);
  celspan_cel_unref(sheet);
  return rostrum;
}

/* The library fills what the host has, and nothing behind it. */
static void check_statistics(celspan_rostrum *rostrum) {
  celspan_exposure exposure = {rostrum, 1};
  struct {
    celspan_statistics statistics;
    uint64_t behind;
  } room = {.behind = 77};
  BEGIN(celspan_frame_desc, frame);
  BEGIN(celspan_sink, nowhere);
  frame.width = frame.height = 120;
  frame.film_width = frame.film_height = 120;
  frame.exposures = &exposure;
  frame.exposure_count = 1;
  room.statistics.struct_size = sizeof room.statistics;
  check_status(celspan_frame_render(context, &frame, &nowhere, &room.statistics));
  check(room.statistics.rows == 120 && room.behind == 77, "statistics");
  check(room.statistics.struct_size == sizeof room.statistics, "the size of the statistics");
  room.statistics.struct_size = 3;
  check(celspan_frame_render(context, &frame, &nowhere, &room.statistics) == CELSPAN_BAD_ARGUMENT,
        "statistics of three bytes");
}

int main(int count, char **arguments) {
  BEGIN(celspan_context_desc, desc);
  check(count == 2, "give the name of a picture");
  check_status(celspan_context_create(&desc, &context));
  celspan_rostrum *rostrum = make_scene();
  check_statistics(rostrum);
  check_status(celspan_rostrum_write(context, rostrum, 120, 120, arguments[1]));
  celspan_rostrum_unref(rostrum);
  celspan_context_destroy(context);
  return 0;
}
