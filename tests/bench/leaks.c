#include "leaks.h"

#include <math.h>
#include <stdlib.h>

#include "measure.h"
#include "scene.h"
#include "tests/support/random.h"

enum { wedges_least = 3, wedges_most = 64, bars_most = 300, side_least = 8, side_most = 96 };

#define REACH 32.0 /* of a wedge; the frame is 1 x 1, and 168 degrees is the widest wedge */

typedef struct leak {
  celspan_context *context;
  test_random random;
  double worst;
  uint64_t frames, pixels, leaking;
} leak;

/* ---------------------------------------------------------------- covers */

static celspan_object *make_polygon(celspan_context *context, const celspan_point *points,
                                    size_t count) {
  const celspan_paint black = celspan_paint_rgb(0, 0, 0, 1);
  celspan_texture *texture;
  celspan_object *object;
  bench_check(context, celspan_texture_create_paint(context, &black, &texture));
  celspan_polygon_desc desc = {
      .struct_size = sizeof desc, .points = points, .point_count = count, .texture = texture};
  bench_check(context, celspan_object_create_polygon(context, &desc, &object));
  celspan_texture_unref(texture);
  return object;
}

/* Neighbours share exactly the same numbers for their common spoke. */
static void make_fan(leak *job, celspan_object **wedges, int count) {
  celspan_point spokes[wedges_most + 1], centre = random_point(&job->random, 0, 1, 0, 1);
  double turn = random_between(&job->random, 0, 2 * M_PI);
  for (int i = 0; i < count; i++) {
    double angle = turn + (i + random_between(&job->random, -0.2, 0.2)) * 2 * M_PI / count;
    spokes[i] = (celspan_point){centre.x + REACH * cos(angle), centre.y + REACH * sin(angle)};
  }
  spokes[count] = spokes[0];
  for (int i = 0; i < count; i++)
    wedges[i] = make_polygon(job->context, (celspan_point[]){centre, spokes[i], spokes[i + 1]}, 3);
}

static int ascending(const void *p, const void *q) {
  double a = *(const double *)p, b = *(const double *)q;
  return (a > b) - (a < b);
}

/* Where the seams meet a line; the first and the last are far outside. */
static void place_seams(test_random *random, double *seams, int count) {
  for (int i = 1; i < count; i++)
    seams[i] = random_between(random, 0, 1);
  seams[0] = -REACH;
  seams[count] = REACH;
  qsort(seams, (size_t)count + 1, sizeof *seams, ascending);
}

static void make_bars(leak *job, celspan_object **bars, int count) {
  double tops[bars_most + 1], feet[bars_most + 1];
  bool is_upright = random_below(&job->random, 2);
  place_seams(&job->random, tops, count);
  place_seams(&job->random, feet, count);
  const double *low = is_upright ? tops : feet;
  for (int i = 0; i < count; i++) {
    const celspan_point corners[] = {
        {tops[i], -1}, {tops[i + 1], -1}, {low[i + 1], 2}, {low[i], 2}};
    bars[i] = make_polygon(job->context, corners, 4);
  }
}

/* ---------------------------------------------------------------- frames */

static void judge_row(leak *job, const celspan_span *spans, size_t count) {
  float seen[4];
  for (size_t i = 0; i < count; i++)
    for (int32_t x = spans[i].x0; x < spans[i].x1; x++) {
      celspan_span_colour(&spans[i], x, seen);
      double light = fmax(fmax(fabs((double)seen[0]), fabs((double)seen[1])),
                          fmax(fabs((double)seen[2]), fabs(1 - (double)seen[3])));
      job->leaking += light != 0;
      job->worst = fmax(job->worst, 255 * light);
      job->pixels++;
    }
}

static void judge_frame(leak *job, celspan_rostrum *rostrum, int side) {
  static const celspan_antialias_mode area = CELSPAN_ANTIALIAS_AREA;
  const celspan_exposure exposure = {rostrum, 1};
  celspan_frame_desc desc = bench_frame(&exposure, side, side, &area);
  celspan_rows *rows;
  const celspan_span *spans;
  size_t count;
  bench_check(job->context, celspan_rows_create(job->context, &desc, &rows));
  for (int y = 0; y < side; y++) {
    bench_check(job->context, celspan_rows_get(rows, y, &spans, &count));
    judge_row(job, spans, count);
  }
  celspan_rows_destroy(rows);
  job->frames++;
}

/* Releases the shapes. */
static void judge_cover(leak *job, celspan_object **shapes, int count) {
  celspan_cel_desc cel = CELSPAN_CEL_DESC;
  cel.objects = shapes;
  cel.object_count = (size_t)count;
  celspan_rostrum *rostrum = bench_rostrum_of(job->context, &cel, true);
  judge_frame(job, rostrum, side_least + random_below(&job->random, side_most - side_least));
  celspan_rostrum_unref(rostrum);
  for (int i = 0; i < count; i++)
    celspan_object_unref(shapes[i]);
}

void bench_tell_leaks(celspan_context *context, bench_cover cover, int rounds) {
  celspan_object *shapes[bars_most];
  leak job = {.context = context, .random = {30}};
  for (int round = 0; round < rounds; round++)
    for (int count = wedges_least; count <= wedges_most; count++) {
      int bars = 2 + random_below(&job.random, bars_most - 1);
      if (cover == BENCH_FANS)
        make_fan(&job, shapes, count);
      else
        make_bars(&job, shapes, bars);
      judge_cover(&job, shapes, cover == BENCH_FANS ? count : bars);
    }
  bench_tell("frames", (double)job.frames);
  bench_tell("pixels", (double)job.pixels);
  bench_tell("leaking", (double)job.leaking);
  bench_tell("worst", job.worst);
}
