#include "drawing.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "measure.h"

/* ---------------------------------------------------------------- outlines */

typedef struct outline {
  bench_segment *segments;
  size_t count, room;
} outline;

static void add(outline *o, bench_segment segment) {
  if (o->count == o->room) {
    o->room = o->room ? 2 * o->room : 8;
    o->segments = realloc(o->segments, o->room * sizeof *o->segments);
    if (!o->segments)
      bench_stop("out of memory");
  }
  o->segments[o->count++] = segment;
}

static bench_point blend(bench_point a, double u, bench_point b, double v, bench_point c,
                         double w) {
  return (bench_point){a.x * u + b.x * v + c.x * w, a.y * u + b.y * v + c.y * w};
}

/* A piece of the curve belongs to each four neighbours; its Bezier points are their known means. */
static void add_spline(outline *o, const bench_point p[4]) {
  for (int i = 0; i < 4; i++) {
    bench_point a = p[i], b = p[(i + 1) % 4], c = p[(i + 2) % 4], d = p[(i + 3) % 4];
    bench_segment piece = {BENCH_CUBIC,
                           {blend(b, 2 / 3.0, c, 1 / 3.0, a, 0),
                            blend(b, 1 / 3.0, c, 2 / 3.0, a, 0),
                            blend(b, 1 / 6.0, c, 4 / 6.0, d, 1 / 6.0)}};
    if (i == 0)
      add(o, (bench_segment){BENCH_MOVE, {blend(a, 1 / 6.0, b, 4 / 6.0, c, 1 / 6.0)}});
    add(o, piece);
  }
  add(o, (bench_segment){.verb = BENCH_CLOSE});
}

static void add_path(outline *o, const char *data) {
  static const char letters[] = "MLCZ";
  static const int counts[] = {1, 1, 3, 0};
  for (const char *at = data; *at;) {
    const char *letter = strchr(letters, *at);
    if (!letter)
      bench_stop("a path has '%c' where M, L, C or Z was expected", *at);
    bench_segment segment = {.verb = (bench_verb)(letter - letters)};
    at++;
    for (int i = 0; i < counts[segment.verb]; i++) {
      char *end;
      segment.p[i].x = strtod(at, &end);
      segment.p[i].y = strtod(end, &end);
      at = end;
    }
    add(o, segment);
    at += strspn(at, " \n");
  }
}

/* ---------------------------------------------------------------- figures of a shape */

static double held(double v) { return v < 0 ? 0 : v > 1 ? 1 : v; }

/* The rows between two heights, each counted where it lies in the square. */
static double rise(double from, double to) { return fabs(held(to) - held(from)); }

static double cubic_rise(double a, double b, double c, double d) {
  enum { pieces = 256 };
  double sum = 0, before = a;
  for (int i = 1; i <= pieces; i++) {
    double t = (double)i / pieces, s = 1 - t;
    double y = s * s * s * a + 3 * s * s * t * b + 3 * s * t * t * c + t * t * t * d;
    sum += rise(before, y);
    before = y;
  }
  return sum;
}

static double crossings(const bench_shape *shape) {
  double sum = 0;
  bench_point start = {0, 0}, pen = {0, 0};
  for (size_t i = 0; i < shape->segment_count; i++) {
    const bench_segment *s = &shape->segments[i];
    bench_point end = s->verb == BENCH_CLOSE ? start : s->p[s->verb == BENCH_CUBIC ? 2 : 0];
    if (s->verb == BENCH_MOVE) {
      sum += rise(pen.y, start.y);
      start = end;
    } else
      sum += s->verb == BENCH_CUBIC ? cubic_rise(pen.y, s->p[0].y, s->p[1].y, end.y)
                                    : rise(pen.y, end.y);
    pen = end;
  }
  return sum + rise(pen.y, start.y);
}

static void span_rows(bench_shape *shape) {
  static const int counts[] = {1, 1, 3, 0};
  shape->top = HUGE_VAL;
  shape->bottom = -HUGE_VAL;
  for (size_t i = 0; i < shape->segment_count; i++)
    for (int k = 0; k < counts[shape->segments[i].verb]; k++) {
      double y = shape->segments[i].p[k].y;
      shape->top = fmin(shape->top, y);
      shape->bottom = fmax(shape->bottom, y);
    }
}

/* ---------------------------------------------------------------- lines of a file */

static const char *read_colour(const char *at, bench_colour *colour) {
  unsigned red, green, blue, alpha;
  int used = 0;
  if (sscanf(at, "%u %u %u %u %n", &red, &green, &blue, &alpha, &used) < 4)
    bench_stop("a drawing has no colour where one was expected: %.40s", at);
  *colour = (bench_colour){(uint8_t)red, (uint8_t)green, (uint8_t)blue, (uint8_t)alpha};
  return at + used;
}

static const char *read_paint(const char *at, bench_shape *shape) {
  int used = 0;
  shape->is_gradient = sscanf(at, "across %lf %lf %n", &shape->x0, &shape->x1, &used) == 2;
  at = read_colour(at + used, &shape->colour);
  return shape->is_gradient ? read_colour(at, &shape->far_colour) : at;
}

static const char *read_head(const char *line, bench_shape *shape) {
  char kind[8], rule[9];
  int used = 0;
  if (sscanf(line, "%7s %8s %n", kind, rule, &used) < 2)
    bench_stop("a drawing has a line that is no shape: %.40s", line);
  shape->is_spline = strcmp(kind, "spline") == 0;
  shape->is_evenodd = strcmp(rule, "evenodd") == 0;
  return read_paint(line + used, shape);
}

static void read_shape(const char *line, bench_shape *shape) {
  outline o = {0};
  const char *rest = read_head(line, shape);
  if (shape->is_spline) {
    char *end = (char *)rest;
    for (int i = 0; i < 4; i++) {
      shape->spline[i].x = strtod(end, &end);
      shape->spline[i].y = strtod(end, &end);
    }
    add_spline(&o, shape->spline);
  } else {
    shape->data = strdup(rest);
    add_path(&o, rest);
  }
  shape->segments = o.segments;
  shape->segment_count = o.count;
  span_rows(shape);
}

bench_drawing bench_drawing_read(const char *path) {
  bench_drawing drawing = {0};
  FILE *file = fopen(path, "r");
  char *line = NULL;
  size_t room = 0;
  if (!file || getline(&line, &room, file) < 0 ||
      sscanf(line, "drawing %zu", &drawing.shape_count) != 1)
    bench_stop("%s is no drawing", path);
  drawing.shapes = calloc(drawing.shape_count, sizeof *drawing.shapes);
  for (size_t i = 0; i < drawing.shape_count; i++) {
    if (getline(&line, &room, file) < 0)
      bench_stop("%s has %zu shapes, not the %zu it says", path, i, drawing.shape_count);
    read_shape(line, &drawing.shapes[i]);
    drawing.crossings += crossings(&drawing.shapes[i]);
  }
  free(line);
  fclose(file);
  return drawing;
}

void bench_drawing_free(bench_drawing *drawing) {
  for (size_t i = 0; i < drawing->shape_count; i++) {
    free((void *)drawing->shapes[i].data);
    free((void *)drawing->shapes[i].segments);
  }
  free(drawing->shapes);
}
