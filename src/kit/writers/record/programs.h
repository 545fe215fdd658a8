/* Programs of a plane: the composer's programs, layer by layer, in the form that a plane file
 * keeps.
 *
 *     items of a program      gradient   flat  | gradient  flat |   flat     a faded group
 *     steps of the plane      ramp       flat  enter ramp  flat  leave  flat
 *
 * Gradients are ramps along axes, which lie on the frame whatever its size, and so are pictures
 * (pictures.h). Glass, front lights with a shape, mattes, multiply and screen are veils. All
 * else, such as a grade or another mode, can be kept where only one gradient is in the
 * program: then all that shows is a function of the place along it, and is tabulated.
 *
 * Invariant: a program of the plane shows the same as the composer's program, within 1/16384.
 */
#pragma once

#include "inside/frames.h"
#include "inside/hash.h"
#include "writers/record/recording.h"

/* The source of a program. */
typedef struct cs_record_source {
  celspan_context *context;
  const cs_stack *stack;
  struct cs_defocus *const *defocus; /* the defocus of the defocused layers */
  float weight;                      /* the weight of everything that is made */
  bool is_coded;                     /* what is shown becomes 8-bit codes */
  /* for each shade, then each image, then each defocused layer: the number of its axis in the
   * record plus 1; 0: it has no axis yet */
  uint32_t *axes;
  cs_hash_table *known; /* the numbers of axes in the record, by what they are */
} cs_record_source;

/* Appends the program's steps, and the values that they need, to a record. Errors: NO_MEMORY;
 * BAD_ARGUMENT if a plane cannot store the program. */
CELSPAN_CHECKED celspan_status cs_record_program(const cs_record_source *source,
                                                 const cs_program *program, cs_recording *record,
                                                 planefile_program *out);

/* *out: the number of the axis of a layer in the record, to which it is added if it is new. Errors:
 * NO_MEMORY; BAD_ARGUMENT if a plane cannot store the layer; those of its picture. */
CELSPAN_CHECKED celspan_status cs_record_axis(const cs_record_source *source, cs_recording *record,
                                              const cs_layer *layer, uint32_t *out);

/* Of what a program of a record shows. */
cs_hash cs_record_program_hash(const cs_recording *record, const planefile_program *program);
