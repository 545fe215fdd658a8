/* Bodies and the objects made of them.
 *
 * A data is what an object is before its transform and fade; transformed and faded copies share it.
 * Invariant: a scan-line data has an outline too, the rectangle of its bounds, so that geometry
 * needs no case for it.
 */
#ifndef CS_SCENE_PRIMITIVE_DATA_H
#define CS_SCENE_PRIMITIVE_DATA_H

#include "scene/scene.h"

/* A new data of nothing yet, to be filled by its maker. texture: kept; NULL is opaque black.
 * Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_primitive_data_create(celspan_context *context,
                                                        cs_primitive_data_kind kind,
                                                        celspan_texture *texture,
                                                        cs_primitive_data **out);
void cs_primitive_data_unref(cs_primitive_data *data);

/* Hashes a data that is filled, wraps it into a new object, and gives the caller's reference to it;
 * on failure, `status` that of filling it included, the data is let go. Errors: `status`,
 * NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_primitive_data_wrap(celspan_context *context,
                                                      cs_primitive_data *data,
                                                      celspan_status status, celspan_object **out);

/* BAD_ARGUMENT when a procedure takes part and its rows would not run along the frame's. */
CELSPAN_CHECKED celspan_status cs_primitive_data_check_placement(celspan_context *context,
                                                                 const cs_primitive_data *data,
                                                                 const celspan_matrix *matrix);

/* Copies a list, keeping every object; *out is NULL when count is 0. noun and field are for the
 * message. Errors: NO_MEMORY, BAD_ARGUMENT for an object that is NULL. */
CELSPAN_CHECKED celspan_status cs_primitive_data_list_copy(celspan_context *context,
                                                           const char *noun, const char *field,
                                                           celspan_object *const *objects,
                                                           size_t count, celspan_object ***out);
void cs_primitive_data_list_free(cs_memory *memory, celspan_object **objects, size_t count);

/* The box around a list's objects under a matrix; false when there is nothing. */
bool cs_primitive_data_list_bounds(celspan_object *const *objects, size_t count,
                                   const celspan_matrix *matrix, celspan_box *out);

#endif
