/* Whether pictures can be read: their headers, or deeply, all their pixels.
 *
 *   picture --known?--> outcome
 *      \--no--> open, read in batches, close --> outcome, remembered
 *
 * INVARIANT: nothing is kept of a picture but its outcome, and of at most CS_INSPECTION_MOST
 * pictures; after that all are forgotten and may be looked at again. So the memory of an inspection
 * has a bound, however many pictures it sees.
 */
#ifndef CS_PICTURES_INSPECTION_H
#define CS_PICTURES_INSPECTION_H

#include "base/hash_table.h"
#include "pictures/picture.h"

#define CS_INSPECTION_MOST 16384

typedef struct cs_inspection_outcome {
  celspan_status status;
  char *message; /* owned; NULL where the status is OK */
} cs_inspection_outcome;

typedef struct cs_inspection {
  celspan_context *context; /* borrowed */
  bool is_deep;
  /* Called between batches of a picture that is read whole; false stops. NULL: nobody asks. */
  bool (*progress)(void *user, int32_t rows_done, int32_t rows_total);
  void *user;
  cs_hash_table indices; /* from pictures to indices into outcomes */
  cs_inspection_outcome *outcomes;
  size_t count, capacity;
} cs_inspection;

/* OK when the picture can be read. Errors, with their sentence in the context: INPUT, LIMIT,
 * BAD_ARGUMENT, NO_MEMORY; CALLBACK of a surface; CANCELLED. */
CELSPAN_CHECKED celspan_status cs_inspection_examine(cs_inspection *inspection,
                                                     const cs_picture *picture);
void cs_inspection_finish(cs_inspection *inspection);

#endif
