/* Light through filters: the sum over all pixels of a single small shape is its area, under every
 * kernel and at every position between the pixels.
 */
#include <math.h>

#include "tests/support/frame_rows.h"

#define PI 3.14159265358979
#define DISC 9   /* radius of the shape, pixels */
#define PLACES 4 /* of the shape in its pixel, along each axis */

/* The sum of alpha over a square frame. */
static double total(studio *s, celspan_rostrum *rostrum, const celspan_filter_desc *kernel,
                    int32_t side) {
  celspan_exposure exposure = {rostrum, 1};
  celspan_antialias_mode mode = CELSPAN_ANTIALIAS_FILTER;
  celspan_frame_desc desc = studio_frame(&exposure, 1, side, side, kernel ? &mode : NULL);
  desc.filter = kernel;
  image whole = make_image(s, &desc, 1);
  double sum = 0;
  for (int32_t i = 0; i < side * side; i++)
    sum += (double)whole.rgba[i][3];
  free(whole.rgba);
  return sum;
}

static celspan_rostrum *show(studio *s, celspan_object *object, double defocus,
                             celspan_defocus_kernel kernel) {
  celspan_cel_desc desc = CELSPAN_CEL_DESC;
  desc.defocus_radius = defocus;
  desc.defocus_kernel = kernel;
  celspan_cel *cel = studio_cel(s, desc, &object, 1);
  return studio_rostrum(s, CELSPAN_ROSTRUM_DESC, &cel, 1);
}

/* The least and greatest share of a shape's light over PLACES by PLACES positions; the mean. */
typedef struct shares {
  double least, most, mean;
} shares;

typedef struct setting { /* how the shape is seen */
  const celspan_filter_desc *kernel;
  double defocus;
  celspan_defocus_kernel defocus_kernel;
} setting;

/* The disc, or a bar that reaches beyond the frame above and below. */
static shares measure(studio *s, const setting *l, int32_t side, bool is_bar) {
  shares out = {INFINITY, -INFINITY, 0};
  int rows = is_bar ? 1 : PLACES;
  for (int k = 0; k < PLACES * rows; k++) {
    double x = 0.5 * side + 0.03 + (double)(k % PLACES) / PLACES;
    double y = 0.5 * side + 0.07 + (double)(k / PLACES) / PLACES;
    celspan_texture *white = studio_paint(s, celspan_paint_rgb(1, 1, 1, 1));
    celspan_object *shape = is_bar ? studio_rect(s, x - DISC, -side, 2 * DISC, 3 * side, white)
                                   : studio_circle(s, x, y, DISC, white);
    double area = is_bar ? 2.0 * DISC * side : PI * DISC * DISC;
    double share = total(s, show(s, shape, l->defocus, l->defocus_kernel), l->kernel, side) / area;
    out.least = fmin(out.least, share);
    out.most = fmax(out.most, share);
    out.mean += share / (PLACES * rows);
    studio_finish(s);
  }
  return out;
}

static void check_each(const shares *found, const char *what, double radius) {
  bool is_kept = CHECK_NEAR(found->least, 1, 0.001);
  is_kept = CHECK_NEAR(found->most, 1, 0.001) && is_kept;
  if (!is_kept)
    fprintf(stderr, "  %s, radius %g\n", what, radius);
}

/* ---------------------------------------------------------------- defocus */

static void check_defocus(void) {
  static const double radii[] = {0.1, 0.3, 0.45, 0.7, 1, 1.4, 1.9, 2, 2.3, 3.1, 4, 6.5, 11, 18, 40};
  static const char *const names[] = {"gaussian defocus", "box defocus", "disc defocus"};
  static studio s;
  CHECK(celspan_context_create(NULL, &s.context) == CELSPAN_OK);
  for (size_t i = 0; i < sizeof radii / sizeof *radii; i++)
    for (int kernel = 0; kernel < 3; kernel++) {
      double extent = kernel == CELSPAN_DEFOCUS_GAUSSIAN ? 2 * radii[i] : radii[i];
      setting l = {NULL, radii[i], (celspan_defocus_kernel)kernel};
      shares found = measure(&s, &l, 2 * (int32_t)ceil(extent + DISC + 2), false);
      check_each(&found, names[kernel], radii[i]);
    }
  celspan_context_destroy(s.context);
}

/* ---------------------------------------------------------------- kernels */

static celspan_status tent(void *user, celspan_context *context, double x, double *out) {
  (void)context;
  *out = *(double *)user - fabs(x);
  return CELSPAN_OK;
}

/* Radii from which on light is preserved at every position of the shape; narrower kernels leave
 * gaps between the pixels, or are uneven like a box that is not a whole number of pixels wide. */
static const struct {
  celspan_kernel kernel;
  const char *name;
  double radii[10];
} kept[] = {{CELSPAN_KERNEL_BOX, "box", {0.5, 1, 1.5, 1.7, 2, 2.3, 3.4, 5.3, 12, 24}},
            {CELSPAN_KERNEL_GAUSSIAN, "gaussian", {1.3, 1.5, 1.7, 2, 2.3, 3, 5.3, 9, 12, 24}},
            {CELSPAN_KERNEL_FUNCTION, "tent", {1, 1.5, 1.7, 2, 2.3, 3, 5.3, 9, 12, 24}}};

static void check_kernels(void) {
  static studio s;
  CHECK(celspan_context_create(NULL, &s.context) == CELSPAN_OK);
  for (size_t i = 0; i < 30; i++) {
    double radius = kept[i / 10].radii[i % 10];
    celspan_filter_desc kernel = {.struct_size = sizeof kernel,
                                  .rows = 16,
                                  .kernel = kept[i / 10].kernel,
                                  .has_radius = true,
                                  .radius = radius,
                                  .function = tent,
                                  .function_user = &radius};
    setting l = {.kernel = &kernel};
    shares found = measure(&s, &l, 2 * (int32_t)ceil(radius + DISC + 2), false);
    check_each(&found, kept[i / 10].name, radius);
  }
  celspan_context_destroy(s.context);
}

/* Undershoots are clamped, and so are overshoots: along straight edges both by the same amount. */
static void check_signed(void) {
  static const double radii[] = {1.5, 2, 2.3, 3, 4.2, 8};
  static studio s;
  CHECK(celspan_context_create(NULL, &s.context) == CELSPAN_OK);
  for (int i = 0; i < 12; i++) {
    celspan_filter_desc kernel = {.struct_size = sizeof kernel,
                                  .rows = 16,
                                  .kernel =
                                      i % 2 ? CELSPAN_KERNEL_LANCZOS : CELSPAN_KERNEL_MITCHELL,
                                  .has_radius = true,
                                  .radius = radii[i / 2]};
    setting l = {.kernel = &kernel};
    shares found = measure(&s, &l, 2 * (int32_t)ceil(kernel.radius + DISC + 2), true);
    check_each(&found, i % 2 ? "lanczos" : "mitchell", kernel.radius);
  }
  celspan_context_destroy(s.context);
}

/* Narrow kernels preserve it on average over the positions. */
static void check_narrow(void) {
  static const double radii[] = {0.1, 0.3, 0.4, 0.8, 1};
  static studio s;
  CHECK(celspan_context_create(NULL, &s.context) == CELSPAN_OK);
  for (int i = 0; i < 15; i++) {
    double radius = radii[i / 3];
    celspan_filter_desc kernel = {.struct_size = sizeof kernel,
                                  .rows = 16,
                                  .kernel = kept[i % 3].kernel,
                                  .has_radius = true,
                                  .radius = radius,
                                  .function = tent,
                                  .function_user = &radius};
    setting l = {.kernel = &kernel};
    shares found = measure(&s, &l, 2 * (DISC + 4), false);
    if (!CHECK_NEAR(found.mean, 1, 0.001))
      fprintf(stderr, "  %s, radius %g\n", kept[i % 3].name, radius);
  }
  celspan_context_destroy(s.context);
}

int main(void) {
  check_defocus();
  check_kernels();
  check_signed();
  check_narrow();
  return check_done();
}
