#include "model/scene/nearby.h"

#include <math.h>

#include "base/description.h"
#include "model/scene/bounds.h"
#include "model/scene/check.h"
#include "model/scene/effect.h"
#include "model/scene/value.h"

/* ---------------------------------------------------------------- values */

static void hash_numbers(cs_hash *hash, const double *numbers, size_t count) {
  for (size_t i = 0; i < count; i++)
    cs_hash_number(hash, numbers[i]);
}

static void hash_light(cs_hash *hash, const cs_nearby_light *light) {
  const double numbers[] = {light->height, light->constant, light->exponent, light->focus,
                            light->cone};
  cs_hash_word(hash, light->source);
  cs_hash_word(hash, light->is_specular);
  hash_numbers(hash, numbers, sizeof numbers / sizeof *numbers);
  hash_numbers(hash, light->colour, 3);
  hash_numbers(hash, light->from, 3);
  hash_numbers(hash, light->towards, 3);
}

static cs_hash hash_nearby(const cs_nearby *nearby) {
  cs_hash hash = cs_hash_begin(CS_VALUE_NEARBY);
  const double numbers[] = {nearby->radius, nearby->amount, nearby->bias};
  const uint64_t words[] = {nearby->kind,
                            nearby->continues,
                            nearby->keeps_alpha,
                            (uint64_t)nearby->size[0],
                            (uint64_t)nearby->size[1],
                            (uint64_t)nearby->target[0],
                            (uint64_t)nearby->target[1]};
  for (size_t i = 0; i < sizeof words / sizeof *words; i++)
    cs_hash_word(&hash, words[i]);
  cs_value_hash_box(&hash, &nearby->box);
  hash_numbers(&hash, numbers, sizeof numbers / sizeof *numbers);
  hash_numbers(&hash, nearby->ground, 3);
  hash_light(&hash, &nearby->light);
  cs_hash_word(&hash, nearby->count);
  for (size_t i = 0; i < nearby->count; i++)
    cs_hash_number(&hash, (double)nearby->numbers[i]);
  return cs_hash_end(hash);
}

celspan_status cs_nearby_create(celspan_context *context, const cs_nearby *fields,
                                cs_nearby **out) {
  cs_nearby *made;
  float *numbers = NULL;
  if (fields->count > 0)
    CS_TRY(CS_MAKE(context, numbers, fields->count));
  made = cs_mem_array(context->memory, 1, sizeof *made);
  if (!made) {
    cs_mem_free(context->memory, numbers, fields->count * sizeof *numbers);
    return cs_fail_memory(context);
  }
  cs_value_copy(made, fields, sizeof *made);
  made->memory = cs_memory_ref(context->memory);
  made->numbers = numbers;
  if (fields->count > 0)
    memcpy(numbers, fields->numbers, fields->count * sizeof *numbers);
  made->hash = hash_nearby(made);
  *out = made;
  return CELSPAN_OK;
}

static void destroy(cs_nearby *nearby) {
  cs_memory *memory = nearby->memory;
  cs_mem_free(memory, (float *)nearby->numbers, nearby->count * sizeof *nearby->numbers);
  cs_counted_free(memory, nearby, sizeof *nearby);
}

CS_COUNTED(cs_nearby)

/* ---------------------------------------------------------------- objects */

/* The frame as a clear object, so that the rule acts on all of it. */
static celspan_status make_clear(celspan_context *context, const celspan_box *frame,
                                 celspan_object **out) {
  const celspan_paint clear = celspan_paint_rgb(0, 0, 0, 0);
  celspan_texture *texture;
  CS_TRY(celspan_texture_create_paint(context, &clear, &texture));
  const celspan_rect_desc desc = {sizeof desc,   frame->x, frame->y, frame->width,
                                  frame->height, 0,        texture};
  celspan_status status = celspan_object_create_rect(context, &desc, out);
  celspan_texture_unref(texture);
  return status;
}

celspan_status cs_nearby_apply(celspan_context *context, celspan_object *object, cs_nearby *nearby,
                               const celspan_box *frame, celspan_object **out) {
  celspan_object *objects[2] = {NULL, object};
  celspan_cel *cel = NULL;
  CS_TRY(make_clear(context, frame, &objects[0]));
  celspan_status status = cs_cel_of_pixels(context, objects, object ? 2 : 1, (cs_cel_reading){.nearby = nearby}, &cel);
  celspan_object_unref(objects[0]);
  if (status == CELSPAN_OK)
    status = cs_effect_compose(context, cel, frame, 1, out);
  celspan_cel_unref(cel);
  return status;
}

/* ---------------------------------------------------------------- sharpen */

/* How far pixels at the edge of an object may extend beyond it, in its units. */
#define EXTENT 2

/* For an object without a mode. */
static celspan_status add_sharpness(celspan_context *context, celspan_object *object,
                                    const void *user, celspan_object **out) {
  const celspan_sharpen_desc *desc = user;
  const cs_nearby fields = {
      .kind = CS_NEARBY_SHARPEN, .radius = desc->radius, .amount = desc->amount};
  celspan_box box = {0};
  cs_nearby *nearby;
  bool is_there;
  CS_TRY(cs_bounds_object(context, object, &is_there, &box));
  if (!is_there || !(box.width > 0 && box.height > 0)) {
    *out = celspan_object_ref(object);
    return CELSPAN_OK;
  }
  CS_TRY(cs_nearby_create(context, &fields, &nearby));
  const double beyond = EXTENT * fmax(1, desc->radius);
  const celspan_box frame = {box.x - beyond, box.y - beyond, box.width + 2 * beyond,
                             box.height + 2 * beyond};
  celspan_status status = cs_nearby_apply(context, object, nearby, &frame, out);
  cs_nearby_unref(nearby);
  return status;
}

celspan_status celspan_object_sharpen(celspan_context *context, celspan_object *object,
                                      const celspan_sharpen_desc *desc, celspan_object **out) {
  CS_READ(context, "sharpen", celspan_sharpen_desc, desc);
  CS_TRY(cs_check_given(context, "sharpen", "the object", object));
  CS_TRY(
      cs_check_range(context, "sharpen", "radius", desc->radius, 0, CELSPAN_SHARPEN_RADIUS_MOST));
  CS_TRY(cs_check_range(context, "sharpen", "amount", desc->amount, 0, CELSPAN_SHARPEN_MOST));
  if (desc->radius > 0 && desc->amount > 0)
    return cs_effect_make(context, object, add_sharpness, desc, out);
  *out = celspan_object_ref(object);
  return CELSPAN_OK;
}
