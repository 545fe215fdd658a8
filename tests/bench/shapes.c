/* The random-shape scenes, timed inside one process: `shapes COUNT SIDE [RUNS]`.
 *
 * Each shape is a closed uniform cubic B-spline on four random points of the unit square, filled
 * even-odd, painted over white: the scenes of the material's bench-scenes when CELSPAN_MATERIAL
 * names it, else shapes made by the same rule. Prints the least and the median time of interleaved
 * runs, to spans and to 8-bit pixels in a reused row, without and with antialiasing.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "celspan/celspan.h"
#include "output/pixels.h"

#define RUNS_LIMIT 1000

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
  fprintf(stderr, "shapes: %s\n", celspan_context_error(context));
  exit(1);
}

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
    celspan_nurbs_desc desc = {.points = s.points, .point_count = 4, .degree = 3,
                               .rule = CELSPAN_RULE_EVENODD, .texture = texture};
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

static celspan_status drop_row(void *user, celspan_context *context, int32_t y,
                               const celspan_span *spans, size_t span_count) {
  (void)user, (void)context, (void)y, (void)spans, (void)span_count;
  return CELSPAN_OK;
}

static celspan_status code_row(void *user, celspan_context *context, int32_t y,
                               const celspan_span *spans, size_t span_count) {
  static const celspan_coding coding = {CELSPAN_DEPTH_8, CELSPAN_TRANSFER_SRGB,
                                        CELSPAN_ALPHA_STRAIGHT};
  (void)context, (void)y;
  cs_pixels_row(&coding, spans, span_count, user);
  return CELSPAN_OK;
}

static double seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now); /* one worker: processor time, free of waiting */
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static int compare(const void *p, const void *q) {
  double a = *(const double *)p, b = *(const double *)q;
  return (a > b) - (a < b);
}

int main(int argc, char **argv) {
  static const char *const names[4] = {"spans none", "spans area", "pixels none", "pixels area"};
  static double times[4][RUNS_LIMIT];
  int count = argc > 1 ? atoi(argv[1]) : 100, side = argc > 2 ? atoi(argv[2]) : 4000;
  int runs = argc > 3 ? atoi(argv[3]) : 5;
  celspan_context *context;
  if (runs < 1 || runs > RUNS_LIMIT || celspan_context_create(NULL, &context) != CELSPAN_OK)
    return 2;
  celspan_rostrum *rostrum = make_scene(context, count);
  celspan_exposure exposure = {rostrum, 1};
  celspan_statistics statistics[4];
  void *row = calloc((size_t)side, 4);
  for (int run = 0; run < runs; run++)
    for (int way = 0; way < 4; way++) {
      celspan_antialias_mode mode = way % 2 ? CELSPAN_ANTIALIAS_AREA : CELSPAN_ANTIALIAS_NONE;
      celspan_frame_desc desc = CELSPAN_FRAME_DESC;
      desc.exposures = &exposure;
      desc.exposure_count = 1;
      desc.film_width = desc.film_height = 1;
      desc.width = desc.height = side;
      desc.antialias = &mode;
      desc.workers = 1;
      celspan_sink sink = {.user = row, .row = way < 2 ? drop_row : code_row};
      double begun = seconds();
      check(context, celspan_frame_render(context, &desc, &sink, &statistics[way]));
      times[way][run] = 1e3 * (seconds() - begun);
    }
  for (int way = 0; way < 4; way++) {
    qsort(times[way], (size_t)runs, sizeof times[way][0], compare);
    printf("%d shapes, %d x %d, %-11s  least %8.2f ms  median %8.2f ms  spans %llu  colours %llu  "
           "peak %llu\n",
           count, side, side, names[way], times[way][0], times[way][runs / 2],
           (unsigned long long)statistics[way].spans,
           (unsigned long long)statistics[way].colour_evaluations,
           (unsigned long long)statistics[way].peak_bytes);
  }
  free(row);
  celspan_rostrum_unref(rostrum);
  celspan_context_destroy(context);
  return 0;
}
