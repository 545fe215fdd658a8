/* The lights of a film as parts of a plan.
 *
 *   what it is                what it becomes
 *   front light, flat         the front of each layer
 *   front light with a shape  a layer in front of its group, which it lights
 *   back light, flat          a light between layers (engine/compose/over.h); inside an object, a
 *                             flat layer of the frame, whose matte is of the layer of the frame
 *   back light with a shape   a layer as large as the film whose pigments add to the light; for
 *                             its matte another one, behind all others of the film, because a matte
 *                             dims nothing that the film shows
 *
 *       camera   cel 1   back light of cel 1   cel 0   rear light   mattes   the matte of an object
 *         <--------|-------------|---------------|----------|----------|------------------ light
 */
#pragma once

#include "frames/render/compiler.h"

/* The share of transparency that the mattes of a rostrum's flat back lights leave together. */
float cs_lights_keep(const celspan_rostrum *rostrum);
/* Adds the mattes of the rostrum's back lights that have a shape; in an object whose cels have
 * modes, also those of flat back lights. Mattes of lights in front come first, so that the mattes
 * behind a cel are a range. firsts: gets where the range of each cel begins; its own light is
 * behind it. Errors: NO_MEMORY, LIMIT, BAD_ARGUMENT. */
CELSPAN_CHECKED celspan_status cs_lights_add_mattes(cs_compiler *c, const celspan_rostrum *rostrum,
                                                    const cs_compiler_film *film, uint32_t *firsts);
/* A back light that shines on every layer appended from now on. index: of its cel. Errors: as
 * above.
 */
CELSPAN_CHECKED celspan_status cs_lights_add_back(cs_compiler *c, const celspan_rostrum *rostrum,
                                                  size_t index, const cs_light *back,
                                                  const cs_compiler_film *film);

/* A flat back light of the whole plane, between the layers appended so far and those to come.
 * Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_lights_add_flat(cs_compiler *c, celspan_light light);

/* A front light with a shape, in its place. */
typedef struct cs_lights_front {
  bool is_shape;
  cs_light light; /* brightness included; borrowed */
  celspan_matrix inverse;
} cs_lights_front;

/* Sets the front light of the layers that follow to a cel's. Errors: BAD_ARGUMENT. */
CELSPAN_CHECKED celspan_status cs_lights_set_front(cs_compiler *c, const celspan_rostrum *rostrum,
                                                   size_t index, const cs_compiler_film *film,
                                                   cs_lights_front *out);
/* Lights the compiler's group, whose layers have all been appended, by a front light with a shape.
 * Errors: NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_lights_light_group(cs_compiler *c, const cs_lights_front *front,
                                                     const cs_compiler_film *film);
