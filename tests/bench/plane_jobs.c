#include "plane_jobs.h"

#include <stdlib.h>
#include <string.h>

#include "celspan/plane.h"
#include "drawing.h"
#include "measure.h"
#include "scene.h"

#define TILE 256

typedef struct plane_job {
  celspan_context *context;
  celspan_rostrum *rostrum;
  celspan_plane *plane;
  celspan_plane_view view;
} plane_job;

static void make(void *user) {
  plane_job *job = user;
  celspan_plane_desc desc = CELSPAN_PLANE_DESC;
  desc.width = desc.height = 1;
  celspan_plane_unref(job->plane);
  bench_check(job->context, celspan_plane_create(job->context, job->rostrum, &desc, &job->plane));
}

static void draw(void *user) {
  plane_job *job = user;
  int32_t width = job->view.crop_width > 0 ? job->view.crop_width : job->view.width;
  bench_check(job->context, celspan_plane_pixels(job->context, job->plane, &job->view, &bench_coded,
                                                 NULL, 4 * (size_t)width));
}

static void crop(celspan_plane_view *view) {
  view->crop_x = view->crop_y = view->width / 2 - TILE / 2;
  view->crop_width = view->crop_height = TILE;
}

void bench_plane(bench_frame_job *job, int count, char **words) {
  if (count != 3)
    bench_stop("plane DRAWING SIDE make|draw|tile, or plane DRAWING 0 FILE");
  bench_drawing drawing = bench_drawing_read(words[0]);
  job->rostrum = bench_scene(job->context, &drawing, NULL);
  plane_job plane = {job->context, job->rostrum, NULL, CELSPAN_PLANE_VIEW};
  plane.view.width = plane.view.height = atoi(words[1]);
  plane.view.antialias = CELSPAN_ANTIALIAS_AREA;
  if (strcmp(words[2], "tile") == 0)
    crop(&plane.view);
  make(&plane);
  if (plane.view.width > 0)
    bench_measure(strcmp(words[2], "make") == 0 ? make : draw, &plane);
  else
    bench_check(job->context, celspan_plane_write(job->context, plane.plane, words[2]));
  bench_tell("bytes", (double)celspan_plane_bytes(plane.plane));
  celspan_plane_unref(plane.plane);
  bench_drawing_free(&drawing);
}
