/* A rostrum in which one light shines, at 1, and all others are out.
 *
 *     camera
 *       |    cel n      front 0, back 0
 *       |    ...
 *       |    cel i      front 1            or   back 1, behind it
 *       v    ---------------------------
 *            cels behind it are left out: no light of theirs is left
 *
 * What it sends to the camera is what a unit of that light adds to the whole. Mattes are 0, so that
 * the alpha of what is sent is 1 less the mean of what comes through all of these cels.
 *
 * INVARIANT: it borrows everything from the rostrum that it was made of, which must outlive it; its
 * hashes are those of what it was made of, which is right for what is kept by them, since that does
 * not depend on lights.
 */
#ifndef CS_SCENE_LIT_ALONE_H
#define CS_SCENE_LIT_ALONE_H

#include "scene/scene.h"

typedef struct cs_lit_alone {
  celspan_rostrum rostrum;
  celspan_cel *cels; /* owned; the rostrum's list points to them */
  size_t count;
} cs_lit_alone;

/* index: the place of the cel, from 0; is_back: its back light, else its front light.
 * Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_lit_alone_make(celspan_context *context,
                                                 const celspan_rostrum *rostrum, size_t index,
                                                 bool is_back, cs_lit_alone *out);
void cs_lit_alone_finish(celspan_context *context, cs_lit_alone *alone);

#endif
