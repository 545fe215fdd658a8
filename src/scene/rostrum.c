#include "base/number.h"
#include "geometry/matrix.h"
#include "scene/check.h"
#include "scene/scene.h"
#include "scene/value.h"

/* ---------------------------------------------------------------- making */

static celspan_status check_cels(celspan_context *context, const celspan_rostrum_desc *desc) {
  if (desc->cel_count > 0)
    CS_TRY(cs_check_given(context, "rostrum", "cels", desc->cels));
  for (size_t i = 0; i < desc->cel_count; i++)
    if (!desc->cels[i])
      return cs_fail(context, CELSPAN_BAD_ARGUMENT, "rostrum: cels[%zu] is missing", i + 1);
  return CELSPAN_OK;
}

static celspan_status check(celspan_context *context, const celspan_rostrum_desc *desc) {
  CS_TRY(cs_check_given(context, "rostrum", "the description", desc));
  CS_TRY(cs_check_version(context, "rostrum", desc->struct_size, sizeof *desc));
  CS_TRY(check_cels(context, desc));
  if (desc->has_front)
    CS_TRY(cs_check_light(context, "rostrum", "front", &desc->front));
  CS_TRY(cs_check_light(context, "rostrum", "back", &desc->back));
  CS_TRY(cs_check_size(context, "rostrum", "brightness", desc->brightness));
  if (desc->has_camera_centre)
    CS_TRY(cs_check_point(context, "rostrum", "camera.centre", 0, desc->camera_centre));
  if (desc->has_camera_width)
    CS_TRY(cs_check_positive(context, "rostrum", "camera.width", desc->camera_width));
  return cs_check_number(context, "rostrum", "camera.rotate", desc->camera_rotation);
}

static cs_hash hash_rostrum(const celspan_rostrum *rostrum) {
  cs_hash hash = cs_hash_begin(CS_VALUE_ROSTRUM);
  cs_hash_word(&hash, rostrum->cel_count);
  for (size_t i = 0; i < rostrum->cel_count; i++)
    cs_hash_hash(&hash, rostrum->cels[i]->hash);
  cs_hash_word(&hash, rostrum->has_front);
  cs_value_hash_light(&hash, &rostrum->front);
  cs_value_hash_light(&hash, &rostrum->back);
  cs_hash_number(&hash, rostrum->brightness);
  cs_hash_word(&hash, rostrum->has_camera_centre);
  cs_value_hash_point(&hash, rostrum->camera_centre);
  cs_hash_word(&hash, rostrum->has_camera_width);
  cs_hash_number(&hash, rostrum->camera_width);
  cs_hash_number(&hash, rostrum->camera_rotation);
  cs_antialias_hash(&hash, &rostrum->antialias);
  return cs_hash_end(hash);
}

/* Fields without effect stay zero, so that rostrums that look the same have the same hash. */
static void fill(celspan_rostrum *rostrum, const celspan_rostrum_desc *desc) {
  rostrum->has_front = desc->has_front;
  if (desc->has_front)
    rostrum->front = (celspan_light){desc->front.r, desc->front.g, desc->front.b, 1};
  rostrum->back = desc->back;
  rostrum->brightness = desc->brightness;
  rostrum->has_camera_centre = desc->has_camera_centre;
  if (desc->has_camera_centre)
    rostrum->camera_centre = desc->camera_centre;
  rostrum->has_camera_width = desc->has_camera_width;
  if (desc->has_camera_width)
    rostrum->camera_width = desc->camera_width;
  rostrum->camera_rotation = desc->camera_rotation;
}

celspan_status celspan_rostrum_create(celspan_context *context, const celspan_rostrum_desc *desc,
                                      celspan_rostrum **out) {
  cs_antialias antialias;
  CS_TRY(check(context, desc));
  CS_TRY(
      cs_antialias_make(context, "rostrum: antialias", desc->antialias, &desc->filter, &antialias));
  celspan_cel **cels = cs_mem_array(context->memory, desc->cel_count, sizeof *cels);
  celspan_rostrum *rostrum = cs_mem_array(context->memory, 1, sizeof *rostrum);
  if (!rostrum || (!cels && desc->cel_count > 0)) {
    cs_mem_free(context->memory, cels, desc->cel_count * sizeof *cels);
    cs_mem_free(context->memory, rostrum, sizeof *rostrum);
    cs_antialias_free(&antialias, context->memory);
    return cs_fail_memory(context);
  }
  atomic_init(&rostrum->references, 1);
  rostrum->memory = cs_memory_ref(context->memory);
  rostrum->cels = cels;
  rostrum->cel_count = desc->cel_count;
  for (size_t i = 0; i < desc->cel_count; i++)
    cels[i] = celspan_cel_ref(desc->cels[i]);
  fill(rostrum, desc);
  rostrum->antialias = antialias;
  rostrum->hash = hash_rostrum(rostrum);
  *out = rostrum;
  return CELSPAN_OK;
}

celspan_rostrum *celspan_rostrum_ref(celspan_rostrum *rostrum) {
  cs_value_keep(&rostrum->references);
  return rostrum;
}

void celspan_rostrum_unref(celspan_rostrum *rostrum) {
  if (!rostrum || !cs_value_drop(&rostrum->references))
    return;
  cs_memory *memory = rostrum->memory;
  for (size_t i = 0; i < rostrum->cel_count; i++)
    celspan_cel_unref(rostrum->cels[i]);
  cs_mem_free(memory, rostrum->cels, rostrum->cel_count * sizeof *rostrum->cels);
  cs_antialias_free(&rostrum->antialias, memory);
  cs_mem_free(memory, rostrum, sizeof *rostrum);
  cs_memory_unref(memory);
}

void celspan_rostrum_hash(const celspan_rostrum *rostrum, uint64_t out[2]) {
  out[0] = rostrum->hash.a;
  out[1] = rostrum->hash.b;
}

/* ---------------------------------------------------------------- camera and lights */

/* Maps the box of a viewport to the film. */
static celspan_matrix viewport_matrix(const celspan_box *box, double film_width,
                                      double film_height) {
  return celspan_matrix_then(
      celspan_matrix_translation(-box->x, -box->y),
      celspan_matrix_scaling(film_width / box->width, film_height / box->height));
}

/* The view of the camera as a map of the film: the camera's centre goes to the centre of the film,
 * the film is enlarged, and turned against the camera's rotation. */
static celspan_matrix camera_matrix(const celspan_rostrum *rostrum, double film_width,
                                    double film_height) {
  celspan_point middle = {film_width / 2, film_height / 2};
  celspan_point centre = rostrum->has_camera_centre ? rostrum->camera_centre : middle;
  double scale = rostrum->has_camera_width ? film_width / rostrum->camera_width : 1;
  celspan_matrix matrix = celspan_matrix_translation(-centre.x, -centre.y);
  matrix = celspan_matrix_then(matrix, celspan_matrix_scaling(scale, scale));
  matrix = celspan_matrix_then(
      matrix, celspan_matrix_rotation(-rostrum->camera_rotation, (celspan_point){0, 0}));
  return celspan_matrix_then(matrix, celspan_matrix_translation(middle.x, middle.y));
}

static bool has_camera(const celspan_rostrum *rostrum) {
  return rostrum->has_camera_centre || rostrum->has_camera_width || rostrum->camera_rotation != 0;
}

celspan_matrix cs_scene_camera(const celspan_rostrum *rostrum, double film_width,
                               double film_height) {
  return has_camera(rostrum) ? camera_matrix(rostrum, film_width, film_height)
                             : celspan_matrix_identity();
}

celspan_matrix cs_scene_view(const celspan_rostrum *rostrum, const celspan_cel *cel,
                             double film_width, double film_height) {
  celspan_matrix view = celspan_matrix_identity();
  if (cel->has_viewport)
    view = viewport_matrix(&cel->viewport, film_width, film_height);
  return has_camera(rostrum)
             ? celspan_matrix_then(view, camera_matrix(rostrum, film_width, film_height))
             : view;
}

celspan_status cs_scene_cel_matrix(celspan_context *context, const celspan_rostrum *rostrum,
                                   size_t cel_index, double film_width, double film_height,
                                   celspan_matrix *out) {
  const celspan_cel *cel = rostrum->cels[cel_index];
  celspan_matrix view = cs_scene_view(rostrum, cel, film_width, film_height), inverse;
  celspan_matrix whole = celspan_matrix_then(cel->matrix, view);
  if (!cs_matrix_is_sane(&view) || !cs_matrix_is_sane(&whole) ||
      !celspan_matrix_inverse(view, &inverse))
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "cel %zu: its viewport and the camera together enlarge or reduce too far",
                   cel_index + 1);
  *out = whole;
  return CELSPAN_OK;
}

static celspan_light brightened(const celspan_rostrum *rostrum, celspan_light light) {
  float brightness = (float)rostrum->brightness;
  return (celspan_light){light.r * brightness, light.g * brightness, light.b * brightness, light.a};
}

celspan_light cs_scene_front(const celspan_rostrum *rostrum, const celspan_cel *cel) {
  const celspan_light white = {1, 1, 1, 1};
  return brightened(rostrum, cel->has_front       ? cel->front
                             : rostrum->has_front ? rostrum->front
                                                  : white);
}

celspan_light cs_scene_back(const celspan_rostrum *rostrum, celspan_light back) {
  return brightened(rostrum, back);
}
