/* Taking light off pictures, through the public header: the remaining S and T of pictures for which
 * they are known, fields of light, refusals, and failing allocations. The rendered pictures are in
 * tests/desk/spec/relight_spec.lua. One file, because all tests share those pictures. */
#include <stdlib.h>

#include "celspan/celspan.h"
#include "celspan/relight.h"
#include "tests/support/check.h"
#include "tests/support/memory.h"
#include "tests/support/random.h"

enum { WIDTH = 70, HEIGHT = 66, COUNT = WIDTH * HEIGHT };

typedef float pixels[COUNT][4];

/* The S and T of a card, and the pictures made from it. */
static pixels s_of, t_of, room[4];

static void make_card(void) {
  test_random random = {5};
  for (int i = 0; i < COUNT; i++) {
    float beta = i % 7 == 0 ? 0 : i % 5 == 0 ? 1 : random_unit(&random);
    for (int c = 0; c < 3; c++) {
      s_of[i][c] = beta * random_unit(&random) * (i % 11 == 0 ? 12 : 1);
      t_of[i][c] = (1 - beta) * random_unit(&random);
    }
    s_of[i][3] = beta;
    t_of[i][3] = 1;
  }
}

static void light_card(const float front[3], const float behind[3], pixels out) {
  for (int i = 0; i < COUNT; i++) {
    for (int c = 0; c < 3; c++)
      out[i][c] = s_of[i][c] * front[c] + t_of[i][c] * behind[c];
    out[i][3] = 1;
  }
}

static celspan_status make_texture(celspan_context *context, const void *values, int32_t height,
                                   celspan_texture **out) {
  celspan_surface_desc surface = CELSPAN_SURFACE_DESC;
  celspan_picture_desc desc = {.struct_size = sizeof desc};
  surface.width = WIDTH;
  surface.height = height;
  surface.format = CELSPAN_SURFACE_RGBAF;
  surface.pixels = values;
  celspan_status status = celspan_surface_create(context, &surface, &desc.surface);
  if (status == CELSPAN_OK)
    status = celspan_texture_create_picture(context, &desc, out);
  celspan_surface_unref(desc.surface);
  return status;
}

/* The texture in a light, in front of a background. */
static celspan_status render(celspan_context *context, celspan_texture *texture,
                             celspan_light front, celspan_light back, pixels out) {
  celspan_object *object = NULL;
  celspan_cel *cel = NULL;
  celspan_rostrum *rostrum = NULL;
  celspan_rect_desc rect = {
      .struct_size = sizeof rect, .width = WIDTH, .height = HEIGHT, .texture = texture};
  celspan_cel_desc of_cel = CELSPAN_CEL_DESC;
  celspan_rostrum_desc of_rostrum = CELSPAN_ROSTRUM_DESC;
  celspan_status status = celspan_object_create_rect(context, &rect, &object);
  of_cel.objects = &object;
  of_cel.object_count = 1;
  of_cel.has_front = true;
  of_cel.front = front;
  of_cel.back = back;
  if (status == CELSPAN_OK)
    status = celspan_cel_create(context, &of_cel, &cel);
  of_rostrum.cels = &cel;
  of_rostrum.cel_count = 1;
  if (status == CELSPAN_OK)
    status = celspan_rostrum_create(context, &of_rostrum, &rostrum);
  celspan_exposure exposure = {rostrum, 1};
  celspan_frame_desc frame = CELSPAN_FRAME_DESC;
  frame.exposures = &exposure;
  frame.exposure_count = 1;
  frame.width = WIDTH;
  frame.height = HEIGHT;
  frame.workers = 1;
  celspan_coding coding = {.struct_size = sizeof coding, .depth = CELSPAN_DEPTH_FLOAT};
  if (status == CELSPAN_OK)
    status = celspan_frame_pixels(context, &frame, &coding, out, sizeof out[0] * WIDTH, NULL);
  celspan_rostrum_unref(rostrum);
  celspan_cel_unref(cel);
  celspan_object_unref(object);
  return status;
}

static const float lamp[3] = {1.5f, 0.75f, 0.25f}, box[3] = {0.5f, 1, 2};
static const float none[3] = {0, 0, 0};

static celspan_light_field field_of(const float light[3]) {
  return celspan_light_field_flat((double)light[0], (double)light[1], (double)light[2]);
}

/* Compares a texture with the card in other lights. */
static void check_card(celspan_context *context, celspan_texture *texture) {
  static pixels expected, found;
  const float front[3] = {0.2f, 0.4f, 3}, behind[3] = {0.9f, 0.3f, 0.6f};
  double worst = 0;
  light_card(front, behind, expected);
  if (!CHECK(render(context, texture, (celspan_light){front[0], front[1], front[2], 1},
                    (celspan_light){behind[0], behind[1], behind[2], 1}, found) == CELSPAN_OK))
    return;
  for (int i = 0; i < COUNT; i++)
    for (int c = 0; c < 4; c++)
      worst =
          fmax(worst, fabs((double)(found[i][c] - expected[i][c])) / (1 + (double)expected[i][c]));
  CHECK_NEAR(worst, 0, 2e-5);
}

/* ---------------------------------------------------------------- what is left */

static celspan_status from_exposures(celspan_context *context, celspan_texture **out) {
  celspan_texture *front = NULL, *back = NULL;
  celspan_light_field front_light = field_of(lamp), back_light = field_of(box);
  light_card(lamp, none, room[0]);
  light_card(none, box, room[1]);
  celspan_status status = make_texture(context, room[0], HEIGHT, &front);
  if (status == CELSPAN_OK)
    status = make_texture(context, room[1], HEIGHT, &back);
  if (status == CELSPAN_OK)
    status = celspan_relight_exposures(context, front, &front_light, back, &back_light, out);
  celspan_texture_unref(front);
  celspan_texture_unref(back);
  return status;
}

static celspan_status from_grounds(celspan_context *context, celspan_texture **out) {
  celspan_texture *first = NULL, *second = NULL, *ground = NULL;
  celspan_light_field light = field_of(lamp);
  light_card(lamp, none, room[0]);
  light_card(lamp, box, room[1]);
  for (int i = 0; i < COUNT; i++)
    memcpy(room[2][i], (const float[4]){box[0], box[1], box[2], 1}, sizeof room[2][i]);
  celspan_status status = make_texture(context, room[0], HEIGHT, &first);
  if (status == CELSPAN_OK)
    status = make_texture(context, room[1], HEIGHT, &second);
  if (status == CELSPAN_OK)
    status = make_texture(context, room[2], HEIGHT, &ground);
  const celspan_relight_ground grounds[2] = {{.picture = first},
                                             {.picture = second, .ground = ground}};
  if (status == CELSPAN_OK)
    status = celspan_relight_grounds(context, grounds, &light, out);
  celspan_texture_unref(first);
  celspan_texture_unref(second);
  celspan_texture_unref(ground);
  return status;
}

static void both_ways_find_the_card(celspan_context *context) {
  celspan_texture *texture;
  if (CHECK(from_exposures(context, &texture) == CELSPAN_OK)) {
    check_card(context, texture);
    celspan_texture_unref(texture);
  }
  if (CHECK(from_grounds(context, &texture) == CELSPAN_OK)) {
    check_card(context, texture);
    celspan_texture_unref(texture);
  }
}

/* ---------------------------------------------------------------- fields */

/* A white sheet in a field of light: the field is found again, and removing it leaves white. */
static void fields_are_fitted(celspan_context *context) {
  celspan_light_field truth = celspan_light_field_flat(0.8, 0.5, 0.3), found;
  celspan_texture *sheet = NULL, *white = NULL;
  for (int c = 0; c < 3; c++) {
    truth.terms[c][0] = 0.5 - 0.2 * c;
    truth.terms[c][3] = -0.3;
    truth.terms[c][7] = 0.1 * c;
  }
  if (!CHECK(celspan_light_field_texture(context, &truth, WIDTH, HEIGHT, &sheet) == CELSPAN_OK))
    return;
  celspan_light_estimate_desc desc = CELSPAN_LIGHT_ESTIMATE_DESC;
  desc.picture = sheet;
  desc.is_uneven = true;
  desc.clue = CELSPAN_LIGHT_CLUE_PATCH;
  desc.patch = (celspan_box){10, 10, 5, 5};
  for (int c = 0; c < 3; c++)
    desc.colour[c] = 1;
  if (CHECK(celspan_light_estimate(context, &desc, &found) == CELSPAN_OK)) {
    for (int i = 0; i < 25; i++) {
      double a[3], b[3];
      celspan_light_field_at(&truth, i % 5 / 4.0, i / 5 / 4.0, a);
      celspan_light_field_at(&found, i % 5 / 4.0, i / 5 / 4.0, b);
      for (int c = 0; c < 3; c++)
        CHECK_NEAR(b[c] / a[c], 1, 2e-3);
    }
    if (CHECK(celspan_relight_picture(context, sheet, &found, &white) == CELSPAN_OK)) {
      CHECK(render(context, white, (celspan_light){1, 1, 1, 1}, (celspan_light){0, 0, 0, 0},
                   room[0]) == CELSPAN_OK);
      CHECK_NEAR(room[0][COUNT / 2][1], 1, 2e-3);
    }
  }
  celspan_texture_unref(white);
  celspan_texture_unref(sheet);
}

/* Light of which the mean is known has that mean, however uneven it is. */
static void a_known_mean_is_kept(celspan_context *context) {
  enum { STEPS = 64 };
  celspan_light_field truth = celspan_light_field_flat(0.8, 0.5, 0.3), found;
  celspan_texture *sheet = NULL;
  double sum[3] = {0, 0, 0};
  for (int c = 0; c < 3; c++)
    truth.terms[c][0] = 2; /* it is darkest where the mean begins, on the left */
  if (!CHECK(celspan_light_field_texture(context, &truth, WIDTH, HEIGHT, &sheet) == CELSPAN_OK))
    return;
  celspan_light_estimate_desc desc = CELSPAN_LIGHT_ESTIMATE_DESC;
  desc.picture = sheet;
  desc.is_uneven = true;
  desc.clue = CELSPAN_LIGHT_CLUE_LIGHT;
  for (int c = 0; c < 3; c++)
    desc.colour[c] = 0.25 * (c + 1);
  CHECK(celspan_light_estimate(context, &desc, &found) == CELSPAN_OK);
  for (int i = 0; i < STEPS * STEPS; i++) {
    double rgb[3];
    celspan_light_field_at(&found, (i % STEPS + 0.5) / STEPS, (i / STEPS + 0.5) / STEPS, rgb);
    for (int c = 0; c < 3; c++)
      sum[c] += rgb[c] / (STEPS * STEPS);
  }
  for (int c = 0; c < 3; c++)
    CHECK_NEAR(sum[c] / desc.colour[c], 1, 1e-9);
  celspan_texture_unref(sheet);
}

/* ---------------------------------------------------------------- refusals */

static void lights_are_checked(celspan_context *context, celspan_texture *picture) {
  celspan_texture *out;
  celspan_light_field light = celspan_light_field_flat(1, 0, 1);
  CHECK(celspan_relight_picture(context, picture, &light, &out) == CELSPAN_BAD_ARGUMENT);
  CHECK(strstr(celspan_context_error(context), "there is no green in the light") != NULL);
  light.colour[1] = NAN;
  CHECK(celspan_relight_picture(context, picture, &light, &out) == CELSPAN_BAD_ARGUMENT);
  light.colour[1] = 1e-5; /* S would be 1,200,000 */
  CHECK(celspan_relight_picture(context, picture, &light, &out) == CELSPAN_BAD_ARGUMENT);
  CHECK(strstr(celspan_context_error(context), "too dim") != NULL);
  light = celspan_light_field_flat(1, 1, 1);
  light.terms[2][8] = 21;
  CHECK(celspan_relight_picture(context, picture, &light, &out) == CELSPAN_BAD_ARGUMENT);
  CHECK(celspan_light_field_texture(context, &light, 4, 4, &out) == CELSPAN_BAD_ARGUMENT);
  light.terms[2][8] = 0;
  CHECK(celspan_light_field_texture(context, &light, 0, 4, &out) == CELSPAN_BAD_ARGUMENT);
}

static void textures_are_checked(celspan_context *context, celspan_texture *picture) {
  celspan_texture *out, *paint = NULL, *small = NULL;
  celspan_light_field light = celspan_light_field_flat(1, 1, 1);
  celspan_picture_desc medium = {.struct_size = sizeof medium, .file = "none.exr"};
  const celspan_paint red = celspan_paint_rgb(1, 0, 0, 1);
  if (!CHECK(celspan_texture_create_paint(context, &red, &paint) == CELSPAN_OK) ||
      !CHECK(make_texture(context, room[0], HEIGHT - 1, &small) == CELSPAN_OK))
    return;
  CHECK(celspan_relight_picture(context, paint, &light, &out) == CELSPAN_BAD_ARGUMENT);
  CHECK(celspan_relight_picture(context, NULL, &light, &out) == CELSPAN_BAD_ARGUMENT);
  CHECK(celspan_texture_with_medium(context, paint, &medium, &out) == CELSPAN_BAD_ARGUMENT);
  CHECK(celspan_relight_write(context, paint, "/tmp/paint.exr") == CELSPAN_BAD_ARGUMENT);
  CHECK(celspan_relight_write(context, picture, "/tmp/paint.png") == CELSPAN_BAD_ARGUMENT);
  CHECK(celspan_relight_exposures(context, picture, &light, small, &light, &out) ==
        CELSPAN_BAD_ARGUMENT);
  CHECK(strstr(celspan_context_error(context), "70 x 66 pixels, and ") != NULL);
  celspan_texture_unref(paint);
  celspan_texture_unref(small);
}

static void estimates_are_checked(celspan_context *context, celspan_texture *picture) {
  celspan_light_field found;
  celspan_light_estimate_desc desc = CELSPAN_LIGHT_ESTIMATE_DESC;
  CHECK(celspan_light_estimate(context, &desc, &found) == CELSPAN_BAD_ARGUMENT);
  desc.picture = picture;
  CHECK(celspan_light_estimate(context, &desc, &found) == CELSPAN_OK);
  desc.colour[0] = 0;
  CHECK(celspan_light_estimate(context, &desc, &found) == CELSPAN_BAD_ARGUMENT);
  desc.colour[0] = 0.5;
  desc.clue = CELSPAN_LIGHT_CLUE_PATCH;
  desc.patch = (celspan_box){-9, 0, 5, 5};
  CHECK(celspan_light_estimate(context, &desc, &found) == CELSPAN_BAD_ARGUMENT);
  CHECK(strstr(celspan_context_error(context), "there is nothing in the patch") != NULL);
  desc.struct_size = 3;
  CHECK(celspan_light_estimate(context, &desc, &found) == CELSPAN_BAD_ARGUMENT);
}

/* Half of it almost dark and half brighter than any paper: such a field cannot be divided by,
 * whatever else is known of the light. */
static void fields_that_are_too_uneven_are_refused(celspan_context *context) {
  celspan_light_estimate_desc desc = CELSPAN_LIGHT_ESTIMATE_DESC;
  celspan_light_field found;
  celspan_texture *halves = NULL;
  for (int i = 0; i < COUNT; i++)
    for (int c = 0; c < 4; c++)
      room[0][i][c] = c == 3 ? 1 : i % WIDTH < WIDTH / 2 ? 1e-4f : 60000;
  if (!CHECK(make_texture(context, room[0], HEIGHT, &halves) == CELSPAN_OK))
    return;
  desc.picture = halves;
  desc.is_uneven = true;
  for (int clue = CELSPAN_LIGHT_CLUE_GREY; clue <= CELSPAN_LIGHT_CLUE_LIGHT; clue++) {
    desc.clue = (celspan_light_clue)clue;
    desc.patch = (celspan_box){0, 0, WIDTH, HEIGHT};
    CHECK(celspan_light_estimate(context, &desc, &found) == CELSPAN_BAD_ARGUMENT);
    CHECK(strstr(celspan_context_error(context), "the terms of the light's red must not sum"));
  }
  celspan_texture_unref(halves);
}

static void grounds_are_checked(celspan_context *context, celspan_texture *picture) {
  static const char *const said[] = {"grounds[1]", "grounds[2]"};
  celspan_light_field light = field_of(lamp);
  celspan_texture *out;
  for (int i = 0; i < 2; i++) {
    celspan_relight_ground grounds[2] = {{.picture = picture}, {.picture = picture}};
    grounds[i].colour[1] = -1;
    CHECK(celspan_relight_grounds(context, grounds, &light, &out) == CELSPAN_BAD_ARGUMENT);
    if (!CHECK(strstr(celspan_context_error(context), said[i])))
      fprintf(stderr, "it says: %s\n", celspan_context_error(context));
  }
}

static void refusals(celspan_context *context) {
  celspan_texture *picture;
  light_card(lamp, none, room[0]);
  if (!CHECK(make_texture(context, room[0], HEIGHT, &picture) == CELSPAN_OK))
    return;
  lights_are_checked(context, picture);
  textures_are_checked(context, picture);
  estimates_are_checked(context, picture);
  grounds_are_checked(context, picture);
  celspan_texture_unref(picture);
}

/* ---------------------------------------------------------------- frames taken apart */

enum { CELS = 3, SIDE = 48 };

/* A frame of three cels: discs of half clear paint, the middle one a picture of the card. */
typedef struct scene {
  celspan_texture *card;
  celspan_object *objects[CELS];
  celspan_cel *cels[CELS];
  celspan_rostrum *rostrum;
} scene;

static void free_scene(scene *s) {
  celspan_rostrum_unref(s->rostrum);
  for (int i = 0; i < CELS; i++) {
    celspan_cel_unref(s->cels[i]);
    celspan_object_unref(s->objects[i]);
  }
  celspan_texture_unref(s->card);
}

static celspan_status make_cel(celspan_context *context, scene *s, int i,
                               const celspan_stack_light *light) {
  celspan_texture *texture = NULL;
  const celspan_paint paint = celspan_paint_rgb(0.9f, 0.2f * (float)i, 0.4f, 0.6f);
  celspan_status status =
      i == 1 ? CELSPAN_OK : celspan_texture_create_paint(context, &paint, &texture);
  celspan_ellipse_desc disc = {.struct_size = sizeof disc,
                               .centre = {14 + 9 * i, 20 + 5 * i},
                               .radius_x = 13,
                               .radius_y = 13,
                               .texture = i == 1 ? s->card : texture};
  celspan_cel_desc desc = CELSPAN_CEL_DESC;
  if (status == CELSPAN_OK)
    status = celspan_object_create_ellipse(context, &disc, &s->objects[i]);
  celspan_texture_unref(texture);
  desc.objects = &s->objects[i];
  desc.object_count = 1;
  desc.has_front = true;
  desc.front = light->front;
  desc.back = light->back;
  return status == CELSPAN_OK ? celspan_cel_create(context, &desc, &s->cels[i]) : status;
}

/* lights: one for the rostrum, and one for each cel. */
static celspan_status make_scene(celspan_context *context, const celspan_stack_light *lights,
                                 scene *out) {
  *out = (scene){0};
  celspan_rostrum_desc desc = CELSPAN_ROSTRUM_DESC;
  celspan_status status = from_exposures(context, &out->card);
  for (int i = 0; i < CELS && status == CELSPAN_OK; i++)
    status = make_cel(context, out, i, &lights[i + 1]);
  desc.cels = out->cels;
  desc.cel_count = CELS;
  desc.back = lights[0].back;
  return status == CELSPAN_OK ? celspan_rostrum_create(context, &desc, &out->rostrum) : status;
}

static celspan_frame_desc frame_of(const celspan_exposure *exposure) {
  celspan_frame_desc frame = CELSPAN_FRAME_DESC;
  frame.exposures = exposure;
  frame.exposure_count = 1;
  frame.width = frame.height = SIDE;
  frame.workers = 2;
  return frame;
}

static const celspan_stack_light dim[CELS + 1] = {{{0, 0, 0, 1}, {0.2f, 0.3f, 0.4f, 0.5f}},
                                                  {{1, 0.5f, 0.2f, 1}, {0, 0, 0, 0}},
                                                  {{0.7f, 0.7f, 0.7f, 1}, {0.1f, 0, 0.1f, 0.2f}},
                                                  {{1, 1, 1, 1}, {0, 0, 0, 0}}};
static const celspan_stack_light bright[CELS + 1] = {{{0, 0, 0, 1}, {1, 0, 0, 0}},
                                                     {{0, 2, 0, 1}, {0, 0, 0, 0.9f}},
                                                     {{3, 0.1f, 0.7f, 1}, {0, 1, 0, 0}},
                                                     {{0.5f, 0.4f, 1.5f, 1}, {0, 0, 2, 0}}};

/* The stack in some lights compared with a scene that has them. */
static void compare_lights(celspan_context *context, const celspan_stack *stack,
                           const celspan_stack_light *lights) {
  static float expected[SIDE * SIDE][4], found[SIDE * SIDE][4];
  scene s;
  celspan_coding coding = {.struct_size = sizeof coding, .depth = CELSPAN_DEPTH_FLOAT};
  if (!CHECK(make_scene(context, lights, &s) == CELSPAN_OK))
    return;
  celspan_exposure exposure = {s.rostrum, 1};
  celspan_frame_desc frame = frame_of(&exposure);
  double worst = 0;
  CHECK(celspan_frame_pixels(context, &frame, &coding, expected, sizeof expected[0] * SIDE, NULL) ==
        CELSPAN_OK);
  CHECK(celspan_stack_pixels(context, stack, lights, 2, found[0]) == CELSPAN_OK);
  for (int i = 0; i < SIDE * SIDE; i++)
    for (int c = 0; c < 4; c++)
      worst = fmax(worst, fabs((double)(expected[i][c] - found[i][c])));
  CHECK_NEAR(worst, 0, 1.0 / 65535);
  free_scene(&s);
}

static void stacks_take_any_light(celspan_context *context) {
  scene s;
  celspan_stack *stack = NULL;
  celspan_stack_light own[CELS + 1];
  int32_t width, height;
  if (!CHECK(make_scene(context, dim, &s) == CELSPAN_OK))
    return;
  celspan_exposure exposure = {s.rostrum, 1};
  celspan_frame_desc frame = frame_of(&exposure);
  if (!CHECK(celspan_stack_create(context, &frame, &stack) == CELSPAN_OK))
    return;
  celspan_stack_size(stack, &width, &height);
  CHECK(width == SIDE && height == SIDE && celspan_stack_bytes(stack) > 16 * SIDE * SIDE);
  if (CHECK(celspan_stack_light_count(stack) == CELS + 1)) {
    celspan_stack_lights(stack, own);
    CHECK(memcmp(&own[2], &dim[2], sizeof own[2]) == 0 && own[0].back.b == dim[0].back.b);
  }
  compare_lights(context, stack, dim);
  compare_lights(context, stack, bright);
  memcpy(own, dim, sizeof own);
  own[2].front.g = 4; /* the difference of one light is added to the frame in the other lights */
  compare_lights(context, stack, own);
  own[2].front.g = -1;
  CHECK(celspan_stack_pixels(context, stack, own, 1, room[0][0]) == CELSPAN_BAD_ARGUMENT);
  celspan_stack_unref(celspan_stack_ref(stack));
  celspan_stack_unref(stack);
  frame.exposure_count = 0;
  CHECK(celspan_stack_create(context, &frame, &stack) == CELSPAN_BAD_ARGUMENT);
  frame.exposure_count = 1;
  frame.has_tolerance = true;
  frame.tolerance = 2;
  CHECK(celspan_stack_create(context, &frame, &stack) == CELSPAN_BAD_ARGUMENT);
  free_scene(&s);
}

/* ---------------------------------------------------------------- memory */

static celspan_status take_apart(celspan_context *context) {
  scene s;
  celspan_stack *stack = NULL;
  celspan_status status = make_scene(context, dim, &s);
  celspan_exposure exposure = {s.rostrum, 1};
  celspan_frame_desc frame = frame_of(&exposure);
  frame.workers = 1;
  if (status == CELSPAN_OK)
    status = celspan_stack_create(context, &frame, &stack);
  if (status == CELSPAN_OK)
    status = celspan_stack_pixels(context, stack, bright, 1, room[3][0]);
  celspan_stack_unref(stack);
  free_scene(&s);
  return status;
}

static celspan_status make_and_show(celspan_context *context) {
  celspan_texture *texture = NULL;
  celspan_status status = from_grounds(context, &texture);
  if (status == CELSPAN_OK)
    status =
        render(context, texture, (celspan_light){1, 1, 1, 1}, (celspan_light){1, 1, 1, 1}, room[3]);
  celspan_texture_unref(texture);
  return status;
}

static void memory_may_fail_anywhere(celspan_status (*work)(celspan_context *context),
                                     bool is_for_good) {
  memory_watch watch = {.is_for_good = is_for_good};
  celspan_context *context = memory_watch_context(&watch);
  if (!CHECK(context && work(context) == CELSPAN_OK))
    return;
  celspan_status status;
  size_t fail_at = 0;
  do {
    watch.fail_at = watch.allocations + ++fail_at;
    status = work(context);
    watch.fail_at = 0;
  } while (CHECK(status == CELSPAN_OK || status == CELSPAN_NO_MEMORY) && status != CELSPAN_OK &&
           fail_at < 100000);
  CHECK(fail_at > 20 && watch.size_errors == 0);
  celspan_context_destroy(context);
  CHECK(watch.blocks == 0);
}

int main(void) {
  celspan_context *context;
  if (celspan_context_create(NULL, &context) != CELSPAN_OK)
    return 1;
  make_card();
  both_ways_find_the_card(context);
  fields_are_fitted(context);
  a_known_mean_is_kept(context);
  fields_that_are_too_uneven_are_refused(context);
  refusals(context);
  stacks_take_any_light(context);
  celspan_context_destroy(context);
  memory_may_fail_anywhere(make_and_show, false);
  memory_may_fail_anywhere(make_and_show, true);
  memory_may_fail_anywhere(take_apart, false);
  memory_may_fail_anywhere(take_apart, true);
  return check_done();
}
