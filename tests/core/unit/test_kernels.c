/* Filter kernels on rows of spans: edges against closed forms, light, constants, strips, margins;
 * and the retained rows that they read.
 */
#include <stdlib.h>

#include "base/elementary.h"
#include "engine/kernel/retained.h"
#include "engine/span/row.h"
#include "tests/support/frame_rows.h"
#include "tests/support/random.h"

#define SIDE 40

static celspan_filter_desc filter(celspan_kernel kernel, double radius) {
  return (celspan_filter_desc){.struct_size = sizeof(celspan_filter_desc),
                               .rows = 16,
                               .kernel = kernel,
                               .has_radius = radius >= 0,
                               .radius = radius};
}

/* A part of the frame: the rows 0, step, 2 step .. before the others. kernel: NULL for the default
 * mode. */
static image make(studio *s, celspan_rostrum *rostrum, const celspan_filter_desc *kernel,
                  int32_t width, int32_t height, int32_t x0, int32_t y0, int32_t step) {
  celspan_exposure exposure = {rostrum, 1};
  celspan_antialias_mode mode = CELSPAN_ANTIALIAS_FILTER;
  celspan_frame_desc desc = studio_frame(&exposure, 1, SIDE, SIDE, kernel ? &mode : NULL);
  desc.crop_x = x0;
  desc.crop_y = y0;
  desc.crop_width = width;
  desc.crop_height = height;
  desc.filter = kernel;
  return make_image(s, &desc, step);
}

static image whole(studio *s, celspan_rostrum *rostrum, const celspan_filter_desc *kernel) {
  return make(s, rostrum, kernel, SIDE, SIDE, 0, 0, 1);
}

static const float *at(const image *i, int32_t x, int32_t y) { return i->rgba[y * i->width + x]; }

static celspan_rostrum *show(studio *s, celspan_object *const *objects, size_t count) {
  celspan_cel *cel = studio_cel(s, CELSPAN_CEL_DESC, objects, count);
  return studio_rostrum(s, CELSPAN_ROSTRUM_DESC, &cel, 1);
}

static celspan_texture *white(studio *s) { return studio_paint(s, celspan_paint_rgb(1, 1, 1, 1)); }

static celspan_rostrum *half_plane(studio *s, double x, double y, double degrees) {
  celspan_object *rect = studio_rect(s, 0, -500, 1000, 1000, white(s)), *turned;
  celspan_matrix matrix = celspan_matrix_then(
      celspan_matrix_rotation(degrees * 3.14159265358979 / 180, (celspan_point){0, 0}),
      celspan_matrix_translation(x, y));
  turned = studio_transform(s, rect, matrix);
  return show(s, &turned, 1);
}

/* ---------------------------------------------------------------- closed forms */

/* The share of a kernel below x, by Simpson's rule over its definition. */
typedef double (*profile)(double x, double radius);

static double box_profile(double x, double radius) { return fabs(x) < radius ? 0.5 / radius : 0; }

static double gaussian_profile(double x, double radius) {
  double sigma = radius / 3;
  return exp(-0.5 * x * x / (sigma * sigma)) / (sigma * 2.506628274631) / erf(3 / sqrt(2));
}

static double mitchell_profile(double x, double radius) {
  double a = 2 * fabs(x) / radius, b = 1.0 / 3;
  double near = (12 - 9 * b - 6 * b) * a * a * a + (-18 + 12 * b + 6 * b) * a * a + (6 - 2 * b);
  double far = (-b - 6 * b) * a * a * a + (6 * b + 30 * b) * a * a + (-12 * b - 48 * b) * a +
               (8 * b + 24 * b);
  return (a < 1 ? near : a < 2 ? far : 0) / 6 * 2 / radius;
}

static double lanczos_profile(double x, double radius) {
  double p = 3.14159265358979 * x;
  return fabs(x) >= radius ? 0
         : p == 0          ? 1
                           : radius * sin(p) * sin(p / radius) / (p * p) / 0.9970558;
}

static double below(profile f, double radius, double x) {
  double sum = 0, low = -radius, high = x < -radius ? -radius : x > radius ? radius : x;
  int parts = 4000;
  for (int i = 0; i < parts; i++)
    sum += f(low + (high - low) * (i + 0.5) / parts, radius);
  return sum * (high - low) / parts;
}

static void check_edges(void) {
  static const struct {
    celspan_kernel kernel;
    double radius;
    profile f;
  } kernels[] = {{CELSPAN_KERNEL_BOX, 0.5, box_profile},
                 {CELSPAN_KERNEL_BOX, 1.7, box_profile},
                 {CELSPAN_KERNEL_GAUSSIAN, 1.5, gaussian_profile},
                 {CELSPAN_KERNEL_GAUSSIAN, 6, gaussian_profile},
                 {CELSPAN_KERNEL_MITCHELL, 2, mitchell_profile},
                 {CELSPAN_KERNEL_MITCHELL, 3.3, mitchell_profile},
                 {CELSPAN_KERNEL_LANCZOS, 3, lanczos_profile}};
  static studio s;
  CHECK(celspan_context_create(NULL, &s.context) == CELSPAN_OK);
  for (size_t k = 0; k < sizeof kernels / sizeof *kernels; k++)
    for (int way = 0; way < 4; way++) {
      double edge = 20 + 0.137 * (way + 1), radius = kernels[k].radius;
      celspan_filter_desc f = filter(kernels[k].kernel, radius);
      image i = whole(&s, half_plane(&s, edge, edge, 90.0 * way), &f);
      for (int32_t p = 0; p < SIDE; p++) {
        double d = p + 0.5 - edge, want = below(kernels[k].f, radius, way < 2 ? d : -d);
        bool is_signed = kernels[k].kernel >= CELSPAN_KERNEL_MITCHELL;
        if (is_signed)
          want = want < 0 ? 0 : want > 1 ? 1 : want;
        const float *got = way % 2 ? at(&i, 13, p) : at(&i, p, 13);
        CHECK_NEAR((double)got[0], want, 0.002);
        CHECK_NEAR((double)got[3], want, 0.002);
      }
      CHECK(i.kinds[CELSPAN_SPAN_ARRAY] == 0);
      free(i.rgba);
      studio_finish(&s);
    }
  celspan_context_destroy(s.context);
}

/* Memory with NaN behind every block, so that reading there by mistake shows. */
static void *with_nan_behind(void *user, void *block, size_t old_size, size_t new_size) {
  const size_t behind = 4096;
  (void)user;
  (void)old_size;
  char *made = new_size > 0 ? realloc(block, new_size + behind) : NULL;
  if (made)
    memset(made + new_size, 0xff, behind);
  else if (new_size == 0)
    free(block);
  return made;
}

/* An edge so little left of a pixel's centre that its distance rounds to a whole pixel. */
static void check_edge_beside_centre(void) {
  static studio s;
  celspan_context_desc desc = CELSPAN_CONTEXT_DESC;
  desc.resize = with_nan_behind;
  CHECK(celspan_context_create(&desc, &s.context) == CELSPAN_OK);
  celspan_filter_desc f = filter(CELSPAN_KERNEL_GAUSSIAN, 1.5);
  image i = whole(&s, half_plane(&s, nextafter(0.5, 0), 0, 0), &f);
  for (int32_t p = 0; p < SIDE; p++)
    CHECK_NEAR((double)at(&i, p, 13)[3], below(gaussian_profile, 1.5, p), 0.002);
  free(i.rgba);
  studio_finish(&s);
  celspan_context_destroy(s.context);
}

/* An edge at any angle under a kernel that has no direction: a Gaussian of its sigma. */
static void check_slanted(void) {
  static studio s;
  CHECK(celspan_context_create(NULL, &s.context) == CELSPAN_OK);
  celspan_filter_desc f = filter(CELSPAN_KERNEL_GAUSSIAN, 3);
  for (int k = 0; k < 12; k++) {
    double degrees = 7.5 + 31 * k, turn = degrees * 3.14159265358979 / 180, worst = 0;
    image i = whole(&s, half_plane(&s, 20, 20, degrees), &f);
    for (int32_t y = 8; y < 32; y++)
      for (int32_t x = 8; x < 32; x++) {
        double d = (x + 0.5 - 20) * cos(turn) + (y + 0.5 - 20) * sin(turn);
        double error = fabs((double)at(&i, x, y)[0] - 0.5 * (1 + erf(d / sqrt(2))));
        worst = error > worst ? error : worst;
      }
    CHECK_NEAR(worst, 0, 0.002);
    free(i.rgba);
    studio_finish(&s);
  }
  celspan_context_destroy(s.context);
}

/* ---------------------------------------------------------------- light and constants */

/* On average over the position of a shape between the pixels, which are the kernel's samples. */
static void check_light(void) {
  static const celspan_filter_desc kernels[] = {
      {.struct_size = sizeof *kernels, .rows = 16, .kernel = CELSPAN_KERNEL_BOX},
      {.struct_size = sizeof *kernels,
       .rows = 16,
       .kernel = CELSPAN_KERNEL_BOX,
       .has_radius = true,
       .radius = 2.3},
      {.struct_size = sizeof *kernels, .rows = 16, .kernel = CELSPAN_KERNEL_GAUSSIAN},
      {.struct_size = sizeof *kernels,
       .rows = 16,
       .kernel = CELSPAN_KERNEL_GAUSSIAN,
       .has_radius = true,
       .radius = 0.4},
      {.struct_size = sizeof *kernels,
       .rows = 16,
       .kernel = CELSPAN_KERNEL_GAUSSIAN,
       .has_radius = true,
       .radius = 7},
      {.struct_size = sizeof *kernels,
       .rows = 16,
       .kernel = CELSPAN_KERNEL_MITCHELL,
       .has_radius = true,
       .radius = 0.6}};
  static studio s;
  CHECK(celspan_context_create(NULL, &s.context) == CELSPAN_OK);
  for (size_t k = 0; k < sizeof kernels / sizeof *kernels; k++) {
    double sum = 0;
    for (int place = 0; place < 64; place++) {
      image i = whole(&s,
                      studio_show(&s, studio_circle(&s, 20 + 0.125 * (place % 8),
                                                    19.5 + 0.125 * (place / 8), 9, white(&s))),
                      &kernels[k]);
      for (int32_t p = 0; p < SIDE * SIDE; p++)
        sum += (double)i.rgba[p][0] / 64;
      free(i.rgba);
      studio_finish(&s);
    }
    CHECK_NEAR(sum / (3.14159265358979 * 81), 1, 0.001);
  }
  celspan_context_destroy(s.context);
}

static void check_constants(void) {
  static studio s;
  CHECK(celspan_context_create(NULL, &s.context) == CELSPAN_OK);
  celspan_object *object = studio_rect(&s, -100, -100, 300, 300,
                                       studio_paint(&s, celspan_paint_rgb(0.1f, 0.7f, 0.3f, 0.6f)));
  celspan_rostrum *rostrum = show(&s, &object, 1);
  for (int k = 0; k < 4; k++) {
    celspan_filter_desc f = filter((celspan_kernel)k, -1);
    image i = whole(&s, rostrum, &f);
    for (int32_t p = 0; p < SIDE * SIDE; p++)
      CHECK_NEAR((double)i.rgba[p][1], 0.7 * 0.6, 1e-6);
    CHECK(i.kinds[CELSPAN_SPAN_SINGLE] == SIDE && i.kinds[CELSPAN_SPAN_ARRAY] == 0);
    free(i.rgba);
  }
  studio_finish(&s);
  celspan_context_destroy(s.context);
}

/* After negative lobes no value leaves the range of the unfiltered picture. */
static void check_range(void) {
  static studio s;
  CHECK(celspan_context_create(NULL, &s.context) == CELSPAN_OK);
  celspan_object *objects[2] = {
      studio_rect(&s, -50, -50, 200, 200,
                  studio_paint(&s, celspan_paint_rgb(0.25f, 0.5f, 0.75f, 1))),
      studio_rect(&s, 10, 10.3, 12, 15.4,
                  studio_paint(&s, celspan_paint_rgb(0.75f, 0.25f, 0.5f, 1)))};
  celspan_rostrum *rostrum = show(&s, objects, 2);
  celspan_filter_desc f = filter(CELSPAN_KERNEL_LANCZOS, -1);
  image i = whole(&s, rostrum, &f);
  for (int32_t p = 0; p < SIDE * SIDE; p++) {
    CHECK(i.rgba[p][0] >= 0.25f && i.rgba[p][0] <= 0.75f);
    CHECK(i.rgba[p][1] >= 0.25f && i.rgba[p][1] <= 0.5f);
    CHECK(i.rgba[p][2] >= 0.5f && i.rgba[p][2] <= 0.75f);
    CHECK(i.rgba[p][3] == 1);
  }
  free(i.rgba);
  studio_finish(&s);
  celspan_context_destroy(s.context);
}

/* ---------------------------------------------------------------- layers that vary */

static celspan_texture *ramp(studio *s) {
  celspan_stop stops[2] = {{0, celspan_paint_rgb(0, 0, 0, 1)}, {1, celspan_paint_rgb(1, 1, 1, 1)}};
  return studio_linear(s, (celspan_point){0, 0}, (celspan_point){SIDE, 0}, stops, 2);
}

static void check_gradients(void) {
  static studio s;
  CHECK(celspan_context_create(NULL, &s.context) == CELSPAN_OK);
  celspan_object *objects[2] = {studio_rect(&s, -50, -50, 200, 200, ramp(&s)),
                                studio_circle(&s, 20, 20, 8, white(&s))};
  celspan_rostrum *rostrum = show(&s, objects, 2);
  for (int k = 0; k < 4; k++) {
    celspan_filter_desc f = filter((celspan_kernel)k, -1);
    image i = whole(&s, rostrum, &f);
    for (int32_t x = 0; x < SIDE; x++)
      CHECK_NEAR((double)at(&i, x, 2)[0], (x + 0.5) / SIDE, 1.0 / 1023);
    CHECK(at(&i, 20, 20)[0] == 1);
    CHECK(at(&i, 20, 12)[0] > 0.5f && at(&i, 20, 12)[0] <= 1);
    CHECK(i.kinds[CELSPAN_SPAN_GRADIENT] >= SIDE);
    free(i.rgba);
  }
  studio_finish(&s);
  celspan_context_destroy(s.context);
}

/* ---------------------------------------------------------------- rows on their own */

static celspan_rostrum *random_scene(studio *s, uint64_t seed) {
  celspan_object *objects[12];
  test_random random = {seed};
  for (int k = 0; k < 12; k++) {
    float c = random_unit(&random), d = random_unit(&random);
    celspan_texture *t =
        k % 4 == 3 ? ramp(s) : studio_paint(s, celspan_paint_rgb(c, d, 1 - c, 0.3f + 0.7f * d));
    double x = random_between(&random, -2, 42), y = random_between(&random, -2, 42);
    double size = random_between(&random, 1, 15);
    objects[k] =
        k % 2 ? studio_circle(s, x, y, size, t) : studio_rect(s, x, y, size, size * 0.7, t);
  }
  return show(s, objects, 12);
}

static void check_same(const image *a, const image *b, int32_t x0, int32_t y0) {
  for (int32_t y = 0; y < b->height; y++)
    for (int32_t x = 0; x < b->width; x++)
      CHECK(memcmp(at(a, x0 + x, y0 + y), at(b, x, y), 4 * sizeof(float)) == 0);
}

static void check_orders(void) {
  static studio s;
  CHECK(celspan_context_create(NULL, &s.context) == CELSPAN_OK);
  for (uint64_t seed = 1; seed <= 6; seed++) {
    celspan_rostrum *rostrum = random_scene(&s, seed);
    celspan_filter_desc f = filter((celspan_kernel)(seed % 4), seed > 4 ? 4.2 : -1);
    image a = whole(&s, rostrum, &f), b = make(&s, rostrum, &f, SIDE, SIDE, 0, 0, 7);
    image c = make(&s, rostrum, &f, 17, 9, 11, 23, 1);
    check_same(&a, &b, 0, 0);
    check_same(&a, &c, 11, 23);
    free(a.rgba);
    free(b.rgba);
    free(c.rgba);
    studio_finish(&s);
  }
  celspan_context_destroy(s.context);
}

/* The box of radius 1/2 equals the mode AREA, except where curves are divided into chords. */
static void check_area(void) {
  static studio s;
  CHECK(celspan_context_create(NULL, &s.context) == CELSPAN_OK);
  for (uint64_t seed = 1; seed <= 10; seed++) {
    celspan_rostrum *rostrum = random_scene(&s, seed);
    celspan_filter_desc f = filter(CELSPAN_KERNEL_BOX, -1);
    image a = whole(&s, rostrum, &f), b = whole(&s, rostrum, NULL);
    for (int32_t p = 0; p < SIDE * SIDE; p++)
      for (int c = 0; c < 4; c++)
        CHECK_NEAR((double)a.rgba[p][c], (double)b.rgba[p][c], 0.01); /* flattening */
    free(a.rgba);
    free(b.rgba);
    studio_finish(&s);
  }
  celspan_context_destroy(s.context);
}

/* ---------------------------------------------------------------- the door */

static celspan_status one_function(void *user, celspan_context *context, double x, double *out) {
  (void)context;
  *out = *(double *)user == 0 ? x : *(double *)user;
  return CELSPAN_OK;
}

static celspan_status no_function(void *user, celspan_context *context, double x, double *out) {
  (void)user, (void)x, (void)out;
  return celspan_context_fail(context, CELSPAN_CALLBACK, "no kernel today");
}

static void refuse(celspan_context *context, const celspan_filter_desc *f, celspan_status status,
                   const char *message) {
  celspan_rostrum_desc desc = CELSPAN_ROSTRUM_DESC;
  celspan_rostrum *rostrum = NULL;
  desc.antialias = CELSPAN_ANTIALIAS_FILTER;
  desc.filter = f;
  CHECK(celspan_rostrum_create(context, &desc, &rostrum) == status && !rostrum);
  CHECK_TEXT(celspan_context_error(context), message);
}

static void check_door(void) {
  celspan_context *context;
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  celspan_filter_desc f = filter(CELSPAN_KERNEL_GAUSSIAN, 1);
  f.radius = -1;
  refuse(context, &f, CELSPAN_BAD_ARGUMENT,
         "rostrum: antialias: radius is -1; it must be between 0 and 256");
  f.radius = (double)NAN;
  refuse(context, &f, CELSPAN_BAD_ARGUMENT,
         "rostrum: antialias: radius must be a finite number, got nan");
  f = filter(CELSPAN_KERNEL_FUNCTION, 2);
  double value = 0;
  f.function_user = &value;
  refuse(context, &f, CELSPAN_BAD_ARGUMENT, "rostrum: antialias: kernel has no function");
  f.function = one_function;
  refuse(context, &f, CELSPAN_BAD_ARGUMENT,
         "rostrum: antialias: the kernel sums to nothing within its radius of 2");
  value = (double)INFINITY;
  refuse(context, &f, CELSPAN_BAD_ARGUMENT,
         "rostrum: antialias: the kernel's value at -1.999023 must be a finite number, got inf");
  f.function = no_function;
  refuse(context, &f, CELSPAN_CALLBACK, "no kernel today");
  celspan_context_destroy(context);
}

/* Retained rows have cells of their own, each once where neighbours share it. */
static void check_retained(void) {
  enum { EDGES = 40, VARYING = 7 };
  celspan_context *context;
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  cs_layer layers[2] = {0};
  const cs_stack stack = {.layers = layers, .layer_count = 2};
  cs_item items[3] = {{0, 0}, {1, 0}, {0, 0}};
  const cs_composer composer = {.context = context, .stack = &stack, .items = items};
  cs_cell sides[2 * EDGES]; /* of each edge: copies at places of their own, as a row has them */
  cs_retained_row row = {0};
  cs_retained_begin(&row, 3, cs_v4_all(0));
  for (int i = 0; i < 2 * EDGES; i++) {
    int cell = (i + 1) / 2;
    sides[i] = cell % VARYING == 1 ? (cs_cell){cs_v4_all(9), {1, 1}, 1, 2}
                                   : (cs_cell){cs_v4_all((float)cell), {2, 2}, 0, 0};
    const cs_border edge = {{cell, 3, cell, 4}, &sides[i - i % 2], &sides[i]};
    if (i % 2 == 1)
      CHECK(cs_retained_add(&row, context, &edge) == CELSPAN_OK);
  }
  CHECK(cs_retained_seal(&row, &composer) == CELSPAN_OK && row.is_sealed);
  memset(items, 0, sizeof items);
  memset(sides, 0, sizeof sides);
  CHECK(row.edge_count == EDGES && row.cell_count == EDGES + 1);
  for (size_t i = 0; i < EDGES; i++) {
    const cs_border *edge = &row.edges[i];
    CHECK(cs_retained_number(&row, edge->left) == i && edge->right == edge->left + 1);
    if (i % VARYING != 1) {
      CHECK(edge->left->length == 0 && edge->left->colour[0] == (float)i);
      continue;
    }
    const cs_program program = cs_retained_program(&row, edge->left);
    CHECK(program.length == 2 && program.items[0].layer == 1 && program.items[1].layer == 0);
    CHECK(edge->left->colour[0] == 0);
  }
  cs_retained_finish(&row, context->memory);
  celspan_context_destroy(context);
}

int main(void) {
  check_retained();
  check_edges();
  check_edge_beside_centre();
  check_slanted();
  check_light();
  check_constants();
  check_range();
  check_gradients();
  check_orders();
  check_area();
  check_door();
  return check_done();
}
