/* Every public function that takes lists, with missing lists and with counts beyond any memory:
 * each is refused with a sentence before an item of the list is read. To be run under the address
 * sanitizer: the lists have one item. */
#include <limits.h>
#include <stdint.h>
#include <string.h>

#include "celspan/text.h"
#include "tests/support/check.h"
#include "tests/support/memory.h"
#include "tests/support/probe.h"

static celspan_context *context;
static const size_t counts[] = {10000001, SIZE_MAX / 8, SIZE_MAX / 2, SIZE_MAX};
#define COUNTS (sizeof counts / sizeof *counts)

#define REFUSED(call)                                                                              \
  do {                                                                                             \
    celspan_status status_ = (call);                                                               \
    if (!CHECK(status_ == CELSPAN_BAD_ARGUMENT || status_ == CELSPAN_LIMIT))                       \
      fprintf(stderr, "line %d: %s\n", __LINE__, celspan_status_name(status_));                    \
    CHECK(celspan_context_error(context)[0] != 0);                                                 \
  } while (0)

static void check_textures(void) {
  const celspan_point at = {0, 0}, points[3] = {{0, 0}, {1, 0}, {0, 1}};
  const celspan_paint paints[3] = {{.beta = 1}};
  const celspan_stop stop = {0};
  celspan_texture *texture;
  for (size_t i = 0; i < COUNTS; i++) {
    REFUSED(celspan_texture_create_linear(context, at, points[1], &stop, counts[i], &texture));
    REFUSED(celspan_texture_create_linear(context, at, points[1], NULL, counts[i], &texture));
    REFUSED(celspan_texture_create_radial(context, at, 1, &stop, counts[i], &texture));
    REFUSED(celspan_texture_create_focal(context, at, 1, at, NULL, counts[i], &texture));
  }
  REFUSED(celspan_texture_create_linear(context, at, points[1], NULL, 1, &texture));
  REFUSED(celspan_texture_create_linear(context, at, points[1], &stop, 0, &texture));
  REFUSED(celspan_texture_create_gradient(context, NULL, paints, &texture));
  REFUSED(celspan_texture_create_gradient(context, points, NULL, &texture));
  REFUSED(celspan_texture_create_paint(context, NULL, &texture));
  REFUSED(celspan_texture_create_picture(context, NULL, &texture));
}

static void check_outlines(void) {
  const celspan_point points[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const double number = 1;
  celspan_object *object;
  for (size_t i = 0; i < COUNTS; i++) {
    const celspan_polygon_desc polygon = {
        .struct_size = sizeof polygon, .points = points, .point_count = counts[i]};
    const celspan_polygon_desc nowhere = {.struct_size = sizeof nowhere, .point_count = counts[i]};
    const celspan_nurbs_desc nurbs = {
        .struct_size = sizeof nurbs, .degree = 3, .points = points, .point_count = counts[i]};
    const celspan_nurbs_desc knots = {.struct_size = sizeof knots,
                                      .degree = 3,
                                      .points = points,
                                      .point_count = 4,
                                      .knots = &number,
                                      .knot_count = counts[i]};
    celspan_stroke_desc stroke = CELSPAN_STROKE_DESC;
    stroke.points = points;
    stroke.point_count = counts[i];
    REFUSED(celspan_object_create_polygon(context, &polygon, &object));
    REFUSED(celspan_object_create_polygon(context, &nowhere, &object));
    REFUSED(celspan_object_create_nurbs(context, &nurbs, &object));
    REFUSED(celspan_object_create_nurbs(context, &knots, &object));
    REFUSED(celspan_object_create_stroke(context, &stroke, &object));
    stroke.point_count = 4;
    stroke.dash_count = counts[i];
    REFUSED(celspan_object_create_stroke(context, &stroke, &object));
    stroke.dashes = &number;
    REFUSED(celspan_object_create_stroke(context, &stroke, &object));
  }
  const celspan_path_desc path = {.struct_size = sizeof path};
  REFUSED(celspan_object_create_path(context, &path, &object));
  REFUSED(celspan_object_create_path(context, NULL, &object));
  REFUSED(celspan_object_create_polygon(context, NULL, &object));
  REFUSED(celspan_object_create_nurbs(context, NULL, &object));
  REFUSED(celspan_object_create_stroke(context, NULL, &object));
  REFUSED(celspan_object_create_image(context, NULL, &object));
  REFUSED(celspan_object_create_scanline(context, NULL, &object));
}

static celspan_object *make_square(void) {
  const celspan_rect_desc rect = {.struct_size = sizeof rect, .width = 1, .height = 1};
  celspan_object *object = NULL;
  CHECK(celspan_object_create_rect(context, &rect, &object) == CELSPAN_OK);
  return object;
}

static void check_trees(void) {
  celspan_object *square = make_square(), *both, *object, *missing = NULL;
  celspan_cel *cel, *no_cel = NULL;
  celspan_rostrum *rostrum;
  celspan_cel_desc cels = CELSPAN_CEL_DESC;
  celspan_rostrum_desc rostrums = CELSPAN_ROSTRUM_DESC;
  CHECK(celspan_object_create_boolean(context, CELSPAN_OPERATOR_UNION, &square, 1, &both) ==
        CELSPAN_OK);
  for (size_t i = 0; i < COUNTS; i++) {
    REFUSED(celspan_object_create_boolean(context, CELSPAN_OPERATOR_UNION, &square, counts[i],
                                          &object));
    REFUSED(
        celspan_object_create_boolean(context, CELSPAN_OPERATOR_CLIP, NULL, counts[i], &object));
    REFUSED(celspan_object_create_boolean(context, CELSPAN_OPERATOR_XOR, NULL, counts[i], &object));
    REFUSED(celspan_object_extend_boolean(context, both, &square, counts[i], &object));
    REFUSED(celspan_object_extend_boolean(context, both, NULL, counts[i], &object));
    cels.object_count = counts[i];
    cels.objects = NULL;
    REFUSED(celspan_cel_create(context, &cels, &cel));
    cels.objects = &square;
    REFUSED(celspan_cel_create(context, &cels, &cel));
    rostrums.cel_count = counts[i];
    rostrums.cels = NULL;
    REFUSED(celspan_rostrum_create(context, &rostrums, &rostrum));
    rostrums.cels = &no_cel;
    REFUSED(celspan_rostrum_create(context, &rostrums, &rostrum));
  }
  REFUSED(celspan_object_create_boolean(context, CELSPAN_OPERATOR_UNION, &missing, 1, &object));
  REFUSED(celspan_object_create_boolean(context, CELSPAN_OPERATOR_CLIP, NULL, 2, &object));
  REFUSED(celspan_cel_create(context, NULL, &cel));
  REFUSED(celspan_rostrum_create(context, NULL, &rostrum));
  celspan_object_unref(both);
  celspan_object_unref(square);
}

static celspan_rostrum *make_rostrum(void) {
  celspan_rostrum_desc desc = CELSPAN_ROSTRUM_DESC;
  celspan_rostrum *rostrum = NULL;
  CHECK(celspan_rostrum_create(context, &desc, &rostrum) == CELSPAN_OK);
  return rostrum;
}

/* Every function that renders a frame refuses the description. */
static void refuse_frame(const celspan_frame_desc *frame) {
  celspan_coding coding = {.struct_size = sizeof coding};
  celspan_sink sink = {.struct_size = sizeof sink};
  celspan_rows *rows;
  uint64_t digest[2];
  unsigned char pixels[64 * 4];
  REFUSED(celspan_frame_render(context, frame, &sink, NULL));
  REFUSED(celspan_rows_create(context, frame, &rows));
  REFUSED(celspan_frame_pixels(context, frame, &coding, pixels, sizeof pixels, NULL));
  REFUSED(celspan_frame_write(context, frame, "/nowhere/x.png", NULL, NULL));
  REFUSED(celspan_frame_digest(context, frame, &coding, digest));
}

static void check_lists_of_frames(celspan_frame_desc frame) {
  const celspan_exposure *exposures = frame.exposures;
  for (size_t i = 0; i < COUNTS; i++) {
    frame.exposure_count = counts[i];
    frame.exposures = exposures;
    refuse_frame(&frame);
    frame.exposures = NULL;
    refuse_frame(&frame);
    CHECK(!celspan_frame_is_opaque(&frame));
  }
  refuse_frame(NULL);
}

static void check_sizes_of_frames(celspan_frame_desc frame) {
  static const int32_t sides[] = {0, -1, INT32_MIN, INT32_MAX, 1048577};
  for (size_t i = 0; i < sizeof sides / sizeof *sides; i++) {
    celspan_frame_desc wrong = frame;
    wrong.width = sides[i];
    refuse_frame(&wrong);
    wrong = frame;
    wrong.height = sides[i];
    refuse_frame(&wrong);
    wrong = frame;
    wrong.crop_width = 1; /* without a height, or beyond the frame */
    wrong.crop_height = sides[i];
    refuse_frame(&wrong);
    wrong.crop_height = 1;
    wrong.crop_x = sides[i] ? sides[i] : 64;
    refuse_frame(&wrong);
  }
}

static void check_frames(void) {
  celspan_rostrum *rostrum = make_rostrum();
  celspan_exposure exposure = {rostrum, 1};
  celspan_frame_desc frame = CELSPAN_FRAME_DESC;
  const celspan_coding odd = {.struct_size = sizeof odd, .depth = (celspan_depth)99};
  const celspan_span *spans;
  celspan_rows *rows;
  uint64_t digest[2];
  double rgba[4];
  size_t count;
  unsigned char pixels[64];
  frame.exposures = &exposure;
  frame.exposure_count = 1;
  frame.width = frame.height = 8;
  check_lists_of_frames(frame);
  check_sizes_of_frames(frame);
  REFUSED(celspan_frame_render(context, &frame, NULL, NULL));
  REFUSED(celspan_frame_pixels(context, &frame, NULL, pixels, 31, NULL)); /* a row has 32 bytes */
  REFUSED(celspan_frame_pixels(context, &frame, &odd, pixels, 64, NULL));
  REFUSED(celspan_frame_digest(context, &frame, &odd, digest));
  REFUSED(celspan_frame_digest(context, &frame, NULL, NULL));
  REFUSED(celspan_frame_write(context, &frame, NULL, NULL, NULL));
  for (size_t i = 0; i < COUNTS; i++) {
    REFUSED(probe_film(context, &exposure, counts[i], 8, 8, (celspan_point){1, 1}, rgba));
    REFUSED(probe_film(context, NULL, counts[i], 8, 8, (celspan_point){1, 1}, rgba));
  }
  CHECK(celspan_rows_create(context, &frame, &rows) == CELSPAN_OK);
  REFUSED(celspan_rows_get(rows, -1, &spans, &count));
  REFUSED(celspan_rows_get(rows, 8, &spans, &count));
  REFUSED(celspan_rows_get(rows, INT32_MIN, &spans, &count));
  celspan_rows_destroy(rows);
  celspan_rostrum_unref(rostrum);
}

static void check_surfaces(void) {
  static const int32_t sides[] = {0, -1, INT32_MIN, INT32_MAX};
  static const size_t strides[] = {1, 3, SIZE_MAX, SIZE_MAX / 2, SIZE_MAX - 3};
  unsigned char pixels[16] = {0};
  celspan_surface *surface;
  celspan_surface_desc good = CELSPAN_SURFACE_DESC, desc;
  good.pixels = pixels;
  good.width = good.height = 2;
  for (size_t i = 0; i < sizeof sides / sizeof *sides; i++) {
    desc = good;
    desc.width = sides[i];
    REFUSED(celspan_surface_create(context, &desc, &surface));
    desc = good;
    desc.height = sides[i];
    REFUSED(celspan_surface_create(context, &desc, &surface));
  }
  for (size_t i = 0; i < sizeof strides / sizeof *strides; i++) {
    desc = good;
    desc.stride = strides[i];
    REFUSED(celspan_surface_create(context, &desc, &surface));
  }
  desc = good;
  desc.pixels = NULL;
  REFUSED(celspan_surface_create(context, &desc, &surface));
  desc = good;
  desc.format = (celspan_surface_format)9;
  REFUSED(celspan_surface_create(context, &desc, &surface));
  REFUSED(celspan_surface_create(context, NULL, &surface));
}

static void check_texts(void) {
  const char *const font = "/nowhere/font.ttf";
  const celspan_feature feature = {"liga", 1};
  const celspan_variation variation = {"wght", 1};
  celspan_object *object;
  for (size_t i = 0; i < COUNTS; i++) {
    celspan_text_desc good = CELSPAN_TEXT_DESC, desc;
    good.text = "a";
    good.text_size = 1;
    good.fonts = &font;
    good.font_count = 1;
    desc = good;
    desc.text_size = counts[i];
    CHECK(celspan_object_create_text(context, &desc, &object) != CELSPAN_OK); /* there is no font */
    desc.text = NULL;
    REFUSED(celspan_object_create_text(context, &desc, &object));
    desc = good;
    desc.font_count = counts[i];
    REFUSED(celspan_object_create_text(context, &desc, &object));
    desc = good;
    desc.features = &feature;
    desc.feature_count = counts[i];
    REFUSED(celspan_object_create_text(context, &desc, &object));
    desc = good;
    desc.variations = &variation;
    desc.variation_count = counts[i];
    REFUSED(celspan_object_create_text(context, &desc, &object));
  }
  celspan_text_desc desc = CELSPAN_TEXT_DESC;
  desc.text = "a";
  desc.text_size = desc.font_count = 1;
  REFUSED(celspan_object_create_text(context, &desc, &object)); /* fonts NULL */
  desc.fonts = &font;
  desc.feature_count = 1;
  REFUSED(celspan_object_create_text(context, &desc, &object));
  desc.feature_count = 0;
  desc.variation_count = 1;
  REFUSED(celspan_object_create_text(context, &desc, &object));
}

int main(void) {
  memory_watch watch = {0};
  celspan_context_desc desc = CELSPAN_CONTEXT_DESC;
  desc.resize = memory_watch_resize;
  desc.resize_user = &watch;
  if (celspan_context_create(&desc, &context) != CELSPAN_OK)
    return 1;
  check_textures();
  check_outlines();
  check_trees();
  check_frames();
  check_surfaces();
  check_texts();
  celspan_context_destroy(context);
  CHECK(watch.blocks == 0 && watch.size_errors == 0);
  return check_done();
}
