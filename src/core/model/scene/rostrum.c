/* Rostrums: the description of a composition, checked, copied and hashed. */
#include "base/description.h"
#include "model/scene/scene.h"

#include "base/number.h"
#include "model/geometry/matrix.h"
#include "model/scene/check.h"
#include "model/scene/value.h"

/* ---------------------------------------------------------------- making */

static celspan_status check_cels(celspan_context *context, const celspan_rostrum_desc *desc) {
  CS_TRY(cs_check_list(context, "rostrum", "cels", desc->cels, desc->cel_count, CS_CHECK_ITEMS));
  for (size_t i = 0; i < desc->cel_count; i++)
    if (!desc->cels[i])
      return cs_fail(context, CELSPAN_BAD_ARGUMENT, "rostrum: cels[%zu] is missing", i + 1);
  return CELSPAN_OK;
}

static celspan_status check(celspan_context *context, const celspan_rostrum_desc *desc) {
  CS_TRY(check_cels(context, desc));
  if (desc->back_texture.texture && desc->back_texture.on == CELSPAN_LIGHT_ON_CEL)
    return cs_fail(
        context, CELSPAN_BAD_ARGUMENT,
        "rostrum: back cannot be on a cel, because it does not belong to one; put it on the "
        "frame");
  if (desc->has_size) {
    CS_TRY(cs_check_positive(context, "rostrum", "size.width", desc->width));
    CS_TRY(cs_check_positive(context, "rostrum", "size.height", desc->height));
  }
  CS_TRY(cs_check_size(context, "rostrum", "brightness", desc->brightness));
  CS_TRY(
      cs_check_choice(context, "rostrum", "space", (unsigned)desc->space, CELSPAN_SPACE_SRGB + 1));
  if (desc->has_camera_centre)
    CS_TRY(cs_check_point(context, "rostrum", "camera.centre", 0, desc->camera_centre));
  if (desc->has_camera_width)
    CS_TRY(cs_check_positive(context, "rostrum", "camera.width", desc->camera_width));
  return cs_check_number(context, "rostrum", "camera.rotate", desc->camera_radians);
}

void cs_rostrum_hash_own(cs_hash *hash, const celspan_rostrum *rostrum) {
  cs_hash_word(hash, rostrum->front.is_given);
  cs_light_hash(hash, &rostrum->front);
  cs_light_hash(hash, &rostrum->back);
  cs_hash_number(hash, rostrum->brightness);
  cs_hash_word(hash, rostrum->has_camera_centre);
  cs_value_hash_point(hash, rostrum->camera_centre);
  cs_hash_word(hash, rostrum->has_camera_width);
  cs_hash_number(hash, rostrum->camera_width);
  cs_hash_number(hash, rostrum->camera_radians);
  cs_antialias_hash(hash, &rostrum->antialias);
  if (rostrum->has_size)
    cs_value_hash_point(hash, (celspan_point){rostrum->width, rostrum->height});
  if (rostrum->space != CELSPAN_SPACE_AROUND)
    cs_hash_word(hash, rostrum->space);
  cs_grade_hash(hash, rostrum->grade);
  if (rostrum->grain)
    cs_hash_hash(hash, rostrum->grain->hash);
}

static cs_hash hash_rostrum(const celspan_rostrum *rostrum) {
  cs_hash hash = cs_hash_begin(CS_VALUE_ROSTRUM);
  cs_hash_word(&hash, rostrum->cel_count);
  for (size_t i = 0; i < rostrum->cel_count; i++)
    cs_hash_hash(&hash, rostrum->cels[i]->hash);
  cs_rostrum_hash_own(&hash, rostrum);
  return cs_hash_end(hash);
}

/* Fields without effect stay zero, so that rostrums that look the same have the same hash. */
static void fill(celspan_rostrum *rostrum, const celspan_rostrum_desc *desc) {
  rostrum->brightness = desc->brightness;
  rostrum->has_size = desc->has_size;
  if (desc->has_size) {
    rostrum->width = desc->width;
    rostrum->height = desc->height;
  }
  rostrum->has_camera_centre = desc->has_camera_centre;
  if (desc->has_camera_centre)
    rostrum->camera_centre = desc->camera_centre;
  rostrum->has_camera_width = desc->has_camera_width;
  if (desc->has_camera_width)
    rostrum->camera_width = desc->camera_width;
  rostrum->camera_radians = desc->camera_radians;
  rostrum->space = desc->space;
  rostrum->grade = celspan_grade_ref(desc->grade);
  rostrum->grain = celspan_texture_ref(desc->grain);
}

/* Makes the values that the rostrum keeps: the caller frees them, whatever the status. */
static celspan_status make_parts(celspan_context *context, const celspan_rostrum_desc *desc,
                                 celspan_rostrum *parts) {
  cs_light_desc front = {.noun = "rostrum",
                         .field = "front",
                         .is_given = desc->has_front,
                         .texture = &desc->front_texture,
                         .is_colour = desc->front_is_colour};
  const cs_light_desc back = {"rostrum",           "back", true, desc->back, &desc->back_texture,
                              desc->back_is_colour};
  if (desc->has_front)
    front.flat = (celspan_light){desc->front.r, desc->front.g, desc->front.b, 1};
  celspan_status status = cs_light_make(context, &front, &parts->front);
  if (status == CELSPAN_OK)
    status = cs_light_make(context, &back, &parts->back);
  if (status == CELSPAN_OK)
    status = cs_antialias_make(context, "rostrum: antialias", desc->antialias, desc->filter,
                               &parts->antialias);
  parts->cels = cs_mem_array(context->memory, desc->cel_count, sizeof(celspan_cel *));
  if (status == CELSPAN_OK && !parts->cels && desc->cel_count > 0)
    status = cs_fail_memory(context);
  parts->cel_count = parts->cels ? desc->cel_count : 0;
  for (size_t i = 0; i < parts->cel_count; i++)
    parts->cels[i] = celspan_cel_ref(desc->cels[i]);
  return status;
}

static void free_parts(celspan_rostrum *rostrum, cs_memory *memory) {
  for (size_t i = 0; i < rostrum->cel_count; i++)
    celspan_cel_unref(rostrum->cels[i]);
  cs_mem_free(memory, rostrum->cels, rostrum->cel_count * sizeof *rostrum->cels);
  cs_light_unref(&rostrum->front);
  cs_light_unref(&rostrum->back);
  celspan_grade_unref(rostrum->grade);
  celspan_texture_unref(rostrum->grain);
  cs_antialias_free(&rostrum->antialias, memory);
}

celspan_status celspan_rostrum_create(celspan_context *context, const celspan_rostrum_desc *desc,
                                      celspan_rostrum **out) {
  CS_READ(context, "rostrum", celspan_rostrum_desc, desc);
  CS_TRY(check(context, desc));
  celspan_rostrum *rostrum;
  CS_TRY(CS_MAKE(context, rostrum, 1));
  celspan_status status = make_parts(context, desc, rostrum);
  if (status != CELSPAN_OK) {
    free_parts(rostrum, context->memory);
    cs_mem_free(context->memory, rostrum, sizeof *rostrum);
    return status;
  }
  atomic_init(&rostrum->references, 1);
  rostrum->memory = cs_memory_ref(context->memory);
  rostrum->mark = cs_mark_now(context);
  fill(rostrum, desc);
  rostrum->hash = hash_rostrum(rostrum);
  *out = rostrum;
  return CELSPAN_OK;
}

/* A rostrum like `from`, with these cels, and with its own references; its hash is the hash of
 * `from`. mark: a reference that becomes the rostrum's; released on failure. */
static celspan_status copy(celspan_context *context, const celspan_rostrum *from,
                           celspan_cel *const *cels, size_t cel_count, cs_mark mark,
                           celspan_rostrum **out) {
  cs_memory *memory = context->memory;
  celspan_rostrum *rostrum = cs_mem_array(memory, 1, sizeof *rostrum);
  celspan_cel **own = cs_mem_array(memory, cel_count, sizeof *own);
  cs_antialias antialias = {0};
  celspan_status status = rostrum && (own || cel_count == 0)
                              ? cs_antialias_copy(context, &from->antialias, &antialias)
                              : cs_fail_memory(context);
  if (status != CELSPAN_OK) {
    cs_mem_free(memory, rostrum, sizeof *rostrum);
    cs_mem_free(memory, own, cel_count * sizeof *own);
    cs_mark_drop(mark);
    return status;
  }
  cs_value_copy(rostrum, from, sizeof *rostrum);
  rostrum->memory = cs_memory_ref(memory);
  rostrum->mark = mark;
  rostrum->cels = own;
  rostrum->cel_count = cel_count;
  for (size_t i = 0; i < cel_count; i++)
    own[i] = celspan_cel_ref(cels[i]);
  rostrum->front = cs_light_ref(&from->front);
  rostrum->back = cs_light_ref(&from->back);
  rostrum->grade = celspan_grade_ref(from->grade);
  rostrum->grain = celspan_texture_ref(from->grain);
  rostrum->antialias = antialias;
  *out = rostrum;
  return CELSPAN_OK;
}

celspan_status cs_rostrum_with(celspan_context *context, const celspan_rostrum *from,
                               celspan_cel *const *cels, size_t cel_count, celspan_rostrum **out) {
  return copy(context, from, cels, cel_count, cs_mark_keep(from->mark), out);
}

celspan_status cs_rostrum_change(celspan_context *context, const celspan_rostrum *from,
                                 celspan_cel *const *cels, size_t cel_count, cs_light back,
                                 celspan_rostrum **out) {
  celspan_rostrum *changed;
  CS_TRY(cs_rostrum_with(context, from, cels, cel_count, &changed));
  cs_light_unref(&changed->back);
  changed->back = back;
  changed->back.is_given = from->back.is_given;
  changed->hash = hash_rostrum(changed);
  *out = changed;
  return CELSPAN_OK;
}

celspan_status cs_rostrum_alone(celspan_context *context, celspan_object *object,
                                celspan_rostrum **out) {
  celspan_cel *cel;
  celspan_cel_desc one = CELSPAN_CEL_DESC;
  celspan_rostrum_desc desc = CELSPAN_ROSTRUM_DESC;
  one.objects = &object;
  one.object_count = 1;
  CS_TRY(celspan_cel_create(context, &one, &cel));
  desc.cels = &cel;
  desc.cel_count = 1;
  celspan_status status = celspan_rostrum_create(context, &desc, out);
  celspan_cel_unref(cel);
  return status;
}

celspan_status cs_rostrum_by_camera(celspan_context *context, const celspan_rostrum *from,
                                    const celspan_rostrum *by, celspan_rostrum **out) {
  celspan_rostrum *changed;
  CS_TRY(cs_rostrum_with(context, from, from->cels, from->cel_count, &changed));
  changed->has_camera_centre = by->has_camera_centre;
  changed->has_camera_width = by->has_camera_width;
  changed->camera_centre = by->camera_centre;
  changed->camera_width = by->camera_width;
  changed->camera_radians = by->camera_radians;
  changed->hash = hash_rostrum(changed);
  *out = changed;
  return CELSPAN_OK;
}

celspan_status celspan_rostrum_named(celspan_context *context, celspan_rostrum *rostrum,
                                     const char *name, celspan_rostrum **out) {
  CS_TRY(cs_check_given(context, "named", "the rostrum", rostrum));
  cs_mark mark;
  CS_TRY(cs_mark_named(context, rostrum->mark, name, &mark));
  return copy(context, rostrum, rostrum->cels, rostrum->cel_count, mark, out);
}

const char *celspan_rostrum_name(const celspan_rostrum *rostrum) {
  return cs_mark_name(rostrum->mark);
}

celspan_origin celspan_rostrum_origin(const celspan_rostrum *rostrum) {
  return cs_mark_origin(rostrum->mark);
}

static void destroy(celspan_rostrum *rostrum) {
  cs_memory *memory = rostrum->memory;
  free_parts(rostrum, memory);
  cs_mark_drop(rostrum->mark);
  cs_counted_free(memory, rostrum, sizeof *rostrum);
}

CS_COUNTED(celspan_rostrum)

void cs_rostrum_rehash(celspan_rostrum *rostrum) { rostrum->hash = hash_rostrum(rostrum); }

void celspan_rostrum_hash(const celspan_rostrum *rostrum, uint64_t out[2]) {
  cs_value_hash_give(rostrum->hash, out);
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
      matrix, celspan_matrix_rotation(-rostrum->camera_radians, (celspan_point){0, 0}));
  return celspan_matrix_then(matrix, celspan_matrix_translation(middle.x, middle.y));
}

static bool has_camera(const celspan_rostrum *rostrum) {
  return rostrum->has_camera_centre || rostrum->has_camera_width || rostrum->camera_radians != 0;
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
                   "cel %zu%s: its viewport and the camera together enlarge or reduce too far: all "
                   "places on the frame must be within %g units; give widths of a usual size",
                   cel_index + 1, cs_mark_describe(cel->mark).text, CS_NUMBER_LIMIT);
  *out = whole;
  return CELSPAN_OK;
}

cs_light cs_scene_front(const celspan_rostrum *rostrum, const celspan_cel *cel) {
  const cs_light white = {.is_given = true, .flat = {1, 1, 1, 1}, .coded = {1, 1, 1, 1}};
  const cs_light *front = cel->front.is_given       ? &cel->front
                          : rostrum->front.is_given ? &rostrum->front
                                                    : &white;
  return cs_light_scale(front, rostrum->brightness);
}

cs_light cs_scene_back(const celspan_rostrum *rostrum, const cs_light *back) {
  return cs_light_scale(back, rostrum->brightness);
}
