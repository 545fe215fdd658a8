#include "picture_jobs.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "measure.h"
#include "pictures.h"
#include "scene.h"

/* A picture as an object; everything except the file is given by `desc`. */
static celspan_object *load(celspan_context *context, const char *folder, const char *name,
                            celspan_image_desc desc) {
  char path[4096];
  celspan_object *object;
  snprintf(path, sizeof path, "%s%s%s", folder ? folder : "", folder ? "/" : "", name);
  celspan_picture_desc picture = *desc.picture;
  picture.file = path;
  desc.picture = &picture;
  bench_check(context, celspan_object_create_image(context, &desc, &object));
  return object;
}

/* Applies a matrix and releases the object that it was applied to. */
static celspan_object *moved(celspan_context *context, celspan_object *object,
                             celspan_matrix matrix) {
  celspan_object *out;
  bench_check(context, celspan_object_transform(context, object, &matrix, &out));
  celspan_object_unref(object);
  return out;
}

/* One cel of these objects, which are released; is_backed: over white. */
static celspan_rostrum *mount(celspan_context *context, celspan_object **objects, size_t count,
                              bool is_backed) {
  celspan_cel_desc cel = CELSPAN_CEL_DESC;
  cel.objects = objects;
  cel.object_count = count;
  celspan_rostrum *rostrum = bench_rostrum_of(context, &cel, is_backed);
  for (size_t i = 0; i < count; i++)
    celspan_object_unref(objects[i]);
  return rostrum;
}

/* ---------------------------------------------------------------- raster jobs */

/* colour: what the files' values mean; NULL: sRGB. */
static void open_picture(bench_frame_job *job, char **words, const char *colour) {
  bench_job asked = bench_job_make(words[0], 0);
  const celspan_picture_desc picture = {
      .struct_size = sizeof picture, .colour = colour, .sampling = CELSPAN_SAMPLING_BILINEAR};
  const celspan_image_desc image = {.struct_size = sizeof image, .picture = &picture};
  celspan_matrix matrix;
  memcpy(matrix.m, asked.matrix, sizeof matrix.m);
  celspan_object *objects[2] = {
      load(job->context, words[1], "ground.tga", image),
      moved(job->context, load(job->context, words[1], "overlay.tga", image), matrix)};
  job->rostrum = mount(job->context, objects, 2, true);
  bench_job_open(job, BENCH_FRAME_WIDTH, BENCH_FRAME_HEIGHT, "area", words[2], 1);
  job->desc.film_width = BENCH_FRAME_WIDTH;
  job->desc.film_height = BENCH_FRAME_HEIGHT;
  bench_job_free(&asked);
}

/* Timed in linear light; the cells are those of values blended as the peers blend them. */
void bench_picture(bench_frame_job *job, int count, char **words) {
  if (count != 3)
    bench_stop("picture JOB FOLDER OUTPUT");
  open_picture(job, words, NULL);
  bench_job_render(job);
  bench_job_measure(job);
  if (strcmp(words[2], "whole") != 0)
    return;
  bench_job_close(job);
  open_picture(job, words, "linear");
  bench_job_look(job);
}

/* ---------------------------------------------------------------- figure 14 */

static bool is_none(const char *word) { return strcmp(word, "-") == 0; }

/* Adds the objects that FRONT names, and returns how many objects there are then. */
static size_t add_front(celspan_context *context, const char *front, celspan_image_desc image,
                        celspan_object **objects, size_t count) {
  size_t length = strlen(front);
  if (is_none(front))
    return count;
  if (length < 4 || strcmp(front + length - 4, ".txt") != 0) {
    objects[count] = load(context, NULL, front, image);
    return count + 1;
  }
  bench_drawing drawing = bench_drawing_read(front);
  objects[count] = bench_union(context, &drawing);
  bench_drawing_free(&drawing);
  return count + 1;
}

void bench_backed(bench_frame_job *job, int count, char **words) {
  if (count < 5)
    bench_stop("backed PICTURE SAMPLING SIDE OUTPUT FRONT [FILE]");
  int side = atoi(words[2]);
  celspan_object *objects[2];
  size_t object_count = 0;
  celspan_picture_desc picture = CELSPAN_PICTURE_DESC;
  const celspan_image_desc image = {
      .struct_size = sizeof image, .picture = &picture, .width = 1, .height = 1};
  picture.sampling =
      strcmp(words[1], "nearest") == 0 ? CELSPAN_SAMPLING_NEAREST : CELSPAN_SAMPLING_BILINEAR;
  if (!is_none(words[0]))
    objects[object_count++] = load(job->context, NULL, words[0], image);
  object_count = add_front(job->context, words[4], image, objects, object_count);
  job->rostrum = mount(job->context, objects, object_count, !is_none(words[0]));
  bench_job_open(job, side, side, "area", words[3], 1);
  job->file = count > 5 ? words[5] : NULL;
  bench_job_render(job);
  bench_job_measure(job);
}

/* ---------------------------------------------------------------- planes */

/* A plane of the film of 1920 x 1080: turned by 3 degrees each, seen through an ellipse, the
 * farther the smaller; the first fills the frame. */
static celspan_object *make_plane(celspan_context *context, const char *folder, int index) {
  static const char *const names[] = {"village.png", "canal.png", "wood.png"};
  const double width = 1920, height = 1080, scale = 0.6 + 0.08 * index;
  const celspan_picture_desc smooth = {.struct_size = sizeof smooth,
                                       .sampling = CELSPAN_SAMPLING_BILINEAR};
  celspan_image_desc image = {.struct_size = sizeof image,
                              .picture = &smooth,
                              .width = 1.6 * width,
                              .height = 1.6 * height};
  celspan_object *picture = load(context, folder, names[(index + 1) % 3], image);
  if (index == 0)
    return picture;
  celspan_object *operands[2], *clipped;
  picture = moved(context, picture, celspan_matrix_rotation(0.05 * index, (celspan_point){0, 0}));
  operands[0] = moved(context, picture, celspan_matrix_translation(-0.3 * width, -0.2 * height));
  celspan_ellipse_desc window = {
      .struct_size = sizeof window,
      .centre = {0.3 * width * (index % 4), height * (0.2 + index % 3 * 0.4)},
      .radius_x = 0.4 * width,
      .radius_y = 0.5 * height};
  bench_check(context, celspan_object_create_ellipse(context, &window, &operands[1]));
  bench_check(context,
              celspan_object_create_boolean(context, CELSPAN_OPERATOR_CLIP, operands, 2, &clipped));
  celspan_object_unref(operands[0]);
  celspan_object_unref(operands[1]);
  return moved(context, clipped, celspan_matrix_scaling(scale, scale));
}

void bench_planes(bench_frame_job *job, int count, char **words) {
  enum { PLANES = 12 };
  celspan_object *objects[PLANES];
  if (count != 2)
    bench_stop("planes FOLDER OUTPUT");
  for (int i = 0; i < PLANES; i++) {
    celspan_object *plane = make_plane(job->context, words[0], i);
    bench_check(job->context, celspan_object_fade(job->context, plane, 0.9, &objects[i]));
    celspan_object_unref(plane);
  }
  job->rostrum = mount(job->context, objects, PLANES, true);
  bench_job_open(job, BENCH_FRAME_WIDTH, BENCH_FRAME_HEIGHT, "area", words[1], 1);
  job->desc.film_width = 1920;
  job->desc.film_height = 1080;
  bench_job_render(job);
  bench_job_measure(job);
}
