/* Looks at the pictures of rostrums and reports each that cannot be read.
 *
 * INVARIANT: a fault is reported once a primitive, in the order of cels and primitives; the
 * inspection remembers pictures, so a picture of many primitives is read once.
 */
#ifndef CS_SCENE_INSPECT_H
#define CS_SCENE_INSPECT_H

#include "base/mark.h"
#include "pictures/inspection.h"

enum { CS_INSPECT_PLACE = 2 * sizeof(cs_mark_text) + 80 };

/* "cel 2 'back' (shot.lua:9), primitive 5 'sky' (shot.lua:4)", "cel 2, a light", "a light of the
 * rostrum". */
void cs_inspect_place(const celspan_fault *fault, char out[CS_INSPECT_PLACE]);

/* As celspan_rostrum_inspect, with an inspection that may serve many rostrums. */
CELSPAN_CHECKED celspan_status
cs_inspect_rostrum(cs_inspection *inspection, const celspan_rostrum *rostrum,
                   bool (*report)(void *user, const celspan_fault *fault), void *user);

#endif
