/* Defocused cels against a brute-force convolution of probe samples; and their invariants. One
 * file, because all tests share the brute force.
 */
#include <stdlib.h>

#include "engine/defocus/bands.h"
#include "tests/support/frame_rows.h"
#include "tests/support/memory.h"
#include "tests/support/probe.h"

#define SIDE 48
#define CELLS 84 /* probe samples across a kernel */
#define BOUND 0.004
#define PI 3.14159265358979

typedef struct view {
  int32_t width, height;
  double film_width, film_height;
  celspan_antialias_mode antialias;
} view;

static uint64_t random_state;

static double random_unit(void) {
  random_state = random_state * 6364136223846793005u + 1442695040888963407u;
  return (double)(random_state >> 11) * 0x1p-53;
}

static double between(double low, double high) { return low + (high - low) * random_unit(); }

/* ---------------------------------------------------------------- pictures */

static image make(studio *s, celspan_rostrum *rostrum, const view *v, int32_t step) {
  celspan_exposure exposure = {rostrum, 1};
  celspan_frame_desc desc = studio_frame(&exposure, 1, v->width, v->height, &v->antialias);
  desc.film_width = v->film_width;
  desc.film_height = v->film_height;
  return make_image(s, &desc, step);
}

/* ---------------------------------------------------------------- scenes */

typedef struct stage { /* one cel, sharp and defocused, seen in the same way */
  celspan_rostrum *sharp, *defocused;
  celspan_rostrum *plain, *blended; /* defocused over a speck in a corner; with a mode */
  double camera_scale, camera_turn;
} stage;

static celspan_texture *random_ramp(studio *s) {
  celspan_stop stops[3];
  for (int i = 0; i < 3; i++) {
    float r = (float)random_unit(), g = (float)random_unit(), b = (float)random_unit();
    stops[i] = (celspan_stop){i / 2.0, celspan_paint_rgb(r, g, b, 1)};
  }
  double x0 = between(0, 20), y0 = between(0, 20), x1 = between(28, 48), y1 = between(28, 48);
  return studio_linear(s, (celspan_point){x0, y0}, (celspan_point){x1, y1}, stops, 3);
}

static celspan_object *random_object(studio *s, bool has_gels, bool has_ramps) {
  float r = (float)random_unit(), g = (float)random_unit(), b = (float)random_unit();
  float alpha = (float)between(0.3, 1);
  bool is_gel = has_gels && random_unit() < 0.4;
  celspan_texture *t =
      studio_paint(s, is_gel ? celspan_paint_gel(r, g, b) : celspan_paint_rgb(r, g, b, alpha));
  if (has_ramps && random_unit() < 0.3)
    t = random_ramp(s);
  double x = between(-8, 56), y = between(-8, 56), size = between(2, 18);
  if (random_unit() < 0.5)
    return studio_circle(s, x, y, size, t);
  celspan_object *rect = studio_rect(s, x - size, y - size / 2, 2 * size, size, t);
  return studio_transform(s, rect, celspan_matrix_rotation(between(0, 3), (celspan_point){x, y}));
}

static celspan_matrix random_placement(int kind) {
  const celspan_point from[4] = {{0, 0}, {48, 0}, {48, 48}, {0, 48}};
  const celspan_point to[4] = {{4, 2}, {45, 7}, {41, 40}, {-3, 50}};
  celspan_matrix matrix = celspan_matrix_identity();
  if (kind == 1)
    matrix = celspan_matrix_rotation(between(-2, 2), (celspan_point){24, 24});
  double across = kind == 2 ? between(0.6, 1.5) : 1, down = kind == 2 ? between(0.6, 1.5) : 1;
  if (kind == 2)
    matrix = celspan_matrix_scaling(across, down);
  if (kind == 3)
    CHECK(celspan_matrix_quad(from, to, &matrix));
  return matrix;
}

/* A defocused cel over a speck in a corner, which only a mode takes notice of. */
static celspan_rostrum *over_speck(studio *s, celspan_cel_desc desc, celspan_object **objects,
                                   celspan_blend mode, celspan_matrix placement) {
  celspan_object *speck =
      studio_rect(s, 0, 0, 0.5, 0.5, studio_paint(s, celspan_paint_rgb(1, 1, 1, 1)));
  celspan_cel *cels[2] = {studio_cel(s, CELSPAN_CEL_DESC, &speck, 1), NULL};
  desc.blend = mode;
  celspan_cel *cel = studio_cel(s, desc, objects, 10);
  studio_check(s, celspan_cel_transform(s->context, cel, &placement, &cels[1]));
  s->cels[s->cel_count++] = cels[1];
  return studio_rostrum(s, CELSPAN_ROSTRUM_DESC, cels, 2);
}

static celspan_rostrum *show(studio *s, celspan_cel *cel, const stage *camera) {
  celspan_rostrum_desc desc = CELSPAN_ROSTRUM_DESC;
  desc.back = (celspan_light){0.9f, 0.8f, 1, 0.7f};
  desc.has_camera_width = camera->camera_scale != 1;
  desc.camera_width = SIDE / camera->camera_scale;
  desc.camera_radians = camera->camera_turn;
  return studio_rostrum(s, desc, &cel, 1);
}

static stage random_stage(studio *s, int kind, double radius, celspan_defocus_kernel kernel,
                          double turn) {
  stage out = {.camera_scale = kind % 4 == 2 ? 1.3 : 1, .camera_turn = turn};
  celspan_object *objects[10];
  celspan_cel_desc desc = CELSPAN_CEL_DESC;
  celspan_cel *cels[2];
  celspan_matrix placement = random_placement(kind % 4);
  for (int i = 0; i < 10; i++)
    objects[i] = random_object(s, kind % 4 == 1, kind >= 4);
  desc.has_front = true;
  desc.front = (celspan_light){1, 0.8f, 0.9f, 1};
  desc.opacity = kind % 4 == 2 ? 0.8 : 1;
  for (int i = 0; i < 2; i++) {
    desc.defocus_radius = i == 0 ? 0 : radius;
    desc.defocus_kernel = kernel;
    celspan_cel *cel = studio_cel(s, desc, objects, 10);
    studio_check(s, celspan_cel_transform(s->context, cel, &placement, &cels[i]));
    s->cels[s->cel_count++] = cels[i];
  }
  out.sharp = show(s, cels[0], &out);
  out.defocused = show(s, cels[1], &out);
  out.plain = over_speck(s, desc, objects, CELSPAN_BLEND_NORMAL, placement);
  out.blended = over_speck(s, desc, objects, CELSPAN_BLEND_DIFFERENCE, placement);
  return out;
}

/* ---------------------------------------------------------------- brute force */

/* The kernel's weight at an offset in film units before the camera. */
static double weight_at(celspan_defocus_kernel kernel, double radius, double x, double y) {
  if (kernel == CELSPAN_DEFOCUS_BOX)
    return fabs(x) <= radius && fabs(y) <= radius;
  if (kernel == CELSPAN_DEFOCUS_DISC)
    return x * x + y * y <= radius * radius;
  return x * x + y * y <= 4 * radius * radius ? exp(-2 * (x * x + y * y) / (radius * radius)) : 0;
}

/* The mean of probes under the kernel around a point of the film; stratified. */
static void convolve(studio *s, const stage *set, celspan_defocus_kernel kernel, double radius,
                     celspan_point at, double out[4]) {
  double extent = kernel == CELSPAN_DEFOCUS_GAUSSIAN ? 2 * radius : radius, total = 0;
  double c = cos(-set->camera_turn), d = sin(-set->camera_turn);
  celspan_exposure exposure = {set->sharp, 1};
  memset(out, 0, 4 * sizeof *out);
  for (int j = 0; j < CELLS; j++)
    for (int i = 0; i < CELLS; i++) {
      double u = ((i + random_unit()) * 2 / CELLS - 1) * extent;
      double v = ((j + random_unit()) * 2 / CELLS - 1) * extent;
      double weight = weight_at(kernel, radius, u, v), rgba[4] = {0, 0, 0, 0};
      if (weight == 0)
        continue;
      celspan_point point = {at.x + (u * c - v * d) * set->camera_scale,
                             at.y + (u * d + v * c) * set->camera_scale};
      studio_check(s, probe_film(s->context, &exposure, 1, SIDE, SIDE, point, rgba));
      total += weight;
      for (int k = 0; k < 4; k++)
        out[k] += weight * rgba[k];
    }
  for (int k = 0; k < 4; k++)
    out[k] /= total;
}

/* The largest difference of a pixel from the mean. If that is more than half of the allowed
 * difference, the mean is computed several times first, until its own noise is a third. */
static double difference(studio *s, const stage *set, celspan_defocus_kernel kernel, double radius,
                         celspan_point at, const float pixel[4]) {
  double sum[4] = {0, 0, 0, 0}, worst = 0;
  int times = 0, most = 1;
  while (times < most) {
    double want[4];
    convolve(s, set, kernel, radius, at, want);
    times++;
    worst = 0;
    for (int c = 0; c < 4; c++) {
      sum[c] += want[c];
      worst = fmax(worst, fabs(sum[c] / times - (double)pixel[c]));
    }
    if (times == 1 && worst > BOUND / 2)
      most = 9;
  }
  return worst;
}

static void compare(studio *s, const stage *set, celspan_defocus_kernel kernel, double radius,
                    const view *v, int points, const char *what) {
  image defocused = make(s, set->defocused, v, 1);
  double worst = 0;
  for (int k = 0; k < points; k++) {
    /* the film's edges are compared first */
    int32_t x = k == 0 ? 0 : k == 1 ? v->width - 1 : (int32_t)between(0, v->width);
    int32_t y = k == 2 ? 0 : k == 3 ? v->height - 1 : (int32_t)between(0, v->height);
    celspan_point at = {(x + 0.5) * SIDE / v->width, (y + 0.5) * SIDE / v->height};
    worst = fmax(worst, difference(s, set, kernel, radius, at, defocused.rgba[y * v->width + x]));
  }
  if (!CHECK_NEAR(worst, 0, BOUND))
    fprintf(stderr, "  %s: radius %g, kernel %d\n", what, radius, (int)kernel);
  free(defocused.rgba);
}

static void check_brute_force(void) {
  static const double radii[] = {0.8, 2, 3.3, 5, 7.5, 11, 16};
  static const char *const kinds[] = {"plain", "rotated, gels", "scaled", "perspective"};
  static studio s;
  CHECK(celspan_context_create(NULL, &s.context) == CELSPAN_OK);
  for (int k = 0; k < 42; k++) {
    if (!check_is_drawn(k))
      continue;
    double radius = radii[k % 7];
    celspan_defocus_kernel kernel = (celspan_defocus_kernel)(k / 7 % 3);
    int kind = (k + k / 7) % 4;
    random_state = 77 + (uint64_t)k;
    stage set = random_stage(&s, kind, radius, kernel, k % 2 ? 0.4 : 0);
    view v = {SIDE, SIDE, SIDE, SIDE, radius < 3 ? CELSPAN_ANTIALIAS_NONE : CELSPAN_ANTIALIAS_AREA};
    compare(&s, &set, kernel, radius, &v, 8, kinds[kind]);
    v.width = 2 * SIDE + 10; /* the kernel scales with the frame, separately along each axis */
    v.height = 30;
    if (k % 3 == 0)
      compare(&s, &set, kernel, radius, &v, 8, kinds[kind]);
    studio_finish(&s);
  }
  celspan_context_destroy(s.context);
}

/* Frames large enough for the grid to be coarser than the pixels. */
static void check_coarse(void) {
  static studio s;
  CHECK(celspan_context_create(NULL, &s.context) == CELSPAN_OK);
  for (int k = 0; k < 9; k++) {
    if (!check_is_drawn(k))
      continue;
    double radius = k < 6 ? 6 : 16;
    celspan_defocus_kernel kernel = (celspan_defocus_kernel)(k % 3);
    random_state = 990 + (uint64_t)k;
    stage set = random_stage(&s, k % 4, radius, kernel, k % 2 ? 0.7 : 0);
    view v = {1000, 1000, SIDE, SIDE, CELSPAN_ANTIALIAS_AREA};
    compare(&s, &set, kernel, radius, &v, 24, "coarse");
    studio_finish(&s);
  }
  celspan_context_destroy(s.context);
}

/* Layers that vary are filtered together with the others. */
static void check_ramps(double least, celspan_antialias_mode mode) {
  static studio s;
  CHECK(celspan_context_create(NULL, &s.context) == CELSPAN_OK);
  for (int k = 0; k < 12; k++) {
    if (!check_is_drawn(k))
      continue;
    double radius = least * (1 + 0.75 * (k % 4));
    celspan_defocus_kernel kernel = (celspan_defocus_kernel)(k % 3);
    random_state = 4000 + (uint64_t)k;
    stage set = random_stage(&s, 4 + k % 4, radius, kernel, k % 2 ? 0.5 : 0);
    view v = {SIDE, SIDE, SIDE, SIDE, mode};
    compare(&s, &set, kernel, radius, &v, 8, "ramps");
    studio_finish(&s);
  }
  celspan_context_destroy(s.context);
}

/* ---------------------------------------------------------------- other invariants */

static void check_same(const image *a, const image *b) {
  CHECK(memcmp(a->rgba, b->rgba, (size_t)a->width * (size_t)a->height * 4 * sizeof(float)) == 0);
}

/* A row does not depend on those made before it, nor on the capacity of the store. */
static void check_orders(void) {
  static studio s;
  celspan_context_desc small = CELSPAN_CONTEXT_DESC;
  small.defocus_bytes = 1;
  for (int k = 0; k < 6; k++) {
    if (!check_is_drawn(k))
      continue;
    view v = {300, 200, SIDE, SIDE, CELSPAN_ANTIALIAS_AREA};
    image images[3];
    for (int way = 0; way < 3; way++) {
      CHECK(celspan_context_create(way == 2 ? &small : NULL, &s.context) == CELSPAN_OK);
      random_state = 5 + (uint64_t)k;
      stage set = random_stage(&s, k % 4, k < 3 ? 0.7 : 8, (celspan_defocus_kernel)(k % 3), 0);
      images[way] = make(&s, set.defocused, &v, way == 1 ? 37 : 1);
      studio_finish(&s);
      celspan_context_destroy(s.context);
    }
    check_same(&images[0], &images[1]);
    check_same(&images[0], &images[2]);
    for (int way = 0; way < 3; way++)
      free(images[way].rgba);
  }
}

/* ---------------------------------------------------------------- blended */

/* A source over nothing is what it is without its mode, pixel by pixel as by lines. */
static void check_blended(void) {
  static const double radii[] = {3, 6, 14, 24};
  static studio s;
  view v = {200, 150, SIDE, SIDE, CELSPAN_ANTIALIAS_AREA};
  CHECK(celspan_context_create(NULL, &s.context) == CELSPAN_OK);
  for (int k = 0; k < 16; k++) {
    if (!check_is_drawn(k))
      continue;
    double worst = 0;
    random_state = 77 + (uint64_t)k;
    v.antialias = k % 2 ? CELSPAN_ANTIALIAS_NONE : CELSPAN_ANTIALIAS_AREA;
    stage set = random_stage(&s, k % 3 + 4 * (k / 12), radii[k / 4],
                             k % 5 ? CELSPAN_DEFOCUS_GAUSSIAN : CELSPAN_DEFOCUS_DISC, 0);
    image plain = make(&s, set.plain, &v, 1), blended = make(&s, set.blended, &v, 1);
    image skipped = make(&s, set.blended, &v, 37);
    for (int32_t p = 5 * v.width; p < v.width * v.height; p++)
      for (int c = 0; c < 4; c++)
        worst = fmax(worst, fabs((double)plain.rgba[p][c] - (double)blended.rgba[p][c]));
    check_same(&blended, &skipped);
    if (!CHECK(worst < 1.5 / 1023))
      fprintf(stderr, "  case %d: %.2f of 1023\n", k, 1023 * worst);
    free(plain.rgba);
    free(blended.rgba);
    free(skipped.rgba);
    studio_finish(&s);
  }
  celspan_context_destroy(s.context);
}

static celspan_rostrum *defocused_disc(studio *s, double x, double size, double radius,
                                       celspan_defocus_kernel kernel, double opacity) {
  celspan_object *disc =
      studio_circle(s, x, 24, size, studio_paint(s, celspan_paint_rgb(1, 1, 1, 1)));
  celspan_cel_desc desc = CELSPAN_CEL_DESC;
  desc.defocus_radius = radius;
  desc.defocus_kernel = kernel;
  desc.opacity = opacity;
  celspan_cel *cel = studio_cel(s, desc, &disc, 1);
  return studio_rostrum(s, CELSPAN_ROSTRUM_DESC, &cel, 1);
}

/* The same cel is not filtered again, whatever its lights and opacity; a different one is. */
static void check_kept(void) {
  static studio s;
  view v = {200, 200, SIDE, SIDE, CELSPAN_ANTIALIAS_AREA};
  CHECK(celspan_context_create(NULL, &s.context) == CELSPAN_OK);
  const double places[] = {20, 20, 20, 21}, opacities[] = {1, 1, 0.5, 1};
  uint64_t made = 0;
  for (int k = 0; k < 4; k++) {
    image i = make(&s, defocused_disc(&s, places[k], 9, 5, CELSPAN_DEFOCUS_GAUSSIAN, opacities[k]),
                   &v, 1);
    cs_cache_counts counts = cs_defocus_bands_count(s.context);
    CHECK(counts.bytes > 0 && (k == 0 || k == 3 ? counts.made > made : counts.made == made));
    made = counts.made;
    free(i.rgba);
  }
  studio_finish(&s);
  celspan_context_destroy(s.context);
}

/* ---------------------------------------------------------------- blurred once */

#define PAN_SIDE 160

/* A cel of shapes, or of gradients too, moved and enlarged on the frame. */
static celspan_rostrum *moved(studio *s, bool has_ramps, double radius,
                              celspan_defocus_kernel kernel, celspan_matrix matrix) {
  celspan_object *objects[12];
  celspan_cel_desc desc = CELSPAN_CEL_DESC;
  random_state = 8;
  for (int i = 0; i < 12; i++)
    objects[i] = random_object(s, false, has_ramps);
  desc.defocus_radius = radius;
  desc.defocus_kernel = kernel;
  celspan_cel *cel = studio_cel(s, desc, objects, 12);
  studio_check(s, celspan_cel_transform(s->context, cel, &matrix, &s->cels[s->cel_count]));
  cel = s->cels[s->cel_count++];
  return studio_rostrum(s, CELSPAN_ROSTRUM_DESC, &cel, 1);
}

/* tilt: a perspective too small to be seen, for which a cel is blurred in each frame. */
static image make_moved(studio *s, bool has_ramps, double radius, celspan_defocus_kernel kernel,
                        double scale, double x, double tilt) {
  view v = {PAN_SIDE, PAN_SIDE, SIDE, SIDE, CELSPAN_ANTIALIAS_AREA};
  celspan_matrix matrix = celspan_matrix_then(celspan_matrix_scaling(scale, scale),
                                              celspan_matrix_translation(x, 0.31 * x));
  matrix.m[6] = tilt;
  return make(s, moved(s, has_ramps, radius, kernel, matrix), &v, 1);
}

/* Under a pan nothing is blurred again, and a frame has the bytes that it has alone, whatever was
 * made before it and whatever is kept. */
static void check_pans(void) {
  static studio s, alone;
  for (int k = 0; k < 4; k++) {
    if (!check_is_drawn(k))
      continue;
    double radius = k < 2 ? 2 : 9;
    bool is_kept = k % 2 == 0;
    celspan_context_desc desc = CELSPAN_CONTEXT_DESC;
    if (!is_kept)
      desc.defocus_bytes = 1;
    CHECK(celspan_context_create(&desc, &s.context) == CELSPAN_OK);
    uint64_t first = 0, second = 0;
    for (int frame = 0; frame < 3; frame++) {
      uint64_t before = cs_defocus_bands_count(s.context).made;
      image panned = make_moved(&s, k % 2, radius, CELSPAN_DEFOCUS_GAUSSIAN, 1, 0.27 * frame, 0);
      uint64_t made = cs_defocus_bands_count(s.context).made - before;
      CHECK(celspan_context_create(NULL, &alone.context) == CELSPAN_OK);
      image same = make_moved(&alone, k % 2, radius, CELSPAN_DEFOCUS_GAUSSIAN, 1, 0.27 * frame, 0);
      check_same(&panned, &same);
      *(frame == 0 ? &first : &second) += made;
      free(panned.rgba);
      free(same.rgba);
      studio_finish(&alone);
      celspan_context_destroy(alone.context);
    }
    CHECK(!is_kept || (first > 0 && second == 0));
    studio_finish(&s);
    celspan_context_destroy(s.context);
  }
}

static double code_of(float light) {
  double v = (double)light;
  return 255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * pow(v, 1 / 2.4) - 0.055);
}

/* Wherever a cel lies between pixels and between classes of scale, each frame is near the same cel
 * blurred for this frame: within 1.5 8-bit codes before they are rounded. Both are within 3/4. */
static void check_grids(void) {
  static const double radii[] = {1.3, 3, 8};
  static studio s;
  CHECK(celspan_context_create(NULL, &s.context) == CELSPAN_OK);
  for (int k = 0; k < 24; k++) {
    if (!check_is_drawn(k))
      continue;
    bool has_ramps = k % 12 >= 6;
    celspan_defocus_kernel kernel = k < 12 ? CELSPAN_DEFOCUS_GAUSSIAN : CELSPAN_DEFOCUS_DISC;
    double radius = radii[k % 3], x = 0.43 * k, worst = 0;
    image once = make_moved(&s, has_ramps, radius, kernel, 1 + 0.1 * x, x, 0);
    image again = make_moved(&s, has_ramps, radius, kernel, 1 + 0.1 * x, x, 1e-12);
    for (int32_t p = 0; p < PAN_SIDE * PAN_SIDE; p++)
      for (int c = 0; c < 4; c++)
        worst = fmax(worst, fabs(code_of(once.rgba[p][c]) - code_of(again.rgba[p][c])));
    if (!CHECK(worst < 1.5))
      fprintf(stderr, "  case %d: %.2f codes\n", k, worst);
    free(once.rgba);
    free(again.rgba);
    studio_finish(&s);
  }
  celspan_context_destroy(s.context);
}

/* The sum of light is preserved, areas that the kernel does not reach are one span and exact, and a
 * row has its pixels in one array at most, with radii from a tenth of a pixel up. */
static void check_light(void) {
  static const double radii[] = {0.1, 0.3, 0.45, 1, 1.9, 2.1, 4, 7};
  static studio s;
  view v = {SIDE, SIDE, SIDE, SIDE, CELSPAN_ANTIALIAS_AREA};
  CHECK(celspan_context_create(NULL, &s.context) == CELSPAN_OK);
  for (int k = 0; k < 24; k++) {
    if (!check_is_drawn(k))
      continue;
    double radius = radii[k / 3], sum = 0;
    image i =
        make(&s, defocused_disc(&s, 24.2, 9, radius, (celspan_defocus_kernel)(k % 3), 1), &v, 1);
    for (int32_t p = 0; p < SIDE * SIDE; p++)
      sum += (double)i.rgba[p][3];
    CHECK_NEAR(sum / (3.14159265358979 * 81), 1, 0.001);
    CHECK(radius > 3 || i.rgba[24 * SIDE + 24][0] == 1);
    bool fills_frame = k % 3 == CELSPAN_DEFOCUS_GAUSSIAN && 2 * (2 * radius + 9) > SIDE - 4;
    CHECK(i.kinds[CELSPAN_SPAN_ARRAY] <= SIDE);
    CHECK(fills_frame || i.kinds[CELSPAN_SPAN_SINGLE] > SIDE);
    free(i.rgba);
    studio_finish(&s);
  }
  celspan_context_destroy(s.context);
}

/* A small speck with a gradient keeps its light wherever it lies between samples, so that snow does
 * not twinkle. */
static void check_specks(void) {
  const celspan_stop stops[2] = {{0, celspan_paint_rgb(1, 1, 1, 1)},
                                 {1, celspan_paint_rgb(1, 1, 1, 0)}};
  static studio s;
  view v = {2 * SIDE, 2 * SIDE, SIDE, SIDE, CELSPAN_ANTIALIAS_AREA};
  CHECK(celspan_context_create(NULL, &s.context) == CELSPAN_OK);
  for (int k = 0; k < 12; k++) {
    if (!check_is_drawn(k))
      continue;
    celspan_cel_desc desc = CELSPAN_CEL_DESC;
    double x = 24 + 0.06 * k, sum = 0;
    desc.defocus_radius = 7;
    celspan_texture *fading = studio_radial(&s, (celspan_point){x, 24}, 0.8, stops, 2);
    celspan_object *speck = studio_circle(&s, x, 24, 0.8, fading);
    celspan_cel *cel = studio_cel(&s, desc, &speck, 1);
    image i = make(&s, studio_rostrum(&s, CELSPAN_ROSTRUM_DESC, &cel, 1), &v, 1);
    for (int32_t p = 0; p < v.width * v.height; p++)
      sum += (double)i.rgba[p][3] / 4;
    CHECK_NEAR(sum / (PI * 0.64 / 3), 1, 0.04);
    free(i.rgba);
    studio_finish(&s);
  }
  celspan_context_destroy(s.context);
}

/* Under the mode AREA the picture approaches the sharp one as the radius approaches 0. */
static void check_tiny(void) {
  static studio s;
  view v = {SIDE, SIDE, SIDE, SIDE, CELSPAN_ANTIALIAS_AREA};
  CHECK(celspan_context_create(NULL, &s.context) == CELSPAN_OK);
  for (int k = 0; k < 3; k++) {
    image sharp = make(&s, defocused_disc(&s, 24.2, 9, 0, CELSPAN_DEFOCUS_GAUSSIAN, 1), &v, 1);
    image defocused =
        make(&s, defocused_disc(&s, 24.2, 9, 0.03, (celspan_defocus_kernel)k, 1), &v, 1);
    for (int32_t p = 0; p < SIDE * SIDE; p++)
      CHECK_NEAR((double)sharp.rgba[p][0], (double)defocused.rgba[p][0], 0.02);
    free(sharp.rgba);
    free(defocused.rgba);
  }
  studio_finish(&s);
  celspan_context_destroy(s.context);
}

/* The integral over an edge's place of the share of a Gaussian left of the edge: in sigmas. */
static double gaussian_up_to(double place) {
  return 0.5 * place * (1 + erf(place / sqrt(2))) + exp(-0.5 * place * place) / sqrt(2 * PI);
}

/* The same for a box: in half widths. */
static double box_up_to(double place) {
  double low = fmin(fmax(place + 1, 0), 2); /* beyond the box all light is there */
  return 0.25 * low * low + fmax(place - 1, 0);
}

/* A kernel along one axis: its light left of an edge, and the integral of that over the edge's
 * place. */
typedef struct profile {
  double (*share)(double place), (*up_to)(double place);
  double unit; /* of places, pixels */
} profile;

static double gaussian_share(double place) { return 0.5 * (1 + erf(place / sqrt(2))); }

static double box_share(double place) { return 0.5 * fmin(fmax(place + 1, 0), 2); }

/* The light that a pixel receives from the right of an edge: at its centre, or on average over the
 * part of its width that antialiasing adds to the kernel, which is all of it if that is narrow. */
static double light_of_edge(const profile *p, double distance, double width) {
  double a = (distance - 0.5 * width) / p->unit, b = (distance + 0.5 * width) / p->unit;
  return width == 0 ? p->share(distance / p->unit) : (p->up_to(b) - p->up_to(a)) * p->unit / width;
}

typedef struct lens { /* how a bar is seen */
  celspan_defocus_kernel kernel;
  celspan_antialias_mode mode;
  double turn; /* of the camera, radians */
} lens;

/* A bar 8 pixels wide from `low` on, horizontal if it `lies`, else vertical, whatever the camera's
 * rotation. */
static image make_bar(studio *s, const lens *l, double radius, double low, bool lies) {
  const celspan_point middle = {0.5 * SIDE, 0.5 * SIDE};
  celspan_texture *white = studio_paint(s, celspan_paint_rgb(1, 1, 1, 1));
  celspan_object *bar =
      lies ? studio_rect(s, -100, low, 300, 8, white) : studio_rect(s, low, -100, 8, 300, white);
  bar = studio_transform(s, bar, celspan_matrix_rotation(l->turn, middle));
  celspan_cel_desc desc = CELSPAN_CEL_DESC;
  desc.defocus_radius = radius;
  desc.defocus_kernel = l->kernel;
  celspan_rostrum_desc camera = CELSPAN_ROSTRUM_DESC;
  camera.camera_radians = l->turn;
  celspan_cel *cel = studio_cel(s, desc, &bar, 1);
  view v = {SIDE, SIDE, SIDE, SIDE, l->mode};
  return make(s, studio_rostrum(s, camera, &cel, 1), &v, 1);
}

/* A bar through a kernel of any width, its edges anywhere in their pixels, against closed forms.
 * Antialiased boxes have one up to a radius of half a pixel, beyond which their light is smoothed;
 * with a rotated camera up to .4, because those boxes are kept upright. */
static void check_bars(lens l, double narrowest, int count) {
  static studio s;
  CHECK(celspan_context_create(NULL, &s.context) == CELSPAN_OK);
  for (int k = 0; k < 2 * count; k++) {
    if (!check_is_drawn(k))
      continue;
    double radius = narrowest * pow(1.21, k / 2 % 18), low = 16 + 0.17 * (k / 2);
    double width = l.mode == CELSPAN_ANTIALIAS_NONE ? 0 : 1;
    profile along = l.kernel == CELSPAN_DEFOCUS_BOX
                        ? (profile){box_share, box_up_to, radius}
                        : (profile){gaussian_share, gaussian_up_to, radius / 2};
    image i = make_bar(&s, &l, radius, low, k % 2);
    for (int32_t x = 0; x < SIDE; x++) {
      double d = x + 0.5 - low;
      CHECK_NEAR((double)i.rgba[k % 2 ? x * SIDE + 20 : 20 * SIDE + x][0],
                 light_of_edge(&along, d, width) - light_of_edge(&along, d - 8, width), 0.002);
    }
    free(i.rgba);
    studio_finish(&s);
  }
  celspan_context_destroy(s.context);
}

/* ---------------------------------------------------------------- memory */

/* Makes the frame with every allocation failing once: the status says so and nothing leaks. */
static void check_failures_of(studio *s, memory_watch *watch, celspan_rostrum *rostrum,
                              const celspan_filter_desc *kernel) {
  celspan_exposure exposure = {rostrum, 1};
  celspan_frame_desc desc = CELSPAN_FRAME_DESC;
  uint64_t expected[2], digest[2];
  desc.exposures = &exposure;
  desc.exposure_count = 1;
  desc.film_width = desc.film_height = SIDE;
  desc.width = desc.height = 20;
  desc.workers = 1;
  desc.has_antialias = kernel != NULL;
  desc.antialias = CELSPAN_ANTIALIAS_FILTER;
  desc.filter = kernel;
  studio_check(s, celspan_frame_digest(s->context, &desc, NULL, expected));
  size_t bytes = watch->bytes, failures = 0;
  for (celspan_status status = CELSPAN_NO_MEMORY; status != CELSPAN_OK; failures++) {
    watch->fail_at = watch->allocations + failures + 1;
    status = celspan_frame_digest(s->context, &desc, NULL, digest);
    watch->fail_at = 0;
    if (!CHECK(status == CELSPAN_OK || status == CELSPAN_NO_MEMORY) ||
        !CHECK(watch->bytes == bytes))
      break;
  }
  CHECK(digest[0] == expected[0] && digest[1] == expected[1]);
  CHECK(failures > 30 && watch->size_errors == 0);
}

/* All methods of defocusing a cel, and a kernel over a picture that varies. */
static void check_memory(void) {
  static const double radii[] = {12, 2, 110}; /* film units: 5, 0.8 and 46 pixels */
  memory_watch watch = {0};
  static studio s;
  celspan_context_desc desc = CELSPAN_CONTEXT_DESC;
  desc.resize = memory_watch_resize;
  desc.resize_user = &watch;
  desc.defocus_bytes = 1;
  CHECK(celspan_context_create(&desc, &s.context) == CELSPAN_OK);
  for (int k = 0; k < 18; k++) {
    if (!check_is_drawn(k))
      continue;
    random_state = 31 + (uint64_t)k;
    stage set =
        random_stage(&s, k / 9 ? 4 : k % 2, radii[k % 3], (celspan_defocus_kernel)(k / 3 % 3), 0);
    check_failures_of(&s, &watch, set.defocused, NULL);
    if (k % 6 == 0)
      check_failures_of(&s, &watch, set.blended, NULL);
    celspan_filter_desc kernel = {.struct_size = sizeof kernel,
                                  .rows = 16,
                                  .kernel = k / 9 ? CELSPAN_KERNEL_LANCZOS : CELSPAN_KERNEL_BOX};
    if (k % 9 == 0)
      check_failures_of(&s, &watch, set.sharp, &kernel);
    studio_finish(&s);
  }
  celspan_context_destroy(s.context);
  CHECK(watch.blocks == 0 && watch.bytes == 0);
}

int main(void) {
  check_orders();
  check_kept();
  check_pans();
  if (check_is_for_threads())
    return check_done();
  check_brute_force();
  check_memory();
  check_bars((lens){CELSPAN_DEFOCUS_GAUSSIAN, CELSPAN_ANTIALIAS_NONE, 0}, 0.7, 36);
  check_bars((lens){CELSPAN_DEFOCUS_GAUSSIAN, CELSPAN_ANTIALIAS_AREA, 0}, 0.05, 12);
  check_bars((lens){CELSPAN_DEFOCUS_BOX, CELSPAN_ANTIALIAS_AREA, 0}, 0.019, 36);
  check_bars((lens){CELSPAN_DEFOCUS_BOX, CELSPAN_ANTIALIAS_AREA, 0.5}, 0.06, 10);
  check_bars((lens){CELSPAN_DEFOCUS_BOX, CELSPAN_ANTIALIAS_NONE, 0}, 0.7, 18);
  check_grids();
  check_blended();
  check_light();
  check_specks();
  check_tiny();
  check_ramps(4, CELSPAN_ANTIALIAS_AREA);
  check_ramps(0.8, CELSPAN_ANTIALIAS_NONE);
  check_coarse();
  return check_done();
}
