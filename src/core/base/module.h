/* A shared object loaded on first use. It offers one table of functions.
 *
 * It is searched for where the environment says, then beside the object that contains this code (so
 * that a build tree and a moved installation work), then in the folder chosen for installation when
 * it was built. Once loaded it stays in the process: libraries under it keep threads and statics
 * that do not survive unloading.
 *
 * MODULE.so.list names libraries, one in each line, that are opened before MODULE.so to load it in
 * less time. It changes nothing else: the list and any library of it may be missing.
 */
#pragma once

#include <stdint.h>

#include "base/context.h"

typedef struct cs_module_desc {
  const char *file;     /* "celspan-picture.so" */
  const char *folder;   /* where its sources lie below src/: "plugins/oiio" */
  const char *override; /* the environment variable that names a file instead */
  const char *symbol;   /* a function without arguments that returns the table */
  const char *purpose;  /* for the message: "reading and writing pictures"; NULL: callers give it */
  const char *advice;   /* for the message: what to install */
  /* The module to load if this one cannot be loaded, unless the environment names a file; NULL:
   * none. */
  const struct cs_module_desc *other;
} cs_module_desc;

extern const cs_module_desc cs_modules_picture, cs_modules_type, cs_modules_colour,
    cs_modules_space, cs_modules_pdf, cs_modules_web;

/* The table, valid for the rest of the process; it begins with `version`, as a uint32_t. Status
 * `failure` (INPUT or OUTPUT) when there is no such module, it cannot be read or loaded, or it is
 * of another version; the message says what to do. NO_MEMORY. Any thread. */
CELSPAN_CHECKED celspan_status cs_module_load(celspan_context *context, const cs_module_desc *desc,
                                              uint32_t version, celspan_status failure,
                                              const void **table);
