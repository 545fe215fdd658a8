/* Tables of colours (.cube): the output colours for some input colours, in one or three dimensions;
 * colours between these are interpolated.
 *
 *     one                          three
 *     out |     .--*                blue ^  / green     a colour lies in one of the small boxes
 *         |  *-'                         | /            between the values: its eight corners
 *         |_/_________ in                |/___ red      are mixed
 *           the domain
 *
 * Invariant: immutable once read; the values are finite, red changes first; the domain has a size.
 */
#pragma once

#include <stdatomic.h>

#include "base/context.h"
#include "base/hash.h"

#define CS_CUBE_1D_MOST 65536 /* the most values along the side of a table, as the format says */
#define CS_CUBE_3D_MOST 256

typedef struct cs_cube {
  atomic_size_t references;
  cs_memory *memory;
  cs_hash hash;     /* the hash of its domain and values */
  bool is_solid;    /* three dimensions */
  size_t side;      /* values along a side, at least 2 */
  double domain[6]; /* the least red, green, blue; then the greatest */
  float (*values)[3];
  size_t count; /* side, or side * side * side */
} cs_cube;

/* The table of a file; it is read again only after the file has changed. *out: a new
 * reference. Errors: INPUT, with the line; LIMIT, NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_cube_read(celspan_context *context, const char *file,
                                            cs_cube **out);
cs_cube *cs_cube_ref(cs_cube *cube);
void cs_cube_unref(cs_cube *cube);

/* Replaces a colour by its value in the table; the colour is first clamped to the domain. */
void cs_cube_apply(const cs_cube *cube, double colour[3]);
