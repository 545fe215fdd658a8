/* Frames that show the same scene: the first of them is made, and the others can be copied from it.
 *
 * INVARIANT: one frame of each scene is known, the first that was added. What it can be copied from
 * is set when that frame is finished.
 */
#ifndef CS_FILM_DUPLICATES_H
#define CS_FILM_DUPLICATES_H

#include "base/hash_table.h"
#include "output/file_copy.h"

typedef struct cs_duplicate {
  int64_t number;     /* of the frame */
  bool is_made;       /* the fields below are set */
  cs_file_stamp file; /* where frames are files */
  uint64_t digest[2]; /* of its pixels, where digests are asked for */
} cs_duplicate;

typedef struct cs_duplicates {
  cs_duplicate *known; /* in the order in which they were added */
  size_t count, capacity;
  cs_hash_table indices; /* from scenes to indices into known */
} cs_duplicates;

/* Finds the frame of a scene, or adds frame `number` as its first; *is_new says which. *index: of
 * the frame among `known`. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_duplicates_add(cs_duplicates *duplicates,
                                                 celspan_context *context, cs_hash scene,
                                                 int64_t number, size_t *index, bool *is_new);
void cs_duplicates_finish(cs_duplicates *duplicates, celspan_context *context);

#endif
