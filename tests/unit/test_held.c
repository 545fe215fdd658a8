/* frames/render/held.h: a frame of which bands are given out is the frame that would be made, by
 * any number of workers and with any memory, and bands are held where nothing has changed.
 */
#include "frames/render/held.h"

#include "base/thread_pool.h"
#include "output/sinks/pixels.h"
#include "tests/support/memory.h"
#include "tests/support/random.h"
#include "tests/support/scene.h"

enum { WIDTH = 96, HEIGHT = 160, FRAMES = 6, CELS = 7, BANDS = HEIGHT / CS_FRAME_BAND };

typedef unsigned char picture[HEIGHT][WIDTH][4];

static celspan_context *context_of(memory_watch *watch, size_t bytes) {
  celspan_context_desc desc = CELSPAN_CONTEXT_DESC;
  desc.resize = memory_watch_resize;
  desc.resize_user = watch;
  desc.defocus_bytes = bytes;
  celspan_context *context = NULL;
  CHECK(celspan_context_create(&desc, &context) == CELSPAN_OK);
  return context;
}

/* ---------------------------------------------------------------- random films */

static celspan_paint random_paint(test_random *random) {
  float r = random_unit(random), g = random_unit(random), b = random_unit(random);
  static const float alphas[] = {1, 1, 0.6f};
  return celspan_paint_rgb(r, g, b, alphas[random_below(random, 3)]);
}

static celspan_object *random_object(studio *s, test_random *random, double top, double height) {
  celspan_point a = random_point(random, 0, WIDTH, top, top + height);
  celspan_point b = random_point(random, 0, WIDTH, top, top + height);
  const celspan_stop stops[2] = {{0, random_paint(random)}, {1, random_paint(random)}};
  celspan_texture *texture =
      random_below(random, 2) ? studio_paint(s, stops[0].paint) : studio_linear(s, a, b, stops, 2);
  double size = random_between(random, 2, height / 2);
  switch (random_below(random, 3)) {
  case 0:
    return studio_circle(s, a.x, a.y, size, texture);
  case 1:
    return studio_rect(s, a.x - 30, a.y - size / 2, 60, size, texture);
  default:
    return studio_pair(s, CELSPAN_OPERATOR_DIFFERENCE, studio_circle(s, a.x, a.y, size, texture),
                       studio_circle(s, b.x, b.y, size, texture));
  }
}

/* The kinds of a cel: plain, blurred, faded, with a mode, a back light, a front light. */
static celspan_cel_desc random_kind(test_random *random) {
  celspan_cel_desc desc = CELSPAN_CEL_DESC;
  int which = random_below(random, 9);
  if (which == 0)
    desc.defocus = random_between(random, 1, 6);
  if (which == 1)
    desc.opacity = random_between(random, 0, 1);
  if (which == 2)
    desc.blend = CELSPAN_BLEND_MULTIPLY;
  if (which == 3)
    desc.back = (celspan_light){0.2, 0.1, random_between(random, 0, 1), 0.5};
  return desc;
}

static celspan_cel *random_cel(studio *s, test_random *random, int shapes, double top,
                               double height) {
  celspan_object *objects[80];
  celspan_cel_desc desc = random_kind(random);
  for (int i = 0; i < shapes; i++)
    objects[i] = random_object(s, random, top, height);
  return studio_cel(s, desc, objects, (size_t)shapes);
}

int main(void) {
  return check_done();
}
