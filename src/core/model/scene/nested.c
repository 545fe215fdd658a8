/* A rostrum as an object: a composition inside another one.
 *
 *    film of the outer rostrum
 *    +--------------------------------+
 *    |        ...-----.               |     The object is present in the frame of the inner
 *    |     .-+---------+-.            |     rostrum, {0, 0, width, height}. Cels that reach beyond
 *    |    :  | frame   |  :           |     the frame are clipped at it. The frame is placed by the
 *    |     `-+---------+-'  cels      |     object's matrix, like any outline.
 *    |        `-----'''               |
 *    +--------------------------------+
 *
 * Values are immutable, so no rostrum can contain itself.
 */
#include <string.h>

#include "model/scene/primitive_data.h"
#include "model/scene/shift.h"

static celspan_status check(celspan_context *context, const celspan_rostrum *rostrum) {
  celspan_matrix matrix;
  if (!rostrum->has_size)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "rostrum: size is missing; a rostrum that is used as an object needs one");
  for (size_t i = 0; i < rostrum->cel_count; i++)
    CS_TRY(cs_scene_cel_matrix(context, rostrum, i, rostrum->width, rostrum->height, &matrix));
  return CELSPAN_OK;
}

/* The sums over the objects of all cels. */
static celspan_status measure(celspan_context *context, cs_primitive_data *data) {
  data->primitive_count = 1; /* the frame */
  data->piece_count = CS_SHAPE_PIECES;
  for (size_t i = 0; i < data->rostrum->cel_count; i++) {
    const celspan_cel *cel = data->rostrum->cels[i];
    CS_TRY(cs_primitive_data_measure(context, "rostrum", cel->objects, cel->object_count, data));
    if (cel->shift && cel->shift->by)
      CS_TRY(cs_primitive_data_measure(context, "rostrum", cel->shift->by->objects, 1, data));
  }
  memset(data->blends, 0, sizeof data->blends); /* it isolates */
  data->has_modes = false;
  return cs_primitive_data_deepen(context, "rostrum", data);
}

celspan_status cs_primitive_data_fill_rostrum(celspan_context *context, cs_primitive_data *data,
                                              celspan_rostrum *rostrum, const celspan_box *frame) {
  data->rostrum = celspan_rostrum_ref(rostrum);
  data->bounds = *frame;
  CS_TRY(cs_primitive_data_set_box(context, data, &data->bounds));
  return measure(context, data);
}

celspan_status cs_nested_create(celspan_context *context, celspan_rostrum *rostrum, double margin,
                                celspan_object **out) {
  CS_TRY(check(context, rostrum));
  const celspan_box frame = {-margin, -margin, rostrum->width + 2 * margin,
                             rostrum->height + 2 * margin};
  cs_primitive_data *data;
  CS_TRY(cs_primitive_data_create(context, CS_PRIMITIVE_DATA_ROSTRUM, NULL, &data));
  celspan_status status = cs_primitive_data_fill_rostrum(context, data, rostrum, &frame);
  CS_TRY(cs_primitive_data_wrap(context, data, status, out));
  (*out)->mark = cs_mark_keep(rostrum->mark); /* this replaces a mark that has no name */
  return CELSPAN_OK;
}

static celspan_status fill_like(celspan_context *context, const cs_primitive_data *from,
                                celspan_rostrum *rostrum, cs_primitive_data *data) {
  CS_TRY(cs_primitive_data_fill_rostrum(context, data, rostrum, &from->bounds));
  data->depth = from->depth;
  if (!from->repeat)
    return CELSPAN_OK;
  CS_TRY(CS_MAKE(context, data->repeat, 1));
  *data->repeat = *from->repeat;
  return CELSPAN_OK;
}

celspan_status cs_nested_with(celspan_context *context, const celspan_object *object,
                              celspan_rostrum *rostrum, celspan_object **out) {
  cs_primitive_data *data;
  celspan_object *plain;
  CS_TRY(cs_primitive_data_create(context, CS_PRIMITIVE_DATA_ROSTRUM, NULL, &data));
  celspan_status status = fill_like(context, object->data, rostrum, data);
  CS_TRY(cs_primitive_data_wrap(context, data, status, &plain));
  status = cs_primitive_data_replace(context, object, plain->data, out);
  celspan_object_unref(plain);
  return status;
}
