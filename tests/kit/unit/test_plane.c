/* Planes: drawn at any size as the frame of that size is rendered, as a point is probed, and as
 * what is read of their files; what they cannot keep is refused. One file, because all tests
 * compare the same scenes.
 */
#include <math.h>

#include "celspan/plane.h"
#include "tests/support/frame_rows.h"
#include "tests/support/memory.h"
#include "tests/support/random.h"
#include "writers/plane/plane.h"

#define WIDTH 90
#define HEIGHT 60

/* ---------------------------------------------------------------- scenes */

static celspan_paint random_paint(test_random *random) {
  float red = random_unit(random), green = random_unit(random), blue = random_unit(random);
  float alpha = random_below(random, 2) ? 1 : random_unit(random);
  return celspan_paint_rgb(red, green, blue, alpha);
}

/* Whether scenes have gradients, and pictures. */
typedef enum variety { FLAT, VARIED, PICTURED } variety;

static celspan_texture *random_gradient(studio *s, test_random *random) {
  celspan_stop stops[4];
  celspan_point from = random_point(random, -20, WIDTH + 20, -20, HEIGHT + 20);
  celspan_point to = random_point(random, -20, WIDTH + 20, -20, HEIGHT + 20);
  size_t count = 2 + (size_t)random_below(random, 3);
  for (size_t i = 0; i < count; i++) {
    celspan_paint paint = random_paint(random);
    stops[i] = (celspan_stop){(double)i / (double)(count - 1), paint};
  }
  if (random_below(random, 3) == 0) {
    const celspan_paint corners[3] = {stops[0].paint, stops[1].paint, random_paint(random)};
    const celspan_point points[3] = {from, to, random_point(random, 0, WIDTH, 0, HEIGHT)};
    return studio_gradient(s, points, corners);
  }
  if (random_below(random, 2))
    return studio_linear(s, from, to, stops, count);
  celspan_point focus = {from.x + 5, from.y - 8};
  double radius = random_between(random, 30, 80);
  return studio_focal(s, from, radius, focus, stops, count);
}

/* The pixels of a surface of a format, which are the floats or integers of a wave. */
static void fill_surface(test_random *random, celspan_surface_desc *desc, unsigned char *out) {
  double across = random_between(random, 0.05, 0.3), down = random_between(random, 0.05, 0.3);
  bool is_opaque = random_below(random, 2);
  for (int32_t i = 0; i < desc->width * desc->height; i++)
    for (int c = 0; c < 4; c++) {
      double at = across * (i % desc->width) + down * (double)(i / desc->width) + c;
      double value = c == 3 && is_opaque ? 1 : 0.5 + 0.4 * sin(at);
      if (desc->format == CELSPAN_SURFACE_RGBAF)
        ((float *)(void *)out)[4 * i + c] = (float)value * (c == 0 ? 1.5f : 1);
      else if (desc->format == CELSPAN_SURFACE_RGBA16)
        ((uint16_t *)(void *)out)[4 * i + c] = (uint16_t)(value * 65535);
      else
        out[4 * i + c] = (unsigned char)(value * 255 + 0.5);
    }
}

static celspan_texture *random_picture(studio *s, test_random *random) {
  static const celspan_surface_format formats[3] = {CELSPAN_SURFACE_RGBA8, CELSPAN_SURFACE_RGBA16,
                                                    CELSPAN_SURFACE_RGBAF};
  celspan_surface_desc surface = CELSPAN_SURFACE_DESC;
  surface.width = 1 + (int32_t)random_below(random, 400);
  surface.height = 1 + (int32_t)random_below(random, 300);
  surface.format = formats[random_below(random, 3)];
  unsigned char *pixels = calloc((size_t)surface.width * (size_t)surface.height, 16);
  fill_surface(random, &surface, pixels);
  surface.pixels = pixels;
  celspan_picture_desc desc = {.struct_size = sizeof desc,
                               .sampling = (celspan_sampling)random_below(random, 4)};
  desc.wrap = (celspan_wrap)random_below(random, 3);
  studio_check(s, celspan_surface_create(s->context, &surface, &desc.surface));
  free(pixels);
  desc.has_box = random_below(random, 2);
  celspan_point corner = random_point(random, -20, 60, -20, 40);
  celspan_point size = random_point(random, 5, 90, 5, 60);
  desc.box = (celspan_box){corner.x, corner.y, size.x, size.y};
  celspan_texture *texture = NULL;
  studio_check(s, celspan_texture_create_picture(s->context, &desc, &texture));
  celspan_surface_unref(desc.surface);
  s->textures[s->texture_count++] = texture;
  return texture;
}

static celspan_texture *random_texture(studio *s, test_random *random, variety kind) {
  if (kind == FLAT || random_below(random, 2))
    return studio_paint(s, random_paint(random));
  return kind == PICTURED && random_below(random, 2) ? random_picture(s, random)
                                                     : random_gradient(s, random);
}

/* Of the second and the third degree. */
static celspan_object *curved_path(studio *s, const celspan_point points[5],
                                   celspan_texture *texture) {
  char data[300];
  const celspan_point *p = points;
  snprintf(data, sizeof data, "M%.3f %.3fC%.3f %.3f %.3f %.3f %.3f %.3fQ%.3f %.3f %.3f %.3fZ",
           p[0].x, p[0].y, p[1].x, p[1].y, p[2].x, p[2].y, p[3].x, p[3].y, p[4].x, p[4].y, p[0].x,
           p[0].y);
  return studio_path(s, data, texture);
}

static celspan_object *random_object(studio *s, test_random *random, variety kind) {
  celspan_texture *texture = random_texture(s, random, kind);
  celspan_point corners[5];
  for (int k = 0; k < 5; k++)
    corners[k] = random_point(random, -10, WIDTH + 10, -10, HEIGHT + 10);
  double width = random_between(random, 1, 50), height = random_between(random, 1, 50);
  int shape = (int)random_below(random, 6);
  if (shape > 3)
    return curved_path(s, corners, texture);
  if (shape < 2)
    return studio_circle(s, corners[0].x, corners[0].y, width, texture);
  if (shape == 2)
    return studio_rect(s, corners[0].x, corners[0].y, width, height, texture);
  return studio_polygon(s, corners, 3, CELSPAN_RULE_NONZERO, texture);
}

/* The objects as one that may be faded, and, without pictures, be composited in sRGB. */
static celspan_object *random_group(studio *s, test_random *random, variety kind,
                                    celspan_object **objects, size_t count) {
  celspan_group_desc desc = CELSPAN_GROUP_DESC;
  desc.objects = objects;
  desc.object_count = count;
  desc.opacity = random_below(random, 2) ? 1 : random_unit(random);
  if (kind == VARIED && random_below(random, 2))
    desc.space = CELSPAN_SPACE_SRGB;
  return studio_group(s, &desc);
}

static celspan_cel *placed(studio *s, celspan_cel *cel, const celspan_matrix *matrix) {
  celspan_cel *out = NULL;
  studio_check(s, celspan_cel_transform(s->context, cel, matrix, &out));
  s->cels[s->cel_count++] = out;
  return out;
}

/* Turned a little, and in one of two cases in perspective. */
static celspan_cel *random_place(studio *s, test_random *random, celspan_cel *cel) {
  celspan_point turn = random_point(random, -0.3, 0.3, -0.3, 0.3);
  celspan_point bend = random_point(random, -0.004, 0.004, -0.004, 0.004);
  celspan_matrix matrix = {{1, turn.x, 3, turn.y, 1, -2, 0, 0, 1}};
  if (random_below(random, 2)) {
    matrix.m[6] = bend.x;
    matrix.m[7] = bend.y;
  }
  return placed(s, cel, &matrix);
}

/* A cel of a few shapes, one of which is cut out of others. */
static celspan_cel *random_cel(studio *s, test_random *random, variety kind) {
  celspan_object *objects[5];
  celspan_cel_desc desc = CELSPAN_CEL_DESC;
  size_t count = 1 + (size_t)random_below(random, 5);
  bool is_blurred = kind == PICTURED && random_below(random, 4) == 0;
  kind = is_blurred ? FLAT : kind;
  for (size_t i = 0; i < count; i++)
    objects[i] = random_object(s, random, kind);
  celspan_object *other = random_object(s, random, kind);
  objects[0] = studio_pair(s, CELSPAN_OPERATOR_DIFFERENCE, objects[0], other);
  desc.opacity = random_below(random, 3) ? 1 : random_unit(random);
  desc.back = random_below(random, 3) ? desc.back : (celspan_light){0.25f, 0.5f, 0, 0.5f};
  if (kind != FLAT && random_below(random, 2)) {
    desc.has_front = true;
    desc.front = (celspan_light){1.5f, 0.75f, 0.5f, 1};
    objects[0] = random_group(s, random, kind, objects, count);
    count = 1;
  }
  if (is_blurred)
    desc.defocus_radius = random_between(random, 4, 9);
  celspan_cel *cel = studio_cel(s, desc, objects, count);
  return kind != FLAT && random_below(random, 3) == 0 ? random_place(s, random, cel) : cel;
}

static celspan_rostrum *random_rostrum(studio *s, uint64_t seed, variety kind) {
  test_random random = {seed};
  celspan_cel *cels[3];
  celspan_rostrum_desc desc = CELSPAN_ROSTRUM_DESC;
  size_t count = 1 + (size_t)random_below(&random, 3);
  for (size_t i = 0; i < count; i++)
    cels[i] = random_cel(s, &random, kind);
  if (random_below(&random, 2))
    desc.back = (celspan_light){1, 0.75f, 0.5f, 1};
  return studio_rostrum(s, desc, cels, count);
}

static celspan_plane_desc desc_of(int32_t depth) {
  celspan_plane_desc desc = CELSPAN_PLANE_DESC;
  desc.width = WIDTH;
  desc.height = HEIGHT;
  desc.depth = depth;
  return desc;
}

static celspan_plane *make_plane(studio *s, const celspan_rostrum *rostrum) {
  const celspan_plane_desc desc = desc_of(16);
  celspan_plane *plane = NULL;
  studio_check(s, celspan_plane_create(s->context, rostrum, &desc, &plane));
  return plane;
}

/* The floats of a view; the caller frees them. */
static float (*draw(studio *s, const celspan_plane *plane, celspan_plane_view view))[4] {
  const celspan_coding coding = {.struct_size = sizeof coding,
                                 .depth = CELSPAN_DEPTH_FLOAT,
                                 .transfer = CELSPAN_TRANSFER_LINEAR,
                                 .alpha = CELSPAN_ALPHA_PREMULTIPLIED};
  int32_t width = view.crop_width ? view.crop_width : view.width;
  int32_t height = view.crop_height ? view.crop_height : view.height;
  float(*out)[4] = calloc((size_t)width * (size_t)height, sizeof *out);
  studio_check(
      s, celspan_plane_pixels(s->context, plane, &view, &coding, out, (size_t)width * sizeof *out));
  return out;
}

static celspan_plane_view view_of(int32_t width, int32_t height) {
  celspan_plane_view view = CELSPAN_PLANE_VIEW;
  view.width = width;
  view.height = height;
  return view;
}

/* ---------------------------------------------------------------- as frames are */

/* The most that a channel differs, and in how many of them by more than a code in 255. */
typedef struct comparison {
  float most;
  size_t off, all;
} comparison;

static comparison compare(float (*a)[4], float (*b)[4], size_t pixels) {
  comparison out = {0, 0, 4 * pixels};
  for (size_t i = 0; i < pixels; i++)
    for (int c = 0; c < 4; c++) {
      float difference = fabsf(a[i][c] - b[i][c]);
      out.most = fmaxf(out.most, difference);
      out.off += difference > 1 / 255.0f;
    }
  return out;
}

static void check_size(studio *s, const celspan_plane *plane, const celspan_exposure *exposure,
                       int32_t scale) {
  celspan_frame_desc desc = studio_frame(exposure, 1, scale * WIDTH, scale * HEIGHT, NULL);
  celspan_plane_view view = view_of(scale * WIDTH, scale * HEIGHT);
  desc.film_width = WIDTH;
  desc.film_height = HEIGHT;
  if (scale > 4) { /* too many pixels: a part of them */
    desc.crop_x = view.crop_x = 17 * scale;
    desc.crop_y = view.crop_y = 11 * scale;
    desc.crop_width = view.crop_width = 200;
    desc.crop_height = view.crop_height = 150;
  }
  image rendered = make_image(s, &desc, 1);
  float(*drawn)[4] = draw(s, plane, view);
  comparison c = compare(drawn, rendered.rgba, (size_t)rendered.width * (size_t)rendered.height);
  if (!CHECK(c.most <= 4 / 255.0f && c.off * 500 <= c.all))
    fprintf(stderr, "  at %d: %g, %zu of %zu\n", (int)scale, (double)c.most, c.off, c.all);
  free(rendered.rgba);
  free(drawn);
}

static void check_frames(studio *s, variety kind) {
  for (uint64_t seed = 0; seed < 12; seed++) {
    celspan_exposure exposure = {random_rostrum(s, seed, kind), 1};
    celspan_plane *plane = make_plane(s, exposure.rostrum);
    for (int32_t scale = 1; scale <= 40; scale *= 3)
      check_size(s, plane, &exposure, scale);
    celspan_plane_unref(plane);
    studio_finish(s);
  }
}

/* Discs so small that a plan may take each of their pieces for a line. */
static void check_small(studio *s) {
  enum { SCALE = 11000 };
  celspan_exposure exposure = {
      studio_show(
          s, studio_circle(s, 40, 30, 0.00006, studio_paint(s, celspan_paint_rgb(1, 1, 1, 1)))),
      1};
  celspan_plane *plane = make_plane(s, exposure.rostrum);
  celspan_frame_desc desc = studio_frame(&exposure, 1, SCALE * WIDTH, SCALE * HEIGHT, NULL);
  celspan_plane_view view = view_of(SCALE * WIDTH, SCALE * HEIGHT);
  desc.film_width = WIDTH;
  desc.film_height = HEIGHT;
  desc.crop_x = view.crop_x = 40 * SCALE - 60;
  desc.crop_y = view.crop_y = 30 * SCALE - 60;
  desc.crop_width = view.crop_width = desc.crop_height = view.crop_height = 120;
  image rendered = make_image(s, &desc, 1);
  float(*drawn)[4] = draw(s, plane, view);
  comparison c = compare(drawn, rendered.rgba, (size_t)120 * 120);
  CHECK(rendered.rgba[60 * 120 + 60][3] > 0);
  if (!CHECK(c.most <= 4 / 255.0f))
    fprintf(stderr, "  small: %g, %zu of %zu\n", (double)c.most, c.off, c.all);
  free(rendered.rgba);
  free(drawn);
  celspan_plane_unref(plane);
  studio_finish(s);
}

/* ---------------------------------------------------------------- as points are */

/* Pixels at their centres, of frames that nobody renders. An edge may lie between the two. Pictures
 * are left out: the probe shows what a pixel of a small frame covers of them. */
static void check_probes(studio *s, variety kind) {
  enum { SIDE = 1 << 20, PROBES = 400 };
  size_t off = 0;
  for (uint64_t seed = 20; seed < 26; seed++) {
    celspan_exposure exposure = {random_rostrum(s, seed, kind), 1};
    celspan_plane *plane = make_plane(s, exposure.rostrum);
    celspan_frame_desc desc = studio_frame(&exposure, 1, WIDTH, HEIGHT, NULL);
    desc.film_width = WIDTH;
    desc.film_height = HEIGHT;
    test_random random = {seed};
    for (int i = 0; i < PROBES; i++) {
      celspan_plane_view view = view_of(SIDE, SIDE);
      view.antialias = CELSPAN_ANTIALIAS_NONE;
      view.crop_x = (int32_t)random_below(&random, SIDE);
      view.crop_y = (int32_t)random_below(&random, SIDE);
      view.crop_width = view.crop_height = 1;
      float(*drawn)[4] = draw(s, plane, view);
      double rgba[4];
      celspan_point at = {(view.crop_x + 0.5) / SIDE * WIDTH, (view.crop_y + 0.5) / SIDE * HEIGHT};
      studio_check(s, celspan_probe(s->context, &desc, at, rgba));
      for (int c = 0; c < 4; c++)
        off += fabs((double)drawn[0][c] - rgba[c]) > 0.0001;
      free(drawn);
    }
    celspan_plane_unref(plane);
    studio_finish(s);
  }
  CHECK(off <= 4);
}

/* ---------------------------------------------------------------- files */

/* A plane that is read again is written as the same bytes and draws the same pixels. */
static void check_files(studio *s) {
  const char *path = "plane/test.plane";
  for (uint64_t seed = 40; seed < 44; seed++) {
    celspan_plane *plane = make_plane(s, random_rostrum(s, seed, PICTURED)), *again = NULL;
    double width, height;
    studio_check(s, celspan_plane_write(s->context, plane, path));
    studio_check(s, celspan_plane_read(s->context, path, &again));
    celspan_plane_size(again, &width, &height);
    CHECK(width == WIDTH && height == HEIGHT);
    CHECK(celspan_plane_bytes(again) == celspan_plane_bytes(plane));
    float(*a)[4] = draw(s, plane, view_of(WIDTH, HEIGHT));
    float(*b)[4] = draw(s, again, view_of(WIDTH, HEIGHT));
    CHECK(memcmp(a, b, WIDTH * HEIGHT * sizeof *a) == 0);
    free(a);
    free(b);
    celspan_plane_unref(again);
    celspan_plane_unref(celspan_plane_ref(plane));
    celspan_plane_unref(plane);
    studio_finish(s);
  }
  celspan_plane *none;
  CHECK(celspan_plane_read(s->context, "plane/none.plane", &none) == CELSPAN_INPUT && !none);
  CHECK(celspan_plane_read(s->context, "plane", &none) == CELSPAN_INPUT && !none);
  FILE *file = fopen(path, "r+b");
  fputc('x', file);
  fclose(file);
  CHECK(celspan_plane_read(s->context, path, &none) == CELSPAN_INPUT && !none);
  CHECK(strstr(celspan_context_error(s->context), "this is not a plane file") != NULL);
  remove(path);
  remove("plane");
}

/* ---------------------------------------------------------------- borders */

static size_t border_count(studio *s, celspan_object **objects, size_t count) {
  celspan_cel *cel = studio_cel(s, CELSPAN_CEL_DESC, objects, count);
  celspan_plane *plane = make_plane(s, studio_rostrum(s, CELSPAN_ROSTRUM_DESC, &cel, 1));
  size_t borders = cs_plane_count(plane).borders;
  celspan_plane_unref(plane);
  return borders;
}

/* Two discs hide a third one together, behind the outline of the one in front: its boundary is
 * swept, but divides none of theirs. */
static void check_borders(studio *s) {
  celspan_object *objects[3] = {
      studio_circle(s, 55, 30, 5, studio_paint(s, celspan_paint_rgb(0, 0, 1, 1))),
      studio_circle(s, 60, 30, 28, studio_paint(s, celspan_paint_rgb(1, 0, 0, 1))),
      studio_circle(s, 25, 30, 30, studio_paint(s, celspan_paint_rgb(1, 1, 0, 1)))};
  CHECK(border_count(s, objects, 3) == border_count(s, objects + 1, 2));
  studio_finish(s);
}

/* ---------------------------------------------------------------- what is refused */

static void check_refused(studio *s, const celspan_rostrum *rostrum, const char *reason) {
  const celspan_plane_desc desc = desc_of(16);
  celspan_plane *plane;
  celspan_status status = celspan_plane_create(s->context, rostrum, &desc, &plane);
  CHECK(status == CELSPAN_BAD_ARGUMENT && !plane);
  if (!CHECK(strstr(celspan_context_error(s->context), reason) != NULL))
    fprintf(stderr, "  %s\n", celspan_context_error(s->context));
}

static celspan_texture *rainbow(studio *s, double x, double y) {
  const celspan_stop stops[] = {{0, celspan_paint_rgb(1, 0, 0, 0.5f)},
                                {1, celspan_paint_rgb(0, 0, 1, 1)}};
  return studio_linear(s, (celspan_point){0, 0}, (celspan_point){x, y}, stops, 2);
}

/* A rectangle under another one, which is blended with it. */
static celspan_object *blended(studio *s, celspan_blend mode, celspan_texture *back,
                               celspan_texture *front) {
  celspan_object *objects[2] = {studio_rect(s, 5, 5, 50, 40, back),
                                studio_rect(s, 20, 10, 60, 45, front)};
  celspan_group_desc desc = CELSPAN_GROUP_DESC;
  desc.objects = &objects[1];
  desc.object_count = 1;
  desc.blend = mode;
  objects[1] = studio_group(s, &desc);
  desc.objects = objects;
  desc.object_count = 2;
  desc.blend = CELSPAN_BLEND_NORMAL;
  desc.isolate = CELSPAN_ISOLATION_ON;
  return studio_group(s, &desc);
}

static void check_kept(studio *s, const celspan_rostrum *rostrum) {
  celspan_exposure exposure = {(celspan_rostrum *)rostrum, 1};
  celspan_plane *plane = make_plane(s, rostrum);
  for (int32_t scale = 1; scale <= 9; scale *= 3)
    check_size(s, plane, &exposure, scale);
  celspan_plane_unref(plane);
}

static celspan_object *matted(studio *s, celspan_object *art, celspan_object *by,
                              celspan_matte_from from, bool invert) {
  celspan_object *out = NULL;
  studio_check(s, celspan_object_create_matte(s->context, art, by, from, invert, &out));
  s->objects[s->object_count++] = out;
  return out;
}

/* Gradients under each other's modes and mattes. */
static void check_veils(studio *s) {
  celspan_texture *across = rainbow(s, WIDTH, 9), *down = rainbow(s, 0, HEIGHT);
  celspan_object *art = studio_rect(s, 5, 5, 70, 40, across);
  celspan_object *by = studio_circle(s, 40, 30, 25, down);
  check_kept(s, studio_show(s, blended(s, CELSPAN_BLEND_MULTIPLY, across, down)));
  check_kept(s, studio_show(s, blended(s, CELSPAN_BLEND_SCREEN, across, down)));
  check_kept(s,
             studio_show(s, studio_fade(s, blended(s, CELSPAN_BLEND_SCREEN, down, across), 0.6)));
  for (int i = 0; i < 4; i++)
    check_kept(s, studio_show(s, matted(s, art, by,
                                        i < 2 ? CELSPAN_MATTE_ALPHA : CELSPAN_MATTE_LUMA, i % 2)));
  studio_finish(s);
}

/* A cel under a front light that varies, and in front of it coloured glass that does. */
static void check_glass(studio *s) {
  const celspan_stop stops[] = {{0, celspan_paint_gel(1, 0.3f, 0.2f)},
                                {1, {{0.1f, 0, 0}, {0.2f, 0.9f, 0.5f}, 0.3f}}};
  celspan_texture *down = rainbow(s, 0, HEIGHT);
  celspan_texture *glass =
      studio_linear(s, (celspan_point){0, 0}, (celspan_point){WIDTH, HEIGHT}, stops, 2);
  celspan_object *art = studio_rect(s, 5, 5, 70, 40, down);
  celspan_object *panes[2] = {
      studio_circle(s, 50, 25, 20, glass),
      studio_rect(s, 20, 20, 60, 9, studio_paint(s, celspan_paint_gel(0.2f, 0.5f, 1)))};
  celspan_cel_desc lit = CELSPAN_CEL_DESC;
  lit.front_texture.texture = rainbow(s, WIDTH, 0);
  celspan_cel *cels[2] = {studio_cel(s, lit, &art, 1), studio_cel(s, CELSPAN_CEL_DESC, panes, 2)};
  celspan_rostrum_desc desc = CELSPAN_ROSTRUM_DESC;
  check_kept(s, studio_rostrum(s, desc, cels, 2));
  desc.back = (celspan_light){1, 0.75f, 0.5f, 1};
  check_kept(s, studio_rostrum(s, desc, cels, 2));
  studio_finish(s);
}

/* One gradient under a mode is tabulated. */
static void check_tabulated(studio *s) {
  celspan_texture *grey = studio_paint(s, celspan_paint_rgb(0.5f, 0.25f, 0.75f, 1));
  check_kept(s, studio_show(s, blended(s, CELSPAN_BLEND_OVERLAY, grey, rainbow(s, WIDTH, 9))));
  check_kept(s, studio_show(s, blended(s, CELSPAN_BLEND_OVERLAY, rainbow(s, 0, HEIGHT), grey)));
  studio_finish(s);
}

static void check_scenes_refused(studio *s) {
  check_refused(s,
                studio_show(s, blended(s, CELSPAN_BLEND_OVERLAY, rainbow(s, WIDTH, 9),
                                       rainbow(s, 0, HEIGHT))),
                "gradients");
  celspan_cel_desc blurred = CELSPAN_CEL_DESC;
  blurred.defocus_radius = 3;
  celspan_object *disc = studio_circle(s, 30, 30, 20, NULL);
  const celspan_matrix bent = {{1, 0, 0, 0, 1, 0, 0.001, 0, 1}};
  celspan_cel *cel = placed(s, studio_cel(s, blurred, &disc, 1), &bent);
  check_refused(s, studio_rostrum(s, CELSPAN_ROSTRUM_DESC, &cel, 1), "blurred");
  celspan_plane *plane;
  celspan_plane_desc desc = desc_of(16);
  desc.width = 0;
  CHECK(celspan_plane_create(s->context, studio_show(s, disc), &desc, &plane) ==
        CELSPAN_BAD_ARGUMENT);
  desc = desc_of(12);
  CHECK(celspan_plane_create(s->context, studio_show(s, disc), &desc, &plane) ==
        CELSPAN_BAD_ARGUMENT);
  studio_finish(s);
}

static void check_views_refused(studio *s) {
  celspan_plane *plane = make_plane(s, random_rostrum(s, 1, FLAT));
  celspan_plane_view view = view_of(0, 5);
  const celspan_sink nowhere = {.struct_size = sizeof nowhere};
  CHECK(celspan_plane_render(s->context, plane, &view, &nowhere) == CELSPAN_LIMIT);
  view = view_of(9, 5);
  view.crop_x = 5;
  view.crop_width = view.crop_height = 5;
  CHECK(celspan_plane_render(s->context, plane, &view, &nowhere) == CELSPAN_BAD_ARGUMENT);
  view = view_of(9, 5);
  view.antialias = CELSPAN_ANTIALIAS_FILTER;
  CHECK(celspan_plane_render(s->context, plane, &view, &nowhere) == CELSPAN_BAD_ARGUMENT);
  view.antialias = CELSPAN_ANTIALIAS_NONE;
  CHECK(celspan_plane_render(s->context, plane, &view, &nowhere) == CELSPAN_OK);
  celspan_plane_unref(plane);
  studio_finish(s);
}

/* ---------------------------------------------------------------- memory */

static celspan_status make_and_draw(studio *s, const celspan_rostrum *rostrum) {
  celspan_plane *plane;
  const celspan_plane_desc desc = desc_of(8);
  celspan_plane_view view = view_of(12, 8);
  unsigned char pixels[12 * 8 * 4];
  celspan_status status = celspan_plane_create(s->context, rostrum, &desc, &plane);
  if (status == CELSPAN_OK)
    status = celspan_plane_pixels(s->context, plane, &view, NULL, pixels, (size_t)12 * 4);
  celspan_plane_unref(plane);
  return status;
}

/* Every allocation fails once. */
static void check_failures_of_memory(studio *s, memory_watch *watch) {
  const celspan_rostrum *rostrum = random_rostrum(s, 3, PICTURED);
  bool has_failed = true;
  for (size_t n = 1; has_failed; n++) {
    watch->fail_at = watch->allocations + n;
    celspan_status status = make_and_draw(s, rostrum);
    watch->fail_at = 0;
    has_failed = status != CELSPAN_OK;
    CHECK(status == CELSPAN_OK || status == CELSPAN_NO_MEMORY);
  }
  studio_finish(s);
}

int main(void) {
  memory_watch watch = {0};
  celspan_context_desc desc = CELSPAN_CONTEXT_DESC;
  desc.resize = memory_watch_resize;
  desc.resize_user = &watch;
  studio s = {0};
  CHECK(celspan_context_create(&desc, &s.context) == CELSPAN_OK);
  check_frames(&s, FLAT);
  check_frames(&s, VARIED);
  check_frames(&s, PICTURED);
  check_small(&s);
  check_probes(&s, FLAT);
  check_probes(&s, VARIED);
  check_files(&s);
  check_borders(&s);
  check_tabulated(&s);
  check_veils(&s);
  check_glass(&s);
  check_scenes_refused(&s);
  check_views_refused(&s);
  check_failures_of_memory(&s, &watch);
  celspan_context_destroy(s.context);
  CHECK(watch.blocks == 0 && watch.size_errors == 0);
  return check_done();
}
