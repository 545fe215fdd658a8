/* Cairo: image surfaces, ARGB32. */
#include <cairo.h>
#include <stdlib.h>
#include <string.h>

#include "peer.h"

typedef struct cairo_frame {
  const bench_drawing *drawing;
  cairo_path_t **paths; /* at full size */
  int side;
  bool is_antialiased;
} cairo_frame;

static void trace(cairo_t *cairo, const bench_shape *shape, double side) {
  for (size_t i = 0; i < shape->segment_count; i++) {
    const bench_point *p = shape->segments[i].p;
    switch (shape->segments[i].verb) {
    case BENCH_MOVE:
      cairo_move_to(cairo, side * p[0].x, side * p[0].y);
      break;
    case BENCH_LINE:
      cairo_line_to(cairo, side * p[0].x, side * p[0].y);
      break;
    case BENCH_CUBIC:
      cairo_curve_to(cairo, side * p[0].x, side * p[0].y, side * p[1].x, side * p[1].y,
                     side * p[2].x, side * p[2].y);
      break;
    case BENCH_CLOSE:
      cairo_close_path(cairo);
      break;
    }
  }
}

static void *begin(const bench_drawing *drawing, int side, bool is_antialiased) {
  cairo_frame *frame = malloc(sizeof *frame);
  *frame = (cairo_frame){drawing, calloc(drawing->shape_count, sizeof *frame->paths), side,
                         is_antialiased};
  cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, 1, 1);
  cairo_t *cairo = cairo_create(surface);
  for (size_t i = 0; i < drawing->shape_count; i++) {
    cairo_new_path(cairo);
    trace(cairo, &drawing->shapes[i], side);
    frame->paths[i] = cairo_copy_path(cairo);
  }
  cairo_destroy(cairo);
  cairo_surface_destroy(surface);
  return frame;
}

static void add_stop(cairo_pattern_t *pattern, double at, bench_colour c) {
  cairo_pattern_add_color_stop_rgba(pattern, at, c.red / 255.0, c.green / 255.0, c.blue / 255.0,
                                    c.alpha / 255.0);
}

/* Gradients are blended premultiplied, with more than 8 bits, at each pixel's centre. */
static void set_paint(cairo_t *cairo, const bench_shape *s, double side) {
  bench_colour c = s->colour;
  if (s->is_gradient) {
    cairo_pattern_t *pattern = cairo_pattern_create_linear(side * s->x0, 0, side * s->x1, 0);
    add_stop(pattern, 0, c);
    add_stop(pattern, 1, s->far_colour);
    cairo_set_source(cairo, pattern);
    cairo_pattern_destroy(pattern);
  } else
    cairo_set_source_rgba(cairo, c.red / 255.0, c.green / 255.0, c.blue / 255.0, c.alpha / 255.0);
}

static void draw(cairo_t *cairo, const cairo_frame *frame, size_t index) {
  const bench_shape *s = &frame->drawing->shapes[index];
  cairo_new_path(cairo);
  cairo_append_path(cairo, frame->paths[index]);
  cairo_set_fill_rule(cairo, s->is_evenodd ? CAIRO_FILL_RULE_EVEN_ODD : CAIRO_FILL_RULE_WINDING);
  set_paint(cairo, s, frame->side);
  cairo_fill(cairo);
}

static cairo_t *open_pixels(const cairo_frame *frame, uint8_t *pixels, int width, int rows) {
  cairo_surface_t *surface =
      cairo_image_surface_create_for_data(pixels, CAIRO_FORMAT_ARGB32, width, rows, 4 * width);
  cairo_t *cairo = cairo_create(surface);
  cairo_surface_destroy(surface);
  cairo_set_antialias(cairo,
                      frame->is_antialiased ? CAIRO_ANTIALIAS_DEFAULT : CAIRO_ANTIALIAS_NONE);
  return cairo;
}

static void band(void *user, uint8_t *pixels, int width, int rows, int first_row) {
  const cairo_frame *frame = user;
  cairo_t *cairo = open_pixels(frame, pixels, width, rows);
  cairo_set_source_rgb(cairo, 1, 1, 1);
  cairo_paint(cairo);
  cairo_translate(cairo, 0, -first_row);
  for (size_t i = 0; i < frame->drawing->shape_count; i++)
    if (bench_shape_meets(&frame->drawing->shapes[i], frame->side, first_row, rows))
      draw(cairo, frame, i);
  cairo_destroy(cairo);
}

static void place(void *user, uint8_t *pixels, int side, bench_place place) {
  const cairo_frame *frame = user;
  cairo_t *cairo = open_pixels(frame, pixels, side, side);
  double size = place.scale * side, top = place.y * side;
  cairo_translate(cairo, place.x * side, top);
  cairo_scale(cairo, place.scale, place.scale);
  for (size_t i = 0; i < frame->drawing->shape_count; i++)
    if (bench_shape_meets(&frame->drawing->shapes[i], size, -top, side))
      draw(cairo, frame, i);
  cairo_destroy(cairo);
}

static void end(void *user) {
  cairo_frame *frame = user;
  for (size_t i = 0; i < frame->drawing->shape_count; i++)
    cairo_path_destroy(frame->paths[i]);
  free(frame->paths);
  free(frame);
}

static void picture(const bench_job *job, uint8_t *pixels) {
  const double *m = job->matrix;
  cairo_surface_t *surface = cairo_image_surface_create_for_data(
      pixels, CAIRO_FORMAT_ARGB32, BENCH_FRAME_WIDTH, BENCH_FRAME_HEIGHT, 4 * BENCH_FRAME_WIDTH);
  cairo_surface_t *overlay =
      cairo_image_surface_create_for_data(job->overlay, CAIRO_FORMAT_ARGB32, BENCH_OVERLAY_WIDTH,
                                          BENCH_OVERLAY_HEIGHT, 4 * BENCH_OVERLAY_WIDTH);
  memcpy(pixels, job->ground, (size_t)4 * BENCH_FRAME_WIDTH * BENCH_FRAME_HEIGHT);
  cairo_t *cairo = cairo_create(surface);
  cairo_matrix_t matrix = {m[0], m[3], m[1], m[4], m[2], m[5]};
  cairo_transform(cairo, &matrix);
  cairo_set_source_surface(cairo, overlay, 0, 0);
  cairo_pattern_set_filter(cairo_get_source(cairo), CAIRO_FILTER_BILINEAR);
  cairo_paint(cairo);
  cairo_destroy(cairo);
  cairo_surface_destroy(overlay);
  cairo_surface_destroy(surface);
}

const bench_peer bench_peer_here = {
    .is_bgra = true, .begin = begin, .band = band, .place = place, .end = end, .picture = picture};
