/* Pictures of a plane: the pictures that its cells show, with the places of their pixels on the
 * frame, and the grids of defocused cels, which are pictures, too: a node is a pixel.
 *
 *     image layer --matrix--> axis of the plane       its picture --rows, when they are
 *                             place on the picture                  written--> pixels
 *
 * Pixels are asked for when the plane is written, so that a film reads a picture once. Where 8 bits
 * in sRGB are all that a picture has, its codes are kept, else its light.
 *
 * A defocused cel whose look does not depend on the frame's size has a grid of its own. Other blurs
 * are bound to a size.
 *
 * Invariant: a picture of the record names its pixels by its key.
 */
#pragma once

#include "inside/frames.h"
#include "writers/record/recording.h"

/* The picture by which an image layer is recorded. Errors: NO_MEMORY, and those of reading the
 * header. */
CELSPAN_CHECKED celspan_status cs_record_image(celspan_context *context,
                                               const cs_image_layer *image, cs_recording *record,
                                               planefile_axis *out);
/* The picture by which a defocused layer is recorded. Errors: NO_MEMORY; BAD_ARGUMENT for a layer
 * that a plane cannot store; LIMIT for too many nodes. */
CELSPAN_CHECKED celspan_status cs_record_defocused(celspan_context *context,
                                                   const cs_defocus *defocus, cs_recording *record,
                                                   planefile_axis *out);
/* *out: whether it is opaque everywhere. Errors: those of reading the header. */
CELSPAN_CHECKED celspan_status cs_record_image_hides(celspan_context *context,
                                                     const cs_image_layer *image, bool *out);
/* Must be called after all pictures have been added, so that they can be read. */
void cs_record_pictures_join(cs_recording *record);
void cs_record_pictures_finish(cs_recording *record);
