/* Objects of a cel as layers, trees and groups of a plan.
 *
 *      object                            plan
 *      primitive                         one layer
 *      union of unions                   layers: all that are present are painted
 *      other booleans                    layers, and the steps of a tree: what of them contributes
 *      faded boolean                     its layers are a group
 *      rostrum                           the layer of its frame, those of its lights and cels, and
 *                                        a step of a tree that cuts all of them at the frame
 */
#pragma once

#include "frames/render/compiler.h"

/* The state of the compiler outside of a group. */
typedef struct cs_objects_outside {
  uint32_t group;
  bool fades_out;
} cs_objects_outside;

/* Begins a group, unless it would do nothing. is_lit: by a front light with a shape. Errors:
 * NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_objects_begin_group(cs_compiler *c, double fade, bool is_lit,
                                                      cs_objects_outside *outer);
void cs_objects_end_group(cs_compiler *c, cs_objects_outside outer);
/* The objects of a list, rear first. Errors: NO_MEMORY, LIMIT, BAD_ARGUMENT. */
CELSPAN_CHECKED celspan_status cs_objects_add(cs_compiler *c, celspan_object *const *objects,
                                              size_t count, const celspan_matrix *matrix);
