/* The kind of a row: busy, where so much begins and ends that it is not worth keeping boundaries in
 * order from one row to the next, or calm.
 *
 *     rows     0 ........ 63   64 ...... 127   128 ..... 191
 *     kind       busy            calm            busy            a kind for CS_KIND_ROWS rows
 *
 * Invariant: the kind depends on the outlines, the matrix and the size of the frame: not on which
 * rows are asked for, nor on who makes them.
 */
#ifndef CS_BUSY_KIND_H
#define CS_BUSY_KIND_H

#include "geometry/boundary.h"

#define CS_KIND_ROWS 64

typedef struct cs_kind {
  uint64_t *busy; /* a bit for CS_KIND_ROWS rows; NULL: all are calm */
  size_t count;
} cs_kind;

/* Finds the kinds of the rows of a frame `height` high. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_kind_find(celspan_context *context, const cs_boundary_set *set,
                                            int32_t height, cs_kind *out);
void cs_kind_free(cs_kind *kind, cs_memory *memory);

static inline bool cs_kind_is_busy(const cs_kind *kind, int32_t row) {
  if (!kind->busy)
    return false;
  size_t part = (size_t)row / CS_KIND_ROWS;
  return kind->busy[part / 64] >> (part % 64) & 1;
}

/* Whether all rows of the frame are busy. */
bool cs_kind_are_busy(const cs_kind *kind);

#endif
