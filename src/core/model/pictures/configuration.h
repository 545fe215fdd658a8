/* The OpenColorIO configuration in whose spaces pictures are read and frames are written. */
#pragma once

#include <stdlib.h>

/* The file that OCIO names; NULL: none. An empty name does not count, as in programs with
 * OpenColorIO. */
static inline const char *cs_space_configuration(void) {
  const char *file = getenv("OCIO");
  return file && *file ? file : NULL;
}
