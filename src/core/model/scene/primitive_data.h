/* Primitive data, and the objects made of them.
 *
 *   object: matrix, fade --\
 *   object: matrix, fade ---+--> primitive data: outline + texture, or operands of a boolean
 *   object: matrix, fade --/
 *
 * Primitive data are an object without its transform and fade. Transformed and faded copies of an
 * object share them. Invariant: the data of a scan-line procedure have an outline too, the
 * rectangle of its bounds, so that geometry needs no special case.
 */
#pragma once

#include "model/scene/scene.h"

/* New, empty data, which the caller fills. texture: gets one more reference; NULL is opaque black.
 * Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_primitive_data_create(celspan_context *context,
                                                        cs_primitive_data_kind kind,
                                                        celspan_texture *texture,
                                                        cs_primitive_data **out);
void cs_primitive_data_unref(cs_primitive_data *data);

/* *out: a new object of data that have been filled, which it keeps. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_primitive_data_object(celspan_context *context,
                                                        cs_primitive_data *data,
                                                        celspan_object **out);
/* *out: new data of a boolean with these operands, to which it keeps references. look: its
 * properties. noun: for messages. Errors: NO_MEMORY, BAD_ARGUMENT, LIMIT. */
CELSPAN_CHECKED celspan_status cs_primitive_data_of_operands(celspan_context *context,
                                                             const char *noun,
                                                             const cs_boolean *look,
                                                             celspan_object *const *operands,
                                                             size_t count, cs_primitive_data **out);
/* Fills data of a rostrum, which is kept. frame: in the data's units. Errors: NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_primitive_data_fill_rostrum(celspan_context *context,
                                                              cs_primitive_data *data,
                                                              celspan_rostrum *rostrum,
                                                              const celspan_box *frame);

/* Hashes data that have been filled and wraps them into a new object, which takes the caller's
 * reference. status: whether filling them has succeeded; if not, or on failure here, the reference
 * is dropped. Errors: `status`, NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_primitive_data_wrap(celspan_context *context,
                                                      cs_primitive_data *data,
                                                      celspan_status status, celspan_object **out);

/* *out: the object with other data, in the same place, and with the same fade and mark. Errors:
 * NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_primitive_data_replace(celspan_context *context,
                                                         const celspan_object *object,
                                                         cs_primitive_data *data,
                                                         celspan_object **out);

/* *out: a primitive with an outline or a stroke, which both share from now on, in the same place,
 * and with the same fade and mark, with another texture, which is no pattern. Errors: NO_MEMORY,
 * LIMIT. */
CELSPAN_CHECKED celspan_status cs_primitive_data_repaint(celspan_context *context,
                                                         const celspan_object *object,
                                                         celspan_texture *texture,
                                                         celspan_object **out);

/* A primitive with an outline of its own making, whose arrays are taken over (and freed on
 * failure). Every coordinate of it passes cs_number_is_sane. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_primitive_data_of_outline(celspan_context *context,
                                                            cs_outline *outline, celspan_rule rule,
                                                            celspan_texture *texture,
                                                            celspan_object **out);
/* A stroke along a line, which is copied; `closed` says which of its contours are closed. Points,
 * data and outline of the description are ignored. Errors: NO_MEMORY, BAD_ARGUMENT, LIMIT. */
CELSPAN_CHECKED celspan_status cs_primitive_data_of_line(celspan_context *context,
                                                         const cs_outline *line,
                                                         const cs_outline_closed *closed,
                                                         const celspan_stroke_desc *desc,
                                                         celspan_object **out);
/* As cs_primitive_data_wrap, for data with this outline, whose bounds are found first. The outline
 * is copied, and freed in any case. */
CELSPAN_CHECKED celspan_status cs_primitive_data_complete(celspan_context *context,
                                                          cs_primitive_data *data,
                                                          cs_outline *outline,
                                                          celspan_status status,
                                                          celspan_object **out);
/* Completes an upright rectangle in the same way. */
CELSPAN_CHECKED celspan_status cs_primitive_data_complete_box(celspan_context *context,
                                                              cs_primitive_data *data,
                                                              const celspan_box *box,
                                                              celspan_object **out);
/* Gives data without an outline the outline of an upright rectangle. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_primitive_data_set_box(celspan_context *context,
                                                         cs_primitive_data *data,
                                                         const celspan_box *box);

/* The object as a group in a space, with the same place, mode and mark; the object itself if its
 * paints are not mixed, if it is a group with a space already, or for AROUND. Errors: NO_MEMORY,
 * LIMIT. */
CELSPAN_CHECKED celspan_status cs_object_in_space(celspan_context *context, celspan_object *object,
                                                  celspan_space space, celspan_object **out);

/* The object alone in a group with a grade of these fields. *out: new. Errors: NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_object_graded(celspan_context *context, celspan_object *object,
                                                const celspan_grade_desc *fields,
                                                celspan_object **out);

/* As celspan_object_create_rostrum, without the grain of the rostrum. margin: how far it is seen
 * beyond its frame. */
CELSPAN_CHECKED celspan_status cs_nested_create(celspan_context *context, celspan_rostrum *rostrum,
                                                double margin, celspan_object **out);

/* *out: an object that is a rostrum, in its place and with its fade and mark, with another rostrum
 * of the same size and depth. Errors: NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_nested_with(celspan_context *context,
                                              const celspan_object *object,
                                              celspan_rostrum *rostrum, celspan_object **out);

/* The names of the operators, in their order, and of mattes. */
extern const char *const cs_boolean_words[];

/* *out: a boolean of these operands, new, with the operator, mode, space, grade and isolation of
 * another. Errors: NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_boolean_like(celspan_context *context, const cs_boolean *like,
                                               celspan_object *const *operands, size_t count,
                                               celspan_object **out);

/* *out: a boolean like `object`, in its place and with its fade and mark, of these operands.
 * Errors: NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_boolean_with(celspan_context *context,
                                               const celspan_object *object,
                                               celspan_object *const *operands, size_t count,
                                               celspan_object **out);

/* As celspan_object_blend, but the object shows only where its backdrop is present, in the nearest
 * isolating group, and does not change the alpha of that group (CS_BLEND_WITHIN). */
CELSPAN_CHECKED celspan_status cs_object_blend_within(celspan_context *context,
                                                      celspan_object *object, celspan_blend mode,
                                                      celspan_object **out);
/* BAD_ARGUMENT when the data contain a procedure whose rows would not be parallel to the
 * frame's. */
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

/* Adds up the properties of a list's objects: their greatest depth, and the numbers of their
 * primitives and procedures. Errors: LIMIT. */
CELSPAN_CHECKED celspan_status cs_primitive_data_measure(celspan_context *context, const char *noun,
                                                         celspan_object *const *objects,
                                                         size_t count, cs_primitive_data *data);
/* Adds the level of the data themselves. Errors: LIMIT. */
CELSPAN_CHECKED celspan_status cs_primitive_data_deepen(celspan_context *context, const char *noun,
                                                        cs_primitive_data *data);
