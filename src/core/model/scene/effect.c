#include "model/scene/effect.h"

#include "model/scene/primitive_data.h"

/* ---------------------------------------------------------------- modes */

celspan_status cs_effect_replace(celspan_object **object, celspan_status status,
                                 celspan_object *made) {
  CS_TRY(status);
  celspan_object_unref(*object);
  *object = made;
  return CELSPAN_OK;
}

celspan_status cs_effect_give_mode(celspan_context *context, celspan_object **object,
                                   celspan_blend mode) {
  celspan_object *made = NULL;
  celspan_status status = celspan_object_blend(context, *object, mode, &made);
  return cs_effect_replace(object, status, made);
}

/* Gives *object the mode of another object, which may be limited to the backdrop. */
static celspan_status give_mode_of(celspan_context *context, celspan_object **object,
                                   const celspan_object *like) {
  const celspan_blend mode = celspan_object_mode(like);
  celspan_object *made = NULL;
  if (cs_object_mode(like) == mode)
    return cs_effect_give_mode(context, object, mode);
  celspan_status status = cs_object_blend_within(context, *object, mode, &made);
  return cs_effect_replace(object, status, made);
}

/* Gives the mode, the name and the line of an object to the result of an effect, which was made of
 * the object without its mode. Does nothing if the effect has failed. */
static celspan_status finish(celspan_context *context, const celspan_object *object,
                             celspan_status status, celspan_object *made, celspan_object **out) {
  if (status == CELSPAN_OK)
    status = give_mode_of(context, &made, object);
  if (status != CELSPAN_OK) {
    celspan_object_unref(made);
    return status;
  }
  if (made != object) { /* both are equal if there was nothing to blur */
    cs_mark_drop(made->mark);
    made->mark = cs_mark_keep(object->mark);
  }
  *out = made;
  return CELSPAN_OK;
}

celspan_status cs_effect_make(celspan_context *context, celspan_object *object, cs_effect_maker add,
                              const void *desc, celspan_object **out) {
  celspan_object *plain, *made = NULL;
  CS_TRY(celspan_object_blend(context, object, CELSPAN_BLEND_NORMAL, &plain));
  celspan_status status = add(context, plain, desc, &made);
  celspan_object_unref(plain);
  return finish(context, object, status, made, out);
}

/* ---------------------------------------------------------------- compositions */

static celspan_status make_rostrum(celspan_context *context, celspan_cel *cel,
                                   const celspan_box *frame, double brightness,
                                   celspan_rostrum **out) {
  celspan_rostrum_desc fields = CELSPAN_ROSTRUM_DESC;
  fields.cels = &cel;
  fields.cel_count = 1;
  fields.has_size = true;
  fields.width = frame->width;
  fields.height = frame->height;
  fields.brightness = brightness;
  return celspan_rostrum_create(context, &fields, out);
}

celspan_status cs_effect_compose(celspan_context *context, celspan_cel *cel,
                                 const celspan_box *frame, double brightness,
                                 celspan_object **out) {
  const celspan_matrix matrix = celspan_matrix_translation(-frame->x, -frame->y);
  celspan_cel *moved;
  celspan_rostrum *rostrum = NULL;
  celspan_object *made = NULL;
  CS_TRY(celspan_cel_transform(context, cel, &matrix, &moved));
  celspan_status status = make_rostrum(context, moved, frame, brightness, &rostrum);
  celspan_cel_unref(moved);
  if (status == CELSPAN_OK)
    status = celspan_object_create_rostrum(context, rostrum, &made);
  celspan_rostrum_unref(rostrum);
  const celspan_matrix back = celspan_matrix_translation(frame->x, frame->y);
  if (status == CELSPAN_OK)
    status = celspan_object_transform(context, made, &back, out);
  celspan_object_unref(made);
  return status;
}
