/* Looks at the pictures of rostrums and reports each that cannot be read.
 *
 * INVARIANT: a fault is reported once a primitive, in the order of cels and primitives; the
 * inspection remembers pictures, so a picture of many primitives is read once.
 */
#pragma once

#include "base/arrays.h"
#include "base/hash_table.h"
#include "base/mark.h"
#include "model/pictures/picture.h"
#include "model/scene/scene.h"

/* Whether pictures can be read: their headers, or deeply, all their pixels.
 *
 *   picture --known?--> outcome
 *      \--no--> open, read in batches, close --> outcome, remembered
 *
 * INVARIANT: nothing is kept of a picture but its outcome, and of at most CS_INSPECTION_MOST
 * pictures; after that all are forgotten and may be looked at again. So the memory of an inspection
 * has a bound, however many pictures it sees.
 */

#define CS_INSPECTION_MOST 16384

typedef struct cs_inspection_outcome {
  celspan_status status;
  char *message; /* owned; NULL if the status is OK */
} cs_inspection_outcome;

typedef struct cs_inspection {
  celspan_context *context; /* borrowed */
  bool is_deep;
  /* Called between the batches of a picture that is read as a whole; false stops. NULL: it is not
   * called. */
  bool (*progress)(void *user, int32_t rows_done, int32_t rows_total);
  void *user;
  cs_hash_table indices; /* from pictures to indices into outcomes */
  CS_ARRAY(cs_inspection_outcome, outcomes);
  size_t count;
} cs_inspection;

/* OK when the picture can be read. Errors, with their sentence in the context: INPUT, LIMIT,
 * BAD_ARGUMENT, NO_MEMORY; CALLBACK of a surface; CANCELLED. */
CELSPAN_CHECKED celspan_status cs_inspection_examine(cs_inspection *inspection,
                                                     const cs_picture *picture);
void cs_inspection_finish(cs_inspection *inspection);

enum { CS_INSPECT_PLACE = 2 * sizeof(cs_mark_text) + 80 };

/* "cel 2 'back' (shot.lua:9), primitive 5 'sky' (shot.lua:4)", "cel 2, a light", "a light of the
 * rostrum". */
void cs_inspect_place(const celspan_fault *fault, char out[CS_INSPECT_PLACE]);

/* As celspan_rostrum_inspect, with an inspection that may serve many rostrums. */
CELSPAN_CHECKED celspan_status
cs_inspect_rostrum(cs_inspection *inspection, const celspan_rostrum *rostrum,
                   bool (*report)(void *user, const celspan_fault *fault), void *user);

/* Which part of a scene a message is about, in words that people know:
 *
 *   cel 3 'hand' (shot.lua:12)
 *   cel 3 'hand' (shot.lua:12), image 'ring' (shot.lua:7)
 */

typedef struct cs_blame_text {
  char text[2 * sizeof(cs_mark_text) + 64];
} cs_blame_text;

/* A cel by its number, from 1, and its mark. */
cs_blame_text cs_blame_cel(size_t number, cs_mark cel);
/* An object of a cel: the innermost one. If it has no name, the mark of its texture counts. */
cs_blame_text cs_blame_object(size_t number, cs_mark cel, const celspan_object *object);

/* Puts a place before the context's sentence about an INPUT failure, which begins with the
 * picture's file: the place of the first object in the exposures that shows this picture. Returns
 * status. */
celspan_status cs_blame_picture(celspan_context *context, const celspan_exposure *exposures,
                                size_t count, celspan_status status);
