/* `bench_stroke [SIDE]`: the cost of strokes, compared with filling their outlines.
 *
 * Every line is drawn as a stroke; then its outline for that frame is filled as a path, the same
 * curves but already made. A line of the output gives the number of these curves, the milliseconds
 * of a frame for each of the two, median of FRAMES by one worker, and their ratio, which is
 * promised to be 3 at most.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "celspan/celspan.h"
#include "measure.h"
#include "model/scene/primitive_data.h"
#include "model/stroke/outliner.h"

#define FRAMES 21
#define SIDE 100.0 /* film units */

static void check(celspan_context *context, celspan_status status) {
  if (status != CELSPAN_OK)
    bench_stop("%s", celspan_context_error(context));
}

/* ---------------------------------------------------------------- lines */

#define POINTS 400

static celspan_point points[POINTS];
static double widths[POINTS];

/* A spiral that a brush would draw. */
static void wind(void) {
  for (int i = 0; i < POINTS; i++) {
    double angle = 0.15 * i, radius = 2 + 0.11 * i;
    points[i] = (celspan_point){50 + radius * cos(angle), 50 + radius * sin(angle)};
    widths[i] = 0.6 + 0.5 * sin(0.37 * i);
  }
}

typedef struct line {
  const char *name, *data;
  double width, dash;
  bool has_widths;
} line;

static const line lines[] = {
    {"straight", "M10 10L90 20L30 60L80 90L20 95L5 40", 2, 0, false},
    {"curve", "M20 20C40 0 90 10 80 40S20 50 20 70S60 100 85 80", 2, 0, false},
    {"wide", "M20 20C40 0 90 10 80 40S20 50 20 70S60 100 85 80", 30, 0, false},
    {"hair", "M20 20C40 0 90 10 80 40S20 50 20 70S60 100 85 80", 0.1, 0, false},
    {"circle", "M50 10A40 40 0 1 1 49.9 10Z", 3, 0, false},
    {"dashes", "M50 10A40 40 0 1 1 49.9 10Z", 1, 0.5, false},
    {"brush", NULL, 1, 0, true},
};

static celspan_object *make_stroke(celspan_context *context, const line *l) {
  celspan_stroke_desc desc = CELSPAN_STROKE_DESC;
  celspan_object *object;
  desc.data = l->data;
  desc.width = l->width;
  desc.dashes = &l->dash;
  desc.dash_count = 1;
  desc.join = CELSPAN_STROKE_JOIN_ROUND;
  if (!(l->dash > 0)) {
    desc.dashes = NULL;
    desc.dash_count = 0;
  }
  if (l->has_widths) {
    desc.points = points;
    desc.widths = widths;
    desc.point_count = POINTS;
    desc.degree = 3;
  }
  check(context, celspan_object_create_stroke(context, &desc, &object));
  return object;
}

/* ---------------------------------------------------------------- their outlines */

static size_t write_piece(char *text, const cs_hpoint *p, int degree) {
  return degree == 3 ? (size_t)sprintf(text, "C%.17g %.17g %.17g %.17g %.17g %.17g", p[1].x, p[1].y,
                                       p[2].x, p[2].y, p[3].x, p[3].y)
                     : (size_t)sprintf(text, "L%.17g %.17g", p[degree].x, p[degree].y);
}

static char *write_outline(const cs_outline *outline) {
  char *text = malloc(outline->piece_count * 6 * 26 + outline->contour_count * 2 * 26 + 1);
  size_t at = 0, contour = 0;
  if (!text)
    bench_stop("there is no memory for an outline");
  for (size_t i = 0; i < outline->piece_count; i++) {
    const cs_hpoint *p = outline->points + outline->starts[i];
    if (contour < outline->contour_count && outline->contours[contour] == i) {
      at += (size_t)sprintf(text + at, "M%.17g %.17g", p->x, p->y);
      contour++;
    }
    at += write_piece(text + at, p, outline->degrees[i]);
  }
  text[at] = 0;
  return text;
}

static celspan_object *make_filled(celspan_context *context, const celspan_object *stroke,
                                   double side, size_t *curves) {
  const cs_stroke_view view = {.matrix = celspan_matrix_scaling(side / SIDE, side / SIDE),
                               .frame = {0, side, 0, side},
                               .tolerance = CS_STROKE_TOLERANCE,
                               .bottom = side,
                               .right = side};
  cs_outline outline;
  celspan_object *object;
  cs_outline_init(&outline);
  check(context, cs_stroke_outline(context, stroke->data->stroke, &view, &outline));
  *curves = outline.piece_count;
  char *text = write_outline(&outline);
  const celspan_path_desc desc = {.struct_size = sizeof desc, .data = text};
  check(context, celspan_object_create_path(context, &desc, &object));
  free(text);
  cs_outline_finish(&outline, context->memory);
  return object;
}

/* ---------------------------------------------------------------- frames */

static void draw(celspan_context *context, celspan_rostrum *rostrum, int side) {
  const celspan_exposure exposure = {rostrum, 1};
  celspan_frame_desc desc = CELSPAN_FRAME_DESC;
  celspan_rows *rows;
  const celspan_span *spans;
  size_t span_count;
  desc.exposures = &exposure;
  desc.exposure_count = 1;
  desc.width = desc.height = side;
  desc.workers = 1;
  desc.film_width = desc.film_height = SIDE;
  check(context, celspan_rows_create(context, &desc, &rows));
  for (int32_t y = 0; y < side; y++)
    check(context, celspan_rows_get(rows, y, &spans, &span_count));
  celspan_rows_destroy(rows);
}

static int compare(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* Milliseconds of processor time. */
static double measure(celspan_context *context, celspan_object *object, int side) {
  celspan_cel_desc cel_desc = CELSPAN_CEL_DESC;
  celspan_rostrum_desc rostrum_desc = CELSPAN_ROSTRUM_DESC;
  celspan_rostrum *rostrum;
  celspan_cel *cel;
  double times[FRAMES];
  cel_desc.objects = &object;
  cel_desc.object_count = 1;
  check(context, celspan_cel_create(context, &cel_desc, &cel));
  rostrum_desc.cels = &cel;
  rostrum_desc.cel_count = 1;
  check(context, celspan_rostrum_create(context, &rostrum_desc, &rostrum));
  celspan_cel_unref(cel);
  draw(context, rostrum, side);
  for (int i = 0; i < FRAMES; i++) {
    double before = bench_processor();
    draw(context, rostrum, side);
    times[i] = 1e3 * (bench_processor() - before);
  }
  celspan_rostrum_unref(rostrum);
  qsort(times, FRAMES, sizeof *times, compare);
  return times[FRAMES / 2];
}

int main(int argc, char **argv) {
  celspan_context *context;
  int side = argc > 1 ? atoi(argv[1]) : 1024;
  if (side < 1 || celspan_context_create(NULL, &context) != CELSPAN_OK)
    bench_stop("usage: bench_stroke [SIDE]");
  wind();
  for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
    size_t curves;
    celspan_object *stroke = make_stroke(context, &lines[i]);
    celspan_object *filled = make_filled(context, stroke, side, &curves);
    double drawn = measure(context, stroke, side), fill = measure(context, filled, side);
    printf("%-8s %6zu curves, stroke %8.3f ms, filled %8.3f ms, ratio %.2f\n", lines[i].name,
           curves, drawn, fill, drawn / fill);
    celspan_object_unref(filled);
    celspan_object_unref(stroke);
  }
  celspan_context_destroy(context);
  return 0;
}
