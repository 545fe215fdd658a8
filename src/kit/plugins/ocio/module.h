/* The table of the space module: colours of celspan's linear light, in the primaries of BT.709, in
 * the spaces and views of an OpenColorIO configuration.
 *
 * INVARIANT: no exception crosses the interface, and every failure comes with a sentence that names
 * the configuration. A conversion does not change, so that several threads may use it.
 */
#pragma once

#include "inside/pictures.h"

#ifdef __cplusplus
extern "C" {
#endif

#define CS_SPACE_MODULE_VERSION 1u

typedef struct cs_space_request {
  const char *file;  /* the configuration */
  const char *space; /* NULL: a view of a display */
  /* NULL: the configuration's default. An unknown view is one that this display does not have. */
  const char *display, *view;
} cs_space_request;

typedef struct cs_space_conversion cs_space_conversion;

typedef struct cs_space_module {
  uint32_t version;
  /* Makes a conversion from straight light. Errors: BAD_ARGUMENT, NO_MEMORY; *out is untouched
   * then. */
  celspan_status (*open)(const cs_space_request *request, cs_space_conversion **out,
                         cs_picture_failure *failure);
  /* What decides the numbers: the space or the view, the configuration, and a digest of all that
   * they are made of, its tables included. Valid until `close`. */
  const char *(*name)(const cs_space_conversion *conversion);
  const char *(*digest)(const cs_space_conversion *conversion);
  /* Colours of four floats, in place; the fourth stays. */
  void (*convert)(void *conversion, float *rgba, size_t count);
  void (*close)(cs_space_conversion *conversion);
} cs_space_module;

/* The module's one symbol. */
CELSPAN_API const void *celspan_space_module(void);

#ifdef __cplusplus
}
#endif
