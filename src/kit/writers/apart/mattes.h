/* How much each name is seen of, for every pixel: exact areas times alpha, as the frame has them.
 *
 * What is in front of a cel hides it. The alpha of the frame without all that is behind a place in
 * the stack is 1 less the light that comes through; so the share of a piece is the difference of
 * two such frames, with it and without it, at every point and therefore in every mean of points:
 *
 *   step 0   sky  hill  tree     alpha a0
 *   step 1        hill  tree     alpha a1     sky   is seen by a0 - a1
 *   step 2              tree     alpha a2     hill  is seen by a1 - a2
 *                                             tree  is seen by a2
 *
 * A piece is a cel; or, by the names of objects, what has the same innermost name in a cel's unions
 * and in the art of its mattes, clips and differences. Another operator is one piece with all of
 * its operands. Back lights of the rostrum are left out.
 *
 * INVARIANT: the names of mattes differ. The steps own what they show; those of one exposure
 * follow each other, from the back.
 */
#pragma once

#include "inside/context.h"

/* Steps of a frame at most: each is rendered. */
enum { CS_MATTES_MOST = 255 };

typedef struct cs_matte {
  char name[CS_MARK_NAME + 1];
} cs_matte;

typedef struct cs_matte_step {
  celspan_exposure exposure; /* owned */
  size_t matte;              /* the index of its matte; CS_MATTE_NONE: what has no name */
  bool is_last;              /* the next step, if there is one, is of another exposure */
} cs_matte_step;

#define CS_MATTE_NONE SIZE_MAX

typedef struct cs_mattes {
  celspan_context *context;
  CS_ARRAY(cs_matte, mattes);
  CS_ARRAY(cs_matte_step, steps);
  size_t count, step_count;
} cs_mattes;

/* by_objects: by the names of objects; where there is none, of their cels. Else by the names of
 * cels; a cel without a name is called by its place, cel_4. Must be finished, also after an error.
 * Errors: NO_MEMORY; LIMIT for too many steps. */
CELSPAN_CHECKED celspan_status cs_mattes_make(celspan_context *context,
                                              const celspan_exposure *exposures, size_t count,
                                              bool by_objects, cs_mattes *out);
void cs_mattes_finish(cs_mattes *mattes);
