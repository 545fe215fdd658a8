/* Images inside of drawings: pictures and other drawings, in the file itself or in files beside it.
 *
 *   href ---- data: ----> bytes --+-- PNG, JPEG, ... --> pixels in memory
 *     |                           +-- SVG -----------> a drawing of its own
 *     +------ name -----> a file below the folder of the drawing's, else nothing
 *
 * Nothing else is opened: no absolute names, no "..", no addresses, no links that lead out of the
 * folder. A drawing that shows itself, through however many files, ends there.
 */
#pragma once

#include "readers/svg/art.h"
#include "readers/svg/reading.h"

#define CS_SVG_IMAGE_DEPTH 4 /* drawings one inside the other */

/* Adds the contents of an image element to `item`; *place has its style. Contents that cannot be
 * shown are noted. Errors: NO_MEMORY; LIMIT for more than CS_SVG_IMAGE_BYTES in all; INPUT for
 * numbers that are unfit. */
CELSPAN_CHECKED celspan_status cs_svg_image_add(cs_svg_reading *reading, const cs_svg_node *node,
                                                const cs_svg_place *place, cs_svg_item *item);
/* The box of an image element in user units; *is_there: it has a size. Errors: as above. */
CELSPAN_CHECKED celspan_status cs_svg_image_box(cs_svg_reading *reading, const cs_svg_node *node,
                                                const cs_svg_measure *measure, celspan_box *out,
                                                bool *is_there);
/* The picture or drawing that the element names, fitted into a box in user units by its
 * preserveAspectRatio. *out: new, in user units; NULL: nothing is shown. Errors: as above. */
CELSPAN_CHECKED celspan_status cs_svg_image_in_box(cs_svg_reading *reading, const cs_svg_node *node,
                                                   const celspan_box *box, celspan_object **out);
