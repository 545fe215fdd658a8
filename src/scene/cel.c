#include "base/number.h"
#include "scene/check.h"
#include "scene/primitive_data.h"
#include "scene/value.h"

static celspan_status check(celspan_context *context, const celspan_cel_desc *desc) {
  CS_TRY(cs_check_given(context, "cel", "the description", desc));
  CS_TRY(cs_check_version(context, "cel", desc->struct_size, sizeof *desc));
  if (desc->has_front)
    CS_TRY(cs_check_light(context, "cel", "front", &desc->front));
  CS_TRY(cs_check_light(context, "cel", "back", &desc->back));
  if (desc->has_viewport) {
    CS_TRY(cs_check_box(context, "cel", "viewport", &desc->viewport));
    CS_TRY(cs_check_positive(context, "cel", "viewport.width", desc->viewport.width));
    CS_TRY(cs_check_positive(context, "cel", "viewport.height", desc->viewport.height));
  }
  CS_TRY(cs_check_size(context, "cel", "defocus.radius", desc->defocus_radius));
  CS_TRY(cs_check_choice(context, "cel", "defocus.kernel", (unsigned)desc->defocus_kernel,
                         CELSPAN_DEFOCUS_DISC + 1));
  return cs_check_share(context, "cel", "opacity", desc->opacity);
}

static cs_hash hash_cel(const celspan_cel *cel) {
  cs_hash hash = cs_hash_begin(CS_VALUE_CEL);
  cs_hash_word(&hash, cel->object_count);
  for (size_t i = 0; i < cel->object_count; i++)
    cs_hash_hash(&hash, cel->objects[i]->hash);
  cs_value_hash_matrix(&hash, &cel->matrix);
  cs_hash_word(&hash, cel->has_front);
  cs_value_hash_light(&hash, &cel->front);
  cs_value_hash_light(&hash, &cel->back);
  cs_hash_word(&hash, cel->has_viewport);
  cs_value_hash_box(&hash, &cel->viewport);
  cs_hash_number(&hash, cel->defocus_radius);
  cs_hash_word(&hash, cel->defocus_kernel);
  cs_hash_number(&hash, cel->opacity);
  return cs_hash_end(hash);
}

/* A new cel with the fields of `fields` and with copies of the objects. */
static celspan_status create(celspan_context *context, const celspan_cel *fields,
                             celspan_object *const *objects, size_t object_count,
                             celspan_cel **out) {
  celspan_cel *cel = cs_mem_array(context->memory, 1, sizeof *cel);
  if (!cel)
    return cs_fail_memory(context);
  *cel = *fields;
  celspan_status status =
      cs_primitive_data_list_copy(context, "cel", "objects", objects, object_count, &cel->objects);
  if (status != CELSPAN_OK) {
    cs_mem_free(context->memory, cel, sizeof *cel);
    return status;
  }
  atomic_init(&cel->references, 1);
  cel->memory = cs_memory_ref(context->memory);
  cel->object_count = object_count;
  cel->hash = hash_cel(cel);
  *out = cel;
  return CELSPAN_OK;
}

celspan_status celspan_cel_create(celspan_context *context, const celspan_cel_desc *desc,
                                  celspan_cel **out) {
  CS_TRY(check(context, desc));
  celspan_cel fields = {
      .matrix = celspan_matrix_identity(),
      .has_front = desc->has_front,
      .has_viewport = desc->has_viewport,
      .back = desc->back,
      .defocus_radius = desc->defocus_radius,
      .defocus_kernel = desc->defocus_radius > 0 ? desc->defocus_kernel : CELSPAN_DEFOCUS_GAUSSIAN,
      .opacity = desc->opacity,
  };
  /* Fields without effect stay zero, so that cels that look the same have the same hash. */
  if (desc->has_front)
    fields.front = (celspan_light){desc->front.r, desc->front.g, desc->front.b, 1};
  if (desc->has_viewport)
    fields.viewport = desc->viewport;
  return create(context, &fields, desc->objects, desc->object_count, out);
}

celspan_status celspan_cel_transform(celspan_context *context, celspan_cel *cel,
                                     const celspan_matrix *matrix, celspan_cel **out) {
  CS_TRY(cs_check_given(context, "transform", "the cel", cel));
  celspan_cel fields = *cel;
  CS_TRY(cs_check_transform(context, &cel->matrix, matrix, &fields.matrix));
  for (size_t i = 0; i < cel->object_count; i++)
    CS_TRY(cs_primitive_data_check_placement(context, cel->objects[i]->data, &fields.matrix));
  return create(context, &fields, cel->objects, cel->object_count, out);
}

celspan_status celspan_cel_fade(celspan_context *context, celspan_cel *cel, double k,
                                celspan_cel **out) {
  CS_TRY(cs_check_given(context, "fade", "the cel", cel));
  CS_TRY(cs_check_share(context, "fade", "k", k));
  celspan_cel fields = *cel;
  fields.opacity *= k;
  return create(context, &fields, cel->objects, cel->object_count, out);
}

celspan_cel *celspan_cel_ref(celspan_cel *cel) {
  cs_value_keep(&cel->references);
  return cel;
}

void celspan_cel_unref(celspan_cel *cel) {
  if (!cel || !cs_value_drop(&cel->references))
    return;
  cs_memory *memory = cel->memory;
  cs_primitive_data_list_free(memory, cel->objects, cel->object_count);
  cs_mem_free(memory, cel, sizeof *cel);
  cs_memory_unref(memory);
}
