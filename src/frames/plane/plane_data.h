/* A plane, as its units share it.
 *
 * Invariant: `plane` is what a reader makes of the bytes.
 */
#pragma once

#include <planefile.h>
#include <stdatomic.h>

#include "base/context.h"

struct celspan_plane {
  atomic_size_t references;
  cs_memory *memory;
  unsigned char *bytes; /* of the file */
  size_t size, capacity;
  planefile_plane *plane;
};

/* The failure of a call of the subproject. */
CELSPAN_CHECKED celspan_status cs_plane_report(celspan_context *context, planefile_status status);
