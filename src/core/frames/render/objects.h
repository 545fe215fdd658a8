/* Objects of a cel as layers, trees and groups of a plan.
 *
 *      object                            plan
 *      primitive                         one layer
 *      union of unions                   layers: all that are present are painted
 *      other booleans                    layers, and the steps of a tree: which of them contribute
 *      faded boolean                     its layers are a group
 *      with a mode                       a source: its layers are the head of a ground, which holds
 *                                        all that is behind it in what isolates
 *      matte                             a group whose head is the matte
 *      rostrum                           the layer of its frame, those of its lights and cels, and
 *                                        a step of a tree that cuts all of them at the frame
 */
#pragma once

#include "frames/render/compiler.h"

/* The state of the compiler outside of a group, isolating or not. */
typedef struct cs_objects_outside {
  uint32_t group;
  bool fades_out;
  cs_compiler_isolation isolation;
  uint32_t begun; /* the group that was begun, or CS_STACK_NONE */
} cs_objects_outside;

/* Begins a group, unless it would do nothing. is_lit: by a front light with a shape. Errors:
 * NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_objects_begin_group(cs_compiler *c, double fade, bool is_lit,
                                                      cs_objects_outside *outer);
void cs_objects_end_group(cs_compiler *c, cs_objects_outside outer);

/* Begins a group for a grade (NULL: none), which ends like the groups above. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_objects_begin_grade(cs_compiler *c, const celspan_grade *grade,
                                                      cs_objects_outside *outer);

/* Begins the whole frame, before all else, in a space: a group if this is not the frame's space, or
 * if the frame has a grade. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_objects_begin_frame(cs_compiler *c, celspan_space space,
                                                      const celspan_grade *grade);

/* Begins an isolating group. blends: a source is inside that acts on its backdrop. is_frame: it is
 * the frame itself. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_objects_begin_isolation(cs_compiler *c, bool blends,
                                                          bool is_frame, cs_objects_outside *outer);
void cs_objects_end_isolation(cs_compiler *c, cs_objects_outside outer);

/* Layers appended from here on are lit by a front light with a shape. Parts between sources, and
 * groups with sources inside, are lit each by itself, so that modes act on lit colours. Errors:
 * NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_objects_begin_light(cs_compiler *c,
                                                      const struct cs_lights_front *light,
                                                      const cs_compiler_film *film);
/* Errors: NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_objects_end_light(cs_compiler *c);

/* Begins a source, which isolates. blends: as above, inside it. Errors: NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_objects_begin_source(cs_compiler *c, double fade, bool blends,
                                                       cs_objects_outside *outer);
/* Ends the source and gives it its mode. Errors: NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_objects_end_source(cs_compiler *c, celspan_blend mode,
                                                     cs_objects_outside outer);
/* The objects of a list, rear first. Errors: NO_MEMORY, LIMIT, BAD_ARGUMENT. */
CELSPAN_CHECKED celspan_status cs_objects_add(cs_compiler *c, celspan_object *const *objects,
                                              size_t count, const celspan_matrix *matrix);
