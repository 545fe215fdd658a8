/* Frames that show the same: the first of them is made, the others can be taken from it.
 *
 * INVARIANT: of each scene one frame is known, the first that was met; what it left is set when it
 * is finished.
 */
#ifndef CS_FILM_DUPLICATES_H
#define CS_FILM_DUPLICATES_H

#include "base/hash.h"
#include "output/copy.h"

typedef struct cs_duplicate {
  cs_hash scene;
  int64_t number;     /* of the frame */
  bool is_made;       /* what follows is known */
  cs_file_stamp file; /* where there are files */
  uint64_t digest[2]; /* of its pixels, where they are asked for */
} cs_duplicate;

typedef struct cs_duplicates {
  cs_duplicate *known; /* in the order in which they were met */
  size_t count, capacity;
  size_t *places;     /* indices into known, plus 1, by hash; 0: free */
  size_t place_count; /* 0 or 2^n, at least twice the count */
} cs_duplicates;

/* The index of the scene's frame: `number` where it is the first. *is_new tells which. Errors:
 * NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_duplicates_meet(cs_duplicates *duplicates,
                                                  celspan_context *context, cs_hash scene,
                                                  int64_t number, size_t *index, bool *is_new);
void cs_duplicates_finish(cs_duplicates *duplicates, celspan_context *context);

#endif
