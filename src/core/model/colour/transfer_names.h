/* The names of the transfer curves, in scripts, options and the headers of files. The picture
 * modules, which are not linked with the core, use them, too.
 */
#pragma once

#include <stdbool.h>
#include <string.h>

#include "celspan/celspan.h"

/* The name of a curve other than the default; NULL for another number. */
static inline const char *cs_transfer_name(celspan_transfer transfer) {
  switch (transfer) {
  case CELSPAN_TRANSFER_LINEAR:
    return "linear";
  case CELSPAN_TRANSFER_SRGB:
    return "srgb";
  case CELSPAN_TRANSFER_REC709:
    return "rec709";
  case CELSPAN_TRANSFER_CINEON:
    return "cineon";
  default:
    return NULL;
  }
}

/* false: no curve has this name. */
static inline bool cs_transfer_parse(const char *name, celspan_transfer *out) {
  for (int i = CELSPAN_TRANSFER_LINEAR; i <= CELSPAN_TRANSFER_CINEON; i++)
    if (strcmp(name, cs_transfer_name((celspan_transfer)i)) == 0) {
      *out = (celspan_transfer)i;
      return true;
    }
  return false;
}
