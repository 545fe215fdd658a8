/* Cels: checked, hashed, and made again with a transform, a fade or a name. */
#include <string.h>

#include "base/description.h"
#include "model/colour/blend.h"
#include "model/scene/check.h"
#include "model/scene/nearby.h"
#include "model/scene/primitive_data.h"
#include "model/scene/shift.h"
#include "model/scene/value.h"

static celspan_status check(celspan_context *context, const celspan_cel_desc *desc) {
  if (desc->has_viewport) {
    CS_TRY(cs_check_box(context, "cel", "viewport", &desc->viewport));
    CS_TRY(cs_check_positive(context, "cel", "viewport.width", desc->viewport.width));
    CS_TRY(cs_check_positive(context, "cel", "viewport.height", desc->viewport.height));
  }
  CS_TRY(cs_check_size(context, "cel", "defocus.radius", desc->defocus_radius));
  CS_TRY(cs_check_choice(context, "cel", "defocus.edge", (unsigned)desc->defocus_edge,
                         CELSPAN_BLUR_EXTEND + 1));
  CS_TRY(cs_check_choice(context, "cel", "defocus.kernel", (unsigned)desc->defocus_kernel,
                         CELSPAN_DEFOCUS_PIXEL + 1));
  return cs_check_choice(context, "cel", "blend", (unsigned)desc->blend, CS_BLEND_COUNT);
}

static void hash_objects(cs_hash *hash, const celspan_cel *cel) {
  cs_hash_word(hash, cel->object_count);
  for (size_t i = 0; i < cel->object_count; i++)
    cs_hash_hash(hash, cel->objects[i]->hash);
}

static void hash_placement(cs_hash *hash, const celspan_cel *cel) {
  cs_value_hash_matrix(hash, &cel->matrix);
  cs_hash_word(hash, cel->front.is_given);
  cs_light_hash(hash, &cel->front);
  cs_light_hash(hash, &cel->back);
  cs_hash_word(hash, cel->has_viewport);
  cs_value_hash_box(hash, &cel->viewport);
  cs_hash_number(hash, cel->defocus_radius);
  cs_hash_word(hash, cel->defocus_kernel);
  if (cel->defocus_edge != CELSPAN_BLUR_CLEAR)
    cs_hash_word(hash, cel->defocus_edge);
  cs_hash_number(hash, cel->opacity);
  if (cel->blend != CELSPAN_BLEND_NORMAL)
    cs_hash_word(hash, cel->blend);
  cs_grade_hash(hash, cel->grade);
  if (cel->shift)
    cs_hash_hash(hash, cel->shift->hash);
  if (cel->nearby)
    cs_hash_hash(hash, cel->nearby->hash);
}

static cs_hash hash_cel(const celspan_cel *cel) {
  cs_hash hash = cs_hash_begin(CS_VALUE_CEL);
  hash_objects(&hash, cel);
  hash_placement(&hash, cel);
  return cs_hash_end(hash);
}

bool celspan_cel_hash(const celspan_cel *cel, uint64_t drawing[2], uint64_t placement[2]) {
  cs_hash objects = cs_hash_begin(CS_VALUE_DATA), rest = cs_hash_begin(CS_VALUE_CEL);
  hash_objects(&objects, cel);
  hash_placement(&rest, cel);
  cs_value_hash_give(cs_hash_end(objects), drawing);
  cs_value_hash_give(cs_hash_end(rest), placement);
  for (size_t i = 0; i < cel->object_count; i++)
    if (cel->objects[i]->data->has_procedure)
      return false;
  return true;
}

static void find_modes(celspan_cel *cel) {
  memset(cel->blends_inside, 0, sizeof cel->blends_inside);
  cel->has_modes = cel->grade || cel->blend != CELSPAN_BLEND_NORMAL;
  for (size_t i = 0; i < cel->object_count; i++) {
    for (int space = CELSPAN_SPACE_LINEAR; space < CS_SPACES; space++)
      cel->blends_inside[space] |= cs_object_blends(cel->objects[i], (celspan_space)space);
    cel->has_modes |= cs_object_has_modes(cel->objects[i]);
  }
}

/* A new cel with the fields of `fields`, and with references of its own to lights and objects.
 * mark: a reference that the cel takes; dropped on failure. */
static celspan_status create(celspan_context *context, const celspan_cel *fields,
                             celspan_object *const *objects, size_t object_count, cs_mark mark,
                             celspan_cel **out) {
  celspan_object **copies = NULL;
  celspan_status status =
      cs_primitive_data_list_copy(context, "cel", "objects", objects, object_count, &copies);
  celspan_cel *cel = NULL;
  if (status == CELSPAN_OK)
    status = CS_MAKE(context, cel, 1);
  if (status != CELSPAN_OK) {
    if (copies)
      cs_primitive_data_list_free(context->memory, copies, object_count);
    cs_mark_drop(mark);
    return status;
  }
  cs_value_copy(cel, fields, sizeof *cel);
  cel->mark = mark;
  cel->objects = copies;
  cel->memory = cs_memory_ref(context->memory);
  cel->front = cs_light_ref(&fields->front);
  cel->back = cs_light_ref(&fields->back);
  cel->grade = celspan_grade_ref(fields->grade);
  cel->shift = cs_shift_ref(fields->shift);
  cel->nearby = cs_nearby_ref(fields->nearby);
  cel->object_count = object_count;
  find_modes(cel);
  cel->hash = hash_cel(cel);
  *out = cel;
  return CELSPAN_OK;
}

/* Fields without effect stay zero, so that cels that look the same have the same hash. */
static celspan_status make_lights(celspan_context *context, const celspan_cel_desc *desc,
                                  cs_light *front, cs_light *back) {
  cs_light_desc given = {.noun = "cel",
                         .field = "front",
                         .is_given = desc->has_front,
                         .texture = &desc->front_texture,
                         .is_colour = desc->front_is_colour};
  if (desc->has_front)
    given.flat = (celspan_light){desc->front.r, desc->front.g, desc->front.b, 1};
  CS_TRY(cs_light_make(context, &given, front));
  given =
      (cs_light_desc){"cel", "back", true, desc->back, &desc->back_texture, desc->back_is_colour};
  celspan_status status = cs_light_make(context, &given, back);
  if (status != CELSPAN_OK)
    cs_light_unref(front);
  return status;
}

celspan_status celspan_cel_create(celspan_context *context, const celspan_cel_desc *desc,
                                  celspan_cel **out) {
  CS_READ(context, "cel", celspan_cel_desc, desc);
  CS_TRY(check(context, desc));
  celspan_cel fields = {
      .matrix = celspan_matrix_identity(),
      .has_viewport = desc->has_viewport,
      .defocus_radius = desc->defocus_radius,
      .defocus_kernel = desc->defocus_radius > 0 ? desc->defocus_kernel : CELSPAN_DEFOCUS_GAUSSIAN,
      .defocus_edge = desc->defocus_radius > 0 ? desc->defocus_edge : CELSPAN_BLUR_CLEAR,
      .blend = desc->blend,
      .grade = desc->grade,
  };
  CS_TRY(cs_check_share(context, "cel", "opacity", desc->opacity, &fields.opacity));
  if (desc->has_viewport)
    fields.viewport = desc->viewport;
  CS_TRY(make_lights(context, desc, &fields.front, &fields.back));
  celspan_status status =
      create(context, &fields, desc->objects, desc->object_count, cs_mark_now(context), out);
  cs_light_unref(&fields.front);
  cs_light_unref(&fields.back);
  return status;
}

celspan_status celspan_cel_transform(celspan_context *context, celspan_cel *cel,
                                     const celspan_matrix *matrix, celspan_cel **out) {
  CS_TRY(cs_check_given(context, "transform", "the cel", cel));
  celspan_cel fields;
  cs_value_copy(&fields, cel, sizeof fields);
  CS_TRY(cs_check_transform(context, &cel->matrix, matrix, &fields.matrix));
  for (size_t i = 0; i < cel->object_count; i++)
    CS_TRY(cs_primitive_data_check_placement(context, cel->objects[i]->data, &fields.matrix));
  return create(context, &fields, cel->objects, cel->object_count, cs_mark_keep(cel->mark), out);
}

celspan_status celspan_cel_fade(celspan_context *context, celspan_cel *cel, double k,
                                celspan_cel **out) {
  CS_TRY(cs_check_given(context, "fade", "the cel", cel));
  CS_TRY(cs_check_share(context, "fade", "k", k, &k));
  celspan_cel fields;
  cs_value_copy(&fields, cel, sizeof fields);
  fields.opacity *= k;
  return create(context, &fields, cel->objects, cel->object_count, cs_mark_keep(cel->mark), out);
}

celspan_status celspan_cel_named(celspan_context *context, celspan_cel *cel, const char *name,
                                 celspan_cel **out) {
  CS_TRY(cs_check_given(context, "named", "the cel", cel));
  cs_mark mark;
  CS_TRY(cs_mark_named(context, cel->mark, name, &mark));
  return create(context, cel, cel->objects, cel->object_count, mark, out);
}

celspan_status cs_cel_bare(celspan_context *context, const celspan_cel *cel, cs_cel_without without,
                           celspan_cel **out) {
  celspan_cel fields;
  cs_value_copy(&fields, cel, sizeof fields);
  if (without.lights) {
    fields.front = (cs_light){.is_given = true, .flat = {1, 1, 1, 1}, .coded = {1, 1, 1, 1}};
    fields.back = (cs_light){.is_given = true};
  }
  if (without.defocus) {
    fields.defocus_radius = 0;
    fields.defocus_kernel = CELSPAN_DEFOCUS_GAUSSIAN;
    fields.defocus_edge = CELSPAN_BLUR_CLEAR;
    fields.shift = NULL;
    fields.nearby = NULL;
  }
  if (without.mixing) {
    fields.opacity = 1;
    fields.blend = CELSPAN_BLEND_NORMAL;
  }
  return create(context, &fields, cel->objects, cel->object_count, cs_mark_keep(cel->mark), out);
}

celspan_status cs_cel_with(celspan_context *context, const celspan_cel *cel,
                           celspan_object *const *objects, size_t count, celspan_cel **out) {
  return create(context, cel, objects, count, cs_mark_keep(cel->mark), out);
}

celspan_status cs_cel_of_pixels(celspan_context *context, celspan_object *const *objects,
                                size_t count, cs_cel_reading reading, celspan_cel **out) {
  const celspan_cel fields = {.matrix = celspan_matrix_identity(),
                              .defocus_radius = 1,
                              .defocus_kernel = CELSPAN_DEFOCUS_PIXEL,
                              .opacity = 1,
                              .shift = reading.shift,
                              .nearby = reading.nearby};
  return create(context, &fields, objects, count, cs_mark_now(context), out);
}

celspan_blend celspan_cel_mode(const celspan_cel *cel) { return cel->blend; }

const char *celspan_cel_name(const celspan_cel *cel) { return cs_mark_name(cel->mark); }

celspan_origin celspan_cel_origin(const celspan_cel *cel) { return cs_mark_origin(cel->mark); }

static void destroy(celspan_cel *cel) {
  cs_memory *memory = cel->memory;
  cs_primitive_data_list_free(memory, cel->objects, cel->object_count);
  cs_light_unref(&cel->front);
  cs_light_unref(&cel->back);
  celspan_grade_unref(cel->grade);
  cs_shift_unref(cel->shift);
  cs_nearby_unref(cel->nearby);
  cs_mark_drop(cel->mark);
  cs_counted_free(memory, cel, sizeof *cel);
}

CS_COUNTED(celspan_cel)
