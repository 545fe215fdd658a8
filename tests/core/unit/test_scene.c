/* Scene values: which descriptions are refused with which sentence, bounds, hashes, limits, counts,
 * and that a failed allocation leaks nothing. One list of cases, as long as the list of fields.
 */
#include "model/scene/scene.h"

#include "base/context.h"
#include "tests/support/memory.h"
#include "tests/support/probe.h"
#include "tests/support/scene.h"

#define TINY 1e-9

#define REFUSED(s, call, message)                                                                  \
  do {                                                                                             \
    CHECK((call) == CELSPAN_BAD_ARGUMENT);                                                         \
    CHECK_TEXT(celspan_context_error((s)->context), message);                                      \
  } while (0)

static const celspan_paint red = {{1, 0, 0}, {1, 1, 1}, 1};

/* ---------------------------------------------------------------- doors: textures */

static void test_paint_door(studio *s) {
  celspan_texture *out = NULL;
  celspan_paint paint = {{0, 1.5f, 0}, {1, 1, 1}, 1};
  REFUSED(s, celspan_texture_create_paint(s->context, &paint, &out),
          "paint: pigment[2] is 1.5; it must be between 0 and 1");
  paint = (celspan_paint){{0, 1, 0}, {1, 1, -0.25f}, 1};
  REFUSED(s, celspan_texture_create_paint(s->context, &paint, &out),
          "paint: medium[3] is -0.25; it must be between 0 and 1");
  paint = (celspan_paint){{0, 1, 0}, {1, 1, 1}, NAN};
  REFUSED(s, celspan_texture_create_paint(s->context, &paint, &out),
          "paint: beta must be a finite number, got nan");
  CHECK(out == NULL);
}

static void test_gradient_doors(studio *s) {
  celspan_texture *out = NULL;
  celspan_point points[3] = {{0, 0}, {1, NAN}, {0, 1}};
  celspan_paint paints[3] = {red, red, {{0, 0, 0}, {1, 1, 1}, 2}};
  REFUSED(s, celspan_texture_create_gradient(s->context, points, paints, &out),
          "gradient: points[2].y must be a finite number, got nan");
  points[1].y = 0;
  REFUSED(s, celspan_texture_create_gradient(s->context, points, paints, &out),
          "gradient: paints[3].beta is 2; it must be between 0 and 1");
  celspan_stop stops[3] = {{0, red}, {0.5, red}, {0.25, red}};
  celspan_point from = {0, 0}, to = {1, 1};
  REFUSED(s, celspan_texture_create_linear(s->context, from, to, stops, 3, &out),
          "linear: stops[3].at is 0.25, less than 0.5 of the stop before; stops must ascend");
  stops[2].at = 1.25;
  REFUSED(s, celspan_texture_create_linear(s->context, from, to, stops, 3, &out),
          "linear: stops[3].at is 1.25; it must be between 0 and 1");
  REFUSED(s, celspan_texture_create_linear(s->context, from, to, stops, 0, &out),
          "linear: there is no stop; it needs one or more");
  REFUSED(s, celspan_texture_create_radial(s->context, from, -1, stops, 2, &out),
          "radial: radius is -1; it must be 0 or more");
  CHECK(out == NULL);
}

/* A rectangle with a gradient without points has the hash of one with points. */
static void check_fitted(studio *s, const celspan_fitted_desc *desc, celspan_point from,
                         celspan_point to) {
  celspan_texture *textures[2] = {NULL, NULL};
  celspan_object *rects[2] = {NULL, NULL};
  CHECK(celspan_texture_create_fitted(s->context, desc, &textures[0]) == CELSPAN_OK);
  CHECK(celspan_texture_create_linear(s->context, from, to, desc->stops, desc->stop_count,
                                      &textures[1]) == CELSPAN_OK);
  for (int i = 0; i < 2; i++) {
    const celspan_rect_desc rect = {sizeof rect, 10, 20, 30, 40, 0, textures[i]};
    CHECK(celspan_object_create_rect(s->context, &rect, &rects[i]) == CELSPAN_OK);
  }
  CHECK(memcmp(&rects[0]->hash, &rects[1]->hash, sizeof rects[0]->hash) == 0);
  for (int i = 0; i < 2; i++) {
    celspan_object_unref(rects[i]);
    celspan_texture_unref(textures[i]);
  }
}

static void test_fitted(studio *s) {
  celspan_texture *out = NULL;
  const celspan_stop stops[2] = {{0, red}, {1, {{0, 0, 1}, {1, 1, 1}, 1}}};
  celspan_fitted_desc desc = CELSPAN_FITTED_DESC;
  desc.stops = stops;
  desc.stop_count = 2;
  check_fitted(s, &desc, (celspan_point){25, 20}, (celspan_point){25, 60});
  desc.to_x = -1;
  desc.to_y = 0;
  check_fitted(s, &desc, (celspan_point){40, 40}, (celspan_point){10, 40});
  desc.fit = CELSPAN_GRADIENT_ANGLE;
  desc.degrees = 0;
  check_fitted(s, &desc, (celspan_point){25, 60}, (celspan_point){25, 20});
  desc.fit = CELSPAN_GRADIENT_SIDE;
  desc.to_x = 0;
  REFUSED(s, celspan_texture_create_fitted(s->context, &desc, &out),
          "linear: to_x and to_y are both 0, which is no side; one of them must be -1 or 1");
  desc.to_x = 2;
  REFUSED(s, celspan_texture_create_fitted(s->context, &desc, &out),
          "linear: to_x is 2; it must be between -1 and 1");
  desc.fit = CELSPAN_GRADIENT_ELLIPSE;
  desc.to_x = 0;
  desc.stop_count = 0;
  REFUSED(s, celspan_texture_create_fitted(s->context, &desc, &out),
          "radial: there is no stop; it needs one or more");
  CHECK(out == NULL);
}

static void test_picture_door(studio *s) {
  celspan_texture *out = NULL;
  celspan_picture_desc desc = {
      .struct_size = sizeof desc, .file = "a.png", .has_box = true, .box = {0, 0, -2, 1}};
  REFUSED(s, celspan_texture_create_picture(s->context, &desc, &out),
          "picture: box.width is -2; it must be 0 or more");
  desc = (celspan_picture_desc){
      .struct_size = sizeof(celspan_picture_desc), .file = "a.png", .wrap = (celspan_wrap)9};
  REFUSED(s, celspan_texture_create_picture(s->context, &desc, &out),
          "picture: wrap is 9; it must be between 0 and 2");
  CHECK(out == NULL);
}

/* ---------------------------------------------------------------- doors: objects */

static void test_rect_door(studio *s) {
  celspan_object *out = NULL;
  celspan_rect_desc desc = {sizeof desc, 1, 2, -3, 4, 0, NULL};
  REFUSED(s, celspan_object_create_rect(s->context, &desc, &out),
          "rect: w is -3; it must be 0 or more");
  desc = (celspan_rect_desc){sizeof(celspan_rect_desc), INFINITY, 2, 3, 4, 0, NULL};
  REFUSED(s, celspan_object_create_rect(s->context, &desc, &out),
          "rect: x must be a finite number, got inf");
  desc = (celspan_rect_desc){sizeof(celspan_rect_desc), 1, 2, 3, 1.5e12, 0, NULL};
  REFUSED(s, celspan_object_create_rect(s->context, &desc, &out),
          "rect: h is 1.5e12; it must be at most 1e12");
  desc = (celspan_rect_desc){sizeof(celspan_rect_desc), 1, 2, 3, 4, -1, NULL};
  REFUSED(s, celspan_object_create_rect(s->context, &desc, &out),
          "rect: radius is -1; it must be 0 or more");
  CHECK(out == NULL);
}

static void test_outline_doors(studio *s) {
  celspan_object *out = NULL;
  celspan_ellipse_desc ellipse = {sizeof ellipse, {0, 0}, 1, -3, NULL};
  REFUSED(s, celspan_object_create_ellipse(s->context, &ellipse, &out),
          "ellipse: radii[2] is -3; it must be 0 or more");
  ellipse = (celspan_ellipse_desc){sizeof(celspan_ellipse_desc), {0, NAN}, 1, 3, NULL};
  REFUSED(s, celspan_object_create_ellipse(s->context, &ellipse, &out),
          "ellipse: centre.y must be a finite number, got nan");
  celspan_point points[4] = {{0, 0}, {1, 0}, {1, 1}, {NAN, 1}};
  celspan_polygon_desc polygon = {sizeof polygon, points, 4, CELSPAN_RULE_NONZERO, NULL};
  REFUSED(s, celspan_object_create_polygon(s->context, &polygon, &out),
          "polygon: points[4].x must be a finite number, got nan");
  polygon = (celspan_polygon_desc){sizeof(celspan_polygon_desc), points, 3, (celspan_rule)2, NULL};
  REFUSED(s, celspan_object_create_polygon(s->context, &polygon, &out),
          "polygon: rule is 2; it must be between 0 and 1");
  polygon =
      (celspan_polygon_desc){sizeof(celspan_polygon_desc), NULL, 3, CELSPAN_RULE_NONZERO, NULL};
  REFUSED(s, celspan_object_create_polygon(s->context, &polygon, &out),
          "polygon: points is missing");
  celspan_triangle_desc triangle = {sizeof triangle, {{0, 0}, {0, -2e12}, {1, 1}}, NULL};
  REFUSED(s, celspan_object_create_triangle(s->context, &triangle, &out),
          "triangle: points[2].y is -2e12; it must be between -1e12 and 1e12");
  celspan_nurbs_desc nurbs = {
      .struct_size = sizeof nurbs, .degree = 3, .points = points, .point_count = 4};
  REFUSED(s, celspan_object_create_nurbs(s->context, &nurbs, &out),
          "nurbs: points[4].x must be a finite number, got nan");
  celspan_path_desc path = {.struct_size = sizeof path};
  REFUSED(s, celspan_object_create_path(s->context, &path, &out),
          "path: one of d and contours must be given");
  path.data = "M0 0 h1e12 h1e12 h1e12 v5";
  CHECK(celspan_object_create_path(s->context, &path, &out) == CELSPAN_BAD_ARGUMENT);
  celspan_scanline_desc scanline = {.struct_size = sizeof scanline, .bounds = {0, 0, 1, 1}};
  REFUSED(s, celspan_object_create_scanline(s->context, &scanline, &out),
          "scanline: spans is missing");
  scanline.bounds.height = -1;
  REFUSED(s, celspan_object_create_scanline(s->context, &scanline, &out),
          "scanline: bounds.height is -1; it must be 0 or more");
  const celspan_picture_desc picture = {.struct_size = sizeof picture, .file = "a.png"};
  celspan_image_desc image = {.struct_size = sizeof image, .picture = &picture, .width = -4};
  REFUSED(s, celspan_object_create_image(s->context, &image, &out),
          "image: w is -4; it must be 0 or more");
  CHECK(out == NULL);
}

static void test_object_doors(studio *s) {
  celspan_object *rect = studio_rect(s, 0, 0, 1, 1, NULL), *out = NULL;
  celspan_object *const operands[3] = {rect, NULL, rect};
  REFUSED(s, celspan_object_create_boolean(s->context, CELSPAN_OPERATOR_XOR, operands, 3, &out),
          "xor: operands[2] is missing");
  REFUSED(s, celspan_object_create_boolean(s->context, CELSPAN_OPERATOR_CLIP, operands, 1, &out),
          "clip: 1 operands were given; it takes two");
  REFUSED(s, celspan_object_create_boolean(s->context, (celspan_operator)7, operands, 1, &out),
          "boolean: op is 7; it must be between 0 and 4");
  REFUSED(s, celspan_object_fade(s->context, rect, NAN, &out),
          "fade: k must be a finite number, got nan");
  celspan_matrix matrix = celspan_matrix_identity();
  matrix.m[5] = NAN;
  REFUSED(s, celspan_object_transform(s->context, rect, &matrix, &out),
          "transform: matrix[6] must be a finite number, got nan");
  matrix = celspan_matrix_scaling(1e9, 1);
  celspan_object *large = studio_transform(s, rect, matrix);
  REFUSED(s, celspan_object_transform(s->context, large, &matrix, &out),
          "transform, after those that are there: matrix[1] is 1e18; it must be between -1e12 and "
          "1e12");
  CHECK(out == NULL);
}

/* ---------------------------------------------------------------- doors: cels and rostrums */

static void refuse_cel(studio *s, celspan_cel_desc desc, const char *message) {
  celspan_cel *out = NULL;
  REFUSED(s, celspan_cel_create(s->context, &desc, &out), message);
  CHECK(out == NULL);
}

static void test_cel_door(studio *s) {
  celspan_cel_desc desc = CELSPAN_CEL_DESC;
  desc.opacity = INFINITY;
  refuse_cel(s, desc, "cel: opacity must be a finite number, got inf");
  desc = CELSPAN_CEL_DESC;
  desc.has_front = true;
  desc.front.g = -1;
  refuse_cel(s, desc, "cel: front.g is -1; it must be 0 or more");
  desc = CELSPAN_CEL_DESC;
  desc.back.a = 2;
  refuse_cel(s, desc, "cel: back.a is 2; it must be between 0 and 1");
  desc = CELSPAN_CEL_DESC;
  desc.has_viewport = true;
  desc.viewport = (celspan_box){0, 0, 0, 5};
  refuse_cel(s, desc, "cel: viewport.width is 0; it must be more than 0");
  desc = CELSPAN_CEL_DESC;
  desc.defocus_radius = -2;
  refuse_cel(s, desc, "cel: defocus.radius is -2; it must be 0 or more");
  desc = CELSPAN_CEL_DESC;
  celspan_object *nothing = NULL;
  desc.objects = &nothing;
  desc.object_count = 1;
  refuse_cel(s, desc, "cel: objects[1] is missing");
  desc = (celspan_cel_desc){.opacity = 1};
  CHECK(celspan_cel_create(s->context, &desc, &(celspan_cel *){NULL}) == CELSPAN_BAD_ARGUMENT);
}

static void refuse_rostrum(studio *s, celspan_rostrum_desc desc, const char *message) {
  celspan_rostrum *out = NULL;
  REFUSED(s, celspan_rostrum_create(s->context, &desc, &out), message);
  CHECK(out == NULL);
}

static void test_rostrum_door(studio *s) {
  celspan_rostrum_desc desc = CELSPAN_ROSTRUM_DESC;
  desc.brightness = -1;
  refuse_rostrum(s, desc, "rostrum: brightness is -1; it must be 0 or more");
  desc = CELSPAN_ROSTRUM_DESC;
  desc.has_camera_width = true;
  refuse_rostrum(s, desc, "rostrum: camera.width is 0; it must be more than 0");
  desc = CELSPAN_ROSTRUM_DESC;
  desc.has_camera_centre = true;
  desc.camera_centre.x = NAN;
  refuse_rostrum(s, desc, "rostrum: camera.centre.x must be a finite number, got nan");
  desc = CELSPAN_ROSTRUM_DESC;
  celspan_cel *nothing[2] = {NULL, NULL};
  desc.cels = nothing;
  desc.cel_count = 2;
  refuse_rostrum(s, desc, "rostrum: cels[1] is missing");
}

static void test_probe_door(studio *s) {
  celspan_exposure exposure = {studio_show(s, studio_rect(s, 0, 0, 1, 1, NULL)), -1};
  const celspan_point origin = {0, 0};
  double rgba[4];
  REFUSED(s, probe_film(s->context, &exposure, 1, 9, 9, origin, rgba),
          "probe: exposures[1].weight is -1; it must be 0 or more");
  exposure.weight = 1;
  REFUSED(s, probe_film(s->context, &exposure, 1, 9, 0, origin, rgba),
          "probe: film height is 0; it must be more than 0");
}

/* ---------------------------------------------------------------- matrices of cels */

static void test_cel_matrix(studio *s) {
  celspan_cel_desc desc = CELSPAN_CEL_DESC;
  desc.has_viewport = true;
  desc.viewport = (celspan_box){10, 20, 50, 100};
  celspan_cel *cel = studio_cel(s, desc, NULL, 0);
  celspan_matrix matrix;
  celspan_rostrum *rostrum = studio_rostrum(s, CELSPAN_ROSTRUM_DESC, &cel, 1);
  studio_check(s, cs_scene_cel_matrix(s->context, rostrum, 0, 100, 50, &matrix));
  const double expected[9] = {2, 0, -20, 0, 0.5, -10, 0, 0, 1};
  for (int i = 0; i < 9; i++)
    CHECK_NEAR(matrix.m[i], expected[i], TINY);
}

static void test_singular_view(studio *s) {
  celspan_cel_desc desc = CELSPAN_CEL_DESC;
  desc.has_viewport = true;
  desc.viewport = (celspan_box){0, 0, 1e-300, 1};
  celspan_cel *const cels[] = {studio_cel(s, CELSPAN_CEL_DESC, NULL, 0),
                               studio_cel(s, desc, NULL, 0)};
  celspan_rostrum *rostrum = studio_rostrum(s, CELSPAN_ROSTRUM_DESC, cels, 2);
  celspan_matrix matrix;
  REFUSED(s, cs_scene_cel_matrix(s->context, rostrum, 1, 100, 50, &matrix),
          "cel 2: its viewport and the camera together enlarge or reduce too far: all places on "
          "the frame must be within 1e+12 units; give widths of a usual size");
  CHECK(cs_scene_cel_matrix(s->context, rostrum, 0, 100, 50, &matrix) == CELSPAN_OK);
}

/* ---------------------------------------------------------------- bounds */

static void check_bounds(const celspan_object *object, double x, double y, double width,
                         double height) {
  celspan_box box = {0, 0, 0, 0};
  CHECK(celspan_object_bounds(object, &box));
  CHECK_NEAR(box.x, x, TINY);
  CHECK_NEAR(box.y, y, TINY);
  CHECK_NEAR(box.width, width, TINY);
  CHECK_NEAR(box.height, height, TINY);
}

static void test_bounds(studio *s) {
  celspan_object *circle = studio_circle(s, 10, 10, 5, NULL);
  celspan_object *rect = studio_rect(s, 12, 0, 20, 11, NULL);
  celspan_object *far = studio_rect(s, 90, 90, 1, 1, NULL);
  check_bounds(circle, 5, 5, 10, 10);
  check_bounds(studio_transform(s, circle, celspan_matrix_rotation(0.7, (celspan_point){10, 10})),
               5, 5, 10, 10);
  check_bounds(studio_pair(s, CELSPAN_OPERATOR_UNION, circle, rect), 5, 0, 27, 15);
  check_bounds(studio_pair(s, CELSPAN_OPERATOR_XOR, circle, rect), 5, 0, 27, 15);
  check_bounds(studio_pair(s, CELSPAN_OPERATOR_INTERSECTION, circle, rect), 12, 5, 3, 6);
  check_bounds(studio_pair(s, CELSPAN_OPERATOR_CLIP, circle, rect), 12, 5, 3, 6);
  check_bounds(studio_pair(s, CELSPAN_OPERATOR_DIFFERENCE, circle, rect), 5, 5, 10, 10);
  celspan_box box;
  CHECK(!celspan_object_bounds(studio_pair(s, CELSPAN_OPERATOR_INTERSECTION, circle, far), &box));
  celspan_object *empty = studio_boolean(s, CELSPAN_OPERATOR_UNION, NULL, 0);
  CHECK(!celspan_object_bounds(studio_pair(s, CELSPAN_OPERATOR_INTERSECTION, circle, empty), &box));
  CHECK(!celspan_cel_bounds(studio_cel(s, CELSPAN_CEL_DESC, &empty, 1), &box));
  celspan_object *both = studio_pair(s, CELSPAN_OPERATOR_UNION, circle, rect);
  check_bounds(studio_transform(s, both, celspan_matrix_scaling(2, -1)), 10, -15, 54, 15);
  celspan_cel *cel = studio_cel(s, CELSPAN_CEL_DESC, (celspan_object *const[]){circle, far}, 2);
  CHECK(celspan_cel_bounds(cel, &box) && box.x == 5 && box.width == 86);
  CHECK(celspan_cel_contains(cel, (celspan_point){90.5, 90.5}));
  CHECK(!celspan_cel_contains(cel, (celspan_point){50, 50}));
}

static void test_cel_values(studio *s) {
  celspan_object *rect = studio_rect(s, 0, 0, 10, 10, NULL);
  celspan_cel *cel = studio_cel(s, CELSPAN_CEL_DESC, &rect, 1), *moved = NULL, *faded = NULL;
  celspan_matrix matrix = celspan_matrix_translation(5, 0);
  studio_check(s, celspan_cel_transform(s->context, cel, &matrix, &moved));
  studio_check(s, celspan_cel_fade(s->context, moved, 0.5, &faded));
  CHECK(celspan_cel_contains(faded, (celspan_point){14, 5}));
  CHECK(!celspan_cel_contains(faded, (celspan_point){4, 5}));
  CHECK(faded->opacity == 0.5 && cel->opacity == 1);
  celspan_cel_unref(faded);
  celspan_cel_unref(moved);
}

/* A corner's radius is limited to half the shorter side. */
static void test_rounded_rect(studio *s) {
  celspan_rect_desc desc = {sizeof desc, 0, 0, 20, 10, 100, NULL};
  celspan_object *pill = NULL;
  studio_check(s, celspan_object_create_rect(s->context, &desc, &pill));
  check_bounds(pill, 0, 0, 20, 10);
  CHECK(!celspan_object_contains(pill, (celspan_point){1, 1}));
  CHECK(celspan_object_contains(pill, (celspan_point){0.1, 5}));
  CHECK(celspan_object_contains(pill, (celspan_point){1.5, 1.5}));
  celspan_object_unref(pill);
}

/* ---------------------------------------------------------------- images */

static void test_image_without_reading(studio *s) {
  const celspan_picture_desc picture = {.struct_size = sizeof picture,
                                        .file = "there/is/no/such.png"};
  celspan_image_desc desc = {
      .struct_size = sizeof desc, .picture = &picture, .x = 1, .y = 2, .width = 30, .height = 40};
  celspan_object *image = NULL;
  studio_check(s, celspan_object_create_image(s->context, &desc, &image));
  check_bounds(image, 1, 2, 30, 40);
  CHECK(image->data->texture->variation->wrap ==
        CELSPAN_WRAP_CLAMP); /* its rectangle determines where it ends */
  celspan_object_unref(image);
  image = NULL;
  desc.width = 0;
  CHECK(celspan_object_create_image(s->context, &desc, &image) == CELSPAN_INPUT);
  CHECK(image == NULL);
}

/* An uncompressed Targa of 4 x 2 black pixels. */
static bool write_picture(const char *path) {
  unsigned char bytes[18 + 24] = {[2] = 2, [12] = 4, [14] = 2, [16] = 24};
  FILE *file = fopen(path, "wb");
  return file && fwrite(bytes, sizeof bytes, 1, file) == 1 && fclose(file) == 0;
}

static void check_image(studio *s, celspan_image_desc desc, celspan_box frame, celspan_box box) {
  celspan_object *image = NULL;
  studio_check(s, celspan_object_create_image(s->context, &desc, &image));
  if (!image)
    return;
  check_bounds(image, frame.x, frame.y, frame.width, frame.height);
  const celspan_box *own = &image->data->texture->variation->box;
  CHECK_NEAR(own->x, box.x, TINY);
  CHECK_NEAR(own->y, box.y, TINY);
  CHECK_NEAR(own->width, box.width, TINY);
  CHECK_NEAR(own->height, box.height, TINY);
  celspan_object_unref(image);
}

static void test_image_sizes(studio *s) {
  const char *path = "4x2.scene.tga";
  celspan_picture_desc picture = {.struct_size = sizeof picture, .file = path};
  celspan_picture_info info = CELSPAN_PICTURE_INFO;
  CHECK(write_picture(path));
  if (celspan_picture_inspect(s->context, &picture, &info) == CELSPAN_OK) {
    celspan_box box = {10, 20, 4, 2};
    check_image(
        s,
        (celspan_image_desc){
            .struct_size = sizeof(celspan_image_desc), .picture = &picture, .x = 10, .y = 20},
        box, box);
    box = (celspan_box){10, 20, 100, 50};
    check_image(s,
                (celspan_image_desc){.struct_size = sizeof(celspan_image_desc),
                                     .picture = &picture,
                                     .x = 10,
                                     .y = 20,
                                     .width = 100},
                box, box);
    check_image(s,
                (celspan_image_desc){.struct_size = sizeof(celspan_image_desc),
                                     .picture = &picture,
                                     .x = 10,
                                     .y = 20,
                                     .height = 50},
                box, box);
    celspan_image_desc fitted = {.struct_size = sizeof fitted,
                                 .picture = &picture,
                                 .width = 40,
                                 .height = 40,
                                 .fit = CELSPAN_FIT_CONTAIN};
    box = (celspan_box){0, 10, 40, 20};
    check_image(s, fitted, box, box);
    picture.wrap = CELSPAN_WRAP_REPEAT;
    check_image(s, fitted, (celspan_box){0, 0, 40, 40}, box);
    fitted.fit = CELSPAN_FIT_COVER;
    check_image(s, fitted, (celspan_box){0, 0, 40, 40}, (celspan_box){-20, 0, 80, 40});
  } else {
    check_skip("the picture module");
  }
  remove(path);
}

/* ---------------------------------------------------------------- hashes */

static bool same_hash(const celspan_rostrum *a, const celspan_rostrum *b) {
  uint64_t one[2], other[2];
  celspan_rostrum_hash(a, one);
  celspan_rostrum_hash(b, other);
  return one[0] == other[0] && one[1] == other[1];
}

/* A scene in which `change` 0 is the scene itself and every other number changes one property. */
#define CHANGES 27
static celspan_rostrum *scene(studio *s, int change) {
  celspan_paint paint = celspan_paint_rgb(change == 1 ? 0.5f : 0.25f, 0, 0, 1);
  celspan_stop stops[2] = {{0, red}, {change == 2 ? 0.75 : 1, celspan_paint_clear()}};
  celspan_texture *flat = studio_paint(s, paint);
  celspan_texture *linear =
      studio_linear(s, (celspan_point){0, 0}, (celspan_point){change == 3 ? 2 : 1, 1}, stops, 2);
  const celspan_point points[] = {{0, 0}, {8, 1}, {3, change == 4 ? 9 : 7}};
  celspan_object *const operands[] = {
      studio_rect(s, 0, 0, change == 5 ? 11 : 10, 10, flat),
      studio_polygon(s, points, 3, change == 6 ? CELSPAN_RULE_EVENODD : CELSPAN_RULE_NONZERO,
                     change == 7 ? flat : linear)};
  celspan_object *both =
      studio_boolean(s, change == 8 ? CELSPAN_OPERATOR_XOR : CELSPAN_OPERATOR_UNION, operands,
                     change == 9 ? 1 : 2);
  if (change == 10)
    both = studio_fade(s, both, 0.5);
  if (change == 11)
    both = studio_transform(s, both, celspan_matrix_translation(1e-9, 0));
  celspan_cel_desc cel = CELSPAN_CEL_DESC;
  cel.has_front = change == 12;
  cel.back.r = change == 13;
  cel.back.a = change == 14;
  cel.has_viewport = change == 15;
  cel.viewport = (celspan_box){0, 0, 3, 3};
  cel.defocus_radius = change == 16 ? 2 : 1;
  cel.defocus_kernel = change == 17 ? CELSPAN_DEFOCUS_DISC : CELSPAN_DEFOCUS_GAUSSIAN;
  cel.opacity = change == 18 ? 0.5 : 1;
  cel.front_texture.texture = change == 25 || change == 26 ? linear : NULL;
  cel.front_texture.matte = change == 26 ? 0.5 : 1;
  celspan_cel *cels[] = {studio_cel(s, cel, &both, 1), studio_cel(s, CELSPAN_CEL_DESC, NULL, 0)};
  celspan_rostrum_desc desc = CELSPAN_ROSTRUM_DESC;
  desc.brightness = change == 19 ? 2 : 1;
  desc.has_camera_centre = change == 20;
  desc.has_camera_width = change == 21;
  desc.camera_width = 7;
  desc.camera_radians = change == 22 ? 1 : 0;
  desc.antialias = change == 23 ? CELSPAN_ANTIALIAS_NONE : CELSPAN_ANTIALIAS_AREA;
  desc.grain = change == 27 ? linear : NULL;
  return studio_rostrum(s, desc, cels, change == 24 ? 1 : 2);
}

static void test_hashes(studio *s) {
  celspan_rostrum *made[CHANGES + 1];
  CHECK(same_hash(scene(s, 0), scene(s, 0)));
  for (int i = 0; i <= CHANGES; i++)
    made[i] = scene(s, i);
  for (int i = 0; i <= CHANGES; i++)
    for (int j = 0; j < i; j++)
      CHECK(!same_hash(made[i], made[j]));
}

/* The same points in the same order, once as a curve and a line, once as a line and a curve. */
static void test_hash_of_degrees(studio *s) {
  celspan_rostrum *one = studio_show(s, studio_path(s, "M0 0C1 2 3 4 5 0L0 0", NULL));
  celspan_rostrum *other = studio_show(s, studio_path(s, "M0 0L1 2C3 4 5 0 0 0", NULL));
  CHECK(!same_hash(one, other));
}

/* Fields that have no effect are not part of a scene's hash. */
static void test_hash_of_unused_fields(studio *s) {
  celspan_cel_desc a = CELSPAN_CEL_DESC, b = CELSPAN_CEL_DESC;
  b.front = (celspan_light){1, 2, 3, 1};
  b.viewport = (celspan_box){1, 2, 3, 4};
  b.defocus_kernel = CELSPAN_DEFOCUS_DISC;
  celspan_cel *const cels[] = {studio_cel(s, a, NULL, 0), studio_cel(s, b, NULL, 0)};
  CHECK(same_hash(studio_rostrum(s, CELSPAN_ROSTRUM_DESC, &cels[0], 1),
                  studio_rostrum(s, CELSPAN_ROSTRUM_DESC, &cels[1], 1)));
}

/* ---------------------------------------------------------------- limits and counts */

/* ---------------------------------------------------------------- names */

static bool is_at(celspan_origin origin, const char *source, int32_t line) {
  return strcmp(origin.source, source) == 0 && origin.line == line;
}

static void test_names(studio *s) {
  celspan_context_set_origin(s->context, "shot.lua", 12);
  celspan_object *plain = studio_rect(s, 0, 0, 9, 9, studio_paint(s, red));
  celspan_context_set_origin(s->context, "other.lua", 7);
  celspan_object *named = NULL, *moved = NULL;
  celspan_matrix twice = celspan_matrix_scaling(2, 2);
  studio_check(s, celspan_object_named(s->context, plain, "hand", &named));
  studio_check(s, celspan_object_transform(s->context, named, &twice, &moved));
  CHECK_TEXT(celspan_object_name(plain), "");
  CHECK_TEXT(celspan_object_name(moved), "hand");
  CHECK(is_at(celspan_object_origin(moved), "shot.lua", 12));
  CHECK(named->hash.a == plain->hash.a && named->hash.b == plain->hash.b);
  CHECK(is_at(celspan_texture_origin(studio_paint(s, red)), "other.lua", 7));
  celspan_context_set_origin(s->context, NULL, 0);
  CHECK(is_at(celspan_texture_origin(studio_paint(s, red)), "", 0));
  REFUSED(s, celspan_object_named(s->context, plain, NULL, &moved), "named: the name is missing");
  celspan_object_unref(named);
  celspan_object_unref(moved);
}

static void test_names_of_others(studio *s) {
  celspan_stop stops[2] = {{0, red}, {1, red}};
  celspan_texture *texture = NULL;
  studio_check(s, celspan_texture_named(
                      s->context,
                      studio_linear(s, (celspan_point){0, 0}, (celspan_point){1, 0}, stops, 2),
                      "dusk", &texture));
  CHECK_TEXT(celspan_texture_name(texture), "dusk");
  CHECK(texture->variation->stop_count == 2 && texture->variation->stops[1].at == 1);
  celspan_texture_unref(texture);
  celspan_cel_desc desc = CELSPAN_CEL_DESC;
  celspan_cel *cel = NULL, *cel_named = NULL, *faded = NULL;
  studio_check(s, celspan_cel_create(s->context, &desc, &cel));
  studio_check(s, celspan_cel_named(s->context, cel, "back", &cel_named));
  studio_check(s, celspan_cel_fade(s->context, cel_named, 0.5, &faded));
  CHECK_TEXT(celspan_cel_name(faded), "back");
  CHECK(cel->hash.a == cel_named->hash.a);
  celspan_rostrum_desc stand = CELSPAN_ROSTRUM_DESC;
  stand.cels = &faded;
  stand.cel_count = 1;
  stand.antialias = CELSPAN_ANTIALIAS_FILTER;
  celspan_rostrum *rostrum = NULL, *named = NULL;
  studio_check(s, celspan_rostrum_create(s->context, &stand, &rostrum));
  studio_check(s, celspan_rostrum_named(s->context, rostrum, "stand", &named));
  CHECK_TEXT(celspan_rostrum_name(named), "stand");
  CHECK(rostrum->hash.a == named->hash.a && rostrum->hash.b == named->hash.b);
  celspan_rostrum_unref(rostrum);
  celspan_rostrum_unref(named);
  celspan_cel_unref(cel);
  celspan_cel_unref(cel_named);
  celspan_cel_unref(faded);
}

/* Sources live as long as the values that were made there; beyond the number that a context keeps
 * they are unknown, and long ones are cut. */
static void test_origins(studio *s) {
  char source[300];
  memset(source, 'x', sizeof source - 1);
  source[sizeof source - 1] = 0;
  celspan_context_set_origin(s->context, source, 1);
  CHECK(strlen(celspan_texture_origin(studio_paint(s, red)).source) == 255);
  for (int i = 0; i < 5000; i++) {
    snprintf(source, sizeof source, "file%d.lua", i);
    celspan_context_set_origin(s->context, source, 1);
  }
  CHECK(is_at(celspan_texture_origin(studio_paint(s, red)), "", 0));
  celspan_context_set_origin(s->context, "file9.lua", 3);
  CHECK(is_at(celspan_texture_origin(studio_paint(s, red)), "file9.lua", 3));
}

static void test_nesting_limit(studio *s) {
  celspan_object *rect = studio_rect(s, 0, 0, 1, 1, NULL), *object = rect, *deeper = NULL;
  for (int i = 0; i < CS_SCENE_DEPTH; i++)
    object = studio_pair(s, CELSPAN_OPERATOR_UNION, object, rect);
  CHECK(celspan_object_contains(object, (celspan_point){0.5, 0.5}));
  CHECK(celspan_object_create_boolean(s->context, CELSPAN_OPERATOR_UNION, &object, 1, &deeper) ==
        CELSPAN_LIMIT);
  CHECK_TEXT(celspan_context_error(s->context), "union: nested 129 levels deep; the limit is 128");
  CHECK(deeper == NULL);
}

/* Twenty-four doublings of one rectangle are allowed, twenty-five are not. */
static void test_primitive_limit(studio *s) {
  celspan_object *object = studio_rect(s, 0, 0, 1, 1, NULL), *more = NULL;
  for (int i = 0; i < 24; i++)
    object = studio_pair(s, CELSPAN_OPERATOR_UNION, object, object);
  celspan_object *const twice[] = {object, object};
  CHECK(celspan_object_create_boolean(s->context, CELSPAN_OPERATOR_UNION, twice, 2, &more) ==
        CELSPAN_LIMIT);
  CHECK_TEXT(celspan_context_error(s->context), "union: it holds more than 16777216 primitives");
}

static void test_count(studio *s) {
  celspan_picture_desc desc = {.struct_size = sizeof desc, .file = "there/is/no/such.png"};
  celspan_texture *picture = NULL;
  studio_check(s, celspan_texture_create_picture(s->context, &desc, &picture));
  celspan_object *a = studio_rect(s, 0, 0, 1, 1, NULL), *b = studio_rect(s, 0, 0, 1, 1, picture);
  celspan_texture_unref(picture);
  celspan_object *pair = studio_pair(s, CELSPAN_OPERATOR_XOR, a, b);
  celspan_object *const objects[] = {studio_pair(s, CELSPAN_OPERATOR_UNION, pair, b), a};
  celspan_cel *const cels[] = {studio_cel(s, CELSPAN_CEL_DESC, objects, 2),
                               studio_cel(s, CELSPAN_CEL_DESC, objects, 1)};
  celspan_rostrum_counts counts;
  celspan_rostrum_count(studio_rostrum(s, CELSPAN_ROSTRUM_DESC, cels, 2), &counts);
  CHECK(counts.cels == 2 && counts.primitives == 7 && counts.pictures == 4);
}

/* ---------------------------------------------------------------- lifetime */

static celspan_status no_spans(void *user, celspan_context *context, double y,
                               const celspan_scanline_row *row, celspan_scanline_output *output) {
  (void)user, (void)context, (void)y, (void)row, (void)output;
  return CELSPAN_OK;
}

static void count_release(void *user) { ++*(int *)user; }

static void test_procedure_is_released_once(studio *s) {
  int released = 0;
  celspan_scanline_desc desc = {sizeof desc, {0, 0, 1, 1},  no_spans,
                                &released,   count_release, false};
  celspan_object *object = NULL, *faded = NULL;
  studio_check(s, celspan_object_create_scanline(s->context, &desc, &object));
  studio_check(s, celspan_object_fade(s->context, object, 0.5, &faded));
  celspan_object_unref(object);
  CHECK(released == 0);
  celspan_object_unref(faded);
  CHECK(released == 1);
}

static void test_values_outlive_their_context(void) {
  memory_watch watch = {0};
  studio s = {.context = memory_watch_context(&watch)};
  celspan_rostrum *rostrum = celspan_rostrum_ref(scene(&s, 0));
  celspan_context_destroy(s.context);
  studio_finish(&s);
  CHECK(watch.blocks > 0);
  CHECK(rostrum->cels[0]->objects[0]->data->boolean->operand_count == 2);
  celspan_rostrum_unref(rostrum);
  CHECK(watch.blocks == 0 && watch.bytes == 0 && watch.size_errors == 0);
}

/* ---------------------------------------------------------------- the n-th allocation fails */

/* One value of every kind. */
typedef struct everything {
  celspan_texture *textures[4];
  celspan_object *objects[9], *operands[2];
  celspan_cel *cel, *cels[2];
  celspan_rostrum *rostrum, *inner;
  celspan_object *nested;
  celspan_cel *lit;
} everything;

static const celspan_point square[] = {{0, 0}, {9, 0}, {9, 9}, {0, 9}};

static celspan_status build_textures(celspan_context *context, everything *all) {
  const celspan_paint paints[3] = {red, red, celspan_paint_clear()};
  const celspan_stop stops[2] = {{0, red}, {1, celspan_paint_clear()}};
  CS_TRY(celspan_texture_create_gradient(context, square, paints, &all->textures[0]));
  CS_TRY(celspan_texture_create_linear(context, square[0], square[2], stops, 2, &all->textures[1]));
  CS_TRY(celspan_texture_create_radial(context, square[0], 5, stops, 2, &all->textures[2]));
  CS_TRY(celspan_texture_create_picture(
      context,
      &(celspan_picture_desc){.struct_size = sizeof(celspan_picture_desc), .file = "a.png"},
      &all->textures[3]));
  return CELSPAN_OK;
}

static celspan_status build_primitives(celspan_context *context, everything *all) {
  CS_TRY(celspan_object_create_rect(
      context, &(celspan_rect_desc){sizeof(celspan_rect_desc), 0, 0, 9, 9, 2, all->textures[0]},
      &all->objects[0]));
  CS_TRY(celspan_object_create_triangle(context,
                                        &(celspan_triangle_desc){sizeof(celspan_triangle_desc),
                                                                 {{0, 0}, {9, 0}, {0, 9}},
                                                                 all->textures[1]},
                                        &all->objects[1]));
  CS_TRY(celspan_object_create_ellipse(
      context,
      &(celspan_ellipse_desc){sizeof(celspan_ellipse_desc), {9, 9}, 4, 5, all->textures[2]},
      &all->objects[2]));
  CS_TRY(celspan_object_create_polygon(
      context,
      &(celspan_polygon_desc){sizeof(celspan_polygon_desc), square, 4, CELSPAN_RULE_EVENODD, NULL},
      &all->objects[3]));
  CS_TRY(
      celspan_object_create_nurbs(context,
                                  &(celspan_nurbs_desc){.struct_size = sizeof(celspan_nurbs_desc),
                                                        .degree = 3,
                                                        .points = square,
                                                        .point_count = 4},
                                  &all->objects[4]));
  CS_TRY(celspan_object_create_path(
      context,
      &(celspan_path_desc){.struct_size = sizeof(celspan_path_desc),
                           .data = "M0 0 C 1 2 3 4 5 6 A 3 3 0 1 1 2 2Z"},
      &all->objects[5]));
  CS_TRY(celspan_object_create_scanline(
      context,
      &(celspan_scanline_desc){
          sizeof(celspan_scanline_desc), {0, 0, 9, 9}, no_spans, NULL, NULL, false},
      &all->objects[6]));
  CS_TRY(celspan_object_create_image(
      context,
      &(celspan_image_desc){.struct_size = sizeof(celspan_image_desc),
                            .picture = &CELSPAN_DESC(celspan_picture_desc, .file = "b.png"),
                            .width = 3,
                            .height = 3},
      &all->objects[7]));
  return CELSPAN_OK;
}

static celspan_status name_everything(celspan_context *context, const everything *all) {
  celspan_object *object;
  celspan_cel *cel;
  celspan_rostrum *rostrum;
  celspan_texture *texture;
  CS_TRY(celspan_object_named(context, all->objects[0], "o", &object));
  celspan_object_unref(object);
  CS_TRY(celspan_cel_named(context, all->cel, "c", &cel));
  celspan_cel_unref(cel);
  CS_TRY(celspan_rostrum_named(context, all->rostrum, "r", &rostrum));
  celspan_rostrum_unref(rostrum);
  CS_TRY(celspan_texture_named(context, all->textures[2], "t", &texture));
  celspan_texture_unref(texture);
  return CELSPAN_OK;
}

/* Outlines of a vector shape, in an xor, and of an object with an alpha of its own. */
static celspan_status try_outlines(celspan_context *context, celspan_object *shape,
                                   celspan_object *soft) {
  celspan_outline_desc desc = CELSPAN_OUTLINE_DESC;
  celspan_object *both[] = {shape, shape}, *mixed, *made;
  desc.width = desc.blur = 2;
  CS_TRY(celspan_object_create_boolean(context, CELSPAN_OPERATOR_XOR, both, 2, &mixed));
  celspan_status status = celspan_object_outline(context, mixed, &desc, &made);
  celspan_object_unref(mixed);
  CS_TRY(status);
  celspan_object_unref(made);
  CS_TRY(celspan_object_outline(context, soft, &desc, &made));
  celspan_object_unref(made);
  return CELSPAN_OK;
}

/* Every effect of an object with a mode. */
static celspan_status try_effects(celspan_context *context, celspan_object *object) {
  celspan_object *source, *blurred = NULL, *shadow = NULL, *glow = NULL, *sharp = NULL;
  celspan_sharpen_desc finer = CELSPAN_SHARPEN_DESC;
  celspan_blur_desc blur = CELSPAN_BLUR_DESC;
  celspan_shadow_desc inside = CELSPAN_SHADOW_DESC;
  celspan_glow_desc light = CELSPAN_GLOW_DESC;
  blur.radius = inside.blur = light.radius = 2;
  inside.is_inside = true;
  CS_TRY(celspan_object_blend(context, object, CELSPAN_BLEND_SCREEN, &source));
  celspan_status status = celspan_object_blur(context, source, &blur, &blurred);
  if (status == CELSPAN_OK)
    status = celspan_object_sharpen(context, source, &finer, &sharp);
  CHECK(status != CELSPAN_OK || celspan_object_mode(sharp) == CELSPAN_BLEND_SCREEN);
  celspan_object_unref(sharp);
  if (status == CELSPAN_OK)
    status = celspan_object_shadow(context, source, &inside, &shadow);
  if (status == CELSPAN_OK)
    status = celspan_object_glow(context, source, &light, &glow);
  if (status == CELSPAN_OK)
    status = try_outlines(context, source, glow);
  CHECK(status != CELSPAN_OK || celspan_object_mode(glow) == CELSPAN_BLEND_SCREEN);
  celspan_object_unref(source);
  celspan_object_unref(blurred);
  celspan_object_unref(shadow);
  celspan_object_unref(glow);
  return status;
}

static celspan_status build_film(celspan_context *context, everything *all) {
  const celspan_matrix half = celspan_matrix_scaling(0.5, 0.5);
  CS_TRY(celspan_object_create_boolean(context, CELSPAN_OPERATOR_XOR, all->objects, 7,
                                       &all->operands[0]));
  CS_TRY(celspan_object_transform(context, all->operands[0], &half, &all->operands[1]));
  CS_TRY(celspan_object_fade(context, all->operands[1], 0.5, &all->objects[8]));
  celspan_cel_desc cel_desc = CELSPAN_CEL_DESC;
  cel_desc.objects = all->objects;
  cel_desc.object_count = 7;
  CS_TRY(celspan_cel_create(context, &cel_desc, &all->cel));
  CS_TRY(celspan_cel_transform(context, all->cel, &half, &all->cels[0]));
  CS_TRY(celspan_cel_fade(context, all->cel, 0.5, &all->cels[1]));
  celspan_rostrum_desc desc = CELSPAN_ROSTRUM_DESC;
  desc.cels = all->cels;
  desc.cel_count = 2;
  desc.front_texture.texture = all->textures[1];
  desc.back_texture.texture = all->textures[2];
  desc.has_size = true;
  desc.width = desc.height = 20;
  CS_TRY(celspan_rostrum_create(context, &desc, &all->inner));
  CS_TRY(celspan_object_create_rostrum(context, all->inner, &all->nested));
  cel_desc.objects = &all->nested;
  cel_desc.object_count = 1;
  cel_desc.front_texture.texture = all->textures[1];
  cel_desc.back_texture.texture = all->textures[2];
  CS_TRY(celspan_cel_create(context, &cel_desc, &all->lit));
  desc.cels = &all->lit;
  desc.cel_count = 1;
  desc.antialias = CELSPAN_ANTIALIAS_FILTER;
  CS_TRY(celspan_rostrum_create(context, &desc, &all->rostrum));
  CS_TRY(name_everything(context, all));
  CS_TRY(try_effects(context, all->objects[0]));
  celspan_exposure exposure = {all->rostrum, 1};
  double rgba[4];
  return probe_film(context, &exposure, 1, 20, 20, (celspan_point){3, 2}, rgba);
}

static void release(everything *all) {
  celspan_rostrum_unref(all->rostrum);
  celspan_rostrum_unref(all->inner);
  celspan_object_unref(all->nested);
  celspan_cel_unref(all->lit);
  celspan_cel_unref(all->cel);
  for (int i = 0; i < 2; i++) {
    celspan_cel_unref(all->cels[i]);
    celspan_object_unref(all->operands[i]);
  }
  for (int i = 0; i < 9; i++)
    celspan_object_unref(all->objects[i]);
  for (int i = 0; i < 4; i++)
    celspan_texture_unref(all->textures[i]);
}

static celspan_status build_everything(celspan_context *context) {
  everything all = {0};
  celspan_status status = build_textures(context, &all);
  if (status == CELSPAN_OK)
    status = build_primitives(context, &all);
  if (status == CELSPAN_OK)
    status = build_film(context, &all);
  release(&all);
  return status;
}

static void test_failing_allocations(void) {
  celspan_status status = CELSPAN_NO_MEMORY;
  for (size_t n = 1; status != CELSPAN_OK && n < 1000; n++) {
    memory_watch watch = {0};
    celspan_context *context = memory_watch_context(&watch);
    size_t before = watch.blocks;
    watch.fail_at = watch.allocations + n;
    status = build_everything(context);
    CHECK(status == CELSPAN_OK || status == CELSPAN_NO_MEMORY);
    CHECK((status == CELSPAN_OK) == (watch.allocations < watch.fail_at));
    CHECK(watch.blocks == before && watch.size_errors == 0);
    celspan_context_destroy(context);
    CHECK(watch.blocks == 0 && watch.bytes == 0);
  }
  CHECK(status == CELSPAN_OK);
}

/* ---------------------------------------------------------------- lights with a shape, rostrums */

static void test_light_doors(studio *s) {
  celspan_texture *texture = studio_paint(s, celspan_paint_rgb(1, 1, 1, 1));
  celspan_cel_desc desc = CELSPAN_CEL_DESC;
  desc.front_texture = (celspan_light_texture){texture, -1, CELSPAN_LIGHT_ON_FRAME, 1};
  refuse_cel(s, desc, "cel: front.gain is -1; it must be 0 or more");
  desc.front_texture.gain = 1;
  desc.front_texture.on = (celspan_light_place)7;
  refuse_cel(s, desc, "cel: front.on is 7; it must be between 0 and 1");
  desc.front_texture.on = CELSPAN_LIGHT_ON_CEL;
  desc.front_texture.matte = 1.5;
  refuse_cel(s, desc, "cel: front.matte is 1.5; it must be between 0 and 1");
  desc.front_texture.matte = NAN;
  refuse_cel(s, desc, "cel: front.matte must be a finite number, got nan");
  celspan_rostrum_desc rostrum_desc = CELSPAN_ROSTRUM_DESC;
  rostrum_desc.back_texture = (celspan_light_texture){texture, 1, CELSPAN_LIGHT_ON_CEL, 1};
  refuse_rostrum(
      s, rostrum_desc,
      "rostrum: back cannot be on a cel, because it does not belong to one; put it on the "
      "frame");
}

/* A rostrum is an object if it has a size; equal ones have equal hashes. */
static void test_nested_doors(studio *s) {
  celspan_rostrum_desc desc = CELSPAN_ROSTRUM_DESC;
  celspan_object *object = NULL;
  celspan_rostrum *bare = studio_rostrum(s, desc, NULL, 0);
  CHECK(celspan_object_create_rostrum(s->context, bare, &object) == CELSPAN_BAD_ARGUMENT);
  CHECK(celspan_object_create_rostrum(s->context, NULL, &object) == CELSPAN_BAD_ARGUMENT);
  CHECK(!object);
  desc.has_size = true;
  for (int i = 0; i < 3; i++) {
    static const double bad[] = {0, -1, INFINITY};
    celspan_rostrum *rostrum = NULL;
    desc.width = 5;
    desc.height = bad[i];
    CHECK(celspan_rostrum_create(s->context, &desc, &rostrum) == CELSPAN_BAD_ARGUMENT);
  }
  desc.height = 4;
  celspan_rostrum *pair[2] = {studio_rostrum(s, desc, NULL, 0), studio_rostrum(s, desc, NULL, 0)};
  uint64_t hashes[3][2];
  for (int i = 0; i < 2; i++)
    celspan_rostrum_hash(pair[i], hashes[i]);
  celspan_rostrum_hash(bare, hashes[2]);
  CHECK(memcmp(hashes[0], hashes[1], sizeof hashes[0]) == 0);
  CHECK(memcmp(hashes[0], hashes[2], sizeof hashes[0]) != 0);
  celspan_box box;
  studio_check(s, celspan_object_create_rostrum(s->context, pair[0], &object));
  CHECK(object && celspan_object_bounds(object, &box) && box.width == 5 && box.height == 4);
  CHECK(celspan_object_contains(object, (celspan_point){0, 0}));
  CHECK(!celspan_object_contains(object, (celspan_point){5, 1}));
  celspan_object_unref(object);
}

int main(void) {
  void (*const tests[])(studio *) = {
      test_light_doors,
      test_nested_doors,
      test_paint_door,
      test_gradient_doors,
      test_fitted,
      test_picture_door,
      test_rect_door,
      test_outline_doors,
      test_object_doors,
      test_cel_door,
      test_rostrum_door,
      test_probe_door,
      test_cel_matrix,
      test_singular_view,
      test_bounds,
      test_cel_values,
      test_rounded_rect,
      test_image_without_reading,
      test_image_sizes,
      test_hashes,
      test_hash_of_degrees,
      test_hash_of_unused_fields,
      test_names,
      test_names_of_others,
      test_origins,
      test_nesting_limit,
      test_primitive_limit,
      test_count,
      test_procedure_is_released_once,
  };
  for (size_t i = 0; i < sizeof tests / sizeof *tests; i++) {
    memory_watch watch = {0};
    studio s = {.context = memory_watch_context(&watch)};
    if (!CHECK(s.context != NULL))
      break;
    tests[i](&s);
    studio_finish(&s);
    celspan_context_destroy(s.context);
    CHECK(watch.blocks == 0 && watch.bytes == 0 && watch.size_errors == 0);
  }
  test_values_outlive_their_context();
  test_failing_allocations();
  return check_done();
}
