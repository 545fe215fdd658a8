/* The scene of the random-shape benchmarks: each shape is a closed uniform cubic B-spline on four
 * random points of the unit square, filled even-odd, painted over white: the scenes of the
 * material's bench-scenes when CELSPAN_MATERIAL names it, else shapes made by the same rule.
 */
#ifndef CELSPAN_TESTS_RANDOM_SHAPES_H
#define CELSPAN_TESTS_RANDOM_SHAPES_H

#include <stdio.h>
#include <stdlib.h>

#include "celspan/celspan.h"

typedef struct shape {
  celspan_paint paint;
  celspan_point points[4];
} shape;

static uint64_t random_state = 0x853c49e6748fea9bu;

static double random_unit(void) {
  random_state ^= random_state << 13;
  random_state ^= random_state >> 7;
  random_state ^= random_state << 17;
  return (double)(random_state >> 11) * 0x1p-53;
}

static void make_shape(shape *s) {
  float rgb[3];
  for (int c = 0; c < 3; c++)
    rgb[c] = (float)random_unit();
  s->paint = celspan_paint_rgb(rgb[0], rgb[1], rgb[2], (float)(0.2 + 0.8 * random_unit()));
  for (int i = 0; i < 4; i++) {
    double x = random_unit();
    s->points[i] = (celspan_point){x, random_unit()};
  }
}

static FILE *open_scene(int count) {
  char path[4096], header[64];
  const char *material = getenv("CELSPAN_MATERIAL");
  if (!material)
    return NULL;
  snprintf(path, sizeof path, "%s/bench-scenes/scene%d.txt", material, count);
  FILE *file = fopen(path, "r");
  if (file && !fgets(header, sizeof header, file))
    rewind(file);
  return file;
}

static void read_shape(FILE *file, shape *s) {
  double v[12];
  for (int k = 0; k < 12; k++)
    if (fscanf(file, "%lf", &v[k]) != 1)
      exit(2);
  s->paint = celspan_paint_rgb((float)(v[0] / 255), (float)(v[1] / 255), (float)(v[2] / 255),
                               (float)(v[3] / 255));
  for (int i = 0; i < 4; i++)
    s->points[i] = (celspan_point){v[4 + 2 * i], v[5 + 2 * i]};
}

static void check(celspan_context *context, celspan_status status) {
  if (status == CELSPAN_OK)
    return;
  fprintf(stderr, "%s\n", celspan_context_error(context));
  exit(1);
}

/* count: 10, 100 or 1000. */
static celspan_rostrum *make_scene(celspan_context *context, int count) {
  FILE *file = open_scene(count);
  celspan_object **objects = calloc((size_t)count, sizeof *objects);
  for (int i = 0; i < count; i++) {
    shape s;
    celspan_texture *texture;
    if (file)
      read_shape(file, &s);
    else
      make_shape(&s);
    check(context, celspan_texture_create_paint(context, &s.paint, &texture));
    celspan_nurbs_desc desc = {.points = s.points,
                               .point_count = 4,
                               .degree = 3,
                               .rule = CELSPAN_RULE_EVENODD,
                               .texture = texture};
    check(context, celspan_object_create_nurbs(context, &desc, &objects[i]));
    celspan_texture_unref(texture);
  }
  if (file)
    fclose(file);
  celspan_cel_desc cel_desc = CELSPAN_CEL_DESC;
  cel_desc.objects = objects;
  cel_desc.object_count = (size_t)count;
  celspan_cel *cel;
  check(context, celspan_cel_create(context, &cel_desc, &cel));
  celspan_rostrum_desc desc = CELSPAN_ROSTRUM_DESC;
  desc.cels = &cel;
  desc.cel_count = 1;
  desc.back = (celspan_light){1, 1, 1, 1};
  celspan_rostrum *rostrum;
  check(context, celspan_rostrum_create(context, &desc, &rostrum));
  celspan_cel_unref(cel);
  for (int i = 0; i < count; i++)
    celspan_object_unref(objects[i]);
  free(objects);
  return rostrum;
}

#endif
