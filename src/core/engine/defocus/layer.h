/* One defocused cel of a frame: its blur brought to pixels, and its art compiled alone.
 *
 *   rostrum --viewport, camera, frame size--> blur in pixels --pitch--> grid over the frame
 *
 *        frame                          the art's own box on the frame        ....
 *      +------------------------+       grown by the blur                     +--+
 *      |      +----------+      |
 *      |      | ........ |      |       The layer is present in the grown box, in whole pixels,
 *      |      | :  art : |      |       cut to the frame. There its paint is read from the nodes of
 *      |      | :......: |      |       the grid; elsewhere it is clear.
 *      |      +----------+      |
 *      +------------------------+
 *
 * The blur is given in film units, on the frame as the cel's viewport leaves it. The camera
 * enlarges and turns the blur with the picture, and the frame's size scales each axis.
 *
 * A key over everything that the nodes depend on names the layer's bands, so that a cel that did
 * not change from one frame to the next is not blurred again.
 *
 * The compiler of frames (frames/render/compile.c) calls this room, and the art is compiled by that
 * same compiler, which comes as a callback. A cel that is compiled alone is compiled without its
 * blur; a composition inside it may hold defocused cels of its own, level by level.
 */
#pragma once

#include "base/hash_table.h"
#include "engine/defocus/own_grid.h"

/* A job for the compiler: one cel alone, without its opacity, onto a raster of its own. It is lit
 * by white light, from the front only or (is_through) from behind only. */
typedef struct cs_defocus_job {
  const celspan_cel *cel;
  celspan_matrix matrix; /* the cel's units to the raster's pixels */
  int32_t width, height; /* the width and height of the raster, pixels */
  bool is_through;
  cs_kernel *kernel; /* the compiler owns it from now on; NULL: the mean over each pixel */
} cs_defocus_job;

/* The blurred layers of a frame, by keys. A cel that is seen in several places, such as a glow in
 * the glow of a glow, is compiled once, so that the work does not double with each level of
 * nesting. All zero is empty. */
typedef struct cs_defocus_made {
  cs_hash_table numbers;
  CS_ARRAY(cs_defocus *, list);
  size_t count;
} cs_defocus_made;

void cs_defocus_made_finish(cs_defocus_made *made, celspan_context *context);

typedef struct cs_defocus_compiler {
  celspan_status (*compile)(void *user, const cs_defocus_job *job, cs_plan *out);
  void *user;
  cs_defocus_made *made; /* the layers that have been made for the frame until now */
} cs_defocus_compiler;

/* Whether the blur of the cel is large enough to be visible. */
bool cs_defocus_layer_is_needed(const cs_defocus_cel *place);
/* *out: a new layer, or a reference to one that was made before; NULL when nothing can be seen.
 * box: gets the rectangle, in whole pixels, in which the layer is present. Errors: NO_MEMORY, and
 * those of the compiler. */
CELSPAN_CHECKED celspan_status cs_defocus_layer_create(celspan_context *context,
                                                       const cs_defocus_cel *place,
                                                       const cs_defocus_compiler *compiler,
                                                       cs_outline *box, cs_defocus **out);
void cs_defocus_layer_unref(cs_defocus *defocus, cs_memory *memory);
/* Frees the contents of a plan, including its defocused cels. */
void cs_defocus_layer_free_plan(cs_plan *plan, cs_memory *memory);
