/* A host's own pixels as textures: a buffer that is not copied, and a live surface whose rectangles
 * are requested when they are visible. Prints two frames as characters.
 *
 *   cc surface.c $(pkg-config --cflags --libs celspan) -lm -o surface && ./surface
 */
#include <celspan/celspan.h>
#include <math.h>
#include <stdio.h>

enum { WIDTH = 64, HEIGHT = 24, SIDE = 200 };

typedef struct water { /* the live surface: rings that run outwards */
  int frame;
  long pixels; /* requested so far */
} water;

#define TRY(call)                                                                                  \
  do {                                                                                             \
    celspan_status status_ = (call);                                                               \
    if (status_ != CELSPAN_OK)                                                                     \
      return status_;                                                                              \
  } while (0)

static celspan_status fill_water(void *user, celspan_context *context,
                                 const celspan_rectangle *rectangle, void *destination,
                                 size_t stride, int32_t *rows) {
  water *w = user;
  (void)context; /* on failure, report the reason with celspan_context_fail(context, ...) */
  for (*rows = 0; *rows < rectangle->height; ++*rows) {
    unsigned char *grey = (unsigned char *)destination + (size_t)*rows * stride;
    double y = rectangle->y + *rows - SIDE / 2;
    for (int32_t x = 0; x < rectangle->width; x++)
      grey[x] =
          (unsigned char)(128 + 127 * sin(hypot(rectangle->x + x - SIDE / 2, y) / 6 - w->frame));
  }
  w->pixels += (long)rectangle->width * rectangle->height;
  return CELSPAN_OK;
}

static celspan_status make_water(celspan_context *context, water *w, celspan_surface **out) {
  celspan_surface_desc desc = CELSPAN_SURFACE_DESC;
  desc.width = SIDE;
  desc.height = SIDE;
  desc.format = CELSPAN_SURFACE_GREY8;
  desc.fill = fill_water;
  desc.user = w;
  desc.has_key = true; /* the key changes with the contents */
  desc.key[0] = (uint64_t)w->frame;
  return celspan_surface_create(context, &desc, out);
}

static void keep_nothing(void *user) { (void)user; }

/* With a release function the buffer is not copied; this buffer outlives all values that use it. */
static celspan_status make_checks(celspan_context *context, celspan_surface **out) {
  static const unsigned char checks[4] = {20, 60, 60, 20};
  celspan_surface_desc desc = CELSPAN_SURFACE_DESC;
  desc.width = desc.height = 2;
  desc.format = CELSPAN_SURFACE_GREY8;
  desc.pixels = checks;
  desc.release = keep_nothing;
  return celspan_surface_create(context, &desc, out);
}

/* A circle of water on a ground of checks. Each value holds references to its parts. */
static celspan_status make_cel(celspan_context *context, celspan_surface *water_surface,
                               celspan_surface *checks, celspan_cel **out) {
  celspan_picture_desc ground = {.struct_size = sizeof ground,
                                 .surface = checks,
                                 .sampling = CELSPAN_SAMPLING_NEAREST,
                                 .wrap = CELSPAN_WRAP_REPEAT,
                                 .has_box = true,
                                 .box = {0, 0, 40, 40}};
  celspan_texture *textures[2] = {NULL, NULL};
  celspan_object *objects[2] = {NULL, NULL};
  celspan_cel_desc cel = CELSPAN_CEL_DESC;
  cel.objects = objects;
  cel.object_count = 2;
  celspan_status status = celspan_texture_create_picture(context, &ground, &textures[0]);
  if (status == CELSPAN_OK)
    status = celspan_texture_create_picture(
        context, &CELSPAN_DESC(celspan_picture_desc, .surface = water_surface), &textures[1]);
  if (status == CELSPAN_OK)
    status = celspan_object_create_rect(
        context, &CELSPAN_DESC(celspan_rect_desc, 0, 0, 320, 240, 0, textures[0]), &objects[0]);
  if (status == CELSPAN_OK)
    status = celspan_object_create_ellipse(
        context, &CELSPAN_DESC(celspan_ellipse_desc, {160, 120}, 100, 100, textures[1]),
        &objects[1]);
  if (status == CELSPAN_OK)
    status = celspan_cel_create(context, &cel, out);
  for (int i = 0; i < 2; i++) {
    celspan_texture_unref(textures[i]);
    celspan_object_unref(objects[i]);
  }
  return status;
}

static celspan_status render(celspan_context *context, celspan_cel *cel,
                             unsigned char pixels[HEIGHT][WIDTH][4]) {
  celspan_rostrum *rostrum;
  celspan_rostrum_desc desc = CELSPAN_ROSTRUM_DESC;
  desc.cels = &cel;
  desc.cel_count = 1;
  TRY(celspan_rostrum_create(context, &desc, &rostrum));
  const celspan_exposure exposure = {rostrum, 1};
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
  celspan_status status =
      celspan_frame_pixels(context, &frame, &coding, pixels, sizeof pixels[0], NULL);
  celspan_rostrum_unref(rostrum);
  return status;
}

static void print(unsigned char pixels[HEIGHT][WIDTH][4]) {
  for (int y = 0; y < HEIGHT; y++) {
    for (int x = 0; x < WIDTH; x++)
      putchar(" .:-=+*#%@"[pixels[y][x][1] * 10 / 256]);
    putchar('\n');
  }
}

static celspan_status show_frame(celspan_context *context, water *w) {
  static unsigned char pixels[HEIGHT][WIDTH][4];
  celspan_surface *live = NULL, *checks = NULL;
  celspan_cel *cel = NULL;
  celspan_status status = make_water(context, w, &live);
  if (status == CELSPAN_OK)
    status = make_checks(context, &checks);
  if (status == CELSPAN_OK)
    status = make_cel(context, live, checks, &cel);
  if (status == CELSPAN_OK)
    status = render(context, cel, pixels);
  if (status == CELSPAN_OK)
    print(pixels);
  celspan_surface_unref(live);
  celspan_surface_unref(checks);
  celspan_cel_unref(cel);
  return status;
}

int main(void) {
  celspan_context *context;
  water w = {0, 0};
  if (celspan_context_create(NULL, &context) != CELSPAN_OK)
    return 1;
  celspan_status status = CELSPAN_OK;
  for (; w.frame < 2 && status == CELSPAN_OK; w.frame++)
    status = show_frame(context, &w);
  if (status != CELSPAN_OK)
    fprintf(stderr, "%s\n", celspan_context_error(context));
  else
    printf("%ld pixels were asked for\n", w.pixels);
  celspan_context_destroy(context);
  return status != CELSPAN_OK;
}
