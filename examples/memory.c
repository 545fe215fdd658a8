/* Renders one frame to memory and prints it as characters: the smallest use of the C interface.
 *
 *   cc memory.c $(pkg-config --cflags --libs celspan) -o memory && ./memory
 *
 * A moon (one circle minus another) that glows over a slide of dusk that is lit from behind.
 */
#include <celspan/celspan.h>
#include <stdio.h>

enum { WIDTH = 64, HEIGHT = 24 };

/* All values that are made, so that they can be released in one place. */
typedef struct scene {
  celspan_texture *ivory, *dusk;
  celspan_object *disc, *shadow, *moon, *glowing, *sky;
  celspan_cel *rear, *front;
  celspan_rostrum *rostrum;
} scene;

#define TRY(call)                                                                                  \
  do {                                                                                             \
    celspan_status status_ = (call);                                                               \
    if (status_ != CELSPAN_OK)                                                                     \
      return status_;                                                                              \
  } while (0)

static celspan_status make_objects(celspan_context *context, scene *s) {
  const celspan_paint ivory = celspan_paint_rgb(0.9f, 0.85f, 0.7f, 1);
  const celspan_stop stops[] = {{0, celspan_paint_gel(0.05f, 0.1f, 0.3f)},
                                {1, celspan_paint_gel(0.6f, 0.3f, 0.2f)}};
  TRY(celspan_texture_create_paint(context, &ivory, &s->ivory));
  TRY(celspan_texture_create_linear(context, (celspan_point){0, 0}, (celspan_point){0, 240}, stops,
                                    2, &s->dusk));
  TRY(celspan_object_create_ellipse(
      context, &CELSPAN_DESC(celspan_ellipse_desc, {200, 110}, 80, 80, s->ivory), &s->disc));
  TRY(celspan_object_create_ellipse(
      context, &CELSPAN_DESC(celspan_ellipse_desc, {235, 95}, 70, 70, NULL), &s->shadow));
  celspan_object *const operands[] = {s->disc, s->shadow};
  TRY(celspan_object_create_boolean(context, CELSPAN_OPERATOR_DIFFERENCE, operands, 2, &s->moon));
  return celspan_object_create_rect(
      context, &CELSPAN_DESC(celspan_rect_desc, 0, 0, 320, 240, 0, s->dusk), &s->sky);
}

static celspan_status make_glow(celspan_context *context, scene *s) {
  celspan_glow_desc glow = CELSPAN_GLOW_DESC;
  glow.radius = 40;
  glow.colour = s->ivory;
  return celspan_object_glow(context, s->moon, &glow, &s->glowing);
}

static celspan_status make_scene(celspan_context *context, scene *s) {
  TRY(make_objects(context, s));
  TRY(make_glow(context, s));
  celspan_cel_desc rear = CELSPAN_CEL_DESC, front = CELSPAN_CEL_DESC;
  rear.objects = &s->sky;
  rear.object_count = 1;
  rear.back = (celspan_light){1, 1, 1, 1};
  front.objects = &s->glowing;
  front.object_count = 1;
  TRY(celspan_cel_create(context, &rear, &s->rear));
  TRY(celspan_cel_create(context, &front, &s->front));
  celspan_cel *const cels[] = {s->rear, s->front}; /* later is nearer the camera */
  celspan_rostrum_desc desc = CELSPAN_ROSTRUM_DESC;
  desc.cels = cels;
  desc.cel_count = 2;
  return celspan_rostrum_create(context, &desc, &s->rostrum);
}

static void drop_scene(scene *s) {
  celspan_rostrum_unref(s->rostrum);
  celspan_cel_unref(s->rear);
  celspan_cel_unref(s->front);
  celspan_object_unref(s->glowing);
  celspan_object_unref(s->moon);
  celspan_object_unref(s->disc);
  celspan_object_unref(s->shadow);
  celspan_object_unref(s->sky);
  celspan_texture_unref(s->ivory);
  celspan_texture_unref(s->dusk);
}

/* The film is 320 x 240 units at any output size. */
static celspan_status render(celspan_context *context, const scene *s,
                             unsigned char pixels[HEIGHT][WIDTH][4]) {
  const celspan_exposure exposure = {s->rostrum, 1};
  const celspan_coding coding = {.struct_size = sizeof coding,
                                 .depth = CELSPAN_DEPTH_8,
                                 .transfer = CELSPAN_TRANSFER_SRGB,
                                 .alpha = CELSPAN_ALPHA_STRAIGHT};
  celspan_frame_desc frame = CELSPAN_FRAME_DESC;
  frame.exposures = &exposure;
  frame.exposure_count = 1;
  frame.film_width = 320;
  frame.film_height = 240;
  frame.width = WIDTH;
  frame.height = HEIGHT;
  return celspan_frame_pixels(context, &frame, &coding, pixels, sizeof pixels[0], NULL);
}

static void print(unsigned char pixels[HEIGHT][WIDTH][4]) {
  static const char shades[] = " .:-=+*#%@";
  for (int y = 0; y < HEIGHT; y++) {
    for (int x = 0; x < WIDTH; x++) {
      const unsigned char *p = pixels[y][x];
      putchar(shades[(p[0] + p[1] + p[2]) * 9 / (3 * 255)]);
    }
    putchar('\n');
  }
}

int main(void) {
  static unsigned char pixels[HEIGHT][WIDTH][4];
  celspan_context *context;
  scene s = {0};
  if (celspan_context_create(NULL, &context) != CELSPAN_OK) {
    fprintf(stderr, "memory: not enough memory for a context\n");
    return 1;
  }
  celspan_status status = make_scene(context, &s);
  if (status == CELSPAN_OK)
    status = render(context, &s, pixels);
  if (status == CELSPAN_OK)
    print(pixels);
  else
    fprintf(stderr, "memory: %s: %s\n", celspan_status_name(status),
            celspan_context_error(context));
  drop_scene(&s);
  celspan_context_destroy(context);
  return status != CELSPAN_OK;
}
