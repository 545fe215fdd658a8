/* Soft layers: a defocused cel of a frame, its kernel brought to pixels, compiled alone.
 *
 * The kernel lies in film units on the frame after the cel's viewport; the camera enlarges and
 * turns it with the picture, and the frame's size scales each axis. A key of all that counts names
 * the layer's bands, so that a cel that did not change is not filtered again.
 */
#ifndef CS_DEFOCUS_LAYER_H
#define CS_DEFOCUS_LAYER_H

#include "defocus/defocus.h"

/* Where a cel stands in a frame. */
typedef struct cs_defocus_place {
  const celspan_rostrum *rostrum;
  size_t index;             /* of the cel */
  celspan_matrix to_pixels; /* film units to pixels */
  double film_width, film_height;
  celspan_matrix matrix;   /* the cel's units to pixels */
  cs_boundary_frame frame; /* what can be seen, with its margin */
  int32_t width, height;   /* pixels of the frame */
  bool is_antialiased;
} cs_defocus_place;

/* Whether the cel is defocused by enough to tell. */
bool cs_defocus_layer_is_soft(const cs_defocus_place *place);
/* *out: new; NULL when nothing can be seen. box: gets the rectangle, in whole pixels, that the
 * layer's art reaches. Errors: NO_MEMORY, and those of cs_compile_cel. */
CELSPAN_CHECKED celspan_status cs_defocus_layer_create(celspan_context *context,
                                                       const cs_defocus_place *place,
                                                       cs_outline *box, cs_defocus **out);
void cs_defocus_layer_free(cs_defocus *soften, cs_memory *memory);

#endif
