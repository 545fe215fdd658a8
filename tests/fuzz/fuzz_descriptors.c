/* Any bytes as a program of calls of the C interface: structures with numbers of every kind, values
 * that enumerations do not have, counts that no array can have, values of other contexts, and sinks
 * whose functions are called in any order. No fault, no leak, every refusal with a sentence and
 * with a status that the header allows, and the frames of the scenes made are the same by rows and
 * as pixels.
 *
 * A count is the length of the array, 0 with or without an array, or so large that the array would
 * not fit the address space: these are refused before anything is read.
 *
 * One file, because every structure is filled in from the same bytes, with values made by other
 * calls.
 */
#include "tests/fuzz/target.h"

#include "celspan/trace.h"

#include "base/number.h"
#include "tests/fuzz/bytes.h"
#include "tests/fuzz/meter.h"

#define MOST_BYTES ((size_t)64 << 20)
#define MOST_CALLS 32
#define KEPT 16 /* values of a kind */
#define POINTS 12
#define SIDE 8 /* pixels */

typedef struct program {
  bytes_reader bytes;
  celspan_context *context;
  celspan_texture *textures[KEPT];
  celspan_surface *surfaces[KEPT];
  celspan_object *objects[KEPT];
  celspan_cel *cels[KEPT];
  celspan_rostrum *rostrums[KEPT];
} program;

/* ---------------------------------------------------------------- choices */

static int take(program *p, int count) { return bytes_take(&p->bytes) % count; }

static double number(program *p) { return bytes_number(&p->bytes); }

static float share(program *p) {
  int byte = bytes_take(&p->bytes);
  return byte == 255 ? (float)number(p) : (float)byte / 254;
}

static celspan_point point(program *p) { return (celspan_point){number(p), number(p)}; }

static celspan_box box(program *p) {
  return (celspan_box){number(p), number(p), number(p), number(p)};
}

static celspan_light light(program *p) {
  return (celspan_light){share(p), share(p), share(p), share(p)};
}

static celspan_paint paint(program *p) {
  return (celspan_paint){{share(p), share(p), share(p)}, {share(p), share(p), share(p)}, share(p)};
}

/* A value of an enumeration that has `count`, now and then an invalid one. */
static int word(program *p, int count) {
  int byte = bytes_take(&p->bytes);
  return byte == 255 ? -1 : byte == 254 ? 1 << 30 : byte == 253 ? count : byte % count;
}

static size_t count(program *p, size_t most, size_t size) {
  int byte = bytes_take(&p->bytes);
  return byte == 255 ? SIZE_MAX : byte == 254 ? PTRDIFF_MAX / size + 1 : (size_t)byte % (most + 1);
}

static celspan_matrix matrix(program *p) {
  celspan_matrix m = celspan_matrix_identity();
  int what = take(p, 4);
  for (int i = 0; i < 9 && what == 3; i++)
    m.m[i] = number(p);
  return what == 0   ? celspan_matrix_translation(number(p), number(p))
         : what == 1 ? celspan_matrix_rotation(number(p), point(p))
         : what == 2 ? celspan_matrix_scaling(number(p), number(p))
                     : m;
}

/* Keeps a new value in the slot that the bytes select. */
#define KEEP(p, list, value, unref)                                                                \
  do {                                                                                             \
    int at_ = take(p, KEPT);                                                                       \
    unref((p)->list[at_]);                                                                         \
    (p)->list[at_] = (value);                                                                      \
  } while (0)
#define ANY(p, list) ((p)->list[take(p, KEPT)])

static void demand_outcome(program *p, celspan_status status, const void *value) {
  demand((status == CELSPAN_OK) == (value != NULL), "an answer and its value disagree");
  demand(status == CELSPAN_OK || celspan_context_error(p->context)[0],
         "a refusal without a sentence");
  demand(status != CELSPAN_INTERNAL && status != CELSPAN_CANCELLED && status != CELSPAN_OUTPUT,
         "a refusal of another kind");
}

/* ---------------------------------------------------------------- surfaces and textures */

static const uint8_t pixels[4096];

static celspan_status fill(void *user, celspan_context *context, const celspan_rectangle *rectangle,
                           void *destination, size_t stride, int32_t *rows) {
  int what = (int)(intptr_t)user;
  for (int32_t y = 0; y < rectangle->height; y++)
    memset((char *)destination + (size_t)y * stride, what, (size_t)rectangle->width);
  *rows = what == 1 ? rectangle->height - 1 : what == 2 ? INT32_MAX : rectangle->height;
  return what == 3 ? celspan_context_fail(context, CELSPAN_CALLBACK, "no pixels today")
                   : CELSPAN_OK;
}

static void make_surface(program *p) {
  celspan_surface_desc desc = CELSPAN_SURFACE_DESC;
  celspan_surface *made = NULL;
  int size = take(p, 16);
  desc.width = size == 15 ? cs_number_to_int32(number(p)) : size;
  desc.height = take(p, 16);
  desc.format = (celspan_surface_format)word(p, 5);
  desc.alpha = (celspan_alpha)word(p, 3);
  if (take(p, 2) == 1) {
    desc.fill = fill;
    desc.user = (void *)(intptr_t)take(p, 5);
    desc.has_key = true;
    desc.key[0] = (uint64_t)take(p, 3);
  } else {
    desc.pixels = pixels;
    desc.stride = take(p, 3) == 2 ? 256 : 0;
    if (desc.width > 16)
      desc.width = 16; /* the array is as large as the header requires */
  }
  celspan_status status = celspan_surface_create(p->context, &desc, &made);
  demand_outcome(p, status, made);
  if (made)
    KEEP(p, surfaces, made, celspan_surface_unref);
}

static celspan_picture_desc picture(program *p) {
  celspan_picture_desc desc = {.struct_size = sizeof desc};
  desc.surface = ANY(p, surfaces);
  desc.colour = take(p, 4) == 3 ? "rec709" : NULL;
  desc.subimage = take(p, 16) == 15 ? cs_number_to_int32(number(p)) : 0;
  desc.sampling = (celspan_sampling)word(p, 4);
  desc.use = (celspan_picture_use)word(p, 2);
  desc.wrap = (celspan_wrap)word(p, 3);
  desc.has_box = take(p, 2);
  desc.box = box(p);
  desc.has_source = take(p, 4) == 3;
  if (desc.has_source)
    desc.source = box(p);
  return desc;
}

static celspan_status make_gradient(program *p, celspan_texture **out) {
  celspan_stop stops[POINTS];
  size_t stop_count = count(p, POINTS, sizeof *stops);
  for (size_t i = 0; i < POINTS && i < stop_count; i++)
    stops[i] = (celspan_stop){(double)i / POINTS + (double)share(p) / POINTS, paint(p)};
  const celspan_stop *list = stop_count == 0 ? NULL : stops;
  celspan_fitted_desc fitted = CELSPAN_FITTED_DESC;
  switch (take(p, 5)) {
  case 0:
    return celspan_texture_create_linear(p->context, point(p), point(p), list, stop_count, out);
  case 1:
    return celspan_texture_create_radial(p->context, point(p), number(p), list, stop_count, out);
  case 2:
    return celspan_texture_create_conic(p->context, point(p), number(p), list, stop_count, out);
  case 3:
    fitted.fit = (celspan_gradient_fit)word(p, CELSPAN_GRADIENT_ELLIPSE + 1);
    fitted.to_x = (int)take(p, 4) - 1;
    fitted.to_y = (int)take(p, 4) - 1;
    fitted.degrees = number(p);
    fitted.stops = list;
    fitted.stop_count = stop_count;
    return celspan_texture_create_fitted(p->context, &fitted, out);
  default:
    return celspan_texture_create_focal(p->context, point(p), number(p), point(p), list, stop_count,
                                        out);
  }
}

static celspan_status make_noise(program *p, celspan_texture **out) {
  celspan_stop stops[POINTS];
  celspan_noise_desc desc = {.struct_size = sizeof desc};
  desc.stop_count = count(p, POINTS, sizeof *stops);
  for (size_t i = 0; i < POINTS && i < desc.stop_count; i++)
    stops[i] = (celspan_stop){(double)i / POINTS + (double)share(p) / POINTS, paint(p)};
  desc.stops = stops;
  desc.kind = (celspan_noise_kind)word(p, CELSPAN_NOISE_WHITE + 1);
  desc.octaves = (int)take(p, 18);
  desc.size = number(p);
  desc.gain = (double)share(p);
  desc.at = number(p);
  desc.seed = cs_number_to_int32(number(p));
  desc.fades = take(p, 2);
  return celspan_texture_create_noise(p->context, &desc, out);
}

static celspan_status change_texture(program *p, celspan_texture **out) {
  celspan_texture *texture = ANY(p, textures);
  celspan_matrix m = matrix(p);
  switch (take(p, 3)) {
  case 0:
    return celspan_texture_with_spread(p->context, texture, (celspan_spread)word(p, 3), out);
  case 1:
    return celspan_texture_with_matrix(p->context, texture, &m, out);
  default:
    return celspan_texture_named(p->context, texture, take(p, 2) ? "a\nb" : "name", out);
  }
}

static void make_texture(program *p) {
  celspan_texture *made = NULL;
  celspan_status status;
  const celspan_paint paints[3] = {paint(p), paint(p), paint(p)};
  const celspan_point points[3] = {point(p), point(p), point(p)};
  celspan_picture_desc desc;
  switch (take(p, 6)) {
  case 0:
    status = celspan_texture_create_paint(p->context, paints, &made);
    break;
  case 1:
    status = celspan_texture_create_gradient(p->context, points, paints, &made);
    break;
  case 2:
    status = make_gradient(p, &made);
    break;
  case 3:
    desc = picture(p);
    status = celspan_texture_create_picture(p->context, &desc, &made);
    break;
  case 4:
    status = make_noise(p, &made);
    break;
  default:
    status = change_texture(p, &made);
    break;
  }
  demand_outcome(p, status, made);
  if (made)
    KEEP(p, textures, made, celspan_texture_unref);
}

/* ---------------------------------------------------------------- objects */

typedef struct arrays {
  celspan_point points[POINTS];
  double numbers[2 * POINTS];
} arrays;

static void fill_arrays(program *p, arrays *a) {
  for (int i = 0; i < POINTS; i++)
    a->points[i] = point(p);
  for (int i = 0; i < 2 * POINTS; i++)
    a->numbers[i] = fabs(number(p));
}

static celspan_status make_curve(program *p, celspan_object **out) {
  arrays a;
  fill_arrays(p, &a);
  celspan_nurbs_desc desc = {
      .struct_size = sizeof desc,
      .points = a.points,
      .weights = take(p, 2) ? a.numbers : NULL,
      .point_count = count(p, POINTS, sizeof *a.points),
      .degree = take(p, 20) - 2,
      .knots = take(p, 4) == 3 ? a.numbers : NULL,
      .knot_count = count(p, 2 * POINTS, sizeof *a.numbers),
      .closure = (celspan_nurbs_closure)word(p, 2),
      .rule = (celspan_rule)word(p, 2),
      .texture = ANY(p, textures),
  };
  return celspan_object_create_nurbs(p->context, &desc, out);
}

static celspan_stroke_desc stroke(program *p, const arrays *a) {
  celspan_stroke_desc desc = CELSPAN_STROKE_DESC;
  desc.points = take(p, 2) ? a->points : NULL;
  desc.widths = take(p, 2) ? a->numbers : NULL;
  desc.point_count = count(p, POINTS, sizeof *a->points);
  desc.degree = take(p, 20) - 2;
  desc.closed = take(p, 2);
  desc.data = take(p, 4) == 3 ? "M1 1L5 6C7 7 1 2 3 4z" : NULL;
  desc.outline = take(p, 4) == 3 ? ANY(p, objects) : NULL;
  desc.width = number(p);
  desc.cap = (celspan_stroke_cap)word(p, 3);
  desc.join = (celspan_stroke_join)word(p, 3);
  desc.miter = number(p);
  desc.dashes = take(p, 3) == 2 ? a->numbers : NULL;
  desc.dash_count = desc.dashes ? count(p, 2 * POINTS, sizeof *a->numbers) : 0;
  desc.from = number(p) / 10;
  desc.texture = ANY(p, textures);
  return desc;
}

static celspan_status make_stroke(program *p, celspan_object **out) {
  arrays a;
  fill_arrays(p, &a);
  celspan_stroke_desc desc = stroke(p, &a);
  celspan_object *object = ANY(p, objects);
  return take(p, 2) ? celspan_object_create_stroke(p->context, &desc, out)
                    : celspan_object_stroke(p->context, object, &desc, out);
}

static celspan_status make_shape(program *p, celspan_object **out) {
  const celspan_rect_desc rect = {sizeof rect, number(p), number(p),       number(p),
                                  number(p),   number(p), ANY(p, textures)};
  const celspan_triangle_desc triangle = {
      sizeof triangle, {point(p), point(p), point(p)}, ANY(p, textures)};
  const celspan_ellipse_desc ellipse = {sizeof ellipse, point(p), number(p), number(p),
                                        ANY(p, textures)};
  switch (take(p, 3)) {
  case 0:
    return celspan_object_create_rect(p->context, &rect, out);
  case 1:
    return celspan_object_create_triangle(p->context, &triangle, out);
  default:
    return celspan_object_create_ellipse(p->context, &ellipse, out);
  }
}

static celspan_status make_polygon(program *p, celspan_object **out) {
  arrays a;
  fill_arrays(p, &a);
  const celspan_polygon_desc desc = {sizeof desc, a.points, count(p, POINTS, sizeof *a.points),
                                     (celspan_rule)word(p, 2), ANY(p, textures)};
  return celspan_object_create_polygon(p->context, &desc, out);
}

static celspan_status make_image(program *p, celspan_object **out) {
  const celspan_picture_desc shown = picture(p);
  const celspan_image_desc desc = {
      sizeof desc, &shown, number(p), number(p), number(p), number(p), (celspan_fit)word(p, 3)};
  return celspan_object_create_image(p->context, &desc, out);
}

static celspan_status emit(void *user, celspan_context *context, double y,
                           const celspan_scanline_row *row, celspan_scanline_output *output) {
  const celspan_paint paints[3] = {celspan_paint_rgb(1, 0, 0, 1), celspan_paint_clear(),
                                   *(celspan_paint *)user};
  if (y > 6)
    return celspan_context_fail(context, CELSPAN_CALLBACK, "no row today");
  if (celspan_scanline_emit(output, row->x0, row->x1 - y, paints, (size_t)fabs(y) % 4) !=
      CELSPAN_OK)
    return CELSPAN_CALLBACK;
  return celspan_scanline_emit(output, row->x0, row->x0 + row->pixel, paints, 1);
}

static celspan_status make_procedure(program *p, celspan_object **out) {
  celspan_paint *user = malloc(sizeof *user);
  *user = paint(p);
  const celspan_scanline_desc desc = {sizeof desc, box(p), emit, user, free, take(p, 2)};
  celspan_status status = celspan_object_create_scanline(p->context, &desc, out);
  if (status != CELSPAN_OK)
    free(user);
  return status;
}

static celspan_status combine(program *p, celspan_object **out) {
  celspan_object *operands[POINTS], *first = ANY(p, objects);
  for (int i = 0; i < POINTS; i++)
    operands[i] = ANY(p, objects);
  size_t operand_count = count(p, POINTS, sizeof *operands);
  celspan_operator op = (celspan_operator)word(p, 5);
  return take(p, 2)
             ? celspan_object_create_boolean(p->context, op, operands, operand_count, out)
             : celspan_object_extend_boolean(p->context, first, operands, operand_count, out);
}

static celspan_status change_object(program *p, celspan_object **out) {
  celspan_object *object = ANY(p, objects);
  celspan_matrix m = matrix(p);
  switch (take(p, 4)) {
  case 0:
    return celspan_object_transform(p->context, object, &m, out);
  case 1:
    return celspan_object_fade(p->context, object, (double)share(p), out);
  case 2:
    return celspan_object_named(p->context, object, take(p, 2) ? "\xff" : "hand", out);
  default:
    return celspan_object_create_rostrum(p->context, ANY(p, rostrums), out);
  }
}

static void ask_object(program *p, const celspan_object *object) {
  celspan_box around;
  uint64_t drawing[2], placement[2];
  if (celspan_object_bounds(object, &around))
    demand(isfinite(around.x + around.y + around.width + around.height),
           "bounds that are not finite");
  (void)celspan_object_contains(object, point(p));
  (void)celspan_object_hash(object, drawing, placement);
}

static void make_object(program *p) {
  static celspan_status (*const makers[])(program *, celspan_object **) = {
      make_shape, make_polygon,   make_curve, make_stroke,
      make_image, make_procedure, combine,    change_object};
  celspan_object *made = NULL;
  celspan_status status = makers[take(p, 8)](p, &made);
  demand_outcome(p, status, made);
  if (!made)
    return;
  ask_object(p, made);
  KEEP(p, objects, made, celspan_object_unref);
}

/* ---------------------------------------------------------------- cels and rostrums */

static celspan_light_texture light_texture(program *p) {
  bool has_one = take(p, 4) == 3;
  return (celspan_light_texture){has_one ? ANY(p, textures) : NULL, (double)share(p),
                                 (celspan_light_place)word(p, 2), (double)share(p)};
}

static celspan_status make_one_cel(program *p, celspan_cel **out) {
  celspan_object *objects[4] = {ANY(p, objects), ANY(p, objects), ANY(p, objects), ANY(p, objects)};
  celspan_cel_desc desc = CELSPAN_CEL_DESC;
  desc.objects = objects;
  desc.object_count = count(p, 4, sizeof *objects);
  desc.has_front = take(p, 2);
  desc.front = light(p);
  desc.back = light(p);
  desc.has_viewport = take(p, 4) == 3;
  desc.viewport = box(p);
  desc.defocus_radius = take(p, 4) == 3 ? number(p) : 0;
  desc.defocus_kernel = (celspan_defocus_kernel)word(p, 3);
  desc.opacity = (double)share(p);
  desc.front_texture = light_texture(p);
  desc.back_texture = light_texture(p);
  return celspan_cel_create(p->context, &desc, out);
}

static void make_cel(program *p) {
  celspan_cel *made = NULL, *cel = ANY(p, cels);
  celspan_matrix m = matrix(p);
  celspan_status status;
  switch (take(p, 4)) {
  case 0:
    status = celspan_cel_transform(p->context, cel, &m, &made);
    break;
  case 1:
    status = celspan_cel_fade(p->context, cel, number(p), &made);
    break;
  default:
    status = make_one_cel(p, &made);
    break;
  }
  demand_outcome(p, status, made);
  if (made)
    KEEP(p, cels, made, celspan_cel_unref);
}

static celspan_status kernel(void *user, celspan_context *context, double x, double *out) {
  (void)context;
  *out = user ? 1 - fabs(x) : (double)NAN;
  return CELSPAN_OK;
}

static celspan_filter_desc filter(program *p) {
  return (celspan_filter_desc){sizeof(celspan_filter_desc),
                               (celspan_kernel)word(p, 5),
                               take(p, 2),
                               fabs(number(p)),
                               take(p, 40) - 1,
                               take(p, 2) ? kernel : NULL,
                               take(p, 2) ? p : NULL};
}

static void make_rostrum(program *p) {
  celspan_cel *cels[4] = {ANY(p, cels), ANY(p, cels), ANY(p, cels), ANY(p, cels)};
  celspan_rostrum_desc desc = CELSPAN_ROSTRUM_DESC;
  celspan_rostrum *made = NULL;
  desc.cels = cels;
  desc.cel_count = count(p, 4, sizeof *cels);
  desc.has_front = take(p, 2);
  desc.front = light(p);
  desc.back = light(p);
  desc.brightness = (double)share(p);
  desc.has_camera_centre = take(p, 4) == 3;
  desc.camera_centre = point(p);
  desc.has_camera_width = take(p, 4) == 3;
  desc.camera_width = number(p);
  desc.camera_radians = take(p, 4) == 3 ? number(p) : 0;
  desc.antialias = (celspan_antialias_mode)word(p, 3);
  const celspan_filter_desc kernel_of = filter(p);
  desc.filter = &kernel_of;
  desc.front_texture = light_texture(p);
  desc.back_texture = light_texture(p);
  desc.has_size = take(p, 2);
  desc.width = desc.height = fabs(number(p));
  celspan_status status = celspan_rostrum_create(p->context, &desc, &made);
  demand_outcome(p, status, made);
  if (!made)
    return;
  celspan_rostrum_counts counts;
  uint64_t hash[2];
  celspan_rostrum_count(made, &counts);
  celspan_rostrum_hash(made, hash);
  (void)!celspan_rostrum_check(p->context, made);
  KEEP(p, rostrums, made, celspan_rostrum_unref);
}

/* ---------------------------------------------------------------- frames */

static bool is_outcome(celspan_status status) {
  return status == CELSPAN_OK || status == CELSPAN_BAD_ARGUMENT || status == CELSPAN_LIMIT ||
         status == CELSPAN_NO_MEMORY || status == CELSPAN_CALLBACK || status == CELSPAN_INPUT;
}

typedef struct frame {
  celspan_frame_desc desc;
  celspan_exposure exposures[2];
  celspan_antialias_mode antialias;
  celspan_filter_desc filter;
} frame;

static void describe_frame(program *p, frame *f) {
  f->desc = CELSPAN_FRAME_DESC;
  f->exposures[0] = (celspan_exposure){ANY(p, rostrums), (double)share(p)};
  f->exposures[1] = (celspan_exposure){ANY(p, rostrums), (double)share(p)};
  f->desc.exposures = f->exposures;
  f->desc.exposure_count = count(p, 2, sizeof *f->exposures);
  f->desc.film_width = f->desc.film_height = take(p, 3) == 2 ? number(p) : 0;
  f->desc.width = f->desc.height = SIDE;
  if (take(p, 4) == 3) {
    f->desc.crop_x = take(p, SIDE + 2) - 1;
    f->desc.crop_width = f->desc.crop_height = take(p, SIDE + 2) - 1;
  }
  f->antialias = (celspan_antialias_mode)word(p, 3);
  f->desc.antialias = f->antialias;
  f->desc.has_antialias = take(p, 2);
  f->filter = filter(p);
  f->desc.filter = &f->filter;
  f->desc.workers = 1;
}

static int32_t width_of(const celspan_frame_desc *desc) {
  return desc->crop_width ? desc->crop_width : desc->width;
}

/* The same frame by rows, from the last to the first. */
static void compare_rows(program *p, const celspan_frame_desc *desc, float (*wanted)[4]) {
  const celspan_coding coding = {.struct_size = sizeof coding, .depth = CELSPAN_DEPTH_FLOAT};
  celspan_rows *rows = NULL;
  int32_t width = width_of(desc), height = desc->crop_height ? desc->crop_height : desc->height;
  float got[SIDE][4];
  celspan_status status = celspan_rows_create(p->context, desc, &rows);
  demand(status == CELSPAN_OK || status == CELSPAN_NO_MEMORY,
         "rows are refused where pixels are not");
  for (int32_t y = height; y-- > 0 && status == CELSPAN_OK;) {
    const celspan_span *spans;
    size_t span_count;
    status = celspan_rows_get(rows, y, &spans, &span_count);
    if (status != CELSPAN_OK)
      break;
    celspan_spans_code(&coding, spans, span_count, got);
    demand(memcmp(got, wanted[y * width], (size_t)width * sizeof *got) == 0,
           "a row differs from the pixels");
  }
  const celspan_span *spans;
  size_t span_count;
  if (status == CELSPAN_OK)
    demand(celspan_rows_get(rows, height, &spans, &span_count) == CELSPAN_BAD_ARGUMENT,
           "a row beyond the last");
  celspan_rows_destroy(rows);
}

static void render(program *p) {
  float made[SIDE * SIDE][4];
  const celspan_coding coding = {.struct_size = sizeof coding, .depth = CELSPAN_DEPTH_FLOAT};
  double rgba[4];
  frame f;
  describe_frame(p, &f);
  celspan_status status = celspan_frame_pixels(
      p->context, &f.desc, &coding, made,
      sizeof *made * (size_t)(width_of(&f.desc) > 0 ? width_of(&f.desc) : 1), NULL);
  demand(is_outcome(status), "a frame fails in another way");
  demand(status == CELSPAN_OK || celspan_context_error(p->context)[0],
         "a failure without a sentence");
  if (status == CELSPAN_OK)
    compare_rows(p, &f.desc, made);
  (void)celspan_frame_is_opaque(&f.desc);
  status = celspan_probe(p->context, &f.desc, point(p), rgba);
  demand(is_outcome(status), "a probe fails in another way");
}

/* A file's sink, its functions called in any order, with rows of any kind; its end comes last. */
static void misuse_sink(program *p) {
  static const char *const paths[] = {"/dev/null/no.png", "/dev/shm/celspan-fuzz.png",
                                      "/dev/shm/celspan-fuzz.tga", "/dev/shm/celspan-fuzz.span"};
  const float array[4 * SIDE] = {0};
  celspan_sink sink = CELSPAN_SINK;
  celspan_file_desc file = CELSPAN_FILE_DESC;
  celspan_coding coded = CELSPAN_CODING;
  file.coding = &coded;
  file.workers = 1;
  coded.depth = (celspan_depth)word(p, 6);
  coded.transfer = (celspan_transfer)word(p, 5);
  coded.alpha = (celspan_alpha)word(p, 3);
  coded.space = (celspan_space)word(p, 3);
  if (celspan_file_sink_create(p->context, paths[take(p, 4)], take(p, 4) ? &file : NULL, &sink) !=
      CELSPAN_OK)
    return;
  for (int calls = take(p, 12); calls > 0; calls--) {
    celspan_span spans[2] = {
        {.x1 = take(p, SIDE + 1), .kind = (celspan_span_kind)take(p, 3), .array = array},
        {.x0 = take(p, SIDE + 1), .x1 = take(p, SIDE + 1), .kind = CELSPAN_SPAN_SINGLE}};
    int32_t y = take(p, SIDE + 2) - 1;
    if (take(p, 4) == 0)
      (void)!sink.begin(sink.user, p->context, take(p, SIDE + 2) - 1, take(p, SIDE + 2) - 1);
    else
      (void)!sink.row(sink.user, p->context, y, spans, (size_t)take(p, 3));
  }
  (void)!sink.end(sink.user, p->context, take(p, 4) ? CELSPAN_OK : CELSPAN_CANCELLED);
}

static void trace(program *p) {
  celspan_trace_desc desc = CELSPAN_TRACE_DESC;
  celspan_trace *made = NULL;
  const celspan_picture_desc shown = picture(p);
  desc.picture = &shown;
  desc.colours = take(p, 70) - 1;
  desc.smooth = number(p);
  desc.speckle = take(p, 5) - 1;
  desc.lines = take(p, 2);
  celspan_status status = celspan_trace_create(p->context, &desc, &made);
  demand_outcome(p, status, made);
  celspan_trace_unref(made);
}

/* ---------------------------------------------------------------- a program */

static void run(program *p) {
  static void (*const calls[])(program *) = {make_surface, make_texture, make_object, make_object,
                                             make_cel,     make_rostrum, render,      render,
                                             misuse_sink,  trace};
  for (int i = 0; i < MOST_CALLS && p->bytes.size > 0; i++)
    calls[take(p, 10)](p);
}

static void drop(program *p) {
  for (int i = 0; i < KEPT; i++) {
    celspan_rostrum_unref(p->rostrums[i]);
    celspan_cel_unref(p->cels[i]);
    celspan_object_unref(p->objects[i]);
    celspan_texture_unref(p->textures[i]);
    celspan_surface_unref(p->surfaces[i]);
  }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  meter m = {.limit = MOST_BYTES};
  program p = {.bytes = {data, size}, .context = meter_context(&m)};
  demand(p.context, "no context");
  run(&p);
  drop(&p);
  celspan_context_destroy(p.context);
  meter_close(&m);
  return 0;
}

#ifdef REPLAY_MAIN
#include "tests/fuzz/replay.h"
#endif
